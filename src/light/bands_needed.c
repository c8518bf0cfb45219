/* light/bands_needed.c - into how many bands narrow light should be divided. */
/* SPDX-License-Identifier: MIT */
#include "light/bands_needed.h"

#include "light/bands.h"
#include "light/bands_match.h"

#include <math.h>

size_t bands_needed(const struct spectrum *light, double most, double *off)
{
    size_t needed = BANDS_MOST;
    *off = (double)INFINITY;
    for (size_t count = BANDS_LEAST; count <= BANDS_MOST && !(*off <= most); count++) {
        struct bands bands;
        struct error error;
        double of[BANDS_MOST];
        if (!bands_many(count, &bands, &error) ||
            !bands_of_light(&bands, light, of, NULL, &error)) {
            continue;
        }
        const double next = bands_off(&bands, light, of);
        if (next < *off) {
            *off = next;
            needed = count;
        }
    }
    return needed;
}
