/* commands/photo/cmd_microscope.c - lenscalc microscope: resolution, field, depth, sampling. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "commands/photo/photo_options.h"
#include "commands/tables.h"
#include "photo/given.h"
#include "photo/microscope.h"

#include <math.h>
#include <string.h>

/* What lies between objective and specimen; the first is for "as it follows". */
static const struct word media[] = {
    {"auto", "air, or oil where the numerical aperture is 1 or more"},
    {"air", "1"},
    {"water", "1.333"},
    {"glycerol", "1.47"},
    {"oil", "1.515"},
    {NULL, NULL},
};
static const double indices[] = {NAN, 1, 1.333, 1.47, 1.515};
enum { MEDIUM_AUTO, MEDIUM_AIR, MEDIUM_OIL = 4 };

struct microscope_input {
    struct marking_value objective, eyepiece;
    double magnification, na, resolution, index, condenser, wavelength;
    int immersion;
    double field_number, tube, marked_tube, adapter, pitch;
    struct sensor_value sensor;
};

#define INPUT struct microscope_input

static const struct option options[] = {
    {ASKED(objective), .name = "objective", .value = "POWERx/NA",
     .flags = OPTION_OPERAND | OPTION_REST, .excludes = "magnification",
     .help = "the objective as it is marked: 40x/0.65, \"100x/1.25 oil\""},
    {MEASURE(magnification, ratio, NULL, "FACTOR"), REPEATED("magnification"), .letter = 'm',
     ABOVE_0, .help = "magnification of the objective, in place of --objective"},
    {MEASURE(na, number, NULL, "NA"), REPEATED("na"), .quantity = "numerical aperture", ABOVE_0,
     .usual = {0, 1.7}, .unusual = "numerical apertures are below 1.7",
     .help = "its numerical aperture, where --objective does not say it"},
    {MEASURE(resolution, length, "um", "LENGTH"), REPEATED("resolution"), ABOVE_0,
     .excludes = "objective na condenser",
     .help = "wanted Rayleigh limit at the specimen: solves for the numerical aperture"},
    {ASKED(immersion), REPEATED("immersion"), .words = media, .fallback = "auto",
     .excludes = "index", .value = "MEDIUM", .help = "what lies between objective and specimen"},
    {MEASURE(index, number, NULL, "INDEX"), REPEATED("index"), .lowest = 1, .highest = 5,
     .help = "refractive index of the immersion medium"},
    {ASKED(eyepiece), REPEATED("eyepiece"), .value = "POWERx[/FN]",
     .help = "the eyepiece as it is marked, power and field number: 10x/22"},
    {MEASURE(field_number, length, "mm", "LENGTH"), .name = "field-number",
     .column = "field_number", ABOVE_0, .wants = "eyepiece",
     .help = "field number, the diameter of the eyepiece's field stop: 22"},
    {MEASURE(tube, length, "mm", "LENGTH"), .name = "tube-lens", .column = "tube_lens", ABOVE_0,
     .help = "focal length of the tube lens; gives that of the objective"},
    {MEASURE(marked_tube, length, "mm", "LENGTH"), .name = "marked-for", .column = "marked_for",
     ABOVE_0, .wants = "tube-lens",
     .help = "tube lens that the objective is marked for: 200mm Nikon, Leica, Mitutoyo; 180mm "
             "Olympus; 165mm Zeiss; without it the one of --tube-lens"},
    {MEASURE(condenser, number, NULL, "NA"), REPEATED("condenser"), .quantity = "condenser",
     ABOVE_0, .help = "numerical aperture of the condenser, where it is below the objective's"},
    {MEASURE(adapter, ratio, NULL, "FACTOR"), REPEATED("adapter"), ABOVE_0, .fallback = "1",
     .wants = "pitch|sensor", .help = "camera adapter: 0.5x"},
    {MEASURE(pitch, length, "um", "LENGTH"), .name = "pitch", .quantity = "pixel pitch", ABOVE_0,
     USUAL_PITCH, .help = "pixel pitch of the camera (otherwise that of --sensor)"},
    {ASKED(sensor), REPEATED("sensor"), .value = "NAME|WxH",
     .help = "the camera, or its format or size: adds the field on it"},
    OPTION_WAVELENGTH(wavelength, NULL),
};

