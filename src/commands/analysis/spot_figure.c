/* commands/analysis/spot_figure.c - spots drawn: by field, through focus, and as curves. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/spot_figure.h"

#include "draw/panels.h"
#include "draw/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const struct analysis_policy spot_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool spot_question_of(const struct analysis_case *one, size_t field, const struct spot_input *input,
                      struct spot_question *question, struct error *error)
{
    const struct analysis_question *asked = &input->question;
    const size_t surfaces = one->setup->lens->surface_count;
    *question = (struct spot_question){
        .bundle = analysis_bundle(one, field),
        .rays = asked->rays != NO_INTEGER && asked->rays > 0 ? (size_t)asked->rays : 0,
        .error = asked->error,
        .to = input->to > 0 ? (size_t)input->to : 0,
        .about_chief = input->reference == SPOT_ABOUT_CHIEF,
        .energy = input->energy};
    return question->to <= surfaces ||
           fail(error, ERROR_USAGE, "{--to} %ld: the lens has %zu surfaces", input->to, surfaces);
}

/* Rays of a wavelength in one spot, and about how many on a page. */
enum { MOST_ROWS = 12, MOST_COLUMNS = 9, RAYS_LEAST = 217, RAYS_MOST = 1500, RAYS_OF_PAGE = 60000 };

/* A spot of the drawing. */
struct drawn {
    const struct analysis_case *one;
    const struct spot_input *input;
    size_t field_index;
    const char *title, *name;    /* of the lens; what it was asked for by */
    const char *words;           /* of the case, but for its defocus */
    const char *field;           /* in words */
    bool is_angle;               /* the field, else a height */
    double field_value, defocus; /* as shown; NaN = none */
    double rms;                  /* um or mrad */
    double clear;                /* share of the pupil; NaN: no ray arrives */
    size_t group, place;         /* lens or case it is of; which of its fields */
};

struct spot_drawing {
    struct run *run;
    struct arena *arena;
    const struct spot_input *input;
    struct drawn *all;
    size_t count, room;
    size_t *groups; /* the first spot of each lens and case */
    size_t group_count;
    double airy; /* radius of the largest Airy disc, um or mrad; NaN = not known */
    bool is_angular, is_footprint;
    double *wavelengths; /* of the keys, ascending, um */
    size_t wavelength_count;
};

static const struct unit *spot_diagram_unit(const struct spot_drawing *drawing)
{
    if (drawing->is_angular) {
        return unit_find(&dimension_angle, text_of("mrad"));
    }
    return unit_find(&dimension_length, text_of(drawing->is_footprint ? "mm" : "um"));
}

static const char *diagram_unit_words(const struct spot_drawing *drawing)
{
    if (drawing->is_angular) {
        return "mrad";
    }
    return drawing->is_footprint ? "mm" : "\xc2\xb5m";
}

/* Where a spot stands in the drawing. */
static struct drawn spot_diagram_place(const struct analysis_case *one, size_t field,
                                       struct arena *arena)
{
    const struct field_point *at = &one->setup->fields[field].point;
    const bool beside = fabs(at->value[0]) > fabs(at->value[1]);
    const bool angle = at->kind == FIELD_ANGLE;
    /* no legend says it of one */
    const unsigned colour = one->setup->wavelength_count == 1 ? FIGURE_WAVELENGTHS : 0;
    struct drawn drawn = {.one = one,
                          .field_index = field,
                          .title = one->setup->lens->title,
                          .name = one->question->lens.name,
                          .field = analysis_place_words(at, arena),
                          .field_value = at->value[beside ? 0 : 1],
                          .is_angle = angle || at->kind == FIELD_NONE,
                          .defocus = one->question->defocus,
                          .rms = NAN,
                          .clear = NAN};
    drawn.words = analysis_figure_words(one, FIGURE_APERTURE | FIGURE_PLANE | colour, arena);
    if (angle) {
        drawn.field_value =
            unit_from_own(unit_find(&dimension_angle, text_of("deg")), drawn.field_value);
    }
    return drawn;
}

static bool same_defocus(const struct drawn *a, const struct drawn *b)
{
    return !(fabs(a->defocus - b->defocus) > 0);
}

