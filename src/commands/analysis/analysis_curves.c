/* commands/analysis/analysis_curves.c - columns drawn against field, focus or wavelength. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_curves.h"

#include "commands/analysis/figure_captions.h"
#include "draw/plot.h"
#include "report/report.h"

#include <stdlib.h>
#include <string.h>

enum { CURVES_MOST = 14 };

/* A value of a column, on one of the curves of that. */
struct curve_point {
    size_t caption, column;
    double x, y;
};

/* What is drawn, and against what: CAPTION_FIELD, CAPTION_DEFOCUS or CAPTION_WAVELENGTHS. */
struct curve_drawing {
    const struct analysis_curves *curves;
    struct arena *arena;
    struct shown *columns;
    size_t column_count;
    enum caption_part axis;
    struct captions captions;
    struct curve_point *points;
    size_t count, room;
    bool is_angle; /* fields are */
    char *row;
};

static int curve_point_order(const void *first, const void *second)
{
    const struct curve_point *a = first, *b = second;
    if (a->column != b->column || a->caption != b->caption) {
        return a->column != b->column ? (a->column > b->column) - (a->column < b->column)
                                      : (a->caption > b->caption) - (a->caption < b->caption);
    }
    return (a->x > b->x) - (a->x < b->x);
}

/* "waves", "mm"; empty: plain numbers. */
static const char *curve_unit(const struct shown *shown)
{
    const char *of_waves = strstr(shown->column->name, "_waves");
    if (shown->unit != NULL) {
        return shown->unit->label;
    }
    return of_waves != NULL && strcmp(of_waves, "_waves") == 0 ? "waves" : "";
}

/* "RMS": the label without its unit. */
static const char *curve_name(const struct shown *shown, struct arena *arena)
{
    const char *label = column_label(shown->column), *end = strstr(label, ", waves");
    return end != NULL ? arena_string(arena, label, (size_t)(end - label)) : label;
}

/* The columns that are named, or the usual ones. */
static bool curve_columns_choose(struct curve_drawing *drawing, const struct artifact_job *job,
                                 struct error *error)
{
    const struct report *report = job->report;
    const size_t room = drawing->curves->sheet->column_count;
    drawing->columns = ARENA_ARRAY(drawing->arena, room, struct shown);
    for (size_t i = 0; report->are_named && i < report->shown_count; i++) {
        const struct column *column = report->shown[i].column;
        if (column->type == COLUMN_NUMBER && (column->flags & COLUMN_ECHO) == 0) {
            drawing->columns[drawing->column_count++] = report->shown[i];
        }
    }
    for (size_t i = 0; !report->are_named && i < room; i++) {
        const struct column *column = &drawing->curves->sheet->columns[i];
        if (drawing->curves->is_usual(column)) {
            struct shown *shown = &drawing->columns[drawing->column_count++];
            *shown = (struct shown){.column = column, .name = column->name};
        }
    }
    if (drawing->column_count == 0) {
        return fail(error, ERROR_USAGE, "{--curve}: none of the {--columns} is a result to draw");
    }
    for (size_t k = 1; k < drawing->column_count; k++) {
        if (strcmp(curve_unit(&drawing->columns[k]), curve_unit(&drawing->columns[0])) != 0) {
            return fail(error, ERROR_USAGE, "{--curve}: columns %s and %s have different units",
                        drawing->columns[0].name, drawing->columns[k].name);
        }
    }
    return true;
}

#define VALUES(member) ANALYSIS_VALUES_OF(job, struct analysis_input, question.member)

static bool curve_axis_choose(struct curve_drawing *drawing, const struct artifact_job *job,
                              struct error *error)
{
    const size_t fields = VALUES(field) * VALUES(height), focus = VALUES(defocus);
    const size_t waves = VALUES(wavelength.wavelength);
    if (VALUES(field_x) * VALUES(height_x) > 1) {
        return fail(error, ERROR_USAGE, "{--curve} goes along one section: not along fields x");
    }
    drawing->axis = CAPTION_FIELD;
    if (focus > 1 && focus >= waves && focus >= fields) {
        drawing->axis = CAPTION_DEFOCUS;
    } else if (waves > 1 && waves >= fields) {
        drawing->axis = CAPTION_WAVELENGTHS;
    }
    drawing->captions.leaves_out[drawing->axis] = true;
    return true;
}

/* The row of a field: a point on the curve of each column that has a value. */
static void curve_points_add(struct curve_drawing *drawing, const struct analysis_cursor *at)
{
    const struct analysis_curves *curves = drawing->curves;
    const struct analysis_point point = analysis_point_of(at->one, at->field);
    const char *kind = curves->kind != NULL ? curves->kind(at) : NULL;
    const size_t caption = captions_add(&drawing->captions, at->one, at->field, kind);
    double x = point.defocus;
    drawing->is_angle = !isnan(point.field);
    if (drawing->axis == CAPTION_FIELD) {
        x = drawing->is_angle ? degrees_from_radians(point.field) : point.height;
    } else if (drawing->axis == CAPTION_WAVELENGTHS) {
        x = 1000 * at->one->setup->wavelengths[0].wavelength;
    }
    curves->fill_row(at, drawing->row);
    for (size_t k = 0; k < drawing->column_count; k++) {
        const struct shown *shown = &drawing->columns[k];
        const double own = row_number(drawing->row, shown->column);
        const double y = shown->unit != NULL ? unit_from_own(shown->unit, own) : own;
        if (isfinite(y)) {
            drawing->points = arena_grow(drawing->arena, drawing->points, drawing->count,
                                         &drawing->room, sizeof *drawing->points);
            drawing->points[drawing->count++] = (struct curve_point){caption, k, x, y};
        }
    }
}

