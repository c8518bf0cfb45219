/* tests/stress/family_aim.c - rays aimed at the stop: never a wrong one, none given up for nothing. */
/* SPDX-License-Identifier: MIT */
#include "quad_ray.h"

#include "file/lens_file.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A lens, a field of it, and the stop. */
struct aim_trial {
    struct drawn_lens drawn;
    struct quad_lens numbers;
    struct lens lens;
    struct system system;
    struct beam beam;
    double radius, height; /* of the stop; of what is about the axis, mm */
    bool is_meridional;
};

static bool aim_trial_open(struct trial *trial, struct aim_trial *one)
{
    const double size = trial_chance(trial, 0.3) ? trial_magnitude(trial, 1e-3, 1e3) : 1;
    const bool strong = trial_chance(trial, 0.4), bare = trial_chance(trial, 0.6);
    const struct drawn_scale scale = {
        .least = 1,
        .most = 9,
        .radius = {(strong ? 8 : 40) * size, (strong ? 60 : 400) * size},
        .thickness = {0.1 * size, 15 * size},
        .index = {1.3, 2},
        .object = {40 * size, 1e5 * size},
        .planes = 0.1,
        .air = 0.45,
        .far = 0.6,
        .conics = bare ? 0 : 0.3,
        .aspheres = bare ? 0 : 0.2,
        .tilts = bare ? 0 : 0.1,
        .height = 8 * size};
    struct error error = {0};
    drawn_lens_draw(trial, &scale, &one->drawn);
    one->height = scale.height;
    one->radius = trial_magnitude(trial, 0.2, strong ? 25 : 8) * size;
    one->drawn.clear[one->drawn.stop] = 2 * one->radius;
    one->is_meridional = trial_chance(trial, 0.6);
    const double widest = trial_chance(trial, 0.5) ? 0.3 : 1.2, d = strtod(one->drawn.object, NULL);
    const double field[2] = {one->is_meridional ? 0 : trial_between(trial, -widest, widest),
                             trial_between(trial, -widest, widest)};
    const double point[3] = {d * tan(field[0]), d * tan(field[1]), -d};
    one->beam = beam_from_infinity(field, 1);
    const char *lens = drawn_lens_write(&one->drawn, &trial->arena);
    char *text = arena_array(&trial->arena, strlen(lens) + 200, 1);
    sprintf(text, "%sfield %.17g %.17g\n", lens, field[0], field[1]);
    trial->about = text;
    quad_lens_of(&one->drawn, &one->numbers);
    const struct system_options options = system_options_default();
    return trial_verdict(
        trial,
        (d == 0 || beam_from_point(point, 1, &one->beam, &error)) &&
            lens_read("stress", text_of(lens), NULL, &trial->arena, &one->lens, &error) &&
            system_compile(&one->lens, 0.55, &options, &trial->arena, &one->system, &error),
        "%s", error.message);
}

/* -------- the stop in 113 bits -------- */

struct stop_question {
    const struct aim_trial *one;
    const double *at;
};

/* Where the ray of a beam crosses it; beam coordinates move as numbers do. */
static bool stop_find(const struct quad_lens *lens, const struct quad_nudge *nudge,
                      const void *context, quad *figures)
{
    const struct stop_question *question = context;
    struct quad_ray ray = quad_ray_of_beam(&question->one->beam, question->at);
    for (int i = 0; i < 3 && nudge != NULL && nudge->component == i; i++) {
        ray.x[i] += nudge->by * ray.x[i];
    }
    if (!quad_ray_to_stop(lens, lens->stop, &ray)) {
        return false;
    }
    figures[0] = ray.x[0];
    figures[1] = ray.x[1];
    return true;
}

static bool stop_of(const struct aim_trial *one, const quad at[2], quad place[2])
{
    const double coordinates[2] = {(double)at[0], (double)at[1]};
    struct quad_ray ray = quad_ray_of_beam(&one->beam, coordinates);
    const bool far = isinf(one->beam.distance);
    /* the rest of the coordinates below 53 bits */
    quad square = 0;
    for (int i = 0; i < 3; i++) {
        const quad a = (at[0] - (quad)coordinates[0]) * (quad)one->beam.across[0][i];
        const quad b = (at[1] - (quad)coordinates[1]) * (quad)one->beam.across[1][i];
        ray.x[i] += a + b;
        ray.d[i] = far ? ray.d[i] : ray.x[i] + (quad)one->beam.distance * (quad)one->beam.axis[i];
        square += ray.d[i] * ray.d[i];
    }
    for (int i = 0; i < 3; i++) {
        ray.d[i] /= quad_root(square);
    }
    if (!quad_ray_to_stop(&one->numbers, one->numbers.stop, &ray)) {
        return false;
    }
    place[0] = ray.x[0];
    place[1] = ray.x[1];
    return true;
}

