/* An explanation as JSON. In: what was recorded. Out: one object on one line: verdict, pixel, draws with their triangles,
 * and the same for each texel that was followed. Invariant: floats are the shortest numbers that read back the same; what
 * is no number is null. */
#include "explain_output.h"
#include "json.h"

#include <string.h>

static void write_floats(lom_json *json, const char *name, const float *values, int count)
{
    lom_json_nest(json, name, '[');
    for (int i = 0; i < count; i++)
        lom_json_float(json, NULL, values[i]);
    lom_json_unnest(json, ']');
}

static void write_rows(lom_json *json, const char *name, const float (*rows)[4], int count)
{
    lom_json_nest(json, name, '[');
    for (int i = 0; i < count; i++)
        write_floats(json, NULL, rows[i], 4);
    lom_json_unnest(json, ']');
}

static void write_taps(lom_json *json, const lom_note_record *note)
{
    lom_json_nest(json, "taps", '[');
    for (int i = 0; i < note->taps; i++) {
        const lom_tap *tap = &note->tap[i];
        lom_json_nest(json, NULL, '{');
        lom_json_integer(json, "level", tap->level);
        lom_json_integer(json, "x", tap->x);
        lom_json_integer(json, "y", tap->y);
        lom_json_integer(json, "layer", tap->layer);
        lom_json_float(json, "weight", tap->weight);
        write_floats(json, "color", tap->color, 4);
        lom_json_unnest(json, '}');
    }
    lom_json_unnest(json, ']');
}

static void write_lookup(lom_json *json, const lom_explanation *explanation, uint64_t pass, const lom_note_record *note)
{
    const lom_explained *to = lom_followed(explanation, pass, note);
    lom_json_text(json, "kind", note->kind == LOM_NOTE_LOOKUP ? "lookup" : "texel");
    lom_json_text(json, "texture", note->name != NULL ? note->name : "texture");
    lom_json_integer(json, "width", lom_texture_width(note->texture));
    lom_json_integer(json, "height", lom_texture_height(note->texture));
    if (note->kind == LOM_NOTE_LOOKUP) {
        write_floats(json, "at", note->value, 3);
        lom_json_integer(json, "face", note->face);
        lom_json_float(json, "lod", note->value[3]);
        lom_json_float(json, "level", note->value[4]);
    }
    write_taps(json, note);
    write_floats(json, "result", note->result, 4);
    if (to != NULL)
        lom_json_integer(json, "followed", to - explanation->item);
}

static void write_step(lom_json *json, const lom_note_record *note)
{
    static const char *const ray[] = { "enter", "leave", "step" };
    static const char *const step[] = { "distance",      "length", "density", "share",
                                        "transmittance", "sun",    "sky",     "ground" };
    bool is_ray = note->kind == LOM_NOTE_RAY;
    lom_json_text(json, "kind", is_ray ? "ray" : "step");
    for (int i = 0; i < (is_ray ? 3 : 8); i++)
        lom_json_float(json, is_ray ? ray[i] : step[i], note->value[i]);
}

static void write_notes(lom_json *json, const lom_explanation *explanation, uint64_t pass, const lom_note_record *notes)
{
    lom_json_nest(json, "notes", '[');
    for (const lom_note_record *n = notes; n != NULL; n = n->next) {
        lom_json_nest(json, NULL, '{');
        if (n->texture != NULL) {
            write_lookup(json, explanation, pass, n);
        } else if (n->kind == LOM_NOTE_VALUE) {
            lom_json_text(json, "kind", "value");
            lom_json_text(json, "name", n->name);
            write_floats(json, "value", n->value, n->components < 8 ? n->components : 8);
        } else {
            write_step(json, n);
        }
        lom_json_unnest(json, '}');
    }
    lom_json_unnest(json, ']');
}

static void write_vertex(lom_json *json, const lom_explanation *explanation, const lom_explained *explained,
                         const lom_draw_record *draw, const lom_vertex_record *v)
{
    const lom_shader *shader = draw->desc.shader;
    const int64_t fixed[2] = { v->fixed[0], v->fixed[1] };
    double world[3];
    lom_json_nest(json, NULL, '{');
    if (v->index != UINT32_MAX) {
        lom_json_integer(json, "index", v->index);
        write_rows(json, "attributes", v->attribute, shader->attributes);
        if (lom_world_place(explained, v, world)) {
            lom_json_nest(json, "world", '[');
            for (int i = 0; i < 3; i++)
                lom_json_number(json, NULL, world[i]);
            lom_json_unnest(json, ']');
        }
    }
    write_floats(json, "clip", v->clip, 4);
    write_floats(json, "ndc", v->ndc, 3);
    write_floats(json, "window", v->window, 3);
    lom_json_integers(json, "fixed", fixed, 2);
    lom_json_float(json, "depth", v->depth);
    lom_json_float(json, "one_over_w", v->one_over_w);
    lom_json_integer(json, "outcode", v->code);
    write_floats(json, "distances", v->distance, shader->clip_distances + shader->cull_distances);
    write_floats(json, "varyings", v->varying, shader->varyings);
    write_notes(json, explanation, draw->pass->number, v->notes);
    lom_json_unnest(json, '}');
}

