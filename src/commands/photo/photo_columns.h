/* commands/photo/photo_columns.h - columns that photographic commands share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_PHOTO_COLUMNS_H
#define LENSCALC_COMMANDS_PHOTO_PHOTO_COLUMNS_H

#include "commands/tables.h"
#include "report/table.h"

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
    ENTRY(SHOWN(member), .name = "sensor", ASSUMED_BY("sensor"), .help = "format or camera")

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
          .symbol = "q", .help = "anamorphic squeeze, of cylinders before the lens")

#define COLUMN_FROM(member)                                                                        \
    ENTRY(SHOWN(member), .name = "distance_from",                                                  \
          .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_HIDDEN, .with = "from",                  \
          .depends = "from", .label = "distances from",                                            \
          .help = "where distances are measured from")

#endif
