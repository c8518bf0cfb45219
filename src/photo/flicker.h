/* photo/flicker.h - exposures that lamps on the mains do not make flicker. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_FLICKER_H
#define LENSCALC_PHOTO_FLICKER_H

#include "base/error.h"

#include <stdbool.h>

struct flicker {
    long longest;   /* pulses that fit into a frame; of a single picture 0 */
    double pulses;  /* of light in the exposure; NaN without t */
    bool is_free;   /* are they a whole number? */
    bool is_steady; /* has every frame the same part of the pulses, whatever the exposure? */
    double nearest; /* the nearest time with whole pulses, s; NaN where no time fits into a frame,
                        or without t */
};

/* Of so many pulses: s, and rad of a rotating shutter. */
double flicker_time(double mains, long pulses);
double flicker_angle(double mains, double rate, long pulses);

/*
 * Does an exposure flicker under lamps on the mains, and which one does not?
 *
 * Given     mains  frequency of the mains, Hz, > 0: the light pulses at twice that
 *           t      exposure time, s, > 0; NaN = not given
 *           rate   frames per second, > 0; of a single picture NaN
 * Formula   pulses = 2 mains t; free where whole (within 1 %); steady where 2 mains/rate is whole
 *           (within 1e-4); longest = floor(2 mains/rate); angle = 2 pi rate pulses/(2 mains)
 * Source    custom of cinematography: 172.8 deg at 24 fps and 50 Hz is 1/50 s, 144 deg at 60 Hz
 *           1/60 s; 120/n fps are steady at 60 Hz (cinematography.com topic 13437)
 * Errors    a number not above 0
 * Limits    lamps that follow the mains: LEDs and electronic ballasts have other frequencies.
 *           A rolling shutter shows bands where frames are only steady
 */
bool flicker_check(double mains, double t, double rate, struct flicker *flicker,
                   struct error *error);

#endif
