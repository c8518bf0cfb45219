/* commands/analysis/cmd_report.c - lenscalc report: all about a lens on one page. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "base/parallel.h"
#include "cli/answer/driver.h"
#include "commands/commands.h"
#include "commands/lens/lens_options.h"
#include "file/lens_file.h"
#include "report/output.h"
#include "report/version.h"

#include <math.h>
#include <string.h>

struct report_input {
    struct lens_question question;
    bool images;
    long threads; /* 0 = one per core */
};

static const struct option options[] = {
    LENS_OPTION(struct report_input, question),
    LENS_FNUMBER_OPTION(struct report_input, question),
    {OPTION(struct report_input, question.position), .name = "position", .value = "NAME",
     .help = "a name or focal length (135mm), a list, or all; default up to three of them"},
    {OPTION(struct report_input, images), .name = "images",
     .help = "images of points too (psf), which take longer than all the rest"},
    {OPTION(struct report_input, threads), .name = "threads", .lowest = 0, .highest = PARALLEL_MOST,
     .value = "N", .fallback = "0",
     .help = "threads that share the analyses and their fields; 0 = one per core"},
};

/* -------- the page -------- */

enum { MOST_WORDS = 10 };

/* A part of the page. */
struct page_part {
    const struct report_section *section; /* null: a heading over all columns */
    const char *title;
    char *words[MOST_WORDS]; /* of the command that is asked */
    size_t word_count;
    const char *command; /* that makes it again, for a shell */
    struct text text;    /* SVG, or lines of text */
    bool is_drawing;
    const char *failure; /* why there is none; null: all is well */
};

struct page {
    const char *title, *subtitle;
    struct page_part *parts;
    size_t count;
};

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
    return part->failure == NULL && part->is_drawing &&
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
    "pre { overflow-x: auto; font-size: 80%; }\n"
    "code { color: #666; font-weight: normal; font-size: 80%; }\n"
    "@media print { body { margin: 0; } pre { font-size: 55%; white-space: pre; } }\n";

