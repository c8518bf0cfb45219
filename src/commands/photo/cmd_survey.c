/* commands/photo/cmd_survey.c - lenscalc survey: pictures from the air. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/pixels.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/fov.h"
#include "photo/given.h"
#include "photo/survey.h"

#include <math.h>

struct survey_input {
    struct focal_value focal;
    struct sensor_value sensor;
    struct pixels_value pixels;
    double pitch, altitude, gsd, overlap, sidelap, speed, interval, blur, time;
    int along;
};

/* Which side of the picture lies along the track. */
enum track_side { TRACK_HEIGHT, TRACK_WIDTH };

static const struct word sides[] = {
    [TRACK_HEIGHT] = {"height", "the short side of most pictures, as drones fly"},
    [TRACK_WIDTH] = {"width", "its width"},
    {NULL, NULL},
};

#define INPUT struct survey_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(focal, 0),
    {ASKED(sensor), REPEATED("sensor"), .fallback = "35mm", .value = "NAME|WxH",
     .flags = OPTION_OPERAND | OPTION_REST,
     .help = "drone, camera or format by name, or a size: 13.2x8.8mm"},
    OPTION_PIXELS(pixels, "pixels of --sensor, or with --pitch in its place: 5472x3648, 20Mpx"),
    OPTION_PITCH_ALONE(pitch, NULL, "pixel pitch (otherwise that of the camera)"),
    {MEASURE(altitude, length, "m", "LENGTH"), REPEATED("altitude"), ABOVE_0 | OPTION_SETTING,
     .help = "above level ground, the camera straight down"},
    {MEASURE(gsd, length, "cm", "LENGTH"), REPEATED("gsd"), .quantity = "ground sample",
     ABOVE_0 | OPTION_GOAL, .help = "wanted ground sampling distance: solves for the altitude"},
    {MEASURE(overlap, ratio, NULL, "FRACTION"), REPEATED("overlap"), .lowest = 0, .highest = 1,
     .flags = OPTION_BELOW_HIGHEST, .help = "overlap of successive pictures: 80%, 0.8"},
    {MEASURE(sidelap, ratio, NULL, "FRACTION"), REPEATED("sidelap"), .lowest = 0, .highest = 1,
     .flags = OPTION_BELOW_HIGHEST, .help = "overlap of neighbouring lines of flight: 70%"},
    {ASKED(along), REPEATED("along"), .words = sides, .fallback = "height", .value = "SIDE",
     .wants = "overlap|sidelap", .help = "the side of the picture that lies along the track"},
    {MEASURE(speed, speed, "m_s", "SPEED"), REPEATED("speed"), .letter = 'v',
     ABOVE_0 | OPTION_SETTING, .help = "over the ground: 10m/s, 36km/h"},
    {MEASURE(interval, time, "s", "TIME"), REPEATED("interval"),
     ABOVE_0 | OPTION_NO_SERIES | OPTION_GOAL, .wants = "overlap", .excludes = "speed",
     .help = "between two pictures, as the camera can: solves for the speed"},
    {MEASURE(blur, pixels, NULL, "PIXELS"), REPEATED("blur"), ABOVE_0, .fallback = "0.5",
     .wants = "speed|interval|time", .help = "pixels that the ground may move during an exposure"},
    {MEASURE(time, time, "s", "TIME"), REPEATED("time"), .letter = 't', .quantity = "exposure time",
     ABOVE_0,
     .help = "exposure time: adds how far the ground moves, 1/1000; or, alone, gives the highest "
             "speed"},
};

struct survey_row {
    double focal, overlap, sidelap, blur, time, pitch;
    struct fov_ground ground;
    struct survey_plan plan;
    const char *sensor, *along;
};

#define ROW struct survey_row

