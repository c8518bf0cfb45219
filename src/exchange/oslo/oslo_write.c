/* exchange/oslo/oslo_write.c - a lens as an OSLO lens file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/oslo/oslo.h"
#include "exchange/writing.h"
#include "file/decimal.h"
#include "file/lens_unit.h"

#include <math.h>
#include <string.h>

/* A lens being written. */
struct oslo_write_output {
    struct lens_writer writing;
    struct foreign_job *job;
    const struct lens *lens;
    size_t models; /* glasses that were named so far */
    size_t number; /* of the present surface; the object is 0 */
};

static void oslo_write_put_string(struct oslo_write_output *output, const char *string)
{
    growing_text(&output->writing.text, text_of(string));
}

static void oslo_write_put_command(struct oslo_write_output *output, const char *name,
                                   struct text value)
{
    oslo_write_put_string(output, name);
    oslo_write_put_string(output, " ");
    growing_text(&output->writing.text, value);
    oslo_write_put_string(output, "\n");
}

static struct text oslo_write_length_of(struct oslo_write_output *output,
                                        const struct figure *figure)
{
    return writing_length(&output->writing, figure, 1);
}

static bool put_text(struct oslo_write_output *output, const char *name, const char *string,
                     struct error *error)
{
    bool has_lost = false;
    const struct text text = writing_quotable(&output->writing, string, "\"", &has_lost);
    oslo_write_put_string(output, name);
    oslo_write_put_string(output, " \"");
    growing_text(&output->writing.text, text);
    oslo_write_put_string(output, "\"");
    return !has_lost || foreign_lose(output->job, error,
                                     "double quotes inside of a text" LOSS_INSTEAD "left out");
}

static bool oslo_write_put_aperture(struct oslo_write_output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    struct arena *arena = output->job->arena;
    struct figure figure = lens->apertures != NULL ? lens->apertures[0] : lens->aperture;
    if (lens->aperture_kind == APERTURE_NONE) {
        return true;
    }
    if (lens->aperture_kind == APERTURE_NA && !lens->object_is_infinite) {
        oslo_write_put_command(output, "NAO", writing_length(&output->writing, &figure, 0));
        return true;
    }
    if (lens->aperture_kind == APERTURE_FNUMBER) {
        oslo_write_put_command(output, "FNO", writing_length(&output->writing, &figure, 0));
        return lens->object_is_infinite ||
               foreign_lose(output->job, error,
                            "the f-number of a lens with a near object" LOSS_INSTEAD
                            "OSLO takes it as "
                            "the working one");
    }
    if (!lens->object_is_infinite) {
        return foreign_lose(output->job, error,
                            "the aperture of a lens with a finite object: OSLO needs its "
                            "NA, write 'aperture na'");
    }
    if (lens->aperture_kind == APERTURE_STOP) {
        oslo_write_put_string(output, OSLO_KEEP_NOTE OSLO_STOP_RULES "\n");
        figure = (struct figure){.variable = LENS_NONE};
        if (!writing_pupil(&output->writing, 0, &figure)) {
            return foreign_lose(output->job, error,
                                "an aperture that is ruled by a stop without a pupil");
        }
    }
    oslo_write_put_command(output, "EBR",
                           decimal_half(oslo_write_length_of(output, &figure), arena));
    return true;
}

/* How far out a field is, as OSLO's fractions count: of angles their tangents. */
static double extent_of(const struct lens *lens, const struct lens_field *field, double out[2])
{
    for (int i = 0; i < 2; i++) {
        double value = field->at[i].value.hi;
        out[i] = lens->field_kind == FIELD_ANGLE ? tan(value) : value;
    }
    return out[0] == 0 ? out[1] : hypot(out[0], out[1]);
}

