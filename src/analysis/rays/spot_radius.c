/* analysis/rays/spot_radius.c - the farthest ray of a spot: on the edge of the pupil, or within. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot_radius.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

/* Directions but for corners, and rings. */
enum { AROUND = 48, MOST = AROUND + PUPIL_BOUNDARY_CORNERS, RINGS = 8, PEAKS = 12 };

/* The same of what is looked at again about a peak; directions with corners. */
enum { FINE = 9, WIDE = FINE + 3 };

/* What parabolas say of the heights of peaks is right to about this share; a closer look: this. */
static const double doubtful = 0.02, hopeful = 0.002;

/* Twins: peaks as high as each other, on both sides of a symmetry. */
static const double alike = 1e-9;

/* What edges are met to, which the farthest ray often lies on, as a share of its distance. */
static const double met = 1e-8;

/* Shares of the way back from an edge: see graze_error and follow_grazing. */
static const double beside = 1e-12, apart = 1e-10;

/* What distances change over the latter where no rays graze, as a share of them. */
static const double steep = 1e-7;

/* Rays short of the edge are not clipped by rounding; those on it are not clipped at all. */
static const double within = 1 - 1e-9;

/* The pupil at one wavelength: shares of the way from the centre to the boundary. */
struct spot_radius_rim {
    const struct bundle_source *source;
    double angles[MOST];            /* ascending */
    double distances[RINGS * MOST]; /* ring after ring */
    size_t count;
    bool is_half; /* from 0 to half a turn: the other half mirrors it */
};

/* The direction beside the i-th on one side of it, or its mirror image. */
static size_t previous_of(const struct spot_radius_rim *rim, size_t i)
{
    if (i > 0) {
        return i - 1;
    }
    if (rim->is_half) {
        return 1;
    }
    return rim->count - 1;
}

static size_t next_of(const struct spot_radius_rim *rim, size_t i)
{
    if (i + 1 < rim->count) {
        return i + 1;
    }
    if (rim->is_half) {
        return rim->count - 2;
    }
    return 0;
}

/* Its angle, below or above that one. */
static double angle_before(const struct spot_radius_rim *rim, size_t i)
{
    const double angle = rim->angles[previous_of(rim, i)];
    if (i > 0) {
        return angle;
    }
    if (rim->is_half) {
        return -angle;
    }
    return angle - 2 * PI;
}

static const double *ring_of(const struct spot_radius_rim *rim, size_t ring)
{
    return rim->distances + ring * rim->count;
}

/* Directions and shares that hold the farthest ray between them. */
struct peak {
    const struct bundle_source *source;
    double low[2], high[2]; /* angle, share */
    double distance;        /* the largest seen */
    double at[2];           /* where the last look found it: angle, share */
    double height;          /* about, by parabolas */
};

void spot_place(const struct spot_plane *plane, const struct ray_block *block, size_t lane,
                double n, double at[2])
{
    if (!plane->is_angular) {
        at[0] = block->x[lane] - plane->origin[0];
        at[1] = block->y[lane] - plane->origin[1];
        return;
    }
    for (int i = 0; i < 2; i++) {
        const double *axis = plane->across[i];
        at[i] =
            (block->p[lane] * axis[0] + block->q[lane] * axis[1] + block->r[lane] * axis[2]) / n;
    }
}

/*
 * Distances of rays at shares of the way to an edge, ring after ring; -1 for those that are lost.
 */
static void measure_with(const struct spot_radius_question *question,
                         const struct bundle_source *source, const struct system *system,
                         const struct quadrature_rim *edge, const double *shares, size_t rings,
                         struct arena *arena, double *distances)
{
    const struct arena_mark mark = arena_mark(arena);
    const struct spot_plane *plane = question->plane;
    const double n = system_index_after(system, plane->to - 1);
    const struct rays rays = rays_room(arena, rings * edge->count);
    quadrature_rays_within(source->region, edge, shares, rings, &rays);
    rays_trace_part(system, 0, plane->to, &rays, NULL);
    for (size_t i = 0; i < rays.count; i++) {
        const struct ray_block *block = &rays.blocks[i / RAYS_BLOCK];
        double at[2];
        spot_place(plane, block, i % RAYS_BLOCK, n, at);
        const double x = at[0] - question->about[0], y = at[1] - question->about[1];
        bool arrives = ray_block_status(block, i % RAYS_BLOCK) == RAY_OK;
        distances[i] = arrives ? sqrt(x * x + y * y) : -1;
    }
    arena_reset(arena, mark);
}

