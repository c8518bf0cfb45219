/* tests/unit/test_frames.c - frames of a broken axis by products of rotations; normals of sags. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/kernel/step.h"
#include "trace/system.h"

#include <stdlib.h>

static const double degree = RADIANS_PER_DEGREE;

static void compile(const char *text, struct arena *arena, struct lens *lens, struct system *system,
                    double image)
{
    struct error error = {0};
    struct system_options options = system_options_default();
    options.image = image;
    bool good = lens_read("test", text_of(text), NULL, arena, lens, &error) &&
                system_compile(lens, 0.55, &options, arena, system, &error);
    CHECK(good);
    if (!good) {
        printf("%s: %s\n", text, error.message);
    }
}

/* -------- matrices by columns of axes, as books have them -------- */

/* m Rx(x) Ry(y) Rz(z), each right-handed; angles in degrees. */
static void turned(double m[3][3], const double angles[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double c = cos(angles[axis] * degree), s = sin(angles[axis] * degree);
        const double R[3][3][3] = {{{1, 0, 0}, {0, c, -s}, {0, s, c}},
                                   {{c, 0, s}, {0, 1, 0}, {-s, 0, c}},
                                   {{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
        double product[3][3] = {{0}};
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                for (int k = 0; k < 3; k++) {
                    product[i][j] += m[i][k] * R[axis][k][j];
                }
            }
        }
        memcpy(m, product, sizeof product);
    }
}

static void apply(double m[3][3], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A surface of the chain: what stands before it and how it stands itself. */
struct link {
    bool has_break, mirror;
    double before[2], before_tilt[3];
    double own[2], own_tilt[2];
    double thickness;
};

static void write_chain(const struct link *links, size_t count, char *text, size_t size)
{
    size_t at = (size_t)snprintf(text, size, "object inf\n");
    for (size_t i = 0; i < count; i++) {
        const struct link *link = &links[i];
        if (link->has_break) {
            at += (size_t)snprintf(
                text + at, size - at, "bend decenter=%.17g,%.17g tilt=%g,%g,%g\n", link->before[0],
                link->before[1], link->before_tilt[0], link->before_tilt[1], link->before_tilt[2]);
        }
        at += (size_t)snprintf(text + at, size - at,
                               "surface - %.17g %s - decenter=%.17g,%.17g tilt=%g,%g\n",
                               link->thickness, link->mirror ? "mirror" : "air", link->own[0],
                               link->own[1], link->own_tilt[0], link->own_tilt[1]);
    }
}

static double some(double largest)
{
    return largest * (2.0 * rand() / RAND_MAX - 1);
}

/* Whole degrees, so that the file says what is meant. */
static double some_degrees(int largest)
{
    return rand() % (2 * largest + 1) - largest;
}

static void check_chain(const struct link *links, size_t count)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    char text[4000];
    const double image = 7.5, ez[3] = {0, 0, 1};
    double m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, origin[3] = {0, 0, 0}, axis[3] = {0, 0, 1};
    write_chain(links, count, text, sizeof text);
    compile(text, &arena, &lens, &system, image);
    for (size_t i = 0; i <= count; i++) {
        const struct link *link = &links[i < count ? i : count - 1];
        double step[3] = {0, 0, i == count ? image : i > 0 ? links[i - 1].thickness : 0}, moved[3];
        if (i < count && link->has_break) {
            step[0] = link->before[0];
            step[1] = link->before[1];
        }
        apply(m, step, moved);
        for (int k = 0; k < 3; k++) {
            origin[k] += moved[k];
        }
        if (i < count && link->has_break) {
            turned(m, link->before_tilt);
        }
        struct surface_frame frame = system_frames(&system, &arena)[i];
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(frame.shift[k], origin[k], 1e-12, "origin");
            for (int j = 0; j < 3; j++) {
                CHECK_NEAR(frame.turn[3 * k + j], m[k][j], 2e-15, "axes");
            }
        }
        if (i == count) {
            apply(m, ez, moved);
            CHECK(system.direction[i] == (dot(axis, moved) < 0 ? -1 : 1));
            break;
        }
        /* the axis arrives at the surface, which has turned by itself, and may be thrown back */
        double own[3][3], normal[3], local[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const double tilt[3] = {link->own_tilt[0], link->own_tilt[1], 0};
        memcpy(own, m, sizeof own);
        turned(own, tilt);
        turned(local, tilt);
        apply(own, ez, normal);
        double along = dot(axis, normal);
        CHECK(system.direction[i] == (along < 0 ? -1 : 1));
        for (int k = 0; k < 3 && link->mirror; k++) {
            axis[k] -= 2 * along * normal[k];
        }
        const double point[3] = {1.5, -2.25, 0.75};
        double there[3] = {point[0], point[1], point[2]}, back[3];
        system_to_own(&system, i, there);
        apply(local, there, back);
        CHECK_NEAR(back[0] + link->own[0], point[0], 1e-14, "own point");
        CHECK_NEAR(back[1] + link->own[1], point[1], 1e-14, "own point");
        CHECK_NEAR(back[2], point[2], 1e-14, "own point");
        system_normal(&system, i, point, normal);
        apply(local, ez, back);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR(normal[k], back[k], 1e-15, "normal of a tilted plane");
        }
    }
    arena_free(&arena);
}

