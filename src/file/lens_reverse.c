/* file/lens_reverse.c - a lens turned around. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_build.h"
#include "file/lens_change.h"
#include "optics/first_order.h"

#include <math.h>
#include <string.h>

/* A lens being turned around. */
struct turn {
    const struct lens *from;
    struct lens_build build;
    struct arena *arena;
    bool flips; /* an even number of mirrors: z and x change their signs */
};

/* The number with the other sign; its digits too. */
static struct figure negative(struct figure figure, struct arena *arena)
{
    struct text typed = figure.typed;
    if (figure.variable != LENS_NONE || figure.value.hi == 0) {
        return figure;
    }
    figure.value = pair_negate(figure.value);
    if (typed.start != NULL && typed.length > 0) {
        bool minus = typed.start[0] == '-', plus = typed.start[0] == '+';
        figure.typed = text_of(arena_printf(arena, "%s%.*s", minus ? "" : "-",
                                            (int)(typed.length - (minus || plus)),
                                            typed.start + (minus || plus)));
    }
    return figure;
}

static struct figure flipped(const struct turn *turn, struct figure figure, bool flip)
{
    return flip ? negative(figure, turn->arena) : figure;
}

/* Half a turn about y: x, and turns about x and z, change their signs. */
static const struct displacement *turn_displacement(const struct turn *turn,
                                                    const struct displacement *from)
{
    if (from == NULL || !turn->flips) {
        return from;
    }
    struct displacement *to = ARENA_NEW(turn->arena, struct displacement);
    *to = *from;
    to->decenter[0] = negative(from->decenter[0], turn->arena);
    to->tilt[0] = negative(from->tilt[0], turn->arena);
    to->tilt[2] = negative(from->tilt[2], turn->arena);
    return to;
}

static void set_thickness(const struct turn *turn, struct surface *to, const struct surface *from)
{
    to->has_thickness = from->has_thickness;
    to->thickness = flipped(turn, from->thickness, !turn->flips);
}

/* The plane behind a surface on which one part of a bend is undone. */
static struct displacement *add_plane(struct turn *turn)
{
    const struct lens *lens = turn->build.lens;
    const struct medium medium = lens->surfaces[lens->surface_count - 1].medium;
    struct displacement *bend = ARENA_NEW(turn->arena, struct displacement);
    struct surface *plane = lens_build_surface(&turn->build);
    for (int i = 0; i < 3; i++) {
        bend->tilt[i] = bend->decenter[i % 2] = figure_zero();
    }
    plane->medium = medium;
    plane->bend = bend;
    return bend;
}

/* Undo a bend: z, y, x, shift; then half a turn about y. */
static void add_bends(struct turn *turn, const struct displacement *bend)
{
    for (int i = 2; i >= 0; i--) {
        if (bend->tilt[i].value.hi != 0) {
            bool stays = turn->flips && i != 1;
            add_plane(turn)->tilt[i] = flipped(turn, bend->tilt[i], !stays);
        }
    }
    if (bend->decenter[0].value.hi != 0 || bend->decenter[1].value.hi != 0) {
        struct displacement *shift = add_plane(turn);
        shift->decenter[0] = flipped(turn, bend->decenter[0], !turn->flips);
        shift->decenter[1] = negative(bend->decenter[1], turn->arena);
    }
}

static void turn_vary(struct turn *turn, struct surface *surface)
{
    struct vary *copy = ARENA_ARRAY(turn->arena, surface->vary_count, struct vary);
    for (size_t i = 0; i < surface->vary_count; i++) {
        struct vary *vary = &copy[i];
        *vary = surface->varies[i];
        bool thickness = text_equal(vary->what, "t");
        bool sign = text_equal(vary->what, "R") || text_equal(vary->what, "c") ||
                    vary->what.start[0] == 'A';
        if (vary->has_bounds && ((sign && turn->flips) || (thickness && !turn->flips))) {
            struct figure low = vary->low;
            vary->low = negative(vary->high, turn->arena);
            vary->high = negative(low, turn->arena);
        }
    }
    surface->varies = copy;
}

static void add_surface(struct turn *turn, size_t index)
{
    const struct lens *from = turn->from;
    struct surface *to = lens_build_surface(&turn->build);
    *to = from->surfaces[index];
    to->medium = index > 0 ? from->surfaces[index - 1].medium : from->object_medium;
    to->radius = flipped(turn, to->radius, turn->flips && !to->is_plane);
    to->curvature = flipped(turn, to->curvature, turn->flips);
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        to->coefficient[i] = flipped(turn, to->coefficient[i], turn->flips);
    }
    to->moved = turn_displacement(turn, to->moved);
    to->bend = NULL;
    turn_vary(turn, to);
    to->has_thickness = true;
    to->thickness = figure_zero();
    if (from->surfaces[index].is_stop) {
        turn->build.lens->stop = turn->build.lens->surface_count - 1;
    }
    if (from->surfaces[index].bend != NULL) {
        add_bends(turn, from->surfaces[index].bend);
    }
    if (index > 0) {
        struct lens *lens = turn->build.lens;
        set_thickness(turn, &lens->surfaces[lens->surface_count - 1], &from->surfaces[index - 1]);
    }
}

