/* tests/unit/test_camera_name.c - short names of cameras, and that each is one camera's. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "data/camera_name.h"
#include "data/lensdb.h"

#include <stdio.h>
#include <stdlib.h>

/* What people write in forums, and the maker's own name of the same body. */
static const struct {
    const char *typed, *name, *folded;
} names[] = {
    {"5D4", "EOS 5D Mark IV", "5d4"},
    {"5d mark 4", "EOS 5D Mark IV", "5d4"},
    {"5DmkIV", "EOS 5D Mark IV", "5d4"},
    {"5d mk iv", "EOS 5D Mark IV", "5d4"},
    {"R6 II", "EOS R6 Mark II", "r62"},
    {"G7X II", "PowerShot G7 X Mark II", "g7x2"},
    {"1DX3", "EOS-1D X Mark III", "1dx3"},
    {"a7R5", "A7R V", "a7r5"},
    {"a7riv", "A7R IV", "a7r4"},
    {"a7siii", "A7S III", "a7s3"},
    {"GR3", "GR III", "gr3"},
    {"rx100 7", "Cyber-shot DSC-RX100 VII", "rx1007"},
    {"GH5ii", "Lumix DC-GH5 II", "gh52"},
    {"z62", "Z 6II", "z62"},
    {"om-1 mark 2", "OM-1 Mark II", "om12"},
    {"HERO12 Black", "HERO12 Black", "hero12black"},
    {"S24 Ultra", "Galaxy S24 Ultra", "s24ultra"},
    {"t7i", "EOS Rebel T7i", "t7i"},
    {"D3s", "D3s", "d3s"},
    {"1 V1", "1 V1", "1v1"},
};

static void check_names(void)
{
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char typed[MOST_CAMERA_NAME], own[MOST_CAMERA_NAME];
        CHECK(text_equal(camera_name_fold(text_of(names[i].typed), typed), names[i].folded));
        CHECK(text_equal(camera_name_fold(text_of(names[i].name), own), names[i].folded));
    }
    char folded[MOST_CAMERA_NAME];
    char longest[3 * MOST_CAMERA_NAME];
    memset(longest, 'M', sizeof longest);
    CHECK(camera_name_fold((struct text){longest, sizeof longest}, folded).length <
          MOST_CAMERA_NAME);
    CHECK(camera_name_fold((struct text){longest, 0}, folded).length == 0);
}

/* Of names that differ in a number, how far apart they are; worked out by hand. */
static void check_apart(void)
{
    static const struct {
        const char *a, *b;
        double apart;
    } pairs[] = {
        {"HERO 14", "HERO12 Black", 2},
        {"iPhone 18 pro", "iPhone 17", 1},
        {"EOS R55", "EOS R5", 50},
        {"EOS R5 II", "EOS R50", 45},
        {"Pixel 10", "Pixel 8", 2},
        {"D850", "D850", 0},
        {"A7 IV", "A7 III", 0},
        {"IMX420", "imx-421", 1},
        {"", "D5", 0},
        {"7", "12", 5},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        CHECK_NEAR(camera_name_numbers_apart(text_of(pairs[i].a), text_of(pairs[i].b)),
                   pairs[i].apart, 0, pairs[i].a);
        CHECK_NEAR(camera_name_numbers_apart(text_of(pairs[i].b), text_of(pairs[i].a)),
                   pairs[i].apart, 0, pairs[i].a);
    }
}

/* The hint of a name that no camera has. */
static void check_hint(struct lensdb *db, const char *typed, const char *hint)
{
    struct lensdb_sensor sensor;
    struct error error;
    CHECK(!lensdb_find_sensor(db, text_of(typed), &sensor, &error));
    const bool is_it = strstr(error.hint, hint) != NULL;
    if (!is_it) {
        fprintf(stderr, "%s: '%s'\n", typed, error.hint);
    }
    CHECK(is_it);
}

static void check_hints(struct lensdb *db)
{
    check_hint(db, "cannon 5d", "did you mean 'Canon EOS 5D'?");
    check_hint(db, "nikkon d850", "did you mean 'Nikon D850'?");
    check_hint(db, "fuij x-t5", "did you mean 'Fujifilm X-T5'?");
    check_hint(db, "sonny a7 iix", "nearest of its family: '");
    check_hint(db, "Pixel 9 Pro", "'Pixel 8' (9.8 x 7.35 mm), 'Pixel 8 Pro'");
    check_hint(db, "Samsung S24", "nearest of its family: 'Galaxy S24 Ultra'");
    check_hint(db, "zzz 5d", "see 'lenscalc list formats'");
}

struct folded_camera {
    char name[2 * MOST_CAMERA_NAME];
    struct sensor size;
};

static int folded_order(const void *a, const void *b)
{
    return strcmp(((const struct folded_camera *)a)->name, ((const struct folded_camera *)b)->name);
}

/* Cameras of one maker with one short name have one size. */
static void check_unique(struct lensdb *db)
{
    enum { MOST = 4000 };
    struct folded_camera *all = calloc(MOST, sizeof *all);
    struct lensdb_table cameras;
    struct lensdb_sensor camera;
    struct error error;
    size_t count = 0;
    CHECK(all != NULL && lensdb_sensors_open(&cameras, db, LENSDB_EMBEDDED, true, &error));
    while (all != NULL && count < MOST && lensdb_sensors_next(&cameras, &camera, &error)) {
        char folded[MOST_CAMERA_NAME];
        camera_name_fold(camera.name, folded);
        snprintf(all[count].name, sizeof all[count].name, "%.*s %s", (int)camera.maker.length,
                 camera.maker.start, folded);
        all[count++].size = camera.size;
    }
    CHECK(error.code == ERROR_NONE && count > 1000 && count < MOST);
    if (all != NULL) {
        qsort(all, count, sizeof *all, folded_order);
    }
    for (size_t i = 1; i < count; i++) {
        const bool is_same = strcmp(all[i].name, all[i - 1].name) == 0;
        const bool fits = !is_same || (all[i].size.width == all[i - 1].size.width &&
                                       all[i].size.height == all[i - 1].size.height);
        if (!fits) {
            fprintf(stderr, "%s is two cameras\n", all[i].name);
        }
        CHECK(fits);
    }
    free(all);
}

int main(void)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    check_names();
    check_apart();
    check_hints(&db);
    check_unique(&db);
    arena_free(&arena);
    return check_report();
}
