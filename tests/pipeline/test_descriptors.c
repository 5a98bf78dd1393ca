/* Proves what the public functions do with descriptors and objects that are not as they should be: NULL is the zero
 * descriptor; a NULL device is one that has failed; an attachment of another device, a draw of vertices that do not
 * exist, a shader, draw, pass or device that cannot be, and a number that is NaN or out of its range are errors with a
 * sentence. */
#include "check.h"

#include <lom/lom.h>

static bool is_sentence(const lom_error *error)
{
    size_t length = strlen(error->text);
    return error->code != LOM_OK && length > 10 && error->text[length - 1] == '.';
}

static void null_is_the_zero_descriptor(void)
{
    lom_device *device = lom_open_device(NULL);
    lom_device_desc resolved = lom_describe_device(device);
    CHECK(lom_device_error(device)->code == LOM_OK && resolved.threads >= 1 && resolved.lanes >= 4, "%s",
          lom_device_error(device)->text);
    lom_begin_pass(device, NULL);
    CHECK(is_sentence(lom_device_error(device)), "a pass without attachments: \"%s\"", lom_device_error(device)->text);
    lom_close_device(device);

    device = lom_open_device(NULL);
    CHECK(lom_make_texture(device, NULL) == NULL && is_sentence(lom_device_error(device)), "a texture of no size");
    lom_close_device(device);

    device = lom_open_device(NULL);
    lom_texture *target = lom_make_texture(device, &(lom_texture_desc){ .width = 8, .height = 8 });
    lom_begin_pass(device, &(lom_pass_desc){ .color = { target } });
    lom_draw(device, NULL);
    CHECK(!lom_end_pass(device) && is_sentence(lom_device_error(device)), "a draw without a shader");
    lom_close_device(device);

    lom_error error = { 0 };
    CHECK(lom_make_cloud(NULL, &error) == NULL && is_sentence(&error), "a cloud of no kind");
    error = (lom_error){ 0 };
    CHECK(lom_make_albedo(NULL, &error) == NULL && is_sentence(&error), "a texture of no name");
    error = (lom_error){ 0 };
    CHECK(lom_create_shallow(NULL, &error) == NULL && is_sentence(&error), "shallow water of no cells");
    error = (lom_error){ 0 };
    CHECK(lom_create_reference_volume(NULL, &error) == NULL && is_sentence(&error), "a volume of no density");
    error = (lom_error){ 0 };
    lom_sea_desc sea, zero;
    CHECK(lom_resolve_sea(NULL, &sea, &error) && lom_resolve_sea(&(lom_sea_desc){ 0 }, &zero, &error) &&
              sea.cascade_count == zero.cascade_count && sea.wind_speed == zero.wind_speed,
          "%s", error.text);
    lom_image *map = lom_make_normal_map(NULL, &error);
    CHECK(map != NULL && map->width == 512, "%s", error.text);
    lom_free_image(map);
}

static void a_device_that_filters_in_fixed_point_makes_such_textures(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .filtering = LOM_FILTERING_FIXED });
    CHECK(lom_describe_device(device).filtering == LOM_FILTERING_FIXED, "%s", lom_device_error(device)->text);
    static const uint8_t pixels[8] = { 0, 0, 0, 0, 255, 200, 100, 50 };
    lom_texture_desc desc = { .width = 2, .height = 1, .pixels = pixels };
    lom_texture *by_device = lom_make_texture(device, &desc), *in_float = lom_create_texture(&desc, NULL);
    desc.sampler.filtering = LOM_FILTERING_FIXED;
    lom_texture *by_sampler = lom_create_texture(&desc, NULL);
    lom_float at = lom_splat(0.4f), zero = { 0 };
    lom_float4 a = lom_sample(by_device, at, at, zero), b = lom_sample(by_sampler, at, at, zero);
    lom_float4 c = lom_sample(in_float, at, at, zero);
    CHECK(memcmp(&a, &b, sizeof a) == 0 && memcmp(&a, &c, sizeof a) != 0, "%g, %g, in float %g", (double)a.x[0],
          (double)b.x[0], (double)c.x[0]);
    lom_free_texture(in_float);
    lom_free_texture(by_sampler);
    lom_close_device(device);
    device = lom_open_device(&(lom_device_desc){ .filtering = LOM_FILTERING_COUNT });
    CHECK(is_sentence(lom_device_error(device)), "an unknown filtering");
    lom_close_device(device);
}

