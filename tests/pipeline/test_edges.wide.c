/* Proves of edges (lom/pipeline.h): a texel says where the triangle of its pixel ends, or the clip distance that cuts it, as
 * arithmetic in double says, whichever path the triangle takes; colours and depths are those of a pass without; what does
 * not write depth leaves them. Of the filter: beside one straight edge of any slope each pixel has the light of the parts on
 * either side, to a step of what the texture holds; where no depth jumps it changes no byte; windows of pixels are as other packets are; bad passes are refused. */
#include "stage.h"

enum { SIZE = 64, EDGES = 4 }; /* right, left, down, up */

static const lom_texture_desc marks = { .width = SIZE, .height = SIZE, .format = LOM_FORMAT_RGBA8 };

LOM_SHADER(shown, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

LOM_INLINE void place_cut(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->distance[0] = in->attribute[3].x;
}

LOM_SHADER(cut, place_cut, show_values, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .clip_distances = 1, .colors = 1)

LOM_INLINE void show_some(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->discard = in->varying[0] > 0.75f;
}

LOM_SHADER(holed, place_values, show_some, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .discards = true, .colors = 1)

/* ---- where triangles end ---- */

/* The number of the texture where an affine function, positive inside, has this value and this change a pixel. */
static double number_of(double value, double step)
{
    return step < 0 ? value / (value - step) : 1;
}

/* Of the pixel to the right, left, down, up: the least of the three edges of a triangle. */
static void find_numbers(const snapped v[3], int px, int py, double number[EDGES])
{
    double area = (double)((v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x));
    for (int i = 0; i < EDGES; i++)
        number[i] = 1;
    for (int k = 0; k < 3; k++) {
        const snapped *p = &v[k], *q = &v[(k + 1) % 3];
        double dx = (double)(q->x - p->x), dy = (double)(q->y - p->y), sign = area < 0 ? -1 : 1;
        double value = sign * (dx * (256 * py + 128 - (double)p->y) - dy * (256 * px + 128 - (double)p->x));
        double step[EDGES] = { -sign * dy * 256, sign * dy * 256, sign * dx * 256, -sign * dx * 256 };
        for (int i = 0; i < EDGES; i++) {
            double here = number_of(value, step[i]);
            number[i] = here < number[i] ? here : number[i];
        }
    }
}

static void begin_marked(stage *s, lom_texture *edges, lom_load_action load)
{
    begin(s, (lom_pass_desc){ .edges = edges,
                              .color_load = { load },
                              .depth_load = load,
                              .edges_load = load,
                              .clear_color = { { 0, 0, 0, 0 } } });
}

static bool is_near(uint8_t code, double number)
{
    double away = code - number * 255;
    return away < 0.51 && away > -0.51;
}

/* One triangle, and many of one draw, which are packed. */
static void texels_say_where_triangles_end(void)
{
    static const int64_t reach[] = { 700, 3000, 16000, 300000 }; /* units: windows, small ones, large ones, huge ones */
    static const lom_shader *const shaders[] = { &shown, &holed };
    for (int round = 0; round < 64; round++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 + round % 2, .tile = round % 3 == 0 ? 16 : 64 }, SIZE,
                             SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
        lom_texture *edges = lom_make_texture(s.device, &marks);
        vertex v[3 * 8] = { 0 };
        const int count = round % 4 < 2 ? 8 : 1;
        for (int i = 0; i < 3 * count; i++) {
            int64_t r = reach[round / 2 % 4], x = random_whole(0, SIZE * 256), y = random_whole(0, SIZE * 256);
            bool first = i % 3 == 0;
            place_at(&v[i], first ? x : random_whole(-r, r) + SIZE * 128, first ? y : random_whole(-r, r) + SIZE * 128,
                     SIZE);
            v[i].position[2] = 0.1f + 0.1f * (float)(i / 3);
            v[i].value[0] = v[i].value[1] = (float)(i / 3 + 1) / 16;
        }
        begin_marked(&s, edges, LOM_LOAD_CLEAR);
        lom_draw_desc draw = draw_of(shaders[round / 32], v, 3 * (size_t)count);
        lom_draw(s.device, &draw);
        finish(&s);
        lom_image *image = lom_read_texture(edges, 0, 0, NULL);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                const uint8_t *code = lom_image_pixel(image, x, y, 0);
                double number[EDGES] = { 1, 1, 1, 1 };
                for (int t = 0; t < count; t++) { /* the last ones are the nearest */
                    snapped corner[3];
                    for (int k = 0; k < 3; k++)
                        corner[k] = snap(v[3 * t + k].position, SIZE, SIZE);
                    if (covers(corner, x, y))
                        find_numbers(corner, x, y, number);
                }
                for (int i = 0; i < EDGES; i++)
                    CHECK(is_near(code[i], number[i]), "round %d, pixel %d,%d: %d for %g of 255, edge %d", round, x, y,
                          code[i], number[i] * 255, i);
            }
        lom_free_image(image);
        close_stage(&s);
    }
}

