/* base/units.h - dimensions and their units. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_UNITS_H
#define LENSCALC_BASE_UNITS_H

#include "base/number.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* One unit. The value in the program's own unit is typed x multiplier x 10^power x factor. */
struct unit {
    const char *name;  /* typed, and the end of a column's name: "mm" */
    const char *label; /* in the head of a table: "mm", "1/m" */
    struct number_scale scale;
    double factor;         /* what of the conversion is no decimal: pi/180; else 1 */
    const char *spellings; /* other ways to type it, separated by blanks; null = none */
    const char *help;
};

/* What a quantity measures, and how it may be written. The first unit is the program's own. */
struct dimension {
    const char *name;
    const struct unit *units;
    size_t unit_count;
    const char *prefixes; /* that may stand before the number ("f/ f T"), case ignored; or null */
    bool fraction;        /* 1/125 */
    bool ratio;           /* 1:2 */
    const char *series;   /* the stop series its labels come from, a file of lensdb; or null */
};

extern const struct dimension dimension_number, dimension_length, dimension_angle, dimension_time,
    dimension_fnumber, dimension_ratio, dimension_vergence, dimension_iso, dimension_ev,
    dimension_stops, dimension_luminance, dimension_illuminance, dimension_exposure,
    dimension_speed, dimension_rotation, dimension_frequency, dimension_rate, dimension_temperature,
    dimension_pressure, dimension_storage, dimension_colour, dimension_mass, dimension_volume,
    dimension_pixel_density, dimension_luminous_flux, dimension_pixels;

/*
 * A length that may also be the name of a spectral line; the names are data of lensdb. Its own unit
 * is the millimetre, for formulas with other lengths, or the micrometre, as lenses have it.
 */
extern const struct dimension dimension_wavelength, dimension_wavelength_um;

/*
 * A length that may also be one on another format, where it has the same diagonal angle: 26mm-eq.
 * Its units are those of dimension_length and that one.
 */
extern const struct dimension dimension_focal_length;

/* Is it the unit of focal lengths on 36 x 24 mm? */
bool unit_is_equivalent(const struct unit *unit);

/* All dimensions, for lists and for naming the right one in a message; ends with null. */
extern const struct dimension *const dimensions[];

/* The unit of that dimension with this name or spelling; null if there is none. */
const struct unit *unit_find(const struct dimension *dimension, struct text name);

/* Is it the program's own unit of its dimension? */
bool unit_is_own(const struct unit *unit);

/* Convert between a unit and the program's own (mm, rad, s, 1/mm). One rounding for decimal units.
 */
double unit_to_own(const struct unit *unit, double value);
double unit_from_own(const struct unit *unit, double value);

/*
 * What a computed value is in the program's own unit if a decimal of at most nine places was meant.
 *
 * Given     value  in the unit, with rounding errors: 64.99999999999999 for 65
 *           slack  how far it may be off, in the unit
 *           own    receives what quantity_read makes of that decimal, to the last bit
 * Result    false: no such decimal is so near; `own` is not set
 */
bool unit_decimal_to_own(const struct unit *unit, double value, double slack, double *own);

#endif