static bool spot_same_lens(const struct drawn *a, const struct drawn *b)
{
    const bool same_name =
        a->name == b->name || (a->name != NULL && b->name != NULL && strcmp(a->name, b->name) == 0);
    return same_name && strcmp(a->title, b->title) == 0;
}

/* The lens and case a spot is of, and its place among the fields of that. */
static void spot_diagram_group(struct spot_drawing *drawing, struct drawn *drawn)
{
    size_t group = 0;
    for (; group < drawing->group_count; group++) {
        const struct drawn *first = &drawing->all[drawing->groups[group]];
        if (spot_same_lens(first, drawn) && strcmp(first->words, drawn->words) == 0) {
            break;
        }
    }
    drawn->group = group;
    if (group == drawing->group_count) {
        drawing->groups[drawing->group_count++] = (size_t)(drawn - drawing->all);
        return;
    }
    for (const struct drawn *other = drawing->all; other < drawn; other++) {
        if (other->group == group && strcmp(other->field, drawn->field) == 0) {
            drawn->place = other->place;
            return;
        }
        drawn->place +=
            other->group == group && same_defocus(other, &drawing->all[drawing->groups[group]]);
    }
}

/* The wavelengths of a spot among those of the legend, violet first. */
static void spot_diagram_add_keys(struct spot_drawing *drawing, const struct setup *setup)
{
    const size_t most = drawing->wavelength_count + setup->wavelength_count;
    double *list = ARENA_ARRAY(drawing->arena, most, double);
    size_t count = drawing->wavelength_count;
    for (size_t i = 0; i < count; i++) {
        list[i] = drawing->wavelengths[i];
    }
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        size_t i = 0;
        while (i < count && fabs(list[i] - setup->wavelengths[g].wavelength) > 0) {
            i++;
        }
        list[i] = setup->wavelengths[g].wavelength;
        count += i == count;
    }
    qsort(list, count, sizeof *list, analysis_ascending);
    drawing->wavelengths = list;
    drawing->wavelength_count = count;
}

static bool spot_add(struct spot_drawing *drawing, struct analysis_cursor *at, struct error *error)
{
    const struct analysis_case *one = at->one;
    const struct setup *setup = one->setup;
    struct spot_question question;
    struct spot spot;
    if (!spot_question_of(one, at->field, drawing->input, &question, error)) {
        return false;
    }
    drawing->all = arena_grow(drawing->arena, drawing->all, drawing->count, &drawing->room,
                              sizeof *drawing->all);
    struct drawn *drawn = &drawing->all[drawing->count++];
    *drawn = spot_diagram_place(one, at->field, drawing->arena);
    drawn->input = drawing->input;
    question.energy = NAN;
    question.no_radius = true;
    if (!spot_find(&question, drawing->arena, &spot, error)) {
        return analysis_keep_lost(at, error);
    }
    drawing->is_angular = spot.is_angular;
    drawing->is_footprint = question.to > 0;
    if (question.to == 0) { /* the Airy disc of the working f-number, primary wavelength, axis */
        const double disc = 1.21967 * (setup->wavelengths[0].wavelength / 1000);
        const double airy = spot.is_angular ? disc / fabs(setup->first.exit_diameter)
                                            : disc * fabs(setup->first.working_fnumber);
        drawing->airy = fmax(drawing->airy, airy);
    }
    drawn->rms = unit_from_own(spot_diagram_unit(drawing), spot.rms);
    drawn->clear = spot.clear;
    spot_diagram_add_keys(drawing, setup);
    return true;
}

/* Rays of a wavelength of a spot: as many as were asked for, else by the room on the page. */
static size_t spot_diagram_rays(const struct spot_drawing *drawing, const struct drawn *drawn)
{
    const double least_clear = 0.02;
    if (drawn->input->question.rays > 0) {
        return (size_t)drawn->input->question.rays;
    }
    const double series = (double)(drawing->count * drawing->wavelength_count);
    const double rays = fmin(fmax(RAYS_OF_PAGE / series, RAYS_LEAST), RAYS_MOST);
    return (size_t)(rays / fmax(drawn->clear, least_clear));
}

