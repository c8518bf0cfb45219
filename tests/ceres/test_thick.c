/* tests/ceres/test_thick.c - thick lenses are found again, with honest errors. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/fit/thick.h"

#include <stdint.h>

__extension__ typedef __float128 quad; /* 113 bits */

enum { MOST = 1000 };

/* Rays with room for everything. */
struct made_rays {
    double x[MOST], y[MOST], p[MOST], q[MOST], x_out[MOST], y_out[MOST], p_out[MOST], q_out[MOST];
    double stop_x[MOST], stop_y[MOST];
    size_t group[MOST];
    struct thick_rays rays;
    struct thick_sums sums;
};

/* Uniform in -1 .. 1, the same every time: splitmix64. */
static double draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

/* Near enough to normal: the sum of twelve. */
static double noise(uint64_t *state)
{
    double sum = 0;
    for (int i = 0; i < 12; i++) {
        sum += draw(state);
    }
    return sum / 2;
}

/* Rays of one lens a group, in turn; through a pupil of radius 20 at 30 mm if it has one. */
static void make_rays(struct made_rays *all, const struct thick_lens *lenses, size_t groups,
                      size_t count, double field, uint64_t seed)
{
    uint64_t state = seed;
    for (size_t i = 0; i < count; i++) {
        const struct thick_lens *lens = &lenses[i % groups];
        double sx = draw(&state), sy = draw(&state);
        double p = field * draw(&state), q = field * draw(&state);
        if (isfinite(lens->object)) { /* from a point of the object */
            double ox = lens->object * p, oy = lens->object * q;
            p = (20 * sx + ox) / (lens->object + 30);
            q = (20 * sy + oy) / (lens->object + 30);
        }
        const struct slope_ray in = {20 * sx - 30 * p, 20 * sy - 30 * q, p, q};
        const struct slope_ray out = thick_lens_map(lens, in);
        all->x[i] = in.x, all->y[i] = in.y, all->p[i] = in.p, all->q[i] = in.q;
        all->x_out[i] = out.x, all->y_out[i] = out.y, all->p_out[i] = out.p, all->q_out[i] = out.q;
        all->stop_x[i] = sx, all->stop_y[i] = sy;
        all->group[i] = i % groups;
    }
    all->rays = (struct thick_rays){.count = count,
                                    .x = all->x,
                                    .y = all->y,
                                    .p = all->p,
                                    .q = all->q,
                                    .x_out = all->x_out,
                                    .y_out = all->y_out,
                                    .p_out = all->p_out,
                                    .q_out = all->q_out,
                                    .group = all->group,
                                    .stop_x = all->stop_x,
                                    .stop_y = all->stop_y};
}

static const double ones[THICK_GROUPS] = {1, 1, 1, 1};

static struct thick_task task_of(const struct made_rays *all)
{
    return (struct thick_task){.sums = &all->sums,
                               .group_count = 1,
                               .index_object = ones,
                               .index_image = ones,
                               .planes = {70, -30},
                               .plane_weights = {1, 1},
                               .object = INFINITY,
                               .start = {.focal = 90, .front = 40, .rear = -20}};
}

static const struct thick_lens plain_lens = {.focal = 100.7163,
                                             .front = 58.3,
                                             .rear = -28.5,
                                             .index_object = 1,
                                             .index_image = 1,
                                             .object = INFINITY};

/* The sums of such rays, then the fit. */
static bool fit_rays(struct made_rays *all, const struct thick_task *task, struct arena *arena,
                     struct thick_fit *fit, struct error *error)
{
    size_t fields = all->rays.field != NULL ? all->rays.field_count : all->rays.count;
    all->sums = thick_sums_open(fields, task->group_count, task->object, arena);
    return thick_sums_add(&all->sums, &all->rays, error) && thick_fit(task, arena, fit, error);
}

