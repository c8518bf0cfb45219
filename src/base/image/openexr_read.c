/* base/image/openexr_read.c - OpenEXR read: scanlines of halves and floats. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"
#include "base/image/openexr.h"
#include "base/image/stb.h"

#include <stdlib.h>

struct openexr_read_channel {
    char *name;
    int type;
    size_t size; /* bytes of a value */
    size_t to;   /* its place in the image */
};

/* An OpenEXR file as its head tells. */
struct openexr {
    const unsigned char *data;
    size_t size, at;
    struct openexr_read_channel channels[IMAGE_CHANNELS_MOST];
    size_t count;
    int packing;
    int32_t window[2][4]; /* of data, of display: x, y of the first, x, y of the last pixel */
    bool has_window[2];
    bool has_packing;
    size_t pixel; /* bytes of one, of all channels */
    struct arena *arena;
    struct image *image;
};

/* An attribute's value. */
struct openexr_read_value {
    const char *name, *type;
    size_t at, size;
};

static bool exr_refuse(struct error *error, const char *what)
{
    return fail(error, ERROR_DATA, "OpenEXR: %s", what);
}

bool openexr_is(struct text file)
{
    return file.length >= 4 && bytes_little((const unsigned char *)file.start, 4) == OPENEXR_MAGIC;
}

static bool has(const struct openexr *file, size_t count)
{
    return count <= file->size - file->at;
}

static bool truncated(const struct openexr *file, const char *where, struct error *error)
{
    return fail(error, ERROR_DATA, "OpenEXR: ends at byte %zu, within %s", file->size, where);
}

/* A name of at most 255 characters that ends with NUL before byte `end`; empty: a list ends. */
static bool take_name(struct openexr *file, size_t end, const char **name, struct error *error)
{
    const size_t room = end - file->at < 256 ? end - file->at : 256;
    const unsigned char *nul = room > 0 ? memchr(file->data + file->at, 0, room) : NULL;
    if (nul == NULL) {
        return fail(error, ERROR_DATA, "OpenEXR: the name at byte %zu has no end", file->at);
    }
    *name = (const char *)file->data + file->at;
    file->at = (size_t)(nul - file->data) + 1;
    return true;
}

static uint32_t exr_word(struct openexr *file)
{
    file->at += 4;
    return (uint32_t)bytes_little(file->data + file->at - 4, 4);
}

static bool take_channels(struct openexr *file, const struct openexr_read_value *value,
                          struct error *error)
{
    static const size_t sizes[] = {[OPENEXR_WHOLE] = 4, [OPENEXR_HALF] = 2, [OPENEXR_FLOAT] = 4};
    const size_t end = value->at + value->size;
    const char *name;
    for (file->count = 0; take_name(file, end, &name, error); file->count++) {
        if (name[0] == '\0') {
            return true;
        }
        if (end - file->at < 16 || file->count == IMAGE_CHANNELS_MOST) {
            return fail(error, ERROR_DATA, "OpenEXR: channel '%.60s' is cut off, or more than %d",
                        name, IMAGE_CHANNELS_MOST);
        }
        const uint32_t type = exr_word(file);
        file->at += 4;
        const uint32_t across = exr_word(file), down = exr_word(file);
        if (type > OPENEXR_FLOAT || across != 1 || down != 1) {
            return fail(error, ERROR_DATA,
                        "OpenEXR: channel '%.60s' is of type %u, one value in %u x %u pixels: "
                        "types 0, 1, 2 and 1 x 1 are read",
                        name, type, across, down);
        }
        file->channels[file->count] = (struct openexr_read_channel){
            arena_string(file->arena, name, strlen(name)), (int)type, sizes[type], file->count};
        file->pixel += sizes[type];
    }
    return false;
}

static bool take_packing(struct openexr *file, const struct openexr_read_value *value,
                         struct error *error)
{
    static const char *const names[] = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                        "PXR24", "B44", "B44A", "DWAA", "DWAB"};
    file->packing = file->data[value->at];
    file->has_packing = true;
    if (file->packing <= OPENEXR_ZIP) {
        return true;
    }
    const bool is_known = file->packing < (int)(sizeof names / sizeof *names);
    return fail(error, ERROR_DATA,
                "OpenEXR: compression %s (%d) is not read: none, RLE, ZIPS and ZIP are",
                is_known ? names[file->packing] : "unknown", file->packing);
}

static bool take_window(struct openexr *file, const struct openexr_read_value *value,
                        struct error *error)
{
    const int which = strcmp(value->name, "dataWindow") == 0 ? 0 : 1;
    (void)error;
    for (int i = 0; i < 4; i++) {
        file->window[which][i] = (int32_t)exr_word(file);
    }
    file->has_window[which] = true;
    return true;
}

static bool exr_aspect(struct openexr *file, const struct openexr_read_value *value,
                       struct error *error)
{
    const float aspect = bytes_float((uint32_t)bytes_little(file->data + value->at, 4));
    return image_take_aspect(file->image, (double)aspect) ||
           fail(error, ERROR_DATA, "OpenEXR: pixels of aspect ratio %g: it must be %g to %g",
                (double)aspect, IMAGE_ASPECT_LEAST, IMAGE_ASPECT_MOST);
}

