/* analysis/waves/exit_lines.c - what is clear of parallel lines across an exit pupil. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_lines.h"

#include "base/constants.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 96, LINES = 24, ROUNDS = 30, COARSE_ROUNDS = 10, BREAK_ROUNDS = 18 };

/* So far beyond the rim's polygon samples lie, in sizes of the pupil. */
static const double beyond = 0.03;

/* A line with what ends its spans. */
struct exit_lines_line {
    double t;
    struct exit_spans spans;
    size_t limits[2 * EXIT_SPANS];
};

/* A place between a clear and a dark point of a line. */
struct exit_lines_change {
    double clear, dark;
    size_t line, edge, limit;
};

/* Lines at work. */
struct line_search {
    const struct exit_pupil *pupil;
    struct exit_lines *lines;
    struct arena *arena;
    double size; /* of the pupil along them */
};

static void exit_lines_point_of(const struct exit_lines *lines, double s, double t, double at[2])
{
    for (int k = 0; k < 2; k++) {
        at[k] = s * lines->along[k] + t * lines->across[k];
    }
}

static double along_of(const double direction[2], const double at[2])
{
    return direction[0] * at[0] + direction[1] * at[1];
}

/* Where the polygon of the rim crosses a line, ascending; at most so many. */
static size_t exit_lines_crossings(const struct line_search *seeking, double t, double *places,
                                   size_t most)
{
    const struct exit_pupil *pupil = seeking->pupil;
    const struct exit_lines *lines = seeking->lines;
    size_t count = 0;
    for (size_t i = 0; i < pupil->rim_count && count < most; i++) {
        const double *a = pupil->rim[i], *b = pupil->rim[(i + 1) % pupil->rim_count];
        const double ta = along_of(lines->across, a) - t, tb = along_of(lines->across, b) - t;
        if ((ta <= 0) != (tb <= 0)) {
            const double sa = along_of(lines->along, a), sb = along_of(lines->along, b);
            const double s = sa + (sb - sa) * ta / (ta - tb);
            size_t k = count++;
            for (; k > 0 && places[k - 1] > s; k--) {
                places[k] = places[k - 1];
            }
            places[k] = s;
        }
    }
    return count;
}

/*
 * Changes where the polygon of the rim crosses a line. Points from the middle of each part outwards
 * stand on both sides of its edge; what lies beyond a gap is not looked at.
 *
 * Result    false: they do not, and the line has to be sampled
 */
static bool cross_rim(const struct line_search *seeking, double t, size_t line,
                      struct exit_lines_change *changes, size_t *found)
{
    static const double inside[] = {0.5, 0.08, 0.01, 0.001}, outside[] = {1e-4, 1e-3, 1e-2, 0.03};
    enum { IN = sizeof inside / sizeof inside[0], OUT = sizeof outside / sizeof outside[0] };
    double places[2 * EXIT_SPANS], at[IN + OUT][2], s[IN + OUT];
    const size_t count = exit_lines_crossings(seeking, t, places, 2 * EXIT_SPANS);
    for (size_t i = 0; i < count; i++) {
        const double sign = i % 2 == 0 ? -1 : 1, length = places[i | 1] - places[i & ~(size_t)1];
        size_t limits[IN + OUT], k = 1;
        for (size_t p = 0; p < IN + OUT; p++) {
            s[p] =
                places[i] + sign * (p < IN ? -inside[p] * length : outside[p - IN] * seeking->size);
            exit_lines_point_of(seeking->lines, s[p], t, at[p]);
        }
        exit_pupil_look(seeking->pupil, (const double(*)[2])at, IN + OUT, limits);
        while (k < IN + OUT && limits[k] == EXIT_PUPIL_CLEAR) {
            k++;
        }
        if (limits[0] != EXIT_PUPIL_CLEAR || k == IN + OUT) {
            return false;
        }
        changes[i] = (struct exit_lines_change){s[k - 1], s[k], line, i, limits[k]};
    }
    *found = count;
    return count % 2 == 0;
}

/* Changes along one line between neighbours of its samples. */
static size_t find_changes(const size_t *limits, const double range[2], size_t line,
                           struct exit_lines_change *changes)
{
    size_t count = 0;
    for (size_t i = 0; i + 1 < SAMPLES && count < 2 * EXIT_SPANS; i++) {
        const bool here = limits[i] == EXIT_PUPIL_CLEAR, next = limits[i + 1] == EXIT_PUPIL_CLEAR;
        if (here != next) {
            const double step = (range[1] - range[0]) / (SAMPLES - 1);
            const double s = range[0] + step * (double)i;
            changes[count] =
                (struct exit_lines_change){here ? s : s + step, here ? s + step : s, line, count,
                                           here ? limits[i + 1] : limits[i]};
            count++;
        }
    }
    return count / 2 * 2;
}

