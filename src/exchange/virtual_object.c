/* exchange/virtual_object.c - objects in or behind the first surface of a lens file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/virtual_object.h"

#include "file/lens_unit.h"

void virtual_object_put(struct lens_build *build, struct pair distance)
{
    struct lens *lens = build->lens;
    struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
    const struct number_scale unit = lens_unit_scale(lens->unit);
    text_pair(one.typed, unit, &one.value);
    lens->object = one;
    lens->object_is_infinite = false;
    struct surface *plane = lens_build_surface(build);
    plane->medium = lens->object_medium;
    plane->thickness = figure_computed(pair_subtract(distance, one.value), unit, build->arena);
    const char *where =
        distance.hi < 0 ? arena_printf(build->arena, "%.6g mm behind", -distance.hi) : "in";
    lens_build_note(build,
                    text_of(arena_printf(build->arena,
                                         "the object lies %s the first surface of the file: "
                                         "surface 1 is a plane 1 %s behind the object, from which "
                                         "rays go back",
                                         where, lens->unit)));
}