static bool take_string(struct openexr *file, const struct openexr_read_value *value,
                        struct error *error)
{
    (void)error;
    image_note(file->image, file->arena, text_of(value->name),
               (struct text){(const char *)file->data + value->at, value->size});
    return true;
}

static bool take_value(struct openexr *file, const struct openexr_read_value *value,
                       struct error *error)
{
    static const struct {
        const char *name, *type; /* name null: any */
        size_t size;             /* 0: any */
        bool (*take)(struct openexr *file, const struct openexr_read_value *value,
                     struct error *error);
    } takers[] = {
        {"channels", "chlist", 0, take_channels},
        {"compression", "compression", 1, take_packing},
        {"dataWindow", "box2i", 16, take_window},
        {"displayWindow", "box2i", 16, take_window},
        {"pixelAspectRatio", "float", 4, exr_aspect},
        {NULL, "string", 0, take_string},
    };
    for (size_t i = 0; i < sizeof takers / sizeof *takers; i++) {
        const bool is_named = takers[i].name == NULL || strcmp(value->name, takers[i].name) == 0;
        if (is_named && strcmp(value->type, takers[i].type) == 0) {
            return takers[i].size == 0 || value->size == takers[i].size
                       ? takers[i].take(file, value, error)
                       : fail(error, ERROR_DATA,
                              "OpenEXR: attribute '%.60s' has %zu bytes, not "
                              "%zu",
                              value->name, value->size, takers[i].size);
        }
    }
    return true;
}

static bool openexr_read_head(struct openexr *file, struct error *error)
{
    struct openexr_read_value value;
    if (!has(file, 8)) {
        return truncated(file, "its head", error);
    }
    file->at = 4;
    const uint32_t version = exr_word(file);
    if ((version & 0xff) != 2 || (version & ~0x4ffU) != 0) {
        return fail(error, ERROR_DATA,
                    "OpenEXR: version %u with flags %#x: one part of scanlines of version 2 is "
                    "read, no tiles, parts or depths of a pixel",
                    version & 0xff, version & ~0xffU);
    }
    while (take_name(file, file->size, &value.name, error)) {
        if (value.name[0] == '\0') {
            return true;
        }
        if (!take_name(file, file->size, &value.type, error)) {
            return false;
        }
        if (!has(file, 4)) {
            return truncated(file, "its head", error);
        }
        value.size = exr_word(file);
        value.at = file->at;
        if (!has(file, value.size)) {
            return truncated(file, "its head", error);
        }
        if (!take_value(file, &value, error)) {
            return false;
        }
        file->at = value.at + value.size;
    }
    return false;
}

static bool check_head(struct openexr *file, struct error *error)
{
    const int32_t *data = file->window[0];
    struct image *image = file->image;
    if (file->count == 0 || !file->has_packing || !file->has_window[0]) {
        return exr_refuse(error, "its head lacks channels, compression or dataWindow");
    }
    if (file->has_window[1] && memcmp(data, file->window[1], sizeof file->window[0]) != 0) {
        return exr_refuse(error, "its data window is not its display window: part of a picture");
    }
    const int64_t width = (int64_t)data[2] - data[0] + 1, height = (int64_t)data[3] - data[1] + 1;
    image->width = width > 0 ? (size_t)width : 0;
    image->height = height > 0 ? (size_t)height : 0;
    image->channels = file->count;
    for (size_t i = 1; i < file->count; i++) {
        if (strcmp(file->channels[i - 1].name, file->channels[i].name) >= 0) {
            return exr_refuse(error, "its channels are not in the order of their names");
        }
    }
    /* the channels of a known set come in its order, not in that of the alphabet */
    static const char sets[][5] = {"YA", "RGB", "RGBA"};
    const char **names = ARENA_ARRAY(file->arena, file->count, const char *);
    for (size_t k = 0; k < sizeof sets / sizeof *sets; k++) {
        size_t found = 0, place[4];
        for (size_t i = 0; i < file->count && strlen(sets[k]) == file->count; i++) {
            const char *name = file->channels[i].name, *at = strchr(sets[k], name[0]);
            if (name[0] != '\0' && name[1] == '\0' && at != NULL) {
                place[found++] = (size_t)(at - sets[k]);
            }
        }
        for (size_t i = 0; i < file->count && found == file->count; i++) {
            file->channels[i].to = place[i];
        }
    }
    for (size_t i = 0; i < file->count; i++) {
        names[file->channels[i].to] = file->channels[i].name;
    }
    file->image->names = names;
    return true;
}

/* Runs: n + 1 times a byte, or -n bytes. */
static bool unpack_runs(const unsigned char *from, size_t size, unsigned char *to, size_t count)
{
    const unsigned char *end = from + size;
    size_t done = 0;
    while (from < end) {
        const int head = *from < 128 ? *from : *from - 256;
        const size_t length = (size_t)(head < 0 ? -head : head + 1);
        const size_t bytes = head < 0 ? length : 1;
        from++;
        if (length > count - done || bytes > (size_t)(end - from)) {
            return false;
        }
        if (head < 0) {
            memcpy(to + done, from, length);
        } else {
            memset(to + done, *from, length);
        }
        done += length;
        from += bytes;
    }
    return done == count;
}