static void write_fragment(lom_json *json, const lom_explanation *explanation, const lom_draw_record *draw,
                           const lom_fragment_record *f)
{
    const lom_shader *shader = draw->desc.shader;
    write_floats(json, "weights", f->l, 3);
    lom_json_float(json, "z", f->z);
    if (f->depth_tested || f->depth_written) {
        lom_json_nest(json, "depth_test", '{');
        lom_json_float(json, "depth", f->depth);
        lom_json_float(json, "stored", f->depth_before);
        lom_json_bool(json, "passed", f->depth_passed);
        lom_json_bool(json, "written", f->depth_written);
        lom_json_unnest(json, '}');
    }
    if (!f->shaded)
        return;
    write_floats(json, "perspective_weights", f->b, 3);
    write_floats(json, "varyings", f->varying, shader->varyings);
    write_floats(json, "dx", f->dx, shader->varyings);
    write_floats(json, "dy", f->dy, shader->varyings);
    write_notes(json, explanation, draw->pass->number, f->notes);
    write_rows(json, "color", f->color, shader->colors);
    lom_json_nest(json, "writes", '[');
    for (int i = 0; i < shader->colors; i++) {
        if (!f->write[i].written)
            continue;
        lom_json_nest(json, NULL, '{');
        lom_json_integer(json, "target", i);
        write_floats(json, "source", f->write[i].source, 4);
        write_floats(json, "before", f->write[i].before, 4);
        write_floats(json, "after", f->write[i].after, 4);
        lom_json_unnest(json, '}');
    }
    lom_json_unnest(json, ']');
}

static void write_triangle(lom_json *json, const lom_explanation *explanation, const lom_explained *explained,
                           const lom_triangle_record *t)
{
    lom_json_nest(json, NULL, '{');
    lom_json_integer(json, "number", (int64_t)t->number);
    lom_json_integer(json, "instance", t->instance);
    lom_json_text(json, "fate", lom_fate_text(t->fate));
    if (t->lost_to != NULL) {
        lom_json_nest(json, "to", '{');
        lom_json_integer(json, "pass", (int64_t)t->lost_to->draw->pass->number);
        lom_json_integer(json, "draw", (int64_t)t->lost_to->draw->number);
        lom_json_integer(json, "triangle", (int64_t)t->lost_to->number);
        lom_json_unnest(json, '}');
    }
    lom_json_nest(json, "vertices", '[');
    const int corners = lom_is_line(t->draw) ? 2 : 3;
    for (int k = 0; k < corners; k++)
        write_vertex(json, explanation, explained, t->draw, &t->vertex[k]);
    lom_json_unnest(json, ']');
    if (t->pieces != 0) {
        lom_json_integer(json, "piece", t->piece);
        lom_json_integer(json, "pieces", t->pieces);
        lom_json_nest(json, "clipped", '[');
        for (int k = 0; k < corners; k++)
            write_vertex(json, explanation, explained, t->draw, &t->cut[k]);
        lom_json_unnest(json, ']');
    }
    if (t->has_edges) {
        const int64_t order[3] = { t->order[0], t->order[1], t->order[2] };
        lom_json_integers(json, "order", order, 3);
        lom_json_integers(json, "edges", t->edge, 3);
        lom_json_integer(json, "area", t->area);
        lom_json_bool(json, "front", t->front);
    }
    if (t->covered)
        write_fragment(json, explanation, t->draw, &t->fragment);
    lom_json_unnest(json, '}');
}

static void write_blend(lom_json *json, const lom_blend *b)
{
    lom_json_nest(json, "blend", '{');
    lom_json_text(json, "operation", lom_operation_text(b->color_operation));
    lom_json_text(json, "source", lom_factor_text(b->source_color));
    lom_json_text(json, "target", lom_factor_text(b->target_color));
    lom_json_text(json, "source_alpha", lom_factor_text(b->source_alpha));
    lom_json_text(json, "target_alpha", lom_factor_text(b->target_alpha));
    lom_json_unnest(json, '}');
}

