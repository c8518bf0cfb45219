/* cli/options/goal_expression.c - goals that are arithmetic of figures and numbers of a lens. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/goal_parser.h"

#include "base/quantity.h"
#include "cli/options/vary.h"
#include "design/merit/expression.h"

#include <math.h>
#include <string.h>

enum { DEEPEST = 100 }; /* parentheses, and signs, within each other */

/* -------- words -------- */

static bool char_is_operator(char c)
{
    return c != '\0' && strchr("+-*/()", c) != NULL;
}

static bool char_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static struct text text_from(struct text text, size_t at)
{
    return (struct text){text.start + at, text.length - at};
}

/* What stands before an operator, a blank or '@'. */
static size_t word_length(struct text text)
{
    size_t length = 0;
    while (length < text.length && !char_is_operator(text.start[length]) &&
           !char_is_blank(text.start[length]) && text.start[length] != '@') {
        length++;
    }
    return length;
}

/* A number as it stands at the beginning, with its unit: 2, 1e-3, 5mm, 40/mm. */
static size_t number_length(struct text text)
{
    size_t length = word_length(text);
    /* the sign of an exponent is no operator */
    if (length > 1 && length + 1 < text.length && (text.start[length - 1] | 0x20) == 'e' &&
        (text.start[length] == '-' || text.start[length] == '+') &&
        (char_is_digit(text.start[length - 2]) || text.start[length - 2] == '.') &&
        char_is_digit(text.start[length + 1])) {
        length += 1 + word_length(text_from(text, length + 1));
    }
    if (length < text.length && text.start[length] == '/') {
        const size_t all = length + 1 + word_length(text_from(text, length + 1));
        struct error ignored;
        double value;
        if (quantity_read((struct text){text.start, all}, &dimension_frequency, NULL, &value, NULL,
                          &ignored) ||
            quantity_read((struct text){text.start, all}, &dimension_vergence, NULL, &value, NULL,
                          &ignored)) {
            length = all;
        }
    }
    return length;
}

static bool begins_number(struct text text)
{
    return text.length > 0 &&
           (char_is_digit(text.start[0]) ||
            (text.start[0] == '.' && text.length > 1 && char_is_digit(text.start[1])));
}

/* What stands behind an '@': a position of the lens by its whole name, whatever that has in it. */
static size_t place_length(const struct goals_reader *reader, struct text text)
{
    size_t longest = 0, sign = text.length > 0 && strchr("+-", text.start[0]) != NULL ? 1 : 0;
    for (size_t i = 0; reader->lens != NULL && i < reader->lens->position_count; i++) {
        const size_t length = strlen(reader->lens->positions[i]);
        const struct text behind =
            length <= text.length ? text_from(text, length) : (struct text){"x", 1};
        if (length > longest && length <= text.length && word_length(behind) == 0 &&
            text_same((struct text){text.start, length}, reader->lens->positions[i])) {
            longest = length;
        }
    }
    if (longest > 0) {
        return longest;
    }
    const struct text rest = text_from(text, sign);
    const size_t length = begins_number(rest) ? number_length(rest) : word_length(rest);
    /* what is no number may be meant as one: nan/mm */
    const struct text behind = text_from(rest, length);
    const size_t unit =
        behind.length > 0 && behind.start[0] == '/' ? 1 + word_length(text_from(behind, 1)) : 0;
    const bool has_unit =
        unit > 0 && unit_find(&dimension_frequency, (struct text){behind.start, unit}) != NULL;
    return sign + length + (has_unit ? unit : 0);
}

static size_t blanks(struct text text)
{
    size_t length = 0;
    while (length < text.length && char_is_blank(text.start[length])) {
        length++;
    }
    return length;
}

/* A figure with its places, surfaces and words, up to the next operator. */
static size_t figure_length(const struct goals_reader *reader, struct text text)
{
    size_t at = word_length(text), end = at;
    while (at < text.length && !char_is_operator(text.start[at])) {
        at += blanks(text_from(text, at));
        if (at < text.length && text.start[at] == '@') {
            at++;
            at += blanks(text_from(text, at));
            at += place_length(reader, text_from(text, at));
            end = at;
        } else if (at < text.length && !char_is_operator(text.start[at])) {
            at += word_length(text_from(text, at));
            end = at;
        }
    }
    return end;
}

