/* file/part.c - parts of a divided run: their files, and how they come together again. */
/* SPDX-License-Identifier: MIT */
#include "file/part.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char first_line[] = "lenscalc part 1";
enum { SHOWN = 12 }; /* missing parts that a message names */

/* A whole number of at most 18 digits, up to `end`. */
static bool take_whole(const char **at, const char *end, uint64_t *value)
{
    const char *start = *at;
    *value = 0;
    while (*at < end && char_is_digit(**at) && *at - start < 18) {
        *value = 10 * *value + (uint64_t)(*(*at)++ - '0');
    }
    return *at > start;
}

/* "3/8"; `at` stands where it goes wrong. */
static bool part_take_part(const char **at, const char *end, struct part *part)
{
    uint64_t number, count;
    const char *start = *at;
    if (!take_whole(at, end, &number) || *at == end || **at != '/') {
        return false;
    }
    ++*at;
    if (!take_whole(at, end, &count) || *at != end) {
        return false;
    }
    *part = (struct part){(long)number, (long)count};
    *at = start;
    return number >= 1 && number <= count && count <= PART_MOST;
}

bool part_parse(struct text text, struct part *part, struct error *error)
{
    const char *at = text.start;
    return part_take_part(&at, text.start + text.length, part) ||
           fail_at(error, ERROR_USAGE, text, (size_t)(at - text.start) + 1,
                   "part '%.*s' must be like 3/8, from 1/N to N/N with N up to %d",
                   text_shown(text), text.start, PART_MOST);
}

struct part_range part_range(struct part part, uint64_t total)
{
    const uint64_t count = (uint64_t)part.count, number = (uint64_t)part.number;
    const uint64_t each = total / count, longer = total % count;
    return (struct part_range){each * (number - 1) + (number - 1 < longer ? number - 1 : longer),
                               each * number + (number < longer ? number : longer)};
}

struct text part_lines(const struct part_head *head, struct text body, struct arena *arena)
{
    return text_of(
        arena_printf(arena,
                     "%s\ncommand %.*s\nwords %.*s\nversion %.*s\ninput %s\nseed %" PRIu64
                     "\npart %ld/%ld\nitems %" PRIu64 "\ndone %" PRIu64 "\nlength %zu\nbody %s\n\n",
                     first_line, (int)head->command.length, head->command.start,
                     (int)head->words.length, head->words.start, (int)head->version.length,
                     head->version.start, head->input.text, head->seed, head->part.number,
                     head->part.count, head->total, head->done, body.length, digest_of(body).text));
}

/* -------- words -------- */

static bool is_bare(char c)
{
    return c > ' ' && c <= '~' && c != '\\';
}

struct text part_words(char *const *words, int count, struct arena *arena)
{
    size_t room = 1, used = 0;
    for (int i = 0; i < count; i++) {
        room += 4 * strlen(words[i]) + 5;
    }
    char *line = ARENA_ARRAY(arena, room, char);
    for (int i = 0; i < count; i++) {
        const char *word = words[i];
        if (i > 0) {
            line[used++] = ' ';
        }
        do {
            const unsigned char c = (unsigned char)*word;
            if (is_bare(*word)) {
                line[used++] = *word;
            } else {
                line[used++] = '\\';
                line[used++] = (char)('0' + c / 64);
                line[used++] = (char)('0' + c / 8 % 8);
                line[used++] = (char)('0' + c % 8);
            }
        } while (*word != '\0' && *++word != '\0');
    }
    return (struct text){line, used};
}

/* A word as it was; null: it is none. */
static char *unescape(struct text word, struct arena *arena)
{
    char *plain = ARENA_ARRAY(arena, word.length + 1, char), *to = plain;
    for (size_t i = 0; i < word.length; i++) {
        int value = 0, digits = 0;
        if (word.start[i] != '\\') {
            *to++ = word.start[i];
            continue;
        }
        for (; digits < 3 && i + 1 < word.length; digits++) {
            const char c = word.start[++i];
            if (c < '0' || c > '7') {
                return NULL;
            }
            value = 8 * value + (c - '0');
        }
        if (digits < 3 || value > 255) {
            return NULL;
        }
        *to++ = (char)value;
    }
    return plain;
}

char **part_split(struct text line, int *count, struct arena *arena)
{
    char **words = ARENA_ARRAY(arena, line.length + 1, char *);
    *count = 0;
    for (struct text rest = line; rest.length > 0;) {
        words[*count] = unescape(text_cut(&rest, ' '), arena);
        if (words[(*count)++] == NULL) {
            return NULL;
        }
    }
    return words;
}

/* -------- a part is read -------- */

