/* cli/options/goal_figure.c - figures of goals: their names, and where they are. */
/* SPDX-License-Identifier: MIT */
#include "base/quantity.h"
#include "cli/options/goal_parser.h"
#include "data/lines.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

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
static bool goal_read_left(struct goal_parser *reading, struct text left, struct error *error)
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

/* What the kind cannot do without, but for a target. */
static bool goals_check(const struct goal_parser *reading, struct text left, struct error *error)
{
    const struct operand *operand = reading->operand;
    const unsigned is = reading->type->is;
    const char *name = reading->type->name;
    if ((is & OPERAND_NEEDS_FIELD) != 0 && operand->field == NULL) {
        WRONG_AT(reading, left, error, "%s is that of a field", name);
        return error_hint(error, "write %s@10deg", name);
    }
    if ((is & OPERAND_NEEDS_FREQUENCY) != 0 && isnan(operand->frequency)) {
        WRONG_AT(reading, left, error, "%s is that of a spatial frequency", name);
        return error_hint(error, "write %s@40/mm", name);
    }
    return true;
}

bool goal_read_figure(struct goal_parser *reading, struct text text, struct error *error)
{
    return goal_read_left(reading, text, error) && goals_check(reading, text, error);
}
