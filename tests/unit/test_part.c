/* tests/unit/test_part.c - parts of a divided run: ranges, files, gaps, repeats and strangers. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "check.h"
#include "file/part.h"

#include <stdlib.h>

/* FIPS 180-2, appendix B; of nothing: NIST's SHA256ShortMsg, Len = 0. */
static void test_digest(void)
{
    CHECK_TEXT(digest_of(text_of("")).text,
               "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK_TEXT(digest_of(text_of("abc")).text,
               "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK_TEXT(digest_of(text_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")).text,
               "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    struct digest digest;
    digest_begin(&digest);
    for (int i = 0; i < 1000000; i += 1000) {
        char a[1000];
        memset(a, 'a', sizeof a);
        digest_add(&digest, a, 1);
        digest_add(&digest, a, 999);
    }
    CHECK_TEXT(digest_end(&digest).text,
               "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/* Items are told apart by their lengths. */
static void test_items(void)
{
    struct digest_name names[2];
    for (size_t i = 0; i < 2; i++) {
        struct digest digest;
        digest_begin(&digest);
        digest_item(&digest, (struct text){"abc", 1 + i});
        digest_item(&digest, (struct text){&"abc"[1 + i], 2 - i});
        names[i] = digest_end(&digest);
    }
    CHECK(strcmp(names[0].text, names[1].text) != 0);
}

/* All items once, in order, and parts alike to one item. */
static void test_ranges(void)
{
    static const uint64_t totals[] = {0, 1, 7, 8, 9, 1000003, UINT64_MAX};
    for (size_t i = 0; i < sizeof totals / sizeof *totals; i++) {
        for (long count = 1; count <= 12; count++) {
            uint64_t at = 0, least = UINT64_MAX, most = 0;
            for (long number = 1; number <= count; number++) {
                const struct part_range range = part_range((struct part){number, count}, totals[i]);
                const uint64_t size = range.end - range.begin;
                CHECK(range.begin == at && range.end >= at);
                at = range.end;
                least = size < least ? size : least;
                most = size > most ? size : most;
            }
            CHECK(at == totals[i] && most - least <= 1);
        }
    }
}

static void test_parse(void)
{
    static const char *const wrong[] = {"",     "3",    "0/8",  "9/8",   "3/",       "/8",
                                        "3/8x", "-1/2", "1/-2", "1.5/2", "1/100001", "1 / 2"};
    struct part part;
    struct error error;
    CHECK(part_parse(text_of("3/8"), &part, &error) && part.number == 3 && part.count == 8);
    CHECK(part_parse(text_of("1/1"), &part, &error) && part.number == 1 && part.count == 1);
    CHECK(part_parse(text_of("100000/100000"), &part, &error));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        CHECK(!part_parse(text_of(wrong[i]), &part, &error) && error.code == ERROR_USAGE);
    }
    CHECK(!part_parse(text_of("3/8x"), &part, &error));
    CHECK_TEXT(error.message, "part '3/8x' must be like 3/8, from 1/N to N/N with N up to 100000");
    CHECK(error.caret == 4);
}

static const char input[] = "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";

static struct part_head head_of(long number, long count)
{
    struct part_head head = {.command = text_of("render"),
                             .words = text_of("--seed=7 edge"),
                             .version = text_of("1.2"),
                             .seed = 7,
                             .total = 1000,
                             .part = {number, count}};
    const struct part_range range = part_range(head.part, head.total);
    head.done = range.end - range.begin;
    memcpy(head.input.text, input, sizeof input);
    return head;
}

/* The file byte for byte, and back. */
static struct text part_write(const struct part_head *head, struct text body, struct arena *arena)
{
    const struct text lines = part_lines(head, body, arena);
    return text_of(arena_printf(arena, "%.*s%.*s", (int)lines.length, lines.start, (int)body.length,
                                body.length > 0 ? body.start : ""));
}

