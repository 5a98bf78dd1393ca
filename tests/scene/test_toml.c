/* Proves that the TOML parser accepts what TOML 1.0 has, with the values it says, and refuses the rest at the right
 * line and column. The expected values are written from the specification, section by section; none was recorded. */
#include "toml_cases.h"

static void documents(void)
{
    static const valid_case cases[] = {
        { TEXT(""), "{}" },
        { TEXT("\n\r\n \t\n# only a comment"), "{}" },
        { TEXT("\xef\xbb\xbf"
               "a=1"),
          "{a=i1}" },
        { TEXT("a=1 # c\r\nb=2\r\n"), "{a=i1,b=i2}" },
        { TEXT("# \xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80\ta\na=1"), "{a=i1}" },
        { TEXT("  [ a ]  # x\n b = 1"), "{a={b=i1}}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = 1 b = 2"), "1:7: the line must end here" },
        { TEXT("a = 1\rb = 2"), "1:6: the line must end here" },
        { TEXT("# a\rb"), "1:4: a control character (U+000D)" },
        { TEXT("# a\0b"), "1:4: a control character (U+0000)" },
        { TEXT("# \x7f"), "1:3: a control character (U+007F)" },
        { TEXT("\na\n"), "2:2: \"=\" must follow the key \"a\"" },
        { TEXT("a ="), "1:4: a value is missing" },
        { TEXT("a = # x"), "1:5: a value is missing" },
        { TEXT("= 1"), "1:1: a key is missing" },
        { TEXT("a = 1\xef\xbb\xbf"), "1:5: " },
        { TEXT("a = \"\xff\""), "1:6: the byte 0xff is not UTF-8" },
        { TEXT("\xc3\xa4"), "1:1: a key is missing" },
        { TEXT("x=\"\xc3\xa4\" y"), "1:7: the line must end" }, /* columns count characters */
        { TEXT("\xef\xbb\xbfx y"), "1:3: \"=\"" },              /* and no byte order mark */
    };
    INVALID(wrong);
}

static void keys(void)
{
    static const valid_case cases[] = {
        { TEXT("bare_key = 1\nbare-key = 2\n1234 = 3\n-_- = 4"), "{bare_key=i1,bare-key=i2,1234=i3,-_-=i4}" },
        { TEXT("\"127.0.0.1\" = 1\n'quoted \"v\"' = 2\n\"\" = 3\n"), "{127.0.0.1=i1,quoted \"v\"=i2,=i3}" },
        { TEXT("''=1"), "{=i1}" },
        { TEXT("\"\\u00e4\" = 1"), "{\\xc3\\xa4=i1}" },
        { TEXT("a.b.c = 1\na.d = 2"), "{a={b={c=i1},d=i2}}" },
        { TEXT("a . \"b.c\" .\t'd' = 1"), "{a={b.c={d=i1}}}" },
        { TEXT("3.14159 = 1"), "{3={14159=i1}}" },
        { TEXT("apple.type = 1\norange.type = 2\napple.skin = 3\norange.skin = 4"),
          "{apple={type=i1,skin=i3},orange={type=i2,skin=i4}}" },
        { TEXT("true = 1\ninf = 2\n1979-05-27 = 3"), "{true=i1,inf=i2,1979-05-27=i3}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = 1\na = 2"), "2:1: the key \"a\" stands in this table already (line 1)" },
        { TEXT("a = 1\n\"a\" = 2"), "2:1: the key \"a\"" },
        { TEXT("a = 1\na.b = 2"), "2:1: \"a\" is an integer already" },
        { TEXT("a.b = 1\na = 2"), "2:1: the key \"a\"" },
        { TEXT("a.b = 1\na.b.c = 2"), "2:3: \"b\" is an integer already" },
        { TEXT("a. = 1"), "1:4: a key is missing" },
        { TEXT(".a = 1"), "1:1: a key is missing" },
        { TEXT("a..b = 1"), "1:3: a key is missing" },
        { TEXT("a b = 1"), "1:3: \"=\"" },
        { TEXT("a\n= 1"), "1:2: \"=\"" },
        { TEXT("a = \n1"), "1:5: a value is missing" },
        { TEXT("\"\"\"a\"\"\" = 1"), "1:1: a key may not be a multi-line" },
        { TEXT("\"a\nb\" = 1"), "1:1: this string does not end on its line" },
        { TEXT("a! = 1"), "1:2: \"=\"" },
        { TEXT("\xce\xbb = 1"), "1:1: a key is missing" },
    };
    INVALID(wrong);
}

