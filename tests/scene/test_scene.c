/* Proves that a scene file becomes the struct it says: every default, every kind of value, angles in radians, file
 * names, overrides; and that what is wrong is refused in exactly the words and at exactly the place that help. */
#include "check.h"

#include <lom/scene.h>

#include <sys/stat.h>
#include <unistd.h>

static lom_scene *decode(const char *text, const char *override, lom_error *error)
{
    *error = (lom_error){ 0 };
    return lom_decode_scene(text, strlen(text), "lake.toml", &override, override != NULL, error);
}

static bool near(double a, double b)
{
    return __builtin_fabs(a - b) <= 1e-15 * (1 + __builtin_fabs(b));
}

static bool is_vector(lom_vec3 v, double x, double y, double z)
{
    return near(v.x, x) && near(v.y, y) && near(v.z, z);
}

#define PI 3.14159265358979323846

static void defaults(void)
{
    lom_error error;
    lom_scene *s = decode("", NULL, &error);
    CHECK(s != NULL, "%s", error.text);
    if (s == NULL)
        return;
    CHECK(s->output.width == 1280 && s->output.height == 720 && s->output.transfer == LOM_TRANSFER_SRGB);
    CHECK(s->output.format == LOM_OUTPUT_RGB8 && s->output.frames == 1 && s->output.fps == 30 && !s->output.present);
    CHECK(is_vector(s->camera.position, 0, 2, 10) && is_vector(s->camera.target, 0, 0, 0));
    CHECK(is_vector(s->camera.up, 0, 1, 0) && near(s->camera.field_of_view, PI / 4) && s->camera.near_plane == 0.1);
    CHECK(s->camera.key_count == 0 && s->entity_count == 0 && !s->terrain.present && !s->water.present);
    double half = 0.70710678118654752440; /* the sun in the south-east, 45 degrees high: light goes to -x, -y, -z... */
    CHECK(is_vector(s->light.direction, -half * half, -half, -half * half), "%g %g %g", s->light.direction.x,
          s->light.direction.y, s->light.direction.z);
    CHECK(s->light.intensity == 1 && s->light.color[2] == 1 && s->light.ambient[0] == 0.15);
    CHECK(s->sky.faces[0] == NULL && s->sky.intensity == 1 && s->sky.color[2] == 0.8);
    CHECK(s->water.reflection && s->water.refraction && s->water.projection && s->water.flow && s->water.normals);
    CHECK(s->water.fresnel && s->water.specular && s->water.tint && s->water.soft_shore && s->water.normal_up == 3);
    CHECK(s->water.size[0] == 100 && s->water.size[1] == 100 && s->water.normal_map == NULL);
    CHECK(s->quality.water == LOM_WATER_DISPLACED && s->quality.terrain_composite == 1 &&
          s->quality.shading == LOM_SHADING_PHONG && s->quality.mipmaps);
    CHECK(s->quality.texture_filter == LOM_TEXTURE_TRILINEAR && s->quality.reflection_scale == 1);
    CHECK(strcmp(s->path, "lake.toml") == 0);
    lom_free_scene(s);
    lom_free_scene(NULL);
}

