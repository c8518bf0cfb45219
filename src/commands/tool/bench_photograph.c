/* commands/tool/bench_photograph.c - photographs of a chart by models of a lens: time against error. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/bundle.h"
#include "camera/photograph/photograph.h"
#include "commands/tool/bench.h"

#include <math.h>

/* Pixels of the picture; rays of each, of models and of the truth. */
enum { COLUMNS = 48, ROWS = 32, MODEL_SAMPLES = 16, TRUE_SAMPLES = 1024, MOST_WAYS = 16 };
static const size_t exact_samples[] = {1, 4, 16, 64, 256};

/* A chart so far away that it is as sharp as one at infinity, focal lengths. */
static const double far_away = 1e6;

/* A picture that is timed. */
struct photo_run {
    struct photograph_question question;
    struct arena arena;           /* given up after each run */
    double light[ROWS * COLUMNS]; /* of its pixels, over that of white in the middle */
    struct error error;
    bool has_failed;
};

static void photo_run_once(void *context)
{
    struct photo_run *run = context;
    const struct arena_mark mark = arena_mark(&run->arena);
    struct photograph photograph;
    run->has_failed = !photograph_take(&run->question, &run->arena, &photograph, &run->error);
    for (size_t i = 0; i < (size_t)ROWS * COLUMNS && !run->has_failed; i++) {
        const struct image *image = &photograph.image;
        run->light[i] = (double)image->pixels[i * image->channels] / photograph.reference;
    }
    arena_reset(&run->arena, mark);
}

/* Where the chief ray of the edge arrives, from the axis, mm. */
static bool photo_corner(const struct setup *setup, struct arena *arena, double *corner,
                         struct error *error)
{
    const struct bundle_question question = {
        .setup = setup, .field = &setup->edge, .pattern = PATTERN_SQUARE};
    struct bundle_source *source = ARENA_NEW(arena, struct bundle_source);
    if (!bundle_open(&question, arena, source, error)) {
        return false;
    }
    const struct ray chief = bundle_chief(source, source->open->places, arena);
    *corner = hypot(chief.point[0], chief.point[1]);
    return *corner > 0 ||
           fail(error, ERROR_DOMAIN, "a photograph has a size: give a field off the axis");
}

/* The lens of a model in place of that of a setup, its film where that has it. */
static bool photo_stand_in(const struct setup *setup, enum lens_model model,
                           const struct thick_lens *fitted, struct arena *arena,
                           struct setup *found, struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    if (!lens_model_check(setup->lens, &setup->first, error)) {
        return false;
    }
    if (model == MODEL_FITTED) {
        const struct thick_stand_in stand_in = {.thick = *fitted,
                                                .length = setup->first.length,
                                                .pupil = setup->first.entrance_pupil,
                                                .pupil_diameter =
                                                    fabs(setup->first.entrance_diameter),
                                                .image = setup->first.image};
        *lens = thick_element_lens(setup->lens, &stand_in, arena);
    } else {
        *lens = lens_model_lens(model, setup->lens, &setup->first, arena);
    }
    const struct setup_question question = {.lens = lens,
                                            .wavelength = setup->wavelengths[0].wavelength,
                                            .fnumber = NAN,
                                            .field_policy = FIELDS_LARGEST};
    if (!setup_open(&question, arena, found, error)) {
        return false;
    }
    found->image = setup->image;
    found->focus = setup->focus;
    return true;
}

/* Light of a run less that of the truth, rms over the pixels. */
static double photo_error(const struct photo_run *run, const struct photo_run *truth)
{
    double square = 0;
    for (size_t i = 0; i < (size_t)ROWS * COLUMNS; i++) {
        const double off = run->light[i] - truth->light[i];
        square += off * off;
    }
    return sqrt(square / (ROWS * COLUMNS));
}

/* The question of a picture by the lens as it is. */
static bool photo_question(const struct setup *setup, struct arena *arena,
                           struct photograph_question *question, struct error *error)
{
    double corner;
    if (!photo_corner(setup, arena, &corner, error)) {
        return false;
    }
    const double diagonal = hypot(COLUMNS, ROWS), distance = far_away * fabs(setup->first.efl);
    *question = (struct photograph_question){
        .film = {.setup = setup,
                 .width = 2 * corner * COLUMNS / diagonal,
                 .height = 2 * corner * ROWS / diagonal},
        .columns = COLUMNS,
        .rows = ROWS,
        .threads = 1,
        .card = {.chart = CHART_CHECKER,
                 .distance = setup->object.is_infinite ? distance : setup->object.distance.hi}};
    return true;
}

