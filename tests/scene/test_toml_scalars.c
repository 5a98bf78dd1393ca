/* Proves that the TOML parser reads characters, strings, numbers and dates as TOML 1.0 has them, and refuses the rest
 * at the right line and column. The expected values are written from the specification; none was recorded. */
#include "toml_cases.h"

/* Every malformed kind of UTF-8 (Unicode 15, table 3-7), in a comment, in which anything else would be allowed. */
static void utf8(void)
{
    static const invalid_case wrong[] = {
        { TEXT("#\x80"), "1:2: " },
        { TEXT("#\xc3"), "1:2: " },
        { TEXT("#\xc0\x80"), "1:2: " },
        { TEXT("#\xc1\xbf"), "1:2: " },
        { TEXT("#\xe0\x80\x80"), "1:2: " },
        { TEXT("#\xe0\x9f\xbf"), "1:2: " },
        { TEXT("#\xed\xa0\x80"), "1:2: " },
        { TEXT("#\xed\xbf\xbf"), "1:2: " },
        { TEXT("#\xf0\x8f\xbf\xbf"), "1:2: " },
        { TEXT("#\xf4\x90\x80\x80"), "1:2: " },
        { TEXT("#\xf5\x80\x80\x80"), "1:2: " },
        { TEXT("#\xe2\x82"), "1:2: " },
        { TEXT("#\xe2\x82\x28"), "1:2: " },
        { TEXT("#\xfe"), "1:2: " },
        { TEXT("\n\n#\xc3\xa4 \xf0\x9f\x98"), "3:4: " },
    };
    INVALID(wrong);
    static const valid_case edges[] = {
        { TEXT("#\xc2\x80\xdf\xbf\xe0\xa0\x80\xed\x9f\xbf\xee\x80\x80\xef\xbf\xbf\xf0\x90\x80\x80\xf4\x8f\xbf\xbf"),
          "{}" },
    };
    VALID(edges);
}

static void basic_strings(void)
{
    static const valid_case cases[] = {
        { TEXT("a = \"I'm \\\"quoted\\\"\\tN\\\\\""), "{a=\"I'm \"quoted\"\\x09N\\x5c\"}" },
        { TEXT("a = \"\\b\\t\\n\\f\\r\""), "{a=\"\\x08\\x09\\x0a\\x0c\\x0d\"}" },
        { TEXT("a = \"\\u00E9 \\U0001F600 \\u0000\""), "{a=\"\\xc3\\xa9 \\xf0\\x9f\\x98\\x80 \\x00\"}" },
        { TEXT("a = \"\\ud7ff\\ue000\\U0010ffff\""), "{a=\"\\xed\\x9f\\xbf\\xee\\x80\\x80\\xf4\\x8f\\xbf\\xbf\"}" },
        { TEXT("a = \"\\u007f\\u0080\\u07ff\\u0800\\uffff\\U00010000\""),
          "{a=\"\\x7f\\xc2\\x80\\xdf\\xbf\\xe0\\xa0\\x80\\xef\\xbf\\xbf\\xf0\\x90\\x80\\x80\"}" },
        { TEXT("a = \"\ttab # no comment\""), "{a=\"\\x09tab # no comment\"}" },
        { TEXT("a = \"\""), "{a=\"\"}" },
        { TEXT("a = '<\\i\\c*\\s*>'\nb = ''"), "{a=\"<\\x5ci\\x5cc*\\x5cs*>\",b=\"\"}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = \"x"), "1:5: this string never ends" },
        { TEXT("a = \"x\n\""), "1:5: this string does not end on its line" },
        { TEXT("a = 'x\r\n'"), "1:5: this string does not end on its line" },
        { TEXT("a = \"\x01\""), "1:6: a control character (U+0001)" },
        { TEXT("a = \"b\x7f\""), "1:7: a control character (U+007F)" },
        { TEXT("a = 'b\x0c'"), "1:7: a control character" },
        { TEXT("a = \"b\0\""), "1:7: a control character (U+0000)" },
        { TEXT("a = \"x\ry\""), "1:7: a control character (U+000D)" },
        { TEXT("a = \"\\q\""), "1:6: unknown escape" },
        { TEXT("a = \"\\e\""), "1:6: unknown escape" },
        { TEXT("a = \"\\x41\""), "1:6: unknown escape" },
        { TEXT("a = \"\\ \""), "1:6: unknown escape" },
        { TEXT("a = \"\\u12\""), "1:6: \\u needs 4 hexadecimal digits" },
        { TEXT("a = \"\\U0001F60\""), "1:6: \\U needs 8" },
        { TEXT("a = \"\\ud800\""), "1:6: U+D800 is not" },
        { TEXT("a = \"\\udfff\""), "1:6: U+DFFF is not" },
        { TEXT("a = \"\\U00110000\""), "1:6: U+110000 is not" },
        { TEXT("a = \"\\uffffffff\" x"), "1:18: the line must end" },
        { TEXT("a = \"\\"), "1:6: unknown escape" },
        { TEXT("a = 'it's'"), "1:9: the line must end here" },
    };
    INVALID(wrong);
}

