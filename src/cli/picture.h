/* cli/picture.h - a lens as parts of a cross-section, for lenscalc draw. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_PICTURE_H
#define LENSCALC_CLI_PICTURE_H

#include "commands/lens/lens_options.h"
#include "report/section.h"

#include <stdbool.h>
#include <stddef.h>

/* Where a surface stands in the drawing: its vertex, and the angle of its axis (rad, up from z). */
struct picture_frame {
    double z, y, angle;
};

/* A cross-section being made; everything in the arena. Lengths in mm, z from the first vertex. */
struct picture {
    const struct lens_case *one;
    struct arena *arena;
    struct section_part *parts;
    size_t part_count, part_room;
    const char **glasses, **notes;
    size_t glass_count, note_count;
    /* one a surface */
    double *vertex, *semi;                 /* along the axis, as if it went on straight */
    struct picture_frame *frames, *axis;   /* of the surface itself; of the axis there */
    bool is_centred;                       /* nothing is decentred, tilted or bent */
    bool *is_drawn;                        /* false: a plane in air that bends no ray */
    double *direction;                     /* in which light arrives: 1 or -1 */
    double size;                           /* the largest semi-diameter drawn */
    double left, right;                    /* of what is drawn of the lens itself */
    double image;                          /* the image plane; NaN = none within reach */
    double heading;                        /* in which light leaves: 1 or -1 */
    struct paraxial_ray *marginal, *chief; /* one a surface; NaN where there is no such ray */
};

/* A part with room for `count` points. */
struct section_part *picture_part(struct picture *picture, enum section_kind kind, size_t count,
                                  double **z, double **y);
void picture_line(struct picture *picture, enum section_kind kind, double z1, double y1, double z2,
                  double y2, const char *label);
void picture_note(struct picture *picture, const char *note);

/* From the straight axis to the drawing: a point that belongs to a surface. */
void picture_put(const struct picture *picture, size_t surface, double *z, double *y);

/* Sag in the section drawn. */
double picture_sag(const struct picture *picture, size_t surface, double r);

/* From where a ray met the surface to where it leaves: 0, or from H to H' of a thick lens. */
static inline double picture_hiatus(const struct picture *picture, size_t surface)
{
    const struct surface *one = &picture->one->lens->surfaces[surface];
    return one->kind == SURFACE_THICK ? one->hiatus.value.hi : 0;
}

/* Where what lies behind the lens is counted from: the last vertex, or H' of a thick lens there. */
static inline double picture_rear(const struct picture *picture)
{
    size_t last = picture->one->lens->surface_count - 1;
    return picture->vertex[last] + picture_hiatus(picture, last);
}

/* -------- cli/picture_lens.c -------- */

/*
 * Places, diameters, elements, mirrors, stop and image plane.
 *
 * Limits    decentred, tilted and bent parts stand where they are in the plane of the drawing; what
 *           goes out of it is left out, with a note.
 *           a surface without a diameter gets the height of marginal plus chief ray, less where
 *           its glass would end or the sag does
 * Errors    ERROR_DOMAIN: a surface without a diameter that no ray gives one
 */
bool picture_lens(struct picture *picture, struct error *error);

/* -------- cli/picture_rays.c -------- */

/*
 * The beam of the point on the axis and the bundle from the edge of the field, both exact: their
 * outermost rays that all rims let pass, and the chief ray.
 *
 * Errors    as system_compile
 */
bool picture_rays(struct picture *picture, struct error *error);

/* Best focus of the exact rays on the axis, behind the last vertex; NaN = none. */
double picture_focus(const struct picture *picture);

/* -------- cli/picture_planes.c -------- */

/* Focal points, principal planes and pupils; those far outside are only noted. */
void picture_planes(struct picture *picture, bool with_pupils);

/*
 * The three Gauss rays of the equivalent lens: parallel to the axis, through F, through N and N'.
 *
 * Errors    ERROR_DOMAIN: an afocal lens; an odd number of mirrors
 */
bool picture_construction(struct picture *picture, struct error *error);

#endif
