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
    check_unique(&db);
    arena_free(&arena);
    return check_report();
}
