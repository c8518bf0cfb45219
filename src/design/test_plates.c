/* design/test_plates.c - radii of a lens replaced by those of a maker's test plates. */
/* SPDX-License-Identifier: MIT */
#include "design/test_plates.h"

#include "optics/pickup.h"

#include <math.h>
#include <string.h>

enum {
    NEAREST = 6,         /* plates that are tried for one surface */
    BESIDE = 3,          /* and for each of two whose plates are exchanged */
    MOST_EXCHANGES = 200 /* trials of exchanges */
};

/* Conditions are met to this, in their deviations; an exchange gains this share of the merit. */
static const double exactly = 1e-10, least_gain = 1e-4;

/* A plate on one side of its radius; null: there is none yet. */
struct plate_side {
    const struct test_plate *plate;
    double radius; /* with its sign, mm */
};

/* Plates that take the places of what surfaces have: of one, or of two at once. */
struct plate_swap {
    size_t count;
    size_t at[2]; /* which of the surfaces */
    struct plate_side side[2];
};

/* A lens some of whose radii are those of plates, optimised. */
struct plate_lens {
    const struct lens *lens;
    struct plate_side *sides; /* one a surface that is fitted */
    double missed, merit;     /* infinite: it has no merit */
};

struct plate_search {
    const struct plate_task *task;
    struct arena *arena;
    size_t *surfaces, count;
    struct plate_lens best;
    struct plate_choice *choice;
    size_t room;
    struct error why;
};

/* What is optimised once. */
struct plate_outcome {
    struct variables variables;
    size_t *origin;
    struct merit merit;
    struct optimize_answer answer;
};

static bool is_radius(enum parameter_kind kind)
{
    return kind == PARAMETER_RADIUS || kind == PARAMETER_CURVATURE;
}

size_t plate_surfaces(const struct variables *variables, size_t *surfaces)
{
    size_t count = 0;
    for (size_t i = 0; i < variables->count; i++) {
        const struct variable *one = &variables->list[i];
        const size_t at = one->what.surface;
        bool is_sphere = is_radius(one->what.kind) && one->position == LENS_NONE &&
                         surface_is_round(&variables->lens->surfaces[at]) &&
                         surface_profile(&variables->lens->surfaces[at]) <= PROFILE_SPHERE;
        for (size_t k = 0; k < variables->count && is_sphere; k++) {
            const struct parameter *other = &variables->list[k].what;
            is_sphere = other->surface != at ||
                        (other->kind != PARAMETER_CONIC && other->kind != PARAMETER_COEFFICIENT);
        }
        if (is_sphere) {
            surfaces[count++] = at;
        }
    }
    return count;
}

static double curvature_at(const struct lens *lens, size_t surface)
{
    return parameter_get(lens, (struct parameter){.surface = surface, .kind = PARAMETER_CURVATURE});
}

/* Is the curvature within the bounds of the variable? */
static bool is_within(const struct plate_search *search, size_t surface, double radius)
{
    const struct variables *variables = search->task->question->variables;
    bool is = true;
    for (size_t i = 0; i < variables->count; i++) {
        const struct variable *one = &variables->list[i];
        if (one->what.surface == surface && is_radius(one->what.kind)) {
            const double value = one->what.kind == PARAMETER_RADIUS ? radius : 1 / radius;
            /* bounds of a radius on both sides of 0 lead through a plane */
            const bool is_through = one->what.kind == PARAMETER_RADIUS && one->low < 0 &&
                                    one->high > 0 && isfinite(one->low) && isfinite(one->high);
            is = is_through ? value <= one->low || value >= one->high
                            : one->low <= value && value <= one->high;
        }
    }
    return is;
}

/* The plates nearest in curvature, nearest first, without the one that is there; how many. */
static size_t find_nearest_plates(const struct plate_search *search, size_t k,
                                  struct plate_side nearest[NEAREST])
{
    const struct plate_task *task = search->task;
    const size_t surface = search->surfaces[k];
    const double c = curvature_at(search->best.lens, surface);
    size_t count = 0;
    for (size_t i = 0; i < 2 * task->plate_count; i++) {
        const struct test_plate *plate = &task->plates[i / 2];
        const double radius = i % 2 == 0 ? plate->radius : -plate->radius;
        const double off = fabs(1 / radius - c);
        if (plate->diameter < task->diameters[surface] || !is_within(search, surface, radius) ||
            (isinf(radius) && radius < 0) || radius == search->best.sides[k].radius ||
            (count == NEAREST && !(off < fabs(1 / nearest[count - 1].radius - c)))) {
            continue;
        }
        size_t at = count < NEAREST ? count++ : count - 1;
        for (; at > 0 && off < fabs(1 / nearest[at - 1].radius - c); at--) {
            nearest[at] = nearest[at - 1];
        }
        nearest[at] = (struct plate_side){plate, radius};
    }
    return count;
}

