/* commands/analysis/cmd_illumination.c - lenscalc illumination: light over the image. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/relative_illumination.h"
#include "commands/analysis/analysis_cursor.h"
#include "draw/plot.h"

#include <string.h>

struct illumination_input {
    struct analysis_question question;
    double stop_diameter; /* mm; NaN = not given */
};

static const struct option options[] = {
    ANALYSIS_OPTIONS(LENS_PRIMARY_WAVELENGTH, ", or the heights of one question"),
    {ANALYSIS_LENGTH(struct illumination_input, question.height), .name = "height",
     .column = "height", .flags = OPTION_NO_INFINITY,
     .help = "a point in the image at this distance from the axis; a list is swept; default: from "
             "the axis in tenths to the image of the largest field"},
    {ANALYSIS_LENGTH(struct illumination_input, question.height_x), .name = "height-x",
     .column = "height_x", .flags = OPTION_NO_INFINITY, .help = "its offset in x"},
    {OPTION(struct illumination_input, question.field), .name = "field", .column = "field",
     .dimension = &dimension_angle, .unit = "deg", .lowest = -PI, .highest = PI,
     .flags = OPTION_FIELD | OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST, .value = "ANGLE",
     .help = "the point that the chief ray of this field reaches; a list is swept"},
    LENS_FIELD_X_OPTION(struct illumination_input, question.field_x),
    {ANALYSIS_LENGTH(struct illumination_input, stop_diameter), .name = "stop-diameter",
     .lowest = 0, .highest = INFINITY, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,
     .column = "stop_diameter", .excludes = "aperture",
     .help = "diameter of the stop, in place of the lens's own aperture"},
    {OPTION(struct illumination_input, question.error), .name = "error", .column = "error_wanted",
     .dimension = &dimension_number, .lowest = 1e-13, .highest = 1, .fallback = "1e-4",
     .value = "NUMBER",
     .help = "rays are doubled until the relative error of the irradiance is below this"},
    ANALYSIS_CLIP_OPTIONS,
};

struct illumination_row {
    struct analysis_point point;
    struct relative_illumination_point at;
    double stop_diameter; /* mm; NaN = that of the lens */
};

#define LENGTH(member_name, more)                                                                  \
    COLUMN_OF_LENGTH(struct illumination_row, member_name, "mm"), .flags = (more)
#define PLAIN(member_name, more) COLUMN(struct illumination_row, member_name), .flags = (more)

static const struct column columns[] = {
    LENS_POSITION_COLUMN(struct illumination_row, point.position, COLUMN_BRIEF),
    {LENGTH(at.height[1], COLUMN_BRIEF | COLUMN_ECHO), .name = "height", .symbol = "h",
     .with = "height", .help = "of the point, in the image plane"},
    {LENGTH(at.height[0], COLUMN_BRIEF | COLUMN_EXTRA), .name = "height_x",
     .with = "height-x field-x", .label = "height x", .help = "the same in x"},
    {COLUMN_OF_ANGLE(struct illumination_row, at.angle, "deg"), .name = "field", .symbol = "t",
     .flags = COLUMN_BRIEF | COLUMN_SPARSE,
     .help = "field angle in object space whose chief ray arrives there; absent where none does"},
    ANALYSIS_WAVELENGTH_COLUMN,
    ANALYSIS_DEFOCUS_COLUMN,
    {LENGTH(stop_diameter, COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA), .name = "stop_diameter",
     .with = "stop-diameter", .label = "stop", .help = "diameter of the stop"},
    {PLAIN(at.light.value, COLUMN_BRIEF), .name = "irradiance_per_radiance", .symbol = "E",
     .label = "E/L", .head = "E/L", .help = "irradiance per radiance of a uniform scene"},
    {PLAIN(at.light.error, COLUMN_BRIEF), .name = "irradiance_error", .label = "error",
     .head = "error", .digits = 2,
     .help = "its estimated error: the change when the rays are doubled"},
    {PLAIN(at.relative_point, COLUMN_BRIEF), .name = "relative_point", .label = "E/E axis",
     .head = "E/E axis", .help = "irradiance of the point over that on the axis"},
    {PLAIN(at.point_error, COLUMN_HIDDEN), .name = "relative_point_error", .digits = 2,
     .label = "error of E/E axis", .help = "its estimated error, from the errors of both"},
    {PLAIN(at.relative_field, COLUMN_BRIEF | COLUMN_SPARSE), .name = "relative_field",
     .label = "by field", .head = "by field",
     .help = "the same from the rays of the object point whose chief ray arrives there, wherever "
             "they meet; absent where none does"},
    {PLAIN(at.field_error, COLUMN_HIDDEN | COLUMN_SPARSE), .name = "relative_field_error",
     .digits = 2, .label = "error by field",
     .help = "its estimated error, from the errors of both"},
    {PLAIN(at.vignetted, COLUMN_BRIEF), .name = "vignetted_fraction", .label = "vignetted",
     .head = "vignetted",
     .help =
         "fraction of the light passed by the stop alone that apertures and obstructions block"},
    {PLAIN(at.vignetted_error, COLUMN_HIDDEN), .name = "vignetted_error", .digits = 2,
     .label = "error of vignetted",
     .help = "its estimated error; a fraction below its error is given as 0"},
    {PLAIN(at.cos4, 0), .name = "cos4", .label = "cos^4",
     .help = "fourth power of the cosine of the field angle, for comparison"},
    ANALYSIS_TAIL_COLUMNS,
};

