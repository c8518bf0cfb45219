/* tests/unit/test_bsdf.c - Lambert, mirror and gloss: furnaces, either way alike, densities. */
/* SPDX-License-Identifier: MIT */
#include "scene/bsdf.h"

#include "base/constants.h"
#include "check.h"

static const double cosines[] = {1, 0.999, 0.9, 0.7, 0.5, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-6};
static const double alphas[] = {0.001, 0.01, 0.05, 0.2, 0.5, 1};
static const double indices[] = {1, 1.2, 1.5, 3};
#define EACH(i, array) for (size_t i = 0; i < sizeof(array) / sizeof *(array); i++)

/* Of natural light on a medium of index n, by Snell's law and Fresnel's formulas in two angles. */
static double fresnel(double n, double c)
{
    const double t = sqrt(1 - (1 - c * c) / (n * n));
    const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return (s * s + p * p) / 2;
}

static struct vector towards(double cosine, double turn)
{
    const double sine = sqrt(1 - cosine * cosine);
    return (struct vector){sine * cos(2 * PI * turn), sine * sin(2 * PI * turn), cosine};
}

static struct bsdf glossy(const struct microfacets *coat, double colour)
{
    return (struct bsdf){.kind = MATERIAL_GLOSSY,
                         .lanes = 1,
                         .colour = {{colour}},
                         .microfacets = coat,
                         .ground = colour};
}

/* What leaves towards `out` where light 1 comes from everywhere: as chosen, points far apart. */
static double chosen(const struct bsdf *scatter, struct vector out, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        /* parts of the golden and the silver ratio */
        const double u[3] = {fmod(i * 0.4142135623730950 + 0.5, 1), (i + 0.5) / count,
                             fmod(i * 0.6180339887498949, 1)};
        struct bsdf_sample sample;
        sum += bsdf_sample(scatter, out, u, &sample) ? sample.throughput.of[0] : 0;
    }
    return sum / count;
}

/* The same, and the integral of the density, over directions: evenly by cosine and turn. */
static double integrated(const struct bsdf *scatter, struct vector out, double *density)
{
    enum { ACROSS = 200, AROUND = 100 };
    double sum = 0;
    *density = 0;
    for (int i = 0; i < ACROSS * AROUND; i++) {
        const double t = (i / AROUND + 0.5) / ACROSS; /* closer to each other along the surface */
        const struct vector in = towards(t * t, (i % AROUND + 0.5) / AROUND);
        struct radiance value;
        *density += bsdf_value(scatter, out, in, &value) * 2 * t;
        sum += value.of[0] * 2 * t;
    }
    *density *= 2 * PI / (ACROSS * AROUND);
    return sum * 2 * PI / (ACROSS * AROUND);
}

/* The coat's share by its choice alone, and what the ground adds, which no turn changes. */
static double furnace(const struct microfacets *coat, double colour, struct vector out)
{
    enum { ACROSS = 500 };
    const struct bsdf bare = glossy(coat, 0), whole = glossy(coat, colour);
    double sum = 0;
    for (int i = 0; i < ACROSS; i++) {
        const double t = (i + 0.5) / ACROSS;
        struct radiance dark, light;
        bsdf_value(&bare, out, towards(t * t, 0.3), &dark);
        bsdf_value(&whole, out, towards(t * t, 0.3), &light);
        sum += (light.of[0] - dark.of[0]) * 2 * t * 2 * PI / ACROSS;
    }
    return chosen(&bare, out, 4000) + sum;
}

/* A white ground under any coat gives back all light, neither more nor less. */
static void test_furnace(void)
{
    EACH(a, alphas)
    {
        EACH(n, indices)
        {
            struct microfacets coat;
            microfacets_open(alphas[a], indices[n], &coat);
            EACH(c, cosines)
            {
                const struct vector out = towards(cosines[c], 0.1);
                CHECK_NEAR(furnace(&coat, 1, out), 1, 1e-3, "a white furnace");
            }
        }
    }
}

/*
 * Integrals of F (o.h)/(o.z h.z) G over the slopes of all facets, by 1200 x 1200 midpoints that are
 * closer together at both ends: not over those that are seen.
 */
static void test_share(void)
{
    static const struct {
        double alpha, index;
        int node;
        double share;
    } cases[] = {{1, 1.5, 64, 0.012702},   {1, 1.5, 48, 0.033041},    {0.3, 1.5, 36, 0.149434},
                 {0.3, 3, 62, 0.217650},   {0.1, 1.33, 32, 0.311629}, {0.05, 2, 24, 0.546110},
                 {0.6, 1.1, 54, 0.004223}, {0.01, 1.5, 28, 0.747486}, {0.3, 1, 20, 0}};
    EACH(i, cases)
    {
        struct microfacets coat;
        const double root = cases[i].node / (MICROFACET_NODES - 1.0);
        microfacets_open(cases[i].alpha, cases[i].index, &coat);
        CHECK_NEAR(microfacets_albedo(&coat, root * root * root * root), cases[i].share, 3e-5,
                   "share");
    }
}

