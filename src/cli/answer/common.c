/* cli/answer/common.c - the options of every command. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"
#include "cli/question/command.h"
#include "cli/question/showing.h"
#include "report/report.h"
#include "report/terminal.h"
#include "report/terminal_query.h"

#include <string.h>

static const struct word unit_words[] = {
    {"metric", "millimetres, metres"},
    {"imperial", "feet and inches for distances"},
    {NULL, NULL},
};

static const struct word *batch_format_word(size_t i)
{
    static const struct word automatic = {"auto", "judged by the first line"};
    static const struct word *const words[] = {[BATCH_AUTO] = &automatic,
                                               [BATCH_CSV] = &format_csv.word,
                                               [BATCH_TSV] = &format_tsv.word,
                                               [BATCH_JSONL] = &format_jsonl.word};
    return i < sizeof words / sizeof words[0] ? words[i] : NULL;
}

/* By enum palette_theme. */
static const struct word theme_words[] = {
    {"light", "dark lines on a white page"},
    {"dark", "light lines on a dark page"},
    {"print", "for paper, and distinct without colours, too"},
    {NULL, NULL},
};

#define COMMON(member_name) OPTION(struct common, member_name)

/* By enum glass_numbers. */
static const struct word glass_numbers_words[] = {
    {"file", "as the program that wrote the file does"},
    {"line", "the indices"},
    {"catalog", "the glass of the catalogue"},
    {NULL, NULL},
};

/* By enum stop_size. */
static const struct word stop_size_words[] = {
    {"lens", "as the file says: paraxial, unless its aperture has the word real"},
    {"paraxial", "the paraxial marginal ray"},
    {"real", "the exact marginal ray at the primary wavelength, as in other programs"},
    {NULL, NULL},
};

