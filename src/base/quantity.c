/* base/quantity.c - a quantity as people write it. */
/* SPDX-License-Identifier: MIT */
#include "base/quantity.h"

#include "base/quantity_form.h"

#include <math.h>
#include <string.h>

/* Step over the longest of the prefixes that stands here ("f/" before "f"). */
static void skip_prefix(struct quantity_parser *reading)
{
    const char *prefixes = reading->dimension->prefixes;
    struct text rest = text_of(prefixes != NULL ? prefixes : "");
    while (rest.start != NULL) {
        struct text word = text_cut(&rest, ' ');
        struct text here = {reading->at, word.length};
        if (word.length > 0 && (size_t)(reading->end - reading->at) > word.length) {
            char name[8] = {0};
            memcpy(name, word.start, word.length < sizeof name ? word.length : sizeof name - 1);
            if (text_same(here, name)) {
                reading->at += word.length;
                quantity_skip_blanks(reading);
                return;
            }
        }
    }
}

/* Refuse what a double cannot hold, where the number was neither infinite nor 0. */
static bool fits_double(struct quantity_parser *reading, const char *at, double value,
                        bool was_infinite, bool was_zero)
{
    if (isinf(value) && !was_infinite) {
        return quantity_wrong(reading, at, "the number is too large");
    }
    return value != 0 || was_zero || quantity_wrong(reading, at, "the number is too small");
}

static bool has_nonzero_digit(const char *at, const char *end)
{
    for (; at < end && *at != 'e' && *at != 'E'; at++) {
        if (*at >= '1' && *at <= '9') {
            return true;
        }
    }
    return false;
}

/* Read a number at the present place, times `scale`. */
static bool read_scaled(struct quantity_parser *reading, struct number_scale scale, double *value)
{
    const char *after = number_read(reading->at, reading->end, scale, value);
    if (after == NULL) {
        /* not a number: say what it is instead */
        if (reading->at >= reading->end) {
            return quantity_wrong(reading, reading->at, "a number is missing");
        }
        struct text rest = text_between(reading->at, reading->end);
        if (text_same(rest, "nan") || text_same(rest, "-nan")) {
            return quantity_wrong(reading, reading->at, "nan is not a value");
        }
        return quantity_wrong(reading, reading->at, "no number here");
    }
    const char *first = reading->at + (*reading->at == '-' || *reading->at == '+');
    if (!fits_double(reading, reading->at, *value, *first == 'i' || *first == 'I',
                     !has_nonzero_digit(reading->at, after))) {
        return false;
    }
    reading->at = after;
    return true;
}

static bool is_unit_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (unsigned char)c >= 0x80 ||
           c == '_' || c == '%' || c == '\'' || c == '"' || c == '/';
}

static const char *article(const char *noun)
{
    return strchr("aeiI", noun[0]) != NULL || noun[1] == '-' ? "an" : "a"; /* an f-number */
}

/* A unit that differs by case; for a slip of one or two letters the usual unit; else the nearest.
 */
static const char *meant_unit(const struct quantity_parser *reading, struct text name)
{
    struct nearest nearest = {.typed = name};
    for (size_t i = 0; i < reading->dimension->unit_count; i++) {
        const char *unit = reading->dimension->units[i].name;
        if (text_same(name, unit)) {
            return unit;
        }
        nearest_offer(&nearest, text_of(unit));
    }
    /* among so short words edit distance says nothing */
    return name.length <= 2 ? reading->unit->name : nearest.best.start;
}

/* "8", ".5", "f/8", "ISO400": a number, or letters before one. */
static bool begins_value(const char *at, const char *end)
{
    while (at < end && *at == ' ') {
        at++;
    }
    while (at < end && (is_unit_letter(*at) || *at == '/') && !char_is_digit(*at)) {
        at++;
    }
    return at < end && (char_is_digit(*at) || *at == '.');
}

