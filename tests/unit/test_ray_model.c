/* tests/unit/test_ray_model.c - models that take rays in and give rays out, against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/model/benchmark.h"
#include "analysis/model/model_sums.h"
#include "base/constants.h"
#include "double_gauss.h"
#include "lens_of.h"
#include "optics/wavelength.h"

#define TRIPLET                                                                                    \
    "object inf\n"                                                                                 \
    "aperture epd 10\n"                                                                            \
    "field angle 20\n"                                                                             \
    "surface 22.01359 3.25896 1.62041/60.32 19\n"                                                  \
    "surface -435.76044 6.00755 air 18\n"                                                          \
    "surface -22.21328 0.99998 1.62004/36.37 11\n"                                                 \
    "surface 20.29192 2.2 air 10\n"                                                                \
    "surface - 2.55041 air 10 stop\n"                                                              \
    "surface 79.68360 2.95208 1.62041/60.32 15\n"                                                  \
    "surface -18.39533 42.20778 air 16\n"

/* A lens ready to be asked, its image plane so far behind the paraxial one. */
static struct setup setup_of(const char *text, double defocus, struct arena *arena)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct setup setup = {0};
    struct error error = {.code = ERROR_NONE};
    *lens = lens_of(text, arena);
    const struct setup_question question = {
        .lens = lens, .wavelength = WAVELENGTH_D, .fnumber = NAN, .field_policy = FIELDS_ALL};
    bool found = setup_open(&question, arena, &setup, &error) &&
                 setup_place_image(&setup, &(struct plane_value){.kind = PLANE_PARAXIAL}, &error);
    CHECK(found);
    if (!found) {
        printf("%s\n", error.message);
    }
    setup.image += defocus;
    return setup;
}

/* One ray through a model: from a place in the plane of the first vertex, by its slopes. */
static struct ray ray_through(const struct ray_model *model, double x, double y, double p, double q,
                              struct arena *arena)
{
    const struct rays rays = rays_new(arena, 1);
    const double r = 1 / sqrt(1 + p * p + q * q);
    rays_set(&rays, 0, 1, &(struct ray){.point = {x, y, 0}, .cosine = {p * r, q * r, r}});
    ray_model_trace(model, &rays, NULL);
    return rays_get(&rays, 0, 1);
}

static struct ray_model model_of(const struct setup *setup, enum lens_model kind,
                                 struct arena *arena)
{
    struct ray_model model;
    struct error error = {.code = ERROR_NONE};
    const bool found = ray_model_open(setup, kind, arena, &model, &error);
    CHECK(found);
    if (!found) {
        printf("%s\n", error.message);
    }
    return model;
}

/* x' = h + (z - H') p', p' = p - h/f, h = x + H p: by hand. */
static void test_thick(struct arena *arena)
{
    const struct setup setup = {.image = 46};
    const struct thick_lens thick = {.focal = 50,
                                     .front = 3,
                                     .rear = -4,
                                     .index_object = 1,
                                     .index_image = 1,
                                     .object = INFINITY};
    const struct ray_model model = ray_model_of_thick(MODEL_FITTED, thick, setup.image);
    const struct ray ray = ray_through(&model, 5, -2, 0.1, 0.2, arena);
    const double h = 5 + 3 * 0.1, k = -2 + 3 * 0.2, p = 0.1 - h / 50, q = 0.2 - k / 50;
    CHECK_NEAR(ray.point[0], h + 50 * p, 1e-13, "x in the focal plane");
    CHECK_NEAR(ray.point[0], 5, 1e-13, "which is f tan t");
    CHECK_NEAR(ray.point[1], k + 50 * q, 1e-13, "y");
    CHECK_NEAR(ray.cosine[0] / ray.cosine[2], p, 1e-15, "slope");
    CHECK_NEAR(ray.cosine[1] / ray.cosine[2], q, 1e-15, "slope");
    /* near object, 100 mm before the first vertex: its image is at the height -h f/(s - f) */
    struct ray_model hole = ray_model_of_thick(MODEL_FITTED, thick, setup.image);
    hole.kind = MODEL_PINHOLE;
    hole.thick.object = 100;
    const struct ray one = ray_through(&hole, 5, 0, 0.01, 0, arena);
    const struct ray other = ray_through(&hole, -2, 0, -0.06, 0, arena); /* of the same point */
    CHECK_NEAR(one.point[0], other.point[0], 1e-14, "all rays of a point pass the hole alike");
    CHECK_NEAR(one.point[0], -4 * 50 / 103.0, 1e-14, "as through a hole in H");
}

