/* optics/glass.c - refractive index of optical materials by wavelength. */
/* SPDX-License-Identifier: MIT */
#include "optics/glass.h"

#include "optics/wavelength.h"

#include <math.h>

/* What a formula gives: n or n^2, and its derivative. */
struct glass_figure {
    struct pair y;
    double dy; /* by l, 1/um */
};

/* The square of the wavelength is what nearly all formulas want. */
struct light {
    struct pair l, square; /* um, um^2 */
};

static struct pair glass_inverse(struct pair a)
{
    return pair_divide(pair_of(1), a);
}

static struct glass_figure glass_constant_index(const struct glass *glass,
                                                const struct light *light)
{
    (void)light;
    return (struct glass_figure){glass->coefficients[0], 0};
}

static struct pair glass_inverse_square(double wavelength)
{
    return glass_inverse(pair_product(wavelength, wavelength));
}

static struct glass_figure nd_vd(const struct glass *glass, const struct light *light)
{
    const struct pair *c = glass->coefficients;
    struct pair one = pair_of(1), d = glass_inverse_square(WAVELENGTH_D);
    struct pair span =
        pair_subtract(glass_inverse_square(WAVELENGTH_F), glass_inverse_square(WAVELENGTH_C));
    struct pair B = pair_divide(pair_subtract(c[0], one), pair_multiply(c[1], span));
    struct pair from_d = pair_subtract(glass_inverse(light->square), d);
    double l = light->l.hi;
    return (struct glass_figure){pair_add(c[0], pair_multiply(B, from_d)), -2 * B.hi / (l * l * l)};
}

/* Add B l^2/(l^2 - C). */
static void glass_add_resonance(struct glass_figure *value, const struct light *light,
                                struct pair B, struct pair C)
{
    struct pair gap = pair_subtract(light->square, C);
    value->y = pair_add(value->y, pair_divide(pair_multiply(B, light->square), gap));
    value->dy -= 2 * B.hi * C.hi * light->l.hi / (gap.hi * gap.hi);
}

static struct glass_figure glass_sellmeier(const struct glass *glass, const struct light *light)
{
    struct glass_figure value = {{1, 0}, 0};
    for (size_t i = 0; i + 1 < glass->count; i += 2) {
        glass_add_resonance(&value, light, glass->coefficients[i], glass->coefficients[i + 1]);
    }
    return value;
}

static struct glass_figure sellmeier_sq(const struct glass *glass, const struct light *light)
{
    const struct pair *c = glass->coefficients;
    struct glass_figure value = {pair_add(pair_of(1), c[0]), 0};
    for (size_t i = 1; i + 1 < glass->count; i += 2) {
        glass_add_resonance(&value, light, c[i], pair_multiply(c[i + 1], c[i + 1]));
    }
    return value;
}

/* Add c l^p for an even p. */
static void glass_add_power(struct glass_figure *value, const struct light *light, struct pair c,
                            int p)
{
    struct pair power = pair_of(1);
    for (int i = 0; i < (p < 0 ? -p : p); i += 2) {
        power = pair_multiply(power, light->square);
    }
    struct pair term = p < 0 ? pair_divide(c, power) : pair_multiply(c, power);
    value->y = pair_add(value->y, term);
    value->dy += p * term.hi / light->l.hi;
}

static struct glass_figure glass_schott(const struct glass *glass, const struct light *light)
{
    static const int powers[] = {0, 2, -2, -4, -6, -8};
    const struct pair *c = glass->coefficients;
    struct pair x = glass_inverse(light->square);
    /* the negative powers by Horner's rule */
    struct pair sum = pair_multiply(c[5], x);
    double slope = powers[5] * c[5].hi;
    for (size_t i = 4; i >= 2; i--) {
        sum = pair_multiply(pair_add(sum, c[i]), x);
        slope = slope * x.hi + powers[i] * c[i].hi;
    }
    sum = pair_add(sum, pair_multiply(c[1], light->square));
    double l = light->l.hi;
    return (struct glass_figure){pair_add(c[0], sum), slope * x.hi / l + 2 * c[1].hi * l};
}

static struct glass_figure power(const struct glass *glass, const struct light *light)
{
    struct glass_figure value = {glass->coefficients[0], 0};
    for (size_t i = 1; i + 1 < glass->count; i += 2) {
        glass_add_power(&value, light, glass->coefficients[i], (int)glass->coefficients[i + 1].hi);
    }
    return value;
}

static struct glass_figure glass_conrady(const struct glass *glass, const struct light *light)
{
    const struct pair *c = glass->coefficients;
    struct pair cube = pair_multiply(light->l, light->square);
    struct pair a = pair_divide(c[1], light->l);
    struct pair b = pair_divide(c[2], pair_multiply(cube, pair_root(light->l)));
    return (struct glass_figure){pair_add(c[0], pair_add(a, b)),
                                 -(a.hi + 3.5 * b.hi) / light->l.hi};
}

