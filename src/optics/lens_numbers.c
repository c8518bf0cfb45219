/* optics/lens_numbers.c - a lens whose numbers are set again and again. */
/* SPDX-License-Identifier: MIT */
#include "optics/lens_numbers.h"

#include <string.h>

/* Its own memory for a displacement that is there already. */
static const struct displacement *lens_numbers_own(const struct displacement *from,
                                                   struct displacement *room)
{
    if (from == NULL) {
        return NULL;
    }
    *room = *from;
    return room;
}

void lens_numbers_open(const struct lens *lens, struct arena *arena, struct lens_numbers *numbers)
{
    const size_t count = lens->surface_count;
    *numbers = (struct lens_numbers){
        .lens = *lens,
        .displacements = ARENA_ARRAY(arena, 2 * count, struct displacement),
        .written = ARENA_ARRAY(arena, (count + 1) * PARAMETER_WRITTEN, char),
    };
    struct surface *surfaces = ARENA_ARRAY(arena, count, struct surface);
    memcpy(surfaces, lens->surfaces, count * sizeof *surfaces);
    for (size_t i = 0; i < count; i++) {
        struct displacement *room = &numbers->displacements[2 * i];
        surfaces[i].decentre = lens_numbers_own(surfaces[i].decentre, room);
        surfaces[i].coordinate_break = lens_numbers_own(surfaces[i].coordinate_break, room + 1);
    }
    numbers->lens.surfaces = surfaces;
}

void lens_numbers_set(struct lens_numbers *numbers, struct parameter parameter, double value)
{
    const size_t i = parameter.surface, medium = i + 1; /* LENS_NONE: the first of them */
    struct parameter_room room = {.written = numbers->written + medium * PARAMETER_WRITTEN};
    if (i != LENS_NONE) {
        const size_t is_break = parameter.kind >= PARAMETER_BREAK_DECENTER_X ? 1 : 0;
        room.displacement = &numbers->displacements[2 * i + is_break];
    }
    parameter_set_in(&numbers->lens, parameter, value, &room);
}
