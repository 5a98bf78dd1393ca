/* The kinds of overlays, a row each. In: the tally of a pixel. Out: its number. Invariant: a number is what the stages that
 * drew the picture counted or held; nothing is drawn a second time beside them. */
#include "inspect/overlay.h"

#include <stdio.h>
#include <string.h>

static const float nothing = __builtin_nanf("");

/* ---- what is seen ---- */

static void tell_edge(const struct overlay_place *at, float *value)
{
    *value = at->tally->is_stored ? at->tally->edge : nothing;
}

static void tell_depth(const struct overlay_place *at, float *value)
{
    bool there = at->tally->is_stored && at->tally->depth > 0;
    *value = there ? (float)lom_camera_distance(at->camera, (double)at->tally->depth) : nothing;
}

static void tell_normal(const struct overlay_place *at, float *value)
{
    for (int c = 0; c < 3; c++)
        value[c] = at->tally->named_components == 3 ? at->tally->named[c] : nothing;
}

static void tell_area(const struct overlay_place *at, float *value)
{
    *value = at->tally->is_stored ? at->tally->area : nothing;
}

static void tell_level(const struct overlay_place *at, float *value)
{
    *value = at->tally->is_mipped ? at->tally->level : nothing;
}

static void tell_density(const struct overlay_place *at, float *value)
{
    *value = at->tally->is_mipped ? (float)lom_double_exp2((double)at->tally->asked) : nothing;
}

static void tell_made(const struct overlay_place *at, float *value)
{
    *value = at->tally->at_made ? 4 : (float)at->tally->made;
}

static void tell_named(const struct overlay_place *at, float *value)
{
    *value = at->tally->named_components == 1 ? at->tally->named[0] : nothing;
}

/* ---- work ---- */

static void tell_overdraw(const struct overlay_place *at, float *value)
{
    *value = (float)at->tally->fragments;
}

static void tell_kills(const struct overlay_place *at, float *value)
{
    *value = (float)at->tally->killed;
}

static void tell_lanes(const struct overlay_place *at, float *value)
{
    const lom_tally *t = at->tally;
    *value = t->packets != 0 ? (float)(100.0 * t->lanes / (4.0 * t->packets)) : nothing;
}

static void tell_lookups(const struct overlay_place *at, float *value)
{
    *value = (float)at->tally->lookups;
}

static void tell_steps(const struct overlay_place *at, float *value)
{
    *value = (float)at->tally->steps;
}

static void tell_broken(const struct overlay_place *at, float *value)
{
    *value = (float)at->tally->broken;
}

static void tell_work(const struct overlay_place *at, float *value)
{
    *value = (float)((double)at->tile / 4);
}

static void tell_time(const struct overlay_place *at, float *value)
{
    *value = (float)(at->tally->seconds * 1e3);
}

/* Weights from the times of tiles at 8 lanes (docs/overlays.md). */
uint64_t lom_tally_work(const lom_tally *t)
{
    enum { KILLED = 1, FRAGMENT = 2, LOOKUP = 4, STEP = 10 };
    return KILLED * (uint64_t)t->killed + FRAGMENT * (uint64_t)t->fragments + LOOKUP * (uint64_t)t->lookups +
           STEP * (uint64_t)t->steps;
}

/* ---- the table ---- */

