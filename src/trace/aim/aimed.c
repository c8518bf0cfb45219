/* trace/aim/aimed.c - rays that stay aimed while the lens changes, and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aimed.h"

#include "trace/aim/aim_block.h"
#include "trace/tangent.h"

#include <math.h>
#include <string.h>

void aimed_work_open(const struct system *system, struct arena *arena, struct aimed_work *work)
{
    const struct rays rays = rays_new(arena, (size_t)5 * RAYS_BLOCK);
    *work = (struct aimed_work){.tape = derivative_tape_new(system, arena),
                                .start = rays.blocks,
                                .slopes = rays.blocks + 1,
                                .tangents = rays.blocks + 3};
}

void aimed_open(struct aimed_beam *beams, size_t beam_count, bool at_stop, struct aimed_work *work,
                struct aimed *aimed)
{
    const struct aimed_beam *last = &beams[beam_count - 1];
    *aimed = (struct aimed){.work = work,
                            .beams = beams,
                            .beam_count = beam_count,
                            .count = last->first + last->count,
                            .at_stop = at_stop};
    aimed->lanes = kernel_lanes((size_t)aimed->count);
}

/* -------- where rays start -------- */

/* The arrays of a block, but for `lost`. */
enum { ARRAYS = 7 };
static void arrays_of(struct ray_block *block, double *arrays[ARRAYS + 1])
{
    double *const all[] = {block->x, block->y, block->z,    block->p,
                           block->q, block->r, block->path, block->lost};
    memcpy(arrays, all, sizeof all);
}

/* The first `count` lanes of one block into those of another from `first` on. */
static void aimed_copy_lanes(struct ray_block *to, int first, struct ray_block *from, int count)
{
    double *target[ARRAYS + 1], *source[ARRAYS + 1];
    arrays_of(to, target);
    arrays_of(from, source);
    for (int k = 0; k <= ARRAYS; k++) {
        memcpy(target[k] + first, source[k], (size_t)count * sizeof(double));
    }
}

/* Lanes that nobody uses are as the first. */
static void fill_up(const struct aimed *aimed, struct ray_block *block)
{
    double *all[ARRAYS + 1];
    arrays_of(block, all);
    for (int k = 0; k <= ARRAYS; k++) {
        for (int i = aimed->count; i < aimed->lanes; i++) {
            all[k][i] = all[k][0];
        }
    }
}

/* All rays from coordinates in their beams. */
static void aimed_start_rays(const struct aimed *aimed, const double *a, const double *b,
                             struct ray_block *start)
{
    struct ray_block part;
    for (size_t g = 0; g < aimed->beam_count; g++) {
        const struct aimed_beam *at = &aimed->beams[g];
        struct ray_block *to = at->first == 0 ? start : &part;
        beam_start(&at->beam, a + at->first, b + at->first, (size_t)at->count, to);
        if (to == &part) {
            aimed_copy_lanes(start, at->first, &part, at->count);
        }
    }
    fill_up(aimed, start);
}

/* -------- trace and sweep -------- */

/* The axes of the stop by itself in which its x and y are counted, in the frame of the axis. */
static void stop_axes(const struct system *system, double axes[2][3])
{
    double origin[3] = {0, 0, 0};
    memset(axes, 0, 6 * sizeof(double));
    axes[0][0] = axes[1][1] = 1;
    if (system->lens->surfaces[system->stop].decentre == NULL) {
        return;
    }
    system_to_own(system, system->stop, origin);
    for (int k = 0; k < 3; k++) {
        double unit[3] = {k == 0, k == 1, k == 2};
        system_to_own(system, system->stop, unit);
        axes[0][k] = unit[0] - origin[0];
        axes[1][k] = unit[1] - origin[1];
    }
}

