/* file/lens_reverse.c - a lens turned around. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "file/lens_build.h"
#include "file/lens_change.h"
#include "file/lens_unit.h"
#include "optics/aperture.h"
#include "optics/element.h"
#include "optics/first_order.h"
#include "optics/tolerance.h"

#include <math.h>
#include <string.h>

/* Of what a number is: the surface, the gap behind it, or the medium in the gap. */
enum owner { OWNED_BY_SURFACE, OWNED_BY_GAP, OWNED_BY_MEDIUM, OWNERS };

static enum owner owner_of(enum parameter_kind kind)
{
    if (kind == PARAMETER_THICKNESS) {
        return OWNED_BY_GAP;
    }
    if ((parameter_type(kind)->is & PARAMETER_IS_BEHIND) != 0) {
        return OWNED_BY_MEDIUM;
    }
    return OWNED_BY_SURFACE;
}

/* A lens being turned around. */
struct turn {
    const struct lens *from;
    struct lens_build build;
    struct arena *arena;
    size_t *places[OWNERS]; /* where each surface, gap, medium lies now, by enum owner */
    bool flips;             /* an even number of mirrors: z and x change their signs */
};

/* Has the number the other sign in the lens turned around? */
static bool lens_reverse_turns(const struct turn *turn, enum parameter_kind kind)
{
    return parameter_type(kind)->turn == (turn->flips ? TURN_WITH_AXES : TURN_WITH_MIRRORS);
}

static struct figure lens_reverse_turned(const struct turn *turn, enum parameter_kind kind,
                                         struct figure figure)
{
    return lens_reverse_turns(turn, kind) ? figure_negate(figure, turn->arena) : figure;
}

/* Undone, and then turned. */
static struct figure lens_reverse_undone(const struct turn *turn, enum parameter_kind kind,
                                         struct figure figure)
{
    return lens_reverse_turns(turn, kind) ? figure : figure_negate(figure, turn->arena);
}

/* The plane behind a surface on which one part of a coordinate break is undone. */
static struct displacement *add_turned_plane(struct turn *turn)
{
    const struct lens *lens = turn->build.lens;
    const struct medium medium = lens->surfaces[lens->surface_count - 1].medium;
    struct displacement *coordinate_break = ARENA_NEW(turn->arena, struct displacement);
    struct surface *plane = lens_build_surface(&turn->build);
    for (int i = 0; i < 3; i++) {
        coordinate_break->tilt[i] = coordinate_break->decenter[i % 2] = figure_zero();
    }
    plane->medium = medium;
    plane->coordinate_break = coordinate_break;
    return coordinate_break;
}

/* Undo a coordinate break: z, y, x, shift. */
static void add_breaks(struct turn *turn, const struct displacement *coordinate_break)
{
    for (int i = 2; i >= 0; i--) {
        if (coordinate_break->tilt[i].value.hi != 0) {
            add_turned_plane(turn)->tilt[i] = lens_reverse_undone(
                turn, (enum parameter_kind)(PARAMETER_BREAK_TILT_X + i), coordinate_break->tilt[i]);
        }
    }
    if (coordinate_break->decenter[0].value.hi != 0 ||
        coordinate_break->decenter[1].value.hi != 0) {
        struct displacement *shift = add_turned_plane(turn);
        shift->decenter[0] =
            lens_reverse_undone(turn, PARAMETER_BREAK_DECENTER_X, coordinate_break->decenter[0]);
        shift->decenter[1] =
            lens_reverse_undone(turn, PARAMETER_BREAK_DECENTER_Y, coordinate_break->decenter[1]);
    }
}

/* Marks of one owner, from a surface as it was to where the owner lies now. */
static void add_own_marks(const struct turn *turn, struct surface *to, const struct surface *from,
                          enum owner owner)
{
    struct vary *all = ARENA_COPY(turn->arena, to->varies, to->vary_count, from->vary_count + 1);
    to->varies = all;
    for (size_t i = 0; i < from->vary_count; i++) {
        if (owner_of(from->varies[i].kind) == owner) {
            all[to->vary_count] = from->varies[i];
            struct vary *vary = &all[to->vary_count++];
            if (vary->has_bounds && lens_reverse_turns(turn, vary->kind)) {
                struct figure low = vary->low;
                vary->low = figure_negate(vary->high, turn->arena);
                vary->high = figure_negate(low, turn->arena);
            }
        }
    }
}

