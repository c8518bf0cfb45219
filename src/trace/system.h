/* trace/system.h - a lens at one wavelength, compiled for exact rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_SYSTEM_H
#define LENSCALC_TRACE_SYSTEM_H

#include "base/arena.h"
#include "base/error.h"
#include "base/pair.h"
#include "optics/lens.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * Who does what: system_compile turns a lens into steps (trace/kernel/step.h), one or a few a
 * surface;
 * trace/dispatch.h chooses the kernels for the processor and cuts the rays (trace/kernel/rays.h)
 * among
 * threads; the kernels (kernel.c: planes and spheres; kernel_conic.c: conics and aspheres) take
 * 128 rays through one step after the other. derivative.h sweeps back for derivatives by
 * everything, tangent.h goes forwards for those by a few things, verify.h traces again with more
 * digits. aim.h, beam.h, sample.h and clear.h find the rays that are worth tracing.
 *
 * Compile, trace, read:
 *
 *     struct system_options options = system_options_default();
 *     options.image = first.image;                     behind the last vertex; or leave it out
 *     system_compile(lens, wavelength, &options, arena, &system, error)
 *     struct rays rays = rays_new(arena, count);
 *     rays_set(&rays, i, system.index_first, &ray);    or write into the blocks
 *     rays_trace(&system, &rays, NULL);                trace/dispatch.h
 *     struct ray out = rays_get(&rays, i, system.index_last);
 *
 * A system is read-only and may be shared by threads. Rays start anywhere in the frame of the
 * first vertex (z from it); the first surface is found from far away too, to the last digit.
 * After the trace they are in the frame of the surface met last: origin in its vertex, axes along
 * the optical axis there (turned by every coordinate break so far; a surface's own decentre and
 * tilt do not turn the frame). `system_frames` lead from there back to the frame of the first
 * vertex.
 *
 * Surfaces count from 0 in the order of the lens, the stop counted; the image plane, if there is
 * one, is surface `lens->surface_count`. With `reverse` light enters at the last surface, towards
 * -z, in the same frames; rays then start in the frame of the last vertex. `rays_trace_part` goes
 * from any surface to any other, so that every intersection can be read.
 *
 * Formula   per surface, (P, Q, R) = n x direction cosines, s = direction of the light (+-1):
 *           z -= t; to the vertex plane first where |c t| > 1 or at the first surface; then
 *           C = c (X^2 + Y^2 + Z^2) - 2 Z, B = R - c (X P + Y Q + Z R), D^2 = B^2 - c n^2 C,
 *           d = C/(B + s D); the point moves by d (P, Q, R), the path grows by n^2 d;
 *           E^2 = D^2 + n'^2 - n^2, g = s (E - D), p += g (-c X, -c Y, 1 - c Z);
 *           a mirror has g = -2 s D. Conic: with K = 1 + k for Z^2 and the normal N not of unit
 *           length, E^2 = D^2 + (n'^2 - n^2) N^2, g = s (E - D)/N^2. Asphere: Newton on
 *           F = c (r^2 + K w^2)/2 - w, w = Z - S(r^2), from the conic on; trace/kernel/search.h
 *           for those
 *           that it loses
 *           a thick lens: see optics/thick_lens; the ray goes on in the plane of H', which lies at
 *           z = hiatus in the frame of that surface; the path from H to H' is not counted
 *           paraxial: every surface is a thick lens without thickness, of power (n' - n) c at its
 *           vertex plane: n' u' = n u - P h with tangents u, h, as [Smith05] has it for y and n u
 * Source    [Welford86] chapter "Finite raytracing", in a form without angles; the hop to the
 *           vertex plane and F are derived in lenscalc.7
 * Limits    the intersection is the one where light meets the front of the surface (N.p s > 0),
 *           on the sheet of the vertex (1 - c K Z > 0): beyond a hemisphere is a miss
 */
struct system_options {
    bool clip;          /* clear apertures and the stop lose rays; else they only limit in name */
    bool unobstructed;  /* what blocks loses none, and what passes counts as convex */
    bool path;          /* count the optical path */
    bool reverse;       /* light from the image side */
    bool paraxial;      /* surfaces do to all rays what they do to those near the axis */
    double image;       /* a plane this far behind the last vertex, mm; NaN = none */
    double stop_radius; /* mm; NaN = what the lens says of its aperture */
    const struct pair *indices; /* those that lens_indices finds, if they are known; null = they are
                                   not. They must outlive the system */
};

