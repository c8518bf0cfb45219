/* file/lens_glass.c - the glasses that a lens names. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_glass.h"

#include "file/glass_catalog.h"

static bool index_of(const void *glass, double wavelength, struct pair *index, struct error *error)
{
    if (!glass_check_range(glass, wavelength, error)) {
        return false;
    }
    const struct glass_index found = glass_index(glass, (struct twofold){wavelength, 0});
    *index = (struct pair){found.n.high, found.n.low};
    return true;
}

static bool find(void *context, struct medium *medium, struct error *error)
{
    const struct lens_glasses *glasses = context;
    struct glass_record record;
    if (!glass_find(glasses->db, medium->written, glasses->arena, &record, error)) {
        return false;
    }
    struct glass *glass = ARENA_NEW(glasses->arena, struct glass);
    *glass = record.glass;
    medium->glass = glass;
    medium->glass_index = index_of;
    return true;
}

struct glass_source lens_glass_source(struct lens_glasses *glasses)
{
    return (struct glass_source){find, glasses};
}
