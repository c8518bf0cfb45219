/* commands/analysis/cmd_mtf.c - lenscalc mtf: contrast of the image, by frequency. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/mtf_input.h"

static const struct word methods[] = {
    [MTF_BY_WAVES] = {"diffraction", "by waves"},
    [MTF_BY_RAYS] = {"geometric", "by rays, as if light had no wavelength"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS(struct mtf_input, question, "all of the lens by their weights, together"),
    ANALYSIS_FIELD_OPTIONS(struct mtf_input, question),
    ANALYSIS_SPECTRUM_OPTION(struct mtf_input, question),
    {OPTION(struct mtf_input, frequency), .name = "frequency", .quantity = "spatial frequency",
     .column = "frequency", .dimension = &dimension_frequency, .unit = "per_mm", .lowest = 0,
     .highest = 1e6, .value = "FREQUENCY",
     .help = "frequency in the image plane; default 10, 20, 40 and 80 per mm"},
    {OPTION(struct mtf_input, method), .name = "method", .words = methods,
     .fallback = "diffraction", .value = "METHOD", .help = "by waves or by rays"},
    {OPTION(struct mtf_input, pitch), .name = "pitch", .dimension = &dimension_length, .unit = "um",
     .lowest = 0, .highest = 1, .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "pitch of square pixels, whose own blur is counted in"},
    {OPTION(struct mtf_input, question.aim), .name = "aim", .words = analysis_aims,
     .fallback = "stop", .value = "WHERE", .help = "pupil that limits the beam"},
    {OPTION(struct mtf_input, question.error), .name = "error", .dimension = &dimension_number,
     .lowest = 1e-8, .highest = 0.1, .fallback = "1e-4", .value = "NUMBER",
     .help = "points are added until contrasts are right to this"},
    ANALYSIS_CLIP_OPTIONS(struct mtf_input, question),
};

struct row {
    struct analysis_point point;
    double frequency;
    double tangential, sagittal, limit, limit_tangential, limit_sagittal;
    double phase_tangential, phase_sagittal;   /* rad */
    double cutoff_tangential, cutoff_sagittal; /* 1/mm */
    double error;
    const char *method;
};

#define PLAIN(member_name, more) COLUMN(struct row, member_name), .flags = (more)
#define ANGLE(member_name)                                                                         \
    COLUMN(struct row, member_name), .dimension = &dimension_angle, .unit = "deg",                 \
                                     .flags = COLUMN_HIDDEN
#define FREQUENCY(member_name, more)                                                               \
    COLUMN(struct row, member_name), .dimension = &dimension_frequency, .unit = "per_mm",          \
                                     .flags = (more)

static const struct column columns[] = {
    ANALYSIS_POINT_COLUMNS(struct row, point),
    ANALYSIS_DEFOCUS_COLUMN(struct row, point),
    ANALYSIS_WAVELENGTH_COLUMN(struct row, point),
    {FREQUENCY(frequency, COLUMN_BRIEF | COLUMN_ECHO), .name = "frequency", .label = "frequency",
     .symbol = "f", .help = "in the image plane"},
    {PLAIN(tangential, COLUMN_BRIEF), .name = "tangential", .label = "tangential", .symbol = "T",
     .help = "contrast of lines across the plane of the axis and the field point"},
    {PLAIN(sagittal, COLUMN_BRIEF), .name = "sagittal", .label = "sagittal",
     .help = "contrast of lines along it"},
    {PLAIN(limit, COLUMN_BRIEF), .name = "limit", .label = "limit",
     .help = "of the same pupil with a perfect wave front, the higher of both directions"},
    {PLAIN(limit_tangential, COLUMN_HIDDEN), .name = "limit_tangential",
     .label = "tangential limit", .help = "of lines across"},
    {PLAIN(limit_sagittal, COLUMN_HIDDEN), .name = "limit_sagittal", .label = "sagittal limit",
     .help = "of lines along"},
    {ANGLE(phase_tangential), .name = "phase_tangential", .label = "tangential phase",
     .help = "of the transfer function about the chief ray: where lines lie, below 0 outwards"},
    {ANGLE(phase_sagittal), .name = "phase_sagittal", .label = "sagittal phase",
     .help = "the same of lines along"},
    {FREQUENCY(cutoff_tangential, 0), .name = "cutoff_tangential", .label = "tangential cut-off",
     .help = "frequency from which on there is no contrast by waves"},
    {FREQUENCY(cutoff_sagittal, 0), .name = "cutoff_sagittal", .label = "sagittal cut-off",
     .help = "the same of lines along"},
    {PLAIN(error, COLUMN_HIDDEN), .name = "error", .label = "error",
     .help = "what the contrasts may be off"},
    {PLAIN(method, COLUMN_ASSUMED), .name = "method", .depends = "method", .label = "method",
     .help = "by waves or by rays"},
    ANALYSIS_SPECTRUM_COLUMN(struct row, point),
    ANALYSIS_TAIL_COLUMNS(struct row, point),
};

