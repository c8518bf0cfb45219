/* commands/data/glass_search.c - the glasses that fulfil wishes, and the Abbe diagram of them. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/glass_search.h"

#include "draw/abbe.h"
#include "draw/svg.h"
#include "report/output.h"

#include <math.h>

/* So many nearest glasses are shown where nothing else is said. */
enum { NEAREST = 10 };

enum { MOST_POINTS = 20000, MOST_GROUPS = 64 };

static bool is_inside(struct interval_value interval, double value)
{
    bool wanted = !isnan(interval.low) || !isnan(interval.high);
    return !wanted || (!isnan(value) && !(value < interval.low) && !(value > interval.high));
}

/* Are glasses near to a value wanted, nearest first? */
static bool wishes_near(const struct glass_input *wishes)
{
    return !isnan(wishes->nd.near) || !isnan(wishes->Vd.near);
}

/*
 * How far nd and Vd are from those that are wanted.
 *
 * Result    in the makers' standard tolerances: 1 is 0.0005 off in nd, or 0.8 % off in Vd; NaN
 *           where the glass has no nd or Vd, or nothing is wanted
 * Formula   sqrt(((nd - nd0)/0.0005)^2 + ((Vd - Vd0)/(0.008 Vd0))^2), one term where one is wanted
 * Source    the tolerances that makers deliver within unless a finer grade is ordered
 */
static double glass_distance(const struct glass_input *wishes, const struct glass_summary *summary)
{
    const double nd_tolerance = 0.0005, Vd_tolerance = 0.008;
    double nd = (summary->nd - wishes->nd.near) / nd_tolerance;
    double Vd = (summary->Vd - wishes->Vd.near) / (Vd_tolerance * wishes->Vd.near);
    if (isnan(wishes->Vd.near)) {
        return fabs(nd);
    }
    return isnan(wishes->nd.near) ? fabs(Vd) : hypot(nd, Vd);
}

/* What needs no computing. */
static bool glass_search_is_wanted(const struct glass_record *record,
                                   const struct glass_input *wishes)
{
    return (wishes->catalog == NULL ||
            text_same_name(record->glass.catalog, text_of(wishes->catalog))) &&
           (wishes->status == NULL || text_same(record->status, wishes->status));
}

static bool is_same_record(const struct glass_record *a, const struct glass_record *b)
{
    return text_same_name(a->glass.catalog, b->glass.catalog) && a->place == b->place &&
           a->glass.name.length == b->glass.name.length &&
           text_same_name(a->glass.name, b->glass.name);
}

/* The most similar ones so far, nearest first. */
struct glass_ranking {
    struct glass_match *best;
    size_t count, most;
};

static void rank_glass(struct glass_ranking *ranking, const struct glass_match *match)
{
    size_t at = ranking->count;
    if (isnan(match->away) || ranking->most == 0) {
        return;
    }
    if (at == ranking->most) {
        if (!(match->away < ranking->best[at - 1].away)) {
            return;
        }
        at--;
    } else {
        ranking->count++;
    }
    for (; at > 0 && match->away < ranking->best[at - 1].away; at--) {
        ranking->best[at] = ranking->best[at - 1];
    }
    ranking->best[at] = *match;
}

/* Hand out each match, or rank it if the most similar are wanted. */
static bool search_all(const struct glass_input *wishes, struct glass_catalogs *catalogs,
                       struct glass_ranking *ranking, glass_found *found, void *context,
                       size_t *count, struct error *error)
{
    struct glass_match match;
    struct glass_lines like = {0}, lines;
    if (wishes->like.record != NULL) {
        like = glass_lines(&wishes->like.record->glass);
    }
    while (glass_catalogs_next(catalogs, &match.record, error)) {
        if (!glass_search_is_wanted(&match.record, wishes)) {
            continue;
        }
        lines = glass_lines(&match.record.glass);
        match.summary = glass_summary_of(&match.record.glass, &lines);
        match.away = NAN;
        if (!is_inside(wishes->nd, match.summary.nd) || !is_inside(wishes->Vd, match.summary.Vd) ||
            !is_inside(wishes->PgF, match.summary.PgF)) {
            continue;
        }
        if (wishes_near(wishes)) {
            match.away = glass_distance(wishes, &match.summary);
            rank_glass(ranking, &match);
        } else if (wishes->like.record == NULL) {
            ++*count;
            if (!found(&match, context)) {
                return true;
            }
        } else if (!is_same_record(&match.record, wishes->like.record)) {
            match.away = glass_difference(&lines, &like);
            rank_glass(ranking, &match);
        }
    }
    return error->code == ERROR_NONE;
}

