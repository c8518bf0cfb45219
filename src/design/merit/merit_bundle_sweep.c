/* design/merit/merit_bundle_sweep.c - derivatives of the rays of a position by the variables. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_bundle.h"
#include "design/tolerance/linear_rays.h"

#include <math.h>
#include <string.h>

struct bundle_rate merit_bundle_rate(const struct merit_bundle *bundle,
                                     const struct dual_first *first)
{
    const struct dual radius = bundle->wish.from_entrance || bundle->has_disc
                                   ? first->entrance_radius
                                   : first->stop_radius;
    const struct dual size = dual_absolute(radius), n = first->index_object;
    const bool far = bundle->wish.setup->object.is_infinite;
    const struct dual field =
        far ? dual_divide(first->power, n) : dual_divide(dual_of(1), first->magnification);
    bool moves = false;
    for (size_t i = 0; i < bundle->wish.field_count && !bundle->is_held; i++) {
        moves = moves || merit_bundle_moves(bundle, i);
    }
    const bool at_pupil = bundle->wish.from_entrance && !bundle->first.is_telecentric;
    return (struct bundle_rate){.image = bundle->image_moves ? first->image.slope : 0,
                                .pupil = at_pupil ? first->entrance_pupil.slope : 0,
                                .radius = isnan(size.value) ? 0 : size.slope,
                                .field = moves ? field.slope : 0};
}

static double sweep_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/*
 * How the direction e of a ray through T changes where its object moves with the factor of image
 * heights; and P's own way there.
 */
static void sweep_turn_of(const struct merit_bundle *bundle, size_t field, const double T[3],
                          const double e[3], double turn[3], double way[3])
{
    const struct bundle_wish *wish = &bundle->wish;
    const double *height = wish->fields[field].point.value;
    const struct first_order *first = &bundle->first;
    way[2] = 0;
    if (wish->setup->object.is_infinite) { /* along (-h c/n, 1), the factor -c/n */
        const double factor = first->power / first->index_object;
        const double u[3] = {height[0] * factor, height[1] * factor, 1};
        const double length = sqrt(sweep_dot(u, u));
        const double du[3] = {height[0] / length, height[1] / length, 0};
        for (int k = 0; k < 3; k++) {
            turn[k] = du[k] - e[k] * sweep_dot(e, du);
        }
        way[0] = way[1] = 0;
        return;
    }
    const double distance = wish->setup->object.distance.hi;
    const double P[3] = {height[0] / first->magnification, height[1] / first->magnification,
                         -distance};
    const double from[3] = {T[0] - P[0], T[1] - P[1], T[2] - P[2]};
    const double length = copysign(sqrt(sweep_dot(from, from)), sweep_dot(from, e));
    way[0] = height[0];
    way[1] = height[1];
    for (int k = 0; k < 3; k++) {
        turn[k] = -(way[k] - e[k] * sweep_dot(e, way)) / length;
    }
}

/* A start that moves with the object of its beam: X and e, and how they and the object do. */
struct moving_start {
    double X[3], e[3], shift[3], turn[3], way[3];
};

/*
 * What a function of the coordinates in the beam gains; the beam does not turn about its axis,
 * across which X stays.
 */
static double by_coordinates(const struct aimed *aimed, const struct beam *beam, int i,
                             const struct moving_start *start)
{
    const double *axis = beam->axis, *e = start->e;
    const double *const *by = aimed->by_start;
    double tilt[3], move[3];
    for (int k = 0; k < 3; k++) {
        tilt[k] = isinf(beam->distance)
                      ? start->turn[k]
                      : -(start->way[k] - axis[k] * sweep_dot(axis, start->way)) / beam->distance;
    }
    const double slide =
        -(sweep_dot(start->X, tilt) + sweep_dot(start->shift, axis)) / sweep_dot(e, axis);
    for (int k = 0; k < 3; k++) {
        move[k] = start->shift[k] + slide * e[k];
    }
    return by[0] == NULL ? 0
                         : by[0][i] * sweep_dot(move, beam->across[0]) +
                               by[1][i] * sweep_dot(move, beam->across[1]);
}

