/* design/merit/merit_element.c - operands of pieces of glass: proportions, weight, cost. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_kinds.h"
#include "design/merit/merit_shape.h"

#include "base/constants.h"
#include "trace/aim/sample.h"

#include <math.h>

enum { NODES = 32 }; /* of an integral over a surface: exact to rounding up to 0.9 of its radius */

/* What weights and costs need. */
struct element_sums {
    struct dual *sum;                    /* one a column */
    double places[NODES], shares[NODES]; /* of a semi-diameter: r/a, and widths over a */
};

/* A piece of glass behind a surface; what is behind a mirror is that before it. */
static bool glass_behind(const struct lens *lens, size_t surface, struct space *space)
{
    return !surface_reflects(&lens->surfaces[surface]) &&
           merit_space_behind(lens, surface, space) && !space->is_air;
}

/* The larger of the two semi-diameters of a piece of glass, of one column. */
static struct dual glass_rim_of(const struct merit_place *place, const struct space *space,
                                size_t column)
{
    const bool is_left =
        merit_reach_of(place, space->left, 0).value > merit_reach_of(place, space->right, 0).value;
    return merit_reach_of(place, is_left ? space->left : space->right, column);
}

/* Its thickness on the axis, signed, by all columns, into merit->change. */
static void glass_thickness(struct merit *merit, const struct merit_place *place,
                            const struct space *space)
{
    const struct merit_light *light = &place->lights[0];
    double value = 0;
    for (size_t i = space->left; i < space->right; i++) {
        value += place->lens->surfaces[i].thickness.value.hi;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] = dual_of(space->direction * value);
    }
    for (size_t i = 0; i < light->link_count && merit->derives; i++) {
        const struct variable_link *link = &light->links[i];
        if (link->basis.kind == PARAMETER_THICKNESS && link->basis.surface >= space->left &&
            link->basis.surface < space->right) {
            merit->change[link->variable].slope += space->direction * link->slope;
        }
    }
}

/* -------- volumes -------- */

/*
 * Add, by all columns, what lies between a surface and the plane at its vertex, out to a rim: the
 * curve to the surface's own semi-diameter a, and flat from there.
 *
 * Formula   2 pi int_0^a z r dr + pi (b^2 - a^2) z(a), b the rim; by Gauss and Legendre
 */
static void add_cap(struct merit *merit, const struct merit_place *place, const struct space *space,
                    const struct element_sums *sums, bool is_right)
{
    const size_t surface = is_right ? space->right : space->left;
    const double sign = is_right ? space->direction : -space->direction;
    const struct surface *at = &place->lens->surfaces[surface];
    const struct merit_light *light = &place->lights[0];
    const double a = merit_reach_of(place, surface, 0).value;
    const double b = glass_rim_of(place, space, 0).value;
    const double ring = PI * (b - a) * (b + a);
    /* the rim of the curve is the last place, with the weight of the ring */
    struct sag sags[NODES + 1];
    double places[NODES + 1], areas[NODES + 1], value = 0;
    for (int k = 0; k <= NODES; k++) {
        places[k] = k < NODES ? a * sums->places[k] : a;
        areas[k] = k < NODES ? 2 * PI * a * places[k] * sums->shares[k] : ring;
        sags[k] = merit_sag_at(at, places[k]);
        value += areas[k] * sags[k].value;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        const double by_a = ring * sags[NODES].by_radius;
        const double by_b = 2 * PI * b * sags[NODES].value;
        merit->change[j].value += sign * value;
        merit->change[j].slope += sign * (by_a * merit_reach_of(place, surface, j).slope +
                                          by_b * glass_rim_of(place, space, j).slope);
    }
    for (size_t i = 0; i < light->link_count && merit->derives; i++) {
        const struct variable_link *link = &light->links[i];
        double slope = 0;
        for (int k = 0; k <= NODES && link->basis.surface == surface; k++) {
            slope += areas[k] * merit_sag_slope(&sags[k], places[k], link->basis);
        }
        merit->change[link->variable].slope += sign * slope * link->slope;
    }
}

/* The volume of a piece of glass, a cylinder of its larger semi-diameter between its surfaces. */
static void glass_volume(struct merit *merit, const struct merit_place *place,
                         const struct space *space, const struct element_sums *sums)
{
    glass_thickness(merit, place, space);
    for (size_t j = 0; j < merit_columns(merit); j++) {
        const struct dual rim = glass_rim_of(place, space, j);
        merit->change[j] = dual_multiply(merit->change[j], dual_scale(dual_multiply(rim, rim), PI));
    }
    add_cap(merit, place, space, sums, true);
    add_cap(merit, place, space, sums, false);
}

