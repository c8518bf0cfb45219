/* commands/camera/cmd_render.c - lenscalc render: what a film sees through a lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/photo/light_options.h"
#include "commands/photo/photo_lens.h"
#include "file/image_file.h"

#define RENDER_ELECTRONS(member, more)                                                             \
    OPTION(struct render_input, member), .dimension = &dimension_number, .lowest = 0,              \
                                         .highest = INFINITY,                                      \
                                         .flags = OPTION_NO_INFINITY | (more), .value = "NUMBER"

#define RENDER_SHARE(member)                                                                       \
    OPTION(struct render_input, member), .dimension = &dimension_number, .lowest = 0,              \
                                         .highest = 1, .flags = OPTION_ABOVE_LOWEST,               \
                                         .value = "NUMBER"

#define RENDER_TIME(member)                                                                        \
    OPTION(struct render_input, member),                                                           \
        .dimension = &dimension_time, .unit = "s", .lowest = 0, .highest = INFINITY,               \
        .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_NO_SERIES, .value = "TIME"

static const struct option options[] = {
    {OPTION(struct render_input, subject), .name = "subject", .value = "SCENE",
     .flags = OPTION_OPERAND | OPTION_FILE,
     .help = "a scene (.scene), or a flat card: a picture (.png, .jpg, .exr, .pfm, .hdr), or "
             "chart:edge, star, grid, checker, bars, wedge, points, stars"},
    {OPTION(struct render_input, question.lens), .name = "lens", .letter = 'l', .value = "LENS",
     .flags = OPTION_FILE, .types = lens_types,
     .help = "a lens of lensdb (list lenses), a file, or - for standard input"},
    OPTION_DISTANCE(struct render_input, distance, 0,
                    "distance on which the lens is focused, and of a card; inf in scenes"),
    OPTION_FROM(struct render_input, from, distances_from),
    {ANALYSIS_LENGTH(struct render_input, field_width), .name = "field-width", .lowest = 0,
     .highest = INFINITY, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,
     .help = "width of the card; default as much as the film sees"},
    {OPTION(struct render_input, depth_map), .name = "depth-map", .value = "FILE",
     .flags = OPTION_FILE,
     .help = "how far from the sensor each pixel of the card is: .pfm or .exr in m, or .png"},
    {OPTION(struct render_input, depth), .name = "depth", .dimension = &dimension_length,
     .unit = "m", .wants = "depth-map", .value = "NEAR..FAR",
     .help = "distances that are white and black in a .png, linear in 1/distance"},
    {OPTION(struct render_input, hidden), .name = "hidden", .words = render_hidden,
     .fallback = "black", .wants = "depth-map", .value = "NAME",
     .help = "what rays see that pass behind edges of the depth map"},
    LENS_WAVELENGTH_OPTION(struct render_input, question,
                           "611, 549 and 464 nm for red, green and blue; for rays all of the lens"),
    ANALYSIS_SPECTRUM_OPTION(struct render_input, question),
    {OPTION(struct render_input, band), .name = "band", .dimension = &dimension_wavelength,
     .unit = "nm", .lowest = 0, .highest = 1e-4, .flags = OPTION_ABOVE_LOWEST, .value = "LENGTH",
     .help = "spread red, green and blue light so far, over 8 wavelengths each; default none"},
    LENS_FNUMBER_OPTION(struct render_input, question),
    {OPTION(struct render_input, blades), .name = "blades", .lowest = BLADES_LEAST,
     .highest = BLADES_MOST, .value = "COUNT",
     .help = "blades of the iris, whose corners lie on the stop; default a round one"},
    {OPTION(struct render_input, blade_turn), .name = "blade-turn", .dimension = &dimension_angle,
     .unit = "deg", .lowest = -2 * PI, .highest = 2 * PI, .fallback = "0", .wants = "blades",
     .value = "ANGLE", .help = "turn of its first corner from x towards y"},
    {OPTION(struct render_input, blade_rounding), .name = "blade-rounding",
     .dimension = &dimension_number, .lowest = 0, .highest = 1, .fallback = "0", .wants = "blades",
     .value = "NUMBER", .help = "curvature of the blades: 0 straight to 1 a circle"},
    LENS_POSITION_OPTION(struct render_input, question),
    ANALYSIS_PLANE_OPTIONS(struct render_input, question),
    {OPTION(struct render_input, focus_at), .name = "focus-at", .words = render_focus_ats,
     .fallback = "thick", .value = "IMAGE", .wants = "distance|autofocus|subject",
     .excludes = "focus", .help = "what of the card's image comes onto the film"},
    {OPTION(struct render_input, autofocus), .name = "autofocus", .value = "X:Y",
     .excludes = "focus",
     .help = "focus on what lies there: fractions of width and height from the upper left"},
    {OPTION(struct render_input, gap), .name = "gap", .value = "GAPS",
     .wants = "distance|autofocus|subject", .excludes = "focus",
     .help = "focus by these gaps, the film standing still: variables or surface numbers, each "
             "with a weight: d5,10:-1; default the whole lens moves"},
    {OPTION(struct render_input, model), .name = "model", .words = lens_models, .fallback = "exact",
     .value = "MODEL", .help = "what of the lens the rays see"},
    OPTION_SENSOR(struct render_input, sensor),
    {OPTION(struct render_input, luminance), .name = "luminance", .dimension = &dimension_luminance,
     .unit = "cd_m2", .lowest = 0, .highest = INFINITY, .fallback = "1000",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "LUMINANCE",
     .excludes = "ev scene", .help = "luminance of the card's white"},
    OPTION_EV(struct render_input, ev, "light on the card as exposure value at ISO 100"),
    {OPTION(struct render_input, light), .name = "scene", .value = "NAME", .excludes = "ev",
     .help = "light on the card as in a typical scene: sunny-16, home-interior; see 'list scenes'"},
    OPTION_FILTER(struct render_input, filter, NULL),
    OPTION_TIME(struct render_input, time, 0),
    {OPTION(struct render_input, shutter.kind), .name = "shutter", .words = shutter_kinds,
     .fallback = "global", .value = "NAME", .help = "when each ray may pass in the exposure time"},
    {RENDER_TIME(shutter.travel), .name = "travel-time", .wants = "shutter=focal",
     .help = "of a curtain, from edge to edge of the film"},
    {ANALYSIS_LENGTH(struct render_input, shutter.distance), .name = "curtain-distance",
     .lowest = 0, .highest = INFINITY, .flags = OPTION_NO_INFINITY, .wants = "shutter=focal",
     .help = "of the curtains before the film; default 0"},
    {ANALYSIS_LENGTH(struct render_input, shutter.overrun), .name = "curtain-overrun", .lowest = 0,
     .highest = INFINITY, .wants = "shutter=focal",
     .help = "how far curtains run beyond the film's edges; default as far as rays need"},
    {RENDER_TIME(shutter.opening), .name = "opening-time", .wants = "shutter=leaf",
     .help = "of a leaf shutter, from closed to fully open"},
    {RENDER_TIME(shutter.closing), .name = "closing-time", .wants = "shutter=leaf",
     .help = "from fully open to closed; default as long as it takes to open"},
    {RENDER_TIME(shutter.readout), .name = "readout", .wants = "shutter=rolling",
     .help = "time from first to last line of the film"},
    {OPTION(struct render_input, shutter.direction), .name = "shutter-direction",
     .words = shutter_directions, .fallback = "down", .value = "WAY",
     .wants = "shutter=focal|shutter=rolling",
     .help = "where curtains or lines go to in the picture"},
    {OPTION(struct render_input, iso), .name = "iso", .quantity = "ISO speed",
     .dimension = &dimension_iso, .lowest = 0, .highest = INFINITY, .fallback = "100",
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "SPEED",
     .help = "ISO speed, by saturation at 78/ISO lx s"},
    {OPTION(struct render_input, size), .name = "size", .value = "WxH",
     .help = "pixels of the picture; default 480 across"},
    {OPTION(struct render_input, crop), .name = "crop", .value = "X:Y:WxH",
     .help = "write W x H of its pixels only, X from the left and Y from the top"},
    {OPTION(struct render_input, samples), .name = "samples", .lowest = 1, .highest = 4e9,
     .value = "COUNT",
     .help =
         "rays of a pixel and wavelength, a power of two (64); with --rays rays in all (65536)"},
    {OPTION(struct render_input, error), .name = "error", .dimension = &dimension_ratio,
     .lowest = 1e-4, .highest = 1, .value = "RATIO",
     .help = "as many rays as each tile of 16 x 8 pixels needs for it, as a share of white: 1%; "
             "--samples then is the most (4096)"},
    {OPTION(struct render_input, seconds), .name = "seconds", .dimension = &dimension_time,
     .unit = "s", .lowest = 0, .highest = INFINITY, .flags = OPTION_NO_INFINITY, .value = "TIME",
     .excludes = "part resume",
     .help = "as many rays as there is time for, at most --samples (1048576), at least 16"},
    {OPTION(struct render_input, bounces), .name = "bounces", .lowest = 0, .highest = 1000,
     .fallback = "4", .value = "COUNT",
     .help = "of light in a scene: 0 what shines, 1 what it falls on, and so on"},
    {OPTION(struct render_input, spectral), .name = "spectral",
     .excludes = "wavelength spectrum band",
     .help = "light of a scene in many wavelengths, not in red, green and blue"},
    {OPTION(struct render_input, bands), .name = "bands", .lowest = 8, .highest = BANDS_MOST,
     .fallback = "32", .wants = "spectral", .value = "COUNT", .help = "so many"},
    {OPTION(struct render_input, bits), .name = "bits", .lowest = 8, .highest = 32,
     .value = "8|16|32", .help = "of a number: PNG 8 or 16 (8), OpenEXR 16 or 32 (32)"},
    {OPTION(struct render_input, packing), .name = "packing", .words = render_packings,
     .fallback = "zip", .value = "NAME", .help = "how an OpenEXR is packed"},
    {OPTION(struct render_input, radiance), .name = "radiance",
     .help = "write cd/m2 of the scene in place of lx s"},
    {OPTION(struct render_input, noise), .name = "noise", .help = "noise of the photons"},
    {ANALYSIS_LENGTH(struct render_input, pitch), .name = "pitch", .lowest = 1e-4, .highest = 100,
     .help = "of the sensor's pixels, for their noise; default that of the picture's"},
    {RENDER_ELECTRONS(read_noise, 0), .name = "read-noise",
     .help = "noise of reading a pixel, standard deviation in electrons"},
    {OPTION(struct render_input, full_well), .name = "full-well", .dimension = &dimension_number,
     .lowest = 1, .highest = INFINITY, .flags = OPTION_NO_INFINITY, .value = "NUMBER",
     .help = "electrons that a pixel holds"},
    {RENDER_ELECTRONS(dark_current, 0), .name = "dark-current",
     .help = "electrons a second in the dark"},
    {RENDER_SHARE(fill), .name = "fill", .help = "share of a pixel that takes light (1)"},
    {RENDER_SHARE(efficiency), .name = "efficiency", .help = "electrons of a photon (0.5)"},
    {OPTION(struct render_input, response), .name = "response", .value = "NAME|FILE",
     .flags = OPTION_FILE,
     .help = "what its channels see: rgb, mono, xyz, or a table of efficiencies by wavelength"},
    {RENDER_ELECTRONS(gain, OPTION_ABOVE_LOWEST), .name = "gain",
     .help = "numbers of an electron, in place of --iso"},
    {RENDER_ELECTRONS(black, 0), .name = "black", .help = "number of no electrons (0)"},
    {OPTION(struct render_input, adc), .name = "adc", .lowest = 8, .highest = 16, .value = "BITS",
     .help = "bits of the sensor's numbers (14)"},
    {OPTION(struct render_input, acceptance), .name = "acceptance", .value = "POWER|FILE",
     .flags = OPTION_FILE,
     .help = "light that pixels take by its angle: a power of the cosine, or a table"},
    {OPTION(struct render_input, mosaic), .name = "mosaic", .words = render_mosaics,
     .fallback = "none", .value = "NAME", .help = "colours of the pixels of a sensor"},
    {OPTION(struct render_input, white), .name = "white", .value = "LIGHT",
     .help = "light that is white in a PNG: daylight, tungsten, auto, 5600K"},
    {OPTION(struct render_input, raw), .name = "raw",
     .help = "write the numbers of the sensor, as a PNG of 16 bits"},
    {OPTION(struct render_input, film), .name = "film", .value = "NAME",
     .help = "expose a film of 'list films', and print it; or densities, as .pfm and .exr"},
    {OPTION(struct render_input, grain), .name = "grain", .dimension = &dimension_number,
     .lowest = 0, .highest = 1000, .wants = "film", .value = "NUMBER",
     .help = "with its grain, by the rms granularity of its maker; default none"},
    {OPTION(struct render_input, no_skip), .name = "no-skip", .value = "NAMES",
     .help = "do without a skip: pupil, colour, blur, uniform, exposures, time, secondary, or all"},
    {OPTION(struct render_input, seed), .name = "seed", .lowest = 0, .highest = 1e9,
     .fallback = "0", .value = "NUMBER", .help = "another one gives other rays, noise and grain"},
    {OPTION(struct render_input, threads), .name = "threads", .lowest = 0, .highest = PARALLEL_MOST,
     .value = "N", .fallback = "1", .flags = OPTION_ASIDE, .help = "threads; 0 = one a core"},
    {OPTION(struct render_input, part), .name = "part", .value = "I/N", .flags = OPTION_ASIDE,
     .help = "only part I of N, into a .part for 'lenscalc merge'"},
    {OPTION(struct render_input, resume), .name = "resume", .flags = OPTION_ASIDE,
     .help = "keep what a .part has already"},
};

/* -------- the command -------- */

