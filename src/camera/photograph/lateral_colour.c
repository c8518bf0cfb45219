/* camera/photograph/lateral_colour.c - colours' rays as those of one colour from other points of the film. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/lateral_colour.h"

#include "trace/dispatch.h"

#include <math.h>

enum { X, Y, AXES = LATERAL_COLOUR_AXES };
enum { CORNERS = LATERAL_COLOUR_CORNERS, OF_PUPIL = RAYS_BLOCK / CORNERS };

/* Rays that have left the lens, in the plane of its first vertex. */
struct exits {
    double x[AXES][RAYS_BLOCK]; /* mm */
    double p[AXES][RAYS_BLOCK]; /* optical direction cosines */
};

struct lateral_colour_scratch {
    struct lateral_colour fringes;
    struct film_samples samples;
    struct rays rays;
    struct ray_block started;
    bool passed[RAYS_BLOCK];
    struct exits middle, turned[AXES]; /* turned: by a little in p or q, less the middle's */
};

struct lateral_colour_scratch *lateral_colour_scratch_new(size_t wavelengths, struct arena *arena)
{
    struct lateral_colour_scratch *scratch = ARENA_NEW(arena, struct lateral_colour_scratch);
    scratch->rays = rays_new(arena, RAYS_BLOCK);
    scratch->fringes.moved = arena_array(arena, wavelengths, sizeof *scratch->fringes.moved);
    return scratch;
}

static void lateral_colour_trace(const struct lens_film *film, size_t wavelength,
                                 struct lateral_colour_scratch *scratch, struct exits *exits)
{
    const struct ray_block *block = scratch->rays.blocks;
    ray_model_trace(&film->models[wavelength], &scratch->rays,
                    NULL); /* whatever the shutter does */
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double way = -block->z[i] / block->r[i];
        exits->x[X][i] = block->x[i] + way * block->p[i];
        exits->x[Y][i] = block->y[i] + way * block->q[i];
        exits->p[X][i] = block->p[i];
        exits->p[Y][i] = block->q[i];
    }
}

/* Less those of the middle. */
static void subtract(const struct lateral_colour_scratch *scratch, struct exits *exits)
{
    for (int k = X; k < AXES; k++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            exits->x[k][i] -= scratch->middle.x[k][i];
            exits->p[k][i] -= scratch->middle.p[k][i];
        }
    }
}

/* Of p or q, as direction cosines: far above rounding, far below the width of a pupil. */
static const double a_little = 1e-4;

/* Is what is moved along an axis little enough at all corners? Its means. */
static bool is_little(struct lateral_colour_scratch *scratch, const struct exits *off, int axis,
                      double pixel, double (*means)[AXES])
{
    struct lateral_colour *fringes = &scratch->fringes;
    bool little = true;
    for (size_t corner = 0; corner < CORNERS; corner++) {
        double low = INFINITY, high = -INFINITY, sum = 0, count = 0;
        for (size_t i = corner * OF_PUPIL; i < (corner + 1) * OF_PUPIL; i++) {
            if (scratch->passed[i]) {
                /*
                 * how far on the film, along an axis, ray i is from the middle's that leaves as it
                 * does, mm
                 */
                const struct exits *turned = &scratch->turned[axis];
                double total = 0;
                for (int k = X; k < AXES; k++) {
                    total += turned->p[k][i] * off->x[k][i] - turned->x[k][i] * off->p[k][i];
                }
                const double by = total / a_little;
                low = fmin(low, by);
                high = fmax(high, by);
                sum += by; /* a NaN stays in it, and is not little */
                count++;
            }
        }
        means[corner][axis] = sum / count;
        little = little && fabs(sum / count) <= FRINGES_MOST * pixel &&
                 high - low <= FRINGES_MOST * pixel;
        fringes->low[axis] = fmin(fringes->low[axis], sum / count);
        fringes->high[axis] = fmax(fringes->high[axis], sum / count);
    }
    return little;
}

const struct lateral_colour *lateral_colour_find(const struct lens_film *film, size_t wavelengths,
                                                 size_t middle, const double pixel[2],
                                                 const struct film_plan *plan,
                                                 struct lateral_colour_scratch *scratch)
{
    struct lateral_colour *fringes = &scratch->fringes;
    /* from the corners of the tile, all over the pupil */
    static const double v[] = {0.98, 0.7, 0.4, 0.1};
    struct film_samples *samples = &scratch->samples;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const size_t corner = i / OF_PUPIL;
        samples->x[i] = plan->left + (corner % 2 == 0 ? 0 : plan->width);
        samples->y[i] = plan->bottom + (corner < 2 ? 0 : plan->height);
        samples->u[i] = ((double)(i % OF_PUPIL) + 0.5) / OF_PUPIL;
        samples->v[i] = v[i % 4];
    }
    film->aim(film, samples, scratch->rays.blocks);
    scratch->started = *scratch->rays.blocks;
    lateral_colour_trace(film, middle, scratch, &scratch->middle);
    /* do enough rays of every corner pass to tell? */
    size_t passed[CORNERS] = {0};
    bool all = true;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        scratch->passed[i] = scratch->rays.blocks->lost[i] == 0 && scratch->samples.weight[i] > 0;
        passed[i / OF_PUPIL] += scratch->passed[i];
    }
    for (size_t corner = 0; corner < CORNERS; corner++) {
        all = all && passed[corner] >= OF_PUPIL / 2;
    }
    if (!all) {
        return NULL;
    }
    for (int axis = X; axis < AXES; axis++) {
        /* the same rays a little turned, of the middle's colour: how they leave */
        struct ray_block *block = scratch->rays.blocks;
        *block = scratch->started;
        double *along = axis == X ? block->p : block->q;
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double before = along[i], after = before + a_little;
            along[i] = after;
            block->r[i] = copysign(
                sqrt(block->r[i] * block->r[i] + before * before - after * after), block->r[i]);
        }
        lateral_colour_trace(film, middle, scratch, &scratch->turned[axis]);
        subtract(scratch, &scratch->turned[axis]);
        fringes->low[axis] = fringes->high[axis] = 0;
    }
    bool little = true;
    /* the ends of the spectrum first, which are the farthest away most of the time */
    for (size_t i = 0; i < wavelengths && little; i++) {
        const size_t wavelength = i % 2 == 0 ? i / 2 : wavelengths - 1 - i / 2;
        struct exits off;
        *scratch->rays.blocks = scratch->started;
        lateral_colour_trace(film, wavelength, scratch, &off);
        subtract(scratch, &off);
        for (int axis = X; axis < AXES && little; axis++) {
            little = is_little(scratch, &off, axis, pixel[axis], fringes->moved[wavelength]);
        }
    }
    return little ? fringes : NULL;
}
