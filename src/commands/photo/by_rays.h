/* commands/photo/by_rays.h - answers of photographic commands by the rays of a real lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_BY_RAYS_H
#define LENSCALC_COMMANDS_PHOTO_BY_RAYS_H

#include "analysis/real/real_range.h"
#include "commands/photo/photo_lens.h"
#include "commands/tables.h"

/* Is that a criterion? Errors: ERROR_USAGE */
bool by_rays_accepts(const char *criterion, struct error *error);

/* Initialisers of the options for a member of that type in a command's input. */
#define BY_RAYS_EXACT_OPTION(member, what)                                                         \
    ENTRY(ASKED(member.exact), .name = "exact", .wants = "lens", .help = what)
#define BY_RAYS_CRITERION_OPTION(member)                                                           \
    ENTRY(ASKED(member.criterion), .name = "criterion", .wants = "exact", .value = "RULE",         \
          .accepts = by_rays_accepts,                                                              \
          .help = "measure of blur, with --exact: rms (the default), energy80, mtf@40/mm")

/* What an answer by rays says of itself. */
struct by_rays_row {
    double blur; /* of the sharpest image, mm; NaN: no rays were asked */
    const char *rule, *spectrum;
};

extern const struct by_rays_row by_rays_none;

/* `weight` of a command that asks for them. */
#define BY_RAYS_WEIGHT(member)                                                                     \
    static double weight(const void *input)                                                        \
    {                                                                                              \
        return ((const INPUT *)input)->member.exact ? ANSWER_BY_RAYS : 1;                          \
    }

#define BY_RAYS_COLUMNS(member)                                                                    \
    ENTRY(LENGTH(member.blur, "um"), .name = "least_blur", WITH("exact"), .label = "least blur",   \
          .help = "diameter of the disc as blurred as the sharpest image"),                        \
        ENTRY(SHOWN(member.rule), .name = "blur_rule", ASSUMED_WITH("exact", "criterion"),         \
              .label = "blurs by", .help = "what of a blur is that of a disc"),                    \
        ENTRY(SHOWN(member.spectrum), .name = "spectrum",                                          \
              ASSUMED_WITH("exact", "lens wavelength"), .label = "wavelengths",                    \
              .help = "of the rays, each with its weight")

/*
 * Make the lens ready for rays.
 *
 * Given     question  of the command: with its wavelength, if given
 *           lens      as photo_lens_each made it
 *           distance  of a subject, from the front principal plane, mm; may be infinite
 *           c         the blur that matters, mm
 *           row       receives rule and spectrum
 * Errors    ERROR_USAGE: no lens, {--pupil} of a lens that has pupils; as
 *           real_focus_open
 */
bool by_rays_open(const struct photo_lens_question *question, const struct photo_lens *lens,
                  double distance, double c, struct run *run, struct real_focus *focus,
                  struct by_rays_row *row, struct error *error);

/*
 * Where the image of a subject is sharpest.
 *
 * Given     distance  from the front principal plane, mm; may be infinite
 *           image     receives its place behind H', mm
 *           blur      receives the disc that is as blurred, mm
 * Errors    as real_focus_point
 */
bool by_rays_image(const struct real_focus *focus, const struct photo_lens *lens, double distance,
                   double *image, double *blur, struct error *error);

/*
 * The distance from the front principal plane whose sharpest image lies so far behind the subject.
 *
 * Given     start  a distance near it, by paraxial rays, mm
 *           total  from the subject to the film, mm
 * Errors    as real_focus_point; ERROR_DOMAIN: none is found
 */
bool by_rays_distance(const struct real_focus *focus, const struct photo_lens *lens, double start,
                      double total, double *distance, struct error *error);

#endif
