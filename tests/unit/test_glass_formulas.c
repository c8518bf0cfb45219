/* tests/unit/test_glass_formulas.c - every formula of an index, its slope, and what is refused. */
/* SPDX-License-Identifier: MIT */
#include "optics/glass.h"
#include "optics/medium.h"
#include "ranges.h"

/* n(l) and dn/dl by the formulas of optics/glass.h with 45 decimal digits. */
static const struct {
    enum glass_formula formula;
    size_t count;
    double c[9], wavelength, n, slope;
} rows[] = {
    {GLASS_CONSTANT, 1, {1.5}, 0.5, 1.5, 0},
    {GLASS_SELLMEIER,
     6,
     {1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653},
     0.5,
     1.52141447577347682879,
     -0.066489151168445493009562},
    {GLASS_SELLMEIER,
     6,
     {1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653},
     0.75,
     1.51183642515882654617,
     -0.022708301033954574875137},
    {GLASS_SELLMEIER, 2, {0.75, 0.01}, 0.5, 1.33463478150391390135, -0.048780511019879894055243},
    {GLASS_SELLMEIER, 2, {0.75, 0.01}, 0.75, 1.32799648366759019927, -0.013875896026874532977100},
    {GLASS_SELLMEIER_SQ,
     7,
     {0.25, 0.75, 0.125, 0.5, 8, 0.0625, 0.25},
     0.5,
     1.45992210375061033361,
     -0.113813722748153538968987},
    {GLASS_SELLMEIER_SQ,
     7,
     {0.25, 0.75, 0.125, 0.5, 8, 0.0625, 0.25},
     0.75,
     1.44475173434456399539,
     -0.032580165689908695122380},
    {GLASS_SCHOTT,
     6,
     {2.25, -0.0125, 0.0125, 0.00375, -0.00125, 0.0003125},
     0.5,
     1.53521171178440402099,
     -0.329759078903571269426881},
    {GLASS_SCHOTT,
     6,
     {2.25, -0.0125, 0.0125, 0.00375, -0.00125, 0.0003125},
     0.75,
     1.50769392777281282516,
     -0.039241491304659685859169},
    {GLASS_POWER,
     9,
     {2.25, -0.0125, 2, 0.0125, -2, 0.005, -4, 0.0005, 4},
     0.5,
     1.54172184585936253120,
     -0.276395512682429464186499},
    {GLASS_POWER,
     9,
     {2.25, -0.0125, 2, 0.0125, -2, 0.005, -4, 0.0005, 4},
     0.75,
     1.51034818650635148546,
     -0.053446399344396085471667},
    {GLASS_POWER, 1, {2.25}, 0.5, 1.5, 0},
    {GLASS_POWER, 1, {2.25}, 0.75, 1.5, 0},
    {GLASS_CONRADY,
     3,
     {1.5, 0.0125, 0.0025},
     0.5,
     1.55328427124746190097,
     -0.247989898732233306832236},
    {GLASS_CONRADY,
     3,
     {1.5, 0.0125, 0.0025},
     0.75,
     1.52350933652372889794,
     -0.054154681555179301543222},
    {GLASS_HERZBERGER,
     6,
     {1.5, 0.0125, 0.0025, -0.005, 0.00125, -0.0003125},
     0.5,
     1.60585595057155973541,
     -0.715060217451861101422825},
    {GLASS_HERZBERGER,
     6,
     {1.5, 0.0125, 0.0025, -0.005, 0.00125, -0.0003125},
     0.75,
     1.52966446805809866941,
     -0.120581543283666555420699},
    {GLASS_RESONANCES,
     8,
     {1.5, -0.0125, 0.75, 0.01, 0.015, 0.5, 0.02, 64},
     0.5,
     1.52807919366470403113,
     -0.132574383261693186732008},
    {GLASS_RESONANCES,
     8,
     {1.5, -0.0125, 0.75, 0.01, 0.015, 0.5, 0.02, 64},
     0.75,
     1.50898401811126596502,
     -0.045401854137841591863352},
    {GLASS_CAUCHY,
     6,
     {1.5, 0.0125, -0.0025, 0.0005, 0.000125, -0.00003125},
     0.5,
     1.54200000,
     -0.136000000000000000000000},
    {GLASS_CAUCHY,
     6,
     {1.5, 0.0125, -0.0025, 0.0005, 0.000125, -0.00003125},
     0.75,
     1.51782397669731917559,
     -0.045513206545975940885253},
    {GLASS_CAUCHY, 1, {1.5}, 0.5, 1.5, 0},
    {GLASS_CAUCHY, 1, {1.5}, 0.75, 1.5, 0},
    {GLASS_BUCHDAHL,
     6,
     {0.5875, 1.5, -0.125, 0.0625, 0.25, -0.5},
     0.5,
     1.5143540920320,
     -0.207719864729600000000000},
    {GLASS_BUCHDAHL,
     6,
     {0.5875, 1.5, -0.125, 0.0625, 0.25, -0.5},
     0.75,
     1.48668672682822740435,
     -0.052401891494860200850141},
};

