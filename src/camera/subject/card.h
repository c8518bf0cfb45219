/* camera/subject/card.h - flat things to be photographed: pictures and test charts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SUBJECT_CARD_H
#define LENSCALC_CAMERA_SUBJECT_CARD_H

#include "base/image/image.h"
#include "base/text.h"

#include <stdbool.h>

/*
 * Test charts; white is 1. Directions are those of somebody who looks at the card.
 *
 * edge     through the middle, turned by 5 degrees from upright: white on the left, a quarter of it
 *          on the right, as [ISO12233] has it
 * star     72 sectors about the middle, out to 0.48 of the height: 36 cycles over 2 pi r
 * grid     black lines on white, their middles 1/12 of the width apart, 1/240 of it wide
 * checker  squares of 1/12 of the width
 * bars     upright bars, black and white, six groups side by side: 5, 10, 20, 40, 80 and 160
 *          cycles over the width
 * wedge    21 fields of grey from left to right, each half a stop darker than the one before
 * points   white discs of 1/200 of the width on black, 1/12 of it apart
 * stars    a disc of 1/200 of the width somewhere in each square of 1/24 of it, on black, of some
 *          magnitude from 0, white, to 5, 1/100 of it, the faint ones more often
 */
enum chart {
    CHART_NONE,
    CHART_EDGE,
    CHART_STAR,
    CHART_GRID,
    CHART_CHECKER,
    CHART_BARS,
    CHART_WEDGE,
    CHART_POINTS,
    CHART_STARS
};

/* Of what they are made, for those who say so. */
#define CHART_EDGE_DEGREES 5.0
#define CHART_EDGE_DARK    0.25
#define CHART_STAR_RADIUS  0.48  /* of the height */
#define CHART_GRID_HALF    0.025 /* of a mesh: half of a line */
enum {
    CHART_STAR_CYCLES = 36,
    CHART_MESHES = 12,    /* of grid, checker and points over the width */
    CHART_BARS_LEAST = 5, /* cycles over the width, and twice as many in each group after it */
    CHART_GROUPS = 6,
    CHART_WEDGE_FIELDS = 21,
    CHART_MAGNITUDES = 5
};

/* The words of the command line for them, without the first; ends with null. */
extern const struct word charts[];

/* A card across the axis, its middle on it. */
struct card {
    enum chart chart;
    const struct image *picture; /* of no chart: 1 or 3 channels and more, light with white 1 */
    double distance;             /* before the first vertex, mm */
    double width, height;        /* mm */
};

enum { CARD_CHANNELS = 3 };

/* Light of a point, as a share of white. */
struct card_light {
    float of[CARD_CHANNELS];
};

/* Part of a card's plane, mm from its middle. */
struct card_part {
    double low[2], high[2]; /* x, y */
};

/*
 * Look at a point of the card.
 *
 * Given     x, y  mm from its middle, to the right and up as one looks at it from the camera
 * Result    black beside the card; pixels of a picture have the light of their middles, and what
 *           lies between four of them goes in a straight line
 */
struct card_light card_look(const struct card *card, double x, double y);

/*
 * Has a part the same light everywhere?
 *
 * Result    light  of all its points. False also where that is so, but not easily seen: of large
 *                  parts of a picture, and within the star
 */
bool card_is_even(const struct card *card, const struct card_part *part, struct card_light *light);

#endif
