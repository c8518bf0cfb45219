/* commands/analysis/cmd_psf.c - lenscalc psf: images of points by waves. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_fields.h"
#include "commands/analysis/analysis_map.h"
#include "commands/analysis/psf_input.h"

#include <string.h>

static const struct word methods[] = {
    [PSF_AUTO] = {"auto", "plane, or rays where the phase turns too often for it"},
    [PSF_PLANE] = {"plane", "plane waves, between the edges of the pupil"},
    [PSF_FFT] = {"fft", "the same on a grid, by a fast Fourier transform"},
    [PSF_HUYGENS] = {"huygens", "spherical wavelets from the reference sphere"},
    [PSF_RAYS] = {"rays", "where rays meet the pixels, as if light had no wavelength"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS(struct psf_input, question, "all of the lens by their weights, together",
                     ", or the fields of one question and the pixels of wavelets"),
    ANALYSIS_FIELD_OPTIONS(struct psf_input, question),
    ANALYSIS_SPECTRUM_OPTION(struct psf_input, question),
    {OPTION(struct psf_input, method), .name = "method", .words = methods, .fallback = "auto",
     .value = "METHOD", .help = "how the waves are added up"},
    {OPTION(struct psf_input, size), .name = "size", .lowest = 8, .highest = PSF_SIZE_MOST,
     .fallback = "128", .value = "COUNT", .help = "pixels along a side of the image"},
    {OPTION(struct psf_input, pitch), .name = "pitch", .column = "pitch",
     .dimension = &dimension_length, .unit = "um", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "side of a pixel; default a quarter of what the waves resolve, more where rays spread "
             "farther"},
    {OPTION(struct psf_input, pitch_angle), .name = "pitch-angle", .quantity = "pitch",
     .dimension = &dimension_angle, .unit = "mrad", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .value = "ANGLE", .excludes = "pitch",
     .help = "the same of an image infinitely far away"},
    {OPTION(struct psf_input, log), .name = "log", .wants = "plot|map",
     .help = "colours by the logarithm, over five decades"},
    {OPTION(struct psf_input, question.aim), .name = "aim", .words = analysis_aims,
     .fallback = "stop", .value = "WHERE", .help = "pupil that limits the beam"},
    ANALYSIS_CLIP_OPTIONS(struct psf_input, question),
};

struct psf_row {
    struct analysis_point point;
    double peak;
    double peak_x, peak_y, centroid_x, centroid_y, width_x, width_y, radius80, pitch; /* mm */
    double radius80_error;
    /* rad */
    double peak_x_angle, peak_y_angle, centroid_x_angle, centroid_y_angle;
    double width_x_angle, width_y_angle, radius80_angle, radius80_error_angle, pitch_angle;
    double inside;
    const char *method;
};

#define SMALL(member_name, more)                                                                   \
    COLUMN(struct psf_row, member_name), .dimension = &dimension_length, .unit = "um",             \
                                         .flags = (more) | COLUMN_SPARSE
#define ANGLE(member_name, more)                                                                   \
    COLUMN(struct psf_row, member_name), .dimension = &dimension_angle, .unit = "mrad",            \
                                         .flags = (more) | COLUMN_SPARSE

