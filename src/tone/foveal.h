/* tone/foveal.h - a picture as the eye looks about in it: means over one degree. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_FOVEAL_H
#define LENSCALC_TONE_FOVEAL_H

#include "base/image/image.h"

/* Cells of one degree in the middle of a plane picture; none is smaller than a pixel. */
struct foveal {
    size_t columns, rows;
    float *light;   /* linear sRGB of each, cd/m^2, rows from the top: the mean of its pixels */
    double cell[2]; /* across and down a cell on the plane at distance 1 */
};

/* How many cells there are. */
struct foveal_grid {
    size_t columns, rows;
};

enum { FOVEAL_VEIL_MOST = 8000 };

/*
 * Look at a picture.
 *
 * Given     image  linear sRGB, three channels
 *           angle  that its width takes of the view, rad, 0 to PI; the picture is plane
 * Source    [WardLarson97]: the eye adapts to the mean over the fovea, a degree across
 */
struct foveal foveal_look(const struct image *image, double angle, struct arena *arena);

/* Luminance of a cell. */
double foveal_luminance(const struct foveal *foveal, size_t cell);

/*
 * Add what the eye scatters: the cells, and the pixels between them, become
 * (1 - SIGHT_VEIL) L + veil.
 *
 * Formula   veil(i) = SIGHT_VEIL sum_j w_ij L_j, w_ij = d_i d_j cos t/t^2, t the angle between
 *           cells i and j, i not j; the d such that all sums of w over i and over j are 1
 * Source    [WardLarson97], after [MoonSpencer45]. There w is divided by its sum for the cell that
 *           receives light, so that light appears or gets lost at the edges; here none does, and an
 *           even picture stays even all the same
 * Result    the mean of all pixels is what it was, in each channel; the cells between which light
 *           is scattered
 * Limits    of more than FOVEAL_VEIL_MOST cells larger ones are taken: the work goes with the
 *           square of their number
 */
struct foveal_grid foveal_veil(struct foveal *foveal, struct image *image, struct arena *arena);

/* Four cells, and what each counts at a place between them: 1 together. */
struct foveal_between {
    size_t cells[4];
    float shares[4];
};

/*
 * Between the middles of cells in straight lines, beyond the outermost as those.
 *
 * Given     x, y  of the place, from the left and the top, over the picture's width and height
 */
struct foveal_between foveal_between(const struct foveal *foveal, double x, double y);

#endif
