/* tests/ceres/test_bundle.c - thick lenses of real ones: their limit, their terms, lost rays. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/bundle.h"
#include "design/thick.h"
#include "exchange/lens_db.h"

enum { FIELDS = 5 };

/* A check that prints figures when it fails. */
#define CHECK_TRUE(condition, ...)                                                                 \
    do {                                                                                           \
        bool good = (condition);                                                                   \
        check_at(good, __FILE__, __LINE__, #condition);                                            \
        if (!good) {                                                                               \
            printf(__VA_ARGS__);                                                                   \
            putchar('\n');                                                                         \
        }                                                                                          \
    } while (0)

struct subject {
    struct lens lens;
    struct first_order first;
    struct bundle bundle;
    struct thick_task task;
};

static const double wavelengths[] = {0.5875618};

/* Rays of a lens at an f-number, up to a field. */
static bool trace(const char *name, double fnumber, double field, bool no_clip, struct arena *arena,
                  struct subject *subject, struct error *error)
{
    struct lensdb db = {.arena = arena};
    struct lens all;
    double *fields = ARENA_ARRAY(arena, FIELDS, double);
    for (int i = 0; i < FIELDS; i++) {
        fields[i] = field * i / (FIELDS - 1);
    }
    if (!lens_db_find(&db, text_of(name), arena, &all, error)) {
        return false;
    }
    subject->lens = all;
    const struct conjugate_object object = lens_object(&subject->lens);
    const struct aperture_setting aperture = {APERTURE_FNUMBER, fnumber};
    if (!first_order_of_lens(&subject->lens, wavelengths[0], SECTION_Y, arena, &subject->first,
                             error) ||
        !first_order_aperture(&subject->first, &object, &aperture, FIELD_NONE, NAN, error)) {
        return false;
    }
    const struct bundle_request request = {.lens = &subject->lens,
                                           .first = &subject->first,
                                           .wavelengths = wavelengths,
                                           .wavelength_count = 1,
                                           .fields = fields,
                                           .field_count = FIELDS,
                                           .pattern = PATTERN_GAUSS,
                                           .ray_count = 36,
                                           .no_clip = no_clip};
    if (!bundle_trace(&request, arena, &subject->bundle, error)) {
        return false;
    }
    const struct first_order *first = &subject->first;
    subject->task = (struct thick_task){.rays = subject->bundle.rays,
                                        .group_count = 1,
                                        .index_object = subject->bundle.index_object,
                                        .index_image = subject->bundle.index_image,
                                        .planes = {first->image, first->exit_pupil},
                                        .plane_weights = {1, THICK_PUPIL_WEIGHT},
                                        .object = INFINITY,
                                        .start = {.focal = first->efl,
                                                  .front = first->front_principal,
                                                  .rear = first->rear_principal,
                                                  .index_object = 1,
                                                  .index_image = 1,
                                                  .object = INFINITY}};
    return true;
}

/*
 * With aperture and field shrunk together to the k-th part, the fit comes k^2 times nearer to the
 * paraxial lens: third-order aberrations are all that is left.
 */
static void test_limit(const char *name, double weight)
{
    struct arena arena = {0};
    double before[3] = {0};
    for (int k = 0; k < 5; k++) {
        struct subject subject;
        struct thick_fit fit;
        struct error error;
        double share = ldexp(1, -k);
        CHECK_TRUE(trace(name, 8 / share, 0.1 * share, true, &arena, &subject, &error), "%s", name);
        subject.task.plane_weights[1] = weight;
        CHECK_TRUE(thick_fit(&subject.task, &arena, &fit, &error), "%s", name);
        const double off[3] = {fit.parameters[0] - subject.first.efl,
                               fit.parameters[1] - subject.first.front_principal,
                               fit.parameters[2] - subject.first.rear_principal};
        for (int i = 0; i < 3 && k > 1; i++) {
            double ratio = before[i] / off[i];
            CHECK_TRUE(ratio > 3.7 && ratio < 4.3, "%s: %s at 1/%g: %g", name, fit.names[i],
                       1 / share, ratio);
        }
        CHECK_TRUE(k < 4 || fabs(off[0]) < 1e-3 * subject.first.efl, "%s: off by %g", name, off[0]);
        memcpy(before, off, sizeof off);
    }
    arena_free(&arena);
}

/* Terms of distortion and growth of the pupils never raise what they are to lower. */
static void test_terms(const char *name, double fnumber, double field)
{
    struct arena arena = {0};
    struct subject subject;
    struct error error;
    double before = INFINITY;
    CHECK_TRUE(trace(name, fnumber, field, false, &arena, &subject, &error), "%s", name);
    for (size_t terms = 0; terms <= THICK_DISTORTIONS; terms++) {
        struct thick_fit fit;
        subject.task.distortions = terms;
        CHECK_TRUE(thick_fit(&subject.task, &arena, &fit, &error), "%s: %zu terms", name, terms);
        double cost = fit.summary.final_cost;
        CHECK_TRUE(cost <= before * (1 + 1e-12), "%s: %zu terms: %g after %g", name, terms, cost,
                   before);
        before = cost;
    }
    for (int side = 0; side < 2; side++) {
        struct thick_pupil plain, growing;
        CHECK_TRUE(thick_fit_pupil(&subject.task.rays, side, false, &arena, &plain, &error) &&
                       thick_fit_pupil(&subject.task.rays, side, true, &arena, &growing, &error) &&
                       growing.rms <= plain.rms * (1 + 1e-12),
                   "%s: pupil %d", name, side);
    }
    arena_free(&arena);
}

/* Every ray wanted is there or counted as lost; without rims none is lost in a tame lens. */
static void test_counts(void)
{
    struct arena arena = {0};
    struct subject clipped, open, none;
    struct error error;
    CHECK_TRUE(trace("double-gauss", 2, 0.24, false, &arena, &clipped, &error), "clipped");
    CHECK_TRUE(trace("double-gauss", 2, 0.24, true, &arena, &open, &error), "open");
    const struct bundle *some = &clipped.bundle, *all = &open.bundle;
    CHECK_TRUE(some->rays.count + some->clipped + some->unreachable == some->wanted &&
                   some->lost_count == some->clipped + some->unreachable && some->clipped > 0,
               "%zu of %zu", some->rays.count, some->wanted);
    CHECK_TRUE(all->rays.count == all->wanted && all->lost_count == 0, "%zu of %zu",
               all->rays.count, all->wanted);
    double sum = 0, off = 0;
    for (size_t i = 0; i < all->rays.count; i++) {
        sum += all->rays.weight[i];
        /* rays of a distant point are parallel */
        off = fmax(off, fabs(all->rays.q[i] - tan(0.24 * (double)all->field[i] / (FIELDS - 1))));
    }
    CHECK_TRUE(fabs(sum - FIELDS) < 1e-12 && off < 1e-14, "weights %.17g, slopes %g", sum, off);
    /* beyond every rim: the reason is named */
    CHECK_TRUE(!trace("double-gauss", 2, 1.7, false, &arena, &none, &error) &&
                   strstr(error.message, "below 90") != NULL,
               "1.7 rad");
    arena_free(&arena);
}

int main(void)
{
    test_limit("double-gauss", THICK_PUPIL_WEIGHT);
    test_limit("double-gauss", 1);
    test_limit("cooke-triplet-50", 1);
    test_terms("double-gauss", 2.1, 0.24);
    test_terms("fisheye-16", 4, 1.1);
    test_counts();
    return check_report();
}
