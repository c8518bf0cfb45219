/* commands/analysis/analysis_cursor.c - a question case by case and field by field. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_cursor.h"

#include "base/number.h"
#include "report/row.h"

#include <stdlib.h>
#include <string.h>

/* -------- several threads -------- */

/* Work on a case, and what each thread has of it. */
struct case_division {
    struct analysis_case *cases;
    analysis_work *work;
    void *context;
};

static void do_items(void *context, const struct parallel_piece *piece)
{
    const struct case_division *dividing = context;
    for (size_t i = piece->begin; i < piece->end; i++) {
        dividing->work(&dividing->cases[piece->thread], i, dividing->context);
    }
}

void analysis_divide(const struct analysis_case *one, size_t count, analysis_work *work,
                     void *context)
{
    struct arena *arena = one->setup->arena;
    const size_t all = one->threads > 1 ? (size_t)one->threads : 1;
    const size_t threads = all < count ? all : count;
    if (threads <= 1) {
        for (size_t i = 0; i < count; i++) {
            work(one, i, context);
        }
        return;
    }
    struct parallel *parallel = ARENA_NEW(arena, struct parallel);
    struct case_division dividing = {ARENA_ARRAY(arena, threads, struct analysis_case), work,
                                     context};
    parallel->threads = (int)threads;
    for (size_t i = 0; i < threads; i++) {
        struct setup *apart = ARENA_NEW(arena, struct setup);
        *apart = setup_apart(one->setup, &parallel->arenas[i]);
        dividing.cases[i] = *one;
        dividing.cases[i].setup = apart;
        dividing.cases[i].threads = (int)(all / threads);
    }
    parallel_pieces(parallel, count, 1, do_items, &dividing);
    for (size_t i = 0; i < threads; i++) {
        arena_adopt(arena, &parallel->arenas[i]);
    }
}

/* -------- cases -------- */

static bool analysis_cursor_check(const struct analysis_question *question,
                                  const struct analysis_policy *policy, struct error *error)
{
    const bool angle = analysis_is_given(question->field, question->field_x);
    const double quarter = PI / 2, x = fabs(question->field_x), y = fabs(question->field);
    if (angle && analysis_is_given(question->height, question->height_x)) {
        return fail(error, ERROR_USAGE, "{--field} and {--height} exclude each other");
    }
    if (x > 0 && y > 0 && !(x < quarter && y < quarter)) {
        return fail(error, ERROR_DOMAIN,
                    "{--field} and {--field-x}: where neither is 0 both must be below 90 degrees");
    }
    if (question->spectrum.text != NULL && policy->one_wavelength) {
        return fail(error, ERROR_USAGE, "{--spectrum}: this is an answer for one wavelength");
    }
    if (!isnan(question->fnumber) && question->lens.lens != NULL &&
        question->lens.lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "{--aperture}: the lens has no stop");
        return lens_hint_stop(error);
    }
    return true;
}

/* Beyond it squares of distances overflow; the lens has the same limit. */
static const double farthest_image = 1e100;

static bool analysis_place(const struct analysis_question *question,
                           const struct analysis_policy *policy, struct setup *setup,
                           struct error *error)
{
    if (policy->no_image) {
        return true;
    }
    if (!lens_place_image(setup, &question->focus, error)) {
        return false;
    }
    if (!isnan(question->defocus)) {
        setup->image += question->defocus;
        if (isnan(setup->image)) {
            return fail(
                error, ERROR_DOMAIN,
                "{--defocus}: there is no image plane to move, the image is infinitely far away");
        }
    }
    if (fabs(setup->image) > farthest_image) {
        return fail(error, ERROR_DOMAIN,
                    "the image plane lies %.4g mm from the last vertex: at most 1e100 mm",
                    setup->image);
    }
    return true;
}

