/* analysis/image/psf.c - diffraction point spread functions. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf.h"

#include "analysis/image/psf_light.h"
#include "analysis/image/psf_radius.h"

#include <math.h>

enum { SLOPES = 33 };

/* Of what the waves resolve, a pixel's side; of the spread of rays, half the image. */
static const double fine = 0.25, roomy = 1.1;

/* What rounding leaves of a symmetry, pixels. */
static const double noise = 1e-8;

/* Sums of slopes along clear parts of lines, where rays meet the image, from the reference, mm. */
struct slopes {
    double farthest, moment, energy;
};

/*
 * From one point of a part to the next; the edge lies about half a step beyond its ends, and is
 * steeper, as the steps next to it say.
 */
static void slopes_add_part(struct slopes *slopes, const double *waves, const double *amplitudes,
                            size_t count, size_t stride, double unit)
{
    double slope = 0, before = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        const size_t here = i * stride, next = here + stride;
        const double energy = amplitudes[here] * amplitudes[next];
        before = slope;
        slope = (waves[next] - waves[here]) * unit;
        slopes->farthest = fmax(slopes->farthest, fabs(slope));
        slopes->moment += energy * slope;
        slopes->energy += energy;
        if (count > 2 && (i == 1 || i + 2 == count)) {
            const bool is_first = i == 1;
            const double end = is_first ? before : slope, inner = is_first ? slope : before;
            const double rim = 0.5 * pow(amplitudes[is_first ? 0 : next], 2);
            slopes->moment += rim * (end + 0.75 * (end - inner));
            slopes->energy += rim;
        }
    }
}

/*
 * How far rays go from the reference at most, and where the centroid of their light is: the slope
 * of W along lines of a grid within the pupil, mm.
 */
static double find_spread(const struct exit_pupil *pupil, struct arena *arena, double centroid[2])
{
    const struct arena_mark mark = arena_mark(arena);
    enum { COUNT = SLOPES * SLOPES };
    double(*at)[2] = arena_array(arena, COUNT, sizeof *at);
    double *waves = ARENA_ARRAY(arena, COUNT, double);
    double *amplitudes = ARENA_ARRAY(arena, COUNT, double), farthest = 0;
    size_t *limits = ARENA_ARRAY(arena, COUNT, size_t);
    for (size_t i = 0; i < COUNT; i++) {
        for (int k = 0; k < 2; k++) {
            const double place = (double)(k == 0 ? i % SLOPES : i / SLOPES);
            at[i][k] = pupil->middle[k] + pupil->half[k] * (2 * place / (SLOPES - 1) - 1);
        }
    }
    bool *meets = ARENA_ARRAY(arena, COUNT, bool);
    exit_pupil_look(pupil, (const double(*)[2])at, COUNT, limits);
    exit_pupil_meets(pupil, (const double(*)[2])at, COUNT, meets);
    exit_pupil_values(pupil, (const double(*)[2])at, COUNT, waves, amplitudes);
    for (int k = 0; k < 2; k++) {
        const size_t stride = k == 0 ? 1 : SLOPES, across = k == 0 ? SLOPES : 1;
        const double unit = (SLOPES - 1) / (2 * pupil->half[k] * pupil->n * pupil->waves);
        struct slopes slopes = {0, 0, 0};
        for (size_t line = 0; line < SLOPES; line++) {
            for (size_t i = 0, clear = 0; i <= SLOPES; i++) {
                const size_t here = line * across + i * stride;
                if (i < SLOPES && limits[here] == EXIT_PUPIL_CLEAR && meets[here]) {
                    clear++;
                    continue;
                }
                const size_t first = here - clear * stride;
                slopes_add_part(&slopes, &waves[first], &amplitudes[first], clear, stride, unit);
                clear = 0;
            }
        }
        farthest = fmax(farthest, slopes.farthest);
        centroid[k] = slopes.energy > 0 ? slopes.moment / slopes.energy : 0;
    }
    arena_reset(arena, mark);
    return 1.15 * farthest; /* steeper at the edge itself */
}

