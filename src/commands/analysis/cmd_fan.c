/* commands/analysis/cmd_fan.c - lenscalc fan: aberrations along two sections of the pupil. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_fields.h"
#include "commands/analysis/fan_input.h"
#include "commands/analysis/wavefront_input.h"

static const struct word shows[] = {
    [FAN_TRANSVERSE] = {"transverse", "where rays arrive, from the reference"},
    [FAN_OPD] = {"opd", "optical path differences to the reference sphere"},
    {NULL, NULL},
};

/* Wavelengths that are asked together have one reference, so that their colours show apart. */
static const struct word references[] = {
    [WAVE_CHIEF] = {"chief", "the chief ray, of the first wavelength where there are several"},
    [WAVE_CENTROID] = {"centroid", "the centroid of all rays and wavelengths by their weights"},
    [WAVE_BEST] = {"best", "the centre of the sphere that fits the wave fronts best"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS(struct fan_input, question, "all of the lens, each by itself",
                     ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS(struct fan_input, question),
    ANALYSIS_SPECTRUM_OPTION(struct fan_input, question),
    {OPTION(struct fan_input, show), .name = "show", .words = shows, .fallback = "transverse",
     .value = "WHAT", .help = "what text and --plot show"},
    {OPTION(struct fan_input, reference), .name = "reference", .words = references,
     .fallback = "chief", .value = "WHAT", .help = "reference point of the aberrations"},
    {OPTION(struct fan_input, points), .name = "points", .lowest = 3, .highest = 100001,
     .fallback = "21", .value = "COUNT",
     .help = "rays in each section, an odd number: one lies in the middle"},
    {OPTION(struct fan_input, question.aim), .name = "aim", .words = analysis_aims,
     .fallback = "stop", .value = "WHERE", .help = "pupil that the ray points lie in"},
    ANALYSIS_CLIP_OPTIONS(struct fan_input, question),
};

struct fan_row {
    struct analysis_point point;
    const char *section, *status, *reference;
    double pupil_x, pupil_y;
    double dx, dy;             /* mm */
    double dx_angle, dy_angle; /* rad */
    double opd;                /* waves */
    double at_x, at_y, at_z;   /* mm */
    double radius;             /* mm */
    long surface;
};

#define SMALL(member_name, more)                                                                   \
    COLUMN(struct fan_row, member_name), .dimension = &dimension_length, .unit = "um",             \
                                         .flags = (more)
#define PLACE(member_name, more)                                                                   \
    COLUMN(struct fan_row, member_name), .dimension = &dimension_length, .unit = "mm",             \
                                         .flags = (more)
#define ANGLE(member_name, more)                                                                   \
    COLUMN(struct fan_row, member_name), .dimension = &dimension_angle, .unit = "mrad",            \
                                         .flags = (more)
#define PLAIN(member_name, more) COLUMN(struct fan_row, member_name), .flags = (more)

/* With what people read of the transverse aberrations, and of the path differences. */
#define FAN_COLUMNS(off, path)                                                                     \
    ANALYSIS_POINT_COLUMNS(struct fan_row, point), ANALYSIS_DEFOCUS_COLUMN(struct fan_row, point), \
        ANALYSIS_WAVELENGTH_COLUMN(struct fan_row, point),                                         \
        {PLAIN(section, COLUMN_BRIEF), .name = "section", .label = "section",                      \
         .help = "tangential: through the axis and the field point; or sagittal, across it"},      \
        {PLAIN(pupil_x, COLUMN_BRIEF), .name = "pupil_x", .label = "pupil x",                      \
         .help = "where the ray crosses the pupil, in units of its radius"},                       \
        {PLAIN(pupil_y, COLUMN_BRIEF), .name = "pupil_y", .label = "pupil y",                      \
         .help = "the same upwards"},                                                              \
        {SMALL(dx, (off) | COLUMN_SPARSE), .name = "dx", .label = "dx",                            \
         .help = "from the reference to where the ray meets the image plane, in x"},               \
        {SMALL(dy, (off) | COLUMN_SPARSE), .name = "dy", .label = "dy", .help = "and in y"},       \
        {ANGLE(dx_angle, (off) | COLUMN_SPARSE), .name = "dx", .label = "dx",                      \
         .help = "the same of an image at infinity: sine of the angle from the chief ray"},        \
        {ANGLE(dy_angle, (off) | COLUMN_SPARSE), .name = "dy", .label = "dy", .help = "and in y"}, \
        {PLAIN(opd, (path)), .name = "opd_waves", .label = "OPD, waves", .symbol = "W",            \
         .help = "optical path of the chief ray less that of the ray, to the reference sphere, "   \
                 "in wavelengths of its own"},                                                     \
        {PLAIN(status, COLUMN_BRIEF), .name = "status", .label = "status",                         \
         .help = "ok, miss, total_reflection, clipped or not_converged"},                          \
        {PLAIN(surface, COLUMN_BRIEF | COLUMN_SPARSE), .name = "surface", .label = "surface",      \
         .help = "where the ray was lost, from 1, the stop counted; of a ray on the edge of the "  \
                 "clear pupil what ends it"},                                                      \
        {PLACE(at_x, COLUMN_HIDDEN), .name = "reference_x", .label = "reference x",                \
         .help = "the reference on the image plane"},                                              \
        {PLACE(at_y, COLUMN_HIDDEN), .name = "reference_y", .label = "reference y",                \
         .help = "the same upwards"},                                                              \
        {PLACE(at_z, COLUMN_HIDDEN), .name = "reference_z", .label = "reference z",                \
         .help = "of the best-fitting sphere its centre behind that plane, where dx and dy are "   \
                 "too; else 0"},                                                                   \
        {PLACE(radius, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "sphere", .label = "sphere",      \
         .help = "radius of the reference sphere"},                                                \
        {PLAIN(reference, COLUMN_ASSUMED), .name = "reference",                                    \
         .depends = "reference lens wavelength spectrum", .label = "reference",                    \
         .help = "reference point of the aberrations"},                                            \
        ANALYSIS_SPECTRUM_COLUMN(struct fan_row, point),                                           \
        ANALYSIS_TAIL_COLUMNS(struct fan_row, point)

static const struct column transverse_columns[] = {FAN_COLUMNS(COLUMN_BRIEF, COLUMN_HIDDEN)};
static const struct column opd_columns[] = {FAN_COLUMNS(COLUMN_HIDDEN, COLUMN_BRIEF)};

static const struct sheet transverse_sheet = SHEET(transverse_columns, struct fan_row);
static const struct sheet opd_sheet = SHEET(opd_columns, struct fan_row);
static const struct sheet *const sheets[] = {&transverse_sheet, &opd_sheet, NULL};

static const struct sheet *fan_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return ((const struct fan_input *)data)->show == FAN_OPD ? &opd_sheet : &transverse_sheet;
}

/* What the rows of a field have in common. */
static struct fan_row row_of_fan(const struct analysis_asked *asked,
                                 const struct analysis_case *one, size_t field,
                                 const struct fan *fan)
{
    const struct fan_input *input = asked->input;
    struct arena *arena = asked->run->arena;
    struct fan_row row;
    analysis_begin_row(asked, one, field, &row);
    if (input->reference == WAVE_CHIEF) {
        row.point.spectrum = NULL; /* their weights are not used */
    }
    analysis_warn(asked, &row.point, fan->no_opd);
    analysis_warn(asked, &row.point, lens_island_warning(&fan->islands, arena));
    row.reference = wave_reference_words(one, (enum wave_about)input->reference, arena);
    if (!fan->is_angular) {
        row.at_x = fan->reference[0];
        row.at_y = fan->reference[1];
        row.at_z = fan->reference[2];
    }
    row.radius = fan->no_opd != NULL ? (double)NAN : fan->radius;
    return row;
}

static void fan_fill(const struct fan *fan, const struct fan_ray *ray, struct fan_row *row)
{
    row->pupil_x = ray->pupil[0];
    row->pupil_y = ray->pupil[1];
    *(fan->is_angular ? &row->dx_angle : &row->dx) = ray->off[0];
    *(fan->is_angular ? &row->dy_angle : &row->dy) = ray->off[1];
    row->opd = 1000 * ray->opd / row->point.wavelength;
    row->status = ray_status_name(ray->status);
    row->surface = ray->surface > 0 ? (long)ray->surface : NO_INTEGER;
}

static bool fan_find(const struct analysis_case *one, size_t field, const void *context,
                     void *found, struct error *error)
{
    const struct analysis_asked *asked = context;
    return fan_of_case(one, field, asked->input, one->setup->arena, found, error);
}

static bool fan_take(const struct analysis_case *one, size_t field, const void *found,
                     void *context, struct error *error)
{
    static const char *const names[FAN_SECTIONS] = {"tangential", "sagittal"};
    const struct analysis_asked *asked = context;
    const struct fan *fan = found;
    struct fan_row row = row_of_fan(asked, one, field, fan);
    struct fan_ray *rays = ARENA_ARRAY(asked->run->arena, fan->points + FAN_ENDS, struct fan_ray);
    (void)error;
    for (size_t g = 0; g < one->setup->wavelength_count; g++) {
        row.point.wavelength = one->setup->wavelengths[g].wavelength;
        for (size_t s = 0; s < FAN_SECTIONS; s++) {
            row.section = names[s];
            const size_t count = fan_line(fan, g, (enum fan_section)s, rays);
            for (size_t i = 0; i < count; i++) {
                fan_fill(fan, &rays[i], &row);
                if (!run_emit(asked->run, &row)) {
                    return false;
                }
            }
        }
    }
    return true;
}

static const struct analysis_rows rows = {
    &fan_policy,
    &transverse_sheet,
    NULL,
    {.find = fan_find, .found_size = sizeof(struct fan), .take = fan_take}};

static bool fan_run(const void *data, struct run *run, struct error *error)
{
    const struct fan_input *input = data;
    return (input->points % 2 == 1 ||
            fail(error, ERROR_USAGE,
                 "{--points} %ld: an odd number, so that one ray lies in the middle",
                 input->points)) &&
           analysis_answer_rows(input, &rows, run, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the fans: two panels a field"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = fan_figure},
};

static const struct explanation explanations[] = {
    {"opd_waves",
     "W = OPL(chief ray) - OPL(ray), to the sphere about the reference through the "
     "chief ray's crossing of the paraxial exit pupil",
     "[Welford86]", "no sphere where that pupil lies in the image plane"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"fan double-gauss --plot fans.svg", "ray fans of all fields and wavelengths"},
    {"fan double-gauss --show opd --plot paths.svg", "the same as optical path differences"},
    {"fan double-gauss --field 14deg -w d --points 5", "few rays of one field, at one wavelength"},
    {"fan cooke-triplet-50 --reference centroid --csv", "from the centroid, for another program"},
    {NULL, NULL},
};

const struct command command_fan = {
    .name = "fan",
    .group = "analyses",
    .summary = "ray fans: aberrations along two sections of the pupil",
    COMMAND_ASKS(struct fan_input),
    .sheet = SHEET(transverse_columns, struct fan_row),
    .choose_sheet = fan_choose_sheet,
    .sheets = sheets,
    .explanations = explanations,
    .run = fan_run,
    .makes_many = command_always_many,
    .brings = analysis_brings,
    .threads = analysis_threads,
    .varies = analysis_varies,
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
};
