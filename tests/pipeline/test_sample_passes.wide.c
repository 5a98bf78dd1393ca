/* Proves of passes of several samples a pixel: where the shader runs; the mean is of linear light; alpha covers the samples
 * that it is worth; textures keep samples from pass to pass; crops, tiles and threads change nothing; what is no number of
 * samples is refused. */
#include "sampled.h"

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

/* ---- where the shader runs ---- */

static void show_place(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->x, in->y, in->varying[0], in->varying[1] };
}

LOM_SHADER(placed, place_values, show_place, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 2),
           .reads_position = true, .colors = 1)

/* A triangle whose varyings are the window position, over one pixel of four samples: what the sum of the samples must be
 * follows from the oracle's bits. */
static void a_fragment_is_shaded_at_the_centre_or_at_its_first_sample(void)
{
    const int samples = 4;
    for (int round = 0; round < 40; round++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
        vertex v[3];
        snapped corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = (snapped){ random_whole(40 * 256, 44 * 256), random_whole(40 * 256, 44 * 256) };
            place_at(&v[k], corner[k].x, corner[k].y, SIZE);
            v[k].value[0] = (float)corner[k].x / 256;
            v[k].value[1] = (float)corner[k].y / 256;
        }
        lom_draw_desc draw = draw_of(&placed, v, 3);
        begin(&s, (lom_pass_desc){ .samples = samples });
        lom_draw(s.device, &draw);
        finish(&s);
        for (int y = 39; y < 45; y++)
            for (int x = 39; x < 45; x++) {
                unsigned bits = samples_of(corner, samples, x, y);
                int at[2] = { 0, 0 }, count = __builtin_popcount(bits);
                if (!covers(corner, x, y) && bits != 0)
                    lom_sample_position(samples, __builtin_ctz(bits), at);
                float place[2] = { (float)x + 0.5f + (float)at[0] / 16, (float)y + 0.5f + (float)at[1] / 16 };
                const float *found = floats_at(&s, x, y);
                for (int k = 0; k < 2; k++) {
                    float wanted = place[k] * (float)count / (float)samples, off = found[2 + k] - wanted;
                    CHECK(found[k] == wanted && off < 1e-4f && off > -1e-4f,
                          "pixel %d,%d with %d samples: %g and %g, not %g", x, y, count, (double)found[k],
                          (double)found[2 + k], (double)wanted);
                }
            }
        close_stage(&s);
    }
}

static void passes_shade_each_sample_of_all_draws(void)
{
    make_heap();
    lom_image *image[2];
    for (int i = 0; i < 2; i++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
        lom_draw_desc draw = draw_of(&values, heap, 3 * TRIANGLES);
        draw.per_sample = i == 0;
        begin(&s, (lom_pass_desc){ .samples = 4, .per_sample = i == 1 });
        lom_draw(s.device, &draw);
        finish(&s);
        image[i] = s.image;
        s.image = NULL;
        close_stage(&s);
    }
    CHECK(same_images(image[0], image[1]), "it matters who says so");
    lom_free_image(image[0]);
    lom_free_image(image[1]);
}

/* ---- the mean ---- */

static void half_plane(vertex v[3], int64_t x, const float value[4])
{
    place_at(&v[0], x, -256 * SIZE, SIZE);
    place_at(&v[1], x, 256 * 3 * SIZE, SIZE);
    place_at(&v[2], x - 256 * 4 * SIZE, 256 * SIZE, SIZE);
    for (int k = 0; k < 3; k++)
        memcpy(v[k].value, value, 4 * sizeof *value);
}

/* White over black to the middle of pixel 20 and further: k of n samples lie left of the edge. */
static void the_mean_is_of_linear_light(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA32F,
                                          LOM_FORMAT_RGBA16F };
    /* sRGB codes of k / 4, correctly rounded (IEC 61966-2-1) */
    static const int encoded[] = { 0, 137, 188, 225, 255 }, plain[] = { 0, 64, 128, 191, 255 };
    for (int f = 0; f < 4; f++)
        for (int edge = 0; edge < 16; edge++) {
            const float white[4] = { 1, 1, 1, 1 };
            vertex v[3];
            stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, formats[f], LOM_FORMAT_NONE);
            int count = 0;
            for (int i = 0; i < 4; i++) {
                int at[2];
                lom_sample_position(4, i, at);
                count += at[0] + 8 < edge;
            }
            half_plane(v, 256 * 20 + 16 * edge, white);
            lom_draw_desc draw = draw_of(&values, v, 3);
            begin(&s, (lom_pass_desc){ .samples = 4 });
            lom_draw(s.device, &draw);
            finish(&s);
            int code = bytes_at(&s, 20, 50)[0];
            if (f < 2)
                CHECK(code == (f == 0 ? encoded : plain)[count] && bytes_at(&s, 20, 50)[3] == plain[count],
                      "%d of 4 samples are white: %d", count, code);
            if (f == 2)
                CHECK(floats_at(&s, 20, 50)[0] == (float)count / 4, "%d of 4 samples are white", count);
            CHECK(f > 1 || (bytes_at(&s, 19, 50)[0] == 255 && bytes_at(&s, 21, 50)[0] == 0), "beside the edge");
            close_stage(&s);
        }
}

