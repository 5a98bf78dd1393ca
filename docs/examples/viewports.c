/* A boat from above, from ahead, from the side and in perspective, written to viewports.png: four viewports of one pass,
 * which the draws name.
 *
 *   lom-cc viewports.c -o viewports
 */
#include <lom/lom.h>

#include <stdio.h>

struct look {
    float clip_from_world[4][4], light[3];
};

enum { LIT, VARYINGS };

static lom_float row(const float m[4], lom_float4 p)
{
    return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
}

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct look *look = uniforms;
    const float(*m)[4] = look->clip_from_world;
    lom_float4 p = in->attribute[0], n = in->attribute[1];
    out->position = (lom_float4){ row(m[0], p), row(m[1], p), row(m[2], p), row(m[3], p) };
    out->varying[LIT] =
        0.3f + 0.7f * lom_max(look->light[0] * n.x + look->light[1] * n.y + look->light[2] * n.z, lom_splat(0));
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_float lit = in->varying[LIT];
    out->color[0] = (lom_float4){ lit * 0.42f, lit * 0.2f, lit * 0.08f, lom_splat(1) };
    (void)uniforms;
}

LOM_SHADER(solid, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(LIT, 1), .colors = 1,
           .uniforms_size = sizeof(struct look))

#if LOM_LANES == 4 /* the rest of the file is compiled once */

enum { WIDTH = 480, HEIGHT = 360, VIEWS = 4 };

static const struct view {
    lom_vec3 eye, up;
    double metres; /* that the view is high; 0: in perspective */
    lom_rect viewport;
} views[VIEWS] = { { { 0, 20, 0 }, { 1, 0, 0 }, 4.8, { 16, 16, 140, 260 } }, /* from above, the bow at the top */
                   { { 20, 0.2, 0 }, { 0, 1, 0 }, 4.8 * 60 / 260, { 16, 284, 140, 60 } },  /* from ahead */
                   { { 0, 0.2, 20 }, { 0, 1, 0 }, 4.8 * 60 / 260, { 164, 284, 300, 60 } }, /* from the side */
                   { { 5, 4.2, 4.4 }, { 0, 1, 0 }, 0, { 164, 16, 300, 260 } } };

static struct look look_of(const struct view *view)
{
    const double aspect = (double)view->viewport.width / view->viewport.height;
    struct look look = { .light = { 0.48f, 0.8f, 0.36f } };
    lom_mat4 projection = view->metres == 0 ? lom_perspective(0.5, aspect, 0.1)
                                            : lom_orthographic(view->metres * aspect, view->metres, 1, 40),
             seen = lom_look_at(view->eye, (lom_vec3){ 0, 0.2, 0 }, view->up), all = lom_multiply(&projection, &seen);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            look.clip_from_world[i][k] = (float)all.m[i][k];
    return look;
}

static lom_draw_desc draw_of(const lom_mesh *mesh)
{
    const size_t stride = sizeof *mesh->vertices, size = mesh->vertex_count * stride;
    const lom_mesh_vertex *v = mesh->vertices;
    return (lom_draw_desc){ .shader = &solid,
                            .indices = mesh->indices,
                            .count = mesh->index_count,
                            .attribute = { { v->position, size, stride, LOM_ATTRIBUTE_FLOAT3 },
                                           { v->normal, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 } } };
}

static bool draw(lom_device *device, const lom_mesh *mesh, lom_pass_desc *pass)
{
    const lom_texture_desc target = { .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB, .samples = 4 };
    lom_texture_desc depth = target;
    depth.format = LOM_FORMAT_DEPTH32F;
    pass->color[0] = lom_make_texture(device, &target);
    pass->depth = lom_make_texture(device, &depth);
    lom_begin_pass(device, pass);
    for (int i = 0; i < VIEWS; i++) {
        struct look look = look_of(&views[i]);
        lom_draw_desc boat = draw_of(mesh);
        boat.uniforms = &look;
        boat.viewport = views[i].viewport;
        lom_draw(device, &boat);
    }
    return lom_end_pass(device);
}

int main(void)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_mesh *boat = lom_make_entity("boat", 1, &error);
    lom_pass_desc pass = { .samples = 4, .clear_color = { { 0.78f, 0.82f, 0.85f, 1 } } };
    bool done = boat != NULL && draw(device, boat, &pass);
    lom_image *image = done ? lom_read_texture(pass.color[0], 0, 0, &error) : NULL;
    done = image != NULL && lom_write_image("viewports.png", NULL, image, &error);
    if (done)
        printf("%016llx\n", (unsigned long long)lom_hash_image(image));
    else
        fprintf(stderr, "viewports: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_free_mesh(boat);
    lom_close_device(device);
    return done ? 0 : 2;
}

#endif
