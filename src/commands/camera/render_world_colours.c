/* commands/camera/render_world_colours.c - colours of a scene that sRGB does not hold. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_world.h"

enum { SAID_MOST = 3 }; /* each by itself; of more how many */

/* What is said so far. */
struct saying {
    struct growing *remarks;
    size_t count;
};

/* Less than half a percent is within what tables and observers differ by. */
static void say(struct saying *saying, const struct typed_place *place, const char *what,
                const struct banded *banded)
{
    if (banded != NULL && banded->held < 0.995 && saying->count++ < SAID_MOST) {
        growing_format(saying->remarks,
                       "%s:%ld: a %s is more saturated than sRGB can be: %.0f %% of its distance "
                       "from %s is kept; --spectral keeps all of it\n",
                       place->source, place->line, what, 100 * banded->held,
                       what[0] == 'l' ? "white" : "grey");
    }
}

void render_say_colours(const struct render_world *world, struct growing *remarks)
{
    struct saying saying = {remarks, 0};
    const struct scene *scene = &world->scene;
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct material *material = &world->lights.materials.of[i];
        say(&saying, &scene->materials[i].place, "surface", material->colour);
        say(&saying, &scene->materials[i].place, "light", material->light);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        say(&saying, &scene->lights[i].place, "light", world->lights.units[i]);
    }
    if (saying.count > SAID_MOST) {
        growing_format(remarks, "%zu more of the scene's colours likewise\n",
                       saying.count - SAID_MOST);
    }
}
