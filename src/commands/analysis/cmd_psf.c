/* commands/analysis/cmd_psf.c - lenscalc psf: diffraction point spread functions. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf.h"
#include "commands/analysis/analysis_map.h"

#include <math.h>
#include <string.h>

struct psf_input {
    struct analysis_question question;
    int method; /* enum psf_method */
    long size;
    double pitch, pitch_angle; /* mm, rad; NaN = not given */
    bool log, linear;
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

static const struct word methods[] = {
    [PSF_AUTO] = {"auto", "plane, or rays where the phase varies too fast for it"},
    [PSF_PLANE] = {"plane", "plane waves, between the edges of the pupil"},
    [PSF_FFT] = {"fft", "the same on a grid, by a fast Fourier transform"},
    [PSF_HUYGENS] = {"huygens", "spherical wavelets from the reference sphere"},
    [PSF_RAYS] = {"rays", "geometric: where rays meet the pixels, without diffraction"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS("all of the lens by their weights, together",
                     ", or the fields of one question and the pixels of wavelets"),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct psf_input, question),
    {OPTION(struct psf_input, method), .name = "method", .words = methods, .fallback = "auto",
     .value = "METHOD", .help = "how the diffraction integral is evaluated"},
    {OPTION(struct psf_input, size), .name = "size", .lowest = 8, .highest = PSF_SIZE_MOST,
     .fallback = "128", .value = "COUNT", .help = "pixels along a side of the image"},
    {OPTION(struct psf_input, pitch), .name = "pitch", .column = "pitch",
     .dimension = &dimension_length, .unit = "um", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "side of a pixel; default a quarter of the diffraction resolution, more where the "
             "rays spread farther"},
    {OPTION(struct psf_input, pitch_angle), .name = "pitch-angle", .quantity = "pitch",
     .dimension = &dimension_angle, .unit = "mrad", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .value = "ANGLE", .excludes = "pitch",
     .help = "pixel size of an image at infinity, as an angle"},
    {OPTION(struct psf_input, log), .name = "log", .wants = "plot|map",
     .help = "logarithmic colour scale over five decades (default)"},
    {OPTION(struct psf_input, linear), .name = "linear", .wants = "plot|map", .excludes = "log",
     .help = "linear colour scale"},
    ANALYSIS_AIM_OPTION(NULL, "pupil that limits the beam"),
    ANALYSIS_CLIP_OPTIONS,
};

struct psf_row {
    struct analysis_point point;
    struct psf psf;
    const char *method;
};

static const struct column_form sines = {
    &dimension_angle, "mrad",
    "of an image infinitely far away: sines of angles from the chief ray"};

#define SMALL(member_name, more)                                                                   \
    COLUMN_OR(struct psf_row, psf.member_name, psf.is_angular, &sines),                            \
        .dimension = &dimension_length, .unit = "um", .flags = (more) | COLUMN_SPARSE

static const struct column columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {COLUMN(struct psf_row, psf.peak), .flags = COLUMN_BRIEF, .name = "peak", .symbol = "S",
     .help = "peak over that of a perfect image through the same pupil: the Strehl ratio"},
    {SMALL(peak_at[0], 0), .name = "peak_x", .label = "peak x",
     .help = "position of the peak, from the chief ray"},
    {SMALL(peak_at[1], 0), .name = "peak_y", .label = "peak y", .help = "the same upwards"},
    {SMALL(centroid[0], 0), .name = "centroid_x", .label = "centroid x",
     .help = "centroid of the pixels, from the chief ray"},
    {SMALL(centroid[1], 0), .name = "centroid_y", .label = "centroid y",
     .help = "the same upwards"},
    {SMALL(width[0], COLUMN_BRIEF), .name = "width_x", .label = "width in x",
     .help = "full width at half maximum of the row of pixels through the brightest; absent where "
             "the image ends before"},
    {SMALL(width[1], COLUMN_BRIEF), .name = "width_y", .label = "width in y",
     .help = "the same of the column of pixels"},
    {SMALL(radius80, COLUMN_BRIEF), .name = "radius80", .label = "radius of 80 %",
     .help = "radius about the centroid that encloses 80 % of the light; absent where that circle "
             "leaves the image or the pixels are coarse"},
    {SMALL(radius80_error, COLUMN_HIDDEN), .name = "radius80_error", .label = "error of that",
     .help = "estimated error of that radius"},
    {COLUMN(struct psf_row, psf.inside), .dimension = &dimension_ratio, .unit = "%",
     .flags = COLUMN_BRIEF, .name = "inside", .label = "light inside",
     .help = "fraction of all light that falls on the pixels; absent where they are too coarse to "
             "tell"},
    {SMALL(pitch, COLUMN_BRIEF), .name = "pitch", .help = "side of a pixel"},
    {COLUMN(struct psf_row, method), .flags = COLUMN_ASSUMED, .name = "method", .depends = "method",
     .help = "how the diffraction integral is evaluated"},
    ANALYSIS_SPECTRUM_COLUMN,
    ANALYSIS_TAIL_COLUMNS,
};