static void test_chains(void)
{
    srand(5);
    for (int round = 0; round < 300; round++) {
        struct link links[5];
        for (int i = 0; i < 5; i++) {
            links[i] = (struct link){.has_break = rand() % 3 > 0,
                                     .mirror = rand() % 3 == 0,
                                     .before = {some(9), some(9)},
                                     .own = {some(3), some(3)},
                                     .thickness = some(20)};
            for (int k = 0; k < 3; k++) {
                links[i].before_tilt[k] = some_degrees(80);
            }
            for (int k = 0; k < 2; k++) {
                links[i].own_tilt[k] = some_degrees(80);
            }
        }
        check_chain(links, 5);
    }
}

/* Sags as the file states them. */
static double conic(double x, double y)
{
    double c = 1 / 40.0, k = -0.7, u = x * x + y * y;
    return c * u / (1 + sqrt(1 - (1 + k) * c * c * u));
}

static double even(double x, double y)
{
    double u = x * x + y * y;
    return conic(x, y) + 1e-3 * u + 2e-5 * u * u - 3e-7 * u * u * u;
}

static double odd(double x, double y)
{
    double r = hypot(x, y);
    return conic(x, y) + 0.02 * r - 4e-4 * r * r * r + 2e-5 * r * r * r * r;
}

static double along_x(double x, double y)
{
    return conic(x, 0 * y);
}

static double along_y(double x, double y)
{
    return conic(0 * x, y);
}

/* The normal of z = S(x, y) is (-dS/dx, -dS/dy, 1), here by differences of the sag. */
static void test_normals(void)
{
    static const struct {
        const char *text;
        double (*sag)(double, double);
    } cases[] = {{"surface 40 5 1.5 - k=-0.7\n", conic},
                 {"surface 40 5 1.5 - k=-0.7 A2=1e-3 A4=2e-5 A6=-3e-7\n", even},
                 {"surface 40 5 1.5 - k=-0.7 A1=0.02 A3=-4e-4 A4=2e-5\n", odd},
                 {"surface 40 5 1.5 - k=-0.7 cyl=x\n", along_x},
                 {"surface 40 5 1.5 - k=-0.7 cyl=y\n", along_y}};
    static const double points[][2] = {{0.5, 0.25}, {6, -7}, {-11, 3}, {2, 14}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lens lens;
        struct system system;
        compile(cases[i].text, &arena, &lens, &system, NAN);
        for (size_t k = 0; k < sizeof points / sizeof points[0]; k++) {
            double x = points[k][0], y = points[k][1], h = 1e-3, normal[3];
            double (*sag)(double, double) = cases[i].sag;
            double sx =
                (8 * (sag(x + h, y) - sag(x - h, y)) - sag(x + 2 * h, y) + sag(x - 2 * h, y)) / 12 /
                h;
            double sy =
                (8 * (sag(x, y + h) - sag(x, y - h)) - sag(x, y + 2 * h) + sag(x, y - 2 * h)) / 12 /
                h;
            double length = sqrt(1 + sx * sx + sy * sy);
            const double point[3] = {x, y, sag(x, y)};
            system_normal(&system, 0, point, normal);
            CHECK_NEAR(normal[0], -sx / length, 1e-11, cases[i].text);
            CHECK_NEAR(normal[1], -sy / length, 1e-11, cases[i].text);
            CHECK_NEAR(normal[2], 1 / length, 1e-11, cases[i].text);
        }
        arena_free(&arena);
    }
}

