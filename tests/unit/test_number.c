/* tests/unit/test_number.c - decimal text to double and back. */
/* SPDX-License-Identifier: MIT */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/number_powers.h"
#include "check.h"

static const struct number_scale plain = {1, 0};

enum { RANDOM_CASES = 100000 };

/* splitmix64 (Steele, Lea, Flood, OOPSLA 2014): the same numbers in every run */
static uint64_t random_bits(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

/* Of any size from 0 to 2^64 - 1. */
static uint64_t random_integer(uint64_t *state)
{
    const uint64_t bits = random_bits(state);
    return bits >> random_bits(state) % 64;
}

static double double_from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static double read_scaled(const char *text, unsigned multiplier, int power)
{
    double value = NAN;
    number_read(text, text + strlen(text), (struct number_scale){multiplier, power}, &value);
    return value;
}

/* One check with the text in the message. */
static void check_named(bool passed, const char *what, const char *text)
{
    char message[200];
    snprintf(message, sizeof message, "%s '%.120s'", what, text);
    check_at(passed, __FILE__, __LINE__, message);
}

/* ---- the table ---- */

enum { BIG_WORDS = 48 }; /* 1536 bits hold 10^340 and 2^1500 */

struct big {
    uint32_t word[BIG_WORDS]; /* the low word first */
};

static void big_multiply(struct big *big, uint32_t factor)
{
    uint64_t carry = 0;
    for (int i = 0; i < BIG_WORDS; i++) {
        carry += (uint64_t)big->word[i] * factor;
        big->word[i] = (uint32_t)carry;
        carry >>= 32;
    }
}

static void big_divide(struct big *big, uint32_t divisor)
{
    uint64_t rest = 0;
    for (int i = BIG_WORDS - 1; i >= 0; i--) {
        rest = rest << 32 | big->word[i];
        big->word[i] = (uint32_t)(rest / divisor);
        rest %= divisor;
    }
}

static int big_top_bit(const struct big *big)
{
    for (int i = 32 * BIG_WORDS - 1; i >= 0; i--) {
        if (big->word[i / 32] >> (i % 32) & 1) {
            return i;
        }
    }
    return -1;
}

/* Is this the 128 bits of `big` from its top bit down? */
static bool is_top_of(struct number_power power, const struct big *big)
{
    const int top = big_top_bit(big);
    uint128 bits = 0;
    for (int i = top; i > top - 128; i--) {
        bits = bits << 1 | (i >= 0 ? big->word[i / 32] >> (i % 32) & 1 : 0);
    }
    return bits == ((uint128)power.high << 64 | power.low);
}

/* Every entry and the logarithm, by 10^k and by floor(2^1500 / 10^k). */
static void test_powers(void)
{
    struct big big = {{1}};
    for (int k = 0; k <= NUMBER_POWER_MAX; k++) {
        CHECK(is_top_of(number_powers[k - NUMBER_POWER_MIN], &big));
        CHECK(number_log2_of_power10(k) == big_top_bit(&big));
        big_multiply(&big, 10);
    }
    big = (struct big){{0}};
    big.word[1500 / 32] = (uint32_t)1 << 1500 % 32;
    for (int k = -1; k >= NUMBER_POWER_MIN; k--) {
        big_divide(&big, 10);
        CHECK(is_top_of(number_powers[k - NUMBER_POWER_MIN], &big));
        CHECK(number_log2_of_power10(k) == big_top_bit(&big) - 1500);
    }
}

/* ---- reading ---- */

/* What belongs to the number and what does not; the grammar is that of number.h. */
static void test_read_extent(void)
{
    static const struct {
        const char *text;
        int length; /* read; -1: no number */
        double value;
    } cases[] = {
        {"0", 1, 0},
        {"-0", 2, -0.0},
        {"+7", 2, 7},
        {"1.", 2, 1},
        {".5", 2, 0.5},
        {"-.5e1", 5, -5},
        {"1.e2", 4, 100},
        {"50,2.8", 2, 50},
        {"2.8\n", 3, 2.8},
        {"1e5x", 3, 1e5},
        {"1E5", 3, 1e5},
        {"1e", 1, 1},
        {"1e+", 1, 1},
        {"1e-x", 1, 1},
        {"1.5ee", 3, 1.5},
        {"1e+05", 5, 1e5},
        {"1e-3-4", 4, 1e-3},
        {"1.2.3", 3, 1.2},
        {"0x10", 1, 0},
        {"007", 3, 7},
        {"inf", 3, INFINITY},
        {"+inf", 4, INFINITY},
        {"-inf", 4, -INFINITY},
        {"infinity", 3, INFINITY},
        {"1e999", 5, INFINITY},
        {"-1e999", 6, -INFINITY},
        {"1e-999", 6, 0},
        {"-1e-999", 7, -0.0},
        {"0e999999999999999999999999", 26, 0},
        {"1e999999999999999999999999", 26, INFINITY},
        {"1e-999999999999999999999999", 27, 0},
        {"1e9223372036854775807", 21, INFINITY},
        {"1e-9223372036854775808", 22, 0},
        {"", -1, 0},
        {"+", -1, 0},
        {"-", -1, 0},
        {".", -1, 0},
        {"-.", -1, 0},
        {".e5", -1, 0},
        {"e5", -1, 0},
        {"--1", -1, 0},
        {"+-1", -1, 0},
        {" 1", -1, 0},
        {"nan", -1, 0},
        {"-nan", -1, 0},
        {"INF", -1, 0},
        {"in", -1, 0},
        {"x", -1, 0},
        {"\xb2", -1, 0}, /* a superscript 2 in Latin-1 */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text;
        double value = 12345;
        const char *end = number_read(text, text + strlen(text), plain, &value);
        const bool none = cases[i].length < 0;
        check_named(end == (none ? NULL : text + cases[i].length), "wrong end of", text);
        check_named(same_bits(value, none ? 12345 : cases[i].value), "wrong value of", text);
    }
}

/* Every shorter view of a text ends where the view ends; nothing behind it is looked at. */
static void test_read_respects_end(void)
{
    const char text[] = "-123.456e+78";
    static const int ends[] = {-1, -1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 11, 12};
    for (int length = 0; length < (int)sizeof text; length++) {
        char *view = malloc((size_t)length + 1); /* the sanitizer guards its end */
        char *start = view + 1;
        memcpy(start, text, (size_t)length);
        double value;
        const char *end = number_read(start, start + length, plain, &value);
        CHECK(end == (ends[length] < 0 ? NULL : start + ends[length]));
        free(view);
    }
}

/* Halfway cases, the ends of the range and known troublemakers; the bits are by definition. */
static void test_read_hard(void)
{
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"9007199254740993", 0x1p53}, /* 2^53 + 1 is halfway, even below */
        {"9007199254740993.0000000000000000000000000000000001", 0x1.0000000000001p53},
        {"9007199254740992.9999999999999999999999999999999999", 0x1p53},
        {"9007199254740995", 0x1.0000000000002p53}, /* halfway, even above */
        {"4503599627370496.5", 0x1p52},             /* halfway with a fraction */
        {"4503599627370497.5", 0x1.0000000000002p52},
        {"1.00000000000000011102230246251565404236316680908203125", 1}, /* 1 + 2^-53 */
        {"1.00000000000000011102230246251565404236316680908203126", 0x1.0000000000001p0},
        {"0.999999999999999944488848768742172978818416595458984375", 1}, /* 1 - 2^-54 */
        {"0.999999999999999944488848768742172978818416595458984374", 0x1.fffffffffffffp-1},
        {"5e-324", 0x1p-1074},
        {"4.9406564584124654e-324", 0x1p-1074},
        {"2.4703282292062327e-324", 0}, /* just below 2^-1075 = 2.47032822920623272...e-324 */
        {"2.4703282292062328e-324", 0x1p-1074},
        {"7.4109846876186981e-324", 0x1p-1074}, /* 3 x 2^-1075 = 7.41098468761869816...e-324 */
        {"7.4109846876186982e-324", 0x1p-1073},
        {"2.2250738585072011e-308", 0x0.fffffffffffffp-1022}, /* the PHP and Java bugs, 2011 */
        {"2.2250738585072012e-308", 0x1p-1022},
        {"2.2250738585072014e-308", 0x1p-1022},
        {"1.7976931348623157e308", 0x1.fffffffffffffp1023},
        {"1.7976931348623158e308", 0x1.fffffffffffffp1023},
        {"1.7976931348623159e308", INFINITY},
        {"179769313486231570000000000000000000000e270", 0x1.fffffffffffffp1023},
        {"1e22", 1e22},
        {"1e23", 0x1.52d02c7e14af6p76}, /* 10^23 lies just below a tie */
        {"8.41e21", 0x1.c7e83209e90b2p72},
        {"18446744073709551615", 0x1p64},
        {"18446744073709551616", 0x1p64},
        {"00000000000000000000000000000000000001.5", 1.5},
        {"0.00000000000000000000000000000000000015e37", 1.5},
        {"1.50000000000000000000000000000000000000", 1.5},
        {"0000000000000000000000000000000000000000", 0},
        {"0.00000000000000000000000000000000000000", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text;
        check_named(same_bits(read_scaled(text, 1, 0), cases[i].value), "wrong value of", text);
    }
}

