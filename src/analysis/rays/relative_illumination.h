/* analysis/rays/relative_illumination.h - light over the image: its fall towards the edge, and vignetting. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_RELATIVE_ILLUMINATION_H
#define LENSCALC_ANALYSIS_RAYS_RELATIVE_ILLUMINATION_H

#include "analysis/rays/illumination.h"
#include "analysis/setup/setup.h"
#include "trace/pupil/pupil_islands.h"

/* A lens at one wavelength, with the light in the middle of its image. */
struct relative_illumination {
    struct setup setup;      /* with the stop that was asked for */
    struct setup_near *near; /* the height looked at last; internal */
    double error;
    bool clip, no_field, no_vignetting, no_islands;
    double chief_end; /* mm from the axis: chief rays of heights beyond are not searched */
    /* reversed: all apertures, none, the stop alone; forward: all, none */
    const struct system *film, *film_open, *film_stop, *field, *field_open;
    struct first_order first;       /* at that wavelength */
    struct illumination axis;       /* of the film */
    struct illumination axis_field; /* by the rays of the object point there; NaN: none */
};

struct relative_illumination_question {
    const struct setup *setup;    /* with its image plane; must outlive the falloff */
    size_t wavelength;            /* its place in the list */
    double stop_diameter;         /* mm, in place of that of the setup; NaN = that */
    double error;                 /* relative, of each integral */
    bool clip;                    /* apertures take light; else the stop alone does */
    bool no_field, no_vignetting; /* relative_field and vignetted are not wanted: NaN */
    bool no_islands;              /* light beyond gaps is not looked for */
};

/*
 * Make a lens ready.
 *
 * Errors    ERROR_DOMAIN: no stop, no diameter of it, one beyond its own; a telecentric object
 *           space; no image plane, one in the last vertex, or one before it that no light reaches
 */
bool relative_illumination_open(const struct relative_illumination_question *question,
                                struct relative_illumination *falloff, struct error *error);

/* Search for the chief rays of heights from that of this one on, mm: all as if it was the last. */
void relative_illumination_begin(const struct relative_illumination *falloff,
                                 const double height[2]);

/* The same for another thread, which remembers no height but that of relative_illumination_begin:
   its memory is
   `arena`. */
struct relative_illumination
relative_illumination_apart(const struct relative_illumination *falloff, struct arena *arena);

/*
 * How far chief rays come, for heights of one drawing: a search that fails takes long, and farther
 * out it fails again.
 *
 * Given     end    the last of the heights, mm; count of even parts from the axis to it
 * Result    to be kept in chief_end: infinite if the last has one, else midway between a height
 *           that has and the next that has none, found by halving; 0 where none is found
 * Limits    a chief ray that comes back farther out is not seen
 */
double relative_illumination_chief_end(const struct relative_illumination *falloff,
                                       const double end[2], size_t count);

/* A point of the image. */
struct relative_illumination_point {
    double height[2];          /* x, y in the image plane, mm */
    double angle;              /* of the light before the lens from the axis, of the chief ray that
                                  comes here, rad; NaN: there is none */
    struct illumination light; /* E/L */
    double relative_point;     /* over that on the axis */
    double relative_field;     /* the same by the rays of the object point; NaN: no chief ray */
    double vignetted;          /* share of what the stop alone would let pass that apertures take */
    double point_error, field_error, vignetted_error; /* of these three */
    bool is_field_met; /* the light by the rays of the object point is what was asked for */
    double cos4;       /* cos^4 of the angle; NaN without one */
    struct pupil_islands
        islands; /* light beyond a gap in the exit pupil, that `light` leaves out */
};

/*
 * The light in a point of the image plane, and that of the object point whose chief ray comes here.
 *
 * Formula   analysis/rays/illumination.h; the chief ray by setup_beam. Errors of quotients: the
 * sum of
 *           the relative errors of both
 */
struct relative_illumination_point
relative_illumination_at(const struct relative_illumination *falloff, const double height[2]);

/*
 * Where the chief ray of a field meets the image plane.
 *
 * Errors    as setup_beam and aim_open; ERROR_DOMAIN: the chief ray is lost
 */
bool relative_illumination_height(const struct relative_illumination *falloff,
                                  const struct field_point *field, double height[2],
                                  struct error *error);

#endif
