/* analysis/rays/coddington.h - tangential and sagittal foci of a narrow beam about a ray. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_CODDINGTON_H
#define LENSCALC_ANALYSIS_RAYS_CODDINGTON_H

#include "base/arena.h"
#include "trace/aim/beam.h"
#include "trace/system.h"

#include <stdbool.h>

/* A narrow beam behind the lens. */
struct narrow_beam {
    struct ray chief;                /* the ray in its middle, in the frame of the last surface */
    double tangential, sagittal;     /* to the foci, along that ray from its point, mm; negative:
                                    virtual; infinite: the fan is parallel */
    double tangential_z, sagittal_z; /* the foci in the frame of that surface, mm; infinite */
    double turn; /* of the principal sections out of the plane of ray and axis, rad, counted from
                    the tangential to the sagittal one; 0 in a round lens */
};

/*
 * The foci of the narrow beam about one ray of a beam: those of Coddington, for surfaces of any
 * kind.
 *
 * Given     system  without clipping, forward
 *           at      the ray, in coordinates of the beam: the chief ray
 * Result    false: the ray is lost, chief says where. The tangential focus is that of the principal
 *           section next to the plane in which ray and axis lie, or, of a ray that is skew to the
 *           axis, to the plane through it that is parallel to the axis; of one that is parallel to
 *           the axis, the plane of both; of the axis itself, the y-z plane
 * Formula   with X., d. the derivatives of point and direction by the two coordinates of the beam,
 *           taken across the ray: A = (e_i . X._k), B = (e_i . d._k); rays beside it meet it at the
 *           distance t where det(A + t B) = 0: eigenvalues of -A B^-1, which is symmetric
 *           because rays are the normals of wavefronts; of B A^-1 = -1/t where B has none
 * Source    [Welford86] (Coddington's equations) says what the foci are. They want the two
 *           curvatures and the torsion of every surface at every point; derivatives of the ray
 *           (trace/tangent.h) are equivalent, as exact, and there for every kind of surface,
 *           tilted and decentred ones too. Tests: an independent program's Coddington trace
 * Limits    64 ulp of what the focus depends on; a fan that is parallel but for rounding has its
 *           focus far away, on either side
 */
bool coddington_foci(const struct system *system, const struct beam *beam, const double at[2],
                     struct arena *arena, struct narrow_beam *narrow);

#endif
