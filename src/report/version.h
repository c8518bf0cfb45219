/* report/version.h - the program's version. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_VERSION_H
#define LENSCALC_REPORT_VERSION_H

#define LENSCALC_VERSION "0.1.0"

#endif
