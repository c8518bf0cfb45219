/* commands/photo/cmd_equivalent.c - lenscalc equivalent: the same picture on another format. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/attachments.h"
#include "commands/photo/crop.h"
#include "commands/photo/photo_lens.h"
#include "commands/photo/sharpness.h"
#include "commands/tables.h"
#include "photo/conjugate.h"
#include "photo/equivalent.h"

#include <math.h>

struct equivalent_input {
    double iso, distance, magnification;
    double converter, crop; /* factors */
    struct photo_lens_question lens;
    struct sharpness sharp;
    struct sensor_value to;
    int by, keep;
};

/* Indexed by enum equivalent_measure. */
static const struct word measures[] = {
    {"diagonal", "by the diagonals, as crop factors are"},
    {"width", "by the widths: the same horizontal angle"},
    {"height", "by the heights: the same vertical angle"},
    {"area", "by the square roots of the areas: the same total light"},
    {NULL, NULL},
};

/* Indexed by enum equivalent_keep. */
static const struct word kept[] = {
    {"picture", "depth of field, diffraction, time and total light; f-number and ISO change"},
    {"exposure", "f-number, ISO and time; depth of field and noise change"},
    {NULL, NULL},
};

#define INPUT struct equivalent_input

static const struct option options[] = {
    OPTION_FOCAL_LENGTH(lens.focal, OPTION_OF_CAMERA),
    PHOTO_LENS_OPTIONS(lens),
    OPTION_APERTURE(lens.fnumber, 0),
    {MEASURE(iso, iso, NULL, "NUMBER"), REPEATED("iso"), .quantity = "ISO speed", ABOVE_0,
     .fallback = "100", .help = "ISO speed"},
    OPTION_DISTANCE(distance, 0, "distance of the subject, otherwise infinity"),
    {MEASURE(magnification, ratio, NULL, "RATIO"), REPEATED("magnification"), .letter = 'm', FROM_0,
     .help = "magnification in place of the distance: 1:2 or 0.5"},
    OPTION_PUPIL_OF_LENS(lens.pupil, NULL),
    OPTION_CONVERTER_ALONE(converter, NULL),
    OPTION_CROP(crop),
    SHARPNESS_OPTIONS_OF_LENS(sharp, lens, 0, "d/1500", coc_is_pixels),
    {ASKED(to), .name = "to", .column = "equal_sensor", .fallback = "35mm", .value = "NAME|WxH",
     .help = "the other format or camera; a list for several at once"},
    {ASKED(by), .name = "by", .column = "measure", .words = measures, .fallback = "diagonal",
     .value = "MEASURE", .help = "how formats are compared"},
    {ASKED(keep), REPEATED("keep"), .words = kept, .fallback = "picture", .value = "WHAT",
     .help = "what stays the same besides framing"},
};

struct equivalent_row {
    const char *sensor, *other, *criterion, *measure, *keep;
    struct equivalent_setting setting;
    struct equivalent equal;
    double focal, fnumber, converter; /* of the lens alone; the converter's factor */
    double crop, wavelength;
    struct photo_real real;
};

#define ROW struct equivalent_row

