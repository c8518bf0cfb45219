/* camera/film/bounds_fit.h - polygons stretched until they contain the edges of pupils. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_BOUNDS_FIT_H
#define LENSCALC_CAMERA_FILM_BOUNDS_FIT_H

#include "camera/film/exit_pupil_bounds.h"

/* The rows that a place of the film lies between: one, or in the middle of two or four. */
struct film_nodes {
    size_t of[4], count;
};

/* Does an edge nowhere turn sharply? */
bool bounds_fit_is_smooth(const struct pupil_outline *outline);

/* Corners of a node, the row `row` of its column, on an edge; where it is dark as those before. */
void bounds_fit_start(const struct exit_pupil_bounds *region, const struct pupil_outline *outline,
                      size_t row, size_t node);

/* Corners of its hole, between two outlines that have one. */
void bounds_fit_start_hole(const struct exit_pupil_bounds *region, const struct pupil_outline *low,
                           const struct pupil_outline *high, double share, size_t node);

/*
 * Stretch the polygons of rows until what is interpolated between them contains an outline, and
 * shrink those of holes.
 *
 * Formula   for every point of the edge the sector, seen from the centre, that it lies in: its two
 *           corners are moved out by as much as the point lies beyond the line through them.
 *           Between two where the edge turns sharply it goes straight on from both sides
 */
void bounds_fit(const struct exit_pupil_bounds *region, const struct film_nodes *nodes,
                const struct pupil_outline *outline);

/* The same of single directions, each by a tenth more than it needs. */
void bounds_fit_points(const struct exit_pupil_bounds *region, const struct film_nodes *nodes,
                       const struct pupil_outline *outline,
                       const struct pupil_outline_point *points, size_t count);

/* How far out the corners of rows are from their centres: FILM_CORNERS a row. */
const double *bounds_fit_radii(const struct exit_pupil_bounds *region, size_t nodes,
                               struct arena *arena);

/* Stretch a row's polygon by as much as those of its neighbours have grown since then. */
void bounds_fit_follow(const struct exit_pupil_bounds *region, const double *before, size_t row);

/* Make one row hold what another does that began as it did, half a turn about the pole away. */
void bounds_fit_unite(const struct exit_pupil_bounds *region, size_t node, size_t other);

/* A row as another one is, half a turn about the pole away. */
void bounds_fit_copy(const struct exit_pupil_bounds *region, size_t from, size_t to);

/* All polygons larger by 0.3 %, holes smaller by 1.5 %; halves are made whole. */
void bounds_fit_finish(const struct exit_pupil_bounds *region, bool is_half);

#endif
