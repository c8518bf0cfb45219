/* optics/surface.c - the kinds of surface and of curve. */
/* SPDX-License-Identifier: MIT */
#include "optics/surface.h"

#include <math.h>

const struct displacement displacement_none = {
    .decenter = {{.variable = LENS_NONE}, {.variable = LENS_NONE}},
    .tilt = {{.variable = LENS_NONE}, {.variable = LENS_NONE}, {.variable = LENS_NONE}}};

enum { PLAIN = SURFACE_HAS_CURVE | SURFACE_HAS_MEDIUM | SURFACE_MAY_MIRROR };

const struct surface_traits surface_kinds[SURFACE_KINDS] = {
    [SURFACE_REFRACT] = {.word = "surface", .key = "refract", .has = PLAIN},
    [SURFACE_REFLECT] = {.word = "surface",
                         .key = "reflect",
                         .name = "mirror",
                         .has = SURFACE_HAS_CURVE,
                         .reflects = true,
                         .is_drawn = true},
    [SURFACE_STOP] = {.word = "stop", .key = "stop", .name = "stop", .has = SURFACE_HAS_MEDIUM},
    [SURFACE_THICK] = {.word = "thick",
                       .key = "thick",
                       .name = "thick",
                       .has = SURFACE_HAS_FOCAL | SURFACE_HAS_MEDIUM,
                       .is_drawn = true}};

const struct surface_section surface_sections[] = {
    [CURVED_BOTH] = {.key = "both", .weight = {1, 1}},
    [CURVED_X] = {.key = "x", .word = "x", .weight = {1, 0}},
    [CURVED_Y] = {.key = "y", .word = "y", .weight = {0, 1}}};

static struct departure even_departure(const struct surface *surface, double u)
{
    struct departure all = {0, 0};
    for (int i = LENS_EVEN - 1; i >= 0; i--) {
        all.slope = all.slope * u + (i + 1) * surface->coefficient[i].value.hi;
        all.value = (all.value + surface->coefficient[i].value.hi) * u;
    }
    return all;
}

/* r P(u) with P = A1 + A3 u + ...; d/du of r u^j is (j + 1/2) u^j / r */
static struct departure odd_departure(const struct surface *surface, double u)
{
    struct departure all = even_departure(surface, u), odd = {0, 0};
    double r = sqrt(u), inverse = u > 0 ? 1 / r : 0;
    for (int i = LENS_ODD - 1; i >= 0; i--) {
        double a = surface->coefficient[LENS_EVEN + i].value.hi;
        odd.slope = odd.slope * u + (i + 0.5) * a;
        odd.value = odd.value * u + a;
    }
    return (struct departure){all.value + r * odd.value, all.slope + inverse * odd.slope};
}

const struct surface_profile surface_profiles[PROFILE_KINDS] = {
    [PROFILE_PLANE] = {.name = "plane"},
    [PROFILE_SPHERE] = {.name = "sphere"},
    [PROFILE_CONIC] = {.name = "conic"},
    [PROFILE_EVEN] = {.name = "asphere", .departure = even_departure},
    [PROFILE_ODD] = {.name = "odd asphere", .departure = odd_departure}};

enum profile_kind surface_profile(const struct surface *surface)
{
    if (!surface_has(surface, SURFACE_HAS_CURVE)) {
        return PROFILE_PLANE;
    }
    for (int i = LENS_COEFFICIENTS - 1; i >= 0; i--) {
        if (surface->coefficient[i].value.hi != 0) {
            return i < LENS_EVEN ? PROFILE_EVEN : PROFILE_ODD;
        }
    }
    if (surface_base_curvature(surface).hi == 0) {
        return PROFILE_PLANE;
    }
    return surface->conic.value.hi == 0 ? PROFILE_SPHERE : PROFILE_CONIC;
}

bool surface_is_cone(const struct surface *surface)
{
    return surface_has(surface, SURFACE_HAS_CURVE) && surface->coefficient[LENS_EVEN].value.hi != 0;
}

struct departure surface_departure(const struct surface *surface, double u)
{
    const struct surface_profile *profile = &surface_profiles[surface_profile(surface)];
    return profile->departure != NULL ? profile->departure(surface, u) : (struct departure){0, 0};
}

struct pair surface_base_curvature(const struct surface *surface)
{
    if (!surface_has(surface, SURFACE_HAS_CURVE)) {
        return pair_of(0);
    }
    if (surface->has_curvature) {
        return surface->curvature.value;
    }
    return surface->is_plane ? pair_of(0) : pair_divide(pair_of(1), surface->radius.value);
}

struct pair surface_curvature(const struct surface *surface, enum lens_section section)
{
    static const int axis[] = {[SECTION_Y] = 1, [SECTION_X] = 0};
    bool is_curved = surface_section(surface)->weight[axis[section]] != 0;
    if (!is_curved || !surface_has(surface, SURFACE_HAS_CURVE)) {
        return pair_of(0);
    }
    struct pair a2 = surface->coefficient[0].value;
    return pair_add(surface_base_curvature(surface), pair_add(a2, a2));
}

struct pair surface_hiatus(const struct surface *surface)
{
    return surface_has(surface, SURFACE_HAS_FOCAL) ? surface->hiatus.value : pair_of(0);
}

bool surface_is_thin(const struct surface *surface)
{
    return surface_has(surface, SURFACE_HAS_FOCAL) && surface->hiatus.variable == LENS_NONE &&
           surface->hiatus.value.hi == 0;
}

struct pair surface_advance(const struct surface *surface)
{
    return surface_has(surface, SURFACE_HAS_FOCAL)
               ? pair_add(surface->thickness.value, surface->hiatus.value)
               : surface->thickness.value;
}

double surface_sag(const struct surface *surface, double r)
{
    double c = surface_base_curvature(surface).hi, u = r * r;
    double z = c * u / (1 + sqrt(1 - (1 + surface->conic.value.hi) * c * c * u));
    return z + surface_departure(surface, u).value;
}
