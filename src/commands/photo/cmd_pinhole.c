/* commands/photo/cmd_pinhole.c - lenscalc pinhole: a camera with a hole in place of a lens. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option_light.h"
#include "cli/question/command.h"
#include "commands/photo/crop.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "photo/fov.h"
#include "photo/pinhole.h"
#include "report/spoken.h"

#include <math.h>
#include <string.h>

struct pinhole_input {
    struct focal_value focal;
    double diameter, distance, wavelength, crop;
    int rule;
    struct sensor_value sensor;
    double metered, metered_at; /* s; f-number */
    struct film_value film;
};

/* Indexed by enum pinhole_rule. */
static const struct word rules[] = {
    {"rayleigh", "1.9 sqrt(w f): the most detail, by Rayleigh"},
    {"petzval", "1.41 sqrt(w f): the smallest image of a point, by Petzval and Mielenz"},
    {"young", "2 sqrt(w f): the brightest of the sharp ones, by Young"},
    {"airy", "1.56 sqrt(w f): as wide as its Airy disc"},
    {NULL, NULL},
};

#define INPUT struct pinhole_input

static const struct option options[] = {
    {MEASURE(focal, focal_length, "mm", "LENGTH"), .name = "focal-length", .letter = 'f',
     .column = "focal", ABOVE_0,
     .help = "from the hole to the film, the depth of the box; 26mm-eq by --sensor"},
    {MEASURE(diameter, length, "mm", "LENGTH"), REPEATED("diameter"), ABOVE_0, .usual = {0.02, 5},
     .unusual = "pinholes are 0.1 to 1 mm wide",
     .help = "of an existing hole; otherwise the best one"},
    {ASKED(rule), REPEATED("rule"), .words = rules, .fallback = "rayleigh", .value = "RULE",
     .help = "which hole is the best"},
    OPTION_DISTANCE(distance, 0, "distance of the subject from the hole, otherwise infinity"),
    OPTION_WAVELENGTH(wavelength, NULL),
    OPTION_SENSOR(sensor),
    OPTION_CROP(crop),
    {MEASURE(metered, time, "s", "TIME"), REPEATED("metered"), .quantity = "metered time", ABOVE_0,
     .help = "time that was metered at --metered-at: gives the time through the hole"},
    {MEASURE(metered_at, fnumber, NULL, "NUMBER"), .name = "metered-at",
     .quantity = "metered f-number", .column = "metered_fnumber", ABOVE_0, .fallback = "16",
     .wants = "metered", OPTION_USUAL_FNUMBER, .help = "f-number of the metered time"},
    {ASKED(film), REPEATED("film"), .value = "NAME", .wants = "metered",
     .help = "corrects long times for reciprocity failure; see 'list films'"},
};

struct pinhole_row {
    double focal, distance, diameter, best, best_focal;
    struct pinhole hole;
    struct fov fov;
    double corner; /* stops */
    double metered, metered_fnumber, stops, time, corrected_time, reciprocity_stops;
    const char *timer, *rule, *sensor, *film, *film_source;
    double wavelength;
};

#define ROW struct pinhole_row

