/* commands/photo/cmd_timelapse.c - lenscalc timelapse: shots, interval, clip, storage, trails. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "photo/stars.h"
#include "photo/timelapse.h"

#include "base/constants.h"

#include <math.h>

struct timelapse_input {
    struct timelapse_given given;
    struct focal_value focal;
    double declination, pitch;
};

#define INPUT struct timelapse_input

static const struct option options[] = {
    {MEASURE(given.event, time, "s", "TIME"), REPEATED("event"), .quantity = "event length",
     ABOVE_0 | OPTION_NO_SERIES, .help = "length of the event that is recorded: 2h, 45min"},
    {MEASURE(given.interval, time, "s", "TIME"), REPEATED("interval"), ABOVE_0 | OPTION_NO_SERIES,
     .help = "time from the start of one shot to the start of the next"},
    {MEASURE(given.shots, number, NULL, "N"), REPEATED("shots"), .quantity = "number of shots",
     .lowest = 1, .highest = TIMELAPSE_SHOTS, .help = "number of shots"},
    {MEASURE(given.clip, time, "s", "TIME"), REPEATED("clip"), .quantity = "clip length",
     ABOVE_0 | OPTION_NO_SERIES, .help = "length of the clip"},
    {MEASURE(given.rate, rate, NULL, "RATE"), .name = "frame-rate", .column = "frame_rate", ABOVE_0,
     .help = "frames per second of the clip (24 unless it follows from the rest)"},
    OPTION_TIME(given.time, 0),
    {MEASURE(given.gap, time, "s", "TIME"), REPEATED("gap"), FROM_0 | OPTION_NO_SERIES,
     .fallback = "1", .wants = "time",
     .help = "time that the camera needs between exposures, to write and for its own delay"},
    {MEASURE(given.frame, storage, "MB", "SIZE"), .name = "frame-size", .column = "frame_size",
     ABOVE_0, .help = "storage per shot: 25MB"},
    {MEASURE(given.card, storage, "GB", "SIZE"), REPEATED("card"), ABOVE_0,
     .help = "card capacity: 64GB; with --frame-size alone it gives the number of shots"},
    {MEASURE(given.star_angle, angle, "deg", "ANGLE"), .name = "star-angle", .column = "star_angle",
     .lowest = 0, .highest = 2 * PI, .flags = OPTION_ABOVE_LOWEST, .wants = "time",
     .help = "angle about the pole that star trails are to span, in place of --event"},
    {MEASURE(focal, focal_length, "mm", "LENGTH"), .name = "focal-length", .letter = 'f',
     .column = "focal", ABOVE_0, .wants = "time", .help = "focal length: adds the trails of stars"},
    OPTION_DECLINATION(
        declination, "focal-length",
        "declination of the stars; 0 is the celestial equator, where they are fastest"),
    OPTION_PITCH_ALONE(pitch, "focal-length",
                       "pixel pitch: gives the gaps of star trails in pixels"),
};

struct timelapse_row {
    struct timelapse plan;
    struct timelapse_given given;
    double focal, declination;
    double trail, shot_trail, gap_trail, gap_pixels; /* mm; of stars, on the sensor */
    long card_shots, cards;
    const char *rate_assumed;
};

#define ROW struct timelapse_row

static const struct column columns[] = {
    {SHOWN(plan.shots), .name = "shots", BRIEF, .symbol = "n", .help = "number of shots"},
    {TIME(plan.interval), .name = "interval", BRIEF | COLUMN_SPAN, .symbol = "i",
     .help = "time from the start of one shot to the start of the next"},
    {TIME(plan.event), .name = "event", BRIEF | COLUMN_SPAN, .symbol = "D", .label = "event length",
     .help = "that all shots cover, each with its interval"},
    {TIME(plan.clip), .name = "clip", BRIEF | COLUMN_SPAN, .symbol = "C", .label = "clip length",
     .help = "length of the clip"},
    {MEASURED(plan.rate, rate, "fps"), .name = "frame_rate", .symbol = "r", .label = "frame rate",
     .help = "frames per second of the clip"},
    {SHOWN(plan.speed_up), .name = "speed_up", BRIEF, .symbol = "x", .label = "speed-up",
     .help = "event length over clip length"},
    {TIME(given.time), .name = "time", ECHO_WITH("time"), .symbol = "t", .label = "exposure time",
     .help = "exposure time of a shot"},
    {TIME(plan.pause), .name = "pause", WITH("time") | COLUMN_SPAN, .symbol = "p",
     .help = "without exposure between two shots"},
    {ANGLE(plan.shutter_angle), .name = "shutter_angle", WITH("time"), .symbol = "a",
     .label = "shutter angle of the clip",
     .help = "the exposed part of an interval, as of a film camera: 180 deg look smooth"},
    {MEASURED(given.frame, storage, "MB"), .name = "frame_size", ECHO_WITH("frame-size"),
     .symbol = "F", .label = "size of a frame", .help = "storage that a shot takes"},
    {MEASURED(plan.space, storage, "GB"), .name = "space", BRIEF_WITH("frame-size"), .symbol = "S",
     .label = "space for all shots", .help = "storage that all shots take"},
    {MEASURED(given.card, storage, "GB"), .name = "card", ECHO_WITH("card"), .symbol = "K",
     .help = "storage of a card"},
    {SHOWN(card_shots), .name = "card_shots", WITH("card"), .symbol = "nc",
     .label = "shots on a card", .help = "that a card holds"},
    {SHOWN(cards), .name = "cards", BRIEF_WITH("card"), .help = "that all shots need"},
    {TIME(plan.card_time), .name = "card_time", WITH("card") | COLUMN_SPAN,
     .label = "recording time of a card", .help = "until it is full"},
    {TIME(plan.span), .name = "span", WITH("star-angle focal-length") | COLUMN_SPAN, .symbol = "T",
     .label = "span, first exposure to last",
     .help = "from the beginning of the first exposure to the end of the last"},
    {ANGLE(plan.star_angle), .name = "star_angle", BRIEF_WITH("star-angle focal-length"),
     .symbol = "rot", .label = "star trails about the pole", .help = "angle that the trails span"},
    {LENGTH(focal, "mm"), .name = "focal", ECHO_WITH("focal-length"), .symbol = "f",
     .label = "focal length", .help = "focal length"},
    {LENGTH(trail, "mm"), .name = "star_trail", WITH("focal-length"), .symbol = "X",
     .label = "star trail",
     .help = "of a star in the frame's centre, along its path on the sensor"},
    {LENGTH(shot_trail, "um"), .name = "shot_trail", WITH("focal-length"), .symbol = "xs",
     .label = "trail of one shot", .help = "that each exposure adds"},
    {LENGTH(gap_trail, "um"), .name = "gap_trail", BRIEF_WITH("focal-length"), .symbol = "xg",
     .label = "gap between two shots", .help = "of the trail, while the shutter is closed"},
    {SHOWN(gap_pixels), .name = "gap_pixels", WITH("pitch"), .label = "gap in pixels",
     .help = "a gap below one or two is not seen"},
    {TIME(given.gap), .name = "gap", ASSUMED_WITH("time", "gap") | COLUMN_SPAN,
     .label = "gap at least", .help = "that the camera needs between two exposures"},
    {ANGLE(declination), .name = "declination",
     ASSUMED_WITH("focal-length", "declination") | COLUMN_ECHO, .symbol = "dec",
     .help = "of the stars"},
    {SHOWN(rate_assumed), .name = "rate_assumed", ASSUMED_BY("frame-rate"), .label = "frame rate",
     .help = "what was taken where none is given"},
};

