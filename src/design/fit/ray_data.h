/* design/fit/ray_data.h - exact rays through a lens: fields, pupil, wavelengths. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_FIT_RAY_DATA_H
#define LENSCALC_DESIGN_FIT_RAY_DATA_H

#include "analysis/setup/setup.h"
#include "base/arena.h"
#include "base/error.h"
#include "design/fit/thick_sums.h"
#include "trace/aim/sample.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Which rays are wanted. */
struct ray_data_request {
    const struct setup *setup; /* fields: angles of a far object, heights of a near one */
    enum pattern pattern;      /* of the pupil, with about so many rays */
    size_t ray_count;
    uint64_t seed;
    bool no_clip; /* rays pass beyond clear apertures */
};

/* A ray that did not come through: its place in the stop. */
struct ray_data_loss {
    double stop_x, stop_y;
    size_t field, group;
};

/* Rays a part, at most. */
enum { RAY_PART = 8 * RAYS_BLOCK };

/* Some of the rays of one field at one wavelength: those that came through, and the others. */
struct ray_part {
    struct thick_rays rays;
    double *columns[11]; /* what `rays` points to: x y p q, the same behind, weight, stop x y */
    size_t *groups, *fields;
    struct ray_data_loss *lost; /* those of them whose field has a chief ray */
    size_t lost_count;
};

/* All of them. They are handed out part by part: their number has no bounds, memory has. */
struct ray_data {
    double *index_object, *index_image; /* one a wavelength; negative where light runs to -z */
    /* complete once all parts were there */
    size_t count;                        /* of rays that came through */
    size_t wanted, unreachable, clipped; /* no ray to that point of the stop; clipped */
    double *clear; /* of each field: the weights of its rays, which is what of the stop is clear */
    size_t *through;             /* of each field: rays that came through */
    struct ray_tracing *tracing; /* internal */
};

/*
 * Make ready to trace rays of all fields, through the pupil, at all wavelengths.
 *
 * Given     request  its setup stays in use
 * Result    rays with place and slopes at the first and the last vertex; each weighted by its part
 *           of the pupil, by its field and its wavelength
 * Formula   the pattern's points are those of the stop, to which each ray is aimed at its own
 *           wavelength (trace/aim/aim); a lens without a stop: of its beam at the first vertex.
 *           PATTERN_GAUSS: of what is clear of it, for this field and wavelength, so that
 *           vignetted bundles are integrated too (analysis/pupil/quadrature); of other patterns
 *           the rays
 *           that are lost are left out
 * Errors    ERROR_DOMAIN: no beam (neither stop nor aperture), a field at 90 degrees or beyond; as
 *           system_compile
 */
bool ray_data_open(const struct ray_data_request *request, struct arena *arena,
                   struct ray_data *ray_data, struct error *error);

/*
 * The next part, field by field, in each wavelength by wavelength.
 *
 * Result    null: that was the last; from then on they come anew from the first on, the same. A
 *           part is good until the next is asked for. Few rays are kept, many are traced again
 */
const struct ray_part *ray_data_next(struct ray_data *ray_data);

/* Back to the first part, from one that is not the last: what it holds is given back. */
void ray_data_rewind(struct ray_data *ray_data);

/*
 * Did any ray come through? To be asked when all parts were there.
 *
 * Errors    ERROR_DOMAIN: none, with the reason
 */
bool ray_data_check(const struct ray_data *ray_data, struct error *error);

#endif
