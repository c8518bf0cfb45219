/* cli/question/operands_telescope.c - which length of a telescope an operand is. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/operands_telescope.h"

#include "cli/question/operands.h"

#include <math.h>
#include <string.h>

/*
 * Sizes that are sold, mm. Diameters of telescopes begin at 50 and end at some 600, focal lengths
 * begin at 250; no eyepiece is longer than 56.
 */
static const double LEAST_DIAMETER = 50, LARGEST_DIAMETER = 610, LEAST_FOCAL = 250,
                    SURE_FOCAL = 600;

/* What else is known of it. */
struct telescope_given {
    bool focal, diameter, fnumber, eyepiece;
};

struct telescope_length {
    double length; /* mm; NaN: it is a list */
    bool is_inches;
};

static struct telescope_length telescope_length_of(struct text word)
{
    struct telescope_length found = {NAN, false};
    struct error ignored;
    const struct unit *unit;
    if (!quantity_read(word, &dimension_length, NULL, &found.length, &unit, &ignored)) {
        found.length = NAN;
    } else {
        found.is_inches = unit != NULL && strcmp(unit->name, "in") == 0;
    }
    return found;
}

static bool telescope_ask(struct text word, const char *other, struct error *error)
{
    const int shown = text_shown(word);
    fail(error, ERROR_USAGE, "'%.*s' may be the diameter of the telescope or %s", shown, word.start,
         strcmp(other, TELESCOPE) == 0 ? "its focal length" : "the eyepiece");
    return error_hint(error, "say which: --diameter %.*s or --%s %.*s", shown, word.start, other,
                      shown, word.start);
}

/* Of one length alone: is it the diameter? */
static bool telescope_length_is_diameter(struct text word, const struct telescope_given *given,
                                         bool *is_diameter, struct error *error)
{
    const struct telescope_length one = telescope_length_of(word);
    const bool only_power = given->eyepiece && !given->fnumber;
    *is_diameter = given->focal && !(one.length > LARGEST_DIAMETER);
    if (given->focal || given->diameter || isnan(one.length)) {
        return true;
    }
    if (one.is_inches ? one.length > LARGEST_DIAMETER : one.length > SURE_FOCAL) {
        return true;
    }
    if (one.is_inches) {
        *is_diameter = true;
        return true;
    }
    const bool is_long = one.length >= LEAST_FOCAL;
    if (is_long == only_power) {
        *is_diameter = !is_long;
        return true;
    }
    return telescope_ask(word, TELESCOPE, error);
}

/* Of two, the longer one is the focal length. */
static bool telescope_tell_two(const struct text *operands, const size_t *at, const char **names,
                               struct error *error)
{
    const double first = telescope_length_of(operands[at[0]]).length;
    const double second = telescope_length_of(operands[at[1]]).length;
    const bool is_second = second > first;
    if (fmin(first, second) < LEAST_DIAMETER) {
        return telescope_ask(operands[at[is_second ? 0 : 1]], "eyepiece", error);
    }
    names[0] = is_second ? DIAMETER : TELESCOPE;
    names[1] = is_second ? TELESCOPE : DIAMETER;
    return true;
}

static bool option_is_length_of_telescope(const struct option *option)
{
    return strcmp(option->name, TELESCOPE) == 0 || strcmp(option->name, DIAMETER) == 0;
}

/* Is it typed? A default does not say what a word beside it means. */
static bool telescope_has(const struct arguments *arguments, const char *name)
{
    const struct argument *argument = arguments_find(arguments, text_of(name));
    return argument != NULL && argument->is_given && argument->entry == NULL;
}

bool operands_tell_telescope(const struct arguments *arguments, const struct text *operands,
                             size_t count, const struct option **options, struct error *error)
{
    struct telescope_given given = {
        .focal = telescope_has(arguments, TELESCOPE),
        .diameter = telescope_has(arguments, DIAMETER),
        .fnumber = telescope_has(arguments, "aperture"),
        .eyepiece = telescope_has(arguments, "eyepiece") || telescope_has(arguments, "lens"),
    };
    const char *names[2] = {TELESCOPE, DIAMETER};
    size_t at[2], lengths = 0;
    for (size_t i = 0; i < count; i++) {
        given.fnumber = given.fnumber || strcmp(options[i]->name, "aperture") == 0;
        if (option_is_length_of_telescope(options[i]) && lengths < 2) {
            at[lengths++] = i;
        }
    }
    bool is_diameter = false;
    const struct argument *telescope = arguments_find(arguments, text_of(TELESCOPE));
    if (lengths == 0 || telescope == NULL) {
        return true;
    }
    if (lengths == 1 &&
        !telescope_length_is_diameter(operands[at[0]], &given, &is_diameter, error)) {
        return false;
    }
    if (lengths == 2 && !telescope_tell_two(operands, at, names, error)) {
        return false;
    }
    names[0] = is_diameter ? DIAMETER : names[0];
    for (size_t i = 0; i < lengths; i++) {
        options[at[i]] = arguments_find(arguments, text_of(names[i]))->option;
    }
    return true;
}
