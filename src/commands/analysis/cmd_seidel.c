/* commands/analysis/cmd_seidel.c - lenscalc seidel: aberrations surface by surface. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/seidel_case.h"
#include "commands/analysis/seidel_view.h"

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
    ANALYSIS_EDGE_OPTIONS(struct seidel_input, question, NULL),
    LENS_POSITION_OPTION(struct seidel_input, question),
    LENS_SECTION_OPTION(struct seidel_input, question),
    ANALYSIS_OBJECT_OPTION(struct seidel_input, question),
    {OPTION(struct seidel_input, form), .name = "form", .words = forms, .fallback = "welford",
     .value = "FORM", .help = "how the aberrations are expressed"},
    {OPTION(struct seidel_input, chromatic), .name = "chromatic", .words = pairs,
     .fallback = "lines", .value = "PAIR", .help = "which dispersion the chromatic sums are of"},
};

struct seidel_row {
    const char *surface, *position, *lens, *warning;
    double wavelength, blue, red; /* um */
    double field, height;         /* rad; mm at the object or at the image */
    double field_x, height_x;
    double values[SEIDEL_TERMS + 1], angles[SEIDEL_TERMS + 1]; /* last: tangential coma */
    double asphere[SEIDEL_TERMS];
    double lagrange; /* mm */
};

#define PLAIN(member_name, more) COLUMN(struct seidel_row, member_name), .flags = (more)
#define LENGTH(member_name, more)                                                                  \
    COLUMN(struct seidel_row, member_name), .dimension = &dimension_length, .unit = "mm",          \
                                            .flags = (more)
#define ANGLE(member_name, more)                                                                   \
    COLUMN(struct seidel_row, member_name), .dimension = &dimension_angle, .unit = "mrad",         \
                                            .flags = (more)
#define WAVE(member_name, more)                                                                    \
    COLUMN(struct seidel_row, member_name), .dimension = &dimension_wavelength_um, .unit = "nm",   \
                                            .flags = (more) | COLUMN_EXTRA | COLUMN_ASSUMED
#define SUM(i, column_name, words)                                                                 \
    {                                                                                              \
        PLAIN(values[i], COLUMN_BRIEF), .name = (column_name), .label = (words), .help = (words)   \
    }
#define ASPHERE(i, column_name, words)                                                             \
    {                                                                                              \
        PLAIN(asphere[i], COLUMN_EXTRA), .name = (column_name), .label = (words), .help = (words)  \
    }
#define TRANSVERSE(i, column_name, words)                                                          \
    {                                                                                              \
        LENGTH(values[i], COLUMN_BRIEF | COLUMN_SPARSE), .name = (column_name), .label = (words),  \
                                                         .help = words "; absent if afocal"        \
    }
#define ANGULAR(i, column_name, words)                                                             \
    {                                                                                              \
        ANGLE(angles[i], COLUMN_BRIEF | COLUMN_SPARSE), .name = (column_name), .label = (words),   \
                                                        .help = words ", of an afocal lens"        \
    }

#define CASE_COLUMNS                                                                               \
    {WAVE(wavelength, COLUMN_ECHO), .depends = "wavelength lens position", .name = "wavelength",   \
     .label = "wavelength", .help = "of the rays"},                                                \
        LENS_POSITION_COLUMN(struct seidel_row, position, COLUMN_BRIEF),                           \
        {COLUMN(struct seidel_row, field),                                                         \
         .dimension = &dimension_angle,                                                            \
         .unit = "deg",                                                                            \
         .flags = COLUMN_EXTRA | COLUMN_ASSUMED | COLUMN_ECHO,                                     \
         .depends = "field height lens position",                                                  \
         .name = "field",                                                                          \
         .label = "field",                                                                         \
         .help = "angle of the chief ray in object space; absent for a height"},                   \
        {LENGTH(height, COLUMN_EXTRA | COLUMN_ASSUMED | COLUMN_ECHO),                              \
         .depends = "field height lens position", .name = "height", .label = "field height",       \
         .help = "of the field, at the object or at the image; absent for an angle"},              \
        {COLUMN(struct seidel_row, field_x),                                                       \
         .dimension = &dimension_angle,                                                            \
         .unit = "deg",                                                                            \
         .flags = COLUMN_EXTRA | COLUMN_ECHO,                                                      \
         .with = "field-x",                                                                        \
         .name = "field_x",                                                                        \
         .label = "field x",                                                                       \
         .help = "its angle in the x-z plane"},                                                    \
        {LENGTH(height_x, COLUMN_EXTRA | COLUMN_ECHO), .with = "height-x", .name = "height_x",     \
         .label = "field height x", .help = "of a height the same in x"},                          \
    {                                                                                              \
        PLAIN(surface, COLUMN_BRIEF), .name = "surface", .label = "surface",                       \
                                      .help = "from 1, the stop counted; last the sum"             \
    }

