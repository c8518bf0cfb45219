/* camera/film/film_rays.h - rays from points of the film through the pupil that is clear for them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_FILM_RAYS_H
#define LENSCALC_CAMERA_FILM_FILM_RAYS_H

#include "base/sobol.h"
#include "camera/film/exit_pupil_bounds.h"
#include "trace/dispatch.h"
#include "trace/kernel/rays.h"

/* What the rays of one block are to be. */
struct film_samples {
    double x[RAYS_BLOCK], y[RAYS_BLOCK]; /* the point of the film, mm */
    double u[RAYS_BLOCK], v[RAYS_BLOCK]; /* which of its pupil, each in 0..1 */
    double weight[RAYS_BLOCK];           /* receives what the ray stands for, sr */
    /* receive from when to when a shutter lets it pass, s; of a film that has one */
    double begin[RAYS_BLOCK], end[RAYS_BLOCK];
};

enum {
    FILM_DIMENSIONS = 4,
    FILM_ACROSS = 16, /* cells that a rectangle is divided into: one for each ray of a block */
    FILM_DOWN = RAYS_BLOCK / FILM_ACROSS
};

/* Points spread over a rectangle of film and its pupils. */
struct film_plan {
    const struct sobol *sobol; /* x, y, u, v */
    uint32_t scrambling[FILM_DIMENSIONS];
    double left, bottom;  /* x and y where it begins, mm */
    double width, height; /* mm */
};

/*
 * The samples of block `block` of a sequence: its points RAYS_BLOCK block + 0, 1, ..
 *
 * Given     cells  null: all over the rectangle. Else one in each cell of it, which are counted
 *                  from the corner of the largest x and the least y on, first towards smaller x, as
 *                  pixels of a picture whose film is upside down: those that the places of a block
 *                  are in, each once; the plan's sobol is of strands, one a cell
 */
void film_rays_plan(const struct film_plan *plan, const unsigned char *cells, uint32_t block,
                    enum instruction_set set, struct film_samples *samples);

/*
 * Start a block of rays on the film.
 *
 * Given     region   has `largest` above 0
 *           samples  u, v evenly spread over the unit square
 *           block    receives rays for a reversed system; RAY_OK, path 0
 * Result    weight: projected solid angle over density. The mean over many u, v of weight times
 *           the radiance that arrives along rays which pass, 0 along the others, is the irradiance
 *           of the point; radiance as the medium of the image has it: the scene's times (n'/n)^2.
 *           Beyond region.largest 0
 * Formula   with corners interpolated between two distances, a piece of the ring chosen by u and
 *           within it P = I(w) + t (O(w) - I(w)), I and O along its two sides: direction cosines,
 *           whose areas are projected solid angles; weight = |dP/dw x dP/dt| dt/dv times the number
 *           of pieces, t such that it is even in rings; the point (x, y) is turned from (0, h).
 *           Of regions in tangents (exit_pupil_bounds.h) P holds L/N and M/N: weight times N^4
 * Source    cos(theta) dw = dL dM of the direction cosines L, M in the plane of the film:
 *           [Welford86] (illumination in the image)
 */
void film_rays_start(const struct exit_pupil_bounds *region, struct film_samples *samples,
                     enum instruction_set set, struct ray_block *block);

/* Internal to film_rays.c: the loops, built for each instruction set. */
typedef void kernel_film_plan(const struct film_plan *plan, const unsigned char *cells,
                              uint32_t block, struct film_samples *samples);
kernel_film_plan kernel_film_plan_sse2, kernel_film_plan_avx2, kernel_film_plan_avx512;
typedef void kernel_film(const struct exit_pupil_bounds *region, struct film_samples *samples,
                         struct ray_block *block);
kernel_film kernel_film_sse2, kernel_film_avx2, kernel_film_avx512;

enum { DISC_SECTORS = 128 };

/* The exit pupil of a thick or thin lens, and the film that sees it. */
struct disc {
    double film, place; /* behind the last vertex, mm */
    double index;       /* n of the image space */
    double area;        /* mm^2, of what is sampled */
    /* x, y of a polygon about it, mm: from upwards over the right, the last is the first again */
    double corners[DISC_SECTORS + 1][2];
};

/*
 * The polygon about a disc.
 *
 * Given     radius  mm
 *           disc    receives corners and area
 * Formula   1.0002 times the disc: the stop decides about the rest. By halved angles, with square
 *           roots only: the same bits on every machine
 */
void disc_open(double radius, struct disc *disc);

/* The same for a pinhole: all rays go through its middle, for as much light as comes through. */
void disc_open_pinhole(double radius, struct disc *disc);

/*
 * Start a block of rays on the film, as film_rays_start does.
 *
 * Result    weight: area A, z from film to pupil, p from point to point: A z^2/p^4
 * Formula   a sector of the polygon by u, within it evenly: sqrt(v) outwards; both cosines are z/p
 * Source    [BornWolf99] 4.8
 */
void disc_start(const struct disc *disc, struct film_samples *samples, enum instruction_set set,
                struct ray_block *block);

/* Internal to film_rays.c: the loop, built for each instruction set. */
typedef void kernel_disc(const struct disc *disc, struct film_samples *samples,
                         struct ray_block *block);
kernel_disc kernel_disc_sse2, kernel_disc_avx2, kernel_disc_avx512;

#endif
