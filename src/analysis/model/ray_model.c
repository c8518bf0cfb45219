/* analysis/model/ray_model.c - a lens as what takes rays in and gives rays out. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/ray_model.h"

#include "trace/dispatch.h"
#include "trace/verify.h"

#include <math.h>

struct ray_model ray_model_of_thick(enum lens_model kind, struct thick_lens thick, double image)
{
    return (struct ray_model){.kind = kind, .image = image, .thick = thick};
}

struct ray_model ray_model_of_system(const struct system *system)
{
    return (struct ray_model){.kind = MODEL_EXACT, .image = (double)NAN, .system = system};
}

bool ray_model_open(const struct setup *setup, enum lens_model kind, struct arena *arena,
                    struct ray_model *model, struct error *error)
{
    const unsigned which = SETUP_IMAGE | (kind == MODEL_PARAXIAL ? (unsigned)SETUP_PARAXIAL : 0);
    struct setup_light light;
    *model = (struct ray_model){.kind = kind, .image = setup->image};
    if (!isfinite(setup->image)) {
        return fail(error, ERROR_DOMAIN, "there is no image plane that rays could meet");
    }
    switch (kind) {
    case MODEL_SEIDEL:
        return setup_light(setup, 0, &light, error) &&
               third_order_open(setup, &light, arena, &model->third, error);
    case MODEL_THICK:
    case MODEL_THIN:
    case MODEL_PINHOLE:
        if (!setup_light(setup, 0, &light, error) ||
            !lens_model_check_rays(setup->lens, &light.first, error)) {
            return false;
        }
        model->thick = lens_model_thick(kind, &light.first,
                                        setup->object.is_infinite ? (double)INFINITY
                                                                  : setup->object.distance.hi);
        return true;
    default:
        model->system = setup_system(setup, 0, which, error);
        return model->system != NULL;
    }
}

/* -------- by slopes -------- */

static inline struct slope_ray ray_model_start(const struct ray_block *block, size_t i)
{
    const double p = block->p[i] / block->r[i], q = block->q[i] / block->r[i];
    return (struct slope_ray){block->x[i] - block->z[i] * p, block->y[i] - block->z[i] * q, p, q};
}

/* Put it where it meets a plane a way on. */
static inline void ray_model_put(struct ray_block *block, size_t i, struct slope_ray ray,
                                 double way, double n)
{
    const double r = n / sqrt(1 + ray.p * ray.p + ray.q * ray.q);
    block->x[i] = ray.x + way * ray.p;
    block->y[i] = ray.y + way * ray.q;
    block->z[i] = 0;
    block->p[i] = ray.p * r;
    block->q[i] = ray.q * r;
    block->r[i] = r;
}

static void ray_model_thick_block(const struct ray_model *model, struct ray_block *block,
                                  size_t lanes)
{
    const struct thick_lens thick = model->thick;
    for (size_t i = 0; i < lanes; i++) {
        ray_model_put(block, i, thick_lens_map(&thick, ray_model_start(block, i)), model->image,
                      thick.index_image);
    }
}

static void ray_model_pinhole_block(const struct ray_model *model, struct ray_block *block,
                                    size_t lanes)
{
    const struct thick_lens thick = model->thick;
    for (size_t i = 0; i < lanes; i++) {
        ray_model_put(block, i, thick_lens_pinhole(&thick, ray_model_start(block, i)), model->image,
                      thick.index_image);
    }
}

static void ray_model_third_block(const struct ray_model *model, struct ray_block *block,
                                  size_t lanes)
{
    const struct third_order third = model->third;
    for (size_t i = 0; i < lanes; i++) {
        ray_model_put(block, i, third_order_map(&third, ray_model_start(block, i), model->image), 0,
                      third.index_image);
    }
}

/* -------- exact -------- */

static void ray_model_precise_block(const struct ray_model *model, struct ray_block *block,
                                    size_t lanes, double (*low)[2])
{
    const double n = model->system->index_last;
    for (size_t i = 0; i < lanes; i++) {
        const double point[3] = {block->x[i], block->y[i], block->z[i]};
        const double direction[3] = {block->p[i], block->q[i], block->r[i]};
        const struct precise_end end = model->kind == MODEL_EXACT_64
                                           ? ray_of_64_bits(model->system, point, direction)
                                           : ray_of_113_bits(model->system, point, direction);
        block->x[i] = end.point[0].hi;
        block->y[i] = end.point[1].hi;
        block->z[i] = end.point[2].hi;
        block->p[i] = n * end.cosine[0].hi;
        block->q[i] = n * end.cosine[1].hi;
        block->r[i] = n * end.cosine[2].hi;
        if (low != NULL) {
            low[i][0] = end.point[0].lo;
            low[i][1] = end.point[1].lo;
        }
    }
}

void ray_model_trace(const struct ray_model *model, const struct rays *rays, double (*low)[2])
{
    for (size_t i = 0; i < rays->count && low != NULL; i++) {
        low[i][0] = low[i][1] = 0;
    }
    if (model->kind == MODEL_EXACT || model->kind == MODEL_PARAXIAL) {
        rays_trace(model->system, rays, &(struct trace_way){model->set, 1});
        return;
    }
    if (model->kind == MODEL_POLYNOMIAL) {
        ray_polynomial_trace(&model->polynomial, rays);
        return;
    }
    for (size_t b = 0; b < rays_blocks(rays); b++) {
        struct ray_block *block = &rays->blocks[b];
        const size_t left = rays->count - b * RAYS_BLOCK;
        const size_t lanes = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        if (model->kind == MODEL_SEIDEL) {
            ray_model_third_block(model, block, lanes);
        } else if (model->kind == MODEL_PINHOLE) {
            ray_model_pinhole_block(model, block, lanes);
        } else if (model->kind >= MODEL_EXACT_64) {
            ray_model_precise_block(model, block, lanes, low != NULL ? low + b * RAYS_BLOCK : NULL);
        } else {
            ray_model_thick_block(model, block, lanes);
        }
    }
}
