/* draw/terminal/svg_read.c - the shapes of an SVG drawing, one after the other. */
/* SPDX-License-Identifier: MIT */
#include "draw/terminal/svg_read.h"

#include "base/base64.h"
#include "base/constants.h"
#include "base/number.h"

#include <math.h>
#include <string.h>

/* -------- attributes -------- */

/* The value of an attribute of a tag; its start is null where it has none of this name. */
static struct text tag_value(struct text tag, const char *name)
{
    const size_t length = strlen(name);
    for (size_t i = 1; i + length + 2 <= tag.length; i++) {
        const char *at = tag.start + i;
        if ((at[-1] == ' ' || at[-1] == '\n') && memcmp(at, name, length) == 0 &&
            at[length] == '=' && at[length + 1] == '"') {
            struct text rest = text_between(at + length + 2, tag.start + tag.length);
            return text_cut(&rest, '"');
        }
    }
    return (struct text){NULL, 0};
}

/* The number that begins a text, which goes on behind it; false: there is none. */
static bool take_number(struct text *rest, double *number)
{
    while (rest->length > 0 && strchr(" ,\n\t", rest->start[0]) != NULL) {
        rest->start++;
        rest->length--;
    }
    size_t length = 0;
    while (length < rest->length &&
           (strchr("+-", rest->start[length]) == NULL || length == 0 ||
            strchr("eE", rest->start[length - 1]) != NULL) &&
           strchr("+-.0123456789eE", rest->start[length]) != NULL) {
        length++;
    }
    if (length == 0 || !text_number((struct text){rest->start, length}, NUMBER_UNSCALED, number)) {
        return false;
    }
    rest->start += length;
    rest->length -= length;
    return true;
}

static double tag_number(struct text tag, const char *name, double fallback)
{
    struct text value = tag_value(tag, name);
    double number;
    return value.start != NULL && take_number(&value, &number) ? number : fallback;
}

static struct svg_colour colour_of(struct text word)
{
    struct svg_colour colour = {.is_none = text_equal(word, "none")};
    if (text_equal(word, "white")) {
        word = text_of("#fff");
    }
    const size_t digits = word.length == 7 ? 2 : 1;
    for (size_t i = 0; i < 3 && word.length == 1 + 3 * digits && word.start[0] == '#'; i++) {
        const int first = text_hex_digit(word.start[1 + i * digits]);
        const int second = text_hex_digit(word.start[1 + i * digits + digits - 1]);
        colour.part[i] = (16 * first + second) / 255.0;
    }
    return colour;
}

/* -------- styles -------- */

static void matrix_multiply(double *matrix, const double *by)
{
    const double old[6] = {matrix[0], matrix[1], matrix[2], matrix[3], matrix[4], matrix[5]};
    for (size_t i = 0; i < 2; i++) {
        matrix[i] = old[i] * by[0] + old[2 + i] * by[1];
        matrix[2 + i] = old[i] * by[2] + old[2 + i] * by[3];
        matrix[4 + i] = old[i] * by[4] + old[2 + i] * by[5] + old[4 + i];
    }
}

/* "translate(3 4) rotate(-90 10 20)" */
static void style_transform(struct svg_style_read *style, struct text words)
{
    while (words.length > 0) {
        const struct text name = text_trim(text_cut(&words, '('));
        struct text numbers = text_cut(&words, ')');
        double given[6] = {0};
        size_t count = 0;
        while (count < 6 && take_number(&numbers, &given[count])) {
            count++;
        }
        const double scale = count > 1 ? given[1] : given[0];
        const double cosine = cos(given[0] * RADIANS_PER_DEGREE);
        const double sine = sin(given[0] * RADIANS_PER_DEGREE);
        if (text_equal(name, "translate")) {
            matrix_multiply(style->matrix, (const double[]){1, 0, 0, 1, given[0], given[1]});
        } else if (text_equal(name, "scale")) {
            matrix_multiply(style->matrix, (const double[]){given[0], 0, 0, scale, 0, 0});
        } else if (text_equal(name, "matrix")) {
            matrix_multiply(style->matrix, given);
        } else if (text_equal(name, "rotate")) {
            const double x = given[1] - cosine * given[1] + sine * given[2];
            const double y = given[2] - sine * given[1] - cosine * given[2];
            matrix_multiply(style->matrix, (const double[]){cosine, sine, -sine, cosine, x, y});
        }
    }
}