/* The paraxial model is the (y, v) trace, and thick and thin lenses focus as it does. */
static void test_paraxial(struct arena *arena)
{
    const struct setup setup =
        setup_of("object inf\naperture stop\nfield angle 14\n" DOUBLE_GAUSS("34.2"), 0.3, arena);
    struct setup_light light;
    struct error error;
    struct paraxial_ray rays[16];
    CHECK(setup_light(&setup, 0, &light, &error));
    const double y = 7, v = 0.12;
    paraxial_follow(&light.system, pair_of(y), pair_of(v), rays);
    const struct paraxial_ray *last = &rays[light.system.count - 1];
    const double expected = last->y + setup.image * last->after;
    const struct ray_model paraxial = model_of(&setup, MODEL_PARAXIAL, arena);
    const struct ray_model thick = model_of(&setup, MODEL_THICK, arena);
    CHECK_NEAR(ray_through(&paraxial, 0, y, 0, v, arena).point[1], expected, 1e-12, "paraxial");
    CHECK_NEAR(ray_through(&thick, 0, y, 0, v, arena).point[1], expected, 1e-12, "thick");
    CHECK_NEAR(ray_through(&thick, y, 0, v, 0, arena).point[0], expected, 1e-12, "thick in x");
    /* in focus all that counts of a distant object is f and the image plane */
    const struct setup sharp =
        setup_of("object inf\naperture stop\nfield angle 14\n" DOUBLE_GAUSS("34.2"), 0, arena);
    const struct ray_model in_focus = model_of(&sharp, MODEL_THIN, arena);
    CHECK_NEAR(ray_through(&in_focus, 0, y, 0, v, arena).point[1], light.first.efl * v, 1e-12,
               "thin");
}

/*
 * Transverse aberrations are the Seidel sums over 2 q: of the Cooke triplet by an independent
 * program in 50-digit arithmetic, as in test_seidel.c, at the edge of pupil and field.
 */
