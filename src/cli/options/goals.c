/* cli/options/goals.c - goals as people write them: of optimize, of fit, in lens files. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/goals.h"

#include "base/quantity.h"
#include "data/lines.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

enum { MOST_GOALS = 1000 };

/* One goal in the making. */
struct goal_parser {
    const struct goals_reader *reader;
    struct text item; /* all of it */
    const struct operand_type *type;
    struct operand *operand;
    bool has_target;
};

/* Point at a part of the goal. */
#define WRONG_AT(reading, part, error, ...)                                                        \
    fail_at((error), ERROR_USAGE, (reading)->item,                                                 \
            (size_t)((part).start - (reading)->item.start) + 1, __VA_ARGS__)

/* The next word; the rest begins behind the blanks after it. */
static struct text goals_next_word(struct text *rest)
{
    size_t length = 0;
    while (length < rest->length && rest->start[length] != ' ' && rest->start[length] != '\t') {
        length++;
    }
    const struct text word = {rest->start, length};
    *rest = text_trim((struct text){rest->start + length, rest->length - length});
    return word;
}

/* All kinds by name, for a hint. */
static bool hint_kinds(struct goal_parser *reading, struct text name, struct error *error)
{
    struct nearest nearest = {.typed = name};
    const char *all = "";
    for (int i = 0; i < OPERAND_KINDS; i++) {
        const char *kind = operand_type((enum operand_kind)i)->name;
        if (kind != NULL) {
            nearest_offer(&nearest, text_of(kind));
        }
        const char *alias = operand_alias((enum operand_kind)i);
        if (alias != NULL) {
            nearest_offer(&nearest, text_of(alias));
        }
        if (i == OPERAND_S1) {
            kind = "S1..S5";
        }
        if (kind != NULL && !(i > OPERAND_S1 && i <= OPERAND_S5)) {
            all = ARENA_JOIN(reading->reader->arena, all, all[0] != '\0' ? " " : "", kind);
        }
    }
    return nearest.best.start != NULL ? error_hint(error, "did you mean '%.*s'?",
                                                   text_shown(nearest.best), nearest.best.start)
                                      : error_hint(error, "goals are of: %s", all);
}

static bool goals_read_kind(struct goal_parser *reading, struct text name, struct error *error)
{
    const enum operand_kind kind = operand_find(name);
    if (kind == OPERAND_KINDS) {
        if (name.length == 0) {
            return WRONG_AT(reading, name, error, "a goal without a name");
        }
        WRONG_AT(reading, name, error, "unknown goal '%.*s'", text_shown(name), name.start);
        return hint_kinds(reading, name, error);
    }
    reading->operand->kind = kind;
    reading->type = operand_type(kind);
    return true;
}

/* -------- where -------- */

/* Has the kind such a thing, and has the goal none as yet? */
static bool may_have(const struct goal_parser *reading, unsigned what, bool is_there,
                     const char *words, struct text place, struct error *error)
{
    if ((reading->type->is & what) == 0) {
        return WRONG_AT(reading, place, error, "%s has no %s", reading->type->name, words);
    }
    return !is_there || WRONG_AT(reading, place, error, "the %s is there twice", words);
}

static bool goal_wavelength(struct goal_parser *reading, double wavelength, struct text place,
                            struct error *error)
{
    struct operand *operand = reading->operand;
    if (!may_have(reading, OPERAND_AT_WAVELENGTH, !isnan(operand->wavelength), "wavelength", place,
                  error)) {
        return false;
    }
    operand->wavelength = wavelength;
    return (wavelength >= WAVELENGTH_SHORTEST && wavelength <= WAVELENGTH_LONGEST) ||
           WRONG_AT(reading, place, error, "the wavelength is not within 1 nm to 100 mm");
}

static bool goal_field(struct goal_parser *reading, enum field_kind kind, double value,
                       struct text place, struct error *error)
{
    struct operand *operand = reading->operand;
    struct setup_field *field = ARENA_NEW(reading->reader->arena, struct setup_field);
    if (!may_have(reading, OPERAND_AT_FIELD, operand->field != NULL, "field", place, error)) {
        return false;
    }
    *field = (struct setup_field){.point = {.kind = kind, .value = {0, value}}, .weight = 1};
    operand->field = field;
    return isfinite(value) || WRONG_AT(reading, place, error, "a field is finite");
}

/* A number with its unit. */
static bool has_unit(struct text place, const struct dimension *dimension, double *value,
                     const struct unit **unit)
{
    struct error ignored;
    *unit = NULL;
    return quantity_read(place, dimension, NULL, value, unit, &ignored) && *unit != NULL;
}

