/* optics/paraxial_dual.h - first-order data and Seidel sums with their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_PARAXIAL_DUAL_H
#define LENSCALC_OPTICS_PARAXIAL_DUAL_H

#include "base/arena.h"
#include "base/dual.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* The numbers of a surface that paraxial rays and Seidel sums depend on. */
struct dual_surface {
    struct dual curvature;      /* of the conic, 1/mm; 0 in a section that is not curved */
    struct dual conic;          /* k */
    struct dual second, fourth; /* A2, 1/mm; A4, 1/mm^3 */
    struct dual thickness;      /* to the next vertex, mm; behind the last the image's distance */
    struct dual hiatus;         /* of a thick lens, mm */
    struct dual power;          /* of a thick lens, 1/mm */
    bool is_thick;
};

/* A lens at one wavelength, with a change of it along which all that follows is derived. */
struct paraxial_dual {
    const struct lens *lens;
    enum lens_section section;
    size_t count, stop;            /* surfaces; LENS_NONE = no stop */
    struct dual_surface *surfaces; /* count */
    struct dual *index;            /* count + 1, signed: negative after an odd number of mirrors */
};

/* Room for a lens, in one position, with its stop. */
struct paraxial_dual paraxial_dual_new(const struct lens *lens, enum lens_section section,
                                       struct arena *arena);

/*
 * A lens as it is: all slopes are 0. Takes no memory.
 *
 * Given     lens        with as many surfaces as the one that there is room for, and its stop
 *           wavelength  um
 * Errors    as medium_index
 */
bool paraxial_dual_read(const struct lens *lens, double wavelength, struct paraxial_dual *dual,
                        struct error *error);

/* No change: all slopes are 0 again. */
void paraxial_dual_rest(struct paraxial_dual *dual);

/*
 * Let a number of the lens change too.
 *
 * Given     basis  what rays are derived by (parameter_type.basis), or PARAMETER_FOCAL or _HIATUS;
 *                  of what moves or turns surfaces, and of higher coefficients, nothing here
 *                  depends. An index is that of one space: a mirror behind it has its own
 *           slope  how fast, per unit of the change
 */
void paraxial_dual_change(struct paraxial_dual *dual, struct parameter basis, double slope);

/* First-order data, as struct first_order has them; NaN: absent. */
struct dual_first {
    struct dual index_object;
    struct dual power;                          /* 1/mm */
    struct dual efl, bfl, ffl;                  /* mm; infinite, or beyond, of an afocal system */
    struct dual image, magnification;           /* mm; 1 */
    struct dual petzval;                        /* 1 over the Petzval radius: -n' sum, 1/mm */
    struct dual length;                         /* first to last vertex, mm */
    struct dual entrance_pupil, entrance_scale; /* mm; 1 */
    struct dual exit_pupil;                     /* mm */
    struct dual stop_radius, entrance_radius;   /* mm, signed */
    struct dual fnumber, working_fnumber;
    struct dual marginal_y, marginal_v; /* before the first vertex: mm; n u */
    struct dual chief_y, chief_v;
};

/* How a lens is looked at. */
struct dual_question {
    const struct conjugate_object *object;
    const struct aperture_setting *aperture;
    enum field_kind field_kind;       /* of the chief ray; FIELD_NONE: there is none */
    double field;                     /* rad, or mm */
    const struct dual_first *primary; /* of the primary wavelength, which fixes the stop and the
                                         object of an image height; null: this is it */
};

/*
 * First-order data and their derivatives along the change.
 *
 * Formula   those of first_order_compute and first_order_aperture
 * Source    optics/first_order.h; derivatives by base/dual.h
 * Limits    plain doubles: near an afocal state lenscalc's own first-order data have more digits.
 *           What an aperture cannot be for this object is NaN
 */
void paraxial_dual_first(const struct paraxial_dual *dual, const struct dual_question *question,
                         struct dual_first *first);

/*
 * The power of some surfaces, from `first` to before `end`, between the media before and behind
 * them, and its derivative along the change, 1/mm.
 *
 * Formula   -v' behind them of a ray that comes in at y = 1, v = 0
 */
struct dual paraxial_dual_group(const struct paraxial_dual *dual, size_t first, size_t end);

/*
 * How far out light comes at each surface, |y| + |ybar| of the marginal and the chief ray, mm.
 *
 * Given     first  with both rays; without a chief ray that of the axis alone
 *           reach  receives one a surface
 */
void paraxial_dual_reach(const struct paraxial_dual *dual, const struct dual_first *first,
                         struct dual *reach);

/*
 * S1 .. S5 and their derivatives along the change.
 *
 * Given     first  of the same wavelength, with both rays
 * Formula   those of seidel_compute
 * Source    optics/seidel.h; derivatives by base/dual.h
 */
enum { DUAL_SUMS = 5 };
void paraxial_dual_seidel(const struct paraxial_dual *dual, const struct dual_first *first,
                          struct dual sums[DUAL_SUMS]);

#endif
