/* `lom verify`. In: a manifest of golden pictures. Out: what became of each, by hashes; new hashes in the manifest with
 * --approve. Invariant: no expected picture is needed; what is said does not depend on how many draw, and stands in the
 * order of the manifest; the manifest changes in the fields of approved hashes alone, and not after an error. */
#include "verify.h"

#include "commands.h"

#include "base/threads.h"

#include <stdatomic.h>
#include <string.h>

static const lom_option options[] = {
    { "approve", 0, LOM_OPTION_FLAG, offsetof(struct lom_verify_values, approve), NULL, 0, 0,
      "write the hashes of what was drawn into the manifest, and nothing else" },
    { "line", 0, LOM_OPTION_INTEGER, offsetof(struct lom_verify_values, line), "N", 1, 1e9,
      "only the picture of this line of the manifest" },
    { "twice", 0, LOM_OPTION_FLAG, offsetof(struct lom_verify_values, twice), NULL, 0, 0,
      "draw each again by other threads and lanes, which must give the same" },
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct lom_verify_values, output), "DIR", 0, 0,
      "write the pictures that fail, as DIR/LINE-SCENE.png (floats: .pfm)" },
    { "cache", 0, LOM_OPTION_TEXT, offsetof(struct lom_verify_values, cache), "DIR", 0, 0,
      "keep right pictures as DIR/HASH.png, to stand beside those that fail in --output" },
    { "junit", 0, LOM_OPTION_TEXT, offsetof(struct lom_verify_values, junit), "FILE", 0, 0,
      "write JUnit's XML, with the pictures of --output attached" },
    { "page", 0, LOM_OPTION_TEXT, offsetof(struct lom_verify_values, page), "FILE", 0, 0,
      "write one HTML page: those that fail, what was expected, the difference, approval" },
    { "threads", 0, LOM_OPTION_INTEGER, offsetof(struct lom_verify_values, threads), "N", 1, 256,
      "workers; as many as the machine allows when not given; changes no byte" },
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct lom_verify_values, quiet), NULL, 0, 0,
      "say nothing of those that are ok" },
};

