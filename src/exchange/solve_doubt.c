/* exchange/solve_doubt.c - solves of other programs' files against the numbers beside them. */
/* SPDX-License-Identifier: MIT */
#include "exchange/solve_doubt.h"

#include <math.h>
#include <string.h>

/* Differences over this step, relative or of an index, are derivatives to many digits. */
static const double step = 1e-7;

/* A lens whose numbers vary one after the other, and what the solve gives in it as it is. */
struct varied_lens {
    struct lens lens;
    solve_answer *answer;
    const void *context;
    struct arena *arena;
    double value;
};

/* |da| over the step, of a number that has just been changed. */
static double solve_doubt_slope_of(const struct varied_lens *varied)
{
    double value;
    return varied->answer(varied->context, &varied->lens, varied->arena, &value)
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
    const double slope = solve_doubt_slope_of(varied);
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
    const double slope = solve_doubt_slope_of(varied);
    surface->medium = was;
    return slope * index_doubt(&was, index);
}

double solve_doubt(const struct lens *lens, size_t surface, double relative, solve_answer *answer,
                   const void *context, struct arena *arena)
{
    struct arena_mark mark = arena_mark(arena);
    struct varied_lens varied = {
        .lens = *lens, .answer = answer, .context = context, .arena = arena};
    struct surface *all = ARENA_ARRAY(arena, lens->surface_count, struct surface);
    double doubt = 0;
    memcpy(all, lens->surfaces, lens->surface_count * sizeof all[0]);
    varied.lens.surfaces = all;
    bool has = answer(context, lens, arena, &varied.value);
    for (size_t i = 0; has && i <= surface; i++) {
        struct figure *curve = all[i].is_plane ? &all[i].curvature : &all[i].radius;
        doubt += slope_of_figure(&varied, curve) * relative;
        doubt += i < surface ? slope_of_figure(&varied, &all[i].thickness) * relative : 0;
        doubt += doubt_of_index(&varied, &all[i]);
    }
    doubt += has && !lens->object_is_infinite
                 ? slope_of_figure(&varied, &varied.lens.object) * relative
                 : 0;
    arena_reset(arena, mark);
    return doubt;
}
