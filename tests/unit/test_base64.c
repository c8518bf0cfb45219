/* tests/unit/test_base64.c - bytes as letters. */
/* SPDX-License-Identifier: MIT */
#include "check.h"

#include "base/base64.h"

#include <string.h>

/* RFC 4648, 10, its test vectors. */
static void test_vectors(void)
{
    static const struct {
        const char *bytes, *letters;
    } vectors[] = {{"", ""},
                   {"f", "Zg=="},
                   {"fo", "Zm8="},
                   {"foo", "Zm9v"},
                   {"foob", "Zm9vYg=="},
                   {"fooba", "Zm9vYmE="},
                   {"foobar", "Zm9vYmFy"}};
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        const struct text bytes = text_of(vectors[i].bytes);
        char letters[16] = "";
        for (size_t at = 0; at < bytes.length; at += 3) {
            base64_letters(bytes, at, letters + at / 3 * 4);
        }
        CHECK(strcmp(letters, vectors[i].letters) == 0);
        const struct text back = base64_bytes(text_of(vectors[i].letters), &arena);
        CHECK(back.length == bytes.length && memcmp(back.start, bytes.start, bytes.length) == 0);
    }
    arena_free(&arena);
}

/* All bytes, and letters with line ends between them. */
static void test_bytes(void)
{
    struct arena arena = {0};
    char all[256], letters[344 + 1] = "";
    for (size_t i = 0; i < sizeof all; i++) {
        all[i] = (char)i;
    }
    const struct text bytes = {all, sizeof all};
    for (size_t at = 0; at < bytes.length; at += 3) {
        base64_letters(bytes, at, letters + at / 3 * 4);
    }
    CHECK(strncmp(letters, "AAECAwQFBgcICQoLDA0ODxAREhMUFRYXGBka", 36) == 0);
    const struct text back = base64_bytes(text_of(letters), &arena);
    CHECK(back.length == sizeof all && memcmp(back.start, all, sizeof all) == 0);
    const struct text broken = base64_bytes(text_of("Zm9v\r\nYmFy\n"), &arena);
    CHECK(broken.length == 6 && memcmp(broken.start, "foobar", 6) == 0);
    arena_free(&arena);
}

int main(void)
{
    test_vectors();
    test_bytes();
    return check_report();
}