static size_t variable_word_find(const struct lens *lens, struct text name)
{
    size_t at = 0;
    while (at < lens->variable_count && !text_identical(lens->variables[at].name, name)) {
        at++;
    }
    return at;
}

/* Is the name that of a number of the lens, and of no figure? */
static bool is_number_of_lens(const struct goals_reader *reader, struct text name)
{
    struct parameter what;
    struct error ignored;
    return reader->lens != NULL && operand_find(name) == OPERAND_KINDS &&
           (variable_word_find(reader->lens, name) < reader->lens->variable_count ||
            parameter_read(name, NULL, &what, &ignored));
}

bool goal_names_figure(struct text text)
{
    return operand_find((struct text){text.start, word_length(text)}) != OPERAND_KINDS;
}

bool goal_is_arithmetic(const struct goals_reader *reader, struct text text)
{
    text = text_trim(text);
    if (text.length == 0) {
        return false;
    }
    const bool is_number = begins_number(text);
    const bool is_signed = strchr("+-", text.start[0]) != NULL;
    if (is_signed && begins_number(text_from(text, 1))) {
        return 1 + number_length(text_from(text, 1)) < text.length &&
               goal_is_arithmetic(reader, text_from(text, 1));
    }
    const size_t end = is_number ? number_length(text) : figure_length(reader, text);
    const struct text behind = text_trim(text_from(text, end));
    return (behind.length > 0 && char_is_operator(behind.start[0])) ||
           (!is_number && is_number_of_lens(reader, (struct text){text.start, word_length(text)}));
}

/* -------- what is measured -------- */

/* Powers of mm, rad and g. */
struct measure {
    int length, angle, mass;
};

static bool measure_is_same(struct measure a, struct measure b)
{
    return a.length == b.length && a.angle == b.angle && a.mass == b.mass;
}

static struct measure measure_of(const struct dimension *dimension)
{
    const bool is_inverse = dimension == &dimension_vergence || dimension == &dimension_frequency;
    const int length = dimension == &dimension_length ? 1 : 0;
    return (struct measure){is_inverse ? -1 : length, dimension == &dimension_angle ? 1 : 0,
                            dimension == &dimension_mass ? 1 : 0};
}

static const char *measure_factor(const char *unit, int power, struct arena *arena)
{
    if (power <= 0) {
        return "";
    }
    return power == 1 ? unit : arena_printf(arena, "%s^%d", unit, power);
}

/* In words: "mm^2", "1/mm". */
static const char *measure_words(struct measure measure, struct arena *arena)
{
    const char *const units[] = {"mm", "rad", "g"};
    const int powers[] = {measure.length, measure.angle, measure.mass};
    const char *above = "", *below = "";
    for (size_t i = 0; i < 3; i++) {
        const char *up = measure_factor(units[i], powers[i], arena);
        const char *down = measure_factor(units[i], -powers[i], arena);
        above = ARENA_JOIN(arena, above, *above != '\0' && *up != '\0' ? " " : "", up);
        below = ARENA_JOIN(arena, below, *below != '\0' && *down != '\0' ? " " : "", down);
    }
    above = *above == '\0' && *below != '\0' ? "1" : above;
    return *below == '\0' ? above : ARENA_JOIN(arena, above, "/", below);
}

