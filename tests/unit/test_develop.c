/* tests/unit/test_develop.c - whites, their adaptation, and raw data developed. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/develop.h"
#include "check.h"

static struct arena memory;
static struct arena *const arena = &memory;
static struct error error;

static void check_white(struct colour white, double x, double y, double tolerance, const char *what)
{
    const double sum = white.part[0] + white.part[1] + white.part[2];
    CHECK_NEAR(white.part[0] / sum, x, tolerance, what);
    CHECK_NEAR(white.part[1] / sum, y, tolerance, what);
    CHECK_NEAR(white.part[1], 1, 1e-12, what);
}

/* Chromaticities of CIE 15:2004 tables T.3 and of Planck's law over its observer. */
static void test_whites(void)
{
    static const struct {
        double kelvin, x, y, tolerance;
    } whites[] = {
        {5003, 0.3457, 0.3585, 1e-4}, /* D50 */
        {5503, 0.3324, 0.3474, 2e-4}, /* D55 */
        {6504, 0.3127, 0.3290, 2e-4}, /* D65 */
        {7504, 0.2990, 0.3149, 1e-4}, /* D75 */
        {2856, 0.4476, 0.4074, 6e-4}, /* A */
        {2000, 0.5267, 0.4133, 6e-4}, /* black bodies */
        {3200, 0.4234, 0.3990, 6e-4},
    };
    struct colour white, below;
    for (size_t i = 0; i < sizeof whites / sizeof *whites; i++) {
        CHECK(colour_white(whites[i].kelvin, &white, &error));
        check_white(white, whites[i].x, whites[i].y, whites[i].tolerance, "white");
    }
    check_white(colour_daylight(), 0.3127, 0.3290, 1e-4, "daylight");
    check_white(colour_tungsten(), 0.44757, 0.40745, 1e-12, "tungsten");
    /* both sides of 7000 K meet, and 4000 K is where the two lie apart */
    CHECK(colour_white(7000, &white, &error) && colour_white(7000.01, &below, &error));
    CHECK_NEAR(white.part[2], below.part[2], 1e-3, "7000 K");
    CHECK(!colour_white(1666, &white, &error) && !colour_white(25001, &white, &error) &&
          !colour_white(NAN, &white, &error));
}

/* D50 to D65 in XYZ, of CSS Color Module 4; its whites differ from sRGB's by 1e-4. */
static void test_bradford(void)
{
    static const struct colour_matrix published = {
        {{0.9554734527042182, -0.023098536874261423, 0.0632593086610217},
         {-0.028369706963208136, 1.0099954580058226, 0.021041398966943008},
         {0.012314001688319899, -0.020507696433477912, 1.3303659366080753}}};
    const struct colour d50 = {{0.3457 / 0.3585, 1, (1 - 0.3457 - 0.3585) / 0.3585}};
    const struct colour_matrix back = colour_inverse(&colour_xyz_of_srgb);
    struct colour_matrix balance, in_xyz;
    CHECK(colour_balance(d50, &balance, &error));
    in_xyz = colour_product(&balance, &back);
    in_xyz = colour_product(&colour_xyz_of_srgb, &in_xyz);
    for (int i = 0; i < 9; i++) {
        CHECK_NEAR(in_xyz.at[i / 3][i % 3], published.at[i / 3][i % 3], 3e-4, "Bradford");
    }
    /* the white becomes equal parts of its own luminance; sRGB's own changes nothing */
    const struct colour white = colour_tungsten();
    const struct colour twice = {{2 * white.part[0], 2, 2 * white.part[2]}};
    CHECK(colour_balance(twice, &balance, &error));
    const struct colour made = colour_turned(&balance, colour_turned(&back, white));
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(made.part[k], 1, 1e-12, "white");
    }
    CHECK(colour_balance(colour_daylight(), &balance, &error));
    for (int i = 0; i < 9; i++) {
        CHECK_NEAR(balance.at[i / 3][i % 3], i % 4 == 0, 1e-12, "nothing");
    }
    CHECK(!colour_balance((struct colour){{0, 0, 0}}, &balance, &error) &&
          !colour_balance((struct colour){{1, 1, -1}}, &balance, &error) &&
          !colour_balance((struct colour){{NAN, 1, 1}}, &balance, &error) &&
          !colour_balance((struct colour){{INFINITY, 1, 1}}, &balance, &error));
}