static const char full[] =
    "title = 'Lake'\n"
    "output = {width = 64, height = 32, transfer = 'naive', format = 'rgb16', frames = 3, fps = 12.5}\n"
    "[camera]\nposition = [1, 2.5, -3]\ntarget = [0, 1, 0]\nup = [0, 2, 0]\nfield_of_view = 60\nnear = 0.5\n"
    "[light]\ndirection = [0, -3, 4]\ncolor = [1, 0.5, 0.25]\nintensity = 2\nambient = [0, 0, 0.1]\n"
    "[terrain]\nheight_map = 'a'\nsize = [200, 300]\nheight = 40\nbase = -5\ntexture = 'b'\n"
    "material = {specular = 0.5, shininess = 3}\n"
    "[[terrain.layer]]\nmap = 'a'\nfrom_height = 2\n[[terrain.layer]]\nmap = 'b'\nto_slope = 45\ntile = 7\n"
    "[sky]\npattern = 'sky_%s'\nrotation = 90\n"
    "[water]\nlevel = 3.5\nfresnel = false\ntile = 5\nnormal_map = './b'\n"
    "[[entity]]\nname = 'boat'\nmesh = 'a'\nposition = [1, 0, 2]\nrotation = [0, 180, 0]\nscale = 2\non_ground = true\n"
    "[[entity]]\nmesh = 'b'\nscale = [1, 2, 3]\nvisible = false\n"
    "[entity.material]\ndiffuse = [1, 0, 0]\ntexture = 'a'\n"
    "[quality]\nshading = 'flat'\ntexture_filter = 'nearest'\nmipmaps = false\nreflection_scale = 0.25\n";

static void everything(void)
{
    lom_error error;
    lom_scene *s = decode(full, NULL, &error);
    CHECK(s != NULL, "%s", error.text);
    if (s == NULL)
        return;
    CHECK(strcmp(s->title, "Lake") == 0 && s->output.width == 64 && s->output.transfer == LOM_TRANSFER_NAIVE);
    CHECK(s->output.format == LOM_OUTPUT_RGB16 && s->output.frames == 3 && s->output.fps == 12.5);
    CHECK(is_vector(s->camera.position, 1, 2.5, -3) && is_vector(s->camera.target, 0, 1, 0));
    CHECK(is_vector(s->camera.up, 0, 1, 0) && near(s->camera.field_of_view, PI / 3) && s->camera.near_plane == 0.5);
    CHECK(is_vector(s->light.direction, 0, -0.6, 0.8) && s->light.color[1] == 0.5 && s->light.intensity == 2);
    const lom_terrain *t = &s->terrain;
    CHECK(t->present && strcmp(t->height_map, "a") == 0 && t->size[0] == 200 && t->size[1] == 300);
    CHECK(t->height == 40 && t->base == -5 && strcmp(t->texture, "b") == 0 && t->layer_count == 2);
    CHECK(t->material.specular[2] == 0.5 && t->material.diffuse[0] == 1 && t->material.shininess == 3);
    CHECK(t->layers[0].from_height == 2 && t->layers[0].to_height == 1e9 && near(t->layers[1].to_slope, PI / 4));
    CHECK(t->layers[1].tile == 7 && t->layers[1].from_height == -1e9 && near(t->layers[1].slope_blend, PI / 36));
    CHECK(strcmp(s->sky.faces[0], "sky_right") == 0 && strcmp(s->sky.faces[5], "sky_back") == 0);
    CHECK(near(s->sky.rotation, PI / 2));
    CHECK(s->water.present && s->water.enabled && s->water.level == 3.5 && !s->water.fresnel && s->water.flow);
    CHECK(s->water.size[0] == 200 && s->water.size[1] == 300, "the terrain's size");
    CHECK(s->entity_count == 2 && strcmp(s->entities[0].name, "boat") == 0 && s->entities[1].name == NULL);
    CHECK(is_vector(s->entities[0].scale, 2, 2, 2) && is_vector(s->entities[1].scale, 1, 2, 3));
    CHECK(is_vector(s->entities[0].rotation, 0, PI, 0) && s->entities[0].on_ground && s->entities[0].visible);
    CHECK(!s->entities[0].material.present && !s->entities[1].visible && !s->entities[1].on_ground);
    const lom_scene_material *given = &s->entities[1].material;
    CHECK(!given->has_ambient && given->has_diffuse && !given->has_specular && !given->has_shininess);
    CHECK(given->present && given->texture != NULL);
    CHECK(s->quality.shading == LOM_SHADING_FLAT && s->quality.texture_filter == LOM_TEXTURE_NEAREST);
    CHECK(!s->quality.mipmaps && s->quality.reflection_scale == 0.25 && s->quality.refraction_scale == 1);
    static const char *const files[] = { "lake.toml", "a",       "b",          "./b",       "sky_right",
                                         "sky_left",  "sky_top", "sky_bottom", "sky_front", "sky_back" };
    size_t count;
    const char *const *list = lom_scene_files(s, &count);
    CHECK(count == sizeof files / sizeof *files, "%zu", count);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        size_t found = 0;
        for (size_t j = 0; j < count; j++)
            found += strcmp(files[i], list[j]) == 0;
        CHECK(found == 1, "%s %zu times", files[i], found);
    }
    lom_free_scene(s);
}

