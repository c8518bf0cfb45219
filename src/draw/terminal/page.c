/* draw/terminal/page.c - SVG drawings as lines of a terminal: curves of Braille dots, and words. */
/* SPDX-License-Identifier: MIT */
#include "draw/terminal/page.h"

#include "draw/terminal/ink.h"
#include "draw/terminal/page_paint.h"

#include <math.h>
#include <string.h>

/* -------- reading -------- */

static bool shape_is_words(const struct svg_shape *shape)
{
    return shape->kind == SVG_SHAPE_WORDS;
}

/* Characters, as a terminal counts them. */
static double shape_cells(const struct svg_shape *shape)
{
    return (double)text_cells(shape->words);
}

static bool shape_is_turned(const struct svg_shape *shape)
{
    return fabs(shape->turn) > 30;
}

/* A rectangle over the whole page is its paper. */
static bool shape_is_paper(const struct page *page, const struct svg_shape *shape)
{
    return shape->kind == SVG_SHAPE_LINES && !shape->fill.is_none && shape->count == 5 &&
           shape->x[0] <= 0 && shape->y[0] <= 0 && shape->x[2] >= page->width - 1 &&
           shape->y[2] >= page->height - 1;
}

static void page_note_shape(struct page *page, const struct svg_shape *shape)
{
    for (size_t i = 0; i < shape->count && !shape_is_words(shape); i++) {
        if (!isnan(shape->x[i])) {
            const double x = fmin(fmax(shape->x[i], shape->clip.left), shape->clip.right);
            const double y = fmin(fmax(shape->y[i], shape->clip.top), shape->clip.bottom);
            svg_bounds_include(&page->drawn, fmin(fmax(x, 0), page->width),
                               fmin(fmax(y, 0), page->height));
        }
    }
    bool is_known = shape->stroke.is_none || ink_is_grey(&shape->stroke);
    for (size_t i = 0; i < page->stroke_count && !is_known; i++) {
        is_known =
            memcmp(page->strokes[i].part, shape->stroke.part, sizeof shape->stroke.part) == 0;
    }
    if (!is_known && page->stroke_count < STROKES_MOST) {
        page->strokes[page->stroke_count++] = shape->stroke;
    }
}

static void page_read(struct page *page, struct text drawing)
{
    struct svg_reader reader;
    struct svg_shape shape;
    svg_read_begin(&reader, drawing, page->arena);
    page->drawn = (struct svg_bounds){INFINITY, INFINITY, -INFINITY, -INFINITY};
    page->paper = (struct svg_colour){.part = {1, 1, 1}};
    while (svg_read(&reader, &shape)) {
        page->width = reader.width;
        page->height = reader.height;
        if (shape_is_paper(page, &shape)) {
            page->paper = shape.fill;
        } else {
            page_note_shape(page, &shape);
            *ARENA_ADD(page->arena, page->shapes, page->count, page->room) = shape;
        }
    }
    if (!(page->drawn.left <= page->drawn.right)) {
        page->drawn = (struct svg_bounds){0, 0, page->width, page->height};
    }
}

/*
 * A line above all that is drawn, from the left or about the middle: of the title. One right on top
 * of it is the title of a panel.
 */
static bool shape_is_head(const struct page *page, const struct svg_shape *shape)
{
    const bool is_middle = shape->anchor == 0 && fabs(2 * shape->x[0] - page->width) < 2;
    return shape_is_words(shape) && !shape_is_turned(shape) &&
           shape->y[0] + shape->size < page->drawn.top && (shape->anchor < 0 || is_middle);
}

/* Middle of a line of letters, px. */
static double shape_middle(const struct svg_shape *shape)
{
    return shape->y[0] - 0.35 * shape->size;
}

/* A line below all that is drawn, from the left. */
static bool shape_is_note(const struct page *page, const struct svg_shape *shape)
{
    return shape_is_words(shape) && !shape_is_turned(shape) && shape->anchor < 0 &&
           shape->y[0] - shape->size > page->drawn.bottom;
}

/* -------- the scale -------- */

/* Cells that words take left of their anchor. */
static double shape_cells_left(const struct svg_shape *shape)
{
    return shape_cells(shape) * (1 + shape->anchor) / 2;
}

/*
 * With a scale, the least column of x = 0 at which nothing is cut on the left.
 *
 * Result    does everything fit on the right?
 */
static bool page_try_scale(struct page *page, double scale)
{
    const double columns = (double)page->view->columns, most = columns / 3;
    page->scale = scale;
    page->left = -page->drawn.left * scale;
    for (int side = 0; side < 2; side++) {
        for (size_t i = 0; i < page->count; i++) {
            const struct svg_shape *shape = &page->shapes[i];
            if (!shape_is_words(shape) || shape_is_turned(shape) || shape_is_head(page, shape) ||
                shape_is_note(page, shape) || shape_cells(shape) > most) {
                continue;
            }
            const double left = shape_cells_left(shape), right = shape_cells(shape) - left;
            if (side == 0) {
                page->left = fmax(page->left, left - scale * shape->x[0]);
            } else if (page->left + scale * shape->x[0] + right > columns + 1e-9) {
                return false;
            }
        }
    }
    return page->left + scale * page->drawn.right <= columns - 0.5; /* the last dot */
}

