/* camera/subject/depth_card.c - lines of sight over a map of 1/distance. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/depth_card.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>

enum { X, Y, AXES };

/* -------- made of a map -------- */

static size_t halved(size_t count, int level)
{
    return ((count - 1) >> level) + 1;
}

/* Of four squares each, or fewer at the border. */
static void merge_level(const struct depth_card *relief, double **of, bool is_most, int level)
{
    const size_t columns = halved(relief->columns, level), rows = halved(relief->rows, level);
    const size_t below = halved(relief->columns, level - 1);
    const size_t last[AXES] = {below - 1, halved(relief->rows, level - 1) - 1};
    const double *from = of[level - 1], sign = is_most ? 1 : -1;
    for (size_t j = 0; j < rows; j++) {
        for (size_t i = 0; i < columns; i++) {
            const size_t right = 2 * i < last[X] ? 2 * i + 1 : 2 * i;
            const size_t down = 2 * j < last[Y] ? 2 * j + 1 : 2 * j;
            const double upper =
                fmax(sign * from[2 * j * below + 2 * i], sign * from[2 * j * below + right]);
            const double lower =
                fmax(sign * from[down * below + 2 * i], sign * from[down * below + right]);
            of[level][j * columns + i] = sign * fmax(upper, lower);
        }
    }
}

bool depth_card_open(const struct depth_card_question *question, struct arena *arena,
                     struct depth_card *relief, struct error *error)
{
    const struct card *card = &question->card;
    const size_t columns = question->depths->width, rows = question->depths->height;
    *relief = (struct depth_card){.card = *card,
                                  .is_endless = question->is_endless,
                                  .hidden = question->hidden,
                                  .columns = columns,
                                  .rows = rows,
                                  .pupil = question->pupil,
                                  .frame = question->pupil + card->distance,
                                  .levels = 1};
    if (!isfinite(question->pupil)) {
        return fail(error, ERROR_DOMAIN,
                    "the entrance pupil lies at infinity: no depth map is seen from there");
    }
    if (!(relief->frame > 0)) {
        return fail(error, ERROR_DOMAIN, "the card lies behind the entrance pupil");
    }
    relief->parallax = question->radius * relief->frame * (double)columns / card->width;
    if (card->picture != NULL) {
        relief->rim[X] = 0.5 * (double)columns / (double)card->picture->width;
        relief->rim[Y] = 0.5 * (double)rows / (double)card->picture->height;
    }
    while (halved(columns, relief->levels - 1) > 1 || halved(rows, relief->levels - 1) > 1) {
        relief->levels++;
    }
    relief->nearest = ARENA_ARRAY(arena, (size_t)relief->levels, double *);
    relief->farthest = ARENA_ARRAY(arena, (size_t)relief->levels, double *);
    relief->nearest[0] = relief->farthest[0] = ARENA_ARRAY(arena, columns * rows, double);
    /* 1/distance of every pixel */
    const struct image *depths = question->depths;
    for (size_t i = 0; i < depths->width * depths->height; i++) {
        const double depth = (double)depths->pixels[i];
        const double before = depth * MM_PER_M - question->sensor;
        const size_t column = i % depths->width + 1, row = i / depths->width + 1;
        if (!(depth > 0)) {
            return fail(error, ERROR_DATA,
                        "%.200s: the depth in column %zu, row %zu is %g m: it must be above 0",
                        question->name, column, row, depth);
        }
        if (!(before > 0 && before + question->pupil > 0)) {
            return fail(error, ERROR_DATA,
                        "%.200s: the depth in column %zu, row %zu, %.6g m, lies within the lens, "
                        "which reaches to %.6g m before the sensor",
                        question->name, column, row, depth,
                        fmax(question->sensor, question->sensor - question->pupil) / MM_PER_M);
        }
        relief->nearest[0][i] = 1 / (before + question->pupil);
    }
    for (int level = 1; level < relief->levels; level++) {
        const size_t count = halved(columns, level) * halved(rows, level);
        relief->nearest[level] = ARENA_ARRAY(arena, count, double);
        relief->farthest[level] = ARENA_ARRAY(arena, count, double);
        merge_level(relief, relief->nearest, true, level);
        merge_level(relief, relief->farthest, false, level);
    }
    return true;
}