static const struct column columns[] = {
    {LENGTH(focal, "mm"), .name = "focal", .flags = COLUMN_ECHO, .symbol = "f",
     .with = "focal-length", .label = "focal length", .help = "given, or that of the camera"},
    {LENGTH(ground.altitude, "m"), .name = "altitude", BRIEF, .symbol = "A",
     .help = "of the entrance pupil above level ground"},
    {LENGTH(ground.sample, "cm"), .name = "gsd", BRIEF, .symbol = "g",
     .label = "ground sampling distance", .help = "of one pixel"},
    {LENGTH(ground.width, "m"), .name = "ground_width", BRIEF, .symbol = "W",
     .label = "ground width", .help = "of the ground in a picture"},
    {LENGTH(ground.height, "m"), .name = "ground_height", BRIEF, .symbol = "H",
     .label = "ground height", .help = "of the ground in a picture"},
    {SHOWN(overlap), .name = "overlap", ECHO_WITH("overlap"), .symbol = "o",
     .help = "of each picture and the next"},
    {LENGTH(plan.base, "m"), .name = "photo_spacing", BRIEF_WITH("overlap"), .symbol = "B",
     .label = "from photo to photo", .help = "along the track"},
    {SHOWN(sidelap), .name = "sidelap", ECHO_WITH("sidelap"), .symbol = "q",
     .help = "of each line and the next"},
    {LENGTH(plan.spacing, "m"), .name = "line_spacing", BRIEF_WITH("sidelap"), .symbol = "S",
     .label = "from line to line", .help = "across the track"},
    {MEASURED(plan.speed, speed, "m_s"), .name = "speed", BRIEF_WITH("speed interval time"),
     .symbol = "v", .help = "over the ground"},
    {MEASURED(plan.interval, time, "s"), .name = "interval",
     WITH("overlap interval") | COLUMN_BRIEF | COLUMN_SPARSE | COLUMN_SPAN, .symbol = "i",
     .label = "photo interval", .when = "with --speed or --interval",
     .help = "from one exposure to the next"},
    {TIME(plan.longest), .name = "longest", BRIEF_WITH("speed interval time"), .symbol = "tl",
     .label = "longest exposure", .help = "with no more blur than that"},
    {TIME(time), .name = "time", ECHO_WITH("time"), .symbol = "t", .label = "exposure time",
     .help = "exposure time"},
    {MEASURED(plan.moved, pixels, "px"), .name = "motion", BRIEF_WITH("time"), .symbol = "m",
     .label = "motion of the ground", .help = "of the ground during the exposure"},
    {LENGTH(pitch, "um"), .name = "pitch", ASSUMED_BY("pitch sensor pixels"), .symbol = "p",
     .label = "pixel pitch", .help = "spacing of the pixels"},
    COLUMN_SENSOR(sensor),
    {SHOWN(along), .name = "along", ASSUMED_WITH("overlap sidelap", "along"),
     .label = "side along the track", .help = "side of the picture"},
    {MEASURED(blur, pixels, "px"), .name = "blur",
     ASSUMED_WITH("speed interval time", "blur") | COLUMN_ECHO, .symbol = "b",
     .label = "blur at most", .help = "during an exposure"},
};

/* The focal length, given or that of a camera whose lens is fixed. */
static bool survey_focal(const struct survey_input *input, double *focal, struct error *error)
{
    *focal = is_given(input->focal.length) ? input->focal.length : input->sensor.focal;
    return is_given(*focal) ||
           fail(error, ERROR_USAGE,
                "give {--focal-length}, or a drone with a lens of its own as {--sensor}");
}

/* A ground sample and no camera: what follows of the flight alone. */
static bool survey_is_bare(const struct survey_input *input)
{
    return is_given(input->gsd) && !is_given(input->altitude) && input->sensor.is_fallback &&
           !is_given(input->focal.length) && !is_given(input->focal.equivalent) &&
           !is_given(input->pitch) && !pixels_given(&input->pixels) && !is_given(input->overlap) &&
           !is_given(input->sidelap) && (is_given(input->speed) || is_given(input->time));
}