static const lom_command_line line = {
    .name = "verify",
    .arguments = "MANIFEST",
    .summary = "draw the golden pictures of a project and compare them with their hashes",
    .details =
        "A line of MANIFEST: HASH SCENE, then --size, --frame, --crop, --set as of lom render, and flat where one\n"
        "single colour is right; - is the hash of a picture that nobody has approved; # begins a comment. The first\n"
        "line may be \"lom VERSION picture N by PROGRAM\": PROGRAM draws again what was expected. Scenes are named\n"
        "from the manifest's folder. See docs/golden-tests.md. Exit status 0 when all are right, 1 when one is not,\n"
        "2 when one could not be drawn.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* Pictures that follow one another in the manifest, of one scene: what a worker takes at a time. */
struct piece {
    struct lom_manifest_place place; /* before the first of them; the words are the worker's */
    int first, count;                /* outcomes */
};
enum { MOST_IN_A_PIECE = 8 };

struct run {
    const struct lom_verify_values *values;
    struct lom_manifest manifest;
    int picture_count, piece_count;
    struct piece *pieces;
    struct lom_outcome *outcomes; /* a picture each */
    atomic_bool *drawn;           /* the outcome stands */
    struct lom_verifier *verifiers;
    char **words; /* of each verifier's reader */
    atomic_int next;
    /* What has been told, in the order of the manifest, by the one that told it. */
    struct lom_manifest_place place;
    int told;
    char *warnings;          /* the last ones that were told */
    struct lom_report cases; /* of --junit, without what stands around them */
    struct lom_approval approved;
    struct lom_verify_page page;
    int totals[LOM_VERIFIED_COUNT];
};

/* ---- which pictures there are ---- */

static bool is_wanted(const struct run *run, const struct lom_golden *golden)
{
    return !run->values->line.given || run->values->line.value[0] == golden->number;
}

/* Cuts the manifest where the scene is another, and where a piece is long. */
static bool find_pieces(struct run *run, lom_error *error)
{
    size_t most = (size_t)run->manifest.count;
    struct lom_manifest_place place, before;
    struct lom_golden golden;
    run->pieces = lom_allocate(most, sizeof *run->pieces, error);
    run->outcomes = lom_allocate(most, sizeof *run->outcomes, error);
    run->drawn = lom_allocate(most, sizeof *run->drawn, error);
    char *scene = lom_allocate(run->manifest.file.size + 1, 1, error); /* of the piece before */
    if (run->pieces == NULL || run->outcomes == NULL || run->drawn == NULL || scene == NULL ||
        !lom_begin_goldens(&run->manifest, &place, error)) {
        lom_release(scene);
        return false;
    }
    for (before = place; lom_next_golden(&run->manifest, &place, &golden); before = place) {
        if (!is_wanted(run, &golden))
            continue;
        struct piece *last = run->piece_count > 0 ? &run->pieces[run->piece_count - 1] : NULL;
        if (last == NULL || last->count == MOST_IN_A_PIECE || strcmp(scene, golden.scene) != 0)
            run->pieces[run->piece_count++] = (struct piece){ before, run->picture_count, 1 };
        else
            last->count++;
        snprintf(scene, run->manifest.file.size + 1, "%s", golden.scene);
        run->picture_count++;
    }
    lom_release(place.words);
    lom_release(scene);
    return run->picture_count > 0 || lom_fail(error, LOM_ERROR_USAGE, "%s:%d: there is no picture on this line.",
                                              run->manifest.path, (int)run->values->line.value[0]);
}

/* ---- telling ---- */

/* Once for pictures of one scene. */
static void tell_warnings(struct run *run, struct lom_outcome *outcome)
{
    if (outcome->warnings == NULL || (run->warnings != NULL && strcmp(run->warnings, outcome->warnings) == 0))
        return;
    lom_tell_warnings(outcome->warnings, outcome->warning_count);
    lom_release(run->warnings);
    run->warnings = outcome->warnings;
    outcome->warnings = NULL;
}

static void tell_golden(struct run *run, const struct lom_golden *golden, struct lom_outcome *outcome)
{
    run->totals[outcome->how]++;
    tell_warnings(run, outcome);
    if (outcome->how == LOM_VERIFIED_APPROVED)
        lom_approve_golden(&run->approved, &run->manifest, golden, outcome->got);
    if (run->cases.out != NULL)
        lom_report_golden_junit(run->cases.out, &run->manifest, golden, outcome);
    if (run->page.path != NULL)
        lom_add_to_verify_page(&run->page, golden, outcome);
    if (!run->values->quiet || outcome->how != LOM_VERIFIED_OK)
        lom_report_golden(stdout, &run->manifest, golden, outcome);
    fflush(stdout);
    lom_drop_outcome(outcome);
}

/* What stands of the pictures behind those that were told of. */
static void tell_drawn(struct run *run)
{
    struct lom_golden golden;
    while (run->told < run->picture_count && atomic_load_explicit(&run->drawn[run->told], memory_order_acquire)) {
        do
            lom_next_golden(&run->manifest, &run->place, &golden);
        while (!is_wanted(run, &golden));
        tell_golden(run, &golden, &run->outcomes[run->told++]);
    }
}

/* ---- drawing, by every worker ---- */

static void draw_pieces(void *context, int worker)
{
    struct run *run = context;
    struct lom_verifier *verifier = &run->verifiers[worker];
    for (int i; (i = atomic_fetch_add_explicit(&run->next, 1, memory_order_relaxed)) < run->piece_count;) {
        const struct piece *piece = &run->pieces[i];
        struct lom_manifest_place place = piece->place;
        place.words = run->words[worker];
        for (int k = 0; k < piece->count; k++) {
            struct lom_golden golden;
            lom_next_golden(&run->manifest, &place, &golden);
            lom_verify_golden(verifier, &golden, &run->outcomes[piece->first + k]);
            atomic_store_explicit(&run->drawn[piece->first + k], true, memory_order_release);
            if (worker == 0)
                tell_drawn(run);
        }
    }
    lom_drop_verifier(verifier);
}

/* A device each: pictures side by side share nothing and wait for nothing, so all workers are busy with small pictures,
 * too. Where there are fewer pieces than workers, a device has several. */
static bool draw_all(struct run *run, lom_error *error)
{
    int threads = run->values->threads.given ? (int)run->values->threads.value[0] : lom_default_threads();
    int workers = threads < run->piece_count ? threads : run->piece_count;
    lom_pool *pool = lom_create_pool(workers, error);
    workers = pool != NULL ? lom_pool_size(pool) : 0;
    run->verifiers = lom_allocate((size_t)workers, sizeof *run->verifiers, error);
    run->words = lom_allocate((size_t)workers, sizeof *run->words, error);
    bool done = pool != NULL && run->verifiers != NULL && run->words != NULL;
    for (int i = 0; i < workers && done; i++) {
        struct lom_manifest_place place;
        run->verifiers[i] =
            (struct lom_verifier){ .values = run->values, .manifest = &run->manifest, .threads = threads / workers };
        done = lom_begin_goldens(&run->manifest, &place, error);
        run->words[i] = place.words;
    }
    if (done)
        lom_run_pool(pool, draw_pieces, run);
    for (int i = 0; i < workers && run->words != NULL; i++)
        lom_release(run->words[i]);
    lom_free_pool(pool);
    return done;
}

/* The suite stands before its cases and says how many there are. */
static bool write_junit(struct run *run)
{
    struct lom_report whole = { .path = run->cases.path };
    if (run->cases.out == NULL)
        return true;
    if (fflush(run->cases.out) != 0)
        return lom_complain("no memory is left.") == LOM_EXIT_DONE;
    bool done = lom_open_report(&whole);
    if (done) {
        lom_begin_junit(whole.out);
        lom_begin_golden_junit(whole.out, &run->manifest, run->totals);
        fwrite(run->cases.text, 1, run->cases.size, whole.out);
        fputs("  </testsuite>\n", whole.out);
        lom_end_junit(whole.out);
        done = lom_write_report(&whole);
    }
    lom_drop_report(&whole);
    return done;
}

/* What the pictures came to. */
static int finish(struct run *run)
{
    const int *totals = run->totals;
    lom_error error = { .code = LOM_OK };
    lom_report_totals(stdout, totals);
    bool done = write_junit(run);
    if (run->page.path != NULL && !lom_write_verify_page(&run->page, totals, &error))
        done = lom_complain_error(&error) == LOM_EXIT_DONE;
    if (totals[LOM_VERIFIED_APPROVED] > 0 && totals[LOM_VERIFIED_ERROR] == 0 && done)
        done = lom_write_approval(&run->approved, &run->manifest);
    else if (totals[LOM_VERIFIED_APPROVED] > 0)
        lom_complain("%s is left as it was.", run->manifest.path);
    if (!done || totals[LOM_VERIFIED_ERROR] > 0)
        return LOM_EXIT_FAILED;
    return run->picture_count == totals[LOM_VERIFIED_OK] + totals[LOM_VERIFIED_APPROVED] ? LOM_EXIT_DONE
                                                                                         : LOM_EXIT_DIFFERS;
}

static int verify_all(struct run *run)
{
    lom_error error = { .code = LOM_OK };
    if (!lom_open_manifest(run->manifest.path, &run->manifest, &error) || !find_pieces(run, &error) ||
        !lom_begin_goldens(&run->manifest, &run->place, &error))
        return lom_complain_error(&error);
    if (!lom_open_report(&run->cases) || !lom_open_report(&run->approved.report))
        return LOM_EXIT_FAILED;
    if ((run->page.path != NULL && !lom_begin_verify_page(&run->page, &run->manifest, &error)) ||
        !draw_all(run, &error))
        return lom_complain_error(&error);
    tell_drawn(run);
    return finish(run);
}

static void drop_run(struct run *run)
{
    for (int i = 0; run->outcomes != NULL && i < run->picture_count; i++)
        lom_drop_outcome(&run->outcomes[i]);
    lom_drop_verify_page(&run->page);
    lom_drop_report(&run->cases);
    lom_drop_report(&run->approved.report);
    lom_release(run->warnings);
    lom_release(run->place.words);
    lom_release(run->words);
    lom_release(run->verifiers);
    lom_release(run->drawn);
    lom_release(run->outcomes);
    lom_release(run->pieces);
    lom_close_manifest(&run->manifest);
}

/* Two files of one name would spoil one another. */
static bool check_names(const char *path, const struct lom_verify_values *v)
{
    if (v->approve && strcmp(path, "-") == 0)
        return lom_complain("verify: --approve writes into the manifest, which must be a file.") == LOM_EXIT_DONE;
    if (v->junit != NULL && strcmp(path, v->junit) == 0)
        return lom_complain("verify: the manifest and --junit are both %s.", path) == LOM_EXIT_DONE;
    if (v->page != NULL && strcmp(path, v->page) == 0)
        return lom_complain("verify: the manifest and --page are both %s.", path) == LOM_EXIT_DONE;
    return v->page == NULL || v->junit == NULL || strcmp(v->page, v->junit) != 0 ||
           lom_complain("verify: --junit and --page are both %s.", v->page) == LOM_EXIT_DONE;
}

int lom_command_verify(int argc, char **argv)
{
    struct lom_verify_values values = { .junit = NULL };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    const char *path = arguments.items[0];
    if (!check_names(path, &values))
        return LOM_EXIT_FAILED;
    struct run run = { .values = &values,
                       .manifest = { .path = path },
                       .cases = { .path = values.junit },
                       .approved = { .report = { .path = values.approve ? path : NULL } },
                       .page = { .path = values.page } };
    status = verify_all(&run);
    drop_run(&run);
    return status;
}