/* A pitch as a length of an image infinitely far away, or an angle of another? */
static bool psf_check(const struct analysis_case *one, const struct psf_input *input,
                      struct error *error)
{
    const bool is_angular = isnan(one->setup->image);
    if (isnan(is_angular ? input->pitch : input->pitch_angle)) {
        return true;
    }
    return fail(error, ERROR_DOMAIN,
                is_angular ? "{--pitch}: the image lies infinitely far away, its pixels are "
                             "angles: give {--pitch-angle}"
                           : "{--pitch-angle} is of images infinitely far away: give {--pitch}");
}

static bool psf_field_find(const struct analysis_cursor *at, const struct analysis_case *one,
                           size_t field, void *found, struct error *error)
{
    const struct psf_input *input = at->input;
    const bool is_angular = isnan(one->setup->image);
    const struct psf_question question = {.bundle = analysis_bundle(one, field),
                                          .method = (enum psf_method)input->method,
                                          .size = (size_t)input->size,
                                          .threads = one->threads,
                                          .pitch =
                                              is_angular ? sin(input->pitch_angle) : input->pitch};
    return psf_find(&question, one->setup->arena, found, error);
}

/* As analysis_next; errors as psf_check too. */
static bool psf_next(struct analysis_cursor *at, struct error *error)
{
    error->code = ERROR_NONE;
    while (at->one == NULL || !analysis_next_field(at, error)) {
        if (error->code != ERROR_NONE || !analysis_next_case(at, error) ||
            !psf_check(at->one, at->input, error)) {
            return false;
        }
    }
    return true;
}

/* What amplitudes and phases are those of, of an image infinitely far away. */
static const char *const angular_words[PSF_METHODS] = {
    [PSF_PLANE] = "plane waves, amplitude squared = energy per area across the chief ray, phase on "
                  "a plane there",
    [PSF_FFT] = "fast Fourier transform, amplitude squared = energy per area across the chief ray, "
                "phase on a plane there",
    [PSF_HUYGENS] = NULL};

static const char *psf_row_method(const struct psf_input *input, const struct psf *psf)
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
    if (psf != NULL && psf->method == PSF_RAYS) {
        return "rays as if light had no wavelength: densities of energy over the pixels";
    }
    return psf != NULL && psf->is_angular ? angular_words[psf->method] : words[input->method];
}

static void psf_row_warn(const struct analysis_cursor *at, const struct psf *psf,
                         struct psf_row *row)
{
    struct arena *arena = at->run->arena;
    if (psf->turns > 0) {
        analysis_warn(at, &row->point,
                      arena_printf(arena,
                                   "the phase turns %.0f times across the pupil, and sums of waves "
                                   "take %d: by rays, without diffraction",
                                   psf->turns, PSF_TURNS_MOST));
    }
    if (!(psf->pitch < psf->finest)) {
        analysis_warn(
            at, &row->point,
            arena_printf(
                arena,
                "pixels of %.4g %s miss light between them: shares of it want less than %.4g",
                1000 * psf->pitch, psf->is_angular ? "mrad" : "um", 1000 * psf->finest));
    }
    analysis_warn(at, &row->point, lens_island_warning(&psf->islands, arena));
}

static const struct sheet sheet = SHEET(columns, struct psf_row);

