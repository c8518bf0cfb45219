/* photo/characteristic.c - the curve of a negative from its speed. */
/* SPDX-License-Identifier: MIT */
#include "photo/characteristic.h"

#include "base/constants.h"
#include "photo/sensitometry.h"

#include <math.h>

/* [IsoFilm93]: H = 0.8/S at the speed point; densities above the base there and farther on. */
#define SPEED_CONSTANT 0.8
#define SPEED_DENSITY  0.10
#define SPEED_SPAN     1.30
#define SPEED_RISE     0.80
/* Of what a meter takes for grey. */
#define GREY 0.18

struct negative negative_plain(double speed)
{
    return (struct negative){.speed = speed, .base = 0.25, .most = 2.5, .toe = 0.2};
}

/* ln(1 + e^u), for any u. */
static double soft(double u)
{
    return fmax(u, 0) + log1p(exp(-fabs(u)));
}

static double density_at(const struct characteristic *curve, double x)
{
    const double w = curve->negative.toe, whole = (curve->shoulder_at - curve->toe_at) / w;
    const double toe = (x - curve->toe_at) / w, shoulder = (x - curve->shoulder_at) / w;
    /* beyond the shoulder two large numbers would be taken from each other */
    const double rise = shoulder <= 0 ? soft(toe) - soft(shoulder)
                                      : whole - (log1p(exp(-shoulder)) - log1p(exp(-toe)));
    return curve->negative.base + curve->gradient * w * rise;
}

/* Shift the curve of this gradient so that it goes through the speed point. */
static void characteristic_place(struct characteristic *curve, double gradient)
{
    const struct negative *negative = &curve->negative;
    const double speed_point = log10(SPEED_CONSTANT / negative->speed);
    double low = speed_point - 10, high = speed_point + 10;
    curve->gradient = gradient;
    for (int i = 0; i < 80; i++) {
        curve->toe_at = (low + high) / 2;
        curve->shoulder_at = curve->toe_at + (negative->most - negative->base) / gradient;
        const bool dense = density_at(curve, speed_point) > negative->base + SPEED_DENSITY;
        if (dense) {
            low = curve->toe_at;
        } else {
            high = curve->toe_at;
        }
    }
}

bool characteristic_open(const struct negative *negative, struct characteristic *curve,
                         struct error *error)
{
    if (!(negative->speed > 0 && negative->speed < 1e9)) {
        return fail(error, ERROR_DOMAIN, "a film speed of %.6g is not above 0 and below 1e9",
                    negative->speed);
    }
    if (!(negative->base >= 0 && negative->base <= 1 && negative->most >= negative->base + 1 &&
          negative->most <= 6)) {
        return fail(error, ERROR_DOMAIN,
                    "densities of a film from %.6g to %.6g: the base is 0 to 1, the largest 1 "
                    "more at least, to 6",
                    negative->base, negative->most);
    }
    if (!(negative->toe >= 0.05 && negative->toe <= 0.4)) {
        return fail(error, ERROR_DOMAIN, "a toe of %.6g of a film is not from 0.05 to 0.4",
                    negative->toe);
    }
    *curve = (struct characteristic){.negative = *negative};
    const double second = log10(SPEED_CONSTANT / negative->speed) + SPEED_SPAN;
    double low = 0.3, high = 10;
    for (int i = 0; i < 80; i++) {
        characteristic_place(curve, (low + high) / 2);
        const bool steep = density_at(curve, second) > negative->base + SPEED_DENSITY + SPEED_RISE;
        if (steep) {
            high = curve->gradient;
        } else {
            low = curve->gradient;
        }
    }
    const double missed = density_at(curve, second) - (negative->base + SPEED_DENSITY + SPEED_RISE);
    return fabs(missed) < 1e-9 ||
           fail(error, ERROR_DOMAIN,
                "a film from density %.6g to %.6g with a toe of %.6g has no curve of the contrast "
                "that its speed means",
                negative->base, negative->most, negative->toe);
}

double characteristic_speed_point(const struct characteristic *curve)
{
    return SPEED_CONSTANT / curve->negative.speed;
}

double characteristic_density(const struct characteristic *curve, double H)
{
    return H > 0 ? density_at(curve, log10(H)) : curve->negative.base;
}

double characteristic_print(const struct characteristic *curve, double density)
{
    const double grey = characteristic_density(curve, recommended_exposure(curve->negative.speed));
    return GREY * pow(10, (density - grey) / curve->gradient);
}

double characteristic_grain(const struct characteristic *curve, double rms, double area,
                            double density)
{
    return rms / 1000 * sqrt(PI * 0.024 * 0.024 / area) *
           sqrt(fmax(0, density - curve->negative.base));
}