static void page_find_scale(struct page *page)
{
    enum { STEPS = 40, LINES_AROUND = 4 };
    static const double usual = 80, least = 0.3;
    const double columns = (double)page->view->columns, rows = (double)page->view->rows;
    double high = columns / fmax(page->drawn.right - page->drawn.left, 1);
    if (page->view->rows > LINES_AROUND) {
        /* as high as the screen, if that leaves it legible */
        const double fits = 2 * (rows - LINES_AROUND) / fmax(page->height, 1);
        high = fmin(high, fmax(fits, fmin(columns, usual) / fmax(page->width, 1)));
    }
    double low = least * high;
    for (int i = 0; i < STEPS && !page_try_scale(page, high); i++) {
        const double middle = (low + high) / 2;
        if (page_try_scale(page, middle)) {
            low = middle;
            if (high - low < 1e-3 * high) {
                high = low;
            }
        } else {
            high = middle;
        }
        if (i == STEPS - 2) {
            high = low;
        }
    }
}

/* -------- words -------- */

/* Words over the whole width, broken at blanks. */
static void words_put(const struct page *page, const struct svg_shape *shape,
                      struct text_buffer *lines)
{
    struct text rest = shape->words;
    const struct cell_ink ink = {.is_set = false};
    while (rest.length > 0) {
        size_t length = 0, fits = 0;
        for (size_t step; length < rest.length; length += step) {
            step = text_utf8_length(rest.start + length, rest.length - length);
            step = step > 0 ? step : 1;
            if (text_cells((struct text){rest.start, length + step}) > page->view->columns) {
                break;
            }
            fits = rest.start[length] == ' ' ? length : fits;
        }
        length = length == rest.length || fits == 0 ? length : fits;
        if (length == 0) {
            return; /* a character wider than the terminal */
        }
        struct cells line;
        cells_new(&line, page->view->columns, 1, page->view->colours, page->arena);
        const struct text words = {rest.start, length};
        const size_t left = page->view->columns - text_cells(words);
        cells_write(&line, shape->anchor < 0 ? 0 : (long)(left / 2), 0, words, shape->is_bold,
                    &ink);
        cells_put(&line, lines);
        rest = text_trim((struct text){rest.start + length, rest.length - length});
    }
}

/* The text's beginning in so many cells, its end an ellipsis. */
static struct text words_cut(struct text words, long cells, struct arena *arena)
{
    if ((long)text_cells(words) <= cells) {
        return words;
    }
    size_t length = 0;
    for (size_t step; length < words.length; length += step) {
        step = text_utf8_length(words.start + length, words.length - length);
        step = step > 0 ? step : 1;
        if ((long)text_cells((struct text){words.start, length + step}) > cells - 1) {
            break;
        }
    }
    return text_of(arena_printf(arena, "%.*s…", (int)length, words.start));
}

/* Only digits and what stands about them: a number of an axis. */
static bool words_are_number(struct text words)
{
    bool has_digit = false;
    for (size_t i = 0; i < words.length; i++) {
        const char c = words.start[i];
        has_digit = has_digit || char_is_digit(c);
        if (strchr("0123456789.,+-/%fe×−∞°⁰¹²³⁴⁵⁶⁷⁸⁹ ", c) == NULL) {
            return false;
        }
    }
    return has_digit;
}

static long page_row(const struct page *page, double y)
{
    return (long)floor((y - page->top) * page->scale / 2);
}

/*
 * The row near its own where words find room: of those without lines, else between them.
 *
 * Result    false: nowhere
 */
static bool words_find_row(const struct page *page, const long *away, size_t rows, long column,
                           long count, long *row)
{
    const long first = column > 0 ? column - 1 : 0, end = column + count + 1;
    const long last = end < (long)page->cells.columns ? end : (long)page->cells.columns;
    for (size_t i = 0; i < 2 * rows; i++) {
        const long at = *row + away[i % rows];
        if (cells_are_free(&page->cells, first, at, last - first, false) &&
            (i >= rows || cells_are_free(&page->cells, column, at, count, true))) {
            *row = at;
            return true;
        }
    }
    return false;
}

