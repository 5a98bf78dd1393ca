/* A sweep in numbers. In: trials. Out: CSV, and a table for people. Invariant: both have every trial, also those that
 * could not be drawn. */
#include "measure/sweep.h"

#include <string.h>

static const char *note_of(const lom_trial *trial)
{
    return trial->failed[0] != 0  ? trial->failed
           : trial->differs       ? "changes the picture, and must not"
           : trial->is_equal      ? "the same bytes"
           : trial->beats_default ? "beats the default"
           : trial->is_default    ? "default"
                                  : "";
}

/* A field of CSV (RFC 4180). */
static void print_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text != 0; text++) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

/* Equal pictures have no end of decibels. */
static const char *print_psnr(char text[32], double psnr)
{
    if (psnr > 1e6)
        snprintf(text, 32, "inf");
    else
        snprintf(text, 32, "%.2f", psnr);
    return text;
}

void lom_print_sweep_csv(FILE *out, const lom_sweep *sweep)
{
    char text[LOM_LONGEST_TRIAL], psnr[32];
    fputs("settings,reference,ms,ratio,ratio_low,ratio_high,psnr,ssim,flip,max_delta,pixels,front,note\n", out);
    for (size_t i = 0; i < sweep->count; i++) {
        const lom_trial *t = &sweep->trial[i];
        print_quoted(out, lom_print_trial(text, t));
        fprintf(out, ",%s,", t->reference);
        if (t->failed[0] == 0)
            fprintf(out, "%.3f,%.4f,%.4f,%.4f,%s,%.5f,%.5f,%.0f,%zu,%d,", lom_trial_ms(sweep, t), t->time.ratio,
                    t->time.low, t->time.high, print_psnr(psnr, t->error.psnr), t->error.ssim, t->error.flip,
                    t->error.max_delta, t->error.pixels, t->on_front);
        else
            fputs(",,,,,,,,,,", out);
        print_quoted(out, note_of(t));
        fputc('\n', out);
    }
}

static void print_row(FILE *out, const lom_sweep *sweep, const lom_trial *t, int width)
{
    char text[LOM_LONGEST_TRIAL], psnr[32];
    fprintf(out, "%c %-*s ", t->on_front ? '*' : ' ', width, lom_print_trial(text, t));
    if (t->failed[0] == 0)
        fprintf(out, "%9.2f  %6.3f (%5.3f..%5.3f)  %6s  %6.4f  %7.5f  %3.0f  ", lom_trial_ms(sweep, t), t->time.ratio,
                t->time.low, t->time.high, print_psnr(psnr, t->error.psnr), t->error.ssim, t->error.flip,
                t->error.max_delta);
    fprintf(out, "%s\n", note_of(t));
}

void lom_print_sweep_table(FILE *out, const lom_sweep *sweep, const lom_sweep_head *head)
{
    char text[LOM_LONGEST_TRIAL];
    const char *reference = "";
    int width = 10;
    for (size_t i = 0; i < sweep->count; i++) {
        const int length = (int)strlen(lom_print_trial(text, &sweep->trial[i]));
        width = length > width ? length : width;
    }
    fprintf(out, "%s, frame %d, %dx%d, threads: %d, lanes: %d, %s\n%s\n", head->scene, head->frame, head->width,
            head->height, head->threads, head->lanes, head->clock, head->command);
    for (size_t i = 0; i < sweep->count; i++) {
        const lom_trial *t = &sweep->trial[i];
        if (strcmp(t->reference, reference) != 0)
            fprintf(out, "\nagainst %s\n  %-*s %9s  %-22s  %6s  %6s  %7s  %3s\n", t->reference, width, "settings", "ms",
                    "of the default", "PSNR", "SSIM", "FLIP", "max");
        reference = t->reference;
        print_row(out, sweep, t, width);
    }
    fputs("\n* the front: no other is as cheap and as exact. Milliseconds: the median of pairs with the default, in "
          "turn, and its quartiles.\n",
          out);
}
