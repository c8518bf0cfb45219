/* design/thick.c - the thick lens that equals a bundle of rays best. */
/* SPDX-License-Identifier: MIT */
#include "design/thick.h"

#include "base/linear.h"

#include <math.h>
#include <string.h>

enum { BASE = 3, PER_RAY = 4 };

static double weight_of(const struct thick_rays *rays, size_t i)
{
    return rays->weight != NULL ? rays->weight[i] : 1;
}

static size_t group_of(const struct thick_rays *rays, size_t i)
{
    return rays->group != NULL ? rays->group[i] : 0;
}

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

/* One section of a ray: height at H and H', slope behind, and what f, H and distortion do to it. */
struct section_slope {
    double height, slope;
    double by_focal, by_front, by_distortion[THICK_DISTORTIONS];
};

/* The slope w of the line from the object point through H, and its derivative by H. */
static double field_slope(const struct thick_lens *lens, double x, double p, double *by_front)
{
    if (!isfinite(lens->object)) {
        *by_front = 0;
        return p;
    }
    double reach = lens->object + lens->front, w = (p * lens->object - x) / reach;
    *by_front = -w / reach;
    return w;
}

/* The distortion d and its derivative by s. */
static double distort(const struct thick_lens *lens, double s, double *by_s)
{
    const double *d = lens->distortion;
    *by_s = d[0] + s * (2 * d[1] + s * 3 * d[2]);
    return s * (d[0] + s * (d[1] + s * d[2]));
}

/* Without distortion: power and index apart, for they are the same for all rays. */
static inline struct section_slope follow_section(const struct thick_lens *lens, double power,
                                                  double per_index, double x, double p)
{
    double h = x + lens->front * p;
    return (struct section_slope){.height = h,
                                  .slope = (lens->index_object * p - power * h) * per_index,
                                  .by_focal = power * power * h * per_index,
                                  .by_front = -power * p * per_index,
                                  .by_distortion = {0}};
}

/* What distortion adds to both sections. */
static void add_distortion(const struct thick_lens *lens, double x, double y, double p, double q,
                           struct section_slope out[2])
{
    double front[2], by_s, factor = lens->index_object / lens->index_image;
    const double w[2] = {field_slope(lens, x, p, &front[0]), field_slope(lens, y, q, &front[1])};
    double s = w[0] * w[0] + w[1] * w[1], s_front = 2 * (w[0] * front[0] + w[1] * front[1]);
    double d = distort(lens, s, &by_s);
    for (int k = 0; k < 2; k++) {
        double term = s;
        out[k].slope += factor * w[k] * d;
        out[k].by_front += factor * (front[k] * d + w[k] * by_s * s_front);
        for (size_t j = 0; j < THICK_DISTORTIONS; j++, term *= s) {
            out[k].by_distortion[j] = factor * w[k] * term;
        }
    }
}

/* Derivatives of one residual, with z' the plane from H'; p is the slope before. */
static inline void fill_row(const struct section_slope *one, double w, double reach, double p,
                            double *row)
{
    row[0] = w * reach * one->by_focal;
    row[1] = w * (p + reach * one->by_front);
    row[2] = -w * one->slope;
}

/* Four residuals of a ray: x and y in the image, x and y in the pupil. */
static inline void fill_ray(const struct thick_task *task, const struct thick_lens *lens, size_t i,
                            double *residuals, double *jacobian, size_t columns)
{
    const struct thick_rays *rays = &task->rays;
    double power = 1 / lens->focal, per_index = 1 / lens->index_image;
    double x = rays->x[i], y = rays->y[i], weight = sqrt(weight_of(rays, i));
    const double p[2] = {rays->p[i], rays->q[i]};
    const double height[2] = {rays->x_out[i], rays->y_out[i]};
    const double slope[2] = {rays->p_out[i], rays->q_out[i]};
    size_t base = base_of(task, group_of(rays, i)), terms = columns - task->distortions;
    struct section_slope out[2] = {follow_section(lens, power, per_index, x, p[0]),
                                   follow_section(lens, power, per_index, y, p[1])};
    if (task->distortions > 0) {
        add_distortion(lens, x, y, p[0], p[1], out);
    }
    if (jacobian != NULL && columns > BASE) {
        memset(jacobian, 0, PER_RAY * columns * sizeof(double));
    }
    for (size_t k = 0; k < PER_RAY; k++) {
        const struct section_slope *one = &out[k % 2];
        double z = task->planes[k / 2], w = weight * task->plane_weights[k / 2];
        double reach = z - lens->rear;
        residuals[k] = w * (one->height - height[k % 2] + reach * one->slope - z * slope[k % 2]);
        if (jacobian != NULL) {
            fill_row(one, w, reach, p[k % 2], jacobian + k * columns + base);
        }
        for (size_t j = 0; jacobian != NULL && j < task->distortions; j++) {
            jacobian[k * columns + terms + j] = w * reach * one->by_distortion[j];
        }
    }
}

