/* tests/unit/lens_of.h - a lens from its text, which is one. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_LENS_OF_H
#define LENSCALC_TESTS_UNIT_LENS_OF_H

#include "check.h"
#include "file/lens_file.h"

/* A failed check says why it is none. */
static inline struct lens lens_of(const char *text, struct arena *arena)
{
    struct lens lens = {0};
    struct error error = {.code = ERROR_NONE};
    const bool read = lens_read("test.lens", text_of(text), NULL, arena, &lens, &error);
    CHECK(read);
    if (!read) {
        printf("%ld:%d: %s\n", error.line, error.column, error.message);
    }
    return lens;
}

#endif
