/* Proves what lighting makes of extremes: shininess of 0 and of a million, normals of no length, light from the side
 * and from behind, colours beyond what is shown; and that a fragment's light does not depend on the lanes beside it. */
#include "check.h"
#include "shading/phong.h"

static struct lom_view_uniform view_of(float x, float y, float z, float color)
{
    struct lom_view_uniform view = { .light = { .to_light = { x, y, z }, .color = { color, color, color } } };
    return view;
}

static struct lom_material_uniform material_of(float shininess)
{
    return (struct lom_material_uniform){
        .ambient = { 1, 1, 1 }, .diffuse = { 1, 1, 1 }, .specular = { 1, 1, 1 }, .shininess = shininess
    };
}

/* A place 5 m below the eye. */
static lom_float3 below(void)
{
    return lom_splat3(0, -5, 0);
}

static lom_float3 upwards(void)
{
    return (lom_float3){ { 0 }, lom_splat(1.0f), { 0 } };
}

/* The highlight of an upright surface for eyes at angles of i * 10 degrees from where the light is mirrored, a lane
 * each or all alone. */
static void l4_shininess_of_nothing_and_of_a_million(void)
{
    static const float shininess[] = { 0, 1e-30f, 1, 10, 1e6f };
    struct lom_view_uniform view = view_of(0, 1, 0, 1);
    CHECK(lom_pow((lom_float){ 0 }, (lom_float){ 0 })[0] == 1, "0 to the power of 0");
    for (int s = 0; s < 5; s++) {
        float cosine[LOM_LANES], together[LOM_LANES];
        for (int i = 0; i < LOM_LANES; i++)
            cosine[i] = (float)lom_double_cos(3.14159265358979 * i * 10 / 180);
        lom_float c = lom_load(cosine);
        lom_float3 to_eye = { lom_sqrt(lom_max(1.0f - c * c, (lom_float){ 0 })), c, { 0 } };
        lom_store(together, lom_phong_specular(&view.light, upwards(), to_eye, shininess[s]));
        for (int i = 0; i < LOM_LANES; i++) {
            lom_float3 alone = { lom_splat(to_eye.x[i]), lom_splat(c[i]), { 0 } };
            float value = lom_phong_specular(&view.light, upwards(), alone, shininess[s])[0];
            double want = c[i] > 0 ? lom_double_pow((double)c[i], (double)shininess[s]) : 0;
            CHECK(value == together[i], "shininess %g, lane %d: %g alone, %g together", shininess[s], i, value,
                  together[i]);
            CHECK((double)value <= want * 1.000001 && (double)value >= want * 0.999999 - 1e-37,
                  "shininess %g at %d degrees: %g for %g", shininess[s], i * 10, value, want);
        }
    }
}

static void l5_normals_of_no_length_take_no_light(void)
{
    struct lom_view_uniform view = view_of(0.6f, 0.8f, 0, 1);
    struct lom_material_uniform m = material_of(10);
    static const float tiny[] = { 0, -0.0f, 1e-30f };
    for (int i = 0; i < 3; i++) {
        lom_float3 normal = lom_normalize3(lom_splat3(tiny[i], tiny[i], tiny[i]));
        struct lom_lit lit = lom_phong_light(&view, &m, below(), normal, lom_splat(1.0f));
        CHECK(lit.textured.x[0] == 0 && lit.highlight.x[0] == 0, "%g: %g %g", tiny[i], lit.textured.x[0],
              lit.highlight.x[0]);
    }
    /* the eye in the surface itself: no direction to it, no highlight */
    struct lom_lit lit = lom_phong_light(&view, &m, lom_splat3(0, 0, 0), upwards(), lom_splat(1.0f));
    CHECK(lit.highlight.x[0] == 0 && lit.textured.x[0] == 0.8f, "%g %g", lit.highlight.x[0], lit.textured.x[0]);
}

static void l7_light_from_the_side_and_from_behind(void)
{
    static const float heights[] = { 0, -0.0f, -1e-30f, -0.5f, -1 };
    struct lom_material_uniform m = material_of(0);
    for (int i = 0; i < 5; i++) {
        struct lom_view_uniform view = view_of(1, heights[i], 0, 1);
        /* the eye is where a mirror would send it, behind the surface where the light is */
        lom_float3 place = lom_splat3(5, -5 * heights[i], 0);
        lom_float lambert = lom_lambert(&view.light, upwards());
        struct lom_lit lit = lom_phong_light(&view, &m, place, upwards(), lom_splat(1.0f));
        CHECK(lom_as_int(lambert)[0] == 0, "%g: %g, and its sign", heights[i], lambert[0]);
        CHECK(lit.textured.x[0] == 0 && lit.highlight.x[0] == 0, "%g: %g", heights[i], lit.highlight.x[0]);
    }
}

/* Light is not clamped before the picture is: 1e30 stays, and is white in 8 bits; nothing times it stays nothing. */
static void l8_colours_beyond_white(void)
{
    struct lom_view_uniform view = view_of(0, 1, 0, 1e30f), behind = view_of(0, -1, 0, 1e30f);
    struct lom_material_uniform m = material_of(10);
    struct lom_lit lit = lom_phong_light(&view, &m, below(), upwards(), lom_splat(1.0f));
    CHECK(lit.textured.x[0] == 1e30f && lit.highlight.x[0] == 1e30f, "%g %g", lit.textured.x[0], lit.highlight.x[0]);
    lit = lom_phong_light(&behind, &m, below(), upwards(), lom_splat(1.0f));
    CHECK(lit.textured.x[0] == 0 && lit.highlight.x[0] == 0, "%g %g", lit.textured.x[0], lit.highlight.x[0]);
}

int main(int argc, char **argv)
{
    RUN(l4_shininess_of_nothing_and_of_a_million);
    RUN(l5_normals_of_no_length_take_no_light);
    RUN(l7_light_from_the_side_and_from_behind);
    RUN(l8_colours_beyond_white);
    return check_result();
}
