/* trace/kernel/kernel.c - exact rays: lane loops, compiled once for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/kernel/clip.h"
#include "trace/kernel/lanes.h"

#include <stdint.h>

INLINE void plane(struct ray_block *block, const struct step *s, bool path, int lanes,
                  bool refracts)
{
    const struct codes codes = codes_of(s);
    for (int i = 0; i < LANES_OF(lanes); i++) {
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

/* In the plane of H: the slopes of the collineation, and on in the plane of H', or back. */
INLINE void thick(struct ray_block *block, const struct step *s, int lanes)
{
    const double near = s->near_object, ratio = s->ratio, bend = s->bend;
    const double d1 = s->coefficient[0], d2 = s->coefficient[1], d3 = s->coefficient[2];
    const double onward = s->action == ACTION_REFLECT ? -s->direction : s->direction;
    const double forward = onward * sqrt(s->n22);
    for (int i = 0; i < LANES_OF(lanes); i++) {
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

INLINE void plane_mirror(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    plane(block, s, path, lanes, false);
    for (int i = 0; i < LANES_OF(lanes); i++) {
        block->r[i] = -block->r[i];
    }
}

/* Where a ray meets a sphere: d = C/(B + s D), D = n cos I. */
INLINE void sphere_find(struct ray_block *block, const struct step *s, bool path, bool hops,
                        struct found *found, int i)
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
    found->square[i] = B * B - s->cn * C;
    found->numerator[i] = C;
    found->denominator[i] = B;
}

/* g = s (E - D), E = n' cos I'. */
INLINE void sphere_roots(const struct step *s, bool reflects, double direction, struct found *found,
                         int i)
{
    double D = sqrt(found->square[i]), E = sqrt(found->square[i] + s->dn);
    found->denominator[i] += direction * D;
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

INLINE void kernel_sphere(struct ray_block *restrict block, const struct step *restrict step,
                          bool path, int lanes, bool hops, bool reflects, bool forward)
{
    const struct step s = *step;
    const double direction = forward ? 1 : s.direction;
    const struct codes codes = codes_of(&s);
    _Alignas(64) struct found found;
#define FIND(i)  sphere_find(block, &s, path, hops, &found, i)
#define ROOTS(i) sphere_roots(&s, reflects, direction, &found, i)
#define BEND(i)  sphere_bend(block, &s, path, hops, codes, &found, i)
    IN_TURN(lanes, FIND, ROOTS, DIVIDE, BEND);
#undef FIND
#undef ROOTS
#undef BEND
}

static void block_move(struct ray_block *block, const struct step *s, int lanes)
{
    /* copies: the compiler cannot know that the step is not part of the block */
    double m[9], shift[3];
    memcpy(m, s->turn, sizeof m);
    memcpy(shift, s->shift, sizeof shift);
    for (int i = 0; i < LANES_OF(lanes); i++) {
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

INLINE void step_plane(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    if (s->action == ACTION_PASS) {
        plane(block, s, path, lanes, false);
    } else if (s->action == ACTION_REFRACT) {
        plane(block, s, path, lanes, true);
    } else {
        plane_mirror(block, s, path, lanes);
    }
}

INLINE void step_sphere(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    if (s->action == ACTION_REFLECT) {
        kernel_sphere(block, s, path, lanes, true, true, false);
    } else if (s->hop || s->direction < 0) {
        kernel_sphere(block, s, path, lanes, true, false, false);
    } else {
        kernel_sphere(block, s, path, lanes, false, false, true);
    }
}

INLINE void kernel_take(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    switch (s->kind) {
    case STEP_MOVE:
        block_move(block, s, lanes);
        break;
    case STEP_PLANE:
        step_plane(block, s, path, lanes);
        break;
    case STEP_THICK:
        plane(block, s, path, lanes, false);
        thick(block, s, lanes);
        break;
    case STEP_SPHERE:
        step_sphere(block, s, path, lanes);
        break;
    case STEP_CONIC:
    case STEP_CYLINDER:
        NAME(kernel_conic, KERNEL)(block, s, path, lanes);
        break;
    case STEP_ASPHERE:
    case STEP_TROUGH:
    case STEP_ODD:
        NAME(kernel_asphere, KERNEL)(block, s, path, lanes);
        break;
    }
    if (s->clip != NULL) {
        clip_block(s, LANES_OF(lanes), block);
    }
}

static void with_path(const struct step *steps, size_t count, int lanes, struct ray_block *block)
{
    for (size_t i = 0; i < count; i++) {
        kernel_take(block, &steps[i], true, lanes);
    }
}

static void without_path(const struct step *steps, size_t count, int lanes, struct ray_block *block)
{
    for (size_t i = 0; i < count; i++) {
        kernel_take(block, &steps[i], false, lanes);
    }
}

/* NaN for what is lost, but for clipped rays; and nothing that is not finite is on its way. */
static void block_mark_lost(struct ray_block *block, double miss, int lanes)
{
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double sum = (block->x[i] + block->y[i] + block->z[i]) +
                     (block->p[i] + block->q[i] + block->r[i]) + block->path[i];
        bool sound = fabs(sum) <= DBL_MAX;
        double old = block->lost[i];
        bool known = (old != 0) | sound;
        block->lost[i] = known ? old : miss;
    }
    int64_t any = 0;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        int64_t bits;
        memcpy(&bits, &block->lost[i], sizeof bits);
        any |= bits;
    }
    if (any == 0) {
        return;
    }
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double sum = (block->x[i] + block->y[i] + block->z[i]) +
                     (block->p[i] + block->q[i] + block->r[i]) + block->path[i];
        /* the remainder of 8: adding and taking away 1.5 x 2^52 rounds to a whole number */
        double eighth = block->lost[i] * 0.125 - 0.4375;
        double kind = block->lost[i] - 8 * ((eighth + 6755399441055744) - 6755399441055744);
        double other = fabs(sum) <= DBL_MAX ? (kind - RAY_OK) * (kind - RAY_CLIPPED) : 1;
        bool keep = other == 0;
        double gone = keep ? 0 : (double)NAN; /* taking 0 away keeps the sign of 0 */
        block->x[i] = (keep ? block->x[i] : 0) - gone;
        block->y[i] = (keep ? block->y[i] : 0) - gone;
        block->z[i] = (keep ? block->z[i] : 0) - gone;
        block->p[i] = (keep ? block->p[i] : 0) - gone;
        block->q[i] = (keep ? block->q[i] : 0) - gone;
        block->r[i] = (keep ? block->r[i] : 0) - gone;
        block->path[i] = (keep ? block->path[i] : 0) - gone;
    }
}

void NAME(kernel_trace, KERNEL)(const struct step *steps, size_t count, bool path, int lanes,
                                struct ray_block *block)
{
    if (count == 0) {
        return;
    }
    if (path) {
        with_path(steps, count, lanes, block);
    } else {
        without_path(steps, count, lanes, block);
    }
    block_mark_lost(block, steps[count - 1].miss, lanes);
}

/* Sums keep what is not finite of any number of a ray. */
static void rim_watch_look(const struct rim_watch *watch, int lanes, double *restrict excess,
                           double *restrict number, const struct ray_block *restrict block)
{
    double *restrict row = watch->row;
    const double over = watch->over, own = watch->number;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double rest = block->z[i] + (block->p[i] + block->q[i] + block->r[i]) + block->path[i];
        double here = (block->x[i] * block->x[i] + block->y[i] * block->y[i]) * over - 1;
        here += 0 * rest;
        double worst = excess[i];
        bool more = here > worst;
        row[i] = here;
        excess[i] = more ? here : worst;
        number[i] = more ? own : number[i];
    }
}

