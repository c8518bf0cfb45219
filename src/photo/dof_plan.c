/* photo/dof_plan.c - focus stacks, and equal depth of field on another format. */
/* SPDX-License-Identifier: MIT */
#include "photo/dof_plan.h"

#include <math.h>

#include "photo/dof_solve.h"
#include "photo/given.h"

/* A step that rounding alone would add is not taken. */
#define COUNT_TOLERANCE 1e-9

static bool dof_plan_check_range(const struct dof_setting *a, double near, double far,
                                 double overlap, struct error *error)
{
    struct dof_setting anywhere = *a;
    anywhere.s = INFINITY;
    if (!dof_check(&anywhere, error)) {
        return false;
    }
    if (!(near > a->f)) {
        return fail(error, ERROR_DOMAIN,
                    "{near limit} %.15g mm lies within {the focal length} %.15g mm: no real image",
                    near, a->f);
    }
    if (!(near < far)) {
        return fail(error, ERROR_DOMAIN,
                    "{near limit} %.15g mm must lie before {the far limit} %.15g mm", near, far);
    }
    if (!(overlap >= 0 && overlap <= 0.95)) {
        return fail(error, ERROR_DOMAIN, "{overlap} %.15g must be 0 to 0.95", overlap);
    }
    double h = a->N * a->c / a->f / a->P;
    if (!(h > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{circle of confusion} %.15g mm must be above 0 mm: without blur no number of "
                    "shots is enough",
                    a->c);
    }
    return h < 1 ||
           fail(error, ERROR_DOMAIN,
                "{circle of confusion} %.15g mm must be below the pupil's %.15g mm: any focus "
                "covers everything",
                a->c, a->f * a->P / a->N);
}

bool dof_plan_make(const struct dof_setting *setting, double near, double far, double overlap,
                   struct dof_plan *plan, struct error *error)
{
    if (!dof_plan_check_range(setting, near, far, overlap, error)) {
        return false;
    }
    double f = setting->f, P = setting->P, h = setting->N * setting->c / f / P;
    /* Z'/f of the first and the last focus */
    double first = (f / (near - f) + P) * (1 - h), last = (f / (far - f) + P) * (1 + h);
    double way = log(last / first), step = log1p(-(1 - overlap) * 2 * h / (1 + h));
    double steps = way < 0 ? ceil(way / step - COUNT_TOLERANCE) : 0;
    if (!(steps < DOF_PLAN_LIMIT)) {
        return fail(error, ERROR_DOMAIN,
                    "%.15g shots are needed from %.15g mm to %.15g mm; at most %d are planned",
                    steps + 1, near, far, (int)DOF_PLAN_LIMIT);
    }
    const bool several = steps >= 1;
    *plan = (struct dof_plan){.setting = *setting,
                              .count = (long)steps + 1,
                              .first = several ? first : sqrt(first * last),
                              .log_step = several ? way / steps : 0};
    return true;
}

bool dof_plan_shot(const struct dof_plan *plan, long index, struct dof_setting *shot,
                   struct dof *dof, struct error *error)
{
    if (index < 0 || index >= plan->count) {
        return fail(error, ERROR_DOMAIN, "shot %ld must be 0 to %ld", index, plan->count - 1);
    }
    double f = plan->setting.f;
    double m =
        (plan->first - plan->setting.P) + plan->first * expm1(plan->log_step * (double)index);
    *shot = plan->setting;
    shot->s = m > 0 ? f + f / m : INFINITY;
    return dof_compute(shot, DOF_EXACT, dof, error);
}

bool dof_depth_at(const struct dof_setting *setting, double m, double *depth, struct error *error)
{
    const double N = setting->N, c = setting->c, P = setting->P;
    const double e = isnan(setting->f) ? 0 : N * c / (m * setting->f);
    if (!check_positive("magnification", "", m, error) ||
        !check_positive("f-number", "", N, error) ||
        !check_not_negative("circle of confusion", " mm", c, error) ||
        !check_positive("pupil magnification", "", P, error)) {
        return false;
    }
    *depth = e < 1 ? 2 * N * c * (1 / m + 1 / P) / (m * (1 - e * e)) : (double)INFINITY;
    return true;
}

bool dof_rail_plan(const struct dof_setting *setting, double m, double covered, double overlap,
                   struct dof_rail *rail, struct error *error)
{
    double depth;
    if (!(m > 0 && m < INFINITY && setting->N > 0 && setting->c > 0 && setting->P > 0) ||
        !(covered > 0 && covered < INFINITY)) {
        return fail(error, ERROR_DOMAIN,
                    "a stack on a rail needs a magnification, an f-number, a circle of confusion "
                    "and a depth above 0");
    }
    if (!(overlap >= 0 && overlap <= 0.95)) {
        return fail(error, ERROR_DOMAIN, "an overlap of %.6g is not within 0 to 0.95", overlap);
    }
    if (!dof_depth_at(setting, m, &depth, error)) {
        return false;
    }
    if (isinf(depth)) {
        return fail(error, ERROR_DOMAIN, "one shot covers everything up to infinity");
    }
    const double steps = ceil((covered - depth) / (depth * (1 - overlap)) - COUNT_TOLERANCE);
    if (!(steps < DOF_PLAN_LIMIT)) {
        return fail(error, ERROR_DOMAIN, "that takes more than %d shots", (int)DOF_PLAN_LIMIT);
    }
    const double further = fmax(steps, 0);
    *rail = (struct dof_rail){.depth = depth,
                              .step = further > 0 ? (covered - depth) / further : (double)NAN,
                              .travel = further > 0 ? covered - depth : 0,
                              .count = 1 + (long)further};
    return true;
}

bool dof_equal(const struct dof_setting *setting, double k, struct dof_setting *other,
               struct error *error)
{
    if (!dof_check(setting, error) || !check_positive("ratio of formats", "", k, error)) {
        return false;
    }
    double f = setting->f, s = setting->s;
    struct dof_setting b = *setting;
    b.f = s < INFINITY ? k * f * (s / (s - f + k * f)) : k * f;
    b.c = k * setting->c;
    b.N = setting->N * (b.f / f);
    if (setting->P != 1 && setting->c > 0) { /* 1 as typed: not a computed value */
        struct dof d;
        if (!dof_compute(setting, DOF_EXACT, &d, error)) {
            return false;
        }
        struct dof_targets same = {NAN, NAN, NAN, NAN, NAN};
        if (d.total < INFINITY) {
            same.total = d.total;
        } else {
            same.near = d.near;
        }
        b.N = NAN;
        if (!dof_solve(&b, &same, error)) {
            return false;
        }
    }
    *other = b;
    return dof_check(other, error);
}
