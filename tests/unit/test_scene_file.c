/* tests/unit/test_scene_file.c - .scene files: what they say, and where they are wrong. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/scene_file.h"
#include "scene/scene.h"

/* Files that lie beside "there/test.scene", and no others. */
static const struct beside {
    const char *path, *content;
} beside[] = {
    {"there/flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"},
    {"there/bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 5\n"},
    {"there/leaf.tsv", "wavelength_nm\treflectance\n400\t0.05\n550\t0.25\n700\t0.5\n"},
    {"there/lamp.tsv", "wavelength_nm,relative\n380,1\n780,100\n"},
    {"there/down.tsv", "wavelength_nm\tvalue\n500\t1\n400\t1\n"},
    {"there/dark.tsv", "# light\nwavelength_nm\tvalue\n\n500\t1\n600\t-0.1\n"},
    {"there/much.tsv", "wavelength_nm\tvalue\n500\t1\n600\t2e9\n"},
    {"there/zero.tsv", "wavelength_nm\tvalue\n0\t1\n600\t1\n"},
    {"there/a #1.tsv", "wavelength_nm\tvalue\n300\t1\n900\t1\n"},
    {"there/short.tsv", "wavelength_nm\tvalue\n500\t1\n"},
    {"there/wide.tsv", "wavelength_nm\tvalue\tmore\n500\t1\t1\n600\t1\t1\n"},
    {"there/cell.tsv", "wavelength_nm\tvalue\n500\tx\n600\t1\n"},
    {"/absolute.tsv", "wavelength_nm\tvalue\n300\t1\n900\t1\n"},
};

static bool read_beside(void *context, const char *path, struct arena *arena, struct text *content,
                        struct error *error)
{
    (void)context;
    (void)arena;
    for (size_t i = 0; i < sizeof beside / sizeof beside[0]; i++) {
        if (strcmp(path, beside[i].path) == 0) {
            *content = text_of(beside[i].content);
            return true;
        }
    }
    return fail(error, ERROR_IO, "there is no file %s", path);
}

/* Pictures: two pixels as PFM, whose rows are upwards and whose floats are little-endian. */
static bool read_picture(void *context, const char *path, struct arena *arena, struct text *content,
                         struct error *error)
{
    static const struct {
        const char *path;
        float pixels[6];
        size_t cut;
    } pictures[] = {
        {"nan.pfm", {1, 1, 1, 1, NAN, 1}, 0},       {"bright.pfm", {1, 1, 1, 1, 1, 1.5F}, 0},
        {"dark.pfm", {1, 1, 1, 1, 1, -0.5F}, 0},    {"cut.pfm", {1, 1, 1, 1, 1, 1}, 3},
        {"good.pfm", {1, 1, 1, 0.5F, 0.25F, 0}, 0}, {"tall.pfm", {1, 1, 1, 1, 1, 1}, 0},
        {"black.pfm", {0, 0, 0, 0, 0, 0}, 0}};
    (void)context;
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++) {
        const bool is_tall = strcmp(path, "tall.pfm") == 0;
        const char *head = is_tall ? "PF\n1 2\n-1.0\n" : "PF\n2 1\n-1.0\n";
        const size_t length = strlen(head);
        if (strcmp(path, pictures[i].path) == 0) {
            char *bytes = arena_array(arena, 1, length + sizeof pictures[i].pixels);
            memcpy(bytes, head, length);
            memcpy(bytes + length, pictures[i].pixels, sizeof pictures[i].pixels);
            *content = (struct text){bytes, length + sizeof pictures[i].pixels - pictures[i].cut};
            return true;
        }
    }
    return fail(error, ERROR_IO, "there is no file %s", path);
}

#define CAMERA "camera at=0,0,5 look=0,0,0\n"
#define GREY   "material grey lambert colour=0.5\n"

static bool read_text(const char *text, struct arena *arena, struct scene *scene,
                      struct error *error)
{
    return scene_file_read("test.scene", text_of(text), &scene_files_there, arena, scene, error);
}

