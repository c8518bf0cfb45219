/* design/fit/thick.c - the thick lens that equals a set of rays best. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/thick.h"

#include "base/linear.h"
#include "design/fit/jackknife.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 4, BLOCK = 128 };

/* One equation of a pupil: -p place + s_x radius + s_x s (radius a) = x. */
static void pupil_row(double x, double p, double stop, double s, double weight, size_t rows,
                      double *row)
{
    row[0] = -p * weight;
    row[rows] = stop * weight;
    row[2 * rows] = stop * s * weight;
    row[3 * rows] = x * weight;
}

void thick_pupil_add(const struct thick_rays *rays, bool exit, struct thick_pupil_sums *sums)
{
    const double *x = exit ? rays->x_out : rays->x, *p = exit ? rays->p_out : rays->p;
    const double *y = exit ? rays->y_out : rays->y, *q = exit ? rays->q_out : rays->q;
    double a[COLUMNS * 2 * BLOCK];
    for (size_t first = 0; first < rays->count; first += BLOCK) {
        size_t count = rays->count - first < BLOCK ? rays->count - first : BLOCK, rows = 2 * count;
        for (size_t i = first; i < first + count; i++) {
            double s = p[i] * p[i] + q[i] * q[i], weight = sqrt(thick_rays_weight(rays, i));
            double *row = a + 2 * (i - first);
            pupil_row(x[i], p[i], rays->stop_x[i], s, weight, rows, row);
            pupil_row(y[i], q[i], rays->stop_y[i], s, weight, rows, row + 1);
            sums->weight += weight * weight;
        }
        linear_fold(sums->r, COLUMNS, a, rows);
        sums->rows += rows;
    }
}

bool thick_fit_pupil(const struct thick_pupil_sums *sums, bool exit, bool spherical_aberration,
                     struct arena *arena, struct thick_pupil *pupil, struct error *error)
{
    size_t columns = spherical_aberration ? 3 : 2, rows = sums->rows;
    double a[COLUMNS * 3], b[COLUMNS], solution[3], covariance[9], squares = 0;
    for (size_t i = 0; i < COLUMNS; i++) {
        for (size_t j = 0; j < columns; j++) {
            a[i * columns + j] = sums->r[i * COLUMNS + j];
        }
        b[i] = sums->r[i * COLUMNS + 3];
    }
    const struct linear_factors factors = linear_factor(a, COLUMNS, columns, 1e-11, arena);
    if (factors.rank < columns) {
        return fail(error, ERROR_DOMAIN,
                    "the rays do not fix the %s pupil: add fields off the axis",
                    exit ? "exit" : "entrance");
    }
    linear_reflect(&factors, b);
    for (size_t i = columns; i < COLUMNS; i++) {
        squares += b[i] * b[i];
    }
    linear_substitute(&factors, b, solution);
    linear_normal_inverse(&factors, covariance, arena);
    const double variance = rows > columns ? squares / (double)(rows - columns) : NAN;
    const double r = solution[1], g = columns > 2 ? solution[2] / r : 0;
    *pupil = (struct thick_pupil){.place = solution[0],
                                  .radius = r,
                                  .spherical_aberration = g,
                                  .place_error = sqrt(variance * covariance[0]),
                                  .radius_error = sqrt(variance * covariance[columns + 1]),
                                  .rms = sqrt(squares / sums->weight)};
    if (columns > 2) {
        /* g = b/r: dg = (db - g dr)/r */
        double spread = covariance[8] - 2 * g * covariance[5] + g * g * covariance[4];
        pupil->spherical_aberration_error = sqrt(variance * spread) / fabs(r);
    }
    return true;
}

/* Residuals of a bundle: the mean in both sections and planes, then what deviates from it. */
enum { BASE = 3, MEANS = 4, SLOPES = BASE + THICK_DISTORTIONS };

static size_t base_of(const struct thick_task *task, size_t group)
{
    return task->separate ? BASE * group : 0;
}

static size_t base_count(const struct thick_task *task)
{
    return BASE * (task->separate ? task->group_count : 1);
}

static struct thick_lens lens_of(const struct thick_task *task, const double *parameters,
                                 size_t group)
{
    const double *base = parameters + base_of(task, group);
    struct thick_lens lens = {.focal = base[0],
                              .front = base[1],
                              .rear = base[2],
                              .index_object = task->index_object[group],
                              .index_image = task->index_image[group],
                              .object = task->object};
    for (size_t j = 0; j < task->distortions; j++) {
        lens.distortion[j] = parameters[base_count(task) + j];
    }
    return lens;
}