static void texels_say_where_clip_distances_cut(void)
{
    stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    lom_texture *edges = lom_make_texture(s.device, &marks);
    static const int64_t corner[3][2] = { { -9000, -9000 }, { 60000, -9000 }, { -9000, 60000 } };
    snapped on[3];
    for (int round = 0; round < 16; round++) {
        double a = (double)random_float(-1, 1), b = (double)random_float(-1, 1),
               c = -a * 31 - b * 33; /* a x + b y + c, of pixels */
        vertex v[3] = { 0 };
        for (int i = 0; i < 3; i++) {
            place_at(&v[i], corner[i][0], corner[i][1], SIZE);
            v[i].distance[0] = (float)(a * (double)corner[i][0] / 256 + b * (double)corner[i][1] / 256 + c);
            v[i].value[0] = 1;
            on[i] = snap(v[i].position, SIZE, SIZE);
        }
        begin_marked(&s, edges, LOM_LOAD_CLEAR);
        lom_draw_desc draw = draw_of(&cut, v, 3);
        lom_draw(s.device, &draw);
        finish(&s);
        lom_image *image = lom_read_texture(edges, 0, 0, NULL);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                const double value = a * (x + 0.5) + b * (y + 0.5) + c, step[EDGES] = { a, -a, b, -b };
                const uint8_t *code = lom_image_pixel(image, x, y, 0);
                double number[EDGES] = { 1, 1, 1, 1 };
                if (value > 0)
                    find_numbers(on, x, y, number);
                for (int i = 0; i < EDGES && (value > 1e-4 || value < -1e-4); i++) {
                    double here = value > 0 ? number_of(value, step[i]) : 1, away;
                    number[i] = here < number[i] ? here : number[i];
                    away = code[i] - number[i] * 255;
                    CHECK(away < 0.6 && away > -0.6, "round %d, pixel %d,%d: %d for %g of 255, edge %d", round, x, y,
                          code[i], number[i] * 255, i);
                }
            }
        lom_free_image(image);
    }
    close_stage(&s);
}

/* ---- what does not change ---- */

static void fill_soup(vertex *v, int count)
{
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++)
            v[i].position[c] = random_float(c == 2 ? 0 : -1.2f, c == 2 ? 1 : 1.2f);
        v[i].position[3] = 1;
        for (int c = 0; c < 4; c++)
            v[i].value[c] = random_float(0, 1);
    }
}

static void colours_and_depths_are_those_of_a_pass_without(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA32F };
    static vertex v[3 * 200];
    for (int f = 0; f < 3; f++) {
        stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, formats[f], LOM_FORMAT_DEPTH32F);
        lom_texture *edges = lom_make_texture(s.device, &marks);
        lom_image *kept[2], *before = NULL;
        fill_soup(v, 600);
        for (int with = 0; with < 2; with++) {
            begin_marked(&s, with ? edges : NULL, LOM_LOAD_CLEAR);
            lom_draw_desc draw = draw_of(&shown, v, 300), blended = draw_of(&shown, v + 300, 300);
            lom_draw(s.device, &draw);
            blended.blend[0] = adding();
            blended.depth_write_off = true;
            lom_draw(s.device, &blended);
            finish(&s);
            kept[0] = with ? kept[0] : s.image;
            kept[1] = with ? kept[1] : s.depths;
            if (!with)
                s.image = s.depths = NULL;
        }
        CHECK(same_images(kept[0], s.image) && same_images(kept[1], s.depths), "format %d differs", f);
        before = lom_read_texture(edges, 0, 0, NULL);
        begin_marked(&s, edges, LOM_LOAD_KEEP);
        lom_draw_desc over = draw_of(&shown, v + 300, 300);
        over.depth_write_off = true;
        lom_draw(s.device, &over);
        finish(&s);
        lom_image *after = lom_read_texture(edges, 0, 0, NULL);
        CHECK(same_images(before, after), "a draw that writes no depth has changed edges");
        lom_free_image(before);
        lom_free_image(after);
        lom_free_image(kept[0]);
        lom_free_image(kept[1]);
        close_stage(&s);
    }
}

