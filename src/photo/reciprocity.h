/* photo/reciprocity.h - reciprocity failure of films: metered time to corrected time and back. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_RECIPROCITY_H
#define LENSCALC_PHOTO_RECIPROCITY_H

#include "base/error.h"
#include "base/text.h"

#define RECIPROCITY_POINTS 16

/* The shapes in which corrections are published. */
enum reciprocity_model {
    RECIPROCITY_NONE,  /* no correction up to valid_to, nothing known beyond */
    RECIPROCITY_POWER, /* Tc = Tm^p above the onset (Ilford) */
    RECIPROCITY_TABLE, /* published points, times or stops (Kodak, Foma, Fujifilm) */
    RECIPROCITY_GAINER /* Tc = Tm + a Tm^1.62 (P. Gainer, from H. Bond's data) */
};

/* A film's published correction; times in s. */
struct reciprocity {
    enum reciprocity_model model;
    double onset;    /* no correction up to here; >= 0 */
    double valid_to; /* longest metered time that was published; inf where none is stated */
    double p, a;     /* of RECIPROCITY_POWER (>= 1) and RECIPROCITY_GAINER (> 0) */
    int points;      /* of RECIPROCITY_TABLE; the first is the onset, uncorrected */
    double metered[RECIPROCITY_POINTS], corrected[RECIPROCITY_POINTS]; /* both ascending */
};

/*
 * Read the columns `model` and `parameters` of film-reciprocity.tsv.
 *
 * Given     model       power, table, stops, gainer or none
 *           parameters  power   p=1.31
 *                       table   metered:corrected;...   0.1:0.1;1:2;10:50;100:1200
 *                       stops   <T:0 or <=T:0 (none up to T), T:+1/3 (a point), A-B:+1/2 (a flat
 *                               band), >=T:words (nothing from T on); a blank ends an item's
 *                               number, words after it are notes; an item with '?' is not
 *                               published: it and all that follows is left out
 *                       gainer  a=0.101
 *                       none    any words
 *           onset       column onset_s, s, >= 0
 *           valid_to    column valid_to_s, s; NaN, 0 or below: not stated
 * Result    film; stops become corrected times Tm 2^stops, so that one table serves both
 * Source    lenscalc data README; the file names the maker's sheet of each film
 * Errors    ERROR_DATA with the place in `parameters`
 * Limits    stops turned into time rather than aperture underexpose by the further failure during
 *           the added time (Kodak: +3 stops of aperture, but 12 x = 3.58 stops of time at 100 s)
 */
bool reciprocity_parse(struct text model, struct text parameters, double onset, double valid_to,
                       struct reciprocity *film, struct error *error);

/*
 * Exposure time that makes up for reciprocity failure.
 *
 * Given     film
 *           Tm    metered (indicated) time, s, > 0
 * Result    Tc    corrected time, s, >= Tm; Tm itself up to the onset
 * Formula   as published: Tm^p; Tm + a Tm^1.62; or between published points a straight line in
 *           log Tc against log Tm (exact at the points)
 * Source    Ilford, "Film Reciprocity Failure Compensation" (Tc = Tm^p); Kodak F-4017 (table);
 *           P. Gainer, apug.org forum37/11566
 * Errors    Tm not above 0; Tm beyond the published range
 * Limits    published for one emulsion and developer at low light; nothing for times below
 *           1/10000 s (high-intensity failure); makers' and third parties' figures differ by 0.6
 *           stop (HP5 Plus at 100 s: Ilford 417 s, Gainer 275 s)
 */
bool reciprocity_corrected(const struct reciprocity *film, double Tm, double *Tc,
                           struct error *error);

/*
 * The inverse: the metered time that a corrected time serves.
 *
 * Given     film
 *           Tc    exposure time on the film, s, > 0
 * Result    Tm    metered time, s, <= Tc
 * Formula   inverse of the above; Gainer's by Newton from above (convex, so it descends
 *           monotonically; at most 60 steps)
 * Source    as above
 * Errors    Tc not above 0; Tc beyond what the longest published time asks for; Tc in a gap where
 *           the published correction jumps (Acros: no metered time gives 120 s to 169.7 s)
 */
bool reciprocity_metered(const struct reciprocity *film, double Tc, double *Tm,
                         struct error *error);

/*
 * The correction in stops of time, log2(Tc/Tm).
 *
 * Given     Tm, Tc  s, > 0 (the caller's promise)
 */
double reciprocity_stops(double Tm, double Tc);

#endif