/* "f/2.8-f/8", "24 to 70": what stands between two ends, and how long it is; 0 if nothing does. */
static size_t between_ends(const struct quantity_parser *reading)
{
    static const char *const words[] = {"-", "to ", "\xe2\x80\x93", "..."};
    size_t room = (size_t)(reading->end - reading->at);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        size_t length = strlen(words[i]);
        if (room > length && memcmp(reading->at, words[i], length) == 0 &&
            begins_value(reading->at + length, reading->end)) {
            return length;
        }
    }
    return 0;
}

/* Two ends of a range: say how it is written. */
static bool join_ends(struct quantity_parser *reading, size_t between)
{
    struct text first = text_trim(text_between(reading->text.start, reading->at));
    struct text last = text_trim(text_between(reading->at + between, reading->end));
    quantity_wrong(reading, reading->at, "a range is written with '..'");
    if (reading->text.length < 40) {
        error_hint(reading->error, "use \"%.*s..%.*s\"", (int)first.length, first.start,
                   (int)last.length, last.start);
    }
    return false;
}

/* A power in dioptres stands where a length is wanted: say which focal length it is. */
static bool hint_focal_length(struct quantity_parser *reading, struct text name)
{
    const struct unit *unit = unit_find(&dimension_vergence, name);
    double power;
    const char *after = number_read(reading->text.start, name.start, unit->scale, &power);
    if (after == NULL || power == 0 || !isfinite(1 / power)) {
        return false;
    }
    return error_hint(reading->error, "the focal length of %.*s is '%.6gmm'",
                      text_shown(reading->text), reading->text.start, 1 / power);
}

static bool quantity_wrong_unit(struct quantity_parser *reading, struct text name)
{
    const char *wanted = reading->dimension->name;
    size_t between = between_ends(reading);
    if (between > 0) {
        return join_ends(reading, between);
    }
    size_t caret = (size_t)(name.start - reading->text.start) + 1;
    int shown = name.length < 40 ? (int)name.length : 40;
    /* the dimension that has this unit, if it is not the wanted one */
    const struct dimension *other = NULL;
    for (size_t i = 0; dimensions[i] != NULL && other == NULL; i++) {
        if (unit_find(dimensions[i], name) != NULL) {
            other = dimensions[i];
        }
    }
    if (other != NULL) {
        fail_at(reading->error, ERROR_USAGE, reading->text, caret,
                "unit '%.*s' measures %s %s, expected %s %s", shown, name.start,
                article(other->name), other->name, article(wanted), wanted);
        return other == &dimension_vergence && hint_focal_length(reading, name);
    }
    if (reading->dimension->units[0].name[0] == '\0' && reading->dimension->unit_count == 1) {
        return fail_at(reading->error, ERROR_USAGE, reading->text, caret,
                       "'%.*s' does not belong to %s %s", shown, name.start, article(wanted),
                       wanted);
    }
    struct text whole = reading->text;
    size_t before = (size_t)(name.start - whole.start);
    const char *meant = meant_unit(reading, name);
    fail_at(reading->error, ERROR_USAGE, whole, before + 1, "unknown unit '%.*s'", shown,
            name.start);
    if (meant != NULL && before < 60) {
        error_hint(reading->error, "did you mean '%.*s%s'?", (int)before, whole.start, meant);
    }
    return false;
}

/* Read the unit here, if one stands here; null in *unit if none does. */
static bool quantity_read_unit(struct quantity_parser *reading, const struct unit **unit)
{
    enum { LONGEST_UNIT = 24 };
    *unit = NULL;
    quantity_skip_blanks(reading);
    const char *from = reading->at, *letters = from;
    while (letters < reading->end && is_unit_letter(*letters)) {
        letters++;
    }
    if (letters == from) {
        return true;
    }
    const size_t room = (size_t)(reading->end - from);
    size_t length = room < LONGEST_UNIT ? room : LONGEST_UNIT;
    /* the longest beginning that is a unit: "ft" of "ft6in", all of "cd/m2" */
    while (length > 0 &&
           (*unit = unit_find(reading->dimension, (struct text){from, length})) == NULL) {
        length--;
    }
    /* a unit ends where its word ends: "mm" does not begin with "m" */
    bool cut = *unit != NULL && length < room && is_unit_letter(from[length]) &&
               is_unit_letter(from[length - 1]) && from[length - 1] != '\'' &&
               from[length - 1] != '"';
    if (*unit == NULL || cut) {
        return quantity_wrong_unit(reading, text_between(from, letters));
    }
    reading->at = from + length;
    return true;
}

