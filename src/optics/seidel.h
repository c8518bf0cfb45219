/* optics/seidel.h - third-order and first-order chromatic aberrations, surface by surface. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_SEIDEL_H
#define LENSCALC_OPTICS_SEIDEL_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"

#include <stdbool.h>
#include <stddef.h>

/* S1 .. S5, then CI and CII. */
enum seidel_term {
    SEIDEL_SPHERICAL,
    SEIDEL_COMA,
    SEIDEL_ASTIGMATISM,
    SEIDEL_PETZVAL,
    SEIDEL_DISTORTION,
    SEIDEL_AXIAL_COLOR,
    SEIDEL_LATERAL_COLOR,
    SEIDEL_TERMS
};

/* What one surface adds to the sums, or the sums, mm. */
struct seidel_part {
    double sum[SEIDEL_TERMS];
    double asphere[SEIDEL_TERMS]; /* of it, what the departure from the sphere at the vertex adds */
};

struct seidel_question {
    const struct lens *lens;
    const struct paraxial_system *system;  /* of it, in one section, at one wavelength */
    const struct pair *blue_n, *red_n;     /* system.index at two others; null: no CI, CII */
    enum lens_section section;             /* that of the system */
    const struct conjugate_object *object; /* of the lens */
    const struct first_order *first;       /* of the system, with its aperture */
    enum field_kind field_kind;            /* an angle, the height of an object; or none */
    double field;                          /* rad, mm */
};

struct seidel {
    struct seidel_part *parts; /* one a surface of the system */
    struct seidel_part total;
    double lagrange;      /* n (y ubar - ybar u) */
    double height, slope; /* of the marginal ray behind the last surface: y in mm, q = n' u' */
    size_t distorting;    /* a thick lens whose distortion is left out; LENS_NONE */
};

/* The marginal and the chief ray at one surface: heights, n u before and after. */
struct seidel_rays {
    struct pair y, v, after;
    struct pair chief_y, chief_v, chief_after;
};

/* The forms that the sums are known by. */
enum seidel_form {
    SEIDEL_WAVES,      /* W040 W131 W222 W220 W311 W020c W111c */
    SEIDEL_TRANSVERSE, /* TSC CC_s TAC TPC DC TAchC TchC; CC_t is 3 CC_s */
};

/*
 * The Seidel sums of the paraxial marginal and chief ray.
 *
 * Given     question  no two coordinates are decentred: the sums are those of the centred lens
 * Result    parts and their sum, mm; NaN what there is no field, no index for; S1 > 0 is
 *           undercorrected. Positive W is a wavefront ahead of its reference sphere
 * Formula   A = n (u + y c), Abar = n (ubar + ybar c), H = n (y ubar - ybar u), D = after - before:
 *           S1 = -A^2 y D(u/n), S2 = -A Abar y D(u/n), S3 = -Abar^2 y D(u/n),
 *           S4 = -H^2 c D(1/n), S5 = -Abar^3 y D(1/n^2) + Abar ybar c D(1/n) (2 y Abar - ybar A),
 *           which is (Abar/A) (S3 + S4) without the division by A;
 *           CI = A y D(dn/n), CII = Abar y D(dn/n) with dn = n blue - n red.
 *           Asphere z = sphere of the vertex curvature c + G r^4 + ...: with the curvature c0 of
 *           the conic and c = c0 + 2 A2, G = ((1+k) c0^3 - c^3)/8 + A4 adds
 *           8 G (n' - n) y^4 (ybar/y)^(0, 1, 2, 3) to S1, S2, S3, S5.
 *           A thick lens images all points without aberration: it adds nothing to S1 .. S5, and
 *           y D(u dn), y D(ubar dn) where the media beside it have dispersion
 * Source    [Welford86], Seidel and chromatic sums; S5 derived here: u/n = A/n^2 - y c/n put into
 *           S3 + S4 with H = y Abar - ybar A, where A divides all that is left. The thick lens:
 *           A D(dn/n) = D(u dn) + y c D(dn), of which the last belongs to the surface's power
 * Errors    ERROR_DOMAIN: no stop, no aperture; an odd asphere with A1 or A3, whose wavefront
 *           rises faster than any Seidel term; a chief ray of an angle that never reaches the stop
 * Limits    in pairs, rounded once: a few ulp of what the decimals of the lens say, also where A
 *           or D(u/n) vanish
 */
bool seidel_compute(const struct seidel_question *question, struct arena *arena,
                    struct seidel *seidel, struct error *error);

/*
 * The two rays before the first surface, as the sums have them.
 *
 * Result    rays    y, v, chief_y, chief_v; the chief ray is NaN where there is no field
 * Errors    ERROR_DOMAIN: no stop, no aperture; a chief ray of an angle that never reaches the stop
 */
bool seidel_object_rays(const struct seidel_question *question, struct seidel_rays *rays,
                        struct error *error);

/*
 * A part of the sums in another form.
 *
 * Given     form     see above
 *           values   receives SEIDEL_TERMS
 *           unit     of waves 1/wavelength, 1/mm; of transverse ones 1/q, where q is seidel.slope;
 *                    of the angles of an afocal system, rad, -1/(n' y), where y is seidel.height
 * Formula   W040 = S1/8, W131 = S2/2, W222 = S3/2, W220 = (S3+S4)/4, W311 = S5/2, W020c = CI/2,
 *           W111c = CII, all times the unit; TSC = S1/2q, CC_s = S2/2q, TAC = S3/2q,
 *           TPC = S4/2q, DC = S5/2q, TAchC = CI/q, TchC = CII/q
 * Source    [Welford86]; [Smith05] for the names of the transverse ones
 */
void seidel_convert(const struct seidel_part *part, enum seidel_form form, double unit,
                    double values[SEIDEL_TERMS]);

#endif
