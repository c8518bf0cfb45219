/* tests/unit/test_pictures.c - formats of pictures: there and back, refused, cut, damaged. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"
#include "check.h"
#include "file/image_file.h"

#include <stdlib.h>

/*
 * Also the tool of tests/truth/check_pictures_files.py, which reads and writes these formats by
 * itself: `test_pictures write DIR` writes one of each kind, `test_pictures read FILE light|codes`
 * prints size, channels, names, pixels and notes, or the error.
 */

/* A picture whose every value is known: python has the same formula. */
static struct image make(size_t width, size_t height, size_t channels, struct arena *arena)
{
    struct error error;
    struct image image = {.width = width, .height = height, .channels = channels};
    CHECK(image_new(&image, arena, &error));
    for (size_t y = 0; y < height; y++) {
        for (size_t x = 0; x < width; x++) {
            for (size_t k = 0; k < channels; k++) {
                const size_t value = (x / 5 * 7 + y * 13 + k * 29) % 101;
                image_row(&image, y)[x * channels + k] = (float)value / 100;
            }
        }
    }
    image_note(&image, arena, text_of("Lens"), text_of("double-gauss"));
    image_note(&image, arena, text_of("Place"), text_of("f\xc3\xbcnf"));
    return image;
}

static const struct file_type *type_of(const char *ending)
{
    return file_type_of(image_file_types, text_of(ending));
}

static struct text encode(const struct image *image, const char *name, struct image_way way,
                          struct arena *arena)
{
    struct text bytes = {NULL, 0};
    struct error error;
    CHECK(image_file_bytes(image, type_of(name), &way, arena, &bytes, &error));
    return bytes;
}

/* What is written, how exactly it comes back, and for what it is. */
static const struct kind {
    const char *name;
    struct image_way way;
    size_t channels;
    double absolute, relative;
    bool has_notes;
} kinds[] = {
    {"grey8.png", {.bits = 8, .values = IMAGE_CODES}, 1, 0.5 / 255, 0, true},
    {"alpha8.png", {.bits = 8, .values = IMAGE_CODES}, 2, 0.5 / 255, 0, true},
    {"color8.png", {.bits = 8, .values = IMAGE_LIGHT}, 3, 0.0045, 0, true},
    {"alpha16.png", {.bits = 16, .values = IMAGE_LIGHT}, 4, 2e-5, 0, true},
    {"color16.png", {.bits = 16, .values = IMAGE_CODES}, 3, 0.5 / 65535, 0, true},
    {"stored8.png", {.bits = 8, .values = IMAGE_LIGHT, .stored = true}, 3, 0.0045, 0, true},
    {"stored16.png",
     {.bits = 16, .values = IMAGE_CODES, .stored = true, .threads = 3},
     4,
     0.5 / 65535,
     0,
     true},
    {"grey16.png", {.bits = 16, .values = IMAGE_CODES}, 1, 0.5 / 65535, 0, true},
    {"color.pfm", {.bits = 0}, 3, 0, 0, false},
    {"grey.pfm", {.bits = 0}, 1, 0, 0, false},
    {"color.hdr", {.bits = 0}, 3, 0.5 / 256, 0, true},
    {"half.exr", {.half = true, .packed = true}, 3, 0, 0.5 / 1024, true},
    {"float.exr", {.half = false, .packed = true}, 4, 0, 0, true},
    {"stored.exr", {.half = false, .stored = true}, 3, 0, 0, true},
    {"plain.exr", {.half = false, .packed = false}, 1, 0, 0, true},
    {"many.exr", {.half = true, .packed = false}, 7, 0, 0.5 / 1024, true},
};
static const struct image_wish as_light = {.values = IMAGE_LIGHT},
                               as_codes = {.values = IMAGE_CODES};

enum { KINDS = sizeof kinds / sizeof *kinds, WIDTH = 37, HEIGHT = 21 };

