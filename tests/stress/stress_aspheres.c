/* tests/stress/stress_aspheres.c - no ray at a random asphere is lost for nothing. */
/* SPDX-License-Identifier: MIT */
#include "../unit/random_aspheres.h"

#include <stdlib.h>
#include <time.h>

/*
 * stress_aspheres SECONDS SEED [ASPHERES]: of every asphere a block of rays, traced with every set
 * of instructions; who arrives must be on the surface in 113 bits, who is lost is searched for.
 */
enum { STEPS = 2000, SEARCHED = 4 };

static double seconds_since(const struct timespec *start)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

int main(int count, char **words)
{
    static const struct {
        const char *name;
        struct strength strength;
        bool is_judged; /* wild ones are only counted */
    } kinds[] = {{"moderate", {0.8, 0.4, 4, 0.7}, true}, {"wild", {3, 3, 30, 1.2}, false}};
    double seconds = count > 1 ? atof(words[1]) : 10;
    long most = count > 3 ? atol(words[3]) : 1000000000;
    long passed = 0, failed = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        struct asphere_tally tally = {0};
        struct timespec start;
        unsigned long long state = 1000 * (count > 2 ? strtoull(words[2], NULL, 10) : 1) + i;
        long surfaces = 0, differ = 0;
        clock_gettime(CLOCK_MONOTONIC, &start);
        while (surfaces < most && seconds_since(&start) < seconds / 2) {
            differ += !try_asphere(&state, &kinds[i].strength, STEPS, SEARCHED, &tally);
            surfaces++;
        }
        printf("%s aspheres: %ld, %zu rays; lost for nothing %zu, not on the surface %zu, not "
               "converged %zu; of %zu searched for %zu are met elsewhere than first; sets of "
               "instructions differ at %ld\n",
               kinds[i].name, surfaces, tally.rays, tally.lost, tally.wrong, tally.unconverged,
               tally.met, tally.differ, differ);
        long bad = differ + (long)(tally.wrong + tally.unconverged);
        bad += kinds[i].is_judged ? (long)tally.lost : 0;
        failed += bad;
        passed += (long)tally.rays - bad;
    }
    printf("%ld passed, %ld failed\n", passed, failed);
    return failed > 0;
}