static void arrays(void)
{
    static const valid_case cases[] = {
        { TEXT("a = []\nb = [ ]\nc = [[],[[]]]"), "{a=[],b=[],c=[[],[[]]]}" },
        { TEXT("a = [ 1, 'x', 2.5, true, {b=1}, [1] , ]"), "{a=[i1,\"x\",f2.5,true,{b=i1},[i1]]}" },
        { TEXT("a = [ # one\n 1, # two\r\n\n 2 # three\n , # four\n]\nb = 1"), "{a=[i1,i2],b=i1}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = [1"), "1:5: this array never ends" },
        { TEXT("a = [1,"), "1:8: a value is missing" },
        { TEXT("a = [,]"), "1:6: a value is missing" },
        { TEXT("a = [1,,2]"), "1:8: a value is missing" },
        { TEXT("a = [1 2]"), "1:8: \",\" or \"]\"" },
        { TEXT("a = [1]]"), "1:8: the line must end" },
        { TEXT("a = [b = 1]"), "1:6: " },
    };
    INVALID(wrong);
}

static void inline_tables(void)
{
    static const valid_case cases[] = {
        { TEXT("a = {}\nb = { }\nc = {x=1,y = 'z'}"), "{a={},b={},c={x=i1,y=\"z\"}}" },
        { TEXT("a = { b.c = 1, b.d = {e=[\n1,\n2\n]} }"), "{a={b={c=i1,d={e=[i1,i2]}}}}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = {x=1,}"), "1:10: a key is missing" },
        { TEXT("a = {x=1\n}"), "1:9: \",\" or \"}\"" },
        { TEXT("a = {\nx=1}"), "1:6: a key is missing" },
        { TEXT("a = {x=1"), "1:9: \",\" or \"}\"" },
        { TEXT("a = {"), "1:6: a key is missing" },
        { TEXT("a = {,}"), "1:6: a key is missing" },
        { TEXT("a = {x=1 y=2}"), "1:10: \",\" or \"}\"" },
        { TEXT("a = {x=1,x=2}"), "1:10: the key \"x\"" },
        { TEXT("a = {b={c=1},b.d=2}"), "1:14: the table \"b\" is complete" },
        { TEXT("a = {b.c=1,b={d=2}}"), "1:12: the key \"b\"" },
        { TEXT("a = {}\na.b = 1"), "2:1: the table \"a\" is complete" },
        { TEXT("a = {}\n[a]"), "2:2: the table \"a\" is defined twice" },
        { TEXT("a = {}\n[a.b]"), "2:2: \"a\" is an inline table" },
        { TEXT("a = {b.c=1}\n[a.b.d]"), "2:2: \"a\" is an inline table" },
        { TEXT("[t]\na.b = 1\na = {c=2}"), "3:1: the key \"a\"" },
        { TEXT("[t]\na = {b={}}\na.b.c = 1"), "3:1: the table \"a\"" },
        { TEXT("a = {b=1 # c\n}"), "1:10: \",\" or \"}\"" },
    };
    INVALID(wrong);
}

