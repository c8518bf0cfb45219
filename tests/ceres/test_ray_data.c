/* tests/ceres/test_ray_data.c - thick lenses of real ones: their limit, their terms, lost rays. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "subject.h"

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

/* Rays of a lens with the stop open to a diameter. */
static bool trace_rays(const char *name, double stop, double field, size_t rays,
                       struct arena *arena, struct subject *subject, struct error *error)
{
    const struct subject_rays wanted = {
        .aperture = {APERTURE_STOP, stop}, .field = field, .field_count = FIELDS, .rays = rays};
    return subject_open(name, &wanted, arena, subject, error);
}

/* Rays of a lens at an f-number, up to a field. */
static bool trace(const char *name, double fnumber, double field, bool no_clip, struct arena *arena,
                  struct subject *subject, struct error *error)
{
    const struct subject_rays wanted = {.aperture = {APERTURE_FNUMBER, fnumber},
                                        .field = field,
                                        .field_count = FIELDS,
                                        .rays = 36,
                                        .no_clip = no_clip};
    return subject_open(name, &wanted, arena, subject, error);
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

/*
 * Stopped down, a lens keeps its focal length: blur that gets small is not traded for distortion.
 * Expected is what an independent program says that finds focus, scale and pupil one after the
 * other: focus by the blur alone, then f and distortion by the centroids, then H by the exit pupil.
 * With terms of distortion f is 0.06 % below the paraxial one, for the mean focus of all fields
 * lies 0.07 mm before that of the axis.
 */
static void test_stopped_down(void)
{
    static const struct {
        const char *lens;
        double degrees, fnumber;
        size_t terms;
        double expected[3];
    } cases[] = {
        {"double-gauss", 14, 22, 0, {100.31193245, 48.580343, -28.17128840}},
        {"double-gauss", 14, 22, 2, {100.65123419, 48.267466, -28.51083086}},
        {"double-gauss", 14, 1000, 0, {100.31327360, 48.603012, -28.17161126}},
        {"double-gauss", 14, 1000, 2, {100.65179880, 48.290893, -28.51037318}},
        {"double-gauss", 14, 31000, 2, {100.65179880, 48.290893, -28.51037318}},
        {"wide-35", 38, 22, 0, {34.50369760, 24.568076, -11.95808605}},
        {"wide-35", 38, 22, 2, {34.83516622, 24.291550, -12.29179730}},
        {"wide-35", 38, 1000, 0, {34.50046329, 24.574084, -11.95856624}},
        {"wide-35", 38, 1000, 2, {34.83214422, 24.297414, -12.29252716}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct subject subject;
        struct thick_fit fit;
        struct error error;
        double field = cases[i].degrees / DEGREES_PER_RADIAN;
        CHECK_TRUE(trace(cases[i].lens, cases[i].fnumber, field, true, &arena, &subject, &error),
                   "%s", cases[i].lens);
        subject.task.distortions = cases[i].terms;
        CHECK_TRUE(thick_fit(&subject.task, &arena, &fit, &error), "%s", cases[i].lens);
        for (int k = 0; k < 3; k++) {
            /* weights of 100 and 1e-3 are not endless: 1e-4 of the residuals gets through */
            double off = fit.parameters[k] - cases[i].expected[k];
            CHECK_TRUE(fabs(off) < 2e-6 * subject.first.efl, "%s f/%g, %zu terms: %s %.9g",
                       cases[i].lens, cases[i].fnumber, cases[i].terms, fit.names[k],
                       fit.parameters[k]);
        }
        arena_free(&arena);
    }
}

/* On the axis, at f/1000, it is the paraxial lens: all three within 1e-4 of f. */
static void test_axis(const char *name)
{
    struct arena arena = {0};
    struct subject subject;
    struct thick_fit fit;
    struct error error;
    CHECK_TRUE(trace(name, 1000, 0.01, true, &arena, &subject, &error), "%s", name);
    for (size_t terms = 0; terms < 3; terms++) {
        const struct first_order *first = &subject.first;
        subject.task.distortions = terms;
        CHECK_TRUE(thick_fit(&subject.task, &arena, &fit, &error), "%s", name);
        const double off[3] = {fit.parameters[0] - first->efl,
                               fit.parameters[1] - first->front_principal,
                               fit.parameters[2] - first->rear_principal};
        for (int i = 0; i < 3; i++) {
            CHECK_TRUE(fabs(off[i]) < 1e-4 * fabs(first->efl), "%s, %zu terms: %s off by %g", name,
                       terms, fit.names[i], off[i]);
        }
    }
    arena_free(&arena);
}

/* Terms of distortion and spherical aberration of the pupils never raise what they are to lower. */
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
        struct thick_pupil_sums sums = {.rows = 0};
        thick_pupil_add(&subject.rays, side, &sums);
        CHECK_TRUE(thick_fit_pupil(&sums, side, false, &arena, &plain, &error) &&
                       thick_fit_pupil(&sums, side, true, &arena, &growing, &error) &&
                       growing.rms <= plain.rms * (1 + 1e-12),
                   "%s: pupil %d", name, side);
    }
    arena_free(&arena);
}

