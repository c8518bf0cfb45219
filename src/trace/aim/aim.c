/* trace/aim/aim.c - Newton's method from the chief ray outwards. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aim.h"

#include "trace/aim/aim_block.h"
#include "trace/aim/aim_map.h"
#include "trace/aim/chief.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

struct ray aim_chief(const struct aim *aim)
{
    return beam_ray(&aim->beam, aim->chief[0], aim->chief[1]);
}

bool aim_open_near(const struct system *system, const struct beam *beam, struct aim_near *near,
                   struct arena *arena, struct aim *aim, struct error *error)
{
    *aim = (struct aim){.system = NULL};
    if (system->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: rays cannot be aimed at it");
    }
    if (!(system->stop_radius > 0)) {
        fail(error, ERROR_DOMAIN, "the stop has no diameter: the size of the pupil is not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    if (isinf(system->stop_radius)) {
        return fail(error, ERROR_DOMAIN,
                    "the stop would be infinitely wide: the lens has no power, and its f-number "
                    "stands for no beam");
    }
    if (!(system->stop_radius <= 1e100)) {
        return fail(error, ERROR_DOMAIN, "the stop would have a radius of %.3g mm: at most 1e100",
                    system->stop_radius);
    }
    *aim = (struct aim){.system = system,
                        .beam = *beam,
                        .stop_radius = system->stop_radius,
                        .work = rays_new(arena, RAYS_BLOCK)};
    aim->has_chief = (near != NULL && near->is_known && chief_find_near(aim, near)) ||
                     chief_find(aim, arena, error);
    if (near != NULL && aim->has_chief) {
        near->is_known = true;
        memcpy(near->chief, aim->chief, sizeof near->chief);
        memcpy(near->slope, aim->slope, sizeof near->slope);
    }
    return aim->has_chief;
}

bool aim_open_at(struct aim *aim, const double at[2])
{
    const struct ray_block *block = aim->work.blocks;
    double slope[4];
    if (aim->system == NULL) {
        return false;
    }
    chief_trace(aim, (const double(*)[2])at, 1);
    if (ray_block_status(block, 0) != RAY_OK) {
        return false;
    }
    aim->centre[0] = block->x[0];
    aim->centre[1] = block->y[0];
    if (!chief_slope(aim, at, slope)) {
        return false;
    }
    memcpy(aim->slope, slope, sizeof slope);
    aim->chief[0] = at[0];
    aim->chief[1] = at[1];
    return true;
}

static double aim_determinant(const double m[4])
{
    return m[0] * m[3] - m[1] * m[2];
}

/* -------- rays led along a line in the stop -------- */

/* A ray on its way along the straight line in the stop from the chief ray to its goal. */
struct continuation {
    double goal[2];         /* in the stop, mm */
    double at[2], done;     /* how far it has come: in the beam; share of the way, 1: it is there */
    enum ray_status status; /* what ended the last step, if it led nowhere, and where, 1-based */
    size_t surface;
    /* the step at work: Newton's method to a place of the line */
    double step, share;      /* how long, and how far it leads */
    double target[2];        /* in the stop, mm */
    double here[2], near[2]; /* what is tried; the best so far */
    double left[2], before;  /* what is tried misses the target by; the length of that */
    double slope[4];         /* in the stop by the beam, there or where it was last known */
    double own[4];           /* the same where it has come to */
    int turn;
};

/* How near to its target a step has led. */
static bool continuation_succeeds(const struct aim *aim, const struct continuation *lead)
{
    const double reached = 1e-9; /* radii of the stop */
    return lead->before <= fmax(reached * aim->stop_radius, chief_rounding(aim));
}

static void continuation_begin_step(const struct aim *aim, struct continuation *lead)
{
    lead->share = fmin(lead->done + lead->step, 1);
    for (int k = 0; k < 2; k++) {
        const double centre = aim->centre[k];
        lead->target[k] = centre + lead->share * (lead->goal[k] - centre);
        lead->here[k] = lead->at[k];
    }
    lead->before = INFINITY;
    lead->turn = 0;
    memcpy(lead->slope, lead->own, sizeof lead->slope);
}

