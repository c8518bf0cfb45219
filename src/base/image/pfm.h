/* base/image/pfm.h - PFM: 32-bit floats as they are. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_PFM_H
#define LENSCALC_BASE_IMAGE_PFM_H

#include "base/image/image.h"

bool pfm_is(struct text file);

/*
 * Read one: "PF" or "Pf", width, height, scale; rows from the bottom. A negative scale means
 * little-endian; its size multiplies the pixels.
 *
 * Result    channels RGB or Y; the format has no notes
 * Source    the format as its author describes it, pauldebevec.com/Research/HDR/PFM
 * Errors    ERROR_DATA: not of that form, more or fewer bytes than it has pixels, NaN
 */
bool pfm_read(struct text file, const struct image_wish *wish, struct arena *arena,
              struct image *image, struct error *error);

/*
 * Write one, little-endian, of scale 1. What is noted is not written: readers know no comments.
 *
 * Errors    ERROR_DATA: neither 1 nor 3 channels, NaN
 */
bool pfm_write(const struct image *image, struct arena *arena, struct text *file,
               struct error *error);

#endif
