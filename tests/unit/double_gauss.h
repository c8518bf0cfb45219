/* tests/unit/double_gauss.h - the double Gauss of the lecture, by W. Smith. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_DOUBLE_GAUSS_H
#define LENSCALC_TESTS_UNIT_DOUBLE_GAUSS_H

/* Its surfaces, with this diameter of the stop, which stands on a plane that may be varied. */
#define DOUBLE_GAUSS(stop_diameter)                                                                \
    "surface 58.950 7.520 1.670/47.1 50.4\n"                                                       \
    "surface 169.660 0.240 air 50.4\n"                                                             \
    "surface 38.550 8.050 1.670/47.1 46.0\n"                                                       \
    "surface 81.540 6.550 1.699/30.1 46.0\n"                                                       \
    "surface 25.500 11.410 air 36.0\n"                                                             \
    "surface - 9.000 air " stop_diameter " stop\n"                                                 \
    "surface -28.990 2.360 1.603/38.0 34.0\n"                                                      \
    "surface 81.540 12.130 1.658/57.3 40.0\n"                                                      \
    "surface -40.770 0.380 air 40.0\n"                                                             \
    "surface 874.130 6.440 1.717/48.0 40.0\n"                                                      \
    "surface -79.460 72.228 air 40.0\n"

#endif
