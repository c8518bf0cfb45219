/* file/lens_tolerance.c - tolerances of a .lens file, of a file of their own, and of a grade. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_tolerance.h"

#include "base/constants.h"
#include "base/units.h"
#include "data/lensdb_facts.h"
#include "file/lens_mark.h"
#include "file/lens_unit.h"
#include "file/lens_words.h"

#include <string.h>

enum { MOST_TOLERANCES = 1000 }; /* lines; each may be of a range */

/* A line being read. */
struct tolerance_line_reader {
    struct file_words *words;
    const struct lens *lens;
    struct lens_tolerance *one;
};

/* -------- what it is of -------- */

/* The kind that such a number of a surface is; TOLERANCE_KINDS: none. */
static enum tolerance_kind tolerance_kind_of(enum parameter_kind parameter)
{
    int kind = 0;
    while (kind < TOLERANCE_KINDS &&
           tolerance_type((enum tolerance_kind)kind)->parameter != parameter) {
        kind++;
    }
    return (enum tolerance_kind)kind;
}

static bool takes_parameter(enum parameter_kind parameter)
{
    return tolerance_kind_of(parameter) != TOLERANCE_KINDS;
}

static bool check_owner(const struct tolerance_line_reader *reading, struct text word,
                        size_t surface)
{
    return surface < reading->lens->surface_count ||
           file_words_fail(reading->words, word, "there is no surface %.*s: the lens has %zu",
                           text_shown(word), word.start, reading->lens->surface_count);
}

/* A number from 1. */
static bool read_owner(const struct tolerance_line_reader *reading, struct text word,
                       size_t *surface)
{
    size_t number = 0;
    for (size_t i = 0; i < word.length; i++) {
        if (!char_is_digit(word.start[i]) || number > 1000000) {
            number = 0;
            break;
        }
        number = 10 * number + (size_t)(word.start[i] - '0');
    }
    *surface = number - 1;
    return number > 0
               ? check_owner(reading, word, *surface)
               : file_words_fail(reading->words, word,
                                 "'%.*s' is no surface: they are counted from 1, as in 3 or 3..5",
                                 text_shown(word), word.start);
}

static bool check_order(const struct tolerance_line_reader *reading, struct text word)
{
    return reading->one->first <= reading->one->last ||
           file_words_fail(reading->words, word, "the range %.*s ends before it begins",
                           text_shown(word), word.start);
}

/* Kinds of an owner, for messages. */
static bool fail_kind(const struct tolerance_line_reader *reading, enum tolerance_owner owner,
                      struct text word)
{
    struct text_buffer all = {.arena = reading->words->arena};
    struct nearest nearest = {.typed = word};
    for (int i = 0; i < TOLERANCE_KINDS; i++) {
        const struct tolerance_type *type = tolerance_type((enum tolerance_kind)i);
        if (type->owner == owner && i != TOLERANCE_COEFFICIENT) {
            growing_format(&all, "%s%s", all.length > 0 ? ", " : "", type->word);
            nearest_offer(&nearest, text_of(type->word));
        }
    }
    const struct text done = growing_done(&all);
    const char *list = arena_string(all.arena, done.start, done.length);
    const char *what = owner == TOLERANCE_OF_ELEMENT ? "an element" : "a surface";
    word.length == 0 ? file_words_fail(reading->words, word, "what of %s is missing", what)
                     : file_words_fail(reading->words, word, "unknown tolerance '%.*s' of %s",
                                       text_shown(word), word.start, what);
    return nearest.best.start != NULL ? error_hint(reading->words->error, "did you mean '%.*s'?",
                                                   text_shown(nearest.best), nearest.best.start)
                                      : error_hint(reading->words->error, "%s has %s", what, list);
}

