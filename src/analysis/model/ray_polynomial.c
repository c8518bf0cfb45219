/* analysis/model/ray_polynomial.c - sparse polynomials that map rays, fitted to exact ones. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/ray_polynomial.h"

#include <math.h>

/* w and h of the rays of a block. */
struct ray_variables {
    double w[2][RAYS_BLOCK], h[2][RAYS_BLOCK];
};

static void ray_variables_of(const struct ray_polynomial *polynomial, const struct ray_block *block,
                             size_t lanes, struct ray_variables *of)
{
    const double scale = 1 / polynomial->index, length = 1 / polynomial->length;
    for (size_t i = 0; i < lanes; i++) {
        const double z = block->z[i] - polynomial->pupil;
        const double L = scale * block->p[i], M = scale * block->q[i], N = scale * block->r[i];
        of->w[0][i] = length * (block->x[i] * N - z * L);
        of->w[1][i] = length * (block->y[i] * N - z * M);
        of->h[0][i] = L / (1 + N);
        of->h[1][i] = M / (1 + N);
    }
}

/* Powers of the three invariants. */
struct ray_powers {
    double of[3][RAY_POLYNOMIAL_POWER + 1][RAYS_BLOCK];
};

static void ray_powers_of(const struct ray_variables *v, int most, size_t lanes,
                          struct ray_powers *powers)
{
    for (size_t i = 0; i < lanes; i++) {
        powers->of[0][0][i] = powers->of[1][0][i] = powers->of[2][0][i] = 1;
    }
    for (int k = 1; k <= most; k++) {
        for (size_t i = 0; i < lanes; i++) {
            const double x = v->w[0][i], y = v->w[1][i], u = v->h[0][i], t = v->h[1][i];
            powers->of[0][k][i] = powers->of[0][k - 1][i] * (x * x + y * y);
            powers->of[1][k][i] = powers->of[1][k - 1][i] * (x * u + y * t);
            powers->of[2][k][i] = powers->of[2][k - 1][i] * (u * u + t * t);
        }
    }
}

/* A series of a block. */
static void ray_series_sum(const struct ray_series *series, const struct ray_variables *v,
                           const struct ray_powers *powers, size_t lanes, double *x, double *y)
{
    double a[2][RAYS_BLOCK];
    for (size_t i = 0; i < lanes; i++) {
        a[0][i] = a[1][i] = 0;
    }
    for (size_t t = 0; t < series->count; t++) {
        const struct ray_term *term = &series->terms[t];
        const double *p = powers->of[0][term->power[0]], *q = powers->of[1][term->power[1]];
        const double *r = powers->of[2][term->power[2]];
        double *sum = a[term->of_h];
        for (size_t i = 0; i < lanes; i++) {
            sum[i] += term->coefficient * p[i] * q[i] * r[i];
        }
    }
    for (size_t i = 0; i < lanes; i++) {
        x[i] = a[0][i] * v->w[0][i] + a[1][i] * v->h[0][i];
        y[i] = a[0][i] * v->w[1][i] + a[1][i] * v->h[1][i];
    }
}

void ray_polynomial_trace(const struct ray_polynomial *polynomial, const struct rays *rays)
{
    const double n = polynomial->index_last;
    for (size_t b = 0; b < rays_blocks(rays); b++) {
        struct ray_block *block = &rays->blocks[b];
        const size_t left = rays->count - b * RAYS_BLOCK;
        const size_t lanes = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        struct ray_variables v;
        struct ray_powers powers;
        ray_variables_of(polynomial, block, lanes, &v);
        ray_powers_of(&v, polynomial->degree / 2, lanes, &powers);
        ray_series_sum(&polynomial->place, &v, &powers, lanes, block->x, block->y);
        ray_series_sum(&polynomial->direction, &v, &powers, lanes, block->p, block->q);
        for (size_t i = 0; i < lanes; i++) {
            const double L = block->p[i], M = block->q[i];
            block->z[i] = 0;
            block->p[i] = n * L;
            block->q[i] = n * M;
            block->r[i] = n * sqrt(fmax(1 - L * L - M * M, 0));
        }
    }
}

/* -------- matching pursuit -------- */

/* Columns of all terms over all rays, x of each then y, and what is to be matched. */
struct pursuit {
    struct arena *arena;
    size_t rows, columns;
    double **column;        /* of unit length; null: it is 0 */
    double *length;         /* that it had */
    struct ray_term *terms; /* of each */
};

