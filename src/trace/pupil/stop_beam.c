/* trace/pupil/stop_beam.c - from points of a pupil to the beam. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/stop_beam.h"

#include "optics/lens.h"

#include <math.h>

struct stop_beam stop_beam_of_stop(const struct aim *aim, const struct system *clear,
                                   enum stop_weight weight)
{
    const double *m = aim->slope, scale = aim->stop_radius / (m[0] * m[3] - m[1] * m[2]);
    struct stop_beam all = {.system = clear,
                            .beam = &aim->beam,
                            .aim = aim,
                            .axes = {m[3] * scale, -m[1] * scale, -m[2] * scale, m[0] * scale},
                            .radius = aim->stop_radius,
                            .weight = weight};
    const double *centre = aim->centre;
    for (int i = 0; i < 2; i++) {
        const double *row = all.axes + 2 * i;
        all.origin[i] =
            aim->chief[i] - (row[0] * centre[0] + row[1] * centre[1]) / aim->stop_radius;
    }
    return all;
}

bool stop_beam_of_entrance(const struct system *clear, const struct beam *beam,
                           const struct first_order *first, enum stop_weight weight,
                           struct stop_beam *stop_beam, struct error *error)
{
    struct ray ray;
    *stop_beam = (struct stop_beam){
        .system = clear, .beam = beam, .radius = NAN, .weight = weight, .has_disc = true};
    if (!aim_at_entrance(beam, first, 0, 1, &ray, error)) {
        return false;
    }
    if (!first->is_telecentric) {
        stop_beam->disc[2] = first->entrance_pupil;
        stop_beam->extent = first->entrance_diameter / 2;
        return true;
    }
    /* in the plane of the first vertex, about the ray along the axis of the lens */
    const double slope = first->marginal_v / first->index_object;
    for (int i = 0; i < 2; i++) {
        stop_beam->disc[i] = -beam->distance * beam->axis[i];
    }
    stop_beam->extent = slope * beam->distance * beam->axis[2];
    return true;
}

static void in_disc(const struct stop_beam *all, double u, double v, double point[3])
{
    point[0] = all->disc[0] + u * all->extent;
    point[1] = all->disc[1] + v * all->extent;
    point[2] = all->disc[2];
}

void stop_beam_place(const struct stop_beam *all, double u, double v, double at[2])
{
    double point[3];
    if (all->has_disc) {
        in_disc(all, u, v, point);
        beam_place(all->beam, point, at);
        return;
    }
    at[0] = all->origin[0] + u * all->axes[0] + v * all->axes[1];
    at[1] = all->origin[1] + u * all->axes[2] + v * all->axes[3];
}

/* How far from the object along the axis of the beam, of the way to the first vertex. */
static double way_to(const struct stop_beam *all, double u, double v)
{
    const double *axis = all->beam->axis;
    double point[3];
    in_disc(all, u, v, point);
    return 1 + (point[0] * axis[0] + point[1] * axis[1] + point[2] * axis[2]) / all->beam->distance;
}

double stop_beam_density(const struct stop_beam *all, double u, double v)
{
    const double *axis = all->beam->axis;
    if (!all->has_disc || isinf(all->beam->distance)) {
        return 1;
    }
    double middle = way_to(all, 0, 0), ratio = middle / way_to(all, u, v);
    double tilt = all->extent * hypot(axis[0], axis[1]) / (all->beam->distance * middle);
    double mean = sqrt(1 - tilt * tilt);
    return fabs(ratio * ratio * ratio * mean * mean * mean);
}

double stop_beam_share(const struct stop_beam *all, const double from[2], const double to[2],
                       double share)
{
    if (!all->has_disc || isinf(all->beam->distance)) {
        return share;
    }
    double first = way_to(all, from[0], from[1]), last = way_to(all, to[0], to[1]);
    return share * first / (last - share * (last - first));
}

bool stop_beam_is_mirrored(const struct stop_beam *beam)
{
    const struct beam *rays = beam->beam;
    const double *axes = beam->axes;
    const bool centred = beam->has_disc ? beam->disc[0] == 0 : beam->origin[0] == 0;
    return centred && (beam->has_disc || (axes[1] == 0 && axes[2] == 0)) && rays->axis[0] == 0 &&
           rays->foot[0] == 0 && rays->across[0][1] == 0 && rays->across[0][2] == 0 &&
           rays->across[1][0] == 0 && lens_is_round(beam->system->lens);
}
