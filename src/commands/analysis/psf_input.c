/* commands/analysis/psf_input.c - what lenscalc psf is asked. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/psf_input.h"

#include <math.h>

const struct analysis_policy psf_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_ALL};

bool psf_check(const struct analysis_case *one, const struct psf_input *input, struct error *error)
{
    const bool is_angular = isnan(one->setup->image);
    if (isnan(is_angular ? input->pitch : input->pitch_angle)) {
        return true;
    }
    return is_angular ? fail(error, ERROR_DOMAIN,
                             "{--pitch}: the image lies infinitely far away, its pixels are "
                             "angles: give {--pitch-angle}")
                      : fail(error, ERROR_DOMAIN,
                             "{--pitch-angle} is of images infinitely far away: give {--pitch}");
}

bool psf_of_case(const struct analysis_case *one, size_t field, const struct psf_input *input,
                 struct arena *arena, struct psf *psf, struct error *error)
{
    const bool is_angular = isnan(one->setup->image);
    const struct psf_question question = {.bundle = analysis_bundle(one, field),
                                          .method = (enum psf_method)input->method,
                                          .size = (size_t)input->size,
                                          .threads = one->threads,
                                          .pitch =
                                              is_angular ? sin(input->pitch_angle) : input->pitch};
    return psf_find(&question, arena, psf, error);
}
