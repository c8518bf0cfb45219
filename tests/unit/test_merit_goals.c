/* tests/unit/test_merit_goals.c - track, focus, power of a group: as paraxial rays have them. */
/* SPDX-License-Identifier: MIT */
#include "merit_check.h"

/* Cooke triplet, after its thin-lens layout: 27.4, -14.7 and 24.1 mm. */
#define TRIPLET(object, focus)                                                                     \
    "wavelength d F C\n" object "field " focus "surface 33.9 3.2 1.6204/60.28 14\n"                \
    "surface -33.9 4.5 air 14\n"                                                                   \
    "surface -18.2 1 1.62/36.37 10\n"                                                              \
    "surface 18.2 4.5 air 10 stop A4=1e-5\n"                                                       \
    "surface 29.9 3 1.6204/60.28 12 A2=1e-4\n"                                                     \
    "surface -29.9 42 air 12\n"

static const char far_paraxial[] =
    TRIPLET("object inf\naperture f/5\n", "angle 0 14\nfocus paraxial\n");
static const char far_table[] = TRIPLET("object inf\naperture f/5\n", "angle 0 14\nfocus table\n");
static const char near_paraxial[] =
    TRIPLET("object 300\naperture na 0.02\n", "height 0 20\nfocus paraxial\n");
static const char near_table[] =
    TRIPLET("object 300\naperture na 0.02\n", "height 0 20\nfocus table\n");

static const char mirrors[] = "wavelength d F\n"
                              "object inf\n"
                              "aperture f/4\n"
                              "field angle 0 1\n"
                              "focus table\n"
                              "surface -400 -120 mirror 100 k=-1 stop\n"
                              "surface -220 140 mirror 50 k=-3\n"
                              "surface 90 8 1.52/64 40\n"
                              "surface -300 60 air 40\n";

#define NUMBERS "R1 c2 t1 t2 R3 n1 V1 n3 V5 t6 A2_5 c6"

static const struct merit_case cases[] = {
    {"far", far_paraxial, NUMBERS,
     "track=60,focus@F,focus@C:0.1,focus=1,power=20,power 1..2=30,power 3..4@F=-70:2,power 4=-20",
     1e-9},
    {"far, table", far_table, NUMBERS, "track=60,focus@F,focus,power 1..4=30", 1e-9},
    {"near", near_paraxial, NUMBERS, "track=60,focus@F,focus@650nm,power 2..5=30", 1e-9},
    {"near, table", near_table, NUMBERS, "track=60,focus@F,focus,power=20", 1e-9},
    {"mirrors", mirrors, "R1 R2 t1 t2 c3 t4 n3 V3", "track=50,focus,power=2,power 2=-9,power 1=5",
     1e-9},
};

/* A ray and the surfaces that it passes, y and n u: y' = y + t u, n' u' = n u - y (n' - n) c. */
struct paraxial_walk {
    double y, v, n;
};

static void paraxial_walk_through(struct paraxial_walk *ray, const struct lens *lens, size_t first,
                                  size_t end, double wavelength)
{
    for (size_t i = 0; i < end; i++) {
        const struct surface *surface = &lens->surfaces[i];
        struct pair index;
        struct error error;
        CHECK(medium_index(&surface->medium, wavelength, &index, &error));
        double after = ray->n < 0 ? -index.hi : index.hi;
        after = surface_reflects(surface) ? -ray->n : after;
        if (i >= first) {
            ray->v -= ray->y * (after - ray->n) * surface_curvature(surface, SECTION_Y).hi;
            ray->y += i + 1 < end ? ray->v / after * surface->thickness.value.hi : 0;
        }
        ray->n = after;
    }
}

/* Behind the last vertex. */
static double paraxial_image_of(const struct lens *lens, double wavelength)
{
    struct paraxial_walk ray = {1, 0, 1};
    if (!lens->object_is_infinite) {
        ray.v = ray.y / lens->object.value.hi;
    }
    paraxial_walk_through(&ray, lens, 0, lens->surface_count, wavelength);
    return -ray.n * ray.y / ray.v;
}

static double figure_of_paraxial(const struct lens *lens, const struct operand *operand, size_t at,
                                 struct arena *arena)
{
    const double primary = lens_primary_wavelength(lens);
    const double wavelength = isnan(operand->wavelength) ? primary : operand->wavelength;
    const size_t count = lens->surface_count;
    const double plane = lens->focus == FOCUS_TABLE ? lens->surfaces[count - 1].thickness.value.hi
                                                    : paraxial_image_of(lens, primary);
    (void)at;
    (void)arena;
    if (operand->kind == OPERAND_FOCUS) {
        return paraxial_image_of(lens, wavelength) - plane;
    }
    if (operand->kind == OPERAND_TRACK) {
        double sum = plane;
        for (size_t i = 0; i + 1 < count; i++) {
            sum += lens->surfaces[i].thickness.value.hi;
        }
        return sum;
    }
    const bool all = operand->first == LENS_NONE;
    struct paraxial_walk ray = {1, 0, 1};
    paraxial_walk_through(&ray, lens, all ? 0 : operand->first, all ? count : operand->last + 1,
                          wavelength);
    return -ray.v;
}

/* A thin lens by hand: two powers P and Q at a distance d make P + Q - d P Q; in dpt. */
static void test_two_lenses(void)
{
    static const char text[] = "wavelength d\n"
                               "object inf\n"
                               "focus table\n"
                               "thick 100 20 air 20\n"
                               "thick 50 30 air 20\n";
    const struct merit_case of = {"two thin lenses", text, "f1 f2 t1",
                                  "power=0,power 1=0,power 2=20,track=0,focus=0", 0};
    /* 10 + 20 - 0.02 10 20 = 26 /m: bfl = (1 - 0.02 10)/26 m */
    static const double values[] = {0.026, 0.01, 0.02, 50, 800 / 26. - 30};
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double residuals[5];
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    CHECK(merit_evaluate(&bench->merit, bench->v, residuals, NULL));
    for (size_t i = 0; i < 5; i++) {
        CHECK_NEAR(bench->merit.values[i], values[i], 1e-13, bench->merit.slots[i].operand->name);
    }
    CHECK_NEAR(residuals[2], 0, 1e-13, "20 dpt");
    arena_free(&arena);
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        merit_check(&cases[i], figure_of_paraxial);
    }
    test_two_lenses();
    return check_report();
}
