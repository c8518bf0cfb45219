/* cli/options/option_lens.h - values of lens commands: a lens, a wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_OPTION_LENS_H
#define LENSCALC_CLI_OPTIONS_OPTION_LENS_H

#include "analysis/setup/setup.h"
#include "base/text.h"
#include "data/lensdb.h"
#include "optics/first_order.h"
#include "optics/lens.h"

/* What was found of a lens in one position, for the rows that ask again. */
struct lens_memo {
    bool is_known;
    double wavelength; /* um, that it was found for */
    int section;
    struct first_order first;
    struct setup_width width;
    const char *warning; /* null = all is well */
};

/* A lens as the user named it. */
struct lens_value {
    const struct lens *lens; /* null = not given */
    const char *name;        /* as typed */
    const char *warning;     /* what lens_check doubts; null = nothing */
    struct arena *arena;     /* where it lives */
    struct lens_memo *memo;  /* one a position */
    size_t serial; /* which of the lenses that were read: what is known of it; 0 = nobody counts */
};

/* A lens that is read again when it is wanted. */
struct lens_slot {
    struct arena arena;
    struct lens_value value;
    size_t used; /* when it was wanted last */
};

/*
 * The lenses of a run. The first ones stay, which rows name again and again; of those of a longer
 * list only the names stay, beside the lenses that were wanted last.
 */
struct lens_cache {
    struct arena *arena;       /* lives as long as the run */
    struct lens_value *lenses; /* null = none yet */
    size_t count;
    struct lens_slot *slots; /* null = none yet */
    size_t slot_count;
    size_t read, wanted; /* how often, up to now */
};

/* Make a lens known that was read elsewhere, and may be used there by another thread meanwhile. */
void option_lens_lend(struct lens_cache *cache, const struct lens_value *value);

/* So many lenses of a list are wanted at once, where that is more than one. */
void option_lens_at_once(struct lens_cache *cache, size_t count);

/* A lens that is still text: it is read by the command. */
struct lens_text_value {
    const char *source; /* what to call it in messages; null = not given */
    struct text content;
    bool is_file; /* the source is its path */
    struct lensdb *db;
    struct arena *arena; /* that of the value */
};

/* A wavelength: a number with a unit (nm), or the name of a spectral line. */
struct wavelength_value {
    double wavelength; /* um; 0 = not given */
    const char *name;  /* as typed */
};

/* mm to um by way of the digits: 0.55um and 550 are the same, and print so. */
double wavelength_micrometres(double millimetres);

/* And back: um as columns of lengths have it, in mm, so that it prints in nm as typed. */
double wavelength_millimetres(double micrometres);

#endif
