/* exchange/lens_json_design.c - what of a lens follows, is wanted and allowed, in JSON. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_json_design.h"

#include "exchange/json_write.h"
#include "file/lens_change.h"
#include "file/lens_mark.h"
#include "file/lens_pickup.h"
#include "file/lens_tolerance.h"
#include "file/lens_unit.h"

#include <string.h>

/* One more line of a list. */
static void lens_json_design_put_line(struct text_buffer *text, const char *key, size_t i,
                                      struct text line)
{
    growing_string(text, i == 0 ? key : ",");
    growing_string(text, json_of_text(text->arena, line));
}

void json_put_design(struct text_buffer *text, const struct lens *lens, struct arena *arena)
{
    const struct lens *in_mm = lens_in_unit(lens, "mm", arena);
    for (size_t i = 0; i < lens->pickup_count; i++) {
        struct text_buffer line = {.arena = arena};
        lens_pickup_write(&in_mm->pickups[i], "mm", &line);
        lens_json_design_put_line(text, ",\"pickups\":[", i, growing_done(&line));
    }
    growing_string(text, lens->pickup_count > 0 ? "]" : "");
    for (size_t i = 0; i < lens->goal_count; i++) {
        lens_json_design_put_line(text, ",\"goals\":[", i, lens->goals[i].text);
    }
    growing_string(text, lens->goal_count > 0 ? "]" : "");
    for (size_t i = 0; i < lens->tolerance_count; i++) {
        struct text_buffer line = {.arena = arena};
        lens_tolerance_write(&in_mm->tolerances[i], "mm", &line);
        lens_json_design_put_line(text, ",\"tolerances\":[", i, growing_done(&line));
    }
    growing_string(text, lens->tolerance_count > 0 ? "]" : "");
}

/* Texts as the lines of a .lens file in mm have them. */
static bool lens_json_design_read_lines(struct json_reader *reading, const struct json_value *value,
                                        bool (*read)(struct file_words *words, struct lens *lens,
                                                     struct error *error),
                                        struct error *error)
{
    if (!json_check_array(reading, value, "texts", error)) {
        return false;
    }
    for (const struct json_value *item = json_first(value); item != NULL; item = item->next) {
        if (item->kind != JSON_STRING ||
            memchr(item->text.start, '\n', item->text.length) != NULL) {
            return json_wrong(reading, item, error, "expected a line of text here");
        }
        struct file_words words = json_place(reading, item);
        words.line = item->text;
        words.at = item->text.start;
        words.scale = lens_unit_scale("mm");
        if (!read(&words, reading->build.lens, error)) {
            return false;
        }
    }
    return true;
}

bool json_read_design(struct json_reader *reading, const struct json_value *pickups,
                      const struct json_value *goals, const struct json_value *tolerances,
                      struct error *error)
{
    struct lens *lens = reading->build.lens;
    if (!lens_json_design_read_lines(reading, pickups, lens_pickup_read, error) ||
        !lens_json_design_read_lines(reading, goals, lens_goal_read, error) ||
        !lens_json_design_read_lines(reading, tolerances, lens_tolerance_read, error)) {
        return false;
    }
    lens_pickups_begin(lens, reading->job->arena);
    return true;
}
