/* tests/stress/drawn_lens.h - random lenses, as decimals and as numbers of 113 bits. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_STRESS_DRAWN_LENS_H
#define LENSCALC_TESTS_STRESS_DRAWN_LENS_H

#include "quad.h"
#include "stress.h"

#include <stddef.h>

enum { DRAWN_MOST = 520, DRAWN_DIGITS = 44 };

/* The numbers that a surface may have. */
enum drawn_number {
    DRAWN_RADIUS, /* mm; 0 is a plane */
    DRAWN_THICKNESS,
    DRAWN_INDEX, /* behind it; 0 is a mirror */
    DRAWN_CONIC,
    DRAWN_A4,
    DRAWN_A6,
    DRAWN_DECENTER_X,
    DRAWN_DECENTER_Y,
    DRAWN_TILT_X, /* degrees */
    DRAWN_TILT_Y,
    DRAWN_A3,
    DRAWN_A5,
    DRAWN_BREAK_X, /* a coordinate break before it: its decentres and its tilts */
    DRAWN_BREAK_Y,
    DRAWN_BREAK_TILT_X,
    DRAWN_BREAK_TILT_Y,
    DRAWN_NUMBERS
};

/* Text goes to the program, the same decimals to arithmetic that nobody shares with it. */
struct drawn_lens {
    size_t count, stop;
    char number[DRAWN_MOST][DRAWN_NUMBERS][DRAWN_DIGITS]; /* "" is 0 and not written */
    char cylinder[DRAWN_MOST];                            /* x, y: curved so; 0: all around */
    char object[DRAWN_DIGITS];                            /* "0" is infinitely far */
    double clear[DRAWN_MOST];                             /* diameters, mm; 0: none is written */
};

/* How lenses are drawn: at random between two numbers, or with a probability. */
struct drawn_scale {
    size_t least, most; /* surfaces */
    double radius[2], thickness[2], index[2];
    double object[2];                                          /* finite distances */
    double planes, mirrors, air, far, conics, aspheres, tilts; /* how often */
    double odd, cylinders, breaks;
    double height; /* that aspheres are gentle within, mm */
    bool folds;    /* thicknesses turn with mirrors, as light does */
    bool is_concentric;
};

void drawn_lens_draw(struct trial *trial, const struct drawn_scale *scale, struct drawn_lens *lens);

/* The last gap but one put where the power vanishes, then rounded to some digits. */
void drawn_lens_make_afocal(struct trial *trial, struct drawn_lens *lens);

/* As a .lens file. */
const char *drawn_lens_write(const struct drawn_lens *lens, struct arena *arena);

/* In numbers: everything that a sensitivity moves. The index of mirrors is that before them. */
enum { QUAD_NUMBERS = 16 };
struct quad_surface {
    union {
        quad number[QUAD_NUMBERS];
        struct {
            quad c, t, n, k, A4, A6, decenter[2], tilt[2]; /* tilt in rad */
            quad A3, A5, break_decenter[2], break_tilt[2]; /* the break before it */
        };
    };
    quad weight[2]; /* of x^2 and y^2 in what stands for r^2: 1, of cylinders one of them 0 */
    bool reflects;
};

struct quad_lens {
    size_t count, stop;
    quad object; /* 0: infinitely far */
    struct quad_surface surfaces[DRAWN_MOST];
};

void quad_lens_of(const struct drawn_lens *drawn, struct quad_lens *lens);

/* One of its numbers: 0 .. QUAD_NUMBERS x count - 1, surface by surface. */
static inline quad *quad_lens_number(struct quad_lens *lens, size_t i)
{
    return &lens->surfaces[i / QUAD_NUMBERS].number[i % QUAD_NUMBERS];
}

#endif
