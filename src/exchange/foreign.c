/* exchange/foreign.c - lens files of other programs: their glasses, and what is lost. */
/* SPDX-License-Identifier: MIT */
#include "exchange/foreign.h"

#include "file/lens_glass.h"
#include "optics/wavelength.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

bool foreign_loss(struct foreign_job *job, const struct file_words *words, struct text word,
                  enum loss_effect effect, const char *instead, const char *format, ...)
{
    char message[sizeof((struct error *)NULL)->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    struct foreign_loss *loss = ARENA_ADD(job->arena, job->losses, job->loss_count, job->loss_room);
    *loss = (struct foreign_loss){.effect = effect == LOSS_OF_POWER ? LOSS_OF_RAYS : effect,
                                  .message = arena_string(job->arena, message, strlen(message)),
                                  .word = word};
    loss->what =
        instead != NULL ? arena_printf(job->arena, "%s; %s", message, instead) : loss->message;
    if (effect == LOSS_OF_POWER && job->lost_power == NULL) {
        job->lost_power = loss->message;
    }
    if (words != NULL) {
        loss->line = words->number;
        loss->line_of = *words;
    }
    return true;
}

void foreign_forget_repeated(struct foreign_job *job, size_t from)
{
    size_t count = from;
    for (size_t i = from; i < job->loss_count; i++) {
        bool again = false;
        for (size_t k = 0; k < from && !again; k++) {
            again = job->losses[k].line == job->losses[i].line &&
                    strcmp(job->losses[k].message, job->losses[i].message) == 0;
        }
        if (!again) {
            job->losses[count++] = job->losses[i];
        }
    }
    job->loss_count = count;
}

void foreign_mark_power(const struct foreign_job *job, struct lens_build *build)
{
    if (job->lost_power != NULL) {
        struct text text = text_of(arena_printf(
            job->arena, "the focal length may not be that of %s, where this is lost: %s",
            job->source, job->lost_power));
        lens_build_note(build, text);
        build->lens->lost_power = lens_build_string(build, text);
    }
}

void foreign_cut_short(struct foreign_job *job, const char *what)
{
    if (job->cut_short == NULL) {
        job->cut_short = arena_printf(job->arena, "the file may be cut short: %s", what);
    }
}

/* By lines, those that were written last; the order of the list where they are equal. */
static int losses_by_line(const void *a, const void *b)
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

/* The worst first, and equal ones together. */
static int losses_by_effect(const void *a, const void *b)
{
    const struct foreign_loss *left = *(const struct foreign_loss *const *)a;
    const struct foreign_loss *right = *(const struct foreign_loss *const *)b;
    int words = strcmp(left->message, right->message);
    if (left->effect != right->effect) {
        return left->effect < right->effect ? -1 : 1;
    }
    return words != 0 ? words : losses_by_line(a, b);
}

static const struct foreign_loss **sorted_losses(const struct foreign_job *job,
                                                 int (*order)(const void *, const void *))
{
    const struct foreign_loss **losses =
        ARENA_ARRAY(job->arena, job->loss_count, const struct foreign_loss *);
    for (size_t i = 0; i < job->loss_count; i++) {
        losses[i] = &job->losses[i];
    }
    if (job->loss_count > 0) {
        qsort(losses, job->loss_count, sizeof losses[0], order);
    }
    return losses;
}

/* The same loss in several lines. */
struct same_losses {
    const struct foreign_loss *const *first;
    size_t count;
};

static int same_losses_by_effect(const void *a, const void *b)
{
    const struct same_losses *left = a, *right = b;
    if (left->first[0]->effect != right->first[0]->effect) {
        return left->first[0]->effect < right->first[0]->effect ? -1 : 1;
    }
    return losses_by_line(left->first, right->first);
}

/* All losses, each once: those that change most first, then in the order of the file. */
static struct same_losses *same_losses(const struct foreign_job *job, size_t *count)
{
    const struct foreign_loss **losses = sorted_losses(job, losses_by_effect);
    struct same_losses *all = ARENA_ARRAY(job->arena, job->loss_count, struct same_losses);
    *count = 0;
    for (size_t i = 0; i < job->loss_count; i++) {
        struct same_losses *last = *count > 0 ? &all[*count - 1] : NULL;
        if (last != NULL && last->first[0]->effect == losses[i]->effect &&
            strcmp(last->first[0]->message, losses[i]->message) == 0) {
            last->count++;
        } else {
            all[(*count)++] = (struct same_losses){&losses[i], 1};
        }
    }
    qsort(all, *count, sizeof all[0], same_losses_by_effect);
    return all;
}

static const char *const changes[LOSS_EFFECTS] = {[LOSS_OF_LENS] = "all",
                                                  [LOSS_OF_RAYS] = "rays",
                                                  [LOSS_OF_VIGNETTING] = "vignetting",
                                                  [LOSS_OF_NOTHING] = "nothing"};

/* "12,15,18": the lines of a loss but for the first `after`, with a character before them. */
static void put_loss_lines(struct text_buffer *list, const struct same_losses *same, size_t after,
                           const char *before)
{
    for (size_t k = after; k < same->count && same->first[k]->line > 0; k++) {
        growing_format(list, "%s%ld", k == after ? before : ",", same->first[k]->line);
    }
}

/* "FILE:12,15,18: WHAT" under the head of what they change; `after` of the first are known. */
static const char *list_of_losses(const struct foreign_job *job, const struct same_losses *all,
                                  size_t count, size_t after)
{
    struct text_buffer list = {.arena = job->arena};
    enum loss_effect head = LOSS_EFFECTS;
    for (size_t i = 0; i < count; i++, after = 0) {
        if (all[i].count == after) {
            continue;
        }
        if (all[i].first[0]->effect != head) {
            head = all[i].first[0]->effect;
            growing_format(&list, "    cannot be kept either, and changes %s:\n", changes[head]);
        }
        growing_format(&list, "      %s", job->source);
        put_loss_lines(&list, &all[i], after, ":");
        growing_format(&list, ": %s\n", printable(all[i].first[0]->message, job->arena));
    }
    return list.length > 0 ? arena_string(job->arena, list.data, list.length) : NULL;
}

void foreign_summary(const struct foreign_job *job, struct text_buffer *line)
{
    size_t count = 0;
    const struct same_losses *all = job->loss_count > 0 ? same_losses(job, &count) : NULL;
    enum loss_effect head = LOSS_EFFECTS;
    for (size_t i = 0; i < count; i++) {
        growing_string(line, i > 0 ? "; " : "");
        if (all[i].first[0]->effect != head) {
            head = all[i].first[0]->effect;
            growing_format(line, "%s: ", changes[head]);
        }
        put_loss_lines(line, &all[i], 0, "");
        growing_format(line, "%s%s", all[i].first[0]->line > 0 ? ": " : "",
                       printable(all[i].first[0]->message, job->arena));
    }
}

bool foreign_settle(const struct foreign_job *job, bool done, struct error *error)
{
    bool fatal = false;
    for (size_t i = 0; i < job->loss_count; i++) {
        fatal = fatal || job->losses[i].effect == LOSS_OF_LENS;
    }
    if (job->loss_count == 0 || (job->lossy && !fatal)) {
        return done;
    }
    size_t count;
    const struct same_losses *all = same_losses(job, &count);
    if (!done && error->line > 0 && !fatal) {
        error->more = list_of_losses(job, all, count, 0);
        return false;
    }
    const char *then = done ? NULL : arena_printf(job->arena, "    and then: %s\n", error->message);
    /* The loss that changes most, as an error at its place. */
    const struct foreign_loss *first = all[0].first[0];
    const char *prefix = first->effect == LOSS_OF_LENS ? "" : "cannot be kept: ";
    if (first->line > 0) {
        struct file_words line = first->line_of;
        line.error = error;
        file_words_fail(&line, first->word, "%s%s", prefix, first->message);
    } else {
        foreign_fail(job, error, "%s%s", prefix, first->message);
    }
    error->more = list_of_losses(job, all, count, 1);
    if (then != NULL) { /* what has no place may well follow from what is left out */
        error->more = ARENA_JOIN(job->arena, error->more != NULL ? error->more : "", then);
        return false;
    }
    /* What can be done about it. */
    if (all[0].first[0]->effect == LOSS_OF_LENS) { /* only a glass is such a loss */
        return error_hint(error, "{agf} FILE adds a catalogue");
    }
    const char *lost = job->loss_count > 1 ? "them" : "it";
    if (job->lacks_glass) {
        return error_hint(
            error, "{agf} FILE adds a catalogue; {lossy} leaves %s out and lists what is lost",
            lost);
    }
    return error_hint(error, "{lossy} leaves %s out and lists what is lost", lost);
}

bool foreign_lack(struct foreign_job *job, const struct file_words *words, struct text word,
                  struct medium *medium, const char *message)
{
    *medium =
        (struct medium){.kind = MEDIUM_CONSTANT, .written = text_of("1.5"), .index = {1.5, 0}};
    job->lacks_glass = true;
    return foreign_loss(job, words, word, LOSS_OF_LENS, NULL, "%s", message);
}

void foreign_losses(const struct foreign_job *job, struct text_buffer *list)
{
    const struct foreign_loss **losses = sorted_losses(job, losses_by_line);
    for (size_t i = 0; i < job->loss_count; i++) {
        growing_string(list, job->source);
        if (losses[i]->line > 0) {
            growing_format(list, ":%ld", losses[i]->line);
        }
        growing_format(list, ": lost: %s\n", printable(losses[i]->what, job->arena));
    }
}

/* Without what a .lens file refuses: blanks, delete and the control characters of C0 and C1. */
static bool foreign_is_plain(struct text name)
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
    return letter && foreign_is_plain(name) && memchr(name.start, '#', name.length) == NULL &&
           memchr(name.start, '{', name.length) == NULL &&
           memchr(name.start, '"', name.length) == NULL && !text_equal(name, "air") &&
           !text_equal(name, "mirror");
}

