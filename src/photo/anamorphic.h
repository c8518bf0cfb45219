/* photo/anamorphic.h - what an anamorphic lens does across the picture. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_ANAMORPHIC_H
#define LENSCALC_PHOTO_ANAMORPHIC_H

#include "photo/dof.h"
#include "photo/format.h"

/* The picture seen unsqueezed; lengths in mm, inf for a subject at infinity where it may be. */
struct anamorphic {
    double focal;         /* horizontal focal length */
    double width, height; /* of the field in the plane of the subject */
    double blur;          /* width of the blur of a point at infinity; its height is the lens's */
};

/*
 * Horizontal focal length, field and blur of an anamorphic lens.
 *
 * Given     setting  the lens by its marked focal length, which is the vertical one
 *           dof      of dof_compute for it
 *           sensor   checked
 *           squeeze  q, > 0: horizontally the lens sees q times as wide
 * Formula   f/q; q w/m and h/m; b/q
 * Source    Derived here: an afocal cylinder system of angular magnification 1/q before a spherical
 *           lens narrows the beam by q too, so that the entrance pupil is f/(q N) wide and f/N
 *           high. A blur is as wide as the pupil, imaged with m/q on the sensor and unsqueezed by
 *           q: b/q, the upright ovals of such lenses. Sharpness therefore ends vertically first,
 *           and the depth of field is that of the marked focal length
 * Errors    squeeze not above 0 or not finite
 * Limits    Cylinders before the lens. Those behind it (rear anamorphots) leave the pupil round
 */
bool anamorphic_view(const struct dof_setting *setting, const struct dof *dof,
                     const struct sensor *sensor, double squeeze, struct anamorphic *view,
                     struct error *error);

#endif