/*
 * What distances short of an edge come to there, where rays graze a surface: they go as the root of
 * the way to the edge, and a polynomial of it through four rays says so. Edges of rays that are
 * lost are found to 1e-13 alone, which is far off in a root.
 */
static void follow_grazing(const struct spot_radius_question *question,
                           const struct bundle_source *source, const struct quadrature_rim *edge,
                           struct arena *arena, double *distances)
{
    enum { ROOTS = 4, COUNT = ROOTS + 1 };
    static const double cubic[ROOTS] = {-1, 4, -6, 4};
    const size_t wide = edge->count;
    double shares[COUNT];
    double *d = arena_buffer_array(arena, COUNT * wide, sizeof *d);
    for (int i = 0; i < ROOTS; i++) {
        shares[i] = 1 - (ROOTS - i) * (ROOTS - i) * apart;
    }
    shares[ROOTS] = 1 - beside;
    measure_with(question, source, source->open, edge, shares, COUNT, arena, d);
    for (size_t i = 0; i < wide; i++) {
        double limit = 0;
        const double nearest = d[ROOTS * wide + i];
        for (int k = 0; k < ROOTS; k++) {
            limit = d[(size_t)k * wide + i] >= 0 ? limit + cubic[k] * d[(size_t)k * wide + i] : NAN;
        }
        if (nearest >= 0 && limit - nearest > met * limit) {
            distances[i] = limit;
        } else if (distances[i] < 0) {
            distances[i] = nearest;
        }
    }
}

/* Distances on the edge itself. */
static void measure_edge(const struct spot_radius_question *question,
                         const struct bundle_source *source, const struct quadrature_rim *edge,
                         double last, struct arena *arena, double *distances)
{
    const struct arena_mark mark = arena_mark(arena);
    const size_t wide = edge->count;
    const double share = 1 - apart;
    double *before = arena_buffer_array(arena, wide, sizeof *before);
    bool grazes = false;
    measure_with(question, source, source->open, edge, &last, 1, arena, distances);
    measure_with(question, source, source->open, edge, &share, 1, arena, before);
    for (size_t i = 0; i < wide; i++) {
        grazes = grazes || (before[i] >= 0 && !(distances[i] - before[i] <= steep * before[i])) ||
                 distances[i] < 0;
    }
    if (grazes) {
        follow_grazing(question, source, edge, arena, distances);
    }
    arena_reset(arena, mark);
}

static void spot_radius_measure(const struct spot_radius_question *question,
                                const struct bundle_source *source,
                                const struct quadrature_rim *edge, const double *shares,
                                size_t rings, struct arena *arena, double *distances)
{
    const bool has_edge = !(shares[rings - 1] < within);
    const size_t inner = has_edge ? rings - 1 : rings;
    if (inner > 0) {
        measure_with(question, source, source->system, edge, shares, inner, arena, distances);
    }
    if (has_edge) {
        measure_edge(question, source, edge, shares[inner], arena, distances + inner * edge->count);
    }
}

static void spot_radius_look_around(const struct spot_radius_question *question,
                                    struct arena *arena, struct spot_radius_rim *rim)
{
    const struct bundle_question *asked = rim->source->question;
    const bool counts = asked->setup->wavelengths[asked->wavelength].weight > 0;
    const struct pupil_boundary *boundary =
        counts ? quadrature_boundary(rim->source->region, arena) : NULL;
    rim->count = 0;
    if (boundary == NULL) {
        return;
    }
    /* Does the image mirror itself as the pupil does? */
    const struct spot_plane *plane = question->plane;
    rim->is_half = rim->source->region->margins.is_mirrored && boundary->frame.centre[0] == 0 &&
                   plane->origin[0] == 0 && question->about[0] == 0 && plane->across[0][1] == 0 &&
                   plane->across[0][2] == 0 && plane->across[1][0] == 0;
    for (size_t i = 0; i < (rim->is_half ? AROUND / 2 : AROUND); i++) {
        const double angle = 2 * PI * (double)i / AROUND, next = angle + 2 * PI / AROUND;
        rim->angles[rim->count++] = angle;
        for (size_t k = 0; k < boundary->corner_count; k++) {
            double corner = boundary->corners[k] - 2 * PI * floor(boundary->corners[k] / (2 * PI));
            if (corner > angle && corner < next) {
                rim->angles[rim->count++] = corner;
            }
        }
    }
    if (rim->is_half) {
        rim->angles[rim->count++] = PI;
    }
    const struct quadrature_rim edge =
        quadrature_edge(rim->source->region, rim->angles, rim->count, NULL, 0, arena);
    double shares[RINGS];
    for (size_t ring = 0; ring < RINGS; ring++) {
        shares[ring] = (double)(ring + 1) / RINGS;
    }
    spot_radius_measure(question, rim->source, &edge, shares, RINGS, arena, rim->distances);
}

