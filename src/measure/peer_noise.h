/* The value noise that the peers' textures are made of (bench/peers/README.md, "Noise"), in float as there. */
#ifndef LOM_MEASURE_PEER_NOISE_H
#define LOM_MEASURE_PEER_NOISE_H

#include <stdint.h>

/* A number in [0, 1) from three integers. */
float lom_peer_lattice(uint32_t x, uint32_t y, uint32_t z);
/* 5 octaves over the unit square (u, v >= 0), periodic; base frequency `period`; in [0, 1]. */
float lom_peer_fbm2(float u, float v, int period, int seed);
/* 4 octaves over the unit cube, periodic; in [0, 1]. */
float lom_peer_fbm3(float x, float y, float z, int period);
/* clamp((x - low) / (high - low), 0, 1), smoothed by t t (3 - 2 t). */
float lom_peer_smoothstep(float low, float high, float x);
/* x clamped to [0, 1], as 8-bit unorm, halves up. */
uint8_t lom_peer_byte(float x);
float lom_peer_clamp01(float x);
float lom_peer_mix(float a, float b, float t);

#endif