static void trace_tape(struct aimed *aimed)
{
    struct aimed_work *work = aimed->work;
    const struct system *system = aimed->system;
    work->tape.lanes = aimed->lanes;
    derivative_trace(system, work->start, aimed->set, &work->tape);
    /*
     * how the start of each ray changes with a and b; the path is that from the point of the object
     */
    static const double ways[2][2] = {{1, 0}, {0, 1}};
    const struct ray_block *start = aimed->work->start;
    struct ray_block rays, part;
    for (size_t g = 0; g < aimed->beam_count; g++) {
        const struct aimed_beam *at = &aimed->beams[g];
        for (int i = 0; i < at->count; i++) {
            const int lane = at->first + i;
            rays.x[i] = start->x[lane], rays.y[i] = start->y[lane], rays.z[i] = start->z[lane];
            rays.p[i] = start->p[lane], rays.q[i] = start->q[lane], rays.r[i] = start->r[lane];
        }
        for (int k = 0; k < 2; k++) {
            beam_tangents(&at->beam, ways[k], &rays, (size_t)at->count, &part);
            for (int i = 0; i < at->count; i++) {
                part.path[i] =
                    rays.p[i] * part.x[i] + rays.q[i] * part.y[i] + rays.r[i] * part.z[i];
                part.lost[i] = 0;
            }
            aimed_copy_lanes(&aimed->work->slopes[k], at->first, &part, at->count);
        }
    }
    fill_up(aimed, &aimed->work->slopes[0]);
    fill_up(aimed, &aimed->work->slopes[1]);
    if (aimed->at_stop) {
        work->tangents[0] = work->slopes[0];
        work->tangents[1] = work->slopes[1];
        tangent_trace_start(system, system->stop + 1, 2, aimed->set, &work->tape, work->tangents);
        /* d(a, b)/d(x, y in the stop) from how rays move there */
        const struct ray_block *a = &aimed->work->tangents[0], *b = &aimed->work->tangents[1];
        double axes[2][3];
        stop_axes(aimed->system, axes);
        const double *u = axes[0], *v = axes[1];
        for (int i = 0; i < aimed->lanes; i++) {
            const double xa = u[0] * a->x[i] + u[1] * a->y[i] + u[2] * a->z[i];
            const double xb = u[0] * b->x[i] + u[1] * b->y[i] + u[2] * b->z[i];
            const double ya = v[0] * a->x[i] + v[1] * a->y[i] + v[2] * a->z[i];
            const double yb = v[0] * b->x[i] + v[1] * b->y[i] + v[2] * b->z[i];
            const double over = 1 / (xa * yb - xb * ya);
            aimed->inverse[0][i] = yb * over;
            aimed->inverse[1][i] = -xb * over;
            aimed->inverse[2][i] = -ya * over;
            aimed->inverse[3][i] = xa * over;
        }
    }
}

void aimed_trace(struct aimed *aimed, bool derives, struct ray_block *end)
{
    const struct system *system = aimed->system;
    aimed_start_rays(aimed, aimed->a, aimed->b, aimed->work->start);
    if (derives) {
        trace_tape(aimed);
        *end = aimed->work->tape.blocks[system->begin[system->places]];
        return;
    }
    if (aimed->keeps) {
        aimed->work->tape.lanes = aimed->lanes;
        *end = *derivative_trace(system, aimed->work->start, aimed->set, &aimed->work->tape);
        return;
    }
    *end = *aimed->work->start;
    const struct rays rays = {end, (size_t)aimed->count};
    rays_trace(system, &rays, &(struct trace_way){.set = aimed->set});
}

/* What a function gains along a change of the rays; in parts whose size the compiler knows. */
static void adjoint_dot_change(const struct ray_block *restrict adjoint,
                               const struct ray_block *restrict change, int lanes,
                               double *restrict gain)
{
    for (int from = 0; from < lanes; from += RAYS_FEW) {
        for (int i = from; i < from + RAYS_FEW; i++) {
            gain[i] = adjoint->x[i] * change->x[i] + adjoint->y[i] * change->y[i] +
                      adjoint->z[i] * change->z[i] + adjoint->p[i] * change->p[i] +
                      adjoint->q[i] * change->q[i] + adjoint->r[i] * change->r[i] +
                      adjoint->path[i] * change->path[i];
        }
    }
}

