/* tests/unit/test_debevec.c - a recovered response is where the sum of squares is least. */
/* SPDX-License-Identifier: MIT */
#include "tone/debevec.h"

#include "base/image/srgb.h"
#include "tone_frames.h"

/* One column: all pixels are looked at, and neighbours are those above and below. */
enum { HEIGHT = 400, FRAMES = 3 };

static const double times[FRAMES] = {1, 4, 2};
static uint8_t codes[FRAMES][HEIGHT];

static uint32_t word = 1;

static double random_share(void)
{
    word = word * 1664525U + 1013904223U;
    return (double)(word >> 8) / (1 << 24);
}

/* w^2 of a code, or of one between two. */
static double weight(double code)
{
    const double w = fmax(0, fmin(code, 255 - code)) / 127;
    return w * w;
}

/* A pixel's codes in the frames that tell of it, and their weights. */
struct seen {
    int count;
    double code[FRAMES], weight[FRAMES], time[FRAMES];
};

static struct seen seen_at(int y)
{
    struct seen seen = {0};
    double mean[FRAMES];
    bool is_even = true, is_exposed[FRAMES];
    for (int f = 0; f < FRAMES; f++) {
        const int above = y > 0 ? y - 1 : y, below = y + 1 < HEIGHT ? y + 1 : y;
        const int three[3] = {codes[f][above], codes[f][y], codes[f][below]};
        const int least = three[0] < three[1] ? three[0] : three[1];
        const int most = three[0] > three[1] ? three[0] : three[1];
        const int low = least < three[2] ? least : three[2];
        const int high = most > three[2] ? most : three[2];
        mean[f] = (three[0] + three[1] + three[2]) / 3.0;
        is_exposed[f] = low > 0 && high < 255;
        is_even = is_even && (!is_exposed[f] || high - low <= 24);
    }
    for (int f = 0; f < FRAMES; f++) {
        const double code = is_even ? mean[f] : codes[f][y];
        if ((is_exposed[f] || !is_even) && weight(code) > 0) {
            seen.code[seen.count] = code;
            seen.weight[seen.count] = weight(code);
            seen.time[seen.count++] = log(times[f]);
        }
    }
    return seen;
}

static double between(const double *g, double code)
{
    const int below = (int)code;
    return g[below] + (code - below) * (below < 255 ? g[below + 1] - g[below] : 0);
}

/* What differs in a pixel, weighted squares; adds up its weights. */
static double squares_at(const double *g, int y, double *weights)
{
    const struct seen seen = seen_at(y);
    double light = 0, own = 0, sum = 0;
    for (int i = 0; i < seen.count; i++) {
        light += seen.weight[i] * (between(g, seen.code[i]) - seen.time[i]);
        own += seen.weight[i];
    }
    for (int i = 0; i < seen.count && seen.count > 1; i++) {
        const double off = between(g, seen.code[i]) - seen.time[i] - light / own;
        sum += seen.weight[i] * off * off;
    }
    *weights += seen.count > 1 ? own : 0;
    return sum;
}

/* [DebevecMalik97] eq 4, with g'' + g'/z and 1000 for each value of a code. */
static double objective(const double *g)
{
    double weights = 0, sum = 0;
    for (int y = 0; y < HEIGHT; y++) {
        sum += squares_at(g, y, &weights);
    }
    for (int z = 1; z < 255; z++) {
        const double bend = g[z - 1] - 2 * g[z] + g[z + 1] + (g[z + 1] - g[z - 1]) / (2 * z);
        sum += weight(z) * 1000 * weights / 256 * bend * bend;
    }
    return sum + weights * g[128] * g[128];
}

/* A pattern of even stretches and of steep ones, of a camera whose codes are powers of light. */
static void fill(double noise)
{
    word = 3;
    for (int y = 0; y < HEIGHT; y++) {
        const double jump = y % 50 < 40 ? 1 : 0.2 + 2 * random_share();
        const double light = 0.0004 * pow(1000, (double)y / HEIGHT) * jump;
        for (int f = 0; f < FRAMES; f++) {
            const double code = 255 * pow(light * times[f], 0.45) + noise * (random_share() - 0.5);
            codes[f][y] = (uint8_t)rint(fmax(0, fmin(code, 255)));
        }
    }
}