/* The trails of stars, where a focal length is given. */
static bool fill_trails(const struct timelapse_input *input, struct timelapse_row *row,
                        struct error *error)
{
    struct star_trail all, shot;
    row->trail = row->shot_trail = row->gap_trail = row->gap_pixels = NAN;
    if (isnan(input->focal.length)) {
        return true;
    }
    if (isnan(row->plan.interval)) {
        return fail(error, ERROR_USAGE,
                    "{--focal-length} needs what the interval follows from: {--interval}, or "
                    "{--event}");
    }
    if (!star_trail(input->focal.length, input->declination, row->plan.span, &all, error) ||
        !star_trail(input->focal.length, input->declination, input->given.time, &shot, error)) {
        return false;
    }
    row->trail = all.linear;
    row->shot_trail = shot.linear;
    row->gap_trail = shot.linear * (row->plan.pause / input->given.time);
    row->gap_pixels = row->gap_trail / input->pitch;
    return true;
}

static long whole(double number)
{
    return isnan(number) ? NO_INTEGER : (long)number;
}

static bool timelapse_run(const void *data, struct run *run, struct error *error)
{
    const struct timelapse_input *input = data;
    struct timelapse_row row = {
        .given = input->given, .focal = input->focal.length, .declination = input->declination};
    if (!timelapse_solve(&input->given, &row.plan, error) || !fill_trails(input, &row, error)) {
        return false;
    }
    row.card_shots = whole(row.plan.card_shots);
    row.cards = whole(row.plan.cards);
    row.rate_assumed = row.plan.rate_assumed ? "24 fps (default)" : NULL;
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"shots", "n = {D}/{i}", "definition; each shot has its interval, the last too",
     "rounded to whole shots"},
    {"clip", "C = {n}/{r}", "definition", NULL},
    {"speed_up", "x = {i} {r}", "definition", NULL},
    {"pause", "p = {i} - {t}", "definition", NULL},
    {"shutter_angle", "a = 360 {t}/{i}", "definition of the rotating shutter", NULL},
    {"space", "S = {n} {F}", "definition", "compressed frames differ in size"},
    {"span", "T = ({n} - 1) {i} + {t}", "first opening to last closing of the shutter", NULL},
    {"star_angle", "rot = w {T}", "w = 2 pi/86164.1 s, the Earth's rotation", NULL},
    {"star_trail", "X = {f} w {T} cos({dec})", "along the star's circle, w = 2 pi/86164.1 s",
     "in the middle of the frame"},
    {"gap_trail", "xg = {f} w {p} cos({dec})", "as the trail", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"timelapse --event 2h --clip 20s", "two hours in twenty seconds: the interval"},
    {"timelapse --event 1h --interval 5s --frame-size 25MB --card 64GB", "shots, clip and cards"},
    {"timelapse --clip 10s --interval 4s --frame-rate 30 -t 2s", "how long it takes, how smooth"},
    {"timelapse -t 30s --star-angle 30deg -f 20mm --pitch 4.3um", "star trails of 30 degrees"},
    {"timelapse --clip 5min --frame-rate 24 --frame-size 12MB --card 512GB", "footage"},
    {"timelapse --event 30min,1h,2h,4h --clip 10s,20s,30s --table event,clip:interval",
     "a table to print"},
    {NULL, NULL},
};

const struct command command_timelapse = {
    .name = "timelapse",
    COMMAND_OF("photography", "time-lapse and star trails: shots, interval, clip, storage"),
    .run = timelapse_run,
    .plot = "shots|interval_s|clip_s|event_s",
    .plot_titles = "Exposures of a time-lapse|Interval|Length of the clip|Length of the event",
    .cell = "interval_s",
};
