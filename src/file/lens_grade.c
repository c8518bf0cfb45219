/* file/lens_grade.c - the tolerances of a grade, laid upon a lens. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_grade.h"

#include "data/lensdb_grades.h"
#include "file/lens_tolerance.h"
#include "file/lens_unit.h"

/* A row as the line that a lens file would have for all surfaces. */
static bool lens_grade_add_row(const struct lensdb_tolerance *row, struct lens *lens,
                               struct arena *arena, struct error *error)
{
    const struct text of_element = text_behind(row->quantity, "element ");
    const struct text quantity = of_element.start != NULL ? of_element : row->quantity;
    const char *line = arena_printf(
        arena, "%s 1..%zu %.*s %.*s%.*s %.*s", of_element.start != NULL ? "elements" : "surface",
        lens->surface_count, (int)quantity.length, quantity.start, (int)row->amount.length,
        row->amount.start, (int)row->unit.length, row->unit.start, (int)row->distribution.length,
        row->distribution.start);
    struct file_words words = {.source = row->file,
                               .error = error,
                               .line = text_of(line),
                               .number = row->line,
                               .at = line,
                               .scale = lens_unit_scale("mm"),
                               .arena = arena};
    if (!lens_tolerance_read(&words, lens)) {
        return false;
    }
    lens->tolerances[lens->tolerance_count - 1].is_range = true; /* of a single surface too */
    return true;
}

bool lens_grade_read(struct lensdb *db, struct text name, const struct lens *lens,
                     struct arena *arena, struct tolerances *grade, struct error *error)
{
    struct nearest nearest = {.typed = text_trim(name)};
    struct lens graded = *lens;
    graded.tolerances = NULL;
    graded.tolerance_count = 0;
    error->code = ERROR_NONE;
    for (int place = 0; place < LENSDB_PLACES && graded.tolerance_count == 0; place++) {
        /* Those of one place; `names` receives all grades that it has. */
        struct lensdb_table grades;
        struct lensdb_tolerance row;
        bool open = lensdb_grades_open(&grades, db, (enum lensdb_place)place, error);
        while (open && lensdb_grades_next(&grades, &row, error)) {
            nearest_offer(&nearest, row.grade);
            if (text_same_name(row.grade, nearest.typed) &&
                !lens_grade_add_row(&row, &graded, arena, error)) {
                return false;
            }
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
    }
    *grade = (struct tolerances){graded.tolerances, graded.tolerance_count};
    if (grade->count > 0) {
        return true;
    }
    fail(error, ERROR_USAGE, "there is no grade '%.*s'", text_shown(name), name.start);
    return nearest.best.start != NULL ? error_hint(error, "did you mean '%.*s'?",
                                                   text_shown(nearest.best), nearest.best.start)
                                      : error_hint(error, "see 'lenscalc list tolerances'");
}
