/* file/lens_change.c - a lens scaled, or in another unit. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_change.h"

#include "file/lens_build.h"
#include "file/lens_unit.h"
#include "optics/aperture.h"
#include "optics/pickup.h"
#include "optics/tolerance.h"

#include <math.h>
#include <string.h>

/* What is done to a number of the dimension length^power. */
struct change {
    struct arena *arena;
    const char *unit; /* of the digits */
    struct pair factor;
    bool rounded;
};

/* A power that is 0 and more. */
static struct pair power_of_length(struct pair base, int power)
{
    struct pair product = {1, 0};
    for (int i = 0; i < power; i++) {
        product = pair_multiply(product, base);
    }
    return product;
}

static struct pair unit_length(const char *unit)
{
    struct figure one = {.typed = text_of("1"), .variable = LENS_NONE};
    return figure_per_length(one, unit, 1).value;
}

/* Of the dimension length^power: a length, 1, or 1 over lengths. */
static void change_figure(const struct change *change, int power, struct figure *figure)
{
    if (figure->variable != LENS_NONE || !isfinite(figure->value.hi)) {
        return;
    }
    struct pair value = figure->value;
    if (power == 1) {
        value = pair_multiply(value, change->factor);
        *figure = change->rounded
                      ? figure_rounded(value, lens_unit_scale(change->unit), change->arena)
                      : figure_computed(value, lens_unit_scale(change->unit), change->arena);
        return;
    }
    /* the digits of a value in unit^power */
    value = pair_divide(value, power_of_length(change->factor, -power));
    value = pair_multiply(value, power_of_length(unit_length(change->unit), -power));
    *figure = change->rounded ? figure_rounded(value, NUMBER_UNSCALED, change->arena)
                              : figure_computed(value, NUMBER_UNSCALED, change->arena);
    *figure = figure_per_length(*figure, change->unit, power);
}

static void change_pair(const struct change *change, struct figure pair[2])
{
    change_figure(change, 1, &pair[0]);
    change_figure(change, 1, &pair[1]);
}

/* A list of numbers of the dimension length^power. */
static const struct figure *change_list(const struct change *change, int power,
                                        const struct figure *figures, size_t count)
{
    if (figures == NULL || power == 0) {
        return figures;
    }
    struct figure *copy = ARENA_COPY(change->arena, figures, count, 0);
    for (size_t i = 0; i < count; i++) {
        change_figure(change, power, &copy[i]);
    }
    return copy;
}

static const struct figure *change_all(const struct change *change, const struct figure *figures,
                                       size_t count)
{
    return change_list(change, 1, figures, count);
}

/* Lengths and fringes, which are lengths of sag; the others are shares, angles and numbers. */
static void change_tolerances(const struct change *change, struct lens *lens)
{
    struct lens_tolerance *copy =
        ARENA_COPY(change->arena, lens->tolerances, lens->tolerance_count, 0);
    const bool scales = change->factor.hi != 1 || change->factor.lo != 0;
    for (size_t i = 0; i < lens->tolerance_count; i++) {
        struct figure *amount = &copy[i].amount;
        if (copy[i].kind == TOLERANCE_COEFFICIENT && copy[i].unit == TOLERANCE_NUMBER) {
            change_figure(change, 1 - copy[i].order, amount);
        } else if (scales &&
                   (copy[i].unit == TOLERANCE_LENGTH || copy[i].unit == TOLERANCE_FRINGES)) {
            amount->value = pair_multiply(amount->value, change->factor);
            amount->typed.start = NULL;
        }
    }
    lens->tolerances = copy;
}

static struct lens_field *change_fields(const struct change *change,
                                        const struct lens_field *fields, size_t count)
{
    struct lens_field *copy = ARENA_COPY(change->arena, fields, count, 0);
    for (size_t i = 0; i < count; i++) {
        change_pair(change, copy[i].at);
    }
    return copy;
}

