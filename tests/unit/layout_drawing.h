/* tests/unit/layout_drawing.h - a lens of a text in section. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_LAYOUT_DRAWING_H
#define LENSCALC_TESTS_UNIT_LAYOUT_DRAWING_H

#include "analysis/layout/layout.h"
#include "check.h"
#include "file/lens_file.h"

struct drawing {
    struct setup setup;
    struct setup_light light;
    struct layout layout;
};

/* What is wanted besides the lens, in words. */
struct wanted {
    bool planes, construction, no_rays, every_field;
    enum lens_section section;
};

static inline bool try_draw(const char *text, const struct wanted *wanted, struct arena *arena,
                            struct drawing *drawing, struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    const struct plane_value plane = {.kind = PLANE_OF_LENS};
    if (!lens_read("test", text_of(text), NULL, arena, lens, error)) {
        return false;
    }
    const struct setup_question question = {.lens = lens,
                                            .section = wanted->section,
                                            .wavelength = NAN,
                                            .fnumber = NAN,
                                            .field_policy =
                                                wanted->every_field ? FIELDS_ALL : FIELDS_LARGEST};
    if (!setup_open(&question, arena, &drawing->setup, error) ||
        !setup_place_image(&drawing->setup, &plane, error) ||
        !setup_light(&drawing->setup, 0, &drawing->light, error)) {
        return false;
    }
    const struct layout_request request = {.light = &drawing->light,
                                           .planes = wanted->planes,
                                           .construction = wanted->construction,
                                           .no_rays = wanted->no_rays};
    return layout_make(&drawing->setup, &request, arena, &drawing->layout, error);
}

static inline void draw(const char *text, const struct wanted *wanted, struct arena *arena,
                        struct drawing *drawing)
{
    struct error error = {0};
    bool good = try_draw(text, wanted, arena, drawing, &error);
    CHECK(good);
    if (!good) {
        printf("%s: %s\n", text, error.message);
    }
}

/* The i-th part of a kind; an empty one if there is none. */
static inline const struct layout_part *part_of(const struct drawing *drawing,
                                                enum layout_kind kind, size_t i)
{
    static const struct layout_part none = {.label = ""};
    for (size_t k = 0; k < drawing->layout.part_count; k++) {
        if (drawing->layout.parts[k].kind == kind && i-- == 0) {
            return &drawing->layout.parts[k];
        }
    }
    return &none;
}

static inline size_t count_of(const struct drawing *drawing, enum layout_kind kind)
{
    size_t count = 0;
    while (part_of(drawing, kind, count)->count > 0) {
        count++;
    }
    return count;
}

static inline bool is_noted(const struct drawing *drawing, const char *note)
{
    for (size_t i = 0; i < drawing->layout.note_count; i++) {
        if (strstr(drawing->layout.notes[i], note) != NULL) {
            return true;
        }
    }
    return false;
}

#endif
