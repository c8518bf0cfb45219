/* exchange/codev/codev_write.c - a lens as a CODE V sequence file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"
#include "exchange/codev/codev_writer.h"

#include "exchange/keep_notes.h"
#include "exchange/writing.h"
#include "file/decimal.h"

#include <math.h>
#include <string.h>

static void codev_write_put(struct codev_output *output, struct text text)
{
    growing_text(&output->writing.text, text);
}

static void codev_write_put_string(struct codev_output *output, const char *string)
{
    codev_write_put(output, text_of(string));
}

static void codev_write_put_command(struct codev_output *output, const char *name,
                                    struct text value)
{
    codev_write_put_string(output, name);
    codev_write_put_string(output, " ");
    codev_write_put(output, value);
    codev_write_put_string(output, "\n");
}

/* A table of indices or one index for all light, as a glass of the file's own catalogue. */
static void put_own(struct codev_output *output, size_t index)
{
    const struct medium *medium = output->own[index];
    const struct lens *lens = output->lens;
    struct lens_writer *writing = &output->writing;
    bool is_table = medium->kind == MEDIUM_TABLE;
    size_t count = is_table ? medium->point_count : lens->wavelength_count;
    size_t column = 5;
    codev_write_put_string(output, "  PWL");
    for (size_t i = 0; i < count; i++) {
        double wave = is_table ? medium->points[i].wavelength : lens->wavelengths[i].wavelength;
        const struct text typed = is_table ? (struct text){"", 0} : lens->wavelengths[i].typed;
        codev_put_number(output, &column, writing_wave(writing, wave, typed, 3));
    }
    if (count == 0) {
        codev_write_put_string(output, " 587.5618");
    }
    growing_format(&writing->text, "\n  'N%zu'", index + 1);
    column = 8;
    for (size_t i = 0; i < count || i == 0; i++) {
        const struct figure figure = {.value = is_table ? medium->points[i].index : medium->index,
                                      .variable = LENS_NONE};
        codev_put_number(output, &column,
                         is_table ? writing_length(writing, &figure, 0) : medium->written);
    }
    codev_write_put_string(output, "\n");
}

static void add_own(struct codev_output *output, const struct medium *medium)
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

static void put_catalog(struct codev_output *output)
{
    const struct lens *lens = output->lens;
    const size_t most = lens->surface_count + 1 + lens->setting_count * lens->position_count;
    output->own = ARENA_ARRAY(output->job->arena, most, const struct medium *);
    add_own(output, &lens->object_medium);
    for (size_t i = 0; i < lens->surface_count; i++) {
        add_own(output, &lens->surfaces[i].medium);
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        for (size_t p = 0; p < lens->position_count && lens->settings[i].media != NULL; p++) {
            add_own(output, &lens->settings[i].media[p]);
        }
    }
    codev_write_put_string(output, output->own_count > 0 ? "PRV\n" : "");
    for (size_t i = 0; i < output->own_count; i++) {
        put_own(output, i);
    }
    codev_write_put_string(output, output->own_count > 0 ? "END\n" : "");
}

/* The pupil that the stop's diameter gives, and a comment by which it is read as that stop. */
static bool put_pupil(struct codev_output *output, struct error *error)
{
    struct figure pupil = {.variable = LENS_NONE};
    codev_write_put_string(output, CODEV_KEEP_NOTE CODEV_STOP_RULES "\n");
    if (!writing_pupil(&output->writing, 0, &pupil)) {
        return foreign_lose(output->job, error,
                            "an aperture that is ruled by a stop without a pupil");
    }
    codev_write_put_command(output, "EPD", pupil.typed);
    return true;
}

static bool codev_write_put_aperture(struct codev_output *output, struct error *error)
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
    codev_write_put_command(output, codev_aperture_words[kind],
                            writing_length(&output->writing, &figure, kind == APERTURE_EPD));
    return true;
}

static void codev_write_put_waves(struct codev_output *output)
{
    const struct lens *lens = output->lens;
    struct lens_writer *writing = &output->writing;
    size_t column = 2;
    codev_write_put_string(output, "WL");
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        const struct lens_wavelength *one = &lens->wavelengths[i];
        codev_put_number(output, &column, writing_wave(writing, one->wavelength, one->typed, 3));
    }
    codev_write_put_string(output,
                           lens->wavelength_count == 0 ? " 587.5618\nREF 1\nWTW" : "\nREF 1\nWTW");
    column = 3;
    for (size_t i = 0; i < lens->wavelength_count || i == 0; i++) {
        const struct text weight =
            i < lens->wavelength_count ? lens->wavelengths[i].weight_typed : (struct text){NULL, 0};
        codev_put_number(output, &column, weight.start != NULL ? weight : text_of("1"));
    }
    codev_write_put_string(output, "\n");
}