/* One colour in lx s, seen by a sensor without noise at ISO 100, and developed. */
static bool developed(const struct image_sensor *sensor, const double light[3],
                      const struct develop_way *way, float picture[3])
{
    const struct sensor_setting setting = {
        .iso = 100, .gain = NAN, .time = 1, .temperature = 20, .noiseless = true};
    const struct sensor_place place = {0, 0, 2};
    struct sensor_model model;
    struct image exposed = {.width = 2, .height = 1, .channels = 3};
    struct sensor_raw raw;
    struct developed made;
    CHECK(image_new(&exposed, arena, &error));
    for (int i = 0; i < 6; i++) {
        exposed.pixels[i] = (float)light[i % 3];
    }
    CHECK(sensor_open(sensor, &setting, &model, &error) &&
          sensor_expose(&model, &exposed, &place, arena, &raw, &error));
    if (!develop_picture(&model, &raw.image, way, arena, &made, &error)) {
        return false;
    }
    memcpy(picture, made.picture.pixels, 3 * sizeof *picture);
    return made.picture.channels == 3;
}

/*
 * Grey metered at ISO 100, 0.1 lx s, is sqrt(2) 10/78 = 0.1813; white is 0.78/sqrt(2); a colour
 * keeps its parts, whatever the channels see and however the electrons differ; what is lost is half
 * a step of 16 bits.
 */
static void test_developed(void)
{
    static const double grey[3] = {0.1, 0.1, 0.1}, white[3] = {0.551543, 0.551543, 0.551543};
    static const double colour[3] = {0.3, 0.02, 0.11};
    const struct develop_way plain = {.white = BALANCE_DAYLIGHT, .headroom = DEVELOP_HEADROOM};
    float made[3];
    for (int response = 0; response < SENSOR_RESPONSES; response++) {
        struct image_sensor sensor = sensor_plain(0.006);
        sensor.response = (enum sensor_response)response;
        sensor.bits = 16;
        sensor.black = 512;
        sensor.dark_current = 40;
        sensor.efficiency[0] = 0.4;
        sensor.efficiency[2] = 0.3;
        for (int k = 0; k < 3; k++) {
            CHECK(developed(&sensor, grey, &plain, made));
            CHECK_NEAR((double)made[k], 0.181311, 5e-5, "grey");
            CHECK(developed(&sensor, white, &plain, made));
            CHECK_NEAR((double)made[k], 1, 5e-5, "white");
            CHECK(developed(&sensor, colour, &plain, made));
            const double luminance = 0.2126 * 0.3 + 0.7152 * 0.02 + 0.0722 * 0.11;
            CHECK_NEAR((double)made[k],
                       1.813109 * (response == SENSOR_MONO ? luminance : colour[k]), 1e-4,
                       "colour");
        }
    }
}

/*
 * A full well of 20000 electrons: light of half as many is half of a full pixel's, whatever the
 * channels see, the black level and the balance of white; half a number may be missing.
 */
static void test_fill(void)
{
    const struct sensor_setting setting = {
        .iso = 100, .gain = NAN, .time = 1, .temperature = 20, .noiseless = true};
    const struct sensor_place place = {0, 0, 1};
    for (int response = 0; response < SENSOR_RESPONSES; response++) {
        for (int white = 0; white < 2; white++) {
            struct image_sensor sensor = sensor_plain(0.006);
            sensor.response = (enum sensor_response)response;
            sensor.black = 200;
            sensor.full_well = 20000;
            const struct develop_way way = {
                .white = white > 0 ? BALANCE_TUNGSTEN : BALANCE_DAYLIGHT, .headroom = 1};
            /* 0.5 of 4.0906683948e9 photons a mm^2 and lx s on (0.006 mm)^2; white has X 0.9505 */
            const double half = 10000 / (0.5 * 4.0906683948e9 * 0.006 * 0.006);
            struct image light = {.width = 1, .height = 1, .channels = 3};
            struct sensor_model model;
            struct sensor_raw raw;
            struct developed made;
            CHECK(image_new(&light, arena, &error));
            light.pixels[0] = light.pixels[1] = light.pixels[2] = (float)half;
            CHECK(sensor_open(&sensor, &setting, &model, &error) &&
                  sensor_expose(&model, &light, &place, arena, &raw, &error) &&
                  develop_picture(&model, &raw.image, &way, arena, &made, &error));
            const float *seen = made.picture.pixels;
            const struct colour fill = colour_turned(
                &made.fill, (struct colour){{(double)seen[0], (double)seen[1], (double)seen[2]}});
            const double X = 0.4124 + 0.3576 + 0.1805;
            const double wanted = response == SENSOR_XYZ ? 0.5 * X : 0.5;
            CHECK_NEAR(fill.part[0], wanted, 3e-4, "red");
            CHECK_NEAR(fill.part[1], 0.5, 3e-4, "green");
        }
    }
}

/*
 * Channels of which one sees a colour alone and two see two alike, but for a share e: the sums of
 * their matrix and of its inverse are 5 + e and 2 + 4/e, whose product may be up to 1e4.
 */
