/* file/lens_write.c - a lens as a .lens file. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_setting.h"
#include "optics/growing.h"

#include "base/constants.h"
#include "file/lens_mark.h"
#include "file/lens_pickup.h"
#include "file/lens_surface.h"
#include "file/lens_tolerance.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

/* The table of surfaces. */
enum { CELL_RADIUS, CELL_THICKNESS, CELL_MEDIUM, CELL_DIAMETER, CELLS };

struct lens_write_writer {
    struct arena *arena;
    const struct lens *lens;
    struct text_buffer text;
    double unit;        /* mm */
    size_t tabs[CELLS]; /* where the columns of the table begin */
};

/* Blanks up to a column of the present line, at least one. */
static void put_tab(struct lens_write_writer *writer, size_t line_start, size_t column)
{
    do {
        growing_string(&writer->text, " ");
    } while (writer->text.length - line_start < column);
}

/* As typed; a computed value with the shortest digits. */
static void put_figure(struct lens_write_writer *writer, const struct figure *figure, double unit)
{
    if (figure->typed.start != NULL) {
        growing_text(&writer->text, figure->typed);
    } else {
        growing_number(&writer->text, figure->value.hi / unit);
    }
}

static void put_cell(struct lens_write_writer *writer, bool is_given, const struct figure *figure)
{
    if (!is_given) {
        growing_string(&writer->text, "-");
    } else if (figure->variable != LENS_NONE) {
        struct text name = writer->lens->variables[figure->variable].name;
        growing_text(&writer->text, name);
    } else {
        put_figure(writer, figure, writer->unit);
    }
}

static void put_vector(struct lens_write_writer *writer, const char *key,
                       const struct figure *figures, size_t count, double unit)
{
    growing_string(&writer->text, key);
    for (size_t i = 0; i < count; i++) {
        growing_string(&writer->text, i > 0 ? "," : "");
        put_figure(writer, &figures[i], unit);
    }
}

static void put_displacement(struct lens_write_writer *writer, const struct displacement *all,
                             size_t turns)
{
    put_vector(writer, " decenter=", all->decenter, 2, writer->unit);
    put_vector(writer, " tilt=", all->tilt, turns, RADIANS_PER_DEGREE);
}

/* In which a file has the number. */
static double lens_write_unit_of(const struct lens_write_writer *writer, enum parameter_kind kind,
                                 int order)
{
    return (parameter_type(kind)->is & PARAMETER_IS_ANGLE) != 0
               ? RADIANS_PER_DEGREE
               : pow(writer->unit, parameter_length(kind, order));
}

static void put_extras(struct lens_write_writer *writer, const struct surface *surface)
{
    if (surface_has(surface, SURFACE_HAS_FOCAL)) {
        /* Of a thick lens, where they are not 0. */
        size_t terms = 3;
        while (terms > 0 && surface->distortion[terms - 1].value.hi == 0) {
            terms--;
        }
        if (surface->hiatus.variable != LENS_NONE || surface->hiatus.value.hi != 0) {
            growing_string(&writer->text, " hiatus=");
            put_cell(writer, true, &surface->hiatus);
        }
        if (terms > 0) {
            put_vector(writer, " distortion=", surface->distortion, terms, 1);
        }
    }
    if (surface->has_curvature) {
        growing_string(&writer->text, " c=");
        put_figure(writer, &surface->curvature, 1 / writer->unit);
    }
    if (surface->conic.typed.start != NULL || surface->conic.value.hi != 0) {
        growing_string(&writer->text, " k=");
        put_figure(writer, &surface->conic, 1);
    }
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        const enum parameter_kind kind = PARAMETER_COEFFICIENT;
        const struct figure *figure = parameter_figure(surface, kind, order);
        if (figure != NULL) {
            const char *name = parameter_name(kind, order, writer->arena);
            growing_format(&writer->text, " %s=", name);
            put_figure(writer, figure, pow(writer->unit, parameter_length(kind, order)));
        }
    }
    if (surface->is_stop && surface->kind != SURFACE_STOP) {
        growing_string(&writer->text, " stop");
    }
    if (surface->decentre != NULL) {
        put_displacement(writer, surface->decentre, 2);
    }
    if (!surface_is_round(surface)) {
        growing_format(&writer->text, " cyl=%s", surface_section(surface)->word);
    }
    for (size_t i = 0; i < surface->vary_count; i++) {
        const struct vary *vary = &surface->varies[i];
        const char *name = parameter_mark_name(vary->kind, vary->order, writer->arena);
        growing_string(&writer->text, " ");
        lens_mark_write(vary, name, writer->lens->unit, &writer->text);
    }
    if (surface->name != NULL) {
        growing_format(&writer->text, " name=\"%s\"", surface->name);
    }
}

