/* tests/unit/test_aim_truth.c - aiming and vignetting against a program of 50 digits. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/aim/aim.h"
#include "trace/pupil/clear.h"

#include <stdlib.h>

/*
 * tests/truth/aim.txt: systems in the notation of a .lens file, the radius of the stop, then
 *     aim   field, point of the stop / radius = start (on the first vertex plane, or the object)
 *           and cosines of the ray that crosses the stop there
 *     lost  field, point of the stop: no ray does
 *     edge  field = lowest and highest meridional ray that is not clipped, and the chief ray
 */
static const double degree = RADIANS_PER_DEGREE;

struct reading {
    char line[8192], name[256];
    struct arena arena;
    struct lens lens;
    struct first_order first;
    struct conjugate_object object;
    struct system free, clipped;
    double stop_radius, length;
};

static bool read_lens(struct reading *reading, FILE *file)
{
    static char text[65536];
    size_t length = 0;
    snprintf(reading->name, sizeof reading->name, "%.200s", reading->line + 5);
    reading->name[strcspn(reading->name, "\n")] = '\0';
    while (fgets(reading->line, sizeof reading->line, file) != NULL &&
           strcmp(reading->line, "end\n") != 0) {
        length += (size_t)snprintf(text + length, sizeof text - length, "%s", reading->line);
    }
    struct error error;
    reading->length = 10;
    if (!lens_read("truth", text_of(text), NULL, &reading->arena, &reading->lens, &error)) {
        printf("%s: %s\n", reading->name, error.message);
        return false;
    }
    for (size_t i = 0; i < reading->lens.surface_count; i++) {
        reading->length += fabs(reading->lens.surfaces[i].thickness.value.hi);
    }
    return true;
}

static bool compile(struct reading *reading)
{
    struct error error;
    struct system_options options = system_options_default();
    const struct lens *lens = &reading->lens;
    reading->object = lens_object(lens);
    options.stop_radius = reading->stop_radius;
    bool good = system_compile(lens, 0.5875618, &options, &reading->arena, &reading->free, &error);
    options.clip = true;
    good =
        good &&
        system_compile(lens, 0.5875618, &options, &reading->arena, &reading->clipped, &error) &&
        first_order_of_lens(lens, 0.5875618, SECTION_Y, &reading->arena, &reading->first, &error);
    if (!good) {
        printf("%s: %s\n", reading->name, error.message);
    }
    return good;
}

static bool open_beam(struct reading *reading, double field, struct beam *beam)
{
    struct error error;
    bool infinite = reading->object.is_infinite;
    struct field_point point = {infinite ? FIELD_ANGLE : FIELD_HEIGHT,
                                {0, infinite ? field * degree : field}};
    return beam_of_field(&point, &reading->object, &reading->first, beam, &error);
}

/* Slide a ray to the plane where the truth has its start. */
static void to_plane(const struct ray *ray, double z, double point[3])
{
    double t = (z - ray->point[2]) / ray->cosine[2];
    for (int i = 0; i < 3; i++) {
        point[i] = ray->point[i] + t * ray->cosine[i];
    }
}

static void check_aim(struct reading *reading, const double *n, bool lost)
{
    struct error error;
    struct beam beam;
    struct aim aim;
    char what[400];
    CHECK(open_beam(reading, n[0], &beam));
    if (!aim_open(&reading->free, &beam, &reading->arena, &aim, &error)) {
        printf("%s field %g: %s\n", reading->name, n[0], error.message);
        CHECK(false);
        return;
    }
    struct ray ray = aim_ray(&aim, n[1], n[2]);
    CHECK((ray.status == RAY_OK) == !lost);
    if (lost || ray.status != RAY_OK) {
        return;
    }
    double point[3];
    to_plane(&ray, n[5], point);
    /* how much the start changes per mm in the stop, times the rounding of a trace that far */
    double slope = fmax(1, 1 / fabs(aim.slope[3])), length = reading->length;
    double allowed =
        64 * 1.1102230246251565e-16 * slope * (length + fabs(n[4])) / fabs(ray.cosine[2]);
    for (int i = 0; i < 3; i++) {
        snprintf(what, sizeof what, "%s, field %g, stop at (%g, %g): start %c", reading->name, n[0],
                 n[1], n[2], "xyz"[i]);
        check_source("aim", "mm");
        CHECK_NEAR(point[i], n[3 + i], allowed, what);
        check_source("aim", "");
        CHECK_NEAR(ray.cosine[i], n[6 + i], allowed / 10, what);
    }
    check_source(NULL, "");
}

static void check_edge(struct reading *reading, const double *n)
{
    struct beam beam;
    struct clear_pupil pupil;
    struct arena arena = {0};
    char what[400];
    CHECK(open_beam(reading, n[0], &beam));
    struct clear_guess guess = clear_guess_of(&reading->clipped, &beam, &reading->first);
    clear_find(&reading->clipped, &beam, &guess, 64, &arena, &pupil);
    CHECK(!pupil.is_empty);
    /* edges 0 and half way lie in the meridional plane: below and above */
    for (size_t i = 0; i < 2 && !pupil.is_empty; i++) {
        const struct clear_edge *edge = &pupil.edges[i * pupil.edge_count / 2];
        struct ray ray = beam_ray(&beam, edge->at[0], edge->at[1]);
        double point[3];
        to_plane(&ray, 0, point);
        double figure = reading->object.is_infinite ? point[1] : ray.cosine[1] / ray.cosine[2];
        snprintf(what, sizeof what, "%s, field %g: %s edge", reading->name, n[0],
                 i == 0 ? "lower" : "upper");
        check_source("aim", reading->object.is_infinite ? "mm" : "");
        CHECK_NEAR(figure, n[1 + i], 1e-12 * (1 + fabs(n[1 + i])), what);
        check_source(NULL, "");
        CHECK(edge->status != RAY_OK && edge->surface > 0);
    }
    arena_free(&arena);
}

static void read_line(struct reading *reading)
{
    double n[12];
    size_t count = 0;
    char word[128];
    int used = 0, past = (int)strcspn(reading->line, " ");
    for (const char *at = reading->line + past;
         count < 12 && sscanf(at, "%127s%n", word, &used) == 1; at += used) {
        if (strcmp(word, "=") != 0) {
            n[count++] = strtod(word, NULL);
        }
    }
    if (strncmp(reading->line, "stop", 4) == 0) {
        reading->stop_radius = n[0];
        CHECK(compile(reading));
    } else if (strncmp(reading->line, "aim", 3) == 0) {
        CHECK(count == 9);
        check_aim(reading, n, false);
    } else if (strncmp(reading->line, "lost", 4) == 0) {
        check_aim(reading, n, true);
    } else if (strncmp(reading->line, "edge", 4) == 0) {
        check_edge(reading, n);
    }
}

int main(void)
{
    struct reading reading = {.stop_radius = NAN};
    FILE *file = fopen("tests/truth/aim.txt", "r");
    CHECK(file != NULL);
    while (file != NULL && fgets(reading.line, sizeof reading.line, file) != NULL) {
        if (strncmp(reading.line, "case ", 5) == 0) {
            CHECK(read_lens(&reading, file));
        } else if (reading.line[0] != '#') {
            read_line(&reading);
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    arena_free(&reading.arena);
    return check_report();
}
