/* tests/unit/test_glass.c - indices, dispersion, dn/dT and transmittance of glasses. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "data/glass_catalog.h"
#include "data/lines.h"
#include "optics/air.h"
#include "optics/wavelength.h"

/* N-BK7 of lensdb, whose data sheet (SCHOTT, 2014) has the numbers expected below. */
static struct glass_record find(struct lensdb *db, const char *name)
{
    struct glass_record record = {0};
    struct error error;
    CHECK(glass_find(db, text_of(name), GLASS_OWN_NAMES, db->arena, &record, &error));
    return record;
}

static void test_data_sheet(struct lensdb *db)
{
    const struct glass_record record = find(db, "n-bk7");
    const struct glass *glass = &record.glass;
    const struct {
        double um, n;
    } lines[] = {{2.3254, 1.48921},    {1.01398, 1.50731},   {0.6562725, 1.51432},
                 {0.5875618, 1.51680}, {0.5460740, 1.51872}, {0.4861327, 1.52238},
                 {0.4358343, 1.52668}, {0.4046561, 1.53024}, {0.3650146, 1.53627}};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        CHECK_NEAR(glass_n(glass, lines[i].um), lines[i].n, 5.1e-6, "index of N-BK7");
    }
    struct glass_summary summary = glass_summary(glass);
    CHECK_NEAR(summary.Vd, 64.17, 0.0051, "Vd");
    CHECK_NEAR(summary.Ve, 63.96, 0.005, "Ve");
    CHECK_NEAR(summary.PgF, 0.5349, 5e-5, "PgF");
    CHECK_NEAR(summary.deviation, -0.0009, 5.1e-5, "deviation");
    CHECK_TEXT(glass_formula_name(glass->formula), "sellmeier");
    /* internal transmittance of 10 and 25 mm */
    CHECK_NEAR(glass_transmittance(glass, 0.4, 10), 0.997, 6e-4, "tau at 400 nm, 10 mm");
    CHECK_NEAR(glass_transmittance(glass, 0.4, 25), 0.992, 1e-3, "tau at 400 nm, 25 mm");
    CHECK(isnan(glass_transmittance(glass, 0.2, 10)));
}

/* dn/dT of N-BK7, 1e-6/K, from the same sheet: means over 20 to 40 C. */
static void test_temperature(struct lensdb *db)
{
    const struct glass_record record = find(db, "SCHOTT:N-BK7");
    const struct {
        double um, relative, absolute;
    } rows[] = {{1.060, 2.4, 1.1}, {0.5460740, 3.0, 1.6}, {0.4358343, 3.5, 2.1}};
    for (size_t i = 0; i < 3; i++) {
        struct glass_state cold, warm;
        struct error error;
        CHECK_NEAR(1e6 * glass_dn_dT(&record.glass, rows[i].um, 30), rows[i].absolute, 0.051,
                   "dn/dT in vacuum");
        const struct air from = {AIR_EDLEN, 20, AIR_STANDARD_PRESSURE};
        const struct air to = {AIR_EDLEN, 40, AIR_STANDARD_PRESSURE};
        CHECK(glass_in_air(&record.glass, rows[i].um, &from, &cold, &error));
        CHECK(glass_in_air(&record.glass, rows[i].um, &to, &warm, &error));
        CHECK_NEAR(1e6 * (warm.n - cold.n) / 20, rows[i].relative, 0.08, "dn/dT in air");
        /* at the catalogue's own state nothing changes */
        CHECK_RELATIVE(cold.n, glass_n(&record.glass, rows[i].um), 1e-16, "at 20 C");
    }
}

/* Refractivity of standard air: the models agree to the 1e-8 that separates them in print. */
static void test_air(void)
{
    for (enum air_model model = AIR_EDLEN; model <= AIR_KOHLRAUSCH; model++) {
        const struct air air = {model, 15, AIR_STANDARD_PRESSURE};
        /* n = 1.000 277 at 589.3 nm (CRC Handbook: 2.77 e-4) */
        CHECK_NEAR(air_refractivity(&air, 0.5893), 2.77e-4, 5e-7, "air at the D line");
        const struct air vacuum = {model, 15, 0};
        CHECK_NEAR(air_refractivity(&vacuum, 0.5893), 0.0, 0, "vacuum");
    }
    const struct air edlen = {AIR_EDLEN, 15, AIR_STANDARD_PRESSURE};
    const struct air ciddor = {AIR_CIDDOR, 15, AIR_STANDARD_PRESSURE};
    CHECK_NEAR(air_refractivity(&edlen, 0.55), air_refractivity(&ciddor, 0.55), 3e-8, "models");
}

/* The slope of every formula against central differences: error h^2 n'''/6 and 1e-16/h. */
static void test_slopes(struct lensdb *db)
{
    static const char *const names[] = {"SCHOTT:N-BK7", "MISC:WATER", "SCHOTT:BAF3",
                                        "OHARA:S-BSL7", "HOYA:BSC7",  "CDGM:HWS1",
                                        "SUMITA:K-BK7", "MISC:CAF2",  "MISC:POLYCARB"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const struct glass_record record = find(db, names[i]);
        const double l = record.glass.formula == GLASS_HERZBERGER ? 5 : 0.6, h = 1e-4;
        double slope = glass_index(&record.glass, pair_of(l)).slope;
        double difference = (glass_n(&record.glass, l + h) - glass_n(&record.glass, l - h)) / 2 / h;
        CHECK_NEAR(slope, difference, 1e-6 * fabs(difference) + 1e-11, names[i]);
    }
}

