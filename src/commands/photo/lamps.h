/* commands/photo/lamps.h - what lamps do to a photograph: their colour, their flicker. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_LAMPS_H
#define LENSCALC_COMMANDS_PHOTO_LAMPS_H

#include "cli/question/command.h"
#include "commands/tables.h"
#include "photo/flicker.h"

#include <math.h>

/* What the options say; NaN = not given. */
struct lamps {
    double kelvin, balance; /* colour temperature of the light, and that of film or camera, K */
    double mains;           /* Hz */
};

#define OPTION_KELVIN(member, option_name, words)                                                  \
    ENTRY(MEASURE(member, colour, NULL, "KELVIN"), REPEATED(option_name),                          \
          .quantity = "colour temperature", .lowest = 500, .highest = 100000, .help = (words))

/* Of a member of type struct lamps. */
#define LAMP_OPTIONS(member)                                                                       \
    OPTION_KELVIN(member.kelvin, "kelvin",                                                         \
                  "colour temperature of the light: 3200K; what filters make of it"),              \
        OPTION_KELVIN(member.balance, "balance",                                                   \
                      "what film or white balance is made for: finds the conversion filter"),      \
        ENTRY(MEASURE(member.mains, rate, "Hz", "50|60"), REPEATED("mains"),                       \
              .quantity = "mains frequency", ABOVE_0,                                              \
              .help = "frequency of the mains that lamps follow: times and shutter angles "        \
                      "without flicker")

/* What is answered; NaN and null = absent. */
struct lamp_row {
    double kelvin, balance, shift, filtered, wanted, conversion_shift;
    const char *conversion;
    double mains, free_time;
    const char *flicker, *free_times, *free_angles;
};

/* Of a member of type struct lamp_row. */
#define LAMP_COLUMNS(member)                                                                       \
    ENTRY(MEASURED(member.kelvin, colour, "K"), .name = "kelvin", ECHO_WITH("kelvin"),             \
          .symbol = "K1", .label = "colour temperature", .help = "of the light"),                  \
        ENTRY(MEASURED(member.balance, colour, "K"), .name = "balance", ECHO_WITH("balance"),      \
              .symbol = "K2", .label = "balanced for",                                             \
              .help = "colour temperature of film or white balance"),                              \
        ENTRY(SHOWN(member.shift), .name = "mired_shift", WITH("filter"), .symbol = "M",           \
              .label = "mired shift of the filter",                                                \
              .help = "of the filters that are on: + amber, - blue"),                              \
        ENTRY(MEASURED(member.filtered, colour, "K"), .name = "filtered", BRIEF_WITH("filter"),    \
              .symbol = "K3", .label = "behind the filter",                                        \
              .help = "colour temperature behind the filters that are on"),                        \
        ENTRY(SHOWN(member.wanted), .name = "mired_wanted", BRIEF_WITH("balance"), .symbol = "Mw", \
              .label = "mired shift wanted", .help = "beside the filters that are on"),            \
        ENTRY(SHOWN(member.conversion), .name = "conversion_filter", BRIEF_WITH("balance"),        \
              .label = "nearest filter", .help = "conversion filter with the nearest shift"),      \
        ENTRY(SHOWN(member.conversion_shift), .name = "conversion_shift", WITH("balance"),         \
              .label = "its mired shift", .help = "of the nearest filter"),                        \
        ENTRY(SHOWN(member.flicker), .name = "flicker", BRIEF_WITH("mains"),                       \
              .help = "of this exposure under lamps on the mains"),                                \
        ENTRY(TIME(member.free_time), .name = "flicker_free_time", BRIEF_WITH("mains"),            \
              .symbol = "tf", .label = "nearest time without flicker",                             \
              .help = "whole pulses of the lamps, within a frame"),                                \
        ENTRY(SHOWN(member.free_times), .name = "flicker_free_times", WITH("mains"),               \
              .label = "times without flicker", .help = "the first of them, in s"),                \
        ENTRY(SHOWN(member.free_angles), .name = "flicker_free_angles", WITH("mains"),             \
              .label = "shutter angles without flicker", .help = "at the frame rate, in degrees"), \
        ENTRY(MEASURED(member.mains, rate, "Hz"), .name = "mains",                                 \
              ASSUMED_WITH("mains", "mains") | COLUMN_ECHO, .symbol = "mains",                     \
              .label = "lamps on a mains of", .help = "frequency of the mains")

/* Is anything of it asked? */
static inline bool lamps_asked(const struct lamps *lamps)
{
    return !isnan(lamps->kelvin) || !isnan(lamps->balance) || !isnan(lamps->mains);
}

/*
 * Answer what is asked.
 *
 * Given     filter   before the lens, mired, as struct loss_value has it; 0 for none
 *           t, rate  exposure time, s, and frames per second; NaN = not known
 * Errors    --balance without --kelvin (ERROR_USAGE); as photo/mired.h and photo/flicker.h
 */
bool lamps_answer(const struct lamps *lamps, double filter, double t, double rate, struct run *run,
                  struct lamp_row *row, struct error *error);

#endif
