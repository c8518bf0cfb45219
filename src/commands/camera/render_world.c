/* commands/camera/render_world.c - scenes: read, asked for, and made ready for a lens. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render_world.h"

#include "base/constants.h"
#include "base/name_table.h"
#include "camera/photograph/tile_rays.h"
#include "camera/sensor/develop.h"
#include "camera/subject/lens_clearance.h"
#include "commands/camera/render_part.h"
#include "file/scene_file.h"
#include "photo/distance_from.h"
#include "photo/mired.h"
#include "photo/sensitometry.h"
#include "scene/scene.h"

#include <stdio.h>
#include <string.h>

/* -------- what is asked -------- */

bool render_is_world(const struct render_input *input)
{
    static const char ending[] = ".scene";
    const size_t length = input->subject != NULL ? strlen(input->subject) : 0;
    return length >= sizeof ending - 1 &&
           text_same(text_of(input->subject + length - (sizeof ending - 1)), ending);
}

/* Does the film stand where it is, whatever the lens is focused on? */
static bool is_film_fixed(const struct render_input *input)
{
    const enum plane_kind kind = input->question.focus.kind;
    return kind == PLANE_AT || kind == PLANE_TABLE;
}

static bool check_scene(const struct artifact_job *job, struct error *error)
{
    static const char *const of_cards[] = {"luminance", "ev",    "scene",  "field-width",
                                           "depth-map", "depth", "hidden", NULL};
    const struct render_input *input = job->inputs[0];
    for (size_t i = 0; of_cards[i] != NULL; i++) {
        if (asking_given(job->asking, of_cards[i])) {
            return fail(error, ERROR_USAGE,
                        "{--%s} is of flat cards: a .scene says itself how bright and how far away "
                        "everything is",
                        of_cards[i]);
        }
    }
    if (input->autofocus != NULL && !isnan(input->distance)) {
        return fail(error, ERROR_USAGE,
                    "{--autofocus} finds the distance in the scene: not with {--distance}");
    }
    return isnan(input->distance) || !is_film_fixed(input) ||
           fail(error, ERROR_USAGE,
                "{--distance} and a fixed {--focus} exclude each other in a scene: each says "
                "where the film stands");
}

bool render_check_world(const struct artifact_job *job, struct error *error)
{
    static const char *const of_scenes[] = {"bounces", "spectral", "bands", NULL};
    const struct render_input *input = job->inputs[0];
    if (render_is_world(input)) {
        return check_scene(job, error);
    }
    for (size_t i = 0; of_scenes[i] != NULL; i++) {
        if (asking_given(job->asking, of_scenes[i])) {
            return fail(error, ERROR_USAGE,
                        "{--%s} is of a .scene: light of a flat card comes straight from it",
                        of_scenes[i]);
        }
    }
    return !isinf(input->distance) ||
           fail(error, ERROR_USAGE, "{--distance} inf: a card has a size, and lies somewhere");
}

/* -------- the scene -------- */

static bool scene_scatters(const struct scene *scene)
{
    bool does = false;
    for (size_t i = 0; i < scene->thing_count && !does; i++) {
        does = scene_reflects(scene, &scene->things[i]);
    }
    return does;
}

/* A picture that it names is not written over. */
static bool read_spared(void *context, const char *path, struct arena *arena, struct text *content,
                        struct error *error)
{
    return artifact_spares(context, path, error) &&
           scene_files_there.read(scene_files_there.context, path, arena, content, error);
}

bool render_world_read(const struct artifact_job *job, struct render_world *world,
                       struct error *error)
{
    const struct render_input *input = job->inputs[0];
    struct artifact_job own = *job;
    const struct scene_files files = {read_spared, &own};
    struct arena *arena = job->run->arena;
    struct text content;
    *world = (struct render_world){.scene = {.source = input->subject}};
    if (!files.read(files.context, input->subject, arena, &content, error) ||
        !scene_file_read(input->subject, content, &files, arena, &world->scene, error) ||
        !scene_check(&world->scene, (int)input->bounces, error)) {
        return false;
    }
    world->moves = scene_moves(&world->scene);
    world->scatters = scene_scatters(&world->scene);
    bands_three(&world->bands);
    if (input->spectral && !bands_many((size_t)input->bands, &world->bands, error)) {
        return false;
    }
    /* Times and what moves in them. */
    if (world->moves && isnan(input->time)) {
        fail(error, ERROR_USAGE,
             "%.200s moves: how far it comes while it is exposed depends on {--time}",
             input->subject);
        return error_hint(error, "give it, as -t 1/125");
    }
    return !world->moves || !render_is_part(job) || job->count == 1 ||
           fail(error, ERROR_USAGE,
                "a part is of one picture: each {--time} makes another one of what moves");
}

