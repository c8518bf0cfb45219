/* camera/sensor/response.h - what a sensor's channels see, from their efficiencies by wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SENSOR_RESPONSE_H
#define LENSCALC_CAMERA_SENSOR_RESPONSE_H

#include "base/arena.h"
#include "camera/sensor/sensor.h"

/* Quantum efficiencies: electrons a photon, filters included. */
struct response_table {
    size_t channels;          /* 1 or 3 */
    size_t rows;              /* two and more */
    const double *wavelength; /* um, rising */
    const double *efficiency[SENSOR_CHANNELS];
    const char *names[SENSOR_CHANNELS];
};

/* Where red, green and blue light are traced, um: about where the primaries of sRGB lie. */
#define RESPONSE_RED   0.611
#define RESPONSE_GREEN 0.549
#define RESPONSE_BLUE  0.464

/*
 * A response of a table.
 *
 * Result    traits  for an image_sensor whose efficiencies are all 1; in the arena
 * Formula   seen[k][j] = efficiency_k(l_j) Y_j (l_j/555 nm)/V(l_j): light of red, green and blue is
 *           that of the three wavelengths, whose lumens Y_j sRGB gives; photons a lumen grow with
 *           the wavelength and fall with what the eye sees of it; straight lines between rows
 * Source    [CIE04] (V, every nm); [IEC99] (Y_j); [EMVA16] 2.1 (photons)
 * Errors    ERROR_DOMAIN: 2 channels; wavelengths that do not rise, or leave one of the three out;
 *           efficiencies outside 0 to 1; a channel that sees none of the three
 * Limits    three wavelengths stand for all: a response that changes between them is not seen
 */
bool response_open(const struct response_table *table, struct arena *arena,
                   const struct sensor_response_traits **traits, struct error *error);

#endif
