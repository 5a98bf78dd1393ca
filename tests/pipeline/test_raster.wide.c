/* Proves the rules of rasterization at this width, each by name (R1..R12): what a pixel centre on an edge, on a vertex
 * or near a rounding tie does, and what must change nothing: the order of vertices, translation by whole pixels,
 * scissors, crops, repetition. The oracle is that of stage.h. */
#include "stage.h"

enum { SIZE = 128, UNITS = SIZE * 256 };

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    lom_float one = lom_splat(1.0f / 255.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
}

static void add_one(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    lom_float one = lom_splat(1.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
}

LOM_SHADER(counter, place_values, count, .attributes = 1, .colors = 1)
LOM_SHADER(whole_counter, place_values, add_one, .attributes = 1, .colors = 1)
LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

static vertex vertices[3 * 65536];

static void draw_counting(stage *s, size_t triangles)
{
    lom_draw_desc desc = draw_of(&counter, vertices, 3 * triangles);
    desc.blend[0] = adding();
    lom_draw(s->device, &desc);
}

static void put(size_t i, int64_t x, int64_t y, int size)
{
    place_at(&vertices[i], x, y, size);
}

/* Hits of the first `triangles` triangles of vertices in the viewport's rectangle, from the oracle. */
static int hits_of(size_t triangles, int width, int height, int x, int y)
{
    int hits = 0;
    for (size_t t = 0; t < triangles; t++) {
        snapped v[3];
        for (size_t k = 0; k < 3; k++)
            v[k] = snap(vertices[3 * t + k].position, width, height);
        hits += covers(v, x, y);
    }
    return hits;
}

static void check_hits(const stage *s, size_t triangles, int width, int height, const char *what)
{
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int hits = hits_of(triangles, width, height, x, y);
            CHECK(bytes_at(s, x, y)[0] == hits, "%s: pixel %d,%d has %d hits, not %d", what, x, y, bytes_at(s, x, y)[0],
                  hits);
        }
}

/* Arbitrary floats, arbitrary w, viewports of any size: the documented steps of snapping, and coverage. */
static void arbitrary_positions_snap_as_documented(void)
{
    static const int sizes[][2] = { { 97, 61 }, { 1, 1 }, { 200, 3 }, { 3, 200 }, { 64, 64 }, { 33, 129 } };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        stage s = open_stage((lom_device_desc){ .threads = 1 }, width, height, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        for (int pass = 0; pass < 20; pass++) {
            for (int v = 0; v < 3 * 40; v++) {
                float w = random_float(0.01f, 100.0f);
                vertices[v].position[0] = random_float(-1.3f, 1.3f) * w;
                vertices[v].position[1] = random_float(-1.3f, 1.3f) * w;
                vertices[v].position[2] = 0.5f * w;
                vertices[v].position[3] = w;
            }
            begin(&s, (lom_pass_desc){ 0 });
            draw_counting(&s, 40);
            finish(&s);
            check_hits(&s, 40, width, height, "arbitrary");
        }
        close_stage(&s);
    }
}

/* R2: 360 slivers round a vertex at a pixel centre. */
static void a_fan_hits_its_centre_once(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int radius = 300; radius < 20000; radius *= 3) {
        int64_t rim[361][2];
        for (int i = 0; i <= 360; i++) {
            double angle = (i % 360) * 0.017453292519943295;
            rim[i][0] = UNITS / 2 + 128 + (int64_t)lom_double_floor(radius * lom_double_cos(angle) + 0.5);
            rim[i][1] = UNITS / 2 + 128 + (int64_t)lom_double_floor(radius * lom_double_sin(angle) + 0.5);
        }
        for (size_t i = 0; i < 360; i++) {
            put(3 * i, UNITS / 2 + 128, UNITS / 2 + 128, SIZE);
            put(3 * i + 1, rim[i][0], rim[i][1], SIZE);
            put(3 * i + 2, rim[i + 1][0], rim[i + 1][1], SIZE);
        }
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, 360);
        finish(&s);
        CHECK(bytes_at(&s, SIZE / 2, SIZE / 2)[0] == 1, "radius %d: the centre has %d hits", radius,
              bytes_at(&s, SIZE / 2, SIZE / 2)[0]);
        check_hits(&s, 360, SIZE, SIZE, "fan");
    }
    close_stage(&s);
}