/* Every ray wanted is there or counted as lost; unclipped none is lost in a tame lens. */
static void test_counts(void)
{
    struct arena arena = {0};
    struct subject clipped, open, none;
    struct error error;
    const struct subject_rays even = {.aperture = {APERTURE_FNUMBER, 2},
                                      .field = 0.24,
                                      .field_count = FIELDS,
                                      .pattern = PATTERN_HEXAPOLAR,
                                      .rays = 36};
    CHECK_TRUE(subject_open("double-gauss", &even, &arena, &clipped, &error), "clipped");
    CHECK_TRUE(trace("double-gauss", 2, 0.24, true, &arena, &open, &error), "open");
    const struct ray_data *some = &clipped.ray_data, *all = &open.ray_data;
    CHECK_TRUE(some->count + some->clipped + some->unreachable == some->wanted &&
                   clipped.lost_count == some->clipped + some->unreachable && some->clipped > 0,
               "%zu of %zu", some->count, some->wanted);
    CHECK_TRUE(all->count == all->wanted && open.lost_count == 0, "%zu of %zu", all->count,
               all->wanted);
    double sum = 0, off = 0;
    for (size_t i = 0; i < open.rays.count; i++) {
        sum += open.rays.weight[i];
        /* rays of a distant point are parallel */
        off = fmax(off, fabs(open.rays.q[i] - tan(0.24 * (double)open.field[i] / (FIELDS - 1))));
    }
    /* 36 rays integrate the aberrations of the pupil to 3e-6 */
    CHECK_TRUE(fabs(sum / FIELDS - 1) < 3e-6 && off < 1e-14, "weights %.17g, slopes %g", sum, off);
    /* beyond every clear aperture: the reason is named */
    CHECK_TRUE(!trace("double-gauss", 2, 1.7, false, &arena, &none, &error) &&
                   strstr(error.message, "below 90") != NULL,
               "1.7 rad");
    arena_free(&arena);
}

/* The spot of the largest field in the paraxial image plane about its centroid, um. */
static double spot(const struct subject *subject, double *clear)
{
    const struct thick_rays *rays = &subject->rays;
    double z = subject->first.image, sum = 0, mean[2] = {0, 0}, squares = 0;
    for (size_t i = 0; i < rays->count; i++) {
        double w = subject->field[i] == FIELDS - 1 ? rays->weight[i] : 0;
        double x = rays->x_out[i] + z * rays->p_out[i], y = rays->y_out[i] + z * rays->q_out[i];
        sum += w;
        mean[0] += w * x;
        mean[1] += w * y;
        squares += w * (x * x + y * y);
    }
    *clear = sum;
    return 1000 * sqrt(squares / sum - (mean[0] * mean[0] + mean[1] * mean[1]) / (sum * sum));
}

/*
 * Vignetted spots of stops at their full diameters, by an independent program: edges by bisection,
 * corners by bisection, Gauss's rule between them, 1152 and 3240 rays. The double Gauss has two
 * corners at 10 and 14 degrees, the wide angle six at 38, by four clear apertures.
 */