static void change_vary(const struct change *change, struct vary *vary)
{
    int power = parameter_length(vary->kind, vary->order);
    if (vary->has_bounds && power != 0) {
        change_figure(change, power, &vary->low);
        change_figure(change, power, &vary->high);
    }
}

/* Marks of a word, one a position. */
static const struct vary *const *change_word(const struct change *change,
                                             const struct vary *const *marks, size_t count)
{
    if (marks == NULL) {
        return NULL;
    }
    const struct vary **copy = ARENA_ARRAY(change->arena, count, const struct vary *);
    for (size_t p = 0; p < count; p++) {
        struct vary *mark = ARENA_NEW(change->arena, struct vary);
        if (marks[p] != NULL) {
            *mark = *marks[p];
            change_vary(change, mark);
            copy[p] = mark;
        }
    }
    return copy;
}

static void change_surface(const struct change *change, struct surface *surface)
{
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        const struct figure *from = parameter_figure(surface, each.kind, each.order);
        int power = parameter_length(each.kind, each.order);
        if (from != NULL && power != 0) {
            struct figure to = *from;
            change_figure(change, power, &to);
            parameter_put(surface, each.kind, each.order, to, change->arena);
        }
    }
    if (surface->has_diameter) {
        change_figure(change, 1, &surface->diameter);
    }
    struct vary *marks = ARENA_COPY(change->arena, surface->varies, surface->vary_count, 0);
    for (size_t i = 0; i < surface->vary_count; i++) {
        change_vary(change, &marks[i]);
    }
    surface->varies = marks;
    struct aperture *holes =
        ARENA_COPY(change->arena, surface->apertures, surface->aperture_count, 0);
    for (size_t i = 0; i < surface->aperture_count; i++) {
        struct figure(*points)[2] =
            ARENA_COPY(change->arena, holes[i].points, holes[i].point_count, 0);
        change_pair(change, holes[i].size);
        change_pair(change, holes[i].decenter);
        for (size_t k = 0; k < holes[i].point_count; k++) {
            change_pair(change, points[k]);
        }
        holes[i].points = (const struct figure(*)[2])points;
    }
    surface->apertures = holes;
}

static void change_system(const struct change *change, struct lens *lens)
{
    size_t positions = lens->position_count;
    change_figure(change, 1, &lens->object);
    lens->objects = change_all(change, lens->objects, positions);
    if (lens->field_kind != FIELD_NONE && lens->field_kind != FIELD_ANGLE) {
        /* The fields that are lengths, of all positions. */
        struct lens_points *points =
            ARENA_ARRAY(change->arena, lens->position_count, struct lens_points);
        lens->fields = change_fields(change, lens->fields, lens->field_count);
        for (size_t p = 0; p < lens->position_count && lens->points != NULL; p++) {
            const struct lens_points *from = &lens->points[p];
            points[p] =
                (struct lens_points){change_fields(change, from->fields, from->count), from->count};
        }
        lens->points = lens->points != NULL ? points : NULL;
    }
    if (lens->aperture_kind == APERTURE_EPD) {
        change_figure(change, 1, &lens->aperture);
        lens->apertures = change_all(change, lens->apertures, positions);
    }
    for (int i = 0; i < STATED_COUNT; i++) {
        if (stated_is_length(i)) {
            lens->stated[i] = change_all(change, lens->stated[i], lens->stated_count[i]);
        }
    }
    struct lens_variable *variables =
        ARENA_ARRAY(change->arena, lens->variable_count, struct lens_variable);
    for (size_t i = 0; i < lens->variable_count; i++) {
        variables[i].name = lens->variables[i].name;
        variables[i].values = change_all(change, lens->variables[i].values, positions);
        variables[i].varies = change_word(change, lens->variables[i].varies, positions);
    }
    lens->variables = variables;
    struct lens_pickup *follow = ARENA_COPY(change->arena, lens->pickups, lens->pickup_count, 0);
    for (size_t i = 0; i < lens->pickup_count; i++) {
        int power = parameter_length(follow[i].what.kind, follow[i].what.order);
        if (power != 0 && follow[i].offset.value.hi != 0) {
            change_figure(change, power, &follow[i].offset);
        }
    }
    lens->pickups = follow;
    struct lens_setting *set = ARENA_COPY(change->arena, lens->settings, lens->setting_count, 0);
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct parameter one = set[i].parameter;
        set[i].figures = change_list(change, parameter_length(one.kind, one.order), set[i].figures,
                                     lens->position_count);
    }
    lens->settings = set;
    change_tolerances(change, lens);
}

