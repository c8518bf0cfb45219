/* commands/analysis/cmd_energy.c - lenscalc energy: light within circles and squares. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_energy.h"
#include "commands/analysis/figure_captions.h"
#include "draw/plot.h"
#include "draw/ticks.h"

#include <math.h>
#include <string.h>

enum { ENERGY_ABOUT_CENTROID, ENERGY_ABOUT_CHIEF };

struct energy_input {
    struct analysis_question question;
    double radius, radius_angle; /* mm, rad; NaN = not given */
    int reference;
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

static const struct word references[] = {
    [ENERGY_ABOUT_CENTROID] = {"centroid", "the centroid of the light"},
    [ENERGY_ABOUT_CHIEF] = {"chief", "the chief ray of the primary wavelength"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS("all of the lens by their weights, together",
                     ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct energy_input, question),
    {OPTION(struct energy_input, radius), .name = "radius", .column = "radius",
     .dimension = &dimension_length, .unit = "um", .lowest = 0, .highest = 1000,
     .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "radius of the circle, half the side of the square; default round numbers as far as "
             "most of the light goes"},
    {OPTION(struct energy_input, radius_angle), .name = "radius-angle", .quantity = "radius",
     .dimension = &dimension_angle, .unit = "mrad", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .value = "ANGLE", .excludes = "radius",
     .help = "the same of an image at infinity, as an angle"},
    {OPTION(struct energy_input, reference), .name = "reference", .words = references,
     .fallback = "centroid", .value = "POINT", .help = "centre of the circles and squares"},
    ANALYSIS_AIM_OPTION(NULL, "pupil that limits the beam"),
    ANALYSIS_CLIP_OPTIONS,
};

struct energy_row {
    struct analysis_point point;
    bool is_angular;
    double radius, pitch;
    struct psf_energy energy;
    const char *reference;
};

static const struct column_form sines = {
    &dimension_angle, "mrad",
    "of an image infinitely far away: sines of angles from the chief ray"};

#define SMALL(member_name, more)                                                                   \
    COLUMN_OR(struct energy_row, member_name, is_angular, &sines),                                 \
        .dimension = &dimension_length, .unit = "um", .flags = (more) | COLUMN_SPARSE
#define SHARE(member_name, more)                                                                   \
    COLUMN(struct energy_row, energy.member_name), .dimension = &dimension_ratio, .unit = "%",     \
                                                   .flags = (more)

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {SMALL(radius, COLUMN_BRIEF | COLUMN_ECHO), .name = "radius", .symbol = "r",
     .help = "radius of the circle, half the side of the square"},
    {SHARE(encircled, COLUMN_BRIEF), .name = "encircled", .symbol = "E",
     .label = "encircled energy",
     .help = "fraction of all light within the circle; absent where it leaves the image"},
    {SHARE(ensquared, COLUMN_BRIEF), .name = "ensquared", .label = "ensquared energy",
     .help = "fraction of all light within the square, whose sides lie along x and y"},
    {SHARE(limit, COLUMN_BRIEF), .name = "limit", .label = "diffraction limit",
     .help = "encircled by a perfect wave front of the same pupil, about the chief ray"},
    {SHARE(error, COLUMN_HIDDEN), .name = "energy_error", .label = "error of the energy",
     .help = "estimated error of the encircled and the ensquared energy"},
    {SMALL(pitch, COLUMN_HIDDEN), .name = "pitch",
     .help = "side of a pixel of the image that these are found of"},
    {COLUMN(struct energy_row, reference), .flags = COLUMN_ASSUMED, .name = "reference",
     .depends = "reference", .label = "about", .help = "centre of the circles and squares"},
    ANALYSIS_SPECTRUM_COLUMN,
    ANALYSIS_TAIL_COLUMNS,
};

/* What is found of a field. */
struct energy_found {
    struct psf_energy_image image;
    double radii[TICKS_MOST];
    struct psf_energy shares[TICKS_MOST];
    size_t count;
};