static void test_recovered(void)
{
    static struct made_rays all;
    struct arena arena = {0};
    struct thick_fit fit;
    struct error error;
    make_rays(&all, &plain_lens, 1, 300, 0.3, 1);
    const struct thick_task task = task_of(&all);
    CHECK(fit_rays(&all, &task, &arena, &fit, &error));
    CHECK_RELATIVE(fit.parameters[0], 100.7163, 1e-12, "f");
    CHECK_RELATIVE(fit.parameters[1], 58.3, 1e-12, "H");
    CHECK_RELATIVE(fit.parameters[2], -28.5, 1e-12, "H'");
    struct thick_score score = {.weight = 0};
    const struct ray_model model = ray_model_of_thick(MODEL_FITTED, fit.lenses[0], task.planes[0]);
    thick_score_add(&all.rays, &model, task.planes[1], &score);
    CHECK(fit.rms < 1e-12 && score.largest < 1e-11 && fit.rms_second < 1e-12);
    CHECK_TEXT(fit.names[2], "H'");
    arena_free(&arena);
}

/* In water behind, with distortion, colours of their own, and an object near by. */
static void test_recovered_more(void)
{
    static struct made_rays all;
    const double behind[3] = {1.333, 1.343, 1.331};
    struct thick_lens lenses[3];
    for (int g = 0; g < 3; g++) {
        lenses[g] = (struct thick_lens){.focal = -35 - 0.1 * g,
                                        .front = 12 + g,
                                        .rear = 4 - g,
                                        .index_object = 1,
                                        .index_image = behind[g],
                                        .distortion = {-0.2, 0.05, -0.01},
                                        .object = 700};
    }
    struct arena arena = {0};
    struct thick_fit fit;
    struct error error;
    make_rays(&all, lenses, 3, 900, 0.5, 7);
    struct thick_task task = task_of(&all);
    task.group_count = 3;
    task.index_image = behind;
    task.separate = true;
    task.object = 700;
    task.distortions = 3;
    task.start = (struct thick_lens){.focal = -30, .front = 10, .rear = 5};
    CHECK(fit_rays(&all, &task, &arena, &fit, &error));
    CHECK(fit.parameter_count == 12);
    for (int g = 0; g < 3; g++) {
        CHECK_RELATIVE(fit.lenses[g].focal, lenses[g].focal, 1e-10, "f of a colour");
        CHECK_RELATIVE(fit.lenses[g].front, lenses[g].front, 1e-10, "H of a colour");
        CHECK_RELATIVE(fit.lenses[g].rear, lenses[g].rear, 1e-10, "H' of a colour");
    }
    for (int j = 0; j < 3; j++) {
        CHECK_RELATIVE(fit.parameters[9 + j], lenses[0].distortion[j], 1e-8, "distortion");
    }
    CHECK_TEXT(fit.names[3], "f 2");
    CHECK_TEXT(fit.names[11], "d3");
    arena_free(&arena);
}

/* Every term more makes the residual smaller, for rays no thick lens has. */
static void test_nested(void)
{
    static struct made_rays all;
    struct arena arena = {0};
    struct thick_fit fit;
    struct error error;
    double before = INFINITY;
    make_rays(&all, &plain_lens, 1, 400, 0.5, 3);
    for (size_t i = 0; i < 400; i++) {
        double s = all.p[i] * all.p[i] + all.q[i] * all.q[i];
        all.p_out[i] += 0.1 * all.p[i] * s + 1e-5 * all.x[i] * all.x[i];
        all.q_out[i] += 0.1 * all.q[i] * sin(8 * s);
    }
    for (size_t terms = 0; terms <= 3; terms++) {
        struct thick_task task = task_of(&all);
        task.distortions = terms;
        CHECK(fit_rays(&all, &task, &arena, &fit, &error));
        CHECK(fit.summary.final_cost < before);
        before = fit.summary.final_cost;
    }
    arena_free(&arena);
}

