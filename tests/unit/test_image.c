/* tests/unit/test_image.c - pictures in memory: limits, notes, sRGB, halves, checksums. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"
#include "base/image/exif.h"
#include "base/image/image.h"
#include "base/image/srgb.h"
#include "base/image/stb.h"
#include "check.h"

static bool is_refused(size_t width, size_t height, size_t channels, const char *message)
{
    struct arena arena = {0};
    struct error error = {0};
    struct image image = {.width = width, .height = height, .channels = channels};
    const bool refused = !image_new(&image, &arena, &error);
    arena_free(&arena);
    return refused && error.code == ERROR_DATA && strstr(error.message, message) != NULL;
}

static void test_limits(void)
{
    CHECK(is_refused(0, 5, 1, "0 x 5 pixels: there must be 1 to 65535 each way"));
    CHECK(is_refused(5, 65536, 1, "5 x 65536 pixels"));
    CHECK(is_refused(SIZE_MAX, SIZE_MAX, 1, "each way"));
    CHECK(is_refused(5, 5, 0, "0 channels: there must be 1 to 64"));
    CHECK(is_refused(5, 5, 65, "65 channels"));
    CHECK(is_refused(32768, 16384, 2, "32768 x 16384 pixels of 2 channels: at most 536870912"));
    struct arena arena = {0};
    struct error error = {0};
    struct image image = {.width = 65535, .height = 1, .channels = 64};
    CHECK(image_new(&image, &arena, &error) && image.pixels[65535 * 64 - 1] == 0);
    arena_free(&arena);
}

static void test_check(struct arena *arena)
{
    struct error error;
    struct image image = {.width = 3, .height = 2, .channels = 2};
    CHECK(image_new(&image, arena, &error) && image_check(&image, IMAGE_POSITIVE, &error));
    image_row(&image, 1)[2 * 2 + 1] = -1;
    CHECK(image_check(&image, IMAGE_FINITE, &error));
    CHECK(!image_check(&image, IMAGE_POSITIVE, &error));
    CHECK_TEXT(error.message,
               "channel 2 of the pixel in column 3, row 2 is -1: it must be a finite "
               "number of at least 0");
    image_row(&image, 0)[2] = INFINITY;
    CHECK(image_check(&image, IMAGE_NUMBERS, &error) && !image_check(&image, IMAGE_FINITE, &error));
    CHECK(strstr(error.message, "channel 1 of the pixel in column 2, row 1 is inf") != NULL);
    image_row(&image, 0)[0] = NAN;
    CHECK(!image_check(&image, IMAGE_NUMBERS, &error));
    CHECK(strstr(error.message, "column 1, row 1 is nan: it must be a number") != NULL);
}

static void test_names(struct arena *arena)
{
    static const char *const own[] = {"depth", "550nm"};
    static const char usual[][5] = {"Y", "YA", "RGB", "RGBA"};
    struct image image = {.channels = 2, .names = own};
    CHECK_TEXT(image_channel(&image, 1, arena), "550nm");
    image.names = NULL;
    for (image.channels = 1; image.channels <= 4; image.channels++) {
        for (size_t i = 0; i < image.channels; i++) {
            const char name[] = {usual[image.channels - 1][i], '\0'};
            CHECK_TEXT(image_channel(&image, i, arena), name);
        }
    }
    CHECK_TEXT(image_channel(&image, 4, arena), "5");
    image_note(&image, arena, text_of("Lens"), text_of("a\nb\tc\x7f"));
    image_note(&image, arena, text_of("Place"), text_of("f\xc3\xbcnf \xff\xc3"));
    image_note(&image, arena, text_of("a=b"), text_of("no key"));
    image_note(&image, arena, (struct text){"a\0b", 3}, text_of("no key"));
    image_note(&image, arena, text_of(""), text_of("no key"));
    CHECK(image.note_count == 2);
    CHECK_TEXT(image.notes[0].value, "a b c ");
    CHECK_TEXT(image.notes[1].key, "Place");
    CHECK_TEXT(image.notes[1].value, "f\xc3\xbcnf ??");
    /* copies have notes of their own */
    struct image other = image, third = image;
    image_note(&other, arena, text_of("Other"), text_of("1"));
    image_note(&third, arena, text_of("Third"), text_of("2"));
    image_note(&image, arena, text_of("First"), text_of("3"));
    image_note(&other, arena, text_of("Last"), text_of("4"));
    CHECK(image.note_count == 3 && other.note_count == 4 && third.note_count == 3);
    CHECK_TEXT(image.notes[2].key, "First");
    CHECK_TEXT(other.notes[2].key, "Other");
    CHECK_TEXT(other.notes[3].value, "4");
    CHECK_TEXT(third.notes[2].value, "2");
    CHECK_TEXT(third.notes[1].key, "Place");
    /* floods of them take a moment: as copies of all before each it would be 640 GB */
    for (size_t i = 0; i < 200000; i++) {
        image_note(&third, arena, text_of("More"), text_of("x"));
    }
    CHECK(third.note_count == 200003);
    CHECK_TEXT(third.notes[2].value, "2");
    CHECK_TEXT(third.notes[200002].key, "More");
}

