/* file/polygon.c - polygons as triangles, by cutting off ears. */
/* SPDX-License-Identifier: MIT */
#include "file/polygon.h"

#include "base/constants.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define NONE ((size_t)-1)

enum { CELLS_MOST = 1024 }; /* of the grid, side by side */

struct polygon_point {
    double x, y;
};

/* Corners that do not turn the polygon's way, by where they are. */
struct polygon_grid {
    struct polygon_point low, high;
    size_t cells;  /* along each side */
    size_t *first; /* corner of each cell; NONE: no more */
    size_t *next;  /* of each corner */
};

struct polygon {
    size_t count; /* that are left */
    const struct polygon_point *at;
    size_t *before, *behind;     /* corners next to each other */
    bool *is_cut, *is_waiting;   /* in the queue */
    size_t *queue, head, length; /* corners that may be ears, in a ring */
    size_t room;                 /* of the ring */
    struct polygon_grid grid;
};

static struct polygon_point minus(struct polygon_point a, struct polygon_point b)
{
    return (struct polygon_point){a.x - b.x, a.y - b.y};
}

static double polygon_cross(struct polygon_point a, struct polygon_point b)
{
    return a.x * b.y - a.y * b.x;
}

/* Above 0: c lies to the left of the way from a to b. */
static double side(struct polygon_point a, struct polygon_point b, struct polygon_point c)
{
    return polygon_cross(minus(b, a), minus(c, a));
}

static bool polygon_is_same(struct polygon_point a, struct polygon_point b)
{
    return !(a.x < b.x || a.x > b.x || a.y < b.y || a.y > b.y);
}

/* -------- the plane -------- */

/* From the first corner, whose distance from the origin would take digits. */
static struct vector normal_of(const struct vector *corners, size_t count)
{
    struct vector sum = {0, 0, 0};
    for (size_t i = 1; i + 1 < count; i++) {
        sum = vector_along(sum, 1,
                           vector_cross(vector_minus(corners[i], corners[0]),
                                        vector_minus(corners[i + 1], corners[0])));
    }
    return sum;
}

/* Along an axis, so that the polygon goes round to the left: its numbers stay what they are. */
static void drop(const struct vector *corners, size_t count, struct vector normal,
                 struct polygon_point *at)
{
    const double along[] = {normal.x, normal.y, normal.z};
    int axis = fabs(normal.y) > fabs(normal.z) ? 1 : 2;
    if (fabs(normal.x) > fabs(normal.y) && fabs(normal.x) > fabs(normal.z)) {
        axis = 0;
    }
    for (size_t i = 0; i < count; i++) {
        const double c[] = {corners[i].x, corners[i].y, corners[i].z};
        const double x = c[(axis + 1) % 3], y = c[(axis + 2) % 3];
        at[i] = along[axis] > 0 ? (struct polygon_point){x, y} : (struct polygon_point){y, x};
    }
}

/* Angle by which its sides turn all around, the way back being a turn to the left. */
static double polygon_turn_of(const struct polygon_point *at, size_t count)
{
    struct polygon_point last = {0, 0};
    double turn = 0;
    for (size_t i = 0; i < 2 * count; i++) { /* the first time round finds the last side */
        const struct polygon_point way = minus(at[(i + 1) % count], at[i % count]);
        if (!(fabs(way.x) > 0 || fabs(way.y) > 0)) {
            continue;
        }
        turn = i < count
                   ? 0
                   : turn + atan2(polygon_cross(last, way) + 0.0, last.x * way.x + last.y * way.y);
        last = way;
    }
    return turn;
}

/* -------- corners that may be in the way -------- */

static size_t polygon_cell_of(double x, double low, double high, size_t cells)
{
    const double share = high > low ? (x - low) / (high - low) * (double)cells : 0;
    const size_t cell = share > 0 ? (size_t)share : 0;
    return cell < cells ? cell : cells - 1;
}

static size_t *polygon_first_of(const struct polygon_grid *grid, struct polygon_point at)
{
    const size_t column = polygon_cell_of(at.x, grid->low.x, grid->high.x, grid->cells);
    const size_t row = polygon_cell_of(at.y, grid->low.y, grid->high.y, grid->cells);
    return &grid->first[row * grid->cells + column];
}

static bool polygon_turns_left(const struct polygon *polygon, size_t i)
{
    const struct polygon_point *at = polygon->at;
    return side(at[polygon->before[i]], at[i], at[polygon->behind[i]]) > 0;
}

