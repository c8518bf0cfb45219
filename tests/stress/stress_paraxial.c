/* tests/stress/stress_paraxial.c - random lenses through the paraxial engine and in quad. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_file.h"
#include "optics/first_order.h"

#include <math.h>
#include <quadmath.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/*
 * stress_paraxial SECONDS [SEED]: each kind of lens for a share of the time. Text goes to the
 * engine as a .lens file and to arithmetic of 113 bits (libquadmath, which the program itself does
 * not use) as the same decimals. A figure may be off by 16 x 2^-53 (sensitivity + |value|), where
 * the sensitivity is the sum of what all numbers of the lens, each moved by its own size, change.
 */
typedef __float128 quad;

enum { MOST = 520, DIGITS = 44, FIGURES = 14 };
static const double ulp = 0x1p-53, allowed = 16;

/* A lens as decimals: R (0 is a plane) and thickness, index behind (0 is a mirror). */
struct drawn {
    size_t count, stop;
    char radius[MOST][DIGITS], thickness[MOST][DIGITS], index[MOST][DIGITS], object[DIGITS];
};

/* The same in numbers: everything that sensitivity moves. */
struct numbers {
    quad c[MOST], t[MOST], n[MOST], object; /* object 0 = infinitely far */
};

static uint64_t state;

static double draw(void) /* 0 .. 1, xorshift64* */
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (double)(state * 2685821657736338717u >> 11) * 0x1p-53;
}

static double within(double low, double high)
{
    return low + (high - low) * draw();
}

static double magnitude(double low, double high)
{
    return exp(within(log(low), log(high)));
}

static double sign(void)
{
    return draw() < 0.5 ? -1 : 1;
}

/* -------- lenses -------- */

struct scale {
    size_t least, most; /* surfaces */
    double radius[2], thickness[2];
    double planes, mirrors; /* how often */
};

static void draw_lens(struct drawn *lens, const struct scale *scale)
{
    lens->count = scale->least + (size_t)(draw() * (double)(scale->most - scale->least + 1));
    lens->stop = (size_t)(draw() * (double)lens->count);
    int digits = 2 + (int)(draw() * 15);
    for (size_t i = 0; i < lens->count; i++) {
        bool mirror = draw() < scale->mirrors, plane = draw() < scale->planes;
        double radius = plane ? 0 : sign() * magnitude(scale->radius[0], scale->radius[1]);
        snprintf(lens->radius[i], DIGITS, "%.*g", digits, radius);
        snprintf(lens->thickness[i], DIGITS, "%.*g", digits,
                 magnitude(scale->thickness[0], scale->thickness[1]));
        double n = mirror ? 0 : draw() < 0.4 ? 1 : within(1.3, 2.2);
        snprintf(lens->index[i], DIGITS, "%.*g", digits > 6 ? 6 : digits, n);
    }
    snprintf(lens->object, DIGITS, "%.*g", digits,
             draw() < 0.5 ? 0 : magnitude(scale->thickness[0], 1e6));
}

static quad quad_of(const char *text)
{
    return strtoflt128(text, NULL);
}

static void to_numbers(const struct drawn *lens, struct numbers *numbers)
{
    quad before = 1;
    for (size_t i = 0; i < lens->count; i++) {
        quad R = quad_of(lens->radius[i]), n = quad_of(lens->index[i]);
        numbers->c[i] = R == 0 ? 0 : 1 / R;
        numbers->t[i] = quad_of(lens->thickness[i]);
        numbers->n[i] = n == 0 ? -before : before < 0 ? -n : n;
        before = numbers->n[i];
    }
    numbers->object = quad_of(lens->object);
}

static const char *to_text(const struct drawn *lens, struct arena *arena)
{
    size_t room = 64 + lens->count * 3 * (DIGITS + 8);
    char *text = arena_array(arena, room, 1), *at = text;
    if (quad_of(lens->object) != 0) {
        at += sprintf(at, "object %s\n", lens->object);
    }
    for (size_t i = 0; i < lens->count; i++) {
        bool plane = strcmp(lens->radius[i], "0") == 0;
        bool mirror = strcmp(lens->index[i], "0") == 0;
        at +=
            sprintf(at, "surface %s %s %s -%s\n", plane ? "-" : lens->radius[i], lens->thickness[i],
                    mirror ? "mirror" : lens->index[i], i == lens->stop ? " stop" : "");
    }
    return text;
}

/* -------- the same figures in quad -------- */

