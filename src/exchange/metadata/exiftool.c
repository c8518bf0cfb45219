/* exchange/metadata/exiftool.c - what exiftool, another program, says of photographs. */
/* SPDX-License-Identifier: MIT */
#include "exchange/metadata/exiftool.h"

#include "base/json_read.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

/* A '#' asks for the number; distances are asked for in words, where infinite ones are "inf". */
const char *const exiftool_words[] = {
    "exiftool",
    "-json",
    "-fast", /* nothing behind the picture */
    "-Make",
    "-Model",
    "-FocalLength#",
    "-FocalLengthIn35mmFormat#",
    "-Aperture#",     /* FNumber, else ApertureValue */
    "-ShutterSpeed#", /* ExposureTime, else ShutterSpeedValue */
    "-ISO#",
    "-RecommendedExposureIndex#",
    "-StandardOutputSensitivity#",
    "-ImageWidth#",
    "-ImageHeight#",
    "-FocusDistance",
    "-SubjectDistance",
    "-ObjectDistance",
    "-ApproximateFocusDistance",
    "-FocusDistanceLower",
    "-FocusDistanceUpper",
    "--",
    NULL,
};

static struct text tag_text(const struct json_value *object, const char *tag)
{
    const struct json_value *value = json_item(object, tag);
    const bool is_scalar =
        value != NULL && (value->kind == JSON_STRING || value->kind == JSON_BARE);
    return is_scalar ? text_trim(value->text) : text_of("");
}

/* Above 0 and finite, else NaN: 0, "undef" and "inf" are what cameras write that do not know. */
static double tag_positive(const struct json_value *object, const char *tag)
{
    double number;
    struct text values = tag_text(object, tag); /* of several, "100 0", the first */
    const bool is_number = text_number(text_cut(&values, ' '), NUMBER_UNSCALED, &number);
    return is_number && number > 0 && isfinite(number) ? number : NAN;
}

/* "1.25 m" and "inf" in mm; NaN: unknown, or a number without its unit. */
static double tag_distance(const struct json_value *object, const char *tag)
{
    /* 0xFFFFFFFF: infinity of Exif, whatever the denominator up to 1000 */
    static const double infinite = 4.29e9;
    struct text text = tag_text(object, tag);
    double metres;
    if (text_same(text, "inf") || text_same(text, "infinity")) {
        return INFINITY;
    }
    if (text.length < 3 || memcmp(text.start + text.length - 2, " m", 2) != 0) {
        return NAN;
    }
    text.length -= 2;
    if (!text_number(text, NUMBER_UNSCALED, &metres) || !(metres > 0)) {
        return NAN;
    }
    return 1000 * metres >= infinite ? INFINITY : 1000 * metres;
}

/* In the order in which exiftool itself takes them for its depth of field. */
static double object_distance(const struct json_value *object)
{
    static const char *const tags[] = {"FocusDistance", "SubjectDistance", "ObjectDistance",
                                       "ApproximateFocusDistance"};
    for (size_t i = 0; i < sizeof tags / sizeof tags[0]; i++) {
        const double distance = tag_distance(object, tags[i]);
        if (!isnan(distance)) {
            return distance;
        }
    }
    const double lower = tag_distance(object, "FocusDistanceLower");
    const double upper = tag_distance(object, "FocusDistanceUpper");
    if (isnan(lower) || isnan(upper)) {
        return isnan(lower) ? upper : lower;
    }
    return 2 / (1 / lower + 1 / upper);
}

static void object_take(const struct json_value *object, struct metadata *metadata)
{
    const double largest_iso = 65535; /* of its tag; what is larger says the others */
    metadata_clear(metadata);
    metadata_name(metadata->make, tag_text(object, "Make"));
    metadata_name(metadata->model, tag_text(object, "Model"));
    metadata->focal = tag_positive(object, "FocalLength");
    metadata->equivalent = tag_positive(object, "FocalLengthIn35mmFormat");
    metadata->fnumber = tag_positive(object, "Aperture");
    metadata->time = tag_positive(object, "ShutterSpeed");
    metadata->iso = tag_positive(object, "ISO");
    if (!(metadata->iso < largest_iso)) {
        const double index = tag_positive(object, "RecommendedExposureIndex");
        metadata->iso = isnan(index) ? tag_positive(object, "StandardOutputSensitivity") : index;
    }
    metadata->distance = object_distance(object);
    metadata_size(metadata, tag_positive(object, "ImageWidth"),
                  tag_positive(object, "ImageHeight"));
}

/* Is it the path, in whose place exiftool writes '?' for bytes that are no UTF-8? */
static bool is_path(struct text printed, const char *path)
{
    const struct text asked = text_of(path);
    bool is_it = printed.length == asked.length;
    for (size_t i = 0; i < asked.length && is_it; i++) {
        is_it = printed.start[i] == asked.start[i] ||
                (printed.start[i] == '?' && (unsigned char)asked.start[i] >= 0x80);
    }
    return is_it;
}

/* The next whole object of the array. */
static bool next_object(struct json *json, struct json_value *object)
{
    json_skip_blanks(json);
    if (!json_take(json, '{')) {
        return false;
    }
    const char *const begin = json->at - 1;
    bool is_quoted = false;
    for (; json->at < json->end; json->at++) {
        const char c = *json->at;
        if (is_quoted && c == '\\' && json->at + 1 < json->end) {
            json->at++;
        } else if (c == '"') {
            is_quoted = !is_quoted;
        } else if (c == '}' && !is_quoted) {
            json->at++;
            struct json whole = json_open(text_between(begin, json->at), json->arena, json->error);
            json_take(json, ',');
            return json_tree(&whole, object);
        }
    }
    return false;
}

void exiftool_take(struct text printed, struct exiftool_file *files, size_t count,
                   struct arena *arena)
{
    struct error ignored = {0};
    struct json json = json_open(printed, arena, &ignored);
    struct json_value object;
    size_t next = 0;
    json_take(&json, '[');
    while (next < count && next_object(&json, &object)) {
        const struct json_value *source = json_item(&object, "SourceFile");
        size_t i = next;
        while (i < count && !(source != NULL && is_path(source->text, files[i].path))) {
            i++;
        }
        if (i < count) {
            object_take(&object, &files[i].metadata);
            files[i].is_answered = true;
            next = i + 1;
        }
    }
}
