/* analysis/pupil/encircled_energy.c - within which distance so much of the light of a sample lies. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/encircled_energy.h"

#include "base/constants.h"
#include "base/roots.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <stdlib.h>

struct encircled_energy_arms encircled_energy_arms_open(const struct bundle *bundle,
                                                        const struct encircled_energy_sheet *sheets,
                                                        struct arena *arena)
{
    struct encircled_energy_arms all = {.arms = bundle->arms,
                                        .rings = bundle->rings,
                                        .arcs = bundle->arcs,
                                        .sheets = sheets,
                                        .arena = arena};
    if (all.arms > 0) {
        all.places = ARENA_ARRAY(arena, all.rings, double);
        all.shares = ARENA_ARRAY(arena, all.rings, double);
        all.last = ARENA_ARRAY(arena, all.arms, size_t);
        gauss_rule(all.rings, all.places, all.shares);
    }
    return all;
}

void encircled_energy_arms_add(struct encircled_energy_arms *arms, size_t ray,
                               struct encircled_energy_mark *marks, size_t mark)
{
    if (mark != ENCIRCLED_ENERGY_ALONE) {
        marks[mark].beside[0] = marks[mark].beside[1] = ENCIRCLED_ENERGY_ALONE;
    }
    if (arms->arms == 0) {
        return;
    }
    const size_t ring = ray / arms->arms % arms->rings, arm = ray % arms->arms;
    size_t *last = &arms->last[arm];
    if (mark != ENCIRCLED_ENERGY_ALONE) {
        marks[mark].place = arms->places[ring];
        marks[mark].share = arms->shares[ring];
        if (ring > 0 && *last != ENCIRCLED_ENERGY_ALONE) {
            marks[mark].beside[0] = *last;
            marks[*last].beside[1] = mark;
        }
        arms->arrived++;
    }
    *last = mark;
    if (ring == arms->rings - 1 && arm == arms->arms - 1) {
        /* The last ray of a sheet has come. */
        const size_t count = arms->arms * arms->rings;
        if (arms->arrived == count) {
            struct encircled_energy_sheet *sheet =
                ARENA_NEW(arms->arena, struct encircled_energy_sheet);
            *sheet = (struct encircled_energy_sheet){arms->sheets, mark + 1 - count, arms->arms,
                                                     arms->rings,  arms->arcs,       arms->places,
                                                     arms->shares};
            arms->sheets = sheet;
        }
        arms->arrived = 0;
    }
}

/* -------- of rays by themselves -------- */

struct energy_point {
    double distance, weight;
};

static int by_distance(const void *first, const void *second)
{
    double a = ((const struct energy_point *)first)->distance,
           b = ((const struct energy_point *)second)->distance;
    return (a > b) - (a < b);
}

/* The distance within which so much of the weight lies; half of each mark's lies before it. */
static double of_points(const struct encircled_energy_mark *marks, size_t count, double share,
                        struct arena *arena)
{
    struct energy_point *points = ARENA_ARRAY(arena, count, struct energy_point);
    double total = 0, before = 0;
    for (size_t i = 0; i < count; i++) {
        points[i] = (struct energy_point){hypot(marks[i].at[0], marks[i].at[1]), marks[i].weight};
        total += points[i].weight;
    }
    qsort(points, count, sizeof *points, by_distance);
    const struct energy_point *last = NULL;
    for (size_t i = 0; i < count; i++) {
        const struct energy_point *point = &points[i];
        double middle = before + point->weight / 2;
        if (middle >= share * total) {
            double from = last != NULL ? before - last->weight / 2 : 0;
            double low = last != NULL ? last->distance : 0;
            return low + (point->distance - low) * (share * total - from) / (middle - from);
        }
        before += point->weight;
        last = point;
    }
    return last->distance;
}

/* -------- pieces of light -------- */

/* Light between two distances; along it the radius in the pupil goes as evenly as the distance. */
struct piece {
    double low, high, weight;
    double radius[2]; /* where the distance is low, and high */
};

/* A place on an arm. */
struct look {
    double radius, distance;
    double density; /* of light, by the area in the pupil */
};

static struct piece piece_between(const struct look *a, const struct look *b)
{
    const struct look *low = a->distance < b->distance ? a : b, *high = low == a ? b : a;
    const double area = fabs((b->radius - a->radius) * (b->radius + a->radius));
    return (struct piece){low->distance,
                          high->distance,
                          (a->density + b->density) / 2 * area,
                          {low->radius, high->radius}};
}

