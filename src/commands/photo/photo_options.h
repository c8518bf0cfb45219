/* commands/photo/photo_options.h - options and columns that photographic commands share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_PHOTO_OPTIONS_H
#define LENSCALC_COMMANDS_PHOTO_PHOTO_OPTIONS_H

#include "base/constants.h"
#include "cli/options/option.h"
#include "commands/tables.h"

#include <math.h>

/* What options serve: a circle of confusion in pixels, or seen on a print. */
bool coc_is_pixels(const struct coc_value *coc);
bool coc_is_print(const struct coc_value *coc);

#define OPTION_FOCAL_LENGTH(member, more)                                                          \
    ENTRY(MEASURE(member, focal_length, "mm", "LENGTH"), .name = "focal-length", .letter = 'f',    \
          .column = "focal", ABOVE_0 | (more),                                                     \
          .outside = "of a diverging lens: lenscalc conjugate -f LENGTH --object LENGTH",          \
          .help = "focal length; 26mm-eq is the equivalent on 36 x 24 mm, which is converted by "  \
                  "the diagonal of --sensor")

#define OPTION_APERTURE(member, more)                                                              \
    ENTRY(MEASURE(member, fnumber, NULL, "NUMBER"), .name = "aperture", .letter = 'N',             \
          .quantity = "f-number", .column = "fnumber", ABOVE_0 | (more), OPTION_USUAL_FNUMBER,     \
          .help = "f-number: 2.8 or f/2.8")

/* In place of --aperture; `more` are initialisers such as .excludes. */
#define OPTION_NA(member, words, ...)                                                              \
    ENTRY(MEASURE(member, number, NULL, "NA"), REPEATED("na"), .quantity = "numerical aperture",   \
          ABOVE_0, .usual = {0, 1.7}, .unusual = "numerical apertures are below 1.7",              \
          .help = (words), __VA_ARGS__)

#define COLUMN_NA(member)                                                                          \
    ENTRY(SHOWN(member), .name = "na", ECHO_WITH("na"), .symbol = "NA",                            \
          .label = "numerical aperture", .help = "as given")

#define OPTION_DISTANCE(member, more, words)                                                       \
    ENTRY(MEASURE(member, length, "m", "LENGTH"), REPEATED("distance"), .letter = 's',             \
          ABOVE_0_OR_INFINITE | (more), .help = (words))

#define OPTION_COC(member, more, fallback_text)                                                    \
    ENTRY(MEASURE(member, length, "mm", "LENGTH"), REPEATED("coc"), .letter = 'c',                 \
          .quantity = "circle of confusion", FROM_0 | (more), .fallback = (fallback_text),         \
          .help = "circle of confusion: a diameter, d/1500 (part of the sensor's diagonal), 2px "  \
                  "(pixels), airy (the Airy disc), print (just visible on a print)")

#define OPTION_SENSOR(member)                                                                      \
    ENTRY(ASKED(member), REPEATED("sensor"), .fallback = "35mm", .value = "NAME|WxH",              \
          .help = "format or camera by name, or a size: 36x24mm")

#define OPTION_PUPIL(member)                                                                       \
    ENTRY(MEASURE(member, number, NULL, "NUMBER"), .name = "pupil", .letter = 'P',                 \
          .quantity = "pupil magnification", .column = "pupil_magnification", ABOVE_0,             \
          .fallback = "1", .help = "pupil magnification, exit pupil over entrance pupil")

/* The same where a real lens may have its own: absent means 1 only without --lens. */
#define OPTION_PUPIL_OF_LENS(member, use)                                                          \
    ENTRY(                                                                                         \
        MEASURE(member, number, NULL, "NUMBER"), .name = "pupil", .letter = 'P',                   \
        .quantity = "pupil magnification", .column = "pupil_magnification", ABOVE_0,               \
        .wants = (use),                                                                            \
        .help =                                                                                    \
            "pupil magnification, exit pupil over entrance pupil; default that of --lens, else 1")

#define USUAL_PITCH                                                                                \
    .usual = {0.3e-3, 30e-3}, .unusual = "pixels are 0.3 to 30 um wide: is the unit right?"