static size_t bundle_rows(const struct thick_bundle *bundle)
{
    return bundle->count > 1 ? MEANS + 2 * THICK_COLUMNS : bundle->count * MEANS;
}

static size_t residual_count(const struct thick_sums *sums)
{
    size_t count = 0;
    for (size_t b = 0; b < thick_sums_bundles(sums); b++) {
        count += bundle_rows(&sums->bundles[b]);
    }
    return count;
}

/* What becomes of the columns of one wavelength in the two planes. */
struct plane_factors {
    double value[2][THICK_COLUMNS], slope[2][SLOPES * THICK_COLUMNS];
    size_t base, terms; /* where its parameters stand */
};

/* Where the next residual and its derivatives go. */
struct residual_rows {
    double *residuals, *jacobian; /* no jacobian: it is not wanted */
    size_t columns, distortions;
};

/* A row of the columns in one plane. */
static void put_row(const double *row, const struct plane_factors *factors, size_t plane,
                    double weight, struct residual_rows *to)
{
    *to->residuals++ = weight * thick_row_product(row, factors->value[plane]);
    if (to->jacobian == NULL) {
        return;
    }
    memset(to->jacobian, 0, to->columns * sizeof(double));
    for (size_t j = 0; j < BASE + to->distortions; j++) {
        size_t column = j < BASE ? factors->base + j : factors->terms + j - BASE;
        to->jacobian[column] =
            weight * thick_row_product(row, factors->slope[plane] + j * THICK_COLUMNS);
    }
    to->jacobian += to->columns;
}

bool thick_residuals(void *context, const double *parameters, double *residuals, double *jacobian)
{
    const struct thick_task *task = context;
    const struct thick_sums *sums = task->sums;
    struct plane_factors factors[THICK_GROUPS];
    /* How much blur counts against the place of the mean. */
    double blur = task->focus_weight > 0 ? task->focus_weight / thick_sums_cone(task->sums) : 1;
    struct residual_rows to = {residuals, jacobian, base_count(task) + task->distortions,
                               task->distortions};
    for (size_t g = 0; g < task->group_count; g++) {
        if (!(fabs(parameters[base_of(task, g)]) > 0)) {
            return false;
        }
        const struct thick_lens lens = lens_of(task, parameters, g);
        factors[g].base = base_of(task, g);
        factors[g].terms = base_count(task);
        for (size_t k = 0; k < 2; k++) {
            thick_factors(&lens, task->planes[k], factors[g].value[k], factors[g].slope[k]);
        }
    }
    for (size_t b = 0; b < thick_sums_bundles(sums); b++) {
        const struct thick_bundle *bundle = &sums->bundles[b];
        const struct plane_factors *by = &factors[b % sums->group_count];
        for (size_t k = 0; k < MEANS && bundle->count > 0; k++) {
            double weight = sqrt(bundle->weight) * task->plane_weights[k / 2];
            put_row(bundle->mean[k % 2], by, k / 2, weight, &to);
        }
        for (size_t k = 0; k < 2 && bundle->count > 1; k++) {
            double weight = task->plane_weights[k] * (k == 0 ? blur : 1);
            for (size_t i = 0; i < THICK_COLUMNS; i++) {
                put_row(bundle->r + i * THICK_COLUMNS, by, k, weight, &to);
            }
        }
    }
    return true;
}

