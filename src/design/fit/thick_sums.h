/* design/fit/thick_sums.h - rays added up to what a thick lens needs of them, and forgotten. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_FIT_THICK_SUMS_H
#define LENSCALC_DESIGN_FIT_THICK_SUMS_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/thick_lens.h"

#include <stdbool.h>
#include <stddef.h>

/* Rays of a lens, before and behind it, one array a coordinate. Slopes are tangents. */
struct thick_rays {
    size_t count;
    const double *x, *y, *p, *q;                 /* at the front reference plane */
    const double *x_out, *y_out, *p_out, *q_out; /* at the rear reference plane */
    const double *weight;                        /* 0 or more; null = 1 */
    const size_t *group;                         /* wavelength of each, 0 ..; null = all 0 */
    const size_t *field;                         /* object point, 0 ..; null = each its own */
    size_t field_count;
    const double *stop_x, *stop_y; /* share of the stop's radius; for pupils only */
};

static inline double thick_rays_weight(const struct thick_rays *rays, size_t i)
{
    return rays->weight != NULL ? rays->weight[i] : 1;
}

static inline size_t thick_rays_group(const struct thick_rays *rays, size_t i)
{
    return rays->group != NULL ? rays->group[i] : 0;
}

/*
 * What of one section of a ray counts: its error in any plane is a sum of these, times numbers that
 * depend on the thick lens alone. v is p for distant objects, else p L - x, and s the sum of v^2 of
 * both sections.
 */
enum {
    THICK_X_OUT,
    THICK_P_OUT,
    THICK_X,
    THICK_P,
    THICK_V_S, /* v s, v s^2, v s^3 */
    THICK_COLUMNS = THICK_V_S + THICK_DISTORTIONS
};

/* The rays of one object point and wavelength, by both sections. */
struct thick_bundle {
    size_t count;                            /* of rays */
    double weight;                           /* their sum */
    double mean[2][THICK_COLUMNS];           /* in x and y */
    double r[THICK_COLUMNS * THICK_COLUMNS]; /* of what deviates from it, times root weight */
};

struct thick_sums {
    size_t field_count, group_count;
    double object;                /* as in thick_lens */
    struct thick_bundle *bundles; /* all wavelengths of the first field, of the next .. */
    size_t count;                 /* of rays */
    double weight;                /* their sum */
    double steepest;              /* largest slope in front of the lens */
};

static inline size_t thick_sums_bundles(const struct thick_sums *sums)
{
    return sums->field_count * sums->group_count;
}

/*
 * Make ready; without rays yet.
 *
 * Given     object  as in thick_lens; the lenses that are fitted have the same
 *           arena   takes as much as there are bundles, however many rays
 */
struct thick_sums thick_sums_open(size_t fields, size_t groups, double object, struct arena *arena);

/*
 * Add rays; those of one bundle are best together.
 *
 * Given     rays  with `field` null each is of the field that its number is, of all rays
 * Formula   squares of errors add up to those of R c, c the lens's numbers for the columns, where Q
 *           R are the rays' (linear_fold). Deviations are from the mean of the bundle: of two parts
 *           of the weights V and W it is between theirs, and the rows of both are joined by one
 *           more, sqrt(V W/(V + W)) times what lies between
 * Source    [Golub13] 6.5.4
 * Errors    ERROR_DOMAIN: rays that are no numbers, weights below 0, a field or wavelength that
 *           there is not
 */
bool thick_sums_add(struct thick_sums *sums, const struct thick_rays *rays, struct error *error);

/* What a row of columns makes with such factors as below. */
static inline double thick_row_product(const double *row, const double *factors)
{
    double sum = 0;
    for (size_t j = 0; j < THICK_COLUMNS; j++) {
        sum += row[j] * factors[j];
    }
    return sum;
}

/*
 * Rms slope of the rays behind the lens against the mean of their bundle.
 */
double thick_sums_cone(const struct thick_sums *sums);

/*
 * Distance in a plane between rays and what thick lenses make of them: root mean square of all
 * rays, by their weights, mm.
 *
 * Given     plane  from the rear reference plane, mm
 */
double thick_sums_rms(const struct thick_sums *sums, const struct thick_lens *lenses, double plane);

/*
 * The numbers by which columns make an error in a plane: the thick lens's ray less the given one.
 *
 * Given     plane    from the rear reference plane, mm
 *           factors  receives THICK_COLUMNS numbers
 *           slopes   receives the same by f, H, H' and each d, 3 + THICK_DISTORTIONS rows; or null
 */
void thick_factors(const struct thick_lens *lens, double plane, double *factors, double *slopes);

#endif
