/* camera/photograph/skip.h - what a picture does without where it is the same. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_SKIP_H
#define LENSCALC_CAMERA_PHOTOGRAPH_SKIP_H

#include "base/text.h"

#include <stdbool.h>

enum skip {
    SKIP_PUPIL,     /* rays that the lens would stop */
    SKIP_COLOUR,    /* rays of all colours, where they go the same way, or nearly */
    SKIP_BLUR,      /* rays through all of the pupil, where they see the same */
    SKIP_UNIFORM,   /* rays at all, where everything has the same light */
    SKIP_EXPOSURES, /* a picture for each exposure */
    SKIP_TIME,      /* times of rays, where nothing moves */
    SKIP_SECONDARY, /* rays beyond the first, where nothing sends on light that it receives */
    SKIP_COUNT
};

/* Their names, in that order; ends with null. */
extern const struct word skip_words[];

/* Is it done all the same? kept: 1 << enum skip of what is. */
static inline bool skip_is_kept(unsigned kept, enum skip skip)
{
    return (kept & 1U << skip) != 0;
}

#endif