static void tables(void)
{
    static const valid_case cases[] = {
        { TEXT("[a]\n[b]\nc=1\n[a.d]\ne=2"), "{a={d={e=i2}},b={c=i1}}" },
        { TEXT("[x.y.z.w]\n[x]\na=1"), "{x={y={z={w={}}},a=i1}}" },
        { TEXT("[ j . \"k\" . 'l' ]\n"), "{j={k={l={}}}}" },
        { TEXT("[fruit]\napple.color = 1\napple.taste.sweet = true\n[fruit.apple.texture]\nsmooth = true"),
          "{fruit={apple={color=i1,taste={sweet=true},texture={smooth=true}}}}" },
        { TEXT("[a.b.c]\nz=9\n[a]\nd=1"), "{a={b={c={z=i9}},d=i1}}" },
        { TEXT("[\"\"]\na=1"), "{={a=i1}}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("[a]\n[a]"), "2:2: the table \"a\" is defined twice" },
        { TEXT("[a]\nb=1\n[a.b]"), "3:4: \"b\" is a value" },
        { TEXT("a=1\n[a.b]"), "2:2: \"a\" is a value" },
        { TEXT("[fruit]\napple.color=1\n[fruit.apple]"), "3:8: the table \"apple\" is defined twice" },
        { TEXT("[fruit]\napple.taste.x=1\n[fruit.apple.taste]"), "3:14: the table \"taste\" is defined twice" },
        { TEXT("[a.b.c]\nz=9\n[a]\nb.c.t=1"), "4:3: the table \"c\" is complete" },
        { TEXT("[a.b.c.d]\nz=9\n[a]\nb.c.d.k.t=1"), "4:5: the table \"d\" is complete" },
        { TEXT("[]"), "1:2: a key is missing" },
        { TEXT("[a"), "1:3: \"]\" must close" },
        { TEXT("[a.]"), "1:4: a key is missing" },
        { TEXT("[a]]"), "1:4: the line must end" },
        { TEXT("[a] b=1"), "1:5: the line must end" },
        { TEXT("[a\n]"), "1:3: \"]\" must close" },
        { TEXT("[a b]"), "1:4: \"]\" must close" },
        { TEXT("[a=1]"), "1:3: \"]\" must close" },
    };
    INVALID(wrong);
}

static void arrays_of_tables(void)
{
    static const valid_case cases[] = {
        { TEXT("[[p]]\nn=1\n[[p]]\n[[p]]\nn=2"), "{p=[{n=i1},{},{n=i2}]}" },
        { TEXT("[[f]]\nn=1\n[f.x]\nc=1\n[[f.v]]\nn=2\n[[f.v]]\nn=3\n[[f]]\nn=4\n[[f.v]]\nn=5"),
          "{f=[{n=i1,x={c=i1},v=[{n=i2},{n=i3}]},{n=i4,v=[{n=i5}]}]}" },
        { TEXT("[[a]]\nb.c=1\n[[a]]\nb.c=2"), "{a=[{b={c=i1}},{b={c=i2}}]}" },
        { TEXT("[[a.b]]\n[a]\nc=1"), "{a={b=[{}],c=i1}}" },
        { TEXT("[[ a . b ]]"), "{a={b=[{}]}}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("[a]\n[[a]]"), "2:3: \"a\" is something else" },
        { TEXT("[[a]]\n[a]"), "2:2: \"a\" is a value or an array of tables" },
        { TEXT("a = []\n[[a]]"), "2:3: \"a\" is something else" },
        { TEXT("a = [{}]\n[a.b]"), "2:2: \"a\" is a value" },
        { TEXT("[f.p]\n[[f]]"), "2:3: \"f\" is something else" },
        { TEXT("[[a.b]]\n[a]\nb.y=2"), "3:1: \"b\" is an array" },
        { TEXT("[[a]]\n[[a.b]]\n[a.b]"), "3:4: \"b\" is a value or an array" },
        { TEXT("[[a]\n"), "1:4: \"]]\" must close" },
        { TEXT("[ [a]]"), "1:3: a key is missing" },
        { TEXT("[[a] ]"), "1:4: \"]]\" must close" },
        { TEXT("[[]]"), "1:3: a key is missing" },
    };
    INVALID(wrong);
}

/* A document of a repeated text between a head and a tail; freed with free. */
static document repeated(const char *head, const char *middle, size_t count, const char *tail)
{
    size_t h = strlen(head), m = strlen(middle), t = strlen(tail);
    char *text = malloc(h + m * count + t + 1);
    memcpy(text, head, h);
    for (size_t i = 0; i < count; i++)
        memcpy(text + h + i * m, middle, m);
    memcpy(text + h + m * count, tail, t + 1);
    return (document){ text, h + m * count + t };
}

static lom_code code_of(document in)
{
    lom_arena arena = { 0 };
    lom_toml_source source;
    lom_error error = { 0 };
    parse(&arena, &source, in, &error);
    lom_arena_release(&arena);
    free((void *)(size_t)in.text);
    return error.code;
}

