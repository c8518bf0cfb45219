/* tests/unit/test_photograph.c - pictures that end in a tile; white where the middle is dark. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/photograph.h"

#include "base/constants.h"
#include "camera/photograph/tile_rays.h"
#include "check.h"
#include "file/lens_file.h"
#include "light/illuminant.h"

enum { COLUMNS = 2 * TILE_ACROSS, ROWS = 2 * TILE_DOWN, TILES = 4, SAMPLES = 64 };

static struct error error;
static struct arena arena;
static struct lens lens;
static struct setup setup;

/* A card that a hole shows on a film, in four tiles. */
static const struct photograph_question card = {
    .film = {.setup = &setup, .width = 36, .height = 18},
    .columns = COLUMNS,
    .rows = ROWS,
    .samples = SAMPLES,
    .kept = (1U << SKIP_COUNT) - 1,
    .card = {.distance = 500, .chart = CHART_STAR}};

/* With a film so far behind. */
static bool open_lens(const char *text, double film)
{
    const struct setup_question question = {
        .lens = &lens, .wavelength = NAN, .wavelengths = WAVELENGTHS_ALL, .fnumber = NAN};
    const struct plane_value plane = {.kind = PLANE_AT, .distance = film};
    return lens_read("test", text_of(text), NULL, &arena, &lens, &error) &&
           setup_open(&question, &arena, &setup, &error) &&
           setup_place_image(&setup, &plane, &error);
}

static struct photograph take(const struct photograph_question *question)
{
    struct photograph photograph = {0};
    CHECK(photograph_take(question, &arena, &photograph, &error));
    CHECK_TEXT(error.message, "");
    return photograph;
}

/* Ends at that look. */
static size_t looks_left;

static void look(struct watch *watch)
{
    looks_left -= looks_left > 0;
    atomic_store(&watch->is_ended, looks_left == 0);
}

/* What `part` has of tiles that are done is that of `whole`; all else is black. */
static void check_tiles(const struct photograph *part, const struct photograph *whole,
                        const unsigned char *done)
{
    bool same = true;
    for (size_t i = 0; i < (size_t)COLUMNS * ROWS; i++) {
        const size_t tile = i / COLUMNS / TILE_DOWN * 2 + i % COLUMNS / TILE_ACROSS;
        for (size_t k = 0; k < PHOTOGRAPH_CHANNELS; k++) {
            const size_t at = i * PHOTOGRAPH_CHANNELS + k;
            const float expected = done[tile] != 0 ? whole->image.pixels[at] : 0;
            same = same && part->image.pixels[at] == expected;
        }
    }
    CHECK(same);
}

/* Ended at each of its looks, and gone on with: what there is are whole tiles, counted as such. */
static void test_ended(double share)
{
    struct photograph_question question = card;
    question.error = share;
    const struct photograph whole = take(&question);
    const size_t most = TILES * (SAMPLES / 8 + 1);
    size_t cut = 0;
    CHECK(!whole.is_incomplete && whole.counts[PHOTOGRAPH_WAYS + RAY_REUSE_TRACED] == TILES);
    for (size_t looks = 1; looks <= most; looks++) {
        unsigned char done[TILES] = {0}, others[TILES];
        struct watch watch = {.look = look, .is_busy = ATOMIC_FLAG_INIT};
        looks_left = looks;
        question.watch = &watch;
        question.done = done;
        const struct photograph part = take(&question);
        size_t count = 0;
        for (size_t i = 0; i < TILES; i++) {
            count += done[i];
            others[i] = !done[i];
        }
        cut += looks > 1 && count < TILES;
        CHECK(part.is_incomplete == (count < TILES));
        CHECK(part.counts[PHOTOGRAPH_WAYS + RAY_REUSE_TRACED] == count);
        check_tiles(&part, &whole, done);
        question.watch = NULL;
        const struct photograph rest = take(&question);
        check_tiles(&rest, &whole, others);
        for (size_t i = 0; i < PHOTOGRAPH_COUNTS; i++) {
            CHECK(part.counts[i] + rest.counts[i] == whole.counts[i]);
        }
    }
    CHECK(cut > TILES);
}

static size_t calls_left;

static bool is_over(const void *clock)
{
    (void)clock;
    calls_left -= calls_left > 0;
    return calls_left == 0;
}

/* Ended by the clock wherever it is asked: all tiles have 16 samples, or a power of two more. */
static void test_timed(void)
{
    struct photograph_question question = card;
    struct photograph by[3];
    size_t between = 0;
    for (size_t i = 0; i < 3; i++) {
        question.samples = (size_t)CONVERGENCE_LEAST << i;
        by[i] = take(&question);
    }
    question.is_over = is_over;
    for (size_t calls = 1; calls < 40; calls++) {
        calls_left = calls;
        const struct photograph timed = take(&question);
        const size_t *reached = timed.reached;
        CHECK(!timed.is_incomplete && reached[0] >= CONVERGENCE_LEAST);
        CHECK(reached[1] == reached[0] || reached[1] == 2 * reached[0]);
        CHECK(reached[1] <= SAMPLES);
        between += reached[1] > reached[0];
        for (size_t tile = 0; tile < TILES; tile++) {
            float got[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS];
            float expected[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS];
            bool found = false;
            photograph_tile(&question, &timed.image, tile, TILE_FROM_PICTURE, got);
            for (size_t i = 0; i < 3; i++) {
                const size_t samples = (size_t)CONVERGENCE_LEAST << i;
                photograph_tile(&question, &by[i].image, tile, TILE_FROM_PICTURE, expected);
                found = found || (memcmp(got, expected, sizeof got) == 0 &&
                                  (samples == reached[0] || samples == reached[1]));
            }
            CHECK(found);
        }
    }
    CHECK(between > 0);
}

