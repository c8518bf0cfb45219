/* tests/unit/test_chief.c - the ray through the centre of the stop, where straight lines say it. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/aim/chief.h"
#include "trace/pupil/clear.h"

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

/*
 * A front that is bent so much that three rays of a field go through the centre of the stop, and
 * two of them alike: the one nearer to the paraxial ray is meant. Places and angles by rays from
 * the centre of the stop outwards, in 30 digits.
 */
static void test_several(void)
{
    static const char text[] =
        "object inf\naperture stop\nsurface - 30 1.5 - A4=1e-3 A6=-8e-6\nstop - 10 1.5 10\n";
    static const double cases[][3] = {/* deg; height and place along the axis at the front */
                                      {5, 2.09587598341562071, 0.0186176953957985443},
                                      {4.5, 1.79399384787280677, 0.0100914927031581424}};
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text(text, &arena, &opened);
    for (size_t i = 0; i < 4; i++) {
        const double *one = cases[i / 2], side = i % 2 == 0 ? 1 : -1;
        double point[2];
        CHECK(open_aim(&opened, 0, side * one[0] * degree, &arena, &aim, &error));
        const struct ray chief = aim_chief(&aim);
        at_plane(&chief, one[2], point);
        CHECK_NEAR(point[1], -side * one[1], 1e-9, "the nearest to the paraxial chief ray");
    }
    arena_free(&arena);
}

/* A front whose rim lies 9e9 mm behind its vertex, in which the stop is: the chief ray goes through
   the vertex all the same, where the surface stands across the axis. */
static void test_wall(void)
{
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("object inf\naperture stop\nsurface 20 7 1.7847 20 stop A8=90\nsurface - 20 air -\n",
              &arena, &opened);
    for (int i = -2; i <= 2; i++) {
        double point[2];
        CHECK(open_aim(&opened, 0, 2.5 * i * degree, &arena, &aim, &error));
        const struct ray chief = aim_chief(&aim);
        at_plane(&chief, 0, point);
        CHECK_NEAR(hypot(point[0], point[1]), 0, 1e-9, "through the vertex");
    }
    arena_free(&arena);
}

/* At the edge of a ball of air rays to one side are lost: the slopes of straight lines all the
   same, from rays that are nearer. */