/* One more of these marks, in words. */
static const char *join_marks(const char *all, const struct surface *surface, size_t number,
                              enum owner owner, struct arena *arena)
{
    for (size_t i = 0; i < surface->vary_count; i++) {
        const struct vary *vary = &surface->varies[i];
        if (owner_of(vary->kind) == owner) {
            all = arena_printf(arena, "%s%s%s~ of surface %zu", all != NULL ? all : "",
                               all != NULL ? ", " : "",
                               parameter_mark_name(vary->kind, vary->order, arena), number);
        }
    }
    return all;
}

/* What lies behind the whole lens comes before it, and a coordinate break becomes planes. */
static bool keeps_place(const struct lens *lens, struct parameter one)
{
    size_t last = lens->surface_count - 1;
    enum owner owner = owner_of(one.kind);
    if (owner == OWNED_BY_SURFACE) {
        return one.kind < PARAMETER_BREAK_DECENTER_X;
    }
    while (owner == OWNED_BY_MEDIUM && last > 0 && surface_reflects(&lens->surfaces[last])) {
        last--;
    }
    return one.surface != last;
}

static bool pickup_has_place(const struct lens *lens, const struct lens_pickup *pickup)
{
    return keeps_place(lens, pickup->what) && keeps_place(lens, pickup->from);
}

/* -------- tolerances -------- */

static enum owner owner_of_tolerance(enum tolerance_kind kind)
{
    const enum parameter_kind parameter = tolerance_type(kind)->parameter;
    if (kind == TOLERANCE_AIR) {
        return OWNED_BY_GAP;
    }
    if (parameter == PARAMETER_KINDS) {
        return OWNED_BY_SURFACE;
    }
    return owner_of(parameter);
}

/* Has the tolerance of this surface a place in the lens turned around? */
static bool tolerance_has_place(const struct lens *lens, enum tolerance_kind kind, size_t surface)
{
    static const enum parameter_kind of_owner[OWNERS] = {
        [OWNED_BY_SURFACE] = PARAMETER_RADIUS,
        [OWNED_BY_GAP] = PARAMETER_THICKNESS,
        [OWNED_BY_MEDIUM] = PARAMETER_INDEX,
    };
    const struct parameter one = {surface, of_owner[owner_of_tolerance(kind)], 0};
    return keeps_place(lens, one);
}

/* What is of one end of an element by itself is of the other end now, and must be named. */
static size_t turn_pivot(const struct turn *turn, const struct lens_tolerance *from,
                         const struct lens_tolerance *to)
{
    const bool is_wedge = from->kind == TOLERANCE_WEDGE;
    const bool has_end = is_wedge || from->kind == TOLERANCE_ELEMENT_ROLL;
    size_t pivot = from->pivot;
    if (pivot == LENS_NONE && has_end) {
        pivot = is_wedge ? from->last : from->first;
    }
    pivot = pivot == LENS_NONE ? LENS_NONE : turn->places[OWNED_BY_SURFACE][pivot];
    const size_t unnamed = is_wedge ? to->last : to->first;
    return has_end && pivot == unnamed ? LENS_NONE : pivot;
}

/* Those of the lens turned around, in the making. */
struct turned_tolerances {
    struct lens_tolerance *list;
    size_t count, room;
};

/* One of surfaces that are others now; those that have no place are left out. */
static void turn_tolerance(const struct turn *turn, struct turned_tolerances *all,
                           const struct lens_tolerance *from)
{
    const enum owner owner = owner_of_tolerance(from->kind);
    struct lens_tolerance to = *from;
    to.first = LENS_NONE;
    to.last = 0;
    for (size_t i = from->first; i <= from->last; i++) {
        const bool follows = owner == OWNED_BY_MEDIUM && surface_reflects(&turn->from->surfaces[i]);
        const size_t place = turn->places[owner][i];
        if (!follows && tolerance_has_place(turn->from, from->kind, i)) {
            to.first = place < to.first ? place : to.first;
            to.last = place > to.last ? place : to.last;
        }
    }
    if (to.first != LENS_NONE) {
        to.pivot = turn_pivot(turn, from, &to);
        *ARENA_ADD(turn->arena, all->list, all->count, all->room) = to;
    }
}

/* Of each element among the surfaces by itself, as each has its own end. */
static void turn_elements(const struct turn *turn, struct turned_tolerances *all,
                          const struct lens_tolerance *from)
{
    struct element *elements;
    const size_t count = elements_of(turn->from, turn->arena, &elements);
    for (size_t e = 0; e < count; e++) {
        if (elements[e].first >= from->first && elements[e].last <= from->last) {
            struct lens_tolerance one = *from;
            one.is_range = false;
            one.first = elements[e].first;
            one.last = elements[e].last;
            turn_tolerance(turn, all, &one);
        }
    }
}

