/* exchange/sequence_move.c - shifted and turned surfaces of CODE V and OSLO files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/sequence.h"

bool sequence_is_decentred(const struct sequence_surface *surface)
{
    bool some = sequence_is_some(&surface->shift[0]) || sequence_is_some(&surface->shift[1]);
    for (int i = 0; i < 3; i++) {
        some = some || sequence_is_some(&surface->turn[i]);
    }
    return some;
}

/* Turned about z, y and x, then shifted: the order tells. */
static bool is_turned_first(const struct sequence_surface *surface)
{
    int moves = 0;
    for (int i = 0; i < 3; i++) {
        moves += sequence_is_some(&surface->turn[i]) + sequence_is_some(&surface->shift[i]);
    }
    return surface->turns_first && moves > 1;
}

/* Shift and turns. */
static const struct displacement *displacement_of(const struct sequence *sequence,
                                                  const struct sequence_surface *from,
                                                  bool turn_only)
{
    struct displacement *all = ARENA_NEW(sequence->job->arena, struct displacement);
    for (int i = 0; i < 2; i++) {
        all->decenter[i] = turn_only ? sequence_nothing : from->shift[i];
    }
    for (int i = 0; i < 3; i++) {
        all->tilt[i] = from->turn[i];
    }
    return all;
}

void sequence_spread_z(const struct sequence *sequence)
{
    for (size_t i = 1; i < sequence->count; i++) {
        struct sequence_surface *surface = &sequence->surfaces[i];
        struct pair z = surface->shift[2].value;
        if (is_turned_first(surface)) {
            continue; /* along the turned axis */
        }
        if (surface->move != SEQUENCE_RETURN) {
            surface[-1].extra = pair_add(surface[-1].extra, z);
        }
        if (surface->move == SEQUENCE_BACK || surface->move == SEQUENCE_RETURN) {
            surface->extra = pair_subtract(surface->extra, z);
        }
    }
}

void sequence_check_move(const struct sequence *sequence, const struct sequence_surface *from)
{
    const struct commands *commands = sequence->commands;
    const struct command_word *at = &from->decentred_at;
    int turns = sequence_is_some(&from->turn[0]) + sequence_is_some(&from->turn[1]);
    bool about_z = sequence_is_some(&from->turn[2]);
    if (is_turned_first(from)) {
        if (from->move == SEQUENCE_BEND || from->move == SEQUENCE_RETURN) {
            commands_loss(commands, at, LOSS_OF_RAYS, "without the bend or return",
                          "a bend or return of a surface that is turned before it is shifted");
        }
    } else if (from->move == SEQUENCE_BEND && (turns > 1 || about_z)) {
        commands_loss(commands, at, LOSS_OF_RAYS, "only the first is kept",
                      "a bend with turns about more than one axis");
    } else if (from->move == SEQUENCE_RETURN && turns + about_z > 1) {
        commands_loss(commands, at, LOSS_OF_RAYS, "they are undone in another order",
                      "a return with turns about more than one axis");
    } else if (from->move == SEQUENCE_BACK && about_z && from->curved != CURVED_BOTH) {
        commands_loss(commands, at, LOSS_OF_RAYS, "left unturned", "a cylinder turned about z");
    }
}

/* A plane behind a surface; the surface's distance is to be the plane's. */
static struct surface *add_plane_behind(const struct sequence *sequence,
                                        struct sequence_surface *from, struct surface *surface,
                                        const struct displacement *moved)
{
    const struct medium medium = surface->medium;
    surface->thickness = figure_of(0, sequence->job->arena);
    surface = lens_build_surface(sequence->build);
    surface->medium = medium;
    surface->coordinate_break = moved;
    from->planes_behind++;
    return surface;
}

/* Turned back, then shifted back; null: by nothing. */
static const struct displacement *
displacement_undone(const struct sequence *sequence, const struct sequence_surface *from, bool turn)
{
    struct displacement *all = ARENA_NEW(sequence->job->arena, struct displacement);
    bool some = false;
    for (int i = 0; i < 3; i++) {
        all->tilt[i] = sequence_nothing;
        all->decenter[i % 2] = sequence_nothing;
    }
    for (int i = 0; i < (turn ? 3 : 2); i++) {
        const struct figure *one = turn ? &from->turn[i] : &from->shift[i];
        struct figure *back = turn ? &all->tilt[i] : &all->decenter[i];
        if (sequence_is_some(one)) {
            some = true;
            *back = figure_negate(*one, sequence->job->arena);
        }
    }
    return some ? all : NULL;
}