static void check_same(const struct image *image, const struct image *back, const struct kind *kind)
{
    CHECK(back->width == image->width && back->height == image->height);
    CHECK(back->channels == image->channels);
    double worst = 0;
    const size_t count = image->width * image->height * image->channels;
    for (size_t i = 0; i < count && back->channels == image->channels; i++) {
        const double off = fabs((double)back->pixels[i] - (double)image->pixels[i]);
        worst = fmax(worst, off - kind->relative * fabs((double)image->pixels[i]));
    }
    /* in floats of up to 1, themselves rounded by 2^-25 */
    CHECK_NEAR(worst, 0, kind->absolute > 0 ? kind->absolute + 0x1p-24 : 0, kind->name);
    CHECK(back->note_count == (kind->has_notes ? image->note_count : 0));
    for (size_t i = 0; i < back->note_count; i++) {
        CHECK_TEXT(back->notes[i].key, image->notes[i].key);
        CHECK_TEXT(back->notes[i].value, image->notes[i].value);
    }
}

static void test_round_trips(struct arena *arena)
{
    for (size_t i = 0; i < KINDS; i++) {
        const struct kind *kind = &kinds[i];
        struct error error = {0};
        struct image back, image = make(WIDTH, HEIGHT, kind->channels, arena);
        struct text bytes = encode(&image, kind->name, kind->way, arena);
        const bool done = image_file_parse(
            "x", bytes, &(struct image_wish){.values = kind->way.values}, arena, &back, &error);
        CHECK_TEXT(done ? "" : error.message, "");
        if (done) {
            check_same(&image, &back, kind);
        }
        /* the smallest there is */
        image = make(1, 1, kind->channels, arena);
        bytes = encode(&image, kind->name, kind->way, arena);
        CHECK(image_file_parse("x", bytes, &(struct image_wish){.values = kind->way.values}, arena,
                               &back, &error));
        CHECK(back.width == 1 && back.height == 1);
    }
}

/* What is not packed has as many bytes as it has; blocks of them end at 65535. */
static void test_stored(struct arena *arena)
{
    enum { ROWS = 4369 }; /* so many of 15 bytes are one block, of 30 two */
    const struct image_way way = {.bits = 8, .values = IMAGE_CODES, .stored = true};
    const size_t widths[] = {14, 29, 30, 100};
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        struct error error = {0};
        struct image back, image = make(widths[i], ROWS, 1, arena);
        const struct text bytes = encode(&image, "x.png", way, arena);
        const size_t plain = (widths[i] + 1) * ROWS, blocks = (plain + 65534) / 65535;
        CHECK(bytes.length > plain + 5 * blocks && bytes.length < plain + 5 * blocks + 300);
        CHECK(image_file_parse("x", bytes, &as_codes, arena, &back, &error));
        check_same(&image, &back, &kinds[0]);
    }
}

/* OpenEXR in a hurry: blocks of 16 rows as they are, but for black ones, which take no room. */
static void test_black_blocks(struct arena *arena)
{
    enum { BLACK_ROWS = 100, BLOCK_BYTES = 16 * WIDTH * 3 * 4 };
    struct error error = {0};
    struct image back, image = make(WIDTH, BLACK_ROWS, 3, arena);
    memset(image_row(&image, 20), 0, (BLACK_ROWS - 20) * WIDTH * 3 * sizeof(float));
    image_row(&image, 70)[5] = -0.0F; /* not black: it has a sign */
    const struct text bytes = encode(&image, "x.exr", (struct image_way){.stored = true}, arena);
    /* rows 0 .. 31 and 64 .. 79; the last four are too few to be like others */
    CHECK(bytes.length > 3 * BLOCK_BYTES && bytes.length < 7 * BLOCK_BYTES / 2 + 1000);
    CHECK(image_file_parse("x", bytes, &as_light, arena, &back, &error));
    CHECK(memcmp(back.pixels, image.pixels, BLACK_ROWS * WIDTH * 3 * sizeof(float)) == 0);
}

/* What has more pixels than wished is refused in every format, and nothing of it is unpacked. */
static void test_wished(struct arena *arena)
{
    const struct image_wish enough = {IMAGE_CODES, (size_t)WIDTH * HEIGHT};
    const struct image_wish fewer = {IMAGE_CODES, (size_t)WIDTH * HEIGHT - 1};
    for (size_t i = 0; i < KINDS; i++) {
        struct error error = {0};
        struct image back, image = make(WIDTH, HEIGHT, kinds[i].channels, arena);
        const struct text bytes = encode(&image, kinds[i].name, kinds[i].way, arena);
        CHECK(image_file_parse("x", bytes, &enough, arena, &back, &error));
        back.pixels = NULL;
        CHECK(!image_file_parse("x", bytes, &fewer, arena, &back, &error));
        CHECK(error.code == ERROR_DATA && back.pixels == NULL);
        CHECK_TEXT(error.message, "37 x 21 pixels: at most 776");
    }
}

