/* cli/answer/rows_team.h - combinations of a sweep answered by several threads, printed in their order. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_ROWS_TEAM_H
#define LENSCALC_CLI_ANSWER_ROWS_TEAM_H

#include "base/error.h"
#include "cli/question/command.h"

#include <stdbool.h>
#include <stddef.h>

/* The answer of one combination. Its rows live until the team is called again. */
struct team_answer {
    void *input;
    bool is_missing; /* the input cannot be had: `error` says why, and is the answer */
    char *rows;      /* count of row_size */
    size_t row_size, count, room;
    bool done;
    struct error error;     /* why it is not */
    struct error shortfall; /* as that of struct run */
};

struct team;

/*
 * Threads that answer; each has a `state` of its own from one answer to the next.
 *
 * Given     run    what they work with: arenas, state, emit and driver are their own, and there are
 *                  neither doubts nor a watch
 *           total  answers that will be asked for; each has its share of run.threads
 *           keeps  answers live until team_close
 */
struct team *team_open(const struct command *command, const struct run *run, size_t row_size,
                       size_t total, bool keeps, struct arena *arena);

/* How many answers are asked for at once, at most. */
size_t team_size(const struct team *team);

/* Answer `count` inputs; the rest of each answer is filled in. */
void team_answer(struct team *team, struct team_answer *answers, size_t count);

/* Null is no team. */
void team_close(struct team *team);

#endif