/* Words that are turned, with others below or above them, as beside panels: letter under letter. */
static bool words_stack(const struct page *page, const struct svg_shape *shape, long column,
                        const struct cell_ink *ink)
{
    const long count = (long)shape_cells(shape);
    const long first = page_row(page, shape->y[0]) - count / 2;
    bool has_others = false;
    for (size_t i = 0; i < page->count; i++) {
        const struct svg_shape *other = &page->shapes[i];
        const double across = fabs(other->x[0] - shape->x[0]);
        has_others =
            has_others || (other != shape && shape_is_words(other) && shape_is_turned(other) &&
                           across * page->scale < 2 && across < fabs(other->y[0] - shape->y[0]));
    }
    for (long i = 0; i < count && has_others; i++) {
        has_others = cells_are_free(&page->cells, column, first + i, 1, false);
    }
    struct text rest = shape->words;
    for (long i = 0; i < count && has_others; i++) {
        const size_t whole = text_utf8_length(rest.start, rest.length);
        const struct text letter = {rest.start, whole > 0 ? whole : 1};
        cells_write(&page->cells, column, first + i, letter, shape->is_bold, ink);
        rest = (struct text){rest.start + letter.length, rest.length - letter.length};
    }
    return has_others;
}

static bool words_are_on_page(const struct page *page, const struct svg_shape *shape)
{
    const double x = shape->x[0], y = shape->y[0];
    return x >= 0 && x <= page->width && y >= 0 && y <= page->height;
}

static void page_draw_words(struct page *page, const struct svg_shape *shape)
{
    static const long up[] = {0, -1, 1, -2, 2}, down[] = {0, 1, 2, 3, -1}, below[] = {0, 1};
    const long columns = (long)page->cells.columns;
    const struct cell_ink ink = ink_of_colour(&shape->fill);
    const struct text words = words_cut(shape->words, columns, page->arena);
    const long count = (long)text_cells(words);
    const bool is_number = words_are_number(words), is_turned = shape_is_turned(shape);
    const double place = page->left + page->scale * shape->x[0];
    const double before = is_turned ? 0 : (double)count * (1 + shape->anchor) / 2;
    long column = lround(place - before);
    long row = page_row(page, is_turned ? shape->y[0] : shape_middle(shape));
    column = column + count > columns ? columns - count : column;
    column = column < 0 ? 0 : column;
    if (is_turned) {
        if (words_stack(page, shape, column, &ink)) {
            return;
        }
        /* upright above what it describes */
        while (row > 0 && !cells_are_free(&page->cells, column, row, count, true)) {
            row--;
        }
    }
    const long own = row;
    /* a number of an axis says something of its own place alone */
    const bool is_low = row > page_row(page, (page->drawn.top + page->drawn.bottom) / 2);
    const size_t most = sizeof up / sizeof up[0], beside_axis = shape->anchor == 0 ? 2 : 1;
    bool finds;
    if (is_number) {
        finds = words_find_row(page, below, beside_axis, column, count, &row);
    } else {
        finds = words_find_row(page, is_low ? down : up, most, column, count, &row);
    }
    if (finds) {
        cells_write(&page->cells, column, row, words, shape->is_bold, &ink);
        return;
    }
    /* what fits before the next */
    long room = 0;
    while (room < count && cells_are_free(&page->cells, column + room, own, 1, false)) {
        room++;
    }
    if (!is_number && room > 4) {
        cells_write(&page->cells, column, own, words_cut(words, room - 1, page->arena),
                    shape->is_bold, &ink);
    }
}

/* -------- the page -------- */

void page_draw(struct text drawing, const struct page_view *view, struct arena *arena,
               struct text_buffer *lines)
{
    struct page page = {.view = view, .arena = arena};
    page_read(&page, drawing);
    page_find_scale(&page);
    bool has_turned = false;
    double top = page.drawn.top, bottom = page.drawn.bottom;
    for (size_t i = 0; i < page.count; i++) {
        const struct svg_shape *shape = &page.shapes[i];
        has_turned = has_turned || (shape_is_words(shape) && shape_is_turned(shape));
        if (shape_is_head(&page, shape)) {
            words_put(&page, shape, lines);
        } else if (shape_is_words(shape) && !shape_is_turned(shape) &&
                   !shape_is_note(&page, shape)) {
            top = fmin(top, shape_middle(shape));
            bottom = fmax(bottom, shape_middle(shape));
        }
    }
    top = fmax(top, 0); /* what lies off the page is not seen */
    bottom = fmin(bottom, page.height);
    /* half a line above the first, a whole one where turned words may stand */
    page.top = top - (has_turned ? 2.6 : 0.6) / page.scale;
    const long rows = page_row(&page, bottom) + 3;
    cells_new(&page.cells, view->columns, rows > 0 ? (size_t)rows : 1, view->colours, arena);
    for (size_t i = 0; i < page.count; i++) {
        if (!shape_is_words(&page.shapes[i])) {
            page_paint(&page, &page.shapes[i]);
        }
    }
    for (size_t i = 0; i < page.count; i++) {
        const struct svg_shape *shape = &page.shapes[i];
        if (shape_is_words(shape) && !shape_is_head(&page, shape) && !shape_is_note(&page, shape) &&
            words_are_on_page(&page, shape)) {
            page_draw_words(&page, shape);
        }
    }
    cells_put(&page.cells, lines);
    for (size_t i = 0; i < page.count; i++) {
        if (shape_is_note(&page, &page.shapes[i]) && words_are_on_page(&page, &page.shapes[i])) {
            words_put(&page, &page.shapes[i], lines);
        }
    }
}
