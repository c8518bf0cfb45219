/* exchange/lens_formats.h - the table of other programs' lens files, and any file as a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_LENS_FORMATS_H
#define LENSCALC_EXCHANGE_LENS_FORMATS_H

#include "exchange/foreign.h"

/* All of them; ends with null. */
extern const struct foreign_format *const foreign_formats[];

/* What files may hold a lens: .lens, then those of the formats above. */
file_types lens_types;

/* The format of this name ("zmx"), or of a file name's ending; null if there is none. */
const struct foreign_format *foreign_by_name(struct text name);

/* Does a file's name end as those of lens files do, also of those that lenscalc cannot read? */
bool foreign_ends_as_lens(struct text path);

/* What kind of file it is, by its content or its ending: "zmx", "lens", "zar". */
const char *foreign_format_name(const char *source, struct text content, struct arena *arena);

/*
 * Write a lens in a format.
 *
 * Errors    ERROR_DATA: a thick lens that the format has not, which cannot be left out even when
 *           lossy; as the format's writer
 */
bool foreign_write(struct foreign_job *job, const struct foreign_format *format,
                   const struct lens *lens, struct text *text, struct error *error);

/*
 * Read a lens in whichever format it is, a .lens file included.
 *
 * Given     job      source, arena, glasses, lossy
 *           content  bytes as they lie in the file
 * Errors    as lens_read, encoding_to_utf8 and the format's reader
 */
bool foreign_read(struct foreign_job *job, struct text content, struct lens *lens,
                  struct error *error);

#endif
