/* analysis/model/model_sums.c - what a model of a lens says of its spots, contrast, light, focus. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/model_sums.h"

#include "analysis/pupil/bundle.h"
#include "base/constants.h"
#include "trace/dispatch.h"
#include "trace/pupil/focus.h"
#include "trace/tangent.h"

#include <math.h>
#include <string.h>

/* -------- sums over rays in the image plane, from one to before another -------- */

static double model_spot(const struct rays *rays, size_t from, size_t to, const double *weights)
{
    double weight = 0, x = 0, y = 0, square = 0;
    for (size_t i = from; i < to; i++) {
        const struct ray_block *block = &rays->blocks[i / RAYS_BLOCK];
        if (weights[i] > 0) {
            weight += weights[i];
            x += weights[i] * block->x[i % RAYS_BLOCK];
            y += weights[i] * block->y[i % RAYS_BLOCK];
        }
    }
    x /= weight;
    y /= weight;
    for (size_t i = from; i < to; i++) {
        const struct ray_block *block = &rays->blocks[i / RAYS_BLOCK];
        const double dx = block->x[i % RAYS_BLOCK] - x, dy = block->y[i % RAYS_BLOCK] - y;
        square += weights[i] > 0 ? weights[i] * (dx * dx + dy * dy) : 0;
    }
    return sqrt(square / weight);
}

/* See rays_best_focus, which has whole blocks. */
static double model_focus(const struct rays *rays, size_t from, size_t to, const double *weights)
{
    double weight = 0, mean[4] = {0, 0, 0, 0}, cross = 0, square = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = from; i < to; i++) {
            const struct ray_block *block = &rays->blocks[i / RAYS_BLOCK];
            const size_t k = i % RAYS_BLOCK;
            const double a = block->p[k] / block->r[k], b = block->q[k] / block->r[k];
            const double w = weights[i], x = block->x[k], y = block->y[k];
            if (!(w > 0)) {
                continue;
            }
            if (pass == 0) {
                weight += w;
                mean[0] += w * x;
                mean[1] += w * y;
                mean[2] += w * a;
                mean[3] += w * b;
            } else {
                const double da = a - mean[2] / weight, db = b - mean[3] / weight;
                cross += w * ((x - mean[0] / weight) * da + (y - mean[1] / weight) * db);
                square += w * (da * da + db * db);
            }
        }
    }
    return square > 0 ? -cross / square : (double)NAN;
}

static double model_contrast(const struct rays *rays, size_t from, size_t to, const double *weights,
                             double frequency)
{
    double weight = 0, re = 0, im = 0, origin = NAN;
    for (size_t i = from; i < to; i++) {
        if (weights[i] > 0) {
            const double y = rays->blocks[i / RAYS_BLOCK].y[i % RAYS_BLOCK];
            origin = isnan(origin) ? y : origin;
            const double turn = 2 * PI * frequency * (y - origin);
            weight += weights[i];
            re += weights[i] * cos(turn);
            im += weights[i] * sin(turn);
        }
    }
    return hypot(re, im) / weight;
}

/* Of rays four by four; see model_rays. */
static double model_light(const struct model_rays *rays, size_t from, size_t to, double n)
{
    double sum = 0;
    for (size_t i = from; i + 3 < to; i += 4) {
        double p[4], q[4];
        for (size_t k = 0; k < 4; k++) {
            p[k] = rays->ends.blocks[(i + k) / RAYS_BLOCK].p[(i + k) % RAYS_BLOCK];
            q[k] = rays->ends.blocks[(i + k) / RAYS_BLOCK].q[(i + k) % RAYS_BLOCK];
        }
        sum += rays->weights[i / 4] *
               fabs((p[0] - p[1]) * (q[2] - q[3]) - (q[0] - q[1]) * (p[2] - p[3]));
    }
    return sum / (4 * rays->step * rays->step * n * n);
}

