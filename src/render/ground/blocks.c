/* Terrain for drawing. In: a height map. Out: the vertices of every block at every level of detail, how far each level
 * is off, and a texture of normals and the sky's visibility. Level n of a block has the vertices whose column and row
 * within the block are multiples of 2^n or the last. */
#include "base/numbers.h"
#include "geometry/terrain.h"
#include "pipeline/check_device.h"
#include "pipeline/share_work.h"
#include "render/ground/ground.h"

#include <stdatomic.h>

enum { BLOCKS = 8, ROWS = 64 /* that a worker takes at a time */ };

struct loader {
    struct lom_ground *ground;
    const lom_terrain *terrain;
    const lom_image *map;
    int width; /* vertices of a row */
    atomic_bool failed;
    float (*texels)[4];
    float *x;          /* of the columns */
    float *z;          /* of the rows */
    double spacing[2]; /* metres between columns and between rows */
    double base;
};

static void take_row(void *context, int row, const lom_mesh_vertex *vertices)
{
    struct loader *loader = context;
    size_t first = (size_t)row * (size_t)loader->width;
    for (int i = 0; i < loader->width; i++) {
        const lom_mesh_vertex *v = &vertices[i];
        float *texel = loader->texels[first + (size_t)i];
        for (int k = 0; k < 3; k++)
            texel[k] = v->normal[k];
        texel[3] = 1;
        if (row == 0)
            loader->x[i] = v->position[0];
    }
    loader->z[row] = vertices[0].position[2];
}

static bool visit_rows(struct loader *loader, int first, int end, lom_error *error)
{
    const lom_terrain *t = loader->terrain;
    return lom_visit_terrain_rows(loader->map, t->size, t->height, 0, first, end, take_row, loader, error);
}

static void take_rows(void *context, size_t first, size_t end)
{
    struct loader *loader = context;
    if (!visit_rows(loader, (int)first, (int)end, NULL))
        atomic_store_explicit(&loader->failed, true, memory_order_relaxed);
}

/* By all workers; what fails is done again, to say why. */
static bool visit_terrain(struct loader *loader, lom_device *device, lom_error *error)
{
    const int rows = loader->map->height;
    lom_share_work(device, (size_t)rows, ROWS, take_rows, loader);
    return !atomic_load_explicit(&loader->failed, memory_order_relaxed) || visit_rows(loader, 0, rows, error);
}

/* Vertices of a level along an edge of so many quads, less one. */
static int joined(int quads, int level)
{
    return (quads + (1 << level) - 1) >> level;
}

struct place { /* of a block in the grid, a level of it */
    const struct loader *loader;
    const struct lom_ground_block *block;
    int x0, y0, level;
};

static float height_at(const struct place *p, int column, int row)
{
    return p->loader->ground->heights[(size_t)(p->y0 + row) * (size_t)p->loader->width + (size_t)(p->x0 + column)];
}

static void copy_level(const struct place *p, float (*to)[3])
{
    int step = 1 << p->level;
    for (int j = 0; j <= joined(p->block->rows, p->level); j++)
        for (int i = 0; i <= joined(p->block->columns, p->level); i++, to++) {
            int column = lom_smaller_int(i * step, p->block->columns), row = lom_smaller_int(j * step, p->block->rows);
            (*to)[0] = p->loader->x[p->x0 + column];
            (*to)[1] = height_at(p, column, row);
            (*to)[2] = p->loader->z[p->y0 + row];
        }
}

static void find_bounds(const struct place *p, lom_box *box)
{
    float low = height_at(p, 0, 0), high = low;
    for (int j = 0; j <= p->block->rows; j++)
        for (int i = 0; i <= p->block->columns; i++) {
            float y = height_at(p, i, j);
            low = y < low ? y : low;
            high = y > high ? y : high;
        }
    double base = p->loader->base;
    box->low = (lom_vec3){ (double)p->loader->x[p->x0], base + (double)low, (double)p->loader->z[p->y0] };
    box->high = (lom_vec3){ (double)p->loader->x[p->x0 + p->block->columns], base + (double)high,
                            (double)p->loader->z[p->y0 + p->block->rows] };
}