/* The same length in different units is the same double: one rounding after an exact product. */
static void test_read_units(void)
{
    CHECK(same_bits(read_scaled("2.54", 1, 1), read_scaled("1", 254, -1)));
    CHECK(same_bits(read_scaled("2.54", 1, 1), 25.4));
    CHECK(same_bits(read_scaled("5.5", 254, -1), 139.7));
    CHECK(same_bits(read_scaled("0.1", 1, 3), 100));
    CHECK(same_bits(read_scaled("1e-1", 1, 3), 100));
    CHECK(same_bits(read_scaled("10", 3048, -1), 3048));
    CHECK(same_bits(read_scaled("-0", 254, -1), -0.0));
    CHECK(same_bits(read_scaled("-inf", 254, -1), -(double)INFINITY));
    CHECK(same_bits(read_scaled("1e-320", 1, 60), 1e-260));
    CHECK(same_bits(read_scaled("1e-340", 1, 30), 1e-310));
    CHECK(same_bits(read_scaled("1e300", 1, 60), INFINITY));
    CHECK(same_bits(read_scaled("1e320", 1, -60), 1e260));
    CHECK(same_bits(read_scaled("1e-345", 1000000000, 30), 1e-306));
    CHECK(same_bits(read_scaled("9007199254740993", 1000000000, -9), 0x1p53));
    CHECK(same_bits(read_scaled("9007199254740993.00000000001", 1000000000, -9),
                    0x1.0000000000001p53));
    CHECK(same_bits(read_scaled("18446744073709551615.5", 999999999, 0),
                    strtod("18446744055262807541790448384.5", NULL)));
}