/* The image plane has the normal (0, 0, 1); a thick lens too. */
static void test_flat(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    double normal[3] = {9, 9, 9}, point[3] = {3, -4, 0.5};
    /* the image counts from H' */
    compile("surface - 7 air -\nthick 50 50 air 20 hiatus=-4\n", &arena, &lens, &system, 50);
    const struct surface_frame image = system_frames(&system, &arena)[2];
    CHECK(image.shift[2] == 53 && image.shift[0] == 0 && image.turn[8] == 1);
    compile("thick 50 50 air 20\n", &arena, &lens, &system, 50);
    for (size_t i = 0; i < 2; i++) {
        system_normal(&system, i, point, normal);
        CHECK(normal[0] == 0 && normal[1] == 0 && normal[2] == 1);
        system_to_own(&system, i, point);
        CHECK(point[0] == 3 && point[1] == -4 && point[2] == 0.5);
    }
    arena_free(&arena);
}

/* Angles up to 90 degrees with a normal in any direction, whichever way it points. */
static void test_angles(void)
{
    srand(6);
    for (int round = 0; round < 200; round++) {
        double m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const double turns[3] = {some(180), some(180), some(180)};
        double angle[2] = {fabs(some(90)), 1e-6 * fabs(some(90))}, ray[2][3], normal[3];
        turned(m, turns);
        for (int i = 0; i < 2; i++) {
            double t = angle[i] * degree, around = some(3), flip = round % 2 ? 1 : -1;
            const double local[3] = {flip * sin(t) * cos(around), flip * sin(t) * sin(around),
                                     flip * cos(t)};
            apply(m, local, ray[i]);
        }
        apply(m, (double[3]){0, 0, 1}, normal);
        struct ray_angles angles = ray_angles(normal, ray[0], ray[1]);
        CHECK_NEAR(angles.incidence, angle[0] * degree, 1e-15, "before");
        CHECK_NEAR(angles.refraction, angle[1] * degree, 1e-15, "after");
    }
}

/* A ray that a step loses says at which surface, counted from 1, and how. */
static void test_codes(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct ray_block block = {.lost = {0}};
    compile("surface 50 6 1.5 40 A4=1e-6\nbend tilt=3,0,0\nsurface -40 20 air 40 tilt=5,0\n"
            "stop - 5 air 10\nsurface -90 30 mirror 40\n",
            &arena, &lens, &system, -20);
    for (size_t place = 0; place < system.places; place++) {
        for (size_t i = system.begin[place]; i < system.begin[place + 1]; i++) {
            const struct step *step = &system.steps[i];
            const double codes[] = {step->miss, step->clipped, step->reflected, step->unconverged};
            static const enum ray_status statuses[] = {RAY_MISS, RAY_CLIPPED, RAY_TOTAL_REFLECTION,
                                                       RAY_NOT_CONVERGED};
            CHECK(step->surface == place);
            for (size_t k = 0; k < 4; k++) {
                block.lost[0] = codes[k];
                CHECK(ray_block_status(&block, 0) == statuses[k]);
                CHECK(ray_block_surface(&block, 0) == place + 1);
            }
        }
    }
    arena_free(&arena);
}

int main(void)
{
    test_codes();
    test_chains();
    test_normals();
    test_flat();
    test_angles();
    return check_report();
}
