/* lom/base.h - what every layer stands on: errors as values, checked memory, files, numbers as text, hashes,
 * the float state, and mathematics in double that gives the same bits on every machine.
 *
 * Conventions of the whole library:
 * - What can fail takes a lom_error * last and returns NULL or false. The first failure stays in it; a later one does
 *   not overwrite it. A NULL error is allowed and drops the text.
 * - Lengths are metres, angles radians, unless a name says otherwise. Counts and sizes are size_t.
 * - What a function returns by pointer belongs to the caller, who frees it with the function named there.
 */
#ifndef LOM_BASE_H
#define LOM_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What is declared from LOM_API_BEGIN to LOM_API_END is the library's interface, with C's names and visible outside of
 * the library; it is built with everything else hidden. */
/* clang-format off */
#ifdef __cplusplus
#define LOM_API_BEGIN _Pragma("GCC visibility push(default)") extern "C" {
#define LOM_API_END   } _Pragma("GCC visibility pop")
#else
#define LOM_API_BEGIN _Pragma("GCC visibility push(default)")
#define LOM_API_END   _Pragma("GCC visibility pop")
#endif
/* clang-format on */

LOM_API_BEGIN

#if defined __FAST_MATH__
#error "lom promises the same bytes everywhere, which -ffast-math breaks: compile without it."
#endif
/* 16 is 0 for float and wider: machines that have 16-bit arithmetic (ISO/IEC TS 18661-3). */
#if defined __FLT_EVAL_METHOD__ && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "lom needs float arithmetic in float: on 32-bit x86 compile with -msse2 -mfpmath=sse."
#endif

/* ---- errors ---- */

typedef enum lom_code {
    LOM_OK = 0,
    LOM_ERROR_USAGE,    /* an argument or a call that is out of its range */
    LOM_ERROR_INPUT,    /* a file or text that is malformed */
    LOM_ERROR_FILE,     /* the system could not open, read or write */
    LOM_ERROR_LIMIT,    /* well formed, but larger than a stated limit */
    LOM_ERROR_MEMORY,   /* the system gave no memory */
    LOM_ERROR_THREAD,   /* the system gave no thread */
    LOM_ERROR_ABANDONED /* who watched it asked to leave off */
} lom_code;

typedef struct lom_error {
    lom_code code;
    char text[496]; /* one sentence, without a newline: "lake.toml:12:5: unknown key ..." */
} lom_error;

/* Stores code and the printf-formatted sentence in error unless it holds a failure already (or is NULL). Always returns
 * false, so that a failing function can `return lom_fail(...)`. */
