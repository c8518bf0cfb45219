/* trace/kernel.c - exact rays: lane loops, compiled once for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/step.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/*
 * Every loop over lanes is free of branches and calls but sqrt, so that the compiler makes vectors
 * of it; the Makefile compiles this file with KERNEL set to sse2, avx2 and avx512. All three do
 * the same operations in the same order on every ray: the same bits.
 */
#define NAME_(name, set) name##_##set
#define NAME(name, set)  NAME_(name, set)
#define INLINE           static inline __attribute__((always_inline))

/* The state of one lane. */
struct lane {
    double x, y, z, p, q, r, path;
};

INLINE struct lane load(const struct ray_block *block, int i, double t)
{
    return (struct lane){block->x[i], block->y[i], block->z[i] - t, block->p[i],
                         block->q[i], block->r[i], block->path[i]};
}

INLINE void store_point(struct ray_block *block, int i, const struct lane *ray, bool path)
{
    block->x[i] = ray->x;
    block->y[i] = ray->y;
    block->z[i] = ray->z;
    if (path) {
        block->path[i] = ray->path;
    }
}

INLINE void store_direction(struct ray_block *block, int i, const struct lane *ray)
{
    block->p[i] = ray->p;
    block->q[i] = ray->q;
    block->r[i] = ray->r;
}

/* What may be written into `lost`; local copies, so that choosing one is no branch. */
struct codes {
    double miss, clipped, reflected;
};

INLINE struct codes codes_of(const struct step *s)
{
    return (struct codes){s->miss, s->clipped, s->reflected};
}

/*
 * On one surface a miss comes before the rim, and the rim before total reflection. Codes fall from
 * surface to surface, so that the largest is the first loss of a ray. A point that is not there has
 * NaN everywhere: not met.
 */
INLINE void note(struct ray_block *block, int i, struct codes codes, bool met, bool inside,
                 bool leaves)
{
    double loss = leaves ? 0 : codes.reflected, old = block->lost[i];
    loss = inside ? loss : codes.clipped;
    loss = met ? loss : codes.miss;
    block->lost[i] = old > loss ? old : loss;
}

/* Go along the ray; d is in units of 1/n. */
INLINE void advance(struct lane *ray, double d)
{
    ray->x += d * ray->p;
    ray->y += d * ray->q;
    ray->z += d * ray->r;
}

/* Keep |p| = n': rounding would add up in the path. No root: the error is a few ulp. */
INLINE void normalize(struct lane *ray, const struct step *s)
{
    double rest = s->n22 - (ray->p * ray->p + ray->q * ray->q + ray->r * ray->r);
    double more = rest * (0.5 / s->n22);
    ray->p += more * ray->p;
    ray->q += more * ray->q;
    ray->r += more * ray->r;
}

/*
 * To the vertex plane, where the quadratic is well conditioned; returns the way. Rays that go along
 * the plane or against it (a fisheye has such) go to where they come nearest to the vertex.
 */
INLINE double hop(struct lane *ray, const struct step *s)
{
    double over = ray->x * ray->p + ray->y * ray->q + ray->z * ray->r;
    double to_plane = -ray->z / ray->r, nearest = -over * (1 / s->n11);
    bool steep = s->direction * ray->r * fabs(ray->r) * 16 > s->n11;
    double d = steep ? to_plane : nearest, z = ray->z + d * ray->r;
    ray->x += d * ray->p;
    ray->y += d * ray->q;
    ray->z = steep ? 0 : z;
    return d;
}

INLINE void plane(struct ray_block *block, const struct step *s, bool path, bool refracts)
{
    const struct codes codes = codes_of(s);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        struct lane ray = load(block, i, s->t);
        double d = -ray.z / ray.r, D = s->direction * ray.r, D2 = D * D + s->dn;
        ray.x += d * ray.p;
        ray.y += d * ray.q;
        ray.z = 0;
        ray.path += s->n11 * d;
        bool inside = ray.x * ray.x + ray.y * ray.y <= s->clear2;
        if (refracts) {
            ray.r = s->direction * sqrt(D2);
            if (path) {
                normalize(&ray, s);
            }
            store_direction(block, i, &ray);
        }
        store_point(block, i, &ray, path);
        note(block, i, codes, (D > 0) & (fabs(d) <= DBL_MAX), inside, !refracts | (D2 >= 0));
    }
}

