/* cli/sharpness.h - the options that say how sharp is sharp, shared by photographic commands. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_SHARPNESS_H
#define LENSCALC_CLI_SHARPNESS_H

#include "commands/photo/photo_columns.h"
#include "commands/photo/photo_options.h"

/* A circle of confusion, and what it may be derived from. */
struct sharpness {
    struct coc_value coc;
    struct sensor_value sensor;
    double pitch;          /* mm; NaN = that of the sensor */
    double print, viewing; /* mm */
    double acuity;         /* line pairs per mm at 25 cm */
    double wavelength;     /* mm; NaN = not given, where a lens may have its own */
};

/* Initialisers of the options for a member of that type in a command's input. */
#define SHARPNESS_OPTIONS(S, member, more, coc_fallback)                                           \
    SHARPNESS_OPTIONS_DARK(S, member, more, coc_fallback), OPTION_WAVELENGTH(S, member.wavelength)

/* The same for a command with --lens. */
#define SHARPNESS_OPTIONS_OF_LENS(S, member, more, coc_fallback)                                   \
    SHARPNESS_OPTIONS_DARK(S, member, more, coc_fallback),                                         \
        OPTION_WAVELENGTH_OF_LENS(S, member.wavelength)

/* What both have: all but the light. */
#define SHARPNESS_OPTIONS_DARK(S, member, more, coc_fallback)                                      \
    OPTION_COC(S, member.coc, more, coc_fallback), OPTION_SENSOR(S, member.sensor),                \
        OPTION_PITCH(S, member.pitch), OPTION_PRINT(S, member.print),                              \
        OPTION_VIEWING(S, member.viewing), OPTION_ACUITY(S, member.acuity)

/* With one of these wishes the circle of confusion may be the unknown of every row. */
#define SHARPNESS_WISHES " +near +far +dof +hyperfocal"

/* The circle of confusion; `wishes` is SHARPNESS_WISHES where the command has them, else "". */
#define COLUMN_COC(S, member, more, wishes)                                                        \
    {                                                                                              \
        COLUMN(S, member), .name = "coc", .dimension = &dimension_length, .unit = "mm",            \
                           .flags = COLUMN_ASSUMED | (more), .symbol = "c",                        \
                           .depends = "coc sensor pitch print viewing acuity wavelength" wishes,   \
                           .label = "circle of confusion",                                         \
                           .help = "circle of confusion, diameter on the sensor"                   \
    }

#define COLUMN_CRITERION(S, member)                                                                \
    {                                                                                              \
        COLUMN(S, member), .name = "coc_criterion", .symbol = "criterion", .depends = "coc",       \
                           .flags = COLUMN_ASSUMED | COLUMN_EXTRA, .label = "criterion",           \
                           .help = "where the circle of confusion comes from"                      \
    }

#define COLUMN_WAVELENGTH(S, member)                                                               \
    {                                                                                              \
        COLUMN(S, member), .name = "wavelength", .dimension = &dimension_length, .unit = "nm",     \
                           .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO, .symbol = "w",    \
                           .depends = "wavelength lens", .label = "wavelength",                    \
                           .help = "of the light in a real lens and in the Airy disc"              \
    }

/*
 * The circle of confusion.
 *
 * Given     fnumber  for the Airy disc; NaN where it is not known yet
 *           c        receives the diameter, mm; NaN if no criterion is given
 * Errors    as coc_resolve
 */
bool sharpness_resolve(const struct sharpness *sharpness, double fnumber, double *c,
                       struct error *error);

/* The same in light of this wavelength, mm. */
bool sharpness_resolve_in(const struct sharpness *sharpness, double wavelength, double fnumber,
                          double *c, struct error *error);

/* Does the criterion follow from the wavelength? */
static inline bool sharpness_is_airy(const struct sharpness *sharpness)
{
    return sharpness->coc.coc.kind == COC_AIRY;
}

#endif
