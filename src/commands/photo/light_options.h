/* commands/photo/light_options.h - options of exposure that commands share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_LIGHT_OPTIONS_H
#define LENSCALC_COMMANDS_PHOTO_LIGHT_OPTIONS_H

#include "commands/photo/photo_options.h"
#include "commands/tables.h"

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
          .help = "on the lens: ND8 (factor), ND0.9 (density), 3stops, 8x, or a name from 'list "  \
                  "filters'")

#define OPTION_SERIES(member)                                                                      \
    ENTRY(ASKED(member), .name = "series", .value = "SERIES", .fallback = "third",                 \
          .help = "stop increments of the camera: full, half or third")

/* Columns of the nearest labels, for rows with these members. */
#define COLUMN_NOMINAL_FNUMBER(member)                                                             \
    ENTRY(SHOWN(member), .name = "nominal_fnumber", BRIEF | COLUMN_SPARSE,                         \
          .label = "nearest f-number", .help = "nearest f-number of the series")

#define COLUMN_NOMINAL_TIME(member)                                                                \
    ENTRY(SHOWN(member), .name = "nominal_time", BRIEF | COLUMN_SPARSE,                            \
          .dimension = &dimension_time, .label = "nearest time",                                   \
          .help = "nearest time of the series; in machine formats a label in s")

#endif