struct clip;
struct step;

struct system {
    const struct lens *lens;
    struct system_options options;
    const struct step *steps;
    const size_t *begin;  /* place -> first step; places + 1 of them */
    size_t places;        /* surfaces in the order light meets them, the image plane too */
    size_t stop;          /* surface; LENS_NONE = no stop */
    double stop_radius;   /* mm: of the pupil coordinates and, with clip, the limit; NaN = none */
    double wavelength;    /* um */
    double index_first;   /* n where rays start and where they end */
    double index_last;    /* */
    const struct pair *n; /* lens->surface_count + 1: before the first, after each; all positive */
    const double *direction; /* of the light at each surface, lens order: +1 or -1 along z */
    const struct clip *const *clips; /* of each surface, null = none; null: there is none at all */
    const struct system *outer;      /* the same unobstructed; null: nothing obstructs this one */
};

/* The system whose light has one edge and nothing dark within it. */
static inline const struct system *system_outer(const struct system *system)
{
    return system->outer != NULL ? system->outer : system;
}

/* No clipping, no path, forward, no image plane. */
struct system_options system_options_default(void);

/*
 * Make a lens ready for exact rays.
 *
 * Given     lens        in one position (lens_at_position), must outlive the system
 *           wavelength  um
 * Result    system.stop_radius: options.stop_radius; else half the stop's diameter; else the
 *           paraxial radius for the f-number, pupil diameter or numerical aperture of the lens at
 *           its primary wavelength. With clip, a clear diameter given for the stop limits too
 * Errors    as medium_index; ERROR_DOMAIN: an aperture that the lens cannot have; paraxial with a
 *           surface that is not round
 */
bool system_compile(const struct lens *lens, double wavelength,
                    const struct system_options *options, struct arena *arena,
                    struct system *system, struct error *error);

/*
 * The same lens at another wavelength, for less.
 *
 * Given     from     not clipped, not reversed, not paraxial, without thick lenses
 *           indices  those that lens_indices finds; they must outlive the system
 * Result    as system_compile has it, to the bit
 */
void system_recolour(const struct system *from, double wavelength, const struct pair *indices,
                     struct arena *arena, struct system *system);

/* The place in the order of light of a surface, and back; see struct system. */
size_t system_place(const struct system *system, size_t surface);
size_t system_surface(const struct system *system, size_t place);

/* Index behind a place, in the order of light. */
double system_index_after(const struct system *system, size_t place);

/*
 * How far from the axis of a surface rays pass, mm: its clear aperture and, at the stop, the stop's
 * radius; infinite where nothing limits them, and everywhere without clip.
 */
double system_clear_radius(const struct system *system, size_t surface);

/*
 * The frames of the vertices of all surfaces, and behind them that of the image, seen from the
 * first.
 *
 * Result    a point X in the frame of `surface` lies at turn X + shift in that of the first
 *           vertex; turn is row by row; directions turn without the shift
 */
struct surface_frame {
    double turn[9];
    double shift[3]; /* mm */
};
struct surface_frame *system_frames(const struct system *system, struct arena *arena);

/*
 * A point in the frame of the axis at a surface, as rays are given there, into the surface's own:
 * about its shifted vertex, turned with its tilt. Surfaces that are not moved leave it as it is.
 */
void system_to_own(const struct system *system, size_t surface, double point[3]);

/*
 * The unit normal of a surface at a point of it.
 *
 * Given     point   in the frame of the surface (own decentre and tilt are looked after)
 *           normal  receives it; its z is positive at the vertex of an untilted surface
 */
void system_normal(const struct system *system, size_t surface, const double point[3],
                   double normal[3]);

/*
 * Angles of incidence and refraction (or reflection), rad, 0 to pi/2.
 *
 * Given     before, after  directions of any length
 * Formula   atan2(|N x p|, |N . p|): no digits are lost near 0 and 90 degrees
 */
struct ray_angles {
    double incidence, refraction;
};
struct ray_angles ray_angles(const double normal[3], const double before[3], const double after[3]);

#endif