/* What rays in the plane say; of those whose weight is 0 nothing. */
static double model_sum_of_rays(const struct model_sum_question *question, const struct rays *rays,
                                size_t from, size_t to, const double *weights)
{
    switch (question->sum) {
    case MODEL_SUM_SPOT:
        return model_spot(rays, from, to, weights);
    case MODEL_SUM_CONTRAST:
        return model_contrast(rays, from, to, weights, question->frequency);
    default:
        return question->setup->image + model_focus(rays, from, to, weights);
    }
}

/* -------- exact rays -------- */

/* A field made ready, and the rays of its pupil. They point at the question. */
struct model_field {
    struct bundle_question question;
    struct bundle_source source;
    struct bundle starts; /* where rays start, their weights 0 if they do not arrive */
    struct rays ends;
    double *weights; /* those weights, one a ray */
};

static bool model_field_open(const struct model_sum_question *question,
                             const struct field_point *point, struct arena *arena,
                             struct model_field *field, struct error *error)
{
    const bool is_light = question->sum == MODEL_SUM_IRRADIANCE;
    field->question = (struct bundle_question){.setup = question->setup,
                                               .field = point,
                                               .clip = question->clip,
                                               .weight = is_light ? WEIGHT_BEAM : WEIGHT_PUPIL,
                                               .pattern = question->pattern};
    if (!bundle_open(&field->question, arena, &field->source, error)) {
        return false;
    }
    if (is_light && field->source.pupil.has_disc) {
        return fail(error, ERROR_DOMAIN,
                    "light is added up over a stop, and rays are not aimed at one here");
    }
    struct bundle *starts = &field->starts;
    if (!bundle_fill(&field->source, question->rays, arena, starts, error)) {
        return false;
    }
    field->ends = rays_new(arena, starts->count);
    field->weights = ARENA_ARRAY(arena, starts->count, double);
    memcpy(field->ends.blocks, starts->rays.blocks,
           rays_blocks(&field->ends) * sizeof *starts->rays.blocks);
    rays_trace(field->source.system, &field->ends, NULL);
    for (size_t i = 0; i < starts->count; i++) {
        const struct ray_block *block = &field->ends.blocks[i / RAYS_BLOCK];
        const bool arrives = ray_block_status(block, i % RAYS_BLOCK) == RAY_OK;
        field->weights[i] = arrives ? starts->points[i].weight : 0;
        starts->clear += field->weights[i];
    }
    return starts->clear > 0 || bundle_fail_dark(&field->source, starts->count, arena, error);
}

/* The area across the beam that a weight of 1 stands for, mm^2. */
static double model_field_area(const struct model_field *field)
{
    const double *m = field->source.pupil.axes;
    return PI * fabs(m[0] * m[3] - m[1] * m[2]);
}

