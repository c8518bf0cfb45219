/* trace/pupil/pupil_inside.c - where paraxial optics expects a pupil, and downhill from there. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/pupil_inside.h"

#include "trace/pupil/clearances.h"

#include <math.h>

struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first)
{
    bool reverse = system->options.reverse;
    double z = reverse ? first->exit_pupil : first->entrance_pupil;
    double scale = reverse ? first->exit_scale : first->entrance_scale;
    double radius = fabs(scale) * system->stop_radius, edge[2];
    bool far = !(fabs(z) <= 1e9);
    struct clear_guess guess = {.radius = radius};
    if (far) {
        /* telecentric: any far plane will do, and the stop's own size */
        z = isnan(z) ? 0 : copysign(1e9, z);
        radius = isfinite(radius) ? radius : system->stop_radius;
    }
    beam_place(beam, (double[3]){0, 0, z}, guess.centre);
    beam_place(beam, (double[3]){radius, 0, z}, edge);
    guess.radius = hypot(edge[0] - guess.centre[0], edge[1] - guess.centre[1]);
    if (!(guess.radius > 0 && guess.radius < 1e100)) {
        guess.radius = 1;
    }
    for (int i = 0; i < 2; i++) {
        guess.centre[i] = isfinite(guess.centre[i]) ? guess.centre[i] : 0;
    }
    return guess;
}

/* The excess of a lost ray, and more the less far it comes. */
static const double lost_excess = 1e30;

/*
 * By how much rays fail to pass: the largest excess of all clear apertures, 0 and less for those
 * that pass; never NaN.
 */
static void inside_measure(const struct clearances *margins, const double (*at)[2], size_t count,
                           double *excess)
{
    const struct ray_block *block = margins->work.blocks;
    clearances_look(margins, at, count);
    for (size_t i = 0; i < count; i++) {
        double before = -1;
        size_t reached = 0;
        /* beyond any reason: but a ray that arrives is still better than a lost one */
        excess[i] = fmin(margins->excess[i], 0.5 * lost_excess);
        if (!clearances_lost(margins->limit[i])) {
            continue;
        }
        for (size_t k = 0; k < margins->count; k++) {
            const double row = margins->rows[k * RAYS_BLOCK + i];
            reached = isnan(row) ? reached : margins->all[k].place;
            before = fmax(before, row);
        }
        if (ray_block_status(block, i) != RAY_CLIPPED) {
            reached = RAY_LOST_PLACE(block->lost[i]);
        }
        excess[i] = lost_excess *
                    ((double)(margins->system->places - reached) + 0.5 * (1 - 1 / (2 + before)));
    }
}

static bool inside_passes(const struct clearances *margins, const double at[2])
{
    clearances_look(margins, (const double(*)[2])at, 1);
    return margins->excess[0] <= 0;
}

/* A square of the beam's plane, and the best ray of a grid over it. */
struct inside_patch {
    double centre[2], half;
    double best, at[2]; /* excess; where */
    double rise;        /* from the best to the worst of its neighbours in the grid */
};

enum { SIDE = 11 };

/* One grid: SIDE^2 rays in one block, from the middle of the patch to its rim. */
static void inside_patch_trace(const struct clearances *margins, struct inside_patch *patch)
{
    double at[SIDE * SIDE][2], excess[SIDE * SIDE];
    const double step = 2 * patch->half / (SIDE - 1);
    size_t best = SIDE * SIDE / 2;
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        at[i][0] = patch->centre[0] + ((double)(i % SIDE) - SIDE / 2) * step;
        at[i][1] = patch->centre[1] + ((double)(i / SIDE) - SIDE / 2) * step;
    }
    inside_measure(margins, (const double(*)[2])at, SIDE * SIDE, excess);
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        best = excess[i] < excess[best] ? i : best;
    }
    patch->best = excess[best];
    patch->rise = 0;
    for (int k = 0; k < 2; k++) {
        patch->at[k] = at[best][k];
    }
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        bool near = fabs(at[i][0] - patch->at[0]) < 1.5 * step &&
                    fabs(at[i][1] - patch->at[1]) < 1.5 * step;
        patch->rise = near ? fmax(patch->rise, excess[i] - patch->best) : patch->rise;
    }
}

/* The same over a square cut into side^2 patches: the best of all of them. */
static struct inside_patch inside_look_wide(const struct clearances *margins,
                                            const double centre[2], double half, size_t side)
{
    struct inside_patch best = {.best = INFINITY};
    for (size_t i = 0; i < side * side; i++) {
        struct inside_patch patch = {.half = half / (double)side};
        for (int k = 0; k < 2; k++) {
            double cell = (double)(k == 0 ? i % side : i / side);
            patch.centre[k] = centre[k] + half * ((2 * cell + 1) / (double)side - 1);
        }
        inside_patch_trace(margins, &patch);
        best = patch.best < best.best ? patch : best;
    }
    return best;
}

/* Of so many surfaces each ray takes long. */
static bool has_many(const struct clearances *margins)
{
    return margins->system->places > 100;
}

/*
 * Downhill from a patch: about its best ray, narrower unless that lies on the rim. Below 0 a few
 * more steps lead towards the middle. Of many surfaces it is given up where a step brings lost
 * rays not one of them farther.
 */
