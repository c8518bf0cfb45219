/* commands/analysis/report_page.c - a page of drawings and tables, as HTML or one drawing. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/report_page.h"

#include "base/number.h"
#include "cli/answer/driver.h"
#include "commands/commands.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/typeset.h"

#include <math.h>
#include <string.h>

/* px of the drawing: of a column and the space around it; of a line of text and its characters. */
enum { COLUMN_WIDTH = 800, MARGIN = 40, HEAD = 46, LINE = 15, FONT = 12 };
static const double whole_width = 2 * COLUMN_WIDTH + MARGIN; /* of both columns */
static const double character = 0.602 * FONT;                /* of a monospaced font */

/* Does the text go on with these words? */
static bool report_goes_on(struct text text, size_t at, const char *words)
{
    const size_t length = strlen(words);
    return text.length - at >= length && memcmp(text.start + at, words, length) == 0;
}

/* The SVG element, without what stands before it in a file of its own. */
static struct text svg_element_of(struct text svg)
{
    size_t at = 0;
    while (at < svg.length && !report_goes_on(svg, at, "<svg")) {
        at++;
    }
    return (struct text){svg.start + at, svg.length - at};
}

/* A number of an attribute of the element; NaN without one. */
static double attribute(struct text svg, const char *name)
{
    for (size_t at = 0; at < svg.length && svg.start[at] != '>'; at++) {
        if (report_goes_on(svg, at, name)) {
            double value;
            const char *end = svg.start + svg.length;
            const char *from = svg.start + at + strlen(name);
            return number_read(from, end, NUMBER_UNSCALED, &value) != NULL ? value : (double)NAN;
        }
    }
    return NAN;
}

/* Is it drawn so much wider than a column that its words would be small in one? */
static bool is_wide(const struct page_part *part)
{
    return !part->is_paired && part->failure == NULL && part->is_drawing &&
           attribute(svg_element_of(part->text), " width=\"") > 1.3 * COLUMN_WIDTH;
}

/* The names in the tags of a drawing are its own: each has the number of the part before it. */
static void report_write_names(struct text svg, size_t part, struct output *output)
{
    static const char *const before[] = {"id=\"", "url(#", "href=\"#"};
    size_t from = 0, at = 0;
    bool is_tag = false;
    while (at < svg.length) {
        size_t step = 1;
        is_tag = svg.start[at] == '<' || (is_tag && svg.start[at] != '>');
        for (size_t k = 0; is_tag && k < sizeof before / sizeof before[0]; k++) {
            if (report_goes_on(svg, at, before[k])) {
                step = strlen(before[k]);
                output_text(output, svg.start + from, at + step - from);
                output_printf(output, "p%zu-", part);
                from = at + step;
            }
        }
        at += step;
    }
    output_text(output, svg.start + from, svg.length - from);
}

/* -------- HTML -------- */

static const char style[] =
    "body { font-family: Helvetica, Arial, sans-serif; margin: 2em auto; max-width: 1700px; }\n"
    "h1 { margin-bottom: 0.2em; }\n"
    "h2 { column-span: all; border-bottom: 1px solid; }\n"
    "main { columns: 2 34em; column-gap: 2em; }\n"
    "figure { break-inside: avoid; margin: 0 0 1.5em 0; }\n"
    "figure svg { max-width: 100%; height: auto; }\n"
    "figure.wide { column-span: all; }\n"
    "figcaption { font-weight: bold; }\n"
    ".pair { column-span: all; display: grid; grid-template-columns: 1fr 1fr; gap: 2em; }\n"
    ".pair figure { min-width: 0; }\n"
    "pre { overflow-x: auto; font-size: 80%; }\n"
    "code { opacity: 0.65; font-weight: normal; font-size: 80%; }\n"
    "@page { margin: 15mm; }\n"
    "@media print {\n"
    "body { margin: 0; }\n"
    "h2 { break-after: avoid; }\n"
    "main { columns: auto; }\n"
    "h1 { font-size: 18pt; margin-top: 0; }\n"
    "figure { margin-bottom: 5mm; }\n"
    "figure svg { max-height: 80mm; width: auto; }\n"
    ".pair { gap: 5mm; }\n"
    "pre { font-size: 7pt; margin: 2mm 0; overflow: visible; white-space: pre-wrap; }\n"
    "}\n";

/* What a colour of a light page is on this one. */
struct page_colour {
    char of[PALETTE_LENGTH];
};

static struct page_colour page_colour(enum palette_theme theme, const char *colour)
{
    struct page_colour shown;
    if (!palette_in_theme(theme, colour, shown.of)) {
        memcpy(shown.of, colour, strlen(colour) + 1);
    }
    return shown;
}

