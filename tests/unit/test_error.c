/* tests/unit/test_error.c - quantities in messages, and what they were given by. */
/* SPDX-License-Identifier: MIT */
#include "base/error.h"

#include "check.h"

#include <string.h>

/* The distance was given, the focal length may be; nobody knows of others. */
static const char *name_of(void *context, struct text quantity, bool asked)
{
    int *calls = context;
    ++*calls;
    if (text_equal(quantity, "distance")) {
        return "column 's'";
    }
    return asked && text_equal(quantity, "focal length") ? "--focal-length" : NULL;
}

/* What becomes of the message of an error. */
static const char *named(struct error *error)
{
    int calls = 0;
    error_name(error, name_of, &calls);
    return error->message;
}

static void test_message(void)
{
    struct error error;
    CHECK(!fail(&error, ERROR_DOMAIN, "{distance} %g mm lies within {the focal length} %g mm", 40.,
                50.));
    CHECK_TEXT(error.message, "distance 40 mm lies within the focal length 50 mm");
    CHECK_TEXT(named(&error), "column 's' 40 mm lies within the focal length 50 mm");
    CHECK_TEXT(named(&error), "column 's' 40 mm lies within the focal length 50 mm");
    fail(&error, ERROR_USAGE, "give {the focal length}");
    CHECK_TEXT(error.message, "give the focal length");
    CHECK_TEXT(named(&error), "give --focal-length");
    fail(&error, ERROR_DOMAIN, "{%s} %s", "focal length", "inf");
    CHECK_TEXT(named(&error), "focal length inf");
    fail(&error, ERROR_DOMAIN, "{%s} %g", "focal length", -1.);
    CHECK_TEXT(named(&error), "focal length -1");
    fail(&error, ERROR_DOMAIN, "{height} of {distance}");
    CHECK_TEXT(named(&error), "height of column 's'");
}

/* Braces of an argument, and those around what is no name, stay. */
static void test_braces(void)
{
    struct error error;
    fail(&error, ERROR_DATA, "'%s' is no {...} of {distance}", "{distance}");
    CHECK_TEXT(error.message, "'{distance}' is no {...} of distance");
    CHECK_TEXT(named(&error), "'{distance}' is no {...} of column 's'");
    fail(&error, ERROR_DATA, "{} { {distance {distance} }");
    CHECK_TEXT(error.message, "{} { {distance distance }");
    CHECK_TEXT(named(&error), "{} { {distance column 's' }");
    fail(&error, ERROR_DATA, "a \x01 b %s", "\n");
    CHECK_TEXT(error.message, "a ? b ?");
}

/* The window of a long text begins and ends between characters, wherever the caret stands. */
static void test_excerpt(void)
{
    char text[401] = "a";
    for (int i = 0; i < 200; i++) {
        text[2 * i + 1] = '\xc3';
        text[2 * i + 2] = '\xb6';
    }
    for (size_t shift = 0; shift < 2; shift++) {
        const struct text whole = {text + 1 - shift, 400 + shift};
        for (size_t caret = 1 + shift; caret < 400; caret += 2) {
            struct error error;
            fail_at(&error, ERROR_DATA, whole, caret, "wrong");
            const size_t length = strlen(error.text);
            for (size_t i = 0; i < length;) {
                const size_t step = text_utf8_length(error.text + i, length - i);
                CHECK(step > 0);
                i += step > 0 ? step : 1;
            }
            CHECK(error.caret >= 1 && (size_t)error.caret <= length);
            CHECK(((unsigned char)error.text[error.caret - 1] & 0xc0) != 0x80);
        }
    }
}

/* Bytes that continue nothing are characters of their own: the caret stays in its window. */
static void test_excerpt_of_continued_bytes(void)
{
    char text[400];
    memset(text, 0x9c, sizeof text);
    for (size_t caret = 1; caret <= sizeof text + 1; caret++) {
        struct error error;
        fail_at(&error, ERROR_DATA, (struct text){text, sizeof text}, caret, "wrong");
        CHECK(error.caret >= 1 && (size_t)error.caret <= strlen(error.text) + 1);
    }
}

static void test_characters(void)
{
    static const struct {
        const char *text;
        size_t byte, column, cells; /* cells of the whole */
    } cases[] = {{"abc", 2, 3, 3},
                 {"\xc3\xb6 x", 3, 3, 3},
                 {"\xe6\xbc\xa2\xe5\xad\x97 x", 7, 4, 6},
                 {"e\xcc\x81 x", 4, 4, 3}, /* an accent over the e */
                 {"\xf6\xdf x", 3, 4, 4},  /* Latin-1 */
                 {"\xf0\x9f\x98\x80 x", 5, 3, 4},
                 {"ab", 4, 5, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct text text = text_of(cases[i].text);
        CHECK(text_column(text, cases[i].byte) == cases[i].column);
        CHECK(text_cells(text) == cases[i].cells);
    }
    const struct text odd = text_of("a\xc3\xb6");
    CHECK(text_shown_up_to(odd, 2) == 1 && text_shown_up_to(odd, 3) == 3);
}

static void test_prefix(void)
{
    struct error error;
    fail(&error, ERROR_USAGE, " or {distance}");
    error_prefix(&error, "{%s}%s", "focal length", ",");
    error_prefix(&error, "give {distance}, ");
    CHECK_TEXT(error.message, "give distance, focal length, or distance");
    CHECK_TEXT(named(&error), "give column 's', --focal-length, or column 's'");
}

static void test_hint(void)
{
    struct error error;
    fail(&error, ERROR_DOMAIN, "no image");
    error_hint(&error, "give {focal length}");
    CHECK_TEXT(error.hint, "give focal length");
    CHECK_TEXT(named(&error), "no image");
    CHECK_TEXT(error.hint, "give --focal-length");
    fail(&error, ERROR_DOMAIN, "no image");
    int calls = 0;
    error_name(&error, name_of, &calls);
    CHECK(calls == 0);
}

/* More than there is room for: the names that are cut off, or too many, stay as they are. */
static void test_room(void)
{
    struct error error;
    char long_text[600];
    memset(long_text, 'x', sizeof long_text);
    long_text[sizeof long_text - 1] = '\0';
    fail(&error, ERROR_DOMAIN, "{distance} %s {distance}", long_text);
    CHECK(strlen(error.message) == sizeof error.message - 1);
    named(&error);
    CHECK(strncmp(error.message, "column 's' xxx", 14) == 0);
    CHECK(strlen(error.message) == sizeof error.message - 1);
    fail(&error, ERROR_DOMAIN, "%.500s {distance}", long_text);
    named(&error);
    CHECK(strlen(error.message) == sizeof error.message - 1 &&
          strcmp(error.message + 501, "column 's'") == 0);
    fail(&error, ERROR_DOMAIN, "%.507s {distance}", long_text);
    named(&error);
    CHECK_TEXT(error.message + 507, " dis");
    fail(&error, ERROR_DOMAIN, "%.40s", long_text);
    for (int i = 0; i < ERROR_MENTIONS + 2; i++) {
        error_prefix(&error, "{distance} ");
    }
    CHECK(error.in_message.count == ERROR_MENTIONS);
    named(&error);
    CHECK(strncmp(error.message, "column 's' column 's' ", 22) == 0);
    CHECK(strstr(error.message, " distance distance xxx") != NULL);
}

int main(void)
{
    test_message();
    test_braces();
    test_excerpt();
    test_excerpt_of_continued_bytes();
    test_characters();
    test_prefix();
    test_hint();
    test_room();
    return check_report();
}
