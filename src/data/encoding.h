/* data/encoding.h - text files of other programs in any encoding, made UTF-8. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_ENCODING_H
#define LENSCALC_DATA_ENCODING_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

/*
 * Make UTF-8 text with \n line ends of what a program for Windows may have written.
 *
 * Given     source   for messages
 *           content  UTF-8 or UTF-16 of either byte order, each with or without a byte order mark
 *                    (UTF-16 without one is told by its zero bytes); where it is neither, 8-bit
 *                    text: Windows-1252. Lines end with \n, \r\n or \r
 *           text     receives the text without a mark; content itself where nothing had to change
 * Errors    ERROR_DATA with the offset: a NUL character, half a UTF-16 character
 */
bool encoding_to_utf8(const char *source, struct text content, struct arena *arena,
                      struct text *text, struct error *error);

#endif
