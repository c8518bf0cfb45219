/* camera/sensor/demosaic.h - the colours that a pixel of a mosaic has not seen. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SENSOR_DEMOSAIC_H
#define LENSCALC_CAMERA_SENSOR_DEMOSAIC_H

#include "camera/sensor/sensor.h"

/*
 * Red, green and blue of every pixel, bilinearly: plain, and known for its coloured edges.
 *
 * Given     raw     one channel; place: of its first pixel in the frame, which decides the mosaic
 *           mosaic  not MOSAIC_NONE
 * Result    full    three channels: a pixel's own one as it is, each other the mean of its
 *                   neighbours that have it: two beside it, four beside it, or four at the corners;
 *                   at an edge of the picture those that there are
 * Formula   exact, but at the picture's edges, for light that changes linearly
 * Errors    ERROR_DOMAIN: below 2 x 2 pixels, another number of channels; ERROR_DATA: too many
 */
bool demosaic_bilinear(const struct image *raw, enum sensor_mosaic mosaic,
                       const struct sensor_place *place, struct arena *arena, struct image *full,
                       struct error *error);

#endif
