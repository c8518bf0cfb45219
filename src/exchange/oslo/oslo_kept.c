/* exchange/oslo/oslo_kept.c - what lenscalc has written into an OSLO file as comments. */
/* SPDX-License-Identifier: MIT */
#include "exchange/keep_notes.h"
#include "exchange/oslo/oslo.h"

/* Cut off the number of a surface; FOREIGN_MOST_SURFACES where there is none. */
static size_t cut_surface_number(struct text *rest)
{
    size_t number = 0;
    for (struct text digits = text_cut(rest, ' '); digits.length > 0; digits.length--) {
        bool is_digit = digits.start[0] >= '0' && digits.start[0] <= '9';
        number = is_digit && number < FOREIGN_MOST_SURFACES
                     ? 10 * number + (size_t)(digits.start[0] - '0')
                     : FOREIGN_MOST_SURFACES;
        digits.start++;
    }
    return number < FOREIGN_MOST_SURFACES ? number : FOREIGN_MOST_SURFACES;
}

/* 3 CDGM:H-K9L */
void oslo_kept_glasses(struct oslo *oslo, struct text content)
{
    for (struct text rest = content; rest.start != NULL;) {
        const struct text line = text_trim(text_cut(&rest, '\n'));
        struct text glass = text_behind(line, OSLO_KEEP_NOTE OSLO_GLASS);
        size_t number = glass.start != NULL ? cut_surface_number(&glass) : FOREIGN_MOST_SURFACES;
        if (number < FOREIGN_MOST_SURFACES && glass.start != NULL) {
            oslo->glasses[number] = glass;
        }
    }
}

/* 3 front: the name of surface 3 */
static void name_surface(struct oslo *oslo, struct text rest)
{
    size_t number = cut_surface_number(&rest);
    if (number < oslo->sequence.count && rest.length > 0) {
        oslo->sequence.surfaces[number].name = lens_build_string(&oslo->build, rest);
    }
}

bool oslo_keep_notes(struct oslo *oslo, struct text content)
{
    struct lens *lens = oslo->build.lens;
    struct keep_notes notes = {0};
    for (struct text rest = content; rest.start != NULL;) {
        const struct text line = text_trim(text_cut(&rest, '\n'));
        const struct text kept = text_behind(line, OSLO_KEEP_NOTE);
        const struct text fields = text_behind(kept, OSLO_FIELDS);
        const struct text name = text_behind(kept, OSLO_NAME);
        if (fields.start != NULL && !oslo_fields(oslo, fields)) {
            return false;
        }
        if (text_equal(kept, OSLO_STOP_RULES)) {
            lens->aperture_kind = APERTURE_STOP;
            lens->aperture = (struct figure){.typed = text_of("stop"), .variable = LENS_NONE};
        } else if (name.start != NULL) {
            name_surface(oslo, name);
        } else if (kept.start != NULL) {
            keep_notes_take(&notes, kept);
        }
    }
    keep_notes_apply(&notes, &oslo->build);
    return true;
}
