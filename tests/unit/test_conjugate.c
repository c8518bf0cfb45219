/* tests/unit/test_conjugate.c - conjugate points against worked examples and round trips. */
/* SPDX-License-Identifier: MIT */
#include "photo/conjugate.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"

#define NONE ((double)NAN)

/* Any two of the five in; all five out, lengths in mm. */
static const struct example {
    struct conjugates_given given;
    double f, s, v, m, T, tolerance; /* relative */
    const char *source;
} examples[] = {
    /* Rainer at fredmiranda.com, topic 630213: 50 mm lens at 450 mm; with a 25 mm tube 130 mm */
    {{50, 450, NONE, NONE, NONE, 0, CONJUGATES_REDUCED},
     50,
     450,
     56.25,
     0.125,
     506.25,
     1e-15,
     "fredmiranda 630213, bare"},
    {{50, NONE, 81.25, NONE, NONE, 0, CONJUGATES_REDUCED},
     50,
     130,
     81.25,
     0.625,
     211.25,
     1e-15,
     "fredmiranda 630213, with tube (211 mm also kielia.de calculator)"},
    /* taylorfrancis.com 9780080494012, ch. 22: 80 mm lens, 10 cm subject 5 cm high on film: m = 0.5
     */
    {{80, NONE, NONE, 0.5, NONE, 0, CONJUGATES_REDUCED},
     80,
     240,
     120,
     0.5,
     360,
     1e-15,
     "taylorfrancis 9780080494012-22, m = 0.5"},
    /* wiki.math.se, foerberedande fysik 4.5:1: f 50 mm, five times enlarged: a 60 mm, b 300 mm */
    {{50, NONE, NONE, 5, NONE, 0, CONJUGATES_REDUCED},
     50,
     60,
     300,
     5,
     360,
     1e-15,
     "wiki.math.se 4.5:1"},
    {{50, NONE, NONE, NONE, 360, 0, CONJUGATES_ENLARGED},
     50,
     60,
     300,
     5,
     360,
     1e-14,
     "wiki.math.se 4.5:1, from T"},
    {{50, NONE, NONE, NONE, 360, 0, CONJUGATES_REDUCED},
     50,
     300,
     60,
     0.2,
     360,
     1e-14,
     "wiki.math.se 4.5:1, reduced"},
    /* exact algebra: 1:1 is T = 4 f + hiatus */
    {{33.3, NONE, NONE, NONE, 133.2, 0, CONJUGATES_REDUCED},
     33.3,
     66.6,
     66.6,
     1,
     133.2,
     1e-6,
     "T = 4 f in decimals"},
    {{100, NONE, NONE, NONE, 390, -10, CONJUGATES_REDUCED},
     100,
     200,
     200,
     1,
     390,
     1e-15,
     "T = 4 f - 10"},
    /* ephotozine 55627: D = F (M + 1)^2/M. A 100 mm macro lens stating T = 310 mm at 1:1 has
       310/4 = 77.5 mm there: the focal length of internal focusing */
    {{NONE, NONE, NONE, 1, 310, 0, CONJUGATES_REDUCED},
     77.5,
     155,
     155,
     1,
     310,
     1e-15,
     "ephotozine 55627, internal focusing"},
    {{50, (double)INFINITY, NONE, NONE, NONE, 0, CONJUGATES_REDUCED},
     50,
     (double)INFINITY,
     50,
     0,
     (double)INFINITY,
     1e-15,
     "infinity"},
    {{NONE, (double)INFINITY, 50, NONE, NONE, 0, CONJUGATES_REDUCED},
     50,
     (double)INFINITY,
     50,
     0,
     (double)INFINITY,
     1e-15,
     "infinity from v"},
    {{50, NONE, NONE, NONE, (double)INFINITY, 0, CONJUGATES_REDUCED},
     50,
     (double)INFINITY,
     50,
     0,
     (double)INFINITY,
     1e-15,
     "infinity from T"},
};

