/* exchange/pbrt_write.c - write lens tables of the realistic camera of pbrt. */
/* SPDX-License-Identifier: MIT */
#include "exchange/pbrt.h"
#include "exchange/writing.h"
#include "file/lens_build.h"
#include "optics/wavelength.h"

#include <math.h>
#include <string.h>

/* What stands for a plane that refracts, mm; see pbrt.h. */
static const char LONG_RADIUS[] = "100000";

struct pbrt_write_writer {
    struct lens_writer out;
    struct foreign_job *job;
    const struct lens *lens; /* in one position */
    struct error *error;
};

static void pbrt_write_put(struct pbrt_write_writer *writer, const char *string)
{
    growing_text(&writer->out.text, text_of(string));
}

/* As typed, or the digits that read back to its pair. */
static struct text pbrt_write_digits_of(const struct pbrt_write_writer *writer,
                                        const struct figure *figure)
{
    return figure->typed.start != NULL
               ? figure->typed
               : figure_computed(figure->value, NUMBER_UNSCALED, writer->job->arena).typed;
}

static bool pbrt_write_refuse(const struct pbrt_write_writer *writer, size_t number,
                              const char *what)
{
    fail(writer->error, ERROR_DATA, "surface %zu %s: a .dat file cannot hold it", number, what);
    return error_locate(writer->error, writer->job->source, 0, 0);
}

static bool lose_header(struct pbrt_write_writer *writer)
{
    const struct lens *lens = writer->lens;
    bool only_d = lens->wavelength_count == 0 ||
                  (lens->wavelength_count == 1 &&
                   !(fabs(lens->wavelengths[0].wavelength - WAVELENGTH_D) > 0));
    if (!medium_is_air(&lens->object_medium)) {
        fail(writer->error, ERROR_DATA, "a .dat file has air before the lens");
        return error_locate(writer->error, writer->job->source, 0, 0);
    }
    return (only_d || foreign_lose(writer->job, writer->error,
                                   "a .dat file has no wavelengths" LOSS_INSTEAD "%.10g nm counts",
                                   1000 * lens_primary_wavelength(lens))) &&
           (lens->object_is_infinite ||
            foreign_lose(writer->job, writer->error, "a .dat file has no object distance")) &&
           (lens->field_count == 0 ||
            foreign_lose(writer->job, writer->error, "a .dat file has no fields")) &&
           (lens->aperture_kind == APERTURE_NONE || lens->aperture_kind == APERTURE_STOP ||
            foreign_lose(writer->job, writer->error,
                         "a .dat file has no aperture but the stop's diameter")) &&
           (lens->focus == FOCUS_PARAXIAL ||
            foreign_lose(writer->job, writer->error, "a .dat file has no choice of focus"));
}

static bool lose_shape(struct pbrt_write_writer *writer, const struct surface *surface,
                       size_t number)
{
    if (surface_reflects(surface)) {
        return pbrt_write_refuse(writer, number, "is a mirror");
    }
    if (!surface_is_round(surface)) {
        return pbrt_write_refuse(writer, number, "is a cylinder");
    }
    if (!surface->has_diameter) {
        return pbrt_write_refuse(writer, number, "has no diameter");
    }
    bool is_displaced = surface->decentre != NULL || surface->coordinate_break != NULL;
    bool aspheric = fabs(surface->conic.value.hi) > 0 || surface->coefficients != 0;
    return (!is_displaced ||
            foreign_lose(writer->job, writer->error,
                         "surface %zu: its decentre or tilt" LOSS_INSTEAD "left out", number)) &&
           (!aspheric ||
            foreign_lose(writer->job, writer->error,
                         "surface %zu: an asphere" LOSS_INSTEAD "a sphere is used instead",
                         number)) &&
           (surface->vary_count == 0 ||
            foreign_lose(writer->job, writer->error,
                         "surface %zu: its marks for the designer" LOSS_INSTEAD "left out",
                         number)) &&
           (surface->name == NULL ||
            foreign_lose(writer->job, writer->error,
                         "surface %zu: its name" LOSS_INSTEAD "left out", number));
}

/* Digits of a length in mm. */
static void pbrt_write_put_length(struct pbrt_write_writer *writer, const struct figure *figure)
{
    struct figure in_mm = *figure;
    if (strcmp(writer->lens->unit, "mm") != 0) {
        in_mm.typed = (struct text){NULL, 0};
    }
    growing_text(&writer->out.text, pbrt_write_digits_of(writer, &in_mm));
}