static const struct overlay_row rows[] = {
    { { "wireframe", "pixels to the nearest edge of the triangle that is seen, after clipping", 0, 0, false, true },
      tell_edge,
      OVERLAY_LINES,
      { .target = NULL },
      false },
    { { "depth", "metres along the view to what is seen", 0.1, 10000, true, true },
      tell_depth,
      OVERLAY_SCALE,
      { .target = NULL },
      false },
    { { "normals", "unit normals of what is seen, in the world", 0, 0, false, true },
      tell_normal,
      OVERLAY_VECTORS,
      { .named = "normal" },
      false },
    { { "overdraw", "fragments drawn at a pixel", 0, 8, false, true },
      tell_overdraw,
      OVERLAY_SCALE,
      { .target = NULL },
      false },
    { { "early-kills", "fragments dropped by the depth test before their shader ran", 0, 8, false, true },
      tell_kills,
      OVERLAY_SCALE,
      { .target = NULL },
      false },
    { { "triangle-size", "square pixels of the triangle that is seen", 0.1, 100000, true, true },
      tell_area,
      OVERLAY_SCALE,
      { .target = NULL },
      false },
    { { "mip-level", "level of the first texture with mipmaps that what is seen looked up", 0, 8, false, true },
      tell_level,
      OVERLAY_SCALE,
      { .lookups = true },
      false },
    { { "texel-density", "texels of level 0 a pixel, along the longer side, of that texture", 0.125, 32, true, true },
      tell_density,
      OVERLAY_SCALE,
      { .lookups = true },
      false },
    { { "lookups", "texture lookups and texels read at a pixel", 1, 256, true, true },
      tell_lookups,
      OVERLAY_SCALE,
      { .lookups = true },
      false },
    { { "march-steps", "steps of rays through clouds at a pixel", 1, 512, true, true },
      tell_steps,
      OVERLAY_SCALE,
      { .steps = true },
      false },
    { { "lane-use", "percent of the lanes in use, of packets of 4, that shaded a pixel", 0, 100, false, true },
      tell_lanes,
      OVERLAY_SCALE,
      { .target = NULL },
      false },
    { { "tile-work", "counted work of a tile, as much as so many texture lookups", 1000, 1000000, true, true },
      tell_work,
      OVERLAY_SCALE,
      { .lookups = true, .steps = true },
      true },
    { { "tile-time", "milliseconds of a tile by the clock: other numbers each time", 0.01, 10, true, false },
      tell_time,
      OVERLAY_SCALE,
      { .clock = true },
      false },
    { { "nan", "fragments whose shader gave a colour or a depth that is NaN or infinite", 0, 0, false, true },
      tell_broken,
      OVERLAY_MARKS,
      { .target = NULL },
      false },
    { { "clipped", "vertices that clipping made, of the triangle that is seen; 4: next to one", 0, 0, false, true },
      tell_made,
      OVERLAY_VERTICES,
      { .target = NULL },
      false },
    { { "impostor-age", "frames since the plate of the cloud that is seen was drawn", 0, 32, false, true },
      tell_named,
      OVERLAY_SCALE,
      { .named = "plate_age" },
      false },
    { { "lamps", "lamps in the list of the square of ground that is seen", 0, 16, false, true },
      tell_named,
      OVERLAY_SCALE,
      { .named = "lamps" },
      false },
    { { "cascades", "which of the sun's cascades shades what is seen, from 1; between two where they are mixed", 0, 4,
        false, true },
      tell_named,
      OVERLAY_SCALE,
      { .named = "cascade" },
      false },
};
enum { ROWS = sizeof rows / sizeof rows[0] };

const lom_overlay_kind *lom_describe_overlay(size_t index)
{
    return index < ROWS ? &rows[index].kind : NULL;
}

const struct overlay_row *lom_overlay_row(const lom_overlay_kind *kind)
{
    for (size_t i = 0; i < ROWS; i++)
        if (&rows[i].kind == kind)
            return &rows[i];
    return NULL;
}

const lom_overlay_kind *lom_find_overlay(const char *name, lom_error *error)
{
    const char *names[ROWS];
    char all[400] = "";
    for (size_t i = 0; i < ROWS; i++) {
        size_t length = strlen(all);
        names[i] = rows[i].kind.name;
        if (strcmp(names[i], name) == 0)
            return &rows[i].kind;
        snprintf(all + length, sizeof all - length, "%s%s", i > 0 ? ", " : "", names[i]);
    }
    const char *near = lom_nearest_name(name, strlen(name), names, ROWS);
    if (near != NULL)
        lom_fail(error, LOM_ERROR_USAGE, "There is no overlay \"%s\" (did you mean \"%s\"?); there are %s.", name, near,
                 all);
    else
        lom_fail(error, LOM_ERROR_USAGE, "There is no overlay \"%s\"; there are %s.", name, all);
    return NULL;
}
