/* trace/precise.h - one exact ray in any kind of number: define REAL before including it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PRECISE_H
#define LENSCALC_TRACE_PRECISE_H

#include "trace/kernel/search.h"
#include "trace/verify.h"

#include <math.h>

#ifndef REAL
#define REAL long double
#endif

/*
 * The algorithm of trace/kernel/kernel.c, one ray at a time, with all digits of the decimals that
 * the lens was given in. trace/verify.c has it in 64 bits, trace/verify_quad.c and tests in 113.
 */
struct precise_ray {
    REAL x[3], p[3]; /* mm, n times the cosines */
    REAL path;
    enum ray_status status;
    size_t surface;
};

static inline REAL precise_of(struct pair value)
{
    return (REAL)value.hi + (REAL)value.lo;
}

/* NaN of what is negative. */
static inline REAL precise_root(REAL x)
{
    REAL y = (REAL)sqrtl((long double)x);
    return y > 0 ? ((y + x / y) / 2 + x / ((y + x / y) / 2)) / 2 : y;
}

/* Taylor's series; angles are within a few turns. */
static inline void precise_turn(REAL angle, REAL *cosine, REAL *sine)
{
    REAL term = 1;
    *cosine = *sine = 0;
    for (int i = 0; i < 80; i++) {
        REAL *sum = i % 2 == 0 ? cosine : sine;
        *sum += i % 4 < 2 ? term : -term;
        term *= angle / (i + 1);
    }
}

static inline void precise_rotate(REAL v[3], int axis, REAL angle)
{
    REAL cosine, sine;
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    precise_turn(angle, &cosine, &sine);
    REAL u = v[a], w = v[b];
    v[a] = cosine * u + sine * w;
    v[b] = cosine * w - sine * u;
}

/* Into the frame of a displacement at distance z, or back out of it. */
static inline void precise_move(struct precise_ray *ray, const struct displacement *to, REAL z)
{
    ray->x[0] -= precise_of(to->decenter[0].value);
    ray->x[1] -= precise_of(to->decenter[1].value);
    ray->x[2] -= z;
    for (int axis = 0; axis < 3; axis++) {
        precise_rotate(ray->x, axis, precise_of(to->tilt[axis].value));
        precise_rotate(ray->p, axis, precise_of(to->tilt[axis].value));
    }
}

static inline void precise_move_back(struct precise_ray *ray, const struct displacement *to)
{
    for (int axis = 2; axis >= 0; axis--) {
        precise_rotate(ray->x, axis, -precise_of(to->tilt[axis].value));
        precise_rotate(ray->p, axis, -precise_of(to->tilt[axis].value));
    }
    ray->x[0] += precise_of(to->decenter[0].value);
    ray->x[1] += precise_of(to->decenter[1].value);
}

/* A surface, F = c (u + K w^2)/2 - w with w = z - S(u). */
struct precise_shape {
    REAL c, K, coefficient[LENS_COEFFICIENTS], wx, wy;
    bool has_series, has_odd;
};

static inline struct precise_shape precise_shape_of(const struct surface *surface)
{
    const double *weight = surface_section(surface)->weight;
    struct precise_shape shape = {
        .K = 1 + precise_of(surface->conic.value), .wx = (REAL)weight[0], .wy = (REAL)weight[1]};
    if (!surface_has(surface, SURFACE_HAS_CURVE)) {
        return shape;
    }
    if (surface->has_curvature) {
        shape.c = precise_of(surface->curvature.value);
    } else if (!surface->is_plane) {
        shape.c = 1 / precise_of(surface->radius.value);
    }
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        shape.coefficient[i] = precise_of(surface->coefficient[i].value);
        shape.has_series = shape.has_series || shape.coefficient[i] != 0;
        shape.has_odd = shape.has_odd || (i >= LENS_EVEN && shape.coefficient[i] != 0);
    }
    return shape;
}

/* F and the normal at a point. */
static inline REAL precise_normal(const struct precise_shape *shape, const REAL x[3], REAL N[3])
{
    REAL u = shape->wx * x[0] * x[0] + shape->wy * x[1] * x[1], S = 0, slope = 0;
    for (int i = LENS_EVEN - 1; i >= 0; i--) {
        slope = slope * u + (i + 1) * shape->coefficient[i];
        S = (S + shape->coefficient[i]) * u;
    }
    if (shape->has_odd) {
        REAL r = precise_root(u), odd = 0, growth = 0;
        for (int i = LENS_ODD - 1; i >= 0; i--) {
            odd = odd * u + shape->coefficient[LENS_EVEN + i];
            growth = growth * u + (2 * i + 1) * shape->coefficient[LENS_EVEN + i] / 2;
        }
        S += r * odd;
        slope += r > 0 ? growth / r : 0;
    }
    REAL w = x[2] - S, f = 1 - shape->c * shape->K * w, G = shape->c + 2 * f * slope;
    N[0] = -shape->wx * G * x[0];
    N[1] = -shape->wy * G * x[1];
    N[2] = f;
    return shape->c * (u + shape->K * w * w) / 2 - w;
}

