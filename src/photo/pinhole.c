/* photo/pinhole.c - a camera with a hole in place of a lens. */
/* SPDX-License-Identifier: MIT */
#include "photo/pinhole.h"

#include <math.h>

/* Indexed by enum pinhole_rule. */
static const double rules[] = {3.6, 2, 4, 2.44};

static bool pinhole_check(const struct pinhole_setting *setting, struct error *error)
{
    if (!(setting->f > 0) || isinf(setting->f)) {
        return fail(error, ERROR_DOMAIN,
                    "the film must lie behind the hole: %.6g mm is not above 0 and finite",
                    setting->f);
    }
    if (!(setting->s > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the subject must lie before the hole: %.6g mm is not above 0", setting->s);
    }
    return (setting->wavelength > 0 && setting->wavelength < INFINITY) ||
           fail(error, ERROR_DOMAIN, "a wavelength of %.6g mm is not above 0 and finite",
                setting->wavelength);
}

bool pinhole_best(const struct pinhole_setting *setting, enum pinhole_rule rule, double *d,
                  struct error *error)
{
    if (!pinhole_check(setting, error)) {
        return false;
    }
    const double reduced = setting->f / (1 + setting->f / setting->s);
    *d = sqrt(rules[rule] * setting->wavelength * reduced);
    return (*d > 0 && *d < INFINITY) ||
           fail(error, ERROR_DOMAIN, "the best hole is too small or large for a number");
}

bool pinhole_find(const struct pinhole_setting *setting, enum pinhole_rule rule, double d,
                  struct pinhole *pinhole, struct error *error)
{
    if (!pinhole_check(setting, error)) {
        return false;
    }
    if (!(d > 0) || isinf(d)) {
        return fail(error, ERROR_DOMAIN, "a hole of %.6g mm is not above 0 and finite", d);
    }
    const double f = setting->f, N = f / d;
    const double vergence = rules[rule] * setting->wavelength / (d * d) - 1 / setting->s;
    *pinhole = (struct pinhole){
        .fnumber = N,
        .blur = fmax(d * (1 + f / setting->s), 2.44 * setting->wavelength * N),
        .best_f = vergence > 0 ? 1 / vergence : (double)INFINITY,
    };
    return (N < INFINITY && pinhole->blur < INFINITY) ||
           fail(error, ERROR_DOMAIN, "the hole is too small for a number");
}