struct spectrum_value render_world_colours(const struct render_world *world, struct arena *arena)
{
    const struct bands *bands = &world->bands;
    struct setup_wavelength *items = ARENA_ARRAY(arena, bands->count, struct setup_wavelength);
    for (size_t i = 0; i < bands->count; i++) {
        items[i] = (struct setup_wavelength){bands->wavelength[i], 1};
    }
    return (struct spectrum_value){"bands", items, bands->count};
}

/* -------- where the lens stands in it -------- */

/* At no time does anything stand where no ray can come. */
static bool stand_clear(const struct render_world *world, const struct lens_clearance *room,
                        const double span[2], struct error *error)
{
    const struct scene_place *camera = &world->scene.camera.where;
    size_t which;
    double time;
    if (!lens_clearance_holds(room, &world->world, camera, span, &which, &time)) {
        return true;
    }
    const struct scene_thing *thing = &world->scene.things[which];
    char when[80] = "stands within the lens";
    if (scene_place_moves(&thing->where) || scene_place_moves(camera)) {
        snprintf(when, sizeof when, "%.3g s %s the middle of the exposure is within the lens",
                 fabs(time), time < 0 ? "before" : "after");
    }
    fail(error, ERROR_DOMAIN,
         "what line %zu of %.200s places %s, which reaches from %.6g mm before the camera's place "
         "to its film %.6g mm behind it",
         thing->place.line, world->scene.source, when, -room->front, room->back);
    return error_hint(error, "move it, or the camera");
}

/* -------- focus -------- */

/* How far before the first vertex is what lies at a place of the picture, mm? Infinite: nothing. */
static bool distance_at(const struct render_input *input, const struct render_world *world,
                        const double place[2], const struct analysis_case *one, struct arena *arena,
                        double *distance, struct error *error)
{
    const struct film_question question = render_film(input, one);
    const struct scene_place *camera = &world->scene.camera.where;
    /* the film is upside down */
    const double at[2] = {(0.5 - place[0]) * question.width, (place[1] - 0.5) * question.height};
    const double pupil = lens_clearance_pupil(one->setup);
    struct film_samples *samples = ARENA_NEW(arena, struct film_samples);
    struct rays rays = rays_new(arena, RAYS_BLOCK);
    struct lens_film *film = ARENA_NEW(arena, struct lens_film);
    struct world_hit hit;
    if (!lens_film_open(&question, arena, film, error)) {
        return false;
    }
    lens_film_chief(film, at, samples, &rays);
    if (rays.blocks->lost[0] != 0) {
        return fail(error, ERROR_DOMAIN, "{--autofocus} %.40s: no light comes there",
                    input->autofocus);
    }
    const struct world_ray ray = view_ray(camera, pupil, rays.blocks, 0, 0);
    *distance = INFINITY;
    if (world_intersect(&world->world, &ray, &hit)) {
        const struct scene_pose pose = scene_pose_at(camera, 0);
        *distance = -pupil - vector_dot(pose.turned.z, vector_minus(hit.at, pose.at));
    }
    return true;
}

/* A lens that is focused sees another way: again, until the distance stays. */
static bool find_distance(const struct artifact_job *job, struct render_world *world,
                          const double place[2], struct render_input *focused, struct error *error)
{
    enum { TURNS = 20 };
    const double enough = 1e-9;
    const double still[2] = {0, 0};
    const struct render_input *input = job->inputs[0];
    struct run *run = job->run;
    focused->distance = INFINITY;
    focused->from = FROM_PRINCIPAL;
    if (!world_open(&world->scene, still, run->arena, &world->world, error)) {
        return false;
    }
    for (int turn = 0; turn < TURNS; turn++) {
        const double before = focused->distance;
        const struct analysis_case *one;
        if (!render_open(focused, NULL, run, &one, error) ||
            !distance_at(input, world, place, one, run->arena, &focused->distance, error)) {
            return false;
        }
        focused->from = isinf(focused->distance) ? FROM_PRINCIPAL : FROM_FRONT;
        if (isinf(focused->distance) || fabs(focused->distance / before - 1) < enough) {
            return true;
        }
    }
    return fail(error, ERROR_DOMAIN,
                "{--autofocus} %.40s: what is seen there changes as the lens is focused on it",
                focused->autofocus);
}

