/* Huffman codes. In: how often each symbol occurs; out: lengths and canonical codes. Ties are broken by the symbol's
 * number, so the same counts give the same code everywhere. */
#include "huffman.h"

#include <string.h>

/* Used symbols by rising frequency, equal ones in their order; returns how many. */
static int sort_used(const uint32_t *frequencies, int symbols, int *sorted)
{
    int used = 0;
    for (int i = 0; i < symbols; i++) {
        if (frequencies[i] == 0)
            continue;
        int at = used++;
        for (; at > 0 && frequencies[sorted[at - 1]] > frequencies[i]; at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = i;
    }
    return used;
}

/* D. Huffman (1952) with the two queues of J. van Leeuwen (1976): leaves are sorted and joined nodes appear in rising
 * order, so the two lightest are always at the fronts. Returns the longest length. */
static int build(const uint32_t *frequencies, const int *sorted, int used, uint8_t *lengths)
{
    uint32_t weight[2 * LOM_HUFFMAN_SYMBOLS];
    int parent[2 * LOM_HUFFMAN_SYMBOLS], depth[2 * LOM_HUFFMAN_SYMBOLS];
    int nodes = 2 * used - 1, leaf = 0, joined = used;
    for (int i = 0; i < used; i++)
        weight[i] = frequencies[sorted[i]];
    for (int node = used; node < nodes; node++) {
        weight[node] = 0;
        for (int child = 0; child < 2; child++) {
            int lightest = leaf < used && (joined == node || weight[leaf] <= weight[joined]) ? leaf++ : joined++;
            weight[node] += weight[lightest];
            parent[lightest] = node;
        }
    }
    int longest = 0;
    depth[nodes - 1] = 0;
    for (int i = nodes - 2; i >= 0; i--) {
        depth[i] = depth[parent[i]] + 1;
        longest = depth[i] > longest ? depth[i] : longest;
    }
    for (int i = 0; i < used; i++)
        lengths[sorted[i]] = (uint8_t)depth[i];
    return longest;
}

void lom_huffman_lengths(const uint32_t *frequencies, int symbols, int limit, uint8_t *lengths)
{
    uint32_t scaled[LOM_HUFFMAN_SYMBOLS];
    int sorted[LOM_HUFFMAN_SYMBOLS];
    memcpy(scaled, frequencies, (size_t)symbols * sizeof *scaled);
    for (int i = 0, used = sort_used(scaled, symbols, sorted); used < 2; i++) {
        if (scaled[i] == 0) {
            scaled[i] = 1;
            used++;
        }
    }
    int used = sort_used(scaled, symbols, sorted);
    memset(lengths, 0, (size_t)symbols);
    /* Flatter counts give shorter codes, and equal ones a balanced tree, so this ends; it is rarely needed. */
    while (build(scaled, sorted, used, lengths) > limit)
        for (int i = 0; i < used; i++)
            scaled[sorted[i]] = scaled[sorted[i]] / 2 + 1; /* keeps the order */
}

void lom_huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes)
{
    uint16_t count[17] = { 0 }, next[17] = { 0 };
    for (int i = 0; i < symbols; i++)
        count[lengths[i]]++;
    count[0] = 0;
    for (int bits = 1; bits < 16; bits++)
        next[bits + 1] = (uint16_t)((next[bits] + count[bits]) << 1);
    for (int i = 0; i < symbols; i++) {
        int bits = lengths[i];
        uint16_t code = bits != 0 ? next[bits]++ : 0, reversed = 0;
        for (int b = 0; b < bits; b++)
            reversed = (uint16_t)(reversed | (code >> b & 1) << (bits - 1 - b));
        codes[i] = reversed;
    }
}