/* What a function gains along a and b: of the rays as they are, and of a and b themselves. */
static void along_start(const struct aimed *aimed, const struct ray_block *adjoint,
                        const struct ray_block *changes, double *fa, double *fb)
{
    double *const gains[2] = {fa, fb};
    for (int k = 0; k < 2; k++) {
        adjoint_dot_change(adjoint, &changes[k], aimed->lanes, gains[k]);
        for (int i = 0; i < aimed->count && aimed->by_start[k] != NULL; i++) {
            gains[k][i] += aimed->by_start[k][i];
        }
    }
}

/* What the stop adds to x and y there, where the function is by a and b that. */
static void aim_back(const struct aimed *aimed, const double *fa, const double *fb, double *x,
                     double *y, struct aimed_rates *rates)
{
    for (int i = 0; i < aimed->lanes; i++) {
        x[i] = -(fa[i] * aimed->inverse[0][i] + fb[i] * aimed->inverse[2][i]);
        y[i] = -(fa[i] * aimed->inverse[1][i] + fb[i] * aimed->inverse[3][i]);
        rates->radius[i] = -(x[i] * aimed->x[i] + y[i] * aimed->y[i]);
        rates->place[i] = 0;
    }
}

/* What a function by a and b is by the entrance pupil. */
static void move_pupil(const struct aimed *aimed, const double *fa, const double *fb,
                       struct aimed_rates *rates)
{
    for (int i = 0; i < aimed->lanes; i++) {
        rates->radius[i] = fa[i] * aimed->by_radius[0][i] + fb[i] * aimed->by_radius[1][i];
        rates->place[i] = fa[i] * aimed->by_place[0][i] + fb[i] * aimed->by_place[1][i];
    }
}

/*
 * Of functions that may lie before the stop: one sweep for what they are by a and b, and another
 * with what the stop adds to that. Both begin before `from`, and gain `given` before `place`.
 */
static void sweep_twice(const struct aimed *aimed, struct derivative_pass *pass, size_t from,
                        size_t place, const struct ray_block *given, struct aimed_rates *rates)
{
    double fa[RAYS_BLOCK], fb[RAYS_BLOCK], x[RAYS_BLOCK], y[RAYS_BLOCK];
    struct ray_block *adjoint = pass->adjoint;
    for (int turn = 0; turn < 2; turn++) {
        memset(adjoint, 0, sizeof *adjoint);
        derivative_pass_begin(pass, from);
        derivative_pass_part(pass, from, place);
        for (int i = 0; i < aimed->lanes && given != NULL; i++) {
            adjoint->x[i] += given->x[i], adjoint->y[i] += given->y[i];
            adjoint->z[i] += given->z[i], adjoint->path[i] += given->path[i];
            adjoint->p[i] += given->p[i], adjoint->q[i] += given->q[i];
            adjoint->r[i] += given->r[i];
        }
        derivative_pass_part(pass, place, 0);
        if (turn == 1) {
            return;
        }
        along_start(aimed, adjoint, aimed->work->slopes, fa, fb);
        if (!aimed->at_stop) {
            move_pupil(aimed, fa, fb, rates);
            return;
        }
        aim_back(aimed, fa, fb, x, y, rates);
        pass->at = aimed->system->stop;
        pass->add_x = x;
        pass->add_y = y;
    }
}

