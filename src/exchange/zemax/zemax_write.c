/* exchange/zemax/zemax_write.c - a lens as a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/zemax/zemax.h"
#include "exchange/zemax/zemax_writer.h"
#include "file/lens_solve.h"
#include "optics/wavelength.h"

#include <math.h>

enum { MOST_FIELDS = 12, MOST_WAVES = 24 };

/* Has a position a distance of the image that its paraxial focus is not? It stays in the file. */
static bool has_other_distance(const struct lens *all, struct arena *arena)
{
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

/* Those of the lens, and what the format has no words for. */
static void zemax_put_notes(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    for (size_t i = 0; i < lens->note_count; i++) {
        writing_put(writing, "NOTE 0 %s\r\n", lens->notes[i]);
    }
    keep_notes_write(&writing->text, lens, writing->scale, "NOTE 0 " ZEMAX_KEEP_NOTE, "\r\n");
    if (has_other_distance(lens, writing->arena)) {
        writing_put(writing, "NOTE 0 " ZEMAX_KEEP_NOTE ZEMAX_OTHER_DISTANCE "\r\n");
    }
    for (size_t i = 0; i < lens->position_count; i++) {
        writing_put(writing, "%s%s", i == 0 ? "NOTE 0 " ZEMAX_KEEP_NOTE ZEMAX_POSITIONS : " ",
                    lens->positions[i]);
    }
    growing_string(&writing->text, lens->position_count > 0 ? "\r\n" : "");
}

static void zemax_put_system_aperture(struct lens_writer *writing)
{
    static const struct {
        const char *word, *behind;
    } words[] = {[APERTURE_FNUMBER] = {"FNUM", " 0"},
                 [APERTURE_EPD] = {"ENPD", ""},
                 [APERTURE_NA] = {"OBNA", " 0"}};
    const struct lens *lens = writing->lens;
    const struct figure *figure = lens->apertures != NULL ? &lens->apertures[0] : &lens->aperture;
    const enum aperture_kind kind = lens->aperture_kind;
    growing_string(&writing->text, kind == APERTURE_STOP ? "FLOA\r\n" : "");
    if (kind > APERTURE_STOP) {
        writing_put(writing, "%s %s%s\r\n", words[kind].word,
                    writing_length(writing, figure, kind == APERTURE_EPD), words[kind].behind);
    }
}

static void zemax_put_fields(struct lens_writer *writing)
{
    static const int types[] = {0, 0, 1, 2, 3};
    const struct lens *lens = writing->lens;
    size_t waves = lens->wavelength_count > 0 ? lens->wavelength_count : 1;
    size_t count = lens->field_count < MOST_FIELDS ? lens->field_count : MOST_FIELDS;
    bool weighted = false;
    if (count < lens->field_count) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "those beyond are left out", "more than %d fields",
                     MOST_FIELDS);
    }
    writing_put(writing, "FTYP %d %d %zu %zu 0 0 %d\r\n", types[lens->field_kind],
                lens->is_telecentric, count > 0 ? count : 1,
                waves < MOST_WAVES ? waves : MOST_WAVES, lens->focus == FOCUS_AFOCAL);
    for (int axis = 0; axis < 2 && count > 0; axis++) {
        writing_put(writing, axis == 0 ? "XFLN" : "YFLN");
        for (size_t i = 0; i < count; i++) {
            writing_put(writing, " %s", zemax_coordinate(writing, &lens->fields[i].at[axis]));
        }
        writing_put(writing, "\r\n");
    }
    for (size_t i = 0; i < count; i++) {
        weighted = weighted || lens->fields[i].weight != 1;
    }
    for (size_t i = 0; i < count && weighted; i++) {
        growing_string(&writing->text, i == 0 ? "FWGN " : " ");
        growing_number(&writing->text, lens->fields[i].weight);
    }
    growing_string(&writing->text, weighted ? "\r\n" : "");
}

