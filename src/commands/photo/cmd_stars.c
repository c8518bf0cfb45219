/* commands/photo/cmd_stars.c - lenscalc stars: how long before stars become trails. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "cli/question/command.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/given.h"
#include "photo/motion.h"
#include "photo/stars.h"

#include "base/constants.h"

#include <math.h>

struct stars_input {
    struct focal_value focal;
    double fnumber, declination, time, rule, accuracy;
    struct coc_value trail;
    struct sharpness sharp;
};

#define INPUT struct stars_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(focal, 0),
    OPTION_APERTURE(fnumber, 0),
    OPTION_DECLINATION(
        declination, NULL,
        "declination of the frame's centre; 0 is the celestial equator, where stars are fastest"),
    OPTION_TIME(time, 0),
    {MEASURE(trail, length, "um", "LENGTH"), .name = "trail", .column = "trail_wanted",
     .excludes = "coc",
     .help = "longest trail allowed: 2px, 10um, d/1500 (the circle of confusion unless given)"},
    SHARPNESS_OPTIONS_DARK(sharp, 0, "d/1500", NULL),
    OPTION_WAVELENGTH(sharp.wavelength, "coc=airy|trail=airy"),
    {MEASURE(rule, number, NULL, "NUMBER"), .name = "rule", .quantity = "rule constant",
     .column = "rule_constant", ABOVE_0, .fallback = "500",
     .no_number = "the NPF rule has no constant: the column npf answers it beside this rule",
     .help = "constant of the rule of thumb: 500, 400, 300 or 600"},
    {MEASURE(accuracy, number, NULL, "K"), REPEATED("accuracy"), ABOVE_0, .fallback = "1",
     .help = "factor k of the NPF rule: 1 for points, 2 and 3 for longer and longer trails"},
};

struct stars_row {
    double focal, fnumber, declination, allowed, pitch, crop, rule, accuracy;
    struct star_time time;
    double rule_time, npf, npf_simple, four_minus_crop;
    double npf_fnumber, npf_pitch; /* given or assumed */
    const char *npf_assumed;
    double exposure;
    struct star_trail trail;
    double worst;
    struct blur_size size;
    const char *sensor, *criterion;
};

#define ROW struct stars_row