/* The radius asked for, in the units of the image; NaN: none. */
static double energy_radius_asked(const struct analysis_case *one, const struct energy_input *input)
{
    return isnan(one->setup->image) ? sin(input->radius_angle) : input->radius;
}

static bool energy_field_open(const struct analysis_cursor *at, const struct analysis_case *one,
                              size_t field, double farthest, bool has_limit,
                              struct psf_energy_image *image, struct error *error)
{
    const struct energy_input *input = at->input;
    const struct psf_energy_question question = {.bundle = analysis_bundle(one, field),
                                                 .farthest = farthest,
                                                 .about_chief =
                                                     input->reference == ENERGY_ABOUT_CHIEF,
                                                 .has_limit = has_limit,
                                                 .threads = one->threads};
    return psf_energy_open(&question, one->setup->arena, image, error);
}

/* Round radii, as far as is usual; all in thousandths of a mm. */
static size_t energy_radii_choose(double usual, double radii[TICKS_MOST])
{
    struct ticks ticks;
    size_t count = 0;
    ticks_linear(0, 1000 * usual, &ticks);
    for (size_t i = 0; i < ticks.count; i++) {
        if (ticks.value[i] > 0 && ticks.value[i] <= 1000 * usual) {
            radii[count++] = ticks.value[i] / 1000;
        }
    }
    return count;
}

static bool energy_row_find(const struct analysis_cursor *at, const struct analysis_case *one,
                            size_t field, void *room, struct error *error)
{
    struct energy_found *found = room;
    const double asked = energy_radius_asked(one, at->input);
    const bool has_limit = run_shows(at->run, offsetof(struct energy_row, energy.limit));
    if (!energy_field_open(at, one, field, asked, has_limit, &found->image, error)) {
        return false;
    }
    found->radii[0] = asked;
    found->count = isnan(asked) ? energy_radii_choose(found->image.usual, found->radii) : 1;
    psf_energy_find(&found->image, found->radii, found->count, found->shares, one->setup->arena);
    return true;
}

/* A radius as a length of an image infinitely far away, or an angle of another? */
static bool energy_check(const struct analysis_case *one, const struct energy_input *input,
                         struct error *error)
{
    const bool is_angular = isnan(one->setup->image);
    if (isnan(is_angular ? input->radius : input->radius_angle)) {
        return true;
    }
    return fail(error, ERROR_DOMAIN,
                is_angular ? "{--radius}: the image lies infinitely far away, its circles are "
                             "angles: give {--radius-angle}"
                           : "{--radius-angle} is of images infinitely far away: give {--radius}");
}

/* As analysis_next; errors as energy_check too. */
static bool energy_next(struct analysis_cursor *at, struct error *error)
{
    error->code = ERROR_NONE;
    while (at->one == NULL || !analysis_next_field(at, error)) {
        if (error->code != ERROR_NONE || !analysis_next_case(at, error) ||
            !energy_check(at->one, at->input, error)) {
            return false;
        }
    }
    return true;
}

static const char *energy_reference_words(const struct energy_input *input)
{
    return input->reference == ENERGY_ABOUT_CHIEF ? "the chief ray" : "the centroid";
}

static const struct sheet sheet = SHEET(columns, struct energy_row);

static bool energy_run(const void *data, struct run *run, struct error *error)
{
    const struct energy_input *input = data;
    struct analysis_cursor at =
        analysis_begin_finding(data, &policy, run, energy_row_find, sizeof(struct energy_found));
    while (energy_next(&at, error)) {
        const struct energy_found *found = at.found;
        const size_t count = at.lost == NULL ? found->count : 1;
        for (size_t i = 0; i < count; i++) {
            struct energy_row row;
            analysis_begin_row(&at, &sheet, &row);
            row.radius = energy_radius_asked(at.one, input);
            row.is_angular = isnan(at.one->setup->image);
            row.reference = energy_reference_words(input);
            if (at.lost == NULL) {
                row.radius = found->radii[i];
                row.pitch = found->image.psf.pitch;
                row.energy = found->shares[i];
                analysis_warn(&at, &row.point,
                              lens_island_warning(&found->image.psf.islands, run->arena));
            }
            if (!run_emit(run, &row)) {
                return true;
            }
        }
    }
    return error->code == ERROR_NONE;
}

