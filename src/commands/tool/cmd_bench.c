/* commands/tool/cmd_bench.c - lenscalc bench: models of a lens, their time against their error. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/benchmark.h"
#include "commands/design/fit.h"
#include "commands/lens/lens_options.h"
#include "commands/tables.h"
#include "draw/front.h"

struct bench_input {
    struct lens_question question;
    struct plane_value focus;
    int quantity;
    double frequency; /* 1/mm */
    long rays, degree, terms;
    bool clip, no_clip;
};

#define INPUT struct bench_input

static const struct word quantities[] = {
    [BENCHMARK_RAY] = {"ray", "where rays meet the image plane"},
    [BENCHMARK_FOCUS] = {"focus", "where the spot of a field is smallest"},
    [BENCHMARK_SPOT] = {"spot", "root mean square radius of the spot"},
    [BENCHMARK_MTF] = {"mtf", "contrast of lines across y, by waves"},
    [BENCHMARK_IRRADIANCE] = {"irradiance", "light of a uniform scene on the film"},
    {NULL, NULL},
};

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    {ASKED(quantity), .name = "quantity", .words = quantities, .fallback = "ray", .value = "WHAT",
     .help = "what is computed, and held against its exact value"},
    LENS_FIELDS_OPTION(INPUT, question),
    LENS_FNUMBER_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_POSITION_OPTION(INPUT, question),
    {ASKED(focus), .name = "focus", .dimension = &dimension_length, .unit = "mm", .value = "PLANE",
     .help = "the image plane: paraxial, table, best, or mm from the last vertex; default that of "
             "the lens"},
    {ASKED(rays), .name = "rays", .column = "rays_wanted", .lowest = 1, .highest = 1e5,
     .value = "COUNT",
     .help = "approximate number of rays per field; default 60 of models, several of quadratures"},
    {ASKED(degree), .name = "degree", .lowest = 1, .highest = RAY_POLYNOMIAL_DEGREE,
     .value = "DEGREE", .help = "of the polynomial, odd; default 3, 5, 7, 9 and 11"},
    {ASKED(terms), .name = "terms", .lowest = 1, .highest = RAY_POLYNOMIAL_TERMS, .value = "COUNT",
     .help = "terms of the polynomial, at most; default four times its degree"},
    {ASKED(frequency), .name = "frequency", .dimension = &dimension_frequency, .unit = "per_mm",
     .column = "frequency", .lowest = 0, .highest = INFINITY,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .fallback = "30", .value = "FREQUENCY",
     .wants = "quantity=mtf", .help = "spatial frequency in the image"},
    {ASKED(clip), .name = "clip", .excludes = "no-clip",
     .help = "clip rays at apertures and stop (default)"},
    {ASKED(no_clip), .name = "no-clip", .help = "do not clip rays at clear apertures"},
};

struct bench_row {
    const char *position, *model, *quantity, *variant, *error_unit, *lens, *warning;
    double wavelength, fnumber; /* um, 1 */
    double seconds, time;       /* s, us */
    double error, error_fitted, digits, truth_error;
    long rays, degree, terms;
    bool pareto;
};

#define ROW struct bench_row

#define PLAIN(member, more) SHOWN(member), .flags = (more)

