/* analysis/rays/field_curvature.h - foci of narrow beams of a field, from the image plane. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_FIELD_CURVATURE_H
#define LENSCALC_ANALYSIS_RAYS_FIELD_CURVATURE_H

#include "analysis/rays/coddington.h"
#include "analysis/setup/setup.h"

struct field_curvature {
    struct narrow_beam beam;
    double height[2];            /* x, y: where the chief ray meets the image plane, mm */
    double tangential, sagittal; /* z of the foci from the image plane, mm; away from the lens is
                                    positive where light leaves towards +z; infinite: parallel */
    double medial, astigmatism;  /* (T + S)/2, T - S; NaN where a focus is infinitely far away */
    double petzval;              /* the Petzval surface, from the image plane, mm */
    double tangential_power, sagittal_power; /* n'/distance of the foci from the exit pupil, 1/m */
    enum ray_status status; /* what apertures do to the chief ray; it is traced on regardless */
    size_t surface;         /* and where, 1-based; 0 = nothing */
};

/*
 * Field curvature and astigmatism at one field, of rays about the chief ray.
 *
 * Given     setup  with its image plane; wavelength: its place in the list
 * Result    from the image plane of the setup, which stays where it is at every wavelength; without
 *           one what is counted from it is NaN, the powers are there
 * Formula   foci by analysis/rays/coddington.h. Petzval surface: image + h^2/(2 R), with the
 * paraxial
 *           image and R = -1/(n' sum (n' - n) c/(n n')) of that wavelength and h the height of the
 *           chief ray in the image plane
 * Source    [Welford86]
 * Errors    ERROR_DOMAIN: as setup_beam and aim_open; the chief ray is lost
 * Limits    Petzval's surface is a parabola here, of third order; a tilted lens has none
 */
bool field_curvature(const struct setup *setup, size_t wavelength, const struct field_point *field,
                     struct field_curvature *curvature, struct error *error);

#endif
