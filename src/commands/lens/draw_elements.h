/* commands/lens/draw_elements.h - the elements of a lens in numbers, beside its cross-section. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_LENS_DRAW_ELEMENTS_H
#define LENSCALC_COMMANDS_LENS_DRAW_ELEMENTS_H

#include "analysis/layout/layout.h"
#include "draw/section.h"

/* Its elements as a table. */
struct section_table draw_elements_table(const struct layout *layout);

/*
 * One of them as a drawing for the shop: what the file states of it, a dash for what it does not.
 *
 * Given     number  from 1
 * Errors    ERROR_USAGE: no such element
 */
bool draw_element_sheet(const struct layout *layout, long number, const char *title,
                        struct svg *svg, struct error *error);

#endif
