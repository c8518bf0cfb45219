/* commands/analysis/cmd_seidel.c - lenscalc seidel: aberrations surface by surface. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_cursor.h"
#include "draw/bars.h"
#include "optics/seidel.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

/* --form */
enum { FORM_WELFORD, FORM_TRANSVERSE, FORM_WAVES };

/* --chromatic */
enum { CHROMATIC_LINES, CHROMATIC_LENS };

struct seidel_input {
    struct analysis_question question;
    int form, chromatic;
};

/* The sums of one lens in one position. */
struct seidel_case {
    const struct setup *setup;
    struct analysis_point point; /* what its rows say of their place */
    struct setup_light light;
    struct seidel seidel;
    struct field_point field; /* an angle, or the height of the object; FIELD_NONE */
    double blue, red;         /* um, of CI and CII; NaN where they are absent */
    const char *warning;      /* null = all is well */
};

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_PRIMARY,
                                              .fields = FIELDS_EDGE,
                                              .one_wavelength = true,
                                              .no_image = true,
                                              .is_narrow = true};

static const struct word forms[] = {
    [FORM_WELFORD] = {"welford", "the Seidel sums S1 .. S5 and C1, C2, mm"},
    [FORM_TRANSVERSE] = {"transverse", "in the image, mm; of an afocal lens angles"},
    [FORM_WAVES] = {"waves", "coefficients of the wavefront, in waves"},
    {NULL, NULL},
};

static const struct word pairs[] = {
    [CHROMATIC_LINES] = {"lines", "from F to C"},
    [CHROMATIC_LENS] = {"lens", "from the shortest to the longest wavelength of the lens"},
    {NULL, NULL},
};

static const struct option options[] = {
    LENS_OPTION(struct seidel_input, question),
    LENS_WAVELENGTH_OPTION(struct seidel_input, question, LENS_PRIMARY_WAVELENGTH),
    LENS_FNUMBER_OPTION(struct seidel_input, question),
    ANALYSIS_EDGE_OPTIONS(NULL),
    LENS_POSITION_OPTION(struct seidel_input, question),
    LENS_SECTION_OPTION(struct seidel_input, question),
    ANALYSIS_OBJECT_OPTION,
    {OPTION(struct seidel_input, form), .name = "form", .words = forms, .fallback = "welford",
     .value = "FORM", .help = "how the aberrations are expressed"},
    {OPTION(struct seidel_input, chromatic), .name = "chromatic", .words = pairs,
     .fallback = "lines", .value = "PAIR", .help = "wavelength pair of the chromatic sums"},
};

struct seidel_row {
    struct analysis_point point;
    const char *surface;
    double blue, red;                /* um */
    double values[SEIDEL_TERMS + 1]; /* last: tangential coma */
    bool is_angular;                 /* they are angles */
    double asphere[SEIDEL_TERMS];
    double lagrange; /* mm */
};

#define PLAIN(member_name, more) COLUMN(struct seidel_row, member_name), .flags = (more)
#define LENGTH(member_name, more)                                                                  \
    COLUMN_OF_LENGTH(struct seidel_row, member_name, "mm"), .flags = (more)

static const struct column_form angle = {&dimension_angle, "mrad", "of an afocal lens an angle"};

#define WAVE(member_name, more)                                                                    \
    COLUMN_OF_WAVELENGTH(struct seidel_row, member_name),                                          \
        .flags = (more) | COLUMN_EXTRA | COLUMN_ASSUMED
#define SUM(i, column_name, words)                                                                 \
    ENTRY(PLAIN(values[i], COLUMN_BRIEF), .name = (column_name), .label = (words), .help = (words))
#define ASPHERE(i, column_name, words)                                                             \
    ENTRY(PLAIN(asphere[i], COLUMN_EXTRA), .name = (column_name), .label = (words), .help = (words))
#define TRANSVERSE(i, column_name, words)                                                          \
    ENTRY(COLUMN_OR(struct seidel_row, values[i], is_angular, &angle),                             \
          .dimension = &dimension_length, .unit = "mm", .flags = COLUMN_BRIEF | COLUMN_SPARSE,     \
          .name = (column_name), .label = (words), .help = (words))

