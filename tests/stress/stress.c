/* tests/stress/stress.c - random trials where arithmetic is hardest, family by family. */
/* SPDX-License-Identifier: MIT */
#include "stress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/*
 * trials BUILD SECONDS SEED [FAMILY [NUMBER]]: every family for a share of the time, but for at
 * least a few trials; or one; or one trial. SECONDS 0 is the short form of every day. First comes
 * what has failed once. What is printed of each is its worst figure, that figure's condition, and
 * how to have it alone.
 */
struct family {
    const char *name;
    family_try *try;
    unsigned few;   /* trials of the short form */
    double share;   /* of the time, as the others count theirs */
    double ulp;     /* what errors are counted in, of the figure; 0 = 2^-53 */
    double allowed; /* of it, over the condition; 0 = 64 */
};

static const struct family families[] = {
    {"first order", try_ordinary_paraxial, 60, 1, 0, 16},
    {"first order, all scales", try_scales_paraxial, 60, 1, 0, 16},
    {"first order, flat", try_flat_paraxial, 30, 1, 0, 16},
    {"first order, near afocal", try_afocal_paraxial, 60, 1, 0, 16},
    {"first order, 500 surfaces", try_long_paraxial, 1, 1, 0, 16},
    {"seidel", try_seidel, 40, 1, 0, 0},
    {"rays", try_rays, 25, 2, 0, 0},
    {"derivatives", try_derivatives, 5, 2, 0, 0},
    {"optical paths", try_paths, 8, 2, 0, 0},
    {"bent rays", try_bent_rays, 8, 2, 0, 0},
    {"bent derivatives", try_bent_derivatives, 2, 2, 0, 0},
    {"bent paths", try_bent_paths, 1, 1, 0, 0},
    {"chief rays", try_chief, 20, 1, 0, 0},
    {"aimed rays", try_aim, 20, 2, 0, 0},
    {"quadratures", try_spot, 2, 2, 0, 0},
    {"clipped quadratures", try_clipped, 1, 3, 0, 0},
    {"zernike", try_zernike, 20, 1, 0, 0},
    {"zernike fits", try_zernike_fit, 1, 1, 0, 0},
    {"fourier", try_fft, 8, 1, 0, 0},
    {"photography", try_photography, 3000, 1, 0, 0},
    {"depth of field", try_depth_of_field, 3000, 1, 0, 0},
    {"nist", try_nist, 8, 1, 5e-11, 0},
    {"scenes", try_scene, 1, 2, 0, 0},
    {"numbers", try_numbers, 3000, 1, 0, 0},
    {"aspheres", try_aspheres, 10, 1, 0, 0},
    {"wild aspheres", try_wild_aspheres, 5, 1, 0, 0},
    {"merit", try_merit, 0, 2, 0, 0},
};
enum { FAMILIES = sizeof families / sizeof families[0], MOST_SHOWN = 5, MOST_FAILED = 50 };

/* What has failed once: these trials of a seed. */
static const struct {
    const char *family;
    unsigned long seed, number;
} once[] = {
    {"derivatives", 1, 12},         /* a flat surface decentred */
    {"derivatives", 2, 19},         /* a first surface tilted before an object far away */
    {"derivatives", 2, 1212},       /* the shape of a surface that bends nothing */
    {"derivatives", 2, 611},        /* flat ones */
    {"zernike", 1, 245},            /* beside an axis */
    {"zernike", 1, 4127},           /* */
    {"clipped quadratures", 1, 59}, /* contrast by series of which terms have been dropped */
    {"clipped quadratures", 1, 41}, /* light that is turned over in the last hundredth to the rim */
    {"nist", 1, 1393},              /* Ceres on a slope, "converged": without trust, */
    {"nist", 3, 1123},              /* by short steps */
};

/* What came of the trials of a family. */
struct tally {
    const struct family *family;
    unsigned long seed, trials, passed, failed, skipped, shown;
    double units, condition; /* of the worst figure */
    char what[60];
    unsigned long number;
};

/* -------- random numbers: splitmix64 -------- */

