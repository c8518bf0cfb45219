/* optics/thick_element.h - a prescription with a thick lens in place of a real one. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_THICK_ELEMENT_H
#define LENSCALC_OPTICS_THICK_ELEMENT_H

#include "base/arena.h"
#include "optics/lens.h"
#include "optics/thick_lens.h"

/* What stands in for the lens. Places as in struct thick_lens. */
struct thick_stand_in {
    struct thick_lens thick;
    double length;         /* of the real lens, first to last vertex, mm */
    double pupil;          /* place of the entrance pupil, mm; NaN = no stop */
    double pupil_diameter; /* mm */
    double fnumber;        /* where there is no stop; NaN = no aperture */
    double image;          /* from the last vertex, mm */
    const char *title, *note;
};

/*
 * The lens with its surfaces replaced: a plane at the first vertex, the entrance pupil as stop, the
 * thick lens, a plane at the last vertex. So H, H', pupils and focal points are counted from the
 * same places as before. Object, fields, wavelengths and media outside stay.
 *
 * Given     lens  in one position
 * Result    passes lens_check; what it points to lies in the arena or belongs to `lens`
 */
struct lens thick_element_lens(const struct lens *lens, const struct thick_stand_in *stand_in,
                               struct arena *arena);

#endif
