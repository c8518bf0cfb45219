/* trace/aim/beam.h - the rays of one object point, named by two coordinates. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_BEAM_H
#define LENSCALC_TRACE_AIM_BEAM_H

#include "base/error.h"
#include "optics/first_order.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>

/*
 * A bundle of rays from one point. Every ray crosses the plane through the first vertex at right
 * angles to `axis` at a across[0] + b across[1]; so nothing is special about 90 degrees, about
 * telecentric lenses, or about objects very far or very near.
 */
struct beam {
    double axis[3];      /* unit: from the object to the first vertex, along the light */
    double across[2][3]; /* unit: sagittal (a), and meridional (b, upwards on the axis) */
    double distance;     /* object to first vertex, mm; infinite; negative for a virtual object */
    double foot[3];      /* in place of the first vertex, mm: that of beam_to_pupil, else 0 */
    double n;            /* index of the object space */
};

/* A field point. */
struct field_point {
    enum field_kind kind; /* FIELD_NONE: on the axis */
    double value[2];      /* x, y: rad, or mm at the object or at the paraxial image */
};

/*
 * The beam of an object infinitely far away.
 *
 * Given     angle  x, y, rad: of one alone light goes along (0, sin y, cos y), below pi; of both,
 *                  below pi/2, along (tan x, tan y, 1)
 */
struct beam beam_from_infinity(const double angle[2], double n);

/* The same of a direction of the light, of unit length. */
struct beam beam_along(const double direction[3], double n);

/*
 * The beam of a point.
 *
 * Given     point  mm, in the frame of the first vertex; z above 0: virtual, the rays aim at it
 * Errors    ERROR_DOMAIN: the point is the first vertex itself
 */
bool beam_from_point(const double point[3], double n, struct beam *beam, struct error *error);

/*
 * The beam of a point of the image side, for a system compiled with `reverse`.
 *
 * Given     point  mm, in the frame of the last vertex, z above 0
 *           n      index of the image space
 */
struct beam beam_from_film(const double point[3], double n);

/*
 * The same with its axis towards the paraxial exit pupil, and its plane through the point of it
 * beside the last vertex: a film that is close to the lens sees all of the pupil to that side.
 *
 * Given     point  mm, in the frame of the last vertex
 *           pupil  its z there, mm; may be infinite
 */
struct beam beam_to_pupil(const double point[3], double pupil, double n);

/*
 * The beam of a field point of a lens.
 *
 * Given     field   angle: that of the chief ray as seen from the first vertex, for a near object
 *                   too; height: of the object; image: height of the paraxial image
 *           object  where the object is
 *           first   of the lens at the primary wavelength: image heights need it
 * Formula   paraxial image height y' from infinity: tan t = y' n'/(n f') = -y' c/n of the matrix;
 *           from near: object height y'/m
 * Errors    ERROR_DOMAIN: an object height of an object at infinity, an image height of an afocal
 *           lens, angles of 180 degrees or more, of 90 and more for a near object or where there
 *           is one in x and one in y; a height of the real image, which wants the whole lens:
 *           setup_beam
 */
bool beam_of_field(const struct field_point *field, const struct conjugate_object *object,
                   const struct first_order *first, struct beam *beam, struct error *error);

/*
 * The ray with coordinates a, b, mm, started on the plane of the beam.
 *
 * Result    path: from infinity counted from the wave front through the first vertex, which is
 *           this plane: 0; from a point, less the way to the first vertex:
 *           n r^2/(sqrt(d^2 + r^2) + d), which keeps its digits however far the object is
 */
struct ray beam_ray(const struct beam *beam, double a, double b);

/*
 * How the start of a ray changes with its coordinates: the derivative of beam_ray.
 *
 * Given     at  the coordinates; k: 0 = by the first of them, 1 = by the second
 * Result    of the point, mm/mm, and of n times the direction cosines, 1/mm
 */
void beam_slope(const struct beam *beam, const double at[2], int k, double point[3],
                double direction[3]);

/* The same for up to RAYS_BLOCK rays at once, into the first lanes of a block: the same bits. */
void beam_fill(const struct beam *beam, const double (*at)[2], size_t count,
               struct ray_block *block);

/* The same with the coordinates in two arrays, which is faster. */
void beam_start(const struct beam *beam, const double *a, const double *b, size_t count,
                struct ray_block *block);

/*
 * How rays start to change that are moved along the plane of the beam: beam_slope of a block.
 *
 * Given     way   by how much of the two coordinates
 *           rays  where they start
 */
void beam_tangents(const struct beam *beam, const double way[2], const struct ray_block *rays,
                   size_t count, struct ray_block *tangents);

/* The coordinates where a line meets the plane of the beam: point + t cosine. */
void beam_place(const struct beam *beam, const double at[3], double place[2]);

/* See beam_start. */
typedef void kernel_beam(const struct beam *beam, const double *a, const double *b, size_t count,
                         struct ray_block *block);
kernel_beam kernel_beam_sse2, kernel_beam_avx2, kernel_beam_avx512;

#endif
