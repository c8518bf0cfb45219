/* camera/film/acceptance.c - a table of sines, from a power or from angles. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/acceptance.h"

#include "base/constants.h"

#include <math.h>

bool acceptance_power(double power, struct acceptance *acceptance, struct error *error)
{
    if (!(power >= 0 && power <= 100)) {
        return fail(error, ERROR_DOMAIN,
                    "the power %.6g of the cosine that pixels accept is not from 0 to 100", power);
    }
    for (int i = 0; i <= ACCEPTANCE_STEPS; i++) {
        const double sine = (double)i / ACCEPTANCE_STEPS;
        acceptance->at[i] = (float)pow(1 - sine * sine, power / 2);
    }
    return true;
}

bool acceptance_table(const double *angle, const double *taken, size_t count,
                      struct acceptance *acceptance, struct error *error)
{
    bool good = count >= 2 && angle[0] == 0 && taken[0] > 0 && angle[count - 1] <= PI / 2 + 1e-12;
    for (size_t i = 0; i < count; i++) {
        good = good && taken[i] >= 0 && taken[i] <= 1 && (i == 0 || angle[i] > angle[i - 1]);
    }
    if (!good) {
        return fail(error, ERROR_DOMAIN,
                    "what pixels accept is a table of two rows and more, of rising angles from "
                    "0 to 90 deg, and shares of 0 to 1, the first above 0");
    }
    size_t next = 1;
    for (int i = 0; i <= ACCEPTANCE_STEPS; i++) {
        const double theta = asin((double)i / ACCEPTANCE_STEPS);
        while (next + 1 < count && angle[next] < theta) {
            next++;
        }
        const double along = (theta - angle[next - 1]) / (angle[next] - angle[next - 1]);
        const double share = taken[next - 1] + along * (taken[next] - taken[next - 1]);
        acceptance->at[i] = along <= 1 + 1e-9 ? (float)share : 0;
    }
    return true;
}

void acceptance_weigh(const struct acceptance *acceptance, const struct ray_block *block,
                      struct film_samples *samples)
{
    for (size_t i = 0; acceptance != NULL && i < RAYS_BLOCK; i++) {
        const double across = block->p[i] * block->p[i] + block->q[i] * block->q[i];
        const double sine = sqrt(across / (across + block->r[i] * block->r[i]));
        const double step = fmin(sine * ACCEPTANCE_STEPS, ACCEPTANCE_STEPS - 1e-9);
        const size_t below = (size_t)step;
        const double low = (double)acceptance->at[below], high = (double)acceptance->at[below + 1];
        samples->weight[i] *= low + (step - (double)below) * (high - low);
    }
}
