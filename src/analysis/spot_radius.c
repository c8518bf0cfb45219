/* analysis/spot_radius.c - the farthest ray of a spot: on the edge of the pupil, or within. */
/* SPDX-License-Identifier: MIT */
#include "analysis/spot_radius.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

/* Directions but for corners, and rings; of what is looked at again about a peak. */
enum { AROUND = 48, MOST = AROUND + STAR_CORNERS, RINGS = 8, FINE = 11, PEAKS = 12 };

/* What parabolas say of the heights of peaks is right to about this share. */
static const double doubtful = 0.02;

/* Twins: peaks as high as each other, on both sides of a symmetry. */
static const double alike = 1e-9;

/* Rays short of the edge are not clipped by rounding; those on it are not clipped at all. */
static const double within = 1 - 1e-9;

/* The pupil at one wavelength: shares of the way from the centre of the star to its edge. */
struct rim {
    const struct bundle_source *source;
    double angles[MOST]; /* ascending */
    double distances[RINGS][MOST];
    size_t count;
};

/* Directions and shares that hold the farthest ray between them. */
struct peak {
    const struct bundle_source *source;
    double low[2], high[2]; /* angle, share */
    double distance;        /* the largest seen */
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

/* Distances of rays at a share of the way to the edge; -1 for those that are lost. */
static void measure(const struct spot_radius_question *question, const struct bundle_source *source,
                    const struct quadrature_rim *edge, double share, struct arena *arena,
                    double *distances)
{
    const struct arena_mark mark = arena_mark(arena);
    const struct spot_plane *plane = question->plane;
    const struct system *system = share < within ? source->system : source->open;
    const double n = system_index_after(system, plane->to - 1);
    const struct rays rays = rays_new(arena, edge->count);
    quadrature_rays_within(source->region, edge, share, arena, &rays);
    rays_trace_part(system, 0, plane->to, &rays, NULL);
    for (size_t i = 0; i < rays.count; i++) {
        const struct ray_block *block = &rays.blocks[i / RAYS_BLOCK];
        double at[2];
        spot_place(plane, block, i % RAYS_BLOCK, n, at);
        bool arrives = ray_block_status(block, i % RAYS_BLOCK) == RAY_OK;
        distances[i] = arrives ? hypot(at[0] - question->about[0], at[1] - question->about[1]) : -1;
    }
    arena_reset(arena, mark);
}

static void set_angles(const struct star *star, struct rim *rim)
{
    rim->count = 0;
    for (size_t i = 0; i < AROUND; i++) {
        const double angle = 2 * PI * (double)i / AROUND, next = angle + 2 * PI / AROUND;
        rim->angles[rim->count++] = angle;
        for (size_t k = 0; k < star->corner_count; k++) {
            double corner = star->corners[k] - 2 * PI * floor(star->corners[k] / (2 * PI));
            if (corner > angle && corner < next) {
                rim->angles[rim->count++] = corner;
            }
        }
    }
}

static void look_around(const struct spot_radius_question *question, struct arena *arena,
                        struct rim *rim)
{
    const struct bundle_question *asked = rim->source->question;
    const bool counts = asked->setup->wavelengths[asked->wavelength].weight > 0;
    const struct star *star = counts ? quadrature_star(rim->source->region, arena) : NULL;
    rim->count = 0;
    if (star == NULL) {
        return;
    }
    set_angles(star, rim);
    const struct quadrature_rim edge =
        quadrature_edge(rim->source->region, rim->angles, rim->count, arena);
    for (size_t ring = 0; ring < RINGS; ring++) {
        measure(question, rim->source, &edge, (double)(ring + 1) / RINGS, arena,
                rim->distances[ring]);
    }
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
static bool is_peak(const struct rim *rim, size_t ring, size_t i)
{
    const size_t last = (i + rim->count - 1) % rim->count, next = (i + 1) % rim->count;
    const double here = rim->distances[ring][i];
    const size_t low = ring > 0 ? ring - 1 : 0, high = ring + 1 < RINGS ? ring + 1 : ring;
    bool peak = here >= 0;
    for (size_t k = low; k <= high; k++) {
        const double *row = rim->distances[k];
        peak = peak && row[last] <= here && row[i] <= here && row[next] <= here;
    }
    return peak;
}

static struct peak peak_of(const struct rim *rim, size_t ring, size_t i)
{
    const size_t last = (i + rim->count - 1) % rim->count, next = (i + 1) % rim->count;
    const double *row = rim->distances[ring], here = row[i];
    const bool at_edge = ring + 1 == RINGS;
    const size_t middle = at_edge ? ring - 1 : ring;
    double along = 0;
    if (ring > 0) {
        /* of the outermost three: beyond the middle one it rises to the edge, or to before it */
        const double low = rim->distances[middle - 1][i], mid = rim->distances[middle][i];
        along = mid + rise_of(low, mid, rim->distances[middle + 1][i], 1) - here;
    }
    return (struct peak){
        .source = rim->source,
        .low = {rim->angles[last] - (i == 0 ? 2 * PI : 0), (double)ring / RINGS},
        .high = {rim->angles[next] + (next == 0 ? 2 * PI : 0), fmin((double)(ring + 2) / RINGS, 1)},
        .distance = here,
        .height = here + fmax(along, 0) + rise_of(row[last], here, row[next], 1)};
}

/* Enter a peak among the highest, which descend. */
static void offer(const struct peak *peak, struct peak *peaks, size_t *count)
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

static size_t find_peaks(const struct rim *rims, size_t count, struct peak *peaks)
{
    size_t found = 0;
    for (size_t k = 0; k < count * RINGS; k++) {
        const struct rim *rim = &rims[k / RINGS];
        const size_t ring = k % RINGS;
        for (size_t i = 0; i < rim->count; i++) {
            if (is_peak(rim, ring, i)) {
                const struct peak peak = peak_of(rim, ring, i);
                offer(&peak, peaks, &found);
            }
        }
    }
    return found;
}

/* One finer look; the surroundings shrink about the farthest ray. */
static void look_closer(const struct spot_radius_question *question, struct peak *peak,
                        struct arena *arena)
{
    double angles[FINE], distances[FINE], step[2], best[2];
    for (int k = 0; k < 2; k++) {
        step[k] = (peak->high[k] - peak->low[k]) / (FINE - 1);
        best[k] = (peak->low[k] + peak->high[k]) / 2;
    }
    for (size_t i = 0; i < FINE; i++) {
        angles[i] = peak->low[0] + (double)i * step[0];
    }
    const struct quadrature_rim edge = quadrature_edge(peak->source->region, angles, FINE, arena);
    for (size_t ring = 0; ring < FINE; ring++) {
        const double share =
            ring + 1 < FINE ? peak->low[1] + (double)ring * step[1] : peak->high[1];
        measure(question, peak->source, &edge, share, arena, distances);
        for (size_t i = 0; i < FINE; i++) {
            if (distances[i] >= peak->distance) {
                peak->distance = distances[i];
                best[0] = angles[i];
                best[1] = share;
            }
        }
    }
    for (int k = 0; k < 2; k++) {
        peak->low[k] = best[k] - step[k];
        peak->high[k] = best[k] + step[k];
    }
    peak->low[1] = fmax(peak->low[1], 0);
    peak->high[1] = fmin(peak->high[1], 1);
}

/* Until it stands; returns what the last look changed. */
static double climb(const struct spot_radius_question *question, struct peak *peak,
                    struct arena *arena)
{
    enum { TURNS = 12 };
    double change = INFINITY;
    for (int turn = 0; turn < TURNS && change > 1e-12 * peak->distance; turn++) {
        const struct arena_mark mark = arena_mark(arena);
        const double before = peak->distance;
        look_closer(question, peak, arena);
        /* a first look may hit the very ray that was best, and be no nearer to the peak */
        change = turn > 1 ? peak->distance - before : (double)INFINITY;
        arena_reset(arena, mark);
    }
    return change;
}

double spot_radius_find(const struct spot_radius_question *question, struct arena *arena,
                        double *error)
{
    const struct arena_mark mark = arena_mark(arena);
    struct rim *rims = ARENA_ARRAY(arena, question->count, struct rim);
    struct peak peaks[PEAKS];
    double farthest = 0, last = 0;
    for (size_t g = 0; g < question->count; g++) {
        rims[g].source = &question->sources[g];
        look_around(question, arena, &rims[g]);
    }
    const size_t count = find_peaks(rims, question->count, peaks);
    *error = 0;
    for (size_t k = 0; k < count && peaks[k].height >= (1 - doubtful) * farthest; k++) {
        const double height = peaks[k].height;
        if (fabs(height - last) <= alike * height) {
            continue;
        }
        const double change = climb(question, &peaks[k], arena);
        last = height;
        if (peaks[k].distance > farthest) {
            farthest = peaks[k].distance;
            *error = change;
        }
    }
    arena_reset(arena, mark);
    return farthest;
}