static bool check_task(const struct thick_task *task, struct error *error)
{
    const struct thick_lens *start = &task->start;
    if (task->group_count == 0 || task->group_count > THICK_GROUPS) {
        return fail(error, ERROR_DOMAIN, "%zu wavelengths: 1 to %d can be fitted at once",
                    task->group_count, THICK_GROUPS);
    }
    if (!isfinite(start->focal) || !(fabs(start->focal) > 0) || !isfinite(start->front) ||
        !isfinite(start->rear)) {
        return fail(error, ERROR_DOMAIN,
                    "an afocal lens has no principal planes: no thick lens equals it");
    }
    if (!isfinite(task->planes[0]) || !isfinite(task->planes[1])) {
        return fail(error, ERROR_DOMAIN,
                    "an image or exit pupil at infinity: rays cannot be "
                    "compared there");
    }
    if (!(fabs(task->planes[0] - task->planes[1]) > 1e-9 * fabs(start->focal))) {
        return fail(error, ERROR_DOMAIN,
                    "image and exit pupil lie in one plane, %.6g mm from the last vertex: it "
                    "leaves the principal planes open",
                    task->planes[0]);
    }
    if (isfinite(task->object) && !(fabs(task->object + start->front) > 0)) {
        return fail(error, ERROR_DOMAIN, "the object lies in the principal plane");
    }
    const struct thick_sums *sums = task->sums;
    if (sums->count == 0) {
        return fail(error, ERROR_DOMAIN, "there are no rays to fit to");
    }
    if (!(sums->weight > 0)) {
        return fail(error, ERROR_DOMAIN, "all rays have the weight 0");
    }
    if (task->focus_weight > 0 && !(thick_sums_cone(sums) > 1e-12)) {
        return fail(error, ERROR_DOMAIN,
                    "the rays of each field are one: they do not fix the focus; more rays, or a "
                    "larger aperture");
    }
    return true;
}

/*
 * From the first ray on, those of its group that fill a block: where the model of that has them
 * end. How many there are.
 */
static size_t thick_block_trace(const struct thick_rays *rays, const struct ray_model *models,
                                size_t first, struct ray_block *block)
{
    const size_t group = thick_rays_group(rays, first);
    const struct ray_model *model = &models[group];
    struct rays ends = {.blocks = block};
    for (size_t i = first; i < rays->count && ends.count < RAYS_BLOCK; i++, ends.count++) {
        const double p = rays->p[i], q = rays->q[i];
        if (thick_rays_group(rays, i) != group) {
            break;
        }
        block->x[ends.count] = rays->x[i];
        block->y[ends.count] = rays->y[i];
        block->z[ends.count] = 0;
        block->r[ends.count] = model->thick.index_object / sqrt(1 + p * p + q * q);
        block->p[ends.count] = p * block->r[ends.count];
        block->q[ends.count] = q * block->r[ends.count];
    }
    ray_model_trace(model, &ends, NULL);
    return ends.count;
}

void thick_errors(const struct thick_rays *rays, const struct ray_model *models, double *dx,
                  double *dy)
{
    struct ray_block block;
    for (size_t first = 0, count; first < rays->count; first += count) {
        count = thick_block_trace(rays, models, first, &block);
        const double plane = models[thick_rays_group(rays, first)].image;
        for (size_t k = 0; k < count; k++) {
            const size_t i = first + k;
            dx[i] = block.x[k] - (rays->x_out[i] + plane * rays->p_out[i]);
            dy[i] = block.y[k] - (rays->y_out[i] + plane * rays->q_out[i]);
        }
    }
}

/* Root mean square of what was so far and of what is new. */
static void join_rms(double *rms, double weight, double squares, double all)
{
    *rms = all > 0 ? sqrt((*rms * *rms * weight + squares) / all) : 0;
}

/* How far ray i is off that a model has end in lane k, in both planes and by direction. */
static void thick_score_ray(const struct thick_rays *rays, size_t i, const struct ray_block *block,
                            size_t k, const double planes[2], double off[3])
{
    const double p = block->p[k] / block->r[k], q = block->q[k] / block->r[k];
    const double u = rays->p_out[i], v = rays->q_out[i];
    for (int plane = 0; plane < 2; plane++) {
        const double z = planes[plane], on = z - planes[0];
        off[plane] = hypot(block->x[k] + on * p - (rays->x_out[i] + z * u),
                           block->y[k] + on * q - (rays->y_out[i] + z * v));
    }
    /* the angle between their directions; sine and cosine with the same factor */
    const double a = q - v, b = u - p, c = p * v - q * u;
    off[2] = atan2(sqrt(a * a + b * b + c * c), 1 + p * u + q * v);
}

void thick_score_add(const struct thick_rays *rays, const struct ray_model *models, double plane,
                     struct thick_score *score)
{
    double sums[3] = {0}, before = score->weight;
    struct ray_block block;
    for (size_t first = 0, count; first < rays->count; first += count) {
        count = thick_block_trace(rays, models, first, &block);
        const double planes[2] = {models[thick_rays_group(rays, first)].image, plane};
        for (size_t k = 0; k < count; k++) {
            const double w = thick_rays_weight(rays, first + k);
            double off[3];
            thick_score_ray(rays, first + k, &block, k, planes, off);
            for (int j = 0; j < 3; j++) {
                sums[j] += w * off[j] * off[j];
            }
            score->largest = fmax(score->largest, off[0]);
            score->weight += w;
        }
    }
    join_rms(&score->rms[0], before, sums[0], score->weight);
    join_rms(&score->rms[1], before, sums[1], score->weight);
    join_rms(&score->direction, before, sums[2], score->weight);
}

