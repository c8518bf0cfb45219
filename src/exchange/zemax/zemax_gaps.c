/* exchange/zemax/zemax_gaps.c - gaps and curvatures solved, against the numbers beside them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

/* The number of a surface that a solve gives, and the one that the file has. */
struct solved_number {
    struct solver_state *solving;
    size_t at;
    bool is_curvature;
    bool is_focus; /* the last distance, where the solve only says where the image is */
    struct figure is, was;
};

/* Differences over this step, relative or of an index, are derivatives to many digits. */
static const double step = 1e-7;

/* A lens whose numbers vary one after the other, and what the solve gives in it as it is. */
struct varied_lens {
    struct lens lens;
    const struct solved_number *number;
    struct arena *arena;
    double value;
};

/* What the solve gives in a lens, mm or 1/mm; false: nothing. */
static bool solved_value(const struct solved_number *number, const struct lens *lens,
                         struct arena *arena, double *value)
{
    struct pair found;
    if (!zemax_solve_in(number->solving, number->at, number->is_curvature, lens, arena, &found)) {
        return false;
    }
    *value = found.hi;
    return true;
}

/* |da| over the step, of a number that has just been changed. */
static double slope_now(const struct varied_lens *varied)
{
    double value;
    return solved_value(varied->number, &varied->lens, varied->arena, &value)
               ? fabs(value - varied->value) / step
               : 0;
}

/* The same of a figure, relative; it is put back. */
static double slope_of_figure(const struct varied_lens *varied, struct figure *figure)
{
    const struct pair was = figure->value;
    if (was.hi == 0) {
        return 0;
    }
    figure->value = pair_multiply(was, pair_of(1 + step));
    const double slope = slope_now(varied);
    figure->value = was;
    return slope;
}

/* How well the index of a medium is known. */
static double index_doubt(const struct medium *medium, struct pair index)
{
    const double editions = 1e-5, model = 0.1;
    switch (medium->kind) {
    case MEDIUM_GLASS:
    case MEDIUM_TABLE:
        return editions;
    case MEDIUM_MODEL:
        return model * fabs(pair_subtract(index, medium->index).hi);
    default:
        return 0;
    }
}

/* What the index behind a surface may change. */
static double doubt_of_index(const struct varied_lens *varied, struct surface *surface)
{
    const struct medium was = surface->medium;
    struct pair index;
    struct error unknown;
    if (!medium_index(&was, lens_primary_wavelength(&varied->lens), &index, &unknown) ||
        index_doubt(&was, index) == 0) {
        return 0;
    }
    surface->medium = (struct medium){
        .kind = MEDIUM_CONSTANT, .written = was.written, .index = pair_add(index, pair_of(step))};
    const double slope = slope_now(varied);
    surface->medium = was;
    return slope * index_doubt(&was, index);
}

/*
 * How far what a solve gives may be from what another program has solved, though both have the same
 * lens: by rounded numbers of the file, and by indices that are not known better.
 *
 * Given     surface   of the lens, that the solve is of: what stands before it matters
 *           relative  rounding of the file's numbers
 * Formula   sum over the curvatures c, gaps d and indices n up to the surface of
 *           |da/d(ln c)| relative, |da/d(ln d)| relative, |da/dn| u: u = 1e-5 for a glass of a
 *           catalogue, of which editions differ by that, and a tenth of n - nd for one of which
 *           only nd and Vd are known
 */