static void test_file(struct arena *arena)
{
    static const char known[] =
        "lenscalc part 1\ncommand render\nwords --seed=7 edge\nversion 1.2\n"
        "input 248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1\n"
        "seed 7\npart 3/8\nitems 1000\ndone 125\nlength 3\n"
        "body ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad\n\nabc";
    const struct part_head head = head_of(3, 8);
    const struct text bytes = part_write(&head, text_of("abc"), arena);
    struct part_file file;
    struct error error;
    CHECK(bytes.length == sizeof known - 1 && memcmp(bytes.start, known, bytes.length) == 0);
    CHECK(part_read("x.part", bytes, &file, &error));
    CHECK(text_equal(file.body, "abc") && text_equal(file.head.command, "render"));
    CHECK(file.head.seed == 7 && file.head.total == 1000 && file.head.part.number == 3);
    CHECK_TEXT(file.head.input.text, input);
    const struct text empty = part_write(&head, (struct text){NULL, 0}, arena);
    CHECK(part_read("x.part", empty, &file, &error) && file.body.length == 0);
    /* no beginning of it is a part, and no changed byte */
    size_t taken = 0;
    char *copy = arena_string(arena, bytes.start, bytes.length);
    for (size_t i = 0; i < bytes.length; i++) {
        taken += part_read("x.part", (struct text){bytes.start, i}, &file, &error);
        CHECK(error.code == ERROR_DATA && strcmp(error.source, "x.part") == 0);
    }
    CHECK(taken == 0);
    copy[bytes.length - 1] = 'd';
    CHECK(!part_read("x.part", (struct text){copy, bytes.length}, &file, &error));
    CHECK_TEXT(error.message, "the part is damaged: its body has another digest than it says");
}

static void check_bad(const char *content, const char *message, long line)
{
    struct part_file file;
    struct error error = {0};
    CHECK(!part_read("x.part", text_of(content), &file, &error));
    CHECK_TEXT(error.message, message);
    CHECK(error.line == line);
}

static void test_bad_files(void)
{
    check_bad("P6\n", "no part of a divided run", 0);
    check_bad("lenscalc part 2\n", "no part of a divided run", 0);
    check_bad("lenscalc part 1\ncommand render\nseed 7\n",
              "the head of a part must say 'words' here", 3);
    check_bad("lenscalc part 1\ncommand \n", "the head of a part must say 'command' here", 2);
    check_bad("lenscalc part 1\ncommand a\tb\nwords a\nversion 1.2\ninput a\nseed 7\npart 1/1\n"
              "items 1\ndone 1\nlength 0\nbody b\n\n",
              "'command a?b' is not what the head of a part says", 2);
#define BEGIN  "lenscalc part 1\ncommand render\nwords a b\nversion 1.2\ninput "
#define DIGEST "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"
    check_bad(BEGIN "abc\nseed 7\npart 1/1\nitems 1\ndone 1\nlength 0\nbody " DIGEST "\n\n",
              "'input abc' is not what the head of a part says", 5);
    check_bad(BEGIN DIGEST "\nseed -7\npart 1/1\nitems 1\ndone 1\nlength 0\nbody " DIGEST "\n\n",
              "'seed -7' is not what the head of a part says", 6);
    check_bad(BEGIN DIGEST "\nseed 7\npart 2/1\nitems 1\ndone 1\nlength 0\nbody " DIGEST "\n\n",
              "'part 2/1' is not what the head of a part says", 7);
    check_bad(BEGIN DIGEST "\nseed 7\npart 1/1\nitems 1\ndone 2\nlength 0\nbody " DIGEST "\n\n",
              "'done 2' is not what the head of a part says", 9);
    check_bad(BEGIN DIGEST "\nseed 7\npart 1/1\nitems 1\ndone 1\nlength 5\nbody " DIGEST "\n\nabc",
              "the part is cut off or longer than it says: 3 bytes, not 5", 0);
}

/* Words come back as they were, whatever is in them. */
static void test_words(struct arena *arena)
{
    char *words[] = {"render", "a b", "", "back\\slash", "caf\xc3\xa9\n", "--x=1"};
    enum { WORDS = sizeof words / sizeof *words };
    const struct text line = part_words(words, WORDS, arena);
    CHECK(text_equal(line, "render a\\040b \\000 back\\134slash caf\\303\\251\\012 --x=1"));
    int count;
    char **back = part_split(line, &count, arena);
    CHECK(back != NULL && count == WORDS);
    for (int i = 0; i < WORDS && back != NULL; i++) {
        CHECK_TEXT(back[i], words[i]);
    }
    CHECK(part_split(text_of("a\\08b"), &count, arena) == NULL);
    CHECK(part_split(text_of("a\\04"), &count, arena) == NULL);
    CHECK(part_split(text_of("a\\777"), &count, arena) == NULL);
    CHECK(part_split(text_of(""), &count, arena) != NULL && count == 0);
}