#define CASE_COLUMNS                                                                               \
    ENTRY(WAVE(point.wavelength, COLUMN_ECHO), .depends = "wavelength lens position",              \
          .name = "wavelength", .help = "wavelength of the rays"),                                 \
        LENS_POSITION_COLUMN(struct seidel_row, point.position, COLUMN_BRIEF),                     \
        ENTRY(COLUMN_OF_ANGLE(struct seidel_row, point.field, "deg"),                              \
              .flags = COLUMN_EXTRA | COLUMN_ASSUMED | COLUMN_ECHO,                                \
              .depends = "field height lens position", .name = "field",                            \
              .help = "angle of the chief ray in object space; absent for a height"),              \
        ENTRY(LENGTH(point.height, COLUMN_EXTRA | COLUMN_ASSUMED | COLUMN_ECHO),                   \
              .depends = "field height lens position", .name = "height", .label = "field height",  \
              .help = "of the field, at the object or at the image; absent for an angle"),         \
        ENTRY(COLUMN_OF_ANGLE(struct seidel_row, point.field_x, "deg"),                            \
              .flags = COLUMN_EXTRA | COLUMN_ECHO, .with = "field-x", .name = "field_x",           \
              .label = "field x", .help = "its angle in the x-z plane"),                           \
        ENTRY(LENGTH(point.height_x, COLUMN_EXTRA | COLUMN_ECHO), .with = "height-x",              \
              .name = "height_x", .label = "field height x", .help = "of a height the same in x"), \
        ENTRY(PLAIN(surface, COLUMN_BRIEF), .name = "surface",                                     \
              .help = "number of the surface, from 1, the stop included; the last row is the sum")

#define TAIL_COLUMNS                                                                               \
    ENTRY(WAVE(blue, COLUMN_ECHO), .depends = "chromatic lens", .name = "blue",                    \
          .label = "colour from", .help = "shorter wavelength of the chromatic sums"),             \
        ENTRY(WAVE(red, COLUMN_ECHO), .depends = "chromatic lens", .name = "red",                  \
              .label = "colour to", .help = "the longer one"),                                     \
        ENTRY(LENGTH(lagrange, COLUMN_EXTRA), .name = "lagrange", .label = "Lagrange invariant",   \
              .symbol = "H", .help = "Lagrange invariant n (y ubar - ybar u)"),                    \
        LENS_TITLE_COLUMN(struct seidel_row, point.lens),                                          \
        LENS_WARNING_COLUMN(struct seidel_row, point.warning)

static const struct column columns[] = {
    CASE_COLUMNS,
    SUM(SEIDEL_SPHERICAL, "S1", "spherical aberration, mm"),
    SUM(SEIDEL_COMA, "S2", "coma, mm"),
    SUM(SEIDEL_ASTIGMATISM, "S3", "astigmatism, mm"),
    SUM(SEIDEL_PETZVAL, "S4", "Petzval curvature, mm"),
    SUM(SEIDEL_DISTORTION, "S5", "distortion, mm"),
    SUM(SEIDEL_AXIAL_COLOR, "C1", "axial colour, mm"),
    SUM(SEIDEL_LATERAL_COLOR, "C2", "lateral colour, mm"),
    ASPHERE(SEIDEL_SPHERICAL, "asphere_S1", "of S1, what the aspheric departure adds"),
    ASPHERE(SEIDEL_COMA, "asphere_S2", "the same of S2"),
    ASPHERE(SEIDEL_ASTIGMATISM, "asphere_S3", "the same of S3"),
    ASPHERE(SEIDEL_DISTORTION, "asphere_S5", "the same of S5"),
    TAIL_COLUMNS,
};

static const struct column wave_columns[] = {
    CASE_COLUMNS,
    SUM(SEIDEL_SPHERICAL, "W040", "spherical aberration, waves"),
    SUM(SEIDEL_COMA, "W131", "coma, waves"),
    SUM(SEIDEL_ASTIGMATISM, "W222", "astigmatism, waves"),
    SUM(SEIDEL_PETZVAL, "W220", "sagittal field curvature, waves"),
    SUM(SEIDEL_DISTORTION, "W311", "distortion, waves"),
    SUM(SEIDEL_AXIAL_COLOR, "W020c", "axial colour, waves"),
    SUM(SEIDEL_LATERAL_COLOR, "W111c", "lateral colour, waves"),
    TAIL_COLUMNS,
};

