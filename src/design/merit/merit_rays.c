/* design/merit/merit_rays.c - operands of many rays: spots and wave fronts. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_rays.h"

#include "design/merit/merit_graze.h"

#include <math.h>
#include <string.h>

/* What a slot keeps. */
struct merit_rays {
    struct merit_beams beams; /* with spheres: of a wave front, else of a spot */
    bool is_joint;            /* one centroid of all wavelengths */
    int outputs;              /* of a ray: x and y; of a wave front its path */
    size_t variable_count;
    /* of each block and output: the values, and a row of them for each variable */
    double *values;
    double *means; /* of each set of rays that has one mean, and output: the same */
    double *share; /* what a group counts in its centroid */
};

/* Numbers of one lane: the value and its derivatives. */
static size_t merit_rays_rows_of(const struct merit_rays *rays)
{
    return 1 + rays->variable_count;
}

/* -------- opening -------- */

/* Of rays about the axis x is 0. */
static int first_output(const struct merit_rays *rays, const struct bundle_group *group)
{
    return rays->beams.spheres == NULL && group->points.symmetry == SYMMETRY_ROUND ? 1 : 0;
}

size_t merit_prepare_rays(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                          struct error *error)
{
    struct merit_rays *rays = ARENA_NEW(arena, struct merit_rays);
    const bool path = slot->operand->kind == OPERAND_OPD;
    if (slot->operand->relation != OPERAND_NEAR || slot->operand->target != 0) {
        fail(error, ERROR_DOMAIN, "it is made as small as can be, and has no target");
        return 0;
    }
    slot->own = rays;
    slot->beams = &rays->beams;
    rays->is_joint = slot->operand->kind == OPERAND_POLY || slot->operand->kind == OPERAND_ASBUILT;
    rays->outputs = path ? 1 : 2;
    rays->variable_count = merit->variable_count;
    if (!merit_beams_open(merit, slot, path, false, arena, &rays->beams, error)) {
        return 0;
    }
    const struct merit_bundle *bundle = &rays->beams.bundle;
    const size_t rows = (size_t)rays->outputs * merit_rays_rows_of(rays);
    rays->values = ARENA_ARRAY(arena, bundle->block_count * rows * RAYS_BLOCK, double);
    rays->means = ARENA_ARRAY(arena, bundle->group_count * rows, double);
    /* numbers of residuals, and what each group counts in its centroid */
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
        rays->share[i] = rays->is_joint ? 0 : 1; /* 0: none of it counts */
        if (rays->is_joint && sums[group->field] > 0) {
            rays->share[i] = group->weight / sums[group->field];
        }
    }
    return count;
}

/* -------- filling -------- */

/* x or y of a block and all of its derivatives. */
static double *rows_at(const struct merit_rays *rays, size_t block, int output)
{
    const size_t rows = merit_rays_rows_of(rays) * RAYS_BLOCK;
    return rays->values + (block * (size_t)rays->outputs + (size_t)output) * rows;
}

static double *means_at(const struct merit_rays *rays, size_t group, int output)
{
    const size_t set = rays->is_joint ? rays->beams.bundle.groups[group].field : group;
    return rays->means + (set * (size_t)rays->outputs + (size_t)output) * merit_rays_rows_of(rays);
}

static bool trace_block(struct merit *merit, const struct merit_slot *slot, size_t which,
                        struct error *error)
{
    struct merit_rays *rays = slot->own;
    struct merit_bundle *bundle = &rays->beams.bundle;
    const struct bundle_block *block = &bundle->blocks[which];
    const struct merit_spheres *spheres = rays->beams.spheres;
    const struct bundle_links *links = &rays->beams.links[block->light];
    struct ray_block end;
    if (!merit_bundle_trace(bundle, which, merit->derives, &end, error)) {
        return false;
    }
    if (bundle->keeps) {
        merit_graze_add(merit, slot, bundle, which, links);
    }
    for (int k = 0; k < rays->outputs; k++) {
        double *rows = rows_at(rays, which, k);
        struct ray_block adjoint = {.lost = {0}};
        struct merit_spheres_by by;
        double *const ones = k == 0 ? adjoint.x : adjoint.y;
        if (spheres != NULL) {
            merit_spheres_meet(spheres, bundle, block, &end, rows, NULL);
        } else {
            memcpy(rows, k == 0 ? end.x : end.y, RAYS_BLOCK * sizeof *rows);
        }
        for (int i = 0; i < block->aimed.lanes && merit->derives; i++) {
            if (spheres != NULL) {
                by.path[i] = 1;
            } else {
                ones[i] = 1;
            }
        }
        if (merit->derives && spheres != NULL) {
            memset(by.to, 0, sizeof by.to);
            merit_spheres_back(spheres, bundle, block, &end, &by, &adjoint);
        }
        if (merit->derives) {
            merit_bundle_sweep(bundle, which, LENS_NONE, links, rays->variable_count, &adjoint,
                               rows + RAYS_BLOCK);
        }
        if (merit->derives && spheres != NULL) {
            merit_spheres_move(spheres, block, &by, rows + RAYS_BLOCK);
        }
    }
    return true;
}

