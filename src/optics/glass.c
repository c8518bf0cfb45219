/* optics/glass.c - refractive index of optical materials by wavelength. */
/* SPDX-License-Identifier: MIT */
#include "optics/glass.h"

#include <math.h>

/* What a formula gives: n or n^2, and its derivative. */
struct value {
    struct twofold y;
    double dy; /* by l, 1/um */
};

/* The square of the wavelength is what nearly all formulas want. */
struct light {
    struct twofold l, square; /* um, um^2 */
};

static struct twofold times(struct twofold a, double b)
{
    return twofold_multiply(a, twofold_of(b));
}

static struct twofold inverse(struct twofold a)
{
    return twofold_divide(twofold_of(1), a);
}

static struct value constant(const struct glass *glass, const struct light *light)
{
    (void)light;
    return (struct value){glass->coefficients[0], 0};
}

/* A line's wavelength as the decimal it is, um. */
static struct twofold line(double units)
{
    return twofold_divide(twofold_of(units), twofold_of(1e7));
}

static struct twofold inverse_square(double units)
{
    struct twofold l = line(units);
    return inverse(twofold_multiply(l, l));
}

static struct value nd_vd(const struct glass *glass, const struct light *light)
{
    const struct twofold *c = glass->coefficients;
    struct twofold one = twofold_of(1), d = inverse_square(5875618);
    struct twofold span = twofold_subtract(inverse_square(4861327), inverse_square(6562725));
    struct twofold B = twofold_divide(twofold_subtract(c[0], one), twofold_multiply(c[1], span));
    struct twofold from_d = twofold_subtract(inverse(light->square), d);
    double l = light->l.high;
    return (struct value){twofold_add(c[0], twofold_multiply(B, from_d)),
                          -2 * B.high / (l * l * l)};
}

/* Add B l^2/(l^2 - C). */
static void add_resonance(struct value *value, const struct light *light, struct twofold B,
                          struct twofold C)
{
    struct twofold gap = twofold_subtract(light->square, C);
    struct twofold term = twofold_divide(twofold_multiply(B, light->square), gap);
    value->y = twofold_add(value->y, term);
    value->dy -= 2 * B.high * C.high * light->l.high / (gap.high * gap.high);
}

static struct value sellmeier(const struct glass *glass, const struct light *light)
{
    struct value value = {{1, 0}, 0};
    for (size_t i = 0; i + 1 < glass->count; i += 2) {
        add_resonance(&value, light, glass->coefficients[i], glass->coefficients[i + 1]);
    }
    return value;
}

static struct value sellmeier_sq(const struct glass *glass, const struct light *light)
{
    const struct twofold *c = glass->coefficients;
    struct value value = {twofold_add(twofold_of(1), c[0]), 0};
    for (size_t i = 1; i + 1 < glass->count; i += 2) {
        add_resonance(&value, light, c[i], twofold_multiply(c[i + 1], c[i + 1]));
    }
    return value;
}

/* Add c l^p for an even p. */
static void add_power(struct value *value, const struct light *light, struct twofold c, int p)
{
    struct twofold power = twofold_of(1);
    for (int i = 0; i < (p < 0 ? -p : p); i += 2) {
        power = twofold_multiply(power, light->square);
    }
    struct twofold term = p < 0 ? twofold_divide(c, power) : twofold_multiply(c, power);
    value->y = twofold_add(value->y, term);
    value->dy += p * term.high / light->l.high;
}

static struct value schott(const struct glass *glass, const struct light *light)
{
    static const int powers[] = {0, 2, -2, -4, -6, -8};
    const struct twofold *c = glass->coefficients;
    struct twofold x = inverse(light->square);
    /* the negative powers by Horner's rule */
    struct twofold sum = times(x, 0);
    double slope = 0;
    for (size_t i = 5; i >= 2; i--) {
        sum = twofold_multiply(twofold_add(sum, c[i]), x);
        slope = slope * x.high + powers[i] * c[i].high;
    }
    sum = twofold_add(sum, twofold_multiply(c[1], light->square));
    double l = light->l.high;
    return (struct value){twofold_add(c[0], sum), slope * x.high / l + 2 * c[1].high * l};
}

static struct value power(const struct glass *glass, const struct light *light)
{
    struct value value = {glass->coefficients[0], 0};
    for (size_t i = 1; i + 1 < glass->count; i += 2) {
        add_power(&value, light, glass->coefficients[i], (int)glass->coefficients[i + 1].high);
    }
    return value;
}