/* Against strtod of digits x multiplier, multiplied here in two halves. */
static void test_read_scaled_random(void)
{
    uint64_t state = 5;
    for (int i = 0; i < RANDOM_CASES / 4; i++) {
        const uint64_t digits = random_integer(&state);
        const uint32_t multiplier = 1 + (uint32_t)(random_bits(&state) % 1000000000);
        const int power = (int)(random_bits(&state) % 660) - 350;
        char product[40], text[60];
        const uint64_t low = digits % 10000000000 * multiplier;
        const uint64_t high = digits / 10000000000 * multiplier + low / 10000000000;
        snprintf(product, sizeof product, "%llu%010llue%d", (unsigned long long)high,
                 (unsigned long long)(low % 10000000000), power + 7);
        snprintf(text, sizeof text, "%llue%d", (unsigned long long)digits, power);
        check_named(same_bits(read_scaled(text, multiplier, 7), strtod(product, NULL)),
                    "wrong scaled value of", text);
    }
}

/* A million digits: all count, and none runs over a buffer. */
static void test_read_long(void)
{
    const size_t length = 1000000;
    char *text = malloc(length + 20);
    double value;

    /* a 7th of the tie 1 + 2^-53 to a million digits, times 7: 10^-999997 below the tie or less */
    static const char *const tie = "1.00000000000000011102230246251565404236316680908203125";
    int rest = 0;
    for (size_t i = 0; i < length; i++) {
        const char c = i < strlen(tie) ? tie[i] : '0';
        text[i] = c;
        if (c != '.') {
            rest = rest % 7 * 10 + (c - '0');
            text[i] = (char)('0' + rest / 7);
        }
    }
    CHECK(rest % 7 != 0 && text[length - 1] != '9');
    CHECK(number_read(text, text + length, (struct number_scale){7, 0}, &value) == text + length);
    CHECK(same_bits(value, 1));
    text[length - 1]++;
    number_read(text, text + length, (struct number_scale){7, 0}, &value);
    CHECK(same_bits(value, 0x1.0000000000001p0));

    /* a tie that only the millionth digit decides */
    memcpy(text, tie, strlen(tie));
    memset(text + strlen(tie), '0', length - strlen(tie));
    number_read(text, text + length, plain, &value);
    CHECK(same_bits(value, 1));
    text[length - 1] = '1';
    number_read(text, text + length, plain, &value);
    CHECK(same_bits(value, 0x1.0000000000001p0));

    /* all nines, and the same made small again by the exponent */
    memset(text, '9', length);
    CHECK(number_read(text, text + length, plain, &value) == text + length);
    CHECK(same_bits(value, INFINITY));
    memcpy(text + length, "e-1000000", 9);
    CHECK(number_read(text, text + length + 9, plain, &value) == text + length + 9);
    CHECK(same_bits(value, 1));

    /* zeros ahead, made large again by the exponent, and zeros only */
    memset(text, '0', length);
    text[1] = '.';
    text[length - 1] = '7';
    memcpy(text + length, "e1000000", 8);
    CHECK(number_read(text, text + length + 8, plain, &value) == text + length + 8);
    CHECK(same_bits(value, 700));
    text[length - 1] = '0';
    number_read(text, text + length + 8, plain, &value);
    CHECK(same_bits(value, 0));
    free(text);
}

