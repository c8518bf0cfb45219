/* report/terminal.h - what a terminal can show. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_TERMINAL_H
#define LENSCALC_REPORT_TERMINAL_H

#include "report/output.h"

#include <stdbool.h>
#include <stddef.h>

enum color_when { COLOR_AUTO, COLOR_ALWAYS, COLOR_NEVER };

/* The words of --color, in the order of the enum; ends with a null word. */
extern const struct word color_words[];

/*
 * Columns of the terminal behind a descriptor.
 *
 * Result    the variable COLUMNS if it is a whole number above 0, else what the terminal says, 80
 *           if it does not; 0 where there is no terminal
 */
size_t terminal_width(int descriptor);

/*
 * Does what is written there get colours? With COLOR_AUTO if it is a terminal, other than a dumb
 * one, and NO_COLOR is unset or empty (no-color.org).
 */
bool terminal_has_color(int descriptor, enum color_when when);

/* Let an output wrap at the width of its terminal, if it has one, and show colours. */
void terminal_prepare(struct output *output, enum color_when when);

/*
 * Guard the terminal, if the output goes to one, from what comes from files and words: control
 * characters and those that turn the direction of writing are shown as '?'. For what is written as
 * it is: files, and rows for programs.
 */
void terminal_guard(struct output *output);

#endif
