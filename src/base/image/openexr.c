/* base/image/openexr.c - OpenEXR written: scanlines of halves and floats. */
/* SPDX-License-Identifier: MIT */
#include "base/image/openexr.h"

#include "base/image/bytes.h"
#include "base/image/stb.h"

#include <math.h>
#include <stdlib.h>

/* A channel, for sorting by name. */
struct openexr_channel {
    const char *name;
    size_t number; /* in the image */
};

static int openexr_by_name(const void *a, const void *b)
{
    return strcmp(((const struct openexr_channel *)a)->name,
                  ((const struct openexr_channel *)b)->name);
}

static void put_name(struct bytes *to, const char *name)
{
    bytes_put(to, name, strlen(name) + 1);
}

static void exr_attribute(struct bytes *to, const char *name, const char *type, size_t size)
{
    put_name(to, name);
    put_name(to, type);
    bytes_put_little(to, size, 4);
}

static void put_float(struct bytes *to, const char *name, float value)
{
    exr_attribute(to, name, "float", 4);
    bytes_put_little(to, bytes_bits(value), 4);
}

static void put_byte(struct bytes *to, const char *name, const char *type, int value)
{
    exr_attribute(to, name, type, 1);
    bytes_put_little(to, (uint64_t)value, 1);
}

static void put_window(struct bytes *to, const char *name, const struct image *image)
{
    exr_attribute(to, name, "box2i", 16);
    bytes_put_little(to, 0, 8);
    bytes_put_little(to, image->width - 1, 4);
    bytes_put_little(to, image->height - 1, 4);
}

static void put_head(struct bytes *to, const struct image *image,
                     const struct openexr_channel *channels, const struct image_way *way, bool zip)
{
    bytes_put_little(to, OPENEXR_MAGIC, 4);
    bytes_put_little(to, 2, 4);
    struct bytes list = {.arena = to->arena};
    for (size_t i = 0; i < image->channels; i++) {
        put_name(&list, channels[i].name);
        bytes_put_little(&list, (uint64_t)(way->half ? OPENEXR_HALF : OPENEXR_FLOAT), 4);
        bytes_put_little(&list, 0, 4);
        bytes_put_little(&list, 1, 4);
        bytes_put_little(&list, 1, 4);
    }
    bytes_put_little(&list, 0, 1);
    exr_attribute(to, "channels", "chlist", list.used);
    bytes_put(to, list.data, list.used);
    put_byte(to, "compression", "compression", zip ? OPENEXR_ZIP : OPENEXR_NONE);
    put_window(to, "dataWindow", image);
    put_window(to, "displayWindow", image);
    put_byte(to, "lineOrder", "lineOrder", 0);
    put_float(to, "pixelAspectRatio", image->aspect > 0 ? (float)image->aspect : 1);
    exr_attribute(to, "screenWindowCenter", "v2f", 8);
    bytes_put_little(to, 0, 8);
    put_float(to, "screenWindowWidth", 1);
    for (size_t i = 0; i < image->note_count; i++) {
        const char *value = image->notes[i].value;
        /* of 31 characters at most, unless readers are told of longer ones */
        char *key = arena_string(to->arena, image->notes[i].key, strlen(image->notes[i].key));
        key[strlen(key) > 31 ? 31 : strlen(key)] = '\0';
        exr_attribute(to, key, "string", strlen(value));
        bytes_put_string(to, value);
    }
    bytes_put_little(to, 0, 1);
}

/* The rows of a block, packed where that makes them less. */
static struct text openexr_pack(const struct bytes *plain, struct arena *arena)
{
    struct bytes packed = {.arena = arena};
    unsigned char *apart = ARENA_ARRAY(arena, plain->used, unsigned char);
    /* even bytes before odd ones, each as its difference from the one before, and 128 */
    for (size_t i = 0; i < plain->used; i++) {
        apart[i / 2 + (i % 2 != 0 ? (plain->used + 1) / 2 : 0)] = plain->data[i];
    }
    for (size_t i = plain->used; i-- > 1;) {
        apart[i] = (unsigned char)(apart[i] - apart[i - 1] + 128);
    }
    stb_pack(&packed, apart, plain->used);
    return bytes_text(packed.used < plain->used ? &packed : plain);
}

