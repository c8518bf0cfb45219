/* tests/unit/test_lensdb.c - the embedded tables, and a user's own before them. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "data/lensdb.h"

#include <stdlib.h>
#include <unistd.h>

static bool find(struct lensdb *db, const char *name, struct lensdb_sensor *sensor,
                 struct error *error)
{
    return lensdb_find_sensor(db, text_of(name), sensor, error);
}

/* Sizes: 135 film 36 x 24 mm (ISO 1007); Nikon D1 as the lecture's slides give it. */
static void check_embedded(struct lensdb *db)
{
    struct lensdb_sensor sensor;
    struct error error;
    CHECK(find(db, "35mm", &sensor, &error));
    CHECK(sensor.size.width == 36 && sensor.size.height == 24);
    CHECK(text_equal(sensor.confidence, "sourced"));
    CHECK(find(db, "full frame", &sensor, &error) && sensor.size.width == 36);
    CHECK(find(db, "nikon d1", &sensor, &error));
    CHECK(sensor.size.width == 23.7 && sensor.size.height == 15.6);
    CHECK_NEAR(sensor.size.pitch, 0.0116, 1e-18, "pitch of the D1, mm");
    CHECK(text_equal(sensor.pitch_from, "published"));
    CHECK(find(db, "D1H", &sensor, &error) && text_equal(sensor.pitch_from, "estimate"));
    CHECK(find(db, "D100", &sensor, &error) && text_equal(sensor.pitch_from, "counts"));
    CHECK(!find(db, "35m", &sensor, &error));
    CHECK(error.code == ERROR_USAGE && strstr(error.hint, "35mm") != NULL);
}

/* 2^(5/2) and 2^-7 s are the exact values behind f/5.6 and 1/125; ISO 100 is step 5. */
static void check_stops(struct lensdb *db)
{
    static const struct {
        const char *file, *label;
        double exact;
    } expected[] = {{"fstops.tsv", "5.6", 5.65685424949238019521},
                    {"fstops.tsv", "22", 22.6274169979695207808},
                    {"shutters.tsv", "1/125", 0.0078125},
                    {"shutters.tsv", "30", 32},
                    {"iso.tsv", "100", 100}};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        struct lensdb_stop *stops;
        struct error error;
        size_t count, at = 0;
        CHECK(lensdb_stops(db, expected[i].file, "full", &stops, &count, &error));
        while (at < count && !text_equal(stops[at].label, expected[i].label)) {
            at++;
        }
        CHECK(at < count);
        if (at < count) {
            CHECK_RELATIVE(stops[at].exact, expected[i].exact, 4e-16, expected[i].label);
        }
    }
}

static void write_file(const char *folder, const char *name, const char *content)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    CHECK(file != NULL && fputs(content, file) >= 0 && fclose(file) == 0);
}

static void remove_file(const char *folder, const char *name)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    unlink(path);
}

/* A user's table comes first; what is wrong in it is named with line and column. */
static void check_own(void)
{
    static const struct {
        const char *content;
        bool good;
        long line;
        int column;
    } tables[] = {
        {"name\twidth_mm\theight_mm\n35mm\t40\t30\n", true, 0, 0},
        {"\xef\xbb\xbf# mine\r\nname\twidth_mm\theight_mm\r\n35mm\t40\t30\r\n", true, 0, 0},
        {"name\twidth_mm\theight_mm\n35mm\tforty\t30\n", false, 2, 6},
        {"name\twidth_mm\theight_mm\n\n35mm\t-40\t30\n", false, 3, 6},
        {"name\twidth_mm\theight_mm\n35mm\t40\n", false, 2, 0},
        {"name\twidth_mm\n35mm\t40\n", false, 1, 0},
        {"name\tname\twidth_mm\theight_mm\n", false, 1, 0},
        {"", false, 0, 0},
    };
    char folder[] = "lensdb-test-XXXXXX";
    CHECK(mkdtemp(folder) != NULL);
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        struct arena arena = {0};
        struct lensdb db = {.arena = &arena, .directory = folder};
        struct lensdb_sensor sensor;
        struct error error = {0};
        write_file(folder, "formats.tsv", tables[i].content);
        bool found = find(&db, "35mm", &sensor, &error);
        check_at(found == tables[i].good, __FILE__, __LINE__, tables[i].content);
        if (tables[i].good) {
            CHECK(sensor.size.width == 40 && sensor.place == LENSDB_USER);
            CHECK(find(&db, "aps-c", &sensor, &error) && sensor.place == LENSDB_EMBEDDED);
        } else {
            check_at(error.code == ERROR_DATA, __FILE__, __LINE__, error.message);
            check_at(error.line == tables[i].line, __FILE__, __LINE__, error.message);
            check_at(error.column == tables[i].column, __FILE__, __LINE__, error.message);
        }
        arena_free(&arena);
    }
    remove_file(folder, "formats.tsv");
    rmdir(folder);
}

static void check_missing_folder(void)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena, .directory = "no-such-folder"};
    struct lensdb_sensor sensor;
    struct error error;
    CHECK(!find(&db, "35mm", &sensor, &error));
    CHECK(error.code == ERROR_IO);
    arena_free(&arena);
}

int main(void)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    check_embedded(&db);
    check_stops(&db);
    arena_free(&arena);
    check_own();
    check_missing_folder();
    return check_report();
}