/* R3: a quad drawn with either diagonal covers the same pixels, each once. */
static void either_diagonal_covers_the_same(void)
{
    static const int orders[2][6] = { { 0, 1, 2, 0, 2, 3 }, { 1, 2, 3, 1, 3, 0 } };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int round = 0; round < 50; round++) {
        int64_t x = random_whole(0, 20000), y = random_whole(0, 20000), w = random_whole(1, 9000);
        int64_t lean = random_whole(-300, 300);
        int64_t corner[4][2] = { { x, y }, { x + w, y + lean }, { x + w + lean, y + w }, { x - lean, y + w + lean } };
        uint64_t hash[2];
        for (int d = 0; d < 2; d++) {
            for (size_t k = 0; k < 6; k++)
                put(k, corner[orders[d][k]][0], corner[orders[d][k]][1], SIZE);
            begin(&s, (lom_pass_desc){ 0 });
            draw_counting(&s, 2);
            finish(&s);
            hash[d] = lom_hash_image(s.image);
            for (int i = 0; i < SIZE * SIZE; i++)
                CHECK(bytes_at(&s, i % SIZE, i / SIZE)[0] <= 1, "round %d: twice", round);
        }
        CHECK(w < 1000 || hash[0] == hash[1], "round %d", round);
    }
    close_stage(&s);
}

/* R4: a frame of 32768 x 32768, drawn in pieces that lie on the edges of huge triangles. */
static void huge_frames_are_exact(void)
{
    enum { FRAME = 32768, PIECE = 64 };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, PIECE, PIECE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int round = 0; round < 60; round++) {
        snapped v[3];
        for (size_t k = 0; k < 3; k++) {
            float *p = vertices[k].position;
            p[0] = random_float(-1.9f, 1.9f);
            p[1] = random_float(-1.9f, 1.9f);
            p[2] = 0.5f;
            p[3] = 1;
            v[k] = snap(p, FRAME, FRAME);
        }
        for (int piece = 0; piece < 6; piece++) { /* two along each edge */
            int64_t t = random_whole(0, 1000), a = piece % 3, b = (piece + 1) % 3;
            int64_t x = (v[a].x + (v[b].x - v[a].x) * t / 1000) / 256 - PIECE / 2;
            int64_t y = (v[a].y + (v[b].y - v[a].y) * t / 1000) / 256 - PIECE / 2;
            if (x < 0 || y < 0 || x > FRAME - PIECE || y > FRAME - PIECE)
                continue;
            begin(&s, (lom_pass_desc){
                          .frame_width = FRAME, .frame_height = FRAME, .origin_x = (int)x, .origin_y = (int)y });
            draw_counting(&s, 1);
            finish(&s);
            for (int i = 0; i < PIECE * PIECE; i++) {
                int px = i % PIECE, py = i / PIECE;
                CHECK(bytes_at(&s, px, py)[0] == covers(v, px + (int)x, py + (int)y), "round %d: pixel %d,%d", round,
                      px + (int)x, py + (int)y);
            }
        }
    }
    close_stage(&s);
}