/* The panel of a spot: its points, a series a wavelength. */
static bool spot_diagram_panel(const struct spot_drawing *drawing, const struct drawn *drawn,
                               struct panel *panel, struct error *error)
{
    const struct unit *unit = spot_diagram_unit(drawing);
    const struct setup *setup = drawn->one->setup;
    struct arena *arena = drawing->arena;
    struct spot_question question;
    *panel = (struct panel){.note = "no rays"};
    if (isnan(drawn->clear)) {
        return true;
    }
    if (!spot_question_of(drawn->one, drawn->field_index, drawn->input, &question, error)) {
        return false;
    }
    struct spot_question even = question;
    struct panel_series *series = ARENA_ARRAY(arena, setup->wavelength_count, struct panel_series);
    const size_t rays = spot_diagram_rays(drawing, drawn);
    even.bundle.pattern =
        question.bundle.pattern == PATTERN_GAUSS ? PATTERN_SOBOL : question.bundle.pattern;
    even.bundle.weight = WEIGHT_PUPIL;
    panel->series = series;
    panel->note = ARENA_JOIN(arena, "RMS ", analysis_number(drawn->rms, arena), " ",
                             diagram_unit_words(drawing));
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        struct spot_points points;
        struct error ignored;
        /* without a chief ray there is no pattern: Gauss's points then */
        if (!spot_points_find(&even, g, rays, arena, &points, &ignored) &&
            !spot_points_find(&question, g, rays, arena, &points, &ignored)) {
            continue;
        }
        double *x = ARENA_ARRAY(arena, points.count, double);
        double *y = ARENA_ARRAY(arena, points.count, double);
        for (size_t i = 0; i < points.count; i++) {
            x[i] = unit_from_own(unit, points.at[i][0]);
            y[i] = unit_from_own(unit, points.at[i][1]);
        }
        size_t key = 0;
        while (key + 1 < drawing->wavelength_count &&
               drawing->wavelengths[key] < setup->wavelengths[g].wavelength) {
            key++;
        }
        series[panel->count++] =
            (struct panel_series){.x = x, .y = y, .count = points.count, .key = key, .spots = true};
    }
    return true;
}

/*
 * Rows and columns: through focus a row is a field of a lens and a column a defocus, else a row is
 * a lens, or where there is only one as many fields as have room.
 */
struct spot_diagram_grid {
    size_t rows, columns;
    size_t *row, *column; /* of each spot */
    bool focus;
};

/* The place of a spot among those that come before it and differ as rows or as columns do. */
static size_t spot_diagram_line(const struct spot_drawing *drawing, size_t spot, bool by_field,
                                const size_t *lines)
{
    const struct drawn *here = &drawing->all[spot];
    size_t next = 0;
    for (size_t i = 0; i < spot; i++) {
        const struct drawn *other = &drawing->all[i];
        const bool same = by_field ? other->group == here->group && other->place == here->place
                                   : same_defocus(other, here);
        if (same) {
            return lines[i];
        }
        next = lines[i] + 1 > next ? lines[i] + 1 : next;
    }
    return next;
}

static void spot_diagram_arrange(const struct spot_drawing *drawing, struct spot_diagram_grid *grid)
{
    const size_t count = drawing->count;
    size_t fields = 0;
    *grid = (struct spot_diagram_grid){.row = ARENA_ARRAY(drawing->arena, count, size_t),
                                       .column = ARENA_ARRAY(drawing->arena, count, size_t)};
    for (size_t i = 0; i < count; i++) {
        grid->row[i] = spot_diagram_line(drawing, i, true, grid->row);
        grid->column[i] = spot_diagram_line(drawing, i, false, grid->column);
        grid->rows = grid->row[i] + 1 > grid->rows ? grid->row[i] + 1 : grid->rows;
        grid->columns = grid->column[i] + 1 > grid->columns ? grid->column[i] + 1 : grid->columns;
        fields = drawing->all[i].place + 1 > fields ? drawing->all[i].place + 1 : fields;
    }
    grid->focus = grid->columns > 1;
    if (grid->focus) {
        return;
    }
    const bool one = drawing->group_count == 1;
    if (one && fields > MOST_ROWS) {
        return; /* too many */
    }
    grid->columns = one && fields > 3 ? 3 : fields;
    grid->rows = one ? (fields + grid->columns - 1) / grid->columns : drawing->group_count;
    for (size_t i = 0; i < count; i++) {
        const struct drawn *drawn = &drawing->all[i];
        grid->row[i] = one ? drawn->place / grid->columns : drawn->group;
        grid->column[i] = one ? drawn->place % grid->columns : drawn->place;
    }
}

