/* tests/ceres/subject.h - a lens of lensdb with rays of its fields, ready to be fitted. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_CERES_SUBJECT_H
#define LENSCALC_TESTS_CERES_SUBJECT_H

#include "analysis/setup.h"
#include "design/fit/ray_data.h"
#include "design/fit/thick.h"
#include "exchange/lens_open.h"

struct subject {
    struct lens lens;
    struct setup setup;
    struct first_order first; /* with the aperture of the rays */
    struct ray_data ray_data;
    struct thick_task task;
};

/* Which rays of it: so many fields from the axis to the largest, rad. */
struct subject_rays {
    struct aperture_setting aperture;
    double field;
    size_t field_count;
    enum pattern pattern;
    size_t rays;
    bool no_clip, is_white; /* d; white: all wavelengths of the lens, three at most */
};

static inline bool subject_trace(const struct subject_rays *wanted, struct arena *arena,
                                 struct subject *subject, struct error *error)
{
    struct setup_field *fields = ARENA_ARRAY(arena, wanted->field_count, struct setup_field);
    for (size_t i = 0; i < wanted->field_count; i++) {
        double share = (double)i / (double)(wanted->field_count - 1);
        fields[i] = (struct setup_field){{FIELD_ANGLE, {0, wanted->field * share}}, 1};
    }
    subject->setup.fields = fields;
    subject->setup.field_count = wanted->field_count;
    const struct ray_data_request request = {.setup = &subject->setup,
                                             .pattern = wanted->pattern,
                                             .ray_count = wanted->rays,
                                             .no_clip = wanted->no_clip};
    return ray_data_trace(&request, arena, &subject->ray_data, error);
}

/* The lens at its aperture, its rays, and the fit that lenscalc makes of them. */
static inline bool subject_open(const char *name, const struct subject_rays *wanted,
                                struct arena *arena, struct subject *subject, struct error *error)
{
    struct lensdb db = {.arena = arena};
    struct first_order *first = &subject->first;
    if (!lens_open(&db, text_of(name), arena, &subject->lens, error)) {
        return false;
    }
    const double d = 0.5875618;
    const struct setup_question question = {.lens = &subject->lens,
                                            .wavelength = wanted->is_white ? NAN : d,
                                            .wavelengths = WAVELENGTHS_ALL,
                                            .fnumber = NAN};
    const struct conjugate_object object = lens_object(&subject->lens);
    if (!setup_open(&question, arena, &subject->setup, error) ||
        !first_order_of_lens(&subject->lens, d, SECTION_Y, arena, first, error) ||
        !first_order_aperture(first, &object, &wanted->aperture, FIELD_NONE, NAN, error)) {
        return false;
    }
    subject->setup.first = *first;
    if (!subject_trace(wanted, arena, subject, error)) {
        return false;
    }
    subject->task = (struct thick_task){.rays = subject->ray_data.rays,
                                        .group_count = subject->setup.wavelength_count,
                                        .index_object = subject->ray_data.index_object,
                                        .index_image = subject->ray_data.index_image,
                                        .planes = {first->image, first->exit_pupil},
                                        .plane_weights = {1, THICK_PUPIL_WEIGHT},
                                        .focus_weight = THICK_FOCUS_WEIGHT,
                                        .object = INFINITY,
                                        .start = {.focal = first->efl,
                                                  .front = first->front_principal,
                                                  .rear = first->rear_principal,
                                                  .index_object = 1,
                                                  .index_image = 1,
                                                  .object = INFINITY}};
    return true;
}

#endif
