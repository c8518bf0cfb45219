/* tests/stress/family_paraxial.c - first order and Seidel sums of random lenses, in 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "drawn_lens.h"

#include "file/lens_file.h"
#include "optics/seidel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Matrices as textbooks have them; the sensitivity is to every number, moved by its own size. */
enum { FIGURES = 14 };
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

/* n behind every surface is negative after an odd number of mirrors. */
static quad signed_index(const struct quad_lens *l, size_t surfaces)
{
    quad sign = 1;
    for (size_t i = 0; i < surfaces; i++) {
        sign = l->surfaces[i].reflects ? -sign : sign;
    }
    return surfaces > 0 ? sign * l->surfaces[surfaces - 1].n : 1;
}

/* From surface `first` to before `end`. */
static struct matrix matrix_of(const struct quad_lens *l, size_t first, size_t end)
{
    struct matrix m = {1, 0, 0, 1};
    quad n = signed_index(l, first), sign = first > 0 && n < 0 ? -1 : 1;
    for (size_t i = first; i < end; i++) {
        const struct quad_surface *surface = &l->surfaces[i];
        sign = surface->reflects ? -sign : sign;
        const quad power = (sign * surface->n - n) * surface->c;
        n = sign * surface->n;
        const quad reduced = i + 1 < l->count ? surface->t / n : 0;
        m.c -= m.a * power;
        m.d -= m.b * power;
        m.a += reduced * m.c;
        m.b += reduced * m.d;
    }
    return m;
}

