/* cli/options/tolerances.c - how well a lens is made: --grade, --tolerances, or the lines of its file. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/tolerances.h"

#include "data/whole_file.h"
#include "file/lens_tolerance.h"
#include "optics/growing.h"

static bool tolerances_read_file(const struct tolerances_reader *reader, const char *file,
                                 struct tolerances *marks, struct error *error)
{
    struct text content;
    if (!whole_file(file, reader->arena, &content, error)) {
        return error->code == ERROR_NONE &&
               fail(error, ERROR_IO, "cannot read %s: there is no such file", file);
    }
    return lens_tolerances_read(file, content, reader->lens, reader->arena, marks, error);
}

const char *tolerances_grade(const struct lens *lens, const char *grade, const char *file)
{
    const bool says = file != NULL || lens->tolerance_count > 0;
    return grade == NULL && !says ? "precision" : grade;
}

bool tolerances_of(const struct tolerances_reader *reader, const char *grade, const char *file,
                   struct perturbations *perturbations, const char **assumed, struct error *error)
{
    const struct lens *lens = reader->lens;
    struct perturbation_wish wish = {.grade = grade,
                                     .marks = {lens->tolerances, lens->tolerance_count}};
    if ((grade != NULL && !lens_grade_read(reader->db, text_of(grade), lens, reader->arena,
                                           &wish.of_grade, error)) ||
        (file != NULL && !tolerances_read_file(reader, file, &wish.marks, error)) ||
        !perturbations_of(lens, &wish, reader->arena, perturbations, error)) {
        return false;
    }
    /* what was used, in words */
    struct text_buffer words = {.arena = reader->arena};
    const char *marks = file != NULL ? file : "the lens";
    if (grade != NULL) {
        growing_format(&words, "grade %s", grade);
    }
    if (grade == NULL) {
        growing_format(&words, "those of %s", marks);
    } else if (perturbations->won != NULL) {
        growing_format(&words, ", but %s of %s", perturbations->won, marks);
    }
    if (file != NULL && reader->lens->tolerance_count > 0) {
        growing_string(&words, "; those of the lens are not used");
    }
    if (perturbations->left_out != NULL) {
        growing_format(&words, "; without %s, of media that have no Abbe number",
                       perturbations->left_out);
    }
    const struct text done = growing_done(&words);
    *assumed = arena_string(reader->arena, done.start, done.length);
    return true;
}
