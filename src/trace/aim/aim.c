/* trace/aim/aim.c - Newton's method from the chief ray outwards. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aim.h"

#include "trace/aim/aim_block.h"
#include "trace/aim/aim_map.h"
#include "trace/aim/chief.h"
#include "trace/aim/continuation.h"
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

/* The search of one ray. */
struct aim_search {
    double at[2], step[2];
    double miss[2];    /* what is left to the target in the stop, mm */
    double inverse[4]; /* d(a, b)/d(x, y in the stop), Broyden's estimate */
    enum ray_status status;
    size_t surface;
    int halvings;
    bool done, is_fresh; /* is the estimate the chief ray's own? */
    bool is_rough;       /* a whole step led away, or lost the ray: who knows where to */
};

enum { STEPS = 60, HALVINGS = 40 };

static void matrix_times_vector(const double m[4], const double v[2], double out[2])
{
    double x = m[0] * v[0] + m[1] * v[1], y = m[2] * v[0] + m[3] * v[1];
    out[0] = x;
    out[1] = y;
}

static void start_search(const struct aim *aim, const struct pupil_point *point,
                         struct aim_search *search)
{
    const double *m = aim->slope, det = m[0] * m[3] - m[1] * m[2];
    double goal[2];
    aim_goal(aim, point, goal);
    *search = (struct aim_search){
        .at = {aim->chief[0], aim->chief[1]},
        .miss = {goal[0] - aim->centre[0], goal[1] - aim->centre[1]},
        .inverse = {m[3] / det, -m[1] / det, -m[2] / det, m[0] / det},
        .is_fresh = true,
    };
    matrix_times_vector(search->inverse, search->miss, search->step);
    search->done = search->miss[0] == 0 && search->miss[1] == 0;
}

/* J^-1 so that it takes the change of the miss to the step just made (Sherman and Morrison). */
static void aim_search_broyden(struct aim_search *search, const double change[2])
{
    double *m = search->inverse, moved[2], back[2];
    matrix_times_vector(m, change, moved);
    const double *s = search->step;
    double denominator = s[0] * moved[0] + s[1] * moved[1];
    if (!(fabs(denominator) > 1e-12 * (s[0] * s[0] + s[1] * s[1]))) {
        return;
    }
    back[0] = (s[0] * m[0] + s[1] * m[2]) / denominator;
    back[1] = (s[0] * m[1] + s[1] * m[3]) / denominator;
    double more[2] = {s[0] - moved[0], s[1] - moved[1]};
    for (int i = 0; i < 4; i++) {
        m[i] += more[i / 2] * back[i % 2];
    }
    search->is_fresh = false;
}

/* What the step has brought: the ray in the stop, or lost on the way. */
static void aim_search_judge(const struct aim *aim, const struct pupil_point *point, size_t lane,
                             struct aim_search *search)
{
    const struct ray_block *block = aim->work.blocks;
    enum ray_status status = ray_block_status(block, lane);
    double goal[2];
    aim_goal(aim, point, goal);
    double miss[2] = {goal[0] - block->x[lane], goal[1] - block->y[lane]};
    double before = hypot(search->miss[0], search->miss[1]), after = hypot(miss[0], miss[1]);
    if (status == RAY_OK && after < before) {
        double change[2] = {search->miss[0] - miss[0], search->miss[1] - miss[1]};
        aim_search_broyden(search, change);
        for (int i = 0; i < 2; i++) {
            search->at[i] += search->step[i];
            search->miss[i] = miss[i];
        }
        matrix_times_vector(search->inverse, search->miss, search->step);
        search->halvings = 0;
        search->done = after == 0;
        return;
    }
    if (status != RAY_OK) {
        search->status = status;
        search->surface = ray_block_surface(block, lane);
    }
    bool near = before <= chief_rounding(aim);
    search->halvings++;
    search->is_rough = search->is_rough || !near;
    if (near || search->halvings > HALVINGS) {
        search->done = true;
        return;
    }
    search->step[0] /= 2;
    search->step[1] /= 2;
}