/* By the factor of image heights, of one ray: what its start does there. */
static double by_field(const struct merit_bundle *bundle, const struct bundle_block *block,
                       const struct ray_block *adjoint, int i)
{
    const struct aimed *aimed = &block->aimed;
    const struct ray_block *start = aimed->work->start;
    const size_t field = block->lanes[i].field;
    const double n = aimed->beams[0].beam.n, radius = bundle->first.entrance_diameter / 2;
    struct moving_start at = {{start->x[i], start->y[i], start->z[i]},
                              {start->p[i] / n, start->q[i] / n, start->r[i] / n},
                              {0},
                              {0},
                              {0}};
    const double *X = at.X, *e = at.e;
    double T[3] = {X[0], X[1], X[2]};
    if (!aimed->at_stop) {
        T[0] = aimed->x[i] * radius;
        T[1] = aimed->y[i] * radius;
        T[2] = bundle->first.entrance_pupil;
    }
    sweep_turn_of(bundle, field, T, e, at.turn, at.way);
    const double back[3] = {T[0] - X[0], T[1] - X[1], T[2] - X[2]}, L = sweep_dot(back, e);
    const double path =
        bundle->wish.setup->object.is_infinite ? sweep_dot(X, at.turn) : -sweep_dot(e, at.way);
    const double a[3] = {adjoint->x[i], adjoint->y[i], adjoint->z[i]};
    const double b[3] = {adjoint->p[i], adjoint->q[i], adjoint->r[i]};
    for (int k = 0; k < 3; k++) {
        at.shift[k] = -L * at.turn[k];
    }
    return n * (sweep_dot(b, at.turn) + adjoint->path[i] * path) + sweep_dot(a, at.shift) +
           by_coordinates(aimed, &bundle->beams[field], i, &at);
}

static void sweep_add_row(double *restrict column, double factor, const double *restrict row,
                          int lanes)
{
    for (int from = 0; factor != 0 && from < lanes; from += RAYS_FEW) {
        for (int i = from; i < from + RAYS_FEW; i++) {
            column[i] += factor * row[i];
        }
    }
}

/* In a denser medium rays start with a longer n e. */
static void add_start(double *column, double factor, const struct bundle_block *block,
                      const struct ray_block *adjoint)
{
    const struct ray_block *start = block->aimed.work->start;
    const double n = block->aimed.beams[0].beam.n;
    for (int i = 0; i < block->aimed.lanes; i++) {
        column[i] += factor / n *
                     (adjoint->p[i] * start->p[i] + adjoint->q[i] * start->q[i] +
                      adjoint->r[i] * start->r[i] + adjoint->path[i] * start->path[i]);
    }
}

/* The distance of the image, of which a paraxial one takes no notice. */
static bool is_image(const struct merit_bundle *bundle, struct parameter basis)
{
    return basis.kind == PARAMETER_THICKNESS &&
           basis.surface + 1 == bundle->wish.setup->lens->surface_count;
}

double merit_bundle_image_slope(const struct merit_bundle *bundle, const struct bundle_links *links,
                                size_t variable)
{
    double slope = bundle->rates[variable].image;
    for (size_t i = 0; i < links->count && !bundle->image_moves; i++) {
        const struct variable_link *link = &links->list[i];
        slope += link->variable == variable && is_image(bundle, link->basis) ? link->slope : 0;
    }
    return slope;
}

static void add_links(const struct merit_bundle *bundle, const struct bundle_block *block,
                      const struct bundle_links *links, const struct ray_block *adjoint,
                      double *columns)
{
    const struct derivative_layout *layout = &bundle->lights[block->light].layout;
    for (size_t i = 0; i < links->count; i++) {
        const struct variable_link *link = &links->list[i];
        if (bundle->image_moves && is_image(bundle, link->basis)) {
            continue;
        }
        double *column = columns + link->variable * RAYS_BLOCK;
        /* the image plane is where the lens has its image, not there */
        const bool is_image = bundle->image_moves && link->basis.kind == PARAMETER_THICKNESS &&
                              link->basis.surface == layout->surfaces - 1;
        if (is_image || variable_link_of_mirror(link, bundle->lights[block->light].system.lens)) {
            continue;
        }
        const size_t row = derivative_row(layout, link->basis);
        sweep_add_row(column, link->slope, bundle->gradient + row * RAYS_BLOCK, block->aimed.lanes);
        if (link->basis.kind == PARAMETER_INDEX && link->basis.surface == LENS_NONE) {
            add_start(column, link->slope, block, adjoint);
        }
    }
}

/* From derivatives by all parameters to those by the variables. */
static void sweep_gather(const struct merit_bundle *bundle, size_t which, size_t place,
                         const struct bundle_links *links, size_t variable_count,
                         const struct ray_block *adjoint, const struct aimed_rates *rates,
                         double *columns)
{
    const struct bundle_block *block = &bundle->blocks[which];
    const struct derivative_layout *layout = &bundle->lights[block->light].layout;
    const int lanes = block->aimed.lanes;
    const struct parameter last = {.surface = layout->surfaces - 1, .kind = PARAMETER_THICKNESS};
    const size_t image = bundle->image_moves ? derivative_row(layout, last) : 0;
    double field[RAYS_BLOCK];
    memset(field, 0, RAYS_BLOCK * sizeof *field);
    for (int i = 0; i < block->aimed.count; i++) {
        if (merit_bundle_moves(bundle, block->lanes[i].field)) {
            field[i] = by_field(bundle, block, adjoint, i);
        }
    }
    for (size_t j = 0; j < variable_count; j++) {
        memset(columns + j * RAYS_BLOCK, 0, (size_t)lanes * sizeof *columns);
    }
    add_links(bundle, block, links, adjoint, columns);
    /* their columns end there; those of surfaces behind the place are 0 */
    double *end = columns + variable_count * RAYS_BLOCK;
    const struct bundle_light *light = &bundle->lights[block->light];
    const struct irregularity_sweep sweep = {&light->system, &light->layout, &bundle->work.tape,
                                             bundle->gradient};
    const bool has = bundle->wish.irregularity_amounts == NULL;
    for (size_t i = 0; i < bundle->wish.irregularity_count && has; i++) {
        if (bundle->wish.irregularities[i].surface < place) {
            irregularity_column(&bundle->wish.irregularities[i], &sweep,
                                end - (bundle->wish.irregularity_count - i) * RAYS_BLOCK);
        }
    }
    for (size_t j = 0; j < variable_count; j++) {
        const struct bundle_rate *rate = &bundle->rates[j];
        double *column = columns + j * RAYS_BLOCK;
        sweep_add_row(column, rate->image, bundle->gradient + image * RAYS_BLOCK, lanes);
        sweep_add_row(column, rate->pupil, rates->place, lanes);
        sweep_add_row(column, rate->radius, rates->radius, lanes);
        sweep_add_row(column, rate->field, field, lanes);
    }
}

