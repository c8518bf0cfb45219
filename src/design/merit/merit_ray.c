/* design/merit/merit_ray.c - single real rays, chief and edge rays, with their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_ray.h"

#include "design/merit/merit_paraxial.h"
#include "trace/derivative.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

/* The same ray in so many lanes: each sweeps for one number of its end. */
enum { NUMBERS = 6 };

/* One sweep of them. */
struct merit_ray_sweep {
    struct system system;
    struct derivative_layout layout;
    struct ray_block *adjoint; /* receives the derivatives by the start */
    double *gradient;
    double end[NUMBERS];             /* x, y, z, p, q, r */
    double (*irregular)[RAYS_BLOCK]; /* columns of the irregularities */
};

/* What rays are derived by, of all links. */
static unsigned merit_ray_kinds_of(const struct merit *merit, const struct merit_light *light)
{
    unsigned what = merit->question.irregularity_count > 0 ? DERIVE_DISPLACEMENT : 0;
    for (size_t i = 0; i < light->link_count; i++) {
        const struct parameter basis = light->links[i].basis;
        if (basis.kind >= PARAMETER_BREAK_DECENTER_X) {
            what |= DERIVE_BREAK;
        } else if (basis.kind >= PARAMETER_DECENTER_X) {
            what |= DERIVE_DISPLACEMENT;
        } else if (basis.kind == PARAMETER_CONIC) {
            what |= DERIVE_CONIC;
        } else if (basis.kind == PARAMETER_COEFFICIENT) {
            what |= basis.order % 2 == 1 ? DERIVE_ODD : DERIVE_SERIES;
        }
    }
    return what;
}

/* The lens as far as it is passed. */
static const struct lens *merit_ray_cut(const struct lens *lens, size_t passed, struct arena *arena)
{
    struct lens *part = ARENA_NEW(arena, struct lens);
    *part = *lens;
    part->surface_count = passed < lens->surface_count ? passed : lens->surface_count;
    part->stop = lens->stop < part->surface_count ? lens->stop : LENS_NONE;
    return part;
}

static void merit_ray_put(struct ray_block *block, size_t lane, const double numbers[NUMBERS])
{
    double *const rows[NUMBERS] = {block->x, block->y, block->z, block->p, block->q, block->r};
    for (int i = 0; i < NUMBERS; i++) {
        rows[i][lane] = numbers[i];
    }
}

static void merit_ray_get(const struct ray_block *block, size_t lane, double numbers[NUMBERS])
{
    const double *const rows[NUMBERS] = {block->x, block->y, block->z,
                                         block->p, block->q, block->r};
    for (int i = 0; i < NUMBERS; i++) {
        numbers[i] = rows[i][lane];
    }
}

static void derive_irregular(const struct merit *merit, const struct derivative_tape *tape,
                             struct arena *arena, struct merit_ray_sweep *sweep)
{
    const struct merit_question *question = &merit->question;
    const struct irregularity_sweep swept = {&sweep->system, &sweep->layout, tape, sweep->gradient};
    sweep->irregular =
        arena_array(arena, question->irregularity_count + 1, sizeof *sweep->irregular);
    for (size_t i = 0; i < question->irregularity_count; i++) {
        if (question->irregularities[i].surface < sweep->system.lens->surface_count) {
            irregularity_column(&question->irregularities[i], &swept, sweep->irregular[i]);
        }
    }
}