static void a_material_says_which_of_the_meshs_values_it_replaces(void)
{
    static const struct {
        const char *value;
        bool has[5]; /* ambient, diffuse, specular, shininess, texture */
    } cases[] = { { "entity.1.material={ambient=1}", { true } },
                  { "entity.1.material={diffuse=1}", { [1] = true } },
                  { "entity.1.material={specular=1}", { [2] = true } },
                  { "entity.1.material={shininess=1}", { [3] = true } },
                  { "entity.1.material={texture='a'}", { [4] = true } } };
    for (size_t i = 0; i < 5; i++) {
        lom_error error;
        lom_scene *s = decode(full, cases[i].value, &error);
        CHECK(s != NULL, "%s: %s", cases[i].value, error.text);
        const lom_scene_material *m = s != NULL ? &s->entities[1].material : &(lom_scene_material){ false };
        const bool has[5] = { m->has_ambient, m->has_diffuse, m->has_specular, m->has_shininess, m->texture != NULL };
        CHECK(memcmp(has, cases[i].has, sizeof has) == 0, "%s", cases[i].value);
        lom_free_scene(s);
    }
}

/* ---- what is wrong ---- */

typedef struct wrong_case {
    const char *text, *override, *message;
} wrong_case;

static void check_wrong(const wrong_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        lom_error error;
        lom_scene *s = decode(cases[i].text, cases[i].override, &error);
        CHECK(s == NULL && strcmp(error.text, cases[i].message) == 0, "%zu: \"%s\", expected \"%s\"", i, error.text,
              cases[i].message);
        lom_free_scene(s);
    }
}

#define WRONG(cases) check_wrong(cases, sizeof(cases) / sizeof *(cases))

static void unknown_keys(void)
{
    static const wrong_case cases[] = {
        { "\n\n  [watre]\n", NULL, "lake.toml:3:4: unknown key \"watre\" (did you mean \"water\"?)" },
        { "[water]\nlevle = 3", NULL, "lake.toml:2:1: unknown key \"levle\" (did you mean \"level\"?)" },
        { "[water]\nfluffiness = 3", NULL, "lake.toml:2:1: unknown key \"fluffiness\"" },
        { "[camera]\nfov = 3", NULL, "lake.toml:2:1: unknown key \"fov\"" },
        { "camera.postion = [1,2,3]", NULL, "lake.toml:1:8: unknown key \"postion\" (did you mean \"position\"?)" },
        { "[[entity]]\nmesh='a'\nsacle=1", NULL, "lake.toml:3:1: unknown key \"sacle\" (did you mean \"scale\"?)" },
        { "[[camera.key]]\ntime=1\ntargets=1", NULL,
          "lake.toml:3:1: unknown key \"targets\" (did you mean \"target\"?)" },
        { "\"wa\\nter\" = 1", NULL, "lake.toml:1:1: unknown key \"wa?ter\" (did you mean \"water\"?)" },
        { "x = 1", NULL, "lake.toml:1:1: unknown key \"x\"" },
    };
    WRONG(cases);
}

