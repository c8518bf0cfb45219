/* exchange/foreign.c - lens files of other programs: their glasses, and what is lost. */
/* SPDX-License-Identifier: MIT */
#include "exchange/foreign.h"

#include "file/lens_glass.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_loss(struct foreign_job *job, long line, const char *what)
{
    job->losses = arena_grow(job->arena, job->losses, job->loss_count, &job->loss_room,
                             sizeof job->losses[0]);
    job->losses[job->loss_count++] = (struct foreign_loss){line, what};
}

const char *foreign_unit_named(const struct foreign_unit *units, struct text word)
{
    while (units->word != NULL && !text_same(word, units->word)) {
        units++;
    }
    return units->unit;
}

const char *foreign_unit_word(const struct foreign_unit *units, const char *unit)
{
    while (units->word != NULL && strcmp(units->unit, unit) != 0) {
        units++;
    }
    return units->word;
}

bool foreign_loss(struct foreign_job *job, const struct lens_words *words, struct text word,
                  struct error *error, const char *format, ...)
{
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    char *instead = strrchr(message, LOSS_INSTEAD[0]);
    if (instead != NULL) {
        *instead++ = '\0';
    }
    if (job->lossy) {
        add_loss(job, words != NULL ? words->number : 0,
                 arena_printf(job->arena, "%s%s%s", message, instead != NULL ? "; " : "",
                              instead != NULL ? instead : ""));
        return true;
    }
    if (words != NULL) {
        lens_words_fail(words, word, error, "cannot be kept: %s", message);
    } else {
        fail(error, ERROR_DATA, "cannot be kept: %s", message);
        error_locate(error, job->source, 0, 0);
    }
    return error_hint(error, "{lossy} leaves it out and lists what is lost");
}

/* By lines, those that were written last; the order of the list where they are equal. */
static int by_line(const void *a, const void *b)
{
    const struct foreign_loss *left = *(const struct foreign_loss *const *)a;
    const struct foreign_loss *right = *(const struct foreign_loss *const *)b;
    if (left->line != right->line) {
        return left->line == 0 || (right->line != 0 && left->line > right->line) ? 1 : -1;
    }
    return (left > right) - (left < right);
}

/* What was read goes to a terminal: '?' for control characters. */
static const char *printable(const char *words, struct arena *arena)
{
    char *copy = arena_string(arena, words, strlen(words));
    for (char *at = copy; *at != '\0'; at++) {
        unsigned char c = (unsigned char)*at, next = (unsigned char)at[1];
        bool wide = c == 0xc2 && next >= 0x80 && next < 0xa0; /* U+0080 to U+009F */
        at[0] = wide || c < 0x20 || c == 0x7f ? '?' : at[0];
        at[wide ? 1 : 0] = wide ? '?' : at[0];
    }
    return copy;
}

void foreign_losses(const struct foreign_job *job, struct growing *list)
{
    const struct foreign_loss **losses =
        ARENA_ARRAY(job->arena, job->loss_count, const struct foreign_loss *);
    for (size_t i = 0; i < job->loss_count; i++) {
        losses[i] = &job->losses[i];
    }
    qsort(losses, job->loss_count, sizeof losses[0], by_line);
    for (size_t i = 0; i < job->loss_count; i++) {
        growing_string(list, job->source);
        if (losses[i]->line > 0) {
            growing_format(list, ":%ld", losses[i]->line);
        }
        growing_string(list, ": lost: ");
        growing_string(list, printable(losses[i]->what, job->arena));
        growing_string(list, "\n");
    }
}

/* A word of a .lens file has no blanks; names of glasses are the same without them. */
static struct text without_blanks(struct arena *arena, const char *name)
{
    char *word = arena_string(arena, name, strlen(name)), *to = word;
    for (const char *from = name; *from != '\0'; from++) {
        *to = *from;
        to += *from != ' ';
    }
    *to = '\0';
    return text_of(word);
}

/* Without what a .lens file refuses: blanks, delete and the control characters of C0 and C1. */
static bool is_plain(struct text name)
{
    unsigned char before = 0;
    for (size_t i = 0; i < name.length; i++) {
        unsigned char one = (unsigned char)name.start[i];
        if (one <= 0x20 || one == 0x7f || (before == 0xc2 && one >= 0x80 && one < 0xa0)) {
            return false;
        }
        before = one;
    }
    return true;
}

/* Would the word be taken for a glass in a .lens file too? */
static bool is_glass_word(struct text name)
{
    char c = name.length > 0 ? name.start[0] : '\0';
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    return letter && is_plain(name) && memchr(name.start, '#', name.length) == NULL &&
           memchr(name.start, '{', name.length) == NULL &&
           memchr(name.start, '"', name.length) == NULL && !text_equal(name, "air") &&
           !text_equal(name, "mirror");
}

/* Ask the source for one name; true if it knows it. */
static bool ask(const struct foreign_job *job, const char *written, struct medium *medium,
                struct error *error)
{
    *medium = (struct medium){.kind = MEDIUM_GLASS, .written = text_of(written), .index = {1, 0}};
    if (!job->glasses->find_foreign(job->glasses->context, medium, error)) {
        return false;
    }
    const struct glass *glass = lens_glass_of(medium);
    if (glass != NULL && glass->catalog.length > 0) { /* as the catalogue spells it */
        medium->written = without_blanks(
            job->arena,
            arena_printf(job->arena, "%.*s:%.*s", (int)glass->catalog.length, glass->catalog.start,
                         (int)glass->name.length, glass->name.start));
    }
    return true;
}

/* Ask one catalogue; "CDGM-ZEMAX201409" and "OHARA_2021-04" are editions of CDGM and OHARA. */
static bool ask_catalog(const struct foreign_job *job, struct text catalog, struct text name,
                        struct medium *medium, struct error *error)
{
    size_t maker = 0;
    while (maker < catalog.length && catalog.start[maker] != '-' && catalog.start[maker] != '_') {
        maker++;
    }
    return ask(job,
               arena_printf(job->arena, "%.*s:%.*s", (int)catalog.length, catalog.start,
                            (int)name.length, name.start),
               medium, error) ||
           (maker < catalog.length && ask(job,
                                          arena_printf(job->arena, "%.*s:%.*s", (int)maker,
                                                       catalog.start, (int)name.length, name.start),
                                          medium, error));
}

bool foreign_glass(struct foreign_job *job, const struct lens_words *words,
                   const struct foreign_name *named, struct medium *medium, struct error *error)
{
    const struct text name = named->name;
    if (job->glasses == NULL) {
        *medium = (struct medium){.kind = MEDIUM_GLASS, .written = name, .index = {1, 0}};
        return is_glass_word(name) ||
               lens_words_fail(words, name, error, "this cannot be the name of a glass");
    }
    for (size_t i = 0; i < named->catalog_count; i++) {
        if (ask_catalog(job, named->catalogs[i], name, medium, error)) {
            return true;
        }
    }
    if (ask(job, arena_string(job->arena, name.start, name.length), medium, error)) {
        return true;
    }
    const struct error found = *error;
    if (strncmp(found.message, "several ", 8) != 0) { /* not a homonym: unknown */
        error->code = ERROR_NONE;
        return false;
    }
    lens_words_fail(words, name, error, "%s", found.message);
    return error_hint(error, "%s", found.hint);
}
