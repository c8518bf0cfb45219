/* camera/subject/subject.h - what is photographed: the light that rays meet which have left the lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SUBJECT_SUBJECT_H
#define LENSCALC_CAMERA_SUBJECT_SUBJECT_H

#include "camera/subject/card.h"
#include "camera/subject/depth_card.h"
#include "camera/subject/view.h"
#include "trace/kernel/rays.h"

#include <stdint.h>

enum { SUBJECT_CHANNELS = CARD_CHANNELS };

/* A block of rays that a film has sent through a lens, and that were traced. */
struct subject_rays {
    const struct ray_block *block;
    const double *weights;                   /* of each; what has none need not be looked at */
    const double *times;                     /* of each, s; 0 is the middle of the exposure */
    const struct lanes *lanes;               /* that a scene is looked at in */
    const struct sampler_sequence *sequence; /* of their further numbers, and */
    uint32_t number;                         /* which of its blocks they are */
};

/* The light of a block, of each ray by channel. */
typedef double subject_light[RAYS_BLOCK][SUBJECT_CHANNELS];

struct subject;
typedef void subject_look(const struct subject *subject, const struct subject_rays *rays,
                          uint64_t sights[DEPTH_CARD_SIGHTS], subject_light light);

/* One of these; read-only afterwards: threads share it. */
struct subject {
    /* Light of all rays of a block, 0 of those that are lost or meet nothing. Of a relief adds up
       what they found out. */
    subject_look *look;
    const struct card *card;
    const struct depth_card *relief;
    const struct view *view;
};

struct subject subject_card(const struct card *card);
struct subject subject_relief(const struct depth_card *relief);
/* Light of the lanes that rays carry: linear sRGB, cd/m^2. */
struct subject subject_scene(const struct view *view);

/*
 * Where a ray that has left the lens meets the plane of a card.
 *
 * Given     distance  of it before the first vertex, mm
 * Result    at        x, y, mm; false: it never does
 */
bool subject_meets(const struct ray_block *rays, size_t i, double distance, double at[2]);

/* A ray of a block, told where it passes the plane so far behind the first vertex. */
struct depth_card_ray subject_ray(const struct ray_block *rays, size_t i, double plane);

#endif
