/* exchange/environment.h - glasses at the temperature and pressure of a lens file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ENVIRONMENT_H
#define LENSCALC_EXCHANGE_ENVIRONMENT_H

#include "exchange/foreign.h"
#include "file/lens_build.h"
#include "optics/lens.h"

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
                       struct text word, struct medium *medium, struct error *error);

#endif
