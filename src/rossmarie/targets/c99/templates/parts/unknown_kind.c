/* Whether a number is unknown for lack of an input with a timeout: its value is missing, or nothing
 * is missing and no number comes out (a division by zero).
 */
static unsigned char unknown_kind(const monitor *m, unsigned row)
{
    for (unsigned i = row_blames[row]; i != row_blames[row + 1]; i++)
        if (isnan(m->value[blames[i]]))
            return LOST;
    if (row_blames[row] == row_blames[row + 1])
        return UNKNOWN;
    for (unsigned i = row_excuses[row]; i != row_excuses[row + 1]; i++)
        if (!(m->value[excuses[i]] < INFINITY))
            return UNKNOWN;
    return LOST;
}