/* All ways, their pictures asked; those that cannot be have a `why`. */
static void photo_ways(const struct setup *setup, const struct photograph_question *whole,
                       const struct thick_lens *fitted, const char *unfitted, struct arena *arena,
                       struct benchmark *benchmark, struct photo_run *runs)
{
    static const enum lens_model models[] = {MODEL_PINHOLE, MODEL_THIN, MODEL_THICK, MODEL_FITTED,
                                             MODEL_PARAXIAL};
    enum {
        SIMPLE = sizeof models / sizeof models[0],
        EXACT = sizeof exact_samples / sizeof exact_samples[0]
    };
    benchmark->count = SIMPLE + EXACT;
    for (size_t i = 0; i < benchmark->count; i++) {
        struct benchmark_way *way = &benchmark->ways[i];
        const bool is_exact = i >= SIMPLE;
        *way = (struct benchmark_way){.model = is_exact ? MODEL_EXACT : models[i],
                                      .rays = is_exact ? exact_samples[i - SIMPLE] : MODEL_SAMPLES,
                                      .error = NAN,
                                      .error_fitted = NAN,
                                      .digits = NAN,
                                      .seconds = NAN};
        runs[i].question = *whole;
        runs[i].question.samples = way->rays;
        runs[i].question.film.model = way->model;
        struct error why = {.code = ERROR_NONE};
        bool found = true;
        if (way->model == MODEL_FITTED && fitted == NULL) {
            found = fail(&why, ERROR_DOMAIN, "%s", unfitted);
        } else if (lens_model_replaces(way->model)) {
            struct setup *stand_in = ARENA_NEW(arena, struct setup);
            found = photo_stand_in(setup, way->model, fitted, arena, stand_in, &why);
            runs[i].question.film.setup = stand_in;
        }
        if (found) {
            photo_run_once(&runs[i]);
            why = runs[i].error;
            found = !runs[i].has_failed;
        }
        way->why = found ? NULL : arena_printf(arena, "%s", why.message);
    }
}

bool bench_photograph(const struct bench_input *input, const struct setup *setup,
                      const struct timing_plan *timing, struct run *run, struct arena *arena,
                      struct benchmark *benchmark, struct error *error)
{
    struct photo_run *truth = ARENA_NEW(arena, struct photo_run);
    struct photo_run *other = ARENA_NEW(arena, struct photo_run);
    struct photo_run *runs = ARENA_ARRAY(arena, MOST_WAYS, struct photo_run);
    struct thick_lens thick;
    struct error why = {.code = ERROR_NONE};
    const bool is_fitted = bench_fit(input, setup, 0, run, &thick, &why);
    if (!photo_question(setup, arena, &truth->question, error)) {
        return false;
    }
    *benchmark =
        (struct benchmark){.ways = ARENA_ARRAY(arena, MOST_WAYS, struct benchmark_way), .scale = 1};
    truth->question.samples = TRUE_SAMPLES;
    truth->question.seed = 1; /* not that of those it judges */
    other->question = truth->question;
    other->question.seed = 2;
    photo_run_once(truth);
    photo_run_once(other);
    if (truth->has_failed || other->has_failed) {
        *error = truth->has_failed ? truth->error : other->error;
    } else {
        /* two of the same noise differ by its root of 2 */
        benchmark->truth_error = photo_error(other, truth) / sqrt(2);
        photo_ways(setup, &truth->question, is_fitted ? &thick : NULL, why.message, arena,
                   benchmark, runs);
    }
    struct timed_work timed[MOST_WAYS];
    size_t count = 0;
    for (size_t i = 0; i < benchmark->count; i++) {
        struct benchmark_way *way = &benchmark->ways[i];
        if (way->why == NULL) {
            way->error = fmax(photo_error(&runs[i], truth), benchmark->truth_error);
            way->digits = fmax(log10(benchmark->scale / way->error), 0);
            timed[count++] = (struct timed_work){.run = photo_run_once, .context = &runs[i]};
        }
    }
    if (timing != NULL) {
        timing_run(timing, timed, count);
        for (size_t i = benchmark->count; i-- > 0;) {
            struct benchmark_way *way = &benchmark->ways[i];
            if (way->why == NULL) {
                way->seconds = timed[--count].seconds;
            }
        }
        benchmark_mark_front(benchmark->ways, benchmark->count);
    }
    for (size_t i = 0; i < benchmark->count; i++) {
        arena_free(&runs[i].arena);
    }
    arena_free(&truth->arena);
    arena_free(&other->arena);
    return !truth->has_failed && !other->has_failed;
}