/* What a tag says of its style, on top of that of the group around it. */
static struct svg_style_read tag_style(const struct svg_reader *reader, struct text tag)
{
    struct svg_style_read style = reader->styles[reader->depth];
    const struct text stroke = tag_value(tag, "stroke"), fill = tag_value(tag, "fill");
    const struct text dash = tag_value(tag, "stroke-dasharray");
    const struct text transform = tag_value(tag, "transform");
    if (stroke.start != NULL) {
        style.stroke = colour_of(stroke);
    }
    if (fill.start != NULL) {
        style.fill = colour_of(fill);
    }
    if (dash.start != NULL) {
        style.is_dashed = !text_equal(dash, "none");
    }
    style.opacity *= tag_number(tag, "opacity", 1);
    style.size = tag_number(tag, "font-size", style.size);
    if (tag_value(tag, "clip-path").start != NULL) {
        style.clip = reader->clip;
    }
    if (transform.start != NULL) {
        style_transform(&style, transform);
    }
    return style;
}

static void group_begin(struct svg_reader *reader, struct text tag)
{
    const struct svg_style_read style = tag_style(reader, tag);
    if (reader->depth + 1 < SVG_DEPTH) {
        reader->styles[++reader->depth] = style;
    } else {
        reader->deeper++;
    }
}

static void group_end(struct svg_reader *reader)
{
    if (reader->deeper > 0) {
        reader->deeper--;
    } else if (reader->depth > 0) {
        reader->depth--;
    }
}

/* -------- points -------- */

static void shape_add(const struct svg_reader *reader, const double *matrix,
                      struct svg_shape *shape, double x, double y)
{
    if (shape->count == shape->room) {
        const size_t more = shape->room + 64;
        shape->x = arena_copy(reader->arena, shape->x, shape->count, more, sizeof *shape->x);
        shape->y = arena_copy(reader->arena, shape->y, shape->count, more, sizeof *shape->y);
        shape->room = shape->count + more;
    }
    shape->x[shape->count] = matrix[0] * x + matrix[2] * y + matrix[4];
    shape->y[shape->count++] = matrix[1] * x + matrix[3] * y + matrix[5];
}

/* A path that is read: where it is, where its part began. */
struct svg_pen {
    double x, y, first_x, first_y;
};

/* A cubic Bezier curve as lines. */
static void shape_curve(const struct svg_reader *reader, const double *matrix,
                        struct svg_shape *shape, const struct svg_pen *pen, const double *given)
{
    enum { STEPS = 16 };
    for (int i = 1; i <= STEPS; i++) {
        const double t = (double)i / STEPS, s = 1 - t;
        const double a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
        shape_add(reader, matrix, shape, a * pen->x + b * given[0] + c * given[2] + d * given[4],
                  a * pen->y + b * given[1] + c * given[3] + d * given[5]);
    }
}

/* One step of a path, its numbers absolute; an arc is a straight line to its end. */
static void shape_step(const struct svg_reader *reader, const double *matrix,
                       struct svg_shape *shape, struct svg_pen *pen, char step, const double *given,
                       size_t count)
{
    if (step == 'M' && shape->count > 0) {
        shape_add(reader, matrix, shape, NAN, NAN);
    }
    if (step == 'C') {
        shape_curve(reader, matrix, shape, pen, given);
    } else if (step == 'Q') {
        const double cubic[] = {pen->x + 2 * (given[0] - pen->x) / 3,
                                pen->y + 2 * (given[1] - pen->y) / 3,
                                given[2] + 2 * (given[0] - given[2]) / 3,
                                given[3] + 2 * (given[1] - given[3]) / 3,
                                given[2],
                                given[3]};
        shape_curve(reader, matrix, shape, pen, cubic);
    } else {
        shape_add(reader, matrix, shape, given[count - 2], given[count - 1]);
    }
    pen->x = given[count - 2];
    pen->y = given[count - 1];
    if (step == 'M') {
        pen->first_x = pen->x;
        pen->first_y = pen->y;
    }
}

/* The letter that begins a path, which goes on behind it; 0: a number does. */
static char take_letter(struct text *words)
{
    const char c = words->start[0];
    const bool is_letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    words->start += is_letter;
    words->length -= is_letter;
    return is_letter ? c : '\0';
}