/* The field that is farthest out, and how far; false without fields. */
static bool oslo_write_find_edge(const struct lens *lens, struct figure *edge, double *extent)
{
    double out[2], largest = -1;
    for (size_t i = 0; i < lens->field_count; i++) {
        const struct lens_field *field = &lens->fields[i];
        const double here = extent_of(lens, field, out);
        if (!(fabs(here) > largest)) {
            continue;
        }
        largest = fabs(here);
        *extent = here;
        *edge = field->at[1];
        if (out[0] != 0) {
            *edge = (struct figure){
                .value = pair_of(lens->field_kind == FIELD_ANGLE ? atan(here) : here),
                .variable = LENS_NONE};
        }
    }
    return lens->field_count > 0;
}

static struct text field_text(struct oslo_write_output *output, const struct figure *field)
{
    return output->lens->field_kind == FIELD_ANGLE ? writing_degrees(&output->writing, field)
                                                   : oslo_write_length_of(output, field);
}

/* As a .lens file has it: x,y:weight */
static void oslo_write_put_point(struct oslo_write_output *output, const struct lens_field *field)
{
    struct text_buffer *text = &output->writing.text;
    if (field->at[0].value.hi != 0) {
        growing_text(text, field_text(output, &field->at[0]));
        oslo_write_put_string(output, ",");
    }
    growing_text(text, field_text(output, &field->at[1]));
    if (field->weight_typed.start != NULL) {
        oslo_write_put_string(output, ":");
        growing_text(text, field->weight_typed);
    }
}

static bool oslo_write_put_field(struct oslo_write_output *output, struct error *error)
{
    static const char *const words[] = {
        [FIELD_ANGLE] = "ANG", [FIELD_HEIGHT] = "OBH", [FIELD_IMAGE] = "GIH", [FIELD_REAL] = "GIH"};
    const struct lens *lens = output->lens;
    struct figure edge;
    double extent;
    if (!oslo_write_find_edge(lens, &edge, &extent)) {
        return true;
    }
    if (lens->field_kind == FIELD_REAL &&
        !foreign_lose(output->job, error,
                      "fields as heights of the real image" LOSS_INSTEAD
                      "taken for those of the paraxial one")) {
        return false;
    }
    oslo_write_put_command(output, words[lens->field_kind], field_text(output, &edge));
    oslo_write_put_string(output, OSLO_KEEP_NOTE OSLO_FIELDS);
    for (size_t i = 0; i < lens->field_count; i++) {
        oslo_write_put_string(output, i > 0 ? " " : "");
        oslo_write_put_point(output, &lens->fields[i]);
    }
    oslo_write_put_string(output, "\n");
    return true;
}

/* OSLO's field points: fractions of the edge, of angles those of their tangents. */
static void oslo_write_put_points(struct oslo_write_output *output)
{
    const struct lens *lens = output->lens;
    struct figure edge;
    double whole, out[2];
    if (!oslo_write_find_edge(lens, &edge, &whole) || whole == 0) {
        return;
    }
    oslo_write_put_string(output, "RST NEW\n");
    for (size_t i = 0; i < lens->field_count; i++) {
        extent_of(lens, &lens->fields[i], out);
        growing_format(&output->writing.text, "F %zu %.12g ", i + 1, out[1] / whole);
        if (out[0] != 0) {
            growing_format(&output->writing.text, "%.12g", out[0] / whole);
        } else {
            oslo_write_put_string(output, "0.0");
        }
        oslo_write_put_string(output, " 0.0 0.0 0.0 -1.0 1.0 -1.0 1.0 ");
        const struct text weight = lens->fields[i].weight_typed;
        growing_text(&output->writing.text, weight.start != NULL ? weight : text_of("1.0"));
        oslo_write_put_string(output, "\n");
    }
    growing_format(&output->writing.text, "END %zu\n", lens->field_count);
}

