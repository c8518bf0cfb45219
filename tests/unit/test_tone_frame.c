/* tests/unit/test_tone_frame.c - frames of pictures of all kinds of channels. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "tone/frame.h"

static struct arena memory;
static struct arena *const arena = &memory;
static struct error error;

/* A picture of two pixels of so many channels of these names, whose values are 0.1, 0.2 .. */
static bool take(size_t channels, const char *const *names, int bits, struct tone_frame *frame)
{
    static float pixels[8];
    const struct image image = {.width = 2,
                                .height = 1,
                                .channels = channels,
                                .names = names,
                                .bits = bits,
                                .gamma = 1,
                                .pixels = pixels};
    for (size_t i = 0; i < 2 * channels; i++) {
        pixels[i] = bits == 0 ? 0.1F * (float)(i + 1) : 51.0F / 255 * (float)(i % 4);
    }
    return frame_take(&image, arena, frame, &error);
}

/* Grey is all three channels; those beyond three are left out. */
static void test_floats(void)
{
    static const char *const grey[] = {"Y"}, *const other[] = {"Z"};
    static const size_t channels[] = {1, 2, 3, 4};
    struct tone_frame frame;
    for (size_t c = 0; c < sizeof channels / sizeof *channels; c++) {
        const size_t count = channels[c];
        CHECK(take(count, NULL, 0, &frame) && frame.bits == 0 && frame.values != NULL);
        for (size_t i = 0; i < 6; i++) {
            const size_t from = i / 3 * count + (count > 2 ? i % 3 : 0);
            CHECK(frame.values[i] == 0.1F * (float)(from + 1));
            CHECK(frame_level_at(&frame, i).light == frame.values[i]);
            CHECK(frame_level_at(&frame, i).keep == 1 && frame_level_at(&frame, i).spread == 0);
            CHECK(!frame_is_full(&frame, i));
        }
        CHECK(frame_byte(&frame, 1, 2) == 0);
    }
    CHECK(take(1, grey, 0, &frame));
    CHECK(!take(1, other, 0, &frame));
    CHECK_TEXT(error.message, "its channels are neither Y, nor R, G, B, nor X, Y, Z");
}

/* X, Y, Z through the matrix of IEC 61966-2-1; channels of other names are refused. */
static void test_names(void)
{
    static const char *const rgb[] = {"R", "G", "B"}, *const xyz[] = {"X", "Y", "Z"};
    static const char *const wrong[][3] = {
        {"R", "G", "Z"}, {"X", "Y", "B"}, {"r", "g", "b"}, {"R", "G", "BB"}, {"Y", "G", "B"}};
    static const double inverse[3][3] = {
        {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
    struct tone_frame frame;
    CHECK(take(3, rgb, 0, &frame) && frame.values[4] == 0.1F * 5);
    CHECK(take(3, xyz, 0, &frame));
    for (int i = 0; i < 6; i++) {
        double expected = 0;
        for (int k = 0; k < 3; k++) {
            expected += inverse[i % 3][k] * 0.1 * (3 * (i / 3) + k + 1);
        }
        CHECK_NEAR((double)frame.values[i], expected, 2e-4, "to sRGB");
    }
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        CHECK(!take(3, wrong[i], 0, &frame) && error.code == ERROR_DATA);
    }
}

/* Whole numbers: one table of levels for all channels, here as light is. */
static void test_levels(void)
{
    static const size_t channels[] = {1, 3};
    struct tone_frame frame;
    for (int bits = 8; bits <= 16; bits += 8) {
        for (size_t c = 0; c < 2; c++) {
            const size_t count = channels[c];
            const unsigned top = bits == 8 ? 255 : 65535;
            CHECK(take(count, NULL, bits, &frame) && frame.bits == bits && frame.full == 0);
            CHECK((frame.bytes != NULL) == (bits == 8) && (frame.codes != NULL) == (bits == 16));
            for (size_t i = 0; i < 6; i++) {
                const size_t from = i / 3 * count + (count > 2 ? i % 3 : 0);
                const unsigned code = top / 5 * (unsigned)(from % 4);
                CHECK(frame_byte(&frame, i / 3, i % 3) == (bits == 8 ? code : code >> 8));
                CHECK_RELATIVE((double)frame_level_at(&frame, i).light, (double)code / top, 1e-6,
                               "its light");
            }
            for (size_t k = 0; k < 3; k++) {
                CHECK_RELATIVE((double)frame.levels[k][top / 5].spread, 1.0 / top / top / 12, 1e-6,
                               "evenly wide");
                for (unsigned below = top / 20; below < top / 5; below += top / 20) {
                    CHECK_RELATIVE((double)frame.levels[k][top - below].keep,
                                   fmin(1, 10.0 * below / top), 1e-6, "from nine tenths on less");
                }
                CHECK((double)frame.levels[k][top].keep == 0);
            }
        }
    }
}

/* The longest first; frames of the same time as they came. */
static void test_order(void)
{
    static const double times[] = {1, 4, 2, 4, 0.5, 2};
    static const size_t expected[] = {1, 3, 2, 5, 0, 4};
    struct tone_frame frames[6];
    size_t order[6];
    for (int i = 0; i < 6; i++) {
        frames[i] = (struct tone_frame){.time = times[i]};
    }
    frames_order(frames, 6, order);
    CHECK(memcmp(order, expected, sizeof order) == 0);
}

int main(void)
{
    test_floats();
    test_names();
    test_levels();
    test_order();
    arena_free(arena);
    return check_report();
}
