/* cli/pupil_cases.c - from the options of lenscalc pupil to shapes. */
/* SPDX-License-Identifier: MIT */
#include "commands/lens/pupil_cases.h"

#include "cli/image_plane.h"
#include "trace/aim.h"

#include <string.h>

static const double degrees = 180 / 3.141592653589793;

/* Enough for 1e-5 of an area with corners. */
enum { DIRECTIONS = 512 };

/* What one lens at one wavelength needs for all its points. */
struct scene {
    const struct pupil_input *input;
    struct lens_case own; /* with what is doubtful about its film */
    const struct lens_case *one;
    struct system clipped, open;
    double film; /* from the last vertex, mm; NaN for fields */
    struct pupil_shape axis;
    bool (*visit)(const struct pupil_case *point, struct run *run, const void *context,
                  struct error *error);
    const void *context;
};

/* What the callbacks of lens_each are handed. */
struct asked {
    const struct pupil_input *input;
    bool (*visit)(const struct pupil_case *point, struct run *run, const void *context,
                  struct error *error);
    const void *context;
};

static bool compile(struct scene *scene, bool reverse, struct arena *arena, struct error *error)
{
    struct system_options options = system_options_default();
    const struct lens_case *one = scene->one;
    options.reverse = reverse;
    options.stop_radius = one->first.stop_radius;
    if (!system_compile(one->lens, one->wavelength, &options, arena, &scene->open, error)) {
        return false;
    }
    options.clip = true;
    return system_compile(one->lens, one->wavelength, &options, arena, &scene->clipped, error);
}

/* The film: as asked, else where the lens says; the same for all wavelengths. */
static bool place_film(struct scene *scene, struct arena *arena, struct error *error)
{
    const struct lens *lens = scene->one->lens;
    struct lens_case *own = &scene->own;
    struct first_order primary;
    struct image_plane plane;
    if (!first_order_of_lens(lens, lens_primary_wavelength(lens), own->section, arena, &primary,
                             error) ||
        !image_plane_find(&scene->input->focus, lens, &primary, own->first.stop_radius, arena,
                          &plane, error)) {
        return false;
    }
    if (isnan(plane.z) || plane.z == 0) {
        fail(error, ERROR_DOMAIN, "the film lies %s",
             plane.z == 0 ? "in the last vertex" : "at infinity");
        return error_hint(error, "say where the film is: --focus MM, from the last vertex");
    }
    scene->film = plane.z;
    own->warning = lens_warnings_join(own->warning, plane.warning, arena);
    return true;
}

static bool shape_of(const struct scene *scene, const struct beam *beam, struct arena *arena,
                     struct pupil_shape *shape, struct error *error)
{
    const struct pupil_question question = {.clipped = &scene->clipped,
                                            .open = &scene->open,
                                            .beam = beam,
                                            .first = &scene->one->first,
                                            .directions = DIRECTIONS};
    return pupil_shape(&question, arena, shape, error);
}

static struct beam film_beam(const struct scene *scene, double height)
{
    return beam_from_film((double[3]){0, height, scene->film}, scene->open.index_first);
}

static bool show(const struct scene *scene, const struct beam *beam, struct pupil_case *point,
                 struct run *run, struct error *error)
{
    struct pupil_shape shape;
    if (!shape_of(scene, beam, run->arena, &shape, error)) {
        return false;
    }
    point->shape = &shape;
    point->axis = &scene->axis;
    point->one = scene->one;
    return scene->visit(point, run, scene->context, error);
}

static bool show_field(const struct scene *scene, const struct field_point *field, struct run *run,
                       struct error *error)
{
    const struct conjugate_object object = lens_object(scene->one->lens);
    struct beam beam;
    if (!beam_of_field(field, &object, &scene->one->first, &beam, error)) {
        return false;
    }
    struct pupil_case point = {.height = NAN, .film = NAN, .object = NAN};
    point.angle = atan2(beam.axis[1], beam.axis[2]);
    if (!object.is_infinite) {
        point.object = -beam.axis[1] * beam.distance + 0.0;
    }
    return show(scene, &beam, &point, run, error);
}

static bool show_fields(const struct scene *scene, struct run *run, struct error *error)
{
    const struct lens *lens = scene->one->lens;
    bool asked = !isnan(scene->input->field);
    size_t count = asked || lens->field_count == 0 ? 1 : lens->field_count;
    for (size_t i = 0; i < count; i++) {
        struct field_point field = {FIELD_NONE, {0, 0}};
        if (asked) {
            field = (struct field_point){FIELD_ANGLE, {0, scene->input->field}};
        } else if (lens->field_count > 0) {
            field = (struct field_point){lens->field_kind, {0, lens->fields[i].value.hi}};
        }
        if (!show_field(scene, &field, run, error)) {
            return false;
        }
    }
    return true;
}

