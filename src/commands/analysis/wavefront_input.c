/* commands/analysis/wavefront_input.c - what lenscalc wavefront is asked. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/wavefront_input.h"

const struct analysis_policy wavefront_policy = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL, .one_wavelength = true};

const struct word wave_references[] = {
    [WAVE_CHIEF] = {"chief", "the chief ray of the same wavelength"},
    [WAVE_CENTROID] = {"centroid", "the centroid of the rays by their weights"},
    [WAVE_BEST] = {"best", "the centre of the sphere that fits the wave front best"},
    {NULL, NULL},
};

bool wavefront_of_case(const struct analysis_case *one, size_t field,
                       const struct wavefront_input *input, struct arena *arena,
                       struct wavefront_source *source, struct error *error)
{
    struct wavefront_question *made = ARENA_NEW(arena, struct wavefront_question);
    const struct analysis_question *asked = &input->question;
    *made = (struct wavefront_question){
        .bundle = analysis_bundle(one, field),
        .about = (enum wave_about)input->reference,
        .rays = asked->rays != NO_INTEGER && asked->rays > 0 ? (size_t)asked->rays : 0,
        .error = asked->error};
    return wavefront_open(made, arena, source, error);
}

const char *wave_reference_words(const struct analysis_case *one, enum wave_about about,
                                 struct arena *arena)
{
    const struct setup *setup = one->setup;
    const bool one_wavelength = setup->wavelength_count == 1;
    return about == WAVE_CENTROID
               ? one_wavelength ? "the centroid" : "the centroid of all wavelengths"
           : about == WAVE_BEST ? one_wavelength ? "the best-fitting sphere"
                                                 : "the best-fitting sphere of all wavelengths"
                                : arena_printf(arena, "the chief ray at %.4g nm",
                                               1000 * setup->wavelengths[0].wavelength);
}
