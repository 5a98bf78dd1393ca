/* An explanation as text. In: what was recorded. Out: the verdict on the first line; then every draw and triangle that
 * touched the pixel, in order, with its numbers; then the same for each texel that was followed. */
#include "explain_output.h"

#include <string.h>

struct text {
    FILE *out;
    const lom_explanation *explanation;
    const lom_explained *explained;
    const char *indent;
};

static void print_float(FILE *out, float value)
{
    char text[32];
    lom_print_float(text, value);
    fputs(text, out);
}

static void print_floats(const struct text *t, const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        fputs(i > 0 ? " " : "", t->out);
        print_float(t->out, values[i]);
    }
}

/* A line of a name and numbers. */
static void print_row(const struct text *t, int depth, const char *name, const float *values, int count)
{
    if (count == 0)
        return;
    fprintf(t->out, "%s%*s%-14s ", t->indent, 2 * depth, "", name);
    print_floats(t, values, count);
    fputs("\n", t->out);
}

/* ---- what shaders said ---- */

static void print_taps(const struct text *t, int depth, const lom_note_record *n)
{
    for (int i = 0; i < n->taps; i++) {
        const lom_tap *tap = &n->tap[i];
        fprintf(t->out, "%s%*stexel %d,%d", t->indent, 2 * depth, "", tap->x, tap->y);
        if (lom_texture_depth(n->texture) > 1 || tap->layer != 0)
            fprintf(t->out, ",%d", tap->layer);
        fprintf(t->out, " of level %d, weight ", tap->level);
        print_float(t->out, tap->weight);
        fputs(": ", t->out);
        print_floats(t, tap->color, 4);
        fputs("\n", t->out);
    }
}

static void print_lookup(const struct text *t, int depth, uint64_t pass, const lom_note_record *n)
{
    const lom_explained *to = lom_followed(t->explanation, pass, n);
    fprintf(t->out, "%s%*slooks up %s (%dx%d)", t->indent, 2 * depth, "", n->name != NULL ? n->name : "a texture",
            lom_texture_width(n->texture), lom_texture_height(n->texture));
    if (n->kind == LOM_NOTE_LOOKUP) {
        fputs(" at ", t->out);
        print_floats(t, n->value, lom_texture_depth(n->texture) > 1 ? 3 : 2);
        fputs(", level of detail ", t->out);
        print_float(t->out, n->value[3]);
        fputs(", level ", t->out);
        print_float(t->out, n->value[4]);
    }
    fputs(": ", t->out);
    print_floats(t, n->result, 4);
    if (to != NULL)
        fprintf(t->out, " -> see [%d]", (int)(to - t->explanation->item));
    fputs("\n", t->out);
    print_taps(t, depth + 1, n);
}

static void print_note(const struct text *t, int depth, uint64_t pass, const lom_note_record *n)
{
    if (n->texture != NULL) {
        print_lookup(t, depth, pass, n);
    } else if (n->kind == LOM_NOTE_VALUE) {
        fprintf(t->out, "%s%*s%s = ", t->indent, 2 * depth, "", n->name);
        print_floats(t, n->value, n->components < 8 ? n->components : 8);
        fputs("\n", t->out);
    } else if (n->kind == LOM_NOTE_RAY) {
        print_row(t, depth, "marches a ray: enters, leaves, metres a step", n->value, 3);
    } else if (n->value[2] > 0) {
        print_row(t, depth + 1, "step: distance, length, density, share, transmittance; light of sun, sky, ground",
                  n->value, 8);
    } else {
        print_row(t, depth + 1, "step: distance, length, density", n->value, 3);
    }
}

static void print_notes(const struct text *t, int depth, uint64_t pass, const lom_note_record *notes)
{
    for (const lom_note_record *n = notes; n != NULL; n = n->next)
        print_note(t, depth, pass, n);
}

/* ---- triangles ---- */

static void print_code(const struct text *t, unsigned code)
{
    static const struct {
        unsigned bit;
        const char *text;
    } codes[] = { { LOM_OUT_NEAR, "before the near plane" },
                  { LOM_OUT_FAR, "behind the far plane" },
                  { LOM_OUT_GUARD, "outside the guard band" },
                  { LOM_OUT_W, "w not above 0" },
                  { LOM_OUT_INVALID, "no finite position" } };
    for (size_t i = 0; i < sizeof codes / sizeof codes[0]; i++)
        if (code & codes[i].bit)
            fprintf(t->out, ", %s", codes[i].text);
    for (int i = 0; i < 8; i++)
        if (code >> i & 1)
            fprintf(t->out, ", distance %d below 0", i);
}

