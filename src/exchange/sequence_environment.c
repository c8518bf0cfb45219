/* exchange/sequence_environment.c - temperature and pressure of CODE V and OSLO files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/sequence.h"

bool sequence_environment(struct sequence *sequence, bool is_temperature, double per_atmosphere,
                          struct error *error)
{
    static const struct number_scale plain = {1, 0};
    const struct commands *commands = sequence->commands;
    struct figure figure;
    if (!commands_figure(commands, 1, plain, is_temperature ? "temperature" : "pressure", &figure,
                         error) ||
        !commands_end(commands, 2, error)) {
        return false;
    }
    const double value = figure.value.hi;
    if (!(is_temperature ? value > -273.15 : value >= 0)) {
        return commands_fail(commands, &commands->words[1], error,
                             is_temperature ? "a temperature is above -273.15 C"
                                            : "a pressure is not below 0");
    }
    *(is_temperature ? &sequence->environment.temperature : &sequence->environment.pressure) =
        is_temperature ? value : value / per_atmosphere;
    return true;
}

bool sequence_to_environment(struct sequence *sequence, struct error *error)
{
    struct environment *environment = &sequence->environment;
    const struct lens *lens = sequence->build->lens;
    environment->job = sequence->job;
    environment->build = sequence->build;
    environment->wave_count = 0;
    for (size_t i = 0; i < lens->wavelength_count && i < ENVIRONMENT_WAVES; i++) {
        environment->waves[environment->wave_count++] = lens->wavelengths[i].wavelength;
    }
    for (size_t i = 0; i < sequence->count; i++) {
        struct sequence_surface *surface = &sequence->surfaces[i];
        const struct command_word *at =
            surface->glass.text.length > 0 ? &surface->glass : &surface->at;
        const struct file_words place = commands_place(sequence->commands, at);
        if (!environment_apply(environment, &place, at->text, &surface->medium, error)) {
            return false;
        }
    }
    return true;
}