static const struct column columns[] = {
    ANALYSIS_POINT_COLUMNS(struct psf_row, point),
    ANALYSIS_DEFOCUS_COLUMN(struct psf_row, point),
    ANALYSIS_WAVELENGTH_COLUMN(struct psf_row, point),
    {COLUMN(struct psf_row, peak), .flags = COLUMN_BRIEF, .name = "peak", .label = "peak",
     .symbol = "S",
     .help = "over that of a perfect image through the same pupil: the Strehl ratio"},
    {SMALL(peak_x, 0), .name = "peak_x", .label = "peak x", .help = "of it, from the chief ray"},
    {SMALL(peak_y, 0), .name = "peak_y", .label = "peak y", .help = "the same upwards"},
    {SMALL(centroid_x, 0), .name = "centroid_x", .label = "centroid x",
     .help = "of the pixels, from the chief ray"},
    {SMALL(centroid_y, 0), .name = "centroid_y", .label = "centroid y", .help = "the same upwards"},
    {SMALL(width_x, COLUMN_BRIEF), .name = "width_x", .label = "width in x",
     .help = "at half the peak, through it; absent where the image ends before"},
    {SMALL(width_y, COLUMN_BRIEF), .name = "width_y", .label = "width in y",
     .help = "the same upwards"},
    {SMALL(radius80, COLUMN_BRIEF), .name = "radius80", .label = "radius of 80 %",
     .help = "about the centroid, with 80 % of all light; absent where the circle is not inside or "
             "pixels are coarse"},
    {SMALL(radius80_error, COLUMN_HIDDEN), .name = "radius80_error", .label = "error of that",
     .help = "what that radius may be off"},
    {COLUMN(struct psf_row, inside), .dimension = &dimension_ratio, .unit = "%",
     .flags = COLUMN_BRIEF, .name = "inside", .label = "light inside",
     .help = "share of all light that the pixels have; absent where they are too coarse to say"},
    {SMALL(pitch, COLUMN_BRIEF), .name = "pitch", .label = "pitch", .help = "side of a pixel"},
    {ANGLE(peak_x_angle, 0), .name = "peak_x", .label = "peak x",
     .help = "the same of an image infinitely far away: sines of angles from the chief ray"},
    {ANGLE(peak_y_angle, 0), .name = "peak_y", .label = "peak y", .help = "the same upwards"},
    {ANGLE(centroid_x_angle, 0), .name = "centroid_x", .label = "centroid x", .help = "in x"},
    {ANGLE(centroid_y_angle, 0), .name = "centroid_y", .label = "centroid y",
     .help = "the same upwards"},
    {ANGLE(width_x_angle, COLUMN_BRIEF), .name = "width_x", .label = "width in x", .help = "in x"},
    {ANGLE(width_y_angle, COLUMN_BRIEF), .name = "width_y", .label = "width in y",
     .help = "the same upwards"},
    {ANGLE(radius80_angle, COLUMN_BRIEF), .name = "radius80", .label = "radius of 80 %",
     .help = "with 80 % of all light"},
    {ANGLE(radius80_error_angle, COLUMN_HIDDEN), .name = "radius80_error", .label = "error of that",
     .help = "what that radius may be off"},
    {ANGLE(pitch_angle, COLUMN_BRIEF), .name = "pitch", .label = "pitch",
     .help = "side of a pixel"},
    {COLUMN(struct psf_row, method), .flags = COLUMN_ASSUMED, .name = "method", .depends = "method",
     .label = "method", .help = "how the waves are added up"},
    ANALYSIS_SPECTRUM_COLUMN(struct psf_row, point),
    ANALYSIS_TAIL_COLUMNS(struct psf_row, point),
};

static bool psf_check_input(const struct analysis_case *one, const void *context,
                            struct error *error)
{
    const struct analysis_asked *asked = context;
    return psf_check(one, asked->input, error);
}

static bool psf_row_find(const struct analysis_case *one, size_t field, const void *context,
                         void *found, struct error *error)
{
    const struct analysis_asked *asked = context;
    return psf_of_case(one, field, asked->input, one->setup->arena, found, error);
}

static void psf_fill(const struct psf *psf, struct psf_row *row)
{
    const double values[] = {psf->peak_at[0],  psf->peak_at[1], psf->centroid[0],
                             psf->centroid[1], psf->width[0],   psf->width[1],
                             psf->radius80,    psf->pitch,      psf->radius80_error};
    double *lengths[] = {&row->peak_x,     &row->peak_y,  &row->centroid_x,
                         &row->centroid_y, &row->width_x, &row->width_y,
                         &row->radius80,   &row->pitch,   &row->radius80_error};
    double *angles[] = {&row->peak_x_angle,     &row->peak_y_angle,  &row->centroid_x_angle,
                        &row->centroid_y_angle, &row->width_x_angle, &row->width_y_angle,
                        &row->radius80_angle,   &row->pitch_angle,   &row->radius80_error_angle};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        *(psf->is_angular ? angles[i] : lengths[i]) = values[i];
    }
    row->peak = psf->peak;
    row->inside = psf->inside;
}

/* What amplitudes and phases are those of, of an image infinitely far away. */
static const char *const angular_words[PSF_METHODS] = {
    [PSF_PLANE] = "plane waves, amplitude squared = energy per area across the chief ray, phase on "
                  "a plane there",
    [PSF_FFT] = "fast Fourier transform, amplitude squared = energy per area across the chief ray, "
                "phase on a plane there",
    [PSF_HUYGENS] = NULL};