/* Where the rows go. */
struct asked {
    const struct mtf_input *input;
    struct run *run;
};

static struct row row_of(const struct analysis_point *point, double frequency)
{
    return (struct row){.point = *point,
                        .frequency = frequency,
                        .tangential = NAN,
                        .sagittal = NAN,
                        .limit = NAN,
                        .limit_tangential = NAN,
                        .limit_sagittal = NAN,
                        .phase_tangential = NAN,
                        .phase_sagittal = NAN,
                        .cutoff_tangential = NAN,
                        .cutoff_sagittal = NAN,
                        .error = NAN};
}

static void fill(const struct mtf *mtf, const struct mtf_source *source, struct row *row)
{
    row->tangential = mtf->contrast[MTF_TANGENTIAL];
    row->sagittal = mtf->contrast[MTF_SAGITTAL];
    row->limit_tangential = mtf->limit[MTF_TANGENTIAL];
    row->limit_sagittal = mtf->limit[MTF_SAGITTAL];
    row->limit = fmax(row->limit_tangential, row->limit_sagittal);
    row->phase_tangential = mtf->phase[MTF_TANGENTIAL];
    row->phase_sagittal = mtf->phase[MTF_SAGITTAL];
    row->cutoff_tangential = source->cutoff[MTF_TANGENTIAL];
    row->cutoff_sagittal = source->cutoff[MTF_SAGITTAL];
    row->error = mtf->error;
}

static bool answer(const struct analysis_case *one, size_t field, void *context,
                   struct error *error)
{
    static const double usual[] = {10, 20, 40, 80};
    static const char *const words[] = {
        [MTF_BY_WAVES] = "diffraction, amplitude squared = energy per area of direction cosines in "
                         "the image space, phase on the reference sphere",
        [MTF_BY_RAYS] = "geometric; limits by waves"};
    const struct asked *asked = context;
    struct arena *arena = asked->run->arena;
    struct mtf_source source;
    if (!mtf_of_case(one, field, asked->input, arena, &source, error)) {
        return false;
    }
    const bool one_frequency = !isnan(asked->input->frequency);
    const struct analysis_point point = analysis_point_of(one, field);
    for (size_t i = 0; i < (one_frequency ? 1 : sizeof usual / sizeof usual[0]); i++) {
        struct row row = row_of(&point, one_frequency ? asked->input->frequency : usual[i]);
        struct mtf mtf;
        if (!mtf_with_pixels(&source, asked->input, row.frequency, arena, &mtf, error)) {
            return false;
        }
        fill(&mtf, &source, &row);
        row.method = words[asked->input->method];
        row.point.warning = lens_warnings_join(
            row.point.warning, lens_island_warning(&source.pupils.islands, arena), arena);
        if (!mtf.has_converged) {
            row.point.warning = lens_warnings_join(
                row.point.warning, "the contrast has not converged: see its error", arena);
        }
        if (!run_emit(asked->run, &row)) {
            return false;
        }
    }
    return true;
}

static bool lost(const struct analysis_point *point, void *context)
{
    const struct asked *asked = context;
    struct row row = row_of(point, asked->input->frequency);
    return run_emit(asked->run, &row);
}

static const struct analysis_answers answers = {answer, lost};

static bool run(const void *data, struct run *run, struct error *error)
{
    const struct mtf_input *input = data;
    struct asked asked = {input, run};
    return analysis_each_field(&input->question, &mtf_policy, run, &answers, &asked, error);
}

static bool makes_many(const void *data)
{
    const struct mtf_input *input = data;
    return isnan(input->frequency) || analysis_makes_many(&input->question, &mtf_policy);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw contrast against frequency; against focus or field where these are "
                     "lists and --frequency is given"),
     .scope = ARTIFACT_OF_SWEEP, .make = mtf_figure},
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
    {"mtf double-gauss -N 5.6", "contrast of all fields, all wavelengths together"},
    {"mtf double-gauss -N 2.8,5.6,11 --field 0 --frequency 40", "stopped down"},
    {"mtf double-gauss -N 5.6 --field 0,14 --frequency 30 --defocus -0.2..0.2#21 --plot focus.svg",
     "through focus, drawn"},
    {"mtf double-gauss --method geometric --frequency 10 --pitch 6um", "by rays, with pixels"},
    {NULL, NULL},
};

const struct command command_mtf = {
    .name = "mtf",
    .group = "analyses",
    .summary = "contrast of the image by spatial frequency, by waves or by rays",
    COMMAND_ASKS(struct mtf_input),
    COMMAND_ANSWERS(struct row),
    .makes_many = makes_many,
    .brings = analysis_brings,
    .threads = analysis_threads,
    .varies = analysis_varies,
    .cell = "tangential",
    COMMAND_MAKES(artifacts),
};
