/* photo/dof.h - geometric depth of field of a thin lens with a pupil magnification. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DOF_H
#define LENSCALC_PHOTO_DOF_H

#include <stdbool.h>

#include "base/error.h"
#include "base/text.h"

/* Which formulas answer: the exact ones, or the short cuts that other programs print. */
enum dof_model { DOF_EXACT, DOF_NO_F, DOF_POPULAR, DOF_CLOSE_UP, DOF_MODELS };

/* The words of the command line for them, indexed by enum dof_model. */
extern const struct word dof_models[DOF_MODELS + 1];

/* One photographic situation; infinity is allowed for `s` only. */
struct dof_setting {
    double f; /* focal length, mm, > 0 */
    double N; /* f-number, > 0 */
    double c; /* circle of confusion, diameter, mm, >= 0 */
    double s; /* subject distance from the front principal plane, mm, > f; may be inf */
    double P; /* pupil magnification, exit/entrance diameter, > 0 */
};

/* What the eye wants to know about it; distances from the front principal plane, lengths in mm. */
struct dof {
    double hyperfocal;            /* inf for c = 0 */
    double near, far;             /* far is inf when infinity is sharp */
    double front, behind;         /* s - near and far - s, computed without that subtraction */
    double total;                 /* front + behind */
    double magnification;         /* m, positive, 0 at infinity */
    double depth_of_focus;        /* total, image side */
    double blur_at_infinity;      /* disc of a point at infinity on the sensor, diameter */
    double image;                 /* image distance of s, from the rear principal plane */
    double image_near, image_far; /* the same of near and far: image_near > image > image_far;
                                     image_near is inf when near has no real image */
    double near_vergence;         /* 1/near, 1/mm */
    double far_vergence;          /* 1/far, 1/mm; 0 for infinity */
    double working_fnumber;       /* N (1 + m/P) */
    double near_condition;        /* relative change of near per relative change of the inputs: */
    double far_condition;         /* sum of |d ln x/d ln input| over f, N, c, s; inf where x is */
};

/*
 * Is this a situation that can be photographed?
 *
 * Errors    f, N or P not above 0 or not finite; c below 0 or not finite; s <= f (no real image);
 *           a number beyond the range of photo/given.h
 */
bool dof_check(const struct dof_setting *setting, struct error *error);

/*
 * Depth of field, depth of focus and magnification of a lens focused at s.
 *
 * Given     setting  f, N, c, s, P as in struct dof_setting; s may be inf
 *           model    DOF_EXACT, or a short cut (see Limits)
 * Result    dof      every member; on error it is not to be used
 * Formula   m = f/(s - f), e = N c/f, eps = e/m = N c (s - f)/f^2, q = f(1 - 1/P)
 *           X = s - q = f(1/m + 1/P)          entrance pupil to subject
 *           front = X eps/(1 + eps)           behind = X eps/(1 - eps), inf from eps = 1 on
 *           near = s - front = (s + q eps)/(1 + eps) = (f(1 + m) + q e)/(m + e)
 *           far = s + behind                  H = f^2/(N c) + f
 *           The first form of near is used below H and the second from there on: neither subtracts
 *           for P >= 1, none is singular for s = inf. P = 1: near is H/2 at s = H, H - f at inf.
 *           image side, Z' = f(m + P) from the exit pupil: Z'/(1 - e/P) and Z'/(1 + e/P) are the
 *           conjugates of near and far, hence 1/Z'n + 1/Z'f = 2/Z', and from the rear principal
 *           plane image = f(1 + m), image_near = f(1 + (m + e)/(1 - e/P)),
 *           image_far = f(1 + (m - e)/(1 + e/P)), f when far is inf.
 *           depth of focus 2 N c (1 + m/P), working f-number N(1 + m/P)
 *           blur at infinity f m/N for every P: the entrance pupil f/N, seen in the plane s, is
 *           imaged with m
 *           conditions, with g = 1 +- eps, x g = s +- q eps (+ near, - far):
 *           C = -+X eps/(g x g), S = s(1 -+ e/P)/(g x g), |1 - S - C| + |S| + 2|C|
 *           (x is homogeneous of degree 1 in f, s, c). P = 1: near (4 eps + e + |1 - e|)/(1 + eps),
 *           far (1 + 2 e + 4 eps)/(1 - eps)
 * Source    Derived here: a point is blurred in the plane s by the entrance pupil f/N, similar
 *           triangles with apex in the limit; imaged with m it must be c. Pinned by the exact
 *           rationals of tests/truth/dof.tsv
 * Errors    as dof_check; a result beyond the range of double; DOF_CLOSE_UP from eps = 1 on, where
 *           it puts the near limit behind the lens
 * Limits    Geometric: no diffraction, no aberrations, symmetric pupils of a thin lens.
 *           For P < 1 and e of the order of P, near may be 0 or negative: a plane inside the lens.
 *           The condition near H grows as 1/|1 - s/H|: digits beyond it mean nothing.
 *           The short cuts take P = 1 (wrong by x0.75 to x1.5 at 1:1):
 *           DOF_NO_F      H = f^2/(N c), low by exactly f (0.17 % at 50 mm f/2.8, 5.7 % at 8 mm
 *                         f/16); near, far = H s/(H +- (s - f)) are exact for P = 1
 *           DOF_POPULAR   H = f^2/(N c), near, far = H s/(H +- s): the depth is too large by 1 + m
 *                         (x2 at 1:1, x6 at 5:1), far is inf too early by f
 *           DOF_CLOSE_UP  total = 2 N c (1 + m)/m^2, half on each side: too small by eps^2 (11 % at
 *                         eps = 1/3), never infinite
 *           Images, vergences and blur belong to the near and far of the model; the conditions stay
 *           those of the exact form.
 */