bool lom_fail(lom_error *error, lom_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* What a lenient reader passed over. */
typedef struct lom_warnings {
    size_t count;    /* of sentences, those that found no room included */
    char text[1000]; /* the first of them, whole, each ended by a newline */
} lom_warnings;
/* Adds one sentence, unless it is there already; control characters become '?'. NULL is allowed. */
void lom_warn(lom_warnings *warnings, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds those of another thing. */
void lom_add_warnings(lom_warnings *warnings, const lom_warnings *more);
/* Where an unreadable file is no failure: turns the error of one (LOM_ERROR_FILE, _INPUT or _LIMIT) into a warning and
 * clears it. False for any other error, which stays. */
bool lom_warn_instead(lom_warnings *warnings, lom_error *error);

/* ---- memory ---- */

/* Zeroed memory for count elements of size bytes, aligned to 64. NULL (and LOM_ERROR_MEMORY) when the product overflows
 * or the system refuses; never NULL for a count or size of 0. Freed with lom_release. */
void *lom_allocate(size_t count, size_t size, lom_error *error);

/* Frees what lom_allocate gave; NULL is allowed. */
void lom_release(void *memory);

/* ---- whole files ---- */

typedef struct lom_bytes {
    uint8_t *data; /* freed with lom_release */
    size_t size;
} lom_bytes;

/* Reads a whole file ("-" is standard input), at most limit bytes. The data is followed by one zero byte that is not
 * counted. On failure data is NULL and error names the path. */
lom_bytes lom_read_file(const char *path, size_t limit, lom_error *error);

/* Writes a file so that path holds either its old content or all of the new: lom_open_writer, one lom_append and
 * lom_close_writer. */
bool lom_write_file(const char *path, const void *data, size_t size, lom_error *error);

/* ---- files written piece by piece: the one road of everything that is written ---- */

/* A file being written. Until it is closed path holds what it held before, and any number of writers of one path are
 * each whole: the last one to close stays. What is written meanwhile lies in the same folder, without a name where the
 * system has such files (O_TMPFILE), else as ".lom-" and 16 random digits, and is removed by a failure.
 *   - A link stays a link, also one to a file that is not there yet; a file's mode stays, and its owner where the
 * system lets it; a file that may not be written to is an error.
 *   - What is no regular file (a device, a FIFO) is written to directly. So are "-", standard output, and the names of
 *     open descriptors (/dev/stdout, /dev/fd/N), where they stand.
 *   - A file whose folder takes no new file, and one that another is mounted upon, is written in place: then a failure
 *     leaves it cut short. */
typedef struct lom_writer lom_writer;

/* NULL on failure. Ended by lom_close_writer or lom_abandon_writer. */
lom_writer *lom_open_writer(const char *path, lom_error *error);
/* All of the bytes, after those before them; standard output after what stdio holds for it. False (and with the reason
 * of the system in error) when they could not be written: then the writer can only be abandoned, and closing it fails.
 */
bool lom_append(lom_writer *writer, const void *data, size_t size, lom_error *error);
/* Makes path hold what was appended, on the disk; frees writer, also on failure. */
bool lom_close_writer(lom_writer *writer, lom_error *error);
/* Leaves path as it was and frees writer; NULL is allowed. */
void lom_abandon_writer(lom_writer *writer);

/* Removes the temporary files of all writers of this process that have a name: for a handler of a signal that is about
 * to end the process (it is async-signal-safe; the library installs no handler). Afterwards no writer can be opened or
 * closed. */
void lom_remove_temporaries(void);

/* ---- numbers as text: independent of the locale, correctly rounded (round to nearest even) ---- */

/* Parses the longest prefix of text[0, length) that is a decimal number: [+-] digits [. digits] [e[+-] digits], at
 * least one digit before or after the point. Returns the number of characters used, 0 when there is none. Too large
 * gives infinity, too small gives 0 or a denormal, as IEEE 754 rounds. "nan", "inf" and hexadecimal are no numbers
 * here. */
size_t lom_parse_double(const char *text, size_t length, double *value);
size_t lom_parse_float(const char *text, size_t length, float *value); /* rounded once, from the text to float */

/* Writes the shortest decimal that reads back as the same value, like "0.1", "-3", "1e+30", "nan", "inf"; at most 31
 * characters and a zero byte. Returns the length. */
size_t lom_print_double(char text[32], double value);
size_t lom_print_float(char text[32], float value);

/* ---- floating values as integers: defined for every value, the same on every machine ----
 * C leaves the conversion undefined outside the type's range, and processors disagree there. These cut towards zero, as
 * C does, return the nearest value in range for what lies outside (infinities too), and 0 for NaN. Nothing else in the
 * library converts a floating value to an integer (`make lint`); lom_to_int does it for lanes. */

/* In [-2147483648, 2147483647]. */
static inline __attribute__((unused)) int32_t lom_int_of(double x)
{
    return x > -2147483648.0 ? x < 2147483647.0 ? (int32_t)x : INT32_MAX : x == x ? INT32_MIN : 0;
}

/* In [-2^63, 2^63 - 1]. */
static inline __attribute__((unused)) int64_t lom_int64_of(double x)
{
    return x > -9223372036854775808.0 ? x < 9223372036854775808.0 ? (int64_t)x : INT64_MAX : x == x ? INT64_MIN : 0;
}

/* In [0, most]: sizes, counts, indices, samples of images. */
static inline __attribute__((unused)) size_t lom_count_of(double x, size_t most)
{
    return x >= 1 ? x < (double)most ? (size_t)x : most : 0;
}

/* ---- hash ---- */

#define LOM_HASH_START UINT64_C(0xcbf29ce484222325)

/* FNV-1a, 64 bits, of size bytes, continuing from hash (LOM_HASH_START at first). */
uint64_t lom_hash_bytes(uint64_t hash, const void *data, size_t size);

/* ---- the caller's float state ---- */

typedef struct lom_float_state {
    uint64_t saved[4];
} lom_float_state;

/* Saves the thread's floating-point environment (rounding mode, flush-to-zero, traps, flags) in state and sets the
 * default one: round to nearest even, denormals kept, nothing trapped. Every API entry that computes does this, and
 * every worker thread. */
void lom_enter_float_state(lom_float_state *state);
/* Restores what lom_enter_float_state saved. */
void lom_leave_float_state(const lom_float_state *state);

/* ---- mathematics in double, by + - * / and square root alone: the same bits everywhere ----
 * Error at most 1 ulp (most under 0.6) over the stated range; NaN gives NaN. */

double lom_double_sqrt(double x); /* correctly rounded */
double lom_double_floor(double x);
double lom_double_sin(double x); /* |x| <= 2^40 to 1 ulp by exact reduction; infinite gives NaN */
double lom_double_cos(double x);
double lom_double_tan(double x);
double lom_double_asin(double x); /* [-1, 1]; NaN outside */
double lom_double_acos(double x);
double lom_double_atan(double x);
double lom_double_atan2(double y, double x); /* C's cases for signed zeros and infinities */
double lom_double_exp(double x);             /* overflow gives infinity, underflow rounds into denormals and 0 */
double lom_double_exp2(double x);
double lom_double_expm1(double x);
double lom_double_log(double x); /* 0 gives -infinity, negative NaN */
double lom_double_log2(double x);
double lom_double_log1p(double x);
double lom_double_pow(double x, double y); /* C's special cases */
double lom_double_sinh(double x);
double lom_double_cosh(double x);
double lom_double_tanh(double x);
double lom_double_erf(double x);
double lom_double_cbrt(double x);

/* ---- random numbers: counter-based, a pure function of what they are for ---- */

/* 64 well mixed bits of (key, counter): the same pair gives the same bits, any frame, pixel or voxel alone. */
uint64_t lom_random_bits(uint64_t key, uint64_t counter);
/* Uniform in [0, 1) with 53 bits. */
double lom_random_uniform(uint64_t key, uint64_t counter);
/* Two independent standard normal numbers by Box-Muller of lom_random_bits. */
void lom_random_normal(uint64_t key, uint64_t counter, double normal[2]);

/* ---- the machine ---- */

/* Vector extensions that both the CPU and the system support; false on architectures that do not have them. They choose
 * which code runs, never what it computes. */
typedef struct lom_cpu {
    bool avx2;
    bool avx512; /* F, DQ, BW, VL and CD together */
} lom_cpu;
lom_cpu lom_detect_cpu(void);

/* How many threads are worth starting, at least 1: the CPUs this thread may run on (affinity), or fewer where the
 * quota of its control groups (cgroup version 1 and 2, every level; a fraction counts as a whole CPU) allows fewer. */
int lom_default_threads(void);
/* Bytes of the last level of cache; 0 where the system does not say. */
size_t lom_cache_bytes(void);

/* ---- names ---- */

/* The name that word[0, length) was most likely meant to be, for "did you mean": the fewest inserted, deleted, replaced
 * and swapped letters, at most a third of the word and one more; the first of equals. NULL when none is near. */
const char *lom_nearest_name(const char *word, size_t length, const char *const *names, size_t count);

/* ---- version ---- */

#define LOM_VERSION         "0.1.0"
#define LOM_PICTURE_VERSION 7 /* raised by every deliberate change of pixels; CHANGELOG.md says why */

LOM_API_END

#endif