static void write_figure(const struct page_part *part, size_t number, struct output *output)
{
    if (part->is_heading) {
        output_string(output, "<h2>");
        output_escaped(output, text_of(part->title));
        output_string(output, "</h2>\n");
        return;
    }
    output_string(output, is_wide(part) ? "<figure class=\"wide\">\n<figcaption>"
                                        : "<figure>\n<figcaption>");
    output_escaped(output, text_of(part->title));
    if (part->command != NULL) {
        output_string(output, " <code>");
        output_escaped(output, text_of(part->command));
        output_string(output, "</code>");
    }
    output_string(output, "</figcaption>\n");
    if (part->failure != NULL) {
        output_string(output, "<p>");
        output_escaped(output, text_of(part->failure));
        output_string(output, "</p>\n");
    } else if (part->is_drawing) {
        report_write_names(svg_element_of(part->text), number, output);
    } else {
        output_string(output, "<pre>");
        output_escaped(output, part->text);
        output_string(output, "</pre>\n");
    }
    output_string(output, "</figure>\n");
}

/* An element of some words, if there are any. */
static void write_element(const char *name, const char *words, struct output *output)
{
    if (words[0] != '\0') {
        output_printf(output, "<%s>", name);
        output_escaped(output, text_of(words));
        output_printf(output, "</%s>\n", name);
    }
}

/* A page that needs nothing else: styles and drawings lie in it. */
static void page_write_html(const struct page *page, enum palette_theme theme,
                            struct output *output)
{
    output_string(output, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                          "<title>");
    output_escaped(output, text_of(page->title));
    output_string(output, "</title>\n<style>\n");
    output_string(output, style);
    if (theme == PALETTE_DARK) {
        output_printf(output, "html { background: %s; color: %s; color-scheme: dark; }\n",
                      page_colour(theme, "#fff").of, page_colour(theme, "#000").of);
    }
    output_string(output, "</style>\n</head>\n<body>\n");
    write_element("h1", page->title, output);
    write_element("p", page->subtitle, output);
    output_string(output, "<main>\n");
    for (size_t i = 0; i < page->count; i++) {
        const struct page_part *part = &page->parts[i];
        output_string(output, part->is_paired && !part->is_right ? "<div class=\"pair\">\n" : "");
        write_figure(part, i, output);
        output_string(output, part->is_paired && part->is_right ? "</div>\n" : "");
    }
    output_string(output, "</main>\n</body>\n</html>\n");
}

/* -------- one drawing -------- */

/* How tall a part is in a column, and at which scale it is drawn. */
static double report_height_of(const struct page_part *part, double *scale)
{
    *scale = 1;
    if (part->failure != NULL) {
        return LINE;
    }
    if (part->is_drawing) {
        const struct text svg = svg_element_of(part->text);
        const double width = attribute(svg, " width=\"");
        *scale = fmin((is_wide(part) ? whole_width : COLUMN_WIDTH) / width, 1);
        return *scale * attribute(svg, " height=\"");
    }
    size_t lines = 1, widest = 0, wide = 0;
    for (size_t i = 0; i < part->text.length; i++) {
        const bool ends = part->text.start[i] == '\n';
        lines += ends;
        wide = ends ? 0 : wide + (((unsigned char)part->text.start[i] & 0xc0) != 0x80);
        widest = wide > widest ? wide : widest;
    }
    *scale = fmin(COLUMN_WIDTH / (character * (double)widest), 1);
    return *scale * LINE * (double)lines;
}

static void report_write_label(struct output *output, double x, double y, const char *look,
                               struct text words)
{
    output_printf(output, "<text x=\"%.6g\" y=\"%.6g\" fill=\"currentColor\" %s>", x, y, look);
    output_escaped(output, words);
    output_string(output, "</text>\n");
}

static void report_write_lines(const struct page_part *part, double x, double y, double scale,
                               struct output *output)
{
    struct text rest = part->text;
    output_printf(output,
                  "<g transform=\"translate(%.6g %.6g) scale(%.6g)\" font-family=\"monospace\" "
                  "font-size=\"%d\" xml:space=\"preserve\">\n",
                  x, y, scale, FONT);
    for (int i = 1; rest.length > 0; i++) {
        const struct text line = text_cut(&rest, '\n');
        if (line.length > 0) {
            report_write_label(output, 0, i * LINE, "", line);
        }
    }
    output_string(output, "</g>\n");
}

static void report_write_part(const struct page_part *part, size_t number, const double at[2],
                              struct output *output)
{
    double scale, x = at[0], y = at[1] + HEAD;
    const double height = report_height_of(part, &scale);
    report_write_label(output, x, at[1] + 18, "font-size=\"15\" font-weight=\"bold\"",
                       text_of(part->title));
    report_write_label(output, x, at[1] + 36, "font-size=\"11\" font-family=\"monospace\"",
                       text_of(part->command != NULL ? part->command : ""));
    if (part->failure != NULL) {
        report_write_label(output, x, y + FONT, "font-size=\"12\"", text_of(part->failure));
    } else if (!part->is_drawing) {
        report_write_lines(part, x, y, scale, output);
    } else {
        const struct text svg = svg_element_of(part->text);
        const double width = attribute(svg, " width=\"");
        output_printf(output,
                      "<svg x=\"%.6g\" y=\"%.6g\" width=\"%.6g\" height=\"%.6g\" "
                      "viewBox=\"0 0 %.6g %.6g\">\n",
                      x, y, scale * width, height, width, height / scale);
        report_write_names(svg, number, output);
        output_string(output, "</svg>\n");
    }
}