/* R5: a triangle smaller than a pixel at every one of 256 x 256 sub-pixel offsets, each in its own cell of 4 x 4. */
static void every_subpixel_offset_is_exact(void)
{
    enum { FRAME = 1024, CELL = 4 };
    static const int64_t shapes[][3][2] = { { { 0, 0 }, { 150, 30 }, { 60, 170 } },
                                            { { 0, 0 }, { 255, 0 }, { 0, 255 } },
                                            { { 3, 0 }, { 1, 200 }, { 0, 1 } } };
    stage s = open_stage((lom_device_desc){ .threads = 2 }, FRAME, FRAME, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int shape = 0; shape < 3; shape++) {
        for (size_t i = 0; i < 65536; i++)
            for (size_t k = 0; k < 3; k++) {
                size_t from = (i & 1) != 0 ? 2 - k : k; /* both windings */
                put(3 * i + k, (int64_t)(i % 256) * (CELL * 256 + 1) + 256 + shapes[shape][from][0],
                    (int64_t)(i / 256) * (CELL * 256 + 1) + 256 + shapes[shape][from][1], FRAME);
            }
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, 65536);
        finish(&s);
        int hits = 0;
        for (size_t i = 0; i < 65536; i++) {
            snapped v[3];
            for (size_t k = 0; k < 3; k++)
                v[k] = snap(vertices[3 * i + k].position, FRAME, FRAME);
            int left = (int)(v[0].x >> 8) - 2, top = (int)(v[0].y >> 8) - 2;
            for (int y = top; y < top + 5 && y < FRAME; y++)
                for (int x = left; x < left + 5 && x < FRAME; x++)
                    if (x >= 0 && y >= 0 && covers(v, x, y)) {
                        hits++;
                        CHECK(bytes_at(&s, x, y)[0] == 1, "shape %d, offset %zu: pixel %d,%d", shape, i, x, y);
                    }
        }
        int drawn = 0;
        for (int i = 0; i < FRAME * FRAME; i++)
            drawn += bytes_at(&s, i % FRAME, i / FRAME)[0];
        CHECK(drawn == hits, "shape %d: %d hits, not %d", shape, drawn, hits);
        CHECK(hits > 100, "shape %d: the test tests nothing", shape);
    }
    close_stage(&s);
}

/* R6: the table of the rule. The long edge passes exactly through the centre of pixel (64, 64) in the direction of each
 * octant and along the axes; the third vertex lies on its right (seen along it, y down), then on its left. */
static void the_top_left_rule_holds_in_every_octant(void)
{
    static const struct {
        int dx, dy;
        bool right, left; /* whether the centre belongs to the triangle on that side of the edge */
    } table[] = { { 1, 0, true, false },  { 2, 1, false, true },   { 1, 1, false, true },   { 1, 2, false, true },
                  { 0, 1, false, true },  { -1, 2, false, true },  { -1, 1, false, true },  { -2, 1, false, true },
                  { -1, 0, false, true }, { -2, -1, true, false }, { -1, -1, true, false }, { -1, -2, true, false },
                  { 0, -1, true, false }, { 1, -2, true, false },  { 1, -1, true, false },  { 2, -1, true, false } };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        for (int variant = 0; variant < 16; variant++) {
            int64_t reach = (variant >> 2 & 1) != 0 ? 5000 : 100, side = (variant & 1) != 0 ? -1 : 1;
            if ((variant >> 3) != 0)
                reach = 300000;
            int64_t c = UNITS / 2 + 128, dx = table[i].dx * reach, dy = table[i].dy * reach;
            size_t swap = (size_t)(variant >> 1 & 1);
            put(swap, c - dx, c - dy, SIZE);
            put(1 - swap, c + dx, c + dy, SIZE);
            put(2, c - dy * side, c + dx * side, SIZE); /* right of the direction, y down */
            begin(&s, (lom_pass_desc){ 0 });
            draw_counting(&s, 1);
            finish(&s);
            bool expected = side > 0 ? table[i].right : table[i].left;
            CHECK(bytes_at(&s, SIZE / 2, SIZE / 2)[0] == expected, "direction %d,%d, variant %d", table[i].dx,
                  table[i].dy, variant);
        }
    close_stage(&s);
}

