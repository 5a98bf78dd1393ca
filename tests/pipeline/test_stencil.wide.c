/* Proves the stencil test at this width: every function, operation, mask and reference on every code, of both faces and
 * before and after the shader, is what OpenGL 4.6, 17.3.3 says; a heap of triangles is the same heap drawn pixel by pixel
 * (sample by sample) by an oracle that knows only coverage; who draws in how many tiles by how many workers changes no
 * byte; a test that always passes changes no picture; samples and codes last from pass to pass; a shadow volume is the
 * shadow that rays find. */
#include "pipeline/device.h"

#include "sampled.h"

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
}

/* The same colours; every lane could be dropped, none is: so tests come after the shader. */
static void show_late(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->discard = in->varying[0] < -1.0f;
}

LOM_SHADER(early, place, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(late, place, show_late, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .discards = true)
LOM_DEPTH_SHADER(depth_only, place, .attributes = 2)

static const lom_shader *const shaders[] = { &early, &late, &depth_only };

/* ---- the rule, for one sample ---- */

static bool compares(lom_compare compare, unsigned a, unsigned b)
{
    switch (compare) {
    case LOM_COMPARE_NEVER:
        return false;
    case LOM_COMPARE_LESS:
        return a < b;
    case LOM_COMPARE_EQUAL:
        return a == b;
    case LOM_COMPARE_LESS_EQUAL:
        return a <= b;
    case LOM_COMPARE_GREATER:
        return a > b;
    case LOM_COMPARE_NOT_EQUAL:
        return a != b;
    case LOM_COMPARE_GREATER_EQUAL:
        return a >= b;
    default:
        return true;
    }
}

static unsigned operated(lom_stencil_operation operation, unsigned code, unsigned reference)
{
    static const unsigned unused = 999;
    const unsigned results[LOM_STENCIL_OPERATION_COUNT + 1] = { [LOM_STENCIL_KEEP] = code,
                                                                [LOM_STENCIL_REPLACE] = reference,
                                                                [LOM_STENCIL_INCREMENT] = code == 255 ? 255 : code + 1,
                                                                [LOM_STENCIL_DECREMENT] = code == 0 ? 0 : code - 1,
                                                                [LOM_STENCIL_INVERT] = 255 - code,
                                                                [LOM_STENCIL_INCREMENT_WRAP] = (code + 1) % 256,
                                                                [LOM_STENCIL_DECREMENT_WRAP] = (code + 255) % 256,
                                                                [LOM_STENCIL_OPERATION_COUNT] = unused };
    return results[operation];
}

/* Whether a sample with this code passes; its code afterwards. */
static bool tested(const lom_stencil_face *face, bool deep, unsigned *code)
{
    unsigned read = 255u - face->read_off, write = 255u - face->write_off;
    bool passed = compares(face->compare, face->reference & read, *code & read);
    unsigned changed = operated(passed ? (deep ? face->pass : face->depth_fail) : face->fail, *code, face->reference);
    *code = (changed & write) | (*code & ~write);
    return passed;
}

/* ---- every function, operation and mask ---- */

enum { CODES = 16, WIDE = 2 * CODES }; /* codes are 16 x + y of a square; a second one beside it is hidden by depth */

/* A square over x0..x1, y0..y1 of a picture of WIDE x CODES; turned: clockwise. */
static void square(vertex v[6], int x0, int y0, int x1, int y1, float z, bool turned)
{
    static const int corners[2][6] = { { 0, 1, 2, 2, 1, 3 }, { 0, 2, 1, 2, 3, 1 } };
    for (int i = 0; i < 6; i++) {
        int k = corners[turned][i], x = k & 2 ? x1 : x0, y = k & 1 ? y1 : y0;
        v[i] = (vertex){ .position = { 2 * (float)x / WIDE - 1, 1 - 2 * (float)y / CODES, z, 1 },
                         .value = { 1, 1, 1, 1 } };
    }
}

/* Draws that leave the code 16 x + y in both squares, a plane of bits each, by strips; and depth 0.7 in the right one. */
static void write_codes(stage *s)
{
    vertex v[6];
    lom_draw_desc desc = draw_of(&depth_only, v, 6);
    for (int bit = 0; bit < 8; bit++)
        for (int first = 0; first < WIDE; first++) {
            int line = first % CODES;
            bool rows = bit < 4;
            if (!(line >> (bit & 3) & 1) || (rows && first >= CODES))
                continue;
            if (rows)
                square(v, 0, line, WIDE, line + 1, 0.5f, false);
            else
                square(v, first, 0, first + 1, CODES, 0.5f, false);
            vertex *kept = malloc(sizeof v); /* until the pass ends */
            memcpy(kept, v, sizeof v);
            desc = draw_of(&depth_only, kept, 6);
            desc.depth_test_off = true;
            desc.stencil = (lom_stencil){
                .enabled = true,
                .front = { .pass = LOM_STENCIL_REPLACE, .reference = 255, .write_off = (uint8_t) ~(1 << bit) }
            };
            begin(s, (lom_pass_desc){ .stencil_load = LOM_LOAD_KEEP });
            lom_draw(s->device, &desc);
            finish(s);
            free(kept);
        }
    square(v, CODES, 0, WIDE, CODES, 0.7f, false);
    desc = draw_of(&depth_only, v, 6);
    begin(s, (lom_pass_desc){ .stencil_load = LOM_LOAD_KEEP });
    lom_draw(s->device, &desc);
    finish(s);
}

struct rule_case {
    const lom_shader *shader;
    lom_stencil stencil;
    bool turned;
};

/* The pass starts from the codes that `codes` holds. */
static void check_rule(stage *s, const struct rule_case *c)
{
    vertex v[6];
    uint64_t count = 0, passed = 0;
    lom_query *query = lom_make_query(s->device);
    square(v, 0, 0, WIDE, CODES, 0.5f, c->turned);
    lom_draw_desc desc = draw_of(c->shader, v, 6);
    desc.stencil = c->stencil;
    desc.query = query;
    begin(s, (lom_pass_desc){ .stencil_load = LOM_LOAD_KEEP, .depth_load = LOM_LOAD_KEEP });
    lom_draw(s->device, &desc);
    finish(s);
    CHECK(lom_query_result(query, &passed), "a pass has counted");
    const uint8_t *codes = s->depth->stencil;
    const lom_stencil_face *face = c->turned && c->stencil.two_sided ? &c->stencil.back : &c->stencil.front;
    for (int p = 0; p < WIDE * CODES; p++) {
        int x = p % WIDE, y = p / WIDE;
        unsigned before = (unsigned)(16 * (x % CODES) + y), code = before;
        bool deep = x < CODES, stored = tested(face, deep, &code) && deep;
        CHECK(codes[p] == code, "%s, function %d, operations %d %d %d of %d, reference %d, masks %02x %02x: %d, not %d",
              c->shader->name, face->compare, face->fail, face->depth_fail, face->pass, before, face->reference,
              face->read_off, face->write_off, codes[p], code);
        CHECK(bytes_at(s, x, y)[0] == (stored && c->shader != &depth_only ? 255 : 0), "colour of %d at %d: %d", before,
              p, bytes_at(s, x, y)[0]);
        CHECK((*(const float *)lom_image_pixel(s->depths, x, y, 0) == 0.5f) == stored, "depth of %d at %d", before, p);
        count += stored;
    }
    CHECK(count == passed, "%s: %llu samples, not %llu", c->shader->name, (unsigned long long)passed,
          (unsigned long long)count);
    lom_release_query(s->device, query);
}

/* All functions and operations, the operations in each of the three places; references and masks vary with them. The face
 * that is not drawn has other settings. */
static void every_function_and_operation_is_its_definition(void)
{
    static const uint8_t references[] = { 0, 1, 97, 128, 254, 255 }, masks[] = { 0, 0xf0, 0x5a, 0, 0xff };
    stage s = open_stage((lom_device_desc){ .threads = 1, .tile = 16 }, WIDE, CODES, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    s.depth = lom_make_texture(
        s.device,
        &(lom_texture_desc){ .width = WIDE, .height = CODES, .format = LOM_FORMAT_DEPTH32F, .stencil = true });
    write_codes(&s);
    uint8_t codes[WIDE * CODES];
    float depths[WIDE * CODES];
    memcpy(codes, s.depth->stencil, sizeof codes);
    memcpy(depths, s.depths->pixels, sizeof depths);
    for (int p = 0; p < WIDE * CODES; p++)
        CHECK(codes[p] == 16 * (p % CODES) + p / WIDE, "code %d: %d", p, codes[p]);
    for (int n = 0; n < 8 * 8 * 2 * 3; n++) {
        int function = n % 8, operation = n / 8 % 8;
        lom_stencil_face face = { .compare = (lom_compare)(LOM_COMPARE_NEVER + function),
                                  .fail = (lom_stencil_operation)operation,
                                  .depth_fail = (lom_stencil_operation)((operation + 3 + n) % 8),
                                  .pass = (lom_stencil_operation)((operation + 5 + n / 3) % 8),
                                  .reference = references[(n / 5 + operation) % 6],
                                  .read_off = masks[(n / 7 + function) % 5],
                                  .write_off = masks[(n / 11 + operation) % 5] };
        lom_stencil_face other = { .compare = LOM_COMPARE_NEVER, .fail = LOM_STENCIL_ZERO };
        struct rule_case c = { .shader = shaders[n / 64 % 3], .turned = n / 192 != 0 };
        c.stencil = (lom_stencil){ .enabled = true, .two_sided = n % 3 != 0, .front = face, .back = other };
        if (c.turned && c.stencil.two_sided)
            c.stencil = (lom_stencil){ .enabled = true, .two_sided = true, .front = other, .back = face };
        memcpy(s.depth->stencil, codes, sizeof codes);
        lom_update_texture(s.device, s.depth, depths, sizeof depths);
        check_rule(&s, &c);
    }
    close_stage(&s);
}

/* ---- a heap of triangles, sample by sample ---- */

static const lom_stencil_face heap_faces[4] = {
    { LOM_COMPARE_LESS_EQUAL, LOM_STENCIL_INVERT, LOM_STENCIL_INCREMENT, LOM_STENCIL_INCREMENT_WRAP, 3, 0, 0 },
    { LOM_COMPARE_NOT_EQUAL, LOM_STENCIL_INCREMENT, LOM_STENCIL_DECREMENT_WRAP, LOM_STENCIL_REPLACE, 200, 0x0f, 0x80 },
    { LOM_COMPARE_GREATER, LOM_STENCIL_DECREMENT_WRAP, LOM_STENCIL_ZERO, LOM_STENCIL_INVERT, 128, 0, 0x11 },
    { LOM_COMPARE_ALWAYS, LOM_STENCIL_KEEP, LOM_STENCIL_DECREMENT, LOM_STENCIL_INCREMENT, 7, 0, 0 },
};

enum { DRAWS = 4, PER_DRAW = TRIANGLES / DRAWS };

static lom_draw_desc heap_draw(int d, const lom_shader *shader)
{
    lom_draw_desc desc = draw_of(shader, heap + 3 * PER_DRAW * d, 3 * PER_DRAW);
    desc.stencil = (lom_stencil){
        .enabled = true, .two_sided = d != 2, .front = heap_faces[d], .back = heap_faces[(d + 1) % DRAWS]
    };
    desc.depth_compare = d == 1 ? LOM_COMPARE_ALWAYS : LOM_COMPARE_DEFAULT;
    desc.depth_write_off = d == 3;
    desc.blend[0] = adding();
    return desc;
}

/* Flat triangles, so that depth and colour are known without an interpolation. */
static void flatten(void)
{
    for (size_t t = 0; t < TRIANGLES; t++)
        for (size_t k = 0; k < 3; k++) {
            vertex *v = &heap[3 * t + k];
            for (int i = 0; i < 3; i++)
                v->position[i] /= v->position[3];
            v->position[3] = 1;
            v->position[2] = (float)(t * 7 % 16 + 1) / 32;
            for (int i = 0; i < 4; i++)
                v->value[i] = (float)((t + (size_t)i) % 5) / 255;
        }
}

/* One sample of one pixel, through the heap in order. */
struct expected {
    unsigned code, color;
    float depth;
};

static struct expected draw_sample(const lom_stencil draws[DRAWS], int px, int py, const int at[2],
                                   uint64_t counted[DRAWS])
{
    struct expected e = { .code = 5, .color = 0, .depth = 0 };
    for (int t = 0; t < TRIANGLES; t++) {
        const int d = t / PER_DRAW;
        snapped v[3];
        for (int k = 0; k < 3; k++) {
            v[k] = snap(heap[3 * t + k].position, SIZE, SIZE);
            v[k] = (snapped){ v[k].x - 16 * at[0], v[k].y - 16 * at[1] };
        }
        if (!covers(v, px, py))
            continue;
        bool front = (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x) < 0;
        float z = heap[3 * t].position[2];
        bool deep = d == 1 || z > e.depth;
        const lom_stencil *stencil = &draws[d];
        if (!tested(front || !stencil->two_sided ? &stencil->front : &stencil->back, deep, &e.code) || !deep)
            continue;
        counted[d]++;
        if (d != 3)
            e.depth = z;
        e.color = e.color + (unsigned)t % 5 > 255 ? 255 : e.color + (unsigned)t % 5;
    }
    return e;
}

struct heap_run {
    uint64_t counted[DRAWS];
    uint64_t hash[3]; /* colour, depth, stencil */
    stage s;
};

static void run_heap(struct heap_run *run, lom_device_desc device, int samples, const lom_shader *shader,
                     lom_format depth, bool apart)
{
    run->s = open_stage(device, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_query *query[DRAWS];
    stage *s = &run->s;
    s->depth = lom_make_texture(
        s->device,
        &(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = depth, .stencil = true, .samples = samples });
    lom_texture_desc color = { .width = SIZE, .height = SIZE, .format = LOM_FORMAT_RGBA8, .samples = samples };
    s->color = lom_make_texture(s->device, &color);
    s->device->one_by_one = apart;
    for (int d = 0; d < DRAWS; d++)
        query[d] = lom_make_query(s->device);
    for (int d = 0; d < DRAWS; d++) { /* apart: a pass for each draw */
        const lom_load_action load = d == 0 ? LOM_LOAD_CLEAR : LOM_LOAD_KEEP;
        lom_draw_desc desc = heap_draw(d, shader);
        desc.query = query[d];
        if (d == 0 || apart)
            begin(s, (lom_pass_desc){ .samples = samples,
                                      .clear_stencil = 5,
                                      .color_load = { load },
                                      .depth_load = load,
                                      .stencil_load = load });
        lom_draw(s->device, &desc);
        if (d == DRAWS - 1 || apart)
            finish(s);
    }
    for (int d = 0; d < DRAWS; d++)
        CHECK(lom_query_result(query[d], &run->counted[d]), "draw %d is not counted", d);
    lom_image *stencil = lom_read_stencil(s->depth, NULL);
    run->hash[0] = lom_hash_image(s->image);
    run->hash[1] = lom_hash_image(s->depths);
    run->hash[2] = lom_hash_image(stencil);
    lom_free_image(stencil);
}

static void heaps_are_drawn_sample_by_sample(void)
{
    make_heap();
    flatten();
    lom_stencil draws[DRAWS];
    for (int d = 0; d < DRAWS; d++)
        draws[d] = heap_draw(d, &early).stencil;
    for (int i = -1; i < 2; i++) {
        int samples = i < 0 ? 1 : counts[i];
        uint64_t counted[DRAWS] = { 0 };
        struct heap_run run;
        run_heap(&run, (lom_device_desc){ .threads = 2 }, samples, &early, LOM_FORMAT_DEPTH32F, false);
        for (int p = 0; p < SIZE * SIZE; p++) {
            int x = p % SIZE, y = p / SIZE;
            unsigned sum = 0;
            for (int k = 0; k < samples; k++) {
                int at[2];
                lom_sample_position(samples, k, at);
                struct expected e = draw_sample(draws, x, y, at, counted);
                sum += e.color;
                if (k > 0)
                    continue;
                CHECK(run.s.depth->stencil[p] == e.code, "%d samples, pixel %d,%d: code %d, not %d", samples, x, y,
                      run.s.depth->stencil[p], e.code);
                CHECK(*(const float *)lom_image_pixel(run.s.depths, x, y, 0) == e.depth, "%d samples, depth of %d,%d",
                      samples, x, y);
            }
            int mean = (int)((2 * sum + (unsigned)samples) / (2 * (unsigned)samples));
            CHECK(bytes_at(&run.s, x, y)[0] == mean, "%d samples, pixel %d,%d: %d, not %d", samples, x, y,
                  bytes_at(&run.s, x, y)[0], mean);
        }
        for (int d = 0; d < DRAWS; d++)
            CHECK(run.counted[d] == counted[d], "%d samples, draw %d: %llu, not %llu", samples, d,
                  (unsigned long long)run.counted[d], (unsigned long long)counted[d]);
        close_stage(&run.s);
    }
}

/* Threads, tiles, chunks, passes, and whether the tests come before or after the shader. */
static void nobody_sees_who_drew_it(void)
{
    static const lom_device_desc devices[] = { { .threads = 1 },
                                               { .threads = 3, .tile = 16 },
                                               { .threads = 2, .tile = 32, .chunk = 16, .batch = 1 } };
    static const lom_format formats[] = { LOM_FORMAT_DEPTH24, LOM_FORMAT_DEPTH32F };
    make_heap();
    for (int samples = 1; samples <= 4; samples *= 4)
        for (int f = 0; f < 2; f++) {
            struct heap_run first;
            run_heap(&first, devices[0], samples, &early, formats[f], false);
            for (int n = 1; n < 12; n++) {
                struct heap_run run;
                run_heap(&run, devices[n % 3], samples, n / 3 % 2 ? &late : &early, formats[f], n >= 6);
                CHECK(memcmp(run.hash, first.hash, sizeof run.hash) == 0, "case %d, %d samples", n, samples);
                CHECK(memcmp(run.counted, first.counted, sizeof run.counted) == 0, "counts of case %d, %d samples", n,
                      samples);
                close_stage(&run.s);
            }
            close_stage(&first.s);
        }
}

/* ---- what always passes ---- */

static void place_sprites(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->axis[0] = (lom_float4){ lom_splat(0.05f), lom_splat(0.02f), lom_splat(0), lom_splat(0) };
    out->axis[1] = (lom_float4){ lom_splat(-0.03f), lom_splat(0.06f), lom_splat(0), lom_splat(0) };
    out->point_size = lom_splat(5);
}

static void show_half(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->discard = in->varying[1] < 0.5f;
    out->color[0].w = in->varying[2];
}

LOM_SHADER(sprites, place_sprites, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .sprites = true)
LOM_SHADER(some_sprites, place_sprites, show_half, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .colors = 1, .sprites = true, .discards = true)
LOM_SHADER(points, place_sprites, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(half, place, show_half, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .discards = true)
LOM_SHADER(in_quads, place, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .quads = true)

static const struct plain_case {
    const char *name;
    const lom_shader *shader;
    lom_topology topology;
    bool alpha, each, biased;
} plain_cases[] = {
    { "triangles", &early, LOM_TRIANGLES, false, false, false },
    { "triangles that are dropped in part", &half, LOM_TRIANGLES, false, false, false },
    { "alpha to coverage", &half, LOM_TRIANGLES, true, false, false },
    { "shading of each sample", &early, LOM_TRIANGLES, false, true, false },
    { "dropped in part, each sample", &half, LOM_TRIANGLES, false, true, false },
    { "biased", &early, LOM_TRIANGLES, false, false, true },
    { "quads", &in_quads, LOM_TRIANGLES, false, false, false },
    { "depth alone", &depth_only, LOM_TRIANGLES, false, false, false },
    { "a strip", &late, LOM_TRIANGLE_STRIP, false, false, false },
    { "sprites", &sprites, LOM_SPRITES, false, false, false },
    { "sprites that are dropped in part", &some_sprites, LOM_SPRITES, true, true, false },
    { "points", &points, LOM_POINTS, false, false, false },
    { "lines", &early, LOM_LINES, false, false, false },
    { "lines that are dropped in part", &half, LOM_LINE_STRIP, false, false, false },
};

static void draw_plainly(stage *s, const struct plain_case *c, int samples, bool tests, lom_query *query)
{
    lom_draw_desc desc = draw_of(c->shader, heap, 3 * TRIANGLES);
    desc.topology = c->topology;
    desc.alpha_to_coverage = c->alpha;
    desc.per_sample = c->each;
    desc.depth_bias_slope = c->biased ? 0.5f : 0;
    desc.line_width = 3;
    if (tests) {
        desc.query = query;
        desc.stencil = (lom_stencil){ .enabled = true, .front = { .pass = LOM_STENCIL_INCREMENT_WRAP } };
    }
    begin(s, (lom_pass_desc){ .samples = samples });
    lom_draw(s->device, &desc);
    finish(s);
}

/* Colour and depth are those of a draw without a stencil, bit for bit. The codes add up to what was counted (with one
 * sample: there are no 256 layers). */
static void a_test_that_always_passes_changes_nothing(void)
{
    make_heap();
    for (size_t n = 0; n < 3 * sizeof plain_cases / sizeof *plain_cases; n++) {
        const struct plain_case *c = &plain_cases[n / 3];
        int samples = n % 3 == 0 ? 1 : n % 3 == 1 ? 4 : 2;
        stage a = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        stage b =
            open_stage((lom_device_desc){ .threads = 2, .tile = 32 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        lom_texture_desc depth = { .width = SIZE, .height = SIZE, .format = LOM_FORMAT_DEPTH24 };
        a.depth = lom_make_texture(a.device, &depth);
        depth.stencil = true;
        b.depth = lom_make_texture(b.device, &depth);
        lom_query *query = lom_make_query(b.device);
        draw_plainly(&a, c, samples, false, NULL);
        draw_plainly(&b, c, samples, true, query);
        CHECK(same_images(a.image, b.image), "%s, %d samples: colours", c->name, samples);
        CHECK(same_images(a.depths, b.depths), "%s, %d samples: depths", c->name, samples);
        uint64_t counted = 0, sum = 0;
        CHECK(lom_query_result(query, &counted) && counted != 0, "%s: nothing passed", c->name);
        for (int p = 0; p < SIZE * SIZE; p++)
            sum += b.depth->stencil[p];
        CHECK(samples > 1 || sum == counted, "%s: %llu counted, %llu in the codes", c->name,
              (unsigned long long)counted, (unsigned long long)sum);
        close_stage(&a);
        close_stage(&b);
    }
}

/* ---- the memory ---- */

/* A crop has the codes of the whole; what no draw touches is cleared, or kept; passes of other samples begin from texels. */
static void codes_last_from_pass_to_pass(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1, .tile = 16 }, 50, 40, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_texture_desc desc = { .width = 50, .height = 40, .format = LOM_FORMAT_DEPTH32F, .stencil = true, .samples = 4 };
    const lom_rect left = { 13, 7, 20, 30 }, right = { 21, 11, 20, 20 };
    static const vertex all[3] = { { .position = { -1, 3, 0.5f, 1 } },
                                   { .position = { -1, -1, 0.5f, 1 } },
                                   { .position = { 3, -1, 0.5f, 1 } } };
    s.depth = lom_make_texture(s.device, &desc);
    CHECK(s.depth->stencil[17] == 0, "a new stencil is zeros");
    lom_draw_desc draw = draw_of(&depth_only, all, 3);
    draw.depth_test_off = true;
    draw.stencil = (lom_stencil){ .enabled = true, .front = { .pass = LOM_STENCIL_INCREMENT } };
    for (int pass = 0; pass < 4; pass++) {
        static const int samples[] = { 1, 4, 4, 1 };
        lom_pass_desc begun = { .samples = samples[pass],
                                .clear_stencil = 40,
                                .frame_width = 80,
                                .frame_height = 60,
                                .origin_x = 9,
                                .origin_y = 5,
                                .stencil_load = pass == 0 ? LOM_LOAD_CLEAR : LOM_LOAD_KEEP };
        draw.scissor = pass % 2 == 0 ? left : right;
        begin(&s, begun);
        lom_draw(s.device, &draw);
        finish(&s);
    }
    for (int p = 0; p < 50 * 40; p++) {
        int x = p % 50 + 9, y = p / 50 + 5, code = 40;
        code += x >= 13 && x < 33 && y >= 7 && y < 37 ? 2 : 0;
        code += x >= 21 && x < 41 && y >= 11 && y < 31 ? 2 : 0;
        CHECK(s.depth->stencil[p] == code, "pixel %d,%d: %d, not %d", x, y, s.depth->stencil[p], code);
    }
    begin(&s, (lom_pass_desc){ .clear_stencil = 9, .stencil_load = LOM_LOAD_KEEP });
    finish(&s);
    CHECK(s.depth->stencil[0] == 40, "a pass that keeps it has %d", s.depth->stencil[0]);
    begin(&s, (lom_pass_desc){ .clear_stencil = 9, .samples = 4 });
    finish(&s);
    CHECK(s.depth->stencil[0] == 9 && s.depth->stencil[1999] == 9, "a pass that clears it has %d", s.depth->stencil[0]);
    close_stage(&s);
}

/* ---- a real use: the shadow of a box, by its volume ---- */

enum { FLOOR = 96 };

struct box {
    double low[3], high[3];
};

/* The world is x, y of -1..1 seen from above along z; the light comes from `toward`, a direction with z > 0. */
static const double toward[3] = { 0.51, 0.37, 0.93 };

static float depth_of(double z)
{
    return (float)(0.5 + 0.4 * z);
}

/* Whether the ray from p to the light meets the box; far: it stays so far from an edge of it that rounding does not count. */
static bool is_shaded(const struct box *b, const double p[3], bool *far)
{
    double enter = 0, leave = 1e9, margin = 1e9;
    for (int i = 0; i < 3; i++) {
        double a = (b->low[i] - p[i]) / toward[i], c = (b->high[i] - p[i]) / toward[i];
        enter = a > enter ? a : enter;
        leave = c < leave ? c : leave;
    }
    margin = leave - enter;
    *far = margin > 0.06 || margin < -0.06;
    return margin > 0;
}

static void corner(vertex *v, const struct box *b, int k, double away)
{
    double at[3];
    for (int i = 0; i < 3; i++)
        at[i] = (k >> i & 1 ? b->high[i] : b->low[i]) - away * toward[i];
    *v = (vertex){ .position = { (float)at[0], (float)at[1], depth_of(at[2]), 1 }, .value = { 1, 1, 1, 1 } };
}

/* The box's sides, outward counter-clockwise. */
static const int sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                 { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };

/* Closed: the sides that the light sees, those that it does not see moved away from it, and between them a wall along each
 * edge where they meet. Returns the number of corners. */
static size_t make_volume(const struct box *b, vertex *v)
{
    const double away = 1;
    size_t n = 0;
    for (int s = 0; s < 6; s++) {
        const bool lit = s % 2 == 1; /* the sides towards +x, +y, +z */
        static const int fan[6] = { 0, 1, 2, 0, 2, 3 };
        for (int k = 0; k < 6; k++)
            corner(&v[n++], b, sides[s][fan[k]], lit ? 0 : away);
        for (int e = 0; lit && e < 4; e++) {
            int from = sides[s][e], to = sides[s][(e + 1) % 4], changed = from ^ to, other = 0;
            for (int i = 0; i < 3; i++) /* the side beyond the edge is lit where its own axis is at the high end */
                if (!(changed >> i & 1) && i != s / 2)
                    other = from >> i & 1;
            if (other)
                continue;
            corner(&v[n++], b, from, 0);
            corner(&v[n++], b, from, away);
            corner(&v[n++], b, to, away);
            corner(&v[n++], b, from, 0);
            corner(&v[n++], b, to, away);
            corner(&v[n++], b, to, 0);
        }
    }
    return n;
}

/* Back faces behind what is seen add one, front faces take one away: what is left is not 0 in the volume (Carmack's
 * reverse). Both in one draw, two-sided, wrapping; then all that is not 0 is drawn dark. */
static void a_shadow_volume_is_the_shadow_of_rays(void)
{
    static const struct box box = { { -0.3, -0.25, 0.2 }, { 0.25, 0.2, 0.6 } };
    static vertex floor_corners[6], volume[120], box_corners[36];
    stage s = open_stage((lom_device_desc){ .threads = 2 }, FLOOR, FLOOR, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    s.depth = lom_make_texture(
        s.device,
        &(lom_texture_desc){ .width = FLOOR, .height = FLOOR, .format = LOM_FORMAT_DEPTH24, .stencil = true });
    static const float ends[6][2] = { { -1, 1 }, { -1, -1 }, { 1, 1 }, { 1, 1 }, { -1, -1 }, { 1, -1 } };
    for (int i = 0; i < 6; i++)
        floor_corners[i] = (vertex){ .position = { ends[i][0], ends[i][1], depth_of(0), 1 }, .value = { 1, 1, 1, 1 } };
    for (int i = 0; i < 36; i++) {
        static const int fan[6] = { 0, 1, 2, 0, 2, 3 };
        corner(&box_corners[i], &box, sides[i / 6][fan[i % 6]], 0);
    }
    lom_draw_desc ground = draw_of(&early, floor_corners, 6), solid = draw_of(&early, box_corners, 36);
    lom_draw_desc shadow = draw_of(&depth_only, volume, make_volume(&box, volume));
    shadow.depth_write_off = true;
    shadow.stencil = (lom_stencil){ .enabled = true,
                                    .two_sided = true,
                                    .front = { .depth_fail = LOM_STENCIL_DECREMENT_WRAP },
                                    .back = { .depth_fail = LOM_STENCIL_INCREMENT_WRAP } };
    lom_draw_desc dark = ground;
    dark.depth_test_off = true;
    dark.stencil = (lom_stencil){ .enabled = true, .front = { .compare = LOM_COMPARE_NOT_EQUAL } };
    dark.blend[0] = (lom_blend){ .enabled = true, .target_color = LOM_FACTOR_CONSTANT_COLOR };
    dark.blend_constant[0] = 0.25f;
    begin(&s, (lom_pass_desc){ .clear_depth = 0 });
    lom_draw(s.device, &ground);
    lom_draw(s.device, &solid);
    lom_draw(s.device, &shadow);
    lom_draw(s.device, &dark);
    finish(&s);
    int checked = 0, shaded = 0;
    for (int p = 0; p < FLOOR * FLOOR; p++) {
        double x = 2 * (p % FLOOR + 0.5) / FLOOR - 1, y = 1 - 2 * (p / FLOOR + 0.5) / FLOOR;
        bool on_box = x > box.low[0] && x < box.high[0] && y > box.low[1] && y < box.high[1], far;
        const double at[3] = { x, y, 0 };
        bool expected = is_shaded(&box, at, &far);
        if (on_box || !far)
            continue;
        checked++;
        shaded += expected;
        CHECK(bytes_at(&s, p % FLOOR, p / FLOOR)[0] == (expected ? 64 : 255), "at %.3f, %.3f: %d", x, y,
              bytes_at(&s, p % FLOOR, p / FLOOR)[0]);
    }
    CHECK(checked > FLOOR * FLOOR / 2 && shaded > 200, "%d checked, %d of them shaded", checked, shaded);
    CHECK(bytes_at(&s, FLOOR / 2, FLOOR / 2)[0] == 255, "the top of the box is lit");
    close_stage(&s);
}

/* ---- what cannot be ---- */

static void refused(const char *what, bool has_stencil, lom_stencil stencil)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_texture_desc depth = { .width = 8, .height = 8, .format = LOM_FORMAT_DEPTH24, .stencil = has_stencil };
    s.depth = lom_make_texture(s.device, &depth);
    lom_draw_desc desc = draw_of(&early, heap, 3);
    desc.stencil = stencil;
    lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color }, .depth = s.depth });
    lom_draw(s.device, &desc);
    CHECK(!lom_end_pass(s.device) && strstr(lom_device_error(s.device)->text, what) != NULL, "%s: \"%s\"", what,
          lom_device_error(s.device)->text);
    close_stage(&s);
}

static void what_cannot_be_is_refused(void)
{
    refused("no depth attachment with one", false, (lom_stencil){ .enabled = true });
    refused("a comparison or an operation that is none", true,
            (lom_stencil){ .enabled = true, .front = { .compare = LOM_COMPARE_ALWAYS + 1 } });
    refused("a comparison or an operation that is none", true,
            (lom_stencil){ .enabled = true, .two_sided = true, .back = { .depth_fail = LOM_STENCIL_OPERATION_COUNT } });
    static const lom_texture_desc textures[] = {
        { .width = 8, .height = 8, .format = LOM_FORMAT_RGBA8, .stencil = true },
        { .width = 8, .height = 8, .format = LOM_FORMAT_DEPTH16, .stencil = true },
        { .kind = LOM_TEXTURE_CUBE, .width = 8, .height = 8, .format = LOM_FORMAT_DEPTH24, .stencil = true },
    };
    for (int i = 0; i < 3; i++) {
        lom_error error = { .code = LOM_OK };
        CHECK(lom_create_texture(&textures[i], &error) == NULL && strstr(error.text, "has a stencil.") != NULL,
              "\"%s\"", error.text);
    }
    lom_error error = { .code = LOM_OK };
    lom_texture *plain = lom_create_texture(&(lom_texture_desc){ .width = 2, .height = 2 }, NULL);
    CHECK(lom_read_stencil(plain, &error) == NULL && strstr(error.text, "no stencil.") != NULL, "\"%s\"", error.text);
    lom_free_texture(plain);
}

int main(int argc, char **argv)
{
    RUN(every_function_and_operation_is_its_definition);
    RUN(heaps_are_drawn_sample_by_sample);
    RUN(nobody_sees_who_drew_it);
    RUN(a_test_that_always_passes_changes_nothing);
    RUN(codes_last_from_pass_to_pass);
    RUN(a_shadow_volume_is_the_shadow_of_rays);
    RUN(what_cannot_be_is_refused);
    return check_result();
}
