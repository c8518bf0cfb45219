/* design/tolerance/tolerance_model.c - trials of tolerances as plain functions of errors. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/tolerance_model.h"

#include <string.h>

static bool tolerance_model_try(void *context, const double *errors, double *figures,
                                struct error *why)
{
    struct tolerance_model *model = context;
    const size_t count = model->tolerance->figure_count;
    struct tolerance_trial trial = {.figures = figures, .moves = figures + count};
    if (tolerance_trial(model->tolerance, errors, &trial)) {
        return true;
    }
    *why = trial.why;
    return false;
}

static bool is_root(enum criterion_kind kind)
{
    return kind == CRITERION_SPOT || kind == CRITERION_WAVEFRONT || kind == CRITERION_BORESIGHT;
}

void tolerance_model_open(struct tolerance *tolerance, struct watch *watch, struct arena *arena,
                          struct tolerance_model *model)
{
    const struct tolerance_question *question = &tolerance->question;
    const size_t figures = tolerance->figure_count, moves = tolerance_moves(tolerance);
    bool *roots = ARENA_ARRAY(arena, figures + moves, bool);
    const char **names = ARENA_ARRAY(arena, question->perturbation_count + 1, const char *);
    for (size_t f = 0; f < figures; f++) {
        roots[f] = is_root(question->criterion.kind);
    }
    for (size_t i = 0; i < question->perturbation_count; i++) {
        names[i] = question->perturbations[i].name;
    }
    *model = (struct tolerance_model){.tolerance = tolerance,
                                      .problem = {.trial = tolerance_model_try,
                                                  .context = model,
                                                  .error_count = question->perturbation_count,
                                                  .figure_count = figures + moves,
                                                  .judged_count = figures,
                                                  .is_root = roots,
                                                  .names = names,
                                                  .watch = watch},
                                      .nominal = ARENA_ARRAY(arena, figures + moves, double)};
    watch_begin(watch, "trials", 0);
    memcpy(model->nominal, tolerance->nominal, figures * sizeof(double));
    memcpy(model->nominal + figures, tolerance->nominal_moves, moves * sizeof(double));
}
