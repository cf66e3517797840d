/* Hand-written code for the workload: the reference for all other rows.
 *
 * `hand_loop` runs the three rules over whole columns. `hand_opaque` makes one call per sample; the
 * compiler cannot inline the call, as with a generated step in a separate file. `hand_table` runs
 * 3 * K rules with other constants from a table, so that the compiler can vectorise over rules.
 */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define NEVER INT64_MAX
#define PERIOD_NS 10000000

typedef struct {
    int64_t since_fast, since_tilted, since_pushed;
} hand_state;

static const hand_state START = {NEVER, NEVER, NEVER};

/* True if `condition` has held over the closed interval of `duration` before `t`. */
static inline int held(int64_t *since, int condition, int64_t t, int64_t duration) {
    int64_t start = *since < t ? *since : t;
    start = condition ? start : NEVER;
    *since = start;
    return t - start >= duration;
}

static inline unsigned step(hand_state *s, int64_t t, double speed, double pitch, double distance,
                            double force_z, uint8_t contact) {
    int fast = held(&s->since_fast, speed > 0.5, t, 2000000000);
    int tilted = held(&s->since_tilted, fabs(pitch) > 10, t, 4000000000);
    int pushed = held(&s->since_pushed, force_z > 15, t, 300000000);
    unsigned first = (unsigned)(fast & (distance < 0.8));
    unsigned second = (unsigned)(tilted & (speed > 0.05));
    unsigned third = (unsigned)(pushed & !contact);
    return first | second << 1 | third << 2;
}

__attribute__((noinline)) static unsigned opaque_step(hand_state *s, int64_t t, double speed,
                                                      double pitch, double distance,
                                                      double force_z, uint8_t contact) {
    __asm__ volatile("");
    return step(s, t, speed, pitch, distance, force_z, contact);
}

#define RUN(STEP)                                                                                  \
    hand_state s = START;                                                                          \
    memset(counts, 0, 3 * sizeof *counts);                                                         \
    for (size_t i = 0; i < n; i++) {                                                               \
        unsigned active = STEP(&s, t[i], speed[i], pitch[i], distance[i], force_z[i], contact[i]); \
        out[i] = (uint8_t)active;                                                                  \
        counts[0] += active & 1;                                                                   \
        counts[1] += active >> 1 & 1;                                                              \
        counts[2] += active >> 2 & 1;                                                              \
    }

void hand_loop(size_t n, const int64_t *t, const double *speed, const double *pitch,
               const double *distance, const double *force_z, const uint8_t *contact, uint8_t *out,
               uint64_t *counts) {
    RUN(step)
}

void hand_opaque(size_t n, const int64_t *t, const double *speed, const double *pitch,
                 const double *distance, const double *force_z, const uint8_t *contact,
                 uint8_t *out, uint64_t *counts) {
    RUN(opaque_step)
}

/* One set of constants of the three rules. Durations are in samples. */
typedef struct {
    double speed, pitch, distance, force_z, creep;
    int64_t fast_samples, tilted_samples, pushed_samples;
} hand_constants;

#define MOST 100

void hand_table(size_t n, const int64_t *t, const double *speed, const double *pitch,
                const double *distance, const double *force_z, const uint8_t *contact, size_t sets,
                const hand_constants *constants, uint64_t *counts) {
    static double v[MOST], p[MOST], d[MOST], f[MOST], c[MOST];
    static int64_t dv[MOST], dp[MOST], df[MOST], sv[MOST], sp[MOST], sf[MOST];
    static int64_t n1[MOST], n2[MOST], n3[MOST];
    for (size_t j = 0; j < sets; j++) {
        const hand_constants *one = &constants[j];
        v[j] = one->speed, p[j] = one->pitch, d[j] = one->distance, f[j] = one->force_z;
        c[j] = one->creep;
        dv[j] = one->fast_samples * PERIOD_NS, dp[j] = one->tilted_samples * PERIOD_NS;
        df[j] = one->pushed_samples * PERIOD_NS;
        sv[j] = sp[j] = sf[j] = NEVER;
        n1[j] = n2[j] = n3[j] = 0;
    }
    for (size_t i = 0; i < n; i++) {
        int64_t now = t[i], apart = contact[i] ? 0 : 1;
        double tilt = fabs(pitch[i]);
        for (size_t j = 0; j < sets; j++) {
            int64_t a = sv[j] < now ? sv[j] : now, b = sp[j] < now ? sp[j] : now;
            int64_t e = sf[j] < now ? sf[j] : now;
            sv[j] = a = speed[i] > v[j] ? a : NEVER;
            sp[j] = b = tilt > p[j] ? b : NEVER;
            sf[j] = e = force_z[i] > f[j] ? e : NEVER;
            n1[j] += (int64_t)(now - a >= dv[j]) & (int64_t)(distance[i] < d[j]);
            n2[j] += (int64_t)(now - b >= dp[j]) & (int64_t)(speed[i] > c[j]);
            n3[j] += (int64_t)(now - e >= df[j]) & apart;
        }
    }
    memset(counts, 0, 3 * sizeof *counts);
    for (size_t j = 0; j < sets; j++) {
        counts[0] += (uint64_t)n1[j], counts[1] += (uint64_t)n2[j], counts[2] += (uint64_t)n3[j];
    }
}
