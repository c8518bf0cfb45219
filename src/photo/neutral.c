/* photo/neutral.c - neutral-density filters to put on for a wanted light loss. */
/* SPDX-License-Identifier: MIT */
#include "photo/neutral.h"

#include <math.h>

/* The nearest stack of so many filters below and above what is wanted; its count 0: none. */
struct neutral_nearest {
    double wanted;
    struct neutral_stack below, above;
};

/* sums of logarithms of the same product differ by roundings */
static const double ROUNDING = 1e-12;

static void neutral_take(struct neutral_nearest *nearest, const struct neutral_stack *stack)
{
    struct neutral_stack *below = &nearest->below, *above = &nearest->above;
    if (stack->stops <= nearest->wanted + ROUNDING) {
        if (below->count == 0 || stack->stops > below->stops + ROUNDING) {
            *below = *stack;
        }
    } else if (above->count == 0 || stack->stops < above->stops - ROUNDING) {
        *above = *stack;
    }
}

/* Add `more` filters, all weaker than the last one, to a stack. */
static void neutral_search(const double *strengths, size_t weaker, size_t more,
                           const struct neutral_stack *begun, struct neutral_nearest *nearest)
{
    if (more == 0) {
        neutral_take(nearest, begun);
        return;
    }
    for (size_t i = weaker; i-- > 0;) {
        struct neutral_stack next = *begun;
        next.filters[next.count++] = i;
        next.stops += strengths[i];
        neutral_search(strengths, i, more - 1, &next, nearest);
    }
}

bool neutral_stacks(const double *strengths, size_t count, size_t most, double wanted,
                    struct neutral_stack stacks[NEUTRAL_STACKS], size_t *found, struct error *error)
{
    const struct neutral_stack none = {.count = 0};
    double low = -INFINITY, high = INFINITY; /* the nearest so far */
    *found = 0;
    if (!(wanted > 0) || isinf(wanted)) {
        return fail(error, ERROR_DOMAIN, "a wanted loss of %.6g stops is not above 0 and finite",
                    wanted);
    }
    if (count == 0 || count > NEUTRAL_STRENGTHS || most == 0 || most > NEUTRAL_FILTERS) {
        return fail(error, ERROR_DOMAIN,
                    "%zu filters, %zu on each other: there must be 1 to %d, and 1 to %d", count,
                    most, NEUTRAL_STRENGTHS, NEUTRAL_FILTERS);
    }
    for (size_t filters = 1; filters <= most; filters++) {
        struct neutral_nearest nearest = {wanted, none, none};
        neutral_search(strengths, count, filters, &none, &nearest);
        if (nearest.below.count > 0 && nearest.below.stops > low + ROUNDING) {
            low = nearest.below.stops;
            stacks[(*found)++] = nearest.below;
        }
        if (nearest.above.count > 0 && nearest.above.stops < high - ROUNDING) {
            high = nearest.above.stops;
            stacks[(*found)++] = nearest.above;
        }
    }
    return true;
}
