/* trace/pupil/probe.c - whether light passes, and by how much it fails to. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/probe.h"

#include "trace/dispatch.h"
#include "trace/kernel/clip.h"

#include <math.h>

struct probe probe_share(const struct system *clipped, const struct beam *beam, struct rays work)
{
    return (struct probe){.system = system_outer(clipped),
                          .full = clipped->outer != NULL ? clipped : NULL,
                          .beam = beam,
                          .work = work};
}

struct probe probe_open(const struct system *clipped, const struct beam *beam, struct arena *arena)
{
    return probe_share(clipped, beam, rays_new(arena, RAYS_BLOCK));
}

bool probe_passes_one(const struct probe *probe, const double at[2])
{
    const struct rays rays = {probe->work.blocks, 1};
    beam_fill(probe->beam, (const double(*)[2])at, 1, rays.blocks);
    rays_trace(probe->system, &rays, NULL);
    return probe_passes(probe, 0);
}

/* Where a ray meets a surface, in its own frame. */
static void ray_at_surface(const struct system *system, size_t surface,
                           const struct ray_block *block, size_t lane, double point[3])
{
    point[0] = block->x[lane];
    point[1] = block->y[lane];
    point[2] = block->z[lane];
    if (system->lens->surfaces[surface].decentre != NULL) {
        system_to_own(system, surface, point);
    }
}

static const struct clip *probe_clip_at(const struct system *system, size_t surface)
{
    bool has = system->clips != NULL && surface < system->lens->surface_count;
    return has ? system->clips[surface] : NULL;
}

/* r^2/a^2 - 1, or that of the apertures if it is more; a clear radius may be infinite. */
static double excess_at(const struct system *system, size_t surface, const struct ray_block *block,
                        size_t lane, double clear)
{
    double point[3];
    ray_at_surface(system, surface, block, lane, point);
    double x = point[0] / clear, y = point[1] / clear, excess = x * x + y * y - 1;
    const struct clip *clip = probe_clip_at(system, surface);
    return clip != NULL ? fmax(excess, clip_excess(clip, point[0], point[1], NULL)) : excess;
}

static bool is_listed(const size_t *surfaces, size_t surface)
{
    while (surfaces != NULL && *surfaces != LENS_NONE && *surfaces != surface) {
        surfaces++;
    }
    return surfaces == NULL || *surfaces == surface;
}

/* Does a surface with this clear radius say anything? */
static bool is_limited(const struct system *system, size_t surface, double clear)
{
    return isfinite(clear) || probe_clip_at(system, surface) != NULL;
}

void probe_excess(const struct probe *probe, const size_t *surfaces, const double (*at)[2],
                  size_t count, double *excess)
{
    size_t from = 0, lost = 0;
    const struct system *system = probe->system;
    const struct ray_block *block = probe->work.blocks;
    const struct rays rays = {probe->work.blocks, count};
    beam_fill(probe->beam, at, count, rays.blocks);
    for (size_t i = 0; i < count; i++) {
        excess[i] = -1;
    }
    for (size_t place = 0; place < system->places && lost < count; place++) {
        const size_t surface = system_surface(system, place);
        bool looks = surface < system->lens->surface_count && is_listed(surfaces, surface);
        if (surfaces != NULL && !looks && place + 1 < system->places) {
            continue;
        }
        double clear = looks ? system_clear_radius(system, surface) : (double)INFINITY;
        rays_trace_part(system, from, place + 1, &rays, NULL);
        from = place + 1;
        for (size_t i = 0; i < count; i++) {
            if (excess[i] >= PROBE_LOST) {
                continue;
            }
            if (!isfinite(block->x[i]) || !isfinite(block->y[i])) {
                lost++;
                excess[i] = PROBE_LOST * (double)(system->places - place) +
                            PROBE_LOST * 0.5 * (1 - 1 / (2 + excess[i]));
            } else if (looks && is_limited(system, surface, clear)) {
                double here = excess_at(system, surface, block, i, clear);
                /* beyond any reason: but a ray that arrives is still better than a lost one */
                excess[i] = here > excess[i] ? fmin(here, 0.5 * PROBE_LOST) : excess[i];
            }
        }
    }
}

/* -------- where to look -------- */

/* A square of the beam's plane, and the best ray of a grid over it. */
struct probe_patch {
    double centre[2], half;
    double best, at[2]; /* excess; where */
    double rise;        /* from the best to the worst of its neighbours in the grid */
};