/* -------- points of the image -------- */

/* Of the height of a drawing: what nobody sees in it. */
static const double unseen = 5e-4;

/* run: whose rows are all that is wanted; null: what a drawing shows. */
static bool open_falloff(const struct analysis_case *one, const struct illumination_input *input,
                         const struct run *run, struct relative_illumination *falloff,
                         struct error *error)
{
    const bool no_field = run != NULL &&
                          !run_shows(run, offsetof(struct illumination_row, at.relative_field)) &&
                          !run_shows(run, offsetof(struct illumination_row, at.field_error));
    const bool no_vignetting =
        run != NULL && !run_shows(run, offsetof(struct illumination_row, at.vignetted)) &&
        !run_shows(run, offsetof(struct illumination_row, at.vignetted_error));
    const struct relative_illumination_question question = {
        .setup = one->setup,
        .no_field = no_field,
        .no_vignetting = no_vignetting,
        .no_islands = run == NULL,
        .stop_diameter = input->stop_diameter,
        .error = run == NULL ? fmax(input->question.error, unseen) : input->question.error,
        .clip = one->clip};
    return relative_illumination_open(&question, falloff, error);
}

static bool asks_height(const struct illumination_input *input)
{
    return !isnan(input->question.height) || !isnan(input->question.height_x);
}

static bool asks_point(const struct illumination_input *input)
{
    return asks_height(input) || !isnan(input->question.field) || !isnan(input->question.field_x);
}

/* The last point. */
struct last_point {
    double height[2]; /* x, y, mm */
    double share;     /* of the largest field; 1 where a point is asked for */
};

/* Where the chief ray of the largest field comes to, or of the largest that has one. */
static bool illumination_find_edge(const struct relative_illumination *falloff,
                                   const struct field_point *edge, struct last_point *ending,
                                   struct error *error)
{
    enum { TRIES = 20 };
    struct error none;
    for (int try = 0; try < TRIES; try++) {
        const double share = 1 - (double)try / TRIES;
        const struct field_point point = {edge->kind,
                                          {share * edge->value[0], share * edge->value[1]}};
        if (relative_illumination_height(falloff, &point, ending->height,
                                         try == 0 ? error : &none)) {
            ending->share = share;
            return true;
        }
    }
    return false;
}

/* The point that is asked for; without one the edge of the image, upwards in a round lens. */
static bool find_point(const struct analysis_case *one, size_t field,
                       const struct illumination_input *input,
                       const struct relative_illumination *falloff, struct last_point *ending,
                       struct error *error)
{
    const struct field_point *point = &one->setup->fields[field].point;
    double *height = ending->height;
    *ending = (struct last_point){.height = {point->value[0], point->value[1]}, .share = 1};
    if (asks_height(input)) {
        return true;
    }
    if (asks_point(input)) {
        return relative_illumination_height(falloff, point, height, error);
    }
    if (!illumination_find_edge(falloff, point, ending, error)) {
        return false;
    }
    if (lens_is_round(one->setup->lens)) {
        height[1] = hypot(height[0], height[1]);
        height[0] = 0;
    }
    return true;
}

