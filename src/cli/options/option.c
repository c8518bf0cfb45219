/* cli/options/option.c - read the values of options. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include "base/choice.h"
#include "cli/options/nominal.h"
#include "data/lines.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *option_called(const struct option *option, struct called *room)
{
    if (option->called != NULL) {
        return option->called;
    }
    snprintf(room->text, sizeof room->text, "--%s", option->name);
    return room->text;
}

bool option_is_named(const struct option *option, struct text name)
{
    const char *known = option->name;
    size_t at = 0;
    if (name.length > 0 && name.start[0] != known[0]) {
        return false; /* as most: every start compares some hundreds of them */
    }
    while (at < name.length && known[at] != '\0' &&
           (name.start[at] == known[at] || (name.start[at] == '_' && known[at] == '-'))) {
        at++;
    }
    return at == name.length && known[at] == '\0';
}

bool option_is_quantity(const struct option *option, struct text quantity)
{
    const char *own = option->quantity != NULL ? option->quantity : option->name;
    size_t i = 0;
    for (; i < quantity.length && own[i] != '\0'; i++) {
        char c = own[i] == '-' && option->quantity == NULL ? ' ' : own[i];
        if (c != quantity.start[i]) {
            return false;
        }
    }
    return i == quantity.length && own[i] == '\0';
}

const struct word *option_word(const struct option *option, size_t i)
{
    if (option->words == NULL) {
        return option->word_at != NULL ? option->word_at(i) : NULL;
    }
    return option->words[i].word != NULL ? &option->words[i] : NULL;
}

static bool option_has_range(const struct option *option)
{
    return option->lowest != 0 || option->highest != 0;
}

const char *option_range(const struct option *option, struct arena *arena)
{
    char low[NUMBER_LENGTH + 1], high[NUMBER_LENGTH + 1];
    if (option->types != NULL) {
        return file_type_endings(option->types, arena);
    }
    if (!option_has_range(option)) {
        return "";
    }
    const struct unit *unit = option_unit(option);
    *quantity_write(low, option->lowest, unit) = '\0';
    *quantity_write(high, option->highest, unit) = '\0';
    const char *blank = unit != NULL && unit->label[0] != '\0' ? " " : "";
    const char *label = unit != NULL ? unit->label : "";
    bool above = (option->flags & OPTION_ABOVE_LOWEST) != 0;
    if (isinf(option->highest)) {
        return arena_printf(arena, "%s%s%s%s%s", above ? "above " : "", low, blank, label,
                            above ? "" : " or more");
    }
    bool below = (option->flags & OPTION_BELOW_HIGHEST) != 0;
    return arena_printf(arena, "%s%s to %s%s%s%s", above ? "above " : "", low,
                        below ? "below " : "", high, blank, label);
}

bool option_check_range(const struct option *option, double value, struct error *error)
{
    if (isinf(value) && (option->flags & OPTION_NO_INFINITY) != 0) {
        return fail(error, ERROR_DOMAIN, "%s cannot be infinite", CALLED(option));
    }
    if (!option_has_range(option)) {
        return true;
    }
    bool above = (option->flags & OPTION_ABOVE_LOWEST) != 0;
    bool below = (option->flags & OPTION_BELOW_HIGHEST) != 0;
    bool low_enough = below ? value < option->highest : value <= option->highest;
    bool high_enough = above ? value > option->lowest : value >= option->lowest;
    if (low_enough && high_enough) {
        return true;
    }
    char number[NUMBER_LENGTH + 1];
    const struct unit *unit = option_unit(option);
    struct arena arena = {0};
    *quantity_write(number, value, unit) = '\0';
    fail(error, ERROR_DOMAIN, "%s %s%s%s is out of range: it must be %s", CALLED(option), number,
         unit != NULL && unit->label[0] != '\0' ? " " : "", unit != NULL ? unit->label : "",
         option_range(option, &arena));
    arena_free(&arena);
    return option->outside != NULL && value < option->lowest &&
           error_hint(error, "%s", option->outside);
}

bool option_recall(const struct reader *reader, const struct option *option, void *member,
                   struct error *error)
{
    return option->kind->recall == NULL || option->kind->recall(reader, member, error);
}

bool option_blame(const struct option *option, struct text text, struct error *error)
{
    const char *what = option->dimension != NULL ? "quantity" : "value";
    if (strstr(error->message, "unit") != NULL) {
        what = "unit";
    }
    int shown = text_shown(text);
    if (option->no_number != NULL && error->hint[0] == '\0') {
        error_hint(error, "%s", option->no_number);
    }
    if (error->caret > 0) {
        return error_prefix(error, "bad %s in %s '%.*s' at character %d: ", what, CALLED(option),
                            shown, text.start, (int)text_column(text, (size_t)error->caret - 1));
    }
    return error_prefix(error, "bad %s in %s '%.*s': ", what, CALLED(option), shown, text.start);
}

