/* photo/visual.h - telescopes and binoculars, with the eye behind them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_VISUAL_H
#define LENSCALC_PHOTO_VISUAL_H

#include "base/error.h"

/*
 * A telescope and an eyepiece, as far as they are known; NaN = not given. Lengths in mm. The
 * relations between them make the rest.
 */
struct visual_setting {
    double focal, diameter, fnumber; /* of the telescope; two of them make the third */
    double barlow;                   /* factor of a Barlow lens (2) or reducer (0.63), > 0 */
    double eyepiece;                 /* its focal length */
    double power;                    /* angular magnification */
    double exit_pupil;               /* its diameter */
};

/*
 * What is not given of a telescope and its eyepiece.
 *
 * Given     setting  receives what follows from the rest; what does not stays NaN
 * Formula   N = f/D; M = f B/f_e; exit pupil = D/M
 * Source    [Smith08]
 * Errors    ERROR_DOMAIN: a number not above 0; ERROR_USAGE: numbers that contradict each other by
 *           more than 2 %, as 1200 mm, 200 mm and f/5 do
 */
bool visual_solve(struct visual_setting *setting, struct error *error);

/* What is seen at once; angles in rad, NaN = not known. */
struct visual_field {
    double stop;                           /* diameter of the eyepiece's field stop, mm */
    double apparent;                       /* field of the eyepiece, full angle */
    double true_field;                     /* in the sky or the landscape, full angle */
    double true_by_ratio, true_by_tangent; /* of a given apparent field */
    double apparent_by_ratio;              /* of a true field that does not follow from it */
    /* option, field-stop, ratio or tangents; null where there is none */
    const char *true_from, *apparent_from;
};

/*
 * True and apparent field.
 *
 * Given     focal  of telescope and Barlow lens, mm, NaN of binoculars;  power, or NaN
 *           field  stop, apparent and true_field as far as they are given
 * Result    field  the true field as given, else by the field stop, else by the apparent field over
 *                  the power (of binoculars by the tangents); the apparent field as given, else
 *                  by the tangents
 * Formula   stop: 2 atan(s/(2 f)); ratio: a/M; tangent: tan(a/2) = M tan(w/2)
 * Source    stop: geometry of an image without distortion; ratio: the makers' rule; tangent:
 *           [IsoBinoculars02]
 * Errors    angles of 180 deg and more
 * Limits    eyepieces distort: those of wide field lie between ratio and tangent; the field stop is
 *           the measure of those that have one in front of their lenses
 */
bool visual_see(double focal, double power, struct visual_field *field, struct error *error);

/* The eye behind it. */
struct visual_eye {
    double pupil;     /* diameter, mm */
    double magnitude; /* of the faintest star that it sees without help */
};

/* What it gathers and resolves; NaN where the power is needed and not known. */
struct visual_light {
    double used_diameter;            /* of the aperture that the eye's pupil lets through, mm */
    double gain;                     /* light of a star over that of the eye alone */
    double magnitude;                /* of the faintest star */
    double rayleigh, dawes;          /* of the aperture that is used, rad */
    double lowest, matched, highest; /* powers: see the formulas */
    double brightness;               /* square of the exit pupil in mm */
    double twilight;                 /* twilight factor */
};

/*
 * Light and resolution.
 *
 * Given     setting     solved; its diameter is given
 *           eye         pupil > 0
 *           obstruction diameter of the secondary mirror over that of the telescope, 0 to below 1
 *           wavelength  um
 * Formula   used D_u = min(D, M d) for an eye's pupil d; gain = (D_u^2 - (o D)^2)/d^2; magnitude =
 *           m_eye + 2.5 log10(gain); Rayleigh and Dawes of D_u (photo/diffraction.h); lowest power
 *           D/d; matched: at which the Rayleigh limit of D is 1 arcmin; highest 2 D/mm;
 *           brightness (D/M)^2; twilight sqrt(M D)
 * Source    areas of the pupils; matched power: [Smith08] ch. 13; highest power: 50 an inch, a rule
 *           of thumb; twilight factor and brightness: figures of the makers of binoculars
 * Errors    numbers outside their ranges; an obstruction that shades all that the eye uses
 * Limits    a perfect sky at the limit of the eye as given, glass that loses nothing; an
 *           obstruction takes light but leaves the resolution of two stars
 */
bool visual_gather(const struct visual_setting *setting, const struct visual_eye *eye,
                   double obstruction, double wavelength, struct visual_light *light,
                   struct error *error);

/*
 * Eye relief: the exit pupil behind the eyepiece.
 *
 * Given     focal     of the telescope, mm: its aperture stands so far before its focus
 *           eyepiece  focal length;  back  its focus on the eye's side, from its last vertex, mm
 * Formula   back + f_e^2/f
 * Source    Newton's form of the image equation, [Smith08]: the aperture is f before F
 * Limits    the eyepiece stands for an eye focused at infinity; a Barlow lens moves the pupil
 */
double visual_eye_relief(double focal, double eyepiece, double back);

/*
 * Back focus with a plane filter in the converging beam, which shifts the focus away.
 *
 * Given     thickness  mm;  n  index of the filter
 * Result    what is to be added to the back focus, mm
 * Formula   t (1 - 1/n)
 * Source    [Smith08], plane parallel plate
 * Limits    paraxial: at f/2 the rays of the edge focus 0.01 t farther
 */
double visual_filter_shift(double thickness, double n);

/*
 * The exit pupil of thin lenses: the image of the objective by the eyepiece.
 *
 * Given     focal  of the objective;  eyepiece  its focal length, below 0 of a Galilean one, mm
 * Result    behind the eyepiece, mm; below 0 in front of it, a virtual image
 * Formula   f_e (f + f_e)/f
 * Source    [Smith08]: 1/x = 1/f_e - 1/(f + f_e)
 */
double visual_pupil_place(double focal, double eyepiece);

/* A camera behind an eyepiece: mm, NaN = not given; one of projection and afocal is. */
struct visual_camera_given {
    double focal, diameter; /* of telescope and Barlow lens */
    double eyepiece, power; /* its focal length; the magnification for the eye */
    double projection;      /* from the eyepiece to the sensor of a camera without a lens */
    double afocal;          /* focal length of the camera's lens */
};

/* What it makes of them; NaN where that is not known. */
struct visual_camera {
    double factor; /* focal length over that of the telescope */
    double focal;  /* mm */
    double fnumber;
};

/*
 * Photographs through an eyepiece.
 *
 * Given     given
 * Result    camera
 * Formula   projection: k = v/f_e - 1; afocal: F = M f_c, k = f_c/f_e; F = k f, N = F/D
 * Source    thin lens 1/f_e = 1/u + 1/v with k = v/u; afocal: M of parallel light, f_c tan(M a)
 * Errors    ERROR_USAGE: nothing that says the focal length of the eyepiece, for a projection;
 *           ERROR_DOMAIN: a sensor within the focal length of the eyepiece
 * Limits    thin lenses; afocal: the lens of the camera takes in all of the exit pupil
 */
bool visual_photograph(const struct visual_camera_given *given, struct visual_camera *camera,
                       struct error *error);

#endif
