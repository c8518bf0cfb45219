/* tests/unit/test_exif.c - Exif data made by hand, as [Exif10] lays them out, whole and damaged. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "exchange/metadata/exiftool.h"
#include "exchange/metadata/photo_file.h"
#include "exif_memory.h"

#include <stdint.h>

/* A file that is written: in one of two byte orders. */
struct made {
    unsigned char bytes[512];
    size_t length;
    bool is_big;
};

static void put(struct made *made, unsigned long number, int count)
{
    for (int i = 0; i < count; i++) {
        const int shift = 8 * (made->is_big ? count - 1 - i : i);
        made->bytes[made->length++] = (unsigned char)(number >> shift);
    }
}

static void put_tag(struct made *made, unsigned tag, unsigned type, unsigned long count,
                    unsigned long value)
{
    put(made, tag, 2);
    put(made, type, 2);
    put(made, count, 4);
    /* two bytes stand at the begin of four */
    put(made, value, type == 3 ? 2 : 4);
    put(made, 0, type == 3 ? 2 : 0);
}

static void put_text(struct made *made, const char *text)
{
    memcpy(made->bytes + made->length, text, strlen(text) + 1);
    made->length += strlen(text) + 1;
}

static void begin(struct made *made, bool is_big)
{
    *made = (struct made){.is_big = is_big};
    put_text(made, is_big ? "MM" : "II");
    made->length = 2;
    put(made, 42, 2);
    put(made, 8, 4);
}

enum { FIRST = 8, SECOND = 100, VALUES = 250 };

/* Camera, settings at SECOND, values at VALUES; `distance` is a rational. */
static void make(struct made *made, bool is_big, const uint32_t distance[2])
{
    begin(made, is_big);
    put(made, 3, 2);
    put_tag(made, 0x10f, 2, 4, is_big ? 0x41626300 : 0x00636241); /* "Abc" fits in four bytes */
    put_tag(made, 0x110, 2, 9, VALUES);
    put_tag(made, 0x8769, 4, 1, SECOND);
    made->length = SECOND;
    put(made, 8, 2);
    put_tag(made, 0x829a, 5, 1, VALUES + 16);  /* 10/1250 s */
    put_tag(made, 0x829d, 5, 1, VALUES + 24);  /* 28/10 */
    put_tag(made, 0x8827, 3, 2, 400);          /* two shorts: the first counts */
    put_tag(made, 0x9201, 10, 1, VALUES + 40); /* not asked: there is an exposure time */
    put_tag(made, 0x9206, 5, 1, VALUES + 48);
    put_tag(made, 0x920a, 5, 1, VALUES + 56); /* 50/1 */
    put_tag(made, 0xa405, 3, 1, 75);
    put_tag(made, 0xffff, 7, 0xffffffff, 0xffffffff);
    made->length = VALUES;
    put_text(made, "Model 7 ");
    made->length = VALUES + 16;
    const uint32_t values[] = {10, 1250, 28, 10, 0, 0, 0xfffffff9, 1};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        put(made, values[i], 4);
    }
    put(made, distance[0], 4);
    put(made, distance[1], 4);
    put(made, 50, 4);
    put(made, 1, 4);
}

static bool read_made(const struct made *made, size_t length, struct metadata *metadata)
{
    /* a copy that ends where its memory ends, so that a sanitizer sees what is read behind it */
    char *copy = malloc(length > 0 ? length : 1);
    struct error error = {0};
    if (length > 0) {
        memcpy(copy, made->bytes, length);
    }
    const struct exif_bytes bytes = exif_memory(copy, length);
    const bool done = exif_read(&bytes, metadata, &error);
    CHECK(done || error.code == ERROR_DATA);
    free(copy);
    return done;
}

