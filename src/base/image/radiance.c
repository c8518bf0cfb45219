/* base/image/radiance.c - Radiance's pictures: three floats in four bytes. */
/* SPDX-License-Identifier: MIT */
#include "base/image/radiance.h"

#include "base/image/bytes.h"
#include "base/number.h"

#include <math.h>

/* Of the exponent byte: 128 more than the exponent, of mantissas of 8 bits behind the point. */
enum { EXCESS = 136, PACKED_LEAST = 8, PACKED_MOST = 32767, RUN_MOST = 127, RUN_LEAST = 4 };

/* What light may have been multiplied by: about as far as the exponents of pixels reach. */
static const double FACTOR_LEAST = 1e-38, FACTOR_MOST = 1e38;

bool radiance_is(struct text file)
{
    return file.length >= 2 && file.start[0] == '#' && file.start[1] == '?';
}

/* --- reading --- */

struct radiance {
    struct text rest; /* what is not yet read */
    size_t line;      /* of the head, the last that was read */
    const char *start;
    double factor[3];
    bool is_xyz;
    bool from_bottom, from_right, is_upright; /* columns before rows */
    size_t count, length;                     /* of rows, or columns, and of pixels in each */
    struct arena *arena;
    struct image *image;
};

static size_t radiance_place(const struct radiance *file)
{
    return (size_t)(file->rest.start - file->start);
}

static bool radiance_next_line(struct radiance *file, struct text *line, struct error *error)
{
    const char *end = memchr(file->rest.start, '\n', file->rest.length);
    if (end == NULL) {
        return fail(error, ERROR_DATA, "Radiance: ends within its head");
    }
    *line = text_between(file->rest.start, end);
    file->line++;
    file->rest = text_between(end + 1, file->rest.start + file->rest.length);
    return true;
}

/* Divide by `count` numbers of a line, or by one for all channels. */
static bool radiance_divide(struct radiance *file, const char *name, struct text values, int count,
                            struct error *error)
{
    const char *end = values.start + values.length, *at = values.start;
    double value = 0;
    for (int i = 0; i < 3; i++) {
        if (i < count) {
            while (at < end && *at == ' ') {
                at++;
            }
            at = number_read(at, end, NUMBER_UNSCALED, &value);
        }
        if (at == NULL || !(value >= FACTOR_LEAST && value <= FACTOR_MOST)) {
            return fail(error, ERROR_DATA, "Radiance: line %zu: %s '%.*s' must be %s of %g to %g",
                        file->line, name, text_shown(values), values.start,
                        count == 1 ? "a number" : "three numbers", FACTOR_LEAST, FACTOR_MOST);
        }
        file->factor[i] /= value;
    }
    return true;
}

/* x and y of red, green, blue and white. */
static bool radiance_primaries(struct radiance *file, struct text values, struct error *error)
{
    const char *end = values.start + values.length, *at = values.start;
    for (int i = 0; i < 8 && at != NULL; i++) {
        while (at < end && *at == ' ') {
            at++;
        }
        at = number_read(at, end, NUMBER_UNSCALED, &file->image->primaries[i / 2][i % 2]);
    }
    file->image->has_primaries = true;
    return (at != NULL && text_trim(text_between(at, end)).length == 0) ||
           fail(error, ERROR_DATA,
                "Radiance: line %zu: PRIMARIES '%.*s' must be eight numbers, x and y of red, "
                "green, blue and white",
                file->line, text_shown(values), values.start);
}

