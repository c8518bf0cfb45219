/* trace/pupil/edges.c - brackets, then parabolas, a block of directions at a time. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/edges.h"

#include "base/constants.h"

#include <math.h>
#include <stdint.h>

/* How far out edges usually, rarely and at most lie in u and v, as pupils have aberrations. */
static const double usual_reach = 1.125, wide_reach = 2.25, farthest = 64;

enum { STRIDES = 8, TURNS = 70, SURE = 12 };

/* Half of what a guess may be wrong by, where nothing else is said. */
static const double usual_slack = 0.03;

/* One edge, while it is looked for: a radius that passes, one that does not, and a third. */
struct edge_search {
    double at[3], excess[3];
    size_t limits[3]; /* what is the worst there */
    size_t limit;
    bool is_closed, is_done;
};

void edge_point(const struct edge_frame *frame, double angle, double radius, double point[2])
{
    point[0] = frame->centre[0] + frame->stretch[0] * radius * sin(angle);
    point[1] = frame->centre[1] + frame->stretch[1] * radius * cos(angle);
}

void edge_polar(const struct edge_frame *frame, const double point[2], double about, double *angle,
                double *radius)
{
    double u = (point[0] - frame->centre[0]) / frame->stretch[0];
    double v = (point[1] - frame->centre[1]) / frame->stretch[1];
    *radius = sqrt(u * u + v * v);
    *angle = atan2(u, v);
    *angle += 2 * PI * round((about - *angle) / (2 * PI));
}

/* Up to 128 directions that are looked in together. */
struct edge_searches {
    const struct clearances *margins;
    const struct edge_frame *frame;
    double way[RAYS_BLOCK][2];
    struct edge_search each[RAYS_BLOCK];
    size_t count;
    size_t which[RAYS_BLOCK]; /* of them, by lane */
    double radius[RAYS_BLOCK];
};

static void edge_searches_trace(struct edge_searches *all, size_t lanes)
{
    double points[RAYS_BLOCK][2];
    for (size_t i = 0; i < lanes; i++) {
        const double *way = all->way[all->which[i]];
        points[i][0] = all->frame->centre[0] + all->radius[i] * way[0];
        points[i][1] = all->frame->centre[1] + all->radius[i] * way[1];
    }
    clearances_look(all->margins, (const double(*)[2])points, lanes);
}

/* Outwards step by step, several of them at once. */
static void edge_searches_bracket(struct edge_searches *all)
{
    double far = 0, stride = usual_reach / STRIDES;
    for (;;) {
        size_t open[RAYS_BLOCK], left = 0, lanes = 0, parts;
        double from = far;
        for (size_t i = 0; i < all->count; i++) {
            if (!all->each[i].is_closed && !all->each[i].is_done) {
                open[left++] = i;
            }
        }
        if (left == 0 || far >= farthest) {
            break;
        }
        parts = RAYS_BLOCK / left < STRIDES / 2 ? RAYS_BLOCK / left : STRIDES / 2;
        for (size_t k = 0; k < left; k++) {
            far = from;
            for (size_t j = 0; j < parts; j++) {
                far += far < wide_reach - 1e-9 ? stride : far;
                all->which[lanes] = open[k];
                all->radius[lanes++] = far;
            }
        }
        edge_searches_trace(all, lanes);
        for (size_t i = 0; i < lanes; i++) {
            /* what a ray at a radius beyond all before says while there is no bracket yet */
            struct edge_search *search = &all->each[all->which[i]];
            const double excess = all->margins->excess[i];
            const size_t limit = all->margins->limit[i];
            int place = excess <= 0 ? 0 : 1;
            if (!search->is_closed) {
                if (place == 0) {
                    search->at[2] = search->at[0];
                    search->excess[2] = search->excess[0];
                    search->limits[2] = search->limits[0];
                } else {
                    search->limit = limit;
                    search->is_closed = true;
                }
                search->at[place] = all->radius[i];
                search->excess[place] = excess;
                search->limits[place] = limit;
            }
        }
    }
}

/* Three radii about a guess each. Those that do not hold the edge are left open. */
static void edge_searches_guess(struct edge_searches *all, const double *near, double slack)
{
    for (size_t done = 0; done < all->count; done += RAYS_BLOCK / 3) {
        size_t lanes = 0;
        for (size_t i = done; i < all->count && i < done + RAYS_BLOCK / 3; i++) {
            for (int k = 0; k < 3 && near[i] > 0; k++) {
                all->which[lanes] = i;
                all->radius[lanes++] = near[i] * (1 + slack * (k - 1));
            }
        }
        if (lanes == 0) {
            continue;
        }
        edge_searches_trace(all, lanes);
        const double *excess = all->margins->excess, *r = all->radius;
        for (size_t i = 0; i < lanes; i += 3) {
            size_t dark = excess[i + 1] > 0 ? i + 1 : i + 2, clear = dark - 1;
            size_t other = dark == i + 1 ? i + 2 : i;
            if (excess[clear] <= 0 && excess[dark] > 0) {
                const size_t *limit = all->margins->limit;
                struct edge_search *search = &all->each[all->which[i]];
                *search =
                    (struct edge_search){.at = {r[clear], r[dark], r[other]},
                                         .excess = {excess[clear], excess[dark], excess[other]},
                                         .limits = {limit[clear], limit[dark], limit[other]},
                                         .limit = limit[dark],
                                         .is_closed = true};
            }
        }
    }
}

