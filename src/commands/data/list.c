/* commands/data/list.c - what the topics of lenscalc list share. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"

const char *list_string(const struct list *list, struct text text)
{
    return text.length == 0 ? NULL : arena_string(list->run->arena, text.start, text.length);
}

/* Does a word occur in some text? */
static bool list_has_word(struct text word, const char *const *texts, size_t count)
{
    bool found = false;
    for (size_t i = 0; i < count && !found; i++) {
        found = texts[i] != NULL && text_contains_name(text_of(texts[i]), word);
    }
    return found;
}

bool list_matches(const struct list *list, const char *kind, const char *const *texts, size_t count)
{
    const struct list_input *input = list->input;
    if (input->kind != NULL &&
        (kind == NULL || !text_same_name(text_of(kind), text_of(input->kind)))) {
        return false;
    }
    if (input->search == NULL || list_has_word(text_of(input->search), texts, count)) {
        return true;
    }
    /* each word in some text: "canon mirrorless" asks for maker and class */
    struct text words = text_of(input->search);
    bool all = words.length > 0;
    while (words.length > 0 && all) {
        const struct text word = text_cut(&words, ' ');
        all = word.length == 0 || list_has_word(word, texts, count);
    }
    return all;
}

void list_row(struct list *list, const void *row)
{
    list->found++;
    run_emit(list->run, row);
}

void list_offer(struct list *list, const void *row, const char *kind, const char *const *texts,
                size_t count)
{
    if (list_matches(list, kind, texts, count)) {
        list_row(list, row);
    }
}

const char *list_place(enum lensdb_place place)
{
    return place == LENSDB_USER ? "own" : "embedded";
}
