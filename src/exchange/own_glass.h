/* exchange/own_glass.h - glasses as a lens file has them: its own indices, in its own air. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_OWN_GLASS_H
#define LENSCALC_EXCHANGE_OWN_GLASS_H

#include "exchange/foreign.h"
#include "file/lens_build.h"
#include "optics/lens.h"

/* A glass of a file, by name and by indices; the program means the indices. */
struct own_glass {
    struct foreign_job *job;
    struct lens_build *build;
    struct text name;
    const double *wavelengths; /* um, at which the file has indices */
    size_t count;
    double rounding; /* of the indices */
};

/* How far a typed index may be from what it stands for: half of its last digit, at most 5e-5. */
double own_glass_rounding(const struct figure *index);

/*
 * Say where the file's indices are not those of the catalogue's glass, beyond rounding, with both
 * at the wavelength where they differ most.
 *
 * Given     found   the catalogue's glass
 *           medium  with the file's indices; receives found, with --glass-numbers catalog
 */
void own_glass_compare(const struct own_glass *own, const struct medium *found,
                       struct medium *medium);

enum { ENVIRONMENT_WAVES = 100 };

/* 20 C and 1 atmosphere are those of the catalogues. */
struct environment {
    struct foreign_job *job;
    struct lens_build *build;        /* receives notes */
    double temperature;              /* C */
    double pressure;                 /* standard atmospheres */
    double waves[ENVIRONMENT_WAVES]; /* um, those of the file */
    size_t wave_count;
};

/*
 * The indices of a glass in the air of the file, which has the index 1.
 *
 * Given     words, word  where the glass stands
 *           medium       a glass of a catalogue, else it stays: becomes a table of indices at the
 *                        file's wavelengths, at spectral lines and at steps between them
 * Result    the medium as it is at 20 C and 1 atmosphere; else a note in the lens says what was
 *           done
 * Formula   glass_in_air with AIR_KOHLRAUSCH; wavelengths are those in the file's air
 * Source    [OpticStudio25], temperature and pressure; CODE V and OSLO are taken to have the same
 *           air: Penndorf's differs by 1.1e-7 and less from -20 to 60 C
 * Errors    a loss where the catalogue lacks what it takes
 */
bool environment_apply(const struct environment *environment, const struct file_words *words,
                       struct text word, struct medium *medium);

#endif