static bool inside_descend(const struct clearances *margins, struct inside_patch *patch)
{
    enum { STEPS = 60, INWARDS = 3 };
    int inwards = 0;
    double start = patch->half;
    for (int step = 0; step < STEPS && inwards < INWARDS; step++) {
        double best = patch->best, at[2] = {patch->at[0], patch->at[1]};
        double moved = fmax(fabs(at[0] - patch->centre[0]), fabs(at[1] - patch->centre[1]));
        /* no farther down than the way up on the other side, many times over */
        if (best > 0 && best < lost_excess && best > 30 * patch->rise &&
            moved < 0.9 * patch->half) {
            return false;
        }
        patch->half *= moved < 0.9 * patch->half ? 0.3 : 1;
        if (!(patch->half > 1e-12 * start)) {
            break;
        }
        patch->centre[0] = at[0];
        patch->centre[1] = at[1];
        inside_patch_trace(margins, patch);
        if (patch->best > best) { /* rounding: the middle was this very ray */
            patch->best = best;
            patch->at[0] = at[0];
            patch->at[1] = at[1];
        }
        if (has_many(margins) && patch->best > fmax(best - lost_excess, lost_excess)) {
            return false;
        }
        inwards += patch->best <= 0 ? 1 : 0;
    }
    return patch->best <= 0;
}

/* How far from the vertex light passes a surface, mm; infinite where nothing says so. */
static double surface_reach(const struct system *system, size_t surface)
{
    double clear = system_clear_radius(system, surface);
    return system->clips != NULL && system->clips[surface] != NULL
               ? fmin(clear, aperture_reach(&system->lens->surfaces[surface]))
               : clear;
}

/* The clear aperture of the first surface, or the largest there is, as the beam sees it. */
static struct inside_patch first_surface(const struct clearances *margins)
{
    const struct system *system = margins->system;
    const size_t first = system_surface(system, 0);
    double radius = surface_reach(system, first), edge[2];
    struct inside_patch patch = {.half = 0};
    for (size_t i = 0; i < system->lens->surface_count && !isfinite(radius); i++) {
        double clear = surface_reach(system, i);
        radius = isfinite(clear) ? clear : radius;
    }
    if (!isfinite(radius)) {
        return patch;
    }
    beam_place(margins->beam->beam, (double[3]){0, 0, 0}, patch.centre);
    beam_place(margins->beam->beam, (double[3]){radius, 0, 0}, edge);
    patch.half = 1.2 * hypot(edge[0] - patch.centre[0], edge[1] - patch.centre[1]);
    return patch;
}

enum { REACHES = 4, PATCHES = REACHES + 1 };

/* Coarse grids about the guess and over the first surface, with the best ray of each. */
static size_t inside_coarse_grids(const struct clearances *margins, const struct clear_guess *guess,
                                  struct inside_patch *patches)
{
    size_t count = 0;
    double reach = 1.5;
    for (size_t i = 0; i < REACHES; i++, reach *= 4) {
        patches[count] = inside_look_wide(margins, guess->centre, reach * guess->radius, 1);
        if (patches[count++].best <= 0) {
            return count;
        }
    }
    struct inside_patch first = first_surface(margins);
    if (first.half > 0 && isfinite(first.half)) {
        patches[count++] = inside_look_wide(margins, first.centre, first.half, 3);
    }
    return count;
}

/* Nothing comes through at all, clipped or not: a finer grid over the first surface. */
static bool inside_look_closely(const struct clearances *margins, const struct clear_guess *guess,
                                struct inside_patch *patch)
{
    struct inside_patch first = first_surface(margins);
    double half = first.half > 0 && isfinite(first.half) ? first.half : 6 * guess->radius;
    const double *centre = first.half > 0 ? first.centre : guess->centre;
    /* 12 x 12 blocks: of a hundred surfaces as long as of ten */
    *patch = inside_look_wide(margins, centre, half, has_many(margins) ? 4 : 12);
    return patch->best < lost_excess;
}

static bool inside_search(const struct clearances *margins, const struct clear_guess *guess,
                          double inside[2])
{
    struct inside_patch patches[PATCHES], closer;
    inside[0] = guess->centre[0];
    inside[1] = guess->centre[1];
    if (inside_passes(margins, inside)) {
        return true;
    }
    size_t count = inside_coarse_grids(margins, guess, patches);
    double least = INFINITY;
    for (size_t turn = count; turn-- > 0;) {
        /* the best first, or the last looked at */
        size_t best = 0;
        for (size_t i = 1; i < count; i++) {
            best = patches[i].best < patches[best].best ? i : best;
        }
        struct inside_patch *patch = &patches[best];
        if (inside_descend(margins, patch)) {
            inside[0] = patch->at[0];
            inside[1] = patch->at[1];
            return inside_passes(margins, inside);
        }
        least = fmin(least, patch->best);
        patch->best = INFINITY;
    }
    if (least >= lost_excess && inside_look_closely(margins, guess, &closer) &&
        inside_descend(margins, &closer)) {
        inside[0] = closer.at[0];
        inside[1] = closer.at[1];
        return inside_passes(margins, inside);
    }
    return false;
}

bool pupil_inside_find(const struct system *clipped, const struct beam *beam,
                       const struct clear_guess *guess, struct arena *arena, double inside[2])
{
    const struct arena_mark mark = arena_mark(arena);
    /* u and v are the coordinates in the beam */
    const struct stop_beam frame = {.system = clipped,
                                    .beam = beam,
                                    .axes = {1, 0, 0, 1},
                                    .radius = INFINITY,
                                    .weight = WEIGHT_BEAM};
    const struct clearances margins = clearances_open(&frame, arena);
    const bool found = inside_search(&margins, guess, inside);
    arena_reset(arena, mark);
    return found;
}
