/* commands/tool/cmd_bench.c - lenscalc bench: models of a lens, their time against their error. */
/* SPDX-License-Identifier: MIT */
#include "commands/tool/bench.h"

#include "cli/question/arguments.h"
#include "commands/tables.h"

#define INPUT struct bench_input

static const struct option options[] = {
    LENS_OPTION(INPUT, question),
    {ASKED(quantity), .name = "quantity", .words = bench_quantities, .fallback = "ray",
     .value = "WHAT", .help = "what is computed, and compared with its exact value"},
    LENS_FIELDS_OPTION(INPUT, question),
    LENS_FNUMBER_OPTION(INPUT, question),
    LENS_WAVELENGTH_OPTION(INPUT, question, LENS_PRIMARY_WAVELENGTH),
    LENS_POSITION_OPTION(INPUT, question),
    {ASKED(focus), .name = "focus", .dimension = &dimension_length, .unit = "mm", .value = "PLANE",
     .help = "the image plane: paraxial, table, best, or mm from the last vertex; default that of "
             "the lens"},
    {ASKED(rays), .name = "rays", .column = "rays_wanted", .lowest = 1, .highest = 1e5,
     .value = "COUNT", .wants = "quantity!=photograph",
     .help = "approximate number of rays per field; default 60 of models, several of quadratures"},
    {ASKED(degree), .name = "degree", .lowest = 1, .highest = RAY_POLYNOMIAL_DEGREE,
     .value = "DEGREE", .wants = "quantity!=photograph",
     .help = "degree of the polynomial, odd; default 3, 5, 7, 9 and 11"},
    {ASKED(terms), .name = "terms", .wants = "quantity!=photograph", .lowest = 1,
     .highest = RAY_POLYNOMIAL_TERMS, .value = "COUNT",
     .help = "terms of the polynomial, at most; default four times its degree"},
    {ASKED(frequency), .name = "frequency", .dimension = &dimension_frequency, .unit = "per_mm",
     .column = "frequency", .lowest = 0, .highest = INFINITY,
     .flags = OPTION_ABOVE_LOWEST | OPTION_NO_INFINITY, .fallback = "30", .value = "FREQUENCY",
     .wants = "quantity=mtf", .help = "spatial frequency in the image"},
    {ASKED(error), .name = "error", .column = "error_wanted", .value = "ERROR",
     .help = "name the cheapest model that keeps this error (um; a number or % of mtf, irradiance "
             "and photograph), and how wide an aperture and field each keeps it to"},
    {ASKED(clip), .name = "clip", .excludes = "no-clip", .wants = "quantity!=photograph",
     .help = "clip rays at apertures and stop (default)"},
    {ASKED(no_clip), .name = "no-clip", .wants = "quantity!=photograph",
     .help = "do not clip rays at clear apertures"},
};

struct bench_row {
    const char *position, *model, *quantity, *variant, *error_unit, *lens, *warning;
    double wavelength, fnumber; /* um, 1 */
    double seconds, time;       /* s, us */
    double error, error_fitted, digits, truth_error;
    double keeps_fnumber, keeps_field; /* 1; rad or mm */
    long rays, degree, terms;
    bool pareto, cheapest, field_is_height;
    const char *verdict;
};

#define ROW struct bench_row

#define PLAIN(member, more) SHOWN(member), .flags = (more)

static const struct column_form heights = {&dimension_length, "mm",
                                           "of a near object, or by image heights"};