static void multi_line_strings(void)
{
    static const valid_case cases[] = {
        { TEXT("a = \"\"\"\nRoses\nViolets\"\"\""), "{a=\"Roses\\x0aViolets\"}" },
        { TEXT("a = \"\"\"\r\nRoses\r\nViolets\"\"\""), "{a=\"Roses\\x0aViolets\"}" },
        { TEXT("a = \"\"\"The \\\n\n   quick \\  \t\n  fox\"\"\""), "{a=\"The quick fox\"}" },
        { TEXT("a = \"\"\"\\\n  x \\\n  \"\"\""), "{a=\"x \"}" },
        { TEXT("a = \"\"\"\\\r\n  x\"\"\""), "{a=\"x\"}" },
        { TEXT("a = \"\"\"two \"\" q\"\"\""), "{a=\"two \"\" q\"}" },
        { TEXT("a = \"\"\"\"one\"\"\"\""), "{a=\"\"one\"\"}" },
        { TEXT("a = \"\"\"\"\"two\"\"\"\"\""), "{a=\"\"\"two\"\"\"}" },
        { TEXT("a = \"\"\"three \"\"\\\" \"\"\""), "{a=\"three \"\"\" \"}" },
        { TEXT("a = \"\"\"\"\"\"\nb = ''''''"), "{a=\"\",b=\"\"}" },
        { TEXT("a = '''\nI [dw]on't \\need\n'''"), "{a=\"I [dw]on't \\x5cneed\\x0a\"}" },
        { TEXT("a = ''''That,' she'''''"), "{a=\"'That,' she''\"}" },
        { TEXT("a = '''\n\n'''"), "{a=\"\\x0a\"}" },
        { TEXT("a = [ \"\"\"x\ny\"\"\", 1 ]"), "{a=[\"x\\x0ay\",i1]}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = \"\"\"x\"\""), "1:5: this string never ends" },
        { TEXT("a = '''x"), "1:5: this string never ends" },
        { TEXT("a = \"\"\"six \"\"\"\"\"\""), "1:17: the line must end here" },
        { TEXT("a = '''x''''''"), "1:14: the line must end here" },
        { TEXT("a = \"\"\"x\\ y\n\"\"\""), "1:9: a backslash before blanks" },
        { TEXT("a = \"\"\"\n\x02\"\"\""), "2:1: a control character" },
        { TEXT("a = '''\nx\r'''"), "2:2: a control character (U+000D)" },
        { TEXT("a = \"\"\"x\\\ry\"\"\""), "1:9: " },
    };
    INVALID(wrong);
}

static void integers(void)
{
    static const valid_case cases[] = {
        { TEXT("a=[+99, 42, 0, -17, +0, -0]"), "{a=[i99,i42,i0,i-17,i0,i0]}" },
        { TEXT("a=[1_000, 5_349_221, 1_2_3]"), "{a=[i1000,i5349221,i123]}" },
        { TEXT("a=[0xDEADBEEF, 0xdead_beef, 0o755, 0b1101_0110, 0x00, 0o0_1]"),
          "{a=[i3735928559,i3735928559,i493,i214,i0,i1]}" },
        { TEXT("a=9223372036854775807\nb=-9223372036854775808\nc=0x7fffffffffffffff"),
          "{a=i9223372036854775807,b=i-9223372036854775808,c=i9223372036854775807}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = 9223372036854775808"), "1:5: this integer does not fit" },
        { TEXT("a = -9223372036854775809"), "1:5: this integer does not fit" },
        { TEXT("a = 99999999999999999999999999"), "1:5: this integer does not fit" },
        { TEXT("a = 0x8000000000000000"), "1:5: this integer does not fit" },
        { TEXT("a = 01"), "1:5: \"01\" is not a value" },
        { TEXT("a = -01"), "1:5: \"-01\" is not" },
        { TEXT("a = 0_1"), "1:5: " },
        { TEXT("a = 1__0"), "1:5: \"1__0\" is not" },
        { TEXT("a = 1_"), "1:5: " },
        { TEXT("a = _1"), "1:5: " },
        { TEXT("a = +_1"), "1:5: " },
        { TEXT("a = ++1"), "1:5: " },
        { TEXT("a = +"), "1:5: " },
        { TEXT("a = 0x"), "1:5: " },
        { TEXT("a = 0x_1"), "1:5: " },
        { TEXT("a = 0x1_"), "1:5: " },
        { TEXT("a = 0xg"), "1:5: " },
        { TEXT("a = 0o8"), "1:5: " },
        { TEXT("a = 0b2"), "1:5: " },
        { TEXT("a = 0X1"), "1:5: " },
        { TEXT("a = +0x1"), "1:5: " },
        { TEXT("a = -0b1"), "1:5: " },
        { TEXT("a = 1a"), "1:5: \"1a\" is not" },
    };
    INVALID(wrong);
}

