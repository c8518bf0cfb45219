/* trace/pupil/pupil_boundary_limits.c - what ends the edges of a star, and what is clear of the way there. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/pupil_boundary_search.h"

void pupil_boundary_spans(const struct clearances *margins, const struct probe *probe,
                          const struct edge_directions *directions, const struct edge *edges,
                          struct clear_intervals *spans)
{
    const struct stop_beam *beam = margins->beam;
    const size_t count = directions->count;
    const double *centre = directions->frame.centre;
    double from[2], ends[RAYS_BLOCK][2], points[RAYS_BLOCK][2];
    stop_beam_place(beam, centre[0], centre[1], from);
    for (size_t i = 0; i < count; i++) {
        spans[i] = spans_whole;
    }
    for (size_t done = 0; done < count && probe->full != NULL; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            edge_point(&directions->frame, directions->angles[done + i], edges[done + i].radius,
                       points[i]);
            stop_beam_place(beam, points[i][0], points[i][1], ends[i]);
        }
        clear_intervals_find(probe, from, (const double(*)[2])ends, here, spans + done);
        for (size_t i = 0; i < here; i++) {
            struct clear_intervals *clear = &spans[done + i];
            for (size_t k = 0; k < clear->count; k++) {
                clear->low[k] = stop_beam_share(beam, centre, points[i], clear->low[k]);
                clear->high[k] = stop_beam_share(beam, centre, points[i], clear->high[k]);
            }
        }
    }
}

/* Where apertures are listed it counts which piece of one ends an edge, and what is crossed. */
static void tell_parts(const struct pupil_boundary_search *search, const double *angles,
                       size_t count, struct edge *edges)
{
    const struct clearances *margins = search->margins;
    double at[RAYS_BLOCK][2];
    struct clear_edge ends[RAYS_BLOCK];
    struct clear_intervals spans[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        const struct edge *edge = &edges[i];
        double point[2];
        edge_point(&search->star->frame, angles[i], edge->radius, point);
        stop_beam_place(margins->beam, point[0], point[1], at[i]);
        bool known = edge->limit < margins->count;
        size_t surface = known ? margins->all[edge->limit].surface : LENS_NONE;
        ends[i] = (struct clear_edge){.status = surface != LENS_NONE ? RAY_CLIPPED : RAY_OK,
                                      .surface = surface != LENS_NONE ? surface + 1 : 0};
    }
    probe_parts(search->probe, (const double(*)[2])at, count, ends);
    const struct edge_directions directions = {search->star->frame, angles, NULL, count, 0};
    pupil_boundary_spans(margins, search->probe, &directions, edges, spans);
    for (size_t i = 0; i < count; i++) {
        size_t *limit = &edges[i].limit;
        *limit = (*limit * 1000003 + ends[i].part) * 1000003 + spans[i].part;
    }
}

void pupil_boundary_limits_find(const struct pupil_boundary_search *search, const double *angles,
                                const double *near, size_t count, struct edge *edges)
{
    const struct clearances *margins = search->margins;
    const struct edge_directions directions = {search->star->frame, angles, near, count, 0};
    edges_find(margins, &directions, search->tolerance, edges);
    for (size_t done = 0; done < count && margins->is_listed; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        tell_parts(search, angles + done, here, edges + done);
    }
}
