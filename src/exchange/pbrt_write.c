/* exchange/pbrt_write.c - write lens tables of the realistic camera of pbrt. */
/* SPDX-License-Identifier: MIT */
#include "exchange/pbrt.h"
#include "exchange/writing.h"
#include "file/lens_build.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

/* What stands for a plane that refracts, mm; see pbrt.h. */
#define LONG_RADIUS "100000"

static bool pbrt_refuse(const struct foreign_job *job, size_t number, const char *what,
                        struct error *error)
{
    return foreign_fail(job, error, "surface %zu %s: a .dat file cannot hold it", number, what);
}

static bool pbrt_lose_header(struct foreign_job *job, const struct lens *lens, struct error *error)
{
    bool only_d = lens->wavelength_count == 0 ||
                  (lens->wavelength_count == 1 &&
                   !(fabs(lens->wavelengths[0].wavelength - WAVELENGTH_D) > 0));
    if (!medium_is_air(&lens->object_medium)) {
        return foreign_fail(job, error, "a .dat file has air before the lens");
    }
    if (!only_d) {
        foreign_lose(
            job, LOSS_OF_RAYS,
            arena_printf(job->arena, "%.10g nm counts", 1000 * lens_primary_wavelength(lens)),
            "a .dat file has no wavelengths");
    }
    const struct {
        bool has;
        const char *what;
    } all[] = {{!lens->object_is_infinite, "object distance"},
               {lens->field_count > 0, "fields"},
               {lens->aperture_kind > APERTURE_STOP, "aperture but the stop's diameter"},
               {lens->focus != FOCUS_PARAXIAL, "choice of focus"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        if (all[i].has) {
            foreign_lose(job, LOSS_OF_RAYS, NULL, "a .dat file has no %s", all[i].what);
        }
    }
    return true;
}

static bool pbrt_lose_shape(struct foreign_job *job, const struct surface *surface, size_t number,
                            struct error *error)
{
    if (surface_reflects(surface)) {
        return pbrt_refuse(job, number, "is a mirror", error);
    }
    if (!surface_is_round(surface)) {
        return pbrt_refuse(job, number, "is a cylinder", error);
    }
    if (!surface->has_diameter) {
        return pbrt_refuse(job, number, "has no diameter", error);
    }
    if (surface->decentre != NULL || surface->coordinate_break != NULL) {
        foreign_lose(job, LOSS_OF_RAYS, "left out", "surface %zu: its decentre or tilt", number);
    }
    if (fabs(surface->conic.value.hi) > 0 || surface->coefficients != 0) {
        foreign_lose(job, LOSS_OF_RAYS, "a sphere is used instead", "surface %zu: an asphere",
                     number);
    }
    if (surface->vary_count > 0) {
        foreign_lose(job, LOSS_OF_RAYS, "left out", "surface %zu: its marks for the designer",
                     number);
    }
    if (surface->name != NULL) {
        foreign_lose(job, LOSS_OF_RAYS, "left out", "surface %zu: its name", number);
    }
    return true;
}

/* Digits of a length in mm. */
static const char *pbrt_length(const struct lens_writer *writing, const struct figure *figure)
{
    struct figure in_mm = *figure;
    in_mm.variable = LENS_NONE;
    if (strcmp(writing->lens->unit, "mm") != 0) {
        in_mm = figure_computed(figure->value, NUMBER_UNSCALED, writing->arena);
    }
    return writing_length(writing, &in_mm, 0);
}

static const char *pbrt_radius(struct lens_writer *writing, const struct surface *surface,
                               size_t number)
{
    if (surface->kind == SURFACE_STOP) {
        if (!surface->is_stop) {
            foreign_lose(writing->job, LOSS_OF_RAYS, NULL, "surface %zu: pbrt takes it for a stop",
                         number);
        }
        return "0";
    }
    if (surface->is_stop) {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                     "surface %zu: a .dat file has no stop on a surface", number);
    }
    const struct figure reciprocal = {.value = pair_divide(pair_of(1), surface->curvature.value),
                                      .variable = LENS_NONE};
    if (surface->has_curvature && fabs(reciprocal.value.hi) < 1e100) {
        return pbrt_length(writing, &reciprocal);
    }
    if (!surface->is_plane && !surface->has_curvature) {
        return pbrt_length(writing, &surface->radius);
    }
    foreign_lose(writing->job, LOSS_OF_RAYS, "a radius of " LONG_RADIUS " mm is used instead",
                 "surface %zu: a plane is pbrt's stop", number);
    return LONG_RADIUS;
}