/* In the plane of H: the slopes of the collineation, and on in the plane of H'. */
INLINE void thick(struct ray_block *block, const struct step *s)
{
    const double near = s->near_object, ratio = s->ratio, bend = s->bend;
    const double d1 = s->coefficient[0], d2 = s->coefficient[1], d3 = s->coefficient[2];
    const double forward = s->direction * sqrt(s->n22);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double u = block->p[i] / block->r[i], v = block->q[i] / block->r[i];
        double wu = u - block->x[i] * near, wv = v - block->y[i] * near;
        double w2 = wu * wu + wv * wv, d = w2 * (d1 + w2 * (d2 + w2 * d3));
        u = ratio * (u + wu * d) - bend * block->x[i];
        v = ratio * (v + wv * d) - bend * block->y[i];
        double r = forward / sqrt(1 + (u * u + v * v));
        block->p[i] = u * r;
        block->q[i] = v * r;
        block->r[i] = r;
        block->z[i] = s->leave;
    }
}

INLINE void plane_mirror(struct ray_block *block, const struct step *s, bool path)
{
    plane(block, s, path, false);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        block->r[i] = -block->r[i];
    }
}

/* What finding the surface hands to bending the ray there. */
struct found {
    double way[RAYS_BLOCK], bend[RAYS_BLOCK];
};

/* Where lane i meets a sphere, and g = E - D: D = n cos I, E = n' cos I'. */
INLINE void sphere_find(struct ray_block *block, const struct step *s, bool path, bool hops,
                        bool reflects, double direction, struct found *found, int i)
{
    struct lane ray = load(block, i, s->t);
    if (hops) {
        double before = hop(&ray, s);
        ray.path += s->n11 * before;
        store_point(block, i, &ray, path);
    }
    double square = ray.x * ray.x + ray.y * ray.y + ray.z * ray.z;
    double C = s->c * square - 2 * ray.z;
    double B = ray.r - s->c * (ray.x * ray.p + ray.y * ray.q + ray.z * ray.r);
    double disc = B * B - s->cn * C, D = sqrt(disc), E = sqrt(disc + s->dn);
    found->way[i] = C / (B + direction * D);
    found->bend[i] = direction * (reflects ? -2 * D : E - D);
}

/*
 * Go there and bend. z found along a ray has the rounding error of t; near the vertex it has all
 * its digits again from z = c (r^2 + (1+k) z^2)/2, which shrinks the error by c (1+k) z.
 */
INLINE void sphere_bend(struct ray_block *block, const struct step *s, bool path, bool hops,
                        struct codes codes, const struct found *found, int i)
{
    struct lane ray = load(block, i, hops ? 0 : s->t);
    double d = found->way[i], g = found->bend[i], gc = g * s->c;
    advance(&ray, d);
    double r2 = ray.x * ray.x + ray.y * ray.y;
    ray.z = hops ? ray.z : 0.5 * s->c * (r2 + ray.z * ray.z);
    ray.path += s->n11 * d;
    double normal = 1 - s->c * ray.z;
    ray.p -= gc * ray.x;
    ray.q -= gc * ray.y;
    ray.r += g * normal;
    if (path) {
        normalize(&ray, s);
    }
    store_point(block, i, &ray, path);
    store_direction(block, i, &ray);
    /* no root, no number: total reflection */
    note(block, i, codes, normal > 0, r2 <= s->clear2, g == g);
}

/* Lanes that are bent this far behind those that are being found: roots and sums overlap. */
enum { BEHIND = 32 };

INLINE void sphere(struct ray_block *restrict block, const struct step *restrict step, bool path,
                   bool hops, bool reflects, bool forward)
{
    const struct step s = *step;
    const double direction = forward ? 1 : s.direction;
    const struct codes codes = codes_of(&s);
    _Alignas(64) struct found found;
    for (int i = 0; i < BEHIND; i++) {
        sphere_find(block, &s, path, hops, reflects, direction, &found, i);
    }
    for (int i = BEHIND; i < RAYS_BLOCK; i++) {
        sphere_find(block, &s, path, hops, reflects, direction, &found, i);
        sphere_bend(block, &s, path, hops, codes, &found, i - BEHIND);
    }
    for (int i = RAYS_BLOCK - BEHIND; i < RAYS_BLOCK; i++) {
        sphere_bend(block, &s, path, hops, codes, &found, i);
    }
}