typedef bool find_function(void *context, struct medium *medium, struct error *error);

/* Is it within these distances of what the file says? */
static bool foreign_is_near(struct glass_abbe abbe, const struct foreign_name *named,
                            double most_nd, double most_Vd)
{
    return fabs(abbe.nd - named->nd) <= most_nd &&
           (!(named->Vd > 0) || !(fabs(abbe.Vd - named->Vd) > most_Vd));
}

/* Of a glass that is for the d line, where the file has figures of it. */
static bool foreign_is_within(const struct medium *medium, const struct foreign_name *named,
                              double most_nd, double most_Vd)
{
    const struct glass *glass = lens_glass_of(medium);
    if (glass == NULL || !(named->nd > 1) || WAVELENGTH_D < glass->shortest ||
        WAVELENGTH_D > glass->longest) {
        return true;
    }
    return foreign_is_near(glass_abbe(glass), named, most_nd, most_Vd) ||
           foreign_is_near(lens_glass_printed(medium), named, most_nd, most_Vd);
}

bool foreign_is_rounded(const struct medium *medium, const struct foreign_name *named)
{
    const double printed_nd = 5.5e-6, printed_Vd = 5.5e-3; /* half of the last digit */
    return foreign_is_within(medium, named, named->nd_rounding + printed_nd,
                             named->Vd_rounding + printed_Vd);
}

