/* Proves of every shader that a scene is drawn with, in every packet that it is given: what it gives a fragment or a vertex is,
 * bit for bit, what a packet of copies of it gives, and what it gives beside others, of earlier packets and of extreme numbers.
 * The scenes are those of key_bases.h, and scenes out of numbers (numbered_scene.h): LOM_CASE=n draws one alone and shows it,
 * LOM_EXHAUSTIVE=1 goes on for LOM_SECONDS (60), from scene LOM_FIRST on, and draws those of assets/. lom_draw and lom_hold_draw are wrapped. */
#include "neighbours.h"

#include "lanes/variants.h"
#include "numbered_scene.h"
#include "pipeline/draw_again.h"

#include <lom/pipeline.h>

#include <stddef.h>
#include <time.h>

void __real_lom_draw(lom_device *device, const lom_draw_desc *desc);
void __wrap_lom_draw(lom_device *device, const lom_draw_desc *desc);
bool __real_lom_hold_draw(lom_device *device, const lom_draw_desc *desc, struct lom_held_draw *held);
bool __wrap_lom_hold_draw(lom_device *device, const lom_draw_desc *desc, struct lom_held_draw *held);

enum {
    SHADERS = 96,
    CASES = 24,
    EAGER = 30, /* packets of a shader and scene that are all tried, and of the others every ... */
    SELDOM = 7,
    RARE = 211, /* of the scenes of assets/, with terrain of a hundred thousand vertices */
    MOST_OUTPUTS = 4 * LOM_MAX_COLORS + 2 > 12 + LOM_MAX_VARYINGS + LOM_MAX_DISTANCES
                       ? 4 * LOM_MAX_COLORS + 2
                       : 12 + LOM_MAX_VARYINGS + LOM_MAX_DISTANCES,
    VARYING_LANES = offsetof(lom_varyings, levels) / sizeof(lom_float),
    ATTRIBUTE_LANES = sizeof(lom_attributes) / sizeof(lom_float)
};

/* A shader that a scene is drawn with, and the one in its place, whose functions try it. */
struct tried {
    const lom_shader *own;
    lom_shader wrapped;
    uint64_t fragments, vertices, tried_fragments, tried_vertices;
    lom_varyings earlier; /* a packet that it was given */
    lom_attributes earlier_vertices;
    bool has_earlier, has_earlier_vertices;
};
static struct tried tried[SHADERS];
static int shader_count, variant, interval = SELDOM;
static const char *scene_name;
static uint64_t scene_number, packets;

static bool is_due(uint64_t *count)
{
    const uint64_t n = (*count)++;
    return n < EAGER || n % (uint64_t)interval == 0;
}

/* ---- lanes ---- */

static void copy_lane(lom_float *to, const lom_float *from, int j, int i, size_t count)
{
    for (size_t k = 0; k < count; k++)
        to[k][j] = from[k][i];
}

static void expect_lane(const struct tried *t, const char *kind, const lom_float *out, const lom_float *other, int i,
                        int outputs, const char *beside)
{
    for (int k = 0; k < outputs; k++)
        CHECK(is_same_lane(out[k], other[k], i), "%s %llu, %s of %s: output %d of lane %d is %.9g, %.9g beside %s",
              scene_name, (unsigned long long)scene_number, kind, t->own->name, k, i, (double)out[k][i],
              (double)other[k][i], beside);
}

/* ---- fragments ---- */

static int run_fragment(const struct tried *t, const lom_varyings *in, const void *uniforms, const lom_fragment *before,
                        lom_float *out)
{
    lom_fragment fragment = *before;
    int outputs = 0;
    t->own->fragment[variant](&fragment, in, uniforms);
    const lom_mask kept = t->own->discards ? ~fragment.discard : ~(lom_mask){ 0 };
    for (int i = 0; i < t->own->colors; i++, outputs += 4) {
        const lom_float4 c = fragment.color[i];
        const lom_float channels[4] = { c.x, c.y, c.z, c.w };
        for (int k = 0; k < 4; k++)
            out[outputs + k] = lom_select(kept, channels[k], (lom_float){ 0 });
    }
    if (t->own->writes_depth)
        out[outputs++] = lom_select(kept, fragment.depth, (lom_float){ 0 });
    out[outputs++] = lom_select(kept, lom_splat(1), (lom_float){ 0 });
    return outputs;
}