/* The same with any normal (-gx x, -gy y, f): g N is added to p. */
INLINE void bend(struct lane *ray, const struct step *s, double D, double D2, double N2, double gx,
                 double gy, double f, bool path, bool reflects)
{
    double g = s->direction * (reflects ? -2 * D : sqrt(D2) - D) / N2;
    ray->p -= g * gx * ray->x;
    ray->q -= g * gy * ray->y;
    ray->r += g * f;
    if (path) {
        normalize(ray, s);
    }
}

INLINE void conic(struct ray_block *block, const struct step *s, bool path, bool hops,
                  bool reflects, bool cylinder)
{
    const double c = s->c, cx = cylinder ? c * s->weight_x : c, cy = cylinder ? c * s->weight_y : c;
    const double ck = c * s->one_k;
    const struct codes codes = codes_of(s);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        struct lane ray = load(block, i, s->t);
        double before = hops ? hop(&ray, s) : 0;
        /* intersect */
        double C = cx * ray.x * ray.x + cy * ray.y * ray.y + ck * ray.z * ray.z - 2 * ray.z;
        double B = ray.r - (cx * ray.x * ray.p + cy * ray.y * ray.q + ck * ray.z * ray.r);
        double A = cylinder ? cx * ray.p * ray.p + cy * ray.q * ray.q + ck * ray.r * ray.r
                            : c * (s->n11 + s->k * ray.r * ray.r);
        double disc = B * B - A * C, D = sqrt(disc), d = C / (B + s->direction * D);
        advance(&ray, d);
        double kz = ck * ray.z;
        double sag = 0.5 * (cx * ray.x * ray.x + cy * ray.y * ray.y + kz * ray.z);
        bool keep = hops | (fabs(kz) > 1);
        ray.z = keep ? ray.z : sag;
        ray.path += s->n11 * (before + d);
        double f = 1 - ck * ray.z, gx = cx * ray.x, gy = cy * ray.y;
        double N2 = gx * gx + gy * gy + f * f, D2 = disc + s->dn * N2;
        bend(&ray, s, D, D2, N2, cx, cy, f, path, reflects);
        bool inside = ray.x * ray.x + ray.y * ray.y <= s->clear2;
        store_point(block, i, &ray, path);
        store_direction(block, i, &ray);
        note(block, i, codes, f > 0, inside, D2 >= 0);
    }
}

/* The base conic of an asphere: where Newton starts. Rays that pass it by start at its rim. */
INLINE void to_base(struct ray_block *block, const struct step *s, bool path, bool trough)
{
    const double cx = trough ? s->c * s->weight_x : s->c, cy = trough ? s->c * s->weight_y : s->c;
    const double ck = s->c * s->one_k;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        struct lane ray = load(block, i, s->t);
        double before = hop(&ray, s);
        double C = cx * ray.x * ray.x + cy * ray.y * ray.y + ck * ray.z * ray.z - 2 * ray.z;
        double B = ray.r - (cx * ray.x * ray.p + cy * ray.y * ray.q + ck * ray.z * ray.r);
        double A = cx * ray.p * ray.p + cy * ray.q * ray.q + ck * ray.r * ray.r;
        double disc = B * B - A * C, D = sqrt(disc < 0 ? 0 : disc);
        double d = C / (B + s->direction * D);
        advance(&ray, d);
        ray.path += s->n11 * (before + d);
        store_point(block, i, &ray, path);
    }
}

/* S and dS/du of the polynomial at u. */
INLINE void polynomial(const struct step *s, int terms, double u, double *S, double *slope)
{
    double value = s->coefficient[terms - 1], growth = s->slope[terms - 1];
    for (int i = terms - 2; i >= 0; i--) {
        value = value * u + s->coefficient[i];
        growth = growth * u + s->slope[i];
    }
    *S = value * u;
    *slope = growth;
}

/* Of the surface F = c (u + (1+k) w^2)/2 - w = 0, w = z - S(u): value and normal. */
struct shape {
    double F, gx, gy, f;
};

INLINE struct shape shape_of(const struct lane *ray, const struct step *s, int terms, bool trough)
{
    double wx = trough ? s->weight_x : 1, wy = trough ? s->weight_y : 1;
    double u = wx * ray->x * ray->x + wy * ray->y * ray->y, S, slope;
    polynomial(s, terms, u, &S, &slope);
    double w = ray->z - S, f = 1 - s->c * s->one_k * w, g = s->c + 2 * f * slope;
    return (struct shape){0.5 * s->c * (u + s->one_k * w * w) - w, wx * g, wy * g, f};
}