bool thick_residuals(void *context, const double *parameters, double *residuals, double *jacobian)
{
    const struct thick_task *task = context;
    size_t columns = base_count(task) + task->distortions;
    struct thick_lens lenses[THICK_GROUPS];
    for (size_t g = 0; g < task->group_count; g++) {
        lenses[g] = lens_of(task, parameters, g);
        if (!(fabs(lenses[g].focal) > 0)) {
            return false;
        }
    }
    for (size_t i = 0; i < task->rays.count; i++) {
        fill_ray(task, &lenses[group_of(&task->rays, i)], i, residuals + PER_RAY * i,
                 jacobian != NULL ? jacobian + PER_RAY * i * columns : NULL, columns);
    }
    return true;
}

static bool is_finite_ray(const struct thick_rays *rays, size_t i)
{
    return isfinite(rays->x[i]) && isfinite(rays->y[i]) && isfinite(rays->p[i]) &&
           isfinite(rays->q[i]) && isfinite(rays->x_out[i]) && isfinite(rays->y_out[i]) &&
           isfinite(rays->p_out[i]) && isfinite(rays->q_out[i]);
}

static bool check_rays(const struct thick_task *task, struct error *error)
{
    const struct thick_rays *rays = &task->rays;
    double sum = 0;
    if (rays->count == 0) {
        return fail(error, ERROR_DOMAIN, "there are no rays to fit to");
    }
    for (size_t i = 0; i < rays->count; i++) {
        if (!is_finite_ray(rays, i)) {
            return fail(error, ERROR_DOMAIN, "ray %zu is not all numbers", i + 1);
        }
        if (!(weight_of(rays, i) >= 0 && isfinite(weight_of(rays, i)))) {
            return fail(error, ERROR_DOMAIN, "ray %zu has the weight %.6g: it is 0 or more", i + 1,
                        weight_of(rays, i));
        }
        if (group_of(rays, i) >= task->group_count) {
            return fail(error, ERROR_DOMAIN, "ray %zu is of wavelength %zu, there are %zu", i + 1,
                        group_of(rays, i) + 1, task->group_count);
        }
        sum += weight_of(rays, i);
    }
    return sum > 0 || fail(error, ERROR_DOMAIN, "all rays have the weight 0");
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
    return check_rays(task, error);
}

static void name_parameters(const struct thick_task *task, struct arena *arena,
                            struct thick_fit *fit)
{
    static const char *const base[BASE] = {"f", "H", "H'"};
    for (size_t i = 0; i < fit->parameter_count; i++) {
        size_t terms = base_count(task);
        fit->names[i] = i >= terms ? arena_printf(arena, "d%zu", i - terms + 1)
                        : i < BASE ? base[i]
                                   : arena_printf(arena, "%s %zu", base[i % BASE], i / BASE + 1);
    }
}

/* What the rays leave open is an error: its value would be a guess. */
static bool check_determined(const struct thick_task *task, const struct thick_fit *fit,
                             struct error *error)
{
    double steepest = 0;
    for (size_t i = 0; i < task->rays.count; i++) {
        steepest = fmax(steepest, hypot(task->rays.p[i], task->rays.q[i]));
    }
    for (size_t i = 0; i < fit->parameter_count; i++) {
        if (!fit->summary.undetermined[i]) {
            continue;
        }
        if (steepest < 1e-9) {
            return fail(error, ERROR_DOMAIN,
                        "all rays come along the axis: they do not fix %s; add a field off the "
                        "axis",
                        fit->names[i]);
        }
        return fail(error, ERROR_DOMAIN, "the rays do not fix %s: add fields or rays",
                    fit->names[i]);
    }
    return true;
}

static struct slope_ray map_ray(const struct thick_rays *rays, const struct thick_lens *lenses,
                                size_t i)
{
    const struct slope_ray in = {rays->x[i], rays->y[i], rays->p[i], rays->q[i]};
    return thick_lens_map(&lenses[group_of(rays, i)], in);
}

