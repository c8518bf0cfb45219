/* base/image/radiance.h - Radiance's pictures: three floats in four bytes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_RADIANCE_H
#define LENSCALC_BASE_IMAGE_RADIANCE_H

#include "base/image/image.h"

bool radiance_is(struct text file);

/*
 * Read one: 32-bit_rle_rgbe or 32-bit_rle_xyze, rows packed or plain.
 *
 * Result    3 channels: XYZ, or RGB, with the line PRIMARIES as the image's own; a mantissa m with
 *           the exponent byte e is m 2^(e - 136), and all is divided by what EXPOSURE and COLORCORR
 *           say it was multiplied by. Notes: the head's lines "# key: value"
 * Source    [Ward91]; mantissas as Walter (1997) and most readers take them, without the half step
 *           that Ward's own adds
 * Errors    ERROR_DATA: truncated, EXPOSURE or COLORCORR beyond 1e-38 to 1e38, PRIMARIES that are
 *           not eight numbers, a row of another length, rows packed as they were before 1991
 */
bool radiance_read(struct text file, const struct image_wish *wish, struct arena *arena,
                   struct image *image, struct error *error);

/*
 * Write one of 1 or 3 channels; grey becomes three equal ones. Mantissas are rounded to the
 * nearest: within 1/256 of the largest of the three.
 *
 * Errors    ERROR_DATA: another number of channels; a negative value, infinity or NaN, or one
 *           above 1.69e38, which the format does not have
 */
bool radiance_write(const struct image *image, struct arena *arena, struct text *file,
                    struct error *error);

#endif
