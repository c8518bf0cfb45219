/* design/tolerance/perturbation_place.c - where a tolerance is, and what may be wrong there. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/perturbation_place.h"

#include "optics/medium.h"
#include "optics/wavelength.h"

#include <math.h>

const char *tolerance_place_name(const struct tolerance_site *site,
                                 const struct tolerance_place *place)
{
    struct lens_tolerance one = *place->from;
    one.first = place->first;
    one.last = place->last;
    one.is_range = false;
    /* of a space of air as of any other */
    one.kind = place->kind == TOLERANCE_AIR ? TOLERANCE_THICKNESS : place->kind;
    return tolerance_name(&one, site->arena);
}

static const struct surface *site_surface(const struct tolerance_site *site, size_t surface)
{
    return &site->lens->surfaces[surface];
}

/* -------- what there is -------- */

enum tolerance_kind tolerance_place_space(const struct tolerance_site *site, size_t surface)
{
    while (surface > 0 && surface_reflects(site_surface(site, surface))) {
        surface--;
    }
    const struct medium *medium = surface_reflects(site_surface(site, surface))
                                      ? &site->lens->object_medium
                                      : &site_surface(site, surface)->medium;
    return medium_is_air(medium) ? TOLERANCE_AIR : TOLERANCE_THICKNESS;
}

/* The space behind a surface where it is narrowest, or widest, in any position, mm: not below 0. */
static double space_at(const struct tolerance_site *site, size_t surface, bool narrowest)
{
    const size_t word = site->all->surfaces[surface].thickness.variable;
    double space = fabs(site_surface(site, surface)->thickness.value.hi);
    for (size_t p = 0; p < site->all->position_count && word != LENS_NONE; p++) {
        const double one = fabs(site->all->variables[word].values[p].value.hi);
        space = narrowest ? fmin(space, one) : fmax(space, one);
    }
    return space;
}

/* Does the gap behind a surface go on behind the next one? */
static bool airspace_goes_on(const struct tolerance_site *site, size_t surface)
{
    const size_t next = surface + 1;
    return next + 1 < site->lens->surface_count && site_surface(site, next)->kind == SURFACE_STOP &&
           tolerance_place_space(site, surface) == TOLERANCE_AIR &&
           tolerance_place_space(site, next) == TOLERANCE_AIR;
}

bool tolerance_place_find_airspace(const struct tolerance_site *site, struct tolerance_place *place)
{
    size_t widest = place->first;
    place->space = place->first;
    while (place->space > 0 && airspace_goes_on(site, place->space - 1)) {
        place->space--;
    }
    for (size_t i = place->space; i == place->space || airspace_goes_on(site, i - 1); i++) {
        const double here = space_at(site, i, true), most = space_at(site, widest, true);
        widest = here > most || (here == most && i < widest) ? i : widest;
    }
    return widest == place->first;
}

/* Of an airspace all of it, where it is narrowest or widest, mm. */
static double place_space(const struct tolerance_site *site, const struct tolerance_place *place,
                          bool narrowest)
{
    double sum = space_at(site, place->space, narrowest);
    for (size_t i = place->space; place->kind == TOLERANCE_AIR && airspace_goes_on(site, i); i++) {
        sum += space_at(site, i + 1, narrowest);
    }
    return sum;
}

static const char *no_element(const struct tolerance_site *site,
                              const struct tolerance_place *place)
{
    bool has_one = false;
    for (size_t i = 0; i < site->element_count; i++) {
        const struct element *one = &site->elements[i];
        const bool touches = one->first <= place->last && one->last >= place->first;
        if (touches && (one->first < place->first || one->last > place->last)) {
            return arena_printf(site->arena, "it is a part of the element %zu..%zu", one->first + 1,
                                one->last + 1);
        }
        has_one = has_one || touches;
    }
    return has_one ? NULL : "there is no element";
}

static const char *no_glass(const struct surface *surface, enum tolerance_kind kind)
{
    struct melt melt;
    if (surface_reflects(surface) || surface->kind == SURFACE_STOP ||
        medium_is_air(&surface->medium)) {
        return "there is no glass behind the surface";
    }
    melt_open(&surface->medium, &melt);
    return kind == TOLERANCE_INDEX || melt.has_abbe ? NULL
                                                    : "the medium behind it has no Abbe number";
}

