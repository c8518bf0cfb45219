/* commands/analysis/distortion_view.c - distortion drawn: curves over the field, and a grid. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/distortion_models.h"
#include "draw/grid_image.h"
#include "draw/panels.h"

#include <string.h>

/* The farthest field of the lens, but the one that is asked for. */
static const struct analysis_policy *distortion_view_policy_of(const struct distortion_input *input)
{
    const struct analysis_question *question = &input->question;
    const bool asked = analysis_is_given(question->field, question->field_x) ||
                       analysis_is_given(question->height, question->height_x);
    return asked ? &distortion_by_field : &distortion_as_whole;
}

/* -------- curves -------- */

enum { POINTS = 65, MOST_PANELS = 60, MOST_KEYS = 24 };

/* Distortion over the field, of one lens in one position at one wavelength. */
struct distortion_view_curve {
    size_t panel, key;
    double edge; /* rad or mm */
    double *x, *y;
};

struct distortion_view_curves {
    const struct distortion_input *input; /* the one at work */
    struct arena *arena;
    const char *panels[MOST_PANELS], *keys[MOST_KEYS];
    size_t panel_count, key_count, count, room;
    struct distortion_view_curve *all;
    const char *subtitle;
    bool is_far;
};

/* The place of a text in a list, to which it is added; `most` where there is no room. */
static size_t view_place_of(const char **list, size_t *count, size_t most, const char *text)
{
    size_t i = 0;
    while (i < *count && strcmp(list[i], text) != 0) {
        i++;
    }
    if (i == *count && i < most) {
        list[(*count)++] = text;
    }
    return i;
}

static const char *panel_words(const struct setup *setup)
{
    const char *title = setup->lens->title != NULL ? setup->lens->title : "lens";
    return setup->position != NULL ? arena_printf(setup->arena, "%s, %s", title, setup->position)
                                   : title;
}

/* The light, and what else may be asked for in lists. */
static const char *key_words(const struct distortion_input *input, const struct analysis_case *one)
{
    const double defocus = one->question->defocus, object = one->question->object;
    struct arena *arena = one->setup->arena;
    const char *words =
        arena_printf(arena, "%.5g nm", 1000 * one->setup->wavelengths[0].wavelength);
    if (input->projection > 0) {
        words = ARENA_JOIN(arena, words, ", ", projections[input->projection - 1].word);
    }
    if (!isnan(object)) {
        words = arena_printf(arena, "%s, object at %.4g mm", words, object);
    }
    return isnan(defocus) ? words : arena_printf(arena, "%s, defocus %.4g mm", words, defocus);
}

/* "rectilinear, f 100.7 mm at 587.56 nm": what the distortion is the difference from. */
static const char *ideal_words(const struct distortion_case *ready, struct arena *arena)
{
    const char *how = isnan(ready->calibrated) ? "" : "calibrated ";
    return isnan(ready->focal)
               ? arena_printf(arena, "against %smagnification %.6g", how, ready->map.scale)
               : arena_printf(arena, "against the %s image of %sfocal length %.6g mm",
                              ready->projection, how, ready->map.scale);
}

/* The same of several lenses or projections, which the curves name themselves. */
static const char *ideals_words(const struct distortion_input *input,
                                const struct distortion_case *ready, struct arena *arena)
{
    const char *which = isnan(ready->calibrated) ? "paraxial" : "calibrated";
    return input->projection > 0
               ? arena_printf(arena, "against ideal images of the %s focal length", which)
               : arena_printf(arena, "against the %s image of the %s focal length",
                              ready->projection, which);
}

/* Of curves of the same place and light the longest one. */
static struct distortion_view_curve *room_for(struct distortion_view_curves *curves, size_t panel,
                                              size_t key, double edge)
{
    for (size_t i = 0; i < curves->count; i++) {
        struct distortion_view_curve *old = &curves->all[i];
        if (old->panel == panel && old->key == key) {
            return old->edge < edge ? old : NULL;
        }
    }
    curves->all =
        arena_grow(curves->arena, curves->all, curves->count, &curves->room, sizeof *curves->all);
    struct distortion_view_curve *curve = &curves->all[curves->count++];
    *curve = (struct distortion_view_curve){.panel = panel,
                                            .key = key,
                                            .x = ARENA_ARRAY(curves->arena, POINTS, double),
                                            .y = ARENA_ARRAY(curves->arena, POINTS, double)};
    return curve;
}

static bool distortion_view_add_curve(struct distortion_view_curves *curves,
                                      const struct analysis_case *one, struct error *error)
{
    const struct setup *setup = one->setup;
    struct distortion_case ready;
    double towards[2], edge;
    if (!distortion_ready(curves->input, one, NULL, &ready, error) ||
        !distortion_direction(&ready.map, &setup->fields[0].point, towards, &edge, error)) {
        return false;
    }
    const size_t panel =
        view_place_of(curves->panels, &curves->panel_count, MOST_PANELS, panel_words(setup));
    const size_t key =
        view_place_of(curves->keys, &curves->key_count, MOST_KEYS, key_words(curves->input, one));
    if (panel == MOST_PANELS || key == MOST_KEYS) {
        return fail(error, ERROR_USAGE, "{--plot} has room for %d lenses and %d kinds of light",
                    MOST_PANELS, MOST_KEYS);
    }
    const bool far = setup->object.is_infinite;
    if (curves->count > 0 && far != curves->is_far) {
        return fail(error, ERROR_USAGE,
                    "{--plot}: fields of near objects and of those at infinity share no axis");
    }
    struct distortion_view_curve *curve = edge > 0 ? room_for(curves, panel, key, edge) : NULL;
    if (curve == NULL) {
        return true;
    }
    curve->edge = edge;
    curves->is_far = far;
    curves->subtitle = curves->count == 1 ? ideal_words(&ready, curves->arena)
                                          : ideals_words(curves->input, &ready, curves->arena);
    /* Fields whose chief ray is lost are gaps; false with the reason where that are all. */
    bool any = false;
    for (size_t i = 0; i < POINTS; i++) {
        const double share = i > 0 ? (double)i / (POINTS - 1) : 1e-4;
        struct distortion_point point;
        const double amount = share * curve->edge;
        bool found = distortion_towards(&ready.map, towards, amount, &point, error);
        curve->x[i] = found ? point.percent : (double)NAN;
        curve->y[i] = ready.map.setup.object.is_infinite ? amount * DEGREES_PER_RADIAN : amount;
        any = any || found;
    }
    return any;
}