static const struct column columns[] = {
    LENS_POSITION_COLUMN(ROW, position, COLUMN_BRIEF),
    {COLUMN_OF_WAVELENGTH(ROW, wavelength), .flags = COLUMN_ECHO | COLUMN_EXTRA,
     .name = "wavelength", .with = "wavelength", .help = "wavelength"},
    LENS_FNUMBER_COLUMN(ROW, fnumber),
    {PLAIN(model, COLUMN_BRIEF), .name = "model",
     .help = "pinhole, thin, thick, fitted, paraxial, seidel, polynomial, exact, exact-64, "
             "exact-113: of a lens; wave: diffraction MTF"},
    {PLAIN(variant, COLUMN_BRIEF), .name = "variant",
     .help = "of an exact ray the instructions, of a sum the pattern of its rays, of waves the "
             "error they were asked for"},
    {PLAIN(degree, COLUMN_BRIEF | COLUMN_SPARSE), .name = "degree", .help = "of a polynomial"},
    {PLAIN(terms, COLUMN_HIDDEN | COLUMN_SPARSE), .name = "terms",
     .help = "terms of the polynomial of the place"},
    {PLAIN(rays, COLUMN_BRIEF | COLUMN_SPARSE), .name = "rays",
     .help = "about how many for each field, of a sum; of each pixel, of a picture"},
    {PLAIN(quantity, COLUMN_HIDDEN), .name = "quantity", .help = "what is computed"},
    {PLAIN(seconds, COLUMN_HIDDEN), .name = "seconds",
     .help = "processor time of one ray, of the sums of all fields, or of a picture; absent where "
             "turns did not agree to 5 %"},
    {PLAIN(time, COLUMN_BRIEF), .name = "time_us", .head = "us", .label = "time, us", .digits = 2,
     .help = "the same in microseconds"},
    {PLAIN(error, COLUMN_BRIEF), .name = "rms_error", .head = "error", .label = "error",
     .digits = 2, .help = "root mean square over rays and fields, by their weights"},
    {PLAIN(error_unit, COLUMN_BRIEF), .name = "error_unit", .head = "unit",
     .help = "of the errors: um, or 1; of irradiance relative"},
    {PLAIN(error_fitted, COLUMN_BRIEF | COLUMN_SPARSE), .name = "fitted_error", .head = "fitted",
     .digits = 2,
     .help = "error of a polynomial over the rays that it was fitted to; rms_error is over others"},
    {PLAIN(digits, COLUMN_BRIEF), .name = "digits", .digits = 3,
     .help = "digits that are right: log10 of the quantity over its error"},
    {PLAIN(pareto, COLUMN_BRIEF), .name = "pareto", .help = "no other row is as fast and as exact"},
    {PLAIN(truth_error, COLUMN_HIDDEN), .name = "truth_error", .digits = 2,
     .help = "error of what all are held against; no row's error is said to be less"},
    {PLAIN(cheapest, COLUMN_EXTRA), .with = "error", .name = "cheapest",
     .help = "it is the fastest that keeps the error"},
    {PLAIN(keeps_fnumber, COLUMN_BRIEF | COLUMN_EXTRA), .with = "error", .name = "keeps_to_fnumber",
     .head = "keeps to f/", .label = "keeps to f-number", .digits = 3,
     .help = "widest aperture at which it keeps the error within the field beside it, both smaller "
             "by the same factor, to a stop; absent where not even ten stops on"},
    {COLUMN_OR(ROW, keeps_field, field_is_height, &heights), .dimension = &dimension_angle,
     .unit = "deg", .flags = COLUMN_BRIEF | COLUMN_EXTRA, .with = "error", .name = "keeps_to_field",
     .head = "within", .label = "keeps to field", .digits = 3, .help = "largest field there"},
    {PLAIN(verdict, COLUMN_NOTE), .name = "verdict", .help = "what is the cheapest, in words"},
    LENS_TITLE_COLUMN(ROW, lens),
    LENS_WARNING_COLUMN(ROW, warning),
};

static const struct lens_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_ALL};

/* The error that is to be kept, as benchmark_way.error has it; infinite: none is. */
static bool bench_wanted(const struct bench_input *input, double *wanted, struct error *error)
{
    const struct dimension *const dimension =
        bench_is_number(input) ? &dimension_ratio : &dimension_length;
    const struct unit *unit =
        bench_is_number(input) ? NULL : unit_find(&dimension_length, text_of("um"));
    *wanted = INFINITY;
    if (input->error == NULL) {
        return true;
    }
    if (!quantity_read(text_of(input->error), dimension, unit, wanted, NULL, error)) {
        return error_prefix(error, "{--error}: ");
    }
    return *wanted > 0 || fail(error, ERROR_USAGE, "{--error} '%s': it is above 0", input->error);
}

