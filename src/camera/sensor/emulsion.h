/* camera/sensor/emulsion.h - a picture on film, developed and printed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SENSOR_EMULSION_H
#define LENSCALC_CAMERA_SENSOR_EMULSION_H

#include "camera/sensor/sensor.h"
#include "photo/characteristic.h"

struct emulsion {
    struct characteristic curve;
    double granularity; /* rms, as characteristic_grain takes it; 0: none */
    double pitch;       /* of the pixels, mm: the root of their area */
    uint64_t seed;
    int threads; /* that expose it; no density depends on them */
};

/*
 * Expose and develop a film.
 *
 * Given     light    H in lx s, as sensor_expose takes it; the film sees the luminous exposure
 *           place    of its first pixel in the frame, where its grain belongs
 * Result    density  one channel: densities of the negative, 0 and more
 * Errors    as sensor_expose
 */
bool emulsion_expose(const struct emulsion *film, const struct image *light,
                     const struct sensor_place *place, struct arena *arena, struct image *density,
                     struct error *error);

/* Densities to the light of a positive, in place: 1 is white, for a PNG of IMAGE_LIGHT. */
void emulsion_print(const struct emulsion *film, struct image *density);

#endif
