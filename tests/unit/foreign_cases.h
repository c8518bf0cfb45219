/* tests/unit/foreign_cases.h - tables of lens files: what they mean, or why they are refused. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_FOREIGN_CASES_H
#define LENSCALC_TESTS_UNIT_FOREIGN_CASES_H

#include "check.h"
#include "exchange/lens_formats.h"
#include "file/lens_glass.h"

/*
 * A file is a good one in which `old` is replaced by `now`, once; an '@' in `now` is left out and
 * is the place that a message points at (without one the message has no line).
 */
struct refusal {
    const char *old, *now, *message; /* the whole message, without its place */
    const char *instead; /* null: no choice; else it is a loss: what --lossy does instead, or "" */
};

/* What the file says, as lines of a .lens file; several blanks are one. */
struct meaning {
    const char *old, *now, *lines;
};

/* One program run: the glasses and where everything lives. */
struct fixture {
    struct arena arena;
    struct lensdb db;
    struct lens_glasses place;
    struct glass_source glasses;
    struct foreign_job job;
    struct lens lens;
    struct error error;
};

static inline void fixture_open(struct fixture *fixture, const char *source)
{
    *fixture = (struct fixture){.arena = {0}};
    fixture->db = (struct lensdb){.arena = &fixture->arena};
    fixture->place = (struct lens_glasses){&fixture->db, &fixture->arena};
    fixture->glasses = lens_glass_source(&fixture->place);
    fixture->job = (struct foreign_job){
        .source = source, .arena = &fixture->arena, .glasses = &fixture->glasses};
}

/* The file of a case, and the line and column of its '@', 0 if there is none. */
static inline struct text case_file(struct fixture *fixture, const char *good, const char *old,
                                    const char *now, long *line, int *column)
{
    const char *at = strstr(good, old);
    CHECK(at != NULL);
    size_t before = at != NULL ? (size_t)(at - good) : 0;
    char *text = arena_array(&fixture->arena, strlen(good) + strlen(now) + 1, 1);
    memcpy(text, good, before);
    strcpy(text + before, now);
    char *mark = strchr(text + before, '@');
    strcat(text + before, good + before + strlen(old));
    *line = 0;
    *column = 0;
    if (mark != NULL) {
        memmove(mark, mark + 1, strlen(mark));
        *line = *column = 1;
        for (const char *c = text; c < mark; c++) {
            *line += *c == '\n';
            *column = *c == '\n' ? 1 : *column + 1;
        }
    }
    return text_of(text);
}

/* A message as it is wanted, at its place. */
static inline bool is_error(const struct error *error, long line, int column, const char *message)
{
    return error->code == ERROR_DATA && error->line == line && error->column == column &&
           strcmp(error->message, message) == 0;
}

/* With --lossy the same file is read, and its one loss listed at its line. */
static inline void check_loss(const char *source, const char *good, const struct refusal *one)
{
    struct fixture fixture;
    long line;
    int column;
    char what[600];
    fixture_open(&fixture, source);
    fixture.job.lossy = true;
    struct text file = case_file(&fixture, good, one->old, one->now, &line, &column);
    snprintf(what, sizeof what, "%s%s%s", one->message, one->instead[0] != '\0' ? "; " : "",
             one->instead);
    bool read = foreign_read(&fixture.job, file, &fixture.lens, &fixture.error);
    bool listed = fixture.job.loss_count == 1 && fixture.job.losses[0].line == line &&
                  strcmp(fixture.job.losses[0].what, what) == 0;
    if (!read || !listed) {
        printf("%s, lossy: %s; %zu losses, line %ld: %s\n", one->now,
               read ? "read" : fixture.error.message, fixture.job.loss_count,
               fixture.job.loss_count > 0 ? fixture.job.losses[0].line : 0,
               fixture.job.loss_count > 0 ? fixture.job.losses[0].what : "");
    }
    CHECK(read && listed);
    arena_free(&fixture.arena);
}

