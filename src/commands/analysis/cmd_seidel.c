/* commands/analysis/cmd_seidel.c - lenscalc seidel: aberrations surface by surface. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/seidel_case.h"

#include <string.h>

static const struct word orders[] = {
    [ORDER_THIRD] = {"3", "Seidel's"},
    [ORDER_FIFTH] = {"5", "Buchdahl's twelve coefficients, in the image"},
    {NULL, NULL},
};

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
    {OPTION(struct seidel_input, order), .name = "order", .words = orders, .fallback = "3",
     .value = "ORDER", .help = "order of the aberrations"},
    {OPTION(struct seidel_input, form), .name = "form", .words = forms, .fallback = "welford",
     .wants = "order=3", .value = "FORM", .help = "how the aberrations are expressed"},
    {OPTION(struct seidel_input, chromatic), .name = "chromatic", .words = pairs,
     .fallback = "lines", .wants = "order=3", .value = "PAIR",
     .help = "wavelength pair of the chromatic sums"},
};

struct seidel_row {
    struct analysis_point point;
    const char *surface;
    double blue, red;                /* um */
    double values[SEIDEL_TERMS + 1]; /* last: tangential coma */
    bool is_angular;                 /* they are angles */
    double asphere[SEIDEL_TERMS];
    double fifth[FIFTH_TERMS], intrinsic[FIFTH_TERMS], induced[FIFTH_TERMS]; /* mm, rad */
    double lagrange;                                                         /* mm */
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

#define FIFTH_OF(part, i, more, column_name, words)                                                \
    ENTRY(COLUMN_OR(struct seidel_row, part[i], is_angular, &angle),                               \
          .dimension = &dimension_length, .unit = "mm", .flags = COLUMN_SPARSE | (more),           \
          .name = (column_name), .label = (words), .help = (words))
#define FIFTH(i, column_name, words) FIFTH_OF(fifth, i, COLUMN_BRIEF, column_name, words)
#define INTRINSIC(i, column_name)                                                                  \
    FIFTH_OF(intrinsic, i, COLUMN_EXTRA, "intrinsic_" column_name,                                 \
             column_name " of light that no surface before has aberrated")
#define INDUCED(i, column_name)                                                                    \
    FIFTH_OF(induced, i, COLUMN_EXTRA, "induced_" column_name,                                     \
             column_name " by the aberrations of the surfaces before")

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

#define TAIL_COLUMNS COLOUR_COLUMNS, END_COLUMNS

#define COLOUR_COLUMNS                                                                             \
    ENTRY(WAVE(blue, COLUMN_ECHO), .depends = "chromatic lens", .name = "blue",                    \
          .label = "colour from", .help = "shorter wavelength of the chromatic sums"),             \
        ENTRY(WAVE(red, COLUMN_ECHO), .depends = "chromatic lens", .name = "red",                  \
              .label = "colour to", .help = "the longer one")

#define END_COLUMNS                                                                                \
    ENTRY(LENGTH(lagrange, COLUMN_EXTRA), .name = "lagrange", .label = "Lagrange invariant",       \
          .symbol = "H", .help = "Lagrange invariant n (y ubar - ybar u)"),                        \
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

static const struct column fifth_columns[] = {
    CASE_COLUMNS,
    FIFTH(FIFTH_B5, "B5", "fifth-order spherical aberration"),
    FIFTH(FIFTH_F1, "F1", "linear coma, tangential"),
    FIFTH(FIFTH_F2, "F2", "linear coma"),
    FIFTH(FIFTH_M1, "M1", "oblique spherical aberration, tangential"),
    FIFTH(FIFTH_M2, "M2", "oblique spherical aberration, sagittal"),
    FIFTH(FIFTH_M3, "M3", "oblique spherical aberration, with cos^2"),
    FIFTH(FIFTH_N1, "N1", "elliptical coma, tangential"),
    FIFTH(FIFTH_N2, "N2", "elliptical coma, tangential, with cos 2 theta"),
    FIFTH(FIFTH_N3, "N3", "elliptical coma, sagittal"),
    FIFTH(FIFTH_C5, "C5", "fifth-order astigmatism"),
    FIFTH(FIFTH_PI5, "PI5", "fifth-order Petzval curvature"),
    FIFTH(FIFTH_E5, "E5", "fifth-order distortion"),
    INTRINSIC(FIFTH_B5, "B5"),
    INTRINSIC(FIFTH_F1, "F1"),
    INTRINSIC(FIFTH_F2, "F2"),
    INTRINSIC(FIFTH_M1, "M1"),
    INTRINSIC(FIFTH_M2, "M2"),
    INTRINSIC(FIFTH_M3, "M3"),
    INTRINSIC(FIFTH_N1, "N1"),
    INTRINSIC(FIFTH_N2, "N2"),
    INTRINSIC(FIFTH_N3, "N3"),
    INTRINSIC(FIFTH_C5, "C5"),
    INTRINSIC(FIFTH_PI5, "PI5"),
    INTRINSIC(FIFTH_E5, "E5"),
    INDUCED(FIFTH_B5, "B5"),
    INDUCED(FIFTH_F1, "F1"),
    INDUCED(FIFTH_F2, "F2"),
    INDUCED(FIFTH_M1, "M1"),
    INDUCED(FIFTH_M2, "M2"),
    INDUCED(FIFTH_M3, "M3"),
    INDUCED(FIFTH_N1, "N1"),
    INDUCED(FIFTH_N2, "N2"),
    INDUCED(FIFTH_N3, "N3"),
    INDUCED(FIFTH_C5, "C5"),
    INDUCED(FIFTH_PI5, "PI5"),
    INDUCED(FIFTH_E5, "E5"),
    END_COLUMNS,
};

