/* commands/tool/bench_reach.c - models of a lens in one case, and how far they keep an error. */
/* SPDX-License-Identifier: MIT */
#include "commands/tool/bench.h"

enum { BENCH_STOPS = 10 };

bool bench_find(const struct bench_input *input, const struct setup *setup,
                const struct timing_plan *timing, struct run *run, struct arena *arena,
                struct benchmark *benchmark, struct error *error)
{
    struct thick_lens thick;
    struct error why = {.code = ERROR_NONE};
    if (input->quantity == BENCHMARK_PHOTOGRAPH) {
        return bench_photograph(input, setup, timing, run, arena, benchmark, error);
    }
    const bool is_fitted = bench_fit(input, setup, NAN, run, &thick, &why);
    const struct benchmark_question question = {
        .setup = setup,
        .quantity = (enum benchmark_quantity)input->quantity,
        .rays = input->rays != NO_INTEGER ? (size_t)input->rays : 0,
        .clip = !input->no_clip,
        .degree = input->degree != NO_INTEGER ? (int)input->degree : 0,
        .terms = input->terms != NO_INTEGER ? (size_t)input->terms : 0,
        .frequency = input->frequency,
        .fitted = is_fitted ? &thick : NULL,
        .unfitted = why.message,
        .timing = timing};
    return benchmark_run(&question, arena, benchmark, error);
}

/* The errors of all ways in another case; those that have none there are infinite. */
static bool bench_errors(const struct bench_input *input, const struct setup *setup,
                         struct run *run, size_t count, double *errors, struct error *error)
{
    struct arena arena = {0};
    struct benchmark benchmark;
    const bool found = bench_find(input, setup, NULL, run, &arena, &benchmark, error);
    for (size_t i = 0; i < count && found; i++) {
        errors[i] = benchmark.ways[i].why == NULL ? benchmark.ways[i].error : (double)INFINITY;
    }
    arena_free(&arena);
    return found;
}

/*
 * The case at a share of its aperture and of all its fields; the film stays where it is.
 *
 * Errors    as lens_next
 */
static bool bench_smaller(const struct bench_input *input, const struct setup *setup, double share,
                          struct run *run, struct setup *smaller, struct error *error)
{
    const struct lens_policy asked = {
        .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL, .focus = &input->focus};
    struct lens_question question = input->question;
    question.field = question.field_x = NAN;
    question.fnumber = setup->first.fnumber / share;
    question.position = setup->position;
    struct lens_cursor at = lens_begin(&question, &asked, run->arena);
    if (!lens_next(&at, error)) {
        return false;
    }
    *smaller = *at.one.setup;
    smaller->image = setup->image;
    struct setup_field *fields = ARENA_COPY(run->arena, setup->fields, setup->field_count, 0);
    for (size_t f = 0; f < setup->field_count; f++) {
        fields[f].point.value[0] *= share;
        fields[f].point.value[1] *= share;
    }
    smaller->fields = fields;
    smaller->edge = setup->edge;
    smaller->edge.value[0] *= share;
    smaller->edge.value[1] *= share;
    return true;
}

bool bench_find_reach(const struct bench_input *input, const struct setup *setup, double wanted,
                      const struct benchmark *benchmark, struct run *run, struct bench_reach *reach,
                      struct error *error)
{
    const double edge = fabs(setup->edge.value[setup_axis(setup)]);
    double *errors = ARENA_ARRAY(run->arena, benchmark->count, double);
    bool *is_over = ARENA_ARRAY(run->arena, benchmark->count, bool);
    if (!(setup->first.fnumber > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{--error}: the lens has no f-number that could be smaller");
    }
    for (int stops = BENCH_STOPS; stops >= 0; stops--) {
        const double share = pow(2, -stops / 2.0);
        struct setup smaller;
        if (stops > 0 && (!bench_smaller(input, setup, share, run, &smaller, error) ||
                          !bench_errors(input, &smaller, run, benchmark->count, errors, error))) {
            return false;
        }
        for (size_t i = 0; i < benchmark->count; i++) {
            const struct benchmark_way *way = &benchmark->ways[i];
            const double whole = way->why == NULL ? way->error : (double)INFINITY;
            const bool keeps = !is_over[i] && (stops > 0 ? errors[i] : whole) <= wanted;
            if (keeps) {
                reach[i] = (struct bench_reach){setup->first.fnumber / share, share * edge};
            } else if (stops == BENCH_STOPS) {
                reach[i] = (struct bench_reach){NAN, NAN};
            }
            is_over[i] = is_over[i] || !keeps;
        }
    }
    return true;
}
