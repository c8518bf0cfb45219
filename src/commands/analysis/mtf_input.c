/* commands/analysis/mtf_input.c - what lenscalc mtf is asked. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/mtf_input.h"

const struct analysis_policy mtf_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool mtf_of_case(const struct analysis_case *one, size_t field, const struct mtf_input *input,
                 struct arena *arena, struct mtf_source *source, struct error *error)
{
    struct mtf_question *question = ARENA_NEW(arena, struct mtf_question);
    *question = (struct mtf_question){.bundle = analysis_bundle(one, field),
                                      .by_rays = input->method == MTF_BY_RAYS,
                                      .error = input->question.error};
    return mtf_open(question, arena, source, error);
}

double mtf_pixels(const struct mtf_input *input, double frequency)
{
    const double x = isnan(input->pitch) ? 0 : frequency * input->pitch;
    return x > 0 ? fabs(sin(PI * x) / (PI * x)) : 1; /* of a square */
}

bool mtf_with_pixels(const struct mtf_source *source, const struct mtf_input *input,
                     double frequency, struct arena *arena, struct mtf *mtf, struct error *error)
{
    if (!mtf_find(source, frequency, arena, mtf, error)) {
        return false;
    }
    const double left = mtf_pixels(input, frequency);
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        mtf->contrast[k] *= left;
        mtf->limit[k] *= left;
    }
    return true;
}
