/* design/glass_choice.c - model glasses of a lens replaced by real ones. */
/* SPDX-License-Identifier: MIT */
#include "design/glass_choice.h"

#include "base/parallel.h"
#include "optics/pickup.h"

#include <math.h>
#include <string.h>

enum {
    NEAREST = 8,         /* candidates that are tried for one model glass */
    LAST = 3,            /* glasses whose combinations are searched */
    PAIR = 2,            /* so many in all are tried in all combinations */
    BESIDE = 5,          /* candidates beside each glass of a pair that is exchanged */
    MOST_EXCHANGES = 400 /* trials of exchanges of real glasses */
};

/* Conditions are met to this, in their deviations. */
static const double exactly = 1e-10;

/* An exchange of real glasses is worth it that gains this share of the merit. */
static const double least_gain = 1e-4;

/* How good a lens is. */
struct glass_rank {
    double missed; /* of a condition; 0: it is met */
    double merit;
};

/* Glasses that take the places of others: of one surface, or of two at once. */
struct glass_swap {
    size_t count;
    size_t surface[2];
    const struct glass_candidate *glass[2];
    double distance[2]; /* from what was there */
};

/* A lens some of whose glasses are real. */
struct glass_node {
    const struct glass_node *parent; /* null: none is */
    const struct lens *lens, *start; /* as optimised, and with the numbers of the question's lens */
    struct variable *list;           /* what still varies */
    size_t *origin;                  /* of these in the question's list */
    size_t count, depth;
    struct glass_swap swap; /* that made it of its parent */
    bool from_start;        /* it was found from there */
    struct glass_rank rank;
};

/* A swap, optimised. */
struct trial {
    struct glass_swap swap;
    struct glass_rank rank; /* infinite: the lens has no merit with it */
    double *numbers;
    bool from_start, is_stopped;
    long evaluations, iterations;
    struct error why;
};

struct glass_search_state {
    const struct glass_choice_task *task;
    struct arena *arena;
    size_t total;                     /* model glasses at first */
    const struct glass_node *best;    /* all of its glasses are real; null: none was found yet */
    const struct glass_node *deepest; /* most of its glasses are */
    struct error why;                 /* of a candidate that the lens had no merit with */
    struct glass_choice *choice;
};

/* What is optimised once. */
struct outcome {
    struct variables variables;
    struct merit merit;
    struct optimize_answer answer;
};

static bool is_better(struct glass_rank a, struct glass_rank b)
{
    return a.missed < b.missed || (a.missed == b.missed && a.merit < b.merit);
}

static struct glass_rank rank_of(double merit, double missed)
{
    return (struct glass_rank){missed <= exactly ? 0 : missed, merit};
}

/* -------- glasses -------- */

static size_t list_models(const struct lens *lens, const struct variable *list, size_t count,
                          size_t *surfaces)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        const size_t surface = list[i].what.surface;
        bool is_new = parameter_is_of_medium(list[i].what.kind) && surface < lens->surface_count &&
                      lens->surfaces[surface].medium.kind == MEDIUM_MODEL;
        for (size_t k = 0; k < found && is_new; k++) {
            is_new = surfaces[k] != surface;
        }
        if (is_new) {
            surfaces[found++] = surface;
        }
    }
    return found;
}

size_t glass_choice_models(const struct variables *variables, size_t *surfaces)
{
    return list_models(variables->lens, variables->list, variables->count, surfaces);
}

/* The candidate that a surface of the lens has; null: a model, or a glass that was not chosen. */
static const struct glass_candidate *candidate_of(const struct glass_choice_task *task,
                                                  const struct medium *medium)
{
    for (size_t i = 0; i < task->candidate_count && medium->kind == MEDIUM_GLASS; i++) {
        if (text_identical(task->candidates[i].medium.written, medium->written)) {
            return &task->candidates[i];
        }
    }
    return NULL;
}

/* The candidates nearest to what is behind a surface, a model glass or one of themselves, that the
   bounds of nd and Vd allow, nearest first, without that itself; how many. */