static void floats(void)
{
    static const valid_case cases[] = {
        { TEXT("a=[+1.0, 3.1415, -0.01, 0.0, -0.0]"), "{a=[f1,f3.1415,f-0.01,f0,f-0]}" },
        { TEXT("a=[5e+22, 1e06, -2E-2, 6.5e3, 1e1_0, 0e0]"), "{a=[f5e+22,f1000000,f-0.02,f6500,f10000000000,f0]}" },
        { TEXT("a=[224_617.445_991_228, 9_0.1]"), "{a=[f224617.445991228,f90.1]}" },
        { TEXT("a=[inf, +inf, -inf]"), "{a=[finf,finf,f-inf]}" },
        { TEXT("a=[nan, +nan, -nan]"), "{a=[fnan,fnan,fnan]}" },
        { TEXT("a=[1e400, 1e-400]"), "{a=[finf,f0]}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = .7"), "1:5: " },
        { TEXT("a = 7."), "1:5: " },
        { TEXT("a = 3.e+20"), "1:5: " },
        { TEXT("a = 1.e"), "1:5: " },
        { TEXT("a = 1e"), "1:5: " },
        { TEXT("a = 1e+"), "1:5: " },
        { TEXT("a = 1._1"), "1:5: " },
        { TEXT("a = 1_.1"), "1:5: " },
        { TEXT("a = 1.1_"), "1:5: " },
        { TEXT("a = 1e_1"), "1:5: " },
        { TEXT("a = 1_e1"), "1:5: " },
        { TEXT("a = 1e1.0"), "1:5: " },
        { TEXT("a = 01.0"), "1:5: " },
        { TEXT("a = 1.0.0"), "1:5: " },
        { TEXT("a = Inf"), "1:5: " },
        { TEXT("a = NaN"), "1:5: " },
        { TEXT("a = infinity"), "1:5: " },
        { TEXT("a = +-1.0"), "1:5: " },
        { TEXT("a = 1,5"), "1:6: the line must end" },
        { TEXT("a = 0x1.0"), "1:5: " },
        { TEXT("a = --inf"), "1:5: " },
    };
    INVALID(wrong);
}

static void booleans_and_dates(void)
{
    static const valid_case cases[] = {
        { TEXT("a=[true,false]"), "{a=[true,false]}" },
        { TEXT("a=1979-05-27T07:32:00Z"), "{a=d1979-05-27T07:32:00Z}" },
        { TEXT("a=1979-05-27T00:32:00.999999-07:00"), "{a=d1979-05-27T00:32:00.999999-07:00}" },
        { TEXT("a=1979-05-27 07:32:00z # c"), "{a=d1979-05-27 07:32:00z}" },
        { TEXT("a=1979-05-27t07:32:00"), "{a=d1979-05-27t07:32:00}" },
        { TEXT("a=1979-05-27 \nb=07:32:00.5"), "{a=d1979-05-27,b=d07:32:00.5}" },
        { TEXT("a=[2000-02-29,2024-02-29,1999-12-31,23:59:60]"),
          "{a=[d2000-02-29,d2024-02-29,d1999-12-31,d23:59:60]}" },
    };
    VALID(cases);
    static const invalid_case wrong[] = {
        { TEXT("a = True"), "1:5: " },
        { TEXT("a = truer"), "1:5: " },
        { TEXT("a = 1979-13-01"), "1:5: the calendar" },
        { TEXT("a = 1979-00-01"), "1:5: the calendar" },
        { TEXT("a = 1979-04-31"), "1:5: the calendar" },
        { TEXT("a = 1979-05-00"), "1:5: the calendar" },
        { TEXT("a = 1900-02-29"), "1:5: the calendar" },
        { TEXT("a = 2023-02-29"), "1:5: the calendar" },
        { TEXT("a = 24:00:00"), "1:5: the calendar" },
        { TEXT("a = 12:60:00"), "1:5: the calendar" },
        { TEXT("a = 12:00:61"), "1:5: the calendar" },
        { TEXT("a = 1979-05-27T07:32:00+24:00"), "1:5: the calendar" },
        { TEXT("a = 1979-05-27T07:32:00+00:60"), "1:5: the calendar" },
        { TEXT("a = 1979-5-27"), "1:5: " },
        { TEXT("a = 79-05-27"), "1:5: " },
        { TEXT("a = 07:32"), "1:5: " },
        { TEXT("a = 07:32:00."), "1:5: " },
        { TEXT("a = 1979-05-27T"), "1:5: " },
        { TEXT("a = 1979-05-27T07:32"), "1:5: " },
        { TEXT("a = 1979-05-27T07:32:00+0700"), "1:5: " },
        { TEXT("a = 07:32:00Z"), "1:5: " },
        { TEXT("a = 1979-05-27  07:32:00"), "1:17: the line must end" },
    };
    INVALID(wrong);
}

int main(int argc, char **argv)
{
    RUN(utf8);
    RUN(basic_strings);
    RUN(multi_line_strings);
    RUN(integers);
    RUN(floats);
    RUN(booleans_and_dates);
    return check_result();
}
