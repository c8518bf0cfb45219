/* file/lens_glass.c - the glasses that a lens names. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_glass.h"

#include "data/glass_catalog.h"

static bool index_of(const void *glass, double wavelength, struct pair *index, struct error *error)
{
    if (!glass_check_range(glass, wavelength, error)) {
        return false;
    }
    *index = glass_index(glass, pair_of(wavelength)).n;
    return true;
}

static bool find_named(const struct lens_glasses *glasses, enum glass_naming naming,
                       struct medium *medium, struct error *error)
{
    struct glass_record record;
    if (!glass_find(glasses->db, medium->written, naming, glasses->arena, &record, error)) {
        return false;
    }
    struct glass *glass = ARENA_NEW(glasses->arena, struct glass);
    *glass = record.glass;
    medium->glass = glass;
    medium->glass_index = index_of;
    medium->warning = record.warning;
    if (record.taken_as != NULL) {
        const char *taken = arena_printf(glasses->arena, "the glass is %s", record.taken_as);
        medium->warning = record.warning == NULL
                              ? taken
                              : arena_printf(glasses->arena, "%s; %s", taken, record.warning);
    }
    return true;
}

static bool find(void *context, struct medium *medium, struct error *error)
{
    return find_named(context, GLASS_OWN_NAMES, medium, error);
}

static bool find_foreign(void *context, struct medium *medium, struct error *error)
{
    return find_named(context, GLASS_ALIASES, medium, error);
}

struct medium lens_glass_medium(const struct glass *glass)
{
    return (struct medium){
        .kind = MEDIUM_GLASS, .written = glass->name, .glass_index = index_of, .glass = glass};
}

const struct glass *lens_glass_of(const struct medium *medium)
{
    return medium->kind == MEDIUM_GLASS && medium->glass_index == index_of ? medium->glass : NULL;
}

struct glass_source lens_glass_source(struct lens_glasses *glasses)
{
    return (struct glass_source){find, find_foreign, glasses};
}
