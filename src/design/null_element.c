/* design/null_element.c - elements of a lens taken out, and put in elsewhere without power. */
/* SPDX-License-Identifier: MIT */
#include "design/null_element.h"

#include <math.h>
#include <string.h>

/* The variable that is a number of a surface in all positions. */
static size_t null_variable(const struct variables *variables, enum parameter_kind kind,
                            size_t surface)
{
    for (size_t j = 0; j < variables->count; j++) {
        const struct variable *one = &variables->list[j];
        enum parameter_kind is = one->what.kind;
        is = is == PARAMETER_RADIUS ? PARAMETER_CURVATURE : is;
        if (is == kind && one->what.surface == surface && one->position == LENS_NONE) {
            return j;
        }
    }
    return LENS_NONE;
}

static bool null_is_air(const struct lens *lens, size_t surface)
{
    const struct medium *medium =
        surface == LENS_NONE ? &lens->object_medium : &lens->surfaces[surface].medium;
    return medium->kind == MEDIUM_CONSTANT && medium->index.hi == 1;
}

/* Does an element in air begin there, with curvatures that vary? */
static bool null_slot_open(const struct variables *variables, size_t surface,
                           struct null_slot *slot)
{
    const struct lens *lens = variables->lens;
    const size_t before = surface > 0 ? surface - 1 : LENS_NONE;
    if (surface + 1 >= lens->surface_count || !null_is_air(lens, before) ||
        null_is_air(lens, surface) || !null_is_air(lens, surface + 1) ||
        lens->stop == surface + 1) {
        return false;
    }
    *slot = (struct null_slot){
        .surface = surface,
        .curvature = {null_variable(variables, PARAMETER_CURVATURE, surface),
                      null_variable(variables, PARAMETER_CURVATURE, surface + 1)},
        .center = null_variable(variables, PARAMETER_THICKNESS, surface),
        .gap = null_variable(variables, PARAMETER_THICKNESS, surface + 1),
        .glass = {null_variable(variables, PARAMETER_INDEX, surface),
                  null_variable(variables, PARAMETER_ABBE, surface)}};
    if (slot->glass[0] == LENS_NONE || slot->glass[1] == LENS_NONE) {
        slot->glass[0] = slot->glass[1] = LENS_NONE;
    }
    return slot->curvature[0] != LENS_NONE && slot->curvature[1] != LENS_NONE;
}

/* May two elements change places? */
static bool null_slots_match(const struct lens *lens, const struct null_slot *a,
                             const struct null_slot *b)
{
    const struct medium *one = &lens->surfaces[a->surface].medium,
                        *other = &lens->surfaces[b->surface].medium;
    const bool vary = a->glass[0] != LENS_NONE && b->glass[0] != LENS_NONE;
    const bool are_one = a->glass[0] == LENS_NONE && b->glass[0] == LENS_NONE &&
                         one->kind == other->kind && one->written.length == other->written.length &&
                         memcmp(one->written.start, other->written.start, one->written.length) == 0;
    return vary || are_one;
}

/* Do all elements from one to another match? */
static bool null_range_matches(const struct null_elements *elements, size_t a, size_t b)
{
    bool match = true;
    const size_t first = a < b ? a : b, last = a < b ? b : a;
    for (size_t i = first; i < last; i++) {
        match = match && null_slots_match(elements->variables->lens, &elements->slots[i],
                                          &elements->slots[i + 1]);
    }
    return match;
}

void null_elements_open(const struct variables *variables, struct arena *arena,
                        struct null_elements *elements)
{
    const struct lens *lens = variables->lens;
    struct null_slot *slots = ARENA_ARRAY(arena, lens->surface_count + 1, struct null_slot);
    *elements = (struct null_elements){.variables = variables, .slots = slots};
    for (size_t i = 0; i < lens->surface_count; i++) {
        elements->count += null_slot_open(variables, i, &slots[elements->count]);
    }
    const size_t n = elements->count;
    struct null_move *moves = ARENA_ARRAY(arena, 2 * n * n + 1, struct null_move);
    for (size_t taken = 0; taken < n; taken++) {
        for (size_t neighbour = 0; neighbour < n; neighbour++) {
            for (int side = 0; side < 2; side++) {
                /* where the neighbour is without the one that is taken, and with the new one */
                const size_t rest = neighbour - (neighbour > taken);
                const struct null_move move = {.taken = taken,
                                               .put = rest + (size_t)side,
                                               .neighbour = rest + (size_t)(side == 0),
                                               .is_behind = side == 1};
                if (neighbour != taken && null_range_matches(elements, taken, move.put) &&
                    null_range_matches(elements, move.put, move.neighbour)) {
                    moves[elements->move_count++] = move;
                }
            }
        }
    }
    elements->moves = moves;
}