const struct option common_options[] = {
    {COMMON(format), .name = "format", .value = "FORMAT", .word_at = format_word,
     .fallback = "text", .help = "output format"},
    {COMMON(csv), .name = "csv", .help = "short for --format csv"},
    {COMMON(tsv), .name = "tsv", .help = "short for --format tsv"},
    {COMMON(json), .name = "json", .help = "short for --format json"},
    {COMMON(jsonl), .name = "jsonl", .help = "short for --format jsonl"},
    {COMMON(columns), .name = "columns", .value = "NAMES",
     .help = "print these columns ('?' lists them); a unit after the name converts: near_ft"},
    {COMMON(value), .name = "value", .value = "COLUMN",
     .excludes = "format csv tsv json jsonl columns table no-header", .why = "a value stands bare",
     .help = "print only the values of this column, without name or unit, for $(...)"},
    {COMMON(no_header), .name = "no-header", .help = "omit the header line of csv and tsv"},
    {COMMON(digits), .name = "digits", .value = "N", .lowest = 1, .highest = 17,
     .help = "significant digits (text: 4; machine formats: the fewest that read back exactly)"},
    {COMMON(units), .name = "units", .value = "SYSTEM", .words = unit_words, .fallback = "metric",
     .help = "metric or imperial distances in text, markdown, latex and html"},
    {COMMON(table), .name = "table", .value = "ROW,COL[:VALUE]",
     .help = "cross-table of two swept options; VALUE is a column, or two as near_m+far_m"},
    {COMMON(plot), .name = "plot", .value = "FILE", .flags = OPTION_FILE, .types = drawing_types,
     .help = "draw the results against the swept option; term: on the terminal"},
    {COMMON(theme), .name = "theme", .value = "THEME", .flags = OPTION_ASIDE, .words = theme_words,
     .fallback = "light", .help = "colours of drawings"},
    {COMMON(title), .name = "title", .value = "TEXT", .flags = OPTION_ASIDE | OPTION_EMPTY,
     .help = "title of the drawing in place of its own; an empty one leaves it out"},
    {COMMON(subtitle), .name = "subtitle", .value = "TEXT", .flags = OPTION_ASIDE | OPTION_EMPTY,
     .help = "subtitle of the drawing in place of its own"},
    {COMMON(explain), .name = "explain", .flags = OPTION_ASIDE,
     .help = "print formulas, with the numbers substituted, and sources"},
    {COMMON(nominal), .name = "nominal",
     .help = "take f-numbers, times and ISO as labels of a stop series: use their exact values"},
    {COMMON(batch), .name = "batch", .value = "FILE", .flags = OPTION_FILE,
     .help = "read inputs as rows from FILE, or from standard input with -; an option fills the "
             "empty cells of its column"},
    {COMMON(batch_format), .name = "batch-format", .value = "FORMAT", .word_at = batch_format_word,
     .fallback = "auto", .help = "format of the rows of --batch"},
    {COMMON(fail_fast), .name = "fail-fast", .help = "stop at the first row that fails"},
    {COMMON(force), .name = "force", .flags = OPTION_ASIDE,
     .help = "allow sweeps of very many rows; overwrite inputs, and results of fits and searches"},
    {COMMON(output), .name = "output", .letter = 'o', .value = "FILE",
     .flags = OPTION_FILE | OPTION_ASIDE,
     .help = "write to FILE, which appears only when it is complete"},
    {COMMON(lensdb), .name = "lensdb", .value = "DIR", .flags = OPTION_FILE,
     .help = "folder with your own data, searched first (also the variable LENSCALC_DB)"},
    {COMMON(agf), .name = "agf", .value = "FILES", .flags = OPTION_FILE | OPTION_SEVERAL,
     .help = "glass catalogues of your own in the AGF format, searched first; may be "
             "repeated"},
    {COMMON(lossy), .name = "lossy",
     .help =
         "drop what cannot be carried over between file formats, and list it on standard error"},
    {COMMON(glass_numbers), .name = "glass-numbers", .value = "WHICH", .words = glass_numbers_words,
     .fallback = "file",
     .help = "which to use where a lens file has indices beside the name of a glass and the two "
             "differ"},
    {COMMON(stop_size), .name = "stop-size", .value = "RAY", .words = stop_size_words,
     .fallback = "lens",
     .help = "marginal ray by which the aperture (f-number, pupil, numerical aperture) determines "
             "the size of the stop"},
    {COMMON(kit), .name = "kit", .letter = 'K', .value = "NAME",
     .flags = OPTION_SEVERAL | OPTION_ASIDE, .excludes = "no-config",
     .help = "options of a section [kit NAME] of the configuration; several with commas, or "
             "repeated"},
    {COMMON(no_config), .name = "no-config", .flags = OPTION_ASIDE,
     .help = "take no defaults from the configuration (also an empty variable LENSCALC_CONFIG)"},
    {COMMON(color), .name = "color", .value = "WHEN", .flags = OPTION_ASIDE, .words = color_words,
     .fallback = "auto", .help = "colour table heads, warnings and errors"},
    {COMMON(terminal), .name = "terminal", .value = "GRAPHICS", .flags = OPTION_ASIDE,
     .words = graphics_words, .fallback = "auto",
     .help = "how a drawing or picture is shown whose file is called term, as --plot term"},
    {COMMON(usage), .name = "usage", .letter = 'h', .flags = OPTION_ASIDE,
     .help = "show examples and the command's own options, one line each"},
    {COMMON(help), .name = "help", .flags = OPTION_ASIDE,
     .help = "show examples and all options in full"},
};

const size_t common_option_count = sizeof common_options / sizeof common_options[0];

const struct option *command_option(const struct command *command, size_t i)
{
    if (i < command->option_count) {
        return &command->options[i];
    }
    i -= command->option_count;
    if (i < command->artifact_count) {
        return &command->artifacts[i].option;
    }
    i -= command->artifact_count;
    return command->other != NULL && i < command->other->option_count ? &command->other->options[i]
                                                                      : NULL;
}

const struct command *command_asked(const struct command *command, int count, char *const *words)
{
    const struct command *other = command->other;
    for (int i = 0; other != NULL && i < count && strcmp(words[i], "--") != 0; i++) {
        if (strncmp(words[i], "--", 2) == 0 && strcmp(words[i] + 2, other->options[0].name) == 0) {
            return other;
        }
    }
    return command;
}

bool command_always_many(const void *input)
{
    (void)input;
    return true;
}

