/* commands/camera/render_colours.c - the wavelengths of a picture's colours. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/response.h"
#include "commands/camera/render.h"

enum { BAND_WAVES = 8 };

struct spectrum_value render_colours(const struct render_input *input, struct arena *arena)
{
    static const double middles[PHOTOGRAPH_CHANNELS] = {RESPONSE_RED, RESPONSE_GREEN,
                                                        RESPONSE_BLUE};
    const double band = isnan(input->band) ? 0 : 1000 * input->band;
    const size_t waves = band > 0 ? BAND_WAVES : 1, count = PHOTOGRAPH_CHANNELS * waves;
    struct setup_wavelength *items = ARENA_ARRAY(arena, count, struct setup_wavelength);
    for (size_t i = 0; i < count; i++) {
        const double along = ((double)(i % waves) + 0.5) / (double)waves - 0.5;
        items[i] = (struct setup_wavelength){middles[i / waves] + along * band, 1};
    }
    return (struct spectrum_value){"channels", items, count};
}
