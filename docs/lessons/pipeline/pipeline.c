/* The whole pipeline in one file: one vertex, one triangle, one pixel after the other, to the same bytes as liblom with
 * its lanes, tiles, bins and threads (tests/lessons). Read it from top to bottom: the sections bear the names of the
 * stages' files in src/pipeline; README.md beside it is the map. `pipeline OUT.png` draws its picture.
 * Floats are rounded after each + - * / and square root, in the order written here, never two roundings in one
 * (-ffp-contract=off). Of the library it takes meshes, matrices in double, files, a power for sRGB, and no stage. */
#include <lom/geometry.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* What a vertex has, of which a fragment has the first, the varyings. DISTANCE: to a clip plane; CLIP: x, y, z, w. */
enum { S, T, NORMAL, WORLD = NORMAL + 3, VARYINGS = WORLD + 3, DISTANCE = VARYINGS, CLIP, VALUES = CLIP + 4 };
enum { OUT_DISTANCE = 1, OUT_NEAR = 2, OUT_FAR = 4, OUT_W = 8, OUT_BAND = 16, NO_NUMBER = 32 };
enum { UNITS = 256, BAND = 32760 }; /* positions in a pixel, an axis; pixels from the centre to the guard band's edge */
static const float smallest_w = 1e-30f, most_weight = 0x1.fffffcp-1f; /* 1 - 2^-23 */
static const float to_light[3] = { 0.48f, 0.8f, 0.36f }, lamp = 0.85f, ambient = 0.15f, shine = 0.5f;

struct uniforms { /* the same for the whole draw */
    lom_matrix_uniform to_clip, to_world, normal_to_world;
    float clip_plane[4]; /* drawn is where x p[0] + y p[1] + z p[2] + p[3] >= 0 in the world */
    float eye[3], tiling[2], opacity;
    int shininess;
};

struct texture { /* levels of half the size down to 1 x 1; sizes are powers of two */
    int levels;
    struct level {
        int width, height;
        float (*texel)[4]; /* linear light, alpha 0..255 */
    } level[16];
};

struct vertex {
    float value[VALUES], depth, one_over_w;
    unsigned code; /* OUT_... */
    int32_t x, y;  /* in the window, in units, from the top left */
};

struct triangle {
    struct vertex v[3];        /* in the order of window (y, x) */
    int64_t right[3], down[3]; /* the change of each edge function a unit right and down */
    float inverse_area;        /* of twice the area */
    bool crosses, keeps_zero;  /* the user's clip plane */
    float distance[3];         /* to it, over w, all scaled alike */
};

struct fragment {
    int x, y;
    float l[3], depth, w, varying[VARYINGS], ds[2], dt[2], lod, texel[4], color[4];
};

struct picture {
    int width, height;
    float band[2];         /* |x|, |y| over w at the edge of the guard band */
    uint8_t (*color)[4];   /* sRGB-encoded, alpha linear */
    float *depth;          /* reversed: 1 at the near plane, 0 infinitely far, since floats are densest near 0 */
    struct fragment *seen; /* where not NULL: the last fragment that each pixel took */
};

struct draw {
    const lom_mesh *mesh;
    const struct texture *texture;
    struct uniforms uniforms;
    int cull; /* of the sides, 1: the back, -1: the front, 0: none */
    bool blends;
};

/* ---- numbers ---- */
static float lesser(float a, float b)
{
    return a < b ? a : b; /* b where either is NaN */
}

static float greater(float a, float b)
{
    return a > b ? a : b;
}

static float clamp(float x, float low, float high)
{
    return lesser(greater(x, low), high);
}

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalize(float v[3])
{
    float square = dot(v, v), inverse = square > 0 ? 1 / sqrtf(square) : 0;
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * inverse;
}

/* The code of sRGB to linear light and back (IEC 61966-2-1), to nearest: in double, so that one rounding is left. */
static float decode(int code)
{
    double c = code / 255.0;
    return (float)(c <= 0.04045 ? c / 12.92 : lom_double_pow((c + 0.055) / 1.055, 2.4));
}

