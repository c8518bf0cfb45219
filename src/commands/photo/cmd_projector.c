/* commands/photo/cmd_projector.c - lenscalc projector: throw, image size, brightness. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/tables.h"
#include "photo/projector.h"

#include <math.h>

struct projector_input {
    double throw_ratio, distance, aspect, diagonal, width, height;
    double flux, gain, illuminance, luminance;
};

#define INPUT struct projector_input

static const struct option options[] = {
    {MEASURE(throw_ratio, ratio, NULL, "RATIO"), .name = "throw", .quantity = "throw ratio",
     .column = "throw_ratio", ABOVE_0 | OPTION_SETTING,
     .help = "throw ratio of the lens, distance over width of the image: 1.5 or 1.5:1"},
    {MEASURE(distance, length, "m", "LENGTH"), REPEATED("distance"), .letter = 's',
     ABOVE_0 | OPTION_SETTING, .help = "distance from the lens to the screen"},
    {MEASURE(diagonal, length, "in", "LENGTH"), .name = "screen",
     .quantity = "diagonal of the image", .column = "diagonal", ABOVE_0 | OPTION_GOAL,
     .help = "diagonal of the image: 100in or 2.5m"},
    {MEASURE(width, length, "m", "LENGTH"), REPEATED("width"), .quantity = "width of the image",
     ABOVE_0 | OPTION_GOAL, .help = "width of the image, in place of the diagonal"},
    {MEASURE(height, length, "m", "LENGTH"), REPEATED("height"), .quantity = "height of the image",
     ABOVE_0 | OPTION_GOAL, .help = "or its height"},
    {MEASURE(aspect, ratio, NULL, "RATIO"), REPEATED("aspect"), .quantity = "aspect ratio", ABOVE_0,
     .fallback = "16:9", .help = "width over height of the image: 16:9, 4:3, 2.39"},
    {MEASURE(flux, luminous_flux, "lm", "FLUX"), .name = "lumens", .quantity = "luminous flux",
     .column = "flux", ABOVE_0 | OPTION_SETTING, .help = "luminous flux of the projector: 2000lm"},
    {MEASURE(gain, number, NULL, "NUMBER"), REPEATED("gain"), .quantity = "screen gain", ABOVE_0,
     .fallback = "1", .help = "gain of the screen; 1 is matte white"},
    {MEASURE(illuminance, illuminance, "lx", "LIGHT"), REPEATED("illuminance"),
     ABOVE_0 | OPTION_GOAL, .help = "wanted on the screen, 500lx: solves for the lumens"},
    {MEASURE(luminance, luminance, "cd_m2", "LIGHT"), REPEATED("luminance"), ABOVE_0 | OPTION_GOAL,
     .help = "wanted of white, 50nits or 16fL: solves for the lumens"},
};

struct projector_row {
    struct projector p;
};

#define ROW struct projector_row

static const struct column columns[] = {
    {SHOWN(p.throw_ratio), .name = "throw_ratio", BRIEF | COLUMN_SPARSE, .symbol = "R",
     .label = "throw ratio", .help = "distance over width of the image"},
    {LENGTH(p.distance, "m"), .name = "distance", BRIEF | COLUMN_SPARSE, .symbol = "D",
     .help = "distance from the lens to the screen"},
    {LENGTH(p.width, "m"), .name = "width", BRIEF, .symbol = "W", .label = "image width",
     .help = "of the image"},
    {LENGTH(p.height, "m"), .name = "height", BRIEF, .symbol = "h", .label = "image height",
     .help = "of the image"},
    {LENGTH(p.diagonal, "in"), .name = "diagonal", BRIEF, .symbol = "d", .label = "image diagonal",
     .help = "of the image"},
    {MEASURED(p.flux, luminous_flux, "lm"), .name = "flux", BRIEF | COLUMN_SPARSE, .symbol = "Phi",
     .label = "luminous flux", .help = "of the projector"},
    {MEASURED(p.illuminance, illuminance, "lx"), .name = "illuminance", BRIEF | COLUMN_SPARSE,
     .symbol = "E", .help = "on the screen"},
    {MEASURED(p.luminance, luminance, "cd_m2"), .name = "luminance", BRIEF | COLUMN_SPARSE,
     .symbol = "L", .help = "of white, seen along the screen's normal"},
    {MEASURED(p.luminance, luminance, "fL"), .name = "foot_lamberts", .label = "in foot-lamberts",
     .help = "the same as cinemas count it"},
    {SHOWN(p.aspect), .name = "aspect", ASSUMED_BY("aspect") | COLUMN_ECHO, .symbol = "a",
     .label = "aspect ratio", .help = "width over height of the image"},
    {SHOWN(p.gain), .name = "gain", ASSUMED_BY("gain") | COLUMN_ECHO, .symbol = "G",
     .label = "screen gain", .help = "luminance over that of a perfect diffuser"},
};

static bool projector_run(const void *data, struct run *run, struct error *error)
{
    const struct projector_input *input = data;
    struct projector_row row = {{input->throw_ratio, input->distance, input->aspect, input->width,
                                 input->height, input->diagonal, input->gain, input->flux,
                                 input->illuminance, input->luminance}};
    if (!projector_solve(&row.p, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"throw_ratio", "R = {D}/{W}", "definition, by the width of the image", NULL},
    {"width", "W = {d} {a}/sqrt(1 + {a}^2)", "Pythagoras", NULL},
    {"flux", "Phi = {E} {W} {h}", "definition of illuminance",
     "all light evenly on the image; the middle of a real one is brighter"},
    {"luminance", "L = {G} {E}/pi", "a diffuser of gain G", "seen along the normal"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"projector --throw 1.5 --screen 100in", "the distance for a screen of 100 inches"},
    {"projector --throw 1.4,2.24 -s 4m", "the smallest and largest image of a zoom lens"},
    {"projector --width 3m --gain 1.3 --luminance 50fL", "the lumens for 50 foot-lamberts"},
    {"projector --screen 100in,120in,150in --lumens 2500", "how bright it gets"},
    {"projector --lumens 1000 --luminance 16fL", "the largest cinema screen for a projector"},
    {NULL, NULL},
};

const struct command command_projector = {
    .name = "projector",
    COMMAND_OF("photography", "throw, image size, lumens and brightness of a projector"),
    .run = projector_run,
    .plot = "luminance_cd_m2|distance_m|width_m|flux_lm",
    .plot_titles = "Luminance of the screen|Throw distance|Width of the picture|Luminous flux",
    .cell = "distance_m",
};
