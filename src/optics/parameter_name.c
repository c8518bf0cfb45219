/* optics/parameter_name.c - names of what may change in a lens, read and written. */
/* SPDX-License-Identifier: MIT */
#include "optics/lens.h"
#include "optics/parameter.h"

enum { MOST_DIGITS = 6 }; /* of the number of a surface */

const char *parameter_name(enum parameter_kind kind, int order, struct arena *arena)
{
    const char *name = parameter_type(kind)->name;
    return order > 0 ? arena_printf(arena, "%s%d", name, order) : name;
}

const char *parameter_mark_name(enum parameter_kind kind, int order, struct arena *arena)
{
    const char *mark = parameter_type(kind)->mark;
    return mark != NULL ? mark : parameter_name(kind, order, arena);
}

/* The order that a text of one or two digits names; 0 if it names none. */
static int order_of(struct text digits)
{
    int order = 0;
    for (size_t i = 0; i < digits.length; i++) {
        if (!char_is_digit(digits.start[i]) || digits.length > 2) {
            return 0;
        }
        order = 10 * order + (digits.start[i] - '0');
    }
    bool sound =
        digits.length > 0 && digits.start[0] != '0' && order == surface_order(surface_term(order));
    return sound ? order : 0;
}

bool parameter_name_read(struct text text, enum parameter_kind *kind, int *order)
{
    for (enum parameter_kind i = (enum parameter_kind)0; i < PARAMETER_KINDS;
         i = (enum parameter_kind)(i + 1)) {
        const struct parameter_type *type = parameter_type(i);
        *kind = i;
        *order = 0;
        if (((type->is & PARAMETER_HAS_ORDERS) == 0 && text_equal(text, type->name)) ||
            (type->mark != NULL && text_equal(text, type->mark))) {
            return true;
        }
        if ((type->is & PARAMETER_HAS_ORDERS) != 0) {
            *order = order_of(text_behind(text, type->name));
        }
        if (*order > 0) {
            return true;
        }
    }
    return false;
}

const char *parameter_write(struct parameter parameter, struct arena *arena)
{
    const char *name = parameter_type(parameter.kind)->name;
    size_t number = parameter.surface + 1;
    return parameter.order > 0 ? arena_printf(arena, "%s%d_%zu", name, parameter.order, number)
                               : arena_printf(arena, "%s%zu", name, number);
}

const char *parameter_mark_write(struct parameter parameter, struct arena *arena)
{
    const char *mark = parameter_type(parameter.kind)->mark;
    return mark != NULL ? arena_printf(arena, "%s%zu", mark, parameter.surface + 1)
                        : parameter_write(parameter, arena);
}

/* A name that may have been meant: in the wrong case, misspelt, or in words; null = none. */
static const char *nearest_name(struct text name, bool (*takes)(enum parameter_kind kind))
{
    struct nearest nearest = {.typed = name};
    const char *found = NULL;
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        const struct parameter_type *type = parameter_type(each.kind);
        if (takes != NULL && !takes(each.kind)) {
            continue;
        }
        if (text_same(name, type->name) || text_same(name, type->words)) {
            return type->name;
        }
        const char *before = nearest.best.start;
        if (type->mark != NULL) {
            nearest_offer(&nearest, text_of(type->mark));
        }
        nearest_offer(&nearest, text_of(type->name));
        nearest_offer(&nearest, text_of(type->words));
        found = nearest.best.start != before ? type->name : found;
    }
    return found;
}

/* What stands before the number of the surface, which is cut off. */
static struct text parameter_name_cut_number(struct text text, struct text *digits)
{
    size_t length = text.length;
    while (length > 0 && char_is_digit(text.start[length - 1])) {
        length--;
    }
    *digits = (struct text){text.start + length, text.length - length};
    if (length > 0 && text.start[length - 1] == '_') {
        length--;
    }
    return (struct text){text.start, length};
}