void merit_bundle_sweep(const struct merit_bundle *bundle, size_t which, size_t place,
                        const struct bundle_links *links, size_t variable_count,
                        struct ray_block *adjoint, double *columns)
{
    const struct bundle_block *block = &bundle->blocks[which];
    const struct bundle_light *light = &bundle->lights[block->light];
    const size_t from = place != LENS_NONE ? place : light->system.places;
    struct aimed_rates rates;
    aimed_sweep(&block->aimed, &light->layout, from, adjoint, bundle->gradient, &rates);
    sweep_gather(bundle, which, from, links, variable_count, adjoint, &rates, columns);
}

void merit_bundle_sweep_graze(const struct merit_bundle *bundle, size_t which,
                              const struct bundle_links *links, size_t variable_count,
                              const struct grazing_penalty *grazing, double *columns)
{
    const struct bundle_block *block = &bundle->blocks[which];
    struct ray_block adjoint;
    struct aimed_rates rates;
    aimed_sweep_seeds(&block->aimed, &bundle->lights[block->light].layout, &grazing->seeds,
                      &adjoint, bundle->gradient, &rates);
    sweep_gather(bundle, which, LENS_NONE, links, variable_count, &adjoint, &rates, columns);
}

/* -------- surfaces that are deformed -------- */

/* The part of a ray that moves: those of struct bent. */
static double *part(struct ray_block *block, int which)
{
    double *const of[LINEAR_RAYS_PARTS] = {block->x, block->y, block->p, block->q, block->path};
    return of[which];
}

/* Of the block that was traced last. */
static void deform(struct merit_bundle *bundle, struct bundle_block *block,
                   struct irregularity_weights *weights)
{
    const struct bundle_wish *wish = &bundle->wish;
    const struct bundle_light *light = &bundle->lights[block->light];
    const struct irregularity_sweep sweep = {&light->system, &light->layout, &bundle->work.tape,
                                             bundle->gradient};
    const size_t count = wish->irregularity_count, lanes = (size_t)block->aimed.lanes;
    struct ray_block adjoint;
    struct aimed_rates rates;
    for (size_t i = 0; i < count; i++) {
        irregularity_weigh(&wish->irregularities[i], &sweep, &weights[i]);
    }
    for (int which = 0; which < LINEAR_RAYS_PARTS; which++) {
        memset(&adjoint, 0, sizeof adjoint);
        for (int i = 0; i < block->aimed.lanes; i++) {
            part(&adjoint, which)[i] = 1;
        }
        aimed_sweep(&block->aimed, &light->layout, light->system.places, &adjoint, bundle->gradient,
                    &rates);
        for (size_t i = 0; i < count; i++) {
            irregularity_gain(&wish->irregularities[i], &sweep, &weights[i],
                              block->deformed + ((size_t)which * count + i) * lanes);
        }
    }
}

bool merit_bundle_deform(struct merit_bundle *bundle, struct error *error)
{
    const size_t count = bundle->wish.irregularity_count;
    struct arena room = arena_within(&bundle->within);
    struct irregularity_weights *weights = ARENA_ARRAY(&room, count, struct irregularity_weights);
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct bundle_block *block = &bundle->blocks[k];
        struct ray_block end;
        block->is_deformed = false;
        if (!merit_bundle_goes_on(bundle, (size_t)block->aimed.lanes, error) ||
            !merit_bundle_trace(bundle, k, true, &end, error)) {
            return false;
        }
        if (block->deformed == NULL) {
            block->deformed = ARENA_ARRAY(
                bundle->arena, LINEAR_RAYS_PARTS * count * (size_t)block->aimed.lanes, double);
        }
        deform(bundle, block, weights);
        block->is_deformed = true;
    }
    return true;
}
