/* exchange/zemax/zemax_gaps.c - gaps and curvatures, solved until they settle. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_solve.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

enum { MOST_PASSES = 20 };

/* What stands in the file, before the solves. */
static bool read_thicknesses(struct zemax_file *file, struct figure *thickness, struct error *error)
{
    for (size_t i = 0; i < file->surface_count; i++) {
        const struct zemax_line *line = file->surfaces[i].thickness;
        bool inside = i > 0 && i + 1 < file->surface_count;
        if (inside && line != NULL && line->infinite && file->surfaces[i].solve == NULL) {
            return file_words_fail(&line->words, line->first, error,
                                   "an infinite distance behind surface %zu", i);
        }
        thickness[i] = line != NULL && line->count > 0 ? line->numbers[0] : figure_zero();
    }
    return true;
}

static bool zemax_gaps_is_same(const struct figure *a, const struct figure *b)
{
    return fabs(pair_subtract(a->value, b->value).hi) <= 4e-16 * (fabs(a->value.hi) + 1e-9);
}

/* With an f-number or a chief ray what is solved first depends on what is solved last: again. */
static bool solve_all(struct solver_state *solving, struct error *error)
{
    size_t count = solving->file->surface_count;
    struct figure *before = ARENA_ARRAY(solving->file->job->arena, 2 * count, struct figure);
    bool settled = false;
    for (int pass = 0; pass < MOST_PASSES && !settled; pass++) {
        memcpy(before, solving->thickness, count * sizeof before[0]);
        memcpy(before + count, solving->curvature, count * sizeof before[0]);
        for (size_t i = 1; i + 1 < count; i++) {
            if (!zemax_solve_surface(solving, i, error)) {
                return false;
            }
        }
        settled = true;
        for (size_t i = 0; i < count; i++) {
            settled = settled && zemax_gaps_is_same(&before[i], &solving->thickness[i]) &&
                      zemax_gaps_is_same(&before[count + i], &solving->curvature[i]);
        }
    }
    if (!settled) {
        fail(error, ERROR_DATA, "the solves of the file do not settle");
        return error_locate(error, solving->file->job->source, 0, 0);
    }
    return true;
}

/* Solves that follow a ray through many surfaces take their time. */
static bool check_work(struct zemax_file *file, struct error *error)
{
    const double most = 1e6; /* about a second */
    double work = 0;
    for (size_t i = 0; i < file->surface_count; i++) {
        work +=
            (file->surfaces[i].solve != NULL) + (zemax_number(file->surfaces[i].curvature, 1) >= 2);
    }
    work *= (double)file->surface_count * (double)file->configurations;
    if (work > most) {
        fail(error, ERROR_DATA, "too many solves");
        return error_locate(error, file->job->source, 0, 0);
    }
    return true;
}

/* Gaps and curvatures, solved, go to the surfaces of the lens. */
static void zemax_gaps_put_numbers(struct solver_state *solving)
{
    struct zemax_file *file = solving->file;
    struct lens *lens = file->build.lens;
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        if (solving->places[i] == LENS_NONE) {
            continue;
        }
        struct surface *to = &lens->surfaces[solving->places[i]];
        lens->surfaces[zemax_gap_place(file, solving->places, i)].thickness = solving->thickness[i];
        if (solving->curvature[i].typed.start != NULL && !file->surfaces[i].has_free_curvature) {
            zemax_set_curvature(file, solving->curvature[i], to);
        }
    }
    struct surface *last = &lens->surfaces[lens->surface_count - 1];
    last->has_thickness = !zemax_focuses(file) || last->thickness.value.hi != 0;
}

bool zemax_thicknesses(struct zemax_file *file, const size_t *places, struct error *error)
{
    struct arena *arena = file->job->arena;
    struct solver_state solving = {.file = file, .places = places};
    if (!check_work(file, error)) {
        return false;
    }
    solving.thickness = ARENA_ARRAY(arena, file->surface_count, struct figure);
    solving.curvature = ARENA_ARRAY(arena, file->surface_count, struct figure);
    solving.unit = lens_unit_scale(file->build.lens->unit);
    if (!read_thicknesses(file, solving.thickness, error)) {
        return false;
    }
    solving.lens = *file->build.lens;
    solving.lens.surfaces = ARENA_ARRAY(arena, solving.lens.surface_count, struct surface);
    memcpy(solving.lens.surfaces, file->build.lens->surfaces,
           solving.lens.surface_count * sizeof solving.lens.surfaces[0]);
    for (size_t i = 1; i + 1 < file->surface_count; i++) {
        if (places[i] != LENS_NONE) {
            solving.lens.surfaces[zemax_gap_place(file, places, i)].thickness =
                solving.thickness[i];
        }
    }
    if (!solve_all(&solving, error)) {
        return false;
    }
    if (!zemax_check_solves(&solving, error)) {
        return false;
    }
    zemax_gaps_put_numbers(&solving);
    zemax_keep_pickups(&solving);
    return true;
}
