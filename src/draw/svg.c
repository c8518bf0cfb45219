/* draw/svg.c - SVG 1.1 drawings as text in memory. */
/* SPDX-License-Identifier: MIT */
#include "draw/svg.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/number.h"
#include "base/text.h"

static const size_t FIRST_CAPACITY = 16384;
static const double COORDINATE_MAX = 1e6; /* viewers calculate in float */

static void put_bytes(struct svg *svg, const char *start, size_t length)
{
    if (svg->capacity - svg->length <= length) {
        size_t capacity = 2 * (svg->capacity + length) + FIRST_CAPACITY;
        char *data = ARENA_ARRAY(svg->arena, capacity, char);
        if (svg->length > 0) {
            memcpy(data, svg->data, svg->length);
        }
        svg->data = data;
        svg->capacity = capacity;
    }
    memcpy(svg->data + svg->length, start, length);
    svg->length += length;
    svg->data[svg->length] = '\0';
}

static void svg_put(struct svg *svg, const char *text)
{
    put_bytes(svg, text, strlen(text));
}

static void svg_put_number(struct svg *svg, double x)
{
    char digits[NUMBER_LENGTH];
    x = fmax(-COORDINATE_MAX, fmin(COORDINATE_MAX, x));
    x = round(x * 100) / 100 + 0.0; /* + 0 turns -0 into 0 */
    put_bytes(svg, digits, (size_t)(number_write_digits(digits, x, 9) - digits));
}

static void svg_put_attribute(struct svg *svg, const char *name, double x)
{
    svg_put(svg, " ");
    svg_put(svg, name);
    svg_put(svg, "=\"");
    svg_put_number(svg, x);
    svg_put(svg, "\"");
}

static void svg_put_colour(struct svg *svg, const char *name, const char *value)
{
    svg_put(svg, " ");
    svg_put(svg, name);
    svg_put(svg, "=\"");
    svg_put(svg, value ? value : "none");
    svg_put(svg, "\"");
}

static void put_escaped(struct svg *svg, const char *text, size_t length)
{
    for (size_t i = 0, step; i < length; i += step) {
        const struct text shown = text_xml((struct text){text + i, length - i}, &step);
        put_bytes(svg, shown.start, shown.length);
    }
}

/* Width of a character in ems. */
static double character_width(const char *at)
{
    unsigned char byte = (unsigned char)*at;
    if ((byte & 0xc0) == 0x80) {
        return 0; /* the rest of a character that is counted already */
    }
    if (byte >= 'A' && byte <= 'Z') {
        return 0.7;
    }
    if (strchr(" .,:;'|!()[]ijltfr/", byte)) {
        return 0.37;
    }
    return byte == 'm' || byte == 'w' || byte == '%' || byte >= 0xe2 ? 0.9 : 0.63;
}

double svg_text_width(const char *text, double size)
{
    double width = 0;
    for (; *text; text++) {
        width += character_width(text) * size;
    }
    return width;
}

/* How many bytes of `text` fit into `width`, cut between characters. */
static size_t fitting_length(const char *text, double size, double width)
{
    size_t length = 0;
    for (double used = 0; text[length]; length++) {
        used += character_width(text + length) * size;
        if (used > width) {
            break;
        }
    }
    while (length > 0 && ((unsigned char)text[length] & 0xc0) == 0x80) {
        length--;
    }
    return length;
}

static bool svg_all_finite(double a, double b, double c, double d)
{
    return isfinite(a) && isfinite(b) && isfinite(c) && isfinite(d);
}

void svg_begin(struct svg *svg, double width, double height, const char *title)
{
    svg_put(svg, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"");
    svg_put_attribute(svg, "width", width);
    svg_put_attribute(svg, "height", height);
    svg_put(svg, " viewBox=\"0 0 ");
    svg_put_number(svg, width);
    svg_put(svg, " ");
    svg_put_number(svg, height);
    svg_put(svg, "\" font-family=\"Helvetica, Arial, sans-serif\" fill=\"none\" "
                 "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>");
    if (title) {
        put_escaped(svg, title, strlen(title));
    }
    svg_put(svg, "</title>\n");
    svg_group_begin(svg, &(struct svg_style){.fill = "#fff"});
    svg_rect(svg, 0, 0, width, height);
    svg_group_end(svg);
}

void svg_end(struct svg *svg)
{
    svg_put(svg, "</svg>\n");
}

void svg_group_begin(struct svg *svg, const struct svg_style *style)
{
    svg_put(svg, "<g");
    svg_put_colour(svg, "fill", style->fill);
    svg_put_colour(svg, "stroke", style->stroke);
    if (style->width > 0) {
        svg_put_attribute(svg, "stroke-width", style->width);
    }
    if (style->dash) {
        svg_put_colour(svg, "stroke-dasharray", style->dash);
    }
    if (style->opacity > 0) {
        svg_put_attribute(svg, "opacity", style->opacity);
    }
    svg_put(svg, ">\n");
}

