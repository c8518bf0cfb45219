/* commands/photo/cmd_motion.c - lenscalc motion: blur of moving subjects and unsteady cameras. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/pixels.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/given.h"
#include "photo/motion.h"

#include "base/constants.h"

#include <math.h>

struct motion_input {
    struct focal_value focal;
    double distance, magnification, speed, time, angle, height;
    double rotation, track, stabiliser, readout;
    struct coc_value blur;
    double field_width, gsd;
    bool is_bare; /* a pixel on the subject, and no pixel of a sensor that it could be */
    struct pixels_value pixels;
    struct sharpness sharp;
};

#define INPUT struct motion_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(focal, OPTION_SETTING),
    OPTION_DISTANCE(distance, OPTION_SETTING, "distance of the subject"),
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm',
     ABOVE_0 | OPTION_GOAL, .help = "in place of focal length and distance: 1:2 or 0.5"},
    {MEASURE(speed, speed, "m_s", "SPEED"), REPEATED("speed"), .letter = 'v',
     ABOVE_0 | OPTION_SETTING, .help = "speed of the subject: 5m/s, 30km/h, 20mph"},
    OPTION_TIME(time, OPTION_SETTING),
    {MEASURE(blur, length, "mm", "LENGTH"), REPEATED("blur"), .flags = OPTION_GOAL,
     .help =
         "blur allowed on the sensor: 0.02mm, 2px, d/1500 (the circle of confusion unless given)"},
    {MEASURE(angle, angle, "deg", "ANGLE"), REPEATED("angle"), .quantity = "angle of the motion",
     .lowest = 0, .highest = PI, .fallback = "90",
     .help = "direction of the motion: 90 deg across the view, 0 straight at the camera"},
    {MEASURE(height, length, "mm", "LENGTH"), REPEATED("height"), .quantity = "image height",
     .fallback = "0", .flags = OPTION_NO_INFINITY,
     .help = "image height of the subject, for motion in depth"},
    {MEASURE(rotation, rotation, "deg_s", "RATE"), REPEATED("rotation"), ABOVE_0,
     .help = "rotation rate of the camera: shake or pan"},
    {MEASURE(track, ratio, NULL, "FRACTION"), REPEATED("track"), FROM_0,
     .help = "panning: 1 follows exactly, 0.9 lags by a tenth"},
    {MEASURE(stabiliser, stops, NULL, "STOPS"), REPEATED("stabiliser"), .lowest = 0, .highest = 20,
     .fallback = "0", .help = "stops gained by stabilisation, for the hand-held rule"},
    {MEASURE(readout, time, "s", "TIME"), REPEATED("readout"), .quantity = "readout time",
     ABOVE_0 | OPTION_NO_SERIES, .help = "rolling shutter: time from first to last row"},
    {MEASURE(field_width, length, "m", "LENGTH"), .name = "field-width", .column = "field_width",
     ABOVE_0, .excludes = "magnification distance focal-length rotation track readout height",
     .help = "width of what is in the picture, in place of lens and distance: with --pixels, or by "
             "the width of --sensor"},
    {ASKED(pixels), .name = "pixels", .value = "N|WxH|Mpx", .wants = "field-width",
     .no_number = "a blur of 8 pixels is --blur 8px",
     .help =
         "pixels across --field-width; then 1 px of blur is allowed unless --blur or --coc says "
         "otherwise"},
    {MEASURE(gsd, length, "mm", "LENGTH"), REPEATED("gsd"), .quantity = "pixel on the subject",
     ABOVE_0,
     .excludes = "magnification distance focal-length rotation track readout height field-width "
                 "pixels print viewing acuity stabiliser",
     .help = "width of a pixel on the subject, in place of lens and distance; 1 px of blur is "
             "allowed then unless --blur says otherwise"},
    SHARPNESS_OPTIONS(sharp, 0, "d/1500", NULL),
};