static void test_alike(void)
{
    static const double shares[] = {0.0021, 0.0019}; /* at 0.0020028 it is 1e4 */
    const struct develop_way way = {.white = BALANCE_DAYLIGHT, .headroom = 1};
    for (int turn = 0; turn < 3; turn++) {
        for (int k = 0; k < 2; k++) {
            const double pair[2][2] = {{1, 1}, {1, 1 + shares[k]}};
            struct colour_matrix seen = {{{0}}};
            seen.at[turn][turn] = 1;
            for (int i = 0; i < 4; i++) {
                seen.at[(turn + 1 + i / 2) % 3][(turn + 1 + i % 2) % 3] = pair[i / 2][i % 2];
            }
            const struct sensor_response_traits traits = {
                .word = "a table", .channels = 3, .seen = &seen, .names = {"R", "G", "B"}};
            struct image_sensor sensor = sensor_plain(0.006);
            float made[3];
            sensor.table = &traits;
            CHECK(developed(&sensor, (const double[3]){0.1, 0.1, 0.1}, &way, made) == (k == 0));
        }
    }
    CHECK_TEXT(error.message,
               "the channels of the sensor see too much the same to make colours of them");
}

static void test_balanced(void)
{
    const struct image_sensor sensor = sensor_plain(0.006);
    const struct colour_matrix back = colour_inverse(&colour_xyz_of_srgb);
    struct colour lamp = colour_turned(&back, colour_tungsten()), warm;
    struct develop_way way = {.white = BALANCE_TUNGSTEN, .headroom = 1};
    float made[3];
    for (int k = 0; k < 3; k++) {
        lamp.part[k] *= 0.2;
    }
    CHECK(developed(&sensor, lamp.part, &way, made));
    CHECK_NEAR((double)made[0], 0.2 / 0.78, 2e-4, "lamp, red");
    CHECK_NEAR((double)made[2], 0.2 / 0.78, 2e-4, "lamp, blue");
    way.white = BALANCE_AUTO;
    CHECK(developed(&sensor, lamp.part, &way, made));
    CHECK_NEAR((double)made[2] / (double)made[0], 1, 1e-5, "automatic");
    way = (struct develop_way){.white = BALANCE_KELVIN, .kelvin = 3400, .headroom = 1};
    CHECK(colour_white(3400, &warm, &error));
    warm = colour_turned(&back, warm);
    for (int k = 0; k < 3; k++) {
        warm.part[k] *= 0.3;
    }
    CHECK(developed(&sensor, warm.part, &way, made));
    CHECK_NEAR((double)made[1] / (double)made[2], 1, 2e-4, "3400 K");
    /* daylight taken for a lamp's light is blue; a lamp by daylight is red */
    way.white = BALANCE_TUNGSTEN;
    CHECK(developed(&sensor, (const double[3]){0.1, 0.1, 0.1}, &way, made));
    CHECK(made[2] > made[1] && made[1] > made[0]);
    way.white = BALANCE_DAYLIGHT;
    CHECK(developed(&sensor, lamp.part, &way, made));
    CHECK(made[0] > made[1] && made[1] > made[2]);
    /* saturated, or dark, all over: no white to be found */
    way.white = BALANCE_AUTO;
    CHECK(!developed(&sensor, (const double[3]){9, 9, 9}, &way, made));
    CHECK(!developed(&sensor, (const double[3]){0, 0, 0}, &way, made));
    way = (struct develop_way){.white = BALANCE_KELVIN, .kelvin = 100, .headroom = 1};
    CHECK(!developed(&sensor, lamp.part, &way, made));
}

/* ITU-R BT.2087 prints the matrix of BT.2020 to BT.709, both with D65, in four decimals. */
static void test_primaries(void)
{
    static const double wide[4][2] = {
        {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
    static const double printed[3][3] = {
        {1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}};
    static const double own[4][2] = {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {0.3333, 0.3333}};
    static const double srgb[4][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
    static const double flat[4][2] = {{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.3, 0.3}};
    static const double outside[4][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.7, 0.2}};
    struct colour_matrix matrix;
    CHECK(colour_of_primaries(wide, &matrix, &error));
    for (int i = 0; i < 9; i++) {
        CHECK_NEAR(matrix.at[i / 3][i % 3], printed[i / 3][i % 3], 3e-4, "BT.2020");
    }
    CHECK(colour_of_primaries(own, &matrix, &error));
    const struct colour white = colour_turned(&matrix, (struct colour){{1, 1, 1}});
    CHECK(colour_of_primaries(srgb, &matrix, &error));
    for (int i = 0; i < 9; i++) {
        CHECK_NEAR(white.part[i % 3], 1, 1e-12, "white of Radiance");
        CHECK(matrix.at[i / 3][i % 3] == (i % 4 == 0 ? 1 : 0));
    }
    CHECK(!colour_of_primaries(flat, &matrix, &error));
    CHECK(!colour_of_primaries(outside, &matrix, &error));
}

int main(void)
{
    test_whites();
    test_bradford();
    test_developed();
    test_fill();
    test_alike();
    test_balanced();
    arena_free(arena);
    test_primaries();
    return check_report();
}
