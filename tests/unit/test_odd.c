/* tests/unit/test_odd.c - aspheres with odd powers of r: sag, paraxial, exact rays. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_change.h"
#include "file/lens_file.h"
#include "first_meeting.h"
#include "trace/dispatch.h"

static bool read_lens(const char *text, struct arena *arena, struct lens *lens)
{
    struct error error;
    bool good = lens_read("test", text_of(text), NULL, arena, lens, &error);
    if (!good) {
        printf("%s\n%s\n", text, error.message);
    }
    CHECK(good);
    return good;
}

/* Sags that can be added up by hand. */
static void test_sag(void)
{
    static const struct {
        const char *line;
        double r, sag, slope; /* dz/d(r^2), of the polynomial alone */
    } cases[] = {
        {"surface - - 1.5 - A1=0.1", 2, 0.2, 0.1 / 4},
        {"surface - - 1.5 - A3=0.01", 2, 0.08, 0.03},
        {"surface - - 1.5 - A1=0.1 A3=0.01 A2=0.5", 2, 2.28, 0.025 + 0.03 + 0.5},
        {"surface - - 1.5 - A19=1", 1, 1, 9.5},
        {"surface - - 1.5 - A5=1 A20=2", 1, 3, 2.5 + 20},
        /* a parabola of curvature 1/8 beside them */
        {"surface 8 - 1.5 - k=-1 A3=0.5", 2, 0.25 + 4, 1.5},
        {"surface - - 1.5 - A1=0.1", 0, 0, 0},
        {"surface 10 - 1.5 - cyl=x A3=0.001", 6, 2 + 0.216, 0.009},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lens lens;
        if (read_lens(cases[i].line, &arena, &lens)) {
            const struct surface *surface = &lens.surfaces[0];
            double r = cases[i].r;
            CHECK(surface_profile(surface) == PROFILE_ODD);
            CHECK_RELATIVE(surface_sag(surface, r), cases[i].sag, 4e-16, cases[i].line);
            CHECK_RELATIVE(surface_departure(surface, r * r).slope, cases[i].slope, 4e-16,
                           cases[i].line);
        }
        arena_free(&arena);
    }
}

static void test_orders(void)
{
    unsigned seen = 0;
    for (int order = 1; order <= LENS_COEFFICIENTS; order++) {
        int i = surface_term(order);
        CHECK(i >= 0 && i < LENS_COEFFICIENTS && surface_order(i) == order);
        seen |= 1u << i;
    }
    CHECK(seen == (1u << LENS_COEFFICIENTS) - 1);
    CHECK(surface_term(0) == -1 && surface_term(-3) == -1);
    CHECK(surface_term(LENS_COEFFICIENTS + 1) == -1);
}

/* A2 bends the vertex, odd powers do not; A1 is warned of. */
static void test_vertex(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct lens_warnings warnings;
    struct error error;
    read_lens("surface 50 - 1.5 - A2=0.002 A3=0.5 A1=0\n", &arena, &lens);
    CHECK_RELATIVE(surface_curvature(&lens.surfaces[0], SECTION_Y).hi, 0.024, 4e-16, "c + 2 A2");
    CHECK(lens_check(&lens, &arena, &warnings, &error) && warnings.count == 0);
    read_lens("surface 50 - 1.5 - A1=-0.01\n", &arena, &lens);
    CHECK(lens_check(&lens, &arena, &warnings, &error) && warnings.count == 1);
    CHECK(strstr(warnings.texts[0], "cone") != NULL);
    arena_free(&arena);
}

/* Scaled and turned: z(k r) = k z(r), and z of the other side. */
static void test_changes(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct error error;
    read_lens("surface 20 3 1.5 9 k=-2 A1=0.01 A3=1e-3 A4=1e-4 A7=-1e-7\nsurface -30 - air 9\n",
              &arena, &lens);
    const struct lens *bigger = lens_scaled(&lens, pair_of(3), false, &arena);
    const struct lens *turned = lens_reversed(&lens, &arena, &error);
    for (double r = 0.5; r < 4; r += 0.5) {
        double z = surface_sag(&lens.surfaces[0], r);
        CHECK_RELATIVE(surface_sag(&bigger->surfaces[0], 3 * r), 3 * z, 1e-15, "scaled");
        CHECK_RELATIVE(surface_sag(&turned->surfaces[1], r), -z, 1e-15, "turned");
    }
    arena_free(&arena);
}

/* One surface and the rays that meet it. */
struct meeting {
    struct asphere shape;
    struct arena arena;
    struct lens lens;
    struct system system;
    bool reflects, reverse;
    double n1, n2, direction;
    struct rays rays, other;
};

enum { RAYS = 2 * RAYS_BLOCK };

/* Odd powers up to the ninth, each up to a bend of a tenth at r = 5. */
static bool make_surface(struct meeting *meeting, unsigned long long *state, int number)
{
    char text[1024];
    struct asphere *s = &meeting->shape;
    *meeting = (struct meeting){.reflects = number % 4 == 3, .reverse = number % 2 == 1};
    s->c = chance_between(state, -0.06, 0.06);
    s->k = chance_between(state, -2, 1.5);
    s->rim = 8;
    for (int i = 1; i <= 9; i++) {
        s->A[i] = number % 3 == 0 && i % 2 == 0 ? 0 : chance_between(state, -0.1, 0.1) / pow(5, i);
    }
    s->A[1] = number % 5 == 0 ? s->A[1] : 0;
    meeting->n1 = number % 7 < 4 ? 1 : 1.7;
    meeting->n2 = meeting->reflects ? meeting->n1 : number % 7 < 4 ? 1.5 : 1.2;
    int length = snprintf(text, sizeof text, "medium %.17g\nsurface - - ", meeting->n1);
    length += snprintf(text + length, sizeof text - (size_t)length,
                       meeting->reflects ? "mirror" : "%.17g", meeting->n2);
    length +=
        snprintf(text + length, sizeof text - (size_t)length, " - c=%.17g k=%.17g", s->c, s->k);
    for (int i = 1; i <= 9; i++) {
        length += snprintf(text + length, sizeof text - (size_t)length, " A%d=%.17g", i, s->A[i]);
    }
    struct error error;
    struct system_options options = system_options_default();
    options.path = true;
    options.reverse = meeting->reverse;
    meeting->direction = meeting->reverse ? -1 : 1;
    meeting->direction *= meeting->reverse && meeting->reflects ? -1 : 1;
    return read_lens(text, &meeting->arena, &meeting->lens) &&
           system_compile(&meeting->lens, 0.55, &options, &meeting->arena, &meeting->system,
                          &error);
}

