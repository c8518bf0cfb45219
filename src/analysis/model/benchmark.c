/* analysis/model/benchmark.c - models and quadratures of a lens: time against error. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/benchmark.h"

#include "analysis/image/mtf.h"
#include "analysis/model/model_sums.h"
#include "analysis/rays/illumination.h"
#include "analysis/rays/spot.h"
#include "base/constants.h"

#include <math.h>
#include <string.h>

enum {
    MODEL_RAYS = 60,     /* of a field, if no number is given; */
    CONTRAST_RAYS = 500, /* of contrast */
    FITTED_FIELDS = 16,  /* of the rays that polynomials are fitted to */
    FITTED_RAYS = 48,
    MOST_WAYS = 64,
    MOST_DOUBLINGS = 9
};

static const size_t quadrature_rays[] = {12, 30, 75, 190, 480, 1200};
static const int polynomial_degrees[] = {3, 5, 7, 9, 11};
static const double wave_errors[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
static const double truth_wanted = 1e-9;

/* How many rays of a field models have. */
static size_t benchmark_rays(const struct benchmark_question *question)
{
    const size_t usual = question->quantity == BENCHMARK_MTF ? CONTRAST_RAYS : MODEL_RAYS;
    return question->rays > 0 ? question->rays : usual;
}

/* The sum that a quantity is. */
static const enum model_sum sums[BENCHMARK_QUANTITIES] = {
    [BENCHMARK_FOCUS] = MODEL_SUM_FOCUS,
    [BENCHMARK_SPOT] = MODEL_SUM_SPOT,
    [BENCHMARK_MTF] = MODEL_SUM_CONTRAST,
    [BENCHMARK_IRRADIANCE] = MODEL_SUM_IRRADIANCE,
};

struct benchmark_work {
    const struct benchmark_question *question;
    struct arena *arena;
    struct model_rays rays;              /* of models, those that judge BENCHMARK_RAY */
    double (*low)[2];                    /* of where BENCHMARK_RAY's end */
    double (*truth)[2], (*truth_low)[2]; /* where they do by 113 bits */
    double *sums;                        /* of other quantities the truth, one a field */
    double *weights;                     /* of fields; they add up to 1 */
};

/* A way at work: what is timed. */
struct benchmark_run {
    const struct benchmark_work *work;
    const struct benchmark_way *way;
    struct ray_model model;
    struct arena arena; /* given up after each run */
    double *values;     /* of sums */
    struct error error;
    bool has_failed;
};

/* -------- polynomials -------- */

/* The fields that polynomials are fitted to: Chebyshev's points of 0 to the edge. */
static struct setup_field *fitted_fields(const struct setup *setup, struct arena *arena)
{
    struct setup_field *fields = ARENA_ARRAY(arena, FITTED_FIELDS, struct setup_field);
    for (int i = 0; i < FITTED_FIELDS; i++) {
        const double share = (1 - cos(PI * i / (FITTED_FIELDS - 1))) / 2;
        fields[i] = (struct setup_field){.point = setup->edge, .weight = 1};
        fields[i].point.value[0] *= share;
        fields[i].point.value[1] *= share;
    }
    return fields;
}

/* Polynomials of a degree, into a model. */
static bool benchmark_fit(const struct benchmark_work *work, int degree, struct ray_model *model,
                          struct error *error)
{
    const struct benchmark_question *question = work->question;
    const struct setup *setup = question->setup;
    struct arena *arena = work->arena;
    const struct model_sum_question asked = {
        .setup = setup, .pattern = PATTERN_SOBOL, .rays = FITTED_RAYS, .clip = question->clip};
    struct model_rays rays;
    if (!lens_model_check_rays(setup->lens, &setup->first, error) ||
        !ray_model_open(setup, MODEL_EXACT, arena, model, error) ||
        !model_rays_make(&asked, fitted_fields(setup, arena), FITTED_FIELDS, arena, &rays, error)) {
        return false;
    }
    model_rays_trace(model, &rays, NULL);
    const struct ray_polynomial_task task = {
        .before = &rays.starts,
        .after = &rays.ends,
        .degree = degree,
        .terms = question->terms > 0 ? question->terms : 4 * (size_t)degree,
        .pupil = isfinite(setup->first.entrance_pupil) ? setup->first.entrance_pupil : 0,
        .index = model->system->index_first,
        .index_last = model->system->index_last};
    model->kind = MODEL_POLYNOMIAL;
    return ray_polynomial_fit(&task, arena, &model->polynomial, error);
}

/* -------- the truth -------- */

/* Where the rays end that judge. */
static bool benchmark_true_rays(struct benchmark_work *work, struct benchmark *benchmark,
                                struct error *error)
{
    struct arena *arena = work->arena;
    const struct model_rays *rays = &work->rays;
    const size_t count = rays->ends.count;
    struct ray_model model;
    if (!ray_model_open(work->question->setup, MODEL_EXACT_113, arena, &model, error)) {
        return false;
    }
    work->low = arena_array(arena, count, sizeof *work->low);
    work->truth = arena_array(arena, count, sizeof *work->truth);
    work->truth_low = arena_array(arena, count, sizeof *work->truth_low);
    model_rays_trace(&model, rays, work->truth_low);
    double square = 0, weight = 0;
    for (size_t i = 0; i < count; i++) {
        const struct ray_block *block = &rays->ends.blocks[i / RAYS_BLOCK];
        const double x = block->x[i % RAYS_BLOCK], y = block->y[i % RAYS_BLOCK];
        work->truth[i][0] = x;
        work->truth[i][1] = y;
        square += rays->weights[i] * (x * x + y * y);
        weight += rays->weights[i];
    }
    benchmark->scale = sqrt(square / weight);
    return true;
}

/* By exact rays at Gauss's points, doubled until two values agree. */
static bool benchmark_converge(const struct benchmark_work *work, double *truth, double *off,
                               struct error *error)
{
    const struct benchmark_question *question = work->question;
    const size_t fields = question->setup->field_count;
    struct model_sum_question asked = {.setup = question->setup,
                                       .sum = sums[question->quantity],
                                       .rays = 200,
                                       .clip = question->clip,
                                       .frequency = question->frequency};
    double *before = ARENA_ARRAY(work->arena, fields, double);
    if (!model_sum_find(&asked, work->arena, truth, error)) {
        return false;
    }
    double largest = INFINITY;
    for (int doubled = 0; doubled < MOST_DOUBLINGS && largest > truth_wanted; doubled++) {
        memcpy(before, truth, fields * sizeof *truth);
        asked.rays *= 2;
        if (!model_sum_find(&asked, work->arena, truth, error)) {
            return false;
        }
        largest = 0;
        for (size_t f = 0; f < fields; f++) {
            off[f] = fabs(truth[f] - before[f]);
            largest = fmax(largest, off[f] / fabs(truth[f]));
        }
    }
    return true;
}

static bool benchmark_true_spot(const struct benchmark_question *question, size_t field,
                                struct arena *arena, double *truth, double *off,
                                struct error *error)
{
    const struct spot_question asked = {.bundle = {.setup = question->setup,
                                                   .field = &question->setup->fields[field].point,
                                                   .clip = question->clip},
                                        .error = truth_wanted,
                                        .no_radius = true,
                                        .energy = NAN};
    struct spot spot;
    if (!spot_find(&asked, arena, &spot, error)) {
        return false;
    }
    *truth = spot.rms;
    *off = spot.error;
    return true;
}

static bool benchmark_wave(const struct benchmark_question *question, size_t field, double wanted,
                           struct arena *arena, double *contrast, double *off, struct error *error)
{
    const struct mtf_question asked = {.bundle = {.setup = question->setup,
                                                  .field = &question->setup->fields[field].point,
                                                  .clip = question->clip},
                                       .error = wanted};
    struct mtf_source source;
    struct mtf mtf;
    if (!mtf_open(&asked, arena, &source, error) ||
        !mtf_find(&source, question->frequency, arena, &mtf, error)) {
        return false;
    }
    *contrast = mtf.contrast[MTF_TANGENTIAL];
    *off = mtf.error;
    return isfinite(*contrast) ||
           fail(error, ERROR_DOMAIN, "the diffraction MTF cannot be computed: see lenscalc mtf");
}

static bool benchmark_true_light(const struct benchmark_question *question, size_t field,
                                 struct arena *arena, double *truth, double *off,
                                 struct error *error)
{
    const struct setup *setup = question->setup;
    const unsigned clip = question->clip ? SETUP_CLIPPED : SETUP_OPEN;
    const struct system *clipped = setup_system(setup, 0, clip, error);
    const struct system *open = clipped != NULL ? setup_system(setup, 0, SETUP_OPEN, error) : NULL;
    struct beam beam;
    if (open == NULL || !setup_beam(setup, &setup->fields[field].point, &beam, error)) {
        return false;
    }
    const struct illumination_question asked = {.clipped = clipped,
                                                .open = open,
                                                .beam = &beam,
                                                .first = &setup->first,
                                                .error = truth_wanted};
    const struct illumination light = illumination_of_field(&asked, arena);
    *truth = light.value;
    *off = light.error;
    return light.value > 0 || fail(error, ERROR_DOMAIN, "no light arrives");
}

/* One number a field. */
static bool benchmark_true_sums(struct benchmark_work *work, struct benchmark *benchmark,
                                struct error *error)
{
    const struct benchmark_question *question = work->question;
    const struct setup *setup = question->setup;
    double *off = ARENA_ARRAY(work->arena, setup->field_count, double);
    work->sums = ARENA_ARRAY(work->arena, setup->field_count, double);
    bool found =
        question->quantity != BENCHMARK_FOCUS || benchmark_converge(work, work->sums, off, error);
    for (size_t f = 0; f < setup->field_count && found; f++) {
        double *truth = &work->sums[f];
        if (question->quantity == BENCHMARK_SPOT) {
            found = benchmark_true_spot(question, f, work->arena, truth, &off[f], error);
        } else if (question->quantity == BENCHMARK_MTF) {
            found = benchmark_wave(question, f, 1e-7, work->arena, truth, &off[f], error);
        } else if (question->quantity == BENCHMARK_IRRADIANCE) {
            found = benchmark_true_light(question, f, work->arena, truth, &off[f], error);
            off[f] /= *truth; /* errors are relative */
        }
    }
    double scale = 0, square = 0;
    for (size_t f = 0; f < setup->field_count; f++) {
        scale += work->weights[f] * work->sums[f] * work->sums[f];
        square += work->weights[f] * off[f] * off[f];
    }
    benchmark->scale = question->quantity == BENCHMARK_IRRADIANCE ? 1 : sqrt(scale);
    benchmark->truth_error = sqrt(square);
    return found;
}

/* -------- the ways -------- */

static void benchmark_add(struct benchmark *benchmark, struct benchmark_way way)
{
    way.error = way.error_fitted = way.digits = way.seconds = way.disagrees = NAN;
    benchmark->ways[benchmark->count++] = way;
}

/* Models, the simplest first. */
static void benchmark_list_models(const struct benchmark_question *question,
                                  struct benchmark *benchmark)
{
    static const enum lens_model simple[] = {MODEL_PINHOLE, MODEL_THIN,     MODEL_THICK,
                                             MODEL_FITTED,  MODEL_PARAXIAL, MODEL_SEIDEL};
    const bool is_ray = question->quantity == BENCHMARK_RAY;
    const size_t rays = is_ray ? 0 : benchmark_rays(question);
    for (size_t i = 0; i < sizeof simple / sizeof simple[0]; i++) {
        benchmark_add(benchmark, (struct benchmark_way){.model = simple[i], .rays = rays});
    }
    for (size_t i = 0; i < sizeof polynomial_degrees / sizeof polynomial_degrees[0]; i++) {
        const int degree = question->degree > 0 ? question->degree : polynomial_degrees[i];
        if (question->degree == 0 || i == 0) {
            benchmark_add(
                benchmark,
                (struct benchmark_way){.model = MODEL_POLYNOMIAL, .degree = degree, .rays = rays});
        }
    }
    for (enum instruction_set set = SET_SSE2; set <= SET_AVX512; set++) {
        if (instruction_set_works(set)) {
            benchmark_add(benchmark,
                          (struct benchmark_way){.model = MODEL_EXACT, .set = set, .rays = rays});
        }
    }
    for (enum lens_model model = MODEL_EXACT_64; model <= MODEL_EXACT_113; model++) {
        benchmark_add(benchmark, (struct benchmark_way){.model = model, .rays = rays});
    }
}

/* Sums from the lens alone, and the diffraction MTF. */
static void benchmark_list_sums(const struct benchmark_question *question,
                                struct benchmark *benchmark)
{
    static const enum pattern kinds[] = {PATTERN_GAUSS, PATTERN_HEXAPOLAR, PATTERN_SQUARE,
                                         PATTERN_SOBOL};
    const size_t few = question->rays > 0 ? 1 : sizeof quadrature_rays / sizeof *quadrature_rays;
    for (size_t p = 0; p < sizeof kinds / sizeof kinds[0]; p++) {
        for (size_t i = 0; i < few; i++) {
            const size_t rays = question->rays > 0 ? question->rays : quadrature_rays[i];
            benchmark_add(benchmark, (struct benchmark_way){
                                         .is_quadrature = true, .pattern = kinds[p], .rays = rays});
        }
    }
    const size_t waves =
        question->quantity == BENCHMARK_MTF ? sizeof wave_errors / sizeof *wave_errors : 0;
    for (size_t i = 0; i < waves; i++) {
        benchmark_add(benchmark, (struct benchmark_way){.is_wave = true, .asked = wave_errors[i]});
    }
}

/* Once through: what is timed. */
static void benchmark_once(void *context)
{
    struct benchmark_run *run = context;
    const struct benchmark_work *work = run->work;
    const struct benchmark_question *question = work->question;
    const struct benchmark_way *way = run->way;
    if (question->quantity == BENCHMARK_RAY) {
        model_rays_trace(&run->model, &work->rays, work->low);
        return;
    }
    const struct arena_mark mark = arena_mark(&run->arena);
    if (way->is_wave) {
        double off;
        for (size_t f = 0; f < question->setup->field_count && !run->has_failed; f++) {
            run->has_failed = !benchmark_wave(question, f, way->asked, &run->arena, &run->values[f],
                                              &off, &run->error);
        }
    } else {
        const struct model_sum_question asked = {.setup = question->setup,
                                                 .sum = sums[question->quantity],
                                                 .pattern = way->pattern,
                                                 .rays = way->rays,
                                                 .clip = question->clip,
                                                 .frequency = question->frequency};
        if (way->is_quadrature) {
            run->has_failed = !model_sum_find(&asked, &run->arena, run->values, &run->error);
        } else {
            model_sum_of_model(&asked, &run->model, &work->rays, question->setup->field_count,
                               run->values);
        }
    }
    arena_reset(&run->arena, mark);
}

/* How far the rays are off that a run has left. */
static double benchmark_rays_error(const struct benchmark_work *work)
{
    const struct model_rays *rays = &work->rays;
    double square = 0, weight = 0;
    for (size_t i = 0; i < rays->ends.count; i++) {
        const struct ray_block *block = &rays->ends.blocks[i / RAYS_BLOCK];
        const double x = (block->x[i % RAYS_BLOCK] - work->truth[i][0]) +
                         (work->low[i][0] - work->truth_low[i][0]);
        const double y = (block->y[i % RAYS_BLOCK] - work->truth[i][1]) +
                         (work->low[i][1] - work->truth_low[i][1]);
        square += rays->weights[i] * (x * x + y * y);
        weight += rays->weights[i];
    }
    return sqrt(square / weight);
}

static double benchmark_sums_error(const struct benchmark_work *work, const double *values)
{
    const bool is_relative = work->question->quantity == BENCHMARK_IRRADIANCE;
    double square = 0;
    for (size_t f = 0; f < work->question->setup->field_count; f++) {
        double off = values[f] - work->sums[f];
        off = is_relative ? off / work->sums[f] : off;
        square += work->weights[f] * off * off;
    }
    return sqrt(square);
}

/* Make the model of a way, run it once and hold it against the truth. */
static bool benchmark_judge(const struct benchmark_work *work, const struct benchmark *benchmark,
                            struct benchmark_way *way, struct benchmark_run *run,
                            struct error *error)
{
    const struct benchmark_question *question = work->question;
    const struct setup *setup = question->setup;
    run->values = ARENA_ARRAY(work->arena, setup->field_count, double);
    if (way->model == MODEL_PINHOLE && question->quantity == BENCHMARK_IRRADIANCE) {
        return fail(error, ERROR_DOMAIN, "one ray of a point has no light");
    }
    if (way->model == MODEL_PINHOLE && question->quantity == BENCHMARK_FOCUS) {
        return fail(error, ERROR_DOMAIN, "one ray of a point has no focus");
    }
    if (way->model == MODEL_FITTED) {
        if (question->fitted == NULL) {
            return fail(error, ERROR_DOMAIN, "%s", question->unfitted);
        }
        run->model = ray_model_of_thick(MODEL_FITTED, *question->fitted, setup->image);
    } else if (way->model == MODEL_POLYNOMIAL) {
        if (!benchmark_fit(work, way->degree, &run->model, error)) {
            return false;
        }
        way->error_fitted =
            question->quantity == BENCHMARK_RAY ? run->model.polynomial.rms : (double)NAN;
        way->terms = run->model.polynomial.place.count;
    } else if (!way->is_quadrature && !way->is_wave &&
               !ray_model_open(setup, way->model, work->arena, &run->model, error)) {
        return false;
    }
    run->model.set = way->set;
    benchmark_once(run);
    if (run->has_failed) {
        *error = run->error;
        return false;
    }
    way->error = question->quantity == BENCHMARK_RAY ? benchmark_rays_error(work)
                                                     : benchmark_sums_error(work, run->values);
    if (!isfinite(way->error)) {
        return fail(error, ERROR_DOMAIN, "its rays do not reach the image plane");
    }
    way->error = fmax(way->error, benchmark->truth_error);
    return true;
}

void benchmark_mark_front(struct benchmark_way *ways, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        ways[i].is_best = ways[i].seconds > 0 && ways[i].error >= 0;
        for (size_t k = 0; k < count && ways[i].is_best; k++) {
            const bool is_as_good =
                ways[k].seconds <= ways[i].seconds && ways[k].error <= ways[i].error;
            const bool is_better =
                ways[k].seconds < ways[i].seconds || ways[k].error < ways[i].error;
            ways[i].is_best = !(is_as_good && is_better);
        }
    }
}

