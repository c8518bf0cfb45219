/* analysis/rays/footprint.h - where the beam of a field crosses the surfaces of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_FOOTPRINT_H
#define LENSCALC_ANALYSIS_RAYS_FOOTPRINT_H

#include "analysis/pupil/bundle.h"

/* On one surface, in its frame, mm. */
struct footprint {
    double low[2], high[2];     /* x, y: of all rays */
    double radius;              /* the largest distance from the vertex */
    const double (*outline)[2]; /* of the edge of the clear pupil, once about */
    size_t count;
};

/*
 * The footprints of a field at one wavelength.
 *
 * Given     bundle      its pattern is not used
 *           footprints  room for one a surface of the lens
 * Formula   rays on the edge of the clear pupil in 720 directions and its corners, and on rings of
 *           1/4 to 15/16 of the way to it, since near a caustic the edge is not the outermost;
 *           between three neighbours of the edge a parabola
 * Errors    as bundle_open; ERROR_DOMAIN: no ray arrives
 * Limits    1e-6 of the radius; near a caustic what the rings see, 1e-3
 */
bool footprints_find(const struct bundle_question *bundle, struct arena *arena,
                     struct footprint *footprints, struct error *error);

#endif
