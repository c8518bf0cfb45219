/* commands/analysis/mtf_input.c - what lenscalc mtf is asked. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/mtf_input.h"

const struct analysis_policy mtf_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool mtf_field_open(const struct analysis_cursor *at, const struct analysis_case *one, size_t field,
                    void *source, struct error *error)
{
    const struct mtf_input *input = at->input;
    struct arena *arena = one->setup->arena;
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
