/* Lesson 14. Lanes and tiles: lanes OUT.png
 * In: 500 small triangles. Out: a picture of them, twice: each pixel in the colour of its lane, left where every triangle fills
 * packets of its own, right where the pixels of all triangles of a tile share packets; lines are the edges of tiles of 32
 * x 32 pixels. Below each: a bar as long as the share of lanes that had work. */
#include <lom/image.h>
#include <lom/lanes.h>

#include <stdio.h>

enum { TILE = 32, TILES = 5, SIDE = TILE * TILES, BAR = 20, TRIANGLES = 500, BOX = 8, PACKET = 16 };

struct triangle {
    float right[3], down[3], at[3]; /* edge function i at (x, y): right x + down y + at, above 0 inside */
    int left, top, end, bottom;     /* its pixels lie in [left, end[ and [top, bottom[ */
};

struct packets { /* how many were started, and how many lanes of them had work */
    int count, used, waiting;
};

static int random_below(int limit, int which, int number)
{
    return lom_int_of(lom_random_uniform((uint64_t)which, (uint64_t)number) * limit);
}

/* A triangle within 8 x 8 pixels, its corners clockwise on the screen; whole coordinates keep edges exact in float. */
static struct triangle make_triangle(int number)
{
    struct triangle t = { .left = random_below(SIDE - BOX, 0, number), .top = random_below(SIDE - BOX, 1, number) };
    int x[3] = { 0, BOX, random_below(BOX, 2, number) },
        y[3] = { random_below(BOX / 2, 3, number), random_below(BOX / 2, 4, number), BOX };
    for (int i = 0; i < 3; i++) {
        int from = (i + 1) % 3, to = (i + 2) % 3, dx = x[to] - x[from], dy = y[to] - y[from];
        t.right[i] = (float)-dy;
        t.down[i] = (float)dx;
        t.at[i] = (float)(dy * (x[from] + t.left) - dx * (y[from] + t.top));
    }
    t.end = t.left + BOX;
    t.bottom = t.top + BOX;
    return t;
}

/* Which of the LOM_LANES pixels from (x, y) to the right are inside: a comparison of vectors is a mask, -1 or 0 a lane. */
static lom_mask covered(const struct triangle *t, int x, int y)
{
    lom_float px = lom_to_float(lom_splat_int(x) + lom_lane_index()) + 0.5f;
    lom_mask inside = lom_splat_int(-1);
    for (int i = 0; i < 3; i++)
        inside &= px * t->right[i] + (((float)y + 0.5f) * t->down[i] + t->at[i]) > 0.0f;
    return inside;
}

/* The covered pixels of one triangle in one tile go into packets, lane by lane. */
static void fill_packets(lom_image *picture, const struct triangle *t, int tile_x, int tile_y, int left,
                         struct packets *p)
{
    for (int y = t->top > tile_y ? t->top : tile_y; y < t->bottom && y < tile_y + TILE; y++)
        for (int x = tile_x; x < tile_x + TILE; x += LOM_LANES) {
            uint32_t bits = lom_bits(covered(t, x, y)); /* bit i: lane i */
            for (int lane = 0; lane < LOM_LANES; lane++) {
                if ((bits >> lane & 1) == 0)
                    continue;
                p->count += p->waiting == 0; /* the packet before is full, or was closed */
                uint8_t *pixel = lom_image_pixel(picture, left + x + lane, y, 0);
                pixel[0] = (uint8_t)(40 + 13 * p->waiting); /* from blue to yellow */
                pixel[1] = (uint8_t)(60 + 11 * p->waiting);
                pixel[2] = (uint8_t)(220 - 12 * p->waiting);
                p->waiting = (p->waiting + 1) % PACKET;
                p->used++;
            }
        }
}

static void draw_half(lom_image *picture, int left, bool shared)
{
    struct packets p = { 0, 0, 0 };
    for (int tile = 0; tile < TILES * TILES; tile++) {
        int x = tile % TILES * TILE, y = tile / TILES * TILE;
        for (int i = 0; i < TRIANGLES; i++) {
            struct triangle t = make_triangle(i);
            if (t.left >= x + TILE || t.end <= x || t.top >= y + TILE || t.bottom <= y)
                continue; /* it is in no bin of this tile */
            fill_packets(picture, &t, x, y, left, &p);
            p.waiting = shared ? p.waiting : 0; /* else the rest of its last packet stays empty */
        }
        p.waiting = 0;
    }
    double share = p.count == 0 ? 0 : p.used / ((double)p.count * PACKET);
    printf("%s: %d packets, %.3f of their lanes used\n", shared ? "shared" : "a triangle at a time", p.count, share);
    for (int i = 0; i < SIDE * SIDE; i++)
        if (i % SIDE % TILE == 0 || i / SIDE % TILE == 0)
            memset(lom_image_pixel(picture, left + i % SIDE, i / SIDE, 0), 90, 3);
    for (int i = 0; i < SIDE * BAR; i++)
        memset(lom_image_pixel(picture, left + i % SIDE, SIDE + i / SIDE, 0), i % SIDE < share * SIDE ? 220 : 60, 3);
}

int main(int argc, char **argv)
{
    lom_image *picture = lom_create_image(2 * SIDE, SIDE + BAR, 1, LOM_FORMAT_RGB8_SRGB, NULL);
    for (int half = 0; half < 2 && picture != NULL; half++)
        draw_half(picture, half * SIDE, half == 1);
    bool done = argc == 2 && picture != NULL && lom_write_image(argv[1], NULL, picture, NULL);
    lom_free_image(picture);
    if (!done)
        fprintf(stderr, "lanes: nothing was written; usage: lanes OUT.png\n");
    return done ? 0 : 2;
}
