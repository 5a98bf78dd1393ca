/* The stores of a lesson that computes its pixels itself. In: the address of each store, before it is done (clang
 * -fsanitize-coverage=trace-stores), and memset and memcpy (lesson_told.h). Out: the picture after so many of them; or
 * what happened to one pixel. */
#include "web/lesson_page.h"

#include "web/lesson_told.h"

#undef memcpy
#undef memset

void __sanitizer_cov_store1(const void *address);
void __sanitizer_cov_store2(const void *address);
void __sanitizer_cov_store4(const void *address);
void __sanitizer_cov_store8(const void *address);
void __sanitizer_cov_store16(const void *address);

/* Behind the last of some stores into the pixel: what it holds. */
static void end_visit(lom_lesson_run *run)
{
    const struct lom_lesson_picture *p = &run->picture;
    const lom_format_info *format = lom_describe_format(p->format);
    size_t at = (size_t)run->y * (size_t)p->width + (size_t)run->x;
    const uint8_t *pixel = (const uint8_t *)p->address + at * lom_format_size(p->format);
    struct lom_lesson_visit *visit = &run->visit[run->visits++ % LOM_LESSON_VISITS];
    visit->last = run->stores;
    for (int c = 0; c < format->channels; c++)
        if (format->is_float)
            memcpy(&visit->value[c], pixel + 4 * c, sizeof(float));
        else
            visit->value[c] = pixel[c];
    run->within = false;
}

void lom_end_stores(lom_lesson_run *run)
{
    if (run->within)
        end_visit(run);
}

void lom_tell_stores(const lom_lesson_run *run, FILE *out)
{
    const lom_format_info *format = lom_describe_format(run->picture.format);
    int first = run->visits > LOM_LESSON_VISITS ? run->visits - LOM_LESSON_VISITS : 0;
    fprintf(out, "The program stores into it %d %s; %llu stores into the picture in all.\n", run->visits,
            run->visits == 1 ? "time" : "times", (unsigned long long)run->stores);
    for (int i = first; i < run->visits; i++) {
        const struct lom_lesson_visit *visit = &run->visit[i % LOM_LESSON_VISITS];
        fprintf(out, "  %d. stores %llu to %llu: %s", i + 1, (unsigned long long)visit->first,
                (unsigned long long)visit->last, format->is_float ? "light" : "codes");
        for (int c = 0; c < format->channels; c++) {
            char text[32];
            lom_print_float(text, visit->value[c]);
            fprintf(out, " %s", text);
        }
        fputs("\n", out);
    }
}

/* Of the picture as it is: all stores before this one are done. */
static void end_at_moment(lom_lesson_run *run)
{
    const struct lom_lesson_picture *p = &run->picture;
    lom_end_lesson_with(run, &(lom_image){ p->width, p->height, 1, p->format, (uint8_t *)p->address });
}

static void note_store(const void *address, size_t size)
{
    lom_lesson_run *run = lom_current_lesson();
    if (run == NULL || run->picture.width == 0 || run->picture.address == 0)
        return;
    const struct lom_lesson_picture *p = &run->picture;
    size_t pixel = lom_format_size(p->format), bytes = pixel * (size_t)p->width * (size_t)p->height;
    size_t offset = (uintptr_t)address - p->address, at = pixel * ((size_t)run->y * (size_t)p->width + (size_t)run->x);
    if (offset >= bytes) /* below the picture, too: it wraps */
        return;
    if (run->stores == run->moment)
        end_at_moment(run);
    bool into = run->x >= 0 && offset < at + pixel && offset + size > at;
    if (run->within && !into)
        end_visit(run);
    else if (into && !run->within)
        run->visit[run->visits % LOM_LESSON_VISITS].first = run->stores + 1;
    run->within = into;
    run->stores++;
}

void *lom_told_memset(void *to, int value, size_t size)
{
    note_store(to, size);
    return memset(to, value, size);
}

void *lom_told_memcpy(void *to, const void *from, size_t size)
{
    note_store(to, size);
    return memcpy(to, from, size);
}

void __sanitizer_cov_store1(const void *address)
{
    note_store(address, 1);
}

void __sanitizer_cov_store2(const void *address)
{
    note_store(address, 2);
}

void __sanitizer_cov_store4(const void *address)
{
    note_store(address, 4);
}

void __sanitizer_cov_store8(const void *address)
{
    note_store(address, 8);
}

void __sanitizer_cov_store16(const void *address)
{
    note_store(address, 16);
}
