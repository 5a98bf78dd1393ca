/* Proves of every march of <lom/march.h> that what it gives a ray is, bit for bit, what a packet of copies of the ray gives, and
 * stays so whatever the other lanes hold: rays from nowhere, of infinite speed and of none, active or not; through volumes
 * and media in float and in fixed point, with noise, with light, by transfer functions. */
#include "neighbours.h"

#include "media.h"

enum { SIDE = 12, PACKETS = 600 };

struct marched {
    lom_march_desc volume;
    lom_medium_desc medium;
    lom_transfer_desc transfer;
};

static lom_mask active_of(lom_float x)
{
    return x > -0.5f; /* of no number: not */
}

static void call_volume(const void *context, const lom_float *in, lom_float *out)
{
    const struct marched *m = context;
    const lom_float s = lom_splat(0.02f);
    const lom_march_rays rays = { { in[0], in[1], in[2] }, { in[3] * s, in[4] * s, in[5] * s }, active_of(in[6]) };
    lom_float4 sum;
    LOM_WIDE(lom_march_volume)(&sum, &rays, &m->volume, NULL);
    memcpy(out, &sum, sizeof sum);
}

static lom_medium_rays rays_of(const lom_float *in)
{
    lom_medium_rays rays = { .start = { in[0], in[1], in[2] },
                             .along = { in[3], in[4], in[5] },
                             .shift = lom_clamp(in[7], lom_splat(0.01f), lom_splat(1)),
                             .phase = lom_splat(0.5f),
                             .active = active_of(in[6]) };
    LOM_WIDE(lom_cross_box)(&rays);
    rays.enter = lom_select(rays.active, rays.enter, (lom_float){ 0 });
    rays.leave = lom_select(rays.active, rays.leave, (lom_float){ 0 });
    return rays;
}

static void call_medium(const void *context, const lom_float *in, lom_float *out)
{
    const struct marched *m = context;
    const lom_medium_rays rays = rays_of(in);
    lom_medium_result result;
    LOM_WIDE(lom_march_medium)(&result, &rays, &m->medium, NULL);
    memcpy(out, &result, sizeof result);
    LOM_WIDE(lom_medium_depth)(&out[5], &rays, &m->medium, 50);
    out[5] = lom_select(rays.active, out[5], (lom_float){ 0 });
}

static void call_transfer(const void *context, const lom_float *in, lom_float *out)
{
    const struct marched *m = context;
    const lom_medium_rays rays = rays_of(in);
    lom_transfer_result result;
    LOM_WIDE(lom_march_transfer)(&result, &rays, &m->medium, &m->transfer, NULL);
    memcpy(out, &result, sizeof result);
    LOM_WIDE(lom_transfer_depth)(&out[5], &rays, &m->medium, m->transfer.transfer, 50);
    out[5] = lom_select(rays.active, out[5], (lom_float){ 0 });
}

/* Near one another or not; some lanes hold anything. */
static void fill_inputs(lom_float *in, uint64_t n)
{
    const double width = n % 3 == 0 ? 0.02 : n % 3 == 1 ? 0.2 : 1;
    for (int k = 0; k < 8; k++)
        for (int i = 0; i < LOM_LANES; i++) {
            const uint64_t place = (uint64_t)(k * LOM_LANES + i);
            const double middle = lom_random_uniform(n, 1000 + (uint64_t)k) * 2 - (k < 3 ? 0.5 : 1);
            in[k][i] = (float)(middle + width * (lom_random_uniform(n, place) - 0.5));
            if (k >= 6)
                in[k][i] = (float)(lom_random_uniform(n, place) * 3 - 1);
            if (lom_random_bits(n, 2000 + place) % 24 == 0)
                in[k][i] = poison(n, 3000 + place);
        }
}

