/* camera/photograph/ray_reuse.h - parts of a picture that need few rays, or none. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_RAY_REUSE_H
#define LENSCALC_CAMERA_PHOTOGRAPH_RAY_REUSE_H

#include "base/text.h"
#include "base/watch.h"
#include "camera/film/lens_film.h"
#include "camera/subject/card.h"
#include "camera/subject/depth_card.h"
#include "camera/subject/view.h"
#include "scene/backdrop.h"

#include <stdint.h>

/* What a picture does without where it is the same. */
enum skip {
    SKIP_PUPIL,     /* rays that the lens would stop */
    SKIP_COLOUR,    /* rays of all colours, where they go the same way, or nearly */
    SKIP_BLUR,      /* rays through all of the pupil, where they see the same */
    SKIP_UNIFORM,   /* rays at all, where everything has the same light */
    SKIP_EXPOSURES, /* a picture for each exposure */
    SKIP_TIME,      /* times of rays, where nothing moves */
    SKIP_SECONDARY, /* rays beyond the first, where nothing sends on light that it receives */
    SKIP_LAMPS,     /* rays that small lamps would have to meet by chance */
    SKIP_COUNT
};

/* Their names, in that order; ends with null. */
extern const struct word skip_words[];

/* Is it done all the same? kept: 1 << enum skip of what is. */
static inline bool skip_is_kept(unsigned kept, enum skip skip)
{
    return (kept & 1U << skip) != 0;
}

/* What a tile came to. */
enum ray_reuse_way {
    RAY_REUSE_TRACED, /* it needs all its rays */
    RAY_REUSE_SHARP,  /* one pupil tells what all of it sees */
    RAY_REUSE_EVEN,   /* all of it has the same light */
    RAY_REUSE_SHARED, /* rays of one colour stand for those of all */
    RAY_REUSE_WAYS,
    RAY_REUSE_ENDED = RAY_REUSE_WAYS /* the watch has ended it before */
};

struct irradiance_table;

/* The rays of a wavelength. */
struct ray_reuse_pass {
    size_t begin, end; /* channels that they are for */
    double share;      /* of each of them */
};

struct ray_reuse {
    const struct lens_film *film;
    const struct card *card;
    const struct depth_card *relief; /* null: the card is flat */
    const struct view *view;         /* in place of a card; null: of none */
    struct backdrop backdrop;        /* of a view that has one, and a camera that stands still */
    size_t passes;                   /* one a wavelength, or one for all */
    const struct ray_reuse_pass *pass;
    unsigned kept; /* 1 << enum skip, of what is done all the same */
    struct watch *watch;
    const struct irradiance_table *light; /* null: it is not the same all around, or nobody asks */
    double plane, frame; /* where rays are told, behind the first vertex; the card before it, mm */
};

/*
 * Make ready.
 *
 * Given     reuse   all above `light`
 *           blocks  of rays for each number of the table
 */
void ray_reuse_open(struct ray_reuse *reuse, size_t blocks, struct arena *arena);

/* What one thread looks with. */
struct ray_reuse_scratch;
struct ray_reuse_scratch *ray_reuse_scratch_new(size_t passes, struct arena *arena);

/* Where a ray passes the frame's lines of sight, x or y, at w = 1/d, d from the pupil. */
static inline double ray_reuse_seen_at(const struct ray_reuse *reuse,
                                       const struct depth_card_ray *ray, int axis, double w)
{
    return reuse->frame * (ray->x[axis] * w - ray->slope[axis]);
}

/*
 * Take a tile, if it may be spared.
 *
 * Given     plan     the points of its pixels
 *           samples  of each
 * Result    sights  so many samples more found out so much, of a card or relief
 *           sums    0 for each of 128 pixels: receives what the weights times the light of all
 *                   samples come to, unless it is RAY_REUSE_TRACED or RAY_REUSE_ENDED
 * Formula   rays from the tile's corners, within the rim of the pupil, of each wavelength, give the
 *           part of the card that is seen, with 10 % around it. Where that is even, E/L times its
 *           light. Where the rays of no corner are a quarter pixel apart, E/L times the mean light
 *           at half of the samples' points of the film: along rays through the middle of the pupil
 *           between 16 x 8 that are traced, moved as the pupil of the tile's middle moves them
 *           In a scene the same rays' starts and ways, with as much around them, see a backdrop
 *           that is even
 * Limits    where lens or shutter are not the same all around only black is spared; at the end of
 *           the light and behind a hole in the pupil nothing is. In a scene blur is not: what two
 *           rays meet says nothing of what lies between them
 */
enum ray_reuse_way ray_reuse_take(const struct ray_reuse *reuse, const struct film_plan *plan,
                                  size_t samples, struct ray_reuse_scratch *scratch,
                                  uint64_t sights[DEPTH_CARD_SIGHTS],
                                  double (*sums)[CARD_CHANNELS]);

#endif