static bool radiance_take_line(struct radiance *file, struct text line, struct error *error)
{
    const struct text exposure = text_behind(line, "EXPOSURE=");
    const struct text correction = text_behind(line, "COLORCORR=");
    const struct text format = text_behind(line, "FORMAT=");
    const struct text aspect = text_behind(line, "PIXASPECT=");
    const struct text primaries = text_behind(line, "PRIMARIES=");
    if (primaries.start != NULL) {
        return radiance_primaries(file, primaries, error);
    }
    if (aspect.start != NULL) {
        /* height of a pixel over its width; several lines are multiplied */
        struct image *image = file->image;
        const double before = image->aspect > 0 ? image->aspect : 1;
        const struct text number = text_trim(aspect);
        const char *end = number.start + number.length;
        double ratio = 0;
        return (number_read(number.start, end, NUMBER_UNSCALED, &ratio) == end &&
                image_take_aspect(image, before / ratio)) ||
               fail(error, ERROR_DATA,
                    "Radiance: line %zu: PIXASPECT '%.*s' must be a number of %g to %g", file->line,
                    text_shown(number), number.start, IMAGE_ASPECT_LEAST, IMAGE_ASPECT_MOST);
    }
    if (exposure.start != NULL) {
        return radiance_divide(file, "EXPOSURE", exposure, 1, error);
    }
    if (correction.start != NULL) {
        return radiance_divide(file, "COLORCORR", correction, 3, error);
    }
    if (format.start != NULL) {
        file->is_xyz = text_equal(text_trim(format), "32-bit_rle_xyze");
        return file->is_xyz || text_equal(text_trim(format), "32-bit_rle_rgbe") ||
               fail(error, ERROR_DATA,
                    "Radiance: format '%.*s' is neither 32-bit_rle_rgbe nor "
                    "32-bit_rle_xyze",
                    text_shown(format), format.start);
    }
    if (line.length > 0 && line.start[0] == '#') {
        struct text value = {line.start + 1, line.length - 1}, key = text_cut(&value, ':');
        if (value.start != NULL) {
            image_note(file->image, file->arena, text_trim(key), text_trim(value));
        }
    }
    return true;
}

/* "-Y 480": from where, and how many. */
static bool radiance_take_side(struct text *line, char axis, bool *is_positive, size_t *count)
{
    const struct text sign = text_cut(line, ' ');
    const struct text number = line->start != NULL ? text_cut(line, ' ') : (struct text){NULL, 0};
    *count = 0;
    for (size_t i = 0; i < number.length; i++) {
        if (!char_is_digit(number.start[i]) || *count > IMAGE_SIDE_MOST) {
            return false;
        }
        *count = 10 * *count + (size_t)(number.start[i] - '0');
    }
    *is_positive = sign.length > 0 && sign.start[0] == '+';
    return sign.length == 2 && sign.start[1] == axis && (*is_positive || sign.start[0] == '-');
}

static bool radiance_read_head(struct radiance *file, struct error *error)
{
    struct text line;
    do {
        if (!radiance_next_line(file, &line, error) || !radiance_take_line(file, line, error)) {
            return false;
        }
    } while (line.length > 0);
    file->image->has_primaries = file->image->has_primaries && !file->is_xyz;
    if (!radiance_next_line(file, &line, error)) {
        return false;
    }
    /* "-Y 480 +X 640": rows from the top of pixels from the left; "+X 640 -Y 480": columns */
    struct image *image = file->image;
    struct text rest = line;
    bool first = true, second = true;
    file->is_upright = line.length > 1 && line.start[1] == 'X';
    if (!radiance_take_side(&rest, file->is_upright ? 'X' : 'Y', &first, &file->count) ||
        rest.start == NULL ||
        !radiance_take_side(&rest, file->is_upright ? 'Y' : 'X', &second, &file->length)) {
        return fail(error, ERROR_DATA, "Radiance: '%.*s' is no size like '-Y 480 +X 640'",
                    text_shown(line), line.start);
    }
    file->from_bottom = file->is_upright ? second : first;
    file->from_right = file->is_upright ? !first : !second;
    image->width = file->is_upright ? file->count : file->length;
    image->height = file->is_upright ? file->length : file->count;
    return true;
}

/* What pixels lie in, one after the other. */
static const char *radiance_word(const struct radiance *file)
{
    return file->is_upright ? "column" : "row";
}

static bool short_of(const struct radiance *file, size_t row, struct error *error)
{
    return fail(error, ERROR_DATA, "Radiance: ends at byte %zu, within %s %zu of %zu",
                radiance_place(file) + file->rest.length, radiance_word(file), row + 1,
                file->count);
}

static void skip(struct radiance *file, size_t count)
{
    file->rest = (struct text){file->rest.start + count, file->rest.length - count};
}

