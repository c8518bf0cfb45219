/* report/table.h - what a row of results holds: columns as const descriptions of a struct. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_TABLE_H
#define LENSCALC_REPORT_TABLE_H

#include "base/quantity.h"

#include <stdbool.h>
#include <stddef.h>

enum column_type { COLUMN_NUMBER, COLUMN_INTEGER, COLUMN_FLAG, COLUMN_TEXT };

/*
 * The type of a column is the type of its member, so that table and struct cannot disagree.
 * A NaN number, an integer NO_INTEGER and a null text are absent.
 */
#define COLUMN_TYPE(S, member)                                                                     \
    _Generic(((S *)0)->member,                                                                     \
        double: COLUMN_NUMBER,                                                                     \
        long: COLUMN_INTEGER,                                                                      \
        bool: COLUMN_FLAG,                                                                         \
        const char *: COLUMN_TEXT)

#define COLUMN(S, member) .type = COLUMN_TYPE(S, member), .offset = offsetof(S, member)
/* One that is called as its member is. */
#define COLUMN_NAMED(S, member, more)                                                              \
    COLUMN(S, member), .name = #member, .label = #member, .flags = (more)

/* An entry of a table, where a macro stands for some. */
#define ENTRY(...)                                                                                 \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }

#define COLUMN_OF_LENGTH(S, member, in)                                                            \
    COLUMN(S, member), .dimension = &dimension_length, .unit = (in)
#define COLUMN_OF_ANGLE(S, member, in)                                                             \
    COLUMN(S, member), .dimension = &dimension_angle, .unit = (in)
#define COLUMN_OF_WAVELENGTH(S, member)                                                            \
    COLUMN(S, member), .dimension = &dimension_wavelength_um, .unit = "nm"

#define NO_INTEGER (-0x7fffffffL)

enum column_flag {
    COLUMN_ECHO = 1,     /* repeats an input: printed as typed, without padding zeros */
    COLUMN_INFINITE = 2, /* may be infinite: has a `_is_infinite` companion in JSON */
    COLUMN_BRIEF = 4,    /* belongs into the text table of several rows */
    COLUMN_ASSUMED = 8,  /* stands among the assumptions */
    COLUMN_EXTRA = 16,   /* only on request, by --columns or by the option in `with` */
    COLUMN_HIDDEN = 32,  /* not among what people read, unless asked for */
    COLUMN_SPARSE = 64,  /* left out of the table that people read where no row has it */
    COLUMN_NOTE = 128,   /* people read it below the table, each text once: a warning */
    COLUMN_TIED = 256,   /* no assumption without the option in `with` */
    COLUMN_PART = 1024,  /* people write it as 1/16 */
    COLUMN_SPAN = 2048,  /* of a time: one that passes, never 1/125 s */
    COLUMN_ADDED = 4096, /* repeats an option that the command has no column for: before its own */
    COLUMN_WITH = 512    /* as other columns, and among the brief ones with the option in `with` */
};

/*
 * What a number is in rows where it has another dimension, as lengths are angles in an image at
 * infinity. Such a column is declared once and printed as two, of which a row has one.
 */
struct column_form {
    const struct dimension *dimension;
    const char *unit;
    const char *help; /* what it is then, behind the help of the column */
};

#define COLUMN_OR(S, member, turns, form)                                                          \
    COLUMN(S, member), .other = (form), .turned = offsetof(S, turns)

/* One column. Numbers are in the program's own units in the row, in `unit` in the output. */
struct column {
    const char *name;                  /* without the unit: "near" */
    const char *unit;                  /* the unit of machine output: "m"; null = none */
    const struct dimension *dimension; /* null = plain number */
    enum column_type type;
    size_t offset;
    unsigned flags;
    const char *symbol;  /* in formulas: "s"; null = none */
    const char *label;   /* in words, for people: "near limit"; null = its name */
    const char *head;    /* in tables for people, unless --columns names them; null = name */
    const char *help;    /* one sentence */
    const char *with;    /* of an echo: the option it repeats; else the options that bring it */
    const char *repeats; /* the option that it repeats where it is given, if no echo; null = none */
    const char *tells;   /* an option whose rows it tells apart, in another form; null = none */
    const char *when;    /* it has a value, where options do not say that: "with several rows" */
    const char *depends; /* COLUMN_ASSUMED: the options it follows from, separated by blanks; one
                            with '+' before it makes it follow from all others when given */
    const struct column_form *other; /* of rows whose bool at `turned` is set; null: none */
    size_t turned;                   /* its offset */
    bool is_other;                   /* it is that form, in a sheet of sheet_spread */
    size_t condition;                /* offset of the number's condition (a double), 0 = none */
    int digits;                      /* significant digits for people, 0 = as usual */
};

/* The rows of one command. */
struct sheet {
    const struct column *columns;
    size_t column_count;
    size_t row_size;
};

/* The sheet of an array of columns over a struct. */
#define SHEET(columns_of, S)                                                                       \
    {                                                                                              \
        (columns_of), sizeof(columns_of) / sizeof(columns_of)[0], sizeof(S)                        \
    }

/* How a value was computed, for --explain. {symbol} stands for a column's symbol and value. */
struct explanation {
    /* The column it explains, without unit; "horizontal projection=equisolid" is for rows that say
       that there, "near film" for rows that have a film, "near !film" for those that have none,
       or no such column. */
    const char *column;
    const char *formula; /* "{H} = {f}^2/({N} {c}) + {f}" */
    const char *source;  /* [Key] equation or page; keys are in lenscalc.7 */
    const char *limits;  /* where it stops being true; null = nowhere */
};

#endif
