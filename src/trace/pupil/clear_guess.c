/* trace/pupil/clear_guess.c - where paraxial optics expects a pupil. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/clear_guess.h"

#include <math.h>

struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first)
{
    bool reverse = system->options.reverse;
    double z = reverse ? first->exit_pupil : first->entrance_pupil;
    double scale = reverse ? first->exit_scale : first->entrance_scale;
    double radius = fabs(scale) * system->stop_radius, edge[2];
    bool far = !(fabs(z) <= 1e9);
    struct clear_guess guess = {.radius = radius};
    if (far) {
        /* telecentric: any far plane will do, and the stop's own size */
        z = isnan(z) ? 0 : copysign(1e9, z);
        radius = isfinite(radius) ? radius : system->stop_radius;
    }
    beam_place(beam, (double[3]){0, 0, z}, guess.centre);
    beam_place(beam, (double[3]){radius, 0, z}, edge);
    guess.radius = hypot(edge[0] - guess.centre[0], edge[1] - guess.centre[1]);
    if (!(guess.radius > 0 && guess.radius < 1e100)) {
        guess.radius = 1;
    }
    for (int i = 0; i < 2; i++) {
        guess.centre[i] = isfinite(guess.centre[i]) ? guess.centre[i] : 0;
    }
    return guess;
}
