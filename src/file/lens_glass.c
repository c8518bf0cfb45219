/* file/lens_glass.c - the glasses that a lens names. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_glass.h"

#include "data/glass_catalog.h"

#include <math.h>

static bool index_of(const void *glass, double wavelength, struct pair *index, struct error *error)
{
    if (!glass_check_range(glass, wavelength, error)) {
        return false;
    }
    *index = glass_index(glass, pair_of(wavelength)).n;
    return true;
}

/* A glass that was found by its name, with what its catalogue prints. */
struct named {
    struct glass glass;
    struct glass_abbe printed;
};

static bool index_of_named(const void *named, double wavelength, struct pair *index,
                           struct error *error)
{
    const struct named *found = named;
    return index_of(&found->glass, wavelength, index, error);
}

static bool find_by_name(const struct lens_glasses *glasses, enum glass_naming naming,
                         struct medium *medium, struct error *error)
{
    struct glass_record record;
    if (!glass_find(glasses->db, medium->written, naming, glasses->arena, &record, error)) {
        return false;
    }
    struct named *named = ARENA_NEW(glasses->arena, struct named);
    *named = (struct named){record.glass, {record.nd, record.Vd}};
    medium->glass = named;
    medium->glass_index = index_of_named;
    medium->density = record.density > 0 ? record.density : 0;
    medium->price = record.price > 0 ? record.price : 0;
    medium->warning = record.warning;
    if (record.taken_as != NULL) {
        const char *taken = arena_printf(glasses->arena, "the glass is %s", record.taken_as);
        medium->warning = record.warning == NULL
                              ? taken
                              : arena_printf(glasses->arena, "%s; %s", taken, record.warning);
    }
    return true;
}

static bool lens_glass_find(void *context, struct medium *medium, struct error *error)
{
    return find_by_name(context, GLASS_OWN_NAMES, medium, error);
}

static bool find_foreign(void *context, struct medium *medium, struct error *error)
{
    return find_by_name(context, GLASS_ALIASES, medium, error);
}

static bool find_homonym(void *context, struct medium *medium, struct error *error)
{
    return find_by_name(context, GLASS_HOMONYMS, medium, error);
}

struct medium lens_glass_medium(const struct glass *glass)
{
    return (struct medium){
        .kind = MEDIUM_GLASS, .written = glass->name, .glass_index = index_of, .glass = glass};
}

const struct glass *lens_glass_of(const struct medium *medium)
{
    bool is_glass = medium->kind == MEDIUM_GLASS &&
                    (medium->glass_index == index_of || medium->glass_index == index_of_named);
    return is_glass ? medium->glass : NULL; /* the first member of what was found */
}

struct glass_abbe lens_glass_printed(const struct medium *medium)
{
    const struct glass_abbe none = {NAN, NAN};
    const struct named *named = medium->glass;
    return medium->kind == MEDIUM_GLASS && medium->glass_index == index_of_named ? named->printed
                                                                                 : none;
}

struct glass_source lens_glass_source(struct lens_glasses *glasses)
{
    return (struct glass_source){lens_glass_find, find_foreign, find_homonym, glasses};
}