/* -------- a ray over it -------- */

/* A pixel of the map; those beyond its frame are told from the others. */
struct depth_card_place {
    long at[AXES];
};

struct depth_card_walk {
    const struct depth_card *relief;
    double from[AXES], per_w[AXES];       /* the place is from + per_w w, in pixels */
    double per_pixel[AXES];               /* 1/per_w */
    double w;                             /* where it has come to, 1/mm */
    struct depth_card_place here, before; /* before the border that it crossed last */
};

/* Rounded down also below 0: all places lie within so many pixels of the frame. */
static long square_of(long at, int level)
{
    const long shift = 1L << 40;
    return ((at + shift) >> level) - (shift >> level);
}

/* floor() is a call where instructions from before SSE4 have to do. */
static long depth_card_floor_of(double x)
{
    const long whole = (long)x;
    return x < (double)whole ? whole - 1 : whole;
}

static long depth_card_clamped(long at, size_t count)
{
    if (at < 0) {
        return 0;
    }
    if (at >= (long)count) {
        return (long)count - 1;
    }
    return at;
}

static bool depth_card_is_within(const struct depth_card *relief, struct depth_card_place place)
{
    return place.at[X] >= 0 && place.at[X] < (long)relief->columns && place.at[Y] >= 0 &&
           place.at[Y] < (long)relief->rows;
}

/* The nearest in a square: beyond the frame no more than on its border, or nothing. */
static double nearest_in(const struct depth_card *relief, struct depth_card_place place, int level)
{
    if (!relief->is_endless && level == 0 && !depth_card_is_within(relief, place)) {
        return 0;
    }
    const size_t columns = halved(relief->columns, level), rows = halved(relief->rows, level);
    const long column = depth_card_clamped(square_of(place.at[X], level), columns);
    const long row = depth_card_clamped(square_of(place.at[Y], level), rows);
    return relief->nearest[level][(size_t)row * columns + (size_t)column];
}

/* Where it leaves the square: w, and across which axis. */
static double leaving(const struct depth_card_walk *walk, int level, int *axis)
{
    double w = 0;
    *axis = X;
    for (int k = X; k < AXES; k++) {
        const long square = square_of(walk->here.at[k], level);
        const long border = (walk->per_w[k] > 0 ? square : square + 1) * (1L << level);
        const double at = ((double)border - walk->from[k]) * walk->per_pixel[k];
        if (walk->per_w[k] != 0 && at > w) {
            w = at;
            *axis = k;
        }
    }
    return w < walk->w ? w : walk->w;
}

/* Over the border of the square, into the pixel behind it. */
static void depth_card_cross(struct depth_card_walk *walk, int level, double w, int axis)
{
    const int other = axis == X ? Y : X;
    const long size = 1L << level;
    const long square = square_of(walk->here.at[axis], level) * size;
    const long beside = square_of(walk->here.at[other], level) * size;
    const long along = depth_card_floor_of(walk->from[other] + walk->per_w[other] * w);
    const bool down = walk->per_w[axis] > 0; /* w falls */
    walk->here.at[axis] = down ? square - 1 : square + size;
    if (along < beside) {
        walk->here.at[other] = beside;
    } else if (along >= beside + size) {
        walk->here.at[other] = beside + size - 1;
    } else {
        walk->here.at[other] = along;
    }
    walk->before = walk->here;
    walk->before.at[axis] += down ? 1 : -1;
    walk->w = w;
}

/* Do rays of the pupil's rim pass between neighbours? Beside a card they always do. */
static bool is_edge(const struct depth_card *relief, struct depth_card_place place,
                    struct depth_card_place other)
{
    const double step = nearest_in(relief, place, 0) - nearest_in(relief, other, 0);
    const bool goes_on = relief->is_endless ||
                         depth_card_is_within(relief, place) == depth_card_is_within(relief, other);
    return !goes_on || fabs(step) * relief->parallax > 1;
}

