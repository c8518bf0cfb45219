/* exchange/sequence_solve.c - gaps and curvatures that follow from rays. */
/* SPDX-License-Identifier: MIT */
#include "exchange/sequence.h"

#include "file/lens_build.h"
#include "file/lens_words.h"

#include <math.h>

/* With an f-number the rays depend on what is solved: then it is solved again. */
enum { MOST_PASSES = 20 };
static const double same_enough = 4e-16;

/* One solve being applied. */
struct solve_application {
    const struct sequence *sequence;
    const struct sequence_surface *from;
    const struct sequence_solve *solve;
    size_t surface; /* of the lens */
    bool is_thickness;
};

static const char through_loss[] = "it follows rays through what is lost";

/* What the file has for it; typed.start is null where it has nothing. */
static const struct figure *stored_figure(const struct solve_application *solving)
{
    const struct sequence_surface *from = solving->from;
    return solving->is_thickness ? &from->thickness : &from->curve;
}

static bool has_stored_figure(const struct solve_application *solving)
{
    return stored_figure(solving)->typed.start != NULL;
}

/* The number of the file stands: of one position it is what the program solved, else a loss. */
static void keep_stored(const struct solve_application *solving, const char *why)
{
    const struct sequence *sequence = solving->sequence;
    const struct file_words place = commands_place(sequence->commands, &solving->solve->at);
    if (!sequence->has_positions && has_stored_figure(solving) && why != through_loss) {
        const char *note = arena_printf(sequence->job->arena,
                                        "line %ld: a solve: %s; the number in the file is kept",
                                        place.number, why);
        lens_build_note(sequence->build, text_of(note));
    } else {
        foreign_loss(sequence->job, &place, solving->solve->at.text, LOSS_OF_RAYS,
                     "the number in the file is kept", "a solve: %s", why);
    }
}

/* Result: why there is no number of the solve, or null: then it is the lens's. */
static const char *apply_solve(const struct solve_application *solving, bool *near)
{
    const struct sequence *sequence = solving->sequence;
    bool by_size = solving->solve->of_angle || solving->solve->target.value.hi != 0;
    struct arena *arena = sequence->job->arena;
    const struct lens *lens = sequence->build->lens;
    struct solve_state state;
    struct error why;
    if (sequence->job->lost_power != NULL && has_stored_figure(solving)) {
        return through_loss;
    }
    if (sequence->is_open && solving->solve->ray == SOLVE_MARGINAL && by_size) {
        return "it follows a ray whose height follows from the lens";
    }
    if (solving->solve->is_unknown) {
        return "it is not known";
    }
    const struct arena_mark mark = arena_mark(arena);
    bool has_ray = solve_follow(lens, solving->surface, solving->solve->ray, arena, &state, &why);
    arena_reset(arena, mark);
    if (!has_ray) {
        return arena_printf(arena, "%s", why.message);
    }
    const struct pair target = solving->solve->target.value;
    const struct pair value = solving->is_thickness
                                  ? pair_add(solve_thickness(&state, target), solving->from->extra)
                                  : solve_curvature(&state, target);
    if (!(fabs(value.hi) < 1e100)) {
        return "the ray runs parallel, or the surface does not bend it";
    }
    const struct figure figure = solving->is_thickness
                                     ? figure_computed(value, sequence->commands->scale, arena)
                                     : commands_curvature(sequence->commands, value);
    struct surface *surface = &lens->surfaces[solving->surface];
    const struct pair old =
        solving->is_thickness ? surface->thickness.value : surface_curvature(surface, SECTION_Y);
    if (solving->is_thickness) {
        surface->thickness = figure;
    } else {
        surface->is_plane = true;
        surface->radius = sequence_nothing;
        surface->has_curvature = figure.value.hi != 0;
        surface->curvature = figure;
    }
    *near = fabs(pair_subtract(old, figure.value).hi) <= same_enough * (fabs(old.hi) + 1);
    return NULL;
}

/* Result: whether nothing moved any more. */
static bool sequence_solve_pass(const struct sequence *sequence, const size_t *indices)
{
    bool settled = true;
    for (size_t i = 1; i + 1 < sequence->count; i++) {
        struct sequence_surface *from = &sequence->surfaces[i];
        struct sequence_solve *solves[] = {&from->curvature_solve, &from->thickness_solve};
        for (int j = 0; j < 2; j++) {
            /* behind a bend the thickness is that of the plane that turns the axis */
            struct solve_application solving = {
                sequence, from, solves[j], indices[i] + (j == 1 ? from->planes_behind : 0), j == 1};
            bool near = true;
            const char *why = solves[j]->is_set ? apply_solve(&solving, &near) : NULL;
            if (why != NULL) {
                keep_stored(&solving, why);
                solves[j]->is_set = false;
            }
            settled = settled && near;
        }
    }
    return settled;
}

/* A note where a solve gives another number than the file has, beyond its rounding. */
static void remark_solve(const struct solve_application *solving, size_t number)
{
    const struct sequence *sequence = solving->sequence;
    const struct surface *surface = &sequence->build->lens->surfaces[solving->surface];
    const struct figure *was = stored_figure(solving), *is = &surface->thickness;
    struct pair value = is->value, old = pair_add(was->value, solving->from->extra);
    if (!solving->is_thickness) {
        is = &surface->curvature;
        value = surface_curvature(surface, SECTION_Y);
        old = was->value;
        if (solving->from->is_radius && old.hi != 0) {
            old = pair_divide(pair_of(1), old);
        }
    }
    double rounding = figure_rounding(was);
    if (!solving->is_thickness && solving->from->is_radius) {
        rounding *= old.hi * old.hi;
    }
    if (fabs(pair_subtract(value, old).hi) > 1e-9 * fabs(value.hi) + rounding) {
        const char *note = arena_printf(
            sequence->job->arena, "the %s of surface %zu is %.*s by its solve, the file had %s%.*s",
            solving->is_thickness ? "thickness" : "curvature", number, text_shown(is->typed),
            is->typed.start,
            solving->is_thickness || !solving->from->is_radius ? "" : "the radius ",
            text_shown(was->typed), was->typed.start);
        lens_build_note(sequence->build, text_of(note));
    }
}

bool sequence_solve_all(const struct sequence *sequence, const size_t *indices)
{
    bool settled = false;
    for (int i = 0; i < MOST_PASSES && !settled; i++) {
        settled = sequence_solve_pass(sequence, indices);
    }
    if (settled) {
        for (size_t k = 1; k + 1 < sequence->count; k++) {
            const struct sequence_surface *from = &sequence->surfaces[k];
            const struct solve_application curve = {sequence, from, &from->curvature_solve,
                                                    indices[k], false};
            const struct solve_application gap = {sequence, from, &from->thickness_solve,
                                                  indices[k] + from->planes_behind, true};
            bool is_image =
                k + 2 == sequence->count && sequence->build->lens->focus == FOCUS_PARAXIAL;
            if (curve.solve->is_set && has_stored_figure(&curve)) {
                remark_solve(&curve, k);
            }
            if (gap.solve->is_set && has_stored_figure(&gap) && !is_image) {
                remark_solve(&gap, k);
            }
        }
    }
    return settled ||
           fail(sequence->commands->error, ERROR_DATA, "%s: the solves of the file do not settle",
                sequence->commands->job->source);
}
