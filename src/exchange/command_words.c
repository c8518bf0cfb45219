/* exchange/command_words.c - the words of lens files that are made of commands: CODE V and OSLO. */
/* SPDX-License-Identifier: MIT */
#include "exchange/sequence.h"

#include "file/lens_words.h"

#include <string.h>

void commands_open(struct commands *commands, struct foreign_job *job, struct text content,
                   const struct command_grammar *grammar, struct error *error)
{
    *commands = (struct commands){
        .job = job, .error = error, .grammar = grammar, .rest = content, .scale = {1, 0}};
}

static bool is_command_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f';
}

static bool is_command_quote(const struct commands *commands, char c)
{
    return c != '\0' && strchr(commands->grammar->quotes, c) != NULL;
}

/* Go to the next line that has something; false at the end of the file. */
static bool next_command_line(struct commands *commands)
{
    while (commands->rest.start != NULL && commands->rest.length > 0) {
        /* the line up to its comment; what looks like one inside of quotes is none */
        struct text line = text_cut(&commands->rest, '\n');
        const char *comment = commands->grammar->comment;
        size_t length = strlen(comment);
        char closing = '\0';
        for (size_t i = 0; i < line.length; i++) {
            char c = line.start[i];
            if (closing != '\0') {
                closing = c == closing ? '\0' : closing;
            } else if (line.length - i >= length && memcmp(line.start + i, comment, length) == 0) {
                line.length = i;
            } else if (is_command_quote(commands, c)) {
                closing = c;
            }
        }
        while (line.length > 0 && is_command_blank(line.start[line.length - 1])) {
            line.length--;
        }
        commands->line = line;
        commands->at = line.start;
        commands->number++;
        if (line.length > 0) {
            return true;
        }
    }
    commands->at = NULL;
    return false;
}

static bool add_command_word(struct commands *commands, struct text text, bool is_quoted)
{
    commands->words = arena_grow(commands->job->arena, commands->words, commands->count,
                                 &commands->room, sizeof commands->words[0]);
    struct command_word *word = &commands->words[commands->count];
    *word = (struct command_word){text, commands->line, commands->number, is_quoted};
    if (commands->count == COMMAND_MOST_WORDS) {
        return commands_fail(commands, word, "a command of more than %d words", COMMAND_MOST_WORDS);
    }
    commands->count++;
    return true;
}

static bool read_quoted_word(struct commands *commands, const char *end)
{
    const char *start = commands->at;
    const char *close = memchr(start + 1, *start, (size_t)(end - start - 1));
    if (close == NULL) {
        const struct command_word word = {text_between(start, end), commands->line,
                                          commands->number, true};
        return commands_fail(commands, &word, "the text does not end with %c", *start);
    }
    /* CODE V writes names that have quotes of their own as ""name"" */
    if (close == start + 1 && end - close > 1 && !is_command_blank(close[1]) &&
        close[1] != commands->grammar->separator) {
        const char *inner = memchr(close + 1, *start, (size_t)(end - close - 1));
        if (inner != NULL && end - inner > 1 && inner[1] == *start) {
            commands->at = inner + 2;
            return add_command_word(commands, text_between(close + 1, inner), true);
        }
    }
    commands->at = close + 1;
    return add_command_word(commands, text_between(start + 1, close), true);
}

/* A word goes up to a blank or a separator outside of quotes: S'front' is one word. */
static bool read_bare_word(struct commands *commands, const char *end)
{
    const char *start = commands->at, *at = start;
    char closing = '\0';
    for (; at < end &&
           (closing != '\0' || (!is_command_blank(*at) && *at != commands->grammar->separator));
         at++) {
        if (closing != '\0') {
            closing = *at == closing ? '\0' : closing;
        } else if (is_command_quote(commands, *at)) {
            closing = *at;
        }
    }
    commands->at = at;
    return add_command_word(commands, text_between(start, at), false);
}

