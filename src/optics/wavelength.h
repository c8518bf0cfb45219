/* optics/wavelength.h - spectral lines by name. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_WAVELENGTH_H
#define LENSCALC_OPTICS_WAVELENGTH_H

#include "base/text.h"

#include <stdbool.h>

#define WAVELENGTH_D 0.5875618 /* um, helium d */
#define WAVELENGTH_F 0.4861327 /* um, hydrogen F */
#define WAVELENGTH_C 0.6562725 /* um, hydrogen C */

/* A spectral line that glass catalogues name. */
struct spectral_line {
    const char *name;
    double wavelength; /* um, in air */
    const char *element;
};

/* From short to long waves; ends with a null name. Case counts: F and f are not the same. */
extern const struct spectral_line spectral_lines[];

/* The line of this name; null if there is none. */
const struct spectral_line *spectral_line_find(struct text name);

#endif
