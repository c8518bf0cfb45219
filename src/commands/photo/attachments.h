/* commands/photo/attachments.h - what is put on the lens of a photographic command. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_ATTACHMENTS_H
#define LENSCALC_COMMANDS_PHOTO_ATTACHMENTS_H

#include "commands/photo/photo_lens.h"
#include "commands/tables.h"

#include <math.h>

/* NaN = not given. */
struct attachments {
    double close_up;  /* 1/mm */
    double tube;      /* mm */
    double converter; /* factor */
};

#define OPTION_CLOSE_UP(member)                                                                    \
    ENTRY(MEASURE(member, vergence, "diopter", "DIOPTRES"), .name = "close-up",                    \
          .quantity = "close-up lens", .column = "close_up", ABOVE_0, .usual = {0, 0.025},         \
          .unusual = "close-up lenses have 0.25 to 25 diopters; Canon's 250D has 4, its 500D 2",   \
          .help = "close-up lens in front of the lens; for several, the sum")

#define OPTION_TUBE(member)                                                                        \
    ENTRY(MEASURE(member, length, "mm", "LENGTH"), REPEATED("tube"), FROM_0,                       \
          .no_number = "of several tubes the sum: 12 mm and 20 mm are 32mm",                       \
          .help = "extension tube or bellows; for several, the sum")

#define OPTION_CONVERTER(member)                                                                   \
    ENTRY(MEASURE(member, ratio, NULL, "FACTOR"), REPEATED("converter"),                           \
          .quantity = "converter factor", ABOVE_0,                                                 \
          .help = "teleconverter: 1.4x; a focal reducer: 0.71x; for several, the product")

/* The same of a command that knows no other attachment. */
#define OPTION_CONVERTER_ALONE(member, without)                                                    \
    ENTRY(MEASURE(member, ratio, NULL, "FACTOR"), REPEATED("converter"),                           \
          .quantity = "converter factor", ABOVE_0, .excludes = (without),                          \
          .help = "teleconverter behind the lens: 1.4x; a focal reducer: 0.71x")

#define ATTACHMENT_NAMES "close-up tube converter"

/* The three of a command's member of type struct attachments. */
#define ATTACHMENT_OPTIONS(member)                                                                 \
    OPTION_CLOSE_UP(member.close_up), OPTION_TUBE(member.tube), OPTION_CONVERTER(member.converter)

#define COLUMN_CLOSE_UP(member)                                                                    \
    ENTRY(MEASURED(member, vergence, "diopter"), .name = "close_up", ECHO_WITH("close-up"),        \
          .label = "close-up lens", .help = "close-up lens in front of the lens")

#define COLUMN_TUBE(member)                                                                        \
    ENTRY(LENGTH(member, "mm"), .name = "tube", ECHO_WITH("tube"), .help = "extension tube")

#define COLUMN_CONVERTER(member)                                                                   \
    ENTRY(SHOWN(member), .name = "converter", ECHO_WITH("converter"),                              \
          .help = "factor of the teleconverter")

#define ATTACHMENT_COLUMNS(member)                                                                 \
    COLUMN_CLOSE_UP(member.close_up), COLUMN_TUBE(member.tube), COLUMN_CONVERTER(member.converter)

/* A lens with what is attached to it. */
struct attached_lens {
    const struct photo_lens *lens; /* all of it as one lens */
    double focal;                  /* of the lens alone, mm */
    double fnumber_factor;         /* its f-number over that of the lens alone */
    double farthest; /* subject from the front principal plane, mm, where the lens itself is
                        focused at infinity; inf where that is still in reach */
};

/* Is anything attached? */
static inline bool attachments_any(const struct attachments *a)
{
    return !isnan(a->close_up) || !isnan(a->tube) || !isnan(a->converter);
}

/* Were any of the options given? */
static inline bool attachments_asked(const struct option_query *asking)
{
    return asking_given(asking, "close-up") || asking_given(asking, "tube") ||
           asking_given(asking, "converter");
}

/* As attachments_apply, of something. */
bool attachments_combine(const struct attachments *a, const struct photo_lens *lens,
                         struct photo_lens *room, struct attached_lens *attached,
                         struct error *error);

/*
 * The lens with a close-up lens at its front (of a thin one: at its principal plane), a tube behind
 * it, and a converter at the camera.
 *
 * Given     lens      its N may be NaN, as that of the answer then is
 *           room      for the lens of the answer
 *           attached  receives all of it as one lens: `lens` itself where nothing is attached. What
 *                     lies between its principal planes is NaN with a converter, of which only the
 *                     factor is known
 * Source    photo/attach.h
 * Errors    ERROR_USAGE: no focal length; distances from the sensor with a converter; ERROR_DOMAIN
 *           as attach_apply
 */
static inline bool attachments_apply(const struct attachments *a, const struct photo_lens *lens,
                                     struct photo_lens *room, struct attached_lens *attached,
                                     struct error *error)
{
    if (attachments_any(a)) {
        return attachments_combine(a, lens, room, attached, error);
    }
    *attached = (struct attached_lens){lens, lens->f, 1, INFINITY};
    return true;
}

/* Refuse a subject at s from the front principal plane, mm, that is beyond what it reaches. */
bool attached_check_reach(const struct attached_lens *attached, double s, struct error *error);

#endif