static void put_in_table(struct lens_write_writer *writer, const struct surface *surface, int cell)
{
    const bool is_thick = surface_has(surface, SURFACE_HAS_FOCAL);
    switch (cell) {
    case CELL_RADIUS:
        put_cell(writer, is_thick || !surface->is_plane,
                 is_thick ? &surface->focal : &surface->radius);
        break;
    case CELL_THICKNESS:
        put_cell(writer, surface->has_thickness, &surface->thickness);
        break;
    case CELL_MEDIUM:
        if (surface_reflects(surface)) {
            growing_string(&writer->text, "mirror");
        } else {
            growing_text(&writer->text, surface->medium.written);
        }
        break;
    default:
        put_cell(writer, surface->has_diameter, &surface->diameter);
    }
}

static void put_surface_line(struct lens_write_writer *writer, const struct surface *surface)
{
    if (surface->coordinate_break != NULL) {
        growing_string(&writer->text, "bend");
        put_displacement(writer, surface->coordinate_break, 3);
        growing_string(&writer->text, "\n");
    }
    size_t start = writer->text.length;
    growing_string(&writer->text,
                   surface_is_thin(surface) ? LENS_THIN_WORD : surface_traits(surface)->word);
    for (int cell = 0; cell < CELLS; cell++) {
        put_tab(writer, start, writer->tabs[cell]);
        put_in_table(writer, surface, cell);
    }
    put_extras(writer, surface);
    growing_string(&writer->text, "\n");
    for (size_t i = 0; i < surface->aperture_count; i++) {
        lens_aperture_write(&surface->apertures[i], lens_unit_scale(writer->lens->unit),
                            &writer->text);
    }
}

/* `keyword     text`, where there is a text. */
static void lens_write_put_line(struct lens_write_writer *writer, const char *keyword,
                                const char *text)
{
    if (text != NULL) {
        growing_format(&writer->text, "%-11s %s\n", keyword, text);
    }
}

static void put_figures(struct lens_write_writer *writer, const char *keyword,
                        const struct figure *figures, size_t count, double unit)
{
    growing_string(&writer->text, keyword);
    for (size_t i = 0; i < count; i++) {
        growing_string(&writer->text, " ");
        put_figure(writer, &figures[i], unit);
    }
    growing_string(&writer->text, "\n");
}

/* `:weight`, where there is one. */
static void put_weight(struct lens_write_writer *writer, struct text weight)
{
    if (weight.start != NULL) {
        growing_format(&writer->text, ":%.*s", (int)weight.length, weight.start);
    }
}

/* A point of the field, behind what stands between it and the one before. */
static void put_field_point(struct lens_write_writer *writer, const char *between,
                            const struct lens_field *field)
{
    double unit = writer->lens->field_kind == FIELD_ANGLE ? RADIANS_PER_DEGREE : writer->unit;
    bool beside = field->at[0].value.hi != 0;
    put_vector(writer, between, beside ? field->at : &field->at[1], beside ? 2 : 1, unit);
    put_weight(writer, field->weight_typed);
}

static void put_aperture_lines(struct lens_write_writer *writer, const char *before,
                               const struct figure *figures, size_t count)
{
    static const char *const words[] = {"", "stop", "f/", "epd ", "na "};
    enum aperture_kind kind = writer->lens->aperture_kind;
    double unit = kind == APERTURE_EPD ? writer->unit : 1;
    growing_string(&writer->text, before);
    for (size_t i = 0; i < count; i++) {
        growing_string(&writer->text, i == 0 || kind != APERTURE_STOP ? words[kind] : "");
        if (kind != APERTURE_STOP) {
            put_figure(writer, &figures[i], unit);
        }
        growing_string(&writer->text, i + 1 < count ? " " : "");
    }
    growing_string(&writer->text,
                   writer->lens->stop_is_real && kind != APERTURE_STOP ? " real\n" : "\n");
}

