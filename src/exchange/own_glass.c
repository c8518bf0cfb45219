/* exchange/own_glass.c - indices of a file under the name of a catalogue glass. */
/* SPDX-License-Identifier: MIT */
#include "exchange/own_glass.h"

#include <math.h>

static const double printed = 5.5e-6; /* half of the last digit of a catalogue */

double own_glass_rounding(const struct figure *index)
{
    const double coarsest = 5e-5; /* fewer digits are numbers whose last ones are 0 */
    return fmin(figure_rounding(index), coarsest);
}

void own_glass_compare(const struct own_glass *own, const struct medium *found,
                       struct medium *medium)
{
    struct arena *arena = own->job->arena;
    const bool of_catalog = own->job->glass_numbers == GLASS_NUMBERS_CATALOG;
    double most = own->rounding + printed, at = 0, is = 0, was = 0;
    for (size_t i = 0; i < own->count; i++) {
        struct pair here, there;
        struct error unknown;
        if (medium_index(found, own->wavelengths[i], &here, &unknown) &&
            medium_index(medium, own->wavelengths[i], &there, &unknown) &&
            fabs(pair_subtract(here, there).hi) > most) {
            most = fabs(pair_subtract(here, there).hi);
            at = own->wavelengths[i];
            is = here.hi;
            was = there.hi;
        }
    }
    if (!(at > 0)) {
        return;
    }
    char *warning = arena_printf(
        arena,
        "the glass '%.*s' is %.*s of the index %.7g at %g um, beside which "
        "the file has %.7g: %s",
        text_shown(own->name), own->name.start, text_shown(found->written), found->written.start,
        is, at, was, of_catalog ? "the catalogue's glass is used" : "the file's indices are used");
    text_make_printable(warning, "");
    lens_build_note(own->build, text_of(warning));
    if (of_catalog) {
        *medium = *found;
    }
    medium->warning =
        medium->warning == NULL ? warning : arena_printf(arena, "%s; %s", medium->warning, warning);
}