static void null_put(const struct null_elements *elements, size_t variable, double value,
                     double *to)
{
    if (variable != LENS_NONE) {
        const struct variables *variables = elements->variables;
        to[variable] = fmax(variables->low[variable], fmin(variables->high[variable], value));
    }
}

/* Where there is a bound it, else a hundredth of the lens's size. */
static double null_least(const struct null_elements *elements, size_t variable)
{
    const struct variables *variables = elements->variables;
    const double low = variables->low[variable];
    return low > 0 && isfinite(low) ? low : variables->scale[variable] / 10;
}

static double null_value(const double *numbers, size_t variable)
{
    return variable != LENS_NONE ? numbers[variable] : 0;
}

/* The numbers of one element become those of another place. */
static void null_copy(const struct null_elements *elements, const struct null_slot *source,
                      const struct null_slot *target, const double *from, double *to)
{
    for (size_t k = 0; k < 2; k++) {
        null_put(elements, target->curvature[k], from[source->curvature[k]], to);
        if (target->glass[k] != LENS_NONE && source->glass[k] != LENS_NONE) {
            null_put(elements, target->glass[k], from[source->glass[k]], to);
        }
    }
    if (source->center != LENS_NONE) {
        null_put(elements, target->center, from[source->center], to);
    }
    if (source->gap != LENS_NONE) {
        null_put(elements, target->gap, from[source->gap], to);
    }
}

void null_elements_bend(const struct null_elements *elements, const struct null_move *move,
                        double bend, double *numbers)
{
    const struct null_slot *null = &elements->slots[move->put],
                           *neighbour = &elements->slots[move->neighbour];
    const double c = numbers[neighbour->curvature[move->is_behind]];
    const size_t outer = null->curvature[move->is_behind];
    null_put(elements, null->curvature[0], c, numbers);
    null_put(elements, null->curvature[1], c, numbers);
    null_put(elements, outer, c + bend * elements->variables->scale[outer], numbers);
}

void null_elements_move(const struct null_elements *elements, const struct null_move *move,
                        const double *from, double *to, bool *is_null)
{
    const struct null_slot *slots = elements->slots;
    const size_t n = elements->variables->count;
    memcpy(to, from, n * sizeof *to);
    memset(is_null, 0, n * sizeof *is_null);
    /* the room that the one leaves goes to the gap before it */
    if (move->taken > 0) {
        const struct null_slot *left = &slots[move->taken], *before = left - 1;
        const double room = null_value(from, left->center) + null_value(from, left->gap);
        null_put(elements, before->gap, null_value(from, before->gap) + room, to);
    }
    double *at = to;
    const size_t first = move->taken < move->put ? move->taken : move->put;
    const size_t last = move->taken < move->put ? move->put : move->taken;
    /* those between move on by one; each is read before it is written over */
    for (size_t k = 0; k < last - first; k++) {
        const bool is_back = move->taken < move->put;
        const size_t target = is_back ? first + k : last - k;
        null_copy(elements, &slots[is_back ? target + 1 : target - 1], &slots[target], at, at);
    }
    const struct null_slot *null = &slots[move->put], *neighbour = &slots[move->neighbour];
    const double gap = null_value(to, neighbour->gap);
    null_copy(elements, neighbour, null, to, to);
    if (null->center != LENS_NONE) {
        null_put(elements, null->center, null_least(elements, null->center), to);
    }
    if (move->is_behind && null->gap != LENS_NONE && neighbour->gap != LENS_NONE) {
        null_put(elements, neighbour->gap, null_least(elements, neighbour->gap), to);
        null_put(elements, null->gap, gap - null_value(to, null->center), to);
    } else if (!move->is_behind && null->gap != LENS_NONE) {
        null_put(elements, null->gap, null_least(elements, null->gap), to);
    }
    null_elements_bend(elements, move, 0, to);
    const size_t own[] = {null->curvature[0], null->curvature[1], null->center,
                          null->gap,          null->glass[0],     null->glass[1]};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++) {
        if (own[i] != LENS_NONE) {
            is_null[own[i]] = true;
        }
    }
}
