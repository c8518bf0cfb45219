/* tests/unit/ranges.h - legal ranges: what is accepted at their ends, and what a refusal says. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_RANGES_H
#define LENSCALC_TESTS_UNIT_RANGES_H

#include "base/error.h"
#include "check.h"

static struct error error;

static inline void check_refused(bool accepted, enum error_code code, const char *message,
                                 const char *file, int line)
{
    check_at(!accepted && error.code == code, file, line, message);
    check_text_at(error.message, message, file, line);
    error = (struct error){.code = ERROR_NONE};
}

/* Inside: accepted. */
#define INSIDE(call) check_at((call), __FILE__, __LINE__, #call)

/* Outside, or asked wrongly: refused with exactly this message. */
#define OUTSIDE(call, message) check_refused((call), ERROR_DOMAIN, (message), __FILE__, __LINE__)
#define MISUSED(call, message) check_refused((call), ERROR_USAGE, (message), __FILE__, __LINE__)

#endif
