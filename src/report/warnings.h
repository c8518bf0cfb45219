/* report/warnings.h - what is doubtful about a question, said once each beside the answer. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_WARNINGS_H
#define LENSCALC_REPORT_WARNINGS_H

#include "base/arena.h"

#include <stddef.h>

enum { WARNINGS_MOST = 8 };

/* People read them below the table, JSON has them as "warnings"; else they go to standard error. */
struct warnings {
    struct arena arena;
    const char *texts[WARNINGS_MOST];
    size_t count;
    size_t left_out; /* beyond the most */
};

/* Add one, as by printf, unless it is there already. `doubts` may be null: nobody listens. */
void warnings_add(struct warnings *doubts, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* "and 3 more like these", in the arena; null if none is left out. */
const char *warnings_left_out(struct warnings *doubts);

#endif