static const struct column columns[] = {
    {SHOWN(npf_fnumber), .name = "npf_fnumber", .flags = COLUMN_EXTRA, .symbol = "N",
     .label = "f-number of the NPF rule", .help = "as given, else 2.8"},
    {LENGTH(npf_pitch, "um"), .name = "npf_pitch", .flags = COLUMN_EXTRA, .symbol = "p",
     .label = "pixel pitch of the NPF rule",
     .help = "as given or of the camera, else that of 24 megapixels on the sensor"},
    {LENGTH(focal, "mm"), .name = "focal", BRIEF | COLUMN_ECHO, .symbol = "f",
     .label = "focal length", .help = "focal length"},
    COLUMN_FNUMBER(fnumber, 0),
    {ANGLE(declination), .name = "declination", .flags = COLUMN_ECHO, .symbol = "dec",
     .with = "declination", .help = "of the frame's centre"},
    {LENGTH(allowed, "um"), .name = "allowed_trail", .symbol = "a", .label = "allowed trail",
     .help = "on the sensor"},
    {TIME(time.exact), .name = "exact", BRIEF | COLUMN_INFINITE, .symbol = "t",
     .label = "longest time, exact",
     .help = "that keeps the trail within the allowed length, exact"},
    {TIME(time.linear), .name = "linear", .symbol = "tl", .label = "linear in time",
     .help = "the same to first order"},
    {TIME(rule_time), .name = "rule_of_thumb", BRIEF, .symbol = "tr", .label = "by the 500 rule",
     .help = "constant over crop factor and focal length"},
    {TIME(npf), .name = "npf", BRIEF, .symbol = "tn", .label = "by the NPF rule",
     .help = "by f-number and pixel pitch"},
    {TIME(npf_simple), .name = "npf_simple", .symbol = "ts", .label = "by the simple NPF rule",
     .help = "without declination"},
    {TIME(four_minus_crop), .name = "four_minus_crop", .symbol = "t4",
     .label = "by the 4 - crop rule", .help = "for crop factors below 4"},
    {TIME(exposure), .name = "time", ECHO_WITH("time") | COLUMN_BRIEF, .symbol = "T",
     .label = "exposure time", .help = "exposure time"},
    {LENGTH(trail.chord, "um"), .name = "star_trail", BRIEF_WITH("time") | COLUMN_INFINITE,
     .symbol = "x", .label = "trail", .help = "end to end on the sensor, exact"},
    {LENGTH(trail.linear, "um"), .name = "linear_trail", WITH("time"), .symbol = "xl",
     .label = "trail, linear in time", .help = "to first order in time"},
    {LENGTH(worst, "um"), .name = "worst_trail", WITH("time"), .symbol = "xw",
     .label = "worst trail in the frame",
     .help = "the longest in the picture, however the camera is turned, to first order in time"},
    {SHOWN(size.pixels), .name = "trail_pixels", BRIEF_WITH("time") | COLUMN_INFINITE,
     .label = "in pixels", .help = "trail over pixel pitch"},
    {SHOWN(size.circles), .name = "trail_coc", WITH("time") | COLUMN_INFINITE,
     .label = "in circles of confusion", .help = "trail over allowed trail"},
    {MEASURED(trail.arc, angle, "arcmin"), .name = "arc", WITH("time"), .symbol = "arc",
     .label = "arc in the sky", .help = "along the star's circle"},
    {ANGLE(trail.rotation), .name = "rotation", BRIEF_WITH("time"), .symbol = "rot",
     .label = "angle about the pole", .help = "that the trails of a picture span"},
    {SHOWN(crop), .name = "crop_factor", .flags = COLUMN_EXTRA, .symbol = "crop",
     .label = "crop factor", .help = "43.27 mm over the sensor's diagonal"},
    {SHOWN(rule), .name = "rule_constant", ASSUMED_BY("rule") | COLUMN_ECHO, .symbol = "rule",
     .label = "rule", .help = "constant of the rule of thumb"},
    {SHOWN(accuracy), .name = "accuracy", ECHO_WITH("accuracy"), .symbol = "k",
     .label = "k of the NPF rule", .help = "its accuracy"},
    {SHOWN(npf_assumed), .name = "npf_assumed", ASSUMED_BY("pitch sensor aperture"),
     .label = "NPF rule for", .help = "what was taken where f-number or pixel pitch is not known"},
    {LENGTH(pitch, "um"), .name = "pitch", ASSUMED_BY("pitch sensor"), .label = "pixel pitch",
     .help = "spacing of the pixels"},
    COLUMN_SENSOR(sensor),
    {SHOWN(criterion), .name = "trail_criterion", ASSUMED_BY("coc trail"),
     .label = "trail criterion", .help = "where the allowed trail comes from"},
};

/* A camera and a lens of today for the NPF rule, where neither is given. */
#define USUAL_FNUMBER    2.8
#define USUAL_MEGAPIXELS 24

/* What the NPF rule wants, and what of it is assumed. */
static void stars_assume(const struct sensor *sensor, struct stars_row *row, struct arena *arena)
{
    bool has_N = is_given(row->fnumber), has_pitch = is_given(row->pitch);
    row->npf_fnumber = has_N ? row->fnumber : USUAL_FNUMBER;
    row->npf_pitch = has_pitch ? row->pitch : sensor_pitch_of(sensor, USUAL_MEGAPIXELS * 1e6);
    if (!has_pitch) {
        row->npf_assumed = arena_printf(arena, "%s%d megapixels of %.3g um (default)",
                                        has_N ? "" : "f/2.8 (default) and ", USUAL_MEGAPIXELS,
                                        1000 * row->npf_pitch);
    } else if (!has_N) {
        row->npf_assumed = "f/2.8 (default)";
    }
}

/* The rules of thumb. */
static bool apply_rules(struct stars_row *row, struct error *error)
{
    row->npf = row->npf_simple = row->four_minus_crop = NAN;
    if (!star_rule_time(row->rule, row->focal, row->crop, &row->rule_time, error) ||
        (row->crop < 4 &&
         !four_minus_crop_time(row->focal, row->crop, &row->four_minus_crop, error))) {
        return false;
    }
    const double f = row->focal, N = row->npf_fnumber, pitch = row->npf_pitch;
    return npf_simple_time(f, N, pitch, &row->npf_simple, error) &&
           npf_full_time(f, N, pitch, row->declination, row->accuracy, &row->npf, error);
}

static bool measure_trail(const struct sensor *sensor, struct stars_row *row, struct error *error)
{
    return !is_given(row->exposure) ||
           (star_trail(row->focal, row->declination, row->exposure, &row->trail, error) &&
            star_trail_worst(row->focal, row->declination, row->exposure,
                             sensor_diagonal(sensor) / 2, &row->worst, error) &&
            blur_measure(row->trail.chord, row->pitch, row->allowed, &row->size, error));
}

