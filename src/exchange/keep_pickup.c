/* exchange/keep_pickup.c - pick-ups of other programs' files, as those of a lens. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_pickup.h"

#include "optics/pickup.h"

#include <math.h>

/* Does the lens have what the pick-up gives? */
static bool keep_pickup_is_followed(const struct lens *lens, const struct lens_pickup *pickup,
                                    struct arena *arena)
{
    const struct parameter what = pickup->what;
    struct lens_pickup alone = *pickup;
    struct lens *trial = parameter_apply(lens, NULL, NULL, 0, arena);
    trial->pickups = &alone;
    trial->pickup_count = 1;
    lens_pickups_put(trial, lens, arena);
    return what.kind == PARAMETER_GLASS ? medium_is_same(&trial->surfaces[what.surface].medium,
                                                         &lens->surfaces[what.surface].medium)
                                        : parameter_get(trial, what) == parameter_get(lens, what);
}

/* R6 = -R3 is what people write of two radii, not c6 = -c3. */
static bool is_of_radii(const struct lens *lens, const struct lens_pickup *pickup)
{
    return pickup->what.kind == PARAMETER_CURVATURE && pickup->from.kind == PARAMETER_CURVATURE &&
           !lens->surfaces[pickup->what.surface].is_plane &&
           !lens->surfaces[pickup->from.surface].is_plane && pickup->offset.value.hi == 0 &&
           fabs(pickup->factor.value.hi) == 1;
}

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
    if (there && is_of_radii(lens, &pickup)) {
        pickup.what.kind = pickup.from.kind = PARAMETER_RADIUS;
    }
    if (there && parameter_suits(what.kind, &lens->surfaces[what.surface]) &&
        parameter_suits(from.kind, &lens->surfaces[from.surface])) {
        there = keep_pickup_is_followed(lens, &pickup, arena);
        arena_reset(arena, mark);
        if (there) {
            lens_pickup_add(lens, pickup, arena);
        }
    }
}
