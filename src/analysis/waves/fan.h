/* analysis/waves/fan.h - ray fans: aberrations along two sections of the pupil. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_FAN_H
#define LENSCALC_ANALYSIS_WAVES_FAN_H

#include "analysis/pupil/bundle.h"
#include "analysis/waves/wave_reference.h"

#include <stdbool.h>
#include <stddef.h>

/* The plane that holds the axis and the field point, and the one across it. */
enum fan_section { FAN_TANGENTIAL, FAN_SAGITTAL, FAN_SECTIONS };

struct fan_question {
    struct bundle_question bundle; /* its wavelength and pattern are not used */
    enum wave_about about;
    size_t points; /* in each section, 2 and more; odd: the middle of the pupil is one of them */
};

struct fan_ray {
    double pupil[2];  /* in units of the stop's radius, or of the entrance pupil's */
    double off[2];    /* x and y from the reference, mm, or of an angular fan rad; NaN: lost */
    double opd;       /* of the wavelength's own chief ray less that of the ray, mm; NaN: lost */
    double cosine[3]; /* its direction behind the lens; NaN: lost */
    enum ray_status status;
    size_t surface; /* where it was lost, 1-based; 0 = nowhere; of an end: what ends the pupil */
};

/* The last rays that arrive, between a point whose ray does and one whose ray does not. */
enum { FAN_ENDS = 8 };
struct fan_ends {
    struct fan_ray rays[FAN_ENDS];
    size_t behind[FAN_ENDS]; /* the point it comes after; ascending */
    size_t count;
};

/* The fans of one field, at all wavelengths of the setup. */
struct fan {
    bool is_angular;     /* the image lies infinitely far away */
    double along[2];     /* unit: the tangential section in the pupil, and in the image */
    double reference[3]; /* in the frame of the image plane, mm; z is not 0 of WAVE_BEST alone */
    double radius;       /* of the reference sphere, mm; infinite: a plane */
    const char *no_opd;  /* why there are no optical path differences; null: there are */
    double chief[3];     /* direction of the first wavelength's chief ray behind the lens */
    const struct fan_ray *rays; /* [wavelength][section][point] */
    size_t points;
    const struct fan_ends *ends;  /* [wavelength][section] */
    struct pupil_islands islands; /* light beyond a gap in the pupil, of the first wavelength */
};

/*
 * Trace the fans of a field.
 *
 * Result    points run from -1 to 1 in equal steps: of the tangential section upwards (of a field
 *           on the x axis to +x), of the sagittal one to +x (to -y). Lost rays keep their places.
 *           Ends lie within 1e-9 of the edge of what arrives; not found are those beyond FAN_ENDS
 *           in a section, and gaps between neighbours that both arrive
 * Formula   Every wavelength aims for itself at the same stop radius, and its chief ray has W = 0;
 *           all have one reference (wave_reference_find). Angular: sines of angles from the chief
 *           ray along spot_axes
 * Source    [Welford86]; W and places tested against a program of 50 digits
 * Errors    as wave_open and wave_reference_find; ERROR_DOMAIN: no ray of the fans arrives
 */
bool fan_trace(const struct fan_question *question, struct arena *arena, struct fan *fan,
               struct error *error);

/* The points of a section in their order, its ends between them: list has room for all of both. */
size_t fan_line(const struct fan *fan, size_t wavelength, enum fan_section section,
                struct fan_ray *list);

#endif
