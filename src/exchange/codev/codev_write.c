/* exchange/codev/codev_write.c - a lens as a CODE V sequence file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include "exchange/keep_notes.h"
#include "exchange/writing.h"
#include "file/decimal.h"

#include <math.h>
#include <string.h>

enum { LINE = 72 };

/* A lens being written; what is no glass of CODE V goes into a catalogue of the file. */
struct output {
    struct writing writing;
    struct foreign_job *job;
    const struct lens *lens;
    const struct medium **own; /* media of the file's catalogue */
    size_t own_count;
};

static void put(struct output *output, struct text text)
{
    growing_text(&output->writing.text, text);
}

static void put_string(struct output *output, const char *string)
{
    put(output, text_of(string));
}

/* Numbers of one command; long commands go on in the next line. */
static void put_number(struct output *output, size_t *column, struct text number)
{
    if (*column + number.length + 2 > LINE) {
        put_string(output, "&\n  ");
        *column = 2;
    }
    put_string(output, " ");
    put(output, number);
    *column += number.length + 1;
}

static void put_command(struct output *output, const char *name, struct text value)
{
    put_string(output, name);
    put_string(output, " ");
    put(output, value);
    put_string(output, "\n");
}

static bool put_text(struct output *output, const char *name, const char *string,
                     struct error *error)
{
    bool has_lost = false;
    const char *quote = strchr(string, '\'') == NULL ? "'" : "\"";
    const struct text text = writing_quotable(&output->writing, string, quote, &has_lost);
    put_string(output, arena_printf(output->job->arena, "%s %s", name, quote));
    put(output, text);
    put_string(output, quote);
    put_string(output, "\n");
    return !has_lost || foreign_lose(output->job, error,
                                     "a text with both kinds of quotes" LOSS_INSTEAD
                                     "the double ones are left out");
}

/* nd = 1.ddd and Vd = vv.v as ddd.vvv; empty where nd or Vd do not fit. */
static struct text code_of(const struct output *output, const struct medium *medium)
{
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    const char *digits = "0123456789";
    bool fits = index.length > 2 && index.start[0] == '1' && index.start[1] == '.' &&
                medium->abbe.hi > 0 && medium->abbe.hi < 100 && abbe.length < 40 &&
                index.length < 40;
    for (size_t i = 2; fits && i < index.length; i++) {
        fits = strchr(digits, index.start[i]) != NULL;
    }
    for (size_t i = 0; fits && i < abbe.length; i++) {
        fits = abbe.start[i] == '.' || strchr(digits, abbe.start[i]) != NULL;
    }
    if (!fits) {
        return (struct text){"", 0};
    }
    struct text hundredth = decimal_shift(abbe, -2, output->job->arena);
    const char *point = memchr(hundredth.start, '.', hundredth.length);
    const char *zeros = index.length == 3 ? "00" : index.length == 4 ? "0" : "";
    return text_of(arena_printf(output->job->arena, "%.*s%s%.*s", (int)index.length - 2,
                                index.start + 2, zeros,
                                (int)(hundredth.start + hundredth.length - point), point));
}

/* The word for a medium behind a surface, with a blank before it; nothing for air. */
static bool put_medium(struct output *output, const struct medium *medium, struct error *error)
{
    struct text name, catalog, code = {"", 0};
    if (medium_is_air(medium)) {
        return true;
    }
    put_string(output, " ");
    if (medium->kind == MEDIUM_GLASS) {
        writing_glass(&output->writing, output->job, medium, &name, &catalog);
        bool quoted = memchr(name.start, ' ', name.length) != NULL;
        put_string(output, quoted ? "'" : "");
        put(output, name);
        put_string(output, catalog.length > 0 ? "_" : "");
        put(output, catalog);
        put_string(output, quoted ? "'" : "");
        return true;
    }
    for (size_t i = 0; i < output->own_count; i++) {
        if (medium_is_same(output->own[i], medium)) {
            growing_format(&output->writing.text, "'N%zu'", i + 1);
            return true;
        }
    }
    code = code_of(output, medium);
    if (code.length > 0) {
        put(output, code);
        return true;
    }
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    put(output, index);
    put_string(output, ":");
    put(output, abbe);
    return foreign_lose(output->job, error,
                        "a glass whose nd is not from 1 to 2 or whose Vd is not from 0 to "
                        "100 has no code" LOSS_INSTEAD "it is written nd:Vd");
}