/* `use`: coc_is_pixels where the pitch is for --coc alone, else null */
#define OPTION_PITCH(member, use)                                                                  \
    ENTRY(MEASURE(member, length, "um", "LENGTH"), .name = "pitch", .quantity = "pixel pitch",     \
          ABOVE_0, .serves = (use), .served = "in px", USUAL_PITCH,                                \
          .help = "pixel pitch (otherwise that of the camera); where nothing else needs it, it "   \
                  "implies --coc 2px")

/* --pitch of a command without --coc. */
#define OPTION_PITCH_ALONE(member, needs, words)                                                   \
    ENTRY(MEASURE(member, length, "um", "LENGTH"), .name = "pitch", .quantity = "pixel pitch",     \
          ABOVE_0, .wants = (needs), USUAL_PITCH, .help = (words))

#define OPTION_DECLINATION(member, needs, words)                                                   \
    ENTRY(MEASURE(member, angle, "deg", "ANGLE"), REPEATED("declination"), .lowest = -PI / 2,      \
          .highest = PI / 2, .fallback = "0", .wants = (needs), .help = (words))

/* What a print is looked at like, for --coc print. */
#define OPTION_PRINT(member)                                                                       \
    ENTRY(MEASURE(member, length, "mm", "PRINT"), .name = "print", ABOVE_0,                        \
          .serves = coc_is_print, .served = "print",                                               \
          .help = "size of the print, for --coc print, which it implies: the long side (254 mm), " \
                  "16x24in or a paper size, A2; with viewing distance, A2@1m; and visual acuity, " \
                  "A2@1m@20/20")

#define OPTION_VIEWING(member)                                                                     \
    ENTRY(MEASURE(member, length, "mm", "LENGTH"), .name = "viewing", ABOVE_0,                     \
          .serves = coc_is_print, .served = "print",                                               \
          .help = "viewing distance of the print (250 mm), for --coc print, which it implies")

#define OPTION_ACUITY(member)                                                                      \
    ENTRY(MEASURE(member, number, NULL, "NUMBER"), .name = "acuity", ABOVE_0,                      \
          .serves = coc_is_print, .served = "print",                                               \
          .help = "line pairs per mm seen at 25 cm (5), for --coc print, which it implies")

/* `use`: what the light is for, as struct option's `wants`; null = for every answer */
#define OPTION_WAVELENGTH(member, use)                                                             \
    ENTRY(MEASURE(member, length, "nm", "LENGTH"), REPEATED("wavelength"), .letter = 'w', ABOVE_0, \
          .fallback = "550", .wants = (use), .help = "wavelength of the light")

/* The same where a real lens may have its own: absent means 550 nm only without --lens. */
#define OPTION_WAVELENGTH_OF_LENS(member, use)                                                     \
    ENTRY(MEASURE(member, wavelength, "nm", "LENGTH"), REPEATED("wavelength"), .letter = 'w',      \
          ABOVE_0, .wants = (use),                                                                 \
          .help = "wavelength of the light, or a line as 'd'; default the primary one of --lens, " \
                  "else 550")

/* `without`: what it is if not given, or null */
#define OPTION_SQUEEZE(member, without, words)                                                     \
    ENTRY(MEASURE(member, ratio, NULL, "FACTOR"), REPEATED("squeeze"), ABOVE_0,                    \
          .fallback = (without), .help = (words))

#define OPTION_T_NUMBER(member, words)                                                             \
    ENTRY(MEASURE(member, fnumber, NULL, "NUMBER"), .name = "t-stop", .quantity = "T-stop",        \
          .column = "t_stop", ABOVE_0 | OPTION_T_STOP, OPTION_USUAL_FNUMBER, .help = (words))

#define OPTION_FROM(member, words_of)                                                              \
    ENTRY(ASKED(member), .name = "from", .quantity = "distance origin", .column = "distance_from", \
          .words = (words_of), .fallback = "principal", .value = "PLACE",                          \
          .help = "where distances are measured from")

