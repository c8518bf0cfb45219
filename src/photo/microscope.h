/* photo/microscope.h - microscopes: resolution, depth of field, field, sampling. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_MICROSCOPE_H
#define LENSCALC_PHOTO_MICROSCOPE_H

#include "base/error.h"

/* A microscope; lengths in mm, NaN = not given. */
struct microscope_setting {
    double magnification; /* of objective and tube lens, > 0 */
    double na;            /* of the objective, n sin(theta), above 0 and below n */
    double index;         /* n of what lies between it and the specimen, >= 1 */
    double condenser;     /* its numerical aperture; NaN: not below that of the objective */
    double wavelength;    /* um */
    double eyepiece;      /* its power, 10 */
    double field_number;  /* diameter of the eyepiece's field stop */
    double adapter;       /* factor of what is before the camera, 1 = nothing */
    double pitch;         /* of the camera's pixels */
};

/* Lengths in mm, at the specimen if nothing else is said; NaN where what they need is missing. */
struct microscope {
    double abbe, rayleigh, sparrow; /* smallest distance that is resolved */
    double working_fnumber;         /* of the beam behind the tube lens */
    double power;                   /* total, to the eye */
    double exit_pupil;
    double field;                       /* diameter that is seen */
    double lowest_power, highest_power; /* useful ones */
    double eye_depth;                   /* of field, seen by an eye */
    double camera_magnification;        /* on the sensor */
    double pixel;                       /* a pixel */
    double nyquist_pitch;   /* largest pitch, on the sensor, that records Abbe's limit */
    double pixels_per_abbe; /* 2 and more: that is met */
    double camera_depth;    /* of field, on the sensor */
};

/*
 * What a microscope resolves, shows and records.
 *
 * Given     setting
 * Formula   with A = 2 NA, of a smaller condenser NA + NA_c: Abbe l/A, Rayleigh 1.2196698912665045
 *           l/A, Sparrow 0.94715525270918554 l/A; working f-number M/(2 NA). Eye: power M_t = M
 *           M_e, exit pupil 500 NA/M_t, field FN/M, useful powers 500 to 1000 NA, depth n (l/(2
 *           NA^2) + 0.34 mm/(NA M_t)). Camera: M_c = M adapter, pixel p/M_c, Nyquist pitch M_c
 *           l/(2 A), depth n l/NA^2 + n p/(M_c NA)
 * Source    Abbe, Rayleigh: [BornWolf99] 8.6.3; Sparrow: Astrophys. J. 44 (1916) 76; depth for the
 *           eye: [Berek27] as [LeicaDepth] has it; for a camera, with a pixel as the smallest
 *           distance e that is told apart, and useful powers: [MicroscopyU]; the exit pupil is
 *           2 NA x 250 mm/M_t
 * Errors    numbers not above 0; an index below 1; a numerical aperture not below the index
 * Limits    the depth of field is a convention: for NA above 0.9 and immersed objects exact wave
 *           optics gives some 20 % less; l/A is for gratings in full light
 */
bool microscope_compute(const struct microscope_setting *setting, struct microscope *result,
                        struct error *error);

/*
 * Numerical aperture that just resolves a distance, by Rayleigh.
 *
 * Given     distance  at the specimen, mm, > 0;  wavelength  um, > 0
 * Formula   1.2196698912665045 l/(2 distance)
 * Source    as microscope_compute, the condenser's aperture as large
 */
double microscope_aperture_for(double distance, double wavelength);

/*
 * Magnification of an objective with a tube lens of another focal length than it is marked for.
 *
 * Given     marked     magnification;  tube  focal length of the tube lens, mm
 *           reference  that of the tube lens it is marked for, mm
 * Formula   M tube/reference; its own focal length is reference/M
 * Source    definition of infinity-corrected objectives
 */
double microscope_magnification(double marked, double tube, double reference);

#endif
