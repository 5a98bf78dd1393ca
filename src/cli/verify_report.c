/* Reports on golden pictures. In: what became of each. Out: a line each, totals, JUnit's XML. Invariant: words, totals
 * and failures come from one table; nothing is drawn or decided here. */
#include "verify.h"

static const struct {
    const char *total; /* "3 pictures: 2 ..." */
    bool fails;
} kinds[LOM_VERIFIED_COUNT] = {
    [LOM_VERIFIED_OK] = { "ok", false },
    [LOM_VERIFIED_APPROVED] = { "approved", false },
    [LOM_VERIFIED_NEW] = { "not yet approved", true },
    [LOM_VERIFIED_DIFFERS] = { "different", true },
    [LOM_VERIFIED_FLAT] = { "of one colour", true },
    [LOM_VERIFIED_UNSTEADY] = { "not deterministic", true },
    [LOM_VERIFIED_ERROR] = { "not drawn", false },
};

const char *lom_verified_name(lom_verified how)
{
    return kinds[how].total;
}

void lom_drop_outcome(struct lom_outcome *outcome)
{
    for (int i = 0; i < LOM_SHOWN_COUNT; i++)
        lom_release(outcome->shown[i].data);
    lom_release(outcome->warnings);
    lom_release(outcome->picture);
    *outcome = (struct lom_outcome){ .picture = NULL };
}

void lom_describe_outcome(const struct lom_outcome *o, char text[LOM_OUTCOME_LETTERS])
{
    unsigned long long expected = o->expected, got = o->got, again = o->again;
    switch (o->how) {
    case LOM_VERIFIED_OK:
        snprintf(text, LOM_OUTCOME_LETTERS, "ok");
        break;
    case LOM_VERIFIED_APPROVED:
        snprintf(text, LOM_OUTCOME_LETTERS, "approved: %016llx", got);
        break;
    case LOM_VERIFIED_NEW:
        snprintf(text, LOM_OUTCOME_LETTERS, "not yet approved: got %016llx", got);
        break;
    case LOM_VERIFIED_DIFFERS:
        snprintf(text, LOM_OUTCOME_LETTERS, "differs: expected %016llx, got %016llx", expected, got);
        break;
    case LOM_VERIFIED_FLAT:
        snprintf(text, LOM_OUTCOME_LETTERS, "one colour, and the line does not say flat: got %016llx", got);
        break;
    case LOM_VERIFIED_UNSTEADY:
        snprintf(text, LOM_OUTCOME_LETTERS, "not deterministic: got %016llx and, by other threads and lanes, %016llx",
                 got, again);
        break;
    case LOM_VERIFIED_ERROR:
    case LOM_VERIFIED_COUNT:
        snprintf(text, LOM_OUTCOME_LETTERS, "error: %s", o->error.text);
        break;
    }
}

void lom_report_golden(FILE *out, const struct lom_manifest *manifest, const struct lom_golden *golden,
                       const struct lom_outcome *outcome)
{
    char text[LOM_OUTCOME_LETTERS];
    lom_describe_outcome(outcome, text);
    fprintf(out, "%s:%d: %s: %s\n", manifest->path, golden->number, golden->text, text);
}

void lom_report_golden_junit(FILE *out, const struct lom_manifest *manifest, const struct lom_golden *golden,
                             const struct lom_outcome *outcome)
{
    char text[LOM_OUTCOME_LETTERS];
    bool fails = kinds[outcome->how].fails, is_error = outcome->how == LOM_VERIFIED_ERROR;
    lom_describe_outcome(outcome, text);
    fputs("    <testcase classname=\"", out);
    lom_put_escaped(out, manifest->path);
    fputs("\" name=\"", out);
    lom_put_escaped(out, golden->text);
    fprintf(out, "\" line=\"%d\">", golden->number);
    if (fails || is_error) {
        fputs(is_error ? "<error message=\"" : "<failure message=\"", out);
        lom_put_escaped(out, text);
        fputs("\"/>", out);
    }
    if (outcome->picture != NULL) {
        fputs("<system-out>[[ATTACHMENT|", out);
        lom_put_escaped(out, outcome->picture);
        fputs("]]</system-out>", out);
    }
    fputs("</testcase>\n", out);
}

void lom_begin_golden_junit(FILE *out, const struct lom_manifest *manifest, const int totals[LOM_VERIFIED_COUNT])
{
    int tests = 0, failures = 0;
    for (int i = 0; i < LOM_VERIFIED_COUNT; i++) {
        tests += totals[i];
        failures += kinds[i].fails ? totals[i] : 0;
    }
    fputs("  <testsuite name=\"", out);
    lom_put_escaped(out, manifest->path);
    fprintf(out, "\" tests=\"%d\" failures=\"%d\" errors=\"%d\">\n", tests, failures, totals[LOM_VERIFIED_ERROR]);
}

void lom_report_totals(FILE *out, const int totals[LOM_VERIFIED_COUNT])
{
    int tests = 0, told = 0;
    for (int i = 0; i < LOM_VERIFIED_COUNT; i++)
        tests += totals[i];
    fprintf(out, "%d picture%s:", tests, tests == 1 ? "" : "s");
    for (int i = 0; i < LOM_VERIFIED_COUNT; i++)
        if (totals[i] > 0)
            fprintf(out, "%s %d %s", told++ > 0 ? "," : "", totals[i], kinds[i].total);
    fputc('\n', out);
}
