/* analysis/image/psf_rays.c - the image of a point by rays, where waves turn too often to be added up. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_rays.h"

#include "analysis/image/psf_points.h"

#include <math.h>

/* Of one wavelength: some for each pixel of an image of the usual size. */
enum { RAYS = 1 << 16 };

bool psf_rays_trace(const struct exit_pupil *pupil, struct arena *arena, struct psf_rays *rays,
                    struct error *error)
{
    const struct wave_light *light = pupil->light;
    const double *centre = pupil->reference->centre;
    struct bundle bundle;
    light->source.region->in_beam = false;
    if (!bundle_trace(&light->source, RAYS, light->system->places, arena, &bundle, error)) {
        return false;
    }
    double(*at)[2] = arena_array(arena, bundle.count, sizeof *at);
    double *weights = ARENA_ARRAY(arena, bundle.count, double), sum = 0;
    *rays = (struct psf_rays){.at = (const double(*)[2])at, .weights = weights};
    for (size_t i = 0; i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        if (ray_block_status(block, lane) != RAY_OK) {
            continue;
        }
        at[rays->count][0] = block->x[lane] - centre[0];
        at[rays->count][1] = block->y[lane] - centre[1];
        for (int k = 0; k < 2; k++) {
            rays->farthest = fmax(rays->farthest, fabs(at[rays->count][k]));
        }
        weights[rays->count++] = bundle.points[i].weight;
        sum += bundle.points[i].weight;
    }
    for (size_t i = 0; i < rays->count; i++) {
        weights[i] /= sum;
    }
    return true;
}

void psf_rays_add(const struct psf_rays *rays, const struct psf_plane *plane, double energy,
                  double *values)
{
    const double size = (double)plane->size, middle = (double)(plane->size / 2);
    const double density = energy / (plane->pitch * plane->pitch);
    for (size_t i = 0; i < rays->count; i++) {
        const double x = rays->at[i][0] / plane->pitch + middle;
        const double y = rays->at[i][1] / plane->pitch + middle;
        const double left = floor(x), low = floor(y);
        for (int k = 0; k < 4; k++) {
            const double column = left + k % 2, row = low + (double)(k / 2);
            if (column >= 0 && column < size && row >= 0 && row < size) {
                values[(size_t)row * plane->size + (size_t)column] +=
                    rays->weights[i] * density * (1 - fabs(x - column)) * (1 - fabs(y - row));
            }
        }
    }
}

bool psf_rays_perfect(const struct psf_plane *plane, double *perfect, struct error *error)
{
    struct psf_plane still = *plane; /* W = 0 at the reference: no phase turns */
    struct psf_points points;
    still.pitch = still.spread = 0;
    if (!psf_points_put(&still, &points, error)) {
        return false;
    }
    *perfect = points.total;
    return true;
}