/* "c9, 14°": what tells a curve from the others; null: nothing does. */
static const char *curve_label(const struct curve_drawing *drawing, const struct curve_point *point)
{
    const char *setting = captions_label(&drawing->captions, point->caption);
    if (drawing->column_count == 1) {
        return setting;
    }
    const char *name = curve_name(&drawing->columns[point->column], drawing->arena);
    return setting != NULL ? ARENA_JOIN(drawing->arena, name, ", ", setting) : name;
}

/* The points as curves; false: several have one place, or no curve has two. */
static bool curve_series_put(const struct curve_drawing *drawing, struct plot_series *series,
                             size_t *count, struct error *error)
{
    double *x = ARENA_ARRAY(drawing->arena, 2 * drawing->count, double), *y = x + drawing->count;
    bool is_line = false;
    *count = 0;
    qsort(drawing->points, drawing->count, sizeof *drawing->points, curve_point_order);
    for (size_t i = 0; i < drawing->count; i++) {
        const struct curve_point *point = &drawing->points[i];
        const bool begins =
            i == 0 || point[-1].column != point->column || point[-1].caption != point->caption;
        x[i] = point->x;
        y[i] = point->y;
        if (begins && *count == CURVES_MOST) {
            fail(error, ERROR_USAGE, "{--curve} would draw more than %d curves", CURVES_MOST);
            return drawing->column_count > 1 && error_hint(error, "choose some with {--columns}");
        }
        if (begins) {
            series[*count] = (struct plot_series){
                .label = curve_label(drawing, point), .x = &x[i], .y = &y[i], .style = *count};
            (*count)++;
        } else if (!(point->x > point[-1].x)) {
            return fail(error, ERROR_USAGE,
                        "{--curve}: several values at one place, which no label tells apart");
        }
        series[*count - 1].count++;
        is_line = is_line || !begins;
    }
    if (drawing->count == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw");
    }
    return is_line || fail(error, ERROR_USAGE,
                           "{--curve} needs an option with several values, such as a range");
}

/* "RMS wave front"; of several columns what the command calls them. */
static const char *curve_title(const struct curve_drawing *drawing)
{
    const struct analysis_curves *curves = drawing->curves;
    const struct shown *first = &drawing->columns[0];
    if (drawing->column_count > 1) {
        return curves->title;
    }
    for (const struct curve_title *title = curves->titles; title->column != NULL; title++) {
        if (strcmp(title->column, first->column->name) == 0) {
            return title->title;
        }
    }
    return curve_name(first, drawing->arena);
}

static bool curves_write(const struct curve_drawing *drawing, const struct artifact_job *job,
                         struct output *sink, struct error *error)
{
    struct svg svg = {.arena = drawing->arena};
    struct plot_series series[CURVES_MOST];
    size_t count;
    if (!curve_series_put(drawing, series, &count, error)) {
        return false;
    }
    const char *const axes[CAPTION_PARTS] = {
        [CAPTION_FIELD] = drawing->is_angle ? "field (\xc2\xb0)" : "field (mm)",
        [CAPTION_DEFOCUS] = "defocus (mm)",
        [CAPTION_WAVELENGTHS] = "wavelength (nm)"};
    const char *unit = curve_unit(&drawing->columns[0]);
    const char *name = drawing->column_count == 1 ? curve_name(&drawing->columns[0], drawing->arena)
                                                  : drawing->curves->title;
    const struct plot plot = {
        .title = captions_title(&drawing->captions, curve_title(drawing)),
        .subtitle = captions_subtitle(&drawing->captions),
        .x_label = axes[drawing->axis],
        .y_label = unit[0] != '\0' ? ARENA_JOIN(drawing->arena, name, " (", unit, ")") : name,
        .is_share = strncmp(drawing->columns[0].column->name, "strehl", 6) == 0,
        .series = series,
        .series_count = count};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}

bool analysis_curves_draw(const struct analysis_curves *curves, const struct artifact_job *job,
                          struct output *sink, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct curve_drawing drawing = {.curves = curves,
                                    .arena = arena,
                                    .captions = {.arena = arena},
                                    .row = arena_array(arena, 1, curves->sheet->row_size)};
    if (!curve_columns_choose(&drawing, job, error) || !curve_axis_choose(&drawing, job, error)) {
        return false;
    }
    /* what no curve shows need not be found */
    const struct report drawn = {.shown = drawing.columns, .shown_count = drawing.column_count};
    struct run run = *job->run;
    run.report = &drawn;
    for (size_t i = 0; i < job->count; i++) {
        struct analysis_cursor at = analysis_begin_finding(job->inputs[i], curves->policy, &run,
                                                           curves->find, curves->found_size);
        at.keeps_lost = true;
        while (analysis_next(&at, error)) {
            if (at.lost == NULL) {
                curve_points_add(&drawing, &at);
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return curves_write(&drawing, job, sink, error);
}
