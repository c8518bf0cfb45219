/* exchange/zemax/zemax_environment.h - glasses at the temperature and pressure of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_ENVIRONMENT_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_ENVIRONMENT_H

#include "exchange/zemax/zemax_parse.h"

/*
 * A glass of a catalogue as it is in the file's air, where ENVD says that indices follow it; else,
 * and at 20 C and 1 atmosphere, as it is. Radii and distances of a file are those at its
 * temperature already.
 *
 * Given     line    GLAS
 *           medium  of a catalogue; receives a table at the file's wavelengths, at
 *                   spectral lines, and at steps between them, in the range of the glass
 * Formula   the wavelength l of the file is one in its air, of T and p: the catalogue's is
 *           l n_air(T, p)/n_air(T0, 1 atmosphere); then glass_in_air, with AIR_KOHLRAUSCH
 * Source    [OpticStudio25], temperature and pressure
 * Errors    ERROR_DATA: a glass without the data for it, unless lossy
 */
bool zemax_to_environment(struct zemax_file *file, const struct zemax_line *line,
                          struct medium *medium, struct error *error);

#endif
