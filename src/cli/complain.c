/* cli/complain.c - errors and progress on standard error. */
/* SPDX-License-Identifier: MIT */
#include "cli/complain.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { PROGRESS_ROWS = 65536 };

void error_print(const struct error *error, const char *command)
{
    char place[400] = "";
    if (error->source[0] != '\0') {
        int used = snprintf(place, sizeof place, "%s:", error->source);
        if (error->line > 0) {
            used += snprintf(place + used, sizeof place - (size_t)used, "%ld:", error->line);
        }
        if (error->column > 0) {
            used += snprintf(place + used, sizeof place - (size_t)used, "%d:", error->column);
        }
        snprintf(place + used, sizeof place - (size_t)used, " ");
    }
    bool named = command != NULL && command[0] != '\0';
    fprintf(stderr, "lenscalc: %s%s%s%s\n", named ? command : "", named ? ": " : "", place,
            error->message);
    if (error->caret > 0) {
        fprintf(stderr, "    %s\n    %*s\n", error->text, error->caret, "^");
    }
    if (error->more != NULL) {
        fputs(error->more, stderr);
    }
    if (error->hint[0] != '\0') {
        fprintf(stderr, "    %s\n", error->hint);
    }
}

struct naming {
    const struct arguments *arguments;
    const struct batch *batch;
    struct called room;
};

/*
 * By what a quantity was given; where a message asks for one, by what it may be. A command's own
 * messages name options, "{--coc}": where a column of the batch sets it that is meant.
 */
static const char *given_by(void *context, struct text quantity, bool asked)
{
    struct naming *naming = context;
    const struct option *possible = NULL;
    bool is_option = quantity.length > 2 && quantity.start[0] == '-';
    struct text name = {quantity.start + 2, quantity.length - 2};
    if (is_option) {
        const struct argument *argument = arguments_find(naming->arguments, name);
        return argument != NULL ? batch_called(naming->batch, argument->option) : NULL;
    }
    for (size_t i = 0; i < naming->arguments->count; i++) {
        const struct argument *argument = &naming->arguments->all[i];
        if (!option_is_quantity(argument->option, quantity)) {
            continue;
        }
        const char *column = batch_called(naming->batch, argument->option);
        if (column != NULL) {
            return column;
        }
        if (argument->is_given || (asked && possible == NULL)) {
            possible = argument->option;
        }
    }
    return possible != NULL ? option_called(possible, &naming->room) : NULL;
}

void complain(struct error *error, const struct arguments *arguments, const struct batch *batch)
{
    error_name(error, given_by, &(struct naming){.arguments = arguments, .batch = batch});
    error_print(error, arguments->command->name);
}

void print_beside(const struct report *report, bool is_table)
{
    struct doubts *doubts = report->doubts;
    bool has_place = report->format == &format_json || report->format->is_for_people;
    if (report->explain != NULL && !has_place) {
        fprintf(stderr, "%s\n", report->explain);
    }
    if (has_place && !is_table) {
        return;
    }
    for (size_t i = 0; i < doubts->count; i++) {
        fprintf(stderr, "lenscalc: %s: warning: %s\n", report->command, doubts->texts[i]);
    }
    const char *more = doubts_left_out(doubts);
    if (more != NULL) {
        fprintf(stderr, "lenscalc: %s: warning: %s\n", report->command, more);
    }
}

double progress_now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void progress_show(double started, size_t rows, bool last)
{
    if (rows % PROGRESS_ROWS != 0 && !last) {
        return;
    }
    if (isatty(STDERR_FILENO) && !isatty(STDOUT_FILENO) && progress_now() - started > 0.5) {
        fprintf(stderr, "\r%zu rows%s", rows, last ? "\n" : "");
    }
}

void print_remark(const char *start, size_t length)
{
    if (length > 0) {
        fwrite(start, 1, length, stderr);
    }
}
