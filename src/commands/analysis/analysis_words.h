/* commands/analysis/analysis_words.h - what a case is called in drawings. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_WORDS_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_WORDS_H

#include "commands/analysis/analysis_options.h"

/*
 * What tells a case from others: "wide, 587.562 nm, object at 2000 mm, f/4, defocus 0.1 mm".
 *
 * Given     whole  the wavelength even where nobody asked for one, and in place of a defocus where
 *                  the image plane lies
 * Result    null: nothing was asked for
 */
const char *analysis_case_words(const struct analysis_case *one, bool whole, struct arena *arena);

/* The wavelengths of a setup with their weights: "587.6 nm x 1, 486.1 nm x 0.5"; null: one. */
const char *analysis_spectrum_words(const struct setup *setup);

/* A number to three digits, without an exponent as far as people read numbers so. */
const char *analysis_number(double value, struct arena *arena);

#endif