static bool oslo_write_put_header(struct oslo_write_output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    oslo_write_put_string(output, "// OSLO 6.6 0 0 0\n");
    keep_notes_write(&output->writing.text, lens, output->writing.scale, OSLO_KEEP_NOTE, "\n");
    if (!put_text(output, "LEN NEW", lens->title != NULL ? lens->title : "", error)) {
        return false;
    }
    growing_format(&output->writing.text, " 100 %zu\n", lens->surface_count + 1);
    if (!oslo_write_put_aperture(output, error)) {
        return false;
    }
    if (!oslo_write_put_field(output, error)) {
        return false;
    }
    oslo_write_put_string(output, lens->is_telecentric ? "TELE ON\n" : "");
    oslo_write_put_string(output, lens->focus == FOCUS_AFOCAL ? "AMO AFO\n" : "");
    oslo_write_put_string(output, "DES \"\"\n");
    growing_format(&output->writing.text, "UNI %.1f\n", lens_unit_mm(output->writing.unit));
    for (size_t i = 0; i < lens->note_count && i < 10; i++) {
        const char *name = arena_printf(output->job->arena, "SNO%zu", i + 1);
        if (!put_text(output, name, lens->notes[i], error)) {
            return false;
        }
        oslo_write_put_string(output, "\n");
    }
    return lens->note_count <= 10 || foreign_lose(output->job, error, "more than ten notes");
}

/* Indices at the wavelengths of a table, or of the lens. */
static void put_indices(struct oslo_write_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    oslo_write_put_string(output, "WV");
    for (size_t i = 0; i < medium->point_count; i++) {
        oslo_write_put_string(output, " ");
        growing_text(&writing->text,
                     writing_wave(writing, medium->points[i].wavelength, (struct text){"", 0}, 0));
    }
    growing_format(&writing->text, "\nGLA MOD MODEL%zu", ++output->models);
    for (size_t i = 0; i < medium->point_count; i++) {
        const struct figure figure = {.value = medium->points[i].index, .variable = LENS_NONE};
        oslo_write_put_string(output, " ");
        growing_text(&writing->text, writing_length(writing, &figure, 0));
    }
    oslo_write_put_string(output, "\n");
}

/* The letter of its maker before a name; of a maker that has none the catalogue is kept. */
static void oslo_write_put_glass(struct oslo_write_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    struct text name, catalog;
    double number;
    writing_glass(writing, output->job, medium, &name, &catalog);
    bool is_ohara = text_equal(catalog, "OHARA"), is_hoya = text_equal(catalog, "HOYA");
    bool is_number = number_read(name.start, name.start + name.length, NUMBER_UNSCALED, &number) ==
                     name.start + name.length;
    bool is_quoted = memchr(name.start, ' ', name.length) != NULL;
    if (catalog.length > 0 && !is_ohara && !is_hoya && !text_equal(catalog, "SCHOTT")) {
        growing_format(&writing->text, OSLO_KEEP_NOTE OSLO_GLASS "%zu %.*s:%.*s\n", output->number,
                       (int)catalog.length, catalog.start, (int)name.length, name.start);
    }
    oslo_write_put_string(output, is_quoted ? "GLA \"" : "GLA ");
    oslo_write_put_string(output, is_ohara ? "O_" : is_hoya ? "H_" : "");
    growing_text(&writing->text, is_number ? catalog : (struct text){"", 0});
    oslo_write_put_string(output, is_number ? "_" : "");
    growing_text(&writing->text, name);
    oslo_write_put_string(output, is_quoted ? "\"\n" : "\n");
}

static void oslo_write_put_medium(struct oslo_write_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    if (medium_is_air(medium)) {
        oslo_write_put_string(output, "AIR\n");
    } else if (medium->kind == MEDIUM_TABLE && medium->point_count > 2) {
        put_indices(output, medium);
    } else if (medium->kind == MEDIUM_TABLE) {
        put_indices(output, medium);
    } else if (medium->kind == MEDIUM_MODEL) {
        struct text abbe = medium->written, index = text_cut(&abbe, '/');
        oslo_write_put_string(output, "WV 0.58756 0.48613 0.65627\nGLA MOD ");
        growing_text(&writing->text, index);
        oslo_write_put_command(output, "", abbe);
    } else if (medium->kind == MEDIUM_CONSTANT) {
        oslo_write_put_command(output, "GLA", medium->written);
    } else {
        oslo_write_put_glass(output, medium);
    }
}

