/* analysis/model/third_order.c - rays with their aberrations of the third order. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/third_order.h"

#include "analysis/model/lens_model.h"
#include "optics/seidel.h"

bool third_order_open(const struct setup *setup, const struct setup_light *light,
                      struct arena *arena, struct third_order *third, struct error *error)
{
    const struct first_order *first = &light->first;
    const bool is_near = !setup->object.is_infinite;
    const struct paraxial_matrix *matrix = &first->matrix;
    const double n = first->index_object, m = first->index_image;
    struct seidel seidel;
    const struct seidel_question question = {.lens = setup->lens,
                                             .system = &light->system,
                                             .section = setup->section,
                                             .object = &setup->object,
                                             .first = first,
                                             .field_kind = is_near ? FIELD_HEIGHT : FIELD_ANGLE,
                                             .field = is_near ? 1 : 0.1};
    if (!lens_model_check(setup->lens, first, error) ||
        !seidel_compute(&question, arena, &seidel, error)) {
        return false;
    }
    if (!isfinite(first->image) || !isfinite(first->exit_pupil)) {
        return fail(error, ERROR_DOMAIN, "the sums of the third order: the %s lies at infinity",
                    isfinite(first->image) ? "exit pupil" : "image");
    }
    const double *sum = seidel.total.sum, q2 = 2 * seidel.slope;
    *third =
        (struct third_order){.matrix = {matrix->a.hi + first->image * matrix->c.hi / m,
                                        n * (matrix->b.hi + first->image * matrix->d.hi / m),
                                        matrix->c.hi / m, n * matrix->d.hi / m},
                             .entrance = first->entrance_pupil,
                             .object = is_near ? setup->object.distance.hi : (double)INFINITY,
                             .pupil = fabs(first->entrance_diameter) / 2,
                             .field = is_near ? question.field : tan(question.field),
                             .aberration = {sum[SEIDEL_SPHERICAL] / q2, sum[SEIDEL_COMA] / q2,
                                            sum[SEIDEL_ASTIGMATISM] / q2,
                                            (sum[SEIDEL_ASTIGMATISM] + sum[SEIDEL_PETZVAL]) / q2},
                             .distortion = sum[SEIDEL_DISTORTION] / q2,
                             .index_image = m,
                             .image = first->image,
                             .arm = first->image - first->exit_pupil};
    return true;
}
