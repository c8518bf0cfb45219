/* tests/unit/test_merit_chief.c - operands of real chief and edge rays, by everything. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/chromatic.h"
#include "analysis/rays/distortion.h"
#include "double_gauss.h"
#include "merit_check.h"
#include "trace/dispatch.h"

static const char double_gauss[] = "wavelength d F C\n"
                                   "object inf\n"
                                   "aperture stop\n"
                                   "field angle 0 10 14\n"
                                   "focus table\n" DOUBLE_GAUSS("34.2");

static const char relay[] = "wavelength d F C\n"
                            "object 120\n"
                            "aperture na 0.08\n"
                            "field height 0 8\n"
                            "focus paraxial\n"
                            "surface 60 6 1.6/50 30 k=-0.5 A2=1e-4 A4=2e-6\n"
                            "surface -80 20 air 30 k=0.7 A3=1e-5\n"
                            "stop - 15 air 12 decenter=0.1,0.2 tilt=1,2\n"
                            "surface 90 5 1.65 30 decenter=0.1,0.3 tilt=1,-2\n"
                            "surface -50 100 1.33 30 A4=-1e-6\n";

static const char wet[] = "wavelength d F\n"
                          "object inf\n"
                          "medium 1.33\n"
                          "aperture f/4\n"
                          "field image 4\n"
                          "focus paraxial\n"
                          "surface 40 6 1.7/50 30\n"
                          "surface 300 10 air 30\n"
                          "surface -50 3 1.65/40 30 stop\n"
                          "surface 60 10 air 30\n"
                          "surface 70 7 1.7 30\n"
                          "surface -45 80 air 30\n";

static const char mangin[] = "wavelength d\n"
                             "object inf\n"
                             "aperture epd 30\n"
                             "field angle 2\n"
                             "focus paraxial\n"
                             "stop - 10 air 40\n"
                             "surface -150 8 1.52/64 60\n"
                             "surface -200 -8 mirror 60\n"
                             "surface -150 -60 air 60\n"
                             "bend tilt=2,0\n"
                             "surface 300 -4 1.6/40 40\n"
                             "surface 200 -60 air 40\n";

static const char near_image[] = "wavelength d\n"
                                 "object 200\n"
                                 "aperture f/8\n"
                                 "field image 5\n"
                                 "focus paraxial\n"
                                 "surface 60 6 1.6/50 30\n"
                                 "surface -80 5 air 30\n"
                                 "stop - 15 air 12\n"
                                 "surface 90 5 1.65 30\n"
                                 "surface -50 100 air 30\n";

static const char telecentric[] = "wavelength d F\n"
                                  "object 80 telecentric\n"
                                  "aperture na 0.05\n"
                                  "field height 0 5\n"
                                  "focus paraxial\n"
                                  "surface 60 6 1.62/45 40\n"
                                  "surface -80 40 air 40\n"
                                  "surface 50 5 1.65 30\n"
                                  "surface -70 100 air 30\n";

static const struct merit_case cases[] = {
    {"telecentric", telecentric, "R1 c2 t1 t2 n1 V1 n3 k3 A4_4",
     "height@4mm=-5,distortion,lateral,telecentric,incidence=3", 1e-9},
    {"double Gauss", double_gauss,
     "R1 R2 c3 R5 c6 t1 t5 t6 t11 n1 n3 V3 V4 A2_2 A4_1 k7 A4_6 A3_9 k1",
     "height@10deg=17,height@14deg@F=25,distortion,distortion@10deg@C=1,lateral:0.01,"
     "lateral@F@5deg=0.01,telecentric,telecentric@F@3deg=1,incidence=30,incidence 3@14deg@C=5",
     1e-9},
    {"relay", relay,
     "R1 c2 t1 t2 t3 n1 V1 n4 n5 k1 k2 A2_1 A4_1 A4_5 A3_2 R5 t5 decenter_y4 decenter_x4 tilt_x4 "
     "decenter_y3 decenter_x3 tilt_y4",
     "height@4mm=-5,distortion,lateral,telecentric,height@3deg=5,distortion@3deg@F=5", 1e-9},
    {"wet", wet, "R1 R2 c3 R5 t1 t2 t3 n1 n3 V3 k1 A4_2",
     "height@10deg=17,distortion,lateral,telecentric,incidence=10", 1e-9},
    {"Mangin", mangin, "R2 R3 c4 t1 t2 t5 n2 V2 n6 k3 bend_tilt_x5 bend_decenter_y5 tilt_x3",
     "height@2deg=5,distortion,telecentric,incidence 2..4=3", 1e-9},
    {"near image", near_image, "R1 R2 c4 t1 t2 t3 n1 n4 k1",
     "height@4mm=5,telecentric,distortion,incidence=3", 1e-9},
};

static bool open_setup(const struct lens *lens, struct arena *arena, struct setup *setup)
{
    struct error error;
    const struct plane_value plane = {.kind = PLANE_OF_LENS};
    const struct setup_question question = {.lens = lens,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_ALL,
                                            .fnumber = NAN,
                                            .field_policy = FIELDS_ALL,
                                            .takes_telecentric = true};
    return setup_open(&question, arena, setup, &error) && setup_place_image(setup, &plane, &error);
}

/* As lenscalc distortion has it. */
static struct distortion_point distorted(const struct setup *setup, const struct field_point *field,
                                         double wavelength)
{
    const struct setup one = setup_at_wavelength(setup, wavelength, setup->arena);
    struct distortion_map map;
    struct distortion_point point = {.percent = NAN};
    struct error error;
    CHECK(distortion_open(&one, 0, RECTILINEAR, setup->arena, &map, &error));
    CHECK(distortion_at(&map, field, &point, &error));
    return point;
}