enum { SIDE = 11 };

/* One grid: SIDE^2 rays in one block, from the middle of the patch to its rim. */
static void probe_patch_trace(const struct probe *probe, struct probe_patch *patch)
{
    double at[SIDE * SIDE][2], excess[SIDE * SIDE];
    const double step = 2 * patch->half / (SIDE - 1);
    size_t best = SIDE * SIDE / 2;
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        at[i][0] = patch->centre[0] + ((double)(i % SIDE) - SIDE / 2) * step;
        at[i][1] = patch->centre[1] + ((double)(i / SIDE) - SIDE / 2) * step;
    }
    probe_excess(probe, NULL, (const double(*)[2])at, SIDE * SIDE, excess);
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
static struct probe_patch look_wide(const struct probe *probe, const double centre[2], double half,
                                    size_t side)
{
    struct probe_patch best = {.best = INFINITY};
    for (size_t i = 0; i < side * side; i++) {
        struct probe_patch patch = {.half = half / (double)side};
        for (int k = 0; k < 2; k++) {
            double cell = (double)(k == 0 ? i % side : i / side);
            patch.centre[k] = centre[k] + half * ((2 * cell + 1) / (double)side - 1);
        }
        probe_patch_trace(probe, &patch);
        best = patch.best < best.best ? patch : best;
    }
    return best;
}

/* Of so many surfaces each ray takes long. */
static bool has_many(const struct probe *probe)
{
    return probe->system->places > 100;
}

/*
 * Downhill from a patch: about its best ray, narrower unless that lies on the rim. Below 0 a few
 * more steps lead towards the middle. Of many surfaces it is given up where a step brings lost
 * rays not one of them farther.
 */