static void test_examples(void)
{
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
        const struct example *e = &examples[i];
        struct conjugates r;
        struct error error;
        bool solved = conjugates_solve(&e->given, &r, &error);
        CHECK(solved);
        if (!solved) {
            continue;
        }
        CHECK_RELATIVE(r.f, e->f, e->tolerance, e->source);
        CHECK_RELATIVE(r.s, e->s, e->tolerance, e->source);
        CHECK_RELATIVE(r.v, e->v, e->tolerance, e->source);
        CHECK_RELATIVE(r.m, e->m, e->tolerance, e->source);
        CHECK_RELATIVE(r.T, e->T, e->tolerance, e->source);
        CHECK_NEAR(r.extension, e->v - e->f, 1e-4, e->source);
    }
}

/* What must be refused, with words of the message. */
static const struct refusal {
    struct conjugates_given given;
    enum error_code code;
    const char *words;
} refusals[] = {
    {{50, 40, NONE, NONE, NONE, 0, CONJUGATES_REDUCED},
     ERROR_DOMAIN,
     "lies within the focal length 50 mm"},
    {{50, 50, NONE, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "more than 50 mm"},
    {{50, NONE, 49, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "50 mm or more"},
    {{50, NONE, NONE, NONE, 199, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "200 mm or more"},
    {{50, NONE, NONE, NONE, 205, 10, CONJUGATES_REDUCED}, ERROR_DOMAIN, "210 mm or more"},
    {{50, NONE, NONE, NONE, (double)INFINITY, 0, CONJUGATES_ENLARGED}, ERROR_DOMAIN, "enlarged"},
    {{-50, 100, NONE, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "above 0"},
    {{50, NONE, NONE, -1, NONE, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "0 or more"},
    {{NONE, 100, NONE, NONE, 100, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "more than 100 mm"},
    {{NONE, NONE, 100, NONE, 90, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "more than 100 mm"},
    {{NONE, (double)INFINITY, NONE, 0, NONE, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "leaves"},
    {{NONE, NONE, NONE, 0, 400, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "leaves"},
    {{50, NONE, NONE, 1, NONE, NONE, CONJUGATES_REDUCED}, ERROR_DOMAIN, "hiatus"},
    /* v/s would be infinite, and f m no number */
    {{NONE, 1e-200, 1e171, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_DOMAIN, "out of range"},
    {{50, NONE, NONE, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_USAGE, "exactly two"},
    {{50, 100, 100, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_USAGE, "exactly two"},
    {{NONE, NONE, NONE, NONE, NONE, 0, CONJUGATES_REDUCED}, ERROR_USAGE, "sensor distance"},
};

static void test_refusals(void)
{
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        struct conjugates r;
        struct error error = {.code = ERROR_NONE};
        CHECK(!conjugates_solve(&refusals[i].given, &r, &error));
        CHECK(error.code == refusals[i].code);
        check_at(strstr(error.message, refusals[i].words) != NULL, __FILE__, __LINE__,
                 refusals[i].words);
    }
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Every pair of the five gives back the other three. */
static void test_pairs(void)
{
    uint64_t state = 3;
    double worst = 0;
    for (int i = 0; i < 3000; i++) {
        double f = pow(10, uniform(&state) * 3), m = pow(10, uniform(&state) * 5 - 4);
        double hiatus = (uniform(&state) - 0.5) * f;
        double all[5] = {f, f + f / m, f + f * m, m, 2 * f + f / m + f * m + hiatus};
        for (int a = 0; a < 5; a++) {
            for (int b = a + 1; b < 5; b++) {
                double g[5] = {NONE, NONE, NONE, NONE, NONE};
                g[a] = all[a];
                g[b] = all[b];
                struct conjugates_given given = {g[0],
                                                 g[1],
                                                 g[2],
                                                 g[3],
                                                 g[4],
                                                 hiatus,
                                                 m > 1 ? CONJUGATES_ENLARGED : CONJUGATES_REDUCED};
                struct conjugates r;
                struct error error;
                bool solved = conjugates_solve(&given, &r, &error);
                CHECK(solved);
                double lens = fabs(1 / r.f - 1 / r.s - 1 / r.v) * r.f;
                double sum = fabs(r.T - r.s - r.v - hiatus) / r.T;
                worst = fmax(worst, fmax(lens, sum));
                /* conditioning: an infinity-side error of f/v is amplified by 1/m, T near 4 f */
                double slack = 1e-12 * (1 / m + m) / fmin(1, fabs(1 - m));
                CHECK_RELATIVE(r.m, m, slack, "magnification from a pair");
                CHECK_RELATIVE(r.f, f, slack, "focal length from a pair");
            }
        }
    }
    CHECK_NEAR(worst, 0, 1e-11, "1/f = 1/s + 1/v and T = s + v + hiatus");
}

/* The twin focusing has s and v exchanged and the same T. */
static void test_twins(void)
{
    struct conjugates_given given = {85, NONE, NONE, NONE, 1000, 12, CONJUGATES_REDUCED};
    struct conjugates small, large;
    struct error error;
    CHECK(conjugates_solve(&given, &small, &error));
    given.choice = CONJUGATES_ENLARGED;
    CHECK(conjugates_solve(&given, &large, &error));
    CHECK(small.m < 1 && large.m > 1);
    CHECK_RELATIVE(small.twin_magnification, large.m, 1e-14, "twin");
    CHECK_RELATIVE(small.s, large.v, 1e-14, "s and v exchanged");
    CHECK_RELATIVE(small.v, large.s, 1e-14, "v and s exchanged");
}

static void test_exposure(void)
{
    static const struct {
        double N, m, P, working, factor, stops;
        const char *source;
    } rows[] = {
        {4, 1, 1, 8, 4, 2, "apug 1057535: f/4 at 1:1 is f/8, factor 4"},
        {16, 0.5, 1, 24, 2.25, 1.16992500144231237, "taylorfrancis 9780080494012-22: 2 1/4 times"},
        {2.8, 0, 0.7, 2.8, 1, 0, "infinity: nothing, whatever P"},
        {4, 1, 2, 6, 2.25, 1.16992500144231237, "Bigler via apug: N (1 + m/P)"},
        {4, 1, 0.5, 12, 9, 3.16992500144231237, "the same lens reversed, its N/P still 4"},
    };
    struct conjugates_exposure e;
    struct error error;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        CHECK(conjugates_exposure(rows[i].N, rows[i].m, rows[i].P, &e, &error));
        CHECK_NEAR(e.working_fnumber, rows[i].working, 1e-14, rows[i].source);
        CHECK_NEAR(e.factor, rows[i].factor, 1e-14, rows[i].source);
        CHECK_NEAR(e.stops, rows[i].stops, 1e-14, rows[i].source);
    }
    CHECK(!conjugates_exposure(0, 1, 1, &e, &error));
    CHECK(!conjugates_exposure(4, -1, 1, &e, &error));
    CHECK(!conjugates_exposure(4, 1, NONE, &e, &error));
}

static void test_distances(void)
{
    double d;
    struct error error;
    CHECK(conjugates_working_distance(130, 20, &d, &error));
    CHECK_NEAR(d, 110, 0, "working distance");
    CHECK(!conjugates_working_distance(130, 130, &d, &error));
    CHECK(strstr(error.message, "inside the lens") != NULL);
    CHECK_NEAR(conjugates_pupil_distance(50, 0.5, 1), 150, 1e-13, "P = 1: the principal plane");
    CHECK_NEAR(conjugates_pupil_distance(50, 0.5, 2), 125, 1e-13, "P = 2: f/2 nearer");
    CHECK(isinf(conjugates_pupil_distance(50, 0, 1)));
}

int main(void)
{
    test_examples();
    test_refusals();
    test_pairs();
    test_twins();
    test_exposure();
    test_distances();
    return check_report();
}
