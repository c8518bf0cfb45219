/* data/agf_words.c - the words of an AGF file, line by line. */
/* SPDX-License-Identifier: MIT */
#include "data/agf.h"

bool agf_words_line(struct agf_words *words)
{
    if (words->rest.start == NULL || words->rest.length == 0) {
        return false;
    }
    words->line = text_cut(&words->rest, '\n');
    words->at = words->line;
    words->number++;
    return true;
}

static bool agf_words_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Does it begin as a number does, or as the exponent of one that the end of the line has cut? */
static bool agf_words_is_number(struct text line)
{
    const struct text text = text_trim(line);
    char first = text.length > 0 ? text.start[0] : '\0';
    char second = text.length > 1 ? text.start[1] : '\0';
    bool is_sign = first == '+' || first == '-' || first == '.';
    bool is_exponent = first == 'e' || first == 'E';
    return char_is_digit(first) ||
           (is_sign && (char_is_digit(second) || second == '.' || agf_words_is_blank(second))) ||
           (is_exponent && (second == '+' || second == '-' || char_is_digit(second)));
}

/* Go on to the next line that is not empty if it belongs to this one. */
static bool agf_words_go_on(struct agf_words *words)
{
    struct agf_words ahead = *words;
    bool is_next = agf_words_line(&ahead);
    while (is_next && text_trim(ahead.line).length == 0) {
        is_next = agf_words_line(&ahead);
    }
    if (!is_next || !agf_words_is_number(ahead.line)) {
        return false;
    }
    const struct text before = words->line;
    bool blank_before = before.length > 0 && agf_words_is_blank(before.start[before.length - 1]);
    ahead.touches = !blank_before && !agf_words_is_blank(ahead.line.start[0]);
    *words = ahead;
    return true;
}

/* The next word of the present line. */
static struct text next_of_line(struct agf_words *words)
{
    const char *at = words->at.start, *end = words->line.start + words->line.length;
    while (at < end && agf_words_is_blank(*at)) {
        at++;
    }
    const char *start = at;
    while (at < end && !agf_words_is_blank(*at)) {
        at++;
    }
    words->at = text_between(at, end);
    return text_between(start, at);
}

struct text agf_words_next(struct agf_words *words)
{
    words->touches = false;
    struct text word = next_of_line(words);
    return word.length == 0 && agf_words_go_on(words) ? next_of_line(words) : word;
}

bool agf_words_fail(const struct agf_words *words, struct text word, struct error *error,
                    const char *what)
{
    size_t column = (size_t)(word.start - words->line.start) + 1;
    fail_at(error, ERROR_DATA, words->line, column, "'%.*s' %s", text_shown_up_to(word, 60),
            word.start, what);
    return error_locate(error, words->source, words->number, column);
}

bool agf_words_fail_line(const struct agf_words *words, struct error *error, const char *what)
{
    fail_at(error, ERROR_DATA, words->line, 1, "%s", what);
    return error_locate(error, words->source, words->number, 1);
}