/* Random triangles with values at their vertices; whole of them when `disjoint` shares the frame out in a grid. */
static void make_scene(size_t triangles)
{
    for (size_t t = 0; t < triangles; t++) {
        float reach = t % 5 == 0 ? 1.5f : 0.1f, x = random_float(-1, 1), y = random_float(-1, 1);
        for (size_t k = 0; k < 3; k++) {
            vertex *v = &vertices[3 * t + k];
            float w = random_float(0.2f, 5.0f);
            v->position[0] = (x + random_float(-reach, reach)) * w;
            v->position[1] = (y + random_float(-reach, reach)) * w;
            v->position[2] = random_float(0.1f, 0.9f) * w;
            v->position[3] = w;
            for (int f = 0; f < 4; f++)
                v->value[f] = random_float(-10, 10);
        }
    }
}

static lom_image *render_values(stage *s, lom_pass_desc pass, lom_rect scissor, size_t triangles)
{
    lom_draw_desc desc = draw_of(&values, vertices, 3 * triangles);
    desc.scissor = scissor;
    begin(s, pass);
    lom_draw(s->device, &desc);
    finish(s);
    lom_image *image = s->image;
    s->image = NULL;
    return image;
}

/* R7: three rotations and the other winding of every triangle give the same floats and depths. */
static void the_order_of_vertices_changes_nothing(void)
{
    static const size_t orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 }, { 1, 0, 2 }, { 0, 2, 1 } };
    static vertex original[3 * 300];
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    make_scene(300);
    memcpy(original, vertices, sizeof original);
    lom_image *first = render_values(&s, (lom_pass_desc){ 0 }, (lom_rect){ 0 }, 300);
    uint64_t first_depth = lom_hash_image(s.depths);
    for (int o = 1; o < 6; o++) {
        for (size_t i = 0; i < 3 * 300; i++)
            vertices[i] = original[i / 3 * 3 + orders[o][i % 3]];
        lom_image *other = render_values(&s, (lom_pass_desc){ 0 }, (lom_rect){ 0 }, 300);
        CHECK(same_images(first, other), "order %d: colours", o);
        CHECK(lom_hash_image(s.depths) == first_depth, "order %d: depths", o);
        lom_free_image(other);
    }
    lom_free_image(first);
    close_stage(&s);
}

/* R7: triangles that share no pixel may be drawn in any order. */
static void disjoint_triangles_commute(void)
{
    enum { N = 16 };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    size_t triangles = 0;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++)
            for (int half = 0; half < 2; half++, triangles++)
                for (int k = 0; k < 3; k++) {
                    int cx = i + (half == 0 ? k & 1 : 1 - (k & 1)), cy = j + (half == 0 ? k >> 1 : 1 - (k >> 1));
                    vertex *v = &vertices[3 * triangles + (size_t)k];
                    place_at(v, cx * UNITS / N + cy * 37 % 101, cy * UNITS / N + cx * 53 % 89, SIZE);
                    for (int f = 0; f < 4; f++)
                        v->value[f] = random_float(-1, 1);
                }
    lom_image *first = render_values(&s, (lom_pass_desc){ 0 }, (lom_rect){ 0 }, triangles);
    for (int round = 0; round < 5; round++) {
        for (size_t t = triangles - 1; t > 0; t--) {
            size_t other = (size_t)random_whole(0, (int64_t)t);
            vertex swap[3];
            memcpy(swap, &vertices[3 * t], sizeof swap);
            memcpy(&vertices[3 * t], &vertices[3 * other], sizeof swap);
            memcpy(&vertices[3 * other], swap, sizeof swap);
        }
        lom_image *permuted = render_values(&s, (lom_pass_desc){ 0 }, (lom_rect){ 0 }, triangles);
        CHECK(same_images(first, permuted), "permutation %d", round);
        lom_free_image(permuted);
    }
    lom_free_image(first);
    close_stage(&s);
}

