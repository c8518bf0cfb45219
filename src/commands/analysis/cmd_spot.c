/* commands/analysis/cmd_spot.c - lenscalc spot: spots of a field's rays. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/field_map.h"
#include "commands/analysis/spot_figure.h"

#include <math.h>

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
     .excludes = "focus defocus over-field",
     .help = "the footprint on this surface, in place of the image; counted from 1, stop included"},
    ANALYSIS_PUPIL_OPTIONS,
    ANALYSIS_OVER_FIELD_OPTIONS,
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
        analysis_begin_finding(input, &spot_policy, run, spot_row_find, sizeof(struct spot));
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

/* The RMS radius alone, um or mrad. */
static bool spot_map_find(const struct analysis_cursor *at, const struct analysis_case *one,
                          size_t field, void *found, struct error *error)
{
    struct spot_question question;
    struct spot spot;
    double *value = found;
    if (!spot_question_of(one, field, at->input, &question, error)) {
        return false;
    }
    question.no_radius = true;
    question.energy = NAN;
    if (!spot_find(&question, one->setup->arena, &spot, error)) {
        return false;
    }
    *value = 1000 * spot.rms;
    return true;
}

static bool spot_over_field(const struct artifact_job *job, struct output *sink,
                            struct error *error)
{
    static const struct field_map_kind kind = {.policy = &spot_policy,
                                               .find = spot_map_find,
                                               .values = 1,
                                               .what = "RMS spot radius over the image",
                                               .scale = "RMS radius (\xc2\xb5m)",
                                               .angular = "RMS radius (mrad)"};
    return field_map_make(job, &kind, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw the spots, by field and through focus; of many their RMS radius"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = spot_figure},
    {ARTIFACT_OPTION("over-field", field_map_types,
                     "map the RMS radius over the image, drawn or as numbers"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = spot_over_field},
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
