/* design/tolerance/trial_statistics.c - figures of many trials, counted: their moments and percentiles. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/trial_statistics.h"

#include "base/number.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A bin is the leading bits of a double: sign and exponent name the page, these its place there. */
enum { PAGE_BITS = 12, PAGE_BINS = 1 << PAGE_BITS, PAGES = 1 << PAGE_BITS, BIN_SHIFT = 40 };

void trial_statistics_open(double nominal, uint64_t total, struct arena *arena,
                           struct trial_statistics *tally)
{
    *tally = (struct trial_statistics){.nominal = nominal,
                                       .keeps = total <= TRIAL_STATISTICS_KEPT,
                                       .lowest = INFINITY,
                                       .highest = -INFINITY,
                                       .arena = arena};
    if (tally->keeps) {
        tally->kept = ARENA_ARRAY(arena, total + 1, double);
    } else {
        tally->pages = ARENA_ARRAY(arena, PAGES, uint64_t *);
    }
}

static uint64_t *tally_page(struct trial_statistics *tally, size_t page)
{
    if (tally->pages[page] == NULL) {
        tally->pages[page] = ARENA_ARRAY(tally->arena, PAGE_BINS, uint64_t);
    }
    return tally->pages[page];
}

void trial_statistics_add(struct trial_statistics *tally, double figure)
{
    const double departure = figure - tally->nominal + 0.0; /* no -0 */
    double power = 1;
    for (int k = 0; k < TRIAL_STATISTICS_POWERS; k++) {
        power *= departure;
        exact_accumulator_add(&tally->powers[k], power);
    }
    if (tally->keeps) {
        tally->kept[tally->count] = departure;
    } else {
        uint64_t bits;
        memcpy(&bits, &departure, sizeof bits);
        tally_page(tally, bits >> (BIN_SHIFT + PAGE_BITS))[bits >> BIN_SHIFT & (PAGE_BINS - 1)]++;
    }
    tally->lowest = fmin(tally->lowest, figure);
    tally->highest = fmax(tally->highest, figure);
    tally->is_sorted = false;
    tally->count++;
}

void trial_statistics_join(struct trial_statistics *tally, const struct trial_statistics *more)
{
    for (int k = 0; k < TRIAL_STATISTICS_POWERS; k++) {
        exact_accumulator_join(&tally->powers[k], &more->powers[k]);
    }
    if (tally->keeps) {
        memcpy(tally->kept + tally->count, more->kept, more->count * sizeof(double));
    }
    for (size_t page = 0; page < PAGES && !tally->keeps; page++) {
        if (more->pages[page] == NULL) {
            continue;
        }
        uint64_t *bins = tally_page(tally, page);
        for (size_t i = 0; i < PAGE_BINS; i++) {
            bins[i] += more->pages[page][i];
        }
    }
    tally->count += more->count;
    tally->is_sorted = false;
    tally->lowest = fmin(tally->lowest, more->lowest);
    tally->highest = fmax(tally->highest, more->highest);
}

struct trial_statistics_moments trial_statistics_moments(const struct trial_statistics *tally)
{
    const double n = (double)tally->count;
    double m[TRIAL_STATISTICS_POWERS];
    struct trial_statistics_moments moments = {NAN, NAN, NAN, NAN};
    for (int k = 0; k < TRIAL_STATISTICS_POWERS; k++) {
        m[k] = exact_accumulator_value(&tally->powers[k]) / n;
    }
    if (tally->count >= 1) {
        moments.mean = tally->nominal + m[0];
    }
    if (tally->count >= 2) {
        const double variance = fmax((m[1] - m[0] * m[0]) * (n / (n - 1)), 0);
        const double fourth =
            m[3] - 4 * m[0] * m[2] + 6 * m[0] * m[0] * m[1] - 3 * m[0] * m[0] * m[0] * m[0];
        const double kurtosis = variance > 0 ? fourth / (variance * variance) : 1;
        moments.sd = sqrt(variance);
        moments.mean_error = moments.sd / sqrt(n);
        moments.sd_error = moments.sd / 2 * sqrt(fmax(kurtosis - 1, 0) / n);
    }
    return moments;
}

/* -------- percentiles -------- */