static void a_null_device_is_one_that_has_failed(void)
{
    lom_error error = { 0 };
    CHECK(is_sentence(lom_device_error(NULL)), "no sentence");
    CHECK(lom_make_texture(NULL, &(lom_texture_desc){ .width = 1, .height = 1 }) == NULL, "a texture of no device");
    lom_release_texture(NULL, NULL);
    lom_begin_pass(NULL, NULL);
    lom_draw(NULL, NULL);
    CHECK(!lom_end_pass(NULL), "a pass of no device");
    CHECK(lom_device_counters(NULL).passes == 0 && lom_describe_device(NULL).threads == 0, "work of no device");
    CHECK(lom_create_sea(NULL, NULL, &error) == NULL && is_sentence(&error), "a sea of no device");
    lom_close_device(NULL);
}

static void textures_belong_to_their_device(void)
{
    lom_error error = { 0 };
    lom_device *one = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_device *other = lom_open_device(&(lom_device_desc){ .threads = 1 });
    const lom_texture_desc color = { .width = 8, .height = 8 };
    const lom_texture_desc depth = { .width = 8, .height = 8, .format = LOM_FORMAT_DEPTH32F };
    lom_texture *own = lom_make_texture(one, &color), *foreign = lom_make_texture(other, &depth);
    lom_texture *free_one = lom_create_texture(&color, &error);
    lom_begin_pass(one, &(lom_pass_desc){ .color = { free_one } });
    CHECK(lom_end_pass(one), "a texture of no device: %s", lom_device_error(one)->text);
    lom_begin_pass(one, &(lom_pass_desc){ .color = { own }, .depth = foreign });
    CHECK(!lom_end_pass(one) && strstr(lom_device_error(one)->text, "another device") != NULL, "\"%s\"",
          lom_device_error(one)->text);
    lom_release_texture(other, own);
    CHECK(is_sentence(lom_device_error(other)), "it freed what is not its own");
    lom_close_device(one);
    lom_close_device(other);
    lom_free_texture(free_one);
}

static bool update(lom_device *device, lom_texture *texture, const void *pixels, size_t size)
{
    bool done = lom_update_texture(device, texture, pixels, size);
    CHECK(done == (lom_device_error(device)->code == LOM_OK), "done or an error, not both");
    CHECK(done || is_sentence(lom_device_error(device)), "\"%s\"", lom_device_error(device)->text);
    return done;
}

static void textures_are_updated_by_their_device(void)
{
    static const uint8_t old[16] = { 1, 2, 3, 4 }, new[16] = { 50, 60, 70, 80, 90 };
    lom_error error = { 0 };
    for (int wrong = 0; wrong < 6; wrong++) {
        lom_device *one = lom_open_device(&(lom_device_desc){ .threads = 1 });
        lom_device *other = lom_open_device(&(lom_device_desc){ .threads = 1 });
        lom_texture *texture = lom_make_texture(one, &(lom_texture_desc){ .width = 2, .height = 2, .pixels = old });
        lom_texture *loose = lom_create_texture(&(lom_texture_desc){ .width = 2, .height = 2 }, &error);
        CHECK(update(one, loose, new, sizeof new) && update(one, texture, new, sizeof new), "%s",
              lom_device_error(one)->text);
        lom_image *image = lom_read_texture(texture, 0, 0, &error);
        CHECK(image != NULL && memcmp(image->pixels, new, sizeof new) == 0, "other pixels");
        lom_free_image(image);
        if (wrong == 0)
            CHECK(!update(one, NULL, old, sizeof old), "no texture");
        if (wrong == 1)
            CHECK(!update(one, texture, NULL, sizeof old), "no pixels");
        if (wrong == 2)
            CHECK(!update(one, texture, old, sizeof old - 1), "another size");
        if (wrong == 3)
            CHECK(!update(other, texture, old, sizeof old), "a texture of another device");
        if (wrong == 4) {
            lom_begin_pass(one, &(lom_pass_desc){ .color = { loose } });
            CHECK(!update(one, texture, old, sizeof old), "within a pass");
        }
        if (wrong == 5)
            CHECK(!lom_update_texture(NULL, texture, old, sizeof old), "no device");
        image = lom_read_texture(texture, 0, 0, &error);
        CHECK(image != NULL && memcmp(image->pixels, new, sizeof new) == 0, "%d: it changed", wrong);
        lom_free_image(image);
        lom_free_texture(loose);
        lom_close_device(one);
        lom_close_device(other);
    }
}