/* As lenscalc color has it. */
static double lateral_of(const struct setup *setup, const struct field_point *field,
                         const struct operand *operand)
{
    const double primary = lens_primary_wavelength(setup->lens);
    const double other = isnan(operand->wavelength) ? 0.4861327 : operand->wavelength;
    const double from =
        isnan(operand->wavelength) && setup->wavelength_count == 3 ? 0.6562725 : primary;
    struct chromatic_chief chief[2];
    struct error error;
    CHECK(chromatic_chief(setup, field, from, &chief[0], &error));
    CHECK(chromatic_chief(setup, field, other, &chief[1], &error));
    return chromatic_lateral(&chief[0], &chief[1], (double[2]){0, 1}).height;
}

/* The largest angle of incidence, by the normals of the surface. */
static double incidence_of(const struct setup *setup, const struct operand *operand, size_t surface)
{
    static const double pupils[3][2] = {{0, 0}, {0, 1}, {0, -1}};
    const double wavelength =
        isnan(operand->wavelength) ? lens_primary_wavelength(setup->lens) : operand->wavelength;
    const struct setup one = setup_at_wavelength(setup, wavelength, setup->arena);
    struct error error;
    const struct system *system = setup_system(&one, 0, SETUP_OPEN, &error);
    double largest = 0;
    CHECK(system != NULL);
    for (size_t i = 0; i < (operand->field != NULL ? 1 : setup->field_count) * 3; i++) {
        const struct field_point *field =
            operand->field != NULL ? &operand->field->point : &setup->fields[i / 3].point;
        struct beam beam;
        struct aim aim;
        CHECK(setup_beam(&one, field, &beam, &error));
        struct ray start;
        if (one.first.is_telecentric) {
            CHECK(aim_at_entrance(&beam, &one.first, pupils[i % 3][0], pupils[i % 3][1], &start,
                                  &error));
        } else {
            CHECK(aim_open(system, &beam, setup->arena, &aim, &error));
            start = aim_ray(&aim, pupils[i % 3][0], pupils[i % 3][1]);
        }
        struct rays rays = rays_new(setup->arena, 2);
        rays_set(&rays, 0, system->index_first, &start);
        rays_set(&rays, 1, system->index_first, &start);
        const size_t place = system_place(system, surface);
        rays_trace_part(system, 0, place + 1, &rays, NULL);
        const struct ray after = rays_get(&rays, 0, system_index_after(system, place));
        struct rays less = rays_new(setup->arena, 1);
        rays_set(&less, 0, system->index_first, &start);
        if (place > 0) {
            rays_trace_part(system, 0, place, &less, NULL);
        }
        const struct ray before = rays_get(
            &less, 0, place > 0 ? system_index_after(system, place - 1) : system->index_first);
        double normal[3];
        system_normal(system, surface, after.point, normal);
        largest = fmax(largest, ray_angles(normal, before.cosine, after.cosine).incidence);
    }
    return largest;
}

/* Air stands on both sides of a stop. */
static bool bends(const struct lens *lens, size_t surface)
{
    return surface != lens->stop || !medium_is_air(&lens->surfaces[surface].medium) ||
           (surface > 0 && !medium_is_air(&lens->surfaces[surface - 1].medium));
}

static double analyse(const struct lens *lens, const struct operand *operand, size_t at,
                      struct arena *arena)
{
    struct setup setup;
    CHECK(open_setup(lens, arena, &setup));
    const struct field_point *field = operand->field != NULL ? &operand->field->point : &setup.edge;
    const double wavelength =
        isnan(operand->wavelength) ? lens_primary_wavelength(lens) : operand->wavelength;
    struct chromatic_chief chief;
    struct error error;
    size_t surface = operand->first == LENS_NONE ? 0 : operand->first;
    switch (operand->kind) {
    case OPERAND_HEIGHT:
        return distorted(&setup, field, wavelength).height;
    case OPERAND_DISTORTION:
        return distorted(&setup, field, wavelength).percent;
    case OPERAND_LATERAL:
        return lateral_of(&setup, field, operand);
    case OPERAND_TELECENTRIC:
        CHECK(chromatic_chief(&setup, field, wavelength, &chief, &error));
        return atan(chief.slope[1]);
    default:
        for (size_t found = 0; !bends(lens, surface) || found++ < at;) {
            surface++;
        }
        return incidence_of(&setup, operand, surface);
    }
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        merit_check(&cases[i], analyse);
    }
    merit_check_random("height@2deg=1,distortion@F,lateral,telecentric@C", true, analyse);
    return check_report();
}
