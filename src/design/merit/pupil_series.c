/* design/merit/pupil_series.c - functions of a disc as sums of polynomials, many places at once. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/pupil_series.h"

#include "base/cholesky.h"
#include "base/instruction_set.h"

struct pupil_form pupil_form_of(size_t points)
{
    struct pupil_form form = {.orders = 0};
    size_t k = 1;
    while (k < PUPIL_RADIAL && (k + 1) * (2 * k + 3) <= points) {
        k++;
    }
    form.orders = k + 1;
    for (size_t m = 0; m <= k; m++) {
        form.radial[m] = (2 * k - 1 - m) / 2 + 1;
        form.terms += (m > 0 ? 2 : 1) * form.radial[m];
    }
    return form;
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

void pupil_cross(const struct pupil_cross *cross)
{
    KERNEL_FOR(SET_BEST, kernel_pupil_cross)(cross);
}