static void test_third_order(struct arena *arena)
{
    static const double S[5] = {0.007144071791981834, -0.003135467500652544, -0.007878254434858888,
                                0.02582761117800027, -0.0018327709421573737};
    const double q2 = 2 * -0.09995736451743377, slope = tan(20 * PI / 180);
    const struct setup setup = setup_of(TRIPLET, 0, arena);
    const struct ray_model model = model_of(&setup, MODEL_SEIDEL, arena);
    const struct ray_model paraxial = model_of(&setup, MODEL_PARAXIAL, arena);
    const double ent = setup.first.entrance_pupil, radius = 5;
    const struct {
        double x, y, field; /* of the pupil, of the field */
        double dx, dy;
        const char *name;
    } cases[] = {
        {0, 1, 0, 0, S[0], "spherical aberration"},
        {0, 0, 1, 0, S[4], "distortion"},
        {0, 1, 1, 0, S[0] + 3 * S[1] + 3 * S[2] + S[3] + S[4], "tangential ray"},
        {1, 0, 1, S[0] + S[2] + S[3], S[1] + S[4], "sagittal ray"},
        {0, -1, 1, 0, -S[0] + 3 * S[1] - 3 * S[2] - S[3] + S[4], "the lower one"},
        {0, 0.5, 1, 0, S[0] / 8 + 3 * S[1] / 4 + (3 * S[2] + S[3]) / 2 + S[4], "half way"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double p = cases[i].field * slope;
        const double x = radius * cases[i].x, y = radius * cases[i].y - ent * p;
        const struct ray out = ray_through(&model, x, y, 0, p, arena);
        const struct ray line = ray_through(&paraxial, x, y, 0, p, arena);
        CHECK_NEAR(out.point[0] - line.point[0], cases[i].dx / q2, 1e-12, cases[i].name);
        CHECK_NEAR(out.point[1] - line.point[1], cases[i].dy / q2, 1e-12, cases[i].name);
    }
    /* what is left is of the fifth order, also out of focus; paraxial rays leave the third */
    const struct setup near = setup_of(TRIPLET, 1e-4, arena);
    const struct ray_model exact = model_of(&near, MODEL_EXACT, arena);
    const struct ray_model third = model_of(&near, MODEL_SEIDEL, arena);
    double off[3];
    for (int k = 0; k < 3; k++) {
        const double share = 0.1 / (1 << k), p = share * slope;
        const double x = 0.6 * share * radius, y = 0.7 * share * radius - ent * p;
        const struct ray real = ray_through(&exact, x, y, 0, p, arena);
        const struct ray by = ray_through(&third, x, y, 0, p, arena);
        off[k] = hypot(real.point[0] - by.point[0], real.point[1] - by.point[1]);
    }
    CHECK(off[0] > 1e-9);
    CHECK_NEAR(log2(off[0] / off[1]), 5, 0.1, "order of what the third order leaves");
    CHECK_NEAR(log2(off[1] / off[2]), 5, 0.3, "order of what the third order leaves");
}

/* A parabola sends all rays along its axis to its focus: in 53, 64 and 113 bits. */
static void test_exact(struct arena *arena)
{
    const struct setup setup = setup_of("object inf\naperture epd 40\nfield angle 0\n"
                                        "surface -200 -100 mirror - k=-1 stop\n",
                                        0, arena);
    /* where long double has 53 bits, as under valgrind, it is no better than double */
    volatile long double one = 1, little = 0x1p-60L;
    const double allowed[] = {1e-13, one + little > one ? 1e-17 : 1e-13, 1e-31};
    static const enum lens_model kinds[] = {MODEL_EXACT, MODEL_EXACT_64, MODEL_EXACT_113};
    for (size_t i = 0; i < 3; i++) {
        const struct ray_model model = model_of(&setup, kinds[i], arena);
        const struct rays rays = rays_new(arena, 2);
        double low[2][2];
        rays_set(&rays, 0, 1, &(struct ray){.point = {12, 16, -50}, .cosine = {0, 0, 1}});
        rays_set(&rays, 1, 1, &(struct ray){.point = {-3, 1, -50}, .cosine = {0, 0, 1}});
        ray_model_trace(&model, &rays, low);
        for (size_t k = 0; k < 2; k++) {
            const struct ray ray = rays_get(&rays, k, 1);
            CHECK_NEAR(ray.point[0] + low[k][0], 0, allowed[i], "x in the focus");
            CHECK_NEAR(ray.point[1] + low[k][1], 0, allowed[i], "y in the focus");
        }
    }
}

/* A lens that is a polynomial comes out as what it is, term by term. */
static void test_polynomial(struct arena *arena)
{
    enum { COUNT = 300 };
    const struct rays before = rays_new(arena, COUNT), after = rays_new(arena, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const double t = (double)i, x = 4 * sin(1.7 * t), y = 3 * cos(2.9 * t + 1);
        const double L = 0.3 * sin(0.7 * t * t), M = 0.4 * cos(1.1 * t),
                     N = sqrt(1 - L * L - M * M);
        /* the plane of w is 2 mm behind the first vertex; rays start elsewhere on their lines */
        const double way = 5 * sin(t);
        const double w[2] = {x * N, y * N}, h[2] = {L / (1 + N), M / (1 + N)};
        const double ww = w[0] * w[0] + w[1] * w[1], wh = w[0] * h[0] + w[1] * h[1];
        const double a = -3 + 0.01 * ww, b = 100 + 0.2 * wh;
        rays_set(
            &before, i, 1,
            &(struct ray){.point = {x + way * L, y + way * M, 2 + way * N}, .cosine = {L, M, N}});
        rays_set(&after, i, 1,
                 &(struct ray){.point = {a * w[0] + b * h[0], a * w[1] + b * h[1], 0},
                               .cosine = {-0.01 * w[0] + h[0], -0.01 * w[1] + h[1], 1}});
    }
    struct ray_polynomial polynomial;
    struct error error;
    const struct ray_polynomial_task task = {.before = &before,
                                             .after = &after,
                                             .degree = 5,
                                             .terms = 20,
                                             .pupil = 2,
                                             .index = 1,
                                             .index_last = 1};
    CHECK(ray_polynomial_fit(&task, arena, &polynomial, &error));
    CHECK(polynomial.rms < 1e-11);
    const double s = polynomial.length;
    double found[4] = {0, 0, 0, 0}, rest = 0;
    for (size_t k = 0; k < polynomial.place.count; k++) {
        const struct ray_term *term = &polynomial.place.terms[k];
        const int kind = term->power[0] + 4 * term->power[1] + 16 * term->power[2];
        if (kind == 0) {
            found[term->of_h] = term->coefficient;
        } else if (kind == 1 && !term->of_h) {
            found[2] = term->coefficient;
        } else if (kind == 4 && term->of_h) {
            found[3] = term->coefficient;
        } else {
            rest = fmax(rest, fabs(term->coefficient));
        }
    }
    CHECK_NEAR(found[0], -3 * s, 1e-9, "w");
    CHECK_NEAR(found[1], 100, 1e-9, "h");
    CHECK_NEAR(found[2], 0.01 * s * s * s, 1e-9, "w (w.w)");
    CHECK_NEAR(found[3], 0.2 * s, 1e-9, "h (w.h)");
    CHECK(rest < 1e-9);
    CHECK(polynomial.direction.count <= 4);
    ray_polynomial_trace(&polynomial, &before);
    for (size_t i = 0; i < COUNT; i++) {
        const struct ray out = rays_get(&before, i, 1), wanted = rays_get(&after, i, 1);
        CHECK_NEAR(out.point[0], wanted.point[0], 1e-10, "x");
        CHECK_NEAR(out.cosine[1], wanted.cosine[1], 1e-12, "M");
    }
    struct ray_polynomial_task wrong = task;
    wrong.degree = 4;
    CHECK(!ray_polynomial_fit(&wrong, arena, &polynomial, &error));
}

/* Spots, light and focus of an ideal lens behind its stop. */
static void test_sums(struct arena *arena)
{
    const double f = 50, radius = 8, off = 0.25;
    struct setup setup = setup_of("object inf\naperture epd 16\nfield angle 0\n"
                                  "surface - 0 air 16 stop\n"
                                  "thick 50 0 air -\n",
                                  off, arena);
    const struct ray_model model = model_of(&setup, MODEL_THICK, arena);
    const double expected[MODEL_SUMS] = {[MODEL_SUM_SPOT] = off * radius / f / sqrt(2),
                                         [MODEL_SUM_FOCUS] = f,
                                         [MODEL_SUM_IRRADIANCE] =
                                             PI * radius * radius / (radius * radius + f * f)};
    for (enum model_sum sum = 0; sum < MODEL_SUMS; sum++) {
        const struct model_sum_question question = {
            .setup = &setup, .sum = sum, .rays = 60, .clip = true, .frequency = 5};
        struct arena work = {0};
        struct model_rays rays;
        struct error error;
        double value, exact;
        CHECK(model_rays_make(&question, setup.fields, 1, &work, &rays, &error));
        model_sum_of_model(&question, &model, &rays, 1, &value);
        CHECK(model_sum_find(&question, &work, &exact, &error));
        if (sum == MODEL_SUM_CONTRAST) {
            /* of a uniform disc 2 J1(k a)/(k a), k = 2 pi frequency */
            const double ka = 2 * PI * 5 * off * radius / f;
            double term = 1, airy = 0;
            for (int m = 0; m < 20; m++) {
                airy += term;
                term *= -ka * ka / 4 / ((m + 1) * (m + 2));
            }
            CHECK_NEAR(value, fabs(airy), 1e-10, "contrast");
            CHECK_NEAR(exact, value, 1e-10, "the same by exact rays");
        } else {
            const double within = sum == MODEL_SUM_IRRADIANCE ? 3e-7 : 1e-12;
            CHECK_RELATIVE(value, expected[sum], within, "a sum");
            CHECK_RELATIVE(exact, expected[sum], within, "exact");
        }
        arena_free(&work);
    }
}

/* What every turn takes as long for, whatever it does: the front is the least error alone. */
static double clock_made_up(void)
{
    static double now;
    return now += 1;
}

/* All ways of every quantity: exact ones are exact, and the simple are in their order. */
static void test_benchmark(struct arena *arena)
{
    const struct setup setup = setup_of(TRIPLET, 0, arena);
    struct timing_plan plan = timing_plan_default();
    plan.clock = clock_made_up;
    for (enum benchmark_quantity quantity = 0; quantity < BENCHMARK_QUANTITIES; quantity++) {
        const struct benchmark_question question = {.setup = &setup,
                                                    .quantity = quantity,
                                                    .clip = true,
                                                    .frequency = 10,
                                                    .unfitted = "none",
                                                    .timing = &plan};
        struct arena work = {0};
        struct benchmark benchmark;
        struct error error = {.code = ERROR_NONE};
        CHECK(benchmark_run(&question, &work, &benchmark, &error));
        int best = 0, precise = 0;
        double least = INFINITY, pinhole = NAN, polynomial = NAN, exact = NAN;
        for (size_t i = 0; i < benchmark.count; i++) {
            const struct benchmark_way *way = &benchmark.ways[i];
            const bool is_exact = way->is_quadrature || way->is_wave || way->model == MODEL_EXACT;
            CHECK(!is_exact || way->why == NULL);
            CHECK(way->model != MODEL_FITTED || way->why != NULL);
            least = fmin(least, is_exact ? way->error : INFINITY);
            pinhole = way->model == MODEL_PINHOLE ? way->error : pinhole;
            polynomial = way->degree == 9 ? way->error : polynomial;
            /* all instructions give the same bits; of sums more bits give the same to rounding */
            if (way->model == MODEL_EXACT && way->set != SET_BEST) {
                CHECK(isnan(exact) || way->error == exact);
                exact = way->error;
            } else if (way->model >= MODEL_EXACT_64) {
                precise++;
                CHECK(quantity == BENCHMARK_RAY ||
                      fabs(way->error - exact) <= 1e-10 * benchmark.scale);
            }
        }
        for (size_t i = 0; i < benchmark.count; i++) {
            const struct benchmark_way *way = &benchmark.ways[i];
            CHECK(way->why != NULL || way->seconds > 0);
            for (size_t k = 0; k < benchmark.count; k++) {
                const struct benchmark_way *other = &benchmark.ways[k];
                CHECK(!way->is_best ||
                      !(other->error < way->error && other->seconds <= way->seconds));
            }
            best += way->is_best;
        }
        CHECK(best >= 1 && precise == 2 && exact >= 0);
        CHECK(isnan(pinhole) || polynomial < 0.3 * pinhole);
        CHECK(least < 1e-6 * benchmark.scale);
        arena_free(&work);
    }
}

int main(void)
{
    struct arena arena = {0};
    test_thick(&arena);
    test_paraxial(&arena);
    test_third_order(&arena);
    test_exact(&arena);
    test_polynomial(&arena);
    test_sums(&arena);
    test_benchmark(&arena);
    arena_free(&arena);
    return check_report();
}
