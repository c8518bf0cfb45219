/* camera/photograph/lamp_rays.h - blocks of rays from a lamp through the lens to the film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_LAMP_RAYS_H
#define LENSCALC_CAMERA_PHOTOGRAPH_LAMP_RAYS_H

#include "camera/photograph/tile_rays.h"
#include "scene/distant_lights.h"

#include <math.h>
#include <stdint.h>

/* Numbers of a ray: the place in its rectangle, the direction to the emitter, when it comes. */
enum { U_PLACE, U_EMITTER = 2, U_TIME = 4, U_COUNT };

/* The light of one emitter, through a rectangle that it fills on its way to the film. */
struct lamp {
    size_t thing;                        /* of the scene; SCENE_NONE: far away, */
    const struct distant_light *distant; /* this one */
    double plane;                        /* of the rectangle, behind the first vertex, mm */
    double low[2], high[2];              /* mm */
    size_t blocks;                       /* of rays, a power of two */
    size_t begin;                        /* blocks of those before it */
    uint64_t sequence;                   /* of its points */
};

/* What all lamps have in common. */
struct lamps {
    const struct photograph_question *question;
    const struct tile_rays *rays;
    const struct ray_model *models; /* towards the film */
    bool is_ideal;                  /* of a model whose rays are linear in heights and slopes */
    double begin, end;              /* of the exposure of any pixel, s */
    double pixel[2];                /* of the film, mm */
};

/* A block of rays of a lamp, traced to the film. */
struct lamp_rays {
    double u[U_COUNT][RAYS_BLOCK];
    /* as they leave the emitter, of all wavelengths */
    double times[RAYS_BLOCK];
    double sent[RAYS_BLOCK];            /* mm^2 sr of luminance 1; 0: there is no such ray */
    struct vector front[RAYS_BLOCK];    /* where it meets the first vertex's plane, of the scene */
    struct light_sample to[RAYS_BLOCK]; /* from there to the emitter */
    enum { UNKNOWN, FREE, BLOCKED } is_free[RAYS_BLOCK]; /* that way */
    struct ray_block start;                              /* of index 1 */
    /* of one wavelength */
    struct rays rays, back;  /* at the film, and the same from there */
    double flux[RAYS_BLOCK]; /* what is sent, as far as pixels and shutter take it */
    struct film_samples samples;
};

struct lamp_rays *lamp_rays_new(struct arena *arena);

/*
 * Start rays of a lamp at the emitter, or where they are near enough to the lens that nothing is
 * lost to rounding.
 *
 * Given     rays  their numbers u
 * Result    what leaves the emitter: flux L cos(theta) dA dw of luminance 1, of points all over the
 *           rectangle and the solid angle of the emitter, so that its mean over many is that of
 *           the light which passes the rectangle
 */
void lamp_start(const struct lamps *lamps, const struct lamp *lamp, struct lamp_rays *rays);

/*
 * A block that was started, to the film, at a wavelength of the lens.
 *
 * Formula   of ideal lenses times (cos theta'/cos theta)^4: linear in places and slopes, they keep
 *           dA d^2(tan theta), and not the etendue; luminance is kept all the same, as along rays
 *           from the film
 * Source    derived here
 * Result    flux: 0 of rays that are lost, times what pixels accept, and the share of the exposure
 *           for which a shutter is open to rays at all, if it is to this one at its time
 */
void lamp_trace(const struct lamps *lamps, size_t wavelength, struct lamp_rays *rays);

/* Is a ray at the film, where pixels are? */
static inline bool lamp_arrives(const struct lamps *lamps, const struct lamp_rays *rays, size_t i)
{
    const struct film_question *film = &lamps->question->film;
    const struct ray_block *block = rays->rays.blocks;
    return rays->flux[i] > 0 && fabs(block->x[i]) < film->width / 2 &&
           fabs(block->y[i]) < film->height / 2;
}

#endif
