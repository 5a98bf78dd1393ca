/* METAR: the clouds of an aerodrome's report as layers. In: text. Out: amounts in oktas, bases in metres, kinds.
 * Invariant: a group that is neither understood nor known to tell something else is an error, never passed over. */
#include <lom/cloud.h>

#include <string.h>

/* Manual on Codes (WMO-No. 306), FM 15, 15.9: FEW is 1 to 2 oktas, SCT 3 to 4, BKN 5 to 7, OVC 8. */
static const struct amount {
    const char *code;
    double oktas;
} amounts[] = { { "FEW", 1.5 }, { "SCT", 3.5 }, { "BKN", 6 }, { "OVC", 8 } };
enum { AMOUNTS = sizeof amounts / sizeof *amounts };

static const char *const no_clouds[] = { "SKC", "CLR", "NSC", "NCD", "CAVOK", NULL };
static const char *const reports[] = { "METAR", "SPECI", NULL };
static const char *const ends[] = { "RMK", "BECMG", "TEMPO", "NOSIG", NULL }; /* what follows is no observation */

/* Genera by height and amount, where the report does not tell them: 15.9.1.7 names CB and TCU alone. */
static const struct genera {
    double below; /* metres */
    const char *kind[AMOUNTS];
} genera[] = {
    { 2000, { "cumulus_humilis", "cumulus_mediocris", "stratocumulus", "stratus" } },
    { 6000, { "altocumulus", "altocumulus", "altocumulus", "altostratus" } },
    { 1e9, { "cirrus", "cirrus", "cirrocumulus", "cirrostratus" } },
};

struct group {
    const char *text;
    size_t length;
};

static bool is_text(const struct group *g, size_t from, const char *text)
{
    size_t length = strlen(text);
    return g->length - from == length && memcmp(g->text + from, text, length) == 0;
}

static bool is_one_of(const struct group *g, const char *const *texts)
{
    for (; *texts != NULL; texts++)
        if (is_text(g, 0, *texts))
            return true;
    return false;
}

static bool next_group(const char **at, struct group *g)
{
    *at += strspn(*at, " \t\r\n");
    *g = (struct group){ *at, strcspn(*at, " \t\r\n=") };
    *at += g->length;
    return g->length != 0;
}

/* Hundreds of feet in three digits as metres; -1 for three slashes: not measured; -2 when it is neither. */
static double read_height(const char *text)
{
    double hundreds = 0;
    if (memcmp(text, "///", 3) == 0)
        return -1;
    for (int i = 0; i < 3; i++) {
        if (text[i] < '0' || text[i] > '9')
            return -2;
        hundreds = hundreds * 10 + (text[i] - '0');
    }
    return hundreds * 30.48;
}

static const char *kind_of(int amount, double base)
{
    size_t i = 0;
    while (base >= genera[i].below)
        i++;
    return genera[i].kind[amount];
}

/* FEW030, BKN120CB, SCT///TCU, OVC010///, VV002. False: the group tells no cloud. */
static bool read_layer(const struct group *g, lom_metar_layer *layer)
{
    if (g->length == 5 && memcmp(g->text, "VV", 2) == 0 && read_height(g->text + 2) > -2) {
        *layer = (lom_metar_layer){ 8, 0, "stratus" }; /* the sky is not seen from the ground: cloud down to it */
        return true;
    }
    for (int i = 0; i < AMOUNTS && g->length >= 6; i++) {
        if (memcmp(g->text, amounts[i].code, 3) != 0)
            continue;
        double base = read_height(g->text + 3);
        bool plain = g->length == 6 || is_text(g, 6, "///"), storm = is_text(g, 6, "CB"), tower = is_text(g, 6, "TCU");
        if (base < -1 || !(plain || storm || tower))
            return false;
        *layer = (lom_metar_layer){ amounts[i].oktas, base,
                                    storm   ? "cumulonimbus"
                                    : tower ? "cumulus_congestus"
                                            : kind_of(i, base) };
        return true;
    }
    return false;
}

int lom_parse_metar(const char *text, lom_metar_layer layer[LOM_MAX_METAR_LAYERS], lom_error *error)
{
    struct group g;
    int count = 0;
    bool any = false, is_report = false;
    for (const char *at = text; next_group(&at, &g); any = true) {
        if (!any && is_one_of(&g, reports)) {
            is_report = true;
            continue;
        }
        if (is_report && is_one_of(&g, ends))
            break;
        lom_metar_layer read;
        if (!read_layer(&g, &read)) {
            if (is_report || is_one_of(&g, no_clouds))
                continue;
            lom_fail(error, LOM_ERROR_USAGE,
                     "\"%.*s\" is no group of clouds such as FEW030, BKN120CB, OVC/// or NSC (a whole report begins "
                     "with METAR or SPECI).",
                     g.length < 24 ? (int)g.length : 24, g.text);
            return -1;
        }
        if (count == LOM_MAX_METAR_LAYERS) {
            lom_fail(error, LOM_ERROR_USAGE, "a report has at most %d groups of clouds.", LOM_MAX_METAR_LAYERS);
            return -1;
        }
        layer[count++] = read;
    }
    if (!any)
        lom_fail(error, LOM_ERROR_USAGE, "a report of clouds has at least one group; NSC tells that there are none.");
    return any ? count : -1;
}
