/* commands/data/list_lenses.c - lenscalc list lenses. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"
#include "exchange/lens_open.h"
#include "optics/first_order.h"

#include <math.h>

struct list_lenses_lens_row {
    const char *name, *title, *kind, *positions, *source, *note, *place, *warning;
    double efl, bfl, fnumber; /* of the first position */
    long surfaces;
};

#define ROW struct list_lenses_lens_row

static const struct column lens_columns[] = {
    {SHOWN(name), .name = "lens", BRIEF, .help = "name that commands take"},
    {SHOWN(kind), .name = "kind", BRIEF, .help = "class of lenses"},
    {LENGTH(efl, "mm"), .name = "efl", BRIEF, .label = "focal length",
     .help = "effective focal length as computed, in the first position"},
    {SHOWN(fnumber), .name = "fnumber", BRIEF, .label = "f-number",
     .help = "f-number by its aperture; absent where none is stated"},
    {LENGTH(bfl, "mm"), .name = "bfl", .label = "back focus", .help = "paraxial back focus"},
    {SHOWN(surfaces), .name = "surfaces", BRIEF, .help = "number of surfaces, the stop counted"},
    {SHOWN(positions), .name = "positions", BRIEF, .help = "names of zoom or focus positions"},
    /* the longest one last: a narrow terminal cuts or wraps nothing else */
    {SHOWN(title), .name = "title", BRIEF, .help = "what it is"},
    {SHOWN(source), .name = "source", .help = "where it was published"},
    {SHOWN(note), .name = "note", .help = "what to know of it"},
    {SHOWN(warning), .name = "warning", .help = "what is doubtful"},
    {SHOWN(place), .name = "database", .help = "embedded, or the user's own folder"},
};

static const char *joined_texts(const char *const *texts, size_t count, struct arena *arena)
{
    const char *all = NULL;
    for (size_t i = 0; i < count; i++) {
        all = i == 0 ? texts[0] : arena_printf(arena, "%s %s", all, texts[i]);
    }
    return all;
}

/* A lens that cannot be computed keeps its row. */
static void list_lenses_compute(const struct lens *lens, struct arena *arena,
                                struct list_lenses_lens_row *row)
{
    const struct lens *first = lens_at_position(lens, 0, arena);
    const struct conjugate_object object = lens_object(first);
    struct first_order all;
    struct lens_warnings warnings;
    struct error error;
    if (!lens_check(lens, arena, &warnings, &error) ||
        !first_order_of_lens(first, lens_primary_wavelength(first), SECTION_Y, arena, &all,
                             &error)) {
        row->warning = arena_printf(arena, "%s", error.message);
        return;
    }
    const struct aperture_setting aperture = lens_aperture(first);
    if (!first_order_aperture(&all, &object, &aperture, FIELD_NONE, NAN, &error)) {
        row->warning = arena_printf(arena, "%s", error.message);
    }
    row->efl = all.is_afocal ? NAN : all.efl;
    row->bfl = all.is_afocal ? NAN : all.bfl;
    row->fnumber = all.fnumber;
    const char *stated = lens_stated_warning(lens, 0, &all, arena);
    if (stated != NULL) {
        row->warning = stated;
    } else if (warnings.count > 0) {
        row->warning = warnings.texts[0];
    }
}

/* A file that is no lens keeps its row, too, and the rest is listed. */
static void list_broken(struct list *list, struct list_lenses_lens_row *row,
                        const struct error *failure)
{
    struct arena *arena = list->run->arena;
    row->surfaces = NO_INTEGER;
    row->warning = failure->line > 0
                       ? arena_printf(arena, "%s:%ld:%d: %s", failure->source, failure->line,
                                      failure->column, failure->message)
                       : arena_printf(arena, "%s", failure->message);
    if (list->input->kind != NULL || !list_matches(list, NULL, (const char *[]){row->name}, 1)) {
        return;
    }
    list_row(list, row);
    warnings_add(list->run->doubts, "%s: %s", row->name, row->warning);
    fail(&list->run->shortfall, ERROR_DATA, "not all files of %s/lenses are lenses",
         list->run->db->directory);
}

/* `arena` is given up after each lens. */
static void list_lens(struct list *list, const char *name, struct arena *arena)
{
    struct lens lens;
    struct error error;
    struct list_lenses_lens_row row = {
        .name = name, .place = list_place(list->place), .efl = NAN, .bfl = NAN, .fnumber = NAN};
    if (!lens_open(list->run->db, text_of(name), arena, &lens, &error)) {
        list_broken(list, &row, &error);
        return;
    }
    row = (struct list_lenses_lens_row){
        .name = name,
        .title = lens.title,
        .kind = lens.kind,
        .positions = joined_texts(lens.positions, lens.position_count, arena),
        .source = lens.source,
        .note = joined_texts(lens.notes, lens.note_count, arena),
        .place = row.place,
        .efl = NAN,
        .bfl = NAN,
        .fnumber = NAN,
        .surfaces = (long)lens.surface_count,
    };
    /* "zoom" is any zoom: "zoom tele", "cine anamorphic zoom" */
    const char *kind = list->input->kind != NULL && row.kind != NULL &&
                               text_contains_name(text_of(row.kind), text_of(list->input->kind))
                           ? list->input->kind
                           : row.kind;
    if (list_matches(list, kind, (const char *[]){row.name, row.title, row.source}, 3)) {
        list_lenses_compute(&lens, arena, &row);
        /* A row outlives its lens. */
        const char **const texts[] = {&row.title,  &row.kind, &row.positions,
                                      &row.source, &row.note, &row.warning};
        for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
            *texts[i] = *texts[i] != NULL ? list_string(list, text_of(*texts[i])) : NULL;
        }
        list_row(list, &row);
    }
}

static bool list_lenses(struct list *list, struct error *error)
{
    const char *const *names;
    struct arena of_lens = {0};
    if (!lens_open_names(list->run->db, list->place, list->run->arena, &names, error)) {
        return false;
    }
    for (; *names != NULL; names++) {
        const struct arena_mark mark = arena_mark(&of_lens);
        list_lens(list, *names, &of_lens);
        arena_reset(&of_lens, mark);
    }
    arena_free(&of_lens);
    return true;
}

const struct topic topic_lenses = {SHEET(lens_columns, struct list_lenses_lens_row), list_lenses,
                                   true};
