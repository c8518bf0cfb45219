/* camera/film/film_rays.c - rays from the film: the choice of instructions, and discs. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/film_rays.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

void film_rays_plan(const struct film_plan *plan, const unsigned char *cells, uint32_t block,
                    enum instruction_set set, struct film_samples *samples)
{
    KERNEL_FOR(set, kernel_film_plan)(plan, cells, block, samples);
}

void film_rays_start(const struct exit_pupil_bounds *region, struct film_samples *samples,
                     enum instruction_set set, struct ray_block *block)
{
    KERNEL_FOR(set, kernel_film)(region, samples, block);
}

/* -------- through a disc -------- */

void disc_open(double radius, struct disc *disc)
{
    double cosine = 0, sine = 1; /* of the quarter of a turn, then of an eighth and so on */
    for (int parts = 4; parts < DISC_SECTORS; parts *= 2) {
        sine = sqrt((1 - cosine) / 2);
        cosine = sqrt((1 + cosine) / 2);
    }
    const double out = radius / sqrt((1 + cosine) / 2); /* to the corners of a polygon about it */
    double x = 0, y = out;
    for (int k = 0; k < DISC_SECTORS; k++) {
        disc->corners[k][0] = x;
        disc->corners[k][1] = y;
        const double right = x * cosine + y * sine;
        y = y * cosine - x * sine;
        x = right;
    }
    memcpy(disc->corners[DISC_SECTORS], disc->corners[0], sizeof disc->corners[0]);
    disc->area = 0.5 * DISC_SECTORS * out * out * sine;
}

void disc_open_pinhole(double radius, struct disc *disc)
{
    memset(disc->corners, 0, sizeof disc->corners);
    disc->area = PI * radius * radius;
}

void disc_start(const struct disc *disc, struct film_samples *samples, enum instruction_set set,
                struct ray_block *block)
{
    KERNEL_FOR(set, kernel_disc)(disc, samples, block);
}