static void write_draws(lom_json *json, const lom_explanation *explanation, const lom_explained *explained)
{
    lom_json_nest(json, "draws", '[');
    for (const lom_pass_record *pass = explained->record->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next) {
            lom_json_nest(json, NULL, '{');
            lom_json_integer(json, "pass", (int64_t)pass->number);
            lom_json_text(json, "pass_name", lom_pass_name(pass));
            lom_json_bool(json, "filters", pass->filters);
            lom_json_integer(json, "draw", (int64_t)draw->number);
            lom_json_text(json, "name", lom_draw_name(draw));
            lom_json_text(json, "shader", draw->desc.shader->name);
            lom_json_text(json, "primitive", lom_primitive_name(draw));
            lom_json_bool(json, "recorded", draw->recorded);
            lom_json_text(json, "depth_compare", draw->recorded ? lom_compare_text(draw->compare) : NULL);
            lom_json_bool(json, "depth_write", draw->depth_written);
            if (pass->attachment >= 0 && draw->desc.blend[pass->attachment].enabled)
                write_blend(json, &draw->desc.blend[pass->attachment]);
            lom_json_integer(json, "near_misses", (int64_t)draw->near_misses);
            lom_json_nest(json, "triangles", '[');
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                write_triangle(json, explanation, explained, t);
            lom_json_unnest(json, ']');
            lom_json_unnest(json, '}');
        }
    lom_json_unnest(json, ']');
    lom_json_nest(json, "passes", '[');
    for (const lom_pass_record *pass = explained->record->passes; pass != NULL; pass = pass->next) {
        int channels = pass->attachment < 0 ? 1 : 4;
        lom_json_nest(json, NULL, '{');
        lom_json_integer(json, "pass", (int64_t)pass->number);
        lom_json_text(json, "name", lom_pass_name(pass));
        lom_json_integer(json, "attachment", pass->attachment);
        write_floats(json, "after", pass->end, channels);
        lom_json_unnest(json, '}');
    }
    lom_json_unnest(json, ']');
}

static void write_followed(lom_json *json, const lom_explanation *explanation)
{
    lom_json_nest(json, "followed", '[');
    for (size_t i = 1; i < explanation->count; i++) {
        const lom_explained *e = &explanation->item[i];
        lom_json_nest(json, NULL, '{');
        lom_json_integer(json, "number", (int64_t)i);
        lom_json_text(json, "texture", e->name);
        lom_json_integer(json, "x", e->x);
        lom_json_integer(json, "y", e->y);
        lom_json_integer(json, "read_by_pass", (int64_t)e->before);
        lom_json_text(json, "verdict", e->verdict);
        write_draws(json, explanation, e);
        lom_json_unnest(json, '}');
    }
    lom_json_unnest(json, ']');
}

/* The first pixel's samples, little-endian. */
static void write_bytes(lom_json *json, const lom_image *image)
{
    const lom_format_info *format = lom_describe_format(image->format);
    lom_json_nest(json, "pixel", '[');
    for (int c = 0; c < format->channels; c++) {
        uint8_t byte = image->pixels[c % 4];
        uint16_t half = 0;
        uint32_t whole = 0;
        if (format->bits == 16)
            memcpy(&half, image->pixels + 2 * c, sizeof half);
        if (format->bits == 32)
            memcpy(&whole, image->pixels + 4 * c, sizeof whole);
        uint32_t bits = format->bits == 8 ? byte : format->bits == 16 ? half : whole;
        for (int i = 0; i < format->bits; i += 8)
            lom_json_integer(json, NULL, bits >> i & 255);
    }
    lom_json_unnest(json, ']');
}

void lom_write_explanation(FILE *out, const struct lom_explain_head *head)
{
    const lom_explanation *x = head->explanation;
    const lom_image *image = x->frame.image;
    lom_json json = lom_json_begin(out);
    lom_json_text(&json, "verdict", x->item[0].verdict);
    lom_json_text(&json, "scene", head->scene);
    lom_json_integer(&json, "frame", head->frame);
    if (x->view != NULL)
        lom_json_text(&json, "view", x->view);
    lom_json_integer(&json, "width", x->width);
    lom_json_integer(&json, "height", x->height);
    lom_json_integer(&json, "x", x->item[0].x);
    lom_json_integer(&json, "y", x->item[0].y);
    write_bytes(&json, image);
    lom_json_text(&json, "format", lom_describe_format(image->format)->name);
    write_draws(&json, x, &x->item[0]);
    write_followed(&json, x);
    lom_json_end(&json);
}