static double solve_doubt(const struct solved_number *number, size_t surface, double relative)
{
    const struct lens *lens = &number->solving->lens;
    struct arena *arena = number->solving->file->job->arena;
    struct arena_mark mark = arena_mark(arena);
    struct varied_lens varied = {.lens = *lens, .number = number, .arena = arena};
    struct surface *all = ARENA_COPY(arena, lens->surfaces, lens->surface_count, 0);
    double doubt = 0;
    varied.lens.surfaces = all;
    bool has = solved_value(number, lens, arena, &varied.value);
    for (size_t i = 0; has && i <= surface; i++) {
        doubt += slope_of_figure(&varied, all[i].is_plane ? &all[i].curvature : &all[i].radius) *
                 relative;
        doubt += i < surface ? slope_of_figure(&varied, &all[i].thickness) * relative : 0;
        doubt += doubt_of_index(&varied, &all[i]);
    }
    doubt += has && !lens->object_is_infinite
                 ? slope_of_figure(&varied, &varied.lens.object) * relative
                 : 0;
    arena_reset(arena, mark);
    return doubt;
}

/* How far the two may be apart: of a pick-up or a sum by the digits of what it follows. */
static double solved_doubt(const struct solved_number *number)
{
    const double digits = 10, coarsest = 5e-4; /* of less than three digits none is rounded */
    struct solver_state *solving = number->solving;
    const size_t place = number->is_curvature
                             ? solving->places[number->at]
                             : zemax_gap_place(solving->file, solving->places, number->at);
    const double size = fabs(number->was.value.hi);
    const double rounding = fmin(figure_rounding(&number->was), coarsest * size);
    double value;
    return solved_value(number, &solving->lens, solving->file->job->arena, &value)
               ? solve_doubt(number, place, rounding / size)
               : digits * rounding;
}

static void check_solved(const struct solved_number *number)
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
        return;
    }
    if (is_stored && !(apart <= alike + solved_doubt(number))) {
        /* The file's number stays that of the lens. */
        struct solver_state *solving = number->solving;
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
        zemax_loss(file, line, LOSS_OF_POWER, "the file's number is kept",
                   "a solve contradicts the lens that is read: the %s of surface %zu is %.*s by "
                   "it, and %.*s in the file",
                   number->is_curvature ? "curvature" : "thickness", number->at,
                   text_shown(number->is.typed), number->is.typed.start,
                   text_shown(number->was.typed), number->was.typed.start);
        return;
    }
    if (!number->is_focus) {
        zemax_remark(file, "the %s of surface %zu is %.*s by its solve, the file had %.*s",
                     number->is_curvature ? "curvature" : "thickness", number->at,
                     text_shown(is->typed), is->typed.start, text_shown(was->typed),
                     was->typed.start);
    }
}

/* What the solve of a surface's curvature or thickness has to say, if it has one. */
static void check_solve(struct solver_state *solving, size_t at, bool is_curvature)
{
    struct zemax_file *file = solving->file;
    struct arena *arena = file->job->arena;
    const struct zemax_surface *from = &file->surfaces[at];
    struct solved_number number = {.solving = solving, .at = at, .is_curvature = is_curvature};
    if (is_curvature) {
        number.is = solving->curvature[at];
        if (number.is.typed.start == NULL) {
            return;
        }
        number.was = figure_per_length(from->curvature->numbers[0], file->build.lens->unit, -1);
        check_solved(&number);
        return;
    }
    if (from->solve == NULL || from->thickness == NULL || from->thickness->count == 0) {
        return;
    }
    number.is = solving->thickness[at];
    number.was = from->thickness->numbers[0];
    number.is_focus = at + 2 == file->surface_count && zemax_focuses(file);
    if (number.is_focus) {
        struct pair value;
        if (solving->places[at] == LENS_NONE ||
            !zemax_solve_in(solving, at, false, &solving->lens, arena, &value)) {
            return;
        }
        number.is = figure_rounded(value, solving->unit, arena);
    }
    check_solved(&number);
}

/*
 * What the solves give against the numbers that the program has stored beside them. Within what
 * rounding and editions of catalogues may do a note says both. Beyond that the lens is not the one
 * that the program had: a loss, and the file's number is kept.
 */
static void zemax_check_solves(struct solver_state *solving)
{
    for (size_t i = 1; i + 1 < solving->file->surface_count; i++) {
        check_solve(solving, i, true);
        check_solve(solving, i, false);
    }
}