/* Light by the derivatives of rays. */
static double model_field_light(const struct model_field *field, struct arena *arena)
{
    const struct system *system = field->source.open;
    struct ray_block *block = rays_new(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    struct ray_block *tangents = rays_new(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    double sum = 0;
    for (size_t b = 0; b < rays_blocks(&field->ends); b++) {
        const size_t left = field->ends.count - b * RAYS_BLOCK;
        const size_t used = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        const int lanes = kernel_lanes(used);
        ray_block_copy(block, &field->starts.rays.blocks[b], used);
        beam_tangents(&field->source.beam, (double[2]){1, 0}, block, (size_t)lanes, &tangents[0]);
        beam_tangents(&field->source.beam, (double[2]){0, 1}, block, (size_t)lanes, &tangents[1]);
        tangent_follow(system, lanes, 2, block, tangents);
        for (size_t k = 0; k < used; k++) {
            const double weight = field->weights[b * RAYS_BLOCK + k];
            const double det =
                fabs(tangents[0].p[k] * tangents[1].q[k] - tangents[1].p[k] * tangents[0].q[k]);
            sum += weight > 0 && isfinite(det) ? weight * det : 0;
        }
    }
    return model_field_area(field) * sum / (system->index_first * system->index_first);
}

bool model_sum_find(const struct model_sum_question *question, struct arena *arena, double *values,
                    struct error *error)
{
    for (size_t f = 0; f < question->setup->field_count; f++) {
        const struct arena_mark mark = arena_mark(arena);
        struct model_field *field = ARENA_NEW(arena, struct model_field);
        const bool found =
            model_field_open(question, &question->setup->fields[f].point, arena, field, error);
        if (found) {
            values[f] = question->sum == MODEL_SUM_IRRADIANCE
                            ? model_field_light(field, arena)
                            : model_sum_of_rays(question, &field->ends, 0, field->ends.count,
                                                field->weights);
        }
        arena_reset(arena, mark);
        if (!found) {
            return false;
        }
    }
    return true;
}

/* -------- models -------- */

bool model_rays_make(const struct model_sum_question *question, const struct setup_field *fields,
                     size_t count, struct arena *arena, struct model_rays *rays,
                     struct error *error)
{
    const bool is_light = question->sum == MODEL_SUM_IRRADIANCE;
    struct model_field **all = ARENA_ARRAY(arena, count, struct model_field *);
    const size_t each = is_light ? 4 : 1; /* rays of a point */
    size_t points = 0, at = 0;
    *rays = (struct model_rays){.begin = ARENA_ARRAY(arena, count + 1, size_t)};
    for (size_t f = 0; f < count; f++) {
        all[f] = ARENA_NEW(arena, struct model_field);
        if (!model_field_open(question, &fields[f].point, arena, all[f], error)) {
            return false;
        }
        for (size_t i = 0; i < all[f]->starts.count; i++) {
            points += all[f]->weights[i] > 0;
        }
        /* errors of differences go by its square, rounding by one over it */
        rays->step = fmax(rays->step, 1e-4 * sqrt(model_field_area(all[f])));
    }
    rays->starts = rays_new(arena, each * points);
    rays->ends = rays_new(arena, each * points);
    rays->weights = ARENA_ARRAY(arena, points, double);
    for (size_t f = 0; f < count; f++) {
        const struct beam *beam = &all[f]->source.beam;
        const double n = beam->n, clear = all[f]->starts.clear;
        rays->begin[f] = each * at;
        for (size_t i = 0; i < all[f]->starts.count; i++) {
            struct ray ray = rays_get(&all[f]->starts.rays, i, 1);
            const double weight = all[f]->weights[i];
            double place[2];
            if (!(weight > 0)) {
                continue;
            }
            rays->weights[at] =
                is_light ? weight * model_field_area(all[f]) : fields[f].weight * weight / clear;
            if (!is_light) {
                rays_set(&rays->starts, at++, 1, &ray);
                continue;
            }
            beam_place(beam, ray.point, place);
            for (size_t k = 0; k < 4; k++) {
                const double step = k % 2 == 0 ? rays->step : -rays->step;
                ray = beam_ray(beam, place[0] + (k < 2 ? step : 0), place[1] + (k < 2 ? 0 : step));
                rays_set(&rays->starts, 4 * at + k, n, &ray);
            }
            at++;
        }
    }
    rays->begin[count] = each * at;
    return true;
}

void model_rays_trace(const struct ray_model *model, const struct model_rays *rays,
                      double (*low)[2])
{
    memcpy(rays->ends.blocks, rays->starts.blocks,
           rays_blocks(&rays->starts) * sizeof *rays->starts.blocks);
    ray_model_trace(model, &rays->ends, low);
}

void model_sum_of_model(const struct model_sum_question *question, const struct ray_model *model,
                        const struct model_rays *rays, size_t count, double *values)
{
    model_rays_trace(model, rays, NULL);
    for (size_t f = 0; f < count; f++) {
        const size_t from = rays->begin[f], to = rays->begin[f + 1];
        values[f] = question->sum == MODEL_SUM_IRRADIANCE
                        ? model_light(rays, from, to, question->setup->first.index_object)
                        : model_sum_of_rays(question, &rays->ends, from, to, rays->weights);
    }
}