/* ---- draws ---- */

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(1), lom_splat(1), lom_splat(1), lom_splat(1) };
}

LOM_SHADER(plain, place, paint, .attributes = 1, .colors = 1)

/* Draws one triangle with the shader of the descriptor, or else the plain one. */
static bool draw(lom_draw_desc desc, lom_error *error)
{
    static const float corners[3][4] = { { -1, -1, 0.5f, 1 }, { 1, -1, 0.5f, 1 }, { 0, 1, 0.5f, 1 } };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_texture *target = lom_make_texture(device, &(lom_texture_desc){ .width = 8, .height = 8 });
    if (desc.shader == NULL)
        desc.shader = &plain;
    if (desc.attribute[0].kind == LOM_ATTRIBUTE_NONE)
        desc.attribute[0] = (lom_attribute){ corners, sizeof corners, 16, LOM_ATTRIBUTE_FLOAT4 };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { target } });
    lom_draw(device, &desc);
    bool done = lom_end_pass(device);
    *error = *lom_device_error(device);
    lom_close_device(device);
    return done;
}

static void vertices_that_are_drawn_exist(void)
{
    static const uint32_t beyond[3] = { 0, 1, 7 };
    static const lom_draw_desc wrong[] = {
        { .count = (size_t)1 << 31 },     { .count = UINT32_MAX },           { .count = 6 },
        { .count = 3, .first = 1 },       { .count = 3, .base_vertex = -1 }, { .count = 3, .base_vertex = INT32_MAX },
        { .count = 3, .vertex_count = 2 }
    };
    lom_error error;
    CHECK(draw((lom_draw_desc){ .count = 3 }, &error), "%s", error.text);
    CHECK(draw((lom_draw_desc){ .count = 0, .first = 9 }, &error), "%s", error.text);
    CHECK(draw((lom_draw_desc){ .count = 3, .first = 1, .base_vertex = -1 }, &error), "%s", error.text);
    CHECK(draw((lom_draw_desc){ .count = 3, .indices = beyond }, &error), "an index beyond drops its triangle: %s",
          error.text);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        CHECK(!draw(wrong[i], &error) && is_sentence(&error), "wrong draw %zu: \"%s\"", i, error.text);
}

static void draws_are_what_a_draw_can_be(void)
{
    static const uint32_t indices[3] = { 0, 1, 2 };
    const lom_draw_desc wrong[] = { { .count = 3, .indices = indices, .index_bits = 8 },
                                    { .count = 3, .indices = indices, .index_bits = -32 },
                                    { .count = 3, .instances = -1 },
                                    { .count = 3, .topology = LOM_LINE_STRIP + 1 },
                                    { .count = 3, .topology = -1 },
                                    { .count = 3, .provoking = LOM_PROVOKING_FIRST + 1 },
                                    { .count = 3, .provoking = -1 },
                                    { .count = 3, .divisor[0] = -1 },
                                    { .count = 3, .divisor[0] = 2, .instances = 7 }, /* takes 4 values of 3 */
                                    { .count = 3, .depth_bias = __builtin_inff() },
                                    { .count = 3, .depth_bias_slope = __builtin_nanf("") },
                                    { .count = (size_t)1 << 32, .indices = indices },
                                    { .count = 3, .first = (size_t)1 << 32, .indices = indices },
                                    { .count = 3, .attribute[0] = { NULL, 0, 0, -1 } },
                                    { .count = 3, .attribute[0] = { NULL, 0, 0, LOM_ATTRIBUTE_UNORM8X4 + 1 } } };
    lom_error error;
    CHECK(draw((lom_draw_desc){ .count = 3, .indices = indices, .index_bits = 32 }, &error), "%s", error.text);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        CHECK(!draw(wrong[i], &error) && is_sentence(&error), "wrong draw %zu: \"%s\"", i, error.text);
}