static uint64_t next_state(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double trial_draw(struct trial *trial)
{
    return (double)(next_state(&trial->state) >> 11) * 0x1p-53;
}

double trial_between(struct trial *trial, double low, double high)
{
    return low + (high - low) * trial_draw(trial);
}

double trial_magnitude(struct trial *trial, double low, double high)
{
    return exp(trial_between(trial, log(low), log(high)));
}

bool trial_chance(struct trial *trial, double share)
{
    return trial_draw(trial) < share;
}

double trial_sign(struct trial *trial)
{
    return trial_chance(trial, 0.5) ? -1 : 1;
}

int trial_whole(struct trial *trial, int low, int high)
{
    return low + (int)(trial_draw(trial) * (double)(high - low + 1));
}

static uint64_t state_of(const struct family *family, unsigned long seed, unsigned long number)
{
    uint64_t state = seed;
    for (const char *c = family->name; *c != '\0'; c++) {
        state = next_state(&state) ^ (uint64_t)(unsigned char)*c;
    }
    state ^= number * 0xd1342543de82ef95u;
    (void)next_state(&state);
    return state;
}

/* -------- verdicts -------- */

static void tally_show_failure(struct trial *trial, const char *said)
{
    struct tally *tally = trial->tally;
    tally->failed++;
    if (++tally->shown <= MOST_SHOWN) {
        printf("FAILED %s, SEED=%lu FAMILY='%s' NUMBER=%lu: %s\n%s", tally->family->name,
               tally->seed, tally->family->name, trial->number, said,
               trial->about != NULL ? trial->about : "");
    }
}

void trial_figure(struct trial *trial, const char *what, double off, double size,
                  double sensitivity)
{
    struct tally *tally = trial->tally;
    const struct family *family = tally->family;
    const double ulp = family->ulp > 0 ? family->ulp : 0x1p-53;
    const double allowed = family->allowed > 0 ? family->allowed : 64;
    const double units = off == 0 ? 0 : off / (ulp * (sensitivity + size));
    if (!(units <= tally->units)) {
        tally->units = units;
        tally->condition = (sensitivity + size) / size;
        tally->number = trial->number;
        snprintf(tally->what, sizeof tally->what, "%s", what);
    }
    if (units <= allowed) {
        tally->passed++;
        return;
    }
    char said[200];
    snprintf(said, sizeof said, "%s %.3g off of %.17g, condition %.3g: %.3g ulp over it", what, off,
             size, (sensitivity + size) / size, units);
    tally_show_failure(trial, said);
}

bool trial_is_near(struct trial *trial, double off, double size)
{
    const struct family *family = trial->tally->family;
    const bool is_near = off <= 2 * (family->ulp > 0 ? family->ulp : 0x1p-53) * size;
    trial->tally->passed += is_near;
    return is_near;
}

bool trial_verdict(struct trial *trial, bool is_right, const char *form, ...)
{
    trial->tally->passed += is_right;
    if (!is_right) {
        char said[1000];
        va_list list;
        va_start(list, form);
        vsnprintf(said, sizeof said, form, list);
        va_end(list);
        tally_show_failure(trial, said);
    }
    return is_right;
}

void trial_skip(struct trial *trial)
{
    trial->tally->skipped++;
}

/* -------- a run -------- */

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void tally_try(struct tally *tally, const char *build, unsigned long number)
{
    struct trial trial = {.state = state_of(tally->family, tally->seed, number),
                          .number = number,
                          .build = build,
                          .tally = tally};
    tally->family->try(&trial);
    tally->trials++;
    arena_free(&trial.arena);
}

static void tally_try_once(struct tally *tally, const char *build)
{
    const unsigned long seed = tally->seed;
    for (size_t i = 0; i < sizeof once / sizeof once[0]; i++) {
        if (strcmp(once[i].family, tally->family->name) == 0) {
            tally->seed = once[i].seed;
            tally_try(tally, build, once[i].number);
        }
    }
    tally->seed = seed;
    tally->trials = 0; /* those of its own seed are counted */
}

static void tally_show(const struct tally *tally, double seconds)
{
    printf("%-26s %8lu trials, %9lu good, %6lu not judged, %lu failed", tally->family->name,
           tally->trials, tally->passed, tally->skipped, tally->failed);
    if (tally->units > 0) {
        printf("; worst %.3g of %g (%s, condition %.2g; SEED=%lu FAMILY='%s' NUMBER=%lu)",
               tally->units, tally->family->allowed > 0 ? tally->family->allowed : 64, tally->what,
               tally->condition, tally->seed, tally->family->name, tally->number);
    }
    printf(" %.0f s\n", seconds);
    fflush(stdout);
}

int main(int count, char **words)
{
    const char *build = count > 1 ? words[1] : "build", *only = count > 4 ? words[4] : "";
    const double seconds = count > 2 ? atof(words[2]) : 60;
    const unsigned long seed = count > 3 ? strtoul(words[3], NULL, 10) : 1;
    double shares = 0;
    for (size_t i = 0; i < FAMILIES; i++) {
        shares += *only == '\0' || strcmp(families[i].name, only) == 0 ? families[i].share : 0;
    }
    unsigned long passed = 0, failed = 0;
    for (size_t i = 0; i < FAMILIES; i++) {
        if (*only != '\0' && strcmp(families[i].name, only) != 0) {
            continue;
        }
        struct tally tally = {.family = &families[i], .seed = seed};
        const double start = seconds_now(), end = start + seconds * families[i].share / shares;
        if (count > 5) {
            tally_try(&tally, build, strtoul(words[5], NULL, 10));
        } else {
            tally_try_once(&tally, build);
            while (tally.trials < families[i].few ||
                   (seconds_now() < end && tally.failed < MOST_FAILED)) {
                tally_try(&tally, build, tally.trials);
            }
        }
        tally_show(&tally, seconds_now() - start);
        passed += tally.passed;
        failed += tally.failed;
    }
    if (shares == 0) {
        printf("FAILED no family '%s'\n", only);
        failed++;
    }
    printf("%lu passed, %lu failed\n", passed, failed);
    return failed != 0;
}
