/* analysis/rays/distortion.h - where exact chief rays meet the image, against an ideal projection. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_DISTORTION_H
#define LENSCALC_ANALYSIS_RAYS_DISTORTION_H

#include "analysis/setup/setup.h"
#include "base/arena.h"
#include "base/error.h"
#include "photo/fov.h"
#include "trace/aim/beam.h"
#include "trace/system.h"

#include <stdbool.h>

/* A lens at one wavelength and the projection it is compared with. */
struct distortion_map {
    struct setup setup;         /* at that wavelength alone, with its image plane */
    enum projection projection; /* of an object at infinity; of a near one rectilinear */
    double scale;               /* image height of the projection's 1: mm, a focal length; of a
                                    near object the magnification. May be set anew */
    double squeeze;             /* the same along x over that along y: 1 but with cylinders */
    const struct system *open;  /* internal: no surface clips */
    const struct system *image; /* the same as far as the image plane */
    const struct system *lit;   /* the same with clear apertures, but for what stands within */
};

/* One field point. Heights lie along the direction of the field; upwards, or along +x. */
struct distortion_point {
    double field;    /* the angle from the axis, rad, of an object at infinity, else its height */
    double ideal;    /* where the projection images it, mm */
    double height;   /* where the chief ray meets the image plane, mm */
    double image[2]; /* the same, x and y */
    double percent;  /* 100 (height - ideal)/ideal; NaN on the axis */
    bool is_lit;     /* no clear aperture stops the chief ray */
};

/*
 * Make a lens ready.
 *
 * Given     setup       with its image plane (setup_place_image)
 *           wavelength  its place in the list
 *           arena       for what the map points to
 * Result    scale: |n| f, f the focal length in any media; of a near object its paraxial
 *           magnification; in the y section, with its squeeze in x. At the primary wavelength:
 *           what others are off is lateral colour
 * Errors    ERROR_DOMAIN: no image plane, no stop; an afocal lens with an object at infinity, a
 *           near object with an image at infinity, or with another projection than the rectilinear;
 *           as setup_system
 */
bool distortion_open(const struct setup *setup, size_t wavelength, enum projection projection,
                     struct arena *arena, struct distortion_map *map, struct error *error);

/*
 * The distortion of one field.
 *
 * Given     field  as setup_beam
 * Formula   percent = 100 (y - yp)/yp, yp = scale g(t), g the projection (fov_height), t the angle
 *           of the chief ray with the axis before the lens; of a near object of height h: yp =
 *           scale h. y where the ray through the centre of the stop meets the image plane
 * Source    [Welford86]; tests/truth/check_distortion.py has the values of an independent
 *           program of 50 digits
 * Errors    ERROR_DOMAIN: no chief ray reaches the stop or the image; a field beyond the
 *           projection; as setup_beam
 */
bool distortion_at(const struct distortion_map *map, const struct field_point *field,
                   struct distortion_point *point, struct error *error);

/*
 * The same towards a direction.
 *
 * Given     towards  x, y in the object, of unit length
 *           amount   the angle from the axis, rad, or the height of a near object, mm
 */
bool distortion_towards(const struct distortion_map *map, const double towards[2], double amount,
                        struct distortion_point *point, struct error *error);

/* The direction of a field, of unit length, and how far out it is, as distortion_towards has it. */
bool distortion_direction(const struct distortion_map *map, const struct field_point *field,
                          double towards[2], double *amount, struct error *error);

/*
 * Where the object point is imaged that the projection images at a place: one point of a grid.
 *
 * Given     ideal  x, y in the image, mm
 *           image  receives x and y of its chief ray, mm
 * Errors    as distortion_at; a place beyond the edge of the projection
 */
bool distortion_of_ideal(const struct distortion_map *map, const double ideal[2], double image[2],
                         struct error *error);

/* Distortion of a rectangular picture, of 1: positive where its corners stretch. */
struct tv_distortion {
    double smia;        /* how much higher its sides are than its middle, over its middle */
    double traditional; /* how far its long edges are bent, over its height: half of that */
};

/*
 * TV distortion.
 *
 * Given     half  half the width and height of the ideal picture, mm, above 0
 * Formula   smia = ((A1 + A2)/2 - B)/B: A1, A2 the heights of the left and the right side between
 *           the images of the corners, B the height in the middle
 * Source    [Imatest22], TV distortion: that of SMIA's specification, and half of it
 * Errors    as distortion_of_ideal
 */
bool tv_distortion_find(const struct distortion_map *map, const double half[2],
                        struct tv_distortion *tv, struct error *error);

/*
 * The calibrated focal length: that which makes the distortion as large towards both signs.
 *
 * Given     edge   how far the field goes that it is to balance
 *           scale  receives it, as map->scale; of a near object the magnification
 * Formula   q = y/g(t) from the axis to the edge: (q_min + q_max)/2, whose largest and smallest
 *           percentage are equal and opposite; the extremes of 33 fields, then closer about them
 * Source    photogrammetry balances distances in the image so; here it is percentages. Derived
 *           here: (q - s)/s is s's own mirror image at q_min and q_max for s half-way
 * Errors    as distortion_at, of any field from the axis to the edge; the edge lies on the axis
 */
bool distortion_calibrate(const struct distortion_map *map, const struct field_point *edge,
                          double *scale, struct error *error);

#endif