static void wrong_values(void)
{
    static const wrong_case cases[] = {
        { "[water]\nlevel = 'deep'", NULL, "lake.toml:2:9: \"level\" must be a number, not a string." },
        { "[water]\ntint = 1", NULL, "lake.toml:2:8: \"tint\" must be true or false, not an integer." },
        { "[output]\nwidth = 6.5", NULL, "lake.toml:2:9: \"width\" must be an integer, not a number." },
        { "[output]\nwidth = 0", NULL, "lake.toml:2:9: \"width\" is 0 but must be from 1 to 32768 pixels." },
        { "[output]\nwidth = 9223372036854775807", NULL,
          "lake.toml:2:9: \"width\" is 9.223372036854776e+18 but must be from 1 to 32768 pixels." },
        { "[output]\ntransfer = 'sgrb'", NULL,
          "lake.toml:2:12: \"transfer\" is \"sgrb\" but must be \"srgb\" or \"naive\" (did you mean \"srgb\"?)." },
        { "[output]\ntransfer = 1", NULL,
          "lake.toml:2:12: \"transfer\" must be \"srgb\" or \"naive\", not an integer." },
        { "[camera]\nfield_of_view = 180", NULL,
          "lake.toml:2:17: \"field_of_view\" is 180 but must be from 0.01 to 179 degrees." },
        { "[camera]\nnear = 0", NULL, "lake.toml:2:8: \"near\" is 0 but must be above 0 and at most 1000000 m." },
        { "[camera]\nup = [0, nan, 1]", NULL, "lake.toml:2:10: \"up\" is nan but must be finite." },
        { "[camera]\nposition = [0, 1]", NULL,
          "lake.toml:2:12: \"position\" must be an array of 3 numbers, not of 2." },
        { "[camera]\nposition = [0, 1, true]", NULL,
          "lake.toml:2:19: \"position\" must be made of numbers, not true or false." },
        { "[[entity]]\nmesh='a'\nscale = 'big'", NULL,
          "lake.toml:3:9: \"scale\" must be one number or an array of 3 numbers, not a string." },
        { "[[entity]]\nmesh='a'\nscale = 0", NULL,
          "lake.toml:3:9: \"scale\" is 0 but must be above 0 and at most 1000000." },
        { "[water.waves]\nkind = 'sea'\nsize = 100", NULL,
          "lake.toml:3:8: the samples a side of a patch are a power of two." },
        { "[water.waves]\nkind = 'sea'\nwind_level = 'breezy'", NULL,
          "lake.toml:3:14: There is no wind level \"breezy\"; they go from \"calm\" to \"hurricane\"." },
        { "[water.waves]\nkind = 'sea'\npatch = 0.01", NULL,
          "lake.toml:3:9: The sea's patch length in metres is 0.00021286869603193167, which is not within "
          "0.001..1000000." },
        { "[water.waves]\nwind_speed = nan", NULL,
          "lake.toml:2:14: \"wind_speed\" is nan but must be from 0 to 100 m/s." },
        { "[water.waves]\nsteepness = 7", NULL, "lake.toml:2:13: \"steepness\" is 7 but must be from 0 to 1." },
        { "[water.waves]\nlength = [1, 20]", NULL, "lake.toml:2:10: the longest wave comes first, then the shortest." },
        { "[water]\nlevel = inf", NULL,
          "lake.toml:2:9: \"level\" is inf but must be from -1000000000 to 1000000000 m." },
        { "water = 3", NULL, "lake.toml:1:9: \"water\" must be a table, not an integer." },
        { "[[terrain]]", NULL, "lake.toml:1:3: \"terrain\" must be a table, not an array." },
        { "[entity]", NULL, "lake.toml:1:2: \"entity\" must be an array of tables, not a table." },
        { "entity = [1]", NULL, "lake.toml:1:11: \"entity\" must be made of tables, not an integer." },
        { "title = 2020-01-01", NULL, "lake.toml:1:9: \"title\" must be a string, not a date." },
        { "title = \"a\\u0000\"", NULL, "lake.toml:1:9: \"title\" may not hold the character U+0000." },
        { "\n[[entity]]\nname='x'", NULL, "lake.toml:2:3: the key \"mesh\" is missing in this table." },
        { "[terrain]\n", NULL, "lake.toml:1:2: the key \"height_map\" is missing in this table." },
        { "[terrain]\nheight_map = ''", NULL, "lake.toml:2:14: the terrain needs a height map." },
        { "a =", NULL, "lake.toml:1:4: a value is missing here." },
    };
    WRONG(cases);
}

