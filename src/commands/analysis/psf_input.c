/* commands/analysis/psf_input.c - what lenscalc psf is asked. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/psf_input.h"

const struct analysis_policy psf_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool psf_of_case(const struct analysis_case *one, size_t field, const struct psf_input *input,
                 struct arena *arena, struct psf *psf, struct error *error)
{
    const struct psf_question question = {.bundle = analysis_bundle(one, field),
                                          .method = (enum psf_method)input->method,
                                          .size = (size_t)input->size,
                                          .threads = one->threads,
                                          .pitch = input->pitch};
    return psf_find(&question, arena, psf, error);
}
