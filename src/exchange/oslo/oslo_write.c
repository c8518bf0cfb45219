/* exchange/oslo/oslo_write.c - a lens as an OSLO lens file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/oslo/oslo.h"
#include "exchange/writing.h"
#include "file/lens_unit.h"
#include "optics/aperture.h"

#include <math.h>
#include <string.h>

/* A lens being written. */
struct oslo_output {
    struct lens_writer writing;
    size_t models; /* glasses that were named so far */
    size_t number; /* of the present surface; the object is 0 */
};

static void oslo_put_text(struct lens_writer *writing, const char *name, const char *string)
{
    bool has_lost = false;
    const char *text = writing_quotable(writing, string, "\"", &has_lost);
    writing_put(writing, "%s \"%s\"", name, text);
    if (has_lost) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "left out", "double quotes inside of a text");
    }
}

static void oslo_put_beam(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    const enum aperture_kind kind = lens->aperture_kind;
    struct figure figure = lens->apertures != NULL ? lens->apertures[0] : lens->aperture;
    if (kind == APERTURE_NONE) {
        return;
    }
    if (kind == APERTURE_NA && !lens->object_is_infinite) {
        writing_put(writing, "NAO %s\n", writing_length(writing, &figure, 0));
        return;
    }
    if (kind == APERTURE_FNUMBER) {
        writing_put(writing, "FNO %s\n", writing_length(writing, &figure, 0));
        if (!lens->object_is_infinite) {
            foreign_lose(writing->job, LOSS_OF_RAYS, "OSLO takes it as the working one",
                         "the f-number of a lens with a near object");
        }
        return;
    }
    if (!lens->object_is_infinite) {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                     "the aperture of a lens with a finite object: OSLO needs its NA, write "
                     "'aperture na'");
        return;
    }
    if (kind == APERTURE_STOP) {
        writing_put(writing, OSLO_KEEP_NOTE OSLO_STOP_RULES "\n");
        figure = (struct figure){.variable = LENS_NONE};
        if (!writing_pupil(writing, 0, &figure)) {
            foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                         "an aperture that is ruled by a stop without a pupil");
            return;
        }
    }
    writing_put(writing, "EBR %s\n", writing_half(writing, &figure));
}

/* How far out a field is, as OSLO's fractions count: of angles their tangents. */
static double oslo_field_extent(const struct lens *lens, const struct lens_field *field,
                                double out[2])
{
    for (int i = 0; i < 2; i++) {
        double value = field->at[i].value.hi;
        out[i] = lens->field_kind == FIELD_ANGLE ? tan(value) : value;
    }
    return out[0] == 0 ? out[1] : hypot(out[0], out[1]);
}

/* The field that is farthest out, and how far; false without fields. */
static bool oslo_find_edge(const struct lens *lens, struct figure *edge, double *extent)
{
    double out[2], largest = -1;
    for (size_t i = 0; i < lens->field_count; i++) {
        const struct lens_field *field = &lens->fields[i];
        const double here = oslo_field_extent(lens, field, out);
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

static const char *oslo_coordinate(const struct lens_writer *writing, const struct figure *field)
{
    return writing->lens->field_kind == FIELD_ANGLE ? writing_degrees(writing, field)
                                                    : writing_length(writing, field, 1);
}

static void oslo_put_field(struct lens_writer *writing)
{
    static const char *const words[] = {
        [FIELD_ANGLE] = "ANG", [FIELD_HEIGHT] = "OBH", [FIELD_IMAGE] = "GIH", [FIELD_REAL] = "GIH"};
    const struct lens *lens = writing->lens;
    struct figure edge;
    double extent;
    if (!oslo_find_edge(lens, &edge, &extent)) {
        return;
    }
    if (lens->field_kind == FIELD_REAL) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "taken for those of the paraxial one",
                     "fields as heights of the real image");
    }
    writing_put(writing, "%s %s\n" OSLO_KEEP_NOTE OSLO_FIELDS, words[lens->field_kind],
                oslo_coordinate(writing, &edge));
    for (size_t i = 0; i < lens->field_count; i++) { /* as a .lens file has it: x,y:weight */
        const struct lens_field *field = &lens->fields[i];
        growing_string(&writing->text, i > 0 ? " " : "");
        if (field->at[0].value.hi != 0) {
            writing_put(writing, "%s,", oslo_coordinate(writing, &field->at[0]));
        }
        writing_put(writing, "%s", oslo_coordinate(writing, &field->at[1]));
        if (field->weight_typed.start != NULL) {
            writing_put(writing, ":%s", writing_weight(writing, field->weight_typed, "1"));
        }
    }
    writing_put(writing, "\n");
}