/* -------- which common options a command has a use for -------- */

static bool common_has_rows(const struct command *command)
{
    return command->run != NULL;
}

/* How many options may have several values that the same columns answer? */
static size_t count_varying(const struct command *command, bool numbers)
{
    size_t count = 0;
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        bool other = option->kind->is_list && option->kind != &kind_choice;
        count += option->kind->number_of != NULL ||
                 (!numbers && (other || (option->flags & OPTION_MANY) != 0));
    }
    return count;
}

static bool takes_many(const struct command *command)
{
    return common_has_rows(command) && count_varying(command, false) > 0;
}

static bool takes_two(const struct command *command)
{
    return common_has_rows(command) && count_varying(command, false) > 1 &&
           command->makes_many != command_always_many;
}

static bool has_curves(const struct command *command)
{
    return common_has_rows(command) && count_varying(command, true) > 0 &&
           command->makes_many != command_always_many;
}

bool option_draws(const struct option *option)
{
    return option->types != NULL && file_type_of(option->types, text_of("x.svg")) != NULL;
}

/* Does it make drawings of any kind? */
static bool has_drawings(const struct command *command)
{
    bool found = has_curves(command);
    for (size_t i = 0; i < command->artifact_count && !found; i++) {
        found = option_draws(&command->artifacts[i].option);
    }
    return found;
}

/* Drawings, or pictures. */
static bool shows_something(const struct command *command)
{
    bool found = has_drawings(command);
    for (size_t i = 0; i < command->artifact_count && !found; i++) {
        found = showing_is_possible(command->artifacts[i].option.types);
    }
    return found;
}

static bool is_in_metres(const struct dimension *dimension, const char *unit)
{
    return dimension == &dimension_length && unit != NULL && strcmp(unit, "m") == 0;
}

/* Where there are several sheets one of them repeats what is asked for. */
static bool has_distances(const struct command *command)
{
    bool found = false;
    for (size_t i = 0; i < command->sheet.column_count && !found; i++) {
        const struct column *column = &command->sheet.columns[i];
        found = is_in_metres(column->dimension, column->unit);
    }
    for (size_t i = 0; i < command->option_count && !found; i++) {
        const struct option *option = &command->options[i];
        found = command->choose_sheet != NULL && is_in_metres(option->dimension, option->unit);
    }
    return found;
}

static bool has_formulas(const struct command *command)
{
    return command->explanations != NULL || command->explains;
}

static bool has_series(const struct command *command)
{
    bool found = false;
    for (size_t i = 0; i < command->option_count && !found; i++) {
        found = option_has_series(&command->options[i]);
    }
    return found;
}

/* Does an answer depend on such data? */
static bool common_reads(const struct command *command, unsigned data)
{
    unsigned found = command->reads;
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        bool named = option->dimension == &dimension_wavelength;
        found |= option->kind->reads | (named ? READS_LENSDB : 0);
    }
    return (found & data) != 0 || (data == READS_LENSDB && has_series(command));
}

/* More rows than usual, or a file that is also read. */
static bool is_forced(const struct command *command)
{
    bool found =
        takes_many(command) || command->again != NULL || common_reads(command, READS_GLASSES);
    for (size_t i = 0; i < command->option_count && !found; i++) {
        found = (command->options[i].flags & OPTION_FILE) != 0;
    }
    return found;
}

/* Rays that fill the stop of a lens, whose size matters. */
static bool fills_stop(const struct command *command)
{
    const char *wants = command->stop_size_wants;
    return (wants == NULL || wants[0] != '\0') && common_reads(command, READS_LENSES);
}

bool command_has_defaults(const struct command *command)
{
    return command->again == NULL && strcmp(command->group, "tool") != 0;
}

bool command_solves(const struct command *command)
{
    return strcmp(command->group, "photography") == 0 ||
           strcmp(command->group, "one surface, one lens") == 0 ||
           strcmp(command->group, "a lens") == 0;
}

