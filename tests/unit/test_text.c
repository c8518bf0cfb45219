/* tests/unit/test_text.c - spans, names, edit distance; errors and arenas. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "check.h"

#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

/* Distances by hand (optimal string alignment: a transposition is one edit). */
static const struct {
    const char *a, *b;
    int distance;
} pairs[] = {
    {"", "", 0},         {"dof", "dof", 0},  {"dof", "DOF", 0},           {"dof", "dfo", 1},
    {"dof", "do", 1},    {"dof", "doff", 1}, {"kitten", "sitting", 3},    {"abc", "", 3},
    {"flaw", "lawn", 2}, {"ca", "abc", 3},   {"aperture", "apreture", 1},
};

static void check_distance(void)
{
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        struct text a = text_of(pairs[i].a), b = text_of(pairs[i].b);
        check_at(text_distance(a, b, 10) == pairs[i].distance, __FILE__, __LINE__, pairs[i].a);
        check_at(text_distance(b, a, 10) == pairs[i].distance, __FILE__, __LINE__, pairs[i].b);
    }
    CHECK(text_distance(text_of("kitten"), text_of("sitting"), 2) == 3);
    char long_word[70];
    memset(long_word, 'a', sizeof long_word);
    CHECK(text_distance((struct text){long_word, 70}, (struct text){long_word, 70}, 5) == 6);
}

static void check_names(void)
{
    CHECK(text_same_name(text_of("nikon-d1"), text_of("Nikon D1")));
    CHECK(text_same_name(text_of("35 mm"), text_of("35mm")));
    CHECK(!text_same_name(text_of("Nikon D1"), text_of("Nikon D1H")));
    CHECK(!text_same_name(text_of("Nikon D1H"), text_of("Nikon D1")));
    CHECK(text_same_name(text_of("a_-b "), text_of("AB")));
    CHECK(text_contains_name(text_of("Canon EOS 5D"), text_of("eos5")));
    CHECK(!text_contains_name(text_of("Canon EOS 5D"), text_of("eos6")));
    CHECK(text_contains_name(text_of("x"), text_of("")));
    CHECK(text_same(text_of("CSV"), "csv") && !text_same(text_of("csv"), "csvx"));
    CHECK(text_equal(text_of("csv"), "csv") && !text_equal(text_of("CSV"), "csv"));
}

static void check_cut(void)
{
    struct text rest = text_of("a,,b");
    CHECK(text_equal(text_cut(&rest, ','), "a"));
    CHECK(text_equal(text_cut(&rest, ','), ""));
    CHECK(text_equal(text_cut(&rest, ','), "b") && rest.start == NULL);
    CHECK(text_equal(text_trim(text_of(" \t x y \t")), "x y"));
}

static void check_nearest(void)
{
    struct nearest nearest = {.typed = text_of("fovv")};
    nearest_offer(&nearest, text_of("dof"));
    nearest_offer(&nearest, text_of("fov"));
    CHECK(nearest.best.start != NULL && text_equal(nearest.best, "fov"));
    struct nearest nothing = {.typed = text_of("zzz")};
    nearest_offer(&nothing, text_of("hyperfocal"));
    CHECK(nothing.best.start == NULL);
}

static void check_errors(void)
{
    struct error error;
    CHECK(!fail(&error, ERROR_IO, "cannot %s", "do"));
    CHECK(error.code == ERROR_IO && error.line == 0 && error.hint[0] == '\0');
    CHECK_TEXT(error.message, "cannot do");
    CHECK(!error_prefix(&error, "in %d: ", 7));
    CHECK_TEXT(error.message, "in 7: cannot do");
    char text[1000];
    memset(text, 'x', sizeof text);
    text[500] = '\n';
    CHECK(!fail_at(&error, ERROR_USAGE, (struct text){text, sizeof text}, 501, "here"));
    CHECK(error.caret >= 1 && strlen(error.text) < sizeof error.text);
    CHECK(error.text[error.caret - 1] == '?'); /* the caret still points at the line feed */
    CHECK(!fail_at(&error, ERROR_USAGE, (struct text){text, 3}, 99, "behind"));
    CHECK(error.caret == 4);
    CHECK(!error_locate(&error, "a.lens", 12, 3));
    CHECK(error.line == 12 && error.column == 3);
    CHECK_TEXT(error.source, "a.lens");
}

