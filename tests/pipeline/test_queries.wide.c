/* Proves occlusion queries and conditional draws at this width: a count is what an oracle of coverage finds, with and
 * without depth, of all that passes draw with the query; workers, tiles and chunks change no count; a condition leaves a
 * draw out by the result of a pass that has ended; what cannot be is an error with a sentence. */
#include "sampled.h"

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
}

/* Drops the pixels of odd columns. */
static void show_columns(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->discard = (lom_bounded_to_int(in->x) & 1) != 0;
}

LOM_SHADER(values, place, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(columns, place, show_columns, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .reads_position = true, .discards = true)
LOM_DEPTH_SHADER(depth_only, place, .attributes = 2)

static const vertex whole[3] = { { .position = { -1, 3, 0.5f, 1 }, .value = { 1, 1, 1, 1 } },
                                 { .position = { -1, -1, 0.5f, 1 }, .value = { 1, 1, 1, 1 } },
                                 { .position = { 3, -1, 0.5f, 1 }, .value = { 1, 1, 1, 1 } } };

/* Samples of all triangles of the heap; odd: columns are left out. */
static uint64_t count_covered(int samples, bool odd)
{
    uint64_t sum = 0;
    for (int t = 0; t < TRIANGLES; t++) {
        snapped v[3];
        for (int k = 0; k < 3; k++)
            v[k] = snap(heap[3 * t + k].position, SIZE, SIZE);
        for (int p = 0; p < SIZE * SIZE; p++)
            if (!odd || p % 2 == 0)
                sum += (unsigned)__builtin_popcount(samples == 1 ? covers(v, p % SIZE, p / SIZE)
                                                                 : samples_of(v, samples, p % SIZE, p / SIZE));
    }
    return sum;
}

static uint64_t count_drawn(lom_device_desc desc, const lom_shader *shader, int samples, bool depth)
{
    stage s = open_stage(desc, SIZE, SIZE, LOM_FORMAT_RGBA8, depth ? LOM_FORMAT_DEPTH32F : LOM_FORMAT_NONE);
    lom_query *query = lom_make_query(s.device), *none = lom_make_query(s.device);
    lom_draw_desc draw = draw_of(shader, heap, 3 * TRIANGLES);
    uint64_t counted = 1;
    CHECK(!lom_query_result(query, &counted) && counted == 0, "a new query has a result");
    draw.depth_compare = LOM_COMPARE_ALWAYS;
    draw.query = query;
    begin(&s, (lom_pass_desc){ .samples = samples });
    lom_draw(s.device, &draw);
    draw.scissor = (lom_rect){ -5, -5, 2, 2 };
    draw.query = none;
    lom_draw(s.device, &draw);
    finish(&s);
    CHECK(lom_query_result(none, &counted) && counted == 0, "nothing is %llu samples", (unsigned long long)counted);
    CHECK(lom_query_result(query, &counted), "the pass has counted");
    close_stage(&s);
    return counted;
}

static void counts_are_those_of_the_oracle(void)
{
    static const lom_device_desc devices[] = { { .threads = 1 },
                                               { .threads = 3, .tile = 16 },
                                               { .threads = 2, .tile = 32, .chunk = 16, .batch = 1 } };
    make_heap();
    for (int i = -1; i < 4; i += i < 0 ? 1 : 3) {
        int samples = i < 0 ? 1 : counts[i];
        uint64_t expected = count_covered(samples, false), half = samples == 1 ? count_covered(1, true) : 0;
        for (int n = 0; n < 3; n++)
            for (int depth = 0; depth < 2; depth++) {
                uint64_t got = count_drawn(devices[n], &values, samples, depth == 1);
                CHECK(got == expected, "%d samples, device %d, depth %d: %llu, not %llu", samples, n, depth,
                      (unsigned long long)got, (unsigned long long)expected);
                got = count_drawn(devices[n], &depth_only, samples, depth == 1);
                CHECK(got == expected, "%d samples, no shader: %llu", samples, (unsigned long long)got);
                got = samples == 1 ? count_drawn(devices[n], &columns, 1, depth == 1) : 0;
                CHECK(got == half, "what is discarded does not count: %llu, not %llu", (unsigned long long)got,
                      (unsigned long long)half);
            }
    }
}

/* Of the heap drawn twice: once all is nearer or as near as what is there; every pixel that is covered is counted once. */
static void hidden_samples_do_not_count(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 2 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24);
    lom_query *query = lom_make_query(s.device);
    uint64_t first = 0, again = 0, equal = 0, covered = 0;
    make_heap();
    for (size_t k = 0; k < 3 * TRIANGLES; k++)
        heap[k].position[2] = 0.25f * heap[k].position[3]; /* all at one depth */
    lom_draw_desc draw = draw_of(&values, heap, 3 * TRIANGLES);
    draw.query = query;
    begin(&s, (lom_pass_desc){ .clear_depth = 0 });
    lom_draw(s.device, &draw);
    finish(&s);
    lom_query_result(query, &first);
    for (int p = 0; p < SIZE * SIZE; p++)
        covered += *(const uint32_t *)lom_image_pixel(s.depths, p % SIZE, p / SIZE, 0) != 0;
    begin(&s, (lom_pass_desc){ .depth_load = LOM_LOAD_KEEP });
    lom_draw(s.device, &draw);
    finish(&s);
    lom_query_result(query, &again);
    draw.depth_compare = LOM_COMPARE_EQUAL;
    begin(&s, (lom_pass_desc){ .depth_load = LOM_LOAD_KEEP });
    lom_draw(s.device, &draw);
    finish(&s);
    lom_query_result(query, &equal);
    CHECK(first == covered && covered > 1000, "%llu counted, %llu covered", (unsigned long long)first,
          (unsigned long long)covered);
    CHECK(again == 0, "%llu behind themselves", (unsigned long long)again);
    CHECK(equal == count_covered(1, false), "%llu as near as themselves", (unsigned long long)equal);
    close_stage(&s);
}

