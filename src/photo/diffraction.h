/* photo/diffraction.h - the Airy disc, resolution, and MTF of a perfect lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DIFFRACTION_H
#define LENSCALC_PHOTO_DIFFRACTION_H

#include <stdbool.h>

#include "base/error.h"

/* First zero of J1 over pi: the Airy disc's radius in units of wavelength x f-number. */
#define DIFFRACTION_AIRY_RADIUS 1.2196698912665045
/* Sparrow's separation in the same unit: where the sum of two Airy discs has no dip. */
#define DIFFRACTION_SPARROW 0.94715525270918554

/* A lens at work, for MTF and resolution. */
struct diffraction_setting {
    double N;          /* f-number as marked, > 0 */
    double m;          /* magnification, >= 0 */
    double P;          /* pupil magnification, > 0 */
    double wavelength; /* um, > 0 */
    double blur;       /* diameter of the defocus disc on the sensor, mm, >= 0; 0 = in focus */
    double pitch;      /* pixel pitch, mm, >= 0; 0 = no pixels (film) */
};

/* What follows from f-number and wavelength alone; lengths on the sensor in mm. */
struct diffraction {
    double working_fnumber;            /* N (1 + m/P) */
    double airy_diameter, airy_radius; /* to the first dark ring */
    double cutoff;                     /* cycles per mm, where the MTF ends */
    double rayleigh, sparrow;          /* separation of two points just resolved */
    double rayleigh_frequency;         /* 1/rayleigh, line pairs per mm */
    double nyquist;                    /* 1/(2 pitch), cycles per mm; inf without pixels */
};

/* Factors of the modulation transfer at one frequency, each 0 to 1. */
struct diffraction_mtf {
    double lens, defocus, pixel;
    double total; /* their product */
};

/* The smallest angles a lens tells apart at infinity, rad. */
struct diffraction_angles {
    double rayleigh, sparrow, dawes;
};

/* The best f-number for a given focus spread. */
struct diffraction_optimum {
    double fnumber;         /* to set, as marked */
    double working_fnumber; /* the same with magnification */
    double airy_diameter;   /* mm */
    double defocus;         /* disc at either end of the spread, mm; equal to the Airy diameter */
    double blur;            /* both combined, root of the sum of squares, mm */
};

/*
 * Airy disc, cut-off and resolution of a perfect lens with a circular aperture.
 *
 * Given     setting (blur is not used)
 * Formula   N_eff = N (1 + m/P), l the wavelength in mm. Airy diameter 2 x 1.2196698912665045 l
 *           N_eff (first zero of J1 3.8317059702075123 over pi), cut-off 1/(l N_eff), Rayleigh =
 *           Airy radius, Sparrow 0.94715525270918554 l N_eff (where I''(r/2) = 0 for I = (2
 *           J1(x)/x)^2)
 * Source    Born and Wolf, Principles of Optics, 8.5.2; Sparrow, Astrophys. J. 44 (1916) 76
 * Errors    values outside the ranges of struct diffraction_setting
 * Limits    scalar, paraxial: below f/1.4 or so use N_eff = 1/(2 sin theta'); f/64 at 500 nm gives
 *           the radius 0.03903 mm with the exact constant, 0.03904 with 1.22
 */
bool diffraction_compute(const struct diffraction_setting *setting, struct diffraction *result,
                         struct error *error);

/*
 * Modulation transfer at a spatial frequency on the sensor.
 *
 * Given     setting, and nu >= 0 in cycles per mm
 * Formula   lens: x = l N_eff nu, t = acos x: (2 t - sin 2t)/pi, equal to (2/pi)(acos x - x
 *           sqrt(1 - x^2)), with t = 2 asin sqrt((1 - x)/2) and a series for small t, so that the
 *           value keeps its digits up to the cut-off; 0 from there on. Defocus: |2 J1(z)/z|, z = pi
 *           blur nu. Pixel: |sin(z)/z|, z = pi pitch nu (square, filled)
 * Source    Goodman, Introduction to Fourier Optics, ch. 6; lenscalc.7, photography
 * Errors    nu below 0, a setting out of range
 * Limits    the product of lens and defocus is an approximation, good for a blur well above or well
 *           below the Airy disc; in between Hopkins' integral is some percent higher. Past a zero
 *           of the defocus factor contrast is reversed; the modulus is given
 */