static const struct column columns[] = {
    PHOTO_LENS_COLUMNS(real),
    {LENGTH(setting.f, "mm"), .name = "combined_focal", BRIEF_WITH("converter"), .symbol = "f",
     .label = "combined focal length", .help = "focal length of lens and converter"},
    {SHOWN(setting.N), .name = "combined_fnumber", BRIEF_WITH("converter"), .symbol = "N",
     .label = "combined f-number", .help = "f-number of lens and converter"},
    COLUMN_FOCAL(focal, 0),
    COLUMN_FNUMBER(fnumber, 0),
    COLUMN_CONVERTER(converter),
    {SHOWN(setting.iso), .name = "iso", ASSUMED_BY("iso") | COLUMN_ECHO, .symbol = "S",
     .label = "ISO speed", .help = "ISO speed"},
    {SHOWN(setting.m), .name = "magnification",
     ASSUMED_BY("magnification distance focal-length lens position section"), .tells = "distance",
     .symbol = "m", .help = "size on the sensor over size of the subject"},
    {SHOWN(other), .name = "equal_sensor", BRIEF, .label = "equivalent sensor",
     .help = "the format of the equal picture"},
    {SHOWN(equal.k), .name = "ratio", BRIEF, .symbol = "k", .label = "ratio of formats",
     .help = "size of the other format over this one"},
    {LENGTH(equal.f, "mm"), .name = "equal_focal", BRIEF, .symbol = "f'",
     .label = "equivalent focal length", .help = "focal length with the same framing there"},
    {SHOWN(equal.N), .name = "equal_fnumber", BRIEF, .symbol = "N'", .with = "aperture lens",
     .label = "equivalent f-number", .help = "equivalent f-number"},
    {SHOWN(equal.iso), .name = "equal_iso", BRIEF, .symbol = "S'", .label = "equivalent ISO speed",
     .help = "ISO speed with the same time there"},
    {SHOWN(equal.m), .name = "equal_magnification", .symbol = "m'",
     .label = "equivalent magnification", .help = "equivalent magnification"},
    {LENGTH(equal.c, "mm"), .name = "equal_coc", .symbol = "c'",
     .label = "equivalent circle of confusion",
     .help = "circle of confusion in proportion to the format"},
    {LENGTH(equal.pupil_diameter, "mm"), .name = "equal_pupil_diameter", .symbol = "D'",
     .label = "equivalent entrance pupil", .help = "diameter of the entrance pupil there"},
    {SHOWN(equal.working_fnumber), .name = "equal_working_fnumber", .flags = COLUMN_HIDDEN,
     .label = "equivalent working f-number", .help = "f-number that exposes there"},
    {STOPS(equal.light_stops), .name = "light", BRIEF, .label = "total light",
     .help = "light on the whole sensor there against here; 0 is the same noise"},
    {SHOWN(equal.field_depth_ratio), .name = "depth_ratio", BRIEF, .label = "depth of field, ratio",
     .help = "depth of field there over here; 1 is equal"},
    {SHOWN(crop), .name = "crop_factor", .flags = COLUMN_HIDDEN, .label = "crop factor",
     .help = "43.27 mm over the diagonal of this format"},
    COLUMN_SENSOR(sensor),
    COLUMN_COC(setting.c, COLUMN_EXTRA, ""),
    COLUMN_CRITERION(criterion),
    COLUMN_PUPIL(setting.P),
    {SHOWN(measure), .name = "measure", ASSUMED_BY("by"), .label = "compared by",
     .help = "how formats are compared"},
    {SHOWN(keep), .name = "keep", ASSUMED_BY("keep"), .label = "keeping",
     .help = "what stays the same besides framing"},
    PHOTO_LENS_WARNING_COLUMN(real),
};

