/* draw/marks.c - marks of groups of points, and labels beside them that keep off each other. */
/* SPDX-License-Identifier: MIT */
#include "draw/marks.h"

#include "draw/typeset.h"

#include <math.h>

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

/* Places of the middle of a label, in half widths and heights of its own, the best first. */
static const struct {
    double x, y;
} places[] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}};

/* Half of its size, px. */
static struct svg_box label_size(const struct svg_label *label, const char *text)
{
    const double x = typeset_width(text, label->size, label->bold) / 2 + 1, y = 0.42 * label->size;
    return (struct svg_box){-x, -y, x, y};
}

static void label_draw(struct label_page *page, struct svg *svg, const struct svg_label *point,
                       const struct svg_box *box, const char *text)
{
    struct svg_label label = *point;
    label.x = (box->left + box->right) / 2;
    label.y = box->bottom - 0.06 * point->size;
    label.anchor = SVG_MIDDLE;
    svg_text(svg, &label, text);
    page->taken[page->taken_count++] = *box;
}

bool label_put(struct label_page *page, struct svg *svg, const struct svg_label *point, double gap,
               bool forced, const char *text)
{
    const struct svg_box size = label_size(point, text);
    const size_t count = sizeof places / sizeof places[0];
    const int most = forced ? 12 : 1;
    for (int ring = 0; ring < most; ring++) {
        const double away = gap + 12 * ring;
        for (size_t i = 0; i < count; i++) {
            const double x = point->x + places[i].x * (size.right + away);
            const double y = point->y + places[i].y * (size.bottom + away);
            const struct svg_box box = {x + size.left, y + size.top, x + size.right,
                                        y + size.bottom};
            const bool last = forced && ring + 1 == most && i + 1 == count;
            if (!label_is_free(page, &box) && !last) {
                continue;
            }
            if (ring > 0) {
                svg_styled_line(svg, &(struct svg_style){.stroke = "#555555", .width = 0.8},
                                point->x, point->y, x - places[i].x * size.right,
                                y - places[i].y * size.bottom);
            }
            label_draw(page, svg, point, &box, text);
            return true;
        }
    }
    return false;
}

void label_put_about(struct label_page *page, struct svg *svg, const struct svg_label *point,
                     const char *text)
{
    const struct svg_box size = label_size(point, text);
    for (double away = 0; away <= 2 * size.right; away += 3) {
        for (int turn = 0; turn < 16; turn++) {
            const double angle = turn * 0.39269908169872414; /* pi/8 */
            const double x = point->x + away * cos(angle), y = point->y + away * sin(angle);
            const struct svg_box box = {x + size.left, y + size.top, x + size.right,
                                        y + size.bottom};
            if (label_is_free(page, &box)) {
                label_draw(page, svg, point, &box, text);
                return;
            }
        }
    }
}