/* One step of all rays of a block that are still searching; are there any? */
static bool advance_block(const struct aim *aim, const struct pupil_point *points, size_t count,
                          struct aim_search *searches)
{
    size_t open[RAYS_BLOCK], lanes = 0;
    for (size_t i = 0; i < count; i++) {
        const struct aim_search *search = &searches[i];
        if (!search->done) {
            struct ray ray = beam_ray(&aim->beam, search->at[0] + search->step[0],
                                      search->at[1] + search->step[1]);
            rays_set(&aim->work, lanes, aim->beam.n, &ray);
            open[lanes++] = i;
        }
    }
    if (lanes == 0) {
        return false;
    }
    chief_to_stop(aim, lanes);
    for (size_t k = 0; k < lanes; k++) {
        aim_search_judge(aim, &points[open[k]], k, &searches[open[k]]);
    }
    return true;
}

static double aim_search_miss(const struct aim_search *search)
{
    return hypot(search->miss[0], search->miss[1]);
}

static bool has_reached(const struct aim *aim, const struct aim_search *search)
{
    return aim_search_miss(search) <= fmax(lead_reached * aim->stop_radius, chief_rounding(aim));
}

/* The Jacobian at where a search stands, for one that got stuck. */
static bool aim_search_refresh_jacobian(const double slope[4], struct aim_search *search)
{
    const double det = slope[0] * slope[3] - slope[1] * slope[2];
    const double fresh[4] = {slope[3] / det, -slope[1] / det, -slope[2] / det, slope[0] / det};
    for (int i = 0; i < 4; i++) {
        if (!isfinite(fresh[i])) {
            return false;
        }
        search->inverse[i] = fresh[i];
    }
    matrix_times_vector(search->inverse, search->miss, search->step);
    search->halvings = 0;
    search->is_fresh = true;
    search->done = false;
    return true;
}

/* Those that begin anew with slopes of where they stand. Result: how many there are in `which`. */
static size_t refresh_some(const struct aim *aim, struct aim_search *searches, size_t *which,
                           size_t count)
{
    double places[RAYS_BLOCK][2], slopes[RAYS_BLOCK][4];
    bool found[RAYS_BLOCK];
    size_t left = 0;
    for (size_t k = 0; k < count; k++) {
        places[k][0] = searches[which[k]].at[0];
        places[k][1] = searches[which[k]].at[1];
    }
    chief_slopes(aim, (const double(*)[2])places, count, slopes, found);
    for (size_t k = 0; k < count; k++) {
        if (found[k] && aim_search_refresh_jacobian(slopes[k], &searches[which[k]])) {
            which[left++] = which[k];
        }
    }
    return left;
}

/* Searches that ended short of their targets try again with the slopes of where they stand, as
   long as that brings them nearer. */
static void aim_block_retry(const struct aim *aim, const struct pupil_point *points, size_t count,
                            struct aim_search *searches)
{
    enum { TURNS = 20 };
    size_t which[RAYS_BLOCK], some = 0;
    double before[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        searches[i].done = true;
        before[i] = INFINITY;
        which[some++] = i;
    }
    for (int turn = 0; turn < TURNS && some > 0; turn++) {
        size_t left = 0;
        for (size_t k = 0; k < some; k++) {
            const struct aim_search *search = &searches[which[k]];
            if (aim_search_miss(search) < 0.99 * before[which[k]] && !has_reached(aim, search)) {
                before[which[k]] = aim_search_miss(search);
                which[left++] = which[k];
            }
        }
        some = refresh_some(aim, searches, which, left);
        for (int step = 0; step < STEPS && advance_block(aim, points, count, searches); step++) {
        }
        for (size_t k = 0; k < some; k++) {
            searches[which[k]].done = true;
        }
    }
}

static double aim_determinant(const double m[4])
{
    return m[0] * m[3] - m[1] * m[2];
}

static bool aim_search_finish(const struct aim *aim, const struct aim_search *search,
                              struct ray *ray)
{
    *ray = beam_ray(&aim->beam, search->at[0], search->at[1]);
    if (has_reached(aim, search)) {
        return true;
    }
    ray->status = search->status == RAY_OK ? RAY_NOT_CONVERGED : search->status;
    ray->surface = search->status == RAY_OK ? aim->system->stop + 1 : search->surface;
    return false;
}

/* -------- whole blocks -------- */

/* From the chief ray, with its slopes; lanes that are not asked for have nothing to do. */
static void aim_block_start(const struct aim *aim, const struct pupil_point *points, size_t count,
                            struct aim_block *block)
{
    struct aim_search first;
    start_search(aim, &points[0], &first);
    const double *m = first.inverse;
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
        block->a[i] = first.at[0];
        block->b[i] = first.at[1];
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
}