static struct look encircled_energy_look_at(const struct encircled_energy_mark *mark)
{
    return (struct look){sqrt(mark->place), hypot(mark->at[0], mark->at[1]),
                         mark->weight / mark->share};
}

/* Beyond the last ray on a side: as far as the arm goes; beside a lost ray, as its own share. */
static struct look look_beyond(const struct encircled_energy_mark *marks, size_t i, int side)
{
    const struct encircled_energy_mark *mark = &marks[i];
    const size_t other = mark->beside[1 - side];
    const struct look here = encircled_energy_look_at(mark);
    const double left = fmin(side == 1 ? 1 - mark->place : mark->place, mark->share);
    struct look end = here;
    end.radius = sqrt(fmax(mark->place + (side == 1 ? left : -left), 0));
    if (other != ENCIRCLED_ENERGY_ALONE) {
        const struct look last = encircled_energy_look_at(&marks[other]);
        const double slope = (here.distance - last.distance) / (here.radius - last.radius);
        end.distance = fabs(here.distance + slope * (end.radius - here.radius));
    }
    return end;
}

/* Those of an arm, or of what is left of it; their number: that of its rays and one. */
static size_t pieces_of_arm(const struct encircled_energy_mark *marks, size_t first,
                            struct piece *pieces)
{
    size_t count = 0, here = first;
    struct look last = look_beyond(marks, first, 0);
    for (size_t next = first; next != ENCIRCLED_ENERGY_ALONE; next = marks[here].beside[1]) {
        const struct look look = encircled_energy_look_at(&marks[next]);
        pieces[count++] = piece_between(&last, &look);
        last = look;
        here = next;
    }
    const struct look end = look_beyond(marks, here, 1);
    pieces[count++] = piece_between(&last, &end);
    return count;
}

/* -------- of sheets -------- */

/* Rays that a polynomial goes through; looks between rays, where there are few rays. */
enum { STENCIL = 6, LOOKS_OUTWARDS = 8, LOOKS_AROUND = 4, MOST_OUTWARDS = 512, MOST_AROUND = 1024 };

/* How something at a place follows from the nodes about it: node (first + j) % nodes. */
struct stencil {
    size_t first, count;
    double factor[STENCIL];
};

/* Lagrange's factors: of the nodes nearest by, or those at the end. */
static struct stencil encircled_stencil_at(const double *nodes, size_t count, double at)
{
    struct stencil stencil = {0, count < STENCIL ? count : STENCIL, {0}};
    while (stencil.first + stencil.count < count &&
           nodes[stencil.first + stencil.count] - at < at - nodes[stencil.first]) {
        stencil.first++;
    }
    nodes += stencil.first;
    for (size_t j = 0; j < stencil.count; j++) {
        stencil.factor[j] = 1;
        for (size_t k = 0; k < stencil.count; k++) {
            stencil.factor[j] *= k == j ? 1 : (at - nodes[k]) / (nodes[j] - nodes[k]);
        }
    }
    return stencil;
}

/* The same of equal steps around a circle, between step `gap` and the next. */
static struct stencil stencil_around(size_t steps, size_t gap, double beyond)
{
    double nodes[STENCIL];
    const size_t count = steps < STENCIL ? steps : STENCIL, back = (count - 1) / 2;
    for (size_t j = 0; j < count; j++) {
        nodes[j] = (double)j;
    }
    struct stencil stencil = encircled_stencil_at(nodes, count, (double)back + beyond);
    stencil.first = gap + steps - back;
    return stencil;
}

/*
 * What there is at looks along an arm. Distances are the same in any axes: of a whole circle each
 * arm has its own, which turn with it, so that nothing changes around a disc.
 */
struct encircled_value {
    double at[2], density;
};

/* A sheet at work. */
struct energy_sheet {
    const struct encircled_energy_sheet *made;
    const double *radii; /* of looks outwards, from 0 to 1 */
    size_t looks;
    struct encircled_value *arms; /* `looks` of each */
    struct piece *pieces;
    size_t count;
};