/* The plain bytes of a block: as they are if they were not packed, else in plain[1]. */
static const unsigned char *unpack(const struct openexr *file, size_t size, size_t count,
                                   unsigned char *plain[2])
{
    const unsigned char *from = file->data + file->at;
    if (size == count) {
        return from;
    }
    if (size > count || file->packing == OPENEXR_NONE) {
        return NULL;
    }
    const bool done = file->packing == OPENEXR_RLE
                          ? unpack_runs(from, size, plain[0], count)
                          : stb_unpack((struct text){(const char *)from, size}, plain[0], count);
    if (!done) {
        return NULL;
    }
    /* differences summed up, and the halves put together again */
    for (size_t i = 1; i < count; i++) {
        plain[0][i] = (unsigned char)(plain[0][i] + plain[0][i - 1] - 128);
    }
    for (size_t i = 0; i < count; i++) {
        plain[1][i] = plain[0][i / 2 + (i % 2 != 0 ? (count + 1) / 2 : 0)];
    }
    return plain[1];
}

static void fill_rows(const struct openexr *file, const unsigned char *from, size_t first,
                      size_t end)
{
    const struct image *image = file->image;
    for (size_t y = first; y < end; y++) {
        for (size_t k = 0; k < file->count; k++) {
            const struct openexr_read_channel *channel = &file->channels[k];
            float *to = image_row(image, y) + channel->to;
            for (size_t x = 0; x < image->width; x++, from += channel->size) {
                const uint32_t bits = (uint32_t)bytes_little(from, (int)channel->size);
                if (channel->type == OPENEXR_HALF) {
                    to[x * image->channels] = half_value((uint16_t)bits);
                } else if (channel->type == OPENEXR_FLOAT) {
                    to[x * image->channels] = bytes_float(bits);
                } else {
                    to[x * image->channels] = (float)bits;
                }
            }
        }
    }
}

/* A block, wherever the table says it lies; each of the rows comes once. */
static bool exr_block_read(struct openexr *file, size_t rows, bool *seen, unsigned char *plain[2],
                           struct error *error)
{
    const struct image *image = file->image;
    if (!has(file, 8)) {
        return truncated(file, "its rows", error);
    }
    const size_t begin = file->at;
    const int64_t y = (int64_t)(int32_t)exr_word(file) - file->window[0][1];
    const size_t size = exr_word(file);
    if (y < 0 || (size_t)y >= image->height || (size_t)y % rows != 0 || seen[(size_t)y / rows]) {
        return fail(error, ERROR_DATA, "OpenEXR: the block at byte %zu is of no row, or one again",
                    begin);
    }
    if (!has(file, size)) {
        return truncated(file, "its rows", error);
    }
    const size_t first = (size_t)y,
                 end = first + rows < image->height ? first + rows : image->height;
    const unsigned char *from =
        unpack(file, size, (end - first) * image->width * file->pixel, plain);
    if (from == NULL) {
        return fail(error, ERROR_DATA, "OpenEXR: the block at byte %zu is damaged", begin);
    }
    fill_rows(file, from, first, end);
    seen[first / rows] = true;
    return true;
}

bool openexr_read(struct text bytes, const struct image_wish *wish, struct arena *arena,
                  struct image *image, struct error *error)
{
    struct openexr *file = ARENA_NEW(arena, struct openexr);
    *file = (struct openexr){.data = (const unsigned char *)bytes.start,
                             .size = bytes.length,
                             .arena = arena,
                             .image = image};
    *image = (struct image){0};
    if (!openexr_read_head(file, error) || !check_head(file, error)) {
        return false;
    }
    const size_t rows = file->packing == OPENEXR_ZIP ? OPENEXR_ZIP_ROWS : 1;
    const size_t blocks = (image->height + rows - 1) / rows, table = file->at;
    /* packed at most 1032 to 1, beside eight bytes of the table and eight of its own a block */
    if (blocks > (file->size - table) / 16 ||
        image->width * image->height > (file->size - table) * 1032 / file->pixel) {
        return fail(error, ERROR_DATA, "OpenEXR: %zu x %zu pixels do not come from %zu bytes",
                    image->width, image->height, file->size);
    }
    if (!image_new_wished(image, wish, arena, error)) {
        return false;
    }
    const size_t most = rows * image->width * file->pixel;
    unsigned char *plain[2] = {ARENA_ARRAY(arena, most, unsigned char),
                               ARENA_ARRAY(arena, most, unsigned char)};
    bool *seen = ARENA_ARRAY(arena, blocks, bool);
    for (size_t i = 0; i < blocks; i++) {
        const uint64_t at = bytes_little(file->data + table + 8 * i, 8);
        file->at = at < file->size ? (size_t)at : file->size;
        if (!exr_block_read(file, rows, seen, plain, error)) {
            return false;
        }
    }
    return image_check(image, IMAGE_NUMBERS, error);
}
