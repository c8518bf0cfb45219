/* base/linear.c - least squares of small dense systems, by orthogonal factors. */
/* SPDX-License-Identifier: MIT */
#include "base/linear.h"

#include <math.h>
#include <stdbool.h>

/* Length of what is below and at row `first` of a column, without overflow. */
static double column_length(const struct linear_factors *all, size_t column, size_t first)
{
    double largest = 0, sum = 0, plain = 0;
    for (size_t i = first; i < all->rows; i++) {
        double part = all->a[i * all->columns + column];
        plain += part * part;
    }
    if (plain > 1e-200 && plain < 1e200) {
        return sqrt(plain);
    }
    for (size_t i = first; i < all->rows; i++) {
        largest = fmax(largest, fabs(all->a[i * all->columns + column]));
    }
    if (!(largest > 0)) {
        return 0;
    }
    for (size_t i = first; i < all->rows; i++) {
        double part = all->a[i * all->columns + column] / largest;
        sum += part * part;
    }
    return largest * sqrt(sum);
}

/* Bring the column of which most is left to place k; returns that rest. */
static double pivot(struct linear_factors *all, size_t k)
{
    const size_t n = all->columns;
    size_t best = k;
    double longest = -1;
    /* lengths of columns, of what is below and at row k; row by row, as memory has them */
    double *lengths = all->spare;
    for (size_t j = k; j < n; j++) {
        lengths[j] = 0;
    }
    for (size_t i = k; i < all->rows; i++) {
        const double *row = all->a + i * n;
        for (size_t j = k; j < n; j++) {
            lengths[j] += row[j] * row[j];
        }
    }
    for (size_t j = k; j < n; j++) {
        const bool plain = lengths[j] > 1e-200 && lengths[j] < 1e200;
        lengths[j] = plain ? sqrt(lengths[j]) : column_length(all, j, k);
    }
    for (size_t j = k; j < n; j++) {
        if (lengths[j] > longest) {
            longest = lengths[j];
            best = j;
        }
    }
    for (size_t i = 0; i < all->rows && best != k; i++) {
        double kept = all->a[i * n + k];
        all->a[i * n + k] = all->a[i * n + best];
        all->a[i * n + best] = kept;
    }
    size_t kept = all->order[k];
    all->order[k] = all->order[best];
    all->order[best] = kept;
    return longest;
}

/* The same of all columns behind k, row by row. */
static void reflect_rows(struct linear_factors *all, size_t k)
{
    const size_t n = all->columns;
    const double head = all->reflector[k];
    double *factors = all->spare, *first = all->a + k * n;
    for (size_t j = k + 1; j < n; j++) {
        factors[j] = head * first[j];
    }
    for (size_t i = k + 1; i < all->rows; i++) {
        const double *row = all->a + i * n, tail = row[k];
        for (size_t j = k + 1; j < n; j++) {
            factors[j] += tail * row[j];
        }
    }
    for (size_t j = k + 1; j < n; j++) {
        factors[j] /= head;
        first[j] -= factors[j] * head;
    }
    for (size_t i = k + 1; i < all->rows; i++) {
        double *row = all->a + i * n;
        const double tail = row[k];
        for (size_t j = k + 1; j < n; j++) {
            row[j] -= factors[j] * tail;
        }
    }
}

struct linear_factors linear_factor(double *a, size_t rows, size_t columns, double tolerance,
                                    struct arena *arena)
{
    struct linear_factors all = {.rows = rows, .columns = columns, .a = a};
    all.reflector = ARENA_ARRAY(arena, columns, double);
    all.scale = ARENA_ARRAY(arena, columns, double);
    all.order = ARENA_ARRAY(arena, columns, size_t);
    all.spare = ARENA_ARRAY(arena, columns, double);
    /* columns of length 1, in the order in which they came */
    for (size_t j = 0; j < columns; j++) {
        const double length = column_length(&all, j, 0);
        all.scale[j] = length > 0 ? length : 1;
        all.order[j] = j;
        for (size_t i = 0; i < rows; i++) {
            a[i * columns + j] /= all.scale[j];
        }
    }
    for (size_t k = 0; k < columns && k < rows; k++) {
        double length = pivot(&all, k);
        if (!(length > tolerance)) {
            break;
        }
        /* make the reflection that turns column k into (r, 0 ..), and apply it to those behind */
        double *const head = a + k * columns + k;
        const double r = *head > 0 ? -length : length;
        for (size_t i = k; i < rows; i++) {
            a[i * columns + k] /= -r;
        }
        all.reflector[k] = *head + 1;
        *head = r;
        reflect_rows(&all, k);
        all.rank = k + 1;
    }
    return all;
}