const char *tolerance_place_wrong(const struct tolerance_site *site,
                                  const struct tolerance_place *place)
{
    const struct surface *surface = site_surface(site, place->first);
    const enum parameter_kind parameter = tolerance_type(place->kind)->parameter;
    const enum tolerance_unit unit = place->from->unit;
    const struct figure *figure;
    switch (place->kind) {
    case TOLERANCE_THICKNESS:
    case TOLERANCE_AIR:
        if (place->first + 1 >= site->lens->surface_count) {
            return "that is the image's distance: its tolerance is that of the focus";
        }
        if (place_space(site, place, false) == 0) {
            return "the space is 0";
        }
        return tolerance_place_space(site, place->first) == place->kind
                   ? NULL
                   : "there is no air behind the surface";
    case TOLERANCE_INDEX:
    case TOLERANCE_ABBE:
        return no_glass(surface, place->kind);
    case TOLERANCE_CONIC:
    case TOLERANCE_COEFFICIENT:
        if (!surface_has(surface, SURFACE_HAS_CURVE)) {
            return "the surface has no shape of its own";
        }
        figure = parameter_figure(surface, parameter, place->from->order);
        return (figure == NULL || figure->value.hi == 0) &&
                       (place->from->is_range || unit == TOLERANCE_PERCENT)
                   ? "it is 0 there"
                   : NULL;
    case TOLERANCE_RADIUS:
    case TOLERANCE_TILT:
    case TOLERANCE_DECENTER:
    case TOLERANCE_IRREGULARITY:
        if (surface->kind == SURFACE_STOP || !surface_has(surface, SURFACE_HAS_CURVE)) {
            return "the surface has no shape of its own";
        }
        if (element_at(site->elements, site->element_count, place->first) == NULL) {
            return "a plane in air that bends no ray";
        }
        return place->kind == TOLERANCE_RADIUS && unit != TOLERANCE_FRINGES &&
                       surface_base_curvature(surface).hi == 0
                   ? "a plane has no radius: its tolerance is in fringes"
                   : NULL;
    case TOLERANCE_FOCUS:
    case TOLERANCE_KINDS:
        return NULL;
    default:
        return no_element(site, place);
    }
}

/* -------- by how much -------- */

/* That surface, and behind a range all others that have none either. */
static const char *no_diameter(const struct tolerance_site *site,
                               const struct tolerance_place *place, size_t surface,
                               const char *need)
{
    struct arena *arena = site->arena;
    const char *all = arena_printf(arena, "%zu", surface + 1), *last = NULL;
    for (size_t i = surface + 1; i < site->lens->surface_count && place->from->is_range; i++) {
        if (!site_surface(site, i)->has_diameter &&
            element_at(site->elements, site->element_count, i) != NULL) {
            all = last != NULL ? ARENA_JOIN(arena, all, ", ", last) : all;
            last = arena_printf(arena, "%zu", i + 1);
        }
    }
    return last == NULL ? ARENA_JOIN(arena, "surface ", all, " without a diameter, which ", need)
                        : ARENA_JOIN(arena, "surfaces ", all, " and ", last,
                                     " without a diameter, which ", need);
}

/* The curvature whose conic has this sag at this height; NaN where that is beyond its edge. */
static double curvature_of_sag(double sag, double height, double conic)
{
    const double c = 2 * sag / (height * height + (1 + conic) * sag * sag);
    const double inside = 1 - (1 + conic) * c * c * height * height;
    const double back = c * height * height / (1 + sqrt(inside));
    return fabs(back - sag) <= 1e-9 * fabs(sag) + 1e-15 ? c : (double)NAN;
}

/* Of a radius: the two curvatures that lie so many fringes to either side. */
static const char *fringes(const struct tolerance_site *site, const struct tolerance_place *place,
                           struct perturbation *result)
{
    const struct surface *surface = site_surface(site, place->first);
    if (!surface->has_diameter) {
        return no_diameter(site, place, place->first, "fringes are counted over");
    }
    const double r = surface->diameter.value.hi / 2, conic = surface->conic.value.hi;
    const double c = surface_base_curvature(surface).hi;
    const double sag = c * r * r / (1 + sqrt(1 - (1 + conic) * c * c * r * r));
    const double off = place->from->amount.value.hi * TOLERANCE_FRINGE_MM;
    const double low = curvature_of_sag(sag - off, r, conic);
    const double high = curvature_of_sag(sag + off, r, conic);
    result->what.kind = PARAMETER_CURVATURE;
    result->amount = (high - low) / 2;
    return result->amount > 0 ? NULL
                              : "so many fringes lead beyond the edge of the surface's sphere";
}

