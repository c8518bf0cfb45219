/* cli/batch/batch.h - inputs from the rows of a file or pipe. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_BATCH_BATCH_H
#define LENSCALC_CLI_BATCH_BATCH_H

#include "base/number_short.h"
#include "cli/question/arguments.h"
#include "report/report.h"

/* What reading a bare number of a column takes, ready for use. */
struct batch_plain {
    double up, down[NUMBER_SHORT_DIGITS + 1]; /* a short number is mantissa x up / down[decimals] */
    struct number_scale scale;                /* of a longer number */
    double factor, lowest, highest;           /* between these it is legal without a closer look */
    size_t offset;                            /* of the value in the input */
    bool is_coc, is_focal;
    char behind; /* what ends the cell */
};

/* What to do with a column of the file. */
struct batch_column {
    const struct option *option;   /* null: passed through, or passed over */
    const struct option *doubtful; /* the option it would be if its end were a unit; or null */
    struct text typed_unit;        /* that end */
    size_t place;                  /* in the header line, 1-based */
    struct option as_read;         /* the option with the unit of the header */
    struct batch_plain plain;      /* but for what prepare_plain finds */
    bool is_plain;                 /* a number that needs no lensdb, no prefix */
    bool is_ignored;               /* neither input nor passed through */
    bool is_padding;               /* one more without a name, as spreadsheets add: all empty */
    bool is_infinite;              /* a JSON companion: true makes the option infinite */
    bool is_late;                  /* in JSON: the first object does not have it */
    struct text name;              /* as in the file */
    const char *tag;               /* the tag of photographs that it is; null: it is none */
    bool is_copy;         /* of a tag, by the camera's maker or another standard than Exif */
    bool zero_is_unknown; /* of a tag: 0 is no value */
    bool is_shared;       /* another column may have a value for the same option */
    bool has_decimals;    /* its cells may have decimal commas */
    struct text cell;     /* of a column that is shared: as it stood in row `filled` */
    long filled;          /* the row in which it had a value last; 0 = none */
    long row;             /* in JSON: the object in which it was seen last */
    size_t passed;        /* index among the columns passed through */
};

/* How fractions are written in a file whose cells are separated by ';'. */
enum decimals { DECIMALS_UNKNOWN, DECIMALS_COMMA, DECIMALS_POINT, DECIMALS_BOTH };

/* What --batch-format names; BATCH_AUTO sees it from the first line. */
enum batch_format { BATCH_AUTO, BATCH_CSV, BATCH_TSV, BATCH_JSONL };

struct photographs; /* see cli/batch/photographs.h */

/* The file while it is read. */
struct batch {
    const char *source; /* for messages */
    int descriptor;
    enum batch_format format;
    char separator;
    const struct reader *reader;
    struct arena *arena; /* of what stays as long as the batch: its columns */
    const struct arguments *arguments;
    const struct sheet *sheet;             /* of the rows that come of it */
    const struct command *const *commands; /* all there are: a column may be of another one */
    const void *constants;                 /* the input as options set it */
    size_t input_size;
    struct batch_column *columns;
    size_t column_count, column_room;
    struct batch_plain *plain; /* one a column, if rows of bare numbers can do; else null */
    struct text *passed_names; /* columns passed through */
    struct passed_cell *passed;
    size_t passed_count, passed_room;
    bool hands_late; /* in JSON: keys that the first object does not have are passed through too */
    char *buffer;
    size_t capacity;
    const char *at, *end; /* what is still to read */
    bool at_end;          /* the file has no more */
    /* called before the file may keep the program waiting: texts of earlier rows end here */
    bool (*before_read)(void *reader, struct error *error);
    void *waiting; /* its argument */
    long header_line;
    long line; /* of the present row */
    long next_line;
    long rows;                            /* read so far, other than by the short way */
    enum decimals decimals, row_decimals; /* of the good rows so far; and of the present one */
    bool is_photographs;                  /* exiftool wrote it: capitalised names are tags */
    bool is_array;  /* the objects are items of one array, over as many lines as they like */
    bool is_closed; /* and its end was seen */
    long objects;   /* of JSON, read so far */
    struct photographs *photographs; /* null: the rows are those of a table */
};

enum {
    BATCH_BLOCK = 262144,
    BATCH_BEHIND = 8, /* NULs behind the text stop any number */
};

