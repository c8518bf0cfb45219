/* optics/element.c - the elements of a lens: what is mounted as one piece. */
/* SPDX-License-Identifier: MIT */
#include "optics/element.h"

/* Is it there at all, where it stands by itself? A stop is not, nor a plane in air. */
static bool is_piece(const struct lens *lens, size_t surface)
{
    const struct surface *one = &lens->surfaces[surface];
    return surface_reflects(one) || surface_has(one, SURFACE_HAS_FOCAL) ||
           !medium_is_air(&one->medium) || (surface == 0 && !medium_is_air(&lens->object_medium));
}

size_t elements_of(const struct lens *lens, struct arena *arena, struct element **elements)
{
    struct element *all = ARENA_ARRAY(arena, lens->surface_count + 1, struct element);
    size_t count = 0, first = 0;
    bool in_air = true;
    for (size_t i = 0; i < lens->surface_count; i++) {
        first = in_air ? i : first;
        const bool was_in_air = in_air;
        /* air behind the surface, or the end of the lens; a mirror's light stays in its medium */
        const struct surface *one = &lens->surfaces[i];
        in_air = i + 1 == lens->surface_count ||
                 (surface_reflects(one) ? in_air : medium_is_air(&one->medium));
        if (in_air && (!was_in_air || is_piece(lens, i))) {
            all[count++] = (struct element){first, i};
        }
    }
    *elements = all;
    return count;
}

const struct element *element_at(const struct element *elements, size_t count, size_t surface)
{
    size_t low = 0, high = count; /* what ends before the surface lies below low */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (elements[middle].last < surface) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < count && elements[low].first <= surface ? &elements[low] : NULL;
}