static void limits(void)
{
    CHECK(code_of(repeated("a=", "[", 64, "]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]")) ==
          LOM_OK);
    CHECK(code_of(repeated("a=", "[", 65, "")) == LOM_ERROR_LIMIT);
    CHECK(code_of(repeated("a=", "[", 10 << 20, "")) == LOM_ERROR_LIMIT);
    CHECK(code_of(repeated("a=", "{a=", 65, "")) == LOM_ERROR_LIMIT);
    CHECK(code_of(repeated("", "a.", 63, "a=1")) == LOM_OK);
    CHECK(code_of(repeated("", "a.", 64, "a=1")) == LOM_ERROR_INPUT);
    CHECK(code_of(repeated("[", "a.", 64, "a]")) == LOM_ERROR_INPUT);
    CHECK(code_of(repeated("a=[", "1,", LOM_TOML_MAX_VALUES - 2, "]")) == LOM_OK);
    CHECK(code_of(repeated("a=[", "1,", LOM_TOML_MAX_VALUES - 1, "]")) == LOM_ERROR_LIMIT);
    CHECK(code_of(repeated("#", " ", LOM_TOML_MAX_SIZE - 1, "")) == LOM_OK);
    CHECK(code_of(repeated("#", " ", LOM_TOML_MAX_SIZE, "")) == LOM_ERROR_LIMIT);
    char *many = malloc(16 * (LOM_TOML_MAX_KEYS + 2));
    for (size_t extra = 0; extra < 2; extra++) {
        size_t used = 0;
        for (size_t i = 0; i < LOM_TOML_MAX_KEYS + extra; i++)
            used += (size_t)snprintf(many + used, 16, "k%zu=1\n", i);
        CHECK(code_of(repeated("", many, 1, "")) == (extra ? LOM_ERROR_LIMIT : LOM_OK));
    }
    free(many);
}

/* Text of every kind, cut at every byte and with every bit turned over: accepted or refused, but never a wrong read
 * (the sanitizers look), and always one line. */
static void damaged(void)
{
    static const char text[] = "\xef\xbb\xbf# c\r\ntitle = \"\\u00e9 \\U0001F600\\n\"\nm = \"\"\"\n a \\\n  b\"\"\"\"\n"
                               "l = '''x'''\n[a.\"b c\".'d']\nn = [0x1f, 1_000, -2.5e-3, inf, nan, {q.r = true}]\n"
                               "d = 1979-05-27T07:32:00.5+01:00\nt = 07:32:00\n[[e]]\nx.y = {z = [ 1, # k\n 2 ]}\n"
                               "[[e]]\n[e.f]\ng = ''\n";
    size_t size = sizeof text - 1, accepted = 0;
    for (size_t i = 0; i < size * 9; i++) {
        char *copy = malloc(size + 1); /* exact size: a read behind the end is caught */
        memcpy(copy, text, size);
        size_t length = i < size ? i : size;
        if (i >= size)
            copy[(i - size) / 8] ^= (char)(1 << ((i - size) % 8));
        lom_arena arena = { 0 };
        lom_error error = { 0 };
        lom_toml_source source;
        char *exact = malloc(length > 0 ? length : 1);
        memcpy(exact, copy, length);
        bool good = parse(&arena, &source, (document){ exact, length }, &error) != NULL;
        accepted += good;
        CHECK(good == (error.code == LOM_OK), "%zu: %s", i, error.text);
        CHECK(strchr(error.text, '\n') == NULL, "%zu: %s", i, error.text);
        lom_arena_release(&arena);
        free(copy);
        free(exact);
    }
    CHECK(accepted > size && accepted < 8 * size, "%zu", accepted);
}

static void places(void)
{
    static const char text[] = "a = 1\n  [b]\n \xc3\xa4 = 1";
    static const struct {
        size_t offset, line, column;
    } cases[] = { { 0, 1, 1 }, { 4, 1, 5 }, { 6, 2, 1 }, { 8, 2, 3 }, { 13, 3, 2 }, { 15, 3, 3 }, { 99, 3, 7 } };
    lom_toml_source source = { .name = "t", .text = text, .size = sizeof text - 1 };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t line, column;
        lom_toml_place(&source, cases[i].offset, &line, &column);
        CHECK(line == cases[i].line && column == cases[i].column, "%zu: %zu:%zu", cases[i].offset, line, column);
    }
}

int main(int argc, char **argv)
{
    RUN(documents);
    RUN(keys);
    RUN(arrays);
    RUN(inline_tables);
    RUN(tables);
    RUN(arrays_of_tables);
    RUN(limits);
    RUN(damaged);
    RUN(places);
    return check_result();
}
