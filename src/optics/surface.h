/* optics/surface.h - one surface of a lens, and the tables of what each kind of it is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_SURFACE_H
#define LENSCALC_OPTICS_SURFACE_H

#include "base/pair.h"
#include "base/text.h"
#include "optics/medium.h"
#include "optics/parameter.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * A kind of surface is a row of surface_kinds, a kind of curve one of surface_profiles, and where
 * the curve lies one of surface_sections. Beside its row a new kind of curve needs a function here
 * (its departure from the conic), a step of the kernels (trace/system.c has the table) and its
 * words in the files (file/lens_surface.c, and what each folder of exchange/ can say). Another
 * spelling of a curve that is there needs the words only.
 */
enum { LENS_EVEN = 10, LENS_ODD = 10, LENS_COEFFICIENTS = LENS_EVEN + LENS_ODD };
#define LENS_NONE ((size_t)-1) /* no surface, no variable */

/* A number of a prescription. */
struct figure {
    struct pair value; /* lengths in mm, angles in rad */
    struct text typed; /* its digits in the file's unit; start is null where it was computed */
    size_t variable;   /* index of the variable that stands for it, LENS_NONE if it is a number */
};

static inline struct figure figure_number(struct pair value)
{
    return (struct figure){.value = value, .variable = LENS_NONE};
}

enum surface_kind {
    SURFACE_REFRACT,
    SURFACE_REFLECT,
    SURFACE_STOP,  /* a plane of its own that only limits the rays */
    SURFACE_THICK, /* a thick lens: its vertex is H, and what follows is counted from H' */
    SURFACE_KINDS
};

/* Kinds of curve, by the numbers that are not 0. */
enum profile_kind {
    PROFILE_PLANE,
    PROFILE_SPHERE,
    PROFILE_CONIC,
    PROFILE_EVEN, /* a conic and A2 r^2 + A4 r^4 + ... */
    PROFILE_ODD,  /* with odd powers among them: A1 r + A3 r^3 + ... */
    PROFILE_KINDS
};

enum curved { CURVED_BOTH, CURVED_X, CURVED_Y }; /* a cylinder is curved in one section only */

/* A shift and turns, about the vertex: shift, then about x, the new y, the new z. */
struct displacement {
    struct figure decenter[2]; /* x, y, mm */
    struct figure tilt[3];     /* about x, y, z, rad */
};
extern const struct displacement displacement_none; /* of 0 each: numbers, no variables */

/* A mark: what of the surface the designer may change. */
struct vary {
    enum parameter_kind kind;
    int order; /* of a coefficient */
    bool has_bounds;
    struct figure low, high;
    struct typed_place place;
};

struct aperture;

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
    /* A2, A4 ... A20, then A1, A3 ... A19, mm^(1 - order): surface_order */
    struct figure coefficient[LENS_COEFFICIENTS];
    struct medium medium;                /* after the surface */
    const struct displacement *decentre; /* this surface only; null = centred */
    const struct displacement
        *coordinate_break;            /* `bend` of files: the axis before it; null = none */
    const struct aperture *apertures; /* beside the diameter: optics/aperture.h; null = none */
    size_t aperture_count;
    const struct vary *varies;
    size_t vary_count;
    const char *name; /* null = none */
};

/* What the numbers of a kind of surface are: which of them may stand in a file, and may vary. */
enum {
    SURFACE_HAS_CURVE = 1,  /* radius or curvature, conic, coefficients, cylinder */
    SURFACE_HAS_FOCAL = 2,  /* focal length, hiatus, distortion */
    SURFACE_HAS_MEDIUM = 4, /* a medium of its own behind it */
    SURFACE_MAY_MIRROR = 8  /* `mirror` for its medium makes a mirror of it */
};

/* A kind of surface. */
struct surface_traits {
    const char *word; /* that begins its line in a .lens file */
    const char *key;  /* its kind in JSON */
    const char *name; /* in tables; null = that of its profile */
    unsigned has;     /* SURFACE_HAS_ */
    bool reflects;    /* light goes back, in the medium that it came in */
    bool is_drawn;    /* whatever lies beside it: others bound a glass */
};
extern const struct surface_traits surface_kinds[SURFACE_KINDS];

