/* exchange/zemax/zemax_write.c - a lens as a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/zemax/zemax.h"
#include "exchange/zemax/zemax_aperture.h"
#include "exchange/zemax/zemax_parse.h"
#include "exchange/zemax/zemax_writer.h"
#include "file/lens_build.h"
#include "file/lens_solve.h"
#include "optics/wavelength.h"

#include "base/constants.h"
#include "file/lens_unit.h"

#include <math.h>

enum { MOST_FIELDS = 12, MOST_WAVES = 24 };

/* Has a position a distance of the image that its paraxial focus is not? It stays in the file. */
static bool has_other_distance(const struct zemax_writer *writer)
{
    const struct lens *all = writer->lens;
    struct arena *arena = writer->job->arena;
    const size_t last = all->surface_count - 1;
    const size_t count = all->position_count > 0 ? all->position_count : 1;
    bool other = false;
    for (size_t p = 0; p < count && all->focus == FOCUS_PARAXIAL && !other; p++) {
        const struct lens *lens = lens_at_position(all, p, arena);
        const struct figure *typed = &lens->surfaces[last].thickness;
        struct solve_state state;
        struct error unknown;
        other = lens->surfaces[last].has_thickness && typed->value.hi != 0 &&
                solve_follow(lens, last, SOLVE_MARGINAL, arena, &state, &unknown) &&
                !(fabs(pair_subtract(solve_thickness(&state, pair_of(0)), typed->value).hi) <=
                  1e-10 * fabs(typed->value.hi));
    }
    return other;
}

static void put_notes(struct zemax_writer *writer)
{
    const struct lens *lens = writer->lens;
    for (size_t i = 0; i < lens->note_count; i++) {
        growing_string(&writer->out, "NOTE 0 ");
        growing_string(&writer->out, lens->notes[i]);
        growing_string(&writer->out, "\r\n");
    }
    keep_notes_write(&writer->out, lens, writer->unit, "NOTE 0 " ZEMAX_KEEP_NOTE, "\r\n");
    if (has_other_distance(writer)) {
        growing_string(&writer->out, "NOTE 0 " ZEMAX_KEEP_NOTE ZEMAX_OTHER_DISTANCE "\r\n");
    }
    if (lens->position_count > 0) {
        growing_string(&writer->out, "NOTE 0 " ZEMAX_KEEP_NOTE ZEMAX_POSITIONS);
        for (size_t i = 0; i < lens->position_count; i++) {
            growing_string(&writer->out, i > 0 ? " " : "");
            growing_string(&writer->out, lens->positions[i]);
        }
        growing_string(&writer->out, "\r\n");
    }
}

static void zemax_write_put_aperture(struct zemax_writer *writer)
{
    static const char *const words[] = {"", "FLOA", "FNUM ", "ENPD ", "OBNA "};
    const struct lens *lens = writer->lens;
    const struct figure *aperture = lens->apertures != NULL ? &lens->apertures[0] : &lens->aperture;
    if (lens->aperture_kind == APERTURE_NONE) {
        return;
    }
    growing_string(&writer->out, words[lens->aperture_kind]);
    if (lens->aperture_kind != APERTURE_STOP) {
        growing_figure(&writer->out, aperture,
                       lens->aperture_kind == APERTURE_EPD ? writer->unit : NUMBER_UNSCALED);
        growing_string(&writer->out, lens->aperture_kind == APERTURE_EPD ? "" : " 0");
    }
    growing_string(&writer->out, "\r\n");
}

/* Where some is not 1. */
static void put_field_weights(struct zemax_writer *writer, size_t count)
{
    const struct lens *lens = writer->lens;
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        any = any || lens->fields[i].weight != 1;
    }
    for (size_t i = 0; i < count && any; i++) {
        growing_string(&writer->out, i == 0 ? "FWGN " : " ");
        growing_number(&writer->out, lens->fields[i].weight);
    }
    growing_string(&writer->out, any ? "\r\n" : "");
}

static bool zemax_write_put_fields(struct zemax_writer *writer, struct error *error)
{
    static const int types[] = {0, 0, 1, 2, 3};
    const struct lens *lens = writer->lens;
    size_t waves = lens->wavelength_count > 0 ? lens->wavelength_count : 1;
    size_t count = lens->field_count < MOST_FIELDS ? lens->field_count : MOST_FIELDS;
    if (count < lens->field_count &&
        !foreign_lose(writer->job, error,
                      "more than %d fields" LOSS_INSTEAD "those beyond are left out",
                      MOST_FIELDS)) {
        return false;
    }
    growing_format(&writer->out, "FTYP %d %d %zu %zu 0 0 %d\r\n", types[lens->field_kind],
                   lens->is_telecentric, count > 0 ? count : 1,
                   waves < MOST_WAVES ? waves : MOST_WAVES, lens->focus == FOCUS_AFOCAL);
    if (count == 0) {
        return true;
    }
    for (int axis = 0; axis < 2; axis++) {
        growing_string(&writer->out, axis == 0 ? "XFLN" : "YFLN");
        for (size_t i = 0; i < count; i++) {
            zemax_put_field(writer, &lens->fields[i].at[axis]);
        }
        growing_string(&writer->out, "\r\n");
    }
    put_field_weights(writer, count);
    return true;
}

