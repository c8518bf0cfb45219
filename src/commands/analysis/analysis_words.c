/* commands/analysis/analysis_words.c - what a case is called in drawings. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_words.h"

#include <math.h>

#include "base/number.h"

const char *analysis_case_words(const struct analysis_case *one, bool whole, struct arena *arena)
{
    const struct analysis_question *question = one->question;
    const struct setup *setup = one->setup;
    const char *words = setup->position;
    const struct {
        bool shown;
        const char *before;
        double value;
        const char *behind;
    } parts[] = {
        {whole || question->wavelength.name != NULL, "", 1000 * setup->wavelengths[0].wavelength,
         " nm"},
        {!isnan(question->object), "object at ", question->object, " mm"},
        {!isnan(question->fnumber), "f/", question->fnumber, ""},
        {!isnan(question->defocus) && !whole, "defocus ", question->defocus, " mm"},
    };
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].shown) {
            words = arena_printf(arena, "%s%s%s%.6g%s", words != NULL ? words : "",
                                 words != NULL ? ", " : "", parts[i].before, parts[i].value,
                                 parts[i].behind);
        }
    }
    if (!whole) {
        return words;
    }
    return isnan(setup->image)
               ? arena_printf(arena, "%s; image infinitely far away", words)
               : arena_printf(arena, "%s; image plane %s, %.6g mm from the last vertex", words,
                              setup->focus != NULL ? setup->focus : "none", setup->image);
}

const char *analysis_spectrum_words(const struct setup *setup)
{
    const char *words = NULL;
    for (size_t i = 0; i < setup->wavelength_count && setup->wavelength_count > 1; i++) {
        words = arena_printf(setup->arena, "%s%s%.7g nm x %.6g", words != NULL ? words : "",
                             words != NULL ? ", " : "", 1000 * setup->wavelengths[i].wavelength,
                             setup->wavelengths[i].weight);
    }
    return words;
}

const char *analysis_number(double value, struct arena *arena)
{
    char number[NUMBER_LENGTH];
    return arena_string(arena, number,
                        (size_t)(number_write_plain(number, value, 3, false) - number));
}