/* -------- what the pixels say -------- */

/* Pixels from the top to this height, at most so many steps away; NaN: not within them. */
static double way_down(const struct psf *psf, size_t top, double height, size_t steps, size_t step)
{
    for (size_t i = 0; i < steps; i++) {
        const double here = psf->values[top + i * step];
        const double next = psf->values[top + (i + 1) * step];
        if (next < height) {
            return (double)i + (here - height) / (here - next);
        }
    }
    return NAN;
}

static void find_peak(struct psf *psf)
{
    const size_t size = psf->size;
    size_t top = 0;
    for (size_t i = 0; i < size * size; i++) {
        /* of peaks that are equal but for rounding, mirror images, the first */
        top = psf->values[i] > psf->values[top] * (1 + 1e-10) ? i : top;
    }
    psf->peak = psf->values[top];
    for (int k = 0; k < 2; k++) {
        const size_t place = k == 0 ? top % size : top / size, step = k == 0 ? 1 : size;
        double off = 0, crest = psf->values[top]; /* of its line */
        if (place > 0 && place + 1 < size) {
            const double y[3] = {psf->values[top - step], psf->values[top],
                                 psf->values[top + step]};
            /* The top of a parabola through three values, from -1/2 to 1/2, and how high it is. */
            const double bend = y[0] - 2 * y[1] + y[2], slope = (y[2] - y[0]) / 2;
            off = bend < 0 ? fmax(-0.5, fmin(0.5, -slope / bend)) : 0;
            crest += off * slope + off * off * bend / 2;
            psf->peak += crest - y[1];
            off = fabs(off) > noise ? off : 0;
        }
        psf->peak_at[k] = ((double)place + off - (double)(size / 2)) * psf->pitch;
        psf->width[k] = (way_down(psf, top, crest / 2, place, 0 - step) +
                         way_down(psf, top, crest / 2, size - 1 - place, step)) *
                        psf->pitch;
    }
}

/* Where the centroid of the pixels is that lie at most so far from the middle, pixels. Of an even
   number the first have no counterpart on the other side: they move no centroid. */
static void psf_find_centroid(const struct psf *psf, size_t reach, double at[2])
{
    const size_t size = psf->size, half = size / 2, first = half - reach;
    const size_t end = half + reach + 1;
    double sum = 0;
    at[0] = at[1] = 0;
    for (size_t y = first; y < end; y++) {
        for (size_t x = first; x < end; x++) {
            const double light = psf->values[y * size + x];
            sum += light;
            at[0] += light * ((double)x - (double)half);
            at[1] += light * ((double)y - (double)half);
        }
    }
    at[0] /= sum;
    at[1] /= sum;
}

/*
 * From the centroid of the pixels to that of all light at most: to that of its rays, which a coarse
 * grid has, or as far again as the outer half of the image moves it; whichever is farther.
 *
 * Given     missing  share of the light beyond the sides. If it falls as the cube it lies half as
 *                    far out again, and half of it may be on one side, by rays all of it
 *           moved    from the centroid of the inner half to that of all pixels, mm
 */
static void psf_find_centroid_error(struct psf *psf, double missing, const double rays[2],
                                    const double moved[2])
{
    const double reach = fmax(missing, 0) * (double)((psf->size - 1) / 2) * psf->pitch;
    const double to_rays[2] = {1.25 * (rays[0] - psf->centroid[0]),
                               1.25 * (rays[1] - psf->centroid[1])};
    const double far_rays = hypot(to_rays[0], to_rays[1]), far_moved = hypot(moved[0], moved[1]);
    const double by_rays = fmin(far_rays, 1.5 * reach), by_moved = fmin(far_moved, 0.5 * reach);
    for (int k = 0; k < 2; k++) {
        psf->centroid_error[k] = 0;
        if (by_rays > by_moved) {
            psf->centroid_error[k] = by_rays / far_rays * to_rays[k];
        } else if (by_moved > 0) {
            psf->centroid_error[k] = by_moved / far_moved * moved[k];
        }
    }
}

