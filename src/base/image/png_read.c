/* base/image/png_read.c - PNG read: its chunks checked, its pixels decoded by stb. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"
#include "base/image/png.h"
#include "base/image/srgb.h"
#include "base/image/stb.h"

#include <assert.h>
#include <math.h>

enum { PALETTE_MOST = 256, ASPECT_METRE = 1, ASPECT_FINE = 1000 };
/* samples of a pixel, by colour type */
static const unsigned char samples[] = {1, 0, 3, 1, 2, 0, 4};
enum { GREY = 0, COLORS = 2, PALETTE = 3, GREY_ALPHA = 4, COLORS_ALPHA = 6 };

/* A PNG as its chunks tell. */
struct png {
    size_t width, height;
    int bits, color;
    bool has_srgb, has_alpha;
    double gamma; /* 0 = none */
    size_t palette_count;
    unsigned char palette[PALETTE_MOST][4];
    size_t data;        /* bytes of all IDAT together */
    struct bytes plain; /* a PNG of the chunks that stb shall see */
    struct image *image;
};

struct chunk {
    size_t at;    /* byte where it begins */
    char type[5]; /* "IDAT" */
    const unsigned char *data;
    size_t count;
};

bool png_is(struct text file)
{
    return file.length >= PNG_START && memcmp(file.start, PNG_SIGNATURE, PNG_START) == 0;
}

static bool chunk_wrong(const struct chunk *chunk, const char *what, struct error *error)
{
    return fail(error, ERROR_DATA, "PNG: chunk '%s' at byte %zu %s", chunk->type, chunk->at, what);
}

