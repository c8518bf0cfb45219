/* commands/camera/render_case.c - the lens of a picture: focused, or its model. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/design/fit.h"
#include "commands/lens/focus_gaps.h"
#include "commands/photo/photo_lens.h"
#include "optics/conjugates.h"
#include "optics/focusing.h"
#include "trace/pupil/focus.h"

static const struct analysis_policy policy = {.wavelengths = WAVELENGTHS_ALL,
                                              .fields = FIELDS_LARGEST};

const struct word render_focus_ats[] = {
    [FOCUS_AT_THICK] = {"thick", "the image of the thick lens, by paraxial rays"},
    [FOCUS_AT_SHARPEST] = {"sharpest", "the sharpest real image on the axis"},
    {NULL, NULL},
};

/* -------- focus -------- */

/* A lens that is focused by its gaps, and what of it is asked for. */
struct focus_movement {
    struct focus_mechanism focusing;
    struct conjugate_question question;
    double fnumber; /* NaN = that of the lens */
    struct arena *arena;
};

/* A state of it. */
struct focus_state {
    struct focused focused;
    double object; /* before the first vertex, mm */
};

/*
 * Bring the paraxial image to a plane `shift` before that of the film.
 *
 * Errors    as focus_solve; ERROR_DOMAIN: an object that is not before the lens
 */
static bool move_gaps(const struct focus_movement *moving, double shift, struct focus_state *state,
                      struct error *error)
{
    struct focus_mechanism focusing = moving->focusing;
    struct conjugate_question question = moving->question;
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct conjugate_ray ray;
    struct focused *solutions = ARENA_ARRAY(moving->arena, FOCUS_SOLUTIONS, struct focused);
    focusing.image_plane = pair_add(focusing.image_plane, pair_of(-shift));
    question.distance -= question.from == CONJUGATE_FROM_SENSOR ? shift : 0;
    if (focus_solve(&focusing, &question, moving->arena, solutions, error) == 0) {
        return false;
    }
    state->focused = solutions[0];
    if (!paraxial_compile(state->focused.lens, focusing.wavelength, focusing.section, moving->arena,
                          &system, error)) {
        return false;
    }
    paraxial_trace(&system, &trace);
    if (!focus_object(&state->focused, &system, &trace, &question, &ray, error)) {
        return false;
    }
    state->object = system.index[0].hi * pair_divide(ray.y, ray.v).hi;
    state->focused.image_plane = pair_add(state->focused.image_plane, pair_of(shift));
    return state->object > 0 ||
           fail(error, ERROR_DOMAIN, "the subject lies %.6g mm behind the first vertex",
                -state->object);
}

/*
 * The sharpest image in the film: the shift of the paraxial one that its aberration undoes, by
 * secants, as aberrations change with the gaps.
 */
static bool sharpen(const struct focus_movement *moving, struct focus_state *state,
                    struct error *error)
{
    enum { TURNS = 30 };
    const double enough = 1e-9; /* mm */
    double shift = 0, before = 0, off_before = 0;
    for (int turn = 0; turn < TURNS && isfinite(shift); turn++) {
        if (turn > 0 && !move_gaps(moving, shift, state, error)) {
            return error_prefix(error, "the sharpest image: ");
        }
        const struct setup_question question = {.lens = state->focused.lens,
                                                .object = &state->object,
                                                .wavelength = NAN,
                                                .wavelengths = WAVELENGTHS_PRIMARY,
                                                .fnumber = moving->fnumber};
        const struct plane_value best = {.kind = PLANE_BEST};
        struct setup setup;
        if (!setup_open(&question, moving->arena, &setup, error) ||
            !setup_place_image(&setup, &best, error)) {
            return false;
        }
        /* from the paraxial to the sharpest image, mm */
        const double off = (setup.image - setup.first.image) - shift;
        if (fabs(off) < enough) {
            return true;
        }
        const double slope = turn == 0 ? -1 : (off - off_before) / (shift - before);
        before = shift;
        off_before = off;
        shift -= off / slope;
    }
    return fail(error, ERROR_DOMAIN,
                "no movement of the gaps was found that brings the sharpest image to the film");
}

