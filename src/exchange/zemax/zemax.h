/* exchange/zemax/zemax.h - Zemax sequential lens files, .zmx. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_H

#include "exchange/foreign.h"

enum { ZEMAX_TERMS = 8 }; /* of an asphere, among its parameters */

/*
 * .zmx as OpticStudio and its forerunners write it.
 *
 * Source    the format is not published; what is known comes from public files and from readers
 *           such as ray-optics (zmxread.py) and optiland (zemax_handler). [OpticStudio25] says what
 *           the surface types mean
 * Limits    which surfaces, apertures and solves there are is told in lenscalc-convert.1
 */
extern const struct foreign_format zemax_format;

/*
 * The types that hold aspheric terms: term i is the coefficient of r^(step i), in PARM i, or as
 * extra data behind the number of terms and the radius that r is a part of.
 */
struct zemax_asphere {
    const char *name;
    int step, terms;
    bool extra;
};
enum { ZEMAX_ASPHERES = 4 };
extern const struct zemax_asphere zemax_aspheres[ZEMAX_ASPHERES];

/* The words of UNIT. */
extern const struct foreign_unit zemax_units[];

bool zemax_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error);

#endif
