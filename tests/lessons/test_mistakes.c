/* Proves of the gallery of mistakes (docs/lessons/mistakes) that its stages, when all are right, draw the bytes of the
 * plain pipeline; that a mistake replaces exactly the stage that it names; that each is seen in the gallery's scene, and
 * no two look alike. */
#include "check.h"

#include "../../docs/lessons/mistakes/gallery.h"
#include "../../docs/lessons/mistakes/mistakes.h"

enum { WIDTH = 150, HEIGHT = 90, PIXELS = WIDTH * HEIGHT };

struct canvas {
    uint8_t color[PIXELS][4];
    float depth[PIXELS];
};

/* A torus near the eye, cut by the near plane, by a clip plane or blended, by the number. */
static void draw_torus(int number, const struct stages *by, struct canvas *canvas)
{
    static uint8_t rgba[SKIN * SKIN][4];
    static float room[2 * SKIN * SKIN][4];
    memset(canvas, 0, sizeof *canvas);
    make_skin(rgba);
    const struct texture texture = make_texture(SKIN, SKIN, rgba[0], room);
    struct picture picture = { WIDTH,         HEIGHT,        { 2.0f * BAND / WIDTH, 2.0f * BAND / HEIGHT },
                               canvas->color, canvas->depth, NULL };
    lom_mesh *torus = lom_make_torus(0.8, 0.4, 24, 16, NULL);
    double turn = number * 0.7;
    lom_mat4 model =
        lom_model_matrix((lom_vec3){ 0.1 * number, 0, 0 }, (lom_vec3){ turn, 1, 0.3 }, (lom_vec3){ 1, 0.6, 1.2 });
    lom_mat4 view =
        lom_look_at((lom_vec3){ 0, 0.3, 0.9 + 0.15 * number }, (lom_vec3){ 0, 0, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 lens = lom_perspective(0.9, (double)WIDTH / HEIGHT, 0.1), camera = lom_multiply(&lens, &view), normals;
    lom_mat4 to_clip = lom_multiply(&camera, &model);
    lom_normal_matrix(&model, &normals);
    struct draw draw = {
        torus, &texture, { .shininess = 20, .opacity = number % 2 == 0 ? 1 : 0.5f }, number % 3 - 1, number % 2
    };
    draw.uniforms.to_clip = lom_round_matrix(&to_clip);
    draw.uniforms.to_world = lom_round_matrix(&model);
    draw.uniforms.normal_to_world = lom_round_matrix(&normals);
    draw.uniforms.tiling[0] = draw.uniforms.tiling[1] = 3;
    draw.uniforms.clip_plane[0] = number % 4 > 1 ? 0.6f : 0;
    draw.uniforms.clip_plane[1] = number % 4 > 1 ? 0.8f : 0;
    if (by == NULL)
        draw_mesh(&picture, &draw);
    else
        draw_mesh_by(by, &picture, &draw);
    lom_free_mesh(torus);
}

static void right_stages_draw_what_the_pipeline_draws(void)
{
    static struct canvas one, other;
    const struct stages completed = complete_stages(&(struct stages){ .covers = covers });
    for (int i = 0; i < 12; i++) {
        draw_torus(i, NULL, &one);
        draw_torus(i, i % 2 == 0 ? &right_stages : &completed, &other);
        CHECK(memcmp(&one, &other, sizeof one) == 0, "torus %d", i);
    }
}

static void a_mistake_replaces_the_stage_that_it_names(void)
{
    CHECK(MISTAKES >= 25, "%d", MISTAKES);
    for (const struct mistake *m = mistakes; m < mistakes + MISTAKES; m++) {
        void (*function[STAGES])(void), (*right[STAGES])(void);
        memcpy(function, &m->wrong, sizeof function);
        memcpy(right, &right_stages, sizeof right);
        for (int i = 0; i < STAGES; i++) {
            CHECK((function[i] != NULL) == (strcmp(stage_names[i], m->stage) == 0), "%s: %s", m->name, stage_names[i]);
            CHECK(function[i] != right[i], "%s has the right %s", m->name, stage_names[i]);
        }
        CHECK(m->rule[strlen(m->rule) - 1] == '.' && m->looks[strlen(m->looks) - 1] == '.', "%s", m->name);
        CHECK(strlen(m->source) > 3, "%s", m->name);
        for (const struct mistake *other = mistakes; other < m; other++)
            CHECK(strcmp(m->name, other->name) != 0, "%s twice", m->name);
    }
}

static void every_mistake_shows_and_no_two_look_alike(void)
{
    uint64_t hash[MISTAKES + 1];
    for (int i = 0; i <= MISTAKES; i++) {
        lom_image *image = draw_gallery_image(i < MISTAKES ? &mistakes[i].wrong : &right_stages, NULL);
        hash[i] = lom_hash_image(image);
        lom_free_image(image);
        for (int k = 0; k < i; k++)
            CHECK(hash[k] != hash[i], "%s looks like %s", mistakes[k].name,
                  i < MISTAKES ? mistakes[i].name : "the right picture");
    }
}

int main(int argc, char **argv)
{
    RUN(right_stages_draw_what_the_pipeline_draws);
    RUN(a_mistake_replaces_the_stage_that_it_names);
    RUN(every_mistake_shows_and_no_two_look_alike);
    return check_result();
}
