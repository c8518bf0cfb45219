/* light/observer.c - the CIE 1931 standard observer, and sums over the spectrum. */
/* SPDX-License-Identifier: MIT */
#include "light/observer.h"

/* From OBSERVER_LEAST on, in steps of OBSERVER_STEP. [CIE04] T.4, as in colord's tables. */
/* clang-format off */
static const double functions[OBSERVER_ROWS][3] = {
    {0.0001299, 3.917e-6, 0.0006061}, {0.0002321, 6.965e-6, 0.001086},
    {0.0004149, 1.239e-5, 0.001946}, {0.0007416, 2.202e-5, 0.003486}, {0.001368, 3.9e-5, 0.00645},
    {0.002236, 6.4e-5, 0.01055}, {0.004243, 0.00012, 0.02005}, {0.00765, 0.000217, 0.03621},
    {0.01431, 0.000396, 0.06785}, {0.02319, 0.00064, 0.1102}, {0.04351, 0.00121, 0.2074},
    {0.07763, 0.00218, 0.3713}, {0.13438, 0.004, 0.6456}, {0.21477, 0.0073, 1.03905},
    {0.2839, 0.0116, 1.3856}, {0.3285, 0.01684, 1.62296}, {0.34828, 0.023, 1.74706},
    {0.34806, 0.0298, 1.7826}, {0.3362, 0.038, 1.77211}, {0.3187, 0.048, 1.7441},
    {0.2908, 0.06, 1.6692}, {0.2511, 0.0739, 1.5281}, {0.19536, 0.09098, 1.28764},
    {0.1421, 0.1126, 1.0419}, {0.09564, 0.13902, 0.81295}, {0.05795, 0.1693, 0.6162},
    {0.03201, 0.20802, 0.46518}, {0.0147, 0.2586, 0.3533}, {0.0049, 0.323, 0.272},
    {0.0024, 0.4073, 0.2123}, {0.0093, 0.503, 0.1582}, {0.0291, 0.6082, 0.1117},
    {0.06327, 0.71, 0.07825}, {0.1096, 0.7932, 0.05725}, {0.1655, 0.862, 0.04216},
    {0.22575, 0.91485, 0.02984}, {0.2904, 0.954, 0.0203}, {0.3597, 0.9803, 0.0134},
    {0.43345, 0.99495, 0.00875}, {0.51205, 1, 0.00575}, {0.5945, 0.995, 0.0039},
    {0.6784, 0.9786, 0.00275}, {0.7621, 0.952, 0.0021}, {0.8425, 0.9154, 0.0018},
    {0.9163, 0.87, 0.00165}, {0.9786, 0.8163, 0.0014}, {1.0263, 0.757, 0.0011},
    {1.0567, 0.6949, 0.001}, {1.0622, 0.631, 0.0008}, {1.0456, 0.5668, 0.0006},
    {1.0026, 0.503, 0.00034}, {0.9384, 0.4412, 0.00024}, {0.85445, 0.381, 0.00019},
    {0.7514, 0.321, 0.0001}, {0.6424, 0.265, 5e-5}, {0.5419, 0.217, 3e-5}, {0.4479, 0.175, 2e-5},
    {0.3608, 0.1382, 1e-5}, {0.2835, 0.107, 0}, {0.2187, 0.0816, 0}, {0.1649, 0.061, 0},
    {0.1212, 0.04458, 0}, {0.0874, 0.032, 0}, {0.0636, 0.0232, 0}, {0.04677, 0.017, 0},
    {0.0329, 0.01192, 0}, {0.0227, 0.00821, 0}, {0.01584, 0.005723, 0}, {0.0113592, 0.004102, 0},
    {0.00811092, 0.002929, 0}, {0.00579035, 0.002091, 0}, {0.00410946, 0.001484, 0},
    {0.00289933, 0.001047, 0}, {0.00204919, 0.00074, 0}, {0.00143997, 0.00052, 0},
    {0.000999949, 0.0003611, 0}, {0.000690079, 0.0002492, 0}, {0.000476021, 0.0001719, 0},
    {0.000332301, 0.00012, 0}, {0.000234826, 8.48e-5, 0}, {0.000166151, 6e-5, 0},
    {0.000117413, 4.24e-5, 0}, {8.30753e-5, 3e-5, 0}, {5.87065e-5, 2.12e-5, 0},
    {4.15099e-5, 1.499e-5, 0}, {2.93533e-5, 1.06e-5, 0}, {2.06738e-5, 7.4657e-6, 0},
    {1.45598e-5, 5.2578e-6, 0}, {1.0254e-5, 3.7029e-6, 0}, {7.22146e-6, 2.6078e-6, 0},
    {5.08587e-6, 1.8366e-6, 0}, {3.58165e-6, 1.2934e-6, 0}, {2.52253e-6, 9.1093e-7, 0},
    {1.77651e-6, 6.4153e-7, 0}, {1.25114e-6, 4.5181e-7, 0},
};
/* clang-format on */