static uint8_t encode(float light)
{
    double x = clamp(light, 0, 1), c = x <= 0.0031308 ? 12.92 * x : 1.055 * lom_double_pow(x, 1 / 2.4) - 0.055;
    return (uint8_t)lom_count_of(255 * c + 0.5, 255);
}

/* ---- texture (src/image/mipmap.c): levels of half the size, means of linear light in 8 bits (Williams 1983) ---- */
static void shrink(const struct level *from, int x, int y, float texel[4])
{
    int width = from->width > 1 ? 2 : 1, height = from->height > 1 ? 2 : 1;
    double sum[4] = { 0 };
    for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++)
            for (int c = 0; c < 4; c++)
                sum[c] += from->texel[(y * height + j) * from->width + x * width + i][c];
    for (int c = 0; c < 3; c++)
        texel[c] = decode(encode((float)(sum[c] / (width * height))));
    texel[3] = (float)rint(sum[3] / (width * height)); /* ties to even */
}

/* Of 8-bit RGBA; room: for the texels of all levels, twice as many as the first has. */
static struct texture make_texture(int width, int height, const uint8_t *rgba, float (*room)[4])
{
    struct texture t = { 1, { { width, height, room } } };
    for (int i = 0; i < 4 * width * height; i++)
        room[i / 4][i % 4] = i % 4 < 3 ? decode(rgba[i]) : rgba[i];
    for (struct level *l = t.level; l->width * l->height > 1; l++, t.levels++) {
        l[1] = (struct level){ (l->width + 1) / 2, (l->height + 1) / 2, l->texel + l->width * l->height };
        for (int i = 0; i < l[1].width * l[1].height; i++)
            shrink(l, i % l[1].width, i / l[1].width, l[1].texel[i]);
    }
    return t;
}

/* ---- vertex (vertex.wide.c): to clip space by one matrix, projection view model, rounded once from double ---- */
static void shade_vertex(const struct picture *p, const struct uniforms *u, const lom_mesh_vertex *in, struct vertex *v)
{
    v->value[S] = in->uv[0] * u->tiling[0];
    v->value[T] = in->uv[1] * u->tiling[1];
    for (int i = 0; i < 4; i++)
        v->value[CLIP + i] = dot(in->position, u->to_clip.m[i]) + u->to_clip.m[i][3];
    for (int i = 0; i < 3; i++) {
        v->value[NORMAL + i] = dot(in->normal, u->normal_to_world.m[i]);
        v->value[WORLD + i] = dot(in->position, u->to_world.m[i]) + u->to_world.m[i][3];
    }
    float distance = dot(v->value + WORLD, u->clip_plane) + u->clip_plane[3];
    v->value[DISTANCE] = clamp(distance, -1e30f, 1e30f);
    /* The outcode: a bit for each side on which it lies outside of 0 <= z <= w, the guard band, a user's plane. */
    const float *at = v->value + CLIP, z = at[2], w = at[3];
    bool outside = fabsf(at[0]) >= w * p->band[0] || fabsf(at[1]) >= w * p->band[1];
    v->code = (distance < 0 ? OUT_DISTANCE : 0) | (w - z < 0 ? OUT_NEAR : 0) | (z < 0 ? OUT_FAR : 0) |
              (w < smallest_w ? OUT_W : 0) | (outside ? OUT_BAND : 0) | (distance == distance ? 0 : NO_NUMBER);
    for (int i = 0; i < 4; i++)
        v->code |= fabsf(at[i]) <= 0x1p124f ? 0 : NO_NUMBER;
}

/* ---- clip (clip.c): Sutherland and Hodgman 1974; a user's clip plane is left to raster, which tests pixels ---- */
struct plane { /* inside: n . (x, y, z, w, 1) >= 0; on it, coordinate `axis` is ratio w (axis 3: ratio) */
    double n[5];
    unsigned code;
    int axis;
    float ratio;
};

