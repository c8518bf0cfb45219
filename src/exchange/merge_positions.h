/* exchange/merge_positions.h - one lens with positions, of lenses that differ in numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_MERGE_POSITIONS_H
#define LENSCALC_EXCHANGE_MERGE_POSITIONS_H

#include "exchange/foreign.h"
#include "file/lens_build.h"

/*
 * A file with configurations is read once for each of them; what differs then becomes variables
 * (thicknesses d3, diameters D3) and settings of the positions, what does not stays as it is.
 *
 * Given     build   its lens has the names of the positions; it receives all else of the first lens
 *           lenses  one a position
 * Errors    losses: what differs between the positions and may not, as the number or kind of
 *           surfaces and the kind of aperture, where only the first position is kept; the kind of
 *           fields and apertures of surfaces that differ; a clear aperture that a surface has in
 *           some positions only
 */
void merge_positions(struct lens_build *build, const struct lens *lenses, struct foreign_job *job);

/* A file that is read once for each of its positions. */
struct merge_file {
    struct text content;
    const char **names; /* of the positions, in the arena; null: their numbers */
    size_t count;       /* 0: it has none, and is read once, as position 0 */
    const void *state;  /* of the reader, before it reads; copied for each position */
    size_t size;        /* of the state */
    /* reads the lens of one of them, from 1 on */
    bool (*read)(void *state, size_t position, struct text content, struct lens *lens,
                 struct error *error);
};

/* The same of such a file; a loss is listed once. */
bool merge_read(struct lens_build *build, struct foreign_job *job, const struct merge_file *file,
                struct error *error);

#endif
