/* exchange/zemax/zemax_environment.c - the temperature and pressure of a .zmx file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_environment.h"

#include "exchange/environment.h"

bool zemax_to_environment(struct zemax_file *file, const struct zemax_line *line,
                          struct medium *medium, struct error *error)
{
    /* ENVD temperature pressure adjust */
    const struct zemax_line *stated = file->environment;
    struct environment environment = {.job = file->job,
                                      .build = &file->build,
                                      .temperature = zemax_number(stated, 0),
                                      .pressure = zemax_number(stated, 1)};
    if (zemax_number(stated, 2) == 0) {
        return true;
    }
    const size_t count = zemax_wave_count(file);
    while (environment.wave_count < count) {
        environment.waves[environment.wave_count] = file->waves[environment.wave_count].value.hi;
        environment.wave_count++;
    }
    return environment_apply(&environment, &line->words, line->keyword, medium, error);
}
