/* design/closer_look.c - a lens between the rays and fields that its merit sees. */
/* SPDX-License-Identifier: MIT */
#include "design/closer_look.h"

#include "design/merit/merit_rays.h"

#include <math.h>
#include <stdlib.h>

/* What differs by less is alike; what is smaller is nothing; so much of the mean of all fields
   matters. Of squares, but for the two sizes. */
static const double alike = 2.25, matters = 0.25, least_spot = 1e-5, least_path = 1e-3;

enum { LOOK_RAYS = 2, MORE_RAYS = 4, MOST_RAYS = 4000 };

/* -------- fields -------- */

/* By height; those of a plane beside the axis stay as they were listed. */
static int closer_field_compare(const void *one, const void *other)
{
    const double a = ((const struct setup_field *)one)->point.value[1];
    const double b = ((const struct setup_field *)other)->point.value[1];
    return (a > b) - (a < b);
}

/* The fields of the merit, sorted, and between each two of them another. */
static size_t fields_between(const struct merit *merit, struct arena *arena,
                             const struct setup_field **fields)
{
    const struct setup *setup = &merit->places[0].setup;
    const size_t count = setup->field_count;
    struct setup_field *given = ARENA_ARRAY(arena, count + 1, struct setup_field);
    struct setup_field *list = ARENA_ARRAY(arena, 2 * count + 1, struct setup_field);
    bool is_meridional = true;
    for (size_t i = 0; i < count; i++) {
        given[i] = setup->fields[i];
        is_meridional = is_meridional && given[i].point.value[0] == 0;
    }
    if (is_meridional && count > 0) {
        qsort(given, count, sizeof *given, closer_field_compare);
    }
    for (size_t i = 0; i < count; i++) {
        list[2 * i] = given[i];
        if (i + 1 < count) {
            struct setup_field *middle = &list[2 * i + 1];
            *middle = given[i + 1];
            middle->weight = (given[i].weight + given[i + 1].weight) / 2;
            for (int k = 0; k < 2; k++) {
                middle->point.value[k] =
                    (given[i].point.value[k] + given[i + 1].point.value[k]) / 2;
            }
        }
    }
    *fields = list;
    return count > 0 ? 2 * count - 1 : 0;
}

void closer_question(const struct merit *merit, bool rays, bool fields, struct arena *arena,
                     struct merit_question *question)
{
    *question = merit->question;
    if (rays) {
        question->rays = MORE_RAYS * question->rays;
    }
    if (fields) {
        question->field_count = fields_between(merit, arena, &question->fields);
    }
}

/* -------- looking -------- */

/* Goals of rays alone. Result: are there such that count errors, which are left out? */
static bool keep_rays(struct merit_question *question, struct arena *arena)
{
    const struct operand *all = question->operands;
    struct operand *some = ARENA_ARRAY(arena, question->operand_count + 1, struct operand);
    size_t count = 0;
    bool has_errors = false;
    for (size_t i = 0; i < question->operand_count; i++) {
        if ((operand_type(all[i].kind)->is & OPERAND_OF_RAYS) != 0) {
            has_errors = has_errors || all[i].kind == OPERAND_ASBUILT;
            some[count] = all[i];
            some[count].kind = all[i].kind == OPERAND_ASBUILT ? OPERAND_POLY : all[i].kind;
            count++;
        }
    }
    question->operands = some;
    question->operand_count = count;
    return has_errors;
}

/* A merit, and what it has. */
struct look_at {
    struct merit merit;
    double *residuals;
    bool has_value;
};

static bool look_open(const struct merit_question *question, const double *numbers,
                      struct arena *arena, struct look_at *look)
{
    struct error ignored;
    if (!merit_open(question, arena, &look->merit, &ignored)) {
        return false;
    }
    look->residuals = ARENA_ARRAY(arena, look->merit.residual_count + 1, double);
    look->has_value = merit_measure(&look->merit, numbers, look->residuals, NULL);
    return true;
}

/* Is that so much worse? */
static void doubt_offer(struct closer_doubt *doubt, const struct merit_slot *slot,
                        const struct field_point *field, double seen, double is, double mean)
{
    const bool is_path = slot->operand->kind == OPERAND_OPD;
    const double least = is_path ? least_path : least_spot;
    const double worse =
        doubt->operand == NULL ? 1 : (doubt->is * doubt->is) / (doubt->seen * doubt->seen);
    if (is > alike * seen && is - seen > matters * mean && is > least * least &&
        (doubt->operand == NULL || is / fmax(seen, 1e-300) > worse)) {
        *doubt = (struct closer_doubt){slot->operand, *field, is_path, sqrt(seen), sqrt(is)};
    }
}