/* The index behind a surface, at the primary wavelength; null with an error where there is none. */
static const char *pbrt_index(struct lens_writer *writing, const struct surface *surface,
                              size_t number, struct error *error)
{
    const struct medium *medium = &surface->medium;
    const double wavelength = lens_primary_wavelength(writing->lens);
    struct figure index = {.variable = LENS_NONE};
    if (medium_is_air(medium)) {
        return "1";
    }
    if (!medium_index(medium, wavelength, &index.value, error)) {
        error_prefix(error, "surface %zu: ", number);
        return NULL;
    }
    if (medium->kind == MEDIUM_CONSTANT) {
        index.typed = medium->written;
    } else {
        foreign_lose(writing->job, LOSS_OF_RAYS, NULL,
                     "surface %zu: of %.*s the index at %.10g nm is kept, no dispersion", number,
                     text_shown(medium->written), medium->written.start, 1000 * wavelength);
    }
    return writing_length(writing, &index, 0);
}

static bool pbrt_put_surface(struct lens_writer *writing, size_t i, struct error *error)
{
    const struct lens *lens = writing->lens;
    const struct surface *surface = &lens->surfaces[i];
    const struct medium *before = i > 0 ? &surface[-1].medium : &lens->object_medium;
    const bool is_stop = surface->kind == SURFACE_STOP;
    if (!pbrt_lose_shape(writing->job, surface, i + 1, error)) {
        return false;
    }
    const char *index = pbrt_index(writing, surface, i + 1, error);
    if (index == NULL) {
        return false;
    }
    const char *diameter = pbrt_length(writing, &surface->diameter);
    if (is_stop && !medium_is_same(before, &surface->medium)) { /* it stands before the plane */
        writing_put(writing, LONG_RADIUS "\t0\t%s\t%s\n", index, diameter);
        foreign_lose(writing->job, LOSS_OF_RAYS,
                     "a radius of " LONG_RADIUS " mm stands before the stop",
                     "surface %zu: a stop that refracts", i + 1);
    }
    writing_put(writing, "%s\t%s\t%s\t%s\n", pbrt_radius(writing, surface, i + 1),
                surface->has_thickness ? pbrt_length(writing, &surface->thickness) : "0",
                is_stop && medium_is_air(&surface->medium) ? "0" : index, diameter);
    return true;
}

static void pbrt_put_comment(struct lens_writer *writing, const char *word, const char *text)
{
    if (text != NULL) {
        writing_put(writing, "# %s%s\n", word, text);
    }
}

bool pbrt_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                struct error *error)
{
    struct lens_writer writing;
    writing_begin(&writing, job, lens_at_position(lens, 0, job->arena), false);
    if (lens->position_count > 1) {
        foreign_lose(job, LOSS_OF_RAYS, NULL, "a .dat file has one position: the first, '%s'",
                     lens->positions[0]);
    }
    if (!pbrt_lose_header(job, writing.lens, error)) {
        return false;
    }
    pbrt_put_comment(&writing, "", lens->title != NULL ? lens->title : "lens");
    pbrt_put_comment(&writing, "source ", lens->source);
    pbrt_put_comment(&writing, "kind ", lens->kind);
    for (size_t i = 0; i < lens->note_count; i++) {
        pbrt_put_comment(&writing, "", lens->notes[i]);
    }
    writing_put(&writing, "# radius\tthickness\tindex\tdiameter\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!pbrt_put_surface(&writing, i, error)) {
            return false;
        }
    }
    *text = growing_done(&writing.text);
    return true;
}
