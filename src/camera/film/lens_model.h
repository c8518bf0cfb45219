/* camera/film/lens_model.h - what takes the place of a lens where it need not be exact. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_LENS_MODEL_H
#define LENSCALC_CAMERA_FILM_LENS_MODEL_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "optics/first_order.h"

#include <stdbool.h>

/*
 * Models of a lens, after [Kolb95]; all have its stop, and are focused alike.
 *
 * exact     every surface as it is
 * paraxial  every surface as it is near the axis: no aberrations but colour and distortion by
 *           pupils; clear apertures and mirrors stay
 * fitted    the thick lens that equals its exact rays best
 * thick     focal length, principal planes and entrance pupil of the primary wavelength: no colour,
 *           nothing vignettes
 * thin      the same with one principal plane, H, and the stop in it
 * pinhole   a hole in place of that, which lets as much light through as the stop
 */
enum lens_model {
    MODEL_EXACT,
    MODEL_PARAXIAL,
    MODEL_FITTED,
    MODEL_THICK,
    MODEL_THIN,
    MODEL_PINHOLE,
    LENS_MODELS
};

/* The words of the command line for them; ends with null. */
extern const struct word lens_models[];

/* Is it another lens than the one asked for, or the same, traced in another way? */
static inline bool lens_model_replaces(enum lens_model model)
{
    return model >= MODEL_FITTED;
}

/*
 * Can one focal length and one place of each plane say what a lens does?
 *
 * Errors    ERROR_DOMAIN: surfaces that are not round about one axis, an afocal lens, one whose
 *           light comes back, no stop, an entrance pupil at infinity, no aperture
 */
bool lens_model_check(const struct lens *lens, const struct first_order *first,
                      struct error *error);

/*
 * The lens that stands in for another.
 *
 * Given     model  MODEL_THICK and further
 *           lens   in one position, of which lens_model_check has passed
 *           first  of it, with its aperture, at its primary wavelength
 * Result    one whose first and last plane lie where the first and last vertex of the lens
 *           are; a thin one is shorter by what lies between the principal planes. Both have the
 *           same paraxial image of the same object, as far behind the last plane, and the same
 *           entrance pupil diameter
 */
struct lens lens_model_lens(enum lens_model model, const struct lens *lens,
                            const struct first_order *first, struct arena *arena);

#endif
