/* camera/subject/depth_card.h - a picture with its depths: what it shows, seen from beside its camera. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SUBJECT_DEPTH_CARD_H
#define LENSCALC_CAMERA_SUBJECT_DEPTH_CARD_H

#include "base/arena.h"
#include "base/error.h"
#include "camera/subject/card.h"

#include <stdbool.h>
#include <stddef.h>

/* What rays see that pass behind an edge of the relief or beside its frame: it knows nothing. */
enum depth_card_hidden {
    HIDDEN_NEARBY, /* what lies next to the edge, as far away as that */
    HIDDEN_BLACK
};

struct depth_card_question {
    const struct image *depths; /* one channel: m from the sensor, along the axis; or infinite */
    const char *name;           /* of their file, for messages */
    struct card card;           /* whose frame, in its distance, the pixels of the map fill */
    bool is_endless;            /* the frame is all that the film sees: its border goes on */
    enum depth_card_hidden hidden;
    double sensor; /* behind the first vertex, mm */
    double pupil;  /* the entrance pupil's centre behind the first vertex, mm */
    double radius; /* of the pupil, mm */
};

/* Read-only afterwards: threads share it. */
struct depth_card {
    struct card card;
    bool is_endless;
    enum depth_card_hidden hidden;
    size_t columns, rows;
    double pupil, frame; /* mm; the frame's distance from the pupil */
    double parallax;     /* pixels that the rim of the pupil sees a point move, a unit of 1/mm */
    double rim[2];       /* half a pixel of the picture, in pixels of the map */
    int levels;
    /* 1/mm: the largest and the least 1/distance from the pupil of squares of 2^level pixels */
    double **nearest, **farthest;
};

/* How much a ray found out. */
enum depth_card_sight {
    SIGHT_SEEN,
    SIGHT_BEHIND, /* it went behind an edge */
    SIGHT_BESIDE, /* it left a frame that goes on */
    DEPTH_CARD_SIGHTS
};

/*
 * Make a relief of a depth map: each pixel is a square patch at its distance, across the axis,
 * along its line of sight from the centre of the entrance pupil.
 *
 * Errors    ERROR_DATA: a depth that is no number above 0, or within the lens or its pupil, with
 *           column and row, from 1 at the top left; ERROR_DOMAIN: the pupil lies at infinity
 */
bool depth_card_open(const struct depth_card_question *question, struct arena *arena,
                     struct depth_card *relief, struct error *error);

/* A ray before the lens: where it passes the plane of the entrance pupil, mm, and x/z, y/z. */
struct depth_card_ray {
    double x[2], slope[2];
};

/*
 * Look along a ray.
 *
 * Result    light as card_look gives it, where the ray first meets the relief
 *           Neighbours whose distances differ by less than a pixel of parallax between the middle
 *           and the rim of the pupil are one surface: rays end at the step between them. Larger
 *           steps are edges, behind which rays go on until they come out again, or reach the
 *           distance of the surface that they passed last: SIGHT_BEHIND
 * Formula   with w = 1/d, d the distance before the pupil, a ray is a straight line over the frame,
 *           X = F (x w - slope), F the frame's d; lines of sight are upright, planes are planes. It
 *           is followed from the largest w that it may meet to small ones, over squares whose
 *           largest w it passes, the greater ones first
 */
struct card_light depth_card_look(const struct depth_card *relief, const struct depth_card_ray *ray,
                                  enum depth_card_sight *sight);

/*
 * How far away it is within part of its frame.
 *
 * Result    least, most  1/distance from the pupil, 1/mm: none is outside, which all may lie within
 */
void depth_card_range(const struct depth_card *relief, const struct card_part *part, double *least,
                      double *most);

#endif
