/* exchange/metadata/exiftool.h - what exiftool, another program, says of photographs. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_METADATA_EXIFTOOL_H
#define LENSCALC_EXCHANGE_METADATA_EXIFTOOL_H

#include "base/arena.h"
#include "base/error.h"
#include "base/image/metadata.h"

#include <stddef.h>

/* A file that was asked for, and what it says. */
struct exiftool_file {
    const char *path;
    bool is_answered;
    struct metadata metadata;
};

/* The words of the program up to those of the files: its name, options, "--"; null behind them. */
extern const char *const exiftool_words[];

/*
 * Take what exiftool printed for these files.
 *
 * Given     printed  a JSON array of objects, which may be cut short
 *           files    in the order in which they were asked for; those that are not answered have
 *                    no object, such as those that exiftool could not read
 * Formula   of a zone from l to u, as Canon cameras write it, the distance is 2/(1/l + 1/u): its
 *           middle in the image space
 * Limits    Distances are as good as the encoder of a lens: steps of 5 % and more
 */
void exiftool_take(struct text printed, struct exiftool_file *files, size_t count,
                   struct arena *arena);

#endif
