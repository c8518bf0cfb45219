/* design/fit/thick.h - the thick lens that equals a set of rays best. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_FIT_THICK_H
#define LENSCALC_DESIGN_FIT_THICK_H

#include "analysis/model/ray_model.h"
#include "base/arena.h"
#include "base/error.h"
#include "design/fit/thick_sums.h"
#include "design/solver/solver.h"
#include "optics/thick_lens.h"

#include <stdbool.h>
#include <stddef.h>

enum { THICK_GROUPS = 32 };

/* What is to be fitted. */
struct thick_task {
    const struct thick_sums *sums; /* of the rays that came through */
    size_t group_count;            /* 1 .. THICK_GROUPS */
    const double *index_object;    /* of each group */
    const double *index_image;
    bool separate;           /* each group has its own f, H, H'; else all have the same */
    double planes[2];        /* where rays are compared, from the rear reference plane:
                                          the image and the exit pupil, mm */
    double plane_weights[2]; /* usually 1 and 1 */
    double focus_weight;     /* of defocus before image height; 0: what matters is how far off
                                rays are in the image, whatever the reason */
    double object;           /* as in thick_lens */
    size_t distortions;      /* 0 .. THICK_DISTORTIONS */
    struct thick_lens start; /* the paraxial lens */
    struct solver_options options;
};

/* Parameters come group by group: f, H, H', f, H, H' .., then d1, d2, d3. */
struct thick_fit {
    struct thick_lens *lenses; /* one a group; the same where they are not separate */
    size_t parameter_count;
    double *parameters;
    const char **names; /* "f", "H", "H'", "f 2" .. "d1" */
    struct solver_summary summary;
    double rms;        /* distance in the image plane, over all rays, mm */
    double rms_second; /* the same in the second plane */
};

/*
 * Weights where the image matters: focus is settled first, then the image height, and the exit
 * pupil settles what these leave open. Each takes nothing from the one before it.
 */
#define THICK_FOCUS_WEIGHT 100.0
#define THICK_PUPIL_WEIGHT 1e-3

/*
 * Fit a thick lens to rays.
 *
 * Result    fit, in the arena
 * Formula   smallest sum over rays of weight times the squared distance e between the ray and
 *           what thick_lens_map makes of it, in the image plane and, with its own weight, in the
 *           exit pupil: the image alone leaves one of f, H and H' open. In the image e is F (e -
 *           mean e) + mean e, the mean over the rays of one object point and wavelength: the first
 *           is blur, the second the place of the image point. F is focus_weight over the rms slope
 *           of rays against the mean ray of their point: so blur counts as the defocus that makes
 *           it, in mm along the axis, and not less where the lens is stopped down. With F = 1
 *           distortion is traded against focus as soon as blur gets small: at f/1000 a lens of
 *           100 mm became one of 137. Starts at the paraxial lens, which it is in the limit of
 *           small fields at any small aperture; derivatives in closed form.
 *           Standard errors by leaving out one field at a time (jackknife_covariance), or one ray
 *           where there are no fields: rays of one field err alike
 * Errors    ERROR_DOMAIN: no rays, weights that are all 0, a start without focal length, planes
 *           that are not finite or that are one, object in H; with a focus_weight, one ray a field;
 *           parameters that the rays leave open (named, with what would fix them)
 */
bool thick_fit(const struct thick_task *task, struct arena *arena, struct thick_fit *fit,
               struct error *error);

/*
 * Residuals whose squares add up to those of all rays, and their derivatives by the parameters of
 * thick_fit.
 *
 * Given     context  a struct thick_task
 * Result    of each bundle that has rays: e of their mean in x and y
 *           in the first plane, then in the second, with the weights of bundle and plane; of two
 *           rays and more what deviates from it, THICK_COLUMNS in each plane
 */
solver_function thick_residuals;

/*
 * Distance between rays and what models make of them, in the plane of these.
 *
 * Given     models  one a group, of thick lenses
 *           dx, dy  receive the model's ray less the given one, mm
 */
void thick_errors(const struct thick_rays *rays, const struct ray_model *models, double *dx,
                  double *dy);

/* How far a model is off. */
struct thick_score {
    double weight;    /* of all rays */
    double rms[2];    /* in its plane and in another, mm */
    double largest;   /* in its own, mm */
    double direction; /* angle between the rays behind the lens, rms, rad */
};

/*
 * Compare models with rays in two planes, and by direction.
 *
 * Given     models  one a group, of thick lenses and holes, all with one plane
 *           plane   another, from the rear reference plane, mm
 *           score   of the rays so far, of none if all is 0; receives that of these too
 */
void thick_score_add(const struct thick_rays *rays, const struct ray_model *models, double plane,
                     struct thick_score *score);

/* A pupil: the picture of the stop from one side. */
struct thick_pupil {
    double place, radius; /* from the reference plane on that side; signed as the stop's picture */
    double spherical_aberration; /* a of radius (1 + a s), s the squared slope of the ray */
    double place_error, radius_error,
        spherical_aberration_error; /* standard errors, of independent rays */
    double rms;                     /* distance of the rays from where they should cross, mm */
};

/* Rays whose place in the stop is known, added up and forgotten. */
struct thick_pupil_sums {
    double r[16]; /* of place, radius, radius times a, and what they are to make */
    double weight;
    size_t rows;
};

/*
 * Given     exit  behind the lens; else before it
 */
void thick_pupil_add(const struct thick_rays *rays, bool exit, struct thick_pupil_sums *sums);

/*
 * Fit a pupil to such rays.
 *
 * Given     exit    the side, for the error
 *           spherical_aberration  whether the pupil may have it; else a is 0
 * Formula   x + place p = radius stop_x (1 + a s), the same for y: linear in place, radius and
 *           radius times a
 * Errors    ERROR_DOMAIN: rays that leave place or radius open
 */
bool thick_fit_pupil(const struct thick_pupil_sums *sums, bool exit, bool spherical_aberration,
                     struct arena *arena, struct thick_pupil *pupil, struct error *error);

#endif
