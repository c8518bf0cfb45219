/* tests/unit/test_sobol.c - Sobol' sequences: the table proved, known points, nets, scrambling. */
/* SPDX-License-Identifier: MIT */
#include "base/sobol.h"
#include "check.h"

#include <stdlib.h>

static int degree_of(uint32_t polynomial)
{
    int degree = 0;
    while (polynomial >> (degree + 1) != 0) {
        degree++;
    }
    return degree;
}

/* x times `a` modulo the polynomial */
static uint32_t times_x(uint32_t a, uint32_t polynomial, int degree)
{
    a <<= 1;
    return a >> degree & 1 ? a ^ polynomial : a;
}

/* Primitive: the powers of x run through all 2^s - 1 remainders before they come back to 1. */
static void test_polynomials(void)
{
    for (int d = 1; d < SOBOL_DIMENSIONS; d++) {
        const struct sobol_numbers *numbers = &sobol_numbers[d - 1];
        const int degree = degree_of(numbers->polynomial);
        uint32_t power = 1, order = 0;
        do {
            power = times_x(power, numbers->polynomial, degree);
            order++;
        } while (power != 1 && order < 1U << degree);
        CHECK(degree <= SOBOL_DEGREE && order == (1U << degree) - 1);
        CHECK(d == 1 || numbers->polynomial > sobol_numbers[d - 2].polynomial);
        for (int k = 0; k < SOBOL_DEGREE; k++) {
            CHECK(k < degree ? numbers->m[k] % 2 == 1 && numbers->m[k] < 2 << k
                             : numbers->m[k] == 0);
        }
    }
}

/*
 * Property A: of the first 2^d points in d dimensions one lies in each of the 2^d boxes of side
 * 1/2; that is, the first binary digits of v_1 .. v_d in d dimensions make a matrix with a
 * determinant that is odd, for every d. Elimination without exchanging rows shows all at once.
 * (Sobol' 1976; Joe and Kuo's numbers have it.)
 */
static void test_property_a(void)
{
    enum { N = SOBOL_DIMENSIONS };
    static unsigned char digit[N][N];
    for (int k = 0; k < N; k++) {
        digit[0][k] = k == 0;
    }
    for (int d = 1; d < N; d++) {
        const struct sobol_numbers *numbers = &sobol_numbers[d - 1];
        const int degree = degree_of(numbers->polynomial);
        for (int k = 0; k < N; k++) {
            digit[d][k] = (unsigned char)(k < degree ? numbers->m[k] >> k & 1 : 0);
            for (int i = 1; i <= degree && k >= degree; i++) {
                digit[d][k] ^= numbers->polynomial >> (degree - i) & 1 ? digit[d][k - i] : 0;
            }
        }
    }
    for (int pivot = 0; pivot < N; pivot++) {
        CHECK(digit[pivot][pivot] == 1);
        for (int row = pivot + 1; row < N; row++) {
            for (int k = N - 1; k >= pivot && digit[row][pivot]; k--) {
                digit[row][k] ^= digit[pivot][k];
            }
        }
    }
}

/*
 * Points in the order of Gray's code as scipy 1.10.1 gives them, qmc.Sobol(256, scramble=False,
 * bits=32): its g-th is the one numbered g xor g/2.
 */