/* -------- lenses -------- */

/* The lens with the radii of plates, which vary no more. */
static struct lens *lens_with_plates(const struct plate_search *search, const struct lens *from,
                                     const struct plate_side *sides)
{
    struct arena *arena = search->arena;
    struct lens *lens = parameter_apply(from, NULL, NULL, 0, arena);
    for (size_t k = 0; k < search->count; k++) {
        struct surface *surface = &lens->surfaces[search->surfaces[k]];
        struct vary *kept = ARENA_ARRAY(arena, surface->vary_count + 1, struct vary);
        size_t count = 0;
        if (sides[k].plate == NULL) {
            continue;
        }
        for (size_t i = 0; i < surface->vary_count; i++) {
            if (!is_radius(surface->varies[i].kind)) {
                kept[count++] = surface->varies[i];
            }
        }
        surface->varies = kept;
        surface->vary_count = count;
        surface->has_curvature = false;
        surface->is_plane = isinf(sides[k].radius);
        surface->radius = figure_number(pair_of(sides[k].radius));
    }
    lens_pickups_put(lens, lens_at_position(lens, 0, arena), arena);
    return lens;
}

/* The lens with what varies of it still. */
static bool plate_variables(const struct plate_search *search, const struct lens *lens,
                            const struct plate_side *sides, struct plate_outcome *outcome,
                            struct error *error)
{
    struct arena *arena = search->arena;
    const struct variables *all = search->task->question->variables;
    struct variable *list = ARENA_ARRAY(arena, all->count + 1, struct variable);
    size_t count = 0;
    outcome->origin = ARENA_ARRAY(arena, all->count + 1, size_t);
    for (size_t i = 0; i < all->count; i++) {
        bool is_fitted = false;
        for (size_t k = 0; k < search->count && is_radius(all->list[i].what.kind); k++) {
            is_fitted |= all->list[i].what.surface == search->surfaces[k] && sides[k].plate != NULL;
        }
        if (!is_fitted) {
            list[count] = all->list[i];
            outcome->origin[count++] = i;
        }
    }
    return variables_open(lens, list, count, arena, &outcome->variables, error);
}

static bool plate_optimise(const struct plate_search *search, const struct lens *lens,
                           const struct plate_side *sides, const struct optimize_task *how,
                           struct plate_outcome *outcome, struct error *error)
{
    struct merit_question question = *search->task->question;
    struct optimize_task task = *how;
    if (!plate_variables(search, lens, sides, outcome, error)) {
        return false;
    }
    question.lens = lens;
    question.variables = &outcome->variables;
    question.variable_count = outcome->variables.count;
    task.merit = &outcome->merit;
    return merit_open(&question, search->arena, &outcome->merit, error) &&
           optimize_run(&task, search->arena, &outcome->answer, error);
}

/* Of what is tried the best. */
struct plate_trial {
    const struct plate_swap *swap; /* null: none has a merit */
    double missed, merit;
    double *numbers;
};

static void try_swap(struct plate_search *search, const struct plate_swap *swap,
                     struct plate_trial *best)
{
    struct arena *arena = search->arena;
    struct plate_choice *choice = search->choice;
    const struct arena_mark mark = arena_mark(arena);
    struct plate_side *sides = ARENA_COPY(arena, search->best.sides, search->count, 0);
    struct plate_outcome *outcome = ARENA_NEW(arena, struct plate_outcome);
    const struct optimize_answer *answer = &outcome->answer;
    for (size_t k = 0; k < swap->count; k++) {
        sides[swap->at[k]] = swap->side[k];
    }
    if (!plate_optimise(search, lens_with_plates(search, search->best.lens, sides), sides,
                        search->task->how, outcome, &search->why)) {
        search->why.more = NULL; /* it ends with this arena */
        arena_reset(arena, mark);
        return;
    }
    const double missed = answer->summary.excess <= exactly ? 0 : answer->summary.excess;
    choice->is_stopped = choice->is_stopped || answer->summary.status == SOLVER_STOPPED;
    choice->evaluations += answer->summary.evaluations;
    choice->iterations += answer->summary.iterations;
    if (best->swap == NULL || missed < best->missed ||
        (missed == best->missed && answer->after.merit < best->merit)) {
        best->swap = swap;
        best->missed = missed;
        best->merit = answer->after.merit;
        memcpy(best->numbers, answer->after.numbers, outcome->variables.count * sizeof(double));
    }
    arena_reset(arena, mark);
}

