/* scene/sky.c - CIE's standard general sky. */
/* SPDX-License-Identifier: MIT */
#include "scene/sky.h"

#include "base/constants.h"

struct sky_type {
    double a, b, c, d, e;
};

/* In the order of the enumeration; without c the sun is not seen. */
static const struct sky_type types[] = {
    {.a = 0, .b = -1}, {.a = 4, .b = -0.7}, {-1, -0.32, 10, -3, 0.45}};

static double sky_gradation(const struct sky_type *type, double cosine)
{
    return 1 + type->a * exp(type->b / cosine);
}

/* Scattering by the angle from the sun, whose cosine is given. */
static double sky_indicatrix(const struct sky_type *type, double cosine)
{
    const double angle = acos(fmax(-1, fmin(cosine, 1)));
    return 1 + type->c * (exp(type->d * angle) - exp(type->d * (PI / 2))) +
           type->e * cosine * cosine;
}

double sky_share(enum scene_sky sky, struct vector sun, struct vector direction)
{
    const struct sky_type *type = &types[sky];
    if (!(direction.y > 0)) {
        return 0;
    }
    const double share = sky_gradation(type, direction.y) / sky_gradation(type, 1);
    return type->c == 0 ? share
                        : share * sky_indicatrix(type, vector_dot(sun, direction)) /
                              sky_indicatrix(type, sun.y);
}