static void first_order_truth(const struct quad_lens *l, quad figures[FIGURES])
{
    const struct matrix m = matrix_of(l, 0, l->count), f = matrix_of(l, 0, l->stop);
    const struct matrix r = matrix_of(l, l->stop, l->count);
    const quad n = signed_index(l, l->count), v = m.c * l->object + m.d;
    const bool infinite = l->object == 0;
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

static void first_order_collect(const struct first_order *f, double figures[FIGURES])
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
static quad first_order_sensitivity(const struct quad_lens *lens, int k)
{
    static struct quad_lens moved;
    const quad step = (quad)1 / (quad)1e18;
    quad here[FIGURES], there[FIGURES], sum = 0;
    first_order_truth(lens, here);
    moved = *lens;
    for (size_t i = 0; i <= QUAD_NUMBERS * lens->count; i++) {
        const bool is_object = i == QUAD_NUMBERS * lens->count;
        quad *number = is_object ? &moved.object : quad_lens_number(&moved, i);
        const quad before = *number;
        if (before != 0 && (is_object || i % QUAD_NUMBERS < 3)) {
            *number += before * step;
            first_order_truth(&moved, there);
            sum += quad_size(there[k] - here[k]) / step;
            *number = before;
        }
    }
    return sum;
}

static void try_paraxial(struct trial *trial, const struct drawn_scale *scale, bool afocal)
{
    static struct drawn_lens drawn;
    static struct quad_lens numbers;
    struct lens lens;
    struct error error = {0};
    struct first_order first;
    quad truth[FIGURES];
    double actual[FIGURES];
    drawn_lens_draw(trial, scale, &drawn);
    if (afocal) {
        drawn_lens_make_afocal(trial, &drawn);
    }
    trial->about = drawn_lens_write(&drawn, &trial->arena);
    if (!lens_read("stress", text_of(trial->about), NULL, &trial->arena, &lens, &error) ||
        !first_order_of_lens(&lens, 0.5875618, SECTION_Y, &trial->arena, &first, &error)) {
        trial_verdict(trial, false, "%s", error.message);
        return;
    }
    quad_lens_of(&drawn, &numbers);
    first_order_truth(&numbers, truth);
    first_order_collect(&first, actual);
    for (int k = 0; k < FIGURES; k++) {
        if (first.is_afocal && (k < 8 || k == 11)) {
            continue; /* the power is below 2^-95 of the strongest surface's: called 0 */
        }
        if (!quad_is_finite(truth[k])) {
            trial_verdict(trial, !isfinite(actual[k]), "%s %.17g, not infinite", names[k],
                          actual[k]);
            continue;
        }
        const double off = (double)quad_size((quad)actual[k] - truth[k]);
        const double size = (double)quad_size(truth[k]);
        if (!trial_is_near(trial, off, size)) {
            trial_figure(trial, names[k], off, size, (double)first_order_sensitivity(&numbers, k));
        }
    }
}

void try_ordinary_paraxial(struct trial *trial)
{
    const struct drawn_scale scale = {.least = 1,
                                      .most = 20,
                                      .radius = {5, 1000},
                                      .thickness = {0.1, 20},
                                      .index = {1.3, 2.2},
                                      .object = {0.1, 1e6},
                                      .planes = 0.1,
                                      .mirrors = 0.05,
                                      .air = 0.4,
                                      .far = 0.5};
    try_paraxial(trial, &scale, false);
}

void try_scales_paraxial(struct trial *trial)
{
    const struct drawn_scale scale = {.least = 1,
                                      .most = 6,
                                      .radius = {1e-3, 1e9},
                                      .thickness = {1e-9, 1e12},
                                      .index = {1, 4},
                                      .object = {1e-9, 1e15},
                                      .planes = 0.1,
                                      .mirrors = 0.1,
                                      .air = 0.4,
                                      .far = 0.5};
    try_paraxial(trial, &scale, false);
}

void try_flat_paraxial(struct trial *trial)
{
    const struct drawn_scale scale = {.least = 2,
                                      .most = 12,
                                      .radius = {1e6, 1e9},
                                      .thickness = {1e-9, 1e3},
                                      .index = {1.3, 2.2},
                                      .object = {1e-9, 1e6},
                                      .planes = 0.1,
                                      .air = 0.4,
                                      .far = 0.5};
    try_paraxial(trial, &scale, false);
}

void try_afocal_paraxial(struct trial *trial)
{
    const struct drawn_scale scale = {.least = 2,
                                      .most = 10,
                                      .radius = {10, 300},
                                      .thickness = {0.1, 50},
                                      .index = {1.3, 2.2},
                                      .planes = 0.1,
                                      .air = 0.4,
                                      .far = 1};
    try_paraxial(trial, &scale, true);
}

void try_long_paraxial(struct trial *trial)
{
    const struct drawn_scale scale = {.least = 500,
                                      .most = 500,
                                      .radius = {300, 1e5},
                                      .thickness = {0.01, 1},
                                      .index = {1.3, 2.2},
                                      .object = {0.01, 1e6},
                                      .planes = 0.05,
                                      .air = 0.4,
                                      .far = 0.5};
    try_paraxial(trial, &scale, false);
}

/* -------- Seidel -------- */

enum { SUMS = 7 }; /* S1 .. S5, CI, CII */
static const char *const sum_names[SUMS] = {"S1", "S2", "S3", "S4", "S5", "CI", "CII"};

/* What the sums want beside the lens: dn = n blue - n red of each medium, from before the first. */
struct seidel_beam {
    quad epd, field; /* mm; the tangent of the angle, or the height of the object */
    quad spread[DRAWN_MOST + 1];
};

/* Of a surface (S3 + S4) Abar/A, whose limit where A is 0 another curve has but for rounding. */
static quad seidel_distortion(quad c, const quad of[6])
{
    const quad y = of[0], u = of[1], yb = of[2], ub = of[3], n = of[4], m = of[5];
    const quad scale = quad_size(c) + quad_size(y == 0 ? 0 : u / y) +
                       quad_size(yb == 0 ? 0 : ub / yb) + (quad)1e-9;
    const bool is_limit = quad_size(u + y * c) < (quad)1e-18 * quad_size(y) * scale;
    c += is_limit ? (quad)1e-17 * scale : 0;
    const quad A = n * (u + y * c), Ab = n * (ub + yb * c), H = n * (y * ub - yb * u);
    const quad d = (n * u - y * (m - n) * c) / (m * m) - u / n;
    return Ab / A * (-Ab * Ab * y * d - H * H * c * (1 / m - 1 / n));
}

/* [Welford86]: A = n (u + y c), and so on; S5 = (S3 + S4) Abar/A. */
static void seidel_truth(const struct quad_lens *l, const struct seidel_beam *beam, quad sums[SUMS])
{
    const struct matrix f = matrix_of(l, 0, l->stop);
    const quad pupil = f.b / f.a, L = l->object;
    const quad edge = (f.a < 0 ? -1 : 1) * beam->epd / 2; /* positive at the stop */
    quad u = 0, y = edge, ub = beam->field, yb = -pupil * beam->field, n = 1, sign = 1;
    memset(sums, 0, SUMS * sizeof *sums);
    if (L != 0) { /* through the edge and the middle of the pupil */
        u = edge / (L + pupil);
        y = u * L;
        ub = -beam->field / (L + pupil);
        yb = -pupil * ub;
    }
    for (size_t i = 0; i < l->count; i++) {
        const struct quad_surface *surface = &l->surfaces[i];
        sign = surface->reflects ? -sign : sign;
        const quad c = surface->c, m = sign * surface->n;
        const quad A = n * (u + y * c), Ab = n * (ub + yb * c), H = n * (y * ub - yb * u);
        const quad d = (n * u - y * (m - n) * c) / (m * m) - u / n;
        const quad G = (surface->k * c * c * c / 8 + surface->A4) * 8 * (m - n);
        const quad S3 = -Ab * Ab * y * d, S4 = -H * H * c * (1 / m - 1 / n);
        const quad colour = beam->spread[i + 1] / m - beam->spread[i] / n;
        sums[0] += -A * A * y * d + G * y * y * y * y;
        sums[1] += -A * Ab * y * d + G * y * y * y * yb;
        sums[2] += S3 + G * y * y * yb * yb;
        sums[3] += S4;
        sums[4] += seidel_distortion(c, (const quad[]){y, u, yb, ub, n, m}) + G * y * yb * yb * yb;
        sums[5] += A * y * colour;
        sums[6] += Ab * y * colour;
        u = (n * u - y * (m - n) * c) / m;
        ub = (n * ub - yb * (m - n) * c) / m;
        y += surface->t * u;
        yb += surface->t * ub;
        n = m;
    }
}

/* How a sum moves with every number of the lens and of the beam. */
static void seidel_sensitivity(const struct quad_lens *lens, const struct seidel_beam *beam,
                               quad sums[SUMS])
{
    static struct quad_lens moved;
    static struct seidel_beam other;
    const quad step = (quad)1 / (quad)1e16;
    const size_t numbers = QUAD_NUMBERS * lens->count;
    quad here[SUMS], there[SUMS];
    seidel_truth(lens, beam, here);
    moved = *lens;
    other = *beam;
    memset(sums, 0, SUMS * sizeof *sums);
    for (size_t i = 0; i < numbers + 4 + lens->count; i++) {
        quad *number = i < numbers        ? quad_lens_number(&moved, i)
                       : i == numbers     ? &moved.object
                       : i == numbers + 1 ? &other.epd
                       : i == numbers + 2 ? &other.field
                                          : &other.spread[i - numbers - 3];
        const quad before = *number;
        if (before != 0) {
            *number += before * step;
            seidel_truth(&moved, &other, there);
            for (int k = 0; k < SUMS; k++) {
                sums[k] += quad_size(there[k] - here[k]) / step;
            }
            *number = before;
        }
    }
}

/* The program's sums; false where it has none. */
static bool seidel_of(struct trial *trial, const struct lens *lens, const struct seidel_beam *beam,
                      struct seidel *seidel, struct error *error)
{
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct first_order first;
    const struct conjugate_object object = lens_object(lens);
    const struct aperture_setting aperture = {APERTURE_EPD, (double)beam->epd};
    const enum field_kind kind = object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT;
    const double field = object.is_infinite ? atan((double)beam->field) : (double)beam->field;
    if (!paraxial_compile(lens, 0.5875618, SECTION_Y, &trial->arena, &system, error)) {
        return false;
    }
    struct pair *blue = ARENA_ARRAY(&trial->arena, system.count + 1, struct pair);
    for (size_t i = 0; i <= system.count; i++) {
        blue[i] = pair_add(system.index[i], pair_of((double)beam->spread[i]));
    }
    paraxial_trace(&system, &trace);
    first_order_compute(&system, &trace, &object, &first);
    const struct seidel_question question = {.lens = lens,
                                             .system = &system,
                                             .blue_n = blue,
                                             .red_n = system.index,
                                             .section = SECTION_Y,
                                             .object = &object,
                                             .first = &first,
                                             .field_kind = kind,
                                             .field = field};
    return first_order_aperture(&first, &object, &aperture, kind, field, error) &&
           seidel_compute(&question, &trial->arena, seidel, error);
}

void try_seidel(struct trial *trial)
{
    static struct drawn_lens drawn;
    static struct quad_lens numbers;
    static struct seidel_beam beam;
    const double size = trial_chance(trial, 0.5) ? 1 : trial_magnitude(trial, 1e-6, 1e6);
    const bool wild = trial_chance(trial, 0.3);
    const struct drawn_scale scale = {
        .least = 1,
        .most = wild ? 4 : 14,
        .radius = {wild ? 1e-3 : 10 * size, wild ? 1e9 : 1000 * size},
        .thickness = {wild ? 1e-6 : 0.1 * size, wild ? 1e4 : 20 * size},
        .index = {1, wild ? 4 : 2.2},
        .object = {wild ? 1e-3 : 50 * size, wild ? 1e15 : 1e6 * size},
        .planes = 0.15,
        .mirrors = 0.05,
        .air = 0.4,
        .far = 0.5,
        .conics = 0.3,
        .aspheres = 0.2,
        .height = wild ? 1e-3 : 10 * size,
        .is_concentric = !wild && trial_chance(trial, 0.1)};
    struct lens lens;
    struct error error = {0};
    struct seidel seidel;
    drawn_lens_draw(trial, &scale, &drawn);
    trial->about = drawn_lens_write(&drawn, &trial->arena);
    quad_lens_of(&drawn, &numbers);
    beam.epd = (quad)(scale.height * trial_between(trial, 0.1, 1));
    beam.field = numbers.object == 0 ? (quad)tan(trial_between(trial, 0.001, 0.8))
                                     : (quad)(scale.height * trial_between(trial, 0.1, 3));
    quad sign = 1;
    for (size_t i = 0; i <= drawn.count; i++) {
        const bool reflects = i > 0 && numbers.surfaces[i - 1].reflects;
        sign = reflects ? -sign : sign;
        beam.spread[i] = reflects || i == 0 ? -beam.spread[i > 0 ? i - 1 : 0]
                                            : sign * (quad)trial_between(trial, 0, 0.02);
        beam.spread[i] = i == 0 ? 0 : beam.spread[i];
    }
    if (!lens_read("stress", text_of(trial->about), NULL, &trial->arena, &lens, &error)) {
        trial_verdict(trial, false, "%s", error.message);
        return;
    }
    quad truth[SUMS], sensitivity[SUMS];
    seidel_truth(&numbers, &beam, truth);
    for (int k = 0; k < SUMS; k++) {
        if (!quad_is_finite(truth[k]) || quad_size(truth[k]) > (quad)1e290) {
            trial_skip(trial);
            return;
        }
    }
    if (!seidel_of(trial, &lens, &beam, &seidel, &error)) {
        trial_verdict(trial, false, "%s", error.message);
        return;
    }
    seidel_sensitivity(&numbers, &beam, sensitivity);
    for (int k = 0; k < SUMS; k++) {
        const double off = (double)quad_size((quad)seidel.total.sum[k] - truth[k]);
        /* the tangent of the angle was rounded on its way there and back: 2 of the field's own */
        trial_figure(trial, sum_names[k], off, (double)quad_size(truth[k]), (double)sensitivity[k]);
    }
}
