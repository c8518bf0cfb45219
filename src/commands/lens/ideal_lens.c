/* commands/lens/ideal_lens.c - thin lenses and spherical mirrors as options say them. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/ideal_lens.h"

#include "base/choice.h"
#include "base/quantity.h"
#include "cli/options/option.h"
#include "file/lens_build.h"

#include <math.h>
#include <string.h>

enum { MOST_THEN = 20 };

/* Indexed by enum ideal_mirror. */
const struct word ideal_mirrors[] = {
    [MIRROR_NONE] = {"no", "a lens"},
    [MIRROR_CONCAVE] = {"concave", "its focal length is positive"},
    [MIRROR_CONVEX] = {"convex", "its focal length is negative"},
    [MIRROR_PLANE] = {"plane", "it has none"},
    {NULL, NULL},
};

/* One more lens, and the gap in front of it; mm. */
struct ideal_element {
    double gap, focal;
};

/* -------- the list -------- */

static bool then_fail(struct text item, struct error *error)
{
    fail(error, ERROR_USAGE, "'%.*s' is neither a gap nor a lens", text_shown(item), item.start);
    if (text_contains_name(item, text_of("mirror"))) {
        return error_hint(error,
                          "the light passes the lens twice: a plane mirror 2 m behind a lens "
                          "of 50 cm is \"gap 4m, f 50cm\"");
    }
    return error_hint(error, "write gaps and focal lengths in turn: \"gap 14cm, f -9.5cm\"");
}

/* "f -9.5cm", "f=-9.5cm", "power 2dpt", "gap 14cm": its word is cut off. */
static bool then_number(struct text item, struct text word, struct text value,
                        struct ideal_element *element, struct error *error)
{
    const struct unit *millimetre = &dimension_length.units[0];
    const struct unit *dioptre = unit_find(&dimension_vergence, text_of("dpt"));
    double number;
    if (text_equal(word, "power") || text_equal(word, "P")) {
        if (!quantity_read(value, &dimension_vergence, dioptre, &number, NULL, error)) {
            return false;
        }
        element->focal = 1 / number;
    } else if (text_equal(word, "f") || text_equal(word, "focal-length")) {
        if (!quantity_read(value, &dimension_length, millimetre, &element->focal, NULL, error)) {
            return false;
        }
    } else if (text_equal(word, "gap") || text_equal(word, "d")) {
        if (!quantity_read(value, &dimension_length, millimetre, &element->gap, NULL, error)) {
            return false;
        }
        return (element->gap >= 0 && isfinite(element->gap)) ||
               fail(error, ERROR_USAGE, "the gap %.*s is out of range: it must be 0 or more",
                    text_shown(value), value.start);
    } else {
        return then_fail(item, error);
    }
    return (element->focal != 0 && isfinite(element->focal)) ||
           fail(error, ERROR_USAGE, "'%.*s' is no lens: a focal length is finite and not 0",
                text_shown(item), item.start);
}

/* A gap may be left out: the lenses touch. */
static bool then_read(const char *then, struct ideal_element *elements, size_t *count,
                      struct error *error)
{
    const struct ideal_element none = {NAN, NAN};
    struct ideal_element next = none;
    struct text rest = text_of(then);
    *count = 0;
    while (rest.start != NULL) {
        const struct text item = text_trim(text_cut(&rest, ','));
        struct text value = item;
        const bool has_sign = memchr(item.start, '=', item.length) != NULL;
        const struct text word = text_trim(text_cut(&value, has_sign ? '=' : ' '));
        const bool had_gap = !isnan(next.gap);
        if (value.start == NULL) {
            return then_fail(item, error);
        }
        if (!then_number(item, word, text_trim(value), &next, error)) {
            return false;
        }
        if (isnan(next.focal)) {
            if (had_gap) {
                return fail(error, ERROR_USAGE, "'%.*s' is a second gap without a lens between",
                            text_shown(item), item.start);
            }
            continue;
        }
        if (*count == MOST_THEN) {
            return fail(error, ERROR_USAGE, "more than %d lenses", MOST_THEN);
        }
        next.gap = isnan(next.gap) ? 0 : next.gap;
        elements[(*count)++] = next;
        next = none;
    }
    return isnan(next.gap) || fail(error, ERROR_USAGE, "no lens behind the last gap");
}