/* Through a part of the lens, and back: `wanted` are the adjoints, one row a lane. */
static bool sweep_part(struct merit *merit, const struct merit_light *light,
                       const struct lens *part, double image, const double start[NUMBERS],
                       struct arena *arena, struct merit_ray_sweep *sweep)
{
    struct system_options options = system_options_default();
    options.image = image;
    options.stop_radius = 1; /* it limits nothing here */
    if (!system_compile(part, light->wavelength, &options, arena, &sweep->system, &merit->why)) {
        return false;
    }
    const struct rays rays = rays_new(arena, NUMBERS);
    for (size_t lane = 0; lane < NUMBERS; lane++) {
        merit_ray_put(rays.blocks, lane, start);
    }
    struct derivative_tape tape = derivative_tape_new(&sweep->system, arena);
    tape.lanes = kernel_lanes(NUMBERS);
    const struct ray_block *end = derivative_trace(&sweep->system, rays.blocks, SET_BEST, &tape);
    if (ray_block_status(end, 0) != RAY_OK) {
        return fail(&merit->why, ERROR_DOMAIN, "a ray is lost at surface %zu",
                    ray_block_surface(end, 0));
    }
    merit_ray_get(end, 0, sweep->end);
    sweep->adjoint = rays_new(arena, NUMBERS).blocks;
    memset(sweep->adjoint, 0, sizeof *sweep->adjoint);
    for (size_t lane = 0; lane < NUMBERS; lane++) {
        double one[NUMBERS] = {0};
        one[lane] = 1;
        merit_ray_put(sweep->adjoint, lane, one);
    }
    const bool bends = merit->question.irregularity_amounts != NULL;
    if (merit->derives || bends) {
        derivative_layout(&sweep->system, merit_ray_kinds_of(merit, light), arena, &sweep->layout);
        sweep->gradient = ARENA_ARRAY(arena, sweep->layout.rows * RAYS_BLOCK, double);
        derivative_sweep(&sweep->system, &sweep->layout, SET_BEST, &tape, sweep->adjoint,
                         sweep->gradient);
        derive_irregular(merit, &tape, arena, sweep);
    }
    /* the end moves by them; the ray starts where it does without them */
    for (size_t i = 0; i < merit->question.irregularity_count && bends; i++) {
        for (int k = 0; k < NUMBERS; k++) {
            sweep->end[k] += merit->question.irregularity_amounts[i] * sweep->irregular[i][k];
        }
    }
    return true;
}

/* The row of a link in a part of the lens; LENS_NONE: nothing there depends on it. */
static size_t merit_ray_row_of(const struct merit_ray_sweep *sweep,
                               const struct variable_link *link)
{
    const struct lens *part = sweep->system.lens;
    const struct parameter basis = link->basis;
    const bool is_there = basis.surface == LENS_NONE || basis.surface < part->surface_count;
    /* behind the last surface stands the image plane, which moves by itself */
    const bool is_image =
        basis.kind == PARAMETER_THICKNESS && basis.surface + 1 == part->surface_count;
    return !is_there || is_image || variable_link_of_mirror(link, part)
               ? LENS_NONE
               : derivative_row(&sweep->layout, basis);
}

/* The end by one variable, where the ray starts always at the same place: added to `slopes`. */
static void merit_ray_add_links(const struct merit *merit, const struct merit_light *light,
                                const struct merit_ray_sweep *sweep, size_t variable,
                                double slopes[NUMBERS])
{
    const size_t irregular = merit->question.variable_count;
    for (size_t k = 0; k < NUMBERS && variable >= irregular; k++) {
        slopes[k] += sweep->irregular[variable - irregular][k];
    }
    for (size_t i = 0; i < light->link_count; i++) {
        const struct variable_link *link = &light->links[i];
        const size_t row =
            link->variable == variable ? merit_ray_row_of(sweep, link) : (size_t)LENS_NONE;
        for (size_t k = 0; k < NUMBERS && row != LENS_NONE; k++) {
            slopes[k] += sweep->gradient[row * RAYS_BLOCK + k] * link->slope;
        }
    }
}

/* The end by a change of the start: added to `slopes`. */
static void merit_ray_add_start(const struct merit_ray_sweep *sweep, const double change[NUMBERS],
                                double slopes[NUMBERS])
{
    for (size_t k = 0; k < NUMBERS; k++) {
        double by[NUMBERS];
        merit_ray_get(sweep->adjoint, k, by);
        for (int i = 0; i < NUMBERS; i++) {
            slopes[k] += by[i] * change[i];
        }
    }
}