/* A pixel's place at w along an axis, without what its neighbours beyond an edge would mix in. */
static double kept_within(const struct depth_card_walk *walk, struct depth_card_place pixel,
                          int axis, double w)
{
    const struct depth_card *relief = walk->relief;
    const double begin = (double)pixel.at[axis], rim = relief->rim[axis];
    double low = begin, high = begin + 1;
    struct depth_card_place beside = pixel;
    beside.at[axis]--;
    low += is_edge(relief, pixel, beside) ? rim : 0;
    beside.at[axis] += 2;
    high -= is_edge(relief, pixel, beside) ? rim : 0;
    const double at = walk->from[axis] + walk->per_w[axis] * w;
    return low > high ? begin + 0.5 : fmin(fmax(at, low), high);
}

/* The light of a pixel, which the ray meets at w. */
static struct card_light light_at(const struct depth_card_walk *walk, struct depth_card_place pixel,
                                  double w)
{
    const struct depth_card *relief = walk->relief;
    const struct card *card = &relief->card;
    pixel.at[X] =
        relief->is_endless ? depth_card_clamped(pixel.at[X], relief->columns) : pixel.at[X];
    pixel.at[Y] = relief->is_endless ? depth_card_clamped(pixel.at[Y], relief->rows) : pixel.at[Y];
    if (!depth_card_is_within(relief, pixel)) {
        return (struct card_light){{0, 0, 0}};
    }
    const double x = kept_within(walk, pixel, X, w) / (double)relief->columns - 0.5;
    const double y = 0.5 - kept_within(walk, pixel, Y, w) / (double)relief->rows;
    return card_look(card, x * card->width, y * card->height);
}

/*
 * Go on behind an edge.
 *
 * Result    true: it ends there, at the distance of the pixel that it was before; false: it has
 *           come out again
 */
static bool goes_behind(struct depth_card_walk *walk, struct depth_card_place *last)
{
    const double w = nearest_in(walk->relief, walk->before, 0);
    *last = walk->before;
    while (walk->w < nearest_in(walk->relief, walk->here, 0)) {
        int axis;
        const double end = leaving(walk, 0, &axis);
        if (end <= w) {
            walk->w = w;
            return true;
        }
        depth_card_cross(walk, 0, end, axis);
    }
    return false;
}

/* That nothing is beside a card is known. */
static enum depth_card_sight sight_of(const struct depth_card *relief, struct depth_card_place met,
                                      enum depth_card_sight within)
{
    if (depth_card_is_within(relief, met)) {
        return within;
    }
    if (relief->is_endless) {
        return SIGHT_BESIDE;
    }
    return SIGHT_SEEN;
}

/* What is met, and how; walk->w is where. Every turn goes down a level or crosses a border. */
static enum depth_card_sight card_meet(struct depth_card_walk *walk, struct depth_card_place *met)
{
    const struct depth_card *relief = walk->relief;
    int level = 0;
    for (;;) {
        int axis;
        const double end = leaving(walk, level, &axis),
                     nearest = nearest_in(relief, walk->here, level);
        if (end > nearest) {
            depth_card_cross(walk, level, end, axis);
            level += level + 1 < relief->levels ? 1 : 0;
        } else if (level > 0) {
            level--;
        } else if (walk->w >= nearest) {
            walk->w = nearest;
            *met = walk->here;
            return sight_of(relief, *met, SIGHT_SEEN);
        } else if (!is_edge(relief, walk->here, walk->before)) {
            *met = walk->here;
            return sight_of(relief, *met, SIGHT_SEEN);
        } else if (goes_behind(walk, met)) {
            return sight_of(relief, *met, SIGHT_BEHIND);
        }
    }
}

