/* optics/aperture.h - the shapes that let light pass a surface or block it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_APERTURE_H
#define LENSCALC_OPTICS_APERTURE_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/surface.h"

#include <stdbool.h>
#include <stddef.h>

/* A shape is a row of aperture_shapes: a new one is an enumerator, a row and its functions. */
enum aperture_shape {
    SHAPE_CIRCLE,
    SHAPE_RING, /* between two circles */
    SHAPE_RECTANGLE,
    SHAPE_ELLIPSE,
    SHAPE_POLYGON,
    SHAPE_SPIDER, /* arms of one width, outwards from the centre without end */
    APERTURE_SHAPES
};

/*
 * An aperture of a surface, in the frame of its vertex: x, y of the point where light meets it. A
 * ray passes the surface if it meets it within every aperture that passes and outside of every one
 * that blocks; an edge itself lets pass.
 */
struct aperture {
    enum aperture_shape shape;
    bool blocks;
    struct figure size[2];     /* full: diameters (inner, outer), widths along x, y, mm */
    unsigned arms;             /* of a spider; the first one along x */
    struct figure decenter[2]; /* of its centre from the vertex, x, y, mm */
    struct figure turn;        /* about its centre, from x towards y, rad */
    /*
     * Of a polygon: x, y from its centre, mm. A side that it goes along twice, there and back,
     * bounds nothing and is no edge: one polygon may have several parts, and holes.
     */
    const struct figure (*points)[2];
    size_t point_count;
};

/* Numbers of an aperture, ready to be asked. */
struct aperture_form {
    enum aperture_shape shape;
    bool blocks;
    double half[2], centre[2]; /* mm */
    double cosine, sine;       /* of the turn */
    double radius;             /* no point of it is farther from its centre, mm; may be infinite */
    const double (*points)[2]; /* of a polygon its corners; of a spider where its arms point to */
    size_t point_count;
    const bool *seams; /* of a polygon: the sides that are no edge; null = there are none */
    /* squared: nearer to the centre than the first all is inside, farther than the second outside;
       0 where that is not known */
    double within2, beyond2;
};

struct aperture_traits {
    const char *word;     /* in .lens files and JSON */
    const char *sizes[2]; /* what its sizes are, for messages; null = has none */
    bool has_points;
    bool has_arms;
    bool only_blocks;
    /* of a point from the centre, unturned: aperture_excess; and aperture_part */
    double (*excess)(const struct aperture_form *form, double x, double y);
    size_t (*part)(const struct aperture_form *form, double x, double y);
};
extern const struct aperture_traits aperture_shapes[APERTURE_SHAPES];

/* The sizes that a shape has: 0, 1 or 2. */
int aperture_sizes(enum aperture_shape shape);

/*
 * Is it sound?
 *
 * Errors    ERROR_DATA, without the number of the surface: a size of 0 and less, a ring whose inner
 *           circle is not the smaller, less than three corners, a polygon without area, more than
 *           APERTURE_MOST_CORNERS of them or APERTURE_MOST_CROSSINGS of its sides, no arms or more
 *           than APERTURE_MOST_ARMS, numbers beyond 1e100, a shape that only blocks passing
 */
bool aperture_check(const struct aperture *aperture, struct error *error);
enum { APERTURE_MOST_ARMS = 64, APERTURE_MOST_CORNERS = 4096, APERTURE_MOST_CROSSINGS = 100 };

/* Is it the same in all directions about the axis of the surface? */
bool aperture_is_round(const struct aperture *aperture);

/*
 * How far from the vertex light may pass a surface, mm: half its diameter, or less by the
 * apertures that pass; infinite where neither says so.
 */
double aperture_reach(const struct surface *surface);

/* An aperture with no sizes, no turn, about the vertex. */
struct aperture aperture_of(enum aperture_shape shape, bool blocks);

struct aperture_form aperture_form_of(const struct aperture *aperture, struct arena *arena);

/*
 * The least convex shape about one that passes: of a ring its outer circle, of a polygon its hull.
 */
struct aperture_form aperture_hull(const struct aperture *aperture, struct arena *arena);

/*
 * How far a point of the surface is beyond the edge of the shape: 0 and less within it.
 *
 * Given     x, y  from the vertex, mm
 * Result    relative to the size, continuous: of a circle r^2/a^2 - 1, of an ellipse likewise, of a
 *           rectangle max(|x|/a, |y|/b) - 1, of a ring that of the edge which is nearer to be
 *           crossed, of a polygon the distance from its edge over its radius, of a spider that over
 *           half the width of an arm; NaN of NaN
 */
double aperture_excess(const struct aperture_form *form, double x, double y);

/* Which smooth piece of the edge decides there: a side, an arm; from 0. */
size_t aperture_part(const struct aperture_form *form, double x, double y);

/* Does a ray that meets the surface there pass? */
static inline bool aperture_passes(const struct aperture_form *form, double x, double y)
{
    if (form->within2 > 0) { /* most rays need no look at the sides */
        const double dx = x - form->centre[0], dy = y - form->centre[1], r2 = dx * dx + dy * dy;
        if (r2 < form->within2 || r2 > form->beyond2) {
            return (r2 < form->within2) != form->blocks;
        }
    }
    double excess = aperture_excess(form, x, y);
    return form->blocks ? excess >= 0 : excess <= 0;
}

#endif