/* The camera, and what it sees of the ground. */
static bool survey_look(const struct survey_input *input, struct survey_row *row, struct run *run,
                        struct error *error)
{
    const struct pixels_question pixels = {input->pixels, input->pitch, false};
    struct sensor_value sensor = input->sensor;
    struct fov fov;
    if (!pixels_settle(&pixels, &sensor, run->arena, run->doubts, error) ||
        !survey_focal(input, &row->focal, error)) {
        return false;
    }
    row->sensor = sensor.name;
    row->pitch = sensor.size.pitch;
    sharpness_doubt_pitch(&(struct sharpness){.sensor = sensor, .pitch = NAN}, run->doubts);
    const struct fov_setting lens = {RECTILINEAR, row->focal, INFINITY, 1, 1};
    if (!is_given(row->pitch)) {
        return fail(error, ERROR_USAGE,
                    "ground sampling needs pixels: give {--pitch}, {--pixels}, or a camera as "
                    "{--sensor}");
    }
    return fov_compute(&lens, &sensor.size, &fov, error) &&
           fov_ground(&lens, &fov, row->pitch, &row->ground, error);
}

static bool survey_run(const void *data, struct run *run, struct error *error)
{
    const struct survey_input *input = data;
    struct survey_row row = {
        .overlap = input->overlap,
        .sidelap = input->sidelap,
        .blur = input->blur,
        .time = input->time,
        .focal = NAN,
        .pitch = NAN,
        .ground = {input->altitude, input->gsd, NAN, NAN},
        .along = sides[input->along].word,
    };
    if (!survey_is_bare(input) && !survey_look(input, &row, run, error)) {
        return false;
    }
    const bool is_wide = input->along == TRACK_WIDTH;
    const struct survey_flight flight = {
        .along = is_wide ? row.ground.width : row.ground.height,
        .across = is_wide ? row.ground.height : row.ground.width,
        .sample = row.ground.sample,
        .overlap = input->overlap,
        .sidelap = input->sidelap,
        .speed = input->speed,
        .interval = input->interval,
        .blur = input->blur,
        .time = input->time,
    };
    if (!survey_solve(&flight, &row.plan, error)) {
        return false;
    }
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"gsd", "g = {p} {A}/{f}", "[Pix4D26] similar triangles", "level ground, straight down"},
    {"photo_spacing along=height", "B = {H} (1 - {o})", "definition of the overlap", NULL},
    {"photo_spacing along=width", "B = {W} (1 - {o})", "definition of the overlap", NULL},
    {"line_spacing along=height", "S = {W} (1 - {q})", "definition of the sidelap", NULL},
    {"line_spacing along=width", "S = {H} (1 - {q})", "definition of the sidelap", NULL},
    {"interval", "i = {B}/{v}", "definition", NULL},
    {"longest", "tl = {b} {g}/{v}", "the ground moves b pixels",
     "of the flight alone: turning and shaking come to it"},
    {"motion", "m = {v} {t}/{g}", "the same", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"survey Mavic 3 --altitude 100m", "ground sampling distance and footprint"},
    {"survey Mavic 3 --gsd 2cm", "the altitude for 2 cm"},
    {"survey Mavic 3 --altitude 100m --overlap 80% --sidelap 70% -v 10m/s",
     "a plan: intervals, lines, shutter"},
    {"survey --gsd 3cm -t 1/500", "the fastest flight for an exposure, whatever the camera"},
    {"survey Mavic 3 --altitude 60m,120m --overlap 80% --interval 2s",
     "how fast to fly with two seconds a picture"},
    {"survey -f 35 --sensor 35mm --pixels 8192x5460 --altitude 100m -v 15m/s -t 1/1000",
     "another camera, and how far the ground moves"},
    {NULL, NULL},
};

const struct command command_survey = {
    .name = "survey",
    COMMAND_OF("photography", "aerial surveys: ground sampling, overlaps, intervals, blur"),
    .run = survey_run,
    .plot = "gsd_cm|interval_s|longest_s|altitude_m",
    .plot_titles = "Ground sampling distance|Interval between exposures|Longest exposure|"
                   "Flying altitude",
    .cell = "gsd_cm",
};