const char *analysis_spectrum_words(const struct setup *setup)
{
    const char *words = NULL;
    for (size_t i = 0; i < setup->wavelength_count && setup->wavelength_count > 1; i++) {
        words = arena_printf(setup->arena, "%s%s%.7g nm x %.6g", words != NULL ? words : "",
                             words != NULL ? ", " : "", 1000 * setup->wavelengths[i].wavelength,
                             setup->wavelengths[i].weight);
    }
    return words;
}

bool analysis_next_case(struct analysis_cursor *at, struct error *error)
{
    const struct analysis_question *question = at->question;
    const struct analysis_policy *policy = at->policy;
    struct arena *arena = at->run->arena;
    error->code = ERROR_NONE;
    if (at->positions == NULL && !(analysis_cursor_check(question, policy, error) &&
                                   lens_positions(question->lens.lens, question->position, arena,
                                                  &at->positions, &at->position_count, error))) {
        return false;
    }
    if (at->next_position == at->position_count) {
        return false;
    }
    struct analysis_case *one = ARENA_NEW(arena, struct analysis_case);
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct setup_field *field = ARENA_NEW(arena, struct setup_field);
    const bool height = analysis_is_given(question->height, question->height_x);
    const bool asked = height || analysis_is_given(question->field, question->field_x);
    *field = lens_field(FIELD_ANGLE, question->field_x, question->field, question->section);
    if (height) {
        *field = lens_field(question->real ? FIELD_REAL : FIELD_IMAGE, question->height_x,
                            question->height, question->section);
    }
    const struct setup_question of = {
        .lens = question->lens.lens,
        .position = at->positions[at->next_position++],
        .section = (enum lens_section)question->section,
        .object = isnan(question->object) ? NULL : &question->object,
        .wavelength =
            question->wavelength.name != NULL ? question->wavelength.wavelength : (double)NAN,
        .wavelengths = policy->wavelengths,
        .spectrum = question->spectrum.items,
        .spectrum_count = question->spectrum.count,
        .fnumber = question->fnumber,
        .fields = field,
        .field_count = asked,
        /* an axis that is asked for is not taken for a field that nobody states */
        .field_policy = asked && policy->fields == FIELDS_EDGE ? FIELDS_LARGEST : policy->fields,
        .takes_telecentric = true,
        .leaves_stop = policy->is_narrow,
    };
    if (!setup_open(&of, arena, setup, error) || !analysis_place(question, policy, setup, error)) {
        return false;
    }
    const char *both = lens_warnings_join(
        question->lens.warning, first_order_warning(setup->lens, setup->arena), setup->arena);
    const char *width =
        question->no_clip ? NULL : setup_width_warning(setup, question->fnumber, setup->arena);
    both = lens_warnings_join(both, setup->warning, setup->arena);
    if (!policy->is_narrow && question->aim != ANALYSIS_AIM_ENTRANCE) {
        both = lens_warnings_join(both, setup_stop_warning(setup, setup->arena), setup->arena);
    }
    *one = (struct analysis_case){.question = question,
                                  .setup = setup,
                                  .clip = !question->no_clip,
                                  .warning = lens_warnings_join(both, width, setup->arena),
                                  .spectrum = analysis_spectrum_words(setup)};
    one->threads = at->run->threads;
    at->one = one;
    at->next_field = 0;
    return true;
}

/* -------- fields -------- */

struct analysis_cursor analysis_begin(const void *input, const struct analysis_policy *policy,
                                      struct run *run)
{
    return analysis_begin_finding(input, policy, run, NULL, 0);
}

struct analysis_cursor analysis_begin_finding(const void *input,
                                              const struct analysis_policy *policy, struct run *run,
                                              analysis_find *find, size_t found_size)
{
    return (struct analysis_cursor){.input = input,
                                    .question = input,
                                    .policy = policy,
                                    .run = run,
                                    .find = find,
                                    .found_size = found_size,
                                    .keeps_lost = analysis_makes_many(input, policy->fields)};
}

