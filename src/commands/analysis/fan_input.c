/* commands/analysis/fan_input.c - what lenscalc fan is asked, made ready for analysis/fan. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/fan_input.h"

const struct analysis_policy fan_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool fan_of_case(const struct analysis_case *one, size_t field, const struct fan_input *input,
                 struct arena *arena, struct fan *fan, struct error *error)
{
    const struct fan_question question = {
        .bundle = {.setup = one->setup,
                   .field = &one->setup->fields[field].point,
                   .clip = one->clip,
                   .from_entrance = input->question.aim == ANALYSIS_AIM_ENTRANCE},
        .about = (enum wave_about)input->reference,
        .points = (size_t)input->points};
    return fan_trace(&question, arena, fan, error);
}