static void shaders_declare_what_a_shader_may_have(void)
{
    static const struct {
        int attributes, varyings, clips, culls, colors;
        uint32_t reads, differentiates;
        size_t uniforms_size;
    } wrong[] = { { .attributes = -1 },
                  { .attributes = LOM_MAX_ATTRIBUTES + 1 },
                  { .varyings = -1 },
                  { .varyings = LOM_MAX_VARYINGS + 1 },
                  { .clips = -1 },
                  { .culls = -1 },
                  { .clips = LOM_MAX_DISTANCES, .culls = 1 },
                  { .colors = -1 },
                  { .colors = LOM_MAX_COLORS + 1 },
                  { .varyings = 2, .reads = 1u << 0, .differentiates = 1u << 1 },
                  { .uniforms_size = 4 } };
    lom_error error;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        lom_shader shader = plain;
        shader.attributes = wrong[i].attributes;
        shader.varyings = wrong[i].varyings;
        shader.clip_distances = wrong[i].clips;
        shader.cull_distances = wrong[i].culls;
        shader.colors = wrong[i].colors;
        shader.reads = wrong[i].reads;
        shader.differentiates = wrong[i].differentiates;
        shader.uniforms_size = wrong[i].uniforms_size;
        CHECK(!draw((lom_draw_desc){ .count = 3, .shader = &shader }, &error) && is_sentence(&error),
              "wrong shader %zu: \"%s\"", i, error.text);
    }
    lom_shader nothing = plain;
    memset(nothing.vertex, 0, sizeof nothing.vertex);
    CHECK(!draw((lom_draw_desc){ .count = 3, .shader = &nothing }, &error) && strstr(error.text, "no width") != NULL,
          "\"%s\"", error.text);
}

/* A pass begins outside any other and ends once; draws belong into one. */
static void passes_do_not_nest(void)
{
    static const char *const says[] = { "inside another", "outside a pass", "not begun", "different sizes" };
    for (int wrong = 0; wrong < 4; wrong++) {
        lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
        lom_texture *target = lom_make_texture(device, &(lom_texture_desc){ .width = 8, .height = 8 });
        lom_texture *other = lom_make_texture(device, &(lom_texture_desc){ .width = 8, .height = 9 });
        const lom_pass_desc pass = { .color = { target } }, two = { .color = { target, other } };
        lom_begin_pass(device, &pass);
        CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
        if (wrong == 0) {
            lom_begin_pass(device, &pass);
            lom_begin_pass(device, &pass);
        }
        if (wrong == 1)
            lom_draw(device, &(lom_draw_desc){ .shader = &plain });
        if (wrong == 3)
            lom_begin_pass(device, &two);
        CHECK(!lom_end_pass(device) && is_sentence(lom_device_error(device)) &&
                  strstr(lom_device_error(device)->text, says[wrong]) != NULL,
              "%d: \"%s\"", wrong, lom_device_error(device)->text);
        lom_close_device(device);
    }
}

static void devices_out_of_range_are_refused(void)
{
    static const lom_device_desc wrong[] = { { .threads = -1 }, { .threads = 257 }, { .lanes = 5 },     { .lanes = -4 },
                                             { .lanes = 32 },   { .tile = 8 },      { .tile = 128 },    { .tile = 48 },
                                             { .chunk = 15 },   { .chunk = -1 },    { .chunk = 65537 }, { .batch = -1 },
                                             { .batch = 1025 } };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        lom_device *device = lom_open_device(&wrong[i]);
        CHECK(is_sentence(lom_device_error(device)), "wrong device %zu: \"%s\"", i, lom_device_error(device)->text);
        CHECK(lom_make_texture(device, &(lom_texture_desc){ .width = 1, .height = 1 }) == NULL, "it makes textures");
        lom_close_device(device);
    }
}

/* ---- numbers ---- */

typedef bool take_number(double x, lom_error *error);

static bool take_sky(const lom_sky_box_desc *desc, lom_error *error)
{
    lom_image *faces[6];
    bool made = lom_make_sky_box(desc, faces, error);
    for (int i = 0; i < 6; i++)
        lom_free_image(faces[i]);
    return made;
}

static bool take_azimuth(double x, lom_error *error)
{
    return take_sky(&(lom_sky_box_desc){ .size = 8, .sun_azimuth = x }, error);
}

static bool take_elevation(double x, lom_error *error)
{
    return take_sky(&(lom_sky_box_desc){ .size = 8, .sun_elevation = x }, error);
}

