/* cli/child.h - another program, started without a shell, and its end. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_CHILD_H
#define LENSCALC_CLI_CHILD_H

#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>

struct child {
    char *const *words; /* the program, a path or a name that is looked for in PATH, and its
                           arguments; ends with null */
    bool is_read;       /* keep what it prints, else only what it says reaches standard error */
    struct text input;  /* what it reads from standard input; its start null: nothing */
    double seconds;     /* after which it is ended, if it is read */
    size_t most;        /* bytes that it may print, or say, if it is read */
};

struct child_end {
    int status;               /* as waitpid has it */
    bool is_missing;          /* if it was to be read: there is no such program */
    bool is_late, is_long;    /* it was ended: after so long, or having printed so much */
    struct text output, said; /* if it was read: its output; the first line of what it said */
};

/*
 * Run a program to its end. What it reads lies in a temporary file without a name. If this program
 * is interrupted meanwhile, so is the other one.
 *
 * Errors    ERROR_IO: it does not start, but for one that is to be read and missing; no pipe; no
 *           room for its input
 */
bool child_run(const struct child *child, struct child_end *end, struct arena *arena,
               struct error *error);

/* "status 127" or "signal 9": how it ended. */
const char *child_status(const struct child_end *end, struct arena *arena);

#endif
