/* cli/options/option_eyepiece.c - eyepieces, by their focal lengths or as real lenses. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>

/* A file or a name; what begins as a number does is one, "25mm". */
static bool eyepiece_is_lens(struct text text)
{
    for (size_t i = 0; i < text.length; i++) {
        const struct text rest = {text.start + i, text.length - i};
        if (text.start[i] == '/' || text_same(rest, ".lens")) {
            return true;
        }
    }
    const char first = text.length > 0 ? text.start[0] : '0';
    return (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') ||
           text_equal(text, "-");
}

static bool read_eyepiece(const struct reader *reader, const struct option *option,
                          struct text text, void *member, struct error *error)
{
    struct eyepiece_value value = {.focal = NAN};
    const bool done = eyepiece_is_lens(text_trim(text))
                          ? kind_lens.read(reader, option, text, &value.lens, error)
                          : kind_quantity.read(reader, option, text, &value.focal, error);
    *(struct eyepiece_value *)member = value;
    return done;
}

static const char *eyepiece_name(const struct option *option, const void *member)
{
    (void)option;
    return ((const struct eyepiece_value *)member)->lens.name;
}

static void eyepiece_set_number(void *member, double number, const struct unit *unit)
{
    (void)unit;
    *(struct eyepiece_value *)member = (struct eyepiece_value){.focal = number};
}

const struct option_kind kind_eyepiece = {
    .name = "eyepiece",
    .size = sizeof(struct eyepiece_value),
    .is_list = true,
    .read = read_eyepiece,
    .name_of = eyepiece_name,
    .number_of = option_first_number,
    .set_number = eyepiece_set_number,
    .reads = READS_LENSDB | READS_GLASSES | READS_LENSES,
    .nan_count = 1,
};
