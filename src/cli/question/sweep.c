/* cli/question/sweep.c - lists and ranges of options, and their Cartesian product. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/sweep.h"

#include "cli/question/comma.h"

#include "cli/options/nominal.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_WITHOUT_FORCE = 1000000, MOST = 100000000 };

/* The values of one option while they are collected. */
struct sweep_values {
    const struct reader *reader;
    const struct option *option;
    bool force;
    char *data;
    size_t count, capacity;
    const struct unit *unit;
    bool has_unit;             /* is it that of an item? */
    const struct unit *shared; /* that bare items take from the last one; null = the option's */
};

static bool too_many(const struct option *option, struct error *error)
{
    fail(error, ERROR_USAGE, "%s sweeps over more than a million values", CALLED(option));
    return error_hint(error, "use --force to allow it (up to 100 million)");
}

static bool reserve(struct sweep_values *values, size_t more, struct error *error)
{
    size_t needed = values->count + more;
    if (needed > MOST || (needed > MOST_WITHOUT_FORCE && !values->force)) {
        return too_many(values->option, error);
    }
    if (needed > values->capacity) {
        size_t size = values->option->kind->size;
        size_t capacity = needed > 2 * values->capacity ? needed : 2 * values->capacity;
        char *data = arena_array(values->reader->arena, capacity, size);
        if (values->count > 0) {
            memcpy(data, values->data, values->count * size);
        }
        values->data = data;
        values->capacity = capacity;
    }
    return true;
}

/* A range: first..last, then :step, *factor, #count or /series. */
struct sweep_range {
    struct text text, first, last, tail;
    char kind; /* ':' '*' '#' '/' or 0 */
    double from, to;
    const struct unit *unit; /* that was typed at an end, else the option's */
};

static bool add_number(struct sweep_values *values, const struct sweep_range *range, double number,
                       struct error *error)
{
    const struct option_kind *kind = values->option->kind;
    if (kind->set_number == NULL) {
        /* what is more than a number, as if it had been typed: 700 nm, not 700.0000000000001 */
        char text[NUMBER_LENGTH];
        const struct unit *unit = option_unit(values->option);
        const struct text typed =
            text_between(text, number_write_digits(text, unit_from_own(unit, number), 13));
        size_t size = values->option->kind->size;
        return reserve(values, 1, error) &&
               option_read(values->reader, values->option, typed,
                           values->data + values->count++ * size, error);
    }
    const struct unit *unit = range->unit;
    if (unit != NULL && !unit_is_own(unit)) {
        /* what would have been typed: 65 deg */
        double most = fmax(fabs(range->from), fabs(range->to)), own;
        double slack = 8 * DBL_EPSILON * unit_from_own(unit, most);
        number = unit_decimal_to_own(unit, unit_from_own(unit, number), slack, &own) ? own : number;
    }
    if (!option_check_range(values->option, number, error) || !reserve(values, 1, error)) {
        return false;
    }
    option_doubt(values->reader, values->option, number);
    kind->set_number(values->data + values->count++ * kind->size, number, unit);
    return true;
}

static bool range_fail(const struct sweep_values *values, const struct sweep_range *range,
                       const char *what, struct error *error)
{
    return fail(error, ERROR_USAGE, "bad range in %s '%.*s': %s",
                TYPED(values->option, range->text), what);
}

static bool sweep_is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* Is a ratio written with its colon, as 1:8? */
static bool has_colon(const struct option *option, struct text text)
{
    return option->dimension != NULL && option->dimension->ratio &&
           memchr(text.start, ':', text.length) != NULL;
}

/* Does a tail begin here: a step, a factor, a count or a series? */
static bool begins_tail(struct text text, size_t i)
{
    char c = text.start[i];
    /* the '/' of f/22 follows a letter, that of a series a digit */
    bool series = c == '/' && i > 0 && i + 1 < text.length && sweep_is_letter(text.start[i + 1]) &&
                  !sweep_is_letter(text.start[i - 1]);
    return c == ':' || c == '*' || c == '#' || series;
}