static inline void precise_advance(struct precise_ray *ray, REAL d, REAL n2)
{
    for (int i = 0; i < 3; i++) {
        ray->x[i] += d * ray->p[i];
    }
    ray->path += n2 * d;
}

/* Newton's method from here; is the ray at the front of the surface then? */
static inline bool precise_newton(struct precise_ray *ray, const struct precise_shape *shape,
                                  REAL direction, REAL n2, REAL N[3])
{
    REAL *x = ray->x, *p = ray->p;
    for (int i = 0; i < 12 && shape->has_series; i++) {
        REAL F = precise_normal(shape, x, N);
        precise_advance(ray, F / (N[0] * p[0] + N[1] * p[1] + N[2] * p[2]), n2);
    }
    precise_normal(shape, x, N);
    return direction * (N[0] * p[0] + N[1] * p[1] + N[2] * p[2]) > 0 && N[2] > 0;
}

/* From where the search of the kernels, in 53 bits, says that the ray meets an asphere. */
static inline bool precise_search(struct precise_ray *ray, const struct precise_shape *shape,
                                  const struct step *step, REAL direction, REAL n2, REAL N[3])
{
    double point[3], along[3];
    for (int i = 0; i < 3; i++) {
        point[i] = (double)ray->x[i];
        along[i] = (double)ray->p[i];
    }
    double d = search_meet(step, point, along);
    if (!isfinite(d)) {
        return false;
    }
    precise_advance(ray, (REAL)d, n2);
    return precise_newton(ray, shape, direction, n2, N);
}

/* To the surface; false where the ray does not meet it. */
static inline bool precise_meet(struct precise_ray *ray, const struct precise_shape *shape,
                                const struct step *step, REAL direction, REAL n2, REAL N[3])
{
    REAL *x = ray->x, *p = ray->p;
    bool steep = direction * p[2] > 0 && 16 * p[2] * p[2] > n2;
    REAL over = x[0] * p[0] + x[1] * p[1] + x[2] * p[2];
    precise_advance(ray, steep ? -x[2] / p[2] : -over / n2, n2);
    const struct precise_ray near = *ray; /* the search has 53 bits only */
    REAL cx = shape->c * shape->wx, cy = shape->c * shape->wy, cz = shape->c * shape->K;
    REAL C = cx * x[0] * x[0] + cy * x[1] * x[1] + cz * x[2] * x[2] - 2 * x[2];
    REAL B = p[2] - (cx * x[0] * p[0] + cy * x[1] * p[1] + cz * x[2] * p[2]);
    REAL A = cx * p[0] * p[0] + cy * p[1] * p[1] + cz * p[2] * p[2], disc = B * B - A * C;
    REAL D = shape->has_series && disc < 0 ? 0 : precise_root(disc);
    precise_advance(ray, C / (B + direction * D), n2);
    if (precise_newton(ray, shape, direction, n2, N)) {
        return true;
    }
    *ray = near;
    return shape->has_series && precise_search(ray, shape, step, direction, n2, N);
}

/* Bend the ray at a surface with normal N; false where it is totally reflected. */
static inline bool precise_bend(struct precise_ray *ray, const REAL N[3], bool reflects,
                                REAL direction, REAL n1, REAL n2)
{
    REAL *p = ray->p, M = N[0] * N[0] + N[1] * N[1] + N[2] * N[2];
    REAL D = N[0] * p[0] + N[1] * p[1] + N[2] * p[2];
    REAL E2 = D * D + (n2 - n1) * (n2 + n1) * M;
    if (!reflects && !(E2 >= 0)) {
        return false;
    }
    REAL g = reflects ? -2 * D / M : (direction * precise_root(E2) - D) / M;
    for (int i = 0; i < 3; i++) {
        p[i] += g * N[i];
    }
    return true;
}

/* The slopes behind a thick lens, and on to the plane of H'; see optics/thick_lens. */
static inline void precise_thick(struct precise_ray *ray, const struct system *system, size_t i,
                                 REAL direction, REAL n1, REAL n2)
{
    const struct lens *lens = system->lens;
    const struct surface *surface = &lens->surfaces[i];
    REAL power = 1 / precise_of(surface->focal.value);
    REAL u[2], w[2], square = 0, d = 0, near = 0;
    if (!lens->object_is_infinite) {
        REAL distance = precise_of(lens->object.value);
        for (size_t k = 0; k < i; k++) {
            distance += precise_of(surface_advance(&lens->surfaces[k]));
        }
        near = 1 / distance;
    }
    for (int k = 0; k < 2; k++) {
        u[k] = ray->p[k] / ray->p[2];
        w[k] = u[k] - ray->x[k] * near;
        square += w[k] * w[k];
    }
    for (int k = 2; k >= 0; k--) {
        d = square * (d + precise_of(surface->distortion[k].value));
    }
    for (int k = 0; k < 2; k++) {
        u[k] = (n1 * (u[k] + w[k] * d) - direction * power * ray->x[k]) / n2;
    }
    ray->p[2] = direction * n2 / precise_root(1 + u[0] * u[0] + u[1] * u[1]);
    ray->p[0] = u[0] * ray->p[2];
    ray->p[1] = u[1] * ray->p[2];
    ray->x[2] = system->options.reverse ? 0 : precise_of(surface->hiatus.value);
}

