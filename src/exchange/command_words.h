/* exchange/command_words.h - the words of lens files that are made of commands: CODE V and OSLO. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_COMMAND_WORDS_H
#define LENSCALC_EXCHANGE_COMMAND_WORDS_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "exchange/foreign.h"
#include "file/lens_words.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* What separates the commands of a program's files. */
struct command_grammar {
    const char *comment; /* from here to the end of the line, outside of quotes */
    const char *quotes;  /* characters that enclose a word with blanks */
    char separator;      /* between two commands of one line */
    char continuation;   /* at the end of a line: the command goes on; 0 = there is none */
    double infinity;     /* distances of the object of this many units and more are infinite */
};

/* A word and where it stands. */
struct command_word {
    struct text text; /* without its quotes */
    struct text line; /* the physical line */
    long number;      /* of that line, 1-based */
    bool is_quoted;
};

enum { COMMAND_MOST_WORDS = 4096 };

/* A file being read, command by command. Texts point into the content. */
struct commands {
    struct foreign_job *job;
    struct error *error; /* receives what is wrong */
    const struct command_grammar *grammar;
    struct text rest; /* what is still to read */
    struct text line; /* the present line, without its comment */
    const char *at;   /* where its next word begins */
    bool goes_on;     /* a mark of continuation has ended it */
    long number;
    struct number_scale scale; /* unit of a length in mm */
    struct command_word *words;
    size_t count, room;
};

void commands_open(struct commands *commands, struct foreign_job *job, struct text content,
                   const struct command_grammar *grammar, struct error *error);

/*
 * Go to the next command.
 *
 * Result    false at the end of the file with error->code ERROR_NONE
 * Errors    ERROR_DATA with line and column: a quote that does not end in its line, a command of
 *           more than COMMAND_MOST_WORDS words
 */
bool commands_next(struct commands *commands);

/* The word of this number, or an empty one where the command has ended. */
struct command_word commands_word(const struct commands *commands, size_t word);

/* The line of a word, for foreign_loss and file_words_fail. */
struct file_words commands_place(const struct commands *commands, const struct command_word *word);

/* Report something wrong with a word. Returns false. */
bool commands_fail(const struct commands *commands, const struct command_word *word,
                   const char *format, ...) __attribute__((format(printf, 3, 4)));

/* A loss at a word: see foreign_loss. Returns true. */
bool commands_loss(const struct commands *commands, const struct command_word *word,
                   enum loss_effect effect, const char *instead, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Leave out the present command, as a loss: "NAME: WHAT". Returns true. */
bool commands_lose(const struct commands *commands, enum loss_effect effect, const char *instead,
                   const char *what);

/* A number that stands in a word of the command, as lens_words_figure reads it. */
bool commands_figure(const struct commands *commands, size_t word, struct number_scale scale,
                     const char *what, struct figure *figure);

/* The same, and nothing stands behind it. */
bool commands_value(const struct commands *commands, size_t word, struct number_scale scale,
                    const char *what, struct figure *figure);

/*
 * The distance of an object: `inf` and `infinity` too, which become as far as the grammar's
 * infinity. Errors as commands_figure
 */
bool commands_object(const struct commands *commands, size_t word, struct figure *figure);

/* Nothing may follow from this word on. */
bool commands_end(const struct commands *commands, size_t word);

/*
 * A whole number in a word, or in the part of it that is no letter.
 *
 * Given     digits  that part; what  "number of the surface"; least  the smallest that is one
 */
bool commands_count(const struct commands *commands, const struct command_word *word,
                    struct text digits, const char *what, size_t least, size_t *value);

#endif