static void write_figure(const struct page_part *part, size_t number, struct output *output)
{
    if (part->section == NULL) {
        output_string(output, "<h2>");
        output_escaped(output, text_of(part->title));
        output_string(output, "</h2>\n");
        return;
    }
    output_string(output, is_wide(part) ? "<figure class=\"wide\">\n<figcaption>"
                                        : "<figure>\n<figcaption>");
    output_escaped(output, text_of(part->title));
    output_string(output, " <code>");
    output_escaped(output, text_of(part->command));
    output_string(output, "</code></figcaption>\n");
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

/* A page that needs nothing else: styles and drawings lie in it. */
static void page_write_html(const struct page *page, struct output *output)
{
    output_string(output, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                          "<title>");
    output_escaped(output, text_of(page->title));
    output_string(output, "</title>\n<style>\n");
    output_string(output, style);
    output_string(output, "</style>\n</head>\n<body>\n<h1>");
    output_escaped(output, text_of(page->title));
    output_string(output, "</h1>\n<p>");
    output_escaped(output, text_of(page->subtitle));
    output_string(output, "</p>\n<main>\n");
    for (size_t i = 0; i < page->count; i++) {
        write_figure(&page->parts[i], i, output);
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
    output_printf(output, "<text x=\"%.6g\" y=\"%.6g\" fill=\"#000\" %s>", x, y, look);
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
                       text_of(part->command));
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
        if (part->section == NULL) {
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
        const int column = ends[1] < ends[0];
        places[i][0] = MARGIN + column * (COLUMN_WIDTH + MARGIN);
        places[i][1] = ends[column];
        ends[column] += HEAD + report_height_of(part, &scale) + MARGIN;
    }
    return fmax(ends[0], ends[1]) + MARGIN;
}

/* The same as one drawing: two columns, each part below the end of the shorter one. */
static void page_write_svg(const struct page *page, struct arena *arena, struct output *output)
{
    double(*places)[2] = arena_array(arena, page->count, sizeof *places);
    const double height = place_parts(page, places);
    const int width = 2 * COLUMN_WIDTH + 3 * MARGIN;
    output_printf(output,
                  "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"%d\" "
                  "height=\"%.6g\" viewBox=\"0 0 %d %.6g\" font-family=\"Helvetica, Arial, "
                  "sans-serif\">\n<title>",
                  width, height, width, height);
    output_escaped(output, text_of(page->title));
    output_printf(output, "</title>\n<rect width=\"%d\" height=\"%.6g\" fill=\"#fff\"/>\n", width,
                  height);
    report_write_label(output, MARGIN, MARGIN + 24, "font-size=\"26\" font-weight=\"bold\"",
                       text_of(page->title));
    report_write_label(output, MARGIN, MARGIN + 48, "font-size=\"14\"", text_of(page->subtitle));
    for (size_t i = 0; i < page->count; i++) {
        const struct page_part *part = &page->parts[i];
        if (part->section == NULL) {
            report_write_label(output, places[i][0], places[i][1] + 24,
                               "font-size=\"20\" font-weight=\"bold\"", text_of(part->title));
        } else {
            report_write_part(part, i, places[i], output);
        }
    }
    output_string(output, "</svg>\n");
}

/* -------- its parts -------- */

/* What a part needs of the options. */
enum {
    TAKES_FNUMBER = 1,
    TAKES_POSITION = 2,
    TAKES_BOTH = TAKES_FNUMBER | TAKES_POSITION,
    OF_WHOLE_LENS = 4,
    TAKES_THREADS = 8,
    TAKES_ALL = TAKES_BOTH | TAKES_THREADS,
    IS_IMAGE = 16
};

/* A part: a command, and which of its drawings; without one its rows. */
struct report_section {
    const char *title, *command, *drawing;
    unsigned takes;
    bool is_drawing;
};

static const struct report_section sections[] = {
    {"Prescription", "convert", NULL, OF_WHOLE_LENS, false},
    {"Cross-section", "draw", NULL, TAKES_BOTH, true},
    {"First-order data", "lens", NULL, TAKES_BOTH, false},
    {"Surfaces", "surfaces", NULL, TAKES_BOTH, false},
    {"Third order", "seidel", "--plot", TAKES_BOTH, true},
    {"Ray fans", "fan", "--plot", TAKES_ALL, true},
    {"Spots", "spot", "--plot", TAKES_ALL, true},
    {"Spots in numbers", "spot", NULL, TAKES_ALL, false},
    {"Wave fronts", "wavefront", "--plot", TAKES_ALL, true},
    {"Wave fronts in numbers", "wavefront", NULL, TAKES_ALL, false},
    {"Images of points", "psf", "--plot", TAKES_ALL | IS_IMAGE, true},
    {"Images of points in numbers", "psf", NULL, TAKES_ALL | IS_IMAGE, false},
    {"Contrast", "mtf", "--plot", TAKES_BOTH, true},
    {"Contrast in numbers", "mtf", NULL, TAKES_BOTH, false},
    {"Field curvature", "field", "--plot", TAKES_BOTH, true},
    {"Distortion", "distortion", "--plot", TAKES_BOTH, true},
    {"Light over the image", "illumination", "--plot", TAKES_ALL, true},
    {"Colour", "color", "--plot", TAKES_BOTH, true},
};
enum { SECTIONS = sizeof sections / sizeof sections[0], MOST_POSITIONS = 3, FIELDS_SHOWN = 100 };

/* What a lens is called that was read from there. */
static const char from_pipe[] = "standard input";

/* A word as a shell reads it: between quotes of one stroke, which stand as '\'' themselves. */
static const char *shell_quoted(const char *word, struct arena *arena)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "-_./:,=+@%";
    const char *line = "'";
    if (word[0] != '\0' && word[strspn(word, plain)] == '\0') {
        return word;
    }
    for (const char *rest = word; *rest != '\0'; rest += strcspn(rest, "'")) {
        for (; *rest == '\''; rest++) {
            line = arena_printf(arena, "%s'\\''", line);
        }
        line = arena_printf(arena, "%s%.*s", line, (int)strcspn(rest, "'"), rest);
    }
    return arena_printf(arena, "%s'", line);
}