/* Steps of all rays at once, as long as whole ones lead nearer; those that go astray are left. */
static void steer_block(const struct aim *aim, size_t count, struct aim_block *block)
{
    enum { ALL = 16 };
    const double reached = 1e-15 * aim->stop_radius, near = chief_rounding(aim);
    kernel_aim *kernel = KERNEL_FOR(SET_BEST, kernel_aim);
    bool busy = true;
    for (int step = 0; step < ALL && busy; step++) {
        beam_start(&aim->beam, block->next_a, block->next_b, count, aim->work.blocks);
        chief_to_stop(aim, count);
        kernel(aim->work.blocks, reached * reached, near * near, block);
        busy = aim_block_open(block) > 0;
    }
}

/* Searches with halved steps, from the chief ray again. */
static void search_points(const struct aim *aim, const struct pupil_point *points, size_t count,
                          struct aim_search *searches)
{
    for (size_t i = 0; i < count; i++) {
        start_search(aim, &points[i], &searches[i]);
    }
    for (int step = 0; step < STEPS && advance_block(aim, points, count, searches); step++) {
    }
    aim_block_retry(aim, points, count, searches);
}

/* How far beside their places in the stop rays cross it that start so much beside their own. */
static void look_beside(const struct aim *aim, const struct aim_block *block, size_t count,
                        double more_a, double more_b, double *x, double *y)
{
    double a[RAYS_BLOCK], b[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        a[i] = block->a[i] + more_a;
        b[i] = block->b[i] + more_b;
    }
    beam_start(&aim->beam, a, b, count, aim->work.blocks);
    chief_to_stop(aim, count);
    for (size_t i = 0; i < count; i++) {
        x[i] = aim->work.blocks->x[i] - (block->goal_x[i] - block->miss_x[i]);
        y[i] = aim->work.blocks->y[i] - (block->goal_y[i] - block->miss_y[i]);
    }
}

/* Do the searches' own estimates show nothing of a fold: slopes like the chief ray's? */
static bool aim_block_is_plain(const struct aim *aim, const struct aim_block *block, size_t count)
{
    const double most = 2, slope = aim_determinant(aim->slope);
    bool plain = true;
    for (size_t i = 0; i < count; i++) {
        /* of inverse matrices */
        double ratio = slope * (block->m[0][i] * block->m[3][i] - block->m[1][i] * block->m[2][i]);
        plain = plain && ratio > 1 / most && ratio < most;
    }
    return plain;
}

/*
 * Is the sign of the Jacobian where searches ended that of the chief ray? It is not on the other
 * sheet of a folded pupil.
 */
static void find_sheets(const struct aim *aim, const struct aim_block *block, size_t count,
                        bool *same)
{
    const double scale = sqrt(fabs(aim_determinant(aim->slope)));
    const double h = 1e-6 * (scale > 0 ? aim->stop_radius / scale : 1);
    double x[2][RAYS_BLOCK], y[2][RAYS_BLOCK];
    const bool plain = aim_block_is_plain(aim, block, count);
    if (!plain) {
        look_beside(aim, block, count, h, 0, x[0], y[0]);
        look_beside(aim, block, count, 0, h, x[1], y[1]);
    }
    for (size_t i = 0; i < count; i++) {
        same[i] =
            plain || (x[0][i] * y[1][i] - y[0][i] * x[1][i]) * aim_determinant(aim->slope) > 0;
    }
}

/* The rays of a block that went astray, or may have ended on another sheet of a folded pupil. */
struct strays {
    struct pupil_point points[RAYS_BLOCK];
    struct aim_search searches[RAYS_BLOCK];
    size_t which[RAYS_BLOCK], count;
};

static void find_strays(const struct aim *aim, const struct pupil_point *points, size_t count,
                        struct aim_block *block, struct strays *strays)
{
    strays->count = 0;
    for (size_t i = 0; i < count; i++) {
        if (block->state[i] != AIM_DONE) {
            strays->points[strays->count] = points[i];
            strays->which[strays->count++] = i;
        }
    }
    search_points(aim, strays->points, strays->count, strays->searches);
    for (size_t k = 0; k < strays->count; k++) {
        const size_t i = strays->which[k];
        block->a[i] = strays->searches[k].at[0];
        block->b[i] = strays->searches[k].at[1];
        block->miss_x[i] = strays->searches[k].miss[0];
        block->miss_y[i] = strays->searches[k].miss[1];
    }
}