bool option_read(const struct reader *reader, const struct option *option, struct text text,
                 void *member, struct error *error)
{
    return option->kind->read(reader, option, text, member, error);
}

void option_clear(const struct option *option, void *member)
{
    const struct option_kind *kind = option->kind;
    double *number = (double *)(void *)((char *)member + kind->nan_at);
    memset(member, 0, kind->size);
    for (size_t i = 0; i < kind->nan_count; i++) {
        number[i] = NAN;
    }
}

const char *option_value_name(const struct option *option, const void *member)
{
    const struct option_kind *kind = option->kind;
    const void *name = (const char *)member + kind->name_at;
    if (kind->name_of != NULL) {
        return kind->name_of(option, member);
    }
    return kind->is_named ? *(const char *const *)name : NULL;
}

void option_doubt(const struct reader *reader, const struct option *option, double value)
{
    const struct unit *unit = option_unit(option);
    if (option->unusual != NULL && !(value >= option->usual[0] && value <= option->usual[1])) {
        warnings_add(reader->doubts, "%s %.6g%s%s: %s", CALLED(option),
                     unit != NULL ? unit_from_own(unit, value) : value,
                     unit != NULL && unit->label[0] != '\0' ? " " : "",
                     unit != NULL ? unit->label : "", option->unusual);
    }
}

/*
 * Read one field and its weight: "10", "14deg", "5mm:2".
 *
 * Result    `weight` receives where the weight stands in the text; its start is null without one
 */
static bool field_item_read(struct text text, struct field_item *item, struct text *weight,
                            struct error *error)
{
    const struct unit *degree = unit_find(&dimension_angle, text_of("deg"));
    struct error ignored;
    *weight = text;
    struct text value = text_cut(weight, ':');
    *item = (struct field_item){NAN, NAN, 1};
    bool is_height = quantity_read(value, &dimension_length, NULL, &item->height, NULL, &ignored);
    bool is_angle = quantity_read(value, &dimension_angle, degree, &item->angle, NULL, error);
    item->height = is_height ? item->height : (double)NAN;
    item->angle = is_angle ? item->angle : (double)NAN;
    return (is_height || is_angle) &&
           (weight->start == NULL ||
            quantity_read(*weight, &dimension_number, NULL, &item->weight, NULL, error));
}

/* Is it a field with a weight, "10:2"? */
static bool field_has_weight(struct text text)
{
    struct field_item item;
    struct text weight;
    struct error ignored;
    return field_item_read(text, &item, &weight, &ignored) && weight.start != NULL;
}

/* Where each field has an answer of its own a weight would be lost without a word. */
static bool field_refuse_weight(const char *option, struct text text, struct error *error)
{
    fail(error, ERROR_USAGE,
         "--%s '%.*s' has a weight, but here each field is answered by itself: nothing is weighted",
         option, text_shown(text), text.start);
    return error_hint(error,
                      "weights are for commands that judge a lens by all its fields at once");
}

static bool is_finite(const struct field_item *item)
{
    return !isinf(item->angle) && !isinf(item->height) && isfinite(item->weight);
}

static bool fields_value_read(const struct reader *reader, const struct option *option,
                              struct text text, void *member, struct error *error)
{
    struct text rest = text, weight;
    struct field_item *items = ARENA_ARRAY(reader->arena, MOST_FIELDS, struct field_item);
    size_t count = 0;
    while (rest.start != NULL) {
        if (count == MOST_FIELDS) {
            return fail(error, ERROR_USAGE, "%s has more than %d fields", CALLED(option),
                        MOST_FIELDS);
        }
        if (!field_item_read(text_cut(&rest, ','), &items[count], &weight, error)) {
            return error_prefix(error, "bad %s: ", CALLED(option));
        }
        if (items[count].weight < 0) {
            return fail(error, ERROR_USAGE, "%s has the weight %.*s: weights are 0 or more",
                        TYPED(option, weight));
        }
        if (!is_finite(&items[count++])) {
            return fail(error, ERROR_USAGE, "%s has a field or weight that is not finite",
                        CALLED(option));
        }
    }
    *(struct fields_value *)member =
        (struct fields_value){arena_string(reader->arena, text.start, text.length), items, count};
    return true;
}