static bool stars_run(const void *data, struct run *run, struct error *error)
{
    const struct stars_input *input = data;
    const struct sensor *sensor = &input->sharp.sensor.size;
    struct stars_row row = {
        .focal = input->focal.length,
        .fnumber = input->fnumber,
        .declination = input->declination,
        .pitch = sharpness_pitch(&input->sharp),
        .crop = sensor_crop(sensor),
        .rule = input->rule,
        .accuracy = input->accuracy,
        .exposure = input->time,
        .trail = {NAN, NAN, NAN, NAN, NAN},
        .worst = NAN,
        .size = {NAN, NAN},
        .sensor = input->sharp.sensor.name,
    };
    if (!is_given(row.focal) && !is_given(row.exposure)) {
        return fail(error, ERROR_USAGE,
                    "give {--focal-length} for the longest time, or {--time} for "
                    "the longest focal length");
    }
    stars_assume(sensor, &row, run->arena);
    /* How long a trail may be: as asked, else the circle of confusion. */
    struct sharpness sharp = input->sharp;
    if (!sharpness_settle(&sharp, PITCH_FOR_MORE, run->doubts, error)) {
        return false;
    }
    if (is_given(input->trail.coc.value)) {
        if (coc_is_print(&sharp.coc) && !coc_is_print(&input->trail)) {
            return fail(error, ERROR_USAGE,
                        "{--print}, {--viewing} and {--acuity} serve {--trail} print only");
        }
        sharp.coc = input->trail;
    }
    row.criterion = sharp.coc.criterion;
    if (!sharpness_resolve(&sharp, input->fnumber, &row.allowed, error) ||
        (!is_given(row.focal) &&
         !star_focal_length(row.declination, row.exposure, row.allowed, &row.focal, error)) ||
        !star_time(row.focal, row.declination, row.allowed, &row.time, error) ||
        !apply_rules(&row, error) || !measure_trail(sensor, &row, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"exact",
     "t = 4 atan(u)/w, u = {a}/(2 g + sqrt(4 g^2 + {a}^2 cos(2 {dec}))), g = {f} "
     "cos({dec})",
     "inverse of the trail; w = 2 pi/86164.1 s, the Earth's rotation",
     "at the frame's centre, rectilinear lens, camera at rest"},
    {"linear", "tl = {a}/({f} w cos({dec}))", "first order in time", NULL},
    {"rule_of_thumb", "tr = {rule}/({crop} {f})", "rule of thumb from the days of film; f in mm",
     "on the equator the trail is 0.036 mm/crop: several pixels of any digital camera"},
    {"npf", "tn = {k} (16.9 {N} + 0.10 {f} + 13.7 {p})/({f} cos({dec}))",
     "F. Michaud, Regle NPF, Societe Astronomique du Havre; f in mm, p in um",
     "the meanings of k = 1, 2, 3 are not checked first-hand"},
    {"npf_simple", "ts = (35 {N} + 30 {p})/{f}",
     "F. Michaud, Regle NPF, Societe Astronomique du Havre; f in mm, p in um", NULL},
    {"four_minus_crop", "t4 = 100 (4 - {crop})/{f}",
     "F. Michaud, webastro.net topic 186159; f in mm", NULL},
    {"star_trail", "x = 2 {f} cos({dec}) sin(q)/(1 - 2 cos^2({dec}) sin^2(q/2)), q = w {T}/2",
     "[Snyder87] eq. 22-4, gnomonic projection", "without refraction of the air"},
    {"linear_trail", "xl = {f} w {T} cos({dec})", "first order in time", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"stars -f 20mm -N 1.8 --sensor \"Nikon D850\"", "with the pixels of a camera"},
    {"stars -f 24mm -N 2.8 --pitch 4.35um", "500 rule, NPF rule and exact, side by side"},
    {"stars -f 14,20,24,35,50 -N 2.8 --pitch 5um --trail 2px", "a table to carry along"},
    {"stars -f 50mm --declination 60deg -t 20s", "how long the trails of 20 seconds are"},
    {"stars -t 15s --declination 45deg", "the longest focal length for 15 seconds"},
    {NULL, NULL},
};

const struct command command_stars = {
    .name = "stars",
    COMMAND_OF("photography", "longest exposure without star trails, and the length of trails"),
    .run = stars_run,
    .plot = "exact_s,rule_of_thumb_s,npf_s",
    .plot_titles = "Longest exposure without star trails",
    .cell = "exact_s",
};
