/* commands/photo/lamps.h - what lamps do to a photograph: their colour, their flicker. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_LAMPS_H
#define LENSCALC_COMMANDS_PHOTO_LAMPS_H

#include "cli/question/command.h"
#include "photo/flicker.h"

#include <math.h>

/* What the options say; NaN = not given. */
struct lamps {
    double kelvin, balance; /* colour temperature of the light, and that of film or camera, K */
    double mains;           /* Hz */
};

#define OPTION_KELVIN(S, member, option_name, words)                                               \
    {                                                                                              \
        OPTION(S, member), .name = option_name, .quantity = "colour temperature",                  \
                           .column = option_name, .dimension = &dimension_colour, .lowest = 500,   \
                           .highest = 100000, .value = "KELVIN", .help = (words)                   \
    }

/* Of a member of type struct lamps. */
#define LAMP_OPTIONS(S, member)                                                                    \
    OPTION_KELVIN(S, member.kelvin, "kelvin",                                                      \
                  "colour temperature of the light: 3200K; what filters make of it"),              \
        OPTION_KELVIN(S, member.balance, "balance",                                                \
                      "what film or white balance is made for: finds the conversion filter"),      \
    {                                                                                              \
        OPTION(S, member.mains),                                                                   \
            .name = "mains", .quantity = "mains frequency", .column = "mains",                     \
            .dimension = &dimension_rate, .unit = "Hz", OPTION_POSITIVE,                           \
            .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "50|60",                   \
            .help = "frequency of the mains that lamps follow: times and "                         \
                    "shutter angles without flicker"                                               \
    }

/* What the lamps shine on. */
struct lamp_camera {
    double filter;  /* mired, as struct loss_value has it; 0 for none */
    double t, rate; /* exposure time, s, and frames per second; NaN = not known */
};

/* What is answered; NaN and null = absent. */
struct lamp_row {
    double kelvin, balance, shift, filtered, wanted, conversion_shift;
    const char *conversion;
    double mains, free_time;
    const char *flicker, *free_times, *free_angles;
};

#define LAMP_COLUMN(S, member, column_name)                                                        \
    COLUMN(S, member), .name = column_name, .flags = COLUMN_EXTRA
#define LAMP_BRIEF(S, member, column_name)                                                         \
    COLUMN(S, member), .name = column_name, .flags = COLUMN_EXTRA | COLUMN_BRIEF

/* Of a member of type struct lamp_row. */
#define LAMP_COLUMNS(S, member)                                                                    \
    {LAMP_COLUMN(S, member.kelvin, "kelvin") | COLUMN_ECHO,                                        \
     .dimension = &dimension_colour,                                                               \
     .unit = "K",                                                                                  \
     .with = "kelvin",                                                                             \
     .symbol = "K1",                                                                               \
     .label = "colour temperature",                                                                \
     .help = "of the light"},                                                                      \
        {LAMP_COLUMN(S, member.balance, "balance") | COLUMN_ECHO,                                  \
         .dimension = &dimension_colour,                                                           \
         .unit = "K",                                                                              \
         .with = "balance",                                                                        \
         .symbol = "K2",                                                                           \
         .label = "balanced for",                                                                  \
         .help = "colour temperature of film or white balance"},                                   \
        {LAMP_COLUMN(S, member.shift, "mired_shift"), .with = "filter", .symbol = "M",             \
         .label = "mired shift of the filter",                                                     \
         .help = "of the filters that are on: + amber, - blue"},                                   \
        {LAMP_BRIEF(S, member.filtered, "filtered"),                                               \
         .dimension = &dimension_colour,                                                           \
         .unit = "K",                                                                              \
         .with = "filter",                                                                         \
         .symbol = "K3",                                                                           \
         .label = "behind the filter",                                                             \
         .help = "colour temperature behind the filters that are on"},                             \
        {LAMP_BRIEF(S, member.wanted, "mired_wanted"), .with = "balance", .symbol = "Mw",          \
         .label = "mired shift wanted", .help = "beside the filters that are on"},                 \
        {LAMP_BRIEF(S, member.conversion, "conversion_filter"), .with = "balance",                 \
         .label = "nearest filter", .help = "conversion filter with the nearest shift"},           \
        {LAMP_COLUMN(S, member.conversion_shift, "conversion_shift"), .with = "balance",           \
         .label = "its mired shift", .help = "of the nearest filter"},                             \
        {LAMP_BRIEF(S, member.flicker, "flicker"), .with = "mains", .label = "flicker",            \
         .help = "of this exposure under lamps on the mains"},                                     \
        {LAMP_BRIEF(S, member.free_time, "flicker_free_time"),                                     \
         .dimension = &dimension_time,                                                             \
         .unit = "s",                                                                              \
         .with = "mains",                                                                          \
         .symbol = "tf",                                                                           \
         .label = "nearest time without flicker",                                                  \
         .help = "whole pulses of the lamps, within a frame"},                                     \
        {LAMP_COLUMN(S, member.free_times, "flicker_free_times"), .with = "mains",                 \
         .label = "times without flicker", .help = "the first of them, in s"},                     \
        {LAMP_COLUMN(S, member.free_angles, "flicker_free_angles"), .with = "mains",               \
         .label = "shutter angles without flicker", .help = "at the frame rate, in degrees"},      \
    {                                                                                              \
        LAMP_COLUMN(S, member.mains, "mains") | COLUMN_ASSUMED | COLUMN_ECHO | COLUMN_TIED,        \
            .dimension = &dimension_rate, .unit = "Hz", .with = "mains", .depends = "mains",       \
            .symbol = "mains", .label = "lamps on a mains of", .help = "frequency of the mains"    \
    }

/* Is anything of it asked? */
static inline bool lamps_asked(const struct lamps *lamps)
{
    return !isnan(lamps->kelvin) || !isnan(lamps->balance) || !isnan(lamps->mains);
}

/*
 * Answer what is asked.
 *
 * Given     camera  what they shine on
 * Errors    --balance without --kelvin (ERROR_USAGE); as photo/mired.h and photo/flicker.h
 */
bool lamps_answer(const struct lamps *lamps, const struct lamp_camera *camera, struct run *run,
                  struct lamp_row *row, struct error *error);

#endif