/* ---- the filter ---- */

static void smooth(stage *s, lom_texture *edges, lom_texture *to)
{
    const lom_edge_filter filter = { .color = s->color, .edges = edges, .depth = s->depth };
    lom_begin_pass(s->device, &(lom_pass_desc){ .color = { to } });
    lom_smooth_edges(s->device, &filter);
    CHECK(lom_end_pass(s->device), "%s", lom_device_error(s->device)->text);
    lom_free_image(s->image);
    s->image = lom_read_texture(to, 0, 0, NULL);
}

/* The part of a pixel of which a x + b y < c, from its middle, |a| and |b| not both 0: by rows of a fine grid, each exact. */
static double part_inside(double a, double b, double c)
{
    enum { ROWS = 4096 };
    double sum = 0;
    if ((a < 0 ? -a : a) < (b < 0 ? -b : b)) {
        double other = a;
        a = b;
        b = other;
    }
    for (int i = 0; i < ROWS; i++) {
        double x = (c - b * ((i + 0.5) / ROWS - 0.5)) / a, part = (a > 0 ? x : -x) + 0.5;
        sum += part < 0 ? 0 : part > 1 ? 1 : part;
    }
    return sum / ROWS;
}

/* A triangle so large that one edge is seen, black before white: a x + b y = c from the window's middle. */
static void a_straight_edge_leaves_each_pixel_the_light_of_its_parts(void)
{
    stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    lom_texture *edges = lom_make_texture(s.device, &marks);
    lom_texture *to =
        lom_make_texture(s.device, &(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = LOM_FORMAT_RGBA8 });
    double worst = 0;
    for (int round = 0; round < 48; round++) {
        const int64_t x0 = random_whole(-200, 200) + SIZE * 128, y0 = random_whole(-200, 200) + SIZE * 128;
        const int64_t other = random_whole(-40000, 40000), one = random_whole(0, 1) == 0 ? -40000 : 40000;
        const int64_t ex = round < 2        ? 0
                           : round % 2 == 0 ? one
                                            : other,
                      ey = round < 4        ? one
                           : round % 2 == 0 ? other
                                            : one;
        const int64_t corner[3][2] = { { x0 - ex, y0 - ey }, { x0 + ex, y0 + ey }, { x0 - 40 * ey, y0 + 40 * ex } };
        vertex v[3] = { 0 };
        for (int i = 0; i < 3; i++)
            place_at(&v[i], corner[i][0], corner[i][1], SIZE);
        begin(&s, (lom_pass_desc){ .edges = edges, .clear_color = { { 1, 1, 1, 1 } } });
        lom_draw_desc draw = draw_of(&shown, v, 3);
        lom_draw(s.device, &draw);
        finish(&s);
        smooth(&s, edges, to);
        for (int y = 2; y < SIZE - 2; y++)
            for (int x = 2; x < SIZE - 2; x++) {
                double px = 256 * x + 128 - (double)x0, py = 256 * y + 128 - (double)y0;
                double a = (double)ey / 256, b = -(double)ex / 256, c = -(px * a + py * b) / 256;
                double light = a * a + b * b > 0 ? part_inside(-a, -b, -c) : 0;
                double away = bytes_at(&s, x, y)[0] - light * 255;
                away = away < 0 ? -away : away;
                worst = away > worst ? away : worst;
                CHECK(away < 4, "round %d, pixel %d,%d: %d for %g (edge %lld,%lld)", round, x, y, bytes_at(&s, x, y)[0],
                      light * 255, (long long)ex, (long long)ey);
            }
    }
    CHECK(worst > 0.4 && worst < 4, "the worst is %g of 255", worst);
    close_stage(&s);
}