static void test_models(void)
{
    const struct pair nd = {1.6, 0}, Vd = {40, 0};
    const struct glass model = glass_nd_vd(nd, Vd);
    CHECK_RELATIVE(glass_n(&model, WAVELENGTH_D), 1.6, 1e-15, "nd of the model");
    CHECK_RELATIVE(glass_n(&model, WAVELENGTH_F) - glass_n(&model, WAVELENGTH_C), 0.6 / 40, 1e-13,
                   "dispersion of the model");
    CHECK_RELATIVE(glass_summary(&model).Vd, 40.0, 1e-13, "Vd of the model");
    const struct glass constant = glass_constant(nd);
    CHECK_NEAR(glass_n(&constant, 0.4), 1.6, 0, "constant");
    CHECK(isnan(glass_summary(&constant).Vd));
    /* entries of n = 1.5 + 0.01/l^2, which the polynomial reproduces between them */
    struct glass_point points[6];
    for (int i = 0; i < 6; i++) {
        double l = 0.4 + 0.1 * i;
        points[i] = (struct glass_point){{l, 0}, {1.5 + 0.01 / (l * l), 0}};
    }
    struct glass table = glass_constant(nd);
    table.formula = GLASS_TABLE;
    table.table = points;
    table.table_count = 6;
    CHECK_NEAR(glass_n(&table, points[2].wavelength.hi), points[2].value.hi, 0, "an entry");
    for (double l = 0.42; l < 0.9; l += 0.03) {
        CHECK_RELATIVE(glass_n(&table, l), 1.5 + 0.01 / (l * l), 1e-15, "between entries");
        CHECK_RELATIVE(glass_index(&table, pair_of(l)).slope, -0.02 / (l * l * l), 1e-11,
                       "slope of a table");
    }
}

/* 1.1 = 1.100000000000000088817841970012523..., so 8.88e-17 is too much. */
static void test_pairs(void)
{
    struct pair value;
    const char text[] = "1.1", small[] = "-1.1e-30", many[] = "0.12345678901234567890";
    CHECK(pair_read(text, text + 3, NUMBER_UNSCALED, &value) == text + 3);
    CHECK_RELATIVE(value.lo, -8.8817841970012523e-17, 1e-15, "rest of 1.1");
    CHECK(pair_read(small, small + 8, NUMBER_UNSCALED, &value) == small + 8);
    CHECK(fabs(value.lo) < 1e-46 && fabs(value.lo) > 0);
    CHECK(pair_read(many, many + 22, NUMBER_UNSCALED, &value) == many + 22);
    CHECK(pair_read("x", "x", NUMBER_UNSCALED, &value) == NULL);
    struct pair third = pair_divide(pair_of(1), pair_of(3));
    struct pair one = pair_multiply(third, pair_of(3));
    CHECK_NEAR((one.hi - 1) + one.lo, 0.0, 1e-31, "3 x 1/3");
    struct pair root = pair_root(pair_of(2));
    struct pair two = pair_multiply(root, root);
    CHECK_NEAR((two.hi - 2) + two.lo, 0.0, 1e-30, "root 2 squared");
}

/* The constants of the program are the lines of the table. */
static void test_lines(void)
{
    static const struct {
        const char *name;
        double wavelength;
    } lines[] = {{"g", WAVELENGTH_G},       {"F'", WAVELENGTH_F_PRIME}, {"F", WAVELENGTH_F},
                 {"e", WAVELENGTH_E},       {"d", WAVELENGTH_D},        {"C", WAVELENGTH_C},
                 {"C'", WAVELENGTH_C_PRIME}};
    double wavelength;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        CHECK(lines_standard(text_of(lines[i].name), &wavelength));
        CHECK_NEAR(wavelength, lines[i].wavelength, 0, lines[i].name);
    }
    CHECK(!lines_standard(text_of("q"), &wavelength));
    CHECK(!lines_standard(text_of("c"), &wavelength));
}

static void test_names(struct lensdb *db)
{
    struct glass_record record;
    struct error error;
    CHECK(!glass_find(db, text_of("bk7"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK(error.code == ERROR_USAGE && strstr(error.message, "SUMITA:BK7 (obsolete)") != NULL);
    CHECK(!glass_find(db, text_of("N-BK8"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK_TEXT(error.hint, "did you mean 'N-BK7'?");
    CHECK(!glass_find(db, text_of("SCHOT:N-BK7"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK(glass_find(db, text_of("nbk7"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK(text_equal(record.glass.name, "N-BK7") && text_equal(record.glass.catalog, "SCHOTT"));
    /* two names that differ by nothing but a hyphen */
    CHECK(glass_find(db, text_of("c0550"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK(text_equal(record.glass.name, "C0550"));
    CHECK(glass_find(db, text_of("corning:c05-50"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK(text_equal(record.glass.name, "C05-50"));
    CHECK(!glass_check_range(&record.glass, 20, &error) && error.code == ERROR_DOMAIN);
    CHECK(!glass_find_medium(db, text_of("0/50"), GLASS_OWN_NAMES, db->arena, &record, &error));
    CHECK(glass_find_medium(db, text_of("1.5"), GLASS_OWN_NAMES, db->arena, &record, &error));
}

int main(void)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    test_data_sheet(&db);
    test_temperature(&db);
    test_air();
    test_slopes(&db);
    test_models();
    test_pairs();
    test_lines();
    test_names(&db);
    arena_free(&arena);
    return check_report();
}
