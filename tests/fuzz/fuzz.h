/* tests/fuzz/fuzz.h - what the fuzz targets share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_FUZZ_FUZZ_H
#define LENSCALC_TESTS_FUZZ_FUZZ_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A property that must hold for every input. */
#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);         \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

/* A copy that ends where its memory ends, so that reading on is seen. */
static inline char *fuzz_copy(const uint8_t *data, size_t size)
{
    char *copy = malloc(size > 0 ? size : 1);
    REQUIRE(copy != NULL);
    if (size > 0) {
        memcpy(copy, data, size);
    }
    return copy;
}

/* A failure says what is wrong, and its caret points into the text it shows. */
static inline void fuzz_require_error(const struct error *error)
{
    REQUIRE(error->code != ERROR_NONE && error->code != ERROR_ROWS);
    REQUIRE(memchr(error->message, '\0', sizeof error->message) != NULL);
    REQUIRE(error->message[0] != '\0');
    REQUIRE(memchr(error->text, '\0', sizeof error->text) != NULL);
    REQUIRE(memchr(error->hint, '\0', sizeof error->hint) != NULL);
    REQUIRE(memchr(error->source, '\0', sizeof error->source) != NULL);
    REQUIRE(error->caret >= 0 && (size_t)error->caret <= strlen(error->text) + 1);
    REQUIRE(error->line >= 0 && error->column >= 0);
    for (const char *at = error->text; *at != '\0'; at++) {
        REQUIRE((unsigned char)*at >= 0x20 && *at != 0x7f);
    }
}

#endif