char *foreign_difference(const struct foreign_job *job, const struct foreign_name *named,
                         const struct medium *medium)
{
    const struct glass_abbe printed = lens_glass_printed(medium);
    const struct glass_abbe is =
        printed.nd > 1 && printed.Vd > 0 ? printed : glass_abbe(lens_glass_of(medium));
    char *what = arena_printf(
        job->arena,
        "the glass '%.*s' is %.*s of nd %.6g and Vd %.5g, beside which the file has nd %.6g and "
        "Vd %.5g",
        text_shown(named->name), named->name.start, text_shown(medium->written),
        medium->written.start, is.nd, is.Vd, named->nd, named->Vd);
    text_make_printable(what, "");
    return what;
}

void foreign_warn(const struct foreign_job *job, struct medium *medium, const char *warning)
{
    medium->warning = medium->warning == NULL
                          ? warning
                          : arena_printf(job->arena, "%s; %s", medium->warning, warning);
}

/* A glass being looked for. */
struct glass_search {
    const struct foreign_job *job;
    const struct foreign_name *named;
    struct medium *medium;
    struct medium other; /* the first of the name that has another nd or Vd */
    bool has_other;
};

/* The numbers of the file have decided against the glass of an earlier catalogue. */
static void warn_of_homonym(const struct glass_search *search)
{
    struct medium *medium = search->medium;
    struct text rest = medium->written, other = search->other.written;
    if (text_identical(text_cut(&rest, ':'), text_cut(&other, ':'))) {
        return; /* another material of the same catalogue */
    }
    foreign_warn(search->job, medium,
                 arena_printf(search->job->arena, "%s: that is %.*s, which is used",
                              foreign_difference(search->job, search->named, &search->other),
                              text_shown(medium->written), medium->written.start));
}