static void open_grid(struct polygon *polygon, struct arena *arena)
{
    struct polygon_grid *grid = &polygon->grid;
    size_t others = 0;
    grid->low = grid->high = polygon->at[0];
    for (size_t i = 0; i < polygon->count; i++) {
        const struct polygon_point at = polygon->at[i];
        grid->low = (struct polygon_point){fmin(grid->low.x, at.x), fmin(grid->low.y, at.y)};
        grid->high = (struct polygon_point){fmax(grid->high.x, at.x), fmax(grid->high.y, at.y)};
        others += polygon_turns_left(polygon, i) ? 0 : 1;
    }
    grid->cells = (size_t)fmin(1 + sqrt((double)others), CELLS_MOST);
    grid->first = ARENA_ARRAY(arena, grid->cells * grid->cells, size_t);
    grid->next = ARENA_ARRAY(arena, polygon->count, size_t);
    memset(grid->first, 0xff, grid->cells * grid->cells * sizeof grid->first[0]);
    for (size_t i = 0; i < polygon->count; i++) {
        if (!polygon_turns_left(polygon, i)) {
            size_t *first = polygon_first_of(grid, polygon->at[i]);
            grid->next[i] = *first;
            *first = i;
        }
    }
}

/* -------- ears -------- */

/* Does a side of a corner that lies on one of the triangle's go into it? */
static bool goes_in(const struct polygon *polygon, size_t corner, struct polygon_point here,
                    struct polygon_point right, struct polygon_point left)
{
    const size_t ends[2] = {polygon->before[corner], polygon->behind[corner]};
    for (int i = 0; i < 2; i++) {
        const struct polygon_point end = polygon->at[ends[i]];
        if (side(here, right, end) > 0 && side(here, left, end) < 0) {
            return true;
        }
    }
    return false;
}

/* Is another corner in the way of this triangle, which goes round to the left? */
static bool is_in_way(const struct polygon *polygon, size_t corner, const size_t triangle[3])
{
    const struct polygon_point at = polygon->at[corner];
    for (int i = 0; i < 3; i++) {
        if (corner == triangle[i]) {
            return false;
        }
    }
    for (int i = 0; i < 3; i++) {
        const struct polygon_point here = polygon->at[triangle[i]];
        const struct polygon_point next = polygon->at[triangle[(i + 1) % 3]];
        if (polygon_is_same(at, here)) {
            return goes_in(polygon, corner, here, next, polygon->at[triangle[(i + 2) % 3]]);
        }
        if (side(here, next, at) < 0) {
            return false;
        }
    }
    return true;
}

/* Is one of a cell? Those that are cut off, or turn left by now, leave the grid for good. */
static bool is_cell_in_way(struct polygon *polygon, size_t *link, const size_t triangle[3])
{
    while (*link != NONE) {
        const size_t corner = *link;
        if (polygon->is_cut[corner] || polygon_turns_left(polygon, corner)) {
            *link = polygon->grid.next[corner];
        } else if (is_in_way(polygon, corner, triangle)) {
            return true;
        } else {
            link = &polygon->grid.next[corner];
        }
    }
    return false;
}

static bool is_ear(struct polygon *polygon, size_t i)
{
    const size_t triangle[3] = {polygon->before[i], i, polygon->behind[i]};
    const struct polygon_point *at = polygon->at;
    struct polygon_grid *grid = &polygon->grid;
    if (polygon_is_same(at[triangle[0]], at[triangle[2]]) ||
        polygon_is_same(at[i], at[triangle[0]])) {
        return true; /* the polygon goes out and back, or nowhere */
    }
    if (!polygon_turns_left(polygon, i)) {
        return false;
    }
    struct polygon_point low = at[i], high = at[i];
    for (int k = 0; k < 3; k += 2) {
        const struct polygon_point corner = at[triangle[k]];
        low = (struct polygon_point){fmin(low.x, corner.x), fmin(low.y, corner.y)};
        high = (struct polygon_point){fmax(high.x, corner.x), fmax(high.y, corner.y)};
    }
    size_t *begin = polygon_first_of(grid, low);
    const size_t rows = (size_t)(polygon_first_of(grid, high) - begin) / grid->cells;
    const size_t columns =
        (size_t)(polygon_first_of(grid, (struct polygon_point){high.x, low.y}) - begin);
    for (size_t row = 0; row <= rows; row++) {
        for (size_t column = 0; column <= columns; column++) {
            if (is_cell_in_way(polygon, &begin[row * grid->cells + column], triangle)) {
                return false;
            }
        }
    }
    return true;
}

static void wait(struct polygon *polygon, size_t i)
{
    if (!polygon->is_waiting[i]) {
        polygon->is_waiting[i] = true;
        polygon->queue[(polygon->head + polygon->length++) % polygon->room] = i;
    }
}

static void cut_off(struct polygon *polygon, size_t i, size_t triangle[3])
{
    const size_t before = polygon->before[i], behind = polygon->behind[i];
    triangle[0] = before;
    triangle[1] = i;
    triangle[2] = behind;
    polygon->behind[before] = behind;
    polygon->before[behind] = before;
    polygon->is_cut[i] = true;
    polygon->count--;
    wait(polygon, before);
    wait(polygon, behind);
}

