/* exchange/sequence_figure.c - the numbers of CODE V and OSLO files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/sequence.h"
#include "file/decimal.h"

bool sequence_is_some(const struct figure *figure)
{
    return figure->typed.start != NULL && figure->value.hi != 0;
}

struct figure sequence_diameter(const struct figure *radius, struct arena *arena)
{
    return (struct figure){.value = {2 * radius->value.hi, 2 * radius->value.lo},
                           .typed = decimal_double(radius->typed, arena),
                           .variable = LENS_NONE};
}
