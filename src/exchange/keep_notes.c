/* exchange/keep_notes.c - what lenscalc keeps of other programs' files: comments, pick-ups. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "optics/pickup.h"

#include "file/lens_unit.h"

#include <math.h>

static const char *const names[KEEP_NOTES] = {
    [KEEP_NOTE_SOURCE] = "source ",
    [KEEP_NOTE_KIND] = "kind ",
    [KEEP_NOTE_STATED + STATED_EFL] = "stated efl ",
    [KEEP_NOTE_STATED + STATED_BFL] = "stated bfl ",
    [KEEP_NOTE_STATED + STATED_FNUMBER] = "stated fnumber ",
    [KEEP_NOTE_STATED + STATED_TSTOP] = "stated tstop ",
};

static struct number_scale keep_notes_scale_of(int stated, struct number_scale unit)
{
    return stated_is_length(stated) ? unit : NUMBER_UNSCALED;
}

static void keep_notes_put_line(struct text_buffer *out, const char *begin, enum keep_note note,
                                const char *text, const char *end)
{
    if (text != NULL) {
        growing_format(out, "%s%s%s%s", begin, names[note], text, end);
    }
}

void keep_notes_write(struct text_buffer *out, const struct lens *lens, struct number_scale unit,
                      const char *begin, const char *end)
{
    keep_notes_put_line(out, begin, KEEP_NOTE_SOURCE, lens->source, end);
    keep_notes_put_line(out, begin, KEEP_NOTE_KIND, lens->kind, end);
    for (int i = 0; i < STATED_COUNT; i++) {
        for (size_t k = 0; k < lens->stated_count[i]; k++) {
            growing_format(out, "%s%s", k == 0 ? begin : " ",
                           k == 0 ? names[KEEP_NOTE_STATED + i] : "");
            growing_figure(out, &lens->stated[i][k], keep_notes_scale_of(i, unit));
        }
        growing_string(out, lens->stated_count[i] > 0 ? end : "");
    }
}

bool keep_notes_take(struct keep_notes *notes, struct text text)
{
    for (int i = 0; i < KEEP_NOTES; i++) {
        const struct text rest = text_behind(text, names[i]);
        if (rest.start != NULL) {
            notes->texts[i] = rest;
            return true;
        }
    }
    return false;
}

static void set_stated(struct text rest, struct lens_build *build, int what)
{
    struct lens *lens = build->lens;
    struct number_scale unit = keep_notes_scale_of(what, lens_unit_scale(lens->unit));
    size_t most = lens->position_count > 0 ? lens->position_count : 1, count = 0;
    struct figure *figures = ARENA_ARRAY(build->arena, most, struct figure);
    while (rest.start != NULL && rest.length > 0 && count < most) {
        struct text word = text_cut(&rest, ' ');
        figures[count] = (struct figure){.typed = word, .variable = LENS_NONE};
        if (!text_pair(word, unit, &figures[count].value) ||
            !(fabs(figures[count].value.hi) < 1e100)) {
            return;
        }
        count++;
    }
    if (rest.start == NULL && (count == 1 || (count > 0 && count == most))) {
        lens->stated[what] = figures;
        lens->stated_count[what] = count;
    }
}

void keep_notes_apply(const struct keep_notes *notes, struct lens_build *build)
{
    const struct text source = notes->texts[KEEP_NOTE_SOURCE], kind = notes->texts[KEEP_NOTE_KIND];
    build->lens->source = source.length > 0 ? lens_build_string(build, source) : NULL;
    build->lens->kind = kind.length > 0 ? lens_build_string(build, kind) : NULL;
    for (int i = 0; i < STATED_COUNT; i++) {
        set_stated(notes->texts[KEEP_NOTE_STATED + i], build, i);
    }
}

void keep_pickup(struct lens *lens, struct parameter what, struct parameter from,
                 struct pair factor, struct pair offset, struct arena *arena)
{
    struct lens_pickup pickup = {
        .what = what,
        .from = from,
        .factor = {.value = factor, .variable = LENS_NONE},
        .offset = {.value = offset, .variable = LENS_NONE},
    };
    const struct arena_mark mark = arena_mark(arena);
    bool there = what.surface < lens->surface_count && from.surface < lens->surface_count &&
                 lens->position_count == 0 && lens->pickup_count < LENS_MOST_PICKUPS &&
                 fabs(factor.hi) > 0;
    /* R6 = -R3 is what people write of two radii, not c6 = -c3. */
    if (there && what.kind == PARAMETER_CURVATURE && from.kind == PARAMETER_CURVATURE &&
        !lens->surfaces[what.surface].is_plane && !lens->surfaces[from.surface].is_plane &&
        offset.hi == 0 && fabs(factor.hi) == 1) {
        pickup.what.kind = pickup.from.kind = PARAMETER_RADIUS;
    }
    if (there && parameter_suits(what.kind, &lens->surfaces[what.surface]) &&
        parameter_suits(from.kind, &lens->surfaces[from.surface])) {
        /* Does the lens have what the pick-up gives? */
        struct lens_pickup alone = pickup;
        struct lens *trial = parameter_apply(lens, NULL, NULL, 0, arena);
        trial->pickups = &alone;
        trial->pickup_count = 1;
        lens_pickups_put(trial, lens, arena);
        there = what.kind == PARAMETER_GLASS
                    ? medium_is_same(&trial->surfaces[what.surface].medium,
                                     &lens->surfaces[what.surface].medium)
                    : parameter_get(trial, what) == parameter_get(lens, what);
        arena_reset(arena, mark);
        if (there) {
            lens_pickup_add(lens, pickup, arena);
        }
    }
}
