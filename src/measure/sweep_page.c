/* A sweep as a page. In: trials with their pictures. Out: HTML that needs no other file: the plot, all trials, the
 * pictures of the front with maps of their errors. Invariant: text that comes from outside is escaped. */
#include "measure/sweep.h"

#include "image/data_uri.h"

#include <string.h>

enum { MOST_PICTURES = 24 };

static const char head_text[] =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
    "content=\"width=device-width,initial-scale=1\"><title>lom trade</title><style>\n"
    "body{font:15px/1.45 system-ui,sans-serif;margin:24px auto;max-width:1100px;padding:0 12px;color:#111;"
    "background:#fff}\n"
    "h1{font-size:22px}h2{font-size:18px;margin-top:34px}svg{max-width:100%;height:auto}code{font-size:13px}\n"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px}td,th{padding:2px "
    "9px;text-align:right;"
    "border-bottom:1px solid "
    "#ddd}td:first-child,th:first-child,td:last-child{text-align:left}tr.front{font-weight:bold}"
    "tr.bug{background:#fbb}\n"
    "figure{margin:0 0 26px}figure div{display:flex;gap:8px;flex-wrap:wrap}figure img{width:calc(50% - "
    "4px);min-width:300px;"
    "image-rendering:pixelated}figcaption{margin:4px 0}\n"
    "@media print{figure{break-inside:avoid}}</style>\n";

static void print_escaped(FILE *out, const char *text)
{
    for (; *text != 0; text++)
        if (*text == '<')
            fputs("&lt;", out);
        else if (*text == '&')
            fputs("&amp;", out);
        else if (*text == '"')
            fputs("&quot;", out);
        else
            fputc(*text, out);
}

static bool print_picture(FILE *out, const lom_image *image, const char *what, lom_error *error)
{
    lom_bytes png = image != NULL ? lom_encode_shown_image(image, error) : (lom_bytes){ NULL, 0 };
    if (png.data == NULL)
        return false;
    fprintf(out, "<img alt=\"%s\" src=\"", what);
    lom_print_data_uri(out, png);
    fputs("\">", out);
    lom_release(png.data);
    return true;
}

static bool print_figure(FILE *out, const lom_sweep *sweep, const lom_trial *trial, lom_error *error)
{
    char text[LOM_LONGEST_TRIAL];
    lom_image *map = lom_compare_picture(sweep->reference, trial->picture, error);
    fputs("<figure><div>", out);
    bool done = map != NULL && print_picture(out, trial->picture, "picture", error) &&
                print_picture(out, map, "differences", error);
    lom_free_image(map);
    fputs("</div><figcaption><code>", out);
    print_escaped(out, lom_print_trial(text, trial));
    fprintf(
        out,
        "</code>: %.2f ms (%.3f of the default, quartiles %.3f to %.3f), FLIP %.4f, PSNR %.2f dB, SSIM %.4f, at most "
        "%.0f of 255%s</figcaption></figure>\n",
        lom_trial_ms(sweep, trial), trial->time.ratio, trial->time.low, trial->time.high, trial->error.flip,
        trial->error.psnr, trial->error.ssim, trial->error.max_delta, trial->is_default ? "; the default" : "");
    return done;
}

static void print_row(FILE *out, const lom_sweep *sweep, const lom_trial *t)
{
    char text[LOM_LONGEST_TRIAL];
    fprintf(out, "<tr class=\"%s\"><td><code>", t->differs ? "bug" : t->on_front ? "front" : "");
    print_escaped(out, lom_print_trial(text, t));
    fprintf(out, "</code></td><td>%s</td>", t->reference);
    if (t->failed[0] != 0) {
        fputs("<td></td><td></td><td></td><td></td><td></td><td></td><td>", out);
        print_escaped(out, t->failed);
    } else {
        fprintf(out,
                "<td>%.2f</td><td>%.3f (%.3f&ndash;%.3f)</td><td>%.4f</td><td>%.2f</td><td>%.4f</td><td>%.0f</td>"
                "<td>%s",
                lom_trial_ms(sweep, t), t->time.ratio, t->time.low, t->time.high, t->error.flip, t->error.psnr,
                t->error.ssim, t->error.max_delta,
                t->differs         ? "changes the picture, and must not"
                : t->beats_default ? "beats the default"
                : t->is_default    ? "default"
                                   : "");
    }
    fputs("</td></tr>\n", out);
}

static void print_table(FILE *out, const lom_sweep *sweep)
{
    fputs("<h2>All settings</h2>\n<p>Bold: the front. Dials of speed are measured against the default, from which they "
          "may not differ.</p>\n<table><tr><th>settings</th><th>against</th><th>ms</th><th>of the default</th>"
          "<th>FLIP</th><th>PSNR</th><th>SSIM</th><th>max</th><th></th></tr>\n",
          out);
    for (size_t i = 0; i < sweep->count; i++)
        print_row(out, sweep, &sweep->trial[i]);
    fputs("</table>\n", out);
}

static bool has_picture(const lom_sweep *sweep, const lom_trial *t)
{
    return (t->is_default || t->on_front) && t->picture != NULL && strcmp(t->reference, sweep->trial[0].reference) == 0;
}

bool lom_print_sweep_page(FILE *out, const lom_sweep *sweep, const lom_sweep_head *head, lom_error *error)
{
    fputs(head_text, out);
    fputs("<h1>", out);
    print_escaped(out, head->scene);
    fprintf(out, ", frame %d, %dx%d, threads: %d, lanes: %d, %s</h1>\n<p><code>", head->frame, head->width,
            head->height, head->threads, head->lanes, head->clock);
    print_escaped(out, head->command);
    fputs("</code></p>\n", out);
    lom_print_sweep_plot(out, sweep, head);
    fputs("<h2>The reference</h2>\n<figure><div>", out);
    bool done = print_picture(out, sweep->reference, "reference", error);
    fputs("</div></figure>\n<h2>The default and the front</h2>\n<p>The picture, and its differences from the "
          "reference: black is "
          "none, 64 + 191 &radic;d a difference of d in a channel.</p>\n",
          out);
    for (size_t i = 0, shown = 0; done && i < sweep->count && shown < MOST_PICTURES; i++)
        if (has_picture(sweep, &sweep->trial[i])) {
            done = print_figure(out, sweep, &sweep->trial[i], error);
            shown++;
        }
    print_table(out, sweep);
    fputs("</html>\n", out);
    return done;
}