static struct glass_figure herzberger(const struct glass *glass, const struct light *light)
{
    const struct pair *c = glass->coefficients;
    const struct pair pole = pair_divide(pair_of(28), pair_of(1000));
    struct pair z = glass_inverse(pair_subtract(light->square, pole));
    struct pair sum = pair_multiply(pair_add(pair_multiply(c[2], z), c[1]), z);
    double dz = -2 * light->l.hi * z.hi * z.hi;
    struct glass_figure value = {pair_add(c[0], sum), (c[1].hi + 2 * c[2].hi * z.hi) * dz};
    for (int i = 3; i < 6; i++) {
        glass_add_power(&value, light, c[i], 2 * (i - 2));
    }
    return value;
}

static struct glass_figure resonances(const struct glass *glass, const struct light *light)
{
    const struct pair *c = glass->coefficients;
    const double l = light->l.hi;
    struct glass_figure value = {pair_add(c[0], pair_multiply(c[1], light->square)),
                                 2 * c[1].hi * l};
    for (size_t i = 2; i + 2 < glass->count; i += 3) {
        struct pair gap = pair_subtract(light->square, c[i + 2]);
        struct pair top = pair_add(pair_multiply(c[i], light->square), c[i + 1]);
        value.y = pair_add(value.y, pair_divide(top, gap));
        value.dy += 2 * l * (c[i].hi * gap.hi - top.hi) / (gap.hi * gap.hi);
    }
    return value;
}

/* A polynomial by Horner's rule, and its derivative. */
static struct glass_figure glass_polynomial(const struct pair *c, size_t count, struct pair x)
{
    struct glass_figure value = {c[count - 1], 0};
    for (size_t i = count - 1; i-- > 0;) {
        value.dy = value.dy * x.hi + value.y.hi;
        value.y = pair_add(pair_multiply(value.y, x), c[i]);
    }
    return value;
}

static struct glass_figure glass_cauchy(const struct glass *glass, const struct light *light)
{
    struct pair x = pair_divide(pair_of(1), light->square);
    struct glass_figure value = glass_polynomial(glass->coefficients, glass->count, x);
    value.dy *= -2 * x.hi / light->l.hi;
    return value;
}

static struct glass_figure glass_buchdahl(const struct glass *glass, const struct light *light)
{
    const struct pair *c = glass->coefficients;
    struct pair step = pair_subtract(light->l, c[0]);
    struct pair bottom = pair_add(pair_of(1), pair_multiply(step, pair_of(2.5)));
    struct glass_figure value =
        glass_polynomial(c + 1, glass->count - 1, pair_divide(step, bottom));
    value.dy /= bottom.hi * bottom.hi;
    return value;
}

/* Lagrange's polynomial in x = 1/l^2, and its derivative by l. */
static struct glass_figure table(const struct glass *glass, const struct light *light)
{
    enum { POINTS = 4 };
    size_t count = glass->table_count < POINTS ? glass->table_count : POINTS;
    /* two entries on each side of the wavelength, if there are so many */
    size_t above = 0;
    while (above < glass->table_count && glass->table[above].wavelength.hi < light->l.hi) {
        above++;
    }
    size_t first = above > count / 2 ? above - count / 2 : 0;
    const struct glass_point *at =
        glass->table + (first + count > glass->table_count ? glass->table_count - count : first);
    struct pair x = glass_inverse(light->square), nodes[POINTS];
    struct glass_figure value = {{0, 0}, 0};
    for (size_t i = 0; i < count; i++) {
        nodes[i] = glass_inverse(pair_multiply(at[i].wavelength, at[i].wavelength));
    }
    for (size_t i = 0; i < count; i++) {
        struct pair weight = at[i].value;
        double slope = 0; /* of the product without at[i].value / scale */
        double product = 1, scale = 1;
        for (size_t j = 0; j < count; j++) {
            if (j != i) {
                struct pair step = pair_subtract(nodes[i], nodes[j]);
                struct pair gap = pair_subtract(x, nodes[j]);
                weight = pair_divide(pair_multiply(weight, gap), step);
                slope = slope * gap.hi + product;
                product *= gap.hi;
                scale *= step.hi;
            }
        }
        value.y = pair_add(value.y, weight);
        value.dy += slope * at[i].value.hi / scale;
    }
    value.dy *= -2 * x.hi / light->l.hi;
    return value;
}

