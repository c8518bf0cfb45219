/* commands/photo/exposure_propose.c - filters to put on for a wanted time. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "commands/photo/exposure_answer.h"
#include "photo/stops.h"

#include <math.h>
#include <stdlib.h>

/* Factors of neutral-density filters that many shops have: to ND1000 as in NiSi's guide "How strong
   is my ND filter?" (nisifilters.com.au), ND64000 as programs for photographers list it. */
static const double standard[] = {2, 4, 8, 16, 32, 64, 128, 256, 500, 1000, 64000};

static int compare_losses(const void *a, const void *b)
{
    const struct loss_value *left = a, *right = b;
    return (left->stops > right->stops) - (left->stops < right->stops);
}

/* The filters there are, the weakest first. */
static size_t filters_at_hand(const struct exposure_input *input, struct arena *arena,
                              struct loss_value **filters)
{
    const struct filters_value *own = &input->own;
    const size_t count = own->items != NULL ? own->count : sizeof standard / sizeof standard[0];
    struct loss_value *all = ARENA_ARRAY(arena, count, struct loss_value);
    for (size_t i = 0; i < count; i++) {
        if (own->items != NULL) {
            all[i] = own->items[i];
        } else {
            all[i] = (struct loss_value){stops_from_factor(standard[i]), 0,
                                         arena_printf(arena, "ND%.0f", standard[i])};
        }
    }
    qsort(all, count, sizeof *all, compare_losses);
    *filters = all;
    return count;
}

/* The stops from the time without further filters to the wanted one, both as metered. */
static bool wanted_stops(const struct exposure_input *bare, double wanted, double *stops,
                         struct error *error)
{
    struct exposure_row row;
    double metered = wanted; /* that the film, if any, turns into it */
    if (!exposure_answer(bare, &row, error)) {
        return false;
    }
    if (bare->film.model != NULL &&
        !reciprocity_metered(bare->film.model, wanted, &metered, error)) {
        return error_prefix(error, "%s: ", bare->film.name);
    }
    *stops = log2(metered / row.x.t);
    return *stops > 0 ||
           fail(error, ERROR_DOMAIN,
                "without another filter the time is %.4g s already: {--time} %.4g s is no longer, "
                "and {--propose} has nothing to do",
                isnan(row.corrected_time) ? row.x.t : row.corrected_time, wanted);
}

bool exposure_propose(const struct exposure_input *input, struct arena *arena,
                      struct exposure_input questions[NEUTRAL_STACKS],
                      const char *proposed[NEUTRAL_STACKS], size_t *count, double *stops,
                      struct error *error)
{
    struct exposure_input bare = *input;
    struct loss_value *filters;
    struct neutral_stack stacks[NEUTRAL_STACKS];
    if (isnan(input->given.t)) {
        return fail(error, ERROR_USAGE, "{--propose} needs the wanted time: {--time}");
    }
    bare.given.t = NAN;
    if (!wanted_stops(&bare, input->given.t, stops, error)) {
        return false;
    }
    const size_t there = filters_at_hand(input, arena, &filters);
    double *strengths = ARENA_ARRAY(arena, there, double);
    for (size_t i = 0; i < there; i++) {
        strengths[i] = filters[i].stops;
    }
    if (!neutral_stacks(strengths, there, NEUTRAL_FILTERS, *stops, stacks, count, error)) {
        return false;
    }
    for (size_t i = 0; i < *count; i++) {
        struct loss_value *loss = &questions[i].filter;
        const char *names = "";
        questions[i] = bare;
        for (size_t k = 0; k < stacks[i].count; k++) {
            const struct loss_value *one = &filters[stacks[i].filters[k]];
            names = arena_printf(arena, "%s%s%s", names, k > 0 ? "+" : "", one->name);
            loss->mired += one->mired;
        }
        loss->stops += stacks[i].stops;
        loss->name = input->filter.name != NULL
                         ? arena_printf(arena, "%s + %s", input->filter.name, names)
                         : arena_printf(arena, "%s (%.4g stops)", names, loss->stops);
        proposed[i] = names;
    }
    return true;
}