/* ---- conditional draws ---- */

/* Red of a pass of one draw of the whole picture. */
static int red_after(stage *s, const lom_query *condition, bool inverted, lom_query *query)
{
    lom_draw_desc draw = draw_of(&values, whole, 3);
    draw.condition = condition;
    draw.condition_inverted = inverted;
    draw.query = query;
    begin(s, (lom_pass_desc){ .label = NULL });
    lom_draw(s->device, &draw);
    finish(s);
    return bytes_at(s, 3, 4)[0];
}

static void conditions_leave_draws_out(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 2 }, 16, 16, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_query *nothing = lom_make_query(s.device), *much = lom_make_query(s.device), *own = lom_make_query(s.device);
    uint64_t samples = 0;
    lom_draw_desc draw = draw_of(&values, whole, 3);
    begin(&s, (lom_pass_desc){ .label = NULL });
    draw.query = much;
    lom_draw(s.device, &draw);
    lom_draw(s.device, &draw);
    draw.query = nothing;
    draw.scissor = (lom_rect){ 20, 20, 1, 1 };
    lom_draw(s.device, &draw);
    finish(&s);
    CHECK(lom_query_result(much, &samples) && samples == 2 * 256, "two draws add up to %llu",
          (unsigned long long)samples);
    CHECK(red_after(&s, much, false, own) == 255 && lom_query_result(own, &samples) && samples == 256, "drawn");
    CHECK(red_after(&s, nothing, false, own) == 0 && lom_query_result(own, &samples) && samples == 0,
          "left out, and counted as nothing: %llu", (unsigned long long)samples);
    CHECK(red_after(&s, much, true, NULL) == 0 && red_after(&s, nothing, true, NULL) == 255, "inverted");
    CHECK(lom_query_result(own, &samples) && samples == 0, "a pass without it leaves a result as it is");
    /* Within a pass the result is that of the pass before. */
    CHECK(red_after(&s, much, false, much) == 255 && red_after(&s, nothing, false, nothing) == 0, "by its own query");
    uint64_t draws = lom_device_counters(s.device).draws;
    red_after(&s, nothing, false, NULL);
    CHECK(lom_device_counters(s.device).draws == draws, "what is left out is no work");
    close_stage(&s);
}

/* Queries of a device are many and go in any order. */
static void queries_are_counted_apart(void)
{
    enum { QUERIES = 100 };
    stage s = open_stage((lom_device_desc){ .threads = 3, .tile = 16 }, 128, 128, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_query *query[QUERIES];
    for (int i = 0; i < QUERIES; i++)
        query[i] = lom_make_query(s.device);
    for (int i = 0; i < QUERIES; i += 7) {
        lom_release_query(s.device, query[i]);
        query[i] = lom_make_query(s.device);
    }
    begin(&s, (lom_pass_desc){ .label = NULL });
    for (int n = 0; n < 2 * QUERIES; n++) {
        int i = n * 37 % QUERIES;
        lom_draw_desc draw = draw_of(&values, whole, 3);
        draw.scissor = (lom_rect){ i, n / QUERIES, 1 + i % 20, 50 };
        draw.query = query[i];
        lom_draw(s.device, &draw);
    }
    finish(&s);
    for (int i = 0; i < QUERIES; i++) {
        uint64_t samples = 0;
        int width = i + 1 + i % 20 > 128 ? 128 - i : 1 + i % 20;
        CHECK(lom_query_result(query[i], &samples) && samples == 2 * 50 * (uint64_t)width, "query %d: %llu", i,
              (unsigned long long)samples);
    }
    close_stage(&s);
}

/* ---- what cannot be ---- */

static void said(lom_device *device, const char *what)
{
    CHECK(!lom_end_pass(device) && strstr(lom_device_error(device)->text, what) != NULL, "%s: \"%s\"", what,
          lom_device_error(device)->text);
}

static void what_cannot_be_is_refused(void)
{
    for (int n = 0; n < 4; n++) {
        static const char *const texts[] = { "names a query of another device", "names a query of another device",
                                             "that no pass has counted yet", "cannot be freed within a pass" };
        stage s = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        stage other = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        lom_query *own = lom_make_query(s.device), *foreign = lom_make_query(other.device);
        lom_draw_desc draw = draw_of(&values, whole, 3);
        draw.query = n == 0 ? foreign : NULL;
        draw.condition = n == 1 ? foreign : n == 2 ? own : NULL;
        lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
        if (n == 3)
            lom_release_query(s.device, own);
        lom_draw(s.device, &draw);
        said(s.device, texts[n]);
        close_stage(&s);
        close_stage(&other);
    }
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    stage other = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    uint64_t samples = 7;
    lom_release_query(s.device, NULL);
    lom_release_query(NULL, NULL);
    CHECK(!lom_query_result(NULL, &samples) && samples == 0, "no query has no result");
    CHECK(lom_make_query(NULL) == NULL, "no device makes none");
    lom_release_query(s.device, lom_make_query(other.device));
    CHECK(strstr(lom_device_error(s.device)->text, "not one of its own") != NULL, "\"%s\"",
          lom_device_error(s.device)->text);
    CHECK(lom_make_query(s.device) == NULL, "a device that has failed makes none");
    close_stage(&s);
    close_stage(&other);
}

int main(int argc, char **argv)
{
    RUN(counts_are_those_of_the_oracle);
    RUN(hidden_samples_do_not_count);
    RUN(conditions_leave_draws_out);
    RUN(queries_are_counted_apart);
    RUN(what_cannot_be_is_refused);
    return check_result();
}
