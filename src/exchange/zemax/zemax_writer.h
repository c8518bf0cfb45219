/* exchange/zemax/zemax_writer.h - the parts of writing a .zmx file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_WRITER_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_WRITER_H

#include "exchange/foreign.h"
#include "exchange/writing.h"
#include "optics/lens.h"

enum { ZEMAX_MOST_CATALOGS = 32 };

/* A file being written. */
struct zemax_writer {
    struct lens_writer writing;
    struct text catalogs[ZEMAX_MOST_CATALOGS];
    size_t catalog_count;
    size_t number;      /* of the surface to write next */
    size_t *places;     /* the file's surface with the thickness of each surface of the lens */
    size_t *own_places; /* and with its diameter */
};

/* Keep the catalogue of a medium for the list of them. */
void zemax_note_catalog(struct zemax_writer *writer, const struct medium *medium);

/*
 * GLAS; nothing for air.
 *
 * Errors    an index that a table does not give; the glass of a user's AGF file is damaged
 */
bool zemax_put_medium(struct zemax_writer *writer, const struct medium *medium,
                      struct error *error);

/* "SURF n" and its type. */
void zemax_put_surf(struct zemax_writer *writer, const char *type);

/* The name of a glass as its catalogue spells it; "" of air. Errors as zemax_put_medium */
bool zemax_put_glass_name(struct zemax_writer *writer, const struct medium *medium,
                          struct error *error);

/* The operand that sets a number of a surface in a configuration; null: there is none. */
const char *zemax_operand_of(const struct surface *surface, struct parameter parameter,
                             struct arena *arena);

/* The digits of a number as that operand has it. */
const char *zemax_number_of(const struct lens_writer *writing, struct parameter parameter,
                            const struct figure *figure);

/* The digits of a coordinate of a point of the field. */
const char *zemax_coordinate(const struct lens_writer *writing, const struct figure *figure);

/* The configurations, as many as the lens has positions. The surfaces were put. */
bool zemax_put_positions(struct zemax_writer *writer, struct error *error);

/* A surface of the lens, with the breaks of the axis around it. Errors as zemax_put_medium */
bool zemax_put_surface(struct zemax_writer *writer, size_t index, struct error *error);

/* The digits of half of a diameter. */
const char *zemax_half(const struct lens_writer *writing, const struct figure *figure);

/* The first one of a surface that the format has; the others are losses. */
void zemax_put_aperture(struct lens_writer *writing, const struct surface *surface, size_t number);

#endif
