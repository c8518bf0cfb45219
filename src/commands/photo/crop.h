/* commands/photo/crop.h - a part of the sensor, by its crop factor. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_CROP_H
#define LENSCALC_COMMANDS_PHOTO_CROP_H

#include "base/arena.h"
#include "cli/options/option.h"

/* Without a --sensor it is the crop factor that cameras are said to have. */
#define OPTION_CROP(member)                                                                        \
    ENTRY(MEASURE(member, ratio, NULL, "FACTOR"), REPEATED("crop"),                                \
          .quantity = "crop of the sensor", ABOVE_0, .usual = {0.3, 10},                           \
          .unusual = "crop factors are 0.3 to 10",                                                 \
          .help = "crop factor: only so much of --sensor is used, its sides divided by 1.5x; "     \
                  "without --sensor, of 36 x 24 mm")

/*
 * What is left of a sensor whose sides are divided by a factor, its pixels as they were.
 *
 * Given     whole  a sensor
 *           crop   > 0; NaN: all of it
 *           part   receives what is left, its name that of the whole with the factor
 * Errors    ERROR_DOMAIN: a factor below 1 of a sensor that was named: there is no more of it
 */
bool crop_sensor(const struct sensor_value *whole, double crop, struct arena *arena,
                 struct sensor_value *part, struct error *error);

#endif