static size_t find_nearest_glasses(const struct glass_search_state *search,
                                   const struct glass_node *node, size_t surface,
                                   struct glass_swap swaps[NEAREST])
{
    const struct glass_choice_task *task = search->task;
    const struct variables *variables = task->question->variables;
    const struct medium *medium = &node->lens->surfaces[surface].medium;
    const struct glass_candidate *own = candidate_of(task, medium);
    const struct glass_candidate from =
        own != NULL ? *own
                    : (struct glass_candidate){.nd = medium->index.hi, .Vd = medium->abbe.hi};
    size_t count = 0;
    for (size_t i = 0; i < task->candidate_count; i++) {
        const struct glass_candidate *glass = &task->candidates[i];
        const double nd = (glass->nd - from.nd) / 0.1, Vd = (glass->Vd - from.Vd) / 10;
        const double off = glass->deviation - from.deviation;
        const double P = isnan(off) ? 0 : off / 0.02;
        const double distance = sqrt(nd * nd + Vd * Vd + P * P);
        bool is_allowed = glass != own;
        for (size_t k = 0; k < variables->count; k++) {
            const struct variable *one = &variables->list[k];
            if (one->what.surface == surface && parameter_is_of_medium(one->what.kind)) {
                const double value = one->what.kind == PARAMETER_INDEX ? glass->nd : glass->Vd;
                is_allowed = is_allowed && one->low <= value && value <= one->high;
            }
        }
        if (!is_allowed || (count == NEAREST && !(distance < swaps[count - 1].distance[0]))) {
            continue;
        }
        size_t at = count < NEAREST ? count++ : count - 1;
        for (; at > 0 && distance < swaps[at - 1].distance[0]; at--) {
            swaps[at] = swaps[at - 1];
        }
        swaps[at] = (struct glass_swap){1, {surface}, {glass}, {distance}};
    }
    return count;
}

/* What is tried in the place of the model glass that is farthest from all candidates; how many. */
static size_t list_farthest(const struct glass_search_state *search, const struct glass_node *node,
                            struct trial trials[NEAREST])
{
    size_t *surfaces = ARENA_ARRAY(search->arena, node->count + 1, size_t), count = 0;
    const size_t models = list_models(node->lens, node->list, node->count, surfaces);
    double farthest = -1;
    for (size_t i = 0; i < models; i++) {
        struct glass_swap nearest[NEAREST];
        const size_t found = find_nearest_glasses(search, node, surfaces[i], nearest);
        const double distance = found > 0 ? nearest[0].distance[0] : INFINITY;
        if (distance > farthest) {
            farthest = distance;
            count = found;
            for (size_t k = 0; k < found; k++) {
                trials[k] = (struct trial){.swap = nearest[k]};
            }
        }
    }
    return count;
}

/* -------- lenses -------- */

/* The lens with a real glass behind a surface, which varies no more, all numbers as they are. */
static const struct lens *lens_with_medium(const struct lens *from, size_t at,
                                           const struct medium *medium, struct arena *arena)
{
    struct lens *lens = parameter_apply(from, NULL, NULL, 0, arena);
    struct surface *surface = &lens->surfaces[at];
    struct vary *kept = ARENA_ARRAY(arena, surface->vary_count + 1, struct vary);
    size_t count = 0;
    for (size_t i = 0; i < surface->vary_count; i++) {
        const enum parameter_kind kind = surface->varies[i].kind;
        if (kind != PARAMETER_GLASS && !parameter_is_of_medium(kind)) {
            kept[count++] = surface->varies[i];
        }
    }
    surface->varies = kept;
    surface->vary_count = count;
    parameter_put_medium(lens, at, medium);
    lens_pickups_put(lens, lens_at_position(lens, 0, arena), arena);
    return lens;
}

static struct glass_node node_with_glasses(const struct glass_node *parent,
                                           const struct glass_swap *swap, struct arena *arena)
{
    struct glass_node child = {.parent = parent,
                               .lens = parent->lens,
                               .start = parent->start,
                               .depth = parent->depth + swap->count,
                               .swap = *swap};
    child.list = ARENA_ARRAY(arena, parent->count + 1, struct variable);
    child.origin = ARENA_ARRAY(arena, parent->count + 1, size_t);
    for (size_t k = 0; k < swap->count; k++) {
        const struct medium *medium = &swap->glass[k]->medium;
        child.lens = lens_with_medium(child.lens, swap->surface[k], medium, arena);
        child.start = lens_with_medium(child.start, swap->surface[k], medium, arena);
    }
    for (size_t i = 0; i < parent->count; i++) {
        const struct parameter *what = &parent->list[i].what;
        const bool is_swapped = what->surface == swap->surface[0] ||
                                (swap->count > 1 && what->surface == swap->surface[1]);
        if (!is_swapped || !parameter_is_of_medium(what->kind)) {
            child.list[child.count] = parent->list[i];
            child.origin[child.count++] = parent->origin[i];
        }
    }
    return child;
}