/* A table of indices or one index for all light, as a glass of the file's own catalogue. */
static void put_own(struct output *output, size_t index)
{
    const struct medium *medium = output->own[index];
    const struct lens *lens = output->lens;
    struct writing *writing = &output->writing;
    bool is_table = medium->kind == MEDIUM_TABLE;
    size_t count = is_table ? medium->point_count : lens->wavelength_count;
    size_t column = 5;
    put_string(output, "  PWL");
    for (size_t i = 0; i < count; i++) {
        double wave = is_table ? medium->points[i].wavelength : lens->wavelengths[i].wavelength;
        const struct text typed = is_table ? (struct text){"", 0} : lens->wavelengths[i].typed;
        put_number(output, &column, writing_wave(writing, wave, typed, 3));
    }
    if (count == 0) {
        put_string(output, " 587.5618");
    }
    growing_format(&writing->text, "\n  'N%zu'", index + 1);
    column = 8;
    for (size_t i = 0; i < count || i == 0; i++) {
        const struct figure figure = {.value = is_table ? medium->points[i].index : medium->index,
                                      .variable = LENS_NONE};
        put_number(output, &column,
                   is_table ? writing_length(writing, &figure, 0) : medium->written);
    }
    put_string(output, "\n");
}

static void add_own(struct output *output, const struct medium *medium)
{
    bool own =
        (medium->kind == MEDIUM_CONSTANT && !medium_is_air(medium)) || medium->kind == MEDIUM_TABLE;
    for (size_t i = 0; i < output->own_count && own; i++) {
        own = !medium_is_same(output->own[i], medium);
    }
    if (own) {
        output->own[output->own_count++] = medium;
    }
}

static void put_catalog(struct output *output)
{
    const struct lens *lens = output->lens;
    output->own = ARENA_ARRAY(output->job->arena, lens->surface_count + 1, const struct medium *);
    add_own(output, &lens->object_medium);
    for (size_t i = 0; i < lens->surface_count; i++) {
        add_own(output, &lens->surfaces[i].medium);
    }
    put_string(output, output->own_count > 0 ? "PRV\n" : "");
    for (size_t i = 0; i < output->own_count; i++) {
        put_own(output, i);
    }
    put_string(output, output->own_count > 0 ? "END\n" : "");
}

static const char *const aperture_words[] = {
    [APERTURE_FNUMBER] = "FNO", [APERTURE_EPD] = "EPD", [APERTURE_NA] = "NAO"};

static void put_values(struct output *output, const char *name, const struct figure *values,
                       int power, bool halve)
{
    size_t column = strlen(name);
    put_string(output, name);
    for (size_t i = 0; i < output->lens->position_count; i++) {
        struct text number = isinf(values[i].value.hi)
                                 ? text_of("0.1e14")
                                 : writing_length(&output->writing, &values[i], power);
        put_number(output, &column, halve ? decimal_half(number, output->job->arena) : number);
    }
    put_string(output, "\n");
}

/* The pupil that the stop's diameter gives, and a comment by which it is read as that stop. */
static bool put_pupil(struct output *output, struct error *error)
{
    struct figure pupil = {.variable = LENS_NONE};
    put_string(output, CODEV_KEEP_NOTE CODEV_STOP_RULES "\n");
    if (!writing_pupil(&output->writing, 0, &pupil)) {
        return foreign_lose(output->job, error,
                            "an aperture that is ruled by a stop without a pupil");
    }
    put_command(output, "EPD", pupil.typed);
    return true;
}

/* The same in every position. */
static void put_pupils(struct output *output)
{
    const struct lens *lens = output->lens;
    struct figure *pupils = ARENA_ARRAY(output->job->arena, lens->position_count, struct figure);
    for (size_t i = 0; i < lens->position_count; i++) {
        pupils[i].variable = LENS_NONE;
        if (!writing_pupil(&output->writing, i, &pupils[i])) {
            return;
        }
    }
    put_values(output, "ZOO EPD", pupils, 1, false);
}

