/* Proves that the steps of a marched ray that a record holds are those that were marched: in a uniform slab each step's
 * share is what the closed form says, shares and transmittance add up to 1 at every step, the last transmittance is the
 * result's, and a ray that has ended has no more steps. */
#include "../march/media.h"
#include "check.h"

#include "lanes/notes.h"

static const struct lom_note *next_of(const struct lom_notes *notes, size_t *i, lom_note_kind kind)
{
    while (*i < notes->count && notes->items[*i].kind != kind)
        ++*i;
    return *i < notes->count ? &notes->items[(*i)++] : NULL;
}

static void steps_add_up_to_the_ray(void)
{
    lom_medium *medium = medium_along_x(8, one);
    for (int steps = 1; steps <= 50; steps += 7) {
        struct lom_notes notes = { .count = 0 };
        lom_medium_desc desc = plain(medium, 3, 1.0 / steps);
        lom_medium_rays rays = rays_along_x(0, 1);
        rays.leave[2] = 0.5f; /* lane 2 leaves half way */
        lom_open_notes(&notes);
        lom_medium_result seen = march(&rays, &desc);
        lom_open_notes(NULL);
        march(&rays, &desc); /* nobody watches: no note */
        for (int lane = 0; lane < 4; lane++) {
            size_t i = 0;
            const struct lom_note *note = next_of(&notes, &i, LOM_NOTE_RAY);
            float sum = 0, left = 1, length = 0;
            int count = 0;
            CHECK(note != NULL && notes.rows[note->first][lane] == 0 &&
                  notes.rows[note->first + 1][lane] == rays.leave[lane]);
            while ((note = next_of(&notes, &i, LOM_NOTE_STEP)) != NULL) {
                const struct lom_note *light = next_of(&notes, &i, LOM_NOTE_LIGHT);
                const float(*row)[4] = (const float(*)[4])notes.rows + note->first;
                int32_t alive;
                memcpy(&alive, &row[3][lane], sizeof alive);
                if (alive == 0)
                    continue;
                float share = notes.rows[light->first][lane], behind = notes.rows[light->first + 1][lane];
                double exact = -lom_double_expm1(-3.0 * (double)row[1][lane]) * (double)left;
                CHECK(magnitude((double)share - exact) < 1e-6, "%g for %g", (double)share, exact);
                CHECK(row[2][lane] == 1 && behind == left - share);
                sum += share;
                left = behind;
                length += row[1][lane];
                count++;
            }
            CHECK(left == seen.transmittance[lane] && magnitude((double)sum + (double)left - 1) < 1e-5);
            CHECK(magnitude((double)length - (double)rays.leave[lane]) < 1e-5 && count >= 1 && count <= steps);
        }
        CHECK(!notes.failed);
        lom_free_notes(&notes);
    }
    lom_free_medium(medium);
}

int main(int argc, char **argv)
{
    RUN(steps_add_up_to_the_ray);
    return check_result();
}
