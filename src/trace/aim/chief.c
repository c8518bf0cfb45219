/* trace/aim/chief.c - bracketing the ray through the centre of the stop. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/chief.h"

#include "optics/paraxial.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

/* Where to look, in coordinates of the beam. */
struct chief_region {
    double guess[2]; /* the paraxial chief ray */
    double low[2], high[2];
    double slope;  /* paraxial, of the height in the stop */
    double up[2];  /* direction in the stop of the meridional plane */
    double finest; /* what is called the same place, mm */
};

void chief_to_stop(const struct aim *aim, size_t count)
{
    const struct system *system = aim->system;
    struct ray_block *block = aim->work.blocks;
    const struct rays rays = {block, count};
    rays_trace_part(system, 0, system_place(system, system->stop) + 1, &rays, NULL);
    if (system->lens->surfaces[system->stop].decentre == NULL) {
        return;
    }
    for (size_t i = 0; i < count; i++) {
        double point[3] = {block->x[i], block->y[i], block->z[i]};
        system_to_own(system, system->stop, point);
        block->x[i] = point[0];
        block->y[i] = point[1];
        block->z[i] = point[2];
    }
}

void chief_trace(const struct aim *aim, const double (*at)[2], size_t count)
{
    beam_fill(&aim->beam, at, count, aim->work.blocks);
    chief_to_stop(aim, count);
}

/* How many surfaces a ray passes on its way to the stop. */
static size_t places_to_stop(const struct aim *aim)
{
    return system_place(aim->system, aim->system->stop) + 1;
}

/* The same as work: an asphere is met in steps, and looked for on the way where these go astray. */
static size_t work_to_stop(const struct aim *aim)
{
    enum { ASPHERE = 8 };
    const struct lens *lens = aim->system->lens;
    size_t work = places_to_stop(aim);
    for (size_t i = 0; i <= aim->system->stop; i++) {
        work += lens->surfaces[i].coefficients != 0 ? ASPHERE - 1 : 0;
    }
    return work;
}

static bool lane_arrived(const struct aim *aim, size_t lane)
{
    return ray_block_status(aim->work.blocks, lane) == RAY_OK;
}

/* The four rays about some of many, h beside them; those that all arrive are no longer pending. */
static size_t try_slopes(const struct aim *aim, const double (*at)[2], double h, size_t count,
                         size_t *pending, double (*slopes)[4], bool *found)
{
    enum { TOGETHER = RAYS_BLOCK / 4 };
    size_t left = 0;
    for (size_t done = 0; done < count; done += TOGETHER) {
        const size_t here = count - done < TOGETHER ? count - done : TOGETHER;
        double rays[RAYS_BLOCK][2];
        for (size_t k = 0; k < 4 * here; k++) {
            const double *place = at[pending[done + k / 4]];
            const double beside = k % 2 == 0 ? h : -h;
            rays[k][0] = place[0] + (k % 4 < 2 ? beside : 0);
            rays[k][1] = place[1] + (k % 4 < 2 ? 0 : beside);
        }
        chief_trace(aim, (const double(*)[2])rays, 4 * here);
        for (size_t k = 0; k < here; k++) {
            const size_t i = pending[done + k];
            if (lane_arrived(aim, 4 * k) && lane_arrived(aim, 4 * k + 1) &&
                lane_arrived(aim, 4 * k + 2) && lane_arrived(aim, 4 * k + 3)) {
                /* slopes between the four rays about one, from a lane on */
                const struct ray_block *block = aim->work.blocks;
                const size_t lane = 4 * k;
                double *slope = slopes[i];
                slope[0] = (block->x[lane] - block->x[lane + 1]) / (2 * h);
                slope[1] = (block->x[lane + 2] - block->x[lane + 3]) / (2 * h);
                slope[2] = (block->y[lane] - block->y[lane + 1]) / (2 * h);
                slope[3] = (block->y[lane + 2] - block->y[lane + 3]) / (2 * h);
                found[i] = slopes[i][0] * slopes[i][3] != slopes[i][1] * slopes[i][2];
            } else {
                pending[left++] = i;
            }
        }
    }
    return left;
}

void chief_slopes(const struct aim *aim, const double (*at)[2], size_t count, double (*slopes)[4],
                  bool *found)
{
    const double size = fabs(aim->slope[3]) > 0 ? aim->stop_radius / fabs(aim->slope[3]) : 1;
    size_t pending[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        pending[i] = i;
        found[i] = false;
    }
    for (double h = 1e-3 * size; h > 1e-9 * size && count > 0; h /= 8) {
        count = try_slopes(aim, at, h, count, pending, slopes, found);
    }
}

