/* analysis/layout/layout_parts.c - what a section is put together from. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"

struct layout_part *layout_add(struct layout *layout, enum layout_kind kind, size_t count,
                               double **z, double **y)
{
    layout->parts = arena_grow(layout->arena, layout->parts, layout->part_count, &layout->part_room,
                               sizeof layout->parts[0]);
    struct layout_part *part = &layout->parts[layout->part_count++];
    *z = ARENA_ARRAY(layout->arena, count, double);
    *y = ARENA_ARRAY(layout->arena, count, double);
    *part = (struct layout_part){.kind = kind, .z = *z, .y = *y, .count = count};
    return part;
}

void layout_line(struct layout *layout, enum layout_kind kind, struct layout_ends ends,
                 const char *label)
{
    double *z, *y;
    struct layout_part *part = layout_add(layout, kind, 2, &z, &y);
    z[0] = ends.z1;
    y[0] = ends.y1;
    z[1] = ends.z2;
    y[1] = ends.y2;
    part->label = label;
}

void layout_note(struct layout *layout, const char *note)
{
    const char **notes = ARENA_ARRAY(layout->arena, layout->note_count + 1, const char *);
    for (size_t i = 0; i < layout->note_count; i++) {
        notes[i] = layout->notes[i];
    }
    notes[layout->note_count++] = note;
    layout->notes = notes;
}
