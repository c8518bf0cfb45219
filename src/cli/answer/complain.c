/* cli/answer/complain.c - errors on standard error. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/complain.h"

#include "cli/question/configuration.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Standard error: what was said is written in one piece, and a failure to do so is nobody's. */
struct voice {
    struct output output;
    char buffer[OUTPUT_RESERVE];
};

static struct output *complain_begin(struct voice *voice, enum color_when color)
{
    voice->output = (struct output){
        .descriptor = STDERR_FILENO, .buffer = voice->buffer, .size = sizeof voice->buffer};
    voice->output.has_color = terminal_has_color(STDERR_FILENO, color);
    return &voice->output;
}

/* Lines from outside; what must not reach a terminal, or is no UTF-8, is '?'. */
static void voice_lines(struct output *output, const char *start, size_t length)
{
    for (size_t i = 0; i < length;) {
        const size_t whole = text_utf8_length(start + i, length - i);
        const size_t bad = start[i] == '\n' ? 0 : text_unprintable(start + i, length - i);
        if (bad > 0 || whole == 0) {
            output_character(output, '?');
        } else {
            output_text(output, start + i, whole);
        }
        i += whole > 0 ? whole : 1;
    }
}

static void voice_string(struct output *output, const char *string)
{
    voice_lines(output, string, strlen(string));
}

void error_print(const struct error *error, const char *command, enum color_when color)
{
    if (error->code == ERROR_PIPE) {
        return; /* as programs do that the signal ends: `| head` is no failure */
    }
    struct voice voice;
    struct output *output = complain_begin(&voice, color);
    bool named = command != NULL && command[0] != '\0';
    output_style(output, STYLE_ERROR);
    output_printf(output, "lenscalc:%s%s%s", named ? " " : "", named ? command : "",
                  named ? ":" : "");
    output_style(output, STYLE_PLAIN);
    output_character(output, ' ');
    if (error->source[0] != '\0') { /* "tessar.lens:7:12: " */
        voice_string(output, error->source);
        if (error->line > 0) {
            output_printf(output, ":%ld", error->line);
        }
        if (error->column > 0) {
            output_printf(output, ":%d", error->column);
        }
        output_string(output, ": ");
    }
    voice_string(output, error->message);
    output_character(output, '\n');
    if (error->caret > 0) {
        /* the text, and a caret under its wrong character */
        const size_t length = strlen(error->text), behind = (size_t)error->caret - 1;
        const struct text before = {error->text, behind < length ? behind : length};
        output_string(output, "    ");
        voice_string(output, error->text);
        output_string(output, "\n    ");
        output_spaces(output, text_cells(before));
        output_styled(output, STYLE_ERROR, "^");
        output_character(output, '\n');
    }
    if (error->more != NULL) {
        voice_string(output, error->more);
    }
    if (error->hint[0] != '\0') {
        output_string(output, "    ");
        voice_string(output, error->hint);
        output_character(output, '\n');
    }
    output_flush(output);
}

struct name_lookup {
    const struct arguments *arguments;
    const struct batch *batch;
    const void *input;
    struct called room;
};

/* The column that gave an option its value, or might have where no row is asked about. */
static const char *giving_column(const struct name_lookup *naming, const struct option *option)
{
    const char *called = batch_called(naming->batch, option);
    const bool gives = called != NULL && (naming->input == NULL ||
                                          batch_is_filled(naming->batch, option, naming->input));
    return gives ? called : NULL;
}

/*
 * By what a quantity was given; where a message asks for one, by what it may be. A command's own
 * messages name options, "{--coc}": where a column of the batch sets it that is meant.
 */
static const char *given_by(void *context, struct text quantity, bool asked)
{
    struct name_lookup *naming = context;
    const struct argument *possible = NULL;
    bool is_option = quantity.length > 2 && quantity.start[0] == '-';
    struct text name = {quantity.start + 2, quantity.length - 2};
    if (is_option) {
        const struct argument *argument = arguments_find(naming->arguments, name);
        const char *column = argument != NULL ? giving_column(naming, argument->option) : NULL;
        return column == NULL && argument != NULL ? argument->called : column;
    }
    for (size_t i = 0; i < naming->arguments->count; i++) {
        const struct argument *argument = &naming->arguments->all[i];
        if (!option_is_quantity(argument->option, quantity)) {
            continue;
        }
        const char *column = giving_column(naming, argument->option);
        if (column != NULL) {
            return column;
        }
        if (argument->is_given || (asked && possible == NULL)) {
            possible = argument;
        }
    }
    if (possible == NULL || possible->called != NULL) {
        return possible != NULL ? possible->called : NULL;
    }
    return option_called(possible->option, &naming->room);
}