/* Ask the source for one name; true if it knows it, and it is the one that the file describes. */
static bool foreign_ask(struct glass_search *search, find_function *find, const char *written,
                        struct error *error)
{
    const struct foreign_job *job = search->job;
    const struct foreign_name *named = search->named;
    struct medium *medium = search->medium;
    *medium = (struct medium){.kind = MEDIUM_GLASS, .written = text_of(written), .index = {1, 0}};
    error->code = ERROR_NONE;
    if (!find(job->glasses->context, medium, error)) {
        return false;
    }
    const struct glass *glass = lens_glass_of(medium);
    if (glass != NULL && glass->catalog.length > 0) { /* as the catalogue spells it */
        /* A word of a .lens file has no blanks; names of glasses are the same without them. */
        const char *name =
            arena_printf(job->arena, "%.*s:%.*s", (int)glass->catalog.length, glass->catalog.start,
                         (int)glass->name.length, glass->name.start);
        char *word = arena_string(job->arena, name, strlen(name)), *to = word;
        for (const char *from = name; *from != '\0'; from++) {
            *to = *from;
            to += *from != ' ';
        }
        *to = '\0';
        medium->written = text_of(word);
    }
    /* Within 6e-5 and 0.1 % of what the formula gives or the catalogue prints. */
    if (foreign_is_within(medium, named, fmax(6e-5, named->nd_rounding),
                          fmax(1e-3 * fabs(named->Vd), named->Vd_rounding))) {
        if (search->has_other) {
            warn_of_homonym(search);
        }
        return true;
    }
    if (!search->has_other) {
        search->other = *medium;
        search->has_other = true;
    }
    return false;
}

/* Bad data of a catalogue, as opposed to a name that is in none. */
static bool is_damaged_catalog(const struct error *error)
{
    return error->code == ERROR_DATA || error->code == ERROR_IO;
}

/* Ask one catalogue. Result: false with a code where its data are bad. */
static bool ask_catalog(struct glass_search *search, struct text catalog, struct error *error)
{
    const struct foreign_job *job = search->job;
    const struct foreign_name *named = search->named;
    const char *written = arena_printf(job->arena, "%.*s:%.*s", (int)catalog.length, catalog.start,
                                       (int)named->name.length, named->name.start);
    find_function *const finds[] = {named->has_homonyms ? job->glasses->find_homonym : NULL,
                                    job->glasses->find_foreign};
    for (size_t i = 0; i < sizeof finds / sizeof finds[0]; i++) {
        if (finds[i] != NULL && foreign_ask(search, finds[i], written, error)) {
            return true;
        }
        if (finds[i] != NULL && is_damaged_catalog(error)) {
            return false;
        }
    }
    error->code = ERROR_NONE;
    return false;
}

/* "CDGM-ZEMAX201409", "OHARA_2021-04" and "OLD_SCHOTT" are editions of CDGM, OHARA and SCHOTT. */
static bool ask_editions(struct glass_search *search, struct text catalog, struct error *error)
{
    if (ask_catalog(search, catalog, error)) {
        return true;
    }
    for (size_t from = 0, to = 0; to <= catalog.length && error->code == ERROR_NONE; to++) {
        if (to < catalog.length && catalog.start[to] != '-' && catalog.start[to] != '_') {
            continue;
        }
        const struct text part = {catalog.start + from, to - from};
        if (part.length > 0 && part.length < catalog.length && ask_catalog(search, part, error)) {
            return true;
        }
        from = to + 1;
    }
    return false;
}

bool foreign_glass(struct foreign_job *job, const struct file_words *words,
                   const struct foreign_name *named, struct medium *medium, struct error *error)
{
    const struct text name = named->name;
    struct file_words place = *words;
    struct glass_search search = {.job = job, .named = named, .medium = medium};
    place.error = error;
    if (job->glasses == NULL) {
        *medium = (struct medium){.kind = MEDIUM_GLASS, .written = name, .index = {1, 0}};
        return is_glass_word(name) ||
               file_words_fail(&place, name, "this cannot be the name of a glass");
    }
    error->code = ERROR_NONE;
    for (size_t i = 0; i < named->catalog_count && error->code == ERROR_NONE; i++) {
        if (ask_editions(&search, named->catalogs[i], error)) {
            return true;
        }
    }
    if (named->catalog_count == 0 && /* all of them */
        foreign_ask(&search, job->glasses->find_foreign,
                    arena_string(job->arena, name.start, name.length), error)) {
        return true;
    }
    if (is_damaged_catalog(error)) {
        return false;
    }
    if (search.has_other && named->is_by_name) {
        *medium = search.other;
        error->code = ERROR_NONE;
        return true;
    }
    const struct error found = *error;
    if (error->code == ERROR_NONE || strncmp(found.message, "several ", 8) != 0) {
        error->code = ERROR_NONE; /* not a homonym: unknown */
        return false;
    }
    file_words_fail(&place, name, "%s", found.message);
    return error_hint(error, "%s", found.hint);
}
