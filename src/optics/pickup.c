/* optics/pickup.c - numbers of a lens that follow others: pick-ups. */
/* SPDX-License-Identifier: MIT */
#include "optics/pickup.h"

#include <math.h>
#include <string.h>

/* May numbers of the two kinds follow each other without a unit in the factor? */
static bool pickup_is_alike(struct parameter a, struct parameter b)
{
    const unsigned angle = PARAMETER_IS_ANGLE;
    bool glasses = a.kind == PARAMETER_GLASS && b.kind == PARAMETER_GLASS;
    bool numbers = a.kind != PARAMETER_GLASS && b.kind != PARAMETER_GLASS;
    return glasses ||
           (numbers && parameter_length(a.kind, a.order) == parameter_length(b.kind, b.order) &&
            (parameter_type(a.kind)->is & angle) == (parameter_type(b.kind)->is & angle));
}

/* Does it stand on the mark of a surface? */
static bool pickup_is_marked(const struct lens *lens, struct parameter what)
{
    const struct surface *surface = &lens->surfaces[what.surface];
    for (size_t i = 0; i < surface->vary_count; i++) {
        const struct parameter mark = {what.surface, surface->varies[i].kind,
                                       surface->varies[i].order};
        if (parameter_is_same(mark, what)) {
            return true;
        }
    }
    return false;
}

/* Do the pick-ups lead from `from` back to `what`? */
static bool leads_back(const struct lens *lens, struct parameter from, struct parameter what)
{
    for (size_t steps = 0; steps <= lens->pickup_count; steps++) {
        size_t i = 0;
        if (parameter_is_same(from, what)) {
            return true;
        }
        while (i < lens->pickup_count && !parameter_is_same(lens->pickups[i].what, from)) {
            i++;
        }
        if (i == lens->pickup_count) {
            return false;
        }
        from = lens->pickups[i].from;
    }
    return false;
}

/* Is there such a number, and of `what`: may a pick-up set it? */
static const char *against_number(const struct lens *lens, struct parameter one, bool is_set,
                                  struct arena *arena)
{
    const char *name = parameter_mark_write(one, arena);
    struct lens alone = *lens;
    struct error error;
    if (one.surface >= lens->surface_count) {
        return arena_printf(arena, "%s: the lens has %zu surfaces", name, lens->surface_count);
    }
    if (!is_set) { /* what it follows may be another in every position */
        const struct surface *surface = &lens->surfaces[one.surface];
        bool none = one.kind == PARAMETER_THICKNESS && !surface->has_thickness;
        bool medium = parameter_is_of_medium(one.kind);
        if (none || !parameter_suits(one.kind, surface)) {
            return arena_printf(arena, "%s: its surface has no %s", name,
                                parameter_type(one.kind)->words);
        }
        if (!medium) {
            return NULL;
        }
        alone.setting_count = 0;
    }
    return parameter_check(&alone, one, &error)
               ? NULL
               : arena_printf(arena, "%s: %s", name, error.message);
}

const char *lens_pickup_add(struct lens *lens, struct lens_pickup pickup, struct arena *arena)
{
    const char *name = parameter_mark_write(pickup.what, arena);
    const char *against = against_number(lens, pickup.what, true, arena);
    if (against != NULL) {
        return against;
    }
    if (parameter_is_same(pickup.what, pickup.from)) {
        return arena_printf(arena, "%s follows itself", name);
    }
    against = against_number(lens, pickup.from, false, arena);
    if (against != NULL) {
        return against;
    }
    const char *from = parameter_mark_write(pickup.from, arena);
    if (!pickup_is_alike(pickup.what, pickup.from)) {
        return arena_printf(arena, "%s and %s have not the same dimension", name, from);
    }
    if (pickup_is_marked(lens, pickup.what)) {
        return arena_printf(arena,
                            "%s follows %s, and the mark at surface %zu lets it vary: only "
                            "one of them can be",
                            name, from, pickup.what.surface + 1);
    }
    for (size_t i = 0; i < lens->pickup_count; i++) {
        if (parameter_is_same(lens->pickups[i].what, pickup.what)) {
            return arena_printf(arena, "%s has a pick-up already: it follows %s", name,
                                parameter_mark_write(lens->pickups[i].from, arena));
        }
    }
    if (leads_back(lens, pickup.from, pickup.what)) {
        return arena_printf(arena, "%s follows %s, which follows it: pick-ups in a circle", name,
                            from);
    }
    if (lens->pickup_count == LENS_MOST_PICKUPS) {
        return arena_printf(arena, "more than %d pick-ups", LENS_MOST_PICKUPS);
    }
    /*
     * Behind those that it follows, before those that follow it: they come last, and among
     * themselves both parts stay as they were.
     */
    size_t count = lens->pickup_count, first = 0, last = 0;
    struct lens_pickup *all = ARENA_ARRAY(arena, 2 * count + 2, struct lens_pickup);
    struct lens_pickup *behind = all + count + 1;
    for (size_t i = 0; i < count; i++) {
        bool follows = parameter_is_same(lens->pickups[i].from, pickup.what);
        for (size_t j = 0; j < last; j++) {
            follows = follows || parameter_is_same(lens->pickups[i].from, behind[j].what);
        }
        if (follows) {
            behind[last++] = lens->pickups[i];
        } else {
            all[first++] = lens->pickups[i];
        }
    }
    all[first] = pickup;
    memcpy(all + first + 1, behind, last * sizeof behind[0]);
    lens->pickups = all;
    lens->pickup_count = count + 1;
    return NULL;
}

/* With all digits that the lens has of it. */
static struct pair pickup_number_of(const struct lens *lens, struct parameter one)
{
    const struct surface *surface = &lens->surfaces[one.surface];
    const struct figure *figure = parameter_figure(surface, one.kind, one.order);
    if (figure != NULL) {
        return figure->value;
    }
    if (one.kind == PARAMETER_RADIUS && surface->has_curvature) {
        return pair_divide(pair_of(1), surface->curvature.value);
    }
    return (one.kind == PARAMETER_CURVATURE && !surface->is_plane)
               ? pair_divide(pair_of(1), surface->radius.value)
               : pair_of(parameter_get(lens, one));
}

static struct pair pickup_follow(const struct lens_pickup *pickup, struct pair value)
{
    return isinf(value.hi)
               ? pair_of(INFINITY)
               : pair_add(pair_multiply(pickup->factor.value, value), pickup->offset.value);
}

static void pickup_put_number(struct lens *lens, const struct lens_pickup *pickup,
                              const struct lens *from, struct arena *arena)
{
    const struct parameter what = pickup->what;
    struct surface *surface = &lens->surfaces[what.surface];
    if (what.kind == PARAMETER_GLASS) {
        const struct medium medium = from->surfaces[pickup->from.surface].medium;
        parameter_put_medium(lens, what.surface, &medium);
        return;
    }
    const struct figure figure =
        figure_number(pickup_follow(pickup, pickup_number_of(from, pickup->from)));
    bool in_medium = parameter_is_of_medium(what.kind);
    bool of_radius = what.kind == PARAMETER_CURVATURE && !surface->has_curvature;
    if (in_medium || of_radius) {
        parameter_set(lens, what, figure.value.hi, arena);
    } else {
        parameter_put(surface, what.kind, what.order, figure, arena);
    }
}

void lens_pickups_put(struct lens *lens, const struct lens *from, struct arena *arena)
{
    for (size_t i = 0; i < lens->pickup_count; i++) {
        pickup_put_number(lens, &lens->pickups[i], from, arena);
    }
}
