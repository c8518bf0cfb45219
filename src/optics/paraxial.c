/* optics/paraxial.c - the compensated (y, v) trace. */
/* SPDX-License-Identifier: MIT */
#include "optics/paraxial.h"

#include <math.h>

/* Fused multiply-add gives the error of a product in one step: the same bits as Dekker's way. */
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#define HAS_FUSED 1
#define FUSED     __attribute__((target("avx2,fma")))
#endif
#define INLINE static inline __attribute__((always_inline))

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

/* y + ey, v + ev */
struct ray {
    double y, ey, v, ev;
};

INLINE struct pair product(double a, double b, bool fused)
{
    if (fused) {
        double p = a * b;
        return (struct pair){p, __builtin_fma(a, b, -p)};
    }
    return pair_product(a, b);
}

/* v' = v - y P */
INLINE struct ray refract(struct ray ray, struct pair power, bool fused)
{
    struct pair p = product(ray.y, power.hi, fused);
    struct pair v = pair_sum(ray.v, -p.hi);
    double ev = ray.ev + (v.lo - p.lo - (ray.ey * power.hi + ray.y * power.lo));
    return (struct ray){ray.y, ray.ey, v.hi, ev};
}

/* y' = y + (t/n) v */
INLINE struct ray transfer(struct ray ray, struct pair reduced, bool fused)
{
    struct pair p = product(ray.v, reduced.hi, fused);
    struct pair y = pair_sum(ray.y, p.hi);
    double ey = ray.ey + (y.lo + p.lo + (ray.ev * reduced.hi + ray.v * reduced.lo));
    return (struct ray){y.hi, ey, ray.v, ray.ev};
}

INLINE struct paraxial_matrix matrix_of(struct ray first, struct ray second)
{
    return (struct paraxial_matrix){pair_sum(first.y, first.ey), pair_sum(second.y, second.ey),
                                    pair_sum(first.v, first.ev), pair_sum(second.v, second.ev)};
}

INLINE void trace_with(const struct paraxial_system *system, struct paraxial_trace *trace,
                       bool fused)
{
    struct ray first = {1, 0, 0, 0}, second = {0, 0, 1, 0};
    trace->front = matrix_of(first, second);
    for (size_t i = 0; i < system->count; i++) {
        const struct paraxial_surface *surface = &system->surfaces[i];
        if (i == system->stop) {
            trace->front = matrix_of(first, second);
        }
        first = transfer(refract(first, surface->power, fused), surface->reduced, fused);
        second = transfer(refract(second, surface->power, fused), surface->reduced, fused);
    }
    trace->whole = matrix_of(first, second);
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
    if (__builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2")) {
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
