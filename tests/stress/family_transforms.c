/* tests/stress/family_transforms.c - Fourier sums and Zernike's polynomials in long arithmetic. */
/* SPDX-License-Identifier: MIT */
#include "quad.h"
#include "stress.h"

#include "analysis/waves/zernike.h"
#include "base/fft.h"

#include <math.h>
#include <stdio.h>

/* -------- Fourier -------- */

/* One of the sums, in 64 bits; the angles are exact shares of a turn. */
static void fourier_sum(const double *re, const double *im, size_t n, size_t k, int sign,
                        long double sums[3])
{
    const long double turn = 2 * acosl(-1) / (long double)n;
    sums[0] = sums[1] = sums[2] = 0;
    for (size_t j = 0; j < n; j++) {
        const long double angle = (long double)(j * k % n) * turn;
        const long double c = cosl(angle), s = (long double)sign * sinl(angle);
        sums[0] += (long double)re[j] * c - (long double)im[j] * s;
        sums[1] += (long double)re[j] * s + (long double)im[j] * c;
        sums[2] += hypotl((long double)re[j], (long double)im[j]);
    }
}

void try_fft(struct trial *trial)
{
    /* the first are short, so that a few of them cost nothing */
    const double most = fmin(FFT_MOST, 600.0 * exp2((double)trial->number / 12));
    const size_t wanted = (size_t)trial_magnitude(trial, 1, most);
    const size_t n = fft_length_from(wanted > 0 ? wanted : 1);
    const struct fft fft = fft_open(n, &trial->arena);
    double *re = ARENA_ARRAY(&trial->arena, n, double), *x = ARENA_ARRAY(&trial->arena, n, double);
    double *im = ARENA_ARRAY(&trial->arena, n, double), *y = ARENA_ARRAY(&trial->arena, n, double);
    const double range = trial_chance(trial, 0.5) ? 0 : trial_between(trial, 0, 300);
    const double rare = trial_chance(trial, 0.3) ? 0.01 : 1;
    for (size_t j = 0; j < n; j++) {
        const double size = trial_chance(trial, rare) ? exp(-0.5 * range * trial_draw(trial)) : 0;
        re[j] = x[j] = size * trial_between(trial, -1, 1);
        im[j] = y[j] = size * trial_between(trial, -1, 1);
    }
    const bool inverse = trial_chance(trial, 0.5);
    enum instruction_set set = (enum instruction_set)trial_whole(trial, 0, 2);
    set = instruction_set_works(set) ? set : SET_SSE2;
    const struct fft_lines lines = {re, im, 1, 0, 1};
    fft_transform(&fft, inverse, &lines, set, &trial->arena);
    char *text = arena_array(&trial->arena, 60, 1);
    snprintf(text, 60, "length %zu\n", n);
    trial->about = text;
    for (int i = 0; i < 2; i++) {
        const size_t k = (size_t)(trial_draw(trial) * (double)n);
        long double sums[3];
        fourier_sum(x, y, n, k, inverse ? 1 : -1, sums);
        const double off =
            (double)hypotl((long double)re[k] - sums[0], (long double)im[k] - sums[1]);
        trial_figure(trial, "X", off, (double)hypotl(sums[0], sums[1]), (double)sums[2]);
    }
}

/* -------- Zernike -------- */

static quad factorial(int n)
{
    quad product = 1;
    for (int i = 2; i <= n; i++) {
        product *= i;
    }
    return product;
}

/* [Noll76] (2): sums of powers, and r^m of m angles as a power of x + iy. */
static quad zernike_truth(enum zernike_kind kind, struct zernike_term term, quad x, quad y)
{
    const int n = term.n, m = term.m < 0 ? -term.m : term.m;
    quad sum = 0, u = x * x + y * y, re = 1, im = 0;
    for (int k = 0; k <= (n - m) / 2; k++) {
        quad power = 1;
        for (int i = 0; i < (n - m) / 2 - k; i++) {
            power *= u;
        }
        sum += (k % 2 == 0 ? 1 : -1) * factorial(n - k) /
               (factorial(k) * factorial((n + m) / 2 - k) * factorial((n - m) / 2 - k)) * power;
    }
    for (int i = 0; i < m; i++) {
        const quad was = re;
        re = re * x - im * y;
        im = was * y + im * x;
    }
    const quad norm = kind == ZERNIKE_FRINGE ? 1 : quad_root((quad)((m == 0 ? 1 : 2) * (n + 1)));
    return norm * sum * (term.m < 0 ? im : re);
}

void try_zernike(struct trial *trial)
{
    enum { TERMS = 231, TRIED = 12 }; /* to n = 20; of the fringe set some beyond */
    static double values[TERMS];
    const enum zernike_kind kind = (enum zernike_kind)trial_whole(trial, 0, 2);
    const double r = trial_chance(trial, 0.2) ? 1 : sqrt(trial_draw(trial));
    const double angle = trial_between(trial, 0, 6.3);
    const double x = r * cos(angle), y = r * sin(angle);
    zernike_fill(kind, TERMS, x, y, values);
    char *text = arena_array(&trial->arena, 100, 1);
    snprintf(text, 100, "kind %d at %.17g %.17g\n", (int)kind, x, y);
    trial->about = text;
    for (int i = 0; i < TRIED; i++) {
        const int k = trial_whole(trial, 0, TERMS - 1);
        const struct zernike_term term = zernike_term(kind, (size_t)k);
        const quad step = (quad)1e-17, here = zernike_truth(kind, term, (quad)x, (quad)y);
        const quad by_x = zernike_truth(kind, term, (quad)x * (1 + step), (quad)y) - here;
        const quad by_y = zernike_truth(kind, term, (quad)x, (quad)y * (1 + step)) - here;
        const double sensitivity = (double)((quad_size(by_x) + quad_size(by_y)) / step);
        char what[30];
        snprintf(what, sizeof what, "Z(%d, %d)", term.n, term.m);
        trial_figure(trial, what, (double)quad_size((quad)values[k] - here),
                     (double)quad_size(here), sensitivity);
    }
}
