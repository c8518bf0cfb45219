/* analysis/waves/zernike.c - Zernike's circle polynomials in the orders that are in use. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/zernike.h"

#include <math.h>
#include <stdlib.h>

static struct zernike_term noll_term(int j)
{
    int n = 0;
    while ((n + 1) * (n + 2) / 2 < j) {
        n++;
    }
    const int place = j - n * (n + 1) / 2;
    const int m = n % 2 == 0 ? place / 2 * 2 : (place - 1) / 2 * 2 + 1;
    return (struct zernike_term){j, n, j % 2 == 0 ? m : -m};
}

/* The set ends at 37 with the spherical of order 12, in whose place (6, 6) comes at 49. */
static struct zernike_term fringe_term(int j)
{
    enum { LAST = 37, SPHERICAL_12 = 49 };
    int counted = j;
    if (j == LAST || j == SPHERICAL_12) {
        counted = LAST + SPHERICAL_12 - j;
    }
    int d = 1;
    while (d * d < counted) {
        d++;
    }
    const int place = d * d - counted, m = (place + 1) / 2;
    return (struct zernike_term){j, 2 * (d - 1) - m, place % 2 == 0 ? m : -m};
}

struct zernike_term zernike_term(enum zernike_kind kind, size_t i)
{
    const int place = (int)i;
    if (kind == ZERNIKE_NOLL) {
        return noll_term(place + 1);
    }
    if (kind == ZERNIKE_FRINGE) {
        return fringe_term(place + 1);
    }
    int n = 0;
    while (n * (n + 3) / 2 < place) {
        n++;
    }
    return (struct zernike_term){place, n, 2 * place - n * (n + 2)};
}

void zernike_fill(enum zernike_kind kind, size_t count, double x, double y, double *values)
{
    double radial[ZERNIKE_ORDER + 1][ZERNIKE_ORDER + 1]; /* by m, then n */
    double turn[ZERNIKE_ORDER + 1][2];                   /* cos(m angle), sin(m angle) */
    const double r = hypot(x, y), c = r > 0 ? x / r : 1, s = r > 0 ? y / r : 0;
    int order = 0, most = 0;
    for (size_t i = 0; i < count; i++) {
        const struct zernike_term term = zernike_term(kind, i);
        order = term.n > order ? term.n : order;
        most = abs(term.m) > most ? abs(term.m) : most;
    }
    /* powers of x + iy: beside an axis they keep the digits that an angle has not */
    turn[0][0] = 1;
    turn[0][1] = 0;
    for (int m = 1; m <= most; m++) {
        turn[m][0] = turn[m - 1][0] * c - turn[m - 1][1] * s;
        turn[m][1] = turn[m - 1][1] * c + turn[m - 1][0] * s;
    }
    for (int m = 0; m <= most; m++) {
        /* R_n^m(r) of one m, for n = m, m + 2 .. most. */
        const double r2 = r * r, mm = m;
        radial[m][m] = pow(r, mm);
        if (m + 2 <= order) {
            radial[m][m + 2] = radial[m][m] * ((mm + 2) * r2 - (mm + 1));
        }
        for (int i = m + 4; i <= order; i += 2) {
            const double n = i;
            const double k1 = (n + mm) * (n - mm) * (n - 2) / 2;
            const double k2 = 2 * n * (n - 1) * (n - 2);
            const double k3 = -mm * mm * (n - 1) - n * (n - 1) * (n - 2);
            const double k4 = -n * (n + mm - 2) * (n - mm - 2) / 2;
            radial[m][i] = ((k2 * r2 + k3) * radial[m][i - 2] + k4 * radial[m][i - 4]) / k1;
        }
    }
    for (size_t i = 0; i < count; i++) {
        const struct zernike_term term = zernike_term(kind, i);
        const int m = abs(term.m);
        const double square = (m == 0 ? 1.0 : 2.0) * (term.n + 1);
        const double length = kind == ZERNIKE_FRINGE ? 1 : sqrt(square);
        values[i] = length * radial[m][term.n] * turn[m][term.m < 0];
    }
}