/* -------- the object -------- */

/* Index of object space by a variable. */
static double merit_ray_index_slope(const struct merit_light *light, size_t variable)
{
    double slope = 0;
    for (size_t i = 0; i < light->link_count; i++) {
        const struct variable_link *link = &light->links[i];
        if (link->variable == variable && link->basis.kind == PARAMETER_INDEX &&
            link->basis.surface == LENS_NONE) {
            slope += link->slope;
        }
    }
    return slope;
}

/* v, a change of a vector of this length, as one of its direction. */
static void merit_ray_turn(double change[3], const double unit[3], double length)
{
    const double along = change[0] * unit[0] + change[1] * unit[1] + change[2] * unit[2];
    for (int i = 0; i < 3; i++) {
        change[i] = (change[i] - along * unit[i]) / length;
    }
}

/* How the direction of a ray changes with its object: of image heights, which the lens moves. */
static void turn_with_object(const struct merit_place *place, const struct field_point *field,
                             const struct dual_first *primary, const struct ray *ray,
                             double change[3])
{
    const double *height = field->value, *u = ray->cosine;
    memset(change, 0, 3 * sizeof(double));
    if (field->kind != FIELD_IMAGE) {
        return;
    }
    if (place->setup.object.is_infinite) { /* u along (x P/n, y P/n, 1) */
        const struct dual power = dual_divide(primary->power, primary->index_object);
        change[0] = height[0] * power.slope;
        change[1] = height[1] * power.slope;
        merit_ray_turn(change, u, 1 / u[2]);
        return;
    }
    const struct dual by_m = dual_divide(dual_of(1), primary->magnification);
    const double distance = place->setup.object.distance.hi;
    const double from[3] = {ray->point[0] - height[0] * by_m.value,
                            ray->point[1] - height[1] * by_m.value, ray->point[2] + distance};
    const double way = from[0] * u[0] + from[1] * u[1] + from[2] * u[2]; /* below 0: virtual */
    change[0] = -height[0] * by_m.slope;
    change[1] = -height[1] * by_m.slope;
    merit_ray_turn(change, u, way);
}

/* -------- aiming -------- */

/* What is known of a ray at its start. */
struct ray_start {
    struct beam beam;
    struct ray ray;
    double at[2]; /* coordinates in the beam */
};

static bool aim_with(struct merit *merit, const struct merit_ray_question *question,
                     const struct first_order *first, struct arena *arena, struct ray_start *aiming)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    struct system_options options = system_options_default();
    struct system system;
    struct aim aim;
    options.stop_radius = first->stop_radius > 0 ? first->stop_radius : 1;
    if (!system_compile(place->lens, question->light->wavelength, &options, arena, &system,
                        &merit->why) ||
        !aim_open_near(&system, &aiming->beam, merit->forgets ? NULL : question->near, arena, &aim,
                       &merit->why)) {
        return false;
    }
    const bool is_chief = question->pupil[0] == 0 && question->pupil[1] == 0;
    aiming->ray =
        is_chief ? aim_chief(&aim) : aim_ray(&aim, question->pupil[0], question->pupil[1]);
    if (aiming->ray.status != RAY_OK) {
        return fail(&merit->why, ERROR_DOMAIN, "a ray is lost at surface %zu", aiming->ray.surface);
    }
    beam_place(&aiming->beam, aiming->ray.point, aiming->at);
    return true;
}