/* -------- peaks -------- */

/* How much higher a parabola through three values is within `reach` of the middle one. */
static double rise_of(double before, double here, double after, double reach)
{
    const double slope = (after - before) / 2, bend = before - 2 * here + after;
    const bool peaks = bend < 0 && fabs(slope) <= -bend * reach;
    return before >= 0 && after >= 0 && peaks ? -slope * slope / (2 * bend) : 0;
}

/* No neighbour is farther off. */
static bool is_peak(const struct spot_radius_rim *rim, size_t ring, size_t i)
{
    const size_t last = previous_of(rim, i), next = next_of(rim, i);
    const double here = ring_of(rim, ring)[i];
    const size_t low = ring > 0 ? ring - 1 : 0, high = ring + 1 < RINGS ? ring + 1 : ring;
    bool peak = here >= 0;
    for (size_t k = low; k <= high; k++) {
        const double *row = ring_of(rim, k);
        peak = peak && row[last] <= here && row[i] <= here && row[next] <= here;
    }
    return peak;
}

/* A look that is a peak: its surroundings, and how high it may rise between the looks. */
static struct peak peak_of(const struct spot_radius_rim *rim, size_t ring, size_t i)
{
    const size_t last = previous_of(rim, i), next = next_of(rim, i);
    const double *row = ring_of(rim, ring), here = row[i];
    const size_t middle = ring + 1 == RINGS ? ring - 1 : ring;
    double along = 0, after = rim->angles[next];
    if (ring > 0) {
        /* of the outermost three: beyond the middle one it rises to the edge, or to before it */
        const double low = ring_of(rim, middle - 1)[i], mid = ring_of(rim, middle)[i];
        along = mid + rise_of(low, mid, ring_of(rim, middle + 1)[i], 1) - here;
    }
    if (i + 1 == rim->count) { /* behind the last: the first, a turn on; of half a rim, mirrored */
        after = 2 * PI + (rim->is_half ? -after : after);
    }
    return (struct peak){.source = rim->source,
                         .low = {angle_before(rim, i), (double)ring / RINGS},
                         .high = {after, fmin((double)(ring + 2) / RINGS, 1)},
                         .distance = here,
                         .height = here + fmax(along, 0) + rise_of(row[last], here, row[next], 1)};
}

/* Enter a peak among the highest, which descend. */
static void spot_radius_offer(const struct peak *peak, struct peak *peaks, size_t *count)
{
    size_t at = *count;
    while (at > 0 && peaks[at - 1].height < peak->height) {
        at--;
    }
    if (at == PEAKS) {
        return;
    }
    *count += *count < PEAKS;
    for (size_t k = *count - 1; k > at; k--) {
        peaks[k] = peaks[k - 1];
    }
    peaks[at] = *peak;
}

static size_t find_peaks(const struct spot_radius_rim *rims, size_t count, struct peak *peaks)
{
    size_t found = 0;
    for (size_t k = 0; k < count * RINGS; k++) {
        const struct spot_radius_rim *rim = &rims[k / RINGS];
        const size_t ring = k % RINGS;
        for (size_t i = 0; i < rim->count; i++) {
            if (is_peak(rim, ring, i)) {
                const struct peak peak = peak_of(rim, ring, i);
                spot_radius_offer(&peak, peaks, &found);
            }
        }
    }
    return found;
}

/* -------- the way up -------- */

/* Lines of directions and rings across the surroundings of a peak; those of before, for edges. */
struct spot_radius_grid {
    double angles[WIDE], shares[FINE], radii[WIDE];
    double distances[FINE * WIDE];
    size_t wide;
    size_t best[2]; /* in distances: direction, ring */
    bool is_known;  /* has it been filled before? */
};

