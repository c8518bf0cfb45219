/* analysis/rays/distortion_model.c - polynomials of the radius. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/distortion_model.h"

#include <math.h>

const struct model_facts distortion_models[DISTORTION_MODELS] = {
    [MODEL_BROWN] =
        {.word = {"brown",
                  "Brown-Conrady k1 k2 k3, from the distorted to the ideal image, r in mm"},
         .way = WAY_UNDISTORT,
         .unit = UNIT_MILLIMETRE,
         .projection = RECTILINEAR,
         .terms = 3,
         .names = {"k1", "k2", "k3"},
         .powers = {3, 5, 7}},
    [MODEL_OPENCV] = {.word = {"opencv", "OpenCV's five coefficients, r over the focal length"},
                      .way = WAY_DISTORT,
                      .unit = UNIT_FOCAL,
                      .projection = RECTILINEAR,
                      .terms = 3,
                      .names = {"k1", "k2", "k3"},
                      .powers = {3, 5, 7}},
    [MODEL_RATIONAL] = {.word = {"opencv-rational",
                                 "OpenCV's rational model k1 to k6, r over the focal length"},
                        .way = WAY_DISTORT,
                        .unit = UNIT_FOCAL,
                        .projection = RECTILINEAR,
                        .terms = 6,
                        .below = 3,
                        .names = {"k1", "k2", "k3", "k4", "k5", "k6"},
                        .powers = {3, 5, 7, 2, 4, 6}},
    [MODEL_FISHEYE] = {.word = {"fisheye", "OpenCV's fisheye k1 to k4, of the field angle"},
                       .way = WAY_DISTORT,
                       .unit = UNIT_FOCAL,
                       .projection = EQUIDISTANT,
                       .terms = 4,
                       .names = {"k1", "k2", "k3", "k4"},
                       .powers = {3, 5, 7, 9}},
    [MODEL_POLY3] = {.word = {"poly3", "lensfun's cubic k1, r = 1 at half the shorter side"},
                     .way = WAY_DISTORT,
                     .unit = UNIT_HALF_SIDE,
                     .projection = PROJECTIONS,
                     .terms = 1,
                     .names = {"k1"},
                     .powers = {3},
                     .keeps_unit = true},
    [MODEL_POLY5] = {.word = {"poly5", "lensfun's k1 k2 of the fifth order"},
                     .way = WAY_DISTORT,
                     .unit = UNIT_HALF_SIDE,
                     .projection = PROJECTIONS,
                     .terms = 2,
                     .names = {"k1", "k2"},
                     .powers = {3, 5}},
    [MODEL_PTLENS] = {.word = {"ptlens", "a b c of PTLens, Hugin and lensfun"},
                      .way = WAY_DISTORT,
                      .unit = UNIT_HALF_SIDE,
                      .projection = PROJECTIONS,
                      .terms = 3,
                      .names = {"a", "b", "c"},
                      .powers = {4, 3, 2},
                      .keeps_unit = true},
};

double distortion_power(double x, int power)
{
    double product = 1;
    for (int i = 0; i < power; i++) {
        product *= x;
    }
    return product;
}

double distortion_apply(enum distortion_model model, const double *reduced, double in)
{
    const struct model_facts *facts = &distortion_models[model];
    double out = in, below = 1;
    for (size_t j = 0; j < facts->terms; j++) {
        const double term = reduced[j] * distortion_power(in, facts->powers[j]);
        out += j + facts->below < facts->terms ? term : 0;
        below += j + facts->below < facts->terms ? 0 : term;
    }
    return below > 0 ? out / below : (double)NAN;
}

/* The d of d - 1 + sum K_j d^p_j = 0 that 1 leads to; NaN: to none. */
static double distortion_model_find_scale(const struct model_facts *facts, const double *reduced)
{
    double d = 1;
    for (int step = 0; step < 100; step++) {
        double value = d - 1, slope = 1;
        for (size_t j = 0; j < facts->terms; j++) {
            const int p = facts->powers[j];
            value += reduced[j] * distortion_power(d, p);
            slope += reduced[j] * p * distortion_power(d, p - 1);
        }
        const double next = d - value / slope;
        if (!(slope > 0 && next > 0)) {
            return NAN;
        }
        if (fabs(next - d) <= 4e-16 * d) {
            return next;
        }
        d = next;
    }
    return NAN;
}

bool distortion_publish(enum distortion_model model, const double *reduced, double *published)
{
    const struct model_facts *facts = &distortion_models[model];
    const double d = facts->keeps_unit ? distortion_model_find_scale(facts, reduced) : 1;
    for (size_t j = 0; j < facts->terms; j++) {
        published[j] = reduced[j] * distortion_power(d, facts->keeps_unit ? facts->powers[j] : 0);
    }
    return !isnan(d);
}