/*
 * E/L of a disc of light parallel to a plane, seen from there, by Lambert's integral about its rim:
 * radius, its middle beside the point, the plane behind it.
 */
static double light_of_disc(double r, double l, double h)
{
    const double all = l * l + h * h + r * r;
    return PI / 2 * (1 - (all - 2 * r * r) / sqrt(all * all - 4 * l * l * r * r));
}

/*
 * A hole of 1 mm, 3 mm to the right of a larger one's middle and 3 mm below, half way to the film:
 * all of it is lit where the film is within 1 mm of (6, -6) mm; the middle of the film is dark.
 */
static void test_dark_middle(void)
{
    static const char text[] = "lens mask\nwavelength d\nobject inf\naperture stop\n"
                               "stop - 20 air 6\nsurface - 20 air 2 decenter=3,-3\n";
    static float white = 1;
    const struct image even = {.width = 1, .height = 1, .channels = 1, .pixels = &white};
    struct photograph_question question = card;
    question.film.width = question.film.height = 30;
    question.columns = question.rows = 64; /* in whose parts of 0.47 mm light changes by 1 % */
    question.card = (struct card){.distance = 500, .picture = &even, .width = 1000, .height = 1000};
    CHECK(open_lens(text, 20));
    const struct photograph photograph = take(&question);
    const double *at = photograph.reference_at;
    CHECK(hypot(at[0] - 6, at[1] + 6) < 1);
    const double expected = light_of_disc(1, hypot(at[0] - 3, at[1] + 3), 20);
    CHECK_RELATIVE(photograph.reference, expected, 1e-3, "white");
    /* the picture is upright, the film is not */
    const size_t column = (size_t)((0.5 - at[0] / 30) * 64),
                 row = (size_t)((0.5 + at[1] / 30) * 64);
    const float *image = photograph.image.pixels;
    CHECK_RELATIVE((double)image[(row * 64 + column) * PHOTOGRAPH_CHANNELS], expected, 0.01,
                   "pixel");
    CHECK(image[(32 * 64 + 32) * PHOTOGRAPH_CHANNELS] == 0);
    /* an error is a share of it */
    question.error = 0.02;
    question.samples = 4 * SAMPLES;
    const struct photograph sure = take(&question);
    CHECK(sure.counts[PHOTOGRAPH_CONVERGENCE + CONVERGENCE_MISSED] == 0);
}

/*
 * Under a sky that is the same everywhere all rays bring the same light: a picture whose colours
 * share rays is that of each colour's own, to rounding. At the edge of a spot of dirt before the
 * film, where few rays pass, there are pixels without a shared one that looks where their own do.
 */
static void test_shared_evenly(void)
{
    static const char text[] =
        "lens dirt\nwavelength 611nm 549nm 464nm\nobject inf\naperture stop\n"
        "stop - 20 air 0.5\nsurface 50 3 1.5/40 60\nsurface -50 45 air 60\n"
        "surface - 2 air 60\nblock circle 2.6 decenter=9,4.5\n";
    static const double span[2] = {-1, 1};
    enum { ACROSS = 2 * TILE_ACROSS, DOWN = TILE_DOWN };
    struct scene_light sky = {
        .kind = LIGHT_SKY, .spectrum = spectrum_white(), .sky = SKY_UNIFORM, .amount = 5000};
    const struct scene scene = {.lights = &sky, .light_count = 1};
    struct world world;
    struct lights lights;
    struct bands bands;
    bands_three(&bands);
    CHECK(open_lens(text, 2) && world_open(&scene, span, &arena, &world, &error) &&
          lights_open(&scene, &bands, &arena, &lights, &error));
    const struct path path = {.world = &world, .lights = &lights};
    const struct view view = {
        .path = &path,
        .bands = &bands,
        .points = tile_rays_points(8, &arena),
        .camera = {.turned = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, .axis = {0, 1, 0}}}; /* upwards */
    struct photograph_question question = card;
    question.view = &view;
    question.is_coloured = true;
    question.columns = 3 * ACROSS;
    question.rows = 6 * DOWN;
    question.crop = (struct image_area){TILE_ACROSS, 4 * TILE_DOWN, ACROSS, DOWN};
    question.samples = 8;
    const struct photograph own = take(&question);
    question.kept &= ~(1U << SKIP_COLOUR);
    const struct photograph shared = take(&question);
    CHECK(own.counts[PHOTOGRAPH_WAYS + RAY_REUSE_SHARED] == 0);
    CHECK(shared.counts[PHOTOGRAPH_WAYS + RAY_REUSE_SHARED] == 2);
    size_t dark = 0;
    for (size_t i = 0; i < (size_t)ACROSS * DOWN * PHOTOGRAPH_CHANNELS; i++) {
        dark += own.image.pixels[i] == 0;
        CHECK_RELATIVE((double)shared.image.pixels[i], (double)own.image.pixels[i], 1e-6, "alike");
    }
    CHECK(dark > 0 && (double)dark * 0.375 * 0.375 < 3 * PI * 1.3 * 1.3); /* mm^2 */
}

int main(void)
{
    CHECK(open_lens("lens stop\nwavelength d\nobject inf\naperture stop\nstop - 50 air 5\n", 50));
    test_ended(0);
    test_ended(1e-4);
    test_timed();
    test_dark_middle();
    test_shared_evenly();
    arena_free(&arena);
    return check_report();
}