static bool psf_run(const void *data, struct run *run, struct error *error)
{
    struct analysis_cursor at =
        analysis_begin_finding(data, &policy, run, psf_field_find, sizeof(struct psf));
    while (psf_next(&at, error)) {
        const struct psf *psf = at.lost == NULL ? at.found : NULL;
        struct psf_row row;
        analysis_begin_row(&at, &sheet, &row);
        row.method = psf_row_method(data, psf);
        if (psf != NULL) {
            row.psf = *psf;
            psf_row_warn(&at, psf, &row);
        }
        if (!run_emit(run, &row)) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- maps -------- */

/* Of a drawing: light that it shows at least, pixels along a side at most, rings of Airy's disc. */
static const double DRAWN_SHARE = 0.9, RINGS = 5;
enum { DRAWN_MOST = 512 };

/* What a drawing shows of an image: a square about its light, in pixels. */
struct psf_window {
    size_t left, bottom, size;
};

/* How much of the light of an image, of all it has, lies in a window. */
static double psf_window_light(const struct psf *psf, const struct psf_window *window)
{
    double inside = 0, all = 0;
    for (size_t y = 0; y < psf->size; y++) {
        for (size_t x = 0; x < psf->size; x++) {
            const double value = psf->values[y * psf->size + x];
            const bool in = x - window->left < window->size && y - window->bottom < window->size;
            inside += in ? value : 0;
            all += value;
        }
    }
    return inside / all;
}

/* About the centroid, as far as the image goes. */
static struct psf_window psf_window_of(const struct psf *psf, size_t half)
{
    struct psf_window window = {.size = 2 * half < psf->size ? 2 * half : psf->size};
    size_t *const from[2] = {&window.left, &window.bottom};
    for (size_t k = 0; k < 2; k++) {
        const double middle = psf->centroid[k] / psf->pitch + (double)(psf->size / 2);
        const double most = (double)(psf->size - window.size);
        *from[k] = (size_t)fmin(fmax(round(middle - (double)(window.size / 2)), 0), most);
    }
    return window;
}

/* With nine tenths of the light and half as much again, and with four rings at least. */
static struct psf_window psf_window_find(const struct psf *psf)
{
    const double share = DRAWN_SHARE / (isnan(psf->inside) ? 1 : fmax(psf->inside, DRAWN_SHARE));
    const size_t last = psf->size / 2, rings = (size_t)ceil(RINGS * 2 * psf->finest / psf->pitch);
    size_t low = 1, high = last; /* the least that holds that share, by halves */
    while (low < high) {
        const size_t half = (low + high) / 2;
        const struct psf_window window = psf_window_of(psf, half);
        if (psf_window_light(psf, &window) < share) {
            low = half + 1;
        } else {
            high = half;
        }
    }
    const size_t half = 3 * low / 2 > rings ? 3 * low / 2 : rings;
    return psf_window_of(psf, half < last ? half : last);
}

/*
 * The image of a drawing: with pixels of its own choice it is made larger until it holds nine
 * tenths of the light, or where that is a small part of it again with finer pixels.
 */
static bool psf_drawn_find(const struct analysis_cursor *at, const struct analysis_case *one,
                           size_t field, void *found, struct error *error)
{
    const struct psf_input *input = at->input;
    struct psf_input own = *input;
    struct analysis_cursor asks = *at;
    struct psf *psf = found;
    asks.input = &own;
    if (!psf_field_find(at, one, field, psf, error)) {
        return false;
    }
    if (!isnan(input->pitch) || !isnan(input->pitch_angle)) {
        return true;
    }
    own.method = psf->method == PSF_RAYS ? PSF_RAYS : input->method;
    struct error ignored;
    struct psf other;
    double *const pitch = psf->is_angular ? &own.pitch_angle : &own.pitch;
    while (psf->inside < DRAWN_SHARE && own.size < DRAWN_MOST) {
        own.size *= 2;
        *pitch = psf->is_angular ? asin(psf->pitch) : psf->pitch;
        if (!psf_field_find(&asks, one, field, &other, &ignored)) {
            return true;
        }
        *psf = other;
    }
    const struct psf_window window = psf_window_find(psf);
    if (2 * window.size < psf->size) {
        const double centre = fmax(fabs(psf->centroid[0]), fabs(psf->centroid[1]));
        const double half = centre + psf->pitch * (double)window.size / 2;
        *pitch = 2 * half / (double)own.size;
        *pitch = psf->is_angular ? asin(*pitch) : *pitch;
        *psf = psf_field_find(&asks, one, field, &other, &ignored) ? other : *psf;
    }
    return true;
}

/* By rays there is no perfect peak to compare with. */
static const char *psf_map_note(const struct psf *psf, double inside, struct arena *arena)
{
    const char *strehl =
        psf->method == PSF_RAYS ? "by rays" : arena_printf(arena, "Strehl ratio %.3g", psf->peak);
    return isnan(inside) ? strehl
                         : arena_printf(arena, "%s, %.3g %% of the light", strehl, 100 * inside);
}

/* The map of an image: all of its pixels, or what a drawing shows. */
static struct raster_map psf_map(const struct psf *psf, bool whole, struct arena *arena)
{
    struct psf_window window = {.size = psf->size};
    if (!whole) {
        window = psf_window_find(psf);
    }
    double *values = ARENA_ARRAY(arena, window.size * window.size, double);
    for (size_t y = 0; y < window.size; y++) {
        for (size_t x = 0; x < window.size; x++) {
            values[y * window.size + x] =
                psf->values[(window.bottom + y) * psf->size + window.left + x];
        }
    }
    const double pitch = 1000 * psf->pitch, half = (double)window.size / 2;
    const double middle = (double)(psf->size / 2);
    const double inside = psf->inside * psf_window_light(psf, &window);
    return (struct raster_map){
        .note = psf_map_note(psf, inside, arena),
        .size = window.size,
        .values = values,
        .half = pitch * half,
        .centre = {whole ? 0 : pitch * ((double)window.left + half - middle),
                   whole ? 0 : pitch * ((double)window.bottom + half - middle)}};
}

/* The maps of all inputs of a job. */
static bool psf_maps(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct psf_input *first = job->inputs[0];
    const bool drawn = map_is_drawing(job);
    const bool whole = !drawn || asking_given(job->asking, "size");
    struct map_page page = {.job = job,
                            .rasters = {.scale_label = "share of the peak of the map",
                                        .colours = first->linear ? RASTER_LIGHT : RASTER_LOG,
                                        .decades = 5,
                                        .own_scale = true,
                                        .columns = 3}};
    for (size_t i = 0; i < job->count; i++) {
        struct analysis_cursor at =
            analysis_begin_finding(job->inputs[i], &policy, job->run,
                                   whole ? psf_field_find : psf_drawn_find, sizeof(struct psf));
        at.keeps_lost = true;
        while (psf_next(&at, error)) {
            if (at.lost != NULL) {
                continue;
            }
            struct arena *arena = page.job->run->arena;
            const struct analysis_case *one = at.one;
            const struct psf *psf = at.found;
            const char *unit = psf->is_angular ? "mrad" : "\xc2\xb5m";
            if (page.rasters.count > 0 && strcmp(page.rasters.unit, unit) != 0) {
                return fail(
                    error, ERROR_USAGE,
                    "a page has no room for images in \xc2\xb5m and others infinitely far away");
            }
            page.rasters.unit = unit;
            page.rasters.x_label = arena_printf(arena, "x (%s)", unit);
            page.rasters.y_label = arena_printf(arena, "y (%s)", unit);
            struct raster_map map = psf_map(psf, whole, arena);
            map.title = analysis_field_words(one, at.field, job->count > 1, arena);
            const char *subtitle = analysis_figure_words(one, FIGURE_ALL, arena);
            if (!map_page_add(&page, one, &map, subtitle, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    return map_page_make(&page, "Point spread functions", sink, error);
}

static bool psf_check_map(const struct artifact_job *job, struct error *error)
{
    const struct psf_input *input = job->inputs[0];
    const bool numbers = job->type != NULL && strcmp(job->type->ending, ".pfm") == 0;
    if (!numbers || asking_given(job->asking, "plot") || !(input->log || input->linear)) {
        return true;
    }
    return fail(error, ERROR_USAGE,
                input->log ? "{--log} is of colours, and .pfm has numbers"
                           : "{--linear} is of colours, and .pfm has numbers");
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the images, by field and through focus"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = psf_maps},
    {ARTIFACT_OPTION("map", map_types,
                     "write the image of one field: colours, or numbers, 1 = a perfect peak"),
     .scope = ARTIFACT_OF_ANSWER, .is_binary = true, .check = psf_check_map, .make = psf_maps},
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
    {"psf questar-35 --plot images.svg", "those of a telescope, drawn"},
    {"psf double-gauss -N 8 --field 0 -w d --defocus -0.2..0.2#5 --plot focus.svg",
     "through focus, drawn"},
    {"psf double-gauss -N 8 --field 14deg --method huygens --size 64 --map image.pfm",
     "the numbers for another program"},
    {NULL, NULL},
};

const struct command command_psf = {
    .name = "psf",
    .summary = "diffraction point spread function: Strehl ratio, widths, maps",
    COMMAND_ASKS(struct psf_input),
    COMMAND_ANSWERS(struct psf_row),
    .run = psf_run,
    .makes_many = analysis_several,
    ANALYSIS_COMMAND,
    .cell = "peak",
    COMMAND_MAKES(artifacts),
    .most_answers = 10000,
};