/* OSLO's field points: fractions of the edge, of angles those of their tangents. */
static void oslo_put_points(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    struct figure edge;
    double whole, out[2];
    if (!oslo_find_edge(lens, &edge, &whole) || whole == 0) {
        return;
    }
    writing_put(writing, "RST NEW\n");
    for (size_t i = 0; i < lens->field_count; i++) {
        oslo_field_extent(lens, &lens->fields[i], out);
        writing_put(writing, "F %zu %.12g %s 0.0 0.0 0.0 -1.0 1.0 -1.0 1.0 %s\n", i + 1,
                    out[1] / whole,
                    out[0] != 0 ? arena_printf(writing->arena, "%.12g", out[0] / whole) : "0.0",
                    writing_weight(writing, lens->fields[i].weight_typed, "1.0"));
    }
    writing_put(writing, "END %zu\n", lens->field_count);
}

/* -------- media -------- */

/* The letter of its maker before a name; of a maker that has none the catalogue is kept. */
static void oslo_put_glass(struct oslo_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    struct text name, catalog;
    double number;
    writing_glass(writing, medium, &name, &catalog);
    bool is_ohara = text_equal(catalog, "OHARA"), is_hoya = text_equal(catalog, "HOYA");
    bool is_number = text_number(name, NUMBER_UNSCALED, &number);
    const char *quote = memchr(name.start, ' ', name.length) != NULL ? "\"" : "", *maker = "";
    if (is_ohara || is_hoya) {
        maker = is_ohara ? "O_" : "H_";
    }
    if (catalog.length > 0 && !is_ohara && !is_hoya && !text_equal(catalog, "SCHOTT")) {
        writing_put(writing, OSLO_KEEP_NOTE OSLO_GLASS "%zu %.*s:%.*s\n", output->number,
                    (int)catalog.length, catalog.start, (int)name.length, name.start);
    }
    writing_put(writing, "GLA %s%s%.*s%s%.*s%s\n", quote, maker,
                is_number ? (int)catalog.length : 0, catalog.start, is_number ? "_" : "",
                (int)name.length, name.start, quote);
}

/* Indices at the wavelengths of a table. */
static void oslo_put_indices(struct oslo_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    writing_put(writing, "WV");
    for (size_t i = 0; i < medium->point_count; i++) {
        writing_put(writing, " %s",
                    writing_wave(writing, medium->points[i].wavelength, text_of(""), 0));
    }
    writing_put(writing, "\nGLA MOD MODEL%zu", ++output->models);
    for (size_t i = 0; i < medium->point_count; i++) {
        const struct figure figure = {.value = medium->points[i].index, .variable = LENS_NONE};
        writing_put(writing, " %s", writing_length(writing, &figure, 0));
    }
    writing_put(writing, "\n");
}

static void oslo_put_medium(struct oslo_output *output, const struct medium *medium)
{
    struct lens_writer *writing = &output->writing;
    struct text abbe = medium->written, index = text_cut(&abbe, '/');
    if (medium_is_air(medium)) {
        writing_put(writing, "AIR\n");
    } else if (medium->kind == MEDIUM_TABLE) {
        oslo_put_indices(output, medium);
    } else if (medium->kind == MEDIUM_MODEL) {
        writing_put(writing, "WV 0.58756 0.48613 0.65627\nGLA MOD %.*s %.*s\n", (int)index.length,
                    index.start, (int)abbe.length, abbe.start);
    } else if (medium->kind == MEDIUM_CONSTANT) {
        writing_put(writing, "GLA %.*s\n", (int)medium->written.length, medium->written.start);
    } else {
        oslo_put_glass(output, medium);
    }
}

/* -------- surfaces -------- */

static void oslo_put_terms(struct lens_writer *writing, const struct surface *surface)
{
    static const char *const words[] = {NULL, "AD", "AE", "AF", "AG"};
    bool odd = surface_odd(surface) != 0, general = (surface->coefficients & ~0x1eu) != 0;
    int step = odd ? 1 : 2;
    if (general) {
        writing_put(writing, "ASP %s %d\n", odd ? "ARA" : "ASR", LENS_COEFFICIENTS / step);
    }
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        int i = surface_term(order);
        if ((surface->coefficients >> i & 1) != 0) {
            writing_put(writing, "%s %s\n",
                        general ? arena_printf(writing->arena, "AS%d", order / step) : words[i],
                        writing_length(writing, &surface->coefficient[i], 1 - order));
        }
    }
}