static bool energy_makes_many(const void *data)
{
    const struct energy_input *input = data;
    return (isnan(input->radius) && isnan(input->radius_angle)) || analysis_several(data);
}

/* -------- the drawing -------- */

enum { CURVES_MOST = 7, POINTS = 121, KINDS = 3 };

/* Curves of energy, some for each field. */
struct energy_drawing {
    const struct artifact_job *job;
    struct arena *arena;
    double farthest; /* NaN: as far as is usual */
    struct plot_series series[KINDS * CURVES_MOST];
    size_t count;
    bool is_angular, has_references; /* has_references: both, which legends tell apart */
    struct captions captions;
    size_t of[CURVES_MOST]; /* which of its series is the first of each caption */
};

static bool energy_curve_find(const struct analysis_cursor *at, const struct analysis_case *one,
                              size_t field, void *room, struct error *error)
{
    const double asked = energy_radius_asked(one, at->input);
    return energy_field_open(at, one, field, asked, true, room, error);
}

/* Encircled solid, ensquared dashed; of the first the limit, dotted. */
static bool energy_drawing_add(struct energy_drawing *drawing, const struct analysis_cursor *at,
                               struct error *error)
{
    const struct psf_energy_image *image = at->found;
    const struct energy_input *input = at->input;
    struct arena *arena = drawing->arena;
    const double end = isnan(drawing->farthest) ? image->usual : drawing->farthest;
    double *x = ARENA_ARRAY(arena, 4 * POINTS, double), *radii = x + 3 * POINTS;
    double *y[KINDS];
    unsigned char *places = ARENA_ARRAY(arena, POINTS, unsigned char);
    struct psf_energy shares[POINTS];
    const size_t before = drawing->captions.count;
    const bool about_chief = input->reference == ENERGY_ABOUT_CHIEF;
    const char *about = about_chief ? "about the chief ray" : "about the centroid";
    const size_t caption = captions_add(&drawing->captions, at->one, at->field,
                                        drawing->has_references || about_chief ? about : NULL);
    if (caption < before) {
        return true;
    }
    if (caption == CURVES_MOST) {
        return fail(error, ERROR_USAGE, "{--plot} would draw more than %d pairs of curves",
                    CURVES_MOST);
    }
    drawing->of[caption] = drawing->count;
    drawing->is_angular = isnan(at->one->setup->image);
    for (size_t i = 0; i < POINTS; i++) {
        radii[i] = end * (double)i / (POINTS - 1);
    }
    psf_energy_find(image, radii, POINTS, shares, arena);
    for (size_t k = 0; k < KINDS; k++) {
        y[k] = ARENA_ARRAY(arena, POINTS, double);
    }
    for (size_t i = 0; i < POINTS; i++) {
        x[i] = 1000 * radii[i];
        y[0][i] = 100 * shares[i].encircled;
        y[1][i] = 100 * shares[i].ensquared;
        y[2][i] = 100 * shares[i].limit;
        places[i] = PLOT_BETWEEN;
    }
    const struct plot_series common = {.x = x, .count = POINTS, .places = places, .style = caption};
    static const size_t dashes[KINDS] = {1, 2, 3};
    const size_t kinds = caption == 0 ? KINDS : KINDS - 1;
    for (size_t k = 0; k < kinds; k++) {
        struct plot_series *series = &drawing->series[drawing->count++];
        *series = common;
        series->y = y[k];
        series->dash = dashes[k];
    }
    return true;
}

