/* draw/contours.c - contour lines of a map, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/contours.h"

#include "base/arena.h"
#include "draw/svg.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* No edge. */
#define NO_EDGE SIZE_MAX

/*
 * The lines as a graph: a crossing of an edge of the grid leads through the cells on both its sides
 * to two others. Edge 2 k runs from corner k to the right, edge 2 k + 1 upwards.
 */
struct contour_graph {
    const struct contour_map *map;
    double value;
    size_t (*links)[2];
    double *x, *y; /* room for the line that is followed */
};

static double corner(const struct contour_graph *graph, size_t i)
{
    return graph->map->values[i] - graph->value;
}

static void contour_join(struct contour_graph *graph, size_t a, size_t b)
{
    graph->links[a][graph->links[a][0] != NO_EDGE] = b;
    graph->links[b][graph->links[b][0] != NO_EDGE] = a;
}

/* Join the crossings of the cell whose lower left corner is i. */
static void contour_add_cell(struct contour_graph *graph, size_t i)
{
    const size_t size = graph->map->size;
    const size_t corners[4] = {i, i + 1, i + size + 1, i + size};
    const size_t edges[4] = {2 * i, 2 * (i + 1) + 1, 2 * (i + size), 2 * i + 1};
    size_t crossed[4], count = 0;
    double sum = 0;
    for (size_t k = 0; k < 4; k++) {
        const double here = corner(graph, corners[k]), next = corner(graph, corners[(k + 1) % 4]);
        sum += here;
        if ((here < 0) != (next < 0)) {
            crossed[count++] = edges[k];
        }
    }
    if (isnan(sum) || count == 0) {
        return;
    }
    if (count == 2) {
        contour_join(graph, crossed[0], crossed[1]);
        return;
    }
    /* of a saddle the line goes about the corners that differ from the middle */
    const size_t first = (corner(graph, corners[0]) < 0) != (sum < 0) ? 3 : 0;
    contour_join(graph, crossed[first], crossed[(first + 1) % 4]);
    contour_join(graph, crossed[(first + 2) % 4], crossed[(first + 3) % 4]);
}

/* Where the line crosses an edge, px. */
static void contour_place(const struct contour_graph *graph, size_t edge, double *x, double *y)
{
    const struct contour_map *map = graph->map;
    const size_t at = edge / 2, next = edge % 2 == 0 ? at + 1 : at + map->size;
    const double low = corner(graph, at), part = low / (low - corner(graph, next));
    const double step = map->side / (double)(map->size - 1);
    *x = map->x + step * ((double)(at % map->size) + (edge % 2 == 0 ? part : 0));
    *y = map->y + map->side - step * ((double)(at / map->size) + (edge % 2 == 0 ? 0 : part));
}

/* Follow a line from a crossing, taking it off the graph, and draw it. */
static void contour_follow(struct contour_graph *graph, size_t start, struct svg *svg)
{
    size_t count = 0, edge = start;
    while (edge != NO_EDGE) {
        contour_place(graph, edge, &graph->x[count], &graph->y[count]);
        count++;
        size_t *links = graph->links[edge];
        const size_t next = links[0] != NO_EDGE ? links[0] : links[1];
        if (next != NO_EDGE) { /* nobody comes back this way */
            links[links[0] != next] = NO_EDGE;
            size_t *back = graph->links[next];
            back[back[0] != edge] = NO_EDGE;
        }
        edge = next;
    }
    svg_polyline(svg, graph->x, graph->y, count);
}

void contours_draw(const struct contour_map *map, double value, struct svg *svg)
{
    const size_t size = map->size, edges = 2 * size * size;
    struct contour_graph graph = {.map = map,
                                  .value = value,
                                  .links = arena_array(svg->arena, edges, sizeof *graph.links),
                                  .x = ARENA_ARRAY(svg->arena, edges + 1, double),
                                  .y = ARENA_ARRAY(svg->arena, edges + 1, double)};
    for (size_t i = 0; i < edges; i++) {
        graph.links[i][0] = graph.links[i][1] = NO_EDGE;
    }
    for (size_t row = 0; row + 1 < size; row++) {
        for (size_t column = 0; column + 1 < size; column++) {
            contour_add_cell(&graph, row * size + column);
        }
    }
    /* those with ends first, then what is closed */
    for (int closed = 0; closed < 2; closed++) {
        for (size_t i = 0; i < edges; i++) {
            const int degree = (graph.links[i][0] != NO_EDGE) + (graph.links[i][1] != NO_EDGE);
            if (degree == 1 + closed) {
                contour_follow(&graph, i, svg);
            }
        }
    }
}