/* The scene's distance counts from where it has the camera, which a lens moves as it focuses. */
static bool focus_from_camera(const struct artifact_job *job, double distance,
                              struct render_input *focused, struct error *error)
{
    enum { TURNS = 20 };
    const double enough = 1e-12;
    double before = INFINITY;
    focused->distance = NAN;
    for (int turn = 0; turn < TURNS; turn++) {
        const struct analysis_case *one;
        if (!render_open(focused, NULL, job->run, &one, error)) {
            return false;
        }
        const double pupil = lens_clearance_pupil(one->setup);
        focused->from = FROM_FRONT;
        focused->distance = distance - pupil;
        if (fabs(pupil - before) <= enough * distance) {
            return true;
        }
        before = pupil;
    }
    return fail(error, ERROR_DOMAIN,
                "focus=%.6g mm: the camera's place in the lens changes as it is focused", distance);
}

/* On what the scene says. */
static bool focus_on_said(const struct artifact_job *job, const struct scene_camera *camera,
                          struct render_input *focused, struct error *error)
{
    static const int froms[SCENE_FROMS] = {
        /* enum distance_from, as options have it */
        [SCENE_FROM_ENTRANCE] = FROM_ENTRANCE,
        [SCENE_FROM_PRINCIPAL] = FROM_PRINCIPAL,
        [SCENE_FROM_SENSOR] = FROM_SENSOR,
        [SCENE_FROM_FRONT] = FROM_FRONT,
    };
    focused->distance = camera->distance;
    if (isinf(camera->distance) || asking_given(job->asking, "from")) {
        return true;
    }
    focused->from = froms[camera->from];
    return camera->from != SCENE_FROM_ENTRANCE ||
           focus_from_camera(job, camera->distance, focused, error);
}

bool render_world_focus(const struct artifact_job *job, struct render_world *world,
                        struct render_input *focused, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    *focused = *input;
    if (input->autofocus != NULL) {
        double place[2];
        return render_autofocus_place(input->autofocus, place, error) &&
               find_distance(job, world, place, focused, error);
    }
    if (isnan(input->distance) && !is_film_fixed(input) && !isnan(world->scene.camera.distance)) {
        return focus_on_said(job, &world->scene.camera, focused, error);
    }
    if (isnan(focused->distance) && asking_given(job->asking, "from")) {
        fail(error, ERROR_USAGE, "{--from} needs a distance");
        return error_hint(error, "give {--distance}, or focus= in the scene");
    }
    if (!isnan(focused->distance) || input->question.focus.kind != PLANE_OF_LENS) {
        return true;
    }
    fail(error, ERROR_USAGE, "on what the lens is focused is not said");
    return error_hint(error, "give {--distance}, {--autofocus} X:Y, or focus= in the scene");
}

/* -------- stars -------- */

/* Far below a pixel of any picture, and nearly all around. */
#define LEAST (1e-5 * RADIANS_PER_DEGREE)
#define MOST  (177 * RADIANS_PER_DEGREE)

static bool lacks_diameter(const struct scene_light *light)
{
    return light->kind == LIGHT_STAR && isnan(light->diameter);
}

/*
 * How wide stars are that do not say so: as a pixel in the middle of the film is by its larger
 * side, so that its rays find them; the same in all parts of a picture.
 *
 * Given     world  receives it, in the lights of its scene too
 * Result    where a pixel has no such angle 1 arcmin
 * Errors    as lens_film_open
 */
