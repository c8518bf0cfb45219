/* exchange/keep_notes.h - what lenscalc keeps of other programs' files: comments, pick-ups. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_KEEP_NOTES_H
#define LENSCALC_EXCHANGE_KEEP_NOTES_H

#include "base/text.h"
#include "file/lens_build.h"
#include "optics/growing.h"
#include "optics/lens.h"

#include <stdbool.h>

/* What other formats have no words for. */
enum keep_note {
    KEEP_NOTE_SOURCE,
    KEEP_NOTE_KIND,
    KEEP_NOTE_STATED,
    KEEP_NOTES = KEEP_NOTE_STATED + STATED_COUNT
};

/* Those of a file being read; a text without a start is absent. */
struct keep_notes {
    struct text texts[KEEP_NOTES];
};

/*
 * Write a line for each: source, kind and what is stated.
 *
 * Given     begin, end  of a line: "NOTE 0 lenscalc ", "\r\n"
 *           unit        of the file's lengths
 */
void keep_notes_write(struct text_buffer *out, const struct lens *lens, struct number_scale unit,
                      const char *begin, const char *end);

/* Is the text behind such a beginning a note of these? Then it is kept. */
bool keep_notes_take(struct keep_notes *notes, struct text text);

/*
 * Give the lens what was taken; its unit and its positions must be known.
 *
 * Limits    what is stated counts if it is one number or one a position
 */
void keep_notes_apply(const struct keep_notes *notes, struct lens_build *build);

/*
 * Give a lens that is whole a pick-up, where it says what the lens has, to the last bit: what other
 * programs understand by one may be more, and then the number stands alone.
 *
 * Given     factor, offset  what = factor from + offset; offset in mm, 1/mm, rad or 1
 */
void keep_pickup(struct lens *lens, struct parameter what, struct parameter from,
                 struct pair factor, struct pair offset, struct arena *arena);

#endif
