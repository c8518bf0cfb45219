/* cli/batch/photograph_sensor.h - the sensor, or the part of it, that took a photograph. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_BATCH_PHOTOGRAPH_SENSOR_H
#define LENSCALC_CLI_BATCH_PHOTOGRAPH_SENSOR_H

#include "base/image/metadata.h"
#include "cli/options/option.h"

/*
 * The camera's sensor as lensdb has it; of a phone that of the camera with this focal length. Where
 * its crop factor is not that by which the file's equivalent focal length exceeds the real one, the
 * picture is another part, as of a digital zoom or another of a phone's cameras: then, and of an
 * unknown camera, the size follows from the two focal lengths.
 *
 * Given     reader  its arena keeps the name
 *           sensor  receives it; the name says how it was found
 *           doubts  null: nobody listens
 * Formula   diagonal = sqrt(36^2 + 24^2) focal/equivalent, in the shape of the sensor; of an
 *           unknown camera in that of the picture if this is about 4:3 or 3:2, else 3:2, below the
 *           size of APS-C 4:3
 * Source    [Exif10] FocalLengthIn35mmFilm; by the diagonal as in sensor_crop
 * Errors    ERROR_USAGE: the camera is unknown, and the file says no equivalent focal length;
 *           ERROR_DATA: a fault of the user's table of cameras
 * Limits    Equivalents are whole mm: the size is as good as 0.5/equivalent, 2 % at 24 mm. A
 *           larger part than the sensor is doubted, not taken
 */
bool photograph_sensor(const struct reader *reader, const struct metadata *metadata,
                       struct sensor_value *sensor, struct warnings *doubts, struct error *error);

#endif
