/* analysis/pupil/bundle.h - the rays of one field at one wavelength, and what each of them counts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_BUNDLE_H
#define LENSCALC_ANALYSIS_PUPIL_BUNDLE_H

#include "analysis/pupil/quadrature.h"
#include "analysis/setup/setup.h"
#include "trace/aim/sample.h"
#include "trace/pupil/pupil_islands.h"
#include "trace/pupil/stop_beam.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Which rays. */
struct bundle_question {
    const struct setup *setup;
    const struct field_point *field;
    size_t wavelength;  /* its place in the setup */
    bool clip;          /* clear apertures and the stop lose rays */
    bool from_entrance; /* points are those of the paraxial entrance pupil, not of the stop */
    enum stop_weight weight;
    enum pattern pattern; /* PATTERN_GAUSS: a quadrature of what is clear */
    uint64_t seed;
    struct aim_near *near; /* the chief ray of another wavelength, or null; receives this one's */
};

/* A field point made ready: it may be filled with rays again and again. It points into itself. */
struct bundle_source {
    const struct bundle_question *question;
    const struct system *system;  /* to the image plane, where there is one */
    const struct system *open;    /* the same, but nothing is clipped */
    const struct system *through; /* what bundle_trace traces through: system, unless it is set to
                                     one with paths */
    struct beam beam;
    struct aim aim; /* where the lens has a stop */
    struct stop_beam pupil;
    struct quadrature_region *region; /* what is clear of it, for PATTERN_GAUSS */
    bool has_chief;
    struct ray chief; /* where it starts; unobstructed */
};

/* Rays and what each counts: their weights add up to the clear share of the pupil. */
struct bundle {
    struct rays rays;                 /* some may be lost */
    const struct pupil_point *points; /* one a ray */
    size_t count, lost;
    double clear;       /* the sum of the weights that are not lost */
    size_t arms, rings; /* of a quadrature, as that has them; 0: not so orderly */
    struct quadrature_arcs arcs;
};

/*
 * Compile what bundle_open asks the setup for, where that keeps it: all else that is made of a
 * field may be given up with its arena.
 */
bool bundle_prepare(const struct bundle_question *question, struct error *error);

/*
 * Make a field ready.
 *
 * Given     question  must outlive the source
 * Result    without a chief ray, where others arrive all the same, `has_chief` is false
 * Errors    as setup_beam, aim_open, aim_at_entrance; ERROR_DOMAIN: neither stop nor aperture
 */
bool bundle_open(const struct bundle_question *question, struct arena *arena,
                 struct bundle_source *source, struct error *error);

/*
 * The same beside a field that is ready at another wavelength: the edge of what is clear is looked
 * for near the one there.
 *
 * Given     before  not filled yet, or filled; null: there is none
 * Result    what is clear to its rounding: who compares digits goes from wavelength to wavelength
 *           in the same order
 */
bool bundle_open_beside(const struct bundle_question *question, const struct bundle_source *before,
                        struct arena *arena, struct bundle_source *source, struct error *error);

/*
 * Rays through points of the pupil, where they start.
 *
 * Given     source  with a chief ray
 *           points  of the stop or the entrance pupil of radius 1
 *           rays    room for `count`; one that could not be aimed is lost already
 */
void bundle_aim(const struct bundle_source *source, const struct pupil_point *points, size_t count,
                const struct rays *rays);

/* The same as bundle_trace, but the rays are where they start; nothing is counted as lost yet. */
bool bundle_fill(const struct bundle_source *source, size_t rays, struct arena *arena,
                 struct bundle *bundle, struct error *error);

/*
 * Fill the pupil and trace.
 *
 * Given     rays  about how many
 *           to    the place behind the last surface that they pass; source->system->places: all
 * Formula   PATTERN_GAUSS: quadrature_make. Other patterns: points of the full stop or entrance
 *           pupil, each of the same weight, with WEIGHT_BEAM by quadrature_weigh_beam; those that
 *           arrive nowhere lost
 * Errors    as sample_make and aim_at_entrance; ERROR_DOMAIN: no ray arrives, with the surface
 *           where most are lost
 */
bool bundle_trace(const struct bundle_source *source, size_t rays, size_t to, struct arena *arena,
                  struct bundle *bundle, struct error *error);

/*
 * Fail, as no ray arrives: with the surface where the middle of the beam is lost.
 *
 * Given     count  of rays that were tried, 0: a whole pupil
 */
bool bundle_fail_dark(const struct bundle_source *source, size_t count, struct arena *arena,
                      struct error *error);

/* The chief ray there, unclipped; its status says whether it gets there. */
struct ray bundle_chief(const struct bundle_source *source, size_t to, struct arena *arena);

/* Light that passes beyond a gap: a quadrature leaves it out, other patterns do not reach it. */
struct pupil_islands bundle_islands(const struct bundle_source *source, struct arena *arena);

#endif