bool dof_compute(const struct dof_setting *setting, enum dof_model model, struct dof *dof,
                 struct error *error);

/*
 * Hyperfocal distance from the front principal plane: focused there, infinity is just sharp.
 *
 * Given     f, N, c  mm, -, mm; f > 0, N > 0, c >= 0 (not checked)
 * Result    mm; inf for c = 0
 * Formula   H = f^2/(N c) + f, exact for every P
 */
double dof_hyperfocal(double f, double N, double c);

/*
 * Near limit when focused at the hyperfocal distance.
 *
 * Given     f, N, c, P  as above, P > 0 (not checked)
 * Result    mm; H/2 for P = 1; inf for c = 0
 * Formula   f(1 - 1/P)/2 + H/2, since eps = 1
 */
double dof_near_at_hyperfocal(double f, double N, double c, double P);

/*
 * The hyperfocal distance that has a wanted near limit when the lens is focused there.
 *
 * Given     f, P   focal length, mm, > 0, or NaN: unknown; pupil magnification, > 0
 *           Nc     f-number times circle of confusion, mm, > 0; used only where f is unknown
 *           near   wanted limit, mm, > 0
 * Result    mm; 2 near for P = 1
 * Formula   H = 2 near - f(1 - 1/P); for unknown f that of f^2/(N c) + f(2 - 1/P) = 2 near,
 *           f = 4 near/(b + sqrt(b^2 + 8 near/(N c))), b = 2 - 1/P
 * Source    dof_near_at_hyperfocal and dof_hyperfocal, solved for H here
 */
double dof_hyperfocal_of_near(double f, double P, double Nc, double near);

/*
 * Blur disc of a point that is not in focus.
 *
 * Given     setting  checked; its c is not used
 *           x        the point from the front principal plane, mm; may be inf
 *           blur     receives the diameter of its disc on the sensor, mm; 0 for x = s
 * Formula   b = (f/N) m |x - s|/(x - q), q = f (1 - 1/P), f m/N for x = inf
 * Source    as dof_compute: the entrance pupil f/N, seen from the point in the plane s, imaged with
 *           m; near and far limit are where b = c
 * Errors    a point that lies behind the entrance pupil; a disc beyond the range of double
 * Limits    Geometric; a point behind the lens's own near limit is not looked for
 */
bool dof_blur_at(const struct dof_setting *setting, double x, double *blur, struct error *error);

/*
 * Reciprocal limits of the same focus at another f-number, beyond infinity too.
 *
 * Given     setting  checked; its N is not used
 *           N        f-number, > 0
 * Result    near, far  1/distance from the front principal plane, 1/mm; far is 0 or negative where
 *                      infinity lies inside the depth of field
 * Formula   (m +- N c/f)/(f(1 + m/P) + f(1 - 1/P)(m +- N c/f))
 * Source    Derived here: 1/near and 1/far of dof_compute
 */
void dof_vergences(const struct dof_setting *setting, double N, double *near, double *far);

#endif