static bool render_check_lens(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    if (input->question.lens.lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given");
        return error_hint(error, "{--lens} NAME, see 'lenscalc list lenses'");
    }
    const bool may_say = render_is_world(input) && input->autofocus == NULL; /* by focus= */
    if (asking_given(job->asking, "from") && !asking_given(job->asking, "distance") && !may_say) {
        return fail(error, ERROR_USAGE, "{--from} needs {--distance}");
    }
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "a film sees one position: {--position} NAME");
}

static bool render_check_question(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    if (asking_given(job->asking, "focus-at") && input->model != MODEL_EXACT) {
        return fail(error, ERROR_USAGE,
                    "{--focus-at} is of the {--model} exact: the images of others are one");
    }
    return render_check_lens(job, error) && render_check_shutter(job, error) &&
           render_check_picture(job, error);
}

/* Rays know nothing of what is photographed, nor of how it is exposed. */
static bool render_check_rays(const struct artifact_job *job, struct error *error)
{
    static const char *const of_pictures[] = {
        "part",        "resume",    "subject", "band",    "autofocus", "error",
        "radiance",    "packing",   "ev",      "scene",   "filter",    "depth-map",
        "field-width", "luminance", "iso",     "size",    "crop",      "bits",
        "film",        "grain",     "threads", "depth",   "hidden",    "no-skip",
        "bounces",     "spectral",  "bands",   "seconds", NULL};
    static const char *const of_exposures[] = {"time", NULL};
    const char *const *const lists[] = {of_pictures, render_sensor_options, of_exposures};
    const struct render_input *input = job->inputs[0];
    const size_t count = input->shutter.kind == SHUTTER_GLOBAL ? 3 : 2;
    const bool also_picture = asking_given(job->asking, "output");
    for (size_t k = 0; k < count && !also_picture; k++) {
        for (size_t i = 0; lists[k][i] != NULL; i++) {
            if (asking_given(job->asking, lists[k][i])) {
                return fail(error, ERROR_USAGE,
                            "{--%s} is of pictures, and {--rays} makes none: {--output} FILE does",
                            lists[k][i]);
            }
        }
    }
    if (!also_picture && !isnan(input->distance) &&
        (input->question.focus.kind == PLANE_AT || input->question.focus.kind == PLANE_TABLE)) {
        return fail(error, ERROR_USAGE,
                    "{--distance} and a fixed {--focus} exclude each other for {--rays}: each says "
                    "where the film stands");
    }
    if (render_is_world(input) && isnan(input->distance) &&
        input->question.focus.kind == PLANE_OF_LENS) {
        return fail(
            error, ERROR_USAGE,
            "{--rays} beside a picture of a scene need {--distance} or {--focus}: they know "
            "nothing of the scene");
    }
    return render_check_lens(job, error) && render_check_shutter(job, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(render_picture_types), .scope = ARTIFACT_OF_EACH, .varies = "time iso",
     .gathers = ".part", .is_binary = true, .check = render_check_question, .make = render_picture},
    {ARTIFACT_OPTION("rays", render_ray_types,
                     "write the rays that leave the lens towards the scene"),
     .check = render_check_rays, .make = render_rays},
};