/* Of the finest facets the coat reflects what Fresnel says; without a coat the ground is bare. */
static void test_smooth(void)
{
    struct microfacets coat;
    struct radiance value;
    microfacets_open(0.001, 1.5, &coat);
    const struct bsdf bare = glossy(&coat, 0);
    for (double c = 0.1; c < 1; c += 0.1) {
        CHECK_NEAR(chosen(&bare, towards(c, 0), 3000), fresnel(1.5, c), 2e-4, "smooth");
    }
    CHECK_NEAR(fresnel(1.5, 1), 0.04, 1e-15, "((n - 1)/(n + 1))^2");
    microfacets_open(0.3, 1, &coat);
    const struct bsdf none = glossy(&coat, 0.7);
    const double density = bsdf_value(&none, towards(0.4, 0), towards(0.6, 0.3), &value);
    CHECK_NEAR(value.of[0], 0.7 * 0.6 / PI, 1e-15, "no coat");
    CHECK_NEAR(density, 0.6 / PI, 1e-15, "its density");
}

/* f(in, out) = f(out, in): light may go either way. */
static void test_reciprocity(void)
{
    EACH(a, alphas)
    {
        struct microfacets coat;
        microfacets_open(alphas[a], 1.5, &coat);
        const struct bsdf scatter = glossy(&coat, 0.6);
        EACH(i, cosines)
        {
            EACH(k, cosines)
            {
                const struct vector one = towards(cosines[i], 0.1);
                const struct vector other = towards(cosines[k], 0.56);
                struct radiance there, back;
                bsdf_value(&scatter, one, other, &there);
                bsdf_value(&scatter, other, one, &back);
                CHECK_RELATIVE(there.of[0] * one.z, back.of[0] * other.z, 1e-9, "reciprocity");
            }
        }
    }
}

/*
 * What is chosen is what the values say, and by the density that is said: it integrates to 1 but
 * for what is lost behind the surface.
 */
static void test_choice(void)
{
    static const double rough[] = {0.2, 0.5, 1};
    EACH(a, rough)
    {
        struct microfacets coat;
        microfacets_open(rough[a], 1.5, &coat);
        const struct bsdf scatter = glossy(&coat, 0.3);
        EACH(c, cosines)
        {
            if (cosines[c] < 0.25) {
                continue; /* too narrow for even steps */
            }
            const struct vector out = towards(cosines[c], 0.1);
            double density;
            const double value = integrated(&scatter, out, &density);
            CHECK_NEAR(chosen(&scatter, out, 20000), value, 3e-3 * value, "chosen");
            CHECK(density > 0.9 && density < 1.001);
        }
    }
}

static void test_lambert(void)
{
    const struct bsdf scatter = {.kind = MATERIAL_LAMBERT, .lanes = 2, .colour = {{0.5, 0.2}}};
    struct radiance value;
    struct bsdf_sample sample;
    double sum = 0;
    CHECK(bsdf_value(&scatter, towards(0.3, 0), towards(0.6, 0.7), &value) == 0.6 / PI);
    CHECK_NEAR(value.of[0], 0.5 * 0.6 / PI, 1e-16, "cos/pi");
    CHECK_NEAR(value.of[1], 0.2 * 0.6 / PI, 1e-16, "cos/pi");
    CHECK(bsdf_value(&scatter, towards(0.3, 0), (struct vector){0, 0.6, -0.8}, &value) == 0);
    CHECK(value.of[0] == 0);
    CHECK(bsdf_value(&scatter, (struct vector){0, 0.6, -0.8}, towards(0.3, 0), &value) == 0);
    for (int i = 0; i < 1000; i++) {
        const double u[3] = {0.5, (i + 0.5) / 1000, i * 0.618};
        CHECK(bsdf_sample(&scatter, towards(0.3, 0), u, &sample));
        CHECK_NEAR(sample.throughput.of[0], 0.5, 1e-15, "colour");
        CHECK_NEAR(vector_length(sample.direction), 1, 1e-15, "length");
        sum += sample.direction.z / 1000;
    }
    CHECK_NEAR(sum, 2. / 3, 1e-4, "mean cosine");
}

static void test_others(void)
{
    const struct bsdf mirror = {.kind = MATERIAL_MIRROR, .lanes = 1, .colour = {{0.9}}};
    const struct bsdf black = {.kind = MATERIAL_BLACK, .lanes = 1};
    const double u[3] = {0.5, 0.5, 0.5};
    struct radiance value;
    struct bsdf_sample sample;
    CHECK(bsdf_sample(&mirror, (struct vector){0.6, 0, 0.8}, u, &sample));
    CHECK(sample.direction.x == -0.6 && sample.direction.y == 0 && sample.direction.z == 0.8);
    CHECK(sample.throughput.of[0] == 0.9 && isinf(sample.pdf));
    CHECK(bsdf_value(&mirror, towards(0.8, 0), towards(0.8, 0.5), &value) == 0);
    CHECK(value.of[0] == 0);
    CHECK(!bsdf_sample(&mirror, (struct vector){0.6, 0, -0.8}, u, &sample));
    CHECK(!bsdf_sample(&black, (struct vector){0.6, 0, 0.8}, u, &sample));
    CHECK(bsdf_value(&black, towards(0.8, 0), towards(0.8, 0.5), &value) == 0);
}

int main(void)
{
    test_furnace();
    test_share();
    test_smooth();
    test_reciprocity();
    test_choice();
    test_lambert();
    test_others();
    return check_report();
}