static void wrong_files(void)
{
    static const wrong_case cases[] = {
        { "[[entity]]\nmesh = 'boat.obj'", NULL, "lake.toml:2:8: there is no file \"boat.obj\"." },
        { "[[entity]]\nmesh = '.'", NULL, "lake.toml:2:8: \".\" is a folder, not a file." },
        { "[sky]\npattern = 'moon_%s'", NULL, "lake.toml:2:11: there is no file \"moon_right\"." },
        { "[sky]\npattern = 'sky'", NULL, "lake.toml:2:11: \"pattern\" must have one %s, for right, left, top, ..." },
        { "[sky]\npattern = '%s%s'", NULL, "lake.toml:2:11: \"pattern\" must have one %s, for right, left, top, ..." },
        { "[sky]\npattern = '%d'", NULL, "lake.toml:2:11: \"pattern\" must have one %s, for right, left, top, ..." },
        { "[sky]\nfaces = ['a','a','a','a','a']", NULL,
          "lake.toml:2:9: \"faces\" must be an array of 6 file names, not of 5." },
        { "[sky]\nfaces = ['a','a','a','a','a','']", NULL,
          "lake.toml:2:9: \"faces\" must name all six pictures, or be left out." },
        { "[sky]\nfaces = ['a','a','a','a','a','a']\npattern='sky_%s'", NULL,
          "lake.toml:3:9: the sky has either a pattern or faces, not both." },
    };
    WRONG(cases);
    lom_error error = { 0 };
    CHECK(lom_read_scene("no/such.toml", NULL, 0, &error) == NULL && strstr(error.text, "no/such.toml") != NULL, "%s",
          error.text);
    error = (lom_error){ 0 };
    lom_scene *s = lom_decode_scene("[[entity]]\nmesh='../a'", 22, "inner/x.toml", NULL, 0, &error);
    CHECK(s != NULL && strcmp(s->entities[0].mesh, "inner/../a") == 0, "%s", error.text);
    lom_free_scene(s);
}

