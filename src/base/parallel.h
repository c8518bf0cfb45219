/* base/parallel.h - one loop on several threads. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_PARALLEL_H
#define LENSCALC_BASE_PARALLEL_H

#include <stddef.h>

enum { PARALLEL_MOST = 256 };

/* Work on items begin .. end - 1; must not depend on how the items are cut. */
typedef void parallel_function(void *context, size_t begin, size_t end);

/*
 * Call `function` for pieces of 0 .. count - 1, on `threads` threads at once.
 *
 * Given     threads  this one included; 0 and 1 = only this one; at most PARALLEL_MOST
 *           piece    items a call, at least 1; big enough that taking one costs nothing (50 us)
 * Result    all items done. Where the system gives no thread, the others do its work
 */
void parallel_for(int threads, size_t count, size_t piece, parallel_function *function,
                  void *context);

#endif
