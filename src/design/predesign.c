/* design/predesign.c - lenses from nothing: powers, bendings and gaps by third-order theory. */
/* SPDX-License-Identifier: MIT */
#include "design/predesign.h"

#include "base/random.h"
#include "design/glass_map.h"
#include "design/solver/solver.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum {
    TRIES = 2,  /* of which the best is taken */
    STEPS = 60, /* of least squares */
    MOST_NUMBERS = 3 * PREDESIGN_MOST,
    SUMS = 5,
    WHOLE = 5 + SUMS, /* residuals of the lens as a whole */
    EACH = 4,         /* and of each surface */
    MOST_RESIDUALS = WHOLE + EACH * 2 * PREDESIGN_MOST
};

/* What counts: transverse aberrations of so many focal lengths, colour, power and lengths; of the
   sums, S1 .. S5; and of each surface. */
static const double blur = 1e-3, colour = 0.2, of_power = 2e-3, of_length = 0.02;
static const double of_sum[SUMS] = {1, 1, 1, 1, 0.1};
static const double of_surface = 0.05, of_curvature = 0.02;

/* One try: numbers are the curvatures, the gaps, and the distance of a stop outside the lens. */
struct predesign_try {
    const struct predesign_wish *wish;
    size_t stop;
    double index[PREDESIGN_MOST], abbe[PREDESIGN_MOST];
};

/* A paraxial ray, height and slope. */
struct predesign_ray {
    double complex y, u;
};

static size_t predesign_number_count(const struct predesign_wish *wish)
{
    return 3 * wish->elements;
}

/* Through the thin elements; heights at each, and the height at the stop. */
static struct predesign_ray predesign_trace(const struct predesign_try *try,
                                            const double complex *x, struct predesign_ray ray,
                                            struct predesign_ray *at, double complex *in_stop)
{
    const size_t m = try->wish->elements;
    const double complex *gap = x + 2 * m;
    const double complex outside = x[3 * m - 1];
    if (try->stop == 0) {
        *in_stop = ray.y - ray.u * outside;
    }
    for (size_t i = 0; i < m; i++) {
        at[i] = ray;
        ray.u -= ray.y * (try->index[i] - 1) * (x[2 * i] - x[2 * i + 1]);
        if (try->stop == i + 1) {
            *in_stop = ray.y + ray.u * (i + 1 < m ? gap[i] / 2 : outside);
        }
        ray.y += i + 1 < m ? ray.u * gap[i] : 0;
    }
    return ray;
}

/* What a surface adds to the sums. */
static void predesign_surface(struct predesign_ray *marginal, struct predesign_ray *chief,
                              double complex c, double n, double after, double complex *sum)
{
    const double complex A = n * (c * marginal->y + marginal->u), y = marginal->y;
    const double complex B = n * (c * chief->y + chief->u);
    const double complex H = n * (marginal->u * chief->y - chief->u * y);
    const double complex P = c * (1 / after - 1 / n);
    const double complex u = (n * marginal->u - y * c * (after - n)) / after;
    const double complex change = u / after - marginal->u / n;
    sum[0] = -A * A * y * change;
    sum[1] = -A * B * y * change;
    sum[2] = -B * B * y * change;
    sum[3] = -H * H * P;
    sum[4] = -B * B * B * (1 / (after * after) - 1 / (n * n)) * y +
             chief->y * B * (2 * y * B - chief->y * A) * P;
    chief->u = (n * chief->u - chief->y * c * (after - n)) / after;
    marginal->u = u;
}

