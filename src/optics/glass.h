/* optics/glass.h - refractive index of optical materials by wavelength and temperature. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_GLASS_H
#define LENSCALC_OPTICS_GLASS_H

#include "base/error.h"
#include "base/pair.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

enum glass_formula {
    GLASS_CONSTANT,
    GLASS_ND_VD,
    GLASS_SELLMEIER,
    GLASS_SELLMEIER_SQ,
    GLASS_SCHOTT,
    GLASS_POWER,
    GLASS_CONRADY,
    GLASS_HERZBERGER,
    GLASS_RESONANCES,
    GLASS_TABLE,
    GLASS_CAUCHY,
    GLASS_BUCHDAHL,
    GLASS_FORMULAS
};

enum { GLASS_MOST_COEFFICIENTS = 17, GLASS_NAME = 64 };

/* A value at a wavelength. */
struct glass_point {
    struct pair wavelength; /* um */
    struct pair value;
};

/* dn/dT, as the index changes with temperature; NaN where it is not known. */
struct glass_thermal {
    double reference;  /* C, where the formula holds; NaN if not stated */
    double d0, d1, d2; /* 1/K, 1/K^2, 1/K^3 */
    double e0, e1;     /* um^2/K, um^2/K^2 */
    double resonance;  /* um; its square has its sign */
};

/* A material. Names, table and transmittance belong to who made it. */
struct glass {
    struct text catalog, name;
    enum glass_formula formula;
    size_t count;
    struct pair coefficients[GLASS_MOST_COEFFICIENTS]; /* with what a double leaves over */
    const struct glass_point *table; /* of GLASS_TABLE: indices by rising wavelength */
    size_t table_count;
    double shortest, longest; /* um, where the formula holds; NaN if not stated */
    struct glass_thermal thermal;
    const struct glass_point *transmittance; /* internal, of 10 mm, by rising wavelength */
    size_t transmittance_count;
};

/* The formula of this name ("schott"), and the name of a formula; GLASS_FORMULAS if there is none.
 */
enum glass_formula glass_formula_of(struct text name);
const char *glass_formula_name(enum glass_formula formula);

/* Has the formula so many coefficients? */
bool glass_count_fits(enum glass_formula formula, size_t count);

/*
 * Simple materials: one index for all light; or nd and Vd as a designer states them.
 *
 * Formula   n = A + B/l^2 with n(d) = nd and n(F) - n(C) = (nd - 1)/Vd; nearly the glass's own
 *           dispersion in the visible, but no substitute for it. With the double WAVELENGTH_D it
 *           is nd to the last bit of both parts
 */
struct glass glass_constant(struct pair n);
struct glass glass_nd_vd(struct pair nd, struct pair Vd);

/* The index and how it changes. */
struct glass_index {
    struct pair n;
    double slope; /* dn/dl, 1/um */
};

/*
 * Refractive index relative to air at the glass's reference temperature and 101325 Pa.
 *
 * Given     wavelength  um, in that air, above 0
 * Result    n to 4e-16 of the formula for the decimal coefficients; the low part goes on. NaN
 *           where the formula gives no real index. Does not look at the range
 * Formula   l = wavelength
 *           GLASS_SELLMEIER     n^2 = 1 + sum B l^2/(l^2 - C)        B1 C1 B2 C2 ..
 *           GLASS_SELLMEIER_SQ  n^2 = 1 + c0 + sum B l^2/(l^2 - L^2) c0 B1 L1 ..
 *           GLASS_SCHOTT        n^2 = a0 + a1 l^2 + a2 l^-2 + a3 l^-4 + a4 l^-6 + a5 l^-8
 *           GLASS_POWER         n^2 = c0 + sum c l^p, p even         c0 c1 p1 c2 p2 ..
 *           GLASS_CONRADY       n = n0 + A/l + B/l^3.5
 *           GLASS_HERZBERGER    n = A + B z + C z^2 + D l^2 + E l^4 + F l^6, z = 1/(l^2 - 0.028)
 *           GLASS_RESONANCES    n^2 = a + b l^2 + sum (p l^2 + q)/(l^2 - c)      a b p1 q1 c1 ..
 *           GLASS_CAUCHY        n = A + B/l^2 + C/l^4 + ..
 *           GLASS_BUCHDAHL      n = n0 + v1 w + v2 w^2 + .., w = (l - l0)/(1 + 2.5 (l - l0));
 *                               l0 n0 v1 v2 ..
 *           GLASS_TABLE         the polynomial in 1/l^2 through the four nearest entries (two on
 *                               each side; fewer where there are fewer): exact at the entries
 * Source    [Schott16]; [Buchdahl68] for his coordinate w; the other forms are those of the makers'
 *           AGF catalogues
 * Limits    the slope has ordinary double precision; of a table it jumps at the entries
 */
struct glass_index glass_index(const struct glass *glass, struct pair wavelength);

/* The same as one double at a wavelength given as one. */
double glass_n(const struct glass *glass, double wavelength);

/*
 * Is there an index at this wavelength (um)?
 *
 * Errors    ERROR_DOMAIN naming glass, wavelength and range; an end of the range belongs to it
 */
bool glass_check_range(const struct glass *glass, double wavelength, struct error *error);

/* What is said of a glass in a catalogue, recomputed; NaN where its range does not reach. */
struct glass_summary {
    double nd, Vd;    /* Vd = (nd - 1)/(nF - nC) */
    double ne, Ve;    /* Ve = (ne - 1)/(nF' - nC') */
    double PgF, PdC;  /* partial dispersions (ng - nF)/(nF - nC), (nd - nC)/(nF - nC) */
    double deviation; /* PgF - (0.6438 - 0.001682 Vd), from the normal line of [Schott16] */
};

struct glass_summary glass_summary(const struct glass *glass);

/* nd and Vd of it alone, in half the time. */
struct glass_abbe {
    double nd, Vd;
};

struct glass_abbe glass_abbe(const struct glass *glass);

/* The indices at lines that serve several questions; NaN where the range does not reach. */
struct glass_lines {
    struct pair g, F, e, d, C;
};

struct glass_lines glass_lines(const struct glass *glass);

/* As glass_summary, with the lines at hand. */
struct glass_summary glass_summary_of(const struct glass *glass, const struct glass_lines *lines);

/*
 * How unlike two glasses are: root mean square of the differences of index at the lines g F e d C;
 * NaN where a range does not reach.
 */
double glass_difference(const struct glass_lines *a, const struct glass_lines *b);

/*
 * Internal transmittance of a thickness.
 *
 * Given     wavelength um; thickness mm, 0 or more
 * Result    tau(10 mm)^(thickness/10 mm), tau linear in the wavelength between the catalogue's
 *           points; NaN outside of them
 */
double glass_transmittance(const struct glass *glass, double wavelength, double thickness);

#endif
