/* camera/photograph/tile_rays.h - the rays of a tile of a film, and what they bring to its pixels. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_RAYS_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_RAYS_H

#include "camera/photograph/lateral_colour.h"
#include "camera/photograph/photograph.h"
#include "camera/subject/subject.h"

#include <math.h>

/* What the rays of all tiles have in common. Read-only: threads share it. */
struct tile_rays {
    const struct lens_film *film;
    struct subject subject;
    size_t passes; /* one a wavelength, or one for all where nothing disperses */
    const struct ray_reuse_pass *pass;
    bool may_share;  /* rays of one wavelength may stand for those of all */
    double duration; /* of photograph_question */
    uint64_t seed;
    bool in_strands;                                 /* the points, one a pixel */
    uint32_t bits;                                   /* of strands */
    struct sobol film_points[FILM_DIMENSIONS], when; /* the first dimensions, in strands or not */
    struct sobol hero;                               /* in strands: of bands of blocks */
};

/* What one thread traces in; its colours are those that share rays. */
struct tile_scratch {
    struct film_samples samples;
    struct rays rays;
    subject_light light;
    struct tile_colours *colours;
    const struct lateral_colour *fringes; /* of a tile whose colours share their rays; else null */
    unsigned char cells[RAYS_BLOCK];      /* of a tile in strands: the pixels that they are of */
    double times[RAYS_BLOCK];             /* when each ray comes, s; all 0 where nothing needs it */
    uint32_t when, hero;              /* the tile's scramblings of them, and of bands of blocks */
    struct sampler_sequence sequence; /* of the tile: what rays decide by in a scene */
    double sums[TILE_PIXELS][TILE_CHANNELS];
    uint64_t counts[PHOTOGRAPH_COUNTS];
};

/* What rays of a scene decide by, for `points` of its view: dimensions behind film and time. */
const struct sampler_table *tile_rays_points(size_t samples, struct arena *arena);

/*
 * Make ready.
 *
 * Result    all but `subject`, which may be set later
 * Formula   of a scene each pixel has a strand of 2^bits points of the tile's sequence, for so many
 *           samples. So it has a net of its own if it takes all of them, and neighbours complement
 *           each other. The points of a card are one after the other: a pixel has those that fall
 *           into it. Where rays have many more numbers than those of film and pupil, these are
 *           uneven within a pixel by up to 128 samples; else they are even enough, and edges that
 *           go through many pixels are twice as exact
 * Source    [Ahmed20]
 */
void tile_rays_open(const struct photograph_question *question, const struct lens_film *film,
                    struct arena *arena, struct tile_rays *tile);

/* The points again, of a scene: for so many samples that they are below 2^bits. */
void tile_rays_open_points(struct tile_rays *tile, uint32_t bits);

struct tile_scratch *tile_scratch_new(size_t passes, struct arena *arena);

/* Is light carried in many bands, each a wavelength of the lens? */
static inline bool tile_rays_in_bands(const struct tile_rays *tile)
{
    const struct view *view = tile->subject.view;
    return view != NULL && !isnan(view->bands->wavelength[0]);
}

/*
 * E/L of a point of the film, sr, as lens_film_light: of the first wavelength or, of many bands, a
 * middle one.
 */
double tile_rays_light(const struct tile_rays *tile, const double at[2], size_t blocks,
                       struct tile_scratch *scratch);

/* Begin tile `number` of the frame: its points, of the plan, too; and sums of 0; none is shared. */
void tile_rays_begin(const struct tile_rays *tile, size_t number, struct film_plan *plan,
                     struct tile_scratch *scratch);

/*
 * Add weights times light, a pixel and channel each: blocks begin .. end - 1 of points, below
 * 2^bits in strands. Of a tile whose colours share rays they are there when `end` is a power of
 * two, 8 at least, and all blocks since the one before it were summed one after the other.
 */
void tile_rays_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                   size_t end, struct tile_scratch *scratch);

/*
 * May rays of one colour stand for those of all in this tile, but for where they come from? Then
 * tile_rays_sum looks along them alone.
 *
 * Result    scratch->fringes; null: they may not
 */
bool tile_colours_share(const struct tile_rays *tile, const struct film_plan *plan,
                        struct tile_scratch *scratch);

#endif