static void zemax_put_wave(struct lens_writer *writing, size_t number, double wavelength,
                           double weight)
{
    writing_put(writing, "WAVM %zu ", number);
    growing_number(&writing->text, wavelength);
    writing_put(writing, " ");
    growing_number(&writing->text, weight);
    writing_put(writing, "\r\n");
}

static void zemax_put_waves(struct lens_writer *writing)
{
    const struct lens *lens = writing->lens;
    if (lens->wavelength_count == 0) {
        zemax_put_wave(writing, 1, WAVELENGTH_D, 1);
    }
    for (size_t i = 0; i < lens->wavelength_count && i < MOST_WAVES; i++) {
        zemax_put_wave(writing, i + 1, lens->wavelengths[i].wavelength,
                       lens->wavelengths[i].weight);
    }
    writing_put(writing, "PWAV 1\r\n");
    if (lens->wavelength_count > MOST_WAVES) {
        foreign_lose(writing->job, LOSS_OF_RAYS, "those beyond are left out",
                     "more than %d wavelengths", MOST_WAVES);
    }
}

static void zemax_put_header(struct zemax_writer *writer)
{
    struct lens_writer *writing = &writer->writing;
    const struct lens *lens = writing->lens;
    writing_put(writing, "MODE SEQ\r\n");
    if (lens->title != NULL) {
        writing_put(writing, "NAME %s\r\n", lens->title);
    }
    zemax_put_notes(writing);
    writing_put(writing, "UNIT %s X W X CM MR CPMM\r\n",
                foreign_unit_word(zemax_units, lens->unit));
    zemax_put_system_aperture(writing);
    for (size_t i = 0; i < writer->catalog_count; i++) {
        const struct text name = writer->catalogs[i];
        writing_put(writing, "%s %.*s", i == 0 ? "GCAT" : "", (int)name.length, name.start);
    }
    growing_string(&writing->text, writer->catalog_count > 0 ? "\r\n" : "");
    zemax_put_fields(writing);
    zemax_put_waves(writing);
}

bool zemax_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                 struct error *error)
{
    struct zemax_writer writer = {.places = ARENA_ARRAY(job->arena, lens->surface_count, size_t),
                                  .own_places =
                                      ARENA_ARRAY(job->arena, lens->surface_count, size_t)};
    writing_begin(&writer.writing, job, lens, true);
    zemax_note_catalog(&writer, &lens->object_medium);
    for (size_t i = 0; i < lens->surface_count; i++) {
        zemax_note_catalog(&writer, &lens->surfaces[i].medium);
    }
    for (size_t i = 0; i < lens->setting_count; i++) {
        for (size_t p = 0; p < lens->position_count && lens->settings[i].media != NULL; p++) {
            zemax_note_catalog(&writer, &lens->settings[i].media[p]);
        }
    }
    zemax_put_header(&writer);
    struct lens_writer *writing = &writer.writing;
    const struct figure *object = lens->objects != NULL ? &lens->objects[0] : &lens->object;
    zemax_put_surf(&writer, "STANDARD");
    writing_put(writing, "  CURV 0 0 0 0 0 \"\"\r\n  DISZ %s\r\n",
                isinf(object->value.hi) ? "INFINITY" : writing_length(writing, object, 1));
    if (!zemax_put_medium(&writer, &lens->object_medium, error)) {
        return false;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!zemax_put_surface(&writer, i, error)) {
            return false;
        }
    }
    zemax_put_surf(&writer, "STANDARD");
    writing_put(&writer.writing, "  CURV 0 0 0 0 0 \"\"\r\n  DISZ 0\r\n");
    bool kept = zemax_put_positions(&writer, error);
    *text = growing_done(&writer.writing.text);
    if (kept && lens->focus == FOCUS_BEST) {
        foreign_lose(job, LOSS_OF_RAYS, "the image lies at the last thickness", "the best focus");
    }
    return kept;
}
