/* tests/unit/test_obj_file.c - .obj files: their triangles, and where they are wrong. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/obj_file.h"

#include <stdlib.h>

static const struct obj_question question = {"test.obj", 1000, 1e12, 6};

static bool read_text(const char *text, struct arena *arena, struct scene_mesh *mesh,
                      struct obj_passed *passed, struct error *error)
{
    return obj_read(&question, text_of(text), arena, mesh, passed, error);
}

#define CORNERS "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void check_errors(void)
{
    static const struct {
        const char *text;
        long line;
        int column;
        const char *message;
    } cases[] = {
        {"", 0, 0, "no face"},
        {CORNERS, 0, 0, "no face"},
        {CORNERS "f 1 2 4\n", 4, 7, "there is no 'v' 4: the file has 3"},
        {CORNERS "f 1 2 0\n", 4, 7, "there is no 'v' 0"},
        {CORNERS "f 1 2 -4\n", 4, 7, "there is no 'v' -4: up to here the file has 3"},
        {"v 0 0 0\nf 1 2 -2\n" CORNERS, 2, 7, "up to here the file has 1"},
        {CORNERS "f 1 2 -\n", 4, 7, "not the number"},
        {CORNERS "f 1 2 x\n", 4, 7, "'x' is not the number of a 'v'"},
        {CORNERS "f 1 2 3.5\n", 4, 7, "not the number"},
        {CORNERS "f 1 2 99999999999999999999999999\n", 4, 7, "not the number"},
        {CORNERS "f 1/1 2 3\n", 4, 5, "there is no 'vt' 1: the file has 0"},
        {CORNERS "f 1 2//1 3\n", 4, 8, "there is no 'vn' 1"},
        {CORNERS "f 1 2/1/1/1 3\n", 4, 7, "there is no 'vt'"},
        {CORNERS "vt 0\nvn 0 0 1\nf 1 2/1/1/1 3\n", 6, 11, "three numbers at most"},
        {CORNERS "f 1 2\n", 4, 6, "three corners, and has 2"},
        {CORNERS "f\n", 4, 2, "three corners, and has 0"},
        {CORNERS "f 1 2 3 1 2 3 1 2 3\n", 4, 19, "more than 6 triangles"},
        {"v 0 0\n", 1, 6, "a number is missing"},
        {"v 0 0 0 1 1 1 1 1\n", 1, 17, "does not belong here"},
        {"v 0 0,5 0\n", 1, 5, "'0,5' is not a number"},
        {"v 0 0 nan\n", 1, 7, "is not a number"},
        {"v 0 0 inf\n", 1, 7, "not within"},
        {"v 0 0 2e9\n", 1, 7, "not within -1e+09 to 1e+09"},
        {"vn 0 1\n", 1, 7, "a number is missing"},
        {"vn 0 1 0 1\n", 1, 10, "does not belong here"},
        {"vt\n", 1, 3, "a number is missing"},
        {"facet 1 2 3\n", 1, 1, "unknown word 'facet'"},
        {"vp 0 0\n", 1, 1, "free-form"},
        {"\xff\xfev", 1, 1, "UTF-16"},
        {"g a \\\nv 0 0 0\nf 1 1 1\n", 3, 3, "there is no 'v' 1: the file has 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct scene_mesh mesh;
        struct obj_passed passed;
        struct error error = {0};
        CHECK(!read_text(cases[i].text, &arena, &mesh, &passed, &error));
        const bool named = strstr(error.message, cases[i].message) != NULL;
        const bool placed = error.line == cases[i].line && error.column == cases[i].column;
        if (!named || !placed || error.code != ERROR_DATA) {
            printf("%s -> %ld:%d: %s\n", cases[i].text, error.line, error.column, error.message);
        }
        CHECK(named && placed && error.code == ERROR_DATA && strcmp(error.source, "test.obj") == 0);
        arena_free(&arena);
    }
}

static bool is_at(struct vector a, double x, double y, double z)
{
    return a.x == x && a.y == y && a.z == z;
}

/* A unit square as one face of four corners, with everything that a file may have. */
static void check_square(void)
{
    struct arena arena = {0};
    struct scene_mesh mesh;
    struct obj_passed passed;
    struct error error = {0};
    CHECK(read_text("# a square\r\nmtllib a.mtl\r\no square\r\n\r\n"
                    "v 0 0 0 1 0 0\r\nv 1 0 0 1 0 0\r\nv 1 1 0 1 0 0\r\nv 0 1 0 1 0 0\r\n"
                    "vt 0 0\r\nvt 1 0\r\nvt 1 1 0\r\nvt 0 1\r\nvn 0 0 2\r\n"
                    "g front\r\nusemtl red\r\ns 1\r\n"
                    "f 1/1/1 2/2/1 -2/-2/1 \\\r\n 4/4/-1 # all four\r\nl 1 2\r\n",
                    &arena, &mesh, &passed, &error));
    CHECK(mesh.corner_count == 4 && mesh.triangle_count == 2);
    CHECK(passed.materials && passed.lines && passed.colours && passed.unplaced == 0);
    for (size_t i = 0; i < 2; i++) {
        const size_t *t = mesh.triangles[i];
        CHECK(is_at(mesh.corners[t[0]], 0, 0, 0));
        CHECK(is_at(mesh.corners[t[1]], 1000, i == 0 ? 0 : 1000, 0));
        CHECK(is_at(mesh.corners[t[2]], i == 0 ? 1000 : 0, 1000, 0));
        for (int k = 0; k < 3; k++) {
            CHECK(is_at(mesh.normals[t[k]], 0, 0, 1));
            CHECK(mesh.places[t[k]][0] == mesh.corners[t[k]].x / 1000);
            CHECK(mesh.places[t[k]][1] == mesh.corners[t[k]].y / 1000);
        }
    }
    CHECK_TEXT(mesh.file, "test.obj");
    arena_free(&arena);
}

