/* optics/wavelength.c - spectral lines by name. */
/* SPDX-License-Identifier: MIT */
#include "optics/wavelength.h"

const struct spectral_line spectral_lines[] = {
    {"i", 0.3650146, "Hg"},
    {"h", 0.4046561, "Hg"},
    {"g", 0.4358343, "Hg"},
    {"F'", 0.4799914, "Cd"},
    {"F", WAVELENGTH_F, "H"},
    {"e", 0.5460740, "Hg"},
    {"d", WAVELENGTH_D, "He"},
    {"D", 0.5892938, "Na"},
    {"HeNe", 0.6328, "He-Ne laser"},
    {"C'", 0.6438469, "Cd"},
    {"C", WAVELENGTH_C, "H"},
    {"r", 0.7065188, "He"},
    {"A'", 0.768195, "K"},
    {"s", 0.85211, "Cs"},
    {"t", 1.01398, "Hg"},
    {0},
};

const struct spectral_line *spectral_line_find(struct text name)
{
    for (const struct spectral_line *line = spectral_lines; line->name != NULL; line++) {
        if (text_equal(name, line->name)) {
            return line;
        }
    }
    return NULL;
}
