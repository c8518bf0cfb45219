/* cli/options/option_field.c - read fields of a lens. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>

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

bool field_has_weight(struct text text)
{
    struct field_item item;
    struct text weight;
    struct error ignored;
    return field_item_read(text, &item, &weight, &ignored) && weight.start != NULL;
}

bool field_refuse_weight(const char *option, struct text text, struct error *error)
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

const struct option_kind kind_fields = {
    .name = "fields",
    .size = sizeof(struct fields_value),
    .read = fields_value_read,
};
