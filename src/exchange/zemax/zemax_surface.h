/* exchange/zemax/zemax_surface.h - the surfaces of a .zmx file as those of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_SURFACE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_SURFACE_H

#include "exchange/zemax/zemax_parse.h"

/* The medium behind a surface; that before it where it is a mirror (which *medium becomes). */
bool zemax_medium(struct zemax_file *file, const struct zemax_surface *surface,
                  const struct medium *before, struct medium *medium, struct error *error);

/* Is the image plane set by the solve that brings the marginal ray to height 0 there? */
bool zemax_focuses(const struct zemax_file *file);

/*
 * All surfaces between object and image, with their solves.
 *
 * Given     file  parsed; object, aperture, fields and wavelengths of the lens are set
 */
bool zemax_surfaces(struct zemax_file *file, struct error *error);

/*
 * The lens of a file with configurations: built once for each of them, with what the operands of
 * the file put in the place of its lines, and then put together (exchange/merge_positions).
 *
 * Given     file   parsed; its lens has the names of the positions
 *           build  makes the lens of a file without configurations
 */
typedef bool zemax_build_function(struct zemax_file *file, struct error *error);
bool zemax_read_positions(struct zemax_file *file, zemax_build_function *build,
                          struct error *error);

/*
 * The thicknesses of all surfaces, solved.
 *
 * Given     places  index in the lens of each surface of the file; LENS_NONE = it has none
 */
bool zemax_thicknesses(struct zemax_file *file, const size_t *places, struct error *error);

#endif
