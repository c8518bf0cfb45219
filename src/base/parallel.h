/* base/parallel.h - one loop on several threads. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_PARALLEL_H
#define LENSCALC_BASE_PARALLEL_H

#include "base/arena.h"

#include <stddef.h>

enum { PARALLEL_MOST = 256 };

/* Work on items begin .. end - 1; must not depend on how the items are cut. */
typedef void parallel_function(void *context, size_t begin, size_t end);

/*
 * Call `function` for pieces of 0 .. count - 1, on `threads` threads at once.
 *
 * Given     threads  this one included; 0 and 1 = only this one; at most PARALLEL_MOST
 *           piece    items a call, at least 1; big enough that taking one costs nothing (50 us)
 * Result    all items done. Where the system gives no thread, or no memory for its work (up to
 *           16 MiB a thread), the others do that
 */
void parallel_for(int threads, size_t count, size_t piece, parallel_function *function,
                  void *context);

/* How many threads --threads asks for: at least 1; 0 = as many as there are cores. */
int parallel_threads(long asked);

/* One piece of a loop, and who works on it. */
struct parallel_piece {
    size_t begin, end;   /* items begin .. end - 1 */
    size_t number;       /* of the piece, in the order of the items */
    size_t thread;       /* 0 .. threads - 1 */
    struct arena *arena; /* that thread's own */
};

typedef void parallel_work(void *context, const struct parallel_piece *piece);

/*
 * A team of threads, each with its arena. Which thread takes a piece is chance: results go to the
 * places of their items, so that they are the same whatever the number of threads.
 */
struct parallel {
    int threads; /* as for parallel_for */
    struct arena arenas[PARALLEL_MOST];
};

/* The same loop; what the work keeps in its arenas lives until parallel_free. */
void parallel_pieces(struct parallel *parallel, size_t count, size_t piece, parallel_work *work,
                     void *context);

void parallel_free(struct parallel *parallel);

#endif
