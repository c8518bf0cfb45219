/* tests/fuzz/fuzz_tsv.c - the tables of lensdb: the input is the file. */
/* SPDX-License-Identifier: MIT */
#include "data/tsv.h"
#include "fuzz.h"

#include <math.h>

static void require_inside(struct text text, const char *content, size_t size)
{
    REQUIRE(text.length == 0 ||
            (text.start >= content && text.start + text.length <= content + size));
}

static void require_row(const struct tsv *tsv, const char *content, size_t size)
{
    struct error error;
    for (size_t i = 0; i < tsv->columns; i++) {
        double value = 1;
        require_inside(tsv->cells[i], content, size);
        if (tsv_number(tsv, i, &value, &error)) {
            REQUIRE(!isnan(value) || tsv->cells[i].length == 0);
        } else {
            fuzz_require_error(&error);
            REQUIRE(error.code == ERROR_DATA && error.line == tsv->line && error.column >= 1);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct tsv tsv;
    struct error error = {0};
    if (tsv_open(&tsv, "fuzz.tsv", (struct text){content, size}, &error)) {
        size_t column;
        REQUIRE(tsv.columns >= 1 && tsv.columns <= TSV_MOST_COLUMNS);
        for (size_t i = 0; i < tsv.columns; i++) {
            require_inside(tsv.names[i], content, size);
        }
        if (!tsv_column(&tsv, "width_mm", &column, &error)) {
            fuzz_require_error(&error);
        } else {
            REQUIRE(column < tsv.columns);
        }
        while (tsv_next(&tsv, &error)) {
            require_row(&tsv, content, size);
        }
        if (error.code != ERROR_NONE) {
            fuzz_require_error(&error);
            REQUIRE(error.code == ERROR_DATA && error.line >= 1);
        }
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    free(content);
    return 0;
}
