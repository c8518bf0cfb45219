/* cli/options/goals.c - goals as people write them: of optimize, of fit, in lens files. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/goals.h"

#include "base/quantity.h"
#include "cli/options/goal_parser.h"
#include "design/merit/expression.h"

#include <math.h>
#include <string.h>

enum { MOST_GOALS = 1000 };

/* -------- how much -------- */

/* What is missed by so much, in so small deviations, still has a square. */
static const double GOAL_MOST = 1e50;

static bool goals_read_figure(struct goal_parser *reading, struct text text, double *value,
                              struct error *error)
{
    const struct operand_unit own = operand_unit(reading->operand);
    const struct dimension *dimension = own.dimension;
    const struct unit *unit = unit_find(dimension, text_of(own.unit));
    struct error what;
    if (text.length == 0) {
        return WRONG_AT(reading, text, error, "a number is missing");
    }
    if (!quantity_read(text, dimension, unit, value, NULL, &what)) {
        if (dimension == &dimension_number && own.label[0] != '\0') {
            WRONG_AT(reading, text, error, "what it is compared with is in %s", own.label);
            return error_hint(error, "write a number without a unit, or a product: 2mm*3mm");
        }
        const struct text wrong = {text.start + (what.caret > 0 ? what.caret - 1 : 0), 0};
        WRONG_AT(reading, wrong, error, "%s", what.message);
        return what.hint[0] != '\0' && error_hint(error, "%s", what.hint);
    }
    return fabs(*value) <= GOAL_MOST ||
           WRONG_AT(reading, text, error, "the number must be from %g to %g", -GOAL_MOST,
                    GOAL_MOST);
}

static bool read_deviation(struct goal_parser *reading, struct text text, struct error *error)
{
    double *deviation = &reading->operand->deviation;
    const struct operand_unit own = operand_unit(reading->operand);
    *deviation =
        unit_to_own(unit_find(own.dimension, text_of(own.unit)), reading->reader->deviation);
    if (text.start == NULL) {
        return true;
    }
    return goals_read_figure(reading, text_trim(text), deviation, error) &&
           (*deviation >= 1 / GOAL_MOST ||
            WRONG_AT(reading, text_trim(text), error, "a deviation is above 0, from %g on",
                     1 / GOAL_MOST));
}

/* Cut at the first of = < > ==. */
static struct text cut_relation(struct text item, struct text *left,
                                enum operand_relation *relation)
{
    size_t at = 0;
    while (at < item.length && strchr("=<>", item.start[at]) == NULL) {
        at++;
    }
    *left = (struct text){item.start, at};
    *relation = OPERAND_NEAR;
    if (at == item.length) {
        return (struct text){NULL, 0};
    }
    const bool exact = item.start[at] == '=' && at + 1 < item.length && item.start[at + 1] == '=';
    if (exact) {
        *relation = OPERAND_EXACT;
    } else if (item.start[at] == '<') {
        *relation = OPERAND_BELOW;
    } else if (item.start[at] == '>') {
        *relation = OPERAND_ABOVE;
    } else {
        *relation = OPERAND_NEAR;
    }
    at += exact ? 2 : 1;
    return (struct text){item.start + at, item.length - at};
}

/* The goal as typed, with a target that its kind usually has. */
static bool goals_check_target(const struct goal_parser *reading, struct text left,
                               struct error *error)
{
    static const char *const usual[OPERAND_KINDS] = {
        [OPERAND_INCIDENCE] = "< 45deg", [OPERAND_EDGE] = "> 1mm",    [OPERAND_CENTER] = "> 1mm",
        [OPERAND_AIR] = "> 1mm",         [OPERAND_TRACK] = "< 100mm", [OPERAND_SAG] = "< 1mm",
        [OPERAND_SLOPE] = "< 45deg",     [OPERAND_RATIO] = "> 1.2",   [OPERAND_ASPECT] = "< 10",
        [OPERAND_WEIGHT] = "< 100g",     [OPERAND_COST] = "< 100",    [OPERAND_POWER] = "= 10dpt",
        [OPERAND_GRAZING] = "< 85deg",   [OPERAND_MTF] = "> 0.5",     [OPERAND_GMTF] = "> 0.5"};
    const char *words = usual[reading->operand->kind];
    if ((reading->type->is & OPERAND_NEEDS_TARGET) == 0 || reading->has_target) {
        return true;
    }
    const bool has_name = reading->type->name != NULL;
    WRONG_AT(reading, reading->item, error, "%.*s has no target",
             has_name ? (int)strlen(reading->type->name) : text_shown(left),
             has_name ? reading->type->name : left.start);
    return words != NULL ? error_hint(error, "write %.*s %s", text_shown(left), left.start, words)
                         : error_hint(error, "write %.*s = 1%s", text_shown(left), left.start,
                                      operand_unit(reading->operand).unit);
}

/* -------- arithmetic -------- */

/* The left side: one figure, or arithmetic; or both sides, where figures stand on both. */
static bool goals_read_sides(struct goal_parser *reading, struct text left, struct text right,
                             struct error *error)
{
    struct operand *operand = reading->operand;
    struct goal_sum sum;
    if (right.start == NULL && !goal_is_arithmetic(reading->reader, left)) {
        return goal_read_figure(reading, left, error);
    }
    if (!goal_read_arithmetic(reading, left, right, &sum, error)) {
        return false;
    }
    operand->kind = OPERAND_EXPRESSION;
    operand->expression = sum.expression;
    reading->type = operand_type(OPERAND_EXPRESSION);
    return !sum.is_constant ||
           WRONG_AT(reading, reading->item, error, "no figure of the lens is in it");
}