/* Against strtod: doubles with 17 digits, with up to 800, short decimals, and exact ties. */
static void test_read_random(void)
{
    uint64_t state = 1;
    char text[1200];
    for (int i = 0; i < RANDOM_CASES; i++) {
        const double x = double_from_bits(random_bits(&state));
        if (!isfinite(x)) {
            continue;
        }
        snprintf(text, sizeof text, "%.*e", (int)(random_bits(&state) % 22), x);
        check_named(same_bits(read_scaled(text, 1, 0), strtod(text, NULL)), "wrong value of", text);
    }
    for (int i = 0; i < RANDOM_CASES; i++) {
        const uint64_t digits = random_integer(&state);
        const int power = (int)(random_bits(&state) % (i % 2 ? 60 : 700)) - (i % 2 ? 30 : 360);
        snprintf(text, sizeof text, "%llu.%03de%d", (unsigned long long)digits, i % 1000, power);
        check_named(same_bits(read_scaled(text, 1, 0), strtod(text, NULL)), "wrong value of", text);
    }
    for (int i = 0; i < RANDOM_CASES / 50; i++) {
        uint64_t bits = random_bits(&state) >> 1;
        if (i % 4 == 0) {
            bits >>= 11; /* subnormal */
        }
        const double x = double_from_bits(bits);
        const double next = double_from_bits(bits + 1);
        if (!isfinite(next) || fabs(x) > 1e300) {
            continue;
        }
        /* x, and its tie with the next one where a long double holds it; then one digit more */
        const long double tie = ((long double)x + (long double)next) / 2;
        snprintf(text, sizeof text, "%.770Le", i % 2 ? (long double)x : tie);
        check_named(same_bits(read_scaled(text, 1, 0), strtod(text, NULL)), "wrong value of", text);
        char *last = strchr(text, 'e') - 1;
        *last = '1';
        check_named(same_bits(read_scaled(text, 1, 0), strtod(text, NULL)), "wrong value of", text);
    }
}

