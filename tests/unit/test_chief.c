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

/* What is looked at in vain counts by how long it takes: a ray that misses an asphere takes a
   hundred times as long as one that misses a ball, being looked for all along its way. In a lens
   that is not round no more is looked at in grids than takes a tenth of a second. */
static void test_work(void)
{
    static const char *const texts[] = {
        "object inf\naperture stop\nsurface 1e-3 1 air 0.002\nstop - 10 air 1\n",
        "object inf\naperture stop\nsurface 1e-3 1 air 0.002 A4=1e-9\nstop - 10 air 1\n",
        "object inf\naperture stop\nsurface 1e-3 1 air 0.002 A4=1e-9 tilt=1,0\nstop - 10 air 1\n"};
    enum { TEXTS = sizeof texts / sizeof *texts };
    size_t sought[TEXTS];
    for (size_t i = 0; i < TEXTS; i++) {
        struct arena arena = {0};
        struct opened opened;
        struct aim aim = {0};
        struct error error = {0};
        open_text(texts[i], &arena, &opened);
        CHECK(!open_aim(&opened, 0, 30 * degree, &arena, &aim, &error));
        sought[i] = aim.sought;
        arena_free(&arena);
    }
    CHECK(sought[0] > 0 && sought[1] > 20 * sought[0] && sought[1] < 100 * sought[0]);
    CHECK(sought[2] > 100000 && sought[2] < 5000000);
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

/* Where a ray of the beam with these coordinates crosses the stop, in its own frame. */
static void in_stop(const struct aim *aim, const double at[2], double point[2])
{
    chief_trace(aim, (const double(*)[2])at, 1);
    CHECK(ray_block_status(aim->work.blocks, 0) == RAY_OK);
    point[0] = aim->work.blocks->x[0];
    point[1] = aim->work.blocks->y[0];
}

/*
 * From a chief ray near by the one through the centre of the stop, however the beam's own axes are
 * turned about its own: of a round lens, and of others. From the other sheet, or without a way
 * there, none.
 */
static void test_find_near(void)
{
    static const struct {
        const char *text;
        double moved[2]; /* where the chief ray is looked for first, from where it is, mm */
    } cases[] = {
        {"object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10\n", {0, 1}},
        {"object inf\naperture stop\nsurface 100 6 1.6 50\nsurface -150 20 air 50\n"
         "stop - 10 air 10\n",
         {0, -1.5}},
        {"object 300\naperture stop\nsurface 100 6 1.6 50\nsurface -150 20 air 50\n"
         "stop - 10 air 10\n",
         {0, 0.7}},
        {"object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10 decenter=2,-3\n",
         {1.5, -2}},
        {"object inf\naperture stop\nsurface 100 6 1.6 50 tilt=4,-3\nsurface -150 20 air 50\n"
         "stop - 10 air 10 decenter=1,1\n",
         {-1, 1}}};
    for (size_t i = 0; i < 24 * sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct opened opened;
        struct aim aim, other;
        struct error error;
        open_text(cases[i / 24].text, &arena, &opened);
        const double turn = 15.5 * degree * (double)(i % 24), c = cos(turn), s = sin(turn);
        const double scale = opened.object.is_infinite ? 1 : 200;
        CHECK(open_aim(&opened, 0, -0.2 * scale, &arena, &aim, &error));
        /* field and axes of the beam turned about the axis of the lens, of the round ones */
        for (int k = 0; k < 2; k++) {
            double *way = aim.beam.across[k];
            const double x = way[0], y = way[1];
            way[0] = c * x - s * y;
            way[1] = s * x + c * y;
        }
        const double x = aim.beam.axis[0], y = aim.beam.axis[1];
        aim.beam.axis[0] = c * x - s * y;
        aim.beam.axis[1] = s * x + c * y;
        CHECK(aim_open(&opened.system, &aim.beam, &arena, &other, &error));
        const double *chief = other.chief, *moved = cases[i / 24].moved;
        struct aim_near near = {true, {chief[0] + moved[0], chief[1] + moved[1]}, {0}};
        memcpy(near.slope, other.slope, sizeof near.slope);
        double point[2];
        struct aim found = other;
        found.chief[0] = found.chief[1] = NAN;
        memset(found.slope, 0, sizeof found.slope);
        found.slope[3] = other.slope[3];
        CHECK(chief_find_near(&found, &near));
        in_stop(&found, found.chief, point);
        CHECK_NEAR(hypot(point[0], point[1]), 0, 5e-12, "through the centre of the stop");
        for (int k = 0; k < 4; k++) {
            CHECK_NEAR(found.slope[k], other.slope[k], 1e-5, "slopes there");
        }
        /* of another sheet, as slopes with a determinant of the other sign say */
        for (int k = 0; k < 2; k++) {
            struct aim_near turned = near;
            turned.slope[2 * k] *= -1;
            turned.slope[2 * k + 1] *= -1;
            CHECK(!chief_find_near(&found, &turned));
            CHECK(aim_open_near(&opened.system, &aim.beam, &turned, &arena, &found, &error));
            CHECK_NEAR(turned.chief[1], chief[1], 1e-8, "found all the same");
        }
        near.chief[1] += 1e4;
        CHECK(!chief_find_near(&found, &near) || fabs(found.chief[1] - chief[1]) < 1e-8);
        arena_free(&arena);
    }
}

/* The same along axes that are neither across each other nor of length 1: a linear equation. */
static void test_find_near_oblique(void)
{
    static const double axes[][4] = {
        {1, 0, 0, 1},     {0.5, 0.9, 0.9, 2},  {2, 0.9, 0.9, 0.5},    {0.5, -0.9, -0.9, 2},
        {0.3, 1, 1, 0.4}, {-1, 0.2, 0.7, 1.5}, {0.2, 1.5, -0.8, 0.1}, {-1.2, 0.4, 1.1, -2}};
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    open_text("object inf\naperture stop\nsurface - 30 air 50\nstop - 10 air 10 decenter=2,-3\n",
              &arena, &opened);
    CHECK(open_aim(&opened, 0, 0, &arena, &aim, &error));
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; i++) {
        const double *m = axes[i], det = m[0] * m[3] - m[1] * m[2];
        const double chief[2] = {(2 * m[3] + 3 * m[1]) / det, (-3 * m[0] - 2 * m[2]) / det};
        struct aim_near near = {true, {0, 0}, {m[0], m[1], m[2], m[3]}};
        for (int k = 0; k < 2; k++) {
            aim.beam.across[k][0] = m[k];
            aim.beam.across[k][1] = m[2 + k];
        }
        CHECK(chief_find_near(&aim, &near));
        for (int k = 0; k < 2; k++) {
            CHECK_NEAR(aim.chief[k], chief[k], 1e-11 * (1 + fabs(chief[k])), "chief ray");
        }
        for (int k = 0; k < 4; k++) {
            CHECK_NEAR(aim.slope[k], m[k], 1e-9, "slope");
            near.slope[k] *= k < 2 ? -1 : 1;
        }
        CHECK(!chief_find_near(&aim, &near));
    }
    arena_free(&arena);
}