struct microscope_row {
    struct microscope_setting setting;
    struct microscope found;
    const char *objective, *eyepiece, *medium, *sensor;
    double focal, tube, marked_tube, wavelength;
    double field_width, field_height;
};

#define ROW struct microscope_row

#define KNOWN               .flags = COLUMN_SPARSE
#define KNOWN_BRIEF         .flags = COLUMN_SPARSE | COLUMN_BRIEF
#define WITH_EYEPIECE       WITH("eyepiece") | COLUMN_SPARSE
#define WITH_CAMERA         WITH("pitch sensor") | COLUMN_SPARSE
#define MICROMETRES(member) LENGTH(found.member, "um")

static const struct column columns[] = {
    {SHOWN(objective), .name = "objective", ECHO_WITH("objective") | COLUMN_BRIEF,
     .help = "as marked"},
    {SHOWN(setting.magnification), .name = "magnification", KNOWN, .symbol = "M",
     .repeats = "magnification", .help = "of objective and tube lens"},
    {SHOWN(setting.na), .name = "na", KNOWN, .symbol = "NA", .repeats = "na",
     .label = "numerical aperture", .help = "of the objective"},
    {LENGTH(focal, "mm"), .name = "focal", WITH("tube-lens"), .symbol = "fo",
     .label = "focal length of the objective", .help = "that of the tube lens over the power"},
    {MICROMETRES(rayleigh), .name = "rayleigh", BRIEF | COLUMN_SPARSE, .symbol = "ra",
     .label = "Rayleigh limit", .help = "two points this far apart are just resolved"},
    {MICROMETRES(abbe), .name = "abbe", BRIEF | COLUMN_SPARSE, .symbol = "ab",
     .label = "Abbe limit", .help = "finest grating that is resolved"},
    {MICROMETRES(sparrow), .name = "sparrow", .flags = COLUMN_SPARSE, .symbol = "sp",
     .label = "Sparrow limit", .help = "two points without a dip between them"},
    {SHOWN(found.working_fnumber), .name = "working_fnumber", KNOWN, .symbol = "Nw",
     .label = "working f-number", .help = "of the beam behind the tube lens"},
    {SHOWN(found.lowest_power), .name = "lowest_power", .flags = COLUMN_SPARSE, .symbol = "Ml",
     .label = "lowest useful power", .help = "500 NA"},
    {SHOWN(found.highest_power), .name = "highest_power", .flags = COLUMN_SPARSE, .symbol = "Mh",
     .label = "highest useful power", .help = "1000 NA; more is empty magnification"},
    {SHOWN(found.power), .name = "power", WITH_EYEPIECE | COLUMN_BRIEF, .symbol = "Mt",
     .label = "total magnification", .help = "to the eye"},
    {LENGTH(found.field, "mm"), .name = "field", WITH_EYEPIECE | COLUMN_BRIEF, .symbol = "fd",
     .label = "field of view", .help = "diameter at the specimen"},
    {LENGTH(found.exit_pupil, "mm"), .name = "exit_pupil", WITH_EYEPIECE, .symbol = "ep",
     .label = "exit pupil", .help = "diameter of the beam into the eye"},
    {MICROMETRES(eye_depth), .name = "depth_eye", WITH_EYEPIECE | COLUMN_BRIEF, .symbol = "de",
     .label = "depth of field, eye", .help = "Berek's formula"},
    {MICROMETRES(pixel), .name = "pixel", WITH_CAMERA | COLUMN_BRIEF, .symbol = "px",
     .label = "pixel at the specimen", .help = "pixel pitch over the magnification on the sensor"},
    {SHOWN(found.pixels_per_abbe), .name = "sampling", WITH_CAMERA | COLUMN_BRIEF, .symbol = "sa",
     .label = "pixels per Abbe limit", .help = "Nyquist asks for 2 and more"},
    {MICROMETRES(nyquist_pitch), .name = "nyquist_pitch", WITH_CAMERA, .symbol = "ny",
     .label = "largest pixel by Nyquist",
     .help = "pitch on the sensor that records the Abbe limit"},
    {MICROMETRES(camera_depth), .name = "depth_camera", WITH_CAMERA | COLUMN_BRIEF, .symbol = "dc",
     .label = "depth of field, camera", .help = "by diffraction and pixel"},
    {LENGTH(field_width, "mm"), .name = "field_width", BRIEF_WITH("sensor"), .symbol = "W",
     .label = "field width", .help = "at the specimen, of the sensor"},
    {LENGTH(field_height, "mm"), .name = "field_height", BRIEF_WITH("sensor"),
     .label = "field height", .help = "at the specimen, of the sensor"},
    {SHOWN(eyepiece), .name = "eyepiece", ECHO_WITH("eyepiece"), .help = "as marked"},
    {SHOWN(medium), .name = "immersion", ASSUMED_BY("immersion index objective"), .label = "medium",
     .help = "between objective and specimen"},
    {SHOWN(setting.index), .name = "index",
     ASSUMED_BY("immersion index objective na") | COLUMN_ECHO, .symbol = "n",
     .help = "its refractive index"},
    {LENGTH(wavelength, "nm"), .name = "wavelength", ASSUMED_BY("wavelength") | COLUMN_ECHO,
     .symbol = "w", .help = "of the light"},
    {SHOWN(setting.condenser), .name = "condenser", ECHO_WITH("condenser"), .symbol = "NAc",
     .label = "numerical aperture of the condenser", .help = "as given"},
    {LENGTH(setting.field_number, "mm"), .name = "field_number", WITH("eyepiece") | COLUMN_SPARSE,
     .symbol = "FN", .label = "field number", .help = "diameter of the eyepiece's field stop"},
    {SHOWN(setting.eyepiece), .name = "eyepiece_power", .flags = COLUMN_EXTRA, .symbol = "Me",
     .label = "power of the eyepiece", .help = "as marked"},
    {LENGTH(tube, "mm"), .name = "tube_lens", ECHO_WITH("tube-lens"), .symbol = "ft",
     .label = "tube lens", .help = "its focal length"},
    {LENGTH(marked_tube, "mm"), .name = "marked_for",
     ASSUMED_WITH("tube-lens", "marked-for") | COLUMN_ECHO, .symbol = "fm",
     .label = "objective marked for a tube lens of", .help = "focal length"},
    {SHOWN(setting.adapter), .name = "adapter",
     ASSUMED_WITH("pitch sensor", "adapter") | COLUMN_ECHO, .symbol = "ad",
     .label = "camera adapter", .help = "its factor"},
    {LENGTH(setting.pitch, "um"), .name = "pitch", ASSUMED_WITH("pitch sensor", "pitch sensor"),
     .symbol = "p", .label = "pixel pitch", .help = "spacing of the pixels"},
    {SHOWN(sensor), .name = "sensor", ASSUMED_WITH("sensor", "sensor"), .help = "format or camera"},
};

