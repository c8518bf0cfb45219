/* camera/photograph/tile_work.h - tiles of a picture, each taken by as many rays as it needs. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_WORK_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_WORK_H

#include "base/parallel.h"
#include "camera/photograph/convergence.h"
#include "camera/photograph/light_paths.h"
#include "camera/photograph/photograph.h"
#include "camera/photograph/small_emitters.h"
#include "camera/photograph/tile_rays.h"
#include "camera/photograph/tiling.h"

#include <stdatomic.h>

/* Rays of a pixel that pay for a look at what need not be traced. */
enum { TILE_FEW_SAMPLES = 8 };

/* How far a tile has come. */
struct tile_stage {
    double sums[TILE_PIXELS][TILE_CHANNELS];
    double error; /* as a multiple of the one asked for */
    size_t samples;
};

/* What the tiles of a picture have in common, and where they leave what they come to. */
struct tile_work {
    const struct photograph_question *question;
    struct tile_grid tiling; /* of it */
    struct tile_rays rays;
    const struct ray_reuse *reuse;   /* null: all is traced */
    double scale;                    /* (n'/n)^2, n of the scene */
    double unit;                     /* of means, in errors that are asked for */
    struct convergence_goal goal;    /* of scenes */
    struct small_emitters small;     /* of scenes: tiles that may see one are not ended before */
    const struct light_paths *light; /* of a scene: what small lamps add; null: nothing */
    bool is_timed;                   /* all tiles have had the first of their stages */
    size_t first;                    /* tile of the slice that is taken */
    /* by tile, each its own thread's */
    unsigned char *done;
    struct tile_stage *stages; /* where somebody waits; else null */
    struct image *image;
    atomic_ullong *counts; /* PHOTOGRAPH_COUNTS of them, of all threads */
};

/*
 * Take the tiles of a piece, counted from the first of the slice: a loop of base/parallel.h.
 *
 * Given     work   a struct tile_work
 * Result    of each tile that is not done its pixels, in the image, and that it is; of stages one
 *           more, also of tiles that are done and may go on. What is counted is added. Of a tile
 *           that the watch or the clock ends nothing stays, nor is it counted
 * Formula   camera/photograph/photograph.h
 */
void tile_work_take(void *work, const struct parallel_piece *piece);

#endif