static const struct column columns[] = {
    COLUMN_FOCAL(focal, COLUMN_BRIEF),
    {LENGTH(distance, "m"), .name = "distance", .flags = COLUMN_ECHO | COLUMN_INFINITE,
     .with = "distance", .symbol = "s", .help = "distance of the subject"},
    {LENGTH(diameter, "mm"), .name = "diameter", BRIEF, .symbol = "d",
     .label = "diameter of the hole", .help = "as given, else the best one"},
    {LENGTH(best, "mm"), .name = "best_diameter", BRIEF_WITH("diameter"), .symbol = "db",
     .label = "best diameter", .help = "by the rule"},
    {LENGTH(best_focal, "mm"), .name = "best_focal", WITH("diameter") | COLUMN_INFINITE,
     .label = "best depth for this hole", .help = "from the hole to the film, by the rule"},
    {SHOWN(hole.fnumber), .name = "fnumber", BRIEF, .symbol = "N", .label = "f-number",
     .help = "depth over diameter"},
    {LENGTH(hole.blur, "mm"), .name = "blur", BRIEF, .symbol = "b", .label = "blur of a point",
     .help = "on the film: the wider one of the hole's shadow and its Airy disc"},
    {ANGLE(fov.horizontal), .name = "horizontal", BRIEF, .symbol = "hfov",
     .label = "horizontal angle", .help = "full horizontal angle of view"},
    {ANGLE(fov.vertical), .name = "vertical", BRIEF, .symbol = "vfov", .label = "vertical angle",
     .help = "full vertical angle of view"},
    {ANGLE(fov.diagonal), .name = "diagonal", BRIEF, .symbol = "dfov", .label = "diagonal angle",
     .help = "full diagonal angle of view"},
    {STOPS(corner), .name = "corner", .symbol = "corner", .label = "loss in the corners",
     .help = "of light, against the middle"},
    {TIME(metered), .name = "metered", ECHO_WITH("metered") | COLUMN_BRIEF, .symbol = "tm",
     .label = "metered time", .help = "at the metered f-number"},
    {STOPS(stops), .name = "stops", WITH("metered"), .symbol = "more",
     .label = "stops from there to the hole", .help = "from the metered f-number to the hole"},
    {TIME(time), .name = "time", BRIEF_WITH("metered"), .symbol = "t",
     .label = "time through the hole", .help = "exposure time without reciprocity failure"},
    {TIME(corrected_time), .name = "corrected_time", BRIEF_WITH("film"), .symbol = "Tc",
     .label = "time on this film", .help = "time corrected for reciprocity failure"},
    {STOPS(reciprocity_stops), .name = "reciprocity", WITH("film"), .label = "reciprocity failure",
     .help = "corrected over metered time, in stops"},
    {SHOWN(timer), .name = "timer", WITH("metered") | COLUMN_HIDDEN,
     .help = "time to set in words: 2 min 30 s"},
    {SHOWN(rule), .name = "rule", ASSUMED_BY("rule"), .label = "best diameter by",
     .help = "which hole is the best"},
    {LENGTH(wavelength, "nm"), .name = "wavelength", ASSUMED_BY("wavelength") | COLUMN_ECHO,
     .symbol = "w", .help = "of the light"},
    COLUMN_SENSOR(sensor),
    {SHOWN(metered_fnumber), .name = "metered_fnumber",
     ASSUMED_WITH("metered", "metered-at") | COLUMN_ECHO, .symbol = "Nm",
     .label = "metered at f-number", .help = "f-number of the metered time"},
    {SHOWN(film), .name = "film", ASSUMED_BY("film"), .help = "film of the corrected time"},
    {SHOWN(film_source), .name = "film_source", ASSUMED_BY("film"), .label = "film source",
     .help = "status and source of the film's correction"},
};

/* The time through the hole, if one was metered. */
static bool pinhole_expose(const struct pinhole_input *input, struct pinhole_row *row,
                           struct run *run, struct error *error)
{
    const struct film_value *film = &input->film;
    row->stops = row->time = row->corrected_time = row->reciprocity_stops = NAN;
    if (isnan(input->metered)) {
        return true;
    }
    const double ratio = row->hole.fnumber / input->metered_at;
    double to_set = row->time = input->metered * ratio * ratio;
    row->stops = 2 * log2(ratio);
    if (!(row->time > 0) || isinf(row->time)) {
        return fail(error, ERROR_DOMAIN, "the time through the hole is beyond all numbers");
    }
    if (film->model != NULL) {
        if (!reciprocity_corrected(film->model, row->time, &row->corrected_time, error)) {
            return error_prefix(error, "%s: ", film->name);
        }
        row->reciprocity_stops = reciprocity_stops(row->time, row->corrected_time);
        to_set = row->corrected_time;
    }
    char words[SPOKEN_LENGTH];
    spoken_time(words, to_set, 3);
    row->timer = arena_string(run->arena, words, strlen(words));
    return true;
}