/* A step has led there, or nowhere: another. */
static void continuation_end_step(const struct aim *aim, bool succeeds, struct continuation *lead)
{
    if (succeeds) {
        lead->at[0] = lead->near[0];
        lead->at[1] = lead->near[1];
        lead->done = lead->share;
        memcpy(lead->own, lead->slope, sizeof lead->own);
    }
    lead->step *= succeeds ? 1.5 : 0.5;
    continuation_begin_step(aim, lead);
}

/* Does it come nearer by what is tried, which is in a lane? If not the step ends. */
static bool continuation_comes_nearer(const struct aim *aim, size_t lane, struct continuation *lead)
{
    const struct ray_block *block = aim->work.blocks;
    const double miss[2] = {lead->target[0] - block->x[lane], lead->target[1] - block->y[lane]};
    const double after = hypot(miss[0], miss[1]);
    const enum ray_status status = ray_block_status(block, lane);
    if (status != RAY_OK || !(after < lead->before)) {
        lead->status = status != RAY_OK ? status : RAY_NOT_CONVERGED;
        lead->surface = status != RAY_OK ? ray_block_surface(block, lane) : aim->system->stop + 1;
        continuation_end_step(aim, continuation_succeeds(aim, lead), lead);
        return false;
    }
    if (isfinite(lead->before)) {
        /* Broyden's rank-one correction, for where rays about this one are lost */
        const double move[2] = {lead->here[0] - lead->near[0], lead->here[1] - lead->near[1]};
        const double square = move[0] * move[0] + move[1] * move[1];
        for (int i = 0; i < 2; i++) {
            double *row = lead->slope + 2 * i;
            const double more =
                (lead->left[i] - miss[i] - row[0] * move[0] - row[1] * move[1]) / square;
            row[0] += more * move[0];
            row[1] += more * move[1];
        }
    }
    lead->left[0] = miss[0];
    lead->left[1] = miss[1];
    lead->before = after;
    return true;
}

/* Newton's step on the sheet of the chief ray; what has left it ends. */
static void continuation_advance(const struct aim *aim, const double slope[4], bool has_slope,
                                 struct continuation *lead)
{
    enum { TURNS = 12 };
    const double exact = 1e-14;
    if (has_slope) {
        memcpy(lead->slope, slope, sizeof lead->slope);
    }
    slope = lead->slope;
    const double det = aim_determinant(slope);
    /* its ray passes: what ends the step now is a fold, or that it comes no nearer */
    lead->status = RAY_NOT_CONVERGED;
    lead->surface = aim->system->stop + 1;
    if (!(det * aim_determinant(aim->slope) > 0)) {
        continuation_end_step(aim, false, lead);
        return;
    }
    lead->near[0] = lead->here[0];
    lead->near[1] = lead->here[1];
    lead->here[0] += (slope[3] * lead->left[0] - slope[1] * lead->left[1]) / det;
    lead->here[1] += (slope[0] * lead->left[1] - slope[2] * lead->left[0]) / det;
    lead->turn++;
    if (lead->before <= exact * aim->stop_radius || lead->turn == TURNS) {
        continuation_end_step(aim, continuation_succeeds(aim, lead), lead);
    }
}

static void continuation_places(const struct continuation *leads, const size_t *which, size_t count,
                                double (*places)[2])
{
    for (size_t k = 0; k < count; k++) {
        places[k][0] = leads[which[k]].here[0];
        places[k][1] = leads[which[k]].here[1];
    }
}

