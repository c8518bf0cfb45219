/* commands/photo/pixels.h - the pixels of a sensor: its own, counted, or by their pitch. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_PIXELS_H
#define LENSCALC_COMMANDS_PHOTO_PIXELS_H

#include "cli/options/option.h"
#include "commands/tables.h"
#include "report/warnings.h"

#define OPTION_PIXELS(member, words)                                                               \
    ENTRY(ASKED(member), .name = "pixels", .quantity = "pixels", .value = "N|WxH|Mpx",             \
          .help = (words))

/* What --sensor, --pixels and --pitch say of a sensor. */
struct pixels_question {
    struct pixels_value pixels;
    double pitch; /* mm; NaN = not given */
    bool is_line; /* one row of pixels */
};

static inline bool pixels_given(const struct pixels_value *pixels)
{
    return !isnan(pixels->wide) || !isnan(pixels->total);
}

/*
 * The sensor with its pixels: two of its size, their number and their pitch say the third. An
 * optical format has the shape of the pixels within its diagonal.
 *
 * Given     sensor    as --sensor has it; receives size, pitch and name
 *           arena     of the name
 *           doubts    of pixels that are not square; null: nobody listens
 * Formula   pitch = width/number across, sqrt(width height/number) of a total; size = number pitch
 * Errors    ERROR_USAGE: all three, pixels without another, one side of an area; a line without
 *           pixels, or with several rows
 */
bool pixels_settle(const struct pixels_question *question, struct sensor_value *sensor,
                   struct arena *arena, struct warnings *doubts, struct error *error);

#endif
