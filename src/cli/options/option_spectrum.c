/* cli/options/option_spectrum.c - read a spectrum. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>
#include <string.h>

/* The eye by day: V of CIE 1924 (ISO 23539) in steps of 20 nm, where it is above 0.03. */
static const struct setup_wavelength photopic[] = {
    {0.45, 0.038}, {0.47, 0.09098}, {0.49, 0.20802}, {0.51, 0.503}, {0.53, 0.862}, {0.55, 0.99495},
    {0.57, 0.952}, {0.59, 0.757},   {0.61, 0.503},   {0.63, 0.265}, {0.65, 0.107},
};

/* The heaviest first, as the list of a lens has its primary one: waves and colours are told from
   it. Of several the one that was typed first. */
static void spectrum_lead(struct setup_wavelength *items, size_t count)
{
    size_t lead = 0;
    for (size_t i = 1; i < count; i++) {
        lead = items[i].weight > items[lead].weight ? i : lead;
    }
    const struct setup_wavelength heaviest = items[lead];
    memmove(items + 1, items, lead * sizeof *items);
    items[0] = heaviest;
}

static bool read_spectrum(const struct reader *reader, const struct option *option,
                          struct text text, void *member, struct error *error)
{
    struct spectrum_value value = {.text = arena_string(reader->arena, text.start, text.length)};
    if (text_same(text_trim(text), "photopic")) {
        struct setup_wavelength *items = ARENA_ARRAY(
            reader->arena, sizeof photopic / sizeof photopic[0], struct setup_wavelength);
        memcpy(items, photopic, sizeof photopic);
        value.items = items;
        value.count = sizeof photopic / sizeof photopic[0];
        spectrum_lead(items, value.count);
        *(struct spectrum_value *)member = value;
        return true;
    }
    struct setup_wavelength *items =
        ARENA_ARRAY(reader->arena, MOST_SPECTRUM, struct setup_wavelength);
    double sum = 0;
    for (struct text rest = text; rest.start != NULL; value.count++) {
        if (value.count == MOST_SPECTRUM) {
            return fail(error, ERROR_USAGE, "%s has more than %d wavelengths", CALLED(option),
                        MOST_SPECTRUM);
        }
        struct text weight = text_cut(&rest, ',');
        const struct text name = text_cut(&weight, ':');
        struct setup_wavelength *item = &items[value.count];
        item->weight = 1;
        if (!wavelength_read(reader, option, name, &item->wavelength, error)) {
            return false;
        }
        if (weight.start != NULL &&
            !quantity_read(weight, &dimension_number, NULL, &item->weight, NULL, error)) {
            return error_prefix(error, "bad weight in %s: ", CALLED(option));
        }
        if (!(item->weight >= 0 && isfinite(item->weight))) {
            return fail(error, ERROR_USAGE,
                        "%s has the weight %.*s: weights are finite and 0 or more",
                        TYPED(option, weight));
        }
        sum += items[value.count].weight;
    }
    value.items = items;
    spectrum_lead(items, value.count);
    *(struct spectrum_value *)member = value;
    return sum > 0 || fail(error, ERROR_USAGE, "%s has only weights of 0", CALLED(option));
}

const struct option_kind kind_spectrum = {
    .name = "spectrum",
    .size = sizeof(struct spectrum_value),
    .read = read_spectrum,
    .reads = READS_LENSDB,
};
