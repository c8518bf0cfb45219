/* tests/stress/image_trial.c - random lenses that make images, and rays for sums of our own. */
/* SPDX-License-Identifier: MIT */
#include "image_trial.h"

#include "file/lens_file.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* So wide that some of the beam passes the other surfaces, or all of it, or none. */
static void image_trial_clip(struct trial *trial, double radius, struct drawn_lens *drawn)
{
    for (size_t i = 0; i < drawn->count; i++) {
        if (i != drawn->stop && trial_chance(trial, 0.6)) {
            drawn->clear[i] = 2 * radius * trial_between(trial, 0.6, 1.6);
        }
    }
}

bool image_trial_open(struct trial *trial, double radius, bool is_clipped, struct image_trial *one)
{
    static struct drawn_lens drawn;
    const struct drawn_scale scale = {.least = 2,
                                      .most = 8,
                                      .radius = {30, 400},
                                      .thickness = {0.5, 12},
                                      .index = {1.4, 1.9},
                                      .object = {200, 1e5},
                                      .planes = 0.1,
                                      .air = 0.5,
                                      .far = 0.7,
                                      .conics = 0.2,
                                      .aspheres = 0.15,
                                      .height = 10};
    struct error error = {0};
    drawn_lens_draw(trial, &scale, &drawn);
    drawn.clear[drawn.stop] = 2 * radius;
    if (is_clipped) {
        image_trial_clip(trial, radius, &drawn);
    }
    const bool far = strcmp(drawn.object, "0") == 0;
    const char *surfaces = drawn_lens_write(&drawn, &trial->arena);
    char *text = arena_array(&trial->arena, strlen(surfaces) + 200, 1);
    sprintf(text, "wavelength d\naperture stop\nfield %s 0 %.6g\n%s", far ? "angle" : "height",
            trial_between(trial, 0, far ? 12 : 30), surfaces);
    trial->about = text;
    const struct setup_question question = {.lens = &one->lens,
                                            .wavelength = (double)NAN,
                                            .fnumber = (double)NAN,
                                            .field_policy = FIELDS_ALL};
    const struct plane_value plane = {.kind = trial_chance(trial, 0.5) ? PLANE_PARAXIAL : PLANE_AT,
                                      .distance = trial_between(trial, 5, 100)};
    return lens_read("stress", text_of(text), NULL, &trial->arena, &one->lens, &error) &&
           setup_open(&question, &trial->arena, &one->setup, &error) &&
           setup_place_image(&one->setup, &plane, &error);
}

void image_legendre(int count, double *x, double *w)
{
    for (int i = 0; i < count; i++) {
        double t = cos(acos(-1) * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int turn = 0; turn < 60; turn++) {
            double before = 1, here = t;
            for (int k = 2; k <= count; k++) {
                const double next = ((2 * k - 1) * t * here - (k - 1) * before) / k;
                before = here;
                here = next;
            }
            slope = count * (t * here - before) / (t * t - 1);
            t -= here / slope;
        }
        x[i] = (1 - t) / 2;
        w[i] = 1 / ((1 - t * t) * slope * slope);
    }
}

void image_aim_closer(const struct aim *aim, const struct pupil_point *points, size_t count,
                      const struct rays *rays, struct arena *arena)
{
    const struct system *open = aim->system;
    const struct rays there = rays_new(arena, count);
    const double *m = aim->slope, det = m[0] * m[3] - m[1] * m[2];
    for (int turn = 0; turn < 4; turn++) {
        memcpy(there.blocks, rays->blocks, rays_blocks(rays) * sizeof *rays->blocks);
        rays_trace_part(open, 0, system_place(open, open->stop) + 1, &there, NULL);
        for (size_t i = 0; i < count; i++) {
            const struct ray start = rays_get(rays, i, open->index_first);
            const struct ray_block *block = &there.blocks[i / RAYS_BLOCK];
            const double x = points[i].x * aim->stop_radius - block->x[i % RAYS_BLOCK];
            const double y = points[i].y * aim->stop_radius - block->y[i % RAYS_BLOCK];
            double at[2];
            beam_place(&aim->beam, start.point, at);
            const struct ray next = beam_ray(&aim->beam, at[0] + (m[3] * x - m[1] * y) / det,
                                             at[1] + (m[0] * y - m[2] * x) / det);
            rays_set(rays, i, open->index_first, &next);
        }
    }
}
