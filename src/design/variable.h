/* design/variable.h - what of a lens a design varies, as plain numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_VARIABLE_H
#define LENSCALC_DESIGN_VARIABLE_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/lens.h"
#include "optics/lens_numbers.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * One number that may change. A model glass is two of them, its index and its Abbe number: where
 * both stand in a list and neither has bounds, they stay within the glass map
 * (design/glass_map.h); so does one of them without bounds, where the other stands or as far as
 * that one's bounds let it go.
 */
struct variable {
    struct parameter what; /* as the user named it; of a word of the positions one of its cells */
    size_t position;       /* LENS_NONE: the same in all positions; else of a word, only there */
    double low, high;      /* of what was named, mm, 1/mm, rad, 1; infinite = none. Of a radius or
                              a focal length low > 0 > high leads through a plane */
    const char *name;      /* "R1", "d5[tele]" */
    double scale;          /* natural scale of the number the solver varies; 0 = chosen here */
    struct typed_place place; /* of its mark */
};

/* A number of the lens that changes: its own basis, but of a focal length the power. */
struct variable_number {
    struct parameter what;
    bool is_inverse;
};

/* What a variable changes, in a position or in all. */
struct variable_drive {
    size_t variable, number, position;
    size_t share; /* variable of the glass map's share: the number is Vd; LENS_NONE: it is none */
};

/* A pick-up between two numbers. */
struct variable_rule {
    size_t from, to;
    bool from_inverse, to_inverse; /* it is meant of 1/number */
    double factor, offset;
};

/* Opened once. The arrays of `count` are those of the solver's numbers. */
struct variables {
    const struct lens *lens; /* in all its positions */
    struct variable *list;
    size_t count, position_count;       /* one position at least */
    double *own;                        /* those that the lens has */
    double *start, *low, *high, *scale; /* start: the same, or the bound that is nearest to it */
    struct variable_number *numbers;
    struct variable_drive *drives;
    struct variable_rule *rules;
    size_t number_count, drive_count, rule_count;
    struct lens_numbers *lenses; /* one a position */
    double *values;              /* of the numbers, position by position */
    double *slopes;              /* of the numbers by one variable */
};

/*
 * Make a lens ready to be varied.
 *
 * Given     lens  in all its positions; must outlive the variables
 *           list  count of them, copied
 * Result    the solver's numbers v are curvatures of radii, powers of focal lengths, nd and the
 *           share of the glass map of glasses; else what was named. Their natural scales, with the
 *           length L of the lens (its focal length where it is near the lens's own size, else that
 *           size, rounded to 1, 2 or 5 times a power of ten): 1/L of curvatures and powers, L/10 of
 *           thicknesses, L/100 of decentres, 0.01 of tilts, 1 of conics, r^(2 - n)/2L of A_n with
 *           the surface's semi-diameter r, 0.1 of indices, 10 of Abbe numbers, 0.5 of shares
 * Errors    ERROR_DOMAIN: no such number (parameter_check), one that is varied twice or follows
 *           another, bounds that contradict each other, a start outside of the glass map, a pick-up
 *           without a finite number
 */
bool variables_open(const struct lens *lens, const struct variable *list, size_t count,
                    struct arena *arena, struct variables *variables, struct error *error);

/* Where it begins: the numbers that the lens has, those outside of their bounds at the nearest. */
void variables_get(const struct variables *variables, double *v);

/* Those that lie outside of their bounds, in words; null: none does. */
const char *variables_moved(const struct variables *variables, struct arena *arena);

/*
 * The lens with these numbers, in a position.
 *
 * Result    pick-ups have followed; valid until the next call for this position. No memory is
 *           taken. Numbers that are not finite go into the lens as they are
 */
const struct lens *variables_put(struct variables *variables, const double *v, size_t position);

/* The derivative of a number that rays are derived by, by a variable. */
struct variable_link {
    size_t variable;
    struct parameter basis; /* parameter_type.basis; of a thick lens its focal length */
    double slope;
};

/* Is it the index behind a mirror? Of rays that has the row of the medium before the mirror, which
   has a link too (trace/derivative.h). */
static inline bool variable_link_of_mirror(const struct variable_link *link,
                                           const struct lens *lens)
{
    return link->basis.kind == PARAMETER_INDEX && link->basis.surface < lens->surface_count &&
           surface_reflects(&lens->surfaces[link->basis.surface]);
}

/*
 * Links of an index: that behind its surface, and those behind the mirrors in its medium.
 *
 * Given     links  more of one that is there since `first` is added to it: an index changes by nd
 *                  and Vd
 *           count  of the links that are there
 * Result    how many there are then
 */
size_t variable_index_links(const struct lens *lens, struct variable_link link, size_t first,
                            size_t count, struct variable_link *links);

/* Room that the links of a position may need. */
size_t variables_most_links(const struct variables *variables);

/*
 * What the variables change in a position at a wavelength, where variables_put has set it last.
 *
 * Given     wavelength  um: the index of a model glass depends on it
 *           links       variables_most_links of them
 * Result    how many; a mirror's medium, which is that before it, has links of its own
 * Formula   the chain rule: R = 1/c, f = 1/power, n(nd, Vd) by parameter_slope, the glass map, and
 *           pick-ups one after the other
 */
size_t variables_links(const struct variables *variables, size_t position, double wavelength,
                       struct variable_link *links);

/*
 * The derivative of a number of the lens by a variable, where variables_put has set it last.
 *
 * Given     what  any number: one that does not vary has 0
 */
double variables_slope(const struct variables *variables, size_t position, size_t variable,
                       struct parameter what);

/*
 * The lens in all its positions with these numbers, to be written.
 *
 * Result    numbers rounded to 14 digits, marks and bounds as they are, pick-ups followed
 */
struct lens *variables_lens(const struct variables *variables, const double *v,
                            struct arena *arena);

#endif
