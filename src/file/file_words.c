/* file/file_words.c - words of a file that is read line by line, and what is wrong with them. */
/* SPDX-License-Identifier: MIT */
#include "file/file_words.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool file_words_open(struct file_words *words, const char *source, struct text content,
                     struct arena *arena, struct error *error)
{
    *words = (struct file_words){.source = source,
                                 .error = error,
                                 .rest = content,
                                 .scale = NUMBER_UNSCALED,
                                 .comment = "#",
                                 .arena = arena};
    if (content.length >= 3 && memcmp(content.start, "\xef\xbb\xbf", 3) == 0) {
        words->rest = (struct text){content.start + 3, content.length - 3};
    }
    bool marked = content.length >= 2 && (memcmp(content.start, "\xff\xfe", 2) == 0 ||
                                          memcmp(content.start, "\xfe\xff", 2) == 0);
    const char *nul = content.length > 0 ? memchr(content.start, '\0', content.length) : NULL;
    if (marked || nul != NULL) {
        return fail_in(error, source, 1, 1, "not plain text: %s",
                       marked ? "a file in UTF-16" : "a NUL byte");
    }
    /* Would all of it be one line? */
    const char *mark =
        words->rest.length > 0 ? memchr(words->rest.start, '\r', words->rest.length) : NULL;
    if (mark != NULL && memchr(words->rest.start, '\n', words->rest.length) == NULL &&
        text_trim(text_between(mark + 1, words->rest.start + words->rest.length)).length > 0) {
        return fail_in(error, source, 1, 1, "its lines end in CR alone: LF or CR LF end a line");
    }
    return true;
}

static bool file_words_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Where a quoted value ends that begins here, or here if none does: marks alone are only marks. */
static size_t behind_quotes(struct text line, size_t at)
{
    const bool begins = at > 0 && line.start[at - 1] == '=' && line.start[at] == '"';
    const char *end = begins ? memchr(line.start + at + 1, '"', line.length - at - 1) : NULL;
    return end != NULL ? (size_t)(end - line.start) : at;
}

/* A comment begins where a word may begin. */
static struct text cut_comment(struct text line, const char *mark, bool has_quotes)
{
    size_t length = mark != NULL ? strlen(mark) : 0;
    for (size_t i = 0; length > 0 && i + length <= line.length; i++) {
        i = has_quotes ? behind_quotes(line, i) : i;
        if (i + length <= line.length && memcmp(line.start + i, mark, length) == 0 &&
            (i == 0 || file_words_is_blank(line.start[i - 1]))) {
            line.length = i;
        }
    }
    return line;
}

bool file_words_line(struct file_words *words)
{
    while (words->rest.start != NULL && words->rest.length > 0) {
        struct text line =
            cut_comment(text_cut(&words->rest, '\n'), words->comment, words->has_quotes);
        words->number++;
        while (line.length > 0 && file_words_is_blank(line.start[line.length - 1])) {
            line.length--;
        }
        words->line = line;
        words->at = line.start;
        if (line.length > 0) {
            return true;
        }
    }
    return false;
}

static const char *file_words_line_end(const struct file_words *words)
{
    return words->line.start + words->line.length;
}

struct text file_words_next(struct file_words *words)
{
    const char *end = file_words_line_end(words), *at = words->at;
    while (at < end && file_words_is_blank(*at)) {
        at++;
    }
    const char *start = at;
    char closing = '\0';
    for (; at < end && (closing != '\0' || !file_words_is_blank(*at)); at++) {
        if (closing != '\0') {
            closing = *at == closing ? '\0' : closing;
        } else if (*at == '{' || *at == '"') {
            closing = *at == '{' ? '}' : '"';
        }
    }
    words->at = at;
    return (struct text){start, (size_t)(at - start)};
}

struct text file_words_rest(struct file_words *words)
{
    struct text rest =
        text_trim((struct text){words->at, (size_t)(file_words_line_end(words) - words->at)});
    words->at = file_words_line_end(words);
    return rest;
}

/* In its line, in bytes from 0: a word of a line before stands at the line's end. */
static size_t file_word_byte(const struct file_words *words, struct text word)
{
    const struct text line = words->line;
    const bool is_here = word.start >= line.start && word.start <= line.start + line.length;
    return is_here ? (size_t)(word.start - line.start) : line.length;
}

struct typed_place file_words_place(const struct file_words *words, struct text word)
{
    return (struct typed_place){words->source, words->number,
                                text_column(words->line, file_word_byte(words, word))};
}

bool file_words_fail(const struct file_words *words, struct text word, const char *format, ...)
{
    struct error *error = words->error;
    char message[sizeof error->message];
    const size_t column = file_word_byte(words, word) + 1;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    fail_at(error, ERROR_DATA, words->line, column, "%s", message);
    error_locate(error, words->source, words->number, column);
    return error_count_characters(error, words->line);
}

bool file_words_end(struct file_words *words)
{
    struct text word = file_words_next(words);
    return word.length == 0 || file_words_fail(words, word, "'%.*s' does not belong here",
                                               text_shown_up_to(word, 40), word.start);
}

bool file_words_plain(const char *source, struct text content, struct error *error)
{
    long line = 1;
    size_t begin = 0;
    for (size_t i = 0; i < content.length; i++) {
        unsigned char c = (unsigned char)content.start[i];
        unsigned char next = i + 1 < content.length ? (unsigned char)content.start[i + 1] : 0;
        bool wide = c == 0xc2 && next >= 0x80 && next < 0xa0;
        if (wide || c == 0x7f || (c < 0x20 && c != '\t' && c != '\n' && c != '\r')) {
            return fail_in(error, source, line, i - begin + 1,
                           "not plain text: the control character U+%04X", wide ? next : c);
        }
        if (c == '\n') {
            line++;
            begin = i + 1;
        }
    }
    return true;
}
