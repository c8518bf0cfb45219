/* file/embedded.h - the files of lensdb inside the program. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_EMBEDDED_H
#define LENSCALC_FILE_EMBEDDED_H

#include <stddef.h>

struct embedded_file {
    const char *name; /* without folder: "formats.tsv" */
    const char *data; /* a NUL follows that does not count */
    size_t length;
};

/* Ends with a null name. Read only where a command looks: pages nobody asks for are not loaded. */
extern const struct embedded_file embedded_files[];

#endif
