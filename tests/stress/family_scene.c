/* tests/stress/family_scene.c - random legal scenes: read, photographed tiny, never NaN. */
/* SPDX-License-Identifier: MIT */
#include "stress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* A scene as it is written, line by line. */
struct scene_text {
    struct trial *trial;
    char text[12000];
    size_t length;
};

static void __attribute__((format(printf, 2, 3)))
put(struct scene_text *scene, const char *form, ...)
{
    va_list list;
    va_start(list, form);
    const size_t room = sizeof scene->text - scene->length;
    const int length = vsnprintf(scene->text + scene->length, room, form, list);
    scene->length += (size_t)length < room ? (size_t)length : 0;
    va_end(list);
}

/* A length of the scene's world: most a few metres, some tiny, some huge. */
static double scene_length(struct trial *trial)
{
    return trial_chance(trial, 0.8) ? trial_magnitude(trial, 0.02, 5)
                                    : trial_magnitude(trial, 1e-9, 1e9);
}

static void put_colour(struct scene_text *scene, const char *key)
{
    struct trial *trial = scene->trial;
    if (trial_chance(trial, 0.4)) {
        put(scene, " %s=%.3g", key, trial_draw(trial));
    } else if (trial_chance(trial, 0.5)) {
        put(scene, " %s=%.3g,%.3g,%.3g", key, trial_draw(trial), trial_draw(trial),
            trial_draw(trial));
    } else {
        put(scene, " %s=#%06x", key, (unsigned)trial_whole(trial, 0, 0xffffff));
    }
}

static void put_light_colour(struct scene_text *scene, const char *key)
{
    struct trial *trial = scene->trial;
    static const char *const words[] = {
        "A", "D50", "D65", "E", "F2", "blackbody:900K", "daylight:5000K", "12000K"};
    if (trial_chance(trial, 0.5)) {
        put(scene, " %s=%s", key, words[trial_whole(trial, 0, 7)]);
    } else {
        put_colour(scene, key);
    }
}

static void put_vector(struct scene_text *scene, const char *key, double size)
{
    struct trial *trial = scene->trial;
    put(scene, " %s=%.6g,%.6g,%.6g", key, size * trial_between(trial, -1, 1),
        size * trial_between(trial, -1, 1), size * trial_between(trial, -1, 1));
}

static void put_materials(struct scene_text *scene, int count)
{
    static const char *const kinds[] = {"lambert", "mirror", "glossy", "black"};
    struct trial *trial = scene->trial;
    for (int i = 0; i < count; i++) {
        const int kind = trial_whole(trial, 0, 3);
        put(scene, "material m%d %s", i, kinds[kind]);
        if (kind < 3) {
            put_colour(scene, "colour");
        }
        if (kind == 2) {
            put(scene, " roughness=%.4g index=%.4g", trial_magnitude(trial, 0.0011, 1),
                trial_between(trial, 1, 3));
        }
        if (trial_chance(trial, 0.25)) {
            put(scene, " luminance=%.4g", trial_magnitude(trial, 1e-6, 1e9));
            if (trial_chance(trial, 0.5)) {
                put_light_colour(scene, "emission");
            }
        }
        put(scene, "\n");
    }
}

static void put_place(struct scene_text *scene)
{
    struct trial *trial = scene->trial;
    put(scene, " at=%.6g,%.6g,%.6g", trial_between(trial, -2, 2), trial_between(trial, -2, 2),
        -scene_length(trial));
    if (trial_chance(trial, 0.3)) {
        put(scene, " normal=%.4g,%.4g,%.4g", trial_between(trial, 0.1, 1),
            trial_between(trial, -0.5, 0.5), trial_between(trial, 0.1, 1));
    }
    if (trial_chance(trial, 0.3)) {
        put_vector(scene, "turn", 180);
    }
    if (trial_chance(trial, 0.2)) {
        put_vector(scene, "move", trial_magnitude(trial, 1e-3, 1e3));
    }
    if (trial_chance(trial, 0.15)) {
        put(scene, " spin=%.4g axis=%.4g,1,%.4g", trial_magnitude(trial, 1e-3, 1e4),
            trial_draw(trial), trial_draw(trial));
    }
    put(scene, "\n");
}

static void put_things(struct scene_text *scene, int materials)
{
    struct trial *trial = scene->trial;
    const int count = trial_whole(trial, 1, 12);
    for (int i = 0; i < count; i++) {
        const int material = trial_whole(trial, 0, materials - 1);
        const double a = scene_length(trial), b = scene_length(trial), c = scene_length(trial);
        switch (trial_whole(trial, 0, 4)) {
        case 0:
            put(scene, "plane material=m%d", material);
            break;
        case 1:
            put(scene, "disc material=m%d radius=%.5g", material, a);
            break;
        case 2:
            put(scene, "card material=m%d size=%.5g,%.5g", material, a, b);
            break;
        case 3:
            put(scene, "sphere material=m%d radius=%.5g", material, a);
            break;
        default:
            put(scene, "box material=m%d size=%.5g,%.5g,%.5g", material, a, b, c);
            break;
        }
        put_place(scene);
    }
}