/* Does anything want times that is printed or drawn? */
static bool bench_is_timed(const struct bench_input *input, const struct run *run)
{
    return input->error != NULL || arguments_given(run->arguments, "plot") ||
           run_shows(run, offsetof(struct bench_row, seconds)) ||
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

/* The fastest way that keeps an error, of those whose time is known; count: there is none. */
static size_t bench_cheapest(const struct benchmark *benchmark, double wanted)
{
    size_t best = benchmark->count;
    for (size_t i = 0; i < benchmark->count; i++) {
        const struct benchmark_way *way = &benchmark->ways[i];
        if (way->seconds > 0 && way->error <= wanted &&
            (best == benchmark->count || way->seconds < benchmark->ways[best].seconds)) {
            best = i;
        }
    }
    return best;
}

/* "polynomial of degree 9 is the cheapest that keeps 1um" */
static const char *bench_verdict(const struct bench_input *input, const struct benchmark *benchmark,
                                 size_t cheapest, struct arena *arena)
{
    const struct benchmark_way *way = &benchmark->ways[cheapest];
    if (input->error == NULL) {
        return NULL;
    }
    if (cheapest == benchmark->count) {
        return arena_printf(arena, "none keeps %s, of those whose time is known", input->error);
    }
    const char *variant = bench_variant(way, arena);
    const char *name = way->is_wave ? "wave" : lens_models[way->model].word;
    const char *degree = way->degree > 0 ? arena_printf(arena, " of degree %d", way->degree) : "";
    const char *rays = way->rays > 0 ? arena_printf(arena, ", %zu rays", way->rays) : "";
    return arena_printf(arena, "%s%s%s%s%s%s is the cheapest that keeps %s", name,
                        variant != NULL ? " (" : "", variant != NULL ? variant : "",
                        variant != NULL ? ")" : "", degree, rays, input->error);
}

/* What is emitted beside a case. */
struct bench_answer {
    const struct benchmark *benchmark;
    const struct bench_reach *reach; /* one a way; null: no error is to be kept */
    double wanted;
    bool is_timed;
};

static bool bench_emit(const struct bench_input *input, const struct lens_case *one,
                       const struct bench_answer *answer, struct run *run)
{
    const struct benchmark *benchmark = answer->benchmark;
    const bool is_number = bench_is_number(input);
    const size_t cheapest = bench_cheapest(benchmark, answer->wanted);
    const char *verdict = bench_verdict(input, benchmark, cheapest, run->arena);
    const double unit = is_number ? 1 : 1000; /* um of mm */
    for (size_t i = 0; i < benchmark->count; i++) {
        const struct benchmark_way *way = &benchmark->ways[i];
        const char *name = way->is_wave ? "wave" : lens_models[way->model].word;
        const struct bench_reach none = {NAN, NAN};
        const struct bench_reach reach = answer->reach != NULL ? answer->reach[i] : none;
        const struct bench_row row = {
            .keeps_fnumber = reach.fnumber,
            .keeps_field = reach.field,
            .field_is_height = one->setup->edge.kind != FIELD_ANGLE,
            .cheapest = input->error != NULL && i == cheapest,
            .verdict = verdict,
            .position = one->setup->position,
            .lens = one->setup->lens->title,
            .wavelength = one->setup->wavelengths[0].wavelength,
            .fnumber = input->question.fnumber,
            .model = name,
            .variant = bench_variant(way, run->arena),
            .quantity = bench_quantities[input->quantity].word,
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
                                          bench_warning(way, name, answer->is_timed, run->arena),
                                          run->arena)};
        if (!run_emit(run, &row)) {
            return false;
        }
    }
    return true;
}

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
        struct arena arena = {0};
        struct benchmark benchmark;
        struct bench_answer answer = {.benchmark = &benchmark,
                                      .is_timed = bench_is_timed(input, run)};
        const struct setup *setup = at.one.setup;
        bool goes_on = bench_wanted(input, &answer.wanted, error) &&
                       bench_find(input, setup, answer.is_timed ? &plan : NULL, run, &arena,
                                  &benchmark, error);
        if (goes_on && input->error != NULL) {
            struct bench_reach *reach =
                ARENA_ARRAY(run->arena, benchmark.count, struct bench_reach);
            goes_on = bench_find_reach(input, setup, answer.wanted, &benchmark, run, reach, error);
            answer.reach = reach;
        }
        if (goes_on) {
            struct bench_drawing *drawing = ARENA_NEW(run->arena, struct bench_drawing);
            drawing->setup = setup;
            drawing->ways = ARENA_COPY(run->arena, benchmark.ways, benchmark.count, 0);
            drawing->count = benchmark.count;
            run->state = drawing;
            goes_on = bench_emit(input, &at.one, &answer, run);
        }
        arena_free(&arena);
        if (!goes_on) {
            return error->code == ERROR_NONE;
        }
    }
    return error->code == ERROR_NONE;
}

static bool bench_check_plot(const struct artifact_job *job, struct error *error)
{
    const struct bench_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--plot} draws one position: name it with {--position}");
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
    {"bench fisheye-16 --plot front.svg", "time against error, drawn"},
    {"bench double-gauss --error 10um",
     "the cheapest model that keeps 10 um, and how far each does"},
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
