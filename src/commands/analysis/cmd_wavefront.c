/* commands/analysis/cmd_wavefront.c - lenscalc wavefront: figures, Zernike's polynomials. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_curves.h"
#include "commands/analysis/field_map.h"
#include "commands/analysis/wavefront_maps.h"

#include <math.h>
#include <string.h>

/* TERM_COLUMNS: of coefficients that a row has across, from c0 */
enum { TERM_COLUMNS = 38 };

static const struct word references[] = {
    [WAVE_CHIEF] = {"chief", "the chief ray of the same wavelength"},
    [WAVE_CENTROID] = {"centroid", "the centroid of the rays by their weights"},
    [WAVE_BEST] = {"best", "the centre of the sphere that fits the wave front best"},
    {NULL, NULL},
};

static const struct word orders[] = {
    [NO_ZERNIKE] = {"none", "figures of the whole wave front"},
    [ZERNIKE_NOLL + 1] = {"noll", "from 1, orthonormal [Noll76]"},
    [ZERNIKE_FRINGE + 1] = {"fringe", "from 1, by n + |m|, the 37th n = 12, each 1 at the edge"},
    [ZERNIKE_ANSI + 1] = {"ansi", "from 0, orthonormal [ISO24157]"},
    {NULL, NULL},
};

static const struct word mapped[] = {
    [MAPPED_RMS] = {"rms", "the root mean square of the path differences"},
    [MAPPED_STREHL] = {"strehl", "the exact Strehl ratio"},
    {NULL, NULL},
};

static const struct option options[] = {
    ANALYSIS_OPTIONS("the primary one", ", or the fields of one question"),
    ANALYSIS_FIELD_OPTIONS,
    ANALYSIS_SPECTRUM_OPTION(struct wavefront_input, question),
    {OPTION(struct wavefront_input, reference), .name = "reference", .words = references,
     .fallback = "chief", .value = "WHAT", .help = "centre of the reference sphere"},
    {OPTION(struct wavefront_input, zernike), .name = "zernike", .words = orders,
     .excludes = "error", .fallback = "none", .value = "ORDER",
     .help = "coefficients of the Zernike polynomials"},
    {OPTION(struct wavefront_input, terms), .name = "terms", .lowest = 1, .highest = ZERNIKE_MOST,
     .fallback = "36", .value = "COUNT", .wants = "zernike!=none",
     .help = "number of Zernike terms"},
    {OPTION(struct wavefront_input, across), .name = "across", .wants = "zernike!=none",
     .help = "a row a field, its coefficients as columns c1, c2 ..., which --curve draws"},
    {OPTION(struct wavefront_input, size), .name = "size", .lowest = 8, .highest = 2048,
     .value = "COUNT", .wants = "plot|map",
     .help = "points across a map; default 128, of --plot 256"},
    {OPTION(struct wavefront_input, fringes), .name = "fringes", .wants = "plot|map",
     .help = "an interferogram: fringes against a perfect reference sphere"},
    {OPTION(struct wavefront_input, mapped), .name = "mapped", .words = mapped, .fallback = "rms",
     .value = "WHAT", .wants = "over-field", .help = "what --over-field maps"},
    ANALYSIS_PUPIL_OPTIONS,
    ANALYSIS_OVER_FIELD_OPTIONS,
};

struct wavefront_row {
    struct analysis_point point;
    struct wavefront figures;
    double radius, coefficient, residual, terms[TERM_COLUMNS];
    long rays, index, n, m;
    const char *reference, *weight, *order;
};

#define PLAIN(member_name, more) COLUMN(struct wavefront_row, member_name), .flags = (more)
#define RADIUS_COLUMN                                                                              \
    ENTRY(PLAIN(radius, COLUMN_HIDDEN | COLUMN_INFINITE), .name = "sphere",                        \
          .dimension = &dimension_length, .unit = "mm", .help = "radius of the reference sphere")
#define TAIL_COLUMNS                                                                               \
    ENTRY(PLAIN(reference, COLUMN_ASSUMED), .name = "reference",                                   \
          .depends = "reference lens wavelength", .help = "centre of the reference sphere"),       \
        ENTRY(PLAIN(weight, COLUMN_ASSUMED), .name = "weights",                                    \
              .depends = "weight aim pattern clip no-clip", .label = "rays weighted by",           \
              .help = "areas by which rays are weighted"),                                         \
        ANALYSIS_TAIL_COLUMNS

