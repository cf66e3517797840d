/* The functions of the engine that have no memory. */
#include "calls.h"

#include "engine/tables.h"

#define PROPOSITIONS 1
#define NODES 1

typedef struct monitor {
    uint64_t dirty;
    int64_t since_ns[1];
    unsigned char truth_value[1];
} monitor;

static const uint64_t node_users[1] = {0};

#include "engine/absent.h"

#include "engine/propositions.h"

#include "engine/numbers.h"

#include "engine/functions.h"

enum { LOGIC, BITS, NUMBERS, QUANTIFIERS, ANGLES };

static void logic(unsigned char a, unsigned char b, double found[])
{
    found[0] = both(a, b);
    found[1] = either(a, b);
    found[2] = opposite(a);
}

static void quantifiers(const double x[], double found[])
{
    const size_t trues = (size_t)x[0], unknowns = (size_t)x[1], count = (size_t)x[2];
    const bool is_known = x[3] > 0.0;
    found[0] = some(trues, unknowns, count);
    found[1] = every(trues, unknowns, count);
    found[2] = how_many(trues, unknowns, count);
    found[3] = some_of_list(trues, unknowns, is_known);
    found[4] = every_of_list(trues, unknowns, count, is_known);
    found[5] = how_many_of_list(trues, unknowns, is_known);
}

static void make(const call *made)
{
    double found[6] = {0};
    monitor m = {0, {0}, {FALSE}};
    switch (made->kind) {
    case LOGIC:
        logic((unsigned char)(made->about & 3), (unsigned char)(made->about >> 2 & 3), found);
        break;
    case BITS:
        found[0] = lowest((uint64_t)made->t_ns);
        break;
    case NUMBERS:
        found[0] = known(made->x[0]);
        found[1] = outcome((made->about & 1) != 0, (made->about & 2) != 0);
        found[2] = element_proposition((made->about & 1) != 0, (made->about & 2) != 0);
        found[3] = minimum_of(made->x[0], made->x[1]);
        found[4] = maximum_of(made->x[0], made->x[1]);
        break;
    case QUANTIFIERS:
        quantifiers(made->x, found);
        break;
    default:
        found[0] = arcsine(made->x[0]);
        found[1] = arctangent(made->x[0], made->x[1]);
        found[2] = pitch_of(made->x[0], made->x[1], made->x[2], made->x[3]);
        break;
    }
    set_truth_value(&m, 0, TRUE, made->t_ns);
    found[5] = is_pending(&m) ? NAN : found[5];
    answer(found, sizeof found);
}

static void begin(void) {}

int main(void)
{
    if (arithmetic_fault() != NULL)
        return 3;
    answer_all(begin, make);
    return 0;
}