/* A copy that ends where its memory ends, so that sanitizers see what reads on. */
static bool parses(struct text bytes, size_t length, struct error *error)
{
    struct arena arena = {0};
    struct image image;
    char *copy = malloc(length + 1);
    memcpy(copy, bytes.start, length);
    const bool done =
        image_file_parse("x", (struct text){copy, length}, &as_light, &arena, &image, error);
    arena_free(&arena);
    free(copy);
    return done;
}

/* Every beginning of a file is refused: nothing incomplete is taken for a picture. */
static void test_truncated(struct arena *arena)
{
    for (size_t i = 0; i < KINDS; i++) {
        const struct image image = make(11, 5, kinds[i].channels, arena);
        const struct text bytes = encode(&image, kinds[i].name, kinds[i].way, arena);
        struct error error;
        size_t taken = 0;
        CHECK(parses(bytes, bytes.length, &error));
        for (size_t length = 0; length < bytes.length; length++) {
            taken += parses(bytes, length, &error) || error.code != ERROR_DATA ||
                     error.message[0] == '\0';
        }
        CHECK(taken == 0);
    }
}

/* A bit turned over: PNG and packed OpenEXR have checksums of their pixels; no other crashes. */
static void test_damaged(struct arena *arena)
{
    for (size_t i = 0; i < KINDS; i++) {
        const struct image image = make(11, 5, kinds[i].channels, arena);
        const struct text bytes = encode(&image, kinds[i].name, kinds[i].way, arena);
        char *data = arena_string(arena, bytes.start, bytes.length);
        size_t taken = 0;
        for (size_t bit = 0; bit < 8 * bytes.length; bit += 3) {
            struct error error;
            data[bit / 8] = (char)(data[bit / 8] ^ 1 << bit % 8);
            taken += parses((struct text){data, bytes.length}, bytes.length, &error);
            data[bit / 8] = (char)(data[bit / 8] ^ 1 << bit % 8);
        }
        CHECK(strstr(kinds[i].name, ".png") == NULL || taken == 0);
    }
}

struct refusal {
    const char *bytes;
    size_t length;
    const char *message;
};
#define BYTES(string) string, sizeof(string) - 1