static const struct column columns[] = {
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .flags = COLUMN_ECHO | COLUMN_EXTRA,
     .name = "wavelength", .with = "wavelength", .help = "wavelength"},
    LENS_FNUMBER_COLUMN(ROW, fnumber),
    {PLAIN(model, COLUMN_BRIEF), .name = "model",
     .help = "pinhole, thin, thick, fitted, paraxial, seidel, polynomial, exact, exact-64, "
             "exact-113: of a lens; wave: contrast by waves"},
    {PLAIN(variant, COLUMN_BRIEF), .name = "variant",
     .help = "of an exact ray the instructions, of a sum the pattern of its rays, of waves the "
             "error they were asked for"},
    {PLAIN(degree, COLUMN_BRIEF | COLUMN_SPARSE), .name = "degree", .help = "of a polynomial"},
    {PLAIN(terms, COLUMN_HIDDEN | COLUMN_SPARSE), .name = "terms",
     .help = "terms of the polynomial of the place"},
    {PLAIN(rays, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rays",
     .help = "about how many for each field, of a sum"},
    {PLAIN(quantity, COLUMN_HIDDEN), .name = "quantity", .help = "what is computed"},
    {PLAIN(seconds, COLUMN_HIDDEN), .name = "seconds",
     .help = "processor time of one ray, or of the sums of all fields; absent where turns did not "
             "agree to 5 %"},
    {PLAIN(time, COLUMN_BRIEF), .name = "time_us", .head = "us", .label = "time, us", .digits = 2,
     .help = "the same in microseconds"},
    {PLAIN(error, COLUMN_BRIEF), .name = "rms_error", .head = "error", .label = "error",
     .digits = 2, .help = "root mean square over rays and fields, by their weights"},
    {PLAIN(error_unit, COLUMN_BRIEF), .name = "error_unit", .head = "unit",
     .help = "of the errors: um, or 1; of irradiance relative"},
    {PLAIN(error_fitted, COLUMN_BRIEF | COLUMN_SPARSE), .name = "fitted_error", .head = "fitted",
     .digits = 2,
     .help =
         "of rays by a polynomial the error over those that it was fitted to; rms_error is over "
         "others"},
    {PLAIN(digits, COLUMN_BRIEF), .name = "digits", .digits = 3,
     .help = "digits that are right: log10 of the quantity over its error"},
    {PLAIN(pareto, COLUMN_BRIEF), .name = "pareto", .help = "no other row is as fast and as exact"},
    {PLAIN(truth_error, COLUMN_HIDDEN), .name = "truth_error", .digits = 2,
     .help = "error of what all are held against; no row's error is said to be less"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL};

/* The thick lens that `lenscalc fit` finds at this wavelength; false: `why` says why not. */
static bool bench_fit(const struct bench_input *input, const struct setup *setup, struct run *run,
                      struct thick_lens *thick, struct error *why)
{
    static const struct lens_policy fitted = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .fields = FIELDS_SPREAD};
    const struct fit_input fitting = {.object = NAN,
                                      .distortion = NAN,
                                      .show = FIT_PARAMETERS,
                                      .match = FIT_IMAGE,
                                      .pattern = PATTERN_GAUSS,
                                      .rays = 72,
                                      .no_clip = input->no_clip};
    if (run->no_solver != NULL) {
        *why = *run->no_solver;
        return false;
    }
    struct lens_question question = input->question;
    question.position = setup->position;
    question.field = question.field_x = NAN;
    struct lens_cursor at = lens_begin(&question, &fitted, run->arena);
    if (!lens_next_setup(&at, why)) {
        return false;
    }
    struct fit_job job = {.input = &fitting, .run = run, .setup = at.one.setup};
    if (!setup_light(job.setup, 0, &job.light, why) || !fit_job_run(&job, why)) {
        return false;
    }
    *thick = job.fit.lenses[0];
    return true;
}

/* The instructions, the pattern, or the error that was asked for. */
static const char *bench_variant(const struct benchmark_way *way, struct arena *arena)
{
    if (way->is_wave) {
        return arena_printf(arena, "%.0e", way->asked);
    }
    if (way->is_quadrature) {
        return patterns[way->pattern].word;
    }
    return way->set != SET_BEST ? instruction_set_name(way->set) : NULL;
}

/* Is anything printed that wants times? */
static bool bench_is_timed(const struct run *run)
{
    return run_shows(run, offsetof(struct bench_row, seconds)) ||
           run_shows(run, offsetof(struct bench_row, time)) ||
           run_shows(run, offsetof(struct bench_row, pareto));
}