/* Result: false: the stop is where its image is at infinity. */
static bool predesign_judge(const struct predesign_try *try, const double complex *x,
                            double complex *r)
{
    const struct predesign_wish *wish = try->wish;
    const size_t m = wish->elements;
    const double h = 1 / (2 * wish->fnumber), t = wish->field, v = wish->vergence;
    struct predesign_ray of_height[PREDESIGN_MOST], of_slope[PREDESIGN_MOST];
    double complex a = 0, b = 0, length = 0, sums[SUMS] = {0}, axial = 0, lateral = 0;
    const struct predesign_ray far =
        predesign_trace(try, x, (struct predesign_ray){1, 0}, of_height, &a);
    const struct predesign_ray end =
        predesign_trace(try, x, (struct predesign_ray){0, 1}, of_slope, &b);
    if (!(cabs(a + b * v) > 1e-3)) {
        return false;
    }
    const double complex y0 = -b * t / (a + b * v), u0 = y0 * v + t;
    const double complex slope = h * (far.u + v * end.u);
    const double scale = 1 / (2 * fmax(cabs(slope), h / 4) * blur);
    double complex *own = r + WHOLE;
    for (size_t i = 0; i < m; i++) {
        const struct predesign_ray *p = &of_height[i], *q = &of_slope[i];
        struct predesign_ray marginal = {h * (p->y + v * q->y), h * (p->u + v * q->u)};
        struct predesign_ray chief = {y0 * p->y + u0 * q->y, y0 * p->u + u0 * q->u};
        const double complex power = (try->index[i] - 1) * (x[2 * i] - x[2 * i + 1]);
        axial += marginal.y * marginal.y * power / try->abbe[i];
        lateral += marginal.y * chief.y * power / try->abbe[i];
        for (size_t k = 0; k < 2; k++) {
            const double n = k == 0 ? 1 : try->index[i], after = k == 0 ? try->index[i] : 1;
            double complex sum[SUMS];
            predesign_surface(&marginal, &chief, x[2 * i + k], n, after, sum);
            for (size_t j = 0; j < SUMS; j++) {
                sums[j] += sum[j];
            }
            for (size_t j = 0; j + 1 < EACH; j++) {
                *own++ = of_surface * scale * sum[j];
            }
            *own++ = of_curvature * x[2 * i + k];
        }
        length += i + 1 < m ? x[2 * m + i] : 0;
    }
    const double complex back = (far.y + v * end.y) * h / -slope;
    r[0] = (-far.u - 1) / of_power;
    r[1] = (wish->back - back) / of_length;
    r[2] = (length + back - wish->track) / of_length;
    r[3] = wish->is_achromatic ? axial * scale / colour : 0;
    r[4] = wish->is_achromatic ? lateral * scale / colour : 0;
    for (size_t j = 0; j < SUMS; j++) {
        r[5 + j] = of_sum[j] * scale * sums[j];
    }
    return true;
}

static bool predesign_evaluate(void *context, const double *parameters, double *residuals,
                               double *jacobian)
{
    static const double step = 1e-30; /* of the complex step: no difference is taken */
    const struct predesign_try *try = context;
    const size_t n = predesign_number_count(try->wish);
    const size_t count = WHOLE + EACH * 2 * try->wish->elements;
    double complex x[MOST_NUMBERS], r[MOST_RESIDUALS];
    for (size_t j = 0; j < n; j++) {
        x[j] = parameters[j];
    }
    if (!predesign_judge(try, x, r)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        residuals[i] = creal(r[i]);
        if (!isfinite(residuals[i])) {
            return false;
        }
    }
    for (size_t j = 0; j < n && jacobian != NULL; j++) {
        x[j] += step * I;
        predesign_judge(try, x, r);
        x[j] = parameters[j];
        for (size_t i = 0; i < count; i++) {
            jacobian[i * n + j] = cimag(r[i]) / step;
        }
    }
    return true;
}

/* Numbers by chance, in 0 .. 1. */
struct predesign_chance {
    uint64_t seed;
    uint32_t number, drawn;
};

static double predesign_draw(struct predesign_chance *chance)
{
    const struct random_words words =
        random_words(RANDOM_LAYOUTS, chance->seed, chance->number, chance->drawn++);
    return random_unit_of(words.w[0], words.w[1]);
}

/* Signs, glasses, powers, bendings and gaps by chance. */
static void predesign_guess(struct predesign_try *try, struct predesign_chance *chance, double *x)
{
    const struct predesign_wish *wish = try->wish;
    const size_t m = wish->elements;
    bool is_positive[PREDESIGN_MOST];
    size_t positive = 0;
    for (size_t i = 0; i < m; i++) {
        is_positive[i] = predesign_draw(chance) < 0.65;
        positive += is_positive[i];
    }
    if (positive == 0 || (positive == m && m > 1)) { /* one of the other sign */
        const size_t other = (size_t)(predesign_draw(chance) * (double)m);
        is_positive[other] = positive == 0;
    }
    for (size_t i = 0; i < m; i++) {
        const double nd = is_positive[i] ? 1.58 + 0.2 * predesign_draw(chance)
                                         : 1.60 + 0.15 * predesign_draw(chance);
        const double power = (is_positive[i] ? 1 : -1) * (0.4 + 1.4 * predesign_draw(chance));
        const double bending = 4 * predesign_draw(chance) - 2;
        const double bent = power / (nd - 1);
        try->index[i] = nd;
        try->abbe[i] = glass_map_at(nd, is_positive[i] ? 0.9 : 0.2).Vd;
        x[2 * i] = bent * (bending + 1) / 2;
        x[2 * i + 1] = x[2 * i] - bent;
    }
    for (size_t i = 0; i < m; i++) { /* of the last: a stop outside */
        const double u = predesign_draw(chance);
        const bool has_stop = try->stop == i + 1 || i + 1 == m;
        x[2 * m + i] = has_stop ? 0.1 + 0.15 * u : 0.03 + 0.2 * u * u;
    }
    for (size_t j = 0; j < 2 * m; j++) {
        x[j] = fmax(-wish->curvature, fmin(wish->curvature, x[j]));
    }
}

