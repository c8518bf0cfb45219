/* photo/pixel_density.c - pixels along the subject, and how many surveillance wants. */
/* SPDX-License-Identifier: MIT */
#include "photo/pixel_density.h"

const struct viewing_task viewing_tasks[] = {
    {"monitor", 0.0125}, {"detect", 0.025},   {"observe", 0.0625},    {"recognise", 0.125},
    {"identify", 0.25},  {"inspect", 1},      {"overview", 0.02},     {"outline", 0.04},
    {"discern", 0.08},   {"perceive", 0.125}, {"characterise", 0.25}, {"validate", 0.5},
    {"scrutinise", 1.5},
};

double pixel_density(double m, double pitch, double squeeze)
{
    return m / (pitch * squeeze);
}

double line_rate(double speed, double density)
{
    return speed * density;
}