static void test_known(void)
{
    static const uint32_t dimensions[] = {0, 1, 2, 3, 10, 100, 200, 255};
    static const struct {
        uint32_t i, points[8];
    } known[] = {
        {0, {0, 0, 0, 0, 0, 0, 0, 0}},
        {1,
         {0x80000000, 0x80000000, 0x80000000, 0x80000000, 0x80000000, 0x80000000, 0x80000000,
          0x80000000}},
        {3,
         {0xc0000000, 0x40000000, 0x40000000, 0x40000000, 0xc0000000, 0x40000000, 0xc0000000,
          0xc0000000}},
        {7,
         {0xe0000000, 0xe0000000, 0x20000000, 0x60000000, 0x60000000, 0x20000000, 0x20000000,
          0xe0000000}},
        {107,
         {0xd6000000, 0xd6000000, 0x02000000, 0xc6000000, 0x22000000, 0xe6000000, 0x1e000000,
          0xf6000000}},
        {540,
         {0x38400000, 0x18c00000, 0x84c00000, 0xad400000, 0x15c00000, 0xc4c00000, 0xc0c00000,
          0x3fc00000}},
    };
    struct sobol sobol;
    for (size_t d = 0; d < sizeof dimensions / sizeof *dimensions; d++) {
        sobol_open(dimensions[d], &sobol);
        for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
            const double expected = ((double)known[i].points[d] + 0.5) * 0x1p-32;
            CHECK(sobol_unit(sobol_word(&sobol, known[i].i)) == expected);
        }
    }
    /* the published beginning of dimensions 1 to 3: Joe and Kuo's program, D = 3 */
    static const double first[8][3] = {{0, 0, 0},
                                       {0.5, 0.5, 0.5},
                                       {0.75, 0.25, 0.25},
                                       {0.25, 0.75, 0.75},
                                       {0.375, 0.375, 0.625},
                                       {0.875, 0.875, 0.125},
                                       {0.625, 0.125, 0.875},
                                       {0.125, 0.625, 0.375}};
    for (uint32_t d = 0; d < 3; d++) {
        sobol_open(d, &sobol);
        for (uint32_t g = 0; g < 8; g++) {
            CHECK(sobol_unit(sobol_word(&sobol, g ^ g / 2)) - 0x1p-33 == first[g][d]);
        }
    }
}

/* The ends, exactly: words of zeros and ones. */
static void test_ends(void)
{
    CHECK(sobol_unit(0) == 0x1p-33 && sobol_unit(0xffffffff) == 1 - 0x1p-33);
    CHECK(sobol_unit(1) == 0.5 + 0x1p-33 && sobol_unit(0x80000000) == 3 * 0x1p-33);
}

/* Each dimension alone: 2^m points, wherever they begin, one in each of 2^m parts. */
static void test_strata(void)
{
    enum { COUNT = 1024 };
    struct sobol sobol;
    for (uint32_t d = 0; d < SOBOL_DIMENSIONS; d++) {
        const uint32_t scrambling = sobol_scrambling(d / 7, 3, d);
        sobol_open(d, &sobol);
        for (uint32_t from = 0; from <= 5 * COUNT; from += 5 * COUNT) {
            unsigned char seen[COUNT] = {0};
            int filled = 0;
            for (uint32_t i = from; i < from + COUNT; i++) {
                const double u = sobol_point(&sobol, scrambling, i);
                const size_t part = (size_t)(u * COUNT);
                filled += u > 0 && u < 1 && !seen[part] ? 1 : 0;
                seen[part] = 1;
            }
            CHECK(filled == COUNT);
        }
    }
}

/* The first two dimensions: a (0, m, 2)-net, one point in each box of sides 2^-i and 2^-(m-i). */
static void test_net(void)
{
    enum { BITS = 8, COUNT = 1 << BITS };
    struct sobol x, y;
    sobol_open(0, &x);
    sobol_open(1, &y);
    for (uint32_t turn = 0; turn < 40; turn++) {
        const uint32_t sx = sobol_scrambling(turn, 0, 0), sy = sobol_scrambling(turn, 0, 1);
        for (int bits = 0; bits <= BITS; bits++) {
            unsigned char seen[COUNT] = {0};
            int filled = 0;
            for (uint32_t i = turn * COUNT; i < (turn + 1) * COUNT; i++) {
                const size_t column = (size_t)(sobol_point(&x, sx, i) * (1 << bits));
                const size_t row = (size_t)(sobol_point(&y, sy, i) * (1 << (BITS - bits)));
                const size_t box = column << (BITS - bits) | row;
                filled += !seen[box];
                seen[box] = 1;
            }
            CHECK(filled == COUNT);
        }
    }
}

/* Blocks hold the points that are asked for one by one, also the last of all. */
static void test_blocks(void)
{
    static const uint32_t blocks[] = {0, 1, 6, 1000003, (1U << 25) - 1};
    struct sobol sobol;
    double points[SOBOL_BLOCK];
    sobol_open(17, &sobol);
    for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++) {
        sobol_points(&sobol, 12345, blocks[k], points);
        for (uint32_t i = 0; i < SOBOL_BLOCK; i++) {
            CHECK(points[i] == sobol_point(&sobol, 12345, blocks[k] * SOBOL_BLOCK + i));
        }
    }
}

