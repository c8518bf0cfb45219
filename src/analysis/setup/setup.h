/* analysis/setup/setup.h - one lens in one position made ready to be asked. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_SETUP_SETUP_H
#define LENSCALC_ANALYSIS_SETUP_SETUP_H

#include "analysis/setup/setup_question.h"
#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "optics/paraxial.h"
#include "trace/aim/aim.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * A lens in one position. What all wavelengths share is fixed at the primary one of the lens,
 * whichever are asked for: the radius of the stop, fields given as image heights, the image plane.
 */
struct setup {
    const struct lens *lens; /* in this position */
    const char *position;    /* its name; null = the only one */
    enum lens_section section;
    struct conjugate_object object;
    const struct setup_wavelength *wavelengths; /* at least one */
    size_t wavelength_count;
    const struct setup_field *fields; /* those on one axis on that of the section */
    size_t field_count;               /* 0: FIELDS_LARGEST of a lens without any */
    const char *fields_from;          /* in words, where they are not the lens's; else null */
    struct field_point edge;          /* the one farthest from the axis; FIELD_NONE: none */
    struct first_order first;         /* at the primary wavelength; chief ray: of the edge */
    enum aperture_kind aperture;      /* what fixes its beam */
    double
        real_stop; /* radius that the exact marginal ray gives the stop, mm; NaN: that of `first` */
    /* by setup_place_image */
    double image;        /* the image plane, behind the last vertex, mm; NaN = none */
    const char *focus;   /* "paraxial", "table", "best", "given"; null = no image plane */
    const char *warning; /* what the lens asks for and cannot have; null = nothing */
    /* internal: systems that were asked for, and where they lie */
    struct arena *arena;
    const struct system **systems;
};

/* The radius of the stop that exact rays fill, mm; NaN = none. */
static inline double setup_stop_radius(const struct setup *setup)
{
    return isnan(setup->real_stop) ? setup->first.stop_radius : setup->real_stop;
}

/* Which coordinate fields have: 0 = x, 1 = y. */
static inline size_t setup_axis(const struct setup *setup)
{
    return setup->section == SECTION_X ? 0 : 1;
}

/*
 * Make a lens ready. Nothing is compiled for exact rays yet.
 *
 * Given     question  as above; one lens_check has passed
 *           arena     for all that the setup points to
 * Result    aperture: the f-number asked for, else what the lens states; its stop's radius is
 *           first.stop_radius, NaN where neither says one (then the stop's own diameter limits).
 *           Of lens.stop_is_real exact rays have setup_stop_radius, that of setup_marginal_stop
 * Formula   FIELDS_SPREAD: from the axis in equal steps of the angle, or of the height of a near
 *           object; half diagonal of 35 mm film 21.633 mm = f tan(angle)
 * Errors    as first_order_of_lens and first_order_aperture; ERROR_DOMAIN: FIELDS_SPREAD of a lens
 *           without fields and of a near object or a focal length below 12.5 mm
 */
bool setup_open(const struct setup_question *question, struct arena *arena, struct setup *setup,
                struct error *error);

/*
 * Find the image plane. What the file asks for but cannot be is replaced by the paraxial image,
 * with a warning; what the user asks for is not.
 *
 * Given     asked  PLANE_OF_LENS: as the file says
 * Errors    ERROR_DOMAIN: a table without an image distance; as lens_best_focus; an image at
 *           infinity that was asked for by name
 */
bool setup_place_image(struct setup *setup, const struct plane_value *asked, struct error *error);

/* The same lens, aperture, fields and image plane at another wavelength, um. */
struct setup setup_at_wavelength(const struct setup *setup, double wavelength, struct arena *arena);

/* The same for another thread: with systems of its own, which lie in another arena. */
struct setup setup_apart(const struct setup *setup, struct arena *arena);

/* A setup at one wavelength, paraxially. */
struct setup_light {
    double wavelength; /* um */
    struct paraxial_system system;
    struct first_order first; /* with the stop that the primary wavelength has */
};

/*
 * First-order data at one of the wavelengths.
 *
 * Given     wavelength  its place in the list
 * Errors    as paraxial_compile
 */
bool setup_light(const struct setup *setup, size_t wavelength, struct setup_light *light,
                 struct error *error);

/* The systems a setup has for exact rays, at each wavelength. */
enum setup_which {
    SETUP_OPEN = 0,    /* nothing is clipped, no path, forward, ending behind the last surface */
    SETUP_CLIPPED = 1, /* clear apertures and the stop lose rays */
    SETUP_REVERSED = 2,
    SETUP_PATH = 4,
    SETUP_IMAGE = 8, /* with the image plane, if there is one */
    SETUP_PARAXIAL = 16,
    SETUP_SYSTEMS = 32
};