static const struct column transverse_columns[] = {
    CASE_COLUMNS,
    TRANSVERSE(SEIDEL_SPHERICAL, "TSC", "spherical aberration of the marginal ray"),
    TRANSVERSE(SEIDEL_COMA, "CC_s", "sagittal coma"),
    TRANSVERSE(SEIDEL_TERMS, "CC_t", "tangential coma"),
    TRANSVERSE(SEIDEL_ASTIGMATISM, "TAC", "astigmatism"),
    TRANSVERSE(SEIDEL_PETZVAL, "TPC", "Petzval curvature"),
    TRANSVERSE(SEIDEL_DISTORTION, "DC", "distortion"),
    TRANSVERSE(SEIDEL_AXIAL_COLOR, "TAchC", "axial colour"),
    TRANSVERSE(SEIDEL_LATERAL_COLOR, "TchC", "lateral colour"),
    TAIL_COLUMNS,
};

static const struct sheet sheets[] = {
    [FORM_WELFORD] = SHEET(columns, struct seidel_row),
    [FORM_TRANSVERSE] = SHEET(transverse_columns, struct seidel_row),
    [FORM_WAVES] = SHEET(wave_columns, struct seidel_row),
};

static const struct sheet *const all_sheets[] = {&sheets[FORM_WELFORD], &sheets[FORM_TRANSVERSE],
                                                 &sheets[FORM_WAVES], NULL};

static const struct sheet *seidel_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    return &sheets[((const struct seidel_input *)data)->form];
}

/* -------- a case -------- */

/* What the sums leave out. */
static const char *seidel_case_doubts_of(const struct seidel_case *one, struct arena *arena)
{
    const struct lens *lens = one->setup->lens;
    const char *words = one->warning;
    bool has_cylinder = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        has_cylinder = has_cylinder || !surface_is_round(&lens->surfaces[i]);
    }
    if (has_cylinder) {
        words =
            lens_warnings_join(words,
                               "the lens has cylinders: the sums are those of a round lens with "
                               "the profiles of this section",
                               arena);
    }
    if (one->seidel.distorting != LENS_NONE) {
        words = lens_warnings_join(
            words,
            arena_printf(arena, "the distortion of the thick lens, surface %zu, is left out",
                         one->seidel.distorting + 1),
            arena);
    }
    return words;
}

/* The sums of the case of a cursor. */
static bool seidel_sum_up(const struct analysis_cursor *at, struct seidel_case *one,
                          struct error *error)
{
    const struct seidel_input *input = at->input;
    const struct setup *setup = at->one->setup;
    struct arena *arena = at->run->arena;
    *one = (struct seidel_case){.setup = setup,
                                .point = analysis_point_of(at->one, at->field),
                                .field = setup_edge_in_object(setup),
                                .warning = at->one->warning};
    if (!setup_light(setup, 0, &one->light, error)) {
        return false;
    }
    const bool of_image = setup->edge.kind == FIELD_IMAGE || setup->edge.kind == FIELD_REAL;
    if (of_image && isinf(one->light.first.magnification)) {
        return fail(error, ERROR_DOMAIN,
                    "the field is an image height, but the image is infinitely far away");
    }
    struct error colours;
    if (isnan(one->light.first.working_fnumber)) {
        fail(error, ERROR_DOMAIN,
             "the lens has no aperture: the height of its marginal ray is "
             "not known");
        return error_hint(error, "give an f-number with -N, or an aperture in the file");
    }
    /* the two wavelengths of CI and CII */
    const bool of_lens = input->chromatic == CHROMATIC_LENS;
    one->blue = of_lens ? INFINITY : WAVELENGTH_F;
    one->red = of_lens ? 0 : WAVELENGTH_C;
    for (size_t i = 0; i < setup->lens->wavelength_count && of_lens; i++) {
        one->blue = fmin(one->blue, setup->lens->wavelengths[i].wavelength);
        one->red = fmax(one->red, setup->lens->wavelengths[i].wavelength);
    }
    if (!(one->blue < one->red)) {
        return fail(error, ERROR_DOMAIN,
                    "{--chromatic} lens: the lens states only one wavelength, and so no "
                    "dispersion");
    }
    /* the indices there; without them CI and CII are absent */
    struct paraxial_system blue, red;
    const bool has_colours =
        paraxial_compile(setup->lens, one->blue, setup->section, arena, &blue, &colours) &&
        paraxial_compile(setup->lens, one->red, setup->section, arena, &red, &colours);
    if (!has_colours) {
        const bool others =
            input->chromatic == CHROMATIC_LINES && setup->lens->wavelength_count > 1;
        const char *hint = others ? "; --chromatic lens takes the lens's own wavelengths" : "";
        one->warning = lens_warnings_join(
            one->warning,
            ARENA_JOIN(arena, "the chromatic sums are absent: ", colours.message, hint), arena);
        one->blue = one->red = NAN;
    }
    const struct seidel_question question = {
        .lens = setup->lens,
        .system = &one->light.system,
        .blue_n = has_colours ? blue.index : NULL,
        .red_n = has_colours ? red.index : NULL,
        .section = setup->section,
        .object = &setup->object,
        .first = &one->light.first,
        .field_kind = one->field.kind,
        .field = one->field.value[setup_axis(setup)],
    };
    if (!seidel_compute(&question, arena, &one->seidel, error)) {
        return false;
    }
    one->warning = seidel_case_doubts_of(one, arena);
    return true;
}