static void test_slope_at_edge(void)
{
    static const double edges[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("object inf\naperture stop\nsurface 10 30 air -\nstop - 10 air 10\n", &arena,
              &opened);
    CHECK(open_aim(&opened, 0, 0, &arena, &aim, &error));
    for (size_t i = 0; i < 4; i++) {
        const double at[2] = {9.998 * edges[i][0], 9.998 * edges[i][1]};
        double slope[4] = {NAN, NAN, NAN, NAN};
        CHECK(chief_slope(&aim, at, slope));
        for (int k = 0; k < 4; k++) {
            CHECK_NEAR(slope[k], k % 3 == 0, 1e-9, "d(x, y)/d(a, b)");
        }
    }
    arena_free(&arena);
}

static void find_aperture(struct opened *opened)
{
    struct error error;
    const struct aperture_setting setting = {APERTURE_STOP, 12};
    CHECK(first_order_aperture(&opened->first, &opened->object, &setting, FIELD_NONE, 0, &error));
}

/*
 * A stop 8 mm behind an ideal lens of f = 40: its image from the front is 10 behind the lens, 5/4
 * as large. A ray through a point of that is a straight line in front of the lens.
 */
static void test_entrance(void)
{
    static const char *const texts[] = {
        "object inf\naperture stop\nthick 40 8 air -\nstop - 30 air 12\n",
        "object 70\naperture stop\nthick 40 8 air -\nstop - 30 air 12\n",
        "object inf\naperture stop\nthick 40 40 air -\nstop - 30 air 12\n",
        "object inf\nthick 40 40 air -\nthick 50 8 air -\n"};
    static const double fields[][2] = {{0, 0}, {0.1, -0.2}, {0.3, 0.2}};
    struct arena arena = {0};
    struct opened opened;
    struct error error = {0};
    struct beam beam;
    struct ray ray;
    for (size_t i = 0; i < 6; i++) {
        open_text(texts[i % 2], &arena, &opened);
        double scale = i % 2 == 0 ? 1 : 40, point[2];
        const struct field_point field = {i % 2 == 0 ? FIELD_ANGLE : FIELD_HEIGHT,
                                          {scale * fields[i / 2][0], scale * fields[i / 2][1]}};
        CHECK(beam_of_field(&field, &opened.object, &opened.first, &beam, &error));
        find_aperture(&opened);
        CHECK(aim_at_entrance(&beam, &opened.first, 0.5, -0.75, &ray, &error));
        at_plane(&ray, 10, point);
        CHECK_NEAR(point[0], 0.5 * 7.5, 1e-13, "in the pupil");
        CHECK_NEAR(point[1], -0.75 * 7.5, 1e-13, "in the pupil");
        /* where to look first: the pupil's centre, and a radius along x as the beam sees it */
        const struct clear_guess guess = clear_guess_of(&opened.system, &beam, &opened.first);
        const struct ray centre = beam_ray(&beam, guess.centre[0], guess.centre[1]);
        double to[2][2];
        at_plane(&centre, 10, point);
        CHECK_NEAR(hypot(point[0], point[1]), 0, 1e-13, "centre of the pupil");
        beam_place(&beam, (double[3]){0, 0, 10}, to[0]);
        beam_place(&beam, (double[3]){7.5, 0, 10}, to[1]);
        CHECK_NEAR(guess.radius, hypot(to[1][0] - to[0][0], to[1][1] - to[0][1]), 1e-13, "radius");
        CHECK(guess.radius < 7.6 && guess.radius > 5);
    }
    /* at 90 degrees, with the pupil at infinity, with none */
    const double across[2] = {0, 90.5 * degree}, ahead[2] = {0, 0.1};
    beam = beam_from_infinity(across, 1);
    CHECK(!aim_at_entrance(&beam, &opened.first, 0, 0, &ray, &error));
    CHECK(strstr(error.message, "90 deg or more") != NULL);
    beam = beam_from_infinity(ahead, 1);
    open_text(texts[2], &arena, &opened);
    opened.first.entrance_diameter = 5;
    CHECK(!aim_at_entrance(&beam, &opened.first, 0, 0, &ray, &error));
    CHECK(strstr(error.message, "infinitely far") != NULL);
    open_text(texts[3], &arena, &opened);
    CHECK(!aim_at_entrance(&beam, &opened.first, 0, 0, &ray, &error));
    CHECK(strstr(error.message, "no entrance pupil") != NULL);
    arena_free(&arena);
}

/* From another ray than the chief ray: points of the stop are reached all the same. */
static void test_open_at(void)
{
    static const double at[2] = {-13, 5}, points[][2] = {{0, 0}, {0.5, -0.75}, {-1, 0}};
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    double middle[2], point[2];
    open_text("object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10\n", &arena,
              &opened);
    CHECK(open_aim(&opened, 0.3, -0.2, &arena, &aim, &error));
    CHECK(aim.centre[0] == 0 && aim.centre[1] == 0);
    CHECK(aim_open_at(&aim, at));
    struct ray ray = beam_ray(&aim.beam, at[0], at[1]);
    at_plane(&ray, 30, middle);
    CHECK_NEAR(aim.centre[0], middle[0], 1e-13, "where it crosses the stop");
    CHECK_NEAR(aim.centre[1], middle[1], 1e-13, "where it crosses the stop");
    CHECK(aim.chief[0] == at[0] && aim.chief[1] == at[1]);
    for (size_t i = 0; i < 3; i++) {
        ray = aim_ray(&aim, points[i][0], points[i][1]);
        CHECK(ray.status == RAY_OK);
        at_plane(&ray, 30, point);
        CHECK_NEAR(point[0], 5 * points[i][0], 1e-9, "aimed");
        CHECK_NEAR(point[1], 5 * points[i][1], 1e-9, "aimed");
    }
    open_text("object inf\naperture stop\nsurface 9 30 air 18\nstop - 10 air 10\n", &arena,
              &opened);
    CHECK(open_aim(&opened, 0, 0.1, &arena, &aim, &error));
    CHECK(!aim_open_at(&aim, (double[2]){0, 20}));
    CHECK(aim_open_at(&aim, (double[2]){0, 2}));
    arena_free(&arena);
}

int main(void)
{
    test_entrance();
    test_open_at();
    test_straight();
    test_lost();
    test_several();
    test_slope_at_edge();
    test_wall();
    return check_report();
}