struct motion_row {
    struct motion motion;
    double field_width, gsd, line_rate;
    double focal, distance, c, pitch;
    struct blur_size size;
    double image_speed, handheld;
    struct shake shake;
    double shake_pixels;
    double track;
    struct panning_blur pan;
    struct rolling_skew skew;
    const char *sensor, *criterion;
};

#define ROW struct motion_row

static const struct column columns[] = {
    COLUMN_FOCAL(focal, 0),
    {LENGTH(distance, "m"), .name = "distance", .flags = COLUMN_ECHO | COLUMN_INFINITE,
     .symbol = "s", .with = "distance", .help = "distance of the subject"},
    COLUMN_MAGNIFICATION(motion.m, 0),
    {LENGTH(field_width, "m"), .name = "field_width", ECHO_WITH("field-width"),
     .label = "field width", .help = "width of what is in the picture"},
    {LENGTH(gsd, "mm"), .name = "gsd", .flags = COLUMN_SPARSE | COLUMN_WITH,
     .with = "gsd field-width", .repeats = "gsd", .symbol = "g", .label = "pixel on the subject",
     .help = "its width there"},
    {MEASURED(line_rate, rate, "Hz"), .name = "line_rate", WITH("gsd field-width") | COLUMN_SPARSE,
     .symbol = "lines", .label = "line rate", .help = "of a line-scan camera, for square pixels"},
    {MEASURED(motion.v, speed, "m_s"), .name = "speed", BRIEF, .symbol = "v",
     .help = "of the subject"},
    {ANGLE(motion.angle), .name = "angle", .flags = COLUMN_ECHO, .symbol = "a", .with = "angle",
     .help = "of the motion to the line of sight"},
    {TIME(motion.t), .name = "time", BRIEF | COLUMN_INFINITE, .symbol = "t",
     .help = "exposure time"},
    {LENGTH(motion.blur, "um"), .name = "blur", BRIEF, .symbol = "b",
     .help = "of the moving subject on the sensor"},
    {SHOWN(size.pixels), .name = "blur_pixels", .when = "with --pitch, or a camera of known pixels",
     .label = "blur in pixels", .help = "blur over pixel pitch"},
    {SHOWN(size.circles), .name = "blur_coc", BRIEF, .label = "blur in circles of confusion",
     .help = "blur over circle of confusion"},
    {MEASURED(image_speed, speed, "mm_s"), .name = "image_speed", .symbol = "w",
     .label = "speed of the image", .help = "on the sensor"},
    {TIME(handheld), .name = "handheld", .symbol = "th", .label = "hand-held at most",
     .help = "by the rule one over focal length"},
    {MEASURED(shake.omega, rotation, "deg_s"), .name = "rotation", ECHO_WITH("rotation"),
     .symbol = "omega", .label = "camera rotation", .help = "of the camera"},
    {LENGTH(shake.blur, "um"), .name = "shake", BRIEF_WITH("rotation"), .symbol = "bs",
     .label = "blur from camera shake", .help = "of everything that stands still"},
    {SHOWN(shake_pixels), .name = "shake_pixels", WITH("rotation"),
     .when = "with --pitch, or a camera of known pixels", .label = "shake in pixels",
     .help = "blur from camera shake over pixel pitch"},
    {SHOWN(track), .name = "track", ECHO_WITH("track"), .symbol = "k", .label = "tracking",
     .help = "pan rate over the right one"},
    {MEASURED(pan.rate, rotation, "deg_s"), .name = "pan_rate", BRIEF_WITH("track"),
     .symbol = "rate", .label = "matching pan rate", .help = "that follows exactly"},
    {LENGTH(pan.subject, "um"), .name = "subject_blur", BRIEF_WITH("track"), .symbol = "bt",
     .label = "blur left on the subject", .help = "when panning"},
    {LENGTH(pan.background, "um"), .name = "background_blur", BRIEF_WITH("track"), .symbol = "bb",
     .label = "blur of the background", .help = "when panning"},
    {LENGTH(skew.shift, "um"), .name = "skew_shift", WITH("readout"), .symbol = "x",
     .label = "rolling shutter shifts", .help = "from first to last row"},
    {ANGLE(skew.angle), .name = "skew", BRIEF_WITH("readout"), .symbol = "lean",
     .label = "skew of upright edges", .help = "by the rolling shutter"},
    COLUMN_SENSOR(sensor),
    COLUMN_COC(c, COLUMN_EXTRA, ""),
    COLUMN_CRITERION(criterion),
};