/* Is the image infinitely far away, so that transverse aberrations are angles? */
static bool seidel_is_angular(const struct seidel_case *one)
{
    return isinf(one->light.first.image) || one->seidel.slope == 0;
}

/* A part of the sums as --form wants it: mm, rad where the image is at infinity, or waves. */
static void seidel_in_form(const struct seidel_case *one, const struct seidel_part *part, int form,
                           double values[SEIDEL_TERMS])
{
    const struct seidel *seidel = &one->seidel;
    const double n = one->light.first.index_image;
    if (form == FORM_WELFORD) {
        memcpy(values, part->sum, sizeof part->sum);
        return;
    }
    if (form == FORM_WAVES) {
        seidel_convert(part, SEIDEL_WAVES, 1e3 / one->light.wavelength, values);
        return;
    }
    const double unit = seidel_is_angular(one) ? -1 / (n * seidel->height) : 1 / seidel->slope;
    seidel_convert(part, SEIDEL_TRANSVERSE, unit, values);
}

/* -------- rows -------- */

static bool seidel_run(const void *data, struct run *run, struct error *error)
{
    const struct seidel_input *input = data;
    struct analysis_cursor at = analysis_begin(input, &policy, run);
    while (analysis_next(&at, error)) {
        struct seidel_case one;
        if (!seidel_sum_up(&at, &one, error)) {
            return false;
        }
        struct seidel_row row = {
            .point = one.point, .blue = one.blue, .red = one.red, .lagrange = one.seidel.lagrange};
        row.point.warning = one.warning;
        row.point.wavelength = one.light.wavelength;
        if (at.one->setup->section == SECTION_X) {
            row.point.field = row.point.field_x;
            row.point.height = row.point.height_x;
        }
        for (size_t i = 0; i <= one.light.system.count; i++) {
            /* Row i of a case, of its surfaces or behind them the sum. */
            const bool is_sum = i == one.light.system.count;
            const struct seidel_part *part = is_sum ? &one.seidel.total : &one.seidel.parts[i];
            row.surface = is_sum ? "sum" : arena_printf(run->arena, "%zu", i + 1);
            row.is_angular = input->form == FORM_TRANSVERSE && seidel_is_angular(&one);
            seidel_in_form(&one, part, input->form, row.values);
            row.values[SEIDEL_TERMS] = 3 * row.values[SEIDEL_COMA];
            memcpy(row.asphere, part->asphere, sizeof row.asphere);
            if (!run_emit(run, &row)) {
                break;
            }
        }
    }
    return error->code == ERROR_NONE;
}

/* -------- the bar diagram -------- */

/* What the bars are called, in each form. */
static const char *const names[][SEIDEL_TERMS] = {
    [FORM_WELFORD] = {"S1 spherical", "S2 coma", "S3 astigmatism", "S4 Petzval", "S5 distortion",
                      "C1 axial colour", "C2 lateral colour"},
    [FORM_TRANSVERSE] = {"TSC spherical", "CC_s sagittal coma", "TAC astigmatism", "TPC Petzval",
                         "DC distortion", "TAchC axial colour", "TchC lateral colour"},
    [FORM_WAVES] = {"W040 spherical", "W131 coma", "W222 astigmatism", "W220 field curvature",
                    "W311 distortion", "W020c axial colour", "W111c lateral colour"},
};

static const double THOUSAND = 1000;
static const double DROWNS = 5; /* sums that differ more have scales of their own */

