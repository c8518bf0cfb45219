/* design/variable_put.c - a lens with the numbers that vary, and what they change. */
/* SPDX-License-Identifier: MIT */
#include "base/units.h"
#include "design/glass_map.h"
#include "design/variable.h"
#include "optics/pickup.h"

#include <math.h>
#include <string.h>

enum { DIGITS = 14 }; /* of the numbers of a lens that is to be written */

void variables_get(const struct variables *variables, double *v)
{
    memcpy(v, variables->start, variables->count * sizeof v[0]);
}

static double *variable_put_values_of(const struct variables *variables, size_t position)
{
    return variables->values + position * variables->number_count;
}

static bool is_in(const struct variable_drive *drive, size_t position)
{
    return drive->position == LENS_NONE || drive->position == position;
}

static double driven(const struct variable_drive *drive, const double *v)
{
    return drive->share == LENS_NONE ? v[drive->variable]
                                     : glass_map_at(v[drive->variable], v[drive->share]).Vd;
}

/*
 * A number that follows another, and its derivative by it. Of two reciprocals 1/(a/x + b) is
 * written x/(a + b x), which planes have too.
 */
static double variable_put_follow(const struct variable_rule *rule, double x, double *slope)
{
    double a = rule->factor, b = rule->offset;
    if (rule->from_inverse && rule->to_inverse) {
        *slope = a / ((a + b * x) * (a + b * x));
        return x / (a + b * x);
    }
    if (rule->from_inverse) {
        *slope = -a / (x * x);
        return a / x + b;
    }
    double sum = a * x + b;
    *slope = rule->to_inverse ? -a / (sum * sum) : a;
    return rule->to_inverse ? 1 / sum : sum;
}

static void variable_put_set(struct variables *variables, size_t position, size_t number,
                             double value)
{
    const struct variable_number *one = &variables->numbers[number];
    variable_put_values_of(variables, position)[number] = value;
    lens_numbers_set(&variables->lenses[position], one->what, one->is_inverse ? 1 / value : value);
}

const struct lens *variables_put(struct variables *variables, const double *v, size_t position)
{
    double slope;
    for (size_t i = 0; i < variables->drive_count; i++) {
        const struct variable_drive *drive = &variables->drives[i];
        if (is_in(drive, position)) {
            variable_put_set(variables, position, drive->number, driven(drive, v));
        }
    }
    for (size_t i = 0; i < variables->rule_count; i++) {
        const struct variable_rule *rule = &variables->rules[i];
        double from = variable_put_values_of(variables, position)[rule->from];
        variable_put_set(variables, position, rule->to, variable_put_follow(rule, from, &slope));
    }
    return &variables->lenses[position].lens;
}

/* The numbers of a position by one variable. */
static void variable_put_derive(const struct variables *variables, size_t position, size_t variable)
{
    double *slopes = variables->slopes, slope;
    const double *values = variable_put_values_of(variables, position);
    memset(slopes, 0, variables->number_count * sizeof slopes[0]);
    for (size_t i = 0; i < variables->drive_count; i++) {
        const struct variable_drive *drive = &variables->drives[i];
        if (!is_in(drive, position)) {
            continue;
        }
        if (drive->share == LENS_NONE) {
            slopes[drive->number] = drive->variable == variable ? 1 : slopes[drive->number];
        } else if (drive->variable == variable || drive->share == variable) {
            struct parameter index = variables->numbers[drive->number].what;
            index.kind = PARAMETER_INDEX;
            double nd = parameter_get(&variables->lenses[position].lens, index);
            const struct glass_map_point at =
                glass_map_at(nd, glass_map_share(nd, values[drive->number]));
            slopes[drive->number] = drive->share == variable ? at.by_share : at.by_nd;
        }
    }
    for (size_t i = 0; i < variables->rule_count; i++) {
        const struct variable_rule *rule = &variables->rules[i];
        if (slopes[rule->from] != 0) {
            variable_put_follow(rule, values[rule->from], &slope);
            slopes[rule->to] = slope * slopes[rule->from];
        }
    }
}

double variables_slope(const struct variables *variables, size_t position, size_t variable,
                       struct parameter what)
{
    const bool is_radius = what.kind == PARAMETER_RADIUS;
    const double *values = variable_put_values_of(variables, position);
    double slope = 0;
    what.kind = is_radius ? PARAMETER_CURVATURE : what.kind;
    variable_put_derive(variables, position, variable);
    for (size_t i = 0; i < variables->number_count; i++) {
        const struct variable_number *number = &variables->numbers[i];
        if (parameter_is_identical(number->what, what)) {
            /* d(1/x) = -dx/x^2 */
            slope = number->is_inverse || is_radius
                        ? -variables->slopes[i] / (values[i] * values[i])
                        : variables->slopes[i];
        }
    }
    return slope;
}