static struct glass glass_of(enum glass_formula formula, const double *c, size_t count)
{
    struct glass glass = glass_constant(pair_of(1));
    glass.formula = formula;
    glass.count = count;
    for (size_t i = 0; i < count; i++) {
        glass.coefficients[i] = pair_of(c[i]);
    }
    return glass;
}

static void test_formulas(void)
{
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct glass glass = glass_of(rows[i].formula, rows[i].c, rows[i].count);
        /* beyond the last coefficient stands what a loop too long would take in */
        for (size_t k = glass.count; k < GLASS_MOST_COEFFICIENTS; k++) {
            glass.coefficients[k] = pair_of(0.3);
        }
        struct glass_index index = glass_index(&glass, pair_of(rows[i].wavelength));
        CHECK_RELATIVE(index.n.hi, rows[i].n, 3e-16, glass_formula_name(rows[i].formula));
        CHECK_NEAR(index.slope, rows[i].slope, 2e-15, glass_formula_name(rows[i].formula));
        CHECK(glass_count_fits(rows[i].formula, rows[i].count));
    }
    const double model[] = {1.6, 40};
    const struct glass glass = glass_of(GLASS_ND_VD, model, 2);
    CHECK_RELATIVE(glass_n(&glass, 0.5), 1.60866691952974868795, 1e-15, "A + B/l^2");
    CHECK_NEAR(glass_index(&glass, pair_of(0.5)).slope, -0.125679150135951308, 1e-15, "-2 B/l^3");
    CHECK_RELATIVE(glass_n(&glass, 0.75), 1.59121148201086656188, 1e-15, "A + B/l^2");
}

/* Indices between these, by Lagrange's polynomial in 1/l^2 of the nearest four, or three. */
static const struct glass_point points[] = {{{0.4, 0}, {1.54, 0}},   {{0.5, 0}, {1.525, 0}},
                                            {{0.6, 0}, {1.5175, 0}}, {{0.7, 0}, {1.5125, 0}},
                                            {{0.8, 0}, {1.51, 0}},   {{1, 0}, {1.505, 0}}};

static void test_tables(void)
{
    static const double between[][3] = {
        {0.42, 1.53565599047798594283, -0.1911984775550175255},
        {0.45, 1.53076166823520186828, -0.1399291665499391286},
        {0.55, 1.52080805575859073170, -0.0736299094158493041},
        {0.65, 1.51461165957423934225, -0.0495922684657090922},
        {0.78, 1.51048156227441991006, -0.0240322944770038484},
        {0.9, 1.50752317746318491462, -0.0252755874120873743},
        {0.95, 1.50625671788641398641, -0.0253048547805424012},
    };
    struct glass glass = glass_of(GLASS_TABLE, NULL, 0);
    glass.table = points;
    glass.table_count = 6;
    for (size_t i = 0; i < sizeof between / sizeof *between; i++) {
        struct glass_index index = glass_index(&glass, pair_of(between[i][0]));
        CHECK_RELATIVE(index.n.hi, between[i][1], 1e-15, "two entries on each side");
        CHECK_NEAR(index.slope, between[i][2], 1e-13, "slope of a table");
    }
    glass.table_count = 3;
    CHECK_RELATIVE(glass_n(&glass, 0.45), 1.53106717379556885729, 1e-15, "three entries");
    CHECK_RELATIVE(glass_n(&glass, 0.55), 1.52068406281240104066, 1e-15, "three entries");
}