static struct value conrady(const struct glass *glass, const struct light *light)
{
    const struct twofold *c = glass->coefficients;
    struct twofold cube = twofold_multiply(light->l, light->square);
    struct twofold a = twofold_divide(c[1], light->l);
    struct twofold b = twofold_divide(c[2], twofold_multiply(cube, twofold_root(light->l)));
    return (struct value){twofold_add(c[0], twofold_add(a, b)),
                          -(a.high + 3.5 * b.high) / light->l.high};
}

static struct value herzberger(const struct glass *glass, const struct light *light)
{
    const struct twofold *c = glass->coefficients;
    const struct twofold pole = twofold_divide(twofold_of(28), twofold_of(1000));
    struct twofold z = inverse(twofold_subtract(light->square, pole));
    struct twofold sum = twofold_multiply(twofold_add(twofold_multiply(c[2], z), c[1]), z);
    double dz = -2 * light->l.high * z.high * z.high;
    struct value value = {twofold_add(c[0], sum), (c[1].high + 2 * c[2].high * z.high) * dz};
    for (int i = 3; i < 6; i++) {
        add_power(&value, light, c[i], 2 * (i - 2));
    }
    return value;
}

/* Where the entries that serve a wavelength begin: two on each side of it, if there are so many. */
static size_t first_entry(const struct glass *glass, double l, size_t wanted)
{
    size_t above = 0;
    while (above < glass->table_count && glass->table[above].wavelength.high < l) {
        above++;
    }
    size_t first = above > wanted / 2 ? above - wanted / 2 : 0;
    return first + wanted > glass->table_count ? glass->table_count - wanted : first;
}

/* Lagrange's polynomial in x = 1/l^2, and its derivative by l. */
static struct value table(const struct glass *glass, const struct light *light)
{
    enum { POINTS = 4 };
    size_t count = glass->table_count < POINTS ? glass->table_count : POINTS;
    const struct glass_point *at = glass->table + first_entry(glass, light->l.high, count);
    struct twofold x = inverse(light->square), nodes[POINTS];
    struct value value = {{0, 0}, 0};
    for (size_t i = 0; i < count; i++) {
        nodes[i] = inverse(twofold_multiply(at[i].wavelength, at[i].wavelength));
    }
    for (size_t i = 0; i < count; i++) {
        struct twofold weight = at[i].value;
        double slope = 0; /* of the product without at[i].value / scale */
        double product = 1, scale = 1;
        for (size_t j = 0; j < count; j++) {
            if (j != i) {
                struct twofold step = twofold_subtract(nodes[i], nodes[j]);
                struct twofold gap = twofold_subtract(x, nodes[j]);
                weight = twofold_divide(twofold_multiply(weight, gap), step);
                slope = slope * gap.high + product;
                product *= gap.high;
                scale *= step.high;
            }
        }
        value.y = twofold_add(value.y, weight);
        value.dy += slope * at[i].value.high / scale;
    }
    value.dy *= -2 * x.high / light->l.high;
    return value;
}

/* In the order of enum glass_formula. */
static const struct {
    const char *name;
    size_t least, most, step; /* numbers of coefficients */
    bool is_square;           /* gives n^2 */
    struct value (*compute)(const struct glass *glass, const struct light *light);
} formulas[] = {
    {"constant", 1, 1, 1, false, constant},   {"nd_vd", 2, 2, 1, false, nd_vd},
    {"sellmeier", 2, 16, 2, true, sellmeier}, {"sellmeier_sq", 3, 15, 2, true, sellmeier_sq},
    {"schott", 6, 6, 1, true, schott},        {"power", 1, 15, 2, true, power},
    {"conrady", 3, 3, 1, false, conrady},     {"herzberger", 6, 6, 1, false, herzberger},
    {"table", 0, 0, 1, false, table},
};

enum glass_formula glass_formula_of(struct text name)
{
    for (enum glass_formula i = 0; i < GLASS_FORMULAS; i++) {
        if (text_equal(name, formulas[i].name)) {
            return i;
        }
    }
    return GLASS_FORMULAS;
}

const char *glass_formula_name(enum glass_formula formula)
{
    return formulas[formula].name;
}

bool glass_count_fits(enum glass_formula formula, size_t count)
{
    return count >= formulas[formula].least && count <= formulas[formula].most &&
           (count - formulas[formula].least) % formulas[formula].step == 0;
}

static const struct glass_thermal unknown_thermal = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};

struct glass glass_constant(struct twofold n)
{
    return (struct glass){.formula = GLASS_CONSTANT,
                          .count = 1,
                          .coefficients = {n},
                          .shortest = NAN,
                          .longest = NAN,
                          .thermal = unknown_thermal};
}

struct glass glass_nd_vd(struct twofold nd, struct twofold Vd)
{
    return (struct glass){.formula = GLASS_ND_VD,
                          .count = 2,
                          .coefficients = {nd, Vd},
                          .shortest = NAN,
                          .longest = NAN,
                          .thermal = unknown_thermal};
}

