/* exchange/lens_json.h - a lens as JSON, for other programs and scripts; how it is read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_LENS_JSON_H
#define LENSCALC_EXCHANGE_LENS_JSON_H

#include "base/json_read.h"
#include "exchange/foreign.h"
#include "file/file_words.h"
#include "file/lens_build.h"

/*
 * One JSON object; its keys are told in lenscalc-convert.1. Lengths are in mm, angles in degrees,
 * numbers have all digits of a pair, so that reading gives the same bits. What differs between the
 * positions of the lens is an array, one number a position; indices are an array, one a wavelength.
 *
 * Reading   lenscalc's own JSON, in any order of keys; indices follow from the media. JSON of
 *           another program is refused, a key that lenscalc does not know is a loss
 * Errors    writing, ERROR_DOMAIN: a glass without index at a wavelength of the lens
 */
extern const struct foreign_format lens_json_format;

/* foreign_format.read. */
bool lens_json_read(struct foreign_job *job, struct text content, struct lens *lens,
                    struct error *error);

struct json_reader {
    struct foreign_job *job;
    struct text content;
    struct error *error; /* receives what is wrong */
    struct lens_build build;
    size_t line_start; /* of the line that was looked for last */
    long line;
};

/* The line of a value, for messages. */
struct file_words json_place(struct json_reader *reading, const struct json_value *value);

/* ERROR_DATA with line, column and caret at the value. Returns false. */
bool json_wrong(struct json_reader *reading, const struct json_value *value, const char *format,
                ...) __attribute__((format(printf, 3, 4)));

/* Each key once, and none that is not in the list, with blanks between: that is a loss. */
bool json_check_keys(struct json_reader *reading, const struct json_value *object,
                     const char *keys);

/* Absent, or null. */
bool json_is_null(const struct json_value *value);

/* The first item of what is there; null of what is not. */
static inline const struct json_value *json_first(const struct json_value *value)
{
    return json_is_null(value) ? NULL : value->first;
}

/* A text as a .lens file can hold it, in the arena; null where there is none. */
bool json_read_text(struct json_reader *reading, const struct json_value *value, const char **text);

/* Which of the words a text is; of what is absent *choice stays. */
bool json_read_choice(struct json_reader *reading, const struct json_value *value,
                      const char *const *words, size_t count, int *choice);

bool json_read_truth(struct json_reader *reading, const struct json_value *value, bool *truth);

/* What a number is: mm, degrees, without a unit; of 1/mm^n the power is -n. */
enum { JSON_PLAIN = 0, JSON_LENGTH = 1, JSON_ANGLE = 100 };

/* A number, with its digits in the lens's unit. */
bool json_read_figure(struct json_reader *reading, const struct json_value *value, int power,
                      struct figure *figure);

/* An array of numbers, in the arena. */
bool json_read_figures(struct json_reader *reading, const struct json_value *value, int power,
                       struct figure **figures);

/*
 * An array of so many numbers, or nothing.
 *
 * Given     what  to say of anything else: "expected x and y here"; null: that it is no array
 */
bool json_read_row(struct json_reader *reading, const struct json_value *value, int power,
                   struct figure *figures, size_t count, const char *what);

/* An array of what the word says, or nothing. */
bool json_check_array(struct json_reader *reading, const struct json_value *value,
                      const char *what);

/*
 * What a key says that another one says too: nothing, or the same.
 *
 * Given     key, other  their names, for the message
 */
bool json_check_truth(struct json_reader *reading, const struct json_value *value, bool truth,
                      const char *key, const char *other);

/* As many items as the lens has positions, at least one. */
bool json_check_count(struct json_reader *reading, const struct json_value *value);

/* A medium as a .lens file has it; null or absent leaves *medium. */
bool json_read_medium(struct json_reader *reading, const struct json_value *value,
                      struct medium *medium);

/* One surface more of the lens. */
bool json_read_surface(struct json_reader *reading, const struct json_value *object);

/* What the positions set anew; the lens has its surfaces, and its stop if it has one. */
bool json_read_settings(struct json_reader *reading, const struct json_value *value);

/* Pick-ups, goals and tolerances: lines as of a .lens file in mm; the lens has all else. */
bool json_read_design(struct json_reader *reading, const struct json_value *pickups,
                      const struct json_value *goals, const struct json_value *tolerances);

#endif
