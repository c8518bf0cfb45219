/* camera/sensor/response.c - efficiencies at three wavelengths. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/response.h"

#include <math.h>

static const double traced[SENSOR_CHANNELS] = {RESPONSE_RED, RESPONSE_GREEN, RESPONSE_BLUE};

/* V of these: what the eye sees of a watt, of what it sees at 555 nm. */
static const double luminous[SENSOR_CHANNELS] = {0.4904688, 0.9928116, 0.07091109};

bool response_open(const struct response_table *table, struct arena *arena,
                   const struct sensor_response_traits **traits, struct error *error)
{
    struct colour_matrix *seen = ARENA_NEW(arena, struct colour_matrix);
    struct sensor_response_traits *made = ARENA_NEW(arena, struct sensor_response_traits);
    if (table->channels != 1 && table->channels != SENSOR_CHANNELS) {
        return fail(error, ERROR_DOMAIN, "the response has %zu channels, not 1 or %d",
                    table->channels, SENSOR_CHANNELS);
    }
    for (size_t i = 0; i < table->rows; i++) {
        if (i > 0 && !(table->wavelength[i] > table->wavelength[i - 1])) {
            return fail(error, ERROR_DOMAIN, "the wavelengths of a response must rise: %.6g nm",
                        1000 * table->wavelength[i]);
        }
        for (size_t k = 0; k < table->channels; k++) {
            if (!(table->efficiency[k][i] >= 0 && table->efficiency[k][i] <= 1)) {
                return fail(error, ERROR_DOMAIN,
                            "the efficiency %.6g of '%s' at %.6g nm is not from 0 to 1",
                            table->efficiency[k][i], table->names[k], 1000 * table->wavelength[i]);
            }
        }
    }
    for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
        const double wavelength = traced[j];
        if (!(table->rows >= 2 && wavelength >= table->wavelength[0] &&
              wavelength <= table->wavelength[table->rows - 1])) {
            return fail(error, ERROR_DOMAIN, "the response does not reach %.6g nm",
                        1000 * wavelength);
        }
    }
    *made = (struct sensor_response_traits){.word = table->channels == 1 ? "a table of one channel"
                                                                         : "a table",
                                            .channels = table->channels,
                                            .seen = seen};
    double most = 0;
    for (size_t k = 0; k < table->channels; k++) {
        double white = 0;
        for (size_t j = 0; j < SENSOR_CHANNELS; j++) {
            const double photons = colour_xyz_of_srgb.at[1][j] * (traced[j] / 0.555) / luminous[j];
            const double wavelength = traced[j];
            const double *x = table->wavelength, *y = table->efficiency[k];
            size_t i = 1;
            while (i + 1 < table->rows && x[i] < wavelength) {
                i++;
            }
            seen->at[k][j] = photons * (y[i - 1] + (wavelength - x[i - 1]) / (x[i] - x[i - 1]) *
                                                       (y[i] - y[i - 1]));
            white += seen->at[k][j];
        }
        if (!(white > 0)) {
            return fail(error, ERROR_DOMAIN,
                        "'%s' of the response sees nothing of 611, 549 and 464 nm",
                        table->names[k]);
        }
        /* white fills this channel first */
        made->reference = white > most ? k : made->reference;
        most = fmax(most, white);
        made->names[k] = table->names[k];
    }
    *traits = made;
    return true;
}
