/* commands/tool/bench_fit.c - the thick lens that lenscalc fit finds, as a model among others. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"
#include "commands/tool/bench.h"

bool bench_fit(const struct bench_input *input, const struct setup *setup, double distortion,
               struct run *run, struct thick_lens *thick, struct error *why)
{
    static const struct lens_policy fitted = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .fields = FIELDS_SPREAD};
    const struct fit_input fitting = {.object = NAN,
                                      .distortion = distortion,
                                      .show = FIT_PARAMETERS,
                                      .match = FIT_IMAGE,
                                      .pattern = PATTERN_GAUSS,
                                      .rays = 72,
                                      .no_clip = input->no_clip};
    if (run->no_solver != NULL) {
        *why = *run->no_solver;
        return false;
    }
    struct lens_question question = input->question;
    question.position = setup->position;
    question.field = question.field_x = NAN;
    struct lens_cursor at = lens_begin(&question, &fitted, run->arena);
    if (!lens_next_setup(&at, why)) {
        return false;
    }
    struct fit_job job = {.input = &fitting, .run = run, .setup = at.one.setup};
    if (!setup_light(job.setup, 0, &job.light, why) || !fit_job_run(&job, why)) {
        return false;
    }
    *thick = job.fit.lenses[0];
    return true;
}
