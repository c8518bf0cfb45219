/* commands/camera/render_world_colours.c - colours of a scene that sRGB, or bands, do not hold. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_world.h"

enum { SAID_MOST = 3 }; /* each by itself; of more how many */

/* In u', v'; the eye tells twice as much apart. */
static const double seen_as_same = 0.002;

/* What is said so far. */
struct colour_remarks {
    struct text_buffer *remarks;
    size_t count;
};

/* Less than half a percent is within what tables and observers differ by. */
static void render_world_colours_say(struct colour_remarks *saying, const struct typed_place *place,
                                     const char *what, const struct banded *banded)
{
    if (banded != NULL && banded->held < 0.995 && saying->count++ < SAID_MOST) {
        growing_format(saying->remarks,
                       "%s:%ld: a %s is more saturated than sRGB can be: %.0f %% of its distance "
                       "from %s is kept; --spectral keeps more\n",
                       place->source, place->line, what, 100 * banded->held,
                       what[0] == 'l' ? "white" : "grey");
    }
}

/* Lights have spectra that are narrower than bands. */
static void say_narrow(struct colour_remarks *saying, const struct typed_place *place,
                       const struct spectrum *spectrum, const struct banded *banded)
{
    if (banded == NULL || !(banded->off > seen_as_same) || saying->count++ >= SAID_MOST) {
        return;
    }
    double off;
    const size_t needed = bands_needed(spectrum, seen_as_same, &off);
    growing_format(saying->remarks,
                   "warning: %s:%ld: a light is narrower than a band: its colour is %.2g in u', v' "
                   "from that of its spectrum",
                   place->source, place->line, banded->off);
    if (off < banded->off) {
        growing_format(saying->remarks, "; with --bands %zu %.2g", needed, off);
    }
    growing_string(saying->remarks, "\n");
}

void render_say_colours(const struct render_world *world, struct text_buffer *remarks)
{
    struct colour_remarks saying = {remarks, 0};
    const struct scene *scene = &world->scene;
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct material *material = &world->lights.materials.of[i];
        render_world_colours_say(&saying, &scene->materials[i].place, "surface", material->colour);
        render_world_colours_say(&saying, &scene->materials[i].place, "light", material->light);
        say_narrow(&saying, &scene->materials[i].place, &scene->materials[i].emission,
                   material->light);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        render_world_colours_say(&saying, &scene->lights[i].place, "light", world->lights.units[i]);
        say_narrow(&saying, &scene->lights[i].place, &scene->lights[i].spectrum,
                   world->lights.units[i]);
    }
    if (saying.count > SAID_MOST) {
        growing_format(remarks, "%zu more of the scene's colours likewise\n",
                       saying.count - SAID_MOST);
    }
}