static const char *spot_diagram_title(const struct spot_drawing *drawing, const char *what,
                                      const char *how)
{
    const char *first = drawing->all[0].title;
    for (size_t i = 1; i < drawing->group_count; i++) {
        if (strcmp(drawing->all[drawing->groups[i]].title, first) != 0) {
            return ARENA_JOIN(drawing->arena, what, how);
        }
    }
    return ARENA_JOIN(drawing->arena, what, " of ", first, how);
}

/* What a group is called above its row: its lens where they differ, and its case. */
static const char *spot_diagram_caption(const struct spot_drawing *drawing,
                                        const struct drawn *drawn)
{
    bool one_lens = true, one_title = true;
    for (size_t i = 1; i < drawing->group_count; i++) {
        const struct drawn *first = &drawing->all[0], *other = &drawing->all[drawing->groups[i]];
        one_lens = one_lens && spot_same_lens(first, other);
        one_title = one_title && strcmp(first->title, other->title) == 0;
    }
    const char *name = one_title && drawn->name != NULL ? drawn->name : drawn->title;
    return one_lens ? drawn->words : ARENA_JOIN(drawing->arena, name, ": ", drawn->words);
}

static const char *spot_diagram_subtitle_of(const struct spot_drawing *drawing)
{
    const struct drawn *first = &drawing->all[0];
    if (drawing->group_count > 1) {
        return NULL;
    }
    if (drawing->input->to > 0) {
        return arena_printf(drawing->arena, "footprint on surface %ld; %s", drawing->input->to,
                            analysis_figure_words(first->one, FIGURE_APERTURE, drawing->arena));
    }
    return first->words;
}

/* A grid of spots. */
static bool spot_diagram_draw_spots(const struct spot_drawing *drawing,
                                    const struct spot_diagram_grid *grid, struct svg *svg,
                                    struct error *error)
{
    struct arena *arena = drawing->arena;
    const size_t count = grid->rows * grid->columns;
    const bool several = drawing->group_count > 1;
    /* Airy discs of several lenses differ, and one that is much smaller than the spots is a dot */
    const double airy = several || !isfinite(drawing->airy)
                            ? 0
                            : unit_from_own(spot_diagram_unit(drawing), drawing->airy);
    double largest = 0;
    struct panel *list = ARENA_ARRAY(arena, count, struct panel);
    const char **heads = ARENA_ARRAY(arena, grid->columns, const char *);
    const char **fields = ARENA_ARRAY(arena, grid->rows, const char *);
    const char **captions = ARENA_ARRAY(arena, grid->rows, const char *);
    const char **keys = ARENA_ARRAY(arena, drawing->wavelength_count + 1, const char *);
    for (size_t i = 0; i < count; i++) {
        list[i] = (struct panel){.is_absent = true};
    }
    for (size_t i = 0; i < drawing->count; i++) {
        const struct drawn *drawn = &drawing->all[i];
        struct panel *panel = &list[grid->row[i] * grid->columns + grid->column[i]];
        if (!spot_diagram_panel(drawing, drawn, panel, error)) {
            return false;
        }
        largest = fmax(largest, drawn->rms); /* of NaN the other */
        panel->title = grid->focus ? NULL : drawn->field;
        heads[grid->column[i]] =
            fabs(drawn->defocus) > 0 ? arena_printf(arena, "%+.4g mm", drawn->defocus) : "0 mm";
        fields[grid->row[i]] = drawn->field;
        captions[grid->row[i]] = spot_diagram_caption(drawing, drawn);
    }
    const bool has_airy = airy > largest / 30;
    for (size_t i = 0; i < count; i++) {
        list[i].circle = has_airy ? airy : 0;
    }
    for (size_t i = 0; i < drawing->wavelength_count; i++) {
        keys[i] = arena_printf(arena, "%.4g nm", 1000 * drawing->wavelengths[i]);
    }
    const struct panels panels = {
        .title = spot_diagram_title(drawing, drawing->input->to > 0 ? "Footprints" : "Spots",
                                    grid->focus ? " through focus" : ""),
        .subtitle = spot_diagram_subtitle_of(drawing),
        .unit = diagram_unit_words(drawing),
        .column_heads = grid->focus ? heads : NULL,
        .row_heads = grid->focus ? fields : NULL,
        .row_captions = several ? captions : NULL,
        .keys = drawing->wavelength_count > 1 ? keys : NULL,
        .key_count = drawing->wavelength_count,
        .light = true,
        .circle_label = has_airy ? "Airy disc on the axis" : NULL,
        .columns = grid->columns,
        .panels = list,
        .count = count,
    };
    return panels_draw(&panels, svg, error);
}

