/* commands/lens/cmd_sag.c - lenscalc sag: sag and slope tables of surfaces. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "draw/plot.h"
#include "optics/surface_shape.h"

struct sag_input {
    struct lens_question question;
    long surface, steps; /* surface from 1; 0 or less: all */
    double height;       /* mm; NaN = not given */
};

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                          .fields = FIELDS_LARGEST,
                                          .telecentric = true,
                                          .is_narrow = true};

#define INPUT struct sag_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    LENS_POSITION_OPTION(INPUT, question),
    {ASKED(surface), .name = "surface", .column = "surface", .lowest = 1,
     .highest = LENS_MOST_SURFACES, .value = "NUMBER",
     .help = "one surface, counted from 1, the stop included; default all that are curved"},
    {MEASURE(height, length, "mm", "LENGTH"), REPEATED("height"), .flags = OPTION_NO_INFINITY,
     .lowest = -1e6, .highest = 1e6,
     .help = "distance from the axis; default steps to the clear semi-diameter"},
    {ASKED(steps), .name = "steps", .lowest = 1, .highest = 10000, .fallback = "10",
     .value = "COUNT", .excludes = "height", .help = "steps from the vertex to the edge"},
};

struct sag_row {
    long surface;
    const char *position, *warning, *lens;
    double height; /* mm */
    struct surface_shape shape;
    double angle; /* of the slope, rad */
};

#define ROW struct sag_row