/* Optimise what varies of a lens: one of the node's two. */
static bool glass_choice_optimise(const struct glass_node *node, const struct lens *lens,
                                  const struct glass_choice_task *asked, struct arena *arena,
                                  struct outcome *outcome, struct error *error)
{
    struct merit_question question = *asked->question;
    struct optimize_task task = *asked->how;
    if (!variables_open(lens, node->list, node->count, arena, &outcome->variables, error)) {
        return false;
    }
    question.lens = lens;
    question.variables = &outcome->variables;
    question.variable_count = node->count;
    task.merit = &outcome->merit;
    return merit_open(&question, arena, &outcome->merit, error) &&
           optimize_run(&task, arena, &outcome->answer, error);
}

/* -------- trials -------- */

struct glass_trials {
    const struct glass_search_state *search;
    const struct glass_node *node;
    struct trial *trials;
};

/* From both of the lenses where that is worth it; the better is kept. */
static void try_pieces(void *context, const struct parallel_piece *piece)
{
    const struct glass_trials *trying = context;
    const struct glass_choice_task *task = trying->search->task;
    /* the start is near still */
    const bool is_few = trying->search->total <= LAST && trying->search->best != trying->node;
    struct arena *arena = piece->arena;
    for (size_t i = piece->begin; i < piece->end; i++) {
        struct trial *trial = &trying->trials[i];
        trial->rank = (struct glass_rank){INFINITY, INFINITY};
        for (int from_start = 0; from_start < 2; from_start++) {
            if (from_start == 1 && !is_few && !isinf(trial->rank.merit)) {
                continue;
            }
            const struct arena_mark mark = arena_mark(arena);
            const struct glass_node child = node_with_glasses(trying->node, &trial->swap, arena);
            struct outcome *outcome = ARENA_NEW(arena, struct outcome);
            const struct optimize_answer *answer = &outcome->answer;
            if (glass_choice_optimise(&child, from_start == 1 ? child.start : child.lens, task,
                                      arena, outcome, &trial->why)) {
                const struct glass_rank rank = rank_of(answer->after.merit, answer->summary.excess);
                trial->is_stopped = trial->is_stopped || answer->summary.status == SOLVER_STOPPED;
                trial->evaluations += answer->summary.evaluations;
                trial->iterations += answer->summary.iterations;
                if (is_better(rank, trial->rank)) {
                    trial->rank = rank;
                    trial->from_start = from_start == 1;
                    memcpy(trial->numbers, answer->after.numbers, child.count * sizeof(double));
                }
            } else {
                trial->why.more = NULL; /* it ends with this arena */
            }
            arena_reset(arena, mark);
        }
    }
}

/* All of them, in the order of their loss; false: there is no time for it. */
static bool try_all(struct glass_search_state *search, const struct glass_node *node,
                    struct trial *trials, size_t count)
{
    struct glass_trials trying = {search, node, trials};
    struct parallel *parallel = ARENA_NEW(search->arena, struct parallel);
    struct glass_choice *choice = search->choice;
    const struct optimize_task *how = search->task->how;
    parallel->threads = search->task->threads;
    for (size_t i = 0; i < count; i++) {
        trials[i].numbers = ARENA_ARRAY(search->arena, node->count + 1, double);
    }
    parallel_pieces(parallel, count, 1, try_pieces, &trying);
    parallel_free(parallel);
    choice->is_stopped = how->goes_on != NULL && !how->goes_on(how->context);
    for (size_t i = 0; i < count; i++) {
        choice->is_stopped = choice->is_stopped || trials[i].is_stopped;
        choice->evaluations += trials[i].evaluations;
        choice->iterations += trials[i].iterations;
        if (isinf(trials[i].rank.merit)) {
            search->why = trials[i].why;
        }
    }
    /* Those that lose least first; of equal ones the nearer. */
    for (size_t i = 1; i < count; i++) {
        const struct trial one = trials[i];
        size_t at = i;
        for (; at > 0 && is_better(one.rank, trials[at - 1].rank); at--) {
            trials[at] = trials[at - 1];
        }
        trials[at] = one;
    }
    return !choice->is_stopped;
}

/* -------- the search -------- */

/* Is it worth going on from a trial for one of so many glasses? */
static bool is_promising(const struct glass_search_state *search, size_t models,
                         const struct trial *trial)
{
    if (isinf(trial->rank.merit) || search->best == NULL) {
        return !isinf(trial->rank.merit); /* any is better than none */
    }
    const bool is_pair = search->total <= PAIR && models > 1;
    return models <= LAST && (is_pair || is_better(trial->rank, search->best->rank));
}