static inline const struct surface_traits *surface_traits(const struct surface *surface)
{
    return &surface_kinds[surface->kind];
}

static inline bool surface_reflects(const struct surface *surface)
{
    return surface_traits(surface)->reflects;
}

static inline bool surface_has(const struct surface *surface, unsigned what)
{
    return (surface_traits(surface)->has & what) != 0;
}

/* Where a surface is curved: u = x^2 weight[0] + y^2 weight[1] takes the place of r^2. */
struct surface_section {
    const char *key;  /* in JSON */
    const char *word; /* of `cyl=` in a .lens file; null = none */
    double weight[2]; /* x, y: 1 where it is curved, else 0 */
};
extern const struct surface_section surface_sections[3];

static inline const struct surface_section *surface_section(const struct surface *surface)
{
    return &surface_sections[surface->curved];
}

/* Has it the same curve in every section through its axis? */
static inline bool surface_is_round(const struct surface *surface)
{
    return surface->curved == CURVED_BOTH;
}

/*
 * What an asphere adds to z of its conic: S(u), u = r^2, mm, and dS/du, 1/mm. At the vertex the
 * slope of odd powers counts as 0: a cone has the normal of its axis there.
 */
struct departure {
    double value, slope;
};

/* A kind of curve: z = c u/(1 + sqrt(1 - (1+k) c^2 u)) + S(u). */
struct surface_profile {
    const char *name;                                                       /* in tables */
    struct departure (*departure)(const struct surface *surface, double u); /* null = S is 0 */
};
extern const struct surface_profile surface_profiles[PROFILE_KINDS];

/* The kind of curve: a coefficient, a conic constant or a curvature of 0 counts for nothing. */
enum profile_kind surface_profile(const struct surface *surface);

/* What coefficient[i] is multiplied with: r^order; and the i of an order. */
static inline int surface_order(int i)
{
    return i < LENS_EVEN ? 2 * i + 2 : 2 * (i - LENS_EVEN) + 1;
}

/* The index of the coefficient of r^order, -1 where there is none; 1 .. LENS_COEFFICIENTS are. */
static inline int surface_term(int order)
{
    int odd = LENS_EVEN + order / 2, even = order / 2 - 1;
    if (order < 1 || order > LENS_COEFFICIENTS) {
        return -1;
    }
    if (order % 2 == 0) {
        return even;
    }
    return odd;
}

/* The odd powers among those that were given: bit i stands for A(2 i + 1). */
static inline unsigned surface_odd(const struct surface *surface)
{
    return surface->coefficients >> LENS_EVEN;
}

/* S and dS/du; 0 of what is no asphere. */
struct departure surface_departure(const struct surface *surface, double u);

/* The curvature of the conic alone, without A2, 1/mm; 0 is a plane. */
struct pair surface_base_curvature(const struct surface *surface);

/*
 * Does r alone (A1) make a cone of the vertex? It has no curvature there, and no ray is
 * paraxial; lens_check warns. Higher odd powers leave the vertex flat to second order: A3 r^3 has
 * the curvature 0.
 */
bool surface_is_cone(const struct surface *surface);

/*
 * The curvature at the vertex in the y-z (or x-z) section, 1/mm, with 2 A2; 0 is a plane. A1 is
 * left out.
 */
enum lens_section { SECTION_Y, SECTION_X };
struct pair surface_curvature(const struct surface *surface, enum lens_section section);

/* A thick lens whose principal planes are one, and stay one: an ideal thin lens. */
bool surface_is_thin(const struct surface *surface);

/* From the vertex to the next one, mm: the thickness, and the hiatus of a thick lens. */
struct pair surface_advance(const struct surface *surface);

/* From where light meets the surface to where it leaves: 0, or from H to H' of a thick lens, mm. */
struct pair surface_hiatus(const struct surface *surface);

/*
 * Sag of a surface.
 *
 * Given     r  distance from the axis, mm, in the curved section of a cylinder
 * Result    z, mm; NaN where (1+k) c^2 r^2 > 1
 * Formula   z = c r^2/(1 + sqrt(1 - (1+k) c^2 r^2)) + A1 r + A2 r^2 + A3 r^3 + ...
 */
double surface_sag(const struct surface *surface, double r);

#endif
