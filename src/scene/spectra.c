/* scene/spectra.c - the spectra of a scene as numbers in bands, each different one summed once. */
/* SPDX-License-Identifier: MIT */
#include "scene/spectra.h"

#include "light/bands_match.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* What tells spectra apart, bit by bit; a table is where its rows lie. */
struct spectrum_key {
    uint64_t kind, parts[3];
};

/* A spectrum that is new. */
static bool banded_open(const struct bands *bands, const struct spectrum *spectrum, bool is_surface,
                        struct banded *banded, struct error *error)
{
    if (is_surface) {
        return bands_of_surface(bands, spectrum, banded->of, &banded->held, error);
    }
    if (!bands_of_light(bands, spectrum, banded->of, &banded->held, error)) {
        return false;
    }
    banded->off = bands->count > 3 ? bands_off(bands, spectrum, banded->of) : 0;
    return true;
}

static const struct banded *spectra_find(struct spectra *spectra, const struct spectrum *spectrum,
                                         bool is_surface, const struct typed_place *place,
                                         struct error *error)
{
    struct spectrum_key key = {2 * (uint64_t)spectrum->kind + (is_surface ? 1 : 0), {0}};
    switch (spectrum->kind) {
    case SPECTRUM_RGB:
        memcpy(key.parts, spectrum->rgb, sizeof key.parts);
        break;
    case SPECTRUM_TABLE:
        key.parts[0] = spectrum->count;
        key.parts[1] = (uint64_t)(uintptr_t)spectrum->wavelength;
        key.parts[2] = (uint64_t)(uintptr_t)spectrum->value;
        break;
    default:
        memcpy(key.parts, &spectrum->kelvin, sizeof spectrum->kelvin);
        break;
    }
    struct arena *arena = spectra->arena;
    struct name_table *index = &spectra->index;
    const size_t known = name_table_find(index, (struct text){(const char *)&key, sizeof key});
    if (known != NAME_NONE) {
        return spectra->list[known];
    }
    struct banded *banded = ARENA_NEW(arena, struct banded);
    if (!banded_open(spectra->bands, spectrum, is_surface, banded, error)) {
        error_locate(error, place->source, place->line, place->column);
        return NULL;
    }
    struct spectrum_key *kept = ARENA_NEW(arena, struct spectrum_key);
    *kept = key;
    spectra->list =
        arena_grow(arena, spectra->list, index->count, &spectra->room, sizeof spectra->list[0]);
    spectra->list[index->count] = banded;
    name_table_add(index, (struct text){(const char *)kept, sizeof *kept}, arena);
    return banded;
}

const struct banded *spectra_light(struct spectra *spectra, const struct spectrum *light,
                                   const struct typed_place *place, struct error *error)
{
    return spectra_find(spectra, light, false, place, error);
}

const struct banded *spectra_surface(struct spectra *spectra, const struct spectrum *surface,
                                     const struct typed_place *place, struct error *error)
{
    return spectra_find(spectra, surface, true, place, error);
}
