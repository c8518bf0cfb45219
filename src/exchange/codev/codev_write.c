/* exchange/codev/codev_write.c - a lens as a CODE V sequence file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"
#include "exchange/codev/codev_writer.h"

#include "exchange/keep_notes.h"

static void codev_add_own(struct codev_output *output, const struct medium *medium)
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

/* A table of indices or one index for all light, as a glass of the file's own catalogue. */
static void codev_put_own(struct lens_writer *writing, const struct medium *medium, size_t number)
{
    const struct lens *lens = writing->lens;
    const bool is_table = medium->kind == MEDIUM_TABLE;
    const size_t count = is_table ? medium->point_count : lens->wavelength_count;
    size_t column = 5;
    writing_put(writing, "  PWL%s", count == 0 ? " 587.5618" : "");
    for (size_t i = 0; i < count; i++) {
        const double wave =
            is_table ? medium->points[i].wavelength : lens->wavelengths[i].wavelength;
        const struct text typed = is_table ? text_of("") : lens->wavelengths[i].typed;
        codev_put_number(writing, &column, writing_wave(writing, wave, typed, 3));
    }
    writing_put(writing, "\n  'N%zu'", number);
    column = 8;
    for (size_t i = 0; i < count || i == 0; i++) {
        struct figure figure = {.typed = medium->written, .variable = LENS_NONE};
        if (is_table) {
            figure = (struct figure){.value = medium->points[i].index, .variable = LENS_NONE};
        }
        codev_put_number(writing, &column, writing_length(writing, &figure, 0));
    }
    writing_put(writing, "\n");
}

static void codev_put_catalog(struct codev_output *output)
{
    const struct lens *lens = output->writing.lens;
    output->own = ARENA_ARRAY(output->writing.arena,
                              lens->surface_count + 1 + lens->setting_count * lens->position_count,
                              const struct medium *);
    codev_add_own(output, &lens->object_medium);
    for (size_t i = 0; i < lens->surface_count; i++) {
        codev_add_own(output, &lens->surfaces[i].medium);
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        for (size_t p = 0; p < lens->position_count && lens->settings[i].media != NULL; p++) {
            codev_add_own(output, &lens->settings[i].media[p]);
        }
    }
    for (size_t i = 0; i < output->own_count; i++) {
        growing_string(&output->writing.text, i == 0 ? "PRV\n" : "");
        codev_put_own(&output->writing, output->own[i], i + 1);
    }
    growing_string(&output->writing.text, output->own_count > 0 ? "END\n" : "");
}

/* -------- the whole lens -------- */

static void codev_put_beam(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    enum aperture_kind kind = lens->aperture_kind;
    struct figure figure = lens->apertures != NULL ? lens->apertures[0] : lens->aperture;
    if (kind == APERTURE_STOP) {
        /* the pupil that the stop's diameter gives, and a comment by which it is read as that */
        writing_put(writing, CODEV_KEEP_NOTE CODEV_STOP_RULES "\n");
        figure = (struct figure){.variable = LENS_NONE};
        if (!writing_pupil(writing, 0, &figure)) {
            foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                         "an aperture that is ruled by a stop without a pupil");
            return;
        }
        writing_put(writing, "EPD %.*s\n", (int)figure.typed.length, figure.typed.start);
        return;
    }
    if (kind == APERTURE_NONE) {
        return;
    }
    if (kind == APERTURE_FNUMBER && !lens->object_is_infinite) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "CODE V takes it as the working one",
                     "the f-number of a lens with a near object");
    }
    writing_put(writing, "%s %s\n", codev_aperture_words[kind],
                writing_length(writing, &figure, kind == APERTURE_EPD));
}

/* XAN, YAN; WTF where there are weights. */
static void codev_put_all_fields(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    const struct lens_points points = {lens->fields, lens->field_count};
    bool weighted = false;
    for (int axis = CODEV_X; axis <= CODEV_Y && lens->field_kind != FIELD_NONE; axis++) {
        codev_put_fields(writing, codev_field_words[lens->field_kind][axis], &points,
                         (enum codev_row)axis);
    }
    for (size_t i = 0; i < lens->field_count; i++) {
        weighted = weighted || lens->fields[i].weight != 1;
    }
    if (weighted) {
        codev_put_fields(writing, "WTF", &points, CODEV_WEIGHTS);
    }
}

/* -------- surfaces -------- */