bool glass_search(const struct glass_input *wishes, struct lensdb *db, struct arena *arena,
                  glass_found *found, void *context, struct error *error)
{
    struct glass_catalogs catalogs;
    size_t most = wishes->count > 0 ? (size_t)wishes->count : NEAREST, count = 0;
    struct glass_ranking ranking = {.most = most};
    if (wishes->like.record != NULL || wishes_near(wishes)) {
        ranking.best = ARENA_ARRAY(arena, most + 1, struct glass_match);
    }
    if (!glass_catalogs_open(&catalogs, db, arena, !isnan(wishes->thickness), error) ||
        !search_all(wishes, &catalogs, &ranking, found, context, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < ranking.count && found(&ranking.best[i], context); i++) {
    }
    return count + ranking.count > 0 || fail(error, ERROR_DOMAIN, "no glass matches");
}

/* The diagram while glasses are collected for it. */
struct sheet_of_points {
    struct arena *arena;
    struct lensdb *db;
    struct glass_record *labelled;
    bool *is_drawn; /* of those */
    size_t labelled_count;
    struct abbe_point *points;
    size_t count;
    const char *groups[MOST_GROUPS];
    size_t group_count;
};

static bool is_labelled(const struct sheet_of_points *sheet, const struct glass_record *record)
{
    bool found = false;
    for (size_t i = 0; i < sheet->labelled_count && !found; i++) {
        found = is_same_record(record, &sheet->labelled[i]);
        sheet->is_drawn[i] = sheet->is_drawn[i] || found;
    }
    return found;
}

/* The group of a catalogue; glasses come catalogue by catalogue unless they are ranked. */
static size_t group_of(struct sheet_of_points *sheet, struct text catalog)
{
    for (size_t i = 0; i < sheet->group_count; i++) {
        if (text_equal(catalog, sheet->groups[i])) {
            return i;
        }
    }
    if (sheet->group_count == MOST_GROUPS) {
        return MOST_GROUPS - 1;
    }
    sheet->groups[sheet->group_count] = arena_string(sheet->arena, catalog.start, catalog.length);
    return sheet->group_count++;
}

static bool glass_search_add_point(const struct glass_match *match, void *context)
{
    struct sheet_of_points *sheet = context;
    struct text name = match->record.glass.name;
    if (isnan(match->summary.nd) || isnan(match->summary.Vd)) {
        return true;
    }
    sheet->points[sheet->count++] = (struct abbe_point){
        .Vd = match->summary.Vd,
        .nd = match->summary.nd,
        .group = group_of(sheet, match->record.glass.catalog),
        .label = arena_string(sheet->arena, name.start, name.length),
        .chosen = is_labelled(sheet, &match->record),
    };
    return sheet->count < MOST_POINTS;
}

/* The nd and Vd that others are near to, as a point of its own. */
static void add_wanted(struct sheet_of_points *sheet, const struct glass_input *wishes)
{
    if (isnan(wishes->nd.near) || isnan(wishes->Vd.near) || sheet->count == MOST_POINTS) {
        return;
    }
    sheet->points[sheet->count++] = (struct abbe_point){
        .Vd = wishes->Vd.near,
        .nd = wishes->nd.near,
        .group = group_of(sheet, text_of("wanted")),
        .label = "wanted",
        .chosen = true,
    };
}

static bool find_labelled(struct sheet_of_points *sheet, const char *names, struct error *error)
{
    struct text rest = text_of(names != NULL ? names : "");
    size_t most = 1;
    for (size_t i = 0; i < rest.length; i++) {
        most += rest.start[i] == ',';
    }
    sheet->labelled = ARENA_ARRAY(sheet->arena, most, struct glass_record);
    sheet->is_drawn = ARENA_ARRAY(sheet->arena, most, bool);
    while (names != NULL && rest.start != NULL) {
        struct text name = text_cut(&rest, ',');
        if (!glass_find(sheet->db, name, GLASS_ALIASES, sheet->arena,
                        &sheet->labelled[sheet->labelled_count++], error)) {
            return error_prefix(error, "{--label}: ");
        }
    }
    return true;
}

/* The families by which designers speak of glasses, as SCHOTT's names begin. */
static const char *const family_names[] = {"FK", "PK", "PSK",  "BK",  "K",    "ZK",  "BaK",
                                           "SK", "KF", "BaLF", "SSK", "LaK",  "LLF", "BaF",
                                           "LF", "F",  "BaSF", "LaF", "LaSF", "SF",  "KzFS"};

enum { FAMILIES = sizeof family_names / sizeof family_names[0], FAMILY_MOST = 100 };

/* The family of a name: "LaK" of N-LAK33B and LAKN12; FAMILIES: of none. */
static size_t family_of(struct text name)
{
    if (name.length > 2 && name.start[1] == '-') {
        name = (struct text){name.start + 2, name.length - 2};
    }
    size_t letters = 0;
    while (letters < name.length && name.start[letters] > '9') {
        letters++;
    }
    for (size_t cut = 0; cut < 2 && cut < letters; cut++) { /* N, L: kinds of the same family */
        for (size_t i = 0; i < FAMILIES; i++) {
            if (text_same((struct text){name.start, letters - cut}, family_names[i])) {
                return i;
            }
        }
        if (name.start[letters - 1] != 'N' && name.start[letters - 1] != 'L') {
            break;
        }
    }
    return FAMILIES;
}

static bool glass_family_add(const struct glass_match *match, void *context)
{
    struct abbe_family *families = context;
    const size_t i = family_of(match->record.glass.name);
    const struct glass_summary *summary = &match->summary;
    if (i < FAMILIES && families[i].count < FAMILY_MOST && isfinite(summary->nd) &&
        isfinite(summary->Vd)) {
        families[i].nd[families[i].count] = summary->nd;
        families[i].Vd[families[i].count++] = summary->Vd;
    }
    return true;
}

/* What the families of SCHOTT's glasses span, old and new. */
static struct abbe_family *glass_families(struct lensdb *db, struct arena *arena)
{
    struct abbe_family *families = ARENA_ARRAY(arena, FAMILIES, struct abbe_family);
    const struct interval_value any = {NAN, NAN, NAN};
    const struct glass_input wishes = {
        .thickness = NAN, .nd = any, .Vd = any, .PgF = any, .catalog = "SCHOTT"};
    struct error ignored = {0};
    for (size_t i = 0; i < FAMILIES; i++) {
        families[i] = (struct abbe_family){family_names[i], ARENA_ARRAY(arena, FAMILY_MOST, double),
                                           ARENA_ARRAY(arena, FAMILY_MOST, double), 0};
    }
    glass_search(&wishes, db, arena, glass_family_add, families, &ignored);
    return families;
}

/* "121 glasses of SCHOTT, current": what a diagram shows. */
static const char *glass_diagram_words(const struct sheet_of_points *sheet,
                                       const struct glass_input *wishes)
{
    return arena_printf(
        sheet->arena, "%zu %s%s%s%s%s; areas: families of SCHOTT's glasses", sheet->count,
        sheet->count == 1 ? "glass" : "glasses", sheet->group_count == 1 ? " of " : "",
        sheet->group_count == 1 ? sheet->groups[0] : "", wishes->status != NULL ? ", " : "",
        wishes->status != NULL ? wishes->status : "");
}

bool glass_diagram(const struct glass_input *wishes, struct lensdb *db, struct svg *svg,
                   struct error *error)
{
    struct arena *arena = svg->arena;
    struct sheet_of_points *sheet = ARENA_NEW(arena, struct sheet_of_points);
    sheet->arena = arena;
    sheet->db = db;
    sheet->points = ARENA_ARRAY(arena, MOST_POINTS, struct abbe_point);
    if (!find_labelled(sheet, wishes->label, error) ||
        !glass_search(wishes, db, arena, glass_search_add_point, sheet, error)) {
        return false;
    }
    if (wishes->like.record != NULL) {
        struct glass_match like = {.record = *wishes->like.record,
                                   .summary = glass_summary(&wishes->like.record->glass)};
        glass_search_add_point(&like, sheet);
        sheet->points[sheet->count - (sheet->count > 0)].chosen = true;
    }
    /* A glass that is not found has no place to be emphasised. */
    for (size_t i = 0; i < sheet->labelled_count; i++) {
        if (!sheet->is_drawn[i]) {
            const struct text name = sheet->labelled[i].glass.name;
            return fail(error, ERROR_USAGE, "{--label} %.*s: it is none of the glasses drawn",
                        text_shown(name), name.start);
        }
    }
    add_wanted(sheet, wishes);
    const struct abbe abbe = {.title = "Abbe diagram",
                              .subtitle = glass_diagram_words(sheet, wishes),
                              .families = glass_families(db, arena),
                              .family_count = FAMILIES,
                              .points = sheet->points,
                              .count = sheet->count,
                              .groups = sheet->groups,
                              .group_count = sheet->group_count};
    return abbe_draw(&abbe, svg, error);
}