static void put_coordinates(struct codev_output *output, int axis)
{
    const struct lens *lens = output->lens;
    size_t column = 3;
    for (size_t i = 0; i < lens->field_count; i++) {
        codev_put_number(output, &column, codev_coordinate(output, &lens->fields[i].at[axis]));
    }
    codev_write_put_string(output, "\n");
}

static void codev_write_put_fields(struct codev_output *output)
{
    const struct lens *lens = output->lens;
    bool weighted = false;
    size_t column = 3;
    for (int axis = 0; axis < 2 && lens->field_kind != FIELD_NONE; axis++) {
        codev_write_put_string(output, codev_field_words[lens->field_kind][axis]);
        put_coordinates(output, axis);
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        weighted = weighted || lens->fields[i].weight != 1;
    }
    codev_write_put_string(output, weighted ? "WTF" : "");
    for (size_t i = 0; i < lens->field_count && weighted; i++) {
        const struct text typed = lens->fields[i].weight_typed;
        codev_put_number(output, &column, typed.start != NULL ? typed : text_of("1"));
    }
    codev_write_put_string(output, weighted ? "\n" : "");
}

static bool codev_write_put_header(struct codev_output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    codev_write_put_string(output, "RDM;LEN\n");
    if (lens->title != NULL && !codev_put_text(output, "TITLE", lens->title, error)) {
        return false;
    }
    keep_notes_write(&output->writing.text, lens, output->writing.scale, CODEV_KEEP_NOTE, "\n");
    for (size_t i = 0; i < lens->note_count; i++) {
        codev_write_put_string(output, CODEV_KEEP_NOTE CODEV_NOTE);
        codev_write_put_string(output, lens->notes[i]);
        codev_write_put_string(output, "\n");
    }
    if (!codev_write_put_aperture(output, error)) {
        return false;
    }
    growing_format(&output->writing.text, "DIM %s\n",
                   foreign_unit_word(codev_units, output->writing.unit));
    codev_write_put_waves(output);
    codev_write_put_fields(output);
    codev_write_put_string(output, lens->is_telecentric ? "TEL Y\n" : "");
    codev_write_put_string(output, lens->focus == FOCUS_AFOCAL ? "AFC Y\n" : "");
    put_catalog(output);
    return true;
}

static void codev_write_put_displacement(struct codev_output *output,
                                         const struct displacement *all, bool back)
{
    struct lens_writer *writing = &output->writing;
    struct arena *arena = output->job->arena;
    codev_write_put_string(output, "  XDE ");
    codev_write_put(output, writing_length(writing, &all->decenter[0], 1));
    codev_write_put_string(output, "; YDE ");
    codev_write_put(output, writing_length(writing, &all->decenter[1], 1));
    codev_write_put_string(output, "; ZDE 0.0\n  ADE ");
    codev_write_put(output, decimal_negate(writing_degrees(writing, &all->tilt[0]), arena));
    codev_write_put_string(output, "; BDE ");
    codev_write_put(output, decimal_negate(writing_degrees(writing, &all->tilt[1]), arena));
    codev_write_put_string(output, "; CDE ");
    codev_write_put(output, writing_degrees(writing, &all->tilt[2]));
    codev_write_put_string(output, back ? "\n  DAR\n" : "\n");
}

/* ASP has the even powers from r^4 on, SPS ODD all; of a cylinder there is only ASP. */
static const struct codev_write_asphere {
    const char *head, *conic;
} conic_shape = {"  CON\n", "  K"}, even_shape = {"  ASP\n", "  K"},
  odd_shape = {"  SPS ODD 0.0\n", "  SCO K"};

/* The simplest shape that has all the surface's terms; null for a sphere. */
static const struct codev_write_asphere *codev_write_shape_of(const struct surface *surface)
{
    bool conic = surface->conic.value.hi != 0 || surface->conic.typed.start != NULL;
    const struct codev_write_asphere *shape = conic ? &conic_shape : NULL;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        shape = codev_is_term_given(surface, i) && codev_is_of_asp(i) ? &even_shape : shape;
    }
    shape = codev_is_odd(surface) ? &odd_shape : shape;
    return shape;
}

static bool put_asphere(struct codev_output *output, const struct surface *surface,
                        struct error *error)
{
    struct lens_writer *writing = &output->writing;
    struct arena *arena = output->job->arena;
    const struct codev_write_asphere *shape = codev_write_shape_of(surface);
    bool is_odd = shape == &odd_shape;
    bool conic = surface->conic.value.hi != 0 || surface->conic.typed.start != NULL;
    if (is_odd && !surface_is_round(surface)) {
        return foreign_lose(output->job, error,
                            "CODE V has no cylinder with the coefficient A2 or odd ones");
    }
    if (shape != NULL) {
        codev_write_put_string(output, shape->head);
        codev_write_put_command(output, shape->conic,
                                conic ? writing_length(writing, &surface->conic, 0)
                                      : text_of("0.0"));
    }
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        int i = surface_term(order);
        if (codev_is_term_given(surface, i) && (is_odd || codev_is_of_asp(i))) {
            codev_write_put_command(output,
                                    arena_printf(arena, "  %s%s", is_odd ? "SCO " : "",
                                                 codev_coefficient_word(order, is_odd, arena)),
                                    writing_length(writing, &surface->coefficient[i], 1 - order));
        }
    }
    return true;
}

