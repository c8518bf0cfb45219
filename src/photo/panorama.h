/* photo/panorama.h - how many frames a panorama takes, its size, and parallax. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_PANORAMA_H
#define LENSCALC_PHOTO_PANORAMA_H

#include <stdbool.h>

#include "base/error.h"

/* One frame: its angles as the camera is held (portrait: exchange the sides). */
struct panorama_frame {
    double horizontal, vertical; /* full angles of view, rad, above 0 up to 2 pi */
};

/* What is to be covered. */
struct panorama_goal {
    double arc;     /* horizontal angle, rad, above 0 up to 2 pi; 2 pi closes on itself */
    double span;    /* vertical angle, rad, 0 to pi; up to the frame's own: one row */
    double overlap; /* at least this fraction of a frame, 0 up to below 1, both ways */
};

/* The plan. */
struct panorama {
    int columns, rows, shots;    /* shots = columns x rows */
    double step, row_step;       /* between neighbours, rad; 0 for a single one */
    double overlap, row_overlap; /* what the even steps achieve; NaN for a single one */
};

/* One row of a plan of many. */
struct panorama_row {
    double elevation; /* of the frame's middle, rad */
    int columns;      /* enough at that elevation */
    double step;      /* rad */
};

/* Pixels of the stitched picture; one pixel in the middle of a frame stays one pixel. */
struct panorama_size {
    double per_degree;
    double width;           /* cylinder and sphere: arc x pixels per radian */
    double sphere_height;   /* equirectangular: span x pixels per radian */
    double cylinder_height; /* 2 tan(span/2) x pixels per radian; inf from 180 degrees on */
    double flat_width;      /* rectilinear: 2 tan(arc/2) x pixels per radian; inf likewise */
};

/*
 * Angles of view of a rectilinear frame.
 *
 * Given     f, m, P        mm, > 0; magnification at the focus, >= 0; of the pupils, > 0
 *           width, height  of the sensor as held, mm, > 0
 * Formula   2 atan(width/(2 f (1 + m/P)))
 * Source    lenscalc.7, photography, from the entrance pupil, about which the camera turns
 * Errors    values outside their ranges
 */
bool panorama_frame(double f, double m, double P, double width, double height,
                    struct panorama_frame *frame, struct error *error);

/*
 * Columns, rows and even steps.
 *
 * Given     frame (any projection: fisheye angles may be put in), goal
 * Formula   closed turn: ceil(2 pi/(h (1 - o))), step 2 pi/columns. Arc A: ceil((A - h o)/(h (1 -
 *           o))), at least 1, step (A - h)/(columns - 1). Overlap achieved 1 - step/h. Rows
 *           likewise with the vertical angle
 * Source    lenscalc.7, photography
 * Errors    ranges; more than a million frames a row
 * Limits    all rows have the columns of the horizon, enough for zenith and nadir; panorama_row_at
 *           says how few will do up there. A quotient within 1e-9 of a whole number counts as it
 */
bool panorama_plan(const struct panorama_frame *frame, const struct panorama_goal *goal,
                   struct panorama *plan, struct error *error);

/*
 * A plan with a wished number of rows in place of those that the overlap asks for.
 *
 * Given     frame, goal  as panorama_plan; a span of 0 becomes what the rows cover with the
 *                        overlap, at most pi
 *           rows         1 or more
 *           plan         of panorama_plan, changed
 * Formula   span = v + (rows - 1) v (1 - o); step (span - v)/(rows - 1); overlap 1 - step/v
 * Source    lenscalc.7, photography
 * Errors    rows that leave gaps, or more frames than a million
 */
bool panorama_set_rows(const struct panorama_frame *frame, struct panorama_goal *goal, int rows,
                       struct panorama *plan, struct error *error);

/* The overlap that `columns` frames give over the arc; negative = gaps; NaN for one frame of an
 * arc. */
bool panorama_overlap(const struct panorama_frame *frame, double arc, int columns, double *overlap,
                      struct error *error);