void aimed_sweep(const struct aimed *aimed, const struct derivative_layout *layout, size_t place,
                 struct ray_block *adjoint, double *gradient, struct aimed_rates *rates)
{
    struct derivative_pass pass = {.system = aimed->system,
                                   .layout = layout,
                                   .set = aimed->set,
                                   .tape = &aimed->work->tape,
                                   .adjoint = adjoint,
                                   .gradient = gradient};
    const size_t stop = aimed->system->stop;
    if (aimed->at_stop && place <= stop) {
        const struct ray_block given = *adjoint;
        sweep_twice(aimed, &pass, stop + 1, place, &given, rates);
        return;
    }
    double x[RAYS_BLOCK], y[RAYS_BLOCK], fa[RAYS_BLOCK], fb[RAYS_BLOCK];
    derivative_pass_begin(&pass, place);
    if (!aimed->at_stop) {
        derivative_pass_part(&pass, place, 0);
        along_start(aimed, adjoint, aimed->work->slopes, fa, fb);
        move_pupil(aimed, fa, fb, rates);
        return;
    }
    derivative_pass_part(&pass, place, stop + 1);
    along_start(aimed, adjoint, aimed->work->tangents, fa, fb);
    aim_back(aimed, fa, fb, x, y, rates);
    pass.at = stop;
    pass.add_x = x;
    pass.add_y = y;
    derivative_pass_part(&pass, stop + 1, 0);
}

void aimed_sweep_seeds(const struct aimed *aimed, const struct derivative_layout *layout,
                       const struct derivative_seeds *seeds, struct ray_block *adjoint,
                       double *gradient, struct aimed_rates *rates)
{
    struct derivative_pass pass = {.system = aimed->system,
                                   .layout = layout,
                                   .set = aimed->set,
                                   .tape = &aimed->work->tape,
                                   .adjoint = adjoint,
                                   .gradient = gradient,
                                   .seeds = *seeds};
    sweep_twice(aimed, &pass, aimed->system->places, 0, NULL, rates);
}

/* -------- aim -------- */

/* Where rays that start there cross the stop. */
static void aimed_trace_to_stop(const struct aimed *aimed, const double *a, const double *b,
                                struct ray_block *block)
{
    const struct system *system = aimed->system;
    const struct rays rays = {block, (size_t)aimed->lanes}; /* those that nobody uses arrive, too */
    const struct trace_way way = {.set = aimed->set};
    aimed_start_rays(aimed, a, b, block);
    rays_trace_part(system, 0, system->stop + 1, &rays, &way);
    if (system->lens->surfaces[system->stop].decentre != NULL) {
        double axes[2][3], origin[3] = {0, 0, 0};
        stop_axes(system, axes);
        system_to_own(system, system->stop, origin);
        for (int i = 0; i < aimed->lanes; i++) {
            const double x = block->x[i], y = block->y[i], z = block->z[i];
            block->x[i] = origin[0] + axes[0][0] * x + axes[0][1] * y + axes[0][2] * z;
            block->y[i] = origin[1] + axes[1][0] * x + axes[1][1] * y + axes[1][2] * z;
        }
    }
}

