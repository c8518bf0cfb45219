/* design/merit/merit_surface.c - operands of single surfaces: sag, slope, radius by size. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_kinds.h"
#include "design/merit/merit_shape.h"

#include <math.h>

/* -------- slopes -------- */

/*
 * dz/dr of a surface at r, and its derivatives by c, k and r.
 *
 * Formula   c r/s, s^2 = 1 - (1+k) c^2 r^2, and the series. A conic ends at s = 0; beyond s = 0.05
 *           it goes on along its tangent in sqrt(1+k) c r, so that there is a way back
 */
static struct sag surface_slope_at(const struct surface *surface, double r)
{
    static const double least = 0.05; /* s */
    const double c = surface_base_curvature(surface).hi, k1 = 1 + surface->conic.value.hi;
    const double last = 1 - least * least, square = k1 * c * c * r * r;
    struct sag slope = {0};
    if (square > last) {
        const double cube = least * least * least;
        const double root = copysign(sqrt(last / k1), c) * (1 / least - 1 / cube);
        slope.value = root + c * r / cube;
        slope.by_curvature = r / cube;
        slope.by_conic = -root / (2 * k1);
        slope.by_radius = c / cube;
    } else {
        const double s = sqrt(1 - square), cube = s * s * s;
        slope.value = c * r / s;
        slope.by_curvature = r / cube;
        slope.by_conic = c * r * c * r * c * r / (2 * cube);
        slope.by_radius = c / cube;
    }
    for (int term = 0; term < LENS_COEFFICIENTS; term++) {
        const int n = surface_order(term);
        const double A = surface->coefficient[term].value.hi;
        if (A != 0) {
            slope.value += A * n * pow(r, n - 1);
            slope.by_radius += n > 1 ? A * n * (n - 1) * pow(r, n - 2) : 0;
        }
    }
    return slope;
}

/* How far out a surface is steepest, up to `edge`: among points in equal steps, and between those
   beside the steepest. */
static double steepest_place(const struct surface *surface, double edge)
{
    enum { ZONES = 64, HALVINGS = 50 };
    double most = -1;
    int at = ZONES;
    if (surface_profile(surface) <= PROFILE_CONIC) {
        return edge;
    }
    for (int i = ZONES; i >= 0; i--) {
        const double here = fabs(surface_slope_at(surface, edge * i / ZONES).value);
        at = here > most ? i : at;
        most = fmax(most, here);
    }
    if (at == ZONES || at == 0) {
        return edge * at / ZONES;
    }
    double low = edge * (at - 1) / ZONES, high = edge * (at + 1) / ZONES;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        const struct sag here = surface_slope_at(surface, middle);
        if ((here.value < 0 ? -here.by_radius : here.by_radius) > 0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/* -------- figures -------- */

/* A figure of a surface, and its derivatives by the numbers and the semi-diameter of it. */
struct surface_figure {
    double value, by_curvature, by_conic, by_reach, by_coefficient[LENS_COEFFICIENTS];
};

/* Its own place on the axis where r is 0: the order 0 of a cone has a slope there. */
static double power_of(double r, int order)
{
    return order == 0 ? 1 : pow(r, order);
}

static struct surface_figure surface_sag_figure(const struct surface *surface, double edge)
{
    const struct sag sag = merit_sag_at(surface, edge);
    struct surface_figure figure = {sag.value, sag.by_curvature, sag.by_conic, sag.by_radius, {0}};
    for (int term = 0; term < LENS_COEFFICIENTS; term++) {
        figure.by_coefficient[term] = power_of(edge, surface_order(term));
    }
    return figure;
}

/* The angle of the steepest place, rad. */
static struct surface_figure surface_slope_figure(const struct surface *surface, double edge)
{
    const double r = steepest_place(surface, edge);
    const struct sag slope = surface_slope_at(surface, r);
    const double by = (slope.value < 0 ? -1 : 1) / (1 + slope.value * slope.value);
    struct surface_figure figure = {atan(fabs(slope.value)),
                                    by * slope.by_curvature,
                                    by * slope.by_conic,
                                    r < edge ? 0 : by * slope.by_radius,
                                    {0}};
    for (int term = 0; term < LENS_COEFFICIENTS; term++) {
        const int n = surface_order(term);
        figure.by_coefficient[term] = by * n * power_of(r, n - 1);
    }
    return figure;
}

/* Semi-diameter over radius. */
static struct surface_figure surface_ratio_figure(const struct surface *surface, double edge)
{
    const double c = surface_base_curvature(surface).hi;
    return (struct surface_figure){
        .value = fabs(c) * edge, .by_curvature = c < 0 ? -edge : edge, .by_reach = fabs(c)};
}

/* By all columns, into merit->change. */
static void surface_figure_derive(struct merit *merit, const struct merit_place *place,
                                  size_t surface, const struct surface_figure *figure)
{
    const struct merit_light *light = &place->lights[0];
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] = (struct dual){
            figure->value, figure->by_reach * merit_reach_of(place, surface, j).slope};
    }
    for (size_t i = 0; i < light->link_count && merit->derives; i++) {
        const struct variable_link *link = &light->links[i];
        double slope = 0;
        if (link->basis.surface != surface) {
            continue;
        }
        if (link->basis.kind == PARAMETER_CURVATURE) {
            slope = figure->by_curvature;
        } else if (link->basis.kind == PARAMETER_CONIC) {
            slope = figure->by_conic;
        } else if (link->basis.kind == PARAMETER_COEFFICIENT) {
            slope = figure->by_coefficient[surface_term(link->basis.order)];
        }
        merit->change[link->variable].slope += slope * link->slope;
    }
}

