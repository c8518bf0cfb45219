/* commands/analysis/spot_question.c - what lenscalc spot is asked. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/spot_question.h"

const struct analysis_policy spot_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool spot_question_of(const struct analysis_case *one, size_t field, const struct spot_input *input,
                      struct spot_question *question, struct error *error)
{
    const struct analysis_question *asked = &input->question;
    const size_t surfaces = one->setup->lens->surface_count;
    *question = (struct spot_question){
        .bundle = analysis_bundle(one, field),
        .rays = asked->rays != NO_INTEGER && asked->rays > 0 ? (size_t)asked->rays : 0,
        .error = asked->error,
        .to = input->to > 0 ? (size_t)input->to : 0,
        .about_chief = input->reference == SPOT_ABOUT_CHIEF,
        .energy = input->energy};
    return question->to <= surfaces ||
           fail(error, ERROR_USAGE, "{--to} %ld: the lens has %zu surfaces", input->to, surfaces);
}