static void analysis_find_field(const struct analysis_case *one, size_t field, void *context)
{
    const struct analysis_cursor *at = context;
    at->errors[field].code = ERROR_NONE;
    at->find(at, one, field, at->all_found + field * at->found_size, &at->errors[field]);
}

bool analysis_keep_lost(struct analysis_cursor *at, struct error *error)
{
    struct run *run = at->run;
    if (error->code == ERROR_USAGE || (!at->keeps_lost && at->policy->fields != FIELDS_ALL)) {
        return false;
    }
    error_prefix(error,
                 "%s: ", lens_field_words(&at->one->setup->fields[at->field].point, run->arena));
    if (!at->keeps_lost) {
        return false;
    }
    run->shortfall = *error;
    at->lost = arena_printf(run->arena, "%s", error->message);
    error->code = ERROR_NONE;
    return true;
}

bool analysis_next_field(struct analysis_cursor *at, struct error *error)
{
    const size_t count = at->one->setup->field_count;
    error->code = ERROR_NONE;
    if (at->next_field == count) {
        return false;
    }
    at->field = at->next_field++;
    at->lost = NULL;
    if (at->find == NULL) {
        return true;
    }
    const bool divides = at->one->threads > 1;
    if (at->field == 0) {
        at->all_found = arena_array(at->one->setup->arena, count, at->found_size);
        at->errors = ARENA_ARRAY(at->one->setup->arena, count, struct error);
        if (divides) {
            analysis_divide(at->one, count, analysis_find_field, at);
        }
    }
    if (!divides) {
        analysis_find_field(at->one, at->field, at);
    }
    at->found = at->all_found + at->field * at->found_size;
    if (at->errors[at->field].code == ERROR_NONE) {
        return true;
    }
    *error = at->errors[at->field];
    return analysis_keep_lost(at, error);
}

bool analysis_next(struct analysis_cursor *at, struct error *error)
{
    error->code = ERROR_NONE;
    while (at->one == NULL || !analysis_next_field(at, error)) {
        if (error->code != ERROR_NONE || !analysis_next_case(at, error)) {
            return false;
        }
    }
    return true;
}

/* -------- rows -------- */

struct analysis_point analysis_point_of(const struct analysis_case *one, size_t field)
{
    const struct setup *setup = one->setup;
    struct analysis_point point = (struct analysis_point){
        .position = setup->position,
        .spectrum = one->spectrum,
        .focus = setup->focus,
        .lens = setup->lens->title,
        .warning = one->warning,
        .wavelength = setup->wavelength_count == 1 ? setup->wavelengths[0].wavelength : (double)NAN,
        .field = NAN,
        .field_x = NAN,
        .height = NAN,
        .height_x = NAN,
        .image = setup->image,
        .defocus = one->question->defocus,
    };
    const struct field_point *at = &one->setup->fields[field].point;
    const bool angle = at->kind == FIELD_ANGLE || at->kind == FIELD_NONE;
    point.field = angle ? at->value[1] : (double)NAN;
    point.field_x = angle ? at->value[0] : (double)NAN;
    point.height = angle ? (double)NAN : at->value[1];
    point.height_x = angle ? (double)NAN : at->value[0];
    return point;
}

struct bundle_question analysis_bundle(const struct analysis_case *one, size_t field)
{
    const struct analysis_question *asked = one->question;
    return (struct bundle_question){.setup = one->setup,
                                    .field = &one->setup->fields[field].point,
                                    .clip = one->clip,
                                    .from_entrance = asked->aim == ANALYSIS_AIM_ENTRANCE,
                                    .weight = asked->weight == ANALYSIS_WEIGHT_BEAM ? WEIGHT_BEAM
                                                                                    : WEIGHT_PUPIL,
                                    .pattern = (enum pattern)asked->pattern,
                                    .seed = (uint64_t)asked->seed};
}

void analysis_begin_row(const struct analysis_cursor *at, const struct sheet *sheet, void *row)
{
    struct analysis_point point = analysis_point_of(at->one, at->field);
    if (at->lost != NULL) {
        point.warning = at->lost;
    }
    row_clear(sheet, row);
    memcpy(row, &point, sizeof point);
}

