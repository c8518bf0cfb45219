/* design/fit/thick.c - the thick lens that equals a set of rays best. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/thick.h"

#include "design/fit/jackknife.h"

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
        if (rays->field != NULL && rays->field[i] >= rays->field_count) {
            return fail(error, ERROR_DOMAIN, "ray %zu is of field %zu, there are %zu", i + 1,
                        rays->field[i] + 1, rays->field_count);
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
    const struct thick_score score = thick_score(&task->rays, fit->lenses, task->planes);
    fit->rms = score.rms[0];
    fit->largest = score.largest;
    fit->rms_second = score.rms[1];
}

/* A task being solved: the rays of each object point and wavelength are a bundle. */
struct fitting {
    struct thick_task task;
    double focus;    /* F; 1 = blur and place count alike */
    size_t *bundle;  /* of each ray */
    double *weights; /* of each bundle, the sum */
    double *means;   /* room for x and y of each bundle and parameter */
    size_t bundle_count;
};

/* Sums over bundles of x and y of `width` numbers a row, divided by the bundles' weights. */
static void find_means(const struct fitting *fitting, const double *values, size_t width)
{
    const struct thick_rays *rays = &fitting->task.rays;
    double *means = fitting->means;
    memset(means, 0, 2 * fitting->bundle_count * width * sizeof(double));
    for (size_t i = 0; i < rays->count; i++) {
        double *mean = means + 2 * fitting->bundle[i] * width, root = sqrt(weight_of(rays, i));
        for (size_t j = 0; j < 2 * width; j++) {
            mean[j] += root * values[PER_RAY * i * width + j];
        }
    }
    for (size_t b = 0; b < fitting->bundle_count; b++) {
        for (size_t j = 0; j < 2 * width && fitting->weights[b] > 0; j++) {
            means[2 * b * width + j] /= fitting->weights[b];
        }
    }
}

/* F times what deviates from the mean of the bundle, plus that mean. */
static void lift_blur(const struct fitting *fitting, double *values, size_t width)
{
    const struct thick_rays *rays = &fitting->task.rays;
    double focus = fitting->focus;
    find_means(fitting, values, width);
    for (size_t i = 0; i < rays->count; i++) {
        const double *mean = fitting->means + 2 * fitting->bundle[i] * width;
        double root = sqrt(weight_of(rays, i)), *row = values + PER_RAY * i * width;
        for (size_t j = 0; j < 2 * width; j++) {
            row[j] = focus * (row[j] - root * mean[j]) + root * mean[j];
        }
    }
}

static bool evaluate(void *context, const double *parameters, double *residuals, double *jacobian)
{
    struct fitting *fitting = context;
    struct thick_task *task = &fitting->task;
    if (!thick_residuals(task, parameters, residuals, jacobian)) {
        return false;
    }
    if (task->focus_weight > 0) {
        lift_blur(fitting, residuals, 1);
        if (jacobian != NULL) {
            lift_blur(fitting, jacobian, base_count(task) + task->distortions);
        }
    }
    return true;
}

/* Rms slope of the rays behind the lens against the mean of their bundle. */
static double cone_slope(const struct fitting *fitting)
{
    const struct thick_rays *rays = &fitting->task.rays;
    double *means = fitting->means, sum = 0, weights = 0;
    memset(means, 0, 2 * fitting->bundle_count * sizeof(double));
    for (size_t i = 0; i < rays->count; i++) {
        double share = weight_of(rays, i) / fitting->weights[fitting->bundle[i]];
        means[2 * fitting->bundle[i]] += share > 0 ? share * rays->p_out[i] : 0;
        means[2 * fitting->bundle[i] + 1] += share > 0 ? share * rays->q_out[i] : 0;
    }
    for (size_t i = 0; i < rays->count; i++) {
        const double *mean = means + 2 * fitting->bundle[i];
        double p = rays->p_out[i] - mean[0], q = rays->q_out[i] - mean[1];
        sum += weight_of(rays, i) * (p * p + q * q);
        weights += weight_of(rays, i);
    }
    return sqrt(sum / weights);
}

static bool open_fitting(const struct thick_task *task, struct arena *arena,
                         struct fitting *fitting, struct error *error)
{
    const struct thick_rays *rays = &task->rays;
    size_t fields = rays->field != NULL ? rays->field_count : rays->count;
    *fitting = (struct fitting){.task = *task, .focus = 1};
    if (!(task->focus_weight > 0)) {
        return true;
    }
    fitting->bundle_count = fields * task->group_count;
    fitting->bundle = ARENA_ARRAY(arena, rays->count, size_t);
    fitting->weights = ARENA_ARRAY(arena, fitting->bundle_count, double);
    fitting->means = ARENA_ARRAY(
        arena, 2 * fitting->bundle_count * (base_count(task) + task->distortions), double);
    for (size_t i = 0; i < rays->count; i++) {
        size_t field = rays->field != NULL ? rays->field[i] : i;
        fitting->bundle[i] = field * task->group_count + group_of(rays, i);
        fitting->weights[fitting->bundle[i]] += weight_of(rays, i);
    }
    double cone = cone_slope(fitting);
    if (!(cone > 1e-12)) {
        return fail(error, ERROR_DOMAIN,
                    "the rays of each field are one: they do not fix the focus; more rays, or a "
                    "larger aperture");
    }
    fitting->focus = task->focus_weight / cone;
    return true;
}

/* By leaving out fields; rays of one field err alike, at all wavelengths. */
static void set_errors(const struct thick_task *task, struct arena *arena, struct thick_fit *fit)
{
    const struct thick_rays *rays = &task->rays;
    size_t n = fit->parameter_count, rows = PER_RAY * rays->count;
    size_t groups = rays->field != NULL ? rays->field_count : rays->count;
    size_t *group = ARENA_ARRAY(arena, rows, size_t);
    for (size_t i = 0; i < rows; i++) {
        group[i] = rays->field != NULL ? rays->field[i / PER_RAY] : i / PER_RAY;
    }
    const struct jackknife_fit found = {.residuals = fit->summary.residuals,
                                        .jacobian = fit->summary.jacobian,
                                        .rows = rows,
                                        .columns = n,
                                        .group = group,
                                        .group_count = groups};
    jackknife_covariance(&found, arena, fit->summary.covariance);
    for (size_t k = 0; k < n; k++) {
        fit->summary.standard_error[k] = sqrt(fit->summary.covariance[k * n + k]);
    }
}

bool thick_fit(const struct thick_task *task, struct arena *arena, struct thick_fit *fit,
               struct error *error)
{
    struct fitting fitting;
    if (!check_task(task, error) || !open_fitting(task, arena, &fitting, error)) {
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
    name_parameters(task, arena, fit);
    const struct solver_problem problem = {.parameter_count = fit->parameter_count,
                                           .residual_count = PER_RAY * task->rays.count,
                                           .evaluate = evaluate,
                                           .context = &fitting};
    if (!solver_run(&problem, &options, fit->parameters, arena, &fit->summary, error) ||
        !check_determined(task, fit, error)) {
        return false;
    }
    set_errors(task, arena, fit);
    set_result(task, fit);
    return true;
}
