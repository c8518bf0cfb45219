/* exchange/sequence_pickup.c - numbers that follow those of other surfaces. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/sequence.h"
#include "file/lens_words.h"

#include <math.h>

void sequence_pick_up(struct sequence *sequence, struct sequence_pickup pickup)
{
    *ARENA_ADD(sequence->job->arena, sequence->pickups, sequence->pickup_count,
               sequence->pickup_room) = pickup;
}

/* scale * figure + offset; digits are kept where nothing but the sign changes. */
static struct figure figure_followed(const struct sequence *sequence, struct figure source,
                                     const struct sequence_pickup *pickup, struct number_scale unit)
{
    if (pickup->offset.hi == 0 && fabs(pickup->scale.hi) == 1 && pickup->scale.lo == 0) {
        return pickup->scale.hi == 1 ? source : figure_negate(source, sequence->job->arena);
    }
    return figure_computed(pair_add(pair_multiply(pickup->scale, source.value), pickup->offset),
                           unit, sequence->job->arena);
}

static void follow_curve(const struct sequence *sequence, const struct sequence_pickup *pickup,
                         const struct sequence_surface *source, struct sequence_surface *target)
{
    const bool as_radius = pickup->what == SEQUENCE_RADIUS;
    const struct number_scale scale = sequence->commands->scale;
    struct figure curve = source->curve;
    bool plain = pickup->offset.hi == 0 && fabs(pickup->scale.hi) == 1;
    if (curve.value.hi != 0 && source->is_radius != as_radius && !plain) {
        curve.value = pair_divide(pair_of(1), curve.value);
    }
    if (plain) {
        target->is_radius = source->is_radius;
        target->curve = figure_followed(sequence, curve, pickup, scale);
        return;
    }
    target->is_radius = as_radius;
    target->curve = figure_followed(sequence, curve, pickup, as_radius ? scale : NUMBER_UNSCALED);
    if (!as_radius) {
        target->curve = commands_curvature(sequence->commands, target->curve.value);
    }
}

static void follow_profile(const struct sequence *sequence, const struct sequence_pickup *pickup,
                           const struct sequence_surface *source, struct sequence_surface *target)
{
    follow_curve(sequence, pickup, source, target);
    target->conic = source->conic;
    target->curved = source->curved;
    target->is_special = source->is_special;
    target->coefficients = source->coefficients;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        target->coefficient[i] = pickup->scale.hi < 0
                                     ? figure_negate(source->coefficient[i], sequence->job->arena)
                                     : source->coefficient[i];
    }
}

static void follow_turns(const struct sequence *sequence, const struct sequence_pickup *pickup,
                         const struct sequence_surface *source, struct sequence_surface *target)
{
    for (int i = 0; i < 3; i++) {
        target->shift[i] = figure_followed(sequence, source->shift[i], pickup, NUMBER_UNSCALED);
        target->turn[i] = figure_followed(sequence, source->turn[i], pickup, NUMBER_UNSCALED);
    }
    target->turns_first = source->turns_first != (pickup->scale.hi < 0);
    target->decentred_at = pickup->at;
}

static void follow_length(const struct sequence *sequence, const struct sequence_pickup *pickup,
                          struct sequence_surface *target)
{
    struct pair sum = {0, 0};
    for (size_t i = pickup->source; i < pickup->end; i++) {
        sum = pair_add(sum, sequence->surfaces[i].thickness.value);
    }
    sum = pair_add(pair_multiply(pickup->scale, sum), pickup->offset);
    target->thickness = figure_computed(sum, sequence->commands->scale, sequence->job->arena);
}

static bool apply_pickup(const struct sequence *sequence, const struct sequence_pickup *pickup)
{
    if (pickup->source >= sequence->count || pickup->target >= sequence->count ||
        pickup->source == pickup->target) {
        return commands_fail(sequence->commands, &pickup->at,
                             "a pick-up between surfaces %zu and %zu of %zu", pickup->source,
                             pickup->target, sequence->count);
    }
    const struct sequence_surface *source = &sequence->surfaces[pickup->source];
    struct sequence_surface *target = &sequence->surfaces[pickup->target];
    const struct number_scale scale = sequence->commands->scale;
    switch (pickup->what) {
    case SEQUENCE_RADIUS:
    case SEQUENCE_CURVATURE:
        follow_curve(sequence, pickup, source, target);
        break;
    case SEQUENCE_PROFILE:
        follow_profile(sequence, pickup, source, target);
        break;
    case SEQUENCE_THICKNESS:
        target->thickness = figure_followed(sequence, source->thickness, pickup, scale);
        break;
    case SEQUENCE_LENGTH:
        follow_length(sequence, pickup, target);
        break;
    case SEQUENCE_DIAMETER:
        target->diameter = figure_followed(sequence, source->diameter, pickup, scale);
        break;
    case SEQUENCE_CONIC:
        target->conic = figure_followed(sequence, source->conic, pickup, NUMBER_UNSCALED);
        break;
    case SEQUENCE_TURNS:
        follow_turns(sequence, pickup, source, target);
        break;
    case SEQUENCE_MEDIUM:
        target->medium = source->medium;
        break;
    }
    return true;
}

/* What a pick-up changes, and so what it follows: bits. */
enum { CURVE = 1, CONIC = 2, THICKNESS = 4, DIAMETER = 8, MEDIUM = 16, TURNS = 32 };
static const unsigned pickup_kinds[] = {[SEQUENCE_RADIUS] = CURVE,
                                        [SEQUENCE_CURVATURE] = CURVE,
                                        [SEQUENCE_THICKNESS] = THICKNESS,
                                        [SEQUENCE_DIAMETER] = DIAMETER,
                                        [SEQUENCE_CONIC] = CONIC,
                                        [SEQUENCE_MEDIUM] = MEDIUM,
                                        [SEQUENCE_PROFILE] = CURVE | CONIC,
                                        [SEQUENCE_LENGTH] = THICKNESS,
                                        [SEQUENCE_TURNS] = TURNS};