/*
 * A ball of glass far before a stop brings the rays of its rim nearer to the axis than those
 * within: beyond the farthest place of the stop that rays come to before that there is none, and
 * what ends the light on the way out, past the fold, is the rim that it misses. To one side that of
 * another ball, of air in air, about (14, 9), is nearer.
 */
static void test_fold(void)
{
    enum { SAMPLES = 20000, POINTS = 60 };
    int near = 0, far = 0;
    struct arena arena = {0};
    struct opened opened;
    struct aim aim;
    struct error error;
    double most = 0;
    open_text("object inf\naperture stop\nsurface 22 10 air - decenter=14,9\n"
              "surface 10 24 1.5 -\nstop - 10 1.5 60\n",
              &arena, &opened);
    for (int i = 0; i < SAMPLES; i++) {
        const double h = 10 * (i + 0.5) / SAMPLES, normal = asin(h / 10);
        const double bent = normal - asin(h / 15);
        most = fmax(most, h - (24 - (10 - sqrt(100 - h * h))) * tan(bent));
    }
    CHECK(most > 0.3 && most < 1);
    /* rays of a ring meet in the middle too: the one along the axis is meant */
    CHECK(open_aim(&opened, 0, 0, &arena, &aim, &error) && aim_open_at(&aim, (double[2]){0, 0}));
    for (int i = 0; i < POINTS; i++) {
        const double angle = 2.4 * i, r = i % 2 == 0 ? most / 62 * (i + 1) / 30 : 0.2 + 0.013 * i;
        const struct ray ray = aim_ray(&aim, r * cos(angle), r * sin(angle));
        if (30 * r < 0.99 * most) {
            CHECK(ray.status == RAY_OK);
        } else if (i % 2 == 1) {
            /* straight on, by steps that are halved: up to twice as far as the nearest rim */
            const double ahead = 14 * cos(angle) + 9 * sin(angle);
            const double rim = ahead + sqrt(22 * 22 - (14 * 14 + 9 * 9) + ahead * ahead);
            CHECK(ray.status == RAY_MISS);
            CHECK((rim > 10 || ray.surface == 1) && (rim < 20 || ray.surface == 2));
            near += rim < 10;
            far += rim > 20;
        }
    }
    CHECK(near > 5 && far > 10);
    arena_free(&arena);
}

int main(void)
{
    test_entrance();
    test_open_at();
    test_straight();
    test_lost();
    test_work();
    test_several();
    test_slope_at_edge();
    test_wall();
    test_find_near();
    test_find_near_oblique();
    test_fold();
    return check_report();
}
