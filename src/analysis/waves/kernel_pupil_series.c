/* analysis/waves/kernel_pupil_series.c - polynomials of a disc, compiled for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_series.h"
#include "base/turns.h"

#include <stdbool.h>
#include <string.h>

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

/*
 * Places that are looked at together: their number is a multiple of PUPIL_LANES, and no constant,
 * so that what is done to each of them is a loop and not unrolled into something else.
 */
enum { LANES = 32 };

/* Powers of x + i y, and Chebyshev's polynomials of 2 r^2 - 1 with their slopes by r^2. */
struct powers {
    size_t lanes;
    double x[PUPIL_ORDERS][LANES], y[PUPIL_ORDERS][LANES];
    double t[PUPIL_RADIAL][LANES], dt[PUPIL_RADIAL][LANES];
};

/* sum = a b + c d */
static void add_two(size_t lanes, const double *restrict a, const double *restrict b,
                    const double *restrict c, const double *restrict d, double *restrict sum)
{
    for (size_t l = 0; l < lanes; l++) {
        sum[l] = a[l] * b[l] + c[l] * d[l];
    }
}

/* to += factor a b */
static void kernel_pupil_series_add_product(size_t lanes, double factor, const double *restrict a,
                                            const double *restrict b, double *restrict to)
{
    for (size_t l = 0; l < lanes; l++) {
        to[l] += factor * a[l] * b[l];
    }
}

/* to += factor from */
static void kernel_pupil_series_add(size_t lanes, double factor, const double *restrict from,
                                    double *restrict to)
{
    for (size_t l = 0; l < lanes; l++) {
        to[l] += factor * from[l];
    }
}

/* next = 2 z here - before */
static void kernel_pupil_series_go_on(size_t lanes, const double *restrict z,
                                      const double *restrict before, const double *restrict here,
                                      double *restrict next)
{
    for (size_t l = 0; l < lanes; l++) {
        next[l] = 2 * z[l] * here[l] - before[l];
    }
}

static void find_powers(const struct pupil_form *form, size_t lanes, const double *restrict x,
                        const double *restrict y, struct powers *restrict powers)
{
    double z[LANES], less[LANES];
    powers->lanes = lanes;
    for (size_t l = 0; l < lanes; l++) {
        z[l] = 2 * (x[l] * x[l] + y[l] * y[l]) - 1;
        less[l] = -y[l];
        powers->x[0][l] = powers->t[0][l] = 1;
        powers->y[0][l] = powers->dt[0][l] = 0;
        powers->t[1][l] = z[l];
        powers->dt[1][l] = 2;
    }
    for (size_t m = 1; m < form->orders; m++) {
        add_two(lanes, powers->x[m - 1], x, powers->y[m - 1], less, powers->x[m]);
        add_two(lanes, powers->x[m - 1], y, powers->y[m - 1], x, powers->y[m]);
    }
    for (size_t j = 2; j < form->radial[0]; j++) {
        kernel_pupil_series_go_on(lanes, z, powers->t[j - 2], powers->t[j - 1], powers->t[j]);
        kernel_pupil_series_go_on(lanes, z, powers->dt[j - 2], powers->dt[j - 1], powers->dt[j]);
        kernel_pupil_series_add(lanes, 4, powers->t[j - 1], powers->dt[j]);
    }
}

/* The terms of one m with the cosine or the sine: its power, and what that is by x and by y. */
struct kernel_pupil_series_family {
    const double *power, *by_x, *by_y;
    double factor_x, factor_y;
    size_t count, first; /* terms */
};

/* Family 2 m has the cosine, 2 m + 1 the sine. */
static struct kernel_pupil_series_family
family_of(const struct pupil_form *form, const struct powers *powers, size_t number, size_t first)
{
    const size_t m = number / 2, below = m > 0 ? m - 1 : 0;
    const bool sine = number % 2 == 1;
    return (struct kernel_pupil_series_family){.power = sine ? powers->y[m] : powers->x[m],
                                               .by_x = sine ? powers->y[below] : powers->x[below],
                                               .by_y = sine ? powers->x[below] : powers->y[below],
                                               .factor_x = (double)m,
                                               .factor_y = sine ? (double)m : -(double)m,
                                               .count = number == 1 ? 0 : form->radial[m],
                                               .first = first};
}

