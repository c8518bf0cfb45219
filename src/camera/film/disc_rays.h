/* camera/film/disc_rays.h - rays from points of the film through a pupil that is a disc. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_DISC_RAYS_H
#define LENSCALC_CAMERA_FILM_DISC_RAYS_H

#include "camera/film/film_rays.h"

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

/* Internal to disc_rays.c: the loop, built for each instruction set. */
typedef void kernel_disc(const struct disc *disc, struct film_samples *samples,
                         struct ray_block *block);
kernel_disc kernel_disc_sse2, kernel_disc_avx2, kernel_disc_avx512;

#endif
