/* commands/photo/photo_columns.h - columns that photographic commands share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_PHOTO_COLUMNS_H
#define LENSCALC_COMMANDS_PHOTO_PHOTO_COLUMNS_H

#include "report/table.h"

#define COLUMN_FOCAL(S, member, more)                                                              \
    {                                                                                              \
        COLUMN(S, member), .name = "focal", .dimension = &dimension_length, .unit = "mm",          \
                           .flags = COLUMN_ECHO | (more), .with = "focal-length", .symbol = "f",   \
                           .label = "focal length", .help = "focal length"                         \
    }

#define COLUMN_FNUMBER(S, member, more)                                                            \
    {                                                                                              \
        COLUMN(S, member), .name = "fnumber", .flags = COLUMN_ECHO | (more), .with = "aperture",   \
                           .symbol = "N", .label = "f-number", .help = "f-number as marked"        \
    }

#define COLUMN_MAGNIFICATION(S, member, more)                                                      \
    {                                                                                              \
        COLUMN(S, member), .name = "magnification", .flags = (more), .symbol = "m",                \
                           .label = "magnification",                                               \
                           .help = "size on the sensor over size of the subject"                   \
    }

#define COLUMN_SENSOR(S, member)                                                                   \
    {                                                                                              \
        COLUMN(S, member), .name = "sensor", .flags = COLUMN_ASSUMED | COLUMN_EXTRA,               \
                           .depends = "sensor", .label = "sensor", .help = "format or camera"      \
    }

#define COLUMN_PUPIL(S, member)                                                                    \
    {                                                                                              \
        COLUMN(S, member), .name = "pupil_magnification", .symbol = "P",                           \
                           .depends = "pupil lens position section wavelength "                    \
                                      "converter close-up stacked reversed",                       \
                           .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO,                   \
                           .label = "pupil magnification",                                         \
                           .help = "diameter of the exit over the entrance pupil"                  \
    }

/* Where none is assumed. */
#define COLUMN_SQUEEZE(S, member)                                                                  \
    {                                                                                              \
        COLUMN(S, member), .name = "squeeze", .symbol = "q", .with = "squeeze",                    \
                           .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO | COLUMN_TIED,     \
                           .depends = "squeeze", .label = "squeeze",                               \
                           .help = "anamorphic squeeze, of cylinders before the lens"              \
    }

#define COLUMN_FROM(S, member)                                                                     \
    {                                                                                              \
        COLUMN(S, member), .name = "distance_from", .with = "from", .depends = "from",             \
                           .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_HIDDEN,                 \
                           .label = "distances from", .help = "where distances are measured from"  \
    }

#endif