static void codev_put_turns(struct lens_writer *writing, const struct displacement *all, bool back)
{
    writing_put(writing, "  XDE %s; YDE %s; ZDE 0.0\n  ADE %s; BDE %s; CDE %s\n%s",
                writing_length(writing, &all->decenter[0], 1),
                writing_length(writing, &all->decenter[1], 1),
                writing_turned(writing, &all->tilt[0]), writing_turned(writing, &all->tilt[1]),
                writing_degrees(writing, &all->tilt[2]), back ? "  DAR\n" : "");
}

/* ASP has the even powers from r^4 on, SPS ODD all; of a cylinder there is only ASP. */
static void codev_put_asphere(struct lens_writer *writing, const struct surface *surface)
{
    bool is_odd = codev_is_odd(surface), is_even = false;
    bool conic = surface->conic.value.hi != 0 || surface->conic.typed.start != NULL;
    for (int i = 0; i < LENS_COEFFICIENTS; i++) {
        is_even = is_even || (codev_is_term_given(surface, i) && codev_is_of_asp(i));
    }
    if (is_odd && !surface_is_round(surface)) {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                     "CODE V has no cylinder with the coefficient A2 or odd ones");
        return;
    }
    if (is_odd) {
        writing_put(writing, "  SPS ODD 0.0\n  SCO K ");
    } else if (is_even) {
        writing_put(writing, "  ASP\n  K ");
    } else if (conic) {
        writing_put(writing, "  CON\n  K ");
    } else {
        return;
    }
    writing_put(writing, "%s\n", conic ? writing_length(writing, &surface->conic, 0) : "0.0");
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        int i = surface_term(order);
        if (codev_is_term_given(surface, i) && (is_odd || codev_is_of_asp(i))) {
            writing_put(writing, "  %s%s %s\n", is_odd ? "SCO " : "",
                        codev_coefficient_word(order, is_odd, writing->arena),
                        writing_length(writing, &surface->coefficient[i], 1 - order));
        }
    }
}

/* Why there are no words for an aperture; null: there are. */
static const char *codev_aperture_refusal(const struct surface *surface,
                                          const struct aperture *aperture)
{
    const struct aperture_traits *traits = &aperture_shapes[aperture->shape];
    bool circle = aperture->shape == SHAPE_CIRCLE;
    size_t circles = 0;
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *other = &surface->apertures[i];
        circles += !other->blocks && other->shape == SHAPE_CIRCLE ? 1 : 0;
    }
    if (traits->has_points || traits->has_arms || aperture->shape == SHAPE_RING) {
        return "no such shape is written";
    }
    if (!circle && aperture->turn.value.hi != 0) {
        return "none is written that is turned";
    }
    return circle && !aperture->blocks && (surface->has_diameter || circles > 1)
               ? "a surface has one clear circle"
               : NULL;
}

/* What passes or blocks light beside the diameter; the shapes that are not written are losses. */
static void codev_put_apertures(struct lens_writer *writing, const struct surface *surface)
{
    static const char *const sizes[][2] = {[SHAPE_CIRCLE] = {"CIR", NULL},
                                           [SHAPE_RECTANGLE] = {"REX", "REY"},
                                           [SHAPE_ELLIPSE] = {"ELX", "ELY"}};
    static const char *const shifts[] = {"ADX", "ADY"};
    for (size_t i = 0; i < surface->aperture_count; i++) {
        const struct aperture *one = &surface->apertures[i];
        const char *refusal = codev_aperture_refusal(surface, one), *label = "";
        if (refusal != NULL) {
            writing_lose_aperture(writing, surface, one, refusal);
            continue;
        }
        if (one->shape != SHAPE_CIRCLE || one->blocks) {
            label = arena_printf(writing->arena, "%s L'a%zu'", one->blocks ? " OBS" : "", i + 1);
        }
        for (int k = 0; k < 2 && sizes[one->shape][k] != NULL; k++) {
            writing_put(writing, "  %s%s %s\n", sizes[one->shape][k], label,
                        writing_half(writing, &one->size[k]));
        }
        for (int k = 0; k < 2; k++) {
            if (one->decenter[k].value.hi != 0) {
                writing_put(writing, "  %s%s %s\n", shifts[k], label,
                            writing_length(writing, &one->decenter[k], 1));
            }
        }
    }
}