static double pursuit_dot(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* All terms of the degree: (1 + 2 (i + j + k)) and less. */
static size_t pursuit_terms(int degree, struct ray_term *terms)
{
    size_t count = 0;
    for (int of_h = 0; of_h < 2; of_h++) {
        for (int sum = 0; sum <= degree / 2; sum++) {
            for (int i = sum; i >= 0; i--) {
                for (int j = sum - i; j >= 0; j--) {
                    terms[count++] = (struct ray_term){
                        .power = {(unsigned char)i, (unsigned char)j, (unsigned char)(sum - i - j)},
                        .of_h = (unsigned char)of_h};
                }
            }
        }
    }
    return count;
}

/* The columns of the rays that arrive, whose numbers are in `list`. */
static struct pursuit pursuit_open(const struct ray_polynomial_task *task,
                                   const struct ray_polynomial *polynomial, const size_t *list,
                                   size_t count, struct arena *arena)
{
    struct pursuit pursuit = {.arena = arena, .rows = 2 * count};
    pursuit.terms = ARENA_ARRAY(arena, RAY_POLYNOMIAL_TERMS, struct ray_term);
    pursuit.columns = pursuit_terms(task->degree, pursuit.terms);
    pursuit.column = ARENA_ARRAY(arena, pursuit.columns, double *);
    pursuit.length = ARENA_ARRAY(arena, pursuit.columns, double);
    for (size_t c = 0; c < pursuit.columns; c++) {
        pursuit.column[c] = ARENA_ARRAY(arena, 2 * count, double);
    }
    for (size_t b = 0; b < rays_blocks(task->before); b++) {
        struct ray_variables v;
        struct ray_powers powers;
        ray_variables_of(polynomial, &task->before->blocks[b], RAYS_BLOCK, &v);
        ray_powers_of(&v, task->degree / 2, RAYS_BLOCK, &powers);
        for (size_t k = 0; k < count; k++) {
            const size_t lane = list[k] % RAYS_BLOCK;
            if (list[k] / RAYS_BLOCK != b) {
                continue;
            }
            for (size_t c = 0; c < pursuit.columns; c++) {
                const struct ray_term *term = &pursuit.terms[c];
                const double monomial = powers.of[0][term->power[0]][lane] *
                                        powers.of[1][term->power[1]][lane] *
                                        powers.of[2][term->power[2]][lane];
                const double *x = term->of_h ? v.h[0] : v.w[0], *y = term->of_h ? v.h[1] : v.w[1];
                pursuit.column[c][k] = monomial * x[lane];
                pursuit.column[c][count + k] = monomial * y[lane];
            }
        }
    }
    for (size_t c = 0; c < pursuit.columns; c++) {
        double *column = pursuit.column[c];
        pursuit.length[c] = sqrt(pursuit_dot(column, column, pursuit.rows));
        for (size_t i = 0; i < pursuit.rows && pursuit.length[c] > 0; i++) {
            column[i] /= pursuit.length[c];
        }
    }
    return pursuit;
}

/* The column that would leave least of what is left; columns: none would take anything. */
static size_t pursuit_next(const struct pursuit *pursuit, const bool *is_chosen, const double *left)
{
    size_t best = pursuit->columns;
    double most = 0;
    for (size_t c = 0; c < pursuit->columns; c++) {
        const double *column = pursuit->column[c];
        const double square = is_chosen[c] ? 0 : pursuit_dot(column, column, pursuit->rows);
        if (!(square > 1e-22)) { /* nothing that the others do not have */
            continue;
        }
        const double along = pursuit_dot(column, left, pursuit->rows);
        if (along * along / square > most) {
            most = along * along / square;
            best = c;
        }
    }
    return best;
}

/*
 * The terms that match the first of two, and what they make of the second; what they leave stays.
 *
 * Given     columns of unit length, which are used up
 * Formula   Gram and Schmidt: each chosen column, of length 1, is taken out of all others and out
 *           of what is left; R by substitution
 */
static void pursuit_match(const struct pursuit *pursuit, size_t most, double *const left[2],
                          struct ray_series series[2])
{
    struct arena *arena = pursuit->arena;
    const size_t rows = pursuit->rows, columns = pursuit->columns;
    most = most < columns ? most : columns;
    bool *is_chosen = ARENA_ARRAY(arena, columns, bool);
    double *r = ARENA_ARRAY(arena, most * columns, double);
    double *along[2] = {ARENA_ARRAY(arena, most, double), ARENA_ARRAY(arena, most, double)};
    size_t *chosen = ARENA_ARRAY(arena, most, size_t), count = 0;
    const double whole = sqrt(pursuit_dot(left[0], left[0], rows));
    while (count < most && sqrt(pursuit_dot(left[0], left[0], rows)) > 1e-14 * whole) {
        const size_t c = pursuit_next(pursuit, is_chosen, left[0]);
        if (c == columns) {
            break;
        }
        double *q = pursuit->column[c];
        const double length = sqrt(pursuit_dot(q, q, rows));
        for (size_t i = 0; i < rows; i++) {
            q[i] /= length;
        }
        is_chosen[c] = true;
        r[count * columns + c] = length;
        for (size_t other = 0; other < columns; other++) {
            const double share =
                is_chosen[other] ? 0 : pursuit_dot(q, pursuit->column[other], rows);
            r[count * columns + other] += share;
            for (size_t i = 0; i < rows && !is_chosen[other]; i++) {
                pursuit->column[other][i] -= share * q[i];
            }
        }
        for (int k = 0; k < 2; k++) {
            along[k][count] = pursuit_dot(q, left[k], rows);
            for (size_t i = 0; i < rows; i++) {
                left[k][i] -= along[k][count] * q[i];
            }
        }
        chosen[count++] = c;
    }
    for (int s = 0; s < 2; s++) {
        series[s] = (struct ray_series){ARENA_ARRAY(arena, most, struct ray_term), count};
        for (size_t k = count; k-- > 0;) {
            double value = along[s][k];
            for (size_t j = k + 1; j < count; j++) {
                value -= r[k * columns + chosen[j]] * along[s][j];
            }
            along[s][k] = value / r[k * columns + chosen[k]];
            series[s].terms[k] = pursuit->terms[chosen[k]];
            series[s].terms[k].coefficient = along[s][k] / pursuit->length[chosen[k]];
        }
    }
}

/* What w is divided by: the largest there is. */
static double ray_polynomial_length(const struct ray_polynomial *unscaled, const struct rays *rays,
                                    const size_t *list, size_t count)
{
    double most = 0;
    for (size_t b = 0; b < rays_blocks(rays); b++) {
        struct ray_variables v;
        ray_variables_of(unscaled, &rays->blocks[b], RAYS_BLOCK, &v);
        for (size_t k = 0; k < count; k++) {
            if (list[k] / RAYS_BLOCK == b) {
                const size_t lane = list[k] % RAYS_BLOCK;
                most = fmax(most, hypot(v.w[0][lane], v.w[1][lane]));
            }
        }
    }
    return most > 0 ? most : 1;
}

bool ray_polynomial_fit(const struct ray_polynomial_task *task, struct arena *arena,
                        struct ray_polynomial *polynomial, struct error *error)
{
    const struct rays *after = task->after;
    size_t *list = ARENA_ARRAY(arena, after->count, size_t), count = 0;
    for (size_t i = 0; i < after->count; i++) {
        if (ray_block_status(&after->blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK) {
            list[count++] = i;
        }
    }
    if (task->degree < 1 || task->degree > RAY_POLYNOMIAL_DEGREE || task->degree % 2 == 0) {
        return fail(error, ERROR_DOMAIN, "polynomials of a round lens have odd degrees, 1 to %d",
                    RAY_POLYNOMIAL_DEGREE);
    }
    if (count == 0) {
        return fail(error, ERROR_DOMAIN, "no ray arrives that polynomials could be fitted to");
    }
    *polynomial = (struct ray_polynomial){.degree = task->degree,
                                          .pupil = task->pupil,
                                          .length = 1,
                                          .index = task->index,
                                          .index_last = task->index_last};
    polynomial->length = ray_polynomial_length(polynomial, task->before, list, count);
    const struct pursuit pursuit = pursuit_open(task, polynomial, list, count, arena);
    double *left[2] = {ARENA_ARRAY(arena, 2 * count, double),
                       ARENA_ARRAY(arena, 2 * count, double)};
    for (size_t k = 0; k < count; k++) {
        const struct ray_block *block = &after->blocks[list[k] / RAYS_BLOCK];
        const size_t lane = list[k] % RAYS_BLOCK;
        left[0][k] = block->x[lane];
        left[0][count + k] = block->y[lane];
        left[1][k] = block->p[lane] / task->index_last;
        left[1][count + k] = block->q[lane] / task->index_last;
    }
    struct ray_series series[2];
    pursuit_match(&pursuit, task->terms, left, series);
    polynomial->place = series[0];
    polynomial->direction = series[1];
    polynomial->rms = sqrt(pursuit_dot(left[0], left[0], 2 * count) / (double)count);
    return true;
}
