/* tests/unit/test_merit_made.c - sag, slope, ratio, aspect, weight, cost: against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "merit_check.h"

/* All clear apertures are stated, and none is the same as its neighbour's. */
static const char stated[] = "wavelength d\n"
                             "object inf\n"
                             "aperture epd 10\n"
                             "surface 60 6 N-BK7 30\n"
                             "surface -80 3 N-SF5 28 k=-0.5\n"
                             "surface 200 8 air 24\n"
                             "stop - 5 air 10\n"
                             "surface -40 5 N-SK2 26 k=2 A4=-1e-6\n"
                             "surface -50 100 air 32 A2=1e-3 A3=2e-5 A6=3e-9\n"
                             "surface -300 -50 mirror 32\n"
                             "surface - -4 N-BK7 20\n"
                             "surface 70 -40 air 22\n";

/* None is, but light comes in parallel to the axis: as far out as its ray. The second surface is
   steepest at half its height. */
static const char bare[] = "wavelength d\n"
                           "object inf\n"
                           "aperture epd 20\n"
                           "surface -200 6 N-BK7 - stop\n"
                           "surface -80 100 air - A4=2.1e-5\n";

static const struct merit_case cases[] = {
    {"stated", stated, "R1 c2 R3 R5 c6 c8 R9 t1 t2 t5 t8 k1 k2 k5 A4_1 A2_6 A3_6 A6_6 A4_5",
     "sag=0.1,sag 2=1:0.1,slope 1..7=3deg,slope 9=0,ratio 1..2=5,ratio 3=12,ratio 5..6=4:0.1,"
     "ratio 7=20,ratio 9=5,aspect 1=5,aspect 2=8,aspect 5..6=6,aspect 8=5,weight=10,weight 2..5=5",
     1e-7},
    {"bare", bare, "R1 t1 R2 A4_2 k2", "sag=0.1,slope 2=2deg,ratio 2=6,aspect=3,weight=10", 1e-7},
};

/* g/cm^3, of the maker's data sheets. */
static double density_of(const struct surface *surface)
{
    const struct text name = surface->medium.written;
    return text_equal(name, "N-BK7") ? 2.51 : text_equal(name, "N-SF5") ? 2.858 : 3.55;
}

/* The bare lens: the ray of the edge by Snell's law; the plane at its front meets it at 10 mm. */
static double semi_of(const struct lens *lens, size_t surface)
{
    const struct surface *at = &lens->surfaces[surface];
    if (at->has_diameter) {
        return at->diameter.value.hi / 2;
    }
    const struct surface *front = &lens->surfaces[0];
    const double c = surface_base_curvature(front).hi, n = 1.5168000345; /* at d */
    const double angle = asin(10 * c), bend = angle - asin(10 * c / n);
    double z = surface_sag(front, 10), r = 10;
    for (int i = 0; i < 100 && surface == 1; i++) { /* Newton's steps, with a slope of 0 */
        r = 10 - (front->thickness.value.hi + surface_sag(at, r) - z) * tan(bend);
    }
    return r;
}

/* dz/dr by the definition of the curve. */
static double slope_at(const struct surface *surface, double r)
{
    const double c = surface_base_curvature(surface).hi, K = 1 + surface->conic.value.hi;
    double slope = c * r / sqrt(1 - K * c * c * r * r);
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        const int n = surface_order(i);
        slope += n * surface->coefficient[i].value.hi * pow(r, n - 1);
    }
    return fabs(slope);
}

/* The largest: of these lenses at the rim, or where the second derivative is 0, by thirds. */
static double steepest_of(const struct surface *surface, double a)
{
    double low = 0, high = a;
    for (int i = 0; i < 200; i++) {
        const double left = low + (high - low) / 3, right = high - (high - low) / 3;
        if (slope_at(surface, left) < slope_at(surface, right)) {
            low = left;
        } else {
            high = right;
        }
    }
    return fmax(slope_at(surface, a), slope_at(surface, (low + high) / 2));
}

/*
 * Between a surface and the plane at its vertex, out to b: of a sphere h = z(a), and within the
 * cap is pi h^2 (R - h/3), outside of it pi a^2 h less that; of a conic with K = 1 + k and
 * s^2 = 1 - K c^2 a^2 it is pi (a^2 - 2 (1 - s^3)/(3 K c^2))/(K c) there, of A r^n
 * 2 pi A a^(n+2)/(n+2).
 */
static double cap_of(const struct surface *surface, double a, double b)
{
    const double c = surface_base_curvature(surface).hi, K = 1 + surface->conic.value.hi;
    double sum = PI * (b * b - a * a) * surface_sag(surface, a);
    if (c != 0 && K == 1) {
        const double R = 1 / c, h = R - copysign(sqrt(R * R - a * a), R);
        sum += PI * a * a * h - PI * h * h * (R - h / 3);
    } else if (c != 0) {
        const double s = sqrt(1 - K * c * c * a * a);
        sum += PI * (a * a - 2 * (1 - s * s * s) / (3 * K * c * c)) / (K * c);
    }
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        const int n = surface_order(i);
        sum += 2 * PI * surface->coefficient[i].value.hi * pow(a, n + 2) / (n + 2);
    }
    return sum;
}

static bool is_glass(const struct lens *lens, size_t i)
{
    return lens->surfaces[i].kind == SURFACE_REFRACT && !medium_is_air(&lens->surfaces[i].medium);
}

static double figure_made(const struct lens *lens, const struct operand *operand, size_t at,
                          struct arena *arena)
{
    const enum operand_kind kind = operand->kind;
    const size_t first = operand->first == LENS_NONE ? 0 : operand->first;
    const size_t last = operand->first == LENS_NONE ? lens->surface_count - 1 : operand->last;
    double sum = 0;
    size_t found = 0;
    (void)arena;
    for (size_t i = first; i <= last; i++) {
        const struct surface *surface = &lens->surfaces[i], *next = surface + 1;
        const double a = semi_of(lens, i), c = surface_base_curvature(surface).hi;
        if (kind >= OPERAND_SAG && kind <= OPERAND_RATIO && surface->kind != SURFACE_STOP &&
            found++ == at) {
            return kind == OPERAND_SAG     ? surface_sag(surface, a)
                   : kind == OPERAND_SLOPE ? atan(steepest_of(surface, a))
                                           : 1 / fabs(c * a);
        }
        if (kind <= OPERAND_RATIO || !is_glass(lens, i)) {
            continue;
        }
        const double t = fabs(surface->thickness.value.hi), b = fmax(a, semi_of(lens, i + 1));
        if (kind == OPERAND_ASPECT && found++ == at) {
            return 2 * b / t;
        }
        const double sign = surface->thickness.value.hi < 0 ? -1 : 1;
        const double volume =
            PI * b * b * t + sign * (cap_of(next, semi_of(lens, i + 1), b) - cap_of(surface, a, b));
        sum += volume / 1000 * density_of(surface);
    }
    return sum;
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        merit_check(&cases[i], figure_made);
    }
    return check_report();
}