static double row_wavelength(size_t row)
{
    return OBSERVER_LEAST + OBSERVER_STEP * (double)row;
}

/* -------- where the straight lines bend -------- */

/* A list of wavelengths, and the first of them that is still ahead. */
struct bends {
    const double *wavelength; /* null: the rows of the observer */
    size_t count, next;
};

static double spline_bend(const struct bends *bends, size_t i)
{
    return bends->wavelength != NULL ? bends->wavelength[i] : row_wavelength(i);
}

static struct bends bends_of(const struct spectrum *spectrum)
{
    const bool is_table = spectrum != NULL && spectrum->kind == SPECTRUM_TABLE;
    return (struct bends){is_table ? spectrum->wavelength : NULL, is_table ? spectrum->count : 0,
                          0};
}

/* -------- sums -------- */

/* Add a stretch in which all tables are straight. */
static void add_stretch(const struct spectrum *light, const struct spectrum *surface,
                        const double ends[2], double xyz[3])
{
    /* a table that ends here counts on its own side only */
    const double middle = (ends[0] + ends[1]) / 2;
    /* the row before the middle, that of the last step at the end */
    const double rows = (middle - OBSERVER_LEAST) / OBSERVER_STEP;
    const size_t before = rows > 0 ? (size_t)rows : 0;
    const size_t row = before < OBSERVER_ROWS - 1 ? before : OBSERVER_ROWS - 2;
    if (!(spectrum_at(light, middle) * (surface == NULL ? 1 : spectrum_at(surface, middle)) > 0)) {
        return;
    }
    for (int end = 0; end < 2; end++) {
        const double value =
            spectrum_at(light, ends[end]) * (surface == NULL ? 1 : spectrum_at(surface, ends[end]));
        double of[3];
        /* the colour matching functions between two of their rows */
        const double wavelength = ends[end];
        const double share = (wavelength - row_wavelength(row)) / OBSERVER_STEP;
        for (int i = 0; i < 3; i++) {
            of[i] = functions[row][i] + share * (functions[row + 1][i] - functions[row][i]);
        }
        for (int i = 0; i < 3; i++) {
            xyz[i] += (ends[1] - ends[0]) / 2 * value * of[i];
        }
    }
}

void observer_sum(const struct spectrum *light, const struct spectrum *surface, const double *edges,
                  size_t count, double (*xyz)[3])
{
    struct bends lists[3] = {{NULL, OBSERVER_ROWS, 0}, bends_of(light), bends_of(surface)};
    for (size_t k = 0; k < count; k++) {
        xyz[k][0] = xyz[k][1] = xyz[k][2] = 0;
        for (double at = edges[k]; at < edges[k + 1];) {
            /* what comes first in any of the lists, but not beyond the end */
            const double end = edges[k + 1];
            double next = end;
            for (int i = 0; i < 3; i++) {
                struct bends *list = &lists[i];
                while (list->next < list->count && !(spline_bend(list, list->next) > at)) {
                    list->next++;
                }
                if (list->next < list->count && spline_bend(list, list->next) < next) {
                    next = spline_bend(list, list->next);
                }
            }
            const double ends[2] = {at, next};
            add_stretch(light, surface, ends, xyz[k]);
            at = ends[1];
        }
    }
}