static void print_vertex(const struct text *t, const lom_draw_record *draw, int number, const lom_vertex_record *v)
{
    const lom_shader *shader = draw->desc.shader;
    double world[3];
    fprintf(t->out, "%s      vertex %d", t->indent, number);
    if (v->index != UINT32_MAX)
        fprintf(t->out, " (index %u)", v->index);
    else if (draw->desc.tessellation != NULL || draw->desc.geometry != NULL)
        fputs(" (made by a stage behind the vertices)", t->out);
    else
        fputs(" (of the clipped piece)", t->out);
    print_code(t, v->code);
    fputs("\n", t->out);
    for (int a = 0; v->index != UINT32_MAX && a < shader->attributes; a++) {
        char name[24];
        snprintf(name, sizeof name, a == 0 ? "object" : "attribute %d", a);
        print_row(t, 4, name, v->attribute[a], 4);
    }
    if (lom_world_place(t->explained, v, world))
        fprintf(t->out, "%s        %-14s %.9g %.9g %.9g\n", t->indent, "world", world[0], world[1], world[2]);
    print_row(t, 4, "clip", v->clip, 4);
    print_row(t, 4, "ndc", v->ndc, 3);
    print_row(t, 4, "window", v->window, 3);
    fprintf(t->out, "%s        %-14s %d %d (1/256 pixel)\n", t->indent, "fixed-point", v->fixed[0], v->fixed[1]);
    print_row(t, 4, "clip distances", v->distance, shader->clip_distances + shader->cull_distances);
    print_row(t, 4, "varyings", v->varying, shader->varyings);
    print_notes(t, 4, draw->pass->number, v->notes);
}

static void print_write(const struct text *t, const lom_draw_record *draw, int target, const lom_write_record *w)
{
    const lom_blend *blend = &draw->desc.blend[target];
    if (!w->written)
        return;
    print_row(t, 3, "goes in as", w->source, 4);
    print_row(t, 3, "was there", w->before, 4);
    if (blend->enabled)
        fprintf(t->out, "%s      blended: source * %s %s target * %s; alpha: source * %s %s target * %s\n", t->indent,
                lom_factor_text(blend->source_color), lom_operation_text(blend->color_operation),
                lom_factor_text(blend->target_color), lom_factor_text(blend->source_alpha),
                lom_operation_text(blend->alpha_operation), lom_factor_text(blend->target_alpha));
    print_row(t, 3, "stored", w->after, 4);
}

static void print_depth(const struct text *t, const lom_draw_record *draw, const lom_fragment_record *f)
{
    if (!f->depth_tested && !f->depth_written)
        return;
    fprintf(t->out, "%s      depth ", t->indent);
    print_float(t->out, f->depth);
    fprintf(t->out, " %s stored ", lom_compare_text(draw->compare));
    print_float(t->out, f->depth_before);
    fprintf(t->out, "? %s%s\n", f->depth_passed ? "passes" : "fails", f->depth_written ? ", is stored" : "");
}

static void print_fragment(const struct text *t, const lom_draw_record *draw, const lom_fragment_record *f)
{
    const lom_shader *shader = draw->desc.shader;
    print_row(t, 3, "weights", f->l, 3);
    print_depth(t, draw, f);
    if (!f->shaded)
        return;
    print_row(t, 3, "perspective", f->b, 3);
    for (int v = 0; v < shader->varyings; v++) {
        if ((shader->reads >> v & 1) == 0)
            continue;
        fprintf(t->out, "%s      varying %-6d ", t->indent, v);
        print_float(t->out, f->varying[v]);
        if (shader->differentiates >> v & 1) {
            fputs(", d/dx ", t->out);
            print_float(t->out, f->dx[v]);
            fputs(", d/dy ", t->out);
            print_float(t->out, f->dy[v]);
        }
        fputs("\n", t->out);
    }
    print_notes(t, 3, draw->pass->number, f->notes);
    for (int i = 0; i < shader->colors; i++) {
        print_row(t, 3, "shader gives", f->color[i], 4);
        print_write(t, draw, i, &f->write[i]);
    }
}

