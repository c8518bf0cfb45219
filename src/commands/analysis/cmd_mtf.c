/* commands/analysis/cmd_mtf.c - lenscalc mtf: contrast of the image, by frequency. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/field_map.h"
#include "commands/analysis/mtf_figure.h"

#include <string.h>

static const struct word methods[] = {
    [MTF_BY_WAVES] = {"diffraction", "from the wave front, with diffraction"},
    [MTF_BY_RAYS] = {"geometric", "from rays, without diffraction"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS("all of the lens by their weights, together",
                     ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct mtf_input, question),
    {OPTION(struct mtf_input, frequency), .name = "frequency", .quantity = "spatial frequency",
     .column = "frequency", .dimension = &dimension_frequency, .unit = "per_mm", .lowest = 0,
     .highest = 1e6, .value = "FREQUENCY",
     .help = "frequency in the image plane; default 10, 20, 40 and 80 per mm"},
    {OPTION(struct mtf_input, method), .name = "method", .words = methods,
     .fallback = "diffraction", .value = "METHOD", .help = "diffraction or geometric MTF"},
    {OPTION(struct mtf_input, pitch), .name = "pitch", .dimension = &dimension_length, .unit = "um",
     .lowest = 0, .highest = 1, .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "pitch of square pixels, whose MTF is included"},
    {OPTION(struct mtf_input, square), .name = "square",
     .help = "contrast of square bars, as on test charts, in place of sines"},
    ANALYSIS_AIM_OPTION(NULL, "pupil that limits the beam"),
    {OPTION(struct mtf_input, question.error), .name = "error", .column = "error_wanted",
     .dimension = &dimension_number, .lowest = 1e-8, .highest = 0.1, .fallback = "1e-4",
     .value = "NUMBER", .help = "sampling is refined until the error of the MTF is below this"},
    ANALYSIS_CLIP_OPTIONS,
    ANALYSIS_OVER_FIELD_OPTIONS,
};

struct mtf_row {
    struct analysis_point point;
    double frequency;
    struct mtf mtf;
    double limit, cutoff[MTF_DIRECTIONS]; /* cutoff: 1/mm */
    const char *method, *bars;
};

#define PLAIN(member_name, more) COLUMN(struct mtf_row, member_name), .flags = (more)
#define ANGLE(member_name)                                                                         \
    COLUMN_OF_ANGLE(struct mtf_row, member_name, "deg"), .flags = COLUMN_HIDDEN
#define FREQUENCY(member_name, more)                                                               \
    COLUMN(struct mtf_row, member_name), .dimension = &dimension_frequency, .unit = "per_mm",      \
                                         .flags = (more)

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {FREQUENCY(frequency, COLUMN_BRIEF | COLUMN_ECHO), .name = "frequency", .symbol = "f",
     .help = "in the image plane"},
    {PLAIN(mtf.contrast[MTF_TANGENTIAL], COLUMN_BRIEF), .name = "tangential", .symbol = "T",
     .help = "contrast of lines perpendicular to the plane of the axis and the field point"},
    {PLAIN(mtf.contrast[MTF_SAGITTAL], COLUMN_BRIEF), .name = "sagittal",
     .help = "contrast of lines parallel to that plane"},
    {PLAIN(limit, COLUMN_BRIEF), .name = "limit",
     .help = "diffraction limit: the same pupil with a perfect wave front, the higher of the two "
             "directions"},
    {PLAIN(mtf.limit[MTF_TANGENTIAL], COLUMN_HIDDEN), .name = "limit_tangential",
     .label = "tangential limit", .help = "diffraction limit of tangential contrast"},
    {PLAIN(mtf.limit[MTF_SAGITTAL], COLUMN_HIDDEN), .name = "limit_sagittal",
     .label = "sagittal limit", .help = "diffraction limit of sagittal contrast"},
    {ANGLE(mtf.phase[MTF_TANGENTIAL]), .name = "phase_tangential", .label = "tangential phase",
     .help = "phase of the transfer function about the chief ray: shift of the lines, negative "
             "outwards"},
    {ANGLE(mtf.phase[MTF_SAGITTAL]), .name = "phase_sagittal", .label = "sagittal phase",
     .help = "the same for sagittal contrast"},
    {FREQUENCY(cutoff[MTF_TANGENTIAL], 0), .name = "cutoff_tangential",
     .label = "tangential cut-off", .help = "cutoff frequency: no diffraction contrast beyond it"},
    {FREQUENCY(cutoff[MTF_SAGITTAL], 0), .name = "cutoff_sagittal", .label = "sagittal cut-off",
     .help = "the same for sagittal contrast"},
    {PLAIN(mtf.error, COLUMN_HIDDEN), .name = "contrast_error", .label = "error of the contrast",
     .help = "estimated error of the contrasts"},
    {PLAIN(method, COLUMN_ASSUMED), .name = "method", .depends = "method",
     .help = "diffraction or geometric MTF"},
    {PLAIN(bars, COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_TIED), .name = "bars", .with = "square",
     .depends = "square", .help = "what the contrasts are of, where not of sines"},
    ANALYSIS_SPECTRUM_COLUMN,
    ANALYSIS_TAIL_COLUMNS,
};