size_t variable_index_links(const struct lens *lens, struct variable_link link, size_t first,
                            size_t count, struct variable_link *links)
{
    size_t surface = link.basis.surface;
    do {
        size_t at = first;
        link.basis.surface = surface++;
        while (at < count && !parameter_is_identical(links[at].basis, link.basis)) {
            at++;
        }
        if (at == count) {
            links[count++] = link;
        } else {
            links[at].slope += link.slope;
        }
    } while (surface < lens->surface_count && surface_reflects(&lens->surfaces[surface]));
    return count;
}

size_t variables_most_links(const struct variables *variables)
{
    return variables->count * (variables->number_count + variables->lens->surface_count) + 1;
}

size_t variables_links(const struct variables *variables, size_t position, double wavelength,
                       struct variable_link *links)
{
    const struct lens *lens = &variables->lenses[position].lens;
    const double *values = variable_put_values_of(variables, position);
    size_t count = 0;
    for (size_t j = 0; j < variables->count; j++) {
        const size_t first = count;
        variable_put_derive(variables, position, j);
        for (size_t i = 0; i < variables->number_count; i++) {
            const struct variable_number *number = &variables->numbers[i];
            struct variable_link link = {j, number->what, variables->slopes[i]};
            if (link.slope == 0) {
                continue;
            }
            if (number->is_inverse) {
                link.slope *= -1 / (values[i] * values[i]);
            }
            if (parameter_is_of_medium(link.basis.kind)) {
                link.slope *= parameter_slope(lens, number->what, wavelength);
                link.basis.kind = PARAMETER_INDEX;
                count = variable_index_links(lens, link, first, count, links);
            } else {
                links[count++] = link;
            }
        }
    }
    return count;
}

/* With so many digits of the unit that the lens is written in. */
static struct figure variable_put_rounded(double value, struct number_scale unit,
                                          struct arena *arena)
{
    char text[PAIR_LENGTH];
    struct figure figure = figure_number(pair_of(value));
    if (isfinite(value)) {
        const char *end = pair_write_digits(text, figure.value, unit, DIGITS);
        bool has_point = memchr(text, '.', (size_t)(end - text)) != NULL &&
                         memchr(text, 'e', (size_t)(end - text)) == NULL;
        while (has_point && end[-1] == '0') {
            end--;
        }
        end -= end[-1] == '.' ? 1 : 0;
        figure.typed = text_of(arena_string(arena, text, (size_t)(end - text)));
        text_pair(figure.typed, unit, &figure.value);
    }
    return figure;
}

/* A number into its surface: a curvature as a radius where the surface has one. */
static void variable_put_write_number(struct lens *lens, struct parameter what, double value,
                                      struct arena *arena)
{
    struct surface *surface = &lens->surfaces[what.surface];
    if (parameter_get(lens, what) == value) {
        return; /* with the digits that were typed */
    }
    if (what.kind == PARAMETER_CURVATURE && !surface->has_curvature) {
        what.kind = PARAMETER_RADIUS;
        value = 1 / value;
    }
    bool is_length = parameter_length(what.kind, what.order) == 1;
    const struct figure figure = variable_put_rounded(
        value,
        is_length ? unit_find(&dimension_length, text_of(lens->unit))->scale : NUMBER_UNSCALED,
        arena);
    if (is_length) {
        parameter_put(surface, what.kind, what.order, figure, arena);
    } else {
        parameter_set(lens, what, figure.value.hi, arena);
    }
}

struct lens *variables_lens(const struct variables *variables, const double *v, struct arena *arena)
{
    const struct lens *from = variables->lens;
    struct lens *to = parameter_apply(from, NULL, NULL, 0, arena);
    to->variables = ARENA_ARRAY(arena, from->variable_count + 1, struct lens_variable);
    for (size_t i = 0; i < from->variable_count; i++) {
        to->variables[i] = from->variables[i];
    }
    for (size_t i = 0; i < variables->drive_count; i++) {
        const struct variable_drive *drive = &variables->drives[i];
        const struct variable_number *number = &variables->numbers[drive->number];
        double value = number->is_inverse ? 1 / driven(drive, v) : driven(drive, v);
        if (drive->position == LENS_NONE) {
            variable_put_write_number(to, number->what, value, arena);
        } else {
            /* a number of a word into its list */
            const struct figure *cell = parameter_figure(&to->surfaces[number->what.surface],
                                                         number->what.kind, number->what.order);
            struct lens_variable *word = &to->variables[cell->variable];
            struct figure *values = ARENA_ARRAY(arena, to->position_count, struct figure);
            memcpy(values, word->values, to->position_count * sizeof values[0]);
            if (values[drive->position].value.hi != value) {
                values[drive->position] = variable_put_rounded(
                    value, unit_find(&dimension_length, text_of(to->unit))->scale, arena);
            }
            word->values = values;
        }
    }
    lens_pickups_put(to, lens_at_position(to, 0, arena), arena);
    return to;
}
