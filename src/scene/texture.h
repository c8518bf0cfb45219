/* scene/texture.h - textures: bilinear lookup in pictures on things. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_TEXTURE_H
#define LENSCALC_SCENE_TEXTURE_H

#include "base/image/image.h"

/* Red, green, blue, and the share of it that is there. */
enum { TEXTURE_ALPHA = 3, TEXTURE_CHANNELS };

/* What lies beside the borders of a picture. */
enum texture_edges {
    TEXTURE_ENDS,   /* the pixels at the border go on */
    TEXTURE_ROUND,  /* left and right it begins anew, as around a globe */
    TEXTURE_REPEATS /* it begins anew on all sides */
};

/*
 * Look at a place of a picture.
 *
 * Given     image    colour is in the first channel, or of three and more in the first three; of
 *                    four the last is alpha
 *           place    from the left and from below, 0 to 1
 * Result    of  linear sRGB; pixels have the light of their middles, and what lies between four of
 *               them goes in a straight line. Alpha of a picture that has none is 1.
 *               NaN where the place is no number, or endless
 */
void texture_lookup(const struct image *image, const double place[2], enum texture_edges edges,
                    double of[TEXTURE_CHANNELS]);

/* The mean luminance of a picture, of three channels or four, over that of white; alpha counts
   nothing. */
double texture_luminance(const struct image *image);

#endif