/* Any order of the files gives that of the parts. */
static void test_order(struct arena *arena)
{
    static const long shuffled[] = {3, 1, 4, 2};
    static const char *const paths[] = {"c", "a", "d", "b"};
    struct part_file files[5];
    struct error error = {0};
    for (size_t i = 0; i < 4; i++) {
        files[i] = (struct part_file){paths[i], head_of(shuffled[i], 4), text_of("")};
    }
    CHECK(parts_order(files, 4, true, arena, &error));
    for (size_t i = 0; i < 4; i++) {
        CHECK(files[i].head.part.number == (long)i + 1 && files[i].path[0] == (char)('a' + i));
    }
    files[4] = (struct part_file){"e", head_of(2, 4), text_of("")};
    CHECK(!parts_order(files, 5, true, arena, &error));
    CHECK_TEXT(error.message, "b and e are both part 2/4");
    struct part_file one[] = {{"b", head_of(2, 4), text_of("")}};
    CHECK(!parts_order(one, 1, true, arena, &error) && error.code == ERROR_DATA);
    CHECK_TEXT(error.message, "of the run of b there is no part 1/4, 3/4, 4/4");
    one[0].head = head_of(20, 20);
    CHECK(!parts_order(one, 1, true, arena, &error));
    CHECK(strstr(error.message, "11/20, 12/20 and 7 more") != NULL);
    one[0].head = head_of(1, 1);
    one[0].head.done = 999;
    CHECK(!parts_order(one, 1, true, arena, &error) && error.code == ERROR_DATA);
    CHECK(parts_order(one, 1, false, arena, &(struct error){0}));
    CHECK_TEXT(error.message, "b is incomplete: 999 of 1000 items; its run was interrupted");
}

static void check_stranger(struct part_head stranger, const char *message, struct arena *arena)
{
    struct part_file files[] = {{"a.part", head_of(1, 2), text_of("")},
                                {"b.part", stranger, text_of("")}};
    struct error error = {0};
    CHECK(!parts_order(files, 2, true, arena, &error) && error.code == ERROR_DATA);
    CHECK_TEXT(error.message, message);
}

static void test_strangers(struct arena *arena)
{
    struct part_head head = head_of(2, 2);
    head.command = text_of("tolerance");
    check_stranger(head, "b.part is not of the run of a.part: command tolerance, not render",
                   arena);
    head = head_of(2, 2);
    head.version = text_of("1.3");
    check_stranger(head, "b.part is not of the run of a.part: version 1.3, not 1.2", arena);
    head = head_of(2, 2);
    head.words = text_of("--seed=8 edge");
    check_stranger(head, "b.part is not of the run of a.part: asked --seed=8, not --seed=7", arena);
    head = head_of(2, 2);
    head.words = text_of("--seed=7");
    check_stranger(head, "b.part is not of the run of a.part: asked no edge, not edge", arena);
    head = head_of(2, 2);
    head.input.text[3] = '0';
    check_stranger(head, "b.part is not of the run of a.part: input 24806a61d206, not 248d6a61d206",
                   arena);
    head = head_of(2, 2);
    head.seed = 8;
    check_stranger(head, "b.part is not of the run of a.part: seed 8, not 7", arena);
    check_stranger(head_of(2, 3), "b.part is not of the run of a.part: part 2/3, not 1/2", arena);
    head = head_of(2, 2);
    head.total = 999;
    check_stranger(head, "b.part is not of the run of a.part: items 999, not 1000", arena);
}

int main(void)
{
    struct arena arena = {0};
    test_digest();
    test_items();
    test_ranges();
    test_parse();
    test_file(&arena);
    test_bad_files();
    test_words(&arena);
    test_order(&arena);
    test_strangers(&arena);
    arena_free(&arena);
    return check_report();
}
