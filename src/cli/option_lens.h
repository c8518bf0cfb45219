/* cli/option_lens.h - values of lens commands: a lens, a wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTION_LENS_H
#define LENSCALC_CLI_OPTION_LENS_H

#include "optics/lens.h"

/* A lens as the user named it. */
struct lens_value {
    const struct lens *lens; /* null = not given */
    const char *name;        /* as typed */
    const char *warning;     /* what lens_check doubts; null = nothing */
};

/* A wavelength: a number with a unit (nm), or the name of a spectral line. */
struct wavelength_value {
    double wavelength; /* um; 0 = not given */
    const char *name;  /* as typed */
};

#endif
