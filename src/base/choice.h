/* base/choice.h - a word that is none of those that may stand there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_CHOICE_H
#define LENSCALC_BASE_CHOICE_H

#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* What may stand there; start with { .typed = ... } and offer all, in their order. */
struct choice {
    struct text typed; /* as it stands, with blanks about it */
    struct nearest nearest;
    char all[256];
    size_t length; /* of that */
};

void choice_offer(struct choice *choice, const char *word);

/*
 * Say which words may stand there, and the one that may have been meant; error_prefix says where.
 * Returns false.
 */
bool choice_refuse(const struct choice *choice, struct error *error);

#endif
