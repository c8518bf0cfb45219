/* commands/design/design.c - what fit, optimize and tolerance share. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/design.h"

#include <string.h>

void design_note(struct lens *lens, const char *note, struct arena *arena)
{
    if (note == NULL) {
        return;
    }
    const char **notes = ARENA_ARRAY(arena, lens->note_count + 1, const char *);
    for (size_t i = 0; i < lens->note_count; i++) {
        notes[i] = lens->notes[i];
    }
    notes[lens->note_count++] = note;
    lens->notes = notes;
}

void design_note_source(struct lens *lens, const char *words, struct arena *arena)
{
    memset(lens->stated, 0, sizeof lens->stated);
    memset(lens->stated_count, 0, sizeof lens->stated_count);
    if (lens->source != NULL) {
        design_note(lens, arena_printf(arena, "%s: %s", words, lens->source), arena);
        lens->source = NULL;
    }
}

bool design_view(const struct lens_question *asked, const struct spectrum_value *waves,
                 struct arena *arena, struct merit_question *view, struct error *error)
{
    const struct lens *lens = asked->lens.lens;
    const char *names = asked->position != NULL ? asked->position : "all";
    struct setup_field *fields = ARENA_ARRAY(arena, asked->fields.count + 1, struct setup_field);
    *view = (struct merit_question){.lens = lens,
                                    .wavelengths = waves->items,
                                    .wavelength_count = waves->count,
                                    .fields = fields,
                                    .field_count = asked->fields.count,
                                    .section = (enum lens_section)asked->section,
                                    .fnumber = asked->fnumber};
    return lens_positions(lens, names, arena, &view->positions, &view->position_count, error) &&
           lens_fields_asked(asked, view->positions[0], fields, error);
}

struct part design_part(const struct run *run, struct part asked)
{
    return run->parts == NULL ? asked : (struct part){1, run->parts[0].head.part.count};
}