/* A number, with or without a unit. */
static bool goals_read_number(struct goal_parser *reading, struct text place, struct error *error)
{
    const struct unit *unit;
    struct error ignored;
    double value;
    if (has_unit(place, &dimension_frequency, &value, &unit)) {
        struct operand *operand = reading->operand;
        if (!may_have(reading, OPERAND_AT_FREQUENCY, !isnan(operand->frequency),
                      "spatial frequency", place, error)) {
            return false;
        }
        operand->frequency = value;
        return (value > 0 && isfinite(value)) ||
               WRONG_AT(reading, place, error, "a spatial frequency is above 0");
    }
    if (has_unit(place, &dimension_angle, &value, &unit)) {
        return goal_field(reading, FIELD_ANGLE, value, place, error);
    }
    if (has_unit(place, &dimension_length, &value, &unit)) {
        const bool is_short = strcmp(unit->name, "nm") == 0 || strcmp(unit->name, "um") == 0;
        return is_short ? has_unit(place, &dimension_wavelength_um, &value, &unit) &&
                              goal_wavelength(reading, value, place, error)
                        : goal_field(reading, FIELD_HEIGHT, value, place, error);
    }
    if (quantity_read(place, &dimension_number, NULL, &value, NULL, &ignored)) {
        /* a bare number, where it can only be one thing */
        const unsigned is = reading->type->is;
        if ((is & OPERAND_NEEDS_FIELD) != 0 && reading->operand->field == NULL) {
            return goal_field(reading, FIELD_ANGLE,
                              unit_to_own(unit_find(&dimension_angle, text_of("deg")), value),
                              place, error);
        }
        if ((is & OPERAND_AT_WAVELENGTH) != 0 && (is & OPERAND_AT_FIELD) == 0) {
            return goal_wavelength(reading, value / 1000, place, error);
        }
        WRONG_AT(reading, place, error, "'%.*s' has no unit", text_shown(place), place.start);
        return error_hint(error,
                          "fields are 10deg or 5mm, wavelengths F or 550nm, frequencies 40/mm");
    }
    WRONG_AT(reading, place, error, "'%.*s' is no wavelength, field, frequency or position",
             text_shown(place), place.start);
    return error_hint(error, "they are F or 550nm, 10deg or 5mm, 40/mm, or a name that the lens "
                             "has for a position");
}

/* What stands behind an '@'. */
static bool goals_read_place(struct goal_parser *reading, struct text place, struct error *error)
{
    const struct goals_reader *reader = reading->reader;
    const size_t position =
        reader->lens != NULL ? lens_position_find(reader->lens, place) : LENS_NONE;
    bool is_line;
    double wavelength;
    if (place.length == 0) {
        return WRONG_AT(reading, place, error, "nothing stands behind '@'");
    }
    if (!lines_find(reader->db, place, (struct number_scale){1, -3}, &is_line, &wavelength,
                    error)) {
        return false;
    }
    if (position != LENS_NONE && is_line) {
        WRONG_AT(reading, place, error, "'%.*s' is a position of the lens and a spectral line",
                 text_shown(place), place.start);
        return error_hint(error, "%.6gnm is the line", wavelength * 1000);
    }
    if (position != LENS_NONE) {
        if (reading->operand->position != LENS_NONE) {
            return WRONG_AT(reading, place, error, "the position is there twice");
        }
        reading->operand->position = position;
        return true;
    }
    return is_line ? goal_wavelength(reading, wavelength, place, error)
                   : goals_read_number(reading, place, error);
}

/* A number of a surface, from 1; LENS_NONE: it is none. */
static size_t surface_number(struct text text)
{
    size_t number = 0;
    for (size_t i = 0; i < text.length; i++) {
        if (!char_is_digit(text.start[i]) || number > 100000) {
            return LENS_NONE;
        }
        number = 10 * number + (size_t)(text.start[i] - '0');
    }
    return number > 0 ? number - 1 : LENS_NONE;
}

/* "3" or "1..11" */
static bool goals_read_surfaces(struct goal_parser *reading, struct text word, struct error *error)
{
    struct operand *operand = reading->operand;
    struct text last = word, first = text_cut_range(&last);
    if (!may_have(reading, OPERAND_AT_SURFACES, operand->first != LENS_NONE, "surface", word,
                  error)) {
        return false;
    }
    operand->first = surface_number(first);
    operand->last = surface_number(last);
    if (operand->first == LENS_NONE || operand->last == LENS_NONE ||
        operand->first > operand->last) {
        WRONG_AT(reading, word, error, "'%.*s' names no surfaces", text_shown(word), word.start);
        return error_hint(error, "surfaces are 3 or 1..11");
    }
    const size_t count =
        reading->reader->lens != NULL ? reading->reader->lens->surface_count : LENS_NONE;
    return operand->last < count ||
           WRONG_AT(reading, last, error, "there is no surface %zu: the lens has %zu",
                    operand->last + 1, count);
}