/* By leaving out fields; rays of one field err alike, at all wavelengths. */
static void thick_set_errors(const struct thick_task *task, struct arena *arena,
                             struct thick_fit *fit)
{
    const struct thick_sums *sums = task->sums;
    size_t n = fit->parameter_count, rows = residual_count(sums), row = 0;
    size_t *group = ARENA_ARRAY(arena, rows, size_t);
    for (size_t b = 0; b < thick_sums_bundles(sums); b++) {
        for (size_t end = row + bundle_rows(&sums->bundles[b]); row < end; row++) {
            group[row] = b / sums->group_count;
        }
    }
    const struct jackknife_fit found = {.residuals = fit->summary.residuals,
                                        .jacobian = fit->summary.jacobian,
                                        .rows = rows,
                                        .columns = n,
                                        .group = group,
                                        .group_count = sums->field_count};
    jackknife_covariance(&found, arena, fit->summary.covariance);
    for (size_t k = 0; k < n; k++) {
        fit->summary.standard_error[k] = sqrt(fit->summary.covariance[k * n + k]);
    }
}

bool thick_fit(const struct thick_task *task, struct arena *arena, struct thick_fit *fit,
               struct error *error)
{
    struct thick_task fitted = *task;
    if (!check_task(task, error)) {
        return false;
    }
    size_t terms = base_count(task);
    /* nearly linear: the solver only has to come near, its last undamped steps do the rest */
    struct solver_options options = task->options;
    options.engine = SOLVER_CERES;
    options.function = options.function > 0 ? options.function : 1e-8;
    options.parameter = options.parameter > 0 ? options.parameter : 1e-8;
    options.initial_trust = options.initial_trust > 0 ? options.initial_trust : 1e8;
    *fit = (struct thick_fit){.parameter_count = terms + task->distortions};
    fit->lenses = ARENA_ARRAY(arena, task->group_count, struct thick_lens);
    fit->parameters = ARENA_ARRAY(arena, fit->parameter_count, double);
    fit->names = ARENA_ARRAY(arena, fit->parameter_count, const char *);
    for (size_t i = 0; i < terms; i += BASE) {
        fit->parameters[i] = task->start.focal;
        fit->parameters[i + 1] = task->start.front;
        fit->parameters[i + 2] = task->start.rear;
    }
    for (size_t i = 0; i < fit->parameter_count; i++) {
        static const char *const base[BASE] = {"f", "H", "H'"};
        if (i >= terms) {
            fit->names[i] = arena_printf(arena, "d%zu", i - terms + 1);
        } else if (i < BASE) {
            fit->names[i] = base[i];
        } else {
            fit->names[i] = arena_printf(arena, "%s %zu", base[i % BASE], i / BASE + 1);
        }
    }
    const struct solver_problem problem = {.parameter_count = fit->parameter_count,
                                           .residual_count = residual_count(task->sums),
                                           .evaluate = thick_residuals,
                                           .context = &fitted};
    if (!solver_run(&problem, &options, fit->parameters, arena, &fit->summary, error)) {
        return false;
    }
    /* What the rays leave open is an error: its value would be a guess. */
    for (size_t i = 0; i < fit->parameter_count; i++) {
        if (!fit->summary.undetermined[i]) {
            continue;
        }
        if (task->sums->steepest < 1e-9) {
            return fail(error, ERROR_DOMAIN,
                        "all rays come along the axis: they do not fix %s; add a field off the "
                        "axis",
                        fit->names[i]);
        }
        return fail(error, ERROR_DOMAIN, "the rays do not fix %s: add fields or rays",
                    fit->names[i]);
    }
    thick_set_errors(task, arena, fit);
    for (size_t g = 0; g < task->group_count; g++) {
        fit->lenses[g] = lens_of(task, fit->parameters, g);
    }
    fit->rms = thick_sums_rms(task->sums, fit->lenses, task->planes[0]);
    fit->rms_second = thick_sums_rms(task->sums, fit->lenses, task->planes[1]);
    return true;
}
