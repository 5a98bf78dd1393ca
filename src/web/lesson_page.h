/* A lesson that is looked at while it runs: what its page asks for (lesson_page.c), and what is noted on the way. The
 * lesson's source is as it stands; the linker leads its calls of the library here (-Wl,--wrap) and the compiler calls
 * lesson_stores.c before each store. What is numbered here has the same number in every run. */
#ifndef LOM_WEB_LESSON_PAGE_H
#define LOM_WEB_LESSON_PAGE_H

#include <lom/inspect.h>

#include <stdio.h>

enum { LOM_LESSON_TEXTURES = 32, LOM_LESSON_DRAWS = 256, LOM_LESSON_IMAGES = 64, LOM_LESSON_VISITS = 64 };

/* What a lesson stores its picture into by itself; width 0: it draws by a device. */
struct lom_lesson_picture {
    int created; /* it is the image that is created as the n-th, from 1 on; 0: static memory at `address` */
    uintptr_t address;
    int width, height;
    lom_format format;
};

/* Stores into one pixel, none into another pixel between them. */
struct lom_lesson_visit {
    uint64_t first, last;
    float value[4]; /* what the pixel holds after them */
};

struct lom_lesson_draw {
    int pass, number; /* the number in the pass, from 0 on, as in records */
    size_t triangles;
    const char *shader;
};

typedef struct lom_lesson_run {
    /* what is asked */
    const char *name, *out;
    uint64_t moment; /* triangles, or stores into the picture, after which it is written and the program ends */
    struct lom_lesson_picture picture;
    /* what is noted */
    lom_device *device; /* it and the textures: of the first run, and of all that follow */
    lom_texture *texture[LOM_LESSON_TEXTURES];
    int textures, passes, draws, pass_draws;
    const lom_texture *target; /* of the pass: its first colour */
    struct lom_lesson_draw draw[LOM_LESSON_DRAWS];
    uint64_t triangles, stores;
    lom_texture *read;                                /* the texture that was read last */
    const lom_image *read_image, *converted;          /* that; what was converted last */
    struct lom_lesson_picture source;                 /* of that conversion */
    uintptr_t image[LOM_LESSON_IMAGES];               /* where the pixels of the last images that were created are */
    int images;                                       /* how many were created */
    int x, y;                                         /* the pixel whose stores are noted; x < 0: none */
    bool within;                                      /* the last store was into it */
    struct lom_lesson_visit visit[LOM_LESSON_VISITS]; /* the last ones */
    int visits;
} lom_lesson_run;

/* The one run of this program; NULL before and behind it. */
lom_lesson_run *lom_current_lesson(void);
/* Runs the lesson, which writes its picture to `path`; its exit status. */
int lom_run_lesson(lom_lesson_run *run, const char *path);
/* Writes a picture that eyes see, and ends the program. */
void lom_end_lesson_with(const lom_lesson_run *run, const lom_image *picture);
bool lom_write_lesson_picture(const char *path, const lom_image *picture);

/* Behind the last store: what the pixel holds then is noted. */
void lom_end_stores(lom_lesson_run *run);
/* What was stored into the pixel. */
void lom_tell_stores(const lom_lesson_run *run, FILE *out);
/* What a pass is called: "first" of number 0. */
const char *lom_lesson_pass(int number);

/* The library's own, past the linker's wraps. */
lom_device *__real_lom_open_device(const lom_device_desc *desc);
void __real_lom_close_device(lom_device *device);
lom_texture *__real_lom_make_texture(lom_device *device, const lom_texture_desc *desc);
lom_texture *__real_lom_texture_of_image(const lom_image *image, bool srgb, lom_mips mips, lom_error *error);
void __real_lom_free_texture(lom_texture *texture);
void __real_lom_begin_pass(lom_device *device, const lom_pass_desc *desc);
void __real_lom_draw(lom_device *device, const lom_draw_desc *desc);
bool __real_lom_end_pass(lom_device *device);
lom_image *__real_lom_read_texture(const lom_texture *texture, int level, int layer, lom_error *error);
lom_image *__real_lom_create_image(int width, int height, int depth, lom_format format, lom_error *error);
lom_image *__real_lom_convert_image(const lom_image *image, lom_format format, lom_error *error);
bool __real_lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error);

#endif