/* 1 for lanes that Newton's method goes on with, as numbers and as their bits. */
union lanes {
    double number[RAYS_BLOCK];
    int64_t bits[RAYS_BLOCK];
};

/* One Newton step for those that are not there yet; are there any after it? */
INLINE int64_t approach(struct ray_block *block, const struct step *s, bool path, int terms,
                        bool trough, union lanes *open)
{
    const double least = 1e-16 * (1 + fabs(s->t)), n2 = s->n11;
    int64_t busy = 0;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        struct lane ray = load(block, i, 0);
        struct shape at = shape_of(&ray, s, terms, trough);
        double slope = at.f * ray.r - (at.gx * ray.x * ray.p + at.gy * ray.y * ray.q);
        double step = at.F / slope, d = open->number[i] != 0 ? step : 0;
        /* convergence is quadratic: after a step of 1e-9 nothing is left to do */
        double limit = 1e-9 * (fabs(ray.x) + fabs(ray.y) + fabs(ray.z)) + least;
        bool more = d * d * n2 > limit * limit;
        advance(&ray, d);
        ray.path += n2 * d;
        open->number[i] = more ? 1 : 0;
        store_point(block, i, &ray, path);
    }
    for (int i = 0; i < RAYS_BLOCK; i++) {
        busy |= open->bits[i];
    }
    return busy;
}

INLINE void leave(struct ray_block *block, const struct step *s, bool path, int terms, bool trough,
                  bool reflects, const union lanes *open)
{
    const struct codes codes = codes_of(s);
    const double unconverged = s->unconverged;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        struct lane ray = load(block, i, 0);
        struct shape at = shape_of(&ray, s, terms, trough);
        double gx = at.gx * ray.x, gy = at.gy * ray.y;
        double N2 = gx * gx + gy * gy + at.f * at.f;
        double D = s->direction * (at.f * ray.r - (gx * ray.p + gy * ray.q));
        double D2 = D * D + s->dn * N2;
        bend(&ray, s, D, D2, N2, at.gx, at.gy, at.f, path, reflects);
        bool inside = ray.x * ray.x + ray.y * ray.y <= s->clear2;
        struct codes own = codes;
        own.miss = open->number[i] == 0 ? codes.miss : unconverged;
        store_direction(block, i, &ray);
        note(block, i, own, (open->number[i] == 0) & (D > 0) & (at.f > 0), inside, D2 >= 0);
    }
}

enum { NEWTON_STEPS = 10 };

INLINE void asphere(struct ray_block *block, const struct step *s, bool path, int terms,
                    bool trough)
{
    _Alignas(64) union lanes open;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        open.number[i] = 1;
    }
    to_base(block, s, path, trough);
    for (int step = 0; step < NEWTON_STEPS; step++) {
        if (!approach(block, s, path, terms, trough, &open)) {
            break;
        }
    }
    if (s->action == ACTION_REFLECT) {
        leave(block, s, path, terms, trough, true, &open);
    } else {
        leave(block, s, path, terms, trough, false, &open);
    }
}

static void move(struct ray_block *block, const struct step *s)
{
    /* copies: the compiler cannot know that the step is not part of the block */
    double m[9], shift[3];
    memcpy(m, s->turn, sizeof m);
    memcpy(shift, s->shift, sizeof shift);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double x = block->x[i] - shift[0], y = block->y[i] - shift[1], z = block->z[i] - shift[2];
        double p = block->p[i], q = block->q[i], r = block->r[i];
        block->x[i] = m[0] * x + m[1] * y + m[2] * z;
        block->y[i] = m[3] * x + m[4] * y + m[5] * z;
        block->z[i] = m[6] * x + m[7] * y + m[8] * z;
        block->p[i] = m[0] * p + m[1] * q + m[2] * r;
        block->q[i] = m[3] * p + m[4] * q + m[5] * r;
        block->r[i] = m[6] * p + m[7] * q + m[8] * r;
    }
}

INLINE void step_plane(struct ray_block *block, const struct step *s, bool path)
{
    if (s->action == ACTION_PASS) {
        plane(block, s, path, false);
    } else if (s->action == ACTION_REFRACT) {
        plane(block, s, path, true);
    } else {
        plane_mirror(block, s, path);
    }
}

