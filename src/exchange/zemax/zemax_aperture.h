/* exchange/zemax/zemax_aperture.h - the apertures of surfaces in .zmx files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_APERTURE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_APERTURE_H

#include "exchange/zemax/zemax_parse.h"
#include "exchange/zemax/zemax_writer.h"

/*
 * A surface of a file has one aperture or none: a circle or ring (CLAP), a rectangle (SQAP), an
 * ellipse (ELAP), or what blocks: OBSC, SQOB, ELOB, a spider (SPID); decentred by OBDC. Polygons
 * stand in files of their own.
 *
 * Given     to  its diameter and whether it is the stop are set: of a surface with an aperture that
 *               passes only a diameter about all of it stays, or the stop's
 */
bool zemax_set_aperture(struct zemax_file *file, const struct zemax_surface *from,
                        struct surface *to, struct error *error);

/* The digits of half of a diameter. */
const char *zemax_half(const struct lens_writer *writing, const struct figure *figure);

/* The first one of a surface that the format has; the others are losses. */
void zemax_put_aperture(struct lens_writer *writing, const struct surface *surface, size_t number);

#endif
