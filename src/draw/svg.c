/* draw/svg.c - SVG 1.1 drawings as text in memory. */
/* SPDX-License-Identifier: MIT */
#include "draw/svg.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/arena.h"
#include "base/base64.h"
#include "base/number.h"
#include "base/text.h"
#include "draw/typeset.h"

static const size_t FIRST_CAPACITY = 16384;
/* Of one width nearly; the last two have all signs that are written here. */
static const char FONTS[] =
    "Helvetica Neue, Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif";
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

double svg_text_width(const char *text, double size)
{
    return typeset_width(text, size, false);
}

static bool svg_all_finite(double a, double b, double c, double d)
{
    return isfinite(a) && isfinite(b) && isfinite(c) && isfinite(d);
}

/* A page of so many user units, whose width and height are written with this unit behind them. */
static void svg_begin_page(struct svg *svg, double width, double height, double units,
                           const char *unit, const char *title)
{
    svg_write(svg,
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"#$\" "
              "height=\"#$\" viewBox=\"0 0 # #\" font-family=\"$\" fill=\"none\" "
              "stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>",
              width / units, unit, height / units, unit, width, height, FONTS);
    svg->name = (struct svg_slot){.is_there = true, .start = svg->length};
    if (title) {
        const char *set = typeset(svg->arena, title);
        put_escaped(svg, set, strlen(set));
    }
    svg->name.end = svg->length;
    svg_put(svg, "</title>\n");
    svg_styled_rect(svg, &(struct svg_style){.fill = "#fff"}, 0, 0, width, height);
}

void svg_begin(struct svg *svg, double width, double height, const char *title)
{
    svg_begin_page(svg, width, height, 1, "", title);
}

void svg_begin_mm(struct svg *svg, double width, double height, double units, const char *title)
{
    svg_begin_page(svg, width * units, height * units, units, "mm", title);
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
              "height=\"#\" preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,",
              x, y, width, height);
    for (size_t i = 0; i < png.length; i += 3) {
        char four[4];
        base64_letters(png, i, four);
        put_bytes(svg, four, sizeof four);
    }
    svg_put(svg, "\"/>\n");
}

/* Words with what stands in _{ } below the line. */
static void put_set(struct svg *svg, const char *text, size_t length, double size)
{
    while (length > 0) {
        size_t plain = 0;
        while (plain < length && strncmp(text + plain, "_{", 2) != 0) {
            plain++;
        }
        put_escaped(svg, text, plain);
        text += plain;
        length -= plain;
        const char *end = length > 2 ? memchr(text, '}', length) : NULL;
        if (end != NULL) {
            const double drop = SUBSCRIPT_DROP * size;
            svg_write(svg, "<tspan dy=\"#\" font-size=\"#\">", drop, SUBSCRIPT_SIZE * size);
            put_escaped(svg, text + 2, (size_t)(end - text) - 2);
            svg_write(svg, "</tspan><tspan dy=\"#\">", -drop);
            length -= (size_t)(end + 1 - text);
            text = end + 1;
            put_set(svg, text, length, size);
            svg_put(svg, "</tspan>");
            return;
        }
        if (length > 0) {
            put_escaped(svg, text, 2);
            text += 2;
            length -= 2;
        }
    }
}

/* Words, cut to the room there is. */
static void put_fitting(struct svg *svg, const char *text, double size, bool bold, double width)
{
    const char *set = typeset(svg->arena, text);
    if (!(width > 0) || typeset_width(set, size, bold) <= width) {
        put_set(svg, set, strlen(set), size);
        return;
    }
    const double ellipsis = typeset_width("…", size, bold);
    put_set(svg, set, typeset_fitting(set, size, bold, width - ellipsis), size);
    svg_put(svg, "…");
}

void svg_text(struct svg *svg, const struct svg_label *label, const char *text)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    if (text == NULL || text[0] == '\0' ||
        !svg_all_finite(label->x, label->y, label->size, label->rotation)) {
        return;
    }
    svg_write(svg, "<text x=\"#\" y=\"#\" font-size=\"#\"$$ fill=\"$\" stroke=\"none\"", label->x,
              label->y, label->size, anchors[label->anchor],
              label->bold ? " font-weight=\"bold\"" : "", label->colour ? label->colour : "#000");
    if (fabs(label->rotation) > 0) {
        svg_write(svg, " transform=\"rotate(# # #)\"", label->rotation, label->x, label->y);
    }
    svg_put(svg, ">");
    put_fitting(svg, text, label->size, label->bold, label->width);
    svg_put(svg, "</text>\n");
}

