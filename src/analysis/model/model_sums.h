/* analysis/model/model_sums.h - what a model of a lens says of its spots, contrast, light, focus. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_MODEL_MODEL_SUMS_H
#define LENSCALC_ANALYSIS_MODEL_MODEL_SUMS_H

#include "analysis/model/ray_model.h"
#include "trace/aim/sample.h"

/* What is added up over the pupil of each field. */
enum model_sum {
    MODEL_SUM_SPOT,       /* root mean square distance from the centroid, mm */
    MODEL_SUM_FOCUS,      /* where that is smallest, behind the last vertex, mm */
    MODEL_SUM_CONTRAST,   /* of lines across y, |sum w exp(2 pi i f y)|/sum w: by rays */
    MODEL_SUM_IRRADIANCE, /* per radiance of a uniform scene, sr */
    MODEL_SUMS
};

struct model_sum_question {
    const struct setup *setup; /* its first wavelength */
    enum model_sum sum;
    enum pattern pattern; /* of the pupil */
    size_t rays;          /* of each field, about */
    bool clip;            /* clear apertures lose rays */
    double frequency;     /* of the contrast, 1/mm */
};

/* Rays that pass the lens, where they start and where a model has them end. */
struct model_rays {
    struct rays starts, ends;
    double *weights; /* of each; of MODEL_SUM_IRRADIANCE of each four, mm^2 across the beam */
    size_t *begin;   /* the first of each field, and behind the last */
    double step;     /* mm: of MODEL_SUM_IRRADIANCE four are so far from where they belong */
};

/*
 * The rays of fields that arrive.
 *
 * Given     fields  `count` of them, in place of those of the setup
 * Result    weights of each field add up to its own; of MODEL_SUM_IRRADIANCE, whose pattern is
 *           Gauss's, they are areas of the beam, and each ray stands there four times, beside
 *           where it belongs: to both sides along both of its beam's coordinates
 * Errors    as bundle_open; ERROR_DOMAIN: no ray of a field arrives; light of a lens without a stop
 */
bool model_rays_make(const struct model_sum_question *question, const struct setup_field *fields,
                     size_t count, struct arena *arena, struct model_rays *rays,
                     struct error *error);

/* Let them end where a model says; low: as ray_model_trace has it, or null. */
void model_rays_trace(const struct ray_model *model, const struct model_rays *rays,
                      double (*low)[2]);

/*
 * What a model makes of such rays, one number a field. It needs no other.
 *
 * Given     rays    of `count` fields; their ends are overwritten
 *           values  receives `count` numbers
 * Formula   the irradiance is the sum of weights times |d(n L, n M)/d(a, b)|/n^2 with L and M
 *           behind the lens, a and b across the beam, by central differences: off by 1e-8 of it
 * Source    as illumination_of_field
 */
void model_sum_of_model(const struct model_sum_question *question, const struct ray_model *model,
                        const struct model_rays *rays, size_t count, double *values);

/*
 * The same by exact rays, from the lens alone: its chief rays, the edge of what is clear for
 * Gauss's points, rays aimed at the stop, traced, added up; of the setup's fields.
 *
 * Given     arena   not the setup's
 * Formula   irradiance by exact derivatives of rays
 * Errors    as bundle_open and bundle_trace; ERROR_DOMAIN: light of a lens without a stop
 */
bool model_sum_find(const struct model_sum_question *question, struct arena *arena, double *values,
                    struct error *error);

#endif
