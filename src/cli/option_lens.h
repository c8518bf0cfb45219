/* cli/option_lens.h - values of lens commands: a lens, a wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTION_LENS_H
#define LENSCALC_CLI_OPTION_LENS_H

#include "base/text.h"
#include "file/lensdb.h"
#include "optics/lens.h"

/* A lens as the user named it. */
struct lens_value {
    const struct lens *lens; /* null = not given */
    const char *name;        /* as typed */
    const char *warning;     /* what lens_check doubts; null = nothing */
};

/* A lens that is still text: it is read by the command. */
struct lens_text_value {
    const char *source; /* what to call it in messages; null = not given */
    struct text content;
    struct lensdb *db;
    struct arena *arena; /* that of the value */
};

/* A wavelength: a number with a unit (nm), or the name of a spectral line. */
struct wavelength_value {
    double wavelength; /* um; 0 = not given */
    const char *name;  /* as typed */
};

#endif
