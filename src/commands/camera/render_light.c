/* commands/camera/render_light.c - light on the card, and filters before the lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "photo/exposure.h"
#include "photo/mired.h"

bool render_check_light(const struct render_input *input, struct error *error)
{
    return !isnan(input->filter.mired) ||
           fail(error, ERROR_USAGE,
                "{--filter} %s: its colour is not that of a light, and no spectrum of it is known",
                input->filter.name);
}

double render_white(const struct render_input *input)
{
    const double ev = input->light.name != NULL ? input->light.ev100 : input->ev;
    return isnan(ev) ? input->luminance : exposure_white(ev);
}

/* Mean over the wavelengths of a channel, by their weights. */
static double mean_transmittance(const struct render_input *input, const struct setup *setup,
                                 size_t channel)
{
    const size_t parts = render_is_grey(input) ? 1 : PHOTOGRAPH_CHANNELS;
    const size_t waves = setup->wavelength_count / parts;
    double sum = 0, all = 0;
    for (size_t i = 0; i < waves; i++) {
        const struct setup_wavelength *one = &setup->wavelengths[channel % parts * waves + i];
        sum += one->weight * mired_transmittance(input->filter.mired, one->wavelength);
        all += one->weight;
    }
    return sum / all;
}

void render_filter(const struct render_input *input, const struct setup *setup, const double *white,
                   struct photograph *photograph)
{
    const double grey = exp2(-input->filter.stops);
    struct image *image = &photograph->image;
    double through[PHOTOGRAPH_CHANNELS], most = 0;
    if (input->filter.name == NULL) {
        return;
    }
    for (size_t k = 0; k < PHOTOGRAPH_CHANNELS; k++) {
        const double share = white != NULL ? white[k] : mean_transmittance(input, setup, k);
        through[k] = white != NULL ? grey : grey * share;
        most = fmax(most, grey * share);
        photograph->mean[k] *= through[k];
    }
    for (size_t i = 0; i < image->width * image->height; i++) {
        for (size_t k = 0; k < PHOTOGRAPH_CHANNELS; k++) {
            float *value = &image->pixels[i * PHOTOGRAPH_CHANNELS + k];
            *value = (float)(through[k] * (double)*value);
        }
    }
    photograph->reference *= most; /* white is exposed by its brightest colour */
}

void render_say_light(const struct render_input *input, struct text_buffer *remarks)
{
    if (input->light.name != NULL) {
        growing_format(remarks, "light of %s, EV %.4g at ISO 100: %s\n", input->light.name,
                       input->light.ev100, input->light.source);
    }
    if (input->filter.name != NULL) {
        growing_format(remarks, "filter %s\n", input->filter.name);
    }
}
