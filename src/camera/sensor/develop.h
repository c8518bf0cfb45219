/* camera/sensor/develop.h - raw data of a sensor to a picture for the eye. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SENSOR_DEVELOP_H
#define LENSCALC_CAMERA_SENSOR_DEVELOP_H

#include "camera/sensor/sensor.h"
#include "light/colour.h"

/*
 * sqrt(2): between a white that reflects all light and saturation ISO 12232 leaves half a stop, so
 * that a grey of 18 % exposed by the meter, 10/S lx s of 78/S, becomes 0.18.
 */
#define DEVELOP_HEADROOM 1.41421356237309504880

/* What the balance of white is. */
enum white_balance {
    BALANCE_DAYLIGHT, /* sRGB's white stays white: nothing is changed */
    BALANCE_TUNGSTEN, /* standard illuminant A becomes white */
    BALANCE_KELVIN,   /* a colour temperature does */
    BALANCE_AUTO      /* the mean of the picture, without what is saturated, does */
};

struct develop_way {
    enum white_balance white;
    double kelvin;   /* of BALANCE_KELVIN */
    double headroom; /* what saturation becomes, > 0: DEVELOP_HEADROOM, or 1 */
};

/* What became of it. */
struct developed {
    struct image picture;
    struct colour white; /* the one that was taken, X, Y, Z */
    /* row j times (R, G, B): the light of channel j as a share of what a full pixel has at least;
       of a mono sensor all rows say the same */
    struct colour_matrix fill;
};

/*
 * Develop a picture.
 *
 * Given     raw      of sensor_expose, or of demosaic_bilinear
 *           way
 * Result    made     linear sRGB, three channels, 1 is white: what a PNG of IMAGE_LIGHT takes; may
 *                    lie below 0 and above 1. A mono sensor's is grey, whatever the balance
 *                    made->fill gives (number - zero)/(full_number - zero) of each channel, by the
 *                    inverse of what made R, G and B
 * Formula   H = ((number - black)/K - dark)/electrons of each channel, the mean of the dark
 *           subtracted; over H_sat = (largest number - black)/(K electrons), which is 78/S where K
 *           comes from a speed; times headroom; the inverse of what the channels see; balance
 *           (light/colour.h)
 * Errors    ERROR_DOMAIN: a colour temperature out of range; an automatic balance of a picture in
 *           which nothing is between dark and saturation; another number of channels; channels
 *           that see the same
 * Limits    what is saturated in a channel has a colour of its own where headroom and balance leave
 *           it below 1
 */
bool develop_picture(const struct sensor_model *model, const struct image *raw,
                     const struct develop_way *way, struct arena *arena, struct developed *made,
                     struct error *error);

#endif