struct glass_index glass_index(const struct glass *glass, struct twofold wavelength)
{
    const struct light light = {wavelength, twofold_multiply(wavelength, wavelength)};
    struct value value = formulas[glass->formula].compute(glass, &light);
    if (!formulas[glass->formula].is_square) {
        return (struct glass_index){value.y, value.dy};
    }
    struct twofold n = twofold_root(value.y);
    return (struct glass_index){n, value.dy / (2 * n.high)};
}

double glass_n(const struct glass *glass, double wavelength)
{
    return glass_index(glass, twofold_of(wavelength)).n.high;
}

/* The ends belong to the range, however they came to be written. */
static bool reaches(const struct glass *glass, double wavelength)
{
    const double slack = 1e-12;
    return !(wavelength < glass->shortest * (1 - slack) ||
             wavelength > glass->longest * (1 + slack));
}

bool glass_check_range(const struct glass *glass, double wavelength, struct error *error)
{
    if (!(wavelength > 0) || isinf(wavelength)) {
        return fail(error, ERROR_DOMAIN, "a wavelength is above 0 and finite");
    }
    if (!reaches(glass, wavelength)) {
        return fail(error, ERROR_DOMAIN,
                    "wavelength %.10g nm is outside the range of %.*s:%.*s, %.10g to %.10g nm",
                    1000 * wavelength, (int)glass->catalog.length, glass->catalog.start,
                    (int)glass->name.length, glass->name.start, 1000 * glass->shortest,
                    1000 * glass->longest);
    }
    if (!(glass_n(glass, wavelength) > 0)) {
        return fail(error, ERROR_DOMAIN, "the formula of %.*s:%.*s gives no index at %.10g nm",
                    (int)glass->catalog.length, glass->catalog.start, (int)glass->name.length,
                    glass->name.start, 1000 * wavelength);
    }
    return true;
}

/* The index at a line with its low part, NaN where the range does not reach. */
static struct twofold at_line(const struct glass *glass, double l)
{
    return reaches(glass, l) ? glass_index(glass, twofold_of(l)).n : twofold_of(NAN);
}

static double difference(struct twofold a, struct twofold b)
{
    return (a.high - b.high) + (a.low - b.low);
}

struct glass_summary glass_summary(const struct glass *glass)
{
    struct twofold g = at_line(glass, GLASS_LINE_G), F = at_line(glass, GLASS_LINE_F);
    struct twofold d = at_line(glass, GLASS_LINE_D), C = at_line(glass, GLASS_LINE_C);
    struct twofold e = at_line(glass, GLASS_LINE_E);
    double spread = difference(F, C);
    double other_spread = difference(at_line(glass, GLASS_LINE_FC), at_line(glass, GLASS_LINE_CC));
    struct glass_summary summary = {.nd = d.high, .ne = e.high};
    bool disperses = !(fabs(spread) <= 0); /* a constant has no Vd */
    summary.Vd = disperses ? difference(d, twofold_of(1)) / spread : NAN;
    summary.Ve = disperses ? difference(e, twofold_of(1)) / other_spread : NAN;
    summary.PgF = disperses ? difference(g, F) / spread : NAN;
    summary.PdC = disperses ? difference(d, C) / spread : NAN;
    summary.deviation = summary.PgF - (0.6438 - 0.001682 * summary.Vd);
    return summary;
}

double glass_difference(const struct glass *a, const struct glass *b)
{
    static const double lines[] = {GLASS_LINE_G, GLASS_LINE_F, GLASS_LINE_E, GLASS_LINE_D,
                                   GLASS_LINE_C};
    double sum = 0;
    for (size_t i = 0; i < 5; i++) {
        double off = difference(at_line(a, lines[i]), at_line(b, lines[i]));
        sum += off * off;
    }
    return sqrt(sum / 5);
}

double glass_transmittance(const struct glass *glass, double wavelength, double thickness)
{
    const struct glass_point *points = glass->transmittance;
    for (size_t i = 0; i < glass->transmittance_count; i++) {
        double right = points[i].wavelength.high;
        if (fabs(wavelength - right) <= 1e-12 * right) {
            return pow(points[i].value.high, thickness / 10);
        }
        if (wavelength < right) {
            if (i == 0) {
                return NAN;
            }
            double left = points[i - 1].wavelength.high;
            double part = (wavelength - left) / (right - left);
            double tau =
                points[i - 1].value.high + part * (points[i].value.high - points[i - 1].value.high);
            return pow(tau, thickness / 10);
        }
    }
    return NAN;
}