static const char *number_amount(const struct tolerance_site *site,
                                 const struct tolerance_place *place, struct perturbation *result)
{
    const struct lens_tolerance *from = place->from;
    const struct surface *surface = site_surface(site, place->first);
    const enum parameter_kind kind = tolerance_type(place->kind)->parameter;
    const bool is_share = from->unit == TOLERANCE_PERCENT;
    const bool may_pass_0 = place->kind == TOLERANCE_CONIC ||
                            place->kind == TOLERANCE_COEFFICIENT ||
                            (place->kind == TOLERANCE_AIR &&
                             (surface->kind == SURFACE_STOP || surface[1].kind == SURFACE_STOP));
    result->what = (struct parameter){
        place->first, kind == PARAMETER_KINDS ? PARAMETER_THICKNESS : kind, from->order};
    if (from->unit == TOLERANCE_FRINGES) {
        return fringes(site, place, result);
    }
    if (is_share && site->all->surfaces[place->first].thickness.variable != LENS_NONE &&
        result->what.kind == PARAMETER_THICKNESS) {
        return "a word of the positions has no one number to take a share of: give it in mm";
    }
    /* the number itself: of a glass its index at d, or Vd */
    double number = 0;
    if (place->kind == TOLERANCE_INDEX) {
        struct pair n = {1, 0}; /* of what has none at d an index above that of air */
        struct error ignored;
        number = medium_index(&surface->medium, WAVELENGTH_D, &n, &ignored) ? n.hi : 1;
    } else if (place->kind == TOLERANCE_ABBE) {
        struct melt melt;
        melt_open(&surface->medium, &melt);
        number = melt.Vd;
    } else if (place->kind == TOLERANCE_RADIUS) {
        number = 1 / surface_base_curvature(surface).hi;
    } else if (place->kind == TOLERANCE_THICKNESS || place->kind == TOLERANCE_AIR) {
        number = place_space(site, place, true);
    } else {
        const struct figure *figure = parameter_figure(surface, kind, from->order);
        number = figure != NULL ? figure->value.hi : 0;
    }
    number = fabs(number);
    result->amount = is_share ? from->amount.value.hi / 100 * number : from->amount.value.hi;
    return may_pass_0 || result->amount < number
               ? NULL
               : arena_printf(site->arena, "it is as wide as the number itself, %.6g", number);
}

static const char *wedge(const struct tolerance_site *site, const struct tolerance_place *place,
                         struct perturbation *result)
{
    const struct lens_tolerance *from = place->from;
    const size_t tilted = from->pivot == LENS_NONE ? place->last : from->pivot;
    double diameter = 0; /* of the largest of the element's surfaces, mm */
    if (tilted < place->first || tilted > place->last) {
        return arena_printf(site->arena, "surface %zu is none of the element's", tilted + 1);
    }
    result->first = result->last = tilted;
    result->amount = from->amount.value.hi;
    if (from->unit != TOLERANCE_LENGTH) {
        return NULL;
    }
    for (size_t i = place->first; i <= place->last; i++) {
        if (!site_surface(site, i)->has_diameter) {
            return no_diameter(site, place, i, "the runout is measured over");
        }
        diameter = fmax(diameter, site_surface(site, i)->diameter.value.hi);
    }
    result->amount /= diameter;
    return result->amount < 1 ? NULL
                              : arena_printf(site->arena, "a runout of %.6g mm over %.6g mm",
                                             from->amount.value.hi, diameter);
}

/* From the vertex of the first surface to that of another, mm along the axis. */
static double site_distance(const struct tolerance_site *site, size_t first, size_t surface)
{
    double sum = 0;
    for (size_t i = first; i < surface; i++) {
        sum += surface_advance(site_surface(site, i)).hi;
    }
    for (size_t i = surface; i < first; i++) {
        sum -= surface_advance(site_surface(site, i)).hi;
    }
    return sum;
}

static const char *motion(const struct tolerance_site *site, const struct tolerance_place *place,
                          struct perturbation *result)
{
    const size_t pivot = place->from->pivot;
    const bool rolls = place->kind == TOLERANCE_ELEMENT_ROLL;
    const size_t seat = pivot == LENS_NONE ? place->first : pivot;
    result->amount = place->from->amount.value.hi;
    result->kind = rolls ? TOLERANCE_ELEMENT_TILT : place->kind;
    result->pivot = pivot == LENS_NONE && !rolls
                        ? site_distance(site, place->first, place->last) / 2
                        : site_distance(site, place->first, seat);
    if (!rolls) {
        return NULL;
    }
    const double curvature = surface_base_curvature(site_surface(site, seat)).hi;
    result->pivot += 1 / curvature;
    return curvature != 0 ? NULL
                          : arena_printf(site->arena,
                                         "surface %zu is plane: on it the element shifts, which is "
                                         "'decenter'",
                                         seat + 1);
}

const char *tolerance_place_amount(const struct tolerance_site *site,
                                   const struct tolerance_place *place, struct perturbation *result)
{
    const double amount = place->from->amount.value.hi;
    result->first = place->first;
    result->last = place->last;
    result->kind = place->kind;
    result->what.kind = PARAMETER_KINDS;
    result->amount = amount;
    switch (place->kind) {
    case TOLERANCE_WEDGE:
        return wedge(site, place, result);
    case TOLERANCE_ELEMENT_TILT:
    case TOLERANCE_ELEMENT_DECENTER:
    case TOLERANCE_ELEMENT_ROLL:
        return motion(site, place, result);
    case TOLERANCE_TILT:
    case TOLERANCE_DECENTER:
    case TOLERANCE_FOCUS:
        return NULL;
    case TOLERANCE_IRREGULARITY:
        result->amount = amount * TOLERANCE_FRINGE_MM / TOLERANCE_WAVE_MM;
        return site_surface(site, place->first)->has_diameter
                   ? NULL
                   : no_diameter(site, place, place->first, "the irregularity is over");
    default:
        return number_amount(site, place, result);
    }
}