static bool put_aperture(struct output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    enum aperture_kind kind = lens->aperture_kind;
    if (kind == APERTURE_STOP) {
        return put_pupil(output, error);
    }
    if (kind == APERTURE_NONE) {
        return true;
    }
    if (kind == APERTURE_FNUMBER && !lens->object_is_infinite &&
        !foreign_lose(output->job, error,
                      "the f-number of a lens with a near object" LOSS_INSTEAD
                      "CODE V takes it as the "
                      "working one")) {
        return false;
    }
    const struct figure figure = lens->apertures != NULL ? lens->apertures[0] : lens->aperture;
    put_command(output, aperture_words[kind],
                writing_length(&output->writing, &figure, kind == APERTURE_EPD));
    return true;
}

static void put_waves(struct output *output)
{
    const struct lens *lens = output->lens;
    struct writing *writing = &output->writing;
    size_t column = 2;
    put_string(output, "WL");
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        const struct lens_wavelength *one = &lens->wavelengths[i];
        put_number(output, &column, writing_wave(writing, one->wavelength, one->typed, 3));
    }
    put_string(output, lens->wavelength_count == 0 ? " 587.5618\nREF 1\nWTW" : "\nREF 1\nWTW");
    column = 3;
    for (size_t i = 0; i < lens->wavelength_count || i == 0; i++) {
        const struct text weight =
            i < lens->wavelength_count ? lens->wavelengths[i].weight_typed : (struct text){NULL, 0};
        put_number(output, &column, weight.start != NULL ? weight : text_of("1"));
    }
    put_string(output, "\n");
}

static void put_coordinates(struct output *output, int axis)
{
    const struct lens *lens = output->lens;
    size_t column = 3;
    for (size_t i = 0; i < lens->field_count; i++) {
        const struct figure *field = &lens->fields[i].at[axis];
        const bool nothing = field->value.hi == 0 && field->typed.start == NULL;
        put_number(output, &column,
                   nothing                           ? text_of("0.0")
                   : lens->field_kind == FIELD_ANGLE ? writing_degrees(&output->writing, field)
                                                     : writing_length(&output->writing, field, 1));
    }
    put_string(output, "\n");
}

static void put_fields(struct output *output)
{
    static const char *const words[][2] = {[FIELD_ANGLE] = {"XAN", "YAN"},
                                           [FIELD_HEIGHT] = {"XOB", "YOB"},
                                           [FIELD_IMAGE] = {"XIM", "YIM"},
                                           [FIELD_REAL] = {"XRI", "YRI"}};
    const struct lens *lens = output->lens;
    bool weighted = false;
    size_t column = 3;
    for (int axis = 0; axis < 2 && lens->field_kind != FIELD_NONE; axis++) {
        put_string(output, words[lens->field_kind][axis]);
        put_coordinates(output, axis);
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        weighted = weighted || lens->fields[i].weight != 1;
    }
    put_string(output, weighted ? "WTF" : "");
    for (size_t i = 0; i < lens->field_count && weighted; i++) {
        const struct text typed = lens->fields[i].weight_typed;
        put_number(output, &column, typed.start != NULL ? typed : text_of("1"));
    }
    put_string(output, weighted ? "\n" : "");
}

static bool put_header(struct output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    put_string(output, "RDM;LEN\n");
    if (lens->title != NULL && !put_text(output, "TITLE", lens->title, error)) {
        return false;
    }
    keep_notes_write(&output->writing.text, lens, output->writing.scale, CODEV_KEEP_NOTE, "\n");
    for (size_t i = 0; i < lens->note_count; i++) {
        put_string(output, CODEV_KEEP_NOTE CODEV_NOTE);
        put_string(output, lens->notes[i]);
        put_string(output, "\n");
    }
    if (!put_aperture(output, error)) {
        return false;
    }
    growing_format(&output->writing.text, "DIM %s\n",
                   foreign_unit_word(codev_units, output->writing.unit));
    put_waves(output);
    put_fields(output);
    put_string(output, lens->is_telecentric ? "TEL Y\n" : "");
    put_string(output, lens->focus == FOCUS_AFOCAL ? "AFC Y\n" : "");
    put_catalog(output);
    return true;
}

