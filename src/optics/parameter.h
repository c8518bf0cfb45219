/* optics/parameter.h - what of a lens may change: one vocabulary for marks, fits, derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_PARAMETER_H
#define LENSCALC_OPTICS_PARAMETER_H

#include "base/arena.h"
#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

struct displacement;
struct figure;
struct lens;
struct medium;
struct surface;

/*
 * A kind of number (or the glass) that a designer, a fit or a tolerance may change. Its row in
 * parameter.c says what the rest of the program asks of it: a new one is an enumerator and a row.
 * Those of displacements stand last, in the order of a file: of the surface by itself, then of the
 * coordinate break before it.
 */
enum parameter_kind {
    PARAMETER_RADIUS,      /* of the conic, without A2, mm; that of a plane is infinite */
    PARAMETER_CURVATURE,   /* 1/R, 1/mm */
    PARAMETER_THICKNESS,   /* behind the surface, mm; behind the last: the image's distance */
    PARAMETER_CONIC,       /* k */
    PARAMETER_COEFFICIENT, /* A1, A2 .. A20: of r^order, mm^(1 - order) */
    PARAMETER_FOCAL,       /* of a thick lens: 1/power, mm */
    PARAMETER_HIATUS,      /* of a thick lens: from H to H', mm */
    PARAMETER_INDEX,       /* behind the surface: the number, or nd of nd/Vd */
    PARAMETER_ABBE,        /* Vd of nd/Vd */
    PARAMETER_GLASS,       /* the glass itself: no number */
    PARAMETER_DECENTER_X,  /* of this surface only, mm */
    PARAMETER_DECENTER_Y,
    PARAMETER_TILT_X, /* rad */
    PARAMETER_TILT_Y,
    PARAMETER_TILT_Z,
    PARAMETER_BREAK_DECENTER_X, /* of the axis before the surface, and all that follows */
    PARAMETER_BREAK_DECENTER_Y,
    PARAMETER_BREAK_TILT_X,
    PARAMETER_BREAK_TILT_Y,
    PARAMETER_BREAK_TILT_Z,
    PARAMETER_KINDS
};

/* One thing of a lens that may change: R1, t5, A4_2. */
struct parameter {
    size_t surface; /* from 0; LENS_NONE is the space before the first, which has an index */
    enum parameter_kind kind;
    int order; /* of a coefficient 1 .. 20; of all others 0 */
};

/* When the number has the other sign in a lens that is turned around. */
enum parameter_turn {
    TURN_KEEPS,
    TURN_WITH_AXES,   /* even number of mirrors: half a turn about y, which turns x and z */
    TURN_WITH_MIRRORS /* odd number: light goes the other way through a lens that stays */
};

/* What else is true of it. */
enum {
    PARAMETER_IS_ANGLE = 1,   /* rad here, degrees in files */
    PARAMETER_HAS_ORDERS = 2, /* there is one of each of the orders 1 .. 20 */
    PARAMETER_IS_MARK = 4,    /* may stand before '~' in a .lens file */
    PARAMETER_IS_BEHIND = 8   /* belongs to the space behind the surface */
};

struct parameter_type {
    const char *name;  /* in files, options and results: "R"; "A" of A1 .. A20 */
    const char *words; /* in messages: "radius" */
    int length;        /* it is a length to this power; of a coefficient ask parameter_length */
    unsigned is;       /* PARAMETER_IS_ANGLE .. */
    enum parameter_turn turn;
    const char *mark;          /* as marks, pick-ups and variables have it: "dx"; null = its name */
    enum parameter_kind basis; /* what rays are derived by for it; PARAMETER_KINDS: by nothing */
};
const struct parameter_type *parameter_type(enum parameter_kind kind);

/* The power of length that the number scales with: 1 of R, -1 of c, -3 of A4. */
int parameter_length(enum parameter_kind kind, int order);

/*
 * The next in the order of the table, every order of a coefficient by itself:
 * for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each))
 */
struct parameter parameter_next(struct parameter parameter);

/*
 * Names: "R", "A4"; and with the number of the surface, from 1, behind: "R1", "t12", "A4_2". A '_'
 * may stand before any number and must behind a digit. Those of marks are short: "dx", "dx3"; both
 * are read.
 *
 * Given     takes  of parameter_read: what the caller takes, which is all that is suggested to it;
 *                  null: everything. It reads the others too: the caller says why it takes none
 * Errors    of parameter_name_read: false, nothing else. Of parameter_read: ERROR_USAGE, with the
 *           hint what may have been meant where something is near
 */
const char *parameter_name(enum parameter_kind kind, int order, struct arena *arena);
const char *parameter_mark_name(enum parameter_kind kind, int order, struct arena *arena);
bool parameter_name_read(struct text text, enum parameter_kind *kind, int *order);
const char *parameter_write(struct parameter parameter, struct arena *arena);
const char *parameter_mark_write(struct parameter parameter, struct arena *arena);
bool parameter_read(struct text text, bool (*takes)(enum parameter_kind kind),
                    struct parameter *parameter, struct error *error);