double thick_errors(const struct thick_rays *rays, const struct thick_lens *lenses, double plane,
                    double *dx, double *dy)
{
    double sum = 0, weights = 0;
    for (size_t i = 0; i < rays->count; i++) {
        const struct slope_ray out = map_ray(rays, lenses, i);
        double x = out.x - rays->x_out[i] + plane * (out.p - rays->p_out[i]);
        double y = out.y - rays->y_out[i] + plane * (out.q - rays->q_out[i]);
        sum += weight_of(rays, i) * (x * x + y * y);
        weights += weight_of(rays, i);
        if (dx != NULL) {
            dx[i] = x;
            dy[i] = y;
        }
    }
    return sqrt(sum / weights);
}

/* The angle between directions of slopes p, q and u, v; sine and cosine with the same factor. */
static double angle_between(double p, double q, double u, double v)
{
    double a = q - v, b = u - p, c = p * v - q * u;
    return atan2(sqrt(a * a + b * b + c * c), 1 + p * u + q * v);
}

struct thick_score thick_score(const struct thick_rays *rays, const struct thick_lens *lenses,
                               const double planes[2])
{
    struct thick_score score = {.largest = 0};
    double sums[3] = {0}, weights = 0;
    for (size_t i = 0; i < rays->count; i++) {
        const struct slope_ray out = map_ray(rays, lenses, i);
        double w = weight_of(rays, i), x = out.x - rays->x_out[i], y = out.y - rays->y_out[i];
        for (int k = 0; k < 2; k++) {
            double off = hypot(x + planes[k] * (out.p - rays->p_out[i]),
                               y + planes[k] * (out.q - rays->q_out[i]));
            sums[k] += w * off * off;
            score.largest = k == 0 ? fmax(score.largest, off) : score.largest;
        }
        double turn = angle_between(out.p, out.q, rays->p_out[i], rays->q_out[i]);
        sums[2] += w * turn * turn;
        weights += w;
    }
    score.rms[0] = sqrt(sums[0] / weights);
    score.rms[1] = sqrt(sums[1] / weights);
    score.direction = sqrt(sums[2] / weights);
    return score;
}

static void set_result(const struct thick_task *task, struct thick_fit *fit)
{
    for (size_t g = 0; g < task->group_count; g++) {
        fit->lenses[g] = lens_of(task, fit->parameters, g);
    }
    double sums[2] = {0}, largest = 0, weights = 0;
    for (size_t i = 0; i < task->rays.count; i++) {
        const double *r = fit->summary.residuals + PER_RAY * i;
        double weight = weight_of(&task->rays, i), square = r[0] * r[0] + r[1] * r[1];
        sums[0] += square;
        sums[1] += r[2] * r[2] + r[3] * r[3];
        weights += weight;
        largest = weight > 0 ? fmax(largest, square / weight) : largest;
    }
    fit->rms = sqrt(sums[0] / weights) / task->plane_weights[0];
    fit->largest = sqrt(largest) / task->plane_weights[0];
    fit->rms_second = sqrt(sums[1] / weights) / task->plane_weights[1];
}

/* Mean square of the residuals in each plane, as if no parameter had been fitted. */
static void plane_variances(const struct thick_task *task, const double *residuals,
                            double variance[2])
{
    size_t count = task->rays.count;
    variance[0] = variance[1] = 0;
    for (size_t i = 0; i < PER_RAY * count; i++) {
        variance[i % PER_RAY / 2] += residuals[i] * residuals[i] / (2 * (double)count);
    }
}

/* a = b c, n x n; b or c may be on the other side of its diagonal: all are symmetric. */
static void multiply(const double *b, const double *c, size_t n, double *a)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            double sum = 0;
            for (size_t k = 0; k < n; k++) {
                sum += b[i * n + k] * c[k * n + j];
            }
            a[i * n + j] = sum;
        }
    }
}

/*
 * Errors where the two planes have residuals of different size: (J^T J)^-1 J^T V J (J^T J)^-1 with
 * V the variance in each plane.
 */