static const struct column figure_columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {PLAIN(figures.rms, COLUMN_BRIEF), .name = "rms_waves", .label = "RMS, waves", .symbol = "rms",
     .help = "root mean square of the optical path differences about their mean, in wavelengths"},
    {PLAIN(figures.pv, COLUMN_BRIEF), .name = "pv_waves", .label = "PV, waves",
     .help = "peak to valley over the clear pupil, edge included"},
    {PLAIN(figures.strehl, COLUMN_BRIEF), .name = "strehl", .label = "Strehl ratio", .symbol = "S",
     .help = "Strehl ratio at the reference, computed exactly"},
    {PLAIN(figures.marechal, COLUMN_BRIEF), .name = "strehl_marechal",
     .label = "Strehl, Mar\xc3\xa9"
              "chal",
     .symbol = "Sm", .help = "estimate from the RMS alone, for small aberrations"},
    {PLAIN(figures.error, COLUMN_BRIEF), .name = "error_waves", .label = "error, waves",
     .help = "estimated error of the RMS: twice the change when the rays are doubled"},
    {PLAIN(figures.strehl_error, COLUMN_HIDDEN), .name = "strehl_error",
     .label = "error of the Strehl ratio", .help = "estimated error of the exact Strehl ratio"},
    {PLAIN(figures.mean, COLUMN_HIDDEN), .name = "mean_waves", .label = "mean, waves",
     .help = "piston: the mean, relative to the chief ray"},
    RADIUS_COLUMN,
    {PLAIN(figures.clear, 0), .name = "clear", .label = "clear share",
     .help = "fraction of the pupil's area that is not vignetted"},
    {PLAIN(rays, COLUMN_HIDDEN), .name = "rays", .help = "number of rays behind these figures"},
    ANALYSIS_SPECTRUM_COLUMN,
    TAIL_COLUMNS,
};

#define RESIDUAL_COLUMNS                                                                           \
    ENTRY(PLAIN(residual, COLUMN_BRIEF), .name = "residual_waves", .label = "residual, waves",     \
          .help = "root mean square that all of them leave"),                                      \
        RADIUS_COLUMN,                                                                             \
        ENTRY(PLAIN(rays, COLUMN_HIDDEN), .name = "rays", .help = "that are fitted"),              \
        ENTRY(PLAIN(order, COLUMN_ASSUMED), .name = "order", .depends = "zernike",                 \
              .label = "polynomials", .help = "their order and what has the size 1")

static const struct column coefficient_columns[] = {
    ANALYSIS_ROW_COLUMNS,
    {PLAIN(index, COLUMN_BRIEF), .name = "index",
     .help = "number of the polynomial, as its order counts"},
    {PLAIN(n, COLUMN_BRIEF), .name = "n", .help = "radial order"},
    {PLAIN(m, COLUMN_BRIEF), .name = "m",
     .help = "of the angle from +x: cos(m angle), or sin(|m| angle) where it is below 0"},
    {PLAIN(coefficient, COLUMN_BRIEF), .name = "coefficient_waves", .label = "coefficient, waves",
     .symbol = "c", .help = "in wavelengths"},
    RESIDUAL_COLUMNS,
    TAIL_COLUMNS,
};