/* Heads that promise what cannot be, and what is of no format. */
static void test_refused(void)
{
    static const struct refusal refusals[] = {
        {BYTES(""), "neither PNG, JPEG, OpenEXR, PFM nor a Radiance picture"},
        {BYTES("GIF89a"), "neither PNG"},
        {BYTES("PF\n0 5\n-1\n"), "PFM: width 0: it must be a whole number, 1 to 65535"},
        {BYTES("PF\n2.5 5\n-1\n"), "PFM: width 2.5"},
        {BYTES("PF\n70000 5\n-1\n"), "PFM: width 70000"},
        {BYTES("PF\n5 x\n-1\n"), "PFM: no height at byte 5"},
        {BYTES("PF\n5 5\n0\n"), "PFM: scale 0"},
        {BYTES("PF\n5 5\ninf\n"), "PFM: scale inf: it must be a finite number other than 0"},
        {BYTES("PF\n65535 65535\n-1.0\nabcd"),
         "PFM: 4 bytes of pixels, and 65535 x 65535 pixels of 3 channels have 51538034700"},
        {BYTES("Pf\n1 1\n-1\n\0\0\0\0\0"), "PFM: 5 bytes of pixels, and 1 x 1 pixels of 1 "
                                           "channels have 4"},
        {BYTES("Pf\n1 1\n-1\n\0\0\xc0\x7f"), "column 1, row 1 is nan: it must be a number"},
        {BYTES("#?RADIANCE\nFORMAT=32-bit_rle_luv\n\n-Y 1 +X 1\nabcd"),
         "Radiance: format '32-bit_rle_luv' is neither"},
        {BYTES("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd"),
         "Radiance: line 2: EXPOSURE '0' must be a number of 1e-38 to 1e+38"},
        {BYTES("#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\nabcd"),
         "Radiance: line 2: COLORCORR '1 2' must be three numbers of 1e-38 to 1e+38"},
        {BYTES("#?RADIANCE\n\n+X 1 -X 1\nabcd"), "Radiance: '+X 1 -X 1' is no size like"},
        {BYTES("#?RADIANCE\n\n-Y 1 -Y 1\nabcd"), "Radiance: '-Y 1 -Y 1' is no size like"},
        {BYTES("#?RADIANCE\n\n+X 2 -Y 1\nabcd\1\1\1\5"),
         "Radiance: column 2 is packed in the old way"},
        {BYTES("#?RADIANCE\nPRIMARIES=1 2 3\n\n-Y 1 +X 1\nabcd"),
         "Radiance: line 2: PRIMARIES '1 2 3' must be eight numbers"},
        {BYTES("#?RADIANCE\nPRIMARIES=.3 .3 .3 .3 .3 .3 .3 .3\n\n-Y 1 +X 1\nabcd"),
         "the primaries cannot make the white x, y = 0.3, 0.3"},
        {BYTES("#?RADIANCE\n\n-Y 999999999999 +X 1\nabcd"), "is no size like"},
        {BYTES("#?RADIANCE\n\n-Y 60000 +X 60000\nabcd"),
         "Radiance: 60000 x 60000 pixels do not come from 4 bytes"},
        {BYTES("#?RADIANCE\n\n-Y 0 +X 1\nabcd"), "1 x 0 pixels: there must be 1 to 65535"},
        {BYTES("#?RADIANCE\n\n-Y 1 +X 2\nabcd\1\1\1\5"),
         "Radiance: row 1 is packed in the old way"},
        {BYTES("#?RADIANCE\n\n-Y 1 +X 8\n\2\2\0\7\210\1\210\1\210\1\210\1"),
         "Radiance: row 1 says it has 7 pixels, not 8"},
        {BYTES("#?RADIANCE\n\n-Y 1 +X 8\n\2\2\0\10\211\1\210\1\210\1\210\1"),
         "Radiance: byte 26, in row 1, makes it longer than 8 pixels"},
        {BYTES("\x76\x2f\x31\x01\2\2\0\0"), "OpenEXR: version 2 with flags 0x200"},
        {BYTES("\x76\x2f\x31\x01\2\0\0\0"), "OpenEXR: the name at byte 8 has no end"},
        {BYTES("\x76\x2f\x31\x01\2\0\0\0\0"), "OpenEXR: its head lacks channels"},
        {BYTES("\x76\x2f\x31\x01\2\0\0\0compression\0compression\0\1\0\0\0\4"),
         "OpenEXR: compression PIZ (4) is not read: none, RLE, ZIPS and ZIP are"},
        {BYTES("\x76\x2f\x31\x01\2\0\0\0compression\0compression\0\2\0\0\0\1\1"),
         "OpenEXR: attribute 'compression' has 2 bytes, not 1"},
        {BYTES("\x76\x2f\x31\x01\2\0\0\0a\0string\0\xff\xff\xff\xff"),
         "OpenEXR: ends at byte 21, within its head"},
        {BYTES("\xff\xd8\xff\xd9"), "JPEG: there is no picture in it"},
        {BYTES("\xff\xd8\xff\xe0\0\1"), "JPEG: no segment begins at byte 2"},
        {BYTES("\xff\xd8\xff\xc0\0\x0b\x08\xff\xff\xff\xff\1\1\x11\0\xff\xd9"),
         "JPEG: 65535 x 65535 pixels do not come from 17 bytes"},
        {BYTES("\xff\xd8\xff\xc4\0\x16\0\xff\xff\0\0\0\0\0\0\0\0\0\0\0\0\0\0\1\xff\xd9"),
         "JPEG: no Huffman tables at byte 2"},
        {BYTES("\x89PNG\r\n\x1a\n"), "PNG: ends at byte 8, before its end mark"},
        {BYTES("\x89PNG\r\n\x1a\n\0\0\0\0IEND\xae\x42\x60\x82"),
         "PNG: chunk 'IEND' at byte 8 is not where it belongs"},
        {BYTES("\x89PNG\r\n\x1a\n\0\0\0\0I3ND\xae\x42\x60\x82"), "PNG: no chunk begins at byte 8"},
        {BYTES("\x89PNG\r\n\x1a\n\xff\xff\xff\xffIHDR\0\0\0\0"),
         "PNG: chunk 'IHDR' at byte 8 has 4294967295 bytes, and the file ends at byte 20"},
    };
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        struct error error = {0};
        CHECK(!parses((struct text){refusals[i].bytes, refusals[i].length}, refusals[i].length,
                      &error));
        if (strstr(error.message, refusals[i].message) == NULL) {
            CHECK_TEXT(error.message, refusals[i].message);
        }
        CHECK(error.code == ERROR_DATA && strcmp(error.source, "x") == 0);
    }
}

