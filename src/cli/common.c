/* cli/common.c - the options of every command. */
/* SPDX-License-Identifier: MIT */
#include "cli/command.h"

#include <string.h>

static const struct word unit_words[] = {
    {"metric", "millimetres, metres"},
    {"imperial", "feet and inches for distances"},
    {NULL, NULL},
};

/* In the order of formats[]. */
static const struct word format_words[] = {
    {"text", "aligned table with units"},
    {"csv", "comma-separated values"},
    {"tsv", "tab-separated values"},
    {"json", "one JSON object"},
    {"jsonl", "one JSON object a row"},
    {"markdown", "table for a document"},
    {"html", "page to print"},
    {NULL, NULL},
};

/* In the order of enum batch_format. */
static const struct word batch_format_words[] = {
    {"auto", "as the first line looks"},
    {"csv", "comma-separated values"},
    {"tsv", "tab-separated values"},
    {"jsonl", "one JSON object a row"},
    {NULL, NULL},
};

#define COMMON(member_name) OPTION(struct common, member_name)

const struct option common_options[] = {
    {COMMON(format), .name = "format", .value = "FORMAT", .words = format_words, .fallback = "text",
     .help = "how to print"},
    {COMMON(csv), .name = "csv", .help = "short for --format csv"},
    {COMMON(tsv), .name = "tsv", .help = "short for --format tsv"},
    {COMMON(json), .name = "json", .help = "short for --format json"},
    {COMMON(jsonl), .name = "jsonl", .help = "short for --format jsonl"},
    {COMMON(columns), .name = "columns", .value = "NAMES",
     .help = "print these columns; another unit behind the name converts: near_ft,far_m"},
    {COMMON(digits), .name = "digits", .value = "N", .lowest = 1, .highest = 17,
     .help = "significant digits (text: 4; machine formats: as many as read back the same)"},
    {COMMON(units), .name = "units", .value = "SYSTEM", .words = unit_words, .fallback = "metric",
     .help = "metric or imperial distances in text, markdown and html"},
    {COMMON(table), .name = "table", .value = "ROW,COL[:VALUE]",
     .help = "cross-table of two swept options; VALUE is a column, or two as near_m+far_m"},
    {COMMON(plot), .name = "plot", .value = "FILE.svg", .flags = OPTION_FILE,
     .help = "draw the results against the swept option"},
    {COMMON(explain), .name = "explain", .help = "print formulas, numbers put in, and sources"},
    {COMMON(nominal), .name = "nominal",
     .help = "f-numbers, times and ISO are labels of stop series: use their exact values"},
    {COMMON(batch), .name = "batch", .value = "FILE", .flags = OPTION_FILE,
     .help = "read inputs as rows from FILE, or from standard input with -"},
    {COMMON(batch_format), .name = "batch-format", .value = "FORMAT", .words = batch_format_words,
     .fallback = "auto", .help = "what the rows of --batch are"},
    {COMMON(fail_fast), .name = "fail-fast", .help = "stop at the first row that fails"},
    {COMMON(force), .name = "force",
     .help = "sweep even over more than a million rows; "
             "replace the file of fit --output"},
    {COMMON(output), .name = "output", .letter = 'o', .value = "FILE", .flags = OPTION_FILE,
     .help = "write to FILE, which appears only when it is complete"},
    {COMMON(lensdb), .name = "lensdb", .value = "DIR", .flags = OPTION_FILE,
     .help = "folder with your own data, searched first (also the variable LENSCALC_DB)"},
    {COMMON(agf), .name = "agf", .value = "FILES", .flags = OPTION_FILE,
     .help = "glass catalogues of your own in the AGF format, searched first"},
    {COMMON(lossy), .name = "lossy",
     .help = "leave out what a file of another program cannot keep, and list it on standard error"},
    {COMMON(help), .name = "help", .letter = 'h', .help = "show examples and options"},
};

const size_t common_option_count = sizeof common_options / sizeof common_options[0];

bool command_overrides(const struct command *command, const struct option *common)
{
    for (size_t i = 0; i < command->option_count; i++) {
        if (text_equal(text_of(command->options[i].name), common->name)) {
            return true;
        }
    }
    return false;
}

const struct command *command_find(struct text name)
{
    for (size_t i = 0; commands[i] != NULL; i++) {
        if (text_equal(name, commands[i]->name)) {
            return commands[i];
        }
    }
    return NULL;
}