static int by_departure(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The number that a bin begins with, nearer to 0; of the page of all that is negative too. */
static double tally_bin_edge(size_t page, size_t bin)
{
    const uint64_t bits = (uint64_t)page << (BIN_SHIFT + PAGE_BITS) | (uint64_t)bin << BIN_SHIFT;
    double edge;
    memcpy(&edge, &bits, sizeof edge);
    return edge;
}

/* Bins in the order of their numbers: of negative ones backwards. */
struct bin_walk {
    const struct trial_statistics *tally;
    size_t at; /* 0 .. 2 PAGES PAGE_BINS */
};

static bool next_bin(struct bin_walk *walk, double *low, double *high, uint64_t *count)
{
    enum { HALF = PAGES / 2 };
    const size_t all = (size_t)PAGES * PAGE_BINS;
    while (walk->at < all) {
        const size_t at = walk->at, page_at = at / PAGE_BINS, bin_at = at % PAGE_BINS;
        const bool is_negative = page_at < HALF;
        const size_t page = is_negative ? PAGES - 1 - page_at : page_at - HALF;
        const size_t bin = is_negative ? PAGE_BINS - 1 - bin_at : bin_at;
        const uint64_t *bins = walk->tally->pages[page];
        if (bins == NULL) {
            walk->at = (page_at + 1) * PAGE_BINS;
            continue;
        }
        walk->at++;
        if (bins[bin] == 0) {
            continue;
        }
        const double near = tally_bin_edge(page, bin);
        const double far =
            bin + 1 < PAGE_BINS ? tally_bin_edge(page, bin + 1) : 2 * tally_bin_edge(page, 0);
        *low = is_negative ? far : near;
        *high = is_negative ? near : far;
        *count = bins[bin];
        return true;
    }
    return false;
}

/* The departure of a rank, 0 .. count - 1, which need not be whole. */
static double departure_at(struct trial_statistics *tally, double rank)
{
    const double most = (double)tally->count - 1;
    rank = fmin(fmax(rank, 0), most);
    if (tally->keeps) {
        const size_t below = (size_t)rank, above = rank < most ? below + 1 : below;
        const double part = rank - (double)below;
        return tally->kept[below] + part * (tally->kept[above] - tally->kept[below]);
    }
    struct bin_walk walk = {tally, 0};
    double low = 0, high = 0, before = 0;
    uint64_t count;
    while (next_bin(&walk, &low, &high, &count)) {
        if (rank < before + (double)count) {
            return low + (high - low) * (rank - before + 0.5) / (double)count;
        }
        before += (double)count;
    }
    return high;
}

double trial_statistics_quantile(struct trial_statistics *tally, double share, double *error)
{
    const double n = (double)tally->count, spread = sqrt(n * share * (1 - share));
    if (tally->count == 0) {
        if (error != NULL) {
            *error = NAN;
        }
        return NAN;
    }
    if (tally->keeps && !tally->is_sorted) {
        qsort(tally->kept, tally->count, sizeof(double), by_departure);
        tally->is_sorted = true;
    }
    const double rank = share * (n - 1);
    if (error != NULL) {
        *error = (departure_at(tally, rank + spread) - departure_at(tally, rank - spread)) / 2;
    }
    return tally->nominal + departure_at(tally, rank);
}

/* -------- drawing -------- */

static void put_part(double departure, double count, const double range[2], size_t bins,
                     double *counts)
{
    const double at = (departure - range[0]) / (range[1] - range[0]) * (double)bins;
    if (at >= 0 && at <= (double)bins) {
        counts[at < (double)bins ? (size_t)at : bins - 1] += count;
    }
}

void trial_statistics_histogram(struct trial_statistics *tally, double low, double high,
                                size_t bins, double *counts)
{
    const double range[2] = {low - tally->nominal, high - tally->nominal};
    memset(counts, 0, bins * sizeof *counts);
    for (size_t i = 0; tally->keeps && i < tally->count; i++) {
        put_part(tally->kept[i], 1, range, bins, counts);
    }
    struct bin_walk walk = {tally, 0};
    double from, to;
    uint64_t count;
    while (!tally->keeps && next_bin(&walk, &from, &to, &count)) {
        put_part((from + to) / 2, (double)count, range, bins, counts);
    }
}

/* -------- lines -------- */

/* Doubles by their bits. */
static void put_double(struct text_buffer *text, double value)
{
    int64_t bits;
    memcpy(&bits, &value, sizeof bits);
    growing_format(text, " %lld", (long long)bits);
}

void trial_statistics_write(const struct trial_statistics *tally, struct text_buffer *text)
{
    growing_format(text, "tally %lld", (long long)tally->count);
    put_double(text, tally->lowest);
    put_double(text, tally->highest);
    for (int k = 0; k < TRIAL_STATISTICS_POWERS; k++) {
        for (int i = 0; i < EXACT_ACCUMULATOR_DIGITS; i++) {
            growing_format(text, "%c%lld", i == 0 ? '\n' : ' ',
                           (long long)tally->powers[k].digits[i]);
        }
    }
    growing_string(text, "\n");
    for (size_t i = 0; tally->keeps && i < tally->count; i++) {
        put_double(text, tally->kept[i]);
    }
    for (size_t page = 0; page < PAGES && !tally->keeps; page++) {
        for (size_t i = 0; tally->pages[page] != NULL && i < PAGE_BINS; i++) {
            if (tally->pages[page][i] > 0) {
                growing_format(text, " %zu %lld", page * PAGE_BINS + i,
                               (long long)tally->pages[page][i]);
            }
        }
    }
    growing_string(text, "\n");
}

bool trial_statistics_take(struct text *line, int64_t *number)
{
    const struct text word = text_cut(line, ' ');
    char *end, copy[32];
    if (word.start == NULL || word.length == 0 || word.length >= sizeof copy) {
        return false;
    }
    memcpy(copy, word.start, word.length);
    copy[word.length] = '\0';
    *number = strtoll(copy, &end, 10);
    return *end == '\0';
}

static bool take_double(struct text *line, double *value)
{
    int64_t bits;
    if (!trial_statistics_take(line, &bits)) {
        return false;
    }
    memcpy(value, &bits, sizeof bits);
    return true;
}

/* What is kept, or bins and their counts. */
static bool read_figures(struct text *line, struct trial_statistics *more)
{
    bool read = true;
    uint64_t counted = 0;
    while (counted < more->count && read) {
        int64_t at, in_bin = 1;
        if (more->keeps) {
            read = take_double(line, &more->kept[counted]);
        } else {
            read = trial_statistics_take(line, &at) && trial_statistics_take(line, &in_bin) &&
                   at >= 0 && at < (int64_t)PAGES * PAGE_BINS && in_bin >= 1;
        }
        if (read && !more->keeps) {
            tally_page(more, (size_t)at / PAGE_BINS)[(size_t)at % PAGE_BINS] = (uint64_t)in_bin;
        }
        counted += (uint64_t)in_bin;
    }
    return read && counted == more->count && line->length == 0;
}

bool trial_statistics_read(struct text *rest, struct trial_statistics *tally)
{
    struct trial_statistics more;
    struct text line = text_cut(rest, '\n');
    const struct text word = text_cut(&line, ' ');
    int64_t count;
    if (!text_equal(word, "tally") || !trial_statistics_take(&line, &count) || count < 0) {
        return false;
    }
    const uint64_t room = (uint64_t)TRIAL_STATISTICS_KEPT;
    if (tally->keeps && (uint64_t)count + tally->count > room) {
        return false;
    }
    trial_statistics_open(tally->nominal, tally->keeps ? (uint64_t)count : room + 1, tally->arena,
                          &more);
    more.count = (uint64_t)count;
    bool read = take_double(&line, &more.lowest) && take_double(&line, &more.highest);
    for (int k = 0; k < TRIAL_STATISTICS_POWERS && read; k++) {
        line = text_cut(rest, '\n');
        for (int i = 0; i < EXACT_ACCUMULATOR_DIGITS && read; i++) {
            read = trial_statistics_take(&line, &more.powers[k].digits[i]);
        }
    }
    line = text_cut(rest, '\n');
    if (line.length > 0) {
        text_cut(&line, ' '); /* figures begin with one */
    }
    if (!read || !read_figures(&line, &more)) {
        return false;
    }
    trial_statistics_join(tally, &more);
    return true;
}
