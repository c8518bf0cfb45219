/* tests/fuzz/odd_scene.h - a legal but odd scene out of the fuzzer's bytes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_FUZZ_ODD_SCENE_H
#define LENSCALC_TESTS_FUZZ_ODD_SCENE_H

#include "ask.h"
#include "odd.h"

enum { SCENE_MOST = 12, SCENE_BESIDE_LENS = 4, ODD_CORNERS = 6 };

/* A word with three numbers, each of either sign or 0. */
static inline void vector_write(struct page *page, const char *word, struct bytes *bytes,
                                double least, double most)
{
    const double x = bytes_signed(bytes, least, most), y = bytes_signed(bytes, least, most);
    const double z = bytes_signed(bytes, least, most);
    page_add(page, " %s=%.6g,%.6g,%.6g", word, x, y, z);
}

/* A direction, which is not 0. */
static inline void direction_write(struct page *page, const char *word, struct bytes *bytes)
{
    const double x = bytes_signed(bytes, 1e-6, 1), y = bytes_signed(bytes, 1e-6, 1);
    page_add(page, " %s=%.6g,%.6g,%.6g", word, x, y, bytes_pick(bytes, 2) == 0 ? 0.001 : -1);
}

/* A light for whatever takes one. */
static inline const char *colour_next(struct bytes *bytes)
{
    static const char *const colours[] = {"D65",         "2700K",   "own", "E",     "F11",
                                          "0.2,0.5,0.1", "#ff0000", "A",   "0,0,1", "12000K"};
    return colours[bytes_pick(bytes, sizeof colours / sizeof colours[0])];
}

/* A picture of 4 x 2 pixels with values up to this. */
static inline void picture_write(struct bytes bytes, const char *ending, double most)
{
    char picture[12 + 4 * 2 * 3 * sizeof(float)];
    memcpy(picture, "PF\n4 2\n-1.0\n", 12);
    for (size_t i = 0; i < 4 * 2 * 3; i++) {
        const float light = (float)(pow(bytes_next(&bytes) / 255.0, 9) * most);
        memcpy(picture + 12 + i * sizeof light, &light, sizeof light);
    }
    ask_file(ending, picture, sizeof picture);
}

/* What the scene's files hold: pictures of a surface and of a sky, a mesh of a few corners. */
static inline void scene_files_write(struct bytes *input)
{
    static struct page mesh;
    const struct bytes light = bytes_chunk(input);
    struct bytes bytes = bytes_chunk(input);
    picture_write(light, "map", 1);
    picture_write(light, "sky", 1e12);
    mesh.length = 0;
    for (int i = 0; i < ODD_CORNERS; i++) {
        const double x = bytes_next(&bytes) - 128.0, y = bytes_next(&bytes) - 128.0;
        page_add(&mesh, "v %g %g %g\n", x / 16, y / 16, (bytes_next(&bytes) - 128.0) / 16);
    }
    page_add(&mesh, "f 1 2 3\nf 4 5 6\nf 1 2 3 4 5 6\n");
    ask_file("obj", mesh.text, mesh.length);
}

/* Where a thing is, how it lies and moves. */
static inline void place_write(struct page *page, struct bytes *bytes)
{
    vector_write(page, "at", bytes, 1e-3, 1e3);
    const unsigned which = bytes_next(bytes);
    if (which & 1) {
        direction_write(page, "normal", bytes);
    }
    if (which & 2) {
        vector_write(page, "turn", bytes, 1e-3, 360);
    }
    if (which & 4) {
        vector_write(page, "move", bytes, 1e-6, 1e6);
    }
    if (which & 8) {
        page_add(page, " spin=%.6g", bytes_signed(bytes, 1e-3, 1e5));
        direction_write(page, "axis", bytes);
    }
    page_add(page, "\n");
}

static inline void thing_write(struct page *page, struct bytes *bytes, const char *stem,
                               unsigned material)
{
    const unsigned shape = bytes_pick(bytes, 8);
    const double size = bytes_amount(bytes, 1e-6, 1e6), other = bytes_amount(bytes, 1e-6, 1e6);
    switch (shape) {
    case 0:
        page_add(page, "plane material=m%u", material);
        break;
    case 1:
        page_add(page, "disc material=m%u radius=%.6g", material, size);
        break;
    case 2:
        page_add(page, "card material=m%u size=%.6g,%.6g", material, size, other);
        break;
    case 3:
        page_add(page, "sphere material=m%u radius=%.6g", material, size);
        break;
    case 4:
        page_add(page, "box material=m%u size=%.6g,%.6g,1", material, size, other);
        break;
    case 5:
        page_add(page, "card file=%smap size=%.6g", stem, size);
        break;
    case 6:
        page_add(page, "mesh material=m%u file=%sobj scale=%.6g", material, stem, size);
        break;
    default:
        page_add(page, "card file=%smap size=%.6g,%.6g luminance=%.6g", stem, size, other, other);
        break;
    }
    place_write(page, bytes);
}