/* `surface 3..5 tilt`, `element 3..5 tilt`, `elements 1..11 tilt` */
static bool read_owned(struct tolerance_line_reader *reading, enum tolerance_owner owner)
{
    struct lens_tolerance *one = reading->one;
    const struct text range = file_words_next(reading->words);
    struct text last = range, first = text_cut_range(&last);
    if (!read_owner(reading, first, &one->first) || !read_owner(reading, last, &one->last) ||
        !check_order(reading, range)) {
        return false;
    }
    const struct text word = file_words_next(reading->words);
    for (int i = 0; i < TOLERANCE_KINDS; i++) {
        const struct tolerance_type *type = tolerance_type((enum tolerance_kind)i);
        if (type->owner == owner && i != TOLERANCE_COEFFICIENT && text_equal(word, type->word)) {
            one->kind = (enum tolerance_kind)i;
            return true;
        }
    }
    return fail_kind(reading, owner, word);
}

/* `R1`, `t3..t5` */
static bool read_kind_named(struct tolerance_line_reader *reading, struct text word)
{
    struct lens_tolerance *one = reading->one;
    struct parameter from, to;
    struct text last = word, first = text_cut_range(&last);
    if (!lens_words_parameter(reading->words, first, takes_parameter, &from) ||
        !lens_words_parameter(reading->words, last, takes_parameter, &to) ||
        !check_owner(reading, first, from.surface) || !check_owner(reading, last, to.surface)) {
        return false;
    }
    if (from.kind != to.kind || from.order != to.order) {
        return file_words_fail(reading->words, word, "a range is of one kind of numbers: R1..R11");
    }
    one->kind = tolerance_kind_of(from.kind);
    one->order = from.order;
    one->first = from.surface;
    one->last = to.surface;
    one->is_range = one->first != one->last;
    if (one->kind == TOLERANCE_KINDS) {
        file_words_fail(reading->words, word, "'%.*s' has no tolerance by this name",
                        text_shown(word), word.start);
        return error_hint(reading->words->error,
                          "numbers are R, t, n, V, k and A4; tilts and decentres 'surface "
                          "%zu tilt', 'surface %zu decenter'",
                          one->first + 1, one->first + 1);
    }
    return check_order(reading, word);
}

static bool read_subject(struct tolerance_line_reader *reading)
{
    static const struct {
        const char *word;
        enum tolerance_owner owner;
        bool each;
    } owners[] = {{"surface", TOLERANCE_OF_SURFACE, true},
                  {"element", TOLERANCE_OF_ELEMENT, false},
                  {"elements", TOLERANCE_OF_ELEMENT, true}};
    const struct text word = file_words_next(reading->words);
    struct lens_tolerance *one = reading->one;
    const struct text line = reading->words->line;
    one->column = (size_t)(word.start - line.start) + 1;
    one->text = line;
    if (word.length == 0) {
        return file_words_fail(reading->words, word, "the tolerance is missing: R1 0.1%% uniform");
    }
    for (size_t i = 0; i < sizeof owners / sizeof owners[0]; i++) {
        if (text_equal(word, owners[i].word)) {
            bool read = read_owned(reading, owners[i].owner);
            one->is_range = owners[i].each && (one->first != one->last || i == 2);
            return read;
        }
    }
    if (text_equal(word, tolerance_type(TOLERANCE_FOCUS)->word)) {
        one->kind = TOLERANCE_FOCUS;
        return true;
    }
    if (read_kind_named(reading, word)) {
        return true;
    }
    struct nearest nearest = {.typed = word};
    for (size_t i = 0; i < sizeof owners / sizeof owners[0]; i++) {
        nearest_offer(&nearest, text_of(owners[i].word));
    }
    return reading->words->error->hint[0] == '\0' && nearest.best.start != NULL &&
           error_hint(reading->words->error, "did you mean '%.*s'?", text_shown(nearest.best),
                      nearest.best.start);
}

/* -------- by how much -------- */

