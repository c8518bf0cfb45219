/* tests/unit/test_lens_clearance.c - things before a lens, in it, and on their way there. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/lens_clearance.h"
#include "file/lens_file.h"
#include "looked.h"

static struct arena arena;
static struct error error;

/* Of both the stop is in the front vertex, and the camera's place there. */
static struct lens_clearance plate; /* 10 mm of glass and 20 of air to the film, 10 mm in radius */
static struct lens_clearance dent;  /* the same, its front hollow */
/* 2 mm of glass, 4 mm in radius at the edge 1 mm behind; then one whose edge is 2 mm before it */
static struct lens_clearance cone;
/* a biconcave between two plates: its faces, 4 mm in radius, are 1 mm deep, at z = 4 and 9 */
static struct lens_clearance hollow;

static struct lens_clearance open_room(const char *text)
{
    struct lens *lens = ARENA_NEW(&arena, struct lens);
    struct setup *setup = ARENA_NEW(&arena, struct setup);
    const struct setup_question question = {
        .lens = lens, .wavelength = NAN, .wavelengths = WAVELENGTHS_ALL, .fnumber = NAN};
    const struct plane_value plane = {.kind = PLANE_AT, .distance = 20};
    CHECK(lens_read("test", text_of(text), NULL, &arena, lens, &error) &&
          setup_open(&question, &arena, setup, &error) && setup_place_image(setup, &plane, &error));
    CHECK_TEXT(error.message, "");
    const struct lens_clearance room = lens_clearance_of(setup, &arena);
    CHECK_NEAR(lens_clearance_pupil(setup), 0, 1e-12, "pupil");
    return room;
}

/* Is it found in a second, and when? */
static bool holds(const struct lens_clearance *room, const struct scene_thing *thing,
                  const struct scene_place *camera, double *time)
{
    static const double span[2] = {0, 1};
    struct scene_thing things[] = {{.shape = SHAPE_SPHERE,
                                    .radius = 1,
                                    .where = {.at = {0, 0, 500}, .turned = LOOKED_UPRIGHT}},
                                   *thing};
    const struct scene scene = {.things = things, .thing_count = 2};
    struct world world;
    size_t which = 0;
    CHECK(world_open(&scene, span, &arena, &world, &error));
    const bool does = lens_clearance_holds(room, &world, camera, span, &which, time);
    CHECK(!does || which == 1);
    return does;
}

static const struct scene_place camera = {.turned = LOOKED_UPRIGHT, .axis = {0, 1, 0}};

/* A sphere of radius 10 mm, whose rearmost point lies so far behind the front. */
static struct scene_thing sphere(double within)
{
    return (struct scene_thing){.shape = SHAPE_SPHERE,
                                .radius = 10,
                                .where = {.at = {0, 0, within - 10}, .turned = LOOKED_UPRIGHT}};
}

static void test_vertex(void)
{
    double time;
    struct scene_thing thing = sphere(-0.1);
    CHECK(!holds(&plate, &thing, &camera, &time));
    thing = sphere(0.1);
    CHECK(holds(&plate, &thing, &camera, &time) && time == 0);
    /* a small one in the hollow, whose rim lies 20 - sqrt(400 - 100) = 2.68 mm before the vertex */
    thing = (struct scene_thing){.shape = SHAPE_SPHERE,
                                 .radius = 0.5,
                                 .where = {.at = {0, 0, -0.6}, .turned = LOOKED_UPRIGHT}};
    CHECK(!holds(&dent, &thing, &camera, &time));
    thing.where.at.z = -0.4;
    CHECK(holds(&dent, &thing, &camera, &time));
    thing.where.at = (struct vector){9, 0, -0.6}; /* there the glass begins at -2.14 mm */
    CHECK(holds(&dent, &thing, &camera, &time));
    /* beside it */
    thing = sphere(20);
    thing.where.at.x = 20.1;
    CHECK(!holds(&plate, &thing, &camera, &time));
    thing.where.at.x = 19.9;
    CHECK(holds(&plate, &thing, &camera, &time));
    /* behind the film */
    thing = sphere(50.1);
    CHECK(!holds(&plate, &thing, &camera, &time));
    thing = sphere(49.9);
    CHECK(holds(&plate, &thing, &camera, &time));
}

/*
 * Between the edges of two glasses, of radius 4 mm at z = 3 and of radius 10 mm at z = 20, the tube
 * is a cone: small spheres lie in it, or beside it.
 */
static void test_cone(void)
{
    for (int z = 4; z < 20; z++) {
        const double edge = 4 + 6 * (z - 3) / 17.0;
        for (int beside = 0; beside < 2; beside++) {
            const struct scene_thing thing = {
                .shape = SHAPE_SPHERE,
                .radius = 0.1,
                .where = {.at = {0, edge + (beside > 0 ? 0.2 : -0.2), z},
                          .turned = LOOKED_UPRIGHT}};
            double time;
            CHECK(holds(&cone, &thing, &camera, &time) == (beside == 0));
        }
    }
}

