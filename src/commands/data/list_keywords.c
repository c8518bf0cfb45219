/* commands/data/list_keywords.c - lenscalc list keywords. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"
#include "exchange/lens_formats.h"
#include "exchange/word_table.h"

struct keyword_row {
    const char *keyword, *format, *place, *fate, *what;
};

#define ROW struct keyword_row

static const struct column keyword_columns[] = {
    {SHOWN(keyword), .name = "keyword", BRIEF, .help = "the word"},
    {SHOWN(format), .name = "format", BRIEF, .help = "the kind of file it is of"},
    {SHOWN(place), .name = "place", BRIEF, .help = "where in the file it stands"},
    {SHOWN(fate), .name = "fate", BRIEF,
     .help = "kept (what a lens cannot hold of it is a loss), harmless, lost or refused"},
    {SHOWN(what), .name = "meaning", BRIEF, .help = "what it says"},
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

const struct topic topic_keywords = {SHEET(keyword_columns, struct keyword_row), list_keywords,
                                     false};
