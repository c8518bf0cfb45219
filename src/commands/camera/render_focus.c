/* commands/camera/render_focus.c - a lens focused on a distance, as a whole or by its gaps. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"
#include "commands/lens/focus_gaps.h"
#include "commands/photo/photo_lens.h"
#include "optics/conjugates.h"
#include "optics/focusing.h"
#include "trace/pupil/focus.h"

const struct word render_focus_ats[] = {
    [FOCUS_AT_THICK] = {"thick", "the image of the thick lens, by rays near the axis"},
    [FOCUS_AT_SHARPEST] = {"sharpest", "the sharpest real image on the axis"},
    {NULL, NULL},
};

/* -------- the whole lens -------- */

/*
 * What the distance says: from the first vertex, mm.
 *
 * Errors    ERROR_DOMAIN: no stop, a card within the focal length; as photo_lens_single,
 *           distance_to_principal and conjugates_working_distance
 */
static bool render_focus_find_object(const struct render_input *input, struct arena *arena,
                                     double *object, struct error *error)
{
    const struct photo_lens_question question = {.lens = input->question.lens,
                                                 .position = input->question.position,
                                                 .focal = {NAN, NAN},
                                                 .wavelength = NAN,
                                                 .fnumber = NAN,
                                                 .pupil = NAN,
                                                 .from = input->from};
    struct photo_lens lens;
    double s;
    if (input->question.lens.lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "the lens has no stop: how much light comes is not known");
        return lens_hint_stop(error);
    }
    if (!photo_lens_single(&question, PHOTO_LENS_OWN_PUPILS, arena, &lens, error) ||
        !distance_to_principal(lens.f, lens.P, input->distance, &lens.measuring, &s, error)) {
        return false;
    }
    if (s <= lens.f) {
        return fail(error, ERROR_DOMAIN,
                    "the subject lies %.6g mm before the front principal plane: that must be more "
                    "than the focal length, %.6g mm",
                    s, lens.f);
    }
    return conjugates_working_distance(s, lens.measuring.front, object, error);
}

/* -------- gaps -------- */

/* A lens that is focused by its gaps, and what of it is asked for. */
struct focus_movement {
    struct focus_mechanism focusing;
    struct conjugate_question question;
    double fnumber; /* NaN = that of the lens */
    struct arena *arena;
};

/* A state of it. */
struct render_focus_state {
    struct focused focused;
    double object;     /* before the first vertex, mm */
    double aberration; /* from the paraxial to the sharpest image, mm */
};

static bool find_aberration(const struct focus_movement *moving, struct render_focus_state *state,
                            struct error *error)
{
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
    state->aberration = setup.image - setup.first.image;
    return true;
}

/*
 * Bring the paraxial image to a plane `shift` before that of the film.
 *
 * Errors    as focus_solve; ERROR_DOMAIN: an object that is not before the lens
 */
static bool move_gaps(const struct focus_movement *moving, double shift,
                      struct render_focus_state *state, struct error *error)
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
static bool sharpen(const struct focus_movement *moving, struct render_focus_state *state,
                    struct error *error)
{
    enum { TURNS = 30 };
    const double enough = 1e-9; /* mm */
    double shift = 0, before = 0, off_before = 0;
    for (int turn = 0; turn < TURNS && isfinite(shift); turn++) {
        if (turn > 0 && !move_gaps(moving, shift, state, error)) {
            return error_prefix(error, "the sharpest image: ");
        }
        if (!find_aberration(moving, state, error)) {
            return false;
        }
        const double off = state->aberration - shift;
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
    struct render_focus_state state;
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
        *(move_gaps(&tried, 0, &state, &ignored) ? &far : &near) = *distance;
    }
    return is_found ? error_hint(error, "the least {--distance} is %.6g mm", far) : false;
}

/* The lens in the only position that is asked for. */
static bool render_focus_find_lens(const struct render_input *input, struct arena *arena,
                                   const struct lens **lens, struct error *error)
{
    const size_t *positions;
    size_t count;
    if (!lens_positions(input->question.lens.lens, input->question.position, arena, &positions,
                        &count, error)) {
        return false;
    }
    *lens = lens_at_position(input->question.lens.lens, positions[0], arena);
    return true;
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
    struct render_focus_state state;
    if (!render_focus_find_lens(input, arena, &lens, error)) {
        return false;
    }
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

bool render_focus(const struct render_input *input, struct arena *arena,
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
    return render_focus_find_object(input, arena, &question->object, error);
}
