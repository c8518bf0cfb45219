/* report/terminal.c - what a terminal can show. */
/* SPDX-License-Identifier: MIT */
#ifdef __linux__
#define _DEFAULT_SOURCE /* TIOCGWINSZ */
#endif
#include "report/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { USUAL_WIDTH = 80, WIDEST = 10000 };

const struct word color_words[] = {
    {"auto", "on a terminal, unless NO_COLOR is set"},
    {"always", "even where there is no terminal"},
    {"never", "no colours"},
    {NULL, NULL},
};

size_t terminal_width(int descriptor)
{
    if (!isatty(descriptor)) {
        return 0;
    }
    const char *columns = getenv("COLUMNS");
    char *end = NULL;
    long asked = columns != NULL ? strtol(columns, &end, 10) : 0;
    if (asked > 0 && asked <= WIDEST && *end == '\0') {
        return (size_t)asked;
    }
    struct winsize size = {0};
    bool known = ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : USUAL_WIDTH;
}

bool terminal_has_color(int descriptor, enum color_when when)
{
    if (when != COLOR_AUTO || !isatty(descriptor)) {
        return when == COLOR_ALWAYS;
    }
    const char *refused = getenv("NO_COLOR"), *kind = getenv("TERM");
    return (refused == NULL || refused[0] == '\0') && kind != NULL && strcmp(kind, "dumb") != 0;
}

void terminal_prepare(struct output *output, enum color_when when)
{
    bool is_file = output->path != NULL;
    output->width = is_file ? 0 : terminal_width(output->descriptor);
    /* most are no terminals, and are not asked twice */
    output->has_color = !is_file && (output->width > 0 || when == COLOR_ALWAYS) &&
                        terminal_has_color(output->descriptor, when);
}

void terminal_guard(struct output *output)
{
    output->is_guarded = !output->is_renamed && isatty(output->descriptor);
}