bool ideal_lens_accepts(const char *then, struct error *error)
{
    struct ideal_element elements[MOST_THEN];
    size_t count;
    return then_read(then, elements, &count, error);
}

/* Focal lengths with the gaps between them, of which the first stands in front of nothing. */
static bool lenses_read(const char *lenses, struct ideal_element *elements, size_t *count,
                        struct error *error)
{
    const struct unit *millimetre = &dimension_length.units[0];
    struct text rest = text_of(lenses);
    double gap = 0;
    *count = 0;
    for (bool is_gap = false; rest.start != NULL; is_gap = !is_gap) {
        const struct text item = text_trim(text_cut(&rest, ','));
        double length;
        if (!quantity_read(item, &dimension_length, millimetre, &length, NULL, error)) {
            return false;
        }
        if (is_gap && !(length >= 0 && isfinite(length))) {
            return fail(error, ERROR_USAGE, "the gap %.*s is out of range: it must be 0 or more",
                        text_shown(item), item.start);
        }
        if (is_gap) {
            gap = length;
            continue;
        }
        if (length == 0 || !isfinite(length)) {
            return fail(error, ERROR_USAGE, "'%.*s' is no lens: a focal length is finite and not 0",
                        text_shown(item), item.start);
        }
        if (*count == MOST_THEN) {
            return fail(error, ERROR_USAGE, "more than %d lenses", MOST_THEN);
        }
        elements[(*count)++] = (struct ideal_element){gap, length};
        gap = NAN;
    }
    if (!isnan(gap)) {
        fail(error, ERROR_USAGE, "no lens behind the last gap");
        return error_hint(error, "lenses and the gaps between them in turn: 25cm,16.5cm,25cm; "
                                 "lenses that touch have the gap 0");
    }
    return true;
}

bool ideal_lenses_accept(const char *lenses, struct error *error)
{
    struct ideal_element elements[MOST_THEN];
    size_t count;
    return lenses_read(lenses, elements, &count, error);
}

/* -------- the lens -------- */

/* The power of a mirror by its kind, whose numbers may be sizes. */
static bool mirror_power(const struct ideal_question *question, struct pair *power,
                         struct error *error)
{
    const bool is_concave = question->mirror == MIRROR_CONCAVE;
    if (!isnan(question->radius) && !(question->radius > 0 && isfinite(question->radius))) {
        return fail(error, ERROR_USAGE,
                    "{--radius} of a mirror is a size, above 0 and finite: concave or convex says "
                    "the rest");
    }
    if (!isnan(question->radius)) {
        *power = pair_divide(pair_of(is_concave ? 2 : -2), pair_of(question->radius));
        return true;
    }
    if (is_concave && power->hi < 0) {
        return fail(error, ERROR_USAGE,
                    "a concave mirror has a focal length above 0: one below 0 is convex");
    }
    if (!is_concave && power->hi > 0) {
        *power = pair_negate(*power); /* a size too: it says no other than convex */
    }
    return true;
}

/* Of what is given by its number; NaN: nothing is. */
static bool ideal_power(const struct ideal_question *question, struct pair *power,
                        struct error *error)
{
    const int given = !isnan(question->focal) + !isnan(question->power) + !isnan(question->radius);
    *power = pair_of(NAN);
    if (given > 1) {
        return fail(error, ERROR_USAGE,
                    "{--focal-length}, {--power} and {--radius} exclude each other");
    }
    if (question->mirror == MIRROR_PLANE) {
        *power = pair_of(0);
        return given == 0 || fail(error, ERROR_USAGE, "a plane mirror has no focal length");
    }
    if (!isnan(question->radius) && question->mirror == MIRROR_NONE) {
        return fail(error, ERROR_USAGE,
                    "{--radius} is that of a mirror: {--mirror} concave or "
                    "convex; of a lens see lenscalc lensmaker");
    }
    if (question->focal == 0 || isinf(question->focal) || question->power == 0 ||
        isinf(question->power)) {
        return fail(error, ERROR_USAGE, "a lens has a finite {--%s} other than 0",
                    isnan(question->power) ? "focal-length" : "power");
    }
    if (!isnan(question->focal)) {
        *power = pair_divide(pair_of(1), pair_of(question->focal));
    } else if (!isnan(question->power)) {
        *power = pair_divide(pair_of(1), pair_of(1 / question->power)); /* 5 dpt are 200 mm */
    }
    return given == 0 || question->mirror == MIRROR_NONE || mirror_power(question, power, error);
}

