/* tests/unit/test_reciprocity.c - reciprocity failure of films. */
/* SPDX-License-Identifier: MIT */
#include <stdint.h>

#include "check.h"
#include "photo/reciprocity.h"

static struct error error;

#define COUNT(table) ((int)(sizeof(table) / sizeof *(table)))

/* The lines of data/photo/film-reciprocity.tsv that differ in form. */
enum film {
    HP5,
    DELTA_100,
    TRI_X,
    TMAX_100,
    PORTRA,
    ACROS,
    PROVIA,
    PROVIA_400X,
    VELVIA,
    FOMA,
    BOND
};
static const struct {
    const char *model, *parameters;
    double onset, valid_to;
} films[] = {
    [HP5] = {"power", "p=1.31", 1, NAN},
    [DELTA_100] = {"power", "p=1.26", 1, NAN},
    [TRI_X] = {"table", "0.1:0.1;1:2;10:50;100:1200", 0.1, 100},
    [TMAX_100] = {"table", "0.1:0.1;1:1.26;10:15;100:200", 0.1, 100},
    [PORTRA] = {"none", "no correction 1/10000..1 s; longer: test", 1, 1},
    [ACROS] = {"stops", "<120:0;120-1000:+1/2", 120, 1000},
    [PROVIA] = {"stops", "<=128:0;240:+1/3 (2.5G);480:+1/2? not given", 128, 480},
    [PROVIA_400X] = {"stops", "<=60:0;>=120:needs correction", 60, -1},
    [VELVIA] = {"stops", "<=1:0;4:+1/3;8:+1/2;16:+2/3;32:+1;>=64:not recommended", 1, 32},
    [FOMA] = {"table", "0.5:0.5;1:2;10:80;100:1600", 0.5, 100},
    [BOND] = {"gainer", "a=0.101", 0, -1},
};

static double draw(double low, double high)
{
    static uint64_t state = 411566;
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return low + (high - low) * ((double)((state * 2685821657736338717u) >> 11) * 0x1p-53);
}

static struct reciprocity load(enum film film)
{
    struct reciprocity model;
    CHECK(reciprocity_parse(text_of(films[film].model), text_of(films[film].parameters),
                            films[film].onset, films[film].valid_to, &model, &error));
    return model;
}