/* Four planes, each of runs (128 + n, byte) and stretches (n, n bytes). */
static bool read_packed(struct radiance *file, size_t row, unsigned char *pixels,
                        struct error *error)
{
    const size_t width = file->length;
    skip(file, 4);
    for (size_t plane = 0; plane < 4; plane++) {
        for (size_t x = 0; x < width;) {
            if (file->rest.length < 2) {
                return short_of(file, row, error);
            }
            const unsigned char *at = (const unsigned char *)file->rest.start;
            const bool is_run = at[0] > 128;
            const size_t count = is_run ? at[0] - 128U : at[0];
            if (count == 0 || count > width - x) {
                return fail(error, ERROR_DATA,
                            "Radiance: byte %zu, in %s %zu, makes it longer than %zu pixels",
                            radiance_place(file), radiance_word(file), row + 1, width);
            }
            if (!is_run && file->rest.length < 1 + count) {
                return short_of(file, row, error);
            }
            for (size_t i = 0; i < count; i++, x++) {
                pixels[4 * x + plane] = at[is_run ? 1 : 1 + i];
            }
            skip(file, is_run ? 2 : 1 + count);
        }
    }
    return true;
}

/* A row that begins with 2, 2 and its width is packed; a plain one has no such pixel. */
static bool radiance_read_row(struct radiance *file, size_t row, unsigned char *pixels,
                              struct error *error)
{
    const unsigned char *at = (const unsigned char *)file->rest.start;
    const size_t width = file->length;
    if (width < PACKED_LEAST || width > PACKED_MOST || file->rest.length < 4 || at[0] != 2 ||
        at[1] != 2 || at[2] >= 128) {
        /* pixel by pixel; before 1991 1, 1, 1, n repeated the one before it */
        if (file->rest.length < 4 * width) {
            return short_of(file, row, error);
        }
        memcpy(pixels, file->rest.start, 4 * width);
        skip(file, 4 * width);
        for (size_t x = 0; x < width; x++) {
            if (memcmp(pixels + 4 * x, "\1\1\1", 3) == 0) {
                return fail(error, ERROR_DATA,
                            "Radiance: %s %zu is packed in the old way, which is not read",
                            radiance_word(file), row + 1);
            }
        }
        return true;
    }
    if (bytes_big(at + 2, 2) != width) {
        return fail(error, ERROR_DATA, "Radiance: %s %zu says it has %zu pixels, not %zu",
                    radiance_word(file), row + 1, (size_t)bytes_big(at + 2, 2), width);
    }
    return read_packed(file, row, pixels, error);
}

bool radiance_read(struct text bytes, const struct image_wish *wish, struct arena *arena,
                   struct image *image, struct error *error)
{
    static const char *const xyz[] = {"X", "Y", "Z"};
    struct radiance file = {
        .rest = bytes, .start = bytes.start, .factor = {1, 1, 1}, .arena = arena, .image = image};
    *image = (struct image){.channels = 3};
    if (!radiance_read_head(&file, error)) {
        return false;
    }
    /* the shortest row is one of runs */
    const size_t length = file.length,
                 least = length < PACKED_LEAST ? 4 * length : 8 * (length / RUN_MOST);
    if (file.count > 0 && least > file.rest.length / file.count) {
        return fail(error, ERROR_DATA, "Radiance: %zu x %zu pixels do not come from %zu bytes",
                    image->width, image->height, file.rest.length);
    }
    if (!image_new_wished(image, wish, arena, error)) {
        return false;
    }
    image->names = file.is_xyz ? xyz : NULL;
    unsigned char *pixels = ARENA_ARRAY(arena, 4 * length, unsigned char);
    for (size_t y = 0; y < file.count; y++) {
        if (!radiance_read_row(&file, y, pixels, error)) {
            return false;
        }
        for (size_t i = 0; i < file.length; i++) {
            const unsigned char *from = pixels + 4 * i;
            const size_t column = file.is_upright ? y : i, row = file.is_upright ? i : y;
            float *pixel = image_row(image, file.from_bottom ? image->height - 1 - row : row) +
                           3 * (file.from_right ? image->width - 1 - column : column);
            for (int k = 0; k < 3 && from[3] != 0; k++) {
                pixel[k] = (float)(ldexp(from[k], from[3] - EXCESS) * file.factor[k]);
            }
        }
    }
    return image_check(image, IMAGE_FINITE, error);
}