/* What is found of a field. */
enum { FREQUENCIES = 4 };
struct mtf_found {
    struct mtf_source source;
    double frequencies[FREQUENCIES];
    struct mtf contrasts[FREQUENCIES];
    size_t count;
};

static bool mtf_row_find(const struct analysis_cursor *at, const struct analysis_case *one,
                         size_t field, void *room, struct error *error)
{
    static const double usual[FREQUENCIES] = {10, 20, 40, 80};
    const struct mtf_input *input = at->input;
    const bool one_frequency = !isnan(input->frequency);
    struct mtf_found *found = room;
    found->count = one_frequency ? 1 : FREQUENCIES;
    bool done = mtf_field_open(at, one, field, &found->source, error);
    for (size_t i = 0; i < found->count && done; i++) {
        found->frequencies[i] = one_frequency ? input->frequency : usual[i];
        done = mtf_with_pixels(&found->source, input, found->frequencies[i], one->setup->arena,
                               &found->contrasts[i], error);
    }
    return done;
}

static void mtf_row_warn(const struct analysis_cursor *at, const struct mtf_source *source,
                         const struct mtf *mtf, struct mtf_row *row)
{
    analysis_warn(at, &row->point, lens_island_warning(&source->pupils.islands, at->run->arena));
    if (source->pupils.list == NULL) {
        analysis_warn(at, &row->point, "an ideal thick lens has no optical path, no limits");
    }
    if (!mtf->has_converged) {
        analysis_warn(at, &row->point,
                      isnan(mtf->contrast[0]) || isnan(mtf->contrast[1])
                          ? "the wave front is too steep or too rough for the diffraction MTF"
                          : "the contrast has not converged: see contrast_error");
    }
}

static const struct sheet sheet = SHEET(columns, struct mtf_row);

static bool mtf_run(const void *data, struct run *run, struct error *error)
{
    static const char *const words[] = {
        [MTF_BY_WAVES] = "diffraction, amplitude squared = energy per area of direction cosines in "
                         "the image space, phase on the reference sphere",
        [MTF_BY_RAYS] = "geometric; limits by diffraction"};
    const struct mtf_input *input = data;
    struct analysis_cursor at =
        analysis_begin_finding(input, &mtf_policy, run, mtf_row_find, sizeof(struct mtf_found));
    while (analysis_next(&at, error)) {
        const struct mtf_found *found = at.found;
        const size_t count = at.lost == NULL ? found->count : 1;
        for (size_t i = 0; i < count; i++) {
            struct mtf_row row;
            analysis_begin_row(&at, &sheet, &row);
            row.frequency = input->frequency;
            row.method = words[input->method];
            row.bars = input->square ? "square, by the sines that they are made of" : NULL;
            if (at.lost == NULL) {
                row.frequency = found->frequencies[i];
                row.mtf = found->contrasts[i];
                row.limit = fmax(row.mtf.limit[0], row.mtf.limit[1]);
                memcpy(row.cutoff, found->source.cutoff, sizeof row.cutoff);
                mtf_row_warn(&at, &found->source, &row.mtf, &row);
            }
            if (!run_emit(run, &row)) {
                return true;
            }
        }
    }
    return error->code == ERROR_NONE;
}

