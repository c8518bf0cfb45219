/* commands/analysis/color_case.c - the wavelengths and fields that lenscalc color compares. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/color_case.h"

const struct analysis_policy color_policy = {.wavelengths = WAVELENGTHS_ALL, .fields = FIELDS_EDGE};

bool color_check(const struct analysis_question *question, struct error *error)
{
    const struct lens *lens = question->lens.lens;
    const bool spectrum = question->spectrum.text != NULL;
    if (lens == NULL || question->wavelength.name != NULL || question->spectrum.count > 1 ||
        (!spectrum && (lens->wavelength_count > 1 || lens->lights != NULL))) {
        return true;
    }
    fail(error, ERROR_DOMAIN, "there is one wavelength only, %.7g nm: colour is a difference",
         1000 *
             (spectrum ? question->spectrum.items[0].wavelength : lens_primary_wavelength(lens)));
    return error_hint(error, "give others with -w F,d,C or -w 400..700:10");
}

bool color_is_afocal(const struct setup *setup)
{
    return isinf(setup->first.image);
}

struct field_point color_field(const struct field_point *edge, long i, long steps)
{
    struct field_point point = *edge;
    for (int k = 0; k < 2; k++) {
        point.value[k] = edge->value[k] * (double)i / (double)steps;
    }
    return point;
}

void color_direction(const struct setup *setup, const struct field_point *field, double along[2])
{
    const double x = field->value[0], y = field->value[1], length = hypot(x, y);
    const double sign = y < 0 || (y == 0 && x < 0) ? -1 : 1;
    along[0] = length > 0 ? sign * x / length : (double)(setup_axis(setup) == 0);
    along[1] = length > 0 ? sign * y / length : (double)(setup_axis(setup) == 1);
}

const char *color_doubt(const struct lens *lens)
{
    bool glass = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct medium *medium = &lens->surfaces[i].medium;
        if (surface_reflects(&lens->surfaces[i]) || medium_is_air(medium)) {
            continue;
        }
        if (medium->kind != MEDIUM_CONSTANT) {
            return NULL;
        }
        glass = true;
    }
    return glass ? "every glass of the lens is stated by one index: it has no colour" : NULL;
}

/* The shortest and the longest: of those asked for at once, else of the lens. */
static void color_case_find_ends(const struct analysis_case *one, struct color_summary *summary)
{
    const struct setup *setup = one->setup;
    const struct lens *lens = setup->lens;
    const bool asked = setup->wavelength_count > 1;
    const size_t count = asked ? setup->wavelength_count : lens->wavelength_count;
    double shortest = INFINITY, longest = 0;
    for (size_t i = 0; i < count; i++) {
        const double at =
            asked ? setup->wavelengths[i].wavelength : lens->wavelengths[i].wavelength;
        shortest = fmin(shortest, at);
        longest = fmax(longest, at);
    }
    summary->shortest = shortest < longest ? shortest : (double)NAN;
    summary->longest = shortest < longest ? longest : (double)NAN;
}

static const char *color_case_words_of(const struct color_summary *summary, bool afocal,
                                       struct arena *arena)
{
    const double a = 1000 * summary->shortest, b = 1000 * summary->longest;
    if (afocal) {
        return arena_printf(arena, "axial colour from %.5g to %.5g nm: %.4g per metre", a, b,
                            1000 * summary->vergence);
    }
    const char *words = arena_printf(arena, "axial colour from %.5g to %.5g nm: %.4g mm", a, b,
                                     summary->axial.primary);
    return isnan(summary->axial.secondary) ? words
                                           : arena_printf(arena, "%s, secondary spectrum %.4g mm",
                                                          words, summary->axial.secondary);
}

bool color_summarize(const struct analysis_case *one, struct color_summary *summary,
                     struct error *error)
{
    const struct setup *setup = one->setup;
    const double primary = lens_primary_wavelength(setup->lens);
    struct chromatic_focus foci[3];
    *summary = (struct color_summary){.axial = {NAN, NAN}, .vergence = NAN};
    color_case_find_ends(one, summary);
    if (isnan(summary->shortest)) {
        return true;
    }
    if (!chromatic_focus(setup, summary->shortest, &foci[0], error) ||
        !chromatic_focus(setup, primary, &foci[1], error) ||
        !chromatic_focus(setup, summary->longest, &foci[2], error)) {
        return false;
    }
    const size_t middle = primary <= summary->shortest ? 0 : primary >= summary->longest ? 2 : 1;
    if (color_is_afocal(setup)) {
        summary->vergence = foci[0].vergence - foci[2].vergence;
    } else {
        summary->axial = chromatic_axial(&foci[0], &foci[middle], &foci[2]);
    }
    summary->words = color_case_words_of(summary, color_is_afocal(setup), setup->arena);
    return true;
}