/* --- writing --- */

/* False: too large. */
static bool encode(const float rgb[3], unsigned char to[4])
{
    const float most = fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
    int exponent;
    frexp((double)most, &exponent);
    /* what would be rounded to 256 */
    exponent += ldexp((double)most, 8 - exponent) >= 255.5 ? 1 : 0;
    const int byte = exponent + EXCESS - 8;
    memset(to, 0, 4);
    if (!(most > 0) || byte < 1) {
        return true;
    }
    for (int k = 0; k < 3 && byte <= 255; k++) {
        to[k] = (unsigned char)floor(ldexp((double)rgb[k], 8 - exponent) + 0.5);
    }
    to[3] = (unsigned char)byte;
    return byte <= 255;
}

/* How often the byte at x is repeated, at most RUN_MOST. */
static size_t run_at(const unsigned char *pixels, size_t width, size_t x)
{
    size_t count = 1;
    while (x + count < width && count < RUN_MOST && pixels[4 * (x + count)] == pixels[4 * x]) {
        count++;
    }
    return count;
}

static void pack_plane(struct bytes *to, const unsigned char *pixels, size_t width)
{
    for (size_t x = 0; x < width;) {
        const size_t run = run_at(pixels, width, x);
        if (run >= RUN_LEAST) {
            bytes_put_big(to, 128 + run, 1);
            bytes_put(to, pixels + 4 * x, 1);
            x += run;
            continue;
        }
        size_t count = run;
        while (x + count < width && count < 128 && run_at(pixels, width, x + count) < RUN_LEAST) {
            count++;
        }
        bytes_put_big(to, count, 1);
        for (size_t i = 0; i < count; i++, x++) {
            bytes_put(to, pixels + 4 * x, 1);
        }
    }
}

bool radiance_write(const struct image *image, struct arena *arena, struct text *file,
                    struct error *error)
{
    struct bytes to = {.arena = arena};
    const size_t channels = image->channels;
    if (channels != 1 && channels != 3) {
        return fail(error, ERROR_DATA, "a Radiance picture has 1 channel or 3, not %zu", channels);
    }
    if (!image_check(image, IMAGE_POSITIVE, error)) {
        return false;
    }
    const char *format = text_equal(text_of(image_channel(image, 0, arena)), "X") ? "xyze" : "rgbe";
    bytes_put_string(&to, "#?RADIANCE\n");
    for (size_t i = 0; i < image->note_count; i++) {
        bytes_put_string(
            &to, ARENA_JOIN(arena, "# ", image->notes[i].key, ": ", image->notes[i].value, "\n"));
    }
    if (image->aspect > 0) {
        bytes_put_string(&to, arena_printf(arena, "PIXASPECT=%.7g\n", 1 / image->aspect));
    }
    bytes_put_string(&to, arena_printf(arena, "FORMAT=32-bit_rle_%s\n\n-Y %zu +X %zu\n", format,
                                       image->height, image->width));
    unsigned char *pixels = ARENA_ARRAY(arena, 4 * image->width, unsigned char);
    for (size_t y = 0; y < image->height; y++) {
        const float *row = image_row(image, y);
        for (size_t x = 0; x < image->width; x++) {
            const float grey[3] = {row[x], row[x], row[x]};
            if (!encode(channels == 1 ? grey : row + 3 * x, pixels + 4 * x)) {
                return fail(error, ERROR_DATA,
                            "the pixel in column %zu, row %zu is %g: a Radiance picture has at "
                            "most 1.69e38",
                            x + 1, y + 1, (double)row[channels * x]);
            }
        }
        if (image->width < PACKED_LEAST || image->width > PACKED_MOST) {
            bytes_put(&to, pixels, 4 * image->width);
            continue;
        }
        bytes_put_big(&to, 0x0202, 2);
        bytes_put_big(&to, image->width, 2);
        for (size_t plane = 0; plane < 4; plane++) {
            pack_plane(&to, pixels + plane, image->width);
        }
    }
    *file = bytes_text(&to);
    return true;
}
