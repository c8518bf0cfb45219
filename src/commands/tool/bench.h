/* commands/tool/bench.h - what the files of lenscalc bench share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_TOOL_BENCH_H
#define LENSCALC_COMMANDS_TOOL_BENCH_H

#include "analysis/model/benchmark.h"
#include "commands/lens/lens_options.h"

struct bench_input {
    struct lens_question question;
    struct plane_value focus;
    int quantity;
    double frequency; /* 1/mm */
    long rays, degree, terms;
    const char *error; /* that is to be kept; null: none */
    bool clip, no_clip;
};

/* Are errors numbers, not lengths? */
static inline bool bench_is_number(const struct bench_input *input)
{
    return input->quantity >= BENCHMARK_MTF;
}

/* -------- commands/tool/bench_fit.c -------- */

/*
 * The thick lens that `lenscalc fit` finds at this wavelength.
 *
 * Given     distortion  terms of it; NaN: as many as the fields bear
 * Errors    as fit_job_run; the solver is missing
 */
bool bench_fit(const struct bench_input *input, const struct setup *setup, double distortion,
               struct run *run, struct thick_lens *thick, struct error *why);

/* -------- commands/tool/bench_reach.c -------- */

/*
 * A benchmark of a lens in one case, with the thick lens that `lenscalc fit` finds for it.
 *
 * Given     timing  null: nothing is timed
 *           arena   not that of the case
 */
bool bench_find(const struct bench_input *input, const struct setup *setup,
                const struct timing_plan *timing, struct run *run, struct arena *arena,
                struct benchmark *benchmark, struct error *error);

/* How far a way keeps an error: aperture and fields smaller by the same factor. NaN: nowhere. */
struct bench_reach {
    double fnumber;
    double field; /* rad or mm */
};

/*
 * How far each way keeps an error, and all smaller apertures and fields too.
 *
 * Given     wanted     as benchmark_way.error
 *           benchmark  of the case
 *           reach      receives one a way, to a stop: of ten stops at most
 * Formula   models and polynomials are made anew for each; the fitted thick lens stays that of
 *           the case, and so does the film
 * Errors    ERROR_DOMAIN: no f-number; as benchmark_run
 */
bool bench_find_reach(const struct bench_input *input, const struct setup *setup, double wanted,
                      const struct benchmark *benchmark, struct run *run, struct bench_reach *reach,
                      struct error *error);

/* -------- commands/tool/bench_photograph.c -------- */

/*
 * Photographs of a checker by the models of lenscalc render, held against one by exact rays.
 *
 * Given     arena  not that of the case
 * Result    error: root mean square over 48 x 32 pixels, as a share of white; truth_error: the
 *           noise of the truth, which has 1024 rays a pixel, by another like it
 * Errors    as photograph_take; ERROR_DOMAIN: no field off the axis, which is the film's corner
 */
bool bench_photograph(const struct bench_input *input, const struct setup *setup,
                      const struct timing_plan *timing, struct run *run, struct arena *arena,
                      struct benchmark *benchmark, struct error *error);

/* -------- commands/tool/bench_figure.c -------- */

/* The words for enum benchmark_quantity. */
extern const struct word bench_quantities[];

/* The instructions, the pattern, or the error that was asked for; null: none of them. */
const char *bench_variant(const struct benchmark_way *way, struct arena *arena);

/* What is drawn: of one lens in one position. */
struct bench_drawing {
    const struct setup *setup;
    const struct benchmark_way *ways;
    size_t count;
};

bool bench_plot(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