/* d(place)/d(at), by differences. */
static bool stop_slopes(const struct aim_trial *one, const quad at[2], const quad here[2],
                        quad slopes[4])
{
    const quad h = (quad)(one->height * 1e-14);
    for (int k = 0; k < 2; k++) {
        quad moved[2] = {at[0], at[1]}, there[2];
        moved[k] += h;
        if (!stop_of(one, moved, there)) {
            return false;
        }
        slopes[k] = (there[0] - here[0]) / h;
        slopes[2 + k] = (there[1] - here[1]) / h;
    }
    return true;
}

/* Newton's method from near by. */
static bool stop_reach(const struct aim_trial *one, const quad goal[2], quad at[2], quad *turn)
{
    for (int i = 0; i < 8; i++) {
        quad here[2], m[4];
        if (!stop_of(one, at, here) || !stop_slopes(one, at, here, m)) {
            return false;
        }
        const quad x = goal[0] - here[0], y = goal[1] - here[1], det = m[0] * m[3] - m[1] * m[2];
        *turn = det;
        if (x * x + y * y < (quad)(one->radius * one->radius) * (quad)1e-36) {
            return true;
        }
        at[0] += (m[3] * x - m[1] * y) / det;
        at[1] += (m[0] * y - m[2] * x) / det;
    }
    return false;
}

/* From the chief ray along the line in the stop, in steps halved where they are too long. */
static bool stop_follow(const struct aim_trial *one, const double chief[2], const double goal[2],
                        quad at[2])
{
    quad way = 0, step = (quad)1 / 16, first = 0;
    at[0] = (quad)chief[0];
    at[1] = (quad)chief[1];
    const quad middle[2] = {0, 0};
    if (!stop_reach(one, middle, at, &first)) {
        return false;
    }
    while (way < 1) {
        step = way + step > 1 ? 1 - way : step;
        const quad next = way + step, place[2] = {next * (quad)goal[0], next * (quad)goal[1]};
        quad there[2] = {at[0], at[1]}, turn = 0;
        if (stop_reach(one, place, there, &turn) && turn * first > 0) {
            at[0] = there[0];
            at[1] = there[1];
            way = next;
            step *= 2;
        } else if (step < (quad)1 / 4096) {
            return false; /* the border of what arrives, or a fold */
        } else {
            step /= 2;
        }
    }
    return true;
}

/* Newton's method alone may lose a ray at one of these, which others find. */
static bool has_aspheres(const struct quad_lens *lens)
{
    bool has = false;
    for (size_t i = 0; i < lens->count; i++) {
        has = has || lens->surfaces[i].A4 != 0;
    }
    return has;
}

/* Is the ray with these coordinates where it should be? */
static void check_arrival(struct trial *trial, const struct aim_trial *one, const double at[2],
                          const double goal[2], const char *what)
{
    const struct stop_question question = {one, at};
    const struct quad_question sensitivity = {stop_find, &question, 2, (quad)1e-17};
    quad place[2];
    double sums[2];
    const bool arrives = stop_find(&one->numbers, NULL, &question, place);
    if (!arrives && has_aspheres(&one->numbers)) {
        trial_skip(trial);
        return;
    }
    if (!trial_verdict(trial, arrives, "%s does not arrive", what)) {
        return;
    }
    if (!quad_sensitivity(&one->numbers, &sensitivity, sums)) {
        trial_skip(trial);
        return;
    }
    for (int k = 0; k < 2; k++) {
        const double off = (double)quad_size(place[k] - (quad)goal[k]);
        const double allowed = 1e-9 * one->radius + 64 * 0x1p-53 * sums[k];
        trial_verdict(trial, off <= allowed, "%s (%.17g, %.17g) is %g off, %g allowed", what, at[0],
                      at[1], off, allowed);
    }
}

/* -------- chief rays -------- */

/* Heights in the stop along a meridional beam; NaN: lost. */
static void scan(struct trial *trial, const struct aim_trial *one, double span, size_t count,
                 double *heights)
{
    const struct rays rays = rays_new(&trial->arena, count);
    for (size_t i = 0; i < count; i++) {
        const double b = span * (2 * (double)i / (double)(count - 1) - 1);
        const struct ray ray = beam_ray(&one->beam, 0, b);
        rays_set(&rays, i, 1, &ray);
    }
    rays_trace_part(&one->system, 0, system_place(&one->system, one->system.stop) + 1, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct ray_block *block = &rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        heights[i] = block->lost[lane] != 0 ? (double)NAN : block->y[lane];
    }
}

