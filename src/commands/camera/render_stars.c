/* commands/camera/render_stars.c - stars that do not say how wide they are. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "commands/camera/render_world.h"

/* Far below a pixel of any picture, and nearly all around. */
#define LEAST (1e-5 * RADIANS_PER_DEGREE)
#define MOST  (177 * RADIANS_PER_DEGREE)

static bool lacks_diameter(const struct scene_light *light)
{
    return light->kind == LIGHT_STAR && isnan(light->diameter);
}

static size_t count_stars(const struct scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        count += lacks_diameter(&scene->lights[i]) ? 1 : 0;
    }
    return count;
}

/* How wide a pixel of the whole picture is as the lens sees it; 0: that has no angle. */
static double pixel_angle(const struct photograph_question *question, const struct lens_film *film,
                          struct arena *arena)
{
    struct film_samples *samples = ARENA_NEW(arena, struct film_samples);
    struct rays rays = rays_new(arena, RAYS_BLOCK);
    const double sides[2][2] = {{question->film.width / (double)question->columns, 0},
                                {0, question->film.height / (double)question->rows}};
    double angle = 0; /* fmax leaves out what is NaN */
    for (int i = 0; i < 2; i++) {
        angle = fmax(angle, lens_film_angle(film, sides[i], samples, &rays));
    }
    return angle;
}

bool render_open_stars(const struct photograph_question *question, struct arena *arena,
                       struct render_world *world, struct error *error)
{
    struct scene *scene = &world->scene;
    world->stars = (struct render_stars){.diameter = NAN};
    if (count_stars(scene) == 0) {
        return true;
    }
    struct lens_film *film = ARENA_NEW(arena, struct lens_film);
    if (!lens_film_open(&question->film, arena, film, error)) {
        return false;
    }
    const double angle = pixel_angle(question, film, arena);
    const bool is_angle = angle >= LEAST;
    world->stars = (struct render_stars){is_angle ? fmin(angle, MOST) : RADIANS_PER_DEGREE / 60,
                                         is_angle && angle <= MOST};
    for (size_t i = 0; i < scene->light_count; i++) {
        if (lacks_diameter(&scene->lights[i])) {
            scene->lights[i].diameter = world->stars.diameter;
        }
    }
    return true;
}

const char *render_stars_text(const struct render_world *world, struct arena *arena)
{
    return isnan(world->stars.diameter)
               ? NULL
               : arena_printf(arena, "discs of %s%.4g arcmin",
                              world->stars.are_a_pixel ? "one pixel, " : "",
                              60 * DEGREES_PER_RADIAN * world->stars.diameter);
}