static bool pbrt_write_put_radius(struct pbrt_write_writer *writer, const struct surface *surface,
                                  size_t number)
{
    if (surface->kind == SURFACE_STOP) {
        if (!surface->is_stop && !foreign_lose(writer->job, writer->error,
                                               "surface %zu: pbrt takes it for a stop", number)) {
            return false;
        }
        pbrt_write_put(writer, "0");
        return true;
    }
    if (surface->is_stop &&
        !foreign_lose(writer->job, writer->error,
                      "surface %zu: a .dat file has no stop on a surface", number)) {
        return false;
    }
    const struct figure reciprocal = {.value = pair_divide(pair_of(1), surface->curvature.value),
                                      .variable = LENS_NONE};
    if (surface->has_curvature && fabs(reciprocal.value.hi) < 1e100) {
        pbrt_write_put_length(writer, &reciprocal);
        return true;
    }
    if (!surface->is_plane && !surface->has_curvature) {
        pbrt_write_put_length(writer, &surface->radius);
        return true;
    }
    pbrt_write_put(writer, LONG_RADIUS);
    return foreign_lose(writer->job, writer->error,
                        "surface %zu: a plane is pbrt's stop" LOSS_INSTEAD
                        "a radius of %s mm is used instead",
                        number, LONG_RADIUS);
}

/* The index behind a surface, at the primary wavelength. */
static bool find_index(struct pbrt_write_writer *writer, const struct surface *surface,
                       size_t number, struct text *digits)
{
    const struct medium *medium = &surface->medium;
    struct figure index = {.variable = LENS_NONE};
    if (medium_is_air(medium)) {
        *digits = text_of("1");
        return true;
    }
    double wavelength = lens_primary_wavelength(writer->lens);
    if (!medium_index(medium, wavelength, &index.value, writer->error)) {
        return error_prefix(writer->error, "surface %zu: ", number);
    }
    if (medium->kind == MEDIUM_CONSTANT) {
        index.typed = medium->written;
    } else if (!foreign_lose(writer->job, writer->error,
                             "surface %zu: of %.*s the index at %.10g nm is kept, no dispersion",
                             number,
                             (int)(medium->written.length < 60 ? medium->written.length : 60),
                             medium->written.start, 1000 * wavelength)) {
        return false;
    }
    *digits = pbrt_write_digits_of(writer, &index);
    return true;
}

/* The plane of a stop that refracts, which stands before it then. */
static bool put_plane(struct pbrt_write_writer *writer, const struct surface *surface,
                      size_t number, struct text index)
{
    pbrt_write_put(writer, LONG_RADIUS);
    pbrt_write_put(writer, "\t0\t");
    growing_text(&writer->out.text, index);
    pbrt_write_put(writer, "\t");
    pbrt_write_put_length(writer, &surface->diameter);
    pbrt_write_put(writer, "\n");
    return foreign_lose(writer->job, writer->error,
                        "surface %zu: a stop that refracts" LOSS_INSTEAD
                        "a radius of %s mm stands before the stop",
                        number, LONG_RADIUS);
}

static bool pbrt_write_put_surface(struct pbrt_write_writer *writer, size_t i)
{
    const struct lens *lens = writer->lens;
    const struct surface *surface = &lens->surfaces[i];
    const struct medium *before = i > 0 ? &surface[-1].medium : &lens->object_medium;
    const bool is_stop = surface->kind == SURFACE_STOP;
    struct text index;
    if (!lose_shape(writer, surface, i + 1) || !find_index(writer, surface, i + 1, &index) ||
        (is_stop && !medium_is_same(before, &surface->medium) &&
         !put_plane(writer, surface, i + 1, index)) ||
        !pbrt_write_put_radius(writer, surface, i + 1)) {
        return false;
    }
    pbrt_write_put(writer, "\t");
    if (surface->has_thickness) {
        pbrt_write_put_length(writer, &surface->thickness);
    } else {
        pbrt_write_put(writer, "0");
    }
    pbrt_write_put(writer, "\t");
    growing_text(&writer->out.text,
                 is_stop && medium_is_air(&surface->medium) ? text_of("0") : index);
    pbrt_write_put(writer, "\t");
    pbrt_write_put_length(writer, &surface->diameter);
    pbrt_write_put(writer, "\n");
    return true;
}

static void put_comment(struct pbrt_write_writer *writer, const char *word, const char *text)
{
    if (text != NULL) {
        pbrt_write_put(writer, "# ");
        pbrt_write_put(writer, word);
        pbrt_write_put(writer, text);
        pbrt_write_put(writer, "\n");
    }
}

bool pbrt_write(struct foreign_job *job, const struct lens *lens, struct text *text,
                struct error *error)
{
    struct pbrt_write_writer writer = {
        .job = job, .lens = lens_at_position(lens, 0, job->arena), .error = error};
    writing_begin(&writer.out, writer.lens, false, job->arena);
    if (lens->position_count > 1 &&
        !foreign_lose(writer.job, writer.error, "a .dat file has one position: the first, '%s'",
                      lens->positions[0])) {
        return false;
    }
    if (!lose_header(&writer)) {
        return false;
    }
    put_comment(&writer, "", lens->title != NULL ? lens->title : "lens");
    put_comment(&writer, "source ", lens->source);
    put_comment(&writer, "kind ", lens->kind);
    for (size_t i = 0; i < lens->note_count; i++) {
        put_comment(&writer, "", lens->notes[i]);
    }
    pbrt_write_put(&writer, "# radius\tthickness\tindex\tdiameter\n");
    for (size_t i = 0; i < lens->surface_count; i++) {
        if (!pbrt_write_put_surface(&writer, i)) {
            return false;
        }
    }
    *text = growing_done(&writer.out.text);
    return true;
}
