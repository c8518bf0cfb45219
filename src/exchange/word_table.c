/* exchange/word_table.c - what becomes of each word of another program's lens files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/word_table.h"

#include "exchange/foreign.h"

#include <string.h>

const char *word_fate_name(enum word_fate fate)
{
    static const char *const names[] = {[WORD_KEPT] = "kept",
                                        [WORD_HARMLESS] = "harmless",
                                        [WORD_LOST] = "lost",
                                        [WORD_REFUSED] = "refused"};
    return names[fate];
}

static bool word_table_is_same(const char *word, struct text typed)
{
    for (size_t i = 0; i < typed.length; i++) {
        char c = typed.start[i];
        if (word[i] != (c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c)) {
            return false;
        }
    }
    return true;
}

/* Words of a table are in capitals. */
static bool word_table_has_word(const char *words, struct text word)
{
    for (const char *at = words; *at != '\0';) {
        size_t length = strcspn(at, " ");
        if (length == word.length && word_table_is_same(at, word)) {
            return true;
        }
        at += length + (at[length] == ' ');
    }
    return false;
}

const struct word_group *word_group_of(const struct word_group *table, const char *place,
                                       struct text word)
{
    for (; table->words != NULL; table++) {
        if ((place == NULL || strcmp(place, table->place) == 0) &&
            word_table_has_word(table->words, word)) {
            return table;
        }
    }
    return NULL;
}

const char *word_group_marks(const struct word_group *group)
{
    if ((group->flags & WORD_VIGNETTES) != 0) {
        return LOSS_VIGNETTES;
    }
    if ((group->flags & WORD_HAS_POWER) != 0) {
        return LOSS_OF_POWER;
    }
    return "";
}

bool word_table_next(struct word_entry *entry)
{
    const char *at = entry->word.start;
    at = at == NULL ? entry->group->words : at + entry->word.length;
    while (at != NULL && *at == '\0') {
        entry->group++;
        at = entry->group->words;
    }
    if (at == NULL) {
        return false;
    }
    at += *at == ' ';
    entry->word = (struct text){at, strcspn(at, " ")};
    return true;
}