static double distance_to(const double n[5], const float p[4])
{
    return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3] * p[3] + n[4];
}

/* p + (q - p) t, t = dp / (dp - dq), as one quotient: nothing cancels next to w = 0, and p and q exchanged give the
 * triangle beside it the same vertex. The lexicographically smaller end is p, which decides the sign of a zero. */
static struct vertex cut_edge(const struct plane *plane, const struct vertex *p, const struct vertex *q)
{
    int i = CLIP;
    while (i < CLIP + 3 && p->value[i] == q->value[i])
        i++;
    if (q->value[i] < p->value[i])
        return cut_edge(plane, q, p);
    struct vertex r;
    double dp = distance_to(plane->n, p->value + CLIP), dq = distance_to(plane->n, q->value + CLIP);
    for (i = 0; i < VALUES; i++)
        r.value[i] = (float)((q->value[i] * dp - p->value[i] * dq) / (dp - dq));
    r.value[CLIP + plane->axis] = plane->ratio * (plane->axis == 3 ? 1 : r.value[CLIP + 3]); /* exactly on the plane */
    r.code = r.value[DISTANCE] < 0 ? OUT_DISTANCE : 0;
    return r;
}

/* Leaves of a triangle the part inside of the planes that `codes` name; returns its number of vertices, of a fan. */
static int clip(const struct picture *p, unsigned codes, struct vertex polygon[10])
{
    const struct plane planes[7] = {
        { { 0, 0, 0, 1, -(double)smallest_w }, OUT_W, 3, smallest_w },
        { { 0, 0, -1, 1, 0 }, OUT_NEAR, 2, 1 },
        { { 0, 0, 1, 0, 0 }, OUT_FAR, 2, 0 },
        { { 1, 0, 0, p->band[0], 0 }, OUT_BAND, 0, -p->band[0] },
        { { -1, 0, 0, p->band[0], 0 }, OUT_BAND, 0, p->band[0] },
        { { 0, 1, 0, p->band[1], 0 }, OUT_BAND, 1, -p->band[1] },
        { { 0, -1, 0, p->band[1], 0 }, OUT_BAND, 1, p->band[1] },
    };
    int count = 3;
    for (const struct plane *plane = planes; plane < planes + 7 && count >= 3; plane++) {
        struct vertex result[10];
        int length = 0;
        if ((codes & plane->code) == 0)
            continue;
        for (int i = 0; i < count; i++) {
            const struct vertex *a = &polygon[i], *b = &polygon[(i + 1) % count];
            bool keeps = distance_to(plane->n, a->value + CLIP) >= 0;
            if (keeps)
                result[length++] = *a;
            if (keeps != (distance_to(plane->n, b->value + CLIP) >= 0))
                result[length++] = cut_edge(plane, a, b);
        }
        memcpy(polygon, result, sizeof result);
        count = length;
    }
    return count;
}

/* ---- project (project.h): perspective divide, viewport, snapping to 1/256 of a pixel, ties to even ---- */
static void project(const struct picture *p, struct vertex *v)
{
    const float *at = v->value + CLIP, w = at[3];
    float half_width = (float)p->width * (UNITS / 2), half_height = (float)p->height * (UNITS / 2);
    v->x = lom_int_of(rintf(clamp(at[0] / w, -p->band[0], p->band[0]) * half_width + half_width));
    v->y = lom_int_of(rintf(clamp(at[1] / w, -p->band[1], p->band[1]) * -half_height + half_height)); /* downwards */
    v->depth = clamp(at[2] / w, 0, 1);
    v->one_over_w = 1 / w;
}

/* ---- setup (setup.wide.c): culling, vertices in order, edge functions in exact integers (Pineda 1988) ---- */
/* The distance to the clip plane is linear over w: sum(l d / w) has its sign at a pixel, and where it is 0 its gradient
 * decides, so that d and -d share the pixels. A common power of two keeps products from overflow and from vanishing. */
