/* design/fit/thick_sums.c - rays added up to what a thick lens needs of them, and forgotten. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/thick_sums.h"

#include "base/linear.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Rays that are taken at once; two rows each, and two of the means. */
enum { BLOCK = 128, ROWS = 2 * BLOCK + 2 };

struct thick_sums thick_sums_open(size_t fields, size_t groups, double object, struct arena *arena)
{
    struct thick_sums sums = {.field_count = fields, .group_count = groups, .object = object};
    size_t count = fields > 0 && groups > SIZE_MAX / fields ? SIZE_MAX : fields * groups;
    sums.bundles = ARENA_ARRAY(arena, count, struct thick_bundle);
    return sums;
}

/* The columns of both sections of a ray: x `apart` before y. */
static void fill_columns(const struct thick_rays *rays, size_t i, double object, size_t rows,
                         size_t apart, double *to)
{
    const double in[2] = {rays->x[i], rays->y[i]}, p[2] = {rays->p[i], rays->q[i]};
    const double out[2] = {rays->x_out[i], rays->y_out[i]},
                 behind[2] = {rays->p_out[i], rays->q_out[i]};
    double v[2] = {p[0], p[1]};
    for (int k = 0; k < 2 && isfinite(object); k++) {
        v[k] = p[k] * object - in[k];
    }
    double s = v[0] * v[0] + v[1] * v[1];
    for (size_t k = 0; k < 2; k++) {
        double *row = to + k * apart, term = s;
        row[THICK_X_OUT * rows] = out[k];
        row[THICK_P_OUT * rows] = behind[k];
        row[THICK_X * rows] = in[k];
        row[THICK_P * rows] = p[k];
        for (size_t j = THICK_V_S; j < THICK_COLUMNS; j++, term *= s) {
            row[j * rows] = v[k] * term;
        }
    }
}

/* Up to BLOCK rays of one bundle, from the first on. */
static void add_block(const struct thick_rays *rays, size_t first, size_t count, double object,
                      struct thick_bundle *bundle)
{
    double a[THICK_COLUMNS * ROWS], weights[BLOCK], roots[BLOCK], sum = 0;
    size_t rows = 2 * count + 2;
    for (size_t i = 0; i < count; i++) {
        weights[i] = thick_rays_weight(rays, first + i);
        roots[i] = sqrt(weights[i]);
        sum += weights[i];
        fill_columns(rays, first + i, object, rows, count, a + i);
    }
    bundle->count += count;
    if (!(sum > 0)) {
        return;
    }
    double all = bundle->weight + sum, share = sum / all, root = sqrt(bundle->weight * share);
    for (size_t j = 0; j < THICK_COLUMNS; j++) {
        for (size_t k = 0; k < 2; k++) {
            double *column = a + j * rows + k * count, *mean = &bundle->mean[k][j], here = 0;
            /* take the mean off; a column that is the same everywhere is exactly 0 then */
            const double origin = column[0];
            for (size_t i = 0; i < count; i++) {
                here += weights[i] * (column[i] - origin);
            }
            here = origin + here / sum;
            for (size_t i = 0; i < count; i++) {
                column[i] = roots[i] * (column[i] - here);
            }
            double apart = here - *mean;
            a[j * rows + 2 * count + k] = root * apart;
            *mean = bundle->weight > 0 ? *mean + share * apart : here;
        }
    }
    bundle->weight = all;
    linear_fold(bundle->r, THICK_COLUMNS, a, rows);
}

/* The field of ray i, which is the one `number` of all. */
static size_t ray_field(const struct thick_rays *rays, size_t i, size_t number)
{
    return rays->field != NULL ? rays->field[i] : number;
}

static bool check_ray(const struct thick_sums *sums, const struct thick_rays *rays, size_t i,
                      struct error *error)
{
    size_t number = sums->count + i, field = ray_field(rays, i, number);
    double weight = thick_rays_weight(rays, i);
    if (!(isfinite(rays->x[i]) && isfinite(rays->y[i]) && isfinite(rays->p[i]) &&
          isfinite(rays->q[i]) && isfinite(rays->x_out[i]) && isfinite(rays->y_out[i]) &&
          isfinite(rays->p_out[i]) && isfinite(rays->q_out[i]))) {
        return fail(error, ERROR_DOMAIN, "ray %zu is not all numbers", number + 1);
    }
    if (!(weight >= 0 && isfinite(weight))) {
        return fail(error, ERROR_DOMAIN, "ray %zu has the weight %.6g: it is 0 or more", number + 1,
                    weight);
    }
    if (field >= sums->field_count) {
        return fail(error, ERROR_DOMAIN, "ray %zu is of field %zu, there are %zu", number + 1,
                    field + 1, sums->field_count);
    }
    if (thick_rays_group(rays, i) >= sums->group_count) {
        return fail(error, ERROR_DOMAIN, "ray %zu is of wavelength %zu, there are %zu", number + 1,
                    thick_rays_group(rays, i) + 1, sums->group_count);
    }
    return true;
}

