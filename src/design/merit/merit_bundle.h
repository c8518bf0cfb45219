/* design/merit/merit_bundle.h - the rays that residuals are made of, block by block. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_BUNDLE_H
#define LENSCALC_DESIGN_MERIT_MERIT_BUNDLE_H

#include "analysis/setup/setup.h"
#include "design/merit/merit_limit.h"
#include "design/merit/merit_points.h"
#include "design/tolerance/irregularity.h"
#include "design/variable.h"
#include "optics/paraxial_dual.h"
#include "trace/aim/aimed.h"
#include "trace/aim/grazing.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    BUNDLE_ALIKE = 6
}; /* lanes of a ray that is apart: as many as its place and direction have */

/* Which rays. */
struct bundle_wish {
    const struct setup *setup; /* one position of the lens at the start */
    const struct setup_field *fields;
    size_t field_count;
    const struct setup_wavelength *wavelengths;
    size_t wavelength_count;
    bool from_entrance, clip, path;
    double vignetting;                /* as in merit_question */
    const struct pupil_point *points; /* only these, whatever pattern is asked for; or null */
    size_t point_count;
    bool is_apart; /* a block a ray, whose lanes are alike; one that cannot be aimed stops none */
    bool is_bare;  /* there need be no image plane */
    bool is_round; /* no variable decentres or tilts anything */
    bool whole;    /* all points of the pupil, whatever is alike by symmetry */
    const struct irregularity *irregularities; /* whose columns are the last of all */
    size_t irregularity_count;
    const double *irregularity_amounts; /* mm, one each, read at every trace: rays are moved by
                                           them, and have no columns; null: they have */
    enum pattern pattern;
    size_t rays;
    uint64_t seed;
    struct watch *watch;       /* as in merit_question */
    struct merit_limit *limit; /* receives where rays are lost; or null */
    size_t place;              /* of its */
};

/* One field at one wavelength. */
struct bundle_group {
    size_t field, light;
    double weight; /* of the field and the wavelength */
    struct merit_points points;
    enum merit_symmetry symmetry; /* of the beam, whether points make use of it or not */
    size_t row;                   /* a number for the caller */
};

/* A ray of a block. */
struct bundle_lane {
    size_t group, point, field;
};

struct bundle_block {
    struct aimed aimed;
    struct aimed *settled;     /* of merit_bundle_settle; null: there are none */
    struct bundle_lane *lanes; /* aimed.count; one group after the other, each an aimed_beam */
    size_t light;
    double *deformed;          /* of merit_bundle_deform */
    bool is_deformed, is_lost; /* it cannot be aimed */
};

struct bundle_light {
    double wavelength; /* um */
    struct medium *asked;
    struct pair *n; /* of lens_indices */
    struct system system;
    struct derivative_layout layout;
};

/* What moves with paraxial rays, by one variable. */
struct bundle_rate {
    double image;  /* z of the image plane */
    double pupil;  /* z of the entrance pupil */
    double radius; /* of the stop, or of the entrance pupil */
    double field;  /* what image heights are multiplied by: power over index, or 1/magnification */
};

struct merit_bundle {
    struct bundle_wish wish;
    struct bundle_light *lights; /* one a wavelength */
    struct beam *beams;          /* one a field */
    struct bundle_group *groups; /* of one wavelength after the other, the fields in each */
    size_t group_count;
    struct bundle_block *blocks;
    size_t block_count;
    struct aimed_work work;
    struct bundle_rate *rates; /* one a variable; the caller's */
    double *gradient;
    size_t steps;             /* that there is room for in `work` */
    struct arena *arena;      /* where all of it lies */
    struct arena within;      /* what an evaluation takes */
    struct first_order first; /* what beams need of the primary wavelength, as it is now */
    double image;             /* z of the image plane behind the last vertex, mm */
    bool image_moves;         /* with the paraxial image */
    bool is_settled, is_held; /* by merit_bundle_settle */
    bool keeps;               /* the way of rays is looked at: merit_bundle_graze */
    bool has_disc;            /* no stop: points are those of the plane of the first vertex */
};

/*
 * Choose the rays.
 *
 * Given     links  of each wavelength, as variables_links has them at the start; variable_count:
 *                  of them all
 * Result    with `clip` the points are those that the lens at the start lets through, and stay
 *           so; nothing is clipped later
 * Errors    as bundle_open and sample_make; ERROR_DOMAIN: an image plane of `focus best`, one
 *           infinitely far away, a thick lens, all of which have no derivatives
 */