/* Each with the line, the column and a part of the message. */
static const struct {
    const char *text;
    long line;
    int column;
    const char *message;
} bad[] = {
    {"", 0, 0, "no camera"},
    {"scene a\nscene b\n", 2, 1, "twice"},
    {"sphear radius=1\n", 1, 1, "unknown word 'sphear'"},
    {CAMERA "unit cm\n", 2, 1, "before all lengths"},
    {"unit cm\nunit cm\n", 2, 1, "once"},
    {"unit kg\n", 1, 6, "one of length"},
    {"unit cm mm\n", 1, 9, "does not belong here"},
    {"camera look=0,0,0\n", 1, 1, "lacks at="},
    {CAMERA CAMERA, 2, 1, "twice"},
    {"camera at=0,0 look=0,0,0\n", 1, 11, "needs 3 numbers with commas between, and has 2"},
    {"camera at=0,0,0,0\n", 1, 17, "more than 3 numbers"},
    {"camera at=0,,0\n", 1, 13, "a number of at= is missing"},
    {"camera at=0,0,5mn look=0,0,0\n", 1, 16, "at=: unknown unit 'mn'"},
    {"camera at=0,0,5s look=0,0,0\n", 1, 16, "measures a time, expected a length"},
    {"camera at=0,0,x\n", 1, 15, "no number here"},
    {"camera at=0,0,2e9\n", 1, 15, "not within -1e9 m to 1e9 m"},
    {"camera at=0,0,inf\n", 1, 15, "not within"},
    {"camera at=0,0,nan\n", 1, 15, "nan is not a value"},
    {"camera at=0,0,5 look=0,0,5\n", 1, 22, "at its own place"},
    {"camera at=0,5,0 look=0,0,0\n", 1, 22, "looks along its up="},
    {"camera at=0,0,5 look=0,0,0 up=0,0,2\n", 1, 31, "looks along its up="},
    {"camera at=0,0,5 look=0,0,0 up=0,0,0\n", 1, 31, "no length"},
    {"camera at=0,0,5 axis=0,1,0\n", 1, 22, "no spin="},
    {"camera at=0,0,5 spin=1 axis=0,0,0\n", 1, 29, "no length"},
    {"camera at=0,0,5 focus=0\n", 1, 23, "not within 1 nm to inf"},
    {"camera at=0,0,5 from=sensor\n", 1, 22, "from= needs focus="},
    {"camera at=0,0,5 focus=3 from=sensr\n", 1, 30, "from= is entrance, principal, sensor or"},
    {"camera at=0,0,5 at=0,0,4\n", 1, 17, "'at=' is there twice"},
    {"camera at=0,0,5 radius=4\n", 1, 17, "'radius=' does not belong to 'camera'"},
    {"camera at=0,0,5 loook=4\n", 1, 17, "unknown word 'loook=4'"},
    {"camera at=0,0,5 look\n", 1, 17, "look= has no value"},
    {"camera at=0,0,5 move=4e8,0,0\n", 1, 22, "299792458 m/s"},
    {"camera at=0,0,5 look=\n", 1, 22, "look= has no value"},
    {"camera at=0,0,5 look=\"0,0,0\n", 1, 22, "quotation marks"},
    {"colour\n", 1, 7, "a colour needs a name"},
    {"colour 5x rgb=1\n", 1, 8, "cannot be a name"},
    {"colour red\n", 1, 1, "one of rgb="},
    {"colour red rgb=1 srgb=#fff\n", 1, 1, "one of rgb="},
    {"colour red rgb=1,2\n", 1, 16, "one number, a grey, or red, green and blue"},
    {"colour red rgb=1,-2,0\n", 1, 18, "-2 is no part of a colour"},
    {"colour red rgb=1,x,0\n", 1, 18, "no part of a colour"},
    {"colour red srgb=#80808\n", 1, 17, "six digits"},
    {"colour red srgb=#80808g\n", 1, 17, "six digits"},
    {"colour D65 rgb=1\n", 1, 8, "a light that is known"},
    {"colour red spectrum=D66\n", 1, 21, "unknown light 'D66'"},
    {"colour red spectrum=A\nmaterial b lambert colour=red\n", 2, 27, "the colour of a light"},
    {"material b lambert colour=5600K\n", 1, 27, "the colour of a light"},
    {"colour red rgb=1\ncolour red rgb=1\n", 2, 8, "twice"},
    {"material a\n", 1, 11, "lambert, mirror, glossy or black"},
    {"material a lambart colour=1\n", 1, 12, "not 'lambart'"},
    {"material a lambert\n", 1, 1, "needs colour= or texture="},
    {"material a lambert colour=1.01\n", 1, 27, "at most 1 of the light"},
    {"material a lambert colour=wood\n", 1, 27, "no line above has the colour 'wood'"},
    {"material a lambert colour=1 roughness=1\n", 1, 29, "does not belong to 'material a lambert'"},
    {"material a glossy colour=1\n", 1, 1, "lacks roughness="},
    {"material a glossy colour=1 roughness=0\n", 1, 38, "not within 0.001 to 1"},
    {"material a glossy colour=1 roughness=1 index=4\n", 1, 46, "not within 1 to 3"},
    {"material a black emission=1\n", 1, 27, "needs luminance="},
    {"material a black emission=0 luminance=1\n", 1, 27, "is dark"},
    {"material a black luminance=0\n", 1, 28, "not within"},
    {"material a lambert texture=there-is-none.png\n", 1, 28, "no file there-is-none.png"},
    {"material a lambert texture=/dev/zero\n", 1, 28, "/dev/zero: no regular file"},
    {GREY GREY, 2, 10, "twice"},
    {"sphere material=gray radius=1\n", 1, 17, "no line above has the material 'gray'"},
    {GREY "sphere radius=1\n", 2, 1, "lacks material="},
    {GREY "sphere material=grey\n", 2, 1, "lacks radius="},
    {GREY "sphere material=grey radius=0\n", 2, 29, "not within 1 nm"},
    {GREY "disc material=grey radius=-1\n", 2, 27, "not within 1 nm"},
    {GREY "box material=grey size=1,2\n", 2, 24, "has 3 numbers, not 2"},
    {GREY "box material=grey size=1,2,0\n", 2, 28, "not within"},
    {GREY "card material=grey size=1\n", 2, 25, "has 2 numbers, not 1"},
    {GREY "card material=grey size=1,2,3\n", 2, 25, "has 2 numbers, not 3"},
    {GREY "card material=grey size=1,2 luminance=1\n", 2, 39, "that of a picture"},
    {GREY "card size=1,2\n", 2, 1, "a card has a picture"},
    {GREY "card material=grey size=1,2 normal=0,1,0 up=0,2,0\n", 2, 45, "along the normal"},
    {GREY "plane material=grey repeat=1\n", 2, 28, "the material has none"},
    {GREY "plane material=grey normal=0,0,0\n", 2, 28, "no length"},
    {"light\n", 1, 6, "sun, sky, point, environment or star"},
    {"light bulb\n", 1, 7, "not 'bulb'"},
    {"light sun illuminance=1\n", 1, 1, "'light sun' lacks a direction"},
    {"light sun illuminance=1 azimuth=3\n", 1, 1, "lacks a direction"},
    {"light sun illuminance=1 azimuth=3 towards=0,1,0\n", 1, 43, "elevation= and azimuth="},
    {"light sun illuminance=1 azimuth=3 elevation=91\n", 1, 45, "not within -90 deg"},
    {"light sun towards=0,1,0\n", 1, 1, "lacks illuminance="},
    {"light sky luminance=1\n", 1, 11, "uniform, overcast or clear"},
    {"light sky overcast luminance=1 towards=0,1,0\n", 1, 1, "only a clear sky"},
    {CAMERA "light sky clear luminance=1\n", 2, 1, "needs the direction of the sun"},
    {"light point at=0,0,0\n", 1, 1, "needs intensity= or power="},
    {"light point at=0,0,0 power=1 intensity=1\n", 1, 1, "one of them"},
    {"light point at=0,0,0 intensity=1lm\n", 1, 33, "unit"},
    {"light environment luminance=1\n", 1, 1, "lacks file="},
    {"light star towards=0,1,0\n", 1, 1, "needs magnitude= or illuminance="},
    {"light star magnitude=50 towards=0,1,0\n", 1, 22, "not within -30 to 40"},
    {"scene a\x01\n", 1, 8, "control character"},
};