static void set_up_distance(struct triangle *t)
{
    double d[3], largest = 0, x = 0, y = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = (double)t->v[k].value[DISTANCE] * t->v[k].one_over_w;
        largest = fabs(d[k]) > largest ? fabs(d[k]) : largest;
    }
    for (int k = 0; k < 3; k++) {
        t->distance[k] = (float)scalbn(d[k], -ilogb(largest));
        x += (double)t->right[k] * t->distance[k];
        y += (double)t->down[k] * t->distance[k];
    }
    t->keeps_zero = x > 0 || (x == 0 && y >= 0);
}

/* False when it is not seen. Nothing but its side depends on the order in which the vertices came. */
static bool set_up(int cull, struct triangle *t)
{
    const struct vertex *v = t->v;
    int64_t area = (int64_t)(v[1].x - v[0].x) * (v[2].y - v[0].y) - (int64_t)(v[1].y - v[0].y) * (v[2].x - v[0].x);
    if (area == 0 || (cull > 0 && area > 0) || (cull < 0 && area < 0))
        return false; /* twice the area, positive clockwise on the screen: fronts are counter-clockwise */
    for (int i = 0; i < 3; i++) {
        struct vertex *a = &t->v[i % 2], *b = a + 1, swap = *a;
        if (b->y < a->y || (b->y == a->y && b->x < a->x)) {
            *a = *b;
            *b = swap;
            area = -area;
        }
    }
    for (int i = 0; i < 3; i++) { /* edge i is opposite to vertex i, and its function positive inside */
        const struct vertex *a = &v[(i + 1) % 3], *b = &v[(i + 2) % 3];
        t->right[i] = area > 0 ? a->y - b->y : b->y - a->y;
        t->down[i] = area > 0 ? b->x - a->x : a->x - b->x;
    }
    t->inverse_area = 1 / (float)(area > 0 ? area : -area);
    t->crosses = ((v[0].code | v[1].code | v[2].code) & OUT_DISTANCE) != 0;
    if (t->crosses)
        set_up_distance(t);
    return true;
}

/* ---- raster (raster.wide.c): a pixel centre on an edge belongs to the triangle whose top or left edge that is ---- */
static bool covers(const struct triangle *t, struct fragment *f)
{
    for (int i = 0; i < 3; i++) {
        const struct vertex *on = &t->v[(i + 1) % 3];
        int64_t x = (int64_t)f->x * UNITS + UNITS / 2 - on->x, y = (int64_t)f->y * UNITS + UNITS / 2 - on->y;
        int64_t e = t->right[i] * x + t->down[i] * y;
        bool top_or_left = t->right[i] > 0 || (t->right[i] == 0 && t->down[i] > 0);
        if (e < 0 || (e == 0 && !top_or_left))
            return false;
        f->l[i] = (float)e * t->inverse_area; /* the weight of vertex i on the screen */
    }
    return !t->crosses || dot(f->l, t->distance) > 0 || (t->keeps_zero && dot(f->l, t->distance) == 0);
}

/* ---- early depth (early.wide.c): z / w is linear on the screen ---- */
static float depth_at(const struct triangle *t, const float l[3])
{
    float z0 = t->v[0].depth, d1 = t->v[1].depth - z0, d2 = t->v[2].depth - z0, z1 = z0 + d1, z2 = z0 + d2;
    return clamp(z0 + l[1] * d1 + l[2] * d2, lesser(lesser(z0, z1), z2), greater(greater(z0, z1), z2));
}