bool chief_slope(const struct aim *aim, const double at[2], double slope[4])
{
    bool found;
    chief_slopes(aim, (const double(*)[2])at, 1, (double(*)[4])slope, &found);
    return found;
}

/* Widen the region by a point of the first surface as the beam sees it. */
static void chief_region_include(struct chief_region *region, const struct beam *beam,
                                 const double point[3])
{
    double place[2];
    beam_place(beam, point, place);
    for (int i = 0; i < 2; i++) {
        if (isfinite(place[i])) {
            region->low[i] = fmin(region->low[i], place[i]);
            region->high[i] = fmax(region->high[i], place[i]);
        }
    }
}

/* The first stated clear aperture bounds the beam; without one the paraxial pupil has to do. */
static void include_surface(struct chief_region *region, const struct aim *aim)
{
    const struct lens *lens = aim->system->lens;
    const struct surface *surface = &lens->surfaces[0];
    double slope = fabs(region->slope), pupil = slope > 0 ? aim->stop_radius / slope : 0;
    double radius = surface->has_diameter ? surface->diameter.value.hi / 2
                                          : 2 * (pupil + hypot(region->guess[0], region->guess[1]));
    for (int i = -16; i <= 16; i++) {
        double r = radius * i / 16, z = surface_sag(surface, r);
        /* a wall so steep that its rim lies far away would widen the region beyond all use */
        if (fabs(z) <= 100 * radius) {
            chief_region_include(region, &aim->beam,
                                 (double[3]){r * region->up[0], r * region->up[1], z});
            chief_region_include(region, &aim->beam,
                                 (double[3]){-r * region->up[1], r * region->up[0], z});
        }
    }
    double margin = 0.02 * radius + pupil;
    for (int i = 0; i < 2; i++) {
        region->low[i] -= margin;
        region->high[i] += margin;
    }
}

static bool chief_region_open(const struct aim *aim, struct arena *arena,
                              struct chief_region *region, struct error *error)
{
    const struct system *system = aim->system;
    const struct beam *beam = &aim->beam;
    struct paraxial_system paraxial;
    struct paraxial_trace trace;
    if (!paraxial_compile(system->lens, system->wavelength, SECTION_Y, arena, &paraxial, error)) {
        return false;
    }
    paraxial_trace(&paraxial, &trace);
    double a = trace.front.a.hi, b = trace.front.b.hi, z = beam->n * b / a;
    *region = (struct chief_region){
        .slope = a + (isinf(beam->distance) ? 0 : b * beam->n / beam->distance),
        .up = {-beam->across[0][1], beam->across[0][0]},
    };
    /* a telecentric lens has its entrance pupil at infinity: far enough */
    z = fabs(z) <= 1e12 ? z : copysign(1e12, z);
    beam_place(beam, (double[3]){0, 0, z}, region->guess);
    for (int i = 0; i < 2; i++) {
        region->guess[i] = isfinite(region->guess[i]) ? region->guess[i] : 0;
        region->low[i] = region->high[i] = region->guess[i];
    }
    include_surface(region, aim);
    region->finest = 1e-16 * (region->high[1] - region->low[1]);
    return true;
}

/* The height in the stop of one lane, along the meridional plane. */
static double height_in_stop(const struct aim *aim, const struct chief_region *region, size_t lane)
{
    const struct ray_block *block = aim->work.blocks;
    return block->x[lane] * region->up[0] + block->y[lane] * region->up[1];
}

/* Two rays with the centre of the stop between them. */
struct chief_bracket {
    double low, high, distance;
    bool found;
};

/* Is this bracket better than the last? Apertures first, then nearness to the paraxial ray. */
static void bracket_offer(const struct aim *aim, const struct chief_region *region, double low,
                          double high, bool compares_apertures, struct chief_bracket *bracket)
{
    double middle = (low + high) / 2;
    double distance = fabs(middle - region->guess[1]);
    if (compares_apertures) {
        /* how far outside of the clear apertures a ray runs before the stop: the largest r/a */
        const struct system *system = aim->system;
        const struct ray ray = beam_ray(&aim->beam, aim->chief[0], middle);
        const struct rays rays = {aim->work.blocks, 1};
        double worst = 0;
        rays_set(&rays, 0, aim->beam.n, &ray);
        for (size_t place = 0; place <= system_place(system, system->stop); place++) {
            const struct surface *surface = &system->lens->surfaces[system_surface(system, place)];
            rays_trace_part(system, place, place + 1, &rays, NULL);
            if (surface->has_diameter) {
                const struct ray_block *block = aim->work.blocks;
                worst =
                    fmax(worst, hypot(block->x[0], block->y[0]) / (surface->diameter.value.hi / 2));
            }
        }
        double beyond = fmax(worst - 1, 0);
        distance += 1e6 * beyond * (region->high[1] - region->low[1]);
    }
    if (!bracket->found || distance < bracket->distance) {
        *bracket = (struct chief_bracket){low, high, distance, true};
    }
}