static const char *seidel_view_subtitle_of(const struct seidel_case *one, struct arena *arena)
{
    const struct setup *setup = one->setup;
    const struct first_order *first = &one->light.first;
    const double value = one->field.value[setup_axis(setup)];
    const char *field = "no field";
    if (one->field.kind == FIELD_ANGLE) {
        field = arena_printf(arena, "field %.5g deg", value * DEGREES_PER_RADIAN);
    } else if (one->field.kind == FIELD_HEIGHT) {
        field = arena_printf(arena, "object height %.5g mm", value);
    }
    const char *aperture = analysis_aperture_words(first, arena);
    const char *colours = isnan(one->blue)
                              ? ""
                              : arena_printf(arena, ", colour %.5g to %.5g nm",
                                             THOUSAND * one->blue, THOUSAND * one->red);
    const char *from =
        setup->fields_from == NULL ? "" : arena_printf(arena, " (%s)", setup->fields_from);
    return arena_printf(
        arena, "%s%s%s, %s%s, at %.5g nm%s", setup->position != NULL ? setup->position : "",
        setup->position != NULL ? ", " : "", aperture != NULL ? aperture : "no aperture", field,
        from, THOUSAND * one->light.wavelength, colours);
}

static bool seidel_view_check(const struct artifact_job *job, struct error *error)
{
    const struct seidel_input *input = job->inputs[0];
    return !lens_positions_several(input->question.lens.lens, input->question.position) ||
           fail(error, ERROR_USAGE, "{--plot} shows one position: name it with {--position}");
}

/* Is one sum so much larger than another that this would not be seen beside it? */
static bool seidel_one_drowns(double *const *values, size_t count)
{
    double least = INFINITY, most = 0;
    for (size_t k = 0; k < SEIDEL_TERMS; k++) {
        double kind = 0; /* of NaN fmax takes the other */
        for (size_t i = 0; i < count; i++) {
            kind = fmax(kind, fabs(values[i][k]));
        }
        least = kind > 0 ? fmin(least, kind) : least;
        most = fmax(most, kind);
    }
    return most > DROWNS * least;
}

static bool seidel_draw(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct seidel_input *input = job->inputs[0];
    struct svg svg = {.arena = job->run->arena};
    struct analysis_cursor at = analysis_begin(input, &policy, job->run);
    struct seidel_case one;
    if (!analysis_next(&at, error) || !seidel_sum_up(&at, &one, error)) {
        return false;
    }
    const size_t count = one.light.system.count;
    struct bar_group *groups = ARENA_ARRAY(svg.arena, count + 1, struct bar_group);
    double **values = ARENA_ARRAY(svg.arena, count + 1, double *);
    for (size_t i = 0; i <= count; i++) {
        values[i] = ARENA_ARRAY(svg.arena, SEIDEL_TERMS, double);
        seidel_in_form(&one, i < count ? &one.seidel.parts[i] : &one.seidel.total, input->form,
                       values[i]);
        groups[i] =
            (struct bar_group){.label = i < count ? arena_printf(svg.arena, "%zu", i + 1) : "sum",
                               .values = values[i],
                               .apart = i == count};
    }
    static const char *const what[] = {[FORM_WELFORD] = "Seidel sums",
                                       [FORM_TRANSVERSE] = "Transverse third-order aberrations",
                                       [FORM_WAVES] = "Third-order wavefront"};
    /* in thousandths of the unit where all bars are below a tenth of it */
    double largest = 0;
    for (size_t i = 0; i < (count + 1) * SEIDEL_TERMS; i++) {
        largest = fmax(largest, fabs(values[i / SEIDEL_TERMS][i % SEIDEL_TERMS]));
    }
    const bool waves = input->form == FORM_WAVES;
    const bool angular = input->form == FORM_TRANSVERSE && seidel_is_angular(&one);
    const bool small = !waves && (largest < 0.1 || angular);
    for (size_t i = 0; i < (count + 1) * SEIDEL_TERMS && small; i++) {
        values[i / SEIDEL_TERMS][i % SEIDEL_TERMS] *= THOUSAND;
    }
    const char *length = small ? "\xc2\xb5m" : "mm", *unit = waves ? "waves" : length;
    unit = angular ? "mrad" : unit;
    const struct bars bars = (struct bars){
        .own_scales = seidel_one_drowns(values, count + 1),
        .title = arena_printf(svg.arena, "%s of %s", what[input->form], one.setup->lens->title),
        .subtitle = seidel_view_subtitle_of(&one, svg.arena),
        .x_label = "surface",
        .y_label = arena_printf(svg.arena, "contribution (%s)", unit),
        .kinds = names[input->form],
        .kind_count = SEIDEL_TERMS,
        .groups = groups,
        .group_count = count + 1,
    };
    return bars_draw(&bars, &svg, error) && drawing_write(job, &svg, sink, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the sums as bars, surface by surface"),
     .scope = ARTIFACT_OF_ANSWER, .check = seidel_view_check, .make = seidel_draw},
};