/*
 * The system for exact rays at one of the wavelengths, compiled when it is first asked for; after
 * that it is read-only. It lies in the setup's arena: ask before setting a mark there that you
 * will go back to, and before starting threads.
 *
 * Given     wavelength  its place in the list; which: enumerators above, joined by |
 * Result    null with `error` set: as system_compile
 */
const struct system *setup_system(const struct setup *setup, size_t wavelength, unsigned which,
                                  struct error *error);

/*
 * The same with clear apertures that somebody else found for surfaces without a diameter, not kept.
 *
 * Given     lens  the setup's, but for diameters
 */
bool setup_compile(const struct setup *setup, const struct lens *lens, size_t wavelength,
                   unsigned which, struct system *system, struct error *error);

/*
 * Where first-order data have the image: as the file has it where it says `focus table`, else the
 * paraxial image of `first`; from the last vertex, mm. A best focus counts as the paraxial one.
 */
struct pair setup_paraxial_image(const struct lens *lens, const struct first_order *first);

/*
 * How high the exact marginal ray of the aperture is in the stop, at the primary wavelength: the
 * ray of the axis through the edge of the paraxial entrance pupil.
 *
 * Result    mm; NaN: the aperture is none, or the stop's own diameter
 * Errors    ERROR_DOMAIN: the ray is lost; a telecentric object space; an entrance pupil that is
 *           infinitely far away
 */
bool setup_marginal_stop(const struct setup *setup, double *radius, struct error *error);

/*
 * Is the beam that the stop lets pass another than that of the aperture, by more than 2 %?
 *
 * Result    a warning in the arena; null: no, or the stop has the size of the real ray
 */
const char *setup_stop_warning(const struct setup *setup, struct arena *arena);

/* A tenth of a stop, as f-numbers: so much lies between labels and what lenses are. */
#define SETUP_WIDTH_SLACK 0.966

/* How wide a lens is, as f-numbers. */
struct setup_width {
    double own;     /* as it states, else as `passing` */
    double passing; /* of the widest beam through all clear apertures but the stop's; 0: no limit */
};

/*
 * Given     fnumber  of the setup's beam
 * Result    NaN where it has no beam
 */
struct setup_width setup_width(const struct setup *setup, double fnumber, struct arena *arena);

/* The warning of setup_width_warning; null: none. */
const char *setup_width_text(const struct setup_width *width, double fnumber, struct arena *arena);

/*
 * Is the beam that is asked for wider than the lens lets through?
 *
 * Given     fnumber  asked for in place of the lens's, as the setup has it; NaN: none
 * Result    a warning in the arena; null where less than a tenth of a stop is asked for beyond what
 *           the lens states, and where the marginal ray passes all clear apertures, the stop's not
 *           counted: a lens without diameters is as wide as anybody wants
 */
const char *setup_width_warning(const struct setup *setup, double fnumber, struct arena *arena);

/* -------- analysis/setup/setup_beam.c -------- */

/*
 * A field as the paraxial rays of the section see it: on its axis. In a round lens all fields as
 * far out are alike, of another one the part in the section counts.
 */
struct field_point setup_in_section(const struct setup *setup, const struct field_point *point);

/*
 * The beam of a field point: beam_of_field; and of a height of the real image the one whose chief
 * ray, at the primary wavelength, meets the image plane there, that of the setup, else of the lens.
 *
 * Errors    as beam_of_field; ERROR_DOMAIN: no image plane, no stop, no chief ray that gets there
 */
bool setup_beam(const struct setup *setup, const struct field_point *field, struct beam *beam,
                struct error *error);

/* A height of the real image whose object has been found: where to begin with the next. */
struct setup_near {
    bool is_known;
    double goal[2], at[2]; /* the height, mm; the object: rad or mm */
    struct aim_near chief; /* at the primary wavelength */
};

/* The same from a height near by, which becomes this one; null: there is none. */
bool setup_beam_near(const struct setup *setup, const struct field_point *field,
                     struct setup_near *near, struct beam *beam, struct error *error);

/*
 * A field becomes what the section sees of it, setup_in_section, and a height of the real image the
 * angle or the height of its object.
 *
 * Errors    as setup_beam
 */
bool setup_real_in_object(const struct setup *setup, struct field_point *field,
                          struct error *error);

/* -------- analysis/setup/setup_fields.c -------- */

/* The edge in the section; an image height as the primary wavelength sees its object. */
struct field_point setup_edge_in_object(const struct setup *setup);

/* Internal to setup_open: fields, fields_from and edge; setup->first is still without aperture. */
bool setup_choose_fields(const struct setup_question *question, struct setup *setup,
                         struct error *error);

#endif