/* What is found of a point; `share`: of the way to the largest field, see struct last_point. */
static void illumination_row_fill(const struct analysis_cursor *at, double share,
                                  const struct relative_illumination_point *found,
                                  struct illumination_row *row)
{
    row->at = *found;
    const char *const warnings[] = {
        found->light.is_met ? NULL : "the irradiance has not converged: see its error",
        found->is_field_met ? NULL : "the light by field has not converged: see its error",
        share < 1 ? "no chief ray of the largest field comes to the image: the points end where "
                    "one does"
                  : NULL,
        lens_island_warning(&found->islands, at->run->arena)};
    for (size_t i = 0; i < sizeof warnings / sizeof warnings[0]; i++) {
        analysis_warn(at, &row->point, warnings[i]);
    }
}

/* Points of the image: first .. last of those that part the way from the axis to the end. */
struct illumination_points {
    const struct relative_illumination *falloff;
    double end[2]; /* mm */
    size_t first, last;
    struct relative_illumination_point *found; /* from the first on */
};

static void illumination_find_light(const struct analysis_case *one, size_t item, void *context)
{
    const struct illumination_points *points = context;
    const double share = (double)(points->first + item) / (double)points->last;
    const double at[2] = {share * points->end[0], share * points->end[1]};
    const struct relative_illumination apart =
        relative_illumination_apart(points->falloff, one->setup->arena);
    points->found[item] = relative_illumination_at(&apart, at);
}

enum { STEPS = 10 };

/* Without a point the edge of the field, and that is not the axis. */
static struct analysis_policy illumination_policy_of(const struct illumination_input *input)
{
    return (struct analysis_policy){.wavelengths = WAVELENGTHS_PRIMARY,
                                    .fields = asks_point(input) ? FIELDS_ALL : FIELDS_EDGE,
                                    .one_wavelength = true};
}

/* A height is one in the image, where light arrives: that of the real image. */
static struct illumination_input with_real_heights(const struct illumination_input *input)
{
    struct illumination_input real = *input;
    real.question.real = true;
    return real;
}

static const struct sheet sheet = SHEET(columns, struct illumination_row);

static bool illumination_run(const void *data, struct run *run, struct error *error)
{
    const struct illumination_input input = with_real_heights(data);
    const struct analysis_policy policy = illumination_policy_of(data);
    struct analysis_cursor at = analysis_begin(&input, &policy, run);
    while (analysis_next(&at, error)) {
        struct relative_illumination_point found[STEPS + 1];
        struct relative_illumination falloff;
        struct last_point end = {.share = 1};
        const bool is_there = open_falloff(at.one, &input, run, &falloff, error) &&
                              find_point(at.one, at.field, &input, &falloff, &end, error);
        if (!is_there && !analysis_keep_lost(&at, error)) {
            return false;
        }
        const size_t first = asks_point(&input) ? STEPS : 0;
        const size_t count = is_there ? STEPS + 1 - first : 1;
        if (is_there) {
            struct illumination_points points = {
                &falloff, {end.height[0], end.height[1]}, first, STEPS, found};
            if (count > 1) {
                const double middle[2] = {end.height[0] / 2, end.height[1] / 2};
                relative_illumination_begin(&falloff, middle);
            }
            analysis_divide(at.one, count, illumination_find_light, &points);
        }
        for (size_t i = 0; i < count; i++) {
            struct illumination_row row;
            analysis_begin_row(&at, &sheet, &row);
            row.stop_diameter = input.stop_diameter;
            if (is_there) {
                illumination_row_fill(&at, end.share, &found[i], &row);
            }
            if (!run_emit(run, &row)) {
                return true;
            }
        }
    }
    return error->code == ERROR_NONE;
}

static bool illumination_makes_many(const void *data)
{
    const struct illumination_input *input = data;
    return !asks_point(input) ||
           lens_positions_several(input->question.lens.lens, input->question.position);
}

/* -------- the plot -------- */

/* One lens in one case, and how far its image is looked at. */
struct illumination_curve {
    const char *words, *name; /* of figures; of what was asked for */
    const char *title;        /* of the lens */
    const struct analysis_case *one;
    struct relative_illumination falloff;
    double farthest[2], reach; /* the point farthest from the axis, mm */
};