/* ---- fragment (fragment.wide.c): f / w and 1 / w are linear on the screen, f is their quotient (Blinn 1992) ---- */
static void interpolate(const struct triangle *t, struct fragment *f)
{
    const struct vertex *a = &t->v[0], *b = &t->v[1], *c = &t->v[2];
    float p1 = f->l[1] * b->one_over_w, p2 = f->l[2] * c->one_over_w;
    float sum = f->l[0] * a->one_over_w + p1 + p2, b1 = p1 / sum, b2 = p2 / sum;
    f->w = 1 / sum;
    for (int i = 0; i < VARYINGS; i++) { /* held to the hull of the vertices' values */
        float f0 = a->value[i], f1 = b->value[i], f2 = c->value[i];
        float low = lesser(f0, lesser(f1, f2)), high = greater(f0, greater(f1, f2));
        f->varying[i] = clamp(f0 + b1 * (f1 - f0) + b2 * (f2 - f0), low, high);
    }
    for (int k = 0; k < 2; k++) { /* along x and y: the quotient rule on b = (l / w) / sum */
        const int64_t *step = k == 0 ? t->right : t->down;
        float l1 = (float)(step[1] * UNITS) * t->inverse_area, l2 = (float)(step[2] * UNITS) * t->inverse_area;
        float s1 = l1 * b->one_over_w, s2 = l2 * c->one_over_w, slope = s1 + s2 - (l1 + l2) * a->one_over_w;
        float d1 = (s1 - b1 * slope) / sum, d2 = (s2 - b2 * slope) / sum;
        f->ds[k] = d1 * (b->value[S] - a->value[S]) + d2 * (c->value[S] - a->value[S]);
        f->dt[k] = d1 * (b->value[T] - a->value[T]) + d2 * (c->value[T] - a->value[T]);
    }
}

/* ---- sample (src/image/sample_lanes.h, sample_2d.wide.c): repeated, linear within and between levels ---- */
/* log2 of the longer step in texels (OpenGL 4.6, 8.14.1), that is half of log2(m 2^e) of its square, e + P(m). */
static float level_of_detail(const struct level *whole, const struct fragment *f)
{
    float along[2];
    for (int k = 0; k < 2; k++) {
        float s = f->ds[k] * (float)whole->width, t = f->dt[k] * (float)whole->height;
        along[k] = clamp(s * s + t * t, 0x1p-126f, 0x1.fffffep127f);
    }
    int exponent;
    float m = 2 * frexpf(greater(along[0], along[1]), &exponent); /* in [1, 2) */
    float q = ((-0.04487395526f * m + 0.2851550624f) * m - 0.7052662739f) * m + 0.9074037454f;
    return ((float)(exponent - 1) + (m - 1) * (1 + (2 - m) * q)) * 0.5f;
}

static float mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

/* The two texels beside a coordinate, whose centres lie at one half, and the weight of the second. */
static float locate(float c, int size, int place[2])
{
    float fraction = c - floorf(c), x = (fraction < 1 ? fraction : 0) * (float)size + 0.5f;
    int k = lom_int_of(x);
    place[0] = k > 0 ? k - 1 : size - 1;
    place[1] = k < size ? k : 0;
    return lesser(x - (float)k, most_weight);
}

static void sample_level(const struct level *level, const struct fragment *f, float texel[4])
{
    int x[2], y[2];
    float right = locate(f->varying[S], level->width, x), down = locate(f->varying[T], level->height, y);
    const float(*upper)[4] = (const float(*)[4])level->texel + y[0] * level->width;
    const float(*lower)[4] = (const float(*)[4])level->texel + y[1] * level->width;
    for (int c = 0; c < 4; c++)
        texel[c] = mix(mix(upper[x[0]][c], upper[x[1]][c], right), mix(lower[x[0]][c], lower[x[1]][c], right), down);
}

static void sample(const struct texture *texture, struct fragment *f)
{
    float next[4], lod = clamp(f->lod, 0, (float)(texture->levels - 1));
    const struct level *level = &texture->level[lom_int_of(lod)];
    float fraction = lesser(lod - (float)lom_int_of(lod), most_weight);
    sample_level(level, f, f->texel);
    sample_level(level + (fraction > 0), f, next);
    for (int c = 0; c < 4; c++)
        f->texel[c] = mix(f->texel[c], next[c], fraction);
    f->texel[3] = f->texel[3] / 255;
}