/* A target that is arithmetic of numbers. */
static bool goals_set_target(struct goal_parser *reading, struct text text,
                             const struct goal_sum *sum, struct error *error)
{
    const struct operand_unit own = operand_unit(reading->operand);
    double *target = &reading->operand->target;
    *target = sum->is_bare ? unit_to_own(unit_find(own.dimension, text_of(own.unit)), sum->number)
                           : sum->number;
    if (!sum->is_bare &&
        (sum->unit.dimension != own.dimension ||
         (own.dimension == &dimension_number && strcmp(sum->unit.label, own.label) != 0))) {
        return WRONG_AT(reading, text, error, "it is in '%s', what it is compared with in '%s'",
                        sum->unit.label, own.label);
    }
    return fabs(*target) <= GOAL_MOST ||
           WRONG_AT(reading, text, error, "the number must be from %g to %g", -GOAL_MOST,
                    GOAL_MOST);
}

/* All but the deviation: its relation is known. */
static bool goals_compare(struct goal_parser *reading, struct text left, struct text right,
                          struct error *error)
{
    static const struct text none = {NULL, 0};
    struct goal_sum sum = {.is_constant = false};
    const bool is_sum = reading->has_target &&
                        (goal_is_arithmetic(reading->reader, right) || goal_names_figure(right));
    if (is_sum && !goal_read_arithmetic(reading, right, none, &sum, error)) {
        return false;
    }
    if (is_sum && !sum.is_constant) { /* left - right, beside 0 */
        return goals_read_sides(reading, left, right, error);
    }
    return goals_read_sides(reading, left, none, error) &&
           (!is_sum || goals_set_target(reading, right, &sum, error)) &&
           (is_sum || !reading->has_target ||
            goals_read_figure(reading, right, &reading->operand->target, error));
}

static bool goals_read_goal(struct goal_parser *reading, struct error *error)
{
    struct operand *operand = reading->operand;
    struct text left, deviation;
    struct text target = cut_relation(reading->item, &left, &operand->relation);
    reading->has_target = target.start != NULL;
    deviation = reading->has_target ? target : left;
    if (reading->has_target) {
        target = text_trim(text_cut(&deviation, ':'));
    } else {
        left = text_cut(&deviation, ':');
    }
    left = text_trim(left);
    if (!goals_compare(reading, left, target, error) ||
        !read_deviation(reading, deviation, error) || !goals_check_target(reading, left, error)) {
        return false;
    }
    /* in one form: what stands before the relation as typed, with the target */
    struct arena *arena = reading->reader->arena;
    const char *where = arena_string(arena, left.start, left.length);
    operand->name =
        reading->has_target
            ? ARENA_JOIN(arena, where, " ", operand_relations[reading->operand->relation], " ",
                         arena_string(arena, target.start, target.length))
            : where;
    return true;
}

/* A list in the making. */
struct goal_list {
    struct operand *list;
    size_t count, room;
};

/* Goals behind those that are there; `wrong` receives the one that fails. */
static bool add_goals(const struct goals_reader *reader, struct text rest, struct goal_list *goals,
                      struct text *wrong, struct error *error)
{
    while (rest.start != NULL) {
        *wrong = text_trim(text_cut(&rest, ','));
        if (goals->count == MOST_GOALS) {
            return fail(error, ERROR_USAGE, "there are more than %d goals", MOST_GOALS);
        }
        goals->list = arena_grow(reader->arena, goals->list, goals->count, &goals->room,
                                 sizeof(struct operand));
        struct operand *operand = &goals->list[goals->count];
        *operand = operand_of(OPERAND_KINDS, NULL);
        struct goal_parser reading = {.reader = reader, .item = *wrong, .operand = operand};
        if (!goals_read_goal(&reading, error)) {
            return false;
        }
        goals->count++;
    }
    return true;
}

bool goals_read(const struct goals_reader *reader, struct text text, struct goals *goals,
                struct error *error)
{
    struct goal_list list = {0};
    struct text wrong;
    bool done = add_goals(reader, text, &list, &wrong, error);
    *goals = (struct goals){list.list, list.count};
    return done || error_prefix(error, "bad goal in {%s}: ", reader->where);
}

bool goals_of_lens(const struct goals_reader *reader, const struct lens *lens, struct goals *goals,
                   struct error *error)
{
    struct goal_list list = {0};
    for (size_t i = 0; i < lens->goal_count; i++) {
        const struct lens_goal *goal = &lens->goals[i];
        const size_t first = list.count;
        struct text wrong;
        if (!add_goals(reader, goal->text, &list, &wrong, error)) {
            const size_t before = (size_t)(wrong.start - goal->text.start);
            const size_t caret = error->caret > 0 ? (size_t)error->caret - 1 : 0;
            error->code = error->code == ERROR_USAGE ? ERROR_DATA : error->code;
            error_prefix(error, "bad goal: ");
            return goal->source != NULL &&
                   error_locate(error, goal->source, goal->line, goal->column + before + caret);
        }
        for (size_t k = first; k < list.count; k++) {
            list.list[k].place = (struct typed_place){goal->source, goal->line, goal->column};
        }
    }
    *goals = (struct goals){list.list, list.count};
    return true;
}
