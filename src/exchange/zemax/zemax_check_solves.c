/* exchange/zemax/zemax_check_solves.c - solves of a .zmx file against the numbers beside them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/solve_doubt.h"
#include "exchange/zemax/zemax_solve.h"

#include <math.h>

/* The number of a surface that a solve gives, and the one that the file has. */
struct solved_number {
    struct solver_state *solving;
    size_t at;
    bool is_curvature;
    bool is_focus; /* the last distance, where the solve only says where the image is */
    struct figure is, was;
};

static bool zemax_check_solves_answer(const void *context, const struct lens *lens,
                                      struct arena *arena, double *value)
{
    const struct solved_number *number = context;
    struct pair found;
    if (!zemax_solve_in(number->solving, number->at, number->is_curvature, lens, arena, &found)) {
        return false;
    }
    *value = found.hi;
    return true;
}

/* How far the two may be apart: of a pick-up or a sum by the digits of what it follows. */
static double zemax_check_solves_doubt_of(const struct solved_number *number)
{
    const double digits = 10, coarsest = 5e-4; /* of less than three digits none is rounded */
    struct solver_state *solving = number->solving;
    struct arena *arena = solving->file->job->arena;
    const size_t place = number->is_curvature
                             ? solving->places[number->at]
                             : zemax_gap_place(solving->file, solving->places, number->at);
    const double size = fabs(number->was.value.hi);
    const double rounding = fmin(figure_rounding(&number->was), coarsest * size);
    double value;
    return zemax_check_solves_answer(number, &solving->lens, arena, &value)
               ? solve_doubt(&solving->lens, place, rounding / size, zemax_check_solves_answer,
                             number, arena)
               : digits * rounding;
}

/* The file's number stays that of the lens. */
static bool keep_number(const struct solved_number *number, struct error *error)
{
    struct solver_state *solving = number->solving;
    struct zemax_file *file = solving->file;
    struct zemax_surface *from = &file->surfaces[number->at];
    const struct zemax_line *line = number->is_curvature ? from->curvature : from->solve;
    if (number->is_curvature) {
        solving->curvature[number->at].typed.start = NULL;
        from->has_free_curvature = true;
    } else {
        solving->thickness[number->at] = number->was;
        from->solve = NULL;
    }
    file->doubts->contradicted++;
    return zemax_loss(
        file, line, error,
        "a solve contradicts the lens that is read: the %s of surface %zu is %.*s "
        "by it, and %.*s in the file" LOSS_OF_POWER LOSS_INSTEAD "the file's number is kept",
        number->is_curvature ? "curvature" : "thickness", number->at, text_shown(number->is.typed),
        number->is.typed.start, text_shown(number->was.typed), number->was.typed.start);
}

static bool zemax_check_solves_check_number(const struct solved_number *number, struct error *error)
{
    /* doubles lose digits on the way to a solve */
    const double relative = 1e-9, least = number->is_curvature ? 1e-15 : 1e-12;
    struct zemax_file *file = number->solving->file;
    const struct figure *is = &number->is, *was = &number->was;
    const double apart = fabs(pair_subtract(is->value, was->value).hi);
    const double alike = relative * fabs(is->value.hi) + figure_rounding(was) + least;
    bool is_stored =
        was->value.hi != 0 && (file->configurations < 2 || file->configuration == file->shown);
    if (apart <= alike || (number->is_focus && file->has_other_distance)) {
        return true;
    }
    if (is_stored && !(apart <= alike + zemax_check_solves_doubt_of(number))) {
        return keep_number(number, error);
    }
    if (!number->is_focus) {
        zemax_remark(file, "the %s of surface %zu is %.*s by its solve, the file had %.*s",
                     number->is_curvature ? "curvature" : "thickness", number->at,
                     text_shown(is->typed), is->typed.start, text_shown(was->typed),
                     was->typed.start);
    }
    return true;
}

/* What the solve of a surface's curvature or thickness has to say, if it has one. */
static bool check_solve(struct solver_state *solving, size_t at, bool is_curvature,
                        struct error *error)
{
    struct zemax_file *file = solving->file;
    struct arena *arena = file->job->arena;
    const struct zemax_surface *from = &file->surfaces[at];
    struct solved_number number = {.solving = solving, .at = at, .is_curvature = is_curvature};
    if (is_curvature) {
        number.is = solving->curvature[at];
        if (number.is.typed.start == NULL) {
            return true;
        }
        number.was = figure_per_length(from->curvature->numbers[0], file->build.lens->unit, -1);
        return zemax_check_solves_check_number(&number, error);
    }
    if (from->solve == NULL || from->thickness == NULL || from->thickness->count == 0) {
        return true;
    }
    number.is = solving->thickness[at];
    number.was = from->thickness->numbers[0];
    number.is_focus = at + 2 == file->surface_count && zemax_focuses(file);
    if (number.is_focus) {
        struct pair value;
        if (solving->places[at] == LENS_NONE ||
            !zemax_solve_in(solving, at, false, &solving->lens, arena, &value)) {
            return true;
        }
        number.is = figure_rounded(value, solving->unit, arena);
    }
    return zemax_check_solves_check_number(&number, error);
}

bool zemax_check_solves(struct solver_state *solving, struct error *error)
{
    for (size_t i = 1; i + 1 < solving->file->surface_count; i++) {
        if (!check_solve(solving, i, true, error) || !check_solve(solving, i, false, error)) {
            return false;
        }
    }
    return true;
}