static void try_march(const char *name, lane_function *function, int outputs, const struct marched *m)
{
    const struct lane_case c = { name, function, m, 8, outputs };
    for (uint64_t n = 0; n < PACKETS / LOM_LANES; n++) {
        lom_float in[MOST_LANE_INPUTS];
        fill_inputs(in, n);
        expect_lanes_alone(&c, in, n);
    }
}

static void volumes(void)
{
    uint32_t state = 3;
    lom_image *image = lom_create_image(SIDE, SIDE, SIDE, LOM_FORMAT_RGBA8, NULL);
    for (size_t i = 0; i < lom_image_size(image); i++)
        image->pixels[i] = uniform(&state, 0, 1) < 0.2 ? (uint8_t)uniform(&state, 0, 256) : 0;
    lom_volume *volume = lom_create_volume(image, NULL);
    for (int k = 0; k < 8; k++) {
        const struct marched m = { .volume = { .volume = volume,
                                               .steps = 1 + k * 20,
                                               .absorption = 0.5f,
                                               .light_offset = { 0.02f, 0.07f, 0.01f },
                                               .shade = 0.6f,
                                               .opaque = k % 4 == 0 ? 0 : 0.7f,
                                               .walk = k % 4 == 3,
                                               .filtering = k % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED } };
        try_march("lom_march_volume", call_volume, 4, &m);
    }
    lom_free_volume(volume);
    lom_free_image(image);
}

static lom_detail *random_detail(uint32_t *state)
{
    lom_image *image = lom_create_image(4, 4, 4, LOM_FORMAT_R8, NULL);
    for (int i = 0; i < 64; i++)
        image->pixels[i] = uniform(state, 0, 1) < 0.5 ? 255 : (uint8_t)uniform(state, 0, 256);
    lom_detail *detail = lom_create_detail(image, NULL);
    lom_free_image(image);
    return detail;
}

static void try_media(const char *name, lane_function *function, int outputs, const lom_transfer_desc *transfer)
{
    uint32_t state = 5;
    lom_detail *detail = random_detail(&state);
    for (int k = 0; k < 8; k++) {
        lom_image *image = blobs(&state, SIDE);
        lom_medium *medium = lom_create_medium(image, NULL);
        struct marched m = { .medium = plain(medium, k % 2 == 0 ? 3 : 300, uniform(&state, 0.01, 0.1)) };
        if (transfer != NULL)
            m.transfer = *transfer;
        m.medium.most_steps = 100;
        m.medium.stop = k % 4 == 0 ? 1 : k % 4 == 1 ? 0 : 0.1f;
        m.medium.walk = k == 7;
        m.medium.filtering = k % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED;
        m.medium.detail = k % 4 < 2 && transfer == NULL ? detail : NULL;
        m.medium.detail_strength = k == 0 ? 1 : 0.5f;
        m.medium.detail_near = 0.2f;
        m.medium.detail_far = 1;
        for (int i = 0; i < 3; i++)
            m.medium.detail_scale[i] = 3;
        try_march(name, function, outputs, &m);
        lom_free_medium(medium);
        lom_free_image(image);
    }
    lom_free_detail(detail);
}

static void media(void)
{
    try_media("lom_march_medium", call_medium, 6, NULL);
}

static void transfer_functions(void)
{
    static const lom_transfer_point points[] = { { .value = 0 },
                                                 { .value = 0.3, .extinction = 0.1, .color = { 1, 0.5, 0.2 } },
                                                 { .value = 1, .extinction = 1, .color = { 0.1, 1, 0.3 } } };
    lom_error error;
    lom_transfer_function function;
    CHECK(lom_make_transfer_function(points, 3, &function, &error), "%s", error.text);
    const lom_transfer_desc desc = {
        .transfer = &function, .look = LOM_LOOK_GLOWING, .size = { 1, 1, 1 }, .to_light = { 0, 1, 0 }
    };
    try_media("lom_march_transfer", call_transfer, 6, &desc);
}

int main(int argc, char **argv)
{
    RUN(volumes);
    RUN(media);
    RUN(transfer_functions);
    return check_result();
}
