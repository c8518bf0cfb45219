/* commands/photo/photo_lens.c - a real lens as photographic commands see it. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/photo_lens.h"

#include <string.h>

const struct photo_real photo_real_none = {.focal = NAN, .hiatus = 0, .wavelength = NAN, .rear = 0};

bool photo_lens_makes_many(const struct photo_lens_question *question)
{
    return lens_positions_several(question->lens.lens, question->position);
}

bool photo_lens_varies(const struct photo_lens_question *question, const char *option)
{
    return photo_lens_makes_many(question) && strcmp(option, "position") == 0;
}

/* Of its fields nothing is used. */
static const struct lens_policy policy = {
    .wavelengths = WAVELENGTHS_PRIMARY, .fields = FIELDS_LARGEST, .is_narrow = true};

/* What the lens is in a position, worked out once as long as nothing changes. */
static bool photo_lens_find(const struct photo_lens_question *question, size_t position,
                            double wavelength, struct arena *arena, const struct lens_memo **found,
                            struct error *error)
{
    const struct lens_value *value = &question->lens;
    struct lens_memo *memo = &value->memo[position];
    *found = memo;
    if (memo->is_known && memo->wavelength == wavelength && memo->section == question->section) {
        return true;
    }
    bool several = value->lens->position_count > 0;
    const struct lens_question asked = {
        .lens = *value,
        .wavelength = {wavelength, "of the lens"},
        .fnumber = NAN,
        .field = NAN,
        .position = several ? value->lens->positions[position] : NULL,
        .section = question->section,
    };
    memo->is_known = false;
    struct lens_cursor at = lens_begin(&asked, &policy, arena);
    if (!lens_next(&at, error)) {
        return false;
    }
    memo->first = at.one.light.first;
    memo->width = setup_width(at.one.setup, at.one.setup->first.fnumber, arena);
    memo->warning = at.one.warning;
    if (memo->warning != NULL) {
        struct text warning = text_of(memo->warning);
        memo->warning = arena_string(value->arena, warning.start, warning.length);
    }
    memo->wavelength = wavelength;
    memo->section = question->section;
    memo->is_known = true;
    return true;
}

/* Can the formulas of photography take it? */
static bool photo_lens_check_power(const struct first_order *first, struct error *error)
{
    if (first->index_image < 0) {
        return fail(error, ERROR_DOMAIN,
                    "its image lies on the subject's side, after an odd number of mirrors");
    }
    if (!(fabs(first->index_image - first->index_object) <= 1e-12 * first->index_object)) {
        return fail(error, ERROR_DOMAIN,
                    "it stands between media of index %.6g and %.6g: the formulas of photography "
                    "want the same on both sides",
                    first->index_object, first->index_image);
    }
    if (first->is_afocal) {
        return fail(error, ERROR_DOMAIN, "it is afocal: it makes no real image");
    }
    return first->rear_focal > 0 ||
           fail(error, ERROR_DOMAIN, "its focal length is %.6g mm: it makes no real image",
                first->rear_focal);
}

/* Its own pupil magnification, unless another is given. */
static bool take_pupil(const struct first_order *first, const struct photo_lens_question *question,
                       int use, struct photo_lens *lens, struct error *error)
{
    lens->P = question->pupil > 0 ? question->pupil : first->pupil_magnification;
    if (isnan(lens->P) && (use & PHOTO_LENS_WITHOUT_PUPILS) != 0) {
        return true;
    }
    const bool may_say = (use & PHOTO_LENS_OWN_PUPILS) == 0;
    if (isnan(lens->P)) {
        fail(error, ERROR_USAGE, "it has no stop, so that its pupils are not known");
        return may_say &&
               error_hint(error,
                          "{--pupil} says how large the exit pupil is over the entrance pupil");
    }
    if (!(lens->P > 0 && lens->P < INFINITY)) {
        fail(error, ERROR_DOMAIN, "its pupil magnification is %.6g: it must be above 0 and finite",
             lens->P);
        return may_say && error_hint(error, "{--pupil} takes another one in its place");
    }
    return true;
}

/* T-stop over f-number by what its source states, wide open: it loses light, it makes none. */
static bool take_t_ratio(const struct first_order *first, struct photo_lens *lens,
                         struct error *error)
{
    const double rounded = 0.99; /* as T-stops and f-numbers are marked */
    double N = lens_stated(lens->lens, STATED_FNUMBER, lens->position);
    double T = lens_stated(lens->lens, STATED_TSTOP, lens->position);
    N = isnan(N) ? first->fnumber : N;
    lens->t_ratio = isnan(T) || !(N > 0) ? (double)NAN : fmax(T / N, 1);
    return !(T < rounded * N) ||
           fail(error, ERROR_DOMAIN,
                "its source states T%.4g at f/%.4g: a T-stop cannot be below the f-number", T, N);
}