static const struct example examples[] = {
    {"render chart:checker --lens double-gauss-50 -s 1m -o checker.png",
     "a chart, photographed wide open"},
    {"render chart:grid --lens fisheye-16 -s 1m -t 1/60 --iso 200 -o grid.exr",
     "exposed, as light in lx s"},
    {"render chart:star --lens double-gauss-50 -s 1m --film \"HP5 Plus\" --grain 17 -o hp5.png",
     "on film, printed"},
    {"render chart:star --lens double-gauss-50 -s 1m --noise --pitch 4um --mosaic rggb -o cfa.png",
     "by a sensor: its noise and mosaic"},
    {"render chart:points --lens double-gauss-50 -s 2m --model thick --error 2% -o thick.png",
     "the thick lens in its place, by as many rays as an error takes"},
    {"render chart:grid --lens double-gauss-50 -s 3m --scene sunny-16 -N 16 -t 1/100 -o sun.png",
     "in bright sun"},
    {"render chart:points --lens double-gauss-50 -s 1m --defocus 1 -t 1/500 --shutter leaf "
     "--opening-time 1ms -o leaf.png",
     "out of focus, by a leaf shutter"},
    {"render --lens double-gauss-50 --rays rays.csv", "rays for another renderer"},
    {NULL, NULL},
};

const struct command command_render = {
    .name = "render",
    .group = "camera",
    .summary = "photographs through exact lenses",
    COMMAND_ASKS(struct render_input),
    .is_divided = true,
    .explains = true,
    COMMAND_MAKES(artifacts),
    .needs_ceres = "model=fitted",
};