#define TAIL_COLUMNS                                                                               \
    {WAVE(blue, COLUMN_ECHO), .depends = "chromatic lens", .name = "blue", .label = "colour from", \
     .help = "shorter wavelength of the chromatic sums"},                                          \
        {WAVE(red, COLUMN_ECHO), .depends = "chromatic lens", .name = "red", .label = "colour to", \
         .help = "the longer one"},                                                                \
        {LENGTH(lagrange, COLUMN_EXTRA), .name = "lagrange", .label = "Lagrange invariant",        \
         .symbol = "H", .help = "n (y ubar - ybar u)"},                                            \
        LENS_TITLE_COLUMN(struct seidel_row, lens),                                                \
        LENS_WARNING_COLUMN(struct seidel_row, warning)

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
    ANGULAR(SEIDEL_SPHERICAL, "TSC", "spherical aberration of the marginal ray"),
    ANGULAR(SEIDEL_COMA, "CC_s", "sagittal coma"),
    ANGULAR(SEIDEL_TERMS, "CC_t", "tangential coma"),
    ANGULAR(SEIDEL_ASTIGMATISM, "TAC", "astigmatism"),
    ANGULAR(SEIDEL_PETZVAL, "TPC", "Petzval curvature"),
    ANGULAR(SEIDEL_DISTORTION, "DC", "distortion"),
    ANGULAR(SEIDEL_AXIAL_COLOR, "TAchC", "axial colour"),
    ANGULAR(SEIDEL_LATERAL_COLOR, "TchC", "lateral colour"),
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

static void seidel_fill(const struct seidel_case *one, const struct seidel_part *part, int form,
                        struct seidel_row *row)
{
    double values[SEIDEL_TERMS];
    bool angular = form == FORM_TRANSVERSE && seidel_is_angular(one);
    seidel_in_form(one, part, form, values);
    for (size_t i = 0; i <= SEIDEL_TERMS; i++) {
        double value = i < SEIDEL_TERMS ? values[i] : 3 * values[SEIDEL_COMA];
        row->values[i] = angular ? (double)NAN : value;
        row->angles[i] = angular ? value : (double)NAN;
    }
    for (size_t i = 0; i < SEIDEL_TERMS; i++) {
        row->asphere[i] = part->asphere[i];
    }
}

/* Where the rows go. */
struct seidel_list {
    const struct seidel_input *input;
    struct run *run;
};

static bool seidel_emit_rows(const struct seidel_case *one, void *context, struct error *error)
{
    const struct seidel_list *listing = context;
    const struct setup *setup = one->setup;
    struct run *run = listing->run;
    const size_t count = one->light.system.count;
    const bool across = setup->section == SECTION_X;
    struct seidel_row row = {
        .position = setup->position,
        .lens = setup->lens->title,
        .warning = one->warning,
        .wavelength = one->light.wavelength,
        .blue = one->blue,
        .red = one->red,
        .field = across ? one->point.field_x : one->point.field,
        .height = across ? one->point.height_x : one->point.height,
        .field_x = one->point.field_x,
        .height_x = one->point.height_x,
        .lagrange = one->seidel.lagrange,
    };
    (void)error;
    for (size_t i = 0; i <= count; i++) {
        row.surface = i < count ? arena_printf(run->arena, "%zu", i + 1) : "sum";
        seidel_fill(one, i < count ? &one->seidel.parts[i] : &one->seidel.total,
                    listing->input->form, &row);
        if (!run_emit(run, &row)) {
            break;
        }
    }
    return true;
}

static bool seidel_run(const void *data, struct run *run, struct error *error)
{
    struct seidel_list listing = {data, run};
    return seidel_each(data, run, seidel_emit_rows, &listing, error);
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the sums as bars, surface by surface"),
     .scope = ARTIFACT_OF_ANSWER, .check = seidel_view_check, .make = seidel_view_draw},
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
    {"W040",
     "W040 = S1/8, W131 = S2/2, W222 = S3/2, W220 = (S3 + S4)/4, W311 = S5/2, "
     "W020c = C1/2, W111c = C2, over the wavelength",
     "[Welford86]", "positive: the wavefront is ahead of its reference sphere"},
    {"TSC",
     "TSC = S1/2q, CC_s = S2/2q, CC_t = 3 CC_s, TAC = S3/2q, TPC = S4/2q, DC = S5/2q, "
     "TAchC = C1/q, TchC = C2/q, q = n' u' of the marginal ray",
     "[Smith05]", "in the paraxial image, wherever the image plane is"},
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
