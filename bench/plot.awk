# awk -F, -v kind=lines|points|bars -v title=T -v x=LABEL -v y=LABEL -f bench/plot.awk FILE.csv: an SVG of a table.
# lines: the first column is x, every other one a series. points: a name, x (drawn by its logarithm), y. bars: a name,
# then a bar a column.
NR == 1 { columns = NF; for (i = 1; i <= NF; i++) head[i] = $i; next }
{ rows++; for (i = 1; i <= NF; i++) cell[rows, i] = $i }

function most(from, to,    r, c, m) {
    for (r = 1; r <= rows; r++)
        for (c = from; c <= to; c++)
            if (cell[r, c] + 0 > m) m = cell[r, c] + 0
    return m > 0 ? m : 1
}
function text(at_x, at_y, anchor, what) {
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", at_x, at_y, anchor, what
}
function line(x1, y1, x2, y2, color) {
    printf "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\"/>\n", x1, y1, x2, y2, color
}
# 1, 2 or 5 times a power of ten, of which `m` holds at least four.
function step_of(m,    s) {
    s = 10 ^ int(log(m / 4) / log(10) - (m < 4))
    return m / 4 / s >= 5 ? 5 * s : m / 4 / s >= 2 ? 2 * s : s
}
function highest_left(    r, found) {
    for (r = 1; r <= rows; r++)
        if (!(r in named) && (!found || cell[r, 3] + 0 > cell[found, 3] + 0)) found = r
    if (found) named[found] = 1
    return found
}
function place_y(v) { return 290 - 240 * v / high }

END {
    split("#1b6ca8 #c8553d #4f8a3c #8b5fa3 #c79a1e", color, " ")
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 340\" font-family=\"sans-serif\" font-size=\"12\">"
    print "<rect width=\"640\" height=\"340\" fill=\"white\"/>"
    text(320, 22, "middle", title)
    high = kind == "points" ? most(3, 3) : most(2, columns)
    step = step_of(high)
    for (v = 0; v <= high * 1.0001; v += step) {
        line(70, place_y(v), 620, place_y(v), "#ddd")
        text(64, place_y(v) + 4, "end", sprintf("%g", v))
    }
    text(8, 28, "start", y)
    text(620, 330, "end", x)
    if (kind == "lines") {
        wide = most(1, 1)
        for (r = 1; r <= rows; r++)
            text(70 + 540 * cell[r, 1] / wide, 306, "middle", cell[r, 1])
        for (c = 2; c <= columns; c++) {
            printf "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"2\" points=\"", color[c - 1]
            for (r = 1; r <= rows; r++)
                printf "%.1f,%.1f ", 70 + 540 * cell[r, 1] / wide, place_y(cell[r, c])
            print "\"/>"
        }
    } else if (kind == "points") {
        low = 1e9
        for (r = 1; r <= rows; r++) if (cell[r, 2] < low) low = cell[r, 2] + 0
        scale = 520 / log(most(2, 2) / low)
        text(80, 306, "start", sprintf("%.3g", low))
        text(600, 306, "end", sprintf("%.3g", most(2, 2)))
        for (last = 0; (r = highest_left()) > 0; last = at_y) { # names from the top down, 14 apart
            at = 80 + scale * log(cell[r, 2] / low)
            at_y = place_y(cell[r, 3]) > last + 14 ? place_y(cell[r, 3]) : last + 14
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"%s\"/>\n", at, place_y(cell[r, 3]), color[1]
            aside = at > 300 ? -40 : 12
            line(at, place_y(cell[r, 3]), at + aside * 0.9, at_y, "#999")
            text(at + aside, at_y + 4, aside < 0 ? "end" : "start", cell[r, 1])
        }
    } else {
        wide = 540 / rows
        for (r = 1; r <= rows; r++) {
            for (c = 2; c <= columns; c++) {
                bar = wide * 0.8 / (columns - 1)
                left = 75 + wide * (r - 1) + bar * (c - 2)
                printf "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", left, place_y(cell[r, c]), bar - 2, 290 - place_y(cell[r, c]), color[c - 1]
            }
            text(75 + wide * (r - 0.6), r % 2 ? 304 : 318, "middle", cell[r, 1])
        }
    }
    for (c = 2; kind != "points" && c <= columns; c++) {
        printf "<rect x=\"%d\" y=\"34\" width=\"10\" height=\"10\" fill=\"%s\"/>\n", 90 + 180 * (c - 2), color[c - 1]
        text(104 + 180 * (c - 2), 43, "start", head[c])
    }
    print "</svg>"
}
