/* trace/kernel/kernel_conic.c - conics and aspheres, lane loops as in trace/kernel/kernel.c. */
/* SPDX-License-Identifier: MIT */
#include "trace/kernel/lanes.h"
#include "trace/kernel/search.h"

#include <stdint.h>

/* A conic in the formulas of a sphere: cx, cy, ck = c (1 + k) take the place of c. */
struct conic_constants {
    double cx, cy, ck;
};

INLINE struct conic_constants curved_of(const struct step *s, double c, double one_k, bool cylinder)
{
    return (struct conic_constants){cylinder ? c * s->weight_x : c, cylinder ? c * s->weight_y : c,
                                    c * one_k};
}

/* Where a ray meets a conic. `rim`: a ray that passes it by goes to where it comes nearest. */
INLINE void conic_find(struct ray_block *block, const struct step *s, struct conic_constants at,
                       bool path, bool hops, bool cylinder, bool rim, struct found *found, int i)
{
    struct lane ray = load(block, i, s->t);
    if (hops) {
        double before = hop(&ray, s);
        ray.path += s->n11 * before;
        store_point(block, i, &ray, path);
    }
    double x = at.cx * ray.x, y = at.cy * ray.y, z = at.ck * ray.z;
    double C = x * ray.x + y * ray.y + z * ray.z - 2 * ray.z;
    double B = ray.r - (x * ray.p + y * ray.q + z * ray.r);
    double A = cylinder ? at.cx * ray.p * ray.p + at.cy * ray.q * ray.q + at.ck * ray.r * ray.r
                        : at.cx * s->n11 + (at.ck - at.cx) * ray.r * ray.r;
    double square = B * B - A * C;
    found->square[i] = (rim & (square < 0)) ? 0 : square;
    found->numerator[i] = C;
    found->denominator[i] = B;
}

INLINE void conic_root(const struct step *s, struct found *found, int i)
{
    double D = sqrt(found->square[i]);
    found->denominator[i] += s->direction * D;
    found->bend[i] = D;
}

/* Go there. See sphere_bend for z. */
INLINE void conic_meet(struct ray_block *block, const struct step *s, struct conic_constants at,
                       bool path, bool hops, struct found *found, int i)
{
    struct lane ray = load(block, i, hops ? 0 : s->t);
    double d = found->way[i];
    advance(&ray, d);
    double kz = at.ck * ray.z, x = at.cx * ray.x, y = at.cy * ray.y;
    double sag = 0.5 * (x * ray.x + y * ray.y + kz * ray.z);
    bool keep = hops | (fabs(kz) > 1);
    ray.z = keep ? ray.z : sag;
    ray.path += s->n11 * d;
    double f = 1 - at.ck * ray.z, N2 = x * x + y * y + f * f;
    found->square[i] += s->dn * N2;
    found->denominator[i] = N2;
    store_point(block, i, &ray, path);
}

/*
 * g = s (E - D)/N^2, E^2 = D^2 + (n'^2 - n^2) N^2. `either`: this step refracts or reflects, where
 * g = -2 s D/N^2; products with 0, 1 and 2 are exact.
 */
INLINE void normal_root(const struct step *s, bool either, struct found *found, int i)
{
    const double E_share = s->action == ACTION_REFLECT ? 0 : 1, D_share = 2 - E_share;
    double D = found->bend[i], E = sqrt(found->square[i]);
    found->numerator[i] = s->direction * (either ? E_share * E - D_share * D : E - D);
}

/* g N is added to p, N = (-gx x, -gy y, f). */
INLINE void kernel_conic_turn(struct ray_block *block, const struct step *s, bool path,
                              struct lane *ray, double g, double gx, double gy, double f, int i)
{
    ray->p -= g * gx * ray->x;
    ray->q -= g * gy * ray->y;
    ray->r += g * f;
    if (path) {
        normalize(ray, s);
    }
    store_direction(block, i, ray);
}

INLINE void conic_bend(struct ray_block *block, const struct step *s, struct conic_constants at,
                       bool path, struct codes codes, const struct found *found, int i)
{
    struct lane ray = load(block, i, 0);
    double f = 1 - at.ck * ray.z;
    kernel_conic_turn(block, s, path, &ray, found->way[i], at.cx, at.cy, f, i);
    bool inside = ray.x * ray.x + ray.y * ray.y <= s->clear2;
    note(block, i, codes, f > 0, inside, found->square[i] >= 0);
}