/* Where both are at a finite distance, object and image change places. */
static void turn_conjugates(struct turn *turn)
{
    const struct lens *from = turn->from;
    struct lens *lens = turn->build.lens;
    const struct surface *back = &from->surfaces[from->surface_count - 1];
    struct surface *last = &lens->surfaces[lens->surface_count - 1];
    double forward = turn->flips ? 1 : -1; /* where the light goes behind the last surface */
    bool real = back->has_thickness && back->thickness.variable == LENS_NONE &&
                forward * back->thickness.value.hi > 0;
    if (from->object_is_infinite || !real) {
        lens->object_is_infinite = true;
        lens->object = (struct figure){{INFINITY, 0}, text_of("inf"), LENS_NONE};
        lens->focus = FOCUS_PARAXIAL;
        last->has_thickness = false;
        last->thickness = (struct figure){.variable = LENS_NONE};
        return;
    }
    lens->object = flipped(turn, back->thickness, !turn->flips);
    last->has_thickness = true;
    last->thickness = flipped(turn, from->object, !turn->flips);
    lens->field_kind = from->field_kind == FIELD_HEIGHT  ? FIELD_IMAGE
                       : from->field_kind == FIELD_IMAGE ? FIELD_HEIGHT
                                                         : from->field_kind;
}

/* The diameter that the stop has with the lens's aperture. */
static bool turn_aperture(struct turn *turn, struct error *error)
{
    const struct lens *from = turn->from;
    struct lens *lens = turn->build.lens;
    struct first_order first;
    const struct aperture_setting aperture = lens_aperture(from);
    const struct conjugate_object object = lens_object(from);
    if (from->aperture_kind <= APERTURE_STOP) {
        return true;
    }
    if (from->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN,
                    "--reverse: the aperture is not that of a stop, and the lens has none: seen "
                    "from behind it is another one");
    }
    if (from->position_count > 0) {
        return fail(error, ERROR_DOMAIN,
                    "--reverse: the aperture is not that of the stop and may change between the "
                    "positions: choose one with --position");
    }
    if (!first_order_of_lens(from, lens_primary_wavelength(from), SECTION_Y, turn->arena, &first,
                             error) ||
        !first_order_aperture(&first, &object, &aperture, FIELD_NONE, NAN, error)) {
        return false;
    }
    if (!(fabs(first.stop_radius) > 0 && fabs(first.stop_radius) < 1e50)) {
        return fail(error, ERROR_DOMAIN, "--reverse: the aperture fixes no diameter of the stop");
    }
    struct surface *stop = &lens->surfaces[lens->stop];
    stop->has_diameter = true;
    stop->diameter = figure_rounded(pair_of(2 * fabs(first.stop_radius)),
                                    lens_unit_scale(lens->unit), turn->arena);
    lens->aperture_kind = APERTURE_STOP;
    lens->aperture = (struct figure){.typed = text_of("stop"), .variable = LENS_NONE};
    return true;
}

static bool surface_distorts(const struct surface *surface)
{
    bool distorts = false;
    for (int i = 0; i < 3 && surface->kind == SURFACE_THICK; i++) {
        distorts = distorts || fabs(surface->distortion[i].value.hi) > 0;
    }
    return distorts;
}

static bool check(const struct turn *turn, struct error *error)
{
    const struct lens *from = turn->from;
    if (from->objects != NULL || from->apertures != NULL) {
        return fail(error, ERROR_DOMAIN,
                    "--reverse: object or aperture change between the positions: choose one with "
                    "--position");
    }
    for (size_t i = 0; i < from->surface_count; i++) {
        if (!turn->flips && from->surfaces[i].thickness.variable != LENS_NONE) {
            return fail(error, ERROR_DOMAIN,
                        "--reverse: distances beside an odd number of mirrors change between the "
                        "positions: choose one with --position");
        }
        if (surface_distorts(&from->surfaces[i])) {
            return fail(error, ERROR_DOMAIN,
                        "--reverse: surface %zu is a thick lens with distortion, which has no "
                        "reverse",
                        i + 1);
        }
    }
    return true;
}

const struct lens *lens_reversed(const struct lens *lens, struct arena *arena, struct error *error)
{
    struct turn turn = {.from = lens, .arena = arena, .flips = true};
    struct lens *to = ARENA_NEW(arena, struct lens);
    for (size_t i = 0; i < lens->surface_count; i++) {
        turn.flips = turn.flips != (lens->surfaces[i].kind == SURFACE_REFLECT);
    }
    if (!check(&turn, error)) {
        return NULL;
    }
    lens_build_begin(&turn.build, to, arena);
    *to = *lens;
    to->surfaces = NULL;
    to->surface_count = 0;
    to->object_medium = lens->surfaces[lens->surface_count - 1].medium;
    to->stated[STATED_BFL] = NULL;
    to->stated_count[STATED_BFL] = 0;
    for (size_t i = lens->surface_count; i-- > 0;) {
        add_surface(&turn, i);
    }
    turn_conjugates(&turn);
    return turn_aperture(&turn, error) ? to : NULL;
}