static void look_along_arms(const struct encircled_energy_mark *marks, const double *arm_shares,
                            struct arena *arena, struct energy_sheet *sheet)
{
    const struct encircled_energy_sheet *made = sheet->made;
    double *rings = ARENA_ARRAY(arena, made->rings, double);
    sheet->arms = ARENA_ARRAY(arena, sheet->looks * made->arms, struct encircled_value);
    for (size_t ring = 0; ring < made->rings; ring++) {
        rings[ring] = sqrt(made->places[ring]);
    }
    for (size_t i = 0; i < sheet->looks; i++) {
        const struct stencil stencil = encircled_stencil_at(rings, made->rings, sheet->radii[i]);
        for (size_t arm = 0; arm < made->arms; arm++) {
            struct encircled_value *value = &sheet->arms[arm * sheet->looks + i], sum = {{0, 0}, 0};
            for (size_t j = 0; j < stencil.count; j++) {
                const size_t ring = stencil.first + j;
                const struct encircled_energy_mark *mark =
                    &marks[made->first + ring * made->arms + arm];
                sum.at[0] += stencil.factor[j] * mark->at[0];
                sum.at[1] += stencil.factor[j] * mark->at[1];
                sum.density += stencil.factor[j] * mark->weight / made->shares[ring];
            }
            const double angle =
                made->arcs.count > 0 ? 0 : 2 * PI * (double)arm / (double)made->arms;
            value->at[0] = sum.at[0] * cos(angle) - sum.at[1] * sin(angle);
            value->at[1] = sum.at[0] * sin(angle) + sum.at[1] * cos(angle);
            value->density = sum.density / arm_shares[arm];
        }
    }
}

/* Pieces of an arm between those of rays: among `count` arms in a circle, from `first` on. */
static void pieces_between(struct energy_sheet *sheet, size_t first, size_t count,
                           const struct stencil *stencil, double share)
{
    struct look last = {0};
    for (size_t i = 0; i < sheet->looks; i++) {
        double x = 0, y = 0, density = 0;
        for (size_t j = 0; j < stencil->count; j++) {
            const size_t arm = first + (stencil->first + j) % count;
            const struct encircled_value *value = &sheet->arms[arm * sheet->looks + i];
            x += stencil->factor[j] * value->at[0];
            y += stencil->factor[j] * value->at[1];
            density += stencil->factor[j] * value->density;
        }
        const struct look here = {sheet->radii[i], sqrt(x * x + y * y), density * share};
        if (i > 0) {
            sheet->pieces[sheet->count++] = piece_between(&last, &here);
        }
        last = here;
    }
}

/* Arms in each arc, or in all the circle. */
static size_t arms_of_arc(const struct encircled_energy_sheet *made, size_t arc)
{
    return made->arcs.count > 0 ? made->arcs.arms[arc] : made->arms;
}

/* How often it is looked between so many rays: usually so often, at most so often in all. */
static size_t looks_between(size_t rays, size_t usual, size_t most)
{
    const size_t looks = most / rays < usual ? most / rays : usual;
    return looks > 1 ? looks : 1;
}

/* The pieces of a sheet; their number. */
static size_t pieces_of_sheet(const struct encircled_energy_mark *marks,
                              const struct encircled_energy_sheet *made, struct arena *arena,
                              struct piece *pieces)
{
    const size_t around = looks_between(made->arms, LOOKS_AROUND, MOST_AROUND),
                 arcs = made->arcs.count > 0 ? made->arcs.count : 1;
    double *angles = ARENA_ARRAY(arena, made->arms, double),
           *shares = ARENA_ARRAY(arena, made->arms, double);
    struct energy_sheet sheet = {.made = made, .pieces = pieces};
    /* Where to look outwards: equal steps between rings. */
    const size_t steps = looks_between(made->rings, LOOKS_OUTWARDS, MOST_OUTWARDS);
    double *radii = ARENA_ARRAY(arena, (made->rings + 1) * steps + 1, double), from = 0;
    sheet.looks = 0;
    for (size_t gap = 0; gap <= made->rings; gap++) {
        const double to = gap < made->rings ? sqrt(made->places[gap]) : 1;
        for (size_t i = 0; i < steps; i++) {
            radii[sheet.looks++] = from + (to - from) * (double)i / (double)steps;
        }
        from = to;
    }
    radii[sheet.looks++] = 1;
    sheet.radii = radii;
    for (size_t arc = 0, first = 0; arc < arcs; first += arms_of_arc(made, arc), arc++) {
        const size_t count = arms_of_arc(made, arc);
        gauss_rule(count, angles + first, shares + first);
        for (size_t k = first; k < first + count && made->arcs.count == 0; k++) {
            shares[k] = 1 / (double)count;
        }
    }
    look_along_arms(marks, shares, arena, &sheet);
    for (size_t arc = 0, first = 0; arc < arcs; first += arms_of_arc(made, arc), arc++) {
        const size_t count = arms_of_arc(made, arc), cells = count * around;
        for (size_t i = 0; i < cells; i++) {
            const double within = ((double)(i % around) + 0.5) / (double)around;
            const struct stencil stencil =
                made->arcs.count == 0 ? stencil_around(count, i / around, within)
                                      : encircled_stencil_at(angles + first, count,
                                                             ((double)i + 0.5) / (double)cells);
            pieces_between(&sheet, first, count, &stencil, 1 / (double)cells);
        }
    }
    return sheet.count;
}