static bool ideal_find_power(const struct ideal_question *question,
                             const struct thin_lens_given *given, struct pair *power,
                             struct error *error)
{
    if (question->then != NULL) {
        return fail(error, ERROR_USAGE, "{--then} wants the {--focal-length} of the first lens");
    }
    if (!thin_lens_power(given, power, error)) {
        const int count = !isnan(given->object) + !isnan(given->image) +
                          !isnan(given->magnification) + !isnan(given->total);
        return count < 2 &&
               error_hint(error, question->mirror == MIRROR_NONE
                                     ? "else give it: {--focal-length}, or a lens: {--lens}"
                                     : "else give it, or its radius: {--focal-length}, {--radius}");
    }
    const bool is_convex = power->hi < 0;
    if (power->hi == 0) {
        return fail(error, ERROR_DOMAIN,
                    "nothing with a focal length does that: object and image "
                    "coincide, of the same size");
    }
    return question->mirror == MIRROR_NONE || is_convex == (question->mirror == MIRROR_CONVEX) ||
           fail(error, ERROR_DOMAIN, "a %s mirror does not do that, but a %s one",
                ideal_mirrors[question->mirror].word, is_convex ? "convex" : "concave");
}

static void ideal_add_lens(struct lens_build *build, struct pair focal)
{
    struct surface *surface = lens_build_surface(build);
    surface->kind = SURFACE_THICK;
    surface->focal = figure_number(focal);
}

bool ideal_lens_make(const struct ideal_question *question, const struct thin_lens_given *given,
                     struct arena *arena, const struct lens **lens, struct error *error)
{
    struct ideal_element elements[MOST_THEN];
    size_t count = 0;
    struct pair power;
    struct lens_build build;
    struct lens *made = ARENA_NEW(arena, struct lens);
    if (question->lenses != NULL) {
        if (!lenses_read(question->lenses, elements, &count, error)) {
            return false;
        }
        power = pair_divide(pair_of(1), pair_of(elements[0].focal));
        count--;
        memmove(elements, elements + 1, count * sizeof *elements);
    } else if (!ideal_power(question, &power, error) ||
               (isnan(power.hi) && !ideal_find_power(question, given, &power, error)) ||
               (question->then != NULL && !then_read(question->then, elements, &count, error))) {
        return false;
    }
    lens_build_begin(&build, made, arena);
    if (question->mirror == MIRROR_NONE) {
        ideal_add_lens(&build, pair_divide(pair_of(1), power));
    } else {
        struct surface *mirror = lens_build_surface(&build);
        mirror->kind = SURFACE_REFLECT;
        mirror->has_curvature = true; /* hollow to the left, where the light comes from */
        mirror->curvature = figure_number(pair_divide(power, pair_of(-2)));
    }
    for (size_t i = 0; i < count; i++) {
        made->surfaces[i].thickness = figure_number(pair_of(elements[i].gap));
        ideal_add_lens(&build, pair_of(elements[i].focal));
    }
    if (question->mirror != MIRROR_NONE) {
        made->title = arena_printf(arena, "%s mirror", ideal_mirrors[question->mirror].word);
    } else {
        made->title = count == 0 ? "ideal thin lens"
                                 : arena_printf(arena, "%zu ideal thin lenses", count + 1);
    }
    *lens = made;
    return true;
}

const struct lens *ideal_lens_alone(const struct lens *lens, size_t index, struct arena *arena)
{
    struct lens *alone = ARENA_NEW(arena, struct lens);
    *alone = *lens;
    alone->object_medium = index > 0 ? lens->surfaces[index - 1].medium : lens->object_medium;
    alone->surfaces = &lens->surfaces[index];
    alone->surface_count = 1;
    return alone;
}
