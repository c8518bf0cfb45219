/* design/optimize_global.h - the best lenses that are found from starts between bounds. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_OPTIMIZE_GLOBAL_H
#define LENSCALC_DESIGN_OPTIMIZE_GLOBAL_H

#include "base/watch.h"
#include "design/optimize.h"
#include "design/solver/global.h"

#include <stdatomic.h>

/* What one start led to. */
struct global_result {
    bool is_done;
    size_t count;     /* of minima; 0: it is lost */
    const char *lost; /* why, in words that starts which are lost alike have in common */
    struct global_minimum *minima;
    long evaluations;
    struct global_minimum *moved; /* and what design/relocate.h made of them */
    size_t moved_count;
};

/* What is searched; the results are the same whatever the number of threads is. */
struct optimize_global {
    /* For their questions, which each start asks anew: no rays of one are seen by another. Of
       several layouts, with as many variables each, start k has that of layout k % layouts. */
    const struct merit *const *merits;
    size_t layouts;
    /* Numbers of a start; false: it has none. Null: the lens itself, then global_start. */
    bool (*place)(void *context, size_t start, struct arena *arena, double *numbers);
    int iterations; /* of a descent at most; 0: as solver_run has it */
    int escapes;
    uint64_t seed;
    double
        spread; /* of starts about the lens, in natural scales, where variables are not bounded */
    int threads;
    struct watch *watch;            /* counts starts */
    bool (*goes_on)(void *context); /* asked by all threads, once an iteration; or null */
    void (*pause)(void *context);   /* by one, now and then while no other works; or null */
    /* By all threads, when a start has led to lenses: its result is there. Or null */
    void (*found)(void *context, size_t start);
    void *context;
    size_t start_count;
    struct global_result *results; /* of the starts; what is done is not searched again */
    size_t begin, end;             /* those that are searched */
    /* Is it a lens that was found? Asked of what is kept; or null */
    bool (*accepts)(void *context, const struct lens *lens);
    long moved_evaluations; /* of design/relocate.h */
    size_t refused;         /* by it, and such as degenerate_words knows */
    _Atomic double best;    /* merit of the starts that are done; infinite: none yet */
    atomic_size_t losses;   /* starts that are lost */
};

/* Where starts lie. */
struct global_range {
    double *low, *high;    /* of the solver's numbers */
    const bool *is_spread; /* the variable has no two bounds: it lies about the lens */
};

/*
 * Between the bounds of a variable; without two of them within `spread` natural scales of the
 * lens.
 */
struct global_range optimize_global_range(const struct variables *variables, double spread,
                                          struct arena *arena);

/* The merit of a start. */
static inline const struct merit *optimize_global_merit(const struct optimize_global *global,
                                                        size_t start)
{
    return global->merits[start % global->layouts];
}

/* Of those that a start led to, then those that were made of them. */
static inline const struct global_minimum *global_result_minimum(const struct global_result *result,
                                                                 size_t i)
{
    return i < result->count ? &result->minima[i] : &result->moved[i - result->count];
}

/* Do the numbers of two starts mean one lens? */
bool optimize_global_same(const struct optimize_global *global, size_t start, const double *numbers,
                          size_t other, const double *others);

/* A merit that no other lens was judged by. */
struct global_fresh {
    struct variables variables;
    struct merit merit;
};

bool optimize_global_fresh(const struct merit *like, struct arena *arena,
                           struct global_fresh *fresh, struct error *error);

/*
 * Variables that nothing depends on: neither in the lens nor in the first starts.
 *
 * Result    is_idle of each variable; false where no start has a merit
 */
bool optimize_global_idle(struct optimize_global *global, struct arena *arena, bool *is_idle);

/* The best merit so far and how many starts are lost, for watch_tell: context is the search. */
void optimize_global_tell(const void *context, char *words, size_t room);

/*
 * Search from all starts that are not done. The first is the lens itself, so that nothing worse
 * than its own minimum is found; the others are global_start. Who has no merit, as rays are lost,
 * is first made one that has (optimize_begin).
 *
 * Result    results in the arena; is_done only of starts that goes_on let come to their end.
 *           Minima that are no lenses (design/degenerate.h) are left out
 */
void optimize_global_search(struct optimize_global *global, struct arena *arena);

/* A lens that was kept. */
struct global_kept {
    struct optimize_answer answer;
    const double *begun; /* where its last descent began */
    size_t start;        /* that led there, from 0 */
    size_t hits;         /* starts that led to it, or very near */
};

/*
 * The best that are different, the best first, each brought to its minimum.
 *
 * Given     task  of them, without a merit
 *           kept  room for `most`; receives them
 * Result    how many there are; once the watch has ended no more than one
 */
size_t optimize_global_keep(struct optimize_global *global, const struct optimize_task *task,
                            size_t most, struct arena *arena, struct global_kept *kept);

#endif