/* The unit that bare numbers beside it are in. */
static struct operand_unit measure_unit(struct measure measure, struct arena *arena)
{
    static const struct {
        const struct dimension *dimension;
        const char *unit, *label;
    } all[] = {{&dimension_length, "mm", "mm"},
               {&dimension_angle, "deg", "deg"},
               {&dimension_mass, "g", "g"},
               {&dimension_vergence, "per_mm", "1/mm"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (measure_is_same(measure, measure_of(all[i].dimension))) {
            return (struct operand_unit){all[i].dimension, all[i].unit, all[i].label};
        }
    }
    return (struct operand_unit){&dimension_number, "", measure_words(measure, arena)};
}

/* -------- reading -------- */

/* A part of an expression that has been read. */
struct goal_part {
    struct text text;
    size_t first; /* its steps begin there, and go on to the last; of a constant there is one */
    bool is_constant, is_bare;
    struct measure measure;
    struct operand_unit unit;
};

struct goal_arithmetic {
    struct goal_parser *reading;
    struct text rest;
    struct expression_step *steps;
    size_t step_count, step_room;
    struct operand *terms;
    size_t term_count, term_room;
    int depth;
};

static struct arena *goal_arena(const struct goal_arithmetic *all)
{
    return all->reading->reader->arena;
}

static void goal_add_step(struct goal_arithmetic *all, struct expression_step step)
{
    *ARENA_ADD(goal_arena(all), all->steps, all->step_count, all->step_room) = step;
}

static void goal_skip(struct goal_arithmetic *all, size_t length)
{
    all->rest = text_from(all->rest, length);
    all->rest = text_from(all->rest, blanks(all->rest));
}

static bool goal_next_is(const struct goal_arithmetic *all, const char *operators)
{
    return all->rest.length > 0 && strchr(operators, all->rest.start[0]) != NULL;
}

/* 2, 5mm, 3deg, 20dpt. */
static bool goal_read_constant(struct goal_arithmetic *all, struct goal_part *part,
                               struct error *error)
{
    static const struct dimension *const may[] = {&dimension_length, &dimension_angle,
                                                  &dimension_vergence, &dimension_mass};
    const struct text text = {all->rest.start, number_length(all->rest)};
    struct expression_step step = {.operation = EXPRESSION_NUMBER};
    const struct unit *typed = NULL;
    struct error what;
    part->first = all->step_count;
    part->text = text;
    part->is_constant = true;
    for (size_t i = 0; i < sizeof may / sizeof may[0]; i++) {
        if (quantity_read(text, may[i], NULL, &step.number, &typed, &what) && typed != NULL) {
            part->measure = measure_of(may[i]);
            part->unit = measure_unit(part->measure, goal_arena(all));
            goal_add_step(all, step);
            goal_skip(all, text.length);
            return true;
        }
    }
    if (!quantity_read(text, &dimension_number, NULL, &step.number, NULL, &what)) {
        const struct text wrong = text_from(text, what.caret > 0 ? (size_t)what.caret - 1 : 0);
        return WRONG_AT(all->reading, wrong, error, "%s", what.message);
    }
    part->is_bare = true;
    part->unit = measure_unit(part->measure, goal_arena(all));
    goal_add_step(all, step);
    goal_skip(all, text.length);
    return isfinite(step.number) ||
           WRONG_AT(all->reading, text, error, "a number in a goal is finite");
}

/* t2, c1@tele, gap: a number of the lens. */
static bool goal_read_number_of_lens(struct goal_arithmetic *all, struct text text,
                                     struct operand *term, struct measure *measure,
                                     struct error *error)
{
    const struct lens *lens = all->reading->reader->lens;
    struct arena *arena = goal_arena(all);
    struct text place = text, name = text_trim(text_cut(&place, '@'));
    const size_t word = variable_word_find(lens, name);
    struct error what;
    term->kind = OPERAND_NUMBER;
    if (word < lens->variable_count) {
        if (!vary_find_cell(lens, word, &term->parameter)) {
            return WRONG_AT(all->reading, name, error,
                            "'%.*s' stands for no thickness and no focal length", text_shown(name),
                            name.start);
        }
    } else if (!parameter_read(name, NULL, &term->parameter, &what)) {
        return WRONG_AT(all->reading, name, error, "%s", what.message);
    }
    if (place.start != NULL) {
        place = text_trim(place);
        term->position = lens_position_find(lens, place);
        if (term->position == LENS_NONE) {
            return WRONG_AT(all->reading, place, error,
                            "'%.*s' is no position of the lens: a number has no other place",
                            text_shown(place), place.start);
        }
    }
    const struct lens *here =
        lens_at_position(lens, term->position != LENS_NONE ? term->position : 0, arena);
    const enum parameter_kind kind = term->parameter.kind;
    if (kind == PARAMETER_GLASS) {
        return WRONG_AT(all->reading, name, error, "a glass is no number");
    }
    if (!parameter_check(here, term->parameter, &what)) {
        return WRONG_AT(all->reading, name, error, "%s", what.message);
    }
    measure->length = parameter_length(kind, term->parameter.order);
    measure->angle = (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0 ? 1 : 0;
    return true;
}

/* efl, bfl@F, edge 3, t2@tele. */
static bool goal_read_term(struct goal_arithmetic *all, struct goal_part *part, struct error *error)
{
    const struct goals_reader *reader = all->reading->reader;
    struct arena *arena = goal_arena(all);
    const struct text text = {all->rest.start, figure_length(reader, all->rest)};
    struct operand term = operand_of(OPERAND_KINDS, arena_string(arena, text.start, text.length));
    struct goal_parser reading = {.reader = reader, .item = all->reading->item, .operand = &term};
    term.is_term = true;
    part->text = text;
    part->first = all->step_count;
    if (is_number_of_lens(reader, (struct text){text.start, word_length(text)})) {
        if (!goal_read_number_of_lens(all, text, &term, &part->measure, error)) {
            return false;
        }
        part->unit = measure_unit(part->measure, arena);
    } else {
        if (!goal_read_figure(&reading, text, error)) {
            return false;
        }
        if ((reading.type->is & OPERAND_OF_RAYS) != 0 || term.kind == OPERAND_GRAZING) {
            return WRONG_AT(all->reading, text, error,
                            "%s is a sum over rays and has no value to reckon with",
                            reading.type->name);
        }
        part->unit = operand_unit(&term);
        part->measure = measure_of(reading.type->dimension);
    }
    goal_add_step(all, (struct expression_step){EXPRESSION_TERM, 0, all->term_count});
    *ARENA_ADD(arena, all->terms, all->term_count, all->term_room) = term;
    goal_skip(all, text.length);
    return true;
}

static bool goal_read_sum(struct goal_arithmetic *all, struct goal_part *part, struct error *error);

/* A sign, parentheses, a number or a figure. */
static bool goal_read_factor(struct goal_arithmetic *all, struct goal_part *part,
                             struct error *error)
{
    const struct text here = all->rest;
    *part = (struct goal_part){.text = here};
    if (++all->depth > DEEPEST) {
        return WRONG_AT(all->reading, here, error, "more than %d parentheses within each other",
                        DEEPEST);
    }
    if (here.length == 0 || goal_next_is(all, "*/)")) {
        return WRONG_AT(all->reading, here, error, "a figure or a number is missing");
    }
    if (goal_next_is(all, "+-")) {
        const bool is_negative = goal_next_is(all, "-");
        goal_skip(all, 1);
        if (!goal_read_factor(all, part, error)) {
            return false;
        }
        if (is_negative && part->is_constant) {
            all->steps[part->first].number *= -1;
        } else if (is_negative) {
            goal_add_step(all, (struct expression_step){.operation = EXPRESSION_NEGATE});
        }
    } else if (goal_next_is(all, "(")) {
        goal_skip(all, 1);
        if (!goal_read_sum(all, part, error)) {
            return false;
        }
        if (!goal_next_is(all, ")")) {
            return WRONG_AT(all->reading, here, error, "no ')' ends this");
        }
        goal_skip(all, 1);
    } else if (!(begins_number(here) ? goal_read_constant(all, part, error)
                                     : goal_read_term(all, part, error))) {
        return false;
    }
    part->text = text_trim(text_between(here.start, all->rest.start));
    all->depth--;
    return true;
}

/* Two constants become one. */
static void goal_fold(struct goal_arithmetic *all, struct goal_part *left,
                      const struct goal_part *right, enum expression_operation operation)
{
    double *a = &all->steps[left->first].number;
    const double b = all->steps[right->first].number;
    const double results[] = {[EXPRESSION_ADD] = *a + b,
                              [EXPRESSION_SUBTRACT] = *a - b,
                              [EXPRESSION_MULTIPLY] = *a * b,
                              [EXPRESSION_DIVIDE] = *a / b};
    *a = results[operation];
    all->step_count = left->first + 1;
    left->is_bare = left->is_bare && right->is_bare;
}

/* A constant without a unit takes that of the other part. */
static void goal_take_unit(struct goal_arithmetic *all, struct goal_part *part,
                           const struct goal_part *other)
{
    if (part->is_bare && !other->is_bare) {
        double *number = &all->steps[part->first].number;
        const struct unit *unit = unit_find(other->unit.dimension, text_of(other->unit.unit));
        *number = unit_to_own(unit, *number);
        part->measure = other->measure;
        part->unit = other->unit;
        part->is_bare = false;
    }
}

/* Put left OP right in the place of left. */
static bool goal_combine(struct goal_arithmetic *all, struct goal_part *left,
                         struct goal_part *right, char sign, struct error *error)
{
    static const char signs[] = {'+', '-', '*', '/'};
    const enum expression_operation operation =
        EXPRESSION_ADD + (enum expression_operation)((const char *)memchr(signs, sign, 4) - signs);
    struct arena *arena = goal_arena(all);
    if (operation <= EXPRESSION_SUBTRACT) {
        goal_take_unit(all, left, right);
        goal_take_unit(all, right, left);
        if (!measure_is_same(left->measure, right->measure)) {
            const char *a = measure_unit(left->measure, arena).label;
            const char *b = measure_unit(right->measure, arena).label;
            return WRONG_AT(all->reading, right->text, error,
                            "%.*s is %s%s and %.*s is %s%s: they have no %s",
                            text_shown(left->text), left->text.start, *a != '\0' ? "in " : "",
                            *a != '\0' ? a : "a number", text_shown(right->text), right->text.start,
                            *b != '\0' ? "in " : "", *b != '\0' ? b : "a number",
                            sign == '+' ? "sum" : "difference");
        }
    } else {
        const int way = operation == EXPRESSION_MULTIPLY ? 1 : -1;
        const bool keeps = measure_is_same(right->measure, (struct measure){0, 0, 0});
        left->measure.length += way * right->measure.length;
        left->measure.angle += way * right->measure.angle;
        left->measure.mass += way * right->measure.mass;
        if (measure_is_same(left->measure, right->measure) && !keeps) {
            left->unit = right->unit; /* a plain number times it */
        } else if (!keeps) {
            left->unit = measure_unit(left->measure, arena);
        }
    }
    if (left->is_constant && right->is_constant) {
        goal_fold(all, left, right, operation);
    } else {
        goal_add_step(all, (struct expression_step){.operation = operation});
        left->is_constant = left->is_bare = false;
    }
    left->text = text_between(left->text.start, right->text.start + right->text.length);
    return true;
}

static bool goal_read_product(struct goal_arithmetic *all, struct goal_part *part,
                              struct error *error)
{
    if (!goal_read_factor(all, part, error)) {
        return false;
    }
    while (goal_next_is(all, "*/")) {
        const char sign = all->rest.start[0];
        struct goal_part right;
        goal_skip(all, 1);
        if (!goal_read_factor(all, &right, error) ||
            !goal_combine(all, part, &right, sign, error)) {
            return false;
        }
    }
    return true;
}

static bool goal_read_sum(struct goal_arithmetic *all, struct goal_part *part, struct error *error)
{
    if (!goal_read_product(all, part, error)) {
        return false;
    }
    while (goal_next_is(all, "+-")) {
        const char sign = all->rest.start[0];
        struct goal_part right;
        goal_skip(all, 1);
        if (!goal_read_product(all, &right, error) ||
            !goal_combine(all, part, &right, sign, error)) {
            return false;
        }
    }
    return true;
}

static bool goal_read_side(struct goal_arithmetic *all, struct text text, struct goal_part *part,
                           struct error *error)
{
    all->rest = text_trim(text);
    all->depth = 0;
    if (!goal_read_sum(all, part, error)) {
        return false;
    }
    if (goal_next_is(all, ")")) {
        return WRONG_AT(all->reading, all->rest, error, "no '(' begins what ends here");
    }
    return all->rest.length == 0 ||
           WRONG_AT(all->reading, all->rest, error, "unexpected text: '%.*s'",
                    text_shown(all->rest), all->rest.start);
}

bool goal_read_arithmetic(struct goal_parser *reading, struct text left, struct text right,
                          struct goal_sum *sum, struct error *error)
{
    struct goal_arithmetic all = {.reading = reading};
    struct arena *arena = reading->reader->arena;
    struct goal_part part, other;
    if (!goal_read_side(&all, left, &part, error) ||
        (right.start != NULL && (!goal_read_side(&all, right, &other, error) ||
                                 !goal_combine(&all, &part, &other, '-', error)))) {
        return false;
    }
    *sum = (struct goal_sum){.is_constant = part.is_constant,
                             .is_bare = part.is_bare,
                             .number = part.is_constant ? all.steps[0].number : NAN,
                             .unit = part.unit};
    if (!part.is_constant) {
        sum->expression = ARENA_NEW(arena, struct expression);
        *sum->expression = (struct expression){.terms = all.terms,
                                               .term_count = all.term_count,
                                               .steps = all.steps,
                                               .step_count = all.step_count,
                                               .depth = expression_depth(all.steps, all.step_count),
                                               .unit = part.unit};
    }
    return true;
}
