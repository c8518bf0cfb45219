/* exchange/word_table.c - what becomes of each word of another program's lens files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/word_table.h"

#include <string.h>
#include <strings.h>

const char *word_fate_name(enum word_fate fate)
{
    static const char *const names[] = {[WORD_KEPT] = "kept",
                                        [WORD_HARMLESS] = "harmless",
                                        [WORD_LOST] = "lost",
                                        [WORD_REFUSED] = "refused"};
    return names[fate];
}

const char *word_list_find(const char *words, struct text word)
{
    for (const char *at = words; *at != '\0';) {
        size_t length = strcspn(at, " ");
        if (length == word.length && strncasecmp(at, word.start, length) == 0) {
            return at;
        }
        at += length + (at[length] == ' ');
    }
    return NULL;
}

const struct word_group *word_group_of(const struct word_group *table, const char *place,
                                       struct text word)
{
    for (; table->words != NULL; table++) {
        if ((place == NULL || strcmp(place, table->place) == 0) &&
            word_list_find(table->words, word) != NULL) {
            return table;
        }
    }
    return NULL;
}

enum loss_effect word_group_effect(const struct word_group *group)
{
    if ((group->flags & WORD_VIGNETTES) != 0) {
        return LOSS_OF_VIGNETTING;
    }
    return (group->flags & WORD_HAS_POWER) != 0 ? LOSS_OF_POWER : LOSS_OF_RAYS;
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