/* total: of all light, in values of pixels; rays: the centroid of all light by its rays, mm. */
static void psf_measure(struct psf *psf, double total, const double rays[2], struct arena *arena)
{
    const size_t size = psf->size, reach = (size - 1) / 2;
    double sum = 0, all[2], moved[2];
    for (size_t i = 0; i < size * size; i++) {
        sum += psf->values[i];
    }
    psf_find_centroid(psf, reach, all);
    psf_find_centroid(psf, reach / 2, moved);
    for (int k = 0; k < 2; k++) {
        psf->centroid[k] = fabs(all[k]) > noise ? all[k] * psf->pitch : 0;
        moved[k] = (all[k] - moved[k]) * psf->pitch;
    }
    psf->inside = psf->pitch < psf->finest ? sum / total : (double)NAN;
    psf_find_centroid_error(psf, 1 - psf->inside, rays, moved);
    psf->radius80 = psf->radius80_error = NAN;
    if (psf->inside > 0.8) {
        psf_radius_find(psf, 0.8 * total, arena);
    }
    find_peak(psf);
}

/* -------- by rays -------- */

/* Of one wavelength: some for each pixel of an image of the usual size. */
enum { RAYS = 1 << 16 };

/* Where the rays of one wavelength meet the image plane, from the reference. */
struct psf_rays {
    double (*at)[2], *weights; /* mm; these add up to 1 */
    size_t count;
    double farthest; /* of them, along x or y, mm */
};

static bool psf_rays_trace(const struct exit_pupil *pupil, struct arena *arena,
                           struct psf_rays *rays, struct error *error)
{
    const struct wave_light *light = pupil->light;
    const double *centre = pupil->reference->centre;
    struct bundle bundle;
    light->source.region->in_beam = false;
    if (!bundle_trace(&light->source, RAYS, light->system->places, arena, &bundle, error)) {
        return false;
    }
    double sum = 0;
    *rays = (struct psf_rays){.at = arena_array(arena, bundle.count, sizeof *rays->at),
                              .weights = ARENA_ARRAY(arena, bundle.count, double)};
    for (size_t i = 0; i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        if (ray_block_status(block, lane) != RAY_OK) {
            continue;
        }
        double *at = rays->at[rays->count];
        at[0] = block->x[lane] - centre[0];
        at[1] = block->y[lane] - centre[1];
        rays->farthest = fmax(rays->farthest, fmax(fabs(at[0]), fabs(at[1])));
        rays->weights[rays->count++] = bundle.points[i].weight;
        sum += bundle.points[i].weight;
    }
    for (size_t i = 0; i < rays->count; i++) {
        rays->weights[i] /= sum;
    }
    return true;
}

/* -------- the whole -------- */

/* Sums over wavelengths. */
struct psf_sums {
    double *values, perfect, total;
};

/* The pixels of one wavelength. */
static struct psf_plane psf_plane_of(const struct psf_question *question, const struct psf *psf,
                                     const struct exit_pupil *pupil, double spread,
                                     struct arena *arena)
{
    return (struct psf_plane){.pupil = pupil,
                              .size = psf->size,
                              .pitch = psf->pitch,
                              .spread = question->is_perfect ? 0 : spread,
                              .is_perfect = question->is_perfect,
                              .unit = psf->is_angular ? "mrad" : "um",
                              .threads = question->threads,
                              .arena = arena};
}

static bool psf_is_dark(const struct exit_pupils *pupils, size_t g)
{
    return !(pupils->lights.list[g].weight > 0);
}

