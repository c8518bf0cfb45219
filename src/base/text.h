/* base/text.h - spans of characters: compare, trim, split, find the nearest word. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_TEXT_H
#define LENSCALC_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* A stretch of characters that somebody else owns; it need not end in NUL. */
struct text {
    const char *start;
    size_t length;
};

/* One of the words that a choice accepts; lists end with a null word. */
struct word {
    const char *word, *help;
};

/* Where something stands in a file, for messages. */
struct typed_place {
    const char *source; /* null: in none */
    long line;
    size_t column; /* from 1 */
};

struct text text_of(const char *string);
struct text text_between(const char *start, const char *end);

/* How many bytes of it a message shows, up to `most`: whole characters. */
static inline int text_shown_up_to(struct text text, int most)
{
    int shown = text.length < (size_t)most ? (int)text.length : most;
    while (shown > 0 && (size_t)shown < text.length &&
           ((unsigned char)text.start[shown] & 0xc0) == 0x80) {
        shown--;
    }
    return shown;
}

static inline int text_shown(struct text text)
{
    return text_shown_up_to(text, 60);
}

static inline bool char_is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool text_equal(struct text a, const char *b);

/* The same characters in two texts. */
bool text_identical(struct text a, struct text b);

/* Equal without regard to ASCII case. */
bool text_same(struct text a, const char *b);

/* Equal as names are typed: case, spaces, '-' and '_' do not count ("nikon-d1" is "Nikon D1"). */
bool text_same_name(struct text a, struct text b);

/* How many letters do two names begin with in common, by the rules of text_same_name? */
size_t text_shared_name(struct text a, struct text b);

/* Does `part` occur in `whole`, by the rules of text_same_name? */
bool text_contains_name(struct text whole, struct text part);

/* The order of strings for qsort of an array of them. */
int text_order(const void *a, const void *b);

/* What follows `begin`; its start is null where the text begins otherwise or ends there. */
struct text text_behind(struct text text, const char *begin);

/* Is it one of the blank-separated words? Null: there are none. Case counts. */
bool text_lists(const char *words, struct text word);

/* The same of names as text_same_name compares them. */
bool text_lists_name(const char *names, struct text name);

/* Without blanks and tabs at both ends. */
struct text text_trim(struct text text);

/*
 * Cut off what stands before the first `separator` and step behind it.
 *
 * Given     rest  the text; afterwards what follows the separator (start is null at the end)
 * Result    the part before the separator; the whole rest where there is none
 */
struct text text_cut(struct text *rest, char separator);

/*
 * Of "1..11" the first part, and the second in `rest`; of a text without ".." both are the whole.
 */
struct text text_cut_range(struct text *rest);

/*
 * Edit distance with transpositions (optimal string alignment), without regard to case.
 *
 * Result    number of edits; `limit` + 1 as soon as it must exceed `limit`. Words longer than
 *           63 characters are never near anything.
 */
int text_distance(struct text a, struct text b, int limit);

/* 0 to 15; -1 where it is no hexadecimal digit. */
int text_hex_digit(char c);

/* Length of the UTF-8 sequence that begins here, 0 if it is none (RFC 3629). */
size_t text_utf8_length(const char *start, size_t room);

/*
 * The character of a line that begins at a byte, both counted from the start: characters from 1,
 * bytes from 0. What is no UTF-8 counts as one each.
 */
size_t text_column(struct text line, size_t byte);

/*
 * Columns that a text takes on a terminal: two of a wide character (Unicode 11, East Asian Width W
 * and F), none of a mark that stands over another, one of all others.
 */
size_t text_cells(struct text text);

/*
 * What begins a text, as XML and HTML have it.
 *
 * Given     text  at least one byte
 *           step  receives how many bytes it stands for
 * Result    "&amp;" and the like for what they escape, "?" for what XML cannot hold, else the
 *           character itself
 */
struct text text_xml(struct text text, size_t *step);

/*
 * Length of what begins here and must not reach a terminal as it is, 0 if it may: a control
 * character (ASCII's; U+0080 to U+009F of ISO 6429, also as a stray byte) or one that turns the
 * direction of writing.
 */
size_t text_unprintable(const char *start, size_t room);

/* Put '?' in the place of every byte of these but the characters of `kept`, such as "\n". */
void text_make_printable(char *string, const char *kept);

/* The nearest word found so far; start with { .typed = ... } and offer all candidates. */
struct nearest {
    struct text typed;
    struct text best; /* start is null while nothing is near enough */
    int distance;
};

/* Keep `candidate` if it is nearer than the best so far and at most a third of the word away. */
void nearest_offer(struct nearest *nearest, struct text candidate);

#endif
