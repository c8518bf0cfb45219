/* photo/attach.h - tubes, close-up lenses, converters, reversed and stacked lenses. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_ATTACH_H
#define LENSCALC_PHOTO_ATTACH_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

/*
 * A lens with whatever is attached to it, as one equivalent lens in air. "Front" is the foremost
 * part: the lens's own front until a close-up lens is put before it.
 */
struct attach_lens {
    double f; /* focal length, mm */
    double N; /* f-number f/(entrance pupil diameter) */
    double P; /* pupil magnification */
    double m_far,
        m_near; /* magnification at the two ends of its own focusing; m_far 0 = infinity */
    double
        front; /* position of the front principal plane seen from the front, mm, + to the sensor */
    double length_far, length_near; /* front to sensor at both ends, mm */
};

/* One thing to attach. */
enum attach_kind {
    ATTACH_TUBE,      /* value = length in mm, >= 0 */
    ATTACH_CLOSE_UP,  /* value = power in dioptres, > 0; gap = to the front it is put before, mm */
    ATTACH_CONVERTER, /* value = factor, > 0 (below 1: reducer); gap = its length, mm */
    ATTACH_REVERSED,  /* value = image distance in mm, >= f; gap = hiatus of the lens, mm; extra =
                         H' seen from the last vertex, which is the front then, mm, + towards the
                         sensor; 0 for want of data: the front is H' */
    ATTACH_STACKED    /* value = focal length of the reversed front lens, mm; gap as close-up */
};

struct attach_step {
    enum attach_kind kind;
    double value;
    double gap;   /* mm, see the kinds */
    double extra; /* ATTACH_STACKED: the front lens's f-number; 0 = it does not limit the beam */
};

/* One focusing of the whole; lengths in mm. */
struct attach_focus {
    double m;
    double distance;         /* subject from the front principal plane, inf for m = 0 */
    double working_distance; /* subject from the front */
    double sensor_distance;  /* subject to sensor */
    double working_fnumber;
};

/* A lens as it is sold; f, N and P > 0. */
struct attach_bare {
    double f, N, P;
    double m_near; /* greatest magnification of its own focusing, >= 0 (0: stays at infinity) */
    double front;  /* front principal plane seen from the lens's front, mm, + to the sensor */
    double hiatus; /* from H to H', mm */
};

/*
 * A bare lens before anything is attached; it focuses as a whole, f constant.
 *
 * Errors    values outside their ranges
 */
bool attach_bare(const struct attach_bare *bare, struct attach_lens *lens, struct error *error);

/*
 * Attach things one after the other. A tube or converter goes between camera and all that is there;
 * a close-up or stacked lens goes before all that is there.
 *
 * Given     lens   changed in place
 *           steps  in the order they are put on; a reversal is only understood first
 * Formula   tube e:      m' = m + e/f, length + e
 *           close-up:    with F = 1000/dioptres and d from it to the front principal plane
 *                        (gap + front): f/f' = 1 + (f - d)/F, that is 1/f' = 1/f + 1/F - d/(f F);
 *                        m' = f/F + m f/f' (f/F at infinity whatever d); front' = f' d/f.
 *                        Pupils: d_p = d - f (1 - 1/P) to the entrance pupil, q = 1 - d_p/F,
 *                        N' = N q f'/f, P' = P q
 *           converter k: f' = k f, N' = k N, P' = k P, m' = k m, front' = front + (k - 1) f: the
 *                        subject stays where it was
 *           reversed:    P' = 1/P, N' = N/P (the old exit pupil is the new entrance pupil),
 *                        m' = v/f - 1; the last vertex is the new front
 *           stacked:     a close-up lens of focal length F; m = f/F at infinity; the beam between
 *                        the lenses is the narrower of f/N and F over its f-number
 * Source    1/f' and m': thin lenses in contact and apart, any textbook (Kingslake, Optics in
 *           Photography). Front and pupils derived here: test_attach.c pins them with
 *           2x2 matrices and with N' (1 + m'/P') = N (1 + m/P), a supplementary lens leaving the
 *           image-side cone alone
 * Result    steps whose value is NaN are left out
 * Errors    values outside their ranges; a close-up lens whose focus lies before the pupil or
 *           before the lens's own focus; a reversal that is not the first step; what is attached
 *           makes the lens too long for a number
 * Limits    paraxial; the converter's and close-up lens's own thickness is nothing; a lens with
 *           internal focusing shortens f when near, so its m is lower than said here
 */
bool attach_apply(struct attach_lens *lens, const struct attach_step *steps, size_t count,
                  struct error *error);

/*
 * Where it is focused at one end of its own focusing.
 *
 * Given     near  true for the near end, false for the far end (infinity of a bare lens)
 * Formula   s = f (1 + 1/m), working distance s - front, sensor distance working + length,
 *           N (1 + m/P)
 * Errors    the subject would lie inside the lens
 */
bool attach_focused(const struct attach_lens *lens, bool near, struct attach_focus *focus,
                    struct error *error);

#endif