static void put_lights(struct scene_text *scene)
{
    static const char *const skies[] = {"uniform", "overcast", "clear"};
    struct trial *trial = scene->trial;
    const int count = trial_whole(trial, 1, 4);
    for (int i = 0; i < count; i++) {
        const double amount = trial_magnitude(trial, 1e-6, 1e9);
        const double up = trial_between(trial, -20, 90), round = trial_between(trial, -180, 180);
        const int kind = i == 0 ? 0 : trial_whole(trial, 0, 3); /* one light there is */
        if (kind == 0 && i > 0) {
            continue;
        }
        if (kind == 0) {
            put(scene, "light sun illuminance=%.4g elevation=%.4g azimuth=%.4g", amount, fabs(up),
                round);
        } else if (kind == 1) {
            put(scene, "light sky %s luminance=%.4g", skies[trial_whole(trial, 0, 2)], amount);
            put_light_colour(scene, "spectrum");
            put(scene, "\n");
            return; /* there is one sky */
        } else if (kind == 2) {
            put(scene, "light point at=%.5g,%.5g,%.5g %s=%.4g", trial_between(trial, -3, 3),
                trial_between(trial, -3, 3), trial_between(trial, -3, 3),
                trial_chance(trial, 0.5) ? "intensity" : "power", amount);
        } else {
            put(scene, "light star magnitude=%.3g elevation=%.4g azimuth=%.4g",
                trial_between(trial, -25, 15), up, round);
        }
        put_light_colour(scene, "spectrum");
        put(scene, "\n");
    }
}

static void write_scene(struct scene_text *scene)
{
    struct trial *trial = scene->trial;
    const int materials = trial_whole(trial, 1, 5);
    scene->length = 0;
    put(scene, "camera at=%.4g,%.4g,%.4g", trial_between(trial, -1, 1), trial_between(trial, -1, 1),
        trial_between(trial, 0, 3));
    if (trial_chance(trial, 0.5)) {
        put(scene, " look=%.4g,%.4g,-4", trial_between(trial, -1, 1), trial_between(trial, -1, 1));
    }
    put(scene, " focus=%.4g", trial_magnitude(trial, 0.5, 1e4));
    if (trial_chance(trial, 0.2)) {
        put_vector(scene, "move", 1);
    }
    put(scene, "\n");
    put_materials(scene, materials);
    put_things(scene, materials);
    put_lights(scene);
}

/* The program, quietly; its exit status. What it says of errors stands in the file `said`. */
static int run(const char *const *words, const char *said)
{
    (void)fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        if (freopen("/dev/null", "w", stdout) == NULL || freopen(said, "w", stderr) == NULL) {
            _exit(126);
        }
        execv(words[0], (char *const *)(uintptr_t)words);
        _exit(127);
    }
    int status = -1;
    if (child < 0 || waitpid(child, &status, 0) != child) {
        return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* Numbers of a PFM that are no light: NaN, infinite or below 0; -1: it cannot be read. */
static long bad_numbers(const char *path)
{
    FILE *file = fopen(path, "rb");
    int columns = 0, rows = 0;
    float scale = 0, value;
    long bad = 0, count = 0;
    if (file == NULL) {
        return -1;
    }
    const bool is_pfm = fscanf(file, "PF %d %d %f", &columns, &rows, &scale) == 3 && scale < 0;
    (void)fgetc(file);
    while (is_pfm && fread(&value, sizeof value, 1, file) == 1) {
        bad += !(isfinite(value) && value >= 0);
        count++;
    }
    (void)fclose(file);
    return is_pfm && count == 3L * columns * rows ? bad : -1;
}

void try_scene(struct trial *trial)
{
    static struct scene_text scene;
    char folder[] = "/tmp/stress-XXXXXX";
    scene.trial = trial;
    write_scene(&scene);
    trial->about = scene.text;
    if (!trial_verdict(trial, mkdtemp(folder) != NULL, "no folder for a scene")) {
        return;
    }
    char path[60], out[60], said[60], program[400], seed[20], message[300] = "";
    snprintf(path, sizeof path, "%s/a.scene", folder);
    snprintf(out, sizeof out, "%s/a.pfm", folder);
    snprintf(said, sizeof said, "%s/said", folder);
    snprintf(program, sizeof program, "%s/lenscalc", trial->build);
    snprintf(seed, sizeof seed, "%d", trial_whole(trial, 1, 1000));
    FILE *file = fopen(path, "w");
    if (file != NULL) {
        (void)fputs(scene.text, file);
        (void)fclose(file);
    }
    const char *const words[] = {program,  "render", path,        "--lens", "double-gauss-50",
                                 "--size", "8x6",    "--samples", "4",      "--radiance",
                                 "--seed", seed,     "-t",        "1/50",   "-o",
                                 out,      NULL};
    const int status = run(words, said);
    file = fopen(said, "r");
    if (file != NULL) {
        message[fread(message, 1, sizeof message - 1, file)] = '\0';
        (void)fclose(file);
    }
    const long bad = status == 0 ? bad_numbers(out) : 0;
    (void)remove(path);
    (void)remove(out);
    (void)remove(said);
    (void)rmdir(folder);
    /* a camera within a thing, or in the dark: that is said, not photographed */
    if (status == 1 && (strstr(message, "light") != NULL || strstr(message, "within the lens"))) {
        trial_skip(trial);
        return;
    }
    trial_verdict(trial, status == 0 && bad == 0, "status %d, %ld bad numbers: %s", status, bad,
                  message);
}