static void oslo_put_shape(struct lens_writer *writing, const struct surface *surface)
{
    if (surface->has_curvature) {
        writing_put(writing, "CV %s\n", writing_length(writing, &surface->curvature, -1));
    } else if (!surface->is_plane) {
        writing_put(writing, "RD %s\n", writing_length(writing, &surface->radius, 1));
    }
    if (surface->conic.typed.start != NULL || surface->conic.value.hi != 0) {
        writing_put(writing, "CC %s\n", writing_length(writing, &surface->conic, 0));
    }
    oslo_put_terms(writing, surface);
    if (!surface_is_round(surface)) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "written as curved in both sections",
                     "a cylinder");
    }
}

static void oslo_put_turns(struct lens_writer *writing, const struct displacement *all, bool back)
{
    writing_put(writing, "DT 1\nDCX %s\nDCY %s\nTLA %s\nTLB %s\nTLC %s\n%s",
                writing_length(writing, &all->decenter[0], 1),
                writing_length(writing, &all->decenter[1], 1),
                writing_turned(writing, &all->tilt[0]), writing_turned(writing, &all->tilt[1]),
                writing_degrees(writing, &all->tilt[2]), back ? "RCO\n" : "");
}

/* ATP; 0: there is no such type. */
static int oslo_aperture_type(const struct aperture *aperture)
{
    static const int types[APERTURE_SHAPES] = {
        [SHAPE_CIRCLE] = 1, [SHAPE_ELLIPSE] = 1, [SHAPE_RECTANGLE] = 2};
    bool turned = aperture->turn.value.hi != 0 && aperture->shape != SHAPE_CIRCLE;
    bool corners = aperture->shape == SHAPE_POLYGON &&
                   (aperture->point_count == 3 || aperture->point_count == 4);
    if (turned) {
        return 0;
    }
    return corners ? (int)aperture->point_count : types[aperture->shape];
}

/* "AX1 A ..": a coordinate of a special aperture. */
static void oslo_put_edge(struct lens_writer *writing, const char *name, char letter,
                          struct pair value)
{
    const struct figure figure = {.value = value, .variable = LENS_NONE};
    writing_put(writing, "%s %c %s\n", name, letter, writing_length(writing, &figure, 1));
}

/* Corners, or edges along x and y. */
static void oslo_put_special(struct lens_writer *writing, const struct aperture *aperture,
                             char letter)
{
    static const char *const edges[2][2] = {{"AX1", "AX2"}, {"AY1", "AY2"}};
    const struct pair centre[] = {aperture->decenter[0].value, aperture->decenter[1].value};
    writing_put(writing, "ATP %c %d\nAAC %c %d\n", letter, oslo_aperture_type(aperture), letter,
                aperture->blocks ? 2 : 4);
    for (size_t i = 0; i < aperture->point_count; i++) {
        for (int k = 0; k < 2; k++) {
            oslo_put_edge(writing, arena_printf(writing->arena, "AV%c%zu", "XY"[k], i + 1), letter,
                          pair_add(centre[k], aperture->points[i][k].value));
        }
    }
    for (int k = 0; k < 2 && aperture->point_count == 0; k++) {
        const struct figure *size = &aperture->size[aperture->shape == SHAPE_CIRCLE ? 0 : k];
        const struct pair half = {size->value.hi / 2, size->value.lo / 2};
        oslo_put_edge(writing, edges[k][0], letter, pair_subtract(centre[k], half));
        oslo_put_edge(writing, edges[k][1], letter, pair_add(centre[k], half));
    }
}

/* What passes or blocks light, as special apertures. */
static void oslo_put_all_apertures(struct lens_writer *writing, const struct surface *surface)
{
    enum { MOST = 26 }; /* letters */
    int count = 0, put = 0;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        count += oslo_aperture_type(&surface->apertures[i]) != 0;
    }
    if (count > 0) {
        writing_put(writing, "APN %d\n", count < MOST ? count : MOST);
    }
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *one = &surface->apertures[i];
        if (oslo_aperture_type(one) != 0 && put < MOST) {
            oslo_put_special(writing, one, (char)('A' + put++));
        } else {
            writing_lose_aperture(writing, surface, one, "no such aperture is written");
        }
    }
}

static void oslo_put_next(struct oslo_output *output)
{
    writing_put(&output->writing, "NXT\n");
    output->number++;
}