static bool psf_add_waves(const struct psf_question *question, const struct exit_pupils *pupils,
                          const double *spreads, const struct psf *psf, struct psf_sums *sums,
                          struct arena *arena, struct error *error)
{
    static psf_way *const ways[] = {
        [PSF_PLANE] = psf_by_plane, [PSF_FFT] = psf_by_fft, [PSF_HUYGENS] = psf_by_huygens};
    const size_t count = psf->size * psf->size;
    for (size_t g = 0; g < pupils->lights.count; g++) {
        const struct exit_pupil *pupil = &pupils->list[g];
        const double waves = pupil->n * pupil->waves;
        const double weight = exit_pupil_weight(pupil) * waves * waves;
        const struct arena_mark mark = arena_mark(arena);
        struct psf_plane plane = psf_plane_of(question, psf, pupil, spreads[g], arena);
        if (psf_is_dark(pupils, g)) {
            continue;
        }
        plane.re = ARENA_ARRAY(arena, count, double);
        plane.im = ARENA_ARRAY(arena, count, double);
        if (!ways[psf->method](&plane, error)) {
            return false;
        }
        for (size_t i = 0; i < count; i++) {
            sums->values[i] += weight * (plane.re[i] * plane.re[i] + plane.im[i] * plane.im[i]);
        }
        sums->perfect += weight * plane.perfect * plane.perfect;
        sums->total += exit_pupil_weight(pupil) * pupil->energy;
        arena_reset(arena, mark);
    }
    return true;
}

/* Without a pitch: the image has room for all rays. No light lies between pixels. */
static bool psf_add_rays(const struct psf_question *question, const struct exit_pupils *pupils,
                         struct psf *psf, struct psf_sums *sums, struct arena *arena,
                         struct error *error)
{
    struct psf_rays *rays = ARENA_ARRAY(arena, pupils->lights.count, struct psf_rays);
    double farthest = 0;
    if (psf->is_angular) {
        return fail(error, ERROR_DOMAIN,
                    "rays: the image lies infinitely far away, where there are waves only");
    }
    for (size_t g = 0; g < pupils->lights.count; g++) {
        if (psf_is_dark(pupils, g)) {
            continue;
        }
        if (!psf_rays_trace(&pupils->list[g], arena, &rays[g], error)) {
            return false;
        }
        farthest = fmax(farthest, rays[g].farthest);
    }
    psf->pitch = isnan(question->pitch) ? 2 * roomy * farthest / (double)psf->size : psf->pitch;
    psf->finest = INFINITY;
    for (size_t g = 0; g < pupils->lights.count; g++) {
        const struct exit_pupil *pupil = &pupils->list[g];
        const struct psf_plane plane = psf_plane_of(question, psf, pupil, 0, arena);
        const double weight = exit_pupil_weight(pupil), waves = pupil->n * pupil->waves;
        double perfect;
        if (psf_is_dark(pupils, g)) {
            continue;
        }
        struct psf_plane still = plane; /* W = 0 at the reference: no phase turns */
        struct psf_points points;
        still.pitch = still.spread = 0;
        if (!psf_points_put(&still, &points, error)) {
            return false;
        }
        perfect = points.total;
        /* a ray is as large as a pixel, and four have shares of it */
        const double size = (double)plane.size, middle = (double)(plane.size / 2);
        const double density = (weight * pupil->energy) / (plane.pitch * plane.pitch);
        for (size_t i = 0; i < rays[g].count; i++) {
            const double x = rays[g].at[i][0] / plane.pitch + middle;
            const double y = rays[g].at[i][1] / plane.pitch + middle;
            const double left = floor(x), low = floor(y);
            for (int k = 0; k < 4; k++) {
                const double column = left + k % 2, row = low + (double)(k / 2);
                if (column >= 0 && column < size && row >= 0 && row < size) {
                    sums->values[(size_t)row * plane.size + (size_t)column] +=
                        rays[g].weights[i] * density * (1 - fabs(x - column)) * (1 - fabs(y - row));
                }
            }
        }
        sums->perfect += weight * waves * waves * perfect * perfect;
        sums->total += weight * pupil->energy;
    }
    return true;
}

