/* optics/lens.h - a lens as its maker writes it down: surfaces, stop, fields, positions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_LENS_H
#define LENSCALC_OPTICS_LENS_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/surface.h"

#include <stdbool.h>
#include <stddef.h>

struct lens_wavelength {
    double wavelength; /* um */
    struct text typed; /* "d", "587.56nm" */
    double weight;     /* 1 unless given */
    struct text weight_typed;
};

/* An angle in object space, or a height: of the object, of its paraxial or its real image. */
enum field_kind { FIELD_NONE, FIELD_ANGLE, FIELD_HEIGHT, FIELD_IMAGE, FIELD_REAL, FIELD_KINDS };
enum aperture_kind { APERTURE_NONE, APERTURE_STOP, APERTURE_FNUMBER, APERTURE_EPD, APERTURE_NA };
/* Where the image plane is; FOCUS_AFOCAL: the image is looked at from infinity, by angles. */
enum focus_kind { FOCUS_PARAXIAL, FOCUS_TABLE, FOCUS_BEST, FOCUS_AFOCAL, FOCUS_KINDS };

enum { LENS_MOST_SURFACES = 10000 }; /* of a file: more is no lens but a mistake, or mischief */

/* A point of the field, and how much it counts. */
struct lens_field {
    struct figure at[2]; /* x, y: rad, or mm */
    double weight;       /* 1 unless given */
    struct text weight_typed;
};

/* On the axis, of the weight 1: numbers, no variables. */
extern const struct lens_field lens_field_none;

/*
 * What is wrong with a field of angles; null = nothing.
 *
 * Given     half_turn  180, or pi: what they are measured in
 * Result    they are not beyond half a turn, and below a quarter where neither is 0: only those
 *           have the two tangents x/z and y/z of a direction
 */
const char *lens_field_wrong(const struct lens_field *field, double half_turn);

/*
 * How far a field is from the axis.
 *
 * Given     at  x, y: heights; or angles, rad, whose tangents are those of the direction
 * Result    the height, or the angle with the axis: tan^2 t = tan^2 x + tan^2 y. Not below 0
 */
double field_extent(enum field_kind kind, const double at[2]);

/* Is some field of the lens beside the y axis? */
bool lens_has_fields_beside(const struct lens *lens);

/* The largest of them of a lens; NaN without any. */
double lens_field_extent(const struct lens *lens);

/* Angles that were read in degrees become radians. Result as lens_field_wrong */
const char *lens_field_from_degrees(struct lens_field *field);

/* The same point with the same weight? */
bool lens_field_is_same(const struct lens_field *a, const struct lens_field *b);

/* A word that stands for one number in every position. */
struct lens_variable {
    struct text name;
    const struct figure *values;      /* one a position */
    const struct vary *const *varies; /* marks: one a position, null where the number stays; or
                                         null: no number is marked */
};

/* A number that follows another one: factor times it, plus offset. Of a glass: the same glass. */
struct lens_pickup {
    struct parameter what, from;
    struct figure factor, offset; /* 1; offset as `what`: mm, 1/mm, rad or 1 */
    const char *warning;          /* the file had another number there; null = no other */
};

struct lens_tolerance;

/* What the designer wants, as it was typed: cli/options/goals reads it. */
struct lens_goal {
    struct text text;
    const char *source; /* the file, for messages; null = none */
    long line;
    size_t column; /* where the text begins, from 1 */
};

/*
 * What the positions set anew of a surface: a number, or the medium behind it. The surface itself
 * has what the first position has.
 */
struct lens_setting {
    struct parameter parameter;
    const struct figure *figures; /* one a position; null where media are set */
    const struct medium *media;   /* of PARAMETER_GLASS, one a position */
};

/* The wavelengths of one position, the primary first. */
struct lens_light {
    struct lens_wavelength *wavelengths;
    size_t count;
};

/* The points of the field of one position. */
struct lens_points {
    struct lens_field *fields;
    size_t count;
};

/* What the source says the lens has; one value a position, or none. */
enum { STATED_EFL, STATED_BFL, STATED_FNUMBER, STATED_TSTOP, STATED_COUNT };

static inline bool stated_is_length(int stated)
{
    return stated == STATED_EFL || stated == STATED_BFL;
}

struct lens {
    const char *title, *source, *kind; /* null = not said */
    const char **notes;
    size_t note_count;
    const char *unit; /* "mm": of the typed lengths */
    struct lens_wavelength *wavelengths;
    size_t wavelength_count; /* 0: the file names none, d is meant */
    bool object_is_infinite;
    struct figure object; /* distance to the left of the first vertex, mm, if it is finite */
    bool is_telecentric; /* object space: the chief rays run along the axis, wherever the stop is */
    struct medium object_medium;
    enum field_kind field_kind;
    struct lens_field *fields;
    size_t field_count;
    enum aperture_kind aperture_kind;
    struct figure aperture;
    bool stop_is_real; /* sized by the exact marginal ray of an aperture that is not its diameter */
    enum focus_kind focus;
    struct surface *surfaces;
    size_t surface_count;
    size_t stop; /* index of the surface that is or bears the stop; LENS_NONE */
    const char **positions;
    size_t position_count; /* 0: there is only one, without a name */
    struct lens_variable *variables;
    size_t variable_count;
    struct lens_setting *settings; /* each parameter once */
    size_t setting_count;
    const size_t *stops;              /* the stop, one a position; or null: it is one surface */
    const struct lens_light *lights;  /* the wavelengths, one a position; or null */
    const struct lens_points *points; /* of the field, one a position; or null */
    const struct figure *objects;     /* let object: one a position, inf is infinite; or null */
    const struct figure *apertures;   /* let aperture: of the kind aperture_kind; or null */
    const struct figure *stated[STATED_COUNT]; /* null = not stated */
    size_t stated_count[STATED_COUNT];         /* 1 or one a position */
    struct lens_pickup *pickups;               /* each behind those that it follows */
    size_t pickup_count;
    struct lens_goal *goals;
    size_t goal_count;
    struct lens_tolerance *tolerances; /* optics/tolerance.h */
    size_t tolerance_count;
    const char *lost_power; /* what bends light in a file that it was read from; null = all kept */
    const char *cut_short;  /* why the end of that file may be missing; null = it is whole */
};

/*
 * The lens in one of its positions: variables replaced by their numbers, settings made, pick-ups
 * followed.
 *
 * Given     position  0 .. position_count - 1; 0 where the lens has only one
 */
const struct lens *lens_at_position(const struct lens *lens, size_t position, struct arena *arena);

/* The position of this name; LENS_NONE if there is none. */
size_t lens_position_find(const struct lens *lens, struct text name);

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
 *                     air gaps, a cone at the vertex. What is stated of a focal length is
 *                     checked in optics/first_order.
 * Errors    ERROR_DATA: no surface or more than LENS_MOST_SURFACES, two stops, a telecentric
 *           object space of an infinite object, `aperture stop` without a stop or without its
 *           diameter, an index of 0 or less, a radius or diameter of 0, numbers beyond 1e100
 */
bool lens_check(const struct lens *lens, struct arena *arena, struct lens_warnings *warnings,
                struct error *error);

/* Hint at how a lens without a stop gets one in its file; false. */
bool lens_hint_stop(struct error *error);

/* Is the lens the same in all directions about its axis? */
bool lens_is_round(const struct lens *lens);

#endif
