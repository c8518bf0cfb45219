/* cli/question/command.h - a command is a declaration and one function. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_COMMAND_H
#define LENSCALC_CLI_QUESTION_COMMAND_H

#include "base/watch.h"
#include "cli/options/option.h"
#include "cli/question/artifact.h"
#include "report/output.h"
#include "report/table.h"
#include "report/warnings.h"

#include <stdbool.h>
#include <stddef.h>

/* What `run` works with besides its input. */
struct run {
    struct arena *arena; /* reset after each input: rows may point into it */
    struct arena *kept;  /* until the end: for what `state` points to */
    void *state;         /* the command's own from one block to the next; null at first */
    struct lensdb *db;
    bool (*emit)(struct run *run, const void *row);
    void *driver; /* the driver's own */
    /* What is printed, where no more is made of the rows: run_shows; null: they are used whole. */
    const struct report *report;
    struct warnings *doubts; /* what is doubtful about the answer, see report/warnings.h; or null */
    struct report *leads;    /* of an answer that says first what it is, by report_lead; or null */
    const struct error
        *no_solver; /* why the solver that may be needed is missing; null: it is not */
    const struct arguments *arguments; /* that were typed */
    const struct part_file *parts; /* of a divided run that are merged, in order; null: none are */
    size_t part_count;
    int threads;            /* that may answer one input, this one included; 0 is 1 */
    bool explain;           /* an artifact says of itself how it was made, on standard error */
    struct watch *watch;    /* of work on one input that may be long, see base/watch.h; or null */
    struct error shortfall; /* set by a command whose rows stand, but are less than was asked: it is
                               printed beside them, and the question counts as failed */
};

/* Hand out one row; false when no more are wanted (then return true). */
static inline bool run_emit(struct run *run, const void *row)
{
    return run->emit(run, row);
}

/*
 * Is a member of the rows, by its offset, printed? What is not need not be computed: its row may
 * hold anything there.
 */
bool run_shows(const struct run *run, size_t offset);

/* What an answer weighs for which a thousand rays or fewer are traced, see `weight`. */
enum { ANSWER_BY_RAYS = 10 };

/* An example for --help and for the tests: what follows "lenscalc". */
struct example {
    const char *arguments, *help;
};

/* Inputs of a batch that are computed together, and their answers, one row each. */
struct block {
    const char *inputs;   /* count of input_size */
    size_t count;         /* 1 .. BLOCK_INPUTS */
    char *rows;           /* receives count of the sheet's row_size */
    struct error *errors; /* of each; code ERROR_NONE at first: only failures are set */
};

enum { BLOCK_INPUTS = 128 };

/* A question of another command: words behind its name, and the parts that answer it. */
struct again {
    const struct command *command;
    char **words;
    int count;
    const struct part_file *parts;
    size_t part_count;
};

