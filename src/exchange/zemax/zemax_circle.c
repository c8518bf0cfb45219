/* exchange/zemax/zemax_circle.c - pick-ups of a .zmx file that go in a circle. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_circle.h"

/* What is picked up: the parameters by their numbers, and behind them the others. */
enum { THICKNESS = ZEMAX_PARAMETERS, CURVATURE, DIAMETER, KINDS };

/* The line of a pick-up, and where in it the surface, then the column, stand; null: none. */
static const struct zemax_line *pickup_of(const struct zemax_surface *surface, size_t kind,
                                          size_t *source, size_t *column)
{
    const struct zemax_line *line = NULL;
    switch (kind) {
    case THICKNESS: /* PZUP surface scale offset column */
        *source = 0;
        *column = 3;
        line = surface->solve;
        return line != NULL && text_same(line->keyword, "PZUP") ? line : NULL;
    case CURVATURE: /* CURV c 4 surface scale column */
        *source = 2;
        *column = 4;
        line = surface->curvature;
        return zemax_number(line, 1) == 4 ? line : NULL;
    case DIAMETER: /* DIAM value 2 surface column */
        *source = 2;
        *column = 3;
        line = surface->diameter;
        return zemax_number(line, 1) == 2 ? line : NULL;
    default: /* PPAR number surface scale offset column */
        *source = 1;
        *column = 4;
        return surface->pickups[kind];
    }
}

/* The surface that a number follows; surface_count: none, or another column of one. */
static size_t source_of(const struct zemax_file *file, size_t at, size_t kind,
                        const struct zemax_line **line)
{
    size_t place = 0, column = 0;
    *line = pickup_of(&file->surfaces[at], kind, &place, &column);
    double source = zemax_number(*line, place);
    bool follows = *line != NULL && place < (*line)->count && zemax_number(*line, column) == 0;
    return follows && source >= 0 && source < (double)file->surface_count ? (size_t)source
                                                                          : file->surface_count;
}

/* From a pick-up of a later surface, or of its own, along those that it follows. */
static bool check_from(const struct zemax_file *file, size_t at, size_t kind, struct error *error)
{
    const struct zemax_line *line, *next;
    size_t source = source_of(file, at, kind, &line), walk = source;
    if (source < at) {
        return true; /* a circle has one that follows a later surface */
    }
    for (size_t i = 0; i < file->surface_count && walk < file->surface_count; i++) {
        if (walk == at) {
            return file_words_fail(&line->words, line->keyword, error,
                                   "the pick-ups go in a circle: surface %zu follows surface %zu, "
                                   "which follows it",
                                   at, source);
        }
        walk = source_of(file, walk, kind, &next);
    }
    return true;
}

bool zemax_check_circles(const struct zemax_file *file, struct error *error)
{
    for (size_t at = 0; at < file->surface_count; at++) {
        for (size_t kind = 0; kind < KINDS; kind++) {
            if (!check_from(file, at, kind, error)) {
                return false;
            }
        }
    }
    return true;
}