size_t merit_prepare_surface(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                             struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct lens *lens = place->lens;
    size_t count = 0, first, end;
    bool reaches = false;
    if (slot->operand->kind == OPERAND_RATIO && !merit_inverse_check(slot->operand, error)) {
        return 0;
    }
    merit_surfaces(slot->operand, lens, &first, &end);
    for (size_t i = first; i < end; i++) {
        if (surface_has(&lens->surfaces[i], SURFACE_HAS_CURVE)) {
            count++;
            reaches = reaches || !lens->surfaces[i].has_diameter;
        }
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "none of these surfaces may be curved");
    }
    return reaches && !merit_reach_open(merit, slot, arena, error) ? 0 : count;
}

bool merit_fill_surface(struct merit *merit, const struct merit_slot *slot, double *residuals,
                        double *jacobian)
{
    const struct merit_place *place = &merit->places[slot->place];
    const enum operand_kind kind = slot->operand->kind;
    size_t at = 0, first, end;
    merit_light(merit, slot, NAN);
    if (place->reach != NULL && !merit_reach(merit, slot)) {
        return false;
    }
    merit_surfaces(slot->operand, place->lens, &first, &end);
    for (size_t i = first; i < end; i++) {
        const struct surface *surface = &place->lens->surfaces[i];
        if (!surface_has(surface, SURFACE_HAS_CURVE)) {
            continue;
        }
        const double edge = merit_reach_of(place, i, 0).value;
        struct surface_figure figure;
        if (kind == OPERAND_SAG) {
            figure = surface_sag_figure(surface, edge);
        } else if (kind == OPERAND_SLOPE) {
            figure = surface_slope_figure(surface, edge);
        } else {
            figure = surface_ratio_figure(surface, edge);
        }
        surface_figure_derive(merit, place, i, &figure);
        if (!(kind == OPERAND_RATIO ? merit_put_inverse(merit, slot, at, residuals, jacobian)
                                    : merit_put(merit, slot, at, residuals, jacobian))) {
            return error_prefix(&merit->why, "surface %zu: ", i + 1);
        }
        at++;
    }
    return true;
}
