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

/* The column that is most alike to what is left; columns: none. */
static size_t pursuit_next(const struct pursuit *pursuit, const bool *is_chosen, const double *left)
{
    size_t best = pursuit->columns;
    double most = 0;
    for (size_t c = 0; c < pursuit->columns; c++) {
        const double alike = is_chosen[c] || !(pursuit->length[c] > 0)
                                 ? 0
                                 : fabs(pursuit_dot(pursuit->column[c], left, pursuit->rows));
        if (alike > most) {
            most = alike;
            best = c;
        }
    }
    return best;
}

/*
 * The terms that match `left`, of which what they leave stays.
 *
 * Formula   Gram and Schmidt's vectors of the chosen columns, twice orthogonal; R by substitution
 */
static struct ray_series pursuit_match(const struct pursuit *pursuit, size_t most, double *left)
{
    struct arena *arena = pursuit->arena;
    const size_t rows = pursuit->rows;
    most = most < pursuit->columns ? most : pursuit->columns;
    bool *is_chosen = ARENA_ARRAY(arena, pursuit->columns, bool);
    double **q = ARENA_ARRAY(arena, most, double *), *r = ARENA_ARRAY(arena, most * most, double);
    double *along = ARENA_ARRAY(arena, most, double);
    size_t *chosen = ARENA_ARRAY(arena, most, size_t), count = 0;
    const double whole = sqrt(pursuit_dot(left, left, rows));
    while (count < most && sqrt(pursuit_dot(left, left, rows)) > 1e-14 * whole) {
        const size_t c = pursuit_next(pursuit, is_chosen, left);
        if (c == pursuit->columns) {
            break;
        }
        is_chosen[c] = true;
        double *vector = q[count] = ARENA_ARRAY(arena, rows, double);
        for (size_t i = 0; i < rows; i++) {
            vector[i] = pursuit->column[c][i];
        }
        for (int pass = 0; pass < 2; pass++) {
            for (size_t k = 0; k < count; k++) {
                const double share = pursuit_dot(q[k], vector, rows);
                r[k * most + count] += share;
                for (size_t i = 0; i < rows; i++) {
                    vector[i] -= share * q[k][i];
                }
            }
        }
        const double length = sqrt(pursuit_dot(vector, vector, rows));
        if (!(length > 1e-12)) { /* the others have it: it stays out */
            for (size_t k = 0; k < count; k++) {
                r[k * most + count] = 0;
            }
            continue;
        }
        for (size_t i = 0; i < rows; i++) {
            vector[i] /= length;
        }
        r[count * most + count] = length;
        along[count] = pursuit_dot(vector, left, rows);
        for (size_t i = 0; i < rows; i++) {
            left[i] -= along[count] * vector[i];
        }
        chosen[count++] = c;
    }
    struct ray_series series = {.terms = ARENA_ARRAY(arena, most, struct ray_term), .count = count};
    for (size_t k = count; k-- > 0;) {
        double value = along[k];
        for (size_t j = k + 1; j < count; j++) {
            value -= r[k * most + j] * along[j];
        }
        along[k] = value / r[k * most + k];
        series.terms[k] = pursuit->terms[chosen[k]];
        series.terms[k].coefficient = along[k] / pursuit->length[chosen[k]];
    }
    return series;
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
    polynomial->place = pursuit_match(&pursuit, task->terms, left[0]);
    polynomial->direction = pursuit_match(&pursuit, task->terms, left[1]);
    polynomial->rms = sqrt(pursuit_dot(left[0], left[0], 2 * count) / (double)count);
    return true;
}