/* A text of which is remembered where it stands; of several the first. */
static void svg_slot_text(struct svg *svg, struct svg_slot *slot, const struct svg_label *label,
                          const char *text)
{
    const size_t start = svg->length;
    svg_text(svg, label, text);
    if (!slot->is_there) {
        *slot = (struct svg_slot){true, start, svg->length, *label};
    }
}

void svg_title(struct svg *svg, const struct svg_label *label, const char *text)
{
    svg_slot_text(svg, &svg->title, label, text);
}

void svg_subtitle(struct svg *svg, const struct svg_label *label, const char *text)
{
    svg_slot_text(svg, &svg->subtitle, label, text);
}

void svg_words(struct svg *svg, double x, double y, double size, enum svg_anchor anchor,
               const char *colour, const char *text)
{
    svg_text(svg,
             &(struct svg_label){.x = x, .y = y, .size = size, .anchor = anchor, .colour = colour},
             text);
}

void svg_words_within(struct svg *svg, double x, double y, double size, double width,
                      const char *colour, const char *text)
{
    svg_text(svg,
             &(struct svg_label){.x = x, .y = y, .size = size, .width = width, .colour = colour},
             text);
}

void svg_words_upwards(struct svg *svg, double x, double y, double size, const char *text)
{
    svg_text(
        svg,
        &(struct svg_label){.x = x, .y = y, .size = size, .rotation = -90, .anchor = SVG_MIDDLE},
        text);
}

void svg_heading(struct svg *svg, double x, double y, double size, double width, const char *text)
{
    svg_title(svg, &(struct svg_label){.x = x, .y = y, .size = size, .width = width, .bold = true},
              text);
}

void svg_subheading(struct svg *svg, double x, double y, double size, double width,
                    const char *text)
{
    svg_subtitle(
        svg, &(struct svg_label){.x = x, .y = y, .size = size, .width = width, .colour = "#555"},
        text);
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

/* Copy bytes, colours in the theme's. */
static void put_in_theme(struct svg *svg, enum palette_theme theme, const char *start,
                         size_t length)
{
    static const char *const attributes[] = {"fill=\"#", "stroke=\"#"};
    const char *end = start + length, *kept = start;
    for (const char *at = start; at < end;) {
        const char *mark = memchr(at, '#', (size_t)(end - at));
        if (mark == NULL) {
            break;
        }
        at = mark + 1;
        bool is_colour = false;
        for (size_t i = 0; i < sizeof attributes / sizeof attributes[0]; i++) {
            const size_t before = strlen(attributes[i]);
            is_colour = is_colour || ((size_t)(at - start) >= before &&
                                      memcmp(at - before, attributes[i], before) == 0);
        }
        const size_t digits = strspn(at, "0123456789abcdefABCDEF");
        char shown[PALETTE_LENGTH];
        if (is_colour && at + digits < end && at[digits] == '"' &&
            palette_in_theme(theme, mark, shown)) {
            put_bytes(svg, kept, (size_t)(mark - kept));
            svg_put(svg, shown);
            kept = at + digits;
        }
    }
    put_bytes(svg, kept, (size_t)(end - kept));
}

struct svg svg_dress(const struct svg *drawing, const struct svg_dress *dress)
{
    const struct {
        const struct svg_slot *slot;
        const char *text;
    } words[] = {{&drawing->name, dress->title},
                 {&drawing->title, dress->title},
                 {&drawing->subtitle, dress->subtitle}};
    struct svg worded = {.arena = drawing->arena}, dressed = worded;
    size_t done = 0;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        const struct svg_slot *slot = words[i].slot;
        if (!slot->is_there || words[i].text == NULL || slot->start < done) {
            continue;
        }
        put_bytes(&worded, drawing->data + done, slot->start - done);
        if (slot == &drawing->name) {
            put_fitting(&worded, words[i].text, 0, false, 0);
        } else {
            svg_text(&worded, &slot->label, words[i].text);
        }
        done = slot->end;
    }
    if (done == 0 && dress->theme == PALETTE_LIGHT) {
        return *drawing;
    }
    put_bytes(&worded, drawing->data + done, drawing->length - done);
    if (dress->theme == PALETTE_LIGHT) {
        return worded;
    }
    put_in_theme(&dressed, dress->theme, worded.data, worded.length);
    return dressed;
}
