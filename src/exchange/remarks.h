/* exchange/remarks.h - what lenscalc keeps in comments of other programs' files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_REMARKS_H
#define LENSCALC_EXCHANGE_REMARKS_H

#include "base/text.h"
#include "file/lens_build.h"
#include "optics/growing.h"
#include "optics/lens.h"

#include <stdbool.h>

/* What other formats have no words for. */
enum remark { REMARK_SOURCE, REMARK_KIND, REMARK_STATED, REMARKS = REMARK_STATED + STATED_COUNT };

/* Those of a file being read; a text without a start is absent. */
struct remarks {
    struct text texts[REMARKS];
};

/*
 * Write a line for each: source, kind and what is stated.
 *
 * Given     begin, end  of a line: "NOTE 0 lenscalc ", "\r\n"
 *           unit        of the file's lengths
 */
void remarks_write(struct growing *out, const struct lens *lens, struct number_scale unit,
                   const char *begin, const char *end);

/* Is the text behind such a beginning a remark? Then it is kept. */
bool remarks_take(struct remarks *remarks, struct text text);

/*
 * Give the lens what was taken; its unit and its positions must be known.
 *
 * Limits    what is stated counts if it is one number or one a position
 */
void remarks_apply(const struct remarks *remarks, struct lens_build *build);

#endif