/* The other lanes are of an earlier packet, or this one's with extreme varyings. */
static void surround(const struct tried *t, const lom_varyings *in, int i, bool earlier, uint64_t key,
                     lom_varyings *out)
{
    *out = earlier ? t->earlier : *in;
    out->levels = NULL;
    out->covered = lom_splat_int(-1);
    if (!earlier)
        for (int v = 0; v < LOM_MAX_VARYINGS; v++)
            for (int j = 0; j < LOM_LANES; j++)
                if (t->own->reads >> v & 1 && lom_random_bits(key, (uint64_t)(v * LOM_LANES + j)) % 3 == 0) {
                    const float extreme = poison(key, (uint64_t)(v * LOM_LANES + j));
                    out->varying[v][j] = extreme - extreme == 0 ? extreme : 0;
                }
    copy_lane((lom_float *)(void *)out, (const lom_float *)(const void *)in, i, i, VARYING_LANES);
    out->covered[i] = -1;
}

static void try_fragments(struct tried *t, lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_fragment before = *out;
    t->own->fragment[variant](out, in, uniforms);
    if (t->own->quads || !is_due(&t->fragments))
        return;
    lom_float own[MOST_OUTPUTS], other[MOST_OUTPUTS];
    const int outputs = run_fragment(t, in, uniforms, &before, own);
    for (int i = 0; i < LOM_LANES; i++) {
        lom_varyings beside;
        lom_fragment start = before;
        if (!in->covered[i])
            continue;
        memset(&beside, 0, sizeof beside);
        for (int j = 0; j < LOM_LANES; j++) {
            copy_lane((lom_float *)(void *)&beside, (const lom_float *)(const void *)in, j, i, VARYING_LANES);
            start.depth[j] = before.depth[i];
        }
        run_fragment(t, &beside, uniforms, &start, other);
        expect_lane(t, "fragment", own, other, i, outputs, "copies");
        for (int k = t->has_earlier ? 0 : 1; k < 2; k++) {
            surround(t, in, i, k == 0, packets * LOM_LANES + (uint64_t)i, &beside);
            run_fragment(t, &beside, uniforms, &before, other);
            expect_lane(t, "fragment", own, other, i, outputs, k == 0 ? "earlier ones" : "extreme ones");
        }
    }
    packets++;
    t->tried_fragments++;
    t->earlier = *in;
    t->has_earlier = true;
}

/* ---- vertices ---- */

static int run_vertices(const struct tried *t, const lom_attributes *in, const void *uniforms, lom_float *out)
{
    lom_vertex vertex;
    int outputs = 0;
    memset(&vertex, 0, sizeof vertex);
    t->own->vertex[variant](&vertex, in, uniforms);
    memcpy(out, &vertex.position, sizeof vertex.position);
    outputs += 4;
    for (int i = 0; i < t->own->varyings; i++)
        out[outputs++] = vertex.varying[i];
    for (int i = 0; i < t->own->clip_distances + t->own->cull_distances; i++)
        out[outputs++] = vertex.distance[i];
    if (t->own->sprites) {
        memcpy(out + outputs, vertex.axis, sizeof vertex.axis);
        outputs += 8;
    }
    return outputs;
}

