/* cli/command.h - a command is a declaration and one function. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_COMMAND_H
#define LENSCALC_CLI_COMMAND_H

#include "cli/option.h"
#include "report/output.h"
#include "draw/svg.h"
#include "report/table.h"

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
    bool force;   /* files may be replaced */
};

/* Hand out one row; false when no more are wanted (then return true). */
static inline bool run_emit(struct run *run, const void *row)
{
    return run->emit(run, row);
}

/* A drawing that an option asks for with a file name. */
struct drawing {
    const char *option; /* "scale" */
    size_t offset;      /* of the file name in the input struct */
    bool (*draw)(const void *input, struct svg *svg, struct error *error);
};

/* Which options a question has, on the command line or as columns of its batch. */
struct asking {
    bool (*given)(const void *asked, const char *option);
    const void *asked;
};

static inline bool asking_given(const struct asking *asking, const char *option)
{
    return asking->given(asking->asked, option);
}

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

struct command {
    const char *name;
    const char *group;              /* "photography" */
    const char *summary;            /* one line */
    const struct example *examples; /* ends with null */
    const struct option *options;
    size_t option_count;
    size_t input_size;
    struct sheet sheet;
    /* Which rows this input makes, where that depends on it; null: always `sheet`. */
    const struct sheet *(*choose_sheet)(const void *input, const struct asking *asking);
    /* Does one input make several rows, as a list or a plan does? null: never. */
    bool (*makes_many)(const void *input);
    /* Has the option several values in one input, as a list of positions has? null: never. */
    bool (*varies)(const void *input, const char *option);
    /*
     * Compute the rows of one input, handing each to run_emit.
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
    bool (*takes_blocks)(const void *input, const struct asking *asking);
    /* Instead of rows: write text (help, completion). */
    bool (*print)(const void *input, struct output *output, struct error *error);
    const struct explanation *explanations; /* ends with a null column */
    const struct drawing *drawings;         /* ends with a null option */
    size_t lens; /* offset of a struct photo_lens_question in the input; 0 = no --lens */
    /* --plot as a picture of its own, of all inputs of the sweep; null: columns are plotted. */
    bool (*picture)(const void *const *inputs, size_t count, struct svg *svg, struct error *error);
    const char *plot; /* columns to plot, separated by commas; further choices by '|' */
    const char *cell; /* columns in the cells of --table */
    bool needs_ceres; /* runs in lenscalc-ceres, the program with the solver */
};

/* What all command files have by the same names: `examples`, `options`, the struct they fill. */
#define COMMAND_ASKS(S)                                                                            \
    .examples = examples, .options = options, .option_count = sizeof options / sizeof options[0],  \
    .input_size = sizeof(S)

/* And that of a command whose rows are all alike: `columns` of a struct, `explanations`, `run`. */
#define COMMAND_ANSWERS(S) .sheet = SHEET(columns, S), .explanations = explanations, .run = run

/* All commands in the order of the manual; ends with null. */
extern const struct command *const commands[];

const struct command *command_find(struct text name);

/* The options of every command, and the struct they fill. */
struct common {
    bool explain, csv, tsv, json, jsonl, nominal, force, fail_fast, lossy, help;
    const char *columns, *output, *lensdb, *agf, *batch, *table, *plot;
    int format, batch_format, units;
    long digits;
};

/* Does the command have an option of its own in place of this common one? */
bool command_overrides(const struct command *command, const struct option *common);

extern const struct option common_options[];
extern const size_t common_option_count;

#endif