struct chief_scan {
    size_t samples;
    bool any_slope; /* the image of the stop may be upside down */
};

/* What became of the rays that did not arrive. */
struct losses {
    size_t count[256];
    enum ray_status status[256];
};

/* A ray that misses an asphere was looked for all along its way there, see trace/kernel/search.h:
   it takes as long as so many surfaces. */
enum { MISSED_ASPHERE = 64 };

static void note_loss(struct aim *aim, size_t lane, struct losses *losses)
{
    const size_t surface = ray_block_surface(aim->work.blocks, lane);
    const enum ray_status status = ray_block_status(aim->work.blocks, lane);
    if (surface < 256) {
        losses->count[surface]++;
        losses->status[surface] = status;
    }
    if (status == RAY_MISS && aim->system->lens->surfaces[surface - 1].coefficients != 0) {
        aim->sought += MISSED_ASPHERE;
    }
}

/* Places where the height changes its sign, up to 64. */
struct crossings {
    double at[64][2];
    size_t count;
};

/* Sample the meridional line; returns how many brackets it has. With `any_slope` turned ones do
   where there are no others. */
static size_t scan_line(struct aim *aim, const struct chief_region *region,
                        const struct chief_scan *scan, struct chief_bracket *bracket,
                        struct losses *losses)
{
    double at[RAYS_BLOCK][2], last = NAN, last_height = NAN;
    double low = region->low[1], step = (region->high[1] - low) / (double)(scan->samples - 1);
    struct crossings found = {.count = 0}, others = {.count = 0};
    aim->sought += scan->samples * work_to_stop(aim);
    for (size_t done = 0; done < scan->samples; done += RAYS_BLOCK) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            at[i][0] = aim->chief[0];
            at[i][1] = low + (double)(done + i) * step;
        }
        chief_trace(aim, (const double(*)[2])at, RAYS_BLOCK);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            bool here = lane_arrived(aim, i);
            double y = here ? height_in_stop(aim, region, i) : (double)NAN;
            bool crosses = (last_height <= 0 && y > 0) || (last_height >= 0 && y < 0);
            bool turned = (y > last_height) != (region->slope > 0);
            if (crosses && (!turned || scan->any_slope)) {
                struct crossings *all = turned ? &others : &found;
                if (all->count < 64) {
                    all->at[all->count][0] = last;
                    all->at[all->count++][1] = at[i][1];
                }
            }
            if (!here) {
                note_loss(aim, i, losses);
            }
            last = at[i][1];
            last_height = y;
        }
    }
    const struct crossings *use = found.count > 0 ? &found : &others;
    for (size_t i = 0; i < use->count; i++) {
        bracket_offer(aim, region, use->at[i][0], use->at[i][1], use->count > 1, bracket);
    }
    return use->count;
}

/* Close a bracket, 127 parts at a time. */
static bool close_bracket(struct aim *aim, const struct chief_region *region,
                          struct chief_bracket *bracket)
{
    double at[RAYS_BLOCK][2];
    for (int turn = 0; turn < 20; turn++) {
        double width = bracket->high - bracket->low;
        double least = fmax(region->finest, 4e-16 * fabs(bracket->low));
        if (width <= least) {
            break;
        }
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            at[i][0] = aim->chief[0];
            at[i][1] = bracket->low + width * ((double)i / (RAYS_BLOCK - 1));
        }
        at[RAYS_BLOCK - 1][1] = bracket->high;
        chief_trace(aim, (const double(*)[2])at, RAYS_BLOCK);
        double last = NAN;
        size_t root = 0;
        for (size_t i = 0; i < RAYS_BLOCK && root == 0; i++) {
            double y = lane_arrived(aim, i) ? height_in_stop(aim, region, i) : (double)NAN;
            root = (last <= 0 && y > 0) || (last >= 0 && y < 0) ? i : 0;
            last = y;
        }
        if (root == 0) {
            return false; /* the rays between are lost */
        }
        bracket->low = at[root - 1][1];
        bracket->high = at[root][1];
    }
    aim->chief[1] = (bracket->low + bracket->high) / 2;
    return true;
}