/* The same three places in another order, or as other corners, are the same triangle. */
static void check_twice(void)
{
    struct arena arena = {0};
    struct scene_mesh mesh;
    struct obj_passed passed;
    struct error error = {0};
    CHECK(read_text(CORNERS "v -0 0 0\nv 0 0 1\nvn 0 0 1\n"
                            "f 1 2 3\nf 1 2 5\nf 3//1 1//1 2//1\nf 2 4 3\nf 5 1 2\nf 2 3 5\n",
                    &arena, &mesh, &passed, &error));
    CHECK(mesh.triangle_count == 3 && passed.twice == 3);
    for (size_t i = 0; i < 3; i++) {
        const struct vector last = mesh.corners[mesh.triangles[i][2]];
        CHECK(is_at(last, 0, i == 0 ? 1000 : 0, i == 0 ? 0 : 1000));
    }
    /* the triangles of this fan are 1 2 3, 1 3 1, 1 1 2 and 1 2 3 again */
    CHECK(read_text(CORNERS "f 1 2 3 1 2 3\n", &arena, &mesh, &passed, &error));
    CHECK(mesh.triangle_count == 3 && passed.twice == 1);
    arena_free(&arena);
}

/* What goes on from the line above is part of it, whatever it looks like. */
static void check_continued(void)
{
    struct arena arena = {0};
    struct scene_mesh mesh;
    struct obj_passed passed;
    struct error error = {0};
    CHECK(read_text("g a \\\nv 5 5 5\n\\\nv 0 0 0\n# \\\nv 1 0 0\nv 0 1 \\\n 0\nf 1 2 3\n", &arena,
                    &mesh, &passed, &error));
    CHECK(mesh.corner_count == 3 && mesh.triangle_count == 1);
    CHECK(is_at(mesh.corners[0], 0, 0, 0) && is_at(mesh.corners[2], 0, 1000, 0));
    arena_free(&arena);
}

/* Faces without normals beside one with them; a corner in two faces; faces before their corners. */
static void check_normals(void)
{
    struct arena arena = {0};
    struct scene_mesh mesh;
    struct obj_passed passed;
    struct error error = {0};
    CHECK(read_text("f 1 2 3\nf 1 3 4\n" CORNERS "v 0 0 1\n", &arena, &mesh, &passed, &error));
    CHECK(mesh.corner_count == 4 && mesh.normals == NULL && mesh.places == NULL);
    CHECK(read_text(CORNERS "v 0 0 1\nvn 0 0 -1\nvn 0 0 0\nvt 0 0\n"
                            "f 1//1 2//1 3//1\nf 1 3 4\nf 1//2 2/1 4\n",
                    &arena, &mesh, &passed, &error));
    CHECK(mesh.triangle_count == 3 && passed.unplaced == 3);
    for (size_t i = 0; i < mesh.corner_count; i++) {
        CHECK_NEAR(vector_length(mesh.normals[i]), 1, 1e-15, "every corner has a normal");
    }
    for (int k = 0; k < 3; k++) {
        CHECK(is_at(mesh.normals[mesh.triangles[0][k]], 0, 0, -1));
        /* (0,1,0) x (0,0,1), and (1,0,0) x (0,0,1) */
        CHECK(is_at(mesh.normals[mesh.triangles[1][k]], 1, 0, 0));
        CHECK(is_at(mesh.normals[mesh.triangles[2][k]], 0, -1, 0));
    }
    arena_free(&arena);
}

/* Twice the area of all triangles, in mm^2. */
static double twice_area(const struct scene_mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const size_t *t = mesh->triangles[i];
        const struct vector a = mesh->corners[t[0]];
        sum += vector_length(vector_cross(vector_minus(mesh->corners[t[1]], a),
                                          vector_minus(mesh->corners[t[2]], a)));
    }
    return sum;
}

/* An L about each of its corners, before them in the file; a bow is a fan about its first. */
static void check_concave(void)
{
    for (int start = 0; start < 6; start++) {
        struct arena arena = {0};
        struct scene_mesh mesh;
        struct obj_passed passed;
        struct error error = {0};
        const char *face = arena_printf(
            &arena,
            "f %d %d %d %d %d %d\nv 0 1 5\nv 0 0 5\nv 1 0 5\nv 1 .25 5\nv .25 .25 5\nv .25 1 5\n",
            start + 1, (start + 1) % 6 + 1, (start + 2) % 6 + 1, (start + 3) % 6 + 1,
            (start + 4) % 6 + 1, (start + 5) % 6 + 1);
        CHECK(read_text(face, &arena, &mesh, &passed, &error));
        CHECK(mesh.triangle_count == 4 && passed.crossed == 0);
        CHECK_NEAR(twice_area(&mesh), 2e6 * (0.25 + 0.75 * 0.25), 1e-3, "an L");
        CHECK(read_text(CORNERS "v 2 2 0\nf 1 4 2 3\n", &arena, &mesh, &passed, &error));
        CHECK(mesh.triangle_count == 2 && passed.crossed == 1);
        arena_free(&arena);
    }
}

int main(void)
{
    check_errors();
    check_square();
    check_continued();
    check_twice();
    check_concave();
    check_normals();
    return check_report();
}