static bool merit_ray_aim(struct merit *merit, const struct merit_ray_question *question,
                          struct arena *arena, struct ray_start *aiming)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    const struct setup *setup = &place->setup;
    const struct conjugate_object *object = &setup->object;
    const double primary = place->lights[0].wavelength;
    struct first_order first;
    if (!first_order_of_lens(place->lens, primary, setup->section, arena, &first, &merit->why) ||
        !first_order_aperture(&first, object, &place->aperture, FIELD_NONE, NAN, &merit->why) ||
        !beam_of_field(question->field, object, &first, &aiming->beam, &merit->why)) {
        return false;
    }
    aiming->beam.n = question->light->paraxial.index[0].value;
    if (!first.is_telecentric) {
        return aim_with(merit, question, &first, arena, aiming);
    }
    beam_place(&aiming->beam, (double[3]){0, 0, 0}, aiming->at);
    return aim_at_entrance(&aiming->beam, &first, question->pupil[0], question->pupil[1],
                           &aiming->ray, &merit->why);
}

/* -------- the start -------- */

/* x and y in the stop's own frame by x, y, z of the axis there. */
static void own_axes(const struct system *system, double axes[2][3])
{
    const size_t stop = system->lens->stop;
    double origin[3] = {0, 0, 0};
    system_to_own(system, stop, origin);
    for (int i = 0; i < 3; i++) {
        double point[3] = {0, 0, 0};
        point[i] = 1;
        system_to_own(system, stop, point);
        axes[0][i] = point[0] - origin[0];
        axes[1][i] = point[1] - origin[1];
    }
}

/* How the decentre of the stop itself moves what lies in it. */
static void merit_ray_add_stop(const struct merit_light *light, const struct lens *lens,
                               size_t variable, double slopes[NUMBERS])
{
    for (size_t i = 0; i < light->link_count; i++) {
        const struct variable_link *link = &light->links[i];
        if (link->variable == variable && link->basis.surface == lens->stop &&
            (link->basis.kind == PARAMETER_DECENTER_X ||
             link->basis.kind == PARAMETER_DECENTER_Y)) {
            slopes[link->basis.kind - PARAMETER_DECENTER_X] -= link->slope;
        }
    }
}

static void merit_ray_own(double axes[2][3], const double numbers[NUMBERS], double place[2])
{
    for (int i = 0; i < 2; i++) {
        place[i] = axes[i][0] * numbers[0] + axes[i][1] * numbers[1] + axes[i][2] * numbers[2];
    }
}

/* d(a, b) that keeps the ray where it crosses the stop. */
static bool merit_ray_solve(double slope[2][2], const double miss[2], double change[2])
{
    const double det = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
    change[0] = (slope[1][1] * miss[0] - slope[0][1] * miss[1]) / det;
    change[1] = (slope[0][0] * miss[1] - slope[1][0] * miss[0]) / det;
    return isfinite(change[0]) && isfinite(change[1]);
}

/* The same ray in all columns, without derivatives. */
static void merit_ray_set(const double numbers[NUMBERS], size_t columns, struct merit_ray *ray)
{
    for (size_t j = 0; j < columns; j++) {
        for (int i = 0; i < 3; i++) {
            ray[j].at[i] = dual_of(numbers[i]);
            ray[j].along[i] = dual_of(numbers[i + 3]);
        }
    }
}

static void put_change(const double change[NUMBERS], struct merit_ray *start)
{
    for (int i = 0; i < 3; i++) {
        start->at[i].slope += change[i];
        start->along[i].slope += change[i + 3];
    }
}

/* What the object alone does to the start. */
static void object_change(const struct merit *merit, const struct merit_ray_question *question,
                          const struct ray_start *aiming, const struct dual_first *primary,
                          size_t variable, double change[NUMBERS])
{
    const struct merit_place *place = &merit->places[question->slot->place];
    const double n_slope = merit_ray_index_slope(question->light, variable);
    memset(change, 0, NUMBERS * sizeof(double));
    turn_with_object(place, question->field, primary, &aiming->ray, change + 3);
    for (int i = 0; i < 3; i++) {
        change[i + 3] = aiming->beam.n * change[i + 3] + n_slope * aiming->ray.cosine[i];
    }
}

