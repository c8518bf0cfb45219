/* file/foreign.c - lens files of other programs: which there are, and what they lose. */
/* SPDX-License-Identifier: MIT */
#include "exchange/foreign.h"

#include "exchange/codev/codev.h"
#include "data/encoding.h"
#include "file/lens_glass.h"
#include "exchange/lens_json.h"
#include "exchange/oslo/oslo.h"
#include "exchange/pbrt.h"
#include "exchange/zemax/zemax.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const struct foreign_format *const foreign_formats[] = {
    &zemax_format, &codev_format, &oslo_format, &pbrt_format, &lens_json_format, NULL,
};

const struct foreign_format *foreign_by_name(struct text name)
{
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if (text_same(name, (*one)->name)) {
            return *one;
        }
    }
    return NULL;
}

static bool ends_with(struct text path, const char *ending)
{
    struct text last = text_of(ending);
    return path.length > last.length &&
           text_same((struct text){path.start + path.length - last.length, last.length}, ending);
}

const struct foreign_format *foreign_by_ending(struct text path)
{
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if (ends_with(path, (*one)->ending)) {
            return *one;
        }
    }
    return NULL;
}

const struct foreign_format *foreign_of(struct text source, struct text content)
{
    if (ends_with(source, ".lens")) {
        return NULL;
    }
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        if ((*one)->is_like(content)) {
            return *one;
        }
    }
    return foreign_by_ending(source);
}

static void add_loss(struct foreign_job *job, long line, const char *what)
{
    job->losses = arena_grow(job->arena, job->losses, job->loss_count, &job->loss_room,
                             sizeof job->losses[0]);
    job->losses[job->loss_count++] = (struct foreign_loss){line, what};
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
    return error_hint(error, "--lossy leaves it out and lists what is lost");
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
        growing_string(list, losses[i]->what);
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

/* Would the word be taken for a glass in a .lens file too? */
static bool is_glass_word(struct text name)
{
    char c = name.length > 0 ? name.start[0] : '\0';
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    return letter && memchr(name.start, '#', name.length) == NULL &&
           memchr(name.start, '{', name.length) == NULL &&
           memchr(name.start, '"', name.length) == NULL && !text_equal(name, "air") &&
           !text_equal(name, "mirror");
}

/* Ask the source for one name; true if it knows it. */
static bool ask(const struct foreign_job *job, const char *written, struct medium *medium,
                struct error *error)
{
    *medium = (struct medium){.kind = MEDIUM_GLASS, .written = text_of(written), .index = {1, 0}};
    if (!job->glasses->find(job->glasses->context, medium, error)) {
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

bool foreign_glass(struct foreign_job *job, const struct lens_words *words, struct text name,
                   const struct text *catalogs, size_t count, struct medium *medium,
                   struct error *error)
{
    if (job->glasses == NULL) {
        *medium = (struct medium){.kind = MEDIUM_GLASS, .written = name, .index = {1, 0}};
        return is_glass_word(name) ||
               lens_words_fail(words, name, error, "this cannot be the name of a glass");
    }
    for (size_t i = 0; i < count; i++) {
        if (ask_catalog(job, catalogs[i], name, medium, error)) {
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

bool foreign_read(struct foreign_job *job, struct text content, struct lens *lens,
                  struct error *error)
{
    struct text source = text_of(job->source), text = content;
    if (ends_with(source, ".lens")) {
        return lens_read(job->source, content, job->glasses, job->arena, lens, error);
    }
    if (ends_with(source, ".agf")) {
        fail(error, ERROR_DATA, "an AGF file is a catalogue of glasses, not a lens");
        error_locate(error, job->source, 0, 0);
        return error_hint(error, "--agf FILE adds its glasses");
    }
    bool is_text = encoding_to_utf8(job->source, content, job->arena, &text, error);
    const struct foreign_format *format = foreign_of(source, is_text ? text : content);
    if (format == NULL) {
        return lens_read(job->source, is_text ? text : content, job->glasses, job->arena, lens,
                         error);
    }
    if (!is_text) {
        return false;
    }
    if (format->read == NULL) {
        fail(error, ERROR_DATA, "lenscalc writes files of the format '%s' but does not read them",
             format->name);
        return error_locate(error, job->source, 0, 0);
    }
    return format->read(job, text, lens, error);
}

bool foreign_write(struct foreign_job *job, const struct foreign_format *format,
                   const struct lens *lens, struct text *text, struct error *error)
{
    for (size_t i = 0; i < lens->surface_count && !format->has_thick; i++) {
        if (lens->surfaces[i].kind == SURFACE_THICK) {
            return fail(error, ERROR_DATA,
                        "surface %zu is a thick lens: a %s file has none, only .lens and .json",
                        i + 1, format->ending);
        }
    }
    return format->write(job, lens, text, error);
}