/* The RMS radius against the defocus, a curve a field; or against the field, a curve a lens. */
static bool spot_diagram_draw_curves(const struct spot_drawing *drawing,
                                     const struct spot_diagram_grid *grid, struct svg *svg,
                                     struct error *error)
{
    struct arena *arena = drawing->arena;
    const size_t count = drawing->count, curves = grid->focus ? grid->rows : drawing->group_count;
    const bool several = drawing->group_count > 1;
    const char *field_label = drawing->all[0].is_angle ? "field (deg)" : "field (mm)";
    double *room = ARENA_ARRAY(arena, 2 * count, double);
    struct plot_series *series = ARENA_ARRAY(arena, curves, struct plot_series);
    for (size_t k = 0; k < curves; k++) {
        double *x = room, *y = room + count;
        size_t points = 0;
        const char *label = NULL;
        for (size_t i = 0; i < count; i++) {
            const struct drawn *drawn = &drawing->all[i];
            if ((grid->focus ? grid->row[i] : drawn->group) == k) {
                const char *caption = spot_diagram_caption(drawing, drawn);
                x[points] = grid->focus ? drawn->defocus : drawn->field_value;
                y[points++] = drawn->rms;
                label = several ? caption : NULL;
                if (grid->focus) {
                    label = several ? ARENA_JOIN(arena, drawn->field, ", ", caption) : drawn->field;
                }
            }
        }
        room = ARENA_ARRAY(arena, 2 * count, double);
        series[k] =
            (struct plot_series){.label = label, .x = x, .y = y, .count = points, .style = k};
    }
    const struct plot plot = {
        .title = spot_diagram_title(drawing, "Spots", grid->focus ? " through focus" : ""),
        .subtitle = spot_diagram_subtitle_of(drawing),
        .x_label = grid->focus ? "defocus (mm)" : field_label,
        .y_label = arena_printf(drawing->arena, "RMS radius (%s)", diagram_unit_words(drawing)),
        .series = series,
        .series_count = curves,
    };
    return plot_draw(&plot, svg, error);
}

bool spot_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct spot_drawing drawing = {.run = job->run, .arena = svg.arena, .airy = NAN};
    for (size_t i = 0; i < job->count; i++) {
        drawing.input = job->inputs[i];
        struct analysis_cursor at = analysis_begin(drawing.input, &spot_policy, job->run);
        at.keeps_lost = true;
        while (analysis_next(&at, error)) {
            if (!spot_add(&drawing, &at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    if (drawing.count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no spot to draw");
    }
    struct spot_diagram_grid grid;
    drawing.groups = ARENA_ARRAY(drawing.arena, drawing.count, size_t);
    for (size_t i = 0; i < drawing.count; i++) {
        spot_diagram_group(&drawing, &drawing.all[i]);
    }
    spot_diagram_arrange(&drawing, &grid);
    bool drawn = grid.rows <= MOST_ROWS && grid.columns <= MOST_COLUMNS
                     ? spot_diagram_draw_spots(&drawing, &grid, &svg, error)
                     : spot_diagram_draw_curves(&drawing, &grid, &svg, error);
    return drawn && drawing_write(job, &svg, sink, error);
}
