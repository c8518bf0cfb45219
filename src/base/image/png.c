/* base/image/png.c - PNG: whole numbers of 8 or 16 bits, compressed without loss. */
/* SPDX-License-Identifier: MIT */
#include "base/image/png.h"

#include "base/image/bytes.h"
#include "base/image/srgb.h"
#include "base/image/stb.h"
#include "base/parallel.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* what gAMA says beside sRGB */
enum { SRGB_GAMMA = 45455 };

/* of the longer side of a pixel */
enum { PNG_ASPECT_UNIT = 1000000000 };

/* Where its length will stand. */
static size_t begin_chunk(struct bytes *to, const char *type)
{
    const size_t begin = to->used;
    bytes_put_big(to, 0, 4);
    bytes_put_string(to, type);
    return begin;
}

static void end_chunk(struct bytes *to, size_t begin)
{
    const size_t typed = to->used - begin - 4;
    unsigned char *at = to->data + begin;
    for (int i = 0; i < 4; i++) {
        at[i] = (unsigned char)((typed - 4) >> (24 - 8 * i));
    }
    bytes_put_big(to, crc_of(at + 4, typed), 4);
}

static void put_chunk(struct bytes *to, const char *type, const void *data, size_t count)
{
    const size_t begin = begin_chunk(to, type);
    bytes_put(to, data, count);
    end_chunk(to, begin);
}

/* Latin letters as tEXt, others, in UTF-8, as iTXt. */
static void put_note(struct bytes *to, const struct image_note *note)
{
    struct bytes text = {.arena = to->arena};
    bool is_ascii = true;
    for (const char *at = note->value; *at != '\0'; at++) {
        is_ascii = is_ascii && (unsigned char)*at < 0x80;
    }
    bytes_put(&text, note->key, strlen(note->key) + 1);
    if (!is_ascii) {
        bytes_put(&text, "\0\0\0", 4);
    }
    bytes_put_string(&text, note->value);
    put_chunk(to, is_ascii ? "tEXt" : "iTXt", text.data, text.used);
}

/* The number of the five filters, and a byte less what it foretells. */
enum { FILTERS = 5 };

static int foretold(int filter, int left, int above, int corner)
{
    const int way = left + above - corner;
    const int a = abs(way - left), b = abs(way - above), c = abs(way - corner);
    switch (filter) {
    case 1:
        return left;
    case 2:
        return above;
    case 3:
        return (left + above) / 2;
    case 4:
        if (a <= b && a <= c) {
            return left;
        }
        return b <= c ? above : corner;
    default:
        return 0;
    }
}

enum { ROWS_AT_ONCE = 8 };

static void encode_row(const struct image *image, const struct image_way *way, size_t y,
                       unsigned char *to)
{
    const float *row = image_row(image, y);
    const uint32_t most = way->bits == 16 ? 65535 : 255;
    const size_t count = image->width * image->channels;
    if (bytes_are_zero(row, count * sizeof *row)) {
        memset(to, 0, count * (size_t)way->bits / 8);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t channel = i % image->channels;
        const bool is_alpha = image->channels % 2 == 0 && channel == image->channels - 1;
        const uint32_t code = srgb_code(row[i], most, way->values == IMAGE_LIGHT && !is_alpha);
        if (way->bits == 16) {
            *to++ = (unsigned char)(code >> 8);
        }
        *to++ = (unsigned char)code;
    }
}

/* All rows, each by the filter that leaves the least. */
static unsigned char *filter_all(const struct image *image, const struct image_way *way,
                                 struct arena *arena)
{
    const size_t pixel = image->channels * (size_t)way->bits / 8;
    const size_t count = image->width * pixel, stride = 1 + count;
    unsigned char *all = ARENA_ARRAY(arena, image->height * stride, unsigned char);
    unsigned char *above = ARENA_ARRAY(arena, count, unsigned char);
    unsigned char *row = ARENA_ARRAY(arena, count, unsigned char);
    unsigned char *trial = ARENA_ARRAY(arena, stride, unsigned char);
    for (size_t y = 0; y < image->height; y++) {
        size_t least = SIZE_MAX;
        encode_row(image, way, y, row);
        for (int filter = 0; filter < FILTERS; filter++) {
            size_t sum = 0; /* of what is left, as signed bytes */
            trial[0] = (unsigned char)filter;
            for (size_t i = 0; i < count; i++) {
                const int left = i < pixel ? 0 : row[i - pixel],
                          corner = i < pixel ? 0 : above[i - pixel];
                const unsigned char rest =
                    (unsigned char)(row[i] - foretold(filter, left, above[i], corner));
                trial[1 + i] = rest;
                sum += rest < 128 ? rest : 256U - rest;
            }
            if (sum < least) {
                least = sum;
                memcpy(all + y * stride, trial, stride);
            }
        }
        unsigned char *spare = above;
        above = row;
        row = spare;
    }
    return all;
}