INLINE void conic(struct ray_block *restrict block, const struct step *restrict step, bool path,
                  int lanes, bool hops, bool either, bool cylinder)
{
    const struct step s = *step;
    const struct codes codes = codes_of(&s);
    const struct conic_constants at = curved_of(&s, s.c, s.one_k, cylinder);
    _Alignas(64) struct found found;
#define FIND(i)  conic_find(block, &s, at, path, hops, cylinder, false, &found, i)
#define ROOT(i)  conic_root(&s, &found, i)
#define MEET(i)  conic_meet(block, &s, at, path, hops, &found, i)
#define ROOT2(i) normal_root(&s, either, &found, i)
#define BEND(i)  conic_bend(block, &s, at, path, codes, &found, i)
    IN_TURN(lanes, FIND, ROOT, DIVIDE, MEET);
    IN_TURN(lanes, ROOT2, DIVIDE, BEND, NOTHING);
#undef FIND
#undef ROOT
#undef MEET
#undef ROOT2
#undef BEND
}

/* Which aspheres a loop is for: constants of each copy. `either` as for normal_root. */
struct asphere_family {
    int terms; /* of the even powers */
    bool trough, odd, either;
};

/* S and dS/du of the polynomial at u. */
INLINE void kernel_conic_polynomial(const struct step *s, int terms, double u, double *S,
                                    double *slope)
{
    double value = s->coefficient[terms - 1], growth = s->slope[terms - 1];
    for (int i = terms - 2; i >= 0; i--) {
        value = value * u + s->coefficient[i];
        growth = growth * u + s->slope[i];
    }
    *S = value * u;
    *slope = growth;
}

/* What odd powers add at u: r P(u). At the vertex itself the slope counts as 0. */
INLINE void odd_powers(const struct step *s, double u, double *S, double *slope)
{
    double value = s->odd[STEP_TERMS - 1], growth = s->odd_slope[STEP_TERMS - 1];
    for (int i = STEP_TERMS - 2; i >= 0; i--) {
        value = value * u + s->odd[i];
        growth = growth * u + s->odd_slope[i];
    }
    double r = sqrt(u), inverse = 1 / (u > STEP_TINY ? r : 1);
    *S += r * value;
    *slope += (u > STEP_TINY ? inverse : 0) * growth;
}

/* Of the surface F = c (u + (1+k) w^2)/2 - w = 0, w = z - S(u): value and normal. */
struct surface_value {
    double F, gx, gy, f, G;
};

INLINE struct surface_value kernel_conic_shape_of(const struct lane *ray, const struct step *s,
                                                  struct asphere_family of)
{
    double wx = of.trough ? s->weight_x : 1, wy = of.trough ? s->weight_y : 1;
    double u = wx * ray->x * ray->x + wy * ray->y * ray->y, S, slope;
    kernel_conic_polynomial(s, of.terms, u, &S, &slope);
    if (of.odd) {
        odd_powers(s, u, &S, &slope);
    }
    double w = ray->z - S, f = 1 - s->c * s->one_k * w, g = s->c + 2 * f * slope;
    return (struct surface_value){0.5 * s->c * (u + s->one_k * w * w) - w, wx * g, wy * g, f, g};
}

/* Where Newton's method sets out from: kept for the search of those that it loses. */
struct origin {
    double x[KERNEL_LANES], y[KERNEL_LANES], z[KERNEL_LANES], path[KERNEL_LANES];
};

/* The conic that Newton's method starts from; rays that pass it by start at its rim. */
INLINE void start_meet(struct ray_block *block, const struct step *s, bool path,
                       struct origin *origin, struct found *found, int i)
{
    struct lane ray = load(block, i, 0);
    origin->x[i] = ray.x;
    origin->y[i] = ray.y;
    origin->z[i] = ray.z;
    if (path) {
        origin->path[i] = ray.path;
    }
    advance(&ray, found->way[i]);
    ray.path += s->n11 * found->way[i];
    found->open[i] = 1;
    store_point(block, i, &ray, path);
}

/* The next Newton step, F/(N.p). */
INLINE void newton_aim(const struct ray_block *block, const struct step *s,
                       struct asphere_family of, struct found *found, int i)
{
    struct lane ray = load(block, i, 0);
    struct surface_value at = kernel_conic_shape_of(&ray, s, of);
    found->numerator[i] = at.F;
    found->denominator[i] = at.f * ray.r - (at.gx * ray.x * ray.p + at.gy * ray.y * ray.q);
    found->f[i] = at.f;
}