void NAME(kernel_watch, KERNEL)(const struct step *steps, size_t count, bool path, int lanes,
                                const struct rim_watch_request *watching, struct ray_block *block)
{
    const struct rim_watch *watch = watching->watches, *end = watch + watching->count;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        watching->excess[i] = -1;
        watching->number[i] = 0;
    }
    for (size_t i = 0; i < count; i++) {
        if (path) {
            with_path(&steps[i], 1, lanes, block);
        } else {
            without_path(&steps[i], 1, lanes, block);
        }
        for (; watch < end && watch->step == i; watch++) {
            rim_watch_look(watch, lanes, watching->excess, watching->number, block);
        }
    }
    if (count > 0) {
        block_mark_lost(block, steps[count - 1].miss, lanes);
    }
}

#ifndef KERNEL_FEW
static void kernel_copy_lanes(const struct ray_block *restrict from, int lanes,
                              struct ray_block *restrict to)
{
    for (int i = 0; i < LANES_OF(lanes); i++) {
        to->x[i] = from->x[i];
        to->y[i] = from->y[i];
        to->z[i] = from->z[i];
        to->p[i] = from->p[i];
        to->q[i] = from->q[i];
        to->r[i] = from->r[i];
        to->path[i] = from->path[i];
        to->lost[i] = from->lost[i];
    }
}

void NAME(kernel_tape, KERNEL)(const struct step *steps, size_t count, bool path, int lanes,
                               struct ray_block *blocks)
{
    for (size_t i = 0; i < count; i++) {
        kernel_copy_lanes(&blocks[i], lanes, &blocks[i + 1]);
        if (path) {
            with_path(&steps[i], 1, lanes, &blocks[i + 1]);
        } else {
            without_path(&steps[i], 1, lanes, &blocks[i + 1]);
        }
    }
    if (count > 0) {
        block_mark_lost(&blocks[count], steps[count - 1].miss, lanes);
    }
}
#endif