bool thick_sums_add(struct thick_sums *sums, const struct thick_rays *rays, struct error *error)
{
    size_t first = 0, open = SIZE_MAX; /* the bundle of those from the first on */
    for (size_t i = 0; i < rays->count; i++) {
        if (!check_ray(sums, rays, i, error)) {
            return false;
        }
        size_t bundle =
            ray_field(rays, i, sums->count + i) * sums->group_count + thick_rays_group(rays, i);
        if (i > first && (bundle != open || i - first == BLOCK)) {
            add_block(rays, first, i - first, sums->object, &sums->bundles[open]);
            first = i;
        }
        open = bundle;
        sums->weight += thick_rays_weight(rays, i);
        sums->steepest = fmax(sums->steepest, hypot(rays->p[i], rays->q[i]));
    }
    if (rays->count > first) {
        add_block(rays, first, rays->count - first, sums->object, &sums->bundles[open]);
    }
    sums->count += rays->count;
    return true;
}

double thick_sums_cone(const struct thick_sums *sums)
{
    double sum = 0;
    for (size_t b = 0; b < thick_sums_bundles(sums); b++) {
        for (size_t i = 0; i <= THICK_P_OUT; i++) {
            double part = sums->bundles[b].r[i * THICK_COLUMNS + THICK_P_OUT];
            sum += part * part;
        }
    }
    return sqrt(sum / sums->weight);
}

double thick_sums_rms(const struct thick_sums *sums, const struct thick_lens *lenses, double plane)
{
    double sum = 0, factors[THICK_COLUMNS];
    for (size_t b = 0; b < thick_sums_bundles(sums); b++) {
        const struct thick_bundle *bundle = &sums->bundles[b];
        thick_factors(&lenses[b % sums->group_count], plane, factors, NULL);
        for (size_t i = 0; i < THICK_COLUMNS; i++) {
            double part = thick_row_product(bundle->r + i * THICK_COLUMNS, factors);
            sum += part * part;
        }
        for (size_t k = 0; k < 2; k++) {
            double part = thick_row_product(bundle->mean[k], factors);
            sum += bundle->weight * part * part;
        }
    }
    return sqrt(sum / sums->weight);
}

void thick_factors(const struct thick_lens *lens, double plane, double *factors, double *slopes)
{
    enum { BY_FOCAL, BY_FRONT, BY_REAR, BY_DISTORTION, ALL = BY_DISTORTION + THICK_DISTORTIONS };
    double power = 1 / lens->focal, n = lens->index_object, m = lens->index_image;
    double reach = plane - lens->rear, height = 1 - reach * power / m;
    /* h = x + H p goes on with the slope (n p - h/f)/n' + w d n/n', and w = g v */
    double g = isfinite(lens->object) ? 1 / (lens->object + lens->front) : 1;
    double by_front = isfinite(lens->object) ? -g * g : 0;
    factors[THICK_X_OUT] = -1;
    factors[THICK_P_OUT] = -plane;
    factors[THICK_X] = height;
    factors[THICK_P] = lens->front * height + reach * n / m;
    if (slopes != NULL) {
        memset(slopes, 0, ALL * THICK_COLUMNS * sizeof(double));
        slopes[BY_FOCAL * THICK_COLUMNS + THICK_X] = reach * power * power / m;
        slopes[BY_FOCAL * THICK_COLUMNS + THICK_P] = lens->front * reach * power * power / m;
        slopes[BY_FRONT * THICK_COLUMNS + THICK_P] = height;
        slopes[BY_REAR * THICK_COLUMNS + THICK_X] = power / m;
        slopes[BY_REAR * THICK_COLUMNS + THICK_P] = (lens->front * power - n) / m;
    }
    double term = g * g * g, before = g * g; /* g^(2 j + 3) */
    for (size_t j = 0; j < THICK_DISTORTIONS; j++, term *= g * g, before *= g * g) {
        size_t at = THICK_V_S + j;
        double d = lens->distortion[j] * n / m;
        factors[at] = reach * d * term;
        if (slopes != NULL) {
            slopes[BY_FRONT * THICK_COLUMNS + at] =
                reach * d * (double)(2 * j + 3) * before * by_front;
            slopes[BY_REAR * THICK_COLUMNS + at] = -d * term;
            slopes[(BY_DISTORTION + j) * THICK_COLUMNS + at] = reach * n / m * term;
        }
    }
}
