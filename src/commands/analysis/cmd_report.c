/* commands/analysis/cmd_report.c - lenscalc report: all about a lens on one page. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "base/parallel.h"
#include "cli/answer/driver.h"
#include "commands/analysis/report_page.h"
#include "commands/commands.h"
#include "commands/lens/lens_options.h"
#include "file/lens_file.h"
#include "report/version.h"

#include <string.h>

struct report_input {
    struct lens_question question;
    bool images;
    long threads; /* 0 = one a core */
};

static const struct option options[] = {
    LENS_OPTION(struct report_input, question),
    LENS_FNUMBER_OPTION(struct report_input, question),
    {OPTION(struct report_input, question.position), .name = "position", .value = "NAME",
     .help = "a name or focal length (135mm), a list, or all; default up to three of them"},
    {OPTION(struct report_input, images), .name = "images",
     .help = "images of points too (psf), which take longer than all the rest"},
    {OPTION(struct report_input, threads), .name = "threads", .lowest = 0, .highest = PARALLEL_MOST,
     .value = "N", .fallback = "1",
     .help = "threads that share the fields of an analysis; 0 = one a core"},
};

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
enum {
    SECTIONS = sizeof sections / sizeof sections[0],
    MOST_WORDS = 10,
    MOST_POSITIONS = 3,
    FIELDS_SHOWN = 100
};

/* A page in the making. */
struct report_writer {
    const struct report_input *input;
    struct run *run;
    struct page_part *parts;
    size_t count;
};

/* What a lens is called that was read from there. */
static const char from_pipe[] = "standard input";

/* A word as a shell reads it: between quotes of one stroke, which stand as '\'' themselves. */
static const char *quoted(const char *word, struct arena *arena)
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
        line = arena_printf(arena, "%s %s", line, quoted(said, arena));
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

/* Ask one of the commands, and keep what it says or why it cannot. */
static void report_add_part(struct report_writer *writer, const struct report_section *part,
                            const char *position)
{
    struct arena *arena = writer->run->arena;
    const struct lens_question *question = &writer->input->question;
    struct page_part *page = &writer->parts[writer->count++];
    struct error error = {0};
    char *words[MOST_WORDS];
    size_t count = 0;
    words[count++] = report_word(question->lens.name, arena);
    if (!isnan(question->fnumber) && (part->takes & TAKES_FNUMBER) != 0) {
        words[count++] = report_word("-N", arena);
        words[count++] = number_word(question->fnumber, arena);
    }
    if (position != NULL && (part->takes & TAKES_POSITION) != 0) {
        words[count++] = report_word("--position", arena);
        words[count++] = report_word(position, arena);
    }
    if (part->drawing != NULL) {
        words[count++] = report_word(part->drawing, arena);
        /* it stays in memory, but this is how it would be called */
        words[count++] = report_word(arena_printf(arena, "%s.svg", part->command), arena);
    }
    *page = (struct page_part){.title = part->title,
                               .command = command_line(part, words, count, arena),
                               .is_drawing = part->is_drawing};
    if (writer->input->threads != 1 && (part->takes & TAKES_THREADS) != 0) {
        words[count++] = report_word("--threads", arena); /* which change nothing that is shown */
        words[count++] = number_word((double)writer->input->threads, arena);
    }
    if (part->takes == OF_WHOLE_LENS && strcmp(question->lens.name, from_pipe) == 0) {
        page->text = lens_write(question->lens.lens, arena); /* a pipe is not read again */
        return;
    }
    const struct embedded_command embedding = {command_find(text_of(part->command)), words, count,
                                               &question->lens};
    if (!command_embed(&embedding, writer->run, &page->text, &error)) {
        page->failure = error.hint[0] == '\0'
                            ? report_word(error.message, arena)
                            : arena_printf(arena, "%s; %s", error.message, error.hint);
        page->text = (struct text){NULL, 0};
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

static bool fill_page(struct report_writer *writer, struct page *page, struct error *error)
{
    struct arena *arena = writer->run->arena;
    const struct lens_question *question = &writer->input->question;
    const struct lens *lens = question->lens.lens;
    const char *names =
        question->position != NULL ? question->position : usual_positions(lens, arena);
    const size_t *positions;
    size_t count;
    if (!lens_positions(lens, names, arena, &positions, &count, error)) {
        return false;
    }
    writer->parts = ARENA_ARRAY(arena, count * (SECTIONS + 1), struct page_part);
    for (size_t i = 0; i < count; i++) {
        const char *name = lens->position_count > 0 ? lens->positions[positions[i]] : NULL;
        if (count > 1) {
            writer->parts[writer->count++] =
                (struct page_part){.title = arena_printf(arena, "Position %s", name)};
        }
        for (size_t k = 0; k < SECTIONS; k++) {
            if ((i == 0 || sections[k].takes != OF_WHOLE_LENS) &&
                (writer->input->images || (sections[k].takes & IS_IMAGE) == 0)) {
                report_add_part(writer, &sections[k], name);
            }
            if (!watch_ask(writer->run->watch)) {
                return fail(error, ERROR_DOMAIN, "interrupted: no report is written");
            }
        }
    }
    page->parts = writer->parts;
    page->count = writer->count;
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
    struct report_writer writer = {.input = job->inputs[0], .run = job->run};
    const struct lens *lens = writer.input->question.lens.lens;
    struct arena *arena = job->run->arena;
    struct page page = {
        .title = lens->title != NULL ? lens->title : writer.input->question.lens.name,
        .subtitle = arena_printf(arena, "%s%slenscalc %s", lens->source != NULL ? lens->source : "",
                                 lens->source != NULL ? ". " : "", LENSCALC_VERSION),
    };
    if (!fill_page(&writer, &page, error)) {
        return false;
    }
    if (job->type == &types[0]) {
        page_write_html(&page, sink);
    } else {
        page_write_svg(&page, arena, sink);
    }
    return true;
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
