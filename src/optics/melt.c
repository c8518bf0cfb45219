/* optics/melt.c - a medium whose index and dispersion are a little off. */
/* SPDX-License-Identifier: MIT */
#include "optics/melt.h"

#include "base/number.h"
#include "optics/wavelength.h"

#include <math.h>

/* That of the base, kept from one call to the next. */
static bool base_index(struct melt *melt, double wavelength, struct pair *index,
                       struct error *error)
{
    for (int i = 0; i < melt->count; i++) {
        if (melt->wavelengths[i] == wavelength) {
            *index = melt->indices[i];
            return true;
        }
    }
    if (!medium_index(&melt->base, wavelength, index, error)) {
        return false;
    }
    if (melt->count < MELT_WAVELENGTHS) {
        melt->wavelengths[melt->count] = wavelength;
        melt->indices[melt->count++] = *index;
    }
    return true;
}

/* medium_index_function: the melt is that of one thread, and keeps what it has found. */
static bool melt_index(const void *glass, double wavelength, struct pair *index,
                       struct error *error)
{
    struct melt *melt = (struct melt *)glass;
    if (!base_index(melt, wavelength, index, error)) {
        return false;
    }
    const struct pair off = pair_subtract(*index, pair_of(melt->nd));
    const struct pair nd = pair_add(pair_of(melt->nd), pair_of(melt->by));
    *index = pair_add(nd, pair_multiply(off, pair_of(melt->scale)));
    return true;
}

void melt_open(const struct medium *base, struct melt *melt)
{
    struct pair d, f, c;
    struct error ignored;
    *melt = (struct melt){.base = *base, .scale = 1};
    melt->now = *base;
    melt->now.kind = MEDIUM_GLASS;
    melt->now.glass_index = melt_index;
    melt->now.glass = melt;
    if (base->kind == MEDIUM_CONSTANT || !medium_index(base, WAVELENGTH_D, &d, &ignored)) {
        return;
    }
    melt->nd = d.hi;
    if (medium_index(base, WAVELENGTH_F, &f, &ignored) &&
        medium_index(base, WAVELENGTH_C, &c, &ignored) && f.hi != c.hi) {
        melt->has_abbe = true;
        melt->Vd =
            base->kind == MEDIUM_MODEL ? base->abbe.hi : (melt->nd - 1) / pair_subtract(f, c).hi;
    }
}

const struct medium *melt_set(struct melt *melt, double index, double abbe)
{
    if (index == 0 && abbe == 0) {
        return &melt->base;
    }
    melt->by = index;
    melt->scale = 1;
    if (melt->has_abbe) {
        const double nd = melt->nd;
        melt->scale = (nd + index - 1) / (nd - 1) * (melt->Vd / (melt->Vd + abbe));
    }
    melt->now.index = pair_of(index); /* so that it is known from what it was before */
    melt->now.abbe = pair_of(abbe);
    return &melt->now;
}

static struct text melt_number_of(double value, struct arena *arena)
{
    char text[NUMBER_LENGTH];
    const char *end = number_write_shortest(text, value);
    return text_of(arena_string(arena, text, (size_t)(end - text)));
}

/* Its index at some wavelengths, which are rising. */
static struct text melt_table_of(struct melt *melt, const double *wavelengths, size_t count,
                                 struct arena *arena)
{
    const char *text = "{";
    double last = 0;
    for (size_t done = 0; done < count; done++) {
        double next = INFINITY;
        for (size_t i = 0; i < count; i++) {
            next = wavelengths[i] > last && wavelengths[i] < next ? wavelengths[i] : next;
        }
        struct pair n;
        struct error ignored;
        if (isinf(next) || !medium_index(&melt->now, next, &n, &ignored)) {
            break;
        }
        text = arena_printf(arena, "%s%s%sum %s", text, done > 0 ? ", " : "",
                            melt_number_of(next, arena).start, melt_number_of(n.hi, arena).start);
        last = next;
    }
    return text_of(arena_printf(arena, "%s}", text));
}

struct text melt_written(struct melt *melt, const double *wavelengths, size_t count,
                         struct arena *arena)
{
    const double n = melt->base.index.hi + melt->by;
    if (melt->base.kind == MEDIUM_CONSTANT) {
        return melt_number_of(n, arena);
    }
    if (melt->base.kind == MEDIUM_MODEL) {
        return text_of(arena_printf(arena, "%s/%s", melt_number_of(n, arena).start,
                                    melt_number_of(melt->Vd + melt->now.abbe.hi, arena).start));
    }
    return melt_table_of(melt, wavelengths, count, arena);
}
