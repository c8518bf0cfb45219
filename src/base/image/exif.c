/* base/image/exif.c - the plain Exif data of a JPEG or TIFF file. */
/* SPDX-License-Identifier: MIT */
#include "base/image/exif.h"

#include "base/image/bytes.h"

#include <math.h>
#include <stdint.h>

/* [Exif10] tables 3 to 8. */
enum tag_number {
    IMAGE_WIDTH = 0x100,
    IMAGE_LENGTH = 0x101,
    MAKE = 0x10f,
    MODEL = 0x110,
    EXIF_LIST = 0x8769, /* where the list of the camera's settings is */
    EXPOSURE_TIME = 0x829a,
    F_NUMBER = 0x829d,
    SENSITIVITY = 0x8827,
    OUTPUT_SENSITIVITY = 0x8831,
    EXPOSURE_INDEX = 0x8832,
    SHUTTER_SPEED = 0x9201,
    APERTURE = 0x9202,
    SUBJECT_DISTANCE = 0x9206,
    FOCAL_LENGTH = 0x920a,
    FOCAL_LENGTH_35 = 0xa405,
};

enum tag_type { ASCII = 2, SHORT = 3, LONG = 4, RATIONAL = 5, SIGNED_RATIONAL = 10 };

/* A list of tags begins with their count; each has number, type, count, and value or place. */
enum { COUNT_SIZE = 2, TAG_SIZE = 12, HEADER_SIZE = 8 };

/* The TIFF part of a file, which places are counted from. */
struct exif_part {
    const struct exif_bytes *bytes;
    size_t start, length;
    bool is_big_endian;
};

/* A tag as it stands in its list. */
struct exif_tag {
    unsigned number, type;
    uint32_t count;
    unsigned char value[4]; /* or its place */
};

/* What is kept until all tags are known. */
struct exif_reading {
    struct exif_part part;
    struct metadata *metadata;
    size_t settings;                     /* place of the list of Exif; 0 = none */
    double width, height;                /* of the TIFF's picture */
    double time_apex, fnumber_apex;      /* NaN: there is none */
    double output_index, exposure_index; /* where the sensitivity is too large for its tag */
};

static bool bytes_read(const struct exif_bytes *bytes, size_t at, void *into, size_t count)
{
    return at <= bytes->length && count <= bytes->length - at &&
           bytes->read(bytes->context, at, into, count);
}

static bool part_read(const struct exif_part *part, size_t at, void *into, size_t count)
{
    return at <= part->length && count <= part->length - at &&
           bytes_read(part->bytes, part->start + at, into, count);
}

static unsigned number_16(const unsigned char *at, bool is_big_endian)
{
    return (unsigned)(is_big_endian ? bytes_big(at, 2) : bytes_little(at, 2));
}

static uint32_t number_32(const unsigned char *at, bool is_big_endian)
{
    return (uint32_t)(is_big_endian ? bytes_big(at, 4) : bytes_little(at, 4));
}

/* -------- values -------- */

/* Numerator and denominator of the first rational of a tag. */
static bool tag_rational(const struct exif_part *part, const struct exif_tag *tag,
                         uint32_t ratio[2])
{
    unsigned char both[8];
    if ((tag->type != RATIONAL && tag->type != SIGNED_RATIONAL) || tag->count == 0 ||
        !part_read(part, number_32(tag->value, part->is_big_endian), both, sizeof both)) {
        return false;
    }
    ratio[0] = number_32(both, part->is_big_endian);
    ratio[1] = number_32(both + 4, part->is_big_endian);
    return true;
}

/* The first number of a tag; NaN: it is no number, 0/0, or lies outside the file. */
static double tag_number(const struct exif_part *part, const struct exif_tag *tag)
{
    uint32_t ratio[2];
    if (tag->count == 0) {
        return NAN;
    }
    /* several values of two bytes may need a place of their own: the first is meant */
    const bool is_inside = tag->count <= (tag->type == SHORT ? 2 : 1);
    unsigned char moved[4] = {0};
    const size_t size = tag->type == SHORT ? 2 : 4;
    const unsigned char *value = tag->value;
    if ((tag->type == SHORT || tag->type == LONG) && !is_inside) {
        if (!part_read(part, number_32(tag->value, part->is_big_endian), moved, size)) {
            return NAN;
        }
        value = moved;
    }
    if (tag->type == SHORT) {
        return number_16(value, part->is_big_endian);
    }
    if (tag->type == LONG) {
        return number_32(value, part->is_big_endian);
    }
    if (!tag_rational(part, tag, ratio)) {
        return NAN;
    }
    if (tag->type == SIGNED_RATIONAL) {
        return (double)(int32_t)ratio[0] / (int32_t)ratio[1];
    }
    return (double)ratio[0] / ratio[1]; /* 0/0 is NaN: unknown; 1/0 infinite */
}

