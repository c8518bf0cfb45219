/* tests/unit/test_material.c - materials in bands: colours, textures, light of things. */
/* SPDX-License-Identifier: MIT */
#include "scene/material.h"

#include "check.h"

static const struct lanes all = {3, {0, 1, 2}};
static const double middle[2] = {0.5, 0.5};

static float grey_pixels[] = {0, 0.25f, 0.5f, 1};
static const struct image grey = {.width = 2, .height = 2, .channels = 1, .pixels = grey_pixels};
static float red_pixels[] = {1, 0.5f, 0.25f, 0.5f};
static const struct image red = {.width = 1, .height = 1, .channels = 4, .pixels = red_pixels};

static struct scene_material written[] = {
    {.name = "plain",
     .kind = MATERIAL_LAMBERT,
     .colour = {.kind = SPECTRUM_RGB, .rgb = {0.75, 0.5, 0.25}}},
    {.name = "printed",
     .kind = MATERIAL_GLOSSY,
     .colour = {.kind = SPECTRUM_RGB, .rgb = {0.8, 0.4, 0}},
     .texture = &grey,
     .roughness = 0.1,
     .index = 1.5},
    {.name = "lamp",
     .kind = MATERIAL_BLACK,
     .emission = {.kind = SPECTRUM_RGB, .rgb = {1, 1, 1}},
     .luminance = 300},
    {.name = "coated",
     .kind = MATERIAL_GLOSSY,
     .colour = {.kind = SPECTRUM_RGB, .rgb = {0.1, 0.1, 0.1}},
     .roughness = 0.1,
     .index = 1.5,
     .emission = {.kind = SPECTRUM_RGB, .rgb = {1, 1, 1}}},
    {.name = "rough",
     .kind = MATERIAL_GLOSSY,
     .colour = {.kind = SPECTRUM_RGB, .rgb = {0.1, 0.1, 0.1}},
     .roughness = 0.2,
     .index = 1.5},
    {.name = "unused",
     .kind = MATERIAL_GLOSSY,
     .colour = {.kind = SPECTRUM_RGB, .rgb = {0.1, 0.1, 0.1}},
     .roughness = 0.1,
     .index = 1.5},
};
static struct scene_thing things[] = {
    {.shape = SHAPE_DISC, .material = 0},
    {.shape = SHAPE_DISC, .material = 1},
    {.shape = SHAPE_DISC, .material = 2},
    {.shape = SHAPE_DISC, .material = 3},
    {.shape = SHAPE_CARD, .picture = &red, .material = SCENE_NONE},
    {.shape = SHAPE_CARD, .picture = &red, .shines = true, .luminance = 40, .material = SCENE_NONE},
    {.shape = SHAPE_DISC, .material = 4},
};
static const struct scene scene = {.materials = written,
                                   .material_count = sizeof written / sizeof *written,
                                   .things = things,
                                   .thing_count = sizeof things / sizeof *things};

static void check_lanes(const struct radiance *found, double a, double b, double c)
{
    CHECK_NEAR(found->of[0], a, 1e-7, "first");
    CHECK_NEAR(found->of[1], b, 1e-7, "second");
    CHECK_NEAR(found->of[2], c, 1e-7, "third");
}

static void test_bsdf(const struct materials *materials)
{
    struct bsdf scatter = {0};
    CHECK(materials_bsdf(materials, 0, middle, &all, &scatter));
    CHECK(scatter.kind == MATERIAL_LAMBERT && scatter.lanes == 3);
    check_lanes(&scatter.colour, 0.75, 0.5, 0.25);
    /* the mean of four pixels in the middle; the lower left one near its corner */
    CHECK(materials_bsdf(materials, 1, middle, &all, &scatter));
    CHECK(scatter.kind == MATERIAL_GLOSSY && scatter.microfacets->index == 1.5);
    check_lanes(&scatter.colour, 0.35, 0.175, 0);
    CHECK_NEAR(scatter.ground, 0.35, 1e-7, "ground");
    CHECK(materials_bsdf(materials, 1, (const double[]){0, 0}, &all, &scatter));
    check_lanes(&scatter.colour, 0.4, 0.2, 0);
    CHECK(materials->of[1].microfacets == materials->of[3].microfacets);
    CHECK(materials->of[4].microfacets->alpha == 0.2 && materials->of[5].microfacets == NULL);
    CHECK(!materials_bsdf(materials, 2, middle, &all, &scatter));
    CHECK(materials_bsdf(materials, 4, middle, &all, &scatter));
    CHECK(scatter.kind == MATERIAL_LAMBERT);
    check_lanes(&scatter.colour, 1, 0.5, 0.25);
    CHECK(!materials_bsdf(materials, 5, middle, &all, &scatter));
}