/* What an amount of a kind may be, in words. */
static const char *amounts_of(const struct tolerance_type *type, struct arena *arena)
{
    static const char *const words[TOLERANCE_UNITS] = {"a length (0.02mm)", "an angle (2arcmin)",
                                                       "a bare number", "a percentage (0.1%)",
                                                       "fringes (3fringes)"};
    const char *all = "", *last = NULL;
    for (int i = 0; i < TOLERANCE_UNITS; i++) {
        if ((type->units & 1U << i) != 0) {
            if (last != NULL) {
                all = ARENA_JOIN(arena, all, all[0] != '\0' ? ", " : "", last);
            }
            last = words[i];
        }
    }
    return all[0] != '\0' ? ARENA_JOIN(arena, all, " or ", last) : last;
}

/* What an amount was typed in; `named` is null without a unit, for percent and fringes. */
static bool unit_of_amount(struct text text, enum tolerance_unit *unit, const struct unit **named)
{
    *named = NULL;
    if (text_equal(text, "%")) {
        *unit = TOLERANCE_PERCENT;
        return true;
    }
    if (text_equal(text, "fringe") || text_equal(text, "fringes")) {
        *unit = TOLERANCE_FRINGES;
        return true;
    }
    *unit = TOLERANCE_LENGTH;
    *named = unit_find(&dimension_length, text);
    if (*named == NULL) {
        *unit = TOLERANCE_ANGLE;
        *named = unit_find(&dimension_angle, text);
    }
    return *named != NULL;
}

/* What a bare number is: of the kind's units the first but percent and fringes. */
static bool bare_amount_unit(const struct tolerance_type *type, enum tolerance_unit *unit)
{
    for (int i = 0; i < TOLERANCE_PERCENT; i++) {
        if ((type->units & 1U << i) != 0) {
            *unit = (enum tolerance_unit)i;
            return true;
        }
    }
    return false;
}

/* The unit that bare lengths of the line are in: a word on its own in any file. */
static const char *bare_length(const struct file_words *words)
{
    int i = 0;
    while (i < LENS_UNITS - 1) {
        const struct number_scale scale = lens_unit_scale(lens_units[i].word);
        if (scale.multiplier == words->scale.multiplier && scale.power == words->scale.power) {
            break;
        }
        i++;
    }
    return lens_units[i].word;
}

/* The number, in the unit that was found. */
static bool read_plain_amount(const struct tolerance_line_reader *reading, struct text digits,
                              const struct unit *named)
{
    struct file_words *words = reading->words;
    struct lens_tolerance *one = reading->one;
    struct figure *amount = &one->amount;
    const bool is_length = one->unit == TOLERANCE_LENGTH;
    if (one->kind == TOLERANCE_COEFFICIENT && one->unit == TOLERANCE_NUMBER) {
        return lens_words_number(words, digits, PARAMETER_COEFFICIENT, one->order, amount);
    }
    struct number_scale scale = is_length ? words->scale : NUMBER_UNSCALED;
    double factor = one->unit == TOLERANCE_ANGLE ? RADIANS_PER_DEGREE : 1;
    if (named != NULL) {
        scale = named->scale;
        factor = named->factor;
    }
    if (!lens_words_figure(words, digits, scale, "tolerance", amount)) {
        const bool is_huge = !(fabs(amount->value.hi) < 1e100);
        return is_huge && one->kind <= TOLERANCE_ABBE &&
               error_hint(reading->words->error,
                          "a tolerance is less than the radius, thickness or index that "
                          "it is of");
    }
    if (factor != 1) {
        amount->value = pair_multiply(amount->value, pair_of(factor));
    }
    if (named == NULL && is_length) {
        amount->typed = text_of(arena_printf(words->arena, "%.*s%s", (int)digits.length,
                                             digits.start, bare_length(words)));
    }
    return true;
}

