/* file/lens_file.h - read and write .lens files; the format is described in lenscalc-lens.5. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_FILE_H
#define LENSCALC_FILE_LENS_FILE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/file_type.h"
#include "base/text.h"
#include "optics/lens.h"

#include <stdbool.h>

extern const struct file_type lens_file_type;

/* Who knows the glasses that a lens names. */
struct glass_source {
    /* Fills glass_index and glass of a medium whose `written` is the name. ERROR_DATA if unknown */
    bool (*find)(void *context, struct medium *medium, struct error *error);
    /* The same where the name may be another program's; the medium's warning says what it is */
    bool (*find_foreign)(void *context, struct medium *medium, struct error *error);
    /* The same, also where another program means another material by the name than lenscalc */
    bool (*find_homonym)(void *context, struct medium *medium, struct error *error);
    void *context;
};

/*
 * Read a lens.
 *
 * Given     source   name of the file, for messages
 *           content  the file; the lens points into it
 *           glasses  null: named glasses stay unresolved, and medium_index refuses them
 *           lens     receives the lens; what it points to lies in the arena
 * Errors    ERROR_DATA with line, column and caret: an unknown word, a second stop, `aperture stop`
 *           without a stop, an index of 0 or less, a wavelength without unit, a variable without
 *           its numbers, and all that is no number where one must be; lens_check has not run
 */
bool lens_read(const char *source, struct text content, const struct glass_source *glasses,
               struct arena *arena, struct lens *lens, struct error *error);

/* The lens as a .lens file, in the arena; numbers as they were typed. */
struct text lens_write(const struct lens *lens, struct arena *arena);

#endif