/* -------- of all -------- */

/* All pieces; their number. */
static size_t pieces_of_all(const struct encircled_energy_sample *sample, struct arena *arena,
                            struct piece **all)
{
    size_t room = 2 * sample->count, made = 0;
    for (const struct encircled_energy_sheet *each = sample->sheets; each != NULL;
         each = each->next) {
        room += (each->rings + 1) * looks_between(each->rings, LOOKS_OUTWARDS, MOST_OUTWARDS) *
                each->arms * looks_between(each->arms, LOOKS_AROUND, MOST_AROUND);
    }
    struct piece *pieces = ARENA_ARRAY(arena, room, struct piece);
    bool *is_done = ARENA_ARRAY(arena, sample->count, bool);
    for (size_t i = 0; i < sample->count; i++) {
        is_done[i] = sample->marks[i].beside[0] != ENCIRCLED_ENERGY_ALONE;
    }
    for (const struct encircled_energy_sheet *each = sample->sheets; each != NULL;
         each = each->next) {
        const struct arena_mark mark = arena_mark(arena);
        made += pieces_of_sheet(sample->marks, each, arena, pieces + made);
        arena_reset(arena, mark);
        for (size_t arm = 0; arm < each->arms; arm++) {
            is_done[each->first + arm] = true;
        }
    }
    for (size_t i = 0; i < sample->count; i++) {
        made += is_done[i] ? 0 : pieces_of_arm(sample->marks, i, pieces + made);
    }
    *all = pieces;
    return made;
}

/* How much of a piece lies within a distance: light goes by the area in the pupil. */
static double part_within(const struct piece *piece, double distance)
{
    if (!(distance < piece->high)) {
        return 1;
    }
    if (!(distance > piece->low)) {
        return 0;
    }
    const double from = piece->radius[0], to = piece->radius[1];
    const double gone = (to - from) * (distance - piece->low) / (piece->high - piece->low);
    return gone * (2 * from + gone) / ((to - from) * (to + from));
}

/* Pieces that the distance sought may cut, and what light the others leave to them. */
struct encircled_energy_search {
    struct piece *pieces;
    size_t count;
    double wanted;
};

static double excess_within(double distance, const void *context)
{
    const struct encircled_energy_search *search = context;
    double sum = 0;
    for (size_t i = 0; i < search->count; i++) {
        sum += search->pieces[i].weight * part_within(&search->pieces[i], distance);
    }
    return sum - search->wanted;
}

/* The same where rays lie on arms. */
static double of_arms(const struct encircled_energy_sample *sample, double share,
                      struct arena *arena)
{
    enum { HALVINGS = 6 }; /* after which few pieces are left */
    struct encircled_energy_search search;
    struct error error;
    double total = 0, low = 0, high = 0, found;
    search.count = pieces_of_all(sample, arena, &search.pieces);
    for (size_t i = 0; i < search.count; i++) {
        total += search.pieces[i].weight;
        high = fmax(high, search.pieces[i].high);
    }
    search.wanted = share * total;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        const bool is_beyond = excess_within(middle, &search) < 0;
        low = is_beyond ? middle : low;
        high = is_beyond ? high : middle;
        /* Give up the pieces that no distance of a bracket cuts. */
        size_t kept = 0;
        for (size_t j = 0; j < search.count; j++) {
            const struct piece *piece = &search.pieces[j];
            if (!(piece->high > low)) {
                search.wanted -= piece->weight;
            } else if (piece->low < high) {
                search.pieces[kept++] = *piece;
            }
        }
        search.count = kept;
    }
    /* a share that ends where light does may have no sign to change */
    return root_find(excess_within, &search, low, high, &found, &error) ? found : (low + high) / 2;
}

double encircled_energy_find(const struct encircled_energy_sample *sample, double share,
                             struct arena *arena)
{
    return sample->has_arms ? of_arms(sample, share, arena)
                            : of_points(sample->marks, sample->count, share, arena);
}