/* The distances on a grid; the farthest of them. */
static void spot_radius_fill_grid(const struct spot_radius_question *question,
                                  const struct peak *peak, const struct spot_radius_grid *before,
                                  struct arena *arena, struct spot_radius_grid *grid)
{
    double near[WIDE], slack = 0;
    if (before->is_known) {
        const double step = (before->angles[before->wide - 1] - before->angles[0]) / (FINE - 1);
        /* the edge is as good as straight between the lines of before */
        for (size_t j = 0, k = 1; j < grid->wide; j++) {
            while (k + 1 < before->wide && before->angles[k] < grid->angles[j]) {
                k++;
            }
            const double low = before->angles[k - 1], width = before->angles[k] - low;
            const double share = width > 0 ? (grid->angles[j] - low) / width : 0;
            near[j] = before->radii[k - 1] + share * (before->radii[k] - before->radii[k - 1]);
        }
        /* a chord lies off an arc by an eighth of its square */
        slack = fmin(0.03, fmax(step * step, 1e-6));
    }
    const struct quadrature_rim edge =
        quadrature_edge(peak->source->region, grid->angles, grid->wide,
                        before->is_known ? near : NULL, slack, arena);
    for (size_t i = 0; i < grid->wide; i++) {
        grid->radii[i] = edge.radii[i];
    }
    grid->is_known = true;
    grid->best[0] = grid->wide / 2;
    grid->best[1] = FINE / 2;
    spot_radius_measure(question, peak->source, &edge, grid->shares, FINE, arena, grid->distances);
    for (size_t i = 0; i < FINE * grid->wide; i++) {
        if (grid->distances[i] >= grid->distances[grid->best[1] * grid->wide + grid->best[0]]) {
            grid->best[0] = i % grid->wide;
            grid->best[1] = i / grid->wide;
        }
    }
}

/* Is the farthest ray on the last line of directions (k = 0) or rings, and pupil beyond it? */
static bool is_at_end(const struct spot_radius_grid *grid, int k)
{
    const size_t best = grid->best[k], last = (k == 0 ? grid->wide : FINE) - 1;
    return (best == 0 || best == last) &&
           (k == 0 || (grid->shares[best] > 0 && grid->shares[best] < 1));
}

/*
 * Where to look next, along directions (k = 0) or rings: about the vertex of the parabola through
 * the farthest ray and its neighbours, as wide as a share of the step between them; no closer than
 * now where `wide`. Result: how much farther off rays there may be.
 */
static double spot_radius_narrow(const struct spot_radius_grid *grid, int k, double share,
                                 bool wide, struct peak *peak)
{
    const double *lines = k == 0 ? grid->angles : grid->shares;
    const size_t count = k == 0 ? grid->wide : FINE, stride = k == 0 ? 1 : grid->wide;
    const size_t best = grid->best[k], low = best > 0 ? best - 1 : 0;
    const size_t high = best + 1 < count ? best + 1 : best;
    const double *here = &grid->distances[grid->best[1] * grid->wide + grid->best[0]];
    const double whole = lines[count - 1] - lines[0];
    double middle = lines[best], rise = 0, half = lines[high] - lines[low];
    if (low < best && high > best) {
        const double at[3] = {lines[low], lines[best], lines[high]};
        const double f[3] = {*(here - stride), *here, *(here + stride)};
        /* Where a parabola through three values peaks, and by how much above the middle one. */
        const double left = (f[1] - f[0]) / (at[1] - at[0]),
                     right = (f[2] - f[1]) / (at[2] - at[1]);
        const double bend = (right - left) / (at[2] - at[0]);
        const double slope = left + bend * (at[1] - at[0]), x = at[1] - slope / (2 * bend);
        const bool peaks = f[0] >= 0 && f[2] >= 0 && bend < 0 && x > at[0] && x < at[2];
        rise = peaks ? -slope * slope / (4 * bend) : 0;
        middle = peaks ? x : at[1];
        half = share * fmax(at[2] - at[1], at[1] - at[0]);
    }
    if (wide) {
        half = fmin(is_at_end(grid, k) ? whole : whole / 2, PI);
    }
    peak->low[k] = middle - half;
    peak->high[k] = middle + half;
    return rise;
}

/*
 * Until it stands; returns what the last look changed. Given up where it is sure to stay below what
 * is known.
 */