static bool read_amount(struct tolerance_line_reader *reading)
{
    struct file_words *words = reading->words;
    struct lens_tolerance *one = reading->one;
    const struct tolerance_type *type = tolerance_type(one->kind);
    const struct text word = file_words_next(words);
    double ignored;
    const char *end = word.start + word.length;
    const char *behind = number_read(word.start, end, NUMBER_UNSCALED, &ignored);
    if (behind == NULL) {
        return file_words_fail(words, word, "by how much is missing: %s",
                               amounts_of(type, words->arena));
    }
    const struct text digits = text_between(word.start, behind), name = text_between(behind, end);
    const struct unit *named = NULL;
    if (name.length == 0 ? !bare_amount_unit(type, &one->unit)
                         : !unit_of_amount(name, &one->unit, &named)) {
        name.length == 0
            ? file_words_fail(words, word, "'%.*s' has no unit", text_shown(word), word.start)
            : file_words_fail(words, name, "unknown unit '%.*s'", text_shown(name), name.start);
        return error_hint(reading->words->error, "it is %s", amounts_of(type, words->arena));
    }
    if ((type->units & 1U << one->unit) == 0) {
        return file_words_fail(words, name, "the %s has no tolerance in %.*s: it is %s", type->word,
                               text_shown(name), name.start, amounts_of(type, words->arena));
    }
    if (!read_plain_amount(reading, digits, named)) {
        return false;
    }
    if (name.length > 0) {
        one->amount.typed = word;
    }
    const double value = one->amount.value.hi;
    if (!(value > 0)) {
        return file_words_fail(reading->words, word,
                               "a tolerance is above 0: so much plus and minus");
    }
    if (one->unit == TOLERANCE_PERCENT && value >= 100) {
        return file_words_fail(reading->words, word,
                               "a tolerance of %.*s is as wide as the number itself",
                               text_shown(word), word.start);
    }
    return one->unit != TOLERANCE_ANGLE || value < PI / 2 ||
           file_words_fail(reading->words, word, "a tilt is below 90deg");
}

/* -------- how it is spread -------- */

/* "3sigma" */
static bool read_sigmas(struct tolerance_line_reader *reading, struct text word)
{
    struct lens_tolerance *one = reading->one;
    struct figure figure;
    const struct text digits = {word.start, word.length - strlen("sigma")};
    if (!lens_words_figure(reading->words, digits, NUMBER_UNSCALED, "number of standard deviations",
                           &figure)) {
        return false;
    }
    one->sigmas = figure.value.hi;
    if (one->distribution != DISTRIBUTION_NORMAL && one->distribution != DISTRIBUTION_TRUNCATED) {
        return file_words_fail(reading->words, word,
                               "only normal and truncated have standard deviations: normal %.*s",
                               text_shown(word), word.start);
    }
    return (one->sigmas >= DISTRIBUTION_SIGMAS_LEAST && one->sigmas <= DISTRIBUTION_SIGMAS_MOST) ||
           file_words_fail(reading->words, word, "the amount is %g to %g standard deviations",
                           DISTRIBUTION_SIGMAS_LEAST, DISTRIBUTION_SIGMAS_MOST);
}

static bool read_pivot(struct tolerance_line_reader *reading, struct text word)
{
    const struct lens_tolerance *one = reading->one;
    if (tolerance_type(one->kind)->owner != TOLERANCE_OF_ELEMENT || one->is_range ||
        one->kind == TOLERANCE_ELEMENT_DECENTER) {
        return file_words_fail(reading->words, word,
                               "a pivot belongs to the tilt, the roll or the wedge of one element");
    }
    return read_owner(reading, file_words_next(reading->words), &reading->one->pivot);
}

