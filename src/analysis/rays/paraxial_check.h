/* analysis/rays/paraxial_check.h - how far paraxial optics may be trusted: exact rays beside it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_PARAXIAL_CHECK_H
#define LENSCALC_ANALYSIS_RAYS_PARAXIAL_CHECK_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "trace/aim/aim.h"
#include "trace/aim/beam.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/* What is compared: by height in the aperture, then by field. */
enum check_quantity {
    CHECK_EFL,                   /* -h/(n' sin U'), the sine condition */
    CHECK_BFL,                   /* where the ray crosses the axis, from the last vertex */
    CHECK_REAR_PRINCIPAL,        /* where entering and leaving ray meet, extended */
    CHECK_FFL,                   /* the same of parallel light from behind */
    CHECK_FRONT_PRINCIPAL,       /* */
    CHECK_IMAGE,                 /* where the ray of a near object crosses the axis */
    CHECK_MAGNIFICATION,         /* n sin U/(n' sin U') */
    CHECK_EXIT_ANGLE,            /* afocal: slope angle of a ray that came in parallel, rad */
    CHECK_FNUMBER,               /* 1/(2 n' |sin U'|) */
    CHECK_TRANSVERSE,            /* height of the axial ray on the image plane */
    CHECK_IMAGE_HEIGHT,          /* of the chief ray on the image plane */
    CHECK_ANGULAR_MAGNIFICATION, /* afocal: tan t'/tan t of the chief ray */
    CHECK_ENTRANCE_PUPIL,        /* where the chief ray crosses the axis before the lens */
    CHECK_EXIT_PUPIL,            /* and behind it */
    CHECK_QUANTITIES
};

/* Does it depend on the field, else on the aperture? */
bool paraxial_check_is_of_field(enum check_quantity quantity);

/* Chief rays that were looked for: the same fractions are asked for again and again. */
struct check_chief {
    double fraction; /* of the field; 0 = not used */
    bool has_beam, found;
    struct beam beam;
    struct ray ray;
};
enum { CHECK_CHIEFS = 256 };

/* A lens at one wavelength. */
struct check_problem {
    const struct system *forward, *backward; /* without clip */
    const struct first_order *first;         /* with aperture */
    struct conjugate_object object;
    enum lens_section section;
    double plane;             /* the image plane, from the last vertex, mm; NaN if there is none */
    struct field_point field; /* the largest, on the axis of the section; kind FIELD_NONE: none */
    struct check_chief *chiefs; /* CHECK_CHIEFS of them, at first all 0; null: nothing is kept */
};

/* Does it make sense for this lens: finite or infinite object, afocal, with stop and field? */
bool paraxial_check_applies(const struct check_problem *problem, enum check_quantity quantity);

struct check_value {
    double paraxial, exact; /* NaN: the ray is lost, or there is none */
    double scale;   /* what a relative difference is taken of: the value itself; of places the focal
                       length (afocal: length of the lens); NaN where nothing is apt */
    double fnumber; /* of the height: |rear focal length|/(2 h), near objects: working */
    double height;  /* h, in the paraxial entrance pupil; NaN: field */
    double angle;   /* of the chief ray before the lens, rad, of a lost one too; NaN: aperture, or a
                       field that no beam has */
    enum ray_status status; /* of the ray, and where it was lost */
    size_t surface;
};

/*
 * One quantity by one exact ray.
 *
 * Given     fraction  of the aperture's radius or of the largest field (of the angle or height),
 *                     above 0
 * Formula   ray from the axial object point through the height h of the paraxial entrance pupil;
 *           chief ray through the centre of the stop (aim_open). Apertures don't clip
 * Source    [Welford86] ch. 4 (finite rays) and ch. 6 (sine condition)
 * Errors    none: what cannot be traced is NaN with its status
 */
struct check_value paraxial_check_at(const struct check_problem *problem,
                                     enum check_quantity quantity, double fraction,
                                     struct arena *arena);

/* How the difference shrinks. */
struct check_order {
    double order;    /* of the difference as the aperture or field goes to 0; NaN: not found */
    double rounding; /* the fraction from which on it is rounding; 0: none in the series */
    bool is_equal;   /* the difference is rounding everywhere */
};

/*
 * Order of a difference.
 *
 * Formula   differences d (of the f-number relative ones) at fractions 2^-k, k = 0 .. 16; of all
 *           four consecutive ones whose three slopes log2(d_k/d_(k+1)) agree within 0.1 those of
 *           the smallest fraction: the slope of the straight line through log d against log h
 * Limits    2 for places and ratios, 3 for heights; more where a lens is corrected
 */
struct check_order paraxial_check_order(const struct check_problem *problem,
                                        enum check_quantity quantity, struct arena *arena);

/*
 * Up to which fraction |exact - paraxial| <= tolerance * scale, from 0 on without a gap.
 *
 * Result    1: everywhere; 0: nowhere; NaN: the quantity has no scale
 */
double paraxial_check_trusted(const struct check_problem *problem, enum check_quantity quantity,
                              double tolerance, struct arena *arena);

#endif
