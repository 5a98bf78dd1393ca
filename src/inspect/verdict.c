/* The verdict on a pixel. In: its record. Out: who wrote what it holds and who lost it to whom; or why nobody did. */
#include "inspect/verdict.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *lom_primitive_name(const lom_draw_record *draw)
{
    const lom_topology topology = draw->desc.topology;
    return topology == LOM_LINES || topology == LOM_LINE_STRIP ? "line" : "triangle";
}

const char *lom_draw_name(const lom_draw_record *draw)
{
    return draw->label != NULL ? draw->label : draw->desc.shader->name;
}

const char *lom_pass_name(const lom_pass_record *pass)
{
    return pass->label != NULL ? pass->label : "without a name";
}

struct tally {
    size_t fate[LOM_FATES], all, unrecorded;
    const lom_triangle_record *last, *before; /* stored at the end; and the last one that was lost to it */
    const lom_pass_record *first_pass, *last_pass, *filter;
};

static void count(const lom_pixel_record *pixel, struct tally *tally)
{
    tally->first_pass = pixel->passes;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next) {
        tally->last_pass = pass;
        tally->filter = pass->filters ? pass : tally->filter;
        for (const lom_draw_record *draw = pass->filters ? NULL : pass->draws; draw != NULL; draw = draw->next) {
            tally->unrecorded += !draw->recorded;
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next) {
                tally->fate[t->fate]++;
                tally->all++;
                if (t->fate == LOM_FATE_STORED)
                    tally->last = t;
                else if (t->fate == LOM_FATE_LOST || t->fate == LOM_FATE_BLENDED_OVER)
                    tally->before = t;
            }
        }
    }
}

static void say(char *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(char *text, const char *format, ...)
{
    size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, LOM_MAX_VERDICT - length, format, arguments);
    va_end(arguments);
}

static void say_who(char *text, const lom_triangle_record *t)
{
    const lom_draw_record *draw = t->draw;
    if (draw->label != NULL)
        say(text, "%s (shader %s, %s %zu of draw %zu in pass \"%s\")", draw->label, draw->desc.shader->name,
            lom_primitive_name(draw), t->number, draw->number, lom_pass_name(draw->pass));
    else
        say(text, "shader %s (%s %zu of draw %zu in pass \"%s\")", draw->desc.shader->name, lom_primitive_name(draw),
            t->number, draw->number, lom_pass_name(draw->pass));
}

static void say_rejected(char *text, const struct tally *tally)
{
    bool any = false;
    for (int i = LOM_FATE_DEPTH; i < LOM_FATES; i++)
        if (tally->fate[i] != 0) {
            say(text, "%s%zu %s", any ? ", " : "", tally->fate[i], lom_fate_text((lom_fate)i));
            any = true;
        }
}

static size_t count_rejected(const struct tally *tally)
{
    size_t sum = 0;
    for (int i = LOM_FATE_DEPTH; i < LOM_FATES; i++)
        sum += tally->fate[i];
    return sum;
}

static void say_kept(char *text, const struct tally *tally)
{
    const lom_pass_record *pass = tally->last_pass;
    if (pass == NULL)
        say(text, " no pass of this frame draws there.");
    else
        say(text, " it keeps the clear value of pass \"%s\".", lom_pass_name(tally->first_pass));
}

/* The parts of its light that the filter of edges takes from the pixels beside it. */
static const float *find_parts(const lom_pass_record *filter)
{
    for (const lom_draw_record *draw = filter->draws; draw != NULL; draw = draw->next)
        for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
            for (const lom_note_record *n = t->fragment.notes; n != NULL; n = n->next)
                if (n->kind == LOM_NOTE_VALUE && strcmp(n->name, "beyond_edges") == 0 && n->components == 4)
                    return n->value;
    return NULL;
}

static void say_mixed(char *text, const lom_pass_record *filter)
{
    static const char *const sides[] = { "right", "left", "lower", "upper" };
    const float *part = find_parts(filter);
    bool any = false;
    for (int i = 0; part != NULL && i < 4; i++)
        if (part[i] > 0) {
            say(text,
                any ? ", %.1f %% the %s one's" : " Its edge is smoothed: %.1f %% of its light is the %s neighbour's",
                100 * (double)part[i], sides[i]);
            any = true;
        }
    say(text, any ? "." : "");
}

void lom_find_verdict(lom_explained *explained)
{
    struct tally tally = { .all = 0 };
    char *text = explained->verdict;
    text[0] = 0;
    count(explained->record, &tally);
    explained->owner = tally.last;
    if (tally.last != NULL) {
        bool blends = tally.last->draw->pass->attachment >= 0 &&
                      tally.last->draw->desc.blend[tally.last->draw->pass->attachment].enabled;
        say_who(text, tally.last);
        say(text, blends ? " blended over what was here" : " wrote this");
        if (tally.before != NULL) {
            say(text, tally.before->fate == LOM_FATE_LOST ? "; what was stored is lost to it: " : ": ");
            say_who(text, tally.before);
        }
        say(text, ".");
        if (count_rejected(&tally) != 0) {
            say(text, " Rejected: ");
            say_rejected(text, &tally);
            say(text, ".");
        }
    } else if (tally.all != 0) {
        say(text, "All was rejected here (");
        say_rejected(text, &tally);
        say(text, "):");
        say_kept(text, &tally);
    } else {
        say(text, "Nothing drew here:");
        say_kept(text, &tally);
    }
    if (tally.filter != NULL)
        say_mixed(text, tally.filter);
    if (tally.unrecorded != 0)
        say(text, " %zu draws could not be recorded.", tally.unrecorded);
}