static const char *const names[FIGURES] = {"power",
                                           "efl",
                                           "ffl",
                                           "bfl",
                                           "H",
                                           "H'",
                                           "N",
                                           "N'",
                                           "entrance pupil",
                                           "exit pupil",
                                           "pupil magnification",
                                           "image",
                                           "magnification",
                                           "matrix b"};

/* [y'; v'] = [[a, b], [c, d]] [y; v] */
struct matrix {
    quad a, b, c, d;
};

/* From surface `first` to before `end`. */
static struct matrix part(const struct numbers *l, size_t first, size_t end, size_t count)
{
    struct matrix m = {1, 0, 0, 1};
    for (size_t i = first; i < end; i++) {
        quad power = (l->n[i] - (i > 0 ? l->n[i - 1] : 1)) * l->c[i];
        quad reduced = i + 1 < count ? l->t[i] / l->n[i] : 0;
        m.c -= m.a * power;
        m.d -= m.b * power;
        m.a += reduced * m.c;
        m.b += reduced * m.d;
    }
    return m;
}

static void reference(const struct numbers *l, size_t count, size_t stop, quad figures[FIGURES])
{
    struct matrix m = part(l, 0, count, count), f = part(l, 0, stop, count);
    struct matrix r = part(l, stop, count, count);
    quad n = l->n[count - 1], v = m.c * l->object + m.d;
    bool infinite = l->object == 0;
    const quad all[FIGURES] = {-m.c,
                               -1 / m.c,
                               m.d / m.c,
                               -n * m.a / m.c,
                               (m.d - 1) / m.c,
                               n * (1 - m.a) / m.c,
                               (m.d - n) / m.c,
                               (1 - n * m.a) / m.c,
                               f.b / f.a,
                               -n * r.b / r.d,
                               f.a / r.d,
                               infinite ? -n * m.a / m.c : -n * (m.a * l->object + m.b) / v,
                               infinite ? 0 : 1 / v,
                               m.b};
    memcpy(figures, all, sizeof all);
}

static void collect(const struct first_order *f, double figures[FIGURES])
{
    const double all[FIGURES] = {f->power,
                                 f->efl,
                                 f->ffl,
                                 f->bfl,
                                 f->front_principal,
                                 f->rear_principal,
                                 f->front_nodal,
                                 f->rear_nodal,
                                 f->entrance_pupil,
                                 f->exit_pupil,
                                 f->pupil_magnification,
                                 f->image,
                                 f->magnification,
                                 f->matrix.b.hi};
    memcpy(figures, all, sizeof all);
}

/* How much figure k moves when each number moves by its own size, to first order. */
static quad sensitivity(const struct numbers *numbers, size_t count, size_t stop, int k)
{
    static struct numbers moved; /* a test program may */
    const quad step = (quad)1 / 1e18;
    quad here[FIGURES], there[FIGURES], sum = 0;
    reference(numbers, count, stop, here);
    for (size_t i = 0; i <= 3 * count; i++) {
        moved = *numbers;
        quad *number = i == 3 * count ? &moved.object
                       : i % 3 == 0   ? &moved.c[i / 3]
                       : i % 3 == 1   ? &moved.t[i / 3]
                                      : &moved.n[i / 3];
        *number += *number * step;
        reference(&moved, count, stop, there);
        sum += fabsq(there[k] - here[k]) / step;
    }
    return sum;
}

/* -------- near afocal: the last gap put where the power vanishes, then rounded -------- */

static void make_afocal(struct drawn *lens)
{
    size_t last = lens->count - 1;
    static struct numbers numbers;
    quad n = 1, y = 1, v = 0;
    lens->object[0] = '0';
    lens->object[1] = '\0';
    if (strcmp(lens->radius[last], "0") == 0) {
        snprintf(lens->radius[last], DIGITS, "-20");
    }
    if (strcmp(lens->index[last], lens->index[last - 1]) == 0 || lens->index[last][0] == '0') {
        snprintf(lens->index[last], DIGITS, "1.25");
    }
    to_numbers(lens, &numbers);
    for (size_t i = 0; i < last; i++) {
        v -= y * (numbers.n[i] - n) * numbers.c[i];
        n = numbers.n[i];
        y += i + 1 < last ? numbers.t[i] / n * v : 0;
    }
    /* v' = v - (y + t v/n) P = 0 */
    quad P = (numbers.n[last] - n) * numbers.c[last];
    quad t = v == 0 ? 1 : (v / P - y) * n / v;
    char format[16];
    snprintf(format, sizeof format, "%%.%dQg", 3 + (int)(draw() * 28));
    quadmath_snprintf(lens->thickness[last - 1], DIGITS, format, t);
}

