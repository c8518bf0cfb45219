/* commands/analysis/cmd_report.c - lenscalc report: all about a lens on one page. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "base/parallel.h"
#include "commands/analysis/report_page.h"
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
     .help = "add point spread functions (psf), which take longer than all the rest"},
    {OPTION(struct report_input, threads), .name = "threads", .lowest = 0, .highest = PARALLEL_MOST,
     .value = "N", .fallback = "0",
     .help = "threads that share the analyses and their fields; 0 = one per core"},
};

/* -------- the page -------- */

enum { MOST_WORDS = 10 };

/* What a part of the page is asked. */
struct report_query {
    const struct report_section *section; /* null: it is a heading */
    char *words[MOST_WORDS];
    size_t word_count;
};

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
static struct report_query report_query(const struct report_input *input,
                                        const struct report_section *section, const char *position,
                                        struct arena *arena, const char **command)
{
    const struct lens_question *question = &input->question;
    struct report_query query = {.section = section};
    char **words = query.words;
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
    *command = command_line(section, words, count, arena);
    if (input->threads != 1 && (section->takes & TAKES_THREADS) != 0) {
        /* which change nothing that is shown: for when other parts are done before */
        words[count++] = report_word("--threads", arena);
        words[count++] = number_word((double)input->threads, arena);
    }
    query.word_count = count;
    return query;
}

struct report_writer {
    const struct report_input *input;
    const struct run *run;
    struct page *page;
    struct report_query *queries; /* one a part */
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
        const size_t k = i % writer->page->count;
        const struct report_query *query = &writer->queries[k];
        struct page_part *part = &writer->page->parts[k];
        const bool is_second = i >= writer->page->count;
        if (query->section == NULL || ((query->section->takes & TAKES_THREADS) != 0) != is_second) {
            continue;
        }
        if (query->section->takes == OF_WHOLE_LENS && strcmp(question->lens.name, from_pipe) == 0) {
            part->text = lens_write(question->lens.lens, arena); /* a pipe is not read again */
            continue;
        }
        page_ask(&(struct page_question){query->section->command, query->words, query->word_count,
                                         &question->lens, 1},
                 &run, part);
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
static bool report_plan(const struct report_input *input, struct arena *arena,
                        struct report_writer *writer, struct error *error)
{
    struct page *page = writer->page;
    const struct lens *lens = input->question.lens.lens;
    const char *names =
        input->question.position != NULL ? input->question.position : usual_positions(lens, arena);
    const size_t *positions;
    size_t count;
    if (!lens_positions(lens, names, arena, &positions, &count, error)) {
        return false;
    }
    page->parts = ARENA_ARRAY(arena, count * (SECTIONS + 1), struct page_part);
    writer->queries = ARENA_ARRAY(arena, count * (SECTIONS + 1), struct report_query);
    for (size_t i = 0; i < count; i++) {
        const char *name = lens->position_count > 0 ? lens->positions[positions[i]] : NULL;
        if (count > 1) {
            page->parts[page->count++] = (struct page_part){
                .title = arena_printf(arena, "Position %s", name), .is_heading = true};
        }
        for (size_t k = 0; k < SECTIONS; k++) {
            if ((i == 0 || sections[k].takes != OF_WHOLE_LENS) &&
                (input->images || (sections[k].takes & IS_IMAGE) == 0)) {
                struct page_part *part = &page->parts[page->count];
                *part = (struct page_part){.title = sections[k].title,
                                           .is_drawing = sections[k].is_drawing};
                writer->queries[page->count++] =
                    report_query(input, &sections[k], name, arena, &part->command);
            }
        }
    }
    return true;
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
    struct report_writer writer = {.input = input, .run = job->run, .page = &page};
    struct parallel *parallel = ARENA_NEW(arena, struct parallel);
    if (!report_plan(input, arena, &writer, error)) {
        return false;
    }
    parallel->threads = parallel_threads(input->threads);
    parallel_pieces(parallel, 2 * page.count, 1, report_answer, &writer);
    const bool done = watch_ask(job->run->watch) ||
                      fail(error, ERROR_DOMAIN, "interrupted: no report is written");
    if (done) {
        page_write(&page, job, sink);
    }
    parallel_free(parallel);
    return done;
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(page_types), .check = report_check, .make = report_make},
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