static void check_errors(void)
{
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct arena arena = {0};
        struct scene scene;
        struct error error = {0};
        CHECK(!read_text(bad[i].text, &arena, &scene, &error));
        const bool named = strstr(error.message, bad[i].message) != NULL;
        const bool placed = error.line == bad[i].line && error.column == bad[i].column;
        if (!named || !placed || error.code != ERROR_DATA) {
            printf("%s -> %ld:%d: %s\n", bad[i].text, error.line, error.column, error.message);
        }
        CHECK(named && placed && error.code == ERROR_DATA);
        arena_free(&arena);
    }
}

static bool is_near(struct vector a, double x, double y, double z)
{
    return vector_length(vector_minus(a, (struct vector){x, y, z})) <=
           1e-12 * (1 + vector_length(a));
}

/* By hand: a unit of cm, units of other kinds, motion, a sphere that spins. */
static void check_numbers(void)
{
    struct arena arena = {0};
    struct scene scene;
    struct error error = {0};
    CHECK(read_text("\xef\xbb\xbfscene  Things # of all kinds\r\nunit cm\r\n"
                    "camera at=0,1m,2ft look=0,1m,-3 focus=inf from=front move=1,2m/s,36km/h\r\n"
                    "colour leaf srgb=#0080ff\r\n"
                    "material skin glossy colour=leaf roughness=0.2\r\n"
                    "material lamp black luminance=5000\r\n"
                    "sphere material=skin radius=5mm at=1,2,3 spin=60rpm axis=0,0,2\r\n"
                    "box material=lamp size=1,2,3in turn=90,0,0\r\n"
                    "light sun illuminance=90000 elevation=30 azimuth=90\r\n"
                    "light sky clear luminance=4000\r\n"
                    "light point at=0,0,0 power=1256.6370614359172\r\n"
                    "light star magnitude=5 towards=0,0,-9 spectrum=10000K\r\n",
                    &arena, &scene, &error));
    CHECK_TEXT(scene.title, "Things");
    CHECK(scene.material_count == 2 && scene.thing_count == 2 && scene.light_count == 4);
    const struct scene_camera *camera = &scene.camera;
    CHECK(is_near(camera->where.at, 0, 1000, 609.6) && isinf(camera->distance) &&
          camera->from == SCENE_FROM_FRONT);
    CHECK(is_near(camera->where.velocity, 10, 2000, 10000));
    CHECK(is_near(camera->where.turned.z, 0, 0, 1) && is_near(camera->where.turned.y, 0, 1, 0));
    const struct scene_material *skin = &scene.materials[0];
    CHECK(skin->kind == MATERIAL_GLOSSY && skin->roughness == 0.2 && skin->index == 1.5);
    CHECK(skin->emission.kind == SPECTRUM_NONE && skin->texture == NULL);
    /* ((128/255 + 0.055)/1.055)^2.4, [IEC99] */
    CHECK(skin->colour.rgb[0] == 0 && skin->colour.rgb[2] == 1);
    CHECK_RELATIVE(skin->colour.rgb[1], 0.21586050011389926, 1e-14, "green");
    CHECK(scene.materials[1].luminance == 5000 && scene.materials[1].emission.rgb[1] == 1);
    const struct scene_thing *sphere = &scene.things[0], *box = &scene.things[1];
    CHECK(sphere->radius == 5 && is_near(sphere->where.at, 10, 20, 30) && sphere->material == 0);
    CHECK_RELATIVE(sphere->where.spin, 2 * 3.14159265358979323846, 1e-15, "a turn a second");
    CHECK(is_near(sphere->where.axis, 0, 0, 1) && sphere->place.line == 7);
    CHECK(is_near(box->size, 10, 20, 76.2));
    CHECK(is_near(box->where.turned.y, 0, 0, 1) && is_near(box->where.turned.z, 0, -1, 0));
    /* the sun in the east, 30 degrees high, and the sky about it */
    CHECK(is_near(scene.lights[0].direction, sqrt(0.75), 0.5, 0));
    CHECK(is_near(scene.lights[1].direction, sqrt(0.75), 0.5, 0));
    CHECK_RELATIVE(scene.lights[2].amount, 100.0, 1e-14, "lm over 4 pi");
    CHECK_RELATIVE(scene.lights[3].amount, 2.54e-8, 1e-14, "five magnitudes are a hundredth");
    CHECK(is_near(scene.lights[3].direction, 0, 0, -1));
    CHECK(scene.lights[2].spectrum.kind == SPECTRUM_RGB && scene.lights[2].spectrum.rgb[2] == 1);
    CHECK(scene.lights[3].spectrum.kind == SPECTRUM_DAYLIGHT);
    arena_free(&arena);
}