static void put_displacement(struct output *output, const struct displacement *all, bool back)
{
    struct writing *writing = &output->writing;
    struct arena *arena = output->job->arena;
    put_string(output, "  XDE ");
    put(output, writing_length(writing, &all->decenter[0], 1));
    put_string(output, "; YDE ");
    put(output, writing_length(writing, &all->decenter[1], 1));
    put_string(output, "; ZDE 0.0\n  ADE ");
    put(output, decimal_negate(writing_degrees(writing, &all->tilt[0]), arena));
    put_string(output, "; BDE ");
    put(output, decimal_negate(writing_degrees(writing, &all->tilt[1]), arena));
    put_string(output, "; CDE ");
    put(output, writing_degrees(writing, &all->tilt[2]));
    put_string(output, back ? "\n  DAR\n" : "\n");
}

/* ASP has the even powers from r^4 on, SPS ODD all; of a cylinder there is only ASP. */
static const struct asphere {
    const char *head, *conic;
} conic_shape = {"  CON\n", "  K"}, even_shape = {"  ASP\n", "  K"},
  odd_shape = {"  SPS ODD 0.0\n", "  SCO K"};

static bool is_of_asp(int term)
{
    return term > 0 && term < LENS_EVEN;
}

static bool is_term_given(const struct surface *surface, int term)
{
    return (surface->coefficients >> term & 1) != 0;
}

/* The simplest shape that has all the surface's terms; null for a sphere. */
static const struct asphere *shape_of(const struct surface *surface)
{
    bool conic = surface->conic.value.hi != 0 || surface->conic.typed.start != NULL;
    const struct asphere *shape = conic ? &conic_shape : NULL;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        if (is_term_given(surface, i) && is_of_asp(i)) {
            shape = shape == &odd_shape ? shape : &even_shape;
        } else if (is_term_given(surface, i) && surface->coefficient[i].value.hi != 0) {
            shape = &odd_shape;
        }
    }
    return shape;
}

static bool put_asphere(struct output *output, const struct surface *surface, struct error *error)
{
    static const char letters[] = "  ABCDEFGHJ";
    struct writing *writing = &output->writing;
    struct arena *arena = output->job->arena;
    const struct asphere *shape = shape_of(surface);
    bool is_odd = shape == &odd_shape;
    bool conic = surface->conic.value.hi != 0 || surface->conic.typed.start != NULL;
    if (is_odd && !surface_is_round(surface)) {
        return foreign_lose(output->job, error,
                            "CODE V has no cylinder with the coefficient A2 or odd ones");
    }
    if (shape != NULL) {
        put_string(output, shape->head);
        put_command(output, shape->conic,
                    conic ? writing_length(writing, &surface->conic, 0) : text_of("0.0"));
    }
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        int i = surface_term(order);
        if (is_term_given(surface, i) && (is_odd || is_of_asp(i))) {
            put_command(output,
                        is_odd ? arena_printf(arena, "  SCO AR%d", order)
                               : arena_printf(arena, "  %c", letters[order / 2]),
                        writing_length(writing, &surface->coefficient[i], 1 - order));
        }
    }
    return true;
}

static bool put_clear(struct output *output, const struct surface *surface, struct error *error)
{
    if (surface->has_diameter) {
        const struct text diameter = writing_length(&output->writing, &surface->diameter, 1);
        put_command(output, "  CIR", decimal_half(diameter, output->job->arena));
    }
    return codev_put_apertures(&output->writing, output->job, surface, error);
}

static bool put_details(struct output *output, const struct surface *surface, struct error *error)
{
    struct writing *writing = &output->writing;
    bool along_x = surface->curved == CURVED_X;
    if (!surface_is_round(surface)) {
        put_string(output, "  CYL\n");
    }
    if (surface->has_curvature) {
        put_command(output, along_x ? "  CUX" : "  CUY",
                    writing_length(writing, &surface->curvature, -1));
    } else if (along_x && !surface->is_plane) {
        put_command(output, "  RDX", writing_length(writing, &surface->radius, 1));
    }
    if (surface->is_stop) {
        put_string(output, "  STO\n");
    }
    if (!put_clear(output, surface, error)) {
        return false;
    }
    if (surface->name != NULL && !put_text(output, "  SLB", surface->name, error)) {
        return false;
    }
    if (surface->decentre != NULL || surface->coordinate_break != NULL) {
        put_displacement(output,
                         surface->decentre != NULL ? surface->decentre : surface->coordinate_break,
                         surface->decentre != NULL);
    }
    if (surface->vary_count > 0 &&
        !foreign_lose(output->job, error,
                      "marks for the designer (R~, t~)" LOSS_INSTEAD "left out")) {
        return false;
    }
    return put_asphere(output, surface, error);
}