struct png_rows {
    const struct image *image;
    const struct image_way *way;
    unsigned char *all;
    size_t stride;
};

static void png_rows_encode(void *context, size_t begin, size_t end)
{
    const struct png_rows *rows = context;
    for (size_t y = begin; y < end; y++) {
        unsigned char *row = rows->all + y * rows->stride;
        row[0] = 0; /* no filter */
        encode_row(rows->image, rows->way, y, row + 1);
    }
}

bool png_write(const struct image *image, const struct image_way *way, struct arena *arena,
               struct text *file, struct error *error)
{
    const size_t stride = 1 + image->width * image->channels * (size_t)way->bits / 8;
    struct bytes to = {.arena = arena};
    assert(way->bits == 8 || way->bits == 16);
    if (image->channels > 4) {
        return fail(error, ERROR_DATA, "a PNG has 1 to 4 channels, not %zu", image->channels);
    }
    if (stride > STB_PACKED_MOST / image->height) {
        return fail(error, ERROR_DATA, "%zu x %zu pixels: a PNG is written of at most %d bytes",
                    image->width, image->height, STB_PACKED_MOST);
    }
    if (!image_check(image, IMAGE_NUMBERS, error)) {
        return false;
    }
    bytes_put(&to, PNG_SIGNATURE, PNG_START);
    static const unsigned char colors[] = {0, 0, 4, 2, 6};
    unsigned char header[PNG_HEADER] = {0};
    for (int i = 0; i < 4; i++) {
        header[i] = (unsigned char)(image->width >> (24 - 8 * i));
        header[4 + i] = (unsigned char)(image->height >> (24 - 8 * i));
    }
    header[8] = (unsigned char)way->bits;
    header[9] = colors[image->channels];
    put_chunk(&to, "IHDR", header, PNG_HEADER);
    const uint32_t gamma = way->values == IMAGE_LIGHT ? SRGB_GAMMA : PNG_GAMMA_LINEAR;
    const unsigned char big[] = {(unsigned char)(gamma >> 24), (unsigned char)(gamma >> 16),
                                 (unsigned char)(gamma >> 8), (unsigned char)gamma};
    if (way->values == IMAGE_LIGHT) {
        put_chunk(&to, "sRGB", "", 1);
    }
    put_chunk(&to, "gAMA", big, sizeof big);
    if (image->aspect > 0) {
        /* pixels of some unknown unit across and down: more digits than anyone needs */
        const double across = fmin(1 / image->aspect, 1), down = fmin(image->aspect, 1);
        struct bytes sizes = {.arena = to.arena};
        bytes_put_big(&sizes, (uint64_t)round(PNG_ASPECT_UNIT * across), 4);
        bytes_put_big(&sizes, (uint64_t)round(PNG_ASPECT_UNIT * down), 4);
        bytes_put_big(&sizes, 0, 1);
        put_chunk(&to, "pHYs", sizes.data, sizes.used);
    }
    for (size_t i = 0; i < image->note_count; i++) {
        put_note(&to, &image->notes[i]);
    }
    const size_t begin = begin_chunk(&to, "IDAT");
    if (way->stored) {
        struct png_rows rows = {image, way, NULL, stride};
        rows.all = arena_buffer_array(to.arena, image->height, stride);
        parallel_for(way->threads, image->height, ROWS_AT_ONCE, png_rows_encode, &rows);
        stb_store(&to, rows.all, image->height, stride);
    } else {
        stb_pack(&to, filter_all(image, way, to.arena), stride * image->height);
    }
    end_chunk(&to, begin);
    put_chunk(&to, "IEND", "", 0);
    *file = bytes_text(&to);
    return true;
}