/* ---- alpha ---- */

static void alpha_covers_as_many_samples_as_it_is_worth(void)
{
    const float quiet = __builtin_nanf("");
    const float alphas[] = { -1, 0, 0.124f, 0.126f, 0.3f, 0.5f, 0.6f, 0.874f, 0.876f, 1, 7, quiet };
    for (int samples = 1; samples <= 16; samples *= 2)
        for (size_t i = 0; i < sizeof alphas / sizeof alphas[0]; i++) {
            float alpha = alphas[i] > 0 ? alphas[i] < 1 ? alphas[i] : 1 : 0;
            int count = (int)(alpha * (float)samples + 0.5f);
            stage s =
                open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
            vertex v[3];
            half_plane(v, 256 * 20, (const float[4]){ 1, 1, 1, alphas[i] });
            lom_draw_desc draw = draw_of(&values, v, 3);
            draw.alpha_to_coverage = true;
            begin(&s, (lom_pass_desc){ .samples = samples });
            lom_draw(s.device, &draw);
            finish(&s);
            CHECK(floats_at(&s, 9, 50)[0] == (float)count / (float)samples, "alpha %g covers %g of %d samples, not %d",
                  (double)alphas[i], (double)floats_at(&s, 9, 50)[0] * samples, samples, count);
            float depth = *(const float *)lom_image_pixel(s.depths, 9, 50, 0);
            CHECK(depth == (count > 0 ? 0.5f : 0), "alpha %g leaves the depth %g", (double)alphas[i], (double)depth);
            close_stage(&s);
        }
}

/* ---- what is kept ---- */

static stage open_keeping(lom_device_desc desc, int width, int height, int samples)
{
    stage s = { .device = open_device(desc) };
    lom_texture_desc t = { .width = width, .height = height, .format = LOM_FORMAT_RGBA8_SRGB, .samples = samples };
    s.color = lom_make_texture(s.device, &t);
    t.format = LOM_FORMAT_DEPTH32F;
    s.depth = lom_make_texture(s.device, &t);
    return s;
}

static lom_pass_desc keeping(int samples, bool keeps)
{
    lom_pass_desc pass = { .samples = samples, .depth_load = keeps ? LOM_LOAD_KEEP : LOM_LOAD_CLEAR };
    pass.color_load[0] = pass.depth_load;
    pass.clear_color[0][2] = 0.5f;
    return pass;
}

/* A part of the heap; the first pass of a picture clears it. */
static void draw_some(stage *s, int first, int end)
{
    lom_draw_desc draw = draw_of(&values, heap + 3 * first, (size_t)(3 * (end - first)));
    lom_draw(s->device, &draw);
}