bool commands_next(struct commands *commands)
{
    commands->error->code = ERROR_NONE;
    commands->count = 0;
    for (;;) {
        const char *end =
            commands->at != NULL ? commands->line.start + commands->line.length : NULL;
        if (commands->at == NULL || commands->at >= end) {
            if ((commands->count > 0 && !commands->goes_on) || !next_command_line(commands)) {
                return commands->count > 0;
            }
            /* the mark of continuation may touch the last word of its line */
            const struct text line = commands->line;
            commands->goes_on = line.length > 0 && commands->grammar->continuation != '\0' &&
                                line.start[line.length - 1] == commands->grammar->continuation;
            commands->line.length -= commands->goes_on;
            continue;
        }
        if (is_command_blank(*commands->at)) {
            commands->at++;
            continue;
        }
        if (*commands->at == commands->grammar->separator) {
            commands->at++;
            if (commands->count > 0) {
                return true;
            }
            continue;
        }
        bool read = is_command_quote(commands, *commands->at) ? read_quoted_word(commands, end)
                                                              : read_bare_word(commands, end);
        if (!read) {
            return false;
        }
    }
}

struct command_word commands_word(const struct commands *commands, size_t word)
{
    if (word < commands->count) {
        return commands->words[word];
    }
    struct command_word last = commands->words[commands->count - 1];
    last.text = (struct text){last.line.start + last.line.length, 0};
    last.is_quoted = false;
    return last;
}

struct file_words commands_place(const struct commands *commands, const struct command_word *word)
{
    return (struct file_words){.source = commands->job->source,
                               .error = commands->error,
                               .line = word->line,
                               .number = word->number,
                               .at = word->line.start,
                               .scale = commands->scale,
                               .arena = commands->job->arena};
}

bool commands_lose(const struct commands *commands, enum loss_effect effect, const char *instead,
                   const char *what)
{
    const struct command_word *name = &commands->words[0];
    return commands_loss(commands, name, effect, instead, "%.*s: %s",
                         text_shown_up_to(name->text, 20), name->text.start, what);
}

bool commands_figure(const struct commands *commands, size_t word, bool is_length, const char *what,
                     struct figure *figure)
{
    const struct command_word found = commands_word(commands, word);
    const struct file_words place = commands_place(commands, &found);
    return lens_words_figure(&place, found.text, is_length ? commands->scale : NUMBER_UNSCALED,
                             what, figure);
}

bool commands_value(const struct commands *commands, size_t word, bool is_length, const char *what,
                    struct figure *figure)
{
    return commands_figure(commands, word, is_length, what, figure) &&
           commands_end(commands, word + 1);
}

bool commands_object(const struct commands *commands, size_t word, struct figure *figure)
{
    const struct text text = commands_word(commands, word).text;
    if (!text_same(text, "INF") && !text_same(text, "INFINITY")) {
        return commands_figure(commands, word, true, "thickness", figure);
    }
    static const char far[] = "1e20"; /* as both programs write it */
    *figure = (struct figure){.typed = text_of(far), .variable = LENS_NONE};
    return pair_read(far, far + strlen(far), commands->scale, &figure->value) != NULL;
}

struct figure commands_curvature(const struct commands *commands, struct pair curvature)
{
    const struct pair unit = lens_words_per_length(pair_of(1), commands->scale, 1);
    struct figure figure =
        figure_computed(pair_divide(curvature, unit), NUMBER_UNSCALED, commands->job->arena);
    sequence_per_length(commands, 1, &figure);
    return figure;
}

bool commands_end(const struct commands *commands, size_t word)
{
    if (word >= commands->count) {
        return true;
    }
    const struct text text = commands->words[word].text;
    return commands_fail(commands, &commands->words[word], "'%.*s' does not belong here",
                         text_shown_up_to(text, 40), text.start);
}

bool commands_count(const struct commands *commands, const struct command_word *word,
                    struct text digits, const char *what, size_t least, size_t *value)
{
    *value = 0;
    for (size_t i = 0; i < digits.length && *value < 1000000; i++) {
        if (!char_is_digit(digits.start[i])) {
            digits.length = 0;
        } else {
            *value = 10 * *value + (size_t)(digits.start[i] - '0');
        }
    }
    const struct command_word shown = {digits, word->line, word->number, false};
    return (digits.length > 0 && *value >= least && *value < 1000000) ||
           commands_fail(commands, digits.length > 0 ? &shown : word,
                         "the %s is a whole number from %zu on", what, least);
}
