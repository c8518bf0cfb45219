/* commands/photo/focused_lens.c - a real lens focused by its gaps, before its fixed image plane. */
/* SPDX-License-Identifier: MIT */
#include "commands/photo/focused_lens.h"

#include "commands/lens/focus_gaps.h"

/* Indexed by enum distance_from. */
static const enum conjugate_from places[] = {
    [FROM_PRINCIPAL] = CONJUGATE_FROM_PRINCIPAL,
    [FROM_SENSOR] = CONJUGATE_FROM_SENSOR,
    [FROM_ENTRANCE] = CONJUGATE_FROM_ENTRANCE,
    [FROM_FRONT] = CONJUGATE_FROM_FRONT,
};

bool focused_lens(const struct focused_question *asked, struct arena *arena,
                  struct photo_lens_question *focused, struct error *error)
{
    const struct photo_lens_question *question = asked->question;
    const struct lens *typed = question->lens.lens;
    const struct lens *lens = lens_at_position(typed, asked->position, arena);
    struct focused *solutions = ARENA_ARRAY(arena, FOCUS_SOLUTIONS, struct focused);
    struct named_gap named[FOCUS_GAPS];
    struct focus_gap moved[FOCUS_GAPS];
    struct first_order first;
    struct focus_mechanism focusing = {
        .lens = lens,
        .wavelength = question->wavelength > 0 ? wavelength_micrometres(question->wavelength)
                                               : lens_primary_wavelength(typed),
        .section = (enum lens_section)question->section,
        .gaps = moved,
    };
    const struct conjugate_question object = {CONJUGATE_OBJECT, places[question->from],
                                              asked->distance, 0};
    if (!focus_gaps_read(text_of(asked->gaps), typed, named, &focusing.gap_count, error) ||
        !first_order_of_lens(lens, lens_primary_wavelength(lens), focusing.section, arena, &first,
                             error)) {
        return false;
    }
    for (size_t i = 0; i < focusing.gap_count; i++) {
        moved[i] = named[i].gap;
    }
    focusing.image_plane = setup_paraxial_image(lens, &first);
    if (focus_solve(&focusing, &object, arena, solutions, error) == 0) {
        return false;
    }
    *focused = *question;
    focused->position = NULL;
    focused->lens.lens = solutions[0].lens;
    focused->lens.memo = ARENA_NEW(arena, struct lens_memo);
    *focused->lens.memo = (struct lens_memo){.is_known = false};
    focused->lens.arena = arena;
    return true;
}