/* -------- the point on the axis, once for all points of a sweep -------- */

/* What the shape on the axis depends on. Compared byte by byte: filled with zeros first. */
struct axis_key {
    const struct lens *lens;
    const char *position;
    double wavelength, fnumber, film;
};

enum { AXES = 64 };

struct axis_memo {
    size_t count;
    struct axis_key keys[AXES];
    struct pupil_shape shapes[AXES]; /* their numbers only: outlines end with their row */
};

static struct axis_key key_of(const struct scene *scene)
{
    struct axis_key key;
    memset(&key, 0, sizeof key);
    key.lens = scene->input->question.lens.lens;
    key.position = scene->one->position;
    key.wavelength = scene->one->wavelength;
    key.fnumber = scene->input->question.fnumber;
    key.film = scene->film;
    return key;
}

static struct axis_memo *memo_of(const struct scene *scene, struct run *run)
{
    /* a lens that ends with its row says nothing of one that comes to lie in the same place */
    if (run->kept == NULL || scene->input->question.lens.arena == run->arena) {
        return NULL;
    }
    if (run->state == NULL) {
        run->state = ARENA_NEW(run->kept, struct axis_memo);
    }
    return run->state;
}

static bool find_axis(struct scene *scene, const struct beam *beam, struct run *run,
                      struct error *error)
{
    struct axis_memo *memo = memo_of(scene, run);
    const struct axis_key key = key_of(scene);
    for (size_t i = 0; memo != NULL && i < memo->count; i++) {
        if (memcmp(&memo->keys[i], &key, sizeof key) == 0) {
            scene->axis = memo->shapes[i];
            return true;
        }
    }
    if (!shape_of(scene, beam, run->arena, &scene->axis, error)) {
        return false;
    }
    if (memo != NULL) {
        size_t at = memo->count < AXES ? memo->count++ : 0;
        struct pupil_shape *kept = &memo->shapes[at];
        memo->keys[at] = key;
        *kept = scene->axis;
        kept->stop = kept->across = NULL;
        kept->entrance.pupil.outline = kept->entrance.vertex.outline = NULL;
        kept->exit.pupil.outline = kept->exit.vertex.outline = NULL;
    }
    return true;
}

static bool visit_lens(const struct lens_case *one, struct run *run, const void *context,
                       struct error *error)
{
    const struct asked *asked = context;
    struct scene scene = {.input = asked->input,
                          .own = *one,
                          .film = NAN,
                          .visit = asked->visit,
                          .context = asked->context};
    bool from_film = !isnan(asked->input->height);
    const struct field_point centre = {FIELD_NONE, {0, 0}};
    const struct conjugate_object object = lens_object(one->lens);
    struct beam beam;
    scene.one = &scene.own;
    if (!compile(&scene, from_film, run->arena, error) ||
        (from_film && !place_film(&scene, run->arena, error))) {
        return false;
    }
    if (from_film) {
        beam = film_beam(&scene, 0);
    } else if (!beam_of_field(&centre, &object, &one->first, &beam, error)) {
        return false;
    }
    if (!find_axis(&scene, &beam, run, error)) {
        return false;
    }
    if (!from_film) {
        return show_fields(&scene, run, error);
    }
    struct pupil_case point = {.from_film = true,
                               .angle = NAN,
                               .object = NAN,
                               .height = asked->input->height,
                               .film = scene.film};
    beam = film_beam(&scene, point.height);
    return show(&scene, &beam, &point, run, error);
}

bool pupil_each(const struct pupil_input *input, struct run *run,
                bool (*visit)(const struct pupil_case *point, struct run *run, const void *context,
                              struct error *error),
                const void *context, struct error *error)
{
    const struct asked asked = {input, visit, context};
    struct lens_question question = input->question;
    if (!isnan(input->field) && !isnan(input->height)) {
        return fail(error, ERROR_USAGE,
                    "--field is a point in front of the lens and --height one in the film: give "
                    "one of them");
    }
    question.field = NAN;
    if (question.wavelength.name == NULL && question.lens.lens != NULL) {
        question.wavelength =
            (struct wavelength_value){lens_primary_wavelength(question.lens.lens), "primary"};
    }
    return lens_each(&question, run, visit_lens, &asked, error);
}

const char *pupil_point_words(const struct pupil_case *point, struct arena *arena)
{
    return point->from_film        ? arena_printf(arena, "film %.4g mm", point->height)
           : !isnan(point->object) ? arena_printf(arena, "object %.4g mm", point->object)
                                   : arena_printf(arena, "%.4g deg", point->angle * degrees);
}