static bool work_out(const struct photo_lens_question *question, size_t position, int use,
                     struct arena *arena, struct photo_lens *lens, struct error *error)
{
    const struct lens *real = question->lens.lens;
    const struct lens_memo *found;
    bool has_light = question->wavelength > 0;
    bool has_fnumber = question->fnumber > 0 || (use & PHOTO_LENS_SOLVES_FNUMBER) != 0;
    double wavelength =
        has_light ? wavelength_micrometres(question->wavelength) : lens_primary_wavelength(real);
    if (!photo_lens_find(question, position, wavelength, arena, &found, error)) {
        return false;
    }
    const struct first_order *first = &found->first;
    *lens = (struct photo_lens){
        .f = first->rear_focal,
        .N = has_fnumber ? question->fnumber : first->fnumber,
        .wavelength = has_light ? question->wavelength : wavelength_millimetres(wavelength),
        .measuring = {(enum distance_from)question->from,
                      first->length + first->rear_principal - first->front_principal,
                      first->front_principal},
        .lens = real,
        .position = position,
        .first = first,
    };
    const bool is_asked = (use & PHOTO_LENS_SOLVES_FNUMBER) == 0 && question->fnumber > 0;
    const char *width = is_asked ? setup_width_text(&found->width, question->fnumber, arena) : NULL;
    struct photo_real *said = ARENA_NEW(arena, struct photo_real);
    *said = (struct photo_real){
        .title = real->title != NULL ? real->title : question->lens.name,
        .kind = real->kind,
        .position = real->position_count > 0 ? real->positions[position] : NULL,
        .warning = lens_warnings_join(found->warning, width, arena),
        .focal = lens->f,
        .hiatus = lens->measuring.hiatus,
        .wavelength = lens->wavelength,
        .rear = first->rear_principal,
    };
    lens->real = said;
    return photo_lens_check_power(first, error) && take_t_ratio(first, lens, error) &&
           take_pupil(first, question, use, lens, error);
}

/* The lens in one position; what is wrong with it, with its name before. */
static bool take_lens(const struct photo_lens_question *question, size_t position, int use,
                      struct arena *arena, struct photo_lens *lens, struct error *error)
{
    return work_out(question, position, use, arena, lens, error) ||
           error_prefix(error, "%.60s: ", question->lens.name);
}

static bool photo_lens_check_question(const struct photo_lens_question *question,
                                      struct error *error)
{
    if (question->lens.lens == NULL) {
        return fail(error, ERROR_USAGE, "{--%s} needs {--lens}",
                    question->position != NULL ? "position" : "section");
    }
    return !(question->focal.length > 0) ||
           fail(error, ERROR_USAGE,
                "{--lens} and {--focal-length} exclude each other: the lens has its own");
}

bool photo_lens_single(const struct photo_lens_question *question, int use, struct arena *arena,
                       struct photo_lens *lens, struct error *error)
{
    const size_t *positions;
    size_t count;
    if (photo_lens_is_thin(question)) {
        *lens = photo_lens_thin(question);
        return true;
    }
    if (!photo_lens_check_question(question, error) ||
        !lens_positions(question->lens.lens, question->position, arena, &positions, &count,
                        error)) {
        return false;
    }
    if (count > 1) {
        return fail(error, ERROR_USAGE, "one drawing shows one position, not '%s'",
                    question->position);
    }
    return take_lens(question, positions[0], use, arena, lens, error);
}

bool photo_lens_visit(const struct photo_lens_question *question, int use, struct run *run,
                      photo_lens_answer *answer, const void *input, struct error *error)
{
    const size_t *positions;
    size_t count;
    struct photo_lens lens;
    if (!photo_lens_check_question(question, error) ||
        !lens_positions(question->lens.lens, question->position, run->arena, &positions, &count,
                        error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (!take_lens(question, positions[i], use, run->arena, &lens, error) ||
            !answer(input, &lens, run, error)) {
            return false;
        }
    }
    return true;
}

bool photo_lens_hint_virtual(const struct photo_lens *lens, double s, struct error *error)
{
    if (error->code != ERROR_DOMAIN || !(s > 0 && s <= lens->f)) {
        return false;
    }
    if (lens->real->title != NULL) {
        return error_hint(error, "its virtual image: lenscalc conjugate LENS --object %.6gmm", s);
    }
    return error_hint(error, "its virtual image: lenscalc conjugate -f %.6gmm --object %.6gmm",
                      lens->f, s);
}