/* -------- solved until they settle -------- */

enum { MOST_PASSES = 20 };

static bool is_same_gap(const struct figure *a, const struct figure *b)
{
    return fabs(pair_subtract(a->value, b->value).hi) <= 4e-16 * (fabs(a->value.hi) + 1e-9);
}

/* With an f-number or a chief ray what is solved first depends on what is solved last: again. */
static bool solve_all(struct solver_state *solving)
{
    size_t count = solving->file->surface_count;
    struct figure *before = ARENA_ARRAY(solving->file->job->arena, 2 * count, struct figure);
    bool settled = false;
    for (int pass = 0; pass < MOST_PASSES && !settled; pass++) {
        memcpy(before, solving->thickness, count * sizeof before[0]);
        memcpy(before + count, solving->curvature, count * sizeof before[0]);
        for (size_t i = 1; i + 1 < count; i++) {
            zemax_solve_surface(solving, i);
        }
        settled = true;
        for (size_t i = 0; i < count; i++) {
            settled = settled && is_same_gap(&before[i], &solving->thickness[i]) &&
                      is_same_gap(&before[count + i], &solving->curvature[i]);
        }
    }
    if (!settled) {
        return foreign_fail(solving->file->job, solving->file->error,
                            "the solves of the file do not settle");
    }
    return true;
}

bool zemax_thicknesses(struct zemax_file *file, const size_t *places)
{
    struct arena *arena = file->job->arena;
    struct solver_state solving = {.file = file, .places = places};
    /* Solves that follow a ray through many surfaces take their time. */
    const double most = 1e6; /* about a second */
    double work = 0;
    for (size_t i = 0; i < file->surface_count; i++) {
        work +=
            (file->surfaces[i].solve != NULL) + (zemax_number(file->surfaces[i].curvature, 1) >= 2);
    }
    work *= (double)file->surface_count * (double)file->configurations;
    if (work > most) {
        return foreign_fail(file->job, file->error, "too many solves");
    }
    solving.thickness = ARENA_ARRAY(arena, file->surface_count, struct figure);
    solving.curvature = ARENA_ARRAY(arena, file->surface_count, struct figure);
    solving.unit = lens_unit_scale(file->build.lens->unit);
    /* What stands in the file, before the solves. */
    for (size_t i = 0; i < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].thickness;
        bool inside = i > 0 && i + 1 < file->surface_count;
        if (inside && line != NULL && line->infinite && file->surfaces[i].solve == NULL) {
            return zemax_fail(line, line->first, "an infinite distance behind surface %zu", i);
        }
        solving.thickness[i] = line != NULL && line->count > 0 ? line->numbers[0] : figure_zero();
    }
    solving.lens = *file->build.lens;
    solving.lens.surfaces = ARENA_COPY(arena, solving.lens.surfaces, solving.lens.surface_count, 0);
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        if (places[i] != LENS_NONE) {
            solving.lens.surfaces[zemax_gap_place(file, places, i)].thickness =
                solving.thickness[i];
        }
    }
    if (!solve_all(&solving)) {
        return false;
    }
    zemax_check_solves(&solving);
    /* Gaps and curvatures, solved, go to the surfaces of the lens. */
    struct lens *lens = file->build.lens;
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        if (solving.places[i] == LENS_NONE) {
            continue;
        }
        struct surface *to = &lens->surfaces[solving.places[i]];
        lens->surfaces[zemax_gap_place(file, solving.places, i)].thickness = solving.thickness[i];
        if (solving.curvature[i].typed.start != NULL && !file->surfaces[i].has_free_curvature) {
            zemax_set_curvature(file, solving.curvature[i], to);
        }
    }
    struct surface *last = &lens->surfaces[lens->surface_count - 1];
    last->has_thickness = !zemax_focuses(file) || last->thickness.value.hi != 0;
    zemax_keep_pickups(&solving);
    return true;
}
