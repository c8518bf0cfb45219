/* commands/data/list_keywords.c - lenscalc list keywords. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "exchange/lens_formats.h"
#include "exchange/word_table.h"

struct keyword_row {
    const char *keyword, *format, *place, *fate, *what;
};

#define KEYWORD(member) COLUMN(struct keyword_row, member)

static const struct column keyword_columns[] = {
    {KEYWORD(keyword), .name = "keyword", .flags = COLUMN_BRIEF, .label = "keyword",
     .help = "the word"},
    {KEYWORD(format), .name = "format", .flags = COLUMN_BRIEF, .label = "format",
     .help = "the kind of file it is of"},
    {KEYWORD(place), .name = "place", .flags = COLUMN_BRIEF, .label = "place",
     .help = "where in the file it stands"},
    {KEYWORD(fate), .name = "fate", .flags = COLUMN_BRIEF, .label = "fate",
     .help = "kept (what a lens cannot hold of it is a loss), harmless, lost or refused"},
    {KEYWORD(what), .name = "meaning", .flags = COLUMN_BRIEF, .label = "meaning",
     .help = "what it says"},
};

static bool list_keywords(struct list *list, struct error *error)
{
    (void)error;
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        struct word_entry entry = {(*one)->words, {NULL, 0}};
        while (entry.group != NULL && word_table_next(&entry)) {
            const struct keyword_row row = {list_string(list, entry.word), (*one)->type.word.word,
                                            entry.group->place, word_fate_name(entry.group->fate),
                                            entry.group->what};
            if (list_matches(list, row.format, (const char *[]){row.keyword, row.fate, row.what},
                             3)) {
                list_row(list, &row);
            }
        }
    }
    return true;
}

const struct topic topic_keywords = {SHEET(keyword_columns, struct keyword_row), list_keywords};
