/* The flat sky (in two dimensions: shape, noise, detail and a gradient of sunset, each a texture). In: the density that
 * the grid of light averaged, the phase function. Out: a level sheet for each cloud through the middle of its mass.
 * Invariant: the shape absorbs from above what the density does, and both noises are 1 on average. */
#include "cloud/cloud_layers.h"

#include "base/numbers.h"

static const double gentle_depth = 4; /* in the middle of the gradient's height */

void lom_free_cloud_sheet(struct lom_cloud_sheet *sheet)
{
    if (sheet == NULL)
        return;
    lom_free_texture(sheet->shape);
    lom_release(sheet);
}

/* Sums of densities over columns, the largest, and at which part of the box's height half of all of them would balance. */
static void sum_columns(const lom_light_grid *g, float *columns, double *largest, double *balance)
{
    double total = 0, moment = 0;
    const size_t row = (size_t)g->width, slice = row * (size_t)g->height;
    *largest = 0;
    for (size_t z = 0; z < (size_t)g->depth; z++)
        for (size_t x = 0; x < row; x++) {
            double sum = 0;
            for (size_t y = 0; y < (size_t)g->height; y++) {
                double density = g->density[z * slice + y * row + x] / 65535.0;
                sum += density;
                moment += density * ((double)y + 0.5) / g->height;
            }
            columns[z * row + x] = (float)sum;
            total += sum;
            *largest = lom_larger(*largest, sum);
        }
    *balance = total > 0 ? moment / total : 0.5;
}

struct lom_cloud_sheet *lom_make_cloud_sheet(const struct lom_placed_cloud *cloud, lom_error *error)
{
    const lom_light_grid *g = cloud->light;
    const size_t count = (size_t)g->width * (size_t)g->depth;
    struct lom_cloud_sheet *sheet = lom_allocate(1, sizeof *sheet, error);
    float *columns = sheet != NULL ? lom_allocate(count, sizeof *columns, error) : NULL;
    if (sheet != NULL)
        *sheet = (struct lom_cloud_sheet){ .shape = NULL };
    if (columns != NULL) {
        double largest, balance;
        sum_columns(g, columns, &largest, &balance);
        for (size_t i = 0; i < count && largest > 0; i++)
            columns[i] = (float)((double)columns[i] / largest);
        const double *size = cloud->cloud->size;
        sheet->deepest = (float)(largest * size[1] / g->height * cloud->cloud->extinction * cloud->cloud->density);
        sheet->height = (balance - 0.5) * size[1];
        sheet->shape =
            lom_create_texture(&(lom_texture_desc){ .width = g->width,
                                                    .height = g->depth,
                                                    .format = LOM_FORMAT_R32F,
                                                    .pixels = columns,
                                                    .mips = LOM_MIPS_ALL,
                                                    .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } },
                               error);
    }
    lom_release(columns);
    if (sheet == NULL || sheet->shape == NULL) {
        lom_free_cloud_sheet(sheet);
        return NULL;
    }
    return sheet;
}

/* ---- the gradient ---- */

static double henyey_greenstein(double mu, double g)
{
    double base = lom_larger(1 + g * g - 2 * g * mu, 1e-6);
    return (1 - g * g) / (base * lom_double_sqrt(base));
}

/* As the shaders' phase function (phase.h), times 4 pi. */
static double phase_of(const lom_clouds *p, double mu)
{
    switch (p->phase) {
    case LOM_PHASE_DUAL: {
        double ahead = henyey_greenstein(mu, p->forward), back = henyey_greenstein(mu, p->backward);
        return ahead + (back - ahead) * p->blend;
    }
    case LOM_PHASE_HENYEY_GREENSTEIN:
        return henyey_greenstein(mu, p->forward);
    case LOM_PHASE_RAYLEIGH:
        return 0.75 * (1 + mu * mu);
    default:
        return 1;
    }
}

static double sun_of(const lom_clouds *p, int octaves, double mu, double depth)
{
    double phase = phase_of(p, mu), sum = 0, part = depth;
    if (p->silver > 0)
        phase = lom_larger(phase, p->silver * henyey_greenstein(mu, 1 - p->silver_spread));
    for (int k = 0; k < octaves; k++) {
        sum += lom_octave_weight(p->albedo, k) * (k == 0 ? phase : 1) * lom_double_exp(-part);
        part /= 4;
    }
    return sum;
}

lom_image *lom_make_cloud_gradient(const lom_clouds *p, int octaves, lom_error *error)
{
    lom_image *image = lom_create_image(LOM_GRADIENT_WIDTH, LOM_GRADIENT_HEIGHT, 1, LOM_FORMAT_RGB32F, error);
    for (int y = 0; image != NULL && y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            double s = (x + 0.5) / image->width, t = (y + 0.5) / image->height;
            /* seen from below, as march/medium_steps.h has it: 1 / (2 + c 2 depth), c = 3/4 (1 - 0.85) */
            double depth = gentle_depth * t / (1 - t), sky = 0.5 / (1 + 0.1125 * depth);
            const float texel[3] = { (float)sun_of(p, octaves, 1 - 2 * s * s, depth), (float)sky, (float)(1 - sky) };
            memcpy(lom_image_pixel(image, x, y, 0), texel, sizeof texel);
        }
    return image;
}

bool lom_update_cloud_gradient(struct lom_cloud_set *set, lom_error *error)
{
    const lom_clouds *p = set->params;
    const double told[] = { p->albedo, p->phase, p->forward, p->backward, p->blend, p->silver, p->silver_spread };
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, told, sizeof told) | 1;
    if (set->gradient_of == hash)
        return true;
    lom_image *image = lom_make_cloud_gradient(p, set->quality.octaves, error);
    lom_texture *made =
        image != NULL ? lom_create_texture(
                            &(lom_texture_desc){ .width = image->width,
                                                 .height = image->height,
                                                 .format = image->format,
                                                 .pixels = image->pixels,
                                                 .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } },
                            error)
                      : NULL;
    lom_free_image(image);
    if (made == NULL)
        return false;
    lom_free_texture(set->gradient);
    set->gradient = made;
    set->gradient_of = hash;
    return true;
}