/* ---- the fragment shader: ambient + diffuse N.L + specular (R.E)^n (Phong 1975), in linear light ---- */
static void shade(const struct uniforms *u, struct fragment *f)
{
    float n[3], e[3], r[3], power = 1;
    for (int i = 0; i < 3; i++) {
        n[i] = f->varying[NORMAL + i];
        e[i] = u->eye[i] - f->varying[WORLD + i];
    }
    normalize(n);
    normalize(e);
    float cosine = dot(n, to_light), twice = 2 * cosine;
    float diffuse = greater(dot(n, e) < 0 ? -cosine : cosine, 0); /* both sides are lit */
    for (int i = 0; i < 3; i++)
        r[i] = n[i] * twice - to_light[i]; /* L reflected in N */
    float base = greater(dot(r, e), 0);
    for (int rest = u->shininess; rest > 0; rest >>= 1, base = base * base)
        power = (rest & 1) != 0 ? power * base : power;
    for (int i = 0; i < 3; i++)
        f->color[i] = f->texel[i] * (ambient + lamp * diffuse) + (diffuse > 0 ? power * shine : 0);
    f->color[3] = f->texel[3] * u->opacity;
}

/* ---- output (output.wide.c): source over target (Porter and Duff 1984) in linear light, encoded once ---- */
static void write_pixel(const float color[4], bool blends, uint8_t pixel[4])
{
    float alpha = clamp(color[3], 0, 1), rest = 1 - alpha;
    for (int c = 0; c < 3; c++) {
        float source = clamp(color[c], 0, 1);
        pixel[c] = encode(blends ? source * alpha + decode(pixel[c]) * rest : source);
    }
    float sum = blends ? alpha + (float)pixel[3] / 255 * rest : alpha;
    pixel[3] = (uint8_t)lom_count_of(clamp(sum, 0, 1) * 255.0 + 0.5, 255);
}

/* ---- a draw: every triangle through all stages, in order ---- */
static void draw_pixel(struct picture *p, const struct draw *draw, const struct triangle *t, int x, int y)
{
    struct fragment f = { .x = x, .y = y };
    size_t place = (size_t)y * (size_t)p->width + (size_t)x;
    if (!covers(t, &f))
        return;
    f.depth = depth_at(t, f.l);
    if (!(f.depth > p->depth[place])) /* nearer is greater */
        return;
    p->depth[place] = f.depth;
    interpolate(t, &f);
    f.lod = level_of_detail(&draw->texture->level[0], &f);
    sample(draw->texture, &f);
    shade(&draw->uniforms, &f);
    write_pixel(f.color, draw->blends, p->color[place]);
    if (p->seen != NULL)
        p->seen[place] = f;
}

static void draw_triangle(struct picture *p, const struct draw *draw, struct triangle *t)
{
    if (!set_up(draw->cull, t))
        return;
    int32_t a = t->v[0].x, b = t->v[1].x, c = t->v[2].x, top = t->v[0].y, bottom = t->v[2].y;
    int32_t left = a < b ? a < c ? a : c : b < c ? b : c, right = a > b ? a > c ? a : c : b > c ? b : c;
    for (int y = top > 0 ? top / UNITS : 0; y < p->height && y * UNITS < bottom; y++)
        for (int x = left > 0 ? left / UNITS : 0; x < p->width && x * UNITS < right; x++)
            draw_pixel(p, draw, t, x, y);
}

static void draw_mesh(struct picture *p, const struct draw *draw)
{
    for (size_t i = 0; i + 2 < draw->mesh->index_count; i += 3) {
        struct vertex v[10];
        unsigned all = ~0u, any = 0;
        for (int k = 0; k < 3; k++) {
            shade_vertex(p, &draw->uniforms, &draw->mesh->vertices[draw->mesh->indices[i + (size_t)k]], &v[k]);
            all &= v[k].code;
            any |= v[k].code;
        }
        if ((all & ~OUT_BAND) != 0 || (any & NO_NUMBER) != 0) /* outside of one plane, or nowhere */
            continue;
        int count = clip(p, any, v);
        for (int k = 0; k < count; k++)
            project(p, &v[k]);
        for (int k = 0; k + 2 < count; k++)
            draw_triangle(p, draw, &(struct triangle){ .v = { v[0], v[k + 1], v[k + 2] } });
    }
}