/* Does a denominator come next? */
static bool divides(const struct quantity_parser *reading)
{
    if (reading->at + 1 >= reading->end) {
        return false;
    }
    char sign = reading->at[0], next = reading->at[1];
    bool allowed =
        (sign == '/' && reading->dimension->fraction) || (sign == ':' && reading->dimension->ratio);
    return allowed && ((next >= '0' && next <= '9') || next == '.');
}

/* A denominator after '/' or ':' divides what was read. */
static bool quantity_divide(struct quantity_parser *reading, double *value)
{
    if (!divides(reading)) {
        return true;
    }
    const char *slash = reading->at++;
    double denominator;
    if (!read_scaled(reading, NUMBER_UNSCALED, &denominator)) {
        return false;
    }
    if (!(denominator > 0) || isinf(denominator)) {
        return quantity_wrong(reading, slash + 1, "a fraction cannot have this denominator");
    }
    const double numerator = *value;
    *value /= denominator;
    return fits_double(reading, slash, *value, isinf(numerator), numerator == 0);
}

/* Inches behind feet: 5ft6in, 5'6". */
static bool read_inches(struct quantity_parser *reading, double *value)
{
    quantity_skip_blanks(reading);
    if (reading->at == reading->end) {
        return true;
    }
    const char *from = reading->at;
    const struct unit *feet = unit_find(&dimension_length, text_of("ft"));
    const struct unit *inch = unit_find(&dimension_length, text_of("in"));
    double inches;
    const struct unit *unit;
    if (reading->typed != feet || !read_scaled(reading, inch->scale, &inches) ||
        !quantity_read_unit(reading, &unit) || (unit != inch && unit != NULL)) {
        return quantity_wrong(reading, from, "unexpected text after the number");
    }
    if (!(inches >= 0) || !(inches < unit_to_own(feet, 1)) || !(*value >= 0)) {
        return quantity_wrong(reading, from, "inches behind feet must be 0 to less than 12");
    }
    *value += inches;
    return true;
}

/* What is left over: name the usual causes. */
static bool quantity_left_over(struct quantity_parser *reading)
{
    size_t between = between_ends(reading);
    if (between > 0) {
        return join_ends(reading, between);
    }
    if (*reading->at != ',') {
        return quantity_wrong(reading, reading->at, "unexpected text after the number");
    }
    quantity_wrong(reading, reading->at, "a decimal comma: the decimal point is '.'");
    const char *at = reading->text.start, *const end = at + reading->text.length;
    size_t marks = 0;
    for (; at < end; at++) {
        marks += *at == '.' || *at == ',';
    }
    /* of 1.234,5 and 1,234.5 nobody knows which mark is meant for what */
    if (reading->text.length < 40 && marks == 1) {
        char fixed[48] = {0};
        memcpy(fixed, reading->text.start, reading->text.length);
        fixed[reading->at - reading->text.start] = '.';
        error_hint(reading->error, "use \"%s\"", fixed);
    }
    return false;
}

/* The number once more, now that its unit is known: one rounding for the whole conversion. */
static bool read_with_unit(struct quantity_parser *reading, const char *from, double plain,
                           bool fraction, double *value)
{
    const struct unit *unit = reading->typed != NULL ? reading->typed : reading->unit;
    if (fraction || isinf(plain)) {
        *value = unit_to_own(unit, plain);
    } else {
        number_read(from, reading->end, unit->scale, value);
        *value *= unit->factor;
    }
    if (!fits_double(reading, from, *value, isinf(plain), plain == 0)) {
        return false;
    }
    *value += 0.0; /* -0 is 0 */
    return true;
}