/* What stops rays that have not come there, though nothing that was tried has: straight on. */
static void continuation_explain(const struct aim *aim, struct continuation *leads, size_t count)
{
    const double least = 1e-6;
    const struct ray_block *block = aim->work.blocks;
    size_t which[RAYS_BLOCK], left = 0;
    for (size_t i = 0; i < count; i++) {
        if (leads[i].done < 1 && leads[i].status == RAY_NOT_CONVERGED) {
            which[left++] = i;
        }
    }
    for (double share = 1; share > least && left > 0; share /= 2) {
        double places[RAYS_BLOCK][2];
        for (size_t k = 0; k < left; k++) {
            const struct continuation *lead = &leads[which[k]];
            const double *m = lead->own, way = share * (1 - lead->done) / aim_determinant(m);
            const double x = way * (lead->goal[0] - aim->centre[0]);
            const double y = way * (lead->goal[1] - aim->centre[1]);
            places[k][0] = lead->at[0] + m[3] * x - m[1] * y;
            places[k][1] = lead->at[1] + m[0] * y - m[2] * x;
        }
        chief_trace(aim, (const double(*)[2])places, left);
        for (size_t k = 0; k < left; k++) {
            if (ray_block_status(block, k) != RAY_OK) {
                leads[which[k]].status = ray_block_status(block, k);
                leads[which[k]].surface = ray_block_surface(block, k);
            }
        }
    }
}

/*
 * Lead rays to their goals, up to RAYS_BLOCK side by side, each as it would go alone.
 *
 * Result    done < 1: the rays of the line end before the goal, or its slopes change their sign:
 *           the pupil is folded there
 * Formula   Newton's method from place to place of the line, with the slopes of each, by steps that
 *           grow where they succeed and are halved where they do not, to 1e-4 of the way
 */
static void continuation_lead(const struct aim *aim, struct continuation *leads, size_t count)
{
    const double first_step = 0.25, least_step = 1e-4;
    double places[RAYS_BLOCK][2], slopes[RAYS_BLOCK][4];
    bool has_slope[RAYS_BLOCK];
    size_t open[RAYS_BLOCK], left = count;
    for (size_t i = 0; i < count; i++) {
        leads[i].at[0] = aim->chief[0];
        leads[i].at[1] = aim->chief[1];
        leads[i].done = 0;
        leads[i].status = RAY_NOT_CONVERGED;
        leads[i].surface = aim->system->stop + 1;
        leads[i].step = first_step;
        memcpy(leads[i].own, aim->slope, sizeof aim->slope);
        continuation_begin_step(aim, &leads[i]);
        open[i] = i;
    }
    while (left > 0) {
        size_t nearer = 0;
        continuation_places(leads, open, left, places);
        chief_trace(aim, (const double(*)[2])places, left);
        for (size_t k = 0; k < left; k++) {
            if (continuation_comes_nearer(aim, k, &leads[open[k]])) {
                open[nearer++] = open[k];
            }
        }
        continuation_places(leads, open, nearer, places);
        chief_slopes(aim, (const double(*)[2])places, nearer, slopes, has_slope);
        for (size_t k = 0; k < nearer; k++) {
            continuation_advance(aim, slopes[k], has_slope[k], &leads[open[k]]);
        }
        left = 0;
        for (size_t i = 0; i < count; i++) {
            if (leads[i].done < 1 && leads[i].step > least_step) {
                open[left++] = i;
            }
        }
    }
    continuation_explain(aim, leads, count);
}

/* -------- whole blocks -------- */

/* Is a ray at its point, on the sheet of the chief ray as its own estimate of slopes shows it? */
static bool aim_block_is_there(const struct aim *aim, const struct aim_block *block, size_t i)
{
    const double most = 2;
    /* of inverse matrices */
    const double det = block->m[0][i] * block->m[3][i] - block->m[1][i] * block->m[2][i];
    const double ratio = aim_determinant(aim->slope) * det;
    return block->state[i] == AIM_DONE && ratio > 1 / most && ratio < most;
}

/*
 * Steps of all rays at once, as long as whole ones lead nearer; those that go astray are left.
 *
 * Given     reached  mm in the stop, which the last step need not leave
 * Result    all are there, on the sheet of the chief ray
 */