enum { POINTS = 161, MOST_CURVES = 12, SERIES = 4 };

struct illumination_painter {
    const struct illumination_input *input;
    struct arena *arena;
    struct illumination_curve *curves;
    size_t count, room;
};

static const char *with_stop(const struct illumination_input *input, const char *words,
                             struct arena *arena)
{
    if (isnan(input->stop_diameter)) {
        return words;
    }
    return arena_printf(arena, "%s%sstop %.6g mm", words != NULL ? words : "",
                        words != NULL ? ", " : "", input->stop_diameter);
}

static bool illumination_add_point(struct illumination_painter *painter,
                                   const struct analysis_case *one, size_t field,
                                   struct error *error)
{
    struct arena *arena = painter->arena;
    const struct illumination_input *input = painter->input;
    const char *words = with_stop(input, analysis_figure_words(one, FIGURE_ALL, arena), arena);
    struct illumination_curve *curve = NULL;
    for (size_t i = 0; i < painter->count; i++) {
        struct illumination_curve *old = &painter->curves[i];
        const bool same =
            strcmp(old->words, words) == 0 && strcmp(old->title, one->setup->lens->title) == 0;
        curve = same && curve == NULL ? old : curve;
    }
    struct last_point end;
    if (curve == NULL) {
        painter->curves = arena_grow(arena, painter->curves, painter->count, &painter->room,
                                     sizeof *painter->curves);
        curve = &painter->curves[painter->count];
        *curve = (struct illumination_curve){
            .words = words,
            .name = with_stop(input, analysis_case_words(one, arena), arena),
            .title = one->setup->lens->title,
            .one = one};
        if (!open_falloff(one, input, NULL, &curve->falloff, error)) {
            return false;
        }
        painter->count++;
    }
    if (!find_point(one, field, input, &curve->falloff, &end, error)) {
        return false;
    }
    const double reach = hypot(end.height[0], end.height[1]);
    if (reach > curve->reach) {
        curve->reach = reach;
        curve->farthest[0] = end.height[0];
        curve->farthest[1] = end.height[1];
    }
    return true;
}

/* All there is to say of one case, or beside others its light alone. */
static size_t illumination_add_series(const struct illumination_curve *curve, bool alone,
                                      const char *label, double reach, struct arena *arena,
                                      struct plot_series *series)
{
    static const char *const labels[SERIES] = {"E/E axis", "by field", "cos\xe2\x81\xb4 of field",
                                               "vignetted"};
    double *y[SERIES];
    for (size_t k = 0; k < SERIES; k++) {
        y[k] = ARENA_ARRAY(arena, POINTS, double);
        series[k] = (struct plot_series){.label = labels[k], .y = y[k], .style = k};
    }
    const double beyond = reach / curve->reach; /* others have points there */
    const size_t count = curve->reach > 0 ? 1 + (size_t)((POINTS - 1) * (1 + 1e-9) / beyond) : 0;
    struct relative_illumination_point found[POINTS];
    struct relative_illumination falloff = curve->falloff;
    if (count > 1) {
        const double share = (double)(count - 1) / (POINTS - 1) * beyond;
        const double last[2] = {share * curve->farthest[0], share * curve->farthest[1]};
        falloff.chief_end = relative_illumination_chief_end(&falloff, last, count - 1);
    }
    struct illumination_points points = {
        &falloff, {beyond * curve->farthest[0], beyond * curve->farthest[1]}, 0, POINTS - 1, found};
    analysis_divide(curve->one, count, illumination_find_light, &points);
    for (size_t i = 0; i < POINTS; i++) {
        const struct relative_illumination_point none = {
            .relative_point = NAN, .relative_field = NAN, .cos4 = NAN, .vignetted = NAN};
        const struct relative_illumination_point point = i < count ? found[i] : none;
        y[0][i] = 100 * point.relative_point;
        y[1][i] = 100 * point.relative_field;
        y[2][i] = 100 * point.cos4;
        y[3][i] = 100 * point.vignetted;
    }
    if (!alone) {
        series[0].label = label;
    }
    return alone ? SERIES : 1;
}