/* Strands: place i of block b is point 2^bits i + b. */
static void test_strands(void)
{
    static const uint32_t bits[] = {0, 3, 7, 25};
    for (size_t k = 0; k < sizeof bits / sizeof *bits; k++) {
        const uint32_t last = (1U << bits[k]) - 1, blocks[] = {0, last / 3, last};
        for (uint32_t d = 0; d < SOBOL_DIMENSIONS; d += 85) {
            struct sobol one, across;
            sobol_open(d, &one);
            sobol_open_strands(d, bits[k], &across);
            for (uint32_t b = 0; b < 3; b++) {
                double points[SOBOL_BLOCK];
                sobol_points(&across, 12345, blocks[b], points);
                for (uint32_t i = 0; i < SOBOL_BLOCK; i++) {
                    CHECK(points[i] == sobol_point(&one, 12345, (i << bits[k]) + blocks[b]));
                }
            }
        }
    }
}

/* Over many scramblings every point is spread evenly, and pairs of points and dimensions alike. */
static void test_scramblings(void)
{
    enum { COUNT = 40000 };
    struct sobol x, y;
    double sum = 0, sum2 = 0, between = 0;
    int parts[16] = {0};
    sobol_open(2, &x);
    sobol_open(5, &y);
    for (uint64_t sequence = 0; sequence < COUNT; sequence++) {
        const double u = sobol_point(&x, sobol_scrambling(1, sequence, 2), 11);
        const double v = sobol_point(&y, sobol_scrambling(1, sequence, 5), 11);
        sum += u - 0.5;
        sum2 += (u - 0.5) * (u - 0.5);
        between += (u - 0.5) * (v - 0.5);
        parts[(size_t)(u * 16)]++;
    }
    const double root = sqrt((double)COUNT);
    CHECK_NEAR(sum / COUNT, 0, 4 * sqrt(1 / 12.0) / root, "mean");
    CHECK_NEAR(sum2 / COUNT, 1 / 12.0, 4 * sqrt(1 / 180.0) / root, "variance");
    CHECK_NEAR(between / COUNT, 0, 4 / 12.0 / root, "two dimensions");
    for (int i = 0; i < 16; i++) {
        CHECK_NEAR(parts[i], COUNT / 16.0, 4 * sqrt(COUNT / 16.0), "sixteenths");
    }
}

/* Root mean square error of the mean of 2^bits points, of exp(x + y + z + w) less its integral. */
static double error_of(const struct sobol sobol[4], int bits)
{
    enum { TURNS = 60 };
    const double truth = pow(exp(1) - 1, 4);
    double square = 0;
    for (uint64_t turn = 0; turn < TURNS; turn++) {
        double mean = 0;
        for (uint32_t i = 0; i < 1U << bits; i++) {
            double sum = 0;
            for (uint32_t d = 0; d < 4; d++) {
                sum += sobol_point(&sobol[d], sobol_scrambling(9, turn, d), i);
            }
            mean += exp(sum);
        }
        mean = mean / (1 << bits) - truth;
        square += mean * mean / TURNS;
    }
    return sqrt(square);
}

/*
 * What scrambling is for: the error of a smooth integral falls nearly with the power -3/2 of the
 * number of points (Owen 1997), and not with -1/2 as of random ones.
 */
static void test_convergence(void)
{
    struct sobol sobol[4];
    for (uint32_t d = 0; d < 4; d++) {
        sobol_open(d, &sobol[d]);
    }
    const double coarse = error_of(sobol, 6), fine = error_of(sobol, 10);
    CHECK(log2(coarse / fine) / 4 > 1.2);
    /* of random points: the root of (((e^2 - 1)/2)^4 - (e - 1)^8)/1024 */
    const double random = sqrt((pow((exp(2) - 1) / 2, 4) - pow(exp(1) - 1, 8)) / 1024);
    CHECK(fine < random / 20);
}

int main(void)
{
    test_polynomials();
    test_property_a();
    test_known();
    test_ends();
    test_strata();
    test_net();
    test_blocks();
    test_strands();
    test_scramblings();
    test_convergence();
    return check_report();
}