/* From the lens before. */
static bool aimed_steer(struct aimed *aimed)
{
    enum { STEPS = 10 };
    const double radius = aimed->system->stop_radius;
    const double enough = 1e-15 * radius, near = 1e-12 * radius;
    struct ray_block *at = aimed->work->start;
    struct aim_block block;
    aimed_trace_to_stop(aimed, aimed->a, aimed->b, at);
    /* from where they are, if no ray is lost there */
    bool arrives = true;
    block.lanes = aimed->lanes;
    for (int i = 0; i < aimed->lanes; i++) {
        arrives = arrives && at->lost[i] == 0;
        block.goal_x[i] = aimed->x[i] * radius;
        block.goal_y[i] = aimed->y[i] * radius;
        block.a[i] = aimed->a[i];
        block.b[i] = aimed->b[i];
        block.miss_x[i] = block.goal_x[i] - at->x[i];
        block.miss_y[i] = block.goal_y[i] - at->y[i];
        block.state[i] = block.miss_x[i] == 0 && block.miss_y[i] == 0 ? AIM_DONE : AIM_OPEN;
        const double mx = block.miss_x[i], my = block.miss_y[i];
        for (int k = 0; k < 4; k++) {
            block.m[k][i] = aimed->inverse[k][i];
        }
        block.step_a[i] = block.m[0][i] * mx + block.m[1][i] * my;
        block.step_b[i] = block.m[2][i] * mx + block.m[3][i] * my;
        block.next_a[i] = block.a[i] + block.step_a[i];
        block.next_b[i] = block.b[i] + block.step_b[i];
    }
    if (!arrives) {
        return false;
    }
    kernel_aim *kernel = KERNEL_FOR(aimed->set, kernel_aim);
    for (int step = 0; step < STEPS && aim_block_open(&block) > 0; step++) {
        aimed_trace_to_stop(aimed, block.next_a, block.next_b, at);
        kernel(at, enough * enough, near * near, &block);
    }
    /* are they all there, and as near to where they were as on the same sheet of the pupil? */
    const double most = 4; /* what the pupil's scale may change by */
    bool done = true;
    for (int i = 0; i < aimed->lanes; i++) {
        const double was = aimed->inverse[0][i] * aimed->inverse[3][i] -
                           aimed->inverse[1][i] * aimed->inverse[2][i];
        const double is = block.m[0][i] * block.m[3][i] - block.m[1][i] * block.m[2][i];
        const double ratio = is / was;
        done = done && block.state[i] == AIM_DONE && ratio > 1 / most && ratio < most;
    }
    if (!done) {
        return false;
    }
    const size_t bytes = (size_t)aimed->lanes * sizeof(double);
    memcpy(aimed->a, block.a, bytes);
    memcpy(aimed->b, block.b, bytes);
    for (int k = 0; k < 4; k++) {
        memcpy(aimed->inverse[k], block.m[k], bytes);
    }
    return true;
}

/* From nothing: the rays of one beam. */
static bool search_beam(struct aimed *aimed, struct aimed_beam *at, struct arena *arena,
                        struct error *error)
{
    struct aim aim = {.lost_surface = 0};
    if (!aim_open_near(aimed->system, &at->beam, &at->near, arena, &aim, error)) {
        aimed->lost_surface = aim.lost_surface;
        return false;
    }
    struct pupil_point points[RAYS_BLOCK];
    for (int i = 0; i < at->count; i++) {
        points[i] = (struct pupil_point){aimed->x[at->first + i], aimed->y[at->first + i], 1};
    }
    const struct rays rays = rays_new(arena, RAYS_BLOCK);
    const size_t count = (size_t)at->count, reached = aim_rays(&aim, points, count, &rays);
    if (reached < count) {
        for (size_t i = 0; i < count && aimed->lost_surface == 0; i++) {
            aimed->lost_surface = ray_block_surface(rays.blocks, i);
        }
        return fail(error, ERROR_DOMAIN, "%zu of %zu rays cannot be aimed at the stop",
                    count - reached, count);
    }
    for (size_t i = 0; i < count; i++) {
        const double point[3] = {rays.blocks->x[i], rays.blocks->y[i], rays.blocks->z[i]};
        double place[2];
        beam_place(&at->beam, point, place);
        aimed->a[(size_t)at->first + i] = place[0];
        aimed->b[(size_t)at->first + i] = place[1];
    }
    return true;
}

static void fill_coordinates(struct aimed *aimed)
{
    for (int i = aimed->count; i < aimed->lanes; i++) {
        aimed->a[i] = aimed->a[0];
        aimed->b[i] = aimed->b[0];
        aimed->x[i] = aimed->x[0];
        aimed->y[i] = aimed->y[0];
        for (int k = 0; k < 2; k++) {
            aimed->by_radius[k][i] = aimed->by_radius[k][0];
            aimed->by_place[k][i] = aimed->by_place[k][0];
        }
    }
}