/* What a command must have for an option to do anything, and what is said where it has not. */
static const struct {
    const char *option;
    bool (*is_used)(const struct command *command); /* null: as it depends on such data */
    const char *why_not;
    unsigned data;
} uses[] = {
    {"format", common_has_rows, "prints no rows", 0},
    {"csv", common_has_rows, "prints no rows", 0},
    {"tsv", common_has_rows, "prints no rows", 0},
    {"json", common_has_rows, "prints no rows", 0},
    {"jsonl", common_has_rows, "prints no rows", 0},
    {"columns", common_has_rows, "prints no rows", 0},
    {"value", common_has_rows, "prints no rows", 0},
    {"no-header", common_has_rows, "prints no rows", 0},
    {"digits", common_has_rows, "prints no rows", 0},
    {"units", has_distances, "prints no distances in metres", 0},
    {"table", takes_two, "has no value for each pair of two swept options", 0},
    {"plot", has_curves, "has no value for each value of a swept option", 0},
    {"theme", has_drawings, "draws no picture of its own", 0},
    {"title", has_drawings, "draws no picture of its own", 0},
    {"subtitle", has_drawings, "draws no picture of its own", 0},
    {"explain", has_formulas, "has no formulas to show", 0},
    {"terminal", shows_something, "draws nothing", 0},
    {"nominal", has_series, "takes no f-number, time or ISO", 0},
    {"batch", takes_many, "reads no rows", 0},
    {"batch-format", takes_many, "reads no rows", 0},
    {"fail-fast", takes_many, "answers one question", 0},
    {"force", is_forced, "has nothing to force", 0},
    {"lensdb", NULL, "uses no data of lensdb", READS_LENSDB},
    {"agf", NULL, "uses no glasses", READS_GLASSES},
    {"lossy", NULL, "reads no lenses", READS_LENSES},
    {"glass-numbers", NULL, "reads no lenses", READS_LENSES},
    {"kit", command_has_defaults, "takes no defaults", 0},
    {"no-config", command_has_defaults, "takes no defaults", 0},
    {"stop-size", fills_stop, "traces no rays that fill the stop", 0},
};

/* Most names differ in their first letter: every start compares some hundreds of them. */
static bool common_is_same(const char *name, const char *other)
{
    return name[0] == other[0] && strcmp(name, other) == 0;
}

static bool overrides(const struct command *command, const struct option *common)
{
    const struct option *own;
    for (size_t i = 0; (own = command_option(command, i)) != NULL; i++) {
        if (common_is_same(own->name, common->name)) {
            return true;
        }
    }
    return false;
}

const char *command_has_no_use(const struct command *command, const struct option *common)
{
    enum { COUNT = sizeof uses / sizeof uses[0] };
    size_t i = 0;
    while (i < COUNT && !common_is_same(uses[i].option, common->name)) {
        i++;
    }
    if (i == COUNT) {
        return NULL;
    }
    const bool is_used =
        uses[i].is_used != NULL ? uses[i].is_used(command) : common_reads(command, uses[i].data);
    return is_used ? NULL : uses[i].why_not;
}

const struct option *command_next_common(const struct command *command, const struct option *before)
{
    const struct option *end = common_options + common_option_count;
    const struct option *option = before == NULL ? common_options : before + 1;
    while (option < end &&
           (overrides(command, option) || command_has_no_use(command, option) != NULL)) {
        option++;
    }
    return option < end ? option : NULL;
}

bool common_format(const struct common *common, bool has_format, const struct format **format,
                   struct error *error)
{
    int given = has_format;
    *format = formats[common->format];
    for (size_t i = 0; formats[i] != NULL; i++) {
        /* formats have options of their names: --csv is short for --format csv */
        size_t k = 0;
        while (k < common_option_count &&
               strcmp(common_options[k].name, formats[i]->word.word) != 0) {
            k++;
        }
        if (k < common_option_count &&
            *(const bool *)((const char *)common + common_options[k].offset)) {
            *format = formats[i];
            given++;
        }
    }
    if (given > 1) {
        return fail(error, ERROR_USAGE, "more than one output format is given");
    }
    if (common->value != NULL && given == 0) {
        *format = &format_value;
    }
    return !common->no_header || (*format)->separator != '\0' || common->value != NULL ||
           fail(error, ERROR_USAGE, "--no-header needs --csv or --tsv");
}