static bool goals_read_word(struct goal_parser *reading, struct text word, struct error *error)
{
    const bool tangential = text_same(word, "tangential");
    if (!tangential && !text_same(word, "sagittal")) {
        return char_is_digit(word.start[0]) || (reading->type->is & OPERAND_AT_SURFACES) != 0
                   ? goals_read_surfaces(reading, word, error)
                   : WRONG_AT(reading, word, error, "unknown word '%.*s'", text_shown(word),
                              word.start);
    }
    if (!may_have(reading, OPERAND_HAS_ORIENTATION,
                  reading->operand->orientation != ORIENTATION_BOTH, "orientation", word, error)) {
        return false;
    }
    reading->operand->orientation = tangential ? ORIENTATION_TANGENTIAL : ORIENTATION_SAGITTAL;
    return true;
}

/* Name, places and words: all before the relation. */
static bool read_left(struct goal_parser *reading, struct text left, struct error *error)
{
    bool is_first = true;
    while (left.start != NULL) {
        struct text words = text_trim(text_cut(&left, '@'));
        const struct text head = goals_next_word(&words);
        if (!(is_first ? goals_read_kind(reading, head, error)
                       : goals_read_place(reading, head, error))) {
            return false;
        }
        while (words.length > 0) {
            if (!goals_read_word(reading, goals_next_word(&words), error)) {
                return false;
            }
        }
        is_first = false;
    }
    return true;
}

/* -------- how much -------- */

/* What is missed by so much, in so small deviations, still has a square. */
static const double GOAL_MOST = 1e50;

static bool goals_read_figure(struct goal_parser *reading, struct text text, double *value,
                              struct error *error)
{
    const struct dimension *dimension = reading->type->dimension;
    const struct unit *unit = unit_find(dimension, text_of(reading->type->unit));
    struct error what;
    if (text.length == 0) {
        return WRONG_AT(reading, text, error, "a number is missing");
    }
    if (!quantity_read(text, dimension, unit, value, NULL, &what)) {
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
    *deviation = unit_to_own(unit_find(reading->type->dimension, text_of(reading->type->unit)),
                             reading->reader->deviation);
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

/* What the kind cannot do without. */
static bool goals_check(const struct goal_parser *reading, struct text left, struct error *error)
{
    const struct operand *operand = reading->operand;
    const unsigned is = reading->type->is;
    const char *name = reading->type->name;
    if ((is & OPERAND_NEEDS_TARGET) != 0 && !reading->has_target) {
        WRONG_AT(reading, reading->item, error, "%s has no target", name);
        /* the goal as typed, with a target that its kind usually has */
        static const char *const usual[OPERAND_KINDS] = {
            [OPERAND_INCIDENCE] = "< 45deg", [OPERAND_EDGE] = "> 1mm",
            [OPERAND_CENTER] = "> 1mm",      [OPERAND_AIR] = "> 1mm",
            [OPERAND_TRACK] = "< 100mm",     [OPERAND_SAG] = "< 1mm",
            [OPERAND_SLOPE] = "< 45deg",     [OPERAND_RATIO] = "> 1.2",
            [OPERAND_ASPECT] = "< 10",       [OPERAND_WEIGHT] = "< 100g",
            [OPERAND_COST] = "< 100",        [OPERAND_POWER] = "= 10dpt",
            [OPERAND_GRAZING] = "< 85deg",   [OPERAND_MTF] = "> 0.5",
            [OPERAND_GMTF] = "> 0.5"};
        const char *words = usual[reading->operand->kind];
        return words != NULL
                   ? error_hint(error, "write %.*s %s", text_shown(left), left.start, words)
                   : error_hint(error, "write %.*s = 1%s", text_shown(left), left.start,
                                reading->type->unit);
    }
    if ((is & OPERAND_NEEDS_FIELD) != 0 && operand->field == NULL) {
        WRONG_AT(reading, reading->item, error, "%s is that of a field", name);
        return error_hint(error, "write %s@10deg", name);
    }
    if ((is & OPERAND_NEEDS_FREQUENCY) != 0 && isnan(operand->frequency)) {
        WRONG_AT(reading, reading->item, error, "%s is that of a spatial frequency", name);
        return error_hint(error, "write %s@40/mm", name);
    }
    return true;
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
    if (!read_left(reading, left, error) ||
        (reading->has_target && !goals_read_figure(reading, target, &operand->target, error)) ||
        !read_deviation(reading, deviation, error) || !goals_check(reading, left, error)) {
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
