/* draw/svg.c - SVG 1.1 drawings as text in memory. */
/* SPDX-License-Identifier: MIT */
#include "draw/svg.h"

#include <math.h>
#include <stdarg.h>
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

/* Words in which a '#' stands for the next number and a '$' for the next text. */
static void svg_write(struct svg *svg, const char *words, ...)
{
    va_list values;
    va_start(values, words);
    for (;;) {
        const size_t length = strcspn(words, "#$");
        put_bytes(svg, words, length);
        words += length;
        if (*words == '\0') {
            break;
        }
        if (*words++ == '#') {
            svg_put_number(svg, va_arg(values, double));
        } else {
            svg_put(svg, va_arg(values, const char *));
        }
    }
    va_end(values);
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
    svg_write(svg,
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"#\" height=\"#\" "
              "viewBox=\"0 0 # #\" font-family=\"Helvetica, Arial, sans-serif\" fill=\"none\" "
              "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>",
              width, height, width, height);
    if (title) {
        put_escaped(svg, title, strlen(title));
    }
    svg_put(svg, "</title>\n");
    svg_styled_rect(svg, &(struct svg_style){.fill = "#fff"}, 0, 0, width, height);
}

void svg_end(struct svg *svg)
{
    svg_put(svg, "</svg>\n");
}

void svg_group_begin(struct svg *svg, const struct svg_style *style)
{
    svg_write(svg, "<g fill=\"$\" stroke=\"$\"", style->fill ? style->fill : "none",
              style->stroke ? style->stroke : "none");
    if (style->width > 0) {
        svg_write(svg, " stroke-width=\"#\"", style->width);
    }
    if (style->dash) {
        svg_write(svg, " stroke-dasharray=\"$\"", style->dash);
    }
    if (style->opacity > 0) {
        svg_write(svg, " opacity=\"#\"", style->opacity);
    }
    svg_put(svg, ">\n");
}

void svg_clip_begin(struct svg *svg, double x, double y, double width, double height)
{
    double name = (double)(svg->length % 1000000); /* where it stands: no other has it */
    svg_write(svg, "<clipPath id=\"clip#\">", name);
    svg_rect(svg, x, y, width, height);
    svg_put(svg, "</clipPath>\n<g clip-path=\"url(#");
    svg_write(svg, "clip#)\">\n", name);
}

void svg_group_end(struct svg *svg)
{
    svg_put(svg, "</g>\n");
}

void svg_line(struct svg *svg, double x1, double y1, double x2, double y2)
{
    if (svg_all_finite(x1, y1, x2, y2)) {
        svg_write(svg, "<line x1=\"#\" y1=\"#\" x2=\"#\" y2=\"#\"/>\n", x1, y1, x2, y2);
    }
}

void svg_rect(struct svg *svg, double x, double y, double width, double height)
{
    if (svg_all_finite(x, y, width, height) && width >= 0 && height >= 0) {
        svg_write(svg, "<rect x=\"#\" y=\"#\" width=\"#\" height=\"#\"/>\n", x, y, width, height);
    }
}

void svg_circle(struct svg *svg, double x, double y, double radius)
{
    if (svg_all_finite(x, y, radius, 0) && radius >= 0) {
        svg_write(svg, "<circle cx=\"#\" cy=\"#\" r=\"#\"/>\n", x, y, radius);
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
            for (size_t k = start; k < i; k++) {
                const char *step = k == start + 1 ? "L" : " ";
                svg_write(svg, "$# #", k == start ? "M" : step, x[k], y[k]);
            }
            /* round line ends make a dot of one point */
            svg_write(svg, "$$", i - start == 1 ? "h0" : "", ending);
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
    if (svg_all_finite(x, y, 0, 0)) {
        svg_write(svg, "<path transform=\"translate(# #)\" d=\"", x, y);
        put_escaped(svg, words, strlen(words));
        svg_put(svg, "\"/>\n");
    }
}

void svg_image(struct svg *svg, double x, double y, double width, double height, struct text png)
{
    svg_write(svg,
              "<image xmlns:xlink=\"http://www.w3.org/1999/xlink\" x=\"#\" y=\"#\" width=\"#\" "
              "height=\"#\" preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\" "
              "style=\"image-rendering:pixelated\" xlink:href=\"data:image/png;base64,",
              x, y, width, height);
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
    svg_write(svg, "<text x=\"#\" y=\"#\" font-size=\"#\"$$ fill=\"$\" stroke=\"none\"", label->x,
              label->y, label->size, anchors[label->anchor],
              label->bold ? " font-weight=\"bold\"" : "", label->colour ? label->colour : "#000");
    if (fabs(label->rotation) > 0) {
        svg_write(svg, " transform=\"rotate(# # #)\"", label->rotation, label->x, label->y);
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
    svg_text(svg,
             &(struct svg_label){.x = x, .y = y, .size = size, .anchor = anchor, .colour = colour},
             text != NULL ? text : "");
}

void svg_words_within(struct svg *svg, double x, double y, double size, double width,
                      const char *colour, const char *text)
{
    svg_text(svg,
             &(struct svg_label){.x = x, .y = y, .size = size, .width = width, .colour = colour},
             text != NULL ? text : "");
}

void svg_words_upwards(struct svg *svg, double x, double y, double size, const char *text)
{
    svg_text(
        svg,
        &(struct svg_label){.x = x, .y = y, .size = size, .rotation = -90, .anchor = SVG_MIDDLE},
        text != NULL ? text : "");
}

void svg_heading(struct svg *svg, double x, double y, double size, double width, const char *text)
{
    svg_text(svg, &(struct svg_label){.x = x, .y = y, .size = size, .width = width, .bold = true},
             text != NULL ? text : "");
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