static bool probe_descend(const struct probe *probe, struct probe_patch *patch)
{
    enum { STEPS = 60, INWARDS = 3 };
    int inwards = 0;
    double start = patch->half;
    for (int step = 0; step < STEPS && inwards < INWARDS; step++) {
        double best = patch->best, at[2] = {patch->at[0], patch->at[1]};
        double moved = fmax(fabs(at[0] - patch->centre[0]), fabs(at[1] - patch->centre[1]));
        /* no farther down than the way up on the other side, many times over */
        if (best > 0 && best < PROBE_LOST && best > 30 * patch->rise && moved < 0.9 * patch->half) {
            return false;
        }
        patch->half *= moved < 0.9 * patch->half ? 0.3 : 1;
        if (!(patch->half > 1e-12 * start)) {
            break;
        }
        patch->centre[0] = at[0];
        patch->centre[1] = at[1];
        probe_patch_trace(probe, patch);
        if (patch->best > best) { /* rounding: the middle was this very ray */
            patch->best = best;
            patch->at[0] = at[0];
            patch->at[1] = at[1];
        }
        if (has_many(probe) && patch->best > fmax(best - PROBE_LOST, PROBE_LOST)) {
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
    return probe_clip_at(system, surface) != NULL
               ? fmin(clear, aperture_reach(&system->lens->surfaces[surface]))
               : clear;
}

/* The clear aperture of the first surface, or the largest there is, as the beam sees it. */
static struct probe_patch first_surface(const struct probe *probe)
{
    const struct system *system = probe->system;
    const size_t first = system_surface(system, 0);
    double radius = surface_reach(system, first), edge[2];
    struct probe_patch patch = {.half = 0};
    for (size_t i = 0; i < system->lens->surface_count && !isfinite(radius); i++) {
        double clear = surface_reach(system, i);
        radius = isfinite(clear) ? clear : radius;
    }
    if (!isfinite(radius)) {
        return patch;
    }
    beam_place(probe->beam, (double[3]){0, 0, 0}, patch.centre);
    beam_place(probe->beam, (double[3]){radius, 0, 0}, edge);
    patch.half = 1.2 * hypot(edge[0] - patch.centre[0], edge[1] - patch.centre[1]);
    return patch;
}

enum { REACHES = 4, PATCHES = REACHES + 1 };

/* Coarse grids about the guess and over the first surface, with the best ray of each. */
static size_t probe_coarse_grids(const struct probe *probe, const struct clear_guess *guess,
                                 struct probe_patch *patches)
{
    size_t count = 0;
    double reach = 1.5;
    for (size_t i = 0; i < REACHES; i++, reach *= 4) {
        patches[count] = look_wide(probe, guess->centre, reach * guess->radius, 1);
        if (patches[count++].best <= 0) {
            return count;
        }
    }
    struct probe_patch first = first_surface(probe);
    if (first.half > 0 && isfinite(first.half)) {
        patches[count++] = look_wide(probe, first.centre, first.half, 3);
    }
    return count;
}

/* Nothing comes through at all, clipped or not: a finer grid over the first surface. */
static bool look_closely(const struct probe *probe, const struct clear_guess *guess,
                         struct probe_patch *patch)
{
    struct probe_patch first = first_surface(probe);
    double half = first.half > 0 && isfinite(first.half) ? first.half : 6 * guess->radius;
    const double *centre = first.half > 0 ? first.centre : guess->centre;
    /* 12 x 12 blocks: of a hundred surfaces as long as of ten */
    *patch = look_wide(probe, centre, half, has_many(probe) ? 4 : 12);
    return patch->best < PROBE_LOST;
}

bool probe_inside(const struct probe *probe, const struct clear_guess *guess, double inside[2])
{
    struct probe_patch patches[PATCHES], closer;
    inside[0] = guess->centre[0];
    inside[1] = guess->centre[1];
    if (probe_passes_one(probe, inside)) {
        return true;
    }
    size_t count = probe_coarse_grids(probe, guess, patches);
    double least = INFINITY;
    for (size_t turn = count; turn-- > 0;) {
        /* the best first, or the last looked at */
        size_t best = 0;
        for (size_t i = 1; i < count; i++) {
            best = patches[i].best < patches[best].best ? i : best;
        }
        struct probe_patch *patch = &patches[best];
        if (probe_descend(probe, patch)) {
            inside[0] = patch->at[0];
            inside[1] = patch->at[1];
            return probe_passes_one(probe, inside);
        }
        least = fmin(least, patch->best);
        patch->best = INFINITY;
    }
    if (least >= PROBE_LOST && look_closely(probe, guess, &closer) &&
        probe_descend(probe, &closer)) {
        inside[0] = closer.at[0];
        inside[1] = closer.at[1];
        return probe_passes_one(probe, inside);
    }
    return false;
}

void probe_parts(const struct probe *probe, const double (*at)[2], size_t count,
                 struct clear_edge *edges)
{
    const struct system *system = probe->system;
    const struct rays rays = {probe->work.blocks, count};
    beam_fill(probe->beam, at, count, rays.blocks);
    for (size_t i = 0; i < count; i++) {
        edges[i].part = 0;
    }
    for (size_t place = 0; place < system->places; place++) {
        size_t surface = system_surface(system, place);
        const struct clip *clip = probe_clip_at(system, surface);
        double clear = clip != NULL ? system_clear_radius(system, surface) : 0, point[3];
        rays_trace_part(system, place, place + 1, &rays, NULL);
        for (size_t i = 0; i < count && clip != NULL; i++) {
            if (edges[i].surface == surface + 1 && edges[i].status == RAY_CLIPPED) {
                size_t part = 0;
                ray_at_surface(system, surface, probe->work.blocks, i, point);
                double x = point[0] / clear, y = point[1] / clear;
                bool listed = clip_excess(clip, point[0], point[1], &part) > x * x + y * y - 1;
                edges[i].part = listed ? part : 0;
            }
        }
    }
}

void probe_depth(const struct probe *probe, const double (*at)[2], size_t count, double *depth,
                 size_t *part)
{
    const struct system *system = probe->full;
    const struct rays rays = {probe->work.blocks, count};
    beam_fill(probe->beam, at, count, rays.blocks);
    for (size_t i = 0; i < count; i++) {
        depth[i] = -INFINITY;
        part[i] = 0;
    }
    for (size_t place = 0; place < system->places; place++) {
        size_t surface = system_surface(system, place);
        const struct clip *clip = probe_clip_at(system, surface);
        rays_trace_part(system, place, place + 1, &rays, NULL);
        for (size_t i = 0; i < count && clip != NULL && clip->inner_count > 0; i++) {
            double point[3];
            size_t piece = 0;
            ray_at_surface(system, surface, probe->work.blocks, i, point);
            double here = clip_depth(clip, point[0], point[1], &piece);
            if (here > depth[i]) {
                depth[i] = here;
                part[i] = (surface + 1) * 1048576 + piece;
            }
        }
    }
}