/* R8: a viewport moved by whole pixels moves the picture, bit for bit. */
static void whole_pixels_translate_the_picture(void)
{
    static const int shifts[][2] = { { 1, 0 }, { 0, 1 }, { 17, 5 }, { 63, 64 }, { -30, -7 } };
    enum { VIEW = 96 };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 256, 256, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    make_scene(200);
    lom_image *first = render_values(&s, (lom_pass_desc){ .viewport = { 40, 50, VIEW, VIEW } }, (lom_rect){ 0 }, 200);
    for (size_t i = 0; i < sizeof shifts / sizeof shifts[0]; i++) {
        int dx = shifts[i][0], dy = shifts[i][1];
        lom_image *moved =
            render_values(&s, (lom_pass_desc){ .viewport = { 40 + dx, 50 + dy, VIEW, VIEW } }, (lom_rect){ 0 }, 200);
        for (int y = 0; y < VIEW; y++)
            CHECK(memcmp(lom_image_pixel(first, 40, 50 + y, 0), lom_image_pixel(moved, 40 + dx, 50 + dy + y, 0),
                         VIEW * 16) == 0,
                  "shift %d,%d: row %d", dx, dy, y);
        lom_free_image(moved);
    }
    lom_free_image(first);
    close_stage(&s);
}

static bool is_in(lom_rect r, int x, int y)
{
    return x >= r.x && y >= r.y && x < r.x + r.width && y < r.y + r.height;
}

/* R9: a scissor, of the pass or of the draw, keeps exactly its pixels. */
static void scissors_keep_their_pixels(void)
{
    static const lom_rect rects[] = { { 0, 0, 1, 1 },     { 127, 127, 1, 1 }, { 3, 5, 70, 1 },       { 64, 64, 64, 64 },
                                      { 31, 17, 66, 93 }, { 1, 1, 126, 126 }, { -50, -50, 300, 70 }, { 200, 0, 5, 5 } };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    static const float clear[4] = { 7, 8, 9, 10 };
    make_scene(200);
    lom_pass_desc pass = { .clear_color = { { 7, 8, 9, 10 } } };
    lom_image *whole = render_values(&s, pass, (lom_rect){ 0 }, 200);
    for (size_t i = 0; i < sizeof rects / sizeof rects[0]; i++)
        for (int of_draw = 0; of_draw < 2; of_draw++) {
            pass.scissor = of_draw ? (lom_rect){ 0 } : rects[i];
            lom_image *part = render_values(&s, pass, of_draw ? rects[i] : (lom_rect){ 0 }, 200);
            for (int y = 0; y < SIZE; y++)
                for (int x = 0; x < SIZE; x++) {
                    const void *expected = is_in(rects[i], x, y) ? lom_image_pixel(whole, x, y, 0) : clear;
                    CHECK(memcmp(lom_image_pixel(part, x, y, 0), expected, 16) == 0, "scissor %zu: pixel %d,%d", i, x,
                          y);
                }
            lom_free_image(part);
        }
    lom_free_image(whole);
    close_stage(&s);
}

/* A crop is the cut-out of the whole frame, wherever it lies. */
static void crops_are_cut_outs(void)
{
    static const int origins[][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 37, 11 }, { 63, 64 }, { 80, 75 } };
    enum { PIECE = 48 };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    stage crop = open_stage((lom_device_desc){ .threads = 1 }, PIECE, PIECE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    make_scene(200);
    lom_image *whole = render_values(&s, (lom_pass_desc){ 0 }, (lom_rect){ 0 }, 200);
    for (size_t i = 0; i < sizeof origins / sizeof origins[0]; i++) {
        int ox = origins[i][0], oy = origins[i][1];
        lom_image *part = render_values(
            &crop, (lom_pass_desc){ .frame_width = SIZE, .frame_height = SIZE, .origin_x = ox, .origin_y = oy },
            (lom_rect){ 0 }, 200);
        for (int y = 0; y < PIECE; y++)
            CHECK(memcmp(lom_image_pixel(part, 0, y, 0), lom_image_pixel(whole, ox, oy + y, 0), PIECE * 16) == 0,
                  "crop at %d,%d: row %d", ox, oy, y);
        lom_free_image(part);
    }
    lom_free_image(whole);
    close_stage(&crop);
    close_stage(&s);
}