/* One turn, or a shift; `undo` is the other way. */
static const struct displacement *displacement_step(const struct sequence *sequence,
                                                    const struct sequence_surface *from, int axis,
                                                    bool undo)
{
    struct arena *arena = sequence->job->arena;
    struct displacement *step = ARENA_NEW(arena, struct displacement);
    *step = displacement_none;
    for (int i = 0; i < 2 && axis < 0; i++) {
        const struct figure one =
            from->shift[i].typed.start != NULL ? from->shift[i] : figure_zero();
        step->decenter[i] = undo ? figure_negate(one, arena) : one;
    }
    if (axis >= 0 && from->turn[axis].typed.start != NULL) {
        step->tilt[axis] = undo ? figure_negate(from->turn[axis], arena) : from->turn[axis];
    }
    return step;
}

/* Is the turn about an axis, or (-1) the shift across it, one that takes a plane? */
static bool takes_plane(const struct sequence *sequence, const struct sequence_surface *from,
                        int axis)
{
    bool some = false;
    for (int i = 0; i < 2 && axis < 0; i++) {
        some = some || sequence_is_some(&from->shift[i]);
    }
    return sequence->has_positions || some || (axis >= 0 && sequence_is_some(&from->turn[axis]));
}

void sequence_turn_first(const struct sequence *sequence, const struct sequence_surface *from)
{
    struct lens *lens = sequence->build->lens;
    if (!is_turned_first(from)) {
        return;
    }
    struct surface *plane = NULL;
    for (int axis = 2; axis >= 0; axis--) {
        if (takes_plane(sequence, from, axis)) {
            const size_t count = lens->surface_count;
            const struct medium medium =
                count > 0 ? lens->surfaces[count - 1].medium : lens->object_medium;
            plane = lens_build_surface(sequence->build);
            plane->medium = medium;
            plane->coordinate_break = displacement_step(sequence, from, axis, false);
        }
    }
    if (plane != NULL && sequence_is_some(&from->shift[2])) {
        plane->thickness = from->shift[2];
    }
}

/* The shift, and where the axis goes on unbent all of it undone behind the surface. */
static struct surface *shift_turned(const struct sequence *sequence, struct sequence_surface *from,
                                    struct surface *surface)
{
    struct lens *lens = sequence->build->lens;
    if (takes_plane(sequence, from, -1)) {
        surface->coordinate_break = displacement_step(sequence, from, -1, false);
    }
    if (from->move != SEQUENCE_BACK) {
        return surface;
    }
    surface =
        add_plane_behind(sequence, from, surface, displacement_step(sequence, from, -1, true));
    const size_t back = lens->surface_count - 1;
    for (int axis = 0; axis < 3; axis++) {
        if (takes_plane(sequence, from, axis)) {
            surface = add_plane_behind(sequence, from, surface,
                                       displacement_step(sequence, from, axis, true));
        }
    }
    lens->surfaces[back].thickness = figure_negate(
        sequence_is_some(&from->shift[2]) ? from->shift[2] : figure_zero(), sequence->job->arena);
    return surface;
}

struct surface *sequence_move_surface(const struct sequence *sequence,
                                      struct sequence_surface *from, struct surface *surface)
{
    if (is_turned_first(from)) {
        return shift_turned(sequence, from, surface);
    }
    if (from->move == SEQUENCE_RETURN) {
        for (int i = 0; i < 2; i++) {
            const struct displacement *moved = displacement_undone(sequence, from, i == 0);
            if (moved != NULL || sequence->has_positions) {
                surface = add_plane_behind(sequence, from, surface, moved);
            }
        }
        return surface;
    }
    if (sequence_is_decentred(from) && from->move == SEQUENCE_BACK) {
        surface->decentre = displacement_of(sequence, from, false);
    } else if (sequence_is_decentred(from)) {
        surface->coordinate_break = displacement_of(sequence, from, false);
    }
    bool bends =
        from->move == SEQUENCE_BEND && (sequence_is_decentred(from) || sequence->has_positions);
    const struct displacement *again =
        bends && sequence_is_decentred(from) ? displacement_of(sequence, from, true) : NULL;
    return bends ? add_plane_behind(sequence, from, surface, again) : surface;
}