static void turn_tolerances(const struct turn *turn)
{
    struct turned_tolerances all = {0};
    for (size_t i = 0; i < turn->from->tolerance_count; i++) {
        const struct lens_tolerance *one = &turn->from->tolerances[i];
        if (one->kind == TOLERANCE_FOCUS) {
            *ARENA_ADD(turn->arena, all.list, all.count, all.room) = *one;
        } else if (one->is_range &&
                   (one->kind == TOLERANCE_WEDGE || one->kind == TOLERANCE_ELEMENT_ROLL)) {
            turn_elements(turn, &all, one);
        } else {
            turn_tolerance(turn, &all, one);
        }
    }
    turn->build.lens->tolerances = all.list;
    turn->build.lens->tolerance_count = all.count;
}

const char *lens_marks_left_out(const struct lens *lens, struct arena *arena)
{
    size_t last = lens->surface_count - 1, medium = last;
    const char *all = join_marks(NULL, &lens->surfaces[last], last + 1, OWNED_BY_GAP, arena);
    while (medium > 0 && surface_reflects(&lens->surfaces[medium])) {
        medium--;
    }
    all = join_marks(all, &lens->surfaces[medium], medium + 1, OWNED_BY_MEDIUM, arena);
    for (size_t i = 0; i < lens->pickup_count; i++) {
        if (!pickup_has_place(lens, &lens->pickups[i])) {
            all = arena_printf(arena, "%s%sthe pick-up of %s", all != NULL ? all : "",
                               all != NULL ? ", " : "",
                               parameter_mark_write(lens->pickups[i].what, arena));
        }
    }
    /* Those of the gap or the glass behind the lens, in words behind `all`. */
    for (size_t i = 0; i < lens->tolerance_count; i++) {
        struct lens_tolerance one = lens->tolerances[i];
        for (size_t k = one.first; k <= one.last && one.kind != TOLERANCE_FOCUS; k++) {
            struct lens_tolerance missing = one;
            missing.first = missing.last = k;
            if (!tolerance_has_place(lens, one.kind, k)) {
                all = arena_printf(arena, "%s%sthe tolerance of %s", all != NULL ? all : "",
                                   all != NULL ? ", " : "", tolerance_name(&missing, arena));
            }
        }
    }
    return all;
}

/* A factor changes its sign where only one of the two numbers does. */
static void turn_pickups(const struct turn *turn)
{
    const struct lens *from = turn->from;
    struct lens *lens = turn->build.lens;
    lens->pickups = ARENA_ARRAY(turn->arena, from->pickup_count, struct lens_pickup);
    lens->pickup_count = 0;
    for (size_t i = 0; i < from->pickup_count; i++) {
        struct lens_pickup one = from->pickups[i];
        if (!pickup_has_place(from, &one)) {
            continue;
        }
        if (lens_reverse_turns(turn, one.what.kind) != lens_reverse_turns(turn, one.from.kind)) {
            one.factor = figure_negate(one.factor, turn->arena);
        }
        one.offset = lens_reverse_turned(turn, one.what.kind, one.offset);
        one.what.surface = turn->places[owner_of(one.what.kind)][one.what.surface];
        one.from.surface = turn->places[owner_of(one.from.kind)][one.from.surface];
        lens->pickups[lens->pickup_count++] = one;
    }
}

/*
 * Half a turn about y: x changes its sign, and angles theirs. An odd number of arms then points the
 * other way.
 */
static const struct aperture *turn_apertures(const struct turn *turn, const struct surface *surface)
{
    struct arena *arena = turn->arena;
    struct aperture *copy = ARENA_COPY(arena, surface->apertures, surface->aperture_count, 0);
    for (size_t i = 0; i < surface->aperture_count; i++) {
        struct figure(*points)[2] = ARENA_COPY(arena, copy[i].points, copy[i].point_count, 0);
        copy[i].decenter[0] = figure_negate(copy[i].decenter[0], arena);
        copy[i].turn = figure_negate(copy[i].turn, arena);
        for (size_t k = 0; k < copy[i].point_count; k++) {
            points[k][0] = figure_negate(points[k][0], arena);
        }
        copy[i].points = (const struct figure(*)[2])points;
        if (copy[i].arms % 2 != 0) {
            struct pair degrees = pair_divide(copy[i].turn.value, pair_of(RADIANS_PER_DEGREE));
            copy[i].turn = figure_rounded(pair_add(pair_of(180), degrees), NUMBER_UNSCALED, arena);
            copy[i].turn.value = pair_multiply(copy[i].turn.value, pair_of(RADIANS_PER_DEGREE));
        }
    }
    return copy;
}

