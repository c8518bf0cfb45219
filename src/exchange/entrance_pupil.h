/* exchange/entrance_pupil.h - near objects: apertures that files state in other words, virtual ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ENTRANCE_PUPIL_H
#define LENSCALC_EXCHANGE_ENTRANCE_PUPIL_H

#include "base/arena.h"
#include "file/lens_build.h"
#include "optics/lens.h"

#include <stdbool.h>

/* What a file states of the marginal ray of a near object. */
enum pupil_stated {
    PUPIL_WORKING_FNUMBER, /* 1/(2 n' |u'|) behind the last surface */
    PUPIL_BEAM_RADIUS      /* its height in the plane of the first vertex, mm */
};

/*
 * The diameter of the entrance pupil that gives what is stated becomes the lens's aperture.
 *
 * Given     lens    complete but for its aperture; the object at a finite distance L
 *           value   what is stated, above 0
 * Result    false, and the lens has no aperture: there is no entrance pupil, or no such ray
 * Formula   paraxial rays: u' and the height grow with the diameter D: D = N(D = 1 mm)/N,
 *           D = 2 h (L + z)/L with the pupil at z behind the first vertex
 * Source    [OpticStudio25] paraxial working F/#; derived here for the beam: similar triangles
 */
bool entrance_pupil_set(struct lens *lens, enum pupil_stated stated, double value,
                        struct arena *arena);

/*
 * An object at any finite distance of the first surface: rays start at it, one unit of the file
 * before a plane in the object's medium, and go from there to the first surface, forwards or back.
 *
 * Given     build     without surfaces: receives the plane; its object's medium is set
 *           distance  of the object, left of the first surface, mm; 0 and less: it lies in the
 *                     surface or behind it, where rays would meet (a virtual object)
 */
void virtual_object_put(struct lens_build *build, struct pair distance);

#endif