static bool render_open_stars(const struct photograph_question *question, struct arena *arena,
                              struct render_world *world, struct error *error)
{
    struct scene *scene = &world->scene;
    world->stars = (struct render_stars){.diameter = NAN};
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        count += lacks_diameter(&scene->lights[i]) ? 1 : 0;
    }
    if (count == 0) {
        return true;
    }
    struct lens_film *film = ARENA_NEW(arena, struct lens_film);
    if (!lens_film_open(&question->film, arena, film, error)) {
        return false;
    }
    /* How wide a pixel of the whole picture is as the lens sees it; 0: that has no angle. */
    struct film_samples *samples = ARENA_NEW(arena, struct film_samples);
    struct rays rays = rays_new(arena, RAYS_BLOCK);
    const double sides[2][2] = {{question->film.width / (double)question->columns, 0},
                                {0, question->film.height / (double)question->rows}};
    double angle = 0; /* fmax leaves out what is NaN */
    for (int i = 0; i < 2; i++) {
        angle = fmax(angle, lens_film_angle(film, sides[i], samples, &rays));
    }
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
    const struct render_stars *stars = &world->stars;
    const char *pixel = stars->are_a_pixel ? "one pixel, " : "";
    return isnan(stars->diameter) ? NULL
                                  : arena_printf(arena, "discs of %s%.4g arcmin", pixel,
                                                 60 * DEGREES_PER_RADIAN * stars->diameter);
}

/* -------- a picture -------- */

/* Of wavelengths each has its own share of a coloured filter. */
static void put_filter(const struct render_input *input, struct render_world *world)
{
    world->seen = world->bands;
    for (int i = 0; i < 3; i++) {
        world->white[i] = input->spectral ? 0 : 1;
    }
    for (size_t k = 0; k < world->bands.count && input->spectral; k++) {
        const double share =
            input->filter.name == NULL
                ? 1
                : mired_transmittance(input->filter.mired, world->bands.wavelength[k]);
        for (int i = 0; i < 3; i++) {
            world->seen.rgb[k][i] *= share;
            world->white[i] += world->seen.rgb[k][i];
        }
    }
}

/* Light that becomes white in a PNG of the longest exposure, lx; NaN: nobody said how long. */
static bool find_white_light(const struct artifact_job *job, const struct render_frame *frame,
                             double *white, struct error *error)
{
    *white = INFINITY;
    for (size_t i = 0; i < job->count; i++) {
        const struct render_input *input = job->inputs[i];
        double iso;
        if (!render_speed(input, frame, job->run->arena, &iso, error)) {
            return false;
        }
        *white = isnan(input->time) || isnan(*white)
                     ? NAN
                     : fmin(*white, exp2(input->filter.stops) * saturation_exposure(iso) /
                                        (DEVELOP_HEADROOM * input->time));
    }
    return true;
}

bool render_world_open(const struct artifact_job *job, const struct analysis_case *one,
                       struct render_world *world, struct photograph_question *question,
                       struct error *error)
{
    const struct render_input *input = job->inputs[0];
    const bool scattered = world->scatters || skip_is_kept(question->kept, SKIP_SECONDARY);
    const struct render_frame frame = {.columns = question->columns, .rows = question->rows};
    double span[2];
    struct arena *arena = job->run->arena;
    /* All times that rays of any exposure may come at. */
    span[0] = span[1] = 0;
    for (size_t i = 0; i < job->count; i++) {
        double own[2];
        if (!render_shutter_span(job->inputs[i], one, job->run->arena, own, error)) {
            return false;
        }
        span[0] = fmin(span[0], own[0]);
        span[1] = fmax(span[1], own[1]);
    }
    if (!render_open_stars(question, arena, world, error) ||
        !world_open(&world->scene, span, arena, &world->world, error) ||
        !lights_open(&world->scene, &world->bands, arena, &world->lights, error)) {
        return false;
    }
    const struct lens_clearance room = lens_clearance_of(one->setup, arena);
    if (!stand_clear(world, &room, span, error)) {
        return false;
    }
    /* What the camera stands within, if that is closed: no light comes in. */
    const struct vector at = scene_pose_at(&world->scene.camera.where, 0).at;
    size_t which;
    world->enclosed =
        world_encloses(&world->world, at, 0, &which)
            ? arena_printf(arena, "the camera stands within what line %zu of %.200s places",
                           world->scene.things[which].place.line, world->scene.source)
            : NULL;
    put_filter(input, world);
    world->path = (struct path){.world = &world->world,
                                .lights = &world->lights,
                                .bounces = scattered ? (int)input->bounces : 0};
    world->view = (struct view){.path = &world->path,
                                .bands = &world->seen,
                                .points = tile_rays_points(question->samples, arena),
                                .camera = world->scene.camera.where,
                                .pupil = lens_clearance_pupil(one->setup)};
    question->view = &world->view;
    question->white_of_mean = saturation_exposure(1) / (DEVELOP_HEADROOM * recommended_exposure(1));
    return find_white_light(job, &frame, &question->white, error);
}

