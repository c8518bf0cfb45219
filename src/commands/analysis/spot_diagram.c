/* commands/analysis/spot_diagram.c - spots drawn: by field, through focus, and as curves. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/spot_diagram.h"
#include "commands/analysis/analysis_fields.h"

#include "commands/analysis/analysis_words.h"
#include "draw/panels.h"
#include "draw/plot.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_ROWS = 12, MOST_COLUMNS = 9, RAYS = 217 };

/* Where a spot stands in the drawing. */
struct spot_diagram_place {
    const char *field;           /* in words */
    bool is_angle;               /* the field, else a height */
    double field_value, defocus; /* as shown; NaN = none */
};

/* A spot of the drawing. */
struct drawn {
    struct spot_diagram_place place;
    double rms; /* um or mrad */
    struct panel panel;
};

struct spot_drawing {
    struct run *run;
    struct arena *arena;
    const struct spot_input *input;
    bool with_points;
    struct drawn *all;
    size_t count, room;
    const char *title, *focus;
    double airy; /* radius of the Airy disc, um or mrad; NaN = not known */
    bool is_angular, is_footprint;
    const double *wavelengths; /* of the keys, ascending, um */
    size_t wavelength_count;
};

static const struct unit *unit_for(const struct spot_drawing *drawing)
{
    return drawing->is_angular
               ? unit_find(&dimension_angle, text_of("mrad"))
               : unit_find(&dimension_length, text_of(drawing->is_footprint ? "mm" : "um"));
}

static const char *spot_diagram_unit_words(const struct spot_drawing *drawing)
{
    if (drawing->is_angular) {
        return "mrad";
    }
    if (drawing->is_footprint) {
        return "mm";
    }
    return "\xc2\xb5m";
}

static struct spot_diagram_place spot_diagram_place_of(const struct analysis_case *one,
                                                       size_t field, struct arena *arena)
{
    const struct field_point *at = &one->setup->fields[field].point;
    const bool beside = fabs(at->value[0]) > fabs(at->value[1]);
    const bool angle = at->kind == FIELD_ANGLE;
    const double value = angle ? unit_from_own(unit_find(&dimension_angle, text_of("deg")),
                                               at->value[beside ? 0 : 1])
                               : at->value[beside ? 0 : 1];
    const char *position = one->setup->position;
    const char *words = at->kind == FIELD_NONE ? "axis"
                                               : arena_printf(arena, "%.4g%s", value + 0.0,
                                                              angle ? "\xc2\xb0" : " mm");
    return (struct spot_diagram_place){position != NULL && one->question->position != NULL
                                           ? arena_printf(arena, "%s, %s", position, words)
                                           : words,
                                       at->kind != FIELD_HEIGHT && at->kind != FIELD_IMAGE &&
                                           at->kind != FIELD_REAL,
                                       value, one->question->defocus};
}

