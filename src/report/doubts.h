/* report/doubts.h - what is doubtful about a question, said once each beside the answer. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_DOUBTS_H
#define LENSCALC_REPORT_DOUBTS_H

#include "base/arena.h"

#include <stddef.h>

enum { DOUBTS_MOST = 8 };

/* People read them below the table, JSON has them as "warnings"; else they go to standard error. */
struct doubts {
    struct arena arena;
    const char *texts[DOUBTS_MOST];
    size_t count;
    size_t left_out; /* beyond the most */
};

/* Add one, as by printf, unless it is there already. `doubts` may be null: nobody listens. */
void doubts_add(struct doubts *doubts, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* "and 3 more like these", in the arena; null if none is left out. */
const char *doubts_left_out(struct doubts *doubts);

#endif
