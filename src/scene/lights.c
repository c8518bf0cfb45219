/* scene/lights.c - all lights of a scene: sampled together, with their pdf. */
/* SPDX-License-Identifier: MIT */
#include "scene/lights.h"

#include "base/constants.h"
#include "scene/discrete.h"
#include "scene/texture.h"

static bool open_units(struct lights *lights, struct spectra *spectra, struct error *error)
{
    const struct scene *scene = lights->scene;
    lights->units = ARENA_ARRAY(spectra->arena, scene->light_count, const struct banded *);
    for (size_t i = 0; i < scene->light_count; i++) {
        const struct scene_light *light = &scene->lights[i];
        if (light->amount > 0) {
            lights->units[i] = spectra_light(spectra, &light->spectrum, &light->place, error);
            if (lights->units[i] == NULL) {
                return false;
            }
        }
    }
    return true;
}

static void open_arounds(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        count += is_environment_light(&scene->lights[i]) ? 1 : 0;
    }
    lights->environments = ARENA_ARRAY(arena, count, struct environment_light);
    lights->environment_below = ARENA_ARRAY(arena, count + 1, double);
    for (size_t i = 0; i < scene->light_count; i++) {
        struct environment_light *around = &lights->environments[lights->environment_count];
        double *below = &lights->environment_below[lights->environment_count];
        if (is_environment_light(&scene->lights[i])) {
            *around = environment_light_open(&scene->lights[i], lights->units[i], arena);
            below[1] = below[0] + around->total;
            lights->environment_count++;
        }
    }
}

/* -------- things that shine -------- */

/* In the mean over it. */
static double thing_luminance(const struct scene *scene, const struct scene_thing *thing)
{
    return thing->picture != NULL ? thing->luminance * thing->mean
                                  : scene->materials[thing->material].luminance;
}

static void open_planes(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    lights->planes = ARENA_ARRAY(arena, scene->thing_count, size_t);
    lights->plane_below = ARENA_ARRAY(arena, scene->thing_count + 1, double);
    for (size_t i = 0; i < scene->thing_count; i++) {
        if (scene->things[i].shape == SHAPE_PLANE && materials_shines(&lights->materials, i)) {
            const size_t number = lights->plane_count++;
            lights->first[i] = number;
            lights->planes[number] = i;
            lights->plane_below[number + 1] =
                lights->plane_below[number] + thing_luminance(scene, &scene->things[i]);
        }
    }
}

static bool is_emitter(const struct lights *lights, size_t thing)
{
    return lights->scene->things[thing].shape != SHAPE_PLANE &&
           materials_shines(&lights->materials, thing);
}

/* Points that give no light are none. */
static bool is_point(const struct lights *lights, size_t light)
{
    return lights->scene->lights[light].kind == LIGHT_POINT && lights->units[light] != NULL;
}

static void open_emitters(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    struct arena spare = arena_within(arena);
    size_t room = 0, count = 0;
    for (size_t i = 0; i < scene->thing_count; i++) {
        room += is_emitter(lights, i) ? emitter_parts(&scene->things[i]) : 0;
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        room += is_point(lights, i);
    }
    struct emitter *emitters = ARENA_ARRAY(&spare, room, struct emitter);
    double *power = ARENA_ARRAY(&spare, room, double);
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        if (is_emitter(lights, i)) {
            const size_t parts = emitter_parts(thing);
            const double luminance = thing_luminance(scene, thing);
            lights->first[i] = count;
            for (size_t part = 0; part < parts; part++, count++) {
                emitters[count] = (struct emitter){i, part};
                power[count] = luminance * emitter_bounds(scene, &emitters[count]).area;
            }
        }
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        if (is_point(lights, i)) {
            emitters[count] = (struct emitter){SCENE_NONE, i};
            power[count++] = scene->lights[i].amount * MM2_PER_M2;
        }
    }
    light_tree_open(scene, emitters, power, count, arena, &lights->tree);
    arena_free(&spare);
}

bool lights_open(const struct scene *scene, const struct bands *bands, struct arena *arena,
                 struct lights *lights, struct error *error)
{
    struct spectra spectra = {.bands = bands, .arena = arena};
    *lights = (struct lights){.scene = scene, .bands = bands};
    if (!materials_open(scene, &spectra, &lights->materials, error) ||
        !open_units(lights, &spectra, error)) {
        return false;
    }
    distant_lights_open(scene, lights->units, arena, &lights->distant);
    open_arounds(lights, arena);
    lights->first = ARENA_ARRAY(arena, scene->thing_count, size_t);
    for (size_t i = 0; i < scene->thing_count; i++) {
        lights->first[i] = SCENE_NONE;
    }
    open_planes(lights, arena);
    open_emitters(lights, arena);
    return true;
}

/* -------- kinds of light -------- */

