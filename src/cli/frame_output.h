/* Where the frames of a run go: a picture each, or one video. */
#ifndef LOM_CLI_FRAME_OUTPUT_H
#define LOM_CLI_FRAME_OUTPUT_H

#include <lom/scene.h>

struct lom_frame_output {
    const char *pattern; /* OUT; NULL: the frames are not kept */
    const char *format;  /* of --format, NULL: by the ending of OUT */
    double fps;
    lom_writer *video; /* of y4m, until the run ends */
};

/* The path of a frame: pattern, whose file (never a folder) has %d or %04d for the number, once or not at all, and %%
 * for one %. NULL on failure; freed with lom_release. */
char *lom_name_frame(const char *pattern, int frame, lom_error *error);

/* Whether frames of the scene's format, as many as that, can be written there: asked before anything is drawn. */
bool lom_check_frame_output(const struct lom_frame_output *output, lom_output_format format, int frames,
                            lom_error *error);
/* Writes the picture of a frame, or appends it to the video. */
bool lom_write_frame(struct lom_frame_output *output, const lom_image *image, int frame, lom_error *error);
/* The video is complete (keep), or was never begun. */
bool lom_end_frame_output(struct lom_frame_output *output, bool keep, lom_error *error);

#endif