/* The lens of a trial, with its numbers. */
static struct glass_node *node_of_trial(const struct glass_node *parent, const struct trial *trial,
                                        struct arena *arena)
{
    struct glass_node *node = ARENA_NEW(arena, struct glass_node);
    struct variables variables;
    struct error ignored;
    *node = node_with_glasses(parent, &trial->swap, arena);
    node->rank = trial->rank;
    node->from_start = trial->from_start;
    /* as its trial has opened them */
    if (variables_open(node->lens, node->list, node->count, arena, &variables, &ignored)) {
        node->lens = variables_lens(&variables, trial->numbers, arena);
    }
    return node;
}

static void glass_node_descend(struct glass_search_state *search, const struct glass_node *parent)
{
    struct trial trials[NEAREST];
    struct arena *arena = search->arena;
    size_t *surfaces = ARENA_ARRAY(arena, parent->count + 1, size_t);
    const size_t models = list_models(parent->lens, parent->list, parent->count, surfaces);
    if (search->deepest == NULL || parent->depth > search->deepest->depth) {
        search->deepest = parent;
    }
    if (models == 0) {
        search->best = parent; /* as it was entered, it is better */
        return;
    }
    const size_t count = list_farthest(search, parent, trials);
    if (!try_all(search, parent, trials, count)) {
        return;
    }
    for (size_t i = 0; i < count && !search->choice->is_stopped; i++) {
        if (is_promising(search, models, &trials[i])) {
            glass_node_descend(search, node_of_trial(parent, &trials[i], arena));
        }
    }
}

/* -------- exchanges of real glasses -------- */

/* Of one glass all nearest, or of each two, both at once, some nearest of both; how many. */
static size_t list_exchanges(const struct glass_search_state *search, const struct glass_node *node,
                             const size_t *surfaces, bool are_pairs, struct trial *trials)
{
    size_t count = 0;
    for (size_t a = 0; a < search->total; a++) {
        struct glass_swap first[NEAREST], second[NEAREST];
        const size_t firsts = find_nearest_glasses(search, node, surfaces[a], first);
        for (size_t i = 0; i < firsts && !are_pairs; i++) {
            trials[count++] = (struct trial){.swap = first[i]};
        }
        for (size_t b = a + 1; b < search->total && are_pairs; b++) {
            const size_t seconds = find_nearest_glasses(search, node, surfaces[b], second);
            for (size_t i = 0; i < firsts && i < BESIDE; i++) {
                for (size_t k = 0; k < seconds && k < BESIDE; k++) {
                    trials[count++].swap =
                        (struct glass_swap){2,
                                            {surfaces[a], surfaces[b]},
                                            {first[i].glass[0], second[k].glass[0]},
                                            {first[i].distance[0], second[k].distance[0]}};
                }
            }
        }
    }
    return count;
}

/* Of a lens whose glasses are all real: one is exchanged, or two at once, as long as that gains. */
static void glass_search_exchange(struct glass_search_state *search, const size_t *surfaces)
{
    const size_t n = search->total;
    size_t left = MOST_EXCHANGES;
    bool are_pairs = false;
    while (left > 0 && !search->choice->is_stopped) {
        const size_t most = 1 + n * NEAREST + n * n * BESIDE * BESIDE;
        struct trial *trials = ARENA_ARRAY(search->arena, most, struct trial);
        size_t count = list_exchanges(search, search->best, surfaces, are_pairs, trials);
        count = count < left ? count : left;
        left -= count;
        if (!try_all(search, search->best, trials, count)) {
            return;
        }
        if (count > 0 && is_better(trials[0].rank, search->best->rank) &&
            trials[0].rank.merit < (1 - least_gain) * search->best->rank.merit) {
            search->best = node_of_trial(search->best, &trials[0], search->arena);
            are_pairs = false;
        } else if (are_pairs || n == 1) {
            return;
        } else {
            are_pairs = true;
        }
    }
}

