/* commands/data/list.h - the topics of lenscalc list. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DATA_LIST_H
#define LENSCALC_COMMANDS_DATA_LIST_H

#include "cli/question/command.h"

struct list_input {
    int topic;
    const char *search, *kind;
};

/* A list being made. */
struct list {
    const struct list_input *input;
    const struct topic *topic;
    struct run *run;
    enum lensdb_place place; /* whose rows are listed */
    size_t found;
};

/* One thing to list: its rows and where they come from. */
struct topic {
    struct sheet sheet;
    bool (*list)(struct list *list, struct error *error);
    bool is_of_places; /* called for the user's rows, and again for those of the program */
};

/* A text that lives as long as a row; null where it is empty. */
const char *list_string(const struct list *list, struct text text);

/*
 * Is the row wanted? It must be of the kind that is asked for, and one of the texts must contain
 * what is searched for, or all texts together each of its words. Null texts contain nothing.
 */
bool list_matches(const struct list *list, const char *kind, const char *const *texts,
                  size_t count);

/* Hand out one row; the second does so only if it is wanted: the texts as for list_matches. */
void list_row(struct list *list, const void *row);
void list_offer(struct list *list, const void *row, const char *kind, const char *const *texts,
                size_t count);

/* Where a row of the database comes from: "own" or "embedded". */
const char *list_place(enum lensdb_place place);

extern const struct topic topic_lenses, topic_formats, topic_cameras, topic_films, topic_scenes,
    topic_filters, topic_stops, topic_tolerances, topic_units, topic_commands, topic_options,
    topic_glasses, topic_keywords, topic_columns, topic_config;

#endif
