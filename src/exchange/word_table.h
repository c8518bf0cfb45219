/* exchange/word_table.h - what becomes of each word of another program's lens files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_WORD_TABLE_H
#define LENSCALC_EXCHANGE_WORD_TABLE_H

#include "base/text.h"
#include "exchange/foreign.h"

#include <stdbool.h>
#include <stddef.h>

enum word_fate {
    WORD_KEPT,     /* read; what of it a lens cannot hold is a loss */
    WORD_HARMLESS, /* passed over: it cannot move a ray, stop one or change its weight */
    WORD_LOST,     /* a loss, but where its numbers are 0 and mean nothing */
    WORD_REFUSED   /* the file is refused even where losses are allowed */
};

enum word_flag {
    WORD_VIGNETTES = 1, /* as a loss it moves no ray: it only stops them or changes their weights */
    WORD_COUNTS_AT_0 = 2, /* lost even where its numbers are 0 */
    WORD_HAS_POWER = 4    /* as a loss it may change the focal length */
};

/* Words of one meaning and one fate. */
struct word_group {
    enum word_fate fate;
    const char *place; /* in the file: "system", "surface" .. */
    const char *what;  /* "colours of the editor" */
    const char *words; /* separated by blanks; null ends a table */
    unsigned flags;    /* enum word_flag */
};

/* "kept", "harmless", "lost", "refused" */
const char *word_fate_name(enum word_fate fate);

/* Where a word stands in a list of them with blanks between, without regard to case; or null. */
const char *word_list_find(const char *words, struct text word);

/*
 * The group that a word is of, without regard to case; null where none has it.
 *
 * Given     place  only groups of this place; null: of all
 */
const struct word_group *word_group_of(const struct word_group *table, const char *place,
                                       struct text word);

/* What is not as the file means it where a word of the group is left out, by its flags. */
enum loss_effect word_group_effect(const struct word_group *group);

/* One word of a table. */
struct word_entry {
    const struct word_group *group;
    struct text word;
};

/* Go to the next word of a table; begin with {table, {NULL, 0}}. False at its end. */
bool word_table_next(struct word_entry *entry);

#endif
