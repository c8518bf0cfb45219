/* draw/typeset.h - words of drawings as books set them, and how wide they are. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TYPESET_H
#define LENSCALC_DRAW_TYPESET_H

#include <stdbool.h>
#include <stddef.h>

struct arena;

/*
 * Units and signs in place of what stands for them in a shell: "10 deg" is 10°, "5 um" 5 µm, "mm2"
 * mm², "36 x 24 mm" 36 × 24 mm, and a minus has the length of a plus.
 *
 * Given     text  UTF-8
 * Result    the same where nothing changes
 */
const char *typeset(struct arena *arena, const char *text);

/*
 * Width of a text, px, in DejaVu Sans.
 *
 * Given     text   as typeset makes it; what stands in _{ } is a subscript
 *           size   of the font, px
 * Source    table hmtx of DejaVu Sans and DejaVu Sans Bold 2.37
 * Limits    the viewer chooses the font: Helvetica, Arial and Liberation Sans are about a tenth
 *           narrower. Beyond ASCII only the signs of formulas have their own widths
 */
double typeset_width(const char *text, double size, bool bold);

/* How many bytes of a text fit into `width`, cut between characters. */
size_t typeset_fitting(const char *text, double size, bool bold, double width);

/* Of a subscript: its size over that of the text, and how far below its base line, in sizes. */
#define SUBSCRIPT_SIZE 0.7
#define SUBSCRIPT_DROP 0.22

#endif