static struct lens *changed(const struct change *change, const struct lens *lens)
{
    struct lens *copy = ARENA_COPY(change->arena, lens, 1, 0);
    copy->unit = change->unit;
    copy->surfaces = ARENA_COPY(change->arena, lens->surfaces, lens->surface_count, 0);
    for (size_t i = 0; i < lens->surface_count; i++) {
        change_surface(change, &copy->surfaces[i]);
    }
    change_system(change, copy);
    return copy;
}

const struct lens *lens_scaled(const struct lens *lens, struct pair factor, bool rounded,
                               struct arena *arena)
{
    const struct change change = {arena, lens->unit, factor, rounded};
    struct lens *copy = changed(&change, lens);
    copy->goals = NULL;
    copy->goal_count = 0;
    return copy;
}

const struct lens *lens_in_unit(const struct lens *lens, const char *unit, struct arena *arena)
{
    const struct change change = {arena, unit, {1, 0}, false};
    return strcmp(unit, lens->unit) == 0 ? lens : changed(&change, lens);
}

/* The first cell of a marked word has its mark, and the others follow it. */
static void mark_cells(const struct lens *from, size_t word, const struct vary *mark,
                       struct lens *to, struct arena *arena)
{
    static const enum parameter_kind kinds[] = {PARAMETER_THICKNESS, PARAMETER_FOCAL};
    struct lens_pickup pickup = {
        .from = {LENS_NONE, kinds[0], 0}, .factor = figure_of(1, arena), .offset = figure_zero()};
    for (size_t i = 0; i < 2 * from->surface_count; i++) {
        const struct parameter what = {i / 2, kinds[i % 2], 0};
        const struct figure *cell =
            parameter_figure(&from->surfaces[what.surface], what.kind, what.order);
        if (cell == NULL || cell->variable != word) {
            continue;
        }
        if (pickup.from.surface == LENS_NONE) {
            /* The mark of a word, on the surface whose cell it stands in. */
            struct surface *surface = &to->surfaces[what.surface];
            struct vary *copy = ARENA_COPY(arena, surface->varies, surface->vary_count, 1);
            copy[surface->vary_count] = *mark;
            copy[surface->vary_count++].kind = what.kind;
            surface->varies = copy;
            pickup.from = what;
        } else {
            pickup.what = what;
            lens_pickup_add(to, pickup, arena);
        }
    }
}

const struct lens *lens_one_position(const struct lens *lens, size_t position, struct arena *arena)
{
    struct lens *copy = ARENA_COPY(arena, lens_at_position(lens, position, arena), 1, 0);
    copy->pickups = lens->pickups;
    copy->pickup_count = lens->pickup_count;
    for (size_t i = 0; i < lens->variable_count; i++) {
        const struct vary *const *marks = lens->variables[i].varies;
        if (marks != NULL && marks[position] != NULL) {
            mark_cells(lens, i, marks[position], copy, arena);
        }
    }
    copy->positions = NULL;
    copy->position_count = 0;
    copy->variables = NULL;
    copy->variable_count = 0;
    copy->settings = NULL;
    copy->setting_count = 0;
    copy->stops = NULL;
    copy->lights = NULL;
    copy->points = NULL;
    copy->objects = NULL;
    copy->apertures = NULL;
    for (int i = 0; i < STATED_COUNT; i++) {
        if (copy->stated_count[i] > 1) {
            copy->stated[i] = &lens->stated[i][position];
            copy->stated_count[i] = 1;
        }
    }
    return copy;
}