/* R10: positions half-way between two units go to the even one. */
static void ties_snap_to_even(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int pass = 0; pass < 60; pass++) {
        snapped v[50][3];
        for (int t = 0; t < 50; t++) {
            int64_t cx = 128 + 256 * random_whole(2, SIZE - 3), cy = 128 + 256 * random_whole(2, SIZE - 3);
            for (int k = 0; k < 3; k++) { /* in half units, close to lines through centres */
                int64_t x = 2 * cx + random_whole(-1, 1) + 512 * random_whole(-2, 2);
                int64_t y = 2 * cy + random_whole(-1, 1) + 512 * random_whole(-2, 2);
                float *p = vertices[3 * t + k].position;
                p[0] = (float)x / (float)UNITS - 1.0f;
                p[1] = 1.0f - (float)y / (float)UNITS;
                p[2] = 0.5f;
                p[3] = 1;
                v[t][k].x = x % 2 == 0 ? x / 2 : x / 2 + (x / 2) % 2; /* to even */
                v[t][k].y = y % 2 == 0 ? y / 2 : y / 2 + (y / 2) % 2;
            }
        }
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, 50);
        finish(&s);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                int hits = 0;
                for (int t = 0; t < 50; t++)
                    hits += covers(v[t], x, y);
                CHECK(bytes_at(&s, x, y)[0] == hits, "pass %d: pixel %d,%d", pass, x, y);
            }
    }
    close_stage(&s);
}

/* R11: -0 and numbers that round to 0 are 0. */
static void tiny_coordinates_are_zero(void)
{
    static const float tiny[] = { 0.0f, -0.0f, -1e-10f, 1e-10f, -1e-45f, 1e-38f };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    lom_image *first = NULL;
    make_scene(1);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 4; i++)
            vertices[k].position[i] = i < 2 ? (float)((k >> i & 1) * 2) * 0.4f : i == 2 ? 0.5f : 1.0f;
    for (size_t i = 0; i < sizeof tiny / sizeof tiny[0]; i++) {
        vertices[0].position[0] = vertices[2].position[0] = tiny[i];
        vertices[0].position[1] = vertices[1].position[1] = tiny[i];
        lom_image *image = render_values(&s, (lom_pass_desc){ 0 }, (lom_rect){ 0 }, 1);
        CHECK(first == NULL || same_images(first, image), "%g", (double)tiny[i]);
        if (first == NULL)
            first = image;
        else
            lom_free_image(image);
    }
    lom_free_image(first);
    close_stage(&s);
}

/* R12: the depths of one triangle are the same each time it is drawn: 200 000 times, all equal. */
static void a_repeated_triangle_has_equal_depths(void)
{
    enum { TIMES = 200000 };
    static uint32_t indices[3 * TIMES];
    stage s = open_stage((lom_device_desc){ .threads = 2 }, SIZE, SIZE, LOM_FORMAT_R32F, LOM_FORMAT_DEPTH32F);
    static const float corner[3][4] = { { 0.1f, 0.1f, 0.31f, 1.0f },
                                        { 0.93f, 0.21f, 1.3f, 2.7f },
                                        { 0.02f, 0.3f, 0.02f, 0.91f } };
    for (size_t k = 0; k < 3; k++)
        memcpy(vertices[k].position, corner[k], sizeof corner[k]);
    for (size_t i = 0; i < 3 * TIMES; i++)
        indices[i] = (uint32_t)((i + i / 3) % 3); /* every rotation */
    lom_draw_desc desc = draw_of(&whole_counter, vertices, 3);
    desc.blend[0] = adding();
    begin(&s, (lom_pass_desc){ 0 });
    lom_draw(s.device, &desc);
    desc.depth_compare = LOM_COMPARE_EQUAL;
    desc.indices = indices;
    desc.count = 3 * TIMES;
    lom_draw(s.device, &desc);
    finish(&s);
    snapped v[3];
    int pixels = 0;
    for (int k = 0; k < 3; k++)
        v[k] = snap(corner[k], SIZE, SIZE);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float expected = covers(v, x, y) ? TIMES + 1 : 0;
            pixels += covers(v, x, y);
            CHECK(floats_at(&s, x, y)[0] == expected, "pixel %d,%d: %.0f times", x, y, (double)floats_at(&s, x, y)[0]);
        }
    CHECK(pixels > 10, "%d pixels", pixels);
    close_stage(&s);
}

