/* exchange/oslo/oslo.h - OSLO lens files, .len. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_OSLO_OSLO_H
#define LENSCALC_EXCHANGE_OSLO_OSLO_H

#include "exchange/foreign.h"

/*
 * .len as OSLO writes it, text of commands.
 *
 * Source    public files; optiland's reader and its notes of the OSLO Program Reference (units,
 *           pick-ups, the infinite object, defaults); sinopt.com and lambdares.com on the signs of
 *           tilts
 * Limits    what is understood and what is refused is told in lenscalc-convert.1
 */
extern const struct foreign_format oslo_format;

/* Begins the comments in which lenscalc keeps what OSLO has no words for. */
#define OSLO_KEEP_NOTE "// lenscalc: "
/* Beside the EBR of a lens whose stop rules the aperture. */
#define OSLO_STOP_RULES "the stop's diameter rules, not EBR"
/* The fields as a .lens file has them, which OSLO keeps as fractions of the largest. */
#define OSLO_FIELDS "fields "
/* The name of a surface: its number, and the name */
#define OSLO_NAME "name "
/* The glass of a surface whose maker OSLO has no prefix for: its number, and CATALOG:NAME */
#define OSLO_GLASS "glass "

bool oslo_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                struct error *error);

#endif
