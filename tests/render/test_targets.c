/* Proves of the targets of a frame: each is of the size and the format that its name asks for; two names bear one texture
 * exactly where sizes and models allow it, which changes no byte of a picture; the bytes that a frame is said to take are
 * those of its textures; a frame of another size leaves none of the last one's; a tone curve has floats, also
 * after a change, and its pixels have the order that is asked for. */
#include "check.h"
#include "render/renderer.h"
#include "small_scene.h"

/* A renderer of the small scene with planar water and up to three assignments of keys, after a frame. */
struct drawn {
    lom_scene *scene;
    lom_renderer *renderer;
    lom_image *image;
};

static struct drawn draw(const char *const *settings, size_t count, const lom_frame_desc *desc)
{
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    const char *assigned[4] = { "quality.water=planar" };
    for (size_t i = 0; i < count; i++)
        assigned[i + 1] = settings[i];
    struct drawn d = { .scene = lom_read_scene(small_path("scene.toml"), assigned, count + 1, &error) };
    d.renderer = d.scene != NULL ? lom_create_renderer(d.scene, &(lom_device_desc){ .threads = 1 }, &error) : NULL;
    if (d.renderer == NULL || !lom_render_frame(d.renderer, desc, &frame, &error)) {
        printf("FAIL draw: %s\n", error.text);
        exit(1);
    }
    d.image = frame.image;
    return d;
}

static void let_go(struct drawn d)
{
    lom_free_image(d.image);
    lom_free_renderer(d.renderer);
    lom_free_scene(d.scene);
}

static bool is_shared(const lom_renderer *r, enum lom_target a, enum lom_target b)
{
    return r->targets.of[a] != NULL && r->targets.of[a] == r->targets.of[b];
}

/* What the textures hold on their finest levels, and the picture. */
static uint64_t bytes_of(const lom_renderer *r)
{
    uint64_t bytes = 0;
    for (size_t i = 0; i <= r->targets.made_count; i++) {
        const lom_texture *t = i < r->targets.made_count ? r->targets.made[i] : r->targets.of[LOM_TARGET_COLOR];
        lom_image *level = lom_read_texture(t, 0, 0, NULL);
        CHECK(level != NULL, "target %zu cannot be read", i);
        bytes += (uint64_t)level->width * (uint64_t)level->height * lom_format_size(level->format);
        lom_free_image(level);
    }
    return bytes;
}

static const struct {
    const char *settings[3];
    size_t count;
    bool mask, depth; /* whether they share the textures of the refraction */
    size_t textures;
} cases[] = {
    { { "water.enabled=false" }, 1, false, false, 2 },
    { { "quality.reflection_scale=1", "quality.refraction_scale=1" }, 2, true, true, 5 },
    { { "quality.reflection_scale=0.5", "quality.refraction_scale=1" }, 2, true, false, 6 },
    { { "quality.reflection_scale=0.5", "quality.refraction_scale=0.5" }, 2, false, true, 6 },
    { { "quality.reflection_scale=1", "quality.refraction_scale=1", "output.format=rgb16" }, 3, false, true, 6 },
    { { "quality.reflection_scale=1", "quality.refraction_scale=1", "output.exposure=1" }, 3, false, true, 6 },
    { { "quality.reflection_scale=1", "quality.refraction_scale=1", "output.curve=aces" }, 3, false, true, 6 },
    { { "quality.reflection_scale=1", "quality.refraction_scale=1", "quality.water=normal_map" }, 3, true, false, 6 },
};

static void names_share_where_they_may(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct drawn d = draw(cases[i].settings, cases[i].count, &(lom_frame_desc){ 0 });
        const char *last = cases[i].settings[cases[i].count - 1];
        CHECK(is_shared(d.renderer, LOM_TARGET_MASK, LOM_TARGET_REFRACTION) == cases[i].mask, "case %zu, %s", i, last);
        CHECK(is_shared(d.renderer, LOM_TARGET_REFLECTION_DEPTH, LOM_TARGET_REFRACTION_DEPTH) == cases[i].depth,
              "case %zu, %s", i, last);
        CHECK(d.renderer->targets.made_count == cases[i].textures, "case %zu, %s: %zu textures", i, last,
              d.renderer->targets.made_count);
        uint64_t said = lom_target_bytes(d.scene, 32, 18, 32, 18), held = bytes_of(d.renderer);
        CHECK(said == held, "case %zu, %s: %llu bytes are said, %llu held", i, last, (unsigned long long)said,
              (unsigned long long)held);
        let_go(d);
    }
}

/* A frame by a renderer that drew something else before. */
static bool draws_again(lom_renderer *renderer, const lom_frame_desc *desc, const lom_image *expected)
{
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    bool same =
        lom_render_frame(renderer, desc, &frame, &error) && lom_hash_image(frame.image) == lom_hash_image(expected);
    lom_free_image(frame.image);
    return same;
}

