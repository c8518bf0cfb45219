/* trace/pupil/stop_beam.h - the pupil that is integrated over, and what equal parts of it are. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_STOP_BEAM_H
#define LENSCALC_TRACE_PUPIL_STOP_BEAM_H

#include "base/error.h"
#include "optics/first_order.h"
#include "trace/aim/aim.h"
#include "trace/aim/beam.h"
#include "trace/system.h"

#include <stdbool.h>

/* What counts alike. */
enum stop_weight {
    WEIGHT_PUPIL, /* equal areas of the stop; of the paraxial entrance pupil where that is aimed at;
                     of u and v where there is neither */
    WEIGHT_BEAM   /* equal areas of the entering beam: across its axis, in the plane through the
                     first vertex that struct beam counts in. Of a far object that is what light
                     does; of a near one about equal solid angles */
};

/*
 * The rays of one object point at one wavelength, named by u, v. Either they have coordinates
 * origin + u (axes[0], axes[2]) + v (axes[1], axes[3]) in the beam, and go through about (u, v) of
 * a stop of radius 1; or they go through u, v of a disc across the axis, to which the way from the
 * beam is a projection.
 */
struct stop_beam {
    const struct system *system; /* with its clear apertures, or without; forward */
    const struct beam *beam;
    const struct aim *aim; /* that rays may be aimed at the stop with; null: none */
    double origin[2], axes[4];
    double radius; /* of the stop, mm; NaN: no stop, but the unit disc of u and v */
    enum stop_weight weight;
    bool has_disc;          /* origin and axes are not used, and radius is NaN */
    double disc[3], extent; /* its centre in the frame of the first vertex, and its radius, mm */
};

/* Does what rays meet on one side of u = 0, in the beam and in the stop, mirror the other? */
bool stop_beam_is_mirrored(const struct stop_beam *beam);

/* Over the stop, about the ray that the aim has; clear: the system that may lose rays. */
struct stop_beam stop_beam_of_stop(const struct aim *aim, const struct system *clear,
                                   enum stop_weight weight);

/*
 * Over the paraxial entrance pupil: its disc, less what `clear` loses, stop included. Of a
 * telecentric object space over the cone of the marginal ray.
 *
 * Errors    as aim_at_entrance
 */
bool stop_beam_of_entrance(const struct system *clear, const struct beam *beam,
                           const struct first_order *first, enum stop_weight weight,
                           struct stop_beam *stop_beam, struct error *error);

/* Coordinates in the beam. */
void stop_beam_place(const struct stop_beam *stop_beam, double u, double v, double at[2]);

/*
 * What an area of u, v is of the beam's plane: 1 on the average over the unit disc.
 *
 * Formula   a projection from a point at the distance D: 1/w^3, w = D + way along the axis, over
 *           its mean 1/(w0^2 - k^2)^(3/2) in the disc where w = w0 + k u
 */
double stop_beam_density(const struct stop_beam *stop_beam, double u, double v);

/* The share of the line from `from` to `to` in u, v at a share of it in the beam. */
double stop_beam_share(const struct stop_beam *stop_beam, const double from[2], const double to[2],
                       double share);

#endif
