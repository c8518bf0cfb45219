/* commands/lens/focus_gaps.c - the gaps of a lens that focus it, as typed: "d5,10:-1,last". */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/focus_gaps.h"

#include "analysis/setup/setup.h"

#include "base/quantity.h"

#include <math.h>

static bool focus_gaps_add(struct named_gap *gaps, size_t *count, struct named_gap gap,
                           struct error *error)
{
    for (size_t i = 0; i < *count; i++) {
        if (gaps[i].gap.surface == gap.gap.surface) {
            return fail(error, ERROR_USAGE, "{--gap} names the gap after surface %zu twice",
                        gap.gap.surface + 1);
        }
    }
    if (*count == FOCUS_GAPS) {
        return fail(error, ERROR_USAGE, "{--gap} moves at most %d gaps", FOCUS_GAPS);
    }
    gaps[(*count)++] = gap;
    return true;
}

bool focus_gaps_read(struct text text, const struct lens *lens, struct named_gap *gaps,
                     size_t *count, struct error *error)
{
    struct text rest = text;
    *count = 0;
    while (rest.start != NULL) {
        struct text item = text_trim(text_cut(&rest, ',')), weight = item;
        struct named_gap gap = {.name = text_trim(text_cut(&weight, ':')), .gap.weight = 1};
        bool found = false;
        if (weight.start != NULL &&
            !quantity_read(weight, &dimension_number, NULL, &gap.gap.weight, NULL, error)) {
            return error_prefix(error, "bad weight in {--gap}: ");
        }
        if (!(gap.gap.weight != 0) || isinf(gap.gap.weight)) {
            return fail(error, ERROR_USAGE, "{--gap} '%.*s': the weight must be finite and not 0",
                        text_shown_up_to(item, 40), item.start);
        }
        /* All thicknesses that the variable stands for. */
        for (size_t i = 0; i < lens->surface_count; i++) {
            size_t variable = lens->surfaces[i].thickness.variable;
            if (variable == LENS_NONE ||
                !text_same_name(gap.name, lens->variables[variable].name)) {
                continue;
            }
            gap.gap.surface = i;
            found = true;
            if (!focus_gaps_add(gaps, count, gap, error)) {
                return false;
            }
        }
        if (found) {
            continue;
        }
        gap.gap.surface = parameter_gap_find(lens, gap.name);
        if (gap.gap.surface == LENS_NONE) {
            struct text name = gap.name;
            struct nearest nearest = {.typed = name};
            for (size_t k = 0; k < lens->variable_count; k++) {
                nearest_offer(&nearest, lens->variables[k].name);
            }
            fail(error, ERROR_USAGE,
                 "{--gap} '%.*s' is not a gap: it must be a variable of the lens, the number (1 to "
                 "%zu, or t1 to t%zu) or name of the surface before it, or 'last'",
                 text_shown_up_to(name, 40), name.start, lens->surface_count, lens->surface_count);
            return nearest.best.start != NULL &&
                   error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length,
                              nearest.best.start);
        }
        if (!focus_gaps_add(gaps, count, gap, error)) {
            return false;
        }
    }
    return true;
}

bool focus_gaps_open(struct text text, const struct lens *typed, const struct lens *lens,
                     struct arena *arena, struct focus_mechanism *focusing, struct error *error)
{
    struct named_gap named[FOCUS_GAPS];
    struct first_order first;
    struct focus_gap *gaps = ARENA_ARRAY(arena, FOCUS_GAPS, struct focus_gap);
    if (!focus_gaps_read(text, typed, named, &focusing->gap_count, error) ||
        !first_order_of_lens(lens, lens_primary_wavelength(lens), focusing->section, arena, &first,
                             error)) {
        return false;
    }
    for (size_t i = 0; i < focusing->gap_count; i++) {
        gaps[i] = named[i].gap;
    }
    focusing->lens = lens;
    focusing->gaps = gaps;
    focusing->image_plane = setup_paraxial_image(lens, &first);
    return true;
}

enum conjugate_from focus_from(enum distance_from from)
{
    switch (from) {
    case FROM_SENSOR:
        return CONJUGATE_FROM_SENSOR;
    case FROM_ENTRANCE:
        return CONJUGATE_FROM_ENTRANCE;
    case FROM_FRONT:
        return CONJUGATE_FROM_FRONT;
    default:
        return CONJUGATE_FROM_PRINCIPAL;
    }
}
