/* OBJ and MTL: every statement and form, computed normals against closed forms, places in messages. */
#include "obj.h"

/* Some text must be refused with a message that begins with start and holds part. */
static void refuse_bytes(const char *text, size_t size, const char *start, const char *part)
{
    lom_error error = { 0 };
    lom_mesh *mesh = lom_decode_obj(text, size, "a.obj", &error);
    CHECK(mesh == NULL && error.code != LOM_OK, "accepted: %s", text);
    CHECK(strncmp(error.text, start, strlen(start)) == 0 && strstr(error.text, part) != NULL, "%s: \"%s\"", text,
          error.text);
    lom_free_mesh(mesh);
}

static void refuse(const char *text, const char *start, const char *part)
{
    refuse_bytes(text, strlen(text), start, part);
}

static bool near3(const float *a, double x, double y, double z, double error)
{
    return __builtin_fabs(a[0] - x) <= error && __builtin_fabs(a[1] - y) <= error && __builtin_fabs(a[2] - z) <= error;
}

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 .25\nvn 0 0 1\nvn 0 0 2\n"

static void forms(void)
{
    const char *faces[] = {
        "f 1 2 3",    "f 1/1 2/2 3/4",       "f 1//1 2//2 3//1",       "f 1/1/1 2/2/2 3/4/1",
        "f -4 -3 -2", "f -4/-4 -3/-3 -2/-1", "f -4//-2 -3//-1 -2//-2", "f -4/-4/-2 -3/-3/-1 -2/-1/-2"
    };
    for (int i = 0; i < 8; i++) {
        char text[300];
        snprintf(text, sizeof text, SQUARE "%s\n", faces[i]);
        lom_mesh *mesh = decode(text);
        if (mesh == NULL)
            continue;
        CHECK(mesh->vertex_count == 3 && mesh->index_count == 3 && mesh->source_triangles == 1, "%s", faces[i]);
        CHECK(near3(mesh->vertices[2].position, 1, 1, 0, 0), "%s", faces[i]);
        float v = i % 2 == 1 ? .75f : 0;
        CHECK(mesh->vertices[2].uv[1] == v, "%s: v %g", faces[i], (double)mesh->vertices[2].uv[1]);
        CHECK(near3(mesh->vertices[1].normal, 0, 0, i % 4 >= 2 ? 2 : 1, 0), "%s", faces[i]);
        CHECK(mesh->part_count == 1 && mesh->parts[0].material == -1 && mesh->parts[0].index_count == 3);
        lom_free_mesh(mesh);
    }
}

static void syntax(void)
{
    lom_mesh *plain = decode("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const char *same[] = {
        "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n",
        "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4",
        "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4",
        "# head \\\n v\t0 0 0 # c\nv 1 0 0 #\nv 1.0 +1. .0e3\n  v 0 1e0 0e-9\n\n\nf 1 2 3 4 #",
        "v 0 0 \\\n0\nv 1 0 0\\\r\n\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n  3 \\\n 4\n",
        "v 0 0 0 1\nv 1 0 0 2 1 1 1\nv 1 1 0 1 1 1\nv 0 1 0\nf 1 2 3 4\n",
        "o thing\ng a b\ns off\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvp 1 2\ncstype bezier\nf 1 2 3 4\n",
        "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nfo 1 2 3 4\nusemtl\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng x \\\n y \\\nf 1 1 1\nf 1 2 3 4\n",
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        lom_mesh *mesh = decode(same[i]);
        CHECK(mesh != NULL && plain != NULL && same_mesh(mesh, plain), "case %zu", i);
        lom_free_mesh(mesh);
    }
    lom_free_mesh(plain);
    lom_mesh *colored = decode("v 0 0 0 .1 .2 .3\nv 1 0 0 9 .4 .5 .6\nv 1 1 0\nf 1 2 3\n");
    if (colored != NULL) {
        CHECK(near3(colored->vertices[0].color, .1f, .2f, .3f, 0) && colored->vertices[0].color[3] == 1);
        CHECK(near3(colored->vertices[1].color, .4f, .5f, .6f, 0) && near3(colored->vertices[2].color, 1, 1, 1, 0));
    }
    lom_free_mesh(colored);
}