enum { OF_DISCS, OF_AROUND, OF_EMITTERS, OF_PLANES, KINDS };

/* The chances of each kind, as sums before each; false: there is no light. */
static bool light_kind_probabilities(const struct lights *lights, struct vector from,
                                     double below[KINDS + 1])
{
    double of[KINDS], all = 0;
    int there = 0;
    /* How much light each kind gives a point, roughly: luminance times solid angle, lx. */
    of[OF_DISCS] = lights->distant.total;
    of[OF_AROUND] = lights->environment_below[lights->environment_count];
    of[OF_EMITTERS] = light_tree_importance(&lights->tree, from);
    of[OF_PLANES] = 2 * PI * lights->plane_below[lights->plane_count];
    for (int i = 0; i < KINDS; i++) {
        all += of[i];
        there += of[i] > 0 ? 1 : 0;
    }
    below[0] = 0;
    for (int i = 0; i < KINDS; i++) {
        below[i + 1] = below[i] + (of[i] > 0 ? 0.5 * of[i] / all + 0.5 / there : 0);
    }
    return there > 0;
}

static double chance_of(const double below[KINDS + 1], int kind)
{
    return (below[kind + 1] - below[kind]) / below[KINDS];
}

/* -------- behind everything -------- */

static double background_pdf(const struct lights *lights, const double below[KINDS + 1],
                             struct vector direction)
{
    double pdf = chance_of(below, OF_DISCS) * distant_lights_pdf(&lights->distant, direction);
    const double all = lights->environment_below[lights->environment_count];
    for (size_t i = 0; i < lights->environment_count; i++) {
        const struct environment_light *around = &lights->environments[i];
        pdf += around->total > 0 ? chance_of(below, OF_AROUND) * around->total / all *
                                       environment_light_pdf(around, direction)
                                 : 0;
    }
    return pdf;
}

void lights_background(const struct lights *lights, struct vector direction,
                       const struct lanes *lanes, struct radiance *light)
{
    *light = (struct radiance){{0}};
    distant_lights_add(&lights->distant, direction, lanes, light);
    for (size_t i = 0; i < lights->environment_count; i++) {
        environment_light_add(&lights->environments[i], lights->bands, direction, lanes, light);
    }
}

static void sample_background(const struct lights *lights, const double below[KINDS + 1],
                              struct vector direction, const struct lanes *lanes,
                              struct light_sample *sample)
{
    sample->direction = direction;
    sample->distance = (double)INFINITY;
    sample->pdf = background_pdf(lights, below, direction);
    lights_background(lights, direction, lanes, &sample->light);
}

static struct vector around_way(const struct lights *lights, const double u[3])
{
    const struct discrete_sample pick =
        discrete_sample_of(lights->environment_below, lights->environment_count, u[0]);
    return environment_light_sample(&lights->environments[pick.index], u[1], u[2]);
}

/* -------- emitters -------- */

/* What of a card is not there does not shine. */
static double share_there(const struct scene_thing *thing, const double place[2])
{
    double of[TEXTURE_CHANNELS] = {[TEXTURE_ALPHA] = 1};
    if (thing->picture != NULL) {
        texture_lookup(thing->picture, place, TEXTURE_ENDS, of);
    }
    return of[TEXTURE_ALPHA];
}

static bool sample_emitter(const struct lights *lights, struct vector from, double time,
                           const double u[3], const struct lanes *lanes,
                           struct light_sample *sample)
{
    double rest = u[0], chance;
    const size_t leaf = light_tree_sample(&lights->tree, from, &rest, &chance);
    const struct emitter *emitter = &lights->tree.emitters[leaf];
    if (!(chance > 0)) {
        return false;
    }
    if (emitter->thing == SCENE_NONE) {
        sample->pdf = chance;
        /* a point, and whether it is not just here */
        const size_t which = emitter->part;
        const struct scene_light *light = &lights->scene->lights[which];
        const struct vector to = vector_minus(vector_along(light->at, time, light->velocity), from);
        const double square = vector_dot(to, to);
        sample->is_point = true;
        sample->distance = sqrt(square);
        sample->direction = vector_times(1 / sample->distance, to);
        for (size_t k = 0; k < lanes->count; k++) {
            sample->light.of[k] =
                light->amount * MM2_PER_M2 / square * lights->units[which]->of[lanes->band[k]];
        }
        return square > 0;
    }
    const struct scene_thing *thing = &lights->scene->things[emitter->thing];
    const struct scene_pose pose = scene_pose_at(&thing->where, time);
    struct emitter_sample ray = {.distance = 0};
    if (!emitter_sample(thing, emitter->part, &pose, from, u + 1, &ray)) {
        return false;
    }
    sample->direction = ray.direction;
    sample->distance = ray.distance;
    sample->pdf = chance * ray.pdf;
    const double there = share_there(&lights->scene->things[emitter->thing], ray.place);
    materials_shine(&lights->materials, emitter->thing, ray.place, lanes, &sample->light);
    for (size_t k = 0; k < lanes->count; k++) {
        sample->light.of[k] *= there;
    }
    return true;
}

