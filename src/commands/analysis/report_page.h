/* commands/analysis/report_page.h - drawings and texts on one page, as HTML or as one drawing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_REPORT_PAGE_H
#define LENSCALC_COMMANDS_ANALYSIS_REPORT_PAGE_H

#include "base/arena.h"
#include "base/text.h"
#include "report/output.h"

#include <stdbool.h>
#include <stddef.h>

/* A part of the page. */
struct page_part {
    const char *title;   /* a heading over all columns where there is no text */
    const char *command; /* that makes it again, for a shell */
    struct text text;    /* SVG, or lines of text; start null: none */
    bool is_drawing;
    const char *failure; /* why there is none; null: all is well */
};

struct page {
    const char *title, *subtitle;
    const struct page_part *parts;
    size_t count;
};

/* A page that needs nothing else: styles and drawings lie in it. */
void page_write_html(const struct page *page, struct output *output);

/*
 * The same as one drawing: two columns, each part below the end of the shorter one.
 *
 * Given     arena  for working
 */
void page_write_svg(const struct page *page, struct arena *arena, struct output *output);

#endif