static inline void check_refusals(const char *source, const char *good, const struct refusal *cases,
                                  size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct refusal *one = &cases[i];
        struct fixture fixture;
        long line;
        int column;
        char message[600];
        fixture_open(&fixture, source);
        struct text file = case_file(&fixture, good, one->old, one->now, &line, &column);
        snprintf(message, sizeof message, "%s%s", one->instead != NULL ? "cannot be kept: " : "",
                 one->message);
        bool read = foreign_read(&fixture.job, file, &fixture.lens, &fixture.error);
        bool same = !read && is_error(&fixture.error, line, column, message);
        if (!same) {
            printf("%s\n    wanted %ld:%d: %s\n    found  %ld:%d: %s\n", one->now, line, column,
                   message, read ? 0 : fixture.error.line, read ? 0 : fixture.error.column,
                   read ? "read without a word" : fixture.error.message);
        }
        CHECK(same);
        arena_free(&fixture.arena);
        if (one->instead != NULL) {
            check_loss(source, good, one);
        }
    }
}

/* Several blanks as one, none at the end of a line; a line end before it. */
static inline const char *single_blanks(struct fixture *fixture, struct text text)
{
    char *line = arena_array(&fixture->arena, text.length + 2, 1), *to = line;
    *to++ = '\n';
    for (size_t i = 0; i < text.length; i++) {
        char c = text.start[i];
        to -= (c == '\n' || c == ' ') && to[-1] == ' ';
        *to++ = c;
    }
    return line;
}

static inline bool is_same_turn(const struct displacement *a, const struct displacement *b,
                                int turns)
{
    for (int i = 0; i < turns && a != NULL && b != NULL; i++) {
        if (a->tilt[i].value.hi != b->tilt[i].value.hi) {
            return false;
        }
    }
    return (a == NULL) == (b == NULL);
}

/* The digits of a lens say what its numbers are: read from them it has the same numbers. */
static inline bool is_as_typed(struct fixture *fixture, struct text typed)
{
    const struct foreign_format *json = foreign_by_name(text_of("json"));
    struct lens again;
    struct text one = {NULL, 0}, other = {NULL, 0};
    bool same =
        lens_read("typed", typed, &fixture->glasses, &fixture->arena, &again, &fixture->error) &&
        json->write(&fixture->job, &fixture->lens, &one, &fixture->error) &&
        json->write(&fixture->job, &again, &other, &fixture->error);
    same = same && one.length == other.length && memcmp(one.start, other.start, one.length) == 0;
    for (size_t i = 0; same && i < again.surface_count; i++) {
        same = is_same_turn(fixture->lens.surfaces[i].decentre, again.surfaces[i].decentre, 2) &&
               is_same_turn(fixture->lens.surfaces[i].coordinate_break,
                            again.surfaces[i].coordinate_break, 3);
    }
    for (size_t i = 0; same && i < again.field_count; i++) {
        const struct lens_field *meant = &fixture->lens.fields[i], *typed_one = &again.fields[i];
        same = meant->at[0].value.hi == typed_one->at[0].value.hi &&
               meant->at[1].value.hi == typed_one->at[1].value.hi &&
               meant->weight == typed_one->weight;
    }
    if (!same) {
        printf("typed and meant differ: %s\n%.*s\n%.*s\n", fixture->error.message, (int)one.length,
               one.start, (int)other.length, other.start);
    }
    return same;
}

static inline void check_meanings(const char *source, const char *good, const struct meaning *cases,
                                  size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct fixture fixture;
        long line;
        int column;
        char wanted[600];
        fixture_open(&fixture, source);
        struct text file = case_file(&fixture, good, cases[i].old, cases[i].now, &line, &column);
        bool read = foreign_read(&fixture.job, file, &fixture.lens, &fixture.error);
        const char *text = "";
        snprintf(wanted, sizeof wanted, "\n%s\n", cases[i].lines);
        if (read) {
            struct text typed = lens_write(&fixture.lens, &fixture.arena);
            text = single_blanks(&fixture, typed);
            CHECK(is_as_typed(&fixture, typed));
        }
        bool found = strstr(text, wanted) != NULL;
        if (!found) {
            printf("%s\n    wanted %s    found  %s\n", cases[i].now, wanted,
                   read ? text : fixture.error.message);
        }
        CHECK(found);
        arena_free(&fixture.arena);
    }
}

#define CASES(table) (table), sizeof(table) / sizeof(table)[0]

#endif