/* thick_lens_map in 113 bits, written anew, with the ray's point in a plane. */
static quad point(const double *parameter, const quad change[6], const struct made_rays *all,
                  size_t i, double object, double index, double plane, int section)
{
    quad f = parameter[0] + change[0], front = parameter[1] + change[1];
    quad rear = parameter[2] + change[2], in[2] = {all->x[i], all->y[i]};
    quad slope[2] = {all->p[i], all->q[i]}, w[2], s = 0, d = 0;
    for (int k = 0; k < 2; k++) {
        w[k] =
            isinf(object) ? slope[k] : (slope[k] * (quad)object - in[k]) / ((quad)object + front);
        s += w[k] * w[k];
    }
    for (int j = 2; j >= 0; j--) {
        d = s * (d + parameter[3 + j] + change[3 + j]);
    }
    quad h = in[section] + front * slope[section];
    quad out = (slope[section] + w[section] * d - h / f) / (quad)index;
    return h + ((quad)plane - rear) * out;
}

static void test_derivatives(void)
{
    static struct made_rays all;
    const double objects[2] = {INFINITY, 450}, index[1] = {1.25};
    static double residuals[4 * 50], jacobian[4 * 50 * 6];
    for (int k = 0; k < 2; k++) {
        struct thick_lens lens = plain_lens;
        lens.object = objects[k];
        make_rays(&all, &lens, 1, 50, 0.6, 5);
        struct thick_task task = task_of(&all);
        task.distortions = 3;
        task.object = objects[k];
        task.index_image = index;
        struct arena arena = {0};
        struct error error;
        all.sums = thick_sums_open(50, 1, objects[k], &arena);
        CHECK(thick_sums_add(&all.sums, &all.rays, &error));
        const double at[6] = {80, 20, -10, 0.1, -0.2, 0.3};
        CHECK(thick_residuals(&task, at, residuals, jacobian));
        for (size_t i = 0; i < 50 * 4; i++) {
            double plane = task.planes[i % 4 / 2];
            for (size_t j = 0; j < 6; j++) {
                quad up[6] = {0}, down[6] = {0}, step = at[j] * 1e-9;
                up[j] = step, down[j] = -step;
                quad slope = (point(at, up, &all, i / 4, objects[k], 1.25, plane, (int)(i % 2)) -
                              point(at, down, &all, i / 4, objects[k], 1.25, plane, (int)(i % 2))) /
                             (2 * step);
                CHECK_NEAR(jacobian[6 * i + j], (double)slope, 1e-12 * (1 + fabs((double)slope)),
                           "derivative");
            }
        }
        arena_free(&arena);
    }
}

/* The spread of 400 fits to noisy rays is what each of them states. */
static void test_standard_errors(double pupil_weight, double pupil_noise)
{
    enum { FITS = 400, RAYS = 60 };
    static struct made_rays all;
    double sum[3] = {0}, squares[3] = {0}, stated[3] = {0};
    uint64_t state = 11;
    for (int k = 0; k < FITS; k++) {
        struct arena arena = {0};
        struct thick_fit fit;
        struct error error;
        make_rays(&all, &plain_lens, 1, RAYS, 0.3, 1);
        for (size_t i = 0; i < RAYS; i++) {
            /* independent in both planes: 70 and -30 */
            double image = 0.01 * noise(&state), pupil = pupil_noise * noise(&state);
            all.p_out[i] += (image - pupil) / 100;
            all.x_out[i] += (image * 30 + pupil * 70) / 100;
            image = 0.01 * noise(&state), pupil = pupil_noise * noise(&state);
            all.q_out[i] += (image - pupil) / 100;
            all.y_out[i] += (image * 30 + pupil * 70) / 100;
        }
        struct thick_task task = task_of(&all);
        task.plane_weights[1] = pupil_weight;
        CHECK(fit_rays(&all, &task, &arena, &fit, &error));
        const double truth[3] = {100.7163, 58.3, -28.5};
        for (int j = 0; j < 3; j++) {
            double off = fit.parameters[j] - truth[j];
            sum[j] += off;
            squares[j] += off * off;
            stated[j] += fit.summary.standard_error[j];
        }
        arena_free(&arena);
    }
    for (int j = 0; j < 3; j++) {
        double spread = sqrt(squares[j] / FITS), error = stated[j] / FITS;
        /* a spread of 400 is known to 1/sqrt(800) = 3.5 %: four of these */
        CHECK_NEAR(spread / error, 1, 0.14, "spread over stated error");
        CHECK_NEAR(sum[j] / FITS / error, 0, 0.2, "no bias");
    }
}

