/* tests/fuzz/fuzz_part.c - a part of a divided run: the input is the file. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "file/part.h"
#include "fuzz.h"

#include <string.h>

/* The words of a head, if they are any, come back from how they are written. */
static void check_words(struct text line, struct arena *arena)
{
    int count, again;
    char **words = part_split(line, &count, arena);
    if (words == NULL) {
        return;
    }
    char **same = part_split(part_words(words, count, arena), &again, arena);
    REQUIRE(same != NULL && again == count);
    for (int i = 0; i < count; i++) {
        REQUIRE(strcmp(words[i], same[i]) == 0);
    }
}

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
        const struct text lines = part_lines(&files[0].head, files[0].body, &arena);
        const size_t length = lines.length + files[0].body.length;
        char *bytes = ARENA_ARRAY(&arena, length, char);
        memcpy(bytes, lines.start, lines.length);
        memcpy(bytes + lines.length, files[0].body.start, files[0].body.length);
        const struct text again = {bytes, length};
        check_words(files[0].head.words, &arena);
        REQUIRE(part_read("again", again, &files[1], &error));
        REQUIRE(text_identical(files[0].body, files[1].body));
        REQUIRE(!parts_order(files, 2, true, &arena, &error));
        fuzz_require_error(&error);
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    arena_free(&arena);
    free(content);
    return 0;
}
