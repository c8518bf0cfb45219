/* camera/film/pupil_outline.h - the edge of a pupil as a point of the film sees it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_PUPIL_OUTLINE_H
#define LENSCALC_CAMERA_FILM_PUPIL_OUTLINE_H

#include "base/arena.h"
#include "optics/first_order.h"
#include "trace/kernel/rays.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/* A lens at all wavelengths that count, and its film. */
struct film_lens {
    const struct system *const *systems; /* reversed, with clip; the first is the one followed */
    size_t count;
    const struct first_order *first; /* for where the search begins */
    double film;                     /* behind the last vertex, mm */
    double reach;                    /* the point of the film farthest from the axis, mm */
};

/* Parts that the whole of a region's ring has, and in how many directions edges are looked for. */
enum { FILM_SECTORS = 128, PUPIL_OUTLINE_STEPS = 128 };

struct pupil_outline_point {
    double x, y;
};

/* A point of the film, mm, and what is upwards there: a unit vector. */
struct film_place {
    double x, y, up[2];
};

/*
 * An edge in directions as a region has them, cosines or tangents, whose y is along what is
 * upwards: seen from the centre, in directions from upwards over +x, to downwards where the other
 * half is its mirror image, else round to the first again.
 */
struct pupil_outline {
    struct film_place place;
    bool is_half, is_empty, asks_hole, has_hole;
    size_t each; /* which directions are looked in: all, every other.. */
    struct pupil_outline_point centre, size; /* size: half widths */
    struct pupil_outline_point edge[PUPIL_OUTLINE_STEPS + 1];
    struct pupil_outline_point hole[FILM_SECTORS + 1]; /* of every corner of the ring */
    /* how far out it is of the edge there, of this outline or of the last that has one */
    bool knows_hole;
    double share[FILM_SECTORS + 1];
};

struct pupil_outline_search {
    const struct film_lens *lens;
    struct arena *arena;
    double tangent; /* 1: directions are tangents, 0: cosines */
};

/* Pieces of the ring that an outline sees. */
static inline size_t pupil_outline_sectors(const struct pupil_outline *outline)
{
    return outline->is_half ? FILM_SECTORS / 2 : FILM_SECTORS;
}

/* What a lens that is the same after half a turn shows from the opposite place; up is the same. */
struct pupil_outline pupil_outline_turned(const struct pupil_outline *outline);

/* Centre and half widths of what was found at a place, for one a share of a step farther on. */
void pupil_outline_foresee(const struct pupil_outline *last, const struct pupil_outline *before,
                           double share, struct pupil_outline *here);

/*
 * Find the outline of its place.
 *
 * Given     near     the outline of a neighbour, from which `centre` and `size` are foreseen; null:
 *                    none, they are not set
 *           outline  with place, is_half, asks_hole, each
 * Formula   edges (trace/pupil/edges.h) about the centre, in a disc that is enlarged until it ends
 * none;
 *           where the centre is dark, about what outline_is_lit finds; without a neighbour about
 *           what outline_discover does
 */
void pupil_outline_find(const struct pupil_outline_search *search, size_t wavelength,
                        const struct pupil_outline *near, struct pupil_outline *outline);

/* The most rays that one call of outline_scatter finds. */
enum { OUTLINE_SCATTER = 5 * RAYS_BLOCK };

/*
 * Does any light come? Looked for about the centre that the outline has, with a grid of rays over
 * its half widths, and finer ones about the ray that fails by least.
 *
 * Result    true: the centre is a ray that passes well, half widths are about what is clear
 */
bool outline_is_lit(const struct pupil_outline_search *search, size_t wavelength,
                    struct pupil_outline *outline);

/* The same without any idea where. */
bool outline_discover(const struct pupil_outline_search *search, size_t wavelength,
                      struct pupil_outline *outline);

/*
 * Rays that pass, among some spread over 1.6 of the half widths about the centre, farther where
 * they lie beyond these: light that edges from there do not see, as horns of a crescent.
 *
 * Given     turn  other rays for each
 *           lit   receives directions, as edges have them: OUTLINE_SCATTER at most
 * Result    how many
 */
size_t outline_scatter(const struct pupil_outline_search *search, size_t wavelength,
                       const struct pupil_outline *outline, size_t turn,
                       struct pupil_outline_point *lit);

#endif