/* Cut "first..last:tail" apart; false if there is no "..". */
static bool split_range(const struct option *option, struct text text, struct sweep_range *range)
{
    size_t at = 0;
    while (at + 1 < text.length && !(text.start[at] == '.' && text.start[at + 1] == '.')) {
        at++;
    }
    if (at + 1 >= text.length) {
        return false;
    }
    *range = (struct sweep_range){.text = text, .first = {text.start, at}};
    struct text last = {text.start + at + 2, text.length - at - 2};
    /* the ratios of 1:8..1:1 and the f-numbers of 1:2.8..1:8, whose colons are no steps */
    bool colon = has_colon(option, range->first) ||
                 (option->dimension == &dimension_fnumber &&
                  memchr(range->first.start, ':', range->first.length) != NULL);
    for (size_t i = 0; i < last.length && range->kind == 0; i++) {
        char c = last.start[i];
        if (c == ':' && colon) {
            colon = false;
        } else if (begins_tail(last, i)) {
            range->kind = c;
            range->tail = (struct text){last.start + i + 1, last.length - i - 1};
            last.length = i;
        }
    }
    range->last = last;
    return true;
}

/* Say which option's range was wrong, before what was wrong with one of its numbers. */
static bool sweep_blame(const struct sweep_values *values, struct text whole, struct text part,
                        struct error *error)
{
    error_within(error, whole, part);
    const size_t at =
        error->caret > 0 ? (size_t)error->caret - 1 : (size_t)(part.start - whole.start);
    return error_prefix(error, "bad range in %s '%.*s' at character %zu: ", CALLED(values->option),
                        text_shown(whole), whole.start, text_column(whole, at));
}

static bool sweep_read_number(const struct sweep_values *values, struct text whole,
                              struct text text, const struct unit *unit, double *number,
                              const struct unit **typed, struct error *error)
{
    return quantity_read(text, values->option->dimension, unit, number, typed, error) ||
           sweep_blame(values, whole, text, error);
}

/* Both ends; a bare end takes the unit of the other one. */
static bool read_ends(const struct sweep_values *values, struct sweep_range *range,
                      struct error *error)
{
    if (range->last.length > 0 && range->last.start[0] == '.') {
        return range_fail(values, range, "three dots: a range has two; write 0.5 with its zero",
                          error);
    }
    const struct unit *usual = option_unit(values->option), *left, *right;
    if (!sweep_read_number(values, range->text, range->first, usual, &range->from, &left, error) ||
        !sweep_read_number(values, range->text, range->last, usual, &range->to, &right, error)) {
        return false;
    }
    if (right != NULL) {
        range->unit = right;
    } else if (left != NULL) {
        range->unit = left;
    } else {
        range->unit = usual;
    }
    if (left != NULL && unit_is_equivalent(left) != unit_is_equivalent(range->unit)) {
        return range_fail(values, range, "one end is an equivalent focal length, the other is none",
                          error);
    }
    if (left == NULL && !sweep_read_number(values, range->text, range->first, range->unit,
                                           &range->from, NULL, error)) {
        return false;
    }
    if (right == NULL && !sweep_read_number(values, range->text, range->last, range->unit,
                                            &range->to, NULL, error)) {
        return false;
    }
    if (isinf(range->from) || isinf(range->to)) {
        return range_fail(values, range, "a range cannot reach infinity", error);
    }
    return true;
}

static bool add_steps(struct sweep_values *values, const struct sweep_range *range,
                      struct error *error)
{
    double step = unit_to_own(range->unit, 1);
    if (range->kind == ':' &&
        !sweep_read_number(values, range->text, range->tail, range->unit, &step, NULL, error)) {
        return false;
    }
    double span = range->to - range->from;
    if (range->kind == 0 && span < 0) {
        step = -step;
    }
    if (!(step != 0) || isinf(step) || span * step < 0) {
        return range_fail(values, range, "with this step it never ends", error);
    }
    double steps = floor(span / step + 1e-9);
    if (range->kind == 0 && steps < 1 && span / step > 1e-9) { /* who types a step means it */
        range_fail(values, range, "the usual step of 1 leads beyond its end", error);
        return error_hint(error, "give a step, as in 1..2:0.1, or a count, as in 1..2#11");
    }
    if (!(steps < MOST)) {
        return too_many(values->option, error);
    }
    if (!reserve(values, (size_t)steps + 1, error)) {
        return false;
    }
    for (size_t i = 0; i <= (size_t)steps; i++) {
        if (!add_number(values, range, range->from + (double)i * step, error)) {
            return false;
        }
    }
    return true;
}