static bool read_chunk(struct text file, size_t at, struct chunk *chunk, struct error *error)
{
    const unsigned char *start = (const unsigned char *)file.start + at;
    if (file.length - at < PNG_FRAME) {
        return fail(error, ERROR_DATA, "PNG: ends at byte %zu, before its end mark", file.length);
    }
    *chunk = (struct chunk){.at = at, .data = start + 8, .count = bytes_big(start, 4)};
    memcpy(chunk->type, start + 4, 4);
    for (int i = 0; i < 4; i++) {
        const char c = chunk->type[i];
        if (!((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'))) {
            return fail(error, ERROR_DATA, "PNG: no chunk begins at byte %zu", at);
        }
    }
    if (chunk->count > file.length - at - PNG_FRAME) {
        return fail(error, ERROR_DATA,
                    "PNG: chunk '%s' at byte %zu has %zu bytes, and the file ends at byte %zu",
                    chunk->type, at, chunk->count, file.length);
    }
    return crc_of(start + 4, 4 + chunk->count) == bytes_big(chunk->data + chunk->count, 4) ||
           chunk_wrong(chunk, "is damaged: its checksum is wrong", error);
}

/* Hand a chunk on to stb; a palette's numbers go as shades of grey, so that each can be checked. */
static bool png_read_pass(struct png *png, const struct chunk *chunk, struct error *error)
{
    unsigned char *copy = bytes_room(&png->plain, PNG_FRAME + chunk->count);
    (void)error;
    memcpy(copy, chunk->data - 8, PNG_FRAME + chunk->count);
    if (chunk->at == PNG_START && png->color == PALETTE) {
        copy[8 + 9] = GREY;
    }
    png->plain.used += PNG_FRAME + chunk->count;
    return true;
}

static bool is_kind(int color, int bits)
{
    switch (color) {
    case GREY:
        return bits == 1 || bits == 2 || bits == 4 || bits == 8 || bits == 16;
    case PALETTE:
        return bits == 1 || bits == 2 || bits == 4 || bits == 8;
    default:
        return (color == COLORS || color == GREY_ALPHA || color == COLORS_ALPHA) &&
               (bits == 8 || bits == 16);
    }
}

static bool take_header(struct png *png, const struct chunk *chunk, struct error *error)
{
    if (chunk->count != PNG_HEADER) {
        return chunk_wrong(chunk, "must have 13 bytes", error);
    }
    png->width = bytes_big(chunk->data, 4);
    png->height = bytes_big(chunk->data + 4, 4);
    png->bits = chunk->data[8];
    png->color = chunk->data[9];
    if (!is_kind(png->color, png->bits) || chunk->data[10] != 0 || chunk->data[11] != 0 ||
        chunk->data[12] > 1) {
        return fail(error, ERROR_DATA, "PNG: no kind has %d bits of colour type %d", png->bits,
                    png->color);
    }
    return png_read_pass(png, chunk, error);
}

static bool take_palette(struct png *png, const struct chunk *chunk, struct error *error)
{
    if (chunk->count % 3 != 0 || chunk->count < 3 || chunk->count > 3 * PALETTE_MOST) {
        return chunk_wrong(chunk, "must have 1 to 256 colours of 3 bytes", error);
    }
    png->palette_count = chunk->count / 3;
    for (size_t i = 0; i < png->palette_count; i++) {
        memcpy(png->palette[i], chunk->data + 3 * i, 3);
        png->palette[i][3] = 255;
    }
    return true;
}

static bool take_data(struct png *png, const struct chunk *chunk, struct error *error)
{
    png->data += chunk->count;
    return png_read_pass(png, chunk, error);
}

static bool take_alpha(struct png *png, const struct chunk *chunk, struct error *error)
{
    png->has_alpha = true;
    if (png->color != PALETTE) {
        return png_read_pass(png, chunk, error);
    }
    for (size_t i = 0; i < chunk->count && i < png->palette_count; i++) {
        png->palette[i][3] = chunk->data[i];
    }
    return chunk->count <= png->palette_count ||
           chunk_wrong(chunk, "has more entries than the palette", error);
}

static bool take_srgb(struct png *png, const struct chunk *chunk, struct error *error)
{
    (void)chunk;
    (void)error;
    png->has_srgb = true;
    return true;
}

static bool take_gamma(struct png *png, const struct chunk *chunk, struct error *error)
{
    png->gamma = chunk->count == 4 ? (double)bytes_big(chunk->data, 4) / PNG_GAMMA_LINEAR : 0;
    return png->gamma > 0 || chunk_wrong(chunk, "must be a number above 0", error);
}

/*
 * Pixels a metre are whole numbers of such that were none: those that are large and differ by their
 * rounding only are those of square pixels. Without a unit it is the ratio; 0 says nothing.
 */
static bool png_aspect(struct png *png, const struct chunk *chunk, struct error *error)
{
    if (chunk->count != 9) {
        return chunk_wrong(chunk, "must have 9 bytes", error);
    }
    const double across = (double)bytes_big(chunk->data, 4);
    const double down = (double)bytes_big(chunk->data + 4, 4);
    const bool is_rounded = chunk->data[8] == ASPECT_METRE && fabs(across - down) <= 1 &&
                            fmin(across, down) >= ASPECT_FINE;
    return !(across > 0 && down > 0) || is_rounded ||
           image_take_aspect(png->image, down / across) ||
           chunk_wrong(chunk, "says that pixels are over 1e6 times as long one way as the other",
                       error);
}

static struct text text_of_chunk(const struct chunk *chunk)
{
    return (struct text){(const char *)chunk->data, chunk->count};
}

static bool take_latin(struct png *png, const struct chunk *chunk, struct error *error)
{
    struct arena *arena = png->plain.arena;
    struct bytes value = {.arena = arena};
    struct text rest = text_of_chunk(chunk), key = text_cut(&rest, '\0');
    (void)error;
    for (size_t i = 0; i < rest.length; i++) {
        const unsigned char c = (unsigned char)rest.start[i];
        if (c >= 0x80) {
            bytes_put_big(&value, 0xc080U | (c & 0xc0U) << 2 | (c & 0x3fU), 2);
        } else {
            bytes_put(&value, &c, 1);
        }
    }
    image_note(png->image, arena, key, bytes_text(&value));
    return true;
}

/* Two bytes 0 say that it is not compressed; its language and the key in that come before it. */
static bool take_unicode(struct png *png, const struct chunk *chunk, struct error *error)
{
    struct text rest = text_of_chunk(chunk), key = text_cut(&rest, '\0');
    (void)error;
    if (rest.length < 4 || rest.start[0] != 0) {
        return true;
    }
    rest = (struct text){rest.start + 2, rest.length - 2};
    text_cut(&rest, '\0');
    if (rest.start != NULL) {
        text_cut(&rest, '\0');
    }
    if (rest.start != NULL) {
        image_note(png->image, png->plain.arena, key, rest);
    }
    return true;
}

static bool take_chunk(struct png *png, const struct chunk *chunk, struct error *error)
{
    static const struct {
        char type[5];
        bool (*take)(struct png *png, const struct chunk *chunk, struct error *error);
    } takers[] = {
        {"IHDR", take_header},   {"PLTE", take_palette}, {"tRNS", take_alpha}, {"IDAT", take_data},
        {"IEND", png_read_pass}, {"sRGB", take_srgb},    {"gAMA", take_gamma}, {"tEXt", take_latin},
        {"iTXt", take_unicode},  {"pHYs", png_aspect},
    };
    if ((chunk->at == PNG_START) != (strcmp(chunk->type, "IHDR") == 0)) {
        return chunk_wrong(chunk, "is not where it belongs", error);
    }
    for (size_t i = 0; i < sizeof takers / sizeof *takers; i++) {
        if (strcmp(chunk->type, takers[i].type) == 0) {
            return takers[i].take(png, chunk, error);
        }
    }
    /* a small letter at the beginning: who does not know it may pass it over */
    return chunk->type[0] >= 'a' || chunk_wrong(chunk, "is none that PNG has", error);
}

/* Deflate packs at most 1032 to 1: a file that claims more is not believed, and no room is made. */
static bool png_check_size(const struct png *png, struct error *error)
{
    const size_t row = (png->width * samples[png->color] * (size_t)png->bits + 7) / 8;
    return row * png->height / 1032 <= png->data + 1 ||
           fail(error, ERROR_DATA, "PNG: %zu x %zu pixels do not come from %zu bytes", png->width,
                png->height, png->data);
}

/* Pixels from codes. */
static void png_read_fill(const struct png *png, const uint16_t *codes, enum image_values values,
                          struct arena *arena)
{
    const struct image *image = png->image;
    const int most = png->bits == 16 ? 65535 : 255;
    /* light, or the number itself, of each code */
    float *light = ARENA_ARRAY(arena, (size_t)most + 1, float);
    for (int i = 0; i <= most; i++) {
        const double code = (double)i / most;
        light[i] = (float)(values == IMAGE_CODES ? code : image_light(png->image, code));
    }
    const size_t channels = image->channels, colors = channels - (channels % 2 == 0 ? 1 : 0);
    for (size_t i = 0; i < image->width * image->height * channels; i++) {
        image->pixels[i] =
            i % channels < colors ? light[codes[i]] : (float)((double)codes[i] / most);
    }
}

/* The codes of a palette's colours, for their numbers. */
static bool png_read_look_up(const struct png *png, struct stb_picture *picture,
                             struct arena *arena, struct error *error)
{
    const size_t channels = png->image->channels, count = picture->width * picture->height;
    const int scale = 255 / ((1 << png->bits) - 1);
    uint16_t *codes = ARENA_ARRAY(arena, count * channels, uint16_t);
    for (size_t i = 0; i < count; i++) {
        const size_t number = (size_t)(picture->values[i] / scale);
        if (number >= png->palette_count) {
            return fail(error, ERROR_DATA, "PNG: a pixel of colour %zu, in a palette of %zu",
                        number, png->palette_count);
        }
        for (size_t k = 0; k < channels; k++) {
            codes[i * channels + k] = png->palette[number][k];
        }
    }
    *picture = (struct stb_picture){picture->width, picture->height, channels, codes};
    return true;
}

/* Pixels from the file's bytes, by way of codes in an arena that is given up. */
static bool decode(const struct png *png, enum image_values values, struct arena *arena,
                   struct error *error)
{
    const struct image *image = png->image;
    struct stb_picture picture;
    if (!stb_decode(bytes_text(&png->plain), png->bits == 16 ? 16 : 8, arena, &picture)) {
        return fail(error, ERROR_DATA, "PNG: its pixels are damaged or incomplete");
    }
    if (png->color == PALETTE && !png_read_look_up(png, &picture, arena, error)) {
        return false;
    }
    assert(picture.width == image->width && picture.height == image->height &&
           picture.channels == image->channels);
    png_read_fill(png, picture.values, values, arena);
    return true;
}

bool png_read(struct text file, const struct image_wish *wish, struct arena *arena,
              struct image *image, struct error *error)
{
    struct png png = {.plain = {.arena = arena}, .image = image};
    struct chunk chunk = {.at = PNG_START};
    *image = (struct image){0};
    bytes_put(&png.plain, PNG_SIGNATURE, PNG_START);
    for (size_t at = PNG_START; strcmp(chunk.type, "IEND") != 0; at += PNG_FRAME + chunk.count) {
        if (!read_chunk(file, at, &chunk, error) || !take_chunk(&png, &chunk, error)) {
            return false;
        }
    }
    /* how large the picture is, and what its numbers are */
    image->width = png.width;
    image->height = png.height;
    image->channels = png.color == PALETTE ? 3 : samples[png.color];
    image->channels += png.has_alpha && image->channels % 2 != 0 ? 1 : 0;
    image->bits = png.bits == 16 ? 16 : 8;
    image->gamma = png.has_srgb ? 0 : png.gamma;
    if (!png_check_size(&png, error) || !image_new_wished(image, wish, arena, error)) {
        return false;
    }
    struct arena codes = {0};
    const bool done = decode(&png, wish->values, &codes, error);
    arena_free(&codes);
    return done;
}