/* Make room behind the unread characters, then read on. False at the end or on failure. */
bool batch_refill(struct batch *batch, struct error *error);

/* The next line that is neither blank nor a comment, without CR; a quoted cell may have breaks. */
bool batch_next_row(struct batch *batch, struct text *line, struct error *error);

/* The next item of a JSON array of objects, from brace to brace. */
bool batch_next_object(struct batch *batch, struct text *object, struct error *error);

/* How many lines a text spans beyond its first. */
long batch_breaks(struct text text);

enum batch_result { BATCH_ROW, BATCH_BAD_ROW, BATCH_END, BATCH_FAILED };

/*
 * Open the file and read its header; batch_settle says what comes of its columns.
 *
 * Given     batch  with reader, arena, arguments, sheet (as far as options choose it), commands and
 *                  constants (the input as the command line left it: the value of empty cells);
 *                  all else is 0
 *           path   "-" for standard input
 * Errors    ERROR_IO; ERROR_DATA with line and column: no header, a column twice, a unit that
 *           does not fit
 */
bool batch_open(struct batch *batch, const char *path, enum batch_format format,
                struct error *error);

/*
 * Decide what is passed through. Results of an earlier run in the same file are computed anew, and
 * do not count as goals where the row has all the settings.
 *
 * Given     sheet       of the rows, as options and columns choose it
 *           hands_late  keys that only later objects of JSON have are passed through too
 * Errors    ERROR_USAGE: a column that is also given as an option; ERROR_DATA: a wrong unit
 */
bool batch_settle(struct batch *batch, const struct sheet *sheet, bool hands_late,
                  struct error *error);

/* Of columns that the rows have themselves nothing is passed through: they are computed anew. */
void batch_ignore(struct batch *batch, const struct shown *shown, size_t count);

/*
 * Read the next row into the input.
 *
 * Result    BATCH_BAD_ROW: this row cannot be read, the next may; `error` says line and column.
 *           In JSON there may be more columns than before, passed through or not
 */
enum batch_result batch_next(struct batch *batch, void *input, struct error *error);

/* Are the rows those of the regular file that this descriptor has open? */
bool batch_is_file(const struct batch *batch, int descriptor);

/* How much of its file has been read, 0 to 1; NaN of a pipe. */
double batch_share(const struct batch *batch);

void batch_close(struct batch *batch);

/* Does a column of the file set this option? */
bool batch_has(const struct batch *batch, const char *option);

/* Has a row, of which this is the input, a value of its own for the option? */
bool batch_is_filled(const struct batch *batch, const struct option *option, const void *input);

/* How the column that sets this option of the command is called; null: there is none. */
const char *batch_called(const struct batch *batch, const struct option *option);

/* Is there a column that means something to the command? */
bool batch_knows_any(const struct batch *batch);

/* -------- internal to batch*.c -------- */

bool batch_add_column(struct batch *batch, struct text name, size_t at, struct error *error);
bool batch_settle_columns(struct batch *batch, struct error *error);
struct batch_column *batch_add_late(struct batch *batch, struct text name, struct error *error);

/* -------- cli/batch/batch_names.c -------- */

/* What a column of this name means to the command; of as_read only the unit behind the name. */
void batch_find_meaning(const struct batch *batch, struct text name, struct batch_column *column);

/* The option that a name without unit stands for: "f", "focal_length", "FocalLength" or "focal". */
const struct option *batch_option_of(const struct batch *batch, struct text name);

/* -------- cli/batch/batch_cell.c -------- */

/* No row has set the value of the option yet: it is what it is without one. */
void batch_reset_member(const struct batch *batch, const struct option *option, void *input);

/*
 * Read a cell, without blanks around it, into the member of its option. One that is empty, or says
 * that there is no value, leaves what options or another column of the row say.
 *
 * Errors    as option_read; another column of the same option has another value
 */
bool batch_read_cell(struct batch *batch, struct batch_column *column, struct text cell,
                     void *input, struct error *error);

/* Can cells of an option have fractions? Then these may be written with commas. */
bool batch_has_decimals(const struct option *option);

/* -------- cli/batch/batch_json.c -------- */

bool batch_json_header(struct batch *batch, struct text line, struct error *error);
bool batch_json_row(struct batch *batch, struct text line, void *input, struct error *error);

#endif
