/* optics/lens.h - a lens as its maker writes it down: surfaces, stop, fields, positions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_LENS_H
#define LENSCALC_OPTICS_LENS_H

#include "base/arena.h"
#include "base/error.h"
#include "base/pair.h"
#include "base/text.h"
#include "optics/medium.h"

#include <stdbool.h>
#include <stddef.h>

enum { LENS_COEFFICIENTS = 10 };
#define LENS_NONE ((size_t)-1) /* no surface, no variable */

/* A number of a prescription. */
struct figure {
    struct pair value; /* lengths in mm, angles in rad */
    struct text typed; /* its digits in the file's unit; start is null where it was computed */
    size_t variable;   /* index of the variable that stands for it, LENS_NONE if it is a number */
};

enum surface_kind {
    SURFACE_REFRACT,
    SURFACE_REFLECT,
    SURFACE_STOP, /* a plane of its own that only limits the rays */
    SURFACE_THICK /* a thick lens: its vertex is H, and what follows is counted from H' */
};

enum curved { CURVED_BOTH, CURVED_X, CURVED_Y }; /* a cylinder is curved in one section only */

/* A shift and turns, about the vertex: shift, then about x, the new y, the new z. */
struct displacement {
    struct figure decenter[2]; /* x, y, mm */
    struct figure tilt[3];     /* about x, y, z, rad */
};

/* A number that the designer may change. */
struct vary {
    struct text what; /* "R", "t", "glass" */
    bool has_bounds;
    struct figure low, high;
};

struct surface {
    enum surface_kind kind;
    enum curved curved;
    bool is_stop;  /* the aperture stop lies here */
    bool is_plane; /* no radius; a curvature may still be given, or A2 */
    bool has_curvature;
    bool has_thickness; /* false only at the last surface of a file that states no distance */
    bool has_diameter;
    struct figure radius, curvature; /* as given: mm, 1/mm; centre to the right is positive */
    struct figure thickness;         /* to the next vertex, mm; negative after a mirror */
    struct figure focal;             /* of a thick lens: 1/power, mm */
    struct figure hiatus;            /* of a thick lens: from H to H', mm */
    struct figure distortion[3];     /* of a thick lens: optics/thick_lens */
    struct figure diameter;          /* full clear aperture, mm */
    struct figure conic;             /* k */
    unsigned coefficients;           /* bit i: coefficient[i] was given */
    struct figure coefficient[LENS_COEFFICIENTS]; /* A2, A4 ... A20, mm^(1 - order) */
    struct medium medium;                         /* after the surface */
    const struct displacement *moved;             /* this surface only; null = centred */
    const struct displacement *bend;              /* of the axis before it; null = none */
    const struct vary *varies;
    size_t vary_count;
    const char *name; /* null = none */
};

struct lens_wavelength {
    double wavelength; /* um */
    struct text typed; /* "d", "587.56nm" */
    double weight;     /* 1 unless given */
    struct text weight_typed;
};

enum field_kind { FIELD_NONE, FIELD_ANGLE, FIELD_HEIGHT, FIELD_IMAGE };
enum aperture_kind { APERTURE_NONE, APERTURE_STOP, APERTURE_FNUMBER, APERTURE_EPD, APERTURE_NA };
enum focus_kind { FOCUS_PARAXIAL, FOCUS_TABLE, FOCUS_BEST };

/* A word that stands for one number in every position. */
struct lens_variable {
    struct text name;
    const struct figure *values; /* one a position */
};

/* What the source says the lens has; one value a position, or none. */
enum { STATED_EFL, STATED_BFL, STATED_FNUMBER, STATED_COUNT };

struct lens {
    const char *title, *source, *kind; /* null = not said */
    const char **notes;
    size_t note_count;
    const char *unit; /* "mm": of the typed lengths */
    struct lens_wavelength *wavelengths;
    size_t wavelength_count; /* 0: the file names none, d is meant */
    bool object_is_infinite;
    struct figure object; /* distance to the left of the first vertex, mm, if it is finite */
    struct medium object_medium;
    enum field_kind field_kind;
    struct figure *fields; /* rad, or mm */
    size_t field_count;
    enum aperture_kind aperture_kind;
    struct figure aperture;
    enum focus_kind focus;
    struct surface *surfaces;
    size_t surface_count;
    size_t stop; /* index of the surface that is or bears the stop; LENS_NONE */
    const char **positions;
    size_t position_count; /* 0: there is only one, without a name */
    struct lens_variable *variables;
    size_t variable_count;
    const struct figure *objects;   /* let object: one a position, inf is infinite; or null */
    const struct figure *apertures; /* let aperture: of the kind aperture_kind; or null */
    const struct figure *stated[STATED_COUNT]; /* null = not stated */
    size_t stated_count[STATED_COUNT];         /* 1 or one a position */
};

/*
 * The lens in one of its positions: variables replaced by their numbers.
 *
 * Given     position  0 .. position_count - 1; 0 where the lens has only one
 */
const struct lens *lens_at_position(const struct lens *lens, size_t position, struct arena *arena);

/* The position of this name; LENS_NONE if there is none. */
size_t lens_position_find(const struct lens *lens, struct text name);

/* The curvature at the vertex in the y-z (or x-z) section, 1/mm, with 2 A2; 0 is a plane. */
enum lens_section { SECTION_Y, SECTION_X };
struct pair surface_curvature(const struct surface *surface, enum lens_section section);

/* From the vertex to the next one, mm: the thickness, and the hiatus of a thick lens. */
struct pair surface_advance(const struct surface *surface);

/* The number in effect where the source states one for this position; NaN where it does not. */
double lens_stated(const struct lens *lens, int what, size_t position);

/* The primary wavelength, um: the first of the file, else d. */
double lens_primary_wavelength(const struct lens *lens);

/* Warnings of lens_check: the lens stays usable. */
struct lens_warnings {
    const char **texts; /* in the arena */
    size_t count;
};

/*
 * Is the lens physically possible?
 *
 * Given     lens      in all its positions
 *           arena     for the warnings
 *           warnings  receives what is doubtful: an aperture beyond the sag's domain
 *                     ((1+k) c^2 r^2 > 1), surfaces that overlap inside their apertures, negative
 *                     air gaps. What is stated of a focal length is checked in optics/first_order.
 * Errors    ERROR_DATA: no surface, two stops, `aperture stop` without a stop or without its
 *           diameter, an index of 0 or less, a radius or diameter of 0, numbers beyond 1e100
 */
bool lens_check(const struct lens *lens, struct arena *arena, struct lens_warnings *warnings,
                struct error *error);

/*
 * Sag of a surface.
 *
 * Given     r  distance from the axis, mm, in the curved section of a cylinder
 * Result    z, mm; NaN where (1+k) c^2 r^2 > 1
 * Formula   z = c r^2/(1 + sqrt(1 - (1+k) c^2 r^2)) + A2 r^2 + A4 r^4 + ...
 */
double surface_sag(const struct surface *surface, double r);

#endif