static bool put_clear(struct codev_output *output, const struct surface *surface,
                      struct error *error)
{
    if (surface->has_diameter) {
        const struct text diameter = writing_length(&output->writing, &surface->diameter, 1);
        codev_write_put_command(output, "  CIR", decimal_half(diameter, output->job->arena));
    }
    return codev_put_apertures(&output->writing, output->job, surface, error);
}

static bool put_details(struct codev_output *output, const struct surface *surface,
                        struct error *error)
{
    struct lens_writer *writing = &output->writing;
    bool along_x = surface->curved == CURVED_X;
    if (!surface_is_round(surface)) {
        codev_write_put_string(output, "  CYL\n");
    }
    if (surface->has_curvature) {
        codev_write_put_command(output, along_x ? "  CUX" : "  CUY",
                                writing_length(writing, &surface->curvature, -1));
    } else if (along_x && !surface->is_plane) {
        codev_write_put_command(output, "  RDX", writing_length(writing, &surface->radius, 1));
    }
    if (surface->is_stop) {
        codev_write_put_string(output, "  STO\n");
    }
    if (!put_clear(output, surface, error)) {
        return false;
    }
    if (surface->name != NULL && !codev_put_text(output, "  SLB", surface->name, error)) {
        return false;
    }
    if (surface->decentre != NULL || surface->coordinate_break != NULL) {
        codev_write_put_displacement(
            output, surface->decentre != NULL ? surface->decentre : surface->coordinate_break,
            surface->decentre != NULL);
    }
    if (surface->vary_count > 0 &&
        !foreign_lose(output->job, error,
                      "marks for the designer (R~, t~)" LOSS_IS_MUTE LOSS_INSTEAD "left out")) {
        return false;
    }
    return put_asphere(output, surface, error);
}

static bool codev_write_put_surface(struct codev_output *output, size_t index, struct error *error)
{
    const struct surface *surface = &output->lens->surfaces[index];
    struct lens_writer *writing = &output->writing;
    const struct medium *before = index > 0 ? &surface[-1].medium : &output->lens->object_medium;
    if (surface->decentre != NULL &&
        surface->coordinate_break != NULL) { /* the break on a plane of its own */
        codev_write_put_string(output, "S 0.0 0.0");
        if (!codev_put_medium(output, before, error)) {
            return false;
        }
        codev_write_put_string(output, "\n");
        codev_write_put_displacement(output, surface->coordinate_break, false);
    }
    bool has_radius = !surface->is_plane && !surface->has_curvature && surface->curved != CURVED_X;
    codev_write_put_string(output, "S ");
    codev_write_put(output,
                    has_radius ? writing_length(writing, &surface->radius, 1) : text_of("0.0"));
    codev_write_put_string(output, " ");
    codev_write_put(output, surface->has_thickness ? writing_length(writing, &surface->thickness, 1)
                                                   : text_of("0.0"));
    if (surface_reflects(surface)) {
        codev_write_put_string(output, " REFL");
    } else if (!codev_put_medium(output, &surface->medium, error)) {
        return false;
    }
    codev_write_put_string(output, "\n");
    return put_details(output, surface, error);
}

bool codev_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error)
{
    struct codev_output output = {.job = job, .lens = lens};
    writing_begin(&output.writing, lens, false, job->arena);
    if (!codev_write_put_header(&output, error)) {
        return false;
    }
    codev_write_put_string(&output, "SO 0.0 ");
    codev_write_put(&output, lens->object_is_infinite
                                 ? text_of("0.1e14")
                                 : writing_length(&output.writing, &lens->object, 1));
    if (!codev_put_medium(&output, &lens->object_medium, error)) {
        return false;
    }
    codev_write_put_string(&output, "\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!codev_write_put_surface(&output, i, error)) {
            return false;
        }
    }
    codev_write_put_string(&output,
                           lens->focus == FOCUS_PARAXIAL ? "  PIM\nSI 0.0 0.0\n" : "SI 0.0 0.0\n");
    if ((lens->focus == FOCUS_BEST &&
         !foreign_lose(output.job, error,
                       "the best focus" LOSS_INSTEAD "the image lies at the last thickness")) ||
        !codev_put_positions(&output, error)) {
        return false;
    }
    codev_write_put_string(&output, "GO\n");
    *text = growing_done(&output.writing.text);
    return true;
}