/* A goal in one position, with the residuals that it has. */
struct look_slot {
    const struct merit_slot *slot;
    const double *residuals;
};

/* The next slot of rays from `at` on. */
static struct look_slot look_next(const struct merit *merit, const double *residuals, size_t *at)
{
    const struct merit_slot *slot = &merit->slots[*at];
    while ((operand_type(slot->operand->kind)->is & OPERAND_OF_RAYS) == 0) {
        slot++;
    }
    *at = (size_t)(slot - merit->slots) + 1;
    return (struct look_slot){slot, residuals + slot->first};
}

/* Compare it as the merit has it and as more rays and fields do. */
static void look_compare(const struct look_slot *usual, const struct look_slot *close,
                         struct arena *arena, struct closer_look *look)
{
    const struct merit_slot *slot = usual->slot;
    const struct bundle_wish *wish = &slot->beams->bundle.wish;
    const struct bundle_wish *wide = &close->slot->beams->bundle.wish;
    double *seen = ARENA_ARRAY(arena, wish->field_count, double);
    double *is = ARENA_ARRAY(arena, wide->field_count, double), mean = 0;
    merit_rays_squares(slot, usual->residuals, seen);
    merit_rays_squares(close->slot, close->residuals, is);
    for (size_t i = 0; i < wish->field_count; i++) {
        mean += seen[i] / (double)wish->field_count;
    }
    const bool has_middles = wide->field_count > wish->field_count;
    for (size_t i = 0; i < wide->field_count; i++) {
        const struct field_point *point = &wide->fields[i].point;
        if (has_middles && i % 2 == 1) {
            doubt_offer(&look->fields, slot, point, fmax(is[i - 1], is[i + 1]), is[i], mean);
            continue;
        }
        for (size_t k = 0; k < wish->field_count; k++) { /* the same of the merit */
            const double *a = wish->fields[k].point.value, *b = point->value;
            if (a[0] == b[0] && a[1] == b[1]) {
                doubt_offer(&look->rays, slot, point, seen[k], is[i], mean);
                break;
            }
        }
        if (slot->operand->kind == OPERAND_OPD) {
            look->worst_path = fmax(look->worst_path, sqrt(is[i]));
        }
    }
}

void closer_look_at(const struct merit *merit, const struct optimize_state *state,
                    struct arena *arena, struct closer_look *look)
{
    struct merit_question question = merit->question, closer;
    struct look_at usual, close;
    *look = (struct closer_look){.worst_path = 0};
    const bool has_errors = keep_rays(&question, arena);
    if (question.operand_count == 0 || LOOK_RAYS * question.rays > MOST_RAYS ||
        (has_errors &&
         (!look_open(&question, state->numbers, arena, &usual) || !usual.has_value))) {
        return;
    }
    const struct merit *seen = has_errors ? &usual.merit : merit;
    const double *residuals = has_errors ? usual.residuals : state->residuals;
    closer = question;
    closer.rays = LOOK_RAYS * question.rays;
    closer.field_count = fields_between(merit, arena, &closer.fields);
    if (!look_open(&closer, state->numbers, arena, &close)) {
        return;
    }
    size_t from = 0, to = 0;
    while (to < close.merit.slot_count && close.has_value) {
        const struct look_slot one = look_next(seen, residuals, &from);
        const struct look_slot other = look_next(&close.merit, close.residuals, &to);
        look_compare(&one, &other, arena, look);
    }
    if (close.has_value || !close.merit.limit->is_known) {
        return;
    }
    /* rays are lost: of a field between, or between the rays */
    const struct field_point *lost = close.merit.limit->field;
    bool is_between = false;
    for (size_t i = 1; i < closer.field_count; i += 2) {
        const double *at = closer.fields[i].point.value;
        is_between = is_between || (at[0] == lost->value[0] && at[1] == lost->value[1]);
    }
    struct closer_doubt *doubt = is_between ? &look->fields : &look->rays;
    *doubt = (struct closer_doubt){&question.operands[0], *lost, false, 0, INFINITY};
}