static bool equivalent_answer(const void *data, const struct photo_lens *bare, struct run *run,
                              struct error *error)
{
    const struct equivalent_input *input = data;
    const struct attachments attachments = {NAN, NAN, input->converter};
    struct photo_lens room;
    struct attached_lens attached;
    double k;
    struct sharpness sharp = input->sharp;
    if (!sharpness_settle(&sharp, PITCH_FOR_COC, run->doubts, error) ||
        !crop_sensor(&input->sharp.sensor, input->crop, run->arena, &sharp.sensor, error) ||
        !attachments_apply(&attachments, bare, &room, &attached, error)) {
        return false;
    }
    const struct photo_lens *lens = attached.lens;
    bool has_fnumber = !isnan(lens->N);
    struct equivalent_row row = {
        .sensor = sharp.sensor.name,
        .other = input->to.name,
        .criterion = sharp.coc.criterion,
        .measure = measures[input->by].word,
        .keep = kept[input->keep].word,
        .setting = {.f = lens->f, .N = has_fnumber ? lens->N : 1, .P = lens->P, .iso = input->iso},
        .real = *lens->real,
        .wavelength = photo_lens_light(lens, sharpness_is_airy(&input->sharp)),
        .crop = sensor_crop(&sharp.sensor.size),
        .focal = attached.focal,
        .fnumber = bare->N,
        .converter = input->converter,
    };
    /* Magnification from distance or as given; 0 where neither is. */
    struct conjugates c;
    bool at_infinity = isnan(input->distance) && isnan(input->magnification);
    struct conjugates_given given = {
        .f = lens->f,
        .s = input->distance,
        .v = NAN,
        .m = at_infinity ? 0 : input->magnification,
        .T = NAN,
    };
    if (isnan(lens->f)) {
        return fail(error, ERROR_USAGE, "give {--focal-length}, or {--lens}");
    }
    if (!isnan(input->distance) && !isnan(input->magnification)) {
        return fail(error, ERROR_USAGE, "give one of {--distance} and {--magnification}");
    }
    if (!conjugates_solve(&given, &c, error)) {
        return false;
    }
    row.setting.m = c.m;
    if ((!isnan(input->distance) && !photo_lens_check_subject(lens, input->distance, error)) ||
        !sharpness_resolve_in(&sharp, lens->wavelength,
                              diffracting_fnumber(lens->N, row.setting.m, lens->P), &row.setting.c,
                              error) ||
        !equivalent_ratio(&sharp.sensor.size, &input->to.size, (enum equivalent_measure)input->by,
                          &k, error) ||
        !equivalent_compute(&row.setting, k, (enum equivalent_keep)input->keep, &row.equal,
                            error)) {
        return false;
    }
    if (!has_fnumber) {
        /* Without an f-number: everything that does not follow from it. */
        row.setting.N = row.equal.N = NAN;
        row.equal.pupil_diameter = row.equal.working_fnumber = NAN;
    }
    run_emit(run, &row);
    return true;
}

static bool equivalent_run(const void *data, struct run *run, struct error *error)
{
    const struct equivalent_input *input = data;
    return photo_lens_each(&input->lens, 0, run, equivalent_answer, input, error);
}

static const struct explanation explanations[] = {
    {"equal_focal", "f' = {k} {f} (1 + {m}/{P})/(1 + {k} {m}/{P})",
     "[James14] at infinity; near by from the distance of the entrance pupil, see "
     "lenscalc-equivalent(1)",
     "k f at infinity; both lenses with the same P"},
    {"equal_fnumber", "N' = {N} {f'}/{f}", "[James14] the same entrance pupil",
     "with --keep exposure the working f-number is kept instead"},
    {"equal_iso", "S' = {k}^2 {S}", "[James14] the same light in all, the same time",
     "with --keep exposure the ISO is kept instead"},
    {"equal_magnification", "m' = {k} {m}", "[James14] the same framing", NULL},
    {"equal_coc", "c' = {k} {c}", "[James14] the same print", NULL},
    {"equal_pupil_diameter", "D' = {f'}/{N'}", "definition of the f-number", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"equivalent -f 50 -N 1.8 --sensor 4/3", "what a lens on Four Thirds does on 35 mm film"},
    {"equivalent -f 300 -N 4 --converter 2x --crop 1.5", "a teleconverter on a crop camera"},
    {"equivalent -f 80 -N 2.8 --sensor 6x6 --to 35mm,aps-c,4/3", "several formats at once"},
    {"equivalent -f 23 -N 2 --sensor aps-c --keep exposure", "with the exposure kept"},
    {"equivalent --lens canon-nfd-70-210 --position all --to aps-c", "a real zoom lens"},
    {"equivalent -f 100 -N 8 -m 1:1 --to aps-c", "close up, where the plain crop factor is wrong"},
    {NULL, NULL},
};

PHOTO_LENS_MAKES_MANY(lens)

const struct command command_equivalent = {
    .name = "equivalent",
    .stop_size_wants = "",
    COMMAND_OF("photography",
               "focal length, f-number and ISO of the same picture on another format"),
    .run = equivalent_run,
    .makes_many = makes_many,
    .varies = varies,
    .plot = "equal_focal_mm",
    .plot_titles = "Equivalent focal length",
    .cell = "equal_focal_mm",
};