void analysis_warn(const struct analysis_cursor *at, struct analysis_point *point,
                   const char *words)
{
    point->warning = lens_warnings_join(point->warning, words, at->run->arena);
}

/* -------- words -------- */

const char *analysis_case_words(const struct analysis_case *one, struct arena *arena)
{
    const struct analysis_question *question = one->question;
    const char *words = one->setup->position;
    const struct {
        bool shown;
        const char *before;
        double value;
        const char *behind;
    } parts[] = {
        {question->wavelength.name != NULL, "", 1000 * one->setup->wavelengths[0].wavelength,
         " nm"},
        {!isnan(question->object), "object at ", question->object, " mm"},
        {!isnan(question->fnumber), "f/", question->fnumber, ""},
        {!isnan(question->defocus), "defocus ", question->defocus, " mm"},
    };
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].shown) {
            words = arena_printf(arena, "%s%s%s%.6g%s", words != NULL ? words : "",
                                 words != NULL ? ", " : "", parts[i].before, parts[i].value,
                                 parts[i].behind);
        }
    }
    return words;
}

const char *analysis_aperture_words(const struct first_order *first, struct arena *arena)
{
    if (isfinite(first->fnumber)) {
        const double working = first->working_fnumber;
        const bool is_near = fabs(working - first->fnumber) > 0.01 * first->fnumber;
        return is_near && isfinite(working)
                   ? arena_printf(arena, "f/%.4g (working f/%.4g)", first->fnumber, working)
                   : arena_printf(arena, "f/%.4g", first->fnumber);
    }
    if (isfinite(first->entrance_diameter)) {
        return arena_printf(arena, "entrance pupil %.4g mm", fabs(first->entrance_diameter));
    }
    /* afocal, and its beam is that of the object alone */
    const double slope = atan(first->marginal_v / first->index_object);
    return isnan(slope) ? NULL
                        : arena_printf(arena, "NA %.4g in object space",
                                       fabs(first->index_object * sin(slope)));
}

/* "486.1, 587.6, 656.3 nm", ascending, or where they are many the first and the last. */
static const char *wavelengths_words(const struct setup *setup, struct arena *arena)
{
    enum { MOST = 5 };
    const size_t count = setup->wavelength_count;
    double *list = ARENA_ARRAY(arena, count, double);
    const char *words = "";
    for (size_t i = 0; i < count; i++) {
        list[i] = 1000 * setup->wavelengths[i].wavelength;
    }
    qsort(list, count, sizeof *list, analysis_ascending);
    if (count == 1) {
        return arena_printf(arena, "%.6g nm", list[0]);
    }
    if (count > MOST) {
        return arena_printf(arena, "%zu wavelengths from %.5g to %.5g nm", count, list[0],
                            list[count - 1]);
    }
    for (size_t i = 0; i < count; i++) {
        words = arena_printf(arena, "%s%s%.*f", words, i > 0 ? ", " : "", list[i] < 1000 ? 1 : 0,
                             list[i]);
    }
    return ARENA_JOIN(arena, words, " nm");
}

void analysis_setting_words(const struct analysis_case *one, const char *words[SETTING_WORDS],
                            struct arena *arena)
{
    const struct setup *setup = one->setup;
    const double defocus = one->question->defocus, object = one->question->object;
    const double plane = setup->image - (isnan(defocus) ? 0 : defocus);
    const char *focus = setup->focus != NULL ? setup->focus : "none";
    words[SETTING_POSITION] = setup->position;
    words[SETTING_APERTURE] = analysis_aperture_words(&setup->first, arena);
    words[SETTING_WAVELENGTHS] = wavelengths_words(setup, arena);
    words[SETTING_OBJECT] = isnan(object) ? NULL : arena_printf(arena, "object at %.6g mm", object);
    words[SETTING_PLANE] =
        isnan(plane)
            ? "image at infinity"
            : arena_printf(arena, "image plane %s, %.6g mm from the last vertex", focus, plane);
    words[SETTING_DEFOCUS] =
        isnan(defocus) ? NULL : arena_printf(arena, "defocus %+.4g mm", defocus + 0.0);
}

