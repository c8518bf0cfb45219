/* optics/paraxial.c - the compensated (y, v) trace. */
/* SPDX-License-Identifier: MIT */
#include "optics/paraxial.h"

#include "optics/fused.h"

#include <math.h>

static bool index_after(const struct surface *surface, double wavelength, struct pair before,
                        struct pair *after, struct error *error)
{
    if (surface->kind == SURFACE_REFLECT) {
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
        curvature[i] = surface_curvature(surface, section);
        surfaces[i].power = pair_multiply(pair_subtract(index[i + 1], index[i]), curvature[i]);
        strongest = fmax(strongest, fabs(surfaces[i].power.hi));
        petzval = pair_add(petzval,
                           pair_divide(surfaces[i].power, pair_multiply(index[i], index[i + 1])));
        if (i + 1 < count) {
            surfaces[i].reduced = pair_divide(surface->thickness.value, index[i + 1]);
            length = pair_add(length, surface->thickness.value);
        }
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

/* Both rays at once: the first starts with y = 1, v = 0, the second with y = 0, v = 1. */
typedef double lanes __attribute__((vector_size(16)));

/* y + ey, v + ev */
struct rays {
    lanes y, ey, v, ev;
};

INLINE lanes both(double a)
{
    return (lanes){a, a};
}

/* a b = p + what is returned, by Dekker's split as in pair_product */
INLINE lanes rest_of_product(lanes a, double b, lanes p, bool fused)
{
    if (fused) {
        return (lanes){__builtin_fma(a[0], b, -p[0]), __builtin_fma(a[1], b, -p[1])};
    }
    const double half = 134217729, b_big = half * b;
    const double b_high = b_big - (b_big - b), b_low = b - b_high;
    lanes a_big = both(half) * a, a_high = a_big - (a_big - a), a_low = a - a_high;
    return ((a_high * both(b_high) - p) + a_high * both(b_low) + a_low * both(b_high)) +
           a_low * both(b_low);
}

/* a + b = sum + what is returned: [Knuth97] 4.2.2, theorem B */
INLINE lanes rest_of_sum(lanes a, lanes b, lanes sum)
{
    lanes part = sum - a;
    return (a - (sum - part)) + (b - part);
}

/* (x + ex) + (a + ea) (b + eb), x and ex in place */
INLINE void add_product(lanes *x, lanes *ex, lanes a, lanes ea, struct pair b, bool fused)
{
    lanes p = a * both(b.hi), p_rest = rest_of_product(a, b.hi, p, fused);
    lanes sum = *x + p, sum_rest = rest_of_sum(*x, p, sum);
    /* what comes last, ea, is the last to be known */
    *ex = (*ex + (sum_rest + p_rest) + a * both(b.lo)) + ea * both(b.hi);
    *x = sum;
}

INLINE struct paraxial_matrix matrix_of(const struct rays *rays)
{
    lanes y = rays->y + rays->ey, y_rest = rest_of_sum(rays->y, rays->ey, y);
    lanes v = rays->v + rays->ev, v_rest = rest_of_sum(rays->v, rays->ev, v);
    return (struct paraxial_matrix){
        {y[0], y_rest[0]}, {y[1], y_rest[1]}, {v[0], v_rest[0]}, {v[1], v_rest[1]}};
}

/* Through the surfaces from `first` to before `end`. */
INLINE void pass(const struct paraxial_system *system, size_t first, size_t end, struct rays *rays,
                 bool fused)
{
    for (size_t i = first; i < end; i++) {
        const struct paraxial_surface *surface = &system->surfaces[i];
        /* v' = v - y P */
        add_product(&rays->v, &rays->ev, rays->y, rays->ey, pair_negate(surface->power), fused);
        /* y' = y + (t/n) v */
        add_product(&rays->y, &rays->ey, rays->v, rays->ev, surface->reduced, fused);
    }
}

INLINE void trace_with(const struct paraxial_system *system, struct paraxial_trace *trace,
                       bool fused)
{
    struct rays rays = {{1, 0}, {0, 0}, {0, 1}, {0, 0}};
    size_t stop = system->stop == LENS_NONE ? 0 : system->stop;
    pass(system, 0, stop, &rays, fused);
    trace->front = matrix_of(&rays);
    pass(system, stop, system->count, &rays, fused);
    trace->whole = matrix_of(&rays);
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
    const double share = 2.5243548967072378e-29; /* 2^-95 */
    return !(fabs(trace->whole.c.hi) > share * system->strongest);
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