/* A time as shutter angle and frame rate: 180deg@24fps is 180/360/24 s. */
static bool read_shutter(struct text text, double *value, struct error *error)
{
    struct text rate = text;
    struct text angle = text_cut(&rate, '@');
    const struct unit *degree = unit_find(&dimension_angle, text_of("deg"));
    double turn, frames;
    if (!quantity_read(angle, &dimension_angle, degree, &turn, NULL, error)) {
        return error_within(error, text, angle);
    }
    if (!quantity_read(rate, &dimension_rate, NULL, &frames, NULL, error)) {
        return error_within(error, text, rate);
    }
    double degrees = unit_from_own(degree, turn);
    if (!(degrees > 0 && degrees <= 360) || !(frames > 0) || isinf(frames)) {
        return fail_at(error, ERROR_USAGE, text, 1,
                       "a shutter angle is above 0 to 360 deg, a frame rate above 0 fps");
    }
    *value = degrees / 360 / frames;
    return true;
}

/* A number with or without one unit, as nearly all are. */
static bool read_usual(struct quantity_parser *reading, double *value)
{
    skip_prefix(reading);
    const char *from = reading->at;
    double plain;
    if (!read_scaled(reading, NUMBER_UNSCALED, &plain)) {
        return false;
    }
    const char *behind = reading->at;
    if (!quantity_divide(reading, &plain)) {
        return false;
    }
    bool fraction = reading->at != behind;
    if (!quantity_read_unit(reading, &reading->typed) ||
        !read_with_unit(reading, from, plain, fraction, value)) {
        return false;
    }
    if (reading->typed != NULL && reading->dimension->units == dimension_length.units &&
        !read_inches(reading, value)) {
        return false;
    }
    quantity_skip_blanks(reading);
    return reading->at == reading->end || quantity_left_over(reading);
}

bool quantity_read(struct text text, const struct dimension *dimension, const struct unit *unit,
                   double *value, const struct unit **typed, struct error *error)
{
    struct quantity_formed formed;
    struct error other;
    const struct text trimmed = text_trim(text);
    struct quantity_parser reading = {.text = trimmed,
                                      .at = trimmed.start,
                                      .end = trimmed.start + trimmed.length,
                                      .dimension = dimension,
                                      .unit = unit != NULL ? unit : &dimension->units[0],
                                      .error = error};
    const bool is_shutter =
        dimension == &dimension_time && memchr(text.start, '@', text.length) != NULL;
    if (!(is_shutter ? read_shutter(text, value, error) : read_usual(&reading, value))) {
        reading.at = trimmed.start;
        reading.error = &other;
        switch (quantity_form_read(&reading, &formed)) {
        case QUANTITY_FORM_READ:
            error->code = ERROR_NONE;
            *value = formed.value;
            reading.typed = formed.typed;
            break;
        case QUANTITY_FORM_WRONG:
            *error = other;
            return false;
        default:
            return false;
        }
    }
    if (typed != NULL) {
        *typed = reading.typed;
    }
    return true;
}

/* Does the text, read in this unit, give the value back? */
static bool reads_back(const char *at, const char *end, const struct unit *unit, double value)
{
    double again;
    return number_read(at, end, unit->scale, &again) == end && again * unit->factor == value;
}

char *quantity_write(char *to, double value, const struct unit *unit)
{
    if (unit == NULL || unit_is_own(unit)) {
        return number_write_shortest(to, value);
    }
    double converted = unit_from_own(unit, value);
    /* where only the decimal point moves, the number of digits stays: no need to try in vain */
    bool decimal = unit->factor == 1 && unit->scale.multiplier == 1;
    if (!decimal || !number_needs_more(value, 15)) {
        char *end = number_write_digits(to, converted, 15);
        if (reads_back(to, end, unit, value)) {
            return end;
        }
    }
    return number_write_shortest(to, converted);
}
