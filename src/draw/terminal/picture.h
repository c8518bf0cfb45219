/* draw/terminal/picture.h - pictures on a terminal: half blocks, sixels, kitty's graphics. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TERMINAL_PICTURE_H
#define LENSCALC_DRAW_TERMINAL_PICTURE_H

#include "base/error.h"
#include "base/image/image.h"
#include "draw/terminal/page.h"
#include "optics/growing.h"

/*
 * A picture in characters, over all columns, or as high as the screen if that is less.
 *
 * Given     image  of 1 to 4 channels, light: 0 to 1; its transparent places are white
 * Result    with colours, half blocks, two pixels one above the other in a cell, each the mean of
 *           what it covers; without, Braille dots, the more the brighter, by error diffusion
 * Source    [FS76] for the diffusion
 * Errors    ERROR_DATA: no memory for so many pixels
 */
bool picture_blocks(const struct image *image, const struct page_view *view, struct arena *arena,
                    struct text_buffer *lines, struct error *error);

/*
 * A picture in sixels, of the cube of six levels, by error diffusion.
 *
 * Given     width  that it is to have, px
 * Source    DEC STD 070, Video Systems Reference Manual, chapter 9
 * Errors    as above
 */
bool picture_sixel(const struct image *image, size_t width, struct arena *arena,
                   struct text_buffer *lines, struct error *error);

/*
 * A PNG file for terminals that know kitty's graphics protocol.
 *
 * Given     columns  cells across; 0: as large as its pixels
 * Source    kitty, Terminal graphics protocol
 */
void picture_kitty(struct text png, size_t columns, struct text_buffer *lines);

#endif