/* -------- thin elements made thick -------- */

static double predesign_sag(double c, double r)
{
    return c * r * r / (1 + sqrt(fmax(1 - c * c * r * r, 0.04)));
}

/* Distance of the paraxial image behind the last surface. */
static double predesign_back(const struct predesign *design, double vergence)
{
    double y = 1, u = vergence;
    for (size_t i = 0; i < design->elements; i++) {
        const double n = design->index[i];
        u = (u - y * design->curvature[2 * i] * (n - 1)) / n;
        y += u * design->center[i];
        u = n * u - y * design->curvature[2 * i + 1] * (1 - n);
        y += i + 1 < design->elements ? u * design->gap[i] : 0;
    }
    return -y / u;
}

static void predesign_thicken(const struct predesign_try *try, const double *x,
                              struct predesign *design)
{
    const struct predesign_wish *wish = try->wish;
    const size_t m = wish->elements;
    const double r = wish->clear / 2, outside = x[3 * m - 1];
    *design = (struct predesign){.elements = m, .stop = try->stop};
    memcpy(design->curvature, x, 2 * m * sizeof *x);
    memcpy(design->index, try->index, sizeof design->index);
    memcpy(design->abbe, try->abbe, sizeof design->abbe);
    for (size_t i = 0; i < m; i++) {
        const double *c = &design->curvature[2 * i];
        const double edge = wish->center[0] + predesign_sag(c[0], r) - predesign_sag(c[1], r);
        design->center[i] = fmin(fmax(edge, wish->center[0]), wish->center[1]);
    }
    for (size_t i = 0; i + 1 < m; i++) {
        const double *c = &design->curvature[2 * i + 1];
        const double planes = 0.3 * (design->center[i] + design->center[i + 1]);
        const double contact = wish->gap[0] + predesign_sag(c[0], r) - predesign_sag(c[1], r);
        const double least = fmax(contact, wish->gap[0] * (design->stop == i + 1 ? 2 : 1));
        design->gap[i] = fmin(fmax(x[2 * m + i] - planes, least), wish->gap[1]);
    }
    const double back = predesign_back(design, wish->vergence);
    design->before = outside;
    if (try->stop > 0 && try->stop < m) {
        design->before = design->gap[try->stop - 1] / 2;
    }
    design->gap[m - 1] = fmin(fmax(back, fmax(wish->back, wish->gap[0])), 2 * wish->track);
    if (try->stop == m) {
        design->before = fmin(design->before, design->gap[m - 1] / 2);
    }
}

bool predesign_find(const struct predesign_wish *wish, size_t stop, uint64_t seed, uint32_t number,
                    struct arena *arena, struct predesign *design)
{
    struct predesign_chance chance = {seed, number, 0};
    const size_t m = wish->elements, n = predesign_number_count(wish);
    double low[MOST_NUMBERS], high[MOST_NUMBERS], scale[MOST_NUMBERS], best = INFINITY;
    enum solver_side sides[MOST_RESIDUALS] = {0};
    sides[1] = sides[2] = SIDE_ABOVE;
    for (size_t j = 0; j < n; j++) {
        const bool bends = j < 2 * m;
        low[j] = bends ? -wish->curvature : wish->gap[0];
        high[j] = bends ? wish->curvature : wish->gap[1];
        scale[j] = bends ? 1 : 0.1;
    }
    for (int i = 0; i < TRIES; i++) {
        struct predesign_try try = {.wish = wish, .stop = stop};
        double x[MOST_NUMBERS];
        struct solver_summary summary;
        struct error ignored;
        const struct solver_problem problem = {.parameter_count = n,
                                               .residual_count = WHOLE + EACH * 2 * m,
                                               .evaluate = predesign_evaluate,
                                               .context = &try,
                                               .low = low,
                                               .high = high,
                                               .scale = scale,
                                               .sides = sides};
        const struct solver_options options = {.iterations = STEPS, .function = 1e-4, .lean = true};
        const struct arena_mark mark = arena_mark(arena);
        predesign_guess(&try, &chance, x);
        for (size_t j = 0; j < n; j++) {
            x[j] = fmax(low[j], fmin(high[j], x[j]));
        }
        if (solver_run(&problem, &options, x, arena, &summary, &ignored) &&
            summary.final_cost < best) {
            best = summary.final_cost;
            predesign_thicken(&try, x, design);
        }
        arena_reset(arena, mark);
    }
    return isfinite(best);
}