/* The medium whose word stands on the objective; MEDIUM_AUTO: none does. */
static bool microscope_read_mark(const struct marking_value *objective, int *medium,
                                 struct error *error)
{
    *medium = MEDIUM_AUTO;
    if (objective->name == NULL || objective->behind[0] == '\0') {
        return true;
    }
    for (int i = MEDIUM_AIR; media[i].word != NULL; i++) {
        if (text_same(text_of(objective->behind), media[i].word)) {
            *medium = i;
            return true;
        }
    }
    fail(error, ERROR_USAGE, "{objective} '%s': '%s' is none of air, water, glycerol and oil",
         objective->name, objective->behind);
    return error_hint(error, "an eyepiece is {--eyepiece} 10x/22, power and field number");
}

/* The medium by its word, by what stands on the objective, or by the numerical aperture. */
static bool microscope_find_medium(const struct microscope_input *input, struct microscope_row *row,
                                   struct error *error)
{
    int marked, medium = input->immersion;
    if (!microscope_read_mark(&input->objective, &marked, error)) {
        return false;
    }
    if (is_given(input->index)) {
        row->setting.index = input->index;
        return true;
    }
    if (medium == MEDIUM_AUTO) {
        medium = marked;
    } else if (marked != MEDIUM_AUTO && marked != medium) {
        return fail(error, ERROR_USAGE, "{objective} '%s' is not for {--immersion} %s",
                    input->objective.name, media[medium].word);
    }
    const bool is_assumed = medium == MEDIUM_AUTO;
    if (is_assumed) {
        medium = row->setting.na >= 1 ? MEDIUM_OIL : MEDIUM_AIR;
    }
    row->setting.index = indices[medium];
    row->medium =
        medium == MEDIUM_OIL && is_assumed ? "oil, as NA is 1 or more" : media[medium].word;
    return true;
}

