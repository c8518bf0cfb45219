/* trace/aim.c - Newton's method from the chief ray outwards. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim.h"

#include "trace/chief.h"
#include "trace/dispatch.h"

#include <math.h>

struct ray aim_chief(const struct aim *aim)
{
    return beam_ray(&aim->beam, aim->chief[0], aim->chief[1]);
}

bool aim_open(const struct system *system, const struct beam *beam, struct arena *arena,
              struct aim *aim, struct error *error)
{
    if (system->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: rays cannot be aimed at it");
    }
    if (!(system->stop_radius > 0 && system->stop_radius <= 1e100)) {
        fail(error, ERROR_DOMAIN, "the stop has no diameter: the size of the pupil is not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    *aim = (struct aim){.system = system,
                        .beam = *beam,
                        .stop_radius = system->stop_radius,
                        .work = rays_new(arena, RAYS_BLOCK)};
    aim->has_chief = chief_find(aim, arena, error);
    return aim->has_chief;
}

bool aim_open_at(struct aim *aim, const double at[2])
{
    const struct ray_block *block = aim->work.blocks;
    double slope[4];
    chief_trace(aim, (const double(*)[2])at, 1);
    if (ray_block_status(block, 0) != RAY_OK) {
        return false;
    }
    aim->centre[0] = block->x[0];
    aim->centre[1] = block->y[0];
    if (!chief_slope(aim, at, slope)) {
        return false;
    }
    for (int i = 0; i < 4; i++) {
        aim->slope[i] = slope[i];
    }
    aim->chief[0] = at[0];
    aim->chief[1] = at[1];
    return true;
}

/* The search of one ray. */
struct search {
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

static void multiply(const double m[4], const double v[2], double out[2])
{
    double x = m[0] * v[0] + m[1] * v[1], y = m[2] * v[0] + m[3] * v[1];
    out[0] = x;
    out[1] = y;
}

static void start_search(const struct aim *aim, const struct pupil_point *point,
                         struct search *search)
{
    const double *m = aim->slope, det = m[0] * m[3] - m[1] * m[2];
    *search = (struct search){
        .at = {aim->chief[0], aim->chief[1]},
        .miss = {point->x * aim->stop_radius - aim->centre[0],
                 point->y * aim->stop_radius - aim->centre[1]},
        .inverse = {m[3] / det, -m[1] / det, -m[2] / det, m[0] / det},
        .is_fresh = true,
    };
    multiply(search->inverse, search->miss, search->step);
    search->done = search->miss[0] == 0 && search->miss[1] == 0;
}

/* J^-1 so that it takes the change of the miss to the step just made (Sherman and Morrison). */
static void broyden(struct search *search, const double change[2])
{
    double *m = search->inverse, moved[2], back[2];
    multiply(m, change, moved);
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
static void judge(const struct aim *aim, const struct pupil_point *point, size_t lane,
                  struct search *search)
{
    const struct ray_block *block = aim->work.blocks;
    enum ray_status status = ray_block_status(block, lane);
    double miss[2] = {point->x * aim->stop_radius - block->x[lane],
                      point->y * aim->stop_radius - block->y[lane]};
    double before = hypot(search->miss[0], search->miss[1]), after = hypot(miss[0], miss[1]);
    if (status == RAY_OK && after < before) {
        double change[2] = {search->miss[0] - miss[0], search->miss[1] - miss[1]};
        broyden(search, change);
        for (int i = 0; i < 2; i++) {
            search->at[i] += search->step[i];
            search->miss[i] = miss[i];
        }
        multiply(search->inverse, search->miss, search->step);
        search->halvings = 0;
        search->done = after == 0;
        return;
    }
    if (status != RAY_OK) {
        search->status = status;
        search->surface = ray_block_surface(block, lane);
    }
    bool near = before <= 1e-12 * aim->stop_radius;
    search->halvings++;
    search->is_rough = search->is_rough || !near;
    if (near || search->halvings > HALVINGS) {
        search->done = true;
        return;
    }
    search->step[0] /= 2;
    search->step[1] /= 2;
}

/* The Jacobian at where a search stands, from two rays close by; for searches that got stuck. */
static bool refresh(const struct aim *aim, struct search *search)
{
    double slope[4];
    if (!chief_slope(aim, search->at, slope)) {
        return false;
    }
    double det = slope[0] * slope[3] - slope[1] * slope[2];
    double fresh[4] = {slope[3] / det, -slope[1] / det, -slope[2] / det, slope[0] / det};
    for (int i = 0; i < 4; i++) {
        if (!isfinite(fresh[i])) {
            return false;
        }
        search->inverse[i] = fresh[i];
    }
    multiply(search->inverse, search->miss, search->step);
    search->halvings = 0;
    search->is_fresh = true;
    return true;
}

/* One step of all rays of a block that are still searching; are there any? */
static bool advance_block(const struct aim *aim, const struct pupil_point *points, size_t count,
                          struct search *searches)
{
    bool busy = false;
    for (size_t i = 0; i < count; i++) {
        const struct search *search = &searches[i];
        bool open = !search->done;
        struct ray ray = beam_ray(&aim->beam, search->at[0] + (open ? search->step[0] : 0),
                                  search->at[1] + (open ? search->step[1] : 0));
        rays_set(&aim->work, i, aim->beam.n, &ray);
        busy = busy || open;
    }
    if (!busy) {
        return false;
    }
    chief_to_stop(aim, count);
    for (size_t i = 0; i < count; i++) {
        if (!searches[i].done) {
            judge(aim, &points[i], i, &searches[i]);
        }
    }
    return true;
}

/* A search that ended short of its target tries again with the slopes of where it stands. */
static void retry(const struct aim *aim, const struct pupil_point *point, struct search *search)
{
    const double reached = 1e-9 * aim->stop_radius;
    for (int turn = 0; turn < 20 && hypot(search->miss[0], search->miss[1]) > reached; turn++) {
        double before = hypot(search->miss[0], search->miss[1]);
        search->done = false;
        if (!refresh(aim, search)) {
            return;
        }
        for (int step = 0; step < STEPS && advance_block(aim, point, 1, search); step++) {
        }
        if (!(hypot(search->miss[0], search->miss[1]) < 0.99 * before)) {
            return;
        }
    }
}

static double determinant(const double m[4])
{
    return m[0] * m[3] - m[1] * m[2];
}

static bool has_reached(const struct aim *aim, const struct search *search)
{
    return hypot(search->miss[0], search->miss[1]) <= 1e-9 * aim->stop_radius;
}

/* Newton's method to a place in the stop near by; false if it leaves the sheet of the chief ray. */
static bool step_to(const struct aim *aim, const double target[2], double at[2], double miss[2])
{
    const struct ray_block *block = aim->work.blocks;
    double here[2] = {at[0], at[1]}, before = INFINITY;
    for (int step = 0; step < 12; step++) {
        double slope[4];
        if (!chief_slope(aim, here, slope) || !(determinant(slope) * determinant(aim->slope) > 0)) {
            return false;
        }
        chief_trace(aim, (const double(*)[2])here, 1);
        miss[0] = target[0] - block->x[0];
        miss[1] = target[1] - block->y[0];
        double after = hypot(miss[0], miss[1]), det = determinant(slope);
        if (ray_block_status(block, 0) != RAY_OK || !(after < before)) {
            return before <= 1e-9 * aim->stop_radius;
        }
        before = after;
        at[0] = here[0];
        at[1] = here[1];
        if (after <= 1e-14 * aim->stop_radius) {
            return true;
        }
        here[0] += (slope[3] * miss[0] - slope[1] * miss[1]) / det;
        here[1] += (slope[0] * miss[1] - slope[2] * miss[0]) / det;
    }
    return before <= 1e-9 * aim->stop_radius;
}

/* From the chief ray to the point along a straight line in the stop, in steps that are sure. */
static void lead(const struct aim *aim, const struct pupil_point *point, struct search *search)
{
    const double goal[2] = {point->x * aim->stop_radius, point->y * aim->stop_radius};
    double at[2] = {aim->chief[0], aim->chief[1]}, miss[2] = {0, 0}, done = 0, step = 0.25;
    while (done < 1 && step > 1e-4) {
        double share = fmin(done + step, 1), next[2] = {at[0], at[1]}, target[2];
        for (int i = 0; i < 2; i++) {
            target[i] = aim->centre[i] + share * (goal[i] - aim->centre[i]);
        }
        if (step_to(aim, target, next, miss)) {
            at[0] = next[0];
            at[1] = next[1];
            done = share;
            step *= 1.5;
        } else {
            step /= 2;
        }
    }
    if (done < 1 && !has_reached(aim, search)) {
        return; /* what stopped the search before says more */
    }
    for (int i = 0; i < 2; i++) {
        search->at[i] = at[i];
        search->miss[i] = done < 1 ? (double)INFINITY : miss[i];
    }
    search->status = done < 1 ? RAY_NOT_CONVERGED : RAY_OK;
    search->surface = aim->system->stop + 1;
}

/* Where a block of rays crosses the stop, moved by `more` from where their searches ended. */
static void look_beside(const struct aim *aim, const struct search *searches, size_t count,
                        const double more[2])
{
    double at[RAYS_BLOCK][2];
    for (size_t i = 0; i < count; i++) {
        at[i][0] = searches[i].at[0] + more[0];
        at[i][1] = searches[i].at[1] + more[1];
    }
    chief_trace(aim, (const double(*)[2])at, count);
}

/*
 * Searches that may have ended on another sheet of a folded pupil, or not at all, are led to their
 * targets instead.
 */
static void keep_sheet(const struct aim *aim, const struct pupil_point *points, size_t count,
                       struct search *searches)
{
    const struct ray_block *block = aim->work.blocks;
    const double scale = sqrt(fabs(determinant(aim->slope)));
    const double h = 1e-6 * (scale > 0 ? aim->stop_radius / scale : 1);
    double x[RAYS_BLOCK], y[RAYS_BLOCK];
    bool doubtful[RAYS_BLOCK];
    look_beside(aim, searches, count, (double[2]){h, 0});
    for (size_t i = 0; i < count; i++) {
        x[i] = block->x[i] - (points[i].x * aim->stop_radius - searches[i].miss[0]);
        y[i] = block->y[i] - (points[i].y * aim->stop_radius - searches[i].miss[1]);
    }
    look_beside(aim, searches, count, (double[2]){0, h});
    for (size_t i = 0; i < count; i++) {
        double up = block->y[i] - (points[i].y * aim->stop_radius - searches[i].miss[1]);
        double aside = block->x[i] - (points[i].x * aim->stop_radius - searches[i].miss[0]);
        double det = x[i] * up - y[i] * aside;
        doubtful[i] = searches[i].is_rough || !has_reached(aim, &searches[i]) ||
                      !(det * determinant(aim->slope) > 0);
    }
    for (size_t i = 0; i < count; i++) {
        if (doubtful[i]) {
            lead(aim, &points[i], &searches[i]);
        }
    }
}

static bool finish(const struct aim *aim, const struct search *search, struct ray *ray)
{
    *ray = beam_ray(&aim->beam, search->at[0], search->at[1]);
    if (has_reached(aim, search)) {
        return true;
    }
    ray->status = search->status == RAY_OK ? RAY_NOT_CONVERGED : search->status;
    ray->surface = search->status == RAY_OK ? aim->system->stop + 1 : search->surface;
    return false;
}

size_t aim_rays(const struct aim *aim, const struct pupil_point *points, size_t count,
                const struct rays *rays)
{
    struct search searches[RAYS_BLOCK];
    size_t aimed = 0;
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            start_search(aim, &points[done + i], &searches[i]);
        }
        for (int step = 0; step < STEPS; step++) {
            if (!advance_block(aim, points + done, here, searches)) {
                break;
            }
        }
        for (size_t i = 0; i < here; i++) {
            retry(aim, &points[done + i], &searches[i]);
        }
        keep_sheet(aim, points + done, here, searches);
        for (size_t i = 0; i < here; i++) {
            struct ray ray;
            aimed += finish(aim, &searches[i], &ray) ? 1 : 0;
            rays_set(rays, done + i, aim->beam.n, &ray);
        }
    }
    return aimed;
}

struct ray aim_ray(const struct aim *aim, double x, double y)
{
    const struct pupil_point point = {x, y, 1};
    struct search search;
    struct ray ray;
    start_search(aim, &point, &search);
    for (int step = 0; step < STEPS && advance_block(aim, &point, 1, &search); step++) {
    }
    retry(aim, &point, &search);
    keep_sheet(aim, &point, 1, &search);
    finish(aim, &search, &ray);
    return ray;
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