static inline void material_write(struct page *page, struct bytes *bytes, const char *stem,
                                  unsigned number)
{
    static const char *const kinds[] = {"lambert", "glossy", "mirror", "black"};
    const unsigned kind = bytes_pick(bytes, 4), which = bytes_next(bytes);
    page_add(page, "material m%u %s", number, kinds[kind]);
    if (kind < 2 && which & 1) {
        page_add(page, " texture=%smap", stem);
    } else if (kind < 3) {
        page_add(page, " colour=%.6g", bytes_next(bytes) / 255.0);
    }
    if (kind == 1) {
        const double roughness = bytes_amount(bytes, 0.001, 1);
        page_add(page, " roughness=%.6g index=%.6g", roughness, bytes_amount(bytes, 1, 3));
    }
    if (which & 2) {
        const double luminance = bytes_amount(bytes, 1e-9, 1e9);
        page_add(page, " luminance=%.6g emission=%s", luminance, colour_next(bytes));
    }
    page_add(page, "\n");
}

static inline void light_write(struct page *page, struct bytes *bytes, const char *stem,
                               bool *has_sky)
{
    static const char *const skies[] = {"uniform", "overcast", "clear"};
    const unsigned kind = bytes_pick(bytes, 5);
    const double amount = bytes_amount(bytes, 1e-9, 1e9);
    const char *colour = colour_next(bytes);
    if (kind == 0) {
        page_add(page, "light sun illuminance=%.6g spectrum=%s", amount, colour);
        direction_write(page, "towards", bytes);
        page_add(page, " diameter=%.6g\n", bytes_amount(bytes, 1e-6, 170));
    } else if (kind == 1 && !*has_sky) {
        const char *sky = skies[bytes_pick(bytes, 3)];
        page_add(page, "light sky %s luminance=%.6g spectrum=%s elevation=%.6g azimuth=30\n", sky,
                 amount, colour, bytes_amount(bytes, 1e-3, 90));
        *has_sky = true;
    } else if (kind == 2) {
        page_add(page, "light star illuminance=%.6g spectrum=%s", amount, colour);
        direction_write(page, "towards", bytes);
        page_add(page, "\n");
    } else if (kind == 3 && !*has_sky) {
        page_add(page, "light environment file=%ssky luminance=%.6g azimuth=%.6g\n", stem, amount,
                 bytes_signed(bytes, 1e-3, 360));
        *has_sky = true;
    } else {
        page_add(page, "light point intensity=%.6g spectrum=%s", amount, colour);
        vector_write(page, "at", bytes, 1e-3, 1e3);
        vector_write(page, "move", bytes, 1e-6, 1e6);
        page_add(page, "\n");
    }
}

/*
 * The bytes as a .scene.
 *
 * Given     stem  path of its files up to their endings
 *           most  lines of materials, lights and things
 */
static inline void scene_write(struct page *page, struct bytes *input, const char *stem,
                               unsigned most)
{
    struct bytes head = bytes_chunk(input);
    bool has_sky = false;
    page_add(page, "scene odd\nunit %s\ncamera", bytes_pick(&head, 8) == 7 ? "km" : "m");
    vector_write(page, "at", &head, 1e-3, 1e3);
    if (bytes_pick(&head, 2) == 1) {
        vector_write(page, "look", &head, 1e-3, 1e3);
    }
    if (bytes_pick(&head, 4) == 1) {
        vector_write(page, "move", &head, 1e-3, 1e4);
    }
    page_add(page, " focus=%.6gm\n", bytes_amount(&head, 0.2, 1e9));
    page_add(page, "colour own rgb=%.6g,0.5,%.6g\n", bytes_next(&head) / 255.0, 0.0);
    page_add(page, "material m0 lambert colour=0.5\n");
    for (unsigned i = 1, materials = 1; i <= most && input->at < input->end; i++) {
        struct bytes bytes = bytes_chunk(input);
        const unsigned kind = bytes_pick(&bytes, 4);
        if (kind == 0) {
            material_write(page, &bytes, stem, materials++);
        } else if (kind == 1) {
            light_write(page, &bytes, stem, &has_sky);
        } else {
            thing_write(page, &bytes, stem, bytes_pick(&bytes, materials));
        }
    }
    page_add(page, "light sun illuminance=1000 elevation=40 azimuth=0\n");
}

#endif
