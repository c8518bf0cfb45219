/* design/merit/merit_spots.c - spots of fields in every plane near the image, from one trace. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_spots.h"

#include <math.h>
#include <string.h>

/* The rays of a block as straight lines: x, y in the image plane, and how they go on with z. */
enum { AT_X, AT_Y, ALONG_X, ALONG_Y, LINE_PARTS };

struct merit_lines {
    struct merit_bundle *bundle;
    double (*blocks)[LINE_PARTS][RAYS_BLOCK];
    double *weights;             /* of each ray within the spot of its field, block by block */
    double (*means)[LINE_PARTS]; /* one a field */
};

struct merit_lines *merit_lines_open(const struct merit_slot *slot, struct arena *arena)
{
    struct merit_lines *lines = ARENA_NEW(arena, struct merit_lines);
    struct merit_bundle *bundle = &slot->beams->bundle;
    /* what each group counts within the spot of its field */
    double *sums = ARENA_ARRAY(arena, bundle->wish.field_count, double);
    double *shares = ARENA_ARRAY(arena, bundle->group_count, double);
    for (size_t i = 0; i < bundle->group_count; i++) {
        const struct bundle_group *group = &bundle->groups[i];
        shares[i] = bundle->wish.wavelengths[group->light].weight * group->points.clear;
        sums[group->field] += shares[i];
    }
    for (size_t i = 0; i < bundle->group_count; i++) {
        shares[i] /= sums[bundle->groups[i].field];
    }
    lines->bundle = bundle;
    lines->blocks = arena_array(arena, bundle->block_count, sizeof *lines->blocks);
    lines->means = arena_array(arena, bundle->wish.field_count, sizeof *lines->means);
    lines->weights = ARENA_ARRAY(arena, bundle->block_count * RAYS_BLOCK, double);
    for (size_t k = 0; k < bundle->block_count; k++) {
        for (int i = 0; i < bundle->blocks[k].aimed.count; i++) {
            const struct bundle_lane *lane = &bundle->blocks[k].lanes[i];
            lines->weights[k * RAYS_BLOCK + (size_t)i] =
                bundle->groups[lane->group].points.points[lane->point].weight * shares[lane->group];
        }
    }
    return lines;
}

/* Squares about the means; of rays about the axis x is 0. */
static void add_squares(const struct merit_lines *lines, size_t which,
                        const struct aimed_beam *beam, struct merit_spot *spots)
{
    const size_t field = lines->bundle->blocks[which].lanes[beam->first].field;
    const double *weights = lines->weights + which * RAYS_BLOCK, *means = lines->means[field];
    double at = 0, by = 0, bend = 0;
    for (int k = 0; k < 2; k++) {
        const double *x = lines->blocks[which][AT_X + k];
        const double *slope = lines->blocks[which][ALONG_X + k];
        const double middle = means[AT_X + k], drift = means[ALONG_X + k];
        for (int i = beam->first; i < beam->first + beam->count; i++) {
            const double dx = x[i] - middle, ds = slope[i] - drift, w = weights[i];
            at += w * dx * dx;
            by += w * dx * ds;
            bend += w * ds * ds;
        }
    }
    spots[field].at += at;
    spots[field].by += by;
    spots[field].bend += bend;
}

bool merit_spots_find(struct merit *merit, const struct merit_slot *slot, struct merit_lines *lines,
                      struct merit_spot *spots)
{
    struct merit_bundle *bundle = lines->bundle;
    if (!merit_beams_aim(merit, slot, slot->beams)) {
        return false;
    }
    memset(lines->means, 0, bundle->wish.field_count * sizeof *lines->means);
    memset(spots, 0, bundle->wish.field_count * sizeof *spots);
    for (size_t k = 0; k < bundle->block_count; k++) {
        const int lanes = bundle->blocks[k].aimed.lanes;
        double(*line)[RAYS_BLOCK] = lines->blocks[k];
        struct ray_block end;
        if (!merit_bundle_trace(bundle, k, false, &end, &merit->why)) {
            return false;
        }
        memcpy(line[AT_X], end.x, (size_t)lanes * sizeof(double));
        memcpy(line[AT_Y], end.y, (size_t)lanes * sizeof(double));
        for (int i = 0; i < lanes; i++) {
            const double over = 1 / end.r[i];
            line[ALONG_X][i] = end.p[i] * over;
            line[ALONG_Y][i] = end.q[i] * over;
        }
        for (size_t g = 0; g < bundle->blocks[k].aimed.beam_count; g++) {
            /* what the rays of a group in a block add to the means of their field */
            const struct aimed_beam *beam = &bundle->blocks[k].aimed.beams[g];
            const struct bundle_lane *lane = &lines->bundle->blocks[k].lanes[beam->first];
            const double *weights = lines->weights + k * RAYS_BLOCK;
            for (int part = 0; part < LINE_PARTS; part++) {
                double sum = 0;
                /* x or y that is 0 in the mean of all that a folded group stands for */
                const enum merit_symmetry symmetry =
                    lines->bundle->groups[lane->group].points.symmetry;
                if (symmetry == SYMMETRY_ROUND ||
                    (symmetry == SYMMETRY_MIRROR && (part == AT_X || part == ALONG_X))) {
                    continue;
                }
                for (int i = beam->first; i < beam->first + beam->count; i++) {
                    sum += weights[i] * lines->blocks[k][part][i];
                }
                lines->means[lane->field][part] += sum;
            }
        }
    }
    for (size_t k = 0; k < bundle->block_count; k++) {
        for (size_t g = 0; g < bundle->blocks[k].aimed.beam_count; g++) {
            add_squares(lines, k, &bundle->blocks[k].aimed.beams[g], spots);
        }
    }
    for (size_t f = 0; f < bundle->wish.field_count; f++) {
        memcpy(spots[f].centroid, &lines->means[f][AT_X], sizeof spots[f].centroid);
        memcpy(spots[f].drift, &lines->means[f][ALONG_X], sizeof spots[f].drift);
    }
    return true;
}