/* Rows without light; a NaN and -0 have bits. */
static bool openexr_is_black(const struct image *image, const size_t rows[2])
{
    static const float none[64] = {0};
    const float *value = image_row(image, rows[0]);
    size_t left = (rows[1] - rows[0]) * image->width * image->channels;
    while (left > 0) {
        const size_t here = left < 64 ? left : 64;
        if (memcmp(value, none, here * sizeof *value) != 0) {
            return false;
        }
        value += here;
        left -= here;
    }
    return true;
}

/* How the blocks of a file are made. */
struct openexr_blocks {
    const struct image *image;
    const struct openexr_channel *channels;
    const struct image_way *way;
    size_t rows;       /* of each but the last */
    struct text black; /* packed, of so many rows without light */
};

/* The bytes of rows: a block in a hurry is packed if it is black, and that once. */
static struct text openexr_block(struct openexr_blocks *blocks, const size_t range[2],
                                 struct arena *arena, struct arena *scratch)
{
    const bool is_black = blocks->way->stored && range[1] - range[0] == blocks->rows &&
                          openexr_is_black(blocks->image, range);
    struct bytes plain = {.arena = scratch};
    if (is_black && blocks->black.length > 0) {
        return blocks->black;
    }
    const struct image *image = blocks->image;
    const int size = blocks->way->half ? 2 : 4;
    const size_t all = (range[1] - range[0]) * image->width * image->channels * (size_t)size;
    unsigned char *at = bytes_room(&plain, all);
    for (size_t y = range[0]; y < range[1]; y++) {
        for (size_t k = 0; k < image->channels; k++) {
            const float *value = image_row(image, y) + blocks->channels[k].number;
            for (size_t x = 0; x < image->width; x++, value += image->channels, at += size) {
                bytes_store_little(at, size == 2 ? half_of_float(*value) : bytes_bits(*value),
                                   size);
            }
        }
    }
    plain.used += all;
    if (is_black) {
        blocks->black = openexr_pack(&plain, arena);
        return blocks->black;
    }
    return blocks->way->packed ? openexr_pack(&plain, scratch) : bytes_text(&plain);
}

bool openexr_write(const struct image *image, const struct image_way *way, struct arena *arena,
                   struct text *file, struct error *error)
{
    const bool zip = way->packed || way->stored;
    const size_t rows = zip ? OPENEXR_ZIP_ROWS : 1;
    const size_t blocks = (image->height + rows - 1) / rows;
    struct openexr_channel *channels = ARENA_ARRAY(arena, image->channels, struct openexr_channel);
    for (size_t i = 0; i < image->channels; i++) {
        channels[i] = (struct openexr_channel){image_channel(image, i, arena), i};
    }
    qsort(channels, image->channels, sizeof *channels, openexr_by_name);
    struct openexr_blocks made = {image, channels, way, rows, {NULL, 0}};
    struct bytes to = {.arena = arena};
    struct arena scratch = {0};
    const size_t count = image->width * image->height * image->channels;
    for (size_t i = 0; i < count && way->half; i++) {
        const float value = image->pixels[i];
        if (fabsf(value) >= HALF_END && !isinf(value)) {
            return fail(error, ERROR_DATA, "a value of %g: half floats reach to 65504",
                        (double)value);
        }
    }
    if (!image_check(image, IMAGE_NUMBERS, error)) {
        return false;
    }
    /* what is not packed goes to its place at once */
    const size_t numbers = count * (way->half ? 2 : 4);
    bytes_room(&to, (zip ? 0 : numbers) + 16 * blocks);
    put_head(&to, image, channels, way, zip);
    const size_t table = to.used;
    bytes_room(&to, 8 * blocks);
    to.used += 8 * blocks;
    for (size_t i = 0; i < blocks; i++) {
        const size_t last = (i + 1) * rows;
        const size_t range[2] = {i * rows, last < image->height ? last : image->height};
        struct bytes at = {.arena = arena, .data = to.data + table + 8 * i, .room = 8};
        bytes_put_little(&at, to.used, 8);
        const struct text block = openexr_block(&made, range, arena, &scratch);
        bytes_put_little(&to, range[0], 4);
        bytes_put_little(&to, block.length, 4);
        bytes_put(&to, block.start, block.length);
        arena_reset(&scratch, (struct arena_mark){NULL, 0});
    }
    arena_free(&scratch);
    *file = bytes_text(&to);
    return true;
}