/* ---- writing ---- */

/* Write with a guard behind NUMBER_LENGTH. */
static void write_text(char *text, double x, int digits)
{
    memset(text, '#', NUMBER_LENGTH + 1);
    char *end = digits == 0 ? number_write_shortest(text, x) : number_write_digits(text, x, digits);
    const bool fits = end - text <= NUMBER_LENGTH && text[NUMBER_LENGTH] == '#';
    CHECK(fits);
    if (fits) {
        *end = '\0';
    }
}

static void check_digits(double x, int digits)
{
    char text[NUMBER_LENGTH + 1], expected[64];
    write_text(text, x, digits);
    snprintf(expected, sizeof expected, "%.*g", digits, x);
    if (strcmp(text, expected) != 0) {
        printf("digits %d\n", digits);
        check_text_at(text, expected, __FILE__, __LINE__);
    } else {
        checks_passed++;
    }
}

/* The C library rounds correctly and defines %g; all digits of the cases that could go wrong. */
static void test_write_digits_hard(void)
{
    /* clang-format off */
    static const double cases[] = {
        0.0, -0.0, 1.0, -1.0, 0.5, 0.25, 2.5, 3.5, 9.5, 0.125, 0.375, 1e-4, 1e-5, 9.9999e-5,
        99999.5, 999999.5, 999999.4, 1234565, 1234575, 2.675, 1e15, 1e16, 1e17, 1e18, 1e21, 1e22,
        1e23, 1e100, 1e300, 1e308, 1e-300, 1e-308, 5e-324, 1e-323, 2.5e-323, 0x1p-1022,
        0x1.fffffffffffffp1023, 0x1p52, 0x1p53, 0x1p54, 0x1p55, 0x1p56, 0x1p57, 0x1p63, 0x1p64,
        0x1p128, 123456789, 1234567890123456, 12345678901234567.0, 0.1, 0.3, 1.0 / 3, 2.0 / 3,
        0.00012345, 0.99999999999999994, 99999999999999984.0, 9.5e-5, 0.00099995, INFINITY,
        -INFINITY,
    };
    /* clang-format on */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int digits = 1; digits <= 17; digits++) {
            check_digits(cases[i], digits);
            check_digits(-cases[i], digits);
        }
    }
    for (int power = -323; power <= 308; power++) {
        const double ten = pow(10, power);
        for (int digits = 1; digits <= 17; digits++) {
            check_digits(ten, digits);
            check_digits(nextafter(ten, 0), digits);
            check_digits(nextafter(ten, INFINITY), digits);
        }
    }
    char text[NUMBER_LENGTH + 1];
    CHECK(number_write_digits(text, NAN, 6) == text);
    CHECK(number_write_digits(text, -NAN, 6) == text);
    CHECK(number_write_shortest(text, NAN) == text);
}

static void test_write_digits_random(void)
{
    uint64_t state = 2;
    for (int i = 0; i < RANDOM_CASES; i++) {
        const double x = double_from_bits(random_bits(&state));
        if (!isnan(x)) {
            check_digits(x, 1 + (int)(random_bits(&state) % 17));
        }
    }
    /* ordinary sizes, with few decimals and then many ties: multiples of 2^-k and of 5 x 10^k */
    for (int i = 0; i < RANDOM_CASES; i++) {
        const double size = (double)(random_bits(&state) % 100000000);
        const int digits = 1 + (int)(random_bits(&state) % 17);
        check_digits(size / 1000, digits);
        check_digits(size / (double)(1 << random_bits(&state) % 20), digits);
        check_digits((2 * size + 1) * 5 * pow(10, (double)(random_bits(&state) % 10)),
                     i % 10 != 0 ? digits : 8);
    }
}

/* Digits from the first that is not 0 to the last that is not 0. */
static int count_digits(const char *text)
{
    int count = 0, zeros = 0;
    for (const char *c = text; *c != '\0' && *c != 'e'; c++) {
        if (*c < '0' || *c > '9' || (count == 0 && *c == '0')) {
            continue;
        }
        count++;
        zeros = *c == '0' ? zeros + 1 : 0;
    }
    return count - zeros;
}