/*
 * IEC 61966-2-1. Middle grey 0.18 is 0.4613561295; code 128 of 255 is 0.2158605001138992 of light,
 * 0.5 of light 0.7353569831 (all with bc, 20 digits).
 */
static void test_srgb(void)
{
    CHECK_NEAR(srgb_encoded(0.18), 0.46135612950044164, 1e-15, "0.18");
    CHECK_NEAR(srgb_encoded(0.5), 0.73535698305244945, 1e-15, "0.5");
    CHECK_NEAR(srgb_light(128 / 255.0), 0.21586050011389923, 1e-15, "128");
    CHECK_NEAR(srgb_encoded(0.001), 0.01292, 1e-17, "the straight part");
    CHECK_NEAR(srgb_light(0.01292), 0.001, 1e-18, "the straight part, back");
    CHECK(srgb_encoded(0) == 0 && fabs(srgb_encoded(1) - 1) < 1e-15 && srgb_light(1) == 1);
    CHECK(srgb_code(-1, 255, true) == 0 && srgb_code(0, 255, true) == 0);
    CHECK(srgb_code(1, 255, true) == 255 && srgb_code(INFINITY, 65535, true) == 65535);
    CHECK(srgb_code(0.5F, 65535, false) == 32768 && srgb_code(0.5F, 65535, true) == 48192);
    CHECK(srgb_code(1.499F / 255, 255, false) == 1 && srgb_code(1.501F / 255, 255, false) == 2);
}

/* Codes go to light and back unchanged, as floats, at 8 and 16 bits. */
static void test_codes(uint32_t most)
{
    size_t wrong = 0;
    for (uint32_t code = 0; code <= most; code++) {
        wrong += srgb_code((float)srgb_light((double)code / most), most, true) != code;
        wrong += srgb_code((float)((double)code / most), most, false) != code;
    }
    CHECK(wrong == 0);
}

/*
 * What srgb.h says of the same codes everywhere: of the floats on both sides of each light where
 * code k - 1 becomes k, none is encoded to within 1e-14 of k - 1/2, a hundred times what the last
 * bit of pow can do.
 */
static void test_borders(uint32_t most)
{
    double nearest = 1;
    for (uint32_t k = 1; k <= most; k++) {
        const float at = (float)srgb_light((k - 0.5) / most);
        const float around[] = {nextafterf(at, 0), at, nextafterf(at, 2)};
        for (int i = 0; i < 3; i++) {
            nearest = fmin(nearest, fabs(srgb_encoded((double)around[i]) - (k - 0.5) / most));
        }
    }
    CHECK(nearest > 1e-14);
}

/* IEEE 754: all 2^16 halves there and back, and roundings by hand. */
static void test_half(void)
{
    size_t wrong = 0;
    for (uint32_t half = 0; half < 65536; half++) {
        const float value = half_value((uint16_t)half);
        wrong += isnan(value) ? (half & 0x7fff) <= 0x7c00 : half_of_float(value) != half;
    }
    CHECK(wrong == 0);
    CHECK(half_value(0x3c00) == 1 && half_value(0xc000) == -2 && half_value(0x7bff) == 65504);
    CHECK(half_value(0x0001) == 0x1p-24F && half_value(0x0400) == 0x1p-14F);
    CHECK(half_value(0x3555) == 0x1.554p-2F && half_value(0xfc00) == -INFINITY);
    /* 1 + 2^-11 lies between two: to the even one; a little more goes up */
    CHECK(half_of_float(1 + 0x1p-11F) == 0x3c00 && half_of_float(1 + 3 * 0x1p-11F) == 0x3c02);
    CHECK(half_of_float(1 + 0x1.002p-11F) == 0x3c01);
    CHECK(half_of_float(2 - 0x1p-12F) == 0x4000 && half_of_float(-1e-9F) == 0x8000);
    CHECK(half_of_float(0x1p-25F) == 0 && half_of_float(0x1.8p-24F) == 2);
    CHECK(half_of_float(65519.9F) == 0x7bff && half_of_float(HALF_END) == 0x7c00);
    CHECK(half_of_float(0x1.ffcp-15F) == 0x0400 && half_of_float(0x1.ff8p-15F) == 0x03ff);
    CHECK(half_of_float(NAN) == 0x7e00);
}

static void test_bytes(struct arena *arena)
{
    static const unsigned char order[] = {1, 2, 3, 4, 5, 6, 7, 8};
    struct bytes bytes = {.arena = arena};
    CHECK(bytes_little(order, 4) == 0x04030201 && bytes_big(order, 8) == 0x0102030405060708);
    bytes_put_little(&bytes, 0x030201, 3);
    bytes_put_big(&bytes, 0x0405060708, 5);
    CHECK(bytes.used == 8 && memcmp(bytes.data, order, 8) == 0);
    CHECK(bytes_float(0x40490fdb) == 3.14159274F && bytes_bits(-2) == 0xc0000000);
    /* the published check of CRC-32, and of nothing */
    CHECK(crc_of("123456789", 9) == 0xcbf43926 && crc_of("", 0) == 0);
}