static bool read_quantity(const struct reader *reader, const struct option *option,
                          struct text text, void *member, struct error *error)
{
    double value;
    bool is_line = false;
    bool in_um = option->dimension == &dimension_wavelength_um;
    bool is_light = in_um || option->dimension == &dimension_wavelength;
    const struct number_scale from_nm = {1, in_um ? -3 : -6};
    if (is_light && !lines_find(reader->db, text_trim(text), from_nm, &is_line, &value, error)) {
        return false;
    }
    if (!is_line &&
        !quantity_read(text, option->dimension, option_unit(option), &value, NULL, error)) {
        if (is_light && error->hint[0] == '\0') {
            error_hint(error, "lines are called d F C e g F' C' h i r s t");
        }
        return (option->flags & OPTION_FIELD) != 0 && field_has_weight(text)
                   ? field_refuse_weight(option->name, text, error)
                   : option_blame(option, text, error);
    }
    if (reader->nominal && option_has_series(option) &&
        !nominal_exact(reader->db, option->dimension, value, &value, error)) {
        return option_blame(option, text, error);
    }
    if (!option_check_range(option, value, error)) {
        return false;
    }
    option_doubt(reader, option, value);
    /* a T-stop where an f-number is meant */
    const struct text trimmed = text_trim(text);
    if (option->dimension == &dimension_fnumber && (option->flags & OPTION_T_STOP) == 0 &&
        trimmed.length > 0 && (trimmed.start[0] == 'T' || trimmed.start[0] == 't')) {
        warnings_add(reader->doubts,
                     "%s %.*s is a T-stop, taken as f/%.6g: as if the lens lost no light",
                     TYPED(option, trimmed), value);
    }
    *(double *)member = value;
    return true;
}

static bool read_choice(const struct reader *reader, const struct option *option, struct text text,
                        void *member, struct error *error)
{
    (void)reader;
    const struct text typed = text_trim(text);
    for (size_t i = 0; option_word(option, i) != NULL; i++) {
        if (text_same(typed, option_word(option, i)->word)) {
            *(int *)member = (int)i;
            return true;
        }
    }
    struct choice choice = {.typed = text};
    for (size_t i = 0; option_word(option, i) != NULL; i++) {
        choice_offer(&choice, option_word(option, i)->word);
    }
    choice_refuse(&choice, error);
    if (option->no_number != NULL && error->hint[0] == '\0') {
        error_hint(error, "%s", option->no_number);
    }
    return error_prefix(error, "%s ", CALLED(option));
}

static bool read_flag(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    (void)reader;
    bool yes = text_same(text, "yes") || text_same(text, "true") || text_equal(text, "1");
    bool no = text_same(text, "no") || text_same(text, "false") || text_equal(text, "0");
    if (!yes && !no) {
        return fail(error, ERROR_USAGE, "%s is 'yes' or 'no', not '%.*s'", TYPED(option, text));
    }
    *(bool *)member = yes;
    return true;
}

static bool part_value_read(const struct reader *reader, const struct option *option,
                            struct text text, void *member, struct error *error)
{
    (void)reader;
    return part_parse(text_trim(text), member, error) ||
           error_prefix(error, "%s: ", CALLED(option));
}

static bool read_text(const struct reader *reader, const struct option *option, struct text text,
                      void *member, struct error *error)
{
    if (text.length == 0 && (option->flags & OPTION_EMPTY) == 0) {
        return fail(error, ERROR_USAGE, "%s is empty", CALLED(option));
    }
    const char *kept = arena_string(reader->arena, text.start, text.length);
    if (option->accepts != NULL && !option->accepts(kept, error)) {
        return error_prefix(error, "%s: ", CALLED(option));
    }
    *(const char **)member = kept;
    return true;
}

static bool count_value_read(const struct reader *reader, const struct option *option,
                             struct text text, void *member, struct error *error)
{
    const double most = 1e9; /* where no range is said */
    (void)reader;
    double value;
    if (option->most != NULL && text_equal(text, option->most)) {
        *(long *)member = (long)option->highest;
        return true;
    }
    if (!quantity_read(text, &dimension_number, NULL, &value, NULL, error)) {
        return option_blame(option, text, error);
    }
    if (value != floor(value)) { /* NaN too */
        return fail(error, ERROR_USAGE, "%s '%.*s' is not a whole number", TYPED(option, text));
    }
    if (!option_check_range(option, value, error)) {
        error->code = ERROR_USAGE; /* a count is no physics */
        return false;
    }
    if (!(fabs(value) <= most)) {
        return fail(error, ERROR_USAGE, "%s '%.*s' is out of range: it must be %g to %g",
                    TYPED(option, text), -most, most);
    }
    *(long *)member = (long)value;
    return true;
}