static const struct explanation explanations[] = {
    {"S1", "S1 = -A^2 y D(u/n), A = n (u + y c), D = after - before", "[Welford86]",
     "third order: small apertures and fields; + 8 G (n' - n) y^4 of an asphere"},
    {"S2", "S2 = -A Abar y D(u/n), Abar = n (ubar + ybar c)", "[Welford86]", NULL},
    {"S3", "S3 = -Abar^2 y D(u/n)", "[Welford86]", NULL},
    {"S4", "S4 = -H^2 c D(1/n), H = n (y ubar - ybar u)", "[Welford86]", NULL},
    {"S5", "S5 = (Abar/A) (S3 + S4), without the division by A", "[Welford86]", NULL},
    {"C1", "C1 = A y D(dn/n), dn = n at the shorter - n at the longer wavelength", "[Welford86]",
     "first order"},
    {"C2", "C2 = Abar y D(dn/n)", "[Welford86]", NULL},
    {"W040", "W040 = S1/8, over the wavelength", "[Welford86]",
     "positive: the wavefront is ahead of its reference sphere"},
    {"W131", "W131 = S2/2, over the wavelength", "[Welford86]", NULL},
    {"W222", "W222 = S3/2, over the wavelength", "[Welford86]", NULL},
    {"W220", "W220 = (S3 + S4)/4, over the wavelength", "[Welford86]", NULL},
    {"W311", "W311 = S5/2, over the wavelength", "[Welford86]", NULL},
    {"W020c", "W020c = C1/2, over the wavelength", "[Welford86]", NULL},
    {"W111c", "W111c = C2, over the wavelength", "[Welford86]", NULL},
    {"TSC", "TSC = S1/2q, q = n' u' of the marginal ray", "[Smith05]",
     "in the paraxial image, wherever the image plane is"},
    {"CC_s", "CC_s = S2/2q, q = n' u' of the marginal ray", "[Smith05]", NULL},
    {"CC_t", "CC_t = 3 CC_s", "[Smith05]", NULL},
    {"TAC", "TAC = S3/2q, q = n' u' of the marginal ray", "[Smith05]", NULL},
    {"TPC", "TPC = S4/2q, q = n' u' of the marginal ray", "[Smith05]", NULL},
    {"DC", "DC = S5/2q, q = n' u' of the marginal ray", "[Smith05]", NULL},
    {"TAchC", "TAchC = C1/q, q = n' u' of the marginal ray", "[Smith05]", NULL},
    {"TchC", "TchC = C2/q, q = n' u' of the marginal ray", "[Smith05]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"seidel double-gauss", "which surface makes which aberration, at the edge of the field"},
    {"seidel double-gauss -N 4 --field 10deg --form transverse", "stopped down, in the image"},
    {"seidel double-gauss --form waves --csv", "wavefront coefficients for a spreadsheet"},
    {"seidel double-gauss --columns surface,S1,asphere_S1", "what the aspheres do, if any"},
    {"seidel double-gauss --plot seidel.svg", "a bar diagram"},
    {NULL, NULL},
};

/* A row a surface, and their sum. */
static double seidel_weight(const void *data)
{
    const struct lens *lens = ((const struct seidel_input *)data)->question.lens.lens;
    return lens != NULL ? (double)lens->surface_count + 1 : 1;
}

const struct command command_seidel = {
    .name = "seidel",
    .stop_size_wants = "",
    .group = "analyses",
    .summary = "third-order aberrations and colour, surface by surface",
    COMMAND_ASKS(struct seidel_input),
    COMMAND_ANSWERS(struct seidel_row),
    .run = seidel_run,
    .choose_sheet = seidel_choose_sheet,
    .sheets = all_sheets,
    .makes_many = command_always_many,
    .weight = seidel_weight,
    .varies = analysis_varies,
    .brings = analysis_brings,
    COMMAND_MAKES(artifacts),
};
