/* commands/analysis/cmd_spot.c - lenscalc spot: spots of a field's rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot.h"
#include "commands/analysis/analysis_cursor.h"
#include "draw/panels.h"
#include "draw/plot.h"

#include <math.h>
#include <stdlib.h>

enum { SPOT_ABOUT_CENTROID, SPOT_ABOUT_CHIEF };

struct spot_input {
    struct analysis_question question;
    int reference;
    double energy;
    long to;
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

static const struct word references[] = {
    [SPOT_ABOUT_CENTROID] = {"centroid", "the weighted mean of the rays"},
    [SPOT_ABOUT_CHIEF] = {"chief", "the chief ray"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS("all of the lens by their weights, as one spot",
                     ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct spot_input, question),
    {OPTION(struct spot_input, reference), .name = "reference", .words = references,
     .fallback = "centroid", .value = "POINT",
     .help = "centre from which the largest and the energy radius are measured"},
    {OPTION(struct spot_input, energy), .name = "energy", .column = "energy",
     .dimension = &dimension_ratio, .unit = "%", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST, .value = "SHARE",
     .help = "radius that encloses this fraction of the light: 80%"},
    {OPTION(struct spot_input, to), .name = "to", .lowest = 1, .highest = 1e6, .value = "SURFACE",
     .excludes = "focus defocus",
     .help = "the footprint on this surface, in place of the image; counted from 1, stop included"},
    ANALYSIS_PUPIL_OPTIONS,
};

struct spot_row {
    struct analysis_point point;
    struct spot spot;
    double energy;
    long rays;
    const char *weight;
};

static const struct column_form sines = {&dimension_angle, "mrad",
                                         "of an image at infinity: sines of angles from the chief "
                                         "ray"};

#define SMALL(member_name, more)                                                                   \
    COLUMN_OR(struct spot_row, spot.member_name, spot.is_angular, &sines),                         \
        .dimension = &dimension_length, .unit = "um", .flags = (more)
#define PLACE(member_name, more)                                                                   \
    COLUMN_OF_LENGTH(struct spot_row, member_name, "mm"), .flags = (more)

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {SMALL(rms, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rms", .label = "RMS radius",
     .help = "root mean square distance from the centroid"},
    {SMALL(rms_x, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rms_x", .label = "RMS in x",
     .help = "the same in x alone"},
    {SMALL(rms_y, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rms_y", .label = "RMS in y",
     .help = "the same in y alone"},
    {SMALL(rms_chief, COLUMN_SPARSE), .name = "rms_chief", .label = "RMS about the chief ray",
     .help = "root mean square distance from the chief ray (of the primary wavelength, if "
             "several); absent where that ray is lost"},
    {SMALL(radius, COLUMN_BRIEF | COLUMN_SPARSE), .name = "radius", .label = "largest radius",
     .help = "largest distance of a ray of the clear pupil, edge included, from the centroid or "
             "the --reference"},
    {SMALL(radius_error, COLUMN_HIDDEN), .name = "radius_error", .label = "error of that",
     .help = "estimated error of the largest radius"},
    {COLUMN(struct spot_row, energy), .name = "energy", .dimension = &dimension_ratio, .unit = "%",
     .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA, .with = "energy", .label = "share",
     .help = "fraction of the light"},
    {SMALL(energy_radius, COLUMN_BRIEF | COLUMN_EXTRA), .with = "energy", .name = "energy_radius",
     .label = "energy radius", .help = "radius that encloses that fraction of the light"},
    {SMALL(energy_error, COLUMN_EXTRA), .with = "energy", .name = "energy_error",
     .label = "error of the energy radius", .help = "estimated error of the energy radius"},
    {SMALL(error, COLUMN_BRIEF | COLUMN_SPARSE), .name = "error",
     .help = "estimated error of the RMS figures: three times the change when the rays are "
             "doubled, four times for a plain pattern"},
    {PLACE(spot.centroid[0], 0), .name = "x", .label = "centroid x",
     .help = "position of the centroid"},
    {PLACE(spot.centroid[1], 0), .name = "y", .label = "centroid y", .help = "the same in y"},
    {PLACE(spot.chief[0], COLUMN_HIDDEN), .name = "chief_x", .label = "chief ray x",
     .help = "where the chief ray meets the plane"},
    {PLACE(spot.chief[1], COLUMN_HIDDEN), .name = "chief_y", .label = "chief ray y",
     .help = "upwards"},
    {COLUMN(struct spot_row, spot.clear), .name = "clear", .label = "clear share",
     .help = "fraction of the pupil's area that is not vignetted"},
    {COLUMN(struct spot_row, rays), .name = "rays", .flags = COLUMN_HIDDEN,
     .help = "of one wavelength"},
    ANALYSIS_SPECTRUM_COLUMN,
    {COLUMN(struct spot_row, weight), .name = "weights", .flags = COLUMN_ASSUMED,
     .depends = "weight aim pattern clip no-clip", .label = "rays weighted by",
     .help = "areas by which rays are weighted"},
    ANALYSIS_TAIL_COLUMNS,
};

/* What aiming leaves of a place on the axis is none. */
static double spot_row_place(double coordinate, double rms)
{
    return fabs(coordinate) < 1e-15 * rms ? 0 : coordinate;
}