/* The numbers of a step become a place of the page, and places before it. */
static size_t step_place(const struct svg_pen *pen, char step, bool is_relative, double *given,
                         size_t count)
{
    if (step == 'H' || step == 'V') {
        const double from = step == 'H' ? pen->x : pen->y;
        const double to = given[0] + (is_relative ? from : 0);
        given[0] = step == 'H' ? to : pen->x;
        given[1] = step == 'H' ? pen->y : to;
        return 2;
    }
    /* of an arc only the end is a place */
    for (size_t i = step == 'A' ? 5 : 0; i < count && is_relative; i++) {
        given[i] += (i % 2 == 0) != (step == 'A') ? pen->x : pen->y;
    }
    return count;
}

/* What is no path that this reads ends it. */
static void shape_path(const struct svg_reader *reader, const double *matrix,
                       struct svg_shape *shape, struct text words)
{
    static const char steps[] = "MLHVCQA";
    static const size_t numbers[] = {2, 2, 1, 1, 6, 4, 7};
    struct svg_pen pen = {0};
    char letter = 'M';
    while (words.length > 0) {
        const char next = take_letter(&words);
        if (next == 'Z' || next == 'z') {
            pen.x = pen.first_x;
            pen.y = pen.first_y;
            shape_add(reader, matrix, shape, pen.x, pen.y);
            continue;
        }
        letter = next != '\0' ? next : letter;
        const bool is_relative = letter >= 'a';
        const char *known = strchr(steps, is_relative ? letter - 'a' + 'A' : letter);
        double given[7];
        size_t count = 0;
        const size_t wanted = known != NULL ? numbers[known - steps] : 0;
        while (count < wanted && take_number(&words, &given[count])) {
            count++;
        }
        if (wanted == 0 || count < wanted) {
            return;
        }
        count = step_place(&pen, *known, is_relative, given, count);
        shape_step(reader, matrix, shape, &pen, *known, given, count);
        if (*known == 'M') {
            letter = is_relative ? 'l' : 'L';
        }
    }
}

static void shape_rect(const struct svg_reader *reader, const double *matrix,
                       struct svg_shape *shape, struct text tag)
{
    const double x = tag_number(tag, "x", 0), y = tag_number(tag, "y", 0);
    const double right = x + tag_number(tag, "width", 0);
    const double bottom = y + tag_number(tag, "height", 0);
    shape_add(reader, matrix, shape, x, y);
    shape_add(reader, matrix, shape, right, y);
    shape_add(reader, matrix, shape, right, bottom);
    shape_add(reader, matrix, shape, x, bottom);
    shape_add(reader, matrix, shape, x, y);
}

static void shape_ellipse(const struct svg_reader *reader, const double *matrix,
                          struct svg_shape *shape, struct text tag)
{
    enum { STEPS = 48 };
    const double x = tag_number(tag, "cx", 0), y = tag_number(tag, "cy", 0);
    const double radius = tag_number(tag, "r", 0);
    const double across = tag_number(tag, "rx", radius), down = tag_number(tag, "ry", radius);
    for (int i = 0; i <= STEPS; i++) {
        const double turn = 2 * PI * i / STEPS;
        shape_add(reader, matrix, shape, x + across * cos(turn), y + down * sin(turn));
    }
}

/* -------- texts and images -------- */

/* The characters of a text element, without the tags within it. */
static struct text words_of(struct text content, struct arena *arena)
{
    static const struct word entities[] = {{"amp;", "&"},   {"lt;", "<"},   {"gt;", ">"},
                                           {"quot;", "\""}, {"apos;", "'"}, {"#39;", "'"},
                                           {NULL, NULL}};
    char *words = arena_buffer(arena, content.length + 1);
    size_t length = 0;
    while (content.length > 0) {
        const char c = content.start[0];
        content.start++;
        content.length--;
        if (c == '<') {
            text_cut(&content, '>');
            continue;
        }
        words[length++] = c;
        for (size_t i = 0; c == '&' && entities[i].word != NULL; i++) {
            const size_t size = strlen(entities[i].word);
            if (content.length >= size && memcmp(content.start, entities[i].word, size) == 0) {
                words[length - 1] = entities[i].help[0];
                content.start += size;
                content.length -= size;
                break;
            }
        }
    }
    return (struct text){words, length};
}

static void shape_words(const struct svg_reader *reader, const struct svg_style_read *style,
                        struct svg_shape *shape, struct text tag, struct text content)
{
    const struct text anchor = tag_value(tag, "text-anchor");
    shape->kind = SVG_SHAPE_WORDS;
    shape->words = words_of(content, reader->arena);
    shape->size = style->size;
    shape->turn = atan2(style->matrix[1], style->matrix[0]) / RADIANS_PER_DEGREE;
    shape->anchor = text_equal(anchor, "middle") ? 0 : -1;
    shape->anchor = text_equal(anchor, "end") ? 1 : shape->anchor;
    shape->is_bold = text_equal(tag_value(tag, "font-weight"), "bold");
    shape_add(reader, style->matrix, shape, tag_number(tag, "x", 0), tag_number(tag, "y", 0));
}