static void samples_last_from_pass_to_pass(void)
{
    make_heap();
    stage once = open_keeping((lom_device_desc){ .threads = 1 }, SIZE, SIZE, 4);
    stage twice = open_keeping((lom_device_desc){ .threads = 2, .chunk = 16, .batch = 1 }, SIZE, SIZE, 4);
    stage lost = open_keeping((lom_device_desc){ .threads = 1 }, SIZE, SIZE, 0);
    for (int frame = 0; frame < 2; frame++) { /* the second one finds what the first has left */
        begin(&once, keeping(4, false));
        draw_some(&once, 0, TRIANGLES);
        finish(&once);
        for (int part = 0; part < 3; part++) {
            stage *both[] = { &twice, &lost };
            for (int i = 0; i < 2; i++) {
                begin(both[i], keeping(4, part > 0));
                draw_some(both[i], part == 0 ? 0 : part * 50, part == 2 ? TRIANGLES : part * 50 + 50);
                finish(both[i]);
            }
        }
        CHECK(same_images(once.image, twice.image) && same_images(once.depths, twice.depths),
              "frame %d: three passes end otherwise than one", frame);
        CHECK(!same_images(once.image, lost.image), "what is not kept makes no difference");
    }
    /* A pass of one sample writes texels: the next begins from those in each sample. */
    begin(&twice, keeping(1, true));
    draw_some(&twice, 3, 9);
    finish(&twice);
    begin(&lost, keeping(1, false));
    finish(&lost);
    lom_image *texels = lom_read_texture(twice.color, 0, 0, NULL);
    begin(&twice, keeping(4, true));
    lom_draw_desc nowhere = draw_of(&values, heap, 3);
    nowhere.depth_compare = LOM_COMPARE_NEVER;
    lom_draw(twice.device, &nowhere);
    finish(&twice);
    CHECK(same_images(texels, twice.image), "texels that one sample wrote are not what four begin with");
    lom_free_image(texels);
    close_stage(&once);
    close_stage(&twice);
    close_stage(&lost);
}

/* ---- what must change nothing ---- */

static lom_image *draw_crop(lom_device_desc desc, lom_rect crop, int samples)
{
    stage s = open_keeping(desc, crop.width, crop.height, samples);
    for (int part = 0; part < 2; part++) {
        lom_pass_desc pass = keeping(samples, part > 0);
        pass.frame_width = pass.frame_height = SIZE;
        pass.origin_x = crop.x;
        pass.origin_y = crop.y;
        begin(&s, pass);
        draw_some(&s, part * 80, part * 80 + 80);
        finish(&s);
    }
    lom_image *image = s.image;
    s.image = NULL;
    close_stage(&s);
    return image;
}

static void crops_tiles_and_threads_change_nothing(void)
{
    make_heap();
    for (int k = 0; k < 4; k++) {
        lom_image *whole = draw_crop((lom_device_desc){ .threads = 1 }, (lom_rect){ 0, 0, SIZE, SIZE }, counts[k]);
        lom_image *other = draw_crop((lom_device_desc){ .threads = 3, .tile = 16, .chunk = 16, .batch = 2 },
                                     (lom_rect){ 0, 0, SIZE, SIZE }, counts[k]);
        CHECK(same_images(whole, other), "%d samples: threads, tiles and chunks matter", counts[k]);
        lom_rect r = { 13, 21, 70, 83 };
        lom_image *part = draw_crop((lom_device_desc){ .threads = 2, .tile = 32 }, r, counts[k]);
        for (int y = 0; y < r.height; y++)
            CHECK(memcmp(lom_image_pixel(part, 0, y, 0), lom_image_pixel(whole, r.x, r.y + y, 0),
                         (size_t)r.width * 4) == 0,
                  "%d samples: row %d of a crop is not that of the whole", counts[k], y);
        lom_free_image(whole);
        lom_free_image(other);
        lom_free_image(part);
    }
}

/* ---- what is refused ---- */

static void other_numbers_are_refused(void)
{
    static const int wrong[] = { -1, 3, 5, 12, 17, 32, 1 << 30 };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        begin(&s, (lom_pass_desc){ .samples = wrong[i] });
        CHECK(!lom_end_pass(s.device) && lom_device_error(s.device)->code == LOM_ERROR_USAGE, "a pass of %d samples",
              wrong[i]);
        lom_error error = { 0 };
        CHECK(lom_create_texture(&(lom_texture_desc){ .width = 8, .height = 8, .samples = wrong[i] }, &error) == NULL &&
                  error.code == LOM_ERROR_USAGE,
              "a texture of %d samples", wrong[i]);
        close_stage(&s);
    }
    lom_error error = { 0 };
    lom_texture_desc cube = { .kind = LOM_TEXTURE_CUBE, .width = 8, .height = 8, .samples = 4 };
    CHECK(lom_create_texture(&cube, &error) == NULL && error.code == LOM_ERROR_USAGE, "a cube of 4 samples");
}

int main(int argc, char **argv)
{
    RUN(a_fragment_is_shaded_at_the_centre_or_at_its_first_sample);
    RUN(passes_shade_each_sample_of_all_draws);
    RUN(the_mean_is_of_linear_light);
    RUN(alpha_covers_as_many_samples_as_it_is_worth);
    RUN(samples_last_from_pass_to_pass);
    RUN(crops_tiles_and_threads_change_nothing);
    RUN(other_numbers_are_refused);
    return check_result();
}