static void check_unwritten(const struct image *image, const char *name, struct image_way way,
                            const char *message)
{
    struct arena arena = {0};
    struct error error = {0};
    struct text bytes;
    CHECK(!image_file_bytes(image, type_of(name), &way, &arena, &bytes, &error));
    CHECK(error.code == ERROR_DATA);
    CHECK_TEXT(error.message, message);
    arena_free(&arena);
}

/* Values that a format does not have. */
static void test_unwritten(struct arena *arena)
{
    const struct image_way way = {.bits = 8, .half = true};
    struct image image = make(2, 2, 3, arena);
    image.pixels[3] = -1;
    check_unwritten(&image, "x.hdr", way,
                    "channel 1 of the pixel in column 2, row 1 is -1: it must "
                    "be a finite number of at least 0");
    image.pixels[3] = 3e38F;
    check_unwritten(
        &image, "x.hdr", way,
        "the pixel in column 2, row 1 is 3e+38: a Radiance picture has at most 1.69e38");
    image.pixels[3] = 65520;
    check_unwritten(&image, "x.exr", way, "a value of 65520: half floats reach to 65504");
    image.pixels[3] = NAN;
    for (size_t i = 0; image_file_types(i) != NULL; i++) {
        const char *name = ARENA_JOIN(arena, "x", image_file_types(i)->ending);
        check_unwritten(&image, name, way,
                        strcmp(name, "x.hdr") == 0
                            ? "channel 1 of the pixel in column 2, row 1 is nan: it must be a "
                              "finite number of at least 0"
                            : "channel 1 of the pixel in column 2, row 1 is nan: it must be a "
                              "number");
    }
    image = make(2, 2, 5, arena);
    check_unwritten(&image, "x.png", way, "a PNG has 1 to 4 channels, not 5");
    check_unwritten(&image, "x.pfm", way, "a PFM has 1 channel or 3, not 5");
    check_unwritten(&image, "x.hdr", way, "a Radiance picture has 1 channel or 3, not 5");
}

/* Names choose what is written, content what is read. */
static void put_big(char *to, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (char)(value >> (24 - 8 * i) & 255);
    }
}

/* Pixels a unit, 1 the metre: small numbers are their ratio, 2835 and 2836 a metre both 72 dpi. */
static void test_aspect(struct arena *arena)
{
    static const struct {
        uint32_t across, down;
        char unit;
        double aspect; /* 0: square */
    } cases[] = {
        {1, 2, 0, 2},
        {2, 1, 1, 0.5},
        {11, 10, 0, 10.0 / 11},
        {11, 10, 1, 10.0 / 11},
        {2835, 2836, 1, 0},
        {2836, 2835, 1, 0},
        {1001, 1000, 0, 1 / 1.001},
        {7, 7, 0, 0},
        {0, 1, 0, 0},
        {999, 1000, 1, 1000.0 / 999},
    };
    struct image image = make(3, 2, 1, arena);
    image.aspect = 0.5;
    const struct text bytes =
        encode(&image, "x.png", (struct image_way){.bits = 8, .values = IMAGE_CODES}, arena);
    char *file = arena_string(arena, bytes.start, bytes.length);
    char *type = file;
    while (memcmp(type, "pHYs", 4) != 0) {
        type++;
    }
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error error = {0};
        struct image back = {0};
        put_big(type + 4, cases[i].across);
        put_big(type + 8, cases[i].down);
        type[12] = cases[i].unit;
        put_big(type + 13, crc_of(type, 13));
        CHECK(image_file_parse("x", (struct text){file, bytes.length}, &as_codes, arena, &back,
                               &error));
        CHECK_NEAR(back.aspect, cases[i].aspect, 1e-15, "proportions of a pixel");
    }
}

/*
 * Colours that sRGB does not have keep their luminance, as far as it is above 0. By fractions: XYZ
 * of the primaries for the white, Bradford's adaptation, the inverse of [IEC99]'s matrix, then the
 * share Y/(Y - the least part) of the way from grey.
 */