/* "A42": A4 of surface 2; "r1": R1. */
static void parameter_name_suggest(struct text name, struct text digits,
                                   bool (*takes)(enum parameter_kind kind), struct error *error)
{
    enum parameter_kind kind;
    int order;
    for (size_t length = digits.length < 3 ? digits.length : 3; length-- > 1;) {
        const struct text longer = {name.start, name.length + length};
        if (name.start + name.length == digits.start &&
            parameter_name_read(longer, &kind, &order) && (takes == NULL || takes(kind))) {
            error_hint(error, "did you mean '%.*s_%.*s'?", (int)longer.length, longer.start,
                       text_shown(digits) - (int)length, digits.start + length);
            return;
        }
    }
    const char *near = nearest_name(name, takes);
    if (near != NULL && digits.length > 0) {
        error_hint(error, "did you mean '%s%.*s'?", near, text_shown(digits), digits.start);
    }
}

bool parameter_read(struct text text, bool (*takes)(enum parameter_kind kind),
                    struct parameter *parameter, struct error *error)
{
    struct text digits, name = parameter_name_cut_number(text, &digits);
    size_t number = 0;
    *parameter = (struct parameter){0};
    for (size_t i = 0; i < digits.length && i < MOST_DIGITS + 1; i++) {
        number = 10 * number + (size_t)(digits.start[i] - '0');
    }
    bool known = parameter_name_read(name, &parameter->kind, &parameter->order);
    if (!known || digits.length == 0) {
        fail(error, ERROR_USAGE, "'%.*s' names nothing of a surface that may change",
             text_shown(text), text.start);
        parameter_name_suggest(name, digits, takes, error);
        return false;
    }
    if (number == 0 || digits.length > MOST_DIGITS) {
        return fail(error, ERROR_USAGE, "'%.*s': surfaces are counted from 1%s", text_shown(text),
                    text.start, number == 0 ? "" : " to 999999");
    }
    parameter->surface = number - 1;
    return true;
}

size_t parameter_gap_find(const struct lens *lens, struct text name)
{
    struct text digits = name;
    struct parameter parameter;
    struct error ignored;
    size_t number = 0;
    for (size_t i = 0; i < digits.length; i++) {
        const bool is_digit = char_is_digit(digits.start[i]) && i < MOST_DIGITS;
        number =
            is_digit && (i == 0 || number > 0) ? 10 * number + (size_t)(digits.start[i] - '0') : 0;
    }
    if (number > 0) {
        return number <= lens->surface_count ? number - 1 : LENS_NONE;
    }
    if (text_same(name, "last")) {
        return lens->surface_count - 1;
    }
    if (parameter_read(name, NULL, &parameter, &ignored)) {
        const bool is_gap = parameter.kind == PARAMETER_THICKNESS;
        return is_gap && parameter.surface < lens->surface_count ? parameter.surface : LENS_NONE;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (lens->surfaces[i].name != NULL && text_same(name, lens->surfaces[i].name)) {
            return i;
        }
    }
    return LENS_NONE;
}

bool parameter_is_mark(enum parameter_kind kind, const struct surface *surface)
{
    return (parameter_type(kind)->is & PARAMETER_IS_MARK) != 0 && parameter_suits(kind, surface);
}

const char *parameter_marks(const struct surface *surface, struct arena *arena)
{
    const char *all = "", *last = NULL;
    for (enum parameter_kind i = (enum parameter_kind)0; i < PARAMETER_KINDS;
         i = (enum parameter_kind)(i + 1)) {
        if (!parameter_is_mark(i, surface)) {
            continue;
        }
        if (last != NULL) {
            all = arena_printf(arena, "%s%s%s", all, all[0] != '\0' ? ", " : "", last);
        }
        bool has_orders = (parameter_type(i)->is & PARAMETER_HAS_ORDERS) != 0;
        last = parameter_mark_name(i, has_orders ? 4 : 0, arena);
    }
    return all[0] != '\0' ? arena_printf(arena, "%s or %s", all, last) : last;
}

bool parameter_is_marked(enum parameter_kind kind, int order, const struct surface *surface)
{
    for (size_t i = 0; i < surface->vary_count; i++) {
        if (surface->varies[i].kind == kind && surface->varies[i].order == order) {
            return true;
        }
    }
    return false;
}