/*
 * One row of a rectilinear many-row panorama.
 *
 * Given     frame, goal, plan
 *           middle  elevation of the panorama's middle, rad
 *           index   of the row, 0 (lowest) to rows - 1
 * Formula   elevation e, row step r: half-way to the row nearer the horizon the frame's side
 *           reaches cos(|e| - r/2)/cos(r/2) forward and spans the azimuth 2 atan(tan(h/2)
 *           cos(r/2)/cos(|e| - r/2)), its least in the band that is this row's own; columns as
 *           panorama_plan over this angle; 1 with the zenith or nadir in the middle
 * Source    geometry, derived here; test_panorama.c turns edge points
 * Errors    index out of range; elevation beyond 90 degrees; frame not below 180 degrees
 */
bool panorama_row_at(const struct panorama_frame *frame, const struct panorama_goal *goal,
                     const struct panorama *plan, double middle, int index,
                     struct panorama_row *row, struct error *error);

/*
 * Size of the stitched picture.
 *
 * Given     frame (rectilinear, below 180 degrees), goal (span below the frame's own counts as it),
 *           pixels: frame's pixels along its horizontal side
 * Formula   pixels per radian in the middle of a frame = pixels/(2 tan(h/2))
 * Errors    frame not below 180 degrees, pixels not above 0
 */
bool panorama_size(const struct panorama_frame *frame, const struct panorama_goal *goal,
                   double pixels, struct panorama_size *size, struct error *error);

/*
 * The arc and span that a picture of so many pixels takes, as a cylinder.
 *
 * Given     frame (rectilinear, below 180 degrees);  pixels  along its horizontal side
 *           width, height  of the picture, pixels, > 0
 *           goal  receives arc and span
 * Formula   the inverse of panorama_size: arc = width/p, span = 2 atan(height/(2 p)) with p pixels
 *           per radian
 * Source    a cylinder rolled flat: lengths along its height are p tan(elevation)
 * Errors    as panorama_size; an arc beyond a full turn
 */
bool panorama_goal_of_size(const struct panorama_frame *frame, double pixels, double width,
                           double height, struct panorama_goal *goal, struct error *error);

/*
 * Parallax between neighbouring frames if the camera turns about a point off the entrance pupil.
 *
 * Given     offset  of the entrance pupil from the axis, along the lens axis, mm (sign is ignored)
 *           step    between the frames, rad, above 0 up to pi
 *           near, far  distances from the axis of two things in the middle of the overlap, mm,
 *                      offset < near <= far, far may be inf
 * Result    rad: how much the near one moves against the far one; times pixels per radian = pixels
 * Formula   2 (b(near) - b(far)), tan b(D) = e sin(step/2)/(D - e cos(step/2))
 * Source    Littlefield, Theory of the No-Parallax Point (2006); Hugin manual, Parallax
 * Errors    near within the circle of the pupil; far before near
 */
bool panorama_parallax(double offset, double step, double near, double far, double *parallax,
                       struct error *error);

/* The offset, mm, at which `near` moves by `parallax` rad (above 0, below pi - step) against inf.
 */
bool panorama_offset(double parallax, double step, double near, double *offset,
                     struct error *error);

/* The nearest distance, mm, at which `offset` gives no more than `parallax` against infinity. */
bool panorama_nearest(double offset, double parallax, double step, double *near,
                      struct error *error);

/*
 * Where the entrance pupil lies: the distance to put between it and the sensor mark on the rail.
 *
 * Given     f > 0 mm, m >= 0, P > 0, hiatus from H to H', mm
 * Result    entrance pupil before the sensor, mm
 * Formula   f (1 + m) + hiatus + f (1 - 1/P): sensor to H, and the pupil f (1 - 1/P) before H
 * Errors    ranges
 */
bool panorama_pupil(double f, double m, double P, double hiatus, double *distance,
                    struct error *error);

#endif
