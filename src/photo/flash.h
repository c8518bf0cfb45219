/* photo/flash.h - guide numbers, several flashes, flash against the light that is there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_FLASH_H
#define LENSCALC_PHOTO_FLASH_H

#include "base/error.h"

/* One flash exposure; NaN is "not given". */
struct flash_setting {
    double GN;      /* guide number at ISO 100, full power, one flash: f-number times mm, > 0 */
    double N;       /* f-number, > 0 */
    double d;       /* flash to subject along the light's path, mm, > 0 */
    double S;       /* ISO, > 0 */
    double power;   /* fraction of full power, above 0 and up to 1 */
    double flashes; /* number of equal flashes side by side, > 0; solved for, it may be broken */
    double loss;    /* stops lost to bounce, umbrella, gel, lens; 0..100; NaN: 0 */
};

/* Which quantity was the unknown. */
enum flash_unknown { FLASH_GN, FLASH_N, FLASH_D, FLASH_S, FLASH_POWER, FLASH_FLASHES };

/*
 * Solve the guide number equation for the one number that is missing.
 *
 * Given     setting  all but one of its members (loss aside). Where GN, N or d is the unknown,
 *                    missing S, power and flashes are taken as 100, 1 and 1; where all three are
 *                    given, the unknown is the first missing of power, S, flashes, and the others
 *                    are taken so; all of them, if they agree within 0.3 % of the light, as an
 *                    answer's do: they stay
 * Result    setting  is complete; unknown says what was solved for
 * Formula   N d = GN sqrt(flashes (S/100) power 2^-loss)
 * Source    definition of the guide number (ISO 1230); flashes add in squares because light adds:
 *           Wikipedia "Guide number"
 * Errors    two of GN, N, d missing, or nothing and they disagree (ERROR_USAGE); a number outside
 *           its range; a power over full: says how many stops are lacking (ERROR_DOMAIN)
 * Limits    a point source in a normal room: outdoors or in a dark hall 0.5 to 1 stop less; wrong
 *           nearer than about five times the reflector's width
 */
bool flash_solve(struct flash_setting *setting, enum flash_unknown *unknown, struct error *error);

/*
 * Guide number of unequal flashes on one subject from one distance.
 *
 * Given     GN     guide numbers, count >= 1 of them, each > 0
 * Result    sum    same unit
 * Formula   sqrt(sum GN_i^2)
 * Source    light adds, and GN^2 is proportional to it
 * Errors    a guide number not above 0, none at all
 */
bool flash_sum(const double *GN, int count, double *sum, struct error *error);

/* The guide number of a flash whose reflector zooms, at one of its marks. */
struct flash_mark {
    double f;  /* focal length that the reflector is set for, mm, > 0 */
    double GN; /* mm, > 0 */
};

/*
 * Guide number between the marks of a zooming reflector.
 *
 * Given     marks  count >= 1 of them, as the manual lists them, focal lengths rising
 *           f      focal length the reflector is set to, mm
 *           GN     receives the guide number, mm
 * Formula   between two marks 2 log2(GN) is linear in log(f): so many stops for so many octaves
 * Source    interpolation of this program's own; at the marks it is the manual's figure
 * Errors    a focal length outside the marks, marks that do not rise, numbers not above 0
 * Limits    reflectors step from mark to mark; between them makers state nothing
 */
bool flash_zoomed(const struct flash_mark *marks, int count, double f, double *GN,
                  struct error *error);

/*
 * Length of a bounced light path, over a ceiling or a wall.
 *
 * Given     along       distance from flash to subject measured along the surface, mm, >= 0
 *           flash_gap   from the flash to the surface, mm, > 0
 *           subject_gap from the subject to the surface, mm, > 0
 * Result    d           mm: what to put into flash_solve
 * Formula   sqrt(along^2 + (flash_gap + subject_gap)^2)
 * Source    mirror image of the flash
 * Errors    a number outside its range
 * Limits    a white ceiling scatters: add its loss, 1 to 2 stops, as `loss`
 */
bool flash_bounce(double along, double flash_gap, double subject_gap, double *d,
                  struct error *error);

/*
 * Fall-off between two distances.
 *
 * Given     near, far  distances from the flash, mm, > 0
 * Result    stops      by which `far` gets less light than `near`
 * Formula   2 log2(far/near)
 * Source    inverse square law
 * Errors    a distance not above 0
 */
bool flash_falloff(double near, double far, double *stops, struct error *error);

/*
 * Lighting ratio of a key and a fill light.
 *
 * Given     stops   by which the key alone is brighter than the fill alone; any finite number
 *           ratio   lit side to shadow side, > 1
 * Result    ratio, or stops
 * Formula   ratio = (key + fill)/fill = 2^stops + 1
 * Source    American Society of Cinematographers' definition (Wikipedia "Lighting ratio"): 1 stop
 *           is 3:1, 2 stops are 5:1. Others print key:fill = 2^stops, one less
 * Errors    a ratio not above 1 (its fill would be infinite), stops that are not finite
 */
bool lighting_ratio(double stops, double *ratio, struct error *error);
bool lighting_stops(double ratio, double *stops, struct error *error);

/* Camera and light that meet a flash. */
struct flash_ambient {
    struct flash_setting flash; /* complete; its N and S are the camera's */
    double t;                   /* exposure time, s, > 0 */
    double sync;                /* shortest time with flash, s, > 0; NaN: any (leaf shutter) */
    double ev100;               /* ambient light, EV at ISO 100, -100..100 */
};

/* Exposures in stops against the correct one, 0. */
struct flash_balance {
    double flash;            /* of the flash alone */
    double ambient;          /* of the ambient light alone */
    double total;            /* of both */
    double flash_to_ambient; /* flash - ambient: + flash leads, - fill flash */
    double ratio;            /* lit by both to lit by ambient alone, >= 1 */
};

/*
 * Flash and ambient light in one exposure.
 *
 * Given     scene
 * Result    balance
 * Formula   flash = 2 log2(GN sqrt(flashes S/100 power 2^-loss)/(N d)),
 *           ambient = EV100 + log2(S/100) - log2(N^2/t), total = log2(2^flash + 2^ambient),
 *           ratio = 2^flash_to_ambient + 1
 * Source    definitions of guide number and exposure value; light adds
 * Errors    an incomplete flash (ERROR_USAGE); numbers outside their ranges; a time shorter than
 *           the sync time
 * Limits    `loss` here is the flash's; a filter on the lens takes light from both
 */
bool flash_against_ambient(const struct flash_ambient *light, struct flash_balance *balance,
                           struct error *error);

#endif