static bool fail_word(const struct tolerance_line_reader *reading, struct text word)
{
    struct error *error = reading->words->error;
    struct nearest nearest = {.typed = word};
    enum tolerance_unit unit;
    const struct unit *named;
    file_words_fail(reading->words, word, "unknown distribution '%.*s'", text_shown(word),
                    word.start);
    if (unit_of_amount(word, &unit, &named)) {
        return error_hint(error, "no blank stands between a number and its unit");
    }
    for (const struct word *each = distribution_words; each->word != NULL; each++) {
        nearest_offer(&nearest, text_of(each->word));
    }
    nearest_offer(&nearest, text_of("pivot"));
    return nearest.best.start != NULL
               ? error_hint(error, "did you mean '%.*s'?", text_shown(nearest.best),
                            nearest.best.start)
               : error_hint(error, "it is uniform, normal, truncated, two-point or parabolic");
}

/* How it is spread, and about what: up to the end of the line. */
static bool read_rest(struct tolerance_line_reader *reading)
{
    struct lens_tolerance *one = reading->one;
    bool has_distribution = false;
    for (struct text word = file_words_next(reading->words); word.length > 0;
         word = file_words_next(reading->words)) {
        int i = 0;
        while (i < DISTRIBUTIONS && !text_equal(word, distribution_words[i].word)) {
            i++;
        }
        const bool has_sigma =
            word.length > 5 && memcmp(word.start + word.length - 5, "sigma", 5) == 0;
        if (i < DISTRIBUTIONS && has_distribution) {
            return file_words_fail(reading->words, word, "a second distribution");
        }
        bool read = true;
        if (i < DISTRIBUTIONS) {
            has_distribution = true;
            one->distribution = (enum distribution)i;
        } else if (text_equal(word, "pivot")) {
            read = read_pivot(reading, word);
        } else if (has_sigma) {
            read = read_sigmas(reading, word);
        } else {
            read = fail_word(reading, word);
        }
        if (!read) {
            return false;
        }
    }
    return true;
}

bool lens_tolerance_read(struct file_words *words, struct lens *lens)
{
    struct lens_tolerance one = {.distribution = DISTRIBUTION_UNIFORM,
                                 .sigmas = DISTRIBUTION_SIGMAS,
                                 .pivot = LENS_NONE,
                                 .source = words->source,
                                 .line = words->number};
    struct tolerance_line_reader reading = {words, lens, &one};
    if (lens->tolerance_count == MOST_TOLERANCES) {
        return file_words_fail(words, file_words_next(words), "more than %d tolerances",
                               MOST_TOLERANCES);
    }
    if (!read_subject(&reading) || !read_amount(&reading) || !read_rest(&reading)) {
        return false;
    }
    /* One more; the list, which nobody else grows, has room for the next power of two. */
    const size_t count = lens->tolerance_count;
    if ((count & (count - 1)) == 0) {
        lens->tolerances = ARENA_COPY(words->arena, lens->tolerances, count, count + 1);
    }
    lens->tolerances[lens->tolerance_count++] = one;
    return true;
}

bool lens_tolerances_read(const char *source, struct text content, const struct lens *lens,
                          struct arena *arena, struct tolerances *tolerances, struct error *error)
{
    struct file_words words;
    struct lens marked = *lens;
    marked.tolerances = NULL;
    marked.tolerance_count = 0;
    if (!file_words_open(&words, source, content, arena, error) ||
        !file_words_plain(source, content, error)) {
        return false;
    }
    words.scale = lens_unit_scale(lens->unit);
    while (file_words_line(&words)) {
        const struct text word = file_words_next(&words);
        if (!text_equal(word, "tolerance")) {
            return file_words_fail(&words, word,
                                   "unknown word '%.*s': lines of this file begin with 'tolerance'",
                                   text_shown(word), word.start);
        }
        if (!lens_tolerance_read(&words, &marked)) {
            return false;
        }
    }
    *tolerances = (struct tolerances){marked.tolerances, marked.tolerance_count};
    if (marked.tolerance_count == 0) {
        return fail_in(error, source, 0, 0, "no line with 'tolerance'");
    }
    return true;
}

