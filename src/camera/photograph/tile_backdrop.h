/* camera/photograph/tile_backdrop.h - tiles that see nothing of a scene but an even backdrop. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_BACKDROP_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_BACKDROP_H

#include "camera/subject/card.h"
#include "camera/subject/depth_card.h"
#include "camera/subject/view.h"
#include "scene/backdrop.h"

/* Rays from the corners of a tile within the rims of their pupils, after the lens. */
struct tile_rims {
    size_t passes;
    struct depth_card_ray (*ray)[RAYS_BLOCK]; /* by pass: told where they pass one plane */
    bool (*passed)[RAYS_BLOCK];               /* which are not lost */
    double before;                            /* how far from there they start, at most, mm */
    double around; /* what is added to where they start and go, of its size, on each side */
};

/*
 * Given     view   of a camera that stands still
 *           rims   told in the plane of the first vertex
 *           light  0
 * Result    light  by channel, of all rays between these and around them; false: some may see
 *                  another
 */
bool tile_sees_backdrop(const struct view *view, const struct backdrop *backdrop,
                        const struct tile_rims *rims, struct card_light *light);

#endif
