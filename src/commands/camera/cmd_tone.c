/* commands/camera/cmd_tone.c - lenscalc tone: brackets to light, and light to a print. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "commands/camera/tone.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "draw/plot.h"

#include <math.h>
#include <string.h>

static const struct word responses[] = {
    [RESPONSE_FILE] = {"file", "as the file says: sRGB, or its gamma"},
    [RESPONSE_DEBEVEC] = {"debevec", "recovered from the bracket"},
    {NULL, NULL},
};

static const struct word operators[] = {
    [ASKED_AUTO] = {"auto", "ward for .png, none for HDR files"},
    [ASKED_NONE] = {"none", "the luminance itself, cd/m2"},
    [ASKED_FIRST + TONE_LINEAR] = {"linear", "in proportion, clipped at white"},
    [ASKED_FIRST +
        TONE_GAMMA] = {"gamma",
                       "a power law: more detail in shadows and highlights, less contrast"},
    [ASKED_FIRST + TONE_FILMIC] = {"filmic", "a film-like curve, channel by channel"},
    [ASKED_FIRST + TONE_WARD] = {"ward", "histogram adjustment"},
    {NULL, NULL},
};

static const struct word ceilings[] = {
    [CEILING_LINEAR] = {"linear", "no more contrast than the scene"},
    [CEILING_HUMAN] = {"human", "what is just visible stays just visible"},
    {NULL, NULL},
};

static const char *const names[FRAME_CHANNELS] = {"red", "green", "blue"};

static const struct file_type *tone_curve_types(size_t i)
{
    static const struct file_type types[] = {
        {{"svg", "SVG drawing"}, ".svg"},
        {{"csv", "numbers: code, light of red, green and blue"}, ".csv"},
    };
    return i < sizeof types / sizeof types[0] ? &types[i] : NULL;
}

/* As Debevec and Malik draw them: the logarithm of light over the codes. */
static bool draw_curves(const struct tone_light *light, const struct artifact_job *job,
                        struct output *sink, struct error *error)
{
    struct svg drawing = {.arena = job->run->arena};
    struct plot_series series[FRAME_CHANNELS];
    double codes[FRAME_LEVELS], stops[FRAME_CHANNELS][FRAME_LEVELS];
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        for (int z = 0; z < FRAME_LEVELS; z++) {
            codes[z] = z;
            stops[k][z] = log2(light->curves[k].light[z]);
        }
        series[k] = (struct plot_series){.label = names[k], .y = stops[k], .style = k};
    }
    const struct plot plot = {.title = "Response of the camera",
                              .subtitle = "recovered from the bracket; code 128 as sRGB has it",
                              .x_label = "code",
                              .y_label = "log2 of light",
                              .x = codes,
                              .count = FRAME_LEVELS,
                              .series = series,
                              .series_count = FRAME_CHANNELS};
    return plot_draw(&plot, &drawing, error) && drawing_write(job, &drawing, sink, error);
}

static bool tone_curves(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct tone_light *light;
    if (!tone_light_of(job, &light, error)) {
        return false;
    }
    sink->remarks = light->remarks;
    if (strcmp(job->type->ending, ".csv") == 0) {
        output_string(sink, "code,red,green,blue\n");
        for (int z = 0; z < FRAME_LEVELS; z++) {
            output_printf(sink, "%d,%.6g,%.6g,%.6g\n", z, light->curves[0].light[z],
                          light->curves[1].light[z], light->curves[2].light[z]);
        }
        return true;
    }
    return draw_curves(light, job, sink, error);
}

#define INPUT struct tone_input