static void test_values(bool is_big)
{
    static const struct {
        uint32_t ratio[2];
        double distance; /* mm */
    } distances[] = {
        {{32, 10}, 3200},     {{0xffffffff, 1}, INFINITY},     {{0, 1}, NAN},
        {{0, 0}, NAN},        {{0xffffffff, 10}, INFINITY},    {{7, 0}, INFINITY},
        {{1, 1000000}, 1e-3}, {{0xfffffffe, 1}, 4294967294e3},
    };
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        struct made made;
        struct metadata read;
        const double expected = distances[i].distance;
        make(&made, is_big, distances[i].ratio);
        CHECK(read_made(&made, made.length, &read));
        CHECK(strcmp(read.make, "Abc") == 0 && strcmp(read.model, "Model 7") == 0);
        CHECK(read.time == 0.008 && read.fnumber == 2.8 && read.iso == 400);
        CHECK(read.focal == 50 && read.equivalent == 75 && isnan(read.long_side));
        CHECK(isnan(expected)
                  ? isnan(read.distance)
                  : read.distance == expected || fabs(read.distance / expected - 1) < 1e-15);
    }
}

/* Cut anywhere the rest is read, or refused: nothing behind it is looked at. */
static void test_cut(bool is_big)
{
    static const uint32_t distance[2] = {3, 1};
    struct made made;
    struct metadata read;
    make(&made, is_big, distance);
    for (size_t length = 0; length < made.length; length++) {
        const bool done = read_made(&made, length, &read);
        CHECK(done == (length >= SECOND + 2 + 8 * 12));
        CHECK(isnan(read.focal) || read.focal == 50);
        CHECK(isnan(read.distance) || read.distance == 3000);
        CHECK(!done || read.equivalent == 75);
    }
}

/* Lists that name themselves or the start, and one of 65535 tags. */
static void test_loops(bool is_big)
{
    static const unsigned long places[] = {0, 8, 4, 0xffffffff, 0xfffffff0, 300};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        struct made made;
        struct metadata read;
        begin(&made, is_big);
        put(&made, 2, 2);
        put_tag(&made, 0x8769, 4, 1, places[i]);
        put_tag(&made, 0x8827, 3, 1, 200);
        put(&made, 8, 4); /* the next list is this one */
        read_made(&made, made.length, &read);
        CHECK(read.iso == 200);
        begin(&made, is_big);
        put(&made, 0xffff, 2);
        put_tag(&made, 0x8827, 3, 1, 200);
        CHECK(!read_made(&made, made.length, &read) && read.iso == 200);
    }
}

/* APEX: T = 6 is 1/64 s, A = 5 is f/5.657 ([Exif10] annex C); and sensitivities beyond 65535. */
static void test_other_tags(bool is_big)
{
    struct made made;
    struct metadata read;
    begin(&made, is_big);
    put(&made, 5, 2);
    put_tag(&made, 0x9201, 10, 1, VALUES);
    put_tag(&made, 0x9202, 5, 1, VALUES + 8);
    put_tag(&made, 0x8827, 3, 1, 65535);
    put_tag(&made, 0x8831, 4, 1, 102400);
    put_tag(&made, 0x8832, 4, 1, 204800);
    made.length = VALUES;
    put(&made, 6, 4);
    put(&made, 1, 4);
    put(&made, 5, 4);
    put(&made, 1, 4);
    CHECK(read_made(&made, made.length, &read));
    CHECK(read.time == 1.0 / 64 && fabs(read.fnumber - 5.656854249492381) < 1e-15);
    CHECK(read.iso == 204800);
}

/* Of a JPEG segments are passed over, fill bytes too; the frame has the size. */
static void test_jpeg(void)
{
    static const uint32_t distance[2] = {3, 1};
    static const unsigned char before[] = {0xff, 0xd8, 0xff, 0xff, 0xff, 0xe0, 0, 4, 1, 2};
    static const unsigned char frame[] = {0xff, 0xc2, 0,    11, 8,    0x0f, 0xa0, 0x17, 0x70,
                                          1,    1,    0x11, 0,  0xff, 0xda, 0,    2};
    struct made made, file = {.is_big = true};
    struct metadata read;
    make(&made, true, distance);
    memcpy(file.bytes, before, sizeof before);
    file.length = sizeof before;
    put(&file, 0xffe1, 2);
    put(&file, (unsigned)made.length + 8, 2);
    put_text(&file, "Exif");
    put(&file, 0, 1);
    memcpy(file.bytes + file.length, made.bytes, made.length);
    file.length += made.length;
    memcpy(file.bytes + file.length, frame, sizeof frame);
    file.length += sizeof frame;
    CHECK(read_made(&file, file.length, &read));
    CHECK(read.long_side == 6000 && read.low_side == 4000 && read.distance == 3000);
    /* without that segment */
    file.bytes[sizeof before + 1] = 0xe2;
    CHECK(!read_made(&file, file.length, &read) && isnan(read.distance));
}