/* -------- kinds -------- */

/* What a mm^3 counts: g, or g times the price of a mass. */
static double glass_counts(enum operand_kind kind, const struct medium *medium)
{
    const double grams = medium->density / 1000;
    return kind == OPERAND_COST ? grams * medium->price : grams;
}

static bool glass_check(enum operand_kind kind, const struct lens *lens, size_t surface,
                        struct error *error)
{
    const struct medium *medium = &lens->surfaces[surface].medium;
    const bool is_dense = medium->density > 0;
    if (kind == OPERAND_ASPECT || (is_dense && (kind == OPERAND_WEIGHT || medium->price > 0))) {
        return true;
    }
    fail(error, ERROR_DOMAIN, "the %s of %.*s behind surface %zu is not known",
         is_dense ? "price" : "density", text_shown(medium->written), medium->written.start,
         surface + 1);
    return is_dense ? error_hint(error, "lines OD of catalogues in AGF have prices")
                    : error_hint(error, "glasses of catalogues have one: N-BK7");
}

size_t merit_prepare_element(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                             struct error *error)
{
    const struct lens *lens = merit->places[slot->place].lens;
    const enum operand_kind kind = slot->operand->kind;
    size_t count = 0, first, end;
    bool reaches = false;
    struct space space;
    if (kind == OPERAND_ASPECT && !merit_inverse_check(slot->operand, error)) {
        return 0;
    }
    merit_surfaces(slot->operand, lens, &first, &end);
    for (size_t i = first; i < end; i++) {
        if (!glass_behind(lens, i, &space)) {
            continue;
        }
        if (!glass_check(kind, lens, i, error)) {
            return 0;
        }
        count++;
        reaches = reaches || !lens->surfaces[space.left].has_diameter ||
                  !lens->surfaces[space.right].has_diameter;
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "no glass lies behind these surfaces");
        return 0;
    }
    if (reaches && !merit_reach_open(merit, slot, arena, error)) {
        return 0;
    }
    struct element_sums *sums = ARENA_NEW(arena, struct element_sums);
    sums->sum = ARENA_ARRAY(arena, merit->variable_count + 1, struct dual);
    gauss_rule(NODES, sums->places, sums->shares);
    slot->own = sums;
    return kind == OPERAND_ASPECT ? count : 1;
}

/* Thickness over diameter, which is not infinite. */
static bool put_aspect(struct merit *merit, const struct merit_slot *slot,
                       const struct space *space, size_t at, double *residuals, double *jacobian)
{
    const struct merit_place *place = &merit->places[slot->place];
    glass_thickness(merit, place, space);
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] =
            dual_divide(merit->change[j], dual_scale(glass_rim_of(place, space, j), 2));
    }
    return merit_put_inverse(merit, slot, at, residuals, jacobian);
}

bool merit_fill_element(struct merit *merit, const struct merit_slot *slot, double *residuals,
                        double *jacobian)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct lens *lens = place->lens;
    const enum operand_kind kind = slot->operand->kind;
    const size_t columns = merit_columns(merit);
    const struct element_sums *sums = slot->own;
    struct dual *sum = sums->sum;
    struct space space;
    size_t at = 0, first, end;
    merit_light(merit, slot, NAN);
    if (place->reach != NULL && !merit_reach(merit, slot)) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        sum[j] = dual_of(0);
    }
    merit_surfaces(slot->operand, lens, &first, &end);
    for (size_t i = first; i < end; i++) {
        if (!glass_behind(lens, i, &space)) {
            continue;
        }
        if (kind == OPERAND_ASPECT) {
            if (!put_aspect(merit, slot, &space, at++, residuals, jacobian)) {
                return error_prefix(&merit->why, "the glass behind surface %zu: ", i + 1);
            }
            continue;
        }
        glass_volume(merit, place, &space, sums);
        for (size_t j = 0; j < columns; j++) {
            const double share = glass_counts(kind, &lens->surfaces[i].medium);
            sum[j] = dual_add(sum[j], dual_scale(merit->change[j], share));
        }
    }
    for (size_t j = 0; j < columns && kind != OPERAND_ASPECT; j++) {
        merit->change[j] = sum[j];
    }
    return kind == OPERAND_ASPECT || merit_put(merit, slot, 0, residuals, jacobian);
}
