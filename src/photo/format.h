/* photo/format.h - sensor formats and the circle of confusion that suits them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_FORMAT_H
#define LENSCALC_PHOTO_FORMAT_H

#include <stdbool.h>

#include "base/error.h"

/* The picture area; width is its horizontal side, whichever is longer. */
struct sensor {
    double width, height; /* mm, > 0 */
    double pitch;         /* pixel pitch, mm, > 0; NaN = unknown */
};

/* Errors: a side not above 0 or not finite; a pitch that is given and not above 0. */
bool sensor_check(const struct sensor *sensor, struct error *error);

/* Diagonal of the picture area, mm. */
double sensor_diagonal(const struct sensor *sensor);

/*
 * Crop factor by diagonal.
 *
 * Given     sensor  checked
 * Result    k, > 0; f k is the focal length with the same diagonal angle on 36 x 24 mm
 * Formula   sqrt(36^2 + 24^2)/diagonal = 43.2666.../diagonal
 * Limits    By width or by height it is another number when the shape is not 3:2: say which.
 */
double sensor_crop(const struct sensor *sensor);

/*
 * Pixel pitch of so many pixels.
 *
 * Given     sensor  checked;  pixels  number, > 0
 * Result    mm
 * Formula   sqrt(width height/pixels)
 * Limits    square pixels that fill the picture area
 */
double sensor_pitch_of(const struct sensor *sensor, double pixels);

/*
 * The picture area that an optical format ("1/1.28 inch") stands for.
 *
 * Given     inches  the format, 1/20 to 4
 *           sensor  receives a 4:3 area without a pitch
 * Formula   diagonal = 16 mm x inches from 1/2 inch on, 18 mm x inches below it
 * Source    [OptoWiki26] Sensor Format: the diameter of the vidicon tube with that picture
 * Errors    inches outside that range
 * Limits    Nominal: makers round the format as they like; areas differ from this by up to 8 %.
 */
bool sensor_optical_format(double inches, struct sensor *sensor, struct error *error);

/*
 * The largest part of a picture area that has another shape.
 *
 * Given     gate   checked
 *           ratio  width to height of the part, 0.1 to 10
 * Result    the whole width or the whole height of the gate, with its pitch
 * Source    derived: one side is kept, the other follows from the ratio
 * Errors    a ratio outside that range
 */
bool sensor_extract(const struct sensor *gate, double ratio, struct sensor *part,
                    struct error *error);

/* How much blur counts as sharp. */
enum coc_kind {
    COC_LENGTH,   /* value: the diameter itself, mm, >= 0 */
    COC_DIAGONAL, /* value: the part of the diagonal, 1500 for d/1500 (usual also 1730, 1440) */
    COC_PIXELS,   /* value: number of pixel pitches */
    COC_PRINT,    /* viewing, acuity, print: what the eye resolves on a print */
    COC_AIRY      /* wavelength, fnumber: the Airy disc, as large as diffraction makes any point */
};

struct coc {
    enum coc_kind kind;
    double value;
    double viewing;             /* viewing distance, mm; COC_PRINT only, as the next two */
    double acuity;              /* resolving power of the eye at 250 mm, line pairs per mm */
    double print;               /* long side of the print, mm */
    double print_short;         /* its other side, mm; 0 = whatever the picture makes it */
    double wavelength, fnumber; /* mm, 1; COC_AIRY only */
};

/* The criterion that is taken where nothing else is said: d/1500. */
extern const struct coc coc_default;

/*
 * Circle of confusion of a criterion on a sensor.
 *
 * Given     coc     the criterion
 *           sensor  the picture area, with its pitch for COC_PIXELS
 *           c       receives the diameter, mm
 * Formula   c; d/value; value x pitch; (viewing/250)/(acuity x enlargement), enlargement =
 *           print/long side of the sensor, or the shorter sides' where that is less: the whole
 *           picture is on the paper; 2.43934 wavelength x fnumber
 * Source    customs of the trade: on 36 x 24 mm d/1500 is 0.0288 mm, d/1730 is 0.0250 mm, d/1440 is
 *           0.0300 mm; print: one line pair of the eye's limit, seen from 25 cm
 * Errors    as sensor_check; value, viewing, acuity or print not above 0; pitch unknown
 */
bool coc_resolve(const struct coc *coc, const struct sensor *sensor, double *c,
                 struct error *error);

#endif