/* The same of what is finite and above 0, which 0 is not: in Exif it says that none is known. */
static double tag_positive(const struct exif_part *part, const struct exif_tag *tag)
{
    const double number = tag_number(part, tag);
    return number > 0 && isfinite(number) ? number : NAN;
}

/* mm; infinite, or NaN: unknown. */
static double tag_distance(const struct exif_part *part, const struct exif_tag *tag)
{
    uint32_t ratio[2];
    if (!tag_rational(part, tag, ratio) || tag->type != RATIONAL || ratio[0] == 0) {
        return NAN;
    }
    return ratio[0] == UINT32_MAX ? INFINITY : 1000.0 * ratio[0] / ratio[1];
}

static void tag_name(const struct exif_part *part, const struct exif_tag *tag,
                     char name[METADATA_NAME])
{
    char text[METADATA_NAME];
    const size_t length = tag->count < sizeof text ? tag->count : sizeof text;
    const bool is_inside = tag->count <= sizeof tag->value;
    if (tag->type != ASCII) {
        return;
    }
    if (is_inside) {
        memcpy(text, tag->value, length);
    } else if (!part_read(part, number_32(tag->value, part->is_big_endian), text, length)) {
        return;
    }
    metadata_name(name, (struct text){text, length});
}

/* -------- lists of tags -------- */

/* Numbers above 0, of which the first of a file counts. */
static void take_number(struct exif_reading *reading, const struct exif_tag *tag)
{
    struct metadata *metadata = reading->metadata;
    const struct {
        enum tag_number number;
        double *value;
    } positive[] = {
        {IMAGE_WIDTH, &reading->width},
        {IMAGE_LENGTH, &reading->height},
        {EXPOSURE_TIME, &metadata->time},
        {F_NUMBER, &metadata->fnumber},
        {SENSITIVITY, &metadata->iso},
        {OUTPUT_SENSITIVITY, &reading->output_index},
        {EXPOSURE_INDEX, &reading->exposure_index},
        {FOCAL_LENGTH, &metadata->focal},
        {FOCAL_LENGTH_35, &metadata->equivalent},
    };
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; i++) {
        if (tag->number == positive[i].number && isnan(*positive[i].value)) {
            *positive[i].value = tag_positive(&reading->part, tag);
        }
    }
}

/* Cameras have what they set in the list of Exif, raw files of some in the first one. */
static void take_tag(struct exif_reading *reading, const struct exif_tag *tag)
{
    const struct exif_part *part = &reading->part;
    struct metadata *metadata = reading->metadata;
    if (tag->number == MAKE && metadata->make[0] == '\0') {
        tag_name(part, tag, metadata->make);
    } else if (tag->number == MODEL && metadata->model[0] == '\0') {
        tag_name(part, tag, metadata->model);
    } else if (tag->number == EXIF_LIST && tag->type == LONG && tag->count == 1) {
        reading->settings = number_32(tag->value, part->is_big_endian);
    } else if (tag->number == SUBJECT_DISTANCE && isnan(metadata->distance)) {
        metadata->distance = tag_distance(part, tag);
    } else if (tag->number == SHUTTER_SPEED && isnan(reading->time_apex)) {
        reading->time_apex = tag_number(part, tag);
    } else if (tag->number == APERTURE && isnan(reading->fnumber_apex)) {
        reading->fnumber_apex = tag_number(part, tag);
    } else {
        take_number(reading, tag);
    }
}

