/* exchange/zemax/zemax_keyword.h - keywords of .zmx, each with its reader. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_KEYWORD_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_KEYWORD_H

#include "exchange/word_table.h"
#include "exchange/zemax/zemax_parse.h"

/* What stands behind a keyword: text in quotes may follow numbers. */
enum zemax_wants { ZEMAX_ANY_WORDS, ZEMAX_ALL_NUMBERS, ZEMAX_A_NUMBER };

/* Reads a line; what the keyword wants is there. The file stands behind the keyword. */
typedef bool zemax_read_function(struct zemax_file *file, const struct zemax_line *line,
                                 struct error *error);

struct zemax_keyword {
    const char *words; /* separated by blanks; null ends a table */
    enum zemax_wants wants;
    bool is_length;            /* its numbers are in the file's unit */
    size_t kept;               /* where the file, or its surface, keeps the line; 0: nowhere */
    zemax_read_function *read; /* null: it is only kept */
};

#define ZEMAX_KEPT(owner, member) offsetof(struct owner, member)

/* Where words stand, as the table of them has it. */
#define ZEMAX_IN_SYSTEM         "system"
#define ZEMAX_IN_SURFACE        "surface"
#define ZEMAX_IN_CONFIGURATIONS "configurations"
#define ZEMAX_IN_TAIL           "behind"

/* Every word that is known. What is kept has a reader; what is lost may have one. */
extern const struct word_group zemax_words[];

/* Lines before the surfaces, and those behind them, which begin the line. */
extern const struct zemax_keyword zemax_system_keywords[];
extern const struct zemax_keyword zemax_tail_keywords[];

/* A line of the multiple configurations; what the table has not is lost where it changes. */
bool zemax_read_setting(struct zemax_file *file, struct text keyword, struct error *error);

/* The present line with its numbers, in the unit `scale`. */
struct zemax_line *zemax_line_of(struct zemax_file *file, struct text keyword,
                                 struct number_scale scale);

/*
 * Is every word of the line a number, up to text in quotes?
 *
 * Errors    ERROR_DATA at the first that is none, or is beyond 1e100
 */
bool zemax_all_numbers(const struct zemax_line *line, struct error *error);

/* The same, and there is one. */
bool zemax_has_number(const struct zemax_line *line, struct error *error);

#endif