/* Beside it tubes of 1 mm, from 10 to 4 mm in radius; behind their ends there is air in a face. */
static void test_hollow(void)
{
    static const double places[] = {3.5, 9.5};
    for (size_t i = 0; i < 2; i++) {
        const struct scene_thing thing = {
            .shape = SHAPE_SPHERE,
            .radius = 0.1,
            .where = {.at = {2, 0, places[i]}, .turned = LOOKED_UPRIGHT}};
        double time;
        CHECK(holds(&hollow, &thing, &camera, &time));
    }
}

static const double wide = 10; /* both lenses: their radii */

/* Found in time, and later by what a quarter of the lens takes at most. */
static void check_time(double time, double gap, double speed, const char *what)
{
    const double rounding = 1e-9;
    CHECK(time >= gap / speed - rounding);
    CHECK_NEAR(time, gap / speed, wide / (4 * speed) + rounding, what);
}

static void test_moving(void)
{
    static const double speeds[] = {30, 400, 5000}, gaps[] = {0.01, 3, 25};
    double time;
    for (size_t i = 0; i < 9; i++) {
        const double speed = speeds[i / 3], gap = gaps[i % 3];
        struct scene_thing thing = sphere(-gap);
        thing.where.velocity.z = speed;
        CHECK(holds(&plate, &thing, &camera, &time));
        check_time(time, gap, speed, "a thing that comes");
        thing.where.velocity.z = -speed;
        CHECK(!holds(&plate, &thing, &camera, &time));
        thing.where.velocity.z = 0;
        struct scene_place going = camera;
        going.velocity.z = -speed;
        CHECK(holds(&plate, &thing, &going, &time));
        check_time(time, gap, speed, "a camera that goes");
        /* both together, and the same for the camera */
        thing.where.velocity = going.velocity = (struct vector){speed, 2 * speed, -speed};
        CHECK(!holds(&plate, &thing, &going, &time));
    }
    /* too late */
    struct scene_thing thing = sphere(-25);
    thing.where.velocity.z = 24.9;
    CHECK(!holds(&plate, &thing, &camera, &time));
}

/*
 * A rod of 2 x 95 mm, 2 mm thick, turns about its middle, which is 100 mm beside the axis and 15 mm
 * behind the front, from along the axis to across it: turned by an angle a from across, its side
 * meets the rim of the front, 90 mm beside that middle and 15 mm before it, when
 * 1 = hypot(90, 15) sin(a - atan(15/90)).
 */
static void test_lever(void)
{
    const double spin = 2, meets = PI / 2 - atan(15.0 / 90) - asin(1 / hypot(90, 15));
    struct scene_thing rod = {
        .shape = SHAPE_BOX,
        .size = {2, 2, 190},
        .where = {.at = {100, 0, 15}, .turned = LOOKED_UPRIGHT, .axis = {0, 1, 0}, .spin = spin}};
    double time;
    CHECK(holds(&plate, &rod, &camera, &time));
    CHECK(time >= meets / spin);
    CHECK_NEAR(time, meets / spin, wide / (4 * 95 * spin), "a rod");
    rod.where.spin = -spin;
    CHECK(holds(&plate, &rod, &camera, &time));
    CHECK_NEAR(time, meets / spin, wide / (4 * 95 * spin), "a rod, the other way");
    rod.size.z = 179; /* it ends 0.5 mm beside the lens */
    CHECK(!holds(&plate, &rod, &camera, &time));
    rod.size.z = 190; /* and all lies beside it while nothing turns */
    rod.where.spin = 0;
    CHECK(!holds(&plate, &rod, &camera, &time));
}

int main(void)
{
    plate =
        open_room("lens plate\nwavelength d\nobject inf\naperture stop\nsurface - 10 1.5 20 stop\n"
                  "surface - 20 air 20\n");
    dent =
        open_room("lens dent\nwavelength d\nobject inf\naperture stop\nsurface -20 10 1.5 20 stop\n"
                  "surface - 20 air 20\n");
    cone = open_room("lens cone\nwavelength d\nobject inf\naperture stop\n"
                     "surface - 2 1.5 8 stop\nsurface 8.5 20 air 8\n"
                     "surface -26 5 1.5 20\nsurface - 20 air 20\n");
    hollow = open_room("lens hollow\nwavelength d\nobject inf\naperture stop\n"
                       "surface - 2 1.5 20 stop\nsurface - 2 air 20\nsurface -8.5 5 1.5 8\n"
                       "surface 8.5 2 air 8\nsurface - 5 1.5 20\nsurface - 20 air 20\n");
    test_vertex();
    test_cone();
    test_hollow();
    test_moving();
    test_lever();
    arena_free(&arena);
    return check_report();
}