static void put_lens_header(struct lens_write_writer *writer)
{
    static const char *const focuses[] = {"paraxial", "table", "best", "afocal"};
    const struct lens *lens = writer->lens;
    lens_write_put_line(writer, "lens", lens->title);
    lens_write_put_line(writer, "kind", lens->kind);
    lens_write_put_line(writer, "source", lens->source);
    for (size_t i = 0; i < lens->note_count; i++) {
        lens_write_put_line(writer, "note", lens->notes[i]);
    }
    lens_write_put_line(writer, "unit", lens->unit);
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        const struct lens_wavelength *one = &lens->wavelengths[i];
        growing_string(&writer->text, i == 0 ? "wavelength  " : " ");
        growing_text(&writer->text, one->typed);
        put_weight(writer, one->weight_typed);
    }
    growing_string(&writer->text, lens->wavelength_count > 0 ? "\n" : "");
    if (lens->objects == NULL) {
        growing_string(&writer->text, "object      ");
        put_figure(writer, &lens->object, writer->unit);
        growing_string(&writer->text, lens->is_telecentric ? " telecentric\n" : "\n");
    }
    if (!text_equal(lens->object_medium.written, "air")) {
        const struct text medium = lens->object_medium.written;
        growing_format(&writer->text, "medium      %.*s\n", (int)medium.length, medium.start);
    }
    if (lens->field_kind != FIELD_NONE) {
        static const char *const kinds[] = {[FIELD_ANGLE] = "angle",
                                            [FIELD_HEIGHT] = "height",
                                            [FIELD_IMAGE] = "image",
                                            [FIELD_REAL] = "real"};
        growing_format(&writer->text, "field       %s", kinds[lens->field_kind]);
        for (size_t k = 0; k < lens->field_count; k++) {
            put_field_point(writer, " ", &lens->fields[k]);
        }
        growing_string(&writer->text, "\n");
    }
    if (lens->aperture_kind != APERTURE_NONE && lens->apertures == NULL) {
        put_aperture_lines(writer, "aperture    ", &lens->aperture, 1);
    }
    lens_write_put_line(writer, "focus", focuses[lens->focus]);
}

/* The stop, wavelengths and points of the field. */
static void put_system_settings(struct lens_write_writer *writer)
{
    const struct lens *lens = writer->lens;
    struct arena *arena = writer->arena;
    for (size_t p = 0; p < lens->position_count && lens->stops != NULL; p++) {
        growing_format(&writer->text, "%s %zu%s", p == 0 ? "set stop" : "", lens->stops[p] + 1,
                       p + 1 == lens->position_count ? "\n" : "");
    }
    for (size_t p = 0; p < lens->position_count && lens->lights != NULL; p++) {
        growing_format(&writer->text, "%s %s%s", p == 0 ? "set wavelength" : "",
                       lens_light_write(&lens->lights[p], arena),
                       p + 1 == lens->position_count ? "\n" : "");
    }
    for (size_t p = 0; p < lens->position_count && lens->points != NULL; p++) {
        growing_string(&writer->text, p == 0 ? "set field" : "");
        for (size_t i = 0; i < lens->points[p].count; i++) {
            put_field_point(writer, i == 0 ? " " : ";", &lens->points[p].fields[i]);
        }
        growing_string(&writer->text, p + 1 == lens->position_count ? "\n" : "");
    }
}

/* What the positions set anew. */
static void put_set_lines(struct lens_write_writer *writer)
{
    const struct lens *lens = writer->lens;
    struct arena *arena = writer->arena;
    for (size_t i = 0; i < lens->setting_count; i++) {
        const struct lens_setting *one = &lens->settings[i];
        const struct parameter parameter = one->parameter;
        const char *begin =
            arena_printf(arena, "set %s", parameter_write(parameter, writer->arena));
        if (one->media == NULL) {
            put_figures(writer, begin, one->figures, lens->position_count,
                        lens_write_unit_of(writer, parameter.kind, parameter.order));
            continue;
        }
        growing_string(&writer->text, begin);
        for (size_t p = 0; p < lens->position_count; p++) {
            const struct text written = one->media[p].written;
            growing_format(&writer->text, " %.*s", (int)written.length, written.start);
        }
        growing_string(&writer->text, "\n");
    }
    put_system_settings(writer);
}

