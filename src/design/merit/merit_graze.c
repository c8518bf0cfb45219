/* design/merit/merit_graze.c - rays near loss, as an operand. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_graze.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* Nothing is known of the rays as yet. */
static void merit_graze_begin(const struct merit *merit, struct merit_graze *graze)
{
    if (graze->evaluation == merit->evaluation) {
        return;
    }
    graze->evaluation = merit->evaluation;
    graze->margin = NAN;
    graze->value = 0;
    memset(graze->slopes, 0, merit->variable_count * sizeof(double));
}

void merit_graze_add(struct merit *merit, const struct merit_slot *slot,
                     struct merit_bundle *bundle, size_t block, const struct bundle_links *links)
{
    struct merit_graze *graze = merit->places[slot->place].graze;
    const struct bundle_block *at = &bundle->blocks[block];
    double weights[RAYS_BLOCK];
    struct grazing_penalty grazing;
    merit_graze_begin(merit, graze);
    merit_bundle_graze(bundle, block, graze->limit, merit->derives, &grazing);
    graze->margin = fmin(graze->margin, grazing.margin);
    if (!grazing.any) {
        return;
    }
    for (int i = 0; i < at->aimed.count; i++) {
        const struct bundle_group *group = &bundle->groups[at->lanes[i].group];
        const double weight = group->weight * group->points.points[at->lanes[i].point].weight;
        weights[i] = grazing.value[i] > 0 ? weight : 0;
        graze->value += grazing.value[i] > 0 ? weight * grazing.value[i] : 0;
    }
    if (merit->derives) {
        const struct arena_mark mark = arena_mark(merit->arena);
        double *columns = ARENA_ARRAY(merit->arena, merit->variable_count * RAYS_BLOCK + 1, double);
        merit_bundle_sweep_graze(bundle, block, links, merit->variable_count, &grazing, columns);
        const int count = bundle->blocks[block].aimed.count;
        for (size_t j = 0; j < merit->variable_count; j++) {
            double sum = 0;
            for (int i = 0; i < count; i++) {
                sum += weights[i] != 0 ? weights[i] * columns[j * RAYS_BLOCK + (size_t)i] : 0;
            }
            graze->slopes[j] += sum;
        }
        arena_reset(merit->arena, mark);
    }
}

bool merit_fill_graze(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    struct merit_graze *graze = slot->own;
    const double deviation = slot->operand->deviation;
    merit_graze_begin(merit, graze);
    residuals[0] = graze->value / deviation;
    merit->values[slot->first] = acos(sqrt(graze->margin));
    for (size_t j = 0; j < merit->variable_count && jacobian != NULL; j++) {
        jacobian[j] = graze->slopes[j] / deviation;
    }
    return isfinite(residuals[0]) || fail(&merit->why, ERROR_DOMAIN, "a ray is lost");
}

size_t merit_prepare_graze(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    struct merit_place *place = &merit->places[slot->place];
    const struct operand *operand = slot->operand;
    const double cosine = cos(operand->target);
    if (operand->relation != OPERAND_BELOW || !(operand->target > 0) ||
        !(operand->target <= 90 * RADIANS_PER_DEGREE)) {
        fail(error, ERROR_DOMAIN, "it is an angle up to 90 deg that rays are to stay below");
        error_hint(error, "grazing < 85, or grazing < 90 for none");
        return 0;
    }
    /* are there any rays to look at? */
    bool has = false;
    for (size_t i = 0; i < merit->question.operand_count; i++) {
        const struct operand_type *type = operand_type(merit->question.operands[i].kind);
        has = has || (type->is & OPERAND_TRACES) != 0;
    }
    if (!has) {
        fail(error, ERROR_DOMAIN, "there are no rays that it could look at");
        error_hint(error, "a goal of rays beside it: spot, poly, opd, mtf or gmtf");
        return 0;
    }
    if (place->graze != NULL) {
        fail(error, ERROR_DOMAIN, "the largest angle of rays is given twice");
        return 0;
    }
    place->graze = ARENA_NEW(arena, struct merit_graze);
    place->graze->limit = cosine > 1e-9 ? cosine * cosine : 0;
    place->graze->slopes = ARENA_ARRAY(arena, merit->variable_count + 1, double);
    slot->own = place->graze;
    return 1;
}