/* The depth: as given, else the one for which a given hole is the best. */
static bool pinhole_depth(const struct pinhole_input *input, struct pinhole_setting *setting,
                          struct run *run, struct error *error)
{
    struct pinhole hole;
    if (!isnan(setting->f) || isnan(input->diameter)) {
        return !isnan(setting->f) ||
               fail(error, ERROR_USAGE,
                    "give {--focal-length}: how far the film lies behind the hole");
    }
    struct pinhole_setting any = *setting;
    any.f = 1; /* the best depth does not depend on it */
    if (!pinhole_find(&any, (enum pinhole_rule)input->rule, input->diameter, &hole, error)) {
        return false;
    }
    if (!isfinite(hole.best_f)) {
        return fail(error, ERROR_DOMAIN,
                    "at this distance no depth has {--diameter} %.4g mm as "
                    "its best hole: give {--focal-length}",
                    input->diameter);
    }
    setting->f = hole.best_f;
    warnings_add(run->doubts, "no --focal-length: the depth is the one for which this hole is the "
                              "best");
    return true;
}

static bool pinhole_run(const void *data, struct run *run, struct error *error)
{
    const struct pinhole_input *input = data;
    struct sensor_value sensor;
    struct pinhole_setting setting = {input->focal.length,
                                      isnan(input->distance) ? (double)INFINITY : input->distance,
                                      input->wavelength};
    const enum pinhole_rule rule = (enum pinhole_rule)input->rule;
    if (!pinhole_depth(input, &setting, run, error)) {
        return false;
    }
    const struct fov_setting view = {RECTILINEAR, setting.f, INFINITY, 1, 1};
    struct pinhole_row row = {.focal = setting.f,
                              .distance = setting.s,
                              .metered = input->metered,
                              .metered_fnumber = input->metered_at,
                              .rule = rules[rule].word,
                              .film = input->film.name,
                              .film_source = input->film.source,
                              .wavelength = input->wavelength};
    if (!crop_sensor(&input->sensor, input->crop, run->arena, &sensor, error) ||
        !pinhole_best(&setting, rule, &row.best, error)) {
        return false;
    }
    row.diameter = isnan(input->diameter) ? row.best : input->diameter;
    if (!pinhole_find(&setting, rule, row.diameter, &row.hole, error) ||
        !fov_compute(&view, &sensor.size, &row.fov, error) ||
        !pinhole_expose(input, &row, run, error)) {
        return false;
    }
    row.best_focal = row.hole.best_f;
    row.corner = -4 * log2(cos(row.fov.diagonal / 2));
    row.sensor = sensor.name;
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"diameter", "d = sqrt(k {w} r), 1/r = 1/{f} + 1/{s}",
     "[Mielenz99]; k = 3.6 by Rayleigh, 2 by Petzval, 4 by Young, 2.44 for the Airy disc",
     "the middle of the picture, a hole in a thin sheet; or as given"},
    {"fnumber", "N = {f}/{d}", "definition of the f-number", NULL},
    {"blur", "b = max({d} (1 + {f}/{s}), 2.44 {w} {N})", "[Young89]",
     "near the best diameter both count"},
    {"horizontal", "hfov = 2 atan(width/(2 {f}))", "[Ray02]; a hole makes a rectilinear picture",
     NULL},
    {"corner", "corner = -4 log2(cos({dfov}/2))", "cos^4 law, [Ray02]", "a hole in a thin sheet"},
    {"time", "t = {tm} ({N}/{Nm})^2", "[Apex60]", "without reciprocity failure, see --film"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"pinhole -f 150mm --sensor 4x5", "the best hole for a box"},
    {"pinhole -f 150mm --sensor 4x5 --metered 1/60 --film \"HP5 Plus\"",
     "and how long it exposes where a meter says 1/60 s at f/16"},
    {"pinhole -f 50mm --diameter 0.3mm", "an existing hole"},
    {"pinhole -f 25,50,100,150,200,300", "a table of holes"},
    {"pinhole -f 50mm --rule rayleigh,petzval,young,airy", "what others call the best"},
    {NULL, NULL},
};

const struct command command_pinhole = {
    .name = "pinhole",
    COMMAND_OF("photography", "pinhole camera: best hole, f-number, exposure, field of view"),
    .run = pinhole_run,
    .plot = "diameter_mm",
    .plot_titles = "Best pinhole",
    .cell = "diameter_mm",
};