/* What follows what, what is wanted, and how well it is made. */
static void put_design(struct lens_write_writer *writer)
{
    const struct lens *lens = writer->lens;
    for (size_t i = 0; i < lens->pickup_count; i++) {
        growing_string(&writer->text, "pickup      ");
        lens_pickup_write(&lens->pickups[i], lens->unit, &writer->text);
        growing_string(&writer->text, "\n");
    }
    for (size_t i = 0; i < lens->goal_count; i++) {
        const struct text goal = lens->goals[i].text;
        growing_format(&writer->text, "goal        %.*s\n", (int)goal.length, goal.start);
    }
    for (size_t i = 0; i < lens->tolerance_count; i++) {
        growing_string(&writer->text, "tolerance   ");
        lens_tolerance_write(&lens->tolerances[i], lens->unit, &writer->text);
        growing_string(&writer->text, "\n");
    }
}

static void put_positions(struct lens_write_writer *writer)
{
    static const char *const stated[STATED_COUNT] = {"stated efl", "stated bfl", "stated fnumber",
                                                     "stated tstop"};
    const struct lens *lens = writer->lens;
    size_t count = lens->position_count;
    for (size_t i = 0; i < count; i++) {
        growing_format(&writer->text, "%s %s", i == 0 ? "position   " : "", lens->positions[i]);
    }
    growing_string(&writer->text, count > 0 ? "\n" : "");
    for (int i = 0; i < STATED_COUNT; i++) {
        if (lens->stated[i] != NULL) {
            put_figures(writer, stated[i], lens->stated[i], lens->stated_count[i],
                        stated_is_length(i) ? writer->unit : 1);
        }
    }
    for (size_t i = 0; i < lens->variable_count; i++) {
        /* A word of the positions, with its marks. */
        const struct lens_variable *variable = &lens->variables[i];
        growing_format(&writer->text, "let %.*s", (int)variable->name.length, variable->name.start);
        for (size_t p = 0; p < writer->lens->position_count; p++) {
            growing_string(&writer->text, " ");
            put_figure(writer, &variable->values[p], writer->unit);
            if (variable->varies != NULL && variable->varies[p] != NULL) {
                lens_mark_write(variable->varies[p], "", writer->lens->unit, &writer->text);
            }
        }
        growing_string(&writer->text, "\n");
    }
    put_set_lines(writer);
    if (lens->objects != NULL) {
        put_figures(writer, lens->is_telecentric ? "let object telecentric" : "let object",
                    lens->objects, count, writer->unit);
    }
    if (lens->apertures != NULL) {
        put_aperture_lines(writer, "let aperture ", lens->apertures, count);
    }
}

struct text lens_write(const struct lens *lens, struct arena *arena)
{
    struct lens_write_writer writer = {
        .arena = arena, .lens = lens, .text = {.arena = arena}, .unit = lens_unit_mm(lens->unit)};
    put_lens_header(&writer);
    put_positions(&writer);
    put_design(&writer);
    /* Columns as usual, wider where numbers are long. */
    static const size_t usual[CELLS] = {12, 26, 38, 58};
    const size_t end = writer.text.length;
    for (int cell = 0; cell < CELLS; cell++) {
        writer.tabs[cell] = usual[cell];
    }
    for (int cell = 0; cell + 1 < CELLS; cell++) {
        size_t widest = 0;
        for (size_t i = 0; i < writer.lens->surface_count; i++) {
            put_in_table(&writer, &writer.lens->surfaces[i], cell);
            const size_t width = writer.text.length - end;
            widest = width > widest ? width : widest;
            writer.text.length = end;
        }
        if (writer.tabs[cell] + widest >= writer.tabs[cell + 1]) {
            writer.tabs[cell + 1] = writer.tabs[cell] + widest + 1;
        }
    }
    static const char *const names[CELLS] = {"radius", "thickness", "medium", "diameter"};
    const size_t start = writer.text.length;
    growing_string(&writer.text, "#");
    for (int cell = 0; cell < CELLS; cell++) {
        put_tab(&writer, start, writer.tabs[cell]);
        growing_string(&writer.text, names[cell]);
    }
    growing_string(&writer.text, "\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        put_surface_line(&writer, &lens->surfaces[i]);
    }
    return growing_done(&writer.text);
}
