/* tests/unit/test_trace_truth.c - exact rays against an independent program of 50 digits. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "trace/dispatch.h"
#include "trace_one.h"

#include <stdlib.h>

/*
 * tests/truth/rays_*.txt: systems in the notation of a .lens file, and rays:
 *     ray   start, cosines = point, cosines and path at the last surface, x y on the image plane,
 *           first surface whose clear aperture is passed by (0 = none)
 *     slope the same with a start on the first vertex plane, slopes, and how much each figure
 *           changes with the inputs (sum of |d value/d ln input|)
 *     lost  start, slopes, how, at which surface
 * A figure must be within 64 x 2^-53 x (sensitivity + |value|). Where no sensitivity is given the
 * length of the lens and 10 mm stand for it.
 */
static const double unit = 64 / 9007199254740992.0;

struct reading {
    FILE *file;
    char line[8192];
    struct arena arena;
    struct lens lens;
    struct system system;
    double image, length;
    const char *name;
};

static double worst;

static bool compile(struct reading *reading, double image)
{
    struct error error;
    struct system_options options = system_options_default();
    options.path = true;
    options.clip = true;
    options.image = image;
    options.stop_radius = INFINITY;
    if (!system_compile(&reading->lens, 0.5875618, &options, &reading->arena, &reading->system,
                        &error)) {
        printf("%s: %s\n", reading->name, error.message);
        return false;
    }
    return true;
}

static bool read_case(struct reading *reading)
{
    static char text[65536], name[256];
    size_t length = 0;
    snprintf(name, sizeof name, "%.200s", reading->line + 5);
    name[strcspn(name, "\n")] = '\0';
    while (fgets(reading->line, sizeof reading->line, reading->file) != NULL &&
           strcmp(reading->line, "end\n") != 0) {
        length += (size_t)snprintf(text + length, sizeof text - length, "%s", reading->line);
    }
    struct error error;
    reading->name = name;
    reading->image = NAN;
    if (!lens_read("truth", text_of(text), NULL, &reading->arena, &reading->lens, &error)) {
        printf("%s: %s\n", name, error.message);
        return false;
    }
    reading->length = 10;
    for (size_t i = 0; i < reading->lens.surface_count; i++) {
        reading->length += fabs(reading->lens.surfaces[i].thickness.value.hi);
    }
    return compile(reading, NAN);
}

/* Numbers of a line; "-" is NaN, "=" and "+-" are passed over. */
static size_t read_numbers(const char *line, double *numbers, size_t most)
{
    size_t count = 0;
    char word[128];
    int used = 0;
    while (count < most && sscanf(line, "%127s%n", word, &used) == 1) {
        line += used;
        if (strcmp(word, "=") != 0 && strcmp(word, "+-") != 0) {
            numbers[count++] = strcmp(word, "-") == 0 ? NAN : strtod(word, NULL);
        }
    }
    return count;
}

static struct ray start_of(const double *numbers, bool slopes)
{
    struct ray ray = {.point = {numbers[0], numbers[1], slopes ? 0 : numbers[2]}};
    if (slopes) {
        double length = sqrt(1 + numbers[2] * numbers[2] + numbers[3] * numbers[3]);
        ray.cosine[0] = numbers[2] / length;
        ray.cosine[1] = numbers[3] / length;
        ray.cosine[2] = 1 / length;
    } else {
        memcpy(ray.cosine, numbers + 3, sizeof ray.cosine);
    }
    return ray;
}

static void check_figures(const struct reading *reading, const struct ray *ray,
                          const double *expected, const double *sensitivity)
{
    static const char names[][5] = {"x", "y", "z", "L", "M", "N", "path"};
    double figures[7] = {ray->point[0],  ray->point[1],  ray->point[2], ray->cosine[0],
                         ray->cosine[1], ray->cosine[2], ray->path};
    for (int i = 0; i < 7; i++) {
        double scale = i >= 3 && i < 6 ? 1 : reading->length;
        scale = sensitivity != NULL ? sensitivity[i] : scale;
        double allowed = unit * (scale + fabs(expected[i])), error = fabs(figures[i] - expected[i]);
        char what[320];
        snprintf(what, sizeof what, "%s: %s", reading->name, names[i]);
        CHECK_NEAR(figures[i], expected[i], allowed, what);
        worst = error > worst * allowed && allowed > 0 ? error / allowed : worst;
    }
}