static void bisect(const struct line_search *seeking, const struct exit_lines_line *list,
                   struct exit_lines_change *changes, size_t count, int rounds)
{
    const struct arena_mark mark = arena_mark(seeking->arena);
    double(*at)[2] = arena_array(seeking->arena, count, sizeof *at);
    size_t *limits = ARENA_ARRAY(seeking->arena, count, size_t);
    for (int round = 0; round < rounds; round++) {
        for (size_t i = 0; i < count; i++) {
            exit_lines_point_of(seeking->lines, (changes[i].clear + changes[i].dark) / 2,
                                list[changes[i].line].t, at[i]);
        }
        exit_pupil_look(seeking->pupil, (const double(*)[2])at, count, limits);
        for (size_t i = 0; i < count; i++) {
            const double middle = (changes[i].clear + changes[i].dark) / 2;
            if (limits[i] == EXIT_PUPIL_CLEAR) {
                changes[i].clear = middle;
            } else {
                changes[i].dark = middle;
                changes[i].limit = limits[i];
            }
        }
    }
    arena_reset(seeking->arena, mark);
}

/* Changes along one line, from points all along it; they lie a little beyond the rim too. */
static size_t sample_line(const struct line_search *seeking, double t, size_t line,
                          struct exit_lines_change *changes)
{
    double places[EXIT_PUPIL_RIM], at[SAMPLES][2];
    size_t limits[SAMPLES];
    const size_t count = exit_lines_crossings(seeking, t, places, EXIT_PUPIL_RIM);
    if (count == 0) {
        return 0;
    }
    const double more = beyond * seeking->size;
    const double range[2] = {places[0] - more, places[count - 1] + more};
    for (size_t k = 0; k < SAMPLES; k++) {
        const double share = (double)k / (SAMPLES - 1);
        exit_lines_point_of(seeking->lines, range[0] + share * (range[1] - range[0]), t, at[k]);
    }
    exit_pupil_look(seeking->pupil, (const double(*)[2])at, SAMPLES, limits);
    return find_changes(limits, range, line, changes);
}

/* The spans of lines whose t is set. */
static void find_spans(const struct line_search *seeking, struct exit_lines_line *list,
                       size_t count, int rounds)
{
    const struct arena_mark mark = arena_mark(seeking->arena);
    struct exit_lines_change *changes =
        ARENA_ARRAY(seeking->arena, count * 2 * EXIT_SPANS, struct exit_lines_change);
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        size_t changed;
        if (seeking->pupil->is_blocked ||
            !cross_rim(seeking, list[i].t, i, changes + found, &changed)) {
            changed = sample_line(seeking, list[i].t, i, changes + found);
        }
        list[i].spans.count = changed / 2;
        found += changed;
    }
    bisect(seeking, list, changes, found, rounds);
    for (size_t i = 0; i < found; i++) {
        struct exit_lines_line *line = &list[changes[i].line];
        line->spans.edges[changes[i].edge] = changes[i].clear;
        line->limits[changes[i].edge] = changes[i].limit;
    }
    arena_reset(seeking->arena, mark);
}

static bool alike(const struct exit_lines_line *a, const struct exit_lines_line *b)
{
    return a->spans.count == b->spans.count &&
           memcmp(a->limits, b->limits, 2 * a->spans.count * sizeof a->limits[0]) == 0;
}

/* Between lines that are not alike, where they become so. */
static size_t find_breaks(const struct line_search *seeking, const struct exit_lines_line *list,
                          size_t count, double *breaks)
{
    struct exit_lines_line low[LINES], high[LINES], middle[LINES];
    size_t found = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        if (!alike(&list[i], &list[i + 1])) {
            low[found] = list[i];
            high[found++] = list[i + 1];
        }
    }
    if (found >= EXIT_PIECES) {
        found = 0; /* nothing but ties between things that end the pupil alike */
    }
    for (int round = 0; round < BREAK_ROUNDS && found > 0; round++) {
        for (size_t i = 0; i < found; i++) {
            middle[i].t = (low[i].t + high[i].t) / 2;
        }
        find_spans(seeking, middle, found, COARSE_ROUNDS);
        for (size_t i = 0; i < found; i++) {
            if (alike(&middle[i], &low[i])) {
                low[i] = middle[i];
            } else {
                high[i] = middle[i];
            }
        }
    }
    for (size_t i = 0; i < found; i++) {
        breaks[i] = (low[i].t + high[i].t) / 2;
    }
    return found;
}

/* One with as many spans on all of its lines; the most frequent number where rounding differs. */
static void fill_piece(const struct line_search *seeking, double low, double high,
                       struct exit_piece *piece)
{
    struct exit_lines_line list[EXIT_NODES];
    *piece = (struct exit_piece){.low = low, .high = high};
    gauss_rule(EXIT_NODES, piece->nodes, piece->weights);
    for (size_t i = 0; i < EXIT_NODES; i++) {
        const double x = piece->nodes[i];
        list[i].t = (low + high) / 2 + (high - low) / 2 * sin(PI * (x - 0.5));
        piece->weights[i] = (i % 2 == 0 ? 1 : -1) * sqrt(x * (1 - x) * piece->weights[i]);
    }
    find_spans(seeking, list, EXIT_NODES, ROUNDS);
    piece->count = list[EXIT_NODES / 2].spans.count;
    for (size_t i = 0; i < EXIT_NODES; i++) {
        size_t from = i;
        /* a line that differs is too near to an end: its neighbour's */
        while (from != EXIT_NODES / 2 && list[from].spans.count != piece->count) {
            from += from < EXIT_NODES / 2 ? 1 : (size_t)-1;
        }
        memcpy(piece->edges[i], list[from].spans.edges, sizeof piece->edges[i]);
    }
}