static const char *bench_warning(const struct benchmark_way *way, const char *name, bool is_timed,
                                 struct arena *arena)
{
    if (way->why != NULL) {
        return arena_printf(arena, "%s: %s", name, way->why);
    }
    if (is_timed && isnan(way->seconds)) {
        return "the machine is busy: times of which no two turns agree to 5 % are left out";
    }
    return NULL;
}

static bool bench_emit(const struct bench_input *input, const struct lens_case *one,
                       const struct benchmark *benchmark, struct run *run)
{
    const bool is_number =
        input->quantity == BENCHMARK_MTF || input->quantity == BENCHMARK_IRRADIANCE;
    const double unit = is_number ? 1 : 1000; /* um of mm */
    for (size_t i = 0; i < benchmark->count; i++) {
        const struct benchmark_way *way = &benchmark->ways[i];
        const char *name = way->is_wave ? "wave" : lens_models[way->model].word;
        const struct bench_row row = {
            .position = one->setup->position,
            .lens = one->setup->lens->title,
            .wavelength = one->setup->wavelengths[0].wavelength,
            .fnumber = input->question.fnumber,
            .model = name,
            .variant = bench_variant(way, run->arena),
            .quantity = quantities[input->quantity].word,
            .error_unit = is_number ? "1" : "um",
            .seconds = way->seconds,
            .time = 1e6 * way->seconds,
            .error = unit * way->error,
            .error_fitted = unit * way->error_fitted,
            .truth_error = unit * benchmark->truth_error,
            .digits = way->digits,
            .rays = way->rays > 0 ? (long)way->rays : NO_INTEGER,
            .degree = way->degree > 0 ? way->degree : NO_INTEGER,
            .terms = way->terms > 0 ? (long)way->terms : NO_INTEGER,
            .pareto = way->is_best,
            .warning = lens_warnings_join(i == 0 ? one->warning : NULL,
                                          bench_warning(way, name, bench_is_timed(run), run->arena),
                                          run->arena)};
        if (!run_emit(run, &row)) {
            return false;
        }
    }
    return true;
}

/* What is drawn: of one lens in one position. */
struct bench_drawing {
    const struct setup *setup;
    const struct benchmark_way *ways;
    size_t count;
};