/* Where each part stands; returns how tall the page is. */
static double place_parts(const struct page *page, double (*places)[2])
{
    double ends[2] = {2 * MARGIN + HEAD, 2 * MARGIN + HEAD};
    for (size_t i = 0; i < page->count; i++) {
        const struct page_part *part = &page->parts[i];
        double scale;
        if (part->is_heading) {
            places[i][0] = MARGIN;
            places[i][1] = fmax(ends[0], ends[1]);
            ends[0] = ends[1] = places[i][1] + HEAD;
            continue;
        }
        if (is_wide(part)) {
            places[i][0] = MARGIN;
            places[i][1] = fmax(ends[0], ends[1]);
            ends[0] = ends[1] = places[i][1] + HEAD + report_height_of(part, &scale) + MARGIN;
            continue;
        }
        const int column = part->is_paired ? part->is_right : ends[1] < ends[0];
        if (part->is_paired && !part->is_right) {
            ends[0] = ends[1] = fmax(ends[0], ends[1]);
        }
        places[i][0] = MARGIN + column * (COLUMN_WIDTH + MARGIN);
        places[i][1] = ends[column];
        ends[column] += HEAD + report_height_of(part, &scale) + MARGIN;
    }
    return fmax(ends[0], ends[1]) + MARGIN;
}

/* The same as one drawing: two columns, each part below the end of the shorter one. */
static void page_write_svg(const struct page *page, enum palette_theme theme, struct arena *arena,
                           struct output *output)
{
    double(*places)[2] = arena_array(arena, page->count, sizeof *places);
    const double height = place_parts(page, places);
    const int width = 2 * COLUMN_WIDTH + 3 * MARGIN;
    output_printf(output,
                  "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"%d\" "
                  "height=\"%.6g\" viewBox=\"0 0 %d %.6g\" font-family=\"Helvetica, Arial, "
                  "sans-serif\" color=\"%s\">\n<title>",
                  width, height, width, height, page_colour(theme, "#000").of);
    output_escaped(output, text_of(page->title));
    output_printf(output, "</title>\n<rect width=\"%d\" height=\"%.6g\" fill=\"%s\"/>\n", width,
                  height, page_colour(theme, "#fff").of);
    report_write_label(output, MARGIN, MARGIN + 24, "font-size=\"26\" font-weight=\"bold\"",
                       text_of(page->title));
    report_write_label(output, MARGIN, MARGIN + 48, "font-size=\"14\"", text_of(page->subtitle));
    for (size_t i = 0; i < page->count; i++) {
        const struct page_part *part = &page->parts[i];
        if (part->is_heading) {
            report_write_label(output, places[i][0], places[i][1] + 24,
                               "font-size=\"20\" font-weight=\"bold\"", text_of(part->title));
        } else {
            report_write_part(part, i, places[i], output);
        }
    }
    output_string(output, "</svg>\n");
}

/* -------- its parts -------- */

bool page_ask(const struct page_question *question, struct run *run, struct page_part *part)
{
    struct error error = {0};
    const struct embedded_command embedding = {command_find(text_of(question->command)),
                                               (char **)question->words, question->count,
                                               question->lens, question->lens_count};
    part->failure = NULL;
    if (!command_embed(&embedding, run, &part->text, &error)) {
        part->failure = error.hint[0] == '\0'
                            ? arena_string(run->arena, error.message, strlen(error.message))
                            : arena_printf(run->arena, "%s; %s", error.message, error.hint);
    }
    return part->failure == NULL;
}

static const struct file_type types[] = {{{"html", "page"}, ".html"}, {{"svg", "drawing"}, ".svg"}};

const struct file_type *page_types(size_t i)
{
    return i < sizeof types / sizeof types[0] ? &types[i] : NULL;
}

void page_write(const struct page *page, const struct artifact_job *job, struct output *output)
{
    const struct svg_dress *dress = &job->dress;
    struct arena *arena = job->run->arena;
    struct page dressed = *page;
    dressed.title = dress->title != NULL ? typeset(arena, dress->title) : page->title;
    dressed.subtitle = dress->subtitle != NULL ? typeset(arena, dress->subtitle) : page->subtitle;
    dressed.parts = ARENA_ARRAY(arena, page->count, struct page_part);
    for (size_t i = 0; i < page->count; i++) {
        struct page_part *part = &dressed.parts[i];
        *part = page->parts[i];
        if (part->is_drawing && part->failure == NULL) {
            const struct svg drawing = {
                .arena = arena,
                .data = arena_string(arena, part->text.start, part->text.length),
                .length = part->text.length};
            const struct svg shown =
                svg_dress(&drawing, &(struct svg_dress){.theme = dress->theme});
            part->text = (struct text){shown.data, shown.length};
        }
    }
    if (job->type == &types[1]) {
        page_write_svg(&dressed, dress->theme, arena, output);
    } else {
        page_write_html(&dressed, dress->theme, output);
    }
}