/* The value of the next line, which must begin with `word` and a blank. */
static bool part_take_line(struct text *rest, const char *word, struct text *value,
                           struct error *error)
{
    const char *end = rest->length > 0 ? memchr(rest->start, '\n', rest->length) : NULL;
    const size_t length = strlen(word);
    const struct text whole = end != NULL ? text_between(rest->start, end) : *rest;
    if (end == NULL || whole.length < length + 2 || memcmp(whole.start, word, length) != 0 ||
        whole.start[length] != ' ') {
        return fail(error, ERROR_DATA, "the head of a part must say '%s' here", word);
    }
    *value = text_between(whole.start + length + 1, end);
    *rest = text_between(end + 1, rest->start + rest->length);
    return true;
}

static bool whole_of(struct text value, uint64_t *number)
{
    const char *at = value.start, *end = value.start + value.length;
    return take_whole(&at, end, number) && at == end;
}

static bool digest_of_line(struct text value, struct digest_name *name)
{
    if (value.length != DIGEST_LENGTH) {
        return false;
    }
    memcpy(name->text, value.start, DIGEST_LENGTH);
    name->text[DIGEST_LENGTH] = '\0';
    return strspn(name->text, "0123456789abcdef") == DIGEST_LENGTH;
}

/* Something that can be printed. */
static bool part_is_plain(struct text value)
{
    size_t i = 0;
    while (i < value.length && value.start[i] >= ' ' && value.start[i] <= '~') {
        i++;
    }
    return i == value.length;
}

enum part_line { COMMAND, WORDS, VERSION, INPUT, SEED, PART, ITEMS, DONE, LENGTH, BODY, LINES };
static const char *const line_words[LINES] = {"command", "words", "version", "input",  "seed",
                                              "part",    "items", "done",    "length", "body"};

/* Items that a part has when it is complete. */
static uint64_t items_of(const struct part_head *head)
{
    const struct part_range range = part_range(head->part, head->total);
    return range.end - range.begin;
}

/* The first line of a head that is not as it should be; LINES: none. */
static enum part_line first_wrong(const bool sound[LINES])
{
    int line = 0;
    while (line < LINES && sound[line]) {
        line++;
    }
    return (enum part_line)line;
}

/* The values of the head's lines, made what they are. Result: the line that is wrong, or LINES. */
static enum part_line understand(const struct text values[LINES], struct part_head *head,
                                 uint64_t *length, struct digest_name *body)
{
    const char *at = values[PART].start;
    head->command = values[COMMAND];
    head->words = values[WORDS];
    head->version = values[VERSION];
    bool sound[LINES] = {
        [COMMAND] = part_is_plain(head->command),
        [WORDS] = part_is_plain(head->words),
        [VERSION] = part_is_plain(head->version),
        [INPUT] = digest_of_line(values[INPUT], &head->input),
        [SEED] = whole_of(values[SEED], &head->seed),
        [PART] = part_take_part(&at, at + values[PART].length, &head->part),
        [ITEMS] = whole_of(values[ITEMS], &head->total),
        [DONE] = whole_of(values[DONE], &head->done),
        [LENGTH] = whole_of(values[LENGTH], length),
        [BODY] = digest_of_line(values[BODY], body),
    };
    if (first_wrong(sound) > DONE) {
        sound[DONE] = head->done <= items_of(head);
    }
    return first_wrong(sound);
}

bool part_is(struct text first)
{
    const size_t length = sizeof first_line - 1;
    return first.length > length && memcmp(first.start, first_line, length) == 0 &&
           first.start[length] == '\n';
}

bool part_read(const char *path, struct text content, struct part_file *file, struct error *error)
{
    const size_t first = sizeof first_line - 1;
    struct text rest, values[LINES];
    struct digest_name body;
    uint64_t length;
    *file = (struct part_file){.path = path};
    if (!part_is(content)) {
        return fail_in(error, path, 0, 0, "no part of a divided run");
    }
    rest = (struct text){content.start + first + 1, content.length - first - 1};
    for (int i = 0; i < LINES; i++) {
        if (!part_take_line(&rest, line_words[i], &values[i], error)) {
            return error_locate(error, path, i + 2, 1);
        }
    }
    const enum part_line wrong = understand(values, &file->head, &length, &body);
    if (wrong != LINES) {
        return fail_in(error, path, (long)wrong + 2, 1,
                       "'%s %.*s' is not what the head of a part says", line_words[wrong],
                       text_shown(values[wrong]), values[wrong].start);
    }
    if (rest.length < 1 || rest.start[0] != '\n' || rest.length - 1 != length) {
        return fail_in(error, path, 0, 0,
                       "the part is cut off or longer than it says: %zu bytes, not %" PRIu64,
                       rest.length > 0 ? rest.length - 1 : 0, length);
    }
    file->body = (struct text){rest.start + 1, rest.length - 1};
    if (strcmp(digest_of(file->body).text, body.text) != 0) {
        return fail_in(error, path, 0, 0,
                       "the part is damaged: its body has another digest than it says");
    }
    return true;
}

/* An option without its value: "--size" of "--size=60x40". */
static struct text part_option_of(struct text word)
{
    return text_cut(&word, '=');
}