static bool illumination_paint(struct illumination_painter *painter, struct svg *svg,
                               struct error *error)
{
    struct arena *arena = svg->arena;
    const struct illumination_curve *first = &painter->curves[0];
    struct plot_series *series = ARENA_ARRAY(arena, painter->count + SERIES, struct plot_series);
    double *x = ARENA_ARRAY(arena, POINTS, double), reach = 0;
    bool one_lens = true;
    for (size_t i = 0; i < painter->count; i++) {
        reach = fmax(reach, painter->curves[i].reach);
        one_lens = one_lens && strcmp(painter->curves[i].title, first->title) == 0;
    }
    if (painter->count == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw");
    }
    if (!(reach > 0)) {
        return fail(error, ERROR_USAGE,
                    "{--plot} draws light over the height in the image: name one beyond the axis "
                    "with {--height}");
    }
    const bool alone = painter->count == 1;
    struct plot plot = {
        .title = one_lens ? arena_printf(arena, "Relative illumination of %s", first->title)
                          : "Relative illumination",
        .subtitle = alone ? first->words : "irradiance over that on the axis",
        .x_label = "height in the image (mm)",
        .y_label = alone ? "share (%)" : "E/E axis (%)",
        .x = x,
        .count = POINTS,
        .series = series};
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = reach * (double)i / (POINTS - 1);
    }
    for (size_t i = 0; i < painter->count; i++) {
        const struct illumination_curve *curve = &painter->curves[i];
        size_t added = illumination_add_series(
            curve, alone, analysis_curve_words(curve->title, curve->name, one_lens, arena), reach,
            arena, series + plot.series_count);
        series[plot.series_count].style = i;
        plot.series_count += added;
    }
    return plot_draw(&plot, svg, error);
}

static bool illumination_draw(const struct artifact_job *job, struct output *sink,
                              struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct illumination_painter painter = {.arena = svg.arena};
    for (size_t i = 0; i < job->count; i++) {
        /* cases keep their question: it must outlive them */
        struct illumination_input *input = ARENA_NEW(svg.arena, struct illumination_input);
        const struct analysis_policy policy = illumination_policy_of(job->inputs[i]);
        *input = with_real_heights(job->inputs[i]);
        painter.input = input;
        struct analysis_cursor at = analysis_begin(input, &policy, job->run);
        at.keeps_lost = at.keeps_lost || job->count > 1;
        while (analysis_next(&at, error)) {
            if (!illumination_add_point(&painter, at.one, at.field, error) &&
                !analysis_keep_lost(&at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return (painter.count <= MOST_CURVES ||
            fail(error, ERROR_USAGE,
                 "{--plot} would draw %zu curves: at most %d can be distinguished", painter.count,
                 MOST_CURVES)) &&
           illumination_paint(&painter, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the light over the height in the image"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = illumination_draw},
};

static const struct explanation explanations[] = {
    {"irradiance_per_radiance",
     "{E} = (n'/n)^2 integral of cos(theta) dw over all that is clear of the exit pupil, as the "
     "point sees it",
     "[Welford86]",
     "a uniform scene; no loss in glass; light beyond a gap in the pupil is left out, and named "
     "where it fills 1/128 of the last surface across"},
    {"relative_point", "E/L of the point over E/L on the axis", "the same", NULL},
    {"relative_field",
     "area in direction cosines behind the lens of the rays of one object point, over that on the "
     "axis",
     "the same", "the light of the point only where these rays meet in it"},
    {"vignetted_fraction", "1 - E/E with the stop alone", "the same",
     "a surface without its rim goes on as its formula does"},
    {"cos4", "cos({t})^4", "the law for a small distant pupil without distortion", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"illumination double-gauss", "from the axis to the image of the largest field"},
    {"illumination cs348b-dgauss-50 --height 0,10,21.633 --stop-diameter 4.275",
     "on the film, stopped down"},
    {"illumination double-gauss --no-clip --field 0,10,14deg --csv",
     "limited by the stop alone, by field"},
    {"illumination double-gauss --height 0..25#6 -N 2,4 --plot light.svg", "stopped down, drawn"},
    {NULL, NULL},
};

const struct command command_illumination = {
    .name = "illumination",
    .summary = "relative illumination: light falloff and vignetting",
    COMMAND_ASKS(struct illumination_input),
    COMMAND_ANSWERS(struct illumination_row),
    .run = illumination_run,
    .makes_many = illumination_makes_many,
    ANALYSIS_COMMAND,
    .cell = "relative_point",
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