static void print_triangle(const struct text *t, const lom_triangle_record *triangle)
{
    const bool is_line = lom_is_line(triangle->draw);
    fprintf(t->out, "%s    %s %zu%s: %s", t->indent, lom_primitive_name(triangle->draw), triangle->number,
            !triangle->has_edges ? ""
            : triangle->front    ? ", front"
                                 : ", back",
            lom_fate_text(triangle->fate));
    if (triangle->lost_to != NULL)
        fprintf(t->out, " by %s %zu of draw %zu in pass %llu", lom_primitive_name(triangle->lost_to->draw),
                triangle->lost_to->number, triangle->lost_to->draw->number,
                (unsigned long long)triangle->lost_to->draw->pass->number);
    fputs("\n", t->out);
    for (int k = 0; k < (is_line ? 2 : 3); k++)
        print_vertex(t, triangle->draw, k, &triangle->vertex[k]);
    if (triangle->pieces != 0)
        fprintf(t->out, "%s      clipped into %d; this is piece %d\n", t->indent, triangle->pieces, triangle->piece);
    for (int k = 0; k < (is_line ? 2 : 3) && triangle->pieces != 0; k++)
        print_vertex(t, triangle->draw, k, &triangle->cut[k]);
    if (triangle->has_edges)
        fprintf(t->out, "%s      edge values    %lld %lld %lld of %lld, vertices in the order %d %d %d\n", t->indent,
                (long long)triangle->edge[0], (long long)triangle->edge[1], (long long)triangle->edge[2],
                (long long)triangle->area, triangle->order[0], triangle->order[1], triangle->order[2]);
    if (triangle->covered)
        print_fragment(t, triangle->draw, &triangle->fragment);
}

static void print_passes(const struct text *t)
{
    for (const lom_pass_record *pass = t->explained->record->passes; pass != NULL; pass = pass->next) {
        int channels = pass->attachment < 0 ? 1 : 4;
        fprintf(t->out, "\n%spass %llu \"%s\"", t->indent, (unsigned long long)pass->number, lom_pass_name(pass));
        fputs(", after which the pixel holds ", t->out);
        print_floats(t, pass->end, channels);
        fputs("\n", t->out);
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next) {
            fprintf(t->out, "%s  draw %zu: %s, shader %s%s", t->indent, draw->number, lom_draw_name(draw),
                    draw->desc.shader->name, draw->recorded ? "" : ", which could not be recorded");
            if (draw->near_misses != 0)
                fprintf(t->out, "; %zu %ss whose box holds the pixel do not cover it", draw->near_misses,
                        lom_primitive_name(draw));
            fputs("\n", t->out);
            for (const lom_triangle_record *triangle = draw->triangles; triangle != NULL; triangle = triangle->next)
                print_triangle(t, triangle);
        }
    }
}

static void print_pixel(FILE *out, const lom_image *image)
{
    const lom_format_info *format = lom_describe_format(image->format);
    for (int c = 0; c < format->channels; c++) {
        uint16_t half;
        float value;
        memcpy(&half, image->pixels + (format->bits == 16 ? 2 * c : 0), sizeof half);
        memcpy(&value, image->pixels + (format->bits == 32 ? 4 * c : 0), format->bits == 32 ? sizeof value : 1);
        fputs(" ", out);
        if (format->bits == 32)
            print_float(out, value);
        else
            fprintf(out, "%d", format->bits == 16 ? half : image->pixels[c]);
    }
}

void lom_print_explanation(FILE *out, const struct lom_explain_head *head)
{
    const lom_explanation *x = head->explanation;
    struct text t = { out, x, &x->item[0], "" };
    fprintf(out, "%s\n", x->item[0].verdict);
    fprintf(out, "pixel %d,%d of %s, frame %d, %dx%d:", x->item[0].x, x->item[0].y, head->scene, head->frame, x->width,
            x->height);
    print_pixel(out, x->frame.image);
    if (x->view != NULL)
        fprintf(out, "; it is one of the view \"%s\"", x->view);
    fputs("\n", out);
    print_passes(&t);
    for (size_t i = 1; i < x->count; i++) {
        const lom_explained *e = &x->item[i];
        t.explained = e;
        t.indent = "  ";
        fprintf(out, "\n[%zu] %s, texel %d,%d, as pass %llu read it: %s\n", i, e->name, e->x, e->y,
                (unsigned long long)e->before, e->verdict);
        print_passes(&t);
    }
}