static void test_names(void)
{
    char kept[METADATA_NAME];
    metadata_name(kept, (struct text){" A\nb\x1b[31m\xff  \0tail", 18});
    CHECK(strcmp(kept, "A?b?[31m?") == 0);
    static const char long_name[] =
        "0123456789012345678901234567890123456789012345678901234567890123456789";
    metadata_name(kept, text_of(long_name));
    CHECK(strlen(kept) == METADATA_NAME - 1);
    CHECK(photo_is_plain(photo_ending(text_of("a.JPG"))));
    CHECK(!photo_is_plain(photo_ending(text_of("a.Cr3"))));
    CHECK(photo_ending(text_of("a.csv")) == NULL);
    CHECK(photo_ending(text_of(".jpg")) == NULL);
}

/* What exiftool 12.57 prints; names with '?' for what is no UTF-8; the end of it missing. */
static void test_exiftool(struct arena *arena)
{
    static const char printed[] =
        "[{\n  \"SourceFile\": \"a\\nb}.jpg\",\n  \"Model\": \"X 1\",\n  \"FocalLength\": 50,\n"
        "  \"ShutterSpeed\": 0.01666666667,\n  \"FocusDistance\": \"inf\",\n"
        "  \"SubjectDistance\": \"3 m\"\n},\n"
        "{\n  \"SourceFile\": \"c?.jpg\",\n  \"FocalLength\": \"undef\",\n  \"Aperture\": "
        "\"inf\",\n"
        "  \"FocusDistance\": \"0 m\",\n  \"ObjectDistance\": 700,\n"
        "  \"FocusDistanceLower\": \"2 m\",\n  \"FocusDistanceUpper\": \"inf\"\n},\n"
        "{\n  \"SourceFile\": \"e.jpg\",\n  \"SubjectDistance\": \"4294967295 m\"\n},\n"
        "{\n  \"SourceFile\": \"f.jpg\",\n  \"ISO\": 100";
    struct exiftool_file files[] = {{.path = "a\nb}.jpg"},
                                    {.path = "c\xff.jpg"},
                                    {.path = "d.jpg"},
                                    {.path = "e.jpg"},
                                    {.path = "f.jpg"}};
    exiftool_take(text_of(printed), files, 5, arena);
    const struct metadata *a = &files[0].metadata, *c = &files[1].metadata;
    CHECK(files[0].is_answered && files[1].is_answered && files[3].is_answered);
    CHECK(!files[2].is_answered && !files[4].is_answered);
    CHECK(strcmp(a->model, "X 1") == 0 && a->focal == 50 && a->time == 0.01666666667);
    CHECK(isinf(a->distance) && isnan(a->iso));
    /* the middle, in the image space, of 2 m to infinity is 4 m */
    CHECK(isnan(c->focal) && isnan(c->fnumber) && c->distance == 4000);
    CHECK(isinf(files[3].metadata.distance));
    exiftool_take(text_of("not json"), files, 5, arena);
    exiftool_take(text_of(""), files, 5, arena);
}

int main(void)
{
    struct arena arena = {0};
    for (int is_big = 0; is_big < 2; is_big++) {
        test_values(is_big == 1);
        test_cut(is_big == 1);
        test_loops(is_big == 1);
        test_other_tags(is_big == 1);
    }
    test_jpeg();
    test_names();
    test_exiftool(&arena);
    arena_free(&arena);
    return check_report();
}