static bool add_factors(struct sweep_values *values, const struct sweep_range *range,
                        struct error *error)
{
    double factor;
    if (!quantity_read(range->tail, &dimension_number, NULL, &factor, NULL, error)) {
        return sweep_blame(values, range->text, range->tail, error);
    }
    double ratio = range->to / range->from;
    if (!(range->from > 0 && range->to > 0)) {
        return range_fail(values, range, "a range by factors has ends above 0", error);
    }
    if (!(factor > 0) || factor == 1 || isinf(factor) || log(ratio) * log(factor) < 0) {
        return range_fail(values, range, "with this factor it never ends", error);
    }
    double steps = floor(log(ratio) / log(factor) + 1e-9);
    if (!(steps < MOST)) {
        return too_many(values->option, error);
    }
    for (size_t i = 0; i <= (size_t)steps; i++) {
        double value = range->from * pow(factor, (double)i);
        if (fabs(value - range->to) <= 1e-9 * range->to) {
            value = range->to; /* the end as it was typed */
        }
        if (!add_number(values, range, value, error)) {
            return false;
        }
    }
    return true;
}

static bool sweep_add_points(struct sweep_values *values, const struct sweep_range *range,
                             struct error *error)
{
    double count;
    if (!quantity_read(range->tail, &dimension_number, NULL, &count, NULL, error)) {
        return sweep_blame(values, range->text, range->tail, error);
    }
    if (!(count >= 2) || count != floor(count)) {
        return range_fail(values, range, "'#' needs a whole number of points, 2 or more", error);
    }
    if (!(count < MOST)) {
        return too_many(values->option, error);
    }
    size_t last = (size_t)count - 1;
    for (size_t i = 0; i <= last; i++) {
        double at = i == last
                        ? range->to
                        : range->from + (double)i * ((range->to - range->from) / (double)last);
        if (!add_number(values, range, at, error)) {
            return false;
        }
    }
    return true;
}

/* Between two labels of a stop series; *added is false where the ends are no labels. */
static bool sweep_add_series(struct sweep_values *values, const struct sweep_range *range,
                             bool *added, struct error *error)
{
    const char *name = NULL;
    double *stops;
    size_t count;
    *added = false;
    if (range->kind == '/') {
        name = arena_string(values->reader->arena, range->tail.start, range->tail.length);
    }
    if (!option_has_series(values->option)) {
        return name == NULL || range_fail(values, range, "it has no stop series", error);
    }
    const struct reader *reader = values->reader;
    if (!nominal_between(reader->db, values->option->dimension, name,
                         (const double[]){range->from, range->to}, reader->nominal, &stops, &count,
                         error)) {
        return range->kind == '/' && sweep_blame(values, range->text, range->tail, error);
    }
    for (size_t i = 0; i < count; i++) {
        if (!add_number(values, range, stops[i], error)) {
            return false;
        }
    }
    *added = count > 0;
    return true;
}

/* Is an end written as a fraction of what is halved and doubled: a power of 1/16, a time? */
static bool sweep_is_fraction(const struct sweep_values *values, const struct sweep_range *range)
{
    const struct dimension *dimension = values->option->dimension;
    bool doubles = dimension->ratio || dimension == &dimension_time;
    return doubles &&
           (memchr(range->first.start, '/', range->first.length) != NULL ||
            memchr(range->last.start, '/', range->last.length) != NULL ||
            has_colon(values->option, range->first) || has_colon(values->option, range->last));
}

