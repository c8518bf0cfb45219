/* camera/photograph/light_paths.h - light tracing: rays from small emitters through the lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_LIGHT_PATHS_H
#define LENSCALC_CAMERA_PHOTOGRAPH_LIGHT_PATHS_H

#include "camera/photograph/tile_rays.h"
#include "camera/photograph/tiling.h"

#include <stdint.h>

struct lamp;

/* Small emitters, whose light goes to the film by rays of its own. */
struct light_paths {
    struct lamp *lamps;
    size_t count;
    size_t blocks;                  /* of rays that they send, in each wavelength */
    const struct ray_model *models; /* of the lens, towards the film, as rays' passes */
    bool is_ideal;                  /* struct lamps */
    struct path path; /* of the view that rays from the film have: without these emitters */
    struct view view;
    /* Illuminance of the crop, lx, by pixel and channel in steps of `step`: sums of integers do not
       depend on their order, and so not on the threads */
    struct tile_grid tiling;
    _Atomic uint64_t *sums;
    _Atomic uint64_t *halves; /* the same of the first half of each lamp's rays; null: not asked */
    double step;
};

/*
 * Find the emitters that rays from the film rarely meet, and the lamps that they send to the film.
 *
 * Given     rays    of the picture; their subject is a scene
 *           error   as photograph_question has it; 0: none
 * Result    no sums yet; light->count 0: there are no such emitters, and nothing is to be done
 * Formula   suns, stars, and spheres, discs, cards and boxes of one material. Of each a grid of
 *           rays to the plane of the entrance pupil, or of the first vertex if that is nearer the
 *           emitter, from its middle and from its ends at several times, narrows the rectangle
 *           through which its light comes to the film, three times, and leaves a cell around. It
 *           counts as small where fewer than a quarter of the rays from the film meet it, over the
 *           area of its image. It sends 8 rays for each of its image's pixels and each of the
 *           samples; of an error e no more than for (0.56/e)^(5/3) samples, by the noise that was
 *           measured within discs, 0.28 samples^-0.6
 * Limits    left to rays from the film: lamps that are meshes or pictures, what is nearer than that
 *           plane, lenses that are telecentric in the scene, pinholes, ideal lenses with
 *           distortion or between real ones
 */
bool light_paths_open(const struct photograph_question *question, const struct tile_rays *rays,
                      struct tile_scratch *scratch, struct arena *arena, struct light_paths *light,
                      struct error *error);

/*
 * Send them.
 *
 * Result    sums. Of an emitter that is in the picture the light that comes straight to the film,
 *           which `light->view` leaves out
 * Formula   Phi = L cos(theta) dA dw of points of the rectangle and directions to the emitter,
 *           whose light goes through the whole lens and is added to the pixel that it meets, over
 *           its area. Phi is the same on both sides of the lens, so that no index is in it; points
 *           are a scrambled Sobol' sequence, those of the rectangle its first two dimensions
 * Source    [Veach97] section 10.3.4 (paths from a light, connected to the lens)
 */
void light_paths_send(const struct photograph_question *question, const struct tile_rays *rays,
                      struct arena *arena, struct light_paths *light);

/* What they bring to a pixel of the crop, lx; and what half of them tells of that. */
double light_paths_at(const struct light_paths *light, size_t pixel, size_t channel);
double light_paths_half_at(const struct light_paths *light, size_t pixel, size_t channel);

#endif