/* The blur that is given, or the circle of confusion where it limits an unknown. */
static bool motion_blur(const struct motion_input *input, double c, bool wanted, double *blur,
                        struct error *error)
{
    struct sharpness sharp = input->sharp;
    *blur = wanted ? c : NAN;
    if (!is_given(input->blur.coc.value)) {
        return true;
    }
    sharp.coc = input->blur;
    return sharpness_resolve(&sharp, NAN, blur, error);
}

/* Magnification from focal length and distance, or as given. */
static bool motion_magnify(const struct motion_input *input, double *m, struct error *error)
{
    *m = input->magnification;
    if (!is_given(input->focal.length) || !is_given(input->distance)) {
        return true;
    }
    if (is_given(*m)) {
        return fail(error, ERROR_USAGE,
                    "give {--magnification}, or {--focal-length} and {--distance}");
    }
    return motion_magnification(input->focal.length, input->distance, m, error);
}

/* A moving subject: speed, time, magnification or blur from the other three. */
static bool solve_subject(const struct motion_input *input, struct motion_row *row,
                          struct error *error)
{
    struct motion *motion = &row->motion;
    bool open = !is_given(input->speed) || !is_given(input->time) || !is_given(motion->m);
    if (!motion_blur(input, row->c, open, &motion->blur, error) || !motion_solve(motion, error)) {
        return false;
    }
    if (!is_given(row->distance) && is_given(row->focal)) {
        row->distance = row->focal * (1 + 1 / motion->m);
    }
    row->image_speed = motion->blur / motion->t;
    return blur_measure(motion->blur, row->pitch, row->c, &row->size, error);
}

/* A turning camera. Beside a moving subject it has that one's time. */
static bool solve_shake(const struct motion_input *input, struct motion_row *row,
                        struct error *error)
{
    struct shake *shake = &row->shake;
    bool alone = !is_given(input->speed);
    bool open = alone && !is_given(row->motion.t);
    if (alone && input->height != 0) {
        return fail(error, ERROR_USAGE,
                    "{--height} is of a subject that moves: it needs {--speed}");
    }
    *shake = (struct shake){row->focal, input->rotation, row->motion.t, NAN,
                            is_given(row->motion.m) ? row->motion.m : 0};
    if ((alone && !motion_blur(input, row->c, open, &shake->blur, error)) ||
        !shake_solve(shake, error)) {
        return false;
    }
    row->focal = shake->f;
    row->motion.t = shake->t;
    row->shake_pixels = shake->blur / row->pitch;
    return true;
}

static bool solve_panning(const struct motion_input *input, struct motion_row *row,
                          struct error *error)
{
    const struct panning_shot pan = {row->motion.v, row->motion.angle, row->motion.t,
                                     row->focal,    row->distance,     input->track};
    row->track = input->track;
    return panning_solve(&pan, &row->pan, error);
}

/* The magnification and the pixels of a field that is given, as a camera above a belt has it. */
static bool motion_take_field(struct motion_input *own, struct run *run, struct error *error)
{
    struct sharpness *sharp = &own->sharp;
    const struct pixels_question pixels = {own->pixels, sharp->pitch, false};
    const bool is_any = sharp->sensor.is_fallback && isnan(sharp->pitch);
    if (!is_given(own->field_width)) {
        return true;
    }
    if (pixels_given(&own->pixels)) {
        sharp->sensor.is_fallback = sharp->sensor.is_fallback && !is_any;
        /* of a sensor that nobody named the shape says nothing */
        if (!pixels_settle(&pixels, &sharp->sensor, run->arena, is_any ? NULL : run->doubts,
                           error)) {
            return false;
        }
        if (sharp->coc.is_fallback) {
            sharp->coc = (struct coc_value){{.kind = COC_PIXELS, .value = 1}, "1px", false};
        }
    }
    own->magnification = sharp->sensor.size.width / own->field_width;
    return true;
}