/* The words of the curves, which what they have in common tells once all are there. */
static void energy_drawing_label(struct energy_drawing *drawing)
{
    const struct captions *captions = &drawing->captions;
    for (size_t i = 0; i < captions->count; i++) {
        const char *label = captions_label(captions, i);
        drawing->series[drawing->of[i]].label = label != NULL ? label : "in circles";
        drawing->series[drawing->of[i] + 1].label = label != NULL ? NULL : "in squares";
    }
    struct plot_series *limit = &drawing->series[KINDS - 1];
    limit->label = captions_have_settings(captions)
                       ? ARENA_JOIN(drawing->arena, "limit, ", captions_label(captions, 0))
                       : "diffraction limit";
    limit->style = CURVES_MOST - 1;
}

static bool energy_figure(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct svg svg = {.arena = job->run->arena};
    struct energy_drawing drawing = {
        .job = job, .arena = svg.arena, .farthest = NAN, .captions = {.arena = svg.arena}};
    struct energy_input first;
    drawing.has_references = ANALYSIS_VALUES_OF(job, struct energy_input, reference) > 1;
    memcpy(&first, job->inputs[0], sizeof first);
    for (size_t i = 0; i < job->count; i++) {
        const struct energy_input *input = job->inputs[i];
        const double asked = isnan(input->radius) ? sin(input->radius_angle) : input->radius;
        drawing.farthest = fmax(drawing.farthest, asked);
    }
    for (size_t i = 0; i < job->count; i++) {
        struct energy_input input;
        memcpy(&input, job->inputs[i], sizeof input);
        /* one curve holds all radii */
        if ((!isnan(input.radius) && input.radius != first.radius) ||
            (!isnan(input.radius_angle) && input.radius_angle != first.radius_angle)) {
            continue;
        }
        input.radius = isnan(input.radius) ? input.radius : drawing.farthest;
        input.radius_angle =
            isnan(input.radius_angle) ? input.radius_angle : asin(drawing.farthest);
        struct analysis_cursor at = analysis_begin_finding(
            &input, &policy, job->run, energy_curve_find, sizeof(struct psf_energy_image));
        at.keeps_lost = true;
        while (energy_next(&at, error)) {
            if (at.lost == NULL && !energy_drawing_add(&drawing, &at, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    if (drawing.count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no light to draw");
    }
    energy_drawing_label(&drawing);
    const struct plot plot = {
        .title = captions_title(&drawing.captions, "Encircled and ensquared energy"),
        .subtitle = captions_subtitle(&drawing.captions),
        .x_label = drawing.is_angular ? "radius, half the side of squares (mrad)"
                                      : "radius, half the side of squares (\xc2\xb5m)",
        .y_label = drawing.captions.count > 1 ? "share of the light (%), dashed: in squares"
                                              : "share of the light (%)",
        .series = drawing.series,
        .series_count = drawing.count};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the energy against the radius, by field"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = energy_figure},
};

static const struct explanation explanations[] = {
    {"encircled",
     "{E} = integral of |E(x, y)|^2 over the circle of radius {r} / that over all the image",
     "[BornWolf99] 8.5.2, [Goodman05]",
     "by plane waves, as lenscalc psf: amplitude squared = energy per area of direction cosines"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"energy double-gauss -N 8", "the light within circles and squares, all wavelengths together"},
    {"energy double-gauss -N 8 --field 0 -w d --radius 5um", "of one field within 5 um"},
    {"energy questar-35 --plot energy.svg", "of a telescope whose mirror is obscured, drawn"},
    {NULL, NULL},
};

const struct command command_energy = {
    .name = "energy",
    .summary = "encircled and ensquared energy by diffraction",
    COMMAND_ASKS(struct energy_input),
    COMMAND_ANSWERS(struct energy_row),
    .run = energy_run,
    .makes_many = energy_makes_many,
    ANALYSIS_COMMAND,
    .cell = "encircled",
    COMMAND_MAKES(artifacts),
    .most_answers = 10000,
};
