/* draw/wedge.h - side view of a tilted lens and its wedge of sharpness, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_WEDGE_H
#define LENSCALC_DRAW_WEDGE_H

#include <stdbool.h>

struct error;
struct svg;

/* The page, px. */
#define WEDGE_WIDTH  1000.0
#define WEDGE_HEIGHT 620.0

/*
 * A camera and its planes of sharpness, mm. The centre of the lens is the origin, u goes to the
 * subject along the sensor's normal, y goes up; each plane is a line A u - B y = f.
 */
struct wedge {
    const char *title, *subtitle; /* null = none */
    double f;                     /* focal length, > 0 */
    double tilt;                  /* of the lens against the sensor, rad, -pi/2 .. pi/2 */
    double image;                 /* lens to sensor along u, > 0 */
    double hinge;                 /* depth of the hinge line below the lens; +-inf untilted */
    double scheimpflug;           /* depth of the Scheimpflug line, likewise */
    double A, A_near, A_far, B;   /* A_far <= A <= A_near */
    double sensor_height;         /* > 0 */
    double sensor_centre;         /* y of the sensor's middle */
    double lens_diameter;         /* > 0 */
    double depth;                 /* how far to draw; 0 = chosen here */
};

/*
 * Draw the side view as a whole SVG document into `svg`, which must be empty: the scene to scale
 * with lens plane, sensor plane, hinge line, Scheimpflug line, plane of sharp focus and the wedge
 * between near and far limit, with heights and distances in metres; beside it the camera enlarged
 * and a legend with the numbers.
 *
 * Result    One scale for both directions, so that angles are true. Without a depth the view
 *           reaches past the sharp point straight ahead, or past where the near limit crosses the
 *           horizon, and holds the hinge line if that is not much farther away than the scene is
 *           deep; a line outside the view is named in the legend only
 * Errors    a number that is not finite (but for hinge and Scheimpflug line) or out of its range
 * Source    the figure follows [Merklinger96]
 */
bool wedge_draw(const struct wedge *wedge, struct svg *svg, struct error *error);

#endif
