/* camera/sensor/demosaic.c - bilinear interpolation of a mosaic. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/demosaic.h"

struct site {
    size_t x, y;        /* in the picture */
    size_t column, row; /* in the frame */
};

/*
 * Mean of the neighbours with another channel than the own: they are all beside, or all at corners.
 */
static double around(const struct image *raw, enum sensor_mosaic mosaic, const struct site *site,
                     size_t channel)
{
    double sum = 0;
    int count = 0;
    for (size_t y = site->y == 0 ? 0 : site->y - 1; y <= site->y + 1 && y < raw->height; y++) {
        for (size_t x = site->x == 0 ? 0 : site->x - 1; x <= site->x + 1 && x < raw->width; x++) {
            const size_t row = site->row + y - site->y, column = site->column + x - site->x;
            if (sensor_mosaics[mosaic].channel[row % 2][column % 2] == channel) {
                sum += (double)image_row(raw, y)[x];
                count++;
            }
        }
    }
    return sum / count;
}

bool demosaic_bilinear(const struct image *raw, enum sensor_mosaic mosaic,
                       const struct sensor_place *place, struct arena *arena, struct image *full,
                       struct error *error)
{
    if (raw->channels != 1 || raw->width < 2 || raw->height < 2) {
        return fail(error, ERROR_DOMAIN,
                    "a mosaic has one channel and 2 x 2 pixels at least, not %zu of %zu x %zu",
                    raw->channels, raw->width, raw->height);
    }
    *full = (struct image){.width = raw->width, .height = raw->height, .channels = SENSOR_CHANNELS};
    if (!image_new(full, arena, error)) {
        return false;
    }
    for (size_t y = 0; y < raw->height; y++) {
        for (size_t x = 0; x < raw->width; x++) {
            const struct site site = {x, y, place->column + x, place->row + y};
            const size_t own = sensor_mosaics[mosaic].channel[site.row % 2][site.column % 2];
            float *pixel = image_row(full, y) + x * SENSOR_CHANNELS;
            for (size_t channel = 0; channel < SENSOR_CHANNELS; channel++) {
                pixel[channel] = channel == own ? image_row(raw, y)[x]
                                                : (float)around(raw, mosaic, &site, channel);
            }
        }
    }
    return true;
}