bool distortion_plot(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct distortion_view_curves curves = {.arena = job->run->arena};
    for (size_t i = 0; i < job->count; i++) {
        curves.input = job->inputs[i];
        struct analysis_cursor at =
            analysis_begin(curves.input, distortion_view_policy_of(curves.input), job->run);
        while (analysis_next_case(&at, error)) {
            if (!distortion_view_add_curve(&curves, at.one, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    if (curves.count == 0) {
        return fail(error, ERROR_DOMAIN, "{--plot}: no field lies off the axis");
    }
    struct arena *arena = curves.arena;
    struct panel *panels = ARENA_ARRAY(arena, curves.panel_count, struct panel);
    for (size_t p = 0; p < curves.panel_count; p++) {
        struct panel_series *series = ARENA_ARRAY(arena, curves.count, struct panel_series);
        panels[p] = (struct panel){.title = curves.panels[p], .series = series};
        for (size_t i = 0; i < curves.count; i++) {
            const struct distortion_view_curve *curve = &curves.all[i];
            if (curve->panel == p) {
                series[panels[p].count++] = (struct panel_series){
                    .x = curve->x, .y = curve->y, .count = POINTS, .key = curve->key};
            }
        }
    }
    const size_t count = curves.panel_count;
    const struct panels page = {.title = "Distortion over the field",
                                .subtitle = curves.subtitle,
                                .x_label = "distortion (%)",
                                .y_label = curves.is_far ? "field (deg)" : "object height (mm)",
                                .keys = curves.keys,
                                .key_count = curves.key_count,
                                .columns = count < 4 ? count : 4,
                                .panels = panels,
                                .count = count};
    return panels_draw(&page, &svg, error) && drawing_write(job, &svg, sink, error);
}

/* -------- a grid -------- */

enum { LINES = 11, PIECES = 4, LINE_POINTS = (LINES - 1) * PIECES + 1 };

static bool view_draw_grid(const struct distortion_input *input, const struct analysis_case *one,
                           struct svg *svg, struct error *error)
{
    const struct setup *setup = one->setup;
    struct arena *arena = setup->arena;
    struct distortion_case ready;
    struct distortion_point corner;
    const size_t count = 2 * (size_t)LINES * LINE_POINTS;
    double *x = ARENA_ARRAY(arena, count, double), *y = ARENA_ARRAY(arena, count, double);
    if (!distortion_ready(input, one, NULL, &ready, error) ||
        !distortion_at(&ready.map, &setup->fields[0].point, &corner, error)) {
        return false;
    }
    if (!(corner.field > 0)) {
        return fail(error, ERROR_DOMAIN, "{--grid}: the field lies on the axis");
    }
    const bool far = setup->object.is_infinite;
    const struct grid_image grid = {
        .title = arena_printf(arena, "Distortion: %s", panel_words(setup)),
        .subtitle = arena_printf(arena, "a square grid %s", ideal_words(&ready, arena)),
        .note = arena_printf(arena, "%s; corners at a field of %.4g %s, distortion %+.3g %%",
                             key_words(input, one),
                             far ? corner.field * DEGREES_PER_RADIAN : corner.field,
                             far ? "deg" : "mm", corner.percent),
        .ideal_label = "ideal image",
        .image_label = "exact chief rays",
        .lines = LINES,
        .points = LINE_POINTS,
        .half = fabs(corner.ideal) / sqrt(2),
        .x = x,
        .y = y,
    };
    /* Every point of the grid; lost ones are gaps. */
    for (size_t i = 0; i < 2 * (size_t)LINES * LINE_POINTS; i++) {
        const size_t line = i / LINE_POINTS % LINES;
        const double along = grid.half * (2 * (double)(i % LINE_POINTS) / (LINE_POINTS - 1) - 1);
        const double across = grid.half * (2 * (double)line / (LINES - 1) - 1);
        const bool is_upright = i < (size_t)LINES * LINE_POINTS;
        const double ideal[2] = {is_upright ? across : along, is_upright ? along : across};
        double image[2];
        bool found = distortion_of_ideal(&ready.map, ideal, image, error);
        x[i] = found ? image[0] : (double)NAN;
        y[i] = found ? image[1] : (double)NAN;
    }
    return grid_image_draw(&grid, svg, error);
}

bool distortion_grid_check(const struct artifact_job *job, struct error *error)
{
    const struct distortion_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--grid} shows one position: name it with {--position}");
}

bool distortion_grid(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    const struct distortion_input *input = job->inputs[0];
    struct analysis_cursor at = analysis_begin(input, distortion_view_policy_of(input), job->run);
    return analysis_next_case(&at, error) && view_draw_grid(input, at.one, &svg, error) &&
           drawing_write(job, &svg, sink, error);
}
