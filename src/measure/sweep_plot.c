/* A sweep as a plot. In: trials. Out: SVG of error over milliseconds, both logarithmic, the front marked by a line
 * and by numbers that are explained below. Invariant: what is what can be told without colours. */
#include "measure/sweep.h"

#include <string.h>

enum { LEFT = 78, TOP = 54, WIDTH = 700, HEIGHT = 400, ROW = 20, MOST_NUMBERED = 24 };

/* A logarithmic axis. */
struct axis {
    double low, high;
};

struct plot {
    const lom_sweep *sweep;
    struct axis ms, flip;
};

static bool is_shown(const lom_sweep *sweep, const lom_trial *trial)
{
    return trial->failed[0] == 0 && !trial->is_equal && strcmp(trial->reference, sweep->trial[0].reference) == 0;
}

static double along(struct axis axis, double value)
{
    const double at = value < axis.low ? axis.low : value > axis.high ? axis.high : value;
    return lom_double_log(at / axis.low) / lom_double_log(axis.high / axis.low);
}

static double x_of(const struct plot *plot, const lom_trial *trial)
{
    return LEFT + WIDTH * along(plot->ms, lom_trial_ms(plot->sweep, trial));
}
static double y_of(const struct plot *plot, const lom_trial *trial)
{
    return TOP + HEIGHT * (1 - along(plot->flip, trial->error.flip));
}

static void widen(struct axis *axis, double value)
{
    axis->low = value > 0 && value < axis->low ? value : axis->low;
    axis->high = value > axis->high ? value : axis->high;
}

static struct plot scale_plot(const lom_sweep *sweep)
{
    const struct axis empty = { 1e30, 1e-30 };
    struct plot plot = { sweep, empty, empty };
    for (size_t i = 0; i < sweep->count; i++)
        if (is_shown(sweep, &sweep->trial[i])) {
            widen(&plot.ms, lom_trial_ms(sweep, &sweep->trial[i]));
            widen(&plot.flip, sweep->trial[i].error.flip > 1e-5 ? sweep->trial[i].error.flip : 1e-5);
        }
    struct axis *const axes[] = { &plot.ms, &plot.flip };
    for (int i = 0; i < 2; i++) {
        axes[i]->low /= 1.15;
        axes[i]->high *= 1.15;
    }
    return plot;
}

/* Lines at 1, 2, 5 times powers of ten. */
static void print_grid(FILE *out, const struct plot *plot, bool of_time)
{
    static const double steps[] = { 1, 2, 5 };
    const struct axis axis = of_time ? plot->ms : plot->flip;
    for (double power = 1e-6; power < 1e7; power *= 10)
        for (int i = 0; i < 3; i++) {
            const double value = power * steps[i], part = along(axis, value);
            if (value < axis.low || value > axis.high)
                continue;
            const double x = LEFT + WIDTH * part, y = TOP + HEIGHT * (1 - part);
            if (of_time)
                fprintf(out,
                        "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/><text x=\"%.1f\" y=\"%d\" "
                        "text-anchor=\"middle\">%g</text>\n",
                        x, x, TOP, TOP + HEIGHT, x, TOP + HEIGHT + 18, value);
            else
                fprintf(out,
                        "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/><text x=\"%d\" y=\"%.1f\" "
                        "text-anchor=\"end\">%g</text>\n",
                        LEFT, LEFT + WIDTH, y, y, LEFT - 8, y + 4, value);
        }
}

/* The next trial on the front, by time, behind `before` (NULL: the first); NULL: there is none. */
static const lom_trial *next_on_front(const lom_sweep *sweep, const lom_trial *before)
{
    const lom_trial *next = NULL;
    for (size_t i = 0; i < sweep->count; i++) {
        const lom_trial *t = &sweep->trial[i];
        if (!is_shown(sweep, t) || !t->on_front)
            continue;
        const double ms = lom_trial_ms(sweep, t);
        const double least = before != NULL ? lom_trial_ms(sweep, before) : -1;
        if ((ms > least || (ms == least && t > before)) && (next == NULL || ms < lom_trial_ms(sweep, next)))
            next = t;
    }
    return next;
}

static void print_points(FILE *out, const struct plot *plot)
{
    for (size_t i = 0; i < plot->sweep->count; i++) {
        const lom_trial *t = &plot->sweep->trial[i];
        if (!is_shown(plot->sweep, t) || t->is_default || t->on_front)
            continue;
        char text[LOM_LONGEST_TRIAL];
        fprintf(out, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"><title>%s</title></circle>\n",
                t->is_mixed ? "mixed" : "single", x_of(plot, t), y_of(plot, t), t->is_mixed ? "2" : "4",
                lom_print_trial(text, t));
    }
}

