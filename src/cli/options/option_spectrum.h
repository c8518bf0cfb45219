/* cli/options/option_spectrum.h - a spectrum: wavelengths with their weights. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_SPECTRUM_H
#define LENSCALC_CLI_OPTIONS_OPTION_SPECTRUM_H

#include "analysis/setup/setup_question.h"
#include "base/text.h"

/* Several wavelengths at once: d:1,F:0.5; or photopic. */
struct spectrum_value {
    const char *text; /* as typed; null = not given */
    const struct setup_wavelength *items;
    size_t count;
};

enum { MOST_SPECTRUM = 64 };

struct option;
struct reader;

/*
 * Read a wavelength, um: a number with a unit, or the name of a spectral line.
 *
 * Errors    ERROR_USAGE, ERROR_DOMAIN, the message naming the option; as lines_find
 */
bool wavelength_read(const struct reader *reader, const struct option *option, struct text text,
                     double *wavelength, struct error *error);

#endif