/* A ray through the middle of the stop that a dense scan finds; NaN: none. */
static double scan_for_chief(struct trial *trial, const struct aim_trial *one)
{
    enum { COUNT = 20001 };
    const double span = 3 * one->height; /* no lens is looked through farther out */
    double *heights = ARENA_ARRAY(&trial->arena, COUNT, double);
    scan(trial, one, span, COUNT, heights);
    for (size_t i = 1; i < COUNT; i++) {
        if (!(heights[i - 1] * heights[i] <= 0)) {
            continue;
        }
        quad low = (quad)span * (2 * (quad)(double)(i - 1) / (COUNT - 1) - 1);
        quad high = low + (quad)span * 2 / (COUNT - 1), place[2] = {0, 0};
        for (int k = 0; k < 80; k++) {
            const quad middle = (low + high) / 2, at[2] = {0, middle};
            if (!stop_of(one, at, place)) {
                break;
            }
            const bool same = (place[1] < 0) == (heights[i - 1] < 0);
            low = same ? middle : low;
            high = same ? high : middle;
        }
        if (quad_size(place[1]) < (quad)(1e-12 * one->radius)) {
            return (double)low;
        }
    }
    return (double)NAN;
}

void try_chief(struct trial *trial)
{
    static struct aim_trial one;
    struct error error = {0};
    struct aim aim;
    if (!aim_trial_open(trial, &one)) {
        return;
    }
    if (aim_open(&one.system, &one.beam, &trial->arena, &aim, &error)) {
        check_arrival(trial, &one, aim.chief, (const double[2]){0, 0}, "the chief ray");
    } else if (one.is_meridional && lens_is_round(&one.lens)) {
        const double found = scan_for_chief(trial, &one);
        trial_verdict(trial, isnan(found), "%.17g is a chief ray, not: %s", found, error.message);
    } else {
        trial_skip(trial);
    }
}

/* -------- other rays -------- */

void try_aim(struct trial *trial)
{
    enum { POINTS = 6 };
    static struct aim_trial one;
    struct error error = {0};
    struct aim aim;
    struct pupil_point points[POINTS];
    if (!aim_trial_open(trial, &one)) {
        return;
    }
    if (!aim_open(&one.system, &one.beam, &trial->arena, &aim, &error) || !aim.has_chief) {
        trial_skip(trial);
        return;
    }
    for (int i = 0; i < POINTS; i++) {
        const double r = i < 2 ? 1 : sqrt(trial_draw(trial)), turn = trial_between(trial, 0, 6.3);
        points[i] = (struct pupil_point){r * cos(turn), r * sin(turn), 1};
    }
    const struct rays rays = rays_new(&trial->arena, POINTS);
    aim_rays(&aim, points, POINTS, &rays);
    for (int i = 0; i < POINTS; i++) {
        const struct ray ray = rays_get(&rays, (size_t)i, one.system.index_first);
        const double goal[2] = {points[i].x * aim.stop_radius, points[i].y * aim.stop_radius};
        double at[2];
        quad followed[2];
        char what[100];
        snprintf(what, sizeof what, "ray to (%.17g, %.17g)", points[i].x, points[i].y);
        beam_place(&one.beam, ray.point, at);
        const bool is_aimed = ray.status == RAY_OK;
        if (is_aimed) {
            check_arrival(trial, &one, at, goal, what);
        }
        if (is_aimed && i > 2) {
            continue; /* to follow them takes its time */
        }
        const bool exists = stop_follow(&one, aim.chief, goal, followed);
        if (!is_aimed) {
            trial_verdict(trial, !exists, "%s: %s, but (%.17g, %.17g) goes there", what,
                          ray_status_name(ray.status), (double)followed[0], (double)followed[1]);
        } else if (exists) {
            const double off = fmax((double)quad_size(followed[0] - (quad)at[0]),
                                    (double)quad_size(followed[1] - (quad)at[1]));
            trial_verdict(trial, off <= 1e-5 * (one.radius + one.height),
                          "%s is (%.17g, %.17g), but the chief ray's is (%.17g, %.17g)", what,
                          at[0], at[1], (double)followed[0], (double)followed[1]);
        }
    }
}
