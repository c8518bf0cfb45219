/* analysis/layout/layout.h - where a lens's glass, its rays and its cardinal points lie in a section. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_LAYOUT_LAYOUT_H
#define LENSCALC_ANALYSIS_LAYOUT_LAYOUT_H

#include "analysis/setup/setup.h"
#include "base/name_table.h"

#include <stdbool.h>
#include <stddef.h>

/* What a part is; those later in the list are drawn over the earlier ones. */
enum layout_kind {
    LAYOUT_ELEMENT,  /* the closed outline of a piece of glass */
    LAYOUT_AXIS,     /* dash-dotted */
    LAYOUT_AXIAL,    /* a ray from the axial object point */
    LAYOUT_OBLIQUE,  /* a ray from another field */
    LAYOUT_CHIEF,    /* the one through the middle of the stop */
    LAYOUT_GAUSS,    /* a ray of the construction with the cardinal points */
    LAYOUT_EXTENDED, /* its extension to where it is not */
    LAYOUT_ARROW,    /* object or image; the last point is the tip */
    LAYOUT_HATCH,    /* strokes behind a mirror */
    LAYOUT_MIRROR,
    LAYOUT_BLOCK, /* along a surface, where an aperture blocks light */
    LAYOUT_STOP,
    LAYOUT_IMAGE,
    LAYOUT_PLANE, /* a principal plane, from bottom to top */
    LAYOUT_PUPIL, /* likewise a pupil */
    LAYOUT_POINT, /* a point on the axis */
    LAYOUT_KINDS
};

/* A line in mm: z along the axis to the right, y up; broken where a coordinate is NaN. */
struct layout_part {
    enum layout_kind kind;
    size_t glass; /* of an element: index of its glass */
    size_t field; /* of an oblique or chief ray: index of its field */
    const double *z, *y;
    size_t count;
    const char *label; /* null = none; above a plane, pupil or image, below a point */
};

/* A piece of glass, from its first surface to the next. */
struct layout_element {
    size_t surface, glass; /* index of the surface in front; of the glass */
    double z, low;         /* where a label points to: middle of its rim below, mm */
};

/* Where a surface stands: its vertex, and the angle of its axis (rad, up from z). */
struct layout_frame {
    double z, y, angle;
};

/* A cross-section; everything in the arena. Lengths in mm, z from the first vertex. */
struct layout {
    struct layout_part *parts;
    size_t part_count;
    const char **glasses; /* names */
    size_t glass_count;
    struct layout_element *elements; /* from the first surface to the last */
    size_t element_count;
    const char **fields; /* of which oblique rays are drawn, from the axis to the edge */
    size_t field_count;
    const char **notes; /* what is to be said beside it, a line each */
    size_t note_count;
    /* internal to analysis/layout/layout*.c */
    const struct setup *setup;
    size_t wavelength; /* its place in the setup */
    const struct setup_light *light;
    struct arena *arena;
    size_t part_room;
    struct name_table glass_names;
    /* one a surface */
    double *vertex, *semi;                 /* along the axis, as if it went on straight */
    struct layout_frame *frames, *axis;    /* of the surface itself; of the axis there */
    bool is_centred;                       /* no decentre, tilt or coordinate break */
    bool *is_drawn;                        /* false: a plane in air that bends no ray */
    double *direction;                     /* in which light arrives: 1 or -1 */
    double size;                           /* the largest semi-diameter drawn */
    double left, right;                    /* of what is drawn of the lens itself */
    double image;                          /* the image plane; NaN = none within reach */
    double light_direction;                /* in which light leaves: 1 or -1 */
    struct paraxial_ray *marginal, *chief; /* one a surface; NaN where there is no such ray */
};

/* What a section shows besides the lens. */
struct layout_request {
    size_t wavelength;               /* its place in the setup's list */
    const struct setup_light *light; /* the setup there */
    bool planes;                     /* principal planes, focal points and pupils */
    bool construction; /* the Gauss rays of the equivalent lens in place of bundles and image */
    bool no_rays;
    const double *heights; /* of rays in other positions, one a surface, mm; null: there is one */
};