/* Searches that ended on another sheet, beside those that went astray. */
static void add_others(const struct pupil_point *points, size_t count, const bool *same,
                       const struct aim_block *block, struct strays *strays)
{
    for (size_t i = 0; i < count; i++) {
        if (block->state[i] == AIM_DONE && !same[i]) {
            strays->points[strays->count] = points[i];
            strays->searches[strays->count] = (struct aim_search){
                .at = {block->a[i], block->b[i]}, .miss = {block->miss_x[i], block->miss_y[i]}};
            strays->which[strays->count++] = i;
        }
    }
}

/* What leading a ray to its goal says of its search. */
static void take_lead(const struct aim *aim, const struct continuation *lead,
                      struct aim_search *search)
{
    const bool is_there = !(lead->done < 1);
    if (!is_there && !has_reached(aim, search)) {
        return; /* what stopped the search before says more */
    }
    for (int i = 0; i < 2; i++) {
        search->at[i] = lead->at[i];
        search->miss[i] = is_there ? lead->miss[i] : (double)INFINITY;
    }
    search->status = is_there ? RAY_OK : RAY_NOT_CONVERGED;
    search->surface = aim->system->stop + 1;
}

/* Those that may have ended on another sheet, or nowhere, are led to their goals. */
static void lead_strays(const struct aim *aim, const bool *same, struct strays *strays)
{
    struct continuation leads[RAYS_BLOCK];
    size_t led[RAYS_BLOCK], count = 0;
    for (size_t k = 0; k < strays->count; k++) {
        const struct aim_search *search = &strays->searches[k];
        if (search->is_rough || !has_reached(aim, search) || !same[strays->which[k]]) {
            aim_goal(aim, &strays->points[k], leads[count].goal);
            led[count++] = k;
        }
    }
    continuation_rays(aim, leads, count);
    for (size_t j = 0; j < count; j++) {
        take_lead(aim, &leads[j], &strays->searches[led[j]]);
    }
}

/* A block of rays. Result: how many have been aimed. */
static size_t aim_block_search(const struct aim *aim, const struct pupil_point *points,
                               size_t count, const struct rays *rays)
{
    struct aim_block block;
    struct strays strays;
    bool same[RAYS_BLOCK];
    aim_block_start(aim, points, count, &block);
    steer_block(aim, count, &block);
    find_strays(aim, points, count, &block, &strays);
    find_sheets(aim, &block, count, same);
    add_others(points, count, same, &block, &strays);
    lead_strays(aim, same, &strays);
    beam_start(&aim->beam, block.a, block.b, count, rays->blocks);
    size_t aimed = count;
    for (size_t k = 0; k < strays.count; k++) {
        struct ray ray;
        aimed -= aim_search_finish(aim, &strays.searches[k], &ray) ? 0 : 1;
        rays_set(rays, strays.which[k], aim->beam.n, &ray);
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
        points[i] = (struct pupil_point){at[i][0], at[i][1], 0};
    }
    aim_block_start(aim, points, MAP_NODES, &block);
    steer_block(aim, MAP_NODES, &block);
    for (size_t i = 0; i < MAP_NODES; i++) {
        if (block.state[i] != AIM_DONE) {
            return false;
        }
    }
    if (!aim_block_is_plain(aim, &block, MAP_NODES)) {
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
    const struct pupil_point point = {x, y, 1};
    struct ray_block block;
    const struct rays one = {&block, 1};
    aim_rays(aim, &point, 1, &one);
    return rays_get(&one, 0, aim->beam.n);
}

/* From a point of a telecentric object space: x, y of the slope that the marginal ray has. */
static bool aim_telecentric(const struct beam *beam, const struct first_order *first, double x,
                            double y, struct ray *ray, struct error *error)
{
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

bool aim_at_entrance(const struct beam *beam, const struct first_order *first, double x, double y,
                     struct ray *ray, struct error *error)
{
    double radius = first->entrance_diameter / 2, z = first->entrance_pupil;
    if (first->is_telecentric) {
        return aim_telecentric(beam, first, x, y, ray, error);
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
    if (!isfinite(place[0]) || !isfinite(place[1])) {
        return fail(error, ERROR_DOMAIN, "the object lies in the plane of the entrance pupil");
    }
    return true;
}