/* The objective as it is marked, or by its two options; with another tube lens than it is for. */
static bool microscope_find_objective(const struct microscope_input *input,
                                      struct microscope_row *row, struct error *error)
{
    const bool is_marked = input->objective.name != NULL;
    double marked = is_marked ? input->objective.power : input->magnification;
    row->setting.na = is_marked ? input->objective.number : input->na;
    if (is_marked && is_given(input->na) && is_given(input->objective.number)) {
        return fail(error, ERROR_USAGE, "{objective} '%s' says its aperture already: no {--na}",
                    input->objective.name);
    }
    if (is_given(input->na)) {
        row->setting.na = input->na;
    }
    if (is_given(input->resolution)) {
        row->setting.na = microscope_aperture_for(input->resolution, 1000 * input->wavelength);
    }
    const bool has_more = is_given(row->setting.pitch) || is_given(row->setting.eyepiece) ||
                          is_given(row->setting.field_number) || input->sensor.name != NULL;
    if (!is_given(row->setting.na) && !(is_given(marked) && has_more)) {
        return fail(error, ERROR_USAGE,
                    "give the numerical aperture: {--objective} 40x/0.65, or {--na}");
    }
    row->objective = input->objective.name;
    row->tube = input->tube;
    row->marked_tube = is_given(input->marked_tube) ? input->marked_tube : input->tube;
    row->focal = row->marked_tube / marked;
    row->setting.magnification =
        is_given(input->tube) ? microscope_magnification(marked, input->tube, row->marked_tube)
                              : marked;
    return true;
}

/* What magnifications alone say: the field and the pixels on it. */
static void microscope_forget_aperture(struct microscope_row *row)
{
    struct microscope *found = &row->found;
    found->abbe = found->rayleigh = found->sparrow = found->working_fnumber = NAN;
    found->exit_pupil = found->lowest_power = found->highest_power = found->eye_depth = NAN;
    found->nyquist_pitch = found->pixels_per_abbe = found->camera_depth = NAN;
    row->setting.na = row->setting.index = NAN;
    row->medium = NULL;
}