/* From the surface before it in the order of light into the frame of a surface's vertex. */
static inline void precise_transfer(struct precise_ray *ray, const struct system *system, size_t i)
{
    const struct surface *surfaces = system->lens->surfaces;
    if (system->options.reverse) {
        if (i + 1 < system->lens->surface_count) {
            if (surfaces[i + 1].coordinate_break != NULL) {
                precise_move_back(ray, surfaces[i + 1].coordinate_break);
            }
            ray->x[2] += precise_of(surface_advance(&surfaces[i]));
        }
        return;
    }
    REAL z = i > 0 ? precise_of(surface_advance(&surfaces[i - 1])) : 0;
    if (surfaces[i].coordinate_break != NULL) {
        precise_move(ray, surfaces[i].coordinate_break, z);
    } else {
        ray->x[2] -= z;
    }
}

static inline bool precise_surface(struct precise_ray *ray, const struct system *system, size_t i)
{
    const struct surface *surface = &system->lens->surfaces[i];
    struct precise_shape shape = precise_shape_of(surface);
    bool reflects = surface_reflects(surface), reverse = system->options.reverse;
    REAL n1 = precise_of(system->n[reverse ? i + 1 : i]);
    REAL n2 = precise_of(system->n[reverse ? i : i + 1]), N[3];
    precise_transfer(ray, system, i);
    if (surface->decentre != NULL) {
        precise_move(ray, surface->decentre, 0);
    }
    REAL direction = (REAL)system->direction[i] * (reverse && !reflects ? -1 : 1);
    bool is_thick = surface_has(surface, SURFACE_HAS_FOCAL);
    if (is_thick && reverse) {
        ray->x[2] -= precise_of(surface->hiatus.value); /* light comes to H' first */
    }
    const struct step *step = &system->steps[system->begin[system_place(system, i)]];
    while (step->kind == STEP_MOVE) {
        step++;
    }
    bool met = precise_meet(ray, &shape, step, direction, n1 * n1, N);
    bool good = met && (is_thick || precise_bend(ray, N, reflects, direction, n1, n2));
    if (met && is_thick) {
        precise_thick(ray, system, i, direction, n1, n2);
    }
    if (!good && ray->status == RAY_OK) {
        ray->status = met ? RAY_TOTAL_REFLECTION : RAY_MISS;
        ray->surface = i + 1;
    }
    if (surface->decentre != NULL) {
        precise_move_back(ray, surface->decentre);
    }
    return good;
}

/* Through the system; clear apertures are not looked at. False where the ray is lost. */
static inline bool precise_trace(struct precise_ray *ray, const struct system *system)
{
    size_t count = system->lens->surface_count;
    for (size_t place = 0; place < count; place++) {
        if (!precise_surface(ray, system, system_surface(system, place))) {
            return false;
        }
    }
    if (system->places > count) {
        bool reverse = system->options.reverse;
        REAL n = precise_of(system->n[reverse ? 0 : count]);
        /* counted from the last vertex, of a thick lens from H' */
        const struct surface *last = &system->lens->surfaces[count - 1];
        ray->x[2] -= (REAL)system->options.image + (reverse ? 0 : precise_of(surface_hiatus(last)));
        precise_advance(ray, -ray->x[2] / ray->p[2], n * n);
    }
    return true;
}

static inline struct pair precise_pair(REAL value)
{
    const double high = (double)value;
    return (struct pair){high, (double)(value - (REAL)high)};
}

/* A ray from a point, along a direction of any length, through the system; see trace/verify.h. */
static inline struct precise_end precise_end_of(const struct system *system, const double point[3],
                                                const double direction[3])
{
    const size_t count = system->lens->surface_count;
    const bool reverse = system->options.reverse;
    const REAL first = precise_of(system->n[reverse ? count : 0]);
    const REAL last = precise_of(system->n[reverse ? 0 : count]);
    struct precise_ray ray = {.path = 0};
    REAL square = 0;
    for (int i = 0; i < 3; i++) {
        square += (REAL)direction[i] * (REAL)direction[i];
    }
    for (int i = 0; i < 3; i++) {
        ray.x[i] = (REAL)point[i];
        ray.p[i] = first * (REAL)direction[i] / precise_root(square);
    }
    const bool arrived = precise_trace(&ray, system);
    struct precise_end end = {.status = ray.status, .surface = ray.surface};
    for (int i = 0; i < 3; i++) {
        end.point[i] = arrived ? precise_pair(ray.x[i]) : pair_of(NAN);
        end.cosine[i] = arrived ? precise_pair(ray.p[i] / last) : pair_of(NAN);
    }
    return end;
}

#endif