static bool bench_run(const void *data, struct run *run, struct error *error)
{
    const struct bench_input *input = data;
    const struct timing_plan plan = timing_plan_default();
    struct lens_policy asked = policy;
    asked.focus = &input->focus;
    struct lens_question lens = input->question;
    lens.field = lens.field_x = NAN; /* a set of fields has an option of its own */
    struct lens_cursor at = lens_begin(&lens, &asked, run->arena);
    while (lens_next(&at, error)) {
        struct thick_lens thick;
        struct error why = {.code = ERROR_NONE};
        const bool is_fitted = bench_fit(input, at.one.setup, run, &thick, &why);
        const struct benchmark_question question = {
            .setup = at.one.setup,
            .quantity = (enum benchmark_quantity)input->quantity,
            .rays = input->rays != NO_INTEGER ? (size_t)input->rays : 0,
            .clip = !input->no_clip,
            .degree = input->degree != NO_INTEGER ? (int)input->degree : 0,
            .terms = input->terms != NO_INTEGER ? (size_t)input->terms : 0,
            .frequency = input->frequency,
            .fitted = is_fitted ? &thick : NULL,
            .unfitted = why.message,
            .timing = bench_is_timed(run) ? &plan : NULL};
        struct arena arena = {0};
        struct benchmark benchmark;
        const bool found = benchmark_run(&question, &arena, &benchmark, error);
        const bool goes_on = found && bench_emit(input, &at.one, &benchmark, run);
        if (found) {
            struct bench_drawing *drawing = ARENA_NEW(run->arena, struct bench_drawing);
            *drawing = (struct bench_drawing){
                at.one.setup, ARENA_COPY(run->arena, benchmark.ways, benchmark.count, 0),
                benchmark.count};
            run->state = drawing;
        }
        arena_free(&arena);
        if (!goes_on) {
            return found;
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the drawing -------- */

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

static const char *bench_label_of(const struct benchmark_way *way, struct arena *arena)
{
    if (way->is_quadrature) {
        return arena_printf(arena, "%zu", way->rays);
    }
    if (way->model == MODEL_POLYNOMIAL) {
        return arena_printf(arena, "degree %d", way->degree);
    }
    return way->is_wave || way->set != SET_BEST ? bench_variant(way, arena)
                                                : lens_models[way->model].word;
}

static bool bench_check_plot(const struct artifact_job *job, struct error *error)
{
    const struct bench_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--plot} draws one position: name it with {--position}");
}

static bool bench_plot(const struct artifact_job *job, struct output *sink, struct error *error)
{
    static const char *const y_labels[BENCHMARK_QUANTITIES] = {
        [BENCHMARK_RAY] = "error of a ray in the image, rms (um)",
        [BENCHMARK_FOCUS] = "error of the focus (um)",
        [BENCHMARK_SPOT] = "error of the spot's rms radius (um)",
        [BENCHMARK_MTF] = "error of the contrast",
        [BENCHMARK_IRRADIANCE] = "relative error of the irradiance"};
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
    const bool is_length = input->quantity <= BENCHMARK_SPOT;
    for (size_t i = 0; i < drawing->count; i++) {
        const struct benchmark_way *way = &drawing->ways[i];
        points[i] = (struct front_point){.x = 1e6 * way->seconds,
                                         .y = (is_length ? 1000 : 1) * way->error,
                                         .label = bench_label_of(way, arena),
                                         .group = places[bench_group_of(way)],
                                         .is_best = way->is_best};
    }
    const char *title = drawing->setup->lens->title;
    const struct front front = {
        .title = arena_printf(arena, "%s: time against error", title != NULL ? title : "A lens"),
        .subtitle = arena_printf(
            arena, "%s%s%s%s, %zu field%s, f/%.3g", quantities[input->quantity].word,
            drawing->setup->position != NULL ? ", " : "",
            drawing->setup->position != NULL ? drawing->setup->position : "",
            input->quantity == BENCHMARK_MTF ? arena_printf(arena, " at %.4g/mm", input->frequency)
                                             : "",
            drawing->setup->field_count, drawing->setup->field_count == 1 ? "" : "s",
            drawing->setup->first.fnumber),
        .x_label =
            input->quantity == BENCHMARK_RAY ? "time of a ray (us)" : "time of all fields (us)",
        .y_label = y_labels[input->quantity],
        .points = points,
        .count = drawing->count,
        .groups = groups,
        .group_count = group_count};
    return front_draw(&front, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types,
                     "draw time against error, both logarithmic, with the front"),
     .check = bench_check_plot, .make = bench_plot},
};

static const struct explanation explanations[] = {
    {"rms_error", "error = sqrt(sum w |answer - truth|^2/sum w)",
     "truth: rays in 113 bits; sums by quadratures doubled until they stand",
     "at least the error of the truth, which --columns truth_error shows"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"bench double-gauss", "models and exact rays of a double Gauss, time against error"},
    {"bench double-gauss --quantity spot", "its spots: models, and quadratures by rays"},
    {"bench double-gauss -N 8 --field 0,5", "stopped down, near the axis"},
    {"bench fisheye-16 --plot front.svg", "the same as a drawing"},
    {NULL, NULL},
};

const struct command command_bench = {
    .name = "bench",
    COMMAND_OF("tool", "models of a lens and quadratures: their time against their error"),
    .makes_many = command_always_many,
    .run = bench_run,
    COMMAND_MAKES(artifacts),
    .needs_ceres = "",
    .most_answers = 10000,
};