static void add_turned_surface(struct turn *turn, size_t index)
{
    const struct lens *from = turn->from;
    struct surface *to = lens_build_surface(&turn->build);
    turn->places[OWNED_BY_SURFACE][index] = turn->build.lens->surface_count - 1;
    *to = from->surfaces[index];
    to->medium = index > 0 ? from->surfaces[index - 1].medium : from->object_medium;
    to->coordinate_break = NULL;
    /* What lies on the surface itself. */
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        const struct figure *figure = parameter_figure(to, each.kind, each.order);
        bool is_behind = (parameter_type(each.kind)->is & PARAMETER_IS_BEHIND) != 0;
        if (figure != NULL && !is_behind && lens_reverse_turns(turn, each.kind)) {
            parameter_put(to, each.kind, each.order, figure_negate(*figure, turn->arena),
                          turn->arena);
        }
    }
    to->apertures = turn->flips ? turn_apertures(turn, to) : to->apertures;
    to->varies = NULL;
    to->vary_count = 0;
    add_own_marks(turn, to, &from->surfaces[index], OWNED_BY_SURFACE);
    to->has_thickness = true;
    to->thickness = figure_zero();
    if (from->surfaces[index].is_stop) {
        turn->build.lens->stop = turn->build.lens->surface_count - 1;
    }
    if (from->surfaces[index].coordinate_break != NULL) {
        add_breaks(turn, from->surfaces[index].coordinate_break);
    }
    if (index > 0) {
        struct lens *lens = turn->build.lens;
        struct surface *last = &lens->surfaces[lens->surface_count - 1];
        const struct surface *surfaces = turn->from->surfaces;
        last->has_thickness = surfaces[index - 1].has_thickness;
        last->thickness =
            lens_reverse_turned(turn, PARAMETER_THICKNESS, surfaces[index - 1].thickness);
        /* Marks of the gap before a surface, and of its medium, which mirrors have from before. */
        size_t medium = index - 1;
        add_own_marks(turn, last, &surfaces[index - 1], OWNED_BY_GAP);
        while (medium > 0 && surface_reflects(&surfaces[medium])) {
            medium--;
        }
        turn->places[OWNED_BY_GAP][index - 1] = turn->build.lens->surface_count - 1;
        if (!surface_reflects(&surfaces[index])) {
            add_own_marks(turn, last, &surfaces[medium], OWNED_BY_MEDIUM);
            turn->places[OWNED_BY_MEDIUM][medium] = turn->build.lens->surface_count - 1;
        }
    }
}

/* x changes its sign. */
static struct lens_field *flip_fields(const struct turn *turn, const struct lens_field *fields,
                                      size_t count)
{
    struct lens_field *copy = ARENA_COPY(turn->arena, fields, count, 0);
    for (size_t i = 0; i < count; i++) {
        copy[i].at[0] = figure_negate(copy[i].at[0], turn->arena);
    }
    return copy;
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
    lens->object = lens_reverse_turned(turn, PARAMETER_THICKNESS, back->thickness);
    last->has_thickness = true;
    last->thickness = lens_reverse_turned(turn, PARAMETER_THICKNESS, from->object);
    /* the chief ray of a real image is that of the object where it goes, turned around */
    static const enum field_kind kinds[] = {[FIELD_NONE] = FIELD_NONE,
                                            [FIELD_ANGLE] = FIELD_ANGLE,
                                            [FIELD_HEIGHT] = FIELD_IMAGE,
                                            [FIELD_IMAGE] = FIELD_HEIGHT,
                                            [FIELD_REAL] = FIELD_HEIGHT};
    lens->field_kind = kinds[from->field_kind];
    if (lens->field_kind != FIELD_ANGLE && turn->flips) {
        struct lens_points *points =
            ARENA_ARRAY(turn->arena, lens->position_count, struct lens_points);
        lens->fields = flip_fields(turn, lens->fields, lens->field_count);
        for (size_t p = 0; p < lens->position_count && lens->points != NULL; p++) {
            const struct lens_points *one = &from->points[p];
            points[p] =
                (struct lens_points){flip_fields(turn, one->fields, one->count), one->count};
        }
        lens->points = lens->points != NULL ? points : NULL;
    }
}