/* ---- the picture of this lesson: half a torus on a floor; the other half, beyond the clip plane, is blended ---- */
int main(int argc, char **argv)
{
    enum { WIDTH = 320, HEIGHT = 200, SIZE = 128, TILE = 64 };
    static const uint8_t colors[2][4] = { { 214, 178, 132, 255 }, { 74, 110, 128, 255 } };
    static uint8_t rgba[SIZE * SIZE][4], color[WIDTH * HEIGHT][4];
    static float room[2 * SIZE * SIZE][4], depth[WIDTH * HEIGHT];
    const lom_vec3 eye = { 2.2, 1.9, 2.6 }, place = { 0, 0.8, 0 }, up = { 0, 1, 0 }, turn = { 1.2, 0.3, 0 };
    lom_mat4 view = lom_look_at(eye, place, up), lens = lom_perspective(0.75, (double)WIDTH / HEIGHT, 0.1);
    lom_mat4 camera = lom_multiply(&lens, &view), model = lom_model_matrix(place, turn, (lom_vec3){ 1, 1, 1 });
    lom_mesh *mesh[2] = { lom_make_quad(60, 60, NULL), lom_make_torus(0.8, 0.36, 96, 48, NULL) };
    struct picture picture = { WIDTH, HEIGHT, { 2.0f * BAND / WIDTH, 2.0f * BAND / HEIGHT }, color, depth, NULL };
    const lom_image image = { WIDTH, HEIGHT, 1, LOM_FORMAT_RGBA8_SRGB, color[0], LOM_SLICES_VOLUME, NULL };
    for (int i = 0; i < SIZE * SIZE; i++)
        memcpy(rgba[i], colors[(i % SIZE / TILE + i / SIZE / TILE) % 2], 4);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        write_pixel((const float[4]){ 0.25f, 0.45f, 0.7f, 1 }, false, color[i]);
    struct texture texture = make_texture(SIZE, SIZE, rgba[0], room);
    bool done = argc == 2 && mesh[0] != NULL && mesh[1] != NULL;
    for (int i = 0; i < 4 && done; i++) { /* the floor, half a torus, of the other half the back, the front */
        lom_mat4 to_world = i == 0 ? lom_identity() : model, to_clip = lom_multiply(&camera, &to_world), normals;
        lom_normal_matrix(&to_world, &normals);
        struct draw draw = { mesh[i > 0], &texture, { .shininess = 40 }, i == 2 ? -1 : i == 3, i > 1 };
        struct uniforms *u = &draw.uniforms;
        u->to_clip = lom_round_matrix(&to_clip);
        u->to_world = lom_round_matrix(&to_world);
        u->normal_to_world = lom_round_matrix(&normals);
        u->clip_plane[0] = i == 0 ? 0 : i == 1 ? -0.6f : 0.6f;
        u->clip_plane[2] = i == 0 ? 0 : i == 1 ? -0.8f : 0.8f;
        u->opacity = i < 2 ? 1 : 0.3f;
        u->tiling[0] = u->tiling[1] = i == 0 ? 20 : 3;
        memcpy(u->eye, (const float[3]){ (float)eye.x, (float)eye.y, (float)eye.z }, sizeof u->eye);
        draw_mesh(&picture, &draw);
    }
    done = done && lom_write_image(argv[1], NULL, &image, NULL);
    lom_free_mesh(mesh[0]);
    lom_free_mesh(mesh[1]);
    if (!done)
        fprintf(stderr, "pipeline: nothing was written; usage: pipeline OUT.png\n");
    return done ? 0 : 2;
}
