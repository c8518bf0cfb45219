/* optics/first_order.h - cardinal points, pupils and brightness of a lens, paraxially. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_FIRST_ORDER_H
#define LENSCALC_OPTICS_FIRST_ORDER_H

#include "optics/lens.h"
#include "optics/paraxial.h"

#include <stdbool.h>

/*
 * First-order data of a system. Lengths in mm; places are on the axis, + to the right, from the
 * first vertex (front) or the last (rear). In an afocal system the power is 0, focal lengths and
 * the places that follow from them are infinite (unsigned). NaN = absent: no stop, no aperture.
 */
struct first_order {
    bool is_telecentric; /* as the object says it is */
    bool is_afocal;
    double power;                           /* 1/mm */
    double efl;                             /* 1/power, in any media */
    double front_focal, rear_focal;         /* H to F: -n/power; H' to F': n'/power */
    double ffl, bfl;                        /* F, F' */
    double front_principal, rear_principal; /* H, H' */
    double front_nodal, rear_nodal;         /* N, N' */
    double entrance_pupil, exit_pupil;      /* places */
    double entrance_scale, exit_scale;      /* pupil radius over stop radius, signed */
    double pupil_magnification;             /* exit over entrance pupil, signed */
    double image;                           /* paraxial image, from the last vertex */
    double magnification;                   /* n u/(n' u'); 0 for an object at infinity */
    double angular_magnification;           /* u'/u of an afocal system, else NaN */
    double petzval_sum, petzval_radius;     /* 1/mm; -1/(n' sum) */
    double index_object, index_image;       /* signed */
    double length;                          /* first to last vertex */
    struct paraxial_matrix matrix;
    /* with the aperture and the field, by first_order_aperture */
    double stop_radius;
    double entrance_diameter, exit_diameter;
    double fnumber;                /* |rear focal length| / entrance pupil diameter */
    double working_fnumber;        /* 1/(2 n' |u'|) */
    double na_image;               /* n' sin(atan u') */
    double marginal_y, marginal_v; /* marginal ray before the first vertex */
    double chief_y, chief_v;       /* chief ray there */
    double lagrange;               /* n (y ubar - ybar u) */
};

/* Where the object is: its distance to the left of the first vertex, or infinitely far. */
struct conjugate_object {
    bool is_infinite;
    struct pair distance;
    bool is_telecentric; /* the entrance pupil is infinitely far away, whatever the stop says */
    bool is_afocal;      /* the image too: it is given by angles */
};

/*
 * First-order data without aperture and field.
 *
 * Given     system  and its trace
 *           object  the object point on the axis
 * Formula   [a b; c d] the whole, [a1 b1; ..] the part before the stop: power = -c,
 *           F = n d/c, F' = -n' a/c, H = n (d-1)/c, H' = n' (1-a)/c, N = (n d - n')/c,
 *           N' = (n - n' a)/c, entrance pupil n b1/a1, of radius 1/a1; with [a2 b2; c2 d2] the
 *           part from the stop on: exit pupil -n' b2/d2 of radius 1/d2;
 *           image -n' (a L/n + b)/(c L/n + d), magnification 1/(c L/n + d), angular n d/n' if c = 0
 * Source    [Smith05]
 *           telecentric object space: entrance pupil at infinity, exit pupil at F'; afocal image
 *           space: the image at infinity; a power below 1e-3 of the strongest surface's, which
 *           such a telescope may have left, is none
 * Limits    every figure is correct to about 1 ulp of what the decimals of the lens say
 */
void first_order_compute(const struct paraxial_system *system, const struct paraxial_trace *trace,
                         const struct conjugate_object *object, struct first_order *first_order);

/* What limits the beam. */
struct aperture_setting {
    enum aperture_kind kind;
    double value; /* f-number, diameter in mm or numerical aperture; of a stop its diameter */
};

/*
 * Add pupil diameters, f-numbers and the Lagrange invariant.
 *
 * Given     aperture   fixes the beam; FNUMBER is |rear focal length| / entrance pupil diameter
 *           field_kind, field   angle in rad, object height or paraxial image height in mm;
 *                      a real image height counts as that of the paraxial image;
 *                      FIELD_NONE or NaN: no field
 *           of a telecentric object space the marginal ray has the slope of the numerical aperture,
 *           the stop no radius
 * Errors    ERROR_DOMAIN: another aperture than a numerical one of a telecentric object space, an
 *           f-number of an afocal system, a numerical aperture of an infinitely
 *           distant object or of n or more, an aperture at a stop that is not there
 */
bool first_order_aperture(struct first_order *first_order, const struct conjugate_object *object,
                          const struct aperture_setting *aperture, enum field_kind field_kind,
                          double field, struct error *error);

/* The same rays at another wavelength: a stop of this radius. NaN: keep pupils absent. */
void first_order_use_stop(struct first_order *first_order, const struct conjugate_object *object,
                          double stop_radius, enum field_kind field_kind, double field);

/*
 * The lens in one position, at one wavelength: compile, trace, compute.
 *
 * Errors    as paraxial_compile
 */
bool first_order_of_lens(const struct lens *lens, double wavelength, enum lens_section section,
                         struct arena *arena, struct first_order *first_order, struct error *error);

/* What the lens says of its object and of its aperture. */
struct conjugate_object lens_object(const struct lens *lens);
struct aperture_setting lens_aperture(const struct lens *lens);

/*
 * Do focal length, back focus and f-number agree with what the source states?
 *
 * Given     lens      as read; position  0 .. ; efl within 4 %, back focus and f-number within
 *                     10 % pass
 * Result    a warning in the arena, null if all is well or nothing is stated
 */
const char *lens_stated_warning(const struct lens *lens, size_t position,
                                const struct first_order *first_order, struct arena *arena);

/*
 * What of a lens its first-order data leave out.
 *
 * Result    text in the arena or a constant, null if they leave out nothing: parts
 *           decentred, tilted or behind a coordinate break count as centred, and the best focus,
 *           which is that of exact rays, as the paraxial one
 */
const char *first_order_warning(const struct lens *lens, struct arena *arena);

#endif