static void print_front(FILE *out, const struct plot *plot)
{
    int number = 0;
    fputs("<polyline class=\"front\" points=\"", out);
    for (const lom_trial *t = next_on_front(plot->sweep, NULL); t != NULL; t = next_on_front(plot->sweep, t))
        fprintf(out, "%.1f,%.1f ", x_of(plot, t), y_of(plot, t));
    fputs("\"/>\n", out);
    for (const lom_trial *t = next_on_front(plot->sweep, NULL); t != NULL; t = next_on_front(plot->sweep, t)) {
        char text[LOM_LONGEST_TRIAL], label[16] = "";
        if (++number <= MOST_NUMBERED)
            snprintf(label, sizeof label, "%d", number);
        fprintf(out,
                "<circle class=\"best\" cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\"><title>%s</title></circle><text class=\"n\" "
                "x=\"%.1f\" y=\"%.1f\">%s</text>\n",
                x_of(plot, t), y_of(plot, t), lom_print_trial(text, t), x_of(plot, t) + 5, y_of(plot, t) - 6, label);
    }
    const lom_trial *standard = &plot->sweep->trial[0];
    fprintf(out, "<rect class=\"default\" x=\"%.1f\" y=\"%.1f\" width=\"13\" height=\"13\"/>\n",
            x_of(plot, standard) - 6.5, y_of(plot, standard) - 6.5);
}

/* What the numbers stand for, and the signs. */
static void print_legend(FILE *out, const struct plot *plot)
{
    int number = 0, y = TOP + HEIGHT + 66;
    fprintf(out,
            "<rect class=\"default\" x=\"%d\" y=\"%d\" width=\"11\" height=\"11\"/><text x=\"%d\" y=\"%d\">the "
            "default: %.2f ms, FLIP %.4f</text>\n<circle class=\"single\" cx=\"%d\" cy=\"%d\" r=\"4\"/><text x=\"%d\" "
            "y=\"%d\">one dial</text>\n<circle class=\"mixed\" cx=\"%d\" cy=\"%d\" r=\"2\"/><text x=\"%d\" "
            "y=\"%d\">several</text>\n",
            LEFT, y - 10, LEFT + 18, y, lom_trial_ms(plot->sweep, &plot->sweep->trial[0]),
            plot->sweep->trial[0].error.flip, LEFT + 330, y - 4, LEFT + 340, y, LEFT + 430, y - 4, LEFT + 440, y);
    for (const lom_trial *t = next_on_front(plot->sweep, NULL); t != NULL && number < MOST_NUMBERED;
         t = next_on_front(plot->sweep, t)) {
        char text[LOM_LONGEST_TRIAL];
        y += ROW;
        fprintf(out, "<text x=\"%d\" y=\"%d\"><tspan class=\"n\">%d</tspan>  %.2f ms, FLIP %.4f: %s</text>\n", LEFT, y,
                ++number, lom_trial_ms(plot->sweep, t), t->error.flip, lom_print_trial(text, t));
    }
}

void lom_print_sweep_plot(FILE *out, const lom_sweep *sweep, const lom_sweep_head *head)
{
    const struct plot plot = scale_plot(sweep);
    int rows = 0;
    for (const lom_trial *t = next_on_front(sweep, NULL); t != NULL && rows < MOST_NUMBERED;
         t = next_on_front(sweep, t))
        rows++;
    const int height = TOP + HEIGHT + 80 + ROW * rows, width = LEFT + WIDTH + 30;
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
            "font-family=\"sans-serif\" font-size=\"13\">\n"
            "<style>.grid{stroke:#ccc}.single{fill:none;stroke:#333}.mixed{fill:#999}.best{fill:#000}"
            ".front{fill:none;stroke:#000;stroke-width:1.5}.default{fill:none;stroke:#c00;stroke-width:2.5}"
            ".n{font-weight:bold}</style>\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n"
            "<text x=\"%d\" y=\"22\" font-size=\"16\">%s, %dx%d: error over time</text>\n"
            "<text x=\"%d\" y=\"40\">mean FLIP against %s; the line is the front: nothing is as cheap and as "
            "exact</text>\n",
            width, height, width, height, LEFT, head->scene, head->width, head->height, LEFT,
            sweep->trial[0].reference);
    print_grid(out, &plot, true);
    print_grid(out, &plot, false);
    fprintf(
        out,
        "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"none\" stroke=\"#000\"/>\n<text x=\"%d\" "
        "y=\"%d\" text-anchor=\"middle\">milliseconds a frame, %s, threads: %d</text>\n<text transform=\"translate(20 "
        "%d) rotate(-90)\" text-anchor=\"middle\">FLIP</text>\n",
        LEFT, TOP, WIDTH, HEIGHT, LEFT + WIDTH / 2, TOP + HEIGHT + 38, head->clock, head->threads, TOP + HEIGHT / 2);
    print_points(out, &plot);
    print_front(out, &plot);
    print_legend(out, &plot);
    fputs("</svg>\n", out);
}
