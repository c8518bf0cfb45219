/* cli/options/option_part.c - which part of a divided run. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

static bool option_part_read_part(const struct reader *reader, const struct option *option,
                                  struct text text, void *member, struct error *error)
{
    (void)reader;
    return part_parse(text_trim(text), member, error) ||
           error_prefix(error, "%s: ", CALLED(option));
}

const struct option_kind kind_part = {
    .name = "part",
    .size = sizeof(struct part),
    .read = option_part_read_part,
};
