/* analysis/model/ray_model.h - a lens as what takes rays in and gives rays out. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_MODEL_RAY_MODEL_H
#define LENSCALC_ANALYSIS_MODEL_RAY_MODEL_H

#include "analysis/model/lens_model.h"
#include "analysis/model/ray_polynomial.h"
#include "analysis/model/third_order.h"
#include "analysis/setup/setup.h"
#include "base/instruction_set.h"

/* One model of a lens in one position at one wavelength, and the plane that rays are wanted in. */
struct ray_model {
    enum lens_model kind;
    double image;                /* of the plane, behind the last vertex, mm */
    struct thick_lens thick;     /* fitted, thick, thin, pinhole */
    const struct system *system; /* exact, paraxial: to the plane */
    enum instruction_set set;    /* exact */
    struct third_order third;    /* seidel */
    struct ray_polynomial polynomial;
};

/*
 * Make a model of a setup's lens, at the first of its wavelengths. Its memory is the arena's.
 *
 * Given     kind    any but MODEL_FITTED and MODEL_POLYNOMIAL, see below
 * Errors    ERROR_DOMAIN: no image plane; as lens_model_check_rays, third_order_open, setup_system
 */
bool ray_model_open(const struct setup *setup, enum lens_model kind, struct arena *arena,
                    struct ray_model *model, struct error *error);

/*
 * The model that a thick lens is, whoever found it.
 *
 * Given     kind   MODEL_FITTED to MODEL_PINHOLE, which is the hole in its H
 *           image  of the plane, behind the last vertex, mm
 */
struct ray_model ray_model_of_thick(enum lens_model kind, struct thick_lens thick, double image);

/*
 * The model that a compiled system is: of a lens, or of one with another in its place, backwards
 * too.
 *
 * Result    rays are clipped where the system clips them, and end where it ends
 */
struct ray_model ray_model_of_system(const struct system *system);

/*
 * Rays through a model.
 *
 * Given     rays  where they start: in the frame of the first vertex, in the medium before it
 *           low   receives what x and y have beyond a double, of MODEL_EXACT_64 and _113; else 0.
 *                 Null: it is not asked for
 * Result    in place: rays in the plane, z = 0 there; thick lenses, paraxial and third order take
 *           slopes for directions. Rays that are lost on exact surfaces hold NaN there, others
 *           hold numbers
 */
void ray_model_trace(const struct ray_model *model, const struct rays *rays, double (*low)[2]);

#endif