/* Of what is too near for the gaps: the hint how near it may be; none helps what is too far. */
static bool hint_least(const struct focus_movement *moving, struct error *error)
{
    enum { DOUBLINGS = 30, HALVINGS = 50 };
    struct focus_movement tried = *moving;
    struct focus_state state;
    struct error ignored;
    double *distance = &tried.question.distance, near = fmax(*distance, 1e-3), far = near;
    bool is_found = false;
    for (int i = 0; i < DOUBLINGS && isfinite(far) && !is_found; i++) {
        *distance = far *= 2;
        is_found = move_gaps(&tried, 0, &state, &ignored);
    }
    near = is_found ? fmax(near, far / 2) : near;
    for (int i = 0; i < HALVINGS && is_found; i++) {
        *distance = (near + far) / 2;
        if (move_gaps(&tried, 0, &state, &ignored)) {
            far = *distance;
        } else {
            near = *distance;
        }
    }
    return is_found ? error_hint(error, "the least {--distance} is %.6g mm", far) : false;
}

static bool focus_by_gaps(const struct render_input *input, struct arena *arena,
                          struct analysis_question *question, struct error *error)
{
    const struct lens *typed = input->question.lens.lens, *lens;
    struct focus_movement moving = {.focusing = {.section = SECTION_Y},
                                    .question = {CONJUGATE_OBJECT,
                                                 focus_from((enum distance_from)input->from),
                                                 input->distance, 0},
                                    .fnumber = question->fnumber,
                                    .arena = arena};
    struct focus_state state;
    /* The lens in the only position that is asked for. */
    const size_t *positions;
    size_t count;
    if (!lens_positions(input->question.lens.lens, input->question.position, arena, &positions,
                        &count, error)) {
        return false;
    }
    lens = lens_at_position(input->question.lens.lens, positions[0], arena);
    moving.focusing.wavelength = lens_primary_wavelength(lens);
    if (!focus_gaps_open(text_of(input->gap), typed, lens, arena, &moving.focusing, error)) {
        return false;
    }
    if (!move_gaps(&moving, 0, &state, error)) {
        return hint_least(&moving, error);
    }
    if (input->focus_at == FOCUS_AT_SHARPEST && !sharpen(&moving, &state, error)) {
        return false;
    }
    question->lens.lens = state.focused.lens;
    question->position = NULL;
    question->object = state.object;
    question->focus =
        (struct plane_value){.kind = PLANE_AT, .distance = state.focused.image_plane.hi};
    return true;
}

/*
 * The lens focused on the distance: the object, and where the film stands.
 *
 * Given     question  of the lens; receives object and focus, and with --gap the lens itself, in
 *                     its position, and no position any more
 * Errors    ERROR_DOMAIN: no stop, a distance that the lens cannot focus on; as focus_by_gaps,
 *           photo_lens_single, distance_to_principal and conjugates_working_distance
 */
static bool render_focus(const struct render_input *input, struct arena *arena,
                         struct analysis_question *question, struct error *error)
{
    if (input->gap != NULL) {
        return focus_by_gaps(input, arena, question, error);
    }
    if (input->focus_at == FOCUS_AT_SHARPEST) {
        question->focus.kind = PLANE_BEST;
    } else if (question->focus.kind == PLANE_OF_LENS) {
        question->focus.kind = PLANE_PARAXIAL;
    }
    /* what the distance says: from the first vertex, mm */
    const struct photo_lens_question asked = {
        .lens = input->question.lens,
        .position = input->question.position,
        .focal = {.length = NAN, .equivalent = NAN, .fnumber = NAN},
        .wavelength = NAN,
        .fnumber = NAN,
        .pupil = NAN,
        .from = input->from};
    struct photo_lens thin;
    double s;
    if (input->question.lens.lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "the lens has no stop: how much light comes is not known");
        return lens_hint_stop(error);
    }
    if (!photo_lens_single(&asked, PHOTO_LENS_OWN_PUPILS, arena, &thin, error) ||
        !distance_to_principal(thin.f, thin.P, input->distance, &thin.measuring, &s, error)) {
        return false;
    }
    if (s <= thin.f) {
        return fail(error, ERROR_DOMAIN,
                    "the subject lies %.6g mm before the front principal plane: that must be more "
                    "than the focal length, %.6g mm",
                    s, thin.f);
    }
    return conjugates_working_distance(s, thin.measuring.front, &question->object, error);
}

/* -------- the model -------- */

/* Is it one already, as `fit -o` writes them: no power but that of thick lenses? */
static bool is_thick(const struct lens *lens)
{
    size_t thick = 0, others = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        thick += surface->kind == SURFACE_THICK;
        others += surface->kind != SURFACE_THICK && surface_profile(surface) != PROFILE_PLANE;
    }
    return thick == 1 && others == 0;
}

