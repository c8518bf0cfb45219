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
static bool take_part(const char **at, const char *end, struct part *part)
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
    return take_part(&at, text.start + text.length, part) ||
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

struct text part_write(const struct part_head *head, struct text body, struct arena *arena)
{
    const char *lines = arena_printf(
        arena,
        "%s\ncommand %.*s\nversion %.*s\ninput %s\nseed %" PRIu64 "\npart %ld/%ld\nitems %" PRIu64
        "\nlength %zu\nbody %s\n\n",
        first_line, (int)head->command.length, head->command.start, (int)head->version.length,
        head->version.start, head->input.text, head->seed, head->part.number, head->part.count,
        head->total, body.length, digest_of(body).text);
    const size_t length = strlen(lines);
    char *bytes = ARENA_ARRAY(arena, length + body.length, char);
    memcpy(bytes, lines, length);
    if (body.length > 0) {
        memcpy(bytes + length, body.start, body.length);
    }
    return (struct text){bytes, length + body.length};
}

/* The value of the next line, which must begin with `word` and a blank. */
static bool take_line(struct text *rest, const char *word, struct text *value, struct error *error)
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
static bool is_plain(struct text value)
{
    size_t i = 0;
    while (i < value.length && value.start[i] >= ' ' && value.start[i] <= '~') {
        i++;
    }
    return i == value.length;
}

enum line { COMMAND, VERSION, INPUT, SEED, PART, ITEMS, LENGTH, BODY, LINES };
static const char *const line_words[LINES] = {"command", "version", "input",  "seed",
                                              "part",    "items",   "length", "body"};

/* The values of the head's lines, made what they are. Result: the line that is wrong, or LINES. */
static enum line understand(const struct text values[LINES], struct part_head *head,
                            uint64_t *length, struct digest_name *body)
{
    const char *at = values[PART].start;
    head->command = values[COMMAND];
    head->version = values[VERSION];
    return !is_plain(values[COMMAND])                               ? COMMAND
           : !is_plain(values[VERSION])                             ? VERSION
           : !digest_of_line(values[INPUT], &head->input)           ? INPUT
           : !whole_of(values[SEED], &head->seed)                   ? SEED
           : !take_part(&at, at + values[PART].length, &head->part) ? PART
           : !whole_of(values[ITEMS], &head->total)                 ? ITEMS
           : !whole_of(values[LENGTH], length)                      ? LENGTH
           : !digest_of_line(values[BODY], body)                    ? BODY
                                                                    : LINES;
}

bool part_read(const char *path, struct text content, struct part_file *file, struct error *error)
{
    const size_t first = sizeof first_line - 1;
    struct text rest, values[LINES];
    struct digest_name body;
    uint64_t length;
    *file = (struct part_file){.path = path};
    if (content.length <= first || memcmp(content.start, first_line, first) != 0 ||
        content.start[first] != '\n') {
        fail(error, ERROR_DATA, "no part of a divided run");
        return error_locate(error, path, 0, 0);
    }
    rest = (struct text){content.start + first + 1, content.length - first - 1};
    for (int i = 0; i < LINES; i++) {
        if (!take_line(&rest, line_words[i], &values[i], error)) {
            return error_locate(error, path, i + 2, 1);
        }
    }
    const enum line wrong = understand(values, &file->head, &length, &body);
    if (wrong != LINES) {
        fail(error, ERROR_DATA, "'%s %.*s' is not what the head of a part says", line_words[wrong],
             text_shown(values[wrong]), values[wrong].start);
        return error_locate(error, path, (long)wrong + 2, 1);
    }
    if (rest.length < 1 || rest.start[0] != '\n' || rest.length - 1 != length) {
        fail(error, ERROR_DATA,
             "the part is cut off or longer than it says: %zu bytes, not %" PRIu64,
             rest.length > 0 ? rest.length - 1 : 0, length);
        return error_locate(error, path, 0, 0);
    }
    file->body = (struct text){rest.start + 1, rest.length - 1};
    if (strcmp(digest_of(file->body).text, body.text) != 0) {
        fail(error, ERROR_DATA, "the part is damaged: its body has another digest than it says");
        return error_locate(error, path, 0, 0);
    }
    return true;
}

/* A part that is not of the first one's run: which line of its head says so. */
static bool is_stranger(const struct part_head *first, const struct part_head *other,
                        enum line *line)
{
    *line = !text_identical(first->command, other->command)     ? COMMAND
            : !text_identical(first->version, other->version)   ? VERSION
            : strcmp(first->input.text, other->input.text) != 0 ? INPUT
            : first->seed != other->seed                        ? SEED
            : first->part.count != other->part.count            ? PART
            : first->total != other->total                      ? ITEMS
                                                                : LINES;
    return *line != LINES;
}

static const char *said(const struct part_head *head, enum line line, struct arena *arena)
{
    switch (line) {
    case COMMAND:
        return arena_string(arena, head->command.start, head->command.length);
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

bool parts_order(struct part_file *files, size_t count, struct arena *arena, struct error *error)
{
    for (size_t i = 1; i < count; i++) {
        enum line line;
        if (is_stranger(&files[0].head, &files[i].head, &line)) {
            return fail(error, ERROR_DATA, "%s is not of the run of %s: %s %s, not %s",
                        files[i].path, files[0].path, line_words[line],
                        said(&files[i].head, line, arena), said(&files[0].head, line, arena));
        }
    }
    qsort(files, count, sizeof *files, by_number);
    for (size_t i = 1; i < count; i++) {
        if (files[i].head.part.number == files[i - 1].head.part.number) {
            return fail(error, ERROR_DATA, "%s and %s are both part %s", files[i - 1].path,
                        files[i].path, said(&files[i].head, PART, arena));
        }
    }
    return (long)count == files[0].head.part.count ||
           fail(error, ERROR_DATA, "of the run of %s there is no part %s", files[0].path,
                list_missing(files, count, arena));
}