static bool zemax_write_put_waves(struct zemax_writer *writer, struct error *error)
{
    const struct lens *lens = writer->lens;
    if (lens->wavelength_count == 0) {
        growing_string(&writer->out, "WAVM 1 ");
        growing_number(&writer->out, WAVELENGTH_D);
        growing_string(&writer->out, " 1\r\n");
    }
    for (size_t i = 0; i < lens->wavelength_count && i < MOST_WAVES; i++) {
        growing_format(&writer->out, "WAVM %zu ", i + 1);
        growing_number(&writer->out, lens->wavelengths[i].wavelength);
        growing_string(&writer->out, " ");
        growing_number(&writer->out, lens->wavelengths[i].weight);
        growing_string(&writer->out, "\r\n");
    }
    growing_string(&writer->out, "PWAV 1\r\n");
    return lens->wavelength_count <= MOST_WAVES ||
           foreign_lose(writer->job, error,
                        "more than %d wavelengths" LOSS_INSTEAD "those beyond are left out",
                        MOST_WAVES);
}

static bool zemax_write_put_header(struct zemax_writer *writer, struct error *error)
{
    const struct lens *lens = writer->lens;
    growing_string(&writer->out, "MODE SEQ\r\n");
    if (lens->title != NULL) {
        growing_string(&writer->out, "NAME ");
        growing_string(&writer->out, lens->title);
        growing_string(&writer->out, "\r\n");
    }
    put_notes(writer);
    growing_format(&writer->out, "UNIT %s X W X CM MR CPMM\r\n",
                   foreign_unit_word(zemax_units, lens->unit));
    zemax_write_put_aperture(writer);
    if (writer->catalog_count > 0) {
        growing_string(&writer->out, "GCAT");
        for (size_t i = 0; i < writer->catalog_count; i++) {
            growing_string(&writer->out, " ");
            growing_text(&writer->out, writer->catalogs[i]);
        }
        growing_string(&writer->out, "\r\n");
    }
    return zemax_write_put_fields(writer, error) && zemax_write_put_waves(writer, error);
}

static bool zemax_write_put_object(struct zemax_writer *writer, struct error *error)
{
    const struct lens *lens = writer->lens;
    const struct figure *object = lens->objects != NULL ? &lens->objects[0] : &lens->object;
    zemax_put_surf(writer, "STANDARD");
    growing_string(&writer->out, "  CURV 0 0 0 0 0 \"\"\r\n  DISZ ");
    if (isinf(object->value.hi)) {
        growing_string(&writer->out, "INFINITY");
    } else {
        growing_figure(&writer->out, object, writer->unit);
    }
    growing_string(&writer->out, "\r\n");
    return zemax_put_medium(writer, &lens->object_medium, error);
}

bool zemax_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error)
{
    struct zemax_writer writer = {.out = {.arena = job->arena},
                                  .job = job,
                                  .lens = lens,
                                  .unit = lens_unit_scale(lens->unit),
                                  .places = ARENA_ARRAY(job->arena, lens->surface_count, size_t),
                                  .own_places =
                                      ARENA_ARRAY(job->arena, lens->surface_count, size_t)};
    zemax_note_catalog(&writer, &lens->object_medium);
    for (size_t i = 0; i < lens->surface_count; i++) {
        zemax_note_catalog(&writer, &lens->surfaces[i].medium);
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        for (size_t p = 0; p < lens->position_count && lens->settings[i].media != NULL; p++) {
            zemax_note_catalog(&writer, &lens->settings[i].media[p]);
        }
    }
    if (!zemax_write_put_header(&writer, error) || !zemax_write_put_object(&writer, error)) {
        return false;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!zemax_put_surface(&writer, i, error)) {
            return false;
        }
    }
    zemax_put_surf(&writer, "STANDARD");
    growing_string(&writer.out, "  CURV 0 0 0 0 0 \"\"\r\n  DISZ 0\r\n");
    bool kept = zemax_put_positions(&writer, error);
    *text = growing_done(&writer.out);
    return kept &&
           (lens->focus != FOCUS_BEST ||
            foreign_lose(writer.job, error,
                         "the best focus" LOSS_INSTEAD "the image lies at the last thickness"));
}