static void contradictions(void)
{
    static const wrong_case cases[] = {
        { "[camera]\ntarget = [0,0,0]\nyaw = 3", NULL,
          "lake.toml:3:7: the camera has either a target or yaw and pitch, not both." },
        { "[camera]\nup = [0,0,1]\npitch = 3", NULL,
          "lake.toml:2:6: yaw and pitch say what is up; use roll to turn the picture." },
        { "[camera]\nposition = [0,0,0]", NULL,
          "lake.toml:2:12: the camera cannot look there: target is its position, or lies along up." },
        { "[camera]\nposition = [0,5,0]", NULL,
          "lake.toml:2:12: the camera cannot look there: target is its position, or lies along up." },
        { "[[camera.key]]\ntime = 1\n[[camera.key]]\ntime = 1", NULL,
          "lake.toml:4:8: the times of keys must rise, by a millionth of a second or more." },
        { "[camera]\nfollow = 'plane'", NULL, "lake.toml:2:10: no entity has this name." },
        { "[clouds]\n[[clouds.wind]]\nheight = 5\n[[clouds.wind]]\nheight = 5", NULL,
          "lake.toml:5:10: the heights of winds must rise." },
        { "[[spray]]\nfrom=[0,0,0]\nname='a'\n[[spray]]\nfrom=[0,0,0]\nname='a'", NULL,
          "lake.toml:6:6: another emitter has this name already." },
        { "[[spray]]\nfrom=[0,0,0]\ncount=600000\n[[spray]]\nfrom=[0,0,0]\ncount=600000", NULL,
          "lake.toml:6:7: the drops of all emitters together are more than 1000000." },
        { "[[spray]]\nfrom=[0,0,0]\nlife=3\nheight=3", NULL,
          "lake.toml:4:8: spray has either a life or a height, not both." },
        { "[[spray]]\nfrom=[0,0,0]\ndrag=1000\nheight=1000", NULL,
          "lake.toml:4:8: a fall through this height must take from 0.001 to 3600 s." },
        { "[[spray]]\ncount=3", NULL, "lake.toml:1:3: the key \"from\" is missing in this table." },
        { "[[spray]]\nsource='entity'", NULL, "lake.toml:2:8: spray of an entity names one by `entity`." },
        { "[[spray]]\nfrom=[0,0,0]\nentity='boat'", NULL,
          "lake.toml:3:8: only spray of `source = \"entity\"` names one." },
        { "[[spray]]\nsource='entity'\nentity='boat'", NULL, "lake.toml:3:8: no entity has this name." },
        { "[[camera.key]]\ntime = 1\nposition=[1,1,1]\ntarget=[1,0,1]", NULL,
          "lake.toml:4:8: the camera cannot look there: target is its position, or lies along up." },
        { "[light]\ndirection=[1,0,0]\nazimuth=3", NULL,
          "lake.toml:2:11: the light has either a direction or azimuth and elevation, not both." },
        { "[light]\ndirection=[0,0,0]", NULL, "lake.toml:2:11: the light's direction must not be zero." },
        { "[[entity]]\nmesh='a'\non_ground=true", NULL, "lake.toml:3:11: there is no terrain to stand on." },
        { "[[entity]]\nmesh='a'\nname='x'\n[[entity]]\nmesh='a'\nname='x'", NULL,
          "lake.toml:6:6: another entity has this name already." },
        { "[terrain]\nheight_map='a'\nlayer=[{map='a',from_height=2,to_height=1}]", NULL,
          "lake.toml:3:29: \"from_height\" must not be above \"to_height\"." },
        { "[terrain]\nheight_map='a'\nlayer=[{map='a',from_slope=20,to_slope=10}]", NULL,
          "lake.toml:3:28: \"from_slope\" must not be above \"to_slope\"." },
        { "[terrain]\nheight_map='a'\nlayer=[{map=''}]", NULL, "lake.toml:3:13: a layer needs a map." },
        { "[[entity]]\nmesh='a'\n[[entity.key]]\ntime=2\n[[entity.key]]\ntime=1", NULL,
          "lake.toml:6:6: the times of keys must rise, by a millionth of a second or more." },
        { "[[light.key]]\ntime=2\n[[light.key]]\ntime=2", NULL,
          "lake.toml:4:6: the times of keys must rise, by a millionth of a second or more." },
        { "[[cloud]]\nvoxels=[8,8.5,8]", NULL, "lake.toml:2:8: \"voxels\" must be made of whole numbers." },
        { "[surf]\nheight=1", NULL, "lake.toml:2:8: waves come in to a shore: there is no terrain." },
        { "[shallow]", NULL, "lake.toml:1:2: shallow water is the surface of [water], which there is not." },
        { "[water]\n[shallow]\n[[shallow.body]]\nhalf=1", NULL,
          "lake.toml:3:11: a body needs a position or an entity." },
        { "[water]\n[shallow]\n[[shallow.body]]\nentity='boat'", NULL, "lake.toml:4:8: no entity has this name." },
        { "[water]\n[shallow]\n[[shallow.body]]\nposition=[0,0]\nduration=2\nevery=1", NULL,
          "lake.toml:6:7: it dips in again after its duration, which is above 0." },
        { "[water]\n[shallow]\n[[shallow.body]]\nposition=[0,0]\nevery=1", NULL,
          "lake.toml:5:7: it dips in again after its duration, which is above 0." },
        { "[[wake]]\nentity='boat'", NULL, "lake.toml:1:3: a wake lies on [water], which there is not." },
        { "[water]\n[[wake]]\nentity='boat'", NULL, "lake.toml:3:8: no entity has this name." },
        { "[water]\n[[wake]]\nhalf=1", NULL, "lake.toml:2:3: the key \"entity\" is missing in this table." },
    };
    WRONG(cases);
    static const struct {
        const char *element, *says;
    } lists[] = { { "{position=[0,0],rate=1}", "lake.toml:3:8: there are at most 64 springs." },
                  { "{position=[0,0]}", "lake.toml:3:6: there are at most 64 bodies." } };
    for (int i = 0; i < 2; i++)
        for (int count = 64; count <= 65; count++) {
            char text[3000];
            lom_error error = { 0 };
            size_t used = (size_t)snprintf(text, sizeof text, "[water]\n[shallow]\n%s=[", i == 0 ? "spring" : "body");
            for (int k = 0; k < count; k++)
                used += (size_t)snprintf(text + used, sizeof text - used, "%s,", lists[i].element);
            snprintf(text + used, sizeof text - used, "]");
            lom_scene *scene = lom_decode_scene(text, strlen(text), "lake.toml", NULL, 0, &error);
            CHECK((scene != NULL) == (count == 64) && (count == 64 || strcmp(error.text, lists[i].says) == 0), "%d: %s",
                  count, error.text);
            lom_free_scene(scene);
        }
}