/* What one function has in a block of lanes; by_q: by r^2. */
struct kernel_pupil_series_sums {
    double value[LANES], by_x[LANES], by_y[LANES], by_q[LANES];
};

static void add_family(const struct powers *powers, const struct kernel_pupil_series_family *family,
                       const double *c, bool slopes, struct kernel_pupil_series_sums *sums)
{
    const size_t lanes = powers->lanes;
    double t[LANES] = {0}, dt[LANES] = {0};
    c += family->first;
    for (size_t j = 0; j < family->count; j++) {
        kernel_pupil_series_add(lanes, c[j], powers->t[j], t);
    }
    kernel_pupil_series_add_product(lanes, 1, family->power, t, sums->value);
    if (!slopes) {
        return;
    }
    for (size_t j = 1; j < family->count; j++) {
        kernel_pupil_series_add(lanes, c[j], powers->dt[j], dt);
    }
    kernel_pupil_series_add_product(lanes, 1, family->power, dt, sums->by_q);
    kernel_pupil_series_add_product(lanes, family->factor_x, family->by_x, t, sums->by_x);
    kernel_pupil_series_add_product(lanes, family->factor_y, family->by_y, t, sums->by_y);
}

/* One function at a block of places. */
static void kernel_pupil_series_look_block(const struct pupil_form *form, const double *c,
                                           const struct powers *powers, bool slopes,
                                           struct kernel_pupil_series_sums *sums)
{
    struct kernel_pupil_series_family family = {.count = 0};
    memset(sums, 0, sizeof *sums);
    for (size_t i = 0; i < 2 * form->orders; i++) {
        family = family_of(form, powers, i, family.first + family.count);
        add_family(powers, &family, c, slopes, sums);
    }
}

static size_t lanes_from(size_t done, size_t count)
{
    return count - done < LANES ? count - done : LANES;
}

void NAMED(kernel_pupil_look, KERNEL)(const struct pupil_form *form, const double *const c[2],
                                      const struct pupil_look *look)
{
    const bool slopes = look->slope[0][0] != NULL;
    for (size_t done = 0; done < look->count; done += LANES) {
        const size_t lanes = lanes_from(done, look->count);
        const double *x = look->x + done, *y = look->y + done;
        struct powers powers;
        find_powers(form, lanes, x, y, &powers);
        for (int k = 0; k < 2; k++) {
            struct kernel_pupil_series_sums sums;
            kernel_pupil_series_look_block(form, c[k], &powers, slopes, &sums);
            memcpy(look->value[k] + done, sums.value, lanes * sizeof(double));
            if (slopes) {
                kernel_pupil_series_add_product(lanes, 2, x, sums.by_q, sums.by_x);
                kernel_pupil_series_add_product(lanes, 2, y, sums.by_q, sums.by_y);
                memcpy(look->slope[k][0] + done, sums.by_x, lanes * sizeof(double));
                memcpy(look->slope[k][1] + done, sums.by_y, lanes * sizeof(double));
            }
        }
    }
}

/* What a block of places adds to the terms of a family, lane by lane. */
static void gather_family(const struct powers *powers,
                          const struct kernel_pupil_series_family *family,
                          const struct kernel_pupil_series_sums *sums, bool slopes,
                          double (*terms)[LANES])
{
    const size_t lanes = powers->lanes;
    double by_t[LANES] = {0}, by_dt[LANES] = {0};
    terms += family->first;
    kernel_pupil_series_add_product(lanes, 1, family->power, sums->value, by_t);
    if (slopes) {
        kernel_pupil_series_add_product(lanes, family->factor_x, family->by_x, sums->by_x, by_t);
        kernel_pupil_series_add_product(lanes, family->factor_y, family->by_y, sums->by_y, by_t);
        kernel_pupil_series_add_product(lanes, 1, family->power, sums->by_q, by_dt);
    }
    for (size_t j = 0; j < family->count; j++) {
        kernel_pupil_series_add_product(lanes, 1, by_t, powers->t[j], terms[j]);
    }
    for (size_t j = 1; j < family->count && slopes; j++) {
        kernel_pupil_series_add_product(lanes, 1, by_dt, powers->dt[j], terms[j]);
    }
}

