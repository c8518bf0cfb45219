/* file/lens_glass.h - the glasses that a lens names. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_GLASS_H
#define LENSCALC_FILE_LENS_GLASS_H

#include "data/lensdb.h"
#include "file/lens_file.h"
#include "optics/glass.h"

/* Where glasses are looked for, and where they are kept. */
struct lens_glasses {
    struct lensdb *db;
    struct arena *arena;
};

/* The source of glasses for lens_read; it lives as long as `glasses`. */
struct glass_source lens_glass_source(struct lens_glasses *glasses);

/* The glass of a medium that was found here; null of other media. */
const struct glass *lens_glass_of(const struct medium *medium);

/* nd and Vd as the catalogue of a glass that was found here prints them; NaN where it does not. */
struct glass_abbe lens_glass_printed(const struct medium *medium);

/* The glass as a medium; it must live as long. */
struct medium lens_glass_medium(const struct glass *glass);

#endif