/* From nothing: all of them. */
static bool aimed_search(struct aimed *aimed, struct arena *arena, struct error *error)
{
    for (size_t g = 0; g < aimed->beam_count; g++) {
        aimed->lost_beam = g;
        aimed->lost_surface = 0;
        if (!search_beam(aimed, &aimed->beams[g], arena, error)) {
            return false;
        }
    }
    fill_coordinates(aimed);
    /* for what comes next */
    aimed_start_rays(aimed, aimed->a, aimed->b, aimed->work->start);
    trace_tape(aimed);
    aimed->is_known = true;
    return true;
}

bool aimed_at_stop(struct aimed *aimed, const struct system *system, struct arena *arena,
                   struct error *error)
{
    aimed->system = system;
    if (aimed->is_known && aimed_steer(aimed)) {
        return true;
    }
    /* a lens that cannot be aimed through leaves what was known of the one before it */
    struct aimed *before = ARENA_NEW(arena, struct aimed);
    *before = *aimed;
    if (!aimed_search(aimed, arena, error)) {
        before->lost_beam = aimed->lost_beam;
        before->lost_surface = aimed->lost_surface;
        *aimed = *before;
        return false;
    }
    return true;
}

/* -------- the entrance pupil -------- */

/* The cone of a numerical aperture, which the lens does not change. */
static bool aim_cone(struct aimed *aimed, const struct aimed_beam *at,
                     const struct first_order *first, struct error *error)
{
    for (int i = at->first; i < at->first + at->count; i++) {
        struct ray ray;
        double place[2];
        if (!aim_at_entrance(&at->beam, first, aimed->x[i], aimed->y[i], &ray, error)) {
            return false;
        }
        beam_place(&at->beam, ray.point, place);
        aimed->a[i] = place[0];
        aimed->b[i] = place[1];
        for (int k = 0; k < 2; k++) {
            aimed->by_radius[k][i] = aimed->by_place[k][i] = 0;
        }
    }
    return true;
}

bool aimed_at_entrance(struct aimed *aimed, const struct system *system,
                       const struct first_order *first, struct error *error)
{
    aimed->system = system;
    for (size_t g = 0; g < aimed->beam_count; g++) {
        const struct aimed_beam *at = &aimed->beams[g];
        struct ray chief;
        if (!aim_at_entrance(&at->beam, first, 0, 0, &chief, error)) {
            return false;
        }
        if (!first->is_telecentric) {
            /*
             * Rays of one beam through points of the pupil at z: beam_place, and how coordinates
             * change with the pupil's radius and place.
             */
            const double radius = first->entrance_diameter / 2, z = first->entrance_pupil;
            const double *u = at->beam.across[0], *v = at->beam.across[1], *e = at->beam.axis;
            const bool far = isinf(at->beam.distance);
            const double d = far ? 1 : at->beam.distance, bends = far ? 0 : 1;
            for (int i = at->first; i < at->first + at->count; i++) {
                const double x = aimed->x[i], y = aimed->y[i];
                const double along_e = bends * (radius * (x * e[0] + y * e[1]) + z * e[2]);
                const double scale = d / (d + along_e), shrink = bends * scale / d;
                const double out = x * e[0] + y * e[1];
                const double a = scale * (radius * (x * u[0] + y * u[1]) + z * u[2]);
                const double b = scale * (radius * (x * v[0] + y * v[1]) + z * v[2]);
                aimed->a[i] = a;
                aimed->b[i] = b;
                aimed->by_radius[0][i] = scale * (x * u[0] + y * u[1]) - a * shrink * out;
                aimed->by_radius[1][i] = scale * (x * v[0] + y * v[1]) - b * shrink * out;
                aimed->by_place[0][i] = scale * u[2] - a * shrink * e[2];
                aimed->by_place[1][i] = scale * v[2] - b * shrink * e[2];
            }
        } else if (!aim_cone(aimed, at, first, error)) {
            return false;
        }
    }
    fill_coordinates(aimed);
    return true;
}