static void set_errors(const struct thick_task *task, struct arena *arena, struct thick_fit *fit)
{
    size_t n = fit->parameter_count, m = PER_RAY * task->rays.count;
    const double *j = fit->summary.jacobian;
    double *inner = ARENA_ARRAY(arena, n * n, double);
    double *half = ARENA_ARRAY(arena, n * n, double), variance[2];
    plane_variances(task, fit->summary.residuals, variance);
    for (size_t i = 0; i < m; i++) {
        const double *row = j + i * n;
        for (size_t k = 0; k < n; k++) {
            double factor = variance[i % PER_RAY / 2] * row[k];
            for (size_t l = 0; l < n && factor != 0; l++) {
                inner[k * n + l] += factor * row[l];
            }
        }
    }
    const double *inverse = fit->summary.inverse;
    multiply(inverse, inner, n, half);
    multiply(half, inverse, n, fit->summary.covariance);
    double share = (double)m / (double)fit->summary.degrees_of_freedom;
    for (size_t k = 0; k < n * n; k++) {
        fit->summary.covariance[k] *= share;
    }
    for (size_t k = 0; k < n; k++) {
        fit->summary.standard_error[k] = sqrt(fit->summary.covariance[k * n + k]);
    }
}

bool thick_fit(const struct thick_task *task, struct arena *arena, struct thick_fit *fit,
               struct error *error)
{
    if (!check_task(task, error)) {
        return false;
    }
    struct thick_task own = *task;
    size_t terms = base_count(task);
    /* nearly linear: the solver only has to come near, its last undamped steps do the rest */
    struct solver_options options = task->options;
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
    name_parameters(task, arena, fit);
    const struct solver_problem problem = {.parameter_count = fit->parameter_count,
                                           .residual_count = PER_RAY * task->rays.count,
                                           .evaluate = thick_residuals,
                                           .context = &own};
    if (!solver_run(&problem, &options, fit->parameters, arena, &fit->summary, error) ||
        !check_determined(task, fit, error)) {
        return false;
    }
    set_errors(task, arena, fit);
    set_result(task, fit);
    return true;
}

/* One equation of a pupil: -p place + s_x radius + s_x s (radius growth) = x. */
static void pupil_row(double x, double p, double stop, double s, double weight, bool growth,
                      double *row, double *right)
{
    row[0] = -p * weight;
    row[1] = stop * weight;
    if (growth) {
        row[2] = stop * s * weight;
    }
    *right = x * weight;
}

/* From the solution of the linear system to a pupil with its errors. */
static void set_pupil(const double *solution, const double *covariance, double variance,
                      size_t columns, struct thick_pupil *pupil)
{
    double r = solution[1], g = columns > 2 ? solution[2] / r : 0;
    pupil->place = solution[0];
    pupil->radius = r;
    pupil->growth = g;
    pupil->place_error = sqrt(variance * covariance[0]);
    pupil->radius_error = sqrt(variance * covariance[columns + 1]);
    pupil->growth_error = 0;
    if (columns > 2) {
        /* g = b/r: dg = (db - g dr)/r */
        double spread = covariance[8] - 2 * g * covariance[5] + g * g * covariance[4];
        pupil->growth_error = sqrt(variance * spread) / fabs(r);
    }
}

bool thick_fit_pupil(const struct thick_rays *rays, bool exit, bool growth, struct arena *arena,
                     struct thick_pupil *pupil, struct error *error)
{
    size_t columns = growth ? 3 : 2, rows = 2 * rays->count;
    double *a = ARENA_ARRAY(arena, rows * columns + 1, double);
    double *b = ARENA_ARRAY(arena, rows + 1, double), solution[3], covariance[9];
    const double *x = exit ? rays->x_out : rays->x, *p = exit ? rays->p_out : rays->p;
    const double *y = exit ? rays->y_out : rays->y, *q = exit ? rays->q_out : rays->q;
    double weights = 0, squares = 0;
    for (size_t i = 0; i < rays->count; i++) {
        double s = p[i] * p[i] + q[i] * q[i], weight = sqrt(weight_of(rays, i));
        double *row = a + 2 * i * columns;
        pupil_row(x[i], p[i], rays->stop_x[i], s, weight, growth, row, &b[2 * i]);
        pupil_row(y[i], q[i], rays->stop_y[i], s, weight, growth, row + columns, &b[2 * i + 1]);
        weights += weight * weight;
    }
    const struct linear_factors factors = linear_factor(a, rows, columns, 1e-11, arena);
    if (factors.rank < columns) {
        return fail(error, ERROR_DOMAIN,
                    "the rays do not fix the %s pupil: add fields off the axis",
                    exit ? "exit" : "entrance");
    }
    linear_reflect(&factors, b);
    for (size_t i = columns; i < rows; i++) {
        squares += b[i] * b[i];
    }
    linear_substitute(&factors, b, solution);
    linear_normal_inverse(&factors, covariance, arena);
    set_pupil(solution, covariance, rows > columns ? squares / (double)(rows - columns) : NAN,
              columns, pupil);
    pupil->rms = sqrt(squares / weights);
    return true;
}