static bool aim_block_steer(const struct aim *aim, const struct pupil_point *points, size_t count,
                            double reached, struct aim_block *block)
{
    enum { ALL = 16 };
    const double near = fmax(chief_rounding(aim), reached);
    kernel_aim *kernel = KERNEL_FOR(SET_BEST, kernel_aim);
    bool busy = true, there = true;
    /* from the chief ray, with its slopes; lanes that are not asked for have nothing to do */
    const double *slope = aim->slope, det = aim_determinant(slope);
    const double m[4] = {slope[3] / det, -slope[1] / det, -slope[2] / det, slope[0] / det};
    const size_t lanes = (size_t)kernel_lanes(count);
    block->lanes = (int)lanes;
    for (size_t i = 0; i < lanes; i++) {
        double goal[2];
        aim_goal(aim, &points[i < count ? i : 0], goal);
        double x = goal[0] - aim->centre[0], y = goal[1] - aim->centre[1];
        block->goal_x[i] = goal[0];
        block->goal_y[i] = goal[1];
        block->miss_x[i] = x;
        block->miss_y[i] = y;
        block->state[i] = i >= count || (x == 0 && y == 0) ? AIM_DONE : AIM_OPEN;
    }
    for (size_t i = 0; i < lanes; i++) {
        block->a[i] = aim->chief[0];
        block->b[i] = aim->chief[1];
        block->step_a[i] = m[0] * block->miss_x[i] + m[1] * block->miss_y[i];
        block->step_b[i] = m[2] * block->miss_x[i] + m[3] * block->miss_y[i];
        block->next_a[i] = block->a[i] + block->step_a[i];
        block->next_b[i] = block->b[i] + block->step_b[i];
    }
    for (size_t k = 0; k < 4; k++) {
        for (size_t i = 0; i < lanes; i++) {
            block->m[k][i] = m[k];
        }
    }
    for (int step = 0; step < ALL && busy; step++) {
        beam_start(&aim->beam, block->next_a, block->next_b, count, aim->work.blocks);
        chief_to_stop(aim, count);
        kernel(aim->work.blocks, reached * reached, near * near, block);
        busy = aim_block_open(block) > 0;
    }
    for (size_t i = 0; i < count; i++) {
        there = there && aim_block_is_there(aim, block, i);
    }
    return there;
}

bool aim_rays_straight(const struct aim *aim, const struct pupil_point *points, size_t count,
                       const struct rays *rays)
{
    bool there = true;
    for (size_t done = 0; done < count && there; done += RAYS_BLOCK) {
        const size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        struct aim_block block;
        there = aim_block_steer(aim, points + done, here, 1e-12 * aim->stop_radius, &block);
        beam_start(&aim->beam, block.a, block.b, here, &rays->blocks[done / RAYS_BLOCK]);
    }
    return there;
}

/* A block of rays. Result: how many have been aimed. */
static size_t aim_block_search(const struct aim *aim, const struct pupil_point *points,
                               size_t count, const struct rays *rays)
{
    struct aim_block block;
    struct continuation leads[RAYS_BLOCK];
    size_t which[RAYS_BLOCK], led = 0, aimed = count;
    aim_block_steer(aim, points, count, 1e-15 * aim->stop_radius, &block);
    for (size_t i = 0; i < count; i++) {
        if (!aim_block_is_there(aim, &block, i)) {
            leads[led].goal[0] = block.goal_x[i];
            leads[led].goal[1] = block.goal_y[i];
            which[led++] = i;
        }
    }
    continuation_lead(aim, leads, led);
    beam_start(&aim->beam, block.a, block.b, count, rays->blocks);
    for (size_t k = 0; k < led; k++) {
        const struct continuation *lead = &leads[k];
        struct ray ray = beam_ray(&aim->beam, lead->at[0], lead->at[1]);
        if (lead->done < 1) {
            aimed--;
            ray.status = lead->status;
            ray.surface = lead->surface;
        }
        rays_set(rays, which[k], aim->beam.n, &ray);
    }
    return aimed;
}