static double met_emitter_pdf(const struct lights *lights, struct vector from,
                              struct vector direction, double time, const struct world_hit *hit)
{
    const struct scene_thing *thing = &lights->scene->things[hit->thing];
    const struct scene_pose pose = scene_pose_at(&thing->where, time);
    const size_t emitter =
        lights->first[hit->thing] + (thing->shape == SHAPE_MESH ? hit->triangle : 0);
    return light_tree_probability(&lights->tree, from, emitter) *
           emitter_pdf(thing, &pose, from, hit, direction);
}

/* -------- planes without end: evenly over all directions that meet them -------- */

static double plane_chance(const struct lights *lights, size_t number)
{
    return (lights->plane_below[number + 1] - lights->plane_below[number]) /
           lights->plane_below[lights->plane_count];
}

static bool sample_plane(const struct lights *lights, struct vector from, double time,
                         const double u[3], const struct lanes *lanes, struct light_sample *sample)
{
    static const double nowhere[2] = {0, 0};
    const struct discrete_sample pick =
        discrete_sample_of(lights->plane_below, lights->plane_count, u[0]);
    const size_t thing = lights->planes[pick.index];
    const struct scene_pose pose = scene_pose_at(&lights->scene->things[thing].where, time);
    const double above = vector_dot(pose.turned.z, vector_minus(from, pose.at));
    const double sine = sqrt(1 - u[1] * u[1]), angle = 2 * PI * u[2];
    const struct vector own = {sine * cos(angle), sine * sin(angle), above > 0 ? -u[1] : u[1]};
    sample->direction = frame_out(&pose.turned, own);
    sample->distance = fabs(above) / u[1];
    sample->pdf = plane_chance(lights, pick.index) / (2 * PI);
    materials_shine(&lights->materials, thing, nowhere, lanes, &sample->light);
    return sample->distance > 0 && sample->distance < (double)INFINITY;
}

/* -------- all of them -------- */

static bool light_sample_is_lit(const struct light_sample *sample, const struct lanes *lanes)
{
    double most = 0;
    for (size_t k = 0; k < lanes->count; k++) {
        most = fmax(most, sample->light.of[k]);
    }
    return most > 0 && sample->pdf > 0;
}

bool lights_sample(const struct lights *lights, struct vector from, double time, const double u[3],
                   const struct lanes *lanes, struct light_sample *sample)
{
    double below[KINDS + 1];
    *sample = (struct light_sample){.distance = 0};
    if (!light_kind_probabilities(lights, from, below)) {
        return false;
    }
    const struct discrete_sample kind = discrete_sample_of(below, KINDS, u[0]);
    const double chance = chance_of(below, (int)kind.index);
    const double rest[3] = {kind.remainder, u[1], u[2]};
    bool is_seen = true;
    switch (kind.index) {
    case OF_DISCS:
        sample_background(lights, below, distant_lights_sample(&lights->distant, rest), lanes,
                          sample);
        return light_sample_is_lit(sample, lanes);
    case OF_AROUND:
        sample_background(lights, below, around_way(lights, rest), lanes, sample);
        return light_sample_is_lit(sample, lanes);
    case OF_EMITTERS:
        is_seen = sample_emitter(lights, from, time, rest, lanes, sample);
        break;
    default:
        is_seen = sample_plane(lights, from, time, rest, lanes, sample);
        break;
    }
    sample->pdf *= chance;
    if (!is_seen || !light_sample_is_lit(sample, lanes)) {
        return false;
    }
    for (size_t k = 0; k < lanes->count && sample->is_point; k++) {
        sample->light.of[k] /= sample->pdf;
    }
    sample->pdf = sample->is_point ? 1 : sample->pdf;
    return true;
}

double lights_pdf(const struct lights *lights, struct vector from, struct vector direction,
                  double time, const struct world_hit *hit)
{
    double below[KINDS + 1];
    if ((hit != NULL && lights->first[hit->thing] == SCENE_NONE) ||
        !light_kind_probabilities(lights, from, below)) {
        return 0;
    }
    if (hit == NULL) {
        return background_pdf(lights, below, direction);
    }
    return lights->scene->things[hit->thing].shape == SHAPE_PLANE
               ? chance_of(below, OF_PLANES) * plane_chance(lights, lights->first[hit->thing]) /
                     (2 * PI)
               : chance_of(below, OF_EMITTERS) *
                     met_emitter_pdf(lights, from, direction, time, hit);
}