/* A row as the line that a lens file would have for all surfaces. */
static bool lens_grade_add_row(const struct lensdb_tolerance *row, struct lens *lens,
                               struct arena *arena, struct error *error)
{
    const struct text of_element = text_behind(row->quantity, "element ");
    const struct text quantity = of_element.start != NULL ? of_element : row->quantity;
    const char *line = arena_printf(
        arena, "%s 1..%zu %.*s %.*s%.*s %.*s", of_element.start != NULL ? "elements" : "surface",
        lens->surface_count, (int)quantity.length, quantity.start, (int)row->amount.length,
        row->amount.start, (int)row->unit.length, row->unit.start, (int)row->distribution.length,
        row->distribution.start);
    struct file_words words = {.source = row->file,
                               .error = error,
                               .line = text_of(line),
                               .number = row->line,
                               .at = line,
                               .scale = lens_unit_scale("mm"),
                               .arena = arena};
    if (!lens_tolerance_read(&words, lens)) {
        return false;
    }
    lens->tolerances[lens->tolerance_count - 1].is_range = true; /* of a single surface too */
    return true;
}

bool lens_grade_read(struct lensdb *db, struct text name, const struct lens *lens,
                     struct arena *arena, struct tolerances *grade, struct error *error)
{
    struct nearest nearest = {.typed = text_trim(name)};
    struct lens graded = *lens;
    graded.tolerances = NULL;
    graded.tolerance_count = 0;
    error->code = ERROR_NONE;
    for (enum lensdb_place place = LENSDB_USER;
         place < LENSDB_PLACES && graded.tolerance_count == 0; place++) {
        /* Those of one place; `nearest` is offered all grades that it has. */
        struct lensdb_table grades;
        struct lensdb_tolerance row;
        bool open = lensdb_grades_open(&grades, db, place, error);
        while (open && lensdb_grades_next(&grades, &row, error)) {
            nearest_offer(&nearest, row.grade);
            if (text_same_name(row.grade, nearest.typed) &&
                !lens_grade_add_row(&row, &graded, arena, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    *grade = (struct tolerances){graded.tolerances, graded.tolerance_count};
    if (grade->count > 0) {
        return true;
    }
    fail(error, ERROR_USAGE, "there is no grade '%.*s'", text_shown(name), name.start);
    return nearest.best.start != NULL ? error_hint(error, "did you mean '%.*s'?",
                                                   text_shown(nearest.best), nearest.best.start)
                                      : error_hint(error, "see 'lenscalc list tolerances'");
}

/* -------- and back -------- */

void lens_tolerance_write(const struct lens_tolerance *tolerance, const char *unit,
                          struct text_buffer *text)
{
    growing_format(text, "%s ", tolerance_name(tolerance, text->arena));
    /* A computed amount, in mm and degrees. */
    static const char *const endings[TOLERANCE_UNITS] = {"mm", "deg", "", "%", "fringes"};
    const struct figure *amount = &tolerance->amount;
    if (tolerance->kind == TOLERANCE_COEFFICIENT && tolerance->unit == TOLERANCE_NUMBER) {
        lens_number_write(text, amount, PARAMETER_COEFFICIENT, tolerance->order, unit);
    } else if (amount->typed.start != NULL) {
        growing_text(text, amount->typed);
    } else {
        growing_number(text, tolerance->unit == TOLERANCE_ANGLE
                                 ? amount->value.hi / RADIANS_PER_DEGREE
                                 : amount->value.hi);
        growing_string(text, endings[tolerance->unit]);
    }
    growing_format(text, " %s", distribution_words[tolerance->distribution].word);
    if (tolerance->sigmas != DISTRIBUTION_SIGMAS) {
        growing_string(text, " ");
        growing_number(text, tolerance->sigmas);
        growing_string(text, "sigma");
    }
    if (tolerance->pivot != LENS_NONE) {
        growing_format(text, " pivot %zu", tolerance->pivot + 1);
    }
}
