/* exchange/codev/codev_writer.h - a CODE V file while it is written. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_CODEV_CODEV_WRITER_H
#define LENSCALC_EXCHANGE_CODEV_CODEV_WRITER_H

#include "exchange/foreign.h"
#include "exchange/writing.h"

/* A lens being written; what is no glass of CODE V goes into a catalogue of the file. */
struct codev_output {
    struct lens_writer writing;
    const struct medium **own; /* media of the file's catalogue */
    size_t own_count;
};

/* The command of an aperture, by its kind. */
extern const char *const codev_aperture_words[];

/* The commands of the field's points, by their kind: x and y. */
extern const char *const codev_field_words[][2];

/*
 * Numbers of one command; long commands go on in the next line.
 *
 * Given     column  of what stands in the line before the number; afterwards with it
 */
void codev_put_number(struct lens_writer *writing, size_t *column, const char *number);

/* A line of wavelengths in nm, or of their weights: "WL", "WTW Z2". */
void codev_put_waves(struct lens_writer *writing, const char *command,
                     const struct lens_light *light, bool weights);

/* What a line of the fields has of each. */
enum codev_row { CODEV_X, CODEV_Y, CODEV_WEIGHTS, CODEV_ROWS };
void codev_put_fields(struct lens_writer *writing, const char *command,
                      const struct lens_points *points, enum codev_row row);

void codev_put_text(struct lens_writer *writing, const char *name, const char *string);

/* The word for a medium behind a surface, with a blank before it; nothing for air. */
void codev_put_medium(struct codev_output *output, const struct medium *medium);

/* Is it a term of ASP, an even power from r^4 on? Has the surface it, be it 0? */
bool codev_is_of_asp(int term);
bool codev_is_term_given(const struct surface *surface, int term);

/* Is the surface one of SPS ODD, whose numbers are those of SCO? */
bool codev_is_odd(const struct surface *surface);

/* "A" of r^4, or "AR3" */
const char *codev_coefficient_word(int order, bool is_odd, struct arena *arena);

/* ZOO, and commands of a position: Zk. */
void codev_put_positions(struct codev_output *output);

#endif
