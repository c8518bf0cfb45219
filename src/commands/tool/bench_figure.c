/* commands/tool/bench_figure.c - time against error of models of a lens, as a drawing. */
/* SPDX-License-Identifier: MIT */
#include "commands/tool/bench.h"
#include "draw/front.h"

const struct word bench_quantities[] = {
    [BENCHMARK_RAY] = {"ray", "where rays meet the image plane"},
    [BENCHMARK_FOCUS] = {"focus", "where the spot of a field is smallest"},
    [BENCHMARK_SPOT] = {"spot", "root mean square radius of the spot"},
    [BENCHMARK_MTF] = {"mtf", "diffraction MTF of lines across y"},
    [BENCHMARK_IRRADIANCE] = {"irradiance", "light of a uniform scene on the film"},
    [BENCHMARK_PHOTOGRAPH] = {"photograph", "a chart of squares, photographed"},
    {NULL, NULL},
};

const char *bench_variant(const struct benchmark_way *way, struct arena *arena)
{
    if (way->is_wave) {
        return arena_printf(arena, "%.0e", way->asked);
    }
    if (way->is_quadrature) {
        return patterns[way->pattern].word;
    }
    return way->set != SET_BEST ? instruction_set_name(way->set) : NULL;
}

enum bench_group {
    GROUP_MODELS,
    GROUP_POLYNOMIALS,
    GROUP_EXACT,
    GROUP_PATTERNS, /* one a pattern */
    GROUP_WAVES = GROUP_PATTERNS + PATTERNS,
    GROUPS
};

static enum bench_group bench_group_of(const struct benchmark_way *way)
{
    if (way->is_wave) {
        return GROUP_WAVES;
    }
    if (way->is_quadrature) {
        return (enum bench_group)(GROUP_PATTERNS + (int)way->pattern);
    }
    if (way->model == MODEL_POLYNOMIAL) {
        return GROUP_POLYNOMIALS;
    }
    return way->model == MODEL_EXACT || way->model > MODEL_POLYNOMIAL ? GROUP_EXACT : GROUP_MODELS;
}

static const char *bench_label_of(const struct benchmark_way *way, bool is_photograph,
                                  struct arena *arena)
{
    if (way->is_quadrature || is_photograph) {
        return way->model == MODEL_EXACT || way->is_quadrature
                   ? arena_printf(arena, "%zu", way->rays)
                   : lens_models[way->model].word;
    }
    if (way->model == MODEL_POLYNOMIAL) {
        return arena_printf(arena, "degree %d", way->degree);
    }
    return way->is_wave || way->set != SET_BEST ? bench_variant(way, arena)
                                                : lens_models[way->model].word;
}

bool bench_plot(const struct artifact_job *job, struct output *sink, struct error *error)
{
    static const char *const y_labels[] = {
        [BENCHMARK_RAY] = "error of a ray in the image, rms (um)",
        [BENCHMARK_FOCUS] = "error of the focus (um)",
        [BENCHMARK_SPOT] = "error of the spot's rms radius (um)",
        [BENCHMARK_MTF] = "error of the contrast",
        [BENCHMARK_IRRADIANCE] = "relative error of the irradiance",
        [BENCHMARK_PHOTOGRAPH] = "error of a pixel, rms (share of white)"};
    const struct bench_input *input = job->inputs[0];
    const struct bench_drawing *drawing = job->run->state;
    struct arena *arena = job->run->arena;
    struct svg svg = {.arena = arena};
    struct front_point *points = ARENA_ARRAY(arena, drawing->count, struct front_point);
    struct front_group groups[GROUPS];
    size_t places[GROUPS], group_count = 0;
    for (enum bench_group group = 0; group < GROUPS; group++) {
        static const char *const names[] = {"models", "polynomials", "exact"};
        const bool is_pattern = group >= GROUP_PATTERNS && group < GROUP_WAVES;
        const char *other =
            is_pattern ? patterns[group - GROUP_PATTERNS].word : "waves, by error asked";
        bool is_there = false;
        for (size_t i = 0; i < drawing->count; i++) {
            is_there = is_there || bench_group_of(&drawing->ways[i]) == group;
        }
        places[group] = group_count;
        groups[group_count] =
            (struct front_group){.name = group < GROUP_PATTERNS ? names[group] : other,
                                 .is_line = group != GROUP_MODELS};
        group_count += is_there;
    }
    for (size_t i = 0; i < drawing->count; i++) {
        const struct benchmark_way *way = &drawing->ways[i];
        points[i] = (struct front_point){
            .x = 1e6 * way->seconds,
            .y = (bench_is_number(input) ? 1 : 1000) * way->error,
            .label = bench_label_of(way, input->quantity == BENCHMARK_PHOTOGRAPH, arena),
            .group = places[bench_group_of(way)],
            .is_best = way->is_best};
    }
    const char *whole = input->quantity == BENCHMARK_PHOTOGRAPH ? "time of a picture (us)"
                                                                : "time of all fields (us)";
    const char *title = drawing->setup->lens->title;
    const struct front front = {
        .title = arena_printf(arena, "Time against error of %s", title != NULL ? title : "a lens"),
        .subtitle = arena_printf(
            arena, "%s%s%s%s, %zu field%s, f/%.3g", bench_quantities[input->quantity].word,
            drawing->setup->position != NULL ? ", " : "",
            drawing->setup->position != NULL ? drawing->setup->position : "",
            input->quantity == BENCHMARK_MTF ? arena_printf(arena, " at %.4g/mm", input->frequency)
                                             : "",
            drawing->setup->field_count, drawing->setup->field_count == 1 ? "" : "s",
            drawing->setup->first.fnumber),
        .x_label = input->quantity == BENCHMARK_RAY ? "time of a ray (us)" : whole,
        .y_label = y_labels[input->quantity],
        .points = points,
        .count = drawing->count,
        .groups = groups,
        .group_count = group_count};
    return front_draw(&front, &svg, error) && drawing_write(job, &svg, sink, error);
}
