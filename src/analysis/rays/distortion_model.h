/* analysis/rays/distortion_model.h - polynomials of the radius that photographs are undistorted by. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_DISTORTION_MODEL_H
#define LENSCALC_ANALYSIS_RAYS_DISTORTION_MODEL_H

#include "base/text.h"
#include "photo/fov.h"

#include <stdbool.h>
#include <stddef.h>

enum distortion_model {
    MODEL_BROWN,
    MODEL_OPENCV,
    MODEL_RATIONAL,
    MODEL_FISHEYE,
    MODEL_POLY3,
    MODEL_POLY5,
    MODEL_PTLENS,
    DISTORTION_MODELS
};

enum { MODEL_TERMS = 6 };

/* Which way a polynomial goes: from the ideal image to the real one, or back. */
enum distortion_way { WAY_DISTORT, WAY_UNDISTORT, DISTORTION_WAYS };

/* Which length is r = 1. */
enum model_unit { UNIT_MILLIMETRE, UNIT_FOCAL, UNIT_HALF_SIDE };

/*
 * A model: out = (in + sum K_j in^p_j)/(1 + sum L_j in^q_j) in its own unit, along the radius;
 * tangential terms of a centred lens are 0.
 *
 * Formula   brown    r_u = r_d (1 + k1 r_d^2 + k2 r_d^4 + k3 r_d^6), r in mm
 *           opencv   r_d = r_u (1 + k1 r_u^2 + k2 r_u^4 + k3 r_u^6), r over the focal length: the
 *                    five coefficients k1 k2 p1 p2 k3 with p1 = p2 = 0
 *           opencv-rational  the same over 1 + k4 r_u^2 + k5 r_u^4 + k6 r_u^6
 *           fisheye  t_d = t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8), r_d = f t_d, t the angle
 *           poly3    r_d = r_u (1 - k1 + k1 r_u^2)
 *           poly5    r_d = r_u (1 + k1 r_u^2 + k2 r_u^4)
 *           ptlens   r_d = r_u (a r_u^3 + b r_u^2 + c r_u + d), d = 1 - a - b - c
 *           of the last three r = 1 is half the shorter side of the picture; poly3 and ptlens
 *           leave r_u = 1 where it is, so their r_u is the ideal height over d (of poly3 1 - k1):
 *           K = a/d^4, b/d^3, c/d^2, and k1/(1 - k1)^3
 * Source    [Brown71]; [OpenCV]; [Lensfun], whose mod-coord.cpp has the d
 */
struct model_facts {
    struct word word;
    enum distortion_way way; /* of the published form; its inverse is fitted alike */
    enum model_unit unit;
    enum projection projection; /* of the ideal image; PROJECTIONS: any */
    size_t terms, below;        /* below: how many of the terms, the last, stand below the line */
    const char *names[MODEL_TERMS];
    int powers[MODEL_TERMS];
    bool keeps_unit; /* r = 1 stays where it is */
};

extern const struct model_facts distortion_models[DISTORTION_MODELS];

/*
 * From K to the coefficients as they are published.
 *
 * Given     reduced, published  `terms` numbers
 * Formula   ptlens and poly3: d - 1 + sum K_j d^p_j = 0, the root nearest below or above 1 by
 *           Newton's method from 1
 * Result    false: there is no such root, the distortion is too strong for the model
 */
bool distortion_publish(enum distortion_model model, const double *reduced, double *published);

/* out = (in + sum K_j in^p_j)/(1 + sum L_j in^q_j); NaN: beyond a pole */
double distortion_apply(enum distortion_model model, const double *reduced, double in);

/* A whole power of 0 and more: a product. */
double distortion_power(double x, int power);

#endif