/* By eighths as far as the film goes, for a lens that states no fields. */
static struct fields_value fields_of_film(const struct sensor *film, const struct setup *setup)
{
    enum { STEPS = 8 };
    const double corner = hypot(film->width, film->height) / 2;
    struct field_item *items = ARENA_ARRAY(setup->arena, STEPS + 1, struct field_item);
    for (int i = 0; i <= STEPS; i++) {
        const double height = corner * i / STEPS;
        items[i] = (struct field_item){.angle = atan(height / fabs(setup->first.efl)),
                                       .height = height / fabs(setup->first.magnification),
                                       .weight = 1};
    }
    return (struct fields_value){"to the corner of the film", items, STEPS + 1};
}

/* Fitted as `lenscalc fit --distortion 0` does, to rays from the object of the picture. */
static bool fit_lens_of(const struct render_input *input, const struct analysis_case *one,
                        struct run *run, struct lens *stand_in, struct error *error)
{
    static const struct lens_policy fitted = {.wavelengths = WAVELENGTHS_ALL,
                                              .fields = FIELDS_SPREAD};
    struct lens *lens = ARENA_NEW(run->arena, struct lens);
    if (run->no_solver != NULL) {
        *error = *run->no_solver;
        return false;
    }
    /* without what `answer` adds, the fit of twice the rays */
    const struct fit_input fitting = {.object = NAN,
                                      .distortion = 0,
                                      .show = FIT_PARAMETERS,
                                      .match = FIT_IMAGE,
                                      .pattern = PATTERN_GAUSS,
                                      .rays = 72};
    *lens = *one->setup->lens;
    lens->object = (struct figure){one->setup->object.distance, {NULL, 0}, LENS_NONE};
    lens->object_is_infinite = one->setup->object.is_infinite;
    lens->objects = NULL;
    struct lens_question question = {.lens = one->question->lens,
                                     .fnumber = one->question->fnumber,
                                     .field = NAN,
                                     .field_x = NAN};
    question.lens.lens = lens;
    if (lens->field_count == 0) {
        question.fields = fields_of_film(&input->sensor.size, one->setup);
    }
    struct lens_cursor at = lens_begin(&question, &fitted, run->arena);
    bool found = lens_next_setup(&at, error);
    if (found) {
        struct fit_job job = {
            .input = &fitting, .run = run, .setup = at.one.setup, .warning = at.one.warning};
        found = setup_light(at.one.setup, 0, &job.light, error) && fit_job_run(&job, error);
        *stand_in = found ? fit_equal_lens(&job) : *lens;
    }
    return found || error_prefix(error, "no thick lens could be fitted: ");
}

/* Where the film of a model stands: in its own image if that is what was asked for. */
static struct plane_value model_plane(const struct analysis_case *one,
                                      const struct render_input *input)
{
    const struct plane_value *asked = &one->question->focus;
    const enum focus_kind own = one->setup->lens->focus;
    const bool is_of_lens = asked->kind == PLANE_OF_LENS;
    const double defocus = isnan(one->question->defocus) ? 0 : one->question->defocus;
    if (asked->kind == PLANE_TABLE || (is_of_lens && own == FOCUS_TABLE)) {
        return (struct plane_value){.kind = PLANE_AT, .distance = one->setup->image - defocus};
    }
    if (input->gap != NULL || (input->model == MODEL_PARAXIAL &&
                               (asked->kind == PLANE_BEST || (is_of_lens && own == FOCUS_BEST)))) {
        return (struct plane_value){.kind = PLANE_PARAXIAL};
    }
    return *asked;
}

/*
 * The model of the lens that is asked for, in its place.
 *
 * Given     one  the lens as it is; receives the case of its model
 * Errors    as lens_model_check, fit_job_run and render_open
 */
static bool render_model(const struct render_input *input, struct run *run,
                         const struct analysis_case **one, struct error *error)
{
    const enum lens_model model = (enum lens_model)input->model;
    const struct setup *setup = (*one)->setup;
    if (model == MODEL_EXACT || (model == MODEL_FITTED && is_thick(setup->lens))) {
        return true;
    }
    struct analysis_question *question = ARENA_NEW(run->arena, struct analysis_question);
    *question = *(*one)->question;
    question->focus = model_plane(*one, input);
    if (lens_model_replaces(model)) {
        struct lens *stand_in = ARENA_NEW(run->arena, struct lens);
        if (!lens_model_check(setup->lens, &setup->first, error) ||
            (model == MODEL_FITTED && !fit_lens_of(input, *one, run, stand_in, error))) {
            return false;
        }
        if (model != MODEL_FITTED) {
            *stand_in = lens_model_lens(model, setup->lens, &setup->first, run->arena);
        }
        question->lens.lens = stand_in;
        question->position = NULL;
    }
    struct analysis_cursor at = analysis_begin(question, &policy, run);
    const bool found = analysis_next_case(&at, error);
    *one = at.one;
    return found;
}

