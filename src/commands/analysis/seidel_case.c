/* commands/analysis/seidel_case.c - a lens in its light, and the aberrations of its surfaces. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/seidel_case.h"

#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

const struct analysis_policy seidel_policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .fields = FIELDS_EDGE,
                                              .one_wavelength = true,
                                              .no_image = true,
                                              .is_narrow = true};

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

/* The two wavelengths of CI and CII, and the indices there; none without them. */
static bool seidel_case_colours(struct seidel_case *one, const struct seidel_input *input,
                                struct arena *arena, struct paraxial_system *blue,
                                struct paraxial_system *red, struct error *error)
{
    struct error colours;
    const bool of_lens = input->chromatic == CHROMATIC_LENS;
    one->blue = of_lens ? INFINITY : WAVELENGTH_F;
    one->red = of_lens ? 0 : WAVELENGTH_C;
    for (size_t i = 0; i < one->setup->lens->wavelength_count && of_lens; i++) {
        one->blue = fmin(one->blue, one->setup->lens->wavelengths[i].wavelength);
        one->red = fmax(one->red, one->setup->lens->wavelengths[i].wavelength);
    }
    if (!(one->blue < one->red)) {
        return fail(error, ERROR_DOMAIN,
                    "{--chromatic} lens: the lens states only one wavelength, and so no "
                    "dispersion");
    }
    /* the indices there; without them CI and CII are absent */
    const bool has_colours =
        paraxial_compile(one->setup->lens, one->blue, one->setup->section, arena, blue, &colours) &&
        paraxial_compile(one->setup->lens, one->red, one->setup->section, arena, red, &colours);
    if (!has_colours) {
        const bool others =
            input->chromatic == CHROMATIC_LINES && one->setup->lens->wavelength_count > 1;
        const char *hint = others ? "; --chromatic lens takes the lens's own wavelengths" : "";
        one->warning = lens_warnings_join(
            one->warning,
            ARENA_JOIN(arena, "the chromatic sums are absent: ", colours.message, hint), arena);
        one->blue = one->red = NAN;
        *blue = *red = (struct paraxial_system){0};
    }
    return true;
}

/* The sums of the case of a cursor. */
bool seidel_case_make(const struct analysis_cursor *at, struct seidel_case *one,
                      struct error *error)
{
    const struct seidel_input *input = at->input;
    const struct setup *setup = at->one->setup;
    struct arena *arena = at->run->arena;
    *one = (struct seidel_case){.setup = setup,
                                .point = analysis_point_of(at->one, at->field),
                                .field = setup_edge_in_object(setup),
                                .blue = NAN,
                                .red = NAN,
                                .warning = at->one->warning};
    if (!setup_light(setup, 0, &one->light, error)) {
        return false;
    }
    const bool of_image = setup->edge.kind == FIELD_IMAGE || setup->edge.kind == FIELD_REAL;
    if (of_image && isinf(one->light.first.magnification)) {
        return fail(error, ERROR_DOMAIN,
                    "the field is an image height, but the image is infinitely far away");
    }
    if (isnan(one->light.first.working_fnumber)) {
        fail(error, ERROR_DOMAIN,
             "the lens has no aperture: the height of its marginal ray is "
             "not known");
        return error_hint(error, "give an f-number with -N, or an aperture in the file");
    }
    struct paraxial_system blue = {0}, red = {0};
    if (input->order == ORDER_THIRD &&
        !seidel_case_colours(one, input, arena, &blue, &red, error)) {
        return false;
    }
    const struct seidel_question question = {
        .lens = setup->lens,
        .system = &one->light.system,
        .blue_n = blue.index,
        .red_n = red.index,
        .section = setup->section,
        .object = &setup->object,
        .first = &one->light.first,
        .field_kind = one->field.kind,
        .field = one->field.value[setup_axis(setup)],
    };
    if (!seidel_compute(&question, arena, &one->seidel, error) ||
        (input->order == ORDER_FIFTH &&
         !fifth_order_compute(&question, arena, &one->fifth, error))) {
        return false;
    }
    one->warning = seidel_case_doubts_of(one, arena);
    return true;
}

bool seidel_case_is_angular(const struct seidel_case *one)
{
    return isinf(one->light.first.image) || one->seidel.slope == 0;
}

/* What makes transverse aberrations of sums. */
static double seidel_case_unit(const struct seidel_case *one)
{
    const double n = one->light.first.index_image;
    return seidel_case_is_angular(one) ? -1 / (n * one->seidel.height) : 1 / one->seidel.slope;
}

void seidel_case_in_form(const struct seidel_case *one, const struct seidel_part *part, int form,
                         double values[SEIDEL_TERMS])
{
    if (form == FORM_WELFORD) {
        memcpy(values, part->sum, sizeof part->sum);
        return;
    }
    if (form == FORM_WAVES) {
        seidel_convert(part, SEIDEL_WAVES, 1e3 / one->light.wavelength, values);
        return;
    }
    seidel_convert(part, SEIDEL_TRANSVERSE, seidel_case_unit(one), values);
}

void seidel_case_fifth(const struct seidel_case *one, const double part[FIFTH_TERMS],
                       double values[FIFTH_TERMS])
{
    const double unit = seidel_case_unit(one);
    for (size_t i = 0; i < FIFTH_TERMS; i++) {
        values[i] = part[i] * unit + 0.0; /* without -0 */
    }
}