static void try_vertices(struct tried *t, lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    t->own->vertex[variant](out, in, uniforms);
    if (!is_due(&t->vertices))
        return;
    lom_float own[MOST_OUTPUTS], other[MOST_OUTPUTS];
    const int outputs = run_vertices(t, in, uniforms, own);
    for (int i = 0; i < LOM_LANES; i++) {
        lom_attributes beside;
        for (int j = 0; j < LOM_LANES; j++)
            copy_lane((lom_float *)(void *)&beside, (const lom_float *)(const void *)in, j, i, ATTRIBUTE_LANES);
        run_vertices(t, &beside, uniforms, other);
        expect_lane(t, "vertex", own, other, i, outputs, "copies");
        beside = t->has_earlier_vertices ? t->earlier_vertices : *in;
        copy_lane((lom_float *)(void *)&beside, (const lom_float *)(const void *)in, i, i, ATTRIBUTE_LANES);
        run_vertices(t, &beside, uniforms, other);
        expect_lane(t, "vertex", own, other, i, outputs, "earlier ones");
    }
    t->tried_vertices++;
    t->earlier_vertices = *in;
    t->has_earlier_vertices = true;
}

/* ---- the functions in their places ---- */

/* C has no closures: a function a shader. */
#define PLACE(n)                                                                                                       \
    static void fragment_##n(lom_fragment *out, const lom_varyings *in, const void *uniforms)                          \
    {                                                                                                                  \
        try_fragments(&tried[n], out, in, uniforms);                                                                   \
    }                                                                                                                  \
    static void vertex_##n(lom_vertex *out, const lom_attributes *in, const void *uniforms)                            \
    {                                                                                                                  \
        try_vertices(&tried[n], out, in, uniforms);                                                                    \
    }
#define EIGHT(X, n) X(n##0) X(n##1) X(n##2) X(n##3) X(n##4) X(n##5) X(n##6) X(n##7)
/* 1..9 in tens: places 10 to 17, 20 to 27 and so on are used. */
#define ALL(X) EIGHT(X, 1) EIGHT(X, 2) EIGHT(X, 3) EIGHT(X, 4) EIGHT(X, 5) EIGHT(X, 6) EIGHT(X, 7) EIGHT(X, 8)
ALL(PLACE)
#define FRAGMENT(n) [n] = fragment_##n,
#define VERTEX(n)   [n] = vertex_##n,
static lom_fragment_function *const fragment_of[SHADERS] = { ALL(FRAGMENT) };
static lom_vertex_function *const vertex_of[SHADERS] = { ALL(VERTEX) };

static struct tried *find_tried(const lom_shader *shader)
{
    int place = 0;
    for (int i = 0; i < SHADERS; i++) {
        if (tried[i].own == shader || &tried[i].wrapped == shader)
            return &tried[i];
        if (fragment_of[i] != NULL && tried[i].own == NULL && place == 0)
            place = i;
    }
    CHECK(place != 0, "more shaders than places");
    struct tried *t = &tried[place];
    t->own = shader;
    t->wrapped = *shader;
    if (shader->fragment[variant] != NULL)
        t->wrapped.fragment[variant] = fragment_of[place];
    t->wrapped.vertex[variant] = vertex_of[place];
    shader_count++;
    return t;
}

void __wrap_lom_draw(lom_device *device, const lom_draw_desc *desc)
{
    lom_draw_desc draw = *desc;
    draw.shader = &find_tried(desc->shader)->wrapped;
    __real_lom_draw(device, &draw);
}

bool __wrap_lom_hold_draw(lom_device *device, const lom_draw_desc *desc, struct lom_held_draw *held)
{
    lom_draw_desc draw = *desc;
    draw.shader = &find_tried(desc->shader)->wrapped;
    return __real_lom_hold_draw(device, &draw, held);
}

/* ---- scenes ---- */

static int drawn, refused;

/* Frees the scene; NULL: it is refused. */
static void draw_scene(lom_scene *scene, const char *name, uint64_t number, int frame_number)
{
    lom_error error;
    const lom_device_desc device = { .threads = 1, .lanes = LOM_LANES };
    const lom_frame_desc desc = { .width = 24, .height = 14, .frame = frame_number };
    lom_frame frame = { .image = NULL };
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &device, &error) : NULL;
    scene_name = name;
    scene_number = number;
    for (int i = 0; i < SHADERS; i++)
        tried[i].fragments = tried[i].vertices = 0;
    if (renderer != NULL && lom_render_frame(renderer, &desc, &frame, &error))
        drawn++;
    else
        refused++;
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void draw_recipe(const struct recipe *r)
{
    lom_error error;
    draw_scene(decode(r, &error), r->name, r->number, r->frame);
}

