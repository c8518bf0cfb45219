/* file/lens_unit.c - the units in which the lengths of a lens may be typed. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_unit.h"

#include "base/units.h"

const struct word lens_units[LENS_UNITS + 1] = {
    {"mm", "millimetre"}, {"cm", "centimetre"}, {"m", "metre"}, {"in", "inch"}, {NULL, NULL},
};

const char *lens_unit_named(struct text name)
{
    size_t i = 0;
    while (i < LENS_UNITS && !text_equal(name, lens_units[i].word)) {
        i++;
    }
    return lens_units[i].word;
}

struct number_scale lens_unit_scale(const char *unit)
{
    return unit_find(&dimension_length, text_of(unit))->scale;
}

double lens_unit_mm(const char *unit)
{
    return unit_to_own(unit_find(&dimension_length, text_of(unit)), 1);
}
