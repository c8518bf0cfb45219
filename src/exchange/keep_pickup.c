/* exchange/keep_pickup.c - pick-ups of other programs' files, as those of a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_pickup.h"

#include "optics/pickup.h"

#include <math.h>

void keep_pickup(struct lens *lens, struct parameter what, struct parameter from,
                 struct pair factor, struct pair offset, struct arena *arena)
{
    struct lens_pickup pickup = {
        .what = what,
        .from = from,
        .factor = {.value = factor, .variable = LENS_NONE},
        .offset = {.value = offset, .variable = LENS_NONE},
    };
    const struct arena_mark mark = arena_mark(arena);
    bool there = what.surface < lens->surface_count && from.surface < lens->surface_count &&
                 lens->position_count == 0 && lens->pickup_count < LENS_MOST_PICKUPS &&
                 fabs(factor.hi) > 0;
    /* R6 = -R3 is what people write of two radii, not c6 = -c3. */
    if (there && what.kind == PARAMETER_CURVATURE && from.kind == PARAMETER_CURVATURE &&
        !lens->surfaces[what.surface].is_plane && !lens->surfaces[from.surface].is_plane &&
        offset.hi == 0 && fabs(factor.hi) == 1) {
        pickup.what.kind = pickup.from.kind = PARAMETER_RADIUS;
    }
    if (there && parameter_suits(what.kind, &lens->surfaces[what.surface]) &&
        parameter_suits(from.kind, &lens->surfaces[from.surface])) {
        /* Does the lens have what the pick-up gives? */
        struct lens_pickup alone = pickup;
        struct lens *trial = parameter_apply(lens, NULL, NULL, 0, arena);
        trial->pickups = &alone;
        trial->pickup_count = 1;
        lens_pickups_put(trial, lens, arena);
        there = what.kind == PARAMETER_GLASS
                    ? medium_is_same(&trial->surfaces[what.surface].medium,
                                     &lens->surfaces[what.surface].medium)
                    : parameter_get(trial, what) == parameter_get(lens, what);
        arena_reset(arena, mark);
        if (there) {
            lens_pickup_add(lens, pickup, arena);
        }
    }
}