/* x or y whose mean is 0 by symmetry. */
static bool merit_rays_is_centred(const struct merit_rays *rays, const struct bundle_group *group,
                                  int output)
{
    return rays->beams.spheres == NULL &&
           (group->points.symmetry == SYMMETRY_ROUND ||
            (group->points.symmetry == SYMMETRY_MIRROR && output == 0));
}

/* What the rays of a block add to the means. */
static void merit_rays_add_means(struct merit_rays *rays, size_t which, size_t rows)
{
    const struct bundle_block *block = &rays->beams.bundle.blocks[which];
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const struct bundle_lane *lane = &block->lanes[beam->first];
        const struct bundle_group *group = &rays->beams.bundle.groups[lane->group];
        const struct pupil_point *points = group->points.points + lane->point;
        double weights[RAYS_BLOCK];
        for (int i = 0; i < beam->count; i++) {
            weights[i] = points[i].weight * rays->share[lane->group];
        }
        for (int k = 0; k < rays->outputs; k++) {
            double *means = means_at(rays, lane->group, k);
            const double *from = rows_at(rays, which, k) + beam->first;
            for (size_t j = 0; j < rows && !merit_rays_is_centred(rays, group, k);
                 j++, from += RAYS_BLOCK) {
                double sum = 0;
                for (int i = 0; i < beam->count; i++) {
                    sum += weights[i] * from[i];
                }
                means[j] += sum;
            }
        }
    }
}

static void put_block(const struct merit_rays *rays, size_t which, double deviation,
                      double *residuals, double *jacobian)
{
    const struct bundle_block *block = &rays->beams.bundle.blocks[which];
    const double um = 1e-3, wavelength = um * rays->beams.bundle.lights[block->light].wavelength;
    const double unit = deviation * (rays->beams.spheres != NULL ? wavelength : 1);
    for (size_t g = 0; g < block->aimed.beam_count; g++) {
        const struct aimed_beam *beam = &block->aimed.beams[g];
        const struct bundle_lane *lane = &block->lanes[beam->first];
        const struct bundle_group *group = &rays->beams.bundle.groups[lane->group];
        const int begin = first_output(rays, group);
        const size_t n = rays->variable_count;
        double factors[RAYS_BLOCK];
        for (int i = 0; i < beam->count; i++) {
            const double weight = group->points.points[lane->point + (size_t)i].weight;
            factors[i] = sqrt(weight * group->weight) / unit;
        }
        for (int k = begin; k < rays->outputs; k++) {
            const size_t before = (size_t)(k - begin) * group->points.count;
            const size_t row = group->row + before + lane->point;
            const double *rows = rows_at(rays, which, k) + beam->first;
            const double *means = means_at(rays, lane->group, k);
            for (int i = 0; i < beam->count; i++) {
                residuals[row + (size_t)i] = factors[i] * (rows[i] - means[0]);
            }
            for (size_t j = 0; jacobian != NULL && j < n; j++) {
                double *slopes = jacobian + row * n + j;
                rows += RAYS_BLOCK;
                for (int i = 0; i < beam->count; i++) {
                    slopes[(size_t)i * n] = factors[i] * (rows[i] - means[j + 1]);
                }
            }
        }
    }
}

bool merit_fill_rays(struct merit *merit, const struct merit_slot *slot, double *residuals,
                     double *jacobian)
{
    struct merit_rays *rays = slot->own;
    struct merit_bundle *bundle = &rays->beams.bundle;
    const size_t rows = merit->derives ? merit_rays_rows_of(rays) : 1;
    bundle->keeps = merit->places[slot->place].graze != NULL;
    if (!merit_beams_aim(merit, slot, &rays->beams)) {
        return false;
    }
    memset(rays->means, 0,
           bundle->group_count * (size_t)rays->outputs * merit_rays_rows_of(rays) * sizeof(double));
    for (size_t k = 0; k < bundle->block_count; k++) {
        if (!trace_block(merit, slot, k, &merit->why)) {
            return false;
        }
        merit_rays_add_means(rays, k, rows);
    }
    for (size_t k = 0; k < bundle->block_count; k++) {
        put_block(rays, k, slot->operand->deviation, residuals, jacobian);
    }
    memcpy(merit->values + slot->first, residuals, slot->count * sizeof *residuals);
    return true;
}

void merit_rays_squares(const struct merit_slot *slot, const double *residuals, double *squares)
{
    const struct merit_rays *rays = slot->own;
    const struct merit_bundle *bundle = &rays->beams.bundle;
    const double unit = slot->operand->deviation * slot->operand->deviation;
    for (size_t field = 0; field < bundle->wish.field_count; field++) {
        double sum = 0, weights = 0;
        for (size_t g = 0; g < bundle->group_count; g++) {
            const struct bundle_group *group = &bundle->groups[g];
            const size_t outputs = (size_t)(rays->outputs - first_output(rays, group));
            const double *from = residuals + group->row;
            for (size_t i = 0; i < group->points.count * outputs && group->field == field; i++) {
                sum += from[i] * from[i];
            }
            weights += group->field == field ? group->weight : 0;
        }
        squares[field] = weights > 0 ? unit * sum / weights : 0;
    }
}
