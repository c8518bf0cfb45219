/* cli/options/option_field.h - fields of a lens: one at a time, or a set with weights. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_FIELD_H
#define LENSCALC_CLI_OPTIONS_OPTION_FIELD_H

#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* One of a set. A number without a unit is both: degrees of a far object, mm of a near one. */
struct field_item {
    double angle;  /* rad; NaN: a length was typed */
    double height; /* mm; NaN: an angle was typed */
    double weight; /* 1 unless typed */
};

/* A set that is judged as a whole: 0,10:2,14deg. */
struct fields_value {
    const char *text; /* as typed; null = not given */
    const struct field_item *items;
    size_t count;
};

enum { MOST_FIELDS = 64 };

/* Is it a field with a weight, "10:2"? */
bool field_has_weight(struct text text);

/* Where each field has an answer of its own a weight would be lost without a word. */
bool field_refuse_weight(const char *option, struct text text, struct error *error);

#endif
