/* draw/marks.c - marks of groups of points, and labels beside them that keep off each other. */
/* SPDX-License-Identifier: MIT */
#include "draw/marks.h"

enum { COLOURS = 7, SHAPES = 3 };

void mark_draw(struct svg *svg, size_t group, double x, double y, double radius)
{
    const double triangle_x[] = {x - radius, x + radius, x};
    const double triangle_y[] = {y + 0.8 * radius, y + 0.8 * radius, y - 1.1 * radius};
    switch (group / COLOURS % SHAPES) {
    case 0:
        svg_circle(svg, x, y, radius);
        break;
    case 1:
        svg_rect(svg, x - 0.85 * radius, y - 0.85 * radius, 1.7 * radius, 1.7 * radius);
        break;
    default:
        svg_polygon(svg, triangle_x, triangle_y, 3);
        break;
    }
}

void label_page_take(struct label_page *page, double x, double y, double radius)
{
    page->taken[page->taken_count++] =
        (struct svg_box){x - radius, y - radius, x + radius, y + radius};
}

static bool label_is_free(const struct label_page *page, const struct svg_box *box)
{
    const struct svg_box *frame = &page->frame;
    return box->left >= frame->left && box->right <= frame->right && box->top >= frame->top &&
           box->bottom <= frame->bottom && svg_is_free(page->taken, page->taken_count, box);
}

bool label_put(struct label_page *page, struct svg *svg, const struct svg_label *point, double gap,
               bool forced, const char *text)
{
    static const struct {
        double x, y; /* place of the label's middle, in half widths and heights */
    } places[] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}};
    const double x = point->x, y = point->y, size = point->size;
    double half_width = svg_text_width(text, size) / 2, half_height = 0.42 * size;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        double shift_x = places[i].x * (half_width + gap);
        double shift_y = places[i].y * (half_height + gap);
        struct svg_box box = {x + shift_x - half_width, y + shift_y - half_height,
                              x + shift_x + half_width, y + shift_y + half_height};
        bool last = i + 1 == sizeof places / sizeof places[0];
        if (label_is_free(page, &box) || (last && forced)) {
            svg_words(svg, x + shift_x, box.bottom - 0.06 * size, size, SVG_MIDDLE, point->colour,
                      text);
            page->taken[page->taken_count++] = box;
            return true;
        }
    }
    return false;
}