static void refusals(void)
{
    refuse("", "a.obj:1: ", "without a face");
    refuse("vn 0 0 1\n\n", "a.obj:3: ", "without a face");
    refuse("vn 0 0 1\nl 1 2\n\n", "a.obj:2: ", "The line names vertex 1, and the file has 0");
    refuse("v 0 0 0\np 1 3\n", "a.obj:2: ", "The point names vertex 3, and the file has 1");
    refuse("v 0 0 0\np 0\n", "a.obj:2: ", "index of 0");
    refuse("v 0 0 0\nl 1 x\n", "a.obj:2: ", "is not a corner");
    refuse("v 0 0\n", "a.obj:1: ", "numbers");
    refuse("v 0 0 0 0 0\n", "a.obj:1: ", "numbers");
    refuse("v 0 0 0 0 0 0 0 0\n", "a.obj:1: ", "More than 7");
    refuse("\n\nv 0 nan 0\n", "a.obj:3: ", "\"nan\" is not a number");
    refuse("v 0 inf 0\n", "a.obj:1: ", "not a number");
    refuse("v 0 1e999 0\n", "a.obj:1: ", "1e999 does not fit");
    refuse("v 0 -3.5e38 0\n", "a.obj:1: ", "does not fit");
    refuse("v 0 1,5 0\n", "a.obj:1: ", "\"1,5\" is not a number");
    refuse("v 0 0x10 0\n", "a.obj:1: ", "not a number");
    refuse("v 0 \\\n0 \\\nz\n", "a.obj:3: ", "\"z\"");
    refuse("vt\n", "a.obj:1: ", "vt");
    refuse("vt 1e39\n", "a.obj:1: ", "fit");
    refuse("vt 1 2 3 4\n", "a.obj:1: ", "at most 3");
    refuse("vn 1 2\n", "a.obj:1: ", "3 numbers");
    refuse(SQUARE "f 1 2 5\n", "a.obj:11: ", "vertex 5");
    refuse(SQUARE "f 1 2 0\n", "a.obj:11: ", "index of 0");
    refuse(SQUARE "f 1 2 -5\n", "a.obj:11: ", "out of range");
    refuse(SQUARE "f 1 2 99999999999999999999\n", "a.obj:11: ", "out of range");
    refuse(SQUARE "f 1 2 2147483648\n", "a.obj:11: ", "out of range");
    refuse(SQUARE "f 1/1 2 3/3\n", "a.obj:11: ", "different forms");
    refuse(SQUARE "f 1/1/1 2/2 3/3/1\n", "a.obj:11: ", "different forms");
    refuse(SQUARE "f 1 2//1 3\n", "a.obj:11: ", "different forms");
    const char *corners[] = { "1/", "/1", "1//", "1/1/", "1/1/1/1", "1.5", "1 /2", "a", "1/a", "-", "1///1", "1\\2" };
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++) {
        char text[300];
        snprintf(text, sizeof text, SQUARE "f %s 2 3\n", corners[i]);
        refuse(text, "a.obj:11: ", "is not a corner");
    }
    refuse_bytes("v 0 0 0\nv \0 0 0\n", 16, "a.obj:2: ", "zero byte");
    char name[200];
    snprintf(name, sizeof name, "usemtl %070d\n", 7);
    refuse(name, "a.obj:1: ", "longer than 63");
}