/* The diameter that the stop has with the lens's aperture. */
static bool turn_aperture(struct turn *turn, struct error *error)
{
    const struct lens *from = turn->from;
    struct lens *lens = turn->build.lens;
    struct first_order first;
    const struct aperture_setting aperture = lens_aperture(from);
    const struct conjugate_object object = lens_object(from);
    if (from->stop_is_real && from->aperture_kind > APERTURE_STOP) {
        fail(error, ERROR_DOMAIN, "the stop has the size of a real ray, which is not traced here");
        return error_hint(error, "give the stop's diameter, and 'aperture stop'");
    }
    if (from->aperture_kind <= APERTURE_STOP) {
        return true;
    }
    if (from->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN,
                    "{reverse}: the aperture is not that of a stop, and the lens has none: seen "
                    "from behind it is another one");
    }
    if (from->position_count > 0) {
        return fail(error, ERROR_DOMAIN,
                    "{reverse}: the aperture is not that of the stop and may change between the "
                    "positions: choose one with {position}");
    }
    if (!first_order_of_lens(from, lens_primary_wavelength(from), SECTION_Y, turn->arena, &first,
                             error) ||
        !first_order_aperture(&first, &object, &aperture, FIELD_NONE, NAN, error)) {
        return false;
    }
    if (!(fabs(first.stop_radius) > 0 && fabs(first.stop_radius) < 1e50)) {
        return fail(error, ERROR_DOMAIN, "{reverse}: the aperture fixes no diameter of the stop");
    }
    struct surface *stop = &lens->surfaces[lens->stop];
    stop->has_diameter = true;
    stop->diameter = figure_rounded(pair_of(2 * fabs(first.stop_radius)),
                                    lens_unit_scale(lens->unit), turn->arena);
    lens->aperture_kind = APERTURE_STOP;
    lens->aperture = (struct figure){.typed = text_of("stop"), .variable = LENS_NONE};
    return true;
}

static bool check_turnable(const struct turn *turn, struct error *error)
{
    const struct lens *from = turn->from;
    if (from->objects != NULL || from->apertures != NULL) {
        return fail(error, ERROR_DOMAIN,
                    "{reverse}: object or aperture change between the positions: choose one with "
                    "{position}");
    }
    if (from->setting_count > 0 || from->stops != NULL) {
        return fail(error, ERROR_DOMAIN,
                    "{reverse}: the positions set what belongs to single surfaces: choose one with "
                    "{position}");
    }
    for (size_t i = 0; i < from->surface_count; i++) {
        const struct surface *surface = &from->surfaces[i];
        bool varies =
            surface->thickness.variable != LENS_NONE ||
            (surface_has(surface, SURFACE_HAS_FOCAL) && surface->hiatus.variable != LENS_NONE);
        if (!turn->flips && varies) {
            return fail(error, ERROR_DOMAIN,
                        "{reverse}: distances beside an odd number of mirrors change between the "
                        "positions: choose one with {position}");
        }
        bool distorts = false;
        for (int k = 0; k < 3 && surface_has(&from->surfaces[i], SURFACE_HAS_FOCAL); k++) {
            distorts = distorts || fabs(from->surfaces[i].distortion[k].value.hi) > 0;
        }
        if (distorts) {
            return fail(error, ERROR_DOMAIN,
                        "{reverse}: surface %zu is a thick lens with distortion, which has no "
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
        turn.flips = turn.flips != surface_reflects(&lens->surfaces[i]);
    }
    if (!check_turnable(&turn, error)) {
        return NULL;
    }
    for (int i = 0; i < OWNERS; i++) {
        turn.places[i] = ARENA_ARRAY(arena, lens->surface_count, size_t);
    }
    lens_build_begin(&turn.build, to, arena);
    *to = *lens;
    to->surfaces = NULL;
    to->surface_count = 0;
    to->object_medium = lens->surfaces[lens->surface_count - 1].medium;
    to->stated[STATED_BFL] = NULL;
    to->stated_count[STATED_BFL] = 0;
    for (size_t i = lens->surface_count; i-- > 0;) {
        add_turned_surface(&turn, i);
    }
    turn_pickups(&turn);
    turn_tolerances(&turn);
    to->goals = NULL;
    to->goal_count = 0;
    turn_conjugates(&turn);
    return turn_aperture(&turn, error) ? to : NULL;
}