INLINE void step_sphere(struct ray_block *block, const struct step *s, bool path)
{
    if (s->action == ACTION_REFLECT) {
        sphere(block, s, path, true, true, false);
    } else if (s->hop || s->direction < 0) {
        sphere(block, s, path, true, false, false);
    } else {
        sphere(block, s, path, false, false, true);
    }
}

INLINE void step_conic(struct ray_block *block, const struct step *s, bool path)
{
    bool cylinder = s->kind == STEP_CYLINDER;
    if (s->action == ACTION_REFLECT) {
        conic(block, s, path, true, true, true);
    } else if (cylinder) {
        conic(block, s, path, true, false, true);
    } else if (s->hop) {
        conic(block, s, path, true, false, false);
    } else {
        conic(block, s, path, false, false, false);
    }
}

INLINE void step_asphere(struct ray_block *block, const struct step *s, bool path)
{
    if (s->kind == STEP_TROUGH) {
        asphere(block, s, path, STEP_TERMS, true);
    } else if (s->terms <= 4) {
        asphere(block, s, path, 4, false);
    } else if (s->terms <= 7) {
        asphere(block, s, path, 7, false);
    } else {
        asphere(block, s, path, STEP_TERMS, false);
    }
}

INLINE void take(struct ray_block *block, const struct step *s, bool path)
{
    switch (s->kind) {
    case STEP_MOVE:
        move(block, s);
        break;
    case STEP_PLANE:
        step_plane(block, s, path);
        break;
    case STEP_THICK:
        plane(block, s, path, false);
        thick(block, s);
        break;
    case STEP_SPHERE:
        step_sphere(block, s, path);
        break;
    case STEP_CONIC:
    case STEP_CYLINDER:
        step_conic(block, s, path);
        break;
    case STEP_ASPHERE:
    case STEP_TROUGH:
        step_asphere(block, s, path);
        break;
    }
}

static void with_path(const struct step *steps, size_t count, struct ray_block *block)
{
    for (size_t i = 0; i < count; i++) {
        take(block, &steps[i], true);
    }
}

static void without_path(const struct step *steps, size_t count, struct ray_block *block)
{
    for (size_t i = 0; i < count; i++) {
        take(block, &steps[i], false);
    }
}

/* NaN for what is lost, but for clipped rays; and nothing that is not finite is on its way. */
static void settle(struct ray_block *block, double miss)
{
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double sum = (block->x[i] + block->y[i] + block->z[i]) +
                     (block->p[i] + block->q[i] + block->r[i]) + block->path[i];
        bool sound = fabs(sum) <= DBL_MAX;
        double old = block->lost[i];
        bool known = (old != 0) | sound;
        block->lost[i] = known ? old : miss;
    }
    int64_t any = 0;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        int64_t bits;
        memcpy(&bits, &block->lost[i], sizeof bits);
        any |= bits;
    }
    if (any == 0) {
        return;
    }
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double sum = (block->x[i] + block->y[i] + block->z[i]) +
                     (block->p[i] + block->q[i] + block->r[i]) + block->path[i];
        /* the remainder of 8: adding and taking away 1.5 x 2^52 rounds to a whole number */
        double eighth = block->lost[i] * 0.125 - 0.4375;
        double kind = block->lost[i] - 8 * ((eighth + 6755399441055744) - 6755399441055744);
        bool keep = ((kind == RAY_OK) | (kind == RAY_CLIPPED)) & (fabs(sum) <= DBL_MAX);
        block->x[i] = keep ? block->x[i] : (double)NAN;
        block->y[i] = keep ? block->y[i] : (double)NAN;
        block->z[i] = keep ? block->z[i] : (double)NAN;
        block->p[i] = keep ? block->p[i] : (double)NAN;
        block->q[i] = keep ? block->q[i] : (double)NAN;
        block->r[i] = keep ? block->r[i] : (double)NAN;
        block->path[i] = keep ? block->path[i] : (double)NAN;
    }
}

void NAME(kernel_trace, KERNEL)(const struct step *steps, size_t count, bool path,
                                struct ray_block *block)
{
    if (count == 0) {
        return;
    }
    if (path) {
        with_path(steps, count, block);
    } else {
        without_path(steps, count, block);
    }
    settle(block, steps[count - 1].miss);
}