static void set_rays(struct meeting *meeting, unsigned long long *state, struct ray *starts)
{
    meeting->rays = rays_new(&meeting->arena, RAYS);
    meeting->other = rays_new(&meeting->arena, RAYS);
    for (size_t i = 0; i < RAYS; i++) {
        double angle = chance_between(state, 0, 6.283), tilt = chance_between(state, 0, 0.5);
        struct ray ray = {.cosine = {sin(tilt) * cos(angle), sin(tilt) * sin(angle),
                                     meeting->direction * cos(tilt)}};
        double away = -10 * meeting->direction;
        for (int k = 0; k < 2; k++) {
            double aim = i == 0 ? 0 : chance_between(state, -3.5, 3.5);
            ray.point[k] = aim + away * ray.cosine[k] / ray.cosine[2];
        }
        ray.point[2] = away;
        starts[i] = ray;
        rays_set(&meeting->rays, i, meeting->system.index_first, &ray);
        rays_set(&meeting->other, i, meeting->system.index_first, &ray);
    }
}

static double worst;

static void check_ray(const struct meeting *meeting, const struct ray *start, const struct ray *end)
{
    const struct asphere *s = &meeting->shape;
    bool back = meeting->reverse && !meeting->reflects;
    double n1 = back ? meeting->n2 : meeting->n1, n2 = back ? meeting->n1 : meeting->n2;
    real d, point[3], cosine[3];
    bool met = first_meeting(s, start->point, start->cosine, meeting->direction, 400, &d);
    for (int i = 0; i < 3 && met; i++) {
        cosine[i] = start->cosine[i];
        point[i] = start->point[i] + d * cosine[i];
    }
    CHECK(met && (end->status == RAY_OK || end->status == RAY_TOTAL_REFLECTION));
    bool leaves = met && bend_at(s, point, meeting->reflects, n1, n2, cosine);
    CHECK(leaves == (end->status == RAY_OK));
    /* at the tip of a cone there is no direction to compare */
    bool is_tip = met && s->A[1] != 0 && point[0] * point[0] + point[1] * point[1] < 1e-20;
    if (!leaves || end->status != RAY_OK || is_tip) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        double error = fabs((double)(end->point[i] - point[i])) / 10;
        error = fmax(error, fabs((double)(end->cosine[i] - cosine[i])));
        if (error > 1e-14) {
            printf("x %.17g, expected %.17g; cosine %.17g, expected %.17g\n", end->point[i],
                   (double)point[i], end->cosine[i], (double)cosine[i]);
        }
        CHECK(error <= 1e-14);
        worst = fmax(worst, error);
    }
}

static void test_rays(void)
{
    unsigned long long state = 7;
    for (int number = 0; number < 60; number++) {
        static struct meeting meeting;
        static struct ray starts[RAYS];
        if (!make_surface(&meeting, &state, number)) {
            continue;
        }
        set_rays(&meeting, &state, starts);
        rays_trace(&meeting.system, &meeting.rays, &(struct trace_way){.set = SET_SSE2});
        for (enum instruction_set set = SET_AVX2; set <= SET_AVX512; set++) {
            if (instruction_set_works(set)) {
                for (size_t i = 0; i < RAYS; i++) {
                    rays_set(&meeting.other, i, meeting.system.index_first, &starts[i]);
                }
                rays_trace(&meeting.system, &meeting.other, &(struct trace_way){.set = set});
                CHECK(memcmp(meeting.rays.blocks, meeting.other.blocks,
                             rays_blocks(&meeting.rays) * sizeof *meeting.rays.blocks) == 0);
            }
        }
        /* the kernels for a few, one ray of each block */
        for (size_t i = 0; i < RAYS; i += RAYS_BLOCK) {
            struct rays alone = rays_new(&meeting.arena, 1);
            rays_set(&alone, 0, meeting.system.index_first, &starts[i]);
            rays_trace(&meeting.system, &alone, NULL);
            const double *a = alone.blocks->x, *b = meeting.rays.blocks[i / RAYS_BLOCK].x;
            for (size_t member = 0; member < 8; member++) {
                CHECK(memcmp(a + member * RAYS_BLOCK, b + member * RAYS_BLOCK, sizeof *a) == 0);
            }
        }
        for (size_t i = 0; i < RAYS; i += number % 6 == 0 ? 1 : 9) {
            struct ray end = rays_get(&meeting.rays, i, meeting.system.index_last);
            check_ray(&meeting, &starts[i], &end);
        }
        arena_free(&meeting.arena);
    }
    printf("odd aspheres: worst error %.2g (cosines, and points in 10 mm)\n", worst);
}

int main(void)
{
    test_sag();
    test_orders();
    test_vertex();
    test_changes();
    test_rays();
    return check_report();
}