static bool fit_pupil(const struct thick_rays *rays, bool exit, bool spherical_aberration,
                      struct arena *arena, struct thick_pupil *pupil, struct error *error)
{
    struct thick_pupil_sums sums = {.rows = 0};
    thick_pupil_add(rays, exit, &sums);
    return thick_fit_pupil(&sums, exit, spherical_aberration, arena, pupil, error);
}

static void test_pupil(void)
{
    static struct made_rays all;
    struct arena arena = {0};
    struct thick_pupil pupil;
    struct error error;
    make_rays(&all, &plain_lens, 1, 200, 0.3, 2);
    CHECK(fit_pupil(&all.rays, false, true, &arena, &pupil, &error));
    CHECK_RELATIVE(pupil.place, 30.0, 1e-11, "entrance pupil");
    CHECK_RELATIVE(pupil.radius, 20.0, 1e-11, "its radius");
    CHECK_NEAR(pupil.spherical_aberration, 0, 1e-10, "no spherical aberration");
    /* its image by the lens, from H: 1/s' = 1/f + 1/(30 - 58.3) */
    CHECK(fit_pupil(&all.rays, true, false, &arena, &pupil, &error));
    double image = 1 / (1 / 100.7163 + 1 / (30 - 58.3));
    CHECK_RELATIVE(pupil.place, image - 28.5, 1e-10, "exit pupil");
    CHECK_RELATIVE(pupil.radius, 20 * image / (30 - 58.3), 1e-10, "its radius");
    /* a radius that grows: the rays move with it */
    for (size_t i = 0; i < 200; i++) {
        double s = all.p[i] * all.p[i] + all.q[i] * all.q[i];
        all.x[i] += 20 * all.stop_x[i] * 0.7 * s;
        all.y[i] += 20 * all.stop_y[i] * 0.7 * s;
    }
    CHECK(fit_pupil(&all.rays, false, true, &arena, &pupil, &error));
    CHECK_RELATIVE(pupil.spherical_aberration, 0.7, 1e-10, "spherical aberration");
    double with = pupil.rms;
    CHECK(fit_pupil(&all.rays, false, false, &arena, &pupil, &error));
    CHECK(pupil.rms > with && pupil.radius_error > 0);
    make_rays(&all, &plain_lens, 1, 50, 0, 2);
    CHECK(!fit_pupil(&all.rays, false, false, &arena, &pupil, &error));
    CHECK(strstr(error.message, "entrance pupil") != NULL);
    arena_free(&arena);
}

static void check_refused(struct made_rays *all, const struct thick_task *task, const char *word)
{
    struct arena arena = {0};
    struct thick_fit fit;
    struct error error;
    CHECK(!fit_rays(all, task, &arena, &fit, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, word) != NULL);
    arena_free(&arena);
}

static void test_refusals(void)
{
    static struct made_rays all;
    make_rays(&all, &plain_lens, 1, 50, 0.2, 4);
    const struct thick_task sound = task_of(&all);
    struct thick_task task = sound;
    all.rays.count = 0;
    check_refused(&all, &task, "no rays");
    all.rays.count = 50;
    task = sound;
    task.start.focal = INFINITY;
    check_refused(&all, &task, "afocal");
    task = sound;
    task.planes[0] = INFINITY;
    check_refused(&all, &task, "infinity");
    task = sound;
    task.planes[1] = task.planes[0];
    check_refused(&all, &task, "one plane");
    task = sound;
    all.rays.weight = (const double[MOST]){0};
    check_refused(&all, &task, "weight");
    all.rays.weight = (const double[MOST]){1, 1, -1};
    check_refused(&all, &task, "ray 3 has the weight -1:");
    all.rays.weight = NULL;
    task = sound;
    all.y_out[7] = NAN;
    check_refused(&all, &task, "ray 8");
    make_rays(&all, &plain_lens, 1, 50, 0, 4);
    task = task_of(&all);
    check_refused(&all, &task, "do not fix H");
}

