/* design/merit_rays.c - operands of many rays: spots and wave fronts. */
/* SPDX-License-Identifier: MIT */
#include "design/merit_rays.h"

#include "design/merit_bundle.h"
#include "design/merit_graze.h"
#include "design/merit_paraxial.h"
#include "design/merit_sphere.h"

#include <math.h>
#include <string.h>

/* What a slot keeps. */
struct merit_rays {
    struct merit_bundle bundle;
    bool is_joint;               /* one centroid of all wavelengths */
    int outputs;                 /* of a ray: x and y; of a wave front its path */
    struct merit_spheres *waves; /* null: of a spot */
    size_t variable_count;
    struct bundle_links *links; /* one a light */
    /* of each block and output: the values, and a row of them for each variable */
    double *values;
    double *means; /* of each set of rays that has one mean, and output: the same */
    double *share; /* what a group counts in its centroid */
};

/* Numbers of one lane: the value and its derivatives. */
static size_t rows_of(const struct merit_rays *rays)
{
    return 1 + rays->variable_count;
}

/* -------- opening -------- */

static bool displaces(const struct variable_link *links, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (links[i].basis.kind >= PARAMETER_DECENTER_X) {
            return true;
        }
    }
    return false;
}

/* The fields and wavelengths of the operand: its own, or those of the position. */
static void choose(const struct merit_slot *slot, struct arena *arena, struct bundle_wish *wish)
{
    static const struct setup_field axis = {{.kind = FIELD_NONE}, 1};
    const struct setup *setup = wish->setup;
    const struct operand *operand = slot->operand;
    wish->fields = setup->field_count > 0 ? setup->fields : &axis;
    wish->field_count = setup->field_count > 0 ? setup->field_count : 1;
    wish->wavelengths = setup->wavelengths;
    wish->wavelength_count = setup->wavelength_count;
    if (operand->field != NULL) {
        wish->fields = operand->field;
        wish->field_count = 1;
    }
    if (!isnan(operand->wavelength)) {
        struct setup_wavelength *one = ARENA_NEW(arena, struct setup_wavelength);
        *one = (struct setup_wavelength){operand->wavelength, 1};
        wish->wavelengths = one;
        wish->wavelength_count = 1;
    }
}

/* The links as they are now. */
static void find_links(struct merit *merit, const struct merit_slot *slot, struct merit_rays *rays)
{
    const struct bundle_wish *wish = &rays->bundle.wish;
    for (size_t i = 0; i < wish->wavelength_count; i++) {
        const struct merit_light *light = merit_light(merit, slot, wish->wavelengths[i].wavelength);
        rays->links[i] = (struct bundle_links){light->links, light->link_count};
    }
}

/* Of rays about the axis x is 0. */
static int first_output(const struct merit_rays *rays, const struct bundle_group *group)
{
    return rays->waves == NULL && group->points.symmetry == SYMMETRY_ROUND ? 1 : 0;
}

/* Numbers of residuals, and what each group counts in its centroid. */
static size_t number(struct merit_rays *rays, struct arena *arena)
{
    struct merit_bundle *bundle = &rays->bundle;
    const struct bundle_wish *wish = &bundle->wish;
    double *sums = ARENA_ARRAY(arena, wish->field_count, double);
    size_t count = 0;
    rays->share = ARENA_ARRAY(arena, bundle->group_count, double);
    for (size_t i = 0; i < bundle->group_count; i++) {
        struct bundle_group *group = &bundle->groups[i];
        sums[group->field] += group->weight;
        group->row = count;
        count += group->points.count * (size_t)(rays->outputs - first_output(rays, group));
    }
    for (size_t i = 0; i < bundle->group_count; i++) {
        const struct bundle_group *group = &bundle->groups[i];
        rays->share[i] = !rays->is_joint          ? 1
                         : sums[group->field] > 0 ? group->weight / sums[group->field]
                                                  : 0; /* none of it counts */
    }
    return count;
}