/*
 * It reads back, one digit fewer does not, and of the decimals of that length it is the one nearest
 * to x, which printf finds. Where that one does not read back (next to a power of two, whose
 * interval is lopsided) the nearest in the interval is the only one there.
 */
static void check_shortest(double x)
{
    char text[NUMBER_LENGTH + 1], other[64], form[64];
    write_text(text, x, 0);
    check_named(same_bits(strtod(text, NULL), x), "does not read back", text);
    const int count = count_digits(text);
    if (count > 1) {
        snprintf(other, sizeof other, "%.*e", count - 2, x);
        check_named(!same_bits(strtod(other, NULL), x), "longer than need be", text);
    }
    snprintf(other, sizeof other, "%.*e", count - 1, x);
    snprintf(form, sizeof form, "%.*Le", count - 1, strtold(text, NULL));
    if (same_bits(strtod(other, NULL), x)) {
        check_named(strcmp(form, other) == 0, "not the nearest", text);
    }
}

/* The literals are the shortest and nearest forms by construction, layout as in number.h. */
static void test_write_shortest_hard(void)
{
    static const struct {
        double value;
        const char *text;
    } cases[] = {
        {0, "0"},
        {-0.0, "-0"},
        {1, "1"},
        {-1, "-1"},
        {0.1, "0.1"},
        {0.3, "0.3"},
        {0.1 + 0.2, "0.30000000000000004"},
        {2.54, "2.54"},
        {25.4, "25.4"},
        {100, "100"},
        {1.0 / 3, "0.3333333333333333"},
        {0.0001, "0.0001"},
        {0.00001, "1e-05"},
        {0.000123456789, "0.000123456789"},
        {123456, "123456"},
        {1e16, "10000000000000000"},
        {12345678901234567.0, "12345678901234568"},
        {99999999999999984.0, "99999999999999980"},
        {1e17, "1e+17"},
        {1.5e300, "1.5e+300"},
        {1e22, "1e+22"},
        {1e23, "1e+23"},
        {9007199254740993.0, "9007199254740992"},
        {0x1p-1074, "5e-324"},
        {0x1p-1073, "1e-323"},
        {0x1p-1022, "2.2250738585072014e-308"},
        {0x1.fffffffffffffp1023, "1.7976931348623157e+308"},
        {0x1p-44, "5.684341886080802e-14"}, /* a power of two: the lower half is narrow */
        {9.5367431640625e-07, "9.5367431640625e-07"},
        {INFINITY, "inf"},
        {-INFINITY, "-inf"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[NUMBER_LENGTH + 1];
        write_text(text, cases[i].value, 0);
        CHECK_TEXT(text, cases[i].text);
    }
    for (int power = -1074; power < 1024; power++) {
        const double two = ldexp(1, power);
        check_shortest(two);
        check_shortest(nextafter(two, 0) > 0 ? nextafter(two, 0) : two);
        check_shortest(nextafter(two, INFINITY));
    }
}

static void test_write_shortest_random(void)
{
    uint64_t state = 3;
    for (int i = 0; i < RANDOM_CASES; i++) {
        uint64_t bits = random_bits(&state);
        if (i % 16 == 0) {
            bits &= ~((uint64_t)0x7ff << 52);
        }
        const double x = double_from_bits(bits);
        if (isfinite(x) && x != 0) {
            check_shortest(x);
        }
    }
    for (int i = 0; i < RANDOM_CASES; i++) {
        const double size = (double)(1 + random_integer(&state));
        check_shortest(size / pow(10, (double)(random_bits(&state) % 20)));
    }
}

int main(void)
{
    test_powers();
    test_read_extent();
    test_read_respects_end();
    test_read_hard();
    test_read_units();
    test_read_scaled_random();
    test_read_long();
    test_read_random();
    test_write_digits_hard();
    test_write_digits_random();
    test_write_shortest_hard();
    test_write_shortest_random();
    return check_report();
}