/* ---- strips and fans in one draw ---- */

enum { MOST_INDICES = 400 };

/* Pieces of 0 to 6 vertices out of `count`, one or two restarts between them, as words and, where they fit, as halves.
 * Returns how many indices there are. */
static size_t put_pieces(uint32_t *words, uint16_t *halves, int64_t count)
{
    size_t used = 0;
    while (used < MOST_INDICES - 10) {
        for (int64_t left = random_whole(0, 6); left > 0; left--)
            words[used++] = (uint32_t)random_whole(0, count - 1);
        for (int64_t left = random_whole(1, 2); left > 0; left--)
            words[used++] = UINT32_MAX;
    }
    for (size_t i = 0; i < used; i++)
        halves[i] = (uint16_t)words[i];
    return used;
}

/* The largest index begins a new strip or fan: one draw of many pieces is a draw for each, whatever their lengths,
 * where chunks end and however scattered the vertices are. */
static void restarts_begin_new_pieces(void)
{
    static uint32_t words[MOST_INDICES];
    static uint16_t halves[MOST_INDICES];
    stage s =
        open_stage((lom_device_desc){ .threads = 1, .chunk = 16 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (int round = 0; round < 48; round++) {
        size_t scattered = round % 3 == 0 ? 20 : 60000, used;
        lom_image *pieces = NULL;
        make_scene(scattered / 3 + 1);
        used = put_pieces(words, halves, (int64_t)scattered);
        lom_draw_desc desc = draw_of(&values, vertices, sizeof vertices / sizeof vertices[0]);
        desc.topology = round % 2 == 0 ? LOM_TRIANGLE_STRIP : LOM_TRIANGLE_FAN;
        desc.restart = true;
        desc.index_bits = round / 2 % 2 == 0 ? 16 : 32;
        desc.indices = desc.index_bits == 16 ? (const void *)halves : words;
        desc.base_vertex = round % 5;
        for (int whole = 0; whole < 2; whole++) {
            begin(&s, (lom_pass_desc){ .clear_color = { { -2, -2, -2, -2 } } });
            for (size_t i = 0; i < used; i += desc.count + !whole) {
                desc.first = i;
                desc.count = whole ? used : 0;
                while (!whole && i + desc.count < used && words[i + desc.count] != UINT32_MAX)
                    desc.count++;
                lom_draw(s.device, &desc);
            }
            finish(&s);
            CHECK(whole == 0 || same_images(s.image, pieces), "round %d, %d bits", round, desc.index_bits);
            int drawn = 0;
            for (int p = 0; p < SIZE * SIZE; p++)
                drawn += floats_at(&s, p % SIZE, p / SIZE)[0] != -2;
            CHECK(drawn > SIZE, "round %d: %d pixels", round, drawn);
            if (!whole) {
                pieces = s.image;
                s.image = NULL;
            }
        }
        lom_free_image(pieces);
    }
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(arbitrary_positions_snap_as_documented);
    RUN(a_fan_hits_its_centre_once);
    RUN(either_diagonal_covers_the_same);
    RUN(huge_frames_are_exact);
    RUN(every_subpixel_offset_is_exact);
    RUN(the_top_left_rule_holds_in_every_octant);
    RUN(the_order_of_vertices_changes_nothing);
    RUN(disjoint_triangles_commute);
    RUN(whole_pixels_translate_the_picture);
    RUN(scissors_keep_their_pixels);
    RUN(crops_are_cut_outs);
    RUN(ties_snap_to_even);
    RUN(tiny_coordinates_are_zero);
    RUN(a_repeated_triangle_has_equal_depths);
    RUN(restarts_begin_new_pieces);
    return check_result();
}