/* Derivatives of the start by all variables, from a sweep to the stop. */
static bool derive_start(struct merit *merit, const struct merit_ray_question *question,
                         const struct ray_start *aiming, const double first[NUMBERS],
                         const struct merit_figures *figures, struct arena *arena,
                         struct merit_ray *start)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    const struct merit_light *light = question->light;
    const struct lens *part = merit_ray_cut(place->lens, place->lens->stop + 1, arena);
    struct merit_ray_sweep sweep;
    double axes[2][3], by_start[2][NUMBERS], by_stop[2][2]; /* by a and b */
    if (!sweep_part(merit, light, part, NAN, first, arena, &sweep)) {
        return false;
    }
    own_axes(&sweep.system, axes);
    for (int k = 0; k < 2; k++) {
        double end[NUMBERS] = {0}, at[2];
        beam_slope(&aiming->beam, aiming->at, k, by_start[k], by_start[k] + 3);
        merit_ray_add_start(&sweep, by_start[k], end);
        merit_ray_own(axes, end, at);
        by_stop[0][k] = at[0];
        by_stop[1][k] = at[1];
    }
    for (size_t j = 0; j < merit->variable_count; j++) {
        double change[NUMBERS], end[NUMBERS] = {0}, at[2], way[2];
        object_change(merit, question, aiming, &figures[j].first, j, change);
        merit_ray_add_links(merit, light, &sweep, j, end);
        merit_ray_add_stop(light, part, j, end);
        merit_ray_add_start(&sweep, change, end);
        merit_ray_own(axes, end, at);
        const double radius = figures[j].first.stop_radius.slope;
        const bool is_chief = question->pupil[0] == 0 && question->pupil[1] == 0;
        const double miss[2] = {(is_chief ? 0 : radius * question->pupil[0]) - at[0],
                                (is_chief ? 0 : radius * question->pupil[1]) - at[1]};
        if (!merit_ray_solve(by_stop, miss, way)) {
            return fail(&merit->why, ERROR_DOMAIN, "the rays about one meet in the stop");
        }
        for (int i = 0; i < NUMBERS; i++) {
            change[i] += way[0] * by_start[0][i] + way[1] * by_start[1][i];
        }
        put_change(change, &start[j]);
    }
    return true;
}

bool merit_ray_start(struct merit *merit, const struct merit_ray_question *question,
                     struct arena *arena, struct merit_ray *start)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    const struct merit_figures *figures = merit_figures(merit, question->slot, NAN);
    struct ray_start aiming;
    if (figures == NULL ||
        merit_figures(merit, question->slot, question->light->wavelength) == NULL ||
        !merit_ray_aim(merit, question, arena, &aiming)) {
        return false;
    }
    const double n = aiming.beam.n, *at = aiming.ray.point, *e = aiming.ray.cosine;
    const double first[NUMBERS] = {at[0], at[1], at[2], n * e[0], n * e[1], n * e[2]};
    merit_ray_set(first, merit_columns(merit), start);
    if (!merit->derives) {
        return true;
    }
    if (!place->setup.first.is_telecentric) {
        return derive_start(merit, question, &aiming, first, figures, arena, start);
    }
    for (size_t j = 0; j < merit->variable_count; j++) {
        double change[NUMBERS];
        object_change(merit, question, &aiming, &figures[j].first, j, change);
        put_change(change, &start[j]);
    }
    return true;
}

/* -------- following -------- */

/* In a plane that moves along the axis with the ray's own slope. */
static void move_plane(struct merit_ray *end, double way)
{
    for (int i = 0; i < 2; i++) {
        end->at[i].slope += way * end->along[i].value / end->along[2].value;
    }
}

