/* camera/film/outline_rays.c - directions of the film's side, and the beam from a point of it. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/outline_rays.h"

#include <math.h>

static void to_beam(const struct outline_rays *sight, struct pupil_outline_point way, double at[2])
{
    const struct film_place *place = &sight->place;
    const double film = sight->lens->film, size2 = way.x * way.x + way.y * way.y;
    /* a guess may lie beyond all directions */
    const double left2 = 1 + sight->tangent * size2 - size2;
    const double far = fabs(film) / sqrt(fmax(left2, 1e-12));
    const double x = way.x * place->up[1] + way.y * place->up[0];
    const double y = way.y * place->up[1] - way.x * place->up[0];
    beam_place(&sight->beam, (double[3]){place->x + far * x, place->y + far * y, 0}, at);
}

void outline_rays_to_disc(const struct outline_rays *sight, struct pupil_outline_point way,
                          double uv[2])
{
    const struct stop_beam *disc = &sight->disc;
    double at[2];
    to_beam(sight, way, at);
    for (int k = 0; k < 2; k++) {
        uv[k] = (at[k] - disc->origin[k]) / disc->axes[3 * k];
    }
}

struct pupil_outline_point outline_rays_from_disc(const struct outline_rays *sight,
                                                  const double uv[2])
{
    const double *up = sight->place.up;
    double at[2];
    stop_beam_place(&sight->disc, uv[0], uv[1], at);
    const struct ray ray = beam_ray(&sight->beam, at[0], at[1]);
    const double x = ray.cosine[0] * up[1] - ray.cosine[1] * up[0];
    const double y = ray.cosine[0] * up[0] + ray.cosine[1] * up[1];
    const double left2 = fmax(1 - sight->tangent * (x * x + y * y), 1e-12);
    return (struct pupil_outline_point){x / sqrt(left2), y / sqrt(left2)};
}

void outline_rays_open(const struct pupil_outline_search *search, size_t wavelength,
                       const struct pupil_outline *about, double widths, struct outline_rays *sight)
{
    const struct film_lens *lens = search->lens;
    const struct system *system = lens->systems[wavelength];
    const struct pupil_outline_point centre = about->centre, size = about->size;
    double right[2], up[2];
    sight->lens = lens;
    sight->tangent = search->tangent;
    sight->place = about->place;
    sight->beam = beam_to_pupil((double[3]){about->place.x, about->place.y, lens->film},
                                lens->first->exit_pupil, system->index_first);
    sight->disc = (struct stop_beam){
        .system = system, .beam = &sight->beam, .radius = NAN, .weight = WEIGHT_BEAM};
    const double *middle = sight->disc.origin;
    to_beam(sight, centre, sight->disc.origin);
    to_beam(sight, (struct pupil_outline_point){centre.x + size.x, centre.y}, right);
    to_beam(sight, (struct pupil_outline_point){centre.x, centre.y + size.y}, up);
    const double radius = widths * fmax(hypot(right[0] - middle[0], right[1] - middle[1]),
                                        hypot(up[0] - middle[0], up[1] - middle[1]));
    sight->disc.axes[0] = sight->disc.axes[3] = radius;
    sight->frame = (struct edge_frame){.stretch = {1 / widths, 1 / widths}};
    sight->margins = clearances_open(&sight->disc, search->arena);
    sight->probe = probe_open(system, &sight->beam, search->arena);
}