static bool take_haziness(double x, lom_error *error)
{
    return take_sky(&(lom_sky_box_desc){ .size = 8, .haziness = x }, error);
}

static bool take_cloudiness(double x, lom_error *error)
{
    return take_sky(&(lom_sky_box_desc){ .size = 8, .cloudiness = x }, error);
}

static bool take_image(lom_image *image)
{
    lom_free_image(image);
    return image != NULL;
}

static bool take_mesh(lom_mesh *mesh)
{
    lom_free_mesh(mesh);
    return mesh != NULL;
}

static bool take_rays(double x, lom_error *error)
{
    return take_image(lom_make_sun_picture(8, x, error));
}

static bool take_roughness(double x, lom_error *error)
{
    return take_image(lom_make_normal_map(&(lom_normal_map_desc){ .size = 128, .roughness = x }, error));
}

static bool take_radius(double x, lom_error *error)
{
    return take_mesh(lom_make_sphere(x, 8, 8, error));
}

static bool take_crease(double x, lom_error *error)
{
    lom_mesh_builder *builder = lom_create_mesh_builder(error);
    for (int i = 0; i < 3; i++)
        lom_builder_vertex(builder, (lom_vec3){ i == 1, i == 2, 0 }, 0, 0);
    lom_builder_triangle(builder, 0, 1, 2);
    return take_mesh(lom_finish_mesh(builder, x, error));
}

static bool take_position(double x, lom_error *error)
{
    lom_mesh_builder *builder = lom_create_mesh_builder(error);
    for (int i = 0; i < 3; i++)
        lom_builder_vertex(builder, (lom_vec3){ i == 1 ? x : 0, i == 2, 0 }, 0, 0);
    lom_builder_triangle(builder, 0, 1, 2);
    return take_mesh(lom_finish_mesh(builder, 0, error));
}

static bool take_wind(double x, lom_error *error)
{
    lom_sea_desc resolved;
    return lom_resolve_sea(&(lom_sea_desc){ .wind_speed = x }, &resolved, error);
}

static bool take_lod(double x, lom_error *error)
{
    lom_texture *texture =
        lom_create_texture(&(lom_texture_desc){ .width = 1, .height = 1, .sampler = { .lod_bias = (float)x } }, error);
    lom_free_texture(texture);
    return texture != NULL;
}

static void numbers_out_of_range_are_refused(void)
{
    static const struct {
        const char *name;
        take_number *take;
        double good;
        bool bounded; /* infinity is refused, too */
    } numbers[] = { { "azimuth", take_azimuth, 1, true },   { "elevation", take_elevation, 0.5, true },
                    { "haziness", take_haziness, 1, true }, { "cloudiness", take_cloudiness, 0.5, true },
                    { "rays", take_rays, 0.5, true },       { "roughness", take_roughness, 0.3, true },
                    { "radius", take_radius, 1, true },     { "crease", take_crease, 1, true },
                    { "position", take_position, 1, true }, { "wind", take_wind, 5, true },
                    { "lod bias", take_lod, 0.5, false } };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const double bad[] = { __builtin_nan(""), __builtin_inf(), -__builtin_inf() };
        lom_error error = { 0 };
        CHECK(numbers[i].take(numbers[i].good, &error), "%s of %g: %s", numbers[i].name, numbers[i].good, error.text);
        for (int k = 0; k < (numbers[i].bounded ? 3 : 1); k++) {
            error = (lom_error){ 0 };
            CHECK(!numbers[i].take(bad[k], &error) && is_sentence(&error), "%s of %g: \"%s\"", numbers[i].name, bad[k],
                  error.text);
        }
    }
}

int main(int argc, char **argv)
{
    RUN(null_is_the_zero_descriptor);
    RUN(a_device_that_filters_in_fixed_point_makes_such_textures);
    RUN(a_null_device_is_one_that_has_failed);
    RUN(textures_belong_to_their_device);
    RUN(textures_are_updated_by_their_device);
    RUN(vertices_that_are_drawn_exist);
    RUN(draws_are_what_a_draw_can_be);
    RUN(shaders_declare_what_a_shader_may_have);
    RUN(passes_do_not_nest);
    RUN(devices_out_of_range_are_refused);
    RUN(numbers_out_of_range_are_refused);
    return check_result();
}
