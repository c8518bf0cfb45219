/* cli/options/vary.h - what of a lens may change: --vary, --hold, or the marks of its file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_VARY_H
#define LENSCALC_CLI_OPTIONS_VARY_H

#include "design/variable.h"

struct vary_reader {
    const struct lens *lens; /* in all its positions */
    struct arena *arena;
    bool (*takes)(enum parameter_kind kind); /* what the command varies; null: everything */
    const char *only; /* with `takes`, for messages: "fit varies radii, thicknesses and indices" */
    const char *option; /* that says what varies, for messages; null: "vary" */
};

/*
 * Read --vary and --hold.
 *
 * Given     vary   items with commas between; null: the marks of the lens. An item is
 *                    R1 c2 t3 k4 A4_5 n6 V6 glass6 dx7 dy7 ax7 ay7 focal8
 *                    d5        a word of the positions: its number in each of them
 *                    d5@tele   only in that position
 *                    R1..R11   those that the surfaces have: a plane has no radius
 *                    all-R     the same of all surfaces; all-t: of all gaps between surfaces
 *                  each may have bounds behind it, [2,10], [2mm,1in], [-1deg,1deg], [20,inf], in mm
 *                  and degrees unless they have units. glass6 is n6 and V6
 *           hold   what of it is not to change, in the same words without bounds; null: nothing
 * Result    a list in the arena. Ranges and all- leave out what follows another number, and give
 *           way to an item that names one of theirs by itself
 * Errors    ERROR_USAGE: unknown names (with a suggestion), a number that is named twice, bounds
 *           that are none, a range that holds nothing, what is held but does not vary.
 *           ERROR_DOMAIN: nothing is marked; a glass6 that is no nd/Vd
 */
bool vary_list(const struct vary_reader *reader, const char *vary, const char *hold,
               struct variable **list, size_t *count, struct error *error);

/*
 * The marks of the lens.
 *
 * Given     ignored  receives those that the command does not take, in words; null: there are none
 * Errors    ERROR_DOMAIN: a mark glass~ of what is no nd/Vd
 */
bool vary_marks(const struct vary_reader *reader, struct variable **list, size_t *count,
                const char **ignored, struct error *error);

/* The cell that a word of the positions stands in, of the first surface; false: in no thickness and
   no focal length. */
bool vary_find_cell(const struct lens *lens, size_t word, struct parameter *what);

#endif