static struct plate_trial try_all(struct plate_search *search, const struct plate_swap *swaps,
                                  size_t count)
{
    const size_t numbers = search->task->question->variables->count + 1;
    struct plate_trial best = {.numbers = ARENA_ARRAY(search->arena, numbers, double)};
    for (size_t i = 0; i < count && !search->choice->is_stopped; i++) {
        try_swap(search, &swaps[i], &best);
    }
    return best;
}

/* Take a trial: the lens, and a row of each of its radii. */
static void plate_search_take(struct plate_search *search, const struct plate_trial *trial)
{
    struct arena *arena = search->arena;
    struct plate_choice *choice = search->choice;
    const struct plate_swap *swap = trial->swap;
    struct plate_lens next = {.sides = ARENA_COPY(arena, search->best.sides, search->count, 0),
                              .missed = trial->missed,
                              .merit = trial->merit};
    struct plate_outcome outcome;
    struct error ignored;
    for (size_t k = 0; k < swap->count; k++) {
        const size_t surface = search->surfaces[swap->at[k]];
        next.sides[swap->at[k]] = swap->side[k];
        choice->fits =
            arena_grow(arena, choice->fits, choice->count, &search->room, sizeof choice->fits[0]);
        choice->fits[choice->count++] =
            (struct plate_fit){.surface = surface,
                               .radius = 1 / curvature_at(search->best.lens, surface),
                               .fitted = swap->side[k].radius,
                               .plate = swap->side[k].plate,
                               .diameter = search->task->diameters[surface],
                               .before = search->best.merit,
                               .after = trial->merit,
                               .is_joined = k + 1 < swap->count};
    }
    next.lens = lens_with_plates(search, search->best.lens, next.sides);
    if (plate_variables(search, next.lens, next.sides, &outcome, &ignored)) {
        next.lens = variables_lens(&outcome.variables, trial->numbers, arena);
    }
    search->best = next;
}

/* -------- the search -------- */

/* The surface that has to change most, and the plates to try on it; how many. */
static size_t list_worst(const struct plate_search *search, struct plate_swap swaps[NEAREST])
{
    size_t count = 0;
    double most = -1;
    for (size_t k = 0; k < search->count; k++) {
        const size_t surface = search->surfaces[k];
        const double d = search->task->diameters[surface];
        struct plate_side nearest[NEAREST];
        if (search->best.sides[k].plate != NULL) {
            continue;
        }
        const size_t found = find_nearest_plates(search, k, nearest);
        const double c = curvature_at(search->best.lens, surface);
        const double off = found > 0 ? fabs(1 / nearest[0].radius - c) * d * d / 8 : (double)NAN;
        if (off > most) {
            most = off;
            count = found;
            for (size_t i = 0; i < found; i++) {
                swaps[i] = (struct plate_swap){1, {k}, {nearest[i]}};
            }
        }
    }
    return count;
}

/* Of surfaces that have plates: others for one of them, or for two at once; how many. */
static size_t list_exchanges(const struct plate_search *search, bool are_pairs,
                             struct plate_swap *swaps)
{
    size_t count = 0;
    for (size_t a = 0; a < search->count; a++) {
        struct plate_side first[NEAREST], second[NEAREST];
        if (search->best.sides[a].plate == NULL) {
            continue;
        }
        const size_t firsts = find_nearest_plates(search, a, first);
        for (size_t i = 0; i < firsts && !are_pairs; i++) {
            swaps[count++] = (struct plate_swap){1, {a}, {first[i]}};
        }
        for (size_t b = a + 1; b < search->count && are_pairs; b++) {
            const size_t seconds =
                search->best.sides[b].plate != NULL ? find_nearest_plates(search, b, second) : 0;
            for (size_t i = 0; i < firsts && i < BESIDE; i++) {
                for (size_t k = 0; k < seconds && k < BESIDE; k++) {
                    swaps[count++] = (struct plate_swap){2, {a, b}, {first[i], second[k]}};
                }
            }
        }
    }
    return count;
}