static void oslo_write_put_coefficients(struct oslo_write_output *output,
                                        const struct surface *surface)
{
    static const char *const words[] = {NULL, "AD", "AE", "AF", "AG"};
    bool odd = surface_odd(surface) != 0, general = (surface->coefficients & ~0x1eu) != 0;
    int step = odd ? 1 : 2;
    if (general) {
        growing_format(&output->writing.text, odd ? "ASP ARA %d\n" : "ASP ASR %d\n",
                       LENS_COEFFICIENTS / step);
    }
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        int i = surface_term(order);
        if ((surface->coefficients >> i & 1) != 0) {
            oslo_write_put_command(
                output, general ? arena_printf(output->job->arena, "AS%d", order / step) : words[i],
                writing_length(&output->writing, &surface->coefficient[i], 1 - order));
        }
    }
}

static void oslo_write_put_displacement(struct oslo_write_output *output,
                                        const struct displacement *all, bool back)
{
    struct lens_writer *writing = &output->writing;
    struct arena *arena = output->job->arena;
    oslo_write_put_string(output, "DT 1\n");
    oslo_write_put_command(output, "DCX", writing_length(writing, &all->decenter[0], 1));
    oslo_write_put_command(output, "DCY", writing_length(writing, &all->decenter[1], 1));
    oslo_write_put_command(output, "TLA",
                           decimal_negate(writing_degrees(writing, &all->tilt[0]), arena));
    oslo_write_put_command(output, "TLB",
                           decimal_negate(writing_degrees(writing, &all->tilt[1]), arena));
    oslo_write_put_command(output, "TLC", writing_degrees(writing, &all->tilt[2]));
    oslo_write_put_string(output, back ? "RCO\n" : "");
}

static bool oslo_write_put_shape(struct oslo_write_output *output, const struct surface *surface,
                                 struct error *error)
{
    struct lens_writer *writing = &output->writing;
    if (surface->has_curvature) {
        oslo_write_put_command(output, "CV", writing_length(writing, &surface->curvature, -1));
    } else if (!surface->is_plane) {
        oslo_write_put_command(output, "RD", oslo_write_length_of(output, &surface->radius));
    }
    if (surface->conic.typed.start != NULL || surface->conic.value.hi != 0) {
        oslo_write_put_command(output, "CC", writing_length(writing, &surface->conic, 0));
    }
    oslo_write_put_coefficients(output, surface);
    return surface_is_round(surface) ||
           foreign_lose(output->job, error,
                        "a cylinder" LOSS_INSTEAD "written as curved in both sections");
}

static void put_next(struct oslo_write_output *output)
{
    oslo_write_put_string(output, "NXT\n");
    output->number++;
}

static bool is_displaced_twice(const struct surface *surface)
{
    return surface->decentre != NULL && surface->coordinate_break != NULL;
}

/* What goes before the surface: its name, and a coordinate break that needs a plane of its own. */
static void oslo_write_put_before(struct oslo_write_output *output, const struct surface *surface,
                                  const struct medium *before)
{
    if (surface->name != NULL) {
        growing_format(&output->writing.text, OSLO_KEEP_NOTE OSLO_NAME "%zu %s\n",
                       output->number + is_displaced_twice(surface), surface->name);
    }
    if (is_displaced_twice(surface)) {
        oslo_write_put_medium(output, before);
        oslo_write_put_displacement(output, surface->coordinate_break, false);
        put_next(output);
    }
}