/* Turned axes are at right angles and right-handed; directions by hand. */
static void check_frames(void)
{
    static const struct {
        const char *words;
        struct vector y, z;
    } cases[] = {
        {"", {0, 1, 0}, {0, 0, 1}},
        {"normal=0,1,0", {0, 0, -1}, {0, 1, 0}},
        {"normal=0,-2,0", {0, 0, 1}, {0, -1, 0}},
        {"normal=1,0,0", {0, 1, 0}, {1, 0, 0}},
        {"normal=0,1,0 up=1,0,0", {1, 0, 0}, {0, 1, 0}},
        {"up=1,0,0", {1, 0, 0}, {0, 0, 1}},
        {"turn=0,90,0", {0, 1, 0}, {1, 0, 0}},
        {"turn=0,0,90", {-1, 0, 0}, {0, 0, 1}},
        /* about x, then about the new y, which is the old z: the new z, -y, goes to x */
        {"turn=90,90,0", {0, 0, 1}, {1, 0, 0}},
        /* in its own plane, behind the normal */
        {"normal=0,1,0 turn=0,0,90", {-1, 0, 0}, {0, 1, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct scene scene;
        struct error error = {0};
        const char *text =
            arena_printf(&arena, CAMERA GREY "card material=grey size=1,1 %s\n", cases[i].words);
        CHECK(read_text(text, &arena, &scene, &error));
        const struct frame *own = &scene.things[0].where.turned;
        const struct vector y = cases[i].y, z = cases[i].z, x = vector_cross(y, z);
        if (!is_near(own->y, y.x, y.y, y.z) || !is_near(own->z, z.x, z.y, z.z)) {
            printf("%s: y %g %g %g, z %g %g %g\n", cases[i].words, own->y.x, own->y.y, own->y.z,
                   own->z.x, own->z.y, own->z.z);
        }
        CHECK(is_near(own->x, x.x, x.y, x.z) && is_near(own->y, y.x, y.y, y.z) &&
              is_near(own->z, z.x, z.y, z.z));
        arena_free(&arena);
    }
}

/* Scenes of which nothing is seen. */
static void check_light(void)
{
    const struct scene_files files = {read_picture, NULL};
    static const struct {
        const char *text;
        int bounces;
        const char *message; /* null: it is good */
    } cases[] = {
        {CAMERA GREY "sphere material=grey radius=1\n", 4, "has no light"},
        {CAMERA GREY "light sky uniform luminance=1\n", 0, NULL},
        {CAMERA "material lamp black luminance=1\n", 0, "has no light"},
        {CAMERA "material lamp black luminance=1\nsphere material=lamp radius=1\n", 0, NULL},
        {CAMERA "light point at=0,1,0 intensity=1\n", 4, "falls on nothing"},
        {CAMERA GREY "sphere material=grey radius=1\nlight point at=0,9,0 intensity=1\n", 1, NULL},
        {CAMERA GREY "sphere material=grey radius=1\nlight point at=0,9,0 intensity=1\n", 0,
         "not seen by themselves"},
        {CAMERA "light star magnitude=0 towards=0,0,-1\n", 0, NULL},
        {CAMERA "light environment file=black.pfm luminance=1\n", 0, "would shine are black"},
        {CAMERA "light environment file=good.pfm luminance=1\n", 0, NULL},
        {CAMERA "card file=black.pfm size=1 luminance=1\n", 0, "would shine are black"},
        {CAMERA "card file=good.pfm size=1 luminance=1\n", 0, NULL},
        {CAMERA "card file=good.pfm size=1\n", 0, "a line 'light'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct scene scene;
        struct error error = {0};
        CHECK(
            scene_file_read("test.scene", text_of(cases[i].text), &files, &arena, &scene, &error));
        CHECK(scene_check(&scene, cases[i].bounces, &error) == (cases[i].message == NULL));
        CHECK(cases[i].message == NULL || (strstr(error.message, cases[i].message) != NULL &&
                                           strcmp(error.source, "test.scene") == 0));
        arena_free(&arena);
    }
}

#define MESH(name)  GREY "mesh material=grey file=" name "\n"
#define TABLE(name) "colour leaf table=" name "\n"

/* What lies beside the scene: an error of a mesh or a table is in that file. */
static void check_beside(void)
{
    static const struct {
        const char *text, *source;
        long line;
        int column;
        const char *message;
    } cases[] = {
        {MESH("none.obj"), "there/test.scene", 2, 25, "there is no file there/none.obj"},
        {MESH("bad.obj"), "there/bad.obj", 4, 7, "there is no 'v' 5"},
        {TABLE("none.tsv"), "there/test.scene", 1, 19, "there is no file there/none.tsv"},
        {TABLE("flat.obj"), "there/flat.obj", 1, 0, "the first column"},
        {TABLE("down.tsv"), "there/down.tsv", 3, 0, "400 nm is not above 500"},
        {TABLE("dark.tsv"), "there/dark.tsv", 5, 0, "the value -0.1 is not within 0 to 1e+09"},
        {TABLE("much.tsv"), "there/much.tsv", 3, 0, "the value 2e+09 is not within"},
        {TABLE("zero.tsv"), "there/zero.tsv", 2, 0, "the wavelength 0 nm is not a number above 0"},
        /* quotation marks keep a comment from beginning in a value, and only there */
        {TABLE("\"a #1.tsv\" more"), "there/test.scene", 1, 30, "unknown word 'more'"},
        {TABLE("\"a #1.tsv\" # more\nmore"), "there/test.scene", 2, 1, "unknown word 'more'"},
        {TABLE("\"a #1.tsv # x"), "there/test.scene", 1, 19, "quotation marks"},
        {"scene 5\" ball # the \" one\n" TABLE("\"a #2.tsv\""), "there/test.scene", 2, 20,
         "there is no file there/a #2.tsv"},
        {TABLE("short.tsv"), "there/short.tsv", 0, 0, "at least two rows"},
        {TABLE("wide.tsv"), "there/wide.tsv", 0, 0, "two columns"},
        {TABLE("cell.tsv"), "there/cell.tsv", 2, 5, "number"},
        {TABLE("lamp.tsv") "material a lambert colour=leaf\n", "there/test.scene", 2, 27,
         "says 100"},
    };
    const struct scene_files files = {read_beside, NULL};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct scene scene;
        struct error error = {0};
        CHECK(!scene_file_read("there/test.scene", text_of(cases[i].text), &files, &arena, &scene,
                               &error));
        const bool named = strstr(error.message, cases[i].message) != NULL;
        const bool placed = error.line == cases[i].line && error.column == cases[i].column &&
                            strcmp(error.source, cases[i].source) == 0;
        if (!named || !placed || error.code != ERROR_DATA) {
            printf("%s -> %s:%ld:%d: %s\n", cases[i].text, error.source, error.line, error.column,
                   error.message);
        }
        CHECK(named && placed && error.code == ERROR_DATA);
        arena_free(&arena);
    }
}

static void check_pictures(void)
{
    static const struct {
        const char *text;
        const char *message; /* null: it is good */
    } cases[] = {
        {"material a lambert texture=good.pfm\n", NULL},
        {"material a lambert texture=nan.pfm\n", "nan.pfm: "},
        {"material a lambert texture=bright.pfm\n", "column 2, row 1 is brighter than 1"},
        {"material a lambert texture=dark.pfm\n", "dark.pfm: "},
        {"material a lambert texture=cut.pfm\n", "cut.pfm: "},
        {"card size=1 file=bright.pfm\n", "brighter than 1"},
        {"card size=1 file=bright.pfm luminance=100\n", NULL},
        {"light environment file=bright.pfm luminance=100\n", NULL},
        {"light environment file=tall.pfm luminance=100\n", "twice as wide as high"},
        {"light environment file=nan.pfm luminance=100\n", "column 2, row 1"},
        {"material a mirror texture=good.pfm\nplane material=a\n", "needs repeat="},
    };
    const struct scene_files files = {read_picture, NULL};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct scene scene;
        struct error error = {0};
        const char *text = arena_printf(&arena, CAMERA "%s", cases[i].text);
        const bool is_read =
            scene_file_read("test.scene", text_of(text), &files, &arena, &scene, &error);
        CHECK(is_read == (cases[i].message == NULL));
        if (!is_read && (strstr(error.message, cases[i].message) == NULL ||
                         strcmp(error.source, "test.scene") != 0 || error.line < 2)) {
            printf("%s -> %s:%ld:%d: %s\n", cases[i].text, error.source, error.line, error.column,
                   error.message);
        }
        CHECK(is_read || (strstr(error.message, cases[i].message) != NULL &&
                          error.code == ERROR_DATA && error.line >= 2));
        arena_free(&arena);
    }
}

/* A card has the shape of its picture; what is named twice is read once; all is in the digest. */
static void check_loaded(void)
{
    const struct scene_files files = {read_picture, NULL}, others = {read_beside, NULL};
    struct arena arena = {0};
    struct scene scene, again;
    struct error error = {0};
    const char *text = CAMERA "card size=3 file=good.pfm\ncard size=1,1 file=\"good.pfm\"\n";
    CHECK(scene_file_read("test.scene", text_of(text), &files, &arena, &scene, &error));
    CHECK(scene.things[0].size.x == 3000 && scene.things[0].size.y == 1500);
    CHECK(scene.things[1].size.y == 1000 && scene.things[0].material == SCENE_NONE);
    CHECK(scene.things[0].picture == scene.things[1].picture && !scene.things[0].shines);
    CHECK(scene.things[0].picture->channels == 3 && scene.things[0].picture->pixels[4] == 0.25F);
    text = CAMERA "material a mirror texture=good.pfm\nplane material=a repeat=3\n";
    CHECK(scene_file_read("test.scene", text_of(text), &files, &arena, &scene, &error));
    CHECK(scene.things[0].repeat[0] == 3000 && scene.things[0].repeat[1] == 1500);
    const char *mesh = CAMERA TABLE("leaf.tsv") "material grey lambert colour=leaf\n"
                                                "mesh material=grey file=flat.obj scale=0.5\n"
                                                "mesh material=grey file=flat.obj scale=0.5 "
                                                "at=1,0,0\n";
    CHECK(scene_file_read("there/test.scene", text_of(mesh), &others, &arena, &scene, &error));
    CHECK(scene.things[0].mesh == scene.things[1].mesh &&
          scene.things[0].mesh->triangle_count == 1);
    CHECK(scene.things[0].mesh->corners[1].x == 500 && scene.things[1].where.at.x == 1000);
    CHECK(scene.note_count == 2 && strstr(scene.notes[1], "flat.obj: passed over: materials"));
    CHECK(strstr(scene.notes[0], "leaf.tsv: from 400 to 700 nm") != NULL);
    /* a table is read once, and noted once */
    const char *leaves = CAMERA TABLE("leaf.tsv") "colour twin table=leaf.tsv\n"
                                                  "material a lambert colour=leaf\n"
                                                  "material b lambert colour=twin\n";
    CHECK(scene_file_read("there/test.scene", text_of(leaves), &others, &arena, &again, &error));
    CHECK(again.materials[0].colour.value == again.materials[1].colour.value);
    CHECK(again.note_count == 1);
    const struct spectrum *leaf = &scene.materials[0].colour;
    CHECK(leaf->kind == SPECTRUM_TABLE && leaf->count == 3 && leaf->value[1] == 0.25);
    CHECK_RELATIVE(leaf->wavelength[1], 0.55, 1e-15, "um");
    CHECK(scene_file_read("there/test.scene", text_of(mesh), &others, &arena, &again, &error));
    CHECK_TEXT(again.digest.text, scene.digest.text);
    const char *other = CAMERA TABLE("/absolute.tsv");
    CHECK(scene_file_read("there/test.scene", text_of(other), &others, &arena, &again, &error));
    CHECK(strcmp(again.digest.text, scene.digest.text) != 0);
    /* nobody reads files for it */
    CHECK(!scene_file_read("test.scene", text_of(text), NULL, &arena, &scene, &error));
    CHECK(strstr(error.message, "no file may be named") != NULL && error.line == 2);
    arena_free(&arena);
}

int main(void)
{
    check_beside();
    check_pictures();
    check_loaded();
    check_errors();
    check_numbers();
    check_frames();
    check_light();
    return check_report();
}