/* The next radius to try, within the bracket; is it a root of the parabola? */
static double edge_search_next(const struct edge_search *search, int turn, bool *is_root)
{
    const double *t = search->at, *f = search->excess, middle = (t[0] + t[1]) / 2;
    *is_root = false;
    if (!isfinite(f[1]) || (turn > SURE && turn % 2 == 0)) {
        return middle;
    }
    double slope = (f[1] - f[0]) / (t[1] - t[0]), at = t[0] - f[0] / slope;
    double bend = ((f[2] - f[1]) / (t[2] - t[1]) - slope) / (t[2] - t[0]);
    if (isfinite(bend) && isfinite(f[2])) {
        /* Newton's method on the parabola */
        for (int step = 0; step < 3; step++) {
            double value = f[0] + (at - t[0]) * (slope + bend * (at - t[1]));
            at -= value / (slope + bend * (2 * at - t[0] - t[1]));
        }
        *is_root = at > t[0] && at < t[1];
    }
    if (!(at > t[0] && at < t[1])) {
        at = t[0] - f[0] / slope;
    }
    return at > t[0] && at < t[1] ? at : middle;
}

/*
 * Is it sure where a step leads? A parabola through three excesses of one rim, which are nearly
 * quadratic, is off by less than the product of the ways to them: here by rounding.
 */
static bool edge_search_is_sure(const struct edge_search *search, double radius)
{
    const double *t = search->at, rounding = 1e-14 * radius * radius * radius;
    const size_t limit = search->limits[0];
    const double product = (radius - t[0]) * (radius - t[1]) * (radius - t[2]);
    return limit == search->limits[1] && limit == search->limits[2] &&
           isfinite(search->excess[2]) && !clearances_lost(limit) && fabs(product) <= rounding;
}

static void edge_searches_close(struct edge_searches *all, double tolerance)
{
    for (int turn = 0; turn < TURNS; turn++) {
        size_t lanes = 0;
        for (size_t i = 0; i < all->count; i++) {
            struct edge_search *search = &all->each[i];
            if (!search->is_closed || search->is_done) {
                continue;
            }
            bool is_root;
            const double radius = edge_search_next(search, turn, &is_root);
            const bool is_there = fabs(search->excess[0]) <= 1e-13;
            if (is_there || (is_root && edge_search_is_sure(search, radius))) {
                search->at[0] = is_there ? search->at[0] : radius;
                search->limit = search->limits[0]; /* farther out another one may lie closer */
                search->is_done = true;
                continue;
            }
            all->which[lanes] = i;
            all->radius[lanes++] = radius;
        }
        if (lanes == 0) {
            return;
        }
        edge_searches_trace(all, lanes);
        for (size_t i = 0; i < lanes; i++) {
            /* the bracket becomes narrower, the end that was there before is kept as the third */
            struct edge_search *search = &all->each[all->which[i]];
            const double radius = all->radius[i];
            const double excess = all->margins->excess[i];
            const size_t limit = all->margins->limit[i];
            int place = excess <= 0 ? 0 : 1;
            search->at[2] = search->at[place];
            search->excess[2] = search->excess[place];
            search->limits[2] = search->limits[place];
            search->at[place] = radius;
            search->excess[place] = excess;
            search->limits[place] = limit;
            if (place == 1 || fabs(excess) <= tolerance) {
                search->limit = limit;
            }
            if (fabs(excess) <= tolerance) {
                search->at[0] = radius;
                search->is_done = true;
            }
            double width = isfinite(search->excess[1]) ? 3e-16 : 1e-13;
            search->is_done =
                search->is_done || !(search->at[1] - search->at[0] > width * search->at[1]);
        }
    }
}

void edges_find(const struct clearances *margins, const struct edge_frame *frame,
                const double *angles, const double *near, size_t count, double slack,
                double tolerance, struct edge *edges)
{
    struct edge_searches all;
    all.margins = margins;
    all.frame = frame;
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        all.count = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < all.count; i++) {
            all.way[i][0] = frame->stretch[0] * sin(angles[done + i]);
            all.way[i][1] = frame->stretch[1] * cos(angles[done + i]);
            all.each[i] = (struct edge_search){
                .at = {0, 0, NAN}, .excess = {-1, 0, NAN}, .limits = {SIZE_MAX}};
        }
        if (near != NULL) {
            edge_searches_guess(&all, near + done, slack > 0 ? slack : usual_slack);
        }
        edge_searches_bracket(&all);
        edge_searches_close(&all, tolerance);
        for (size_t i = 0; i < all.count; i++) {
            edges[done + i] = (struct edge){all.each[i].at[0], all.each[i].limit};
        }
    }
}

struct clear_edge clear_edge_of(const struct clearances *margins, const struct edge_frame *frame,
                                double angle, const struct edge *edge)
{
    const size_t number = edge->limit % ((size_t)1 << 32);
    const bool lost = clearances_lost(edge->limit);
    struct clear_edge ray = {
        .status = lost ? (enum ray_status)(number % 8) : RAY_CLIPPED,
        .surface = lost ? number / 8 : margins->all[number].surface + 1,
    };
    double point[2];
    edge_point(frame, angle, edge->radius, point);
    stop_beam_place(margins->beam, point[0], point[1], ray.at);
    return ray;
}