/* Corners on the line between their neighbours make no area. Result: false: there is none. */
static bool cut_flat(struct polygon *polygon, size_t start, size_t triangle[3])
{
    const struct polygon_point *at = polygon->at;
    size_t i = start;
    do {
        const double turn = side(at[polygon->before[i]], at[i], at[polygon->behind[i]]);
        if (!(turn > 0 || turn < 0)) {
            cut_off(polygon, i, triangle);
            return true;
        }
        i = polygon->behind[i];
    } while (i != start);
    return false;
}

static bool cut_ears(struct polygon *polygon, size_t (*triangles)[3])
{
    size_t made = 0, last = 0; /* the last: a corner that is left */
    while (polygon->count > 3) {
        if (polygon->length == 0) {
            if (!cut_flat(polygon, last, triangles[made])) {
                return false;
            }
            last = polygon->before[triangles[made++][1]];
            continue;
        }
        const size_t i = polygon->queue[polygon->head];
        polygon->head = (polygon->head + 1) % polygon->room;
        polygon->length--;
        polygon->is_waiting[i] = false;
        if (!polygon->is_cut[i] && is_ear(polygon, i)) {
            last = polygon->before[i];
            cut_off(polygon, i, triangles[made++]);
        }
    }
    const size_t rest[3] = {polygon->before[last], last, polygon->behind[last]};
    memcpy(triangles[made], rest, sizeof rest);
    return !(side(polygon->at[rest[0]], polygon->at[rest[1]], polygon->at[rest[2]]) < 0);
}

/* -------- all of it -------- */

static void cut_fan(size_t count, size_t (*triangles)[3])
{
    for (size_t i = 0; i + 2 < count; i++) {
        triangles[i][0] = 0;
        triangles[i][1] = i + 1;
        triangles[i][2] = i + 2;
    }
}

/* What lies between two corners and the line from one to the other. Result: how many triangles. */
static size_t cut_halves(size_t first, size_t last, size_t (*triangles)[3])
{
    if (last - first < 2) {
        return 0;
    }
    const size_t middle = first + (last - first) / 2;
    triangles[0][0] = first;
    triangles[0][1] = middle;
    triangles[0][2] = last;
    const size_t made = 1 + cut_halves(first, middle, triangles + 1);
    return made + cut_halves(middle, last, triangles + made);
}

static bool cut_concave(const struct polygon_point *at, size_t count, size_t (*triangles)[3],
                        struct arena *arena)
{
    struct polygon polygon = {
        .count = count,
        .at = at,
        .before = ARENA_ARRAY(arena, count, size_t),
        .behind = ARENA_ARRAY(arena, count, size_t),
        .is_cut = ARENA_ARRAY(arena, count, bool),
        .is_waiting = ARENA_ARRAY(arena, count, bool),
        .queue = ARENA_ARRAY(arena, count, size_t),
        .room = count,
    };
    for (size_t i = 0; i < count; i++) {
        polygon.before[i] = i > 0 ? i - 1 : count - 1;
        polygon.behind[i] = i + 1 < count ? i + 1 : 0;
        wait(&polygon, i);
    }
    open_grid(&polygon, arena);
    return cut_ears(&polygon, triangles);
}

static bool is_convex(const struct polygon_point *at, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const size_t next = i + 1 < count ? i + 1 : 0, other = next + 1 < count ? next + 1 : 0;
        if (side(at[i], at[next], at[other]) < 0) {
            return false;
        }
    }
    return true;
}

enum polygon_cut polygon_triangles(const struct vector *corners, size_t count,
                                   size_t (*triangles)[3], struct arena *arena)
{
    const struct vector normal = normal_of(corners, count);
    const double length = vector_length(normal);
    struct polygon_point *at = ARENA_ARRAY(arena, count, struct polygon_point);
    cut_fan(count, triangles);
    if (!(length > 0 && length < (double)INFINITY)) {
        return POLYGON_CROSSED;
    }
    drop(corners, count, normal, at);
    const bool convex = is_convex(at, count);
    if (convex && count <= 4) { /* so few turns to the left are once around */
        return POLYGON_CONVEX;
    }
    if (!(fabs(polygon_turn_of(at, count) - 2 * PI) < 1)) {
        return POLYGON_CROSSED;
    }
    if (convex && count > POLYGON_FAN_MOST) {
        cut_halves(0, count - 1, triangles);
    }
    if (convex) {
        return POLYGON_CONVEX;
    }
    if (!cut_concave(at, count, triangles, arena)) {
        cut_fan(count, triangles);
        return POLYGON_CROSSED;
    }
    return POLYGON_EARS;
}
