/* analysis/model/benchmark.h - models and quadratures of a lens: time against error. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_MODEL_BENCHMARK_H
#define LENSCALC_ANALYSIS_MODEL_BENCHMARK_H

#include "analysis/model/ray_model.h"
#include "base/timing.h"
#include "trace/aim/sample.h"

enum benchmark_quantity {
    BENCHMARK_RAY,   /* where rays meet the image plane, mm */
    BENCHMARK_FOCUS, /* of a field, mm; this and what follows: as enum model_sum */
    BENCHMARK_SPOT,
    BENCHMARK_MTF,
    BENCHMARK_IRRADIANCE,
    BENCHMARK_QUANTITIES,
    BENCHMARK_PHOTOGRAPH = BENCHMARK_QUANTITIES /* of who knows how to take one */
};

struct benchmark_question {
    const struct setup *setup; /* its first wavelength, all its fields, an image plane */
    enum benchmark_quantity quantity;
    size_t rays;      /* of a field, about, of models; 0: 60. Of quadratures; 0: several numbers */
    bool clip;        /* clear apertures lose exact rays */
    int degree;       /* of polynomials; 0: several */
    size_t terms;     /* of polynomials, at most; 0: four times the degree */
    double frequency; /* of contrast, 1/mm */
    const struct thick_lens *fitted;  /* for MODEL_FITTED; null: there is none, */
    const char *unfitted;             /* for this reason */
    const struct timing_plan *timing; /* null: nothing is timed */
};

/* One way to an answer. */
struct benchmark_way {
    enum lens_model model;
    enum instruction_set set; /* of MODEL_EXACT, else SET_BEST */
    int degree;               /* of a polynomial; 0 */
    size_t terms;             /* of the place that it has */
    bool is_quadrature;       /* exact rays, aimed at the stop, by `pattern` */
    bool is_wave;             /* diffraction MTF */
    enum pattern pattern;
    size_t rays;         /* of a field; 0: none are counted */
    double asked;        /* the error that the diffraction MTF was asked for */
    const char *why;     /* why there is no answer; null: there is one */
    double error;        /* in the unit of the quantity, of irradiance relative: see below */
    double error_fitted; /* of a polynomial, over the rays that were fitted; NaN */
    double digits;       /* that are right */
    double seconds;      /* of a ray, or of all fields; NaN: not known */
    double disagrees;    /* of its turns, a share */
    bool is_best;        /* no other is as fast and as exact: it is on the front */
};

struct benchmark {
    struct benchmark_way *ways;
    size_t count;
    double truth_error; /* of what they are held against, as `error`; of rays 0 */
    double scale;       /* root mean square of it */
};

/*
 * Hold all models and quadratures of a quantity against its truth, and time them.
 *
 * Given     arena  not the setup's
 * Result    error: root mean square over fields, by their weights, and over the rays of each; never
 *           less than truth_error. digits: the logarithm of scale over error, 0 at least
 * Formula   the truth: of rays 113 bits, whose own error is that of 64 bits times 2^-49; of sums
 *           exact rays or waves by quadratures that were doubled until they stand, to 1e-9 or as
 *           far as they go. Models' rays of 64 and 113 bits are rounded once and added up in 53,
 *           where few rays leave more of a sum. Polynomials are fitted to other rays than those
 *           that judge them: of 16 fields to the edge, Sobol's points of the stop
 * Errors    as bundle_open and those that find the truth; a model that cannot be has a `why`
 */
bool benchmark_run(const struct benchmark_question *question, struct arena *arena,
                   struct benchmark *benchmark, struct error *error);

/* Mark the ways on the front, those of them that have time and error. */
void benchmark_mark_front(struct benchmark_way *ways, size_t count);

#endif
