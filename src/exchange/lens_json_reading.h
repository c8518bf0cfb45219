/* exchange/lens_json_reading.h - numbers, texts and media of a lens in JSON, while it is read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_LENS_JSON_READING_H
#define LENSCALC_EXCHANGE_LENS_JSON_READING_H

#include "base/json_read.h"
#include "exchange/foreign.h"
#include "file/file_words.h"
#include "file/lens_build.h"

struct json_reader {
    struct foreign_job *job;
    struct text content;
    struct lens_build build;
    size_t line_start; /* of the line that was looked for last */
    long line;
};

/* The line of a value, for messages. */
struct file_words json_place(struct json_reader *reading, const struct json_value *value);

/* ERROR_DATA with line, column and caret at the value. Returns false. */
bool json_wrong(struct json_reader *reading, const struct json_value *value, struct error *error,
                const char *format, ...) __attribute__((format(printf, 4, 5)));

/* Each key once, and none that is not in the list, which null ends: that is a loss. */
bool json_check_keys(struct json_reader *reading, const struct json_value *object,
                     const char *const *keys, struct error *error);

/* Absent, or null. */
bool json_is_null(const struct json_value *value);

/* The first item of what is there; null of what is not. */
static inline const struct json_value *json_first(const struct json_value *value)
{
    return json_is_null(value) ? NULL : value->first;
}

/* A text as a .lens file can hold it, in the arena; null where there is none. */
bool json_read_text(struct json_reader *reading, const struct json_value *value, const char **text,
                    struct error *error);

/* Which of the words a text is; of what is absent *choice stays. */
bool json_read_choice(struct json_reader *reading, const struct json_value *value,
                      const char *const *words, size_t count, int *choice, struct error *error);

bool json_read_truth(struct json_reader *reading, const struct json_value *value, bool *truth,
                     struct error *error);

/* What a number is: mm, degrees, without a unit; of 1/mm^n the power is -n. */
enum { JSON_PLAIN = 0, JSON_LENGTH = 1, JSON_ANGLE = 100 };

/* A number, with its digits in the lens's unit. */
bool json_read_figure(struct json_reader *reading, const struct json_value *value, int power,
                      struct figure *figure, struct error *error);

/* An array of numbers, in the arena. */
bool json_read_figures(struct json_reader *reading, const struct json_value *value, int power,
                       struct figure **figures, struct error *error);

/* An array of what the word says, or nothing. */
bool json_check_array(struct json_reader *reading, const struct json_value *value, const char *what,
                      struct error *error);

/*
 * What a key says that another one says too: nothing, or the same.
 *
 * Given     key, other  their names, for the message
 */
bool json_check_truth(struct json_reader *reading, const struct json_value *value, bool truth,
                      const char *key, const char *other, struct error *error);

/* As many items as the lens has positions, at least one. */
bool json_check_count(struct json_reader *reading, const struct json_value *value,
                      struct error *error);

/* A medium as a .lens file has it; null or absent leaves *medium. */
bool json_read_medium(struct json_reader *reading, const struct json_value *value,
                      struct medium *medium, struct error *error);

/* The list of apertures of a surface. */
bool json_read_apertures(struct json_reader *reading, const struct json_value *value,
                         struct surface *surface, struct error *error);

/* One surface more of the lens. */
bool json_read_surface(struct json_reader *reading, const struct json_value *object,
                       struct error *error);

/* What the positions set anew; the lens has its surfaces, and its stop if it has one. */
bool json_read_settings(struct json_reader *reading, const struct json_value *value,
                        struct error *error);

#endif