bool merit_ray_follow(struct merit *merit, const struct merit_ray_question *question, size_t passed,
                      const struct merit_ray *start, struct arena *arena, struct merit_ray *end)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    const struct lens *part = merit_ray_cut(place->lens, passed, arena);
    const size_t columns = merit_columns(merit);
    const bool to_image = passed == MERIT_RAY_IMAGE;
    struct merit_ray_sweep sweep;
    double first[NUMBERS];
    const struct dual *image = to_image ? merit_image(merit, question->slot) : NULL;
    if (passed == 0) {
        memcpy(end, start, columns * sizeof *end);
        return true;
    }
    for (int i = 0; i < 3; i++) {
        first[i] = start[0].at[i].value;
        first[i + 3] = start[0].along[i].value;
    }
    if ((to_image && image == NULL) ||
        !sweep_part(merit, question->light, part, to_image ? image[0].value : (double)NAN, first,
                    arena, &sweep)) {
        return false;
    }
    merit_ray_set(sweep.end, columns, end);
    for (size_t j = 0; j < merit->variable_count && merit->derives; j++) {
        double slopes[NUMBERS] = {0}, change[NUMBERS];
        for (int i = 0; i < 3; i++) {
            change[i] = start[j].at[i].slope;
            change[i + 3] = start[j].along[i].slope;
        }
        merit_ray_add_links(merit, question->light, &sweep, j, slopes);
        merit_ray_add_start(&sweep, change, slopes);
        put_change(slopes, &end[j]);
        if (to_image) {
            move_plane(&end[j], image[j].slope);
        }
    }
    return true;
}

bool merit_ray_check(const struct merit_place *place, const struct field_point *field,
                     struct error *error)
{
    const struct lens *lens = place->setup.lens;
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (surface_has(&lens->surfaces[i], SURFACE_HAS_FOCAL)) {
            return fail(error, ERROR_DOMAIN,
                        "surface %zu is an ideal lens, and its real rays have no derivatives",
                        i + 1);
        }
    }
    if (lens->stop == LENS_NONE && !place->setup.first.is_telecentric) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop: it has no chief rays");
    }
    if (field->kind == FIELD_REAL) {
        return fail(error, ERROR_DOMAIN,
                    "its field is a height of the real image, which stays where it is: give "
                    "an angle, or the height of the object");
    }
    return field->kind != FIELD_HEIGHT || !place->setup.object.is_infinite ||
           fail(error, ERROR_DOMAIN, "an object at infinity has no height: give an angle");
}

/* -------- without derivatives -------- */

struct merit_ray merit_front_ray(const struct merit_front *front, size_t i)
{
    const struct ray_block *block = &front->rays.blocks[i / RAYS_BLOCK];
    const size_t lane = i % RAYS_BLOCK;
    return (struct merit_ray){
        .at = {dual_of(block->x[lane]), dual_of(block->y[lane]), dual_of(block->z[lane])},
        .along = {dual_of(block->p[lane]), dual_of(block->q[lane]), dual_of(block->r[lane])}};
}

bool merit_front_lost(const struct merit_front *front, size_t i)
{
    return ray_block_status(&front->rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) != RAY_OK;
}

bool merit_front_open(struct merit *merit, const struct merit_ray_question *question,
                      struct merit_ray *const *starts, size_t count, struct merit_front *front)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    struct system_options options = system_options_default();
    options.stop_radius = 1; /* it limits nothing here */
    front->count = count;
    front->rays = rays_new(merit->arena, count);
    for (size_t i = 0; i < count; i++) {
        struct ray_block *block = &front->rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        if (starts[i] == NULL) {
            block->lost[lane] = RAY_LOST_AT(0, 1, RAY_NOT_CONVERGED);
            continue;
        }
        block->x[lane] = starts[i]->at[0].value;
        block->y[lane] = starts[i]->at[1].value;
        block->z[lane] = starts[i]->at[2].value;
        block->p[lane] = starts[i]->along[0].value;
        block->q[lane] = starts[i]->along[1].value;
        block->r[lane] = starts[i]->along[2].value;
    }
    return system_compile(place->lens, question->light->wavelength, &options, merit->arena,
                          &front->system, &merit->why);
}

void merit_front_pass(struct merit_front *front, size_t surface)
{
    rays_trace_part(&front->system, surface, surface + 1, &front->rays, NULL);
}
