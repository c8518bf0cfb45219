/* analysis/rays/distortion_fit.h - models of image processing fitted to exact chief rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_DISTORTION_FIT_H
#define LENSCALC_ANALYSIS_RAYS_DISTORTION_FIT_H

#include "analysis/rays/distortion.h"
#include "analysis/rays/distortion_model.h"
#include "base/arena.h"
#include "base/error.h"
#include "photo/format.h"

#include <stdbool.h>
#include <stddef.h>

/* Chief rays from the axis to the corner of a picture, or as far as there are any. */
struct distortion_profile {
    size_t count;
    double *ideal;  /* height of the projection, for a focal length of 1 */
    double *real;   /* in the image, mm, ascending */
    double *weight; /* the part of the radius that it stands for, mm */
    double focal;   /* what the projection's 1 is on the axis, mm */
    double reached; /* the last `real`, mm */
};

/*
 * Trace the radius of a picture.
 *
 * Given     map     of a lens that is round
 *           radius  half the diagonal of the picture, mm
 * Result    128 fields, evenly spaced. They end where no chief ray reaches the image, where it
 *           comes no farther out, and at the end of the projection; beyond the field that the lens
 *           states where clear apertures stop it, or at once if the lens has none. Then reached <
 *           radius
 *           focal: by the chief rays next to the axis; of a near object its magnification times
 *           the distance to the entrance pupil, from where angles count
 * Errors    ERROR_DOMAIN: a lens that is not round; a near object and an entrance pupil at
 *           infinity; no field at all; an ideal image 8 times as large as the real one
 */
bool distortion_trace(const struct distortion_map *map, double radius, struct arena *arena,
                      struct distortion_profile *profile, struct error *error);

/* One way of a model. */
struct distortion_polynomial {
    double published[MODEL_TERMS], reduced[MODEL_TERMS]; /* in the model's unit */
    double rms, largest;                                 /* what is left of the image heights, mm */
};

struct distortion_fit {
    enum distortion_model model;
    double focal; /* mm, of the ideal image */
    double unit;  /* length of r = 1, mm */
    struct distortion_polynomial ways[DISTORTION_WAYS];
};

/* What is fitted. */
struct distortion_question {
    enum distortion_model model;
    struct sensor sensor; /* checked */
    double focal;         /* of the ideal image, mm; NaN: the one that fits best together with the
                             coefficients of the published form */
};

/*
 * Fit a model to a profile, and its inverse.
 *
 * Formula   least squares of the heights that a way makes, over the radius in the real image; the
 *           inverse is another polynomial of the same kind, fitted alike
 * Source    linear in the coefficients K of distortion_model.h, by base/linear; with some below the
 *           line from linear equations, in turns, to Gauss and Newton's steps
 * Errors    ERROR_DOMAIN: the distortion is too strong for a model that leaves r = 1 in its place
 * Limits    the residual is that of the profile's fields, as it is printed
 */
bool distortion_fit(const struct distortion_profile *profile,
                    const struct distortion_question *question, struct arena *arena,
                    struct distortion_fit *fit, struct error *error);

#endif