/* How it is found; psf->turns says why not by waves. */
static void choose_method(const struct psf_question *question, const struct exit_pupils *pupils,
                          const double *spreads, struct psf *psf)
{
    double turns = 0;
    psf->method = question->method;
    for (size_t g = 0; g < pupils->lights.count; g++) {
        const struct psf_plane plane =
            psf_plane_of(question, psf, &pupils->list[g], spreads[g], NULL);
        turns = psf_is_dark(pupils, g) ? turns : fmax(turns, psf_points_turns(&plane));
    }
    if (psf->method == PSF_AUTO) {
        const bool by_rays =
            !(turns < PSF_TURNS_MOST) && isnan(question->pitch) && !psf->is_angular;
        psf->method = by_rays ? PSF_RAYS : PSF_PLANE;
        psf->turns = by_rays ? turns : 0;
    }
}

bool psf_find(const struct psf_question *question, struct arena *arena, struct psf *psf,
              struct error *error)
{
    struct exit_pupils *pupils = ARENA_NEW(arena, struct exit_pupils);
    if (!exit_pupils_open(&question->bundle, arena, pupils, error)) {
        return false;
    }
    const size_t count = question->size * question->size;
    double *spreads = ARENA_ARRAY(arena, pupils->lights.count, double);
    double rays[2] = {0, 0}, light = 0;
    for (size_t g = 0; g < pupils->lights.count; g++) {
        const struct exit_pupil *pupil = &pupils->list[g];
        const double weight = psf_is_dark(pupils, g) ? 0 : exit_pupil_weight(pupil) * pupil->energy;
        double centroid[2];
        spreads[g] = find_spread(pupil, arena, centroid);
        light += weight;
        rays[0] += weight * centroid[0];
        rays[1] += weight * centroid[1];
    }
    rays[0] *= question->is_perfect ? 0 : 1 / light;
    rays[1] *= question->is_perfect ? 0 : 1 / light;
    struct psf_sums sums = {.values = ARENA_ARRAY(arena, count, double)};
    /* below pixels of this side the waves of all wavelengths are told apart, mm */
    double finest = INFINITY;
    for (size_t k = 0; k < pupils->lights.count; k++) {
        const struct exit_pupil *each = &pupils->list[k];
        const double wide = 2 * fmax(each->half[0], each->half[1]);
        finest = fmin(finest, 1 / (each->n * each->waves * wide));
    }
    *psf = (struct psf){.size = question->size,
                        .pitch = question->pitch,
                        .finest = finest,
                        .is_angular = pupils->reference.is_angular,
                        .values = sums.values,
                        .islands = pupils->islands};
    for (size_t j = 0; j < pupils->lights.count; j++) {
        psf->spread = fmax(psf->spread, spreads[j]);
    }
    if (isnan(psf->pitch)) {
        /* one that tells them apart, of an image that has room for the rays */
        const double room = 2 * roomy * psf->spread / (double)psf->size;
        psf->pitch = fmin(fmax(fine * psf->finest, room), 0.9 * psf->finest);
    }
    choose_method(question, pupils, spreads, psf);
    if (!(psf->method == PSF_RAYS
              ? psf_add_rays(question, pupils, psf, &sums, arena, error)
              : psf_add_waves(question, pupils, spreads, psf, &sums, arena, error))) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        sums.values[i] /= sums.perfect;
    }
    psf_measure(psf, sums.total / (sums.perfect * psf->pitch * psf->pitch), rays, arena);
    return true;
}

bool psf_look(const struct bundle_question *bundle, struct arena *arena, struct psf *psf,
              struct error *error)
{
    /* the smallest image, of the chief ray's place alone */
    const struct psf_question asked = {
        .bundle = *bundle, .method = PSF_PLANE, .size = 8, .pitch = 1e-9, .threads = 1};
    return psf_find(&asked, arena, psf, error);
}