void complain_name(struct error *error, const struct arguments *arguments,
                   const struct batch *batch, const void *input)
{
    error_name(error, given_by,
               &(struct name_lookup){.arguments = arguments, .batch = batch, .input = input});
}

void complain(struct error *error, const struct arguments *arguments, const struct batch *batch)
{
    struct arena arena = {0};
    const char *defaults = configuration_words(arguments, &arena);
    complain_name(error, arguments, batch, NULL);
    /* who reads what is wrong with a question may not think of what was not typed */
    if (defaults != NULL && error->more == NULL &&
        strcmp(error->source, arguments->defaults->source) != 0) {
        error->more =
            ARENA_JOIN(&arena, "    with defaults of ", defaults, "; --no-config takes none\n");
    }
    error_print(error, arguments->command->name, arguments->color);
    arena_free(&arena);
}

static void write_warning(struct output *output, const char *command, const char *text)
{
    output_printf(output, "lenscalc: %s: ", command);
    output_styled(output, STYLE_WARNING, "warning:");
    output_character(output, ' ');
    voice_string(output, text);
    output_character(output, '\n');
}

static void write_doubts(struct output *output, const struct report *report)
{
    struct warnings *doubts = report->doubts;
    for (size_t i = 0; i < doubts->count; i++) {
        write_warning(output, report->command, doubts->texts[i]);
    }
    const char *more = warnings_left_out(doubts);
    if (more != NULL) {
        write_warning(output, report->command, more);
    }
}

/* Columns that were asked for, and have no value in any row. */
static void write_absent(struct output *output, const struct report *report)
{
    for (size_t i = 0; i < report->shown_count; i++) {
        if (!report->has_value[i]) {
            output_printf(output, "lenscalc: %s: %s has no value here: %s\n", report->command,
                          report->shown[i].name, report_absence(report, report->shown[i].column));
        }
    }
}

/* A line, where there is something to say; `command` before it, or null. */
static void write_said(struct output *output, const char *command, const char *before,
                       const char *text)
{
    if (text != NULL) {
        if (command != NULL) {
            output_printf(output, "lenscalc: %s: ", command);
        }
        output_string(output, before);
        voice_string(output, text);
        output_character(output, '\n');
    }
}

void print_beside(const struct report *report, bool is_apart, enum color_when color)
{
    /* without rows there is neither a format nor an explanation */
    const struct format *format = report->format;
    const bool states = format != NULL && (format == &format_json || format->is_for_people);
    const bool has_place = format == NULL || states;
    const char *explain = has_place ? NULL : report->explain;
    size_t warnings = has_place && !is_apart ? 0 : report->doubts->count;
    const bool is_shown = format != NULL && format->is_for_people && !is_apart;
    const char *lead = is_shown ? NULL : report->title;
    const bool are_looked_at = report->are_named && report->has_good_row && !is_apart;
    const char *defaults = states ? NULL : report->defaults;
    if (explain == NULL && warnings == 0 && !are_looked_at && lead == NULL && defaults == NULL) {
        return; /* as most: the terminal is not even asked */
    }
    struct voice voice;
    struct output *output = complain_begin(&voice, color);
    write_said(output, report->command, "", lead);
    write_said(output, report->command, "defaults of ", defaults);
    write_said(output, NULL, "", explain);
    if (are_looked_at) {
        write_absent(output, report);
    }
    if (warnings > 0) {
        write_doubts(output, report);
    }
    output_flush(output);
}

void print_remark(const char *start, size_t length)
{
    struct voice voice;
    if (length == 0) {
        return;
    }
    struct output *output = complain_begin(&voice, COLOR_NEVER);
    voice_lines(output, start, length);
    output_flush(output);
}