/* What is given of one function at a block of places. */
static void take_sums(const struct pupil_look *look, int k, size_t done, size_t lanes,
                      struct kernel_pupil_series_sums *sums)
{
    memset(sums, 0, sizeof *sums);
    memcpy(sums->value, look->value[k] + done, lanes * sizeof(double));
    if (look->slope[0][0] != NULL) {
        memcpy(sums->by_x, look->slope[k][0] + done, lanes * sizeof(double));
        memcpy(sums->by_y, look->slope[k][1] + done, lanes * sizeof(double));
        kernel_pupil_series_add_product(lanes, 2, look->x + done, sums->by_x, sums->by_q);
        kernel_pupil_series_add_product(lanes, 2, look->y + done, sums->by_y, sums->by_q);
    }
}

/* In one order for every instruction set. */
static double kernel_pupil_series_sum_of(double *restrict lanes)
{
    for (size_t half = LANES / 2; half > 4; half /= 2) {
        kernel_pupil_series_add(half, 1, lanes + half, lanes);
    }
    return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
           ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

void NAMED(kernel_pupil_gather, KERNEL)(const struct pupil_form *form,
                                        const struct pupil_look *look, double *const sums[2])
{
    const bool slopes = look->slope[0][0] != NULL;
    double terms[2][PUPIL_TERMS][LANES];
    memset(terms[0], 0, form->terms * sizeof terms[0][0]);
    memset(terms[1], 0, form->terms * sizeof terms[1][0]);
    for (size_t done = 0; done < look->count; done += LANES) {
        const size_t lanes = lanes_from(done, look->count);
        struct powers powers;
        find_powers(form, lanes, look->x + done, look->y + done, &powers);
        for (int k = 0; k < 2; k++) {
            struct kernel_pupil_series_sums given;
            struct kernel_pupil_series_family family = {.count = 0};
            take_sums(look, k, done, lanes, &given);
            for (size_t i = 0; i < 2 * form->orders; i++) {
                family = family_of(form, &powers, i, family.first + family.count);
                gather_family(&powers, &family, &given, slopes, terms[k]);
            }
        }
    }
    for (size_t i = 0; i < 2 * form->terms; i++) {
        sums[i / form->terms][i % form->terms] =
            kernel_pupil_series_sum_of(terms[i / form->terms][i % form->terms]);
    }
}

/* All terms of a block of lanes, place by place. */
static void kernel_pupil_series_put_terms(const struct pupil_form *form,
                                          const struct powers *powers, double *rows)
{
    struct kernel_pupil_series_family family = {.count = 0};
    for (size_t i = 0; i < 2 * form->orders; i++) {
        family = family_of(form, powers, i, family.first + family.count);
        for (size_t j = 0; j < family.count; j++) {
            for (size_t l = 0; l < powers->lanes; l++) {
                rows[l * form->terms + family.first + j] = family.power[l] * powers->t[j][l];
            }
        }
    }
}

void NAMED(kernel_pupil_gram, KERNEL)(const struct pupil_fit *fit)
{
    const size_t n = fit->form->terms;
    memset(fit->factor, 0, n * n * sizeof(double));
    for (size_t done = 0; done < fit->count; done += LANES) {
        struct powers powers;
        find_powers(fit->form, lanes_from(done, fit->count), fit->x + done, fit->y + done, &powers);
        kernel_pupil_series_put_terms(fit->form, &powers, fit->room + done * n);
    }
    for (size_t place = 0; place < fit->count; place++) {
        const double *restrict terms = fit->room + place * n;
        for (size_t i = 0; i < n; i++) {
            const double share = fit->weights[place] * terms[i];
            double *restrict row = fit->factor + i * n;
            for (size_t j = 0; j <= i; j++) {
                row[j] += share * terms[j];
            }
        }
    }
}

void NAMED(kernel_pupil_cross, KERNEL)(const struct pupil_cross *cross)
{
    const double *restrict a = cross->waves[0], *restrict b = cross->waves[1];
    const double *restrict high = cross->amplitudes[0], *restrict low = cross->amplitudes[1];
    const double *restrict weights = cross->weights;
    double *restrict re = cross->re, *restrict im = cross->im, *restrict all = cross->size;
    const size_t count = cross->count;
    for (size_t i = 0; i < count; i++) {
        re[i] = weights[i] * high[i] * low[i];
    }
    if (all != NULL) {
        memcpy(all, re, count * sizeof *all);
    }
    for (size_t i = 0; i < count; i++) {
        const double size = re[i];
        double c, s;
        turns_of(a[i] - b[i], &c, &s);
        re[i] = size * c;
        im[i] = size * s;
    }
}
