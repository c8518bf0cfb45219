/* cli/answer/rows_team.c - combinations of a sweep answered by several threads, printed in their order. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/rows_team.h"

#include "base/parallel.h"

#include <string.h>

enum { EACH = 16 };

/* What a thread has to itself. */
struct member {
    struct arena kept;
    void *state;
};

struct team {
    const struct command *command;
    struct run run;
    size_t row_size;
    bool keeps;
    struct parallel parallel;
    struct member members[PARALLEL_MOST];
    struct team_answer *answers; /* of the present call */
};

static bool keep_row(struct run *run, const void *row)
{
    struct team_answer *answer = run->driver;
    const size_t size = answer->row_size;
    answer->rows = arena_grow(run->arena, answer->rows, answer->count, &answer->room, size);
    memcpy(answer->rows + answer->count * size, row, size);
    answer->count++;
    return true;
}

static void answer_piece(void *context, const struct parallel_piece *piece)
{
    struct team *team = context;
    struct member *member = &team->members[piece->thread];
    for (size_t i = piece->begin; i < piece->end; i++) {
        struct team_answer *answer = &team->answers[i];
        struct run run = team->run;
        run.arena = piece->arena;
        run.kept = &member->kept;
        run.state = member->state;
        run.emit = keep_row;
        run.driver = answer;
        run.doubts = NULL;
        run.leads = NULL;
        run.watch = NULL;
        run.shortfall.code = ERROR_NONE;
        answer->rows = NULL;
        answer->row_size = team->row_size;
        answer->count = answer->room = 0;
        answer->done =
            !answer->is_missing && team->command->run(answer->input, &run, &answer->error);
        answer->shortfall = run.shortfall;
        member->state = run.state;
    }
}

struct team *team_open(const struct command *command, const struct run *run, size_t row_size,
                       size_t total, bool keeps, struct arena *arena)
{
    struct team *team = ARENA_NEW(arena, struct team);
    team->command = command;
    team->run = *run;
    team->row_size = row_size;
    team->keeps = keeps;
    team->parallel.threads = run->threads;
    team->run.threads = (int)((size_t)run->threads / total);
    return team;
}

size_t team_size(const struct team *team)
{
    return (size_t)team->parallel.threads * EACH;
}

void team_answer(struct team *team, struct team_answer *answers, size_t count)
{
    for (int i = 0; i < team->parallel.threads && !team->keeps; i++) {
        arena_reset(&team->parallel.arenas[i], (struct arena_mark){NULL, 0});
    }
    team->answers = answers;
    parallel_pieces(&team->parallel, count, 1, answer_piece, team);
}

void team_close(struct team *team)
{
    if (team == NULL) {
        return;
    }
    for (int i = 0; i < team->parallel.threads; i++) {
        arena_free(&team->members[i].kept);
    }
    parallel_free(&team->parallel);
}