/* What other readers take with a warning is a mesh and a warning that says where: the sentence and the vertices. */
static void passed_over(void)
{
    static const struct {
        const char *text, *says;
        size_t vertices, triangles, warnings;
    } cases[] = {
        { "v 0 0 0\nv 1 2 3\n", "a.obj:3: the file has no face", 2, 0, 1 },
        { "v 0 0 0\nv 1 2 3\np\n", "a.obj:3: a line of fewer", 2, 0, 2 },
        { "v 0 0 0\nv 1 2 3\nl 1\nl\n", "a.obj:3: 2 lines of fewer", 2, 0, 2 },
        { "v 0 0 0\nv 1 2 3\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2\n", "a.obj:3: 2 curves", 2, 0, 2 },
        { SQUARE "f 1 2\n", "a.obj:11: a face of fewer", 4, 0, 2 },
        { SQUARE "f 1 2\nf 1 2 3\nf\nf 1\n", "a.obj:11: 3 faces of fewer", 3, 1, 1 },
        { SQUARE "curv 1 2\nf 1 2 3\n", "a.obj:11: a curve", 3, 1, 1 },
        { SQUARE "f 1/1 2/2 3/5\n", "a.obj:11: a face names", 3, 1, 1 },
        { SQUARE "f 1//1 2//2 3//3\n", "a.obj:11: a face names", 3, 1, 1 },
        { SQUARE "f 1//1 2//2 3//0\n", "a.obj:11: a face names", 3, 1, 1 },
        { SQUARE "f 1//-1 2//-2 3//-3\n", "a.obj:11: a face names", 3, 1, 1 },
        { SQUARE "f 1/1/1 2/-9/1 3/99999999999/1\nf 1//9 2//9 3//9\n", "a.obj:11: 2 faces name", 6, 2, 1 },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/2/2 3/3/3\n", "a.obj:4: a face names", 3, 1, 1 },
        { "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3/-3/-3 -2/-2/-2 -1/-1/-1\n", "a.obj:4: a face names", 3, 1, 1 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_mesh *mesh = decode(cases[i].text);
        if (mesh == NULL)
            continue;
        CHECK(mesh->vertex_count == cases[i].vertices && mesh->index_count == 3 * cases[i].triangles &&
                  mesh->part_count == (cases[i].triangles > 0),
              "case %zu: %zu vertices, %zu indices", i, mesh->vertex_count, mesh->index_count);
        CHECK(mesh->warnings.count == cases[i].warnings && strstr(mesh->warnings.text, cases[i].says) != NULL,
              "case %zu: %zu: %s", i, mesh->warnings.count, mesh->warnings.text);
        lom_free_mesh(mesh);
    }
    lom_mesh *cloud = decode("v 1 2 3 .5 .25 0\nv -1 5 0\n");
    lom_box bounds = lom_mesh_bounds(cloud);
    CHECK(bounds.low.x == -1 && bounds.low.y == 2 && bounds.high.y == 5 && bounds.high.z == 3);
    CHECK(near3(cloud->vertices[0].color, .5, .25, 0, 0) && near3(cloud->vertices[1].normal, 0, 1, 0, 0));
    lom_free_mesh(cloud);
    /* what is not given is computed: only the corner that lacks its normal, from all faces around it */
    lom_mesh *mesh = decode(SQUARE "f 1//2 2//2 3//7\n");
    CHECK(mesh != NULL && near3(mesh->vertices[0].normal, 0, 0, 2, 0) && near3(mesh->vertices[2].normal, 0, 0, 1, 0));
    lom_free_mesh(mesh);
}

/* A mesh's lines and points: two vertices a segment and one a point, behind the triangles, parts by their materials. */
static void lines_and_points(void)
{
    lom_mesh *mesh =
        decode(SQUARE "usemtl a\nl 1 2 3\np 4 1\nf 1//1 2//1 3//1\nl -1/1 -2/2\nusemtl b\nl 2//2 4//2\np 2\n");
    /* 0..2 of the face; 3, 4, 5 of l 1 2 3; 6, 7 of l 4/1 3/2; 8, 9 of l 2//2 4//2; 10 of p 4; 1 and 2 again */
    static const uint32_t indices[] = { 0, 1, 2, 3, 4, 4, 5, 6, 7, 8, 9, 10, 3, 4 };
    static const lom_mesh_part parts[] = { { 0, 3, 0 }, { 3, 6, 0 }, { 9, 2, 1 }, { 11, 2, 0 }, { 13, 1, 1 } };
    if (mesh == NULL)
        return;
    CHECK(mesh->vertex_count == 11 && mesh->index_count == 3 && mesh->line_index_count == 8 && mesh->point_count == 3,
          "%zu vertices, %zu, %zu, %zu indices", mesh->vertex_count, mesh->index_count, mesh->line_index_count,
          mesh->point_count);
    CHECK(mesh->part_count == 1 && mesh->line_part_count == 2 && mesh->point_part_count == 2 &&
          lom_mesh_parts(mesh) == 5 && mesh->source_triangles == 1 && mesh->warnings.count == 0);
    CHECK(memcmp(mesh->indices, indices, sizeof indices) == 0);
    CHECK(memcmp(mesh->parts, parts, sizeof parts) == 0);
    CHECK(near3(mesh->vertices[6].position, 0, 1, 0, 0) && mesh->vertices[6].uv[1] == 1);
    /* a normal that is not named: of the faces around, else up */
    CHECK(near3(mesh->vertices[3].normal, 0, 0, 1, 0) && near3(mesh->vertices[10].normal, 0, 1, 0, 0));
    CHECK(near3(mesh->vertices[8].normal, 0, 0, 2, 0));
    lom_error error = { 0 };
    lom_bytes text = lom_encode_obj(mesh, NULL, &error);
    lom_mesh *back = lom_decode_obj((const char *)text.data, text.size, "b.obj", &error);
    CHECK(back != NULL && same_mesh(mesh, back), "%s\n%.*s", error.text, (int)text.size, (const char *)text.data);
    char written[2048];
    snprintf(written, sizeof written, "%.*s", (int)text.size, (const char *)text.data);
    CHECK(strstr(written, "\nl 4/4/4 5/5/5 6/6/6\nl 7/7 8/8/8\nusemtl b\nl 9/9/9 10/10/10\nusemtl a\np 11 4/4/4\n") !=
              NULL,
          "%s", written);
    lom_release(text.data);
    lom_free_mesh(back);
    mesh->parts[1].first_index = 2; /* a line that begins among the triangles */
    CHECK(lom_encode_obj(mesh, NULL, &error).data == NULL && strstr(error.text, "Part 1") != NULL, "%s", error.text);
    lom_free_mesh(mesh);
}

/* A line longer than a statement of the writer, and one that closes, come back the same. */
static void long_lines(void)
{
    char text[4096];
    size_t length = 0;
    for (int i = 0; i < 100; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "v %d 0 0\n", i);
    length += (size_t)snprintf(text + length, sizeof text - length, "l");
    for (int i = 0; i <= 100; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, " %d", i % 100 + 1);
    length += (size_t)snprintf(text + length, sizeof text - length, "\np");
    for (int i = 100; i >= 1; i--)
        length += (size_t)snprintf(text + length, sizeof text - length, " %d", i);
    lom_error error = { 0 };
    lom_mesh *mesh = decode(text);
    if (mesh == NULL)
        return;
    CHECK(mesh->vertex_count == 100 && mesh->line_index_count == 200 && mesh->point_count == 100);
    lom_bytes written = lom_encode_obj(mesh, NULL, &error);
    lom_mesh *back = lom_decode_obj((const char *)written.data, written.size, "b.obj", &error);
    CHECK(back != NULL && same_mesh(mesh, back), "%s", error.text);
    lom_release(written.data);
    lom_free_mesh(back);
    lom_free_mesh(mesh);
}

static void warnings_are_counted(void)
{
    lom_warnings all = { 0 }, more = { 0 };
    for (int i = 0; i < 100; i++)
        lom_warn(&all, "sentence\t%d has its place", i);
    lom_warn(&all, "sentence\t%d has its place", 3);
    CHECK(all.count == 100 && strncmp(all.text, "sentence?0 has its place\n", 25) == 0, "%zu", all.count);
    size_t length = strlen(all.text);
    CHECK(length < sizeof all.text && length > sizeof all.text - 40 && all.text[length - 1] == '\n', "%zu", length);
    lom_warn(&more, "one");
    lom_add_warnings(&more, &all);
    CHECK(more.count == 101 && strncmp(more.text, "one\nsentence?0", 14) == 0, "%zu", more.count);
    lom_error error = { 0 };
    CHECK(!lom_warn_instead(&more, &error));
    lom_fail(&error, LOM_ERROR_MEMORY, "none");
    CHECK(!lom_warn_instead(&more, &error) && error.code == LOM_ERROR_MEMORY);
    error = (lom_error){ 0 };
    lom_fail(&error, LOM_ERROR_INPUT, "some");
    CHECK(lom_warn_instead(&more, &error) && error.code == LOM_OK && more.count == 102);
}

static void dedupe(void)
{
    lom_mesh *mesh = decode(SQUARE "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\nf 1/2/1 2/2/1 3/3/2\n");
    if (mesh == NULL)
        return;
    CHECK(mesh->vertex_count == 6, "%zu vertices", mesh->vertex_count);
    const uint32_t expected[9] = { 0, 1, 2, 0, 2, 3, 4, 1, 5 };
    CHECK(memcmp(mesh->indices, expected, sizeof expected) == 0);
    lom_free_mesh(mesh);
}

/* ---- normals ---- */

static void cube_normals(void)
{
    lom_mesh *mesh = decode("v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
                            "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    if (mesh == NULL)
        return;
    CHECK(mesh->vertex_count == 8 && mesh->index_count == 36 && mesh->source_triangles == 12);
    for (int i = 0; i < 8; i++) { /* three faces meet, their sum is the diagonal */
        const lom_mesh_vertex *v = &mesh->vertices[i];
        const double s = 0.57735026918962576;
        CHECK(near3(v->normal, v->position[0] * s, v->position[1] * s, v->position[2] * s, 1e-7));
    }
    for (size_t k = 0; k < mesh->index_count; k += 3) { /* counter-clockwise from outside */
        lom_vec3 p[3];
        for (int i = 0; i < 3; i++) {
            const float *q = mesh->vertices[mesh->indices[k + (size_t)i]].position;
            p[i] = (lom_vec3){ q[0], q[1], q[2] };
        }
        lom_vec3 n = lom_vec3_cross(lom_vec3_subtract(p[1], p[0]), lom_vec3_subtract(p[2], p[0]));
        CHECK(lom_vec3_dot(n, lom_vec3_add(p[0], lom_vec3_add(p[1], p[2]))) > 0);
    }
    lom_free_mesh(mesh);
}

/* Unit face normals are summed: a large face weighs no more than a small one. */
static void unweighted_normals(void)
{
    lom_mesh *mesh = decode("v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 .01\nf 1 2 3\nf 1 3 4\n");
    const double s = 0.70710678118654752;
    CHECK(mesh != NULL && near3(mesh->vertices[0].normal, s, 0, s, 1e-7));
    CHECK(mesh != NULL && near3(mesh->vertices[1].normal, 0, 0, 1, 0) && near3(mesh->vertices[3].normal, 1, 0, 0, 0));
    lom_free_mesh(mesh);
    /* tiny and huge faces have directions, too */
    mesh = decode("v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 2 3\nf 1 4 5\n");
    CHECK(mesh != NULL && near3(mesh->vertices[1].normal, 0, 0, 1, 0) && near3(mesh->vertices[3].normal, 1, 0, 0, 0));
    CHECK(mesh != NULL && near3(mesh->vertices[0].normal, s, 0, s, 1e-7));
    lom_free_mesh(mesh);
}

static void mixed_normals(void)
{
    lom_mesh *mesh = decode("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 -3 0\nf 1//1 2//1 3//1\nf 1 3 4\n");
    if (mesh == NULL)
        return;
    const double s = 0.70710678118654752;
    CHECK(mesh->vertex_count == 6);
    CHECK(near3(mesh->vertices[0].normal, 0, -3, 0, 0), "a given normal stays as it is");
    CHECK(near3(mesh->vertices[3].normal, s, 0, s, 1e-7), "all faces at the position count");
    CHECK(near3(mesh->vertices[5].normal, 1, 0, 0, 0));
    lom_free_mesh(mesh);
    mesh = decode("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
    CHECK(mesh != NULL && near3(mesh->vertices[0].normal, 0, 0, 1, 0), "a sum of 0: the first face decides");
    lom_free_mesh(mesh);
    mesh = decode("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 1\nf 2 3 2\n");
    CHECK(mesh != NULL && mesh->index_count == 9 && near3(mesh->vertices[1].normal, 0, 1, 0, 0), "no area: up");
    lom_free_mesh(mesh);
    mesh = decode("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3 1 2 3\nf 1 4 2\n");
    CHECK(mesh != NULL && near3(mesh->vertices[0].normal, 0, s, s, 1e-7), "a face that passes twice counts once");
    lom_free_mesh(mesh);
}

/* ---- materials ---- */

static const char red_mtl[] =
    "# head\r\nnewmtl red\r\nKa 0.1 0.2 0.3\nKd 1 0 0\nKs .5\nNs 32\nd 0.5\nillum 2\nKe 1 1 1\n"
    "map_Kd -bm 2 -o 1 2 3 -s 4 -clamp on my tex\\red.png # tail\nmap_Ks nonsense\n"
    "newmtl glass #1\nd -halo 7\nnewmtl thin\nTr .25\nKd spectral f.rfl 1\nKd xyz 1 2 3\nmap_d -mm 0 1 "
    "holes\\thin.png\n";

static lom_bytes read_from_table(void *context, const char *name, lom_error *error)
{
    int *calls = context;
    ++*calls;
    const char *text = strcmp(name, "red.mtl") == 0 ? red_mtl
                       : strcmp(name, "sub/b c.mtl") == 0
                           ? "newmtl blue\nKd 0 0 1\nmap_Kd b.png\nnewmtl red\nKd .5 0 0\n"
                       : strcmp(name, "broken.mtl") == 0   ? "newmtl a\nKd 1 2\n"
                       : strcmp(name, "nameless.mtl") == 0 ? "\nKd 1 2 3\nnewmtl \nKd 1 0 0\nmap_Kd\n"
                       : strcmp(name, "negative.mtl") == 0 ? "newmtl a\nNs 0\nNs -1\n"
                                                           : NULL;
    if (text == NULL) {
        lom_fail(error, LOM_ERROR_FILE, "no such file");
        return (lom_bytes){ 0 };
    }
    lom_bytes bytes = { lom_allocate(strlen(text) + 1, 1, error), strlen(text) };
    memcpy(bytes.data, text, bytes.size);
    return bytes;
}

/* The text that context points at, whatever the name. */
static lom_bytes read_given(void *context, const char *name, lom_error *error)
{
    (void)name;
    lom_bytes bytes = { lom_allocate(strlen(context) + 1, 1, error), strlen(context) };
    memcpy(bytes.data, context, bytes.size);
    return bytes;
}

static lom_mesh *decode_with(const char *text, lom_error *error, int *calls)
{
    *error = (lom_error){ 0 };
    *calls = 0;
    return lom_decode_obj_with(text, strlen(text), "dir/a.obj", read_from_table, calls, error);
}

static void materials(void)
{
    lom_error error;
    int calls;
    lom_mesh *mesh = decode_with("mtllib red.mtl\n" TRIANGLE "f 1 2 3\nusemtl red\nf 1 2 3\ng x\nusemtl red\nf 1 2 3\n"
                                 "usemtl thin\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl nowhere\nf 1 2 3\n",
                                 &error, &calls);
    CHECK(mesh != NULL && calls == 1, "%s", error.text);
    if (mesh == NULL)
        return;
    CHECK(mesh->material_count == 4 && mesh->part_count == 5, "%zu %zu", mesh->material_count, mesh->part_count);
    const int part_materials[5] = { -1, 0, 2, 0, 3 };
    const uint32_t counts[5] = { 3, 6, 3, 3, 3 };
    uint32_t first = 0;
    for (int i = 0; i < 5; first += counts[i++])
        CHECK(mesh->parts[i].material == part_materials[i] && mesh->parts[i].index_count == counts[i] &&
                  mesh->parts[i].first_index == first,
              "part %d", i);
    const lom_material *red = &mesh->materials[0], *thin = &mesh->materials[2];
    CHECK(strcmp(red->name, "red") == 0 && near3(red->ambient, .1f, .2f, .3f, 0) && near3(red->diffuse, 1, 0, 0, 0));
    CHECK(near3(red->specular, .5, .5, .5, 0) && red->shininess == 32 && red->opacity == .5f);
    CHECK(strcmp(red->diffuse_map, "my tex/red.png") == 0, "\"%s\"", red->diffuse_map);
    CHECK(strcmp(mesh->materials[1].name, "glass #1") == 0 && mesh->materials[1].opacity == 1);
    CHECK(thin->opacity == .75f && near3(thin->diffuse, 1, 1, 1, 0) && thin->diffuse_map[0] == 0);
    CHECK(strcmp(thin->opacity_map, "holes/thin.png") == 0 && red->opacity_map[0] == 0, "\"%s\"", thin->opacity_map);
    CHECK(strstr(mesh->warnings.text, "\"nowhere\"") != NULL, "\"%s\"", mesh->warnings.text);
    lom_free_mesh(mesh);

    mesh = decode_with("mtllib red.mtl\nmtllib sub/b c.mtl\n" TRIANGLE "usemtl blue\nf 1 2 3\n", &error, &calls);
    CHECK(mesh != NULL && mesh->material_count == 4 && mesh->warnings.count == 0 &&
              mesh->materials[0].diffuse[0] == .5f && mesh->materials[0].diffuse_map[0] == 0,
          "%s", error.text);
    CHECK(mesh != NULL && strcmp(mesh->materials[3].diffuse_map, "sub/b.png") == 0);
    lom_free_mesh(mesh);

    mesh = decode_with("mtllib gone.mtl red.mtl\n" TRIANGLE "usemtl red\nf 1 2 3\n", &error, &calls);
    CHECK(mesh != NULL && mesh->material_count == 3 &&
              strstr(mesh->warnings.text, "dir/a.obj:1: ") == mesh->warnings.text &&
              strstr(mesh->warnings.text, "gone.mtl") != NULL,
          "%s", error.text);
    lom_free_mesh(mesh);

    mesh = decode_with(TRIANGLE "mtllib broken.mtl\nf 1 2 3\n", &error, &calls);
    CHECK(mesh == NULL && strncmp(error.text, "dir/broken.mtl:2: ", 18) == 0, "%s", error.text);
    mesh = decode_with(TRIANGLE "mtllib nameless.mtl\nf 1 2 3\n", &error, &calls);
    CHECK(mesh != NULL && mesh->material_count == 0 && mesh->warnings.count == 3, "%s", error.text);
    CHECK(mesh != NULL && strstr(mesh->warnings.text, "dir/nameless.mtl:2: Kd before the first newmtl") != NULL);
    CHECK(mesh != NULL && strstr(mesh->warnings.text, "dir/nameless.mtl:3: newmtl without a name") != NULL);
    CHECK(mesh != NULL && strstr(mesh->warnings.text, "dir/nameless.mtl:5: map_Kd without a file") != NULL);
    lom_free_mesh(mesh);
    mesh = decode_with(TRIANGLE "mtllib negative.mtl\nf 1 2 3\n", &error, &calls);
    CHECK(mesh == NULL && strstr(error.text, "dir/negative.mtl:3:") != NULL, "%s", error.text);
}

/* Names go to the end of their line, '#' and all: two lines are two names, with or without a file that defines them. */
static void names_with_marks(void)
{
    lom_mesh *mesh = decode(TRIANGLE "usemtl Material #1\nf 1 2 3\nusemtl Material #2\nf 1 2 3\nusemtl #3\nf 1 2 3\n"
                                     "usemtl Material # 4 \t\nf 1 2 3\nusemtl # none\nf 1 2 3\nusemtl #\nf 1 2 3\n");
    if (mesh == NULL)
        return;
    static const char *const names[] = { "Material #1", "Material #2", "#3", "Material # 4" };
    CHECK(mesh->material_count == 4 && mesh->part_count == 5, "%zu %zu", mesh->material_count, mesh->part_count);
    for (size_t i = 0; i < 4 && i < mesh->material_count; i++)
        CHECK(strcmp(mesh->materials[i].name, names[i]) == 0, "\"%s\"", mesh->materials[i].name);
    CHECK(mesh->parts[4].material == -1);
    lom_free_mesh(mesh);
    lom_error error;
    int calls;
    mesh = decode_with("mtllib red.mtl # the materials\n" TRIANGLE "usemtl red # a comment\nf 1 2 3\n"
                       "usemtl glass #1\nf 1 2 3\nusemtl glass #1 # as well\nf 1 2 3\nusemtl thin#\nf 1 2 3\n",
                       &error, &calls);
    CHECK(mesh != NULL && mesh->material_count == 5 && mesh->part_count == 4, "%s", error.text);
    CHECK(mesh != NULL && mesh->parts[0].material == 0 && mesh->parts[1].material == 1 && mesh->warnings.count == 2 &&
          strstr(mesh->warnings.text, "\"thin#\"") != NULL);
    lom_free_mesh(mesh);
}

/* Readers differ in whether a comment ends the name behind newmtl: what is used without it is found when it is one. */
static void comments_behind_newmtl(void)
{
    static const struct {
        const char *mtl, *use;
        float red; /* of the face's diffuse colour: 1 is the default's */
        size_t warnings;
    } cases[] = {
        { "newmtl red # warm\nKd .5 0 0\n", "mtllib a.mtl\nusemtl red\n", .5f, 0 },
        { "newmtl red # warm\nKd .5 0 0\n", "usemtl red\nmtllib a.mtl\n", .5f, 0 },
        { "newmtl red\t#warm\nKd .5 0 0\n", "mtllib a.mtl\nusemtl red # again\n", 1, 1 },
        { "newmtl red # warm\nKd .5 0 0\n", "mtllib a.mtl\nusemtl red # warm\n", .5f, 0 },
        { "newmtl red # warm\nKd .5 0 0\nnewmtl red\nKd .25 0 0\n", "mtllib a.mtl\nusemtl red\n", .25f, 0 },
        { "newmtl red #1\nKd .5 0 0\nnewmtl red #2\nKd .25 0 0\n", "mtllib a.mtl\nusemtl red\n", 1, 1 },
        { "newmtl red#1\nKd .5 0 0\n", "mtllib a.mtl\nusemtl red\n", 1, 1 },
        { "newmtl # warm\nKd .5 0 0\n", "mtllib a.mtl\nusemtl warm\n", 1, 1 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        lom_error error = { 0 };
        snprintf(text, sizeof text, TRIANGLE "%sf 1 2 3\n", cases[i].use);
        lom_mesh *mesh =
            lom_decode_obj_with(text, strlen(text), "a.obj", read_given, (void *)(uintptr_t)cases[i].mtl, &error);
        CHECK(mesh != NULL && mesh->part_count == 1 && mesh->parts[0].material >= 0, "%zu: %s", i, error.text);
        if (mesh == NULL)
            continue;
        const lom_material *used = &mesh->materials[mesh->parts[0].material];
        CHECK(used->diffuse[0] == cases[i].red && mesh->warnings.count == cases[i].warnings, "%zu: \"%s\", %g, \"%s\"",
              i, used->name, (double)used->diffuse[0], mesh->warnings.text);
        lom_free_mesh(mesh);
    }
}

/* A map's name ends where a comment begins that looks like one. */
/* A path that does not fit is refused, and so is a file longer than any mesh. */
static void limits(void)
{
    char mtl[2000];
    const char *text = "mtllib a.mtl\n" TRIANGLE "f 1 2 3\n";
    size_t most = sizeof((lom_material *)0)->diffuse_map - 1;
    for (size_t length = most; length <= most + 1; length++) {
        lom_error error = { 0 };
        snprintf(mtl, sizeof mtl, "newmtl a\nmap_Kd %0*d\n", (int)length, 7);
        lom_mesh *mesh = lom_decode_obj_with(text, strlen(text), "a.obj", read_given, mtl, &error);
        CHECK((mesh != NULL) == (length == most), "%zu bytes: %s", length, error.text);
        CHECK(mesh != NULL || strstr(error.text, "longer than") != NULL, "%zu bytes: %s", length, error.text);
        lom_free_mesh(mesh);
    }
    lom_error error = { 0 };
    CHECK(lom_decode_obj(text, ((size_t)1 << 30) + 1, "a.obj", &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s",
          error.text);
}

static void map_names(void)
{
    static const char *const maps[][2] = {
        { "a.png", "a.png" },
        { "a b.png", "a b.png" },
        { "Map #3.jpg", "Map #3.jpg" },
        { "wood.v2 #3.jpg", "wood.v2 #3.jpg" },
        { "a.png # tail", "a.png" },
        { "a.png #tail", "a.png" },
        { "a.png # see b.jpg", "a.png" },
        { "a.png#1", "a.png#1" },
        { "a # b", "a # b" },
    };
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++) {
        char mtl[100];
        snprintf(mtl, sizeof mtl, "newmtl a\nmap_Kd -s 1 %s\n", maps[i][0]);
        lom_error error = { 0 };
        const char *text = "mtllib a.mtl\n" TRIANGLE "f 1 2 3\n";
        lom_mesh *mesh = lom_decode_obj_with(text, strlen(text), "a.obj", read_given, mtl, &error);
        CHECK(mesh != NULL && strcmp(mesh->materials[0].diffuse_map, maps[i][1]) == 0, "%s: \"%s\"", maps[i][0],
              mesh != NULL ? mesh->materials[0].diffuse_map : error.text);
        lom_free_mesh(mesh);
    }
}

/* Files on disk: material files are looked for beside the OBJ file. */
static void files(void)
{
    char folder[] = "/tmp/lom_obj_XXXXXX", obj[64], mtl[64];
    if (mkdtemp(folder) == NULL)
        return;
    snprintf(obj, sizeof obj, "%s/a.obj", folder);
    snprintf(mtl, sizeof mtl, "%s/a.mtl", folder);
    const char *text = "mtllib a.mtl\n" TRIANGLE "usemtl red\nf 1 2 3\n";
    lom_error error = { 0 };
    CHECK(lom_write_file(obj, text, strlen(text), &error) && lom_write_file(mtl, red_mtl, strlen(red_mtl), &error));
    lom_mesh *mesh = lom_read_obj(obj, &error);
    CHECK(mesh != NULL && mesh->material_count == 3 && mesh->materials[0].opacity == .5f, "%s", error.text);
    lom_free_mesh(mesh);
    remove(mtl);
    mesh = lom_read_obj(obj, &error);
    CHECK(mesh != NULL && mesh->material_count == 1 && strstr(mesh->warnings.text, "a.mtl") != NULL, "%s", error.text);
    lom_free_mesh(mesh);
    remove(obj);
    mesh = lom_read_obj(obj, &error);
    CHECK(mesh == NULL && error.code == LOM_ERROR_FILE && strstr(error.text, obj) != NULL, "%s", error.text);
    remove(folder);
}

int main(int argc, char **argv)
{
    RUN(forms);
    RUN(syntax);
    RUN(refusals);
    RUN(passed_over);
    RUN(lines_and_points);
    RUN(long_lines);
    RUN(warnings_are_counted);
    RUN(dedupe);
    RUN(cube_normals);
    RUN(unweighted_normals);
    RUN(mixed_normals);
    RUN(materials);
    RUN(names_with_marks);
    RUN(comments_behind_newmtl);
    RUN(map_names);
    RUN(limits);
    RUN(files);
    return check_result();
}