/* Take each tag of a list. False: it is cut short, after what there was of it. */
static bool list_read(struct exif_reading *reading, size_t at, struct error *error)
{
    const struct exif_part *part = &reading->part;
    const bool is_big = part->is_big_endian;
    unsigned char bytes[TAG_SIZE];
    unsigned i = 0;
    if (!part_read(part, at, bytes, COUNT_SIZE)) {
        return fail(error, ERROR_DATA,
                    "the Exif data are cut short: their list at byte %zu is not there",
                    part->start + at);
    }
    const unsigned count = number_16(bytes, is_big);
    for (; i < count && part_read(part, at + COUNT_SIZE + (size_t)i * TAG_SIZE, bytes, TAG_SIZE);
         i++) {
        struct exif_tag tag = {.number = number_16(bytes, is_big),
                               .type = number_16(bytes + 2, is_big),
                               .count = number_32(bytes + 4, is_big)};
        memcpy(tag.value, bytes + 8, sizeof tag.value);
        take_tag(reading, &tag);
    }
    return i == count || fail(error, ERROR_DATA,
                              "the Exif data are cut short: tag %u of %u in the list at byte %zu",
                              i + 1, count, part->start + at);
}

/* A positive number that APEX values stand for; NaN if it is none. */
static double positive_or_nan(double number)
{
    return number > 0 && isfinite(number) ? number : NAN;
}

/* What a tag leaves open, another may say. */
static void settle(const struct exif_reading *reading)
{
    struct metadata *metadata = reading->metadata;
    const double largest_iso = 65535; /* of its tag; what is larger says the others */
    if (isnan(metadata->time)) {
        metadata->time = positive_or_nan(exp2(-reading->time_apex));
    }
    if (isnan(metadata->fnumber) && reading->fnumber_apex > 0) {
        metadata->fnumber = positive_or_nan(exp2(reading->fnumber_apex / 2));
    }
    if (!(metadata->iso < largest_iso)) {
        metadata->iso =
            isnan(reading->exposure_index) ? reading->output_index : reading->exposure_index;
    }
}

/* The TIFF part from its header on. */
static bool part_follow(struct exif_part part, struct metadata *metadata, bool is_picture,
                        struct error *error)
{
    unsigned char header[HEADER_SIZE];
    struct exif_reading reading = {.metadata = metadata,
                                   .width = NAN,
                                   .height = NAN,
                                   .time_apex = NAN,
                                   .fnumber_apex = NAN,
                                   .output_index = NAN,
                                   .exposure_index = NAN};
    if (!part_read(&part, 0, header, sizeof header) ||
        (memcmp(header, "II", 2) != 0 && memcmp(header, "MM", 2) != 0)) {
        return fail(error, ERROR_DATA, "the Exif data at byte %zu have no byte order, II or MM",
                    part.start);
    }
    part.is_big_endian = header[0] == 'M';
    const unsigned version = number_16(header + 2, part.is_big_endian);
    if (version != 42) {
        return fail(error, ERROR_DATA, "this is no TIFF of version 42 but %u%s", version,
                    version == 43 ? ", BigTIFF, which exiftool reads" : "");
    }
    reading.part = part;
    /* the second list may be whole where the first is not */
    struct error ignored;
    bool done = list_read(&reading, number_32(header + 4, part.is_big_endian), error);
    if (reading.settings != 0) {
        done = list_read(&reading, reading.settings, done ? error : &ignored) && done;
    }
    settle(&reading);
    if (is_picture) {
        metadata_size(metadata, reading.width, reading.height);
    }
    return done;
}

/* -------- JPEG -------- */

/* Markers of JPEG, [ITU-T T.81] table B.1, without their 0xff. */
enum {
    JPEG_RESTART = 0xd0,
    JPEG_START = 0xd8,
    JPEG_END = 0xd9,
    JPEG_SCAN = 0xda,
    JPEG_APP1 = 0xe1
};