static void make_room(struct merit_rays *rays, struct arena *arena)
{
    const struct merit_bundle *bundle = &rays->bundle;
    const size_t rows = (size_t)rays->outputs * rows_of(rays);
    rays->values = ARENA_ARRAY(arena, bundle->block_count * rows * RAYS_BLOCK, double);
    rays->means = ARENA_ARRAY(arena, bundle->group_count * rows, double);
}

size_t merit_prepare_rays(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                          struct error *error)
{
    const struct merit_question *question = &merit->question;
    struct merit_rays *rays = ARENA_NEW(arena, struct merit_rays);
    struct bundle_wish wish = {.setup = &merit->places[slot->place].setup,
                               .from_entrance = question->from_entrance,
                               .clip = question->clip,
                               .pattern = question->pattern,
                               .rays = question->rays,
                               .seed = question->seed,
                               .is_round = !question->is_skew && question->irregularity_count == 0,
                               .irregularities = question->irregularities,
                               .irregularity_count = question->irregularity_count,
                               .irregularity_amounts = question->irregularity_amounts};
    if (slot->operand->relation != OPERAND_NEAR || slot->operand->target != 0) {
        fail(error, ERROR_DOMAIN, "it is made as small as can be, and has no target");
        return 0;
    }
    wish.from_entrance = wish.from_entrance || wish.setup->first.is_telecentric;
    choose(slot, arena, &wish);
    slot->own = rays;
    rays->is_joint = slot->operand->kind == OPERAND_POLY;
    rays->outputs = slot->operand->kind == OPERAND_OPD ? 1 : 2;
    wish.path = slot->operand->kind == OPERAND_OPD;
    rays->variable_count = merit->variable_count;
    rays->bundle.wish = wish;
    rays->links = ARENA_ARRAY(arena, wish.wavelength_count, struct bundle_links);
    merit->derives = true; /* the links of the lens at the start */
    merit->evaluation++;
    find_links(merit, slot, rays);
    for (size_t i = 0; i < wish.wavelength_count; i++) {
        wish.is_round = wish.is_round && !displaces(rays->links[i].list, rays->links[i].count);
    }
    if (!merit_bundle_open(&wish, rays->links, merit->variable_count, arena, &rays->bundle,
                           error)) {
        return 0;
    }
    if (wish.path) {
        rays->waves =
            merit_spheres_open(&wish, &rays->links[0], merit->variable_count, arena, error);
        if (rays->waves == NULL) {
            return 0;
        }
    }
    make_room(rays, arena);
    return number(rays, arena);
}

/* -------- filling -------- */

/* x or y of a block and all of its derivatives. */
static double *rows_at(const struct merit_rays *rays, size_t block, int output)
{
    const size_t rows = rows_of(rays) * RAYS_BLOCK;
    return rays->values + (block * (size_t)rays->outputs + (size_t)output) * rows;
}

static double *means_at(const struct merit_rays *rays, size_t group, int output)
{
    const size_t set = rays->is_joint ? rays->bundle.groups[group].field : group;
    return rays->means + (set * (size_t)rays->outputs + (size_t)output) * rows_of(rays);
}

/* The values of an output of the final rays, and what it is by them. */
static void set_output(const struct merit_rays *rays, const struct bundle_block *block, int output,
                       const struct ray_block *end, double *values, struct ray_block *adjoint)
{
    memset(adjoint, 0, sizeof *adjoint);
    if (rays->waves != NULL) {
        merit_spheres_path(rays->waves, &rays->bundle, block, end, values, adjoint);
        return;
    }
    memcpy(values, output == 0 ? end->x : end->y, RAYS_BLOCK * sizeof *values);
    for (int i = 0; i < block->aimed.lanes; i++) {
        *(output == 0 ? &adjoint->x[i] : &adjoint->y[i]) = 1;
    }
}

