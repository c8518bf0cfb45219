/* analysis/model/lens_model.h - what takes the place of a lens where it need not be exact. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_MODEL_LENS_MODEL_H
#define LENSCALC_ANALYSIS_MODEL_LENS_MODEL_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "optics/first_order.h"
#include "optics/thick_lens.h"

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
 *
 * Those behind LENS_MODELS say where rays end, and stand for no lens in a photograph:
 *
 * seidel      the paraxial ray and its aberrations of the third order
 * polynomial  sparse polynomials that were fitted to exact rays
 * exact-64    exact in numbers of 64 bits, where `exact` has 53
 * exact-113   and of 113
 */
enum lens_model {
    MODEL_EXACT,
    MODEL_PARAXIAL,
    MODEL_FITTED,
    MODEL_THICK,
    MODEL_THIN,
    MODEL_PINHOLE,
    LENS_MODELS,
    MODEL_SEIDEL,
    MODEL_POLYNOMIAL,
    MODEL_EXACT_64,
    MODEL_EXACT_113,
    RAY_MODELS
};

/* The words for them, one a model; that of LENS_MODELS is null, where the command line's end. */
extern const struct word lens_models[RAY_MODELS];

/* Is it another lens than the one asked for, or the same, traced in another way? */
static inline bool lens_model_replaces(enum lens_model model)
{
    return model >= MODEL_FITTED;
}

/*
 * Can one focal length and two planes say what a lens does to rays?
 *
 * Errors    ERROR_DOMAIN: surfaces that are not round about one axis, an afocal lens, one whose
 *           light comes back
 */
bool lens_model_check_rays(const struct lens *lens, const struct first_order *first,
                           struct error *error);

/*
 * And one place of each pupil, what light comes through?
 *
 * Errors    as lens_model_check_rays; ERROR_DOMAIN: no stop, an entrance pupil at infinity, no
 *           aperture
 */
bool lens_model_check(const struct lens *lens, const struct first_order *first,
                      struct error *error);

/*
 * The thick lens of first-order data.
 *
 * Given     model   MODEL_THIN: H lies in H', as far from the film as in the thick lens, else
 *                   they lie where they are
 *           first   of it, not afocal
 *           object  before the first vertex, mm; infinite for a distant one
 */
struct thick_lens lens_model_thick(enum lens_model model, const struct first_order *first,
                                   double object);

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