static bool chief_refuse(struct aim *aim, const struct losses *losses, struct error *error)
{
    size_t most = 0;
    for (size_t i = 1; i < 256; i++) {
        most = losses->count[i] > losses->count[most] ? i : most;
    }
    bool lost = losses->count[most] > 0;
    aim->lost = lost ? losses->status[most] : RAY_NOT_CONVERGED;
    aim->lost_surface = lost ? most : aim->system->stop + 1;
    const char *words[] = {[RAY_OK] = "passes by the centre of the stop at",
                           [RAY_MISS] = "misses",
                           [RAY_TOTAL_REFLECTION] = "is totally reflected at",
                           [RAY_CLIPPED] = "is clipped at",
                           [RAY_NOT_CONVERGED] = "is lost numerically at"};
    if (!lost) {
        return fail(error, ERROR_DOMAIN,
                    "no ray of this field goes through the centre of the stop");
    }
    return fail(error, ERROR_DOMAIN,
                "no ray of this field reaches the centre of the stop (surface %zu): it %s surface "
                "%zu",
                aim->system->stop + 1, words[losses->status[most]], most);
}

/*
 * Coarse to fine; the pupil of a fisheye may be a thousandth of its front element. The finest scan
 * is for lenses of which it does not take longer than an answer may: 2 million ray-surfaces.
 */
static bool find_meridional(struct aim *aim, struct chief_region *region, struct error *error)
{
    enum { MOST_WORK = 2000000 };
    static const struct chief_scan all[] = {{128, false}, {2048, false}, {32768, true}};
    static const struct chief_scan coarse[] = {{128, false}, {2048, true}};
    const bool fine = all[2].samples * places_to_stop(aim) <= MOST_WORK;
    const struct chief_scan *scans = fine ? all : coarse;
    const size_t kinds = fine ? 3 : 2;
    struct losses losses = {0};
    aim->chief[0] = region->guess[0];
    for (size_t wide = 0; wide < 3; wide++) {
        for (size_t i = 0; i < kinds; i++) {
            struct chief_bracket bracket = {.found = false};
            if (scan_line(aim, region, &scans[i], &bracket, &losses) > 0 &&
                close_bracket(aim, region, &bracket)) {
                return true;
            }
        }
        double width = region->high[1] - region->low[1];
        region->low[1] -= width;
        region->high[1] += width;
    }
    return chief_refuse(aim, &losses, error);
}

/* The sample of a grid that comes nearest to the centre of the stop. */
static bool scan_grid(struct aim *aim, const struct chief_region *region, size_t side, double at[2],
                      struct losses *losses)
{
    const struct ray_block *block = aim->work.blocks;
    double best = INFINITY, rays[RAYS_BLOCK][2];
    aim->sought += side * side * work_to_stop(aim);
    for (size_t done = 0; done < side * side; done += RAYS_BLOCK) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            size_t cell[2] = {(done + i) % side, (done + i) / side};
            for (int k = 0; k < 2; k++) {
                double part = ((double)cell[k] + 0.5) / (double)side;
                rays[i][k] = region->low[k] + part * (region->high[k] - region->low[k]);
            }
        }
        chief_trace(aim, (const double(*)[2])rays, RAYS_BLOCK);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            double square = block->x[i] * block->x[i] + block->y[i] * block->y[i];
            if (!lane_arrived(aim, i)) {
                note_loss(aim, i, losses);
            } else if (square < best) {
                best = square;
                at[0] = rays[i][0];
                at[1] = rays[i][1];
            }
        }
    }
    return isfinite(best);
}

bool chief_newton(const struct aim *aim, double at[2])
{
    const struct ray_block *block = aim->work.blocks;
    double miss = INFINITY;
    for (int step = 0; step < 60; step++) {
        double slope[4], x, y, scale = 1;
        if (!chief_slope(aim, at, slope)) {
            return false;
        }
        chief_trace(aim, (const double(*)[2])at, 1);
        x = block->x[0];
        y = block->y[0];
        miss = hypot(x, y);
        double det = slope[0] * slope[3] - slope[1] * slope[2];
        double move[2] = {(slope[1] * y - slope[3] * x) / det, (slope[2] * x - slope[0] * y) / det};
        bool closer = false;
        for (int half = 0; half < 30 && !closer && miss > 0; half++, scale /= 2) {
            double next[1][2] = {{at[0] + scale * move[0], at[1] + scale * move[1]}};
            chief_trace(aim, (const double(*)[2])next, 1);
            closer = lane_arrived(aim, 0) && hypot(block->x[0], block->y[0]) < miss;
            if (closer) {
                at[0] = next[0][0];
                at[1] = next[0][1];
            }
        }
        if (!closer) {
            break;
        }
    }
    return miss <= 1e-9 * aim->stop_radius;
}