bool diffraction_mtf_at(const struct diffraction_setting *setting, double nu,
                        struct diffraction_mtf *mtf, struct error *error);

/*
 * The lowest frequency at which the total MTF has fallen to a level.
 *
 * Given     setting, level above 0 and below 1 (0.5 for MTF50)
 * Result    cycles per mm, by bisection to the last digit below the first zero of any factor; all
 *           factors fall on the way there, so it is the only one. A perfect lens alone reaches
 *           50 %, 20 %, 10 % at 0.4040, 0.6870, 0.8054 of the cut-off
 * Errors    level or setting out of range
 */
bool diffraction_frequency(const struct diffraction_setting *setting, double level, double *nu,
                           struct error *error);

/*
 * The f-number, as marked, at which the Airy disc is as wide as something on the sensor: k pixels,
 * the circle of confusion, or (film of R line pairs/mm) 2/R, which makes the Rayleigh distance 1/R.
 *
 * Given     diameter  mm, > 0
 *           wavelength um, m, P
 * Formula   N = diameter/(2.4393397825330091 l (1 + m/P))
 * Errors    values out of range
 */
bool diffraction_fnumber(double diameter, double wavelength, double m, double P, double *N,
                         struct error *error);

/*
 * The f-number that makes the ends of a focus spread sharpest.
 *
 * Given     spread  distance between the images of the nearest and the farthest point, mm, > 0; the
 *                   sensor stands half-way
 *           wavelength um, m, P
 * Formula   minimise (dv/(2 N))^2 + (2 a l N)^2, a = 1.2196698912665045: both terms are equal at
 *           N_eff = sqrt(dv/(4 a l)), 4 a = 4.8786795650660178 (4.88 rounded); N = N_eff/(1 + m/P)
 * Source    Hansma, View camera focusing in practice, Photo Techniques 1996: N = sqrt(375 dv) at
 *           546 nm, the same criterion; here the constant is exact
 * Errors    values out of range
 * Limits    root of the sum of squares stands for the convolution of disc and Airy figure
 */
bool diffraction_optimum(double spread, double wavelength, double m, double P,
                         struct diffraction_optimum *result, struct error *error);

/*
 * The focus spread between two subject distances.
 *
 * Given     f > 0 mm; f < near <= far, mm from the front principal plane, far may be inf
 * Formula   dv = f^2 (1/(near - f) - 1/(far - f)) = f^2 (far - near)/((near - f)(far - f))
 * Errors    near within f, far before near
 */
bool diffraction_focus_spread(double f, double near, double far, double *spread,
                              struct error *error);

/*
 * The f-number, as marked, of a numerical aperture.
 *
 * Given     na  n sin(theta), > 0: of the cone at the subject if m > 0, else (far away) of the cone
 *               at the image
 *           m, P
 * Formula   m P/(2 NA (P + m)), so that N (1 + m/P) = m/(2 NA), the sine condition; 1/(2 NA) at m =
 *           0
 * Source    [BornWolf99] 4.5.1, the sine condition
 */
double fnumber_from_na(double na, double m, double P);

/*
 * Angular resolution of an aperture.
 *
 * Given     diameter of the entrance pupil, mm, > 0 (f/N); wavelength um
 * Formula   Rayleigh 1.2196698912665045 l/D, Sparrow 0.94715525270918554 l/D, Dawes 116
 *           arcsec/D(mm)
 * Source    Dawes 1867, an empirical rule for two equal stars, whatever the wavelength
 * Errors    values out of range
 */
bool diffraction_resolve(double diameter, double wavelength, struct diffraction_angles *angles,
                         struct error *error);

#endif