/* A plane seen at a slant, of many triangles and colours. */
static void where_no_depth_jumps_no_byte_changes(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA32F };
    enum { CELLS = 12 };
    static vertex v[CELLS * CELLS * 6];
    int count = 0;
    for (int i = 0; i < CELLS * CELLS; i++)
        for (int k = 0; k < 6; k++, count++) {
            static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 0, 1 }, { 1, 0 }, { 1, 1 } };
            float x = (float)(i % CELLS + corner[k][0]) / CELLS * 2.4f - 1.2f,
                  y = (float)(i / CELLS + corner[k][1]) / CELLS * 2.4f - 1.2f;
            v[count] = (vertex){ { x, y, 0.5f + 0.1f * x + 0.2f * y, 1 },
                                 { random_float(0, 1), random_float(0, 1), 1, 1 },
                                 { 0 } };
        }
    for (int f = 0; f < 3; f++) {
        stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, formats[f], LOM_FORMAT_DEPTH32F);
        lom_texture *edges = lom_make_texture(s.device, &marks);
        lom_texture *to =
            lom_make_texture(s.device, &(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = formats[f] });
        begin_marked(&s, edges, LOM_LOAD_CLEAR);
        lom_draw_desc draw = draw_of(&shown, v, (size_t)count);
        lom_draw(s.device, &draw);
        finish(&s);
        lom_image *sharp = s.image;
        s.image = NULL;
        smooth(&s, edges, to);
        CHECK(same_images(sharp, s.image), "a plane of format %d is changed", f);
        lom_free_image(sharp);
        close_stage(&s);
    }
}

/* Columns of one pixel are packets of no window: each texel is fetched by its index. */
static void windows_are_looked_at_as_columns_are(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA32F };
    static vertex v[120 * 3];
    for (int f = 0; f < 3; f++) {
        stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, formats[f], LOM_FORMAT_DEPTH32F);
        const lom_texture_desc desc = { .width = SIZE, .height = SIZE, .format = formats[f] };
        lom_texture *edges = lom_make_texture(s.device, &marks), *whole = lom_make_texture(s.device, &desc);
        lom_texture *columns = lom_make_texture(s.device, &desc);
        for (int i = 0; i < 120 * 3; i++)
            v[i] = (vertex){ { random_float(-1, 1), random_float(-1, 1), random_float(0.1f, 1), 1 },
                             { random_float(0, 1), random_float(0, 1), random_float(0, 1), 1 },
                             { 0 } };
        begin_marked(&s, edges, LOM_LOAD_CLEAR);
        lom_draw_desc draw = draw_of(&shown, v, 120 * 3);
        lom_draw(s.device, &draw);
        finish(&s);
        smooth(&s, edges, whole);
        const lom_edge_filter filter = { .color = s.color, .edges = edges, .depth = s.depth };
        for (int x = 0; x < SIZE; x++) {
            lom_begin_pass(s.device, &(lom_pass_desc){ .color = { columns },
                                                       .color_load = { x > 0 ? LOM_LOAD_KEEP : LOM_LOAD_CLEAR },
                                                       .scissor = { x, 0, 1, SIZE } });
            lom_smooth_edges(s.device, &filter);
            CHECK(lom_end_pass(s.device), "%s", lom_device_error(s.device)->text);
        }
        lom_image *apart = lom_read_texture(columns, 0, 0, NULL), *sharp = lom_read_texture(s.color, 0, 0, NULL);
        CHECK(same_images(apart, s.image), "windows of format %d differ from columns", f);
        CHECK(!same_images(sharp, s.image), "no edge of format %d is smoothed", f);
        lom_free_image(apart);
        lom_free_image(sharp);
        close_stage(&s);
    }
}

/* ---- what is refused ---- */

static void refuse(lom_pass_desc pass, lom_format format, const char *what)
{
    stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    pass.edges = lom_make_texture(s.device, &(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = format });
    begin(&s, pass);
    CHECK(!lom_end_pass(s.device) && lom_device_error(s.device)->code == LOM_ERROR_USAGE, "%s is not refused", what);
    close_stage(&s);
}

static void bad_passes_are_refused(void)
{
    refuse((lom_pass_desc){ .samples = 4 }, LOM_FORMAT_RGBA8, "a pass of several samples");
    refuse((lom_pass_desc){ .samples = 1 }, LOM_FORMAT_RGBA32F, "a texture of floats");
    stage s = open_stage((lom_device_desc){ 0 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    const lom_edge_filter filter = { .color = s.color, .depth = s.depth };
    begin(&s, (lom_pass_desc){ 0 });
    lom_smooth_edges(s.device, &filter);
    CHECK(!lom_end_pass(s.device) && lom_device_error(s.device)->code == LOM_ERROR_USAGE,
          "a filter without edges is drawn");
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(texels_say_where_triangles_end);
    RUN(texels_say_where_clip_distances_cut);
    RUN(colours_and_depths_are_those_of_a_pass_without);
    RUN(a_straight_edge_leaves_each_pixel_the_light_of_its_parts);
    RUN(where_no_depth_jumps_no_byte_changes);
    RUN(windows_are_looked_at_as_columns_are);
    RUN(bad_passes_are_refused);
    return check_result();
}
