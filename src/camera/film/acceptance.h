/* camera/film/acceptance.h - how much of light that comes slanting a pixel takes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_ACCEPTANCE_H
#define LENSCALC_CAMERA_FILM_ACCEPTANCE_H

#include "base/error.h"
#include "camera/film/film_rays.h"

#include <stddef.h>

enum { ACCEPTANCE_STEPS = 4096 };

/* By the sine of the angle of incidence, in even steps; as floats, which libm's last bits spare. */
struct acceptance {
    float at[ACCEPTANCE_STEPS + 1];
};

/*
 * A power of the cosine of the angle of incidence: 1 where light falls straight.
 *
 * Given     power  0 to 100
 * Errors    ERROR_DOMAIN: another power
 */
bool acceptance_power(double power, struct acceptance *acceptance, struct error *error);

/*
 * A table, with straight lines between its rows.
 *
 * Given     angle  rad, from 0 and rising, to pi/2 at most; beyond the last one nothing is taken
 *           taken  share, 0 to 1, of each; the first above 0
 * Errors    ERROR_DOMAIN: numbers that are not so
 */
bool acceptance_table(const double *angle, const double *taken, size_t count,
                      struct acceptance *acceptance, struct error *error);

/*
 * Weigh rays by it.
 *
 * Given     acceptance  null: all is taken
 *           block       rays as they leave the film, before they are traced
 *           samples     their weights, which are multiplied
 * Formula   linear in sin(theta) = sqrt((p^2 + q^2)/(p^2 + q^2 + r^2))
 */
void acceptance_weigh(const struct acceptance *acceptance, const struct ray_block *block,
                      struct film_samples *samples);

#endif
