/* exchange/zemax/zemax_glass.h - the materials of a .zmx file: names of glasses, and numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_GLASS_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_GLASS_H

#include "exchange/zemax/zemax_parse.h"

/*
 * The material of a line GLAS NAME type surface nd Vd ..
 *
 * Which counts, name or numbers, is decided by the type: 1 is a model glass, its numbers count,
 * also beside the name of a catalogue's glass. Of 0, and of 3, a glass that may be substituted, the
 * catalogue's glass counts: the numbers may be left-overs of a model glass that was there before,
 * which the program ignores. A converter that is known to write the numbers of a patent there means
 * those. job->glass_numbers overrules all that. Where the two differ, the medium has a warning with
 * both.
 *
 * Given     line  not AIR, MIRROR or a pick-up
 * Errors    as foreign_glass; losses: a glass that neither a catalogue nor the line has
 */
bool zemax_glass(struct zemax_file *file, const struct zemax_line *line, struct medium *medium,
                 struct error *error);

#endif