/* Frame headers, which have the picture's size: C0 to CF but for tables and an extension. */
static bool is_frame(unsigned marker)
{
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/* A segment of a JPEG: its marker, and its length with the two bytes of that. */
struct jpeg_segment {
    unsigned marker, length;
    size_t at;
};

/* The next segment that has a length, from `at` on; false: the picture begins, or the end. */
static bool segment_find(const struct exif_bytes *bytes, size_t at, struct jpeg_segment *segment)
{
    enum { MOST_FILLING = 64 };
    unsigned char head[4];
    for (int i = 0; i < MOST_FILLING && bytes_read(bytes, at, head, 4) && head[0] == 0xff; i++) {
        const unsigned marker = head[1];
        const bool fills = marker == 0xff,
                   is_alone = marker >= JPEG_RESTART && marker <= JPEG_START;
        if (!fills && !is_alone) {
            *segment = (struct jpeg_segment){marker, number_16(head + 2, true), at};
            return marker != JPEG_SCAN && marker != JPEG_END && segment->length >= 2;
        }
        at += fills ? 1 : 2;
    }
    return false;
}

/* Does the segment begin with the mark of Exif? */
static bool segment_is_exif(const struct exif_bytes *bytes, const struct jpeg_segment *segment)
{
    static const unsigned char mark[] = "Exif\0";
    unsigned char head[sizeof mark];
    return segment->marker == JPEG_APP1 && segment->length >= 2 + sizeof mark &&
           bytes_read(bytes, segment->at + 4, head, sizeof head) &&
           memcmp(head, mark, sizeof mark) == 0;
}

/* What of a JPEG stands before its picture. */
static bool jpeg_follow(const struct exif_bytes *bytes, struct metadata *metadata,
                        struct error *error)
{
    enum { MOST_SEGMENTS = 1000, BEFORE_TIFF = 10, FRAME_SIZE = 9 };
    struct jpeg_segment segment = {.at = 0, .length = 0};
    unsigned char head[FRAME_SIZE];
    bool found = false;
    for (int i = 0; i < MOST_SEGMENTS; i++) {
        const size_t end = segment.at + 2 + segment.length; /* of the start of image: 2 */
        if (!segment_find(bytes, end, &segment)) {
            break;
        }
        if (!found && segment_is_exif(bytes, &segment)) {
            const size_t start = segment.at + BEFORE_TIFF, behind = segment.at + 2 + segment.length;
            const struct exif_part part = {
                bytes, start, (behind < bytes->length ? behind : bytes->length) - start, false};
            found = true;
            if (!part_follow(part, metadata, false, error)) {
                return false;
            }
        } else if (is_frame(segment.marker) && segment.length >= FRAME_SIZE - 2 &&
                   bytes_read(bytes, segment.at, head, sizeof head)) {
            metadata_size(metadata, number_16(head + 7, true), number_16(head + 5, true));
        }
    }
    return found || fail(error, ERROR_DATA, "there are no Exif data in this JPEG");
}

bool exif_read(const struct exif_bytes *bytes, struct metadata *metadata, struct error *error)
{
    unsigned char head[3] = {0};
    metadata_clear(metadata);
    const bool is_there = bytes_read(bytes, 0, head, sizeof head);
    if (is_there && memcmp(head, "\xff\xd8\xff", 3) == 0) {
        return jpeg_follow(bytes, metadata, error);
    }
    if (is_there && (memcmp(head, "II", 2) == 0 || memcmp(head, "MM", 2) == 0)) {
        const struct exif_part part = {bytes, 0, bytes->length, false};
        return part_follow(part, metadata, true, error);
    }
    return fail(error, ERROR_DATA, "this is neither a JPEG nor a TIFF file");
}

static bool text_bytes(const void *context, size_t at, void *into, size_t count)
{
    memcpy(into, ((const struct text *)context)->start + at, count);
    return true;
}

void exif_notes(struct text text, struct image *image, struct arena *arena)
{
    struct metadata metadata;
    struct error ignored;
    const struct exif_bytes bytes = {.read = text_bytes, .context = &text, .length = text.length};
    metadata_clear(&metadata);
    if (text.start == NULL) {
        return;
    }
    part_follow((struct exif_part){&bytes, 0, text.length, false}, &metadata, false, &ignored);
    if (metadata.time > 0) {
        image_note(image, arena, text_of("Exposure time"),
                   text_of(arena_printf(arena, "%.9g s", metadata.time)));
    }
    if (metadata.fnumber > 0) {
        image_note(image, arena, text_of("Aperture"),
                   text_of(arena_printf(arena, "f/%.4g", metadata.fnumber)));
    }
    if (metadata.iso > 0) {
        image_note(image, arena, text_of("ISO"),
                   text_of(arena_printf(arena, "%.6g", metadata.iso)));
    }
}