static bool microscope_run(const void *data, struct run *run, struct error *error)
{
    const struct microscope_input *input = data;
    const struct sensor_value *sensor = &input->sensor;
    const bool has_sensor = sensor->name != NULL;
    struct microscope_row row = {
        .setting = {.condenser = input->condenser,
                    .wavelength = 1000 * input->wavelength,
                    .eyepiece = input->eyepiece.power,
                    .field_number = is_given(input->field_number) ? input->field_number
                                                                  : input->eyepiece.number,
                    .adapter = input->adapter,
                    .pitch =
                        is_given(input->pitch) || !has_sensor ? input->pitch : sensor->size.pitch},
        .eyepiece = input->eyepiece.name,
        .sensor = sensor->name,
        .wavelength = input->wavelength,
    };
    if (!microscope_find_objective(input, &row, error) ||
        !microscope_find_medium(input, &row, error)) {
        return false;
    }
    const bool has_aperture = is_given(row.setting.na);
    if (!has_aperture) {
        row.setting.na = 0.1; /* any: nothing that follows from it is kept */
    }
    if (!microscope_compute(&row.setting, &row.found, error)) {
        return false;
    }
    if (!has_aperture) {
        microscope_forget_aperture(&row);
        warnings_add(run->doubts, "no numerical aperture: what is resolved is not known");
    }
    row.field_width =
        has_sensor ? sensor->size.width / row.found.camera_magnification : (double)NAN;
    row.field_height =
        has_sensor ? sensor->size.height / row.found.camera_magnification : (double)NAN;
    if (row.found.power > row.found.highest_power) {
        warnings_add(run->doubts,
                     "the total magnification %.4g is above 1000 NA, %.4g: it shows no more detail",
                     row.found.power, row.found.highest_power);
    }
    if (row.found.pixels_per_abbe < 2) {
        warnings_add(run->doubts,
                     "the pixels are too large for the resolution: by Nyquist %.3g um or smaller",
                     1000 * row.found.nyquist_pitch);
    }
    run_emit(run, &row);
    return true;
}

static const struct explanation explanations[] = {
    {"rayleigh condenser", "ra = 1.21967 {w}/({NA} + min({NAc}, {NA}))", "[BornWolf99] 8.6.3",
     NULL},
    {"rayleigh !condenser", "ra = 0.609835 {w}/{NA}", "[BornWolf99] 8.6.3", NULL},
    {"abbe condenser", "ab = {w}/({NA} + min({NAc}, {NA}))", "[BornWolf99] 8.6.3", NULL},
    {"abbe !condenser", "ab = {w}/(2 {NA})", "[BornWolf99] 8.6.3", NULL},
    {"sparrow !condenser", "sp = 0.473578 {w}/{NA}", "Sparrow, Astrophys. J. 44 (1916) 76", NULL},
    {"working_fnumber", "Nw = {M}/(2 {NA})", "sine condition", NULL},
    {"power", "Mt = {M} {Me}", "definition", NULL},
    {"field", "fd = {FN}/{M}", "definition of the field number", NULL},
    {"exit_pupil", "ep = 500 mm {NA}/{Mt}", "powers are for 250 mm", NULL},
    {"lowest_power", "Ml = 500 {NA}", "Abbe's rule, [MicroscopyU]", NULL},
    {"depth_eye", "de = {n} ({w}/(2 {NA}^2) + 340 um/({NA} {Mt}))", "[Berek27], as [LeicaDepth]",
     "found by trial, with eyes"},
    {"depth_camera", "dc = {n} ({w}/{NA}^2 + {p}/({M} {ad} {NA}))", "[MicroscopyU]",
     "a pixel is what is told apart"},
    {"pixel", "px = {p}/({M} {ad})", "definition", NULL},
    {"sampling", "sa = {ab}/{px}", "sampling theorem", NULL},
    {"nyquist_pitch", "ny = {ab} {M} {ad}/2", "sampling theorem", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"microscope 40x/0.65 --eyepiece 10x/22", "an objective and an eyepiece"},
    {"microscope 4x/0.1,10x/0.25,40x/0.65,100x/1.25 --eyepiece 10x/22", "all of a turret"},
    {"microscope 20x/0.5 --pitch 3.45um --sensor 2/3in", "field and sampling of a camera"},
    {"microscope 20x/0.42 --tube-lens 180mm --marked-for 200mm", "the tube lens of another maker"},
    {"microscope --na 1.4 -m 60 --immersion oil --pitch 6.5um -w 520nm", "by numbers"},
    {NULL, NULL},
};

const struct command command_microscope = {
    .name = "microscope",
    COMMAND_OF("photography", "microscopes: resolution, field, depth of field, sampling"),
    .run = microscope_run,
    .plot = "rayleigh_um,abbe_um",
    .plot_titles = "Resolution of a microscope",
    .cell = "rayleigh_um",
};