static void test_shine(const struct materials *materials)
{
    static const bool shines[] = {false, false, true, false, false, true, false};
    struct radiance light;
    for (size_t i = 0; i < scene.thing_count; i++) {
        CHECK(materials_shines(materials, i) == shines[i]);
    }
    materials_shine(materials, 2, middle, &all, &light);
    check_lanes(&light, 300, 300, 300);
    materials_shine(materials, 5, middle, &all, &light);
    check_lanes(&light, 40, 20, 10);
    /* some lanes in another order */
    materials_shine(materials, 5, middle, &(const struct lanes){2, {2, 0}}, &light);
    CHECK(light.of[0] == 10 && light.of[1] == 40);
}

/* Alike spectra are one, whoever has them; those of lights and of surfaces are not alike. */
static void test_shared(const struct materials *materials, struct spectra *spectra)
{
    static const double wavelength[] = {0.3, 0.9}, value[] = {0.5, 0.5}, other[] = {0.5, 0.5};
    static const struct typed_place place = {"a.scene", 1, 1};
    const struct spectrum white = {.kind = SPECTRUM_RGB, .rgb = {1, 1, 1}};
    const struct spectrum table = {
        .kind = SPECTRUM_TABLE, .count = 2, .wavelength = wavelength, .value = value};
    const struct spectrum like = {
        .kind = SPECTRUM_TABLE, .count = 2, .wavelength = wavelength, .value = other};
    const struct spectrum warm = {.kind = SPECTRUM_BLACKBODY, .kelvin = 2856};
    const struct spectrum cool = {.kind = SPECTRUM_DAYLIGHT, .kelvin = 5600};
    const struct material *of = materials->of;
    struct error error;
    CHECK(of[3].colour == of[4].colour && of[3].colour == of[5].colour);
    CHECK(of[0].colour != of[1].colour && of[0].colour != of[3].colour && of[2].colour == NULL);
    CHECK(of[2].light == spectra_light(spectra, &white, &place, &error));
    CHECK(of[2].light != spectra_surface(spectra, &white, &place, &error));
    const struct banded *surface = spectra_surface(spectra, &table, &place, &error);
    CHECK(surface != NULL && surface == spectra_surface(spectra, &table, &place, &error));
    CHECK(surface != spectra_light(spectra, &table, &place, &error));
    CHECK(surface != spectra_surface(spectra, &like, &place, &error));
    const struct banded *light = spectra_light(spectra, &warm, &place, &error);
    CHECK(light != NULL && light == spectra_light(spectra, &warm, &place, &error));
    CHECK(light != spectra_light(spectra, &cool, &place, &error));
    CHECK(spectra->index.count == 10);
}

int main(void)
{
    struct arena arena = {0};
    struct error error = {0};
    struct bands bands;
    struct materials materials;
    bands_three(&bands);
    struct spectra spectra = {.bands = &bands, .arena = &arena};
    CHECK(materials_open(&scene, &spectra, &materials, &error));
    test_bsdf(&materials);
    test_shine(&materials);
    test_shared(&materials, &spectra);
    written[3].colour.rgb[1] = NAN;
    written[3].place = (struct typed_place){"a.scene", 12, 3};
    CHECK(!materials_open(&scene, &spectra, &materials, &error));
    CHECK(error.line == 12 && strstr(error.message, "material 'coated'") != NULL);
    arena_free(&arena);
    return check_report();
}
