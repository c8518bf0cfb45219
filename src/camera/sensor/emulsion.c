/* camera/sensor/emulsion.c - densities of a negative, pixel by pixel. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/emulsion.h"

#include "base/normal.h"
#include "base/parallel.h"
#include "base/random.h"

#include <math.h>

/* that a thread takes at once */
enum { ROWS = 4 };

static double density_of(const struct emulsion *film, double H, uint64_t pixel)
{
    const double density = characteristic_density(&film->curve, H);
    if (!(film->granularity > 0)) {
        return density;
    }
    const struct random_words words = random_words(RANDOM_GRAIN, film->seed, pixel, 0);
    const double deviation =
        characteristic_grain(&film->curve, film->granularity, film->pitch * film->pitch, density);
    return fmax(0, density + deviation * normal_quantile(random_unit_of(words.w[0], words.w[1])));
}

/* What emulsion_expose has in common for all rows. */
struct emulsion_job {
    const struct emulsion *film;
    const struct image *light;
    const struct sensor_place *place;
    const struct image *density; /* receives densities */
};

static void emulsion_expose_rows(void *context, size_t begin, size_t end)
{
    const struct emulsion_job *exposing = context;
    const struct sensor_place *place = exposing->place;
    const struct image *light = exposing->light;
    for (size_t y = begin; y < end; y++) {
        const uint64_t row = (uint64_t)(place->row + y) * place->width + place->column;
        for (size_t x = 0; x < light->width; x++) {
            const float *pixel = image_row(light, y) + x * light->channels;
            const double H = sensor_luminous(pixel, light->channels);
            image_row(exposing->density, y)[x] = (float)density_of(exposing->film, H, row + x);
        }
    }
}

bool emulsion_expose(const struct emulsion *film, const struct image *light,
                     const struct sensor_place *place, struct arena *arena, struct image *density,
                     struct error *error)
{
    *density = (struct image){.width = light->width, .height = light->height, .channels = 1};
    if (!sensor_check_light(light, error) || !image_new(density, arena, error)) {
        return false;
    }
    struct emulsion_job exposing = {film, light, place, density};
    parallel_for(film->threads, light->height, ROWS, emulsion_expose_rows, &exposing);
    return true;
}

void emulsion_print(const struct emulsion *film, struct image *density)
{
    for (size_t i = 0; i < density->width * density->height; i++) {
        const double light = characteristic_print(&film->curve, (double)density->pixels[i]);
        density->pixels[i] = (float)light;
    }
}
