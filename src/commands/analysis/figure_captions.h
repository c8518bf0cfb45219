/* commands/analysis/figure_captions.h - titles, subtitles and legends of what is drawn together. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_FIGURE_CAPTIONS_H
#define LENSCALC_COMMANDS_ANALYSIS_FIGURE_CAPTIONS_H

#include "commands/analysis/analysis_cursor.h"

/* What a curve is of, in the order in which words say it. */
enum caption_part {
    CAPTION_KIND, /* what the command itself tells apart: "20 cycles/mm" */
    CAPTION_FIELD,
    CAPTION_LENS,
    CAPTION_POSITION,
    CAPTION_APERTURE,
    CAPTION_WAVELENGTHS,
    CAPTION_OBJECT,
    CAPTION_PLANE,
    CAPTION_DEFOCUS,
    CAPTION_PARTS
};

/* As short as a legend has it; null: nothing was asked for. */
struct caption {
    const char *labels[CAPTION_PARTS];
};

/* Captions of one figure: the title and the subtitle have what is common, labels what is not. */
struct captions {
    struct arena *arena;
    bool leaves_out[CAPTION_PARTS]; /* what the figure goes along, or shows in another way */
    struct caption *list;
    size_t count, room;
    const char *words[CAPTION_PARTS]; /* in full, of the first case */
    bool varies[CAPTION_PARTS];
};

/*
 * Add a field of a case, unless one with the same labels is there.
 *
 * Given     kind  CAPTION_KIND; null: none
 * Result    its place in the list
 */
size_t captions_add(struct captions *captions, const struct analysis_case *one, size_t field,
                    const char *kind);

/* What tells a caption from the others: "14°, f/8"; null: it is alone, or nothing does. */
const char *captions_label(const struct captions *captions, size_t at);

/* Do captions differ in more than their fields? */
bool captions_have_settings(const struct captions *captions);

/* "Line spread of Double Gauss 100 mm f/2"; of several lenses "Line spread". */
const char *captions_title(const struct captions *captions, const char *what);

/* "14°; f/8; 587.6 nm; image plane paraxial, 72.21 mm from the last vertex": what all share. */
const char *captions_subtitle(const struct captions *captions);

#endif