struct bundle_links {
    const struct variable_link *list;
    size_t count;
};
bool merit_bundle_open(const struct bundle_wish *wish, const struct bundle_links *links,
                       size_t variable_count, struct arena *arena, struct merit_bundle *bundle,
                       struct error *error);

/* The watch of the first aim; false: it ends it. */
bool merit_bundle_goes_on(const struct merit_bundle *bundle, size_t rays, struct error *error);

/* The next aim begins with nothing, not with the rays of the lens before. */
void merit_bundle_forget(struct merit_bundle *bundle);

/*
 * The rays as they are aimed now are those that every later aim begins with: so what it finds does
 * not depend on the lenses between.
 *
 * Given     holds  they are aimed no more: later lenses are met by the same rays
 */
void merit_bundle_settle(struct merit_bundle *bundle, bool holds);

/*
 * The lens as it is now: compile it, and aim.
 *
 * Given     first  of the primary wavelength; null: rays are held
 * Errors    as system_compile and aimed_at_stop
 */
bool merit_bundle_aim(struct merit_bundle *bundle, const struct lens *lens,
                      const struct dual_first *first, struct error *error);

/*
 * Trace one block.
 *
 * Errors    ERROR_DOMAIN: a ray is lost
 */
bool merit_bundle_trace(struct merit_bundle *bundle, size_t block, bool derives,
                        struct ray_block *end, struct error *error);

/* What the rays count that are near loss, of the block that was traced last with `keeps`. */
void merit_bundle_graze(struct merit_bundle *bundle, size_t block, double limit, bool derives,
                        struct grazing_penalty *grazing);

/* Where a ray of a group crosses the plane z = 0 in front of the lens, mm: for tests. */
void merit_bundle_start(const struct merit_bundle *bundle, size_t group, size_t point,
                        double place[2]);

/* Is a field given as an image height, whose object moves with the lens? */
static inline bool merit_bundle_moves(const struct merit_bundle *bundle, size_t field)
{
    return bundle->wish.fields[field].point.kind == FIELD_IMAGE;
}

/* -------- design/merit/merit_bundle_sweep.c -------- */

/*
 * Find how irregularities move rays, of the lens as it is now: later ones are taken to be like it.
 *
 * Given     bundle  aimed, with irregularity_amounts
 * Formula   of x, y, p, q and path at the end irregularity_column: the aim stays as it is for rays
 *           that are held, else it is looked after
 * Errors    as merit_bundle_trace
 */
bool merit_bundle_deform(struct merit_bundle *bundle, struct error *error);

/* -------- design/merit/merit_bundle_sweep.c -------- */

/* How fast a variable moves the image plane: as merit_bundle_sweep has it. */
double merit_bundle_image_slope(const struct merit_bundle *bundle, const struct bundle_links *links,
                                size_t variable);

/* What a variable does, whose derivatives of the primary wavelength these are. */
struct bundle_rate merit_bundle_rate(const struct merit_bundle *bundle,
                                     const struct dual_first *first);

/*
 * Derivatives of a function of the rays of the block that was traced last, by the variables.
 *
 * Given     place    before which the rays are meant; LENS_NONE: the final ones
 *           links    of the wavelength; variable_count: how many rates there are
 *           adjoint  as for aimed_sweep
 *           columns  variable_count rows of RAYS_BLOCK; receives them, those of irregularities last
 * Formula   the chain rule over the links; and what moves with paraxial rays (bundle->rates): the
 *           pupil that is aimed at, the radius of the stop, the image plane of `focus paraxial`,
 *           the object of a field that is given as an image height. A height of the real image
 *           keeps the object that it has in the lens at the start
 * Source    derived here. A ray through a point T that comes from elsewhere: its direction e
 *           changes by de, its start X by -((T - X).e) de; de of a point P is -(dP - (dP.e) e)/|T
 *           - P|, of a far object that of the unit vector along (x, y, 1)
 */
void merit_bundle_sweep(const struct merit_bundle *bundle, size_t block, size_t place,
                        const struct bundle_links *links, size_t variable_count,
                        struct ray_block *adjoint, double *columns);

/* The same of what rays near loss count. */
void merit_bundle_sweep_graze(const struct merit_bundle *bundle, size_t block,
                              const struct bundle_links *links, size_t variable_count,
                              const struct grazing_penalty *grazing, double *columns);

#endif
