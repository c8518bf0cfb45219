/* camera/photograph/skip.c - names of what a picture does without. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/skip.h"

const struct word skip_words[] = {
    [SKIP_PUPIL] = {"pupil", "rays that the lens would stop"},
    [SKIP_COLOUR] = {"colour", "rays of each colour, where nothing disperses"},
    [SKIP_BLUR] = {"blur", "rays all over the pupil, where they see the same"},
    [SKIP_UNIFORM] = {"uniform", "rays, where everything has the same light"},
    [SKIP_EXPOSURES] = {"exposures", "a picture for each exposure"},
    [SKIP_TIME] = {"time", "times of rays, where nothing moves"},
    [SKIP_SECONDARY] = {"secondary", "rays beyond the first, where nothing sends on light"},
    [SKIP_COUNT] = {NULL, NULL}};