#define TERM(k)                                                                                    \
    ENTRY(PLAIN(terms[k], COLUMN_BRIEF | COLUMN_SPARSE), .name = "c" #k "_waves",                  \
          .label = "c" #k ", waves", .symbol = "c" #k, .help = "coefficient of polynomial " #k)
#define TERMS_OF_FIVE(a, b, c, d, e) TERM(a), TERM(b), TERM(c), TERM(d), TERM(e)

static const struct column across_columns[] = {
    ANALYSIS_ROW_COLUMNS,
    TERMS_OF_FIVE(0, 1, 2, 3, 4),
    TERMS_OF_FIVE(5, 6, 7, 8, 9),
    TERMS_OF_FIVE(10, 11, 12, 13, 14),
    TERMS_OF_FIVE(15, 16, 17, 18, 19),
    TERMS_OF_FIVE(20, 21, 22, 23, 24),
    TERMS_OF_FIVE(25, 26, 27, 28, 29),
    TERMS_OF_FIVE(30, 31, 32, 33, 34),
    TERM(35),
    TERM(36),
    TERM(37),
    RESIDUAL_COLUMNS,
    TAIL_COLUMNS,
};

static const struct sheet figure_sheet = SHEET(figure_columns, struct wavefront_row);
static const struct sheet coefficient_sheet = SHEET(coefficient_columns, struct wavefront_row);
static const struct sheet across_sheet = SHEET(across_columns, struct wavefront_row);
static const struct sheet *const sheets[] = {&figure_sheet, &coefficient_sheet, &across_sheet,
                                             NULL};

static const struct sheet *wavefront_choose_sheet(const void *data,
                                                  const struct option_query *asking)
{
    const struct wavefront_input *input = data;
    (void)asking;
    if (input->zernike == NO_ZERNIKE) {
        return &figure_sheet;
    }
    return input->across ? &across_sheet : &coefficient_sheet;
}

/* What is found of a field: figures of the whole, or coefficients. */
struct wavefront_found {
    struct wavefront_source source;
    struct wavefront figures;
    struct wavefront_fit fit;
};

static bool wavefront_row_find(const struct analysis_cursor *at, const struct analysis_case *one,
                               size_t field, void *room, struct error *error)
{
    const struct wavefront_input *input = at->input;
    struct arena *arena = one->setup->arena;
    struct wavefront_found *found = room;
    if (!wavefront_field_open(at, one, field, input->zernike == NO_ZERNIKE, &found->source,
                              error)) {
        return false;
    }
    if (input->zernike == NO_ZERNIKE) {
        const bool wants_pv = run_shows(at->run, offsetof(struct wavefront_row, figures.pv));
        return wavefront_find(&found->source, wants_pv, arena, &found->figures, error);
    }
    return wavefront_fit(&found->source, (enum zernike_kind)(input->zernike - 1),
                         (size_t)input->terms, arena, &found->fit, error);
}

/* A row a coefficient; false: no more are wanted. */
static bool wavefront_emit_coefficients(const struct analysis_cursor *at, struct wavefront_row *row)
{
    const struct wavefront_input *input = at->input;
    const struct wavefront_found *found = at->found;
    for (size_t i = 0; i < (size_t)input->terms; i++) {
        const struct zernike_term term = zernike_term((enum zernike_kind)(input->zernike - 1), i);
        row->index = term.index;
        row->n = term.n;
        row->m = term.m;
        row->coefficient = found->fit.coefficients[i];
        if (!run_emit(at->run, row)) {
            return false;
        }
    }
    return true;
}

/* What the coefficients of a field have in common, and all of them across. */
static void wavefront_row_fit(const struct wavefront_input *input,
                              const struct wavefront_found *found, struct wavefront_row *row)
{
    static const char *const words[] = {
        [ZERNIKE_NOLL] = "noll, orthonormal over the pupil",
        [ZERNIKE_FRINGE] = "fringe, each 1 at the edge of the pupil",
        [ZERNIKE_ANSI] = "ansi (ISO 24157), orthonormal over the pupil"};
    const enum zernike_kind kind = (enum zernike_kind)(input->zernike - 1);
    row->order = words[kind];
    row->residual = found->fit.residual;
    row->rays = (long)found->fit.rays;
    for (size_t i = 0; i < (size_t)input->terms && input->across; i++) {
        row->terms[zernike_term(kind, i).index] = found->fit.coefficients[i];
    }
}

/* Light that arrives but has no place on the reference sphere takes no part in the figures. */
static void wavefront_warn_missed(const struct analysis_cursor *at, struct analysis_point *point,
                                  double missed)
{
    if (missed > 0) {
        struct arena *arena = at->run->arena;
        analysis_warn(at, point,
                      ARENA_JOIN(arena, analysis_number(100 * missed, arena),
                                 " % of the light misses the reference sphere: the figures are "
                                 "those of the rest"));
    }
}

/* The row of the field of a cursor; of a coefficient what all have. */
static void wavefront_row_fill(const struct analysis_cursor *at, void *room)
{
    const struct wavefront_input *input = at->input;
    const struct wavefront_found *found = at->found;
    struct wavefront_row *row = room;
    const bool is_whole = input->zernike == NO_ZERNIKE;
    analysis_begin_row(at, wavefront_choose_sheet(input, NULL), row);
    row->weight = analysis_weight_words(&input->question);
    if (at->lost != NULL) {
        return;
    }
    const struct opd_reference *sphere = &found->source.reference.opd;
    row->reference =
        wave_reference_words(at->one, (enum wave_about)input->reference, at->run->arena);
    row->radius = sphere->is_plane ? INFINITY : sphere->radius;
    wavefront_warn_missed(at, &row->point, is_whole ? found->figures.missed : found->fit.missed);
    if (!is_whole) {
        wavefront_row_fit(input, found, row);
        return;
    }
    const struct wavefront *figures = &found->figures;
    row->figures = *figures;
    row->rays = (long)figures->rays;
    analysis_warn(at, &row->point, lens_island_warning(&figures->islands, at->run->arena));
    if (found->source.question->rays == 0 && !figures->has_converged) {
        analysis_warn(at, &row->point, "the wave front has not converged: see its errors");
    }
}

static bool wavefront_check_across(const struct wavefront_input *input, struct error *error)
{
    const bool from_zero = input->zernike == ZERNIKE_ANSI + 1;
    const long most = from_zero ? TERM_COLUMNS : TERM_COLUMNS - 1;
    return !input->across || input->terms <= most ||
           fail(error, ERROR_USAGE, "{--across} has columns up to c%d: {--terms} at most %ld",
                TERM_COLUMNS - 1, most);
}

static bool wavefront_run(const void *data, struct run *run, struct error *error)
{
    const struct wavefront_input *input = data;
    if (!wavefront_check_across(input, error)) {
        return false;
    }
    struct analysis_cursor at = analysis_begin_finding(
        input, &wavefront_policy, run, wavefront_row_find, sizeof(struct wavefront_found));
    while (analysis_next(&at, error)) {
        struct wavefront_row row;
        wavefront_row_fill(&at, &row);
        const bool is_listed = input->zernike != NO_ZERNIKE && !input->across;
        const bool goes_on = at.lost == NULL && is_listed ? wavefront_emit_coefficients(&at, &row)
                                                          : run_emit(run, &row);
        if (!goes_on) {
            return true;
        }
    }
    return error->code == ERROR_NONE;
}

static bool wavefront_makes_many(const void *data)
{
    const struct wavefront_input *input = data;
    return (input->zernike != NO_ZERNIKE && !input->across && input->terms > 1) ||
           analysis_several(input);
}

/* -------- curves -------- */

/* The RMS; of coefficients all from c2 on: neither piston nor ANSI's first tilt. */
static bool wavefront_is_usual(const struct column *column)
{
    const size_t first = offsetof(struct wavefront_row, terms[2]);
    return column->offset == offsetof(struct wavefront_row, figures.rms) ||
           (column->offset >= first &&
            column->offset <= offsetof(struct wavefront_row, terms[TERM_COLUMNS - 1]));
}

/* What the reference sphere is about, where not the chief ray. */
static const char *wavefront_kind(const struct analysis_cursor *at)
{
    const struct wavefront_input *input = at->input;
    const char *words =
        wave_reference_words(at->one, (enum wave_about)input->reference, at->run->arena);
    return input->reference == WAVE_CHIEF ? "against the chief ray"
                                          : ARENA_JOIN(at->run->arena, "against ", words);
}

static bool wavefront_curves(const struct artifact_job *job, struct output *sink,
                             struct error *error)
{
    static const struct curve_title titles[] = {
        {"rms_waves", "RMS wave front"},
        {"pv_waves", "Peak to valley of the wave front"},
        {"strehl_marechal", "Strehl ratio by Mar\xc3\xa9"
                            "chal"},
        {"residual_waves", "RMS wave front beyond the Zernike polynomials"},
        {NULL, NULL}};
    const struct wavefront_input *first = job->inputs[0];
    static const char *const names[] = {[NO_ZERNIKE] = "Wave front",
                                        [ZERNIKE_NOLL + 1] = "Noll's Zernike coefficients",
                                        [ZERNIKE_FRINGE + 1] = "Fringe Zernike coefficients",
                                        [ZERNIKE_ANSI + 1] = "ANSI Zernike coefficients"};
    const struct analysis_curves curves = {.policy = &wavefront_policy,
                                           .find = wavefront_row_find,
                                           .found_size = sizeof(struct wavefront_found),
                                           .sheet = wavefront_choose_sheet(first, NULL),
                                           .fill_row = wavefront_row_fill,
                                           .is_usual = wavefront_is_usual,
                                           .kind = wavefront_kind,
                                           .titles = titles,
                                           .title = names[first->zernike]};
    return analysis_curves_draw(&curves, job, sink, error);
}

static bool wavefront_check_curve(const struct artifact_job *job, struct error *error)
{
    const struct wavefront_input *input = job->inputs[0];
    if (input->zernike == NO_ZERNIKE || input->across) {
        return true;
    }
    fail(error, ERROR_USAGE, "{--curve} draws columns, and these coefficients are rows");
    return error_hint(error, "{--across} makes them columns");
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("curve", drawing_types,
                     "draw --columns, else the RMS, against what is swept most finely: field, "
                     "focus or wavelength"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .check = wavefront_check_curve,
     .make = wavefront_curves},
    {ARTIFACT_OPTION("plot", drawing_types, "draw the wave fronts over the pupil, by field"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .make = wavefront_maps},
    {ARTIFACT_OPTION("map", map_types,
                     "write the map of one field: colours, or numbers in wavelengths"),
     .scope = ARTIFACT_OF_ANSWER, .is_binary = true, .check = wavefront_check_map,
     .make = wavefront_maps},
    {ARTIFACT_OPTION("over-field", field_map_types,
                     "map the RMS over the image, or what --mapped says, drawn or as numbers"),
     .scope = ARTIFACT_OF_SWEEP, .needs_no_rows = true, .check = wavefront_check_over_field,
     .make = wavefront_over_field},
};

static const struct explanation explanations[] = {
    {"rms_waves",
     "{rms}^2 = mean of (W - mean of W)^2 over the clear pupil, W = OPL(chief ray) - OPL(ray) to "
     "the reference sphere",
     "[Welford86]", "weights of the rays as --weight says; no tilt or focus is taken out"},
    {"strehl", "{S} = |mean of exp(2 pi i W)|^2 over the clear pupil", "[BornWolf99] 9.1.3",
     "at the reference itself; the highest point of the image may lie beside it: psf"},
    {"strehl_marechal", "{Sm} = exp(-(2 pi {rms})^2)", "[Mahajan83]",
     "to some percent above 0.3; below that only the exact one holds"},
    {"coefficient_waves", "W = sum of {c} Z over the clear pupil, least squares",
     "[Noll76], [ISO24157]; polynomials by [Kintner76]",
     "of a vignetted pupil the polynomials are not orthogonal, and depend on how many there are"},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"wavefront double-gauss -N 8 --spectrum photopic", "all colours together"},
    {"wavefront double-gauss -N 5.6", "how good the images of all fields are"},
    {"wavefront double-gauss -N 5.6 --zernike fringe --terms 9 --field 14deg",
     "which aberrations they consist of"},
    {"wavefront double-gauss -N 4 --fringes --plot fringes.svg", "interferograms of all fields"},
    {"wavefront double-gauss -N 8 --field 0..14:0.5 --curve rms.svg", "the RMS over the field"},
    {"wavefront double-gauss -N 8 --zernike fringe --terms 9 --across --field 0..14:0.5 --columns "
     "c5,c8,c9 --curve zernike.svg",
     "astigmatism, coma and spherical aberration over the field"},
    {"wavefront questar-35 --plot wavefronts.svg", "a telescope with its obstruction, drawn"},
    {"wavefront double-gauss --field 0deg --map wavefront.pfm --size 256",
     "the numbers for another program"},
    {NULL, NULL},
};

const struct command command_wavefront = {
    .name = "wavefront",
    .summary = "wave fronts: RMS, Strehl ratio, Zernike polynomials, maps",
    COMMAND_ASKS(struct wavefront_input),
    .sheet = SHEET(figure_columns, struct wavefront_row),
    .choose_sheet = wavefront_choose_sheet,
    .sheets = sheets,
    .explanations = explanations,
    .run = wavefront_run,
    .makes_many = wavefront_makes_many,
    ANALYSIS_COMMAND,
    .cell = "rms_waves",
    COMMAND_MAKES(artifacts),
    .most_answers = 100000,
    .weight = analysis_weight,
};