static bool put_surface(struct output *output, size_t index, struct error *error)
{
    const struct surface *surface = &output->lens->surfaces[index];
    struct writing *writing = &output->writing;
    const struct medium *before = index > 0 ? &surface[-1].medium : &output->lens->object_medium;
    if (surface->decentre != NULL &&
        surface->coordinate_break != NULL) { /* the break on a plane of its own */
        put_string(output, "S 0.0 0.0");
        if (!put_medium(output, before, error)) {
            return false;
        }
        put_string(output, "\n");
        put_displacement(output, surface->coordinate_break, false);
    }
    bool has_radius = !surface->is_plane && !surface->has_curvature && surface->curved != CURVED_X;
    put_string(output, "S ");
    put(output, has_radius ? writing_length(writing, &surface->radius, 1) : text_of("0.0"));
    put_string(output, " ");
    put(output,
        surface->has_thickness ? writing_length(writing, &surface->thickness, 1) : text_of("0.0"));
    if (surface_reflects(surface)) {
        put_string(output, " REFL");
    } else if (!put_medium(output, &surface->medium, error)) {
        return false;
    }
    put_string(output, "\n");
    return put_details(output, surface, error);
}

/* CODE V counts the planes that were put in for coordinate breaks. */
static size_t number_of(const struct lens *lens, size_t index)
{
    size_t number = 1;
    for (size_t i = 0; i <= index; i++) {
        number += i < index;
        number += lens->surfaces[i].decentre != NULL && lens->surfaces[i].coordinate_break != NULL;
    }
    return number;
}

static bool put_positions(struct output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    struct arena *arena = output->job->arena;
    if (lens->position_count == 0) {
        return true;
    }
    growing_format(&output->writing.text, "ZOO %zu\nZOO TIT\n", lens->position_count);
    for (size_t i = 0; i < lens->position_count; i++) {
        if (!put_text(output, arena_printf(arena, "TIT Z%zu", i + 1), lens->positions[i], error)) {
            return false;
        }
    }
    if (lens->apertures != NULL && lens->aperture_kind > APERTURE_STOP) {
        put_values(output, arena_printf(arena, "ZOO %s", aperture_words[lens->aperture_kind]),
                   lens->apertures, lens->aperture_kind == APERTURE_EPD, false);
    }
    if (lens->aperture_kind == APERTURE_STOP) {
        put_pupils(output);
    }
    if (lens->objects != NULL) {
        put_values(output, "ZOO THI SO", lens->objects, 1, false);
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        size_t number = number_of(lens, i);
        if (surface->has_thickness && surface->thickness.variable != LENS_NONE) {
            put_values(output, arena_printf(arena, "ZOO THI S%zu", number),
                       lens->variables[surface->thickness.variable].values, 1, false);
        }
        if (surface->has_diameter && surface->diameter.variable != LENS_NONE) {
            put_values(output, arena_printf(arena, "ZOO CIR S%zu", number),
                       lens->variables[surface->diameter.variable].values, 1, true);
        }
    }
    return true;
}

bool codev_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error)
{
    struct output output = {.job = job, .lens = lens};
    writing_begin(&output.writing, lens, false, job->arena);
    if (!put_header(&output, error)) {
        return false;
    }
    put_string(&output, "SO 0.0 ");
    put(&output, lens->object_is_infinite ? text_of("0.1e14")
                                          : writing_length(&output.writing, &lens->object, 1));
    if (!put_medium(&output, &lens->object_medium, error)) {
        return false;
    }
    put_string(&output, "\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!put_surface(&output, i, error)) {
            return false;
        }
    }
    put_string(&output, lens->focus == FOCUS_PARAXIAL ? "  PIM\nSI 0.0 0.0\n" : "SI 0.0 0.0\n");
    if ((lens->focus == FOCUS_BEST &&
         !foreign_lose(output.job, error,
                       "the best focus" LOSS_INSTEAD "the image lies at the last thickness")) ||
        !put_positions(&output, error)) {
        return false;
    }
    put_string(&output, "GO\n");
    *text = growing_done(&output.writing.text);
    return true;
}