static uint64_t number_of(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text != NULL ? strtoull(text, NULL, 10) : otherwise;
}

/* Each as it is, with a part more, and with settings, which are taken in turn. */
static void small_scenes(void)
{
    enum { FORMS = 4 };
    static struct recipe r;
    for (size_t i = 0; i < ALL_BASES * FORMS; i++) {
        const struct base *base = numbered_base(i / FORMS);
        memset(&r, 0, sizeof r);
        r.name = base->name;
        r.frame = 1;
        snprintf(r.text, sizeof r.text, "%s%s", head, base->text);
        if (i % FORMS == 1)
            add_part(&r, parts[i / FORMS % (sizeof parts / sizeof *parts)]);
        for (size_t k = 0; k < i % FORMS * 2; k++)
            add_setting(&r, i * MOST_OVERRIDES + k);
        if (strstr(r.text, "\"reference\"\n") == NULL || strstr(r.text, "impostors") != NULL)
            draw_recipe(&r);
    }
    CHECK(refused == 0, "%d of the small scenes are not drawn", refused);
}

static void scenes_of_a_folder(const char *path)
{
    DIR *folder = opendir(path);
    CHECK(folder != NULL, "%s", path);
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
        char file[512];
        lom_error error = { 0 };
        if (strstr(entry->d_name, ".toml") == NULL)
            continue;
        snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
        draw_scene(lom_read_scene(file, NULL, 0, &error), entry->d_name, 0, 1);
    }
    if (folder != NULL)
        closedir(folder);
}

/* Those of assets/, from the folder in which tests run; minutes. */
static void scenes_of_assets(void)
{
    interval = RARE;
    scenes_of_a_folder("assets/scenes");
    scenes_of_a_folder("assets/scenes/features");
}

static void scenes_out_of_numbers(void)
{
    static struct recipe r;
    const bool exhaustive = getenv("LOM_EXHAUSTIVE") != NULL, one = getenv("LOM_CASE") != NULL;
    const uint64_t first = one ? number_of("LOM_CASE", 0) : number_of("LOM_FIRST", 0);
    const time_t end = time(NULL) + (time_t)number_of("LOM_SECONDS", 60);
    uint64_t number = first;
    do {
        make_recipe(&r, number++);
        if (one)
            show(&r);
        draw_recipe(&r);
    } while (!one && (exhaustive ? time(NULL) < end : number < first + CASES));
    printf("  scenes %llu to %llu\n", (unsigned long long)first, (unsigned long long)number - 1);
}

/* Whether they were tried at all. */
static void shaders_are_tried(void)
{
    int fragments = 0, vertices = 0;
    for (int i = 0; i < SHADERS; i++) {
        fragments += tried[i].tried_fragments > 0;
        vertices += tried[i].tried_vertices > 0;
        if (getenv("LOM_SHOW") != NULL && tried[i].own != NULL)
            printf("  %s: %llu packets of fragments, %llu of vertices\n", tried[i].own->name,
                   (unsigned long long)tried[i].tried_fragments, (unsigned long long)tried[i].tried_vertices);
    }
    printf("  %d shaders: fragments of %d, vertices of %d\n", shader_count, fragments, vertices);
    CHECK(getenv("LOM_CASE") != NULL || (fragments >= 30 && vertices >= 40), "few shaders are tried");
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !small_text("wild.obj", wild_obj, &error))
        return 1;
    variant = lom_find_variant(LOM_LANES, false);
    if (getenv("LOM_CASE") == NULL)
        RUN(small_scenes);
    RUN(scenes_out_of_numbers);
    if (getenv("LOM_EXHAUSTIVE") != NULL)
        RUN(scenes_of_assets);
    RUN(shaders_are_tried);
    remove_small_scene();
    return check_result();
}
