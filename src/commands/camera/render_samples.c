/* commands/camera/render_samples.c - how many rays a pixel has, and what error that leaves. */
/* SPDX-License-Identifier: MIT */
#include "commands/camera/render.h"

enum { USUAL_SAMPLES = 64, USUAL_WITH_ERROR = 4096, MOST_SAMPLES = 1 << 20 };

/* Does something else end before the samples do? */
static bool ends_before(const struct render_input *input)
{
    return !isnan(input->error) || !isnan(input->seconds);
}

bool render_check_samples(const struct render_input *input, struct error *error)
{
    const long samples = input->samples;
    if (samples > MOST_SAMPLES || (samples & (samples - 1)) != 0) {
        return fail(error, ERROR_USAGE,
                    "{--samples} %ld: rays of a pixel are a power of two, at most %d", samples,
                    MOST_SAMPLES);
    }
    return !ends_before(input) || samples == 0 || samples >= CONVERGENCE_LEAST ||
           fail(error, ERROR_USAGE,
                "{--samples} %ld: with {--%s} they are the most there may be, %d or more", samples,
                isnan(input->error) ? "seconds" : "error", CONVERGENCE_LEAST);
}

void render_ask_samples(const struct render_input *input, struct photograph_question *question)
{
    long usual = isnan(input->error) ? USUAL_SAMPLES : USUAL_WITH_ERROR;
    usual = isnan(input->seconds) ? usual : MOST_SAMPLES;
    question->samples = (size_t)(input->samples == 0 ? usual : input->samples);
    question->error = isnan(input->error) ? 0 : input->error;
}

/* An error that was reached, as a multiple of the one asked for. */
static const char *error_in_words(const struct render_input *input, double reached,
                                  struct arena *arena)
{
    const double percent = 100 * input->error * reached;
    return render_is_world(input)
               ? arena_printf(arena,
                              "%.2g %% of each pixel's light, or %.2g of a grey level if that is "
                              "more",
                              percent, reached)
               : arena_printf(arena, "%.2g %% of white", percent);
}

void render_say_samples(const struct render_input *input, const struct photograph *photograph,
                        struct text_buffer *remarks)
{
    const uint64_t *counts = photograph->counts + PHOTOGRAPH_CONVERGENCE;
    const size_t *reached = photograph->reached;
    if (reached[1] > reached[0]) {
        growing_format(remarks, "in the time given %zu to %zu rays a pixel and colour\n",
                       reached[0], reached[1]);
    } else if (reached[1] > 0) {
        growing_format(remarks, "in the time given %zu rays a pixel and colour\n", reached[1]);
    }
    if (isnan(input->error) || counts[CONVERGENCE_TILES] == 0) {
        return;
    }
    growing_format(remarks, "error %s, by %.4g rays a pixel and colour on average\n",
                   error_in_words(input, convergence_error(counts, false), remarks->arena),
                   (double)counts[CONVERGENCE_RAYS] / (double)counts[CONVERGENCE_TILES]);
    if (counts[CONVERGENCE_MISSED] > 0) {
        growing_format(remarks,
                       "warning: %llu of %llu tiles have not reached the error: they have %s\n",
                       (unsigned long long)counts[CONVERGENCE_MISSED],
                       (unsigned long long)counts[CONVERGENCE_TILES],
                       error_in_words(input, convergence_error(counts, true), remarks->arena));
    }
}