/* Sizes of all blocks and the places of their vertices. */
static bool lay_out(struct lom_ground *ground, lom_error *error)
{
    size_t count = (size_t)ground->across * (size_t)ground->down, next = 0;
    ground->blocks = lom_allocate(count, sizeof *ground->blocks, error);
    ground->level = lom_allocate(count, sizeof *ground->level, error);
    ground->order = lom_allocate(count, sizeof *ground->order, error);
    ground->distance = lom_allocate(count, sizeof *ground->distance, error);
    ground->pattern = lom_allocate(count, sizeof *ground->pattern, error);
    ground->patterns = lom_allocate(LOM_GROUND_PATTERNS, sizeof *ground->patterns, error);
    if (ground->blocks == NULL || ground->level == NULL || ground->order == NULL || ground->distance == NULL ||
        ground->pattern == NULL || ground->patterns == NULL)
        return false;
    for (size_t i = 0; i < count; i++) {
        struct lom_ground_block *b = &ground->blocks[i];
        b->columns =
            lom_smaller_int(LOM_GROUND_BLOCK, ground->columns - (int)(i % (size_t)ground->across) * LOM_GROUND_BLOCK);
        b->rows =
            lom_smaller_int(LOM_GROUND_BLOCK, ground->rows - (int)(i / (size_t)ground->across) * LOM_GROUND_BLOCK);
        for (int level = 0; level < LOM_GROUND_LEVELS; level++) {
            b->first[level] = next;
            next += (size_t)(joined(b->columns, level) + 1) * (size_t)(joined(b->rows, level) + 1);
        }
    }
    ground->position_count = next;
    ground->position = lom_allocate(next, sizeof *ground->position, error);
    return ground->position != NULL;
}

static void fill_blocks(void *context, size_t first, size_t end)
{
    const struct loader *loader = context;
    struct lom_ground *ground = loader->ground;
    const struct lom_ground_grid grid = { ground->heights, loader->width, { loader->spacing[0], loader->spacing[1] } };
    for (int i = (int)first; i < (int)end; i++) {
        struct lom_ground_block *b = &ground->blocks[i];
        struct place p = { loader, b, i % ground->across * LOM_GROUND_BLOCK, i / ground->across * LOM_GROUND_BLOCK, 0 };
        find_bounds(&p, &b->bounds);
        b->error[0] = 0;
        for (p.level = 0; p.level < LOM_GROUND_LEVELS; p.level++) {
            copy_level(&p, ground->position + b->first[p.level]);
            if (p.level > 0)
                b->error[p.level] = lom_find_level_error(&grid, p.x0, p.y0, b, p.level);
        }
    }
}

static bool make_vertex_texture(const struct loader *loader, int height, bool mipmaps, lom_device *device,
                                lom_error *error)
{
    loader->ground->vertex_texture = lom_make_texture(
        device, &(lom_texture_desc){ .width = loader->width,
                                     .height = height,
                                     .format = LOM_FORMAT_RGBA32F,
                                     .pixels = loader->texels,
                                     .label = "terrain normals",
                                     .mips = mipmaps ? LOM_MIPS_ALL : LOM_MIPS_NONE,
                                     .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    return lom_check_device(device, error);
}

bool lom_make_ground_blocks(struct lom_ground *ground, const lom_terrain *t, const lom_image *map, const float *heights,
                            const lom_quality *quality, lom_device *device, lom_error *error)
{
    size_t vertices = (size_t)map->width * (size_t)map->height;
    *ground = (struct lom_ground){ .columns = map->width - 1, .rows = map->height - 1, .heights = heights };
    ground->across = joined(ground->columns, LOM_GROUND_LEVELS - 1);
    ground->down = joined(ground->rows, LOM_GROUND_LEVELS - 1);
    struct loader loader = { .ground = ground,
                             .terrain = t,
                             .map = map,
                             .width = map->width,
                             .base = t->base,
                             .spacing = { t->size[0] / ground->columns, t->size[1] / ground->rows },
                             .texels = lom_allocate(vertices, 4 * sizeof(float), error),
                             .x = lom_allocate((size_t)map->width, sizeof(float), error),
                             .z = lom_allocate((size_t)map->height, sizeof(float), error) };
    bool done =
        loader.texels != NULL && loader.x != NULL && loader.z != NULL && visit_terrain(&loader, device, error) &&
        lay_out(ground, error) && lom_make_ground_patterns(ground, error) &&
        (quality->wireframe == LOM_WIREFRAME_OFF || quality->tessellation || lom_make_ground_wires(ground, error));
    if (done)
        lom_share_work(device, (size_t)ground->across * (size_t)ground->down, BLOCKS, fill_blocks, &loader);
    done = done && lom_group_ground_blocks(ground, error);
    if (done && quality->tessellation)
        done = lom_make_ground_patches(ground, error);
    if (done && quality->ambient_occlusion)
        done = lom_find_sky_visibility(device, ground->heights, map->width, map->height, t->size, &loader.texels[0][3],
                                       4, error);
    done = done && make_vertex_texture(&loader, map->height, quality->mipmaps, device, error);
    lom_release(loader.texels);
    lom_release(loader.x);
    lom_release(loader.z);
    return done;
}

void lom_free_ground_blocks(struct lom_ground *ground)
{
    for (size_t i = 0; i < ground->pattern_count; i++)
        lom_release(ground->patterns[i].wires);
    lom_release(ground->patterns);
    lom_release(ground->indices);
    lom_release(ground->blocks);
    lom_release(ground->level);
    lom_release(ground->pattern);
    lom_release(ground->order);
    lom_release(ground->distance);
    lom_release(ground->position);
    lom_release(ground->groups);
    lom_release(ground->seen);
    lom_release(ground->knot);
    lom_release(ground->patch_corner);
    lom_free_ground_shadow(ground);
}