static void test_published(void)
{
    static const struct {
        enum film film;
        double Tm, Tc, tolerance;
        const char *source;
    } rows[] = {
        {HP5, 10, 20.4, 0.05, "Ilford, Film Reciprocity Failure Compensation: 10 s is 20.4 s"},
        {HP5, 1, 1, 0, "Ilford: one second or less needs no compensation"},
        {HP5, 0.01, 0.01, 0, "Ilford"},
        {HP5, 30, 86, 0.6, "flogvit.com HP5+: 30 s is 1 m 26 s"},
        {HP5, 60, 213, 0.6, "flogvit.com HP5+: 1 m is 3 m 33 s"},
        {HP5, 120, 529, 0.6, "flogvit.com HP5+: 2 m is 8 m 49 s"},
        {HP5, 240, 1312, 0.6, "flogvit.com HP5+: 4 m is 21 m 52 s"},
        {HP5, 480, 3254, 0.6, "flogvit.com HP5+: 8 m is 54 m 14 s"},
        {HP5, 100, 417, 0.5, "film-reciprocity.tsv, note of the Gainer line"},
        {DELTA_100, 100, 331.13, 0.01, "100^1.26 = 10^2.52"},
        {TRI_X, 0.1, 0.1, 0, "Kodak F-4017: 1/10 s none"},
        {TRI_X, 0.01, 0.01, 0, "Kodak F-4017"},
        {TRI_X, 1, 2, 1e-15, "Kodak F-4017: 1 s is 2 s"},
        {TRI_X, 10, 50, 1e-13, "Kodak F-4017: 10 s is 50 s"},
        {TRI_X, 100, 1200, 1e-12, "Kodak F-4017: 100 s is 1200 s"},
        {TRI_X, 31.622776601683793, 244.94897427831781, 1e-11, "log-log midway: sqrt(50 1200)"},
        {TMAX_100, 10, 15, 1e-13, "Kodak F-4016: 10 s is 15 s"},
        {FOMA, 100, 1600, 1e-12, "Foma: 100 s x 16"},
        {PORTRA, 1, 1, 0, "Kodak E-4050: no adjustment to 1 s"},
        {ACROS, 119, 119, 0, "Fujifilm: none below 120 s"},
        {ACROS, 120, 169.705627, 1e-6, "Fujifilm: +1/2 stop from 120 s"},
        {ACROS, 500, 707.106781, 1e-6, "Fujifilm: +1/2 stop to 1000 s"},
        {ACROS, 1000, 1414.213562, 1e-6, "Fujifilm: +1/2 stop to 1000 s"},
        {PROVIA, 128, 128, 0, "Fujifilm AF3-036E: none to 128 s"},
        {PROVIA, 240, 302.381052, 1e-6, "Fujifilm AF3-036E: 240 s +1/3 stop"},
        {PROVIA_400X, 60, 60, 0, "Fujifilm bulletin: none to 1 min"},
        {VELVIA, 1, 1, 0, "Fujifilm AF3-960E"},
        {VELVIA, 4, 5.039684, 1e-6, "Fujifilm AF3-960E: 4 s +1/3"},
        {VELVIA, 8, 11.313708, 1e-6, "Fujifilm AF3-960E: 8 s +1/2"},
        {VELVIA, 16, 25.398417, 1e-6, "Fujifilm AF3-960E: 16 s +2/3"},
        {VELVIA, 32, 64, 1e-12, "Fujifilm AF3-960E: 32 s +1"},
        {VELVIA, 2, 2.244924, 1e-6, "stops linear in log time: 1/6 at 2 s"},
        {BOND, 100, 275, 0.8, "film-reciprocity.tsv: HP5+ by Gainer 275 s"},
        {BOND, 1, 1.101, 1e-15, "Gainer: correction at 1 s is 0.101 s"},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        struct reciprocity film = load(rows[i].film);
        double Tc = NAN, Tm = NAN;
        CHECK(reciprocity_corrected(&film, rows[i].Tm, &Tc, &error));
        const bool printed = rows[i].source[0] >= 'A' && rows[i].source[0] <= 'Z'; /* a name */
        check_source(printed ? "films" : NULL, "s");
        CHECK_NEAR(Tc, rows[i].Tc, rows[i].tolerance, rows[i].source);
        check_source(NULL, "");
        CHECK(reciprocity_metered(&film, Tc, &Tm, &error));
        CHECK_RELATIVE(Tm, rows[i].Tm, 1e-13, rows[i].source);
    }
    CHECK_NEAR(reciprocity_stops(100, 1200), 3.585, 5e-4, "film-reciprocity.tsv: 12 x is 3.58");
    CHECK_NEAR(reciprocity_stops(10, 20.4), 1.03, 0.005, "tools.gera.services: HP5 10 s, +1.03");
}

static void test_outside(void)
{
    static const struct {
        enum film film;
        double Tm, Tc; /* refused as metered, as corrected; NaN: not tried */
        const char *names;
    } rows[] = {{PORTRA, 2, 2, "up to 1 s"},
                {TRI_X, 101, 1201, "published range"},
                {ACROS, 1001, 1500, "published range"},
                {ACROS, NAN, 150, "jumps from 120 s to 169.7"},
                {PROVIA, 300, 400, "published range"},
                {PROVIA_400X, 61, 61, "up to 60 s"},
                {VELVIA, 33, 65, "published range"},
                {HP5, 0, 0, "above 0"},
                {HP5, -1, -1, "above 0"},
                {HP5, INFINITY, INFINITY, "above 0"},
                {BOND, 1e300, INFINITY, NULL}};
    for (int i = 0; i < COUNT(rows); i++) {
        struct reciprocity film = load(rows[i].film);
        double T = NAN;
        error.code = ERROR_NONE;
        CHECK(isnan(rows[i].Tm) || !reciprocity_corrected(&film, rows[i].Tm, &T, &error));
        CHECK(!reciprocity_metered(&film, rows[i].Tc, &T, &error));
        CHECK(error.code == ERROR_DOMAIN);
        CHECK(rows[i].names == NULL || strstr(error.message, rows[i].names) != NULL);
    }
    struct reciprocity film = load(HP5);
    double T = NAN;
    /* T^2 from 4 s on: just those have been 16 s, less is what no time has become */
    film.p = 2;
    film.onset = 4;
    film.valid_to = INFINITY;
    CHECK(reciprocity_metered(&film, 16, &T, &error) && T == 4);
    CHECK(!reciprocity_metered(&film, 15.999, &T, &error));
    CHECK(!reciprocity_corrected(&film, NAN, &T, &error));
    CHECK(!reciprocity_metered(&film, NAN, &T, &error));
}

