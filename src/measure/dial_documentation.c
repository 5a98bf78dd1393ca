/* docs/dials.md. In: the table of dials. Out: Markdown. Invariant: what the page says of a dial is what `lom plan`
 * and `lom trade` read. */
#include "measure/dials.h"

#include <string.h>

static const char introduction[] =
    "# The dials\n"
    "\n"
    "<!-- made by `lom make dial-docs -o docs/dials.md` from the tables that the program uses; do not edit -->\n"
    "\n"
    "Everything that is cheaper because it is less exact is a dial: a key of the scene file with named settings, a\n"
    "default, and a reference that tells how wrong each of them is. Their ranges and meanings are those of\n"
    "[scene.md](scene.md): both pages, the reader of scenes, `lom plan SCENE` (which dials act in this scene, at "
    "which\n"
    "setting, and why the others do not), `lom trade`, which measures what they buy, and `lom tune`, which chooses\n"
    "([trade.md](trade.md)), read one table.\n"
    "\n"
    "Settings stand from the cheapest to the most exact; a scene may say any value within the key's range. The "
    "reference\n"
    "is, as far as it knows what is approximated, an independent renderer in double precision (`quality.water =\n"
    "\"reference\"`, `quality.clouds = \"reference\"`): *traced*. Where it does not, it is the dial's own last "
    "setting:\n"
    "*finest*. Dials of speed change no byte, or that is a bug: *equal*.\n";

static const char *const references[] = {
    [LOM_DIAL_TRACED] = "traced", [LOM_DIAL_FINEST] = "finest", [LOM_DIAL_EQUAL] = "equal"
};

/* Words that are separated by `between` as code, with ", " or `joint` between them. */
static void print_words(FILE *out, const char *words, char between, const char *joint)
{
    char word[96];
    for (size_t i = 0; lom_nth_word(words, between, i, word, sizeof word); i++)
        fprintf(out, "%s`%s`", i > 0 ? joint : "", word);
}

/* "where `water` is there and `quality.clouds` is `octaves` or `forward`". */
static void print_needs(FILE *out, const char *needs)
{
    char condition[96], path[64];
    if (needs == NULL)
        fputs("everywhere", out);
    for (size_t i = 0; needs != NULL && lom_nth_word(needs, ' ', i, condition, sizeof condition); i++) {
        const char *values = strchr(condition, '=');
        fputs(i > 0 ? ", " : "", out);
        if (values == NULL) {
            print_words(out, condition, '|', " or ");
            continue;
        }
        lom_nth_word(condition, '=', 0, path, sizeof path);
        fprintf(out, "`%s` = ", path);
        print_words(out, values + 1, '|', " or ");
    }
}

static void print_row(FILE *out, const lom_dial *dial)
{
    char initial[LOM_SCENE_VALUE] = "";
    fprintf(out, "| `%s` | ", dial->name);
    print_words(out, dial->row.settings, ' ', ", ");
    if (dial->key.key != NULL)
        fprintf(out, " | `%s`", lom_print_scene_default(initial, &dial->key));
    fprintf(out, " | %s | %s |", dial->row.approximates, references[dial->row.reference]);
    if (dial->key.key != NULL) {
        fputc(' ', out);
        print_needs(out, dial->row.needs);
        fputs(" |", out);
    }
    fputc('\n', out);
}

static void print_group(FILE *out, const lom_dials *dials, bool of_quality)
{
    fputs("\n| dial | settings | default | approximates | reference | acts with |\n| --- | --- | --- | --- | --- | --- "
          "|\n",
          out);
    for (size_t i = 0; i < dials->count; i++)
        if (dials->dial[i].key.key != NULL && dials->dial[i].key.is_in_quality == of_quality)
            print_row(out, &dials->dial[i]);
}

static void print_own(FILE *out, const lom_dials *dials)
{
    fputs("\n## Of the program\n\n| dial | settings | what it is | reference |\n| --- | --- | --- | --- |\n", out);
    for (size_t i = 0; i < dials->count; i++)
        if (dials->dial[i].key.key == NULL)
            print_row(out, &dials->dial[i]);
}

static bool print_no_dial(void *out, const lom_scene_key *key)
{
    if (key->key->dial != NULL && key->key->dial->none != NULL)
        fprintf(out, "| `%s` | %s |\n", key->path, key->key->dial->none);
    return true;
}

static bool print_untraced(void *out, const lom_scene_key *key)
{
    if (key->key->untraced != NULL)
        fprintf(out, "| `%s` | `%s` |\n", key->path, key->key->untraced);
    return true;
}

void lom_print_dial_documentation(FILE *out)
{
    lom_dials dials;
    lom_list_dials(&dials);
    fputs(introduction, out);
    fputs("\n## Of `[quality]`\n\nNames are the keys' without `quality.`.\n", out);
    print_group(out, &dials, true);
    fputs("\n## Elsewhere in a scene\n", out);
    print_group(out, &dials, false);
    print_own(out, &dials);
    fputs("\n## Keys of `[quality]` that are no dials\n\n| key | why |\n| --- | --- |\n", out);
    lom_visit_scene_keys(print_no_dial, out);
    fputs(
        "\nNor are the size of a sea's patches, their number, the waves of a sum, the cells of shallow water and the\n"
        "voxels of a cloud: with another number it is another sea, another flow, another cloud, in the reference too.\n"
        "\n## What the tracer does not have\n"
        "\nA picture that is compared with the tracer's has these values instead of the scene's.\n"
        "\n| key | value |\n| --- | --- |\n",
        out);
    lom_visit_scene_keys(print_untraced, out);
}