static double climb(const struct spot_radius_question *question, double farthest, struct peak *peak,
                    struct arena *arena)
{
    enum { TURNS = 24 };
    static const double shares[] = {1, 0.15, 0.02};
    const struct pupil_boundary *boundary = peak->source->region->boundary;
    struct spot_radius_grid grids[2];
    double change = 0, before = peak->distance;
    bool stands = false;
    grids[0].is_known = grids[1].is_known = false;
    for (int turn = 0; turn < TURNS && !stands; turn++) {
        const struct arena_mark mark = arena_mark(arena);
        const double share = shares[turn < 2 ? turn : 2];
        struct spot_radius_grid *grid = &grids[turn % 2];
        /* Equal steps, and the first corners within, where peaks may be sharp. */
        grid->wide = 0;
        for (size_t i = 0; i < FINE; i++) {
            const double part = (double)i / (FINE - 1);
            grid->angles[grid->wide++] = peak->low[0] + part * (peak->high[0] - peak->low[0]);
            grid->shares[i] =
                i + 1 < FINE ? peak->low[1] + part * (peak->high[1] - peak->low[1]) : peak->high[1];
        }
        for (size_t k = 0; k < boundary->corner_count && grid->wide < WIDE; k++) {
            const double turns = ceil((peak->low[0] - boundary->corners[k]) / (2 * PI));
            const double corner = boundary->corners[k] + 2 * PI * turns;
            if (corner < peak->high[0]) {
                size_t at = grid->wide++;
                for (; at > 0 && grid->angles[at - 1] > corner; at--) {
                    grid->angles[at] = grid->angles[at - 1];
                }
                grid->angles[at] = corner;
            }
        }
        spot_radius_fill_grid(question, peak, &grids[1 - turn % 2], arena, grid);
        const double here = grid->distances[grid->best[1] * grid->wide + grid->best[0]];
        const bool wide = is_at_end(grid, 0) || is_at_end(grid, 1);
        const double rise = spot_radius_narrow(grid, 0, share, wide, peak) +
                            spot_radius_narrow(grid, 1, share, wide, peak);
        peak->low[1] = fmax(peak->low[1], 0);
        peak->high[1] = fmin(peak->high[1], 1);
        peak->distance = fmax(peak->distance, here);
        peak->at[0] = grid->angles[grid->best[0]];
        peak->at[1] = grid->shares[grid->best[1]];
        arena_reset(arena, mark);
        if (turn == 0 && !wide && peak->distance + 2 * rise < (1 - hopeful) * farthest) {
            break;
        }
        /* a first look may hit the very ray that was best, and be no nearer to the peak */
        change = fabs(here - before);
        stands = turn > 1 && !wide && change <= 1e-12 * peak->distance;
        before = here;
    }
    return change;
}

/*
 * How much farther rays may come between an edge that was found and the true one: edges of rays
 * that are lost are found to 1e-13, and a ray ten times that within falls short by more than that
 * one does.
 */
static double graze_error(const struct spot_radius_question *question, const struct peak *peak,
                          struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const double share = 1 - beside;
    double distance = 0;
    if (peak->at[1] < within) {
        return 0;
    }
    const struct quadrature_rim edge =
        quadrature_edge(peak->source->region, peak->at, 1, NULL, 0, arena);
    measure_with(question, peak->source, peak->source->open, &edge, &share, 1, arena, &distance);
    arena_reset(arena, mark);
    return distance >= 0 ? fmax(peak->distance - distance, 0) : 0;
}

double spot_radius_find(const struct spot_radius_question *question, struct arena *arena,
                        double *error)
{
    const struct arena_mark mark = arena_mark(arena);
    struct spot_radius_rim *rims = arena_buffer_array(arena, question->count, sizeof *rims);
    struct peak peaks[PEAKS];
    double farthest = 0, last = 0;
    for (size_t g = 0; g < question->count; g++) {
        rims[g].source = &question->sources[g];
        spot_radius_look_around(question, arena, &rims[g]);
    }
    const size_t count = find_peaks(rims, question->count, peaks);
    *error = 0;
    for (size_t k = 0; k < count && peaks[k].height >= (1 - doubtful) * farthest; k++) {
        const double height = peaks[k].height;
        if (fabs(height - last) <= alike * height) {
            continue;
        }
        const double change = climb(question, farthest, &peaks[k], arena);
        last = height;
        if (peaks[k].distance > farthest) {
            *error = change + graze_error(question, &peaks[k], arena);
            farthest = peaks[k].distance;
        }
    }
    *error += met * farthest;
    arena_reset(arena, mark);
    return farthest;
}
