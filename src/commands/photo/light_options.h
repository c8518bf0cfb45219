/* commands/photo/light_options.h - options of exposure that commands share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_LIGHT_OPTIONS_H
#define LENSCALC_COMMANDS_PHOTO_LIGHT_OPTIONS_H

#include "commands/photo/photo_options.h"

#define OPTION_TIME(S, member, more)                                                               \
    {                                                                                              \
        OPTION(S, member),                                                                         \
            .name = "time", .quantity = "exposure time", .letter = 't', .column = "time",          \
            .dimension = &dimension_time, .unit = "s", OPTION_POSITIVE,                            \
            .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY | (more), .value = "TIME",           \
            .help = "exposure time: 1/125, 2s, 180deg@24fps"                                       \
    }

#define OPTION_ISO(S, member, words)                                                               \
    {                                                                                              \
        OPTION(S, member), .name = "iso", .quantity = "ISO speed", .column = "iso",                \
                           .dimension = &dimension_iso, OPTION_POSITIVE,                           \
                           .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .value = "SPEED",    \
                           .help = (words)                                                         \
    }

#define OPTION_EV(S, member, words)                                                                \
    {                                                                                              \
        OPTION(S, member), .name = "ev", .quantity = "exposure value at ISO 100",                  \
                           .column = "ev100", .dimension = &dimension_ev, .lowest = -100,          \
                           .highest = 100, .value = "EV", .help = (words)                          \
    }

#define OPTION_FILTER(S, member, column_name)                                                      \
    {                                                                                              \
        OPTION(S, member), .name = "filter", .column = (column_name),                              \
                           .dimension = &dimension_stops, .value = "FILTER[+FILTER]",              \
                           .help = "on the lens: ND8 (factor), ND0.9 (density), 3stops, 8x, or a " \
                                   "name from 'list filters'"                                      \
    }

#define OPTION_SERIES(S, member)                                                                   \
    {                                                                                              \
        OPTION(S, member), .name = "series", .value = "SERIES", .fallback = "third",               \
                           .help = "stop increments of the camera: full, half or third"            \
    }

/* Columns of the nearest labels, for rows with these members. */
#define COLUMN_NOMINAL_FNUMBER(S, member)                                                          \
    {                                                                                              \
        COLUMN(S, member), .name = "nominal_fnumber", .flags = COLUMN_BRIEF | COLUMN_SPARSE,       \
                           .label = "nearest f-number", .help = "nearest f-number of the series"   \
    }

#define COLUMN_NOMINAL_TIME(S, member)                                                             \
    {                                                                                              \
        COLUMN(S, member), .name = "nominal_time", .dimension = &dimension_time,                   \
                           .flags = COLUMN_BRIEF | COLUMN_SPARSE, .label = "nearest time",         \
                           .help = "nearest time of the series; in machine formats a label in s"   \
    }

#endif
