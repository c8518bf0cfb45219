/* commands/camera/cmd_render.c - lenscalc render: what a film sees through a lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "file/image_file.h"

#define INPUT struct render_input

static const struct option options[] = {
    {ASKED(subject), .name = "subject", .value = "SCENE", .flags = OPTION_OPERAND | OPTION_FILE,
     .help = "a scene (.scene), or a flat card: a picture (.png, .jpg, .exr, .pfm, .hdr), or "
             "chart:edge, star, grid, checker, bars, wedge, points, stars"},
    {ASKED(question.lens), .name = "lens", .letter = 'l', .value = "LENS", .flags = OPTION_FILE,
     .types = lens_types,
     .help = "a lens of lensdb (list lenses), a file, or - for standard input"},
    OPTION_DISTANCE(distance, 0, "distance the lens is focused at, and of a card; inf in scenes"),
    OPTION_FROM(from, distances_from),
    {ANALYSIS_LENGTH(struct render_input, field_width), .name = "field-width", .lowest = 0,
     .highest = INFINITY, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,
     .help = "width of the card; default as much as the film sees"},
    {ASKED(depth_map), .name = "depth-map", .value = "FILE", .flags = OPTION_FILE,
     .help = "distance of each pixel of the card from the sensor: .pfm or .exr in m, or .png"},
    {MEASURE(depth, length, "m", "NEAR..FAR"), .name = "depth", .wants = "depth-map",
     .help = "distances that are white and black in a .png, linear in 1/distance"},
    {ASKED(hidden), .name = "hidden", .words = render_hidden, .fallback = "black",
     .wants = "depth-map", .value = "NAME",
     .help = "what rays meet that pass behind edges of the depth map"},
    LENS_WAVELENGTH_OPTION(struct render_input, question,
                           "611, 549 and 464 nm for red, green and blue; for rays all of the lens"),
    ANALYSIS_SPECTRUM_OPTION(struct render_input, question),
    {MEASURE(band, wavelength, "nm", "LENGTH"), .name = "band", .lowest = 0, .highest = 1e-4,
     .flags = OPTION_ABOVE_LOWEST, .excludes = "wavelength spectrum",
     .help = "bandwidth of red, green and blue light, sampled at 8 wavelengths each; default none"},
    LENS_FNUMBER_OPTION(struct render_input, question),
    {ASKED(blades), .name = "blades", .lowest = BLADES_LEAST, .highest = BLADES_MOST,
     .value = "COUNT",
     .help = "blades of the iris, whose corners lie on the stop; default a round one"},
    {MEASURE(blade_turn, angle, "deg", "ANGLE"), .name = "blade-turn", .lowest = -2 * PI,
     .highest = 2 * PI, .fallback = "0", .wants = "blades",
     .help = "angle of its first corner, from x towards y"},
    {MEASURE(blade_rounding, number, NULL, "NUMBER"), .name = "blade-rounding", .lowest = 0,
     .highest = 1, .fallback = "0", .wants = "blades",
     .help = "curvature of the blades: 0 straight to 1 a circle"},
    LENS_POSITION_OPTION(struct render_input, question),
    ANALYSIS_PLANE_OPTIONS(struct render_input, question),
    {ASKED(focus_at), .name = "focus-at", .words = render_focus_ats, .fallback = "thick",
     .value = "IMAGE", .wants = "distance|autofocus|subject", .excludes = "focus",
     .help = "which image of the card falls on the film"},
    {ASKED(autofocus), .name = "autofocus", .value = "X:Y", .excludes = "focus",
     .help = "focus on what lies there: fractions of width and height from the upper left"},
    {ASKED(gap), .name = "gap", .value = "GAPS", .wants = "distance|autofocus|subject",
     .excludes = "focus",
     .help = "focus by these gaps, the film standing still: variables or surface numbers, each "
             "with a weight: d5,10:-1; default the whole lens moves"},
    {ASKED(model), .name = "model", .words = lens_models, .fallback = "exact", .value = "MODEL",
     .help = "model of the lens"},
    OPTION_SENSOR(sensor),
    {MEASURE(luminance, luminance, "cd_m2", "LUMINANCE"), .name = "luminance", ABOVE_0,
     .fallback = "1000", .excludes = "ev scene", .help = "luminance of the card's white"},
    OPTION_EV(ev, "light on the card as exposure value at ISO 100"),
    {ASKED(light), .name = "scene", .value = "NAME", .excludes = "ev",
     .help = "light on the card as in a typical scene: sunny-16, home-interior; see 'list scenes'"},
    OPTION_FILTER(filter, NULL),
    OPTION_TIME(time, 0),
    {ASKED(shutter.kind), .name = "shutter", .words = shutter_kinds, .fallback = "global",
     .value = "NAME", .help = "shutter: when each ray may pass during the exposure"},
    {MEASURE(shutter.travel, time, "s", "TIME"), .name = "travel-time", ABOVE_0 | OPTION_NO_SERIES,
     .wants = "shutter=focal", .help = "time of a curtain from edge to edge of the film"},
    {ANALYSIS_LENGTH(struct render_input, shutter.distance), .name = "curtain-distance",
     .lowest = 0, .highest = INFINITY, .flags = OPTION_NO_INFINITY, .wants = "shutter=focal",
     .help = "distance of the curtains from the film; default 0"},
    {ANALYSIS_LENGTH(struct render_input, shutter.overrun), .name = "curtain-overrun", .lowest = 0,
     .highest = INFINITY, .wants = "shutter=focal",
     .help = "how far curtains run beyond the film's edges; default as far as rays need"},
    {MEASURE(shutter.opening, time, "s", "TIME"), .name = "opening-time",
     ABOVE_0 | OPTION_NO_SERIES, .wants = "shutter=leaf",
     .help = "time of a leaf shutter from closed to fully open"},
    {MEASURE(shutter.closing, time, "s", "TIME"), .name = "closing-time",
     ABOVE_0 | OPTION_NO_SERIES, .wants = "shutter=leaf",
     .help = "time from fully open to closed; default as long as it takes to open"},
    {MEASURE(shutter.readout, time, "s", "TIME"), .name = "readout", ABOVE_0 | OPTION_NO_SERIES,
     .wants = "shutter=rolling", .help = "time from first to last line of the film"},
    {ASKED(shutter.direction), .name = "shutter-direction", .words = shutter_directions,
     .fallback = "down", .value = "WAY", .wants = "shutter=focal|shutter=rolling",
     .help = "direction of the curtains or lines in the picture"},
    {MEASURE(iso, iso, NULL, "SPEED"), .name = "iso", .quantity = "ISO speed", ABOVE_0,
     .fallback = "100", .help = "ISO speed, by saturation at 78/ISO lx s"},
    {ASKED(size), .name = "size", .value = "WxH",
     .help = "pixels of the picture; default 480 across"},
    {ASKED(crop), .name = "crop", .value = "X:Y:WxH",
     .help = "write W x H of its pixels only, X from the left and Y from the top"},
    {ASKED(samples), .name = "samples", .lowest = 1, .highest = 4e9, .value = "COUNT",
     .help = "rays per pixel and wavelength, a power of two (64); with --rays the total number "
             "(65536)"},
    {MEASURE(error, ratio, NULL, "RATIO"), .name = "error", .lowest = 1e-4, .highest = 1,
     .help = "wanted error as a fraction of white: 1%; each tile of 16 x 8 pixels takes as many "
             "rays as it needs, at most --samples (4096)"},
    {MEASURE(seconds, time, "s", "TIME"), .name = "seconds", FROM_0, .excludes = "part resume",
     .help = "time limit: as many rays as it allows, at most --samples (1048576), at least 16"},
    {ASKED(bounces), .name = "bounces", .lowest = 0, .highest = 1000, .fallback = "4",
     .value = "COUNT",
     .help = "bounces of light in a scene: 0 emitters only, 1 direct light, and so on"},
    {ASKED(spectral), .name = "spectral", .excludes = "wavelength spectrum band",
     .help = "light of a scene in many wavelengths, not in red, green and blue"},
    {ASKED(bands), .name = "bands", .lowest = 8, .highest = BANDS_MOST, .fallback = "32",
     .wants = "spectral", .value = "COUNT", .help = "number of wavelength bands"},
    {ASKED(bits), .name = "bits", .lowest = 8, .highest = 32, .value = "8|16|32",
     .help = "bits per value: PNG 8 or 16 (8), OpenEXR 16 or 32 (32)"},
    {ASKED(packing), .name = "packing", .words = render_packings, .fallback = "zip",
     .value = "NAME", .help = "compression of an OpenEXR"},
    {ASKED(radiance), .name = "radiance", .excludes = "filter",
     .why = "light of the scene has passed no filter",
     .help = "write cd/m2 of the scene in place of lx s"},
    {ASKED(noise), .name = "noise", .help = "photon shot noise"},
    {ANALYSIS_LENGTH(struct render_input, pitch), .name = "pitch", .lowest = 1e-4, .highest = 100,
     .help = "pixel pitch of the sensor, for its noise; default that of the picture"},
    {MEASURE(read_noise, number, NULL, "NUMBER"), .name = "read-noise", FROM_0,
     .help = "read noise, standard deviation in electrons"},
    {MEASURE(full_well, number, NULL, "NUMBER"), .name = "full-well", .lowest = 1,
     .highest = INFINITY, .flags = OPTION_NO_INFINITY, .help = "full well capacity, electrons"},
    {MEASURE(dark_current, number, NULL, "NUMBER"), .name = "dark-current", FROM_0,
     .help = "dark current, electrons per second"},
    {MEASURE(fill, number, NULL, "NUMBER"), .name = "fill", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .help = "fill factor: light-sensitive fraction of a pixel (1)"},
    {MEASURE(efficiency, number, NULL, "NUMBER"), .name = "efficiency", .lowest = 0, .highest = 1,
     .flags = OPTION_ABOVE_LOWEST, .help = "quantum efficiency, electrons per photon (0.5)"},
    {ASKED(response), .name = "response", .value = "NAME|FILE", .flags = OPTION_FILE,
     .help = "spectral response of the channels: rgb, mono, xyz, or a table of efficiencies by "
             "wavelength"},
    {MEASURE(gain, number, NULL, "NUMBER"), .name = "gain", ABOVE_0, .excludes = "iso",
     .help = "gain, digital numbers per electron, in place of --iso"},
    {MEASURE(black, number, NULL, "NUMBER"), .name = "black", FROM_0,
     .help = "black level: the digital number at zero electrons (0)"},
    {ASKED(adc), .name = "adc", .lowest = 8, .highest = 16, .value = "BITS",
     .help = "bits of the analogue-digital converter (14)"},
    {ASKED(acceptance), .name = "acceptance", .value = "POWER|FILE", .flags = OPTION_FILE,
     .help = "acceptance of the pixels by angle of incidence: a power of the cosine, or a table"},
    {ASKED(mosaic), .name = "mosaic", .words = render_mosaics, .fallback = "none", .value = "NAME",
     .help = "colour filter array of the sensor"},
    {ASKED(white), .name = "white", .value = "LIGHT",
     .help = "light that becomes white in a PNG: daylight, tungsten, auto, 5600K"},
    {ASKED(raw), .name = "raw", .excludes = "white", .why = "raw numbers have no white balance",
     .help = "write the raw values of the sensor, as a 16-bit PNG"},
    {ASKED(film), .name = "film", .value = "NAME",
     .excludes = "iso radiance noise pitch read-noise full-well dark-current mosaic response fill "
                 "efficiency gain black adc white raw",
     .help = "expose a film of 'list films', and print it; or densities, as .pfm and .exr"},
    {MEASURE(grain, number, NULL, "NUMBER"), .name = "grain", .lowest = 0, .highest = 1000,
     .wants = "film", .help = "add grain, by the maker's rms granularity; default none"},
    {ASKED(no_skip), .name = "no-skip", .value = "NAMES",
     .help = "compute what is usually skipped: pupil, colour, blur, uniform, exposures, time, "
             "secondary, or all"},
    {ASKED(seed), .name = "seed", .lowest = 0, .highest = 1e9, .fallback = "0", .value = "NUMBER",
     .help = "seed of rays, noise and grain"},
    {ASKED(threads), .name = "threads", .lowest = 0, .highest = PARALLEL_MOST, .value = "N",
     .fallback = "1", .flags = OPTION_ASIDE, .help = "threads; 0 = one per core"},
    {ASKED(part), .name = "part", .value = "I/N", .flags = OPTION_ASIDE,
     .help = "only part I of N, into a .part for 'lenscalc merge'"},
    {ASKED(resume), .name = "resume", .flags = OPTION_ASIDE,
     .help = "continue a .part from what it has"},
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
        "part",        "resume",    "subject",      "band",    "autofocus", "error",
        "radiance",    "packing",   "ev",           "scene",   "filter",    "depth-map",
        "field-width", "luminance", "iso",          "size",    "crop",      "bits",
        "film",        "grain",     "threads",      "depth",   "hidden",    "no-skip",
        "bounces",     "spectral",  "bands",        "seconds", "noise",     "pitch",
        "read-noise",  "full-well", "dark-current", "mosaic",  "response",  "fill",
        "efficiency",  "gain",      "black",        "adc",     "white",     "raw"};
    const struct render_input *input = job->inputs[0];
    const bool also_picture = asking_given(job->asking, "output");
    const char *vain = NULL;
    for (size_t i = 0; i < sizeof of_pictures / sizeof of_pictures[0] && vain == NULL; i++) {
        vain = asking_given(job->asking, of_pictures[i]) ? of_pictures[i] : NULL;
    }
    /* a shutter lets rays pass by the time */
    if (vain == NULL && input->shutter.kind == SHUTTER_GLOBAL &&
        asking_given(job->asking, "time")) {
        vain = "time";
    }
    if (vain != NULL && !also_picture) {
        return fail(error, ERROR_USAGE,
                    "{--%s} is of pictures, and {--rays} makes none: {--output} FILE does", vain);
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
     "by a sensor, with its noise and mosaic"},
    {"render chart:points --lens double-gauss-50 -s 2m --model thick --error 2% -o thick.png",
     "the thick lens in its place, with as many rays as an error needs"},
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
    .summary = "photographs simulated by exact rays through a lens",
    COMMAND_ASKS(struct render_input),
    .is_divided = true,
    .explains = true,
    COMMAND_MAKES(artifacts),
    .needs_ceres = "model=fitted",
};
