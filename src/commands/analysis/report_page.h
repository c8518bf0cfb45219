/* commands/analysis/report_page.h - a page of drawings and tables, as HTML or one drawing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_REPORT_PAGE_H
#define LENSCALC_COMMANDS_ANALYSIS_REPORT_PAGE_H

#include "cli/question/artifact.h"
#include "cli/question/command.h"

/* A part of the page. */
struct page_part {
    const char *title;
    const char *command; /* that makes it again, for a shell; null: there is none */
    struct text text;    /* SVG, or lines of text */
    const char *failure; /* why there is none; null: all is well */
    bool is_heading;     /* the title alone, over all columns */
    bool is_drawing;     /* the text is SVG */
    bool is_paired;      /* it stands beside another: the left one, then */
    bool is_right;       /* the right one */
};

struct page {
    const char *title, *subtitle;
    struct page_part *parts;
    size_t count;
};

/* What a part is the answer to: a command, its words and, known by its name, the lens. */
struct page_question {
    const char *command;
    char *const *words;
    size_t count;
    const struct lens_value *lens; /* an array */
    size_t lens_count;
};

/* Ask it: the part receives the text, or why there is none. Result: is there one? */
bool page_ask(const struct page_question *question, struct run *run, struct page_part *part);

/* What a page may be written as: HTML that needs nothing else, or SVG in two columns. */
const struct file_type *page_types(size_t i);

/* As the job's file wants it, in its dress: the theme is that of the page and all its drawings. */
void page_write(const struct page *page, const struct artifact_job *job, struct output *output);

#endif