static const char *command_line(const struct report_section *part, char *const *words, size_t count,
                                struct arena *arena)
{
    const char *line = arena_printf(arena, "lenscalc %s", part->command);
    for (size_t i = 0; i < count; i++) {
        const char *said = strcmp(words[i], from_pipe) == 0 ? "-" : words[i];
        line = arena_printf(arena, "%s %s", line, shell_quoted(said, arena));
    }
    return line;
}

static char *report_word(const char *text, struct arena *arena)
{
    return arena_string(arena, text, strlen(text));
}

static char *number_word(double number, struct arena *arena)
{
    char text[NUMBER_LENGTH];
    return arena_string(arena, text, (size_t)(number_write_shortest(text, number) - text));
}

/* The question that a section is the answer to. */
static struct page_part report_part(const struct report_input *input,
                                    const struct report_section *section, const char *position,
                                    struct arena *arena)
{
    const struct lens_question *question = &input->question;
    struct page_part part = {
        .section = section, .title = section->title, .is_drawing = section->is_drawing};
    char **words = part.words;
    size_t count = 0;
    words[count++] = report_word(question->lens.name, arena);
    if (!isnan(question->fnumber) && (section->takes & TAKES_FNUMBER) != 0) {
        words[count++] = report_word("-N", arena);
        words[count++] = number_word(question->fnumber, arena);
    }
    if (position != NULL && (section->takes & TAKES_POSITION) != 0) {
        words[count++] = report_word("--position", arena);
        words[count++] = report_word(position, arena);
    }
    if (section->drawing != NULL) {
        words[count++] = report_word(section->drawing, arena);
        /* it stays in memory, but this is how it would be called */
        words[count++] = report_word(arena_printf(arena, "%s.svg", section->command), arena);
    }
    part.command = command_line(section, words, count, arena);
    if (input->threads != 1 && (section->takes & TAKES_THREADS) != 0) {
        /* which change nothing that is shown: for when other parts are done before */
        words[count++] = report_word("--threads", arena);
        words[count++] = number_word((double)input->threads, arena);
    }
    part.word_count = count;
    return part;
}

struct report_writer {
    const struct report_input *input;
    const struct run *run;
    struct page *page;
};

/*
 * Ask the commands of some parts, and keep what they say or why they cannot. All parts come twice:
 * first those are answered that take one thread each, then the others fill what is left.
 */
static void report_answer(void *context, const struct parallel_piece *piece)
{
    const struct report_writer *writer = context;
    const struct lens_question *question = &writer->input->question;
    struct arena *arena = piece->arena;
    struct run run = *writer->run;
    run.arena = arena;
    for (size_t i = piece->begin; i < piece->end && watch_ask(run.watch); i++) {
        struct page_part *part = &writer->page->parts[i % writer->page->count];
        const bool is_second = i >= writer->page->count;
        struct error error = {0};
        if (part->section == NULL || ((part->section->takes & TAKES_THREADS) != 0) != is_second) {
            continue;
        }
        if (part->section->takes == OF_WHOLE_LENS && strcmp(question->lens.name, from_pipe) == 0) {
            part->text = lens_write(question->lens.lens, arena); /* a pipe is not read again */
            continue;
        }
        const struct embedded_command embedding = {command_find(text_of(part->section->command)),
                                                   part->words, part->word_count, &question->lens};
        if (!command_embed(&embedding, &run, &part->text, &error)) {
            part->failure = error.hint[0] == '\0'
                                ? report_word(error.message, arena)
                                : arena_printf(arena, "%s; %s", error.message, error.hint);
        }
    }
}