static const struct sheet fifth_sheet = SHEET(fifth_columns, struct seidel_row);
static const struct sheet sheets[] = {
    [FORM_WELFORD] = SHEET(columns, struct seidel_row),
    [FORM_TRANSVERSE] = SHEET(transverse_columns, struct seidel_row),
    [FORM_WAVES] = SHEET(wave_columns, struct seidel_row),
};

static const struct sheet *const all_sheets[] = {&sheets[FORM_WELFORD], &sheets[FORM_TRANSVERSE],
                                                 &sheets[FORM_WAVES], &fifth_sheet, NULL};

static const struct sheet *seidel_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    const struct seidel_input *input = data;
    return input->order == ORDER_FIFTH ? &fifth_sheet : &sheets[input->form];
}

/* -------- rows -------- */

static void seidel_row_third(const struct seidel_case *one, const struct seidel_part *part,
                             int form, struct seidel_row *row)
{
    row->is_angular = form == FORM_TRANSVERSE && seidel_case_is_angular(one);
    seidel_case_in_form(one, part, form, row->values);
    row->values[SEIDEL_TERMS] = 3 * row->values[SEIDEL_COMA];
    memcpy(row->asphere, part->asphere, sizeof row->asphere);
}

static void seidel_row_fifth(const struct seidel_case *one, const struct fifth_order_part *part,
                             struct seidel_row *row)
{
    row->is_angular = seidel_case_is_angular(one);
    seidel_case_fifth(one, part->sum, row->fifth);
    seidel_case_fifth(one, part->intrinsic, row->intrinsic);
    for (size_t i = 0; i < FIFTH_TERMS; i++) {
        row->induced[i] = row->fifth[i] - row->intrinsic[i];
    }
}

static bool seidel_run(const void *data, struct run *run, struct error *error)
{
    const struct seidel_input *input = data;
    struct analysis_cursor at = analysis_begin(input, &seidel_policy, run);
    while (analysis_next(&at, error)) {
        struct seidel_case one;
        if (!seidel_case_make(&at, &one, error)) {
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
            if (input->order == ORDER_FIFTH) {
                seidel_row_fifth(&one, is_sum ? &one.fifth.total : &one.fifth.parts[i], &row);
            } else {
                seidel_row_third(&one, part, input->form, &row);
            }
            if (!run_emit(run, &row)) {
                break;
            }
        }
    }
    return error->code == ERROR_NONE;
}

static const struct artifact artifacts[] = {
    {ARTIFACT_OPTION("plot", drawing_types, "draw the sums as bars, surface by surface"),
     .scope = ARTIFACT_OF_ANSWER, .check = seidel_figure_check, .make = seidel_figure_draw},
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
    {"B5", "x = B5 rho^5 sin t, y = B5 rho^5 cos t", "[Cruickshank60]",
     "fifth order, beside the third: seventh powers are left out"},
    {"F1", "y = (F1 + F2 cos 2t) rho^4 h", "[Cruickshank60]", NULL},
    {"F2", "x = F2 rho^4 h sin 2t", "[Cruickshank60]", NULL},
    {"M1", "y = (M1 + M3 cos^2 t) rho^3 h^2 cos t", "[Cruickshank60]", NULL},
    {"M2", "x = (M2 + M3 cos^2 t) rho^3 h^2 sin t", "[Cruickshank60]", NULL},
    {"M3", "x = (M2 + M3 cos^2 t) rho^3 h^2 sin t", "[Cruickshank60]", NULL},
    {"N1", "y = (N1 + N2 cos 2t) rho^2 h^3", "[Cruickshank60]", NULL},
    {"N2", "y = (N1 + N2 cos 2t) rho^2 h^3", "[Cruickshank60]", NULL},
    {"N3", "x = N3 rho^2 h^3 sin 2t", "[Cruickshank60]", NULL},
    {"C5", "y = (5 C5 + PI5) rho h^4 cos t, x = (C5 + PI5) rho h^4 sin t", "[Cruickshank60]", NULL},
    {"PI5", "y = (5 C5 + PI5) rho h^4 cos t, x = (C5 + PI5) rho h^4 sin t", "[Cruickshank60]",
     NULL},
    {"E5", "y = E5 h^5", "[Cruickshank60]", NULL},
    {NULL, NULL, NULL, NULL},
};

static const struct example examples[] = {
    {"seidel double-gauss", "which surface makes which aberration, at the edge of the field"},
    {"seidel double-gauss -N 4 --field 10deg --form transverse", "stopped down, in the image"},
    {"seidel double-gauss --form waves --csv", "wavefront coefficients for a spreadsheet"},
    {"seidel double-gauss --columns surface,S1,asphere_S1", "what the aspheres do, if any"},
    {"seidel double-gauss --order 5", "the fifth order: Buchdahl's coefficients"},
    {"seidel double-gauss --order 5 --columns surface,B5,intrinsic_B5,induced_B5",
     "what a surface adds by itself, and by what comes before it"},
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
    .summary = "third- or fifth-order aberrations and colour, surface by surface",
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