void svg_clip_begin(struct svg *svg, double x, double y, double width, double height)
{
    double name = (double)(svg->length % 1000000); /* where it stands: no other has it */
    svg_put(svg, "<clipPath id=\"clip");
    svg_put_number(svg, name);
    svg_put(svg, "\">");
    svg_rect(svg, x, y, width, height);
    svg_put(svg, "</clipPath>\n<g clip-path=\"url(#clip");
    svg_put_number(svg, name);
    svg_put(svg, ")\">\n");
}

void svg_group_end(struct svg *svg)
{
    svg_put(svg, "</g>\n");
}

/* A shape of up to four numbers; the name behind the last is null. */
static void svg_shape(struct svg *svg, const char *tag, const char *const names[4],
                      const double values[4])
{
    if (!svg_all_finite(values[0], values[1], values[2], values[3])) {
        return;
    }
    svg_put(svg, tag);
    for (int i = 0; i < 4 && names[i] != NULL; i++) {
        svg_put_attribute(svg, names[i], values[i]);
    }
    svg_put(svg, "/>\n");
}

void svg_line(struct svg *svg, double x1, double y1, double x2, double y2)
{
    static const char *const names[] = {"x1", "y1", "x2", "y2"};
    svg_shape(svg, "<line", names, (double[]){x1, y1, x2, y2});
}

void svg_rect(struct svg *svg, double x, double y, double width, double height)
{
    static const char *const names[] = {"x", "y", "width", "height"};
    if (width >= 0 && height >= 0) {
        svg_shape(svg, "<rect", names, (double[]){x, y, width, height});
    }
}

void svg_circle(struct svg *svg, double x, double y, double radius)
{
    static const char *const names[4] = {"cx", "cy", "r"};
    if (radius >= 0) {
        svg_shape(svg, "<circle", names, (double[]){x, y, radius, 0});
    }
}

static void put_run(struct svg *svg, const double *x, const double *y, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        svg_put(svg, i == 0 ? "M" : i == 1 ? "L" : " ");
        svg_put_number(svg, x[i]);
        svg_put(svg, " ");
        svg_put_number(svg, y[i]);
    }
    if (count == 1) {
        svg_put(svg, "h0"); /* round line ends make a dot of it */
    }
}

/* One path of all runs of finite points, each followed by `ending`. */
static void put_runs(struct svg *svg, const double *x, const double *y, size_t count,
                     const char *ending)
{
    size_t start = 0;
    bool open = false;
    for (size_t i = 0; i <= count; i++) {
        if (i < count && isfinite(x[i]) && isfinite(y[i])) {
            continue;
        }
        if (i > start) {
            svg_put(svg, open ? "" : "<path d=\"");
            put_run(svg, x + start, y + start, i - start);
            svg_put(svg, ending);
            open = true;
        }
        start = i + 1;
    }
    svg_put(svg, open ? "\"/>\n" : "");
}

void svg_polyline(struct svg *svg, const double *x, const double *y, size_t count)
{
    put_runs(svg, x, y, count, "");
}

void svg_polygon(struct svg *svg, const double *x, const double *y, size_t count)
{
    put_runs(svg, x, y, count, "z");
}

void svg_path(struct svg *svg, double x, double y, const char *words)
{
    if (!svg_all_finite(x, y, 0, 0)) {
        return;
    }
    svg_put(svg, "<path transform=\"translate(");
    svg_put_number(svg, x);
    svg_put(svg, " ");
    svg_put_number(svg, y);
    svg_put(svg, ")\" d=\"");
    put_escaped(svg, words, strlen(words));
    svg_put(svg, "\"/>\n");
}

void svg_image(struct svg *svg, double x, double y, double width, double height, struct text png)
{
    svg_put(svg, "<image xmlns:xlink=\"http://www.w3.org/1999/xlink\"");
    svg_put_attribute(svg, "x", x);
    svg_put_attribute(svg, "y", y);
    svg_put_attribute(svg, "width", width);
    svg_put_attribute(svg, "height", height);
    svg_put(svg, " preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" "
                 "style=\"image-rendering:pixelated\" xlink:href=\"data:image/png;base64,");
    /* Three bytes become four letters (RFC 4648). */
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < png.length; i += 3) {
        unsigned group = 0;
        char four[4];
        for (size_t k = 0; k < 3; k++) {
            group =
                group << 8 | (i + k < png.length ? (unsigned)(unsigned char)png.start[i + k] : 0u);
        }
        for (size_t k = 0; k < 4; k++) {
            four[k] = i + k > png.length ? '=' : letters[group >> (18 - 6 * k) & 63];
        }
        put_bytes(svg, four, sizeof four);
    }
    svg_put(svg, "\"/>\n");
}