static void plate_search_exchange(struct plate_search *search)
{
    const size_t n = search->count, most = 1 + n * NEAREST + n * n * BESIDE * BESIDE;
    size_t left = MOST_EXCHANGES;
    for (bool are_pairs = false; left > 0 && !search->choice->is_stopped;) {
        struct plate_swap *swaps = ARENA_ARRAY(search->arena, most, struct plate_swap);
        size_t count = list_exchanges(search, are_pairs, swaps);
        count = count < left ? count : left;
        left -= count;
        const struct plate_trial trial = try_all(search, swaps, count);
        const struct plate_lens *best = &search->best;
        if (search->choice->is_stopped) {
            return;
        }
        if (trial.swap != NULL &&
            (trial.missed < best->missed ||
             (trial.missed == best->missed && trial.merit < (1 - least_gain) * best->merit))) {
            plate_search_take(search, &trial);
            are_pairs = false;
        } else if (are_pairs) {
            return;
        } else {
            are_pairs = true;
        }
    }
}

/* The lens that was found once more, of which all is kept now. */
static bool plate_search_keep(struct plate_search *search, struct error *error)
{
    struct plate_choice *choice = search->choice;
    struct plate_outcome *outcome = ARENA_NEW(search->arena, struct plate_outcome);
    struct optimize_task how = *search->task->how;
    how.goes_on = choice->is_stopped ? how.goes_on : NULL;
    if (!plate_optimise(search, search->best.lens, search->best.sides, &how, outcome, error)) {
        return false;
    }
    choice->variables = outcome->variables;
    choice->merit = outcome->merit;
    choice->merit.question.variables = &choice->variables;
    choice->answer = outcome->answer;
    choice->origin = outcome->origin;
    choice->lens = variables_lens(&choice->variables, choice->answer.after.numbers, search->arena);
    /* the row of the last one says what it came to */
    choice->fits[choice->count - 1].after = choice->answer.after.merit;
    for (size_t i = choice->count - 1; i > 0 && choice->fits[i - 1].is_joined; i--) {
        choice->fits[i - 1].after = choice->answer.after.merit;
    }
    return true;
}

bool plates_fit(const struct plate_task *task, struct arena *arena, struct plate_choice *choice,
                struct error *error)
{
    const struct variables *variables = task->question->variables;
    struct plate_search search = {.task = task, .arena = arena, .choice = choice};
    struct plate_swap swaps[NEAREST];
    *choice = (struct plate_choice){.lens = task->lens};
    search.surfaces = ARENA_ARRAY(arena, variables->count + 1, size_t);
    search.count = plate_surfaces(variables, search.surfaces);
    search.best =
        (struct plate_lens){.lens = task->lens,
                            .sides = ARENA_ARRAY(arena, search.count + 1, struct plate_side),
                            .missed = task->missed <= exactly ? 0 : task->missed,
                            .merit = task->merit};
    if (search.count == 0) {
        return fail(error, ERROR_DOMAIN, "no radius of a sphere varies");
    }
    for (size_t count = list_worst(&search, swaps); count > 0 && !choice->is_stopped;
         count = list_worst(&search, swaps)) {
        const struct plate_trial trial = try_all(&search, swaps, count);
        if (trial.swap == NULL) {
            *error = search.why;
            return choice->is_stopped ||
                   error_prefix(error, "the lens has no merit with any of the plates: ");
        }
        plate_search_take(&search, &trial);
    }
    if (!choice->is_stopped) {
        plate_search_exchange(&search);
    }
    choice->left = ARENA_ARRAY(arena, search.count + 1, size_t);
    for (size_t k = 0; k < search.count; k++) {
        if (search.best.sides[k].plate == NULL) {
            choice->left[choice->missing++] = search.surfaces[k];
        } else {
            choice->fitted++;
        }
    }
    return choice->fitted == 0 || plate_search_keep(&search, error);
}
