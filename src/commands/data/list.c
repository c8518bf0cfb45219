/* commands/data/list.c - what the topics of lenscalc list share. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"

const char *list_string(const struct list *list, struct text text)
{
    return text.length == 0 ? NULL : arena_string(list->run->arena, text.start, text.length);
}

/* Does each word occur in some text? "canon mirrorless" asks for maker and class. */
static bool list_has_all_words(struct text words, const char *const *texts, size_t count)
{
    bool all = words.length > 0;
    while (words.length > 0 && all) {
        struct text word = text_cut(&words, ' ');
        bool found = word.length == 0;
        for (size_t i = 0; i < count && !found; i++) {
            found = texts[i] != NULL && text_contains_name(text_of(texts[i]), word);
        }
        all = found;
    }
    return all;
}

bool list_matches(const struct list *list, const char *kind, const char *const *texts, size_t count)
{
    const struct list_input *input = list->input;
    if (input->kind != NULL &&
        (kind == NULL || !text_same_name(text_of(kind), text_of(input->kind)))) {
        return false;
    }
    bool found = input->search == NULL;
    for (size_t i = 0; i < count && !found; i++) {
        found = texts[i] != NULL && text_contains_name(text_of(texts[i]), text_of(input->search));
    }
    return found || list_has_all_words(text_of(input->search), texts, count);
}

void list_row(struct list *list, const void *row)
{
    list->found++;
    run_emit(list->run, row);
}

const char *list_place(enum lensdb_place place)
{
    return place == LENSDB_USER ? "own" : "embedded";
}
