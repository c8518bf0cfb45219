/* commands/camera/render_clipping.c - what of a picture is too bright or dark for its file. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"

#include <math.h>
#include <string.h>

/* Of the pixels: fewer are lights and their reflections in things. */
#define SAID_FROM 0.01

struct clipping_share render_clipping_of(const struct image *image, double unit, double limit)
{
    double least = (double)INFINITY, most = 0;
    const size_t pixels = image->width * image->height, channels = image->channels;
    size_t above = 0; /* of which some channel is */
    for (size_t y = 0; y < image->height; y++) {
        const float *row = image_row(image, y);
        /* as where all is black or white: its first pixel speaks for it */
        const bool is_even =
            memcmp(row, row + channels, (image->width - 1) * channels * sizeof *row) == 0;
        const size_t columns = is_even ? 1 : image->width;
        for (size_t x = 0; x < columns; x++) {
            double darkest = (double)INFINITY, brightest = 0;
            for (size_t k = 0; k < channels; k++) {
                const double share = unit * (double)row[x * channels + k];
                darkest = share < darkest ? share : darkest;
                brightest = share > brightest ? share : brightest;
            }
            least = darkest < least ? darkest : least;
            most = brightest > most ? brightest : most;
            above += brightest > limit ? image->width / columns : 0;
        }
    }
    return (struct clipping_share){
        .share = pixels > 0 ? (double)above / (double)pixels : 0, .most = most, .least = least};
}

void render_say_clipping(const struct clipping_share *clipping, struct text_buffer *remarks)
{
    if (clipping->share == 1 && clipping->least > 1) {
        growing_format(remarks,
                       "warning: every pixel is saturated: the time or the ISO must be less than "
                       "1/%.3g of it\n",
                       clipping->least);
    } else if (clipping->share >= SAID_FROM) {
        growing_format(remarks,
                       "warning: %.3g %% of the pixels are saturated: none would be with 1/%.3g of "
                       "the time or the ISO, %.2g stops less\n",
                       100 * clipping->share, clipping->most, log2(clipping->most));
    }
}

void render_say_held(const struct clipping_share *clipping, double iso, struct text_buffer *remarks)
{
    if (clipping->share >= SAID_FROM) {
        growing_format(remarks,
                       "%.3g %% of the pixels have more than saturates at ISO %.4g, up to %.3g "
                       "times: the file holds it\n",
                       100 * clipping->share, iso, clipping->most);
    }
}

bool render_check_dark(const struct image *image, double unit, const struct render_floor *floor,
                       const char *name, struct text_buffer *remarks, struct error *error)
{
    const size_t pixels = image->width * image->height, channels = image->channels;
    size_t lost = 0, coarse = 0;
    double most = 0;
    for (size_t i = 0; i < pixels; i++) {
        double brightest = 0;
        for (size_t k = 0; k < channels; k++) {
            const double light = unit * (double)image->pixels[i * channels + k];
            brightest = light > brightest ? light : brightest;
        }
        most = brightest > most ? brightest : most;
        lost += brightest > 0 && brightest < floor->black ? 1 : 0;
        coarse += brightest >= floor->black && brightest < floor->full ? 1 : 0;
    }
    if (most > 0 && most < floor->black) {
        fail(error, ERROR_DOMAIN, "the brightest pixel has %.3g %s: %s begin at %.3g", most, name,
             floor->name, floor->least);
        return error_hint(error, "all would be black: give more light, or time, or an OpenEXR of "
                                 "half floats {--bits} 32");
    }
    if ((double)lost >= SAID_FROM * (double)pixels) {
        growing_format(remarks,
                       "warning: %.3g %% of the pixels have light that is too little for %s and "
                       "becomes black: they begin at %.3g %s\n",
                       100 * (double)lost / (double)pixels, floor->name, floor->least, name);
    }
    if ((double)coarse >= SAID_FROM * (double)pixels) {
        growing_format(remarks,
                       "warning: %.3g %% of the pixels lose digits: below %.3g %s %s have fewer\n",
                       100 * (double)coarse / (double)pixels, floor->full, name, floor->name);
    }
    return true;
}
