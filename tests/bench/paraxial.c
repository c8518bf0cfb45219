/* tests/bench/paraxial.c - time against error of the first-order engine: paraxial LENS... */
/* SPDX-License-Identifier: MIT */
#include "clock.h"
#include "exchange/lens_open.h"
#include "optics/first_order.h"
#include "optics/portable.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TURNS = 15, ROUNDS = 20000, MOST_SURFACES = 64 };

/* What is timed: it gets a lens, and returns a number that depends on all it computed. */
struct subject {
    const struct lens *lens;
    struct paraxial_system system;
    double power[MOST_SURFACES], reduced[MOST_SURFACES];
    struct conjugate_object object;
    struct arena *arena;
};

/* Both rays in doubles: what everybody does. */
static double plain_power(const struct subject *subject, double *a, double *b, double *d)
{
    double y1 = 1, v1 = 0, y2 = 0, v2 = 1;
    for (size_t i = 0; i < subject->system.count; i++) {
        v1 -= y1 * subject->power[i];
        v2 -= y2 * subject->power[i];
        y1 += v1 * subject->reduced[i];
        y2 += v2 * subject->reduced[i];
    }
    *a = y1;
    *b = y2;
    *d = v2;
    return -v1;
}

static double plain(struct subject *subject)
{
    double a, b, d, power = plain_power(subject, &a, &b, &d);
    return a + b + d + power;
}

static double trace(struct subject *subject)
{
    struct paraxial_trace traced;
    paraxial_trace(&subject->system, &traced);
    return traced.whole.c.hi + traced.front.b.lo;
}

static double portable(struct subject *subject)
{
    struct paraxial_trace traced;
    paraxial_trace_portable(&subject->system, &traced);
    return traced.whole.c.hi + traced.front.b.lo;
}

static double all_figures(struct subject *subject)
{
    struct paraxial_trace traced;
    struct first_order first;
    paraxial_trace(&subject->system, &traced);
    first_order_compute(&subject->system, &traced, &subject->object, &first);
    return first.efl + first.exit_pupil;
}

static double from_lens(struct subject *subject)
{
    struct first_order first;
    struct error error;
    const struct arena_mark mark = arena_mark(subject->arena);
    if (!first_order_of_lens(subject->lens, lens_primary_wavelength(subject->lens), SECTION_Y,
                             subject->arena, &first, &error)) {
        exit(1);
    }
    arena_reset(subject->arena, mark);
    return first.efl + first.exit_pupil;
}

static volatile double sink;

/* The best of many turns: others only ever slow one down. */
static double time_of(double (*run)(struct subject *subject), struct subject *subject)
{
    double best = INFINITY;
    for (int turn = 0; turn < TURNS; turn++) {
        double start = 1e9 * clock_time(), sum = 0;
        for (int i = 0; i < ROUNDS; i++) {
            sum += run(subject);
            /* each round anew */
            __asm__ volatile("" : : "r"(subject) : "memory");
        }
        best = fmin(best, (1e9 * clock_time() - start) / ROUNDS);
        sink = sum;
    }
    return best;
}

static void prepare(struct subject *subject)
{
    struct error error;
    if (!paraxial_compile(subject->lens, lens_primary_wavelength(subject->lens), SECTION_Y,
                          subject->arena, &subject->system, &error) ||
        subject->system.count > MOST_SURFACES) {
        fprintf(stderr, "bench: %s\n", error.message);
        exit(1);
    }
    subject->object = lens_object(subject->lens);
    for (size_t i = 0; i < subject->system.count; i++) {
        subject->power[i] = subject->system.surfaces[i].power.hi;
        subject->reduced[i] = subject->system.surfaces[i].reduced.hi;
    }
}

static void time_lens(const char *name, struct arena *arena)
{
    struct lensdb db = {.arena = arena};
    struct lens lens;
    struct error error;
    if (!lens_open(&db, text_of(name), arena, &lens, &error)) {
        fprintf(stderr, "bench: %s\n", error.message);
        exit(1);
    }
    struct subject subject = {.lens = &lens, .arena = arena};
    prepare(&subject);
    printf("%s %zu %.1f %.1f %.1f %.1f %.1f\n", name, subject.system.count,
           time_of(plain, &subject), time_of(trace, &subject), time_of(portable, &subject),
           time_of(all_figures, &subject), time_of(from_lens, &subject));
}

/*
 * A Galilean telescope of thin lenses, f 150 and -50 mm, whose gap is off by `off` mm: its power
 * is off/7500 exactly. Prints the relative errors of plain doubles and of the engine.
 */
static void stress(const char *off, struct arena *arena)
{
    const char *text = arena_printf(arena,
                                    "surface 75 0 1.5 -\nsurface - 100.%s air -\n"
                                    "surface -25 0 1.5 -\nsurface - 0 air -\n",
                                    off);
    struct lens lens;
    struct error error;
    if (!lens_read("bench", text_of(text), NULL, arena, &lens, &error)) {
        exit(1);
    }
    struct subject subject = {.lens = &lens, .arena = arena};
    struct paraxial_trace traced;
    struct pair exact;
    const char *fraction = arena_printf(arena, "0.%s", off);
    double a, b, d;
    prepare(&subject);
    paraxial_trace(&subject.system, &traced);
    pair_read(fraction, fraction + text_of(fraction).length, NUMBER_UNSCALED, &exact);
    double power = exact.hi / 7500;
    printf("off %g %.3g %.3g\n", power, fabs(plain_power(&subject, &a, &b, &d) - power) / power,
           fabs(-traced.whole.c.hi - power) / power);
}

int main(int count, char **names)
{
    static const char *const offsets[] = {"001", "0000001", "00000000001", "000000000000001"};
    struct arena arena = {0};
    for (int i = 1; i < count; i++) {
        time_lens(names[i], &arena);
    }
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; i++) {
        stress(offsets[i], &arena);
    }
    arena_free(&arena);
    return 0;
}
