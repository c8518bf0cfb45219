/* commands/analysis/cmd_spot.c - lenscalc spot: how widely the rays of a field spread. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_fields.h"
#include "commands/analysis/spot_diagram.h"

static const struct word references[] = {
    [SPOT_ABOUT_CENTROID] = {"centroid", "where their weighted mean is"},
    [SPOT_ABOUT_CHIEF] = {"chief", "where the chief ray is"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS(struct spot_input, question, "all of the lens by their weights, as one spot",
                     ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS(struct spot_input, question),
    ANALYSIS_SPECTRUM_OPTION(struct spot_input, question),
    {OPTION(struct spot_input, reference), .name = "reference", .words = references,
     .fallback = "centroid", .value = "POINT",
     .help = "centre of the largest radius and of the energy radius"},
    {OPTION(struct spot_input, energy), .name = "energy", .column = "energy",
     .dimension = &dimension_ratio, .unit = "%", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST | OPTION_BELOW_HIGHEST, .value = "SHARE",
     .help = "the radius that contains this share of the light: 80%"},
    {OPTION(struct spot_input, to), .name = "to", .lowest = 1, .highest = 1e6, .value = "SURFACE",
     .excludes = "focus defocus",
     .help = "the footprint on this surface, in place of the image; counted from 1, stop included"},
    ANALYSIS_PUPIL_OPTIONS(struct spot_input, question),
};

struct spot_row {
    struct analysis_point point;
    double rms, rms_x, rms_y, rms_chief, radius, radius_error, error; /* mm */
    double energy, energy_radius, energy_error;
    double rms_angle, rms_x_angle, rms_y_angle, rms_chief_angle, radius_angle, radius_error_angle,
        error_angle; /* rad */
    double energy_angle, energy_error_angle;
    double x, y, chief_x, chief_y, clear;
    long rays;
    const char *weight;
};

#define SMALL(member_name, more)                                                                   \
    COLUMN(struct spot_row, member_name), .dimension = &dimension_length, .unit = "um",            \
                                          .flags = (more)
#define PLACE(member_name, more)                                                                   \
    COLUMN(struct spot_row, member_name), .dimension = &dimension_length, .unit = "mm",            \
                                          .flags = (more)
#define ANGLE(member_name, more)                                                                   \
    COLUMN(struct spot_row, member_name), .dimension = &dimension_angle, .unit = "mrad",           \
                                          .flags = (more) | COLUMN_SPARSE