static void oslo_put_surface(struct oslo_output *output, size_t index)
{
    struct lens_writer *writing = &output->writing;
    const struct lens *lens = writing->lens;
    const struct surface *surface = &lens->surfaces[index];
    const struct medium *before = index > 0 ? &surface[-1].medium : &lens->object_medium;
    const struct displacement *moved =
        surface->decentre != NULL ? surface->decentre : surface->coordinate_break;
    bool is_moved_twice = surface->decentre != NULL && surface->coordinate_break != NULL;
    bool solved = index + 1 == lens->surface_count && lens->focus == FOCUS_PARAXIAL;
    oslo_put_next(output);
    if (surface->name != NULL) {
        writing_put(writing, OSLO_KEEP_NOTE OSLO_NAME "%zu %s\n", output->number + is_moved_twice,
                    surface->name);
    }
    if (is_moved_twice) { /* the coordinate break needs a plane of its own */
        oslo_put_medium(output, before);
        oslo_put_turns(writing, surface->coordinate_break, false);
        oslo_put_next(output);
    }
    if (surface_reflects(surface)) {
        writing_put(writing, "RFL\n");
    } else {
        oslo_put_medium(output, &surface->medium);
    }
    oslo_put_shape(writing, surface);
    if (surface->has_thickness) {
        writing_put(writing, "TH %s\n", writing_length(writing, &surface->thickness, 1));
    }
    growing_string(&writing->text, solved ? "PY 0.0\n" : "");
    if (surface->has_diameter) {
        writing_put(writing, "AP CHK %s\n", writing_half(writing, &surface->diameter));
    }
    growing_string(&writing->text, surface->is_stop ? "AST\n" : "");
    oslo_put_all_apertures(writing, surface);
    if (moved != NULL) {
        oslo_put_turns(writing, moved, surface->decentre != NULL);
    }
    if (surface->vary_count > 0) {
        foreign_lose(writing->job, LOSS_OF_NOTHING, "left out", "marks for the designer (R~, t~)");
    }
}

static void oslo_put_waves(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    writing_put(writing, "WV");
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        const struct lens_wavelength *one = &lens->wavelengths[i];
        writing_put(writing, " %s", writing_wave(writing, one->wavelength, one->typed, 0));
    }
    growing_string(&writing->text, lens->wavelength_count == 0 ? " 0.5875618\nWW 1.0" : "\nWW");
    for (size_t i = 0; i < lens->wavelength_count; i++) {
        writing_put(writing, " %s",
                    writing_weight(writing, lens->wavelengths[i].weight_typed, "1.0"));
    }
    writing_put(writing, "\n");
}

bool oslo_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                struct error *error)
{
    struct oslo_output output = {0};
    struct lens_writer *writing = &output.writing;
    (void)error;
    writing_begin(writing, job, lens, true);
    if (lens->stop == LENS_NONE) {
        foreign_lose(job, LOSS_OF_RAYS, "OSLO takes its first surface", "the lens has no stop");
    }
    if (lens->position_count > 0) {
        foreign_lose(job, LOSS_OF_RAYS, NULL, "the positions but the first: write them one by one");
    }
    if (lens->focus == FOCUS_BEST) {
        foreign_lose(job, LOSS_OF_RAYS, "the image lies at the last thickness", "the best focus");
    }
    writing_put(writing, "// OSLO 6.6 0 0 0\n");
    keep_notes_write(&writing->text, lens, writing->scale, OSLO_KEEP_NOTE, "\n");
    oslo_put_text(writing, "LEN NEW", lens->title != NULL ? lens->title : "");
    writing_put(writing, " 100 %zu\n", lens->surface_count + 1);
    oslo_put_beam(writing);
    oslo_put_field(writing);
    writing_put(writing, "%s%sDES \"\"\nUNI %.1f\n", lens->is_telecentric ? "TELE ON\n" : "",
                lens->focus == FOCUS_AFOCAL ? "AMO AFO\n" : "", lens_unit_mm(writing->unit));
    for (size_t i = 0; i < lens->note_count && i < 10; i++) {
        oslo_put_text(writing, arena_printf(writing->arena, "SNO%zu", i + 1), lens->notes[i]);
        writing_put(writing, "\n");
    }
    if (lens->note_count > 10) {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL, "more than ten notes");
    }
    oslo_put_medium(&output, &lens->object_medium);
    writing_put(writing, "TH %s\n",
                lens->object_is_infinite ? "1.0e+20" : writing_length(writing, &lens->object, 1));
    for (size_t i = 0; i < lens->surface_count; i++) {
        oslo_put_surface(&output, i);
    }
    writing_put(writing, "NXT\nAIR\n");
    oslo_put_waves(writing);
    writing_put(writing, "END %zu\n", lens->surface_count + 1);
    oslo_put_points(writing);
    *text = growing_done(&writing->text);
    return true;
}
