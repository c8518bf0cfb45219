/* tests/fuzz/fuzz_part.c - a part of a divided run: the input is the file. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "file/part.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct arena arena = {0};
    struct error error = {0};
    struct part_file files[2];
    if (part_read("fuzz", (struct text){content, size}, &files[0], &error)) {
        const struct part *part = &files[0].head.part;
        REQUIRE(part->number >= 1 && part->number <= part->count && part->count <= PART_MOST);
        REQUIRE(files[0].body.length < size);
        const struct part_range range = part_range(*part, files[0].head.total);
        REQUIRE(range.begin <= range.end && range.end <= files[0].head.total);
        /* written again, it is the same file, and twice it is refused */
        const struct text again = part_write(&files[0].head, files[0].body, &arena);
        REQUIRE(part_read("again", again, &files[1], &error));
        REQUIRE(text_identical(files[0].body, files[1].body));
        REQUIRE(!parts_order(files, 2, &arena, &error));
        fuzz_require_error(&error);
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    arena_free(&arena);
    free(content);
    return 0;
}