static void test_media(void)
{
    static const double nearest[][2] = {
        {0.4, 1.54000000000000000000},  {0.47, 1.52837423401988032339},
        {0.58, 1.51876205963993915317}, {0.72, 1.51186310591557505137},
        {0.97, 1.50566876735958128926}, {1, 1.50500000000000000000},
    };
    struct index_point table[6];
    for (int i = 0; i < 6; i++) {
        table[i] = (struct index_point){points[i].wavelength.hi, points[i].value};
    }
    struct medium medium = {
        .kind = MEDIUM_TABLE, .written = text_of("{tab}"), .points = table, .point_count = 6};
    struct pair n;
    for (size_t i = 0; i < sizeof nearest / sizeof *nearest; i++) {
        INSIDE(medium_index(&medium, nearest[i][0], &n, &error));
        CHECK_RELATIVE(n.hi, nearest[i][1], 1e-15, "the nearest three entries");
    }
    OUTSIDE(medium_index(&medium, 0.399, &n, &error),
            "399 nm is outside the table {tab}, which reaches from 400 to 1000 nm");
    OUTSIDE(medium_index(&medium, 1.001, &n, &error),
            "1001 nm is outside the table {tab}, which reaches from 400 to 1000 nm");
    medium.point_count = 1;
    INSIDE(medium_index(&medium, 5, &n, &error));
    CHECK_NEAR(n.hi, 1.54, 0, "a single entry holds for all light");
    medium = (struct medium){.kind = MEDIUM_CONSTANT, .written = text_of("0.5"), .index = {0.5, 0}};
    INSIDE(medium_index(&medium, 0.5, &n, &error));
    CHECK(!medium_is_air(&medium) && medium_is_air(&medium_air));
    CHECK(!medium_is_air(&(struct medium){.kind = MEDIUM_CONSTANT, .index = {1, 1e-20}}));
    CHECK(!medium_is_air(&(struct medium){.kind = MEDIUM_MODEL, .index = {1, 0}}));
    medium.index = (struct pair){0, 0};
    OUTSIDE(medium_index(&medium, 0.5, &n, &error), "the index of 0.5 at 500 nm is 0: not above 0");
    medium = (struct medium){.kind = MEDIUM_GLASS, .written = text_of("XY7")};
    OUTSIDE(medium_index(&medium, 0.5, &n, &error),
            "glass 'XY7' is in no catalogue of this program");
    medium = (struct medium){.kind = MEDIUM_MODEL, .index = {1.6, 0}, .abbe = {40, 0}};
    INSIDE(medium_index(&medium, 0.75, &n, &error));
    CHECK_RELATIVE(n.hi, 1.59121148201086656188, 1e-15, "A + B/l^2");
}

static void test_ranges(void)
{
    struct glass glass = glass_constant(pair_of(0.5));
    glass.catalog = text_of("CAT");
    glass.name = text_of("G1");
    glass.shortest = 0.4;
    glass.longest = 0.8;
    INSIDE(glass_check_range(&glass, 0.4, &error));
    INSIDE(glass_check_range(&glass, 0.8, &error));
    INSIDE(glass_check_range(&glass, 0.4 * (1 - 0.5e-12), &error));
    INSIDE(glass_check_range(&glass, 0.8 * (1 + 0.5e-12), &error));
    CHECK(!glass_check_range(&glass, 0.4 * (1 - 1.5e-12), &error));
    CHECK(!glass_check_range(&glass, 0.8 * (1 + 1.5e-12), &error));
    OUTSIDE(glass_check_range(&glass, 0.39, &error),
            "wavelength 390 nm is outside the range of CAT:G1, 400 to 800 nm");
    OUTSIDE(glass_check_range(&glass, 0.81, &error),
            "wavelength 810 nm is outside the range of CAT:G1, 400 to 800 nm");
    OUTSIDE(glass_check_range(&glass, 0, &error), "a wavelength is above 0 and finite");
    OUTSIDE(glass_check_range(&glass, INFINITY, &error), "a wavelength is above 0 and finite");
    glass.coefficients[0] = pair_of(0);
    OUTSIDE(glass_check_range(&glass, 0.5, &error),
            "the formula of CAT:G1 gives no index at 500 nm");
    static const struct {
        enum glass_formula formula;
        size_t fits[6], not [6];
    } counts[] = {
        {GLASS_CONSTANT, {1, 1, 1, 1, 1, 1}, {0, 2, 3, 4, 5, 6}},
        {GLASS_ND_VD, {2, 2, 2, 2, 2, 2}, {0, 1, 3, 4, 5, 6}},
        {GLASS_SELLMEIER, {2, 4, 6, 8, 14, 16}, {0, 1, 3, 5, 15, 18}},
        {GLASS_SELLMEIER_SQ, {3, 5, 7, 9, 13, 15}, {1, 2, 4, 6, 14, 17}},
        {GLASS_SCHOTT, {6, 6, 6, 6, 6, 6}, {0, 4, 5, 7, 8, 12}},
        {GLASS_POWER, {1, 3, 5, 7, 15, 17}, {0, 2, 4, 16, 18, 19}},
        {GLASS_CONRADY, {3, 3, 3, 3, 3, 3}, {0, 1, 2, 4, 5, 6}},
        {GLASS_HERZBERGER, {6, 6, 6, 6, 6, 6}, {0, 4, 5, 7, 8, 12}},
        {GLASS_RESONANCES, {5, 8, 11, 14, 17, 17}, {2, 4, 6, 7, 16, 20}},
        {GLASS_TABLE, {0, 0, 0, 0, 0, 0}, {1, 2, 3, 4, 5, 6}},
        {GLASS_CAUCHY, {1, 2, 3, 4, 5, 6}, {0, 7, 8, 9, 10, 11}},
        {GLASS_BUCHDAHL, {3, 4, 5, 6, 7, 8}, {0, 1, 2, 9, 10, 11}},
    };
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        for (size_t k = 0; k < 6; k++) {
            CHECK(glass_count_fits(counts[i].formula, counts[i].fits[k]));
            CHECK(!glass_count_fits(counts[i].formula, counts[i].not [k]));
        }
    }
}