/* Take it, where a lane is not there yet. */
INLINE void newton_go(struct ray_block *block, const struct step *s, double least, bool path,
                      struct found *found, int i)
{
    struct lane ray = load(block, i, 0);
    double d = found->open[i] != 0 ? found->way[i] : 0;
    /* convergence is quadratic: after a step of 1e-9 nothing is left to do */
    double limit = 1e-9 * (fabs(ray.x) + fabs(ray.y) + fabs(ray.z)) + least;
    bool more = d * d * s->n11 > limit * limit;
    advance(&ray, d);
    ray.path += s->n11 * d;
    found->open[i] = more ? 1 : 0;
    store_point(block, i, &ray, path);
}

/* What bending needs of the shape at the point. */
INLINE void asphere_look(const struct ray_block *block, const struct step *s,
                         struct asphere_family of, struct found *found, int i)
{
    struct lane ray = load(block, i, 0);
    struct surface_value at = kernel_conic_shape_of(&ray, s, of);
    double gx = at.gx * ray.x, gy = at.gy * ray.y, N2 = gx * gx + gy * gy + at.f * at.f;
    double D = s->direction * (at.f * ray.r - (gx * ray.p + gy * ray.q));
    found->bend[i] = D;
    found->square[i] = D * D + s->dn * N2;
    found->denominator[i] = N2;
    found->f[i] = at.f;
    found->G[i] = at.G;
}

INLINE void asphere_bend(struct ray_block *block, const struct step *s, bool path, bool trough,
                         struct codes codes, double unconverged, const struct found *found, int i)
{
    struct lane ray = load(block, i, 0);
    double f = found->f[i], G = found->G[i];
    kernel_conic_turn(block, s, path, &ray, found->way[i], trough ? s->weight_x * G : G,
                      trough ? s->weight_y * G : G, f, i);
    bool inside = ray.x * ray.x + ray.y * ray.y <= s->clear2, there = found->open[i] == 0;
    codes.miss = there ? codes.miss : unconverged;
    note(block, i, codes, there & (found->bend[i] > 0) & (f > 0), inside, found->square[i] >= 0);
}

enum { NEWTON_STEPS = 10 };

INLINE bool any_open(const struct found *found, int lanes)
{
    int64_t open = 0;
    for (int i = 0; i < LANES_OF(lanes); i++) {
        int64_t bits;
        memcpy(&bits, &found->open[i], sizeof bits);
        open |= bits;
    }
    return open != 0;
}

/* Is the ray at the front of the surface, on the sheet of the vertex? A NaN is not. */
INLINE bool kernel_conic_is_there(const struct step *s, const struct found *found, int i)
{
    return (found->open[i] == 0) & (s->direction * found->denominator[i] > 0) & (found->f[i] > 0);
}

INLINE bool all_there(const struct step *s, const struct found *found, int lanes)
{
    int64_t there = 0; /* as wide as what is compared */
    for (int i = 0; i < LANES_OF(lanes); i++) {
        there += kernel_conic_is_there(s, found, i) ? 1 : 0;
    }
    return there == LANES_OF(lanes);
}

/* Newton's method went astray, or there is nothing to meet: then the point becomes NaN. */
static __attribute__((noinline)) void search_lost(struct ray_block *block, const struct step *s,
                                                  bool path, int lanes, const struct origin *origin,
                                                  struct found *found)
{
    for (int i = 0; i < LANES_OF(lanes); i++) {
        size_t lost = (size_t)block->lost[i] % 8;
        if (kernel_conic_is_there(s, found, i) || (lost != RAY_OK && lost != RAY_CLIPPED)) {
            continue;
        }
        const double point[3] = {origin->x[i], origin->y[i], origin->z[i]};
        const double direction[3] = {block->p[i], block->q[i], block->r[i]};
        double d = isnan(point[0]) ? (double)NAN : search_meet(s, point, direction);
        block->x[i] = point[0] + d * direction[0];
        block->y[i] = point[1] + d * direction[1];
        block->z[i] = point[2] + d * direction[2];
        if (path) {
            block->path[i] = origin->path[i] + s->n11 * d;
        }
        found->open[i] = 0;
    }
}

/* Of aspheres there are many copies: those of rare ones are small. */
/* clang-format off */
#define IN_TURN_OF(lanes, of, ...)                                                                 \
    do {                                                                                           \
        if ((of).either) {                                                                         \
            IN_TURN_SMALL(lanes, __VA_ARGS__);                                                     \
        } else {                                                                                   \
            IN_TURN(lanes, __VA_ARGS__);                                                           \
        }                                                                                          \
    } while (0)
