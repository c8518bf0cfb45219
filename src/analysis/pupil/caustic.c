/* analysis/pupil/caustic.c - the sign of the Jacobian over a bundle. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/caustic.h"

#include <math.h>

/* Arms and rings. */
static const size_t grids[][2] = {[CAUSTIC_COARSE] = {32, 3}, [CAUSTIC_FINE] = {128, 12}};

/* Of the size of the beam: differences keep about nine digits. */
static const double STEP = 1e-6;

const double (*folding_places(const struct clear_pupil *clear, enum caustic_grid grid,
                              struct arena *arena, size_t *count))[2]
{
    const size_t arms = clear->arm_count < grids[grid][0] ? clear->arm_count : grids[grid][0];
    const size_t rings = grids[grid][1];
    const double size = fmax(clear->high[0] - clear->low[0], clear->high[1] - clear->low[1]);
    *count = 3 * arms * rings;
    double(*at)[2] = arena_array(arena, *count, sizeof *at), (*next)[2] = at;
    for (size_t i = 0; i < arms; i++) {
        const double *edge = clear->arms[i * clear->arm_count / arms].edge.at, *c = clear->centre;
        for (size_t ring = 0; ring < rings; ring++, next += 3) {
            /* the last one at the edge, where folds begin */
            double share = (double)(ring + 1) / (double)rings;
            for (int k = 0; k < 2; k++) {
                next[0][k] = next[1][k] = next[2][k] = c[k] + share * (edge[k] - c[k]);
            }
            next[1][0] += STEP * size;
            next[2][1] += STEP * size;
        }
    }
    return (const double(*)[2])at;
}

void caustic_add(struct jacobian_extremes *folding, const double (*points)[2], size_t count)
{
    for (size_t i = 0; i + 2 < count; i += 3) {
        const double *here = points[i], *right = points[i + 1], *upper = points[i + 2];
        double det = (right[0] - here[0]) * (upper[1] - here[1]) -
                     (right[1] - here[1]) * (upper[0] - here[0]);
        folding->least = fmin(folding->least, det);
        folding->most = fmax(folding->most, det);
        folding->inverse = fmax(folding->inverse, isnan(det) ? (double)INFINITY : 1 / fabs(det));
    }
}

bool caustic_seen(const struct jacobian_extremes *folding)
{
    const double least = -folding->least, most = folding->most;
    return fmin(least, most) > 1e-6 * fmax(least, most);
}

bool caustic_ruled_out(const struct jacobian_extremes *folding)
{
    const double most = fmax(-folding->least, folding->most);
    return !caustic_seen(folding) && most * folding->inverse < 2;
}