struct command {
    const char *name;
    const char *group;              /* "photography" */
    const char *summary;            /* one line */
    const struct example *examples; /* ends with null */
    const char *no_operand;         /* of words that are none of its operands: how they are said */
    const struct option *options;
    size_t option_count;
    size_t input_size;
    struct sheet sheet;
    /* Which rows this input makes, where that depends on it; null: always `sheet`. */
    const struct sheet *(*choose_sheet)(const void *input, const struct option_query *asking);
    const struct sheet *const *sheets; /* all that it may choose; ends with null. Null: `sheet` */
    /* Does one input make several rows, as a list or a plan does? null: never. */
    bool (*makes_many)(const void *input);
    /* Has the option several values in one input, as a list of positions has? null: never. */
    bool (*varies)(const void *input, const char *option);
    /*
     * Does the input bring the columns of an option that is not given, as a lens whose fields lie
     * beside the y axis brings those of --field-x? null: never.
     */
    bool (*brings)(const void *input, const char *option);
    /*
     * Compute the rows of one input, handing each to run_emit. Null: the answer is an artifact, the
     * one of --output.
     *
     * Given     input  the command's struct, values in the program's own units; NaN = not given
     * Errors    whatever is refused; rows handed out before stay
     */
    bool (*run)(const void *input, struct run *run, struct error *error);
    /*
     * Compute many inputs of a batch at once, where that is faster than one by one: a filter. The
     * driver keeps their order, and has them computed at the latest before it waits for more.
     */
    void (*run_block)(const struct block *block, struct run *run);
    /* Does every input of this batch make one row? `input` as the options set it. */
    bool (*takes_blocks)(const void *input, const struct option_query *asking);
    /*
     * How many threads may answer at once: combinations of a sweep, when `run` is called by all of
     * them, and within one answer those that run.threads leaves. Null: one.
     */
    int (*threads)(const void *input);
    const struct explanation *explanations; /* ends with a null column */
    bool explains;                          /* artifacts do, by run.explain */
    /* Everything else that it makes, each with its option; --plot among them is its own. */
    const struct artifact *artifacts;
    size_t artifact_count;
    /* Columns, with or without their units: those to plot, separated by commas, further choices
       by '|'; and those in the cells of --table, without which it is refused. */
    const char *plot;
    const char *plot_titles; /* of these choices, '|' between; empty, null: the columns' labels */
    const char *cell;
    unsigned reads; /* enum reads: data that `run` uses beside what its options read */
    /* Combinations of a sweep that need no --force, where an answer takes so long that a million,
       as 0 means, would be a matter of days. */
    size_t most_answers;
    /*
     * How many rows of formulas an answer weighs in a sweep, of which a million need no --force:
     * the rows that it has, or ANSWER_BY_RAYS where rays are traced for it. Null: one.
     */
    double (*weight)(const void *input);
    /*
     * Its answer is that of another command, which finds what was worked out elsewhere in
     * run->parts. Given the input; the question lies in run->kept. Null: it answers itself.
     */
    bool (*again)(const void *input, struct run *run, struct again *question, struct error *error);
    /* The columns between which is what a plot fills, as what is sharp: "near far"; of one alone it
       is all above. Several such with '|' between; null: a plot fills nothing. */
    const char *zone;
    bool keeps_best; /* an interrupt ends its work on one input with the best so far, an answer that
                        run->shortfall marks as incomplete */
    bool is_divided; /* it makes parts, and takes them: see cli/question/division.h */
    /* When it runs in lenscalc-ceres, the program with the solver: always (""), with an option's
       word ("model=fitted"); null: never */
    const char *needs_ceres;
    /* What --stop-size says nothing without, as `wants` of an option has it; "": it never does, as
       rays are paraxial or chief rays; null: it always does, of a command that reads lenses */
    const char *stop_size_wants;
    /* Another question by the same name, asked with the flag that is its first option; or null. */
    const struct command *other;
};

/* What all command files have by the same names: `examples`, `options`, the struct they fill. */
#define COMMAND_ASKS(S)                                                                            \
    .examples = examples, .options = options, .option_count = sizeof options / sizeof options[0],  \
    .input_size = sizeof(S)

/* And that of a command whose rows are all alike: `columns` of a struct, `explanations`. */
#define COMMAND_ANSWERS(S) .sheet = SHEET(columns, S), .explanations = explanations

#define COMMAND_MAKES(list) .artifacts = list, .artifact_count = sizeof list / sizeof list[0]

/* The question of a command that the words of a command line ask. */
const struct command *command_asked(const struct command *command, int count, char *const *words);

/* The options of every command, and the struct they fill. */
struct common {
    bool explain, csv, tsv, json, jsonl, no_header, nominal, force, fail_fast, lossy, no_config;
    bool usage, help;
    const char *columns, *value, *output, *lensdb, *agf, *batch, *table, *plot, *kit;
    int format, batch_format, units, color;
    int terminal;                 /* enum terminal_graphics */
    int glass_numbers;            /* enum glass_numbers */
    int stop_size;                /* enum stop_size */
    int theme;                    /* enum palette_theme */
    const char *title, *subtitle; /* of pictures; null: their own */
    long digits;
};

/* Option i of a command: its own, those of its artifacts, of its other question; then null. */
const struct option *command_option(const struct command *command, size_t i);

/*
 * The common options that it has a use for and none of its own by their names, one after the other.
 *
 * Given     before  the one before; null: the first
 * Result    null behind the last
 */
const struct option *command_next_common(const struct command *command,
                                         const struct option *before);

/* "prints no rows": why a common option would do nothing; null: it does something. */
const char *command_has_no_use(const struct command *command, const struct option *common);

/* Is it of a drawing, as the first of its types says, whose words --title changes? */
bool option_draws(const struct option *option);

/* Does it take the defaults of the user's configuration? A tool does not, nor what asks again. */
bool command_has_defaults(const struct command *command);

/* Does it solve for what is not given, so that a value may be one too many? */
bool command_solves(const struct command *command);

/* For `makes_many`, of a command whose answers have several rows whatever is asked. */
bool command_always_many(const void *input);

/* The columns that --columns or --value names; null: neither does. */
static inline const char *common_columns(const struct common *common)
{
    return common->value != NULL ? common->value : common->columns;
}

struct format;

/* The output format that --format or one of its short forms asks for; two are refused. */
bool common_format(const struct common *common, bool has_format, const struct format **format,
                   struct error *error);

extern const struct option common_options[];
extern const size_t common_option_count;

#endif