/* -------- many blocks -------- */

/* From so many rays on a map is worth its own. */
enum { MANY = 4 * RAYS_BLOCK };

/*
 * The map of the stop, if the pupil has no fold that could be seen: all of its rays are found on
 * the sheet of the chief ray, without going astray.
 */
static bool make_map(const struct aim *aim, struct aim_map *map)
{
    struct aim_block block;
    struct pupil_point points[MAP_NODES];
    double at[MAP_NODES][2];
    aim_map_nodes(at);
    for (size_t i = 0; i < MAP_NODES; i++) {
        points[i] = (struct pupil_point){.x = at[i][0], .y = at[i][1]};
    }
    if (!aim_block_steer(aim, points, MAP_NODES, 1e-15 * aim->stop_radius, &block)) {
        return false;
    }
    aim_map_fit(block.a, block.b, map);
    return true;
}

size_t aim_rays(const struct aim *aim, const struct pupil_point *points, size_t count,
                const struct rays *rays)
{
    struct aim_map map;
    size_t aimed = 0;
    const bool has_map = count >= MANY && make_map(aim, &map);
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        const struct rays block = {rays->blocks + done / RAYS_BLOCK, here};
        aimed += has_map && aim_map_follow(&map, aim, points + done, &block)
                     ? here
                     : aim_block_search(aim, points + done, here, &block);
    }
    return aimed;
}

struct ray aim_ray(const struct aim *aim, double x, double y)
{
    const struct pupil_point point = {.x = x, .y = y};
    struct ray_block block;
    const struct rays one = {&block, 1};
    aim_rays(aim, &point, 1, &one);
    return rays_get(&one, 0, aim->beam.n);
}

bool aim_at_entrance(const struct beam *beam, const struct first_order *first, double x, double y,
                     struct ray *ray, struct error *error)
{
    double radius = first->entrance_diameter / 2, z = first->entrance_pupil;
    if (first->is_telecentric) {
        /*
         * from a point of a telecentric object space: x, y of the slope that the marginal ray has
         */
        const double slope = first->marginal_v / first->index_object, point[2] = {x, y};
        double target[3] = {0, 0, 0}, place[2];
        for (int i = 0; i < 2; i++) {
            /* a chief ray needs no aperture */
            const double u = point[i] != 0 ? point[i] * slope : 0;
            target[i] = -beam->distance * beam->axis[i] + u * beam->distance * beam->axis[2];
        }
        beam_place(beam, target, place);
        *ray = beam_ray(beam, place[0], place[1]);
        return (isfinite(place[0]) && isfinite(place[1])) ||
               fail(error, ERROR_DOMAIN,
                    "the object space is telecentric and the lens has no numerical aperture");
    }
    if (isnan(radius) || isnan(z)) {
        return fail(error, ERROR_DOMAIN,
                    "the lens has no entrance pupil: it has no stop, or no aperture is given");
    }
    if (!isfinite(z)) {
        return fail(error, ERROR_DOMAIN, "the entrance pupil is infinitely far away: {aim} stop");
    }
    if (!(beam->axis[2] > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "a field of 90 deg or more never meets the paraxial entrance pupil: {aim} "
                    "stop");
    }
    const double target[3] = {x * radius, y * radius, z};
    double place[2];
    beam_place(beam, target, place);
    *ray = beam_ray(beam, place[0], place[1]);
    /* beside the axis such rays have places too, but run across it */
    const double gap = beam->foot[2] - beam->distance * beam->axis[2] - z;
    if (!isfinite(place[0]) || !isfinite(place[1]) || fabs(gap) <= 1e-14 * fabs(z)) {
        return fail(error, ERROR_DOMAIN, "the object lies in the plane of the entrance pupil");
    }
    return true;
}
