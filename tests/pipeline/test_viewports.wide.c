/* Proves that draws of one pass may have several viewports at this width: their pixels are those of as many passes
 * with a viewport each, bit for bit, whatever is drawn, with any samples, tiles and threads, and in any crop; each
 * ends at the edges of its own viewport and has its own range of depths; what is no viewport is refused. */
#include "stage.h"

enum { WIDTH = 150, HEIGHT = 110, VERTICES = 240, DRAWS = 5 };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->distance[0] = in->attribute[3].x;
    out->point_size = 4.0f + 16.0f * lom_abs(in->attribute[1].x);
}

static void place_sprites(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_float zero = { 0 };
    place_values(out, in, uniforms);
    out->axis[0] = (lom_float4){ in->attribute[1].x * 0.3f, in->attribute[1].y * 0.2f, zero, zero };
    out->axis[1] = (lom_float4){ -in->attribute[1].y * 0.2f, in->attribute[1].x * 0.3f, zero, zero };
}

/* All that depends on where a pixel lies. */
static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0] + in->x * 0x1p-8f, in->varying[1] + in->y * 0x1p-8f, in->z, in->w };
}

static void show_slopes(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], lom_dx(in, 1), lom_dy(in, 1), in->varying[2] };
}

LOM_SHADER(solid, place, show, .attributes = 5, .varyings = 4, .clip_distances = 1, .reads = LOM_VARYINGS(0, 2),
           .reads_position = true, .colors = 1)
LOM_SHADER(sloped, place, show_slopes, .attributes = 5, .varyings = 4, .reads = LOM_VARYINGS(0, 3),
           .differentiates = LOM_VARYINGS(1, 1), .colors = 1)
LOM_SHADER(plates, place_sprites, show, .attributes = 5, .varyings = 4, .reads = LOM_VARYINGS(0, 2),
           .reads_position = true, .colors = 1, .sprites = true)

static vertex vertices[VERTICES];

static const struct {
    const lom_shader *shader;
    lom_topology topology;
    int line_width;
} kinds[] = { { &solid, LOM_TRIANGLES, 0 },   { &sloped, LOM_TRIANGLE_STRIP, 0 }, { &solid, LOM_LINES, 1 },
              { &sloped, LOM_LINE_STRIP, 5 }, { &solid, LOM_POINTS, 0 },          { &plates, LOM_SPRITES, 0 } };
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* Small and large triangles in perspective, some of them cut by the near plane, the guard band and a distance. */
static void make_vertices(void)
{
    for (int i = 0; i < VERTICES; i++) {
        float w = random_float(0.5f, 4), r = i / 3 % 4 == 0 ? 1.5f : i / 3 % 31 == 1 ? 3000 : 0.4f;
        vertex *v = &vertices[i];
        const vertex *first = &vertices[i / 3 * 3];
        for (int axis = 0; axis < 2; axis++)
            v->position[axis] = i % 3 == 0 ? random_float(-1.2f, 1.2f) * w
                                           : (first->position[axis] / first->position[3] + random_float(-r, r)) * w;
        v->position[2] = random_float(-0.1f, 0.9f) * w;
        v->position[3] = w;
        for (int k = 0; k < 8; k++)
            v->value[k] = random_float(-1, 1);
        v->distance[0] = i % 5 == 0 ? -0.3f : 1;
    }
}

/* Corners on odd places, of all sizes, over one another, partly and wholly beyond the frame; two with scissors. */
static lom_draw_desc draw_number(int draw, int kind)
{
    static const lom_rect views[DRAWS] = {
        { 3, 5, 70, 61 }, { 51, 33, 97, 40 }, { -37, 60, 90, 80 }, { 101, -9, 300, 37 }, { 149, 0, 1, 110 }
    };
    static const float depths[DRAWS][2] = { { 0, 0 }, { 0.5f, 1 }, { 1, 0 }, { 0.25f, 0.5f }, { 0, 1 } };
    lom_draw_desc desc = draw_of(kinds[kind].shader, vertices, VERTICES);
    desc.topology = kinds[kind].topology;
    desc.line_width = kinds[kind].line_width;
    desc.viewport = views[draw];
    desc.min_depth = depths[draw][0];
    desc.max_depth = depths[draw][1];
    if (draw == 1 || draw == 2)
        desc.scissor = (lom_rect){ 20, 40, 61, 35 };
    return desc;
}