static bool trace_block(struct merit *merit, const struct merit_slot *slot, size_t which,
                        struct error *error)
{
    struct merit_rays *rays = slot->own;
    struct merit_bundle *bundle = &rays->bundle;
    const struct bundle_block *block = &bundle->blocks[which];
    struct ray_block end, adjoint;
    if (!merit_bundle_trace(bundle, which, merit->derives, &end, error)) {
        return false;
    }
    if (bundle->keeps) {
        merit_graze_add(merit, slot, bundle, which, &rays->links[block->light]);
    }
    for (int k = 0; k < rays->outputs; k++) {
        double *rows = rows_at(rays, which, k);
        set_output(rays, block, k, &end, rows, &adjoint);
        if (!merit->derives) {
            continue;
        }
        merit_bundle_sweep(bundle, which, &rays->links[block->light], rays->variable_count,
                           &adjoint, rows + RAYS_BLOCK);
        if (rays->waves != NULL) {
            merit_spheres_move(rays->waves, bundle, block, &end, rows + RAYS_BLOCK);
        }
    }
    return true;
}

/* x or y whose mean is 0 by symmetry. */
static bool is_centred(const struct merit_rays *rays, const struct bundle_group *group, int output)
{
    return rays->waves == NULL && (group->points.symmetry == SYMMETRY_ROUND ||
                                   (group->points.symmetry == SYMMETRY_MIRROR && output == 0));
}

/* What the rays of a block add to the means. */
static void add_means(struct merit_rays *rays, size_t which, size_t rows)
{
    const struct bundle_block *block = &rays->bundle.blocks[which];
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct bundle_share *share = &block->shares[g];
        const struct bundle_group *group = &rays->bundle.groups[share->group];
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const struct pupil_point *points = group->points.points + share->first;
        double weights[RAYS_BLOCK];
        for (int i = 0; i < beam->count; i++) {
            weights[i] = points[i].weight * rays->share[share->group];
        }
        for (int k = 0; k < rays->outputs; k++) {
            double *means = means_at(rays, share->group, k);
            const double *from = rows_at(rays, which, k) + beam->first;
            for (size_t j = 0; j < rows && !is_centred(rays, group, k); j++, from += RAYS_BLOCK) {
                double sum = 0;
                for (int i = 0; i < beam->count; i++) {
                    sum += weights[i] * from[i];
                }
                means[j] += sum;
            }
        }
    }
}

/* One coordinate of the rays of one group in a block. */
struct part {
    const double *rows, *means;
    double factors[RAYS_BLOCK];
    int count;
};

static void put_part(const struct part *part, size_t variable_count, double *residuals,
                     double *jacobian)
{
    for (int i = 0; i < part->count; i++) {
        residuals[i] = part->factors[i] * (part->rows[i] - part->means[0]);
    }
    for (size_t j = 0; jacobian != NULL && j < variable_count; j++) {
        const double *row = part->rows + (j + 1) * RAYS_BLOCK, mean = part->means[j + 1];
        for (int i = 0; i < part->count; i++) {
            jacobian[(size_t)i * variable_count + j] = part->factors[i] * (row[i] - mean);
        }
    }
}

static void put_block(const struct merit_rays *rays, size_t which, double deviation,
                      double *residuals, double *jacobian)
{
    const struct bundle_block *block = &rays->bundle.blocks[which];
    const double um = 1e-3, wavelength = um * rays->bundle.lights[block->light].wavelength;
    const double unit = deviation * (rays->waves != NULL ? wavelength : 1);
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct bundle_share *share = &block->shares[g];
        const struct bundle_group *group = &rays->bundle.groups[share->group];
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const int begin = first_output(rays, group);
        struct part part = {.count = beam->count};
        for (int i = 0; i < part.count; i++) {
            const double weight = group->points.points[share->first + (size_t)i].weight;
            part.factors[i] = sqrt(weight * group->weight) / unit;
        }
        for (int k = begin; k < rays->outputs; k++) {
            const size_t before = (size_t)(k - begin) * group->points.count;
            const size_t row = group->row + before + share->first;
            part.rows = rows_at(rays, which, k) + beam->first;
            part.means = means_at(rays, share->group, k);
            put_part(&part, rays->variable_count, residuals + row,
                     jacobian != NULL ? jacobian + row * rays->variable_count : NULL);
        }
    }
}

