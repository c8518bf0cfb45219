/* analysis/rays/illumination.h - how much light of a uniform scene arrives in a point of the image. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_ILLUMINATION_H
#define LENSCALC_ANALYSIS_RAYS_ILLUMINATION_H

#include "base/arena.h"
#include "optics/first_order.h"
#include "trace/aim/beam.h"
#include "trace/pupil/pupil_islands.h"
#include "trace/system.h"

/* A bundle, and the lens that lets some of it pass. */
struct illumination_question {
    const struct system *clipped, *open; /* compiled with clip, and without; the same way */
    const struct beam *beam;
    const struct first_order *first;
    const double *inside; /* a ray near the middle, in coordinates of the beam; null: paraxially */
    double error;         /* relative: when it is good enough */
    struct pupil_islands
        *islands; /* receives what passes beside the bundle; null: it is not asked */
    /* Share of the light of a ray of `open` that arrives; null: all of it. Film points only. */
    double (*pass)(const struct system *open, const struct ray *start, struct arena *arena);
};

struct illumination {
    double value; /* 0: nothing arrives */
    double error; /* of it */
    bool is_met;  /* that error is what was asked for */
};

/*
 * Irradiance of a point of the film per radiance of a scene that is as bright everywhere.
 *
 * Given     question  systems compiled with `reverse`, the beam of a point of the film
 * Result    E/L, sr; without loss in glass
 * Formula   E/L = (n'/n)^2 integral of cos(theta) dw over all rays from that point that pass
 *           every aperture, theta from the normal of the film; in the plane of the beam
 *           dw = d/rho^3 dA, by analysis/pupil/quadrature.h. Rays are doubled until the last two
 *           values
 *           differ by less than `error`; the first of the two is given, and as its error twice that
 *           difference, more where it fell by chance or hardly (what a geometric series
 *           leaves), 5e-14 at least
 * Source    [Welford86] (illumination in the image); derived here: dw = d/rho^3 dA. Closed forms
 *           of a disc and an independent program's values pin it
 * Limits    as analysis/pupil/quadrature.h
 */
struct illumination illumination_of_film(const struct illumination_question *question,
                                         struct arena *arena);

/*
 * The same by the rays of one point of the object: the area that they fill in direction cosines
 * behind the lens.
 *
 * Given     question  systems that go forward, the beam of the field point
 * Result    what the point would give its image if all these rays met there: where the image is in
 *           focus that is illumination_of_film; programs that trace one field at a time print it
 * Formula   (n'/n)^2 integral of |d(L, M)/d(a, b)| da db, exact derivatives of rays
 *           (trace/tangent.h); convergence as above
 * Limits    as analysis/pupil/quadrature.h; where the bundle folds behind the lens every fold
 * counts
 */
struct illumination illumination_of_field(const struct illumination_question *question,
                                          struct arena *arena);

/*
 * The lens without all apertures but its stop, which nothing obstructs.
 *
 * Result    a copy in the arena: diameters and shapes of the other surfaces are gone, and what
 *           blocks light on the stop
 */
const struct lens *illumination_stop_only(const struct lens *lens, struct arena *arena);

#endif