/* clang-format on */

INLINE void asphere(struct ray_block *restrict block, const struct step *restrict step, bool path,
                    int lanes, struct asphere_family of)
{
    const struct step s = *step;
    const struct codes codes = codes_of(&s);
    const struct conic_constants at = curved_of(&s, s.start_c, s.start_k, of.trough);
    const double least = 1e-16 * (1 + fabs(s.t)), unconverged = s.unconverged;
    _Alignas(64) struct found found;
    _Alignas(64) struct origin origin;
#define FIND(i)  conic_find(block, &s, at, path, true, of.trough, true, &found, i)
#define ROOT(i)  conic_root(&s, &found, i)
#define START(i) start_meet(block, &s, path, &origin, &found, i)
#define AIM(i)   newton_aim(block, &s, of, &found, i)
#define GO(i)    newton_go(block, &s, least, path, &found, i)
#define LOOK(i)  asphere_look(block, &s, of, &found, i)
#define ROOT2(i) normal_root(&s, of.either, &found, i)
#define BEND(i)  asphere_bend(block, &s, path, of.trough, codes, unconverged, &found, i)
    IN_TURN_OF(lanes, of, FIND, ROOT, DIVIDE, START);
    for (int turn = 0; turn < NEWTON_STEPS && any_open(&found, lanes); turn++) {
        IN_TURN_OF(lanes, of, AIM, DIVIDE, GO, NOTHING);
    }
    if (!all_there(&s, &found, lanes)) {
        search_lost(block, step, path, lanes, &origin, &found);
    }
    IN_TURN_SMALL(lanes, LOOK, ROOT2, DIVIDE, BEND);
#undef FIND
#undef ROOT
#undef START
#undef AIM
#undef GO
#undef LOOK
#undef ROOT2
#undef BEND
}

INLINE void any_conic(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    if (s->kind == STEP_CYLINDER || s->action == ACTION_REFLECT) {
        conic(block, s, path, lanes, true, true, true);
    } else if (s->hop) {
        conic(block, s, path, lanes, true, false, false);
    } else {
        conic(block, s, path, lanes, false, false, false);
    }
}

void NAME(kernel_conic, KERNEL)(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    if (path) {
        any_conic(block, s, true, lanes);
    } else {
        any_conic(block, s, false, lanes);
    }
}

INLINE void with_or_without_path(struct ray_block *block, const struct step *s, bool path,
                                 int lanes, struct asphere_family of)
{
    if (path) {
        asphere(block, s, true, lanes, of);
    } else {
        asphere(block, s, false, lanes, of);
    }
}

/* One copy for each number of terms; what follows the last is 0. */
#define ASPHERE(TERMS)                                                                             \
    static void asphere_##TERMS(struct ray_block *block, const struct step *s, bool path,          \
                                int lanes)                                                         \
    {                                                                                              \
        with_or_without_path(block, s, path, lanes, (struct asphere_family){.terms = TERMS});      \
    }
#ifndef KERNEL_FEW
ASPHERE(4)
ASPHERE(5)
ASPHERE(6)
ASPHERE(8)
#endif
ASPHERE(10)

static void asphere_any(struct ray_block *block, const struct step *s, bool path, int lanes)
{
    if (s->kind == STEP_ODD) {
        with_or_without_path(block, s, path, lanes,
                             (struct asphere_family){STEP_TERMS, true, true, true});
    } else {
        with_or_without_path(block, s, path, lanes,
                             (struct asphere_family){STEP_TERMS, true, false, true});
    }
}

void NAME(kernel_asphere, KERNEL)(struct ray_block *block, const struct step *s, bool path,
                                  int lanes)
{
#ifndef KERNEL_FEW
    static kernel_step *const steps[STEP_TERMS + 1] = {asphere_4, asphere_4,  asphere_4, asphere_4,
                                                       asphere_4, asphere_5,  asphere_6, asphere_8,
                                                       asphere_8, asphere_10, asphere_10};
    kernel_step *const step = steps[s->terms];
#else
    kernel_step *const step = asphere_10;
#endif
    bool usual = s->kind == STEP_ASPHERE && s->action == ACTION_REFRACT;
    kernel_step *const fitting = usual ? step : asphere_any;
    fitting(block, s, path, lanes);
}