/* What is asked of one field of a case. */
static bool spot_question_of(const struct analysis_case *one, size_t field,
                             const struct spot_input *input, struct spot_question *question,
                             struct error *error)
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

static bool spot_row_find(const struct analysis_cursor *at, const struct analysis_case *one,
                          size_t field, void *found, struct error *error)
{
    struct spot_question question;
    if (!spot_question_of(one, field, at->input, &question, error)) {
        return false;
    }
    /* the largest radius takes as long as all the rest */
    question.no_radius = !run_shows(at->run, offsetof(struct spot_row, spot.radius)) &&
                         !run_shows(at->run, offsetof(struct spot_row, spot.radius_error));
    return spot_find(&question, one->setup->arena, found, error);
}

static const struct sheet sheet = SHEET(columns, struct spot_row);

static bool spot_run(const void *data, struct run *run, struct error *error)
{
    const struct spot_input *input = data;
    struct analysis_cursor at =
        analysis_begin_finding(input, &policy, run, spot_row_find, sizeof(struct spot));
    while (analysis_next(&at, error)) {
        const struct spot *spot = at.found;
        struct spot_row row;
        analysis_begin_row(&at, &sheet, &row);
        row.energy = input->energy;
        row.weight = analysis_weight_words(&input->question);
        if (at.lost == NULL) {
            row.spot = *spot;
            row.rays = (long)spot->rays;
            for (int k = 0; k < 2; k++) {
                row.spot.centroid[k] =
                    spot->is_angular ? (double)NAN : spot_row_place(spot->centroid[k], spot->rms);
                row.spot.chief[k] =
                    spot->is_angular ? (double)NAN : spot_row_place(spot->chief[k], spot->rms);
            }
            analysis_warn(&at, &row.point, lens_island_warning(&spot->islands, run->arena));
            if (!(input->question.rays > 0) && !spot->has_converged) {
                analysis_warn(&at, &row.point, "the spot has not converged: see its error");
            }
        }
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the drawing: by field, through focus, and as curves -------- */

enum { MOST_ROWS = 12, MOST_COLUMNS = 9, RAYS = 217 };

/* A spot of the drawing. */
struct drawn {
    const char *field;           /* in words */
    bool is_angle;               /* the field, else a height */
    double field_value, defocus; /* as shown; NaN = none */
    double rms;                  /* um or mrad */
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
    const char *position = one->setup->position;
    struct drawn drawn = {.field = "axis",
                          .field_value = at->value[beside ? 0 : 1],
                          .is_angle = angle || at->kind == FIELD_NONE,
                          .defocus = one->question->defocus,
                          .rms = NAN};
    if (angle) {
        drawn.field_value =
            unit_from_own(unit_find(&dimension_angle, text_of("deg")), drawn.field_value);
    }
    if (at->kind != FIELD_NONE) {
        drawn.field =
            arena_printf(arena, "%.4g%s", drawn.field_value + 0.0, angle ? "\xc2\xb0" : " mm");
    }
    if (position != NULL && one->question->position != NULL) {
        drawn.field = arena_printf(arena, "%s, %s", position, drawn.field);
    }
    return drawn;
}

/* The points of one field, a series a wavelength. */
static void spot_diagram_add_points(struct spot_drawing *drawing, const struct analysis_case *one,
                                    const struct spot_question *question, struct drawn *drawn)
{
    const struct unit *unit = spot_diagram_unit(drawing);
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
        size_t key = 0;
        while (key + 1 < drawing->wavelength_count &&
               drawing->wavelengths[key] < one->setup->wavelengths[g].wavelength) {
            key++;
        }
        series[drawn->panel.count++] =
            (struct panel_series){.x = x, .y = y, .count = points.count, .key = key, .spots = true};
    }
}

static bool spot_add(struct spot_drawing *drawing, struct analysis_cursor *at, struct error *error)
{
    const struct analysis_case *one = at->one;
    const struct setup *setup = one->setup;
    struct spot_question question;
    struct spot spot;
    drawing->title = setup->lens->title;
    drawing->focus = setup->focus;
    if (!spot_question_of(one, at->field, drawing->input, &question, error)) {
        return false;
    }
    drawing->all = arena_grow(drawing->arena, drawing->all, drawing->count, &drawing->room,
                              sizeof *drawing->all);
    struct drawn *drawn = &drawing->all[drawing->count++];
    *drawn = spot_diagram_place(one, at->field, drawing->arena);
    question.energy = NAN;
    question.no_radius = true;
    if (!spot_find(&question, drawing->arena, &spot, error)) {
        drawn->panel.note = "no rays";
        return analysis_keep_lost(at, error);
    }
    drawing->is_angular = spot.is_angular;
    drawing->is_footprint = question.to > 0;
    if (question.to == 0) { /* the Airy disc of the working f-number, primary wavelength, axis */
        const double disc = 1.21967 * (setup->wavelengths[0].wavelength / 1000);
        drawing->airy = spot.is_angular ? disc / fabs(setup->first.exit_diameter)
                                        : disc * fabs(setup->first.working_fnumber);
    }
    drawn->rms = unit_from_own(spot_diagram_unit(drawing), spot.rms);
    drawn->panel.note =
        ARENA_JOIN(drawing->arena, "RMS ", analysis_number(drawn->rms, drawing->arena), " ",
                   diagram_unit_words(drawing));
    if (drawing->with_points) {
        /* Keys in the order of the light, violet first. */
        double *list = ARENA_ARRAY(drawing->arena, setup->wavelength_count, double);
        for (size_t i = 0; i < setup->wavelength_count; i++) {
            list[i] = setup->wavelengths[i].wavelength;
        }
        qsort(list, setup->wavelength_count, sizeof *list, analysis_ascending);
        drawing->wavelengths = list;
        drawing->wavelength_count = setup->wavelength_count;
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

/* The first spot of the same field, or defocus: its place in a list, added if it is new. */
static size_t spot_diagram_line(const struct spot_drawing *drawing, size_t spot, bool by_field,
                                size_t *list, size_t *count)
{
    const struct drawn *here = &drawing->all[spot];
    size_t i = 0;
    for (; i < *count; i++) {
        const struct drawn *first = &drawing->all[list[i]];
        const bool same = by_field ? text_same(text_of(first->field), here->field)
                                   : !(fabs(first->defocus - here->defocus) > 0);
        if (same) {
            return i;
        }
    }
    list[(*count)++] = spot;
    return i;
}

static const char *spot_diagram_subtitle_of(const struct spot_drawing *drawing)
{
    if (drawing->input->to > 0) {
        return arena_printf(drawing->arena, "footprint on surface %ld", drawing->input->to);
    }
    if (drawing->is_angular) {
        return "angles of an afocal image";
    }
    return ARENA_JOIN(drawing->arena, "focus ", drawing->focus != NULL ? drawing->focus : "");
}

/* A grid of spots. */
static bool spot_diagram_draw_spots(const struct spot_drawing *drawing,
                                    const struct spot_diagram_grid *grid, struct svg *svg,
                                    struct error *error)
{
    struct arena *arena = drawing->arena;
    const bool focus = grid->column_count > 1, has_airy = isfinite(drawing->airy);
    const size_t count = grid->row_count * grid->column_count;
    const size_t few = grid->row_count < 4 ? grid->row_count : 3;
    struct panel *list = ARENA_ARRAY(drawing->arena, count, struct panel);
    for (size_t i = 0; i < drawing->count; i++) {
        struct panel *panel = &list[grid->row[i] * grid->column_count + grid->column[i]];
        *panel = drawing->all[i].panel;
        panel->title = focus ? NULL : drawing->all[i].field;
        panel->circle = has_airy ? unit_from_own(spot_diagram_unit(drawing), drawing->airy) : 0;
    }
    const char **heads = ARENA_ARRAY(arena, grid->column_count, const char *);
    const char **fields = ARENA_ARRAY(arena, grid->row_count, const char *);
    const char **keys = ARENA_ARRAY(arena, drawing->wavelength_count + 1, const char *);
    for (size_t i = 0; i < grid->column_count; i++) {
        const double defocus = drawing->all[grid->columns[i]].defocus;
        heads[i] = fabs(defocus) > 0 ? arena_printf(arena, "%+.4g mm", defocus) : "0 mm";
    }
    for (size_t i = 0; i < grid->row_count; i++) {
        fields[i] = drawing->all[grid->rows[i]].field;
    }
    for (size_t i = 0; i < drawing->wavelength_count; i++) {
        keys[i] = arena_printf(arena, "%.4g nm", 1000 * drawing->wavelengths[i]);
    }
    const struct panels panels = {
        .title = arena_printf(drawing->arena, "%s of %s%s",
                              drawing->input->to > 0 ? "Footprints" : "Spots", drawing->title,
                              focus ? " through focus" : ""),
        .subtitle = spot_diagram_subtitle_of(drawing),
        .unit = diagram_unit_words(drawing),
        .column_heads = focus ? heads : NULL,
        .row_heads = focus ? fields : NULL,
        .keys = keys,
        .key_count = drawing->wavelength_count,
        .light = true,
        .circle_label = has_airy ? "Airy disc on the axis" : NULL,
        .columns = focus ? grid->column_count : few,
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
    const char *field_label = drawing->all[0].is_angle ? "field (deg)" : "field (mm)";
    double *x = ARENA_ARRAY(arena, count, double), *y = ARENA_ARRAY(arena, count * curves, double);
    struct plot_series *series = ARENA_ARRAY(arena, curves, struct plot_series);
    for (size_t i = 0; i < count * curves; i++) {
        y[i] = NAN;
    }
    for (size_t k = 0; k < curves; k++) {
        const char *label = focus ? drawing->all[grid->rows[k]].field : NULL;
        series[k] = (struct plot_series){.label = label, .y = y + k * count, .style = k};
    }
    for (size_t i = 0; i < drawing->count; i++) {
        const struct drawn *drawn = &drawing->all[i];
        size_t at = focus ? grid->column[i] : grid->row[i];
        x[at] = focus ? drawn->defocus : drawn->field_value;
        y[(focus ? grid->row[i] : 0) * count + at] = drawing->all[i].rms;
    }
    const struct plot plot = {
        .title = arena_printf(arena, "Spots of %s", drawing->title),
        .subtitle = spot_diagram_subtitle_of(drawing),
        .x_label = focus ? "defocus (mm)" : field_label,
        .y_label = arena_printf(drawing->arena, "RMS radius (%s)", diagram_unit_words(drawing)),
        .x = x,
        .count = count,
        .series = series,
        .series_count = curves,
    };
    return plot_draw(&plot, svg, error);
}

static bool spot_diagram(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct spot_drawing drawing = {.run = job->run, .arena = svg.arena, .airy = NAN};
    /* Every spot of the sweep. */
    drawing.with_points = job->count <= MOST_ROWS * MOST_COLUMNS;
    drawing.count = 0;
    for (size_t i = 0; i < job->count; i++) {
        drawing.input = job->inputs[i];
        struct analysis_cursor at = analysis_begin(drawing.input, &policy, job->run);
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
    size_t count = drawing.count, *room = ARENA_ARRAY(drawing.arena, 4 * count, size_t);
    struct spot_diagram_grid grid = {
        .rows = room, .columns = room + count, .row = room + 2 * count, .column = room + 3 * count};
    for (size_t i = 0; i < count; i++) {
        grid.row[i] = spot_diagram_line(&drawing, i, true, grid.rows, &grid.row_count);
        grid.column[i] = spot_diagram_line(&drawing, i, false, grid.columns, &grid.column_count);
    }
    bool drawn = grid.row_count <= MOST_ROWS && grid.column_count <= MOST_COLUMNS
                     ? spot_diagram_draw_spots(&drawing, &grid, &svg, error)
                     : spot_diagram_draw_curves(&drawing, &grid, &svg, error);
    return drawn && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw the spots, by field and through focus; of many their RMS radius"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = spot_diagram},
};

static const struct explanation explanations[] = {
    {"rms", "square of it = sum w |(x, y) - centroid|^2/sum w over the clear pupil",
     "Gauss points in r^2 between the corners of the pupil, [Forbes88]",
     "light beyond a gap in the pupil is left out, and named where it fills 1/128 of the first "
     "surface across"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"spot double-gauss", "the spots of all fields, all wavelengths together"},
    {"spot double-gauss --field 14deg -w d --defocus -0.2..0.2#5", "one of them through focus"},
    {"spot double-gauss -w d --no-clip --pattern hexapolar --rays 127",
     "as programs print it that only average rays"},
    {"spot double-gauss-50 --energy 50%,80%", "radii that enclose so much of the light"},
    {NULL, NULL},
};

const struct command command_spot = {
    .name = "spot",
    .summary = "spot diagrams: sizes, energy radii, rays on the image plane",
    COMMAND_ASKS(struct spot_input),
    COMMAND_ANSWERS(struct spot_row),
    .run = spot_run,
    .makes_many = analysis_several,
    ANALYSIS_COMMAND,
    .cell = "rms",
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
    .weight = analysis_weight,
};