static bool psf_take(const struct analysis_case *one, size_t field, const void *found,
                     void *context, struct error *error)
{
    const struct analysis_asked *asked = context;
    const struct psf *psf = found;
    struct psf_row row;
    (void)error;
    analysis_begin_row(asked, one, field, &row);
    psf_fill(psf, &row);
    if (psf->is_angular) {
        row.method = angular_words[psf->method];
    }
    if (psf->method == PSF_RAYS) {
        row.method = "rays as if light had no wavelength: densities of energy over the pixels";
    }
    if (psf->turns > 0) {
        analysis_warn(asked, &row.point,
                      arena_printf(asked->run->arena,
                                   "the phase turns %.0f times across the pupil, and sums of waves "
                                   "take %d: by rays, without diffraction",
                                   psf->turns, PSF_TURNS_MOST));
    }
    if (!(psf->pitch < psf->finest)) {
        analysis_warn(
            asked, &row.point,
            arena_printf(
                asked->run->arena,
                "pixels of %.4g %s miss light between them: shares of it want less than %.4g",
                1000 * psf->pitch, psf->is_angular ? "mrad" : "um", 1000 * psf->finest));
    }
    analysis_warn(asked, &row.point, lens_island_warning(&psf->islands, asked->run->arena));
    return run_emit(asked->run, &row);
}

static void psf_repeat(const void *data, void *row)
{
    static const char *const words[PSF_METHODS] = {
        [PSF_AUTO] = "plane waves, amplitude squared = energy per area of direction cosines in "
                     "the image space, phase on the reference sphere",
        [PSF_PLANE] = "plane waves, amplitude squared = energy per area of direction cosines in "
                      "the image space, phase on the reference sphere",
        [PSF_FFT] = "fast Fourier transform, amplitude squared = energy per area of direction "
                    "cosines in the image space, phase on the reference sphere",
        [PSF_HUYGENS] = "spherical wavelets from the reference sphere, amplitude squared = energy "
                        "per area of direction cosines in the image space"};
    ((struct psf_row *)row)->method = words[((const struct psf_input *)data)->method];
}

static const struct sheet sheet = SHEET(columns, struct psf_row);
static const struct analysis_rows rows = {&psf_policy,
                                          &sheet,
                                          psf_repeat,
                                          {.check = psf_check_input,
                                           .find = psf_row_find,
                                           .found_size = sizeof(struct psf),
                                           .take = psf_take}};

static bool psf_run(const void *data, struct run *run, struct error *error)
{
    return analysis_answer_rows(data, &rows, run, error);
}

static bool psf_makes_many(const void *data)
{
    return analysis_makes_many(&((const struct psf_input *)data)->question, &psf_policy);
}

static bool psf_check_map(const struct artifact_job *job, struct error *error)
{
    const struct psf_input *input = job->inputs[0];
    const bool numbers = job->type != NULL && strcmp(job->type->ending, ".pfm") == 0;
    return !(numbers && input->log) || asking_given(job->asking, "plot") ||
           fail(error, ERROR_USAGE, "{--log} is of colours, and .pfm has numbers");
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the images, by field and through focus"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = psf_page},
    {ARTIFACT_OPTION("map", map_types,
                     "write the image of one field: colours, or numbers, 1 = a perfect peak"),
     .scope = ARTIFACT_OF_ANSWER, .is_binary = true, .check = psf_check_map, .make = psf_file},
};

static const struct explanation explanations[] = {
    {"peak",
     "{S} = max |E|^2/|E0|^2, E = integral of A exp(2 pi i (W - n a x/wavelength)) over direction "
     "cosines a of the image space, E0 at the reference with W = 0",
     "[Goodman05], [BornWolf99] 9.1",
     "A^2: energy per area of direction cosines; W: on the reference sphere about the chief ray, "
     "at "
     "its points named by the direction to the centre"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"psf double-gauss -N 5.6", "the images of all fields, all wavelengths together"},
    {"psf questar-35 --log --plot images.svg", "those of a telescope, drawn"},
    {"psf double-gauss -N 8 --field 0 -w d --defocus -0.2..0.2#5 --plot focus.svg",
     "through focus, drawn"},
    {"psf double-gauss -N 8 --field 14deg --method huygens --size 64 --map image.pfm",
     "the numbers for another program"},
    {NULL, NULL},
};

const struct command command_psf = {
    .name = "psf",
    .group = "analyses",
    .summary = "images of points by waves: Strehl ratio, widths, maps",
    COMMAND_ASKS(struct psf_input),
    COMMAND_ANSWERS(struct psf_row),
    .run = psf_run,
    .makes_many = psf_makes_many,
    .brings = analysis_brings,
    .threads = analysis_threads,
    .varies = analysis_varies,
    .cell = "peak",
    COMMAND_MAKES(artifacts),
    .most_answers = 10000,
};