/* The first word of the same option; empty: there is none. */
static struct text word_like(struct text line, struct text word)
{
    struct text found = {0};
    while (line.length > 0 && found.length == 0) {
        const struct text next = text_cut(&line, ' ');
        found = text_identical(part_option_of(next), part_option_of(word)) ? next : found;
    }
    return found;
}

/* The first word that another line has not or says otherwise; empty: there is none. */
static struct text first_word(struct text line, struct text other)
{
    struct text found = {0};
    while (line.length > 0 && found.length == 0) {
        const struct text next = text_cut(&line, ' ');
        found = text_identical(next, word_like(other, next)) ? found : next;
    }
    return found;
}

/* What one line asks of the option in which it differs first from another, which may lack it. */
static const char *asked(struct text line, struct text word, struct arena *arena)
{
    const struct text found = word_like(line, word), option = part_option_of(word);
    if (found.length > 0) {
        return arena_string(arena, found.start, found.length);
    }
    if (word.length > 0) {
        return arena_printf(arena, "no %.*s", (int)option.length, option.start);
    }
    return "in another order";
}

/* What a head says in a line; `word` is one that heads differ in. */
static const char *said(const struct part_head *head, struct text word, enum part_line line,
                        struct arena *arena)
{
    switch (line) {
    case COMMAND:
        return arena_string(arena, head->command.start, head->command.length);
    case WORDS:
        return asked(head->words, word, arena);
    case VERSION:
        return arena_string(arena, head->version.start, head->version.length);
    case INPUT:
        return arena_string(arena, head->input.text, 12);
    case SEED:
        return arena_printf(arena, "%" PRIu64, head->seed);
    case PART:
        return arena_printf(arena, "%ld/%ld", head->part.number, head->part.count);
    default:
        return arena_printf(arena, "%" PRIu64, head->total);
    }
}

bool part_is_of_run(const struct part_file *file, const struct part_head *run, const char *which,
                    struct arena *arena, struct error *error)
{
    /* Which line of a head is not that of its run's; LINES: none. */
    const bool same[LINES] = {
        [COMMAND] = text_identical(run->command, file->head.command),
        [WORDS] = text_identical(run->words, file->head.words),
        [VERSION] = text_identical(run->version, file->head.version),
        [INPUT] = strcmp(run->input.text, file->head.input.text) == 0,
        [SEED] = run->seed == file->head.seed,
        [PART] = run->part.count == file->head.part.count,
        [ITEMS] = run->total == file->head.total,
        [DONE] = true,
        [LENGTH] = true,
        [BODY] = true,
    };
    const enum part_line line = first_wrong(same);
    const struct text own = first_word(file->head.words, run->words);
    const struct text word = own.length > 0 ? own : first_word(run->words, file->head.words);
    return line == LINES ||
           fail(error, ERROR_DATA, "%s is not of %s: %s %.120s, not %.120s", file->path, which,
                line == WORDS ? "asked" : line_words[line], said(&file->head, word, line, arena),
                said(run, word, line, arena));
}

static int by_number(const void *a, const void *b)
{
    const struct part_file *first = a, *second = b;
    const long left = first->head.part.number, right = second->head.part.number;
    return left != right ? (left > right) - (left < right) : strcmp(first->path, second->path);
}

/* The numbers of those that are missing, the first ones in words. */
static const char *list_missing(const struct part_file *files, size_t count, struct arena *arena)
{
    const long all = files[0].head.part.count, missing = all - (long)count;
    const char *list = "";
    size_t at = 0;
    long named = 0;
    for (long number = 1; number <= all && named < missing; number++) {
        if (at < count && files[at].head.part.number == number) {
            at++;
            continue;
        }
        if (named == SHOWN) {
            return arena_printf(arena, "%s and %ld more", list, missing - named);
        }
        list = arena_printf(arena, "%s%s%ld/%ld", list, named > 0 ? ", " : "", number, all);
        named++;
    }
    return list;
}

bool parts_order(struct part_file *files, size_t count, bool whole, struct arena *arena,
                 struct error *error)
{
    const char *first = arena_printf(arena, "the run of %s", files[0].path);
    const struct part_head run = files[0].head;
    for (size_t i = 1; i < count; i++) {
        if (!part_is_of_run(&files[i], &run, first, arena, error)) {
            return false;
        }
    }
    qsort(files, count, sizeof *files, by_number);
    for (size_t i = 0; i < count; i++) {
        const struct part_head *head = &files[i].head;
        if (i > 0 && head->part.number == files[i - 1].head.part.number) {
            return fail(error, ERROR_DATA, "%s and %s are both part %s", files[i - 1].path,
                        files[i].path, said(head, text_of(""), PART, arena));
        }
        if (whole && head->done < items_of(head)) {
            return fail(error, ERROR_DATA,
                        "%s is incomplete: %" PRIu64 " of %" PRIu64
                        " items; its run was interrupted",
                        files[i].path, head->done, items_of(head));
        }
    }
    return !whole || (long)count == run.part.count ||
           fail(error, ERROR_DATA, "of %s there is no part %s", first,
                list_missing(files, count, arena));
}
