/* commands/design/optimize_contrast.c - whether contrast was seen as it is. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_contrast.h"

#include <math.h>

/* Contrasts that are off by so much are said. */
static const double doubtful = 0.01;

enum { RAYS_MOST = 1000 }; /* that goals of contrast take */

static bool is_contrast(const struct merit_slot *slot)
{
    return slot->operand->kind == OPERAND_MTF || slot->operand->kind == OPERAND_GMTF;
}

/* The slots of contrast alone, in their order, by more rays. */
static bool look_again(struct optimize_job *job, size_t rays, struct merit *merit)
{
    struct arena *arena = job->run->arena;
    struct merit_question question = job->merit.question;
    struct operand *operands = ARENA_ARRAY(arena, question.operand_count, struct operand);
    struct error ignored;
    size_t count = 0;
    for (size_t i = 0; i < question.operand_count; i++) {
        const struct operand *operand = &question.operands[i];
        if (operand->kind == OPERAND_MTF || operand->kind == OPERAND_GMTF) {
            operands[count++] = *operand;
        }
    }
    question.operands = operands;
    question.operand_count = count;
    question.rays = rays;
    if (count == 0 || rays < 2 * job->merit.question.rays ||
        !merit_open(&question, arena, merit, &ignored)) {
        return false;
    }
    double *residuals = ARENA_ARRAY(arena, merit->residual_count, double);
    return merit_evaluate(merit, job->answer.after.numbers, residuals, NULL);
}

const char *optimize_contrast_doubt(struct optimize_job *job)
{
    const struct merit *seen = &job->merit;
    const size_t rays = 4 * seen->question.rays < RAYS_MOST ? 4 * seen->question.rays : RAYS_MOST;
    const struct merit_slot *worst = NULL;
    struct merit again;
    double off = doubtful, was = 0, is = 0;
    size_t row = 0;
    if (!look_again(job, rays, &again)) {
        return NULL;
    }
    for (size_t i = 0; i < seen->slot_count; i++) {
        const struct merit_slot *slot = &seen->slots[i];
        for (size_t k = 0; k < slot->count && is_contrast(slot); k++, row++) {
            const double before = job->answer.after.values[slot->first + k];
            if (fabs(again.values[row] - before) > off) {
                off = fabs(again.values[row] - before);
                was = before;
                is = again.values[row];
                worst = slot;
            }
        }
    }
    return worst == NULL
               ? NULL
               : arena_printf(job->run->arena,
                              "contrast wants more than %zu rays: of goal %s they see %.3f, where "
                              "%zu see %.3f",
                              seen->question.rays, worst->operand->name, was, rays, is);
}