const char *analysis_figure_words(const struct analysis_case *one, unsigned parts,
                                  struct arena *arena)
{
    static const unsigned wanted[SETTING_WORDS] = {[SETTING_POSITION] = ~0u,
                                                   [SETTING_APERTURE] = FIGURE_APERTURE,
                                                   [SETTING_WAVELENGTHS] = FIGURE_WAVELENGTHS,
                                                   [SETTING_OBJECT] = ~0u,
                                                   [SETTING_PLANE] = FIGURE_PLANE,
                                                   [SETTING_DEFOCUS] = FIGURE_DEFOCUS};
    const char *list[SETTING_WORDS], *words = "";
    analysis_setting_words(one, list, arena);
    for (size_t i = 0; i < SETTING_WORDS; i++) {
        if (list[i] != NULL && (parts & wanted[i]) != 0) {
            words = ARENA_JOIN(arena, words, words[0] != '\0' ? "; " : "", list[i]);
        }
    }
    return words;
}

const char *analysis_place_words(const struct field_point *at, struct arena *arena)
{
    const struct unit *degree = unit_find(&dimension_angle, text_of("deg"));
    const bool angle = at->kind == FIELD_ANGLE;
    const double x = angle ? unit_from_own(degree, at->value[0]) : at->value[0];
    const double y = angle ? unit_from_own(degree, at->value[1]) : at->value[1];
    const char *unit = angle ? "\xc2\xb0" : " mm";
    if (at->kind == FIELD_NONE) {
        return "axis";
    }
    return x != 0 ? arena_printf(arena, "x %.4g%s, y %.4g%s", x, unit, y + 0.0, unit)
                  : arena_printf(arena, "%.4g%s", y + 0.0, unit);
}

const char *analysis_field_words(const struct analysis_case *one, size_t field, bool several,
                                 struct arena *arena)
{
    const struct field_point *at = &one->setup->fields[field].point;
    const char *words = several ? analysis_case_words(one, arena) : one->setup->position;
    const char *place = analysis_place_words(at, arena);
    return words != NULL ? arena_printf(arena, "%s, %s", place, words) : place;
}

const char *wave_reference_words(const struct analysis_case *one, enum wave_about about,
                                 struct arena *arena)
{
    const struct setup *setup = one->setup;
    const bool one_wavelength = setup->wavelength_count == 1;
    if (about == WAVE_CENTROID) {
        return one_wavelength ? "the centroid" : "the centroid of all wavelengths";
    }
    if (about == WAVE_BEST) {
        return one_wavelength ? "the best-fitting sphere"
                              : "the best-fitting sphere of all wavelengths";
    }
    return arena_printf(arena, "the chief ray at %.4g nm", 1000 * setup->wavelengths[0].wavelength);
}

const char *analysis_curve_words(const char *title, const char *name, bool one_lens,
                                 struct arena *arena)
{
    if (name == NULL) {
        return title;
    }
    return one_lens ? name : arena_printf(arena, "%s, %s", title, name);
}

size_t analysis_values_of(const struct artifact_job *job, size_t offset, size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < job->count; i++) {
        const char *value = (const char *)job->inputs[i] + offset;
        size_t k = 0;
        while (k < i && memcmp(value, (const char *)job->inputs[k] + offset, size) != 0) {
            k++;
        }
        count += k == i;
    }
    return count;
}

int analysis_ascending(const void *first, const void *second)
{
    const double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

const char *analysis_number(double value, struct arena *arena)
{
    char number[NUMBER_LENGTH];
    return arena_string(arena, number,
                        (size_t)(number_write_plain(number, value, 3, false) - number));
}
