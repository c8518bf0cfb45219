/* base/image/exif.c - how a camera says that it has exposed. */
/* SPDX-License-Identifier: MIT */
#include "base/image/exif.h"

#include "base/image/bytes.h"

enum { HEADER = 8, ENTRY = 12, SUBFOLDER = 34665 };
enum { SHORT = 3, LONG = 4, RATIONAL = 5 };

/* A TIFF whose numbers go one way or the other. */
struct tiff {
    const unsigned char *data;
    size_t length;
    bool is_big;
};

static size_t exif_number_at(const struct tiff *tiff, size_t at, int bytes)
{
    return tiff->is_big ? bytes_big(tiff->data + at, bytes) : bytes_little(tiff->data + at, bytes);
}

/* The value of an entry; 0: of another type, or not within the data. */
static double exif_value_of(const struct tiff *tiff, size_t entry)
{
    const size_t type = exif_number_at(tiff, entry + 2, 2),
                 place = exif_number_at(tiff, entry + 8, 4);
    if (type == SHORT || type == LONG) {
        return (double)exif_number_at(tiff, entry + 8, type == SHORT ? 2 : 4);
    }
    if (type != RATIONAL || place > tiff->length || tiff->length - place < 8) {
        return 0;
    }
    const double below = (double)exif_number_at(tiff, place + 4, 4);
    return below > 0 ? (double)exif_number_at(tiff, place, 4) / below : 0;
}

/* The first of a kind: a file can repeat an entry ten thousands of times. */
static void exif_note(struct image *image, struct arena *arena, const char *key, const char *value)
{
    for (size_t i = 0; i < image->note_count; i++) {
        if (strcmp(image->notes[i].key, key) == 0) {
            return;
        }
    }
    image_note(image, arena, text_of(key), text_of(value));
}

/* The entries of a folder; the place of the one that Exif has below it, 0: none. */
static size_t take_folder(const struct tiff *tiff, size_t at, struct image *image,
                          struct arena *arena)
{
    size_t below = 0;
    if (at > tiff->length || tiff->length - at < 2) {
        return 0;
    }
    const size_t count = exif_number_at(tiff, at, 2);
    for (size_t i = 0; i < count && at + 2 + (i + 1) * ENTRY <= tiff->length; i++) {
        const size_t entry = at + 2 + i * ENTRY, tag = exif_number_at(tiff, entry, 2);
        const double value = exif_value_of(tiff, entry);
        if (!(value > 0)) {
            continue;
        }
        if (tag == SUBFOLDER) {
            below = (size_t)value;
        } else if (tag == 33434) {
            exif_note(image, arena, "Exposure time", arena_printf(arena, "%.9g s", value));
        } else if (tag == 33437) {
            exif_note(image, arena, "Aperture", arena_printf(arena, "f/%.4g", value));
        } else if (tag == 34855) {
            exif_note(image, arena, "ISO", arena_printf(arena, "%.6g", value));
        }
    }
    return below;
}

void exif_notes(struct text text, struct image *image, struct arena *arena)
{
    struct tiff tiff = {(const unsigned char *)text.start, text.length, false};
    if (text.start == NULL || text.length < HEADER) {
        return;
    }
    tiff.is_big = memcmp(text.start, "MM", 2) == 0;
    if ((!tiff.is_big && memcmp(text.start, "II", 2) != 0) || exif_number_at(&tiff, 2, 2) != 42) {
        return;
    }
    const size_t below = take_folder(&tiff, exif_number_at(&tiff, 4, 4), image, arena);
    if (below > 0) {
        take_folder(&tiff, below, image, arena);
    }
}