/* The kind of criterion, and where its number stands. */
static enum coc_kind coc_kind_of(struct text text, struct text *number)
{
    *number = text;
    if (text_same(text, "print") || text_same(text, "airy")) {
        *number = text_of("1");
        return text_same(text, "print") ? COC_PRINT : COC_AIRY;
    }
    if (text.length > 2 && (text.start[0] == 'd' || text.start[0] == 'D') && text.start[1] == '/') {
        *number = (struct text){text.start + 2, text.length - 2};
        return COC_DIAGONAL;
    }
    if (text.length > 2 && memcmp(text.start + text.length - 2, "px", 2) == 0) {
        number->length -= 2;
        return COC_PIXELS;
    }
    return COC_LENGTH;
}

static bool read_coc(const struct reader *reader, const struct option *option, struct text text,
                     void *member, struct error *error)
{
    struct text trimmed = text_trim(text), number;
    struct coc coc = {.kind = coc_kind_of(trimmed, &number)};
    bool length = coc.kind == COC_LENGTH;
    if (!quantity_read(number, length ? &dimension_length : &dimension_number,
                       length ? option_unit(option) : NULL, &coc.value, NULL, error)) {
        error_within(error, trimmed, number);
        return option_blame(option, text, error);
    }
    if (!(length ? coc.value >= 0 : coc.value > 0) || isinf(coc.value)) {
        return fail(error, ERROR_DOMAIN,
                    "%s '%.*s' is out of range: it must be a length of 0 mm or more, d/K or Kpx "
                    "with K above 0, airy, or print",
                    TYPED(option, text));
    }
    *(struct coc_value *)member = (struct coc_value){
        coc, length ? COC_GIVEN : arena_string(reader->arena, trimmed.start, trimmed.length),
        reader->fallback || reader->gives_way};
    return true;
}

static const char *coc_name(const struct option *option, const void *member)
{
    (void)option;
    const struct coc_value *coc = member;
    return coc->coc.kind == COC_LENGTH ? NULL : coc->criterion;
}

static const char *coc_words(const struct option *option, const void *member, struct arena *arena)
{
    (void)option;
    char number[NUMBER_LENGTH + 1];
    const double value = ((const struct coc_value *)member)->coc.value;
    *number_write_shortest(number, value) = '\0';
    return isnan(value) ? NULL : arena_printf(arena, "%smm", number);
}

static const char *choice_name(const struct option *option, const void *member)
{
    return option_word(option, (size_t)(*(const int *)member))->word;
}

static void coc_set_number(void *member, double number, const struct unit *unit)
{
    (void)unit;
    *(struct coc_value *)member =
        (struct coc_value){{.kind = COC_LENGTH, .value = number}, COC_GIVEN, false};
}

double option_first_number(const void *member)
{
    return *(const double *)member;
}

static void quantity_set_number(void *member, double number, const struct unit *unit)
{
    (void)unit;
    *(double *)member = number;
}

const struct option_kind kind_quantity = {
    .name = "quantity",
    .size = sizeof(double),
    .is_list = true,
    .read = read_quantity,
    .number_of = option_first_number,
    .set_number = quantity_set_number,
    .nan_count = 1,
};

const struct option_kind kind_choice = {
    .name = "choice",
    .size = sizeof(int),
    .is_list = true,
    .read = read_choice,
    .name_of = choice_name,
};

const struct option_kind kind_flag = {
    .name = "flag",
    .size = sizeof(bool),
    .read = read_flag,
};

const struct option_kind kind_text = {
    .name = "text",
    .size = sizeof(const char *),
    .read = read_text,
    .is_named = true,
};

const struct option_kind kind_count = {
    .name = "count",
    .size = sizeof(long),
    .is_list = true,
    .read = count_value_read,
};

const struct option_kind kind_coc = {
    .name = "coc",
    .size = sizeof(struct coc_value),
    .is_list = true,
    .read = read_coc,
    .name_of = coc_name,
    .words_of = coc_words,
    .set_number = coc_set_number,
    .nan_at = offsetof(struct coc_value, coc.value),
    .nan_count = 1,
};

const struct option_kind kind_part = {
    .name = "part",
    .size = sizeof(struct part),
    .read = part_value_read,
};

const struct option_kind kind_fields = {
    .name = "fields",
    .size = sizeof(struct fields_value),
    .read = fields_value_read,
};