/*
 * The surface in front of a gap by any name of its thickness but a word of the positions: `last`,
 * 2, t2, or the surface's own name. The same in every option that names gaps.
 *
 * Result    LENS_NONE: it names none
 */
size_t parameter_gap_find(const struct lens *lens, struct text name);

/* Has a surface of this kind such a number? */
bool parameter_suits(enum parameter_kind kind, const struct surface *surface);

/*
 * May this stand before '~' at the surface? And all that may, for messages: "R, c, t or glass". And
 * does it stand there already?
 */
bool parameter_is_mark(enum parameter_kind kind, const struct surface *surface);
const char *parameter_marks(const struct surface *surface, struct arena *arena);
bool parameter_is_marked(enum parameter_kind kind, int order, const struct surface *surface);
enum { PARAMETER_MOST_MARKS = 32 }; /* at one surface: all of them */

/*
 * Do the two stand for one number of a lens? R and c of a surface do, and a glass with its index
 * and its Abbe number.
 */
bool parameter_is_same(struct parameter a, struct parameter b);

/* Is it a number of a medium? */
static inline bool parameter_is_of_medium(enum parameter_kind kind)
{
    return kind == PARAMETER_INDEX || kind == PARAMETER_ABBE;
}

/* Are they the same words for it? */
static inline bool parameter_is_identical(struct parameter a, struct parameter b)
{
    return a.surface == b.surface && a.kind == b.kind && a.order == b.order;
}

/*
 * The number as the lens holds it, with its digits.
 *
 * Result    null where the surface has none: it is a plane, centred, the coefficient or the
 *           thickness is not given; a curvature where a radius is given, and a radius where a
 *           curvature is; always of what belongs to a medium
 */
const struct figure *parameter_figure(const struct surface *surface, enum parameter_kind kind,
                                      int order);

/*
 * Put a number there.
 *
 * Given     figure  a radius takes the place of a curvature and a curvature that of a radius; an
 *                   infinite radius is a plane
 *           arena   a displacement is not written to: the surface gets its own
 */
void parameter_put(struct surface *surface, enum parameter_kind kind, int order,
                   struct figure figure, struct arena *arena);

/* The medium behind a surface (LENS_NONE: before the first), and so behind mirrors after it. */
void parameter_put_medium(struct lens *lens, size_t surface, const struct medium *medium);

/*
 * Has the lens this, as a number of its own?
 *
 * Given     lens  in one position, or in all: then a number that they differ in is refused
 * Errors    ERROR_DOMAIN: no such surface, a kind of surface that has none, no thickness behind the
 *           last surface, a variable, an index or Abbe number that a catalogue or table states
 */
bool parameter_check(const struct lens *lens, struct parameter parameter, struct error *error);

/*
 * A lens as numbers.
 *
 * Given     parameter  passed parameter_check; not PARAMETER_GLASS
 * Result    mm, 1/mm, rad: the nearest double; 0 of what is not given, an infinite radius of a
 *           plane
 */
double parameter_get(const struct lens *lens, struct parameter parameter);

/*
 * And numbers as a lens, which parameter_get gives again.
 *
 * Given     lens   its surfaces are the caller's own: parameter_apply copies them. Of what a number
 *                  does not change, the digits that were typed stay, and its own where it is the
 *                  same
 * Result    mirrors behind a medium follow it. A curvature is kept as a radius where the surface
 *           has one, to the bits of a pair
 */
void parameter_set(struct lens *lens, struct parameter parameter, double value,
                   struct arena *arena);

/* Where a number is written to that lies beside its surface. */
enum { PARAMETER_WRITTEN = 2 * NUMBER_LENGTH };
struct parameter_room {
    struct displacement *displacement; /* null: the number is none of a displacement */
    char *written; /* PARAMETER_WRITTEN characters; null: the number is none of a medium */
};

/*
 * The same without taking memory.
 *
 * Given     room  for a displacement, which may be the surface's own; for the text of a medium
 */
void parameter_set_in(struct lens *lens, struct parameter parameter, double value,
                      const struct parameter_room *room);

/* Another with surfaces of its own, which may be changed; all else is shared. */
struct lens *lens_copy(const struct lens *lens, struct arena *arena);

/* A copy of the lens with `count` numbers put in, in this order. */
struct lens *parameter_apply(const struct lens *lens, const struct parameter *parameters,
                             const double *values, size_t count, struct arena *arena);

/*
 * The derivative of the number that rays are derived by (parameter_type.basis) by the parameter.
 *
 * Given     wavelength  um
 * Result    1 of a basis itself; NaN of what has none
 * Formula   dc/dR = -c^2; of nd/Vd, where n - 1 = (nd - 1) s, and s - 1 = g(wavelength)/Vd:
 *           dn/dnd = s, dn/dVd = -(nd - 1)(s - 1)/Vd
 * Source    derived here from the formula of glass_nd_vd
 */
double parameter_slope(const struct lens *lens, struct parameter parameter, double wavelength);

#endif
