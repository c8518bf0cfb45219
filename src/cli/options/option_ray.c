/* cli/options/option_ray.c - read the values of ray commands. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>

/* Say which option was wrong, before what was wrong. */
static bool ray_blame(const struct option *option, struct text text, struct error *error)
{
    return error_prefix(error, "bad value in %s '%.*s': ", TYPED(option, text));
}

/* `count` numbers with ':' between them; a unit behind the last counts for all that have none. */
static bool colon_numbers_read(const struct option *option, struct text text, double *at, int count,
                               struct error *error)
{
    const struct unit *unit = option_unit(option), *typed = NULL;
    struct text parts[3], rest = text_trim(text);
    int found = 0;
    for (; rest.start != NULL && found < count; found++) {
        parts[found] = text_trim(text_cut(&rest, ':'));
    }
    if (found < count || rest.start != NULL) {
        fail(error, ERROR_USAGE, "%s '%.*s' is not %s", TYPED(option, text), option->value);
        return error_hint(error, "%d numbers with ':' between them: %s", count,
                          count == 3 ? "0:10:-20" : "0:0.7");
    }
    for (int i = count; i-- > 0;) {
        if (!quantity_read(parts[i], option->dimension, unit, &at[i],
                           i == count - 1 ? &typed : NULL, error)) {
            error_within(error, text, parts[i]);
            return ray_blame(option, text, error);
        }
        unit = typed != NULL ? typed : unit;
        if (isinf(at[i])) {
            return fail(error, ERROR_DOMAIN, "%s cannot be infinite", CALLED(option));
        }
    }
    return true;
}

static bool read_vector(const struct reader *reader, const struct option *option, struct text text,
                        void *member, struct error *error)
{
    struct vector_value *vector = member;
    (void)reader;
    vector->is_given = true;
    return colon_numbers_read(option, text, vector->at, 3, error);
}

static bool read_pupil(const struct reader *reader, const struct option *option, struct text text,
                       void *member, struct error *error)
{
    struct pupil_value *pupil = member;
    (void)reader;
    pupil->is_given = true;
    return colon_numbers_read(option, text, pupil->at, 2, error);
}

/* The numbers as read_numbers takes them. */
static const char *colon_numbers_words(const struct option *option, const double *at, int count,
                                       struct arena *arena)
{
    const struct unit *unit = option_unit(option);
    const char *words = "";
    for (int i = 0; i < count; i++) {
        char number[NUMBER_LENGTH + 1];
        *quantity_write(number, at[i], unit) = '\0';
        words = arena_printf(arena, "%s%s%s", words, i > 0 ? ":" : "", number);
    }
    return arena_printf(arena, "%s%s", words, unit != NULL ? unit->name : "");
}

static const char *vector_words(const struct option *option, const void *member,
                                struct arena *arena)
{
    const struct vector_value *vector = member;
    return vector->is_given ? colon_numbers_words(option, vector->at, 3, arena) : NULL;
}

static const char *pupil_words(const struct option *option, const void *member, struct arena *arena)
{
    const struct pupil_value *pupil = member;
    return pupil->is_given ? colon_numbers_words(option, pupil->at, 2, arena) : NULL;
}

static bool plane_value_read(const struct reader *reader, const struct option *option,
                             struct text text, void *member, struct error *error)
{
    static const struct {
        const char *word;
        enum plane_kind kind;
    } words[] = {{"paraxial", PLANE_PARAXIAL}, {"table", PLANE_TABLE}, {"best", PLANE_BEST}};
    struct plane_value *plane = member;
    struct text trimmed = text_trim(text);
    (void)reader;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (text_same(trimmed, words[i].word)) {
            *plane = (struct plane_value){words[i].kind, NAN};
            return true;
        }
    }
    plane->kind = PLANE_AT;
    if (!quantity_read(text, option->dimension, option_unit(option), &plane->distance, NULL,
                       error)) {
        ray_blame(option, text, error);
        return error_hint(error, "paraxial, table, best, or a distance from the last vertex");
    }
    return !isinf(plane->distance) ||
           fail(error, ERROR_DOMAIN, "%s cannot be infinite", CALLED(option));
}

static bool read_target(const struct reader *reader, const struct option *option, struct text text,
                        void *member, struct error *error)
{
    struct target_value *target = member;
    struct text trimmed = text_trim(text);
    double number;
    (void)reader;
    if (text_same(trimmed, "image") || text_same(trimmed, "last")) {
        target->kind = text_same(trimmed, "image") ? TARGET_IMAGE : TARGET_LAST;
        return true;
    }
    if (!quantity_read(text, &dimension_number, NULL, &number, NULL, error) ||
        number != floor(number) || !(number >= 1 && number <= 1e6)) {
        fail(error, ERROR_USAGE, "%s '%.*s' is neither image, last nor the number of a surface",
             TYPED(option, text));
        return error_hint(error, "surfaces count from 1, the stop counted");
    }
    *target = (struct target_value){TARGET_SURFACE, (long)number};
    return true;
}

const struct option_kind kind_vector = {
    .name = "vector",
    .size = sizeof(struct vector_value),
    .is_list = true,
    .read = read_vector,
    .words_of = vector_words,
};

const struct option_kind kind_pupil = {
    .name = "pupil",
    .size = sizeof(struct pupil_value),
    .is_list = true,
    .read = read_pupil,
    .words_of = pupil_words,
};

const struct option_kind kind_plane = {
    .name = "plane",
    .size = sizeof(struct plane_value),
    .read = plane_value_read,
};

const struct option_kind kind_target = {
    .name = "target",
    .size = sizeof(struct target_value),
    .read = read_target,
};