static bool oslo_write_put_surface(struct oslo_write_output *output, size_t index,
                                   struct error *error)
{
    const struct lens *lens = output->lens;
    const struct surface *surface = &lens->surfaces[index];
    const struct medium *before = index > 0 ? &surface[-1].medium : &lens->object_medium;
    bool is_last = index + 1 == lens->surface_count;
    bool solved = is_last && lens->focus == FOCUS_PARAXIAL;
    put_next(output);
    oslo_write_put_before(output, surface, before);
    if (surface_reflects(surface)) {
        oslo_write_put_string(output, "RFL\n");
    } else {
        oslo_write_put_medium(output, &surface->medium);
    }
    if (!oslo_write_put_shape(output, surface, error)) {
        return false;
    }
    if (surface->has_thickness) {
        oslo_write_put_command(output, "TH", oslo_write_length_of(output, &surface->thickness));
    }
    oslo_write_put_string(output, solved ? "PY 0.0\n" : "");
    if (surface->has_diameter) {
        oslo_write_put_command(
            output, "AP CHK",
            decimal_half(oslo_write_length_of(output, &surface->diameter), output->job->arena));
    }
    oslo_write_put_string(output, surface->is_stop ? "AST\n" : "");
    if (!oslo_write_apertures(&output->writing, output->job, surface, error)) {
        return false;
    }
    if (surface->decentre != NULL || surface->coordinate_break != NULL) {
        oslo_write_put_displacement(
            output, surface->decentre != NULL ? surface->decentre : surface->coordinate_break,
            surface->decentre != NULL);
    }
    return surface->vary_count == 0 ||
           foreign_lose(output->job, error,
                        "marks for the designer (R~, t~)" LOSS_IS_MUTE LOSS_INSTEAD "left out");
}

static void oslo_write_put_waves(struct oslo_write_output *output)
{
    const struct lens *lens = output->lens;
    struct lens_writer *writing = &output->writing;
    oslo_write_put_string(output, "WV");
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        oslo_write_put_string(output, " ");
        growing_text(&writing->text, writing_wave(writing, lens->wavelengths[i].wavelength,
                                                  lens->wavelengths[i].typed, 0));
    }
    oslo_write_put_string(output, lens->wavelength_count == 0 ? " 0.5875618\nWW" : "\nWW");
    for (size_t i = 0; i < lens->wavelength_count || i == 0; i++) {
        const struct text weight =
            i < lens->wavelength_count ? lens->wavelengths[i].weight_typed : (struct text){NULL, 0};
        oslo_write_put_string(output, " ");
        growing_text(&writing->text, weight.start != NULL ? weight : text_of("1.0"));
    }
    oslo_write_put_string(output, "\n");
}

/* OSLO takes surface 1 where no stop is named. */
static bool check_losses(struct oslo_write_output *output, struct error *error)
{
    const struct lens *lens = output->lens;
    return (lens->stop != LENS_NONE ||
            foreign_lose(output->job, error,
                         "the lens has no stop" LOSS_INSTEAD "OSLO takes its first surface")) &&
           (lens->position_count == 0 ||
            foreign_lose(output->job, error,
                         "the positions but the first: write them one by one")) &&
           (lens->focus != FOCUS_BEST ||
            foreign_lose(output->job, error,
                         "the best focus" LOSS_INSTEAD "the image lies at the last thickness"));
}

bool oslo_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                struct error *error)
{
    struct oslo_write_output output = {.job = job, .lens = lens};
    writing_begin(&output.writing, lens, true, job->arena);
    if (!check_losses(&output, error) || !oslo_write_put_header(&output, error)) {
        return false;
    }
    oslo_write_put_medium(&output, &lens->object_medium);
    oslo_write_put_command(&output, "TH",
                           lens->object_is_infinite ? text_of("1.0e+20")
                                                    : oslo_write_length_of(&output, &lens->object));
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!oslo_write_put_surface(&output, i, error)) {
            return false;
        }
    }
    oslo_write_put_string(&output, "NXT\nAIR\n");
    oslo_write_put_waves(&output);
    growing_format(&output.writing.text, "END %zu\n", lens->surface_count + 1);
    oslo_write_put_points(&output);
    *text = growing_done(&output.writing.text);
    return true;
}