/* The positions of a lens without a choice: all of a few, else first, a middle one, last. */
static const char *usual_positions(const struct lens *lens, struct arena *arena)
{
    const size_t count = lens->position_count;
    if (count == 0) {
        return NULL;
    }
    if (count <= MOST_POSITIONS) {
        return "all";
    }
    return arena_printf(arena, "%s,%s,%s", lens->positions[0], lens->positions[count / 2],
                        lens->positions[count - 1]);
}

/* Which parts the page has, not yet answered. */
static bool report_plan(const struct report_input *input, struct arena *arena, struct page *page,
                        struct error *error)
{
    const struct lens *lens = input->question.lens.lens;
    const char *names =
        input->question.position != NULL ? input->question.position : usual_positions(lens, arena);
    const size_t *positions;
    size_t count;
    if (!lens_positions(lens, names, arena, &positions, &count, error)) {
        return false;
    }
    page->parts = ARENA_ARRAY(arena, count * (SECTIONS + 1), struct page_part);
    for (size_t i = 0; i < count; i++) {
        const char *name = lens->position_count > 0 ? lens->positions[positions[i]] : NULL;
        if (count > 1) {
            page->parts[page->count++].title = arena_printf(arena, "Position %s", name);
        }
        for (size_t k = 0; k < SECTIONS; k++) {
            if ((i == 0 || sections[k].takes != OF_WHOLE_LENS) &&
                (input->images || (sections[k].takes & IS_IMAGE) == 0)) {
                page->parts[page->count++] = report_part(input, &sections[k], name, arena);
            }
        }
    }
    return true;
}

static const struct file_type types[] = {{{"html", "page"}, ".html"}, {{"svg", "drawing"}, ".svg"}};

static const struct file_type *report_types(size_t i)
{
    return i < sizeof types / sizeof types[0] ? &types[i] : NULL;
}

static bool report_check(const struct artifact_job *job, struct error *error)
{
    const struct report_input *input = job->inputs[0];
    if (input->question.lens.lens == NULL) {
        fail(error, ERROR_USAGE, "no lens is given");
        return error_hint(error, "lenscalc report NAME, see 'lenscalc list lenses'");
    }
    const size_t fields = input->question.lens.lens->field_count;
    if (fields > FIELDS_SHOWN) {
        fail(error, ERROR_USAGE, "a report has room for %d fields, the lens has %zu", FIELDS_SHOWN,
             fields);
        return error_hint(error, "the analyses by themselves take any number of them");
    }
    return true;
}

static bool report_make(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct report_input *input = job->inputs[0];
    const struct lens *lens = input->question.lens.lens;
    struct arena *arena = job->run->arena;
    struct page page = {
        .title = lens->title != NULL ? lens->title : input->question.lens.name,
        .subtitle = arena_printf(arena, "%s%slenscalc %s", lens->source != NULL ? lens->source : "",
                                 lens->source != NULL ? ". " : "", LENSCALC_VERSION),
    };
    struct report_writer writer = {input, job->run, &page};
    struct parallel *parallel = ARENA_NEW(arena, struct parallel);
    if (!report_plan(input, arena, &page, error)) {
        return false;
    }
    parallel->threads = parallel_threads(input->threads);
    parallel_pieces(parallel, 2 * page.count, 1, report_answer, &writer);
    const bool done = watch_ask(job->run->watch) ||
                      fail(error, ERROR_DOMAIN, "interrupted: no report is written");
    if (done && job->type == &types[0]) {
        page_write_html(&page, sink);
    } else if (done) {
        page_write_svg(&page, arena, sink);
    }
    parallel_free(parallel);
    return done;
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(report_types), .check = report_check, .make = report_make},
};

static const struct example examples[] = {
    {"report double-gauss -o report.html", "a page for a browser"},
    {"report double-gauss -N 4 -o report.svg", "stopped down, as one drawing"},
    {NULL, NULL},
};

const struct command command_report = {
    .name = "report",
    .group = "analyses",
    .summary = "a lens and its analyses on one page",
    COMMAND_ASKS(struct report_input),
    COMMAND_MAKES(artifacts),
};
