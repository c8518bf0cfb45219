/* commands/photo/sky_subject.h - pixels against the sky, and the images of what is there. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_SKY_SUBJECT_H
#define LENSCALC_COMMANDS_PHOTO_SKY_SUBJECT_H

#include "commands/tables.h"
#include "photo/sky_object.h"

/* What is looked at. */
struct sky_question {
    int subject;  /* place in sky_objects; 0 = none */
    double angle; /* rad; NaN = that of the subject */
    double scale; /* wanted angle of a pixel, rad; NaN = none */
    double size;  /* of the subject, mm; NaN = not given */
};

struct sky_row {
    double scale;  /* angle of a pixel, rad; NaN where no pitch is known */
    double angle;  /* of the subject; NaN = there is none, as in the next */
    double image;  /* its length, mm */
    double pixels; /* the same in pixels */
    double part;   /* the same over the height of the sensor */
    const char *subject;
    double size, distance; /* of the subject, mm; NaN where no size is given */
};

/* The options that bring a pixel's angle, among which a camera is one. */
#define SKY_NAMES "pitch subject subject-angle"

#define SKY_OPTIONS(member)                                                                        \
    ENTRY(ASKED(member.subject), REPEATED("subject"), .words = sky_objects, .fallback = "none",    \
          .value = "OBJECT", .help = "what is looked at in the sky: adds the size of its image"),  \
        ENTRY(MEASURE(member.scale, angle, "arcsec", "ANGLE"), .name = "pixel-scale",              \
              .column = "pixel_scale", ABOVE_0 | OPTION_GOAL,                                      \
              .excludes = "focal-length lens magnification converter crop horizontal vertical "    \
                          "diagonal field-width field-height field-diagonal",                      \
              .help = "wanted angle of a pixel: solves for the focal length"),                     \
        ENTRY(MEASURE(member.angle, angle, "arcmin", "ANGLE"), .name = "subject-angle",            \
              .column = "subject_angle", .lowest = 0, .highest = PI, .flags = OPTION_ABOVE_LOWEST, \
              .help = "angle that the subject subtends, in place of that of --subject"),           \
        ENTRY(MEASURE(member.size, length, "m", "LENGTH"), .name = "subject-size",                 \
              .column = "subject_size", ABOVE_0,                                                   \
              .help = "size of the subject: with its angle, or that of --subject, gives the "      \
                      "distance, with a distance the angle")

#define SKY_COLUMNS(member)                                                                        \
    ENTRY(MEASURED(member.scale, angle, "arcsec"), .name = "pixel_scale",                          \
          BRIEF_WITH(SKY_NAMES " sensor") | COLUMN_SPARSE, .symbol = "ps",                         \
          .when = "with --pitch, or a camera of known pixels", .label = "angle of a pixel",        \
          .help = "in the middle of the picture"),                                                 \
        ENTRY(SHOWN(member.subject), .name = "subject", ECHO_WITH("subject") | COLUMN_BRIEF,       \
              .help = "what is looked at in the sky"),                                             \
        ENTRY(MEASURED(member.angle, angle, "arcmin"), .name = "subject_angle",                    \
              WITH("subject subject-angle subject-size"), .symbol = "su",                          \
              .label = "angle of the subject",                                                     \
              .help = "as given, else of --subject along its longer axis"),                        \
        ENTRY(LENGTH(member.size, "m"), .name = "subject_size", ECHO_WITH("subject-size"),         \
              .symbol = "sz", .label = "size of the subject", .help = "as given"),                 \
        ENTRY(LENGTH(member.distance, "m"), .name = "subject_distance",                            \
              BRIEF_WITH("subject-size"), .symbol = "ds", .label = "distance of the subject",      \
              .help = "at which it subtends this angle"),                                          \
        ENTRY(LENGTH(member.image, "mm"), .name = "subject_image",                                 \
              BRIEF_WITH("subject subject-angle subject-size") | COLUMN_SPARSE, .symbol = "im",    \
              .label = "image of the subject", .help = "on the sensor"),                           \
        ENTRY(SHOWN(member.pixels), .name = "subject_pixels",                                      \
              BRIEF_WITH("subject subject-angle subject-size") | COLUMN_SPARSE,                    \
              .when = "with --pitch, or a camera of known pixels", .label = "in pixels",           \
              .help = "image of the subject over pixel pitch"),                                    \
        ENTRY(MEASURED(member.part, ratio, "percent"), .name = "subject_height",                   \
              WITH("subject subject-angle subject-size") | COLUMN_SPARSE,                          \
              .label = "of the picture's height",                                                  \
              .help = "image of the subject over the height of the sensor")

#define SKY_EXPLANATIONS                                                                           \
    {"subject_distance", "ds = {sz}/(2 tan({su}/2))", "similar triangles", NULL},                  \
        {"pixel_scale", "ps = {p}/({f} (1 + {m}/{P}))",                                            \
         "206.265 p/f arcsec for p in um and f in mm, far away", "in the middle of the picture"},  \
    {                                                                                              \
        "subject_image projection=rectilinear", "im = 2 {f} (1 + {m}/{P}) tan({su}/2)",            \
            "definition of the projection", "in the middle of the picture"                         \
    }

/*
 * The focal length that has the wanted angle of a pixel, where one is wanted.
 *
 * Given     setting  its projection, s and P; receives f
 * Formula   f' = p/angle, as fov_focal_length
 * Errors    ERROR_USAGE: no pitch
 */
bool sky_focal_length(const struct sky_question *question, double pitch,
                      struct fov_setting *setting, struct error *error);

/*
 * The angle and distance of the subject, of which a size and one of them give the other.
 *
 * Given     distance  mm; inf: not given;  row  receives size, angle, distance and name
 * Errors    ERROR_USAGE: a size with neither, or with both
 */
bool sky_fill_subject(const struct sky_question *question, double distance, struct sky_row *row,
                      struct error *error);

/*
 * Pixels and subject against the sky.
 *
 * Given     setting  complete; its projection is that of photo/fov.h even where rays found angles
 *           pitch    mm, or NaN
 * Errors    as sky_image
 */
bool sky_fill(const struct sky_question *question, const struct fov_setting *setting,
              const struct sensor *sensor, double pitch, struct sky_row *row, struct error *error);

#endif