static bool sweep_add_range(struct sweep_values *values, struct sweep_range *range,
                            struct error *error)
{
    bool added = false;
    if (!read_ends(values, range, error)) {
        return false;
    }
    if (values->option->kind->number_of != NULL) {
        values->unit = range->unit;
    }
    if (range->kind == '*') {
        return add_factors(values, range, error);
    }
    if (range->kind == '#') {
        return sweep_add_points(values, range, error);
    }
    if (range->kind != ':' && !sweep_add_series(values, range, &added, error)) {
        return false;
    }
    if (!added && range->kind == 0 && sweep_is_fraction(values, range)) {
        /* fractions run in stops: 1/16, 1/8, 1/4, 1/2, 1 */
        double stops = log2(range->to / range->from), whole = rint(stops);
        if (!(range->from > 0 && range->to > 0)) {
            return range_fail(values, range, "a range of fractions has ends above 0", error);
        }
        if (!(fabs(stops - whole) <= 1e-9)) {
            range_fail(values, range,
                       "fractions step in stops, and these are not whole stops apart", error);
            return error_hint(error,
                              "add a step: :0.1 adds, *2 multiplies, #5 sets the number of points");
        }
        for (double i = 0; i <= fabs(whole); i++) {
            double value = i == fabs(whole) ? range->to : range->from * exp2(copysign(i, whole));
            if (!add_number(values, range, value, error)) {
                return false;
            }
        }
        return true;
    }
    return added || add_steps(values, range, error);
}

/* The unit in which a list is printed again: the one all its items were typed in. */
static void note_unit(struct sweep_values *values, struct text item)
{
    const struct option *option = values->option;
    const struct unit *typed = NULL;
    struct error ignored;
    double value;
    if (option->kind->number_of == NULL ||
        !quantity_read(item, option->dimension, option_unit(option), &value, &typed, &ignored) ||
        (isinf(value) && typed == NULL)) {
        return; /* infinity is the same in all units */
    }
    typed = typed != NULL ? typed : values->shared;
    bool same = !values->has_unit || values->unit == typed;
    values->unit = typed != NULL && same ? typed : option_unit(option);
    values->has_unit = true;
}

static bool add_item(struct sweep_values *values, struct text item, struct error *error)
{
    struct sweep_range range;
    const bool has_ranges =
        values->option->kind->number_of != NULL || values->option->kind == &kind_coc;
    if (has_ranges && split_range(values->option, item, &range)) {
        return sweep_add_range(values, &range, error);
    }
    if (!reserve(values, 1, error)) {
        return false;
    }
    char *member = values->data + values->count * values->option->kind->size;
    struct option option = *values->option;
    option.unit = values->shared != NULL ? values->shared->name : option.unit;
    option_clear(&option, member);
    if (!option_read(values->reader, &option, item, member, error)) {
        return false;
    }
    values->count++;
    note_unit(values, item);
    return true;
}

/*
 * The unit that stands behind a list and is meant for all of it: 1,2,3ft are feet, as 1..3ft are.
 * Null where the last item has none, or any other item has one of its own.
 */
static const struct unit *shared_unit(const struct option *option, struct text text)
{
    const struct unit *last = NULL, *unit = NULL;
    struct text rest = text;
    bool light =
        option->dimension == &dimension_wavelength || option->dimension == &dimension_wavelength_um;
    if (option->kind->number_of == NULL || light) {
        return NULL;
    }
    while (rest.start != NULL) {
        struct text item = text_trim(text_cut(&rest, ','));
        struct error ignored;
        double value;
        if (!quantity_read(item, option->dimension, option_unit(option), &value, &unit, &ignored) ||
            isinf(value) || (unit != NULL && rest.start != NULL)) {
            return NULL;
        }
        last = unit;
    }
    return last;
}

/* One value is stored, several make an axis. */
static bool set_values(struct sweep *sweep, struct sweep_values *values, struct text text,
                       void *member, struct error *error)
{
    struct text rest = text;
    values->unit = option_unit(values->option);
    bool many = (values->option->flags & OPTION_MANY) != 0;
    const char separator = many ? OPTION_MANY_SEPARATOR : ',';
    const bool is_one = !values->option->kind->is_list && !many;
    values->shared = is_one ? NULL : shared_unit(values->option, text);
    if (!comma_check(values->reader, values->option, text, error)) {
        return false;
    }
    do {
        struct text item = is_one ? text : text_trim(text_cut(&rest, separator));
        if (item.length == 0 && !is_one) {
            return fail(error, ERROR_USAGE, "%s '%.*s' has an empty item", CALLED(values->option),
                        text_shown(text), text.start);
        }
        if (!add_item(values, item, error)) {
            return false;
        }
    } while (rest.start != NULL && !is_one);
    memcpy(member, values->data, values->option->kind->size);
    if (values->option->kind == &kind_focal &&
        !focal_check_alike((const void *)values->data, values->count, values->option, error)) {
        return false;
    }
    if (values->count > 1) {
        sweep->axes[sweep->axis_count++] =
            (struct axis){values->option, values->data, values->count, values->unit};
    }
    return option_recall(values->reader, values->option, member, error);
}

