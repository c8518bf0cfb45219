/* commands/photo/photo_options.h - options that photographic commands share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_PHOTO_OPTIONS_H
#define LENSCALC_COMMANDS_PHOTO_PHOTO_OPTIONS_H

#include "base/constants.h"
#include "cli/options/option.h"

#include <math.h>

/* What options serve: a circle of confusion in pixels, or seen on a print. */
bool coc_is_pixels(const struct coc_value *coc);
bool coc_is_print(const struct coc_value *coc);

/* A length or number above 0 and finite. */
#define OPTION_POSITIVE .lowest = 0, .highest = INFINITY

#define OPTION_FOCAL_LENGTH(S, member, more)                                                       \
    {                                                                                              \
        OPTION(S, member), .name = "focal-length", .letter = 'f', .column = "focal",               \
                           .dimension = &dimension_focal_length, .unit = "mm", OPTION_POSITIVE,    \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | (more),             \
                           .value = "LENGTH",                                                      \
                           .help = "focal length; 26mm-eq is the equivalent on 36 x 24 mm, which " \
                                   "is converted by the diagonal of --sensor"                      \
    }

#define OPTION_APERTURE(S, member, more)                                                           \
    {                                                                                              \
        OPTION(S, member), .name = "aperture", .quantity = "f-number", .letter = 'N',              \
                           .column = "fnumber", .dimension = &dimension_fnumber, OPTION_POSITIVE,  \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | (more),             \
                           .value = "NUMBER", .help = "f-number: 2.8 or f/2.8",                    \
                           OPTION_USUAL_FNUMBER                                                    \
    }

/* Sin theta' is 1 at most, and twice it 1/N. */
#define OPTION_USUAL_FNUMBER                                                                       \
    .usual = {0.5, INFINITY}, .unusual = "no lens in air can be faster than f/0.5"

#define OPTION_DISTANCE(S, member, more, words)                                                    \
    {                                                                                              \
        OPTION(S, member), .name = "distance", .letter = 's', .column = "distance",                \
                           .dimension = &dimension_length, .unit = "m", OPTION_POSITIVE,           \
                           .flags = OPTION_ABOVE_LOWEST | (more), .value = "LENGTH",               \
                           .help = (words)                                                         \
    }

#define OPTION_COC(S, member, more, fallback_text)                                                 \
    {                                                                                              \
        OPTION(S, member), .name = "coc", .quantity = "circle of confusion", .letter = 'c',        \
                           .column = "coc", .dimension = &dimension_length, .unit = "mm",          \
                           .lowest = 0, .highest = INFINITY, .flags = OPTION_NO_INFINITY | (more), \
                           .fallback = (fallback_text), .value = "LENGTH",                         \
                           .help = "circle of confusion: a diameter, d/1500 (part of the "         \
                                   "sensor's diagonal), 2px (pixels), airy (the disc of "          \
                                   "diffraction), print (just visible on a print)"                 \
    }

#define OPTION_SENSOR(S, member)                                                                   \
    {                                                                                              \
        OPTION(S, member), .name = "sensor", .column = "sensor", .fallback = "35mm",               \
                           .value = "NAME|WxH",                                                    \
                           .help = "format or camera by name, or a size: 36x24mm"                  \
    }

#define OPTION_PUPIL(S, member)                                                                    \
    {                                                                                              \
        OPTION(S, member), .name = "pupil", .quantity = "pupil magnification", .letter = 'P',      \
                           .column = "pupil_magnification", .dimension = &dimension_number,        \
                           OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,     \
                           .fallback = "1", .value = "NUMBER",                                     \
                           .help = "pupil magnification, exit over entrance pupil"                 \
    }

/* The same where a real lens may have its own: absent means 1 only without --lens. */
#define OPTION_PUPIL_OF_LENS(S, member, use)                                                       \
    {                                                                                              \
        OPTION(S, member), .name = "pupil", .quantity = "pupil magnification", .letter = 'P',      \
                           .column = "pupil_magnification", .dimension = &dimension_number,        \
                           OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,     \
                           .value = "NUMBER", .wants = (use),                                      \
                           .help = "pupil magnification, exit over entrance pupil; default that "  \
                                   "of --lens, else 1"                                             \
    }

#define USUAL_PITCH                                                                                \
    .usual = {0.3e-3, 30e-3}, .unusual = "pixels are 0.3 to 30 um wide: is the unit right?"

/* `use`: coc_is_pixels where the pitch is for --coc alone, else null */
#define OPTION_PITCH(S, member, use)                                                               \
    {                                                                                              \
        OPTION(S, member), .name = "pitch", .quantity = "pixel pitch",                             \
                           .dimension = &dimension_length, .unit = "um", OPTION_POSITIVE,          \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "LENGTH",   \
                           .serves = (use), .served = "in px", USUAL_PITCH,                        \
                           .help = "pixel pitch (otherwise that of the camera); where nothing "    \
                                   "else needs it, it implies --coc 2px"                           \
    }