static void check_ray(struct reading *reading)
{
    double n[17];
    CHECK(read_numbers(reading->line + 4, n, 16) == 16);
    struct ray start = start_of(n, false), end = trace_one(&reading->system, &start);
    size_t clipped = (size_t)n[15];
    CHECK(end.status == (clipped != 0 ? RAY_CLIPPED : RAY_OK) && end.surface == clipped);
    check_figures(reading, &end, n + 6, NULL);
    if (isnan(reading->image) || isnan(n[13])) {
        return;
    }
    CHECK(compile(reading, reading->image));
    end = trace_one(&reading->system, &start);
    double scale = reading->length + fabs(reading->image);
    CHECK_NEAR(end.point[0], n[13], unit * (scale + fabs(n[13])), reading->name);
    CHECK_NEAR(end.point[1], n[14], unit * (scale + fabs(n[14])), reading->name);
    CHECK(compile(reading, NAN));
}

static void check_slope(const struct reading *reading)
{
    double n[19];
    CHECK(read_numbers(reading->line + 6, n, 18) == 18);
    struct ray start = start_of(n, true), end = trace_one(&reading->system, &start);
    CHECK(end.status == RAY_OK);
    check_figures(reading, &end, n + 4, n + 11);
}

static void check_lost(const struct reading *reading)
{
    double n[4];
    char how[16];
    size_t where = 0;
    CHECK(sscanf(reading->line, "lost %lf %lf %lf %lf %15s %zu", &n[0], &n[1], &n[2], &n[3], how,
                 &where) == 6);
    struct ray start = start_of(n, true), end = trace_one(&reading->system, &start);
    enum ray_status status = strcmp(how, "miss") == 0 ? RAY_MISS : RAY_TOTAL_REFLECTION;
    if (end.status != status || end.surface != where) {
        printf("%s: %s at %zu, expected %s at %zu\n", reading->name, ray_status_name(end.status),
               end.surface, how, where);
    }
    CHECK(end.status == status && end.surface == where);
    CHECK(isnan(end.point[0]) && isnan(end.cosine[2]) && isnan(end.path));
}

static void check_file(const char *name)
{
    static struct reading reading;
    char path[256];
    snprintf(path, sizeof path, "tests/truth/rays_%s.txt", name);
    reading = (struct reading){.file = fopen(path, "r")};
    CHECK(reading.file != NULL);
    worst = 0;
    bool good = true;
    while (good && fgets(reading.line, sizeof reading.line, reading.file) != NULL) {
        if (strncmp(reading.line, "case ", 5) == 0) {
            CHECK(good = read_case(&reading));
        } else if (strncmp(reading.line, "image ", 6) == 0) {
            reading.image = strtod(reading.line + 6, NULL);
        } else if (strncmp(reading.line, "ray ", 4) == 0) {
            check_ray(&reading);
        } else if (strncmp(reading.line, "slope ", 6) == 0) {
            check_slope(&reading);
        } else if (strncmp(reading.line, "lost ", 5) == 0) {
            check_lost(&reading);
        }
    }
    printf("%s: worst error %.2g of what is allowed\n", name, worst);
    fclose(reading.file);
    arena_free(&reading.arena);
}

int main(void)
{
    static const char names[][16] = {"achromat", "asphere",  "cooke_triplet", "double_gauss",
                                     "fisheye",  "galilean", "meniscus",      "mirrors",
                                     "relay",    "stress"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        check_file(names[i]);
    }
    return check_report();
}