/* Has the lens neither decentres, tilts nor coordinate breaks? */
bool layout_is_centred(const struct lens *lens);

/*
 * The image plane that a section shows: that of the lens; where its axis is not straight, the
 * table's, which lies on the folded axis as the paraxial one does not.
 */
enum plane_kind layout_plane(const struct lens *lens);

/*
 * Lay out a lens: glass, mirrors, stop, axis and image plane, the beam of the axis and the bundle
 * of each field as its clear apertures let them pass.
 *
 * Given     setup       with its image plane (setup_place_image by layout_plane)
 *           request     planes and construction are for centred lenses
 * Result    what could not be shown is in the notes
 * Errors    ERROR_DOMAIN: a surface without a diameter that no ray gives one; nothing to draw; a
 *           construction of an afocal lens or of an odd number of mirrors; as system_compile
 */
bool layout_make(const struct setup *setup, const struct layout_request *request,
                 struct arena *arena, struct layout *layout, struct error *error);

/* Does the lens say how wide every surface is that is drawn? */
bool layout_states_diameters(const struct lens *lens);

/*
 * How high the exact rays of the axis and of all fields reach that the stop and the diameters that
 * are stated let pass: at least as far as their outermost rays in and across the section.
 *
 * Given     setup, request, arena  as layout_make
 *           heights  one a surface, mm: raised to what is reached
 * Result    false: the lens states nothing that limits a beam, or its rays cannot be compiled
 */
bool layout_ray_heights(const struct setup *setup, const struct layout_request *request,
                        struct arena *arena, double *heights);

/* -------- internal to analysis/layout/layout*.c -------- */
/* -------- analysis/layout/layout_parts.c -------- */

/* A part with room for `count` points. */
struct layout_part *layout_add(struct layout *layout, enum layout_kind kind, size_t count,
                               double **z, double **y);
struct layout_ends {
    double z1, y1, z2, y2;
};
void layout_line(struct layout *layout, enum layout_kind kind, struct layout_ends ends,
                 const char *label);
void layout_note(struct layout *layout, const char *note);

/* -------- analysis/layout/layout_diameters.c -------- */

/* Sag in the section drawn, mm. */
double layout_sag(const struct layout *layout, size_t surface, double r);

/* Glass between this surface and the next: is there a piece to draw? */
bool layout_has_element(const struct layout *layout, size_t surface);

/* Thickness of the glass after a surface, both surfaces continued to r. */
double layout_thickness(const struct layout *layout, size_t i, double r);

/* Semi-diameters of all surfaces. Errors as layout_lens */
bool layout_find_diameters(struct layout *layout, const struct layout_request *request,
                           struct error *error);

/* -------- analysis/layout/layout_lens.c -------- */

/* From where a ray met the surface to where it leaves: 0, or from H to H' of a thick lens. */
static inline double layout_hiatus(const struct layout *layout, size_t surface)
{
    return surface_hiatus(&layout->setup->lens->surfaces[surface]).hi;
}

/* Where what lies behind the lens is counted from: the last vertex, or H' of a thick lens there. */
static inline double layout_rear(const struct layout *layout)
{
    size_t last = layout->setup->lens->surface_count - 1;
    return layout->vertex[last] + layout_hiatus(layout, last);
}

/*
 * Places, diameters, elements, mirrors, stop and image plane.
 *
 * Limits    parts decentred, tilted and behind coordinate breaks stand where they are in the plane
 *           of the drawing; what goes out of it is left out, with a note.
 *           a surface without a diameter gets the height of the exact rays of all fields, of the
 *           paraxial marginal plus chief ray where there are none, less where its glass would end
 *           or the sag does
 * Errors    ERROR_DOMAIN: a surface without a diameter that no ray gives one
 */
bool layout_lens(struct layout *layout, const struct layout_request *request, struct error *error);

/* -------- analysis/layout/layout_rays.c -------- */

/*
 * The beam of the point on the axis and the bundle of each field, all exact: their outermost rays
 * that all clear apertures let pass, and the chief ray.
 *
 * Limits    of more than six fields six are drawn, the farthest among them
 * Errors    as system_compile
 */
bool layout_rays(struct layout *layout, struct error *error);

#endif