/*
 * Grids from coarse to fine. One with four times the rays takes four times as long, of which rays
 * that miss aspheres may be the most: no finer one than an answer may take.
 */
static bool find_anywhere(struct aim *aim, struct chief_region *region, struct error *error)
{
    enum { MOST_WORK = 4000000 };
    struct losses losses = {0};
    size_t last = 0; /* work of the grid before */
    for (size_t side = 16; side <= 512 && aim->sought + 4 * last <= MOST_WORK; side *= 2) {
        const size_t before = aim->sought;
        double at[2];
        if (scan_grid(aim, region, side, at, &losses) && chief_newton(aim, at)) {
            aim->chief[0] = at[0];
            aim->chief[1] = at[1];
            return true;
        }
        last = aim->sought - before;
    }
    return chief_refuse(aim, &losses, error);
}

bool chief_find(struct aim *aim, struct arena *arena, struct error *error)
{
    struct chief_region region;
    const double *axis = aim->beam.axis;
    if (!chief_region_open(aim, arena, &region, error)) {
        return false;
    }
    aim->slope[3] = region.slope;
    if (!lens_is_round(aim->system->lens)) {
        if (!find_anywhere(aim, &region, error)) {
            return false;
        }
    } else if (axis[0] == 0 && axis[1] == 0 && axis[2] > 0) {
        aim->chief[0] = aim->chief[1] = 0;
    } else if (!find_meridional(aim, &region, error)) {
        return false;
    }
    double slope[4];
    if (!chief_slope(aim, aim->chief, slope)) {
        aim->lost = RAY_NOT_CONVERGED;
        aim->lost_surface = aim->system->stop + 1;
        return fail(error, ERROR_DOMAIN, "the rays about the chief ray are lost");
    }
    for (int i = 0; i < 4; i++) {
        aim->slope[i] = slope[i];
    }
    return true;
}

bool chief_find_near(struct aim *aim, const struct aim_near *near)
{
    enum { STEPS = 12 };
    const bool is_round = lens_is_round(aim->system->lens);
    const double *first = near->slope, sheet = first[0] * first[3] - first[1] * first[2];
    const struct ray_block *block = aim->work.blocks;
    double at[2] = {is_round ? 0 : near->chief[0], near->chief[1]}, slope[4], before = INFINITY;
    memcpy(slope, first, sizeof slope);
    for (int step = 0; step < STEPS; step++) {
        chief_trace(aim, (const double(*)[2])at, 1);
        const double miss[2] = {block->x[0], block->y[0]}, here = hypot(miss[0], miss[1]);
        if (!lane_arrived(aim, 0) || !(here < before)) {
            break;
        }
        memcpy(aim->chief, at, sizeof aim->chief);
        /* slopes that far beside are those of another place */
        if (here > 1e-3 * before && !chief_slope(aim, at, slope)) {
            return false;
        }
        before = here;
        /* one step towards the centre of the stop; along b alone the height along `up` counts */
        const double up[2] = {-aim->beam.across[0][1], aim->beam.across[0][0]};
        if (is_round) {
            at[1] -= (miss[0] * up[0] + miss[1] * up[1]) / (slope[1] * up[0] + slope[3] * up[1]);
        } else {
            const double det = slope[0] * slope[3] - slope[1] * slope[2];
            at[0] -= (slope[3] * miss[0] - slope[1] * miss[1]) / det;
            at[1] -= (slope[0] * miss[1] - slope[2] * miss[0]) / det;
        }
    }
    return before <= 1e-12 * aim->stop_radius && chief_slope(aim, aim->chief, aim->slope) &&
           sheet * (aim->slope[0] * aim->slope[3] - aim->slope[1] * aim->slope[2]) > 0;
}

double chief_rounding(const struct aim *aim)
{
    const double *m = aim->slope;
    const double slope = sqrt(fabs(m[0] * m[3] - m[1] * m[2]));
    return fmax(1e-12 * aim->stop_radius, 1e-14 * hypot(aim->chief[0], aim->chief[1]) * slope);
}
