/* tests/unit/test_encoding.c - text in any encoding; pairs as decimal text. */
/* SPDX-License-Identifier: MIT */
#include "base/pair.h"
#include "check.h"
#include "data/encoding.h"
#include "file/lens_build.h"

#define BYTES(s)                                                                                   \
    {                                                                                              \
        (s), sizeof(s) - 1                                                                         \
    }

/* The UTF-8 of RFC 3629, the UTF-16 of RFC 2781, the table of Windows-1252. */
static void check_encodings(void)
{
    static const struct {
        struct text given, expected;
    } cases[] = {
        {BYTES("plain\nlines\n"), BYTES("plain\nlines\n")},
        {BYTES(""), BYTES("")},
        {BYTES("\xef\xbb\xbf"
               "mark"),
         BYTES("mark")},
        {BYTES("a\r\nb\rc\n\r\n"), BYTES("a\nb\nc\n\n")},
        {BYTES("\xff\xfeS\0\xb5\0\r\0\n\0"), BYTES("S\xc2\xb5\n")},
        {BYTES("\xfe\xff\0S\0\xb5\0\r\0\n"), BYTES("S\xc2\xb5\n")},
        {BYTES("M\0O\0D\0E\0\r\0\n\0"), BYTES("MODE\n")},
        {BYTES("N\0A\0M\0E\0 \0\0\x30"
               "a\0\r\0\n\0N\0"),
         BYTES("NAME \xe3\x80\x80"
               "a\nN")},
        {BYTES("\0M\0O\0D\0E\0\r\0\n"), BYTES("MODE\n")},
        {BYTES("\xff\xfe\x3d\xd8\x00\xde"), BYTES("\xf0\x9f\x98\x80")},
        {BYTES("5 \xb5m \x80\r\n"), BYTES("5 \xc2\xb5m \xe2\x82\xac\n")},
        {BYTES("5 \xc2\xb5m\r\n"), BYTES("5 \xc2\xb5m\n")},
        {BYTES("\xc0\x80"), BYTES("\xc3\x80\xe2\x82\xac")},
        {BYTES("\xed\xa0\x80"), BYTES("\xc3\xad\xc2\xa0\xe2\x82\xac")},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct text text;
        struct error error = {0};
        bool done = encoding_to_utf8("x", cases[i].given, &arena, &text, &error);
        bool same = done && text.length == cases[i].expected.length &&
                    memcmp(text.start, cases[i].expected.start, text.length) == 0;
        if (!same) {
            printf("case %zu: %s\n", i, done ? "another text" : error.message);
        }
        CHECK(same);
        arena_free(&arena);
    }
}

static void check_refused(void)
{
    static const struct {
        struct text given;
        const char *message;
    } cases[] = {
        {BYTES("abc\0def ghi"), "a NUL character at byte 3"},
        {BYTES("\xff\xfe\x41\0\0\0"), "a NUL character at byte 4"},
        {BYTES("\xff\xfe\x41\0\x42"), "half a UTF-16 character at byte 4"},
        {BYTES("\xff\xfe\x00\xde\x41\0"), "half a UTF-16 character at byte 2"},
        {BYTES("\xff\xfe\x3d\xd8\x41\0"), "half a UTF-16 character at byte 2"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct text text;
        struct error error = {0};
        CHECK(!encoding_to_utf8("x", cases[i].given, &arena, &text, &error));
        CHECK(error.code == ERROR_DATA && strstr(error.message, cases[i].message) != NULL);
        arena_free(&arena);
    }
}

static struct pair pair_of_text(const char *text)
{
    struct pair value = {0, 0};
    pair_read(text, text + strlen(text), NUMBER_UNSCALED, &value);
    return value;
}

static bool writes(struct pair value, struct number_scale unit, const char *expected)
{
    char text[PAIR_LENGTH];
    char *end = pair_write_shortest(text, value, unit);
    bool same =
        (size_t)(end - text) == strlen(expected) && memcmp(text, expected, strlen(expected)) == 0;
    if (!same) {
        printf("'%.*s', expected '%s'\n", (int)(end - text), text, expected);
    }
    return same;
}

/* What was read is written again: digits typed are the digits written. */
static void check_pairs(void)
{
    static const char *const texts[] = {"1",
                                        "-2.5",
                                        "0.1",
                                        "58.95",
                                        "9.9999999999999999",
                                        "10",
                                        "0.001",
                                        "1e-07",
                                        "1.5e-12",
                                        "1234567",
                                        "0.30000000000000004",
                                        "-0.016963528413910093299",
                                        "1e+22",
                                        "99999",
                                        "1000000",
                                        "0",
                                        "3.14159265358979323846264338",
                                        "1e-290",
                                        "2.2250738585072014e-308",
                                        "1e-320",
                                        "-5e-324",
                                        "1e+290"};
    const struct number_scale plain = {1, 0}, inch = {254, -1};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        CHECK(writes(pair_of_text(texts[i]), plain, texts[i]));
    }
    CHECK(writes(pair_of_text("25.4"), inch, "1"));
    CHECK(writes(pair_of_text("31.75"), inch, "1.25"));
    CHECK(writes(pair_multiply(pair_of_text("7.520"), pair_of_text("0.3")), plain, "2.256"));
    CHECK(writes(pair_of(0.1), plain, "0.1000000000000000055511151231258"));
}

/* Quotients to 20 and 33 digits by Python's decimal. */
static void check_radii(void)
{
    static const struct {
        const char *curvature, *radius; /* null: none was meant */
    } cases[] = {
        {"0.016963528413910092", "58.95"},
        {"1.6963528413910093e-02", "58.95"},
        {"-3.4494653328734046e-02", "-28.99"},
        {"0.016963528413910093299406276505513", "58.95"},
        {"0.016964", NULL},
        {"0.02", "50"},
        {"-1.25", "-0.8"},
        {"0.016963528413910000", NULL},
        {"0", NULL},
        {"6.325110689437065704E-03", "158.1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct figure curvature = {.typed = text_of(cases[i].curvature)}, radius;
        curvature.value = pair_of_text(cases[i].curvature);
        bool found = figure_radius_of(&curvature, "mm", &arena, &radius);
        CHECK(found == (cases[i].radius != NULL));
        CHECK(!found || text_equal(radius.typed, cases[i].radius));
        if (found && !text_equal(radius.typed, cases[i].radius)) {
            printf("%s -> %.*s\n", cases[i].curvature, (int)radius.typed.length,
                   radius.typed.start);
        }
        arena_free(&arena);
    }
}

int main(void)
{
    check_encodings();
    check_refused();
    check_pairs();
    check_radii();
    return check_report();
}