/* Keys in the order of the light, violet first. */
static int spot_diagram_by_value(const void *first, const void *second)
{
    double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

static void spot_diagram_list_wavelengths(struct spot_drawing *drawing, const struct setup *setup)
{
    double *list = ARENA_ARRAY(drawing->arena, setup->wavelength_count, double);
    for (size_t i = 0; i < setup->wavelength_count; i++) {
        list[i] = setup->wavelengths[i].wavelength;
    }
    qsort(list, setup->wavelength_count, sizeof *list, spot_diagram_by_value);
    drawing->wavelengths = list;
    drawing->wavelength_count = setup->wavelength_count;
}

static size_t spot_diagram_key_of(const struct spot_drawing *drawing, double wavelength)
{
    size_t key = 0;
    while (key + 1 < drawing->wavelength_count && drawing->wavelengths[key] < wavelength) {
        key++;
    }
    return key;
}

/* The points of one field, a series a wavelength. */
static void spot_diagram_add_points(struct spot_drawing *drawing, const struct analysis_case *one,
                                    const struct spot_question *question, struct drawn *drawn)
{
    const struct unit *unit = unit_for(drawing);
    struct arena *arena = drawing->arena;
    struct spot_question even = *question;
    struct panel_series *series =
        ARENA_ARRAY(arena, one->setup->wavelength_count, struct panel_series);
    even.bundle.pattern =
        question->bundle.pattern == PATTERN_GAUSS ? PATTERN_HEXAPOLAR : question->bundle.pattern;
    even.bundle.weight = WEIGHT_PUPIL;
    drawn->panel.series = series;
    for (size_t g = 0; g < one->setup->wavelength_count; g++) {
        struct spot_points points;
        struct error ignored;
        size_t rays = question->rays > 0 ? question->rays : RAYS;
        /* without a chief ray there is no pattern: Gauss's points then */
        if (!spot_points_find(&even, g, rays, arena, &points, &ignored) &&
            !spot_points_find(question, g, rays, arena, &points, &ignored)) {
            continue;
        }
        double *x = ARENA_ARRAY(arena, points.count, double);
        double *y = ARENA_ARRAY(arena, points.count, double);
        for (size_t i = 0; i < points.count; i++) {
            x[i] = unit_from_own(unit, points.at[i][0]);
            y[i] = unit_from_own(unit, points.at[i][1]);
        }
        size_t key = spot_diagram_key_of(drawing, one->setup->wavelengths[g].wavelength);
        series[drawn->panel.count++] =
            (struct panel_series){.x = x, .y = y, .count = points.count, .key = key, .spots = true};
    }
}

/* The Airy disc of the working f-number on the axis, at the primary wavelength. */
static double airy_radius(const struct setup *setup, bool is_angular)
{
    const struct first_order *first = &setup->first;
    double wavelength = setup->wavelengths[0].wavelength / 1000; /* mm */
    return is_angular ? 1.21967 * wavelength / fabs(first->exit_diameter)
                      : 1.21967 * wavelength * fabs(first->working_fnumber);
}

static bool spot_diagram_add(const struct analysis_case *one, size_t field, void *context,
                             struct error *error)
{
    struct spot_drawing *drawing = context;
    const struct setup *setup = one->setup;
    struct spot_question question;
    struct spot spot;
    drawing->title = setup->lens->title;
    drawing->focus = setup->focus;
    drawing->all = arena_grow(drawing->arena, drawing->all, drawing->count, &drawing->room,
                              sizeof *drawing->all);
    struct drawn *drawn = &drawing->all[drawing->count];
    *drawn = (struct drawn){.place = spot_diagram_place_of(one, field, drawing->arena), .rms = NAN};
    if (!spot_question_of(one, field, drawing->input, &question, error)) {
        return false;
    }
    drawing->count++;
    question.energy = NAN;
    question.no_radius = true;
    if (!spot_find(&question, drawing->arena, &spot, error)) {
        drawn->panel.note = "no rays";
        drawing->run->shortfall = *error;
        error_prefix(&drawing->run->shortfall,
                     "%s: ", lens_field_words(&setup->fields[field].point, drawing->arena));
        error->code = ERROR_NONE;
        return true;
    }
    drawing->is_angular = spot.is_angular;
    drawing->is_footprint = question.to > 0;
    drawing->airy = question.to > 0 ? (double)NAN : airy_radius(setup, spot.is_angular);
    drawn->rms = unit_from_own(unit_for(drawing), spot.rms);
    drawn->panel.note =
        ARENA_JOIN(drawing->arena, "RMS ", analysis_number(drawn->rms, drawing->arena), " ",
                   spot_diagram_unit_words(drawing));
    if (drawing->with_points) {
        spot_diagram_list_wavelengths(drawing, setup);
        spot_diagram_add_points(drawing, one, &question, drawn);
    }
    return true;
}

/* Rows are fields, columns defocuses: each once, in the order they come. */
struct spot_diagram_grid {
    size_t *rows, *columns; /* the first spot of each */
    size_t row_count, column_count;
    size_t *row, *column; /* of each spot */
};

static bool same_field(const struct drawn *a, const struct drawn *b)
{
    return text_same(text_of(a->place.field), b->place.field);
}

static bool same_defocus(const struct drawn *a, const struct drawn *b)
{
    return !(fabs(a->place.defocus - b->place.defocus) > 0);
}

/* The place in a list of what is the same; added at its end if it is new. */
static size_t index_in(const struct spot_drawing *drawing, size_t spot,
                       bool (*same)(const struct drawn *, const struct drawn *), size_t *list,
                       size_t *count)
{
    size_t i = 0;
    while (i < *count && !same(&drawing->all[list[i]], &drawing->all[spot])) {
        i++;
    }
    if (i == *count) {
        list[(*count)++] = spot;
    }
    return i;
}

static struct spot_diagram_grid grid_of(const struct spot_drawing *drawing)
{
    size_t count = drawing->count;
    struct spot_diagram_grid grid = {.rows = ARENA_ARRAY(drawing->arena, count, size_t),
                                     .columns = ARENA_ARRAY(drawing->arena, count, size_t),
                                     .row = ARENA_ARRAY(drawing->arena, count, size_t),
                                     .column = ARENA_ARRAY(drawing->arena, count, size_t)};
    for (size_t i = 0; i < count; i++) {
        grid.row[i] = index_in(drawing, i, same_field, grid.rows, &grid.row_count);
        grid.column[i] = index_in(drawing, i, same_defocus, grid.columns, &grid.column_count);
    }
    return grid;
}

static const char *spot_diagram_subtitle_of(const struct spot_drawing *drawing)
{
    return arena_printf(drawing->arena, "%s%s",
                        drawing->input->to > 0 ? "footprint on surface "
                        : drawing->is_angular  ? "angles of an afocal image"
                                               : "focus ",
                        drawing->input->to > 0
                            ? arena_printf(drawing->arena, "%ld", drawing->input->to)
                        : drawing->is_angular || drawing->focus == NULL ? ""
                                                                        : drawing->focus);
}

/* What stands over the columns: defocuses. */
static const char *const *column_heads(const struct spot_drawing *drawing,
                                       const struct spot_diagram_grid *grid)
{
    const char **heads = ARENA_ARRAY(drawing->arena, grid->column_count, const char *);
    for (size_t i = 0; i < grid->column_count; i++) {
        double defocus = drawing->all[grid->columns[i]].place.defocus;
        heads[i] = fabs(defocus) > 0 ? arena_printf(drawing->arena, "%+.4g mm", defocus) : "0 mm";
    }
    return heads;
}

static const char *const *row_heads(const struct spot_drawing *drawing,
                                    const struct spot_diagram_grid *grid)
{
    const char **heads = ARENA_ARRAY(drawing->arena, grid->row_count, const char *);
    for (size_t i = 0; i < grid->row_count; i++) {
        heads[i] = drawing->all[grid->rows[i]].place.field;
    }
    return heads;
}

static const char *const *keys_of(const struct spot_drawing *drawing)
{
    const char **keys = ARENA_ARRAY(drawing->arena, drawing->wavelength_count + 1, const char *);
    for (size_t i = 0; i < drawing->wavelength_count; i++) {
        keys[i] = arena_printf(drawing->arena, "%.4g nm", 1000 * drawing->wavelengths[i]);
    }
    return keys;
}

/* A grid of spots. */
static bool spot_diagram_draw_spots(const struct spot_drawing *drawing,
                                    const struct spot_diagram_grid *grid, struct svg *svg,
                                    struct error *error)
{
    const bool focus = grid->column_count > 1, has_airy = isfinite(drawing->airy);
    const size_t count = grid->row_count * grid->column_count;
    struct panel *list = ARENA_ARRAY(drawing->arena, count, struct panel);
    for (size_t i = 0; i < drawing->count; i++) {
        struct panel *panel = &list[grid->row[i] * grid->column_count + grid->column[i]];
        *panel = drawing->all[i].panel;
        panel->title = focus ? NULL : drawing->all[i].place.field;
        panel->circle = has_airy ? unit_from_own(unit_for(drawing), drawing->airy) : 0;
    }
    const struct panels panels = {
        .title = arena_printf(drawing->arena, "%s of %s%s",
                              drawing->input->to > 0 ? "Footprints" : "Spots", drawing->title,
                              focus ? " through focus" : ""),
        .subtitle = spot_diagram_subtitle_of(drawing),
        .unit = spot_diagram_unit_words(drawing),
        .column_heads = focus ? column_heads(drawing, grid) : NULL,
        .row_heads = focus ? row_heads(drawing, grid) : NULL,
        .keys = keys_of(drawing),
        .key_count = drawing->wavelength_count,
        .light = true,
        .circle_label = has_airy ? "Airy disc on the axis" : NULL,
        .columns = focus                 ? grid->column_count
                   : grid->row_count < 4 ? grid->row_count
                                         : 3,
        .panels = list,
        .count = count,
    };
    return panels_draw(&panels, svg, error);
}

/* The RMS radius against the defocus, a curve a field; or against the field. */
static bool spot_diagram_draw_curves(const struct spot_drawing *drawing,
                                     const struct spot_diagram_grid *grid, struct svg *svg,
                                     struct error *error)
{
    struct arena *arena = drawing->arena;
    const bool focus = grid->column_count > 1;
    const size_t count = focus ? grid->column_count : grid->row_count;
    const size_t curves = focus ? grid->row_count : 1;
    double *x = ARENA_ARRAY(arena, count, double), *y = ARENA_ARRAY(arena, count * curves, double);
    struct plot_series *series = ARENA_ARRAY(arena, curves, struct plot_series);
    for (size_t i = 0; i < count * curves; i++) {
        y[i] = NAN;
    }
    for (size_t k = 0; k < curves; k++) {
        const char *label = focus ? drawing->all[grid->rows[k]].place.field : NULL;
        series[k] = (struct plot_series){.label = label, .y = y + k * count, .style = k};
    }
    for (size_t i = 0; i < drawing->count; i++) {
        const struct spot_diagram_place *place = &drawing->all[i].place;
        size_t at = focus ? grid->column[i] : grid->row[i];
        x[at] = focus ? place->defocus : place->field_value;
        y[(focus ? grid->row[i] : 0) * count + at] = drawing->all[i].rms;
    }
    const struct plot plot = {
        .title = arena_printf(arena, "Spots of %s", drawing->title),
        .subtitle = spot_diagram_subtitle_of(drawing),
        .x_label = focus                            ? "defocus (mm)"
                   : drawing->all[0].place.is_angle ? "field (deg)"
                                                    : "field (mm)",
        .y_label =
            arena_printf(drawing->arena, "RMS radius (%s)", spot_diagram_unit_words(drawing)),
        .x = x,
        .count = count,
        .series = series,
        .series_count = curves,
    };
    return plot_draw(&plot, svg, error);
}

/* Every spot of the sweep. */
static bool spot_diagram_collect(const struct artifact_job *job, bool with_points,
                                 struct spot_drawing *drawing, struct error *error)
{
    static const struct analysis_answers answers = {.answer = spot_diagram_add};
    drawing->with_points = with_points;
    drawing->count = 0;
    for (size_t i = 0; i < job->count; i++) {
        drawing->input = job->inputs[i];
        if (!analysis_each_field(&drawing->input->question, &spot_policy, job->run, &answers,
                                 drawing, error)) {
            return false;
        }
    }
    return drawing->count > 0 || fail(error, ERROR_DOMAIN, "there is no spot to draw");
}

bool spot_diagram(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct spot_drawing drawing = {.run = job->run, .arena = svg.arena, .airy = NAN};
    if (!spot_diagram_collect(job, job->count <= MOST_ROWS * MOST_COLUMNS, &drawing, error)) {
        return false;
    }
    const struct spot_diagram_grid grid = grid_of(&drawing);
    bool drawn = grid.row_count <= MOST_ROWS && grid.column_count <= MOST_COLUMNS
                     ? spot_diagram_draw_spots(&drawing, &grid, &svg, error)
                     : spot_diagram_draw_curves(&drawing, &grid, &svg, error);
    return drawn && drawing_write(job, &svg, sink, error);
}