/* The mask and the refraction are of one size in a whole frame, and of two in a crop of all but a column. */
static void sharing_changes_no_byte(void)
{
    static const char *const settings[] = { "quality.reflection_scale=1", "quality.refraction_scale=1" };
    static const lom_frame_desc all = { .frame = 0 }, crop = { .crop = { 1, 0, 31, 18 } };
    struct drawn whole = draw(settings, 2, &all), part = draw(settings, 2, &crop);
    CHECK(is_shared(whole.renderer, LOM_TARGET_MASK, LOM_TARGET_REFRACTION), "the frame's mask is not the refraction");
    CHECK(!is_shared(part.renderer, LOM_TARGET_MASK, LOM_TARGET_REFRACTION), "the crop's mask is the refraction");
    for (int y = 0; y < 18; y++)
        CHECK(memcmp(lom_image_pixel(whole.image, 1, y, 0), lom_image_pixel(part.image, 0, y, 0), 31 * 3) == 0,
              "row %d of the crop is not that of the frame", y);
    CHECK(draws_again(part.renderer, &all, whole.image), "a frame after a crop is not the frame");
    CHECK(draws_again(whole.renderer, &crop, part.image), "a crop after a frame is not the crop");
    CHECK(part.renderer->targets.made_count == 5, "%zu textures after the crop", part.renderer->targets.made_count);
    CHECK(whole.renderer->targets.made_count == 6, "%zu textures of the crop", whole.renderer->targets.made_count);
    let_go(whole);
    let_go(part);
}

static void targets_have_their_sizes(void)
{
    static const char *const settings[] = { "quality.reflection_scale=0.5", "quality.refraction_scale=0.25" };
    struct drawn d = draw(settings, 2, &(lom_frame_desc){ .crop = { 3, 2, 20, 10 } });
    static const int sizes[LOM_TARGETS][2] = {
        [LOM_TARGET_COLOR] = { 20, 10 },    [LOM_TARGET_DEPTH] = { 20, 10 },
        [LOM_TARGET_MASK] = { 20, 10 },     [LOM_TARGET_REFLECTION] = { 16, 9 },
        [LOM_TARGET_REFRACTION] = { 8, 5 }, [LOM_TARGET_REFLECTION_DEPTH] = { 16, 9 },
        [LOM_TARGET_SPRAY] = { 0, 0 },      [LOM_TARGET_REFRACTION_DEPTH] = { 8, 5 },
    };
    for (int i = 0; i < LOM_TARGETS; i++) {
        const lom_texture *t = d.renderer->targets.of[i];
        int width = t != NULL ? lom_texture_width(t) : 0, height = t != NULL ? lom_texture_height(t) : 0;
        CHECK(width == sizes[i][0] && height == sizes[i][1], "target %d is of %d x %d texels", i, width, height);
    }
    let_go(d);
}

/* From 8 bits to floats, and back. */
static void a_curve_makes_targets_anew(void)
{
    static const char *const curve[] = { "output.curve=filmic" };
    static const lom_frame_desc desc = { .frame = 0 };
    struct drawn plain = draw(NULL, 0, &desc), toned = draw(curve, 1, &desc);
    lom_error error = { 0 };
    CHECK(lom_hash_image(plain.image) != lom_hash_image(toned.image), "a curve changes nothing");
    CHECK(lom_change_scene(plain.renderer, toned.scene, NULL, &error), "%s", error.text);
    CHECK(draws_again(plain.renderer, &desc, toned.image), "a frame after a change to a curve is another");
    CHECK(lom_change_scene(plain.renderer, plain.scene, NULL, &error), "%s", error.text);
    CHECK(draws_again(plain.renderer, &desc, plain.image), "a frame after a change from a curve is another");
    let_go(plain);
    let_go(toned);
}

/* In rows of the caller's, the picture's samples in every order; drawn and traced. */
static void toned_pixels_have_their_order(void)
{
    static const char *const settings[] = { "output.curve=filmic", "output.exposure=1", "quality.water=reference",
                                            "quality.reference.samples=1" };
    for (size_t count = 2; count <= 4; count += 2) {
        struct drawn d = draw(settings, count, &(lom_frame_desc){ .frame = 0 });
        for (int order = LOM_ORDER_OUTPUT; order <= LOM_ORDER_BGRX; order++) {
            uint8_t pixels[18][32 * 4] = { { 0 } };
            lom_frame frame = { .image = NULL };
            lom_error error = { 0 };
            const lom_frame_desc desc = { .pixels = pixels, .pitch = sizeof *pixels, .order = (lom_pixel_order)order };
            bool same = lom_render_frame(d.renderer, &desc, &frame, &error);
            const int step = order == LOM_ORDER_OUTPUT ? 3 : 4, red = order == LOM_ORDER_BGRX ? 2 : 0;
            for (int y = 0; y < 18; y++)
                for (int x = 0; x < 32; x++) {
                    const uint8_t *from = lom_image_pixel(d.image, x, y, 0), *to = &pixels[y][x * step];
                    same = same && to[red] == from[0] && to[1] == from[1] && to[2 - red] == from[2] &&
                           (step == 3 || to[3] == 255);
                }
            CHECK(same, "%zu settings, order %d: other pixels %s", count, order, error.text);
        }
        let_go(d);
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(names_share_where_they_may);
    RUN(sharing_changes_no_byte);
    RUN(targets_have_their_sizes);
    RUN(a_curve_makes_targets_anew);
    RUN(toned_pixels_have_their_order);
    remove_small_scene();
    return check_result();
}
