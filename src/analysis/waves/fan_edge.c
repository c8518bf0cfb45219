/* analysis/waves/fan_edge.c - where lines across a stop leave what is clear of it. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/fan_edge.h"

#include <math.h>

/* Rays for a step: one, and one beside it along u and v. */
enum { EACH = 3, STEPS = 10 };

/* Steps of differences, in u and v; what counts as there, of the excess and in radii. */
static const double beside = 1e-6, enough = 1e-12;

/* What rays of a step say. */
struct fan_edge_found {
    double excess, h, aside; /* h: along the line; aside: beside it */
};

static void fan_edge_look(const struct clearances *margins, const struct fan_edge *edges,
                          const double (*points)[2], size_t count, struct fan_edge_found *found)
{
    const struct system *system = margins->system;
    clearances_look(margins, points, count);
    for (size_t i = 0; i < count; i++) {
        found[i].excess = margins->excess[i];
    }
    clearances_go(margins, points, count, system_place(system, system->stop) + 1);
    for (size_t i = 0; i < count; i++) {
        const double *along = edges[i / EACH].along;
        double at[3];
        clearances_cross(margins, system->stop, i, at);
        found[i].h = (at[0] * along[0] + at[1] * along[1]) / margins->beam->radius;
        found[i].aside = (at[1] * along[0] - at[0] * along[1]) / margins->beam->radius;
    }
}

/* Newton's step of one edge from its three rays. */
static void fan_edge_step(const struct fan_edge_found *found, double at[2])
{
    const double excess[2] = {found[1].excess - found[0].excess, found[2].excess - found[0].excess};
    const double aside[2] = {found[1].aside - found[0].aside, found[2].aside - found[0].aside};
    const double scale = beside / (excess[0] * aside[1] - excess[1] * aside[0]);
    at[0] -= (aside[1] * found[0].excess - excess[1] * found[0].aside) * scale;
    at[1] -= (excess[0] * found[0].aside - aside[0] * found[0].excess) * scale;
}

void fan_edges_find(const struct bundle_source *source, struct fan_edge *edges, size_t count,
                    struct arena *arena)
{
    double at[FAN_EDGES_MOST][2], points[RAYS_BLOCK][2];
    struct fan_edge_found found[RAYS_BLOCK];
    for (size_t k = 0; k < count; k++) {
        edges[k].is_found = false;
        at[k][0] = edges[k].h * edges[k].along[0];
        at[k][1] = edges[k].h * edges[k].along[1];
    }
    if (source->pupil.has_disc || isnan(source->pupil.radius) || count == 0) {
        return;
    }
    const struct arena_mark mark = arena_mark(arena);
    const struct clearances margins = clearances_open(&source->pupil, arena);
    bool busy = true;
    for (int turn = 0; turn < STEPS && busy; turn++) {
        for (size_t i = 0; i < EACH * count; i++) {
            points[i][0] = at[i / EACH][0] + (i % EACH == 1 ? beside : 0);
            points[i][1] = at[i / EACH][1] + (i % EACH == 2 ? beside : 0);
        }
        fan_edge_look(&margins, edges, (const double(*)[2])points, EACH * count, found);
        busy = false;
        for (size_t k = 0; k < count; k++) {
            const struct fan_edge_found *here = &found[EACH * k];
            edges[k].h = here->h;
            edges[k].is_found = fabs(here->excess) <= enough && fabs(here->aside) <= enough;
            if (!edges[k].is_found) {
                fan_edge_step(here, at[k]);
            }
            busy = busy || (!edges[k].is_found && isfinite(at[k][0] + at[k][1]));
        }
    }
    arena_reset(arena, mark);
}