void svg_text(struct svg *svg, const struct svg_label *label, const char *text)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    if (text == NULL || !svg_all_finite(label->x, label->y, label->size, label->rotation)) {
        return;
    }
    svg_put(svg, "<text");
    svg_put_attribute(svg, "x", label->x);
    svg_put_attribute(svg, "y", label->y);
    svg_put_attribute(svg, "font-size", label->size);
    svg_put(svg, anchors[label->anchor]);
    svg_put(svg, label->bold ? " font-weight=\"bold\"" : "");
    svg_put_colour(svg, "fill", label->colour ? label->colour : "#000");
    svg_put(svg, " stroke=\"none\"");
    if (fabs(label->rotation) > 0) {
        svg_put(svg, " transform=\"rotate(");
        svg_put_number(svg, label->rotation);
        svg_put(svg, " ");
        svg_put_number(svg, label->x);
        svg_put(svg, " ");
        svg_put_number(svg, label->y);
        svg_put(svg, ")\"");
    }
    svg_put(svg, ">");
    bool fits = !(label->width > 0) || svg_text_width(text, label->size) <= label->width;
    double room = label->width - label->size; /* beside the ellipsis */
    put_escaped(svg, text, fits ? strlen(text) : fitting_length(text, label->size, room));
    svg_put(svg, fits ? "</text>\n" : "…</text>\n");
}

void svg_words(struct svg *svg, double x, double y, double size, enum svg_anchor anchor,
               const char *colour, const char *text)
{
    const struct svg_label label = {
        .x = x, .y = y, .size = size, .anchor = anchor, .colour = colour};
    svg_text(svg, &label, text != NULL ? text : "");
}

void svg_words_within(struct svg *svg, double x, double y, double size, double width,
                      const char *colour, const char *text)
{
    const struct svg_label label = {.x = x, .y = y, .size = size, .width = width, .colour = colour};
    svg_text(svg, &label, text != NULL ? text : "");
}

void svg_words_upwards(struct svg *svg, double x, double y, double size, const char *text)
{
    const struct svg_label label = {
        .x = x, .y = y, .size = size, .rotation = -90, .anchor = SVG_MIDDLE};
    svg_text(svg, &label, text != NULL ? text : "");
}

void svg_heading(struct svg *svg, double x, double y, double size, double width, const char *text)
{
    const struct svg_label label = {.x = x, .y = y, .size = size, .width = width, .bold = true};
    svg_text(svg, &label, text != NULL ? text : "");
}

void svg_styled_line(struct svg *svg, const struct svg_style *style, double x1, double y1,
                     double x2, double y2)
{
    svg_group_begin(svg, style);
    svg_line(svg, x1, y1, x2, y2);
    svg_group_end(svg);
}

void svg_styled_rect(struct svg *svg, const struct svg_style *style, double x, double y,
                     double width, double height)
{
    svg_group_begin(svg, style);
    svg_rect(svg, x, y, width, height);
    svg_group_end(svg);
}

void svg_styled_circle(struct svg *svg, const struct svg_style *style, double x, double y,
                       double radius)
{
    svg_group_begin(svg, style);
    svg_circle(svg, x, y, radius);
    svg_group_end(svg);
}

void svg_styled_polyline(struct svg *svg, const struct svg_style *style, const double *x,
                         const double *y, size_t count)
{
    svg_group_begin(svg, style);
    svg_polyline(svg, x, y, count);
    svg_group_end(svg);
}

void svg_styled_polygon(struct svg *svg, const struct svg_style *style, const double *x,
                        const double *y, size_t count)
{
    svg_group_begin(svg, style);
    svg_polygon(svg, x, y, count);
    svg_group_end(svg);
}

void svg_scale_bar(struct svg *svg, const char *colour, double left, double right, double y)
{
    svg_group_begin(svg, &(struct svg_style){.stroke = colour, .width = 1.4});
    svg_line(svg, left, y, right, y);
    svg_line(svg, left, y - 4, left, y + 4);
    svg_line(svg, right, y - 4, right, y + 4);
    svg_group_end(svg);
}

bool svg_is_free(const struct svg_box *taken, size_t count, const struct svg_box *box)
{
    bool is_free = true;
    for (size_t i = 0; i < count && is_free; i++) {
        is_free = !(box->left < taken[i].right && taken[i].left < box->right &&
                    box->top < taken[i].bottom && taken[i].top < box->bottom);
    }
    return is_free;
}
