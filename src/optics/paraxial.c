/* optics/paraxial.c - the compensated (y, v) trace. */
/* SPDX-License-Identifier: MIT */
#include "optics/paraxial.h"

#include "optics/fused.h"
#include "optics/portable.h"

#include <math.h>

static bool index_after(const struct surface *surface, double wavelength, struct pair before,
                        struct pair *after, struct error *error)
{
    if (surface_reflects(surface)) {
        *after = pair_negate(before);
        return true;
    }
    struct pair n;
    if (!medium_index(&surface->medium, wavelength, &n, error)) {
        return false;
    }
    *after = before.hi < 0 ? pair_negate(n) : n;
    return true;
}

bool paraxial_compile(const struct lens *lens, double wavelength, enum lens_section section,
                      struct arena *arena, struct paraxial_system *system, struct error *error)
{
    size_t count = lens->surface_count;
    struct paraxial_surface *surfaces = ARENA_ARRAY(arena, count, struct paraxial_surface);
    struct pair *index = ARENA_ARRAY(arena, count + 1, struct pair);
    struct pair *curvature = ARENA_ARRAY(arena, count, struct pair);
    struct pair petzval = {0, 0}, length = {0, 0};
    double strongest = 0;
    if (!medium_index(&lens->object_medium, wavelength, &index[0], error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (!index_after(surface, wavelength, index[i], &index[i + 1], error)) {
            return error_prefix(error, "surface %zu: ", i + 1);
        }
        bool is_thick = surface_has(surface, SURFACE_HAS_FOCAL);
        curvature[i] = surface_curvature(surface, section);
        surfaces[i].power =
            is_thick ? pair_divide(pair_of(1), surface->focal.value)
                     : pair_multiply(pair_subtract(index[i + 1], index[i]), curvature[i]);
        strongest = fmax(strongest, fabs(surfaces[i].power.hi));
        if (!is_thick) { /* whose image of a plane is a plane */
            petzval = pair_add(
                petzval, pair_divide(surfaces[i].power, pair_multiply(index[i], index[i + 1])));
        }
        if (i + 1 < count) {
            surfaces[i].reduced = pair_divide(surface->thickness.value, index[i + 1]);
            length = pair_add(length, surface->thickness.value);
        }
        length = pair_add(length, surface_hiatus(surface));
    }
    *system = (struct paraxial_system){.surfaces = surfaces,
                                       .count = count,
                                       .stop = lens->stop,
                                       .index = index,
                                       .curvature = curvature,
                                       .strongest = strongest,
                                       .petzval = petzval.hi,
                                       .length = length.hi};
    return true;
}

/*
 * Two rays through two parts at once: before the stop and from it on, in each the ray of height 1
 * and that of slope 1 (in n u).
 */
typedef double lanes __attribute__((vector_size(32)));

/* y + ey, v + ev */
struct paraxial_rays {
    lanes y, ey, v, ev;
};

/* A number of one surface before the stop and of one behind. */
struct factor {
    lanes hi, lo;
};

INLINE struct factor paraxial_factor_of(struct pair front, struct pair rear)
{
    return (struct factor){{front.hi, front.hi, rear.hi, rear.hi},
                           {front.lo, front.lo, rear.lo, rear.lo}};
}

/* a b = p + what is returned, by Dekker's split as in pair_product */
INLINE lanes rest_of_product(lanes a, lanes b, lanes p, bool fused)
{
    if (fused) {
        return (lanes){__builtin_fma(a[0], b[0], -p[0]), __builtin_fma(a[1], b[1], -p[1]),
                       __builtin_fma(a[2], b[2], -p[2]), __builtin_fma(a[3], b[3], -p[3])};
    }
    const lanes half = {134217729, 134217729, 134217729, 134217729};
    lanes a_big = half * a, a_high = a_big - (a_big - a), a_low = a - a_high;
    lanes b_big = half * b, b_high = b_big - (b_big - b), b_low = b - b_high;
    return ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

/* a + b = sum + what is returned: [Knuth97] 4.2.2, theorem B */
INLINE lanes rest_of_sum(lanes a, lanes b, lanes sum)
{
    lanes part = sum - a;
    return (a - (sum - part)) + (b - part);
}

/* (x + ex) + (a + ea) (b + eb), x and ex in place */
INLINE void paraxial_add_product(lanes *x, lanes *ex, lanes a, lanes ea, struct factor b,
                                 bool fused)
{
    lanes p = a * b.hi, p_rest = rest_of_product(a, b.hi, p, fused);
    lanes sum = *x + p, sum_rest = rest_of_sum(*x, p, sum);
    /* what comes last, ea, is the last to be known */
    *ex = (*ex + (sum_rest + p_rest) + a * b.lo) + ea * b.hi;
    *x = sum;
}

/* One surface of each part. */
INLINE void paraxial_step(const struct paraxial_surface *front, const struct paraxial_surface *rear,
                          struct paraxial_rays *rays, bool fused)
{
    struct factor power = paraxial_factor_of(front->power, rear->power);
    power.hi = -power.hi;
    power.lo = -power.lo;
    /* v' = v - y P */
    paraxial_add_product(&rays->v, &rays->ev, rays->y, rays->ey, power, fused);
    /* y' = y + (t/n) v */
    paraxial_add_product(&rays->y, &rays->ey, rays->v, rays->ev,
                         paraxial_factor_of(front->reduced, rear->reduced), fused);
}

INLINE struct paraxial_matrix matrix_of(lanes y, lanes y_rest, lanes v, lanes v_rest, size_t first)
{
    return (struct paraxial_matrix){{y[first], y_rest[first]},
                                    {y[first + 1], y_rest[first + 1]},
                                    {v[first], v_rest[first]},
                                    {v[first + 1], v_rest[first + 1]}};
}

/* a b + c d */
INLINE struct pair paraxial_combine(struct pair a, struct pair b, struct pair c, struct pair d,
                                    bool fused)
{
    struct pair p = fused_product(a.hi, b.hi, fused), q = fused_product(c.hi, d.hi, fused);
    struct pair high = pair_sum(p.hi, q.hi);
    double low = (p.lo + q.lo) + ((a.hi * b.lo + a.lo * b.hi) + (c.hi * d.lo + c.lo * d.hi));
    return pair_sum(high.hi, high.lo + low);
}

INLINE void trace_with(const struct paraxial_system *system, struct paraxial_trace *trace,
                       bool fused)
{
    static const struct paraxial_surface nothing = {{0, 0}, {0, 0}};
    struct paraxial_rays rays = {{1, 0, 1, 0}, {0, 0, 0, 0}, {0, 1, 0, 1}, {0, 0, 0, 0}};
    size_t front = system->stop == LENS_NONE ? 0 : system->stop, rear = system->count - front;
    const struct paraxial_surface *at = system->surfaces, *behind = at + front;
    size_t common = front < rear ? front : rear;
    for (size_t i = 0; i < common; i++) {
        paraxial_step(&at[i], &behind[i], &rays, fused);
    }
    for (size_t i = common; i < front; i++) {
        paraxial_step(&at[i], &nothing, &rays, fused);
    }
    for (size_t i = common; i < rear; i++) {
        paraxial_step(&nothing, &behind[i], &rays, fused);
    }
    lanes y = rays.y + rays.ey, y_rest = rest_of_sum(rays.y, rays.ey, y);
    lanes v = rays.v + rays.ev, v_rest = rest_of_sum(rays.v, rays.ev, v);
    struct paraxial_matrix f = matrix_of(y, y_rest, v, v_rest, 0);
    struct paraxial_matrix r = matrix_of(y, y_rest, v, v_rest, 2);
    trace->front = f;
    trace->rear = r;
    trace->whole = (struct paraxial_matrix){
        paraxial_combine(r.a, f.a, r.b, f.c, fused), paraxial_combine(r.a, f.b, r.b, f.d, fused),
        paraxial_combine(r.c, f.a, r.d, f.c, fused), paraxial_combine(r.c, f.b, r.d, f.d, fused)};
}

void paraxial_trace_portable(const struct paraxial_system *system, struct paraxial_trace *trace)
{
    trace_with(system, trace, false);
}

#ifdef HAS_FUSED
FUSED static void trace_fused(const struct paraxial_system *system, struct paraxial_trace *trace)
{
    trace_with(system, trace, true);
}
#endif

void paraxial_trace(const struct paraxial_system *system, struct paraxial_trace *trace)
{
#ifdef HAS_FUSED
    if (fused_here()) {
        trace_fused(system, trace);
        return;
    }
#endif
    trace_with(system, trace, false);
}

bool paraxial_is_afocal(const struct paraxial_system *system, const struct paraxial_trace *trace)
{
    return !(fabs(trace->whole.c.hi) > PARAXIAL_NOTHING * system->strongest);
}

void paraxial_follow(const struct paraxial_system *system, struct pair y, struct pair v,
                     struct paraxial_ray *rays)
{
    for (size_t i = 0; i < system->count; i++) {
        const struct paraxial_surface *surface = &system->surfaces[i];
        rays[i].y = y.hi;
        rays[i].before = v.hi;
        v = pair_subtract(v, pair_multiply(y, surface->power));
        rays[i].after = v.hi;
        y = pair_add(y, pair_multiply(v, surface->reduced));
    }
}