/* The least and the largest w in the squares, at most four of them, that hold two points. */
static void depth_card_bound(const struct depth_card *relief, const long from[AXES],
                             const long to[AXES], double *least, double *most)
{
    int level = 0;
    while (level + 1 < relief->levels &&
           ((labs(to[X] - from[X]) >> level) > 0 || (labs(to[Y] - from[Y]) >> level) > 0)) {
        level++;
    }
    const size_t columns = halved(relief->columns, level), rows = halved(relief->rows, level);
    *least = INFINITY;
    *most = 0;
    for (int i = 0; i < 4; i++) {
        const struct depth_card_place place = {
            {i % 2 == 0 ? from[X] : to[X], i < 2 ? from[Y] : to[Y]}};
        const size_t at =
            (size_t)depth_card_clamped(square_of(place.at[Y], level), rows) * columns +
            (size_t)depth_card_clamped(square_of(place.at[X], level), columns);
        const double far = relief->farthest[level][at], near = relief->nearest[level][at];
        *least = far < *least ? far : *least;
        *most = near > *most ? near : *most;
    }
}

/* Begin in the w of what may be met, not in that of the nearest patch of all. */
static void depth_card_begin_near(struct depth_card_walk *walk)
{
    const struct depth_card *relief = walk->relief;
    double least = relief->is_endless ? relief->farthest[relief->levels - 1][0] : 0, most = walk->w;
    bool narrows = true;
    for (int i = 0; i < 4 && narrows; i++) {
        const double range = most - least;
        long from[AXES], to[AXES];
        for (int k = X; k < AXES; k++) {
            from[k] = depth_card_floor_of(walk->from[k] + walk->per_w[k] * most);
            to[k] = depth_card_floor_of(walk->from[k] + walk->per_w[k] * least);
        }
        double far, near;
        depth_card_bound(relief, from, to, &far, &near);
        least = relief->is_endless && far > least ? far : least;
        most = near < most ? near : most;
        narrows = most - least < 0.5 * range;
    }
    walk->w = most;
    for (int k = X; k < AXES; k++) {
        walk->here.at[k] = depth_card_floor_of(walk->from[k] + walk->per_w[k] * most);
    }
    walk->before = walk->here;
}

struct card_light depth_card_look(const struct depth_card *relief, const struct depth_card_ray *ray,
                                  enum depth_card_sight *sight)
{
    static const double farthest = 1000; /* frames: beyond, nothing is looked for */
    const double scale[AXES] = {(double)relief->columns / relief->card.width,
                                -(double)relief->rows / relief->card.height};
    const double middle[AXES] = {0.5 * (double)relief->columns, 0.5 * (double)relief->rows};
    struct depth_card_walk walk = {.relief = relief, .w = relief->nearest[relief->levels - 1][0]};
    *sight = relief->is_endless ? SIGHT_BESIDE : SIGHT_SEEN;
    for (int k = X; k < AXES; k++) {
        walk.from[k] = middle[k] - scale[k] * relief->frame * ray->slope[k];
        walk.per_w[k] = scale[k] * relief->frame * ray->x[k];
        walk.per_pixel[k] = 1 / walk.per_w[k];
        const double begin = walk.from[k] + walk.per_w[k] * walk.w;
        if (!(fabs(walk.from[k] - middle[k]) < farthest * middle[k] &&
              fabs(begin - middle[k]) < farthest * middle[k])) {
            return (struct card_light){{0, 0, 0}};
        }
    }
    depth_card_begin_near(&walk);
    struct depth_card_place met;
    *sight = card_meet(&walk, &met);
    return *sight == SIGHT_SEEN || relief->hidden == HIDDEN_NEARBY ? light_at(&walk, met, walk.w)
                                                                   : (struct card_light){{0, 0, 0}};
}

void depth_card_range(const struct depth_card *relief, const struct card_part *part, double *least,
                      double *most)
{
    const double columns = (double)relief->columns, rows = (double)relief->rows;
    const double width = relief->card.width, height = relief->card.height;
    const long from[AXES] = {depth_card_floor_of((part->low[X] / width + 0.5) * columns),
                             depth_card_floor_of((0.5 - part->high[Y] / height) * rows)};
    const long to[AXES] = {depth_card_floor_of((part->high[X] / width + 0.5) * columns),
                           depth_card_floor_of((0.5 - part->low[Y] / height) * rows)};
    const bool is_all =
        from[X] >= 0 && from[Y] >= 0 && to[X] < (long)relief->columns && to[Y] < (long)relief->rows;
    depth_card_bound(relief, from, to, least, most);
    *least = relief->is_endless || is_all ? *least : 0;
}
