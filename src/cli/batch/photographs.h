/* cli/batch/photographs.h - photographs as rows of a batch. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_BATCH_PHOTOGRAPHS_H
#define LENSCALC_CLI_BATCH_PHOTOGRAPHS_H

#include "cli/batch/batch.h"

/* Names of files. */
struct paths {
    const char **all;
    size_t count;
};

/*
 * Which photographs the words ask about: operands, or the file of --batch and operands behind it,
 * as --batch *.jpg has them. None: its count is 0.
 *
 * Errors    ERROR_USAGE: photographs beside the rows of a table
 */
bool photographs_find(const struct arguments *arguments, const struct common *common,
                      struct paths *paths, struct arena *arena, struct error *error);

/*
 * What photographs say of their camera and its settings: by exiftool if it is installed, which also
 * reads raw files and makers' notes, else the plain Exif data of JPEG and TIFF files. They become
 * the columns of the batch, so far as its command has options for them and a file has a value.
 *
 * Given     batch  as for batch_open
 *           paths  1 or more
 * Errors    ERROR_IO: exiftool does not start though it is there. A file that cannot be read is a
 *           bad row
 */
bool photographs_open(struct batch *batch, const struct paths *paths, struct error *error);

/* As batch_next. */
enum batch_result photographs_next(struct batch *batch, void *input, struct error *error);

/* Is there one that could be read? */
bool photographs_any(const struct batch *batch);

/* How many have been answered, 0 to 1. */
double photographs_share(const struct batch *batch);

/* What is not known for want of exiftool, in words; null: it is there. */
const char *photographs_lack(const struct batch *batch);

#endif
