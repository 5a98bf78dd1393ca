/* What asks a student's stage, in a process of its own. In: nothing, and it tells by STAGES bytes, 0 or 1, which stages
 * the student wrote; the number of a stage: the answers to its cases, in order, each as its count of numbers and these;
 * the number and "draw": the bytes of the gallery's scene. Out: on descriptor 3, each case before the next is asked, so
 * that a reader knows in which one a crash was. */
#define LOM_GRADER
#include "../mistakes/gallery.h"
#include "cases.h"
#include "student.h"

#include <stdlib.h>
#include <unistd.h>

#pragma weak student_order
#pragma weak student_model_matrix
#pragma weak student_normal_matrix
#pragma weak student_round_matrix
#pragma weak student_make_texture
#pragma weak student_shade_vertex
#pragma weak student_clip
#pragma weak student_project
#pragma weak student_set_up
#pragma weak student_covers
#pragma weak student_depth_at
#pragma weak student_is_nearer
#pragma weak student_interpolate
#pragma weak student_level_of_detail
#pragma weak student_sample
#pragma weak student_shade
#pragma weak student_write_pixel
#pragma weak student_wave
#pragma weak student_march

static void tell(const void *data, size_t size)
{
    const char *bytes = data;
    while (size > 0) {
        ssize_t taken = write(3, bytes, size);
        if (taken <= 0)
            _exit(2);
        bytes += taken;
        size -= (size_t)taken;
    }
}

int main(int argc, char **argv)
{
    const struct stages student = {
        student_order,        student_model_matrix,    student_normal_matrix,
        student_round_matrix, student_make_texture,    student_shade_vertex,
        student_clip,         student_project,         student_set_up,
        student_covers,       student_depth_at,        student_is_nearer,
        student_interpolate,  student_level_of_detail, student_sample,
        student_shade,        student_write_pixel,     student_wave,
        student_march,
    };
    static struct problem problem;
    void (*function[STAGES])(void), (*only[STAGES])(void) = { NULL };
    uint8_t written[STAGES];
    int stage = argc > 1 ? atoi(argv[1]) : -1;
    memcpy(function, &student, sizeof function);
    for (int i = 0; i < STAGES; i++) {
        written[i] = function[i] != NULL;
        only[i] = i == stage ? function[i] : NULL;
    }
    if (stage < 0 || stage >= STAGES)
        tell(written, sizeof written);
    else if (argc > 2) {
        struct stages by;
        memcpy(&by, only, sizeof by);
        lom_image *image = draw_gallery_image(&by, NULL);
        if (image != NULL)
            tell(image->pixels, (size_t)GALLERY_WIDTH * GALLERY_HEIGHT * 3);
    } else
        for (int i = 0; i < CASES; i++) {
            struct answer answer;
            ask_case(stage, i, &problem);
            answer_case(&student, stage, &problem, &answer);
            tell(&answer, offsetof(struct answer, number) + (size_t)answer.count * sizeof answer.number[0]);
        }
    _exit(0); /* nothing of the student's runs after it */
}