/* Back and forth, ascending, never shortened; over the whole published range. */
static void test_properties(void)
{
    for (int k = 0; k < COUNT(films); k++) {
        struct reciprocity film = load((enum film)k);
        double top = isfinite(film.valid_to) ? log2(film.valid_to) : 20;
        for (int i = 0; i < 2000; i++) {
            double Tm = exp2(draw(-12, top)), Tc = NAN, more = NAN, back = NAN;
            CHECK(reciprocity_corrected(&film, Tm, &Tc, &error));
            CHECK(reciprocity_corrected(&film, Tm * (1 - 1e-6), &more, &error));
            CHECK(reciprocity_metered(&film, Tc, &back, &error));
            CHECK_RELATIVE(back, Tm, 1e-12, films[k].parameters);
            CHECK(Tc >= Tm && more < Tc);
        }
    }
    struct reciprocity film = load(BOND);
    for (int e = -29; e <= 29; e++) {
        double Tm = NAN, Tc = NAN;
        CHECK(reciprocity_metered(&film, pow(10, e), &Tm, &error));
        CHECK(reciprocity_corrected(&film, Tm, &Tc, &error));
        CHECK_RELATIVE(Tc, pow(10, e), 1e-12, "Gainer's inverse at any size");
    }
}

static void test_bad_text(void)
{
    static const struct {
        const char *model, *parameters;
        double onset, valid_to;
    } bad[] = {{"power", "", 1, 1},
               {"power", "q=1.3", 1, 1},
               {"power", "p=", 1, 1},
               {"power", "p=1.3x", 1, 1},
               {"power", "p=0.9", 1, 1},
               {"power", "p=1.3", 0.5, 1},
               {"power", "p=inf", 1, 1},
               {"power", "p=1.3", NAN, 1},
               {"power", "p=1.3", -1, 1},
               {"table", "", 0, 1},
               {"table", "1", 0, 1},
               {"table", "1:", 0, 1},
               {"table", "1:1;2:1", 0, 1},
               {"table", "1:1;1:2", 0, 1},
               {"table", "1:2;10:50", 0, 1},
               {"table", "1:1;10:5", 0, 1},
               {"table", "1:1,10:50", 0, 1},
               {"table", "1:1;10:50;20:40", 0, 1},
               {"table", "0:0;1:1", 0, 1},
               {"table",
                "1:1;2:2;3:3;4:4;5:5;6:6;7:7;8:8;9:9;10:10;11:11;12:12;13:13;14:14;"
                "15:15;16:16;17:17",
                0, 1},
               {"stops", "", 0, 1},
               {"stops", "<=1:0;4:+1/0", 0, 1},
               {"stops", "<=1:0;4:+1/3x", 0, 1},
               {"stops", "<=1:0;4", 0, 1},
               {"stops", "<=1:0;;4:1", 0, 1},
               {"stops", "4:+1/3", 0, 1},
               {"stops", "?", 0, 1},
               {"gainer", "a=0", 0, 1},
               {"gainer", "a=-1", 0, 1},
               {"none", "words", 1, -1},
               {"schwarzschild", "p=0.8", 1, 1},
               {"", "", 1, 1}};
    for (int i = 0; i < COUNT(bad); i++) {
        struct reciprocity film;
        error.code = ERROR_NONE;
        bool read = reciprocity_parse(text_of(bad[i].model), text_of(bad[i].parameters),
                                      bad[i].onset, bad[i].valid_to, &film, &error);
        check_at(!read && error.code == ERROR_DATA, __FILE__, __LINE__, bad[i].parameters);
    }
    struct reciprocity none;
    CHECK(!reciprocity_parse(text_of("table"), text_of("1:1;x:2"), 0, 1, &none, &error));
    CHECK_NEAR(error.caret, 5, 0, "the caret stands under the x");
    /* a text that does not end in NUL is read to its length only */
    struct reciprocity film;
    CHECK(reciprocity_parse(text_of("power"), (struct text){"p=1.319", 6}, 1, NAN, &film, &error));
    CHECK_NEAR(film.p, 1.31, 0, "six characters");
}

int main(void)
{
    test_published();
    test_outside();
    test_properties();
    test_bad_text();
    return check_report();
}
