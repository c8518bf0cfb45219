/* commands/camera/render_world_colours.c - colours of a scene that sRGB does not hold. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_world.h"

enum { SAID_MOST = 3 }; /* each by itself; of more how many */

/* What is said so far. */
struct saying {
    const struct bands *bands;
    struct growing *remarks;
    size_t count;
};

/* Less than half a percent is within what tables and observers differ by. */
static void say(struct saying *saying, const struct typed_place *place, const char *what,
                double held)
{
    if (held < 0.995 && saying->count++ < SAID_MOST) {
        growing_format(saying->remarks,
                       "%s:%ld: a %s is more saturated than sRGB can be: %.0f %% of its distance "
                       "from %s is kept; --spectral keeps all of it\n",
                       place->source, place->line, what, 100 * held,
                       what[0] == 'l' ? "white" : "grey");
    }
}

static void say_light(struct saying *saying, const struct typed_place *place,
                      const struct spectrum *light)
{
    if (light->kind != SPECTRUM_NONE && light->kind != SPECTRUM_RGB) {
        say(saying, place, "light", bands_hold_light(saying->bands, light));
    }
}

void render_say_colours(const struct render_world *world, struct growing *remarks)
{
    struct saying saying = {&world->bands, remarks, 0};
    const struct scene *scene = &world->scene;
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct scene_material *material = &scene->materials[i];
        say(&saying, &material->place, "surface",
            bands_hold_surface(saying.bands, &material->colour));
        say_light(&saying, &material->place, &material->emission);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        say_light(&saying, &scene->lights[i].place, &scene->lights[i].spectrum);
    }
    if (saying.count > SAID_MOST) {
        growing_format(remarks, "%zu more of the scene's colours likewise\n",
                       saying.count - SAID_MOST);
    }
}