/* The exit pupil is that of the first wavelength. */
static bool find_spheres(struct merit *merit, const struct merit_slot *slot,
                         const struct merit_figures *primary, struct merit_rays *rays)
{
    struct merit_spheres *waves = rays->waves;
    const struct merit_figures *figures =
        merit_figures(merit, slot, rays->bundle.wish.wavelengths[0].wavelength);
    if (merit->forgets) {
        merit_bundle_forget(&waves->chief);
    }
    if (figures == NULL || !merit_bundle_aim(&waves->chief, merit->places[slot->place].lens,
                                             &primary[0].first, &merit->why)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        waves->pupil[j] = figures[j].first.exit_pupil;
        waves->chief.rates[j] = merit_bundle_rate(&waves->chief, &primary[j].first);
    }
    return merit_spheres_find(waves, &rays->links[0], merit->derives, &merit->why);
}

bool merit_rays_aim(struct merit *merit, const struct merit_slot *slot)
{
    struct merit_rays *rays = slot->own;
    struct merit_bundle *bundle = &rays->bundle;
    const bool is_bare = bundle->is_held && rays->waves == NULL; /* nothing is paraxial */
    const struct merit_figures *figures = is_bare ? NULL : merit_figures(merit, slot, NAN);
    if (merit->forgets) {
        merit_bundle_forget(bundle);
    }
    if ((figures == NULL && !is_bare) ||
        !merit_bundle_aim(bundle, merit->places[slot->place].lens,
                          is_bare ? NULL : &figures[0].first, &merit->why)) {
        return false;
    }
    for (size_t j = 0; merit->derives && j < rays->variable_count; j++) {
        bundle->rates[j] = is_bare ? (struct bundle_rate){0, 0, 0, 0}
                                   : merit_bundle_rate(bundle, &figures[j].first);
    }
    find_links(merit, slot, rays);
    return rays->waves == NULL || find_spheres(merit, slot, figures, rays);
}

bool merit_fill_rays(struct merit *merit, const struct merit_slot *slot, double *residuals,
                     double *jacobian)
{
    struct merit_rays *rays = slot->own;
    struct merit_bundle *bundle = &rays->bundle;
    const size_t rows = merit->derives ? rows_of(rays) : 1;
    bundle->keeps = merit->places[slot->place].graze != NULL;
    if (!merit_rays_aim(merit, slot)) {
        return false;
    }
    memset(rays->means, 0,
           bundle->group_count * (size_t)rays->outputs * rows_of(rays) * sizeof(double));
    for (size_t k = 0; k < bundle->block_count; k++) {
        if (!trace_block(merit, slot, k, &merit->why)) {
            return false;
        }
        add_means(rays, k, rows);
    }
    for (size_t k = 0; k < bundle->block_count; k++) {
        put_block(rays, k, slot->operand->deviation, residuals, jacobian);
    }
    memcpy(merit->values + slot->first, residuals, slot->count * sizeof *residuals);
    return true;
}

void merit_rays_settle(const struct merit_slot *slot, bool holds)
{
    struct merit_rays *rays = slot->own;
    merit_bundle_settle(&rays->bundle, holds);
    if (rays->waves != NULL) {
        merit_bundle_settle(&rays->waves->chief, holds);
    }
}

struct merit_rays_look merit_rays_look(const struct merit_slot *slot)
{
    struct merit_rays *rays = slot->own;
    return (struct merit_rays_look){&rays->bundle, rays->share, rays->is_joint};
}

bool merit_rays_deform(const struct merit_slot *slot, struct error *error)
{
    struct merit_rays *rays = slot->own;
    return merit_bundle_deform(&rays->bundle, error) &&
           (rays->waves == NULL || merit_bundle_deform(&rays->waves->chief, error));
}