static const struct option options[] = {
    {ASKED(files), .name = "frames", .value = "FILE[=TIME]",
     .flags = OPTION_OPERAND | OPTION_TOGETHER | OPTION_FILE,
     .help = "a picture (.png, .jpg, .exr, .pfm, .hdr), or the frames of a bracket: a.jpg=1/60"},
    {ASKED(times), .name = "times", .value = "TIMES",
     .help = "exposure times of the frames, in their order: 1/60,1/15; default as the files say"},
    {ASKED(response), .name = "response", .words = responses, .fallback = "file", .value = "NAME",
     .help = "how the values of the files relate to light"},
    {ASKED(align), .name = "align", .help = "align frames that camera movement has shifted"},
    {MEASURE(full_well, number, NULL, "NUMBER"), .name = "full-well", .lowest = 1, .highest = 1e12,
     .help = "electrons at white; default as the files say, or 20000"},
    {MEASURE(read_noise, number, NULL, "NUMBER"), .name = "read-noise", .lowest = 0, .highest = 1e6,
     .help = "read noise, electrons; default as the files say, or 5"},
    {ASKED(fnumber), .name = "aperture", .letter = 'N', .quantity = "f-number",
     .dimension = &dimension_fnumber, .lowest = 0, .highest = 1e12, .flags = OPTION_ABOVE_LOWEST,
     .value = "NUMBER", OPTION_USUAL_FNUMBER,
     .help = "f-number of all frames, which luminance follows from; default as the files say"},
    {ASKED(iso), .name = "iso", .quantity = "ISO speed", .dimension = &dimension_iso, .lowest = 0,
     .highest = 1e12, .flags = OPTION_ABOVE_LOWEST, .value = "SPEED",
     .help = "ISO speed of all frames, the same"},
    {ASKED(calibrate), .name = "calibrate", .dimension = &dimension_luminance, .lowest = 0,
     .highest = 1e12, .flags = OPTION_ABOVE_LOWEST, .unit = "cd_m2", .value = "LUMINANCE",
     .excludes = "aperture iso",
     .help = "luminance of the value 1, in a bracket at 1 s; default by f-number and ISO, or 1"},
    {MEASURE(view, angle, "deg", "ANGLE"), .name = "fov", .lowest = 0,
     .highest = 120 * RADIANS_PER_DEGREE, .flags = OPTION_ABOVE_LOWEST, .fallback = "45",
     .help = "angle of view across the width"},
    {ASKED(glare), .name = "glare", .help = "add the veiling glare of the eye"},
    {ASKED(color_loss), .name = "color-loss",
     .help = "fade the colours that the eye does not see in the dark"},
    {ASKED(acuity), .name = "acuity",
     .help = "blur detail that is too fine for the eye in so little light"},
    {ASKED(operation), .name = "operator", .words = operators, .fallback = "auto", .value = "NAME",
     .help = "tone mapping operator"},
    {ASKED(ceiling), .name = "ceiling", .words = ceilings, .fallback = "linear", .value = "NAME",
     .help = "limit of contrast for ward"},
    {ASKED(white), .name = "white", .dimension = &dimension_luminance, .lowest = 0, .highest = 1e12,
     .flags = OPTION_ABOVE_LOWEST, .unit = "cd_m2", .value = "LUMINANCE",
     .help = "luminance that becomes white; default from the log-average"},
    {MEASURE(gamma, number, NULL, "NUMBER"), .name = "gamma", .lowest = 0.1, .highest = 10,
     .fallback = "2.2", .help = "power of the operator gamma: 1/NUMBER"},
    {ASKED(display), .name = "display", .value = "MIN,MAX",
     .help = "what the display shows, cd/m2; default 1,100"},
    {ASKED(falsecolor), .name = "falsecolor", .excludes = "operator ceiling gamma white display",
     .help = "luminance in false colours, with a scale"},
    {ASKED(scale), .name = "scale", .value = "MIN,MAX", .wants = "falsecolor",
     .help = "ends of that scale, cd/m2; default whole decades, six at most"},
    {ASKED(bits), .name = "bits", .lowest = 8, .highest = 32, .value = "8|16|32",
     .help = "bits per value: PNG 8 or 16 (8), OpenEXR 16 or 32 (32)"},
};

static bool check_curves(const struct artifact_job *job, struct error *error)
{
    const struct tone_input *input = job->inputs[0];
    if (input->files == NULL) {
        return fail(error, ERROR_USAGE, "no picture is given");
    }
    return input->response == RESPONSE_DEBEVEC ||
           fail(error, ERROR_USAGE, "{--curves}: none are recovered without {--response} debevec");
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(tone_picture_types), .scope = ARTIFACT_OF_ANSWER, .is_binary = true,
     .check = tone_picture_check, .make = tone_picture},
    {ARTIFACT_OPTION("curves", tone_curve_types, "the recovered response, drawn or as numbers"),
     .scope = ARTIFACT_OF_ANSWER, .check = check_curves, .make = tone_curves},
};

static const struct example examples[] = {
    {"render chart:wedge --lens double-gauss-50 -s 2m --size 96x64 --samples 4 "
     "-t 1/15,1/60,1/250,1/1000 -o wedge.png",
     "a bracket, to begin with"},
    {"tone wedge-*.png -o wedge.hdr", "merged: the light of the scene, in cd/m2"},
    {"tone wedge.hdr -o shown.png", "shown by histogram adjustment"},
    {"tone wedge-*.png --ceiling human --glare --color-loss --acuity -o eye.png",
     "as an eye would see it"},
    {"tone wedge.hdr --falsecolor -o luminance.png", "luminance in false colours"},
    {"tone wedge-*.png --response debevec --curves response.svg -o recovered.hdr",
     "with the camera's response recovered, and drawn"},
    {NULL, NULL},
};

const struct command command_tone = {
    .name = "tone",
    .group = "camera",
    .summary = "exposure brackets merged into HDR; tone mapping",
    COMMAND_ASKS(struct tone_input),
    COMMAND_MAKES(artifacts),
};