/* -------- elements -------- */

void svg_bounds_include(struct svg_bounds *bounds, double x, double y)
{
    bounds->left = fmin(bounds->left, x);
    bounds->right = fmax(bounds->right, x);
    bounds->top = fmin(bounds->top, y);
    bounds->bottom = fmax(bounds->bottom, y);
}

void svg_read_begin(struct svg_reader *reader, struct text drawing, struct arena *arena)
{
    *reader = (struct svg_reader){.arena = arena, .rest = drawing};
    reader->styles[0] = (struct svg_style_read){
        .stroke.is_none = true,
        .opacity = 1,
        .size = 12,
        .matrix = {1, 0, 0, 1, 0, 0},
        .clip = {-(double)INFINITY, -(double)INFINITY, (double)INFINITY, (double)INFINITY}};
}

static bool is_element(struct text tag, const char *name)
{
    const size_t length = strlen(name);
    return tag.length >= length && memcmp(tag.start, name, length) == 0 &&
           (tag.length == length || strchr(" \n/", tag.start[length]) != NULL);
}

/* The shape of a tag; false: it has none. */
static bool tag_shape(struct svg_reader *reader, struct text tag, struct svg_shape *shape)
{
    const struct svg_style_read style = tag_style(reader, tag);
    *shape = (struct svg_shape){.stroke = style.stroke,
                                .fill = style.fill,
                                .is_dashed = style.is_dashed,
                                .opacity = style.opacity,
                                .clip = style.clip};
    if (is_element(tag, "line")) {
        shape->fill.is_none = true;
        shape_add(reader, style.matrix, shape, tag_number(tag, "x1", 0), tag_number(tag, "y1", 0));
        shape_add(reader, style.matrix, shape, tag_number(tag, "x2", 0), tag_number(tag, "y2", 0));
    } else if (is_element(tag, "rect")) {
        shape_rect(reader, style.matrix, shape, tag);
    } else if (is_element(tag, "circle") || is_element(tag, "ellipse")) {
        shape_ellipse(reader, style.matrix, shape, tag);
    } else if (is_element(tag, "path")) {
        shape_path(reader, style.matrix, shape, tag_value(tag, "d"));
    } else if (is_element(tag, "image")) {
        struct text link = tag_value(tag, "xlink:href");
        text_cut(&link, ',');
        shape->kind = SVG_SHAPE_IMAGE;
        shape->png = base64_bytes(link, reader->arena);
        shape_rect(reader, style.matrix, shape, tag);
    } else if (is_element(tag, "text")) {
        const char *const end = reader->rest.start + reader->rest.length;
        const char *at = reader->rest.start;
        const struct text closing = text_of("</text>");
        while (at + closing.length <= end && memcmp(at, closing.start, closing.length) != 0) {
            at++;
        }
        shape_words(reader, &style, shape, tag, text_between(reader->rest.start, at));
        reader->rest = text_between(at, end);
    }
    return shape->count > 0;
}

bool svg_read(struct svg_reader *reader, struct svg_shape *shape)
{
    while (reader->rest.length > 0) {
        text_cut(&reader->rest, '<');
        const struct text tag = text_cut(&reader->rest, '>');
        if (is_element(tag, "svg")) {
            reader->width = tag_number(tag, "width", 0);
            reader->height = tag_number(tag, "height", 0);
            reader->styles[0] = tag_style(reader, tag);
        } else if (is_element(tag, "g")) {
            group_begin(reader, tag);
        } else if (is_element(tag, "/g")) {
            group_end(reader);
        } else if (is_element(tag, "clipPath") || is_element(tag, "/clipPath")) {
            reader->in_clip = tag.start[0] != '/';
        } else if (tag.length > 0 && tag_shape(reader, tag, shape)) {
            if (!reader->in_clip) {
                return true;
            }
            reader->clip = (struct svg_bounds){INFINITY, INFINITY, -INFINITY, -INFINITY};
            for (size_t i = 0; i < shape->count; i++) {
                svg_bounds_include(&reader->clip, shape->x[i], shape->y[i]);
            }
        }
    }
    return false;
}