/* The magnification of a pixel on the subject; of no known pixel one of any size. */
static bool motion_take_gsd(struct motion_input *own, struct error *error)
{
    static const double ANY_PITCH = 1e-3; /* mm */
    struct sharpness *sharp = &own->sharp;
    if (!is_given(own->gsd)) {
        return true;
    }
    if (!is_given(sharp->pitch)) {
        sharp->pitch = sharp->sensor.size.pitch;
    }
    own->is_bare = !is_given(sharp->pitch);
    const bool is_blur = is_given(own->blur.coc.value) && own->blur.coc.kind != COC_PIXELS;
    const bool is_coc = !sharp->coc.is_fallback && sharp->coc.coc.kind != COC_PIXELS;
    if (own->is_bare && (is_blur || is_coc)) {
        return fail(error, ERROR_USAGE,
                    "{--%s} beside {--gsd} is in pixels, 2px: a length on the sensor needs "
                    "{--pitch}, or a camera of known pixels as {--sensor}",
                    is_blur ? "blur" : "coc");
    }
    if (own->is_bare) {
        sharp->pitch = ANY_PITCH;
    }
    if (sharp->coc.is_fallback) {
        sharp->coc = (struct coc_value){{.kind = COC_PIXELS, .value = 1}, "1px", false};
    }
    own->magnification = sharp->pitch / own->gsd;
    return true;
}

/* A lens and no motion: what is asked is how long it can be held by hand. */
static bool motion_is_still(const struct motion_input *input)
{
    const double others[] = {input->speed,    input->time,          input->magnification,
                             input->distance, input->rotation,      input->track,
                             input->readout,  input->blur.coc.value};
    bool is_still = is_given(input->focal.length) && input->height == 0;
    for (size_t i = 0; i < sizeof others / sizeof others[0] && is_still; i++) {
        is_still = !is_given(others[i]);
    }
    return is_still;
}

/* The question with what stands in place of others taken as these. */
static bool motion_settle(struct motion_input *own, struct run *run, struct error *error)
{
    if (!motion_take_field(own, run, error) || !motion_take_gsd(own, error) ||
        !sharpness_settle(&own->sharp, PITCH_FOR_MORE, run->doubts, error)) {
        return false;
    }
    const bool is_solved = is_given(own->time) && is_given(own->blur.coc.value);
    if (!is_solved && !is_given(own->focal.length) && !is_given(own->magnification)) {
        own->focal.length = own->sharp.sensor.focal; /* of a camera with one lens; else not known */
    }
    return true;
}

/* The blur of what moves, of what turns, and of the pan. */
static bool motion_fill(const struct motion_input *input, struct motion_row *row,
                        struct error *error)
{
    const bool turns = is_given(input->rotation);
    return sharpness_resolve(&input->sharp, NAN, &row->c, error) &&
           motion_magnify(input, &row->motion.m, error) &&
           ((turns && !is_given(input->speed)) || solve_subject(input, row, error)) &&
           (!turns || solve_shake(input, row, error)) &&
           (!is_given(input->track) || solve_panning(input, row, error));
}

/* A pixel on the subject, and how many of them pass in a second. */
static void motion_fill_pixels(const struct motion_input *input, struct motion_row *row)
{
    if (is_given(input->gsd) || is_given(input->field_width)) {
        row->gsd = row->pitch / row->motion.m;
        row->line_rate = row->motion.v * sin(row->motion.angle) / row->gsd;
    }
    if (input->is_bare) { /* of no known sensor */
        row->motion.m = row->motion.blur = row->image_speed = row->c = NAN;
        row->sensor = row->criterion = NULL;
        row->size.circles = NAN;
    }
}

