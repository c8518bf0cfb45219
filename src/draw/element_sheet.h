/* draw/element_sheet.h - the drawing of an optical element in the tabular form of ISO 10110-1. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_ELEMENT_SHEET_H
#define LENSCALC_DRAW_ELEMENT_SHEET_H

#include "draw/svg.h"

#include <stddef.h>

enum { ELEMENT_LINES = 8 }; /* of each column of the table */

/* What is said of an element; a null line of a column is empty. */
struct element_sheet {
    const char *title, *part; /* of the lens; "element 3 of 6" */
    const double *z, *y;      /* its outline, mm */
    size_t count;
    double vertex[2];               /* on the axis, mm */
    double edge[2];                 /* z where its surfaces end at the top, mm */
    double diameter;                /* mm */
    const char *thickness, *across; /* dimensions in words: "8.05 ± 0.02", "Ø 46" */
    const char *radius[2];          /* those of the surfaces: "R 58.95" */
    const char *left[ELEMENT_LINES], *material[ELEMENT_LINES], *right[ELEMENT_LINES];
    const char *const *notes;
    size_t note_count;
};

/* The page, mm. */
#define ELEMENT_SHEET_WIDTH  210.0
#define ELEMENT_SHEET_HEIGHT 190.0

/*
 * Draw it as a whole SVG document into `svg`, which must be empty: the element in section at a
 * round scale with its dimensions, the table of left surface, material and right surface, notes.
 *
 * Source    ISO 10110-1:2019, 5.1, the tabular form; reference wavelength 546.07 nm by ISO 7944
 */
void element_sheet_draw(const struct element_sheet *sheet, struct svg *svg);

#endif
