/* tests/ceres/subject.h - a lens of lensdb with rays of its fields, ready to be fitted. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_CERES_SUBJECT_H
#define LENSCALC_TESTS_CERES_SUBJECT_H

#include "analysis/setup/setup.h"
#include "design/fit/ray_data.h"
#include "design/fit/thick.h"
#include "exchange/lens_open.h"

struct subject {
    struct lens lens;
    struct setup setup;
    struct first_order first; /* with the aperture of the rays */
    struct ray_data ray_data;
    struct thick_rays rays; /* all of them */
    size_t *field;          /* of each */
    double *weight;
    size_t lost_count;
    struct thick_sums sums;
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

/* All parts in one. */
static inline void subject_gather(struct subject *subject, struct arena *arena)
{
    struct ray_data *ray_data = &subject->ray_data;
    const struct ray_part *part;
    double *columns[11];
    while (ray_data_next(ray_data) != NULL) {
    }
    size_t most = ray_data->count, *group = ARENA_ARRAY(arena, most, size_t), count = 0;
    subject->field = ARENA_ARRAY(arena, most, size_t);
    subject->lost_count = 0;
    for (int k = 0; k < 11; k++) {
        columns[k] = ARENA_ARRAY(arena, most, double);
    }
    while ((part = ray_data_next(ray_data)) != NULL) {
        for (size_t i = 0; i < part->rays.count; i++, count++) {
            for (int k = 0; k < 11; k++) {
                columns[k][count] = part->columns[k][i];
            }
            group[count] = part->rays.group[i];
            subject->field[count] = part->rays.field[i];
        }
        subject->lost_count += part->lost_count;
    }
    subject->weight = columns[8];
    subject->rays = (struct thick_rays){count,
                                        columns[0],
                                        columns[1],
                                        columns[2],
                                        columns[3],
                                        columns[4],
                                        columns[5],
                                        columns[6],
                                        columns[7],
                                        columns[8],
                                        group,
                                        subject->field,
                                        subject->setup.field_count,
                                        columns[9],
                                        columns[10]};
}

/* What the fit takes, of the rays as they are now. */
static inline bool subject_sum(struct subject *subject, struct arena *arena, struct error *error)
{
    subject->sums = thick_sums_open(subject->setup.field_count, subject->setup.wavelength_count,
                                    INFINITY, arena);
    return thick_sums_add(&subject->sums, &subject->rays, error);
}

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
    if (!ray_data_open(&request, arena, &subject->ray_data, error)) {
        return false;
    }
    subject_gather(subject, arena);
    return ray_data_check(&subject->ray_data, error) && subject_sum(subject, arena, error);
}

/* Its lens at its aperture, its rays, and the fit that lenscalc makes of them. */
static inline bool subject_make(const struct subject_rays *wanted, struct arena *arena,
                                struct subject *subject, struct error *error)
{
    struct first_order *first = &subject->first;
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
    subject->task = (struct thick_task){.sums = &subject->sums,
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

/* The same of a lens of lensdb. */
static inline bool subject_open(const char *name, const struct subject_rays *wanted,
                                struct arena *arena, struct subject *subject, struct error *error)
{
    struct lensdb db = {.arena = arena};
    return lens_open(&db, text_of(name), arena, &subject->lens, error) &&
           subject_make(wanted, arena, subject, error);
}

#endif