static const struct column columns[] = {
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {SHOWN(surface), .flags = COLUMN_BRIEF | COLUMN_ECHO, .name = "surface", .head = "surf",
     .help = "number of the surface, from 1, the stop counted"},
    {LENGTH(height, "mm"), .flags = COLUMN_BRIEF | COLUMN_ECHO, .name = "height", .symbol = "r",
     .help = "distance from the axis; of a cylinder in its curved section"},
    {LENGTH(shape.sag, "mm"), BRIEF, .name = "sag", .symbol = "z", .digits = 7,
     .help = "from the plane of the vertex, along the light of the first surface"},
    {SHOWN(shape.slope), BRIEF, .name = "slope", .symbol = "z'", .help = "dz/dr"},
    {ANGLE(angle), BRIEF, .name = "angle", .help = "the slope as an angle"},
    {LENGTH(shape.departure, "um"), BRIEF, .name = "departure",
     .help = "of the sag from that of the sphere of its vertex; absent where that ends before"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

/* Has the surface a curve of its own? */
static bool sag_is_wanted(const struct sag_input *input, const struct lens *lens, size_t i)
{
    const struct surface *surface = &lens->surfaces[i];
    return input->surface <= 0 ? surface_has(surface, SURFACE_HAS_CURVE) &&
                                     surface_profile(surface) != PROFILE_PLANE
                               : input->surface == (long)i + 1;
}

/* What of a lens is asked: nothing but a position. */
static struct lens_question sag_question_of(const struct sag_input *input)
{
    struct lens_question question = input->question;
    question.fnumber = question.field = question.field_x = NAN;
    return question;
}

/* How far its table goes, mm. */
static bool sag_edge_find(const struct lens *lens, size_t i, double *edge, struct error *error)
{
    const struct surface *surface = &lens->surfaces[i];
    if (!surface_has(surface, SURFACE_HAS_CURVE)) {
        return fail(error, ERROR_DOMAIN, "surface %zu is no surface of glass or a mirror", i + 1);
    }
    if (!surface->has_diameter) {
        return fail(error, ERROR_DOMAIN, "surface %zu states no diameter: give {--height}", i + 1);
    }
    *edge = surface->diameter.value.hi / 2;
    return true;
}

/* One height of one surface. */
static bool sag_row_fill(const struct surface *surface, struct sag_row *row, struct error *error)
{
    row->shape = surface_shape_at(surface, row->height);
    row->angle = atan(row->shape.slope);
    return !isnan(row->shape.sag) ||
           fail(error, ERROR_DOMAIN, "surface %ld does not reach %.6g mm from its axis",
                row->surface, row->height);
}

static bool sag_check_surface(const struct sag_input *input, const struct lens *lens,
                              struct error *error)
{
    return input->surface <= (long)lens->surface_count ||
           fail(error, ERROR_USAGE, "{--surface} %ld: the lens has %zu surfaces", input->surface,
                lens->surface_count);
}

/* The rows of a surface; false, and no error: no more are wanted. */
static bool sag_list(const struct sag_input *input, const struct lens_case *one, size_t i,
                     struct run *run, struct error *error)
{
    const struct lens *lens = one->setup->lens;
    const bool is_table = isnan(input->height);
    double edge = 0;
    if (is_table && !sag_edge_find(lens, i, &edge, error)) {
        return false;
    }
    for (long k = 0; k <= (is_table ? input->steps : 0); k++) {
        struct sag_row row = {.surface = (long)i + 1,
                              .position = one->setup->position,
                              .lens = lens->title,
                              .warning = one->warning,
                              .height = is_table ? edge * (double)k / (double)input->steps
                                                 : input->height};
        if (!sag_row_fill(&lens->surfaces[i], &row, error) || !run_emit(run, &row)) {
            return false;
        }
    }
    return true;
}

static bool sag_run(const void *data, struct run *run, struct error *error)
{
    const struct sag_input *input = data;
    const struct lens_question question = sag_question_of(input);
    struct lens_cursor at = lens_begin(&question, &policy, run->arena);
    while (lens_next(&at, error)) {
        const struct lens *lens = at.one.setup->lens;
        size_t count = 0;
        if (!sag_check_surface(input, lens, error)) {
            return false;
        }
        for (size_t i = 0; i < lens->surface_count; i++) {
            if (sag_is_wanted(input, lens, i)) {
                count++;
                if (!sag_list(input, &at.one, i, run, error)) {
                    return error->code == ERROR_NONE;
                }
            }
        }
        if (count == 0) {
            return fail(error, ERROR_DOMAIN, "the lens has no curved surface");
        }
    }
    return error->code == ERROR_NONE;
}

static bool sag_makes_many(const void *data)
{
    const struct sag_input *input = data;
    return input->surface <= 0 || isnan(input->height);
}

/* -------- the drawing -------- */

enum { CURVES_MOST = 14, POINTS = 101 };

/* Curves of sag against height, each to its surface's edge. */
struct sag_drawing {
    struct arena *arena;
    struct plot_series series[CURVES_MOST];
    size_t count;
    const char *lens;
};

static bool sag_drawing_add(struct sag_drawing *drawing, const struct lens *lens, size_t i,
                            struct error *error)
{
    double edge, *x = ARENA_ARRAY(drawing->arena, 2 * POINTS, double), *y = x + POINTS;
    unsigned char *places = ARENA_ARRAY(drawing->arena, POINTS, unsigned char);
    if (!sag_edge_find(lens, i, &edge, error)) {
        return false;
    }
    if (drawing->count == CURVES_MOST) {
        return fail(error, ERROR_USAGE, "{--plot} would draw more than %d curves: {--surface}",
                    CURVES_MOST);
    }
    for (size_t k = 0; k < POINTS; k++) {
        x[k] = edge * (double)k / (POINTS - 1);
        y[k] = surface_sag(&lens->surfaces[i], x[k]);
        places[k] = PLOT_BETWEEN;
    }
    drawing->series[drawing->count] =
        (struct plot_series){.label = arena_printf(drawing->arena, "surface %zu", i + 1),
                             .x = x,
                             .y = y,
                             .count = POINTS,
                             .places = places,
                             .style = drawing->count};
    drawing->count++;
    return true;
}

static bool sag_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct sag_drawing drawing = {.arena = svg.arena};
    struct sag_input input = *(const struct sag_input *)job->inputs[0];
    for (size_t j = 0; j < job->count; j++) {
        const struct sag_input *here = job->inputs[j];
        /* heights that are swept lie on one curve */
        if (j > 0 && here->surface == input.surface) {
            continue;
        }
        input = *here;
        const struct lens_question question = sag_question_of(here);
        struct lens_cursor at = lens_begin(&question, &policy, job->run->arena);
        if (!lens_next(&at, error) || !sag_check_surface(here, at.one.setup->lens, error)) {
            return false;
        }
        const struct lens *lens = at.one.setup->lens;
        drawing.lens = lens->title;
        for (size_t i = 0; i < lens->surface_count; i++) {
            if (sag_is_wanted(here, lens, i) && !sag_drawing_add(&drawing, lens, i, error)) {
                return false;
            }
        }
    }
    if (drawing.count == 0) {
        return fail(error, ERROR_DOMAIN, "the lens has no curved surface");
    }
    const struct plot plot = {.title = arena_printf(svg.arena, "Surfaces of %s", drawing.lens),
                              .x_label = "height (mm)",
                              .y_label = "sag (mm)",
                              .series = drawing.series,
                              .series_count = drawing.count};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the sag of the surfaces to their edges"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = sag_figure},
};

static const struct explanation explanations[] = {
    {"sag", "{z} = c {r}^2/(1 + sqrt(1 - (1+k) c^2 {r}^2)) + A1 {r} + A2 {r}^2 + ...", "[Smith05]",
     NULL},
    {"slope", "{z'} = dz/dr", "the derivative of the sag", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"sag double-gauss --surface 1 --steps 5", "a table of one surface"},
    {"sag double-gauss --surface 1 --height 0..30:5 --csv", "at given heights"},
    {"sag double-gauss --plot sag.svg", "all surfaces, drawn"},
    {NULL, NULL},
};

const struct command command_sag = {
    .name = "sag",
    .stop_size_wants = "",
    COMMAND_OF("a lens", "sag, slope and departure from a sphere of surfaces, as tables"),
    .run = sag_run,
    .makes_many = sag_makes_many,
    COMMAND_MAKES(artifacts),
    .cell = "sag",
};