static stage open_viewports(int samples, int width, int height, lom_device_desc how)
{
    stage s = { .device = open_device(how) };
    lom_texture_desc desc = { .width = width, .height = height, .format = LOM_FORMAT_RGBA32F, .samples = samples };
    s.color = lom_make_texture(s.device, &desc);
    desc.format = LOM_FORMAT_DEPTH32F;
    s.depth = lom_make_texture(s.device, &desc);
    return s;
}

static lom_pass_desc pass_of(int samples)
{
    return (lom_pass_desc){
        .samples = samples, .clear_color = { { 9, 8, 7, 6 } }, .frame_width = WIDTH, .frame_height = HEIGHT
    };
}

/* All draws in one pass. */
static void draw_at_once(stage *s, lom_pass_desc pass, int kind)
{
    begin(s, pass);
    for (int i = 0; i < DRAWS; i++) {
        lom_draw_desc desc = draw_number(i, kind);
        lom_draw(s->device, &desc);
    }
    finish(s);
}

/* A pass for each. */
static void draw_apart(stage *s, lom_pass_desc pass, int kind)
{
    for (int i = 0; i < DRAWS; i++) {
        lom_draw_desc desc = draw_number(i, kind);
        pass.viewport = desc.viewport;
        pass.min_depth = desc.min_depth;
        pass.max_depth = desc.max_depth;
        desc.viewport = (lom_rect){ 0 };
        desc.min_depth = desc.max_depth = 0;
        begin(s, pass);
        lom_draw(s->device, &desc);
        finish(s);
        pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    }
}

static void viewports_of_a_pass_are_passes_with_a_viewport(void)
{
    for (int samples = 1; samples <= 4; samples *= 4)
        for (int kind = 0; kind < KINDS; kind++) {
            make_vertices();
            stage one = open_viewports(samples, WIDTH, HEIGHT, (lom_device_desc){ .threads = 1 });
            stage many = open_viewports(samples, WIDTH, HEIGHT, (lom_device_desc){ .threads = 1 });
            draw_at_once(&one, pass_of(samples), kind);
            draw_apart(&many, pass_of(samples), kind);
            CHECK(same_images(one.image, many.image), "kind %d, %d samples: colours", kind, samples);
            CHECK(same_images(one.depths, many.depths), "kind %d, %d samples: depths", kind, samples);
            int drawn = 0;
            for (int p = 0; p < WIDTH * HEIGHT; p++)
                drawn += floats_at(&one, p % WIDTH, p / WIDTH)[3] != 6;
            CHECK(drawn > 500, "kind %d: %d pixels", kind, drawn);
            close_stage(&one);
            close_stage(&many);
        }
}

/* Tiles, chunks and threads change nothing, and a crop is a cut-out. */
static void several_viewports_depend_on_no_tile_and_no_crop(void)
{
    static const lom_device_desc ways[] = { { .threads = 3, .tile = 16, .chunk = 16, .batch = 1 },
                                            { .threads = 2, .tile = 32, .chunk = 64 } };
    enum { CROP = 57, LEFT = 43, TOP = 29 };
    for (int kind = 0; kind < KINDS; kind++) {
        make_vertices();
        stage whole = open_viewports(1, WIDTH, HEIGHT, (lom_device_desc){ .threads = 1 });
        stage crop = open_viewports(1, CROP, CROP, (lom_device_desc){ .threads = 1 });
        draw_at_once(&whole, pass_of(1), kind);
        for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
            stage other = open_viewports(1, WIDTH, HEIGHT, ways[i]);
            draw_at_once(&other, pass_of(1), kind);
            CHECK(same_images(whole.image, other.image) && same_images(whole.depths, other.depths), "kind %d, way %zu",
                  kind, i);
            close_stage(&other);
        }
        lom_pass_desc pass = pass_of(1);
        pass.origin_x = LEFT;
        pass.origin_y = TOP;
        draw_at_once(&crop, pass, kind);
        for (int y = 0; y < CROP; y++)
            CHECK(memcmp(floats_at(&crop, 0, y), floats_at(&whole, LEFT, TOP + y), CROP * 16) == 0, "kind %d, row %d",
                  kind, y);
        close_stage(&whole);
        close_stage(&crop);
    }
}