/* -------- colours -------- */

enum { SAID_MOST = 3 }; /* each by itself; of more how many */

/* In u', v'; the eye tells twice as much apart. */
static const double seen_as_same = 0.002;

/* What is said so far. */
struct colour_remarks {
    struct text_buffer *remarks;
    size_t count;
};

/* Less than half a percent is within what tables and observers differ by. */
static void say_unsaturated(struct colour_remarks *saying, const struct typed_place *place,
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

/* -------- what is said of it -------- */

/*
 * The paraxial image of the film, from the first vertex towards the scene, mm; infinite at
 * infinity, -infinite beyond: x x' = f f' from the focal points.
 */
static double in_focus(const struct analysis_case *one)
{
    const struct first_order *first = &one->setup->first;
    const double object = render_object(one);
    const double defocus = isnan(one->question->defocus) ? 0 : one->question->defocus;
    if (!isnan(object) && defocus == 0) {
        return object;
    }
    const double behind = (isnan(object) ? one->setup->image : first->image + defocus) - first->bfl;
    const double product = first->front_focal * first->rear_focal;
    if (behind < 0) {
        return -INFINITY;
    }
    return behind > 0 ? -first->ffl - product / behind : (double)INFINITY;
}

const char *render_focus_text(const struct analysis_case *one, struct arena *arena)
{
    const struct setup *setup = one->setup;
    const double object = in_focus(one), pupil = lens_clearance_pupil(setup);
    const double film = object + setup->first.length + setup->image;
    if (isinf(object)) {
        return object > 0 ? "infinity" : "nothing, the film stands before the focal point";
    }
    return arena_printf(arena, "%.6g m from the camera's place, %.6g m from the film",
                        (object + pupil) / MM_PER_M, film / MM_PER_M);
}

/* Of each file once. */
static void say_degenerate(const struct world *world, struct text_buffer *remarks)
{
    struct name_table said = {0};
    for (size_t i = 0; i < world->scene->thing_count; i++) {
        const struct mesh *mesh = world->things[i].mesh;
        const size_t flat = mesh != NULL ? mesh->degenerate : 0;
        const struct text file = text_of(flat > 0 ? mesh->triangles->file : "");
        if (flat == 0 || name_table_find(&said, file) != NAME_NONE) {
            continue;
        }
        name_table_add(&said, file, remarks->arena);
        growing_format(remarks, "%.200s: %zu triangle%s no area, and %s left out\n", file.start,
                       flat, flat == 1 ? " has" : "s have", flat == 1 ? "is" : "are");
    }
}

void render_say_world(const struct render_world *world, struct text_buffer *remarks)
{
    for (size_t i = 0; i < world->scene.note_count; i++) {
        growing_format(remarks, "%s\n", world->scene.notes[i]);
    }
    const char *stars = render_stars_text(world, remarks->arena);
    if (stars != NULL) {
        growing_format(remarks, "stars are %s, where they have no diameter=\n", stars);
    }
    if (world->world.degenerate > 0) {
        say_degenerate(&world->world, remarks);
    }
    /* Its colours that red, green and blue of sRGB do not hold, and what becomes of them. */
    struct colour_remarks saying = {remarks, 0};
    const struct scene *scene = &world->scene;
    for (size_t i = 0; i < scene->material_count; i++) {
        const struct material *material = &world->lights.materials.of[i];
        say_unsaturated(&saying, &scene->materials[i].place, "surface", material->colour);
        say_unsaturated(&saying, &scene->materials[i].place, "light", material->light);
        say_narrow(&saying, &scene->materials[i].place, &scene->materials[i].emission,
                   material->light);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        say_unsaturated(&saying, &scene->lights[i].place, "light", world->lights.units[i]);
        say_narrow(&saying, &scene->lights[i].place, &scene->lights[i].spectrum,
                   world->lights.units[i]);
    }
    if (saying.count > SAID_MOST) {
        growing_format(remarks, "%zu more of the scene's colours likewise\n",
                       saying.count - SAID_MOST);
    }
}
