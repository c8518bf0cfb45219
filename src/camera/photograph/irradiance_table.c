/* camera/photograph/irradiance_table.c - the light on a film, told by a few rays once. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/irradiance_table.h"

#include "camera/photograph/tiling.h"

#include <math.h>

enum { ROWS = 65 };

struct irradiance_table {
    double largest;       /* distance from the axis up to which light arrives, mm */
    double (*rows)[ROWS]; /* E/L by pass, sr */
};

const struct irradiance_table *irradiance_table_new(const struct lens_film *film, size_t passes,
                                                    size_t blocks, struct arena *arena)
{
    struct irradiance_table *light = ARENA_NEW(arena, struct irradiance_table);
    struct film_samples *samples = ARENA_NEW(arena, struct film_samples);
    const struct rays rays = rays_new(arena, RAYS_BLOCK);
    struct lens_film aimed = *film;
    aimed.start = film->aim;
    light->largest = film->region.largest;
    light->rows = arena_array(arena, passes, sizeof *light->rows);
    for (size_t w = 0; w < passes; w++) {
        for (int i = 0; i < ROWS; i++) {
            const double left = 1 - i / (ROWS - 1.0);
            const double at[2] = {0, light->largest * (1 - left * left)};
            light->rows[w][i] = lens_film_light(&aimed, at, w, blocks, samples, &rays);
        }
    }
    return light;
}

static double irradiance_table_at(const struct irradiance_table *light, size_t wavelength, double x,
                                  double y)
{
    const double share = 1 - fmin(1, hypot(x, y) / light->largest);
    const double place = (ROWS - 1) * (1 - sqrt(share));
    const int row = (int)fmin(place, ROWS - 2);
    const double *rows = light->rows[wavelength] + row;
    return rows[0] + (place - row) * (rows[1] - rows[0]);
}

double irradiance_table_of(const struct irradiance_table *light, size_t wavelength,
                           const struct film_plan *plan, size_t pixel)
{
    const double across = plan->width / TILE_ACROSS, down = plan->height / TILE_DOWN;
    const double x = plan->left + plan->width - ((double)(pixel % TILE_ACROSS) + 0.5) * across;
    const double y = plan->bottom + ((double)(pixel / TILE_ACROSS) + 0.5) * down;
    const double dx = across / sqrt(12), dy = down / sqrt(12);
    return (irradiance_table_at(light, wavelength, x - dx, y - dy) +
            irradiance_table_at(light, wavelength, x + dx, y - dy) +
            irradiance_table_at(light, wavelength, x - dx, y + dy) +
            irradiance_table_at(light, wavelength, x + dx, y + dy)) /
           4;
}