/* Are two places the same on either side of 0, as well as breaks are found? */
static bool is_opposite(double low, double high, double size)
{
    return fabs(low + high) <= 1e-5 * size;
}

/* The edges of a line's spans, and those of another one that lies on its other side. */
static bool has_edges_of(const double *edges, const double *others, size_t count, bool along,
                         double size)
{
    bool has = true;
    for (size_t k = 0; k < 2 * count; k++) {
        const double other = along ? others[2 * count - 1 - k] : -others[k];
        has = has && is_opposite(edges[k], other, size);
    }
    return has;
}

static bool is_mirrored_across(const struct exit_lines *lines, double size)
{
    bool is_mirrored = true;
    for (size_t i = 0; i < lines->count && is_mirrored; i++) {
        const struct exit_piece *piece = &lines->pieces[i];
        const struct exit_piece *other = &lines->pieces[lines->count - 1 - i];
        is_mirrored = piece->count == other->count &&
                      is_opposite(piece->low, other->high, piece->high - piece->low) &&
                      is_opposite(piece->high, other->low, piece->high - piece->low);
        for (size_t k = 0; k < EXIT_NODES && is_mirrored; k++) {
            is_mirrored = has_edges_of(piece->edges[k], other->edges[EXIT_NODES - 1 - k],
                                       piece->count, false, size);
        }
    }
    return is_mirrored;
}

static bool is_mirrored_along(const struct exit_lines *lines, double size)
{
    bool is_mirrored = true;
    for (size_t i = 0; i < lines->count; i++) {
        const struct exit_piece *piece = &lines->pieces[i];
        for (size_t k = 0; k < EXIT_NODES && is_mirrored; k++) {
            is_mirrored = has_edges_of(piece->edges[k], piece->edges[k], piece->count, true, size);
        }
    }
    return is_mirrored;
}

void exit_lines_find(const struct exit_pupil *pupil, const double along[2], struct arena *arena,
                     struct exit_lines *lines)
{
    struct exit_lines_line list[LINES];
    double range[2], breaks[LINES + 1];
    *lines = (struct exit_lines){{along[0], along[1]}, {-along[1], along[0]}, .count = 0};
    exit_pupil_range(pupil, along, range);
    const struct line_search seeking = {pupil, lines, arena, range[1] - range[0]};
    exit_pupil_range(pupil, lines->across, range);
    for (size_t i = 0; i < LINES; i++) {
        const double angle = PI * (((double)i + 0.5) / LINES - 0.5);
        list[i].t = (range[0] + range[1]) / 2 + (range[1] - range[0]) / 2 * sin(angle);
    }
    find_spans(&seeking, list, LINES, COARSE_ROUNDS);
    size_t count = find_breaks(&seeking, list, LINES, breaks);
    breaks[count++] = range[1];
    double low = range[0];
    for (size_t i = 0; i < count; low = breaks[i++]) {
        fill_piece(&seeking, low, breaks[i], &lines->pieces[lines->count]);
        lines->count += lines->pieces[lines->count].count > 0;
    }
    /* what mirrors leave of the pupil, of lines along one of its axes */
    const double size = seeking.size;
    for (size_t k = 0; k < 2; k++) {
        if (fabs(lines->along[k]) >= 1) {
            lines->is_mirrored_across =
                pupil->is_mirrored[1 - k] && is_mirrored_across(lines, size);
            lines->is_mirrored_along = pupil->is_mirrored[k] && is_mirrored_along(lines, size);
        }
    }
}

double exit_piece_at(const struct exit_piece *piece, double angle, double *slope,
                     struct exit_spans *spans)
{
    double sum[2 * EXIT_SPANS] = {0}, total = 0;
    const double x = angle / PI + 0.5, half = (piece->high - piece->low) / 2;
    const size_t edges = 2 * piece->count;
    spans->count = piece->count;
    *slope = half * cos(angle);
    const double t = (piece->low + piece->high) / 2 + half * sin(angle);
    for (size_t i = 0; i < EXIT_NODES; i++) {
        const double off = x - piece->nodes[i];
        if (fabs(off) < 1e-14) {
            memcpy(spans->edges, piece->edges[i], sizeof spans->edges);
            return t;
        }
        const double weight = piece->weights[i] / off;
        total += weight;
        for (size_t k = 0; k < edges; k++) {
            sum[k] += weight * piece->edges[i][k];
        }
    }
    for (size_t k = 0; k < edges; k++) {
        spans->edges[k] = sum[k] / total;
    }
    return t;
}