/* In the order of enum glass_formula. */
static const struct {
    const char *name;
    size_t least, most, step; /* numbers of coefficients */
    bool is_square;           /* gives n^2 */
    struct glass_figure (*compute)(const struct glass *glass, const struct light *light);
} formulas[] = {
    {"constant", 1, 1, 1, false, glass_constant_index},
    {"nd_vd", 2, 2, 1, false, nd_vd},
    {"sellmeier", 2, 16, 2, true, glass_sellmeier},
    {"sellmeier_sq", 3, 15, 2, true, sellmeier_sq},
    {"schott", 6, 6, 1, true, glass_schott},
    {"power", 1, 17, 2, true, power},
    {"conrady", 3, 3, 1, false, glass_conrady},
    {"herzberger", 6, 6, 1, false, herzberger},
    {"resonances", 5, 17, 3, true, resonances},
    {"table", 0, 0, 1, false, table},
    {"cauchy", 1, 6, 1, false, glass_cauchy},
    {"buchdahl", 3, 8, 1, false, glass_buchdahl},
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

struct glass glass_constant(struct pair n)
{
    return (struct glass){.formula = GLASS_CONSTANT,
                          .count = 1,
                          .coefficients = {n},
                          .shortest = NAN,
                          .longest = NAN,
                          .thermal = unknown_thermal};
}

struct glass glass_nd_vd(struct pair nd, struct pair Vd)
{
    return (struct glass){.formula = GLASS_ND_VD,
                          .count = 2,
                          .coefficients = {nd, Vd},
                          .shortest = NAN,
                          .longest = NAN,
                          .thermal = unknown_thermal};
}

struct glass_index glass_index(const struct glass *glass, struct pair wavelength)
{
    const struct light light = {wavelength, pair_multiply(wavelength, wavelength)};
    struct glass_figure value = formulas[glass->formula].compute(glass, &light);
    if (!formulas[glass->formula].is_square) {
        return (struct glass_index){value.y, value.dy};
    }
    struct pair n = pair_root(value.y);
    return (struct glass_index){n, value.dy / (2 * n.hi)};
}

double glass_n(const struct glass *glass, double wavelength)
{
    return glass_index(glass, pair_of(wavelength)).n.hi;
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
    return glass_n(glass, wavelength) > 0 ||
           fail(error, ERROR_DOMAIN, "the formula of %.*s:%.*s gives no index at %.10g nm",
                (int)glass->catalog.length, glass->catalog.start, (int)glass->name.length,
                glass->name.start, 1000 * wavelength);
}

/* The index at a line with its low part, NaN where the range does not reach. */
static struct pair at_line(const struct glass *glass, double l)
{
    return reaches(glass, l) ? glass_index(glass, pair_of(l)).n : pair_of(NAN);
}

static double difference(struct pair a, struct pair b)
{
    return (a.hi - b.hi) + (a.lo - b.lo);
}

/* nF - nC; NaN for a constant, which has no Vd. */
static double spread_of(struct pair F, struct pair C)
{
    double spread = difference(F, C);
    return fabs(spread) <= 0 ? (double)NAN : spread;
}

struct glass_abbe glass_abbe(const struct glass *glass)
{
    struct pair d = at_line(glass, WAVELENGTH_D);
    double spread = spread_of(at_line(glass, WAVELENGTH_F), at_line(glass, WAVELENGTH_C));
    return (struct glass_abbe){d.hi, difference(d, pair_of(1)) / spread};
}

struct glass_lines glass_lines(const struct glass *glass)
{
    return (struct glass_lines){.g = at_line(glass, WAVELENGTH_G),
                                .F = at_line(glass, WAVELENGTH_F),
                                .e = at_line(glass, WAVELENGTH_E),
                                .d = at_line(glass, WAVELENGTH_D),
                                .C = at_line(glass, WAVELENGTH_C)};
}

struct glass_summary glass_summary_of(const struct glass *glass, const struct glass_lines *lines)
{
    struct pair g = lines->g, F = lines->F, e = lines->e, d = lines->d, C = lines->C;
    double spread = spread_of(F, C);
    double other_spread =
        spread_of(at_line(glass, WAVELENGTH_F_PRIME), at_line(glass, WAVELENGTH_C_PRIME));
    struct glass_summary summary = {.nd = d.hi, .ne = e.hi};
    summary.Vd = difference(d, pair_of(1)) / spread;
    summary.Ve = difference(e, pair_of(1)) / other_spread;
    summary.PgF = difference(g, F) / spread;
    summary.PdC = difference(d, C) / spread;
    summary.deviation = summary.PgF - (0.6438 - 0.001682 * summary.Vd);
    return summary;
}

struct glass_summary glass_summary(const struct glass *glass)
{
    const struct glass_lines lines = glass_lines(glass);
    return glass_summary_of(glass, &lines);
}

double glass_difference(const struct glass_lines *a, const struct glass_lines *b)
{
    const double off[] = {difference(a->g, b->g), difference(a->F, b->F), difference(a->e, b->e),
                          difference(a->d, b->d), difference(a->C, b->C)};
    double sum = 0;
    for (size_t i = 0; i < 5; i++) {
        sum += off[i] * off[i];
    }
    return sqrt(sum / 5);
}

double glass_transmittance(const struct glass *glass, double wavelength, double thickness)
{
    const struct glass_point *points = glass->transmittance;
    for (size_t i = 0; i < glass->transmittance_count; i++) {
        double right = points[i].wavelength.hi;
        if (fabs(wavelength - right) <= 1e-12 * right) {
            return pow(points[i].value.hi, thickness / 10);
        }
        if (wavelength < right) {
            if (i == 0) {
                return NAN;
            }
            double left = points[i - 1].wavelength.hi;
            double part = (wavelength - left) / (right - left);
            double tau =
                points[i - 1].value.hi + part * (points[i].value.hi - points[i - 1].value.hi);
            return pow(tau, thickness / 10);
        }
    }
    return NAN;
}
