/* camera/photograph/photograph.h - a lens's picture of a card or scene: light on the pixels of a film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_PHOTOGRAPH_H
#define LENSCALC_CAMERA_PHOTOGRAPH_PHOTOGRAPH_H

#include "base/arena.h"
#include "base/error.h"
#include "base/image/image.h"
#include "base/watch.h"
#include "camera/film/lens_film.h"
#include "camera/photograph/convergence.h"
#include "camera/photograph/ray_reuse.h"
#include "camera/photograph/tiling.h"
#include "camera/subject/card.h"
#include "camera/subject/depth_card.h"
#include "camera/subject/view.h"

#include <stdint.h>

enum { PHOTOGRAPH_CHANNELS = TILE_CHANNELS, PHOTOGRAPH_PIXELS = TILE_PIXELS };

/*
 * What is counted: rays of a picture with depths by their sight, as in
 * camera/photograph/convergence.h, tiles
 * by what they came to, rays that were sent from where light comes, and those that passed the lens.
 */
enum {
    PHOTOGRAPH_CONVERGENCE = DEPTH_CARD_SIGHTS, /* where those begin */
    PHOTOGRAPH_WAYS = PHOTOGRAPH_CONVERGENCE + CONVERGENCE_COUNTS,
    PHOTOGRAPH_TRACED = PHOTOGRAPH_WAYS + RAY_REUSE_WAYS,
    PHOTOGRAPH_PASSED,
    PHOTOGRAPH_COUNTS
};

/* The depths of a picture: as camera/subject/depth_card.h has them. */
struct photograph_depths {
    const struct image *map; /* null: all in the plane of the card */
    const char *name;        /* of its file */
    enum depth_card_hidden hidden;
};

struct photograph;

struct photograph_question {
    /* its setup has wavelengths that all are of all channels, or, with is_coloured, as many for
       each channel, red first; their weights are shares of it */
    struct film_question film;
    bool is_coloured;
    size_t columns, rows;   /* pixels of it */
    struct image_area crop; /* pixels of them that are taken; no width: all */
    size_t samples;         /* rays a pixel and wavelength: a power of two */
    /* Each tile has as many as it needs for this error, a share of the white at the photograph's
       `reference`, and `samples` at most; 0: all have `samples` */
    double error;
    /* Of scenes it is a share of each pixel's light, or a grey level of a PNG of 8 bits whose white
       is `white`, lx, if that is more; NaN: white is so many times the mean */
    double white, white_of_mean;
    double duration; /* of the exposure, s, where rays at different times differ; 0: they do not */
    uint64_t seed;
    int threads;
    unsigned kept;           /* 1 << enum skip, of what is done though it need not be */
    const struct view *view; /* of a scene; null: it is of a card */
    /* width 0: as large as the film's corners see; height 0: by its own proportions */
    struct card card;
    struct photograph_depths depths; /* of what the card shows; no map: it is flat */
    /* One a tile of the crop, in rows from its top left: those that are not 0 are left out, black;
       others become 1 when they are taken. Null: all are taken */
    unsigned char *done;
    /* Ends in time: all tiles have CONVERGENCE_LEAST samples, then twice as many again and again
       until this is true; null: nobody waits. From any thread */
    bool (*is_over)(const void *clock);
    const void *clock;
    /* Called now and then, when some tiles are done and no thread is at work; null: it is not. */
    void (*pause)(void *pauser, struct photograph *so_far);
    void *pauser;
    struct watch *watch; /* null: nobody looks */
};

/*
 * Tiles that a picture is taken in, each by itself.
 *
 * Result    those of the crop, in rows from its top left; what a tile gets depends on its place in
 *           the frame alone, so that the same pixel is the same in every crop
 */
size_t photograph_tiles(const struct photograph_question *question);

/* A tile's channels between a picture and an array by itself, as tiling_copy has it. */
void photograph_tile(const struct photograph_question *question, const struct image *image,
                     size_t tile, enum tile_way way,
                     float pixels[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS]);

struct photograph {
    /* Of the crop, upright: E/L, sr, of the white of the card; of a scene E, lx, by channel */
    struct image image;
    struct card card;                 /* with its size */
    double mean[PHOTOGRAPH_CHANNELS]; /* of a scene: illuminance of all the film, lx */
    double mean_error;        /* of its luminance, as a share: camera/photograph/metering.h */
    bool is_metered_directly; /* also by rays to what shines, which miss nothing small */
    double reference; /* E/L of a white scene, sr: in the middle of the film or, where no light
                         reaches that, at some place that it does reach, */
    double reference_at[2];             /* mm */
    uint64_t counts[PHOTOGRAPH_COUNTS]; /* they add up over parts of a picture */
    size_t passes;                      /* one for all colours, or one a wavelength */
    size_t lamps, lamp_rays; /* whose light was sent to the film, by so many rays a wavelength */
    size_t reached[2];       /* where it ended in time: samples of tiles, the fewest and the most */
    double largest, corner; /* how far from the axis light arrives, towards any corner, and the film
                               goes, mm */
    bool is_incomplete;     /* the watch has ended it: tiles are missing, and black */
};

/* The share of the rays that arrive which found out so much, of a picture with depths. */
double photograph_share(const struct photograph *photograph, enum depth_card_sight sight);

/*
 * Take it.
 *
 * Result    each pixel the mean over its area of the irradiance that the card's light brings,
 *           relative to the luminance of its white; every channel by rays of its
 *           wavelengths. Of a scene the irradiance itself; its mean as
 *           camera/photograph/metering.h has it,
 *           the same for every crop
 * Formula   for 16 x 8 pixels at once the first 128 n points of a scrambled Sobol' sequence, of
 *           which each pixel has n where that is a power of two: of a card those that fall into
 *           it, of a scene n that follow each other (camera/photograph/tile_rays.h); rays as
 *           camera/film/film_rays.h, traced exactly, to the plane of the card, or to the relief
 *           that
 *           it is. With an error twice as many, CONVERGENCE_LEAST at first, until the tile's
 *           halves agree (camera/photograph/convergence.h), not before the small lights in its
 *           sight have been met (camera/photograph/small_emitters.h): of a card the points of so
 *           many samples, of a scene the first ones of each pixel's
 *           In a scene the light of small lamps is sent to the film before the tiles are taken
 *           (camera/photograph/light_paths.h), and rays from the film leave it out
 *           In a scene rays of the middle wavelength stand for those of others where
 *           camera/photograph/lateral_colour.h says so: a colour is then what its own rays bring
 *           from a
 *           white scene,
 *           times the mean light of these that show the same points. Of 8 samples and more
 *           Tiles are spared as camera/photograph/ray_reuse.h has it, of 8 samples and more, where
 *           nobody waits
 *           No number depends on the threads, the crop, or what is done already; how many samples
 *           a tile has that ends in time does
 * Errors    ERROR_DOMAIN: as lens_film_open; the card within the lens; no light that pixels
 *           accept where the reference is; as depth_card_open
 */
bool photograph_take(const struct photograph_question *question, struct arena *arena,
                     struct photograph *photograph, struct error *error);

#endif
