/* report/terminal_query.h - which pictures a terminal can show: it is asked. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_TERMINAL_QUERY_H
#define LENSCALC_REPORT_TERMINAL_QUERY_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* How pictures are shown. */
enum terminal_graphics {
    GRAPHICS_AUTO, /* the best that the terminal says it can */
    GRAPHICS_BLOCKS,
    GRAPHICS_SIXEL,
    GRAPHICS_KITTY
};

/* The words of --terminal, in the order of the enum; ends with a null word. */
extern const struct word graphics_words[];

/* What a terminal says of itself. */
struct terminal_answer {
    bool has_sixel, has_kitty;
    size_t cell_width, cell_height; /* of a character, px; 0: it does not say */
};

/*
 * Ask the terminal behind a descriptor, and wait 100 ms at most.
 *
 * Given     descriptor  a terminal, of which this program is in the foreground: others are not
 *                       asked, nor is a dumb one
 * Result    its settings are as they were, whatever ends the program meanwhile; keys that were
 *           pressed at that moment are lost
 * Source    xterm, Control Sequences: primary device attributes (4: sixel), CSI 16 t; kitty,
 *           Terminal graphics protocol: querying support
 */
struct terminal_answer terminal_ask(int descriptor);

/* Rows of the terminal; 0: it is none, or does not know. */
size_t terminal_rows(int descriptor);

/* Does it say, by COLORTERM, that it has colours of 24 bits? */
bool terminal_has_true_color(void);

#endif