static void recover(struct response_curve curves[FRAME_CHANNELS])
{
    struct tone_frame frames[FRAMES];
    struct error error;
    for (int f = 0; f < FRAMES; f++) {
        frames[f] = frame_of(codes[f], 1, HEIGHT, times[f]);
    }
    CHECK(debevec_recover(frames, FRAMES, arena, curves, &error));
}

/* No little change of the curve makes the sum less: it is as far from it either way. */
static void test_least(void)
{
    static struct response_curve curves[FRAME_CHANNELS];
    double g[256];
    fill(12);
    recover(curves);
    CHECK(curves[0].held == 0);
    CHECK_RELATIVE(curves[1].light[128], srgb_light(128.0 / 255), 1e-12, "the middle");
    for (int z = 0; z < 256; z++) {
        g[z] = log(curves[1].light[z] / curves[1].light[128]);
    }
    const double least = objective(g);
    for (int z = 0; z < 256; z++) {
        const double own = g[z], by = 1e-3;
        g[z] = own + by;
        const double above = objective(g);
        g[z] = own - by;
        const double below = objective(g);
        g[z] = own;
        CHECK_NEAR((above - below) / (above + below - 2 * least), 0, 1e-5, "slope over bend");
    }
    double weights = 0, sum = 0;
    for (int y = 0; y < HEIGHT; y++) {
        sum += squares_at(g, y, &weights);
    }
    CHECK_RELATIVE(curves[1].rms, sqrt(sum / weights), 1e-9, "what frames disagree by");
    CHECK(curves[1].rms > 0.01);
}

/* Without noise the camera's own response comes back, a power of light. */
static void test_power(void)
{
    static struct response_curve curves[FRAME_CHANNELS];
    fill(0);
    recover(curves);
    for (int z = 20; z < 250; z += 10) {
        const double slope = log(curves[2].light[z] / curves[2].light[128]) / log(z / 128.0);
        CHECK(z == 128 || fabs(slope - 1 / 0.45) < 0.02);
    }
    CHECK(curves[2].rms < 0.02);
}

static void test_refused(void)
{
    static struct response_curve curves[FRAME_CHANNELS];
    struct tone_frame frames[2];
    struct error error;
    fill(0);
    frames[0] = frame_of(codes[0], 1, HEIGHT, 1);
    frames[1] = frame_of(codes[1], 1, HEIGHT, 1);
    CHECK(!debevec_recover(frames, 2, arena, curves, &error));
    CHECK_TEXT(error.message, "a response is recovered from frames of different times");
    frames[1].time = 2;
    frames[1].bits = 16;
    CHECK(!debevec_recover(frames, 2, arena, curves, &error));
    CHECK_TEXT(error.message, "x: a response is recovered of 8 bits, and it has 16");
    static const uint8_t black[HEIGHT];
    frames[1] = frame_of(black, 1, HEIGHT, 2);
    CHECK(!debevec_recover(frames, 2, arena, curves, &error));
    CHECK_TEXT(error.message, "no response can be told: 0 of 400 pixels are neither black nor full "
                              "in two frames");
    /* of one pixel, that two frames do not have: what they have below it is not asked for */
    static const uint8_t grey[] = {100};
    struct tone_frame one[3];
    for (int f = 0; f < 3; f++) {
        one[f] = frame_of(grey, 1, 1, 1 << f);
        one[f].down = f > 0 ? -1 : 0;
    }
    CHECK(!debevec_recover(one, 3, arena, curves, &error));
    CHECK_TEXT(error.message, "no response can be told: 0 of 1 pixels are neither black nor full "
                              "in two frames");
}

int main(void)
{
    test_least();
    test_power();
    test_refused();
    arena_free(arena);
    return check_report();
}