/* -------- a run -------- */

struct worst {
    double units, relative; /* of the contract; of the value */
    int figure;
    unsigned long lens;
};

static bool check_one(const struct drawn *drawn, unsigned long number, struct worst *worst,
                      unsigned long *afocal)
{
    static struct numbers numbers;
    struct arena arena = {0};
    struct lens lens;
    struct error error = {0};
    struct first_order first;
    const char *text = to_text(drawn, &arena);
    quad truth[FIGURES];
    double actual[FIGURES];
    bool good = true;
    if (!lens_read("stress", text_of(text), NULL, &arena, &lens, &error) ||
        !first_order_of_lens(&lens, 0.5875618, SECTION_Y, &arena, &first, &error)) {
        printf("FAILED lens %lu: %s\n%s", number, error.message, text);
        arena_free(&arena);
        return false;
    }
    to_numbers(drawn, &numbers);
    reference(&numbers, drawn->count, drawn->stop, truth);
    collect(&first, actual);
    *afocal += first.is_afocal;
    for (int k = 0; k < FIGURES; k++) {
        if (first.is_afocal && (k < 8 || k == 11)) {
            continue; /* the power is below 2^-95 of the strongest surface's: called 0 */
        }
        if (isinfq(truth[k]) || isnanq(truth[k])) {
            if (isfinite(actual[k])) {
                printf("FAILED lens %lu: %s %.17g, not infinite\n%s", number, names[k], actual[k],
                       text);
                good = false;
            }
            continue;
        }
        double off = (double)fabsq((quad)actual[k] - truth[k]), size = (double)fabsq(truth[k]);
        double relative = off / size, units = off / (ulp * size);
        if (off == 0) {
            continue;
        }
        if (!(units <= 2.5)) {
            quad S = sensitivity(&numbers, drawn->count, drawn->stop, k);
            units = off / (ulp * ((double)S + size));
        }
        if (!(units <= worst->units)) {
            *worst = (struct worst){units, relative, k, number};
        }
        if (!(units <= allowed)) {
            printf("FAILED lens %lu: %s %.17g, not %.17g: %.3g units\n%s", number, names[k],
                   actual[k], (double)truth[k], units, text);
            good = false;
        }
    }
    arena_free(&arena);
    return good;
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int count, char **words)
{
    static const struct {
        const char *name;
        struct scale scale;
        bool afocal;
    } kinds[] = {
        {"ordinary lenses", {1, 20, {5, 1000}, {0.1, 20}, 0.1, 0.05}, false},
        {"all scales", {1, 6, {1e-3, 1e9}, {1e-9, 1e12}, 0.1, 0.1}, false},
        {"flat lenses", {2, 12, {1e6, 1e9}, {1e-9, 1e3}, 0.1, 0}, false},
        {"near afocal", {2, 10, {10, 300}, {0.1, 50}, 0.1, 0}, true},
        {"500 surfaces", {500, 500, {300, 1e5}, {0.01, 1}, 0.05, 0}, false},
    };
    enum { KINDS = sizeof kinds / sizeof kinds[0] };
    static struct drawn lens;
    double seconds = count > 1 ? atof(words[1]) : 10;
    unsigned long passed = 0, failed = 0;
    for (size_t k = 0; k < KINDS; k++) {
        struct worst worst = {0, 0, 0, 0};
        unsigned long number = 0, afocal = 0;
        double end = seconds_now() + seconds / KINDS;
        state = 88172645463325252u + (count > 2 ? strtoul(words[2], NULL, 10) : 0);
        for (; number < 200 || (seconds_now() < end && failed < 20); number++) {
            draw_lens(&lens, &kinds[k].scale);
            if (kinds[k].afocal) {
                make_afocal(&lens);
            }
            bool good = check_one(&lens, number, &worst, &afocal);
            passed += good;
            failed += !good;
        }
        printf("%-16s %9lu lenses, %lu afocal: worst %.2f of %g units, relative %.2g (%s of lens "
               "%lu)\n",
               kinds[k].name, number, afocal, worst.units, allowed, worst.relative,
               names[worst.figure], worst.lens);
    }
    printf("%lu passed, %lu failed\n", passed, failed);
    return failed != 0;
}