/* An option's value, as given or as it is without that. */
static bool set_option(struct sweep *sweep, const struct argument *argument,
                       const struct reader *reader, bool force, void *member, struct error *error)
{
    const struct option *option = argument->option;
    if (argument->called != NULL) {
        struct option *typed = ARENA_ARRAY(reader->arena, 1, struct option);
        *typed = *option;
        typed->called = argument->called;
        option = typed;
    }
    struct reader plain = {.db = reader->db, .arena = reader->arena, .fallback = true};
    struct sweep_values values = {.reader = reader, .option = option, .force = force};
    option_clear(option, member);
    if (argument->is_given && option->kind == &kind_flag) {
        *(bool *)member = true;
        return true;
    }
    if (argument->is_given) {
        struct reader own = *reader;
        own.gives_way = argument_rank(argument) < RANK_KIT;
        values.reader = &own;
        return set_values(sweep, &values, argument->text, member, error);
    }
    /* what the program assumes by itself is not a label of the user's */
    values.reader = &plain;
    return option->fallback == NULL ||
           set_values(sweep, &values, text_of(option->fallback), member, error);
}

/*
 * What all answers weigh together. Lenses count as the first of them: the others may be no more
 * than names.
 */
static double sweep_weight_of(const struct sweep *sweep, const struct command *command,
                              const void *input)
{
    struct arena *arena = sweep->reader->arena;
    struct sweep light = {.total = 1, .axes = ARENA_ARRAY(arena, sweep->axis_count, struct axis)};
    void *each = arena_array(arena, 1, command->input_size);
    double sum = 0;
    memcpy(each, input, command->input_size);
    for (size_t i = 0; i < sweep->axis_count; i++) {
        if (sweep->axes[i].option->kind != &kind_lens) {
            light.axes[light.axis_count++] = sweep->axes[i];
            light.total *= sweep->axes[i].count;
        }
    }
    for (size_t i = 0; i < light.total; i++) {
        sweep_set(&light, i, each);
        sum += command->weight(each);
    }
    return sum * (double)(sweep->total / light.total);
}

/* Is the sweep no more work than anyone waits for? */
static bool sweep_check_size(struct sweep *sweep, const struct command *command, bool force,
                             const void *input, struct error *error)
{
    size_t most = command->most_answers > 0 ? command->most_answers : MOST_WITHOUT_FORCE;
    most = force ? MOST : most;
    for (size_t i = 0; i < sweep->axis_count; i++) {
        sweep->total *= sweep->axes[i].count;
        if (sweep->total > most) {
            fail(error, ERROR_USAGE, "the sweep has more than %zu rows", most);
            return error_hint(error, force ? "no sweep has more"
                                           : "use --force to allow it (up to 100 million)");
        }
    }
    if (force || sweep->total == 1 || command->weight == NULL) {
        return true;
    }
    const double weight = sweep_weight_of(sweep, command, input);
    if (weight > MOST_WITHOUT_FORCE) {
        fail(error, ERROR_USAGE,
             "the sweep has %zu questions, together as much work as %.0f rows: more than a million",
             sweep->total, weight);
        return error_hint(error, "use --force to allow it");
    }
    return true;
}

bool sweep_build(struct sweep *sweep, const struct arguments *arguments,
                 const struct reader *reader, bool force, void *input, struct error *error)
{
    *sweep = (struct sweep){.total = 1, .reader = reader};
    sweep->axes = ARENA_ARRAY(reader->arena, arguments->command->option_count + 1, struct axis);
    for (size_t i = 0; i < arguments->command->option_count; i++) {
        const struct argument *argument = &arguments->all[i];
        void *member = (char *)input + argument->option->offset;
        if (!set_option(sweep, argument, reader, force, member, error)) {
            return argument_blame(arguments, argument, error);
        }
    }
    sweep->focal = focal_options_of(arguments->command->options, arguments->command->option_count);
    return sweep_check_size(sweep, arguments->command, force, input, error);
}