/* 10 mm let 0.9 and 0.8 through at 0.5 and 0.7 um. */
static void test_transmittance(void)
{
    static const struct glass_point tau[] = {{{0.5, 0}, {0.9, 0}}, {{0.7, 0}, {0.8, 0}}};
    struct glass glass = glass_constant(pair_of(1.5));
    glass.transmittance = tau;
    glass.transmittance_count = 2;
    CHECK_RELATIVE(glass_transmittance(&glass, 0.5, 20), 0.81, 1e-15, "0.9^2");
    CHECK_RELATIVE(glass_transmittance(&glass, 0.55, 10), 0.875, 1e-15, "a quarter of the way");
    CHECK_RELATIVE(glass_transmittance(&glass, 0.65, 20), 0.680625, 1e-14, "0.825^2");
    CHECK_RELATIVE(glass_transmittance(&glass, 0.7 * (1 + 0.5e-12), 10), 0.8, 1e-15, "the end");
    CHECK(isnan(glass_transmittance(&glass, 0.7 * (1 + 1.5e-12), 10)));
    CHECK(isnan(glass_transmittance(&glass, 0.5 * (1 - 1.5e-12), 10)));
    CHECK_RELATIVE(glass_transmittance(&glass, 0.5 * (1 - 0.5e-12), 10), 0.9, 1e-15, "the end");
}

/* Each line counts, whichever way it is off: sqrt((1 + 4 + 9 + 16 + 25)/5) = sqrt 11. */
static void test_lines(void)
{
    const struct glass_lines a = {.g = {1, 0}, .F = {2, 0}, .e = {3, 0}, .d = {4, 0}, .C = {5, 0}},
                             b = {.g = {2, 0}, .F = {0, 0}, .e = {6, 0}, .d = {0, 0}, .C = {10, 0}};
    CHECK_RELATIVE(glass_difference(&a, &b), 3.31662479035539985, 1e-15, "root of the mean square");
    const double model[] = {1.6, 40};
    const struct glass glass = glass_of(GLASS_ND_VD, model, 2);
    const struct glass_summary s = glass_summary(&glass);
    CHECK_RELATIVE(s.nd, 1.6, 1e-15, "nd");
    CHECK_RELATIVE(s.Vd, 40.0, 1e-14, "Vd");
    CHECK_NEAR(s.ne, 1.6035886169765490691, 1e-13, "ne of A + B/l^2");
    CHECK_NEAR(s.Ve, 39.853371398139264888, 1e-12, "Ve of A + B/l^2");
    CHECK_NEAR(s.PgF, 0.5409648636727382525, 1e-13, "PgF of A + B/l^2");
    CHECK_NEAR(s.PdC, 0.3009978389617232538, 1e-13, "PdC of A + B/l^2");
    CHECK_NEAR(s.deviation, -0.035555136327261747, 1e-13, "deviation of A + B/l^2");
}

int main(void)
{
    test_formulas();
    test_tables();
    test_media();
    test_ranges();
    test_transmittance();
    test_lines();
    return check_report();
}
