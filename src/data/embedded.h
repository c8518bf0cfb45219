/* data/embedded.h - the files of lensdb inside the program. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_EMBEDDED_H
#define LENSCALC_DATA_EMBEDDED_H

#include <stddef.h>

struct embedded_file {
    const char *name; /* inside lensdb: "formats.tsv", "glass/SCHOTT.tsv" */
    const char *data; /* a NUL follows that does not count */
    size_t length;
    size_t rows; /* where the rows of a table begin, behind the line of names */
    long line;   /* the number of that line of names, 1-based */
};

/* Ends with a null name. Read only where a command looks: pages nobody asks for are not loaded. */
extern const struct embedded_file embedded_files[];

enum { EMBEDDED_KEY = 32 };

/* A row of a table of glasses: found by its name without looking through all of them. */
struct embedded_glass {
    char key[EMBEDDED_KEY]; /* the name in lower case without blanks, '-' and '_' */
    unsigned file;          /* in embedded_files */
    unsigned offset;        /* of the row */
    unsigned line;          /* 1-based */
};

/* By key, then in the order of the files. */
extern const struct embedded_glass embedded_glasses[];
extern const size_t embedded_glass_count;

#endif
