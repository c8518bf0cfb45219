/* analysis/setup/setup_question.h - what is asked of a lens, as plain data: the rules of lenscalc(1). */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_SETUP_SETUP_QUESTION_H
#define LENSCALC_ANALYSIS_SETUP_SETUP_QUESTION_H

#include "optics/lens.h"
#include "trace/aim/beam.h"

#include <stddef.h>

/* The wavelengths where none is asked for. */
enum wavelength_policy {
    WAVELENGTHS_PRIMARY, /* the first of the lens; of a lens without any the d line */
    WAVELENGTHS_ALL      /* those of the lens, each with its weight */
};

/* The fields where none is asked for. */
enum field_policy {
    FIELDS_LARGEST, /* the farthest from the axis; none where the lens states none */
    FIELDS_EDGE,    /* the same; 5 deg where that is the axis or the lens states none */
    FIELDS_ALL,     /* those of the lens; of a lens without any the axis */
    FIELDS_SPREAD   /* from 0 by eighths to the largest; of a lens without any the largest is
                       where a lens without distortion has the corner of 35 mm film.
                       These, and those asked for, as angles of a far object, heights of a near */
};

/* Where the image plane stands. */
enum plane_kind { PLANE_OF_LENS, PLANE_PARAXIAL, PLANE_TABLE, PLANE_BEST, PLANE_AT };

struct plane_value {
    enum plane_kind kind; /* PLANE_OF_LENS: not given */
    double distance;      /* PLANE_AT: behind the last vertex, mm */
};

/* A wavelength that counts so much. */
struct setup_wavelength {
    double wavelength; /* um */
    double weight;
};

/* A field point that counts so much. */
struct setup_field {
    struct field_point point;
    double weight;
};

/* One lens in one position, and how it is looked at. */
struct setup_question {
    const struct lens *lens; /* as read, with all its positions */
    size_t position;         /* 0 where it has only one */
    enum lens_section section;
    const double *object; /* distance before the first vertex, mm; null = that of the lens */
    double wavelength;    /* um; NaN = those of the lens, by */
    enum wavelength_policy wavelengths;
    const struct setup_wavelength *spectrum; /* in place of both; count 0 = none */
    size_t spectrum_count;
    double fnumber;                   /* NaN = the lens's own aperture */
    const struct setup_field *fields; /* asked for; count 0 = those of the lens, by */
    size_t field_count;
    enum field_policy field_policy;
    bool takes_telecentric; /* beams of a telecentric object space may be given by their slopes */
    bool leaves_stop;       /* a stop of the size of a real ray is found by who asks */
};

#endif