/* The direction form and the slope form agree; all rays of a point meet in one. */
static void test_map(void)
{
    const struct thick_lens lens = {.focal = 50,
                                    .front = 5,
                                    .rear = -7,
                                    .index_object = 1,
                                    .index_image = 1.5,
                                    .distortion = {-0.3, 0.1, 0.2},
                                    .object = 300};
    uint64_t state = 3;
    /* image distance from H': n'/(1/f - n/(L + H)), height -w n/n' s' (1 + d) */
    double s = 1.5 / (1 / 50.0 - 1 / 305.0), ox = 40, oy = -70, wx = -ox / 305, wy = -oy / 305;
    double w2 = wx * wx + wy * wy, d = w2 * (-0.3 + w2 * (0.1 + w2 * 0.2));
    for (int i = 0; i < 20; i++) {
        double p = 0.3 * draw(&state), q = 0.3 * draw(&state);
        const struct slope_ray in = {ox + 300 * p, oy + 300 * q, p, q};
        const struct slope_ray out = thick_lens_map(&lens, in);
        double z = -7 + s;
        CHECK_NEAR(out.x + z * out.p, wx / 1.5 * s * (1 + d), 1e-12, "image x");
        CHECK_NEAR(out.y + z * out.q, wy / 1.5 * s * (1 + d), 1e-12, "image y");
    }
}

/* Rays bent and moved by known amounts: what they are off in two planes, and by direction. */
static void test_score(void)
{
    static struct made_rays all;
    struct thick_score score = {.weight = 0};
    const double planes[2] = {30, 70}, weights[MOST] = {1, 2, 0.5, 3};
    const struct ray_model model = ray_model_of_thick(MODEL_FITTED, plain_lens, planes[0]);
    double sums[3] = {0}, largest = 0, weight = 0;
    make_rays(&all, &plain_lens, 1, 4, 0.3, 1);
    all.rays.weight = weights;
    for (int i = 0; i < 4; i++) {
        const double came[2] = {all.p_out[i], all.q_out[i]};
        double x = 0.02 * (i + 1), y = -0.03 * i;
        all.x_out[i] += x;
        all.y_out[i] += y;
        all.p_out[i] += 0.2 - 0.1 * i;
        all.q_out[i] += 0.05 * i - 0.3;
        const double p = all.p_out[i] - came[0], q = all.q_out[i] - came[1];
        for (int k = 0; k < 2; k++) {
            const double off = hypot(x + planes[k] * p, y + planes[k] * q);
            sums[k] += weights[i] * off * off;
            largest = k == 0 ? fmax(largest, off) : largest;
        }
        /* the law of cosines, of vectors (p, q, 1) */
        const double a = hypot(hypot(came[0], came[1]), 1),
                     b = hypot(hypot(all.p_out[i], all.q_out[i]), 1), c = hypot(p, q);
        const double turn = acos((a * a + b * b - c * c) / (2 * a * b));
        sums[2] += weights[i] * turn * turn;
        weight += weights[i];
    }
    for (int again = 1; again < 3; again++) { /* the second time it is the mean of both */
        thick_score_add(&all.rays, &model, planes[1], &score);
        CHECK_RELATIVE(score.rms[0], sqrt(sums[0] / weight), 1e-11, "first plane");
        CHECK_RELATIVE(score.rms[1], sqrt(sums[1] / weight), 1e-11, "second plane");
        CHECK_RELATIVE(score.direction, sqrt(sums[2] / weight), 1e-11, "direction");
        CHECK_RELATIVE(score.largest, largest, 1e-11, "largest");
        CHECK_RELATIVE(score.weight, again * weight, 1e-14, "weight");
    }
}

int main(void)
{
    test_map();
    test_score();
    test_recovered();
    test_recovered_more();
    test_nested();
    test_derivatives();
    test_standard_errors(1, 0.01);
    test_standard_errors(THICK_PUPIL_WEIGHT, 0.3);
    test_pupil();
    test_refusals();
    return check_report();
}