/* What took whose place, from the first on. */
static void glass_choice_tell(const struct glass_node *found, struct arena *arena,
                              struct glass_choice *choice)
{
    choice->count = found->depth;
    choice->exchanges = ARENA_ARRAY(arena, found->depth, struct glass_exchange);
    for (const struct glass_node *node = found; node->parent != NULL; node = node->parent) {
        for (size_t k = 0; k < node->swap.count; k++) {
            const size_t surface = node->swap.surface[k];
            const struct medium *was = &node->parent->lens->surfaces[surface].medium;
            const bool is_model = was->kind == MEDIUM_MODEL;
            choice->exchanges[node->depth - node->swap.count + k] =
                (struct glass_exchange){.surface = surface,
                                        .nd = is_model ? was->index.hi : (double)NAN,
                                        .Vd = is_model ? was->abbe.hi : (double)NAN,
                                        .replaced = is_model ? NULL : was->written.start,
                                        .glass = node->swap.glass[k],
                                        .distance = node->swap.distance[k],
                                        .before = node->parent->rank.merit,
                                        .after = node->rank.merit,
                                        .is_joined = k + 1 < node->swap.count};
        }
    }
}

/* The last step once more, of which all is kept now: to its end, as it was; where the time is over
   it begins where that ended. */
static bool glass_choice_keep(struct glass_search_state *search, const struct glass_node *found,
                              struct error *error)
{
    struct glass_choice *choice = search->choice;
    struct optimize_task how = *search->task->how;
    struct glass_choice_task task = *search->task;
    struct outcome *outcome = ARENA_NEW(search->arena, struct outcome);
    const struct glass_node last = node_with_glasses(found->parent, &found->swap, search->arena);
    const struct lens *start = found->from_start ? last.start : last.lens;
    if (choice->is_stopped) {
        start = found->lens;
    }
    how.goes_on = choice->is_stopped ? how.goes_on : NULL;
    task.how = &how;
    if (!glass_choice_optimise(&last, start, &task, search->arena, outcome, error)) {
        return false;
    }
    choice->variables = outcome->variables;
    choice->merit = outcome->merit;
    choice->merit.question.variables = &choice->variables;
    choice->answer = outcome->answer;
    choice->origin = last.origin;
    choice->lens = variables_lens(&choice->variables, choice->answer.after.numbers, search->arena);
    glass_choice_tell(found, search->arena, choice);
    return true;
}

bool glass_choose(const struct glass_choice_task *task, struct arena *arena,
                  struct glass_choice *choice, struct error *error)
{
    const struct variables *variables = task->question->variables;
    struct glass_search_state search = {.task = task, .arena = arena, .choice = choice};
    struct glass_node *root = ARENA_NEW(arena, struct glass_node);
    size_t *surfaces = ARENA_ARRAY(arena, variables->count + 1, size_t);
    const size_t count = glass_choice_models(variables, surfaces);
    search.total = count;
    *choice = (struct glass_choice){.lens = task->lens};
    *root = (struct glass_node){.lens = task->lens,
                                .start = variables->lens,
                                .list = variables->list,
                                .origin = ARENA_ARRAY(arena, variables->count + 1, size_t),
                                .count = variables->count,
                                .rank = rank_of(task->merit, task->missed)};
    for (size_t i = 0; i < variables->count; i++) {
        root->origin[i] = i;
    }
    /* a pick-up of a number has nothing to follow in a real glass */
    for (size_t i = 0; i < task->lens->pickup_count; i++) {
        const struct lens_pickup *pickup = &task->lens->pickups[i];
        for (size_t k = 0; k < count; k++) {
            if (parameter_is_of_medium(pickup->from.kind) && pickup->from.surface == surfaces[k]) {
                return fail(error, ERROR_DOMAIN,
                            "%s follows a number of the glass behind surface %zu by a pick-up, "
                            "which a real glass cannot: let the glass follow, or hold it",
                            parameter_mark_write(pickup->what, arena), surfaces[k] + 1);
            }
        }
    }
    struct glass_swap nearest[NEAREST];
    for (size_t i = 0; i < count; i++) {
        if (find_nearest_glasses(&search, root, surfaces[i], nearest) == 0) {
            return fail(error, ERROR_DOMAIN, "no glass lies within the bounds of glass%zu",
                        surfaces[i] + 1);
        }
    }
    glass_node_descend(&search, root);
    if (search.best != NULL) {
        glass_search_exchange(&search, surfaces);
    }
    const struct glass_node *found = search.best != NULL ? search.best : search.deepest;
    choice->missing = search.best != NULL ? 0 : count - found->depth;
    if (choice->missing > 0 && !choice->is_stopped) {
        *error = search.why;
        return error_prefix(error, "the lens has no merit with any of the glasses: ");
    }
    return found->depth == 0 || glass_choice_keep(&search, found, error);
}