static void test_beyond_srgb(struct arena *arena)
{
#define RADIANCE_OWN "PRIMARIES=.64 .33 .29 .6 .15 .06 .333 .333\n"
#define ACES_AP0     "PRIMARIES=.7347 .2653 0 1 .0001 -.077 .32168 .33767\n"
    static const struct {
        struct text file;
        double red, green, blue;
        size_t beyond;
    } cases[] = {
        {{BYTES("#?RADIANCE\n" RADIANCE_OWN "\n-Y 1 +X 1\n\100\200\100\201")},
         0.42210624290586285,
         0.996455643886085,
         0.5089453828754099,
         0},
        {{BYTES("#?RADIANCE\n" RADIANCE_OWN "\n-Y 1 +X 1\n\10\200\10\200")},
         0,
         0.4809199123558685,
         0.0727130062500956,
         1},
        {{BYTES("#?RADIANCE\n" ACES_AP0 "\n-Y 1 +X 1\n\0\0\200\201")}, 0, 0, 0, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error error = {0};
        struct image back;
        CHECK(image_file_parse("x", cases[i].file, &as_light, arena, &back, &error));
        CHECK_NEAR((double)back.pixels[0], cases[i].red, 1e-7, "red");
        CHECK_NEAR((double)back.pixels[1], cases[i].green, 1e-7, "green");
        CHECK_NEAR((double)back.pixels[2], cases[i].blue, 1e-7, "blue");
        CHECK(back.beyond_srgb == cases[i].beyond);
    }
}

static void test_types(void)
{
    struct arena arena = {0};
    struct error error = {0};
    struct image image;
    CHECK(image_file_types(4) == NULL && type_of("a.jpg") == NULL);
    CHECK_TEXT(file_type_endings(image_file_types, &arena), ".png, .exr, .pfm or .hdr");
    CHECK(!image_file_read("/nowhere/x.png", &as_light, &arena, &image, &error));
    CHECK(error.code == ERROR_IO);
    CHECK_TEXT(error.message, "there is no file /nowhere/x.png");
    arena_free(&arena);
}

static int write_all(const char *folder, struct arena *arena)
{
    for (size_t i = 0; i < KINDS; i++) {
        const struct image image = make(WIDTH, HEIGHT, kinds[i].channels, arena);
        const struct text bytes = encode(&image, kinds[i].name, kinds[i].way, arena);
        FILE *file = fopen(ARENA_JOIN(arena, folder, "/", kinds[i].name), "wb");
        if (file == NULL || fwrite(bytes.start, 1, bytes.length, file) != bytes.length ||
            fclose(file) != 0) {
            return 5;
        }
    }
    return 0;
}

static int print(const char *path, const struct image_wish *wish, struct arena *arena)
{
    struct image image;
    struct error error;
    if (!image_file_read(path, wish, arena, &image, &error)) {
        printf("%s\n", error.message);
        return (int)error.code;
    }
    printf("%zu %zu %zu", image.width, image.height, image.channels);
    for (size_t i = 0; i < image.channels; i++) {
        printf(" %s", image_channel(&image, i, arena));
    }
    printf("\n");
    for (size_t i = 0; i < image.width * image.height * image.channels; i++) {
        printf("%.9g\n", (double)image.pixels[i]);
    }
    for (size_t i = 0; i < image.note_count; i++) {
        printf("%s=%s\n", image.notes[i].key, image.notes[i].value);
    }
    return 0;
}

/* For check_pictures_files.py: WRITE=FOLDER writes the pictures there, READ_LIGHT=FILE and
   READ_CODES=FILE print the values of one. */
int main(void)
{
    struct arena arena = {0};
    const char *const folder = getenv("WRITE"), *const light = getenv("READ_LIGHT"),
                      *const codes = getenv("READ_CODES");
    int status;
    if (folder != NULL) {
        status = write_all(folder, &arena);
    } else if (light != NULL || codes != NULL) {
        status = light != NULL ? print(light, &as_light, &arena) : print(codes, &as_codes, &arena);
    } else {
        test_wished(&arena);
        test_round_trips(&arena);
        test_stored(&arena);
        test_black_blocks(&arena);
        test_truncated(&arena);
        test_damaged(&arena);
        test_refused();
        test_unwritten(&arena);
        test_aspect(&arena);
        test_beyond_srgb(&arena);
        test_types();
        status = check_report();
    }
    arena_free(&arena);
    return status;
}