static const struct column columns[] = {
    ANALYSIS_POINT_COLUMNS(struct spot_row, point),
    ANALYSIS_DEFOCUS_COLUMN(struct spot_row, point),
    ANALYSIS_WAVELENGTH_COLUMN(struct spot_row, point),
    {SMALL(rms, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rms", .label = "RMS radius",
     .help = "root mean square distance from the centroid"},
    {SMALL(rms_x, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rms_x", .label = "RMS in x",
     .help = "the same in x alone"},
    {SMALL(rms_y, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rms_y", .label = "RMS in y",
     .help = "the same in y alone"},
    {SMALL(rms_chief, COLUMN_SPARSE), .name = "rms_chief", .label = "RMS about the chief ray",
     .help = "root mean square distance from the chief ray, of the primary wavelength where there "
             "are several; absent where that is lost"},
    {SMALL(radius, COLUMN_BRIEF | COLUMN_SPARSE), .name = "radius", .label = "largest radius",
     .help = "the largest distance of rays of the clear pupil, its edge included, from the "
             "centroid or what --reference says"},
    {SMALL(radius_error, COLUMN_HIDDEN), .name = "radius_error", .label = "error of that",
     .help = "what the largest radius may be off"},
    {COLUMN(struct spot_row, energy), .name = "energy", .dimension = &dimension_ratio, .unit = "%",
     .flags = COLUMN_ECHO | COLUMN_BRIEF | COLUMN_EXTRA, .with = "energy", .label = "share",
     .help = "share of the light"},
    {SMALL(energy_radius, COLUMN_BRIEF | COLUMN_EXTRA), .with = "energy", .name = "energy_radius",
     .label = "energy radius", .help = "the radius that holds it"},
    {SMALL(energy_error, COLUMN_EXTRA), .with = "energy", .name = "energy_error",
     .label = "error of the energy radius", .help = "what the energy radius may be off"},
    {SMALL(error, COLUMN_BRIEF | COLUMN_SPARSE), .name = "error", .label = "error",
     .help = "what the RMS figures may be off: three times what twice the rays change of them, "
             "four times of a plain pattern"},
    {ANGLE(rms_angle, COLUMN_BRIEF), .name = "rms", .label = "RMS radius",
     .help = "the same of an image at infinity: sines of angles from the chief ray"},
    {ANGLE(rms_x_angle, COLUMN_BRIEF), .name = "rms_x", .label = "RMS in x", .help = "in x alone"},
    {ANGLE(rms_y_angle, COLUMN_BRIEF), .name = "rms_y", .label = "RMS in y", .help = "in y alone"},
    {ANGLE(rms_chief_angle, 0), .name = "rms_chief", .label = "RMS about the chief ray",
     .help = "about the chief ray"},
    {ANGLE(radius_angle, COLUMN_BRIEF), .name = "radius", .label = "largest radius",
     .help = "the largest"},
    {ANGLE(radius_error_angle, COLUMN_HIDDEN), .name = "radius_error", .label = "error of that",
     .help = "what the largest may be off"},
    {ANGLE(energy_angle, COLUMN_EXTRA), .with = "energy", .name = "energy_radius",
     .label = "energy radius", .help = "the angle that holds the share"},
    {ANGLE(energy_error_angle, COLUMN_EXTRA), .with = "energy", .name = "energy_error",
     .label = "error of the energy radius", .help = "what it may be off"},
    {ANGLE(error_angle, COLUMN_BRIEF), .name = "error", .label = "error",
     .help = "what the RMS radius may be off"},
    {PLACE(x, 0), .name = "x", .label = "centroid x", .help = "of the centroid"},
    {PLACE(y, 0), .name = "y", .label = "centroid y", .help = "of the centroid, upwards"},
    {PLACE(chief_x, COLUMN_HIDDEN), .name = "chief_x", .label = "chief ray x",
     .help = "where the chief ray meets the plane"},
    {PLACE(chief_y, COLUMN_HIDDEN), .name = "chief_y", .label = "chief ray y", .help = "upwards"},
    {COLUMN(struct spot_row, clear), .name = "clear", .label = "clear share",
     .help = "of the area of the pupil that is not vignetted"},
    {COLUMN(struct spot_row, rays), .name = "rays", .flags = COLUMN_HIDDEN, .label = "rays",
     .help = "of one wavelength"},
    ANALYSIS_SPECTRUM_COLUMN(struct spot_row, point),
    {COLUMN(struct spot_row, weight), .name = "weights", .flags = COLUMN_ASSUMED,
     .depends = "weight aim pattern clip no-clip", .label = "rays weighted by",
     .help = "where equal weights mean equal areas"},
    ANALYSIS_TAIL_COLUMNS(struct spot_row, point),
};

/* What aiming leaves of a place on the axis is none. */
static double spot_row_place(double coordinate, double rms)
{
    return fabs(coordinate) < 1e-15 * rms ? 0 : coordinate;
}

static void spot_fill(const struct spot *spot, struct spot_row *row)
{
    const double values[] = {spot->rms,           spot->rms_x,        spot->rms_y,
                             spot->rms_chief,     spot->radius,       spot->error,
                             spot->energy_radius, spot->energy_error, spot->radius_error};
    double *lengths[] = {&row->rms,           &row->rms_x,        &row->rms_y,
                         &row->rms_chief,     &row->radius,       &row->error,
                         &row->energy_radius, &row->energy_error, &row->radius_error};
    double *angles[] = {&row->rms_angle,       &row->rms_x_angle,        &row->rms_y_angle,
                        &row->rms_chief_angle, &row->radius_angle,       &row->error_angle,
                        &row->energy_angle,    &row->energy_error_angle, &row->radius_error_angle};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        *(spot->is_angular ? angles[i] : lengths[i]) = values[i];
    }
    if (!spot->is_angular) {
        row->x = spot_row_place(spot->centroid[0], spot->rms);
        row->y = spot_row_place(spot->centroid[1], spot->rms);
        row->chief_x = spot_row_place(spot->chief[0], spot->rms);
        row->chief_y = spot_row_place(spot->chief[1], spot->rms);
    }
    row->clear = spot->clear;
    row->rays = (long)spot->rays;
}

/* The largest radius takes as long as all the rest. */
static bool shows_radius(const struct run *run)
{
    static const size_t members[] = {
        offsetof(struct spot_row, radius), offsetof(struct spot_row, radius_error),
        offsetof(struct spot_row, radius_angle), offsetof(struct spot_row, radius_error_angle)};
    bool shows = false;
    for (size_t i = 0; i < sizeof members / sizeof members[0]; i++) {
        shows = shows || run_shows(run, members[i]);
    }
    return shows;
}

static bool spot_row_find(const struct analysis_case *one, size_t field, const void *context,
                          void *found, struct error *error)
{
    const struct analysis_asked *asked = context;
    struct spot_question question;
    if (!spot_question_of(one, field, asked->input, &question, error)) {
        return false;
    }
    question.no_radius = !shows_radius(asked->run);
    return spot_find(&question, one->setup->arena, found, error);
}

static bool spot_take(const struct analysis_case *one, size_t field, const void *found,
                      void *context, struct error *error)
{
    const struct analysis_asked *asked = context;
    const struct spot *spot = found;
    struct spot_row row;
    (void)error;
    analysis_begin_row(asked, one, field, &row);
    spot_fill(spot, &row);
    analysis_warn(asked, &row.point, lens_island_warning(&spot->islands, asked->run->arena));
    if (!(one->question->rays > 0) && !spot->has_converged) {
        analysis_warn(asked, &row.point, "the spot has not converged: see its error");
    }
    return run_emit(asked->run, &row);
}

static void spot_repeat(const void *data, void *row)
{
    const struct spot_input *input = data;
    ((struct spot_row *)row)->energy = input->energy;
    ((struct spot_row *)row)->weight = analysis_weight_words(&input->question);
}

static const struct sheet sheet = SHEET(columns, struct spot_row);
static const struct analysis_rows rows = {
    &spot_policy,
    &sheet,
    spot_repeat,
    {.find = spot_row_find, .found_size = sizeof(struct spot), .take = spot_take}};

static bool spot_run(const void *data, struct run *run, struct error *error)
{
    return analysis_answer_rows(data, &rows, run, error);
}

static bool spot_makes_many(const void *data)
{
    return analysis_makes_many(&((const struct spot_input *)data)->question, &spot_policy);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw the spots, by field and through focus; of many their RMS radius"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = spot_diagram},
};

static const struct explanation explanations[] = {
    {"rms", "square of it = sum w |(x, y) - centroid|^2/sum w over the clear pupil",
     "Gauss's points in r^2 between the corners of the pupil, [Forbes88]",
     "light beyond a gap in the pupil is left out, and named where it fills 1/128 of the first "
     "surface across"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"spot double-gauss", "the spots of all fields, all wavelengths together"},
    {"spot double-gauss --field 14deg -w d --defocus -0.2..0.2#5", "one of them through focus"},
    {"spot double-gauss -w d --no-clip --pattern hexapolar --rays 127",
     "as programs print it that do not integrate"},
    {"spot nikkor-z-58-f095 --energy 50%,80%", "radii that hold so much of the light"},
    {NULL, NULL},
};

const struct command command_spot = {
    .name = "spot",
    .group = "analyses",
    .summary = "how widely the rays of a field spread on the image plane",
    COMMAND_ASKS(struct spot_input),
    COMMAND_ANSWERS(struct spot_row),
    .run = spot_run,
    .makes_many = spot_makes_many,
    .brings = analysis_brings,
    .threads = analysis_threads,
    .varies = analysis_varies,
    .cell = "rms",
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
    .weight = analysis_weight,
};
