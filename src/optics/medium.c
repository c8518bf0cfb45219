/* optics/medium.c - the index of refraction of a medium. */
/* SPDX-License-Identifier: MIT */
#include "optics/medium.h"

#include "base/number.h"
#include "optics/glass.h"
#include "optics/wavelength.h"

#include <math.h>

const struct medium medium_air = {.kind = MEDIUM_CONSTANT, .written = {"air", 3}, .index = {1, 0}};

bool medium_is_air(const struct medium *medium)
{
    return medium->kind == MEDIUM_CONSTANT && medium->index.hi == 1 && medium->index.lo == 0;
}

bool medium_is_same(const struct medium *a, const struct medium *b)
{
    return a->kind == b->kind && text_identical(a->written, b->written);
}

static struct pair medium_inverse_square(double wavelength)
{
    return pair_divide(pair_of(1), pair_product(wavelength, wavelength));
}

static bool table_index(const struct medium *medium, double wavelength, struct pair *index,
                        struct error *error)
{
    enum { NEAREST = 3 };
    const struct index_point *points = medium->points;
    size_t count = medium->point_count, first = 0;
    if (count > 1 &&
        !(wavelength >= points[0].wavelength && wavelength <= points[count - 1].wavelength)) {
        return fail(error, ERROR_DOMAIN,
                    "%.7g nm is outside the table %.*s, which reaches from %.7g to %.7g nm",
                    1000 * wavelength, (int)medium->written.length, medium->written.start,
                    1000 * points[0].wavelength, 1000 * points[count - 1].wavelength);
    }
    while (count > NEAREST) {
        bool drop_first = fabs(points[first].wavelength - wavelength) >
                          fabs(points[first + count - 1].wavelength - wavelength);
        first += drop_first;
        count--;
    }
    /* Lagrange's polynomial in 1/l^2. */
    const struct index_point *near = points + first;
    struct pair x = medium_inverse_square(wavelength), sum = {0, 0};
    for (size_t i = 0; i < count; i++) {
        struct pair term = near[i].index, x_i = medium_inverse_square(near[i].wavelength);
        for (size_t j = 0; j < count; j++) {
            struct pair x_j = medium_inverse_square(near[j].wavelength);
            if (j != i) {
                term = pair_multiply(term,
                                     pair_divide(pair_subtract(x, x_j), pair_subtract(x_i, x_j)));
            }
        }
        sum = pair_add(sum, term);
    }
    *index = sum;
    return true;
}

/* um: no glass is clear below, and A + B/l^2 grows beyond all bounds */
static const double shortest_of_model = 0.1;

bool medium_index(const struct medium *medium, double wavelength, struct pair *index,
                  struct error *error)
{
    bool done = true;
    if (medium->kind == MEDIUM_CONSTANT) {
        *index = medium->index;
    } else if (medium->kind == MEDIUM_MODEL && wavelength < shortest_of_model) {
        done = fail(error, ERROR_DOMAIN,
                    "the model glass %.*s has no index at %.7g nm: nd and Vd say nothing of light "
                    "below %.3g nm",
                    (int)medium->written.length, medium->written.start, 1000 * wavelength,
                    1000 * shortest_of_model);
    } else if (medium->kind == MEDIUM_MODEL) {
        const struct glass model = glass_nd_vd(medium->index, medium->abbe);
        *index = glass_index(&model, pair_of(wavelength)).n;
    } else if (medium->kind == MEDIUM_TABLE) {
        done = table_index(medium, wavelength, index, error);
    } else if (medium->glass_index == NULL) {
        done = fail(error, ERROR_DOMAIN, "glass '%.*s' is in no catalogue of this program",
                    (int)medium->written.length, medium->written.start);
    } else {
        done = medium->glass_index(medium->glass, wavelength, index, error);
    }
    if (done && isnan(index->hi)) {
        return fail(error, ERROR_DOMAIN, "the formula of %.*s gives no number at %.7g nm",
                    (int)medium->written.length, medium->written.start, 1000 * wavelength);
    }
    if (done && !(index->hi > 0)) {
        return fail(error, ERROR_DOMAIN, "the index of %.*s at %.7g nm is %.6g: not above 0",
                    (int)medium->written.length, medium->written.start, 1000 * wavelength,
                    index->hi);
    }
    return done;
}

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
    *index = pair_add(pair_add(pair_of(melt->nd), pair_of(melt->by)),
                      pair_multiply(off, pair_of(melt->scale)));
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