static void check_arena(void)
{
    struct arena arena = {0};
    struct arena_mark empty = arena_mark(&arena);
    double *numbers = ARENA_ARRAY(&arena, 1000, double);
    bool zeroed = true;
    for (int i = 0; i < 1000; i++) {
        zeroed = zeroed && numbers[i] == 0;
        numbers[i] = i;
    }
    CHECK(zeroed && (uintptr_t)numbers % _Alignof(max_align_t) == 0);
    struct arena_mark mark = arena_mark(&arena);
    char *large = arena_array(&arena, 1, 1000000);
    memset(large, 1, 1000000);
    CHECK_TEXT(arena_printf(&arena, "%d %s", 7, "words"), "7 words");
    arena_reset(&arena, mark);
    CHECK(numbers[999] == 999);
    CHECK_TEXT(arena_string(&arena, "abcdef", 3), "abc");
    char *again = arena_array(&arena, 1, 64);
    zeroed = true;
    for (int i = 0; i < 64; i++) {
        zeroed = zeroed && again[i] == 0;
    }
    CHECK(zeroed);
    arena_reset(&arena, empty);
    arena_free(&arena);
    CHECK(arena.block == NULL);
}

/* More than there can be ends the program with ERROR_IO, instead of too little being given. */
static void check_too_large(void)
{
    static void *(*const takes[])(struct arena *, size_t, size_t) = {arena_array,
                                                                     arena_buffer_array};
    static const struct {
        size_t count, size;
    } cases[] = {{SIZE_MAX / 16 + 2, 16}, {SIZE_MAX - 8, 1}, {2, SIZE_MAX / 2 + 1}};
    fflush(stdout);
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        int status = 0;
        const pid_t child = fork();
        if (child == 0) {
            struct arena arena = {0};
            close(STDERR_FILENO);
            takes[i % 2](&arena, cases[i / 2].count, cases[i / 2].size);
            _exit(0);
        }
        CHECK(child > 0 && waitpid(child, &status, 0) == child);
        CHECK(WIFEXITED(status) && WEXITSTATUS(status) == ERROR_IO);
    }
}

/* What a terminal obeys is as long as its bytes; what it prints is not (ECMA-48, Unicode 9). */
static void check_printable(void)
{
    static const struct {
        const char *bytes;
        size_t length;
    } cases[] = {{"a", 0},
                 {" ", 0},
                 {"~", 0},
                 {"\033[1m", 1},
                 {"\n", 1},
                 {"\177", 1},
                 {"\xc2\x80", 2},
                 {"\xc2\x9f", 2},
                 {"\xc2\xa0", 0},
                 {"\x9b", 1},
                 {"\xa0", 0},
                 {"\xff", 0},
                 {"\xc3\xa9", 0},
                 {"\xd8\x9c", 2},
                 {"\xd8\x9d", 0},
                 {"\xe2\x80\x8d", 0},
                 {"\xe2\x80\x8e", 3},
                 {"\xe2\x80\x8f", 3},
                 {"\xe2\x80\x90", 0},
                 {"\xe2\x80\xa7", 0},
                 {"\xe2\x80\xa8", 3},
                 {"\xe2\x80\xae", 3},
                 {"\xe2\x80\xaf", 0},
                 {"\xe2\x81\xa5", 0},
                 {"\xe2\x81\xa6", 3},
                 {"\xe2\x81\xa9", 3},
                 {"\xe2\x81\xaa", 0},
                 {"\xf0\x9f\x93\xb7", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct text text = text_of(cases[i].bytes);
        CHECK(text_unprintable(text.start, text.length) == cases[i].length);
    }
    CHECK(text_unprintable("", 0) == 0);
    char mixed[] = "a\033\xc2\x9b\n\xc3\xa9\xe2\x80\xae.";
    text_make_printable(mixed, "\n");
    CHECK_TEXT(mixed, "a???\n\xc3\xa9???.");
    text_make_printable(mixed, "");
    CHECK_TEXT(mixed, "a????\xc3\xa9???.");
}

int main(void)
{
    check_printable();
    check_distance();
    check_names();
    check_cut();
    check_nearest();
    check_errors();
    check_arena();
    check_too_large();
    return check_report();
}
