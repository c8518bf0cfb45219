/* tests/unit/test_chief.c - the ray through the centre of the stop, where straight lines say it. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/chief.h"

static const double degree = RADIANS_PER_DEGREE;

struct opened {
    struct lens lens;
    struct system system;
    struct first_order first;
    struct conjugate_object object;
};

static void open_text(const char *text, struct arena *arena, struct opened *opened)
{
    struct error error = {0};
    struct system_options options = system_options_default();
    bool good = lens_read("test", text_of(text), NULL, arena, &opened->lens, &error) &&
                system_compile(&opened->lens, 0.55, &options, arena, &opened->system, &error) &&
                first_order_of_lens(&opened->lens, 0.55, SECTION_Y, arena, &opened->first, &error);
    CHECK(good);
    if (!good) {
        printf("%s: %s\n", text, error.message);
    }
    opened->object = lens_object(&opened->lens);
}

static bool open_aim(const struct opened *opened, double x, double y, struct arena *arena,
                     struct aim *aim, struct error *error)
{
    const struct field_point field = {opened->object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT,
                                      {x, y}};
    struct beam beam;
    return beam_of_field(&field, &opened->object, &opened->first, &beam, error) &&
           aim_open(&opened->system, &beam, arena, aim, error);
}

/* The line of a ray at a plane z, of the frame it starts in. */
static void at_plane(const struct ray *ray, double z, double point[2])
{
    double t = (z - ray->point[2]) / ray->cosine[2];
    point[0] = ray->point[0] + t * ray->cosine[0];
    point[1] = ray->point[1] + t * ray->cosine[1];
}

/*
 * A stop 30 mm behind a hole, in air: the chief ray is the straight line through its centre, and
 * what a step in a or b moves in the stop is what it moves straight lines. Round about the axis,
 * decentred, and tilted about x, so that its own y is longer by 1/cos.
 */
static void test_straight(void)
{
    static const struct {
        const char *text;
        double centre[2], turn; /* degrees about x */
        bool near;
    } cases[] = {
        {"object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10\n", {0, 0}, 0, false},
        {"object 70\naperture stop\nsurface - 30 air 50\nstop - 10 air 10\n", {0, 0}, 0, true},
        {"object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10 decenter=2,-3\n",
         {2, -3},
         0,
         false},
        {"object 70\naperture stop\nsurface - 30 air -\nstop - 10 air 10 decenter=-1,4\n",
         {-1, 4},
         0,
         true},
        {"object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10 tilt=25,0\n",
         {0, 0},
         25,
         false}};
    static const double fields[][2] = {{0.1, 0}, {0, -0.2}, {0.3, 0.2}, {-0.15, 0.35}};
    for (size_t i = 0; i < 4 * sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct opened opened;
        struct aim aim;
        struct error error;
        double scale = cases[i / 4].near ? 40 : 1, centre[2], slope[4];
        const double *field = fields[i % 4];
        open_text(cases[i / 4].text, &arena, &opened);
        CHECK(open_aim(&opened, scale * field[0], scale * field[1], &arena, &aim, &error));
        struct ray chief = aim_chief(&aim);
        at_plane(&chief, 30, centre);
        CHECK_NEAR(centre[0], cases[i / 4].centre[0], 1e-9, "through the centre of the stop");
        CHECK_NEAR(centre[1], cases[i / 4].centre[1], 1e-9, "through the centre of the stop");
        const double place[][2] = {{aim.chief[0], aim.chief[1]}, {0.7, -1.1}};
        double turn = cases[i / 4].turn * degree;
        for (int k = 0; k < 2; k++) {
            CHECK(chief_slope(&aim, place[k], slope));
            for (int j = 0; j < 2; j++) {
                double h = 1e-4, before[2], after[2], d[2];
                const double low[2] = {place[k][0] - (j == 0) * h, place[k][1] - (j == 1) * h};
                const double high[2] = {place[k][0] + (j == 0) * h, place[k][1] + (j == 1) * h};
                struct ray ray = beam_ray(&aim.beam, low[0], low[1]);
                /* in a plane that is turned about x the point (x, y) lies at (x, y c, y s) */
                for (int side = 0; side < 2; side++) {
                    double *to = side == 0 ? before : after, z = ray.point[2] - 30;
                    double t = (ray.point[1] * sin(turn) - z * cos(turn)) /
                               (ray.cosine[2] * cos(turn) - ray.cosine[1] * sin(turn));
                    to[0] = ray.point[0] + t * ray.cosine[0];
                    to[1] = (ray.point[1] + t * ray.cosine[1]) / cos(turn);
                    ray = beam_ray(&aim.beam, high[0], high[1]);
                }
                for (int c = 0; c < 2; c++) {
                    d[c] = (after[c] - before[c]) / (2 * h);
                    CHECK_NEAR(slope[2 * c + j], d[c], 5e-6, "d(x, y)/d(a, b)");
                    CHECK(k > 0 || fabs(aim.slope[2 * c + j] - d[c]) < 5e-6);
                }
            }
        }
        arena_free(&arena);
    }
}

/* No chief ray: where most of the rays are lost, and how. */
static void test_lost(void)
{
    static const struct {
        const char *text, *words;
        double y;
        enum ray_status lost;
        size_t surface;
    } cases[] = {
        /* from glass into air at 50 degrees: beyond 41.8 all is reflected */
        {"medium 1.5\nobject inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10\n",
         "is totally reflected at surface 1", 50, RAY_TOTAL_REFLECTION, 1},
        {"medium 1.5\nobject inf\naperture stop\nsurface - 5 1.5 50\nsurface - 30 air 50\n"
         "stop - 10 air 10 decenter=1,0\n",
         "is totally reflected at surface 2", 50, RAY_TOTAL_REFLECTION, 2},
        /* a ball whose front the rays meet, too small a front for a stop far off the axis */
        {"object inf\naperture stop\nsurface 1e-3 1 air 0.002\nstop - 10 air 1\n",
         "misses surface 1", 30, RAY_MISS, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct opened opened;
        struct aim aim = {0};
        struct error error = {0};
        open_text(cases[i].text, &arena, &opened);
        CHECK(!open_aim(&opened, 0, cases[i].y * degree, &arena, &aim, &error));
        bool said = strstr(error.message, cases[i].words) != NULL;
        CHECK(said);
        if (!said) {
            printf("%s: %s\n", cases[i].words, error.message);
        }
        CHECK(aim.lost == cases[i].lost);
        CHECK(aim.lost_surface == cases[i].surface);
        arena_free(&arena);
    }
}

int main(void)
{
    test_straight();
    test_lost();
    return check_report();
}
