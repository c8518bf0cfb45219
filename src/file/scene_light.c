/* file/scene_light.c - lights of a scene: sun, sky, points, environments, stars. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "base/turns.h"
#include "file/scene_reader.h"
#include "light/illuminant.h"

#include <math.h>

/* As the sun is seen from the mean distance of the earth. */
#define SUN_DIAMETER (0.533 * RADIANS_PER_DEGREE)

#define WAYS (SCENE_BIT(KEY_TOWARDS) | SCENE_BIT(KEY_ELEVATION) | SCENE_BIT(KEY_AZIMUTH))
#define HUE  SCENE_BIT(KEY_SPECTRUM)

static const struct kind {
    const char *word;
    enum scene_light_kind kind;
    struct scene_keys keys;
} kinds[] = {
    {"sun",
     LIGHT_SUN,
     {WAYS | HUE | SCENE_BIT(KEY_ILLUMINANCE) | SCENE_BIT(KEY_DIAMETER),
      SCENE_BIT(KEY_ILLUMINANCE)}},
    {"sky", LIGHT_SKY, {WAYS | HUE | SCENE_BIT(KEY_LUMINANCE), SCENE_BIT(KEY_LUMINANCE)}},
    {"point",
     LIGHT_POINT,
     {HUE | SCENE_BIT(KEY_AT) | SCENE_BIT(KEY_MOVE) | SCENE_BIT(KEY_INTENSITY) |
          SCENE_BIT(KEY_POWER),
      SCENE_BIT(KEY_AT)}},
    {"environment",
     LIGHT_ENVIRONMENT,
     {SCENE_BIT(KEY_FILE) | SCENE_BIT(KEY_LUMINANCE) | SCENE_BIT(KEY_AZIMUTH),
      SCENE_BIT(KEY_FILE) | SCENE_BIT(KEY_LUMINANCE)}},
    {"star",
     LIGHT_STAR,
     {WAYS | HUE | SCENE_BIT(KEY_ILLUMINANCE) | SCENE_BIT(KEY_MAGNITUDE) | SCENE_BIT(KEY_DIAMETER),
      0}},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const char *const skies[] = {
    [SKY_UNIFORM] = "uniform", [SKY_OVERCAST] = "overcast", [SKY_CLEAR] = "clear"};
enum { SKIES = sizeof skies / sizeof skies[0] };

/* Towards a light far away. Azimuths go from -z over +x, elevations from the horizon up. */
static bool read_direction(const struct scene_line *line, struct vector *way)
{
    const uint64_t angles = SCENE_BIT(KEY_ELEVATION) | SCENE_BIT(KEY_AZIMUTH);
    double up, along, east, north;
    if (scene_line_has(line, KEY_TOWARDS)) {
        return (line->given & angles) == 0
                   ? scene_line_direction(line, KEY_TOWARDS, way)
                   : scene_line_fail(line, KEY_TOWARDS,
                                     "a direction is towards=, or elevation= and azimuth=");
    }
    if ((line->given & angles) != angles) {
        return file_words_fail(line->words, line->head,
                               "'%.*s' lacks a direction: towards=, or elevation= and azimuth=",
                               text_shown(line->head), line->head.start);
    }
    turns_of(line->number[KEY_ELEVATION][0] / (2 * PI), &along, &up);
    turns_of(line->number[KEY_AZIMUTH][0] / (2 * PI), &north, &east);
    *way = vector_unit((struct vector){along * east, up, -along * north});
    return true;
}

/* One of two ways to say how much light there is. */
static bool scene_light_choose(const struct scene_line *line, enum scene_key one,
                               enum scene_key other, const char *words)
{
    return scene_line_has(line, one) != scene_line_has(line, other) ||
           file_words_fail(line->words, line->head, "'%.*s' needs %s: one of them",
                           text_shown(line->head), line->head.start, words);
}

static bool read_sun(struct scene_reader *reader, const struct scene_line *line,
                     struct scene_light *light)
{
    (void)reader;
    light->amount = line->number[KEY_ILLUMINANCE][0];
    light->diameter =
        scene_line_has(line, KEY_DIAMETER) ? line->number[KEY_DIAMETER][0] : SUN_DIAMETER;
    return read_direction(line, &light->direction);
}

static bool read_star(struct scene_reader *reader, const struct scene_line *line,
                      struct scene_light *light)
{
    (void)reader;
    light->amount = scene_line_has(line, KEY_MAGNITUDE)
                        ? illuminant_star(line->number[KEY_MAGNITUDE][0])
                        : line->number[KEY_ILLUMINANCE][0];
    light->diameter = scene_line_has(line, KEY_DIAMETER) ? line->number[KEY_DIAMETER][0] : NAN;
    return scene_light_choose(line, KEY_MAGNITUDE, KEY_ILLUMINANCE, "magnitude= or illuminance=") &&
           read_direction(line, &light->direction);
}

/* The place of the sun in a clear sky may stand in the sun's own line. */
static bool read_sky(struct scene_reader *reader, const struct scene_line *line,
                     struct scene_light *light)
{
    light->amount = line->number[KEY_LUMINANCE][0];
    if ((line->given & WAYS) == 0) {
        if (light->sky == SKY_CLEAR && reader->sunless.start == NULL) {
            reader->sunless = line->head;
            reader->sunless_words = reader->words;
        }
        return true;
    }
    if (light->sky != SKY_CLEAR) {
        return file_words_fail(line->words, line->head,
                               "only a clear sky has a direction: that of the sun in it");
    }
    return read_direction(line, &light->direction);
}

static bool read_lamp(struct scene_reader *reader, const struct scene_line *line,
                      struct scene_light *light)
{
    (void)reader;
    light->amount = scene_line_has(line, KEY_POWER) ? line->number[KEY_POWER][0] / (4 * PI)
                                                    : line->number[KEY_INTENSITY][0];
    light->at = scene_line_vector(line, KEY_AT);
    light->velocity = scene_line_vector(line, KEY_MOVE);
    return scene_light_choose(line, KEY_INTENSITY, KEY_POWER, "intensity= or power=");
}

static bool read_surroundings(struct scene_reader *reader, const struct scene_line *line,
                              struct scene_light *light)
{
    light->amount = line->number[KEY_LUMINANCE][0];
    light->turn = -line->number[KEY_AZIMUTH][0];
    struct scene_loaded picture;
    if (!scene_load_picture(reader, line, KEY_FILE, PICTURE_OF_LIGHT, &picture)) {
        return false;
    }
    light->picture = picture.image;
    light->mean = picture.mean;
    return light->picture->width == 2 * light->picture->height ||
           scene_line_fail(line, KEY_FILE,
                           "a picture of all directions is twice as wide as high, and this one is "
                           "%zu x %zu",
                           light->picture->width, light->picture->height);
}

static bool read_light_kind(struct scene_reader *reader, size_t *kind, enum scene_sky *sky)
{
    struct file_words *words = &reader->words;
    struct text word = file_words_next(words);
    struct nearest nearest = {.typed = word};
    for (*kind = 0; *kind < KINDS && !text_equal(word, kinds[*kind].word); ++*kind) {
        nearest_offer(&nearest, text_of(kinds[*kind].word));
    }
    if (*kind == KINDS) {
        return scene_word_fail(words, word, &nearest,
                               "a light is sun, sky, point, environment or star, not");
    }
    if (kinds[*kind].kind != LIGHT_SKY) {
        return true;
    }
    word = file_words_next(words);
    for (size_t i = 0; i < SKIES; i++) {
        if (text_equal(word, skies[i])) {
            *sky = (enum scene_sky)i;
            return true;
        }
    }
    return file_words_fail(words, word, "a sky is uniform, overcast or clear");
}

bool scene_light_read(struct scene_reader *reader, struct text head)
{
    static bool (*const readers[])(struct scene_reader * reader, const struct scene_line *line,
                                   struct scene_light *light) = {
        [LIGHT_SUN] = read_sun,    [LIGHT_SKY] = read_sky,
        [LIGHT_POINT] = read_lamp, [LIGHT_ENVIRONMENT] = read_surroundings,
        [LIGHT_STAR] = read_star,
    };
    struct scene *scene = reader->scene;
    struct file_words *words = &reader->words;
    struct scene_light light = {.place = file_words_place(words, head)};
    struct scene_line line;
    size_t kind;
    if (scene->light_count == SCENE_LIGHTS_MOST) {
        return file_words_fail(words, head, "more than %d lights", SCENE_LIGHTS_MOST);
    }
    if (!read_light_kind(reader, &kind, &light.sky) ||
        !scene_line_read(words, &reader->units, text_between(head.start, words->at),
                         kinds[kind].keys, &line)) {
        return false;
    }
    light.kind = kinds[kind].kind;
    if (!scene_colour_of(reader, &line, KEY_SPECTRUM, COLOUR_OF_LIGHT, &light.spectrum) ||
        !readers[light.kind](reader, &line, &light)) {
        return false;
    }
    *ARENA_ADD(words->arena, scene->lights, scene->light_count, reader->light_room) = light;
    return true;
}

bool scene_lights_finish(struct scene_reader *reader)
{
    const struct scene *scene = reader->scene;
    const struct scene_light *sun = NULL;
    size_t suns = 0;
    if (reader->sunless.start == NULL) {
        return true;
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].kind == LIGHT_SUN) {
            sun = &scene->lights[i];
            suns++;
        }
    }
    if (suns != 1) {
        return file_words_fail(&reader->sunless_words, reader->sunless,
                               "a clear sky needs the direction of the sun: towards=, or "
                               "elevation= and azimuth=, or one line 'light sun', not %zu",
                               suns);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        struct scene_light *light = &scene->lights[i];
        if (light->kind == LIGHT_SKY && light->sky == SKY_CLEAR &&
            !(vector_length(light->direction) > 0)) {
            light->direction = sun->direction;
        }
    }
    return true;
}