/* Where it has nothing to do with a circle of confusion. */
#define OPTION_PIXELS(S, member, needs, words)                                                     \
    {                                                                                              \
        OPTION(S, member), .name = "pitch", .quantity = "pixel pitch",                             \
                           .dimension = &dimension_length, .unit = "um", OPTION_POSITIVE,          \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "LENGTH",   \
                           .wants = (needs), USUAL_PITCH, .help = (words)                          \
    }

#define OPTION_DECLINATION(S, member, needs, words)                                                \
    {                                                                                              \
        OPTION(S, member), .name = "declination", .column = "declination",                         \
                           .dimension = &dimension_angle, .unit = "deg", .lowest = -PI / 2,        \
                           .highest = PI / 2, .fallback = "0", .value = "ANGLE", .wants = (needs), \
                           .help = (words)                                                         \
    }

/* What a print is looked at like, for --coc print. */
#define OPTION_PRINT(S, member)                                                                    \
    {                                                                                              \
        OPTION(S, member), .name = "print", .dimension = &dimension_length, .unit = "mm",          \
                           OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,     \
                           .value = "PRINT", .serves = coc_is_print, .served = "print",            \
                           .help = "for --coc print, which it implies: the long side (254 mm), "   \
                                   "16x24in or a paper, A2; seen from 1 m: A2@1m; by which eye: "  \
                                   "A2@1m@20/20"                                                   \
    }

#define OPTION_VIEWING(S, member)                                                                  \
    {                                                                                              \
        OPTION(S, member), .name = "viewing", .dimension = &dimension_length, .unit = "mm",        \
                           OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,     \
                           .value = "LENGTH", .serves = coc_is_print, .served = "print",           \
                           .help = "viewing distance of the print (250 mm), for --coc print, "     \
                                   "which it implies"                                              \
    }

#define OPTION_ACUITY(S, member)                                                                   \
    {                                                                                              \
        OPTION(S, member), .name = "acuity", .dimension = &dimension_number, OPTION_POSITIVE,      \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "NUMBER",   \
                           .serves = coc_is_print, .served = "print",                              \
                           .help = "line pairs per mm seen at 25 cm (5), for --coc print, which "  \
                                   "it implies"                                                    \
    }

/* `use`: what the light is for, as struct option's `wants`; null = for every answer */
#define OPTION_WAVELENGTH(S, member, use)                                                          \
    {                                                                                              \
        OPTION(S, member), .name = "wavelength", .letter = 'w', .column = "wavelength",            \
                           .dimension = &dimension_length, .unit = "nm", OPTION_POSITIVE,          \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .fallback = "550",   \
                           .value = "LENGTH", .wants = (use), .help = "wavelength of the light"    \
    }

/* The same where a real lens may have its own: absent means 550 nm only without --lens. */
#define OPTION_WAVELENGTH_OF_LENS(S, member, use)                                                  \
    {                                                                                              \
        OPTION(S, member), .name = "wavelength", .letter = 'w', .column = "wavelength",            \
                           .dimension = &dimension_wavelength, .unit = "nm", OPTION_POSITIVE,      \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "LENGTH",   \
                           .wants = (use),                                                         \
                           .help = "wavelength of the light, or a line as 'd'; default the "       \
                                   "primary one of --lens, else 550"                               \
    }

/* `without`: what it is if not given, or null */
#define OPTION_SQUEEZE(S, member, without, words)                                                  \
    {                                                                                              \
        OPTION(S, member), .name = "squeeze", .column = "squeeze", .dimension = &dimension_ratio,  \
                           OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY,     \
                           .fallback = (without), .value = "FACTOR", .help = (words)               \
    }

#define OPTION_T_NUMBER(S, member, words)                                                          \
    {                                                                                              \
        OPTION(S, member), .name = "t-stop", .quantity = "T-stop", .column = "t_stop",             \
                           .dimension = &dimension_fnumber, OPTION_POSITIVE,                       \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | OPTION_T_STOP,      \
                           .value = "NUMBER", OPTION_USUAL_FNUMBER, .help = (words)                \
    }

#define OPTION_FROM(S, member, words_of)                                                           \
    {                                                                                              \
        OPTION(S, member), .name = "from", .quantity = "distance origin",                          \
                           .column = "distance_from", .words = (words_of),                         \
                           .fallback = "principal", .value = "PLACE",                              \
                           .help = "where distances are measured from"                             \
    }

#endif