static void test_vignetting(void)
{
    static const struct {
        const char *lens;
        double degrees, stop, spot, clear, tolerance;
        size_t rays;
    } cases[] = {
        {"double-gauss", 14, 34.2, 74.598699, 0.5904204857, 1e-5, 72},
        {"double-gauss", 14, 34.2, 74.598699, 0.5904204857, 2e-8, 500},
        {"double-gauss", 10, 34.2, 63.1374113, 0.7326061416, 1e-5, 72},
        {"wide-35", 38, 13.93, 118.55858, 0.5590407884, 3e-4, 72},
        {"wide-35", 38, 13.93, 118.55858, 0.5590407884, 1e-7, 1000},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct subject subject;
        struct error error;
        double clear;
        CHECK_TRUE(trace_rays(cases[i].lens, cases[i].stop, cases[i].degrees / DEGREES_PER_RADIAN,
                              cases[i].rays, &arena, &subject, &error),
                   "%s", cases[i].lens);
        double found = spot(&subject, &clear);
        CHECK_TRUE(fabs(found / cases[i].spot - 1) < cases[i].tolerance, "%s %g: %.9g um",
                   cases[i].lens, cases[i].degrees, found);
        CHECK_TRUE(fabs(clear - cases[i].clear) < 2 * cases[i].tolerance &&
                       fabs(clear - subject.ray_data.clear[FIELDS - 1]) < 1e-14,
                   "%s %g: %.10g of the stop", cases[i].lens, cases[i].degrees, clear);
        CHECK_TRUE(subject.lost_count == 0, "%zu rays lost", subject.lost_count);
        arena_free(&arena);
    }
}

/* A stop smaller than the colours of its picture lie apart is filled by each of them. */
static void test_colours(void)
{
    const struct subject_rays white = {.aperture = {APERTURE_FNUMBER, 5000},
                                       .field = 0.24,
                                       .field_count = FIELDS,
                                       .rays = 36,
                                       .is_white = true};
    struct arena arena = {0};
    struct subject subject;
    struct error error;
    double sums[3] = {0};
    CHECK_TRUE(subject_open("double-gauss", &white, &arena, &subject, &error), "white");
    const struct thick_rays *rays = &subject.rays;
    for (size_t i = 0; i < rays->count; i++) {
        sums[rays->group[i]] += rays->weight[i];
        CHECK_TRUE(hypot(rays->stop_x[i], rays->stop_y[i]) < 1, "a ray beyond the stop");
    }
    for (int g = 0; g < 3; g++) {
        CHECK_TRUE(fabs(sums[g] / FIELDS - 1) < 1e-8, "colour %d: %.10g", g, sums[g]);
    }
    arena_free(&arena);
}

/*
 * Without a stop rays go through the points of a disc in the plane of the first vertex, from far
 * and from near: as many to all sides, and as far along x as along y.
 */
static void test_no_stop(void)
{
    static const char *const texts[] = {"surface 50 4 1.5 -\nsurface -50 45 air -\n",
                                        "object 200\nsurface 50 4 1.5 -\nsurface -50 60 air -\n"};
    for (int k = 0; k < 2; k++) {
        struct arena arena = {0};
        struct subject subject = {.rays = {.count = 0}};
        struct error error;
        CHECK_TRUE(lens_read("test.lens", text_of(texts[k]), NULL, &arena, &subject.lens, &error),
                   "lens %d", k);
        const struct subject_rays wanted = {.aperture = {APERTURE_EPD, 6},
                                            .field = 0.2,
                                            .field_count = 2,
                                            .pattern = PATTERN_HEXAPOLAR,
                                            .rays = 36,
                                            .no_clip = true};
        CHECK_TRUE(subject_make(&wanted, &arena, &subject, &error), "%s", error.message);
        const struct thick_rays *rays = &subject.rays;
        double sums[2][3] = {{0}}, weights[2] = {0}, largest = 0;
        for (size_t i = 0; i < rays->count; i++) {
            const size_t f = subject.field[i];
            const double w = rays->weight[i], x = rays->x[i], y = rays->y[i];
            weights[f] += w;
            sums[f][0] += w * x;
            sums[f][1] += w * y;
            sums[f][2] += w * (x * x - y * y);
            largest = fmax(largest, hypot(x, y));
        }
        for (int f = 0; f < 2; f++) {
            for (int m = 0; m < 3; m++) {
                CHECK_TRUE(fabs(sums[f][m] / weights[f]) < 1e-12, "%d, field %d: moment %d is %g",
                           k, f, m, sums[f][m]);
            }
        }
        CHECK_TRUE(largest <= 3 + 1e-12 && largest > 2.5, "%d: up to %.15g", k, largest);
        arena_free(&arena);
    }
}

int main(void)
{
    test_no_stop();
    test_vignetting();
    test_limit("double-gauss", THICK_PUPIL_WEIGHT);
    test_limit("double-gauss", 1);
    test_limit("cooke-triplet-50", 1);
    test_stopped_down();
    test_axis("double-gauss");
    test_axis("wide-35");
    test_axis("cooke-triplet-50");
    test_axis("fisheye-16");
    test_terms("double-gauss", 2.1, 0.24);
    test_terms("fisheye-16", 4, 1.1);
    test_counts();
    test_colours();
    return check_report();
}
