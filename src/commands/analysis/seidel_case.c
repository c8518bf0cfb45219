/* commands/analysis/seidel_case.c - the sums that lenscalc seidel is asked for. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/seidel_case.h"
#include "commands/analysis/analysis_fields.h"

#include "optics/wavelength.h"

#include <string.h>

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .fields = FIELDS_EDGE,
                                              .one_wavelength = true,
                                              .no_image = true};

/* Who gets the sums. */
struct seidel_case_visitor {
    const struct seidel_input *input;
    seidel_visit *visit;
    void *context;
    struct arena *arena;
};

/* The two wavelengths of CI and CII. */
static bool choose_colours(const struct seidel_input *input, const struct lens *lens,
                           struct seidel_case *one, struct error *error)
{
    one->blue = WAVELENGTH_F;
    one->red = WAVELENGTH_C;
    if (input->chromatic == CHROMATIC_LINES) {
        return true;
    }
    one->blue = INFINITY;
    one->red = 0;
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        one->blue = fmin(one->blue, lens->wavelengths[i].wavelength);
        one->red = fmax(one->red, lens->wavelengths[i].wavelength);
    }
    return one->blue < one->red ||
           fail(error, ERROR_DOMAIN,
                "{--chromatic} lens: the lens states only one wavelength, and so no dispersion");
}

/* What the sums leave out. */
static const char *seidel_case_doubts_of(const struct seidel_case *one, struct arena *arena)
{
    const struct lens *lens = one->setup->lens;
    const char *words = one->warning;
    bool has_cylinder = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        has_cylinder = has_cylinder || !surface_is_round(&lens->surfaces[i]);
    }
    if (has_cylinder) {
        words =
            lens_warnings_join(words,
                               "the lens has cylinders: the sums are those of a round lens with "
                               "the profiles of this section",
                               arena);
    }
    if (one->seidel.distorting != LENS_NONE) {
        words = lens_warnings_join(
            words,
            arena_printf(arena, "the distortion of the thick lens, surface %zu, is left out",
                         one->seidel.distorting + 1),
            arena);
    }
    return words;
}

/* The indices at the two wavelengths; without them CI and CII are absent. */
static const struct pair *index_at(const struct seidel_case *one, double wavelength,
                                   struct arena *arena, struct error *error)
{
    const struct setup *setup = one->setup;
    struct paraxial_system system;
    return paraxial_compile(setup->lens, wavelength, setup->section, arena, &system, error)
               ? system.index
               : NULL;
}

static bool seidel_case_sum_up(const struct analysis_case *of, size_t field, void *context,
                               struct error *error)
{
    const struct seidel_case_visitor *visitor = context;
    const struct setup *setup = of->setup;
    struct arena *arena = visitor->arena;
    struct seidel_case here = {.setup = setup,
                               .point = analysis_point_of(of, field),
                               .field = setup_edge_in_object(setup),
                               .warning = of->warning};
    if (!setup_light(setup, 0, &here.light, error)) {
        return false;
    }
    struct error colours;
    if (isnan(here.light.first.working_fnumber)) {
        fail(error, ERROR_DOMAIN,
             "the lens has no aperture: the height of its marginal ray is "
             "not known");
        return error_hint(error, "give an f-number with -N, or an aperture in the file");
    }
    if (!choose_colours(visitor->input, setup->lens, &here, error)) {
        return false;
    }
    const struct pair *blue = index_at(&here, here.blue, arena, &colours);
    const struct pair *red = blue != NULL ? index_at(&here, here.red, arena, &colours) : NULL;
    if (red == NULL) {
        blue = NULL;
        here.warning = lens_warnings_join(
            here.warning,
            arena_printf(arena, "the chromatic sums are absent: %s%s", colours.message,
                         visitor->input->chromatic == CHROMATIC_LINES &&
                                 setup->lens->wavelength_count > 1
                             ? "; --chromatic lens takes the lens's own wavelengths"
                             : ""),
            arena);
        here.blue = here.red = NAN;
    }
    const struct seidel_question question = {
        .lens = setup->lens,
        .system = &here.light.system,
        .blue_n = blue,
        .red_n = red,
        .section = setup->section,
        .object = &setup->object,
        .first = &here.light.first,
        .field_kind = here.field.kind,
        .field = here.field.value[setup_axis(setup)],
    };
    if (!seidel_compute(&question, arena, &here.seidel, error)) {
        return false;
    }
    here.warning = seidel_case_doubts_of(&here, arena);
    return visitor->visit(&here, visitor->context, error);
}

bool seidel_each(const struct seidel_input *input, struct run *run, seidel_visit *visit,
                 void *context, struct error *error)
{
    static const struct analysis_answers answers = {.answer = seidel_case_sum_up};
    struct seidel_case_visitor visitor = {input, visit, context, run->arena};
    return analysis_each_field(&input->question, &policy, run, &answers, &visitor, error);
}

bool seidel_is_angular(const struct seidel_case *one)
{
    return isinf(one->light.first.image) || one->seidel.slope == 0;
}

bool seidel_in_form(const struct seidel_case *one, const struct seidel_part *part, int form,
                    double values[SEIDEL_TERMS])
{
    const struct seidel *seidel = &one->seidel;
    const double n = one->light.first.index_image;
    if (form == FORM_WELFORD) {
        memcpy(values, part->sum, sizeof part->sum);
        return false;
    }
    double unit = form == FORM_WAVES       ? 1e3 / one->light.wavelength
                  : seidel_is_angular(one) ? -1 / (n * seidel->height)
                                           : 1 / seidel->slope;
    seidel_convert(part, form == FORM_WAVES ? SEIDEL_WAVES : SEIDEL_TRANSVERSE, unit, values);
    return true;
}