static bool mtf_makes_many(const void *data)
{
    return isnan(((const struct mtf_input *)data)->frequency) || analysis_several(data);
}

/* -------- over the image -------- */

static bool mtf_map_find(const struct analysis_cursor *at, const struct analysis_case *one,
                         size_t field, void *found, struct error *error)
{
    const struct mtf_input *input = at->input;
    struct mtf_source *source = ARENA_NEW(one->setup->arena, struct mtf_source);
    struct mtf mtf;
    if (!mtf_field_open(at, one, field, source, error) ||
        !mtf_with_pixels(source, input, input->frequency, one->setup->arena, &mtf, error)) {
        return false;
    }
    memcpy(found, mtf.contrast, sizeof mtf.contrast);
    return true;
}

static const char *mtf_map_words(const void *data, struct arena *arena)
{
    const struct mtf_input *input = data;
    return arena_printf(arena, "%.4g/mm%s%s", input->frequency,
                        input->square ? ", square bars" : "",
                        input->method == MTF_BY_RAYS ? ", geometric" : "");
}

static bool mtf_over_field(const struct artifact_job *job, struct output *sink, struct error *error)
{
    static const struct field_map_kind kind = {.policy = &mtf_policy,
                                               .find = mtf_map_find,
                                               .values = MTF_DIRECTIONS,
                                               .what = "MTF over the image",
                                               .scale = "contrast",
                                               .highest = 1,
                                               .words = mtf_map_words};
    return field_map_make(job, &kind, sink, error);
}

static bool mtf_check_over_field(const struct artifact_job *job, struct error *error)
{
    return !isnan(((const struct mtf_input *)job->inputs[0])->frequency) ||
           fail(error, ERROR_USAGE,
                "{--over-field} maps the contrast at one frequency: give {--frequency}");
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw the MTF against frequency; against focus or field where these are lists "
                     "and --frequency is given"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = mtf_figure},
    {ARTIFACT_OPTION("over-field", drawing_types,
                     "draw the MTF at --frequency over the image, as maps of both sections"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .check = mtf_check_over_field,
     .make = mtf_over_field},
};

static const struct explanation explanations[] = {
    {"tangential",
     "{T} = |integral of P(a + d/2) P*(a - d/2)| / integral of |P|^2, d = wavelength {f}/n, "
     "P = A exp(2 pi i W) over direction cosines a of the image space",
     "[Hopkins55]",
     "A^2: energy per area of direction cosines; W: on the reference sphere about the chief ray, "
     "at "
     "its points named by the direction to the centre"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"mtf double-gauss -N 5.6", "MTF of all fields, all wavelengths together"},
    {"mtf double-gauss -N 2.8,5.6,11 --field 0 --frequency 40", "stopped down"},
    {"mtf double-gauss -N 5.6 --field 0,14 --frequency 30 --defocus -0.2..0.2#21 --plot focus.svg",
     "through focus, drawn"},
    {"mtf double-gauss -N 5.6 --field 0 --square", "of square bars, as on a test chart"},
    {"mtf double-gauss --method geometric --frequency 10 --pitch 6um", "geometric, with pixels"},
    {NULL, NULL},
};

const struct command command_mtf = {
    .name = "mtf",
    .summary = "modulation transfer function (contrast), diffraction or geometric",
    COMMAND_ASKS(struct mtf_input),
    COMMAND_ANSWERS(struct mtf_row),
    .run = mtf_run,
    .makes_many = mtf_makes_many,
    ANALYSIS_COMMAND,
    .cell = "tangential",
    COMMAND_MAKES(artifacts),
    .most_answers = 10000,
};
