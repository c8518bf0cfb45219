/* analysis/model/third_order.h - rays with their aberrations of the third order. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_MODEL_THIRD_ORDER_H
#define LENSCALC_ANALYSIS_MODEL_THIRD_ORDER_H

#include "analysis/setup/setup.h"
#include "optics/thick_lens.h"

/* A centred lens to the third order. */
struct third_order {
    double matrix[4];     /* of heights and slopes, from the first vertex to the paraxial image */
    double entrance;      /* place of the entrance pupil, from the first vertex, mm */
    double object;        /* before the first vertex, mm; infinite */
    double pupil;         /* radius of the entrance pupil, mm: rho is 1 there */
    double field;         /* slope or height of the object where eta is 1 */
    double aberration[4]; /* S1/2q, S2/2q, S3/2q, (S3 + S4)/2q, mm */
    double distortion;    /* S5/2q, mm */
    double index_image;
    double image, arm; /* the paraxial image from the last vertex, and from the exit pupil, mm */
};

/*
 * Make a lens ready.
 *
 * Given     light  of the setup, at the wavelength that is wanted
 * Formula   the Seidel sums of optics/seidel at a field of 0.1 rad, or of 1 mm of a near object
 * Errors    as seidel_compute; ERROR_DOMAIN: a lens that is not round about its axis, an image,
 *           an entrance or an exit pupil at infinity, a telecentric object space
 */
bool third_order_open(const struct setup *setup, const struct setup_light *light,
                      struct arena *arena, struct third_order *third, struct error *error);

/*
 * A ray from the plane of the first vertex to a plane behind the lens.
 *
 * Given     plane  from the last vertex, mm
 * Result    where it meets the plane, and its slopes
 * Formula   with rho the ray's place in the paraxial entrance pupil over its radius, and eta the
 *           slope of a distant object, the height of a near one, over `field`, as vectors: the
 *           paraxial image point and
 *           (S1 rho^2 rho + S2 (2 (rho.eta) rho + rho^2 eta) + 2 S3 (rho.eta) eta
 *           + (S3 + S4) eta^2 rho + S5 eta^2 eta)/(2 n' u'); then along the line to there from the
 *           ray's place in the exit pupil, which has no aberration
 * Source    [Welford86], transverse ray aberrations by the Seidel sums; the vectors derived here
 * Limits    off by the fifth order of rho and eta
 */
static inline struct slope_ray third_order_map(const struct third_order *third,
                                               struct slope_ray ray, double plane)
{
    const bool is_near = isfinite(third->object);
    const double *m = third->matrix, *a = third->aberration;
    const double hx = is_near ? ray.x - third->object * ray.p : ray.p;
    const double hy = is_near ? ray.y - third->object * ray.q : ray.q;
    const double ex = hx / third->field, ey = hy / third->field;
    const double rx = (ray.x + third->entrance * ray.p) / third->pupil;
    const double ry = (ray.y + third->entrance * ray.q) / third->pupil;
    const double rr = rx * rx + ry * ry, re = rx * ex + ry * ey, ee = ex * ex + ey * ey;
    const double of_rho = a[0] * rr + 2 * a[1] * re + a[3] * ee;
    const double of_eta = a[1] * rr + 2 * a[2] * re + third->distortion * ee;
    const double dx = of_rho * rx + of_eta * ex, dy = of_rho * ry + of_eta * ey;
    struct slope_ray out = {.p = m[2] * ray.x + m[3] * ray.p + dx / third->arm,
                            .q = m[2] * ray.y + m[3] * ray.q + dy / third->arm};
    out.x = m[0] * ray.x + m[1] * ray.p + dx + (plane - third->image) * out.p;
    out.y = m[0] * ray.y + m[1] * ray.q + dy + (plane - third->image) * out.q;
    return out;
}

#endif
