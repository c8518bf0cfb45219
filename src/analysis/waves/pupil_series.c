/* analysis/waves/pupil_series.c - functions of a disc as sums of polynomials, many places at once. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_series.h"

#include "base/cholesky.h"
#include "base/instruction_set.h"

static struct pupil_form pupil_form_within(size_t orders, size_t degree)
{
    struct pupil_form form = {.orders = orders};
    for (size_t m = 0; m < orders; m++) {
        form.radial[m] = (degree - m) / 2 + 1;
        form.terms += (m > 0 ? 2 : 1) * form.radial[m];
    }
    return form;
}

struct pupil_form pupil_form_of(size_t points)
{
    size_t k = 1;
    while (k < PUPIL_RADIAL && (k + 1) * (2 * k + 3) <= points) {
        k++;
    }
    return pupil_form_within(k + 1, 2 * k - 1);
}

struct pupil_form pupil_form_of_degree(size_t degree)
{
    return pupil_form_within(degree + 1, degree);
}

void pupil_look(const struct pupil_form *form, const double *const c[2],
                const struct pupil_look *look)
{
    KERNEL_FOR(SET_BEST, kernel_pupil_look)(form, c, look);
}

void pupil_gather(const struct pupil_form *form, const struct pupil_look *look,
                  double *const sums[2])
{
    KERNEL_FOR(SET_BEST, kernel_pupil_gather)(form, look, sums);
}

bool pupil_fit_open(const struct pupil_fit *fit)
{
    KERNEL_FOR(SET_BEST, kernel_pupil_gram)(fit);
    return cholesky_factor(fit->factor, fit->form->terms);
}

void pupil_fit_solve(const struct pupil_fit *fit, double *sums)
{
    cholesky_forward(fit->factor, fit->form->terms, sums);
    cholesky_backward(fit->factor, fit->form->terms, sums);
}

void pupil_fit_find(const struct pupil_fit *fit, const double *const values[2],
                    double *const work[2], double *const c[2])
{
    const struct pupil_look look = {
        .count = fit->count, .x = fit->x, .y = fit->y, .value = {work[0], work[1]}};
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < fit->count; i++) {
            work[k][i] = fit->weights[i] * values[k][i];
        }
    }
    pupil_gather(fit->form, &look, c);
    pupil_fit_solve(fit, c[0]);
    pupil_fit_solve(fit, c[1]);
}

void pupil_cross(const struct pupil_cross *cross)
{
    KERNEL_FOR(SET_BEST, kernel_pupil_cross)(cross);
}