static void codev_put_details(struct lens_writer *writing, const struct surface *surface)
{
    bool along_x = surface->curved == CURVED_X;
    const struct displacement *moved =
        surface->decentre != NULL ? surface->decentre : surface->coordinate_break;
    growing_string(&writing->text, surface_is_round(surface) ? "" : "  CYL\n");
    if (surface->has_curvature) {
        writing_put(writing, "  %s %s\n", along_x ? "CUX" : "CUY",
                    writing_length(writing, &surface->curvature, -1));
    } else if (along_x && !surface->is_plane) {
        writing_put(writing, "  RDX %s\n", writing_length(writing, &surface->radius, 1));
    }
    growing_string(&writing->text, surface->is_stop ? "  STO\n" : "");
    if (surface->has_diameter) {
        writing_put(writing, "  CIR %s\n", writing_half(writing, &surface->diameter));
    }
    codev_put_apertures(writing, surface);
    if (surface->name != NULL) {
        codev_put_text(writing, "  SLB", surface->name);
    }
    if (moved != NULL) {
        codev_put_turns(writing, moved, surface->decentre != NULL);
    }
    if (surface->vary_count > 0) {
        foreign_lose(writing->job, LOSS_OF_NOTHING, "left out", "marks for the designer (R~, t~)");
    }
    codev_put_asphere(writing, surface);
}

static void codev_put_surface(struct codev_output *output, size_t index)
{
    struct lens_writer *writing = &output->writing;
    const struct surface *surface = &writing->lens->surfaces[index];
    const struct medium *before = index > 0 ? &surface[-1].medium : &writing->lens->object_medium;
    bool has_radius = !surface->is_plane && !surface->has_curvature && surface->curved != CURVED_X;
    if (surface->decentre != NULL && surface->coordinate_break != NULL) {
        writing_put(writing, "S 0.0 0.0"); /* the break on a plane of its own */
        codev_put_medium(output, before);
        writing_put(writing, "\n");
        codev_put_turns(writing, surface->coordinate_break, false);
    }
    writing_put(writing, "S %s %s",
                has_radius ? writing_length(writing, &surface->radius, 1) : "0.0",
                surface->has_thickness ? writing_length(writing, &surface->thickness, 1) : "0.0");
    if (surface_reflects(surface)) {
        writing_put(writing, " REFL");
    } else {
        codev_put_medium(output, &surface->medium);
    }
    writing_put(writing, "\n");
    codev_put_details(writing, surface);
}

bool codev_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error)
{
    struct codev_output output = {0};
    struct lens_writer *writing = &output.writing;
    (void)error;
    writing_begin(writing, job, lens, false);
    writing_put(writing, "RDM;LEN\n");
    if (lens->title != NULL) {
        codev_put_text(writing, "TITLE", lens->title);
    }
    keep_notes_write(&writing->text, lens, writing->scale, CODEV_KEEP_NOTE, "\n");
    for (size_t i = 0; i < lens->note_count; i++) {
        writing_put(writing, CODEV_KEEP_NOTE CODEV_NOTE "%s\n", lens->notes[i]);
    }
    codev_put_beam(writing);
    writing_put(writing, "DIM %s\n", foreign_unit_word(codev_units, writing->unit));
    const struct lens_light light = {lens->wavelengths, lens->wavelength_count};
    if (light.count > 0) {
        codev_put_waves(writing, "WL", &light, false);
        writing_put(writing, "REF 1\n");
        codev_put_waves(writing, "WTW", &light, true);
    } else {
        writing_put(writing, "WL 587.5618\nREF 1\nWTW 1\n");
    }
    codev_put_all_fields(writing);
    writing_put(writing, "%s%s", lens->is_telecentric ? "TEL Y\n" : "",
                lens->focus == FOCUS_AFOCAL ? "AFC Y\n" : "");
    codev_put_catalog(&output);
    writing_put(writing, "SO 0.0 %s",
                lens->object_is_infinite ? "0.1e14" : writing_length(writing, &lens->object, 1));
    codev_put_medium(&output, &lens->object_medium);
    writing_put(writing, "\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        codev_put_surface(&output, i);
    }
    writing_put(writing, lens->focus == FOCUS_PARAXIAL ? "  PIM\nSI 0.0 0.0\n" : "SI 0.0 0.0\n");
    if (lens->focus == FOCUS_BEST) {
        foreign_lose(job, LOSS_OF_RAYS, "the image lies at the last thickness", "the best focus");
    }
    codev_put_positions(&output);
    writing_put(writing, "GO\n");
    *text = growing_done(&writing->text);
    return true;
}