/* What is drawn of each kind lies inside the draw's viewport and scissor, and reaches the viewport's corners. */
static void a_draw_ends_at_its_viewport(void)
{
    const lom_rect view = { 21, 14, 67, 50 };
    for (int kind = 0; kind < KINDS; kind++) {
        stage s = open_viewports(1, WIDTH, HEIGHT, (lom_device_desc){ .threads = 1 });
        make_vertices();
        for (int i = 0; i < VERTICES; i++)
            vertices[i].position[2] = 0.5f * vertices[i].position[3];
        lom_draw_desc desc = draw_number(0, kind);
        desc.viewport = view;
        begin(&s, pass_of(1));
        lom_draw(s.device, &desc);
        finish(&s);
        int low[2] = { WIDTH, HEIGHT }, high[2] = { -1, -1 };
        for (int p = 0; p < WIDTH * HEIGHT; p++) {
            const int at[2] = { p % WIDTH, p / WIDTH };
            for (int axis = 0; axis < 2 && floats_at(&s, at[0], at[1])[3] != 6; axis++) {
                low[axis] = at[axis] < low[axis] ? at[axis] : low[axis];
                high[axis] = at[axis] > high[axis] ? at[axis] : high[axis];
            }
        }
        CHECK(low[0] == view.x && low[1] == view.y && high[0] == view.x + view.width - 1 &&
                  high[1] == view.y + view.height - 1,
              "kind %d: pixels %d,%d to %d,%d", kind, low[0], low[1], high[0], high[1]);
        close_stage(&s);
    }
}

/* A plane at z / w = 1/4 has the depth low + (high - low) / 4 of its own draw's range. */
static void each_draw_has_its_range_of_depths(void)
{
    static const float ranges[][2] = { { 0, 0 }, { 0, 1 }, { 0.5f, 1 }, { 1, 0 }, { 0.75f, 0.25f }, { 0.5f, 0.5f } };
    enum { RANGES = sizeof ranges / sizeof ranges[0] };
    stage s = open_viewports(1, WIDTH, HEIGHT, (lom_device_desc){ .threads = 1 });
    static const float corners[3][2] = { { -1, 1 }, { -1, -3 }, { 3, 1 } };
    for (int k = 0; k < 3; k++)
        vertices[k] = (vertex){ .position = { corners[k][0], corners[k][1], 0.25f, 1 }, .distance = { 1 } };
    lom_pass_desc pass = pass_of(1);
    pass.min_depth = 0.125f; /* of draws that name no range */
    pass.max_depth = 0.625f;
    begin(&s, pass);
    for (int i = 0; i < RANGES; i++) {
        lom_draw_desc desc = draw_of(&solid, vertices, 3);
        desc.viewport = (lom_rect){ 20 * i, 10, 20, 20 };
        desc.min_depth = ranges[i][0];
        desc.max_depth = ranges[i][1];
        desc.depth_compare = LOM_COMPARE_ALWAYS;
        lom_draw(s.device, &desc);
    }
    finish(&s);
    for (int i = 0; i < RANGES; i++) {
        const float low = i == 0 ? 0.125f : ranges[i][0], high = i == 0 ? 0.625f : ranges[i][1];
        const float *found = lom_image_pixel(s.depths, 20 * i + 10, 20, 0);
        CHECK(*found == low + (high - low) * 0.25f, "range %d: %g", i, (double)*found);
    }
    close_stage(&s);
}

static void impossible_viewports_are_refused(void)
{
    static const lom_draw_desc bad[] = { { .viewport = { 0, 0, 8, 0 } },
                                         { .viewport = { 0, 0, -1, 8 } },
                                         { .viewport = { 0, 0, 8, 32769 } },
                                         { .viewport = { 40000, 0, 8, 8 } },
                                         { .viewport = { 0, -40000, 8, 8 } },
                                         { .min_depth = -0.5f },
                                         { .max_depth = 1.5f },
                                         { .min_depth = __builtin_nanf("") } };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        stage s = open_viewports(1, WIDTH, HEIGHT, (lom_device_desc){ .threads = 1 });
        make_vertices();
        lom_draw_desc desc = draw_of(&solid, vertices, VERTICES);
        desc.viewport = bad[i].viewport;
        desc.min_depth = bad[i].min_depth;
        desc.max_depth = bad[i].max_depth;
        begin(&s, pass_of(1));
        lom_draw(s.device, &desc);
        CHECK(!lom_end_pass(s.device) && lom_device_error(s.device)->code == LOM_ERROR_USAGE &&
                  lom_device_error(s.device)->text[0] != 0,
              "case %zu is taken", i);
        close_stage(&s);
    }
}

int main(int argc, char **argv)
{
    RUN(viewports_of_a_pass_are_passes_with_a_viewport);
    RUN(several_viewports_depend_on_no_tile_and_no_crop);
    RUN(a_draw_ends_at_its_viewport);
    RUN(each_draw_has_its_range_of_depths);
    RUN(impossible_viewports_are_refused);
    return check_result();
}