void linear_reflect(const struct linear_factors *factors, double *b)
{
    for (size_t k = 0; k < factors->rank; k++) {
        /*
         * b -= v (v^T b) / v0, where v is reflection k, its head apart, its tail below R, scaled so
         * that |v|^2 = 2 v0
         */
        double product = factors->reflector[k] * b[k];
        for (size_t i = k + 1; i < factors->rows; i++) {
            product += factors->a[i * factors->columns + k] * b[i];
        }
        const double factor = product / factors->reflector[k];
        b[k] -= factor * factors->reflector[k];
        for (size_t i = k + 1; i < factors->rows; i++) {
            b[i] -= factor * factors->a[i * factors->columns + k];
        }
    }
}

void linear_substitute(const struct linear_factors *factors, double *b, double *x)
{
    size_t n = factors->columns;
    for (size_t j = 0; j < n; j++) {
        x[j] = 0;
    }
    for (size_t k = factors->rank; k-- > 0;) {
        double sum = b[k];
        for (size_t j = k + 1; j < factors->rank; j++) {
            sum -= factors->a[k * n + j] * b[j];
        }
        b[k] = sum / factors->a[k * n + k];
    }
    for (size_t k = 0; k < factors->rank; k++) {
        x[factors->order[k]] = b[k] / factors->scale[factors->order[k]];
    }
}

void linear_solve(const struct linear_factors *factors, double *b, double *x)
{
    linear_reflect(factors, b);
    linear_substitute(factors, b, x);
}

/* R^-1 of the leading `rank` columns, rank x rank, upper. */
static double *invert_triangle(const struct linear_factors *factors, struct arena *arena)
{
    size_t n = factors->columns, rank = factors->rank;
    double *inverse = ARENA_ARRAY(arena, rank * rank + 1, double);
    for (size_t j = 0; j < rank; j++) {
        inverse[j * rank + j] = 1 / factors->a[j * n + j];
        for (size_t i = j; i-- > 0;) {
            double sum = 0;
            for (size_t k = i + 1; k <= j; k++) {
                sum += factors->a[i * n + k] * inverse[k * rank + j];
            }
            inverse[i * rank + j] = -sum / factors->a[i * n + i];
        }
    }
    return inverse;
}

void linear_normal_inverse(const struct linear_factors *factors, double *inverse,
                           struct arena *arena)
{
    size_t n = factors->columns, rank = factors->rank;
    const double *triangle = invert_triangle(factors, arena);
    for (size_t i = 0; i < n * n; i++) {
        inverse[i] = NAN;
    }
    for (size_t i = 0; i < rank; i++) {
        for (size_t j = 0; j < rank; j++) {
            double sum = 0;
            for (size_t k = i > j ? i : j; k < rank; k++) {
                sum += triangle[i * rank + k] * triangle[j * rank + k];
            }
            size_t row = factors->order[i], column = factors->order[j];
            inverse[row * n + column] = sum / (factors->scale[row] * factors->scale[column]);
        }
    }
}

/* Four sums side by side: one alone waits for each addition. */
static double column_product(const double *a, const double *b, size_t count)
{
    double sums[4] = {0};
    size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        for (size_t k = 0; k < 4; k++) {
            sums[k] += a[i + k] * b[i + k];
        }
    }
    for (; i < count; i++) {
        sums[i % 4] += a[i] * b[i];
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void linear_fold(double *r, size_t columns, double *a, size_t rows)
{
    for (size_t j = 0; j < columns; j++) {
        const double *below = a + j * rows;
        double squares = column_product(below, below, rows), head = r[j * columns + j];
        if (!(squares > 0)) {
            continue;
        }
        /* the reflector is (u, below), whose square is 2 length u */
        double length = copysign(sqrt(head * head + squares), head), u = head + length;
        r[j * columns + j] = -length;
        for (size_t k = j + 1; k < columns; k++) {
            double *to = a + k * rows, *top = &r[j * columns + k];
            double share = (u * *top + column_product(below, to, rows)) / (length * u);
            *top -= share * u;
            for (size_t i = 0; i < rows; i++) {
                to[i] -= share * below[i];
            }
        }
    }
}
