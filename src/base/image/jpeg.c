/* base/image/jpeg.c - JPEG, which is read only. */
/* SPDX-License-Identifier: MIT */
#include "base/image/jpeg.h"

#include "base/image/bytes.h"
#include "base/image/exif.h"
#include "base/image/stb.h"

enum { PIXELS_A_BYTE = 2048 };
enum { START = 0xd8, END = 0xd9, SCAN = 0xda, TABLES = 0xc4, RESTART = 0xd0, EXIF = 0xe1 };

bool jpeg_is(struct text file)
{
    return file.length >= 3 && memcmp(file.start, "\xff\xd8\xff", 3) == 0;
}

/* A frame's header: C0 to CF but the tables DHT and DAC and the extension. */
static bool is_frame(int marker)
{
    return marker >= 0xc0 && marker <= 0xcf && marker != TABLES && marker != 0xc8 && marker != 0xcc;
}

/* Behind the packed bytes that begin here: at the next marker that is no restart. */
static size_t end_of_scan(struct text file, size_t at)
{
    const unsigned char *data = (const unsigned char *)file.start;
    while (at + 1 < file.length) {
        const int next = data[at + 1];
        if (data[at] == 0xff && next != 0 && next != 0xff && !(next >= RESTART && next < START)) {
            return at;
        }
        at++;
    }
    return file.length;
}

/* Are there as many values in all its tables as their counts say, at most 256 in each? */
static bool are_tables(const unsigned char *body, size_t size)
{
    while (size >= 17) {
        size_t sum = 0;
        for (int i = 1; i <= 16; i++) {
            sum += body[i];
        }
        if (sum > 256 || sum > size - 17) {
            return false;
        }
        body += 17 + sum;
        size -= 17 + sum;
    }
    return size == 0;
}

/* What is found on the way. */
struct jpeg {
    struct image *image;
    struct text exif; /* its TIFF; no start: there is none */
};
static const char exif_mark[6] = "Exif\0";

/* Walk from marker to marker up to the last; stb would fill up what is missing with grey. */
static bool walk(struct text file, struct jpeg *jpeg, struct error *error)
{
    const unsigned char *data = (const unsigned char *)file.start;
    size_t at = 2;
    while (at + 4 <= file.length && data[at] == 0xff && data[at + 1] != END) {
        const size_t length = bytes_big(data + at + 2, 2);
        if (length < 2 || length > file.length - at - 2) {
            break;
        }
        /* what stb needs to be told of, or kept from */
        const int marker = data[at + 1];
        const unsigned char *body = data + at + 4;
        const size_t size = length - 2;
        if (marker == EXIF && size > sizeof exif_mark &&
            memcmp(body, exif_mark, sizeof exif_mark) == 0) {
            jpeg->exif =
                (struct text){(const char *)body + sizeof exif_mark, size - sizeof exif_mark};
        }
        if (is_frame(marker) && size >= 6) {
            jpeg->image->height = bytes_big(body + 1, 2);
            jpeg->image->width = bytes_big(body + 3, 2);
            jpeg->image->channels = body[5] == 1 ? 1 : 3;
        }
        /* stb would write behind its own table */
        if (marker == TABLES && !are_tables(body, size)) {
            return fail(error, ERROR_DATA, "JPEG: no Huffman tables at byte %zu", at);
        }
        at += 2 + length;
        at = marker == SCAN ? end_of_scan(file, at) : at;
    }
    if (at + 2 > file.length) {
        return fail(error, ERROR_DATA, "JPEG: ends at byte %zu, before its end mark", file.length);
    }
    if (data[at] != 0xff || data[at + 1] != END) {
        return fail(error, ERROR_DATA, "JPEG: no segment begins at byte %zu", at);
    }
    return jpeg->image->width > 0 || fail(error, ERROR_DATA, "JPEG: there is no picture in it");
}

bool jpeg_read(struct text file, const struct image_wish *wish, struct arena *arena,
               struct image *image, struct error *error)
{
    struct stb_picture picture;
    *image = (struct image){.channels = 1, .bits = 8};
    struct jpeg jpeg = {.image = image};
    if (!walk(file, &jpeg, error)) {
        return false;
    }
    /* 64 values take at least one bit; those of light, at the least, are every second each way */
    if (image->width * image->height / PIXELS_A_BYTE > file.length) {
        return fail(error, ERROR_DATA, "JPEG: %zu x %zu pixels do not come from %zu bytes",
                    image->width, image->height, file.length);
    }
    exif_notes(jpeg.exif, image, arena);
    if (!image_new_wished(image, wish, arena, error)) {
        return false;
    }
    struct arena codes = {0};
    const bool done = stb_decode(file, 8, &codes, &picture) && picture.width == image->width &&
                      picture.height == image->height && picture.channels == image->channels;
    for (size_t i = 0; done && i < picture.width * picture.height * picture.channels; i++) {
        const double code = picture.values[i] / 255.0;
        image->pixels[i] = (float)(wish->values == IMAGE_LIGHT ? image_light(image, code) : code);
    }
    arena_free(&codes);
    return done || fail(error, ERROR_DATA, "JPEG: damaged, or neither baseline nor progressive");
}