void render_say_model(const struct render_input *input, const struct analysis_case *one,
                      struct text_buffer *remarks)
{
    const struct lens *lens = one->setup->lens;
    const bool is_fitted = input->model == MODEL_FITTED && lens->note_count > 0;
    if (input->model != MODEL_EXACT) {
        growing_format(remarks, "model %s: f %.6g mm%s%s\n", lens_models[input->model].word,
                       one->setup->first.efl, is_fitted ? "; " : "",
                       is_fitted ? lens->notes[0] : "");
    }
}

bool render_open(const struct render_input *input, const struct spectrum_value *channels,
                 struct run *run, const struct analysis_case **one, struct error *error)
{
    struct analysis_question *question = ARENA_NEW(run->arena, struct analysis_question);
    *question = input->question;
    question->field = question->field_x = question->height = question->height_x = NAN;
    question->object = NAN;
    if (channels != NULL) {
        question->spectrum = *channels;
    }
    if (!isnan(input->distance) && !render_focus(input, run->arena, question, error)) {
        return false;
    }
    struct analysis_cursor at = analysis_begin(question, &policy, run);
    const bool found = analysis_next_case(&at, error);
    *one = at.one;
    return found && render_model(input, run, one, error);
}

double render_object(const struct analysis_case *one)
{
    return one->question->object;
}

bool render_stopped(const struct render_input *input, const struct analysis_case *one,
                    double fnumber, struct arena *arena, struct setup *setup, struct error *error)
{
    const struct lens *lens = input->question.lens.lens;
    const double object = render_object(one);
    const size_t *positions;
    size_t count;
    if (!lens_positions(lens, input->question.position, arena, &positions, &count, error)) {
        return false;
    }
    const struct setup_question question = {.lens = lens,
                                            .position = positions[0],
                                            .object = isnan(object) ? NULL : &object,
                                            .wavelength = NAN,
                                            .wavelengths = WAVELENGTHS_PRIMARY,
                                            .fnumber = fnumber};
    return setup_open(&question, arena, setup, error);
}

/* Its f-number wide open, if more than that is asked for; else, or if it has none, NaN. */
static double widest_of(const struct render_input *input, const struct analysis_case *one,
                        struct arena *arena)
{
    const double asked = input->question.fnumber;
    struct setup own;
    struct error ignored;
    return !isnan(asked) && render_stopped(input, one, NAN, arena, &own, &ignored) &&
                   asked < SETUP_WIDTH_SLACK * own.first.fnumber
               ? own.first.fnumber
               : (double)NAN;
}

double render_fnumber(const struct render_input *input, const struct analysis_case *one,
                      struct arena *arena)
{
    const double widest = widest_of(input, one, arena);
    const bool is_limited = setup_width_warning(one->setup, input->question.fnumber, arena) != NULL;
    return is_limited && !isnan(widest) ? widest : one->setup->first.fnumber;
}

void render_doubts(const struct render_input *input, const struct analysis_case *one,
                   double largest, double corner, const double lit_at[2], double share,
                   struct text_buffer *remarks)
{
    const double widest = widest_of(input, one, remarks->arena);
    if (!isnan(widest) && lens_model_replaces((enum lens_model)input->model)) {
        growing_format(remarks,
                       "warning: the lens is f/%.4g wide open: all of f/%.4g passes its model, "
                       "which has no clear apertures\n",
                       widest, input->question.fnumber);
    }
    if (one->warning != NULL) {
        growing_format(remarks, "warning: %s\n", one->warning);
    }
    const double beside = hypot(lit_at[0], lit_at[1]);
    if (beside > 0) {
        growing_format(remarks,
                       "warning: the middle of the film stays dark: a place %.4g mm from it, where "
                       "light arrives, stands for it\n",
                       beside);
    } else if (largest < corner) {
        growing_format(remarks,
                       "warning: light arrives up to %.4g mm from the axis; the corners of the "
                       "film, at %.4g mm, stay dark\n",
                       largest, corner);
    } else if (share < 0.5) {
        growing_format(remarks,
                       "warning: %.2g %% of the rays arrive: the pupil is too small to be "
                       "followed over the film, and some of the light may be missing%s\n",
                       100 * share,
                       isnan(input->time) ? ": the time, which rests on it, may be far too long"
                                          : "");
    }
}

struct film_question render_film(const struct render_input *input, const struct analysis_case *one)
{
    return (struct film_question){.setup = one->setup,
                                  .width = input->sensor.size.width,
                                  .height = input->sensor.size.height,
                                  .blades = {.count = (unsigned)input->blades,
                                             .turn = input->blade_turn,
                                             .rounding = input->blade_rounding},
                                  .model = (enum lens_model)input->model};
}