static bool motion_run(const void *data, struct run *run, struct error *error)
{
    struct motion_input own = *(const struct motion_input *)data;
    const struct motion_input *input = &own;
    if (!motion_settle(&own, run, error)) {
        return false;
    }
    const bool is_still = motion_is_still(input);
    struct motion_row row = {
        .motion = {input->speed, input->time, NAN, NAN, is_still ? NAN : input->angle,
                   input->distance, input->height},
        .field_width = input->field_width,
        .gsd = NAN,
        .line_rate = NAN,
        .focal = input->focal.length,
        .distance = input->distance,
        .c = NAN,
        .pitch = sharpness_pitch(&own.sharp),
        .size = {NAN, NAN},
        .image_speed = NAN,
        .handheld = NAN,
        .shake = {NAN, NAN, NAN, NAN, NAN},
        .shake_pixels = NAN,
        .track = NAN,
        .pan = {NAN, NAN, NAN},
        .skew = {NAN, NAN},
        .sensor = input->sharp.sensor.name,
        .criterion = is_still ? NULL : input->sharp.coc.criterion,
    };
    const struct sensor *sensor = &input->sharp.sensor.size;
    if (!is_still && !motion_fill(input, &row, error)) {
        return false;
    }
    if ((is_given(input->readout) &&
         !rolling_shutter(row.image_speed, input->readout, sensor->height, &row.skew, error)) ||
        (is_given(row.focal) &&
         !handheld_time(row.focal, sensor_crop(sensor), input->stabiliser, &row.handheld, error))) {
        return false;
    }
    motion_fill_pixels(input, &row);
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"magnification", "m = {f}/({s} - {f})", "thin lens 1/f = 1/s + 1/v", NULL},
    {"blur", "b = {v} {t} {m} sin({a})", "central projection; across the view",
     "motion in depth adds its part: |v t (m sin a + h cos a/s)/(1 - v t cos a/s)|"},
    {"line_rate", "lines = {v} sin({a})/{g}", "one line a pixel of the way", NULL},
    {"handheld", "th = 2^stabiliser/(crop {f})", "rule of thumb; f in mm",
     "hands differ by more than a stop"},
    {"shake", "bs = {f} (1 + {m}) {omega} {t}", "image distance times the angle",
     "small angles, turned about the entrance pupil"},
    {"pan_rate", "rate = {v} sin({a})/{s}", "the subject's angular speed", NULL},
    {"subject_blur", "bt = |1 - {k}| {m} {v} sin({a}) {t}", "what the pan does not follow", NULL},
    {"background_blur", "bb = {k} {m} {v} sin({a}) {t}", "the pan itself", NULL},
    {"skew", "lean = atan({x}/height)", "image speed times readout, over the sensor's height",
     NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"motion -f 50mm -s 10m --speed 5km/h", "the longest time for a walker"},
    {"motion -f 100 -s 20m --speed 30km/h -t 1/60..1/2000", "blur of a cyclist by time"},
    {"motion -f 50 -s 5,10,20 --speed 2,5,10 --blur 2px --sensor \"Nikon D1\" --table s,v",
     "a table to print"},
    {"motion -f 200mm -s 30m --speed 60km/h -t 1/60 --track 0.95", "panning"},
    {"motion -f 85mm --rotation 2deg/s", "how long to hold still"},
    {"motion -v 2m/s --gsd 0.1mm", "a belt under a line-scan camera: line rate and exposure"},
    {"motion 200mm --sensor aps-c", "how long by hand: the rule of thumb alone"},
    {NULL, NULL},
};

const struct command command_motion = {
    .name = "motion",
    COMMAND_OF("photography", "blur of moving subjects, panning, shake, rolling shutter"),
    .run = motion_run,
    .plot = "time_s|blur_um|speed_m_s",
    .plot_titles = "Longest exposure without motion blur|Motion blur|"
                   "Highest speed without motion blur",
    .cell = "time_s",
};