/* The pick-ups of a file while they are put in order. */
struct pickup_order {
    const struct sequence *sequence;
    size_t *first; /* pick-up of each surface, pickup_count = none */
    size_t *next;  /* pick-up of the same surface */
    enum { WAITING, BEGUN, DONE } * state;
};

/* Behind those that it follows. */
static bool apply_in_order(const struct pickup_order *ordering, size_t at)
{
    const struct sequence *sequence = ordering->sequence;
    const struct sequence_pickup *pickup = &sequence->pickups[at];
    if (ordering->state[at] == BEGUN) {
        return commands_fail(sequence->commands, &pickup->at,
                             "the pick-ups go in a circle: surface %zu follows surface %zu, which "
                             "follows it",
                             pickup->target, pickup->source);
    }
    if (ordering->state[at] == DONE) {
        return true;
    }
    ordering->state[at] = BEGUN;
    size_t end = pickup->what == SEQUENCE_LENGTH ? pickup->end : pickup->source + 1;
    end = pickup->source == pickup->target ? 0 : end; /* of itself: refused */
    for (size_t surface = pickup->source; surface < end && surface < sequence->count; surface++) {
        for (size_t i = ordering->first[surface]; i < sequence->pickup_count;
             i = ordering->next[i]) {
            if ((pickup_kinds[sequence->pickups[i].what] & pickup_kinds[pickup->what]) != 0 &&
                !apply_in_order(ordering, i)) {
                return false;
            }
        }
    }
    ordering->state[at] = DONE;
    return apply_pickup(sequence, pickup);
}

bool sequence_apply_pickups(const struct sequence *sequence)
{
    struct arena *arena = sequence->job->arena;
    size_t count = sequence->pickup_count;
    struct pickup_order ordering = {.sequence = sequence,
                                    .first = ARENA_ARRAY(arena, sequence->count + 1, size_t),
                                    .next = ARENA_ARRAY(arena, count + 1, size_t)};
    ordering.state = arena_array(arena, count + 1, sizeof ordering.state[0]);
    for (size_t i = 0; i < sequence->count; i++) {
        ordering.first[i] = count;
    }
    for (size_t i = count; i-- > 0;) {
        size_t target = sequence->pickups[i].target;
        if (target < sequence->count) {
            ordering.next[i] = ordering.first[target];
            ordering.first[target] = i;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (!apply_in_order(&ordering, i)) {
            return false;
        }
    }
    return true;
}

static void keep_parameter(const struct sequence *sequence, const struct sequence_pickup *pickup,
                           enum parameter_kind kind, int order, struct pair factor)
{
    const struct parameter what = {sequence->surfaces[pickup->target].place, kind, order};
    const struct parameter from = {sequence->surfaces[pickup->source].place, kind, order};
    keep_pickup(sequence->build->lens, what, from, factor, pickup->offset, sequence->job->arena);
}

/* The curve of a surface, its conic and its coefficients. */
static void keep_profile(const struct sequence *sequence, const struct sequence_pickup *pickup)
{
    const struct sequence_surface *source = &sequence->surfaces[pickup->source];
    keep_parameter(sequence, pickup, PARAMETER_CURVATURE, 0, pickup->scale);
    if (sequence_is_some(&source->conic)) {
        keep_parameter(sequence, pickup, PARAMETER_CONIC, 0, pair_of(1));
    }
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        if ((source->coefficients & 1u << i) != 0) {
            keep_parameter(sequence, pickup, PARAMETER_COEFFICIENT, surface_order(i),
                           pair_of(pickup->scale.hi < 0 ? -1 : 1));
        }
    }
}

void sequence_keep_pickups(const struct sequence *sequence)
{
    for (size_t i = 0; i < sequence->pickup_count && !sequence->has_positions; i++) {
        const struct sequence_pickup *pickup = &sequence->pickups[i];
        const struct sequence_surface *source = &sequence->surfaces[pickup->source],
                                      *target = &sequence->surfaces[pickup->target];
        bool within = pickup->source > 0 && pickup->target > 0 &&
                      pickup->source + 1 < sequence->count && pickup->target + 1 < sequence->count;
        bool gaps = source->planes_behind == 0 && target->planes_behind == 0;
        bool one = pickup->what != SEQUENCE_LENGTH || pickup->end == pickup->source + 1;
        if (!within) {
            continue;
        }
        switch (pickup->what) {
        case SEQUENCE_RADIUS:
            keep_parameter(sequence, pickup, PARAMETER_RADIUS, 0, pickup->scale);
            break;
        case SEQUENCE_CURVATURE:
            keep_parameter(sequence, pickup, PARAMETER_CURVATURE, 0, pickup->scale);
            break;
        case SEQUENCE_PROFILE:
            keep_profile(sequence, pickup);
            break;
        case SEQUENCE_CONIC:
            keep_parameter(sequence, pickup, PARAMETER_CONIC, 0, pickup->scale);
            break;
        case SEQUENCE_THICKNESS:
        case SEQUENCE_LENGTH:
            if (gaps && one) {
                keep_parameter(sequence, pickup, PARAMETER_THICKNESS, 0, pickup->scale);
            }
            break;
        case SEQUENCE_MEDIUM:
            keep_parameter(sequence, pickup, PARAMETER_GLASS, 0, pair_of(1));
            break;
        case SEQUENCE_DIAMETER:
        case SEQUENCE_TURNS:
            break;
        }
    }
}