/* -------- of exposure -------- */

#define OPTION_TIME(member, more)                                                                  \
    ENTRY(MEASURE(member, time, "s", "TIME"), REPEATED("time"), .letter = 't',                     \
          .quantity = "exposure time", ABOVE_0 | (more),                                           \
          .help = "exposure time: 1/125, 2s, 180deg@24fps")

#define OPTION_ISO(member, words)                                                                  \
    ENTRY(MEASURE(member, iso, NULL, "SPEED"), REPEATED("iso"), .quantity = "ISO speed", ABOVE_0,  \
          .help = (words))

#define OPTION_EV(member, words)                                                                   \
    ENTRY(MEASURE(member, ev, NULL, "EV"), .name = "ev", .quantity = "exposure value at ISO 100",  \
          .column = "ev100", .lowest = -100, .highest = 100, .help = (words))

#define OPTION_FILTER(member, column_name)                                                         \
    ENTRY(MEASURE(member, stops, NULL, "FILTER[+FILTER]"), .name = "filter",                       \
          .column = (column_name),                                                                 \
          .help = "filter on the lens: ND8 (factor), ND0.9 (density), 3stops, 8x, or a name from " \
                  "'list filters'")

#define OPTION_SERIES(member)                                                                      \
    ENTRY(ASKED(member), .name = "series", .value = "SERIES", .fallback = "third",                 \
          .help = "stop increments of the camera: full, half or third")

/* -------- columns -------- */

#define COLUMN_FOCAL(member, more)                                                                 \
    ENTRY(LENGTH(member, "mm"), .name = "focal", .flags = COLUMN_ECHO | (more), .symbol = "f",     \
          .with = "focal-length", .label = "focal length", .help = "focal length")

#define COLUMN_FNUMBER(member, more)                                                               \
    ENTRY(SHOWN(member), .name = "fnumber", .flags = COLUMN_ECHO | (more), .symbol = "N",          \
          .with = "aperture", .label = "f-number", .help = "f-number as marked")

#define COLUMN_MAGNIFICATION(member, more)                                                         \
    ENTRY(SHOWN(member), .name = "magnification", .flags = (more), .symbol = "m",                  \
          .help = "size on the sensor over size of the subject")

#define COLUMN_SENSOR(member)                                                                      \
    ENTRY(SHOWN(member), .name = "sensor", ASSUMED_BY("sensor crop"), .help = "format or camera")

#define COLUMN_PUPIL(member)                                                                       \
    ENTRY(                                                                                         \
        SHOWN(member), .name = "pupil_magnification",                                              \
        ASSUMED_BY("pupil lens position section wavelength converter close-up stacked reversed") | \
            COLUMN_ECHO,                                                                           \
        .symbol = "P", .label = "pupil magnification",                                             \
        .help = "diameter of the exit over the entrance pupil")

/* Where none is assumed. */
#define COLUMN_SQUEEZE(member)                                                                     \
    ENTRY(SHOWN(member), .name = "squeeze", ASSUMED_WITH("squeeze", "squeeze") | COLUMN_ECHO,      \
          .symbol = "q", .help = "anamorphic squeeze of cylinders in front of the lens")

#define COLUMN_FROM(member)                                                                        \
    ENTRY(SHOWN(member), .name = "distance_from",                                                  \
          .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_HIDDEN, .with = "from",                  \
          .depends = "from", .label = "distances from",                                            \
          .help = "where distances are measured from")

/* Columns of the nearest labels, for rows with these members. */
#define COLUMN_NOMINAL_FNUMBER(member)                                                             \
    ENTRY(SHOWN(member), .name = "nominal_fnumber", BRIEF | COLUMN_SPARSE,                         \
          .label = "nearest f-number", .help = "nearest f-number of the series")

#define COLUMN_NOMINAL_TIME(member)                                                                \
    ENTRY(SHOWN(member), .name = "nominal_time", BRIEF | COLUMN_SPARSE,                            \
          .dimension = &dimension_time, .label = "nearest time",                                   \
          .help = "nearest time of the series; in machine formats a label in s")

#endif
