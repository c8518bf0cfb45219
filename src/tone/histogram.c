/* tone/histogram.c - luminance to a display by the histogram of what the eye adapts to. */
/* SPDX-License-Identifier: MIT */
#include "tone/histogram.h"

#include "tone/sight.h"

#include <math.h>

enum { PASSES_MOST = 1000 };

double foveal_log_mean(const struct foveal *foveal)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < foveal->columns * foveal->rows; i++) {
        const double luminance = foveal_luminance(foveal, i);
        if (luminance > SIGHT_LEAST) {
            sum += log(luminance);
            count++;
        }
    }
    return count > 0 ? sum / count : NAN;
}

static double brightness(double luminance)
{
    return log(fmax(luminance, SIGHT_LEAST));
}

/* P from the bins; how many are left in all. */
static double histogram_add_up(struct histogram *histogram)
{
    double sum = 0;
    for (int i = 0; i < HISTOGRAM_BINS; i++) {
        sum += histogram->bins[i];
    }
    double below = 0;
    for (int i = 0; i < HISTOGRAM_BINS; i++) {
        histogram->share[i] = below / sum;
        below += histogram->bins[i];
    }
    histogram->share[HISTOGRAM_BINS] = 1;
    return sum;
}

/* B_d of a B within the ends. */
static double shown_brightness(const struct histogram *histogram, double b)
{
    const double place = HISTOGRAM_BINS * (b - histogram->low) / (histogram->high - histogram->low);
    const int i = place < HISTOGRAM_BINS ? (int)place : HISTOGRAM_BINS - 1;
    const double rest = place - i;
    const double share =
        histogram->share[i] + rest * (histogram->share[i + 1] - histogram->share[i]);
    const double low = log(histogram->display.least), high = log(histogram->display.most);
    return low + (high - low) * share;
}

/* Cut each bin to its ceiling; how much was cut. */
static double histogram_trim(struct histogram *histogram, enum histogram_ceiling ceiling,
                             double total)
{
    const double width = (histogram->high - histogram->low) / HISTOGRAM_BINS;
    const double range = log(histogram->display.most / histogram->display.least);
    double trimmed = 0;
    for (int i = 0; i < HISTOGRAM_BINS; i++) {
        double most = total * width / range;
        if (ceiling == CEILING_HUMAN) {
            const double b = histogram->low + (i + 0.5) * width;
            const double Lw = exp(b), Ld = exp(shown_brightness(histogram, b));
            most *= sight_threshold(Ld) * Lw / (sight_threshold(Lw) * Ld);
        }
        if (histogram->bins[i] > most) {
            trimmed += histogram->bins[i] - most;
            histogram->bins[i] = most;
        }
    }
    return trimmed;
}

/* The display has contrast to spare. */
static void make_linear(double log_mean, enum histogram_ceiling ceiling,
                        struct histogram *histogram)
{
    const double middle = sqrt(histogram->display.least * histogram->display.most);
    const double mean = exp(log_mean);
    const double wanted =
        ceiling == CEILING_HUMAN ? sight_threshold(middle) / sight_threshold(mean) : middle / mean;
    histogram->is_linear = true;
    histogram->factor = fmin(wanted, histogram->display.most / exp(histogram->high));
}

bool histogram_adjust(const struct foveal *foveal, const struct display *display,
                      enum histogram_ceiling ceiling, struct histogram *histogram,
                      struct error *error)
{
    const double log_mean = foveal_log_mean(foveal);
    *histogram = (struct histogram){.display = *display};
    histogram->low = INFINITY;
    histogram->high = -(double)INFINITY;
    for (size_t i = 0; i < foveal->columns * foveal->rows; i++) {
        const double b = brightness(foveal_luminance(foveal, i));
        histogram->low = fmin(histogram->low, b);
        histogram->high = fmax(histogram->high, b);
    }
    if (isnan(log_mean)) {
        return fail(error, ERROR_DOMAIN, "all is darker than %g cd/m2, which nobody sees",
                    SIGHT_LEAST);
    }
    if (!(histogram->high > histogram->low)) {
        make_linear(log_mean, ceiling, histogram);
        return true;
    }
    const double width = histogram->high - histogram->low;
    for (size_t i = 0; i < foveal->columns * foveal->rows; i++) {
        const double b = brightness(foveal_luminance(foveal, i));
        const double place = HISTOGRAM_BINS * (b - histogram->low) / width;
        histogram->bins[place < HISTOGRAM_BINS ? (size_t)place : HISTOGRAM_BINS - 1]++;
        histogram->total++;
    }
    const double tolerance = HISTOGRAM_TOLERANCE * histogram->total;
    double trimmed = histogram->total;
    while (trimmed > tolerance && histogram->passes < PASSES_MOST) {
        const double total = histogram_add_up(histogram);
        if (total < tolerance) {
            make_linear(log_mean, ceiling, histogram);
            return true;
        }
        trimmed = histogram_trim(histogram, ceiling, total);
        histogram->passes++;
    }
    histogram->trimmed = trimmed / histogram->total;
    histogram_add_up(histogram);
    return true;
}

double histogram_shown(const struct histogram *histogram, double luminance)
{
    const struct display *display = &histogram->display;
    const double b = brightness(luminance);
    if (histogram->is_linear) {
        return fmin(fmax(histogram->factor * luminance, display->least), display->most);
    }
    if (b <= histogram->low) {
        return display->least;
    }
    if (b >= histogram->high) {
        return display->most;
    }
    return exp(shown_brightness(histogram, b));
}