/* The definition, bit by bit. */
static uint32_t plain_crc(const unsigned char *data, size_t count)
{
    uint32_t crc = 0xffffffffU;
    for (size_t i = 0; i < count; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++) {
            crc = (crc & 1) != 0 ? crc >> 1 ^ 0xedb88320U : crc >> 1;
        }
    }
    return ~crc;
}

/* Of much data it is found several bytes at once. */
static void test_long_crc(struct arena *arena)
{
    enum { MOST = 40003 };
    unsigned char *data = ARENA_ARRAY(arena, MOST, unsigned char);
    for (size_t i = 0; i < MOST; i++) {
        data[i] = (unsigned char)(i * i >> 3 ^ i);
    }
    for (size_t from = 0; from < 9; from++) {
        CHECK(crc_of(data + from, MOST - 2 * from) == plain_crc(data + from, MOST - 2 * from));
        CHECK(crc_of(data, 16380 + from) == plain_crc(data, 16380 + from));
    }
}

/* Packed and unpacked; damage, and another length than was said, is seen. */
static void test_packing(struct arena *arena)
{
    /* "hello hello hello" by python's zlib.compress, level 9 */
    static const char known[] = "\x78\xda\xcb\x48\xcd\xc9\xc9\x57\xc8\x40\x90\x00\x3a\x2e\x06\x7d";
    unsigned char back[100000], data[100000];
    for (size_t i = 0; i < sizeof data; i++) {
        data[i] = (unsigned char)(i * i >> 7);
    }
    CHECK(stb_unpack((struct text){known, 16}, back, 17) && !memcmp(back, "hello hello hello", 17));
    CHECK(!stb_unpack((struct text){known, 16}, back, 16));
    CHECK(!stb_unpack((struct text){known, 16}, back, 18));
    CHECK(!stb_unpack((struct text){known, 15}, back, 17));
    for (size_t count = 1; count <= sizeof data; count = 3 * count + 1) {
        struct bytes packed = {.arena = arena};
        stb_pack(&packed, data, count);
        CHECK(stb_unpack(bytes_text(&packed), back, count) && memcmp(back, data, count) == 0);
        packed.data[packed.used - 1] ^= 1;
        CHECK(!stb_unpack(bytes_text(&packed), back, count));
    }
}

/* Of an entry that is there twice, ISO 100 and 200, the first counts. */
/* Rows that are zeros, and rows that are not, in any order; long ones are more than one block. */
static void test_storing(struct arena *arena)
{
    enum { ROWS = 8, STRIDE_MOST = 70000 };
    static const size_t strides[] = {1, 2, 257, 258, 259, 517, STRIDE_MOST};
    unsigned char *data = ARENA_ARRAY(arena, ROWS * STRIDE_MOST, unsigned char);
    unsigned char *back = ARENA_ARRAY(arena, ROWS * STRIDE_MOST, unsigned char);
    for (size_t i = 0; i < sizeof strides / sizeof *strides; i++) {
        const size_t stride = strides[i], count = ROWS * stride;
        for (unsigned lit = 0; lit < 1U << ROWS; lit += stride < STRIDE_MOST ? 1 : 51) {
            struct bytes stored = {.arena = arena};
            for (size_t k = 0; k < count; k++) {
                data[k] = lit >> k / stride & 1 ? (unsigned char)(1 + k % 255) : 0;
            }
            stb_store(&stored, data, ROWS, stride);
            CHECK(stb_unpack(bytes_text(&stored), back, count) && !memcmp(back, data, count));
            CHECK(lit != 0 || stored.used < count / 100 + 300);
        }
    }
}

static void test_exif(struct arena *arena)
{
    static const unsigned char data[] = {'I', 'I', 42, 0, 8, 0, 0,   0, 2, 0, 0x27, 0x88,
                                         3,   0,   1,  0, 0, 0, 100, 0, 0, 0, 0x27, 0x88,
                                         3,   0,   1,  0, 0, 0, 200, 0, 0, 0};
    struct image image = {.width = 1, .height = 1, .channels = 3};
    exif_notes((struct text){(const char *)data, sizeof data}, &image, arena);
    CHECK(image.note_count == 1 && strcmp(image.notes[0].value, "100") == 0);
}

/* The least proportion of pixels that may be written, in single precision, is read again. */
static void test_proportions(void)
{
    struct image image = {0};
    CHECK(image_take_aspect(&image, (double)1e-6F) && image_take_aspect(&image, 1e6));
    CHECK(!image_take_aspect(&image, 9.9e-7) && !image_take_aspect(&image, 1.01e6));
    CHECK(!image_take_aspect(&image, NAN) && !image_take_aspect(&image, -1));
}

int main(void)
{
    struct arena arena = {0};
    test_exif(&arena);
    test_proportions();
    test_limits();
    test_check(&arena);
    test_names(&arena);
    test_srgb();
    test_codes(255);
    test_codes(65535);
    test_borders(255);
    test_borders(65535);
    test_half();
    test_bytes(&arena);
    test_long_crc(&arena);
    test_packing(&arena);
    test_storing(&arena);
    arena_free(&arena);
    return check_report();
}