/* As many entities as there may be, each with a name, and one more. */
static void many_entities(void)
{
    enum { ROOM = 64, MOST = 16384 };
    char *text = malloc((size_t)ROOM * (MOST + 1));
    size_t used = 0;
    for (int i = 0; i <= MOST; i++) {
        lom_error error = { 0 };
        if (i == MOST) {
            lom_scene *scene = lom_decode_scene(text, used, "lake.toml", NULL, 0, &error);
            CHECK(scene != NULL && scene->entity_count == MOST, "%s", error.text);
            lom_free_scene(scene);
        }
        used += (size_t)snprintf(text + used, ROOM, "[[entity]]\nname='entity %d'\nmesh='a'\n", i);
    }
    lom_error error = { 0 };
    CHECK(lom_decode_scene(text, used, "lake.toml", NULL, 0, &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s",
          error.text);
    free(text);
}

/* ---- overrides ---- */

static void overrides(void)
{
    static const char *const list[] = { "water.level=7",
                                        "water.level = 8",
                                        "entity.boat.visible=false",
                                        "entity.1.position=[4, 5, 6]",
                                        "entity.1.position.2=9",
                                        "output.transfer=srgb",
                                        "title=two words # kept",
                                        "quality.shading='gouraud'",
                                        "camera.\"near\"=2",
                                        "terrain.layer.0.tile=3",
                                        "water.normal_map=\"\"",
                                        "light={azimuth=90, elevation=0}" };
    lom_error error = { 0 };
    lom_scene *s = lom_decode_scene(full, strlen(full), "lake.toml", list, sizeof list / sizeof *list, &error);
    CHECK(s != NULL, "%s", error.text);
    if (s == NULL)
        return;
    CHECK(s->water.level == 8 && !s->water.fresnel, "the last one wins, the others stay");
    CHECK(!s->entities[0].visible && is_vector(s->entities[1].position, 4, 5, 9));
    CHECK(s->output.transfer == LOM_TRANSFER_SRGB && s->quality.shading == LOM_SHADING_GOURAUD);
    CHECK(strcmp(s->title, "two words # kept") == 0 && s->camera.near_plane == 2 && s->terrain.layers[0].tile == 3);
    CHECK(s->water.normal_map == NULL && is_vector(s->light.direction, -1, 0, 0));
    lom_free_scene(s);
    s = decode("", "water.level=3", &error);
    CHECK(s != NULL && s->water.present && s->water.level == 3, "an override may bring a table: %s", error.text);
    lom_free_scene(s);
}

static void wrong_overrides(void)
{
    static const wrong_case cases[] = {
        { "", "water.levle=3", "--set water.levle=3: unknown key \"levle\" (did you mean \"level\"?)" },
        { "", "watre.level=3", "--set watre.level=3: unknown key \"watre\" (did you mean \"water\"?)" },
        { "", "water.level=deep", "--set water.level=deep: \"level\" must be a number, not a string." },
        { "", "water.level", "--set water.level: an override has the form KEY=VALUE." },
        { "", "=3", "--set =3: a key is missing here (letters, digits, - and _, or quoted)." },
        { "", "", "--set : a key is missing here (letters, digits, - and _, or quoted)." },
        { "", "camera.position=[1,2", "--set camera.position=[1,2: this array never ends." },
        { "", "camera.position=[1,2,3] 4",
          "--set camera.position=[1,2,3] 4: the line must end here; a new key or table starts on its own line." },
        { "", "title.x=1", "--set title.x=1: \"title\" must be a string, not a table." },
        { "title='x'", "title.x=1", "--set title.x=1: \"x\" cannot be a key of a string." },
        { "title='x'", "title.x.y=1", "--set title.x.y=1: \"x\" cannot be a key of a string." },
        { "",
          "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a."
          "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1",
          "--set a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a."
          "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1: a key has at most 64 parts." },
        { full, "entity.boot.visible=false",
          "--set entity.boot.visible=false: nothing here is named \"boot\" (did you mean \"boat\"?)" },
        { full, "entity.2.visible=false",
          "--set entity.2.visible=false: there is no element 2: the array has 2, counted from 0." },
        { full, "entity.99999999999999999999999.visible=false",
          "--set entity.99999999999999999999999.visible=false: there is no element 99999999999999999999999: the array "
          "has 2, counted from 0." },
        { full, "entity.0.mesh=none.obj", "--set entity.0.mesh=none.obj: there is no file \"none.obj\"." },
        { full, "camera.yaw=3", "--set camera.yaw=3: the camera has either a target or yaw and pitch, not both." },
        { "", "title=\xff", "--set title=?: the byte 0xff is not UTF-8 here." },
    };
    WRONG(cases);
}

/* The full scene, cut at every byte and with every bit turned over. */
static void damaged(void)
{
    size_t size = sizeof full - 1, accepted = 0;
    for (size_t i = 0; i < size * 9; i++) {
        size_t length = i < size ? i : size;
        char *copy = malloc(length > 0 ? length : 1);
        memcpy(copy, full, length);
        if (i >= size)
            copy[(i - size) / 8] ^= (char)(1 << ((i - size) % 8));
        lom_error error = { 0 };
        lom_scene *s = lom_decode_scene(copy, length, "lake.toml", NULL, 0, &error);
        CHECK((s != NULL) == (error.code == LOM_OK), "%zu: %s", i, error.text);
        accepted += s != NULL;
        lom_free_scene(s);
        free(copy);
    }
    CHECK(accepted > 20 && accepted < 6 * size, "%zu of %zu", accepted, 9 * size);
}

/* Empty files with the names the scenes here use, in a folder of their own. */
static bool make_files(void)
{
    static const char *const names[] = { "a",       "b",          "sky_right", "sky_left",
                                         "sky_top", "sky_bottom", "sky_front", "sky_back" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        FILE *file = fopen(names[i], "w");
        if (file == NULL)
            return false;
        fclose(file);
    }
    return true;
}

int main(int argc, char **argv)
{
    char folder[] = "/tmp/lom-scene-XXXXXX", command[64];
    if (mkdtemp(folder) == NULL || chdir(folder) != 0 || mkdir("inner", 0700) != 0 || !make_files()) {
        perror(folder);
        return 2;
    }
    RUN(defaults);
    RUN(everything);
    RUN(a_material_says_which_of_the_meshs_values_it_replaces);
    RUN(unknown_keys);
    RUN(wrong_values);
    RUN(wrong_files);
    RUN(contradictions);
    RUN(many_entities);
    RUN(overrides);
    RUN(wrong_overrides);
    RUN(damaged);
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) != 0 || check_result();
}
