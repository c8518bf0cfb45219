/* optics/wavelength.h - the spectral lines by which materials are described. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_WAVELENGTH_H
#define LENSCALC_OPTICS_WAVELENGTH_H

/* In air, um, as the makers' tables print them; all lines with their names are in lines.tsv. */
#define WAVELENGTH_G       0.4358343
#define WAVELENGTH_F_PRIME 0.4799914
#define WAVELENGTH_F       0.4861327
#define WAVELENGTH_E       0.5460740
#define WAVELENGTH_D       0.5875618 /* the helium line d, not sodium's D */
#define WAVELENGTH_C_PRIME 0.6438469
#define WAVELENGTH_C       0.6562725

/* What is beyond is a mistake of the unit: 1 nm to 100 mm. */
#define WAVELENGTH_SHORTEST 0.001
#define WAVELENGTH_LONGEST  100000.0

#endif