/* Time those that have an answer. */
static void benchmark_time(const struct benchmark_work *work, struct benchmark *benchmark,
                           struct benchmark_run *runs)
{
    const bool is_ray = work->question->quantity == BENCHMARK_RAY;
    struct timed_work timed[MOST_WAYS];
    size_t count = 0;
    for (size_t i = 0; i < benchmark->count; i++) {
        if (benchmark->ways[i].why == NULL) {
            timed[count++] = (struct timed_work){.run = benchmark_once, .context = &runs[i]};
        }
    }
    timing_run(work->question->timing, timed, count);
    for (size_t i = benchmark->count; i-- > 0;) {
        struct benchmark_way *way = &benchmark->ways[i];
        if (way->why == NULL) {
            const struct timed_work *one = &timed[--count];
            way->seconds = one->seconds / (is_ray ? (double)work->rays.starts.count : 1);
            way->disagrees = one->disagrees;
        }
    }
    benchmark_mark_front(benchmark->ways, benchmark->count);
}

bool benchmark_run(const struct benchmark_question *question, struct arena *arena,
                   struct benchmark *benchmark, struct error *error)
{
    const struct setup *setup = question->setup;
    struct benchmark_work work = {.question = question, .arena = arena};
    double weight = 0;
    if (isnan(setup->image)) {
        return fail(error, ERROR_DOMAIN,
                    "the image lies at infinity: there is no plane on which "
                    "rays could be compared");
    }
    work.weights = ARENA_ARRAY(arena, setup->field_count, double);
    for (size_t f = 0; f < setup->field_count; f++) {
        weight += setup->fields[f].weight;
    }
    for (size_t f = 0; f < setup->field_count; f++) {
        work.weights[f] = setup->fields[f].weight / weight;
    }
    *benchmark = (struct benchmark){.ways = ARENA_ARRAY(arena, MOST_WAYS, struct benchmark_way)};
    const struct model_sum_question rays = {
        .setup = setup,
        .sum = question->quantity == BENCHMARK_RAY ? MODEL_SUM_SPOT : sums[question->quantity],
        .rays = benchmark_rays(question),
        .clip = question->clip};
    if (!model_rays_make(&rays, setup->fields, setup->field_count, arena, &work.rays, error)) {
        return false;
    }
    if (question->quantity == BENCHMARK_RAY ? !benchmark_true_rays(&work, benchmark, error)
                                            : !benchmark_true_sums(&work, benchmark, error)) {
        return false;
    }
    benchmark_list_models(question, benchmark);
    if (question->quantity != BENCHMARK_RAY) {
        benchmark_list_sums(question, benchmark);
    }
    struct benchmark_run *runs = ARENA_ARRAY(arena, benchmark->count, struct benchmark_run);
    for (size_t i = 0; i < benchmark->count; i++) {
        struct benchmark_way *way = &benchmark->ways[i];
        struct error why = {.code = ERROR_NONE};
        runs[i] = (struct benchmark_run){.work = &work, .way = way};
        if (!benchmark_judge(&work, benchmark, way, &runs[i], &why)) {
            way->why = arena_printf(arena, "%s", why.message);
            way->error = NAN;
        } else if (way->model == MODEL_EXACT_113 && question->quantity == BENCHMARK_RAY) {
            way->error = ldexp(way[-1].error, -49); /* the same steps with 49 bits more */
        }
        way->digits = log10(benchmark->scale / way->error);
        way->digits = way->digits < 1e-6 ? 0 : way->digits; /* rounding is no digit */
    }
    if (question->timing != NULL) {
        benchmark_time(&work, benchmark, runs);
    }
    for (size_t i = 0; i < benchmark->count; i++) {
        arena_free(&runs[i].arena);
    }
    return true;
}
